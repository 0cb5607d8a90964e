//! The words the format uses for the data model's enumerations.

use ppum::crack::{CrackEnd, End};
use ppum::dataset::{Advance, Fate, GrowthStop, StressState};
use ppum::domain::PolygonSide;
use ppum::mesh::Shape;
use ppum::polynomial::PolynomialSpace;
use ppum::weight::WeightFunction;

/// Words of a closed set of values.
pub(crate) type Words<T> = [(T, &'static str)];

pub(crate) const STRESS_STATES: &Words<StressState> =
    &[(StressState::PlaneStrain, "plane-strain"), (StressState::PlaneStress, "plane-stress")];

#[derive(Clone, Copy, PartialEq)]
pub(crate) enum EquationKind {
    Elasticity,
    Eigenstrain,
    Poisson,
    None,
}

pub(crate) const ELASTICITY: &str = "elasticity";
pub(crate) const EIGENSTRAIN: &str = "eigenstrain";
pub(crate) const POISSON: &str = "poisson";
pub(crate) const NO_EQUATION: &str = "none";

pub(crate) const EQUATIONS: &Words<EquationKind> = &[
    (EquationKind::Elasticity, ELASTICITY),
    (EquationKind::Eigenstrain, EIGENSTRAIN),
    (EquationKind::Poisson, POISSON),
    (EquationKind::None, NO_EQUATION),
];

/// Weight functions that have a name, and none for a formula.
pub(crate) const WEIGHTS: &Words<Option<WeightFunction>> = &[
    (Some(WeightFunction::Linear), "linear"),
    (Some(WeightFunction::Quadratic), "quadratic"),
    (Some(WeightFunction::Cubic), "cubic"),
    (None, "formula"),
];

pub(crate) const CRACK_ENDS: &Words<CrackEnd> =
    &[(CrackEnd::Tip, "tip"), (CrackEnd::Mouth, "mouth"), (CrackEnd::Junction, "junction")];

pub(crate) const ENDS: &Words<End> = &[(End::Start, "start"), (End::Last, "last")];

/// Kinds of the domain: readers of files before 1.2 know the first alone.
pub(crate) const PLAIN_BOX: &str = "box";
pub(crate) const BOX_WITH_HOLES: &str = "box-with-holes";

/// The union of the elements of a mesh, the kind of a domain and of its partitions, and the other
/// kind of partitions.
pub(crate) const MESH: &str = "mesh";
pub(crate) const BOXES: &str = "shepard-box";

/// The level fields of a function that has none.
pub(crate) const NO_LEVELS: [i64; 2] = [-1; 2];

/// Values with numbers, 0, 1, …, and their words in messages.
pub(crate) type Codes<T> = [(T, &'static str)];

pub(crate) const SHAPES: &Codes<Shape> =
    &[(Shape::Triangle, "triangle"), (Shape::Square, "square")];

pub(crate) const SPACES: &Codes<PolynomialSpace> =
    &[(PolynomialSpace::Total, "total degree"), (PolynomialSpace::Tensor, "tensor product")];

/// True where a level field is not negative.
pub(crate) const SIDES: &Codes<bool> = &[(false, "below"), (true, "above")];

/// The number of a value, if the format has one.
pub(crate) fn code<T: PartialEq>(codes: &Codes<T>, value: T) -> Option<u8> {
    codes.iter().position(|(v, _)| *v == value).map(|code| code as u8)
}

/// Kinds of holes: a circle, or what is cut out of a polygon.
pub(crate) const HOLES: &Words<Option<PolygonSide>> = &[
    (None, "circle"),
    (Some(PolygonSide::Inside), "polygon"),
    (Some(PolygonSide::Outside), "outside"),
];

/// What tips do next, but for those that meet something with a number.
pub(crate) const FATES: &Words<Fate> = &[
    (Fate::Grows, "grows"),
    (Fate::LeavesPlate, "leaves-plate"),
    (Fate::Waits, "waits"),
    (Fate::Held, "held"),
    (Fate::Closed, "closed"),
    (Fate::Unknown, "unknown"),
    (Fate::MeetsItself, "meets-itself"),
    (Fate::Joined, "joined"),
];
pub(crate) const MEETS_HOLE: &str = "meets-hole";
pub(crate) const MEETS_CRACK: &str = "meets-crack";

/// What ends a series.
pub(crate) const STOPS: &Words<GrowthStop> = &[
    (GrowthStop::NoTips, "no-tips"),
    (GrowthStop::AllHeld, "all-held"),
    (GrowthStop::Fracture, "fracture"),
    (GrowthStop::PieceComesOff, "piece-comes-off"),
    (GrowthStop::Unsolvable, "unsolvable"),
];

/// A number of an [`Advance`] by its name.
pub(crate) type GrowthNumber = (&'static str, fn(&mut Advance) -> &mut f64);

/// The numbers of tips in `growth`.
pub(crate) const GROWTH_NUMBERS: [GrowthNumber; 6] = [
    ("strength", |t| &mut t.strength),
    ("direction", |t| &mut t.direction),
    ("curvature", |t| &mut t.curvature),
    ("length", |t| &mut t.length),
    ("due", |t| &mut t.due),
    ("extension", |t| &mut t.extension),
];

/// The word of a value, if the format has one.
pub(crate) fn word<T: PartialEq>(words: &Words<T>, value: T) -> Option<&'static str> {
    words.iter().find(|(v, _)| *v == value).map(|(_, word)| *word)
}

/// The value of a word.
///
/// # Errors
///
/// A message that lists the words known here.
pub(crate) fn value<T: Clone>(words: &Words<T>, word: &str) -> Result<T, String> {
    words.iter().find(|(_, w)| *w == word).map(|(v, _)| v.clone()).ok_or_else(|| {
        let known: Vec<&str> = words.iter().map(|(_, w)| *w).collect();
        format!("unknown word `{word}`, expected one of: {}", known.join(", "))
    })
}
