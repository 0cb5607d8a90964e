//! Components of the field that are zero on a line: the symmetry of a straight line of the boundary
//! that holds a crack.
//!
//! The tip's singular functions that have the symmetry satisfy it; of the polynomials, and of jumps
//! times polynomials, those are taken that vanish on the line. Nothing is left for Nitsche's
//! method, whose tractions are not square integrable at the tip, and factors converge as in the
//! whole body.

use ppum::border::BorderLine;
use ppum::border::touch;
use ppum::crack::TipId;
use ppum::dataset::BoxPartition;
use ppum::edge::Edge;
use ppum::segment::Segment;
use ppum::vec2::Vec2;
use ppum_problem::geometry::{clipped, solid_part, wider};
use ppum_problem::{BoundaryCondition, Problem, Symmetry, held_directions};
use std::collections::BTreeMap;

/// Length of a line in a patch, in half-sizes of the patch, up to which nothing of it is seen.
const LEAST: f64 = 1e-9;

/// A component of the field that is zero on a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HeldLine {
    /// The unit vector of the component.
    pub(crate) direction: Vec2,
    /// The unit normal n of the line n · x = `at`.
    pub(crate) normal: Vec2,
    pub(crate) at: f64,
}

/// The symmetry of the field to the axis of a tip beside which one half alone is in the body.
pub fn symmetry_of_field(problem: &Problem, tip: TipId) -> Option<Symmetry> {
    problem.symmetry_at(tip)
}

/// True if all fields have what a condition gives.
pub(crate) fn is_held_exactly(problem: &Problem, condition: &BoundaryCondition) -> bool {
    problem.exact_line(condition).is_some()
}

/// The lines of each patch that sees some.
pub(crate) fn held_lines(
    problem: &Problem,
    partition: &BoxPartition,
) -> BTreeMap<u32, Vec<HeldLine>> {
    let mut found: BTreeMap<u32, Vec<HeldLine>> = BTreeMap::new();
    for condition in &problem.boundary {
        let Some(line) = problem.exact_line(condition) else { continue };
        let Some(held) = held_line(&line, condition) else { continue };
        let parts = problem.parts_beside_faces(condition.on, &line);
        for patch in 0..partition.len() {
            let half = partition.half[patch];
            let seen: f64 = parts
                .iter()
                .map(|part| seen_length(part, &line, (problem, partition, patch)))
                .sum();
            if seen > LEAST * half.x.min(half.y) {
                let lines = found.entry(patch as u32).or_default();
                lines.extend((!lines.contains(&held)).then_some(held));
            }
        }
    }
    found
}

/// The length of a part of a line in a patch and outside of holes.
fn seen_length(
    &[a, b]: &Segment,
    line: &BorderLine,
    (problem, partition, patch): (&Problem, &BoxPartition, usize),
) -> f64 {
    let domain = problem.domain();
    let near =
        wider(&partition.support(patch).intersection(&domain.bounds), 1e-3 * touch(&domain.bounds));
    let others = domain.holes.iter().enumerate().filter(|(k, _)| line.hole != Some(*k));
    let edge = Edge::segment([a, b]);
    let solid = |range| solid_part(edge, range, others.clone().map(|(_, hole)| hole));
    clipped(edge, &near).into_iter().map(|range| solid(range) * edge.length()).sum()
}

fn held_line(line: &BorderLine, condition: &BoundaryCondition) -> Option<HeldLine> {
    let direction = held_directions(condition.held(), condition.axes()).next()?;
    let normal = line.outward();
    Some(HeldLine { direction, normal, at: normal.dot(line.ends[0]) })
}
