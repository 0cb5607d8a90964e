//! Runs actions.

use std::path::Path;
use std::sync::Arc;

use ppum_render::colormap::NAMES;
use ppum_render::range::RangeChoice;
use ppum_render::scale::Scale;
use ppum_scene::colors::ColorOptions;
use ppum_scene::compare::Compare;
use ppum_scene::deformed::Magnification;
use ppum_scene::mirror::Mirror;
use ppum_scene::overlays::IsolineLevels;

use crate::actions::Action;
use crate::app::Viewer;
use crate::controls::deformation_animation::DeformationAnimation;
use crate::export::{ExportChoice, ExportKind, ImageExport, PageSize};
use crate::panels::export::Exporter;
use crate::panels::palette::CommandPalette;
use crate::player;
use crate::reading::tool::Tool;
use crate::session::{DrawerPage, Pane};
use crate::stage::ViewPane;

impl Viewer {
    /// Does what was asked for.
    pub fn act(&mut self, ctx: &egui::Context, action: Action) {
        // whatever opens next has the keyboard
        self.palette = None;
        let is_done = self.travel(action)
            || self.choose(ctx, action)
            || self.read(ctx, action)
            || self.arrange(ctx, action);
        if !is_done {
            self.act_on_files(ctx, action);
        }
    }

    /// True if an action would do something to what is open.
    pub(crate) fn is_possible(&self, action: Action) -> bool {
        let (pane, stage) = (self.session.pane(), &self.stages[self.session.active]);
        let opened = stage.opened.as_ref();
        let (tips, has_text) = (stage.tips(pane), self.session.draft.is_some());
        match action {
            Action::Tip(number) => number < tips,
            Action::NextTip | Action::CircleForK | Action::Draw(Tool::Ray) => tips > 0,
            Action::Step(_)
            | Action::Play
            | Action::Save(ExportChoice::Steps)
            | Action::Drawer(DrawerPage::Series) => {
                opened.is_some_and(|o| o.dataset.steps.len() > 1)
            }
            Action::Deform | Action::Swing | Action::Save(ExportChoice::Deformation) => {
                opened.is_some() && !stage.is_rigid()
            }
            Action::Solve | Action::SaveProblem | Action::SaveProblemAs | Action::CloseProblem => {
                has_text
            }
            Action::CancelSolving => self.solving.running().is_some(),
            Action::Open
            | Action::Example(_)
            | Action::SaveSession
            | Action::SaveSessionAs
            | Action::Drawer(_)
            | Action::Undo
            | Action::Redo
            | Action::Panels
            | Action::Theme
            | Action::Interface(_)
            | Action::Help
            | Action::Palette
            | Action::Quit => true,
            _ => opened.is_some(),
        }
    }

    fn active(&mut self) -> (&mut Pane, &mut ViewPane) {
        let active = self.session.active;
        (&mut self.session.panes[active], &mut self.stages[active])
    }

    /// Moves; false if the action is none that does.
    fn travel(&mut self, action: Action) -> bool {
        let next = self.tip;
        let (pane, stage) = self.active();
        match action {
            Action::Fit => stage.fly_to(pane, None),
            Action::Tip(number) => {
                stage.fly_to_tip(pane, number);
                self.tip = number + 1;
            }
            Action::NextTip => {
                let count = stage.tips(pane);
                if count > 0 {
                    stage.fly_to_tip(pane, next % count);
                    self.tip = next % count + 1;
                }
            }
            Action::ZoomIn => stage.nudge(pane, 0.0, 0.0, ENLARGED),
            Action::ZoomOut => stage.nudge(pane, 0.0, 0.0, 1.0 / ENLARGED),
            Action::Pan(right, up) => stage.nudge(pane, right.into(), up.into(), 1.0),
            Action::Back => stage.go_back(pane),
            Action::Forward => stage.go_forward(pane),
            _ => return false,
        }
        true
    }

    /// Changes what is shown, and its colours; false if the action is none that does.
    fn choose(&mut self, ctx: &egui::Context, action: Action) -> bool {
        let (pane, stage) = self.active();
        let colors = &mut pane.scene.colors;
        match action {
            Action::NextScale => colors.scale = next_scale(colors.scale),
            Action::AutomaticRange => colors.range = RangeChoice::Auto,
            Action::FreezeRange => freeze(pane, stage),
            Action::NextMap => next_map(colors, stage),
            Action::ReverseMap => reverse_map(colors, stage),
            Action::Overlays => stage.controls.toggle_overlays(&mut pane.scene.overlays),
            Action::Isolines => toggle(&mut pane.scene.overlays.isolines, IsolineLevels::Auto),
            Action::Deform | Action::Swing if stage.is_rigid() && pane.scene.deformed.is_none() => {
                stage.tell("Nothing is deformed: a potential has no displacements");
            }
            Action::Deform => toggle(&mut pane.scene.deformed, Magnification::Auto),
            Action::Swing => {
                let now = ctx.input(|input| input.time);
                stage.controls.swing =
                    stage.controls.swing.is_none().then(|| DeformationAnimation::new(now));
                pane.scene.deformed = pane.scene.deformed.or(Some(Magnification::Auto));
            }
            Action::Mirror => toggle(&mut pane.scene.mirror, Mirror::Auto),
            Action::Compare => {
                toggle(&mut pane.compare, Compare::default());
                stage.controls.wants = pane.compare.map(|_| "Compare");
            }
            Action::Extrema => pane.extrema = !pane.extrema,
            Action::Quantity => {
                stage.controls.quantities.open();
                stage.controls.wants = Some("Quantity");
                self.session.panels = true;
            }
            _ => return false,
        }
        true
    }

    /// Reads values, goes through the steps, takes images out; false if the action is none that
    /// does.
    fn read(&mut self, ctx: &egui::Context, action: Action) -> bool {
        let active = self.session.active;
        let (pane, stage) = (&mut self.session.panes[active], &mut self.stages[active]);
        match action {
            Action::Save(what) => {
                self.exporter = Some(Exporter::new(what, stage).as_fast_as(self.player.speed));
            }
            Action::CopyCommand => {
                match copy_command(ctx, pane, stage) {
                    Ok(()) => stage.tell("Copied: the command that draws this"),
                    // it says why there is none
                    Err(_) => self.exporter = Some(Exporter::new(ExportChoice::Picture, stage)),
                }
            }
            Action::Probe => match stage.hovered() {
                Some(spot) => stage.pin(pane, spot),
                None => stage.tell("No probe is pinned: the pointer is not over the plate"),
            },
            Action::CircleForK => {
                let before = pane.curve;
                match stage.circle_nearest_tip(pane) {
                    true if pane.curve == before => pane.curve = None,
                    true => self.session.drawer = Some(DrawerPage::Plot),
                    false => stage.tell("No circle for K: this step has no crack tip"),
                }
            }
            Action::Draw(tool) => {
                let tool = Some(tool).filter(|tool| stage.reading.tool != Some(*tool));
                stage.reading.tool = tool;
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
            _ => return false,
        }
        true
    }

    /// Changes the window itself; false if the action is none that does.
    fn arrange(&mut self, ctx: &egui::Context, action: Action) -> bool {
        match action {
            Action::Drawer(page) if self.session.drawer == Some(page) => self.session.drawer = None,
            Action::Drawer(page) => {
                let (pane, stage) = self.active();
                if page == DrawerPage::Plot {
                    stage.choose_curve(pane);
                }
                self.session.drawer = Some(page);
            }
            Action::Split => self.split(ctx),
            Action::Minus => self.minus(ctx),
            Action::Undo => self.restore(ctx, true),
            Action::Redo => self.restore(ctx, false),
            Action::Panels => self.session.panels = !self.session.panels,
            Action::Theme => self.turn_theme(ctx),
            Action::Interface(by) => match by {
                1.. => egui::gui_zoom::zoom_in(ctx),
                0 => ctx.set_zoom_factor(1.0),
                _ => egui::gui_zoom::zoom_out(ctx),
            },
            Action::Help => self.has_help = !self.has_help,
            Action::Palette => self.palette = Some(CommandPalette::default()),
            Action::Quit => ctx.send_viewport_cmd(egui::ViewportCommand::Close),
            _ => return false,
        }
        true
    }
}

/// How much larger a key makes things.
const ENLARGED: f64 = 1.5;

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

/// Copies the command that draws what is seen.
fn copy_command(ctx: &egui::Context, pane: &Pane, stage: &ViewPane) -> Result<(), String> {
    let (Some(frame), Some(view)) = (stage.frame(), stage.view) else { return Ok(()) };
    let order = ImageExport {
        field: Arc::clone(&frame.field),
        file: stage.opened.as_ref().and_then(|opened| opened.path.clone()),
        left: frame.left(),
        scene: pane.scene.drawn(),
        view,
        page: PageSize::pixels(view.pixels),
        kind: ExportKind::Picture,
    };
    ctx.copy_text(order.command(Path::new("picture.png"))?);
    Ok(())
}

/// The next map, reversed if this one is.
fn next_map(colors: &mut ColorOptions, stage: &ViewPane) {
    let name = colors.colormap.as_deref().unwrap_or(default_map(stage));
    let (base, end) = name.strip_suffix("_r").map_or((name, ""), |base| (base, "_r"));
    let at = NAMES.iter().position(|known| *known == base).map_or(0, |at| at + 1);
    colors.colormap = Some(format!("{}{end}", NAMES[at % NAMES.len()]));
}

fn default_map(stage: &ViewPane) -> &'static str {
    stage.frames.newest().map_or(NAMES[0], |frame| frame.default_map())
}

/// The map from its other end; that of the image if none is chosen.
fn reverse_map(colors: &mut ColorOptions, stage: &ViewPane) {
    let name = colors.colormap.as_deref().unwrap_or(default_map(stage));
    let reversed = name.strip_suffix("_r").map_or_else(|| format!("{name}_r"), str::to_owned);
    colors.colormap = Some(reversed);
}

/// Keeps the range of the image.
fn freeze(pane: &mut Pane, stage: &ViewPane) {
    if let Some(frame) = stage.frames.newest() {
        let norm = &frame.picture.normalization;
        pane.scene.colors.range = RangeChoice::Fixed(norm.min(), norm.max());
    }
}
