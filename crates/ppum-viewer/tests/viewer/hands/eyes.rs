//! What is looked at after everything that hands do.

use std::sync::{Arc, LazyLock, Mutex, PoisonError, Weak};
use std::time::{Duration, Instant};

use egui::Shape;
use ppum::dataset::Dataset;
use ppum_testkit::processor::thread_time;
use ppum_viewer::Viewer;
use ppum_viewer::frames::FaultOrigin;
use ppum_viewer::session::ProblemDraft;

use crate::lab::Lab;

/// What was seen.
pub(super) struct Eyes {
    /// The pictures that took longest: of the processor in this thread, by the clock, and what was
    /// done then.
    longest: Vec<(Duration, Duration, String)>,
    /// Memory in MB, from time to time.
    memory: Vec<f64>,
    frames: usize,
    /// Views with solutions that no file had when they were last seen, but for those that were
    /// given up.
    unsaved: Vec<(usize, Weak<Dataset>)>,
    /// Changed texts when they were last seen: that which is written, and those put aside.
    texts: Vec<ProblemDraft>,
    /// True if a problem was being solved, and if something was asked.
    was_solving: bool,
    was_asking: bool,
}

/// Pictures whose times are kept.
const MOST: usize = 8;

/// Panics of any thread, in words.
static PANICS: LazyLock<Mutex<Vec<String>>> = LazyLock::new(|| {
    let before = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        PANICS.lock().unwrap_or_else(PoisonError::into_inner).push(panic.to_string());
        before(panic);
    }));
    Mutex::default()
});

impl Eyes {
    pub(super) fn new() -> Self {
        LazyLock::force(&PANICS);
        let (unsaved, was_solving, was_asking) = (Vec::new(), false, false);
        Self {
            longest: Vec::new(),
            memory: Vec::new(),
            frames: 0,
            unsaved,
            texts: Vec::new(),
            was_solving,
            was_asking,
        }
    }

    /// Looks at the window that was just shown.
    pub(super) fn look(&mut self, lab: &Lab, doing: &str, watch: Watch) {
        let times = watch.times();
        self.frames += 1;
        self.longest.push((times[1], times[0], doing.to_owned()));
        self.longest.sort_by_key(|(core, ..)| std::cmp::Reverse(*core));
        self.longest.truncate(MOST);
        let output = lab.window.output();
        for shape in &output.shapes {
            look_for_clashes(&shape.shape, doing);
        }
        look_for_nowhere(lab, output, doing);
        let viewer = lab.viewer();
        assert_eq!(viewer.session.panes.len(), viewer.viewports.len(), "{doing}");
        assert!(viewer.session.active < viewer.viewports.len(), "{doing}");
        for viewport in &viewer.viewports {
            let failure = viewport.frames.failure();
            let is_ours = failure.is_some_and(|failure| failure.fault == FaultOrigin::Program);
            assert!(!is_ours, "{doing}: {:?}", viewer.session);
        }
        self.look_for_lost_texts(viewer, doing);
        self.look_for_losses(viewer, doing);
        self.check_panics();
    }

    /// No solution goes, and no solver is stopped, unless that was asked for.
    fn look_for_losses(&mut self, viewer: &Viewer, doing: &str) {
        let opened = |k: usize| viewer.viewports[k].opened.as_ref().map(|opened| &opened.dataset);
        let is_there = |(pane, weak): &(usize, Weak<Dataset>)| {
            let mut all = (0..viewer.viewports.len()).filter_map(opened);
            // or that of the text, solved once more, has come at once
            all.any(|there| weak.as_ptr() == Arc::as_ptr(there)) || viewer.is_unsaved(*pane)
        };
        let is_lost = !self.was_asking && !self.unsaved.iter().all(is_there);
        assert!(!is_lost, "{doing}: a solution is lost");
        let solving = &viewer.solving;
        let has_ended = solving.running().is_some() || solving.outcome.is_some();
        let is_stopped = !self.was_asking && self.was_solving && !has_ended;
        assert!(!is_stopped, "{doing}: a solver is stopped");
        let all = 0..viewer.viewports.len();
        let kept = all.filter(|&k| viewer.is_unsaved(k) && !viewer.is_given_up(k));
        let weak = |k: usize| opened(k).map(|dataset| (k, Arc::downgrade(dataset)));
        self.unsaved = kept.filter_map(weak).collect();
        (self.was_solving, self.was_asking) = (solving.running().is_some(), viewer.is_asking());
    }

    /// No changed text goes, not even with the window, unless that was asked for.
    fn look_for_lost_texts(&mut self, viewer: &Viewer, doing: &str) {
        let front = viewer.session.draft.as_ref();
        let all: Vec<_> = front.into_iter().chain(viewer.files.texts()).collect();
        let is_there = |before: &ProblemDraft| {
            // what is written goes on
            let is_written = front.is_some_and(|draft| draft.is_same_problem(before));
            is_written || all.iter().any(|draft| draft.text == before.text)
        };
        let is_lost = !self.was_asking && !self.texts.iter().all(is_there);
        assert!(!is_lost, "{doing}: a changed text is lost");
        self.texts = all.into_iter().filter(|draft| draft.is_changed()).cloned().collect();
    }

    /// The window is closed, and all solutions with it.
    pub(super) fn forget(&mut self) {
        (self.unsaved, self.was_solving) = (Vec::new(), false);
    }

    pub(super) fn check_panics(&self) {
        // a panic of this thread is noted too: the lock must be free again
        let panics = PANICS.lock().unwrap_or_else(PoisonError::into_inner).clone();
        assert!(panics.is_empty(), "{panics:?}");
    }

    pub(super) fn note_memory(&mut self) {
        self.memory.extend(memory());
    }

    /// Memory does not grow: in the last quarter of a long time there is not much more of it than
    /// in the second.
    pub(super) fn check_memory(&self, most: f64) {
        let quarter = self.memory.len() / 4;
        if quarter < 5 {
            return;
        }
        let median = |part: &[f64]| {
            let mut sorted = part.to_vec();
            sorted.sort_by(f64::total_cmp);
            sorted[sorted.len() / 2]
        };
        let before = median(&self.memory[quarter..2 * quarter]);
        let after = median(&self.memory[self.memory.len() - quarter..]);
        println!("memory: {before:.0} MB, at the end {after:.0} MB; {:.0?}", self.memory);
        assert!(after < most * before, "memory grows: {:.0?}", self.memory);
    }

    /// Processor time for the longest picture.
    pub(super) fn longest(&self) -> Duration {
        self.longest.first().map(|(core, ..)| *core).unwrap_or_default()
    }

    pub(super) fn told(&self) -> String {
        let longest = self.longest.iter().map(|(core, wall, doing)| {
            format!("{:.0}/{:.0} ms {doing}", 1e3 * core.as_secs_f64(), 1e3 * wall.as_secs_f64())
        });
        let longest: Vec<_> = longest.collect();
        let memory = self.memory.last().copied().unwrap_or_default();
        format!("{} frames, {memory:.0} MB, longest {longest:?}", self.frames)
    }
}

/// egui writes it into the window where two widgets have one name.
fn look_for_clashes(shape: &Shape, doing: &str) {
    match shape {
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| look_for_clashes(shape, doing)),
        Shape::Text(text) => {
            let words = text.galley.text();
            let is_clash = ["First use of ", "Second use of ", "Double use of "]
                .iter()
                .any(|start| words.trim_start_matches("🔥 ").starts_with(start));
            assert!(!is_clash, "{doing}: {words} at {:?}", text.pos);
        }
        _ => {}
    }
}

/// Everything that is drawn lies somewhere.
fn look_for_nowhere(lab: &Lab, output: &egui::FullOutput, doing: &str) {
    let is_finite = |primitive: &egui::ClippedPrimitive| match &primitive.primitive {
        egui::epaint::Primitive::Mesh(mesh) => mesh.vertices.iter().all(|v| v.pos.is_finite()),
        egui::epaint::Primitive::Callback(_) => true,
    };
    let drawn = |shapes| lab.window.ctx.tessellate(shapes, output.pixels_per_point);
    if drawn(output.shapes.clone()).iter().all(is_finite) {
        return;
    }
    for shape in &output.shapes {
        let all = drawn(vec![shape.clone()]);
        assert!(all.iter().all(is_finite), "{doing}: nowhere lies {:.1500}", format!("{shape:?}"));
    }
}

/// Measures how long a picture of the window takes.
pub(super) struct Watch {
    start: Instant,
    core: Duration,
}

impl Watch {
    pub(super) fn start() -> Self {
        Self { start: Instant::now(), core: thread_time() }
    }

    /// Since then: by the clock, and of the processor in this thread.
    fn times(&self) -> [Duration; 2] {
        [self.start.elapsed(), thread_time().saturating_sub(self.core)]
    }
}

/// Memory of the program in MB, where the system tells it.
fn memory() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find(|line| line.starts_with("VmRSS:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1e3)
}
