//! Curves drawn over the view by the mouse, and their handles.

use std::ops::Deref;
use std::sync::Arc;

use egui::{CursorIcon, Key, Modifiers, PointerButton, Response, Ui};
use ppum::crack::{Crack, TipId, tips};
use ppum::dataset::Dataset;
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2};
use ppum_render::anchored_edge::AnchoredEdge;
use ppum_render::view::View;
use ppum_scene::profile::ProfileCurve;

use super::ViewState;
use super::hover::HoverGeometry;
use crate::measure::tool::{CurveHandle, Tool};
use crate::measure::words::LocationFormat;
use crate::session::Pane;
use ppum_scene::location::Location;

/// Part of the view that the radius of a circle around a tip has.
const SEEN: f64 = 0.3;
/// Distances in points of the window: to a handle that is gripped, to a tip that a curve begins at.
const GRIP: f64 = 9.0;
const TIP: f64 = 10.0;
/// Angles of rays nearer to a face than this are those of the face \[degrees\].
const FACE: f64 = 2.0;

impl ViewState {
    /// Draws curves and moves their handles; true if the mouse is taken for that.
    pub(super) fn draw_by_mouse(
        &mut self,
        ui: &Ui,
        response: &Response,
        sight: &HoverGeometry,
        pane: &mut Pane,
    ) -> bool {
        let Some(cracks) = self.cracks(pane) else { return false };
        let places = LocationFormat { view: &sight.view, size: self.plate_size(), cracks: &cracks };
        let pen = CurvePainter { sight, places };
        self.point_at(ui, response, &pen, pane);
        if self.tools.tool == Some(Tool::Crack) && response.clicked() {
            let at = response.interact_pointer_pos().and_then(|at| sight.spot(at));
            if let Some(index) = at.and_then(|spot| nearest_crack(&cracks, &spot)) {
                pane.curve = Some(ProfileCurve::Crack { index });
            }
            self.tools.tool = None;
            return true;
        }
        if response.drag_started_by(PointerButton::Primary) {
            self.tools.grip = self.gripped(ui, &pen, pane);
            self.tools.refused = self.tools.refused.take().filter(|_| self.tools.grip.is_none());
        }
        let Some(grip) = self.tools.grip else { return false };
        let at = response.interact_pointer_pos().and_then(|at| sight.spot(at));
        if let (Some(spot), Some(along)) = (at, pane.curve) {
            pane.curve = Some(pen.moved(along, grip, &spot));
        }
        if response.drag_stopped() || !response.dragged() {
            (self.tools.grip, self.tools.tool) = (None, None);
            // a circle has its words beside it
            let is_plotted =
                matches!(pane.curve, Some(ProfileCurve::Line { .. } | ProfileCurve::Ray { .. }));
            self.tools.wants_plot = std::mem::take(&mut self.tools.is_new) && is_plotted;
        }
        true
    }

    /// Escape leaves a tool; the pointer says what a drag would do.
    fn point_at(&mut self, ui: &Ui, response: &Response, pen: &CurvePainter<'_>, pane: &Pane) {
        let has_tool = self.tools.tool.is_some();
        if has_tool && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            self.tools.tool = None;
        }
        let Some(at) = response.hover_pos() else { return };
        if pen.gripped(pane.curve, at).is_some() {
            ui.ctx().set_cursor_icon(CursorIcon::Grab);
        } else if has_tool {
            ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        }
    }

    /// The handle that a drag has begun at; that of a new curve if a tool is chosen, by itself or
    /// by a key that is held.
    fn gripped(&mut self, ui: &Ui, pen: &CurvePainter<'_>, pane: &mut Pane) -> Option<CurveHandle> {
        let at = ui.input(|input| input.pointer.press_origin())?;
        let modifiers = ui.input(|input| input.modifiers);
        let by_key = match () {
            () if modifiers.shift => Some(Tool::Line),
            () if modifiers.command => Some(Tool::Circle),
            () => None,
        };
        if let Some(grip) = pen.gripped(pane.curve, at) {
            return Some(grip);
        }
        let tool = self.tools.tool.or(by_key)?;
        let (along, grip) = pen.begun(tool, &pen.sight.spot(at)?)?;
        pane.curve = Some(along);
        self.tools.is_new = true;
        Some(grip)
    }

    /// A circle around the tip nearest to the pointer: the solver's own if that is seen, else one
    /// that is. False where there is no tip.
    pub fn circle_nearest_tip(&mut self, pane: &mut Pane) -> bool {
        let (Some(cracks), Some(spot), Some(view)) =
            (self.cracks(pane), self.spot(), self.camera.view)
        else {
            return false;
        };
        let end = |tip: TipId| cracks[tip.crack as usize].end_point(tip.end);
        let distance = |tip: TipId| spot.from(end(tip)).length();
        let all = tips(&cracks).enumerate();
        let Some((tip, id)) = all.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))) else {
            return false;
        };
        let places = LocationFormat { view: &view, size: self.plate_size(), cracks: &cracks };
        let seen = places.rounded(SEEN * view.width.min(view.height()));
        let radius = self.usual_radius(pane, id).map_or(seen, |usual| usual.min(seen));
        pane.curve = Some(ProfileCurve::Around { tip, radius: Some(radius) });
        pane.plot.log = [false; 2];
        self.tools.refused = None;
        true
    }

    fn usual_radius(&self, pane: &Pane, tip: TipId) -> Option<f64> {
        let dataset = &self.opened.as_ref()?.dataset;
        let step = pane.scene.subject.step_of(dataset);
        crate::measure::integral::usual_radius(dataset, step, tip)
    }

    /// A curve to begin with, if there is none: the crack nearest to the pointer, or the middle
    /// line of the body.
    pub fn choose_curve(&mut self, pane: &mut Pane) {
        let (Some(cracks), Some(spot)) = (self.cracks(pane), self.spot()) else { return };
        if pane.curve.is_none() {
            let crack = nearest_crack(&cracks, &spot).map(|index| ProfileCurve::Crack { index });
            pane.curve = crack.or_else(|| self.middle());
        }
    }

    /// The reason why there is nothing of a curve on the body: a radius or a length that leaves
    /// it, or is none.
    pub(crate) fn refusal(&self, pane: &Pane, along: &ProfileCurve) -> Option<String> {
        let bounds = self.opened.as_ref()?.dataset.domain.bounds;
        let cracks = self.cracks(pane)?;
        let tip = |number: usize| {
            tips(&cracks).nth(number).map(|tip| cracks[tip.crack as usize].end_point(tip.end))
        };
        let (center, length, name) = match *along {
            ProfileCurve::Circle { center, radius } => (center.into(), radius, "radius"),
            ProfileCurve::Around { tip: number, radius } => (tip(number)?, radius?, "radius"),
            ProfileCurve::Ray { tip: number, far, .. } => (tip(number)?, far?, "length"),
            ProfileCurve::Line { .. } | ProfileCurve::Crack { .. } => return None,
        };
        let Rect { min, max } = bounds;
        let corners = [min, max, Vec2 { x: min.x, y: max.y }, Vec2 { x: max.x, y: min.y }];
        let most = corners.into_iter().map(|corner| (corner - center).length()).fold(0.0, f64::max);
        if length <= 0.0 {
            return Some(format!("a {name} must be larger than 0"));
        }
        (length > most).then(|| {
            let most = ppum::text::trimmed_to(most, 4);
            format!("a {name} of {length:?} leaves the plate: from there it ends at {most}")
        })
    }

    /// The line through the middle of the body, from border to border.
    #[must_use]
    pub fn middle(&self) -> Option<ProfileCurve> {
        let bounds = self.opened.as_ref()?.dataset.domain.bounds;
        let y = bounds.center().y;
        Some(ProfileCurve::Line {
            anchor: [0.0; 2],
            from: [bounds.min.x, y],
            to: [bounds.max.x, y],
        })
    }

    /// The cracks of the step that is shown.
    pub(crate) fn cracks(&self, pane: &Pane) -> Option<Cracks> {
        let dataset = &self.opened.as_ref()?.dataset;
        let step = pane.scene.subject.step_of(dataset);
        let cracks = Cracks { dataset: Arc::clone(dataset), step };
        dataset.steps.get(step).map(|_| cracks)
    }

    /// The larger side of the body's box.
    pub(crate) fn plate_size(&self) -> f64 {
        let size = self.opened.as_ref().map(|opened| opened.dataset.domain.bounds.size());
        size.map_or(1.0, |size| size.x.max(size.y))
    }
}

/// The cracks of a step, kept with their dataset: in every image of the window they are asked
/// for, and there may be many.
pub(crate) struct Cracks {
    dataset: Arc<Dataset>,
    step: usize,
}

impl Deref for Cracks {
    type Target = [Crack];

    fn deref(&self) -> &[Crack] {
        &self.dataset.steps[self.step].cracks
    }
}

/// A painter of curves, with numbers rounded to what the view can tell apart.
struct CurvePainter<'a> {
    sight: &'a HoverGeometry,
    places: LocationFormat<'a>,
}

impl CurvePainter<'_> {
    fn end(&self, tip: TipId) -> Vec2 {
        self.places.cracks[tip.crack as usize].end_point(tip.end)
    }

    /// The number and the place of the nearest tip within reach.
    fn tip_near(&self, spot: &Location, reach: f64) -> Option<(usize, Vec2)> {
        let all = tips(self.places.cracks).map(|tip| self.end(tip)).enumerate();
        let near = all.filter(|(_, tip)| spot.from(*tip).length() <= reach);
        near.min_by(|a, b| spot.from(a.1).length().total_cmp(&spot.from(b.1).length()))
    }

    /// The offset of a spot from an anchor, rounded; a tip beside it exactly.
    fn rounded(&self, spot: &Location, anchor: Vec2) -> Vec2 {
        match self.tip_near(spot, self.sight.reach(TIP)) {
            Some((_, tip)) => tip - anchor,
            None => {
                let Vec2 { x, y } = spot.from(anchor);
                Vec2 { x: self.places.rounded(x), y: self.places.rounded(y) }
            }
        }
    }

    fn radius(&self, spot: &Location, center: Vec2) -> f64 {
        let least = self.sight.view.pixel_size();
        self.places.rounded(spot.from(center).length()).max(least)
    }

    /// A curve that begins at a spot, with the handle that is dragged then.
    fn begun(&self, tool: Tool, spot: &Location) -> Option<(ProfileCurve, CurveHandle)> {
        match tool {
            Tool::Line => {
                let anchor = match self.places.is_deep() {
                    true => self.places.origin().0,
                    false => Vec2::ZERO,
                };
                let start = self.rounded(spot, anchor).into();
                Some((
                    ProfileCurve::Line { anchor: anchor.into(), from: start, to: start },
                    CurveHandle::To,
                ))
            }
            Tool::Circle => Some((self.circle(spot, self.sight.reach(1.0)), CurveHandle::Radius)),
            Tool::Ray => {
                let (tip, _) = self.tip_near(spot, f64::INFINITY)?;
                Some((ProfileCurve::Ray { tip, angle: 0.0, far: None }, CurveHandle::To))
            }
            Tool::Crack | Tool::Probe => None,
        }
    }

    /// The circle about a spot; around the tip beside it.
    fn circle(&self, spot: &Location, radius: f64) -> ProfileCurve {
        match self.tip_near(spot, self.sight.reach(TIP)) {
            Some((tip, _)) => ProfileCurve::Around { tip, radius: Some(radius) },
            None => {
                let center = self.rounded(spot, Vec2::ZERO).into();
                ProfileCurve::Circle { center, radius }
            }
        }
    }

    /// The curve with a handle at another place.
    fn moved(&self, along: ProfileCurve, grip: CurveHandle, spot: &Location) -> ProfileCurve {
        let numbered = |number: usize| tips(self.places.cracks).nth(number);
        match along {
            ProfileCurve::Line { anchor, from, to } => {
                let end = self.rounded(spot, anchor.into()).into();
                match grip {
                    CurveHandle::From => ProfileCurve::Line { anchor, from: end, to },
                    _ => ProfileCurve::Line { anchor, from, to: end },
                }
            }
            ProfileCurve::Circle { radius, .. } if grip == CurveHandle::Center => {
                self.circle(spot, radius)
            }
            ProfileCurve::Circle { center, .. } => {
                ProfileCurve::Circle { center, radius: self.radius(spot, center.into()) }
            }
            ProfileCurve::Around { tip, .. } => numbered(tip).map_or(along, |id| {
                ProfileCurve::Around { tip, radius: Some(self.radius(spot, self.end(id))) }
            }),
            ProfileCurve::Ray { tip, .. } => numbered(tip).map_or(along, |id| {
                let axis = self.places.cracks[id.crack as usize].growth_direction(id.end);
                let way = spot.from(self.end(id));
                let angle = axis.cross(way).atan2(axis.dot(way)).to_degrees().round();
                let is_face = angle.abs() > 180.0 - FACE;
                let angle = if is_face { 180f64.copysign(angle) } else { angle };
                ProfileCurve::Ray { tip, angle, far: Some(self.radius(spot, self.end(id))) }
            }),
            other => other,
        }
    }

    /// The handle of a curve at a position.
    fn gripped(&self, along: Option<ProfileCurve>, at: egui::Pos2) -> Option<CurveHandle> {
        let handles = handles(&along?, self.places.cracks);
        let distance =
            |spot: &Location| self.sight.position(spot).map(|p| f64::from(p.distance(at)));
        let near = handles.into_iter().filter_map(|(grip, spot)| Some((distance(&spot)?, grip)));
        let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.filter(|(distance, _)| *distance <= GRIP).map(|(_, grip)| grip)
    }
}

/// The crack nearest to a point.
fn nearest_crack(cracks: &[Crack], spot: &Location) -> Option<usize> {
    let distance = |crack: &Crack| crack.distance(spot.point());
    let all = cracks.iter().map(distance).enumerate();
    all.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
}

/// The handles of a curve, with their places.
pub(crate) fn handles(along: &ProfileCurve, cracks: &[Crack]) -> Vec<(CurveHandle, Location)> {
    let spot = |anchor: [f64; 2], offset: [f64; 2]| Location::new(anchor.into(), offset.into());
    match *along {
        ProfileCurve::Line { anchor, from, to } => {
            vec![(CurveHandle::To, spot(anchor, to)), (CurveHandle::From, spot(anchor, from))]
        }
        ProfileCurve::Circle { center, radius } => vec![
            (CurveHandle::Radius, spot(center, [radius, 0.0])),
            (CurveHandle::Center, spot(center, [0.0; 2])),
        ],
        ProfileCurve::Around { .. } => outline(along, cracks, None)
            .first()
            .map(|first| (CurveHandle::Radius, *first))
            .into_iter()
            .collect(),
        ProfileCurve::Ray { .. } => outline(along, cracks, None)
            .last()
            .map(|last| (CurveHandle::To, *last))
            .into_iter()
            .collect(),
        ProfileCurve::Crack { .. } => Vec::new(),
    }
}

/// Chords of a circle that is drawn.
const CHORDS: usize = 180;

/// A curve as points joined by lines; those around tips begin ahead of the tip. Arcs of cracks have
/// more points where a view shows them.
pub(crate) fn outline(
    along: &ProfileCurve,
    cracks: &[Crack],
    view: Option<&View>,
) -> Vec<Location> {
    let round = |center: Vec2, axis: Vec2, radius: f64| {
        let at = |k: usize| {
            let (sin, cos) = (k as f64 / CHORDS as f64 * std::f64::consts::TAU).sin_cos();
            Location::new(center, (axis * cos + axis.left() * sin) * radius)
        };
        (0..=CHORDS).map(at).collect()
    };
    let numbered = |number: usize| {
        let tip = tips(cracks).nth(number)?;
        let crack = &cracks[tip.crack as usize];
        Some((crack.end_point(tip.end), crack.growth_direction(tip.end), crack.length()))
    };
    match *along {
        ProfileCurve::Line { anchor, from, to } => {
            [from, to].map(|end| Location::new(anchor.into(), end.into())).to_vec()
        }
        ProfileCurve::Circle { center, radius } => {
            round(center.into(), Vec2 { x: 1.0, y: 0.0 }, radius)
        }
        ProfileCurve::Crack { index } => {
            let Some(crack) = cracks.get(index) else { return Vec::new() };
            let first = Location::new(crack.points[0], Vec2::ZERO);
            std::iter::once(first).chain(crack.edges().flat_map(|e| behind(e, view))).collect()
        }
        ProfileCurve::Around { tip, radius } => match numbered(tip) {
            Some((at, axis, length)) => round(at, axis, radius.unwrap_or(0.01 * length)),
            None => Vec::new(),
        },
        ProfileCurve::Ray { tip, angle, far } => match numbered(tip) {
            Some((at, axis, length)) => {
                let (sin, cos) = angle.to_radians().sin_cos();
                let way = (axis * cos + axis.left() * sin) * far.unwrap_or(0.1 * length);
                vec![Location::new(at, Vec2::ZERO), Location::new(at, way)]
            }
            None => Vec::new(),
        },
    }
}

/// The points of an edge behind its first one that lines join, more where a view shows an arc.
fn behind(edge: Edge, view: Option<&View>) -> Vec<Location> {
    let last = Location::new(edge.to, Vec2::ZERO);
    if !edge.is_arc() {
        return vec![last];
    }
    let anchor = view.map_or(edge.from, |view| view.center);
    let local = AnchoredEdge::new(edge, anchor);
    let seen = view.map_or_else(Vec::new, |view| local.near(2.0 * view.half().length()));
    let divided = |[low, high]: [f64; 2]| {
        (1..CHORDS).map(move |k| low + (high - low) * (k as f64 / CHORDS as f64))
    };
    let mut places: Vec<f64> = std::iter::once(local.range).chain(seen).flat_map(divided).collect();
    places.sort_by(f64::total_cmp);
    let between = places.into_iter().map(|s| Location::new(anchor, local.frame.at(s)));
    between.chain([last]).collect()
}
