//! PNG files that say what they show.
//!
//! Texts are stored as `tEXt` chunks, as `iTXt` (UTF-8) where they need it; see
//! [`Picture::description`](crate::picture::Picture::description) for the keys.

use std::borrow::Cow;
#[cfg(not(target_family = "wasm"))]
use std::path::Path;
use std::path::PathBuf;

use crate::image::Image;

/// A key of 1 to 79 Latin-1 characters and its text.
pub type Text = (String, String);

/// Why no file was written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PngError {
    /// The picture or a text cannot be encoded.
    #[error("cannot encode the picture: {0}")]
    Encode(#[from] ::png::EncodingError),
    /// The file system refused.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file asked for.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
}

/// The picture as the bytes of a PNG file, sRGB, 8 bits a channel; without opacity if all of it is
/// opaque.
///
/// # Errors
/// A key that is empty, too long or not Latin-1; a picture without pixels.
pub fn encode(image: &Image, texts: &[Text]) -> Result<Vec<u8>, PngError> {
    let (color, data) = color_data(image);
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, image.size[0], image.size[1]);
    encoder.set_color(color);
    encoder.set_depth(::png::BitDepth::Eight);
    encoder.set_source_srgb(::png::SrgbRenderingIntent::Perceptual);
    for (key, text) in texts {
        if text.chars().all(|c| u32::from(c) < 256) {
            encoder.add_text_chunk(key.clone(), text.clone())?;
        } else {
            encoder.add_itxt_chunk(key.clone(), text.clone())?;
        }
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&data)?;
    writer.finish()?;
    Ok(bytes)
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

/// Writes the picture to a file. The file appears whole or not at all: it is written beside its place
/// under another name and then moved there.
///
/// # Errors
/// As [`encode`]; whatever the file system refuses.
#[cfg(not(target_family = "wasm"))]
pub fn write(path: &Path, image: &Image, texts: &[Text]) -> Result<(), PngError> {
    let bytes = encode(image, texts)?;
    write_whole(path, &bytes).map_err(|source| PngError::Write { path: path.to_owned(), source })
}

#[cfg(not(target_family = "wasm"))]
fn write_whole(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let no_name = || std::io::Error::new(std::io::ErrorKind::InvalidInput, "no file name");
    let mut name = std::ffi::OsString::from(".");
    name.push(path.file_name().ok_or_else(no_name)?);
    name.push(format!(".{}.tmp", std::process::id()));
    let temporary = path.with_file_name(name);
    let done = std::fs::write(&temporary, bytes).and_then(|()| std::fs::rename(&temporary, path));
    if done.is_err() {
        // The first error is the one to report; a file that never came to be cannot be removed.
        let _ = std::fs::remove_file(&temporary);
    }
    done
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(bytes: &[u8]) -> (Image, Vec<Text>, ::png::ColorType) {
        let decoder = ::png::Decoder::new(std::io::Cursor::new(bytes));
        let mut reader = decoder.read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut data).unwrap();
        reader.finish().unwrap();
        let info = reader.info();
        let mut texts: Vec<Text> = info
            .uncompressed_latin1_text
            .iter()
            .map(|t| (t.keyword.clone(), t.text.clone()))
            .collect();
        texts.extend(info.utf8_text.iter().map(|t| (t.keyword.clone(), t.get_text().unwrap())));
        let image = Image { size: [info.width, info.height], rgba: data };
        (image, texts, info.color_type)
    }

    fn texts() -> Vec<Text> {
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
    fn opaque_pictures_have_no_opacity_channel() {
        let bytes = encode(&Image::filled([3, 2], [10, 20, 30, 255]), &[]).unwrap();
        let (back, _, color) = read(&bytes);
        assert_eq!((back.rgba, color), ([10, 20, 30].repeat(6), ::png::ColorType::Rgb));
    }

    #[test]
    fn impossible_keys_are_errors() {
        let image = Image::filled([1, 1], [0; 4]);
        for key in ["", "κ", &"k".repeat(80)] {
            assert!(encode(&image, &[(key.to_owned(), "text".to_owned())]).is_err(), "{key}");
        }
    }

    #[test]
    fn files_appear_whole_and_alone() {
        let folder = std::env::temp_dir().join(format!("ppum-png-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join("picture.png");
        for value in [1, 2] {
            let image = Image::filled([2, 2], [value; 4]);
            write(&path, &image, &texts()).unwrap();
            assert_eq!(read(&std::fs::read(&path).unwrap()).0, image);
        }
        let names: Vec<_> = std::fs::read_dir(&folder).unwrap().collect();
        assert_eq!(names.len(), 1, "a temporary file was left behind: {names:?}");
        let nowhere = folder.join("missing").join("picture.png");
        let error = write(&nowhere, &Image::filled([2, 2], [0; 4]), &[]).unwrap_err().to_string();
        assert!(error.contains("picture.png"), "{error}");
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
