//! Stress intensity factors by the interaction integral, and what stands beside them.
//!
//! With the field u, an auxiliary Williams field uᵃ with K = 1 in one mode, both in the tip's
//! frame, and a cut-off q that is 1 at the tip and 0 outside a disc (Yau, Wang & Corten 1980;
//! domain form of Moran & Shih 1987)
//!
//! ```text
//! M = ∫ P_j q_,j + P_j,j q dA − ∫ t_i uᵃ_i,1 q ds      K = E′/2 M
//! P_j = σ_ij uᵃ_i,1 + σᵃ_ij u_i,1 − σᵃ_ik ε_ik δ_1j
//! P_j,j = σ_ij (S_tip − S)_ijkl σᵃ_kl,1 − b_i uᵃ_i,1
//! ```
//!
//! with the compliance S of the material, the body force b, and the tractions t on both faces of
//! the crack. E′ and uᵃ are those of a uniform body of the material at the tip, and σᵃ is the
//! stress in that body, in equilibrium but at odds with ε = S σ elsewhere (Dolbow & Gosz 2002):
//! P_j,j is what that costs. It needs no derivative of the material and is of the order 1/r at the
//! tip. In a uniform material it is the body force's part alone.
//!
//! Across an interface of two materials P_j n_j does not jump: tractions are continuous, and so is
//! u, so that \[u_i,j\] = a_i n_j, and the jumps of the second and the third part cancel (Yu et al.
//! 2009). Interfaces may lie in the disc; only a tip on one has no factors, because its field is
//! another one.
//!
//! The crack may have kinks in the disc. The auxiliary fields then jump on the crack itself, where
//! θ does, and not on its axis; so they load the faces that are not along it, and the last integral
//! is −∫ P_j n_j q ds there. The gradient has a part along a face, ∂u/∂s, and one across it; the
//! latter cancels from σᵃ_ij n_j u_i,1 − σᵃ_ij u_i,j n_1, and with the outward normal n on the left
//! of s
//!
//! ```text
//! −∫ P_j n_j q ds = −∫ (t_i uᵃ_i,1 + σᵃ_i2 ∂u_i/∂s) q ds
//! ```
//!
//! on all faces: σᵃ_i2 = 0 where they are along the axis. The field of each side is taken as it is
//! on that side. Nothing else may lie in the disc: the radii are chosen in the [`TipClearance`] of
//! the tip.
//!
//! At a tip on an arc of the curvature c the auxiliary fields are those that leave the arc's faces
//! free (`arc_fields`), and instead of shifting the field along the axis, the arc is turned about
//! its centre: with
//!
//! ```text
//! w = e₁ + c e₃ × x     𝓛u = (w·∇) u − c e₃ × u
//! ```
//!
//! in place of e₁ and of u_,1, and w_j in place of δ_1j, all that stands here holds for isotropic
//! materials, whose law does not change if the body is turned. On the arc w·n = 0 and σᵃ n = 0: its
//! faces add nothing, not even to J, unless they are loaded. Other edges behind it do,
//!
//! ```text
//! −∫ P_j n_j q ds = −∫ (t_i 𝓛uᵃ_i + σᵃ_ij (e₃ × w)_j ∂u_i/∂s − c σᵃ_ij n_j (e₃ × u)_i) q ds
//! ```
//!
//! with u relative to the tip, as in 𝓛u, so that T does not depend on how the body is shifted. The
//! fields are singular at the centre, which no disc may come near.
//!
//! Faces that touch have the tractions that the field itself has there, evaluated at the points of
//! the same rules as what kinks add; σ_22 at the tip is then the stress between them.
//!
//! T, the part of σ_11 at the tip that is finite, comes from the same integral with the field of a
//! force 1 along the axis at the tip (Kfouri 1986): T = E′M + σ_22, where σ_22 is what the loads on
//! the faces press the tip with. That field loads no face along the axis, and has no K. Loads with
//! a resultant at the tip make σ_11 grow like log r, and there is no T.
//!
//! J is the energy that is released, by the domain form of the J-integral (Li, Shih &
//! Needleman 1985)
//!
//! ```text
//! J = −∫ E_j q_,j + E_j,j q dA + ∫ (W n_1 − t_i u_i,1) q ds      W = ½ σ_ij ε_ij
//! E_j = W δ_1j − σ_ij u_i,1      E_j,j = ½ ε:C,_1:ε + b_i u_i,1
//! ```
//!
//! with the second integral over all faces.
//!
//! At a tip on a straight line of the boundary, with the other half of the body mirrored
//! ([`Symmetry`]), the integrals over one half are doubled. For a symmetric field those of K_I, T
//! and J are twice that half: on the line ahead of the tip P_j n_j = 0 since there u_2 = uᵃ_2 = 0
//! and σ_12 = σᵃ_12 = 0. That of K_II is zero. For an antisymmetric field only that of K_II does
//! not vanish.
//!
//! J does not use auxiliary fields: J = G = (K_I² + K_II²)/E′ is a check. C is differentiated, so
//! that there is no J where the material jumps in the disc.

mod arc_fields;
mod auxiliary;
mod block;
mod boundary;
mod cells;
mod elements;
mod face_integrals;
mod face_loads;
mod integral;
mod loads;
mod path;
mod resolve;
mod ring;
mod sensitivity;
mod singular;
mod sums;
#[cfg(test)]
mod tests;

use boundary::boundary_distance;
pub(crate) use cells::with_cells;
use integral::{Interaction, integrate_tips};
pub use loads::{LoadCase, TipLoads};
use ppum::crack::{Crack, TipId, tips};
use ppum::dataset::{Dataset, TipIntensity};
use ppum::field::{Field, FieldError};
use ppum::progress::{Cancelled, Phase, Watcher};
use ppum::vec2::{Rect, Vec2};
use ppum_problem::geometry::{AMPLE_CLEARANCE, interface_distance};
pub use ppum_problem::geometry::{TipClearance, TipObstacle};
use ppum_problem::{Problem, Symmetry};
use ppum_solve::law::{Law, Temperature};
pub use ppum_solve::quadrature::QuadratureErrorEstimate;
use ppum_solve::space::TrialSpace;
pub use ppum_solve::terms::FaceLaw;
use ppum_solve::watched::WorkPhase;
pub(crate) use sensitivity::{Sensitivity, TipDisc};
pub(crate) use singular::{WEIGHT, is_weight, singular_functions};
use sums::RINGS;

/// Radii in parts of the tip's [`TipClearance`]; the last one is preferred, its integral averages
/// most.
const RADII: [f64; RINGS] = [0.5, 0.7, 0.9];

/// Least radius of a tip's [`TipClearance`], in cells at the tip, for which factors are given.
///
/// Measured with tips beside another tip and beside the boundary, at orders 2 and 3
/// (docs/decisions/0004): factors are off by at most 0.8 % from half a cell on, by 0.9 % from a
/// fifth on, but by 4 % at a tenth of a cell, where the spread of the radii may say a tenth of
/// that: the error is that of the field, which cells larger than the clearance do not resolve.
const LEAST_CLEARANCE: f64 = 0.5;

/// The findings about a tip.
#[derive(Clone, Debug, PartialEq)]
pub struct TipResult {
    /// The tip.
    pub tip: TipId,
    /// Its place.
    pub at: Vec2,
    /// Its clearance.
    pub clearance: TipClearance,
    /// The longest side of the cells it lies in.
    pub cell: f64,
    /// Distance to the nearest interface of two materials, if it is within the clearance and nearer
    /// than two of these cells.
    pub interface: Option<f64>,
    /// Its factors; none if the clearance is too small for them, see [`TipResult::needed`].
    pub factors: Option<TipIntensity>,
    /// True if faces that may touch do so at the tip, so that what opens them is nothing but an
    /// error.
    pub touches: bool,
    /// The factor of the opening of the faces: K_I, of an anisotropic body K_I + C₁₂/C₁₁ K_II. Zero
    /// without factors.
    pub opening: f64,
    /// √(E′ W/R) with twice the strain energy W in the largest disc, of radius R: of the size that
    /// K has where the crack concentrates stress, and far above K where nothing does. Zero
    /// without factors.
    pub energy_scale: f64,
    /// Errors that quadrature leaves in the discs.
    pub doubt: QuadratureErrorEstimate,
}

impl TipResult {
    /// Radius of the clearance below which a tip has no factors.
    #[must_use]
    pub fn needed(&self) -> f64 {
        LEAST_CLEARANCE * self.cell
    }

    /// True if there is room for factors.
    fn has_room(&self) -> bool {
        self.clearance.radius >= self.needed()
    }
}

/// The stress intensity factors of all tips of a step, each at three radii chosen in the tip's
/// [`TipClearance`]; none at all unless the field is a displacement without a temperature, of which
/// [`recompute`](crate::diagnostics::recompute) finds them.
///
/// The field is evaluated in the cells that meet the discs, for all tips in parallel; the values do
/// not depend on the number of threads.
///
/// # Errors
/// Cancelled, within the time of one cell.
///
/// # Panics
/// If the field is not of the dataset and step of `space`.
pub fn intensities(
    dataset: &Dataset,
    field: &Field<'_>,
    space: &TrialSpace<'_>,
    loads: &dyn TipLoads,
    watcher: &dyn Watcher,
) -> Result<Vec<TipResult>, Cancelled> {
    if field.has_temperature() {
        return Ok(Vec::new());
    }
    intensities_by(&Law::new(field.equation), dataset, field, space, loads, watcher)
}

/// Finds the factors for a displacement, in a body with a law.
pub(crate) fn intensities_by(
    law: &Law<'_>,
    dataset: &Dataset,
    field: &Field<'_>,
    space: &TrialSpace<'_>,
    loads: &dyn TipLoads,
    watcher: &dyn Watcher,
) -> Result<Vec<TipResult>, Cancelled> {
    if !field.is_displacement() {
        return Ok(Vec::new());
    }
    let stage = WorkPhase::uncounted(watcher, Phase::Intensity)?;
    let outcome =
        |tip| stage.advance(0).map(|()| TipResult::new(dataset, field, tip, loads.symmetry(tip)));
    let mut tips = tips(&field.step.cracks).map(outcome).collect::<Result<Vec<_>, _>>()?;
    if is_weight(field) {
        return Ok(tips);
    }
    let wanted: Vec<_> = tips.iter_mut().filter(|outcome| outcome.has_room()).collect();
    let discs = wanted.iter().map(|o| (o.tip, RADII.map(|part| part * o.clearance.radius)));
    let integrals: Vec<_> = discs
        .filter_map(|(tip, radii)| Interaction::new(field, space, law, tip, radii, loads))
        .collect();
    let found = integrate_tips(space, &integrals, watcher)?;
    for (outcome, (integral, found)) in wanted.into_iter().zip(integrals.iter().zip(found)) {
        outcome.touches = integral.touches(outcome.cell);
        outcome.energy_scale = found.energy_scale;
        outcome.doubt = found.doubt;
        let factors = found.factors(outcome.tip);
        outcome.opening = factors.k1 + integral.body.coupling * factors.k2;
        outcome.factors = Some(factors);
    }
    Ok(tips)
}

/// The functionals of all tips that have factors, in their order.
pub(crate) fn sensitivities<'a>(
    dataset: &Dataset,
    field: &'a Field<'a>,
    space: &'a TrialSpace<'a>,
    law: &'a Law<'a>,
    loads: &'a dyn TipLoads,
) -> Vec<Sensitivity<'a>> {
    let of_tip = |outcome: TipResult| {
        let radii = RADII.map(|part| part * outcome.clearance.radius);
        Interaction::new(field, space, law, outcome.tip, radii, loads)
    };
    let outcomes = tips(&field.step.cracks)
        .map(|tip| TipResult::new(dataset, field, tip, loads.symmetry(tip)));
    outcomes.filter(TipResult::has_room).filter_map(of_tip).map(Sensitivity).collect()
}

/// The functional of one tip over a disc in which its crack has no bend; none if that is too small
/// for the cells at the tip.
pub(crate) fn straight_sensitivity<'a>(
    dataset: &Dataset,
    field: &'a Field<'a>,
    space: &'a TrialSpace<'a>,
    law: &'a Law<'a>,
    tip: TipId,
    loads: &'a dyn TipLoads,
) -> Option<Sensitivity<'a>> {
    let outcome = TipResult::new(dataset, field, tip, loads.symmetry(tip));
    let edge = field.step.cracks[tip.crack as usize].edge_to(tip.end);
    let largest = (RADII[RINGS - 1] * outcome.clearance.radius).min(edge.length());
    if largest < RADII[RINGS - 1] * outcome.needed() {
        return None;
    }
    let radii = RADII.map(|part| part / RADII[RINGS - 1] * largest);
    Interaction::new(field, space, law, tip, radii, loads).map(Sensitivity)
}

/// The reason why there are no factors on a circle.
#[derive(Debug, thiserror::Error)]
pub enum CircleError {
    /// A Poisson problem.
    #[error("only displacements of elasticity have stress intensity factors")]
    NoDisplacement,
    /// No such tip.
    #[error("the step has no such tip")]
    NoTip,
    /// Something else lies in the disc.
    #[error("the circle meets {}; its radius can be at most {}", .0.end.name(), ppum::text::trimmed(.0.radius))]
    Disturbed(TipClearance),
    /// A radius that is no length.
    #[error("the radius is not positive")]
    Radius,
    /// The field cannot be evaluated.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// The watcher stopped the call.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The largest disc around a tip of a step in which nothing disturbs its field; none if there is no
/// such tip.
#[must_use]
pub fn clearance(dataset: &Dataset, step: usize, tip: TipId) -> Option<TipClearance> {
    let field = Field::new(dataset, step).ok()?;
    let crack = field.step.cracks.get(tip.crack as usize)?;
    let cell = cell_at(&field.step.partition.cells(), crack.end_point(tip.end));
    Some(clearance_in(dataset, &field, tip, cell))
}

/// The clearance of a tip in cells of a size; of a mesh without what is outside of it.
fn clearance_in(dataset: &Dataset, field: &Field<'_>, tip: TipId, cell: f64) -> TipClearance {
    let clear = TipClearance::new(dataset, field.step, tip, cell);
    if field.step.partition.mesh().is_none() {
        return clear;
    }
    let at = field.step.cracks[tip.crack as usize].end_point(tip.end);
    let radius = boundary_distance(field, at, clear.radius);
    if radius < clear.radius { TipClearance { radius, end: TipObstacle::Border } } else { clear }
}

/// The stress intensity factors at one tip by the discs inside a circle around it: the preferred
/// ring is the circle's own, two others have the parts of its radius that those of [`intensities`]
/// have. The loads are those of the problem, if one is known.
///
/// # Errors
/// See [`CircleError`].
pub fn on_circle(
    dataset: &Dataset,
    step: usize,
    tip: TipId,
    radius: f64,
    problem: Option<&Problem>,
    watcher: &dyn Watcher,
) -> Result<TipIntensity, CircleError> {
    let (dataset, step) = with_cells(dataset, step)?;
    let dataset = &*dataset;
    Field::new(dataset, step)?;
    let clear = clearance(dataset, step, tip).ok_or(CircleError::NoTip)?;
    if !(radius > 0.0 && radius.is_finite()) {
        return Err(CircleError::Radius);
    }
    if radius > clear.radius {
        return Err(CircleError::Disturbed(clear));
    }
    match Temperature::split(dataset, step)? {
        Some((plain, heat)) => on_plain((&plain, 0), Some(heat), (tip, radius), problem, watcher),
        None => on_plain((dataset, step), None, (tip, radius), problem, watcher),
    }
}

/// Computes the factors for a displacement, in a body that a temperature may strain.
fn on_plain(
    (dataset, step): (&Dataset, usize),
    heat: Option<Temperature>,
    (tip, radius): (TipId, f64),
    problem: Option<&Problem>,
    watcher: &dyn Watcher,
) -> Result<TipIntensity, CircleError> {
    let field = Field::new(dataset, step)?;
    let crack = &field.step.cracks[tip.crack as usize];
    let loads = LoadCase { problem, factor: field.step.load };
    if !is_half_known(dataset, crack, loads.symmetry(tip)) {
        return Err(CircleError::Disturbed(TipClearance::NONE));
    }
    let Dataset { domain, equation, tables, .. } = dataset;
    if !field.is_displacement() || is_weight(&field) {
        return Err(CircleError::NoDisplacement);
    }
    let space = TrialSpace::new(field.step, domain, equation, tables).map_err(FieldError::from)?;
    let law = Law::new(equation).heated(heat.as_ref());
    let radii = RADII.map(|part| part / RADII[RINGS - 1] * radius);
    let integral = Interaction::new(&field, &space, &law, tip, radii, &loads);
    let found = integrate_tips(&space, integral.as_slice(), watcher)?;
    let found = found.into_iter().next().ok_or(CircleError::NoDisplacement)?;
    Ok(found.factors(tip))
}

/// False at a tip of a crack on the boundary of which no symmetry is known: nothing is known of its
/// other half.
fn is_half_known(dataset: &Dataset, crack: &Crack, symmetry: Option<Symmetry>) -> bool {
    symmetry.is_some() || dataset.domain.line_along(crack).is_none()
}

/// The longest side of the cells that a point lies in.
fn cell_at(cells: &[Rect], at: Vec2) -> f64 {
    let own = cells.iter().filter(|cell| cell.contains(at));
    own.map(|cell| cell.size().x.max(cell.size().y)).fold(0.0, f64::max)
}

impl TipResult {
    fn new(dataset: &Dataset, field: &Field<'_>, tip: TipId, symmetry: Option<Symmetry>) -> Self {
        let crack = &field.step.cracks[tip.crack as usize];
        let at = crack.end_point(tip.end);
        let cell = cell_at(&field.step.partition.cells(), at);
        let clearance = if is_half_known(dataset, crack, symmetry) {
            clearance_in(dataset, field, tip, cell)
        } else {
            TipClearance::NONE
        };
        let reach = clearance.radius.min(AMPLE_CLEARANCE * cell);
        let elastic = dataset.equation.elastic().filter(|_| reach > 0.0);
        let interface = elastic.and_then(|body| interface_distance(body, at, reach));
        Self {
            tip,
            at,
            clearance,
            cell,
            interface,
            factors: None,
            touches: false,
            opening: 0.0,
            energy_scale: 0.0,
            doubt: QuadratureErrorEstimate::default(),
        }
    }
}
