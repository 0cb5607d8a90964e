//! The tables `[[hole]]`.

use ppum::domain::Hole;

use super::super::document::Section;
use super::curve::rim;
use super::{all, points};

/// The holes; `None` if one of them cannot be read.
pub(super) fn holes(root: &Section<'_>) -> Option<Vec<Hole>> {
    all(root.sections("hole").into_iter().map(hole))
}

fn hole(section: Section<'_>) -> Option<Hole> {
    let keys = ["center", "radius", "points", "ellipse", "spline", "segments"];
    let section = section.only(&keys, &[]);
    let shapes = ["center", "radius", "points", "ellipse", "spline"];
    let curved = ["ellipse", "spline"].iter().find(|key| section.mentions(key));
    let given = shapes.iter().filter(|key| section.mentions(key)).count();
    match curved {
        Some(key) if given > 1 => {
            return section.get(key)?.error("gives the hole once more; leave one out");
        }
        Some(_) => return Some(Hole::Polygon { points: rim(&section)?? }),
        None => {}
    }
    if let Some(value) = section.get("segments") {
        return value.error("is for curves; remove it");
    }
    let round = section.mentions("center") || section.mentions("radius");
    if section.mentions("points") {
        if round {
            let what = "make a polygon, `center` and `radius` a circle; leave one out";
            return section.get("points")?.error(what);
        }
        return Some(Hole::Polygon { points: points(&section.get("points")?)? });
    }
    let center = section.require("center", "center = [0.0, 0.0]").and_then(|value| value.point());
    let radius = section.require("radius", "radius = 0.5").and_then(|value| value.number());
    Some(Hole::Circle { center: center?, radius: radius? })
}
