//! Covers that are improved by their own solutions.

use crate::studies::adapted::{
    self, CRACK, SQUARE_HOLE, corner, crack, line, on, set, square_hole,
};
use crate::studies::exact_fields::SQUARE;
use crate::studies::plates::pulled;
use crate::studies::support::{checked, record, solved};
use ppum::dataset::{Dataset, Step, WarningKind};
use ppum::domain::{Domain, Hole};
use ppum::progress::{Phase, Progress, Verdict, unwatched};
use ppum::vec2::{Vec2, vec2};
use ppum_fracture::solve::{Plan, SolveError, solve};
use ppum_problem::{AdaptKind, Adaptivity, BaseCells, ProblemData, StepsKept};
use ppum_solve::report::{SolverReport, StopReason, strip_timings};
use ppum_testkit::random::Random;
use std::ops::Range;
use std::sync::Mutex;

/// The course of a solution, with effectivities in their limits.
fn course(dataset: &Dataset, energy: Option<f64>) -> Vec<[f64; 2]> {
    let of_step = |[n, error, estimated]: [f64; 3]| {
        println!("{n} unknowns: {error:.2e}, estimated {estimated:.2e}");
        assert!((0.7..1.8).contains(&(estimated / error)), "{n}: {estimated:e} for {error:e}");
        [n, error]
    };
    adapted::course(dataset, energy).into_iter().map(of_step).collect()
}

/// A problem whose errors are known from its exact field or from its strain energy.
struct Study {
    name: &'static str,
    problem: ProblemData,
    energy: Option<f64>,
}

impl Study {
    fn corner() -> Self {
        Self { name: "corner", problem: corner(), energy: None }
    }

    fn square_hole() -> Self {
        Self { name: "square hole", problem: square_hole(), energy: Some(SQUARE_HOLE) }
    }

    fn crack() -> Self {
        Self { name: "crack", problem: crack(), energy: Some(CRACK) }
    }

    /// Asserts that the error of an h-adaptive cover has the rate p in unknowns^½, less a part of
    /// it that the caller allows for, however singular the field. The first steps, on which
    /// everything is coarse, do not count.
    fn assert_rate(&self, order: usize, part: f64, unknowns: Range<usize>) {
        println!("{}, order {order}", self.name);
        let problem = on(self.problem.clone(), order, set(AdaptKind::H, 20, unknowns.end));
        let points = course(&solved(&problem), self.energy);
        let late = points.iter().filter(|[n, _]| *n > unknowns.start as f64);
        let points: Vec<_> = late.map(|[n, e]| [0.5 * n.ln(), e.ln()]).collect();
        let [slope, _] = line(&points);
        println!("rate {:.2} in {} steps", -slope, points.len());
        assert!(-slope > part * order as f64, "{}, order {order}: {slope}", self.name);
    }

    /// Asserts that the logarithm of the error of an hp-adaptive cover falls along a straight line
    /// over unknowns^⅓, with a slope of `least` at least. A rate of h would bend the line up: the
    /// second half is to be as steep as 60 % of the first.
    fn assert_exponential(&self, order: usize, least: f64, unknowns: Range<usize>) {
        let mut set = set(AdaptKind::Hp, 40, unknowns.end);
        set.fraction = 0.5;
        let dataset = solved(&on(self.problem.clone(), order, set));
        let mut points = course(&dataset, self.energy);
        points.retain(|[n, _]| *n > unknowns.start as f64);
        let points: Vec<_> = points.iter().map(|[n, e]| [n.cbrt(), e.ln()]).collect();
        let [slope, correlation] = line(&points);
        let half = points.len() / 2;
        let [first, second] = [&points[..half], &points[half..]].map(|part| line(part)[0]);
        let name = self.name;
        println!("slope {slope:.2}, correlation {correlation:.4}, halves {first:.2} {second:.2}");
        assert!(slope < -least && correlation < -0.97, "{name}: {slope} {correlation}");
        assert!(second / first > 0.6, "{name}: {first} {second}");
        let last = dataset.steps.last().expect("steps");
        let orders = &last.attributes.iter().find(|a| a.name == "order").expect("orders").values;
        let most = orders.iter().fold(0.0, |a: f64, b| a.max(*b));
        let least = orders.iter().fold(most, |a, b| a.min(*b));
        println!("orders {least} to {most}");
        assert!(most >= 6.0 && least <= 0.5 * most, "{name}: {least} to {most}");
    }
}

/// Steps jump, and lines through three or four of them are as good as 10 %.
#[test]
fn divided_cells_have_the_rate_of_smooth_fields() {
    for order in [1, 2] {
        Study::corner().assert_rate(order, 0.9, 400..2_000);
    }
}

/// Lines through the five steps of the crack are as good as 15 %. The four corners of the hole lie
/// somewhere in their cells: every other step divides them to little avail, so that lines through
/// these few are as good as 25 %.
#[test]
#[ignore = "slow: thousands of unknowns at order 3 and around a hole with four corners"]
fn divided_cells_have_the_rate_of_smooth_fields_in_plates() {
    Study::corner().assert_rate(3, 0.9, 400..3_000);
    Study::square_hole().assert_rate(2, 0.75, 1_000..9_000);
    Study::crack().assert_rate(3, 0.85, 3_000..13_000);
}

/// The rate at order 1 is in docs/decisions/0017.
#[test]
#[ignore = "slow: eighteen thousand unknowns"]
fn divided_cells_have_the_rate_of_smooth_fields_at_order_one() {
    Study::crack().assert_rate(1, 0.85, 3_000..18_000);
}

#[test]
fn errors_of_hp_fall_exponentially() {
    Study::corner().assert_exponential(1, 0.6, 0..1_400);
}

/// The first steps, on which the tips have most of the unknowns, do not count.
#[test]
#[ignore = "slow: a dozen steps of high orders at two tips"]
fn errors_of_hp_fall_exponentially_at_tips() {
    Study::crack().assert_exponential(2, 0.35, 3_300..12_000);
}

/// With p alone the cells stay.
#[test]
fn p_raises_orders_and_divides_nothing() {
    let mut set = set(AdaptKind::P, 3, 100_000);
    set.fraction = 0.9;
    let dataset = solved(&on(crack(), 1, set));
    let points = course(&dataset, Some(CRACK));
    let cells = &dataset.steps[0].partition.boxes().cell;
    assert!(dataset.steps.iter().all(|step| step.partition.boxes().cell == *cells));
    assert!(points[3][1] < 0.1 * points[0][1], "{points:?}");
}

/// Energies of random plates with cracks and holes grow from step to step towards that of the last
/// one: spaces that are all but nested.
#[test]
fn energies_of_random_plates_grow() {
    let mut random = Random(11);
    for case in 0..3 {
        let mut point = |half: f64| [random.between(-half, half), random.between(-half, half)];
        let ends = [point(0.8), point(0.8)];
        let mut problem = pulled(SQUARE, [1, 1], &[&ends]);
        if case > 0 {
            let center = Vec2::from(point(0.5));
            let crack = (Vec2::from(ends[0]), Vec2::from(ends[1]));
            let away = ppum::segment::distance([crack.0, crack.1], center);
            let radius = (0.5 * away).clamp(0.02, 0.3);
            let holes = vec![Hole::Circle { center, radius }];
            problem = problem.with_domain(Domain { bounds: SQUARE, holes });
        }
        let kind = [AdaptKind::H, AdaptKind::P, AdaptKind::Hp][case % 3];
        let dataset = solved(&on(problem, 1 + case % 2, set(kind, 2, 10_000)));
        let energies: Vec<f64> = dataset.steps.iter().map(|s| record(s, "energy")).collect();
        let estimated = |k: usize| record(&dataset.steps[k], "estimated error");
        for (k, pair) in energies.windows(2).enumerate() {
            // spaces are not nested to the last: a tenth of the error's square may be lost
            let slack = 0.1 * estimated(k).powi(2) * pair[0];
            assert!(pair[1] > pair[0] - slack, "case {case}: {energies:?}");
        }
        let last = energies.len() - 1;
        let missing = 1.0 - energies[0] / energies[last];
        println!(
            "case {case}: {energies:?}, estimated {:.1e} {:.1e}",
            estimated(0),
            estimated(last)
        );
        assert!(estimated(last) < 0.7 * estimated(0), "case {case}");
        assert!(missing < 2.0 * estimated(0).powi(2), "case {case}: {energies:?}");
    }
}

#[test]
fn a_symmetric_plate_stays_symmetric() {
    let dataset = solved(&on(square_hole(), 2, set(AdaptKind::Hp, 2, 100_000)));
    let step = dataset.steps.last().expect("steps");
    let centers = &step.partition.boxes().center;
    let is_there = |p: Vec2| centers.iter().any(|q| (*q - p).length() < 1e-12);
    assert!(centers.iter().all(|c| is_there(vec2(-c.x, c.y)) && is_there(vec2(c.x, -c.y))));
}

#[test]
fn results_do_not_depend_on_threads() {
    let problem = on(crack(), 1, set(AdaptKind::Hp, 2, 100_000));
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let mut dataset = pool.install(|| solved(&problem));
        dataset.steps.iter_mut().for_each(strip_timings);
        dataset
    };
    assert!(with(1) == with(3));
}

fn stop(dataset: &Dataset) -> Option<StopReason> {
    SolverReport::of(&dataset.steps.last().expect("steps").history).stop
}

/// Each end of an adaptation is told, only in its last step; one that has not come to its
/// tolerance warns.
#[test]
fn what_has_ended_it_is_told() {
    let with = |change: &dyn Fn(&mut Adaptivity)| {
        let mut set = set(AdaptKind::H, 2, 100_000);
        change(&mut set);
        solved(&on(corner(), 1, set))
    };
    let warns = |dataset: &Dataset| {
        let of = |step: &Step| step.warnings.iter().any(|w| w.kind == WarningKind::Tolerance);
        dataset.steps.iter().map(of).collect::<Vec<_>>()
    };
    let steps = with(&|set| set.tolerance = Some(1e-9));
    assert_eq!((stop(&steps), steps.steps.len()), (Some(StopReason::Steps), 3));
    assert_eq!(warns(&steps), [false, false, true]);
    let tolerance = with(&|set| set.tolerance = Some(0.15));
    assert_eq!((stop(&tolerance), tolerance.steps.len()), (Some(StopReason::Tolerance), 2));
    assert_eq!(warns(&tolerance), [false, false]);
    let few = with(&|set| set.max_unknowns = 100);
    assert_eq!((stop(&few), few.steps.len()), (Some(StopReason::Unknowns), 2));
    assert!(few.steps.iter().all(|step| record(step, "unknowns") <= 100.0));
    let last = with(&|set| set.keep = StepsKept::Last);
    assert_eq!((stop(&last), last.steps.len()), (Some(StopReason::Steps), 1));
    assert_eq!(last.steps[0].partition, steps.steps[2].partition);
    // of the highest order
    let limits = solved(&on(corner(), 8, set(AdaptKind::P, 3, 100_000)));
    assert_eq!((stop(&limits), limits.steps.len()), (Some(StopReason::Limits), 1));
}

/// A step that the memory does not hold is not made.
#[test]
fn memory_ends_it() {
    let problem = on(corner(), 1, set(AdaptKind::H, 8, 100_000));
    let mut finer = problem.clone();
    finer.discretization.cells = BaseCells::Level(4);
    let ready = checked(&finer);
    let plan = Plan::new(&ready, None, unwatched()).expect("a plan");
    let memory = plan.estimate().memory as u64;
    let ready = checked(&problem);
    let plan = Plan::new(&ready, Some(memory), unwatched()).expect("a plan");
    let dataset = plan.solve(unwatched()).expect("a solution");
    assert_eq!(stop(&dataset), Some(StopReason::Memory));
    assert!(dataset.steps.len() > 1);
}

/// Progress tells the step, and the work stops within one when it is to.
#[test]
fn steps_are_watched() {
    let problem = on(crack(), 1, set(AdaptKind::H, 2, 100_000));
    let heard = Mutex::new(Vec::new());
    let watcher = |progress: Progress| {
        heard.lock().expect("no panic").push(progress);
        Verdict::go_on_unless(progress.step == 1 && progress.phase == Phase::Solution)
    };
    assert!(matches!(solve(&checked(&problem), &watcher), Err(SolveError::Cancelled(_))));
    let heard = heard.lock().expect("no panic");
    // the errors of a step are found when the next one has its cover
    let in_order =
        |pair: &[Progress]| pair[0].step <= pair[1].step || pair[1].phase == Phase::Estimation;
    assert!(heard.windows(2).all(in_order));
    assert_eq!(heard.iter().map(|progress| progress.step).max(), Some(1));
}
