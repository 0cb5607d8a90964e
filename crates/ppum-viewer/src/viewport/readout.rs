//! The reading at the pointer: the line below the view, and probes by clicks.

use egui::{Color32, Pos2, Response, RichText, Ui, vec2};
use ppum::vec2::Vec2;

use super::ViewState;
use super::hover::HoverGeometry;
use crate::controls::range::digits;
use crate::measure::tool::Tool;
use crate::measure::words::{self, LocationFormat};
use crate::session::Pane;
use ppum_scene::location::Location;

/// Seconds for which it is told why a key did nothing.
const TOLD: f64 = 4.0;
/// Height of a line below the view.
const HEIGHT: f32 = 22.0;
/// Views that are narrower have two lines.
const NARROW: f32 = 760.0;
/// Distance in points of the window within which a tip or a crack is meant.
pub(super) const SNAP: f64 = 4.0;
/// That distance for the mark of a probe that is clicked.
const MARK: f32 = 9.0;

/// Lines below a view of some width.
fn lines(width: f32) -> usize {
    if width < NARROW { 2 } else { 1 }
}

/// The height of the lines below a view of some width.
pub(super) fn height(width: f32) -> f32 {
    HEIGHT * lines(width) as f32 + 2.0
}

impl ViewState {
    /// Reads the values at the pointer and at the probes.
    pub(super) fn read(
        &mut self,
        ui: &Ui,
        response: &Response,
        sight: &HoverGeometry,
        pane: &mut Pane,
    ) {
        let Some(frame) = self.frame().cloned() else {
            self.tools.forget();
            return;
        };
        let at = response.hover_pos().filter(|_| self.tools.grip.is_none());
        let spot = at.and_then(|at| sight.spot(at));
        let is_free = ui.input(|input| input.modifiers.shift);
        let reader = self.tools.reader(&frame);
        let hover = spot.map(|spot| match is_free {
            true => spot,
            false => reader.snapped(spot, sight.reach(SNAP)),
        });
        self.tools.hover = hover.map(|spot| reader.read(&spot));
        self.click(response, sight, pane);
        self.tools.refresh(&frame, pane);
        self.ask_integral(ui, pane, &frame);
    }

    /// Asks for K of what is shown, with all that is replaced in it.
    fn ask_integral(&mut self, ui: &Ui, pane: &Pane, frame: &crate::frames::RenderedFrame) {
        let dataset = frame.field.dataset();
        let step = frame.request.scene.subject.step_of(dataset);
        if self.tools.grip.is_none() {
            self.tools.integral.ask(pane.curve, dataset, step, ui.ctx());
        }
    }

    /// A click selects a probe; with the tool for probes it pins one where there is none.
    fn click(&mut self, response: &Response, sight: &HoverGeometry, pane: &mut Pane) {
        let is_free = matches!(self.tools.tool, None | Some(Tool::Probe));
        let at = response.interact_pointer_pos().filter(|_| response.clicked() && is_free);
        let Some(at) = at else { return };
        if let Some(known) = probe_at(sight, pane, at) {
            self.tools.selected = Some(known);
        } else if self.tools.tool.is_some()
            && let Some(spot) = self.hovered()
        {
            self.pin(pane, spot);
        }
    }

    /// Pins a probe; one that is there already is selected.
    pub fn pin(&mut self, pane: &mut Pane, spot: Location) {
        let known = pane.probes.iter().position(|probe| probe.is_at(&spot));
        if known.is_none() {
            pane.probes.push(spot);
        }
        self.tools.selected = known.or(Some(pane.probes.len() - 1));
    }

    /// The point of the body at the pointer.
    pub(crate) fn hovered(&self) -> Option<Location> {
        let hover = self.tools.hover.as_ref().filter(|probed| !probed.is_outside());
        hover.map(|probed| probed.spot)
    }

    /// The point that is read: that of the body at the pointer, else the middle of the view.
    pub(crate) fn spot(&self) -> Option<Location> {
        self.hovered().or_else(|| Some(Location::new(self.camera.view?.center, Vec2::ZERO)))
    }

    /// Returns the reading at the pointer, else at the selected probe, as a text to be copied.
    pub(crate) fn copied(&mut self) -> Option<String> {
        let frame = self.frame().cloned()?;
        let selected = self.tools.selected.and_then(|k| self.tools.probes.get(k));
        let probed = self.tools.hover.as_ref().or(selected)?.clone();
        let reader = self.tools.reader(&frame);
        Some(words::all(&probed, &reader.name, &reader.unit))
    }

    /// The lines below the view: parts that have no room are left out, the least important first.
    pub(super) fn line(&mut self, ui: &mut Ui, pane: &Pane) {
        let (parts, patches) = self.words(pane);
        let width = ui.available_width();
        let (rect, _) = ui.allocate_exact_size(vec2(width, height(width)), egui::Sense::hover());
        ui.painter().rect_filled(rect, 0.0, ui.visuals().panel_fill);
        let inner = rect.shrink2(vec2(8.0, 1.0));
        let ui = &mut ui.new_child(egui::UiBuilder::new().max_rect(inner));
        ui.set_clip_rect(rect);
        if let Some(text) = self.unheeded(ui) {
            let text = RichText::new(text).color(ui.visuals().warn_fg_color);
            let label = egui::Label::new(text).selectable(false);
            ui.add(if lines(width) > 1 { label.wrap() } else { label.truncate() });
            return;
        }
        let all = rows(ui, parts, &patches, lines(width));
        for (number, row) in all.into_iter().enumerate() {
            let top = vec2(0.0, HEIGHT * number as f32);
            let rect = egui::Rect::from_min_size(inner.min + top, vec2(inner.width(), HEIGHT));
            let layout = egui::Layout::left_to_right(egui::Align::Center);
            let builder = egui::UiBuilder::new().max_rect(rect).layout(layout);
            ui.scope_builder(builder, |ui| row_of(ui, row));
        }
    }

    /// Why a key did nothing, while that is told.
    fn unheeded(&mut self, ui: &Ui) -> Option<String> {
        let (text, since) = self.unheeded.clone()?;
        let rest = TOLD - (self.now - since);
        if rest <= 0.0 {
            self.unheeded = None;
            return None;
        }
        ui.ctx().request_repaint_after_secs(rest as f32);
        Some(text)
    }

    /// The parts of the line, the most important first, and the patches in words, the
    /// longest first.
    fn words(&mut self, pane: &Pane) -> (Vec<String>, Vec<String>) {
        // who pins probes wants to see values
        if let Some(tool) = self.tools.tool.filter(|tool| *tool != Tool::Probe) {
            return (vec![format!("{}; Escape leaves it", tool.hint())], Vec::new());
        }
        let Some(frame) = self.frame().cloned() else { return Default::default() };
        let (Some(probed), Some(view)) = (self.tools.hover.clone(), self.camera.view) else {
            return Default::default();
        };
        let (size, cracks) = (self.plate_size(), self.cracks(pane));
        let cracks = cracks.as_deref().unwrap_or_default();
        let places = LocationFormat { view: &view, size, cracks };
        let reader = self.tools.reader(&frame);
        let mut parts = vec![places.show(&probed.spot)];
        let norm = &frame.colored.normalization;
        let digits = digits([norm.min(), norm.max()], words::DIGITS);
        parts.push(words::values_to(&probed, &reader.name, &reader.unit, digits));
        parts.extend(words::terms(&probed));
        parts.extend(words::faces(&probed));
        parts.extend([words::gradients(&probed), words::owner(&probed)].into_iter().flatten());
        (parts, words::shorter(&probed))
    }
}

/// Texts beside each other.
fn row_of(ui: &mut Ui, texts: Vec<String>) {
    for (k, text) in texts.into_iter().enumerate() {
        if k > 0 {
            ui.separator();
        }
        let text = RichText::new(text).color(ui.visuals().strong_text_color());
        ui.add(egui::Label::new(text).truncate().selectable(false));
    }
}

/// The parts in so many rows, the first ones as full as can be.
fn rows(ui: &Ui, mut parts: Vec<String>, patches: &[String], count: usize) -> Vec<Vec<String>> {
    let mut all = Vec::new();
    for _ in 1..count {
        let mut rest = ui.available_width();
        let has_room = |text: &&String| {
            rest -= width(ui, text);
            rest >= 0.0
        };
        let shown = parts.iter().take_while(has_room).count().max(1).min(parts.len());
        all.push(parts.drain(..shown).collect());
    }
    all.push(fitting(ui, parts, patches));
    all
}

/// The width of a text with what is between two of them.
fn width(ui: &Ui, text: &str) -> f32 {
    let font = egui::TextStyle::Body.resolve(ui.style());
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, Color32::WHITE);
    galley.size().x + 2.0 * ui.spacing().item_spacing.x + 8.0
}

/// The parts that have room beside each other, and as many of the patches as there is room for
/// then; `…` where something was left out.
fn fitting(ui: &Ui, parts: Vec<String>, patches: &[String]) -> Vec<String> {
    let width = |text: &str| width(ui, text);
    let end = width("…");
    let mut rest = ui.available_width();
    let has_room = |(k, part): &(usize, String)| {
        rest -= width(part);
        // the value is told in any case, cut off if it has to be
        *k < 2 || rest >= end
    };
    let all = parts.len();
    let mut shown: Vec<String> =
        parts.into_iter().enumerate().take_while(has_room).map(|(_, part)| part).collect();
    let is_cut = shown.len() < all;
    let last = if is_cut { None } else { patches.iter().find(|text| width(text) <= rest) };
    match last {
        Some(text) => shown.push(text.clone()),
        None if is_cut || !patches.is_empty() => shown.push("…".into()),
        None => {}
    }
    shown
}

/// The number of the probe whose mark lies at a position.
fn probe_at(sight: &HoverGeometry, pane: &Pane, at: Pos2) -> Option<usize> {
    let near = |spot: &Location| sight.position(spot).is_some_and(|p| p.distance(at) <= MARK);
    pane.probes.iter().position(near)
}
