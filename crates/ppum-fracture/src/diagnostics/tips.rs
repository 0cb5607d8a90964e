//! Warnings about tips and their stress intensity factors.

use super::faces::remedy;
use super::{LARGE_ERROR, above, percent, short, unresolved_function};
use crate::intensity::{QuadratureErrorEstimate, TipObstacle, TipResult};
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

/// A tip that is judged.
struct JudgedTip<'a> {
    problem: Option<&'a Problem>,
    result: &'a TipResult,
    crack: &'a Crack,
    /// Its place, in words.
    at: String,
}

/// The warnings about the tips of a step, whose cracks these are.
pub(super) fn of_tips(
    problem: Option<&Problem>,
    results: &[TipResult],
    cracks: &[Crack],
    places: &LocationText,
) -> Vec<Warning> {
    let of_tip = |result: &TipResult| {
        let &TipResult { tip, at, doubt, .. } = result;
        let (crack, at) = (&cracks[tip.crack as usize], places.show(at));
        JudgedTip { problem, result, crack, at }.warnings(&places.show(doubt.at))
    };
    results.iter().flat_map(of_tip).collect()
}

impl JudgedTip<'_> {
    /// The warnings about the tip, whose integrands are not resolved at a place in words.
    fn warnings(&self, unresolved: &str) -> impl Iterator<Item = Warning> + use<> {
        let about_factors = match &self.result.factors {
            Some(factors) => {
                [self.negative(factors), self.spread(factors), self.unresolved(unresolved)]
            }
            None => [Some(self.no_room()), None, None],
        };
        let about_place =
            [self.little_room(), self.near_interface(), self.near_border(), self.coarse()];
        about_factors.into_iter().chain(about_place).flatten()
    }

    fn warning(&self, kind: WarningKind, numbers: [f64; 2], message: &str) -> Warning {
        let message = format!("tip {}: {message}", self.at);
        Warning::new(kind, Some(self.result.at), numbers, message)
    }

    /// |K|, or more where that is nothing but noise.
    fn size(&self, factors: &TipIntensity) -> f64 {
        factors.k1.hypot(factors.k2).max(NOTHING * self.result.energy_scale)
    }

    /// A length in cells at the tip, in words.
    fn in_cells(&self, length: f64) -> String {
        short((100.0 * length / self.result.cell).round() / 100.0)
    }

    fn negative(&self, factors: &TipIntensity) -> Option<Warning> {
        let (k1, crack) = (self.result.opening, self.result.tip.crack);
        // closed faces have none except for its error
        let touches = self.problem.is_some_and(|all| face_law(all, crack).is_some());
        let error = if touches { CLOSED * factors.error.unwrap_or(0.0) } else { 0.0 };
        let limit = -(NOISE * self.size(factors)).max(error);
        let message = format!(
            "K_I = {} is negative: the faces of the crack overlap there, and the solution has no \
             meaning near it; {}",
            short(k1),
            remedy(self.problem, crack)
        );
        (k1 < limit).then(|| self.warning(WarningKind::NegativeK1, [k1, limit], &message))
    }

    fn spread(&self, factors: &TipIntensity) -> Option<Warning> {
        let spread = factors.largest_difference() / self.size(factors);
        let message = format!(
            "the values at three radii, which should agree, differ by {} % (no estimate of the error, \
             which may be larger); use smaller cells there",
            percent(spread)
        );
        let numbers = [spread, LARGE_SPREAD];
        (spread > LARGE_SPREAD).then(|| self.warning(WarningKind::Spread, numbers, &message))
    }

    fn unresolved(&self, place: &str) -> Option<Warning> {
        let QuadratureErrorEstimate { functions: error, at, .. } = self.result.doubt;
        let message = unresolved_function(place, "in its disc ", error);
        let message = format!("tip {}: {message}", self.at);
        above(WarningKind::Quadrature, Some(at), [error, LARGE_ERROR], message)
    }

    fn no_room(&self) -> Warning {
        let TipResult { clearance, cell, .. } = self.result;
        let (radius, needed) = (clearance.radius, self.result.needed());
        let message = match clearance.end {
            TipObstacle::Interface => {
                "no stress intensity factors, because it lies on an interface of two materials: stresses there \
                 are not those of K_I and K_II, 1/√r, but of another power of r; let the crack end off the interface"
                    .into()
            }
            end if radius <= f64::EPSILON * needed => {
                let end = end.name();
                format!("no stress intensity factors, because it lies on {end}; move it away")
            }
            end => format!(
                "no stress intensity factors: the disc up to {} has a radius of {}, but {} is \
                 needed with cells {} wide; use cells of at most {} there, or move the tip away",
                end.name(),
                short(radius),
                short(needed),
                short(*cell),
                short(radius * cell / needed)
            ),
        };
        self.warning(WarningKind::NoRoom, [radius, needed], &message)
    }

    fn little_room(&self) -> Option<Warning> {
        let TipResult { clearance, cell, factors, .. } = self.result;
        let (radius, ample) = (clearance.radius, AMPLE_CLEARANCE * cell);
        let message = format!(
            "the disc up to {} has a radius of {} cells only, and the factors may be off by 1 %; use \
             cells of at most {} there",
            clearance.end.name(),
            self.in_cells(radius),
            short(radius / AMPLE_CLEARANCE)
        );
        (factors.is_some() && radius < ample)
            .then(|| self.warning(WarningKind::LittleRoom, [radius, ample], &message))
    }

    fn near_interface(&self) -> Option<Warning> {
        let TipResult { interface, cell, factors, .. } = self.result;
        let (distance, _) = interface.zip(factors.as_ref())?;
        let message = format!(
            "an interface of two materials passes at a distance of {} cells, and the factors may be \
             off by {}; use cells of at most {} there, and a `kink` along the interface",
            self.in_cells(distance),
            if distance < 0.5 * cell { "several %" } else { "1 %" },
            short(distance / AMPLE_CLEARANCE)
        );
        let numbers = [distance, AMPLE_CLEARANCE * cell];
        Some(self.warning(WarningKind::NearInterface, numbers, &message))
    }

    fn near_border(&self) -> Option<Warning> {
        let (clearance, length) = (self.result.clearance, self.crack.length());
        let (radius, limit) = (clearance.radius, NEAR_BORDER * length);
        let message = format!(
            "it is {} from {}, {} % of the crack's length: the factors grow at least like \
             one over the root of that distance; see that the position is meant, or let the crack end there",
            short(radius),
            clearance.end.name(),
            trimmed_to(100.0 * radius / length, 2)
        );
        let is_free = matches!(clearance.end, TipObstacle::Border | TipObstacle::Hole(_));
        (is_free && radius < limit)
            .then(|| self.warning(WarningKind::TipNearBorder, [radius, limit], &message))
    }

    fn coarse(&self) -> Option<Warning> {
        let is_off = self.problem.is_some_and(|problem| !problem.discretization.refine);
        let length = self.crack.length();
        let cells = length / self.result.cell;
        let message = format!(
            "its crack is only {} cells long; use cells of at most {} there{}",
            self.in_cells(length),
            short(length / LEAST_CELLS),
            if is_off { ", or leave out `refine = false`" } else { "" }
        );
        (cells < LEAST_CELLS)
            .then(|| self.warning(WarningKind::Coarse, [cells, LEAST_CELLS], &message))
    }
}
