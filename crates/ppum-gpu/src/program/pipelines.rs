//! The pipelines of a program, made when they are needed first.

use std::collections::BTreeMap;
use std::sync::Arc;

use wgpu::{BindGroupLayout, RenderPipeline};

use super::pipeline::{PipelineBuilder, data_layout, textures_layout};
use crate::device::Gpu;
use crate::error::GpuError;
use crate::scene::SceneLayout;
use crate::shader::compose::{ShaderText, ShaderVariant};
use crate::shader::passes::Slots;

/// Sampled textures that WebGPU promises to a shader.
const MOST_TEXTURES: u32 = 16;

/// Textures beside the sums: the palette, the dataset's data, the region's.
const OTHER_TEXTURES: u32 = 3;

/// The pipelines for a device and the layout of a scene.
#[derive(Debug)]
pub(crate) struct Pipelines {
    gpu: Arc<Gpu>,
    layout: SceneLayout,
    /// Group 0: the view, the dataset, the region.
    pub(crate) data: BindGroupLayout,
    /// Group 1 of the last pass: what was splatted, and the palette.
    pub(crate) textures: BindGroupLayout,
    /// The passes of splatting.
    pub(crate) passes: Option<SumPasses>,
    /// The last pass; of gathering one for each kind of area.
    pub(crate) finish: BTreeMap<ShaderVariant, RenderPipeline>,
}

/// The first passes of splatting.
#[derive(Debug)]
pub(crate) struct SumPasses {
    /// Group 1 where fields are splatted: the sums of weights.
    pub(crate) sums: BindGroupLayout,
    pub(crate) weights: RenderPipeline,
    /// One for each pair of components.
    pub(crate) fields: Vec<RenderPipeline>,
    pub(crate) slots: Slots,
}

impl Pipelines {
    /// The pipelines of all passes but the last.
    pub(crate) fn new(
        gpu: &Arc<Gpu>,
        shader: &ShaderText,
        layout: SceneLayout,
    ) -> Result<Self, GpuError> {
        let slots = shader.slots(layout);
        slots.map_or(Ok(()), |slots| check_sums(gpu, slots))?;
        let sums = slots.map_or(0, Slots::textures);
        let [data, textures] = gpu.checked("describe the bindings", || {
            [data_layout(gpu), textures_layout(gpu, sums + 1)]
        })?;
        let builder = PipelineBuilder { gpu, data: &data };
        let passes = |slots| SumPasses::new(builder, shader, layout, slots);
        let passes = slots.map(passes).transpose()?;
        Ok(Self { gpu: Arc::clone(gpu), layout, data, textures, passes, finish: BTreeMap::new() })
    }

    /// True if they are for this device and layout.
    pub(crate) fn fit(&self, gpu: &Arc<Gpu>, layout: SceneLayout) -> bool {
        Arc::ptr_eq(&self.gpu, gpu) && self.layout == layout
    }

    /// Makes those of areas that are missing.
    pub(crate) fn make_areas(
        &mut self,
        shader: &ShaderText,
        kinds: impl IntoIterator<Item = ShaderVariant>,
    ) -> Result<(), GpuError> {
        for kind in kinds {
            if !self.finish.contains_key(&kind) {
                let text = shader.finish(self.layout, kind);
                let builder = PipelineBuilder { gpu: &self.gpu, data: &self.data };
                let pipeline = builder.finish(shader.last_pass(), &text, &self.textures)?;
                self.finish.insert(kind, pipeline);
            }
        }
        Ok(())
    }

    /// Textures that patches are splatted into.
    pub(crate) fn sums(&self) -> usize {
        self.passes.as_ref().map_or(0, |passes| passes.slots.textures() as usize)
    }
}

impl SumPasses {
    fn new(
        builder: PipelineBuilder<'_>,
        shader: &ShaderText,
        layout: SceneLayout,
        slots: Slots,
    ) -> Result<Self, GpuError> {
        let gpu = builder.gpu;
        let sums = gpu.checked("describe the bindings", || textures_layout(gpu, 1))?;
        let weights = builder.quads("sum_weight", &shader.sum_pass(layout, 0), 1, None)?;
        let fields = (0..slots.pairs).map(|pair| {
            let text = shader.sum_pass(layout, pair);
            builder.quads("sum_field", &text, slots.per_pair, Some(&sums))
        });
        Ok(Self { weights, fields: fields.collect::<Result<_, _>>()?, sums, slots })
    }
}

fn check_sums(gpu: &Gpu, slots: Slots) -> Result<(), GpuError> {
    if !gpu.info().blends_floats {
        return Err(GpuError::NoBlending { adapter: gpu.info().name.clone() });
    }
    let needed = slots.textures() + OTHER_TEXTURES;
    if needed > MOST_TEXTURES {
        return Err(GpuError::TooFewTextures { needed, most: MOST_TEXTURES });
    }
    Ok(())
}
