//! Quantities given by formulas of other quantities.

use std::sync::Arc;

use crate::equation::Equation;
use crate::field::Field;
use crate::formula::{Formula, Scope, Table};
use crate::real::{Real, Scalar};

use super::{Quantity, QuantityError, Sample, Source, names};

/// A quantity that a dataset names: the text of a [`QuantityFormula`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedQuantity {
    /// Its name, one that no built-in quantity has: letters, digits, `_` and `-`, a letter or `_` first.
    pub name: String,
    /// The formula.
    pub text: String,
    /// Unit for labels; may be empty.
    pub unit: String,
}

/// A quantity as a formula, e.g. `sqrt(ux^2 + uy^2)` or `sxx - young*exx`.
///
/// It may use the position `x`, `y`; the components and derivatives of the field; every named
/// quantity that is made of values and gradients, `-` written as `_` (`von_mises`); the constants of
/// the equation: `young`, `poisson`, `mu`, `lambda`, or `conductivity`; the dataset's tables, whose
/// names come before all these but `x` and `y`.
#[derive(Clone, Debug, PartialEq)]
pub struct QuantityFormula {
    name: Option<String>,
    formula: Formula,
    /// Of the scope's inputs, those the formula needs.
    inputs: Vec<(usize, Input)>,
    n_inputs: usize,
}

/// What an input of a formula is.
#[derive(Clone, Debug, PartialEq)]
enum Input {
    X,
    Y,
    Young,
    Poisson,
    Mu,
    Lambda,
    Conductivity,
    Quantity(Quantity),
}

/// What a formula of quantities may use: the inputs, and the scope of their names in their order.
fn inputs(
    equation: &Equation,
    components: &[String],
    tables: &[Arc<Table>],
) -> Result<(Vec<Input>, Scope), QuantityError> {
    let mut all = vec![("x".to_owned(), Input::X), ("y".to_owned(), Input::Y)];
    let elastic = [
        ("young", Input::Young),
        ("poisson", Input::Poisson),
        ("mu", Input::Mu),
        ("lambda", Input::Lambda),
    ];
    let constants = match equation.elastic() {
        Some(_) => elastic.to_vec(),
        None => vec![("conductivity", Input::Conductivity)],
    };
    let named = names(equation, components).into_iter();
    let named = named.filter(|(_, q)| matches!(q.source(), Source::Values | Source::Gradient));
    all.extend(constants.into_iter().map(|(name, input)| (name.to_owned(), input)));
    all.extend(named.map(|(name, q)| (name.replace('-', "_"), Input::Quantity(q))));
    // A component from a file may be called anything, also like a table.
    let plane = Scope::cartesian().with_tables(tables)?;
    let mut known: Vec<(String, Input)> = Vec::new();
    for (name, input) in all {
        let is_new = known.iter().all(|(other, _)| *other != name);
        let is_free = matches!(input, Input::X | Input::Y) || plane.allows(&name);
        if is_new && is_free {
            known.push((name, input));
        }
    }
    let names: Vec<_> = known.iter().map(|(name, _)| name.as_str()).collect();
    let scope = Scope::new(&names)?.with_tables(tables)?;
    Ok((known.into_iter().map(|(_, input)| input).collect(), scope))
}

impl QuantityFormula {
    /// Parses a formula of quantities of a field.
    ///
    /// # Errors
    /// The text is no formula of the names; the error points at the place.
    pub fn parse(name: Option<&str>, text: &str, field: &Field<'_>) -> Result<Self, QuantityError> {
        Self::parse_for(name, text, field.equation, &field.data.components, field.tables)
    }

    /// Parses a formula of quantities of fields with these components.
    ///
    /// # Errors
    /// As [`parse`](Self::parse).
    pub(crate) fn parse_for(
        name: Option<&str>,
        text: &str,
        equation: &Equation,
        components: &[String],
        tables: &[Arc<Table>],
    ) -> Result<Self, QuantityError> {
        let (all, scope) = inputs(equation, components, tables)?;
        let formula = Formula::parse(text, &scope)?;
        let n_inputs = all.len();
        let used = scope.inputs().zip(all).enumerate().filter(|(_, (name, _))| formula.uses(name));
        let inputs = used.map(|(index, (_, input))| (index, input)).collect();
        Ok(Self { name: name.map(str::to_owned), formula, inputs, n_inputs })
    }

    /// Its name, or its text if it has none.
    #[must_use]
    pub fn label(&self) -> &str {
        self.name.as_deref().unwrap_or(self.formula.text())
    }

    /// The formula.
    #[must_use]
    pub fn formula(&self) -> &Formula {
        &self.formula
    }

    pub(super) fn source(&self) -> Source {
        let of_gradient = |(_, input): &(usize, Input)| match input {
            Input::Quantity(quantity) => quantity.source() == Source::Gradient,
            _ => false,
        };
        if self.inputs.iter().any(of_gradient) { Source::Gradient } else { Source::Values }
    }

    /// The value; +∞ where the field has no gradient but the formula needs it.
    pub(super) fn evaluate<R: Real>(&self, at: &Sample<'_, R>) -> R {
        // 16 lanes are the widest vector there is.
        let mut out = [R::Scalar::default(); 16];
        let mut lanes = vec![[R::Scalar::default(); 16]; self.inputs.len()];
        for ((_, input), lanes) in self.inputs.iter().zip(&mut lanes) {
            input.value(at).store(lanes);
        }
        let (mut values, mut scratch) = (vec![0.0; self.n_inputs], Vec::new());
        for (lane, out) in out.iter_mut().enumerate().take(R::LANES) {
            for ((index, _), lanes) in self.inputs.iter().zip(&lanes) {
                values[*index] = lanes[lane].to_f64();
            }
            *out = R::Scalar::from_f64(self.formula.evaluate_with(&values, &mut scratch));
        }
        let value = at.offset[0].load(&out);
        if self.source() != Source::Gradient {
            return value;
        }
        let slope = at.jets[0].x;
        R::select(slope.ge(slope), value, value.lit(f64::INFINITY))
    }
}

impl Input {
    fn value<R: Real>(&self, at: &Sample<'_, R>) -> R {
        match self {
            Self::X => at.offset[0] + at.offset[0].lit(at.anchor.x),
            Self::Y => at.offset[1] + at.offset[1].lit(at.anchor.y),
            Self::Young => at.moduli.young,
            Self::Poisson => at.moduli.poisson,
            Self::Mu => at.moduli.mu,
            Self::Lambda => at.moduli.lambda,
            Self::Conductivity => at.moduli.conductivity,
            Self::Quantity(quantity) => quantity.of_field(at),
        }
    }
}
