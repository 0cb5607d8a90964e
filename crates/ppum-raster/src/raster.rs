//! Values at the pixel centres of a view.

use ppum::domain::Domain;
use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use ppum::real::LaneNumber;
use rayon::prelude::*;

use crate::error::RasterError;
use crate::rows::RowBatches;
use crate::summation::Summation;
use crate::view::View;

/// The number types of a raster: f64 and f32.
pub trait RasterValue: LaneNumber + Into<f64> {
    /// Relative difference up to which values count as one: some roundings, and of f64 the rounding
    /// of a linear system too, since a field that is constant except for that should look so.
    const SAME: f64;

    /// The values as a slice of f64 or of f32: code that matches on it is compiled once for both
    /// types, and not in every crate that draws.
    fn sample_slice(values: &[Self]) -> SampleSlice<'_>;

    /// [`render_batches`](crate::scatter::render_batches) for this type, by a summation.
    /// Implemented for each, so that the renderer's kernels are compiled once, here, and not in
    /// every crate that draws.
    ///
    /// # Errors
    /// See there.
    fn render_batches(
        field: &Field<'_>,
        view: &View,
        quantity: &Quantity,
        summation: Summation,
        batches: RowBatches,
        watcher: &dyn Watcher,
        take: &mut dyn FnMut(Vec<Self>),
    ) -> Result<(), RasterError>;
}

/// Values whose number type is asked at run time.
#[derive(Clone, Copy, Debug)]
pub enum SampleSlice<'a> {
    /// Values in f64.
    Double(&'a [f64]),
    /// Values in f32.
    Single(&'a [f32]),
}

/// One value per pixel, row by row from the top; NaN where nothing is defined (outside the domain).
#[derive(Clone, Debug, PartialEq)]
pub struct Raster<T = f64> {
    /// Columns and rows.
    pub size: [u32; 2],
    /// Values, `size[0] * size[1]` of them.
    pub values: Vec<T>,
}

/// Whole numbers up to here differ from their neighbours' middles in single precision too.
const LARGEST_WHOLE: f64 = (1 << 22) as f64;

/// Values that are cleared at a time.
const BLOCK: usize = 1024;

/// So many values are not cleared but taken from the system, whose new pages are zero: clearing
/// them takes seconds, in which nobody could stop the work.
const LAZY: usize = 1 << 24;

/// Returns `count` zeros, written by all threads of the pool: one thread would take a tenth of the
/// time of an image.
#[must_use]
pub fn zeros<T: Copy + Default + Send>(count: usize) -> Vec<T> {
    if count > LAZY {
        return vec![T::default(); count];
    }
    let blocks = (0..count.div_ceil(BLOCK)).into_par_iter().map(|_| [T::default(); BLOCK]);
    let mut all = blocks.collect::<Vec<_>>().into_flattened();
    all.truncate(count);
    all
}

/// Statistics of a raster. Minimum, maximum and mean are those of the finite values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// Number of finite values.
    pub finite: usize,
    /// Number of NaN.
    pub undefined: usize,
    /// Number of infinite values.
    pub infinite: usize,
    /// Smallest finite value, +∞ if there is none.
    pub min: f64,
    /// Largest finite value, −∞ if there is none.
    pub max: f64,
    /// Mean of the finite values, NaN if there is none.
    pub mean: f64,
}

impl<T: RasterValue> Raster<T> {
    /// A raster from its values.
    ///
    /// # Panics
    /// If the number of values is not columns × rows.
    #[must_use]
    pub fn new(size: [u32; 2], values: Vec<T>) -> Self {
        let pixels = size[0] as usize * size[1] as usize;
        assert_eq!(values.len(), pixels, "a raster needs one value per pixel");
        Self { size, values }
    }

    /// The value `f(column, row)` at every pixel, rows in parallel.
    #[must_use]
    pub fn from_fn(size: [u32; 2], f: impl Fn(u32, u32) -> T + Sync) -> Self {
        let row = |j| (0..size[0]).map(|i| f(i, j)).collect::<Vec<_>>();
        Self::new(size, (0..size[1]).into_par_iter().flat_map_iter(row).collect())
    }

    /// The value of a pixel.
    #[must_use]
    pub fn value(&self, column: u32, row: u32) -> T {
        self.values[row as usize * self.size[0] as usize + column as usize]
    }

    /// The values of a row.
    #[must_use]
    pub fn row(&self, row: u32) -> &[T] {
        let columns = self.size[0] as usize;
        &self.values[row as usize * columns..][..columns]
    }

    /// The value that all pixels of a value have, except for rounding; none if they differ or
    /// are infinite.
    #[must_use]
    pub fn one_value(&self) -> Option<f64> {
        let (mut min, mut max) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in self.values.iter().map(|&v| v.into()).filter(|v: &f64| !v.is_nan()) {
            (min, max) = (min.min(value), max.max(value));
            // two that differ are enough: others only widen what lies between
            if value.is_infinite() || max - min > T::SAME * min.abs().max(max.abs()) {
                return None;
            }
        }
        (min <= max).then_some(0.5 * min + 0.5 * max)
    }

    /// The different values, rising, if they are at most `most` whole numbers; none otherwise. NaN
    /// does not count.
    #[must_use]
    pub fn whole_numbers(&self, most: usize) -> Option<Vec<f64>> {
        let mut found: Vec<f64> = Vec::new();
        for value in self.values.iter().map(|&v| v.into()).filter(|v: &f64| !v.is_nan()) {
            // −0 is 0
            let value = value + 0.0;
            let Err(place) = found.binary_search_by(|known| known.total_cmp(&value)) else {
                continue;
            };
            if found.len() == most || value.fract() != 0.0 || value.abs() > LARGEST_WHOLE {
                return None;
            }
            found.insert(place, value);
        }
        (!found.is_empty()).then_some(found)
    }

    /// The pixels of the body without a value, by their place row by row: what is undefined there,
    /// as a formula may be, and not outside.
    ///
    /// # Panics
    /// If the raster does not have the view's size.
    #[must_use]
    pub fn undefined(&self, domain: &Domain, view: &View) -> Vec<u32> {
        assert_eq!(self.size, view.pixels, "a raster belongs to a view of its size");
        let (local, columns) = (domain.at(view.center), self.size[0]);
        let in_row = |row: u32| {
            let values = self.row(row).iter().map(|&v| v.into());
            let without = (0..).zip(values).filter(|(_, value): &(u32, f64)| value.is_nan());
            let undefined = without.filter(|(column, _)| local.contains(view.offset(*column, row)));
            undefined.map(|(column, _)| row * columns + column).collect::<Vec<_>>()
        };
        (0..self.size[1]).into_par_iter().flat_map_iter(in_row).collect()
    }

    /// Counts, extremes and mean.
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        let (mut min, mut max, mut sum) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
        let (mut finite, mut undefined) = (0, 0);
        for value in self.values.iter().map(|&v| v.into()) {
            undefined += usize::from(value.is_nan());
            if value.is_finite() {
                finite += 1;
                sum += value;
                min = min.min(value);
                max = max.max(value);
            }
        }
        let infinite = self.values.len() - finite - undefined;
        Statistics { finite, undefined, infinite, min, max, mean: sum / finite as f64 }
    }
}
