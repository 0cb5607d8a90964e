//! Rules for cracks on straight lines of the boundary: halves of symmetric bodies.

use ppum::border::BorderLine;
use ppum::crack::TipId;

use super::cracks::line_words;
use crate::data::{BoundaryCondition, BoundaryPart, DomainEdge, ProblemData};
use crate::file::{Key, KeyError};

/// All rules broken by cracks on straight lines of the boundary.
pub(super) fn check_symmetry(problem: &ProblemData) -> Vec<KeyError> {
    let on_lines: Vec<(usize, BorderLine)> = problem.border_cracks().collect();
    let of_crack = |(crack, line): &(usize, BorderLine)| {
        let message = bad_crack(problem, *crack, line)?;
        Some(Key::points(*crack).error(message))
    };
    let mut found: Vec<KeyError> = on_lines.iter().filter_map(of_crack).collect();
    found.extend(bad_conditions(problem, &on_lines));
    found
}

/// Returns the reason why a crack must not lie on a line of the boundary, if there is one.
fn bad_crack(problem: &ProblemData, index: usize, line: &BorderLine) -> Option<String> {
    let (crack, name) = (&problem.cracks()[index], line_words(line));
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
        let on = DomainEdge::of_line(line).map_or("{ piece = … }".to_owned(), |edge| format!("\"{}\"", edge.name()));
        format!(
            "the crack runs along the {name}, which nothing holds ahead of its tip; add [[boundary]] with on = {on} \
             and `symmetry = true`, or `antisymmetry = true`, or move the crack into the plate"
        )
    })
}

/// Conditions on lines with cracks that are no symmetry, or another one.
fn bad_conditions(problem: &ProblemData, on_lines: &[(usize, BorderLine)]) -> Vec<KeyError> {
    let bad = |(index, condition): (usize, _)| {
        let key = Key::new("boundary").index(index);
        let (own, crack, message) = bad_condition(problem, condition, on_lines)?;
        Some(key.name(own).error(message).with_other(Key::points(crack)))
    };
    problem.boundary.iter().enumerate().filter_map(bad).collect()
}

/// The key that is wrong, the crack that it is wrong with, and the message.
fn bad_condition(
    problem: &ProblemData,
    condition: &BoundaryCondition,
    on_lines: &[(usize, BorderLine)],
) -> Option<(&'static str, usize, String)> {
    if let BoundaryPart::Crack { crack, face } = condition.on {
        face?;
        on_lines.iter().find(|(own, _)| *own == crack)?;
        let message = "only one face of a crack on the border is in the plate, and a load on it means the same on \
                       its image; leave `face` out";
        return Some(("on", crack, message.to_owned()));
    }
    let meets = |(_, line): &&(usize, BorderLine)| problem.meets_line(condition.on, line);
    let (crack, line) = on_lines.iter().find(meets)?;
    let name = line_words(line);
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
