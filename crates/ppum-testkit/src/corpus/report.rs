//! Comparing and counting.

use std::collections::BTreeMap;
use std::fmt;

use super::backend::CaseResult;
use super::cases::FormulaCase;
use super::tolerance::Tolerance;

/// The results of a run over cases.
#[derive(Clone, Debug, Default)]
pub struct CorpusReport {
    /// Name of the back end.
    pub backend: String,
    /// Cases with at least one number compared.
    pub asserted: usize,
    /// Numbers compared.
    pub numbers: usize,
    /// Cases left out, by reason.
    pub skipped: BTreeMap<String, usize>,
    /// The failures, one message for each case.
    pub failures: Vec<String>,
    /// The largest difference in units of its tolerance, of those that pass, and where it is.
    pub worst: (f64, String),
}

/// Evaluates the cases by a back end and compares with what the corpus says.
pub fn check(
    backend: &str,
    mut evaluate: impl FnMut(&FormulaCase) -> CaseResult,
    tolerance: &Tolerance,
    cases: &[FormulaCase],
) -> CorpusReport {
    let mut report = CorpusReport { backend: backend.to_owned(), ..CorpusReport::default() };
    for case in cases {
        match (&case.not_single, evaluate(case)) {
            (Some(reason), _) if tolerance.rounds_inputs => report.skip(reason),
            (_, Err(reason)) => report.skip(&reason),
            (_, Ok(found)) => report.compare(case, &found, tolerance),
        }
    }
    report
}

impl CorpusReport {
    /// Number of cases.
    #[must_use]
    pub fn cases(&self) -> usize {
        self.asserted + self.skipped.values().sum::<usize>()
    }

    fn skip(&mut self, reason: &str) {
        *self.skipped.entry(reason.to_owned()).or_default() += 1;
    }

    fn compare(&mut self, case: &FormulaCase, found: &[Vec<f64>], tolerance: &Tolerance) {
        self.asserted += 1;
        let mut failure = String::new();
        for (order, (expected, found)) in case.expected.iter().zip(found).enumerate() {
            assert_eq!(expected.len(), found.len(), "{}: order {order}", case.place);
            for (&expected, &found) in expected.iter().zip(found) {
                self.numbers += 1;
                let limit = tolerance.limit(&case.bounds[order], expected);
                let ratio = difference(found, expected) / limit;
                if ratio > 1.0 {
                    failure += &format!(
                        "\n  order {order}: {found:e}, not {expected:e} ({ratio:.1} tolerances)"
                    );
                } else if ratio > self.worst.0 {
                    self.worst = (ratio, format!("{}, order {order}", case.place));
                }
            }
        }
        if !failure.is_empty() {
            self.failures.push(format!("{}: {}{failure}", case.place, case.formula));
        }
    }
}

/// |a − b|; 0 for the same infinity and for two NaN, else ∞ if one of them is not finite.
fn difference(a: f64, b: f64) -> f64 {
    let same = a.is_nan() && b.is_nan() || a == b;
    match (same, (a - b).abs()) {
        (true, _) => 0.0,
        (_, size) if size.is_nan() => f64::INFINITY,
        (_, size) => size,
    }
}

impl fmt::Display for CorpusReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (worst, place) = &self.worst;
        writeln!(
            f,
            "{}: {} cases asserted with {} numbers, {} failed; worst {worst:.2} of its tolerance ({place})",
            self.backend,
            self.asserted,
            self.numbers,
            self.failures.len(),
        )?;
        for (reason, count) in &self.skipped {
            writeln!(f, "  {count} skipped: {reason}")?;
        }
        for failure in &self.failures {
            writeln!(f, "  {failure}")?;
        }
        Ok(())
    }
}
