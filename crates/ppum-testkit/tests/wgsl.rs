//! The WGSL of formulas: valid, and giving what the corpus says.

use ppum_testkit::corpus::{self, SHADER};
use ppum_testkit::wgsl::Shader;

#[test]
fn corpus_conforms() {
    let cases = corpus::cases();
    let mut shader = Shader::new(&cases).unwrap_or_else(|error| panic!("{error}"));
    let report = corpus::check(&mut shader, &SHADER, &cases);
    println!("{report}");
    assert!(report.failures.is_empty(), "{report}");
    assert_eq!(report.cases(), cases.len(), "every case is asserted or declared skipped");
    assert!(report.asserted >= 600, "{} cases", report.asserted);
}
