//! A small map of the whole body, with where one is, once that is only a part of it.

use egui::{Color32, Rect, Response, Sense, Stroke, StrokeKind, Ui, pos2, vec2};
use ppum::field::Field;
use ppum::vec2::Vec2;
use ppum_figure::canvas::{Canvas, CanvasItem};
use ppum_figure::overlay;
use ppum_figure::ticks::power_of_ten;
use ppum_render::view::View;

use crate::shapes::{self, ImagePlacement};
use crate::widgets::chart::darkened;

/// The larger side of the map, in points of the window.
const SIDE: f32 = 110.0;
/// The map is shown where the body is enlarged more than this.
const ENLARGED: f64 = 2.5;

/// The body as the map shows it: its holes and cracks, drawn once.
pub struct Locator {
    map: View,
    /// The colours on the ground of a light and of a dark window.
    items: [Vec<CanvasItem>; 2],
}

impl Locator {
    /// The map of a body; none of one without size.
    #[must_use]
    pub fn new(field: &Field<'_>) -> Option<Self> {
        let bounds = field.domain.bounds;
        let map = View::hug(bounds, [SIDE as u32; 2]).ok()?;
        let rims = overlay::rims(&map, 1.0, &field.domain.holes, [None; 2]);
        let items = [rims, overlay::cracks(&map, 1.0, &field.step.cracks)].concat();
        let light = Canvas { items, ..Canvas::new(map.pixels, [255; 4]) };
        let dark = darkened(light.clone());
        Some(Self { map, items: [light.items, dark.items] })
    }

    /// The width from the left of the viewport that the map takes in a view that is `times` larger
    /// than the whole body; none where it is not shown.
    pub(crate) fn width(&self, rect: Rect, times: f64) -> f32 {
        let width = self.map.pixels[0] as f32;
        let is_shown = times >= ENLARGED && rect.width() >= 3.0 * width;
        if is_shown { width + 24.0 } else { 0.0 }
    }

    /// Shows the map in the upper left corner of the viewport, if the view is a small part of the
    /// body, with how many `times` larger it is than the whole; the point of the body that was
    /// clicked.
    pub fn show(&self, ui: &Ui, rect: Rect, view: &View, times: f64) -> Option<Vec2> {
        let [width, height] = self.map.pixels.map(|n| n as f32);
        if self.width(rect, times) == 0.0 {
            return None;
        }
        let corner = rect.min + vec2(14.0, 14.0);
        let whole = Rect::from_min_size(corner, vec2(width, height));
        let painter = ui.painter_at(rect);
        painter.rect_filled(whole.expand(4.0), 4.0, Color32::from_black_alpha(150));
        let is_dark = ui.visuals().dark_mode;
        let items = &self.items[usize::from(is_dark)];
        painter.rect_filled(whole, 0.0, Color32::from_gray(if is_dark { 64 } else { 230 }));
        shapes::draw(&painter.with_clip_rect(whole), ImagePlacement::new(corner, 1.0), items);
        self.mark(&painter, whole, view);
        let zoom = format!("×{}", magnification(times));
        let name = format!("Map of the plate, {zoom}");
        let font = egui::FontId::proportional(12.0);
        let galley = painter.layout_no_wrap(zoom, font, Color32::WHITE);
        let below = Rect::from_min_size(whole.left_bottom() + vec2(0.0, 6.0), galley.size());
        painter.rect_filled(below.expand2(vec2(4.0, 1.0)), 4.0, Color32::from_black_alpha(150));
        painter.galley(below.min, galley, Color32::WHITE);
        let response = ui.interact(whole, ui.scope_id().with("locator"), Sense::click());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
        self.clicked(&response, whole)
    }

    /// Marks the view: a box, with lines towards it where it is too small to be seen.
    fn mark(&self, painter: &egui::Painter, whole: Rect, view: &View) {
        let stroke = Stroke::new(1.5, Color32::from_rgb(214, 40, 40));
        let at = self.map.pixel(view.center);
        let at = whole.min + vec2(at.x as f32, at.y as f32);
        let half =
            vec2(view.width as f32, view.height() as f32) / (2.0 * self.map.pixel_size() as f32);
        let seen = Rect::from_center_size(at, (half * 2.0).max(vec2(7.0, 7.0)));
        let painter = painter.with_clip_rect(whole);
        painter.rect_stroke(seen, 0.0, stroke, StrokeKind::Middle);
        if half.x < 3.0 {
            let thin = Stroke::new(0.75, stroke.color);
            painter.line_segment([pos2(whole.left(), at.y), pos2(seen.left(), at.y)], thin);
            painter.line_segment([pos2(seen.right(), at.y), pos2(whole.right(), at.y)], thin);
            painter.line_segment([pos2(at.x, whole.top()), pos2(at.x, seen.top())], thin);
            painter.line_segment([pos2(at.x, seen.bottom()), pos2(at.x, whole.bottom())], thin);
        }
    }

    fn clicked(&self, response: &Response, whole: Rect) -> Option<Vec2> {
        let at = response.interact_pointer_pos().filter(|_| response.clicked())?;
        let pixel = at - whole.min;
        Some(self.map.center + self.map.offset_at(ppum::vec2::vec2(pixel.x.into(), pixel.y.into())))
    }
}

/// How many times, in words: `12`, `10⁶`, `3·10⁹`.
fn magnification(times: f64) -> String {
    let power = times.log10().floor() as i32;
    let digit = (times / 10f64.powi(power)).round();
    match power {
        ..=2 => format!("{times:.0}"),
        _ if digit >= 10.0 => power_of_ten(power + 1),
        _ if digit <= 1.0 => power_of_ten(power),
        _ => format!("{digit}·{}", power_of_ten(power)),
    }
}

#[cfg(test)]
mod tests {
    use super::magnification;

    #[test]
    fn magnifications_in_words() {
        let words = [2.6, 99.6, 1000.0, 3.2e9, 9.9e11, 1e12].map(magnification);
        assert_eq!(words, ["3", "100", "10³", "3·10⁹", "10¹²", "10¹²"]);
    }
}
