//! The part of a body that is searched.

use ppum::field::Field;
use ppum::vec2::{Rect, Vec2};
use ppum_raster::view::View;

/// Distance from the sides of a body's box, in parts of it, up to which a region holds the box.
const ROUNDING: f64 = 1e-9;

/// Columns or rows of the image from which a search begins, at most.
const LONGEST: f64 = 16_384.0;

/// Part of a pixel by which rounding may move the centre of that image.
const MOVED: f64 = 1e-3;

/// A part of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyRegion {
    /// The point from which places are counted.
    pub anchor: Vec2,
    /// A rectangle of offsets from it.
    pub rect: Rect,
}

impl BodyRegion {
    /// The whole body.
    #[must_use]
    pub fn whole(field: &Field<'_>) -> Self {
        let (bounds, anchor) = (field.domain.bounds, field.domain.bounds.center());
        Self { anchor, rect: Rect::new(bounds.min - anchor, bounds.max - anchor) }
    }

    /// The part of a body's box in a rectangle of offsets from an anchor; `None` if there is none.
    /// Rectangles that hold the box make the same region, so that extrema of the whole body have
    /// the same bits in every view.
    #[must_use]
    pub fn new(field: &Field<'_>, anchor: Vec2, rect: Rect) -> Option<Self> {
        let bounds = field.domain.bounds;
        let reach = bounds.size() * ROUNDING;
        let bounds = Rect::new(bounds.min - anchor, bounds.max - anchor);
        let loosened = Rect::new(rect.min - reach, rect.max + reach);
        if loosened.contains(bounds.min) && loosened.contains(bounds.max) {
            return Some(Self::whole(field));
        }
        let rect = rect.intersection(&bounds);
        (rect.min.x <= rect.max.x && rect.min.y <= rect.max.y).then_some(Self { anchor, rect })
    }

    /// The part that a view of the undeformed body shows.
    #[must_use]
    pub fn seen(field: &Field<'_>, view: &View) -> Option<Self> {
        let half = view.half();
        Self::new(field, view.center, Rect::new(-half, half))
    }

    /// The view of the image of so many pixels from which a search begins. `None` of a region that
    /// is a point.
    pub(super) fn grid(&self, pixels: usize) -> Option<View> {
        let (size, middle) = (self.rect.size(), self.rect.center());
        let pixel = (size.x * size.y / pixels as f64).sqrt().max(size.x.max(size.y) / LONGEST);
        if !pixel.is_normal() {
            return None;
        }
        let center = self.anchor + middle;
        let is_exact = ((center - self.anchor) - middle).length() <= MOVED * pixel;
        // around the anchor where the middle is rounded by more
        let (center, size) = match is_exact {
            true => (center, size),
            false => (self.anchor, (-self.rect.min).max(self.rect.max) * 2.0),
        };
        let [columns, rows] = [size.x, size.y].map(|length| (length / pixel).ceil().max(1.0));
        let pixels = [columns as u32, rows as u32];
        Some(View { center, width: columns * pixel, pixels })
    }
}

/// Half the size of the smallest patch around a point, the scale on which the field varies there.
pub(super) fn smallest_patch(field: &Field<'_>, p: Vec2) -> f64 {
    let mut patches = Vec::new();
    field.tree.query_point(p, &mut patches);
    let half = patches.iter().map(|&k| field.step.partition.half(k as usize));
    half.map(|half| half.x.min(half.y)).fold(f64::INFINITY, f64::min)
}
