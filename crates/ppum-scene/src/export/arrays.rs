//! The arrays of an exported mesh: scalars, vectors and tensors, made of quantities.

use ppum::field::Field;
use ppum::quantity::{Quantity, QuantityError, Source};

/// Components of a vector, and of a symmetric tensor in the order of VTK.
const VECTOR: [&str; 3] = ["X", "Y", "Z"];
const TENSOR: [&str; 6] = ["XX", "YY", "ZZ", "XY", "YZ", "XZ"];

/// An array of numbers at points.
#[derive(Clone, Debug, PartialEq)]
pub struct PointArray {
    /// Its name in the file.
    pub name: String,
    /// For each component its name, empty of a scalar, and its quantity; zero if it has none.
    pub components: Vec<(&'static str, Option<Quantity>)>,
}

impl PointArray {
    /// A scalar.
    #[must_use]
    pub fn scalar(name: &str, quantity: Quantity) -> Self {
        Self { name: name.to_owned(), components: vec![("", Some(quantity))] }
    }

    /// Returns the default arrays: of elasticity the displacement, the stress tensor and von Mises'
    /// stress, of Poisson's equation the field and its gradient, else the field.
    ///
    /// # Errors
    /// None of a field that passed its check.
    pub fn defaults(field: &Field<'_>) -> Result<Vec<Self>, QuantityError> {
        let names: Vec<&str> = field.data.components.iter().map(String::as_str).collect();
        let name = field.data.name.as_str();
        let mut all = match names[..] {
            [x, y] => vec![Self::of(field, name, &VECTOR, &[x, y, ""])?],
            [x, y, temperature] if field.has_temperature() => vec![
                Self::of(field, name, &VECTOR, &[x, y, ""])?,
                Self::of(field, temperature, &[""], &[temperature])?,
            ],
            _ => names
                .iter()
                .map(|name| Self::of(field, name, &[""], &[name]))
                .collect::<Result<_, _>>()?,
        };
        if field.is_displacement() {
            let third = if field.equation.is_axisymmetric() { "shoop" } else { "szz" };
            all.push(Self::of(field, "stress", &TENSOR, &["sxx", "syy", third, "sxy", "", ""])?);
            all.push(Self::of(field, "von-mises", &[""], &["von-mises"])?);
        } else if let [only] = names[..] {
            let slopes = [format!("d{only}_dx"), format!("d{only}_dy")];
            all.push(Self::of(field, "gradient", &VECTOR, &[&slopes[0], &slopes[1], ""])?);
        }
        Ok(all)
    }

    /// The quantities of its components.
    pub(super) fn quantities(&self) -> impl Iterator<Item = &Quantity> {
        self.components.iter().filter_map(|(_, quantity)| quantity.as_ref())
    }

    /// Components by the names of their quantities, none for zero.
    fn of(
        field: &Field<'_>,
        name: &str,
        labels: &[&'static str],
        quantities: &[&str],
    ) -> Result<Self, QuantityError> {
        let parsed = |text: &&str| match *text {
            "" => Ok(None),
            text => Quantity::parse(text, field).map(Some),
        };
        let quantities: Result<Vec<_>, _> = quantities.iter().map(parsed).collect();
        let components = labels.iter().copied().zip(quantities?).collect();
        Ok(Self { name: name.to_owned(), components })
    }
}

/// Arrays as a row of numbers, one for each quantity.
#[derive(Clone, Debug)]
pub(super) struct ArrayColumns {
    pub(super) quantities: Vec<Quantity>,
    /// For each quantity the number of its array.
    pub(super) array: Vec<usize>,
    /// For each quantity whether it may jump across borders of patches.
    pub(super) jumps: Vec<bool>,
}

impl ArrayColumns {
    pub(super) fn new(arrays: &[PointArray]) -> Self {
        let (mut quantities, mut array) = (Vec::new(), Vec::new());
        for (number, one) in arrays.iter().enumerate() {
            for quantity in one.quantities() {
                quantities.push(quantity.clone());
                array.push(number);
            }
        }
        let may_jump = |q: &Quantity| matches!(q.source(), Source::Gradient | Source::Partition);
        Self { jumps: quantities.iter().map(may_jump).collect(), quantities, array }
    }

    pub(super) fn len(&self) -> usize {
        self.quantities.len()
    }

    /// True if any quantity may jump across borders of patches.
    pub(super) fn any_jumps(&self) -> bool {
        self.jumps.contains(&true)
    }
}
