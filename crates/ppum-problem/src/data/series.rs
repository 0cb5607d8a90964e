//! Problems of the steps of a dataset.

use ppum::crack::Crack;
use ppum::dataset::Dataset;
use ppum::vec2::Vec2;

use super::{Diagnostic, Problem, ProblemError, ProblemLocation};

impl Problem {
    /// The problem of a step of a dataset: the one that the dataset holds, with the cracks of the
    /// step where cracks grow; none if it holds none. Its loads are those that act in the step.
    ///
    /// # Errors
    /// Everything that is wrong in the text; cracks of the step that are neither those of the
    /// problem nor what these grow to, since nothing is known of the loads on them.
    pub fn of_step(dataset: &Dataset, step: usize) -> Result<Option<Self>, ProblemError> {
        let Some(problem) = Self::of_dataset(dataset)? else { return Ok(None) };
        let cracks = dataset.steps.get(step).map_or(&[][..], |step| &step.cracks);
        let has_grown = problem.growth.is_some() && go_on(problem.cracks(), cracks);
        if has_grown || problem.cracks() == cracks {
            return Ok(Some(problem.with_cracks(cracks.to_vec())));
        }
        let location = ProblemLocation::File("problem".into());
        Err(Diagnostic { location, message: format!("it has other cracks than step {step}") }
            .into())
    }
}

/// True if each crack runs along the whole of one that there was before.
fn go_on(before: &[Crack], cracks: &[Crack]) -> bool {
    let along = |old: &Crack, new: &Crack| {
        let far = ROUNDING * old.length();
        let is_near = |p: Vec2| new.distance(p) <= far;
        old.edges().all(|edge| is_near(edge.from) && is_near(edge.middle()) && is_near(edge.to))
    };
    before.len() == cracks.len() && before.iter().zip(cracks).all(|(old, new)| along(old, new))
}

/// Distance from a crack that is rounding, in parts of its length: vertices that do not change its
/// path are removed.
const ROUNDING: f64 = 1e-9;
