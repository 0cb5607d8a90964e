//! Points that are held against rigid motion, piece by piece.
//!
//! A component i that is held at x₀ leaves of the rigid-body modes Σ_k a_k m_k that are still free
//! those with Σ_k a_k m_k,i(x₀) = 0. Each must leave fewer than those before it: a component that
//! cannot move any more would take a force.

use super::body::BodyEquilibrium;
use super::touching::RigidMotion;
use ppum::text::trimmed;
use ppum::vec2::Vec2;
use ppum_problem::Support;

/// Part of a motion of size one below which a component does not move.
const STILL: f64 = 1e-8;

/// A support that would take a force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SupportError {
    /// The point.
    pub at: Vec2,
    /// The component that cannot move without it.
    pub component: usize,
    /// True if nothing there can move, whatever other supports do.
    pub restrained: bool,
}

impl std::error::Error for SupportError {}

impl std::fmt::Display for SupportError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let ([x, y], component) = ([self.at.x, self.at.y].map(trimmed), ["x", "y"][self.component]);
        write!(f, "the support at [{x}, {y}] would take a force: ")?;
        if self.restrained {
            return write!(
                f,
                "what is given on the border, or a face that touches, keeps the body from moving in {component} \
                 there; make this component \"free\", or leave the [[support]] out"
            );
        }
        write!(
            f,
            "the supports before it leave no rigid motion in {component} there; make this component \"free\": three \
             components in all hold a body"
        )
    }
}

/// The conditions that fix the free motions of pieces that touch, each a combination of those
/// motions or the component of a support.
pub struct PieceConditions {
    /// The components that are held, by the numbers of the supports.
    pub(crate) held: Vec<(usize, usize)>,
    /// For the motions that supports leave, their factors of the free motions.
    pub(crate) left: Vec<Vec<f64>>,
}

impl BodyEquilibrium {
    /// The conditions on each group of pieces that touch; those of groups without supports are one
    /// for each free motion.
    ///
    /// # Errors
    /// A support that would take a force.
    pub fn conditions(&self, supports: &[Support]) -> Result<Vec<PieceConditions>, SupportError> {
        let groups = 0..self.groups.len();
        groups.map(|group| self.conditions_on(group, supports)).collect()
    }

    fn conditions_on(
        &self,
        group: usize,
        supports: &[Support],
    ) -> Result<PieceConditions, SupportError> {
        let free: Vec<_> = self.motions.iter().filter(|motion| motion.group == group).collect();
        let (mut held, mut fixed) = (Vec::new(), Vec::new());
        for (number, support) in supports.iter().enumerate() {
            let piece = self.pieces.of(support.at);
            if !self.groups[group].contains(&piece) {
                continue;
            }
            let moved = |motion: &&RigidMotion| self.moved(motion, piece, support.at);
            for component in (0..2).filter(|&i| support.displacement[i].is_some()) {
                let row: Vec<f64> = free.iter().map(|motion| moved(motion)[component]).collect();
                let restrained = length(&row) < STILL;
                let error = SupportError { at: support.at, component, restrained };
                fixed.push(independent(row, &fixed).ok_or(error)?);
                held.push((number, component));
            }
        }
        let mut left = Vec::new();
        if held.is_empty() {
            left.extend((0..free.len()).map(|k| unit(k, free.len())));
        }
        while held.len() + left.len() < free.len() {
            let all = (0..free.len()).map(|k| rest(unit(k, free.len()), &fixed));
            let Some(row) = all.max_by(|a, b| length(a).total_cmp(&length(b))) else { break };
            let row = scaled(row);
            fixed.push(row.clone());
            left.push(row);
        }
        Ok(PieceConditions { held, left })
    }
}

/// A vector of length one of what a row has beside orthonormal ones; none if that is nothing.
fn independent(row: Vec<f64>, fixed: &[Vec<f64>]) -> Option<Vec<f64>> {
    let rest = rest(row, fixed);
    (length(&rest) >= STILL).then(|| scaled(rest))
}

/// Returns the part of a row that is orthogonal to some orthonormal ones.
fn rest(mut row: Vec<f64>, fixed: &[Vec<f64>]) -> Vec<f64> {
    for known in fixed {
        let part: f64 = row.iter().zip(known).map(|(a, b)| a * b).sum();
        row.iter_mut().zip(known).for_each(|(a, b)| *a -= part * b);
    }
    row
}

fn scaled(row: Vec<f64>) -> Vec<f64> {
    let length = length(&row);
    row.into_iter().map(|v| v / length).collect()
}

fn length(row: &[f64]) -> f64 {
    row.iter().map(|v| v * v).sum::<f64>().sqrt()
}

fn unit(k: usize, n: usize) -> Vec<f64> {
    (0..n).map(|j| f64::from(u8::from(j == k))).collect()
}
