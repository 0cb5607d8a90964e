//! Texts of WGSL as a back end of the corpus.

use ppum::formula::{FormulaJets, Scope, wgsl_prelude};

use super::module::Module;
use crate::corpus::{CaseResult, FormulaCase, SHADER, jets, orders, parse};

/// Single precision at one point: the text of [`FormulaJets::wgsl`] in the interpreter.
///
/// The functions of all cases are made and validated beforehand, in one module.
#[derive(Debug)]
pub struct Shader {
    module: Module,
    /// The formulas of the functions `formula_0`, `formula_1`, ….
    formulas: Vec<(String, Scope, usize)>,
}

impl Shader {
    /// The functions of some cases.
    ///
    /// # Errors
    /// When they are not valid.
    ///
    /// # Panics
    /// When a formula cannot be compiled.
    pub fn new(cases: &[FormulaCase]) -> Result<Self, String> {
        Self::with_edited(cases, |text| text)
    }

    /// The functions of some cases, their texts changed.
    ///
    /// # Errors
    /// When they are not valid.
    ///
    /// # Panics
    /// When a formula cannot be compiled.
    pub fn with_edited(
        cases: &[FormulaCase],
        edit: impl Fn(String) -> String,
    ) -> Result<Self, String> {
        let mut formulas = Vec::new();
        let mut source = wgsl_prelude().to_owned();
        for case in cases {
            let key = key(case);
            if !formulas.contains(&key) {
                let name = format!("formula_{}", formulas.len());
                source += &edit(jets_of(case).wgsl(&name));
                formulas.push(key);
            }
        }
        Ok(Self { module: Module::new(&source)?, formulas })
    }

    /// The results of the function of a case.
    ///
    /// # Errors
    /// When there is none of it.
    ///
    /// # Panics
    /// When the function cannot be run.
    pub fn evaluate(&self, case: &FormulaCase) -> CaseResult {
        let known = self.formulas.iter().position(|known| *known == key(case));
        let index = known.ok_or("not among the functions")?;
        let inputs: Vec<f32> = case.inputs.iter().map(|&input| input as f32).collect();
        let out = self.module.call(&format!("formula_{index}"), &inputs);
        let out = out.unwrap_or_else(|error| panic!("{}: {error}", case.place));
        let out: Vec<f64> = out.into_iter().map(f64::from).collect();
        Ok(orders(case, &out))
    }
}

/// The name that tells the functions of cases apart.
fn key(case: &FormulaCase) -> (String, Scope, usize) {
    (case.formula.clone(), case.scope.clone(), case.expected.len())
}

fn jets_of(case: &FormulaCase) -> FormulaJets {
    jets(case, &parse(case))
}

/// The text of a function whose last result is wrong by more than itself, for tests that must fail.
///
/// # Panics
/// When it is not a text of [`FormulaJets::wgsl`].
#[must_use]
pub fn with_wrong_derivative(text: String) -> String {
    let (before, results) = text.rsplit_once(">(").expect("an array is returned");
    let mut results: Vec<&str> = results.trim_end_matches(");\n}\n").split(", ").collect();
    let last = results.pop().expect("a result");
    let last = format!("{last} + (1.0 + abs({last}))");
    results.push(&last);
    format!("{before}>({});\n}}\n", results.join(", "))
}

/// True if [`with_wrong_derivative`] makes an error of a case that rounding cannot make.
#[must_use]
pub fn tells_wrong_derivative(case: &FormulaCase) -> bool {
    let last = case.expected.len() - 1;
    let expected = case.expected[last][case.expected[last].len() - 1];
    let limit = SHADER.limit(&case.bounds[last], expected);
    last > 0 && case.not_single.is_none() && 1.0 + expected.abs() > 2.0 * limit
}
