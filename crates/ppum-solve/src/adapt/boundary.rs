//! The boundary of a body, divided into parts on each of which the same conditions hold; parts
//! without conditions are among them.

use crate::quadrature::closed_meet;
use ppum::crack::Side;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::{BoundaryCondition, BoundaryPart, BoundaryRange, DomainEdge, Problem, in_plane};

/// A part of the boundary with the conditions on it, by their numbers.
pub(super) struct BoundaryConditions {
    pub(super) on: BoundaryPart,
    conditions: Vec<usize>,
    bounds: Rect,
}

impl BoundaryConditions {
    /// The parts of edges, the rims, and the faces of cracks.
    pub(super) fn all(problem: &Problem) -> Vec<Self> {
        let edges = DomainEdge::ALL.into_iter().flat_map(|edge| pieces(problem, edge));
        let rims = (0..problem.domain().holes.len()).flat_map(|hole| sides(problem, hole));
        let sides = [Side::Above, Side::Below];
        let faces = (0..problem.cracks().len())
            .flat_map(|crack| sides.map(|side| BoundaryPart::Crack { crack, face: Some(side) }));
        edges.chain(rims).chain(faces).map(|on| Self::new(problem, on)).collect()
    }

    fn new(problem: &Problem, on: BoundaryPart) -> Self {
        let speaks = |condition: &BoundaryCondition| match (condition.on, on) {
            (
                BoundaryPart::Edge { edge, from, to },
                BoundaryPart::Edge { edge: own, from: a, to: b },
            ) => edge == own && from <= a && b <= to,
            (_, BoundaryPart::Hole(own)) => condition.on == BoundaryPart::Hole(own),
            (part, BoundaryPart::Sides(run)) => problem.is_on(part, run.hole, run.from),
            (
                BoundaryPart::Crack { crack, face },
                BoundaryPart::Crack { crack: own, face: side },
            ) => crack == own && (face.is_none() || face == side),
            _ => false,
        };
        let all = problem.boundary.iter().enumerate();
        let conditions = all.filter(|(_, condition)| speaks(condition)).map(|(k, _)| k).collect();
        Self { on, conditions, bounds: bounds(problem, on) }
    }

    /// False if the part certainly stays away from a box.
    pub(super) fn may_meet(&self, rect: &Rect) -> bool {
        closed_meet(&self.bounds, rect)
    }

    /// Returns for each component whether its value is given, the directions of the components, and
    /// the given value or traction (flux) in the plane, zero where none is given. A support that
    /// yields has that of a field with the values `u`.
    pub(super) fn given(
        &self,
        problem: &Problem,
        (x, normal): (Vec2, Vec2),
        u: [f64; 2],
    ) -> ([bool; 2], [Vec2; 2], [f64; 2]) {
        let (mut held, mut values) = ([false; 2], [0.0; 2]);
        let mut axes = [vec2(1.0, 0.0), vec2(0.0, 1.0)];
        for condition in self.conditions.iter().map(|&k| &problem.boundary[k]) {
            let own = condition.fixed();
            let given = in_plane(condition.values(x, normal), condition.axes());
            if own.contains(&true) {
                axes = condition.axes();
            }
            let yields = condition.held().map(|held| held && condition.exchange.is_some());
            for k in 0..2 {
                held[k] |= own[k];
                values[k] += match yields[k] {
                    true => condition.exchange_at(x) * (given[k] - u[k]),
                    false => given[k],
                };
            }
        }
        (held, axes, values)
    }
}

/// The pieces of an edge between the ends of its conditions.
fn pieces(problem: &Problem, edge: DomainEdge) -> Vec<BoundaryPart> {
    let mut ends = edge.range(&problem.domain().bounds).to_vec();
    for condition in &problem.boundary {
        if let BoundaryPart::Edge { edge: own, from, to } = condition.on
            && own == edge
        {
            ends.extend([from, to]);
        }
    }
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    ends.windows(2).map(|s| BoundaryPart::Edge { edge, from: s[0], to: s[1] }).collect()
}

/// The rim of a hole between the ends of its pieces with conditions.
fn sides(problem: &Problem, hole: usize) -> Vec<BoundaryPart> {
    let on = problem.boundary.iter().map(|condition| condition.on);
    let parts: Vec<_> =
        on.filter(|on| matches!(on, BoundaryPart::Sides(_) | BoundaryPart::Piece(_))).collect();
    let count = problem.domain().holes[hole].sides().count();
    let of = |side: usize| parts.iter().map(move |part| problem.is_on(*part, hole, side));
    let is_end = |side: &usize| *side == 0 || !of(*side).eq(of(side - 1));
    let mut ends: Vec<_> = (0..count).filter(is_end).collect();
    if ends.len() < 2 && !of(0).any(|is_on| is_on) {
        return vec![BoundaryPart::Hole(hole)];
    }
    ends.push(count);
    let run =
        |ends: &[usize]| BoundaryPart::Sides(BoundaryRange { hole, from: ends[0], to: ends[1] });
    ends.windows(2).map(run).collect()
}

fn bounds(problem: &Problem, on: BoundaryPart) -> Rect {
    match on {
        BoundaryPart::Hole(hole) => problem.domain().holes[hole].rim_bounds(),
        BoundaryPart::Crack { crack, .. } => problem.cracks()[crack].bounds(),
        _ => problem.edges_of(on).fold(Rect::EMPTY, |all, edge| all.union(&edge.bounds())),
    }
}
