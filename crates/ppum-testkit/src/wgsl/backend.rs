//! Texts of WGSL as a back end of the corpus.

use ppum::formula::{FormulaJets, Scope, wgsl_prelude};

use super::Module;
use crate::corpus::backend::{jets, orders, parse};
use crate::corpus::{Backend, Case, Outcome};

/// Single precision at one point: the text of [`FormulaJets::wgsl`] in the interpreter.
///
/// The functions of all cases are made and validated beforehand, in one module.
#[derive(Debug)]
pub struct Shader {
    module: Module,
    /// What the function `formula_0`, `formula_1`, … is of.
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
    pub fn new(cases: &[Case]) -> Result<Self, String> {
        Self::with_edited(cases, |text| text)
    }

    /// The functions of some cases, their texts changed.
    ///
    /// # Errors
    /// When they are not valid.
    ///
    /// # Panics
    /// When a formula cannot be compiled.
    pub fn with_edited(cases: &[Case], edit: impl Fn(String) -> String) -> Result<Self, String> {
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
}

/// What tells the functions of cases apart.
fn key(case: &Case) -> (String, Scope, usize) {
    (case.formula.clone(), case.scope.clone(), case.expected.len())
}

fn jets_of(case: &Case) -> FormulaJets {
    jets(case, &parse(case))
}

impl Backend for Shader {
    fn name(&self) -> &str {
        "WGSL, interpreted"
    }

    fn evaluate(&mut self, case: &Case) -> Outcome {
        let Some(index) = self.formulas.iter().position(|known| *known == key(case)) else {
            return Outcome::Skipped("not among the functions".to_owned());
        };
        let inputs: Vec<f32> = case.inputs.iter().map(|&input| input as f32).collect();
        let out = self.module.call(&format!("formula_{index}"), &inputs);
        let out = out.unwrap_or_else(|error| panic!("{}: {error}", case.place));
        let out: Vec<f64> = out.into_iter().map(f64::from).collect();
        Outcome::Results(orders(case, &out))
    }
}
