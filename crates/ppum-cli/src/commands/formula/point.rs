//! The point at which a formula is evaluated.

use anyhow::{bail, ensure};
use ppum::crack::TipPoint;
use serde::Serialize;
use serde::ser::Serializer;

use super::subject::{DisplayedFormula, Of};
use crate::number::JsonNumber;

/// A value for every input of a formula.
#[derive(Debug)]
pub(super) struct FormulaPoint {
    /// In the order of the scope; NaN for those that nothing needs.
    pub(super) inputs: Vec<f64>,
    /// The variables by name.
    pub(super) shown: Vec<(String, f64)>,
}

impl Serialize for FormulaPoint {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.shown.iter().map(|(name, value)| (name, JsonNumber(*value))))
    }
}

impl FormulaPoint {
    /// The point with the values that were given, of the plane with polar coordinates.
    pub(super) fn new(subject: &DisplayedFormula, given: &[(String, f64)]) -> anyhow::Result<Self> {
        let formula = &subject.formula;
        let is_plane = subject.of == Of::Plane;
        let names: Vec<_> = formula.scope().inputs().collect();
        let names = if is_plane { &names[..2] } else { &names };
        if let Some((name, _)) = given.iter().find(|(name, _)| !names.contains(&name.as_str())) {
            bail!("--at: there is no variable `{name}`; give values of {}", names.join(", "));
        }
        let is_needed = |name: &str| is_plane || formula.uses(name);
        let is_given = |name: &str| given.iter().any(|(known, _)| known == name);
        let missing: Vec<_> =
            names.iter().filter(|n| is_needed(n) && !is_given(n)).copied().collect();
        ensure!(missing.is_empty(), "--at: values of {} are missing", missing.join(", "));
        let mut values = given.to_vec();
        if is_plane {
            values.extend(polar(value(given, "x"), value(given, "y")));
        }
        let inputs = formula.scope().inputs().map(|name| value(&values, name)).collect();
        values.retain(|(name, _)| !name.contains('('));
        Ok(Self { inputs, shown: values })
    }
}

/// The last value of a name, NaN without one.
fn value(values: &[(String, f64)], name: &str) -> f64 {
    values.iter().rfind(|(known, _)| known == name).map_or(f64::NAN, |(_, value)| *value)
}

/// The polar coordinates and half angles of a point. On the cut y = 0, x < 0 the sign of the zero
/// tells the side.
fn polar(x: f64, y: f64) -> [(String, f64); 4] {
    let point = TipPoint { x, y, sign: 1.0f64.copysign(y), branch: 1.0 };
    let (r, theta) = point.polar();
    let [cos, sin] = point.half_angle(r);
    [("r", r), ("theta", theta), ("cos(theta/2)", cos), ("sin(theta/2)", sin)]
        .map(|(name, value)| (name.to_owned(), value))
}
