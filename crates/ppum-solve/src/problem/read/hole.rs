//! The tables `[[hole]]`.

use ppum::domain::Hole;

use super::super::document::{Section, Value};
use super::all;

/// The holes; `None` if one of them cannot be read.
pub(super) fn holes(root: &Section<'_>) -> Option<Vec<Hole>> {
    all(root.sections("hole").into_iter().map(hole))
}

fn hole(section: Section<'_>) -> Option<Hole> {
    let section = section.only(&["center", "radius", "points"], &[]);
    let round = section.mentions("center") || section.mentions("radius");
    if section.mentions("points") {
        if round {
            let what = "make a polygon, `center` and `radius` a circle; leave one out";
            return section.get("points")?.error(what);
        }
        let list = section.get("points")?.list("a list of points [[x, y], …]")?;
        let points = all(list.iter().map(Value::point))?;
        return Some(Hole::Polygon { points });
    }
    let center = section.require("center", "center = [0.0, 0.0]").and_then(|value| value.point());
    let radius = section.require("radius", "radius = 0.5").and_then(|value| value.number());
    Some(Hole::Circle { center: center?, radius: radius? })
}
