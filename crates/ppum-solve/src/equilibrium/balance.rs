//! Restraints and loads of a piece of the body: the rigid-body modes that nothing holds, and
//! whether the loads are in equilibrium there.

use super::pieces::BodyPieces;
use crate::law::{MODES, PerMode, RigidModes};
use faer::Mat;
use ppum::equation::Equation;
use ppum::text::{beside, trimmed};
use ppum::vec2::{Vec2, vec2};
use ppum_linear::{EigenError, SymmetricEigen};
use std::fmt;

/// Part of the largest eigenvalue below which a mode counts as free.
pub(super) const FREE: f64 = 1e-10;

/// Loads that move a piece of the body which nothing holds against them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnbalancedError {
    /// A point of the piece, if cracks and holes cut the body into several.
    pub piece: Option<Vec2>,
    /// Force that remains, only components that nothing holds; of a potential the flow.
    pub force: Vec2,
    /// Moment that remains, zero if the rotation is held; `None` for a potential.
    pub moment: Option<f64>,
    /// Point the moment is about.
    pub about: Vec2,
    /// ∫ of the magnitude of all loads, on the piece and on what it touches.
    pub magnitude: f64,
    /// The largest coefficient of friction, if the piece has faces that touch others.
    pub friction: Option<f64>,
    /// True if points of the body are held, which take no forces.
    pub has_supports: bool,
}

impl std::error::Error for UnbalancedError {}

impl fmt::Display for UnbalancedError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.piece {
            Some(p) => {
                let [x, y] = [p.x, p.y].map(trimmed);
                write!(
                    f,
                    "the plate falls into pieces, and the loads on the piece around ({x}, {y})"
                )?;
            }
            None => write!(f, "the loads")?,
        }
        match self.friction {
            None if self.has_supports => write!(
                f,
                " do not balance, and a [[support]] takes no force, it only fixes a rigid motion: "
            )?,
            None => write!(f, " do not balance and nothing holds the plate against them: ")?,
            Some(0.0) => write!(
                f,
                " do not balance, so that it slides or falls away: faces that touch take pressure alone, no tension \
                 and without `friction` no shear: "
            )?,
            Some(friction) => write!(
                f,
                " do not balance, so that it slides or falls away: faces that touch take no tension, and shear up to \
                 {} times the pressure: ",
                trimmed(friction)
            )?,
        }
        let [fx, fy, x, y] = [self.force.x, self.force.y, self.about.x, self.about.y].map(trimmed);
        match self.moment.map(trimmed) {
            Some(moment) => {
                write!(
                    f,
                    "a force of ({fx}, {fy}) and a moment of {moment} about ({x}, {y}) remain"
                )?;
            }
            None => write!(f, "a flow of {fx} remains")?,
        }
        let remedy = match (self.moment, self.friction) {
            (Some(_), None) => {
                "hold a component of the displacement on an edge of it by [[boundary]], or balance the loads"
            }
            (Some(_), Some(_)) => {
                "hold a component of the displacement on an edge of it by [[boundary]], balance the loads on it, or \
                 give more `friction`"
            }
            (None, _) => "give values on an edge of it, or balance the fluxes",
        };
        write!(f, " of loads of {} in all; {remedy}", trimmed(self.magnitude))
    }
}

/// Supports and loads of one piece, as far as they have been added.
#[derive(Clone, Copy, Debug)]
pub struct Balance {
    pub(crate) modes: RigidModes,
    /// ∫ m_k·m_l of the rigid-body modes over the boundary where values are given, held
    /// components only.
    held: [PerMode; MODES],
    /// Work of body forces and tractions on the rigid-body modes.
    resultant: PerMode,
    /// ∫ of the loads' magnitude on the boundary and inside.
    pub(crate) magnitude: f64,
}

impl Balance {
    /// One balance per piece, all empty.
    pub(crate) fn of(pieces: &BodyPieces, equation: &Equation) -> Vec<Self> {
        let empty = |modes: RigidModes| Self {
            modes,
            held: [[0.0; MODES]; MODES],
            resultant: [0.0; MODES],
            magnitude: 0.0,
        };
        pieces.rigid_modes(equation).into_iter().map(empty).collect()
    }

    /// Adds a point where loads act.
    pub(crate) fn add_load(&mut self, x: Vec2, values: &[f64], weight: f64) {
        for (sum, mode) in self.resultant.iter_mut().zip(self.modes.at(x)) {
            *sum += weight * mode.iter().zip(values).map(|(m, v)| m * v).sum::<f64>();
        }
        self.magnitude += weight * values.iter().map(|v| v.abs()).sum::<f64>();
    }

    /// Adds a point where values along some directions are given.
    pub(crate) fn add_held(
        &mut self,
        x: Vec2,
        held: impl Iterator<Item = Vec2> + Clone,
        weight: f64,
    ) {
        let modes = self.modes.at(x).map(Vec2::from);
        for (row, a) in self.held.iter_mut().zip(modes) {
            for (entry, b) in row.iter_mut().zip(modes) {
                *entry += weight * held.clone().map(|d| a.dot(d) * b.dot(d)).sum::<f64>();
            }
        }
    }

    /// True if all loads are.
    pub(crate) fn is_finite(&self) -> bool {
        self.magnitude.is_finite() && self.resultant.iter().all(|work| work.is_finite())
    }

    /// Adds the restraints and loads that another part of the body contributes to the same piece.
    pub(crate) fn add(&mut self, part: &Self) {
        for (row, part) in self.held.iter_mut().zip(&part.held) {
            row.iter_mut().zip(part).for_each(|(sum, v)| *sum += v);
        }
        self.resultant.iter_mut().zip(part.resultant).for_each(|(sum, v)| *sum += v);
        self.magnitude += part.magnitude;
    }

    /// The rigid-body modes that no boundary value holds, as combinations of the basic ones.
    ///
    /// # Errors
    /// Data that are not finite.
    pub(crate) fn free(&self) -> Result<Vec<PerMode>, EigenError> {
        let n = self.modes.count();
        let held = Mat::from_fn(n, n, |a, b| self.held[a][b]);
        let eigen = SymmetricEigen::new(held.as_ref())?;
        let largest = eigen.values.first().copied().unwrap_or(0.0);
        let free = (0..n).filter(|&k| eigen.values[k] <= FREE * largest);
        let mode = |k| std::array::from_fn(|m| if m < n { eigen.vectors[(m, k)] } else { 0.0 });
        Ok(free.map(mode).collect())
    }

    /// The work of the loads on each free mode.
    pub(crate) fn works(&self, free: &[PerMode]) -> impl Iterator<Item = f64> {
        free.iter().map(move |mode| mode.iter().zip(&self.resultant).map(|(m, r)| m * r).sum())
    }

    /// The error of a resultant that remains; `piece` is a point of the piece, if there are
    /// several.
    pub(crate) fn error(
        &self,
        remaining: PerMode,
        magnitude: f64,
        piece: Option<Vec2>,
    ) -> UnbalancedError {
        // what is balanced except for rounding is zero
        let (force, moment) = self.modes.resultant(remaining.map(|part| beside(part, magnitude)));
        let RigidModes { center, size, .. } = self.modes;
        let shown = |p: Vec2| vec2(beside(p.x, size), beside(p.y, size));
        UnbalancedError {
            piece: piece.map(shown),
            force,
            moment,
            about: shown(center),
            magnitude,
            friction: None,
            has_supports: false,
        }
    }
}
