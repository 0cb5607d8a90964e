//! The text of a problem as it is seen: comments, headings and strings in their colours, errors
//! underlined.

use egui::text::{LayoutJob, TextFormat};
use egui::{Color32, FontId, Stroke, Visuals};

use super::Mark;

/// Font and colours of highlighted text.
#[derive(Clone, Debug)]
pub struct HighlightStyle {
    /// The letters.
    pub font: FontId,
    plain: Color32,
    comment: Color32,
    heading: Color32,
    string: Color32,
    mistake: Color32,
}

/// The role of a part of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum HighlightKind {
    Plain,
    Comment,
    Heading,
    String,
}

impl HighlightStyle {
    /// The looks of a theme.
    #[must_use]
    pub fn new(visuals: &Visuals, font: FontId) -> Self {
        let is_dark = visuals.dark_mode;
        let pick = |dark: [u8; 3], light: [u8; 3]| {
            let [r, g, b] = if is_dark { dark } else { light };
            Color32::from_rgb(r, g, b)
        };
        Self {
            font,
            plain: visuals.text_color(),
            comment: visuals.weak_text_color(),
            heading: pick([110, 180, 240], [0, 90, 160]),
            string: pick([150, 200, 130], [20, 110, 50]),
            mistake: visuals.error_fg_color,
        }
    }

    fn format(&self, kind: HighlightKind, is_wrong: bool) -> TextFormat {
        let color = match kind {
            HighlightKind::Plain => self.plain,
            HighlightKind::Comment => self.comment,
            HighlightKind::Heading => self.heading,
            HighlightKind::String => self.string,
        };
        let mut format = TextFormat::simple(self.font.clone(), color);
        if is_wrong {
            format.underline = Stroke::new(2.0, self.mistake);
        }
        format
    }

    /// The text with its errors, each line in a row of its own.
    #[must_use]
    pub fn layout(&self, text: &str, marks: &[Mark]) -> LayoutJob {
        let mut job = LayoutJob::default();
        job.wrap.max_width = f32::INFINITY;
        for (number, line) in text.split_inclusive('\n').enumerate() {
            let columns = marks.iter().filter_map(|mark| mark.at);
            let wrong = columns.filter(|[at, _]| *at == number + 1).map(|[_, c]| span(line, c));
            let wrong: Vec<[usize; 2]> = wrong.collect();
            for ([start, end], kind) in parts(line) {
                for [from, to, is_wrong] in split([start, end], &wrong) {
                    job.append(&line[from..to], 0.0, self.format(kind, is_wrong == 1));
                }
            }
        }
        if text.is_empty() || text.ends_with('\n') {
            job.append("", 0.0, self.format(HighlightKind::Plain, false));
        }
        job
    }
}

/// The bytes of a line that an error at a column is about: a word, a string or a number.
fn span(line: &str, column: usize) -> [usize; 2] {
    let end_of_line = line.trim_end().len();
    let start = line.char_indices().nth(column.saturating_sub(1)).map_or(line.len(), |(at, _)| at);
    if start >= end_of_line {
        // behind the end: its last letter
        let last = line[..end_of_line].char_indices().next_back().map_or(0, |(at, _)| at);
        return [last, end_of_line];
    }
    let rest = &line[start..end_of_line];
    let length = match rest.chars().next() {
        Some(quote @ ('"' | '\'')) => rest[1..].find(quote).map_or(rest.len(), |at| at + 2),
        Some('[') => rest.rfind(']').map_or(rest.len(), |at| at + 1),
        Some(first) if is_word(first) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
        first => first.map_or(0, char::len_utf8),
    };
    [start, start + length]
}

fn is_word(letter: char) -> bool {
    letter.is_alphanumeric() || matches!(letter, '_' | '-' | '.' | '+')
}

/// The parts of a line of TOML, one behind the other. Strings of several lines are not told apart
/// from others.
fn parts(line: &str) -> Vec<([usize; 2], HighlightKind)> {
    if line.trim_start().starts_with('[') && line.trim_end().ends_with(']') && !line.contains('=') {
        return vec![([0, line.len()], HighlightKind::Heading)];
    }
    let mut parts = Vec::new();
    let (mut start, mut quote) = (0, None);
    for (at, letter) in line.char_indices() {
        match (quote, letter) {
            (None, '#') => {
                parts.push(([start, at], HighlightKind::Plain));
                parts.push(([at, line.len()], HighlightKind::Comment));
                return parts;
            }
            (None, '"' | '\'') => {
                parts.push(([start, at], HighlightKind::Plain));
                (start, quote) = (at, Some(letter));
            }
            (Some(open), letter) if open == letter => {
                parts.push(([start, at + 1], HighlightKind::String));
                (start, quote) = (at + 1, None);
            }
            _ => {}
        }
    }
    let kind = if quote.is_some() { HighlightKind::String } else { HighlightKind::Plain };
    parts.push(([start, line.len()], kind));
    parts
}

/// A part, cut where wrong spans begin and end; 1 behind those that are wrong.
fn split([start, end]: [usize; 2], wrong: &[[usize; 2]]) -> Vec<[usize; 3]> {
    let mut cuts: Vec<usize> = wrong.iter().flatten().copied().collect();
    cuts.retain(|cut| (start..end).contains(cut));
    cuts.extend([start, end]);
    cuts.sort_unstable();
    cuts.dedup();
    let is_wrong = |at: usize| wrong.iter().any(|[from, to]| (*from..*to).contains(&at));
    cuts.windows(2).map(|pair| [pair[0], pair[1], usize::from(is_wrong(pair[0]))]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn underlined(text: &str, line: usize, column: usize) -> String {
        let look = HighlightStyle::new(&Visuals::light(), FontId::monospace(12.0));
        let mark = Mark { at: Some([line, column]), message: String::new() };
        let job = look.layout(text, &[mark]);
        assert_eq!(job.text, text);
        let sections = job.sections.iter().filter(|s| s.format.underline != Stroke::NONE);
        sections.map(|s| &job.text[s.byte_range.start.0..s.byte_range.end.0]).collect()
    }

    #[test]
    fn mistakes_are_underlined_where_they_are() {
        let text = "[domain]\nyong = 1.5e-3 # E\nstate = \"plain strain\"\nσ = [1, 2]\n";
        for (line, column, want) in [
            (1, 2, "domain"),
            (2, 1, "yong"),
            (2, 8, "1.5e-3"),
            (3, 9, "\"plain strain\""),
            (4, 1, "σ"),
            (4, 5, "[1, 2]"),
            // behind the end of a line, and of the text
            (2, 99, "E"),
            (9, 1, ""),
        ] {
            assert_eq!(underlined(text, line, column), want, "{line}:{column}");
        }
    }

    #[test]
    fn every_letter_is_shown_whatever_is_written() {
        for text in ["", "\n", "\"", "a # b \" c\n'", "[x]\n\n[", "é=\"ü\"#ö"] {
            for column in 0..6 {
                underlined(text, 1, column);
            }
        }
    }
}
