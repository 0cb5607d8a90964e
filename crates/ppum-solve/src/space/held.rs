//! Components of the field that are zero on the line of an edge: the symmetry of an edge that holds
//! a crack.
//!
//! The tip's singular functions that have the symmetry satisfy it; of the polynomials, and of jumps
//! times polynomials, those are taken that vanish on the line. Nothing is left for Nitsche's
//! method, whose tractions are not square integrable at the tip, and factors converge as in the
//! whole body.

use crate::geometry;
use crate::problem::{BorderPart, Edge, Problem};
use ppum::dataset::BoxPartition;
use ppum::domain::Domain;
use std::collections::BTreeMap;

/// Length of an edge in a patch, in half-sizes of the patch, up to which nothing of it is seen.
const LEAST: f64 = 1e-9;

/// A component of the field that is zero on a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HeldLine {
    pub(crate) component: usize,
    /// The axis across the line: 0 of a line x = `at`, 1 of y = `at`.
    pub(crate) across: usize,
    pub(crate) at: f64,
}

/// The lines of each patch that sees some.
pub(super) fn held_lines(
    problem: &Problem,
    partition: &BoxPartition,
) -> BTreeMap<u32, Vec<HeldLine>> {
    let bounds = &problem.domain.bounds;
    let mut found: BTreeMap<u32, Vec<HeldLine>> = BTreeMap::new();
    for condition in problem.boundary.iter().filter(|condition| problem.is_exact(condition)) {
        let BorderPart::Edge { edge, from, to } = condition.on else { continue };
        let line = held_line(edge, condition.held(), edge.point(bounds, from).into());
        for patch in 0..partition.len() {
            let part = partition.support(patch).intersection(bounds);
            let [start, end] = edge.range(&part);
            let on_edge = edge.point(&part, start) == edge.point(bounds, start);
            let [from, to] = [start.max(from), end.min(to)];
            let half = partition.half[patch];
            let seen = || (to - from) * solid_part(edge, [from, to], &problem.domain);
            if on_edge && to > from && seen() > LEAST * half.x.min(half.y) {
                let lines = found.entry(patch as u32).or_default();
                lines.extend((!lines.contains(&line)).then_some(line));
            }
        }
    }
    found
}

/// The part of a piece of an edge that lies outside of holes.
fn solid_part(edge: Edge, piece: [f64; 2], domain: &Domain) -> f64 {
    let [a, b] = piece.map(|s| edge.point(&domain.bounds, s));
    geometry::solid_part(a, b, [0.0, 1.0], domain.holes.iter())
}

fn held_line(edge: Edge, held: [bool; 2], start: [f64; 2]) -> HeldLine {
    let across = usize::from(edge.normal().x == 0.0);
    HeldLine { component: usize::from(held[1]), across, at: start[across] }
}
