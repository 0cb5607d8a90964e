//! Lettering: DejaVu Sans, cut down to Latin, Greek and mathematical signs (`data/README.md`).
//! A character the font lacks is drawn as an empty box. `_{…}` sets a subscript: `σ_{xy}`.

use std::sync::LazyLock;

use ab_glyph::{Font as _, FontRef, Glyph, OutlineCurve, Point, PxScale, ScaleFont as _, point};
use ppum::printable::printable;
use ppum::vec2::{Vec2, vec2};

/// The font's file, TrueType.
pub(crate) const FONT_FILE: &[u8] = include_bytes!("../data/DejaVuSans-subset.ttf");

static FONT: LazyLock<FontRef<'static>> =
    LazyLock::new(|| FontRef::try_from_slice(FONT_FILE).expect("the embedded font is whole"));

/// Height of digits and capitals in parts of the size (the length of an em).
pub(crate) const CAP_HEIGHT: f64 = 0.729;

/// Pixels between ascender and descender, which ab_glyph counts sizes in, for an em of `size`
/// pixels.
fn px_scale(size: f64) -> PxScale {
    let em = FONT.units_per_em().expect("the embedded font has an em");
    PxScale::from(size as f32 * FONT.height_unscaled() / em)
}

/// Size of a subscript in parts of the size, and how far it is lowered.
const SUBSCRIPT: f64 = 0.72;
const LOWERED: f64 = 0.17;

/// A piece of a line in letters of one size.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TextRun {
    pub(crate) text: String,
    /// Length of an em.
    pub(crate) size: f64,
    /// How far below the line's base line its own one lies.
    pub(crate) lowered: f64,
}

/// The pieces of a line, none of them empty. Characters that are not printable are shown by their
/// numbers, ends of lines and tabs are blanks.
pub(crate) fn runs(text: &str, size: f64) -> Vec<TextRun> {
    let text = printable(text).replace(['\n', '\t'], " ");
    let mut runs = Vec::new();
    for (index, piece) in text.split("_{").enumerate() {
        let (subscript, plain) = match piece.split_once('}') {
            Some(parts) if index > 0 => parts,
            _ if index > 0 => (piece, ""),
            _ => ("", piece),
        };
        let (small, lowered) = (SUBSCRIPT * size, LOWERED * size);
        runs.push(TextRun { text: subscript.to_owned(), size: small, lowered });
        runs.push(TextRun { text: plain.to_owned(), size, lowered: 0.0 });
    }
    runs.retain(|run| !run.text.is_empty());
    runs
}

/// The glyphs of a line that starts at the origin, and its length.
fn glyphs(text: &str, size: f64) -> (Vec<Glyph>, f64) {
    let (mut line, mut x) = (Vec::new(), 0.0);
    for run in runs(text, size) {
        let font = FONT.as_scaled(px_scale(run.size));
        for c in run.text.chars() {
            let mut glyph = font.scaled_glyph(c);
            glyph.position = point(x, run.lowered as f32);
            x += font.h_advance(glyph.id);
            line.push(glyph);
        }
    }
    (line, f64::from(x))
}

/// The characters of a text that the font lacks, each once, in their order.
#[must_use]
pub fn missing(text: &str) -> Vec<char> {
    let mut lacking = Vec::new();
    for c in runs(text, 1.0).iter().flat_map(|run| run.text.chars()) {
        if glyph(c) == 0 && !lacking.contains(&c) {
            lacking.push(c);
        }
    }
    lacking
}

/// The number of a character's glyph; 0, an empty box, if the font lacks it.
pub(crate) fn glyph(c: char) -> u16 {
    FONT.glyph_id(c).0
}

/// The way from a character to the next one, in ems.
pub(crate) fn advance(c: char) -> f64 {
    let em = FONT.units_per_em().expect("the embedded font has an em");
    f64::from(FONT.h_advance_unscaled(FONT.glyph_id(c)) / em)
}

/// Length of a line of text \[pixels\].
#[must_use]
pub(crate) fn width(text: &str, size: f64) -> f64 {
    glyphs(text, size).1
}

/// A part of a glyph's outline: the two to four control points of a Bézier curve.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct GlyphCurve(pub(crate) Vec<Vec2>);

impl GlyphCurve {
    /// Chords along the curve.
    pub(crate) fn chords(&self) -> Vec<[Vec2; 2]> {
        const COUNT: usize = 4;
        let between = |a: Vec2, b: Vec2, t: f64| a * (1.0 - t) + b * t;
        // de Casteljau
        let at = |t: f64| {
            let mut points = self.0.clone();
            while points.len() > 1 {
                points = points.windows(2).map(|p| between(p[0], p[1], t)).collect();
            }
            points[0]
        };
        let point = |k: usize| at(k as f64 / COUNT as f64);
        (0..COUNT).map(|k| [point(k), point(k + 1)]).collect()
    }
}

/// The box around some points: least and largest coordinates; of none, the least are +∞.
pub(crate) fn bounds<'p>(points: impl Iterator<Item = &'p Vec2>) -> [Vec2; 2] {
    let start = [vec2(f64::INFINITY, f64::INFINITY), vec2(f64::NEG_INFINITY, f64::NEG_INFINITY)];
    points.fold(start, |[lo, hi], &p| [lo.min(p), hi.max(p)])
}

/// The box around the control points of curves.
pub(crate) fn curve_bounds(curves: &[GlyphCurve]) -> [Vec2; 2] {
    bounds(curves.iter().flat_map(|curve| &curve.0))
}

/// The outlines of a line of text whose base line starts at a point and runs at an angle, from the
/// right towards the page's top.
pub(crate) fn outlines(text: &str, size: f64, start: Vec2, angle: f64) -> Vec<GlyphCurve> {
    let (sin, cos) = angle.sin_cos();
    let turned = |x: f64, y: f64| start + vec2(cos * x + sin * y, cos * y - sin * x);
    let mut curves = Vec::new();
    for glyph in glyphs(text, size).0 {
        let (scale, at) = (f64::from(glyph.scale.y / FONT.height_unscaled()), glyph.position);
        let to_page = |p: Point| {
            turned(
                f64::from(at.x) + scale * f64::from(p.x),
                f64::from(at.y) - scale * f64::from(p.y),
            )
        };
        let outline = FONT.outline(glyph.id).into_iter().flat_map(|outline| outline.curves);
        let points = |curve: OutlineCurve| match curve {
            OutlineCurve::Line(a, b) => vec![a, b],
            OutlineCurve::Quad(a, b, c) => vec![a, b, c],
            OutlineCurve::Cubic(a, b, c, d) => vec![a, b, c, d],
        };
        curves.extend(outline.map(|c| GlyphCurve(points(c).into_iter().map(to_page).collect())));
    }
    curves
}

/// The text, or as much of its beginning as fits with an ellipsis.
#[must_use]
pub(crate) fn fitted(text: &str, size: f64, room: f64) -> String {
    shortened(text, size, room, |kept| {
        let begin: String = text.chars().take(kept).collect();
        format!("{}…", begin.trim_end())
    })
}

/// The text, or as many of its first words as fit with an ellipsis; of one word, its beginning and
/// its end.
#[must_use]
pub(crate) fn abbreviated(text: &str, size: f64, room: f64) -> String {
    let ends = text.match_indices(' ').map(|(end, _)| end);
    let short = |end: usize| format!("{}…", text[..end].trim_end());
    let fits = |text: &String| width(text, size) <= room;
    let mut words = [text.to_owned()].into_iter().chain(ends.rev().map(short));
    words.find(fits).unwrap_or_else(|| squeezed(text, size, room))
}

/// The text, or as much of its beginning and its end as fits with an ellipsis between.
#[must_use]
pub(crate) fn squeezed(text: &str, size: f64, room: f64) -> String {
    let all: Vec<char> = text.chars().collect();
    shortened(text, size, room, |kept| {
        let (begin, end) = (&all[..kept.div_ceil(2)], &all[all.len() - kept / 2..]);
        let [begin, end] = [begin, end].map(|part| part.iter().collect::<String>());
        format!("{}…{}", begin.trim_end(), end.trim_start())
    })
}

/// The text, or the longest of its `short` forms, of so many of its letters, that fits.
fn shortened(text: &str, size: f64, room: f64, short: impl Fn(usize) -> String) -> String {
    if width(text, size) <= room {
        return text.to_owned();
    }
    // texts grow with their letters, of which there may be many
    let (mut fits, mut too_many) = (0, text.chars().count());
    while fits + 1 < too_many {
        let middle = usize::midpoint(fits, too_many);
        match width(&short(middle), size) <= room {
            true => fits = middle,
            false => too_many = middle,
        }
    }
    if fits > 0 { short(fits) } else { String::new() }
}

/// The text in lines that fit, broken between words, and within words that are longer than a line.
/// Ends of lines in it stay; one of nothing but blanks has no lines.
#[must_use]
pub(crate) fn wrapped(text: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines = Vec::new();
    for paragraph in text.trim().lines() {
        let mut line = String::new();
        for word in paragraph.split_whitespace() {
            for part in parts(word, size, room) {
                let longer = if line.is_empty() { part.clone() } else { format!("{line} {part}") };
                if width(&longer, size) <= room || line.is_empty() {
                    line = longer;
                } else {
                    lines.push(std::mem::replace(&mut line, part));
                }
            }
        }
        if !line.is_empty() {
            lines.push(line);
        }
    }
    lines
}

/// A word in parts that fit a line each; each has a character at least.
fn parts(word: &str, size: f64, room: f64) -> Vec<String> {
    if width(word, size) <= room {
        return vec![word.to_owned()];
    }
    let mut parts = vec![String::new()];
    for c in word.chars() {
        let last = parts.last().map_or("", String::as_str);
        if !last.is_empty() && width(&format!("{last}{c}"), size) > room {
            parts.push(String::new());
        }
        parts.last_mut().into_iter().for_each(|part| part.push(c));
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_what_figures_write() {
        let wanted = "0123456789−+×·⁻⁰¹²³⁴⁵⁶⁷⁸⁹[]().,… ABCxyzäéσεφωΩµ∇∂√∞≤≥°";
        for c in wanted.chars() {
            assert_ne!(FONT.glyph_id(c).0, 0, "{c} is missing");
        }
        assert_eq!(FONT.glyph_id('漢').0, 0);
    }

    /// Least and largest coordinates of a text's outlines.
    fn extent(text: &str, size: f64, angle: f64) -> [Vec2; 2] {
        curve_bounds(&outlines(text, size, Vec2::ZERO, angle))
    }

    /// DejaVu's digits are 1303/2048 of an em wide and its capitals 1493/2048 high.
    #[test]
    fn sizes_are_those_of_the_em() {
        assert!((width("0000", 100.0) - 4.0 * 100.0 * 1303.0 / 2048.0).abs() < 1e-3);
        let [lo, hi] = extent("H", 100.0, 0.0);
        assert!((lo.y + 100.0 * 1493.0 / 2048.0).abs() < 1e-3 && hi.y.abs() < 1e-3);
        assert!((CAP_HEIGHT - 1493.0 / 2048.0).abs() < 1e-3);
    }

    #[test]
    fn characters_that_the_font_lacks_are_told() {
        assert_eq!(missing("σ_{xy} of 板 and 板, क"), ['板', 'क']);
        assert!(missing("Kerbspannung σ_{yy} ≤ 3·10⁻⁴ naïve\t\n\u{7}").is_empty());
    }

    #[test]
    fn a_line_is_as_long_as_its_characters() {
        let sum: f64 = "von Mises".chars().map(|c| 20.0 * advance(c)).sum();
        assert!((width("von Mises", 20.0) - sum).abs() < 1e-4);
    }

    /// Text that reads to the right reads upwards after a quarter turn.
    #[test]
    fn text_turns_about_its_start() {
        let ([lo, hi], [low, high]) =
            (extent("Lq", 30.0, 0.0), extent("Lq", 30.0, std::f64::consts::FRAC_PI_2));
        let expected = [vec2(lo.y, -hi.x), vec2(hi.y, -lo.x)];
        assert!((low - expected[0]).length() + (high - expected[1]).length() < 1e-9);
    }

    #[test]
    fn subscripts_are_smaller_and_lower() {
        let expected = width("σ", 20.0) + SUBSCRIPT * width("xy", 20.0) + width(" at", 20.0);
        assert!((width("σ_{xy} at", 20.0) - expected).abs() < 1e-3);
        assert!(extent("_{H}", 30.0, 0.0)[1].y > extent("H", 30.0, 0.0)[1].y + 3.0);
    }

    #[test]
    fn what_is_not_printable_is_drawn_by_its_number() {
        for (text, shown) in
            [("a\u{1b}[31mb", r"a\u001b[31mb"), ("a\u{202e}b", r"a\u202eb"), ("a\nb", "a b")]
        {
            let drawn = |text: &str| outlines(text, 20.0, Vec2::ZERO, 0.0);
            assert_eq!((width(text, 20.0), drawn(text)), (width(shown, 20.0), drawn(shown)));
        }
    }

    /// Nothing is lost, no line is too long, and none could have taken the next word.
    #[test]
    fn long_titles_are_wrapped() {
        let text = "A rather long title of a plate with σ_{xy} and averyveryverylongwordwithoutblanks in it";
        for room in [60.0, 100.0, 170.0, 400.0, 5000.0] {
            let lines = wrapped(text, 12.0, room);
            assert!(lines.iter().all(|line| width(line, 12.0) <= room), "{lines:?}");
            let plain = |text: &str| text.replace(' ', "");
            assert_eq!(plain(&lines.concat()), plain(text));
            for pair in lines.windows(2) {
                let next = pair[1].split(' ').next().unwrap();
                assert!(width(&format!("{} {next}", pair[0]), 12.0) > room, "{pair:?}");
            }
        }
        assert_eq!(wrapped("a\nb  c", 12.0, 900.0), ["a", "b c"]);
        assert_eq!(wrapped("ab", 12.0, 1.0), ["a", "b"]);
        assert!(wrapped(" \n ", 12.0, 900.0).is_empty());
    }

    #[test]
    fn long_text_ends_in_an_ellipsis() {
        let text = "a rather long title of a plate";
        let short = fitted(text, 12.0, 80.0);
        assert!(short.ends_with('…') && width(&short, 12.0) <= 80.0, "{short}");
        assert!(width(&short, 12.0) > 60.0);
        assert_eq!(fitted(text, 12.0, 1000.0), text);
    }

    #[test]
    fn squeezed_text_has_both_ends() {
        let text = "a rather long title of a plate";
        for room in [40.0, 80.0, 120.0, 150.0] {
            let short = squeezed(text, 12.0, room);
            let (begin, end) = short.split_once('…').unwrap();
            assert!(text.starts_with(begin) && text.ends_with(end), "{short}");
            assert!(begin.len().abs_diff(end.len()) < 4, "{short}");
            assert!((room - 20.0..=room).contains(&width(&short, 12.0)), "{short}");
        }
        assert_eq!(squeezed(text, 12.0, 1000.0), text);
        assert_eq!(squeezed(text, 12.0, 1.0), "");
    }
}
