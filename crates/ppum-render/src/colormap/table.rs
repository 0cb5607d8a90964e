//! Colour maps as text tables and CSV: a colour on each line, with or without its position.

use super::paint::{numbers, word};
use super::stops::{ColorFileError, ColorStop, MOST, too_many};

/// The columns of a line.
#[derive(Clone, Debug)]
struct Columns {
    position: Option<usize>,
    color: Color,
    /// Words on each line; 0 if it does not matter.
    count: usize,
}

#[derive(Clone, Debug)]
enum Color {
    Numbers([usize; 3]),
    Word(usize),
}

const FORMS: &str = "write red, green and blue, 0 to 255 or 0 to 1, or #rrggbb, on each line, \
    with or without a position in front";

/// Reads the lines; the first one may name the columns.
pub(super) fn read(text: &str) -> Result<Vec<ColorStop>, ColorFileError> {
    let (mut stops, mut columns) = (Vec::new(), None);
    for (index, line) in text.lines().enumerate() {
        let place = || format!("line {}", index + 1);
        let words = words(line);
        if words.is_empty() {
            continue;
        }
        if columns.is_none() && is_header(&words) {
            columns = named(&words);
            continue;
        }
        let columns = match &columns {
            Some(columns) => columns,
            None => columns.insert(counted(&words).ok_or_else(|| no_color(line, place()))?),
        };
        if stops.len() >= MOST {
            return Err(ColorFileError::new(place(), too_many()));
        }
        let stop = columns.stop(&words, place());
        stops.push(stop.ok_or_else(|| no_color(line, place()))?);
    }
    Ok(stops)
}

fn no_color(line: &str, place: String) -> ColorFileError {
    ColorFileError::new(place, format!("`{}` is not a colour; {FORMS}", excerpt(line)))
}

/// So much of a line as a message can bear.
fn excerpt(line: &str) -> String {
    line.trim().chars().take(60).collect()
}

/// The words of a line before a comment, apart by commas, semicolons or blanks.
fn words(line: &str) -> Vec<&str> {
    let is_gap = |c: char| matches!(c, ',' | ';') || c.is_whitespace();
    let is_comment = |&(at, _): &(usize, &str)| {
        let word = line[at..].split(is_gap).next().unwrap_or_default();
        word.len() != 7 || super::paint::word(word).is_none()
    };
    let end = line.match_indices('#').find(is_comment).map_or(line.len(), |(at, _)| at);
    line[..end].split(is_gap).map(|word| word.trim_matches('"')).filter(|w| !w.is_empty()).collect()
}

/// True if no word is a number or a colour, and the names make sense.
fn is_header(words: &[&str]) -> bool {
    words.iter().all(|text| text.parse::<f64>().is_err() && word(text).is_none())
        && named(words).is_some()
}

/// Columns by their names, in any order.
fn named(words: &[&str]) -> Option<Columns> {
    let names: Vec<String> = words.iter().map(|word| word.to_lowercase()).collect();
    let of = |known: &[&str]| names.iter().position(|name| known.contains(&name.as_str()));
    let channel = |letter: &str, color: &str| of(&[letter, color, &format!("rgb_{letter}")]);
    let position = of(&["scalar", "position", "pos", "value", "x", "t", "point", "points"]);
    let numbers = || Some([channel("r", "red")?, channel("g", "green")?, channel("b", "blue")?]);
    let color = numbers().map(Color::Numbers);
    let color = color.or_else(|| of(&["hex", "color", "colour"]).map(Color::Word))?;
    Some(Columns { position, color, count: 0 })
}

/// Columns by their number.
fn counted(words: &[&str]) -> Option<Columns> {
    let (position, color) = match words.len() {
        1 => (None, Color::Word(0)),
        2 => (Some(0), Color::Word(1)),
        3 => (None, Color::Numbers([0, 1, 2])),
        4 => (Some(0), Color::Numbers([1, 2, 3])),
        _ => return None,
    };
    Some(Columns { position, color, count: words.len() })
}

impl Columns {
    fn stop(&self, words: &[&str], place: String) -> Option<ColorStop> {
        if self.count != 0 && words.len() != self.count {
            return None;
        }
        let number = |k: usize| words.get(k)?.parse().ok().filter(|v: &f64| v.is_finite());
        let paint = match self.color {
            Color::Numbers([r, g, b]) => numbers([number(r)?, number(g)?, number(b)?])?,
            Color::Word(k) => word(words.get(k)?)?,
        };
        let at = match self.position {
            Some(k) => Some(number(k)?),
            None => None,
        };
        Some(ColorStop { at, paint, place })
    }
}
