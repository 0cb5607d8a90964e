//! What tests look at without a graphics device.

use ppum::field::Field;
use ppum::quantity::Quantity;

use crate::bodies::{Bodies, Components};
use crate::groups::Groups;
use crate::lattice::Lattice;
use crate::program::{Method, Output, Program};
use crate::region::has_own_frames;
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
    let own_frames = has_own_frames(field);
    let layout = SceneLayout {
        components: Components::new(field.components()),
        shape: Bodies::new(field, &groups).shape,
        is_lattice: !own_frames && Lattice::of(&field.step.partition).is_some(),
        own_frames,
        has_holes: !field.domain.holes.is_empty(),
    };
    Ok(Program::new(&groups, field, quantity, method, output)?.texts(layout))
}
