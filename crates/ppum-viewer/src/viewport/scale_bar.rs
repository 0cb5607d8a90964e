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

/// Draws the bar of a view that is shown in a rectangle: in the `room` that is free of the body,
/// or in the lower left corner.
pub fn show(ui: &Ui, rect: Rect, room: Option<Rect>, view: &View) {
    let points = f64::from(rect.width()) / view.width;
    let room = room.filter(|room| room.height() >= HEIGHT);
    let longest = room.map_or(0.4 * rect.width(), |room| room.width() - 2.0 * ROOM);
    let (length, words) = round_length(LONGEST.min(f64::from(longest)) / points);
    let width = (length * points) as f32;
    let painter = ui.painter_at(rect);
    let ink = ui.visuals().strong_text_color();
    let galley = painter.layout_no_wrap(words, FontId::proportional(13.0), ink);
    let size = vec2(width.max(galley.size().x), galley.size().y + 6.0);
    let start = match room {
        Some(room) => pos2(room.center().x - 0.5 * size.x, room.bottom() - ROOM),
        None => rect.left_bottom() + vec2(14.0, -14.0),
    };
    let ground = Rect::from_min_size(start - vec2(0.0, size.y), size).expand(ROOM);
    painter.rect_filled(ground, 4.0, ui.visuals().panel_fill.gamma_multiply(0.8));
    let stroke = Stroke::new(1.5, ink);
    let start = start + vec2(0.5 * (size.x - width), 0.0);
    let end = start + vec2(width, 0.0);
    painter.line_segment([start, end], stroke);
    for at in [start, end] {
        painter.line_segment([at - vec2(0.0, 4.0), at], stroke);
    }
    let at = pos2(ground.center().x, start.y - 5.0);
    let at = Align2::CENTER_BOTTOM.anchor_size(at, galley.size());
    painter.galley(at.min, galley, ink);
}

/// Room around the bar, and the least height of a room for it \[points\].
const ROOM: f32 = 6.0;
const HEIGHT: f32 = 36.0;

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
