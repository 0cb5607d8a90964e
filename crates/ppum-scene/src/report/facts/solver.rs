//! The cost of a solution, and the convergence of its linear solver.

use std::io::{self, Write};

use ppum::dataset::Record;
use ppum::progress::Phase;
use ppum::text::trimmed;
use ppum_solve::report::{LinearKind, SolverReport};
use serde::Serialize;

/// The solver of a step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SolverFacts {
    kind: Option<&'static str>,
    /// Steps of the multilevel solver, what they left of the residual in the norm of the
    /// preconditioner, and the condition that they saw.
    iterations: Option<f64>,
    reduction: Option<f64>,
    condition: Option<f64>,
    /// ‖f − K u‖ / ‖f‖.
    residual: Option<f64>,
    bytes: Option<f64>,
    phases: Vec<PhaseFacts>,
    levels: Vec<LevelRow>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct PhaseFacts {
    name: &'static str,
    seconds: Option<f64>,
    bytes: Option<f64>,
    unknowns: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct LevelRow {
    patches: f64,
    unknowns: f64,
    values: f64,
    bytes: f64,
}

impl SolverFacts {
    /// None of a step whose history does not tell.
    #[must_use]
    pub fn new(history: &[Record]) -> Option<Self> {
        let report = SolverReport::of(history);
        let of = |all: &[(Phase, f64)], phase: Phase| {
            all.iter().find(|(known, _)| *known == phase).map(|(_, value)| *value)
        };
        let phase = |&(phase, seconds): &(Phase, f64)| PhaseFacts {
            name: phase.name(),
            seconds: finite(seconds),
            bytes: of(&report.bytes, phase).and_then(finite),
            unknowns: of(&report.worked, phase).and_then(finite),
        };
        let levels = report.levels.iter().map(|level| LevelRow {
            patches: level.patches,
            unknowns: level.unknowns,
            values: level.values,
            bytes: level.bytes,
        });
        let row = Self {
            kind: report.solver.map(LinearKind::word),
            iterations: report.iterations.map(|n| n as f64),
            reduction: report.residuals.last().copied().and_then(finite),
            condition: report.preconditioned_condition.and_then(finite),
            residual: report.residual.and_then(finite),
            bytes: report.solver_bytes.map(|n| n as f64),
            phases: report.seconds.iter().map(phase).collect(),
            levels: levels.collect(),
        };
        (row.kind.is_some() || !row.phases.is_empty()).then_some(row)
    }

    /// In a line: `multilevel, 4 levels, 21 steps to 7.1e-13, condition 3.5`.
    #[must_use]
    pub fn line(&self) -> String {
        let steps = self.iterations.map(|n| format!("{} steps", trimmed(n)));
        let to = |r: f64| format!(" to {r:.1e} of the residual");
        let steps = steps.map(|steps| steps + &self.reduction.map_or_else(String::new, to));
        let levels = (self.levels.len() > 1).then(|| format!("{} levels", self.levels.len()));
        let condition = self.condition.map(|c| format!("condition {c:.1}"));
        let residual = self.residual.map(|r| format!("residual {r:.1e}"));
        let kind = self.kind.map(str::to_owned);
        [kind, levels, steps, condition, residual]
            .into_iter()
            .flatten()
            .collect::<Vec<_>>()
            .join(", ")
    }

    /// The phases and the levels in tables.
    ///
    /// # Errors
    /// Those of what is written to.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        if !self.phases.is_empty() {
            writeln!(out, "\nphase         seconds          MB    unknowns")?;
        }
        for PhaseFacts { name, seconds, bytes, unknowns } in &self.phases {
            let seconds = seconds.map_or_else(|| "–".into(), |s| format!("{s:.3}"));
            let (bytes, unknowns) = (megabytes(*bytes), number(*unknowns));
            writeln!(
                out,
                "{}",
                format!("{name:<10} {seconds:>10} {bytes:>11} {unknowns:>11}").trim_end()
            )?;
        }
        if !self.levels.is_empty() {
            writeln!(out, "\nlevel     patches    unknowns      values          MB")?;
        }
        for (l, level) in self.levels.iter().enumerate() {
            let [patches, unknowns, values] =
                [level.patches, level.unknowns, level.values].map(|n| number(Some(n)));
            let bytes = megabytes(Some(level.bytes));
            writeln!(out, "{l:<5} {patches:>11} {unknowns:>11} {values:>11} {bytes:>11}")?;
        }
        Ok(())
    }
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, trimmed)
}

fn megabytes(bytes: Option<f64>) -> String {
    bytes.map_or_else(String::new, |bytes| format!("{:.2}", 1e-6 * bytes))
}
