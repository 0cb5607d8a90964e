//! The bounds that numbers with a warning pass.

use ppum::dataset::{Warning, WarningKind};
use ppum::text::trimmed_to;
use ppum::vec2::Vec2;
use ppum_problem::Problem;

/// Relative residual of the linear system above which it is not solved as well as it should be:
/// 1e-12 and less is usual.
pub(super) const LARGE_RESIDUAL: f64 = 1e-8;

/// Part of the loads that may remain unbalanced on a piece of the body that nothing holds; more is
/// seen in the solution's digits.
pub(super) const LARGE_IMBALANCE: f64 = 1e-8;

/// Part of the unknowns that the stable basis may cut off.
pub(super) const LARGE_CUT_OFF: f64 = 0.25;

/// Nitsche's β in units of (λ + 2μ) / cell width from which on a held boundary holds far more
/// tightly than the rest of the body resolves. Whole cells have 3 to 36, a crack that ends beside a
/// held edge 710, one along such an edge 8e4 at 1e-4 of a cell.
pub(super) const LARGE_NITSCHE: f64 = 1e4;

/// Part of a load's magnitude that its resultant may err by, and of the integrals of functions and
/// coefficients over a piece of a cell: quadrature aims at 1e-10.
pub(super) const LARGE_ERROR: f64 = 1e-6;

/// Part of the energy that may be lost to locking.
pub(super) const LARGE_LOCKING: f64 = 2e-3;

/// The warning about a value that is above its limit.
pub(super) fn above(
    kind: WarningKind,
    at: Option<Vec2>,
    [value, limit]: [f64; 2],
    message: String,
) -> Option<Warning> {
    (value > limit).then(|| Warning::new(kind, at, [value, limit], message))
}

/// Five digits, without zeros at the end.
pub(super) fn short(value: f64) -> String {
    trimmed_to(value, 5)
}

/// A part in percent, with one decimal.
pub(super) fn percent(part: f64) -> String {
    short((1e3 * part).round() / 10.0)
}

/// The key that makes cells smaller at a place: the one of the file that keeps them large, or
/// `[[refine]]` with the keys of the place.
pub(super) fn smaller_cells(problem: Option<&Problem>, keys: &str) -> String {
    let is_off = problem.is_some_and(|problem| !problem.discretization.refine);
    match is_off {
        true => "use smaller cells there (leave out `refine = false`)".into(),
        false => format!("use smaller cells there ([[refine]] with {keys})"),
    }
}

/// The message about a function or coefficient that the integrals over some cells, given in words,
/// do not resolve.
pub(super) fn unresolved_function(place: &str, of_cells: &str, error: f64) -> String {
    format!(
        "a function or a coefficient varies too fast around {place}: integrals over a piece of a cell {of_cells}are \
         off by about {error:.1e}; use smaller cells there, or a smoother formula"
    )
}
