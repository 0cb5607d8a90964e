//! The areas of an image, by the terms they need beside smooth ones.
//!
//! A shader that evaluates functions costs twice what one does that has smooth terms only, also on
//! the pixels where there are no functions: processors that run many pixels in step take every
//! branch. So the image is cut into areas, each drawn with the shader it needs.

use ppum::vec2::Rect;
use ppum_render::pixels::Pixels;
use ppum_render::view::View;

use crate::scene::bodies::Others;

/// Side of a tile in pixels.
const TILE: u32 = 16;

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PixelArea {
    /// Left, top, width, height.
    pub(crate) rect: [u32; 4],
    /// The terms beside the smooth one of the patches that reach into it.
    pub(crate) others: Others,
}

impl PixelArea {
    /// The whole image.
    pub(crate) fn whole(view: &View, others: Others) -> Self {
        let [width, height] = view.pixels;
        Self { rect: [0, 0, width, height], others }
    }

    /// The first pixel, with these terms.
    pub(crate) fn pixel(others: Others) -> Self {
        Self { rect: [0, 0, 1, 1], others }
    }
}

/// The areas of a view, which cover it once.
pub(crate) fn areas(view: &View, boxes: &[(Rect, Others)]) -> Vec<PixelArea> {
    let [width, height] = view.pixels;
    let pixels = Pixels::new(view);
    let tiles = [width.div_ceil(TILE) as usize, height.div_ceil(TILE) as usize];
    let mut enriched = vec![Others::default(); tiles[0] * tiles[1]];
    for (covered, others) in boxes {
        let seen = Rect::new(covered.min - view.center, covered.max - view.center);
        let [columns, rows] = pixels.covered(&seen);
        let range = |pixels: std::ops::Range<u32>| {
            (pixels.start / TILE) as usize..pixels.end.div_ceil(TILE) as usize
        };
        for row in range(rows) {
            for tile in &mut enriched[row * tiles[0]..][range(columns.clone())] {
                *tile = tile.and(*others);
            }
        }
    }
    let rows: Vec<&[Others]> = enriched.chunks(tiles[0]).collect();
    let (mut areas, mut first) = (Vec::new(), 0);
    for alike in rows.chunk_by(|a, b| a == b) {
        let y = first * TILE;
        let h = (alike.len() as u32 * TILE).min(height - y);
        first += alike.len() as u32;
        let mut column = 0;
        for run in alike[0].chunk_by(|a, b| a == b) {
            let x = column * TILE;
            let w = (run.len() as u32 * TILE).min(width - x);
            column += run.len() as u32;
            areas.push(PixelArea { rect: [x, y, w, h], others: run[0] });
        }
    }
    areas
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::vec2;

    #[test]
    fn areas_cover_the_picture_once_and_hold_the_boxes() {
        let view = View::new(vec2(0.3, -0.2), 2.0, [133, 71]).expect("a view");
        let one = Others { constants: true, polynomials: false, group: Some(3) };
        let other = Others { group: Some(4), ..one };
        let polynomials = Others { constants: false, polynomials: true, group: None };
        let boxes = [
            (Rect::around(vec2(0.1, -0.1), vec2(0.2, 0.1)), one),
            (Rect::around(vec2(-0.1, -0.1), vec2(0.2, 0.1)), other),
            (Rect::around(vec2(0.2, -0.15), vec2(0.3, 0.01)), polynomials),
            (Rect::around(vec2(0.9, -0.6), vec2(0.5, 0.2)), one),
            (Rect::around(vec2(9.0, 9.0), vec2(0.5, 0.2)), polynomials),
        ];
        let areas = areas(&view, &boxes);
        let mut seen = vec![None; 133 * 71];
        for PixelArea { rect: [x, y, w, h], others } in areas {
            for (j, i) in (y..y + h).flat_map(|j| (x..x + w).map(move |i| (j, i))) {
                let pixel = &mut seen[(j * 133 + i) as usize];
                assert!(pixel.replace(others).is_none(), "pixel {i}, {j} twice");
            }
        }
        for (index, others) in (0..).zip(seen) {
            let p = view.center + view.offset(index % 133, index / 133);
            let others = others.expect("every pixel is in an area");
            for (bounds, needed) in &boxes {
                assert!(!bounds.contains(p) || others.and(*needed) == others, "{p:?}");
            }
        }
    }
}
