//! One text through parser, derivatives and evaluation.

use std::sync::Arc;

use ppum::formula::{
    BlockScratch, Formula, FormulaError, FormulaJets, Kink, MAX_LENGTH, MAX_NODES, Scope,
    wgsl_prelude,
};
use ppum::real::LaneNumber as Number;

use crate::corpus::tables;
use crate::random::Random;
use crate::wgsl::Module;

/// The scopes texts are tried in, and the points.
#[derive(Debug)]
pub struct Arena {
    scopes: Vec<Scope>,
}

/// The fate of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParseOutcome {
    /// An error with a place.
    Refused,
    /// A formula whose derivatives have too many operations.
    TooLarge,
    /// Evaluated with all derivatives.
    Evaluated,
}

/// Inputs that are likely to make trouble.
const SPICY: [f64; 20] = [
    0.3,
    -0.4,
    1.0,
    -1.0,
    0.0,
    -0.0,
    1e-12,
    1e-150,
    -1e-300,
    5e-324,
    1e8,
    -1e150,
    1e300,
    f64::MAX,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
    std::f64::consts::PI,
    -std::f64::consts::FRAC_PI_2,
    0.5,
];

/// Points a formula is evaluated at.
const POINTS: usize = 4;

/// Longest program whose derivative is printed and parsed again: more takes long, and is
/// no different.
const PRINTED: usize = 4_000;

/// Longest program whose text of WGSL is validated and run.
const SHADED: usize = 400;

/// Most sets whose places are searched: each costs thousands of evaluations.
const SEARCHED: usize = 8;

/// Longest message of an error, in bytes: two lines of a terminal for the source and one for the
/// message, in characters of up to four bytes.
const MESSAGE: usize = 1_000;

/// Parameters of all scopes: the names that formulas of the conformance corpus use.
const PARAMETERS: &str =
    "scale k n a amplitude length lambda mu kappa k1 k2 young poisson ux uy sxx syy sxy";

impl Arena {
    /// Scopes of one variable, of the plane, and of a tip with sides, all with tables
    /// and parameters.
    ///
    /// # Panics
    /// When the corpus' tables are missing.
    #[must_use]
    pub fn new() -> Self {
        let line = Scope::new(&["t"]).expect("a name");
        let plane = Scope::cartesian().with_parameter("t", 0.5).expect("a new name");
        let tip = Scope::polar().with_sides(2).with_parameter("t", 0.5).expect("a new name");
        let scopes = [line, plane, tip].map(|scope| {
            let parameters = (1..).zip(PARAMETERS.split(' '));
            let scope = parameters.fold(scope, |scope, (k, name)| {
                scope.with_parameter(name, f64::from(k) / 4.0).expect("a new name")
            });
            tables().into_iter().fold(scope, |scope, table| {
                scope.with_table(Arc::clone(&table)).expect("a new name")
            })
        });
        Self { scopes: scopes.into() }
    }
}

impl Default for Arena {
    fn default() -> Self {
        Self::new()
    }
}

/// Sends a text through everything: in the first of the scopes where it is a formula, and if there
/// is none, through the errors of all.
///
/// # Errors
/// When a promise is broken: the message says which. Panics and overflows of the stack are for the
/// caller to see.
pub fn survive(text: &str, arena: &Arena, random: &mut Random) -> Result<ParseOutcome, String> {
    for scope in &arena.scopes {
        match Formula::parse(text, scope) {
            Err(error) => check_place(text, &error)?,
            Ok(formula) => return evaluate(&formula, random),
        }
    }
    Ok(ParseOutcome::Refused)
}

/// An error lies in the text and its message is short.
fn check_place(text: &str, error: &FormulaError) -> Result<(), String> {
    let line = text.split('\n').nth(error.line.wrapping_sub(1));
    let length = line.map(|line| line.chars().count());
    let inside = length.is_some_and(|length| (1..=length + 1).contains(&error.column));
    let message = error.to_string();
    if !inside || message.is_empty() || message.len() > MESSAGE {
        return Err(format!("a place outside or a long message: {message}"));
    }
    Ok(())
}

fn evaluate(formula: &Formula, random: &mut Random) -> Result<ParseOutcome, String> {
    let points: Vec<Vec<f64>> = (0..POINTS).map(|_| point(formula.scope(), random)).collect();
    let values: Vec<f64> = points.iter().map(|inputs| formula.evaluate(inputs)).collect();
    analyse(formula);
    let Ok(jets) = FormulaJets::new(&[formula], 2) else {
        return Ok(ParseOutcome::TooLarge);
    };
    if jets.n_operations() > MAX_NODES + MAX_NODES / 4 {
        return Err(format!("{} operations", jets.n_operations()));
    }
    let (mut scratch, mut out) = (Vec::new(), vec![0.0; jets.n_outputs()]);
    for (inputs, value) in points.iter().zip(&values) {
        jets.evaluate(inputs, &mut scratch, &mut out);
        same(out[0], *value, "value of the jet")?;
    }
    on_lanes(&jets, &points, &mut scratch)?;
    if jets.n_operations() <= SHADED {
        in_a_shader(&jets, &points)?;
    }
    if jets.n_operations() <= PRINTED {
        check_print(formula)?;
    }
    Ok(ParseOutcome::Evaluated)
}

/// Blocks of both precisions run; in double precision their results are those of single points.
fn on_lanes(jets: &FormulaJets, points: &[Vec<f64>], scratch: &mut Vec<f64>) -> Result<(), String> {
    let doubles = lanes::<f64>(jets, points);
    let _ = lanes::<f32>(jets, points);
    let mut out = vec![0.0; jets.n_outputs()];
    for (inputs, found) in points.iter().zip(doubles) {
        jets.evaluate(inputs, scratch, &mut out);
        for (a, b) in out.iter().zip(found) {
            same(*a, b, "a point and a lane")?;
        }
    }
    Ok(())
}

/// All results at some points of a block.
fn lanes<T: Number>(jets: &FormulaJets, points: &[Vec<f64>]) -> Vec<Vec<T>> {
    let mut scratch = BlockScratch::default();
    let mut block = jets.block::<T>(&mut scratch);
    for index in 0..points[0].len() {
        let input = block.input(index);
        input.fill(T::from_f64(points[0][index]));
        for (to, point) in input.iter_mut().zip(points) {
            *to = T::from_f64(point[index]);
        }
    }
    block.run();
    let at = |place: usize| (0..jets.n_outputs()).map(|k| block.output(k)[place]).collect();
    (0..points.len()).map(at).collect()
}

/// The text of WGSL is valid, and runs.
fn in_a_shader(jets: &FormulaJets, points: &[Vec<f64>]) -> Result<(), String> {
    let source = wgsl_prelude().to_owned() + &jets.wgsl("f");
    let module = Module::new(&source)?;
    for point in points {
        let inputs: Vec<f32> = point.iter().map(|&input| input as f32).collect();
        module.call("f", &inputs)?;
    }
    Ok(())
}

/// Questions to formulas besides their values: any answer will do.
fn analyse(formula: &Formula) {
    let _ = (formula.constant(), formula.singular_at_origin());
    let kinks = formula.kinks();
    let _: Vec<_> = kinks.iter().map(Kink::line).collect();
    let sets = kinks.len() + formula.singularities().len();
    if formula.scope().inputs().count() == 1 && sets <= SEARCHED {
        let _ = formula.breakpoints(0.0, 1.0);
    }
}

/// The text of a derivative is a formula.
fn check_print(formula: &Formula) -> Result<(), String> {
    let scope = formula.scope();
    let variable = scope.inputs().next().expect("all scopes have variables").to_owned();
    let Ok(derivative) = formula.derivative(&variable) else {
        return Ok(());
    };
    let text = derivative.text();
    if text.len() <= MAX_LENGTH {
        Formula::parse(text, scope).map_err(|error| format!("{text}\n{error}"))?;
    }
    Ok(())
}

/// Random numbers for the inputs; often spicy, often the coordinates of one point.
fn point(scope: &Scope, random: &mut Random) -> Vec<f64> {
    let mut number = || match random.below(2) {
        0 => SPICY[random.below(SPICY.len())],
        _ => random.between(-2.0, 2.0),
    };
    let mut inputs: Vec<f64> = scope.inputs().map(|_| number()).collect();
    if scope.inputs().any(|name| name == "theta") && random.below(4) > 0 {
        let (x, y) = (inputs[0], inputs[1]);
        let theta = y.atan2(x);
        inputs[2..6].copy_from_slice(&[
            x.hypot(y),
            theta,
            (theta / 2.0).cos(),
            (theta / 2.0).sin(),
        ]);
        inputs[6..].fill(1.0);
    }
    inputs
}

/// Checks that two numbers agree, or are both NaN.
pub(super) fn same(a: f64, b: f64, what: &str) -> Result<(), String> {
    if a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan() || a == b {
        return Ok(());
    }
    Err(format!("{a:e} and {b:e}: {what}"))
}
