//! The quantity that is drawn as a text of WGSL.
//!
//! A quantity is a formula, one of the library's or the user's, with the constants of the material
//! put in: what is the same everywhere is folded into numbers in double precision. Components,
//! derivatives and norms of any number of components are lines of their own.

use ppum::equation::{Elasticity, Equation, Material, StressState};
use ppum::expression::Expression;
use ppum::field::Field;
use ppum::formula::{Formula, FormulaJets, WgslError};
use ppum::library::{PLANE_STRAIN, PLANE_STRESS};
use ppum::quantity::{Axis, Quantity, QuantityFormula, QuantityInput, Source, Vocabulary, names};

use crate::error::GpuError;

/// Order of the derivatives that a quantity needs: 0 for values, 1 for the gradient.
pub(crate) fn order_of(quantity: &Quantity) -> u32 {
    u32::from(quantity.source() == Source::Gradient)
}

/// The function `quantity(at: Sample) -> f32` with those it calls.
///
/// # Errors
/// `error`, whose difference of nearly equal numbers needs more digits than single precision has;
/// formulas that WGSL cannot hold.
pub(crate) fn quantity_wgsl(field: &Field<'_>, quantity: &Quantity) -> Result<String, GpuError> {
    let components = field.components();
    let all = |member: &'static str| (0..components).map(move |c| lane(c, member));
    Ok(match quantity {
        Quantity::Component(c) => returning("", &lane(usize::from(*c), "v")),
        Quantity::Magnitude => norm("", all("v")),
        Quantity::WeightSum => returning("", "at.weight_sum"),
        Quantity::Overlap => returning("", "at.overlap"),
        Quantity::PartitionFunction(_) => returning("", "at.part"),
        Quantity::Error => return Err(GpuError::NeedsDouble { quantity: "error".to_owned() }),
        Quantity::Formula(formula) => of_formula(formula, field, &Vocabulary::of(field))?,
        Quantity::Derivative(c, Axis::X) => {
            returning(&apart(components), &lane(usize::from(*c), "x"))
        }
        Quantity::Derivative(c, Axis::Y) => {
            returning(&apart(components), &lane(usize::from(*c), "y"))
        }
        Quantity::GradientNorm => norm(&apart(components), all("x").chain(all("y"))),
        Quantity::EnergyDensity if components == 1 => {
            of_library(quantity, field, &Equation::poisson(1.0), &["u"])?
        }
        // of a single component there is no stress
        _ if components < 2 => returning("", "ppum_from_bits(0x7f800000u)"),
        _ if field.equation.elastic().is_some() => {
            of_library(quantity, field, field.equation, field.equation.component_names())?
        }
        _ => of_library(quantity, field, &solid(), &["ux", "uy"])?,
    })
}

/// The equation of the library's quantities of displacements. Its constants are of no account:
/// formulas get those of the field.
fn solid() -> Equation {
    Equation::elasticity(Material { young: 1.0, poisson: 0.0, state: StressState::PlaneStrain })
}

/// The lines before quantities of the gradient: they are infinite where a derivative is, or does
/// not exist.
fn apart(components: usize) -> String {
    let slopes = (0..components).flat_map(|c| [lane(c, "x"), lane(c, "y")]);
    let infinite = |slope| format!("(bitcast<u32>({slope}) & 0x7f800000u) == 0x7f800000u");
    let tests: Vec<String> = slopes.map(|slope| format!("({})", infinite(slope))).collect();
    let infinite = "return ppum_from_bits(0x7f800000u);";
    format!("    if {} {{\n        {infinite}\n    }}\n", tests.join(" | "))
}

/// A function of some lines that returns an expression.
fn returning(lines: &str, value: &str) -> String {
    format!("\nfn quantity(at: Sample) -> f32 {{\n{lines}    return {value};\n}}\n")
}

/// One component's value or derivative.
fn lane(component: usize, member: &str) -> String {
    let lane = ["x", "y", "z", "w"][component % 4];
    format!("at.u[{}].{member}.{lane}", component / 4)
}

/// The function of a Euclidean norm; squares of stresses or of displacements near a tip would leave
/// the range of single precision.
fn norm(before: &str, mut values: impl Iterator<Item = String>) -> String {
    let mut lines = before.to_owned();
    let first = values.next().unwrap_or_else(|| "0.0".to_owned());
    lines += &format!("    var norm = abs({first});\n");
    for value in values {
        lines += &format!("    norm = ppum_hypot(norm, {value});\n");
    }
    returning(&lines, "norm")
}

/// A quantity of the library, of the first components of the field.
fn of_library(
    quantity: &Quantity,
    field: &Field<'_>,
    equation: &Equation,
    components: &[&str],
) -> Result<String, GpuError> {
    let components: Vec<String> = components.iter().map(|&name| name.to_owned()).collect();
    let known = names(equation, &components);
    let (name, _) = known
        .into_iter()
        .find(|(_, known)| known == quantity)
        .ok_or_else(|| GpuError::formula("this quantity", &"it has no formula"))?;
    let of_field = Vocabulary::of(field);
    let vocabulary = Vocabulary { equation, components: &components, named: &[], ..of_field };
    let formula = QuantityFormula::new(&name.replace('-', "_"), &vocabulary)
        .map_err(|error| GpuError::formula(&name, &error))?;
    of_formula(&formula, field, &vocabulary)
}

/// A quantity of a formula of a vocabulary.
fn of_formula(
    formula: &QuantityFormula,
    field: &Field<'_>,
    vocabulary: &Vocabulary<'_>,
) -> Result<String, GpuError> {
    let what = format!("`{}`", formula.label());
    let failed = |error: &dyn std::fmt::Display| GpuError::formula(&what, error);
    let limit = |error: &WgslError| GpuError::limit(&what, error);
    let given = with_constants(formula.formula(), field.equation, vocabulary)
        .map_err(|error| failed(&error))?;
    let jets = FormulaJets::new(&[&given], 0).map_err(|error| failed(&error))?;
    let mut text = jets.wgsl_of_used("quantity_formula").map_err(|error| limit(&error))?;
    let inputs: Vec<_> = given.scope().inputs().collect();
    let used = jets.used().filter_map(|index| vocabulary.input(inputs[index]));
    let arguments: Vec<String> = used.map(argument).collect();
    for (name, expression) in varying(field.equation) {
        if arguments.iter().any(|argument| argument.starts_with(&format!("material_{name}("))) {
            text += &material(name, expression)?;
        }
    }
    let value = format!("quantity_formula({})[0]", arguments.join(", "));
    let needs = Quantity::Formula(std::sync::Arc::new(formula.clone())).source();
    let before = if needs == Source::Gradient { apart(field.components()) } else { String::new() };
    Ok(text + &returning(&before, &value))
}

/// The WGSL of an input of a formula.
fn argument(input: QuantityInput) -> String {
    match input {
        QuantityInput::X => "at.position.x".to_owned(),
        QuantityInput::Y => "at.position.y".to_owned(),
        QuantityInput::Young => "material_young(at.position)".to_owned(),
        QuantityInput::Poisson => "material_poisson(at.position)".to_owned(),
        QuantityInput::Conductivity => "material_conductivity(at.position)".to_owned(),
        QuantityInput::Mu | QuantityInput::Lambda | QuantityInput::OutOfPlane => {
            unreachable!("the moduli are put in as formulas of young and poisson")
        }
        QuantityInput::Value(c) => lane(c, "v"),
        QuantityInput::SlopeX(c) => lane(c, "x"),
        QuantityInput::SlopeY(c) => lane(c, "y"),
    }
}

type QuantityFailure = Box<dyn std::error::Error>;

/// A formula with the constants of the field's equation in place of their names: numbers where they
/// are the same everywhere, and moduli as formulas of E and ν.
fn with_constants(
    formula: &Formula,
    equation: &Equation,
    vocabulary: &Vocabulary<'_>,
) -> Result<Formula, QuantityFailure> {
    let elastic = vocabulary.equation.elastic().is_some();
    let mut formulas = Vec::new();
    for (name, text) in constants(equation, elastic) {
        formulas.push((name, Formula::parse(&text, formula.scope())?));
    }
    let definitions: Vec<_> = formulas.iter().map(|(name, f)| (*name, f)).collect();
    Ok(formula.substitute(&definitions)?)
}

/// The constants of an equation that are no formulas of position, in the words of a vocabulary of
/// elastic or other formulas; zero where the equation has no such constant.
fn constants(equation: &Equation, elastic: bool) -> Vec<(&'static str, String)> {
    let number = |(name, expression): (&'static str, &Expression)| {
        expression.constant().map(|_| (name, expression.text().to_owned()))
    };
    match (equation, elastic) {
        (Equation::Elasticity(Elasticity { state, anisotropy: None, .. }), true) => {
            let texts = match state {
                StressState::PlaneStrain | StressState::Axisymmetric => PLANE_STRAIN,
                StressState::PlaneStress => PLANE_STRESS,
            };
            let moduli = texts.map(|(name, text)| (name, text.to_owned()));
            equation.constants().filter_map(number).chain(moduli).collect()
        }
        (Equation::Poisson { .. }, false) => equation.constants().filter_map(number).collect(),
        (_, true) => ["young", "poisson", "mu", "lambda", "out_of_plane"].map(zero).to_vec(),
        (_, false) => vec![zero("conductivity")],
    }
}

fn zero(name: &'static str) -> (&'static str, String) {
    (name, "0".to_owned())
}

/// The constants of an equation that differ from place to place.
fn varying(equation: &Equation) -> impl Iterator<Item = (&'static str, &Expression)> {
    equation.constants().filter(|(_, expression)| expression.constant().is_none())
}

/// The function of a material constant.
fn material(name: &str, expression: &Expression) -> Result<String, GpuError> {
    let jets = FormulaJets::new(&[expression.formula()], 0)
        .map_err(|error| GpuError::formula(name, &error))?;
    let text = jets
        .wgsl_of_used(&format!("formula_{name}"))
        .map_err(|error| GpuError::limit(name, &error))?;
    let coordinates: Vec<&str> = jets.used().map(|input| ["p.x", "p.y"][input]).collect();
    let call = format!("formula_{name}({})[0]", coordinates.join(", "));
    Ok(format!("{text}\nfn material_{name}(p: vec2<f32>) -> f32 {{\n    return {call};\n}}\n"))
}
