//! Estimates of the memory of a solution, against what it takes.

use crate::studies::support::checked;
use ppum::dataset::{Material, StressState};
use ppum::progress::unwatched;
use ppum::vec2::{Rect, vec2};
use ppum_fracture::solve::{Plan, SolveError, solve};
use ppum_problem::{
    BaseCells, Condition, Discretization, DomainEdge, PolynomialOrder, ProblemData, SolverKind,
};
use ppum_solve::report::LinearKind;
use ppum_testkit::random::Random;

const STEEL: Material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };

fn plate(level: u32, order: usize) -> ProblemData {
    let square = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
    let mut discretization = Discretization::new(BaseCells::Level(level));
    discretization.order = PolynomialOrder::Uniform(order);
    let hold = vec![Condition::Dirichlet(0.0.into()); 2];
    let pull = vec![Condition::Neumann(0.0.into()), Condition::Neumann(1.0.into())];
    ProblemData::elasticity(square, STEEL, discretization)
        .with_crack(&[[-0.4, 0.1], [0.3, 0.1]])
        .with_boundary(DomainEdge::Bottom, hold)
        .with_boundary(DomainEdge::Top, pull)
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
    let text = error.to_string();
    assert!(text.contains("the memory does not hold") && text.contains("a lower order"), "{text}");
}

/// Names the process that measures the memory of a solution, with the problem it solves.
const MEASURED: &str = "PPUM_MEASURED_PROBLEM";

/// The memory of solutions of random cracks, with the direct and the multilevel solver.
#[test]
#[cfg(target_os = "linux")]
fn the_memory_is_as_estimated() {
    assert_memory("direct", &[(5, 1), (4, 3)]);
    assert_memory("multilevel", &[(5, 1)]);
}

#[test]
#[cfg(target_os = "linux")]
#[ignore = "slow: half a minute for large systems"]
fn the_memory_of_large_systems_is_as_estimated() {
    assert_memory("direct", &[(6, 1), (6, 2), (5, 3), (5, 5), (4, 8)]);
    assert_memory("multilevel", &[(4, 3), (6, 1), (6, 2), (5, 3)]);
}

/// Bytes that the program takes without a system, which are more than those of a test.
const FIXED: f64 = 8e7;

/// Asserts the estimate at pairs of a level and an order, to a factor of 1.5 and the fixed part.
fn assert_memory(kind: &str, sizes: &[(u32, usize)]) {
    for (level, order) in sizes {
        let problem = format!("{kind} {level} {order}");
        let [estimated, used] = measured(&problem);
        let ratio = used / estimated;
        println!("{problem}: {used:.2e} bytes, {ratio:.2} of the estimate");
        assert!(used < 1.5 * estimated, "{problem}: {ratio}");
        assert!(estimated - FIXED < 1.5 * used, "{problem}: {ratio}");
    }
}

/// The estimated and the used memory of a problem \[bytes\], solved by a process of its own.
fn measured(problem: &str) -> [f64; 2] {
    let program = std::env::current_exe().expect("the path of this test");
    let arguments = ["--exact", "estimate::one_problem_in_a_process", "--nocapture"];
    let output =
        std::process::Command::new(program).args(arguments).env(MEASURED, problem).output();
    let text = String::from_utf8(output.expect("a process").stdout).expect("a text");
    let line = text.lines().find_map(|line| line.split_once("measured: "));
    let numbers = line.expect("two numbers").1.split(' ').map(|n| n.parse().expect("a number"));
    numbers.collect::<Vec<_>>().try_into().expect("two numbers")
}

/// Solves the problem that [`measured`] asks for, and none if it is not asked.
#[test]
fn one_problem_in_a_process() {
    let Ok(problem) = std::env::var(MEASURED) else { return };
    let words: Vec<&str> = problem.split(' ').collect();
    let [kind, level, order] = words[..] else { panic!("{problem}") };
    let (level, order) = (level.parse().expect("a level"), order.parse().expect("an order"));
    let problem = plate(level, order);
    let mut random = Random(u64::from(level) + 10 * order as u64);
    let line = [[-0.8, -0.5], [-0.8, 0.6]].map(|[x, y]: [f64; 2]| {
        [0, 1].map(|k| vec2(x + 0.7 * random.unit() + 0.5 * f64::from(k), y + 0.3 * random.unit()))
    });
    let mut problem = problem.with_lines(line.map(|ends| Vec::from(ends).into()));
    problem.solver.kind =
        if kind == "direct" { SolverKind::Direct } else { SolverKind::Multilevel };
    let problem = checked(&problem);
    let plan = Plan::new(&problem, None, unwatched()).expect("a plan");
    let estimated = plan.estimate().memory;
    plan.solve(unwatched()).expect("a solution");
    let status = std::fs::read_to_string("/proc/self/status").expect("the state of this process");
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("a peak");
    let kibibytes: f64 = peak.trim().trim_end_matches(" kB").parse().expect("a number");
    println!("measured: {estimated} {}", 1024.0 * kibibytes);
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
    problem = problem.with_lines((0..10_000).map(|k| line(k).into()));
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
