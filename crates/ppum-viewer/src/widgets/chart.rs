//! A plot of figures, in the window.

use egui::{Align2, FontId, Rect, Sense, Stroke, Ui};
use ppum::vec2::vec2;
use ppum_figure::canvas::{Canvas, CanvasItem};
use ppum_figure::plot::{LEAST, Plot, PlotArea, plot};
use ppum_render::image::Rgba;

use crate::shapes::{self, ImagePlacement};

/// A plot that was shown: what the mouse does with it, and where its values lie.
#[derive(Clone, Debug)]
pub struct PlotWidget {
    /// Its clicks and hovers.
    pub response: egui::Response,
    /// Where its pixels lie.
    pub placed: ImagePlacement,
    /// Where its values lie.
    pub area: PlotArea,
}

/// Points of the window per pixel of a plot, at most: plots are made for pages, which are larger.
pub const SMALLER: f32 = 0.75;

/// Shows a plot under a name in a room of some size \[points\]; a small room shows all of
/// it, smaller.
pub fn chart(ui: &mut Ui, name: &str, figure: &Plot, size: egui::Vec2) -> PlotWidget {
    let scale = [size.x / LEAST[0] as f32, size.y / LEAST[1] as f32];
    scaled_chart(ui, name, figure, size, scale[0].min(scale[1]).clamp(0.1, SMALLER))
}

/// Shows a plot at so many points of the window per pixel.
pub fn scaled_chart(
    ui: &mut Ui,
    name: &str,
    figure: &Plot,
    size: egui::Vec2,
    scale: f32,
) -> PlotWidget {
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, name));
    let pixels = [size.x, size.y].map(|points| ((points / scale) as u32).max(1));
    let mut canvas = plot(figure, pixels);
    if ui.visuals().dark_mode {
        canvas = darkened(canvas);
    }
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 2.0, shapes::color(canvas.paper));
    let placed = ImagePlacement::new(rect.min, scale);
    shapes::draw(&painter, placed, &canvas.items);
    PlotWidget { response, placed, area: PlotArea::new(figure, pixels) }
}

impl PlotWidget {
    /// The value of the horizontal axis at a position in the window.
    pub(crate) fn across(&self, x: f32) -> f64 {
        self.area.across(f64::from((x - self.placed.corner.x) / self.placed.scale))
    }

    /// Draws a line at a value of the horizontal axis, from the lower to the upper end of the
    /// other one.
    pub fn mark(&self, ui: &Ui, value: f64) {
        let PlotArea { corner, size, .. } = self.area;
        let across = self.area.size.x * (value - self.area.across(corner.x));
        let span = self.area.across(corner.x + size.x) - self.area.across(corner.x);
        let top = self.placed.at(corner + vec2(across / span, 0.0));
        let foot = self.placed.at(corner + vec2(across / span, size.y));
        let line = Stroke::new(1.0, ui.visuals().error_fg_color);
        ui.painter().line_segment([top, foot], line);
    }
}

/// A page with its greys turned round, for dark windows; colours are the same.
pub(crate) fn darkened(page: Canvas) -> Canvas {
    let items = page.items.into_iter().map(|item| match item {
        CanvasItem::Line { path, mut pen } => {
            pen.color = turned(pen.color);
            if let Some(halo) = &mut pen.halo {
                halo.color = turned(halo.color);
            }
            CanvasItem::Line { path, pen }
        }
        CanvasItem::Fill { outline, color } => CanvasItem::Fill { outline, color: turned(color) },
        CanvasItem::Text(mut line) => {
            line.color = turned(line.color);
            CanvasItem::Text(line)
        }
        CanvasItem::Inset { corner, canvas } => {
            CanvasItem::Inset { corner, canvas: darkened(canvas) }
        }
        other => other,
    });
    Canvas { size: page.size, paper: turned(page.paper), items: items.collect() }
}

/// Shows a text on a ground at the lower left corner of a plot.
pub fn reading(ui: &Ui, rect: Rect, text: &str) {
    let (font, ink) = (FontId::proportional(13.0), ui.visuals().strong_text_color());
    let painter = ui.painter_at(rect);
    let galley = painter.layout(text.to_owned(), font, ink, rect.width() - 16.0);
    let at = rect.left_bottom() + egui::vec2(8.0, -3.0);
    let place = Align2::LEFT_BOTTOM.anchor_size(at, galley.size());
    painter.rect_filled(place.expand(3.0), 3.0, ui.visuals().extreme_bg_color);
    painter.galley(place.min, galley, ink);
}

fn turned(color: Rgba) -> Rgba {
    let [r, g, b, a] = color;
    let (low, high) = (r.min(g).min(b), r.max(g).max(b));
    let grey = |v: u8| 20 + (u16::from(255 - v) * 225 / 255) as u8;
    if high - low < 12 { [grey(r), grey(g), grey(b), a] } else { color }
}
