//! APNG, image by image.

use std::io::Write;

use ::png::{BitDepth, BlendOp, ColorType, Encoder, SrgbRenderingIntent, Writer};

use super::pixel_box::{AnimationError, PixelBox, check_size};
use crate::image::{Image, Rgba};
use crate::png::{self, TextChunk};

/// An APNG file that is being written, without loss of any colour. A program that does not know
/// APNG shows the first image.
pub struct Apng<W: Write> {
    writer: Writer<W>,
    size: [u32; 2],
    announced: u32,
    count: u32,
    /// The image before.
    shown: Vec<Rgba>,
}

/// APNG's number of plays that never end.
const FOR_EVER: u32 = 0;

impl<W: Write> Apng<W> {
    /// A file of `count` images, each shown for some milliseconds.
    ///
    /// # Errors
    /// No images, a size without pixels, an impossible key of a text, those of writing.
    pub fn new(
        out: W,
        size: [u32; 2],
        count: u32,
        milliseconds: u16,
        texts: &[TextChunk],
    ) -> Result<Self, AnimationError> {
        if count == 0 {
            return Err(AnimationError::Empty);
        }
        let mut encoder = Encoder::new(out, size[0], size[1]);
        encoder.set_color(ColorType::Rgba);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
        encoder.set_animated(count, FOR_EVER)?;
        encoder.set_frame_delay(milliseconds, 1000)?;
        // what changed replaces what was there, its opacity too
        encoder.set_blend_op(BlendOp::Source)?;
        png::describe(&mut encoder, texts)?;
        let writer = encoder.write_header()?;
        Ok(Self { writer, size, announced: count, count: 0, shown: Vec::new() })
    }

    /// Writes the next image.
    ///
    /// # Errors
    /// Another size than that of the file, more images than announced, those of writing.
    pub fn add(&mut self, image: &Image) -> Result<(), AnimationError> {
        check_size(self.count, image.size, self.size)?;
        if self.count == self.announced {
            return Err(AnimationError::Count { announced: self.announced, found: self.count + 1 });
        }
        let pixels = image.rgba.as_chunks().0;
        if self.count == 0 {
            self.writer.write_image_data(&image.rgba)?;
        } else {
            self.add_changed(pixels)?;
        }
        self.shown.clear();
        self.shown.extend_from_slice(pixels);
        self.count += 1;
        Ok(())
    }

    fn add_changed(&mut self, pixels: &[Rgba]) -> Result<(), AnimationError> {
        let columns = self.size[0] as usize;
        let changed = PixelBox::between(&self.shown, pixels, columns);
        let ([width, height], [x, y]) =
            (changed.size().map(|n| n as u32), changed.from.map(|n| n as u32));
        self.writer.reset_frame_position()?;
        self.writer.set_frame_dimension(width, height)?;
        self.writer.set_frame_position(x, y)?;
        let data: Vec<u8> = changed.places(columns).flat_map(|at| pixels[at]).collect();
        self.writer.write_image_data(&data)?;
        Ok(())
    }

    /// Ends the file.
    ///
    /// # Errors
    /// Fewer images than announced, those of writing.
    pub fn finish(self) -> Result<(), AnimationError> {
        if self.count < self.announced {
            return Err(AnimationError::Count { announced: self.announced, found: self.count });
        }
        Ok(self.writer.finish()?)
    }
}
