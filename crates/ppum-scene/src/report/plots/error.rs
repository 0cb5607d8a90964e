//! The reasons why there is no plot.

use std::error::Error;

/// The reason why there is no such plot.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlotError {
    /// A convergence of too few datasets.
    #[error(
        "a convergence is that of three datasets or more, or of the steps of one that has three or more"
    )]
    FewDatasets,
    /// Solutions of one size or two; these are their unknowns.
    #[error("a convergence is that of solutions of three different numbers of unknowns or more; these have {}",
        listed(.0))]
    FewSizes(Vec<f64>),
    /// A step that is not there.
    #[error("{name}: there is no step {step}")]
    Step {
        /// The dataset.
        name: String,
        /// The step.
        step: usize,
    },
    /// Steps of cracks that grow do not come near one solution.
    #[error(
        "a convergence is that of solutions of one problem, but the cracks of {0} grow from step to step; a plot of the series \
        shows what becomes of them"
    )]
    Grown(String),
    /// Two problems.
    #[error("a convergence is that of solutions of one problem, but {first} and {other} are of two: {what} differ{}",
        if what.ends_with("cracks") { "" } else { "s" })]
    OtherProblem {
        /// One dataset.
        first: String,
        /// The other.
        other: String,
        /// The property in which the datasets differ.
        what: &'static str,
    },
    /// Nothing that could be compared.
    #[error("the datasets have no numbers to compare")]
    Incomparable,
    /// A series of one step.
    #[error("{0}: a series is drawn over steps, but there is one alone")]
    OneStep(String),
    /// No number of steps.
    #[error("series are drawn of {known}, not of `{name}`")]
    UnknownNumber {
        /// The word.
        name: String,
        /// Those there are.
        known: String,
    },
    /// Steps without growth.
    #[error(
        "{0}: extensions are known of cracks that grow ([growth] in the problem file), and the steps of this dataset \
        hold no growth; over the length they can be drawn of all cracks"
    )]
    NoGrowth(String),
    /// Growth without cycles.
    #[error(
        "{0}: load cycles are known of growth by a law (such as `paris` in [growth] of the problem file), and the steps \
        of this dataset hold none"
    )]
    NoCycles(String),
    /// Steps without stress intensity factors.
    #[error("the steps hold no stress intensity factors")]
    NoIntensities,
    /// A history without what was asked for.
    #[error("{name}: its history has no {what}")]
    NoRecords {
        /// The dataset.
        name: String,
        /// The missing data.
        what: &'static str,
    },
    /// A solution that took no iterations, or no levels.
    #[error(
        "{name}: no {what} are told in its history; the multilevel solver has them (`kind = \"multilevel\"` in [solver])"
    )]
    NotIterated {
        /// The dataset.
        name: String,
        /// The missing data.
        what: &'static str,
    },
    /// A plot without anything in it.
    #[error("the plot would show nothing: {0}")]
    Nothing(&'static str),
    /// A field or an exact solution that cannot be evaluated.
    #[error(transparent)]
    Unevaluated(Box<dyn Error + Send + Sync>),
}

impl PlotError {
    pub(super) fn of(error: impl Error + Send + Sync + 'static) -> Self {
        Self::Unevaluated(Box::new(error))
    }
}

fn listed(sizes: &[f64]) -> String {
    sizes.iter().map(f64::to_string).collect::<Vec<_>>().join(" and ")
}
