//! Rules for cracks on edges: halves of symmetric bodies.

use ppum::crack::TipId;

use super::super::boundary::{BorderPart, BoundaryCondition, Edge};
use super::super::discretization::Enrichment;
use super::super::key::{Key, MistakeAt};
use super::super::model::Problem;
use super::super::symmetry::Symmetry;

/// All rules broken by cracks on edges.
pub(super) fn check_symmetry(problem: &Problem) -> Vec<MistakeAt> {
    let on_edges: Vec<(usize, Edge)> = (0..problem.cracks.len())
        .filter_map(|crack| Some((crack, problem.edge_of(crack)?)))
        .collect();
    let Some((first, _)) = on_edges.first() else { return Vec::new() };
    let of_crack = |(crack, edge): &(usize, Edge)| {
        let message = bad_crack(problem, *crack, *edge)?;
        Some(Key::points(*crack).mistake(message))
    };
    let mut found: Vec<MistakeAt> = on_edges.iter().filter_map(of_crack).collect();
    found.extend(bad_conditions(problem, &on_edges));
    found.extend(
        bad_whole(problem)
            .map(|(key, message)| key.mistake(message).with_other(Key::points(*first))),
    );
    found
}

/// What is wrong with a crack on an edge.
fn bad_crack(problem: &Problem, index: usize, edge: Edge) -> Option<String> {
    let (crack, name) = (&problem.cracks[index], edge.name());
    if !crack.points.iter().all(|p| problem.domain.bounds.contains(*p)) {
        return None; // it is told that it leaves the domain
    }
    if problem.equation.elastic().is_none() {
        return Some(format!(
            "the crack runs along the {name} edge; move it into the plate, or leave it out: where nothing is said \
             of an edge there is no flux through it"
        ));
    }
    let mut tips = crack.tips().map(|end| TipId { crack: index as u32, end }).peekable();
    if tips.peek().is_none() {
        return Some(format!(
            "no end of the crack on the {name} edge is a tip: both lie at corners of the domain, in holes or on \
             other cracks; let one end on the edge between its corners, or leave the crack out: where nothing is \
             said of an edge it is free"
        ));
    }
    // no conditions are known where one of them cannot be read
    let is_known = !problem.boundary.is_empty();
    (is_known && tips.any(|tip| problem.symmetry_at(tip).is_none())).then(|| {
        format!(
            "the crack runs along the {name} edge, which nothing holds ahead of its tip; add [[boundary]] with \
             on = \"{name}\" and `symmetry = true`, or `antisymmetry = true`, or move the crack into the plate"
        )
    })
}

/// Conditions on edges with cracks that are no symmetry, or another one.
fn bad_conditions(problem: &Problem, on_edges: &[(usize, Edge)]) -> Vec<MistakeAt> {
    let bad = |(index, condition): (usize, _)| {
        let key = Key::new("boundary").index(index);
        let (own, crack, message) = bad_condition(problem, condition, on_edges)?;
        Some(key.name(own).mistake(message).with_other(Key::points(crack)))
    };
    problem.boundary.iter().enumerate().filter_map(bad).collect()
}

/// The key that is wrong, the crack that it is wrong with, and the message.
fn bad_condition(
    problem: &Problem,
    condition: &BoundaryCondition,
    on_edges: &[(usize, Edge)],
) -> Option<(&'static str, usize, String)> {
    match condition.on {
        BorderPart::Edge { edge, .. } => {
            let (crack, _) = on_edges.iter().find(|(_, own)| *own == edge)?;
            let name = edge.name();
            let message = match (condition.symmetry(), problem.symmetry_of(*crack)) {
                (None, _) => format!(
                    "the {name} edge holds a crack, beside which there can be nothing but symmetry or antisymmetry; \
                     give loads to the crack, on = {{ crack = {crack} }}, or move it into the plate"
                ),
                (Some(own), Some(other)) if own != other => format!(
                    "the {name} edge holds a crack and is in part one of symmetry, in part one of antisymmetry; let \
                     all of it be of one kind"
                ),
                _ => return None,
            };
            Some(("on", *crack, message))
        }
        BorderPart::Crack { crack, face: Some(_) } => {
            on_edges.iter().find(|(own, _)| *own == crack)?;
            let message = "only one face of a crack on an edge is in the plate, and a load on it means the same on \
                           its image; leave `face` out";
            Some(("on", crack, message.to_owned()))
        }
        _ => None,
    }
}

/// What in the rest of a problem does not go with cracks on edges.
fn bad_whole(problem: &Problem) -> Option<(Key, String)> {
    let is_antisymmetric = |k: usize| problem.symmetry_of(k) == Some(Symmetry::Antisymmetric);
    if problem.discretization.enrichment != Enrichment::Williams {
        let message = "a crack on an edge needs the functions of `enrichment = \"williams\"`; leave `enrichment` \
                       out, or model the whole plate";
        return Some((Key::of("discretization.enrichment"), message.to_owned()));
    }
    if !problem.equation.has_uniform_material() {
        let message = "a crack on an edge needs a material that is the same everywhere; give numbers for `young` \
                       and `poisson`, or model the whole plate";
        return Some((Key::new("material"), message.to_owned()));
    }
    let given = problem.equation.elastic().and_then(|body| body.eigenstrain.as_deref());
    let is_sheared = given.is_some_and(|given| given.strains[2].constant() != Some(0.0));
    let slides = (0..problem.cracks.len()).any(is_antisymmetric);
    if given.is_some() && (is_sheared || slides) {
        let message = "temperatures and given strains have the symmetry of a crack on an edge only with `symmetry = \
                       true` and without [strain] `xy`; model the whole plate";
        return Some((Key::of("material.expansion"), message.to_owned()));
    }
    if problem.temperature.is_some() {
        let message = "a temperature that is solved for cannot be had with a crack on an edge; model the whole plate";
        return Some((Key::of("temperature.problem"), message.to_owned()));
    }
    if !problem.enrichments.is_empty() {
        let message = "user-defined functions do not satisfy the symmetry of an edge with a crack; leave \
                       [[enrichment]] out, or model the whole plate";
        return Some((Key::new("enrichment").index(0), message.to_owned()));
    }
    let grows = problem.growth.is_some() && (0..problem.cracks.len()).any(is_antisymmetric);
    grows.then(|| {
        let message = "a crack that slides turns off the edge that it lies on; leave [growth] out, or model the \
                       whole plate";
        (Key::new("growth"), message.to_owned())
    })
}
