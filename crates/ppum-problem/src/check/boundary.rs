//! Rules for conditions on the boundary.

use std::collections::BTreeMap;

use ppum::border::touch;
use ppum::crack::Side;
use ppum::domain::Domain;
use ppum::edge::Edge;
use ppum::vec2::Rect;

use crate::data::{
    BoundaryCondition, BoundaryPart, BoundaryPiece, BoundaryRange, DomainEdge, ProblemData,
};
use crate::file::{Key, KeyError, no_such};
use crate::geometry::{solid_length, wider};

/// All rules broken by the conditions on the boundary.
pub(super) fn check_boundary(problem: &ProblemData) -> Vec<KeyError> {
    let parts = problem.boundary.iter().enumerate();
    let mut found: Vec<_> = parts.filter_map(|(k, part)| check_part(k, part, problem)).collect();
    found.extend(check_contradictions(problem));
    found
}

/// A component of which a condition says something, on a stretch of a part of the boundary.
struct ConditionStretch {
    /// Kind and number of the part, face, component.
    place: (u8, usize, u8, usize),
    stretch: [f64; 2],
    condition: usize,
}

fn claims(
    index: usize,
    condition: &BoundaryCondition,
    pieces: &[BoundaryPiece],
) -> Vec<ConditionStretch> {
    let [both, above, below] = [vec![0, 1], vec![0], vec![1]];
    let run =
        |&BoundaryRange { hole, from, to }: &BoundaryRange| (1, hole, [from as f64, to as f64]);
    let (faces, parts) = match condition.on {
        BoundaryPart::Edge { edge, from, to } => (above, vec![(0, edge as usize, [from, to])]),
        BoundaryPart::Hole(hole) => (above, vec![(1, hole, [0.0, f64::INFINITY])]),
        BoundaryPart::Sides(sides) => (above, vec![run(&sides)]),
        BoundaryPart::Piece(piece) => {
            (above, pieces.get(piece).iter().flat_map(|piece| &piece.runs).map(run).collect())
        }
        BoundaryPart::Crack { crack, face } => {
            let faces = face.map_or(both, |side| if side == Side::Above { above } else { below });
            (faces, vec![(2, crack, [0.0, 1.0])])
        }
    };
    let components = (0..condition.components.len()).filter(|&k| condition.says(k));
    let places = components.flat_map(|k| faces.iter().map(move |&face| (face, k)));
    let claim = |(face, component): (u8, usize)| {
        parts.iter().map(move |&(kind, number, stretch)| ConditionStretch {
            place: (kind, number, face, component),
            stretch,
            condition: index,
        })
    };
    places.flat_map(claim).collect()
}

/// Finds components that are given twice at a place. Each condition that an earlier one contradicts
/// is listed once.
fn check_contradictions(problem: &ProblemData) -> Vec<KeyError> {
    let (boundary, pieces) = (&problem.boundary, problem.pieces());
    let mut all: Vec<_> =
        boundary.iter().enumerate().flat_map(|(k, part)| claims(k, part, pieces)).collect();
    all.sort_by(|a, b| a.place.cmp(&b.place).then(a.stretch[0].total_cmp(&b.stretch[0])));
    let mut pairs = BTreeMap::new();
    let mut claims = all.iter();
    let Some(mut farthest) = claims.next() else { return Vec::new() };
    for claim in claims {
        let meets = claim.place == farthest.place && claim.stretch[0] < farthest.stretch[1];
        if meets && claim.condition != farthest.condition {
            let (a, b) = (claim.condition, farthest.condition);
            pairs.entry(a.max(b)).or_insert(a.min(b));
        }
        if !meets || claim.stretch[1] > farthest.stretch[1] {
            farthest = claim;
        }
    }
    let error = |(later, earlier): (usize, usize)| {
        let message = contradiction(problem, &boundary[earlier], &boundary[later]);
        on(later).error(message).with_other(on(earlier))
    };
    pairs.into_iter().map(error).collect()
}

fn on(index: usize) -> Key {
    Key::new("boundary").index(index).name("on")
}

fn check_part(
    index: usize,
    condition: &BoundaryCondition,
    problem: &ProblemData,
) -> Option<KeyError> {
    let (holes, cracks) = (problem.domain().holes.len(), problem.cracks().len());
    let message = match condition.on {
        part @ BoundaryPart::Edge { edge, from, to } => {
            bad_range(edge, [from, to], &problem.domain().bounds)
                .or_else(|| (!reaches_body(part, problem)).then(|| NOTHING_THERE.to_owned()))?
        }
        BoundaryPart::Hole(hole) if hole >= holes => no_such("hole", hole, holes),
        BoundaryPart::Piece(piece) if piece >= problem.pieces().len() => {
            no_such("piece", piece, problem.pieces().len())
        }
        BoundaryPart::Sides(run) if !is_of(run, problem) => {
            format!("there is no hole {} with sides {} to {}", run.hole, run.from, run.to)
        }
        BoundaryPart::Crack { crack, .. } if crack >= cracks => no_such("crack", crack, cracks),
        BoundaryPart::Crack { .. } if condition.fixed().contains(&true) => {
            let remedy = if problem.components() == 1 {
                "flux or an exchange"
            } else {
                "traction or a pressure"
            };
            format!("the faces of a crack cannot be held; give them a {remedy}")
        }
        part if !reaches_body(part, problem) => NOTHING_THERE.to_owned(),
        _ => return None,
    };
    Some(on(index).error(message))
}

const NOTHING_THERE: &str = "nothing of the body is there: it lies in holes, or outside of the outline or the box; leave this [[boundary]] \
     out, or name another part; sides of an outline are pieces, `on = { piece = \"name\" }`";

/// True if some of a part of the boundary bounds the body.
fn reaches_body(part: BoundaryPart, problem: &ProblemData) -> bool {
    let Domain { bounds, holes } = problem.domain();
    let near = wider(bounds, touch(bounds));
    let is_solid = |(edge, own): (Edge, Option<usize>)| {
        let others = (0..).zip(holes).filter(|(k, _)| own != Some(*k)).map(|(_, hole)| hole);
        solid_length(edge, &near, others) > 0.0
    };
    match part {
        BoundaryPart::Hole(hole) if holes[hole].sides().next().is_none() => true,
        BoundaryPart::Crack { .. } => true,
        _ => problem.sides_of(part).into_iter().any(is_solid),
    }
}

fn is_of(run: BoundaryRange, problem: &ProblemData) -> bool {
    let count = problem.domain().holes.get(run.hole).map_or(0, |hole| hole.sides().count());
    run.from < run.to && run.to <= count
}

fn bad_range(edge: DomainEdge, [from, to]: [f64; 2], domain: &Rect) -> Option<String> {
    let [first, last] = edge.range(domain);
    if from >= to {
        return Some(format!("`from` is {from} and `to` is {to}, but `to` must exceed `from`"));
    }
    let edge = edge.name();
    (from < first || to > last).then(|| {
        format!(
            "from {from} to {to} leaves the {edge} edge, which runs from {first} to {last}; stay inside"
        )
    })
}

/// Two conditions that speak of the same component at the same place.
fn contradiction(problem: &ProblemData, a: &BoundaryCondition, b: &BoundaryCondition) -> String {
    let place = a.on.common(b.on);
    let what = match a.components.len().min(b.components.len()) {
        1 => "the value or flux",
        _ if a.says(0) && b.says(0) => "the x component",
        _ => "the y component",
    };
    let remedy = match place {
        BoundaryPart::Edge { .. } => "divide the edge by `from` and `to`, or leave",
        _ => "leave",
    };
    let place = problem.words_of(place);
    format!(
        "{what} on {place} is given twice; give each component once at each place: {remedy} a \
         component \"free\""
    )
}
