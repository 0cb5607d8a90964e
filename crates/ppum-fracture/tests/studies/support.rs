//! Problems from texts, solving, and norms of what was found.

use std::path::Path;

use ppum::crack::Side;
use ppum::dataset::{Dataset, Step};
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::vec2::Vec2;
use ppum_fracture::solve::solve;
use ppum_problem::{Problem, ProblemData};
use ppum_solve::norms::norms;
use ppum_solve::space::TrialSpace;
use ppum_testkit::exact::Component;

/// Relative errors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Errors {
    /// In the energy norm.
    pub(crate) energy: f64,
    /// In L².
    pub(crate) l2: f64,
}

/// Solves a problem that is in order.
pub(crate) fn solved(problem: &ProblemData) -> Dataset {
    solve(&checked(problem), unwatched()).expect("a solution")
}

/// The problem of data that are in order.
pub(crate) fn checked(problem: &ProblemData) -> Problem {
    Problem::new(problem.clone()).expect("a problem in order")
}

/// The problem of the text of a problem file that is in order.
pub(crate) fn parsed(text: &str) -> ProblemData {
    let problem = Problem::parse(text, "plate.toml", Path::new(""));
    problem.unwrap_or_else(|error| panic!("{error}\n{text}")).into_data()
}

/// Values and gradients of two components.
pub(crate) type Both = ([f64; 2], [Vec2; 2]);

/// Values and gradients of an exact field.
pub(crate) fn both(components: [Component; 2]) -> Both {
    (components.map(|c| c.value), components.map(|c| c.gradient))
}

/// Errors of the first field of the first step.
pub(crate) fn errors(dataset: &Dataset, exact: &(dyn Fn(Vec2) -> Both + Sync)) -> Errors {
    let space =
        TrialSpace::new(&dataset.steps[0], &dataset.domain, &dataset.equation, &dataset.tables)
            .expect("functions that compile");
    let field = Field::new(dataset, 0).expect("a field");
    let jets = |anchor: Vec2, offset: Vec2| {
        let (values, gradients) = exact(anchor + offset);
        let jet =
            |k: usize| Jet { x: gradients[k].x, y: gradients[k].y, ..Jet::constant(values[k]) };
        [jet(0), jet(1)]
    };
    let [_, reference, difference] = norms(&field, &space, &jets);
    let (energy, l2) = difference.relative_to(&reference);
    Errors { energy, l2 }
}

/// ∫ σ:∇u and ∫ |u|² of the first field.
pub(crate) fn squares(dataset: &Dataset) -> (f64, f64) {
    let space =
        TrialSpace::new(&dataset.steps[0], &dataset.domain, &dataset.equation, &dataset.tables)
            .expect("functions that compile");
    let field = Field::new(dataset, 0).expect("a field");
    let zero = |_: Vec2, _: Vec2| [Jet::constant(0.0); 2];
    let [own, ..] = norms(&field, &space, &zero);
    (own.energy, own.l2)
}

/// Strain energy ½ ∫ σ:ε.
pub(crate) fn strain_energy(dataset: &Dataset) -> f64 {
    0.5 * squares(dataset).0
}

/// A quantity of the first field at a point.
pub(crate) fn quantity(dataset: &Dataset, name: &str, at: Vec2) -> f64 {
    let field = Field::new(dataset, 0).expect("a field");
    let quantity = Quantity::parse(name, &field).expect("a quantity");
    quantity.at(&mut field.at(at), Vec2::ZERO, Side::Above)
}

/// A record of a step's history, NaN if there is none.
pub(crate) fn record(step: &Step, name: &str) -> f64 {
    step.history.iter().find(|record| record.name == name).map_or(f64::NAN, |record| record.value)
}

/// Unknowns of the first step.
pub(crate) fn unknowns(dataset: &Dataset) -> usize {
    dataset.steps[0].unknowns()
}
