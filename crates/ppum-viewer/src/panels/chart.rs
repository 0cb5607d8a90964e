//! A plot of figures, in the window.

use egui::{Rect, Sense, Ui, pos2, vec2};
use ppum_figure::canvas::{Canvas, Item};
use ppum_figure::plot::{Plot, plot};
use ppum_render::image::Rgba;

use crate::shapes::{self, Placed};

/// A plot that was shown: the room of its curves, and whether it was clicked.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Its clicks and hovers.
    pub response: egui::Response,
    /// The room of the curves in the window.
    pub frame: Rect,
}

/// Shows a plot under a name in a room of some size \[points\].
pub fn chart(ui: &mut Ui, name: &str, figure: &Plot, size: egui::Vec2) -> Chart {
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, name));
    let mut canvas = plot(figure, [size.x as u32, size.y as u32]);
    if ui.visuals().dark_mode {
        darken(&mut canvas);
    }
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 2.0, shapes::color(canvas.paper));
    let scale = (size.x / canvas.size[0] as f32).min(size.y / canvas.size[1] as f32);
    let placed = Placed { corner: rect.min, scale };
    shapes::draw(&painter, placed, &canvas.items);
    Chart { frame: frame(&canvas, placed), response }
}

impl Chart {
    /// The value on a linear horizontal axis at a position of the mouse in the plot.
    #[must_use]
    pub fn value_at(&self, x: f32, [from, to]: [f64; 2]) -> f64 {
        let part = f64::from((x - self.frame.left()) / self.frame.width().max(1.0));
        from + part * (to - from)
    }

    /// The position of a value on it.
    #[must_use]
    pub fn position(&self, value: f64, [from, to]: [f64; 2]) -> f32 {
        let part = (value - from) / (to - from);
        self.frame.left() + part as f32 * self.frame.width()
    }
}

/// The room of the curves, which stand in a page of their own.
fn frame(canvas: &Canvas, placed: Placed) -> Rect {
    let inset = canvas.items.iter().find_map(|item| match item {
        Item::Inset { corner, canvas } => Some((*corner, canvas.size)),
        _ => None,
    });
    let (corner, size) = inset.unwrap_or(([0; 2], canvas.size));
    let corner = placed.corner + vec2(corner[0] as f32, corner[1] as f32) * placed.scale;
    let [width, height] = size.map(|n| n as f32 * placed.scale);
    Rect::from_min_max(corner, pos2(corner.x + width, corner.y + height))
}

/// Turns a page for light paper into one for dark: what is grey changes its brightness, colours stay.
fn darken(canvas: &mut Canvas) {
    canvas.paper = night(canvas.paper);
    for item in &mut canvas.items {
        match item {
            Item::Line { pen, .. } => {
                pen.color = night(pen.color);
                if let Some(halo) = &mut pen.halo {
                    halo.color = night(halo.color);
                }
            }
            Item::Fill { color, .. } => *color = night(*color),
            Item::Text(lettering) => lettering.color = night(lettering.color),
            Item::Inset { canvas, .. } => darken(canvas),
            _ => {}
        }
    }
}

fn night([r, g, b, a]: Rgba) -> Rgba {
    let spread = r.max(g).max(b) - r.min(g).min(b);
    if spread > 40 {
        return [r, g, b, a];
    }
    // not quite from white to black: as dark as the panels around it
    let [r, g, b] = [r, g, b].map(|n| 27 + (u16::from(255 - n) * 200 / 255) as u8);
    [r, g, b, a]
}
