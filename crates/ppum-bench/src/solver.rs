//! The phases of the solver, and how its time grows with the unknowns.

use std::ops::RangeInclusive;
use std::path::Path;

use anyhow::Context as _;
use clap::ValueEnum;
use ppum::progress::{Phase, unwatched};
use ppum_figure::plot::{CurveStyle, PlotCurve, slope, with_slope};
use ppum_fracture::solve::solve;
use ppum_problem::{BaseCells, PolynomialOrder, Problem, SolverKind};
use ppum_solve::report::{LinearKind, SolverReport};
use serde::Serialize;

use crate::machine::line;
use crate::table::ReportTable;
use crate::{Report, chart};

const PROBLEM: &str = include_str!("../../../examples/centre-crack.toml");

/// The linear solver of the problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SolverChoice {
    /// Use the solver that is predicted to be faster
    Auto,
    /// Cholesky factorisation
    Direct,
    /// Conjugate gradients with coarser levels
    Multilevel,
}

/// Solutions on growing covers.
#[derive(Debug, Serialize)]
pub struct Study {
    title: String,
    threads: usize,
    runs: Vec<SolverRun>,
    /// The fits of all that a solution takes and of its phase `solution`, of three levels or more.
    fit: Option<[Fit; 2]>,
}

/// One solution.
#[derive(Debug, Serialize)]
struct SolverRun {
    level: u32,
    unknowns: u64,
    /// The linear solver, its steps, the condition that it meets, and the bytes that it held.
    kind: Option<&'static str>,
    iterations: Option<f64>,
    condition: Option<f64>,
    bytes: Option<f64>,
    /// Names and seconds.
    phases: Vec<(&'static str, f64)>,
    /// Seconds in all.
    seconds: f64,
    energy: Option<f64>,
    /// K_I of the first tip.
    k1: Option<f64>,
    /// Most memory the program has held so far, in kB, where the system tells.
    peak: Option<f64>,
}

impl SolverRun {
    fn new(problem: &Problem, level: u32) -> anyhow::Result<Self> {
        let dataset = solve(problem, unwatched())?;
        let step = &dataset.steps[0];
        let report = SolverReport::of(&step.history);
        let phases: Vec<_> = report.seconds.iter().map(|(phase, s)| (phase.name(), *s)).collect();
        Ok(Self {
            level,
            unknowns: report.unknowns.context("the solver counts unknowns")?,
            kind: report.solver.map(LinearKind::word),
            iterations: report.iterations.map(|n| n as f64),
            condition: report.preconditioned_condition,
            bytes: report.solver_bytes.map(|n| n as f64),
            seconds: phases.iter().map(|phase| phase.1).sum(),
            phases,
            energy: report.energy,
            k1: step.intensities.first().map(|tip| tip.k1),
            peak: line("/proc/self/status", "VmHWM:")
                .and_then(|line| line.trim().strip_suffix("kB")?.trim().parse().ok()),
        })
    }

    /// Seconds of the linear solver.
    fn solution(&self) -> f64 {
        let name = Phase::Solution.name();
        self.phases.iter().filter(|phase| phase.0 == name).map(|phase| phase.1).sum()
    }

    /// The cells of a table.
    fn cells(&self) -> Vec<String> {
        let number = |value: Option<f64>, digits: usize| {
            value.map_or(String::new(), |value| format!("{value:.digits$}"))
        };
        let n = self.unknowns as f64;
        let own = [self.kind.unwrap_or_default().into(), self.level.to_string(), n.to_string()];
        let phases = self.phases.iter().map(|phase| format!("{:.3}", phase.1));
        let rest = [
            format!("{:.3}", self.seconds),
            format!("{:.0}", n / self.seconds),
            number(self.iterations, 0),
            number(self.condition, 2),
            number(self.bytes.map(|bytes| bytes / n), 0),
            number(self.peak.map(|kilobytes| 1e-6 * kilobytes), 2),
            self.energy.map_or(String::new(), |energy| format!("{energy:.12e}")),
            number(self.k1, 10),
        ];
        own.into_iter().chain(phases).chain(rest).collect()
    }
}

impl Study {
    /// Solves a problem, by default the centre crack, on uniform covers of 4^level cells.
    ///
    /// # Errors
    /// A problem that cannot be solved.
    pub fn new(
        (file, order, solver): (Option<&Path>, Option<usize>, SolverChoice),
        levels: RangeInclusive<u32>,
    ) -> anyhow::Result<Self> {
        let parse = || Problem::parse(PROBLEM, "centre-crack.toml", Path::new(""));
        let mut problem = file.map_or_else(parse, Problem::read)?.into_data();
        problem.adaptivity = None;
        problem.solver.kind = match solver {
            SolverChoice::Auto => SolverKind::Auto,
            SolverChoice::Direct => SolverKind::Direct,
            SolverChoice::Multilevel => SolverKind::Multilevel,
        };
        if let Some(order) = order {
            problem.discretization.order = PolynomialOrder::Uniform(order);
        }
        let mut runs = Vec::new();
        for level in levels {
            problem.discretization.cells = BaseCells::Level(level);
            runs.push(SolverRun::new(&Problem::new(problem.clone())?, level)?);
            eprintln!("level {level}: {:.2} s", runs[runs.len() - 1].seconds);
        }
        let fits = || {
            Some([Fit::new(&points(&runs, all))?, Fit::new(&points(&runs, SolverRun::solution))?])
        };
        let (title, fit) = (problem.title.clone(), fits());
        Ok(Self { title, threads: rayon::current_num_threads(), runs, fit })
    }

    /// Draws times against unknowns; the line that is fitted to all phases is dashed.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn chart(&self, path: &Path) -> anyhow::Result<()> {
        let curve = |name: &str, seconds| {
            let points = points(&self.runs, seconds);
            let name = slope(&points).map_or_else(|| name.to_owned(), |p| with_slope(name, p, 2));
            PlotCurve::new(name, points).with_look(CurveStyle::Dotted)
        };
        let mut curves =
            vec![curve("all phases", all), curve("linear solver", SolverRun::solution)];
        if let Some([Fit { seconds, seconds_per_unknown, .. }, _]) = self.fit {
            let at = |[n, _]: [f64; 2]| [n, seconds + seconds_per_unknown * n];
            let line = points(&self.runs, all).into_iter().map(at).collect();
            let name = format!("{:.1} µs an unknown", 1e6 * seconds_per_unknown);
            curves.push(PlotCurve::new(name, line).with_look(CurveStyle::Dashed));
        }
        chart::save(path, &self.title, [("unknowns", ""), ("time", "s")], curves)
    }
}

impl Report for Study {
    fn words(&self) -> String {
        format!("{}, {} threads; seconds of each phase\n", self.title, self.threads)
    }

    fn tables(&self) -> Vec<ReportTable> {
        let phases = self.runs.first().into_iter().flat_map(|run| &run.phases);
        let head = ["solver", "level", "unknowns"].into_iter().chain(phases.map(|phase| phase.0));
        let rest = [
            "in all",
            "unknowns/s",
            "steps",
            "condition",
            "bytes/unknown",
            "peak [GB]",
            "energy",
            "K_I",
        ];
        let note = self.fit.as_ref().map(|[all, solution]| {
            format!("in all: {}\nsolution: {}", all.words(), solution.words())
        });
        vec![ReportTable {
            title: "Phases of the solver".into(),
            words: 1,
            head: head.chain(rest).map(str::to_owned).collect(),
            rows: self.runs.iter().map(SolverRun::cells).collect(),
            note: note.unwrap_or_default(),
        }]
    }
}

fn all(run: &SolverRun) -> f64 {
    run.seconds
}

fn points(runs: &[SolverRun], seconds: fn(&SolverRun) -> f64) -> Vec<[f64; 2]> {
    runs.iter().map(|run| [run.unknowns as f64, seconds(run)]).collect()
}

/// The line t = a + b n nearest to the times of some numbers of unknowns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Fit {
    /// The time of no unknowns.
    pub seconds: f64,
    /// The time of each unknown.
    pub seconds_per_unknown: f64,
    /// Largest distance of a time from the line, as a part of the time.
    pub largest_deviation: f64,
    /// The exponent of the power law that is nearest in logarithms.
    pub exponent: f64,
}

impl Fit {
    /// The least sum of squared deviations, each as a part of its time. None of fewer than three
    /// numbers of unknowns, which a line would meet anyhow.
    #[must_use]
    pub fn new(points: &[[f64; 2]]) -> Option<Self> {
        let mut sizes: Vec<f64> = points.iter().map(|p| p[0]).collect();
        sizes.dedup();
        if sizes.len() < 3 || points.iter().any(|p| p[1] <= 0.0) {
            return None;
        }
        // Σ w (a + b n − t) = 0 and Σ w n (a + b n − t) = 0 with w = 1/t²
        let sum = |of: &dyn Fn(f64, f64) -> f64| points.iter().map(|p| of(p[0], p[1])).sum::<f64>();
        let (w, wn, wnn) =
            (sum(&|_, t| 1.0 / (t * t)), sum(&|n, t| n / (t * t)), sum(&|n, t| n * n / (t * t)));
        let (wt, wnt) = (sum(&|_, t| 1.0 / t), sum(&|n, t| n / t));
        let determinant = w * wnn - wn * wn;
        let seconds = (wt * wnn - wnt * wn) / determinant;
        let seconds_per_unknown = (w * wnt - wn * wt) / determinant;
        let off = |p: &[f64; 2]| ((seconds + seconds_per_unknown * p[0]) / p[1] - 1.0).abs();
        let largest_deviation = points.iter().map(off).fold(0.0, f64::max);
        Some(Self { seconds, seconds_per_unknown, largest_deviation, exponent: slope(points)? })
    }

    fn words(&self) -> String {
        let Self { seconds, seconds_per_unknown, largest_deviation, exponent } = self;
        let sign = if *seconds < 0.0 { '−' } else { '+' };
        format!(
            "{:.2} µs an unknown {sign} {:.2} s, off by {:.0} % at most; exponent {exponent:.2}",
            1e6 * seconds_per_unknown,
            seconds.abs(),
            100.0 * largest_deviation
        )
    }
}
