//! The part of the undeformed body that an image of the deformed one shows.

use ppum::vec2::Rect;
use ppum_raster::view::View;

use super::DeformedPoints;

/// Most pixels of such a view, in pixels of the image.
const MOST: f64 = 4.0;
/// The part of neighbouring pixels whose points of the body may lie nearer than the view's pixels.
const STRETCHED: f64 = 0.05;

impl DeformedPoints<'_> {
    /// The smallest rectangle of offsets from the anchor that holds all points that are seen; none
    /// if nothing is.
    #[must_use]
    pub fn material_box(&self) -> Option<Rect> {
        let boxes = self.points.iter().map(|p| Rect::new(p.offset, p.offset));
        boxes.reduce(|a, b| a.union(&b))
    }

    /// A view of the undeformed body that holds all points that are seen, in the middle the
    /// anchor; its pixels as small as the image's are on the body, where that needs no more than
    /// four times as many. None if nothing is seen.
    ///
    /// Lines that are found in it, isolines for example, are carried over by
    /// [`paths`](super::DeformedView::paths). About a tip it may be finer than [`View::new`]
    /// allows: the part of the body that is seen about a tip in 10⁻¹² of the domain may indeed be
    /// 10⁻²⁰ wide.
    #[must_use]
    pub fn material_view(&self) -> Option<View> {
        let half = self.material_box().map(|rect| rect.max.max(-rect.min))?;
        let pixels = self.view.view.pixels.map(f64::from);
        let step = self.step().filter(|_| half.x.min(half.y) > 0.0)?;
        let by_area = (half.x * half.y / (MOST * pixels[0] * pixels[1])).sqrt();
        let by_length = half.x.max(half.y) / (MOST * pixels[0].max(pixels[1]));
        let step = step.max(2.0 * by_area.max(by_length));
        let count = |half: f64| 2.0 * (half / step).ceil().max(1.0) + 2.0;
        let [columns, rows] = [count(half.x), count(half.y)];
        let (center, width) = (self.view.anchor, columns * step);
        let view = View { center, width, pixels: [columns as u32, rows as u32] };
        Some(view).filter(|view| view.pixel_size().is_normal())
    }

    /// How far apart the points of neighbouring pixels lie on the body where it is stretched most,
    /// except for a few.
    fn step(&self) -> Option<f64> {
        let [columns, rows] = self.view.view.pixels;
        let first = |i, j| self.at(i, j).first().map(|p| p.offset);
        let apart = |(i, j): (u32, u32)| Some((first(i + 1, j)? - first(i, j)?).length());
        let pairs = (0..rows).flat_map(|j| (1..columns).map(move |i| (i - 1, j)));
        let mut all: Vec<f64> = pairs.filter_map(apart).filter(|&d| d > 0.0).collect();
        let place = (all.len() as f64 * STRETCHED) as usize;
        (!all.is_empty()).then(|| *all.select_nth_unstable_by(place, f64::total_cmp).1)
    }
}
