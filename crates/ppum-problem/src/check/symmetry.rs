//! Rules for cracks on straight lines of the border: halves of symmetric bodies.

use ppum::border::BorderLine;
use ppum::crack::TipId;

use super::super::boundary::{BorderPart, BoundaryCondition};
use super::super::cracks::shown;
use super::super::discretization::Enrichment;
use super::super::key::{Key, MistakeAt};
use super::super::model::Problem;
use super::super::symmetry::Symmetry;

/// All rules broken by cracks on straight lines of the border.
pub(super) fn check_symmetry(problem: &Problem) -> Vec<MistakeAt> {
    let on_lines: Vec<(usize, BorderLine)> = problem.border_cracks().collect();
    let Some((first, _)) = on_lines.first() else { return Vec::new() };
    let of_crack = |(crack, line): &(usize, BorderLine)| {
        let message = bad_crack(problem, *crack, line)?;
        Some(Key::points(*crack).mistake(message))
    };
    let mut found: Vec<MistakeAt> = on_lines.iter().filter_map(of_crack).collect();
    found.extend(bad_conditions(problem, &on_lines));
    found.extend(
        bad_whole(problem, &on_lines)
            .map(|(key, message)| key.mistake(message).with_other(Key::points(*first))),
    );
    found
}

/// The edge, or the side of a polygon, that a line is.
fn name_of(problem: &Problem, crack: usize, line: &BorderLine) -> String {
    match problem.edge_of(crack) {
        Some(edge) => format!("{} edge", edge.name()),
        None => format!("straight side from {} to {}", shown(line.ends[0]), shown(line.ends[1])),
    }
}

/// What is wrong with a crack on a line of the border.
fn bad_crack(problem: &Problem, index: usize, line: &BorderLine) -> Option<String> {
    let (crack, name) = (&problem.cracks[index], name_of(problem, index, line));
    if problem.equation.elastic().is_none() {
        return Some(format!(
            "the crack runs along the {name}; move it into the plate, or leave it out: where nothing is said of the \
             border there is no flux through it"
        ));
    }
    let mut tips = crack.tips().map(|end| TipId { crack: index as u32, end }).peekable();
    if tips.peek().is_none() {
        return Some(format!(
            "no end of the crack on the {name} is a tip: both lie at corners of the body, in holes or on other \
             cracks; let one end between two corners, or leave the crack out: where nothing is said of the border \
             it is free"
        ));
    }
    // no conditions are known where one of them cannot be read
    let is_known = !problem.boundary.is_empty();
    (is_known && tips.any(|tip| problem.symmetry_at(tip).is_none())).then(|| {
        let on = problem.edge_of(index).map_or("{ piece = … }".to_owned(), |edge| format!("\"{}\"", edge.name()));
        format!(
            "the crack runs along the {name}, which nothing holds ahead of its tip; add [[boundary]] with on = {on} \
             and `symmetry = true`, or `antisymmetry = true`, or move the crack into the plate"
        )
    })
}

/// Conditions on lines with cracks that are no symmetry, or another one.
fn bad_conditions(problem: &Problem, on_lines: &[(usize, BorderLine)]) -> Vec<MistakeAt> {
    let bad = |(index, condition): (usize, _)| {
        let key = Key::new("boundary").index(index);
        let (own, crack, message) = bad_condition(problem, condition, on_lines)?;
        Some(key.name(own).mistake(message).with_other(Key::points(crack)))
    };
    problem.boundary.iter().enumerate().filter_map(bad).collect()
}

/// The key that is wrong, the crack that it is wrong with, and the message.
fn bad_condition(
    problem: &Problem,
    condition: &BoundaryCondition,
    on_lines: &[(usize, BorderLine)],
) -> Option<(&'static str, usize, String)> {
    if let BorderPart::Crack { crack, face } = condition.on {
        face?;
        on_lines.iter().find(|(own, _)| *own == crack)?;
        let message = "only one face of a crack on the border is in the plate, and a load on it means the same on \
                       its image; leave `face` out";
        return Some(("on", crack, message.to_owned()));
    }
    let meets = |(_, line): &&(usize, BorderLine)| problem.meets_line(condition.on, line);
    let (crack, line) = on_lines.iter().find(meets)?;
    let name = name_of(problem, *crack, line);
    let message = match (problem.symmetry_on(condition, line), problem.symmetry_of(*crack)) {
        (None, _) => format!(
            "the {name} holds a crack, beside which there can be nothing but symmetry or antisymmetry; give loads \
             to the crack, on = {{ crack = {crack} }}, or move it into the plate"
        ),
        (Some(own), Some(other)) if own != other => format!(
            "the {name} holds a crack and is in part one of symmetry, in part one of antisymmetry; let all of it be \
             of one kind"
        ),
        _ => return None,
    };
    Some(("on", *crack, message))
}

/// What in the rest of a problem does not go with cracks on lines of the border.
fn bad_whole(problem: &Problem, on_lines: &[(usize, BorderLine)]) -> Option<(Key, String)> {
    let is_antisymmetric = |k: usize| problem.symmetry_of(k) == Some(Symmetry::Antisymmetric);
    if problem.discretization.enrichment != Enrichment::Williams {
        let message = "a crack on the border needs the functions of `enrichment = \"williams\"`; leave `enrichment` \
                       out, or model the whole plate";
        return Some((Key::of("discretization.enrichment"), message.to_owned()));
    }
    if !problem.equation.has_uniform_material() {
        let message = "a crack on the border needs a material that is the same everywhere; give numbers for `young` \
                       and `poisson`, or model the whole plate";
        return Some((Key::new("material"), message.to_owned()));
    }
    let given = problem.equation.elastic().and_then(|body| body.eigenstrain.as_deref());
    let is_sheared = given.is_some_and(|given| given.strains[2].constant() != Some(0.0));
    let slides = (0..problem.cracks.len()).any(is_antisymmetric);
    if given.is_some() && (is_sheared || slides) {
        let message = "temperatures and given strains have the symmetry of a crack on the border only with `symmetry = \
                       true` and without [strain] `xy`; model the whole plate";
        return Some((Key::of("material.expansion"), message.to_owned()));
    }
    if problem.temperature.is_some() {
        let message = "a temperature that is solved for cannot be had with a crack on the border; model the whole plate";
        return Some((Key::of("temperature.problem"), message.to_owned()));
    }
    if !problem.enrichments.is_empty() {
        let message = "user-defined functions do not satisfy the symmetry of a border with a crack; leave \
                       [[enrichment]] out, or model the whole plate";
        return Some((Key::new("enrichment").index(0), message.to_owned()));
    }
    let of_rim = |(crack, line): &&(usize, BorderLine)| {
        line.hole.is_some() && problem.contacts.contains_key(&(*crack as u32))
    };
    if let Some((crack, _)) = on_lines.iter().find(of_rim) {
        let message = "one face alone of a crack on the border is in the plate; leave `contact` out, or model the \
                       whole plate";
        return Some((Key::new("crack").index(*crack).name("contact"), message.to_owned()));
    }
    let growth = |message: &str| (Key::new("growth"), message.to_owned());
    let is_oblique = |(_, line): &(usize, BorderLine)| {
        let BorderLine { ends: [a, b], hole } = line;
        hole.is_some() && a.x != b.x && a.y != b.y
    };
    match problem.growth.is_some() {
        true if (0..problem.cracks.len()).any(is_antisymmetric) => Some(growth(
            "a crack that slides turns off the line that it lies on; leave [growth] out, or model the whole plate",
        )),
        true if on_lines.iter().any(is_oblique) => Some(growth(
            "a crack grows along an edge, or along a side of an outline that is horizontal or vertical; turn the \
             body, leave [growth] out, or model the whole plate",
        )),
        _ => None,
    }
}
