//! Estimated errors of stress intensity factors.
//!
//! A factor is a linear functional of the field, K(u) = a(u, z) with a dual solution z of its own,
//! so that its error is a(u − u_h, z − z_h) (Becker & Rannacher 2001). The disagreements of local
//! fields stand for both errors,
//!
//! ```text
//! |K − K_h| ≈ Σ_j |∫_{C_j} Σ_i s_i φ_i (σ(u_i) − σ(u_h)) : (ε(z_i) − ε(z_h))| + Σ_j d_j(u) η_j(z)
//! ```
//!
//! with the parts d_j of the estimated error that stand for data. Without the absolute values the
//! first sum has the sign of the error, and may cancel where the error does not; products of norms,
//! Σ_j η_j(u) η_j(z), were up to a hundred times the error (docs/decisions/0018).
//!
//! The functionals of all tips are added up, so that two dual solutions serve any number of tips.
//! What a cell adds may be due to any of them, the more the nearer: the strain of a dual solution
//! falls like r^(−3/2) from its tip, so a tip at the distance r counts (r_nearest / r)^(3/2) of it.
//! A cell far from all tips, as at a corner that pollutes all factors, counts fully for each.

use crate::adapt::Estimated;
use crate::intensity::FACTORS;
use faer::Mat;
use ppum::vec2::{Rect, Vec2};

/// Exponent by which the strain of a dual solution falls from its tip.
const FALL: f64 = 1.5;

/// The estimated errors of factors.
#[derive(Clone, Debug, Default)]
pub(super) struct Goal {
    /// Of (K_I, K_II) of each tip with factors, in their order.
    pub(super) errors: Vec<f64>,
    /// Of each cell, what it adds to the error of the nearest tip, and the number of that tip.
    pub(super) cells: Vec<(usize, f64)>,
}

impl Goal {
    /// The estimated errors of the factors of tips, from those of the solution and of the dual
    /// fields in cells; none without tips.
    pub(super) fn new(tips: &[Vec2], cells: &[Rect], estimated: &Estimated) -> Self {
        if tips.is_empty() {
            return Self::default();
        }
        let part = |(products, unseen): (&Mat<f64>, &f64)| {
            let of_mode = |k: usize| products[(0, k)].abs() + (unseen * products[(k, k)]).sqrt();
            [of_mode(1), of_mode(2)]
        };
        let parts = estimated.products.iter().zip(&estimated.unseen).map(part);
        let mut errors = vec![[0.0; FACTORS]; tips.len()];
        let mut of_cells = Vec::with_capacity(cells.len());
        for (cell, part) in cells.iter().zip(parts) {
            let distances = tips.iter().map(|tip| (*tip - cell.center()).length());
            let distances: Vec<f64> = distances.collect();
            let nearest = nearest(&distances);
            for (sums, distance) in errors.iter_mut().zip(&distances) {
                let share = (distances[nearest] / distance).powf(FALL).min(1.0);
                sums.iter_mut().zip(part).for_each(|(sum, part)| *sum += share * part);
            }
            of_cells.push((nearest, part[0].hypot(part[1])));
        }
        let errors = errors.into_iter().map(|[first, second]| first.hypot(second)).collect();
        Self { errors, cells: of_cells }
    }
}

fn nearest(distances: &[f64]) -> usize {
    (0..distances.len()).min_by(|&a, &b| distances[a].total_cmp(&distances[b])).unwrap_or(0)
}
