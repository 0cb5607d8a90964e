//! Fields on meshes: the element that holds a pixel's centre, and the field there, pixel by pixel.

use ppum::crack::Side;
use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use rayon::prelude::*;

use super::collapse::ROWS;
use crate::error::RenderError;
use crate::parts::Parts;
use crate::view::View;

/// Evaluates some bands of rows at a time, seen from the view's centre, and gives `take` their values in order.
pub(super) fn render_strips(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    rows: u32,
    watcher: &dyn Watcher,
    take: &mut dyn FnMut(Vec<f64>),
) -> Result<(), RenderError> {
    let [columns, all] = view.pixels.map(|n| n as usize);
    let count = (rows as usize).next_multiple_of(ROWS).max(ROWS);
    let parts = Parts::start(watcher, all.div_ceil(ROWS))?;
    let seen = field.at(view.center);
    for first in (0..all).step_by(count) {
        let mut values = vec![f64::NAN; columns * count.min(all - first)];
        let bands = values.par_chunks_mut(columns * ROWS).enumerate();
        bands.try_for_each_init(
            || seen.clone(),
            |local, (band, pixels)| {
                for (k, value) in pixels.iter_mut().enumerate() {
                    let [i, j] = [k % columns, first + band * ROWS + k / columns];
                    let offset = view.offset(i as u32, j as u32);
                    *value = quantity.at(local, offset, Side::Above);
                }
                parts.finish_one()
            },
        )?;
        take(values);
    }
    Ok(())
}
