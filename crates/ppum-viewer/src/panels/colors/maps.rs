//! Colour maps with their colours.

use std::sync::LazyLock;

use egui::{Color32, FontId, Mesh, Painter, Rect, Response, Sense, Ui, pos2, vec2};
use ppum_render::colormap::{Colormap, NAMES};

use crate::shapes::color;
use crate::widgets::chooser::ChooserItem;

/// The built-in maps as choices.
pub(super) static CHOICES: LazyLock<Vec<ChooserItem>> =
    LazyLock::new(|| NAMES.map(choice).to_vec());

static STRIPS: LazyLock<Vec<(&str, Vec<Color32>)>> = LazyLock::new(|| {
    let strip = |name| Colormap::named(name).map(|map| colors(&map)).unwrap_or_default();
    NAMES.map(|name| (name, strip(name))).to_vec()
});

/// Colours of a preview.
const COUNT: usize = 256;

fn choice(name: &str) -> ChooserItem {
    let group = match name {
        "coolwarm" | "vik" | "roma" => "On both sides of zero",
        "twilight" => "For angles",
        "turbo" | "batlow" => "Many colours",
        _ => "From dark to light",
    };
    ChooserItem { value: name.into(), about: String::new(), group }
}

fn colors(map: &Colormap) -> Vec<Color32> {
    map.palette(COUNT).into_iter().map(color).collect()
}

/// A row of the list: colours and name.
pub(super) fn row(ui: &mut Ui, choice: &ChooserItem, is_at: bool) -> Response {
    let size = vec2(ui.available_width(), 20.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let visuals = ui.style().interact_selectable(&response, is_at);
    if is_at || response.hovered() {
        ui.painter().rect_filled(rect, 3.0, visuals.weak_bg_fill);
    }
    let strip = Rect::from_min_size(rect.min + vec2(4.0, 4.0), vec2(0.55 * size.x, 12.0));
    let known = STRIPS.iter().find(|(name, _)| *name == choice.value);
    paint(ui.painter(), strip, known.map_or(&[], |(_, colors)| colors));
    let at = pos2(strip.right() + 8.0, rect.center().y);
    let font = FontId::proportional(13.0);
    ui.painter().text(at, egui::Align2::LEFT_CENTER, &choice.value, font, visuals.text_color());
    let name = choice.value.clone();
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, is_at, &name));
    response
}

/// The colours of a map as a button.
pub(super) fn preview(ui: &mut Ui, map: &Colormap) -> Response {
    let size = vec2(ui.available_width(), 22.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    paint(ui.painter(), rect.shrink(1.0), &colors(map));
    let stroke = ui.style().interact(&response).bg_stroke;
    let stroke =
        egui::Stroke { color: ui.visuals().weak_text_color(), width: stroke.width.max(1.0) };
    ui.painter().rect_stroke(rect.shrink(1.0), 2.0, stroke, egui::StrokeKind::Outside);
    let name = "Choose a colour map";
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
    response.on_hover_text(format!("{}: click to choose another map", map.name))
}

fn paint(painter: &Painter, rect: Rect, colors: &[Color32]) {
    let width = rect.width() / colors.len().max(1) as f32;
    let mut mesh = Mesh::default();
    for (k, color) in colors.iter().enumerate() {
        let corner = pos2(rect.left() + k as f32 * width, rect.top());
        mesh.add_colored_rect(Rect::from_min_size(corner, vec2(width, rect.height())), *color);
    }
    painter.add(mesh);
}
