//! Images in PDF files.

use pdf_writer::types::Predictor;
use pdf_writer::{Filter, Finish as _, Ref};
use ppum_render::image::Image;

use super::File;
use crate::canvas::zlib::zlib;

/// Adds an image without loss; its opacity, where it is not opaque, is a grey image beside it.
pub(super) fn image(file: &mut File, image: &Image) -> Ref {
    let pixels = image.rgba.as_chunks::<4>().0;
    let is_opaque = pixels.iter().all(|p| p[3] == 255);
    let opacity = (!is_opaque).then(|| {
        let place = file.place();
        let shares: Vec<u8> = pixels.iter().map(|p| p[3]).collect();
        channels(file, place, image.size, &shares, None);
        place
    });
    let place = file.place();
    let colors: Vec<u8> = pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
    channels(file, place, image.size, &colors, opacity);
    place
}

/// An image of three channels, or of one.
fn channels(file: &mut File, place: Ref, size: [u32; 2], values: &[u8], opacity: Option<Ref>) {
    let [columns, rows] = size.map(|n| n as i32);
    let count = values.len() / (size[0] as usize * size[1] as usize).max(1);
    let bytes = zlib(&differences(values, size[0] as usize * count));
    let mut record = file.pdf.image_xobject(place, &bytes);
    record.width(columns).height(rows).bits_per_component(8).filter(Filter::FlateDecode);
    match count {
        3 => record.color_space().device_rgb(),
        _ => record.color_space().device_gray(),
    };
    if let Some(opacity) = opacity {
        record.s_mask(opacity);
    }
    let mut how = record.decode_parms();
    how.predictor(Predictor::PngUp).colors(count as i32).bits_per_component(8).columns(columns);
    how.finish();
}

/// Rows as their differences to the row above, the filter `Up` of PNG: colours of fields change
/// slowly.
fn differences(values: &[u8], width: usize) -> Vec<u8> {
    const UP: u8 = 2;
    let mut above = vec![0; width];
    let mut bytes = Vec::with_capacity(values.len() + values.len() / width.max(1));
    for row in values.chunks_exact(width.max(1)) {
        bytes.push(UP);
        bytes.extend(row.iter().zip(&above).map(|(new, old)| new.wrapping_sub(*old)));
        above.copy_from_slice(row);
    }
    bytes
}
