//! A quantity compiled for the card.

pub(crate) mod output;
mod pipeline;
pub(crate) mod pipelines;

use std::sync::Arc;

use ppum::quantity::Quantity;

use crate::device::Gpu;
use crate::error::{GpuError, RenderError};
use crate::frame::shading::TransferFunction;
use crate::scene::bodies::Others;
use crate::scene::{Scene, SceneLayout};
use crate::shader::compose::{ShaderText, ShaderVariant};
use crate::shader::passes::Method;
use output::{Colors, Output};
use pipelines::Pipelines;

/// A quantity of a scene compiled for the card, returned by
/// [`Renderer::compile`](crate::Renderer::compile). It yields `O`: [`Values`](crate::Values) or
/// [`Colors`].
///
/// When functions of the dataset are replaced, upload the new field and compile another program;
/// this one keeps drawing the old ones.
///
/// The type of an image is that of its program's output; reading another type does not compile:
///
/// ```compile_fail
/// use ppum_gpu::{Colors, QueuedOutput};
/// use ppum_render::raster::Raster;
///
/// fn values(queued: &QueuedOutput<Colors>) -> Raster<f32> {
///     queued.read().unwrap() // an image
/// }
/// ```
#[derive(Debug)]
pub struct Program<'f, O> {
    scene: Scene<'f>,
    output: O,
    shader: ShaderText,
    pipelines: Option<Pipelines>,
}

impl<'f, O: Output> Program<'f, O> {
    /// Composes the program; pipelines are made when they are needed.
    pub(crate) fn new(scene: &Scene<'f>, output: O, method: Method) -> Result<Self, RenderError> {
        let (scene, field) = (scene.clone(), scene.field());
        let quantity = output.quantity();
        quantity.check(field)?;
        let shader = ShaderText::new(scene.groups(), field, &quantity, method, O::FINISH)?;
        Ok(Self { scene, output, shader, pipelines: None })
    }

    /// The scene that is drawn.
    #[must_use]
    pub fn scene(&self) -> &Scene<'f> {
        &self.scene
    }

    /// The output at a pixel.
    #[must_use]
    pub fn output(&self) -> &O {
        &self.output
    }

    /// The method by which the patches of a pixel are combined.
    #[must_use]
    pub fn method(&self) -> Method {
        self.shader.method()
    }

    /// The shader variant for areas whose patches have these terms.
    pub(crate) fn kind(&self, others: Others) -> ShaderVariant {
        self.shader.kind(others)
    }

    /// The patch whose φ is drawn.
    pub(crate) fn drawn_patch(&self) -> Option<u32> {
        match self.output.quantity() {
            Quantity::PartitionFunction(patch) => Some(patch),
            _ => None,
        }
    }

    /// The number of pipelines that are compiled.
    #[cfg(test)]
    pub(crate) fn n_compiled(&self) -> usize {
        self.pipelines.as_ref().map_or(0, |pipelines| pipelines.finish.len())
    }

    /// The pipelines for the scene's present layout, including those of some kinds of areas. Each
    /// is compiled on first use.
    pub(crate) fn pipelines(
        &mut self,
        gpu: &Arc<Gpu>,
        layout: SceneLayout,
        kinds: impl IntoIterator<Item = ShaderVariant>,
    ) -> Result<&Pipelines, GpuError> {
        let pipelines = match self.pipelines.take() {
            Some(pipelines) if pipelines.fit(gpu, layout) => pipelines,
            _ => Pipelines::new(gpu, &self.shader, layout)?,
        };
        // compiled pipelines are kept even if another one fails to compile
        let pipelines = self.pipelines.insert(pipelines);
        pipelines.make_areas(&self.shader, kinds)?;
        Ok(pipelines)
    }
}

impl Program<'_, Colors> {
    /// Draws with another transfer function from now on. Nothing is compiled.
    pub fn shade(&mut self, shading: TransferFunction) {
        self.output.shading = shading;
    }
}
