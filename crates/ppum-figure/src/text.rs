//! Lettering: DejaVu Sans, cut down to Latin, Greek and mathematical signs (`data/README.md`).
//! A character the font lacks is drawn as an empty box. `_{…}` sets a subscript: `σ_{xy}`.

use std::sync::LazyLock;

use ab_glyph::{Font as _, FontRef, Glyph, Point, PxScale, ScaleFont as _, point};
use ppum::printable::printable;
use ppum::vec2::{Vec2, vec2};

use ppum_render::image::Mask;

static FONT: LazyLock<FontRef<'static>> = LazyLock::new(|| {
    let data = include_bytes!("../data/DejaVuSans-subset.ttf");
    FontRef::try_from_slice(data).expect("the embedded font is whole")
});

/// Height of digits and capitals in parts of the size (the length of an em).
pub(crate) const CAP_HEIGHT: f64 = 0.729;

/// Pixels between ascender and descender, which ab_glyph counts sizes in, for an em of `size` pixels.
fn px_scale(size: f64) -> PxScale {
    let em = FONT.units_per_em().expect("the embedded font has an em");
    PxScale::from(size as f32 * FONT.height_unscaled() / em)
}

/// Size of a subscript in parts of the size, and how far it is lowered.
const SUBSCRIPT: f64 = 0.72;
const LOWERED: f64 = 0.17;

/// The glyphs of a line that starts at the origin, and its length. What is not printable is drawn by its
/// number, ends of lines and tabs are blanks.
fn glyphs(text: &str, size: f64) -> (Vec<Glyph>, f64) {
    let text = printable(text).replace(['\n', '\t'], " ");
    let (mut line, mut x) = (Vec::new(), 0.0);
    for (index, piece) in text.split("_{").enumerate() {
        let (subscript, plain) = match piece.split_once('}') {
            Some(parts) if index > 0 => parts,
            _ if index > 0 => (piece, ""),
            _ => ("", piece),
        };
        x = append(&mut line, subscript, SUBSCRIPT * size, point(x, (LOWERED * size) as f32));
        x = append(&mut line, plain, size, point(x, 0.0));
    }
    (line, f64::from(x))
}

/// Appends the glyphs of a piece of text that starts at `at`; returns where it ends.
fn append(line: &mut Vec<Glyph>, text: &str, size: f64, mut at: Point) -> f32 {
    let font = FONT.as_scaled(px_scale(size));
    for c in text.chars() {
        let mut glyph = font.scaled_glyph(c);
        glyph.position = at;
        at.x += font.h_advance(glyph.id);
        line.push(glyph);
    }
    at.x
}

/// Length of a line of text \[pixels\].
#[must_use]
pub(crate) fn width(text: &str, size: f64) -> f64 {
    glyphs(text, size).1
}

/// Draws a line of text from `start`, the left end of its base line.
pub(crate) fn draw(mask: &mut Mask, text: &str, size: f64, start: Vec2) {
    for mut glyph in glyphs(text, size).0 {
        glyph.position.x += start.x as f32;
        glyph.position.y += start.y as f32;
        if let Some(outline) = FONT.outline_glyph(glyph) {
            let corner = outline.px_bounds().min;
            let (left, top) = (corner.x as i64, corner.y as i64);
            outline.draw(|x, y, share| mask.cover(left + i64::from(x), top + i64::from(y), share));
        }
    }
}

/// Draws a line of text that reads upwards, centred on `middle` along its length, its base line at
/// `middle.x`.
pub(crate) fn draw_upwards(mask: &mut Mask, text: &str, size: f64, middle: Vec2) {
    let length = width(text, size);
    let (ascent, descent) = (size.ceil(), (0.3 * size).ceil());
    let mut line = Mask::new([length.ceil() as u32 + 2, (ascent + descent) as u32]);
    draw(&mut line, text, size, vec2(1.0, ascent));
    let left = (middle.x - ascent).round() as i64;
    let top = (middle.y - 0.5 * length - 1.0).round() as i64;
    mask.add(&line.turned_left(), [left, top]);
}

/// The text, or as much of its beginning as fits with an ellipsis.
#[must_use]
pub(crate) fn fitted(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.to_owned();
    }
    let mut short: Vec<char> = text.chars().collect();
    while short.pop().is_some() {
        let shorter = format!("{}…", short.iter().collect::<String>().trim_end());
        if width(&shorter, size) <= room {
            return shorter;
        }
    }
    String::new()
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

    /// DejaVu's digits are 1303/2048 of an em wide and its capitals 1493/2048 high.
    #[test]
    fn sizes_are_those_of_the_em() {
        assert!((width("0000", 100.0) - 4.0 * 100.0 * 1303.0 / 2048.0).abs() < 1e-3);
        let mut mask = Mask::new([100, 140]);
        draw(&mut mask, "H", 100.0, vec2(10.0, 120.0));
        let rows: Vec<u32> = (0..140).filter(|&j| mask.coverage(25, j) > 0.5).collect();
        assert_eq!((rows[0], rows[rows.len() - 1]), (47, 119));
        assert!((CAP_HEIGHT - 1493.0 / 2048.0).abs() < 1e-3);
    }

    #[test]
    fn subscripts_are_smaller_and_lower() {
        let expected = width("σ", 20.0) + SUBSCRIPT * width("xy", 20.0) + width(" at", 20.0);
        assert!((width("σ_{xy} at", 20.0) - expected).abs() < 1e-3);
        let lowest = |text: &str| {
            let mut mask = Mask::new([40, 60]);
            draw(&mut mask, text, 30.0, vec2(2.0, 40.0));
            let covered = |&j: &u32| (0..40).any(|i| mask.coverage(i, j) > 0.5);
            (0..60).filter(covered).max().unwrap()
        };
        assert!(lowest("_{H}") > lowest("H") + 3);
    }

    #[test]
    fn what_is_not_printable_is_drawn_by_its_number() {
        for (text, shown) in
            [("a\u{1b}[31mb", r"a\u001b[31mb"), ("a\u{202e}b", r"a\u202eb"), ("a\nb", "a b")]
        {
            assert_eq!(width(text, 20.0), width(shown, 20.0));
            let drawn = |text: &str| {
                let mut mask = Mask::new([200, 30]);
                draw(&mut mask, text, 20.0, vec2(2.0, 20.0));
                (0..6000).map(|k| mask.coverage(k % 200, k / 200)).collect::<Vec<_>>()
            };
            assert_eq!(drawn(text), drawn(shown));
        }
    }

    #[test]
    fn long_text_ends_in_an_ellipsis() {
        let text = "a rather long title of a plate";
        let short = fitted(text, 12.0, 80.0);
        assert!(short.ends_with('…') && width(&short, 12.0) <= 80.0, "{short}");
        assert!(width(&short, 12.0) > 60.0);
        assert_eq!(fitted(text, 12.0, 1000.0), text);
    }
}
