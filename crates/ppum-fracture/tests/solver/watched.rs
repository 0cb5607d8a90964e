//! Long calls told of, stopped, and run on threads of the caller's.

use std::sync::Mutex;

use crate::studies::support::{checked, parsed};
use ppum::dataset::Dataset;
use ppum::progress::{Cancelled, Phase, Progress, Verdict, Watcher, unwatched};
use ppum_fracture::diagnostics::recompute;
use ppum_fracture::solve::{
    EigenError, LinearError, Plan, SolveError, UnbalancedError, solve, spectrum,
};
use ppum_problem::{OrderError, ProblemData, ProblemError};
use ppum_solve::report::{SolverReport, strip_timings};
use ppum_solve::space::{InspectError, RefineError, SpaceError, discretise};

/// A plate with all that takes time: a formula to be probed, restraints, an interface, two tips.
const PLATE: &str = r#"
[domain]
min = [-1.0, -1.0]
max = [1.0, 1.0]
[material]
young = "if(y > 0.5, 2, 1)"
poisson = 0.3
state = "plane-strain"
[[crack]]
points = [[-0.4, 0.03], [0.2, 0.03]]
[[boundary]]
on = "bottom"
displacement = [0.0, 0.0]
[[boundary]]
on = "top"
traction = [0.0, "exp(-100*x^2)"]
[discretization]
level = 4
order = 1
"#;

const PHASES: [Phase; 6] = [
    Phase::Cover,
    Phase::Basis,
    Phase::Assembly,
    Phase::Solution,
    Phase::Intensity,
    Phase::Estimation,
];

fn plate() -> ProblemData {
    parsed(PLATE)
}

fn on_threads<R: Send>(threads: usize, work: impl FnOnce() -> R + Send) -> R {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .thread_name(|k| format!("own {k}"))
        .build()
        .expect("a pool");
    pool.install(work)
}

/// Keeps what it hears, and stops the work at a report of a phase.
struct Stopper {
    stop: Option<(Phase, usize)>,
    heard: Mutex<Vec<Progress>>,
}

impl Stopper {
    fn new(stop: Option<(Phase, usize)>) -> Self {
        Self { stop, heard: Mutex::new(Vec::new()) }
    }

    fn heard(&self) -> Vec<Progress> {
        self.heard.lock().expect("no panic").clone()
    }
}

impl Watcher for Stopper {
    fn on_progress(&self, progress: Progress) -> Verdict {
        let mut heard = self.heard.lock().expect("no panic");
        heard.push(progress);
        let of_phase = |phase| heard.iter().filter(|p| p.phase == phase).count();
        Verdict::go_on_unless(self.stop.is_some_and(|(phase, at)| of_phase(phase) == at))
    }
}

/// All but the seconds.
fn without_seconds(mut dataset: Dataset) -> Dataset {
    strip_timings(&mut dataset.steps[0]);
    dataset
}

/// Everything runs on the pool that it is called from, with the same bits whatever its size,
/// watched or not.
#[test]
fn threads_are_those_of_the_caller() {
    let problem = plate();
    let at_home = |_: Progress| {
        let thread = std::thread::current();
        assert!(thread.name().is_some_and(|name| name.starts_with("own ")), "{thread:?}");
        Verdict::GoOn
    };
    let solved = |threads, watcher: &(dyn Watcher + Send)| {
        on_threads(threads, || {
            without_seconds(solve(&checked(&problem), watcher).expect("a solution"))
        })
    };
    let one = solved(1, &at_home);
    assert!(one == solved(3, &at_home), "datasets differ");
    assert!(one == solved(2, &|_: Progress| Verdict::GoOn), "datasets differ");
}

#[test]
fn every_phase_is_told_of_in_order() {
    let watcher = Stopper::new(None);
    let dataset = on_threads(1, || solve(&checked(&plate()), &watcher)).expect("a solution");
    let heard = watcher.heard();
    let mut phases: Vec<_> = heard.iter().map(|progress| progress.phase).collect();
    phases.dedup();
    assert_eq!(phases, PHASES);
    let report = SolverReport::of(&dataset.steps[0].history);
    assert_eq!(report.seconds.iter().map(|(phase, _)| *phase).collect::<Vec<_>>(), PHASES);
    assert!(heard.iter().all(|p| p.done <= p.total && p.total > 0));
    for phase in [Phase::Basis, Phase::Assembly, Phase::Solution] {
        let last = heard.iter().rfind(|p| p.phase == phase).expect("it was told");
        assert_eq!((last.done, last.total > 1), (last.total, true), "{phase:?}");
    }
}

/// In each phase, at its beginning and later: an error of its own kind, and nothing more is begun.
#[test]
fn a_solution_can_be_cancelled_in_every_phase() {
    let problem = plate();
    for (phase, last) in PHASES.into_iter().zip([50, 500, 200, 3, 50]) {
        for at in [1, last] {
            let watcher = Stopper::new(Some((phase, at)));
            let error =
                on_threads(3, || solve(&checked(&problem), &watcher)).expect_err("it was stopped");
            assert!(matches!(error, SolveError::Cancelled(Cancelled)), "{phase:?}: {error}");
            assert_eq!(error.to_string(), "cancelled");
            let heard = watcher.heard();
            assert_eq!(heard.last().map(|p| p.phase), Some(phase));
            let of_phase = heard.iter().filter(|p| p.phase == phase).count();
            assert!(of_phase < at + 3, "{phase:?}: {of_phase} reports, but stopped at {at}");
        }
    }
}

#[test]
fn other_long_calls_can_be_cancelled() {
    let problem = plate();
    let dataset = solve(&checked(&problem), unwatched()).expect("a solution");
    for at in [1, 20] {
        let watcher = Stopper::new(Some((Phase::Intensity, at)));
        let found = recompute(&dataset, 0, Some(&checked(&problem)), &watcher);
        assert!(matches!(found, Err(SolveError::Cancelled(Cancelled))), "{at}");
        assert!(watcher.heard().len() < at + 16);
    }
    for (phase, at) in PHASES.into_iter().take(4).zip([3, 10, 10, 5]) {
        let watcher = Stopper::new(Some((phase, at)));
        let found = spectrum(&checked(&problem), &watcher);
        assert!(matches!(found, Err(SolveError::Cancelled(Cancelled))), "{phase:?}");
    }
    let ready = checked(&problem);
    let plan = Plan::new(&ready, None, unwatched()).expect("a plan");
    let stopper = || Stopper::new(Some((Phase::Basis, 9)));
    assert!(matches!(plan.check(&stopper()), Err(SolveError::Cancelled(Cancelled))));
    let found = discretise(&checked(&problem), &Stopper::new(Some((Phase::Cover, 9))));
    assert!(matches!(found, Err(SpaceError::Cancelled(Cancelled))));
}

/// Patches that all lie over each other are refused before lists of pairs fill the memory.
#[test]
fn patches_over_each_other_have_no_factors() {
    let piled = ppum_testkit::costly::named("patches-piled");
    let error = recompute(&piled, 0, None, unwatched()).expect_err("too many pairs").to_string();
    assert!(error.contains("let fewer patches overlap"), "{error}");
}

ppum_testkit::errors_cross_threads!(
    SolveError,
    SpaceError,
    RefineError,
    InspectError,
    LinearError,
    EigenError,
    UnbalancedError,
    ProblemError,
    OrderError,
);
