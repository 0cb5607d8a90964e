//! The reference renderer: one scalar evaluation a pixel, slow and plain.

use ppum::crack::Side;
use ppum::field::{Field, LocalField};
use ppum::jet::Jet;
use ppum::quantity::{Quantity, QuantityError, Source};
use ppum::vec2::Vec2;
use rayon::prelude::*;

use crate::raster::Raster;
use crate::scatter::{Exact, check};
use crate::view::View;

/// The values of a quantity at the pixel centres of a view by [`LocalField::evaluate`], the
/// evaluation all others are compared with. Arguments and values are those of
/// [`render`](crate::scatter::render).
///
/// # Errors
/// As for [`render`](crate::scatter::render).
pub fn reference(
    field: &Field,
    view: &View,
    quantity: Quantity,
    exact: Option<Exact>,
) -> Result<Raster<f64>, QuantityError> {
    check(field, quantity, exact)?;
    let row = |j| {
        let mut local = field.at(view.center);
        (0..view.pixels[0])
            .map(|i| value(&mut local, view.offset(i, j), quantity, exact))
            .collect::<Vec<_>>()
    };
    Ok(Raster::new(view.pixels, (0..view.pixels[1]).into_par_iter().flat_map_iter(row).collect()))
}

/// The quantity at one point; NaN outside the domain.
fn value(local: &mut LocalField, offset: Vec2, quantity: Quantity, exact: Option<Exact>) -> f64 {
    let components = local.field.components();
    let mut jets = vec![Jet::constant(0.0); components];
    let Some(covering) = local.evaluate::<1>(offset, Side::Above, &mut jets) else {
        return f64::NAN;
    };
    match (quantity, quantity.source()) {
        (Quantity::PartitionFunction(patch), _) => {
            local.partition_function::<0>(patch as usize, offset).v
        }
        (_, Source::Partition) => quantity.of_covering(&covering),
        _ => {
            let mut values = vec![0.0; components];
            if let Some(exact) = exact {
                exact(local.anchor + offset, &mut values);
            }
            quantity.of_field(&local.field.equation, &jets, &values)
        }
    }
}
