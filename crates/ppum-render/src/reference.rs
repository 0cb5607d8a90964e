//! The reference renderer: one scalar evaluation a pixel, slow and plain.

use ppum::crack::Side;
use ppum::field::Field;
use ppum::quantity::{Quantity, QuantityError};
use rayon::prelude::*;

use crate::raster::Raster;
use crate::view::View;

/// The values of a quantity at the pixel centres of a view by [`Quantity::at`], the evaluation all
/// others are compared with. Arguments and values are those of [`render`](crate::scatter::render).
///
/// # Errors
/// As for [`render`](crate::scatter::render).
pub fn reference(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
) -> Result<Raster<f64>, QuantityError> {
    quantity.check(field)?;
    let row = |j| {
        let mut local = field.at(view.center);
        (0..view.pixels[0])
            .map(|i| quantity.at(&mut local, view.offset(i, j), Side::Above))
            .collect::<Vec<_>>()
    };
    Ok(Raster::new(view.pixels, (0..view.pixels[1]).into_par_iter().flat_map_iter(row).collect()))
}
