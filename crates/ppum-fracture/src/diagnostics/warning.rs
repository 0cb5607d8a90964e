//! The kinds of warnings and the bounds that they pass.

use ppum::dataset::Warning;
use ppum::text::trimmed_to;
use ppum::vec2::Vec2;
use ppum_problem::Problem;

/// Relative residual of the linear system above which it is not solved as well as it should be:
/// 1e-12 and less is usual.
pub const LARGE_RESIDUAL: f64 = 1e-8;

/// Part of the loads that may remain unbalanced on a piece of the plate that nothing holds; more is
/// seen in the solution's digits.
pub const LARGE_IMBALANCE: f64 = 1e-8;

/// Part of the unknowns that the stable basis may cut off.
pub const LARGE_CUT_OFF: f64 = 0.25;

/// Nitsche's β in units of (λ + 2μ) / cell width from which on a held border holds far more tightly
/// than the rest of the plate resolves. Whole cells have 3 to 36, a crack that ends beside a held
/// edge 710, one along such an edge 8e4 at 1e-4 of a cell.
pub const LARGE_NITSCHE: f64 = 1e4;

/// Part of a load's magnitude that its resultant may err by, and of the integrals of functions and
/// coefficients over a piece of a cell: quadrature aims at 1e-10.
pub const LARGE_ERROR: f64 = 1e-6;

/// Part of the energy that may be lost to locking.
pub const LARGE_LOCKING: f64 = 2e-3;

/// Words of the kinds of warnings.
pub mod kind {
    /// The faces of a crack overlap.
    pub const FACES_OVERLAP: &str = "faces-overlap";
    /// K_I of a tip is negative.
    pub const NEGATIVE_K1: &str = "negative-k1";
    /// A tip has no factors, because it has too little room.
    pub const NO_ROOM: &str = "no-room";
    /// A tip has little room, so its factors are less accurate.
    pub const LITTLE_ROOM: &str = "little-room";
    /// A tip is close to an interface of two materials, measured by its cells.
    pub const NEAR_INTERFACE: &str = "near-interface";
    /// The factors at the radii of a tip differ.
    pub const SPREAD: &str = "spread";
    /// T is that of the segments of a crack that may be meant as a curve.
    pub const CURVE: &str = "curve";
    /// A tip is close to the border, measured by the length of its crack.
    pub const TIP_NEAR_BORDER: &str = "tip-near-border";
    /// A crack is as long as a few cells only.
    pub const COARSE: &str = "coarse";
    /// Loads do not balance to the last digits.
    pub const IMBALANCE: &str = "imbalance";
    /// The linear system has a large residual.
    pub const RESIDUAL: &str = "residual";
    /// The direct solver took the place of the multilevel one.
    pub const SOLVER: &str = "solver";
    /// Many functions were cut off as dependent.
    pub const CUT_OFF: &str = "cut-off";
    /// A crack cuts a cell at a held edge into a sliver.
    pub const NITSCHE: &str = "nitsche";
    /// Interfaces of materials are not resolved somewhere.
    pub const INTERFACE: &str = "interface";
    /// Coefficients cancel, and few digits of the stresses remain.
    pub const DIGITS: &str = "digits";
    /// The order is too low for a plate that is nearly incompressible.
    pub const LOCKING: &str = "locking";
    /// The pressure of a plate that is nearly incompressible oscillates.
    pub const PRESSURE: &str = "pressure";
    /// Patches remain that the rim of a hole crosses twice.
    pub const CROSSED_TWICE: &str = "crossed-twice";
    /// The cells at a singular point of the border are too large for its field.
    pub const SINGULAR_POINT: &str = "singular-point";
    /// An adaptation has ended before the estimated error was as small as wanted.
    pub const TOLERANCE: &str = "tolerance";
    /// The cells at the rim of a hole are too large for the stress there.
    pub const COARSE_HOLE: &str = "coarse-hole";
    /// A load or what is given on the border varies too fast to be integrated.
    pub const LOAD: &str = "load";
    /// A function or a coefficient varies too fast to be integrated.
    pub const QUADRATURE: &str = "quadrature";
}

pub(super) fn warning(
    kind: &str,
    at: Option<Vec2>,
    [value, limit]: [f64; 2],
    message: String,
) -> Warning {
    Warning { kind: kind.into(), at, value, limit, message }
}

/// Five digits, without zeros at the end.
pub(super) fn short(value: f64) -> String {
    trimmed_to(value, 5)
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
