//! The pieces of a plate, what loads them and what holds them.

use super::balance::{Balance, UnbalancedError};
use super::pieces::{BodyPiece, BodyPieces};
use super::rigid::PerMode;
use crate::linear::EigenError;

/// A plate in equilibrium, piece by piece.
pub(crate) struct Plate {
    pub(crate) pieces: BodyPieces,
    /// Restraints and loads of each piece.
    pub(crate) balances: Vec<Balance>,
    /// The rigid-body modes of each piece that nothing holds.
    pub(crate) free: Vec<Vec<PerMode>>,
}

/// A plate without equilibrium.
#[derive(Debug, thiserror::Error)]
pub(crate) enum PlateError {
    /// Loads on a piece that nothing holds against them.
    #[error(transparent)]
    Unbalanced(#[from] UnbalancedError),
    /// Data that are not finite.
    #[error(transparent)]
    Eigen(#[from] EigenError),
}

impl Plate {
    /// The plate of pieces with their balances.
    ///
    /// # Errors
    /// Loads that do work on free modes, data that are not finite.
    pub(crate) fn new(pieces: BodyPieces, balances: Vec<Balance>) -> Result<Self, PlateError> {
        let several = pieces.all().len() > 1;
        let of_piece = |(balance, piece): (&Balance, &BodyPiece)| {
            let free = balance.free()?;
            balance.check(&free, several.then_some(piece.inside))?;
            Ok(free)
        };
        let free =
            balances.iter().zip(pieces.all()).map(of_piece).collect::<Result<_, PlateError>>()?;
        Ok(Self { pieces, balances, free })
    }

    /// Largest part of the loads on a piece that does not balance.
    pub(crate) fn imbalance(&self) -> f64 {
        let pieces = self.balances.iter().zip(&self.free);
        pieces.map(|(balance, free)| balance.imbalance(free)).fold(0.0, f64::max)
    }
}
