//! Curves of the basic shapes of SVG.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, TAU};

use ppum::vec2::{Vec2, vec2};
use roxmltree::Node;

use super::{number, path};
use crate::curve::{EllipseArc, PlaneCurve};
use crate::sketch::DrawnCurve;

/// The curves of an element; nothing if it is none that draws. Percentages are parts of the sides
/// of the view box. Errors are sentences.
pub(super) fn curves(node: Node<'_, '_>, view: Vec2) -> Result<Option<Vec<DrawnCurve>>, String> {
    let curves = match node.tag_name().name() {
        "path" => path::curves(node.attribute("d").unwrap_or_default())?,
        "line" => {
            let [x1, y1, x2, y2] = lengths(node, view, ["x1", "y1", "x2", "y2"])?;
            vec![DrawnCurve::polyline(vec![vec2(x1, y1), vec2(x2, y2)])]
        }
        "polyline" => polyline(points(node)?),
        "polygon" => {
            let mut points = points(node)?;
            points.extend(points.first().copied());
            polyline(points)
        }
        "circle" => {
            let [x, y, r] = lengths(node, view, ["cx", "cy", "r"])?;
            ellipse(vec2(x, y), vec2(r, r))
        }
        "ellipse" => {
            let [x, y, rx, ry] = lengths(node, view, ["cx", "cy", "rx", "ry"])?;
            ellipse(vec2(x, y), vec2(rx, ry))
        }
        "rect" => rect(node, view)?,
        _ => return Ok(None),
    };
    Ok(Some(curves))
}

/// Lengths in user units, 0 if they are missing.
pub(super) fn lengths<const N: usize>(
    node: Node<'_, '_>,
    view: Vec2,
    keys: [&str; N],
) -> Result<[f64; N], String> {
    let mut all = [0.0; N];
    for (value, key) in all.iter_mut().zip(keys) {
        if let Some(text) = node.attribute(key).filter(|text| text.trim() != "auto") {
            *value = number::length(text, whole(key, view)).ok_or_else(|| {
                format!("`{key}` is no length in user units, px or %; write a number")
            })?;
        }
    }
    Ok(all)
}

/// The length of which percentages of an attribute are parts (SVG 2, section 8.9).
fn whole(key: &str, view: Vec2) -> f64 {
    match key {
        "x" | "x1" | "x2" | "cx" | "rx" | "width" => view.x,
        "y" | "y1" | "y2" | "cy" | "ry" | "height" => view.y,
        _ => view.length() * FRAC_1_SQRT_2,
    }
}

fn points(node: Node<'_, '_>) -> Result<Vec<Vec2>, String> {
    let all = number::numbers(node.attribute("points").unwrap_or_default());
    let all = all.filter(|all| all.len().is_multiple_of(2));
    let mut points: Vec<_> = all
        .ok_or("`points` are not pairs of numbers; repair them")?
        .chunks(2)
        .map(|pair| vec2(pair[0], pair[1]))
        .collect();
    points.dedup();
    Ok(points)
}

/// A polyline, if it has two points.
fn polyline(points: Vec<Vec2>) -> Vec<DrawnCurve> {
    if points.len() < 2 { Vec::new() } else { vec![DrawnCurve::polyline(points)] }
}

fn ellipse(center: Vec2, radii: Vec2) -> Vec<DrawnCurve> {
    let arc =
        EllipseArc { center, radii: [vec2(radii.x, 0.0), vec2(0.0, radii.y)], range: [0.0, TAU] };
    let is_drawn = radii.x > 0.0 && radii.y > 0.0;
    is_drawn.then_some(PlaneCurve::Arc(arc).into()).into_iter().collect()
}

/// A rectangle, whose corners may be quarters of ellipses.
fn rect(node: Node<'_, '_>, view: Vec2) -> Result<Vec<DrawnCurve>, String> {
    let [x, y, width, height, rx, ry] =
        lengths(node, view, ["x", "y", "width", "height", "rx", "ry"])?;
    let has = |key: &str| node.has_attribute(key);
    let rx = (if has("rx") { rx } else { ry }).min(0.5 * width).max(0.0);
    let ry = (if has("ry") { ry } else { rx }).min(0.5 * height).max(0.0);
    let (low, high) = (vec2(x, y), vec2(x + width, y + height));
    if width <= 0.0 || height <= 0.0 {
        return Ok(Vec::new());
    }
    if rx == 0.0 || ry == 0.0 {
        let corners = [low, vec2(high.x, low.y), high, vec2(low.x, high.y), low];
        return Ok(polyline(corners.to_vec()));
    }
    let centers = [
        (low.x + rx, low.y + ry),
        (high.x - rx, low.y + ry),
        (high.x - rx, high.y - ry),
        (low.x + rx, high.y - ry),
    ];
    let corner = |(k, (x, y)): (usize, (f64, f64))| EllipseArc {
        center: vec2(x, y),
        radii: [vec2(rx, 0.0), vec2(0.0, ry)],
        range: [2.0, 3.0].map(|quarter| (quarter + k as f64) * FRAC_PI_2),
    };
    let corners: Vec<_> = centers.into_iter().enumerate().map(corner).collect();
    let mut curves = Vec::new();
    for (k, corner) in corners.iter().enumerate() {
        let next = &corners[(k + 1) % 4];
        curves.push(PlaneCurve::Arc(*corner).into());
        let side = [corner.point(corner.range[1]), next.point(next.range[0])];
        if (side[1] - side[0]).length() > 1e-12 * (width + height) {
            curves.push(DrawnCurve::polyline(side.to_vec()));
        }
    }
    Ok(curves)
}
