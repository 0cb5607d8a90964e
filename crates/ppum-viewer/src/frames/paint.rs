//! Colours, as pixels of an image and as those that egui shows.

use std::ops::Deref;
use std::sync::{Arc, OnceLock};

use egui::{Color32, ColorImage};
use ppum_render::image::Image;
use ppum_render::picture::{ColoredRaster, Style};
use ppum_render::range::{ColorRange, RangeError};
use ppum_scene::values::PixelValues;

/// An image, and its pixels as egui takes them.
#[derive(Debug)]
pub struct ColoredImage {
    /// The image.
    pub picture: ColoredRaster,
    texture: OnceLock<Arc<ColorImage>>,
}

impl ColoredImage {
    /// An image.
    #[must_use]
    pub fn new(picture: ColoredRaster) -> Self {
        Self { picture, texture: OnceLock::new() }
    }

    /// Its pixels for egui, made when they are needed first.
    pub fn texture(&self) -> &Arc<ColorImage> {
        self.texture.get_or_init(|| Arc::new(texture(&self.picture.image)))
    }

    /// Values in the colours of a range.
    pub(super) fn of(
        drawn: &PixelValues,
        style: &Style,
        span: ColorRange,
    ) -> Result<Self, RangeError> {
        drawn.picture(style, span).map(Self::new)
    }
}

impl Deref for ColoredImage {
    type Target = ColoredRaster;

    fn deref(&self) -> &ColoredRaster {
        &self.picture
    }
}

/// By this thread alone: it may be that of the window, which must not wait for long work of
/// the pool.
fn texture(image: &Image) -> ColorImage {
    let color = |&[r, g, b, a]: &[u8; 4]| Color32::from_rgba_unmultiplied(r, g, b, a);
    let pixels = image.rgba.as_chunks::<4>().0.iter().map(color);
    ColorImage::new(image.size.map(|n| n as usize), pixels.collect())
}
