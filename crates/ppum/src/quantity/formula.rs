//! Quantities given by formulas.

use std::borrow::Cow;
use std::sync::Arc;

use super::reflection::Reflection;
use super::sample::{Sample, Source};
use crate::anisotropy::STIFFNESS;
use crate::dataset::NamedQuantity;
use crate::equation::{EIGENSTRAINS, EXPANSION, Equation, Moduli, StressState, TEMPERATURE};
use crate::expression::Expression;
use crate::field::Field;
use crate::library::{
    ANISOTROPY, Definition, EIGENSTRAIN, ELASTICITY, HOOP_STRAIN, POISSON, STRAINS,
};
use ppum_formula::real::{LaneNumber, Real};
use ppum_formula::{
    Block, BlockScratch, DerivativeError, Formula, FormulaError, FormulaJets, Scope, ScopeError,
    Table, one_line,
};

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
/// It may use the position `x`, `y`; the components and derivatives of the field, `ux`, `dux_dx`,
/// …; the constants of the equation, `young`, `poisson`, `mu`, `lambda`, `out_of_plane` (= σ_zz /
/// (σ_xx + σ_yy)) or `conductivity`; the [given strains](crate::equation::EIGENSTRAINS), and
/// `expansion` where the field has a temperature; the [library's](crate::library::ELASTICITY)
/// quantities, of an anisotropic body [its constants](crate::anisotropy::STIFFNESS) in place of
/// those above; `-` in names written as `_`; the dataset's named quantities and tables.
#[derive(Clone, Debug)]
pub struct QuantityFormula {
    name: Option<String>,
    unit: String,
    formula: Formula,
    jets: FormulaJets,
    /// The formula, and what is no number where the field has no gradient, for blocks of points.
    tested: FormulaJets,
    /// The inputs of the scope that the formula needs.
    inputs: Vec<(usize, QuantityInput)>,
    /// Those of them that the field gives, with those that the test needs besides.
    of_field: Vec<(usize, QuantityInput)>,
    n_inputs: usize,
    /// The field that it is a quantity of.
    reflection: Reflection,
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
pub enum QuantityInput {
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

const ELASTIC_CONSTANTS: [(&str, QuantityInput); 5] = [
    ("young", QuantityInput::Young),
    ("poisson", QuantityInput::Poisson),
    ("mu", QuantityInput::Mu),
    ("lambda", QuantityInput::Lambda),
    ("out_of_plane", QuantityInput::OutOfPlane),
];

impl<'a> Vocabulary<'a> {
    /// The inputs of a formula.
    fn inputs(&self) -> Vec<(String, QuantityInput)> {
        let constants = match self.equation {
            Equation::Elasticity(body) if body.anisotropy.is_some() => &[],
            Equation::Elasticity(_) => ELASTIC_CONSTANTS.as_slice(),
            Equation::Poisson { .. } => &[("conductivity", QuantityInput::Conductivity)],
            Equation::None => &[],
        };
        let fixed = [("x", QuantityInput::X), ("y", QuantityInput::Y)]
            .into_iter()
            .chain(constants.iter().copied());
        let mut all: Vec<_> = fixed.map(|(name, input)| (name.to_owned(), input)).collect();
        for (c, name) in self.components.iter().enumerate() {
            all.push((name.clone(), QuantityInput::Value(c)));
            all.push((format!("d{name}_dx"), QuantityInput::SlopeX(c)));
            all.push((format!("d{name}_dy"), QuantityInput::SlopeY(c)));
        }
        // A component of a file may be called anything.
        let mut known: Vec<(String, QuantityInput)> = Vec::new();
        for (name, input) in all {
            let is_new = known.iter().all(|(other, _)| *other != name);
            if is_new && Scope::new(&[&name]).is_ok() {
                known.push((name, input));
            }
        }
        known
    }

    /// Number of the first components that are a vector, 2 or 0; the others are potentials.
    pub(super) fn vector(&self) -> usize {
        let is_heated = self.equation.expansion().is_some()
            && self.components == self.equation.component_names();
        if self.components.len() == 2 || is_heated { 2 } else { 0 }
    }

    /// All names that formulas may use, except those of the language.
    pub fn names(&self) -> impl Iterator<Item = String> {
        let inputs = self.inputs().into_iter().map(|(name, _)| name);
        inputs.chain(self.definitions().map(|(name, _)| name))
    }

    /// The input of a formula by its name; `None` for names that are no inputs.
    #[must_use]
    pub fn input(&self, name: &str) -> Option<QuantityInput> {
        self.inputs().into_iter().find(|(known, _)| known == name).map(|(_, input)| input)
    }

    /// The text behind the name of a quantity of the library or of the dataset, with `-` or `_`.
    #[must_use]
    pub fn definition(&self, name: &str) -> Option<Cow<'a, str>> {
        let name = name.replace('-', "_");
        self.definitions().find(|(known, _)| *known == name).map(|(_, text)| text)
    }

    /// The quantities of the library and of the dataset: names and texts.
    fn definitions(&self) -> impl Iterator<Item = (String, Cow<'a, str>)> {
        let is_solution = self.components == self.equation.component_names();
        let library: [&[Definition]; 2] = match self.equation {
            _ if !is_solution => [&[], &[]],
            Equation::Elasticity(body) if body.anisotropy.is_some() => {
                [&ELASTICITY[..STRAINS], &ANISOTROPY]
            }
            Equation::Elasticity(body)
                if body.eigenstrain.is_some() || body.state == StressState::Axisymmetric =>
            {
                [&ELASTICITY[..STRAINS], &EIGENSTRAIN]
            }
            Equation::Elasticity(_) => [&ELASTICITY, &[]],
            Equation::Poisson { .. } => [&POISSON, &[]],
            Equation::None => [&[], &[]],
        };
        // a dataset may have quantities and tables of these names itself
        let is_free = |name: &str| {
            let mut named = self.named.iter().map(|q| q.name.replace('-', "_"));
            named.all(|known| known != name) && self.tables.iter().all(|table| table.name() != name)
        };
        let is_heat = matches!(self.equation, Equation::Poisson { .. });
        let library = library.into_iter().flatten();
        let library = library.filter(move |(name, _)| !is_heat || is_free(name));
        let is_round = is_solution && self.equation.is_axisymmetric();
        let is_round = is_round && self.equation.elastic().is_some();
        let library = library.map(move |&(name, text)| match (is_round, name) {
            (false, _) => (name.to_owned(), text.into()),
            (_, "divergence") => (name.to_owned(), format!("{text} + {}", HOOP_STRAIN.1).into()),
            // the third direction is that of the hoop
            _ => (name.replace("szz", "shoop"), text.replace("szz", "shoop").into()),
        });
        let hoop = is_round.then(|| (HOOP_STRAIN.0.to_owned(), HOOP_STRAIN.1.into()));
        let named = self.named.iter().map(|q| (q.name.replace('-', "_"), q.text.as_str().into()));
        self.given(is_solution).chain(hoop).chain(library).chain(named)
    }

    /// The coefficient of expansion, the given strains, and the constants of an anisotropic body,
    /// without which its quantities have zeros; strains by a temperature are those of the solution
    /// alone, which has one, and so is the hoop strain of a body of revolution, which plane strain
    /// is less in its third direction.
    fn given(&self, is_solution: bool) -> impl Iterator<Item = (String, Cow<'a, str>)> {
        let expansion = self.equation.expansion().filter(|_| is_solution);
        let state = self.equation.elastic().map(|body| body.state);
        let is_round = is_solution && state == Some(StressState::Axisymmetric);
        let text = move |name: &str, text: &'a str| -> Cow<'a, str> {
            match expansion {
                _ if name == EIGENSTRAINS[3] && state == Some(StressState::PlaneStress) => {
                    "0".into()
                }
                Some(_) if name != EIGENSTRAINS[2] => {
                    format!("{text} + {EXPANSION}*{TEMPERATURE}").into()
                }
                _ => text.into(),
            }
        };
        let owned = |(name, e): (&'static str, &'a Expression)| (name.to_owned(), e.text().into());
        let expansion = expansion.map(|e| owned((EXPANSION, e)));
        let strains = self.equation.eigenstrains().map(|(name, e)| (name, e.text()));
        let mut strains: Vec<(&str, &str)> = strains.collect();
        let stiffness: Vec<_> = self.equation.stiffness().collect();
        let is_anisotropic = self.equation.anisotropy().is_some() && is_solution;
        if strains.is_empty() && (is_round || is_anisotropic) {
            strains.extend(EIGENSTRAINS.map(|name| (name, "0")));
        }
        let zeros = STIFFNESS.into_iter().filter(|_| is_anisotropic);
        let zeros = zeros.filter(|name| stiffness.iter().all(|(known, _)| known != name));
        let zeros: Vec<_> = zeros.map(|name| (name.to_owned(), "0".into())).collect();
        let strains = strains.into_iter().map(move |(name, own)| {
            let text = text(name, own);
            let is_less = is_round && name == EIGENSTRAINS[3];
            let text = if is_less { format!("{text} - {}", HOOP_STRAIN.1).into() } else { text };
            (name.to_owned(), text)
        });
        let stiffness = stiffness.into_iter().map(owned);
        expansion.into_iter().chain(strains).chain(stiffness).chain(zeros)
    }
}

impl QuantityFormula {
    /// The quantity of a text.
    ///
    /// # Errors
    /// The text is no formula of the vocabulary; the error points at the place.
    pub fn new(text: &str, vocabulary: &Vocabulary<'_>) -> Result<Self, QuantityFormulaError> {
        Self::with(text, vocabulary, Reflection::NONE)
    }

    /// The formula of the field that has at Sx what this one has of the reflected field at x: in
    /// the place of positions, components and derivatives stand those of the reflected field.
    ///
    /// # Errors
    /// The text is no formula of the vocabulary.
    pub(super) fn reflected(
        &self,
        vocabulary: &Vocabulary<'_>,
        at: Reflection,
    ) -> Result<Self, QuantityFormulaError> {
        let own = vocabulary.named.iter().position(|named| Some(&named.name) == self.name.as_ref());
        let named = &vocabulary.named[..own.unwrap_or(vocabulary.named.len())];
        let formula = Self::with(self.formula.text(), &Vocabulary { named, ..*vocabulary }, at)?;
        Ok(Self { name: self.name.clone(), unit: self.unit.clone(), ..formula })
    }

    fn with(
        text: &str,
        vocabulary: &Vocabulary<'_>,
        reflection: Reflection,
    ) -> Result<Self, QuantityFormulaError> {
        let inputs = vocabulary.inputs();
        let mut texts: Vec<_> = vocabulary.definitions().collect();
        let reflected = reflected(reflection, &inputs, vocabulary.vector(), &mut texts);
        let names: Vec<_> = inputs
            .iter()
            .map(|(name, _)| name.as_str())
            .chain(texts.iter().map(|(name, _)| name.as_str()))
            .collect();
        let (scope, n_inputs) = (Scope::new(&names)?.with_tables(vocabulary.tables)?, names.len());
        // given strains are known where the field is; all others are made of the reflected field
        let is_given = |name: &str| {
            name == EXPANSION || EIGENSTRAINS.contains(&name) || STIFFNESS.contains(&name)
        };
        let given = texts.iter().take_while(|(name, _)| is_given(name)).count();
        texts.splice(given..given, reflected);
        let parse = |(_, text): &(String, Cow<'_, str>)| Formula::parse(text, &scope);
        let parsed = texts.iter().map(parse).collect::<Result<Vec<_>, FormulaError>>()?;
        let definitions: Vec<_> = texts
            .iter()
            .zip(&parsed)
            .map(|((name, _), formula)| (name.as_str(), formula))
            .collect();
        let formula = Formula::parse(text, &scope)?.substitute(&definitions)?;
        let used = |formula: &Formula| -> Vec<(usize, QuantityInput)> {
            let all = inputs.iter().enumerate();
            all.filter(|(_, (name, _))| formula.uses(name)).map(|(i, (_, of))| (i, *of)).collect()
        };
        let needed = used(&formula);
        let has_slopes = needed.iter().any(|(_, input)| input.is_slope());
        let slopes = inputs.iter().filter(|(_, input)| has_slopes && input.is_slope());
        let zeros: Vec<_> = slopes.map(|(name, _)| format!("0*{name}")).collect();
        let test = if has_slopes { zeros.join(" + ") } else { "0".to_owned() };
        let test = Formula::parse(&test, &scope)?;
        let only_tested = used(&test).into_iter().filter(|input| !needed.contains(input));
        let of_field = needed.iter().copied().filter(|(_, input)| !input.is_modulus());
        let of_field = of_field.chain(only_tested).collect();
        Ok(Self {
            name: None,
            unit: String::new(),
            jets: FormulaJets::new(&[&formula], 0)?,
            tested: FormulaJets::new(&[&formula, &test], 0)?,
            inputs: needed,
            of_field,
            n_inputs,
            reflection,
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

    /// Returns the inputs of the scope that the formula needs: their indices and origins.
    pub(super) fn inputs(&self) -> &[(usize, QuantityInput)] {
        &self.inputs
    }

    pub(super) fn source(&self) -> Source {
        let has_slopes = self.inputs.iter().any(|(_, input)| input.is_slope());
        if has_slopes { Source::Gradient } else { Source::Values }
    }

    /// The value; +∞ where the field has no gradient but the formula needs it.
    #[inline(always)]
    pub(super) fn evaluate<R: Real>(&self, at: &Sample<'_, R>) -> R {
        let mut lanes = Vec::with_capacity(self.inputs.len());
        for (_, input) in &self.inputs {
            lanes.push(input.value(at).lanes());
        }
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

    /// A block of points at which the quantity is to be evaluated.
    pub fn block<'a, T: LaneNumber>(
        &'a self,
        scratch: &'a mut BlockScratch<T>,
    ) -> QuantityBlock<'a, T> {
        QuantityBlock { formula: self, block: self.tested.block(scratch) }
    }
}

/// Definitions of the inputs of formulas that are not as they were, and given strains with
/// their signs.
fn reflected<'a>(
    at: Reflection,
    inputs: &[(String, QuantityInput)],
    vector: usize,
    texts: &mut [(String, Cow<'a, str>)],
) -> Vec<(String, Cow<'a, str>)> {
    if at == Reflection::NONE {
        return Vec::new();
    }
    let [x, y] = at.axes();
    for (name, text) in texts {
        let sign = match &**name {
            name if name == EIGENSTRAINS[2] => x * y * at.sign(),
            name if EIGENSTRAINS.contains(&name) => at.sign(),
            "axis" | "c16" | "c26" | "c36" => x * y,
            _ => 1.0,
        };
        if sign < 0.0 {
            *text = format!("-({text}\n)").into();
        }
    }
    let text = |name: &str, input: QuantityInput| match input {
        QuantityInput::X => at.lines[0].map(|line| format!("({:?}) - {name}", 2.0 * line)),
        QuantityInput::Y => at.lines[1].map(|line| format!("({:?}) - {name}", 2.0 * line)),
        input => input.reflected_sign(&at, vector).filter(|s| *s < 0.0).map(|_| format!("-{name}")),
    };
    let changed = |(name, input): &(String, QuantityInput)| {
        text(name, *input).map(|text| (name.clone(), Cow::Owned(text)))
    };
    inputs.iter().filter_map(changed).collect()
}

/// Points at which a quantity by formula is evaluated together, as many vectors as a [`Block`] has:
/// so that what a step of the formula costs is shared. Give it the field input by input, run it,
/// and take the values.
#[derive(Debug)]
pub struct QuantityBlock<'a, T> {
    formula: &'a QuantityFormula,
    block: Block<'a, T>,
}

impl<'a, T: LaneNumber> QuantityBlock<'a, T> {
    /// Number of vectors.
    #[must_use]
    pub const fn vectors<R: Real<Scalar = T>>() -> usize {
        Block::<T>::POINTS / R::LANES
    }

    /// The inputs that are to be filled with the field's numbers: all but the constants of
    /// the equation.
    #[must_use]
    pub fn field_inputs(&self) -> &'a [(usize, QuantityInput)] {
        &self.formula.of_field
    }

    /// The numbers of an input at all points, vector by vector. They are kept until they are filled
    /// again.
    pub fn input_mut(&mut self, index: usize) -> &mut [T] {
        self.block.input(index)
    }

    /// The constants of the equation at a vector of points. They are kept until they are set again.
    #[inline(always)]
    pub fn set_moduli<R: Real<Scalar = T>>(&mut self, vector: usize, moduli: &Moduli<R>) {
        for &(index, input) in &self.formula.inputs {
            if let Some(value) = input.modulus(moduli) {
                value.store(&mut self.block.input(index)[vector * R::LANES..]);
            }
        }
    }

    /// Evaluates the quantity.
    pub fn run(&mut self) {
        self.block.run();
    }

    /// The values at a vector of points, those
    /// of [`Quantity::of_field`](super::Quantity::of_field).
    #[inline(always)]
    #[must_use]
    pub fn value<R: Real<Scalar = T>>(&self, vector: usize, like: R) -> R {
        let value = like.load(&self.block.output(0)[vector * R::LANES..]);
        let test = like.load(&self.block.output(1)[vector * R::LANES..]);
        R::select(test.ge(test), value, like.broadcast(f64::INFINITY))
    }
}

/// Formulas are equal when their texts, names and fields are.
impl PartialEq for QuantityFormula {
    fn eq(&self, other: &Self) -> bool {
        (&self.name, &self.formula, self.reflection)
            == (&other.name, &other.formula, other.reflection)
    }
}

impl QuantityInput {
    /// The sign of an input of a formula; none of those that are as they were.
    fn reflected_sign(self, at: &Reflection, vector: usize) -> Option<f64> {
        let [x, y] = at.axes();
        Some(match self {
            Self::Value(c) => at.of_component(c, vector),
            Self::SlopeX(c) => at.of_component(c, vector) * x,
            Self::SlopeY(c) => at.of_component(c, vector) * y,
            _ => return None,
        })
    }

    fn is_slope(self) -> bool {
        matches!(self, Self::SlopeX(_) | Self::SlopeY(_))
    }

    #[inline(always)]
    fn is_modulus(self) -> bool {
        use QuantityInput as I;
        matches!(self, I::Young | I::Poisson | I::Mu | I::Lambda | I::OutOfPlane | I::Conductivity)
    }

    /// `None` if it is no constant of an equation.
    #[inline(always)]
    pub(super) fn modulus<R: Copy>(self, moduli: &Moduli<R>) -> Option<R> {
        match self {
            Self::Young => Some(moduli.young),
            Self::Poisson => Some(moduli.poisson),
            Self::Mu => Some(moduli.mu),
            Self::Lambda => Some(moduli.lambda),
            Self::OutOfPlane => Some(moduli.out_of_plane),
            Self::Conductivity => Some(moduli.conductivity),
            Self::X | Self::Y | Self::Value(_) | Self::SlopeX(_) | Self::SlopeY(_) => None,
        }
    }

    #[inline(always)]
    pub(super) fn value<R: Real>(self, at: &Sample<'_, R>) -> R {
        match self {
            Self::X => at.offset[0] + at.offset[0].broadcast(at.anchor.x),
            Self::Y => at.offset[1] + at.offset[1].broadcast(at.anchor.y),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equation::Material;
    use crate::jet::Jet;
    use crate::quantity::Quantity;
    use crate::vec2::{Vec2, vec2};
    use ppum_formula::real::LaneJob;
    use ppum_testkit::random::Random;

    const ANCHOR: Vec2 = vec2(0.3, -2.0);

    fn moduli<R: Real>(like: R) -> Moduli<R> {
        Moduli::new(like.broadcast(1.7), like.broadcast(0.3), StressState::PlaneStrain)
    }

    /// Fields at many points: u_x, ∂u_x/∂x, ∂u_x/∂y, u_y, …; some have no gradient.
    fn fields() -> Vec<[f64; 6]> {
        let mut random = Random(0x7d2c_9a11_0b5e_4f63);
        let mut field = |k: usize| -> [f64; 6] {
            let mut field = std::array::from_fn(|_| random.between(-1.0, 1.0));
            match k % 17 {
                3 => field[2] = f64::INFINITY,
                5 => field[4] = f64::NAN,
                _ => {}
            }
            field
        };
        (0..64).map(&mut field).collect()
    }

    fn jets<R: Real>(like: R, field: impl Fn(usize) -> R) -> [Jet<R>; 2] {
        let zero = Jet::constant(like.broadcast(0.0));
        [0, 3].map(|c| Jet { v: field(c), x: field(c + 1), y: field(c + 2), ..zero })
    }

    /// The values at a block of points.
    struct AtOnce<'a>(&'a QuantityFormula, &'a [[f64; 6]]);

    impl LaneJob<f64> for AtOnce<'_> {
        type Output = Vec<f64>;

        #[inline(always)]
        fn run<R: Real<Scalar = f64>>(self, zero: R) -> Vec<f64> {
            let (mut scratch, mut values) = (BlockScratch::default(), vec![0.0; 64]);
            let mut block = self.0.block(&mut scratch);
            for (vector, fields) in self.1.chunks(R::LANES).enumerate() {
                let jets = jets(zero, |k| zero.with_lanes(|lane| fields[lane][k]));
                let offset = [jets[0].v, jets[1].v];
                let sample = Sample {
                    anchor: ANCHOR,
                    offset,
                    moduli: moduli(zero),
                    jets: &jets,
                    exact: &[],
                };
                for &(index, input) in block.field_inputs() {
                    input.value(&sample).store(&mut block.input_mut(index)[vector * R::LANES..]);
                }
                block.set_moduli(vector, &sample.moduli);
            }
            block.run();
            for (vector, values) in values.chunks_mut(R::LANES).enumerate() {
                block.value(vector, zero).store(values);
            }
            values
        }
    }

    /// A block of points has the values of single points, +∞ where there is no gradient included.
    #[test]
    fn blocks_are_points() {
        use ppum_formula::real::LaneNumber as _;
        let material = Material { young: 1.7, poisson: 0.3, state: StressState::PlaneStrain };
        let (equation, names) = (Equation::elasticity(material), ["ux", "uy"].map(str::to_owned));
        let vocabulary =
            Vocabulary { equation: &equation, components: &names, tables: &[], named: &[] };
        for text in ["von_mises", "dux_dx*exp(y) - young", "sin(x)*ux + uy^2.5", "3"] {
            let formula = Arc::new(QuantityFormula::new(text, &vocabulary).expect("a quantity"));
            let quantity = Quantity::Formula(Arc::clone(&formula));
            let values = f64::dispatch(AtOnce(&formula, &fields()));
            for (value, field) in values.into_iter().zip(fields()) {
                let jets = jets(0.0, |k| field[k]);
                let offset = [jets[0].v, jets[1].v];
                let sample =
                    Sample { anchor: ANCHOR, offset, moduli: moduli(0.0), jets: &jets, exact: &[] };
                let expected = quantity.of_field(&sample);
                let same =
                    value.to_bits() == expected.to_bits() || value.is_nan() && expected.is_nan();
                assert!(same, "{text} of {field:?}: {value:e}, not {expected:e}");
            }
        }
    }
}
