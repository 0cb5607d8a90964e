//! Points of the elements of a mesh by each element's own coordinate ξ, and the field there.
//!
//! A point belongs to the patch of its triangle, whoever owns it in the plane: a chord of a curved
//! edge is partly outside of its element, whose polynomials go on there.

use ppum::dataset::Step;
use ppum::field::Field;
use ppum::function::{Frame, FunctionKind};
use ppum::jet::Jet;
use ppum::mesh::{ElementField, Mesh};
use ppum::polynomial::polynomial_in;
use ppum::quantity::Quantity;
use ppum::vec2::{Vec2, vec2};
use ppum_render::pieces::{ElementCuts, INSET};
use rayon::prelude::*;

use super::lagrange::BarycentricPoint;

/// Points that a thread takes at a time.
const CHUNK: usize = 1024;

/// A level is zero at an end of an edge if it is less than this part of its change along the edge.
const ON_LEVEL: f64 = 1e-7;

/// Steps of Newton's method, and bisections of the way to the inside of a triangle.
const STEPS: usize = 8;
const BISECTIONS: usize = 40;

/// A point of a patch of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ElementPlace {
    pub(super) patch: u32,
    /// Its ξ, or one nearby.
    pub(super) at: Vec2,
    /// ξ on the side of all cuts that is meant.
    pub(super) inner: Vec2,
    /// The point in the plane, where ξ is one nearby.
    pub(super) target: Option<Vec2>,
}

/// The elements that triangles are parts of.
#[derive(Debug)]
pub(super) struct ParentElements<'d> {
    step: &'d Step,
    pub(super) mesh: &'d Mesh,
    /// The level fields of each patch, by their index among the fields of the step.
    levels: Vec<Vec<usize>>,
}

impl<'d> ParentElements<'d> {
    pub(super) fn new(field: &Field<'d>, mesh: &'d Mesh) -> Self {
        let levels = (0..mesh.len()).map(|patch| levels(field, mesh, patch)).collect();
        Self { step: field.step, mesh, levels }
    }

    pub(super) fn image(&self, patch: u32, at: Vec2) -> Vec2 {
        self.mesh.image(patch as usize, at.into()).0
    }

    /// The middle of an edge, on the level lines that both ends lie on.
    pub(super) fn middle(&self, patch: u32, [a, b]: [Vec2; 2]) -> Vec2 {
        let mut middle = (a + b) * 0.5;
        for &level in &self.levels[patch as usize] {
            let value = |at: Vec2| self.level(level, patch, at);
            let slope = gradient(&value(middle)).length();
            let near = ON_LEVEL * slope * (b - a).length();
            if [a, b].into_iter().all(|end| value(end).v.abs() <= near) {
                for _ in 0..STEPS {
                    let (jet, slope) = (value(middle), gradient(&value(middle)));
                    let step = slope * (jet.v / slope.dot(slope));
                    middle = if step.is_finite() { middle - step } else { middle };
                }
            }
        }
        middle
    }

    /// The tips of a patch near a point, where both level fields of a frame are zero.
    pub(super) fn tips_near(&self, field: &Field<'_>, patch: u32, at: Vec2) -> Vec<Vec2> {
        let frame = |kind: &FunctionKind| match kind {
            FunctionKind::Formula { frame: Frame::Levels(frame), .. } => Some(*frame),
            _ => None,
        };
        let mut frames: Vec<[u32; 2]> =
            functions(field, patch as usize).filter_map(frame).collect();
        frames.dedup();
        let tip = |levels: [u32; 2]| {
            let mut tip = at;
            for _ in 0..STEPS {
                let [a, b] = levels.map(|level| self.level(level as usize, patch, tip));
                let (p, q) = (gradient(&a), gradient(&b));
                tip = tip + vec2(b.v * p.y - a.v * q.y, a.v * q.x - b.v * p.x) / p.cross(q);
            }
            tip
        };
        frames.into_iter().map(tip).filter(|tip| tip.is_finite()).collect()
    }

    fn level(&self, level: usize, patch: u32, at: Vec2) -> Jet<f64> {
        let data = &self.step.fields[level];
        let block = |block: usize| {
            let coefficients = data.block_coefficients(block, 0);
            let degree = data.block_degree[block].into();
            polynomial_in::<f64, 1>(data.space(block), coefficients, degree, at.into())
        };
        let zero = Jet::constant(0.0);
        data.blocks(patch as usize).map(block).fold(zero, |sum, jet| sum.plus::<1>(jet))
    }
}

fn gradient(jet: &Jet<f64>) -> Vec2 {
    vec2(jet.x, jet.y)
}

/// The functions of the blocks of a patch.
fn functions<'f>(field: &'f Field<'_>, patch: usize) -> impl Iterator<Item = &'f FunctionKind> {
    let kind =
        move |block: usize| &field.step.functions[field.data.block_function[block] as usize].kind;
    field.data.blocks(patch).map(kind)
}

/// The level fields that clip a patch or that its functions are made of.
fn levels(field: &Field<'_>, mesh: &Mesh, patch: usize) -> Vec<usize> {
    let clips = mesh.clips(patch).iter().map(|clip| clip.field as usize);
    let of_functions = functions(field, patch).flat_map(|kind| match kind {
        FunctionKind::Level { field } => vec![*field as usize],
        FunctionKind::Formula { frame: Frame::Levels([x, y]), .. } => {
            vec![*x as usize, *y as usize]
        }
        _ => Vec::new(),
    });
    let mut all: Vec<usize> = clips.chain(of_functions).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// The point of a triangle with these barycentric coordinates.
pub(super) fn weighted([a, b, c]: [Vec2; 3], [_, q, r]: BarycentricPoint) -> Vec2 {
    a + ((b - a) * q + (c - a) * r)
}

impl ElementPlace {
    /// The ξ at which the field is evaluated: that of the point, on the side that is meant.
    fn settled(&self, element: &ElementField<'_, '_>, cuts: &ElementCuts, anchor: Vec2) -> Vec2 {
        let at = self.target.map_or(self.at, |target| self.located(element, target - anchor));
        if cuts.is_empty() {
            return at;
        }
        let between = |part: f64| at + (self.inner - at) * part;
        let is_inside = |part: f64| cuts.are_together(element, between(part), self.inner);
        // points of triangles may lie on cuts, those inside of them do not
        let first = if self.target.is_some() { 0.0 } else { INSET };
        if is_inside(first) {
            return between(first);
        }
        let [mut outside, mut inside] = [first, 1.0];
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (outside + inside);
            if is_inside(middle) { inside = middle } else { outside = middle }
        }
        between(inside)
    }

    /// The ξ of a point of the plane, by Newton's method; `at` if it leads nowhere.
    fn located(&self, element: &ElementField<'_, '_>, offset: Vec2) -> Vec2 {
        let mut at = self.at;
        for _ in 0..STEPS {
            let point = element.point(at);
            let (rest, [a, b]) = (offset - point.offset, point.columns);
            let step = vec2(rest.cross(b), a.cross(rest)) / a.cross(b);
            at = at + step;
            if step.length() < f64::EPSILON {
                break;
            }
        }
        if at.is_finite() && (at - self.at).length() < 1.0 { at } else { self.at }
    }
}

/// Rows of quantities at points of elements, on all threads.
pub(super) fn evaluate_elements(
    field: &Field<'_>,
    quantities: &[Quantity],
    places: &[ElementPlace],
) -> Vec<f64> {
    let width = quantities.len();
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by_key(|&k| places[k].patch);
    let of_part = |part: &[usize]| -> Vec<f64> {
        let runs = part.chunk_by(|&a, &b| places[a].patch == places[b].patch);
        runs.flat_map(|run| on_patch(field, quantities, places, run)).collect()
    };
    let sorted: Vec<Vec<f64>> = order.par_chunks(CHUNK).map(of_part).collect();
    let sorted = sorted.concat();
    let mut rows = vec![f64::NAN; sorted.len()];
    for (&k, row) in order.iter().zip(sorted.chunks(width)) {
        rows[k * width..][..width].copy_from_slice(row);
    }
    rows
}

/// Rows at those of the places that `run` names, all of one patch.
fn on_patch(
    field: &Field<'_>,
    quantities: &[Quantity],
    places: &[ElementPlace],
    run: &[usize],
) -> Vec<f64> {
    let none = || vec![f64::NAN; run.len() * quantities.len()];
    let Some(mesh) = field.step.partition.mesh() else { return none() };
    let patch = places[run[0]].patch as usize;
    let anchor = mesh.origin[patch];
    let mut local = field.at(anchor);
    let points: Vec<Vec2> = {
        let Some(element) = local.element(patch) else { return none() };
        let cuts = ElementCuts::new(field, mesh, &element, anchor);
        run.iter().map(|&k| places[k].settled(&element, &cuts, anchor)).collect()
    };
    Quantity::on_element(quantities, &mut local, patch, &points)
}
