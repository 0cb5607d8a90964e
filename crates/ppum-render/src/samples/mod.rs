//! Means over pixels, against jagged edges: N × N samples a pixel in place of the value at
//! its centre.
//!
//! A pixel is cut into N × N squares, and the field evaluated at the centre of each
//! ([`View::finer`]). The pixel's value is the mean of those values that lie in the body, on
//! whichever side of a crack,
//!
//! ```text
//! m = 1/n Σ_k q(x_k)        x_k in the plate, q(x_k) finite, n of them
//! ```
//!
//! and its opacity the share of samples that lie in the body. This is an area average by the
//! midpoint rule, exact for linear fields; means are of *values*, not of colours, so a colour bar
//! still tells what a colour means. Further:
//!
//! - the mean of directions, which are angles up to π, is that of the doubled angles as vectors:
//!   ½ atan2(Σ sin 2θ_k, Σ cos 2θ_k);
//! - samples of the body without a value, as formulas have them, do not count; where no sample has
//!   one the pixel has none;
//! - a value is infinite at points, as stresses are at a tip, which have no area: it does not count
//!   beside finite ones. Where all are infinite so is the mean, and undefined if they are so with
//!   both signs;
//! - one sample is the value at the centre, to the last bit.
//!
//! Costs N² times as much as the image of centres; memory is bounded, since the finer view is
//! drawn in strips.

use std::num::NonZeroU8;
use std::str::FromStr;

use ppum::field::{Field, LocalField};
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use ppum::vec2::Vec2;
use ppum_raster::RasterError;
use ppum_raster::raster::{Raster, RasterValue};
use ppum_raster::scatter::render_batches;
use ppum_raster::view::View;
use rayon::prelude::*;

/// N, of N × N samples a pixel: 1, the centre alone, to [`Samples::MOST`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Samples(NonZeroU8);

/// Not a number of samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("write a number from 1 to {most}", most = Samples::MOST)]
pub struct SamplesError;

impl Samples {
    /// The centre of each pixel.
    pub const CENTER: Self = Self(NonZeroU8::MIN);
    /// The largest N: 256 samples a pixel, as many as an opacity has values.
    pub const MOST: u8 = 16;

    /// `n` × `n` samples a pixel; none of 0 and of more than [`Samples::MOST`].
    #[must_use]
    pub fn new(n: u8) -> Option<Self> {
        NonZeroU8::new(n).filter(|n| n.get() <= Self::MOST).map(Self)
    }

    /// N.
    #[must_use]
    pub fn side(self) -> u32 {
        self.0.get().into()
    }

    /// N².
    #[must_use]
    pub fn count(self) -> u16 {
        u16::from(self.0.get()).pow(2)
    }

    /// The meaning of a pixel in words.
    #[must_use]
    pub fn meaning(self) -> String {
        match self.0.get() {
            1 => "value at pixel centre".into(),
            n => format!("mean of {n}x{n} values in the pixel"),
        }
    }
}

impl FromStr for Samples {
    type Err = SamplesError;

    fn from_str(text: &str) -> Result<Self, SamplesError> {
        text.trim().parse().ok().and_then(Self::new).ok_or(SamplesError)
    }
}

/// The means over the pixels of a view, and how much of the pixels is body.
#[derive(Clone, Debug, PartialEq)]
pub struct Means<T = f64> {
    /// The means; NaN where no sample has a value.
    pub raster: Raster<T>,
    /// Number of samples that lie in the body, pixel by pixel.
    pub inside: Vec<u16>,
    /// The number of samples.
    pub samples: Samples,
}

/// An image of the [finer](View::finer) view, as any renderer draws it.
#[derive(Clone, Copy, Debug)]
pub struct SampleImage<'a, T> {
    /// The values.
    pub raster: &'a Raster<T>,
    /// The pixels of the body without a value, rising, by their place row by row.
    pub undefined: &'a [u32],
}

impl<T: RasterValue> Means<T> {
    /// The means of a quantity over the pixels of a view, from an image of its samples.
    ///
    /// # Panics
    /// If the image does not have the pixels of the finer view.
    #[must_use]
    pub fn of(
        view: &View,
        quantity: &Quantity,
        samples: Samples,
        image: SampleImage<'_, T>,
    ) -> Self {
        let size = view.pixels.map(|n| n * samples.side());
        assert_eq!(image.raster.size, size, "an image of samples");
        let inside = Inside::Pixels { sorted: image.undefined, columns: size[0] };
        let mut gathered = SampleMeans::new(inside, view, quantity, samples);
        gathered.add(&image.raster.values);
        gathered.finish()
    }

    /// The pixels with some of the body, but without a value, by their place row by row.
    #[must_use]
    pub fn undefined(&self) -> Vec<u32> {
        let pixels = (0u32..).zip(self.inside.iter().zip(&self.raster.values));
        let without =
            pixels.filter(|(_, (inside, value))| **inside > 0 && (**value).into().is_nan());
        without.map(|(pixel, _)| pixel).collect()
    }

    /// The share of each pixel that is body, as an opacity.
    #[must_use]
    pub fn opacity(&self) -> Vec<u8> {
        let all = f64::from(self.samples.count());
        self.inside.iter().map(|&inside| (255.0 * f64::from(inside) / all).round() as u8).collect()
    }
}

/// The means of a quantity over the pixels of a view, computed in `T` = f64 or f32 on the threads
/// of the pool that calls. Values of samples are those of [`render`](ppum_raster::scatter::render).
///
/// # Errors
/// Those of [`render`](ppum_raster::scatter::render); samples finer than f64 has numbers for.
pub fn means<T: RasterValue>(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    samples: Samples,
    watcher: &dyn Watcher,
) -> Result<Means<T>, RasterError> {
    let finer = view.finer(samples.side())?;
    let inside = Inside::Field(Box::new(field.at(view.center)));
    let mut gathered = SampleMeans::new(inside, view, quantity, samples);
    let (rows, mut add) = (rows(&finer, samples), |values: Vec<T>| gathered.add(&values));
    render_batches::<T>(field, &finer, quantity, rows, watcher, &mut add)?;
    Ok(gathered.finish())
}

/// Samples that are held at once, unless a row of tiles has more: 32 MiB.
const HELD: u32 = 1 << 22;
/// Rows of the renderer's bands.
const BAND: u32 = 32;

/// Rows of samples of a strip: whole bands, and whole rows of pixels.
fn rows(finer: &View, samples: Samples) -> u32 {
    let side = samples.side();
    let least =
        (1..side).map(|k| k * BAND).find(|rows| rows.is_multiple_of(side)).unwrap_or(side * BAND);
    least * (HELD / finer.pixels[0] / least).max(1)
}

/// Which samples without a value lie in the body.
enum Inside<'f> {
    /// Those at points of the field's domain, or of its elements.
    Field(Box<LocalField<'f>>),
    /// Those of these pixels of the finer view, which has so many columns.
    Pixels { sorted: &'f [u32], columns: u32 },
}

impl Inside<'_> {
    /// True for the sample of a column and row, at an offset from the view's centre.
    fn contains(&self, [column, row]: [u32; 2], offset: Vec2) -> bool {
        match self {
            Self::Field(local) => local.contains(offset),
            Self::Pixels { sorted, columns } => {
                sorted.binary_search(&(row * columns + column)).is_ok()
            }
        }
    }
}

/// Means of the rows so far.
struct SampleMeans<'v, T> {
    view: &'v View,
    samples: Samples,
    inside_of: Inside<'v>,
    /// True for angles of directions, which are the same after a turn by π.
    is_direction: bool,
    /// Offsets of the columns of samples.
    xs: Vec<f64>,
    finer: View,
    values: Vec<T>,
    inside: Vec<u16>,
}

impl<'v, T: RasterValue> SampleMeans<'v, T> {
    fn new(inside_of: Inside<'v>, view: &'v View, quantity: &Quantity, samples: Samples) -> Self {
        let is_direction = *quantity == Quantity::PrincipalDirection;
        let finer = View { pixels: view.pixels.map(|n| n * samples.side()), ..*view };
        let xs = (0..finer.pixels[0]).map(|column| finer.column_offset(column)).collect();
        let (values, inside) = (Vec::new(), Vec::new());
        Self { view, samples, inside_of, is_direction, xs, finer, values, inside }
    }

    /// Adds the next rows of samples, whole rows of pixels.
    fn add(&mut self, values: &[T]) {
        let (columns, side) = (self.view.pixels[0] as usize, self.samples.side() as usize);
        let first = self.values.len() / columns;
        let lines = values.par_chunks_exact(self.xs.len() * side).enumerate();
        let found: Vec<(T, u16)> =
            lines.flat_map_iter(|(k, line)| self.line((first + k) as u32, line)).collect();
        self.values.extend(found.iter().map(|(value, _)| *value));
        self.inside.extend(found.iter().map(|(_, inside)| *inside));
    }

    /// Mean and number of samples of the body, of each pixel of a row.
    fn line(&self, row: u32, samples: &[T]) -> Vec<(T, u16)> {
        let (columns, side) = (self.xs.len(), self.samples.side() as usize);
        let first_row = row * self.samples.side();
        let rows: Vec<(u32, f64)> =
            (first_row..).take(side).map(|row| (row, self.finer.row_offset(row))).collect();
        let pixel = |first: usize| {
            let mut mean = Mean { is_direction: self.is_direction, ..Mean::default() };
            for (line, &(row, y)) in samples.chunks_exact(columns).zip(&rows) {
                let values = line[first..first + side].iter().zip(&self.xs[first..]);
                for (column, (&value, &x)) in (first as u32..).zip(values) {
                    let is_inside = || self.inside_of.contains([column, row], [x, y].into());
                    mean.add(value.into(), is_inside);
                }
            }
            (T::from_f64(mean.value()), mean.inside)
        };
        (0..columns).step_by(side).map(pixel).collect()
    }

    fn finish(self) -> Means<T> {
        let raster = Raster::new(self.view.pixels, self.values);
        Means { raster, inside: self.inside, samples: self.samples }
    }
}

/// The samples of one pixel.
#[derive(Default)]
struct Mean {
    finite: f64,
    /// Sums of the cosines and sines of doubled angles.
    doubled: [f64; 2],
    is_direction: bool,
    count: u16,
    infinite: f64,
    is_infinite: bool,
    inside: u16,
}

impl Mean {
    fn add(&mut self, value: f64, is_inside: impl FnOnce() -> bool) {
        if value.is_finite() {
            self.finite += value;
            self.count += 1;
            if self.is_direction {
                let (sine, cosine) = (2.0 * value).sin_cos();
                self.doubled = [self.doubled[0] + cosine, self.doubled[1] + sine];
            }
        } else if !value.is_nan() {
            self.infinite += value;
            self.is_infinite = true;
        }
        self.inside += u16::from(!value.is_nan() || is_inside());
    }

    fn value(&self) -> f64 {
        match self.count {
            0 if self.is_infinite => self.infinite,
            0 => f64::NAN,
            2.. if self.is_direction => 0.5 * self.doubled[1].atan2(self.doubled[0]),
            n => self.finite / f64::from(n),
        }
    }
}

#[cfg(test)]
mod tests;
