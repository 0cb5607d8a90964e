//! Closing a dataset or the window, or opening something in its place: not without a question where
//! something would be lost that no file has.

use std::ops::Range;
use std::sync::Arc;

use egui::{Context, Id, Key, Modal, Modifiers, Ui, ViewportCommand};
use ppum::dataset::Dataset;

use crate::app::Viewer;
use crate::files::SavedFile;
use crate::files::read::{FileContent, ReadFile, Why};
use crate::same_arc::SameArc;
use crate::session::ProblemDraft;
use crate::viewport::OpenDataset;

/// The object that is closed.
#[derive(Clone, Debug)]
pub enum CloseGuard {
    /// The dataset of a pane.
    Pane(usize),
    /// The window.
    Window,
    /// The view where the first waiting file is to be shown.
    Arrival,
    /// The second view, by a step back (or forward) in the settings, if that takes it.
    View(bool),
    /// The dataset of the active view, for the solution of the problem that is written, or of an
    /// example, by its number.
    Solve(Option<usize>),
    /// A changed text that was put aside.
    Text(ProblemDraft),
}

/// How far one has come with it.
#[derive(Debug, Default)]
pub(super) enum ClosingQuestion {
    /// Nothing is to be closed.
    #[default]
    None,
    /// The question about everything that would be lost is shown.
    Asked(CloseGuard, Vec<Loss>),
    /// A part of it is being saved; what was to be closed is closed then.
    Saving(CloseGuard, Vec<Loss>),
    /// The window closes, whatever is lost.
    LetGo,
}

/// Something that would be lost.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Loss {
    /// The solution of a view, and what it is called.
    Solution(SameArc<Dataset>, String),
    /// The work of a solver on a problem of this name.
    Work(String),
    /// The changes of a text.
    Text(ProblemDraft),
}

impl Loss {
    fn sentence(&self) -> String {
        match self {
            Self::Solution(_, name) => format!("The solution {name} is not saved."),
            Self::Work(name) => format!("{name} is being solved."),
            Self::Text(draft) => format!("The changes in {} are not saved.", draft.name()),
        }
    }
}

/// The answer to the question.
enum ClosingAnswer {
    Save,
    Close,
    Back,
}

/// Closes the window without a question: nobody would see it.
pub(crate) fn let_go(ctx: &Context) {
    ctx.data_mut(|data| data.insert_temp(is_let_go(), true));
    ctx.send_viewport_cmd(ViewportCommand::Close);
}

fn is_let_go() -> Id {
    Id::unique("let go")
}

impl Viewer {
    /// Closes something, or asks first.
    pub(crate) fn request_close(&mut self, ctx: &Context, guard: CloseGuard) {
        let losses = self.losses(&guard);
        if losses.is_empty() {
            return self.close_at_last(ctx, guard);
        }
        self.closing = ClosingQuestion::Asked(guard, losses);
    }

    fn close_at_last(&mut self, ctx: &Context, guard: CloseGuard) {
        self.closing = ClosingQuestion::None;
        match guard {
            CloseGuard::Pane(pane) if pane < self.session.panes.len() => {
                self.solving.leave_pane(pane);
                self.close(pane);
            }
            CloseGuard::Pane(_) => {}
            CloseGuard::View(back) => {
                if self.takes_view(back) {
                    self.solving.leave_pane(1);
                }
                self.take_settings(ctx, back);
            }
            CloseGuard::Solve(example) => {
                let active = self.session.active;
                let opened =
                    self.viewports[active].opened.as_ref().filter(|_| !self.is_twice(active));
                self.replaced = opened.map(|opened| Arc::clone(&opened.dataset));
                self.solve(example);
            }
            CloseGuard::Text(draft) => self.files.release(&draft),
            CloseGuard::Window => {
                self.closing = ClosingQuestion::LetGo;
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
            CloseGuard::Arrival => {
                if let Some(arrived) = self.waiting.pop_front() {
                    self.arrive(ctx, arrived);
                }
            }
        }
    }

    /// Shows what was read, one after the other, or asks first.
    pub(super) fn let_in(&mut self, ctx: &Context) {
        self.waiting.extend(self.files.arrived());
        while !self.is_asking() && !self.waiting.is_empty() {
            self.request_close(ctx, CloseGuard::Arrival);
        }
    }

    /// All that would be lost.
    fn losses(&self, guard: &CloseGuard) -> Vec<Loss> {
        let (panes, is_work_lost) = self.scope(guard);
        let mut losses = self.lost_solutions(panes);
        let forgets = matches!(guard, CloseGuard::Window | CloseGuard::Solve(_));
        let undone = self.undone_solution().filter(|opened| forgets && opened.is_unsaved());
        losses.extend(undone.map(|opened| {
            Loss::Solution((&opened.dataset).into(), format!("{}, undone,", opened.name()))
        }));
        let running = self.solving.running().filter(|_| is_work_lost);
        losses.extend(running.map(|running| Loss::Work(running.problem.name())));
        losses.extend(self.lost_texts(guard));
        losses
    }

    /// The views that go, and whether the work of the solver for one of them, or for nobody, goes
    /// with them.
    fn scope(&self, guard: &CloseGuard) -> (Range<usize>, bool) {
        let active = self.session.active;
        let is_for = |pane: usize| self.solving.running().is_some_and(|one| one.pane == pane);
        match *guard {
            CloseGuard::Window => (0..self.viewports.len(), true),
            CloseGuard::Pane(pane) => (pane..pane + 1, is_for(pane)),
            CloseGuard::View(back) if self.takes_view(back) => (1..2, is_for(1)),
            // who changes a problem and solves it again, many times, wants the new solution
            CloseGuard::Solve(None) if self.is_solved_again(active) => (0..0, true),
            CloseGuard::Solve(_) => (active..active + 1, true),
            CloseGuard::Arrival => match self.waiting.front() {
                Some(ReadFile { why: Why::Opened, content: Ok(content), pane, .. }) => {
                    // the view that it was for may have been closed since, as in `place_of`
                    let pane = (*pane).min(self.viewports.len() - 1);
                    let panes = match content {
                        FileContent::Dataset(_) => pane..pane + 1,
                        FileContent::Session(_) => 0..self.viewports.len(),
                        FileContent::Problem(_) | FileContent::Drawing(_) => 0..0,
                    };
                    (panes, false)
                }
                _ => (0..0, false),
            },
            CloseGuard::View(_) | CloseGuard::Text(_) => (0..0, false),
        }
    }

    /// Changed texts outlast the window, unless it can keep nothing.
    fn lost_texts(&self, guard: &CloseGuard) -> Vec<Loss> {
        let texts = match guard {
            CloseGuard::Text(draft) => self.files.texts().iter().filter(|t| *t == draft).collect(),
            CloseGuard::Window if !self.files.can_keep() => self.changed_texts(),
            _ => Vec::new(),
        };
        texts.into_iter().cloned().map(Loss::Text).collect()
    }

    /// The texts that are not as their files have them: that which is written, and those that were
    /// put aside.
    fn changed_texts(&self) -> Vec<&ProblemDraft> {
        let draft = self.session.draft.iter().filter(|draft| draft.is_changed());
        draft.chain(self.files.texts()).collect()
    }

    /// True if something is asked, or the answer was that all may be lost.
    #[must_use]
    pub fn is_asking(&self) -> bool {
        !matches!(self.closing, ClosingQuestion::None)
    }

    /// Returns the dataset of a view.
    pub(super) fn opened(&self, pane: usize) -> Option<&OpenDataset> {
        self.viewports.get(pane)?.opened.as_ref()
    }

    /// True if a dataset of a view has no file and cannot be had again at once, as examples of one
    /// step can.
    #[must_use]
    pub fn is_unsaved(&self, pane: usize) -> bool {
        self.opened(pane).is_some_and(OpenDataset::is_unsaved)
    }

    /// True if the dataset of a view is to make place for the solution that is computed: that was
    /// asked for.
    #[must_use]
    pub fn is_given_up(&self, pane: usize) -> bool {
        let is_it = |replaced: &Arc<Dataset>| {
            self.opened(pane).is_some_and(|opened| Arc::ptr_eq(replaced, &opened.dataset))
        };
        self.replaced.as_ref().is_some_and(is_it)
    }

    /// The view for a solution: that for which it was computed, the other one if something would be
    /// lost there that was not given up, or was for more than the steps before a stop.
    pub(super) fn free_pane(&mut self, ctx: &Context, pane: usize, is_complete: bool) -> usize {
        let pane = pane.min(self.viewports.len() - 1);
        let is_given_up = self.is_given_up(pane);
        self.replaced = None;
        let is_free = |viewer: &Self, pane| !viewer.is_unsaved(pane) || viewer.is_twice(pane);
        if is_free(self, pane) || (is_given_up && is_complete) {
            return pane;
        }
        if self.viewports.len() == 1 {
            self.split(ctx);
        }
        if is_given_up && !is_free(self, 1 - pane) { pane } else { 1 - pane }
    }

    /// The solutions of views that would be lost.
    fn lost_solutions(&self, panes: Range<usize>) -> Vec<Loss> {
        // of one dataset in two views one may go
        let is_one = panes.len() == 1;
        let mut losses = Vec::new();
        for pane in panes.filter(|pane| !(is_one && self.is_twice(*pane))) {
            let Some(opened) = self.opened(pane).filter(|opened| opened.is_unsaved()) else {
                continue;
            };
            let name = format!("{}{}", opened.name(), self.side(pane));
            let loss = Loss::Solution((&opened.dataset).into(), name);
            if !losses.contains(&loss) {
                losses.push(loss);
            }
        }
        losses
    }

    /// True if the problem that is written is that whose solution a view shows.
    fn is_solved_again(&self, pane: usize) -> bool {
        // without a text that of the solution itself is solved
        let Some(draft) = &self.session.draft else { return true };
        let shown = self.opened(pane).and_then(OpenDataset::problem);
        shown.is_some_and(|shown| shown.is_same_problem(draft))
    }

    /// Where a view is, if there are two of different datasets.
    fn side(&self, pane: usize) -> &'static str {
        match pane {
            _ if self.viewports.len() == 1 || self.is_twice(pane) => "",
            0 => " on the left",
            _ => " on the right",
        }
    }

    /// True if the other view has the same dataset.
    pub(super) fn is_twice(&self, pane: usize) -> bool {
        let dataset = |pane: usize| Some(Arc::as_ptr(&self.opened(pane)?.dataset));
        (0..self.viewports.len()).any(|other| other != pane && dataset(other) == dataset(pane))
    }

    /// Keeps a window open that is about to close where something would be lost, and shows the
    /// question.
    pub(super) fn ask_before_closing(&mut self, ui: &Ui) {
        let ctx = ui.ctx();
        let is_closing = ctx.input(|input| input.viewport().close_requested());
        let is_free = matches!(self.closing, ClosingQuestion::LetGo)
            || ctx.data(|data| data.get_temp(is_let_go())).unwrap_or(false);
        if is_closing && !is_free {
            let losses = self.losses(&CloseGuard::Window);
            if !losses.is_empty() {
                ctx.send_viewport_cmd(ViewportCommand::CancelClose);
                self.closing = ClosingQuestion::Asked(CloseGuard::Window, losses);
            }
        }
        let ClosingQuestion::Asked(guard, losses) = &self.closing else { return };
        let (guard, losses) = (guard.clone(), losses.clone());
        if self.losses(&guard) != losses {
            // a solver has ended while one thought about it, and its solution may be asked for
            return self.request_close(ctx, guard);
        }
        match ask(ui, &guard, &losses, &self.kept_texts(&guard)) {
            Some(ClosingAnswer::Save) => self.save_first(guard, losses),
            Some(ClosingAnswer::Close) => self.close_at_last(ctx, guard),
            Some(ClosingAnswer::Back) => self.stay(&guard),
            None => {}
        }
    }

    /// Nothing is closed after all.
    fn stay(&mut self, guard: &CloseGuard) {
        self.closing = ClosingQuestion::None;
        if matches!(guard, CloseGuard::Arrival) {
            self.waiting.pop_front();
        }
    }

    /// Tells which changed texts the window keeps when it closes.
    fn kept_texts(&self, guard: &CloseGuard) -> String {
        if !matches!(guard, CloseGuard::Window) || !self.files.can_keep() {
            return String::new();
        }
        let names: Vec<_> = self.changed_texts().iter().map(|draft| draft.name()).collect();
        match names.len() {
            0 => String::new(),
            _ => format!("Changed texts are kept for the next time: {}.", names.join(", ")),
        }
    }

    /// Saves the first of what would be lost.
    fn save_first(&mut self, guard: CloseGuard, losses: Vec<Loss>) {
        let first = losses.iter().find(|loss| !matches!(loss, Loss::Work(_))).cloned();
        self.closing = ClosingQuestion::Saving(guard, losses);
        match first {
            Some(Loss::Solution(dataset, _)) => self.ask(SavedFile::Dataset(Arc::clone(&dataset))),
            Some(Loss::Text(draft)) => self.save_text(draft),
            Some(Loss::Work(_)) | None => {}
        }
    }

    /// Goes on with what was to be closed once a part of it is saved; if nothing was after all,
    /// everything stays.
    pub(super) fn leave_when_saved(&mut self, ctx: &Context) {
        let ClosingQuestion::Saving(guard, losses) = &self.closing else { return };
        if self.files.is_saving() {
            return;
        }
        let (guard, is_same) = (guard.clone(), self.losses(guard) == *losses);
        if is_same { self.stay(&guard) } else { self.request_close(ctx, guard) }
    }
}

/// Shows the question; what is answered.
fn ask(ui: &Ui, guard: &CloseGuard, losses: &[Loss], kept: &str) -> Option<ClosingAnswer> {
    let can_save = losses.iter().any(|loss| !matches!(loss, Loss::Work(_)));
    let save = can_save.then_some(("Save…", ClosingAnswer::Save));
    let without = without_saving(guard, losses);
    let others = [(without.as_str(), ClosingAnswer::Close), ("Back", ClosingAnswer::Back)];
    let mut answer = None;
    let shown = Modal::new(Id::unique("parting")).show(ui.ctx(), |ui| {
        for loss in losses {
            ui.label(loss.sentence());
        }
        if !kept.is_empty() {
            ui.weak(kept);
        }
        ui.add_space(8.0);
        ui.horizontal_wrapped(|ui| {
            for (name, meant) in save.into_iter().chain(others) {
                if ui.button(name).clicked() {
                    answer = Some(meant);
                }
            }
        });
    });
    let escape = ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
    answer.or_else(|| (escape || shown.should_close()).then_some(ClosingAnswer::Back))
}

/// Returns the words for closing without saving.
fn without_saving(guard: &CloseGuard, losses: &[Loss]) -> String {
    let is_stopped = losses.iter().any(|loss| matches!(loss, Loss::Work(_)));
    let verb = match guard {
        CloseGuard::Text(_) => return "Discard the changes".into(),
        CloseGuard::Arrival => "open",
        CloseGuard::Solve(_) => "solve",
        CloseGuard::Pane(_) | CloseGuard::Window | CloseGuard::View(_) => "close",
    };
    match (is_stopped, losses.len()) {
        (true, 1) if verb == "solve" => "Stop and solve this one".into(),
        (true, 1) => format!("Stop and {verb}"),
        (true, _) => format!("Stop, and {verb} without saving"),
        (false, _) => format!("{}{} without saving", verb[..1].to_uppercase(), &verb[1..]),
    }
}
