//! Formulas on the driver: their conformance corpus and their elementary functions.

use std::collections::BTreeMap;

use ppum::formula::wgsl_prelude;
use ppum_testkit::corpus::{self, CaseResult, FormulaCase, SHADER, jets, orders, parse};
use ppum_testkit::wgsl::{ELEMENTARY, tells_wrong_derivative, with_wrong_derivative};

use super::compute::run;
use super::gpu_or_skip;
use crate::Gpu;

/// Numbers of a row: the inputs of a case, at most one less, and which of the shader's formulas
/// it is.
const NUMBERS: usize = 16;
/// Results that a case has at most: value, gradient and Hessian of two variables.
const OUTPUTS: usize = 6;
/// Formulas of a shader: drivers take more than twice as long for a text twice as long.
const BATCH: usize = 8;

/// The texts of formulas in compute shaders. All cases are run beforehand.
struct Driver {
    name: String,
    results: BTreeMap<String, Vec<f64>>,
}

impl Driver {
    /// The cases that single precision can be asked, their texts changed.
    fn new(gpu: &Gpu, cases: &[FormulaCase], edit: impl Fn(String) -> String) -> Self {
        let single: Vec<&FormulaCase> =
            cases.iter().filter(|case| case.not_single.is_none()).collect();
        let formulas: Vec<&[&FormulaCase]> = single.chunk_by(|a, b| same_formula(a, b)).collect();
        let mut results = BTreeMap::new();
        for batch in formulas.chunks(BATCH) {
            let rows: Vec<[f32; NUMBERS]> = (0u8..)
                .zip(batch)
                .flat_map(|(k, cases)| cases.iter().map(move |case| row(case, k)))
                .collect();
            let found = run(gpu, &text(batch, &edit), &[], &rows, OUTPUTS);
            let found = found.unwrap_or_else(|error| panic!("{}: {error}", batch[0][0].place));
            for (case, found) in batch.concat().iter().zip(found) {
                results.insert(case.place.clone(), found.into_iter().map(f64::from).collect());
            }
        }
        Self { name: format!("WGSL on {}", gpu.info().name), results }
    }

    fn evaluate(&self, case: &FormulaCase) -> CaseResult {
        let found = self.results.get(&case.place).ok_or("not among the functions")?;
        Ok(orders(case, &found[..jets(case, &parse(case)).n_outputs()]))
    }
}

/// True if the text of one case is that of the other.
fn same_formula(a: &FormulaCase, b: &FormulaCase) -> bool {
    a.formula == b.formula && a.scope == b.scope && a.expected.len() == b.expected.len()
}

fn row(case: &FormulaCase, formula: u8) -> [f32; NUMBERS] {
    let mut row = [0.0; NUMBERS];
    assert!(case.inputs.len() < NUMBERS, "{}", case.place);
    row.iter_mut().zip(&case.inputs).for_each(|(to, &from)| *to = from as f32);
    row[NUMBERS - 1] = f32::from(formula);
    row
}

/// The functions of some formulas, and the choice of one by the row.
fn text(formulas: &[&[&FormulaCase]], edit: &impl Fn(String) -> String) -> String {
    let (mut functions, mut choices) = (wgsl_prelude().to_owned(), String::new());
    for (k, cases) in formulas.iter().enumerate() {
        let case = cases[0];
        let jets = jets(case, &parse(case));
        functions += &edit(jets.wgsl(&format!("formula_{k}")));
        let inputs: Vec<_> = (0..case.inputs.len()).map(|i| format!("input(k, {i}u)")).collect();
        choices += &format!("case {k}u: {{\nlet v = formula_{k}({});\n", inputs.join(", "));
        for output in 0..jets.n_outputs() {
            choices += &format!("put(k, {output}u, v[{output}]);\n");
        }
        choices += "}\n";
    }
    let last = NUMBERS - 1;
    let choice = format!("switch u32(input(k, {last}u)) {{\n{choices}default: {{}}\n}}\n");
    format!("{functions}fn row(k: u32) {{\n{choice}}}\n")
}

#[test]
fn corpus_conforms_on_the_driver() {
    let Some(gpu) = gpu_or_skip() else { return };
    let cases = corpus::cases();
    let driver = Driver::new(&gpu, &cases, |text| text);
    let report = corpus::check(&driver.name, |case| driver.evaluate(case), &SHADER, &cases);
    println!("{report}");
    assert!(report.failures.is_empty(), "{report}");
    assert_eq!(report.cases(), cases.len(), "every case is asserted or declared skipped");
    assert!(report.asserted >= 800, "{} cases", report.asserted);
}

/// Wrong derivatives fail on the driver too: one of eight formulas, at one place each.
#[test]
fn wrong_derivatives_fail_on_the_driver() {
    let Some(gpu) = gpu_or_skip() else { return };
    let mut cases = corpus::cases();
    cases.retain(tells_wrong_derivative);
    cases.dedup_by(|a, b| same_formula(a, b));
    let cases: Vec<FormulaCase> = cases.into_iter().step_by(8).collect();
    let driver = Driver::new(&gpu, &cases, with_wrong_derivative);
    let report = corpus::check(&driver.name, |case| driver.evaluate(case), &SHADER, &cases);
    assert!(cases.len() >= 30, "{} cases", cases.len());
    assert_eq!(report.failures.len(), cases.len());
}

/// Compilers keep the accuracy of the prelude's functions: none puts the parts of its
/// constants together.
#[test]
fn functions_are_accurate_on_the_driver() {
    let Some(gpu) = gpu_or_skip() else { return };
    let (mut text, mut rows) = (wgsl_prelude().to_owned(), Vec::new());
    let mut choices = String::new();
    for (k, function) in (0u8..).zip(&ELEMENTARY) {
        text += &function.jets(0).wgsl(&format!("formula_{k}"));
        choices += &format!("case {k}u: {{ put(k, 0u, formula_{k}(input(k, 0u))[0]); }}\n");
        rows.extend(function.arguments(2000).into_iter().map(|a| [a, f32::from(k)]));
    }
    text += &format!("fn row(k: u32) {{ switch u32(input(k, 1u)) {{ {choices} default: {{}} }} }}");
    let found = run(&gpu, &text, &[], &rows, 1).expect("the functions run");
    for ([a, k], found) in rows.into_iter().zip(found) {
        ELEMENTARY[k as usize].check(a, found[0]);
    }
}
