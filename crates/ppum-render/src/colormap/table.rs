//! Colour maps as text: red, green and blue on each line, with or without a position in front.

use super::paint::Rgb;
use super::stops::{ColorFileError, ColorStop, MOST, too_many};

/// Reads the lines; the first one may name the columns.
pub(super) fn read(text: &str) -> Result<Vec<ColorStop>, ColorFileError> {
    let (mut stops, mut columns) = (Vec::new(), None);
    for (index, line) in text.lines().enumerate() {
        let place = format!("line {}", index + 1);
        let content = line.split('#').next().unwrap_or_default();
        let is_gap = |c: char| matches!(c, ',' | ';') || c.is_whitespace();
        let words = content.split(is_gap).filter(|word| !word.is_empty());
        let values: Vec<Option<f64>> = words.map(|word| word.parse().ok()).collect();
        let is_header = columns.is_none() && values.len() > 2 && values.iter().all(Option::is_none);
        // `#rrggbb` is a colour in other programs, no comment
        let is_comment = values.is_empty() && line.trim().parse::<Rgb>().is_err();
        if is_header || is_comment {
            continue;
        }
        if stops.len() >= MOST {
            return Err(ColorFileError::new(place, too_many()));
        }
        let is_as_before = *columns.get_or_insert(values.len()) == values.len();
        let values = values.into_iter().collect::<Option<Vec<f64>>>().filter(|_| is_as_before);
        let (at, color) = match values.as_deref() {
            Some(&[r, g, b]) => (None, [r, g, b]),
            Some(&[at, r, g, b]) if at.is_finite() => (Some(at), [r, g, b]),
            _ => return Err(no_color(line, place)),
        };
        if !color.iter().all(|c| (0.0..=255.0).contains(c)) {
            return Err(no_color(line, place));
        }
        stops.push(ColorStop { at, color, place });
    }
    Ok(stops)
}

fn no_color(line: &str, place: String) -> ColorFileError {
    // so much of a line as a message can bear
    let excerpt: String = line.trim().chars().take(60).collect();
    let forms = "write red, green and blue, 0 to 255 or 0 to 1, on each line, with or without a \
        position in front, or a preset of ParaView (JSON)";
    ColorFileError::new(place, format!("`{excerpt}` is not a colour; {forms}"))
}
