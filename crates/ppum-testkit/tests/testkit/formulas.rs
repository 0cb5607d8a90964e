//! All back ends of formulas against the conformance corpus (`tests/corpus`).

use ppum_testkit::corpus::{
    self, CorpusReport, DerivativeFormulas, FormulaBackend, LANES, LANES_SINGLE, LaneBlocks,
    SCALAR, ScalarJets, Tolerance,
};

/// Runs the whole corpus.
#[track_caller]
fn conforms(backend: &mut dyn FormulaBackend, tolerance: &Tolerance) -> CorpusReport {
    let cases = corpus::cases();
    let report = corpus::check(backend, tolerance, &cases);
    println!("{report}");
    assert!(report.failures.is_empty(), "{report}");
    assert_eq!(report.cases(), cases.len(), "every case is asserted or declared skipped");
    report
}

#[test]
fn scalar() {
    let report = conforms(&mut ScalarJets::default(), &SCALAR);
    assert!(report.asserted >= 900, "{} cases", report.asserted);
    assert!(report.skipped.is_empty());
}

#[test]
fn scalar_derivative_by_derivative() {
    let report = conforms(&mut DerivativeFormulas::default(), &SCALAR);
    assert!(report.asserted >= 900, "{} cases", report.asserted);
    assert!(report.skipped.is_empty());
}

#[test]
fn lanes_of_doubles() {
    let report = conforms(&mut LaneBlocks::<f64>::new("lanes f64"), &LANES);
    assert!(report.skipped.is_empty());
}

#[test]
fn lanes_of_singles() {
    let report = conforms(&mut LaneBlocks::<f32>::new("lanes f32"), &LANES_SINGLE);
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
    let report = corpus::check(&mut DerivativeFormulas::default(), &SCALAR, &cases);
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
