//! The text of a shader, composed of its parts.

use std::collections::BTreeSet;
use std::fmt::Write;

use ppum::field::Field;
use ppum::formula::wgsl_prelude;
use ppum::quantity::{Quantity, Source};

use super::functions::{FormulaContext, functions_wgsl};
use super::passes::{Finish, Method, Slots};
use super::quantity::{order_of, quantity_wgsl};
use super::smooth::{factors, four_constants, straight_smooth};
use super::texts;
use super::weight::weight_wgsl;
use crate::error::GpuError;
use crate::frame::geometry;
use crate::frame::quads::QuadRecord;
use crate::frame::shading::{self, PALETTE_TEXELS};
use crate::frame::view_data::ViewRecord;
use crate::layout::structure;
use crate::scene::SceneLayout;
use crate::scene::bins;
use crate::scene::bodies::{self, ComponentLanes, Others};
use crate::scene::card::TEXELS;
use crate::scene::groups::{FunctionGroups, SMOOTH_GROUP};
use crate::scene::lattice::NO_PATCH;
use crate::scene::pages::page_texels;

/// The shaders of a program, except for the layout of the scene they are for.
#[derive(Clone, Debug)]
pub(crate) struct ShaderText {
    /// 1 if slopes are needed, else 0.
    order: u32,
    /// False for quantities of the partition alone.
    has_field: bool,
    /// The step has a smooth part.
    has_smooth: bool,
    /// True for the φ of a patch.
    has_part: bool,
    /// Weight, functions, quantity.
    formulas: String,
    /// The kernel of each group of functions.
    kernels: Vec<usize>,
    method: Method,
    last_pass: Finish,
}

/// The terms beside the smooth one that a shader is for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct ShaderVariant {
    constants: bool,
    polynomials: bool,
    /// The kernel of the one group of functions that all terms are of.
    kernel: Option<usize>,
}

/// Weight, functions and quantity of a field in WGSL, and the kernel of each group of functions.
fn formulas(
    groups: &FunctionGroups,
    field: &Field<'_>,
    quantity: &Quantity,
    order: u32,
) -> Result<(String, Vec<usize>), GpuError> {
    let step = field.step;
    let surroundings =
        FormulaContext { cracks: step.cracks.len(), tables: field.tables, order: order as usize };
    let (functions, kernels) = functions_wgsl(&step.functions, groups, surroundings)?;
    let weight = weight_wgsl(&step.partition.boxes().weight)?;
    let quantity = quantity_wgsl(field, quantity)?;
    Ok(([wgsl_prelude(), &weight, &functions, &quantity].concat(), kernels))
}

impl ShaderText {
    /// The shaders of a quantity of a field, with derivatives up to an order.
    pub(crate) fn new(
        groups: &FunctionGroups,
        field: &Field<'_>,
        quantity: &Quantity,
        method: Method,
        last_pass: Finish,
    ) -> Result<Self, GpuError> {
        let order = order_of(quantity);
        let (formulas, kernels) = formulas(groups, field, quantity, order)?;
        Ok(Self {
            order,
            has_field: quantity.source() != Source::Partition,
            has_smooth: groups.has_smooth(),
            has_part: matches!(quantity, Quantity::PartitionFunction(_)),
            formulas,
            kernels,
            method,
            last_pass,
        })
    }

    /// The way patches come together.
    pub(crate) fn method(&self) -> Method {
        self.method
    }

    /// The last pass.
    pub(crate) fn last_pass(&self) -> &Finish {
        &self.last_pass
    }

    /// All shaders that a scene may need: those of the last pass, then those of splatting.
    pub(crate) fn shaders(&self, layout: SceneLayout) -> Vec<String> {
        let kinds = self.kinds(layout).into_iter().map(|kind| self.finish(layout, kind));
        let pairs = self.slots(layout).map_or(0, |slots| slots.pairs);
        kinds.chain((0..pairs).map(|pair| self.sum_pass(layout, pair))).collect()
    }

    /// The shader of the last pass, in areas of a kind.
    pub(crate) fn finish(&self, layout: SceneLayout, kind: ShaderVariant) -> String {
        self.text(layout, kind, 0)
    }

    /// A shader of passes that splat: the weights, and a pair of components.
    pub(crate) fn sum_pass(&self, layout: SceneLayout, pair: u32) -> String {
        self.text(layout, self.kind(layout.shape.others), pair)
    }

    /// The kind of areas with these terms.
    pub(crate) fn kind(&self, others: Others) -> ShaderVariant {
        let Others { constants, polynomials, group } = others;
        let group = group.filter(|_| self.method == Method::Gather);
        ShaderVariant {
            constants,
            polynomials,
            kernel: group.map(|group| self.kernels[group as usize]),
        }
    }

    /// The kinds of areas that may be told apart.
    fn kinds(&self, layout: SceneLayout) -> BTreeSet<ShaderVariant> {
        let all = layout.shape.others;
        if self.method == Method::Splat {
            return [self.kind(all)].into();
        }
        let mut kinds = BTreeSet::new();
        for constants in [false, all.constants] {
            for polynomials in [false, all.polynomials] {
                kinds.insert(ShaderVariant { constants, polynomials, kernel: None });
            }
            let one =
                |&kernel| ShaderVariant { constants, polynomials: false, kernel: Some(kernel) };
            kinds.extend(self.kernels.iter().filter(|_| constants).map(one));
        }
        kinds
    }

    /// The textures of sums between passes; none of a single pass.
    pub(crate) fn slots(&self, layout: SceneLayout) -> Option<Slots> {
        let pairs = if self.has_field { layout.components.count.div_ceil(2) as u32 } else { 0 };
        let slots = Slots { pairs, per_pair: self.order + 1 };
        (self.method == Method::Splat).then_some(slots)
    }

    /// The whole text of a shader; `pair` is the pair of components that it splats.
    fn text(&self, layout: SceneLayout, kind: ShaderVariant, pair: u32) -> String {
        let mut text = self.constants(layout, kind);
        text += &types(layout);
        text += &structure("View", ViewRecord::MEMBERS, |_| String::new());
        text += BINDINGS;
        text += &self.smooth(layout);
        text += &geometry::constants();
        let parts = [texts::LOAD, texts::PIXEL, texts::PATCH, texts::FINISH];
        text.extend(texts::POINT_FUNCTIONS.map(|(_, text)| text).into_iter().chain(parts));
        text += &self.formulas;
        text += &kernel_wgsl(kind);
        text += self.last_pass.text;
        let slots = self.slots(layout);
        text += &match slots {
            None => gather_text(layout) + &factors(layout.components.groups, self.order),
            Some(slots) => splat_text(layout, slots, pair),
        };
        let binding = slots.map_or(0, Slots::textures);
        text + &format!("@group(1) @binding({binding}) var palette: texture_2d<f32>;\n")
    }

    /// The code that evaluates smooth terms and reads constants.
    fn smooth(&self, layout: SceneLayout) -> String {
        let ComponentLanes { lanes, groups, .. } = layout.components;
        let smooth = match layout.shape.degree {
            Some(degree) if groups == 1 => straight_smooth(degree.into(), lanes, self.order),
            _ => texts::SMOOTH.to_owned(),
        };
        smooth + &four_constants(lanes, groups)
    }

    fn constants(&self, layout: SceneLayout, kind: ShaderVariant) -> String {
        let SceneLayout {
            components, own_frames, has_levels, has_holes, has_kinks, has_arcs, ..
        } = layout;
        let mut text = String::new();
        for (name, value) in [
            ("ORDER", self.order),
            ("COMPONENTS", components.count as u32),
            ("LANES", components.lanes as u32),
            ("LANE_PAIRS", components.lanes as u32 / 2),
            ("GROUPS", components.groups as u32),
            ("PAGE_TEXELS", page_texels(has_levels, own_frames)),
            ("ROW_BITS", TEXELS.ilog2()),
            ("INNER", bins::INNER),
            ("NO_PATCH", NO_PATCH),
            ("SMOOTH_GROUP", SMOOTH_GROUP),
            ("GROUP_BITS", bodies::GROUP_BITS),
            ("ABSENT", bodies::ABSENT),
            ("ALL_ABSENT", u32::MAX),
            ("PALETTE", PALETTE_TEXELS),
            ("LOG", shading::LOG),
            ("SYMLOG", shading::SYMLOG),
        ] {
            let _ = writeln!(text, "const {name}: u32 = {value}u;");
        }
        for (name, value) in [
            ("OWN_FRAMES", own_frames),
            ("HAS_LEVELS", has_levels),
            ("HAS_FIELD", self.has_field),
            ("HAS_SMOOTH", self.has_smooth),
            ("HAS_PART", self.has_part),
            ("HAS_HOLES", has_holes),
            ("HAS_KINKS", has_kinks),
            ("HAS_ARCS", has_arcs),
            ("HAS_CONSTANTS", kind.constants),
            ("HAS_POLYNOMIALS", kind.polynomials),
            ("IN_ONE_GROUP", kind.kernel.is_some()),
        ] {
            let _ = writeln!(text, "const {name}: bool = {value};");
        }
        text
    }
}

/// The file of splatting with its declarations: targets, slots, textures.
fn splat_text(layout: SceneLayout, slots: Slots, pair: u32) -> String {
    let mut text = texts::SPLAT.to_owned();
    let location = |k| format!("@location({k}) ");
    text += &structure("Instance", QuadRecord::MEMBERS, location);
    let _ = writeln!(text, "const SLOTS: u32 = {}u;", slots.per_pair);
    let _ = writeln!(text, "const PAIR: u32 = {pair}u;");
    text += "fn sample_of(pixel: Pixel) -> Sample { return summed(pixel); }\n";
    text += &targets("Weights", 1);
    text += &targets("Fields", slots.per_pair);
    text += &fields_of(pair, slots.per_pair, layout.components.lanes);
    let fields = (0..slots.count()).map(|k| format!("field_{k}"));
    for (binding, name) in ["weights_0".to_owned()].into_iter().chain(fields).enumerate() {
        let _ = writeln!(text, "@group(1) @binding({binding}) var {name}: texture_2d<f32>;");
    }
    text + &field_slot(slots.count())
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
fn lanes_from(texel: vec4<u32>, odd: u32) -> vec2<f32> {{
    return bitcast<vec2<f32>>(select(texel.xy, texel.zw, odd == 1u));
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

fn gather_text(layout: SceneLayout) -> String {
    let bins = if layout.is_lattice { texts::LATTICE } else { texts::BINS };
    let alias = "fn sample_of(pixel: Pixel) -> Sample { return gathered(pixel); }\n";
    [bins, texts::GATHER, alias].concat()
}

/// The function that evaluates the one group of functions that an area has.
fn kernel_wgsl(kind: ShaderVariant) -> String {
    let call = match kind.kernel {
        Some(kernel) => format!("functions_{kernel}(group, offset)"),
        None => "functions(group, offset)".to_owned(),
    };
    format!(
        "\nfn functions_here(group: u32, offset: vec2<f32>) -> Functions {{\n    return {call};\n}}\n"
    )
}

/// A structure of float targets.
fn targets(name: &str, count: u32) -> String {
    let member = |k| format!("    @location({k}) target_{k}: vec4<f32>,\n");
    let members: String = (0..count).map(member).collect();
    format!("struct {name} {{\n{members}}}\n")
}

/// The output of a pass of two components: value and slope by x, then slope by y.
fn fields_of(pair: u32, slots: u32, lanes: usize) -> String {
    let part = if lanes == 4 && pair % 2 == 1 { "zw" } else { "xy" };
    let first = format!("vec4<f32>(u.v.{part}, u.x.{part})");
    let second = format!("vec4<f32>(u.y.{part}, vec2<f32>())");
    let all = [first, second][..slots as usize].join(", ");
    format!("fn fields_of(u: Jets) -> Fields {{\n    return Fields({all});\n}}\n")
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
