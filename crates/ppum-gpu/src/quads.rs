//! Patches as quads on the picture, for splatting.

use ppum::field::Field;
use ppum::vec2::{Rect, Vec2};
use ppum_render::pixels::Pixels;
use ppum_render::view::View;

use crate::layout::record;
use crate::region::Region;

record! {
    /// A quad, clipped to the picture. It covers whole pixels; the weight is zero on those the patch does
    /// not reach.
    QuadRecord {
        /// First column and row.
        first: vec2u,
        /// The column and row after the last.
        end: vec2u,
        /// Coordinates ξ of the first pixel in the support, and their steps from column to column and row
        /// to row.
        xi: vec2f,
        step: vec2f,
        /// The same in the frame of the polynomials.
        frame_xi: vec2f,
        frame_step: vec2f,
        /// The patch, by its number in the region.
        index: u32,
    }
}

/// Bytes of a quad's record.
pub(crate) const QUAD_BYTES: u64 = 64;

/// The quads of a view, in words: those of the region's patches that are in sight.
pub(crate) fn quads(field: &Field<'_>, view: &View, region: &Region) -> (Vec<u32>, u32) {
    let pixels = Pixels::new(view);
    let window = pixels.window();
    let partition = &field.step.partition;
    let (mut words, mut count) = (Vec::new(), 0);
    for (index, &number) in (0u32..).zip(&region.patches) {
        let number = number as usize;
        let (center, half) = (partition.center[number], partition.half[number]);
        if !Rect::around(center, half).overlaps(&window) {
            continue;
        }
        let [columns, rows] = pixels.covered(&Rect::around(center - view.center, half));
        if columns.is_empty() || rows.is_empty() {
            continue;
        }
        let first = [columns.start, rows.start];
        let from_center = view.offset(first[0], first[1]);
        let (xi, step) = coordinates(view, from_center, center, half);
        let (frame_xi, frame_step) =
            coordinates(view, from_center, partition.origin[number], partition.scale[number]);
        let end = [columns.end, rows.end];
        let record = QuadRecord { first, end, xi, step, frame_xi, frame_step, index };
        words.extend(record.words());
        count += 1;
    }
    (words, count)
}

/// ξ of a pixel, given by its offset from the view's centre, and its steps to the next column and row.
fn coordinates(view: &View, offset: Vec2, origin: Vec2, scale: Vec2) -> ([f32; 2], [f32; 2]) {
    let d = (view.center - origin) + offset;
    let side = view.pixel_size();
    let xi = [d.x / scale.x, d.y / scale.y].map(|v| v as f32);
    (xi, [side / scale.x, -side / scale.y].map(|v| v as f32))
}
