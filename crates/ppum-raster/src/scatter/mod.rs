//! The CPU renderer: exact values at all pixels of a view, patch by patch on vectors of pixels.
//!
//! The image is cut into tiles. Each patch adds to the sums of the tiles it meets
//!
//! ```text
//! S = Σ W_i     U = Σ W_i v_i     ∇S     ∇U
//! ```
//!
//! and when all have, each point is divided once, u = U / S and ∇u = (∇U − u ∇S) / S, and the
//! quantity made. No patch list is searched at a pixel, and no pixel lies in a special case: any
//! cover, any degree, any number of functions. At a vector of columns a patch's weight and
//! polynomials collapse to polynomials in y (module `collapse`), those of patches beside each other
//! to one (`spans`). Row by row (`sweep`) these are summed and divided in registers (`sums`), and
//! the quantity is made while all is in the nearest cache (`finish`). Functions are evaluated once
//! for a column, and only where a patch needs them. Where patches are too small for that to pay
//! they are summed one by one instead (`patch_sums`).
//!
//! The renderer evaluates the same field as [`LocalField`](ppum::field::LocalField), which
//! [`reference`](fn@crate::reference::reference) draws with, in another order; they agree to
//! rounding. Results depend neither on the number of threads nor on chance; they may differ in the
//! last bits from processor to processor, since lanes fuse multiplication and addition where
//! they can.
//!
//! In f32 two measures keep what f64 would show: offsets are taken from the view's centre in f64,
//! so zoom costs nothing, and each tile subtracts a constant displacement, which the partition of
//! unity reproduces, before weights and displacements are multiplied.

mod band;
mod collapse;
mod finish;
mod gather;
mod layout;
mod mesh;
mod patch_sums;
mod plan;
mod schedule;
mod spans;
mod sums;
mod sweep;
mod tile;
mod view_data;
mod weights;

use std::ops::Range;

use ppum::field::Field;
use ppum::progress::{Cancelled, Watcher};
use ppum::quantity::{Quantity, Source};
use ppum::real::LaneNumber;
use rayon::prelude::*;

use crate::error::RasterError;
use crate::parts::Parts;
use crate::raster::{Raster, RasterValue, SampleSlice, zeros};
use crate::rows::RowBatches;
use crate::summation::Summation;
use crate::view::View;
use band::Band;
use collapse::ROWS;
use plan::band_batches;
use tile::TileScratch;
use view_data::PreparedView;

pub use crate::rows::BAND;
pub use schedule::{Schedule, TileLoad};

/// The values of a quantity at the pixel centres of a view, computed in `T` = f64 or f32 on the
/// threads of the pool that calls.
///
/// Pixels outside the domain are NaN; quantities of the gradient are +∞ at a crack tip. On a crack
/// the side above is taken. f32 keeps some 5 digits of a stress; a view whose pixels are too small
/// for squares of f32 is computed in f64.
///
/// The watcher hears of every band of 32 rows.
///
/// # Errors
/// [`RasterError::Cancelled`] if the watcher stops the call;
/// [`QuantityError::Patch`](ppum::quantity::QuantityError::Patch) for the partition function of a
/// patch that does not exist; [`QuantityError::NoExact`](ppum::quantity::QuantityError::NoExact)
/// for the error of a field whose exact solution is not known.
pub fn render<T: RasterValue>(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    watcher: &dyn Watcher,
) -> Result<Raster<T>, RasterError> {
    render_with(field, view, quantity, Summation::Automatic, watcher)
}

/// The values of [`render`] by a given summation, for tests and measurements. They differ from
/// those of other summations by rounding alone.
///
/// # Errors
/// Those of [`render`].
pub fn render_with<T: RasterValue>(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    summation: Summation,
    watcher: &dyn Watcher,
) -> Result<Raster<T>, RasterError> {
    let mut values = Vec::new();
    let batches = RowBatches::whole(view, view.pixels[1]);
    T::render_batches(field, view, quantity, summation, batches, watcher, &mut |v| values = v)?;
    Ok(Raster::new(view.pixels, values))
}

/// The values of [`render`] at some rows, to the last bit, for callers that share the rows of a
/// view among processes.
///
/// # Errors
/// Those of [`render`].
///
/// # Panics
/// If the first row is no multiple of [`BAND`], or the view does not have the last one.
pub fn render_rows<T: RasterValue>(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    rows: Range<u32>,
    watcher: &dyn Watcher,
) -> Result<Vec<T>, RasterError> {
    let is_whole = rows.start.is_multiple_of(BAND) && rows.end <= view.pixels[1];
    assert!(is_whole, "rows {rows:?} do not begin at a band, or are not in the view");
    let (mut values, height) = (Vec::new(), rows.len() as u32);
    let (batches, summation) = (RowBatches::new(rows, height), Summation::Automatic);
    T::render_batches(field, view, quantity, summation, batches, watcher, &mut |v| values = v)?;
    Ok(values)
}

/// The values of [`render`], to the last bit, a batch at a time, for views of more pixels than are
/// to be held at once: `take` is given the values of the batches from the top, each of `rows` rows,
/// rounded up to whole bands of 32, except for the last one.
///
/// # Errors
/// Those of [`render`].
pub fn render_batches<T: RasterValue>(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    rows: u32,
    watcher: &dyn Watcher,
    take: &mut dyn FnMut(Vec<T>),
) -> Result<(), RasterError> {
    let batches = RowBatches::whole(view, rows);
    T::render_batches(field, view, quantity, Summation::Automatic, batches, watcher, take)
}

macro_rules! sample {
    ($t:ty, $kind:ident, $same:expr) => {
        impl RasterValue for $t {
            const SAME: f64 = $same;

            fn sample_slice(values: &[Self]) -> SampleSlice<'_> {
                SampleSlice::$kind(values)
            }

            fn render_batches(
                field: &Field<'_>,
                view: &View,
                quantity: &Quantity,
                summation: Summation,
                batches: RowBatches,
                watcher: &dyn Watcher,
                take: &mut dyn FnMut(Vec<Self>),
            ) -> Result<(), RasterError> {
                quantity.check(field)?;
                let narrowed =
                    &mut |wide: Vec<f64>| take(wide.into_iter().map(<$t>::from_f64).collect());
                if field.step.partition.mesh().is_some() {
                    return mesh::render_batches(
                        field, view, quantity, &batches, watcher, narrowed,
                    );
                }
                if !resolves::<$t>(view.pixel_size()) {
                    return f64::render_batches(
                        field, view, quantity, summation, batches, watcher, narrowed,
                    );
                }
                let scene = PreparedView::<$t>::new(field, view, quantity, summation);
                match quantity.source() {
                    Source::Gradient => scene.draw::<1>(&batches, watcher, take)?,
                    _ => scene.draw::<0>(&batches, watcher, take)?,
                }
                Ok(())
            }
        }
    };
}

sample!(f64, Double, 1e-12);
sample!(f32, Single, 32.0 * f32::EPSILON as f64);

/// True if the square of a hundredth of a length is a normal number of `T`, so that distances to a
/// tip neither underflow nor overflow.
fn resolves<T: LaneNumber>(length: f64) -> bool {
    let square = (0.01 * length) * (0.01 * length);
    (T::from_f64(square).to_f64() / square - 1.0).abs() < 1e-6 || T::VECTOR == f64::VECTOR
}

impl<T: RasterValue> PreparedView<'_, T> {
    /// Draws with `D` derivatives, a batch at a time, whose rows `take` is given in order; bands of
    /// rows in parallel.
    fn draw<const D: usize>(
        &self,
        rows: &RowBatches,
        watcher: &dyn Watcher,
        take: &mut dyn FnMut(Vec<T>),
    ) -> Result<(), Cancelled> {
        let columns = self.view.pixels[0] as usize;
        let parts = Parts::start(watcher, rows.bands())?;
        let entries = self.plan.entries_of_bands();
        for rows in rows.each() {
            let mut values = zeros(columns * rows.len());
            let mut rest = values.as_mut_slice();
            for bands in band_batches(rows.start / ROWS..rows.end.div_ceil(ROWS), &entries) {
                let pixels = rest.len().min(bands.len() * columns * ROWS);
                let (batch, later) = rest.split_at_mut(pixels);
                self.draw_batch::<D>(bands, batch, &parts)?;
                rest = later;
            }
            take(values);
        }
        Ok(())
    }

    fn draw_batch<const D: usize>(
        &self,
        bands: Range<usize>,
        batch: &mut [T],
        parts: &Parts<'_>,
    ) -> Result<(), Cancelled> {
        let tiles = &self.plan.tiles(&bands);
        let chunks = batch.par_chunks_mut(self.view.pixels[0] as usize * ROWS).enumerate();
        chunks.try_for_each_init(TileScratch::default, |scratch, (k, out)| {
            let (scene, band) = (self, bands.start + k);
            T::dispatch(Band::<'_, '_, T, D> { scene, tiles, band, scratch, out: &mut *out });
            self.clear_outside(band * ROWS, out);
            self.clear_holes(band * ROWS, out);
            parts.finish_one()
        })
    }

    /// Sets the pixels outside the domain's box to NaN.
    fn clear_outside(&self, first_row: usize, out: &mut [T]) {
        let [columns, rows] = &self.plan.inside;
        let nan = T::from_f64(f64::NAN);
        for (k, line) in out.chunks_exact_mut(self.view.pixels[0] as usize).enumerate() {
            if rows.contains(&(first_row + k)) && !columns.is_empty() {
                line[..columns.start].fill(nan);
                line[columns.end..].fill(nan);
            } else {
                line.fill(nan);
            }
        }
    }

    /// Sets the pixels in holes to NaN.
    fn clear_holes(&self, first_row: usize, out: &mut [T]) {
        let width = self.view.pixels[0] as usize;
        for seen in &self.plan.holes {
            let rows = seen.rows.start.max(first_row)..seen.rows.end.min(first_row + ROWS);
            for row in rows {
                let line = &mut out[(row - first_row) * width..][..width];
                let hole = seen.hole.at_height(self.view.offset(0, row as u32).y);
                for column in seen.columns.clone() {
                    let offset = self.view.offset(column as u32, row as u32);
                    // holes may lie over each other
                    if !line[column].to_f64().is_nan() && hole.contains(offset) {
                        line[column] = T::from_f64(f64::NAN);
                    }
                }
            }
        }
    }
}
