//! Supports and loads, as the problem file of a dataset has them.

use ppum::dataset::Dataset;
use ppum_figure::overlay::{Load, Support};

use crate::notice::Notice;

/// Points along the border with supports and loads.
#[derive(Debug, Default)]
pub(crate) struct Stations {
    pub(crate) supports: Vec<Support>,
    pub(crate) loads: Vec<Load>,
}

impl Stations {
    /// Those of a dataset's problem, about `spacing` apart.
    #[cfg(feature = "problem")]
    pub(crate) fn of(dataset: &Dataset, spacing: f64) -> Result<Self, Notice> {
        use ppum::vec2::Vec2;
        use ppum_solve::problem::{Problem, Station};

        let problem = Problem::of_dataset(dataset).map_err(|_| Notice::UnreadableProblem)?;
        let stations = problem.ok_or(Notice::NoProblem)?.stations(spacing);
        let support = |&Station { at, outward, held, .. }: &Station| Support { at, outward, held };
        let load =
            |&Station { at, outward, traction, .. }: &Station| Load { at, outward, traction };
        let held = stations.iter().filter(|station| station.held != [false; 2]);
        let loaded = stations.iter().filter(|station| station.traction != Vec2::ZERO);
        Ok(Self { supports: held.map(support).collect(), loads: loaded.map(load).collect() })
    }

    /// Without the solver nobody reads problem files.
    #[cfg(not(feature = "problem"))]
    pub(crate) fn of(_: &Dataset, _: f64) -> Result<Self, Notice> {
        Err(Notice::UnreadableProblem)
    }
}
