//! Where points of the body lie in the window, and which point of the body lies under the pointer.

use std::sync::Arc;

use egui::{Pos2, Rect, pos2};
use ppum::line::Line;
use ppum::vec2::{Vec2, vec2};
use ppum_render::view::View;
use ppum_scene::material::DeformedWhole;
use ppum_scene::mirror_lines::MirrorLines;

use crate::field::OwnedField;
use crate::frames::RenderedFrame;
use ppum_scene::location::Location;

/// A view in a rectangle of the window, of the body as it was or deformed.
pub struct HoverGeometry {
    /// The view.
    pub view: View,
    /// The rectangle.
    pub rect: Rect,
    /// The deformed body with its factor and the lines at which it is mirrored.
    moved: Option<(Arc<OwnedField>, f64, MirrorLines)>,
}

/// Points of a polyline on the deformed body, where it has fewer corners.
const STEPS: usize = 96;

/// Points of the window around the view in which marks and lines go on.
const ROOM: f64 = 8.0;

impl HoverGeometry {
    /// A view in a rectangle; of the deformed body if the image shows that.
    #[must_use]
    pub fn new(view: View, rect: Rect, frame: Option<&RenderedFrame>) -> Self {
        let moved = frame.and_then(|frame| {
            Some((Arc::clone(&frame.field), frame.factor.filter(|f| *f != 0.0)?, frame.lines))
        });
        Self { view, rect, moved }
    }

    /// Points of the window per pixel of the view.
    fn scale(&self) -> f64 {
        f64::from(self.rect.width()) / f64::from(self.view.pixels[0])
    }

    /// A length on the body, of so many points of the window.
    pub(crate) fn reach(&self, points: f64) -> f64 {
        points / self.scale() * self.view.pixel_size()
    }

    /// The point of the body at a position; none where the deformed body is not.
    pub(crate) fn spot(&self, at: Pos2) -> Option<Location> {
        let pixel = (at - self.rect.min) / self.scale() as f32;
        let offset = self.view.offset_at(vec2(f64::from(pixel.x), f64::from(pixel.y)));
        match self.deformed() {
            None => Some(Location::new(self.view.center, offset)),
            Some(whole) => whole.spot(&self.view, offset),
        }
    }

    fn deformed(&self) -> Option<DeformedWhole<'_>> {
        let (field, factor, lines) = self.moved.as_ref()?;
        Some(DeformedWhole { field: field.field(), factor: *factor, lines: *lines })
    }

    /// Where a point lies, in points of the window from the rectangle's corner; it may be far away.
    fn place(&self, spot: &Location) -> Vec2 {
        let offset = match self.deformed() {
            None => spot.from(self.view.center),
            Some(whole) => whole.offset(&self.view, spot),
        };
        self.view.pixel_of_offset(offset) * self.scale()
    }

    /// The position of a point, if it is seen.
    pub(crate) fn position(&self, spot: &Location) -> Option<Pos2> {
        let at = self.place(spot);
        let is_seen = |v: f64, size: f32| (-ROOM..=f64::from(size) + ROOM).contains(&v);
        (is_seen(at.x, self.rect.width()) && is_seen(at.y, self.rect.height()))
            .then(|| self.window(at))
    }

    fn window(&self, at: Vec2) -> Pos2 {
        pos2(self.rect.min.x + at.x as f32, self.rect.min.y + at.y as f32)
    }

    /// Returns the visible part of the lines between points, one after the other.
    pub(crate) fn lines(&self, spots: &[Location]) -> Vec<[Pos2; 2]> {
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
        let room = ppum::vec2::Rect::new(vec2(-ROOM, -ROOM), size + vec2(ROOM, ROOM));
        let seen = places
            .windows(2)
            .filter_map(|pair| Line::through([pair[0], pair[1]]).clipped(&room, [0.0, 1.0]));
        seen.map(|ends| ends.map(|end| self.window(end))).collect()
    }
}

/// The point at a part of the way between two others.
fn between(pair: &[Location], part: f64) -> Location {
    let (a, b) = (pair[0], pair[1]);
    Location::new(a.anchor(), a.offset() + (b.from(a.anchor()) - a.offset()) * part)
}
