//! Warnings about tips and their stress intensity factors.

use super::curves::of_curve;
use super::faces::remedy;
use super::{LARGE_ERROR, short, warning};
use crate::intensity::{TipObstacle, TipResult};
use ppum::crack::Crack;
use ppum::dataset::{TipIntensity, Warning, WarningKind};
use ppum::text::{LocationText, trimmed_to};
use ppum_problem::Problem;
use ppum_problem::geometry::AMPLE_CLEARANCE;
use ppum_solve::terms::face_law;

/// Difference of the factors at three radii, in parts of their size, above which they are not to be
/// trusted. Below it they may be wrong as well, see [`TipIntensity::spread`].
pub(super) const LARGE_SPREAD: f64 = 0.01;

/// Part of |K| that K_I may be negative by where it should be zero.
const NOISE: f64 = 1e-3;

/// Estimated errors of K that K_I of closed faces may be negative by: estimates are no bounds.
const CLOSED: f64 = 3.0;

/// Part of the [energy scale](TipResult::energy_scale) below which factors are rounding and
/// discretisation: a crack along the load has none.
const NOTHING: f64 = 0.01;

/// Distance of a tip to the boundary, in lengths of its crack, below which the ligament is nearly
/// broken through.
const NEAR_BORDER: f64 = 0.05;

/// Least number of cells along a crack.
const LEAST_CELLS: f64 = 4.0;

/// The warnings about the tips of a step, whose cracks these are.
pub(super) fn of_tips(
    problem: Option<&Problem>,
    outcomes: &[TipResult],
    cracks: &[Crack],
    places: &LocationText,
) -> Vec<Warning> {
    let of_tip = |outcome: &TipResult| {
        let crack = &cracks[outcome.tip.crack as usize];
        let length = crack.length();
        let at = &places.show(outcome.at);
        let about_factors = match &outcome.factors {
            Some(factors) => [
                negative(problem, (outcome, at), factors),
                spread(outcome, factors, at),
                unresolved(outcome, at, &places.show(outcome.doubt.at)),
                of_curve(outcome, factors, crack, at),
            ],
            None => [Some(no_room(outcome, at)), None, None, None],
        };
        let about_place = [
            little_room(outcome, at),
            near_interface(outcome, at),
            near_border(outcome, length, at),
            coarse(problem, outcome, length, at),
        ];
        about_factors.into_iter().chain(about_place).flatten()
    };
    outcomes.iter().flat_map(of_tip).collect()
}

/// |K|, or more where that is nothing but noise.
fn size(outcome: &TipResult, factors: &TipIntensity) -> f64 {
    factors.k1.hypot(factors.k2).max(NOTHING * outcome.energy_scale)
}

fn negative(
    problem: Option<&Problem>,
    (outcome, at): (&TipResult, &str),
    factors: &TipIntensity,
) -> Option<Warning> {
    let k1 = factors.k1;
    // closed faces have none except for its error
    let touches = problem.is_some_and(|all| face_law(all, outcome.tip.crack).is_some());
    let error = if touches { CLOSED * factors.error.unwrap_or(0.0) } else { 0.0 };
    let limit = -(NOISE * size(outcome, factors)).max(error);
    let message = format!(
        "tip {at}: K_I = {} is negative: the faces of the crack overlap there, and the solution has no \
         meaning near it; {}",
        short(k1),
        remedy(problem, outcome.tip.crack)
    );
    (k1 < limit).then(|| warning(WarningKind::NegativeK1, Some(outcome.at), [k1, limit], message))
}

fn spread(outcome: &TipResult, factors: &TipIntensity, at: &str) -> Option<Warning> {
    let spread = factors.largest_difference() / size(outcome, factors);
    let message = format!(
        "tip {at}: the values at three radii, which should agree, differ by {} % (no estimate of the error, \
         which may be larger); use smaller cells there",
        short((1e3 * spread).round() / 10.0)
    );
    (spread > LARGE_SPREAD)
        .then(|| warning(WarningKind::Spread, Some(outcome.at), [spread, LARGE_SPREAD], message))
}

fn unresolved(outcome: &TipResult, tip: &str, place: &str) -> Option<Warning> {
    let error = outcome.doubt.functions;
    let message = format!(
        "tip {tip}: a function or a coefficient varies too fast around {place}: integrals over a piece of a cell in its disc \
         are off by about {error:.1e}; use smaller cells there, or a smoother formula"
    );
    let place = Some(outcome.doubt.at);
    (error > LARGE_ERROR)
        .then(|| warning(WarningKind::Quadrature, place, [error, LARGE_ERROR], message))
}

fn no_room(outcome: &TipResult, at: &str) -> Warning {
    let (radius, needed) = (outcome.clearance.radius, outcome.needed());
    let message = if outcome.clearance.end == TipObstacle::Interface {
        format!(
            "tip {at}: no stress intensity factors, because it lies on an interface of two materials: stresses there are not \
             those of K_I and K_II, 1/√r, but of another power of r; let the crack end off the interface"
        )
    } else if radius <= f64::EPSILON * needed {
        format!(
            "tip {at}: no stress intensity factors, because it lies on {}; move it away",
            outcome.clearance.end.name()
        )
    } else {
        format!(
            "tip {at}: no stress intensity factors: the disc up to {} has a radius of {}, but {} is \
             needed with cells {} wide; use cells of at most {} there, or move the tip away",
            outcome.clearance.end.name(),
            short(radius),
            short(needed),
            short(outcome.cell),
            short(radius * outcome.cell / needed)
        )
    };
    warning(WarningKind::NoRoom, Some(outcome.at), [radius, needed], message)
}

fn little_room(outcome: &TipResult, at: &str) -> Option<Warning> {
    let (radius, ample) = (outcome.clearance.radius, AMPLE_CLEARANCE * outcome.cell);
    let little = outcome.factors.is_some() && radius < ample;
    little.then(|| {
        let message = format!(
            "tip {at}: the disc up to {} has a radius of {} cells only, and the factors may be off by \
             1 %; use cells of at most {} there",
            outcome.clearance.end.name(),
            short((100.0 * radius / outcome.cell).round() / 100.0),
            short(radius / AMPLE_CLEARANCE)
        );
        warning(WarningKind::LittleRoom, Some(outcome.at), [radius, ample], message)
    })
}

fn near_interface(outcome: &TipResult, at: &str) -> Option<Warning> {
    let (distance, ample) = (outcome.interface?, AMPLE_CLEARANCE * outcome.cell);
    outcome.factors.as_ref()?;
    let message = format!(
        "tip {at}: an interface of two materials passes at a distance of {} cells, and the factors may be \
         off by {}; use cells of at most {} there, and a `kink` along the interface",
        short((100.0 * distance / outcome.cell).round() / 100.0),
        if distance < 0.5 * outcome.cell { "several %" } else { "1 %" },
        short(distance / AMPLE_CLEARANCE)
    );
    Some(warning(WarningKind::NearInterface, Some(outcome.at), [distance, ample], message))
}

fn near_border(outcome: &TipResult, length: f64, at: &str) -> Option<Warning> {
    let (radius, limit) = (outcome.clearance.radius, NEAR_BORDER * length);
    let free = matches!(outcome.clearance.end, TipObstacle::Border | TipObstacle::Hole(_));
    (free && radius < limit).then(|| {
        let message = format!(
            "tip {at}: it is {} from {}, {} % of the crack's length: the factors grow like one over \
             the root of that distance; see that the position is meant, or let the crack end there",
            short(radius),
            outcome.clearance.end.name(),
            trimmed_to(100.0 * radius / length, 2)
        );
        warning(WarningKind::TipNearBorder, Some(outcome.at), [radius, limit], message)
    })
}

fn coarse(
    problem: Option<&Problem>,
    outcome: &TipResult,
    length: f64,
    at: &str,
) -> Option<Warning> {
    let is_off = problem.is_some_and(|problem| !problem.discretization.refine);
    let cells = length / outcome.cell;
    (cells < LEAST_CELLS).then(|| {
        let message = format!(
            "tip {at}: its crack is only {} cells long; use cells of at most {} there{}",
            short((100.0 * cells).round() / 100.0),
            short(length / LEAST_CELLS),
            if is_off { ", or leave out `refine = false`" } else { "" }
        );
        warning(WarningKind::Coarse, Some(outcome.at), [cells, LEAST_CELLS], message)
    })
}
