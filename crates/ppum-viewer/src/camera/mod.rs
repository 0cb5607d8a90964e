//! The camera of a view: the region that it shows, how it moves, and where it was before.

mod flight;
mod region;

use egui::{PointerButton, Response, Ui};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_render::view::View;

use crate::session::VisibleRegion;
use crate::undo::{RestDetector, Undo};
use flight::Flight;
pub(crate) use region::is_of;
pub use region::view;
use region::{bounded, zoomed};

/// The camera of a view.
pub struct Camera {
    /// The view on the window's pixels.
    pub view: Option<View>,
    /// True if someone wants to go deeper than doubles do.
    pub is_at_the_end: bool,
    /// Columns of pixels on the right that belong to the colour bar where there is room beside it.
    taken: u32,
    boxes: BodyBoxes,
    /// Views that were, to go back to.
    trail: Undo<Option<VisibleRegion>>,
    rest: RestDetector<Option<VisibleRegion>>,
    flight: Option<Flight>,
    now: f64,
}

/// Boxes around a body.
#[derive(Clone, Copy, Debug)]
pub struct BodyBoxes {
    /// That of all that is drawn, deformed or not.
    pub whole: Rect,
    /// That of the undeformed body, the whole of one that is mirrored.
    pub undeformed: Rect,
}

/// Part of the image that the keys move it by.
const PAN: f64 = 0.125;

/// Turns of the wheel, in points, that enlarge e times.
const WHEEL: f64 = 240.0;

impl Default for Camera {
    fn default() -> Self {
        let empty = Rect::new(Vec2::ZERO, Vec2::ZERO);
        Self {
            view: None,
            is_at_the_end: false,
            taken: 0,
            boxes: BodyBoxes { whole: empty, undeformed: empty },
            trail: Undo::new(None),
            rest: RestDetector::new(None),
            flight: None,
            now: 0.0,
        }
    }
}

impl Camera {
    /// Goes on with a flight.
    pub fn advance(&mut self, ui: &Ui, place: &mut Option<VisibleRegion>) {
        self.now = ui.input(|input| input.time);
        let Some(flight) = &self.flight else { return };
        match flight.at(self.now) {
            Some(between) => {
                *place = Some(between);
                ui.ctx().request_repaint();
            }
            None => {
                *place = flight.end;
                self.flight = None;
            }
        }
    }

    /// Looks at a place, or at the whole body, and notes the place once it is at rest; nothing of a
    /// body without size.
    pub fn look(
        &mut self,
        ui: &Ui,
        place: Option<VisibleRegion>,
        (pixels, taken): ([u32; 2], u32),
        boxes: BodyBoxes,
    ) -> Option<View> {
        (self.boxes, self.taken) = (boxes, taken);
        let view = view(place, boxes.whole, pixels, taken)?;
        self.view = Some(view);
        match self.rest.until(&place, self.now) {
            None => self.trail.note(&place),
            Some(seconds) => ui.ctx().request_repaint_after_secs(seconds as f32),
        }
        Some(view)
    }

    /// The view of a place, or of the whole as it was shown last: the one that the mouse moves.
    #[must_use]
    pub fn shown(&self, place: Option<VisibleRegion>, pixels: [u32; 2]) -> Option<View> {
        view(place, self.boxes.whole, pixels, self.taken)
    }

    /// How many times a view is larger than that of the whole body.
    #[must_use]
    pub fn times(&self, view: &View) -> f64 {
        let fit = region::view(None, self.boxes.whole, view.pixels, self.taken);
        fit.map_or(1.0, |fit| fit.width / view.width)
    }

    /// Returns the view of a figure: the body without what lies beside it, or what is seen of it.
    pub(crate) fn cropped(&self, place: Option<VisibleRegion>) -> Option<View> {
        let view = self.view?;
        if place.is_some() { Some(view) } else { View::hug(self.boxes.whole, view.pixels).ok() }
    }

    /// Flies to the view before, or to the one that one came back from.
    pub fn go(&mut self, place: Option<VisibleRegion>, back: bool) {
        if back {
            self.trail.note(&place);
        }
        if let Some(place) = self.trail.go(back).copied() {
            self.fly_to(place);
        }
    }

    /// Flies to a place, or to the whole body.
    pub fn fly_to(&mut self, to: Option<VisibleRegion>) {
        let Some(from) = self.view else { return };
        let Some(end) = view(to, self.boxes.whole, from.pixels, self.taken) else { return };
        let [from, end] = [from, end].map(|view| VisibleRegion::of(&view));
        self.is_at_the_end = false;
        self.flight = Some(Flight::new(from, end, to, self.now));
    }

    /// Ends a flight where it is.
    pub fn stop(&mut self) {
        self.flight = None;
    }

    /// The region after a move by parts of the view's size, and an enlargement around its middle.
    pub(crate) fn nudged(&mut self, right: f64, up: f64, factor: f64) -> Option<VisibleRegion> {
        let view = self.view?;
        let shift = vec2(right * view.width, up * view.height()) * PAN;
        let width = view.width / factor;
        let center = (view.center + shift).into();
        let region = bounded(VisibleRegion { center, width }, &self.boxes.undeformed);
        self.is_at_the_end = region.width > width;
        Some(region)
    }

    /// The region after a drag or a turn of the wheel over a view, if there was one; a
    /// wheel keeps `anchor` of the offset below the pointer in its place.
    pub fn moved_by_mouse(
        &mut self,
        ui: &Ui,
        response: &Response,
        view: &View,
        anchor: impl FnOnce(&View, Vec2) -> Vec2,
    ) -> Option<VisibleRegion> {
        let bounds = self.boxes.undeformed;
        let scale = f64::from(ui.pixels_per_point());
        let mut region = None;
        if response.dragged_by(PointerButton::Primary) {
            let delta = response.drag_delta();
            let by = vec2(-f64::from(delta.x), f64::from(delta.y));
            let center = (view.center + by * (scale * view.pixel_size())).into();
            region = Some(bounded(VisibleRegion { center, width: view.width }, &bounds));
        }
        let (pinch, wheel) = ui.input(|i| (i.zoom_delta(), i.smooth_scroll_delta().y));
        let factor = f64::from(pinch) * (f64::from(wheel) / WHEEL).exp();
        if let Some(at) = response.hover_pos().filter(|_| factor != 1.0) {
            let at = at - response.rect.min;
            let offset = view.offset_at(vec2(at.x.into(), at.y.into()) * scale);
            let (place, is_at_the_end) = zoomed(view, anchor(view, offset), factor, &bounds);
            (region, self.is_at_the_end) = (Some(place), is_at_the_end);
        }
        if region.is_some() {
            self.flight = None;
        }
        region
    }
}
