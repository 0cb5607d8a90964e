//! Supports and loads, as the problem file of a dataset has them.

use ppum::dataset::Dataset;
use ppum::quantity::Reflection;
use ppum_figure::overlay::{LoadMark, SupportMark};

use crate::image::mirror_lines::MirrorLines;
use crate::image::notice::Notice;

/// Points along the border with supports and loads.
#[derive(Debug, Default)]
pub(crate) struct BoundarySamples {
    pub(crate) supports: Vec<SupportMark>,
    pub(crate) loads: Vec<LoadMark>,
}

/// Distance from a line of symmetry, in parts of the body, on which a support lies on it, and the
/// difference of directions that is rounding.
const ON_LINE: f64 = 1e-9;

impl BoundarySamples {
    /// Those of the whole of a body: its own and their reflections, without the supports along
    /// lines of symmetry, which nothing holds there.
    pub(crate) fn mirrored(mut self, lines: &MirrorLines) -> Self {
        let (supports, loads) = (self.supports.clone(), self.loads.clone());
        let holds = |reflection: &Reflection, support: &SupportMark| {
            let normal = support.outward;
            let is_across = reflection.vector(normal).dot(normal) < ON_LINE - 1.0;
            let way = reflection.point(support.at) - support.at;
            !(is_across && way.length() <= ON_LINE * support.at.length().max(1.0))
        };
        let all: Vec<Reflection> = lines.reflections().collect();
        let is_held = |support: &SupportMark| all.iter().all(|one| holds(one, support));
        self.supports.retain(is_held);
        for one in &all {
            let (supports, loads) = (supports.iter().filter(|s| is_held(s)), loads.iter());
            self.supports.extend(supports.map(|support| SupportMark {
                at: one.point(support.at),
                outward: one.vector(support.outward),
                axis: support.axis.map(|axis| one.vector(axis)),
                ..*support
            }));
            self.loads.extend(loads.map(|load| LoadMark {
                at: one.point(load.at),
                outward: one.vector(load.outward),
                traction: one.vector(load.traction) * one.sign(),
            }));
        }
        self
    }

    /// Those of a dataset's problem, about `spacing` apart.
    #[cfg(feature = "problem")]
    pub(crate) fn of(dataset: &Dataset, spacing: f64) -> Result<Self, Notice> {
        use ppum::vec2::Vec2;
        use ppum_problem::{BoundaryStation, Problem};

        let problem = Problem::of_dataset(dataset).map_err(|_| Notice::UnreadableProblem)?;
        let stations = problem.ok_or(Notice::NoProblem)?.stations(spacing);
        let support =
            |&BoundaryStation { at, outward, held, axis, exchanges, .. }: &BoundaryStation| {
                SupportMark { at, outward, held, axis, yields: exchanges }
            };
        let load = |&BoundaryStation { at, outward, traction, .. }: &BoundaryStation| LoadMark {
            at,
            outward,
            traction,
        };
        let held =
            stations.iter().filter(|station| station.exchanges || station.held != [false; 2]);
        let loaded = stations.iter().filter(|station| station.traction != Vec2::ZERO);
        Ok(Self { supports: held.map(support).collect(), loads: loaded.map(load).collect() })
    }

    /// Without the solver nobody reads problem files.
    #[cfg(not(feature = "problem"))]
    pub(crate) fn of(_: &Dataset, _: f64) -> Result<Self, Notice> {
        Err(Notice::UnreadableProblem)
    }
}
