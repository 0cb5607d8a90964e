//! Rules on whole covers against closed forms.

mod arcs;
mod cells;
mod curves;
mod edges;
mod holes;
mod layers;
mod lines;
mod powers;
mod singular;
mod together;
mod weights;

use super::*;
use ppum::crack::{Crack, CrackEnd};
use ppum::dataset::BoxPartition;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;
use ppum_testkit::random::Random;

/// A point within a square around the origin.
fn point(random: &mut Random, size: f64) -> Vec2 {
    random.point(&Rect::around(Vec2::ZERO, vec2(size, size)))
}

const DOMAIN: Rect = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));

/// The leaves of a tree over a box that is divided where `divide` says so.
fn leaves(rect: Rect, level: u32, divide: &mut dyn FnMut(&Rect, u32) -> bool) -> Vec<Rect> {
    if !divide(&rect, level) {
        return vec![rect];
    }
    let c = rect.center();
    let (min, max) = (rect.min, rect.max);
    [
        Rect::new(min, c),
        Rect::new(vec2(c.x, min.y), vec2(max.x, c.y)),
        Rect::new(vec2(min.x, c.y), vec2(c.x, max.y)),
        Rect::new(c, max),
    ]
    .into_iter()
    .flat_map(|child| leaves(child, level + 1, divide))
    .collect()
}

fn partition(cells: Vec<Rect>, weight: WeightFunction) -> BoxPartition {
    let center: Vec<Vec2> = cells.iter().map(Rect::center).collect();
    let half: Vec<Vec2> = cells.iter().map(|c| c.size() * 0.65).collect();
    BoxPartition {
        weight,
        origin: center.clone(),
        scale: half.clone(),
        level: vec![0; cells.len()],
        point: vec![None; cells.len()],
        points: Vec::new(),
        cell: cells,
        center,
        half,
    }
}

fn uniform(level: u32) -> BoxPartition {
    partition(leaves(DOMAIN, 0, &mut |_, l| l < level), WeightFunction::Linear)
}

fn graded(random: &mut Random, weight: WeightFunction) -> BoxPartition {
    let cells = leaves(DOMAIN, 0, &mut |_, level| {
        level < 2 || (level < 4 && random.between(0.0, 1.0) < 0.4)
    });
    partition(cells, weight)
}

fn covered<'a>(rect: &'a Rect, patches: &'a [u32]) -> CoveredCell<'a> {
    CoveredCell { rect, patches }
}

/// Patches whose open supports meet the open cell.
fn covering_patches(partition: &BoxPartition, cell: &Rect) -> Vec<u32> {
    let meets = |&i: &u32| partition.support(i as usize).overlaps(cell);
    (0..partition.len() as u32).filter(meets).collect()
}

fn crack(points: &[Vec2]) -> Crack {
    Crack::polyline(points.to_vec(), [CrackEnd::Tip, CrackEnd::Tip])
}

/// A step's geometry with one list of singular points for all patches.
struct GeometryCase {
    partition: BoxPartition,
    cracks: Vec<Crack>,
    singular: Vec<Singularity>,
    patch_singular: Vec<Vec<u32>>,
}

impl GeometryCase {
    fn new(partition: BoxPartition, cracks: Vec<Crack>, singular: Vec<Vec2>) -> Self {
        let all: Vec<u32> = (0..singular.len() as u32).collect();
        let patch_singular = vec![all; partition.len()];
        let singular = singular.into_iter().map(Singularity::tip).collect();
        Self { partition, cracks, singular, patch_singular }
    }

    fn geometry(&self) -> SmoothnessGeometry<'_> {
        SmoothnessGeometry {
            singular: &self.singular,
            patch_singular: &self.patch_singular,
            ..SmoothnessGeometry::new(&self.partition, &self.cracks)
        }
    }

    fn quadrature(&self, orders: Orders) -> Quadrature<'_> {
        Quadrature::new(self.geometry(), orders)
    }

    fn rules(&self, orders: Orders) -> Vec<CellRule> {
        rules(self.geometry(), orders)
    }
}

/// The rules of all cells.
fn rules(geometry: SmoothnessGeometry<'_>, orders: Orders) -> Vec<CellRule> {
    let quadrature = Quadrature::new(geometry, orders);
    let cell = |c: &Rect| quadrature.cell(covered(c, &covering_patches(geometry.partition, c)));
    geometry.partition.cell.iter().flat_map(cell).collect()
}

fn n_points(rules: &[CellRule]) -> usize {
    rules.iter().map(|r| r.offsets.len()).sum()
}

const UNIT: Rect = Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0));

/// One patch that covers a single cell alone.
fn alone(cell: Rect, cracks: Vec<Crack>, singular: Vec<Vec2>) -> GeometryCase {
    GeometryCase::new(partition(vec![cell], WeightFunction::Linear), cracks, singular)
}

/// Σ w f(anchor, offset).
fn integrate(rules: &[CellRule], f: impl Fn(Vec2, Vec2) -> f64) -> f64 {
    let of_rule = |r: &CellRule| -> f64 {
        r.offsets.iter().zip(&r.weights).map(|(&x, w)| w * f(r.anchor, x)).sum()
    };
    rules.iter().map(of_rule).sum()
}

fn assert_near(value: f64, exact: f64, tolerance: f64, what: &str) {
    assert!((value - exact).abs() <= tolerance, "{what}: {value:e} instead of {exact:e}");
}

/// φ_i of the first patch of a list.
fn partition_function(partition: &BoxPartition, patches: &[u32], p: Vec2) -> f64 {
    let w = |i: &u32| {
        let i = *i as usize;
        let d = p - partition.center[i];
        let spline = |x: f64| partition.weight.spline(x)[0];
        spline(d.x / partition.half[i].x) * spline(d.y / partition.half[i].y)
    };
    w(&patches[0]) / patches.iter().map(w).sum::<f64>()
}
