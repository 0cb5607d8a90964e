//! Problems: what is to be solved, and how, from a problem file (TOML) or built in code.
//!
//! Find u on the box minus holes Ω with cracks Γ, faces and rims free unless loaded, such that
//!
//! ```text
//! elasticity:  −div σ(u) = f,  σ = 2μ ε(u) + λ tr ε(u) I        Poisson:  −div (κ ∇u) = f
//! ```
//!
//! with components of u (Dirichlet) or of the traction σ n, the flux κ ∂u/∂n (Neumann), given on
//! parts of the border. `docs/problem-file.md` describes the file for users.
//!
//! A [`Problem`] is plain data. Reading reports everything that is wrong at once, with places; for
//! a problem built in code [`Problem::check`] applies the same rules:
//!
//! ```
//! use ppum::dataset::{Material, StressState};
//! use ppum::vec2::{Rect, vec2};
//! use ppum_solve::problem::{Cells, Condition, Discretization, Edge, Problem};
//!
//! let steel = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
//! let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
//! let pull = |t: f64| vec![Condition::Neumann(0.0.into()), Condition::Neumann(t.into())];
//! let problem = Problem::elasticity(domain, steel, Discretization::new(Cells::Level(4)))
//!     .with_crack(&[[-0.5, 0.0], [0.5, 0.0]])
//!     .with_boundary(Edge::Bottom, pull(-1.0))
//!     .with_boundary(Edge::Top, pull(1.0));
//! assert_eq!(problem.check(), Ok(()));
//! ```

mod adaptivity;
mod boundary;
mod check;
mod contacts;
mod cracks;
mod csv;
mod curve;
mod discretization;
mod document;
mod enrichment;
mod error;
mod expression;
mod growth;
mod holes;
mod key;
mod nearby;
mod points;
pub(crate) mod quantities;
mod read;
mod refinement;
mod restraint;
mod scopes;
mod stations;
mod stiffness;
mod straight;
mod table_file;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use ppum::crack::{Crack, TipId, tips};
use ppum::dataset::{Dataset, Equation, Material, NamedQuantity};
use ppum::domain::Domain;
use ppum::formula::Table;
use ppum::vec2::Vec2;

pub use adaptivity::{AdaptKind, Adaptivity, Keep};
pub use boundary::{BorderPart, BoundaryCondition, Condition, Edge};
pub(crate) use cracks::touch;
pub use cracks::{crack, cracks};
pub(crate) use curve::arc_from;
pub use discretization::{Cells, Discretization, Enrichment, MOST_TERMS, Order, OrderError};
pub use enrichment::{LocalEnrichment, Region, Site};
pub use error::{Location, Mistake, ProblemError};
pub use growth::{Criterion, GrowthRule, LoadControl, Paris};
pub use ppum::expression::Expression;
pub(crate) use refinement::{DEEPEST, nine};
pub use refinement::{LocalRefinement, RefinementRegion};
pub use restraint::restraint_center;
pub(crate) use restraint::restraint_words;
pub use stations::Station;
pub(crate) use stiffness::{FREE_OF_LOCKING, STIFF, stiffness_ratio};
pub use table_file::read_table;

/// A problem with its discretisation.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Problem {
    /// One line that names the problem; may be empty.
    pub title: String,
    /// The box minus holes Ω.
    pub domain: Domain,
    /// The equation with its material.
    pub equation: Equation,
    /// The cracks.
    pub cracks: Vec<Crack>,
    /// The conditions on the border.
    pub boundary: Vec<BoundaryCondition>,
    /// The right-hand side f, one expression per component: body force or source.
    pub source: Vec<Expression>,
    /// The exact solution, one expression per component; empty if unknown.
    pub exact: Vec<Expression>,
    /// Quantities the problem names, beside the built-in ones.
    pub quantities: Vec<NamedQuantity>,
    /// Tables its formulas may read.
    pub tables: Vec<Arc<Table>>,
    /// Functions of the local spaces beside the built-in ones.
    pub enrichments: Vec<LocalEnrichment>,
    /// Cover, local spaces and enrichment.
    pub discretization: Discretization,
    /// How the cover is improved by its own solutions; `None` solves once.
    pub adaptivity: Option<Adaptivity>,
    /// How cracks grow, step by step; `None` solves the problem with the cracks as they are.
    pub growth: Option<GrowthRule>,
    /// Where cells are divided by hand.
    pub refinements: Vec<LocalRefinement>,
    /// The linear solver.
    pub solver: Solver,
    /// The problem file's text, if there was one.
    pub text: Option<String>,
    /// The files that the text names, which were read with it: tables and points.
    pub files: Vec<PathBuf>,
}

/// Longest problem file, in bytes: a hundred thousand cracks take some.
pub const MAX_LENGTH: u64 = 16 << 20;

/// Settings of the solver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solver {
    /// The linear solver.
    pub kind: SolverKind,
    /// Part of the error in the energy norm that iteration may leave, estimated by its residual.
    pub tolerance: f64,
    /// Use native kernels where there are any; false evaluates their formulas, which should give
    /// the same to rounding.
    pub kernels: bool,
}

impl Default for Solver {
    fn default() -> Self {
        Self { kind: SolverKind::default(), tolerance: TOLERANCE, kernels: true }
    }
}

/// Default tolerance of iteration: fields and stress intensity factors are those of the direct
/// solver to 1e-9, a thousand times that, whatever they weigh in the energy.
pub(crate) const TOLERANCE: f64 = 1e-12;

/// The linear solver.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum SolverKind {
    /// The choice that suits the problem.
    #[default]
    Auto,
    /// Sparse Cholesky factorisation.
    Direct,
    /// Conjugate gradients with a hierarchy of coarser covers.
    Multilevel,
}

impl Problem {
    /// True if tips have Williams' series, and corners theirs: where the material varies they have
    /// other ones.
    pub(crate) fn has_series(&self) -> bool {
        self.discretization.enrichment == Enrichment::Williams && self.equation.is_uniform()
    }

    /// Reads a problem file of at most [`MAX_LENGTH`] bytes. Paths in it are relative to its
    /// folder, and lead to files of at most 64 MiB.
    ///
    /// # Errors
    /// Everything that is wrong, with file, line, column and remedy, of a file of numbers the first
    /// 100 mistakes; or that the file cannot be read.
    pub fn read(path: &Path) -> Result<Self, ProblemError> {
        let file = path.display().to_string();
        let text = ppum_file::text(path, MAX_LENGTH).map_err(|error| Mistake {
            location: Location::File(file.clone()),
            message: format!("cannot read the problem file: {error}"),
        })?;
        Self::parse(&text, &file, path.parent().unwrap_or(Path::new("")))
    }

    /// Reads a problem from the text of a problem file.
    ///
    /// `file_name` is for messages, and the title if the text has none; paths in the text are
    /// relative to `base_dir`.
    ///
    /// # Errors
    /// Everything that is wrong, with file, line, column and remedy.
    pub fn parse(text: &str, file_name: &str, base_dir: &Path) -> Result<Self, ProblemError> {
        read::read(text, file_name, read::Files::In(base_dir))
    }

    /// The problem of a dataset, from the text it holds; none if it holds none. Tables and points
    /// that were read from files are those of the dataset: the files need not be there any more.
    ///
    /// # Errors
    /// Everything that is wrong in the text.
    pub fn of_dataset(dataset: &Dataset) -> Result<Option<Self>, ProblemError> {
        let read = |text: &String| Self::parse_with(text, dataset);
        dataset.problem.as_ref().map(read).transpose()
    }

    /// The problem of another text, with the tables and points of a dataset in place of the files
    /// that the text names.
    ///
    /// # Errors
    /// Everything that is wrong in the text.
    pub fn parse_with(text: &str, dataset: &Dataset) -> Result<Self, ProblemError> {
        read::read(text, "problem", read::Files::Stored(dataset))
    }

    /// A problem of elasticity on a box, as yet without cracks, loads and restraints.
    #[must_use]
    pub fn elasticity(
        domain: impl Into<Domain>,
        material: Material,
        discretization: Discretization,
    ) -> Self {
        Self::new(domain.into(), Equation::elasticity(material), discretization)
    }

    /// A Poisson problem with conductivity κ on a box, as yet without cracks, sources and
    /// conditions.
    #[must_use]
    pub fn poisson(
        domain: impl Into<Domain>,
        conductivity: f64,
        discretization: Discretization,
    ) -> Self {
        Self::new(domain.into(), Equation::poisson(conductivity), discretization)
    }

    fn new(domain: Domain, equation: Equation, discretization: Discretization) -> Self {
        Self {
            title: String::new(),
            domain,
            source: vec![Expression::number(0.0); equation.components()],
            equation,
            cracks: Vec::new(),
            boundary: Vec::new(),
            exact: Vec::new(),
            quantities: Vec::new(),
            tables: Vec::new(),
            enrichments: Vec::new(),
            discretization,
            adaptivity: None,
            growth: None,
            refinements: Vec::new(),
            solver: Solver::default(),
            text: None,
            files: Vec::new(),
        }
    }

    /// The problem with one more crack; its ends on the border, also on rims and in holes, become
    /// mouths, those on other cracks junctions, and all others tips. Ends of the cracks before it
    /// that lie on it become junctions, too. Cost: that of looking at all cracks; [`cracks()`]
    /// makes many at once.
    #[must_use]
    pub fn with_crack(mut self, points: &[[f64; 2]]) -> Self {
        let new = points.iter().copied().map(Vec2::from).collect();
        let all = std::mem::take(&mut self.cracks).into_iter().map(|crack| crack.points);
        self.cracks = cracks(all.chain([new]), &self.domain);
        self
    }

    /// The problem with conditions on a whole edge, one per component.
    #[must_use]
    pub fn with_boundary(mut self, edge: Edge, components: Vec<Condition>) -> Self {
        self.boundary.push(BoundaryCondition::on_edge(edge, &self.domain.bounds, components));
        self
    }

    /// The problem with a pressure on a part of the border.
    #[must_use]
    pub fn with_pressure(mut self, on: BorderPart, pressure: f64) -> Self {
        self.boundary.push(BoundaryCondition::pressure(on, pressure.into()));
        self
    }

    /// The problem with exact values given on a whole edge.
    #[must_use]
    pub fn with_exact_boundary(self, edge: Edge) -> Self {
        let components = self.exact.iter().cloned().map(Condition::Dirichlet).collect();
        self.with_boundary(edge, components)
    }

    /// The problem whose cover is improved by its own solutions.
    #[must_use]
    pub fn with_adaptivity(mut self, adaptivity: Adaptivity) -> Self {
        self.adaptivity = Some(adaptivity);
        self
    }

    /// The problem whose cracks grow.
    #[must_use]
    pub fn with_growth(mut self, growth: GrowthRule) -> Self {
        self.growth = Some(growth);
        self
    }

    /// True if something acts on faces of cracks.
    pub(crate) fn loads_faces(&self) -> bool {
        self.boundary.iter().any(|condition| matches!(condition.on, BorderPart::Crack { .. }))
    }

    /// Number of components of the unknown field.
    #[must_use]
    pub fn components(&self) -> usize {
        self.equation.components()
    }

    /// Radius of the zone around a tip whose patches are enriched: the one given, or by default a
    /// quarter of the crack's length, at most a quarter of the distance to the nearest other tip.
    ///
    /// The radius does not shrink with the cells: the rate of convergence rests on that.
    #[must_use]
    pub fn enrichment_radius(&self, tip: TipId) -> f64 {
        if let Some(radius) = self.discretization.enrichment_radius {
            return radius;
        }
        let position = |tip: TipId| self.cracks[tip.crack as usize].end_point(tip.end);
        let length = self.cracks[tip.crack as usize].length();
        let others = tips(&self.cracks).filter(|other| *other != tip);
        let distances = others.map(|other| (position(other) - position(tip)).length());
        0.25 * distances.fold(length, f64::min)
    }

    /// Applies the rules that hold for problem files to a problem built in code.
    ///
    /// # Errors
    /// Everything that is wrong, each named by its key.
    pub fn check(&self) -> Result<(), ProblemError> {
        let mistakes = check::mistakes(self);
        if mistakes.is_empty() {
            return Ok(());
        }
        let mistake = |mistake: check::MistakeAt| {
            let other = mistake.other.map_or(String::new(), |key| format!(" (see {key})"));
            let location = Location::Key(mistake.key.to_string());
            Mistake { location, message: mistake.message + &other }
        };
        Err(ProblemError::new(mistakes.into_iter().map(mistake).collect()))
    }
}
