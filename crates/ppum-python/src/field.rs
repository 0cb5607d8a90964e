//! Fields: values at points, along curves, and images of them.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use numpy::{PyArray2, PyReadonlyArray1, PyReadwriteArray1};
use ppum::crack::Side;
use ppum::dataset::Dataset as Data;
use ppum::field::Field;
use ppum::quantity::{Quantity, QuantityGradient, face_names};
use ppum::sample::SampledQuantity;
use ppum::vec2::Vec2;
use ppum_scene::profile::ProfileCurve;
use ppum_scene::quantity::default_quantity;
use ppum_scene::scene::Subject;
use ppum_scene::subject::of_step;
use ppum_scene::values::single_precision_warning;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::dataset::PyDataset;
use crate::errors::{no_field, no_profile, quantity};
use crate::facts::{QuantityFacts, quantities};
use crate::owned::FieldInDataset;
use crate::values::{PointArrays, rows};
use crate::watch::{guard, long};

/// Points that are evaluated on the calling thread, which takes less time than to wake others.
const FEW: usize = 256;

/// Quantities that are kept ready.
const KEPT: usize = 256;

/// A field of one step, ready to be evaluated.
#[pyclass(name = "Field", frozen, module = "ppum._core")]
pub(crate) struct PyField {
    pub(crate) owned: FieldInDataset,
    /// The dataset, and the changes of its field.
    pub(crate) series: Py<PyDataset>,
    pub(crate) changes: Subject,
    /// The subject that titles name: its step, where the dataset has several, and the part.
    pub(crate) titled: Subject,
    quantities: Mutex<HashMap<String, Quantity>>,
}

impl PyField {
    pub(crate) fn dataset(&self) -> &Data {
        self.owned.borrow_owner()
    }

    pub(crate) fn field(&self) -> &Field<'_> {
        &self.owned.borrow_dependent().field
    }

    /// The dataset, and the number of the step.
    pub(crate) fn place(&self) -> (&Data, usize) {
        (self.dataset(), self.owned.borrow_dependent().number)
    }

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
        let field = self.field();
        let found = Quantity::parse(&self.spelled(name), field);
        let found = found.map_err(quantity)?;
        found.check_at_points(field).map_err(quantity)?;
        Ok(found)
    }

    /// The name of a quantity with `-` where Python has `_`; other texts as they are.
    pub(crate) fn spelled(&self, name: &str) -> String {
        let field = self.field();
        let is_known =
            |name: &str| Quantity::from_name(name, field.equation, &field.data.components).is_ok();
        let dashed = name.trim().replace('_', "-");
        if !is_known(name.trim()) && is_known(&dashed) { dashed } else { name.to_owned() }
    }

    pub(crate) fn quantities(&self, names: &[String]) -> PyResult<Vec<Quantity>> {
        names.iter().map(|name| self.quantity(name)).collect()
    }

    fn slopes(&self, quantities: &[Quantity]) -> PyResult<Vec<QuantityGradient>> {
        let slope = |of| QuantityGradient::new(of, self.field());
        let all = || quantities.iter().map(slope).collect::<Result<_, _>>();
        guard(|| all().map_err(quantity))
    }

    fn fill(
        &self,
        py: Python<'_>,
        points: PointArrays<'_>,
        wanted: SampledQuantity<'_>,
        rows: &mut [f64],
    ) -> PyResult<()> {
        let seen = self.owned.borrow_dependent();
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

#[pymethods]
impl PyField {
    /// The first field of a step, of a dataset that is changed as `subject` says.
    #[new]
    fn new(
        py: Python<'_>,
        series: Py<PyDataset>,
        step: usize,
        subject: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let (dataset, changes) = (series.get(), read_data::<Subject>(subject)?);
        let owned = long(py, None, None, |_| changed(dataset.at(step)?, step, &changes))??;
        // what is changed is a copy of one step
        let step = changes.is_whole().then_some(step);
        let titled = Subject { step, part: changes.part.clone(), ..Subject::default() };
        Ok(Self { owned, series, changes, titled, quantities: Mutex::default() })
    }

    /// A quantity at one point.
    fn value(&self, name: &str, x: f64, y: f64, is_below: bool) -> PyResult<f64> {
        let quantity = self.quantity(name)?;
        let points = PointArrays { x: &[x], y: &[y], anchor: None, side: side(is_below) };
        guard(|| {
            Ok(points.few(self.owned.borrow_dependent(), SampledQuantity::Values(&[quantity]))[0])
        })
    }

    /// Writes quantities at points, or with their gradients, in rows to `out`.
    #[expect(clippy::too_many_arguments, reason = "Python's layer names them")]
    fn evaluate(
        &self,
        py: Python<'_>,
        names: Vec<String>,
        x: PyReadonlyArray1<'_, f64>,
        y: PyReadonlyArray1<'_, f64>,
        is_below: bool,
        anchor: Option<(f64, f64)>,
        gradient: bool,
        mut out: PyReadwriteArray1<'_, f64>,
    ) -> PyResult<()> {
        let (x, y, rows) = (x.as_slice()?, y.as_slice()?, out.as_slice_mut()?);
        let anchor = anchor.map(|(x, y)| Vec2 { x, y });
        let points = PointArrays { x, y, anchor, side: side(is_below) };
        let quantities = self.quantities(&names)?;
        let slopes = if gradient { self.slopes(&quantities)? } else { Vec::new() };
        let wanted = match gradient {
            true => SampledQuantity::Slopes(&slopes),
            false => SampledQuantity::Values(&quantities),
        };
        if x.len() != y.len() || rows.len() != x.len() * wanted.width() {
            return Err(PyValueError::new_err("x, y and `out` do not have lengths that fit"));
        }
        self.fill(py, points, wanted, rows)
    }

    /// Raises if a text is no quantity of the field.
    fn check(&self, name: &str) -> PyResult<()> {
        self.quantity(name).map(drop)
    }

    /// All quantities that have a name.
    fn known(&self) -> PyResult<Vec<QuantityFacts>> {
        guard(|| Ok(quantities(self.field())))
    }

    /// Names of the quantities of the faces of cracks.
    fn of_faces(&self) -> Vec<&'static str> {
        face_names(self.field()).collect()
    }

    /// Symbol and unit of a quantity.
    fn words(&self, name: &str) -> PyResult<(String, String)> {
        let (quantity, field) = (self.quantity(name)?, self.field());
        let symbol = quantity.symbol(&field.data.components);
        Ok((symbol, quantity.unit(field).to_owned()))
    }

    /// The quantity that is shown where nothing is said.
    fn default_quantity(&self) -> String {
        default_quantity(self.field()).to_owned()
    }

    /// The warning about images in single precision, if they are wrong.
    fn single_precision_warning(&self) -> Option<String> {
        single_precision_warning(self.field().step)
    }

    fn components(&self) -> Vec<String> {
        self.field().data.components.clone()
    }

    /// Quantities along a curve: names and units of the columns, and a row for each place.
    #[expect(clippy::type_complexity, reason = "names, units, rows")]
    fn table<'py>(
        &self,
        py: Python<'py>,
        along: &Bound<'_, PyAny>,
        count: usize,
        names: Vec<String>,
    ) -> PyResult<(Vec<(String, String)>, Bound<'py, PyArray2<f64>>)> {
        let along = read_data::<ProfileCurve>(along)?;
        let named: Vec<_> = names.iter().cloned().zip(self.quantities(&names)?).collect();
        let field = self.field();
        let profile = long(py, None, None, |watcher| along.table(field, &named, count, watcher))?
            .map_err(no_profile)?;
        let columns = profile.table.columns();
        let heads = columns.iter().map(|c| (c.name.clone(), c.unit.clone())).collect();
        let numbers = profile.table.rows().flatten().copied().collect();
        Ok((heads, rows(py, numbers, columns.len() as u32)?))
    }
}

/// Reads data that Python's layer gives as dictionaries, lists, texts and numbers.
///
/// # Errors
/// Data that the library does not take, without the place in a text that nobody has seen.
pub(crate) fn read_data<T: serde::de::DeserializeOwned>(data: &Bound<'_, PyAny>) -> PyResult<T> {
    let json = data.py().import("json")?.call_method1("dumps", (data,))?;
    serde_json::from_str(&json.extract::<String>()?).map_err(|error| {
        let message = error.to_string();
        let place = format!(" at line {} column {}", error.line(), error.column());
        PyValueError::new_err(message.strip_suffix(&place).unwrap_or(&message).to_owned())
    })
}

/// The field of a step, of a copy of it if something is changed.
fn changed(data: Arc<Data>, step: usize, what: &Subject) -> PyResult<FieldInDataset> {
    if what.is_whole() {
        return FieldInDataset::compiled(data, step).map_err(no_field);
    }
    let mut copy = Data::new(data.domain.clone(), data.equation.clone());
    copy.title = of_step(&data, step);
    copy.problem.clone_from(&data.problem);
    copy.quantities.clone_from(&data.quantities);
    copy.tables.clone_from(&data.tables);
    copy.steps.push(data.steps[step].clone());
    what.apply(&mut copy).map_err(quantity)?;
    FieldInDataset::compiled(Arc::new(copy), 0).map_err(no_field)
}
