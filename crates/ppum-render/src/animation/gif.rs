//! GIF, image by image.

use std::borrow::Cow;
use std::io::Write;

use ::gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};

use super::palette::ColorCounts;
use super::palette::{GifPalette, TRANSPARENT};
use super::pixel_box::{AnimationError, PixelBox, check_size};
use crate::image::Image;

/// A GIF file that is being written. Its palette of 256 colours is that of all images: all of their
/// colours if there are no more, else such that none is far off. Pixels that are more transparent
/// than opaque are transparent. Times are held as hundredths of a second.
pub struct Gif<W: Write> {
    encoder: Encoder<W>,
    palette: GifPalette,
    size: [u16; 2],
    delay: u16,
    /// Images are transparent somewhere: each takes the place of the one before as a whole, since
    /// nothing that is shown could be wiped out else.
    as_a_whole: bool,
    /// The image before.
    shown: Vec<u8>,
    count: u32,
}

impl<W: Write> Gif<W> {
    /// A file of images that have these colours, each shown for some milliseconds.
    ///
    /// # Errors
    /// A side of more than 65535 pixels, those of writing.
    pub fn new(
        out: W,
        size: [u32; 2],
        colors: &ColorCounts,
        milliseconds: u16,
    ) -> Result<Self, AnimationError> {
        let side = |n: u32| u16::try_from(n).map_err(|_| AnimationError::TooLarge { size });
        let size = [side(size[0])?, side(size[1])?];
        let palette = GifPalette::new(colors);
        let mut encoder = Encoder::new(out, size[0], size[1], &palette.bytes())?;
        encoder.set_repeat(Repeat::Infinite)?;
        let delay = (milliseconds + 5) / 10;
        let (as_a_whole, shown) = (colors.has_transparent(), Vec::new());
        Ok(Self { encoder, palette, size, delay, as_a_whole, shown, count: 0 })
    }

    /// Writes the next image. Colours that were not counted become near ones.
    ///
    /// # Errors
    /// Another size than that of the file, those of writing.
    pub fn add(&mut self, image: &Image) -> Result<(), AnimationError> {
        check_size(self.count, image.size, self.size.map(u32::from))?;
        let indices = self.palette.indices(image);
        let columns = usize::from(self.size[0]);
        let all = PixelBox { from: [0; 2], to: self.size.map(usize::from) };
        let is_whole = self.as_a_whole || self.count == 0;
        let changed =
            if is_whole { all } else { PixelBox::between(&self.shown, &indices, columns) };
        let kept = |at: usize| !is_whole && self.shown[at] == indices[at];
        let seen = |at: usize| if kept(at) { TRANSPARENT } else { indices[at] };
        let buffer = changed.places(columns).map(seen).collect();
        self.write(changed, buffer)?;
        self.shown = indices;
        self.count += 1;
        Ok(())
    }

    fn write(&mut self, changed: PixelBox, buffer: Vec<u8>) -> Result<(), AnimationError> {
        let ([width, height], [left, top]) =
            (changed.size().map(|n| n as u16), changed.from.map(|n| n as u16));
        let dispose =
            if self.as_a_whole { DisposalMethod::Background } else { DisposalMethod::Keep };
        let frame = Frame {
            width,
            height,
            left,
            top,
            dispose,
            delay: self.delay,
            transparent: Some(TRANSPARENT),
            buffer: Cow::Owned(buffer),
            ..Frame::default()
        };
        Ok(self.encoder.write_frame(&frame)?)
    }

    /// Ends the file.
    ///
    /// # Errors
    /// No images, those of writing.
    pub fn finish(self) -> Result<(), AnimationError> {
        if self.count == 0 {
            return Err(AnimationError::Empty);
        }
        // dropped it would not say whether its last byte was written
        let mut out = self.encoder.into_inner()?;
        Ok(out.flush().map_err(EncodingError::from)?)
    }
}
