//! Places of the plate at which a quantity has no value.

use ppum::field::Field;
use ppum_render::raster::{Raster, Sample};
use ppum_render::view::View;
use rayon::prelude::*;

/// The number of pixels of the plate without a value, and of all of them.
pub(crate) fn pixels<T: Sample>(raster: &Raster<T>, field: &Field<'_>, view: &View) -> [usize; 2] {
    let local = field.domain.at(view.center);
    let is_undefined = |row: u32, column: u32| {
        let value: f64 = raster.value(column, row).into();
        value.is_nan() && local.contains(view.offset(column, row))
    };
    let [columns, rows] = raster.size;
    let in_row = |row| (0..columns).filter(|&column| is_undefined(row, column)).count();
    let undefined: usize = (0..rows).into_par_iter().map(in_row).sum();
    [undefined, undefined + raster.values.len() - raster.statistics().undefined]
}

/// That a quantity has no value at some of the `things` of the plate.
pub(crate) fn message(name: &str, [undefined, all]: [usize; 2], things: &str) -> String {
    let count =
        if undefined == all { format!("all {all}") } else { format!("{undefined} of {all}") };
    format!(
        "`{name}` has no value at {count} {things} of the plate: it is not defined there, as 0/0 and roots and \
         logarithms of negative numbers are not"
    )
}
