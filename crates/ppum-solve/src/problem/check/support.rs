//! Rules for points that are held.

use ppum::segment;
use ppum::text::trimmed;
use ppum::vec2::Vec2;

use super::super::cracks::touch;
use super::super::key::{Key, MistakeAt};
use super::super::model::Problem;

/// All rules broken by the supports.
pub(super) fn check_supports(problem: &Problem) -> Vec<MistakeAt> {
    let mut found = Vec::new();
    for (index, support) in problem.supports.iter().enumerate() {
        let key = Key::new("support").index(index);
        let place = misplaced(problem, support.at);
        found.extend(place.map(|message| key.clone().name("at").mistake(message)));
        if support.displacement == [None; 2] {
            let message = "both components are free, so that nothing is held; give one a value, or leave this \
                           [[support]] out";
            found.push(key.name("displacement").mistake(message));
        }
    }
    found
}

/// The mistake of a point that lies outside of the body or on a crack.
fn misplaced(problem: &Problem, p: Vec2) -> Option<String> {
    let Problem { domain, cracks, .. } = problem;
    let (touch, [x, y]) = (touch(&domain.bounds), [p.x, p.y].map(trimmed));
    let is_inside = |hole: &ppum::domain::Hole| hole.contains(p) && hole.rim_distance(p) > touch;
    if !domain.bounds.contains(p) || domain.holes.iter().any(is_inside) {
        return Some(format!(
            "[{x}, {y}] lies outside of the body; move it into the body, or onto its border"
        ));
    }
    let lies_on = |points: &[Vec2]| segment::polyline_distance(points, p) <= touch;
    let crack = cracks.iter().position(|crack| lies_on(&crack.points))?;
    Some(format!("[{x}, {y}] lies on crack {crack}, whose faces move apart; move it off the crack"))
}
