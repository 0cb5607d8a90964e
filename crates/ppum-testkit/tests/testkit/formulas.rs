//! All back ends of formulas against the conformance corpus (`tests/corpus`).

use ppum_testkit::corpus::{
    self, CaseResult, CorpusReport, FormulaCase, LANES, LANES_SINGLE, SCALAR, Tolerance,
    derivative_formulas, lane_blocks, scalar_jets,
};

/// Runs the whole corpus.
#[track_caller]
fn conforms(
    name: &str,
    backend: impl FnMut(&FormulaCase) -> CaseResult,
    tolerance: &Tolerance,
) -> CorpusReport {
    let cases = corpus::cases();
    let report = corpus::check(name, backend, tolerance, &cases);
    println!("{report}");
    assert!(report.failures.is_empty(), "{report}");
    assert_eq!(report.cases(), cases.len(), "every case is asserted or declared skipped");
    report
}

#[test]
fn scalar() {
    let report = conforms("scalar f64", scalar_jets(), &SCALAR);
    assert!(report.asserted >= 900, "{} cases", report.asserted);
    assert!(report.skipped.is_empty());
}

#[test]
fn scalar_derivative_by_derivative() {
    let report = conforms("scalar, derivative by derivative", derivative_formulas(), &SCALAR);
    assert!(report.asserted >= 900, "{} cases", report.asserted);
    assert!(report.skipped.is_empty());
}

#[test]
fn lanes_of_doubles() {
    let report = conforms("lanes f64", lane_blocks::<f64>(), &LANES);
    assert!(report.skipped.is_empty());
}

#[test]
fn lanes_of_singles() {
    let report = conforms("lanes f32", lane_blocks::<f32>(), &LANES_SINGLE);
    assert!(report.asserted >= 700, "{} cases", report.asserted);
}

/// An expected number that is wrong by a few tolerances fails, whichever it is.
#[test]
fn wrong_expectations_fail() {
    let mut cases = corpus::cases();
    let mut changed = 0;
    for case in &mut cases {
        let last = case.expected.len() - 1;
        let bound = case.bounds[last];
        if let Some(expected) = case.expected[last].iter_mut().find(|v| v.is_finite()) {
            *expected += 4.0 * SCALAR.limit(&bound, *expected).max(f64::MIN_POSITIVE);
            changed += 1;
        }
    }
    let report = corpus::check("scalar", derivative_formulas(), &SCALAR, &cases);
    assert!(changed > 900, "{changed} of {} changed", cases.len());
    assert_eq!(report.failures.len(), changed);
}

/// The corpus is as large as it says, and every theme has its share.
#[test]
fn themes_have_cases() {
    let cases = corpus::cases();
    for theme in corpus::THEMES {
        let count = cases.iter().filter(|case| case.place.starts_with(theme)).count();
        assert!(count >= 40, "{theme}: {count}");
    }
    let formulas: std::collections::BTreeSet<_> = cases.iter().map(|case| &case.formula).collect();
    assert!(formulas.len() >= 300, "{} different formulas", formulas.len());
}
