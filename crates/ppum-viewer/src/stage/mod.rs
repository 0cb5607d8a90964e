//! A view, edge to edge: shown from the newest image, moved by the mouse.

pub mod bar;
pub mod difference;
mod fallback;
pub mod flight;
pub mod hover;
pub mod locator;
mod marks;
mod opened;
mod pipeline;
pub mod pixels;
pub mod readout;
pub mod scale_bar;
mod solids;
pub mod split_view;
pub mod texture;
pub mod tools;

use std::sync::Arc;

use egui::{Color32, PointerButton, Rect, Sense, Ui, vec2};
use ppum::crack::tips;
use ppum::dataset::Dataset;
use ppum::decompose::FieldPart;
use ppum::vec2::Vec2;
use ppum_render::view::View;
use ppum_scene::compare::Compare;
use ppum_scene::location::Location;
use ppum_scene::scene::{SceneRequest, default_quantity};
use ppum_scene::shot::FieldSource;

use crate::controls::Controls;
use crate::field::OwnedField;
use crate::frames::{Backend, FrameRequest, PaneFrames, RenderedFrame};
use crate::plate::{bounded, view, zoomed};
use crate::reading::ViewReading;
use crate::reading::question::BackgroundQuery;
use crate::session::{Pane, VisibleRegion};
use crate::undo::{RestDetector, Undo};
use difference::PairRole;
use flight::Flight;
use hover::HoverGeometry;
use locator::Locator;
pub use opened::OpenDataset;
use ppum_scene::owner::Owner;
use split_view::SplitView;
use texture::{LayerTexture, Texture};

/// One view: its dataset, its images, and what the mouse does in it.
pub struct ViewPane {
    /// The dataset.
    pub opened: Option<OpenDataset>,
    /// Images, made in the background.
    pub frames: PaneFrames,
    /// Views that were, to go back to.
    pub trail: Undo<Option<VisibleRegion>>,
    /// The view on the window's pixels.
    pub view: Option<View>,
    /// The position of the mouse, as an offset from the view's centre.
    pub hover: Option<Vec2>,
    /// Columns of pixels on the right that belong to the colour bar where there is room beside it.
    taken: u32,
    /// The state of the panels of this view.
    pub controls: Controls,
    grip: bar::BarGrip,
    against: SplitView,
    /// The relation of the view to the one beside it.
    pub pair: PairRole,
    /// The readings of it.
    pub reading: ViewReading,
    texture: Texture,
    sheet: LayerTexture,
    flight: Option<Flight>,
    rest: RestDetector<Option<VisibleRegion>>,
    /// The map of the body, and the field that it was drawn of.
    locator: Option<(Arc<OwnedField>, Option<Locator>)>,
    moved: BackgroundQuery<VisibleBodies, ppum::vec2::Rect>,
    /// True if someone wants to go deeper than doubles do.
    is_at_the_end: bool,
    /// Choices that cannot be shown and are replaced, for the caller to report.
    pub told: Vec<String>,
    /// The caption; `None` without another view beside it.
    pub caption: Option<String>,
    /// Why a key did nothing, and when.
    unheeded: Option<(String, f64)>,
    now: f64,
}

/// A scene whose bounding box is computed: that of the deformed whole, and of its undeformed border
/// if that is drawn too.
#[derive(Clone)]
struct VisibleBodies {
    field: Arc<OwnedField>,
    scene: SceneRequest,
}

impl PartialEq for VisibleBodies {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.field, &other.field) && self.scene == other.scene
    }
}

impl VisibleBodies {
    fn bounds(&self) -> Result<ppum::vec2::Rect, String> {
        let source = FieldSource::of(self.field.dataset(), self.field.field());
        source.seen_bounds(&self.scene).map_err(|error| error.to_string())
    }
}

/// Part of the image that the keys move it by.
const PAN: f64 = 0.125;

impl ViewPane {
    /// A stage without a dataset.
    #[must_use]
    pub fn new(ctx: &egui::Context, backend: Backend) -> Self {
        let ctx = ctx.clone();
        Self {
            opened: None,
            frames: PaneFrames::with_backend(backend, move || ctx.request_repaint()),
            trail: Undo::new(None),
            view: None,
            hover: None,
            taken: 0,
            controls: Controls::default(),
            grip: bar::BarGrip::default(),
            against: SplitView::default(),
            pair: PairRole::default(),
            texture: Texture::default(),
            sheet: LayerTexture::default(),
            reading: ViewReading::default(),
            flight: None,
            rest: RestDetector::new(None),
            locator: None,
            moved: BackgroundQuery::default(),
            is_at_the_end: false,
            told: Vec::new(),
            caption: None,
            unheeded: None,
            now: 0.0,
        }
    }

    /// Shows the pane in all the room there is.
    pub fn show(&mut self, ui: &mut Ui, pane: &mut Pane) {
        let room = (ui.available_size() - vec2(0.0, readout::height(ui.available_width())))
            .max(vec2(1.0, 1.0));
        ui.spacing_mut().item_spacing.y = 0.0;
        let (rect, response) = ui.allocate_exact_size(room, Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Plate"));
        let scale = ui.pixels_per_point();
        let pixels = [rect.width(), rect.height()].map(|n| ((n * scale).round() as u32).max(1));
        let Some(opened) = self.opened.clone() else { return };
        self.now = ui.input(|input| input.time);
        self.fly(ui, pane);
        let whole = self.whole(ui.ctx(), pane, &opened.dataset);
        self.taken = (bar::width(rect) * scale).round() as u32;
        if pane.place.is_some_and(|place| place.view(pixels).is_err()) {
            self.show_whole(pane);
        }
        let Some(view) = view(pane.place, whole, pixels, self.taken) else { return };
        let sight = HoverGeometry::new(view, rect, self.frames.newest().map(|frame| &**frame));
        if !self.draw_by_mouse(ui, &response, &sight, pane) {
            self.move_by_mouse(ui, &response, rect, pane, &view, &opened.dataset);
        }
        let view = crate::plate::view(pane.place, whole, pixels, self.taken).unwrap_or(view);
        self.view = Some(view);
        self.hover = response.hover_pos().map(|at| offset(&view, rect, at));
        match self.rest.until(&pane.place, self.now) {
            None => self.trail.note(&pane.place),
            Some(seconds) => ui.ctx().request_repaint_after_secs(seconds as f32),
        }
        if self.frames.poll() {
            // panels have been shown, from the image before
            ui.ctx().request_repaint();
            self.fall_back(pane);
        }
        let step = pane.scene.subject.step_of(&opened.dataset);
        self.controls.facts.look_up(&opened.dataset, step);
        self.controls.advance(ui.ctx(), pane, &self.frames);
        let scene = self.controls.drawn(&pane.scene);
        let compare = self.compared(pane);
        let (dataset, minus) = (Arc::clone(&opened.dataset), self.pair.minus().cloned());
        self.frames.want(FrameRequest { dataset, scene, view, compare, minus });
        self.paint(ui, rect, &view);
        if let Some(frame) = self.frames.newest() {
            let hover = self.reading.hover.as_ref();
            let (sheet, is_compared) = (&mut self.sheet, compare.is_some());
            self.against.show(ui, rect, (pane, is_compared), (frame, sheet), &view);
            bar::show(ui, rect, &mut self.grip, &mut pane.scene.colors, frame, hover);
            bar::of_difference(ui, rect, (pane, compare.is_some()), frame);
        }
        fallback::show(ui, rect, &self.frames);
        let fit = crate::plate::view(None, whole, pixels, self.taken);
        let times = fit.map_or(1.0, |fit| fit.width / view.width);
        self.furnish(ui, rect, pane, &view, times);
        let map = self.locator.as_ref().and_then(|(_, locator)| locator.as_ref());
        let taken = map.map_or(0.0, |map| map.width(rect, times));
        let caption = self.caption.as_deref();
        difference::show(ui, (rect, taken), (&self.pair, caption), &self.frames);
        let sight = HoverGeometry::new(view, rect, self.frames.newest().map(|frame| &**frame));
        self.read(ui, &response, &sight, pane);
        self.pick(&response, pane);
        self.marks(ui, &sight, pane);
        self.line(ui, pane);
    }

    /// The way of resampling that is looked at: grids are of one field, and of the body as it was.
    #[must_use]
    pub fn compared(&self, pane: &Pane) -> Option<Compare> {
        let is_moved = pane.scene.deformed.is_some() || pane.scene.mirror.is_some();
        pane.compare.filter(|_| !is_moved && self.pair.minus().is_none())
    }

    /// Chooses the patch that is clicked on, if one is to be chosen.
    fn pick(&mut self, response: &egui::Response, pane: &mut Pane) {
        let (Some(View { center, .. }), Some(offset)) = (self.view, self.hover) else { return };
        if !self.controls.is_picking || !response.clicked() {
            return;
        }
        self.controls.is_picking = false;
        let owner = self.frame().and_then(|frame| Owner::at(frame.field.field(), center, offset));
        if let Some(owner) = owner {
            pane.scene.subject.part = Some(FieldPart::Patch(owner.patch()).to_string());
        }
    }

    /// Flies to the view before.
    pub fn go_back(&mut self, pane: &Pane) {
        self.trail.note(&pane.place);
        if let Some(place) = self.trail.back().copied() {
            self.fly_to(pane, place);
        }
    }

    /// Flies to the view that one came back from.
    pub fn go_forward(&mut self, pane: &Pane) {
        if let Some(place) = self.trail.forward().copied() {
            self.fly_to(pane, place);
        }
    }

    /// Flies to a place, or to the whole body.
    pub fn fly_to(&mut self, pane: &Pane, to: Option<VisibleRegion>) {
        let (Some(view), Some(opened)) = (self.view, self.opened.clone()) else { return };
        let whole = self.known_whole(pane, &opened.dataset);
        let Some(end) = crate::plate::view(to, whole, view.pixels, self.taken) else { return };
        self.is_at_the_end = false;
        self.flight =
            Some(Flight::new(VisibleRegion::of(&view), VisibleRegion::of(&end), to, self.now));
    }

    /// A box around the body as it is drawn, deformed or not; that of a deformed one is computed in
    /// the background.
    fn whole(&mut self, ctx: &egui::Context, pane: &Pane, dataset: &Dataset) -> ppum::vec2::Rect {
        match (pane.scene.deformed, self.frames.newest()) {
            (Some(_), Some(frame)) => {
                let SceneRequest { deformed, outline, ref mirror, .. } = pane.scene;
                let mirror = mirror.clone();
                let scene = SceneRequest { deformed, outline, mirror, ..SceneRequest::default() };
                let asked = VisibleBodies { field: Arc::clone(&frame.field), scene };
                let theirs = asked.clone();
                self.moved.ask(&asked, false, ctx, move |_| Some(theirs.bounds()));
            }
            _ => self.moved.forget(),
        }
        self.known_whole(pane, dataset)
    }

    /// Returns the view of a figure: the body without what lies beside it, or what is seen of it.
    #[must_use]
    pub fn cropped(&mut self, pane: &Pane) -> Option<View> {
        let (view, dataset) = (self.view?, Arc::clone(&self.opened.as_ref()?.dataset));
        if pane.place.is_some() {
            return Some(view);
        }
        View::hug(self.known_whole(pane, &dataset), view.pixels).ok()
    }

    /// Returns the last box that is known: while a factor is dragged, that of the previous one.
    fn known_whole(&mut self, pane: &Pane, dataset: &Dataset) -> ppum::vec2::Rect {
        let known = pane.scene.deformed.and(self.moved.newest());
        let known =
            known.filter(|(moved, _)| moved.field.dataset().domain.bounds == dataset.domain.bounds);
        let bounds = known.and_then(|(_, bounds)| bounds.as_ref().as_ref().ok());
        bounds.copied().unwrap_or_else(|| self.plate(pane, dataset))
    }

    /// A box around the undeformed body, the whole of one that is mirrored.
    fn plate(&self, pane: &Pane, dataset: &Dataset) -> ppum::vec2::Rect {
        let bounds = dataset.domain.bounds;
        let frame = self.frames.newest().filter(|_| pane.scene.mirror.is_some());
        let frame = frame.filter(|frame| frame.field.dataset().domain.bounds == bounds);
        frame.map_or(bounds, |frame| frame.lines.whole(bounds))
    }

    /// True while an image is on its way, or where it is to be.
    #[must_use]
    pub fn is_drawing(&self) -> bool {
        self.frames.is_working() || self.moved.is_working()
    }

    /// Describes the view in a few words: `plate.h5 · step 3 · syy`.
    #[must_use]
    pub fn named(&self, pane: &Pane) -> Option<String> {
        let OpenDataset { path, dataset, .. } = self.opened.as_ref()?;
        let file = path.as_deref().and_then(std::path::Path::file_name);
        let name = file.map_or(dataset.title.clone(), |name| name.to_string_lossy().into_owned());
        let step = pane.scene.subject.step_of(dataset);
        let step = (dataset.steps.len() > 1).then(|| format!("step {step}"));
        let known = self.controls.known.field();
        let usual = || known.map(|field| default_quantity(field.field()).to_owned());
        let quantity = pane.scene.quantity.clone().or_else(usual);
        let name = Some(name).filter(|name| !name.is_empty());
        Some([name, step, quantity].into_iter().flatten().collect::<Vec<_>>().join(" · "))
    }

    /// True for a dataset without displacements.
    #[must_use]
    pub fn is_rigid(&self) -> bool {
        self.opened.as_ref().is_some_and(|opened| opened.dataset.equation.elastic().is_none())
    }

    /// Says for a few seconds, on the line below the view, why a key did nothing.
    pub fn tell(&mut self, text: impl Into<String>) {
        self.unheeded = Some((text.into(), self.now));
    }

    /// The number of tips of the step that is looked at.
    #[must_use]
    pub fn tips(&self, pane: &Pane) -> usize {
        let Some(opened) = &self.opened else { return 0 };
        let step = opened.dataset.steps.get(pane.scene.subject.step_of(&opened.dataset));
        step.map_or(0, |step| tips(&step.cracks).count())
    }

    /// Flies to a tip of the step that is looked at, by its number.
    pub fn fly_to_tip(&mut self, pane: &Pane, number: usize) {
        let Some(opened) = &self.opened else { return };
        let step = pane.scene.subject.step_of(&opened.dataset);
        let Some(step) = opened.dataset.steps.get(step) else { return };
        let Some(tip) = tips(&step.cracks).nth(number) else { return };
        let center = step.cracks[tip.crack as usize].end_point(tip.end);
        let size = opened.dataset.domain.bounds.size();
        let width = TIP * size.x.max(size.y);
        self.fly_to(pane, Some(VisibleRegion { center: center.into(), width }));
    }

    /// The map, the scale bar, and a word where it goes no deeper.
    fn furnish(&mut self, ui: &Ui, rect: Rect, pane: &mut Pane, view: &View, times: f64) {
        scale_bar::show(ui, rect, view);
        if self.is_at_the_end {
            end_of_doubles(ui, rect);
        }
        let Some(frame) = self.frames.newest() else { return };
        if self.locator.as_ref().is_none_or(|(field, _)| !Arc::ptr_eq(field, &frame.field)) {
            let locator = Locator::new(frame.field.field());
            self.locator = Some((Arc::clone(&frame.field), locator));
        }
        let Some((_, Some(locator))) = &self.locator else { return };
        if let Some(point) = locator.show(ui, rect, view, times) {
            self.fly_to(pane, Some(VisibleRegion { center: point.into(), width: view.width }));
        }
    }

    /// Moves the view by parts of its size, and enlarges it around its middle.
    pub fn nudge(&mut self, pane: &mut Pane, right: f64, up: f64, factor: f64) {
        let (Some(view), Some(opened)) = (self.view, &self.opened) else { return };
        let shift = ppum::vec2::vec2(right * view.width, up * view.height()) * PAN;
        let moved =
            VisibleRegion { center: (view.center + shift).into(), width: view.width / factor };
        let place = bounded(moved, &self.plate(pane, &opened.dataset));
        self.is_at_the_end = place.width > moved.width;
        pane.place = Some(place);
    }

    fn fly(&mut self, ui: &Ui, pane: &mut Pane) {
        let Some(flight) = &self.flight else { return };
        match flight.at(ui.input(|input| input.time)) {
            Some(place) => {
                pane.place = Some(place);
                ui.ctx().request_repaint();
            }
            None => {
                pane.place = flight.end;
                self.flight = None;
            }
        }
    }

    /// Drags, wheels and double clicks.
    fn move_by_mouse(
        &mut self,
        ui: &Ui,
        response: &egui::Response,
        rect: Rect,
        pane: &mut Pane,
        view: &View,
        dataset: &Dataset,
    ) {
        let scale = f64::from(ui.pixels_per_point());
        if response.double_clicked() && self.reading.tool.is_none() {
            self.fly_to(pane, None);
        }
        if response.dragged_by(PointerButton::Primary) {
            let delta = response.drag_delta();
            let by = ppum::vec2::vec2(-f64::from(delta.x), f64::from(delta.y));
            let center = view.center + by * (scale * view.pixel_size());
            let place = VisibleRegion { center: center.into(), width: view.width };
            pane.place = Some(bounded(place, &self.plate(pane, dataset)));
            self.flight = None;
        }
        if let Some(at) = response.hover_pos() {
            let (pinch, wheel) = ui.input(|i| (i.zoom_delta(), i.smooth_scroll_delta().y));
            let factor = f64::from(pinch) * (f64::from(wheel) / WHEEL).exp();
            if factor != 1.0 {
                let pixel =
                    ppum::vec2::vec2(f64::from(at.x - rect.min.x), f64::from(at.y - rect.min.y))
                        * scale;
                let offset = self.snapped(view, view.offset_at(pixel), scale);
                let plate = self.plate(pane, dataset);
                let (place, is_at_the_end) = zoomed(view, offset, factor, &plate);
                (pane.place, self.is_at_the_end) = (Some(place), is_at_the_end);
                self.flight = None;
            }
        }
    }

    /// The way from the view's centre to the point that a ring marks near the pointer, else to the
    /// pointer itself, so that one who enlarges a point of a crack stays on the crack.
    fn snapped(&self, view: &View, pointer: Vec2, scale: f64) -> Vec2 {
        let is_marked = |spot: &Location| spot.on.is_some() || spot.offset() == Vec2::ZERO;
        let ring = self.reading.hover.as_ref().filter(|probed| is_marked(&probed.spot));
        let offset = ring.map(|probed| probed.spot.from(view.center));
        let reach = (readout::SNAP + 1.0) * scale * view.pixel_size();
        offset.filter(|offset| (*offset - pointer).length() < reach).unwrap_or(pointer)
    }

    /// The newest image of the dataset that is open: not of the one before, which may still be
    /// seen.
    #[must_use]
    pub fn frame(&self) -> Option<&Arc<RenderedFrame>> {
        let dataset = &self.opened.as_ref()?.dataset;
        self.frames.newest().filter(|frame| Arc::ptr_eq(&frame.wanted.dataset, dataset))
    }

    /// Shows a dataset from now on: where another body was, if it has the same place, and else the
    /// whole of it.
    pub fn take(&mut self, pane: &mut Pane, opened: OpenDataset) {
        let bounds = |opened: &OpenDataset| opened.dataset.domain.bounds;
        if self.opened.as_ref().is_some_and(|before| bounds(before) != bounds(&opened)) {
            pane.place = None;
            self.flight = None;
        }
        self.opened = Some(opened);
    }

    /// Draws the newest image, and what lies over it.
    fn paint(&mut self, ui: &Ui, rect: Rect, view: &View) {
        let Some(frame) = self.frames.newest() else { return };
        let painter = ui.painter_at(rect);
        self.texture.show(&painter, &frame.picture, view, rect);
        self.sheet.show(&painter, frame, view, rect);
    }
}

/// Width of the view around a tip that one flies to, in parts of the body's size.
const TIP: f64 = 0.05;
/// Turns of the wheel, in points, that enlarge e times.
const WHEEL: f64 = 240.0;

/// Says that it goes no deeper.
fn end_of_doubles(ui: &Ui, rect: Rect) {
    let painter = ui.painter_at(rect);
    let words = "As deep as double precision goes".to_owned();
    let galley = painter.layout_no_wrap(words, egui::FontId::proportional(13.0), Color32::WHITE);
    let at =
        egui::Align2::CENTER_TOP.anchor_size(rect.center_top() + vec2(0.0, 14.0), galley.size());
    painter.rect_filled(at.expand(6.0), 4.0, Color32::from_black_alpha(170));
    painter.galley(at.min, galley, Color32::WHITE);
}

/// The offset from the view's centre of a position in the window.
fn offset(view: &View, rect: Rect, at: egui::Pos2) -> Vec2 {
    let points = f64::from(rect.width()) / f64::from(view.pixels[0]);
    let pixel = (at - rect.min) / points as f32;
    view.offset_at(ppum::vec2::vec2(f64::from(pixel.x), f64::from(pixel.y)))
}
