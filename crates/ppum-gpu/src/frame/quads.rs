//! Patches as quads on the image, for splatting.

use ppum::field::Field;
use ppum::vec2::{Rect, Vec2};
use ppum_render::pixels::Pixels;
use ppum_render::view::View;

use crate::layout::record;

record! {
    /// A quad, clipped to the image. It covers whole pixels; the weight is zero on those the
    /// patch does not reach.
    QuadRecord {
        /// First column and row.
        first: vec2u,
        /// The column and row after the last.
        end: vec2u,
        /// Coordinates ξ of the first pixel in the support, and their steps from column to column
        /// and row to row.
        xi: vec2f,
        step: vec2f,
        /// The point in the frame of the polynomials.
        frame_xi: vec2f,
        frame_step: vec2f,
        /// The address of the patch's body.
        body: u32,
    }
}

/// Bytes of a quad's record.
pub(crate) const QUAD_BYTES: u64 = 64;

/// The quads of a view, in words, and their number. `bodies` holds the address of each patch's
/// body.
pub(crate) fn quads(field: &Field<'_>, view: &View, bodies: &[u32]) -> (Vec<u32>, u32) {
    let pixels = Pixels::new(view);
    let mut visible = Vec::new();
    field.tree.query_box(&pixels.window(), &mut visible);
    let (mut words, mut count) = (Vec::new(), 0);
    for &index in &visible {
        if let Some(record) = quad(field, view, &pixels, index as usize, bodies[index as usize]) {
            words.extend(record.words());
            count += 1;
        }
    }
    (words, count)
}

/// The quad of a patch; none if it meets no pixel.
fn quad(
    field: &Field<'_>,
    view: &View,
    pixels: &Pixels<'_>,
    index: usize,
    body: u32,
) -> Option<QuadRecord> {
    let partition = field.step.partition.boxes();
    let (center, half) = (partition.center[index], partition.half[index]);
    let [columns, rows] = pixels.covered(&Rect::around(center - view.center, half));
    if columns.is_empty() || rows.is_empty() {
        return None;
    }
    let (first, end) = ([columns.start, rows.start], [columns.end, rows.end]);
    let offset = view.offset(first[0], first[1]);
    let (xi, step) = coordinates(view, offset, center, half);
    let (origin, scale) = (partition.origin[index], partition.scale[index]);
    let (frame_xi, frame_step) = coordinates(view, offset, origin, scale);
    Some(QuadRecord { first, end, xi, step, frame_xi, frame_step, body })
}

/// ξ of a pixel, given by its offset from the view's centre, and its steps to the next column
/// and row.
fn coordinates(view: &View, offset: Vec2, origin: Vec2, scale: Vec2) -> ([f32; 2], [f32; 2]) {
    let d = (view.center - origin) + offset;
    let side = view.pixel_size();
    let xi = [d.x / scale.x, d.y / scale.y].map(|v| v as f32);
    (xi, [side / scale.x, -side / scale.y].map(|v| v as f32))
}
