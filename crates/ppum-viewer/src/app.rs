//! The window as a whole: what is open, what is shown around the plate, what actions do.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{CentralPanel, Panel, Ui};
use ppum::dataset::Dataset;
use ppum_render::colormap::NAMES;
use ppum_render::range::Range;
use ppum_render::scale::Scale;
use ppum_scene::colors::Colors;
use ppum_scene::compare::Compare;
use ppum_scene::deformed::Factor;
use ppum_scene::overlays::Levels;

use crate::actions::{self, Action};
use crate::controls::swing::Swing;
use crate::desk::Desk;
use crate::export::{Kind, Order};
use crate::fonts::fonts;
use crate::frames::Backend;
use crate::panels::export::Exporter;
use crate::panels::palette::Palette;
use crate::panels::{self, help, top};
use crate::player::{self, Player};
use crate::session::{Page, Pane, Place, Session, Theme};
use crate::stage::{Opened, Stage};
use crate::undo::{Rest, Undo};

/// The window.
pub struct Viewer {
    /// What is chosen.
    pub session: Session,
    /// What is shown of it.
    pub stages: Vec<Stage>,
    rest: Rest<Session>,
    pub(crate) settings: Undo<Session>,
    /// What plays the steps of a series.
    pub player: Player,
    /// Files that are open, read and written.
    #[cfg(feature = "solve")]
    pub files: crate::files::Files,
    /// The problem that is written and solved.
    #[cfg(feature = "solve")]
    pub solving: crate::solving::Solving,
    palette: Option<Palette>,
    exporter: Option<Exporter>,
    has_help: bool,
    tip: usize,
    pub(crate) backend: Backend,
}

impl Viewer {
    /// A window that shows a session.
    #[must_use]
    pub fn new(ctx: &egui::Context, session: Session) -> Self {
        Self::with_backend(ctx, session, Backend::default())
    }

    /// The same with something else that computes the values.
    #[must_use]
    pub fn with_backend(ctx: &egui::Context, mut session: Session, backend: Backend) -> Self {
        ctx.set_fonts(fonts());
        session.mend();
        let stages = session.panes.iter().map(|_| Stage::new(ctx, backend)).collect();
        Self {
            settings: Undo::new(session.settings()),
            rest: Rest::new(session.settings()),
            session,
            stages,
            player: Player::default(),
            #[cfg(feature = "solve")]
            files: crate::files::Files::new(ctx, None),
            #[cfg(feature = "solve")]
            solving: crate::solving::Solving::new(ctx),
            palette: None,
            exporter: None,
            has_help: false,
            tip: 0,
            backend,
        }
    }

    /// Shows a dataset in the active pane.
    pub fn open(&mut self, path: Option<PathBuf>, dataset: Arc<Dataset>) {
        let active = self.session.active;
        self.session.panes[active].file.clone_from(&path);
        self.stages[active].opened = Some(Opened { path, dataset });
    }

    /// Shows the window once.
    pub fn show(&mut self, ui: &mut Ui) {
        #[cfg(feature = "solve")]
        self.work(ui);
        let mut actions = actions::pressed(ui.ctx());
        let active = self.session.active;
        self.player.advance(ui.ctx(), &mut self.session.panes[active], &self.stages[active]);
        let mut desk = Desk {
            session: &mut self.session,
            stages: &mut self.stages,
            player: &mut self.player,
            #[cfg(feature = "solve")]
            files: &mut self.files,
            #[cfg(feature = "solve")]
            solving: &mut self.solving,
            actions: &mut actions,
        };
        Panel::top("top").show(ui, |ui| top::show(ui, &mut desk));
        let has_plate = desk.stages.iter().any(|stage| stage.opened.is_some());
        if desk.session.panels && has_plate {
            Panel::right("side").default_size(300.0).show(ui, |ui| panels::side(ui, &mut desk));
        }
        panels::drawer::show(ui, &mut desk);
        CentralPanel::default().frame(egui::Frame::NONE).show(ui, |ui| plates(ui, &mut desk));
        help::show(ui, &mut self.has_help);
        if let Some(palette) = &mut self.palette {
            let (is_done, chosen) = palette.show(ui);
            actions.extend(chosen);
            if is_done {
                self.palette = None;
            }
        }
        let active = self.session.active;
        if let Some(exporter) = &mut self.exporter
            && !exporter.show(ui, &self.session.panes[active], &self.stages[active])
        {
            self.exporter = None;
        }
        self.copy(ui.ctx());
        for action in actions {
            self.act(ui.ctx(), action);
        }
        self.note(ui);
    }

    /// Notes the settings once nothing changes and nothing is dragged.
    fn note(&mut self, ui: &Ui) {
        let settings = self.session.settings();
        match self.rest.until(&settings, ui.input(|input| input.time)) {
            Some(seconds) => ui.ctx().request_repaint_after_secs(seconds as f32),
            // a drag is one step, and so is a series that is played
            None if ui.input(|input| input.pointer.any_down()) || self.player.is_playing => {}
            // what is written is one step, however long it takes
            None if ui.ctx().egui_wants_keyboard_input() => {}
            None => self.settings.note(&settings),
        }
    }

    /// Copies what is read when the system's key for it is pressed, unless someone writes.
    fn copy(&mut self, ctx: &egui::Context) {
        let is_asked = ctx.input(|input| input.events.contains(&egui::Event::Copy));
        if is_asked && !ctx.egui_wants_keyboard_input() {
            let text = self.stages[self.session.active].copied();
            if let Some(text) = text {
                ctx.copy_text(text);
            }
        }
    }

    /// Does what was asked for.
    pub fn act(&mut self, ctx: &egui::Context, action: Action) {
        let active = self.session.active;
        let (pane, stage) = (&mut self.session.panes[active], &mut self.stages[active]);
        match action {
            Action::Fit => stage.fly_to(pane, None),
            Action::Tip(number) => {
                self.tip = number;
                stage.fly_to_tip(pane, number);
            }
            Action::NextTip => {
                stage.fly_to_tip(pane, self.tip);
                self.tip += 1;
            }
            Action::ZoomIn => stage.nudge(pane, 0.0, 0.0, 1.5),
            Action::ZoomOut => stage.nudge(pane, 0.0, 0.0, 1.0 / 1.5),
            Action::Pan(right, up) => stage.nudge(pane, f64::from(right), f64::from(up), 1.0),
            Action::Back => stage.go_back(pane),
            Action::Forward => stage.go_forward(pane),
            Action::NextScale => {
                pane.scene.colors.scale = match pane.scene.colors.scale {
                    Scale::Linear => Scale::Log,
                    Scale::Log => Scale::SymLog,
                    Scale::SymLog => Scale::Linear,
                }
            }
            Action::AutomaticRange => pane.scene.colors.range = Range::Auto,
            Action::FreezeRange => freeze(pane, stage),
            Action::NextMap => next_map(pane),
            Action::ReverseMap => reverse_map(pane, stage),
            Action::Quantity => {
                stage.controls.quantities.open();
                stage.controls.wants_quantity = true;
                self.session.panels = true;
            }
            Action::Overlays => stage.controls.toggle_overlays(&mut pane.scene.overlays),
            Action::Isolines => toggle(&mut pane.scene.overlays.isolines, Levels::Auto),
            Action::Deform => toggle(&mut pane.scene.deformed, Factor::Auto),
            Action::Swing => {
                let now = ctx.input(|input| input.time);
                stage.controls.swing = stage.controls.swing.is_none().then(|| Swing::new(now));
                pane.scene.deformed = pane.scene.deformed.or(Some(Factor::Auto));
            }
            Action::Compare => toggle_comparison(pane),
            Action::Save(what) => self.exporter = Some(Exporter::new(what, stage)),
            Action::CopyCommand => copy_command(ctx, pane, stage),
            Action::Probe => {
                if let Some(spot) = stage.spot() {
                    stage.pin(pane, spot);
                }
            }
            Action::CircleForK => {
                stage.circle_nearest_tip(pane);
                self.session.drawer = Some(Page::Plot);
            }
            Action::Draw(tool) => stage.reading.tool = Some(tool),
            Action::Extrema => pane.extrema = !pane.extrema,
            Action::Drawer(page) => {
                if page == Page::Plot {
                    stage.choose_curve(pane);
                }
                toggle(&mut self.session.drawer, page);
            }
            Action::Step(by) => {
                if let Some(opened) = &stage.opened {
                    player::go(pane, &opened.dataset, by.into());
                }
            }
            Action::Play => {
                if let Some(opened) = &stage.opened {
                    self.player.toggle(pane, &opened.dataset);
                }
            }
            Action::Split => self.split(ctx),
            Action::Undo => self.restore(ctx, true),
            Action::Redo => self.restore(ctx, false),
            Action::Panels => self.session.panels = !self.session.panels,
            Action::Theme => self.turn_theme(ctx),
            Action::Help => self.has_help = !self.has_help,
            Action::Palette => self.palette = Some(Palette::default()),
            #[cfg(feature = "solve")]
            other => self.act_on_files(ctx, other),
            #[cfg(not(feature = "solve"))]
            _ => {}
        }
    }

    /// One view, or two side by side.
    pub(crate) fn split(&mut self, ctx: &egui::Context) {
        if self.session.panes.len() == 2 {
            self.session.panes.truncate(1);
            self.stages.truncate(1);
            self.session.active = 0;
        } else {
            self.session.panes.push(self.session.panes[0].clone());
            let mut stage = Stage::new(ctx, self.backend);
            stage.opened.clone_from(&self.stages[0].opened);
            self.stages.push(stage);
        }
    }

    /// Goes a step back or forward in the settings; places stay where they are.
    fn restore(&mut self, ctx: &egui::Context, back: bool) {
        // a change that is not yet at rest is a step too
        self.settings.note(&self.session.settings());
        let state = if back { self.settings.back() } else { self.settings.forward() };
        let Some(mut state) = state.cloned() else { return };
        state.take_places(&self.session);
        if state.panes.len() != self.session.panes.len() {
            self.split(ctx);
        }
        self.rest = Rest::new(state.settings());
        self.session = state;
        self.show_theme(ctx);
    }

    fn turn_theme(&mut self, ctx: &egui::Context) {
        self.session.theme = match self.session.theme {
            Theme::Dark => Theme::Light,
            _ => Theme::Dark,
        };
        self.show_theme(ctx);
    }

    /// Gives the window the session's theme.
    pub(crate) fn show_theme(&self, ctx: &egui::Context) {
        ctx.set_theme(match self.session.theme {
            Theme::System => egui::ThemePreference::System,
            Theme::Light => egui::ThemePreference::Light,
            Theme::Dark => egui::ThemePreference::Dark,
        });
    }
}

/// Copies the command that draws what is seen.
fn copy_command(ctx: &egui::Context, pane: &Pane, stage: &Stage) {
    let (Some(frame), Some(view)) = (stage.frames.newest(), stage.view) else { return };
    let order = Order {
        field: Arc::clone(&frame.field),
        file: stage.opened.as_ref().and_then(|opened| opened.path.clone()),
        scene: pane.scene.clone(),
        view,
        size: view.pixels,
        kind: Kind::Picture,
    };
    if let Ok(command) = order.command(Path::new("picture.png")) {
        ctx.copy_text(command);
    }
}

fn toggle<T: PartialEq>(setting: &mut Option<T>, on: T) {
    *setting = if setting.as_ref() == Some(&on) { None } else { Some(on) };
}

/// Direct against resampled, on and off.
fn toggle_comparison(pane: &mut Pane) {
    pane.compare = match pane.compare {
        None => Some(Compare::default()),
        Some(_) => None,
    };
}

/// The next map, reversed if this one is.
fn next_map(pane: &mut Pane) {
    let colors = &mut pane.scene.colors;
    let name = colors.colormap.as_deref().unwrap_or(NAMES[0]);
    let (base, end) = name.strip_suffix("_r").map_or((name, ""), |base| (base, "_r"));
    let at = NAMES.iter().position(|known| *known == base).map_or(0, |at| at + 1);
    colors.colormap = Some(format!("{}{end}", NAMES[at % NAMES.len()]));
}

/// The map from its other end; that of the picture if none is chosen.
fn reverse_map(pane: &mut Pane, stage: &Stage) {
    let quantity = stage.frames.newest().and_then(|frame| frame.shown.quantity());
    let colors = &mut pane.scene.colors;
    let name = colors.colormap.as_deref().unwrap_or(Colors::default_map(quantity));
    let reversed = name.strip_suffix("_r").map_or_else(|| format!("{name}_r"), str::to_owned);
    colors.colormap = Some(reversed);
}

/// Keeps the range of the picture.
fn freeze(pane: &mut Pane, stage: &Stage) {
    if let Some(frame) = stage.frames.newest() {
        let norm = &frame.picture.normalization;
        pane.scene.colors.range = Range::Fixed(norm.min(), norm.max());
    }
}

/// The panes side by side.
fn plates(ui: &mut Ui, desk: &mut Desk<'_>) {
    let count = desk.session.panes.len();
    let before: Vec<_> = desk.session.panes.iter().map(|pane| pane.place).collect();
    ui.spacing_mut().item_spacing.x = 2.0;
    ui.columns(count, |columns| {
        for (number, ui) in columns.iter_mut().enumerate() {
            let rect = ui.max_rect();
            let is_pressed =
                ui.rect_contains_pointer(rect) && ui.input(|i| i.pointer.any_pressed());
            if is_pressed {
                desk.session.active = number;
            }
            ui.push_id(number, |ui| {
                #[cfg(feature = "solve")]
                if desk.stages[number].opened.is_none() {
                    panels::start::show(ui, desk);
                    return;
                }
                desk.stages[number].show(ui, &mut desk.session.panes[number]);
            });
            if count > 1 && desk.session.active == number {
                let stroke = ui.visuals().selection.stroke;
                ui.painter().rect_stroke(rect, 0.0, stroke, egui::StrokeKind::Inside);
            }
        }
    });
    link(desk.session, &before);
}

/// Moves the other pane to where one has moved, if they are linked.
fn link(session: &mut Session, before: &[Option<Place>]) {
    if !session.linked || session.panes.len() < 2 {
        return;
    }
    let moved = session.panes.iter().zip(before).position(|(pane, before)| pane.place != *before);
    if let Some(number) = moved {
        let place = session.panes[number].place;
        session.panes.iter_mut().for_each(|pane| pane.place = place);
    }
}

impl eframe::App for Viewer {
    fn ui(&mut self, ui: &mut Ui, _: &mut eframe::Frame) {
        self.show(ui);
    }

    #[cfg(feature = "solve")]
    fn on_exit(&mut self) {
        self.leave();
    }
}

/// Pages of the drawer, in their order.
pub const PAGES: [Page; 5] = [Page::Plot, Page::Tips, Page::Series, Page::Solver, Page::Problem];
