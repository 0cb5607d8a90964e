//! The reference renderer: one scalar evaluation per pixel, slow and plain.

use ppum::crack::Side;
use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use rayon::prelude::*;

use crate::error::RasterError;
use crate::parts::Parts;
use crate::raster::Raster;
use crate::view::View;

/// The values of a quantity at the pixel centres of a view by [`Quantity::at`], the evaluation all
/// others are compared with. Arguments and values are those of [`render`](crate::scatter::render).
///
/// The watcher hears of every row; the rows are spread over the threads of the pool that calls.
///
/// # Errors
/// As for [`render`](crate::scatter::render).
pub fn reference(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    watcher: &dyn Watcher,
) -> Result<Raster<f64>, RasterError> {
    quantity.check(field)?;
    let [columns, rows] = view.pixels;
    let parts = Parts::start(watcher, rows as usize)?;
    let mut values = vec![0.0; columns as usize * rows as usize];
    let lines = values.par_chunks_mut(columns as usize).enumerate();
    lines.try_for_each(|(j, line)| {
        let mut local = field.at(view.center);
        for (i, value) in (0..).zip(line) {
            *value = quantity.at(&mut local, view.offset(i, j as u32), Side::Above);
        }
        parts.finish_one()
    })?;
    Ok(Raster::new(view.pixels, values))
}
