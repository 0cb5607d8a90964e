//! The window as a whole: open datasets, panels around the views, actions.

mod acting;
pub mod closing;
mod problems;
mod replaced;
mod work;

use std::path::PathBuf;
use std::sync::Arc;

use egui::{CentralPanel, Panel, Rect, Ui, UiBuilder, vec2};
use ppum::dataset::Dataset;

use crate::actions::{self, Action};
use crate::fonts::fonts;
use crate::frames::{Backend, SubtractedImage};
use crate::panel_context::PanelContext;
use crate::panels::export::Exporter;
use crate::panels::import::ImportDialog;
use crate::panels::palette::CommandPalette;
use crate::panels::{self, help, top};
use crate::player::Player;
use crate::session::{DrawerPage, Session, VisibleRegion, WindowTheme};
use crate::undo::{RestDetector, Undo};
use crate::viewport::difference::PairRole;
use crate::viewport::{OpenDataset, ViewState};
use crate::widgets::make_readable;

/// The window.
pub struct Viewer {
    /// The session.
    pub session: Session,
    /// The views of the session.
    pub viewports: Vec<ViewState>,
    rest: RestDetector<Session>,
    pub(crate) settings: Undo<Session>,
    /// The player of the steps of a series.
    pub player: Player,
    /// Files that are open, read and written.
    pub files: crate::files::WindowFiles,
    /// The problem that is written and solved.
    pub solving: crate::solving::SolverState,
    /// The state of closing a solution that is not saved.
    closing: closing::ClosingQuestion,
    /// The dataset that is to make place for the solution that is computed.
    replaced: Option<Arc<Dataset>>,
    /// The solution that another one has replaced, for undo.
    replaced_solution: Option<replaced::ReplacedSolution>,
    /// Files that were read and are not shown yet.
    waiting: std::collections::VecDeque<crate::files::read::ReadFile>,
    pub(crate) palette: Option<CommandPalette>,
    pub(crate) exporter: Option<Exporter>,
    /// The drawing that is being imported.
    pub importing: Option<ImportDialog>,
    pub(crate) has_help: bool,
    /// The number of the tip that is flown to next.
    pub(crate) tip: usize,
    pub(crate) backend: Backend,
    /// The title of the window.
    title: String,
}

impl Viewer {
    /// A window that shows a session.
    #[must_use]
    pub fn new(ctx: &egui::Context, session: Session) -> Self {
        Self::with_backend(ctx, session, Backend::default())
    }

    /// Makes the window with a given backend.
    #[must_use]
    pub fn with_backend(ctx: &egui::Context, mut session: Session, backend: Backend) -> Self {
        ctx.set_fonts(fonts());
        // a cursor that blinks would have the window drawn for ever
        ctx.all_styles_mut(|style| style.visuals.text_cursor.blink = false);
        ctx.add_plugin(actions::KeyOrder::default());
        ctx.add_plugin(actions::Tab::default());
        for theme in [egui::Theme::Dark, egui::Theme::Light] {
            ctx.style_mut_of(theme, |style| make_readable(&mut style.visuals));
        }
        session.repair();
        let viewports = session.panes.iter().map(|_| ViewState::new(ctx, backend)).collect();
        Self {
            settings: Undo::new(session.settings()),
            rest: RestDetector::new(session.settings()),
            session,
            viewports,
            player: Player::default(),
            files: crate::files::WindowFiles::new(ctx, None),
            solving: crate::solving::SolverState::new(ctx),
            closing: closing::ClosingQuestion::default(),
            replaced: None,
            replaced_solution: None,
            waiting: std::collections::VecDeque::new(),
            palette: None,
            exporter: None,
            importing: None,
            has_help: false,
            tip: 0,
            backend,
            title: String::new(),
        }
    }

    /// Shows a dataset in the active pane.
    pub fn open(&mut self, path: Option<PathBuf>, dataset: Arc<Dataset>) {
        let active = self.session.active;
        self.session.panes[active].file.clone_from(&path);
        self.viewports[active].opened = Some(OpenDataset::new(path, dataset));
    }

    /// Shows the window once.
    pub fn show(&mut self, ui: &mut Ui) {
        self.work(ui);
        if self.session.drawer == Some(DrawerPage::Problem) {
            self.follow_dataset();
        }
        for (viewport, pane) in self.viewports.iter_mut().zip(&mut self.session.panes) {
            viewport.poll(ui.ctx(), pane);
        }
        let mut actions = actions::pressed(ui.ctx());
        help::take(ui.ctx(), &mut self.has_help, &mut actions);
        let active = self.session.active;
        self.player.advance(ui.ctx(), &mut self.session.panes[active], &self.viewports[active]);
        let mut context = self.context(&mut actions);
        Panel::top("top").show(ui, |ui| top::show(ui, &mut context));
        panels::drawer::show(ui, &mut context);
        let has_plate = context.viewports.iter().any(|viewport| viewport.opened.is_some());
        let has_room = ui.available_width() > LEAST;
        if context.session.panels && has_plate && has_room {
            let side = Panel::right("side").default_size(300.0);
            side.show(ui, |ui| panels::side(ui, &mut context));
        }
        CentralPanel::default().frame(egui::Frame::NONE).show(ui, |ui| plates(ui, &mut context));
        panels::files::notes(ui, &mut context);
        help::show(ui, &mut self.has_help);
        if let Some(mut palette) = self.palette.take() {
            let context = self.context(&mut actions);
            let (is_done, chosen) = palette.show(ui, |action| context.is_possible(action));
            actions.extend(chosen);
            self.palette = (!is_done).then_some(palette);
        }
        let active = self.session.active;
        if let Some(exporter) = &mut self.exporter
            && !exporter.show(ui, &self.session.panes[active], &mut self.viewports[active])
        {
            self.exporter = None;
        }
        self.ask_before_closing(ui);
        focus_ring(ui.ctx());
        self.copy(ui.ctx());
        for action in actions {
            self.act(ui.ctx(), action);
        }
        self.name_window(ui.ctx());
        self.note(ui);
    }

    fn context<'a>(&'a mut self, actions: &'a mut Vec<Action>) -> PanelContext<'a> {
        PanelContext {
            session: &mut self.session,
            viewports: &mut self.viewports,
            player: &mut self.player,
            files: &mut self.files,
            solving: &mut self.solving,
            actions,
        }
    }

    /// Names the window by the files that it shows, so that two of them can be told apart.
    fn name_window(&mut self, ctx: &egui::Context) {
        let paths =
            self.viewports.iter().filter_map(|viewport| viewport.opened.as_ref()?.path.as_deref());
        let mut names: Vec<_> = paths.map(crate::files::name).collect();
        names.dedup();
        names.push("ppum".into());
        let title = names.join(" – ");
        if title != self.title {
            self.title.clone_from(&title);
            ctx.send_viewport_cmd(egui::ViewportCommand::Title(title));
        }
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
            let viewport = &mut self.viewports[self.session.active];
            if let Some(text) = viewport.copied() {
                ctx.copy_text(text);
                viewport.tell("Copied: what is read here, with all digits");
            }
        }
    }

    /// One view, or two side by side.
    pub(crate) fn split(&mut self, ctx: &egui::Context) {
        if self.session.panes.len() == 2 {
            self.request_close(ctx, closing::CloseGuard::Pane(1));
        } else {
            self.session.panes.push(self.session.panes[0].clone());
            let mut viewport = ViewState::new(ctx, self.backend);
            viewport.opened.clone_from(&self.viewports[0].opened);
            self.viewports.push(viewport);
        }
    }

    /// Takes one of two views away.
    pub(crate) fn merge(&mut self, pane: usize) {
        self.session.subtract(false);
        self.session.panes.remove(pane);
        self.viewports.remove(pane);
        self.session.active = 0;
    }

    /// Links two views, the other one at the place of the active one, or lets each have its own.
    pub(crate) fn link(&mut self) {
        self.session.linked = !self.session.linked;
        if self.session.linked {
            let place = self.session.pane().place;
            self.session.panes.iter_mut().for_each(|pane| pane.place = place);
        }
    }

    /// The difference of two views, of which the second one is made if there is none, or its
    /// own values.
    pub(crate) fn minus(&mut self, ctx: &egui::Context) {
        if self.session.panes.len() < 2 {
            self.split(ctx);
        }
        self.session.subtract(!self.session.minus.is_shown);
        if self.session.minus.is_shown {
            // its colours are chosen next
            self.session.active = 1;
        }
    }

    /// Goes a step back or forward in the settings and in the last two solutions, or asks first if
    /// a view with a solution is to go.
    pub(crate) fn restore(&mut self, ctx: &egui::Context, back: bool) {
        // a change that is not yet at rest is a step too
        self.settings.note(&self.session.settings());
        if self.exchange_solutions(back) {
            return;
        }
        if self.takes_view(back) {
            return self.request_close(ctx, closing::CloseGuard::View(back));
        }
        self.take_settings(ctx, back);
    }

    /// True if a step back or forward in the settings takes the second view away.
    pub(crate) fn takes_view(&self, back: bool) -> bool {
        let next = self.settings.next(back);
        next.is_some_and(|state| state.panes.len() < self.session.panes.len())
    }

    /// Goes a step back or forward in the settings; places stay where they are.
    pub(crate) fn take_settings(&mut self, ctx: &egui::Context, back: bool) {
        let Some(mut state) = self.settings.go(back).cloned() else { return };
        state.take_places(&self.session);
        match state.panes.len() {
            count if count < self.session.panes.len() => self.merge(1),
            count if count > self.session.panes.len() => self.split(ctx),
            _ => {}
        }
        self.rest = RestDetector::new(state.settings());
        self.session = state;
        self.show_theme(ctx);
    }

    pub(crate) fn turn_theme(&mut self, ctx: &egui::Context) {
        self.session.theme = match ctx.theme() {
            egui::Theme::Dark => WindowTheme::Light,
            egui::Theme::Light => WindowTheme::Dark,
        };
        self.show_theme(ctx);
    }

    /// Gives the window the session's theme.
    pub(crate) fn show_theme(&self, ctx: &egui::Context) {
        ctx.set_theme(match self.session.theme {
            WindowTheme::System => egui::ThemePreference::System,
            WindowTheme::Light => egui::ThemePreference::Light,
            WindowTheme::Dark => egui::ThemePreference::Dark,
        });
    }
}

/// Frames what has the focus of the keyboard.
fn focus_ring(ctx: &egui::Context) {
    // who reads a response in the frame of a click takes the focus from what the click has opened
    if ctx.input(|input| input.pointer.any_click()) {
        return ctx.request_repaint();
    }
    let Some(focused) = ctx.memory(egui::Memory::focused) else { return };
    let Some(response) = ctx.read_response(focused) else { return };
    let layer = egui::LayerId::new(egui::Order::Tooltip, egui::Id::unique("focus"));
    let stroke = egui::Stroke::new(2.0, ctx.global_style().visuals.selection.stroke.color);
    let seen = response.rect.intersect(response.interact_rect);
    let rect = seen.expand(1.0).intersect(ctx.content_rect().shrink(1.0));
    ctx.layer_painter(layer).rect_stroke(rect, 3.0, stroke, egui::StrokeKind::Outside);
}

/// Windows that are narrower have no room for panels \[points\].
const LEAST: f32 = 240.0;

/// The panes side by side.
fn plates(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let count = context.session.panes.len();
    pair(context);
    caption(context);
    let before: Vec<_> = context.session.panes.iter().map(|pane| pane.place).collect();
    let room = ui.available_rect_before_wrap();
    for number in 0..count {
        let rect = part(room, number, count);
        let is_pressed = ui.rect_contains_pointer(rect) && ui.input(|i| i.pointer.any_pressed());
        if is_pressed {
            context.session.active = number;
        }
        let ui = &mut ui.new_child(UiBuilder::new().max_rect(rect).id_salt(number));
        show_pane(ui, context, number);
        if count > 1 && context.session.active == number {
            let stroke = ui.visuals().selection.stroke;
            ui.painter().rect_stroke(rect, 0.0, stroke, egui::StrokeKind::Inside);
        }
    }
    link(context.session, &before);
}

/// Tells the views whether one is subtracted from the other.
fn pair(context: &mut PanelContext<'_>) {
    let is_shown = context.session.minus.is_shown;
    let pane = &context.session.panes[0];
    match &mut context.viewports[..] {
        [left, right] if is_shown => {
            right.pair = PairRole::Right(left.opened.as_ref().map(|opened| SubtractedImage {
                dataset: (&opened.dataset).into(),
                subject: pane.scene.subject.clone(),
                quantity: pane.scene.quantity.clone(),
            }));
            left.pair = PairRole::Left;
        }
        viewports => viewports.iter_mut().for_each(|viewport| viewport.pair = PairRole::Alone),
    }
}

/// Names what each of two views shows: the file, of a series the step, and the quantity; and says
/// if both move together.
fn caption(context: &mut PanelContext<'_>) {
    let are_two = context.session.panes.len() > 1;
    for (pane, viewport) in context.session.panes.iter().zip(context.viewports.iter_mut()) {
        let linked = if context.session.linked { " · linked" } else { "" };
        let named = viewport.named(pane).filter(|_| are_two);
        viewport.caption = named.map(|name| name + linked);
    }
}

fn show_pane(ui: &mut Ui, context: &mut PanelContext<'_>, number: usize) {
    if context.viewports[number].opened.is_none() {
        panels::start::show(ui, context);
        return;
    }
    context.viewports[number].show(ui, &mut context.session.panes[number]);
    if std::mem::take(&mut context.viewports[number].tools.wants_plot) {
        context.session.drawer = Some(DrawerPage::Plot);
    }
}

/// One of some equal parts of a room, side by side; without width where the room has none.
fn part(room: Rect, number: usize, count: usize) -> Rect {
    let width = (room.width() - GAP * (count - 1) as f32) / count as f32;
    let size = vec2(width, room.height()).max(vec2(0.0, 0.0));
    Rect::from_min_size(room.min + vec2((size.x + GAP) * number as f32, 0.0), size)
}

/// Between two views \[points\].
const GAP: f32 = 2.0;

/// Moves the other pane to where one has moved, if they are linked.
fn link(session: &mut Session, before: &[Option<VisibleRegion>]) {
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

    /// The background around the views. Nothing is drawn there: a software driver takes longer for
    /// that than for all the rest.
    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        crate::widgets::ground(visuals).to_normalized_gamma_f32()
    }

    fn on_exit(&mut self) {
        self.leave();
    }
}
