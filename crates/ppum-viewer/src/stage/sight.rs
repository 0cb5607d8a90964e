//! Where points of the plate lie in the window, and which point of the plate lies under
//! the pointer.

use std::sync::Arc;

use egui::{Pos2, Rect, pos2};
use ppum::vec2::{Vec2, vec2};
use ppum_render::deform::Deformation;
use ppum_render::view::View;

use crate::field::OwnedField;
use crate::frames::Frame;
use crate::stage::material::material;
use ppum_scene::spot::Spot;

/// A view in a rectangle of the window, of the plate as it was or deformed.
pub struct Sight {
    /// The view.
    pub view: View,
    /// The rectangle.
    pub rect: Rect,
    /// The deformed plate with its factor.
    moved: Option<(Arc<OwnedField>, f64)>,
}

/// Points of a polyline on the deformed plate, where it has fewer corners.
const STEPS: usize = 96;

impl Sight {
    /// A view in a rectangle; of the deformed plate if the picture shows that.
    #[must_use]
    pub fn new(view: View, rect: Rect, frame: Option<&Frame>) -> Self {
        let moved = frame.and_then(|frame| Some((Arc::clone(&frame.field), frame.factor?)));
        Self { view, rect, moved: moved.filter(|(_, factor)| *factor != 0.0) }
    }

    /// Points of the window per pixel of the view.
    fn scale(&self) -> f64 {
        f64::from(self.rect.width()) / f64::from(self.view.pixels[0])
    }

    /// A length on the plate, of so many points of the window.
    #[must_use]
    pub fn reach(&self, points: f64) -> f64 {
        points / self.scale() * self.view.pixel_size()
    }

    /// The point of the plate at a position; none where the deformed plate is not.
    #[must_use]
    pub fn spot(&self, at: Pos2) -> Option<Spot> {
        let pixel = (at - self.rect.min) / self.scale() as f32;
        let offset = self.view.offset_at(vec2(f64::from(pixel.x), f64::from(pixel.y)));
        let Some((field, factor)) = &self.moved else {
            return Some(Spot::new(self.view.center, offset));
        };
        let pixel = self.view.pixel_size();
        material(field.field(), *factor, [self.view.center, offset], pixel)
    }

    /// Where a point lies, in points of the window from the rectangle's corner; it may be far away.
    fn place(&self, spot: &Spot) -> Vec2 {
        let offset = match &self.moved {
            Some((field, factor)) => match Deformation::new(field.field(), *factor) {
                Ok(deformation) => deformation.place(spot.point()) - self.view.center,
                Err(_) => spot.from(self.view.center),
            },
            None => spot.from(self.view.center),
        };
        self.view.pixel_of_offset(offset) * self.scale()
    }

    /// The position of a point, if it is seen.
    #[must_use]
    pub fn position(&self, spot: &Spot) -> Option<Pos2> {
        let at = self.place(spot);
        let is_seen = |v: f64, size: f32| (-8.0..=f64::from(size) + 8.0).contains(&v);
        (is_seen(at.x, self.rect.width()) && is_seen(at.y, self.rect.height()))
            .then(|| self.window(at))
    }

    fn window(&self, at: Vec2) -> Pos2 {
        pos2(self.rect.min.x + at.x as f32, self.rect.min.y + at.y as f32)
    }

    /// What is seen of the lines between points, one after the other.
    #[must_use]
    pub fn lines(&self, spots: &[Spot]) -> Vec<[Pos2; 2]> {
        let steps = (STEPS / spots.len().max(1)).max(1);
        let places: Vec<Vec2> = match &self.moved {
            None => spots.iter().map(|spot| self.place(spot)).collect(),
            Some(_) => spots
                .windows(2)
                .flat_map(|pair| (0..=steps).map(move |k| between(pair, k as f64 / steps as f64)))
                .map(|spot| self.place(&spot))
                .collect(),
        };
        let size = vec2(f64::from(self.rect.width()), f64::from(self.rect.height()));
        let seen = places.windows(2).filter_map(|pair| clipped([pair[0], pair[1]], size));
        seen.map(|ends| ends.map(|end| self.window(end))).collect()
    }
}

/// The point at a part of the way between two others.
fn between(pair: &[Spot], part: f64) -> Spot {
    let (a, b) = (pair[0], pair[1]);
    Spot::new(a.anchor(), a.offset() + (b.from(a.anchor()) - a.offset()) * part)
}

/// The part of a line inside a box from zero to `size`, with some room around it (Liang and Barsky
/// 1984).
fn clipped([a, b]: [Vec2; 2], size: Vec2) -> Option<[Vec2; 2]> {
    const ROOM: f64 = 8.0;
    let way = b - a;
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for (delta, start, end) in [(way.x, a.x, size.x), (way.y, a.y, size.y)] {
        let (low, high) = (-ROOM - start, end + ROOM - start);
        if delta == 0.0 {
            if low > 0.0 || high < 0.0 {
                return None;
            }
            continue;
        }
        let [near, far] = if delta > 0.0 { [low, high] } else { [high, low] };
        (from, to) = (from.max(near / delta), to.min(far / delta));
    }
    (from < to && way.is_finite() && a.is_finite()).then(|| [a + way * from, a + way * to])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_cut_off_at_the_border_without_bending() {
        let size = vec2(100.0, 50.0);
        let [a, b] = clipped([vec2(-1e12, -1e12), vec2(1e12, 1e12)], size).expect("it is seen");
        assert!((a.x - a.y).abs() < 1e-3 && (b.x - b.y).abs() < 1e-3, "{a:?} {b:?}");
        assert!(b.x <= 58.001 && a.x >= -8.001);
        assert_eq!(clipped([vec2(-10.0, 60.0), vec2(200.0, 60.0)], size), None);
        let inside = [vec2(1.0, 2.0), vec2(3.0, 4.0)];
        assert_eq!(clipped(inside, size), Some(inside));
        assert_eq!(clipped([vec2(f64::NAN, 0.0), vec2(1.0, 1.0)], size), None);
    }
}
