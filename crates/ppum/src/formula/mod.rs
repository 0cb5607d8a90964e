//! temporary
#![allow(missing_docs)]
#[derive(Clone, Debug)]
pub struct FormulaJet;
#[derive(Debug, thiserror::Error)]
#[error("x")]
pub struct FormulaError;
pub struct Scope;
pub struct Formula;
impl Scope {
    pub fn polar() -> Self {
        Scope
    }
    pub fn with_parameter(self, _: &str, _: f64) -> Self {
        self
    }
}
impl Formula {
    pub fn parse(_: &str, _: &Scope) -> Result<Self, FormulaError> {
        Err(FormulaError)
    }
    pub fn jet(&self) -> FormulaJet {
        FormulaJet
    }
}
impl FormulaJet {
    pub fn evaluate(&self, _: &[f64], _: &mut Vec<f64>) -> [f64; 6] {
        [0.0; 6]
    }
}
