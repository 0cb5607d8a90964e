//! The dataset: everything needed to evaluate a solution exactly, nothing of the solver's
//! inner state.
//!
//! A dataset is a series of quasi-static [`Step`]s over one domain. Each step has its own cover,
//! cracks, functions and fields. On patch ω_i a field is a sum of function × polynomial,
//!
//! ```text
//! v_i(x) = Σ_b f_b(x) Σ_{|k| ≤ d_b} c_{b,k} ξ^k        v = Σ_i φ_i v_i        ξ = (x − origin_i) / scale_i
//! ```
//!
//! so that smooth parts (f = 1), jumps (f = side of a crack) and tip functions differ in nothing
//! but the function their [blocks](FieldData) name. `ppum-format` stores this structure,
//! `ppum-fracture` makes it, [`Field`](crate::field::Field) evaluates it.

mod blocks;
mod partition;
mod results;
mod warning;

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::crack::Crack;
use crate::domain::Domain;
pub use crate::equation::{
    EIGENSTRAINS, EXPANSION, Eigenstrain, Elasticity, Equation, Material, StressState, TEMPERATURE,
};
use crate::function::{Function, FunctionKind};
pub use crate::growth::{Growth, GrowthStop, TipIncrement, TipStatus};
use ppum_formula::Table;

pub use crate::polynomial::{MAX_DEGREE, monomials};
pub use blocks::FieldData;
pub use partition::{BoxPartition, Partition};
pub use results::{Attribute, Reaction, Record, Ring, TipIntensity};
pub use warning::{Warning, WarningKind};

/// A solved problem, or a field from elsewhere in the same representation.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Dataset {
    /// One line that names the problem.
    pub title: String,
    /// Name and version of the program that made it, e.g. `ppum 0.1.0`.
    pub program: String,
    /// The text that the problem was read from, if there was one.
    pub problem: Option<String>,
    /// The box minus holes Ω. Outside it nothing is defined.
    pub domain: Domain,
    /// The equation that was solved; decides which quantities have a meaning.
    pub equation: Equation,
    /// Quantities the dataset names, beside the built-in ones.
    pub quantities: Vec<NamedQuantity>,
    /// Tables its formulas may read.
    pub tables: Vec<Arc<Table>>,
    /// Quasi-static series, at least one.
    pub steps: Vec<Step>,
}

impl Dataset {
    /// A dataset without steps, titles and names.
    #[must_use]
    pub fn new(domain: impl Into<Domain>, equation: Equation) -> Self {
        Self {
            title: String::new(),
            program: String::new(),
            problem: None,
            domain: domain.into(),
            equation,
            quantities: Vec::new(),
            tables: Vec::new(),
            steps: Vec::new(),
        }
    }

    /// The dataset with one more step at its end.
    #[must_use]
    pub fn with_step(mut self, step: Step) -> Self {
        self.steps.push(step);
        self
    }
}

/// One state of a quasi-static series.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Step {
    /// Load factor or pseudo-time of the step.
    pub load: f64,
    /// The patches.
    pub partition: Partition,
    /// The cracks.
    pub cracks: Vec<Crack>,
    /// The functions f_b that the fields' blocks name.
    pub functions: Vec<Function>,
    /// The fields; a solver's dataset has one, `displacement` or `potential`.
    pub fields: Vec<FieldData>,
    /// Named values, one per patch.
    pub attributes: Vec<Attribute>,
    /// Stress intensity factors found by the solver.
    pub intensities: Vec<TipIntensity>,
    /// The report of the solver: residual, unknowns, functions cut off, seconds per phase.
    pub history: Vec<Record>,
    /// Warnings of the diagnostics.
    pub warnings: Vec<Warning>,
    /// Resultants of the forces the supports exert on the body, one per boundary condition that
    /// gives values.
    pub reactions: Vec<Reaction>,
    /// How the cracks grow on from here, in a series of growth.
    pub growth: Option<Growth>,
}

impl Step {
    /// A step of load factor 1 with a partition and nothing else.
    #[must_use]
    pub fn new(partition: impl Into<Partition>) -> Self {
        Self {
            load: 1.0,
            partition: partition.into(),
            cracks: Vec::new(),
            functions: Vec::new(),
            fields: Vec::new(),
            attributes: Vec::new(),
            intensities: Vec::new(),
            history: Vec::new(),
            warnings: Vec::new(),
            reactions: Vec::new(),
            growth: None,
        }
    }

    /// The value of a record of the history.
    #[must_use]
    pub fn record(&self, name: &str) -> Option<f64> {
        self.history.iter().find(|record| record.name == name).map(|record| record.value)
    }

    /// Number of unknowns of the solution: those that the solver reports, else the coefficients of
    /// the first field. Where the components of functions are tied, there are more coefficients
    /// than unknowns.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        let coefficients =
            || self.fields.first().map_or(0, |f| f.coefficients.iter().map(Vec::len).sum());
        self.record("unknowns").map_or_else(coefficients, |unknowns| unknowns as usize)
    }

    /// The level fields of a mesh, those that clips and functions name, as indices of the fields in
    /// rising order.
    #[must_use]
    pub fn level_fields(&self) -> Vec<usize> {
        let clips = self.partition.mesh().map_or(&[][..], |mesh| &mesh.clips);
        let of_functions = self.functions.iter().flat_map(|function| function.kind.levels());
        let all: BTreeSet<u32> = clips.iter().map(|clip| clip.field).chain(of_functions).collect();
        all.into_iter().map(|field| field as usize).collect()
    }

    /// The step with one more crack.
    #[must_use]
    pub fn with_crack(mut self, crack: Crack) -> Self {
        self.cracks.push(crack);
        self
    }

    /// The step with one more function, which blocks name by its place in the list.
    #[must_use]
    pub fn with_function(mut self, name: &str, kind: FunctionKind) -> Self {
        self.functions.push(Function { name: name.into(), kind });
        self
    }

    /// The step with one more field.
    #[must_use]
    pub fn with_field(mut self, field: FieldData) -> Self {
        self.fields.push(field);
        self
    }
}

/// Most tables of a dataset. Each formula knows all of them.
pub const MAX_TABLES: usize = 256;

/// Most quantities that a dataset may name. Each is read with all before it, so time grows as
/// the square.
pub const MAX_QUANTITIES: usize = 256;

/// Longest the formulas of these quantities may be together, in bytes.
pub const MAX_QUANTITY_TEXT: usize = 1 << 16;

/// A quantity that a dataset names: the text of
/// a [`QuantityFormula`](crate::quantity::QuantityFormula).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NamedQuantity {
    /// Its name, a word that no built-in quantity has.
    pub name: String,
    /// The formula.
    pub text: String,
    /// Unit for labels; may be empty.
    pub unit: String,
}
