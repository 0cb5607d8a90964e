//! The phases of the solver.

use std::io::Write;
use std::path::Path;

use anyhow::Context as _;
use ppum_solve::problem::{Cells, Problem, SolverKind};
use ppum_solve::report::{LinearKind, SolverReport};
use ppum_solve::solve::solve;
use serde::Serialize;

use crate::progress::Bar;

const PROBLEM: &str = include_str!("../../../../../examples/centre-crack.toml");

/// One solution.
#[derive(Debug, Serialize)]
pub(super) struct Run {
    pub(super) level: u32,
    pub(super) unknowns: u64,
    /// The linear solver, its steps, and the bytes that it held.
    pub(super) kind: Option<&'static str>,
    pub(super) iterations: Option<f64>,
    pub(super) bytes: Option<f64>,
    phases: Vec<Phase>,
    /// Seconds in all.
    pub(super) seconds: f64,
    /// Most memory the program has held so far, in bytes, where the system tells.
    peak_memory: Option<u64>,
}

#[derive(Debug, Serialize)]
struct Phase {
    name: String,
    seconds: f64,
}

impl Run {
    /// Solves the centre crack on 4^level cells.
    pub(super) fn new(level: u32, solver: SolverKind) -> anyhow::Result<Self> {
        let mut problem = Problem::parse(PROBLEM, "centre-crack.toml", Path::new(""))?;
        problem.discretization.cells = Cells::Level(level);
        problem.solver.kind = solver;
        let dataset = solve(&problem, &Bar::new())?;
        let report = SolverReport::of(&dataset.steps[0].history);
        let phase = |&(phase, seconds): &(ppum::progress::Phase, f64)| Phase {
            name: phase.name().into(),
            seconds,
        };
        let phases: Vec<_> = report.seconds.iter().map(phase).collect();
        Ok(Self {
            level,
            kind: report.solver.and_then(LinearKind::of_code).map(LinearKind::word),
            iterations: report.iterations,
            bytes: report.solver_bytes,
            unknowns: report.unknowns.context("the solver counts unknowns")? as u64,
            seconds: phases.iter().map(|phase| phase.seconds).sum(),
            phases,
            peak_memory: peak_memory(),
        })
    }

    /// Seconds of the linear solver.
    pub(super) fn solution(&self) -> f64 {
        let name = ppum::progress::Phase::Solution.name();
        self.phases.iter().filter(|phase| phase.name == name).map(|phase| phase.seconds).sum()
    }

    pub(super) fn print(&self, threads: usize, out: &mut dyn Write) -> anyhow::Result<()> {
        let memory = self.peak_memory.map_or(String::new(), |bytes| {
            format!(", at most {:.2} GB so far", bytes as f64 / 1e9)
        });
        let (level, unknowns) = (self.level, self.unknowns);
        writeln!(out, "level {level}: {unknowns} unknowns, {threads} threads{memory}")?;
        let mut line = |name: &str, seconds: f64| {
            let rate = unknowns as f64 / seconds;
            writeln!(out, "  {name:<10} {seconds:>8.3} s {rate:>11.0} unknowns/s")
        };
        self.phases.iter().try_for_each(|phase| line(&phase.name, phase.seconds))?;
        line("in all", self.seconds)?;
        Ok(())
    }
}

/// Linux: the high-water mark of resident memory.
fn peak_memory() -> Option<u64> {
    let status = ppum_file::text(Path::new("/proc/self/status"), 1 << 16).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok().map(|kilobytes| kilobytes * 1024)
}
