//! Pieces that touch: whether their faces hold them together, and the motions that they leave.
//!
//! Faces take pressures p ≥ 0, and shear up to μ p. In the plane both are sums of forces p ≥ 0
//! along m ± μ s, and those on a straight edge are equivalent to some at its two ends; on arcs they
//! are taken at the ends of short parts, where m and s are those of the arc: nothing turns a disc
//! without friction. With the works R of the loads on the free modes of all pieces, and A of these
//! forces,
//!
//! ```text
//! R + A p = 0     p ≥ 0
//! ```
//!
//! is what an elastic body needs to have a solution, too. If no p is good, the least u = R + A p
//! has A·u ≥ 0 and R·u > 0 (Farkas): as a motion it opens all faces, and the loads do work on it.
//! Motions with A·z = 0 are left free; on them the loads do no work.

use super::balance::{Balance, FREE, UnbalancedError};
use super::pieces::BodyPieces;
use crate::law::{MODES, PerMode};
use crate::terms::{FaceLaw, face_law};
use faer::Mat;
use ppum::vec2::Vec2;
use ppum_linear::{EigenError, SymmetricEigen, nonnegative_residual, product};
use ppum_problem::Problem;

/// Part of the loads' magnitude that may remain unbalanced: quadrature of the data, not more.
const BALANCE: f64 = 1e-6;

/// A force that a piece can exert on another one where they touch.
#[derive(Clone, Copy, Debug)]
pub(super) struct ContactForce {
    at: Vec2,
    /// On the first of the pieces, and against it on the second.
    force: Vec2,
    pieces: [usize; 2],
    friction: f64,
}

/// The forces between pieces, of cracks with their coefficients of friction.
pub(super) fn contact_forces(pieces: &BodyPieces, problem: &Problem) -> Vec<ContactForce> {
    let mut all = Vec::new();
    for crack in 0..problem.cracks().len() {
        let Some(FaceLaw { friction }) = face_law(problem, crack as u32) else { continue };
        for edge in pieces.shared_edges(crack) {
            let face = problem.cracks()[crack].edge(edge.of);
            let shears = if friction > 0.0 { &[-friction, friction][..] } else { &[0.0] };
            all.extend(edge.ends.into_iter().flat_map(|at| {
                let chord = (edge.ends[1] - edge.ends[0]).unit();
                let along = if face.is_arc() { face.tangent_towards(at) } else { chord };
                let force = move |shear: &f64| along.left() + along * *shear;
                let pieces = edge.pieces;
                shears.iter().map(move |shear| ContactForce {
                    at,
                    force: force(shear),
                    pieces,
                    friction,
                })
            }));
        }
    }
    all
}

/// The pieces that touch each other, directly or through others, group by group.
pub(super) fn groups(pieces: &BodyPieces, forces: &[ContactForce]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = (0..pieces.all().len()).map(|piece| vec![piece]).collect();
    for touch in forces {
        let [a, b] = touch.pieces.map(|piece| groups.iter().position(|own| own.contains(&piece)));
        if let (Some(a), Some(b)) = (a.min(b), a.max(b))
            && a != b
        {
            let other = groups.remove(b);
            groups[a].extend(other);
            groups[a].sort_unstable();
        }
    }
    groups
}

/// A rigid motion of pieces that touch each other.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RigidMotion {
    /// The number of their group.
    pub(crate) group: usize,
    /// The first piece that moves. The motions of a group with the same one differ there.
    pub(crate) lead: usize,
    /// The factors of all free modes, piece by piece.
    pub(crate) factors: Vec<f64>,
}

/// All pieces of a body, with their restraints and loads, and the modes that are free.
#[derive(Clone, Copy)]
pub(super) struct RigidPieces<'p> {
    pub(super) pieces: &'p BodyPieces,
    pub(super) balances: &'p [Balance],
    pub(super) free: &'p [Vec<PerMode>],
}

/// The number of the first free mode of a piece among those of all.
pub(super) fn first_mode(free: &[Vec<PerMode>], piece: usize) -> usize {
    free[..piece].iter().map(Vec::len).sum()
}

/// Pieces that touch each other, as bodies that do not deform.
pub(super) struct TouchingPieces<'p> {
    plate: RigidPieces<'p>,
    pieces: &'p [usize],
    /// The piece and the number of each of their free modes.
    modes: Vec<(usize, usize)>,
    /// A, a column for each force.
    forces: Mat<f64>,
    friction: Option<f64>,
}

impl<'p> TouchingPieces<'p> {
    pub(super) fn new(
        plate: RigidPieces<'p>,
        pieces: &'p [usize],
        forces: &[ContactForce],
    ) -> Self {
        let of_piece = |&piece: &usize| (0..plate.free[piece].len()).map(move |k| (piece, k));
        let modes: Vec<_> = pieces.iter().flat_map(of_piece).collect();
        let own = forces.iter().filter(|touch| pieces.contains(&touch.pieces[0]));
        let own: Vec<_> = own.collect();
        let work = |row: usize, column: usize| {
            let ((piece, k), touch) = (modes[row], own[column]);
            let moved = plate.balances[piece].modes.combined(&plate.free[piece][k], touch.at);
            let work = touch.force.dot(moved.into());
            match touch.pieces {
                [first, _] if first == piece => work,
                [_, second] if second == piece => -work,
                _ => 0.0,
            }
        };
        let forces = Mat::from_fn(modes.len(), own.len(), work);
        let friction = own.iter().map(|touch| touch.friction).reduce(f64::max);
        Self { plate, pieces, modes, forces, friction }
    }

    /// Returns the part of the loads that forces between the pieces do not balance, relative to
    /// their magnitude.
    ///
    /// # Errors
    /// Loads on one of the pieces that nothing holds.
    pub(super) fn imbalance(&self) -> Result<f64, UnbalancedError> {
        let balances = self.plate.balances;
        let magnitude = self.pieces.iter().map(|&piece| balances[piece].magnitude).sum::<f64>();
        let remaining = self.remaining();
        let size = |part: &PerMode| part.iter().fold(0.0f64, |m, r| m.max(r.abs()));
        let most = remaining.iter().map(|(_, part)| size(part)).fold(0.0, f64::max);
        let imbalance = if most > 0.0 { most / magnitude } else { 0.0 };
        match remaining.into_iter().find(|(_, part)| size(part) == most) {
            Some((piece, part)) if imbalance > BALANCE => {
                let all = self.plate.pieces.all();
                let inside = (all.len() > 1).then_some(all[piece].inside);
                let error = balances[piece].error(part, magnitude, inside);
                Err(UnbalancedError { friction: self.friction, ..error })
            }
            _ => Ok(imbalance),
        }
    }

    /// R + A p of each piece in units of its basic modes.
    fn remaining(&self) -> Vec<(usize, PerMode)> {
        let RigidPieces { free, balances, .. } = self.plate;
        let works = self.pieces.iter().flat_map(|&piece| balances[piece].works(&free[piece]));
        let wanted: Vec<f64> = works.map(|work| -work).collect();
        let left = nonnegative_residual(&self.forces, &wanted);
        let of_piece = |&piece: &usize| {
            let mut sum = [0.0; MODES];
            for (&(_, k), left) in
                self.modes.iter().zip(&left).filter(|((own, _), _)| *own == piece)
            {
                sum.iter_mut().zip(free[piece][k]).for_each(|(sum, m)| *sum -= left * m);
            }
            (piece, sum)
        };
        self.pieces.iter().map(of_piece).collect()
    }

    /// The motions that the faces leave free.
    ///
    /// # Errors
    /// Data that are not finite.
    pub(super) fn motions(&self, group: usize) -> Result<Vec<RigidMotion>, EigenError> {
        let n = self.modes.len();
        let motion =
            |lead: usize, own: &[f64]| RigidMotion { group, lead, factors: self.factors(own) };
        if self.forces.ncols() == 0 {
            let units = Mat::<f64>::identity(n, n);
            return Ok((0..n).map(|k| motion(self.modes[k].0, units.col_as_slice(k))).collect());
        }
        let mut left = self.kernel()?;
        let mut motions = Vec::new();
        for &lead in self.pieces {
            let own: Vec<usize> = (0..n).filter(|&row| self.modes[row].0 == lead).collect();
            let part = Mat::from_fn(own.len(), left.ncols(), |row, k| left[(own[row], k)]);
            let eigen = SymmetricEigen::new(product(part.transpose(), part.as_ref()).as_ref())?;
            let leading = eigen.values.iter().filter(|value| **value > FREE).count();
            let turned = product(left.as_ref(), eigen.vectors.as_ref());
            motions.extend((0..leading).map(|k| motion(lead, turned.col_as_slice(k))));
            left = turned.subcols(leading, left.ncols() - leading).to_owned();
            for k in 0..left.ncols() {
                own.iter().for_each(|&row| left[(row, k)] = 0.0);
            }
        }
        Ok(motions)
    }

    /// The modes z with A·z = 0, as columns.
    fn kernel(&self) -> Result<Mat<f64>, EigenError> {
        let n = self.modes.len();
        let eigen =
            SymmetricEigen::new(product(self.forces.as_ref(), self.forces.transpose()).as_ref())?;
        let largest = eigen.values.first().copied().unwrap_or(0.0);
        let first = eigen.values.partition_point(|value| *value > FREE * largest);
        Ok(eigen.vectors.subcols(first, n - first).to_owned())
    }

    /// A combination of the modes of these pieces as one of those of all.
    fn factors(&self, own: &[f64]) -> Vec<f64> {
        let mut factors = vec![0.0; self.plate.free.iter().map(Vec::len).sum()];
        for (&(piece, k), factor) in self.modes.iter().zip(own) {
            factors[first_mode(self.plate.free, piece) + k] = *factor;
        }
        factors
    }
}
