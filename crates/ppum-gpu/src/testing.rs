//! What tests look at without a graphics device.

use ppum::field::Field;
use ppum::quantity::Quantity;

use crate::bodies::Bodies;
use crate::groups::Groups;
use crate::lattice::Lattice;
use crate::program::{Method, Output, Program};
use crate::renderer::RenderError;
use crate::scene::SceneLayout;

/// The texts of all shaders that draw a quantity of a field.
///
/// # Errors
/// As [`Renderer::compile`](crate::Renderer::compile).
pub fn texts(
    field: &Field<'_>,
    quantity: &Quantity,
    method: Method,
    output: Output,
) -> Result<Vec<String>, RenderError> {
    quantity.check(field)?;
    let groups = Groups::new(&field.step.functions);
    let lattice = Lattice::of(&field.step.partition);
    let layout = SceneLayout::new(field, Bodies::new(field, &groups).shape, lattice.is_some());
    Ok(Program::new(&groups, field, quantity, method, output)?.texts(layout))
}
