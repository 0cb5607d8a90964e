//! Rules for forces at points, and for points that are held.

use ppum::border::touch;
use ppum::vec2::Vec2;

use crate::data::{ProblemData, is_outside};
use crate::file::{Key, KeyError};
use crate::geometry::shown;

/// All rules broken by the forces.
pub(super) fn check_forces(problem: &ProblemData) -> Vec<KeyError> {
    let key = |index: usize| Key::new("force").index(index);
    if problem.forces.is_empty() {
        return Vec::new();
    }
    let touch = touch(&problem.domain().bounds);
    let places = problem.forces.iter().enumerate().filter_map(|(index, force)| {
        let message = match problem.place_of(force) {
            Ok(place) if problem.room_of(force, place) <= touch => {
                "lies where the displacement, or a component of it, is given; move it, leave it out, or model the whole of a \
                 symmetric body"
                    .into()
            }
            place => place.err()?,
        };
        Some(key(index).name("at").error(format!("{} {message}", shown(force.at))))
    });
    places.collect()
}

/// All rules broken by the supports.
pub(super) fn check_supports(problem: &ProblemData) -> Vec<KeyError> {
    let mut found = Vec::new();
    for (index, support) in problem.supports.iter().enumerate() {
        let key = Key::new("support").index(index);
        let place = misplaced(problem, support.at);
        found.extend(place.map(|message| key.clone().name("at").error(message)));
        if support.displacement == [None; 2] {
            let message = "both components are free, so that nothing is held; give one a value, or leave this \
                           [[support]] out";
            found.push(key.name("displacement").error(message));
        }
    }
    found
}

/// The error of a point that lies outside of the body or on a crack.
fn misplaced(problem: &ProblemData, p: Vec2) -> Option<String> {
    let (domain, cracks) = (problem.domain(), problem.cracks());
    let (touch, place) = (touch(&domain.bounds), shown(p));
    if is_outside(domain, p, touch) {
        return Some(format!(
            "{place} lies outside of the body; move it into the body, or onto its border"
        ));
    }
    if problem.forces.iter().any(|force| (force.at - p).length() <= touch) {
        return Some(format!(
            "{place} is the point of a [[force]], which moves without end; hold another one"
        ));
    }
    let crack = cracks.iter().position(|crack| crack.distance(p) <= touch)?;
    Some(format!("{place} lies on crack {crack}, whose faces move apart; move it off the crack"))
}
