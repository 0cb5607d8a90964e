//! Fields on meshes: the element that holds a pixel's centre, and the field there, tile by tile.

use ppum::crack::Side;
use ppum::field::{Field, LocalField};
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use ppum::vec2::Vec2;
use rayon::prelude::*;

use super::collapse::ROWS;
use crate::error::RenderError;
use crate::parts::Parts;
use crate::rows::Strips;
use crate::view::View;

/// Columns and rows of a tile: its pixels share the elements that are looked at.
const TILE: usize = 16;

/// Evaluates some bands of rows at a time, seen from the view's centre, and gives `take` their
/// values in order.
pub(super) fn render_strips(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    strips: &Strips,
    watcher: &dyn Watcher,
    take: &mut dyn FnMut(Vec<f64>),
) -> Result<(), RenderError> {
    let columns = view.pixels[0] as usize;
    let parts = Parts::start(watcher, strips.bands())?;
    let seen = field.at(view.center);
    for rows in strips.each() {
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
    let rows = pixels.len() / columns;
    let corners =
        (0..rows).step_by(TILE).flat_map(|j| (0..columns).step_by(TILE).map(move |i| (i, j)));
    for (left, top) in corners {
        let (right, bottom) = ((left + TILE).min(columns), (top + TILE).min(rows));
        let places = (top..bottom).flat_map(|j| (left..right).map(move |i| (i, j)));
        let offset = |(i, j): (usize, usize)| view.offset(i as u32, (first + j) as u32);
        let offsets: Vec<Vec2> = places.clone().map(offset).collect();
        let quantities = std::slice::from_ref(quantity);
        let found = Quantity::at_many(quantities, local, &offsets, Side::Above);
        places.zip(found).for_each(|((i, j), value)| pixels[j * columns + i] = value);
    }
}
