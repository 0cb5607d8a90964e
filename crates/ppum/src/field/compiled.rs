//! A dataset's field at one step, compiled.

use std::sync::Arc;

use crate::box_tree::BoxTree;
use crate::dataset::{BoxPartition, Dataset, Equation, FieldData, NamedQuantity, Partition, Step};
use crate::domain::Domain;
use crate::function::{FunctionError, FunctionTable};
use crate::vec2::Vec2;
use ppum_formula::{Formula, FormulaError, Scope, ScopeError, Table};

/// A field of a dataset at one step, ready to be evaluated.
#[derive(Debug)]
pub struct Field<'d> {
    /// The domain; outside nothing is defined.
    pub domain: &'d Domain,
    /// The equation the field solves.
    pub equation: &'d Equation,
    /// Quantities the dataset names.
    pub quantities: &'d [NamedQuantity],
    /// Tables that formulas may read.
    pub tables: &'d [Arc<Table>],
    /// The step.
    pub step: &'d Step,
    /// Blocks and coefficients.
    pub data: &'d FieldData,
    /// The index of `data` among the fields of the step.
    pub(crate) index: usize,
    /// The boxes of the step's patches; none of a mesh.
    pub(crate) boxes: &'d BoxPartition,
    /// The level fields of a mesh, those of the clips and of functions, by their indices.
    pub(crate) levels: Vec<usize>,
    /// The compiled functions of the step.
    pub functions: FunctionTable,
    /// Finds the patches that cover a point or meet a box.
    pub tree: BoxTree,
    exact: Vec<Formula>,
}

/// The field asked for is not there or cannot be evaluated.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FieldError {
    /// No such step.
    #[error("there is no step {step}; the dataset has {count} (numbered from 0)")]
    Step {
        /// The step asked for.
        step: usize,
        /// Number of steps.
        count: usize,
    },
    /// The step has no field at all.
    #[error("step {step} has no field: there is nothing to evaluate")]
    NoField {
        /// The step asked for.
        step: usize,
    },
    /// Too many patches over cells for integrals over them.
    #[error(
        "more than {most} pairs of a cell and a patch over it: let fewer patches overlap there"
    )]
    TooManyOverlaps {
        /// The largest number of pairs.
        most: usize,
    },
    /// No such field.
    #[error("there is no field `{name}`; the step has {known}")]
    Name {
        /// The field asked for.
        name: String,
        /// The names there are.
        known: String,
    },
    /// Something that boxes have and elements have not.
    #[error("the patches are the elements of a mesh, for which there are no {0}")]
    Mesh(&'static str),
    /// Something that is integrated over cells, of boxes that come from none.
    #[error("the cover has no cells, over which {0} are integrated")]
    Cells(&'static str),
    /// A function of the step is wrong.
    #[error(transparent)]
    Function(#[from] FunctionError),
    /// A table has a name that formulas cannot use.
    #[error("the tables of the dataset: {0}")]
    Tables(#[from] ScopeError),
    /// A formula of the exact solution is wrong.
    #[error("exact solution of field `{name}`: {source}")]
    Exact {
        /// The field.
        name: String,
        /// The error.
        source: Box<FormulaError>,
    },
}

impl<'d> Field<'d> {
    /// Compiles the first field of a step.
    ///
    /// # Errors
    /// See [`FieldError`].
    pub fn new(dataset: &'d Dataset, step: usize) -> Result<Self, FieldError> {
        let first = dataset.steps.get(step).map(|s| s.fields.first());
        let Some(name) = first.map(|field| field.map(|f| f.name.as_str())) else {
            return Self::named(dataset, step, "");
        };
        Self::named(dataset, step, name.ok_or(FieldError::NoField { step })?)
    }

    /// Compiles the field called `name`.
    ///
    /// # Errors
    /// See [`FieldError`].
    pub fn named(dataset: &'d Dataset, step: usize, name: &str) -> Result<Self, FieldError> {
        let count = dataset.steps.len();
        let step = dataset.steps.get(step).ok_or(FieldError::Step { step, count })?;
        let names = || step.fields.iter().map(|f| f.name.as_str());
        let index = names().position(|known| known == name).ok_or_else(|| FieldError::Name {
            name: name.into(),
            known: names().collect::<Vec<_>>().join(", "),
        })?;
        let data = &step.fields[index];
        let support = |patch| match &step.partition {
            Partition::Boxes(boxes) => boxes.support(patch),
            Partition::Mesh(mesh) => mesh.reach(patch),
        };
        let supports: Vec<_> = (0..step.partition.len()).map(support).collect();
        Ok(Self {
            domain: &dataset.domain,
            equation: &dataset.equation,
            quantities: &dataset.quantities,
            tables: &dataset.tables,
            step,
            data,
            index,
            boxes: step.partition.boxes(),
            levels: step.level_fields(),
            functions: FunctionTable::new(&step.functions, step.cracks.len(), &dataset.tables)?,
            tree: BoxTree::from(supports),
            exact: exact(data, &dataset.tables)?,
        })
    }

    /// Number of components.
    #[must_use]
    pub fn components(&self) -> usize {
        self.data.coefficients.len()
    }

    /// True if the field is the displacement of an elastic body, maybe with its temperature.
    #[must_use]
    pub fn is_displacement(&self) -> bool {
        self.equation.elastic().is_some() && self.components() == self.equation.components()
    }

    /// True if the field is a displacement with a temperature as its third component.
    #[must_use]
    pub fn has_temperature(&self) -> bool {
        self.is_displacement() && self.equation.expansion().is_some()
    }

    /// True if the exact solution is known.
    #[must_use]
    pub fn has_exact(&self) -> bool {
        !self.exact.is_empty()
    }

    /// Refuses a field on a mesh, and on boxes without cells.
    ///
    /// # Errors
    /// [`FieldError::Mesh`] or [`FieldError::Cells`], with what it is that needs cells.
    pub fn on_cells(&self, what: &'static str) -> Result<(), FieldError> {
        match &self.step.partition {
            Partition::Mesh(_) => Err(FieldError::Mesh(what)),
            Partition::Boxes(boxes) if !boxes.has_cells() => Err(FieldError::Cells(what)),
            Partition::Boxes(_) => Ok(()),
        }
    }

    /// The exact value of a component at a point; NaN if it is not known.
    #[must_use]
    pub fn exact(&self, component: usize, p: Vec2) -> f64 {
        self.exact.get(component).map_or(f64::NAN, |formula| formula.evaluate(&[p.x, p.y]))
    }

    /// The formulas of the exact solution, one for each component; none if it is not known.
    pub(crate) fn exact_formulas(&self) -> &[Formula] {
        &self.exact
    }
}

fn exact(data: &FieldData, tables: &[Arc<Table>]) -> Result<Vec<Formula>, FieldError> {
    let scope = Scope::cartesian().with_tables(tables)?;
    let formulas: Result<_, _> = data.exact.iter().map(|t| Formula::parse(t, &scope)).collect();
    formulas.map_err(|error| FieldError::Exact { name: data.name.clone(), source: Box::new(error) })
}
