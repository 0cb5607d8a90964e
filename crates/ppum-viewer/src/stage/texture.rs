//! Images on the screen: each where it belongs in the view, whatever view it was made for.

use std::sync::Arc;

use egui::{Color32, ColorImage, Painter, Rect, TextureHandle, TextureOptions, pos2, vec2};
use ppum::vec2::Vec2;
use ppum_render::view::View;

use crate::frames::{ColoredImage, RenderedFrame};
use crate::shapes::{self, ImagePlacement};
use crate::stage::pixels::{self, TextureSlot};

/// An image on its way to the screen; it is sent there once.
#[derive(Default)]
pub struct Texture {
    place: TextureSlot,
    sent: Option<(Arc<ColorImage>, TextureHandle)>,
}

impl Texture {
    /// Draws an image in a rectangle that shows a view.
    pub fn show(
        &mut self,
        painter: &Painter,
        painted: &Arc<ColoredImage>,
        view: &View,
        rect: Rect,
    ) {
        let placed = placed(&painted.view, view, rect);
        let size = painted.image.size.map(|n| n as f32 * placed.scale);
        let target = Rect::from_min_size(placed.corner, vec2(size[0], size[1]));
        // a coarse image looks better smooth; of a fine one pixels are pixels
        let is_coarse = painted.view.pixels[0] < view.pixels[0] / 2;
        if pixels::draw(painter, &self.place, painted, (target, is_coarse)) {
            return;
        }
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        let handle = self.send(painter, painted.texture(), is_coarse);
        painter.image(handle.id(), target, whole, Color32::WHITE);
    }

    fn send(
        &mut self,
        painter: &Painter,
        image: &Arc<ColorImage>,
        is_coarse: bool,
    ) -> &TextureHandle {
        let options = if is_coarse { TextureOptions::LINEAR } else { TextureOptions::NEAREST };
        let fitting = || fitting(painter.ctx(), image);
        let (sent, handle) = self.sent.get_or_insert_with(|| {
            (Arc::clone(image), painter.ctx().load_texture("plate", fitting(), options))
        });
        if !Arc::ptr_eq(sent, image) {
            handle.set(fitting(), options);
            *sent = Arc::clone(image);
        }
        handle
    }
}

/// An image as it fits onto the device: of one that is larger than textures may be every second
/// pixel, or third.
fn fitting(ctx: &egui::Context, image: &Arc<ColorImage>) -> Arc<ColorImage> {
    let most = ctx.input(|input| input.max_texture_side).max(1);
    let [columns, rows] = image.size;
    let step = columns.max(rows).div_ceil(most);
    if step <= 1 {
        return Arc::clone(image);
    }
    let size = [columns, rows].map(|n| n.div_ceil(step));
    let row = |j: usize| image.pixels[j * columns..][..columns].iter().step_by(step).copied();
    let pixels = (0..rows).step_by(step).flat_map(row).collect();
    Arc::new(ColorImage::new(size, pixels))
}

/// Layers made for a view so many times larger or smaller are no longer shown with their signs.
const FAR: f32 = 2.0;

/// Layers on their way to the screen.
#[derive(Default)]
pub struct LayerTexture {
    sent: Option<(Arc<ColorImage>, TextureHandle)>,
}

impl LayerTexture {
    /// Draws the layers of a frame in a rectangle that shows a view.
    pub fn show(&mut self, painter: &Painter, frame: &RenderedFrame, view: &View, rect: Rect) {
        let placed = placed(&frame.layers_view, view, rect);
        let enlarged = placed.scale / placed.pen;
        let is_near = (1.0 / FAR..=FAR).contains(&enlarged);
        let Some(image) = &frame.layers.pixels else {
            self.sent = None;
            let draw = if is_near { shapes::draw } else { shapes::draw_lines };
            return draw(painter, placed, &frame.layers.items);
        };
        if !is_near {
            return;
        }
        if self.sent.as_ref().is_none_or(|(sent, _)| !Arc::ptr_eq(sent, image)) {
            let options = TextureOptions::NEAREST;
            let handle =
                painter.ctx().load_texture("layers", fitting(painter.ctx(), image), options);
            self.sent = Some((Arc::clone(image), handle));
        }
        let Some((_, handle)) = &self.sent else { return };
        let size = image.size.map(|n| n as f32 * placed.scale);
        let target = Rect::from_min_size(placed.corner, vec2(size[0], size[1]));
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        painter.image(handle.id(), target, whole, Color32::WHITE);
    }
}

/// Where an image made for one view lies in a rectangle that shows another.
#[must_use]
pub fn placed(picture: &View, view: &View, rect: Rect) -> ImagePlacement {
    let points = f64::from(rect.width()) / f64::from(view.pixels[0]);
    let corner = picture.offset_at(Vec2::ZERO) + (picture.center - view.center);
    let corner = view.pixel_of_offset(corner) * points;
    ImagePlacement {
        corner: rect.min + vec2(corner.x as f32, corner.y as f32),
        scale: (picture.pixel_size() / view.pixel_size() * points) as f32,
        pen: points as f32,
    }
}
