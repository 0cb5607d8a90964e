//! The quantity that an image shows.

use ppum::field::Field;
use ppum::quantity::{Quantity, QuantityError};
use ppum::text::hint;
use ppum_render::cells;

use super::values::RasterValues;

/// A quantity that an image can show.
#[derive(Clone, Debug)]
pub enum DisplayedQuantity {
    /// A quantity, at every point.
    Quantity(Quantity),
    /// One value per patch, on its cell, with its name.
    Cells(String, Vec<f64>),
}

impl DisplayedQuantity {
    /// Parses the quantity of a field that a text names: a quantity or formula; if there is none,
    /// or with `patch:` in front, a value of cells.
    ///
    /// # Errors
    /// A text that means nothing for the field, with the place of a formula's error.
    pub fn parse(text: &str, field: &Field<'_>) -> Result<Self, DisplayError> {
        let text = text.trim();
        if let Some(name) = text.strip_prefix(OF_PATCHES) {
            let known = || cells::names(field).join(", ");
            return of_cells(name, field)
                .unwrap_or_else(|| Err(DisplayError::Cells { name: name.into(), known: known() }));
        }
        match Quantity::parse(text, field) {
            Ok(quantity) => {
                quantity.check(field)?;
                Ok(Self::Quantity(quantity))
            }
            Err(error) => of_cells(text, field).unwrap_or_else(|| Err(with_cells(error, field))),
        }
    }

    /// The quantity, if it is one.
    pub fn quantity(&self) -> Option<&Quantity> {
        match self {
            Self::Quantity(quantity) => Some(quantity),
            Self::Cells(..) => None,
        }
    }

    /// Its name in messages and files, where it was asked for by a text: that of a formula
    /// is short.
    #[must_use]
    pub fn name(&self, text: &str) -> String {
        match self {
            Self::Quantity(Quantity::Formula(formula)) => formula.label(),
            _ => text.to_owned(),
        }
    }

    /// Its symbol, or the words for it, and its unit, as figures have them.
    #[must_use]
    pub fn words(&self, field: &Field<'_>) -> [String; 2] {
        match self {
            Self::Quantity(quantity) => {
                [quantity.symbol(&field.data.components), quantity.unit(field).to_owned()]
            }
            Self::Cells(name, _) => [cells::label(name).to_owned(), String::new()],
        }
    }

    /// True if its values are whole numbers by their nature.
    fn is_whole(&self) -> bool {
        match self {
            Self::Quantity(quantity) => *quantity == Quantity::Overlap,
            Self::Cells(_, values) => values.iter().all(|v| v.is_nan() || v.fract() == 0.0),
        }
    }
}

/// Most values that have a colour each: no more can be told apart.
const MOST_CLASSES: usize = 20;

/// The values that have a colour each in images of one range, rising: none unless they are few
/// whole numbers in all of them.
pub fn classes<'a>(
    pictures: impl IntoIterator<Item = (&'a DisplayedQuantity, &'a RasterValues)>,
) -> Option<Vec<f64>> {
    let values = |(shown, values): (&DisplayedQuantity, &RasterValues)| {
        shown.is_whole().then(|| values.whole_numbers(MOST_CLASSES))?
    };
    let found: Option<Vec<Vec<f64>>> = pictures.into_iter().map(values).collect();
    united(found?)
}

/// Classes of several images together, if they are not too many.
pub fn united(classes: Vec<Vec<f64>>) -> Option<Vec<f64>> {
    let mut all = classes.concat();
    all.sort_by(f64::total_cmp);
    all.dedup();
    (all.len() <= MOST_CLASSES).then_some(all)
}

/// In front of the name of a value of cells that a quantity has too.
pub const OF_PATCHES: &str = "patch:";

/// A text that means nothing that could be shown.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DisplayError {
    /// Cells have no such value.
    #[error("cells have no value `{name}`; there are {known}")]
    Cells {
        /// The name.
        name: String,
        /// The names there are.
        known: String,
    },
    /// The level of cells, of a cover without.
    #[error(
        "`level` is that of cells, and this cover has none: its patches overlap; there are {known}"
    )]
    NoCells {
        /// The names of values that there are.
        known: String,
    },
    /// Neither a quantity nor a value of cells.
    #[error("{error}; of cells {cells}")]
    Unknown {
        /// The reason why it is no quantity.
        #[source]
        error: Box<QuantityError>,
        /// Names of values of cells.
        cells: String,
    },
    /// No quantity of the field.
    #[error(transparent)]
    Quantity(#[from] QuantityError),
}

/// The values of cells with a name; none if there is nothing of the name.
fn of_cells(name: &str, field: &Field<'_>) -> Option<Result<DisplayedQuantity, DisplayError>> {
    if name == "level" && !cells::exist(field) {
        return Some(Err(DisplayError::NoCells { known: cells::names(field).join(", ") }));
    }
    Some(Ok(DisplayedQuantity::Cells(name.into(), cells::values(field, name)?)))
}

/// The error for an unknown quantity, with the names of values of cells.
fn with_cells(error: QuantityError, field: &Field<'_>) -> DisplayError {
    let QuantityError::Unknown { name, hint: of_points, known } = &error else {
        return error.into();
    };
    let cells = cells::names(field);
    if cells.is_empty() {
        return error.into();
    }
    // names of other programs are known where points have quantities
    let of_cells = || hint(name, cells.iter().map(String::as_str));
    let hint = if of_points.is_empty() { of_cells() } else { of_points.clone() };
    let error = QuantityError::Unknown { name: name.clone(), hint, known: known.clone() };
    let error = Box::new(error);
    DisplayError::Unknown { error, cells: cells.join(", ") }
}

/// Returns the default quantity: von Mises' stress, of a potential its values.
#[must_use]
pub fn default_quantity<'f>(field: &'f Field<'_>) -> &'f str {
    match field.equation.elastic() {
        Some(_) => "von-mises",
        None => &field.data.components[0],
    }
}
