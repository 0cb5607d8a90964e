//! Fields on meshes: the element that holds a pixel's centre, and the field there, tile by tile.

use ppum::crack::Side;
use ppum::field::{Field, LocalField};
use ppum::mesh::grid::PointGrid;
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use rayon::prelude::*;

use super::collapse::ROWS;
use crate::error::RasterError;
use crate::parts::Parts;
use crate::rows::RowBatches;
use crate::view::View;

/// Columns of a tile, whose elements are looked at one after the other.
const TILE: usize = 128;

/// Evaluates some bands of rows at a time, seen from the view's centre, and gives `take` their
/// values in order.
pub(super) fn render_batches(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    batches: &RowBatches,
    watcher: &dyn Watcher,
    take: &mut dyn FnMut(Vec<f64>),
) -> Result<(), RasterError> {
    let columns = view.pixels[0] as usize;
    let parts = Parts::start(watcher, batches.bands())?;
    let seen = field.at(view.center);
    for rows in batches.each() {
        let mut values = vec![f64::NAN; columns * rows.len()];
        let bands = values.par_chunks_mut(columns * ROWS).enumerate();
        bands.try_for_each_init(
            || seen.clone(),
            |local, (band, pixels)| {
                draw_band(local, (view, quantity), rows.start + band * ROWS, pixels);
                parts.finish_one()
            },
        )?;
        take(values);
    }
    Ok(())
}

/// The pixels of some rows, the first of which has a number.
fn draw_band(
    local: &mut LocalField<'_>,
    (view, quantity): (&View, &Quantity),
    first: usize,
    pixels: &mut [f64],
) {
    let columns = view.pixels[0] as usize;
    let y: Vec<f64> =
        (0..pixels.len() / columns).map(|j| view.offset(0, (first + j) as u32).y).collect();
    let x: Vec<f64> = (0..columns).map(|i| view.offset(i as u32, 0).x).collect();
    for left in (0..columns).step_by(TILE) {
        let right = (left + TILE).min(columns);
        let grid = PointGrid { x: &x[left..right], y: &y };
        let values = quantity.on_grid(local, &grid, Side::Above);
        let rows = pixels.chunks_mut(columns).zip(values.chunks(right - left));
        rows.for_each(|(pixels, values)| pixels[left..right].copy_from_slice(values));
    }
}
