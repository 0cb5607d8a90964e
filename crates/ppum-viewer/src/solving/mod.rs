//! Problems while they are written, and their solutions: both in the background.

pub mod border;
pub mod marks;
pub mod preview;

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use ppum::dataset::Dataset;
use ppum::progress::{Phase, Progress, Verdict, Watcher};
use ppum_fracture::growth::{GrowthError, grow};
use ppum_fracture::solve::{Plan, SolveError};
use ppum_problem::{Problem, ProblemError, ProblemLocation};

use self::border::Border;
use self::preview::Preview;
use crate::job::{BackgroundJob, CancelToken};
use crate::session::ProblemDraft;

/// An error in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mark {
    /// Line and column, from 1; none of an error that has no place in the text.
    pub at: Option<[usize; 2]>,
    /// The error and its remedy.
    pub message: String,
}

/// A text, and where the files that it names are looked for: in the dataset that it came from, else
/// in a folder.
#[derive(Clone, Debug)]
struct ProblemText {
    text: String,
    origin: Option<Arc<Dataset>>,
    folder: PathBuf,
}

/// A text with the results of its check.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CheckedText {
    /// The text.
    pub text: String,
    /// Its errors, in the order of the text.
    pub marks: Vec<Mark>,
    /// The geometry of the text; if it has errors, of the last text without any, or the body alone,
    /// as far as it was known.
    pub preview: Option<Arc<Preview>>,
    /// The parts of the boundary; none if the body cannot be read.
    pub border: Arc<Border>,
}

/// The way the last solution has ended.
#[derive(Clone, Debug, PartialEq)]
pub enum SolutionOutcome {
    /// With a dataset, after so many seconds, and with warnings.
    Solved(f64, Vec<String>),
    /// It was stopped, with so many steps of a series, which are shown.
    Cancelled(usize),
    /// With an error; the steps of a series before it are shown.
    Failed(String),
}

/// How a dataset was computed in this window.
#[derive(Clone, Debug)]
pub struct ComputationRecord {
    /// The problem, as it was when its solution began.
    pub problem: ProblemDraft,
    /// The way the computation has ended.
    pub outcome: SolutionOutcome,
}

/// A dataset that was computed for a pane.
#[derive(Clone, Debug)]
pub struct ComputedDataset {
    /// The pane.
    pub pane: usize,
    /// The dataset.
    pub dataset: Arc<Dataset>,
    /// How it was computed.
    pub solution: ComputationRecord,
}

/// The problem that is written, and the solution that is computed.
#[derive(Debug)]
pub struct SolverState {
    /// The dataset that the text came from: it holds the tables and points that the text names.
    pub origin: Option<Arc<Dataset>>,
    /// True if the text gives way to that of what is shown: it came from there, was solved, or a
    /// dataset was opened since.
    pub gives_way: bool,
    /// The way the last solution has ended.
    pub outcome: Option<SolutionOutcome>,
    /// The text that was solved last.
    pub(crate) solved_text: String,
    /// The place in the text to go to.
    pub jump: Option<[usize; 2]>,
    /// Memory that is free \[bytes\], as far as the system tells.
    pub memory: fn() -> Option<u64>,
    checked: Option<Arc<CheckedText>>,
    /// The text that is being checked, and the check.
    checking: Option<(String, BackgroundJob<CheckedText>)>,
    running: Option<RunningSolution>,
    ctx: egui::Context,
}

/// A solution that is being computed.
#[derive(Debug)]
pub struct RunningSolution {
    /// The view that it is for.
    pub pane: usize,
    /// The problem that is solved.
    pub problem: ProblemDraft,
    start: Instant,
    told: Arc<Mutex<SolutionProgress>>,
    job: BackgroundJob<SolvedSteps>,
}

/// The estimate and the progress of a solution while it is computed.
#[derive(Clone, Debug, Default)]
pub struct SolutionProgress {
    /// The phase, and how much of it is done.
    pub progress: Option<Progress>,
    /// The cost, in words, once that is known.
    pub estimate: Option<String>,
    /// The number of the last step of a series.
    pub steps: Option<usize>,
    /// The part of the whole that is done.
    pub part: f32,
}

/// The dataset that was computed, if there is one, and why it has no more steps than it has, if it
/// should have.
type SolvedSteps = (Option<Dataset>, Option<SolutionFailure>);

#[derive(Debug, thiserror::Error)]
enum SolutionFailure {
    #[error("cancelled")]
    Cancelled,
    #[error("{0}")]
    Failed(String),
}

impl From<SolveError> for SolutionFailure {
    fn from(error: SolveError) -> Self {
        match error {
            SolveError::Cancelled(_) => Self::Cancelled,
            error => Self::Failed(error.to_string()),
        }
    }
}

/// Phases of a solution, in their order.
pub const PHASES: [Phase; 6] = [
    Phase::Cover,
    Phase::Basis,
    Phase::Assembly,
    Phase::Solution,
    Phase::Intensity,
    Phase::Estimation,
];

/// The name of the editor of the text among all widgets.
pub(crate) fn editor_id() -> egui::Id {
    egui::Id::unique("text of the problem")
}

/// The number of a phase among all.
pub(crate) fn phase_number(phase: Phase) -> usize {
    PHASES.iter().position(|known| *known == phase).unwrap_or(0)
}

impl SolverState {
    /// Nothing is written yet.
    #[must_use]
    pub fn new(ctx: &egui::Context) -> Self {
        Self {
            origin: None,
            gives_way: false,
            outcome: None,
            solved_text: String::new(),
            jump: None,
            memory: || None,
            checked: None,
            checking: None,
            running: None,
            ctx: ctx.clone(),
        }
    }

    /// Another text is written from now on; one that came from a dataset finds there what it names.
    pub fn begin(&mut self, origin: Option<Arc<Dataset>>) {
        (self.gives_way, self.origin) = (origin.is_some(), origin);
        (self.outcome, self.checked, self.checking) = (None, None, None);
        // what is taken back in one text is no state of another
        if let Some(mut state) = egui::text_edit::TextEditState::load(&self.ctx, editor_id()) {
            state.clear_undoer();
            state.store(&self.ctx, editor_id());
        }
    }

    /// Takes the result of the check that runs, once it has ended, whichever page is open then.
    fn take_checked(&mut self) {
        let Some((text, job)) = &self.checking else { return };
        let Some(outcome) = job.poll() else { return };
        let broken = |message| CheckedText {
            text: text.clone(),
            marks: vec![Mark { at: None, message }],
            ..CheckedText::default()
        };
        let mut checked = outcome.unwrap_or_else(broken);
        let before = self.checked.as_ref().and_then(|before| before.preview.clone());
        let is_complete = |preview: &Arc<Preview>| preview.is_complete;
        let full = |preview: Option<Arc<Preview>>| preview.filter(is_complete);
        let latest = checked.preview.take();
        let complete = full(latest.clone()).or_else(|| full(before.clone()));
        checked.preview = complete.or(latest).or(before);
        (self.checked, self.checking) = (Some(Arc::new(checked)), None);
    }

    /// Looks for errors in the background whenever the text is another one.
    pub fn check(&mut self, draft: &ProblemDraft) {
        self.take_checked();
        let is_known = self.checked.as_ref().is_some_and(|checked| checked.text == draft.text);
        if self.checking.is_none() && !is_known {
            let text = self.text(draft);
            let job = BackgroundJob::start(&self.ctx, move |_| {
                let body = Problem::body_of(&text.text, &text.folder);
                let (marks, preview) = match text.parse() {
                    Ok(problem) => (Vec::new(), Some(Preview::new(&problem))),
                    Err(error) => {
                        (marks(&error), body.as_ref().map(|text| Preview::of_body(&text.body)))
                    }
                };
                let border = Arc::new(body.as_ref().map(Border::new).unwrap_or_default());
                CheckedText { text: text.text, marks, preview: preview.map(Arc::new), border }
            });
            self.checking = Some((draft.text.clone(), job));
        }
    }

    /// Returns the facts about the text that was checked last.
    #[must_use]
    pub fn checked(&self) -> Option<&Arc<CheckedText>> {
        self.checked.as_ref()
    }

    fn text(&self, draft: &ProblemDraft) -> ProblemText {
        let folder = draft.folder.as_deref().or(draft.path.as_deref().and_then(Path::parent));
        ProblemText {
            text: draft.text.clone(),
            origin: self.origin.clone().filter(|_| folder.is_none()),
            folder: folder.unwrap_or(Path::new("")).to_owned(),
        }
    }

    /// Begins to solve the problem for a pane. A solution that is being computed is stopped.
    pub fn solve(&mut self, draft: &ProblemDraft, pane: usize) {
        let text = self.text(draft);
        let told = Arc::new(Mutex::new(SolutionProgress::default()));
        let (theirs, memory, ctx) = (Arc::clone(&told), (self.memory)(), self.ctx.clone());
        let job = BackgroundJob::start(&self.ctx, move |stop| {
            let follower = Follower { told: &theirs, stop, ctx: &ctx };
            // images, which are made on the other threads, do not wait for the solution
            let solve = || solve(&text, memory, &follower).unwrap_or_else(|e| (None, Some(e)));
            let pool = rayon::ThreadPoolBuilder::new().build();
            let failed =
                |error: rayon::ThreadPoolBuildError| SolutionFailure::Failed(error.to_string());
            pool.map(|pool| pool.install(solve)).unwrap_or_else(|e| (None, Some(failed(e))))
        });
        self.outcome = None;
        let (problem, start) = (draft.clone(), Instant::now());
        self.running = Some(RunningSolution { pane, problem, start, told, job });
    }

    /// Stops the solution that is being computed.
    pub fn cancel(&mut self) {
        if let Some(running) = &self.running {
            running.job.cancel();
        }
    }

    /// A view goes: what is computed for it is given up, and those after it have another number.
    pub fn leave_pane(&mut self, pane: usize) {
        self.running = self.running.take().filter(|running| running.pane != pane);
        if let Some(running) = self.running.as_mut().filter(|running| running.pane > pane) {
            running.pane -= 1;
        }
    }

    /// The solution that is being computed.
    #[must_use]
    pub fn running(&self) -> Option<&RunningSolution> {
        self.running.as_ref()
    }

    /// True while something is computed.
    #[must_use]
    pub fn is_working(&self) -> bool {
        self.running.is_some() || self.checking.is_some()
    }

    /// The dataset that was computed since.
    pub fn poll(&mut self) -> Option<ComputedDataset> {
        self.take_checked();
        let ended = self.running.as_ref()?.job.poll()?;
        let running = self.running.take()?;
        let (dataset, stopped) =
            ended.unwrap_or_else(|panic| (None, Some(SolutionFailure::Failed(panic))));
        let steps = dataset.as_ref().map_or(0, |dataset| dataset.steps.len());
        let nothing = || dataset.is_none().then_some(SolutionFailure::Cancelled);
        let outcome = match stopped.or_else(nothing) {
            None => {
                let warnings = dataset.as_ref().map(warnings_of).unwrap_or_default();
                SolutionOutcome::Solved(running.seconds(), warnings)
            }
            Some(SolutionFailure::Cancelled) => SolutionOutcome::Cancelled(steps),
            Some(SolutionFailure::Failed(error)) if steps > 0 => {
                SolutionOutcome::Failed(format!("step {steps}: {error}"))
            }
            Some(SolutionFailure::Failed(error)) => SolutionOutcome::Failed(error),
        };
        self.outcome = Some(outcome.clone());
        let RunningSolution { pane, problem, .. } = running;
        self.solved_text.clone_from(&problem.text);
        let solution = ComputationRecord { problem, outcome };
        dataset.map(|dataset| ComputedDataset { pane, dataset: Arc::new(dataset), solution })
    }
}

impl ComputationRecord {
    /// True if it is all that was to be computed: not the steps before a stop or an error.
    pub(crate) fn is_complete(&self) -> bool {
        matches!(self.outcome, SolutionOutcome::Solved(..))
    }
}

/// Returns the warnings of all steps, each once.
fn warnings_of(dataset: &Dataset) -> Vec<String> {
    let mut said = Vec::new();
    for warning in dataset.steps.iter().flat_map(|step| &step.warnings) {
        if !said.contains(&warning.message) {
            said.push(warning.message.clone());
        }
    }
    said
}

impl RunningSolution {
    /// Seconds since it began.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    /// The progress of the solution.
    #[must_use]
    pub fn progress_report(&self) -> SolutionProgress {
        self.told.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// True once it was asked to stop.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.job.is_cancelled()
    }
}

impl SolutionProgress {
    /// Notes progress. Every step counts alike, and every phase of a step; work that is done once
    /// more, as for an estimate before the solution, counts once.
    fn note(&mut self, progress: Progress) {
        let done = progress.done as f32 / progress.total.max(1) as f32;
        let in_step = (phase_number(progress.phase) as f32 + done) / PHASES.len() as f32;
        let part = match self.steps {
            Some(last) => (progress.step as f32 + in_step) / (last + 1) as f32,
            None => in_step,
        };
        (self.progress, self.part) = (Some(progress), self.part.max(part));
    }
}

/// Hears of a solution's progress, and ends it.
struct Follower<'a> {
    told: &'a Mutex<SolutionProgress>,
    stop: &'a CancelToken,
    ctx: &'a egui::Context,
}

impl Follower<'_> {
    fn told(&self) -> MutexGuard<'_, SolutionProgress> {
        self.told.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Watcher for Follower<'_> {
    fn on_progress(&self, progress: Progress) -> Verdict {
        let mut told = self.told();
        // as many images as eyes can follow
        let hundredth = |p: Progress| (p.step, p.phase, 100 * p.done / p.total.max(1));
        if told.progress.map(hundredth) != Some(hundredth(progress)) {
            self.ctx.request_repaint();
        }
        told.note(progress);
        Verdict::go_on_unless(self.stop.is_set())
    }
}

fn solve(
    text: &ProblemText,
    memory: Option<u64>,
    follower: &Follower<'_>,
) -> Result<SolvedSteps, SolutionFailure> {
    let problem = text.parse().map_err(|error| SolutionFailure::Failed(summary(&error)))?;
    follower.told().steps = problem.growth.as_ref().map(|rule| rule.steps);
    let plan = Plan::new(&problem, memory, follower)?;
    follower.told().estimate = Some(plan.estimate().to_string());
    holds(plan.dataset())?;
    if problem.growth.is_some() {
        return Ok(grown(&problem, memory, follower));
    }
    let dataset = plan.solve(follower)?;
    holds(&dataset)?;
    Ok((Some(dataset), None))
}

/// A dataset that no file can hold is no solution: a load that is too large leaves numbers that are
/// not finite.
fn holds(dataset: &Dataset) -> Result<(), SolutionFailure> {
    ppum_format::check(dataset).map_err(|error| SolutionFailure::Failed(error.to_string()))
}

/// All steps of a series, or those that are complete when it is stopped.
fn grown(problem: &Problem, memory: Option<u64>, follower: &Follower<'_>) -> SolvedSteps {
    let mut all: Option<Dataset> = None;
    let keep = |step: Dataset| {
        holds(&step)?;
        match &mut all {
            Some(all) => all.steps.extend(step.steps),
            None => all = Some(step),
        }
        Ok(())
    };
    let stopped = match grow(problem, None, memory, follower, keep) {
        Ok(()) => None,
        Err(GrowthError::Solve(error)) => Some(SolutionFailure::from(error)),
        Err(GrowthError::Kept(stopped)) => Some(stopped),
        Err(error) => Some(SolutionFailure::Failed(error.to_string())),
    };
    (all, stopped)
}

impl ProblemText {
    fn parse(&self) -> Result<Problem, ProblemError> {
        match &self.origin {
            None => Problem::parse(&self.text, "problem", &self.folder),
            Some(dataset) => Problem::parse_with(&self.text, dataset),
        }
    }
}

fn summary(error: &ProblemError) -> String {
    match error.mistakes() {
        [one] => format!("not solved: {one}"),
        many => format!("not solved: the text has {} mistakes", many.len()),
    }
}

/// The errors with their places in the text.
fn marks(error: &ProblemError) -> Vec<Mark> {
    let mark = |mistake: &ppum_problem::Diagnostic| match &mistake.location {
        ProblemLocation::Text { file, line, column } if file == "problem" => {
            Mark { at: Some([*line, *column]), message: mistake.message.clone() }
        }
        place => Mark { at: None, message: format!("{place}: {}", mistake.message) },
    };
    error.mistakes().iter().map(mark).collect()
}
