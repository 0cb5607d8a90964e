//! Readings in words.

pub use ppum_scene::location::{LocationFormat, number};

use ppum::mesh::Shape;

use super::probe::{ProbeReading, SideValue};
use crate::shapes::plain;
use ppum_scene::owner::{MeshElement, Owner};

/// Digits of values, and of those that stand beside them.
pub const DIGITS: usize = 7;
const FEWER: usize = 5;
/// Digits of values at marks.
const SHORT: usize = 4;
const FACES: usize = 4;

/// A value with its unit.
pub(crate) fn value(value: f64, unit: &str) -> String {
    with_unit(value, DIGITS, unit)
}

fn with_unit(value: f64, digits: usize, unit: &str) -> String {
    let number = number(value, digits);
    if unit.is_empty() || !value.is_finite() { number } else { format!("{number} {unit}") }
}

/// Writes the reading of a quantity, with as many digits as suit a whole body.
#[must_use]
pub fn values(probed: &ProbeReading, name: &str, unit: &str) -> String {
    values_to(probed, name, unit, DIGITS)
}

/// Writes the reading with so many digits: `von-mises = 2.71`,
/// `ux = 0.1 above, −0.1 below, jump 0.2`, `syy = ∞ at tip 1`.
pub(crate) fn values_to(probed: &ProbeReading, name: &str, unit: &str, digits: usize) -> String {
    if probed.is_outside() {
        return "outside the plate".into();
    }
    // beside its two terms a difference has less room
    let has_terms = probed.sides.iter().any(|s| s.terms.is_some());
    let digits = if has_terms { digits - (DIGITS - FEWER) } else { digits };
    let value = |v: f64| with_unit(v, digits, unit);
    let of = |sided: &SideValue| value(sided.value);
    match &probed.sides[..] {
        [above, below] => {
            let jump = value(above.value - below.value);
            let jump = if jump == "not defined" { "none".into() } else { jump };
            format!("{name} = {} above, {} below, jump {jump}", of(above), of(below))
        }
        [only] if probed.is_mirrored => format!("{name} = {}, mirrored", of(only)),
        [only] => match probed.tip {
            Some(tip) => format!("{name} = {} at tip {tip}", of(only)),
            None => format!("{name} = {}", of(only)),
        },
        _ => String::new(),
    }
}

/// The values at a point in few letters, for its mark: `0.9871`, `219.7 above, 222 below`.
pub(crate) fn short_values(probed: &ProbeReading) -> String {
    let of = |sided: &SideValue| {
        let side = sided.side.map_or(String::new(), |side| format!(" {}", side.name()));
        number(sided.value, SHORT) + &side
    };
    match probed.is_outside() {
        true => "outside".into(),
        false => probed.sides.iter().map(of).collect::<Vec<_>>().join(", "),
    }
}

/// The two values of a difference: `right 3.1, left 3`; of both sides one after the other. None of
/// what is none.
pub(crate) fn terms(probed: &ProbeReading) -> Option<String> {
    let of = |sided: &SideValue| {
        let [right, left] = sided.terms?;
        let side = sided.side.map_or(String::new(), |side| format!("{} ", side.name()));
        let [right, left] = [right, left].map(|value| number(value, FEWER));
        Some(format!("{side}right {right}, left {left}"))
    };
    let all: Option<Vec<String>> = probed.sides.iter().map(of).collect();
    all.filter(|_| !probed.is_outside()).map(|all| all.join("; "))
}

/// The gradient by its size and direction: `gradient 3.2 at 45°`; of both sides one after the
/// other. None where there is none.
pub(crate) fn gradients(probed: &ProbeReading) -> Option<String> {
    let is_known = probed.sides.iter().any(|sided| !sided.gradient.x.is_nan());
    let all: Vec<_> =
        probed.sides.iter().map(|s| s.slope().unwrap_or_else(|| "∞".into())).collect();
    (is_known && !probed.is_outside()).then(|| format!("gradient {}", all.join(", ")))
}

/// The quantities of a crack's faces, above / below: `closed`, `σn −0.49 / −0.5`, `opening 0`.
pub(crate) fn faces(probed: &ProbeReading) -> Vec<String> {
    let (closed, others): (Vec<_>, Vec<_>) =
        probed.faces.iter().partition(|(symbol, _)| symbol == "closed");
    let state = |(_, values): &(String, Vec<f64>)| match values[..] {
        [1.0] => "closed".to_owned(),
        _ => "open".to_owned(),
    };
    let face = |(symbol, values): &(String, Vec<f64>)| {
        let mut numbers: Vec<String> = values.iter().map(|v| number(*v, FACES)).collect();
        numbers.dedup();
        format!("{} {}", plain(symbol), numbers.join(" / "))
    };
    closed.into_iter().map(state).chain(others.into_iter().map(face)).collect()
}

/// The owner: `cell 312, level 6`; `patch 12` without cells; `element 7, curved triangle, order 4,
/// part 12` of a mesh.
pub(crate) fn owner(probed: &ProbeReading) -> Option<String> {
    probed.owner.map(|owner| match owner {
        Owner::Cell { patch, level } => format!("cell {patch}, level {level}"),
        Owner::Box { patch } => format!("patch {patch}"),
        Owner::Element(element) => element_text(element),
    })
}

fn element_text(element: MeshElement) -> String {
    let MeshElement { patch, number, map_degree, order, is_cut, .. } = element;
    let shape = match element.shape {
        Shape::Triangle => "triangle",
        Shape::Square => "square",
    };
    let curved = if map_degree > 1 { "curved " } else { "" };
    let part = if is_cut { format!(", part {patch}") } else { String::new() };
    format!("element {number}, {curved}{shape}, order {order}{part}")
}

/// The patches with their φ, the largest first: `φ 0.61 of 12, 0.39 of 13`.
#[must_use]
pub fn patches(probed: &ProbeReading) -> Option<String> {
    let all = listed(probed, 3);
    (!all.is_empty()).then(|| format!("φ {}", all.join(", ")))
}

/// The patches with their φ in ever fewer words: all of them, with fewer digits, then the largest
/// alone and `…`.
#[must_use]
pub fn shorter(probed: &ProbeReading) -> Vec<String> {
    let (long, short) = (listed(probed, 3), listed(probed, 2));
    if long.is_empty() {
        return Vec::new();
    }
    let few = (1..short.len()).rev().map(|count| format!("φ {}, …", short[..count].join(", ")));
    let all = [long, short.clone()].map(|all| format!("φ {}", all.join(", ")));
    all.into_iter().chain(few).collect()
}

fn listed(probed: &ProbeReading, digits: usize) -> Vec<String> {
    let mut all = probed.patches.clone();
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    all.iter().map(|(patch, phi)| format!("{} of {patch}", number(*phi, digits))).collect()
}

/// All that is read at a point, as a text to be copied: the place and the values with all
/// their digits.
#[must_use]
pub fn all(probed: &ProbeReading, name: &str, unit: &str) -> String {
    let [x, y] = probed.spot.texts();
    let mut lines = vec![format!("({x}, {y})")];
    if let Some(tip) = probed.tip {
        lines[0] += &format!(", tip {tip}");
    }
    if probed.is_outside() {
        lines[0] += ", outside the plate";
        return lines.join("\n") + "\n";
    }
    for sided in &probed.sides {
        let side = sided.side.map_or(String::new(), |side| format!(" {} the crack", side.name()));
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        lines.push(format!("  {name} = {:?}{unit}{side}", sided.value));
        if let Some([right, left]) = sided.terms {
            lines.push(format!("  right = {right:?}, left = {left:?}{side}"));
        }
        let g = sided.gradient;
        if !g.x.is_nan() {
            lines.push(format!("  gradient = ({:?}, {:?}){side}", g.x, g.y));
        }
    }
    if let Some(jump) = probed.jump() {
        lines.push(format!("  jump = {jump:?}"));
    }
    for (symbol, values) in &probed.faces {
        let values: Vec<_> = values.iter().map(|value| format!("{value:?}")).collect();
        lines.push(format!("  {} = {}", plain(symbol), values.join(" above, ")));
    }
    lines.extend(owner(probed).map(|text| format!("  {text}")));
    lines.extend(patches(probed).map(|text| format!("  {text}")));
    lines.join("\n") + "\n"
}
