//! Quantities given by formulas.

use std::sync::Arc;

use crate::dataset::NamedQuantity;
use crate::equation::Equation;
use crate::field::Field;
use crate::library::{Definition, ELASTICITY, POISSON};
use ppum_formula::real::Real;
use ppum_formula::{
    DerivativeError, Formula, FormulaError, FormulaJets, Scope, ScopeError, Table, one_line,
};

use super::{Sample, Source};

/// The names that formulas of quantities may use.
#[derive(Clone, Copy, Debug)]
pub struct Vocabulary<'a> {
    /// The equation.
    pub equation: &'a Equation,
    /// The components of the field.
    pub components: &'a [String],
    /// The tables.
    pub tables: &'a [Arc<Table>],
    /// Named quantities, each of which may use those before it.
    pub named: &'a [NamedQuantity],
}

impl<'a> Vocabulary<'a> {
    /// The names that quantities of a field may use.
    #[must_use]
    pub fn of(field: &Field<'a>) -> Self {
        Self {
            equation: field.equation,
            components: &field.data.components,
            tables: field.tables,
            named: field.quantities,
        }
    }
}

/// A quantity as a formula, e.g. `sqrt(ux^2 + uy^2)` or `sxx - young*exx`.
///
/// It may use the position `x`, `y`; the components and derivatives of the field, `ux`, `dux_dx`, …;
/// the constants of the equation, `young`, `poisson`, `mu`, `lambda`, `out_of_plane` (= σ_zz /
/// (σ_xx + σ_yy)) or `conductivity`; the [library's](crate::library::ELASTICITY) quantities, `-` in
/// names written as `_`; the dataset's named quantities and tables.
#[derive(Clone, Debug)]
pub struct QuantityFormula {
    name: Option<String>,
    unit: String,
    formula: Formula,
    jets: FormulaJets,
    /// Of the scope's inputs, those the formula needs.
    inputs: Vec<(usize, Input)>,
    n_inputs: usize,
}

/// A formula that is no quantity.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(transparent)]
#[non_exhaustive]
pub enum QuantityFormulaError {
    /// Its text.
    Formula(#[from] FormulaError),
    /// Names that clash.
    Scope(#[from] ScopeError),
    /// Its size.
    Derivative(#[from] DerivativeError),
}

/// The origin of an input of a quantity's formula.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input {
    /// The position's first coordinate.
    X,
    /// Its second one.
    Y,
    /// E
    Young,
    /// ν
    Poisson,
    /// μ
    Mu,
    /// λ of the plane law.
    Lambda,
    /// σ_zz / (σ_xx + σ_yy)
    OutOfPlane,
    /// κ of Poisson's equation.
    Conductivity,
    /// u_c
    Value(usize),
    /// ∂u_c/∂x
    SlopeX(usize),
    /// ∂u_c/∂y
    SlopeY(usize),
}

const ELASTIC_CONSTANTS: [(&str, Input); 5] = [
    ("young", Input::Young),
    ("poisson", Input::Poisson),
    ("mu", Input::Mu),
    ("lambda", Input::Lambda),
    ("out_of_plane", Input::OutOfPlane),
];

impl<'a> Vocabulary<'a> {
    /// The inputs of a formula.
    fn inputs(&self) -> Vec<(String, Input)> {
        let constants = match self.equation.elastic() {
            Some(_) => ELASTIC_CONSTANTS.as_slice(),
            None => &[("conductivity", Input::Conductivity)],
        };
        let fixed = [("x", Input::X), ("y", Input::Y)].into_iter().chain(constants.iter().copied());
        let mut all: Vec<_> = fixed.map(|(name, input)| (name.to_owned(), input)).collect();
        for (c, name) in self.components.iter().enumerate() {
            all.push((name.clone(), Input::Value(c)));
            all.push((format!("d{name}_dx"), Input::SlopeX(c)));
            all.push((format!("d{name}_dy"), Input::SlopeY(c)));
        }
        // A component of a file may be called anything.
        let mut known: Vec<(String, Input)> = Vec::new();
        for (name, input) in all {
            let is_new = known.iter().all(|(other, _)| *other != name);
            if is_new && Scope::new(&[&name]).is_ok() {
                known.push((name, input));
            }
        }
        known
    }

    /// All names that formulas may use, but for those of the language.
    pub fn names(&self) -> impl Iterator<Item = String> {
        let inputs = self.inputs().into_iter().map(|(name, _)| name);
        inputs.chain(self.definitions().map(|(name, _)| name))
    }

    /// The input of a formula by its name; `None` for names that are no inputs.
    #[must_use]
    pub fn input(&self, name: &str) -> Option<Input> {
        self.inputs().into_iter().find(|(known, _)| known == name).map(|(_, input)| input)
    }

    /// The text behind the name of a quantity of the library or of the dataset, with `-` or `_`.
    #[must_use]
    pub fn definition(&self, name: &str) -> Option<&'a str> {
        let name = name.replace('-', "_");
        self.definitions().find(|(known, _)| *known == name).map(|(_, text)| text)
    }

    /// The quantities of the library and of the dataset: names and texts.
    fn definitions(&self) -> impl Iterator<Item = (String, &'a str)> {
        let library: &[Definition] = match (self.equation, self.components) {
            (Equation::Elasticity(_), [x, y]) if x == "ux" && y == "uy" => &ELASTICITY,
            (Equation::Poisson { .. }, [u]) if u == "u" => &POISSON,
            _ => &[],
        };
        let library = library.iter().map(|&(name, text)| (name.to_owned(), text));
        let named = self.named.iter().map(|q| (q.name.replace('-', "_"), q.text.as_str()));
        library.chain(named)
    }
}

impl QuantityFormula {
    /// The quantity of a text.
    ///
    /// # Errors
    /// The text is no formula of the vocabulary; the error points at the place.
    pub fn new(text: &str, vocabulary: &Vocabulary<'_>) -> Result<Self, QuantityFormulaError> {
        let inputs = vocabulary.inputs();
        let texts: Vec<_> = vocabulary.definitions().collect();
        let names: Vec<_> = inputs
            .iter()
            .map(|(name, _)| name.as_str())
            .chain(texts.iter().map(|(name, _)| name.as_str()))
            .collect();
        let scope = Scope::new(&names)?.with_tables(vocabulary.tables)?;
        let parse = |(_, text): &(String, &str)| Formula::parse(text, &scope);
        let parsed = texts.iter().map(parse).collect::<Result<Vec<_>, FormulaError>>()?;
        let definitions: Vec<_> = texts
            .iter()
            .zip(&parsed)
            .map(|((name, _), formula)| (name.as_str(), formula))
            .collect();
        let formula = Formula::parse(text, &scope)?.substitute(&definitions)?;
        let used = |(index, (name, input)): (usize, &(String, Input))| {
            formula.uses(name).then_some((index, *input))
        };
        Ok(Self {
            name: None,
            unit: String::new(),
            jets: FormulaJets::new(&[&formula], 0)?,
            inputs: inputs.iter().enumerate().filter_map(used).collect(),
            n_inputs: names.len(),
            formula,
        })
    }

    /// The quantity with a name and a unit for labels.
    #[must_use]
    pub fn named(self, name: &str, unit: &str) -> Self {
        Self { name: Some(name.to_owned()), unit: unit.to_owned(), ..self }
    }

    /// Its name, or its text on one line if it has none.
    #[must_use]
    pub fn label(&self) -> String {
        self.name.clone().unwrap_or_else(|| one_line(self.formula.text()))
    }

    /// The formula, of components, derivatives and constants: other quantities that its text names
    /// are put in.
    #[must_use]
    pub fn formula(&self) -> &Formula {
        &self.formula
    }

    /// Its unit; may be empty.
    #[must_use]
    pub fn unit(&self) -> &str {
        &self.unit
    }

    /// Of the scope's inputs those that the formula needs: their indices and origins.
    pub(super) fn inputs(&self) -> &[(usize, Input)] {
        &self.inputs
    }

    pub(super) fn source(&self) -> Source {
        let slopes =
            |(_, input): &(usize, Input)| matches!(input, Input::SlopeX(_) | Input::SlopeY(_));
        if self.inputs.iter().any(slopes) { Source::Gradient } else { Source::Values }
    }

    /// The value; +∞ where the field has no gradient but the formula needs it.
    #[inline(always)]
    pub(super) fn evaluate<R: Real>(&self, at: &Sample<'_, R>) -> R {
        let lanes: Vec<_> = self.inputs.iter().map(|(_, input)| input.value(at).lanes()).collect();
        let (mut values, mut scratch) = (vec![0.0; self.n_inputs], Vec::new());
        let value = at.offset[0].with_lanes(|lane| {
            for ((index, _), lanes) in self.inputs.iter().zip(&lanes) {
                values[*index] = lanes[lane];
            }
            let mut value = [0.0];
            self.jets.evaluate(&values, &mut scratch, &mut value);
            value[0]
        });
        if self.source() == Source::Gradient { at.apart(value) } else { value }
    }
}

/// Formulas are equal when their texts and names are.
impl PartialEq for QuantityFormula {
    fn eq(&self, other: &Self) -> bool {
        (&self.name, &self.formula) == (&other.name, &other.formula)
    }
}

impl Input {
    #[inline(always)]
    pub(super) fn value<R: Real>(self, at: &Sample<'_, R>) -> R {
        match self {
            Self::X => at.offset[0] + at.offset[0].lit(at.anchor.x),
            Self::Y => at.offset[1] + at.offset[1].lit(at.anchor.y),
            Self::Young => at.moduli.young,
            Self::Poisson => at.moduli.poisson,
            Self::Mu => at.moduli.mu,
            Self::Lambda => at.moduli.lambda,
            Self::OutOfPlane => at.moduli.out_of_plane,
            Self::Conductivity => at.moduli.conductivity,
            Self::Value(c) => at.jets[c].v,
            Self::SlopeX(c) => at.jets[c].x,
            Self::SlopeY(c) => at.jets[c].y,
        }
    }
}
