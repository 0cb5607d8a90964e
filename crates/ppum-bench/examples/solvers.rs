//! The multilevel solver held against the direct one.
//!
//!     cargo run --release -p ppum-bench --example solvers -- examples/*.toml
//!
//! A line for each problem: unknowns, levels, steps, condition of the preconditioned system, the
//! largest difference of stress intensity factors and coefficients as parts of the largest one,
//! that of the energy, and seconds of both solutions.

use ppum::dataset::Dataset;
use ppum::progress::{Phase, unwatched};
use ppum_fracture::solve::solve;
use ppum_problem::{Problem, SolverKind};
use ppum_solve::report::SolverReport;
use std::path::Path;

fn main() {
    for file in std::env::args().skip(1) {
        match compared(&file) {
            Ok(line) => println!("{file}: {line}"),
            Err(error) => println!("{file}: {error}"),
        }
    }
}

fn compared(file: &str) -> Result<String, Box<dyn std::error::Error>> {
    let mut problem = Problem::read(Path::new(file))?.into_data();
    problem.adaptivity = None;
    let mut solved = |kind| -> Result<(Dataset, SolverReport), Box<dyn std::error::Error>> {
        problem.solver.kind = kind;
        let dataset = solve(&Problem::new(problem.clone())?, unwatched())?;
        let report = SolverReport::of(&dataset.steps[0].history);
        Ok((dataset, report))
    };
    let (direct, of_direct) = solved(SolverKind::Direct)?;
    let (multilevel, report) = solved(SolverKind::Multilevel)?;
    let number = |value: Option<f64>| value.unwrap_or(f64::NAN);
    let energies = [&of_direct, &report].map(|report| number(report.energy));
    let seconds = [&of_direct, &report].map(|report| {
        let of = report.seconds.iter().filter(|(phase, _)| *phase == Phase::Solution);
        of.map(|(_, seconds)| seconds).sum::<f64>()
    });
    Ok(format!(
        "{} unknowns, {} levels, {} steps, condition {:.2}, K {:.1e}, coefficients {:.1e}, energy {:.1e}, {:.2} s and {:.2} s",
        number(report.unknowns.map(|n| n as f64)),
        number(report.solver_levels.map(|n| n as f64)),
        number(report.iterations.map(|n| n as f64)),
        number(report.preconditioned_condition),
        apart(&factors(&direct), &factors(&multilevel)),
        apart(&coefficients(&direct), &coefficients(&multilevel)),
        (energies[1] / energies[0] - 1.0).abs(),
        seconds[0],
        seconds[1]
    ))
}

fn factors(dataset: &Dataset) -> Vec<f64> {
    dataset.steps[0].intensities.iter().flat_map(|tip| [tip.k1, tip.k2]).collect()
}

fn coefficients(dataset: &Dataset) -> Vec<f64> {
    dataset.steps[0].fields[0].coefficients.iter().flatten().copied().collect()
}

/// The largest difference, as a part of the largest value.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let largest = a.iter().fold(0.0f64, |most, a| most.max(a.abs()));
    let difference = a.iter().zip(b).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
    if largest == 0.0 { difference } else { difference / largest }
}
