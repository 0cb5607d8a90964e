//! Numbers of SVG: lists, lengths with units, transforms.

use ppum::vec2::vec2;

use crate::affine::PlaneMap;

/// Takes a number from the begin of a text, behind blanks and at most one comma; `1.5.5` are two
/// numbers, and so are `1-2`.
pub(super) fn take(text: &mut &str) -> Option<f64> {
    let rest = text.trim_start();
    let rest = rest.strip_prefix(',').unwrap_or(rest).trim_start();
    let end = end_of_number(rest.as_bytes());
    let number = rest[..end].parse().ok()?;
    *text = &rest[end..];
    Some(number)
}

/// The length of the longest number at the begin.
fn end_of_number(bytes: &[u8]) -> usize {
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let sign = |at: usize| usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
    let mut end = sign(0);
    end += digits(end);
    if bytes.get(end) == Some(&b'.') {
        end += 1 + digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let exponent = end + 1 + sign(end + 1);
        // `em` and `ex` are units
        if exponent <= bytes.len() && digits(exponent) > 0 {
            end = exponent + digits(exponent);
        }
    }
    end
}

/// All numbers of a text; nothing if there is something else in it.
pub(super) fn numbers(text: &str) -> Option<Vec<f64>> {
    let (mut rest, mut all) = (text, Vec::new());
    while !rest.trim_start().is_empty() {
        all.push(take(&mut rest)?);
    }
    Some(all)
}

/// Pixels of a length, 96 by inch, or a percentage of a whole length; nothing for units of fonts.
pub(super) fn length(text: &str, whole: f64) -> Option<f64> {
    let (mut rest, by_inch) = (text, 96.0);
    let number = take(&mut rest)?;
    let factor = match rest.trim() {
        "" | "px" => 1.0,
        "in" => by_inch,
        "cm" => by_inch / 2.54,
        "mm" => by_inch / 25.4,
        "pt" => by_inch / 72.0,
        "pc" => by_inch / 6.0,
        "%" => 0.01 * whole,
        _ => return None,
    };
    Some(number * factor)
}

/// Millimetres of a length that has a unit of the world.
pub(super) fn millimetres(text: &str) -> Option<f64> {
    let has_unit = ["in", "cm", "mm", "pt", "pc"].iter().any(|unit| text.trim().ends_with(unit));
    has_unit.then(|| length(text, 0.0)).flatten().map(|pixels| pixels * 25.4 / 96.0)
}

/// The map of a `transform`.
pub(super) fn transform(text: &str) -> Option<PlaneMap> {
    let (mut map, mut rest) = (PlaneMap::IDENTITY, text);
    loop {
        rest = rest.trim_start_matches(|c: char| c.is_whitespace() || c == ',');
        if rest.is_empty() {
            return Some(map);
        }
        let (name, after) = rest.split_once('(')?;
        let (values, after) = after.split_once(')')?;
        map = map.after(&one_transform(name.trim(), &numbers(values)?)?);
        rest = after;
    }
}

fn one_transform(name: &str, values: &[f64]) -> Option<PlaneMap> {
    let slope = |degrees: f64| degrees.to_radians().tan();
    Some(match (name, values) {
        ("matrix", &[a, b, c, d, e, f]) => {
            PlaneMap { x: vec2(a, b), y: vec2(c, d), shift: vec2(e, f) }
        }
        ("translate", &[x]) => PlaneMap::shifting(vec2(x, 0.0)),
        ("translate", &[x, y]) => PlaneMap::shifting(vec2(x, y)),
        ("scale", &[s]) => PlaneMap::scaling(s, s),
        ("scale", &[x, y]) => PlaneMap::scaling(x, y),
        ("rotate", &[angle]) => PlaneMap::turning(angle),
        ("rotate", &[angle, x, y]) => {
            let about = PlaneMap::turning(angle).after(&PlaneMap::shifting(-vec2(x, y)));
            PlaneMap::shifting(vec2(x, y)).after(&about)
        }
        ("skewX", &[angle]) => PlaneMap { y: vec2(slope(angle), 1.0), ..PlaneMap::IDENTITY },
        ("skewY", &[angle]) => PlaneMap { x: vec2(1.0, slope(angle)), ..PlaneMap::IDENTITY },
        _ => return None,
    })
}
