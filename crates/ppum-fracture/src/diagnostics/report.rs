//! Warnings about the solution as a whole, from the numbers of the solver's report.

use super::warning::{LARGE_CUT_OFF, LARGE_IMBALANCE, LARGE_NITSCHE, LARGE_RESIDUAL, above};
use ppum::dataset::{Step, Warning, WarningKind};
use ppum::domain::Domain;
use ppum_problem::Adaptivity;
use ppum_solve::report::{SolverReport, StopReason};

/// The warnings about the solution as a whole, from the solver's report. Records that the report
/// lacks are not judged.
pub(super) fn of_report(
    report: &SolverReport,
    adaptivity: Option<&Adaptivity>,
    cutters: Cutters,
) -> Vec<Warning> {
    let rules = [
        (WarningKind::Residual, report.residual, LARGE_RESIDUAL, residual as RecordMeaning),
        (WarningKind::Imbalance, report.imbalance, LARGE_IMBALANCE, imbalance),
        (WarningKind::CutOff, report.cut_off_part(), LARGE_CUT_OFF, cut_off),
        (WarningKind::Nitsche, report.nitsche, LARGE_NITSCHE, nitsche),
        (WarningKind::CrossedTwice, report.crossed_twice.map(|n| n as f64), 0.0, crossed_twice),
        (WarningKind::Solver, report.fallback.then_some(1.0), 0.0, fallback),
    ];
    let found = rules.into_iter().filter_map(|(kind, value, limit, message)| {
        above(kind, None, [value?, limit], message(value?, cutters))
    });
    found.chain(of_tolerance(report, adaptivity)).collect()
}

/// The warning about an adaptation that ended before the estimated error was as small as wanted.
fn of_tolerance(report: &SolverReport, adaptivity: Option<&Adaptivity>) -> Option<Warning> {
    let (stop, adaptivity) = (report.stop?, adaptivity?);
    let of_energy = report.estimated_error?.powi(2);
    let (key, wanted, found) = match (adaptivity.accuracy, adaptivity.tolerance) {
        (Some(wanted), _) => ("accuracy", wanted, report.factor_error.unwrap_or(of_energy)),
        (None, tolerance) => ("tolerance", tolerance?, report.estimated_error?),
    };
    let (reason, remedy) = match stop {
        StopReason::Tolerance => return None,
        StopReason::Steps => ("`steps` are made", "raise it"),
        StopReason::Unknowns => ("the next step would exceed `max_unknowns`", "raise it"),
        StopReason::Memory => ("the memory does not hold the next step", "give more of it"),
        StopReason::Limits => {
            ("orders and cells are at their limits", "take another `kind` or smaller cells")
        }
    };
    let message = format!(
        "the estimated error is {found:.1e}, not {wanted:e} as wanted, and {reason}; {remedy}, or a larger `{key}`"
    );
    Some(Warning::new(WarningKind::Tolerance, None, [found, wanted], message))
}

/// The meaning of a number of the report, on a body with these cutters.
type RecordMeaning = fn(f64, Cutters) -> String;

/// The things that cut cells of a body into parts, as far as there are any: texts speak of
/// nothing else.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cutters {
    Nothing,
    Cracks,
    Holes,
    Both,
}

impl Cutters {
    pub(super) fn new(step: &Step, domain: &Domain) -> Self {
        match (step.cracks.is_empty(), domain.holes.is_empty()) {
            (true, true) => Self::Nothing,
            (false, true) => Self::Cracks,
            (true, false) => Self::Holes,
            (false, false) => Self::Both,
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Nothing => "a function",
            Self::Cracks => "a crack",
            Self::Holes => "a hole",
            Self::Both => "a crack or a hole",
        }
    }
}

fn residual(value: f64, cutters: Cutters) -> String {
    let suspects = match cutters {
        Cutters::Nothing => "",
        Cutters::Cracks => "cracks that nearly touch, or ",
        Cutters::Holes => "rims that nearly touch, or ",
        Cutters::Both => "cracks or rims that nearly touch, or ",
    };
    format!(
        "the residual of the linear system is {value:.1e} of the load; the solution has lost digits: look for \
         {suspects}cells far smaller than their neighbours, or for a material whose constants differ by many orders of magnitude"
    )
}

fn imbalance(value: f64, _: Cutters) -> String {
    format!(
        "{value:.1e} of the loads remain unbalanced on a plate that nothing holds, and are left \
         out; balance the loads, or hold the plate"
    )
}

fn fallback(_: f64, _: Cutters) -> String {
    "the multilevel solver does not come to a solution here, and the direct one took its place, which needs more memory \
     and time on fine covers; ask for it by `kind = \"direct\"`, or hold the pieces of the plate"
        .to_owned()
}

fn cut_off(value: f64, cutters: Cutters) -> String {
    let fewer = match cutters {
        Cutters::Cracks | Cutters::Both => "a smaller `enrichment_radius` or a lower `order` gives",
        Cutters::Holes | Cutters::Nothing => {
            "fewer functions of [[enrichment]] or a lower `order` give"
        }
    };
    format!(
        "{:.0} % of the functions depend on others and were cut off; {fewer} the same with less work",
        100.0 * value
    )
}

fn nitsche(value: f64, cutters: Cutters) -> String {
    let penalty = format!(
        "the penalty there is {value:.1e} times the stiffness over the cell's width, 3 to 36 in whole cells"
    );
    match cutters {
        Cutters::Nothing => format!(
            "a function of [[enrichment]] is steep at a held edge: {penalty}; use smaller cells there, or keep it away"
        ),
        _ => {
            let name = cutters.name();
            let end = if cutters == Cutters::Holes { "hole" } else { "end of the crack" };
            format!(
                "{name} cuts a cell at a held edge into a sliver: {penalty}; move the {end} or the support, or \
                 use smaller cells there"
            )
        }
    }
}

fn crossed_twice(value: f64, _: Cutters) -> String {
    let patches = if value == 1.0 { "1 patch is" } else { &format!("{value} patches are") };
    format!(
        "{patches} crossed twice by the rim of one hole, and two of the parts that it cuts them into are glued \
         together; use smaller cells at its sharp corner"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Texts do not speak of features that the body does not have.
    #[test]
    fn texts_speak_of_what_there_is() {
        let texts: [RecordMeaning; 5] = [residual, imbalance, cut_off, nitsche, crossed_twice];
        for (cutters, absent) in [
            (Cutters::Nothing, &["crack", "hole", "rim"][..]),
            (Cutters::Cracks, &["hole", "rim"]),
            (Cutters::Holes, &["crack", "enrichment_radius"]),
        ] {
            // without holes nothing is crossed
            let has_holes = matches!(cutters, Cutters::Holes | Cutters::Both);
            for text in &texts[..if has_holes { 5 } else { 4 }] {
                let text = text(0.5, cutters);
                let mut words = text.split(|c: char| !c.is_alphabetic() && c != '_');
                let is_absent = |word: &str| absent.iter().any(|a| word.starts_with(a));
                assert!(!words.any(is_absent), "{cutters:?}: {text}");
            }
        }
        assert!(nitsche(1e5, Cutters::Cracks).starts_with("a crack cuts a cell"));
    }
}
