//! Moving pictures: APNG, without loss, and GIF, in 256 colours, for programs that know no other.
//!
//! All images have one size and are shown for one time each, over and over.

mod palette;

use std::borrow::Cow;

use crate::image::Image;
use crate::png::{self, Text};
use palette::Palette;

/// The reason why there is no such moving picture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AnimationError {
    /// No images.
    #[error("a moving picture needs one image at least")]
    Empty,
    /// Images of several sizes.
    #[error("image {index} of a moving picture has {}x{} pixels, the first one {}x{}",
        size[0], size[1], first[0], first[1])]
    Sizes {
        /// The image, counted from 0.
        index: usize,
        /// Its size.
        size: [u32; 2],
        /// That of the first one.
        first: [u32; 2],
    },
    /// A side that GIF has no numbers for.
    #[error("a GIF has at most 65535x65535 pixels, not {}x{}", size[0], size[1])]
    TooLarge {
        /// The size.
        size: [u32; 2],
    },
    /// PNG's own reasons: an impossible key of a text, an image without pixels.
    #[error("cannot encode the moving picture")]
    Png(#[from] ::png::EncodingError),
    /// GIF's own reasons.
    #[error("cannot encode the moving picture")]
    Gif(#[from] ::gif::EncodingError),
}

/// The images as the bytes of an APNG file, each shown for some milliseconds. A program that does not know
/// APNG shows the first one.
///
/// # Errors
/// No images, images of several sizes, an impossible key of a text.
pub fn apng(
    images: &[Image],
    milliseconds: u16,
    texts: &[Text],
) -> Result<Vec<u8>, AnimationError> {
    let size = common_size(images)?;
    let count = u32::try_from(images.len()).unwrap_or(u32::MAX);
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, size[0], size[1]);
    encoder.set_color(::png::ColorType::Rgba);
    encoder.set_depth(::png::BitDepth::Eight);
    encoder.set_source_srgb(::png::SrgbRenderingIntent::Perceptual);
    encoder.set_animated(count, FOR_EVER)?;
    encoder.set_frame_delay(milliseconds, 1000)?;
    png::describe(&mut encoder, texts)?;
    let mut writer = encoder.write_header()?;
    for image in images {
        writer.write_image_data(&image.rgba)?;
    }
    writer.finish()?;
    Ok(bytes)
}

/// APNG's number of plays that never end.
const FOR_EVER: u32 = 0;

/// The images as the bytes of a GIF file, each shown for some milliseconds, which it holds as hundredths of a
/// second. They share one palette of 256 colours: all of theirs if there are no more, else such that none is
/// far off. What is more transparent than opaque is transparent.
///
/// # Errors
/// No images, images of several sizes, a side of more than 65535 pixels.
pub fn gif(images: &[Image], milliseconds: u16) -> Result<Vec<u8>, AnimationError> {
    let size = common_size(images)?;
    let side = |n: u32| u16::try_from(n).map_err(|_| AnimationError::TooLarge { size });
    let (width, height) = (side(size[0])?, side(size[1])?);
    let palette = Palette::of(images);
    let mut bytes = Vec::new();
    let mut encoder = ::gif::Encoder::new(&mut bytes, width, height, &palette.bytes())?;
    encoder.set_repeat(::gif::Repeat::Infinite)?;
    for image in images {
        let frame = ::gif::Frame {
            width,
            height,
            delay: (milliseconds + 5) / 10,
            // what is transparent shows no earlier image
            dispose: ::gif::DisposalMethod::Background,
            transparent: Some(palette::TRANSPARENT),
            buffer: Cow::Owned(palette.indices(image)),
            ..::gif::Frame::default()
        };
        encoder.write_frame(&frame)?;
    }
    drop(encoder);
    Ok(bytes)
}

fn common_size(images: &[Image]) -> Result<[u32; 2], AnimationError> {
    let first = images.first().ok_or(AnimationError::Empty)?.size;
    match images.iter().position(|image| image.size != first) {
        Some(index) => Err(AnimationError::Sizes { index, size: images[index].size, first }),
        None => Ok(first),
    }
}

#[cfg(test)]
mod tests {
    use crate::colormap::Colormap;

    use super::*;

    /// A slope whose colours move, with a corner that is not there.
    fn images(map: &str, count: u32) -> Vec<Image> {
        let colors = Colormap::named(map).unwrap().palette(64);
        let image = |step: u32| {
            let mut image = Image::filled([64, 16], [0; 4]);
            let pixels = image.rgba.as_chunks_mut::<4>().0;
            for (k, pixel) in (0u32..).zip(pixels).skip(5) {
                *pixel = colors[((k + 3 * step) % 64) as usize];
            }
            image
        };
        (0..count).map(image).collect()
    }

    #[test]
    fn apng_is_without_loss() {
        let images = images("viridis", 4);
        let bytes = apng(&images, 40, &[("Title".into(), "Waves".into())]).unwrap();
        let mut reader = ::png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let control = *reader.info().animation_control().unwrap();
        assert_eq!((control.num_frames, control.num_plays), (4, 0));
        for image in &images {
            let mut data = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut data).unwrap();
            assert_eq!(data, image.rgba);
            let frame = reader.info().frame_control().unwrap();
            assert_eq!((frame.delay_num, frame.delay_den), (40, 1000));
        }
        assert_eq!(reader.info().uncompressed_latin1_text[0].text, "Waves");
    }

    fn read(bytes: &[u8]) -> Vec<(u16, Vec<u8>)> {
        let mut options = ::gif::DecodeOptions::new();
        options.set_color_output(::gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(bytes).unwrap();
        let mut frames = Vec::new();
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            frames.push((frame.delay, frame.buffer.to_vec()));
        }
        frames
    }

    #[test]
    fn gif_keeps_few_colours_as_they_are() {
        let images = images("viridis", 3);
        let frames = read(&gif(&images, 44).unwrap());
        assert_eq!(frames.len(), 3);
        for ((delay, found), image) in frames.iter().zip(&images) {
            assert_eq!(*delay, 4);
            let pairs = found.as_chunks::<4>().0.iter().zip(image.rgba.as_chunks::<4>().0);
            assert!(pairs.clone().all(|(a, b)| a == b || (a[3] == 0 && b[3] == 0)));
        }
    }

    /// A thousand colours in 255: as the maps are lines through the cube of colours, none is far off.
    #[test]
    fn gif_takes_many_colours_to_near_ones() {
        let mut image = Image::filled([1024, 3], [0; 4]);
        let maps = ["viridis", "turbo", "twilight"].map(|name| Colormap::named(name).unwrap());
        let colors = maps.iter().flat_map(|map| map.palette(1024));
        image.rgba = colors.flatten().collect();
        let (_, found) = read(&gif(&[image.clone()], 100).unwrap()).remove(0);
        let worst = found.iter().zip(&image.rgba).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(worst < Some(12), "{worst:?}");
    }

    #[test]
    fn what_moves_has_one_size() {
        let mut all = images("magma", 2);
        all.push(Image::filled([3, 3], [0; 4]));
        for error in [apng(&all, 10, &[]).unwrap_err(), gif(&all, 10).unwrap_err()] {
            assert!(matches!(error, AnimationError::Sizes { index: 2, size: [3, 3], .. }));
        }
        assert!(matches!(gif(&[], 10), Err(AnimationError::Empty)));
        let long = Image::filled([65536, 1], [0; 4]);
        assert!(matches!(gif(&[long], 10), Err(AnimationError::TooLarge { .. })));
    }
}
