//! PNG files that say what they show.
//!
//! Texts are stored as `tEXt` chunks, as `iTXt` (UTF-8) where they need it, with what is not
//! [printable](mod@ppum::printable) escaped: programs show them on terminals. See
//! [`ColoredRaster::description`](crate::picture::ColoredRaster::description) for the keys.

use std::borrow::Cow;

use ppum::printable::printable;

use crate::image::Image;

/// A key of 1 to 79 Latin-1 characters and its text.
pub type TextChunk = (String, String);

/// The image as the bytes of a PNG file, sRGB, 8 bits a channel; without opacity if all of it is
/// opaque.
///
/// # Errors
/// A key that is empty, too long or not Latin-1; an image without pixels.
pub fn encode(image: &Image, texts: &[TextChunk]) -> Result<Vec<u8>, ::png::EncodingError> {
    encode_at(image, None, texts)
}

/// Encodes with the size that the image has on paper: its pixels per inch, which the file holds as
/// whole pixels per metre.
///
/// # Errors
/// Those of [`encode`].
pub fn encode_at(
    image: &Image,
    dpi: Option<f64>,
    texts: &[TextChunk],
) -> Result<Vec<u8>, ::png::EncodingError> {
    encode_by(image, dpi, texts, ::png::Compression::default())
}

/// Encodes several times as fast, into a larger file: for frames that are seen and thrown away.
///
/// # Errors
/// An image without pixels.
pub fn encode_quickly(image: &Image) -> Result<Vec<u8>, ::png::EncodingError> {
    encode_by(image, None, &[], ::png::Compression::Fastest)
}

fn encode_by(
    image: &Image,
    dpi: Option<f64>,
    texts: &[TextChunk],
    compression: ::png::Compression,
) -> Result<Vec<u8>, ::png::EncodingError> {
    let (color, data) = color_data(image);
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, image.size[0], image.size[1]);
    encoder.set_color(color);
    encoder.set_depth(::png::BitDepth::Eight);
    encoder.set_compression(compression);
    encoder.set_source_srgb(::png::SrgbRenderingIntent::Perceptual);
    encoder.set_pixel_dims(dpi.map(density));
    describe(&mut encoder, texts)?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&data)?;
    writer.finish()?;
    Ok(bytes)
}

/// Adds texts to a file that is not begun.
pub(crate) fn describe<W: std::io::Write>(
    encoder: &mut ::png::Encoder<'_, W>,
    texts: &[TextChunk],
) -> Result<(), ::png::EncodingError> {
    for (key, text) in texts {
        let text = printable(text).into_owned();
        if text.chars().all(|c| u32::from(c) < 256) {
            encoder.add_text_chunk(key.clone(), text)?;
        } else {
            encoder.add_itxt_chunk(key.clone(), text)?;
        }
    }
    Ok(())
}

fn density(dpi: f64) -> ::png::PixelDimensions {
    const INCHES_PER_METRE: f64 = 1.0 / 0.0254;
    let per_metre = (dpi * INCHES_PER_METRE).round() as u32;
    ::png::PixelDimensions { xppu: per_metre, yppu: per_metre, unit: ::png::Unit::Meter }
}

fn color_data(image: &Image) -> (::png::ColorType, Cow<'_, [u8]>) {
    let pixels = image.rgba.as_chunks::<4>().0;
    if pixels.iter().all(|p| p[3] == 255) {
        let rgb = pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
        (::png::ColorType::Rgb, Cow::Owned(rgb))
    } else {
        (::png::ColorType::Rgba, Cow::Borrowed(&image.rgba))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(bytes: &[u8]) -> (Image, Vec<TextChunk>, ::png::ColorType) {
        let decoder = ::png::Decoder::new(std::io::Cursor::new(bytes));
        let mut reader = decoder.read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut data).unwrap();
        reader.finish().unwrap();
        let info = reader.info();
        let mut texts: Vec<TextChunk> = info
            .uncompressed_latin1_text
            .iter()
            .map(|t| (t.keyword.clone(), t.text.clone()))
            .collect();
        texts.extend(info.utf8_text.iter().map(|t| (t.keyword.clone(), t.get_text().unwrap())));
        let image = Image { size: [info.width, info.height], rgba: data };
        (image, texts, info.color_type)
    }

    fn texts() -> Vec<TextChunk> {
        let text = |k: &str, t: &str| (k.to_owned(), t.to_owned());
        vec![text("Title", "Crack in a plate, 3 µm"), text("ppum:quantity", "σ_yy at 10⁻³")]
    }

    #[test]
    fn pixels_and_texts_come_back() {
        let mut image = Image::filled([3, 2], [10, 20, 30, 255]);
        image.rgba[7] = 0;
        let (back, found, color) = read(&encode(&image, &texts()).unwrap());
        assert_eq!((back, found, color), (image, texts(), ::png::ColorType::Rgba));
    }

    #[test]
    fn quick_files_have_the_same_pixels() {
        let mut image = Image::filled([37, 21], [10, 20, 30, 255]);
        image.rgba.iter_mut().enumerate().for_each(|(k, byte)| *byte = (k * k % 251) as u8);
        let (back, _, color) = read(&encode_quickly(&image).unwrap());
        assert_eq!((back, color), (image, ::png::ColorType::Rgba));
    }

    #[test]
    fn opaque_pictures_have_no_opacity_channel() {
        let bytes = encode(&Image::filled([3, 2], [10, 20, 30, 255]), &[]).unwrap();
        let (back, _, color) = read(&bytes);
        assert_eq!((back.rgba, color), ([10, 20, 30].repeat(6), ::png::ColorType::Rgb));
    }

    /// 300 dots per inch are 11811 per metre.
    #[test]
    fn pictures_have_a_size_on_paper() {
        let image = Image::filled([3, 2], [10, 20, 30, 255]);
        let found = |bytes: Vec<u8>| {
            let reader = ::png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
            reader.info().pixel_dims.map(|d| (d.xppu, d.yppu, d.unit))
        };
        let expected = Some((11811, 11811, ::png::Unit::Meter));
        assert_eq!(found(encode_at(&image, Some(300.0), &[]).unwrap()), expected);
        assert_eq!(found(encode(&image, &[]).unwrap()), None);
    }

    #[test]
    fn texts_obey_no_terminal() {
        let text = ("Title".to_owned(), "a\0b\u{1b}]0;c\u{7}\u{9b}\nσ\u{202e}".to_owned());
        let (_, found, _) = read(&encode(&Image::filled([1, 1], [0; 4]), &[text]).unwrap());
        assert_eq!(found[0].1, "a\\u0000b\\u001b]0;c\\u0007\\u009b\nσ\\u202e");
    }

    #[test]
    fn impossible_keys_are_errors() {
        let image = Image::filled([1, 1], [0; 4]);
        for key in ["", "κ", &"k".repeat(80)] {
            assert!(encode(&image, &[(key.to_owned(), "text".to_owned())]).is_err(), "{key}");
        }
    }
}
