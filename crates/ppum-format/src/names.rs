//! The words the format uses for the data model's enumerations.

use ppum::crack::{CrackEnd, End};
use ppum::dataset::StressState;

/// Words of a closed set of values.
pub(crate) type Words<T> = [(T, &'static str)];

pub(crate) const STRESS_STATES: &Words<StressState> =
    &[(StressState::PlaneStrain, "plane-strain"), (StressState::PlaneStress, "plane-stress")];

pub(crate) const CRACK_ENDS: &Words<CrackEnd> =
    &[(CrackEnd::Tip, "tip"), (CrackEnd::Mouth, "mouth"), (CrackEnd::Junction, "junction")];

pub(crate) const ENDS: &Words<End> = &[(End::Start, "start"), (End::Last, "last")];

/// Kinds of the domain: readers of files before 1.2 know the first alone.
pub(crate) const PLAIN_BOX: &str = "box";
pub(crate) const BOX_WITH_HOLES: &str = "box-with-holes";

/// Kinds of holes.
pub(crate) const CIRCLE: &str = "circle";
pub(crate) const POLYGON: &str = "polygon";

/// The word of a value, if the format has one.
pub(crate) fn word<T: PartialEq>(words: &Words<T>, value: T) -> Option<&'static str> {
    words.iter().find(|(v, _)| *v == value).map(|(_, word)| *word)
}

/// The value of a word.
///
/// # Errors
///
/// A message that lists the words known here.
pub(crate) fn value<T: Copy>(words: &Words<T>, word: &str) -> Result<T, String> {
    words.iter().find(|(_, w)| *w == word).map(|(v, _)| *v).ok_or_else(|| {
        let known: Vec<&str> = words.iter().map(|(_, w)| *w).collect();
        format!("unknown word `{word}`, expected one of: {}", known.join(", "))
    })
}
