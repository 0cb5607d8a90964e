//! The body of a problem as it is written, whose boundary leads to its conditions in the text.

use egui::{CursorIcon, Painter, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, vec2};
use ppum_render::view::View;

use crate::shapes::{self, ImagePlacement};
use crate::solving::CheckedText;
use crate::solving::border::BorderPart;

/// Draws the geometry of the text: body, holes, cracks, supports and loads. Returns the part of
/// the boundary that is clicked.
pub(super) fn show<'a>(ui: &mut Ui, checked: &'a CheckedText) -> Option<&'a BorderPart> {
    let preview = checked.preview.as_deref()?;
    let width = ui.available_width();
    let size = vec2(width, (0.8 * width).min(ui.available_height().max(160.0)));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let [holes, cracks, ..] = preview.counts();
    let text = format!("The problem as it is written: cracks {cracks}, holes {holes}");
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &text));
    let pixels = [size.x as u32, size.y as u32];
    let painter = ui.painter_at(rect);
    let items = preview.items(pixels, 1.0);
    shapes::draw(&painter, ImagePlacement::new(rect.min, 1.0), &items);
    let (view, at) = (preview.view(pixels)?, response.hover_pos()? - rect.min);
    let at = view.center + view.offset_at(ppum::vec2::vec2(f64::from(at.x), f64::from(at.y)));
    let part = checked.border.part_at(at, REACH * view.pixel_size())?;
    highlight(&painter, rect, &view, part);
    ui.ctx().set_cursor_icon(CursorIcon::PointingHand);
    let response = response.on_hover_text_at_pointer(part.description());
    response.clicked().then_some(part)
}

/// Distance from the boundary within which the pointer is at it \[points\].
const REACH: f64 = 8.0;

/// Draws the edges of a part of the boundary in the colour of selected things.
fn highlight(painter: &Painter, rect: Rect, view: &View, part: &BorderPart) {
    let stroke = Stroke::new(4.0, painter.ctx().global_style().visuals.selection.stroke.color);
    for edge in &part.edges {
        let points = edge.flattened(0.1 * view.pixel_size()).into_iter().map(|point| {
            let at = view.pixel(point);
            rect.min + vec2(at.x as f32, at.y as f32)
        });
        painter.add(Shape::line(points.collect(), stroke));
    }
}
