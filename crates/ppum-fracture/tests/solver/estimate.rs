//! Estimates of the effort of a solution, against what it takes.

use crate::studies::support::checked;
use ppum::dataset::{Material, StressState};
use ppum::progress::unwatched;
use ppum::vec2::{Rect, vec2};
use ppum_fracture::solve::{Plan, SolveError, solve};
use ppum_problem::{Cells, Condition, Discretization, Edge, Order, ProblemData, SolverKind};
use ppum_solve::report::LinearKind;

const STEEL: Material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };

fn plate(level: u32, order: usize) -> ProblemData {
    let square = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
    let mut discretization = Discretization::new(Cells::Level(level));
    discretization.order = Order::Uniform(order);
    let hold = vec![Condition::Dirichlet(0.0.into()); 2];
    let pull = vec![Condition::Neumann(0.0.into()), Condition::Neumann(1.0.into())];
    ProblemData::elasticity(square, STEEL, discretization)
        .with_crack(&[[-0.4, 0.1], [0.3, 0.1]])
        .with_boundary(Edge::Bottom, hold)
        .with_boundary(Edge::Top, pull)
}

fn refused(problem: &ProblemData, memory: u64) -> bool {
    matches!(
        Plan::new(&checked(problem), Some(memory), unwatched()),
        Err(SolveError::TooLarge { .. })
    )
}

/// The patches and unknowns are those of the solution; the memory grows with the problem.
#[test]
fn an_estimate_counts_what_the_solution_has() {
    let mut memory = 0.0;
    for (level, order) in [(3, 1), (3, 2)] {
        let problem = plate(level, order);
        let ready = checked(&problem);
        let plan = Plan::new(&ready, None, unwatched()).expect("a plan");
        let estimate = *plan.estimate();
        let step = solve(&checked(&problem), unwatched()).expect("a solution").steps.remove(0);
        let unknowns = step.history.iter().find(|r| r.name == "unknowns").expect("a record").value;
        assert_eq!(estimate.patches, step.partition.len() as f64);
        assert_eq!(estimate.unknowns, unknowns);
        assert!(estimate.factor >= estimate.nonzeros && estimate.nonzeros > unknowns);
        assert!(estimate.memory > memory, "{level} {order}: {estimate}");
        memory = estimate.memory;
    }
}

/// A memory is enough or not, to the byte; what is known before there is a cover never refuses
/// what fits.
#[test]
fn what_the_memory_does_not_hold_is_refused() {
    let kinds = [SolverKind::Direct, SolverKind::Multilevel];
    for ((level, order), kind) in
        [(1, 1), (3, 2), (4, 4)].into_iter().flat_map(|of| kinds.map(|kind| (of, kind)))
    {
        let mut problem = plate(level, order);
        problem.solver.kind = kind;
        let ready = checked(&problem);
        let plan = Plan::new(&ready, None, unwatched()).expect("a plan");
        let needs = plan.estimate().memory.ceil() as u64;
        assert!(!refused(&problem, needs), "{level} {order}");
        assert!(refused(&problem, needs - 1), "{level} {order}");
    }
}

/// The multilevel solver is chosen where the memory does not hold the factor; a direct solver asked
/// for is refused there.
#[test]
fn a_small_memory_chooses_the_multilevel_solver() {
    let mut problem = plate(6, 2);
    let chosen = |problem: &ProblemData, memory| {
        Plan::new(&checked(problem), memory, unwatched()).map(|plan| *plan.estimate())
    };
    problem.solver.kind = SolverKind::Direct;
    let direct = chosen(&problem, None).expect("a plan");
    problem.solver.kind = SolverKind::Multilevel;
    let multilevel = chosen(&problem, None).expect("a plan");
    assert_eq!([direct.solver, multilevel.solver], [LinearKind::Direct, LinearKind::Multilevel]);
    assert!(multilevel.memory < 0.8 * direct.memory, "{multilevel} {direct}");
    let between = Some((0.5 * (multilevel.memory + direct.memory)) as u64);
    problem.solver.kind = SolverKind::Auto;
    assert_eq!(chosen(&problem, None).expect("a plan").solver, LinearKind::Direct);
    assert_eq!(chosen(&problem, between).expect("a plan").solver, LinearKind::Multilevel);
    problem.solver.kind = SolverKind::Direct;
    assert!(matches!(chosen(&problem, between), Err(SolveError::TooLarge { .. })));
}

/// A million patches of order 8 would take hours to look at: they are refused at once,
/// with numbers.
#[test]
fn what_no_machine_holds_is_refused_without_a_cover() {
    let problem = plate(10, 8);
    assert_eq!(problem.check(), Ok(()));
    let error = Plan::new(&checked(&problem), Some(1 << 35), unwatched()).err().expect("too large");
    let SolveError::TooLarge { needs, .. } = &error else { panic!("{error}") };
    assert!(needs.unknowns >= 9e7 && needs.memory > 5e11, "{needs:?}");
    let text = error.to_string();
    assert!(text.contains("32 GiB") && text.contains("94 million unknowns"), "{text}");
}

/// Ten thousand cracks are looked at in seconds, and their cover ends where the memory does.
#[test]
fn many_cracks_are_refused_soon() {
    let mut problem = plate(2, 2);
    let line = |k: u32| {
        let at = |dx: f64, dy: f64| {
            let (x, y) = (f64::from(k % 100) + dx, f64::from(k / 100) + dy);
            vec2(-0.99 + 0.0198 * x, -0.99 + 0.0198 * y)
        };
        vec![at(0.2, 0.5), at(0.8, 0.6)]
    };
    problem = problem.with_lines((0..10_000).map(line));
    assert_eq!(problem.check(), Ok(()));
    let ready = checked(&problem);
    let plan = Plan::new(&ready, Some(1 << 28), unwatched());
    let error = plan.err().expect("too many").to_string();
    assert!(error.contains("memory"), "{error}");
}

/// Loads that nothing bears are found without a system.
#[test]
fn loads_without_support_are_found_before_anything_is_solved() {
    let mut problem = plate(3, 2);
    problem.boundary.remove(0);
    let ready = checked(&problem);
    let plan = Plan::new(&ready, None, unwatched()).expect("a plan");
    assert!(matches!(plan.check(unwatched()), Err(SolveError::Unbalanced(_))));
    let early = plan.check(unwatched()).expect_err("unbalanced").to_string();
    let late = solve(&checked(&problem), unwatched()).expect_err("unbalanced").to_string();
    assert_eq!(early, late);
}
