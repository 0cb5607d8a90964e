//! Texts for tests, which need no graphics device.

use ppum::field::Field;

use crate::error::RenderError;
use crate::program::output::Output;
use crate::scene::SceneLayout;
use crate::scene::bodies::Bodies;
use crate::scene::groups::FunctionGroups;
use crate::shader::compose::ShaderText;
use crate::shader::passes::Method;

/// The texts of all shaders that draw an output of a field.
///
/// # Errors
/// As [`Renderer::compile`](crate::Renderer::compile).
pub fn texts<O: Output>(
    field: &Field<'_>,
    output: &O,
    method: Method,
) -> Result<Vec<String>, RenderError> {
    let quantity = output.quantity();
    quantity.check(field)?;
    let groups = FunctionGroups::new(&field.step.functions);
    let (layout, ..) = SceneLayout::of_field(field, Bodies::new(field, &groups).shape);
    Ok(ShaderText::new(&groups, field, &quantity, method, O::FINISH)?.shaders(layout))
}
