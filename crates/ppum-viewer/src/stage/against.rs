//! The direct picture against a resampled one: on the left of a divider what is exact, on its right what a grid makes of it.

use std::sync::Arc;

use egui::{
    Align2, Color32, CursorIcon, FontId, Painter, Pos2, Rect, Sense, Stroke, TextureHandle,
    TextureOptions, Ui, pos2, vec2,
};
use ppum_render::view::View;

use super::{ground, placed};
use crate::frames::{Frame, Other};
use crate::session::Pane;
use crate::shapes;

/// The resampled picture on its way to the screen.
#[derive(Default)]
pub struct Against {
    shown: Option<Shown>,
}

struct Shown {
    other: Arc<Other>,
    is_difference: bool,
    handle: TextureHandle,
}

/// Half of the width at which the divider is taken hold of.
const HOLD: f32 = 5.0;

impl Against {
    /// Shows it, if it is asked for and there.
    pub fn show(
        &mut self,
        ui: &Ui,
        rect: Rect,
        (pane, is_compared): (&mut Pane, bool),
        frame: &Frame,
        view: &View,
    ) {
        if !is_compared {
            self.shown = None;
            return;
        }
        let at = divider(ui, rect, pane);
        let Some(other) = &frame.other else { return };
        self.load(ui, other, pane.against.difference);
        let Some(shown) = &self.shown else { return };
        let right = Rect::from_min_max(pos2(at, rect.top()), rect.max);
        let painter = ui.painter_at(right);
        let place = placed(&other.picture.view, view, rect);
        let size = other.picture.image.size.map(|n| n as f32 * place.scale);
        let target = Rect::from_min_size(place.corner, vec2(size[0], size[1]));
        painter.rect_filled(target, 0.0, ground(ui));
        let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
        painter.image(shown.handle.id(), target, whole, Color32::WHITE);
        let layers = placed(&frame.layers_view, view, rect);
        shapes::draw(&painter, layers, &frame.layers.items);
        words(ui, rect, at, other, pane.against.difference);
    }

    fn load(&mut self, ui: &Ui, other: &Arc<Other>, is_difference: bool) {
        let is_there = |shown: &Shown| {
            Arc::ptr_eq(&shown.other, other) && shown.is_difference == is_difference
        };
        if self.shown.as_ref().is_some_and(is_there) {
            return;
        }
        let picture = if is_difference { &other.difference } else { &other.picture };
        let size = picture.image.size.map(|n| n as usize);
        let image = egui::ColorImage::from_rgba_unmultiplied(size, &picture.image.rgba);
        let handle = ui.ctx().load_texture("resampled", image, TextureOptions::NEAREST);
        self.shown = Some(Shown { other: Arc::clone(other), is_difference, handle });
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
fn words(ui: &Ui, rect: Rect, at: f32, other: &Other, is_difference: bool) {
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
