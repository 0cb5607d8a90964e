//! The plate, edge to edge: shown from the newest picture, moved by the mouse.

pub mod flight;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use egui::{Color32, PointerButton, Rect, Sense, TextureHandle, TextureOptions, Ui, pos2, vec2};
use ppum::crack::tips;
use ppum::dataset::Dataset;
use ppum::vec2::Vec2;
use ppum_render::view::View;

use crate::frames::{Frame, Frames, Wanted};
use crate::session::{Pane, Place};
use crate::shapes::{self, Placed};
use crate::undo::Undo;
use flight::Flight;

/// A dataset that is open.
#[derive(Clone, Debug)]
pub struct Opened {
    /// Its file, if it came from one.
    pub path: Option<PathBuf>,
    /// The dataset.
    pub dataset: Arc<Dataset>,
}

/// One view: its dataset, its pictures, and what the mouse does in it.
pub struct Stage {
    /// The dataset.
    pub opened: Option<Opened>,
    /// Pictures, made in the background.
    pub frames: Frames,
    /// Views that were, to go back to.
    pub trail: Undo<Option<Place>>,
    /// The view on the window's pixels.
    pub view: Option<View>,
    /// The position of the mouse, as an offset from the view's centre.
    pub hover: Option<Vec2>,
    texture: Option<Texture>,
    flight: Option<Flight>,
}

/// A picture on its way to the screen.
struct Texture {
    frame: Arc<Frame>,
    handle: TextureHandle,
}

/// Part of the picture that the keys move it by.
const PAN: f64 = 0.125;
/// The largest and the smallest width, in parts of the plate's size.
const WIDEST: f64 = 20.0;
const NARROWEST: f64 = 1e-12;

impl Stage {
    /// A stage without a dataset.
    #[must_use]
    pub fn new(ctx: &egui::Context) -> Self {
        let ctx = ctx.clone();
        Self {
            opened: None,
            frames: Frames::new(move || ctx.request_repaint()),
            trail: Undo::new(None),
            view: None,
            hover: None,
            texture: None,
            flight: None,
        }
    }

    /// Shows the pane in all the room there is.
    pub fn show(&mut self, ui: &mut Ui, pane: &mut Pane) {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Plate"));
        let scale = ui.pixels_per_point();
        let pixels = [rect.width(), rect.height()].map(|n| ((n * scale).round() as u32).max(1));
        let Some(opened) = self.opened.clone() else { return };
        self.fly(ui, pane);
        let Some(view) = view(pane, &opened.dataset, pixels) else { return };
        self.move_by_mouse(ui, &response, rect, pane, &view, &opened.dataset);
        let view = crate::stage::view(pane, &opened.dataset, pixels).unwrap_or(view);
        self.view = Some(view);
        self.hover = response.hover_pos().map(|at| offset(&view, rect, at));
        if self.flight.is_none() && !response.dragged() {
            self.trail.note(&pane.place);
        }
        self.frames.want(Wanted { dataset: opened.dataset, scene: pane.scene.clone(), view });
        self.frames.poll();
        self.paint(ui, rect, &view);
    }

    /// Flies to a place, or to the whole plate.
    pub fn fly_to(&mut self, pane: &Pane, to: Option<Place>) {
        let (Some(view), Some(opened)) = (self.view, &self.opened) else { return };
        let mut target = pane.clone();
        target.place = to;
        let Some(end) = crate::stage::view(&target, &opened.dataset, view.pixels) else { return };
        self.flight = Some(Flight::new(Place::of(&view), Place::of(&end), to));
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
        self.fly_to(pane, Some(Place { center: center.into(), width }));
    }

    /// Moves the view by parts of its size, and enlarges it around its middle.
    pub fn nudge(&mut self, pane: &mut Pane, right: f64, up: f64, factor: f64) {
        let (Some(view), Some(opened)) = (self.view, &self.opened) else { return };
        let shift = ppum::vec2::vec2(right * view.width, up * view.height()) * PAN;
        let moved = Place { center: (view.center + shift).into(), width: view.width / factor };
        pane.place = Some(bounded(moved, &opened.dataset));
    }

    fn fly(&mut self, ui: &Ui, pane: &mut Pane) {
        let Some(flight) = &self.flight else { return };
        match flight.at(Instant::now()) {
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
        if response.double_clicked() {
            self.fly_to(pane, None);
        }
        if response.dragged_by(PointerButton::Primary) {
            let delta = response.drag_delta();
            let by = ppum::vec2::vec2(-f64::from(delta.x), f64::from(delta.y));
            let center = view.center + by * (scale * view.pixel_size());
            pane.place = Some(Place { center: center.into(), width: view.width });
            self.flight = None;
        }
        if let Some(at) = response.hover_pos() {
            let (pinch, wheel) = ui.input(|i| (i.zoom_delta(), i.smooth_scroll_delta().y));
            let factor = f64::from(pinch) * (f64::from(wheel) / WHEEL).exp();
            if factor != 1.0 {
                let pixel =
                    ppum::vec2::vec2(f64::from(at.x - rect.min.x), f64::from(at.y - rect.min.y))
                        * scale;
                let shift = view.offset_at(pixel) * (1.0 - 1.0 / factor);
                let place =
                    Place { center: (view.center + shift).into(), width: view.width / factor };
                pane.place = Some(bounded(place, dataset));
                self.flight = None;
            }
        }
    }

    /// Draws the newest picture where it belongs in the view, whatever view it was made for.
    fn paint(&mut self, ui: &Ui, rect: Rect, view: &View) {
        let Some(newest) = self.frames.newest() else { return };
        if self.texture.as_ref().is_none_or(|texture| !Arc::ptr_eq(&texture.frame, newest)) {
            let image = &newest.picture.image;
            let size = image.size.map(|n| n as usize);
            let image = egui::ColorImage::from_rgba_unmultiplied(size, &image.rgba);
            let options = TextureOptions::NEAREST;
            match &mut self.texture {
                Some(texture) => {
                    texture.handle.set(image, options);
                    texture.frame = Arc::clone(newest);
                }
                None => {
                    let handle = ui.ctx().load_texture("plate", image, options);
                    self.texture = Some(Texture { frame: Arc::clone(newest), handle });
                }
            }
        }
        let Some(Texture { frame, handle }) = &self.texture else { return };
        let placed = placed(&frame.wanted.view, view, rect);
        let size = frame.picture.image.size.map(|n| n as f32 * placed.scale);
        let target = Rect::from_min_size(placed.corner, vec2(size[0], size[1]));
        let painter = ui.painter_at(rect);
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        painter.image(handle.id(), target, whole, Color32::WHITE);
        shapes::draw(&painter, placed, &frame.layers.items);
    }
}

/// Width of the view around a tip that one flies to, in parts of the plate's size.
const TIP: f64 = 0.05;
/// Turns of the wheel, in points, that enlarge e times.
const WHEEL: f64 = 240.0;

/// The view of a pane on so many pixels; none of a plate without size.
#[must_use]
pub fn view(pane: &Pane, dataset: &Dataset, pixels: [u32; 2]) -> Option<View> {
    match pane.place {
        Some(place) => place.view(pixels).ok(),
        None => {
            let bounds = dataset.domain.bounds;
            let room = bounds.size() * ROOM;
            let whole = ppum::vec2::Rect::new(bounds.min - room, bounds.max + room);
            View::fit(whole, pixels).ok()
        }
    }
}

/// Room around the whole plate, in parts of its size.
const ROOM: f64 = 0.03;

/// A place no wider and no narrower than can be shown.
#[must_use]
pub fn bounded(place: Place, dataset: &Dataset) -> Place {
    let size = dataset.domain.bounds.size();
    let size = size.x.max(size.y);
    Place { width: place.width.clamp(NARROWEST * size, WIDEST * size), ..place }
}

/// Where a picture made for one view lies in a rectangle that shows another.
fn placed(picture: &View, view: &View, rect: Rect) -> Placed {
    let points = f64::from(rect.width()) / f64::from(view.pixels[0]);
    let corner = picture.offset_at(Vec2::ZERO) + (picture.center - view.center);
    let corner = view.pixel_of_offset(corner) * points;
    Placed {
        corner: rect.min + vec2(corner.x as f32, corner.y as f32),
        scale: (picture.pixel_size() / view.pixel_size() * points) as f32,
    }
}

/// The offset from the view's centre of a position in the window.
fn offset(view: &View, rect: Rect, at: egui::Pos2) -> Vec2 {
    let points = f64::from(rect.width()) / f64::from(view.pixels[0]);
    let pixel = (at - rect.min) / points as f32;
    view.offset_at(ppum::vec2::vec2(f64::from(pixel.x), f64::from(pixel.y)))
}
