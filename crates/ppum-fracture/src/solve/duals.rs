//! The dual solutions of the factors of tips, exact to rounding.

use super::SolveError;
use super::adaptive::adapted_mesh;
use super::assembled::Assembled;
use super::clock::Clock;
use super::plan::Plan;
use super::unknowns::Unknowns;
use crate::intensity::TipDisc;
use ppum::crack::TipId;
use ppum::dataset::{Attribute, Dataset};
use ppum::progress::{Phase, Watcher};
use ppum_problem::Problem;
use ppum_solve::assembly::PENALTY;
use ppum_solve::law::Law;
use ppum_solve::watched::WorkPhase;

/// The dual solutions of both factors of some tips.
pub(crate) struct DualSolutions {
    /// The dataset of the body without loads.
    pub(crate) dataset: Dataset,
    /// The discs of the tips' factors; of tips without room for one there are none.
    pub(crate) discs: Vec<TipDisc>,
    /// The coefficients of the solutions of both modes of the first of these tips, then of the
    /// next, in the order of the dataset's field.
    pub(crate) coefficients: Vec<Vec<f64>>,
}

impl DualSolutions {
    /// Solves for the factors of tips of a body without loads, on the cells of the problem, or
    /// those that its adaptation leads to.
    ///
    /// # Errors
    /// See [`SolveError`].
    pub(crate) fn new(
        (problem, unloaded): (&Problem, &Problem),
        tips: &[TipId],
        memory: Option<u64>,
        watcher: &dyn Watcher,
    ) -> Result<Self, SolveError> {
        let mut plan = match &problem.adaptivity {
            None => Plan::new(unloaded, memory, watcher)?,
            Some(set) => {
                let mesh = adapted_mesh(Plan::new(problem, memory, watcher)?, set, watcher)?;
                let stage = WorkPhase::uncounted(watcher, Phase::Cover)?;
                Plan::on(unloaded, mesh, memory, (Clock::new(), &stage))?
            }
        };
        let law = Law::new(&unloaded.equation);
        let mut assembled = Assembled::with(&mut plan, &law, Some(tips), watcher)?;
        let Unknowns { all, .. } = Unknowns::new(&plan, &mut assembled, watcher)?;
        let Plan { space, mut dataset, .. } = plan;
        let values = assembled.system.penalties();
        dataset.steps[0].attributes.push(Attribute { name: PENALTY.into(), values });
        let components = unloaded.components();
        let plain = |dual: &Vec<f64>| assembled.basis.plain(&space, dual, components);
        let coefficients = all.iter().skip(1).map(plain).collect();
        Ok(Self { coefficients, dataset, discs: assembled.tips })
    }
}
