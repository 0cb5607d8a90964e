//! Images on the screen: each where it belongs in the view, whatever view it was made for.

use std::sync::Arc;

use egui::{Color32, ColorImage, Painter, Rect, TextureHandle, TextureOptions, pos2, vec2};
use ppum::vec2::Vec2;
use ppum_render::view::View;

use crate::frames::{ColoredImage, RenderedFrame};
use crate::memo::Memo;
use crate::same_arc::SameArc;
use crate::shapes::{self, ImagePlacement};
use crate::viewport::pixels::{self, TextureSlot};

/// Pixels on their way to the screen; they are sent there once.
#[derive(Default)]
struct SentPixels(Memo<(SameArc<ColorImage>, bool), TextureHandle>);

impl SentPixels {
    /// Draws pixels where they are placed, a coarse image smoothly.
    fn show(
        &mut self,
        painter: &Painter,
        (image, is_smooth): (&Arc<ColorImage>, bool),
        target: Rect,
    ) {
        let options = if is_smooth { TextureOptions::LINEAR } else { TextureOptions::NEAREST };
        let ctx = painter.ctx();
        let send = || ctx.load_texture("pixels", fitting(ctx, image), options);
        let handle = self.0.get_or_make((image.into(), is_smooth), send);
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        painter.image(handle.id(), target, whole, Color32::WHITE);
    }
}

/// The rectangle of an image of so many pixels.
fn target(placed: &ImagePlacement, size: [usize; 2]) -> Rect {
    let [width, height] = size.map(|n| n as f32 * placed.scale);
    Rect::from_min_size(placed.corner, vec2(width, height))
}

/// An image on its way to the screen.
#[derive(Default)]
pub struct Texture {
    slot: TextureSlot,
    sent: SentPixels,
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
        let size = painted.image.size.map(|n| n as usize);
        let target = target(&placed(&painted.view, view, rect), size);
        // a coarse image looks better smooth; of a fine one pixels are pixels
        let is_coarse = painted.view.pixels[0] < view.pixels[0] / 2;
        if !pixels::draw(painter, &self.slot, painted, (target, is_coarse)) {
            self.sent.show(painter, (painted.texture(), is_coarse), target);
        }
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
pub struct LayerTexture(SentPixels);

impl LayerTexture {
    /// Draws the layers of a frame in a rectangle that shows a view.
    pub fn show(&mut self, painter: &Painter, frame: &RenderedFrame, view: &View, rect: Rect) {
        let placed = placed(&frame.layers_view, view, rect);
        let enlarged = placed.scale / placed.pen;
        let is_near = (1.0 / FAR..=FAR).contains(&enlarged);
        let Some(image) = &frame.layers.pixels else {
            self.0 = SentPixels::default();
            let draw = if is_near { shapes::draw } else { shapes::draw_lines };
            return draw(painter, placed, &frame.layers.items);
        };
        if is_near {
            self.0.show(painter, (image, false), target(&placed, image.size));
        }
    }
}

/// Where an image made for one view lies in a rectangle that shows another.
pub(crate) fn placed(picture: &View, view: &View, rect: Rect) -> ImagePlacement {
    let points = f64::from(rect.width()) / f64::from(view.pixels[0]);
    let corner = picture.offset_at(Vec2::ZERO) + (picture.center - view.center);
    let corner = view.pixel_of_offset(corner) * points;
    ImagePlacement {
        corner: rect.min + vec2(corner.x as f32, corner.y as f32),
        scale: (picture.pixel_size() / view.pixel_size() * points) as f32,
        pen: points as f32,
    }
}
