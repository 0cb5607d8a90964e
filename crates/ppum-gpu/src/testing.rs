//! What tests look at without a graphics device.

use ppum::field::Field;
use ppum::quantity::Quantity;

use crate::bodies::Components;
use crate::groups::Groups;
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
    let layout = SceneLayout {
        components: Components::new(field.components()),
        own_frames: has_own_frames(field),
        chunks: [2, 1],
        chunk_pairs: 1 << 20,
    };
    Ok(Program::new(&groups, field, quantity, method, output)?.texts(layout))
}
