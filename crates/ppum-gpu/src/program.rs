//! Shaders composed of their parts, and the pipelines made of them.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use ppum::field::Field;
use ppum::formula::wgsl_prelude;
use ppum::quantity::{Quantity, Source};
use wgpu::{
    BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry, BindingType, BlendComponent,
    BlendFactor, BlendOperation, BlendState, BufferBindingType, ColorTargetState, ColorWrites,
    RenderPipeline, ShaderStages, TextureFormat, TextureSampleType, TextureViewDimension,
    VertexAttribute, VertexBufferLayout, VertexFormat, VertexStepMode,
};

use crate::bins;
use crate::bodies::{self, Components, Others};
use crate::color::PALETTE_TEXELS;
use crate::device::Gpu;
use crate::error::GpuError;
use crate::functions::{Surroundings, functions_wgsl};
use crate::geometry;
use crate::groups::{Groups, SMOOTH_GROUP};
use crate::lattice::NO_PATCH;
use crate::layout::structure;
use crate::quads::{QUAD_BYTES, QuadRecord};
use crate::quantity::{order_of, quantity_wgsl};
use crate::region::record_quads;
use crate::scene::{SceneLayout, TEXELS};
use crate::seen::ViewRecord;
use crate::shader;
use crate::smooth::{four_constants, straight_smooth};
use crate::weight::weight_wgsl;

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

/// Texts and numbers a program is made of.
#[derive(Clone, Debug)]
struct Parts {
    /// Derivatives: 0, 1 or 2.
    order: u32,
    /// False for quantities of the partition alone.
    has_field: bool,
    /// The step has a smooth part.
    has_smooth: bool,
    /// True for the φ of a patch.
    has_part: bool,
    /// Weight, functions, quantity.
    formulas: String,
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
    pairs: u32,
    /// Slots of each of them.
    per_pair: u32,
    /// Textures for S and its derivatives: two if there are second ones, or φ of a patch is wanted.
    pub(crate) weights: u32,
}

/// The slots that one pass writes, those of one pair of components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct FieldPass {
    pub(crate) pair: u32,
    /// Its first slot among those of the pair.
    first: u32,
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

    fn entry(self) -> &'static str {
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
    const NONE: Self = Self { pair: 0, first: 0, slots: 1 };

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

/// Weight, functions and quantity of a field in WGSL.
fn formulas(
    groups: &Groups,
    field: &Field<'_>,
    quantity: &Quantity,
    order: u32,
) -> Result<String, GpuError> {
    let step = field.step;
    let surroundings =
        Surroundings { cracks: step.cracks.len(), tables: field.tables, order: order as usize };
    Ok([
        wgsl_prelude().to_owned(),
        weight_wgsl(&step.partition.weight)?,
        functions_wgsl(&step.functions, groups, surroundings)?,
        quantity_wgsl(field, quantity)?,
    ]
    .concat())
}

impl Parts {
    fn slots(&self, layout: SceneLayout) -> Slots {
        let pairs = if self.has_field { layout.components.count.div_ceil(2) as u32 } else { 0 };
        let weights = if self.order >= 2 || self.has_part { 2 } else { 1 };
        Slots { pairs, per_pair: self.order + 1, weights }
    }

    /// The whole text of a shader; `pass` is what it splats.
    fn text(&self, layout: SceneLayout, method: Method, output: Output, pass: FieldPass) -> String {
        let mut text = self.constants(layout);
        text += &types(layout);
        text += &structure("View", ViewRecord::MEMBERS, |_| String::new());
        text += BINDINGS;
        text += &self.smooth(layout);
        text += &geometry::constants();
        let parts = [shader::LOAD, shader::PIXEL, shader::PATCH, shader::FINISH];
        text.extend(shader::POINT_FUNCTIONS.map(|(_, text)| text).into_iter().chain(parts));
        text += &self.formulas;
        text += match output {
            Output::Values => "",
            Output::Colors => shader::COLOR,
            Output::Component(_) => shader::COMPONENT,
        };
        text += &match method {
            Method::Gather => gather_text(layout.is_lattice),
            Method::Splat => self.splat_text(layout, pass),
        };
        text + &palette_binding(match method {
            Method::Gather => 0,
            Method::Splat => self.slots(layout).all(),
        })
    }

    /// What evaluates smooth terms, and reads constants.
    fn smooth(&self, layout: SceneLayout) -> String {
        let Components { lanes, groups, .. } = layout.components;
        let smooth = match layout.shape.degree {
            Some(degree) if groups == 1 => straight_smooth(degree.into(), lanes, self.order),
            _ => shader::SMOOTH.to_owned(),
        };
        smooth + &four_constants(lanes, groups)
    }

    fn constants(&self, layout: SceneLayout) -> String {
        let SceneLayout {
            components, shape, own_frames, has_holes, has_kinks, has_long_lists, ..
        } = layout;
        let mut text = String::new();
        for (name, value) in [
            ("ORDER", self.order),
            ("COMPONENTS", components.count as u32),
            ("LANES", components.lanes as u32),
            ("LANE_PAIRS", components.lanes as u32 / 2),
            ("GROUPS", components.groups as u32),
            ("RECORD_QUADS", record_quads(own_frames)),
            ("TEXELS", TEXELS),
            ("INNER", bins::INNER),
            ("NO_PATCH", NO_PATCH),
            ("SMOOTH_GROUP", SMOOTH_GROUP),
            ("GROUP_BITS", bodies::GROUP_BITS),
            ("ABSENT", bodies::ABSENT),
            ("ALL_ABSENT", u32::MAX),
            ("PALETTE", PALETTE_TEXELS),
            ("LOG", crate::color::LOG),
            ("SYMLOG", crate::color::SYMLOG),
        ] {
            let _ = writeln!(text, "const {name}: u32 = {value}u;");
        }
        for (name, value) in [
            ("OWN_FRAMES", own_frames),
            ("HAS_FIELD", self.has_field),
            ("HAS_SMOOTH", self.has_smooth),
            ("HAS_PART", self.has_part),
            ("HAS_HOLES", has_holes),
            ("HAS_KINKS", has_kinks),
            ("HAS_LONG_LISTS", has_long_lists),
            ("HAS_CONSTANTS", shape.others.constants),
            ("HAS_POLYNOMIALS", shape.others.polynomials),
        ] {
            let _ = writeln!(text, "const {name}: bool = {value};");
        }
        text
    }

    /// What splatting has beside its file: targets, slots, textures.
    fn splat_text(&self, layout: SceneLayout, pass: FieldPass) -> String {
        let slots = self.slots(layout);
        let mut text = shader::SPLAT.to_owned();
        let location = |k| format!("@location({k}) ");
        text += &structure("Instance", QuadRecord::MEMBERS, location);
        let _ = writeln!(text, "const SLOTS: u32 = {}u;", slots.per_pair);
        let _ = writeln!(text, "const PAIR: u32 = {}u;", pass.pair);
        text += "fn sample_of(pixel: Pixel) -> Sample { return splatted(pixel); }\n";
        text += &targets("Weights", slots.weights);
        text += &weights_of(slots.weights);
        text += &targets("Fields", pass.slots);
        text += &fields_of(pass, layout.components.lanes);
        for k in 0..slots.weights {
            let _ = writeln!(text, "@group(1) @binding({k}) var weights_{k}: texture_2d<f32>;");
        }
        for k in 0..slots.count() {
            let binding = slots.weights + k;
            let _ = writeln!(text, "@group(1) @binding({binding}) var field_{k}: texture_2d<f32>;");
        }
        text + &field_slot(slots.count())
    }
}

/// `Lanes` and what belongs to it.
fn types(layout: SceneLayout) -> String {
    let lanes = layout.components.lanes;
    let (of, load, view) = if lanes == 2 {
        ("a", "lanes_from(load(at / 2u), at % 2u)", "load_view(at)")
    } else {
        (
            "vec4<f32>(a, b)",
            "bitcast<vec4<f32>>(load(at / 2u))",
            "vec4<f32>(load_view(at), load_view(at + 1u))",
        )
    };
    format!(
        "alias Lanes = vec{lanes}<f32>;
fn lanes_of(a: vec2<f32>, b: vec2<f32>) -> Lanes {{ return {of}; }}
fn lanes_from(quad: vec4<u32>, odd: u32) -> vec2<f32> {{
    return bitcast<vec2<f32>>(select(quad.xy, quad.zw, odd == 1u));
}}
fn load_lanes(at: u32) -> Lanes {{ return {load}; }}
fn view_lanes(at: u32) -> Lanes {{ return {view}; }}
struct Sample {{
    position: vec2<f32>,
    u: array<Jets, GROUPS>,
    weight_sum: f32,
    overlap: f32,
    part: f32,
}}
"
    )
}

/// The view, its data, the dataset's and the region's.
const BINDINGS: &str = "@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<storage, read> view_data: array<vec2<f32>>;
@group(0) @binding(2) var data: texture_2d<u32>;
@group(0) @binding(3) var places: texture_2d<u32>;
";

fn gather_text(is_lattice: bool) -> String {
    let bins = if is_lattice { shader::LATTICE } else { shader::BINS };
    let alias = "fn sample_of(pixel: Pixel) -> Sample { return gathered(pixel); }\n";
    [bins, shader::GATHER, alias].concat()
}

fn palette_binding(binding: u32) -> String {
    format!("@group(1) @binding({binding}) var palette: texture_2d<f32>;\n")
}

/// A structure of float targets.
fn targets(name: &str, count: u32) -> String {
    let member = |k| format!("    @location({k}) target_{k}: vec4<f32>,\n");
    let members: String = (0..count).map(member).collect();
    format!("struct {name} {{\n{members}}}\n")
}

/// What is summed of a weight, with the number of patches and the weight of the chosen one.
fn weights_of(count: u32) -> String {
    let (second, read) = if count == 2 {
        (", vec4<f32>(w.xx, w.xy, w.yy, part)", "textureLoad(weights_1, index, 0)")
    } else {
        ("", "vec4<f32>()")
    };
    format!(
        "fn weights_of(w: Jet, overlap: f32, part: f32) -> Weights {{
    return Weights(vec4<f32>(w.v, w.x, w.y, overlap){second});
}}
fn second_weights(index: vec2<u32>) -> vec4<f32> {{
    return {read};
}}
"
    )
}

/// What a pass writes of two components: slot 0 is value and x, slot 1 y and xx, slot 2 xy and yy.
fn fields_of(pass: FieldPass, lanes: usize) -> String {
    const PAIRS: [[&str; 2]; 3] = [["v", "x"], ["y", "xx"], ["xy", "yy"]];
    let part = if lanes == 4 && pass.pair % 2 == 1 { "zw" } else { "xy" };
    let slot = |k: u32| {
        let [a, b] = PAIRS[(pass.first + k) as usize];
        format!("vec4<f32>(u.{a}.{part}, u.{b}.{part})")
    };
    let all: Vec<String> = (0..pass.slots).map(slot).collect();
    format!("fn fields_of(u: Jets) -> Fields {{\n    return Fields({});\n}}\n", all.join(", "))
}

/// The texture of a slot; 0 for those of components there are not.
fn field_slot(count: u32) -> String {
    let mut text = "fn field_slot(slot: u32, index: vec2<u32>) -> vec4<f32> {\n".to_owned();
    for k in 0..count {
        let _ =
            writeln!(text, "    if slot == {k}u {{ return textureLoad(field_{k}, index, 0); }}");
    }
    text + "    return vec4<f32>();\n}\n"
}

fn data_layout(gpu: &Gpu) -> BindGroupLayout {
    let buffer = |ty| BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let texture = texture_type(TextureSampleType::Uint);
    let types = [
        buffer(BufferBindingType::Uniform),
        buffer(BufferBindingType::Storage { read_only: true }),
        texture,
        texture,
    ];
    let entries: Vec<_> = (0..).zip(types).map(|(binding, ty)| layout_entry(binding, ty)).collect();
    let descriptor = BindGroupLayoutDescriptor { label: Some("data"), entries: &entries };
    gpu.device().create_bind_group_layout(&descriptor)
}

fn texture_type(sample_type: TextureSampleType) -> BindingType {
    let view_dimension = TextureViewDimension::D2;
    BindingType::Texture { sample_type, view_dimension, multisampled: false }
}

/// A binding of fragments; the first, the view, of vertices too.
fn layout_entry(binding: u32, ty: BindingType) -> BindGroupLayoutEntry {
    let is_uniform = matches!(ty, BindingType::Buffer { ty: BufferBindingType::Uniform, .. });
    let both = ShaderStages::VERTEX_FRAGMENT;
    let visibility = if is_uniform { both } else { ShaderStages::FRAGMENT };
    BindGroupLayoutEntry { binding, visibility, ty, count: None }
}

/// A number of textures.
fn textures_layout(gpu: &Gpu, count: u32) -> BindGroupLayout {
    let ty = texture_type(TextureSampleType::Float { filterable: false });
    let entries: Vec<_> = (0..count).map(|binding| layout_entry(binding, ty)).collect();
    let descriptor = BindGroupLayoutDescriptor { label: Some("textures"), entries: &entries };
    gpu.device().create_bind_group_layout(&descriptor)
}

/// Makes the pipelines of a program.
struct Maker<'a> {
    gpu: &'a Gpu,
    made: &'a Made,
}

/// What differs from pipeline to pipeline.
struct Pass<'a> {
    text: &'a str,
    vertex: &'a str,
    fragment: &'a str,
    quads: bool,
    targets: Vec<Option<ColorTargetState>>,
    textures: Option<&'a BindGroupLayout>,
}

impl Maker<'_> {
    /// The pass that makes the output.
    fn finish(&self, output: Output, text: &str) -> Result<RenderPipeline, GpuError> {
        let target = |&format: &TextureFormat| Some(format.into());
        self.pipeline(&Pass {
            text,
            vertex: "cover",
            fragment: output.entry(),
            quads: false,
            targets: output.formats().iter().map(target).collect(),
            textures: Some(&self.made.textures),
        })
    }

    /// A pass that draws quads and adds up what they write.
    fn quads(
        &self,
        fragment: &str,
        text: &str,
        targets: u32,
        textures: Option<&BindGroupLayout>,
    ) -> Result<RenderPipeline, GpuError> {
        let add = BlendComponent {
            src_factor: BlendFactor::One,
            dst_factor: BlendFactor::One,
            operation: BlendOperation::Add,
        };
        let blend = Some(BlendState { color: add, alpha: add });
        let target = ColorTargetState { format: SUMS, blend, write_mask: ColorWrites::ALL };
        let targets = vec![Some(target); targets as usize];
        let vertex = "splat_quad";
        self.pipeline(&Pass { text, vertex, fragment, quads: true, targets, textures })
    }

    fn pipeline(&self, pass: &Pass<'_>) -> Result<RenderPipeline, GpuError> {
        let module = self.gpu.shader("compile the shader", pass.text)?;
        let device = self.gpu.device();
        let groups = [Some(&self.made.data), pass.textures];
        let attributes = attributes();
        let quads = [Some(VertexBufferLayout {
            array_stride: QUAD_BYTES,
            step_mode: VertexStepMode::Instance,
            attributes: &attributes,
        })];
        let strip = wgpu::PrimitiveTopology::TriangleStrip;
        let topology = if pass.quads { strip } else { wgpu::PrimitiveTopology::TriangleList };
        let compilation_options = wgpu::PipelineCompilationOptions {
            constants: &[],
            zero_initialize_workgroup_memory: false,
        };
        self.gpu.checked("make the pipeline", || {
            let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(pass.fragment),
                bind_group_layouts: &groups,
                immediate_size: 0,
            });
            device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(pass.fragment),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some(pass.vertex),
                    compilation_options: compilation_options.clone(),
                    buffers: if pass.quads { &quads } else { &[] },
                },
                primitive: wgpu::PrimitiveState { topology, ..Default::default() },
                depth_stencil: None,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(pass.fragment),
                    compilation_options,
                    targets: &pass.targets,
                }),
                multiview_mask: None,
                cache: None,
            })
        })
    }
}

/// The fields of a quad's record.
fn attributes() -> Vec<VertexAttribute> {
    let mut offset = 0;
    let attribute = |(location, (_, kind)): (u32, &(&str, &str))| {
        let format = match *kind {
            "vec2<f32>" => VertexFormat::Float32x2,
            "vec2<u32>" => VertexFormat::Uint32x2,
            _ => VertexFormat::Uint32,
        };
        let at = offset;
        offset += format.size();
        VertexAttribute { format, offset: at, shader_location: location }
    };
    (0..).zip(QuadRecord::MEMBERS).map(attribute).collect()
}
