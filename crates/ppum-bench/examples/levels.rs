//! The multilevel solver from level to level, and beside the direct one.
//!
//!     cargo run --release -p ppum-bench --example levels -- PROBLEM.toml ORDER KIND FIRST LAST
//!
//! TOLERANCE in the environment takes the place of the problem's. KIND is `multilevel`, `direct` or `auto`. A line for each level: unknowns, steps, condition of the preconditioned system, seconds
//! of basis, assembly and solution, memory of the solver, and the most that the program has held so far.

use ppum::progress::unwatched;
use ppum_solve::problem::{Cells, Order, Problem, SolverKind};
use ppum_solve::report::SolverReport;
use ppum_solve::solve::Plan;
use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, order, kind, first, last] = arguments.as_slice() else {
        return Err("PROBLEM.toml ORDER KIND FIRST LAST".into());
    };
    let mut problem = Problem::read(Path::new(file))?;
    problem.discretization.order = Order::Uniform(order.parse()?);
    problem.solver.kind = match kind.as_str() {
        "multilevel" => SolverKind::Multilevel,
        "direct" => SolverKind::Direct,
        _ => SolverKind::Auto,
    };
    if let Ok(tolerance) = std::env::var("TOLERANCE") {
        problem.solver.tolerance = tolerance.parse()?;
    }
    for level in first.parse::<u32>()?..=last.parse()? {
        problem.discretization.cells = Cells::Level(level);
        let plan = Plan::new(&problem, None, unwatched())?;
        eprintln!("{}", plan.estimate());
        let dataset = plan.solve(unwatched())?;
        let step = &dataset.steps[0];
        let report = SolverReport::of(&step.history);
        let number = |value: Option<f64>| value.unwrap_or(f64::NAN);
        print!(
            "level {level} order {order} {:9} unknowns, {:3} steps, condition {:6.2}, residual {:8.1e}, {:7.1} MB,",
            number(report.unknowns),
            number(report.iterations),
            number(report.preconditioned_condition),
            number(report.residual),
            number(report.solver_bytes) / 1e6
        );
        for (phase, seconds) in &report.seconds {
            print!(" {} {seconds:.2} s", phase.name());
        }
        let k1 = step.intensities.first().map_or(f64::NAN, |tip| tip.k1);
        println!(", energy {:.15e}, K_I {k1:.15e}, peak {:.2} GB", number(report.energy), peak());
    }
    Ok(())
}

/// Most memory held so far, in GB; NaN where the system does not tell.
fn peak() -> f64 {
    let status = ppum_file::text(Path::new("/proc/self/status"), 1 << 16).unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes =
        line.and_then(|line| line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok());
    kilobytes.map_or(f64::NAN, |kilobytes| kilobytes * 1e-6)
}
