//! A quantity compiled for the card.

use std::collections::{BTreeMap, BTreeSet};

use ppum::field::Field;
use ppum::quantity::{Quantity, Source};
use wgpu::{BindGroupLayout, RenderPipeline, TextureFormat};

use crate::bodies::Others;
use crate::compose::{Parts, formulas};
use crate::device::Gpu;
use crate::error::GpuError;
use crate::groups::Groups;
use crate::pipeline::{Maker, data_layout, textures_layout};
use crate::quantity::order_of;
use crate::scene::SceneLayout;

/// How patches come together at a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// One pass: each pixel finds its patches and sums over them.
    Gather,
    /// The three passes of Üffinger et al. 2011: patches are drawn as quads and blended.
    Splat,
}

/// What is written at a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// The quantity's value.
    Values,
    /// The quantity's colour by a transfer function.
    Colors,
    /// Value, gradient and Hessian of a component of the field, whatever the quantity.
    Component(u8),
}

/// A quantity of a field compiled for the card: what [`Renderer::compile`](crate::Renderer::compile) makes.
///
/// Where functions of the dataset are replaced, compile another program and go on drawing the scene.
#[derive(Debug)]
pub struct Program {
    pub(crate) method: Method,
    pub(crate) output: Output,
    /// The patch whose φ is drawn.
    pub(crate) chosen: Option<u32>,
    /// Everything of the text that does not depend on the scene's layout.
    parts: Parts,
    made: Option<Made>,
}

/// The pipelines for a device and the layout of a scene.
#[derive(Debug)]
pub(crate) struct Made {
    generation: u64,
    layout: SceneLayout,
    /// Group 0: the view, the dataset, the region.
    pub(crate) data: BindGroupLayout,
    /// Group 1 where fields are splatted: the sums of weights.
    pub(crate) sums: BindGroupLayout,
    /// Group 1 of the last pass: what was splatted, and the palette.
    pub(crate) textures: BindGroupLayout,
    /// Splatting: weights, and a pass for each pair of components and slots.
    pub(crate) weights: Option<RenderPipeline>,
    pub(crate) fields: Vec<RenderPipeline>,
    /// The last pass; of gathering one for each kind of area.
    pub(crate) finish: BTreeMap<Others, RenderPipeline>,
    pub(crate) slots: Slots,
}

/// The float textures that splatting adds fields into, called slots: two numbers of two components each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slots {
    /// Pairs of components.
    pub(crate) pairs: u32,
    /// Slots of each of them.
    pub(crate) per_pair: u32,
    /// Textures for S and its derivatives: two if there are second ones, or φ of a patch is wanted.
    pub(crate) weights: u32,
}

/// The slots that one pass writes, those of one pair of components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct FieldPass {
    pub(crate) pair: u32,
    /// Its first slot among those of the pair.
    pub(crate) first: u32,
    pub(crate) slots: u32,
}

/// Slots that one pass writes: 32 bytes a pixel, what WebGPU promises.
const SLOTS_PER_PASS: u32 = 2;

/// Sampled textures that WebGPU promises to a shader.
const MOST_TEXTURES: u32 = 16;

/// The format of what is added up.
pub(crate) const SUMS: TextureFormat = TextureFormat::Rgba32Float;

impl Output {
    /// Formats of the textures that are written.
    pub(crate) fn formats(self) -> &'static [TextureFormat] {
        match self {
            Self::Values => &[TextureFormat::R32Float],
            Self::Colors => &[TextureFormat::Rgba8Unorm],
            Self::Component(_) => &[SUMS, SUMS],
        }
    }

    /// The function of the shader that writes it.
    pub(crate) fn entry(self) -> &'static str {
        match self {
            Self::Values => "draw_value",
            Self::Colors => "draw_color",
            Self::Component(_) => "draw_component",
        }
    }
}

impl Program {
    /// Composes the program; pipelines are made when they are needed.
    pub(crate) fn new(
        groups: &Groups,
        field: &Field<'_>,
        quantity: &Quantity,
        method: Method,
        output: Output,
    ) -> Result<Self, GpuError> {
        let order = match output {
            Output::Component(_) => 2,
            Output::Values | Output::Colors => order_of(quantity),
        };
        let has_field =
            matches!(output, Output::Component(_)) || quantity.source() != Source::Partition;
        let formulas = formulas(groups, field, quantity, order)?;
        let chosen = match quantity {
            Quantity::PartitionFunction(patch) => Some(*patch),
            _ => None,
        };
        let has_smooth = groups.has_smooth();
        let parts = Parts { order, has_field, has_smooth, has_part: chosen.is_some(), formulas };
        Ok(Self { method, output, chosen, parts, made: None })
    }

    /// All texts that are compiled for a scene: that of the last pass, then those of splatting.
    pub(crate) fn texts(&self, layout: SceneLayout) -> Vec<String> {
        let text = |pass| self.parts.text(layout, self.method, self.output, pass);
        let passes = self.parts.slots(layout).passes().filter(|_| self.method == Method::Splat);
        let areas = self.kinds(layout).into_iter().map(|others| {
            let layout = layout.with(others);
            self.parts.text(layout, self.method, self.output, FieldPass::NONE)
        });
        areas.chain(passes.map(text)).collect()
    }

    /// The kinds of areas that are told apart.
    fn kinds(&self, layout: SceneLayout) -> Vec<Others> {
        let all = layout.shape.others;
        if self.method == Method::Splat {
            return vec![all];
        }
        let both = [false, true];
        let kinds = both
            .into_iter()
            .flat_map(|constants| both.map(|polynomials| Others { constants, polynomials }));
        kinds.filter(|kind| kind.and(all) == all).collect()
    }

    /// The pipelines for a scene as it is, those of some kinds of areas among them: each is made when it is
    /// needed first.
    pub(crate) fn made(
        &mut self,
        gpu: &Gpu,
        generation: u64,
        layout: SceneLayout,
        areas: &BTreeSet<Others>,
    ) -> Result<&Made, GpuError> {
        let fits = |made: &Made| made.generation == generation && made.layout == layout;
        let mut made = match self.made.take() {
            Some(made) if fits(&made) => made,
            _ => self.make(gpu, generation, layout)?,
        };
        let result = self.make_areas(gpu, &mut made, areas);
        // what is made stays, also if something else cannot be
        let made = self.made.insert(made);
        result.map(|()| &*made)
    }

    /// Makes the pipelines of areas that are missing.
    fn make_areas(
        &self,
        gpu: &Gpu,
        made: &mut Made,
        areas: &BTreeSet<Others>,
    ) -> Result<(), GpuError> {
        for &others in areas {
            if !made.finish.contains_key(&others) {
                let layout = made.layout.with(others);
                let text = self.parts.text(layout, self.method, self.output, FieldPass::NONE);
                let pipeline = made.maker(gpu).finish(self.output, &text)?;
                made.finish.insert(others, pipeline);
            }
        }
        Ok(())
    }

    fn make(&self, gpu: &Gpu, generation: u64, layout: SceneLayout) -> Result<Made, GpuError> {
        let slots = self.parts.slots(layout);
        if self.method == Method::Splat {
            check_splat(gpu, slots)?;
        }
        let sums = if self.method == Method::Splat { slots.all() } else { 0 };
        let [data, weights, textures] = gpu.checked("describe the bindings", || {
            let weights = textures_layout(gpu, slots.weights);
            [data_layout(gpu), weights, textures_layout(gpu, sums + 1)]
        })?;
        let mut made = Made {
            generation,
            layout,
            data,
            sums: weights,
            textures,
            weights: None,
            fields: Vec::new(),
            finish: BTreeMap::new(),
            slots,
        };
        if self.method == Method::Splat {
            (made.weights, made.fields) = self.splat_passes(&made.maker(gpu), layout, slots)?;
        }
        Ok(made)
    }

    fn splat_passes(
        &self,
        maker: &Maker<'_>,
        layout: SceneLayout,
        slots: Slots,
    ) -> Result<(Option<RenderPipeline>, Vec<RenderPipeline>), GpuError> {
        let text = self.parts.text(layout, self.method, self.output, FieldPass::NONE);
        let weights = maker.quads("splat_weight", &text, slots.weights, None)?;
        let fields = slots.passes().map(|pass| {
            let text = self.parts.text(layout, self.method, self.output, pass);
            maker.quads("splat_field", &text, pass.slots, Some(&maker.made.sums))
        });
        Ok((Some(weights), fields.collect::<Result<_, _>>()?))
    }
}

impl Made {
    fn maker<'a>(&'a self, gpu: &'a Gpu) -> Maker<'a> {
        Maker { gpu, made: self }
    }
}

impl Slots {
    /// Their number.
    pub(crate) fn count(self) -> u32 {
        self.pairs * self.per_pair
    }

    /// All textures that the last pass adds up from.
    pub(crate) fn all(self) -> u32 {
        self.weights + self.count()
    }

    /// The passes that fill them.
    pub(crate) fn passes(self) -> impl Iterator<Item = FieldPass> {
        let firsts = move || (0..self.per_pair).step_by(SLOTS_PER_PASS as usize);
        let pass = move |pair, first| {
            let slots = SLOTS_PER_PASS.min(self.per_pair - first);
            FieldPass { pair, first, slots }
        };
        (0..self.pairs).flat_map(move |pair| firsts().map(move |first| pass(pair, first)))
    }
}

impl FieldPass {
    /// Something to write for a shader that splats no field.
    pub(crate) const NONE: Self = Self { pair: 0, first: 0, slots: 1 };

    /// Its first slot among all.
    pub(crate) fn first_slot(self, slots: Slots) -> u32 {
        self.pair * slots.per_pair + self.first
    }
}

fn check_splat(gpu: &Gpu, slots: Slots) -> Result<(), GpuError> {
    if !gpu.info().blends_floats {
        let name = &gpu.info().name;
        return Err(GpuError::Unsupported(format!(
            "splatting adds up 32-bit floats while drawing, which {name} does not; gather instead"
        )));
    }
    // beside the sums: the palette, the dataset's data, the region's
    if slots.all() + 3 > MOST_TEXTURES {
        let message = "splatting holds all components in textures, of which there are too few for \
             this field; gather instead";
        return Err(GpuError::Unsupported(message.to_owned()));
    }
    Ok(())
}
