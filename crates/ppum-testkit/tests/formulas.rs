//! All back ends of formulas against the conformance corpus (`tests/corpus`).

use ppum_testkit::corpus::{self, Backend, Derivatives, Report, SCALAR, Tolerance};

/// Runs the whole corpus.
#[track_caller]
fn conforms(backend: &mut dyn Backend, tolerance: &Tolerance) -> Report {
    let cases = corpus::cases();
    let report = corpus::check(backend, tolerance, &cases);
    println!("{report}");
    assert!(report.failures.is_empty(), "{report}");
    assert_eq!(report.cases(), cases.len(), "every case is asserted or declared skipped");
    report
}

#[test]
fn scalar_derivative_by_derivative() {
    let report = conforms(&mut Derivatives::default(), &SCALAR);
    assert!(report.asserted >= 900, "{} cases", report.asserted);
    assert!(report.skipped.is_empty());
}
