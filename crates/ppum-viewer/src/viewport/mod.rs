//! A view, edge to edge: shown from the newest image, moved by the mouse.

pub mod bar;
mod curves;
pub mod difference;
mod fallback;
pub mod hover;
pub mod locator;
pub mod marks;
mod opened;
mod pipeline;
pub mod pixels;
pub mod readout;
pub mod scale_bar;
mod solids;
pub mod split_view;
pub mod texture;

use std::sync::Arc;

use egui::{Color32, Rect, Response, Sense, Ui, vec2};
use ppum::crack::tips;
use ppum::dataset::{Dataset, Step};
use ppum::decompose::FieldPart;
use ppum::vec2::{Rect as BodyBox, Vec2};
use ppum_figure::overlay::{LoadMark, line_scale};
use ppum_render::view::View;
use ppum_scene::compare::Compare;
use ppum_scene::location::Location;
use ppum_scene::overlays::Overlay;
use ppum_scene::owner::Owner;
use ppum_scene::quantity::default_quantity;
use ppum_scene::request::FigureTexts;
use ppum_scene::scene::SceneRequest;
use ppum_scene::subject::scene_bounds;

use crate::camera::{BodyBoxes, Camera};
use crate::controls::{Controls, step_range};
use crate::export::{ExportChoice, ImageExport, Motion, PageSize};
use crate::field::OwnedField;
use crate::frames::{Backend, FrameRequest, PaneFrames, RenderedFrame};
use crate::measure::MeasuringTools;
use crate::memo::Memo;
use crate::query::BackgroundQuery;
use crate::same_arc::SameArc;
use crate::session::{Pane, VisibleRegion};
use difference::PairRole;
use hover::HoverGeometry;
use locator::Locator;
pub use opened::OpenDataset;
use split_view::SplitView;
use texture::{LayerTexture, Texture};

/// One view: its dataset, its images, and what the mouse does in it.
pub struct ViewState {
    /// The dataset.
    pub opened: Option<OpenDataset>,
    /// Images, made in the background.
    pub frames: PaneFrames,
    /// Where it looks.
    pub camera: Camera,
    /// The state of the panels of this view.
    pub controls: Controls,
    /// The readings of it.
    pub tools: MeasuringTools,
    /// The position of the mouse, as an offset from the view's centre.
    pub hover: Option<Vec2>,
    /// The relation of the view to the one beside it.
    pub pair: PairRole,
    /// The caption; `None` without another view beside it.
    pub caption: Option<String>,
    /// Choices that cannot be shown and are replaced, for the caller to report.
    pub told: Vec<String>,
    /// Why a key did nothing, and when.
    unheeded: Option<(String, f64)>,
    canvas: ViewCanvas,
    deformed: BackgroundQuery<VisibleBodies, ppum::vec2::Rect>,
    now: f64,
}

/// The things that a view is drawn with.
#[derive(Default)]
struct ViewCanvas {
    texture: Texture,
    layers: LayerTexture,
    bar: bar::BarGrip,
    split: SplitView,
    /// The map of the body, and the field that it was drawn of.
    locator: Memo<SameArc<OwnedField>, Option<Locator>>,
}

/// A scene whose bounding box is computed: that of the deformed whole, and of its undeformed border
/// if that is drawn too.
#[derive(Clone, PartialEq)]
struct VisibleBodies {
    field: SameArc<OwnedField>,
    scene: SceneRequest,
}

impl VisibleBodies {
    fn bounds(&self) -> Result<ppum::vec2::Rect, String> {
        let bounds = scene_bounds(self.field.dataset(), self.field.field(), &self.scene);
        bounds.map_err(|error| error.to_string())
    }
}

impl ViewState {
    /// A view without a dataset.
    #[must_use]
    pub fn new(ctx: &egui::Context, backend: Backend) -> Self {
        let ctx = ctx.clone();
        Self {
            opened: None,
            frames: PaneFrames::with_backend(backend, move || ctx.request_repaint()),
            camera: Camera::default(),
            controls: Controls::default(),
            tools: MeasuringTools::default(),
            hover: None,
            pair: PairRole::default(),
            caption: None,
            told: Vec::new(),
            unheeded: None,
            canvas: ViewCanvas::default(),
            deformed: BackgroundQuery::default(),
            now: 0.0,
        }
    }

    /// Returns the export of what is seen, on its own pixels where no page is given; none while
    /// there is no image.
    pub fn export(
        &self,
        pane: &Pane,
        (choice, motion): (ExportChoice, Motion),
        page: Option<PageSize>,
    ) -> Option<ImageExport> {
        let frame = self.frame()?;
        let view = match choice {
            ExportChoice::Image => self.camera.view,
            _ => self.camera.cropped(pane.place),
        };
        let view = view.unwrap_or(frame.request.view);
        Some(ImageExport {
            field: Arc::clone(&frame.field),
            file: self.opened.as_ref().and_then(|opened| opened.path.clone()),
            left: frame.left.clone(),
            // an animation of the steps finds their range by itself
            scene: match choice {
                ExportChoice::Steps => pane.scene.drawn(),
                _ => self.controls.ranged(&pane.scene),
            },
            view,
            page: page.unwrap_or(PageSize::pixels(view.pixels)),
            choice,
            motion: Motion { factor: frame.factor, ..motion },
            texts: FigureTexts::default(),
        })
    }

    /// Takes the images that were made since, and reads what panels tell of them, which are shown
    /// next.
    pub fn poll(&mut self, ctx: &egui::Context, pane: &mut Pane) {
        if self.frames.poll() {
            self.fall_back(pane);
        }
        let Some(opened) = &self.opened else { return };
        let step = pane.scene.subject.step_of(&opened.dataset);
        self.controls.facts.look_up(&opened.dataset, step);
        self.controls.advance(ctx, pane, &self.frames);
        let view = self.camera.view.filter(|_| self.pair == PairRole::Alone);
        let asked = view.and_then(|view| step_range::asked(pane, opened, view));
        self.controls.step_range.advance(ctx, asked, ctx.input(|input| input.time));
        if let Some(frame) = self.frame().cloned() {
            self.tools.refresh(&frame, pane);
        }
    }

    /// Shows the pane in all the room there is.
    pub fn show(&mut self, ui: &mut Ui, pane: &mut Pane) {
        let room = (ui.available_size() - vec2(0.0, readout::height(ui.available_width())))
            .max(vec2(1.0, 1.0));
        ui.spacing_mut().item_spacing.y = 0.0;
        let (rect, response) = ui.allocate_exact_size(room, Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Plate"));
        let Some(opened) = self.opened.clone() else { return };
        self.now = ui.input(|input| input.time);
        let Some(view) = self.look(ui, &response, pane, &opened.dataset) else { return };
        self.hover = response.hover_pos().map(|at| offset(&view, rect, at));
        self.request(pane, &opened.dataset, view);
        let is_compared = self.compared(pane).is_some();
        if let Some(frame) = self.frames.newest() {
            let (canvas, painter) = (&mut self.canvas, ui.painter_at(rect));
            canvas.texture.show(&painter, &frame.colored, &view, rect);
            canvas.layers.show(&painter, frame, &view, rect);
            let layers = &mut canvas.layers;
            canvas.split.show(ui, rect, (pane, is_compared), (frame, layers), &view);
            let hover = self.tools.hover.as_ref();
            bar::show(ui, rect, &mut canvas.bar, &mut pane.scene.colors, frame, hover);
            bar::of_difference(ui, rect, (pane, is_compared), frame);
        }
        fallback::show(ui, rect, &self.frames);
        let times = self.camera.times(&view);
        self.furnish(ui, rect, &view, times);
        let map = self.canvas.locator.last().and_then(|(_, locator)| locator.as_ref());
        let taken = map.map_or(0.0, |map| map.width(rect, times));
        let caption = self.caption.as_deref();
        difference::show(ui, (rect, taken), (&self.pair, caption), &self.frames);
        let sight = self.hover_geometry(view, rect);
        self.read(ui, &response, &sight, pane);
        self.pick(&response, pane);
        self.marks(ui, &sight, pane);
        self.line(ui, pane);
    }

    fn hover_geometry(&self, view: View, rect: Rect) -> HoverGeometry {
        HoverGeometry::new(view, rect, self.frames.newest().map(|frame| &**frame))
    }

    /// The view of this frame: after a flight, and what the mouse did over the one before.
    fn look(
        &mut self,
        ui: &Ui,
        response: &Response,
        pane: &mut Pane,
        dataset: &Dataset,
    ) -> Option<View> {
        let (rect, scale) = (response.rect, ui.pixels_per_point());
        let pixels = [rect.width(), rect.height()].map(|n| ((n * scale).round() as u32).max(1));
        self.camera.advance(ui, &mut pane.place);
        if pane.place.is_some_and(|place| place.view(pixels).is_err()) {
            self.show_whole(pane);
        }
        if let Some(shown) = self.camera.shown(pane.place, pixels) {
            let sight = self.hover_geometry(shown, rect);
            if !self.draw_by_mouse(ui, response, &sight, pane) {
                self.move_by_mouse(ui, response, &shown, pane);
            }
        }
        let taken = (bar::width(rect) * scale).round() as u32;
        let mut boxes = self.boxes(ui.ctx(), pane, dataset);
        let is_loaded = |overlay: &Overlay| matches!(overlay, Overlay::Loads | Overlay::Supports);
        if pane.scene.overlays.shown.iter().any(is_loaded) {
            boxes.whole = with_arrows(boxes.whole, pixels, taken).unwrap_or(boxes.whole);
        }
        self.camera.look(ui, pane.place, (pixels, taken), boxes)
    }

    /// Requests the image of a view.
    fn request(&mut self, pane: &Pane, dataset: &Arc<Dataset>, view: View) {
        let scene = self.controls.drawn(&pane.scene);
        let (compare, minus) = (self.compared(pane), self.pair.minus().cloned());
        self.frames.want(FrameRequest { dataset: dataset.into(), scene, view, compare, minus });
    }

    /// The way of resampling that is looked at: grids are of one field, and of the body as it was.
    pub(crate) fn compared(&self, pane: &Pane) -> Option<Compare> {
        let is_moved = pane.scene.deformed.is_some() || pane.scene.mirror.is_some();
        pane.compare.filter(|_| !is_moved && self.pair.minus().is_none())
    }

    /// Chooses the patch that is clicked on, if one is to be chosen.
    fn pick(&mut self, response: &egui::Response, pane: &mut Pane) {
        let (Some(View { center, .. }), Some(offset)) = (self.camera.view, self.hover) else {
            return;
        };
        if !self.controls.is_picking || !response.clicked() {
            return;
        }
        self.controls.is_picking = false;
        let owner = self.frame().and_then(|frame| Owner::at(frame.field.field(), center, offset));
        if let Some(owner) = owner {
            pane.scene.subject.part = Some(FieldPart::Patch(owner.patch()).to_string());
        }
    }

    /// Boxes around the body; that of a deformed one is computed in the background, and until then
    /// it is the last one that is known: while a factor is dragged, that of the previous one.
    fn boxes(&mut self, ctx: &egui::Context, pane: &Pane, dataset: &Dataset) -> BodyBoxes {
        let bounds = dataset.domain.bounds;
        let of_body = |field: &OwnedField| field.dataset().domain.bounds == bounds;
        match (pane.scene.deformed, self.frames.newest()) {
            (Some(_), Some(frame)) => {
                let SceneRequest { deformed, outline, ref mirror, .. } = pane.scene;
                let mirror = mirror.clone();
                let scene = SceneRequest { deformed, outline, mirror, ..SceneRequest::default() };
                let asked = VisibleBodies { field: frame.field.clone(), scene };
                let theirs = asked.clone();
                self.deformed.ask(&asked, false, ctx, move |_| Some(theirs.bounds()));
            }
            _ => self.deformed.forget(),
        }
        let frame = self.frames.newest().filter(|_| pane.scene.mirror.is_some());
        let frame = frame.filter(|frame| of_body(&frame.field));
        let undeformed = frame.map_or(bounds, |frame| frame.lines.whole(bounds));
        let known = self.deformed.newest().filter(|(asked, _)| of_body(&asked.field));
        let whole = known.and_then(|(_, whole)| whole.as_ref().as_ref().ok());
        BodyBoxes { whole: whole.copied().unwrap_or(undeformed), undeformed }
    }

    /// True while an image is on its way, or where it is to be.
    #[must_use]
    pub fn is_drawing(&self) -> bool {
        let is_searching = self.controls.step_range.is_searching();
        self.frames.is_working() || self.deformed.is_working() || is_searching
    }

    /// Describes the view in a few words: `plate.h5 · step 3 · syy`.
    pub(crate) fn named(&self, pane: &Pane) -> Option<String> {
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
    pub(crate) fn is_rigid(&self) -> bool {
        self.opened.as_ref().is_some_and(|opened| opened.dataset.equation.elastic().is_none())
    }

    /// Says for a few seconds, on the line below the view, why a key did nothing.
    pub fn tell(&mut self, text: impl Into<String>) {
        self.unheeded = Some((text.into(), self.now));
    }

    /// The step that is looked at.
    fn step(&self, pane: &Pane) -> Option<&Step> {
        let dataset = &self.opened.as_ref()?.dataset;
        dataset.steps.get(pane.scene.subject.step_of(dataset))
    }

    /// The number of tips of the step that is looked at.
    pub(crate) fn tips(&self, pane: &Pane) -> usize {
        self.step(pane).map_or(0, |step| tips(&step.cracks).count())
    }

    /// Flies to a tip of the step that is looked at, by its number.
    pub fn fly_to_tip(&mut self, pane: &Pane, number: usize) {
        let Some(step) = self.step(pane) else { return };
        let Some(tip) = tips(&step.cracks).nth(number) else { return };
        let center = step.cracks[tip.crack as usize].end_point(tip.end).into();
        let width = TIP * self.plate_size();
        self.camera.fly_to(Some(VisibleRegion { center, width }));
    }

    /// The map, the scale bar, and a word where it goes no deeper.
    fn furnish(&mut self, ui: &Ui, rect: Rect, view: &View, times: f64) {
        scale_bar::show(ui, rect, bar::below(rect), view);
        if self.camera.is_at_the_end {
            end_of_doubles(ui, rect);
        }
        let Some(frame) = self.frames.newest() else { return };
        let field = &frame.field;
        let new = || Locator::new(field.field());
        let Some(locator) = self.canvas.locator.get_or_make(field.clone(), new) else { return };
        if let Some(point) = locator.show(ui, rect, view, times) {
            let center = point.into();
            self.camera.fly_to(Some(VisibleRegion { center, width: view.width }));
        }
    }

    /// Moves the view by parts of its size, and enlarges it around its middle.
    pub fn nudge(&mut self, pane: &mut Pane, [right, up]: [f64; 2], factor: f64) {
        pane.place = self.camera.nudged(right, up, factor).or(pane.place);
    }

    /// Drags, wheels and double clicks. One who enlarges stays at a point that a ring marks near
    /// the pointer: a tip, or a point of a crack.
    fn move_by_mouse(&mut self, ui: &Ui, response: &Response, shown: &View, pane: &mut Pane) {
        if response.double_clicked() && self.tools.tool.is_none() {
            self.camera.fly_to(None);
        }
        let is_marked = |spot: &Location| spot.on.is_some() || spot.offset() == Vec2::ZERO;
        let ring = self.tools.hover.as_ref().filter(|probed| is_marked(&probed.spot));
        let reach = (readout::SNAP + 1.0) * f64::from(ui.pixels_per_point());
        let anchor = |view: &View, pointer: Vec2| {
            let offset = ring.map(|probed| probed.spot.from(view.center));
            let is_near = |at: &Vec2| (*at - pointer).length() < reach * view.pixel_size();
            offset.filter(is_near).unwrap_or(pointer)
        };
        pane.place = self.camera.moved_by_mouse(ui, response, shown, anchor).or(pane.place);
    }

    /// The newest image of the dataset that is open: not of the one before, which may still be
    /// seen.
    #[must_use]
    pub fn frame(&self) -> Option<&Arc<RenderedFrame>> {
        let dataset = &self.opened.as_ref()?.dataset;
        self.frames.newest().filter(|frame| Arc::ptr_eq(&frame.request.dataset, dataset))
    }

    /// Shows a dataset from now on: where another body was, if it has the same place, and else the
    /// whole of it.
    pub fn take(&mut self, pane: &mut Pane, opened: OpenDataset) {
        let bounds = |opened: &OpenDataset| opened.dataset.domain.bounds;
        if self.opened.as_ref().is_some_and(|before| bounds(before) != bounds(&opened)) {
            pane.place = None;
            self.camera.stop();
        }
        self.opened = Some(opened);
    }
}

/// Width of the view around a tip that one flies to, in parts of the body's size.
const TIP: f64 = 0.05;

/// A box with room for arrows of loads around it, where all of it is seen.
fn with_arrows(whole: BodyBox, [columns, rows]: [u32; 2], taken: u32) -> Option<BodyBox> {
    let longest = LoadMark::longest([columns, rows], line_scale([columns, rows])) + ROOM;
    let beside = |size: u32, taken: u32| size.checked_sub(taken + 2 * longest.ceil() as u32);
    let pixels = [beside(columns, taken)?, beside(rows, 0)?];
    let room = View::fit(whole, pixels).ok()?.pixel_size() * longest;
    let room = ppum::vec2::vec2(room, room);
    Some(BodyBox::new(whole.min - room, whole.max + room))
}

/// Pixels between arrows and the end of the view.
const ROOM: f64 = 6.0;

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
