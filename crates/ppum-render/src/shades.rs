//! The colours of values: a table of them, and which entry a value has.
//!
//! ```text
//! entry(v) = ⌊position(v) (N − 1) + ½⌋      one entry each for what lies below and above the range, and for no value
//! ```
//!
//! On a linear scale entries are found on vectors, as the low bits of a number; colours are then
//! looked up one by one. The table stays in the first cache, where a look-up takes about a cycle.

use ppum::real::{LaneJob, LaneNumber, Real};
use ppum_raster::raster::SampleSlice;

use crate::colormap::Colormap;
use crate::image::Rgba;
use crate::scale::{Normalization, Scale};

/// Colours in the table that pixels are looked up in. Neighbouring entries of a built-in map differ
/// by at most 8 steps of a byte and this is 16 times finer, so rounding to it costs at most
/// one step.
pub const PALETTE: usize = 4096;

/// Entries behind those of the range.
const BELOW: usize = PALETTE;
const ABOVE: usize = PALETTE + 1;
const UNDEFINED: usize = PALETTE + 2;

/// Length of the table, a power of two: an entry is in it whatever its other bits are.
const LENGTH: usize = 2 * PALETTE;

/// Pixels whose entries are found before their colours.
const CHUNK: usize = 256;

/// The colours that values have on a scale.
#[derive(Clone, Debug)]
pub struct Shades {
    table: Box<[Rgba; LENGTH]>,
    /// The map where the table is too coarse: jumps are where they are.
    jumping: Option<Colormap>,
    norm: Normalization,
}

impl Shades {
    /// The colours of a map on a scale, and that of what has no value.
    #[must_use]
    pub fn new(colormap: &Colormap, norm: Normalization, undefined: Rgba) -> Self {
        let mut table = vec![undefined; LENGTH];
        table[..PALETTE].copy_from_slice(&colormap.palette(PALETTE));
        (table[BELOW], table[ABOVE]) = (colormap.below, colormap.above);
        let table = table.into_boxed_slice().try_into().expect("a table of its length");
        let jumping = colormap.has_jumps().then(|| colormap.clone());
        Self { table, jumping, norm }
    }

    /// The colour of a value.
    #[must_use]
    pub fn color(&self, value: f64) -> Rgba {
        match (self.entry(value), &self.jumping) {
            (entry, Some(map)) if entry < PALETTE => map.color(self.norm.position(value)),
            (entry, _) => self.table[entry],
        }
    }

    fn entry(&self, value: f64) -> usize {
        match value {
            v if v.is_nan() => UNDEFINED,
            v if v < self.norm.min() => BELOW,
            v if v > self.norm.max() => ABOVE,
            v => {
                let entry = (self.norm.position(v) * (PALETTE - 1) as f64 + 0.5) as usize;
                entry.min(PALETTE - 1)
            }
        }
    }

    /// Colours values; returns whether one of them lies below, and above, the range. It is not
    /// generic, so that the kernels are compiled once, here, and not in every crate that draws.
    pub(crate) fn paint(&self, values: SampleSlice<'_>, pixels: &mut [Rgba]) -> [bool; 2] {
        match values {
            SampleSlice::Double(values) => self.paint_values(values, pixels),
            SampleSlice::Single(values) => self.paint_values(values, pixels),
        }
    }

    fn paint_values<T: TableKey>(&self, values: &[T], pixels: &mut [Rgba]) -> [bool; 2] {
        let ramp = Some(&self.norm).filter(|_| self.jumping.is_none()).and_then(Ramp::new);
        if let Some(ramp) = ramp {
            return T::dispatch(RowShades { ramp, table: &self.table, values, pixels });
        }
        let mut beyond = [false; 2];
        for (pixel, &value) in pixels.iter_mut().zip(values) {
            let value = value.to_f64();
            beyond[0] |= value < self.norm.min();
            beyond[1] |= value > self.norm.max();
            *pixel = self.color(value);
        }
        beyond
    }
}

/// A number type whose bits tell an entry.
pub trait TableKey: LaneNumber {
    /// From this number to twice of it only whole numbers are numbers of the type: the last bits of
    /// a sum with it count.
    const WHOLE: f64;
    /// The greatest number that is not above another one, and the least that is not below it.
    fn around(value: f64) -> [Self; 2];
    /// The bits that count.
    fn low_bits(self) -> usize;
}

macro_rules! entry {
    ($t:ident) => {
        impl TableKey for $t {
            const WHOLE: f64 = (1u64 << ($t::MANTISSA_DIGITS - 1)) as f64;

            fn around(value: f64) -> [Self; 2] {
                let near = value as $t;
                let below = if f64::from(near) > value { near.next_down() } else { near };
                let above = if f64::from(near) < value { near.next_up() } else { near };
                [below, above]
            }

            #[inline(always)]
            fn low_bits(self) -> usize {
                self.to_bits() as usize
            }
        }
    };
}

entry!(f32);
entry!(f64);

/// A linear scale in numbers of a type.
#[derive(Clone, Copy, Debug)]
struct Ramp<T> {
    /// The least and the greatest number in the range.
    range: [T; 2],
    /// The start of the range, and what rounding has left of it.
    start: [T; 2],
    /// Entries a unit.
    slope: T,
}

impl<T: TableKey> Ramp<T> {
    /// None of another scale, or of a range out of the type's reach.
    fn new(norm: &Normalization) -> Option<Self> {
        let (min, max) = (norm.min(), norm.max());
        let start = T::from_f64(min);
        let rest = T::from_f64(min - start.to_f64());
        let entries = (PALETTE - 1) as f64;
        let slope = T::from_f64(norm.per_span() * entries);
        // neither the span nor what is multiplied with it may be rounded to nothing, or out of
        // all bounds
        let keeps = |exact: f64| (T::from_f64(exact).to_f64() / exact - 1.0).abs() < 1e-6;
        let is_kept = [max - min, 2.0 * (max - min), norm.per_span() * entries].map(keeps);
        let range = [T::around(min)[1], T::around(max)[0]];
        (norm.scale() == Scale::Linear && is_kept == [true; 3]).then_some(Self {
            range,
            start: [start, rest],
            slope,
        })
    }

    /// The entries of some values, as the low bits of a number.
    #[inline(always)]
    fn entries<R: Real<Scalar = T>>(&self, v: R, beyond: &mut [bool; 2]) -> R {
        let lit = |number: usize| v.broadcast(number as f64);
        let all = |number: T| v.broadcast(number.to_f64());
        let [least, greatest] = self.range.map(all);
        let [start, rest] = self.start.map(all);
        // not fused, so that colours are the same on all processors
        let entry = (v - start - rest) * all(self.slope) + v.broadcast(0.5);
        let inside = entry.floor().max(lit(0)).min(lit(PALETTE - 1));
        let (below, above) = (least.gt(v), v.gt(greatest));
        *beyond = [beyond[0] | R::any(below), beyond[1] | R::any(above)];
        let entry = R::select(below, lit(BELOW), inside);
        let entry = R::select(above, lit(ABOVE), entry);
        R::select(v.ge(v), entry, lit(UNDEFINED)) + v.broadcast(T::WHOLE)
    }
}

/// Colours a row on a linear scale.
struct RowShades<'a, T> {
    ramp: Ramp<T>,
    table: &'a [Rgba; LENGTH],
    values: &'a [T],
    pixels: &'a mut [Rgba],
}

impl<T: TableKey> LaneJob<T> for RowShades<'_, T> {
    type Output = [bool; 2];

    #[inline(always)]
    fn run<R: Real<Scalar = T>>(self, zero: R) -> [bool; 2] {
        let Self { ramp, table, values, pixels } = self;
        let mut beyond = [false; 2];
        let mut padded = [T::default(); CHUNK];
        let mut entries = [T::default(); CHUNK];
        for (values, pixels) in values.chunks(CHUNK).zip(pixels.chunks_mut(CHUNK)) {
            let mut source = values;
            if values.len() < CHUNK {
                padded.fill(values[0]);
                padded[..values.len()].copy_from_slice(values);
                source = &padded;
            }
            let mut k = 0;
            while k < CHUNK {
                ramp.entries(zero.load(&source[k..]), &mut beyond).store(&mut entries[k..]);
                k += R::LANES;
            }
            for (pixel, entry) in pixels.iter_mut().zip(&entries) {
                *pixel = table[entry.low_bits() % LENGTH];
            }
        }
        beyond
    }
}

#[cfg(test)]
mod tests {
    use ppum_testkit::random::Random;

    use super::*;

    /// The colours of values in a type, and what lay beyond, by `paint_values` and one by one.
    fn compared<T: TableKey>(shades: &Shades, values: &[T]) -> usize {
        let mut pixels = vec![[0; 4]; values.len()];
        let beyond = shades.paint_values(values, &mut pixels);
        let wide: Vec<f64> = values.iter().map(|v| v.to_f64()).collect();
        let norm = &shades.norm;
        let expected = [wide.iter().any(|v| *v < norm.min()), wide.iter().any(|v| *v > norm.max())];
        assert_eq!(beyond, expected);
        let apart = |a: Rgba, b: Rgba| a.iter().zip(b).map(|(a, b)| a.abs_diff(b)).max();
        let differ = pixels.iter().zip(&wide).filter(|(pixel, value)| {
            let exact = shades.color(**value);
            // neighbours of the table differ by a step of a byte
            assert!(apart(**pixel, exact) <= Some(1), "{value}: {pixel:?} for {exact:?}");
            **pixel != exact
        });
        differ.count()
    }

    /// Rows of any length on any range: what is found on vectors is what one value after the other
    /// has, up to the rounding of f32 between two entries.
    #[test]
    fn vectors_find_what_single_values_have() {
        let mut random = Random(7);
        let map = Colormap::named("turbo").expect("built in").contrasting();
        for k in 0..300 {
            let scale = 10f64.powf(random.between(-30.0, 30.0));
            let width = 10f64.powf(random.between(-5.0, 1.0)) * scale;
            let min = random.between(-1.0, 1.0) * scale;
            let norm = Normalization::new(Scale::Linear, min, min + width);
            let shades = Shades::new(&map, norm, [1, 2, 3, 4]);
            let special = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, min, min + width, 0.0, -0.0];
            let mut values: Vec<f64> =
                (0..k).map(|_| min + width * random.between(-0.1, 1.1)).collect();
            values.extend(special.iter().take(k % 8));
            assert_eq!(compared(&shades, &values), 0);
            let narrow: Vec<f32> = values.iter().map(|v| *v as f32).collect();
            let differ = compared(&shades, &narrow);
            assert!(differ <= 1 + narrow.len() / 50, "{differ} of {}", narrow.len());
        }
    }

    /// Ranges that f32 does not hold, other scales and maps that jump are painted value by value.
    #[test]
    fn what_vectors_do_not_hold() {
        let map = Colormap::named("viridis").expect("built in");
        let linear = |min: f64, max: f64| Normalization::new(Scale::Linear, min, max);
        for norm in [linear(-3e38, 3e38), linear(0.0, 1e-45), linear(1e60, 2e60)] {
            assert!(Ramp::<f32>::new(&norm).is_none() && Ramp::<f64>::new(&norm).is_some());
        }
        let log = Normalization::new(Scale::Log, 1e-3, 1e3);
        assert!(Ramp::<f64>::new(&log).is_none());
        let values = [1e-4, 1e-3, 1.0, 500.0, 1e4, f64::NAN];
        assert_eq!(compared(&Shades::new(&map, log, [0; 4]), &values), 0);
        let banded = Shades::new(&map.banded(3), linear(0.0, 3.0), [0; 4]);
        let values = [0.0, 1.0 - 1e-15, 1.0, 2.0, 3.0, 3.1, f64::NAN];
        assert_eq!(compared(&banded, &values), 0);
    }
}
