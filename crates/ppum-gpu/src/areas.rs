//! Where a picture needs more than smooth terms.
//!
//! A shader that evaluates functions costs twice what one does that has polynomials only, also on the
//! pixels where there are no functions: processors that run many pixels in step take every branch. So the
//! picture is cut into areas, each drawn with the shader it needs.

use ppum::field::Field;
use ppum::vec2::Rect;
use ppum_render::pixels::Pixels;
use ppum_render::view::View;

use crate::groups::{Groups, SMOOTH_GROUP};

/// Side of a tile in pixels.
const TILE: u32 = 16;

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Area {
    /// Left, top, width, height.
    pub(crate) rect: [u32; 4],
    /// Some patch that reaches into it has a term beside the smooth one.
    pub(crate) enriched: bool,
}

/// For each group of functions the box around the patches that use it; the smooth part needs none.
pub(crate) fn boxes(field: &Field<'_>, groups: &Groups) -> Vec<Rect> {
    let mut boxes: Vec<Option<Rect>> = vec![None; groups.len()];
    for patch in 0..field.step.partition.len() {
        let group = |block| groups.slot(field.data.block_function[block])[0];
        let is_smooth = |block: &usize| groups.has_smooth() && group(*block) == SMOOTH_GROUP;
        // a patch's first smooth block is its smooth term
        let first = field.data.blocks(patch).find(is_smooth);
        let support = field.step.partition.support(patch);
        for block in field.data.blocks(patch).filter(|&block| Some(block) != first) {
            let group = group(block) as usize;
            boxes[group] = Some(boxes[group].map_or(support, |known| known.union(&support)));
        }
    }
    boxes.into_iter().flatten().collect()
}

/// The areas of a view, which cover it once.
pub(crate) fn areas(view: &View, boxes: &[Rect]) -> Vec<Area> {
    let [width, height] = view.pixels;
    let pixels = Pixels::new(view);
    let tiles = [width.div_ceil(TILE) as usize, height.div_ceil(TILE) as usize];
    let mut enriched = vec![false; tiles[0] * tiles[1]];
    for covered in boxes {
        let seen = Rect::new(covered.min - view.center, covered.max - view.center);
        let [columns, rows] = pixels.covered(&seen);
        let range = |pixels: std::ops::Range<u32>| {
            (pixels.start / TILE) as usize..pixels.end.div_ceil(TILE) as usize
        };
        for row in range(rows) {
            enriched[row * tiles[0]..][range(columns.clone())].fill(true);
        }
    }
    let rows: Vec<&[bool]> = enriched.chunks(tiles[0]).collect();
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
            areas.push(Area { rect: [x, y, w, h], enriched: run[0] });
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
        let boxes = [
            Rect::around(vec2(0.1, -0.1), vec2(0.2, 0.1)),
            Rect::around(vec2(0.9, -0.6), vec2(0.5, 0.2)),
            Rect::around(vec2(9.0, 9.0), vec2(0.5, 0.2)),
        ];
        let areas = areas(&view, &boxes);
        let mut seen = vec![None; 133 * 71];
        for Area { rect: [x, y, w, h], enriched } in areas {
            for (j, i) in (y..y + h).flat_map(|j| (x..x + w).map(move |i| (j, i))) {
                let pixel = &mut seen[(j * 133 + i) as usize];
                assert!(pixel.replace(enriched).is_none(), "pixel {i}, {j} twice");
            }
        }
        for (index, enriched) in (0..).zip(seen) {
            let p = view.center + view.offset(index % 133, index / 133);
            let inside = boxes.iter().any(|b| b.contains(p));
            assert!(enriched.expect("every pixel") || !inside, "{p:?}");
        }
    }
}
