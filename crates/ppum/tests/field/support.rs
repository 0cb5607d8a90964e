//! Shared by the tests: where a field is not smooth, scales, and comparisons.

use ppum::crack::{Crack, Side};
use ppum::dataset::{Dataset, Step};
use ppum::field::{Field, LocalField};
use ppum::jet::Jet;
use ppum::vec2::Vec2;

/// The field of a synthetic dataset.
pub(crate) fn compiled(dataset: &Dataset) -> Field<'_> {
    Field::new(dataset, 0).expect("recipes make valid datasets")
}

/// The components of the field at a point of the domain.
#[track_caller]
pub(crate) fn inside<const D: usize>(
    local: &mut LocalField<'_>,
    offset: Vec2,
    side: Side,
) -> Vec<Jet<f64>> {
    evaluate::<D>(local, offset, side).expect("a point of the domain")
}

/// The components of the field at an offset from the anchor; `None` outside the domain.
pub(crate) fn evaluate<const D: usize>(
    local: &mut LocalField<'_>,
    offset: Vec2,
    side: Side,
) -> Option<Vec<Jet<f64>>> {
    let mut out = vec![Jet::constant(0.0); local.field.components()];
    local.evaluate::<D>(offset, side, &mut out).then_some(out)
}

/// Value, gradient and Hessian in a row.
pub(crate) fn entries(jet: &Jet<f64>) -> [f64; 6] {
    [jet.v, jet.x, jet.y, jet.xx, jet.xy, jet.yy]
}

/// The order of the derivative each of the [`entries`] is.
pub(crate) const ORDERS: [i32; 6] = [0, 1, 1, 2, 2, 2];

/// Asserts that two jets agree: derivatives of order k to `tolerance` · size / length^k, or
/// relatively.
#[track_caller]
pub(crate) fn assert_close(a: &Jet<f64>, b: &Jet<f64>, tolerance: f64, size: f64, length: f64) {
    for ((a, b), order) in entries(a).into_iter().zip(entries(b)).zip(ORDERS) {
        let scale = (size / length.powi(order)).max(b.abs());
        assert!(
            (a - b).abs() <= tolerance * scale,
            "derivative of order {order}: {a} against {b}, apart {:.1e} of {scale:.1e}",
            (a - b).abs() / scale
        );
    }
}

/// Smallest half-extent of the patches that cover `p`.
pub(crate) fn patch_size(step: &Step, p: Vec2) -> f64 {
    let partition = step.partition.boxes();
    let covers = |&i: &usize| partition.support(i).contains(p);
    let half = |i: usize| partition.half[i].x.min(partition.half[i].y);
    (0..partition.len()).filter(covers).map(half).fold(f64::INFINITY, f64::min)
}

/// Distance, in the maximum norm, from `p` to the lines where the weight of any patch is not
/// smooth.
pub(crate) fn distance_to_kinks(step: &Step, p: Vec2) -> f64 {
    let partition = step.partition.boxes();
    let places = || partition.weight.breakpoints().iter().chain(&[1.0]);
    let mut nearest = f64::INFINITY;
    for i in 0..partition.len() {
        let (d, half) = (p - partition.center[i], partition.half[i]);
        if d.x.abs() > 1.5 * half.x || d.y.abs() > 1.5 * half.y {
            continue;
        }
        for &t in places() {
            let (x, y) = ((d.x.abs() - t * half.x).abs(), (d.y.abs() - t * half.y).abs());
            nearest = nearest.min(x).min(y);
        }
    }
    nearest
}

/// Distance from `p` to the nearest crack.
pub(crate) fn distance_to_cracks(step: &Step, p: Vec2) -> f64 {
    let edges = step.cracks.iter().flat_map(Crack::edges);
    edges.map(|edge| edge.distance(p)).fold(f64::INFINITY, f64::min)
}

/// True if the segment from `p` to `q` meets a crack, or comes closer than `margin` to one.
pub(crate) fn meets_crack(step: &Step, p: Vec2, q: Vec2, margin: f64) -> bool {
    let near = (q - p).length() + margin;
    distance_to_cracks(step, p) <= near
}
