//! A bar that shows how long things are.

use egui::{Align2, FontId, Rect, Stroke, Ui, pos2, vec2};
use ppum_figure::ticks::power_of_ten;
use ppum_render::view::View;

/// The longest bar, in points of the window.
const LONGEST: f64 = 180.0;

/// The length of the bar and its words: the longest of 1, 2 and 5 times a power of ten that fits.
pub(crate) fn round_length(longest: f64) -> (f64, String) {
    let power = longest.log10().floor() as i32;
    let unit = 10f64.powi(power);
    let fits = |n: &&u8| f64::from(**n) * unit <= longest * (1.0 + 1e-9);
    let digit = *[5, 2, 1].iter().find(fits).unwrap_or(&1);
    let words = match power {
        -3..=3 => ppum::text::trimmed(f64::from(digit) * unit),
        _ if digit == 1 => power_of_ten(power),
        _ => format!("{digit}·{}", power_of_ten(power)),
    };
    (f64::from(digit) * unit, words)
}

/// Draws the bar in the lower left corner of a view that is shown in a rectangle.
pub fn show(ui: &Ui, rect: Rect, view: &View) {
    let points = f64::from(rect.width()) / view.width;
    let (length, words) = round_length(LONGEST.min(0.4 * f64::from(rect.width())) / points);
    let width = (length * points) as f32;
    let start = pos2(rect.left() + 14.0, rect.bottom() - 14.0);
    let painter = ui.painter_at(rect);
    let font = FontId::proportional(13.0);
    let ink = ui.visuals().strong_text_color();
    let paper = ui.visuals().panel_fill.gamma_multiply(0.8);
    let galley = painter.layout_no_wrap(words, font, ink);
    let size = vec2(width.max(galley.size().x), galley.size().y + 6.0);
    let ground = Rect::from_min_size(start - vec2(0.0, size.y), size).expand(6.0);
    painter.rect_filled(ground, 4.0, paper);
    let stroke = Stroke::new(1.5, ink);
    let end = start + vec2(width, 0.0);
    painter.line_segment([start, end], stroke);
    for at in [start, end] {
        painter.line_segment([at - vec2(0.0, 4.0), at], stroke);
    }
    let at = Align2::CENTER_BOTTOM.anchor_size(start + vec2(0.5 * size.x, -5.0), galley.size());
    painter.galley(at.min, galley, ink);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_round_and_fit() {
        for k in -400..400 {
            let longest = 10f64.powf(f64::from(k) / 20.0);
            let (length, words) = round_length(longest);
            assert!(length <= longest * (1.0 + 1e-8) && length > 0.39 * longest, "{longest}");
            let digit = length / 10f64.powf(length.log10().floor());
            assert!(
                [1.0, 2.0, 5.0, 10.0].iter().any(|d| (digit / d - 1.0).abs() < 1e-9),
                "{words}"
            );
        }
        assert_eq!(round_length(0.3).1, "0.2");
        assert_eq!(round_length(2.5e-9).1, "2·10⁻⁹");
        assert_eq!(round_length(1.5e7).1, "10⁷");
    }
}
