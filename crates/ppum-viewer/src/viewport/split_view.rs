//! The direct image against a resampled one: on the left of a divider what is exact, on its right
//! what a grid makes of it.

use egui::{Align2, CursorIcon, FontId, Painter, Pos2, Rect, Sense, Stroke, Ui, pos2};
use ppum_render::view::View;

use super::texture::{LayerTexture, Texture};
use crate::frames::{RenderedFrame, ResampledView};
use crate::session::Pane;
use crate::widgets::ground;

/// The resampled image on its way to the screen.
#[derive(Default)]
pub struct SplitView {
    texture: Texture,
}

/// Half of the width at which the divider is taken hold of.
const HOLD: f32 = 5.0;

impl SplitView {
    /// Shows it, if it is asked for and there.
    pub fn show(
        &mut self,
        ui: &Ui,
        rect: Rect,
        (pane, is_compared): (&mut Pane, bool),
        (frame, layers): (&RenderedFrame, &mut LayerTexture),
        view: &View,
    ) {
        if !is_compared {
            self.texture = Texture::default();
            return;
        }
        let at = divider(ui, rect, pane);
        let Some(other) = &frame.other else { return };
        let is_difference = pane.against.difference;
        let picture = if is_difference { &other.difference } else { &other.picture };
        let right = Rect::from_min_max(pos2(at, rect.top()), rect.max);
        ui.painter().rect_filled(right, 0.0, ground(ui.visuals()));
        let painter = ui.painter_at(right);
        self.texture.show(&painter, picture, view, rect);
        layers.show(&painter, frame, view, rect);
        words(ui, rect, at, other, is_difference);
    }
}

/// The divider, which is dragged; returns where it is.
fn divider(ui: &Ui, rect: Rect, pane: &mut Pane) -> f32 {
    let part = &mut pane.against.divider;
    let at = rect.left() + part.clamp(0.0, 1.0) as f32 * rect.width();
    let hold = Rect::from_x_y_ranges(at - HOLD..=at + HOLD, rect.y_range());
    let response = ui.interact(hold, ui.scope_id().with("divider"), Sense::drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Splitter, true, "Divider"));
    if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged()) {
        *part = f64::from(((pointer.x - rect.left()) / rect.width()).clamp(0.0, 1.0));
    }
    response.on_hover_cursor(CursorIcon::ResizeHorizontal);
    at
}

/// The line, and what stands on its sides.
fn words(ui: &Ui, rect: Rect, at: f32, other: &ResampledView, is_difference: bool) {
    let painter = ui.painter_at(rect);
    painter.vline(at, rect.y_range(), Stroke::new(3.0, ui.visuals().panel_fill));
    painter.vline(at, rect.y_range(), Stroke::new(1.0, ui.visuals().strong_text_color()));
    let method = format!("{} {}²", other.compare.method, other.compare.grid);
    let right = if is_difference { format!("{method} − direct") } else { method };
    let top = rect.top() + 10.0;
    word(ui, &painter, Align2::RIGHT_TOP, pos2(at - 10.0, top), "direct");
    word(ui, &painter, Align2::LEFT_TOP, pos2(at + 10.0, top), &right);
}

fn word(ui: &Ui, painter: &Painter, align: Align2, at: Pos2, text: &str) {
    let ink = ui.visuals().strong_text_color();
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(13.0), ink);
    let rect = align.anchor_size(at, galley.size());
    painter.rect_filled(rect.expand(4.0), 4.0, ui.visuals().panel_fill.gamma_multiply(0.88));
    painter.galley(rect.min, galley, ink);
}
