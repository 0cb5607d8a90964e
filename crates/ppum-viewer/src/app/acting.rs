//! Runs actions.

use std::path::Path;

use egui::gui_zoom::{zoom_in, zoom_out};
use ppum_render::colormap::NAMES;
use ppum_render::range::RangeChoice;
use ppum_render::scale::Scale;
use ppum_scene::compare::Compare;
use ppum_scene::magnification::Magnification;
use ppum_scene::mirror::Mirror;
use ppum_scene::overlays::IsolineLevels;
use ppum_scene::profile::ProfileCurve;

use crate::actions::Action;
use crate::app::Viewer;
use crate::app::closing::CloseGuard;
use crate::controls::deformation_animation::DeformationAnimation;
use crate::export::{ExportChoice, Motion};
use crate::files::SavedFile;
use crate::files::dialog::Purpose;
use crate::panels::export::Exporter;
use crate::panels::palette::CommandPalette;
use crate::player;
use crate::session::{DrawerPage, Pane};
use crate::solving::editor_id;
use crate::viewport::ViewState;

impl Viewer {
    /// Runs an action.
    #[expect(clippy::too_many_lines, reason = "it has a line for each action")]
    pub fn act(&mut self, ctx: &egui::Context, action: Action) {
        // whatever opens next has the keyboard
        self.palette = None;
        let active = self.session.active;
        let (pane, viewport) = (&mut self.session.panes[active], &mut self.viewports[active]);
        let scene = &mut pane.scene;
        match action {
            Action::Fit => viewport.camera.fly_to(None),
            Action::Tip(number) => self.fly_to_tip(number),
            Action::NextTip => {
                let number = self.tip % viewport.tips(pane).max(1);
                self.fly_to_tip(number);
            }
            Action::ZoomIn => viewport.nudge(pane, [0.0; 2], ENLARGED),
            Action::ZoomOut => viewport.nudge(pane, [0.0; 2], 1.0 / ENLARGED),
            Action::Pan(right, up) => viewport.nudge(pane, [right, up].map(f64::from), 1.0),
            Action::Back => viewport.camera.go(pane.place, true),
            Action::Forward => viewport.camera.go(pane.place, false),
            Action::NextScale => scene.colors.scale = next_scale(scene.colors.scale),
            Action::AutomaticRange => scene.colors.range = RangeChoice::Auto,
            Action::FreezeRange => {
                if let Some(frame) = viewport.frames.newest() {
                    let [min, max] = frame.ends();
                    scene.colors.range = RangeChoice::Fixed(min, max);
                }
            }
            Action::NextMap => change_map(pane, viewport, next_map),
            Action::ReverseMap => change_map(pane, viewport, reversed),
            Action::Overlays => viewport.controls.toggle_overlays(&mut scene.overlays),
            Action::Isolines => toggle(&mut scene.overlays.isolines, IsolineLevels::Auto),
            Action::Deform | Action::Swing if viewport.is_rigid() && scene.deformed.is_none() => {
                viewport.tell("Nothing is deformed: a potential has no displacements");
            }
            Action::Deform => toggle(&mut scene.deformed, Magnification::Auto),
            Action::Swing => {
                let swing = DeformationAnimation::new(ctx.input(|input| input.time));
                toggle(&mut viewport.controls.swing, swing);
                scene.deformed.get_or_insert(Magnification::Auto);
            }
            Action::Mirror => toggle(&mut scene.mirror, Mirror::Auto),
            Action::Compare => {
                toggle(&mut pane.compare, Compare::default());
                viewport.controls.panel_to_open = pane.compare.map(|_| "Compare");
            }
            Action::Extrema => pane.extrema = !pane.extrema,
            Action::Quantity => {
                viewport.controls.quantities.open();
                viewport.controls.panel_to_open = Some("Quantity");
                self.session.panels = true;
            }
            Action::Save(what) => {
                self.exporter = Some(Exporter::new(what, viewport, self.player.speed))
            }
            Action::CopyCommand => self.copy_command(ctx),
            Action::Probe => match viewport.hovered() {
                Some(spot) => viewport.pin(pane, spot),
                None => viewport.tell("No probe is pinned: the pointer is not over the plate"),
            },
            Action::CircleForK => {
                let before = pane.curve;
                match viewport.circle_nearest_tip(pane) {
                    // also a circle of another radius
                    true if tip_of(before).is_some() && tip_of(before) == tip_of(pane.curve) => {
                        pane.curve = None;
                    }
                    true => self.session.drawer = Some(DrawerPage::Plot),
                    false => viewport.tell("No circle for K: this step has no crack tip"),
                }
            }
            Action::Draw(tool) => {
                let is_on = viewport.tools.tool == Some(tool);
                viewport.tools.tool = (!is_on).then_some(tool);
            }
            Action::Step(by) => {
                if let Some(opened) = &viewport.opened {
                    player::go(pane, &opened.dataset, by.into());
                }
            }
            Action::Play => {
                if let Some(opened) = &viewport.opened {
                    self.player.toggle(pane, &opened.dataset);
                }
            }
            Action::Drawer(page) => {
                let is_open = self.session.drawer == Some(page);
                if page == DrawerPage::Plot && !is_open {
                    viewport.choose_curve(pane);
                }
                self.session.drawer = (!is_open).then_some(page);
            }
            Action::Open | Action::OpenBeside => {
                let number = if action == Action::Open { active } else { 1 };
                self.files.ask(Purpose::Open(number), pane.file.as_deref());
            }
            Action::Import => self.files.ask(Purpose::Import(active), None),
            Action::NewProblem => self.begin_problem(),
            Action::Close => self.request_close(ctx, CloseGuard::Pane(active)),
            Action::SaveDataset => self.ask_dataset_of(active),
            Action::SaveDatasetOf(pane) => self.ask_dataset_of(pane),
            Action::ExportPage => self.ask_page(),
            // who writes the problem means the problem
            Action::SaveSession if ctx.memory(|m| m.has_focus(editor_id())) => self.save_problem(),
            Action::SaveSession => match self.files.session.clone() {
                Some(path) => self.files.save(path, SavedFile::Session, &self.session),
                None => self.ask(SavedFile::Session),
            },
            Action::SaveSessionAs => self.ask(SavedFile::Session),
            Action::Solve => {
                self.follow_dataset();
                self.request_close(ctx, CloseGuard::Solve(None));
            }
            Action::Example(number) => self.request_close(ctx, CloseGuard::Solve(Some(number))),
            Action::CancelSolving => self.solving.cancel(),
            Action::SaveProblem => self.save_problem(),
            Action::SaveProblemAs => {
                if let Some(draft) = self.session.draft.clone() {
                    self.ask(SavedFile::Problem(draft));
                }
            }
            Action::CloseProblem => {
                self.shelve();
                self.session.drawer = None;
            }
            Action::TakeText(number) => self.take_text(number),
            Action::DiscardText(number) => {
                if let Some(draft) = self.files.texts().get(number).cloned() {
                    self.request_close(ctx, CloseGuard::Text(draft));
                }
            }
            Action::ShowText => self.show_text_of(active),
            Action::Split => self.split(ctx),
            Action::Link => self.link(),
            Action::Minus => self.minus(ctx),
            Action::Undo => self.restore(ctx, true),
            Action::Redo => self.restore(ctx, false),
            Action::Panels => self.session.panels = !self.session.panels,
            Action::Theme => self.turn_theme(ctx),
            Action::Interface(1..) => zoom_in(ctx),
            Action::Interface(0) => ctx.set_zoom_factor(1.0),
            Action::Interface(_) => zoom_out(ctx),
            Action::Help => self.has_help = !self.has_help,
            Action::Palette => self.palette = Some(CommandPalette::default()),
            Action::Quit => ctx.send_viewport_cmd(egui::ViewportCommand::Close),
        }
    }

    /// Flies to a tip, if the step has it.
    fn fly_to_tip(&mut self, number: usize) {
        let active = self.session.active;
        let (pane, viewport) = (&self.session.panes[active], &mut self.viewports[active]);
        if number < viewport.tips(pane) {
            viewport.fly_to_tip(pane, number);
            self.tip = number + 1;
        }
    }

    /// Copies the command that draws what is seen, or shows why there is none.
    fn copy_command(&mut self, ctx: &egui::Context) {
        let active = self.session.active;
        let (pane, viewport) = (&self.session.panes[active], &mut self.viewports[active]);
        let kind = (ExportChoice::Image, Motion::default());
        let Some(order) = viewport.export(pane, kind, None) else { return };
        match order.command(Path::new("picture.png")) {
            Ok(command) => {
                ctx.copy_text(command);
                viewport.tell("Copied: the command that draws this");
            }
            Err(_) => {
                let exporter = Exporter::new(ExportChoice::Image, viewport, self.player.speed);
                self.exporter = Some(exporter);
            }
        }
    }
}

/// How much larger a key makes things.
const ENLARGED: f64 = 1.5;

/// The tip that a curve is a circle around.
fn tip_of(curve: Option<ProfileCurve>) -> Option<usize> {
    match curve {
        Some(ProfileCurve::Around { tip, .. }) => Some(tip),
        _ => None,
    }
}

/// Takes a setting away, or gives it a value if it has none.
fn toggle<T>(setting: &mut Option<T>, on: T) {
    *setting = if setting.is_some() { None } else { Some(on) };
}

fn next_scale(scale: Scale) -> Scale {
    match scale {
        Scale::Linear => Scale::Log,
        Scale::Log => Scale::SymLog,
        Scale::SymLog => Scale::Linear,
    }
}

/// Chooses another map instead of the chosen one, or of that of the image.
fn change_map(pane: &mut Pane, viewport: &ViewState, other: fn(&str) -> String) {
    let default = || viewport.frames.newest().map_or(NAMES[0], |frame| frame.default_map());
    let map = &mut pane.scene.colors.colormap;
    *map = Some(other(map.as_deref().unwrap_or_else(default)));
}

/// The next map, reversed if this one is.
fn next_map(name: &str) -> String {
    let (base, end) = name.strip_suffix("_r").map_or((name, ""), |base| (base, "_r"));
    let at = NAMES.iter().position(|known| *known == base).map_or(0, |at| at + 1);
    format!("{}{end}", NAMES[at % NAMES.len()])
}

/// The map from its other end.
fn reversed(name: &str) -> String {
    name.strip_suffix("_r").map_or_else(|| format!("{name}_r"), str::to_owned)
}
