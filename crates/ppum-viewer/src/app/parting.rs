//! Closing a dataset or the window, or opening something in its place: not without a word where a
//! solution would be lost that no file has.

use std::ops::Range;
use std::sync::Arc;

use egui::{Context, Id, Key, Modal, Modifiers, Ui, ViewportCommand};
use ppum::dataset::Dataset;

use crate::app::Viewer;
use crate::files::examples;
use crate::files::read::{Arrived, Content, Why};
use crate::stage::Opened;

/// What is closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parting {
    /// The dataset of a pane.
    Pane(usize),
    /// The window.
    Window,
    /// What lies where the first file is to be shown that waits for it.
    Arrival,
    /// The second view, by a step back (or forward) in the settings, if that takes it.
    View(bool),
    /// What the active view shows, for the solution of the problem that is written, or of an
    /// example, by its number.
    Solve(Option<usize>),
}

/// How far one has come with it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Question {
    /// Nothing is to be closed.
    #[default]
    None,
    /// What becomes of a pane's solution, or of the one that is computed, is asked.
    Asked(Parting, Loss),
    /// It is being saved; what was to be closed is closed then.
    Saving(Parting, usize),
    /// The window closes, whatever is lost.
    LetGo,
}

/// What would be lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Loss {
    /// The solution of a pane.
    Solution(usize),
    /// The work of a solver.
    Work,
}

/// What is answered.
enum Answer {
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
    pub(crate) fn part(&mut self, ctx: &Context, parting: Parting) {
        match self.lost_with(parting) {
            Some(loss) => self.parting = Question::Asked(parting, loss),
            None => self.close_at_last(ctx, parting),
        }
    }

    fn close_at_last(&mut self, ctx: &Context, parting: Parting) {
        self.parting = Question::None;
        match parting {
            Parting::Pane(pane) if pane < self.session.panes.len() => {
                self.solving.leave_pane(pane);
                self.close(pane);
            }
            Parting::Pane(_) => {}
            Parting::View(back) => {
                if self.takes_view(back) {
                    self.solving.leave_pane(1);
                }
                self.take_settings(ctx, back);
            }
            Parting::Solve(example) => {
                let active = self.session.active;
                let opened = self.stages[active].opened.as_ref().filter(|_| !self.is_twice(active));
                self.replaced = opened.map(|opened| Arc::clone(&opened.dataset));
                self.solve(example);
            }
            Parting::Window => {
                self.parting = Question::LetGo;
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
            Parting::Arrival => {
                if let Some(arrived) = self.waiting.pop_front() {
                    self.arrive(ctx, arrived);
                }
            }
        }
    }

    /// Shows what was read, one after the other, or asks first.
    pub(super) fn let_in(&mut self, ctx: &Context) {
        self.waiting.extend(self.files.arrived());
        while self.parting == Question::None && !self.waiting.is_empty() {
            self.part(ctx, Parting::Arrival);
        }
    }

    /// The panes that something takes.
    fn taken_by(&self, arrived: &Arrived) -> Range<usize> {
        match arrived.content {
            _ if arrived.why != Why::Opened => 0..0,
            Ok(Content::Dataset(_)) => {
                // the view that it was for may have been closed since, as in `place_of`
                let pane = arrived.pane.min(self.stages.len() - 1);
                pane..pane + 1
            }
            Ok(Content::Session(_)) => 0..self.stages.len(),
            Ok(Content::Problem(_)) | Err(_) => 0..0,
        }
    }

    /// What would be lost, if anything would.
    fn lost_with(&self, parting: Parting) -> Option<Loss> {
        let solution = self.solution_lost_with(parting).map(Loss::Solution);
        solution.or(self.is_still_solving(parting).then_some(Loss::Work))
    }

    /// True if the solver works, and would not any more, or for nobody.
    fn is_still_solving(&self, parting: Parting) -> bool {
        let Some(running) = self.solving.running() else { return false };
        match parting {
            Parting::Window | Parting::Solve(_) => true,
            Parting::Pane(pane) => running.pane() == pane,
            Parting::View(back) => self.takes_view(back) && running.pane() == 1,
            Parting::Arrival => false,
        }
    }

    /// True if something is asked, or the answer was that all may be lost.
    #[must_use]
    pub fn is_asking(&self) -> bool {
        self.parting != Question::None
    }

    /// True if a dataset of a view has no file and cannot be had again at once, as examples of one
    /// step can.
    #[must_use]
    pub fn is_unsaved(&self, pane: usize) -> bool {
        self.stages.get(pane).and_then(|stage| stage.opened.as_ref()).is_some_and(is_unsaved)
    }

    /// True if the dataset of a view is to make place for the solution that is computed: that was
    /// asked for.
    #[must_use]
    pub fn is_given_up(&self, pane: usize) -> bool {
        let opened = self.stages.get(pane).and_then(|stage| stage.opened.as_ref());
        let is_it =
            |replaced: &Arc<Dataset>| opened.is_some_and(|o| Arc::ptr_eq(replaced, &o.dataset));
        self.replaced.as_ref().is_some_and(is_it)
    }

    /// The view for a solution: that for which it was computed, another one if a solution has come
    /// there meanwhile.
    pub(super) fn free_pane(&mut self, ctx: &Context, pane: usize) -> usize {
        let pane = pane.min(self.stages.len() - 1);
        let is_meant = self.is_given_up(pane);
        self.replaced = None;
        if is_meant || !self.is_unsaved(pane) || self.is_twice(pane) {
            return pane;
        }
        if self.stages.len() == 1 {
            self.split(ctx);
        }
        1 - pane
    }

    /// A pane whose solution would be lost.
    fn solution_lost_with(&self, parting: Parting) -> Option<usize> {
        let mut panes = match parting {
            Parting::Window => 0..self.stages.len(),
            Parting::Pane(pane) => pane..pane + 1,
            Parting::View(back) if self.takes_view(back) => 1..2,
            Parting::View(_) => 0..0,
            // who changes a problem and solves it again, many times, wants the new solution
            Parting::Solve(None) => 0..0,
            Parting::Solve(Some(_)) => self.session.active..self.session.active + 1,
            Parting::Arrival => self.waiting.front().map_or(0..0, |first| self.taken_by(first)),
        };
        // of one dataset in two views one may go
        let is_one = panes.len() == 1;
        panes.find(|pane| self.is_unsaved(*pane) && !(is_one && self.is_twice(*pane)))
    }

    /// True if the other view has the same dataset.
    fn is_twice(&self, pane: usize) -> bool {
        let dataset = |pane: usize| {
            let opened = self.stages.get(pane)?.opened.as_ref()?;
            Some(Arc::as_ptr(&opened.dataset))
        };
        (0..self.stages.len()).any(|other| other != pane && dataset(other) == dataset(pane))
    }

    /// Keeps a window open that is about to close where a solution would be lost, and shows
    /// the question.
    pub(super) fn ask_before_parting(&mut self, ui: &Ui) {
        let ctx = ui.ctx();
        let is_closing = ctx.input(|input| input.viewport().close_requested());
        let is_free = self.parting == Question::LetGo
            || ctx.data(|data| data.get_temp(is_let_go())).unwrap_or(false);
        if is_closing
            && !is_free
            && let Some(loss) = self.lost_with(Parting::Window)
        {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.parting = Question::Asked(Parting::Window, loss);
        }
        let Question::Asked(parting, loss) = self.parting else { return };
        if loss == Loss::Work && !self.is_still_solving(parting) {
            // it has ended while one thought about it, and its solution may be asked for
            return self.part(ctx, parting);
        }
        match (ask(ui, parting, loss), loss) {
            (Some(Answer::Save), Loss::Solution(pane)) => {
                self.parting = Question::Saving(parting, pane);
                self.ask_dataset(pane);
            }
            (Some(Answer::Close), Loss::Solution(_)) if self.is_still_solving(parting) => {
                self.parting = Question::Asked(parting, Loss::Work);
            }
            (Some(Answer::Close | Answer::Save), _) => self.close_at_last(ctx, parting),
            (Some(Answer::Back), _) => {
                self.parting = Question::None;
                if parting == Parting::Arrival {
                    self.waiting.pop_front();
                }
            }
            (None, _) => {}
        }
    }

    /// Closes what was to be closed once its solution is saved; if it was not after all,
    /// everything stays.
    pub(super) fn leave_when_saved(&mut self, ctx: &Context) {
        let Question::Saving(parting, pane) = self.parting else { return };
        if self.files.is_saving() {
            return;
        }
        self.parting = Question::None;
        if self.lost_with(parting) != Some(Loss::Solution(pane)) {
            self.part(ctx, parting);
        } else if parting == Parting::Arrival {
            self.waiting.pop_front();
        }
    }
}

/// True if no file has a dataset, and it is none of the examples either, which can be had again
/// at once unless they are solved in many steps.
fn is_unsaved(opened: &Opened) -> bool {
    let (text, steps) = (opened.dataset.problem.as_deref(), opened.dataset.steps.len());
    let is_example = examples::ALL.iter().any(|example| Some(example.text) == text);
    opened.path.is_none() && (steps > 1 || !is_example)
}

const UNSAVED: &str = "The solution is not saved.";
const SOLVING: &str = "A problem is being solved.";

/// Shows the question; what is answered.
fn ask(ui: &Ui, parting: Parting, loss: Loss) -> Option<Answer> {
    let (text, save, without) = match (loss, parting) {
        (Loss::Work, Parting::Solve(_)) => (SOLVING, None, "Stop and solve this one"),
        (Loss::Work, _) => (SOLVING, None, "Stop and close"),
        (_, Parting::Arrival) => (UNSAVED, Some("Save…"), "Open without saving"),
        (_, Parting::Solve(_)) => (UNSAVED, Some("Save…"), "Solve without saving"),
        _ => (UNSAVED, Some("Save…"), "Close without saving"),
    };
    let mut answer = None;
    let shown = Modal::new(Id::unique("parting")).show(ui.ctx(), |ui| {
        ui.label(text);
        ui.add_space(8.0);
        ui.horizontal_wrapped(|ui| {
            let save = save.map(|name| (name, Answer::Save));
            let others = [(without, Answer::Close), ("Back", Answer::Back)];
            for (name, meant) in save.into_iter().chain(others) {
                if ui.button(name).clicked() {
                    answer = Some(meant);
                }
            }
        });
    });
    let escape = ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
    answer.or_else(|| (escape || shown.should_close()).then_some(Answer::Back))
}
