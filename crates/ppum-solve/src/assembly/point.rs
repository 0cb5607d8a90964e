//! The value of a field at a point, as a functional of the unknowns.

use super::Assembly;
use super::functions::CellFunctions;
use crate::basis::{ShapeEvaluator, Shapes};
use crate::quadrature::{CrackFace, EdgeRule, QuadratureErrorEstimate};
use crate::space::TrialSpace;
use ppum::vec2::Vec2;
use ppum_linear::BlockMatrix;

/// The rule of a point, which may lie on a face of a crack, in the cell that holds it.
pub(super) fn point_rule(
    space: &TrialSpace<'_>,
    (x, face): (Vec2, Option<CrackFace>),
) -> (usize, EdgeRule) {
    let partition = space.partition();
    let distance = |cell: &usize| partition.cell[*cell].distance(x);
    let cell = (0..partition.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0);
    let holds = |patch: &&u32| partition.support(**patch as usize).contains(x);
    let rule = EdgeRule {
        anchor: x,
        offsets: vec![Vec2::ZERO],
        weights: vec![1.0],
        normals: vec![Vec2::ZERO],
        patches: space.covering_patches[cell].iter().filter(holds).copied().collect(),
        face,
        doubt: QuadratureErrorEstimate::default(),
    };
    (cell, rule)
}

/// The values of a field at a point.
pub struct PointValues {
    /// N(x) of each component for all unknowns, in the order of the matrix.
    pub functionals: Vec<Vec<f64>>,
    /// The known part of the field, which may be infinite.
    pub(crate) known: [f64; 2],
}

/// The values of a field at a point; on a face of a crack those of its side.
pub fn values_at(
    assembly: Assembly<'_>,
    matrix: &BlockMatrix,
    place: (Vec2, Option<CrackFace>),
) -> PointValues {
    let Assembly { space, basis, .. } = assembly;
    let components = assembly.components();
    let (cell, rule) = point_rule(space, place);
    let functions = CellFunctions::new(&assembly, cell);
    let (mut plain, mut shapes) = (Shapes::default(), Shapes::default());
    ShapeEvaluator::of_series(space).evaluate_edge(&rule, &mut plain);
    let (mut first, mut sum) = (0, [0.0; 2]);
    for &patch in &rule.patches {
        for known in space.known(patch as usize) {
            let (row, parts) = (first + known.evaluated, sum.iter_mut().zip(known.coefficients));
            parts.for_each(|(sum, c)| *sum += c * plain.value[row]);
            // it may be infinite, and is in none of the basis
            plain.clear(row);
        }
        first += space.evaluated(patch as usize);
    }
    basis.apply(&rule.patches, &plain, &mut shapes);
    let of_component = |i: usize| {
        let mut part = vec![0.0; functions.len() * components];
        let unit = std::array::from_fn(|k| f64::from(u8::from(k == i)));
        shapes.add_loads(&[unit], &functions.numbers(&rule.patches), components, &mut part);
        let mut row = vec![0.0; matrix.n_unknowns()];
        functions.add_to(basis, matrix, components, &part, &mut row);
        row
    };
    PointValues { functionals: (0..components).map(of_component).collect(), known: sum }
}
