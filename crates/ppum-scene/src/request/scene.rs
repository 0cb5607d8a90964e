//! All that is chosen for one image, except for its place: what of the dataset, which quantity,
//! which colours, what over them.

use std::borrow::Cow;

use ppum::dataset::Dataset;
use ppum::decompose::UnknownPart;
use ppum::quantity::{QuantityFormula, QuantityFormulaError, Vocabulary};
use ppum::replace::{Replacements, ReplacementsError};
use ppum::text::hint;
use serde::{Deserialize, Serialize};

use crate::request::colors::ColorOptions;
use crate::request::magnification::Magnification;
use crate::request::mirror::{Mirror, MirrorError};
use crate::request::overlays::Overlays;

/// The content of an image. The program chooses what is left out: the last step, the whole field,
/// its own functions and weight, von Mises' stress or the potential.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[serde(default)]
pub struct SceneRequest {
    /// The chosen subject of the dataset; programs read the formulas of its options.
    #[cfg_attr(feature = "clap", arg(skip))]
    pub subject: Subject,
    /// A quantity, a formula of quantities, or a value of cells.
    #[cfg_attr(feature = "clap", arg(skip))]
    pub quantity: Option<String>,
    /// The way values become colours.
    #[cfg_attr(feature = "clap", command(flatten))]
    pub colors: ColorOptions,
    /// The overlays over the colours.
    #[cfg_attr(feature = "clap", command(flatten))]
    pub overlays: Overlays,
    /// Draw the deformed body, with displacements times this factor; auto makes the largest one
    /// some 5 % of the body's size
    #[cfg_attr(
        feature = "clap",
        arg(long, value_name = "FACTOR|auto", allow_hyphen_values = true)
    )]
    pub deformed: Option<Magnification>,
    /// Draw the outline of the undeformed body too, dashed
    #[cfg_attr(feature = "clap", arg(long, requires = "deformed"))]
    pub outline: bool,
    /// Draw the full body of a half or quarter model: mirrored at the symmetry edges of its problem
    /// (auto), or at these edges, with `:antisymmetric` after those of an antisymmetric field
    /// [default: in figures of a body of revolution its axis, else none]
    #[cfg_attr(
        feature = "clap",
        arg(long, value_name = "auto|none|EDGE,…", num_args = 0..=1, require_equals = true),
        arg(default_missing_value = "auto")
    )]
    pub mirror: Option<Mirror>,
}

impl SceneRequest {
    /// Returns the scene without settings that have no effect in it: the outline of a body that is
    /// not deformed, labels without isolines.
    #[must_use]
    pub fn settled(&self) -> Self {
        let mut settled = self.clone();
        settled.outline &= self.deformed.is_some();
        settled.overlays.level_labels &= self.overlays.isolines.is_some();
        settled
    }

    /// Returns the scene with the edges named at which a dataset's body is mirrored.
    ///
    /// # Errors
    /// As [`Mirror::edges`].
    pub fn with_edges(self, dataset: &Dataset) -> Result<Self, MirrorError> {
        let edges = |mirror: &Mirror| mirror.edges(dataset).map(Mirror::Edges);
        let mirror = self.mirror.as_ref().map(edges).transpose()?;
        let mirror = mirror.filter(|mirror| *mirror != Mirror::NONE);
        Ok(Self { mirror, ..self })
    }

    /// Returns the scene without overlays that cannot be drawn: a deformed body has only some.
    #[must_use]
    pub fn drawn(&self) -> Self {
        let overlays = match self.deformed {
            Some(_) => self.overlays.deformable(),
            None => self.overlays.clone(),
        };
        Self { overlays, ..self.clone() }
    }
}

/// The chosen part of a dataset: a step, a part of its field, functions and the weight replaced.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Subject {
    /// Number of the step, from 0.
    pub step: Option<usize>,
    /// `smooth`, `jump`, `tip`, `other` or `patch:N`.
    pub part: Option<String>,
    /// Functions by name or number, and formulas in their place.
    pub functions: Vec<(String, String)>,
    /// The weight: one of the library, or a formula of t.
    pub weight: Option<String>,
    /// Quantities that the dataset names, and formulas in the place of theirs.
    pub quantities: Vec<(String, String)>,
}

/// A subject that a dataset does not have.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SubjectError {
    /// No word for a part.
    #[error(transparent)]
    Part(#[from] UnknownPart),
    /// A part that the step does not have, or a replacement that does not fit.
    #[error(transparent)]
    Replacements(#[from] ReplacementsError),
    /// A quantity that the dataset does not name.
    #[error("the dataset names no quantity `{name}`{hint}; it names {known}")]
    Unnamed {
        /// The name.
        name: String,
        /// A suggestion, if a known name is similar, see [`hint`].
        hint: String,
        /// The names there are.
        known: String,
    },
    /// A formula that is no quantity.
    #[error("quantity {name}: {error}")]
    Quantity {
        /// The name.
        name: String,
        /// The reason.
        #[source]
        error: Box<QuantityFormulaError>,
    },
}

/// Gives a quantity that a dataset names another formula, which may use the quantities before it.
///
/// # Errors
/// No such name; a text that is no quantity of the step's field. Nothing has changed then.
pub fn define(
    dataset: &mut Dataset,
    step: usize,
    name: &str,
    text: &str,
) -> Result<(), SubjectError> {
    let Dataset { quantities, equation, tables, steps, .. } = dataset;
    let Some(at) = quantities.iter().position(|named| named.name == name) else {
        let names: Vec<&str> = quantities.iter().map(|named| named.name.as_str()).collect();
        let known = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
        let hint = hint(name, names.iter().copied());
        return Err(SubjectError::Unnamed { name: name.to_owned(), hint, known });
    };
    let field = steps.get(step).and_then(|step| step.fields.first());
    let components = field.map_or(&[][..], |field| &field.components);
    let vocabulary = Vocabulary { equation, components, tables, named: &quantities[..at] };
    QuantityFormula::new(text, &vocabulary).map_err(|error| SubjectError::Quantity {
        name: name.to_owned(),
        error: Box::new(error),
    })?;
    text.clone_into(&mut quantities[at].text);
    Ok(())
}

impl Subject {
    /// The formula in the place of a function, by the name that it was replaced by.
    #[must_use]
    pub fn replaced(&self, which: &str) -> Option<&str> {
        given(&self.functions, which)
    }

    /// Puts a formula in the place of a function, or gives that of the dataset back.
    pub fn replace(&mut self, which: &str, text: Option<String>) {
        give(&mut self.functions, which, text);
    }

    /// The formula in the place of that of a named quantity.
    #[must_use]
    pub fn defined(&self, name: &str) -> Option<&str> {
        given(&self.quantities, name)
    }

    /// Puts a formula in the place of that of a named quantity, or gives that of the dataset back.
    pub fn define(&mut self, name: &str, text: Option<String>) {
        give(&mut self.quantities, name, text);
    }

    /// The number of the step in a dataset.
    #[must_use]
    pub fn step_of(&self, dataset: &Dataset) -> usize {
        self.step.unwrap_or(dataset.steps.len().saturating_sub(1))
    }

    /// True if nothing of the dataset is changed.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.part.is_none()
            && self.functions.is_empty()
            && self.weight.is_none()
            && self.quantities.is_empty()
    }

    /// The dataset as it is looked at, a changed copy if it is not whole.
    ///
    /// # Errors
    /// As [`Self::apply`].
    pub fn applied<'d>(&self, dataset: &'d Dataset) -> Result<Cow<'d, Dataset>, SubjectError> {
        let mut dataset = Cow::Borrowed(dataset);
        if !self.is_whole() {
            self.apply(dataset.to_mut())?;
        }
        Ok(dataset)
    }

    /// Changes a dataset to what is looked at.
    ///
    /// # Errors
    /// Features that the dataset does not have; formulas that are wrong.
    pub fn apply(&self, dataset: &mut Dataset) -> Result<(), SubjectError> {
        if self.is_whole() {
            return Ok(());
        }
        let replacements = Replacements {
            part: self.part.as_deref().map(str::parse).transpose()?,
            functions: self.functions.clone(),
            weight: self.weight.clone(),
        };
        let step = self.step_of(dataset);
        replacements.apply(dataset, step)?;
        let mut quantities = self.quantities.iter();
        quantities.try_for_each(|(name, text)| define(dataset, step, name, text))
    }
}

fn given<'a>(texts: &'a [(String, String)], name: &str) -> Option<&'a str> {
    texts.iter().find(|(known, _)| known == name).map(|(_, text)| text.as_str())
}

/// Gives something a text, or none; in one order, whatever the order of changes, since subjects
/// are compared.
fn give(texts: &mut Vec<(String, String)>, name: &str, text: Option<String>) {
    texts.retain(|(known, _)| known != name);
    texts.extend(text.map(|text| (name.to_owned(), text)));
    texts.sort();
}
