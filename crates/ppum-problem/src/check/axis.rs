//! Rules for bodies of revolution about the axis x = 0.

use ppum::border::touch;

use crate::data::ProblemData;
use crate::file::{Key, KeyError};

/// All rules broken by a body of revolution.
pub(super) fn check_axis(problem: &ProblemData) -> Vec<KeyError> {
    if !problem.equation.is_axisymmetric() {
        return Vec::new();
    }
    let outside = outside(problem).into_iter();
    outside.chain(cracks(problem)).chain(conditions(problem)).chain(supports(problem)).collect()
}

/// A body on the other side of the axis.
fn outside(problem: &ProblemData) -> Option<KeyError> {
    let domain = problem.domain();
    let (body, touch) = (domain.body_bounds(), touch(&domain.bounds));
    (body.min.x < -touch).then(|| {
        let message = format!(
            "the body begins at x = {}, but x is the distance from the axis of a body of revolution; draw the half \
             with x ≥ 0 alone, or write another `state`",
            body.min.x
        );
        Key::new("domain.min").error(message)
    })
}

/// Cracks along the axis, and tips on it.
fn cracks(problem: &ProblemData) -> Vec<KeyError> {
    let touch = touch(&problem.domain().bounds);
    let is_on_axis = |x: f64| x.abs() <= touch;
    let message = |k: usize| {
        let crack = &problem.cracks()[k];
        let mut tips = crack.tips();
        if crack.edges().any(|edge| is_on_axis(edge.from.x) && is_on_axis(edge.to.x)) {
            return Some(
                "the crack runs along the axis, where a body of revolution has no faces; move it off x = 0",
            );
        }
        tips.any(|end| is_on_axis(crack.end_point(end).x))
            .then_some("the crack has a tip on the axis; let it end beyond, or on the border x = 0 where it opens")
    };
    let error = |k: usize| Some(Key::points(k).error(message(k)?));
    (0..problem.cracks().len()).filter_map(error).collect()
}

/// Conditions on the axis, which is no part of the boundary.
fn conditions(problem: &ProblemData) -> Vec<KeyError> {
    let (axis, own) = (problem.axis_lines(), problem.axis_conditions());
    let is_wrong = |k: &usize| {
        let condition = &problem.boundary[*k];
        !own.contains(condition) && axis.iter().any(|line| problem.meets_line(condition.on, line))
    };
    let message = "the border x = 0 is the axis of the body of revolution, where u_x = 0 holds of itself and nothing \
                   else can be given; leave this [[boundary]] out";
    let error = |k: usize| Key::new("boundary").index(k).name("on").error(message);
    (0..problem.boundary.len()).filter(is_wrong).map(error).collect()
}

/// Supports across the axis, along which alone a body of revolution may move.
fn supports(problem: &ProblemData) -> Vec<KeyError> {
    let all = problem.supports.iter().enumerate();
    let wrong = all.filter(|(_, support)| support.displacement[0].is_some());
    let message = "a body of revolution moves along its axis alone, and hoop strains hold it in x; write \
                   `displacement = [\"free\", 0]`";
    let error = |k| Key::new("support").index(k).name("displacement").error(message);
    wrong.map(|(k, _)| error(k)).collect()
}
