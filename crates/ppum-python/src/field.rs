//! Fields: values at points, along curves, and images of them.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use numpy::{PyArray1, PyArray2, PyArrayMethods as _, PyReadonlyArray1, PyReadwriteArray1};
use ppum::crack::Side;
use ppum::dataset::Dataset as Data;
use ppum::quantity::{Quantity, QuantityGradient};
use ppum::sample::SampledQuantity;
use ppum::vec2::Vec2;
use ppum_scene::drawing::single_precision_warning;
use ppum_scene::profile::ProfileCurve;
use ppum_scene::scene::{Subject, default_quantity};
use ppum_scene::shot::of_step;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::dataset::PyDataset;
use crate::errors::{no_field, no_profile, quantity, subject};
use crate::facts::QuantityFacts;
use crate::owned::PyOwnedField;
use crate::values::PointArrays;
use crate::watch::{guard, long};

/// Points that are evaluated on the calling thread, which takes less time than to wake others.
const FEW: usize = 256;

/// Quantities that are kept ready.
const KEPT: usize = 256;

/// A field of one step, ready to be evaluated.
#[pyclass(name = "Field", frozen, module = "ppum._core")]
pub(crate) struct PyField {
    pub(crate) owned: PyOwnedField,
    /// The subject that titles name: its step, where the dataset has several, and the part.
    pub(crate) told: Subject,
    quantities: Mutex<HashMap<String, Quantity>>,
}

impl PyField {
    /// The quantity of a name, with `_` or `-`, or of a formula.
    pub(crate) fn quantity(&self, name: &str) -> PyResult<Quantity> {
        let mut known = self.quantities.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(quantity) = known.get(name) {
            return Ok(quantity.clone());
        }
        let found = guard(|| self.parsed(name))?;
        if known.len() >= KEPT {
            known.clear();
        }
        known.insert(name.to_owned(), found.clone());
        Ok(found)
    }

    fn parsed(&self, name: &str) -> PyResult<Quantity> {
        let field = self.owned.field();
        let found = Quantity::parse(&self.spelled(name), field);
        let found = found.map_err(|error| quantity(&error))?;
        found.check(field).map_err(|error| quantity(&error))?;
        Ok(found)
    }

    /// The name of a quantity with `-` where Python has `_`; other texts as they are.
    pub(crate) fn spelled(&self, name: &str) -> String {
        let field = self.owned.field();
        let is_known =
            |name: &str| Quantity::from_name(name, field.equation, &field.data.components).is_ok();
        let dashed = name.trim().replace('_', "-");
        if !is_known(name.trim()) && is_known(&dashed) { dashed } else { name.to_owned() }
    }

    pub(crate) fn quantities(&self, names: &[String]) -> PyResult<Vec<Quantity>> {
        names.iter().map(|name| self.quantity(name)).collect()
    }

    fn slopes(&self, quantities: &[Quantity]) -> PyResult<Vec<QuantityGradient>> {
        let slope = |of| QuantityGradient::new(of, self.owned.field());
        let all = || quantities.iter().map(slope).collect::<Result<_, _>>();
        guard(|| all().map_err(|error| quantity(&error)))
    }

    fn fill(
        &self,
        py: Python<'_>,
        points: PointArrays<'_>,
        wanted: SampledQuantity<'_>,
        rows: &mut [f64],
    ) -> PyResult<()> {
        let seen = self.owned.seen();
        if points.x.len() <= FEW {
            return guard(|| {
                rows.copy_from_slice(&points.few(seen, wanted));
                Ok(())
            });
        }
        let filled = long(py, None, None, |watcher| points.fill(seen, wanted, rows, watcher))?;
        filled.map_err(|stopped| no_profile(stopped.into()))
    }
}

fn side(is_below: bool) -> Side {
    if is_below { Side::Below } else { Side::Above }
}

/// The numbers of an array that lie one after the other; Python sees to that.
fn slice<'a>(array: &'a PyReadonlyArray1<'_, f64>) -> PyResult<&'a [f64]> {
    Ok(array.as_slice()?)
}

#[pymethods]
impl PyField {
    /// The first field of a step, of a dataset that is changed as `subject` says.
    #[new]
    fn new(py: Python<'_>, dataset: &PyDataset, step: usize, subject: &str) -> PyResult<Self> {
        let subject = written::<Subject>(subject)?;
        let owned = long(py, None, None, |_| changed(dataset.at(step)?, step, &subject))??;
        // what is changed is a copy of one step
        let step = subject.is_whole().then_some(step);
        let told = Subject { step, part: subject.part, ..Subject::default() };
        Ok(Self { owned, told, quantities: Mutex::default() })
    }

    /// A quantity at one point.
    fn value(&self, name: &str, x: f64, y: f64, is_below: bool) -> PyResult<f64> {
        let quantity = self.quantity(name)?;
        let points = PointArrays { x: &[x], y: &[y], anchor: None, side: side(is_below) };
        guard(|| Ok(points.few(self.owned.seen(), SampledQuantity::Values(&[quantity]))[0]))
    }

    /// Quantities at points, or with their gradients, in rows; `out` takes them if it is given.
    #[pyo3(signature = (names, x, y, is_below, anchor, gradient, out=None))]
    #[expect(clippy::too_many_arguments, reason = "Python's layer names them")]
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        names: Vec<String>,
        x: PyReadonlyArray1<'py, f64>,
        y: PyReadonlyArray1<'py, f64>,
        is_below: bool,
        anchor: Option<(f64, f64)>,
        gradient: bool,
        out: Option<PyReadwriteArray1<'py, f64>>,
    ) -> PyResult<Option<Bound<'py, PyArray1<f64>>>> {
        let (x, y) = (slice(&x)?, slice(&y)?);
        if x.len() != y.len() {
            return Err(PyValueError::new_err("x and y have different lengths"));
        }
        let anchor = anchor.map(|(x, y)| Vec2 { x, y });
        let points = PointArrays { x, y, anchor, side: side(is_below) };
        let quantities = self.quantities(&names)?;
        let slopes = if gradient { self.slopes(&quantities)? } else { Vec::new() };
        let wanted = if gradient {
            SampledQuantity::Slopes(&slopes)
        } else {
            SampledQuantity::Values(&quantities)
        };
        if let Some(mut out) = out {
            let rows = out.as_slice_mut()?;
            if rows.len() != x.len() * wanted.width() {
                return Err(PyValueError::new_err("`out` has not the length of the result"));
            }
            self.fill(py, points, wanted, rows)?;
            return Ok(None);
        }
        let mut rows = vec![0.0; x.len() * wanted.width()];
        self.fill(py, points, wanted, &mut rows)?;
        Ok(Some(PyArray1::from_vec(py, rows)))
    }

    /// Raises if a text is no quantity of the field.
    fn check(&self, name: &str) -> PyResult<()> {
        self.quantity(name).map(drop)
    }

    /// All quantities that have a name.
    fn known(&self) -> PyResult<Vec<QuantityFacts>> {
        guard(|| Ok(QuantityFacts::all(self.owned.field())))
    }

    /// Symbol and unit of a quantity.
    fn words(&self, name: &str) -> PyResult<(String, String)> {
        let (quantity, field) = (self.quantity(name)?, self.owned.field());
        let symbol = quantity.symbol(&field.data.components);
        Ok((symbol, quantity.unit(field).to_owned()))
    }

    /// The quantity that is shown where nothing is said.
    fn default_quantity(&self) -> String {
        default_quantity(self.owned.field()).to_owned()
    }

    /// The warning about images in single precision, if they are wrong.
    fn single_precision_warning(&self) -> Option<String> {
        single_precision_warning(self.owned.field().step)
    }

    fn components(&self) -> Vec<String> {
        self.owned.field().data.components.clone()
    }

    /// Quantities along a curve: names and units of the columns, and a row for each place.
    #[expect(clippy::type_complexity, reason = "names, units, rows")]
    fn table<'py>(
        &self,
        py: Python<'py>,
        along: &str,
        count: usize,
        names: Vec<String>,
    ) -> PyResult<(Vec<(String, String)>, Bound<'py, PyArray2<f64>>)> {
        let along = written::<ProfileCurve>(along)?;
        let named: Vec<_> = names.iter().cloned().zip(self.quantities(&names)?).collect();
        let field = self.owned.field();
        let profile = long(py, None, None, |watcher| along.table(field, &named, count, watcher))?
            .map_err(no_profile)?;
        let columns = profile.table.columns();
        let heads = columns.iter().map(|c| (c.name.clone(), c.unit.clone())).collect();
        let rows: Vec<f64> = profile.table.rows().flatten().copied().collect();
        let shape = [rows.len() / columns.len().max(1), columns.len()];
        Ok((heads, PyArray1::from_vec(py, rows).reshape(shape)?))
    }
}

/// Parses JSON that the Python layer has written. Errors do not tell the place in that text, which
/// nobody has seen.
pub(crate) fn written<V: serde::de::DeserializeOwned>(text: &str) -> PyResult<V> {
    serde_json::from_str(text).map_err(|error| {
        let message = error.to_string();
        let place = format!(" at line {} column {}", error.line(), error.column());
        PyValueError::new_err(message.strip_suffix(&place).unwrap_or(&message).to_owned())
    })
}

/// The field of a step, of a copy of it if something is changed.
fn changed(data: Arc<Data>, step: usize, what: &Subject) -> PyResult<PyOwnedField> {
    if what.is_whole() {
        return PyOwnedField::new(data, step).map_err(no_field);
    }
    let mut copy = Data::new(data.domain.clone(), data.equation.clone());
    copy.title = of_step(&data, step);
    copy.problem.clone_from(&data.problem);
    copy.quantities.clone_from(&data.quantities);
    copy.tables.clone_from(&data.tables);
    copy.steps.push(data.steps[step].clone());
    what.apply(&mut copy).map_err(|error| subject(&error))?;
    PyOwnedField::new(Arc::new(copy), 0).map_err(no_field)
}
