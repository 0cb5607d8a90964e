//! The pieces of a body, what loads them and what holds them.

use super::balance::{Balance, UnbalancedError};
use super::pieces::BodyPieces;
use super::touching::{
    ContactForce, RigidMotion, RigidPieces, TouchingPieces, contact_forces, first_mode, groups,
};
use crate::law::PerMode;
use ppum::vec2::Vec2;
use ppum_linear::EigenError;
use ppum_problem::Problem;

/// A body in equilibrium: each piece for itself, or pieces that touch and hold each other.
pub struct BodyEquilibrium {
    /// The parts into which cracks divide the body.
    pub pieces: BodyPieces,
    /// Restraints and loads of each piece.
    pub(crate) balances: Vec<Balance>,
    /// The rigid-body modes of each piece that no restraint holds.
    pub(crate) free: Vec<Vec<PerMode>>,
    /// The pieces that touch each other, group by group; most are alone.
    pub(crate) groups: Vec<Vec<usize>>,
    /// The rigid motions that faces which touch do not hold either, group by group.
    pub(crate) motions: Vec<RigidMotion>,
    /// Largest part of the loads on a group that does not balance.
    imbalance: f64,
}

/// The reason why a body is not in equilibrium.
#[derive(Debug, thiserror::Error)]
pub enum EquilibriumError {
    /// Loads on a piece that nothing holds against them.
    #[error(transparent)]
    Unbalanced(#[from] UnbalancedError),
    /// Data that are not finite.
    #[error(transparent)]
    Eigen(#[from] EigenError),
}

impl BodyEquilibrium {
    /// The body of pieces with their balances.
    ///
    /// # Errors
    /// Loads that nothing holds, data that are not finite.
    pub fn new(
        pieces: BodyPieces,
        balances: Vec<Balance>,
        problem: &Problem,
    ) -> Result<Self, EquilibriumError> {
        let free = balances.iter().map(Balance::free).collect::<Result<_, _>>()?;
        let forces = contact_forces(&pieces, problem);
        let (groups, motions) = (groups(&pieces, &forces), Vec::new());
        let mut plate = Self { pieces, balances, free, groups, motions, imbalance: 0.0 };
        for group in 0..plate.groups.len() {
            plate.add_group(group, &forces, !problem.supports.is_empty())?;
        }
        Ok(plate)
    }

    fn add_group(
        &mut self,
        group: usize,
        forces: &[ContactForce],
        has_supports: bool,
    ) -> Result<(), EquilibriumError> {
        let Self { pieces, balances, free, .. } = &*self;
        let plate = RigidPieces { pieces, balances, free };
        let touching = TouchingPieces::new(plate, &self.groups[group], forces);
        let imbalance =
            touching.imbalance().map_err(|error| UnbalancedError { has_supports, ..error })?;
        let motions = touching.motions(group)?;
        self.imbalance = self.imbalance.max(imbalance);
        self.motions.extend(motions);
        Ok(())
    }

    /// Largest part of the loads on a piece that does not balance.
    pub fn imbalance(&self) -> f64 {
        self.imbalance
    }

    /// The number of the first free mode of a piece among those of all.
    pub(crate) fn first_mode(&self, piece: usize) -> usize {
        first_mode(&self.free, piece)
    }

    /// The displacement of a point of a piece in a motion.
    pub(super) fn moved(&self, motion: &RigidMotion, piece: usize, x: Vec2) -> [f64; 2] {
        let factors = &motion.factors[self.first_mode(piece)..];
        let mut sum = [0.0; 2];
        for (factor, mode) in factors.iter().zip(&self.free[piece]) {
            let moved = self.balances[piece].modes.combined(mode, x);
            sum.iter_mut().zip(moved).for_each(|(sum, u)| *sum += factor * u);
        }
        sum
    }
}
