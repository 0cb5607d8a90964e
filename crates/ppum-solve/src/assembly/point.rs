//! The value of a field at a point, as a functional of the unknowns.

use super::Assembly;
use super::functions::CellFunctions;
use crate::basis::{BasisEvaluator, Shapes};
use crate::linear::BlockMatrix;
use crate::quadrature::{Doubt, EdgeRule, Face};
use ppum::vec2::Vec2;

/// N(x) of each component for all unknowns, in the order of the matrix; on a face of a crack that
/// of its side.
pub(crate) fn values_at(
    assembly: Assembly<'_>,
    matrix: &BlockMatrix,
    (x, face): (Vec2, Option<Face>),
) -> Vec<Vec<f64>> {
    let Assembly { space, basis, .. } = assembly;
    let (partition, components) = (space.partition(), assembly.components());
    let distance = |cell: &usize| partition.cell[*cell].distance(x);
    let cell = (0..partition.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let functions = CellFunctions::new(&assembly, cell.unwrap_or(0));
    let holds = |patch: &&u32| partition.support(**patch as usize).contains(x);
    let rule = EdgeRule {
        anchor: x,
        offsets: vec![Vec2::ZERO],
        weights: vec![1.0],
        normals: vec![Vec2::ZERO],
        patches: functions.patches.iter().filter(holds).copied().collect(),
        face,
        doubt: Doubt::default(),
    };
    let mut shapes = Shapes::default();
    BasisEvaluator::new(space, basis).evaluate_edge(&rule, &mut shapes);
    let of_component = |i: usize| {
        let mut part = vec![0.0; functions.len() * components];
        let unit = std::array::from_fn(|k| f64::from(u8::from(k == i)));
        shapes.add_loads(&[unit], &functions.numbers(&rule.patches), components, &mut part);
        let mut row = vec![0.0; matrix.n_unknowns()];
        functions.add_to(basis, matrix, components, &part, &mut row);
        row
    };
    (0..components).map(of_component).collect()
}
