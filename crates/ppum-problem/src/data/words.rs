//! Values that have names in problem files.

use ppum::crack::Side;
use ppum::dataset::{Equation, Material, StressState};

/// Values that are written as one of some words.
pub(crate) trait Keyword: Copy + PartialEq + 'static {
    /// All of them, with their words.
    const WORDS: &'static [(&'static str, Self)];

    /// The word of a value.
    fn word(self) -> &'static str {
        Self::WORDS.iter().find(|(_, value)| *value == self).map_or("", |(word, _)| word)
    }
}

/// Values of a type that are written as words.
macro_rules! word_table {
    ($type:ty: $($value:ident $word:literal),*) => {
        impl super::words::Keyword for $type {
            const WORDS: &'static [(&'static str, Self)] = &[$(($word, Self::$value)),*];
        }
    };
}
pub(crate) use word_table;

/// The words of all values.
pub(crate) fn words<T: Keyword>() -> Vec<&'static str> {
    T::WORDS.iter().map(|(word, _)| *word).collect()
}

word_table!(StressState:
    PlaneStrain "plane-strain", PlaneStress "plane-stress", Axisymmetric "axisymmetric");

word_table!(Side: Above "above", Below "below");

/// The kind of equation, which decides what tables may say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EquationKind {
    /// −div σ(u) = f.
    Elasticity,
    /// −div (κ ∇u) = f.
    Poisson,
}

word_table!(EquationKind: Elasticity "elasticity", Poisson "poisson");

impl EquationKind {
    /// Keys of the right-hand side, of the unknown field, and of its Neumann data.
    pub(crate) fn keys(self) -> [&'static str; 3] {
        match self {
            Self::Elasticity => ["body_force", "displacement", "traction"],
            Self::Poisson => ["source", "value", "flux"],
        }
    }

    /// Number of components of the unknown field.
    pub(crate) fn components(self) -> usize {
        self.example().components()
    }

    /// An equation of this kind.
    pub(crate) fn example(self) -> Equation {
        let state = StressState::PlaneStress;
        match self {
            Self::Elasticity => Equation::elasticity(Material { young: 1.0, poisson: 0.0, state }),
            Self::Poisson => Equation::poisson(1.0),
        }
    }
}
