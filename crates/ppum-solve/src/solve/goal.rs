//! Estimated errors of stress intensity factors.
//!
//! A factor is a linear functional of the field, K(u) = a(u, z) with a dual solution z of its own,
//! so that its error is a(u − u_h, z − z_h) (Becker & Rannacher 2001). The disagreements of local
//! fields stand for both errors,
//!
//! ```text
//! |K − K_h| ≈ |Σ_j e_j| + ½ Σ_j |e_j| + Σ_j c_j(u) η_j(z)
//! e_j = ∫_{C_j} Σ_i s_i φ_i (σ(u_i) − σ(u_h)) : (ε(z_i) − ε(z_h))
//! ```
//!
//! with the parts c_j of the estimated error of faces that touch. The first sum is close to the
//! error, and has its sign; the second one is there because the first may cancel by chance. The
//! third bounds what no disagreement sees, that faces touch elsewhere than they should. Products of
//! norms for all of it, Σ_j η_j(u) η_j(z), were up to a hundred times the error
//! (docs/decisions/0018).
//!
//! The functionals of all tips are added up, so that two dual solutions serve any number of tips.
//! What a cell adds may be due to any of them, the more the nearer: the strain of a dual solution
//! falls like r^(−3/2) from its tip, so a tip at the distance r counts (r_nearest / r)^(3/2) of it.
//! A cell far from all tips, as at a corner that pollutes all factors, counts fully for each.

use crate::adapt::Estimated;
use crate::intensity::FACTORS;
use ppum::vec2::{Rect, Vec2};

/// Exponent by which the strain of a dual solution falls from its tip.
const FALL: f64 = 1.5;

/// Part of the sum without signs that is added to the sum with signs.
const MARGIN: f64 = 0.5;

/// The estimated errors of factors.
#[derive(Clone, Debug, Default)]
pub(super) struct Goal {
    /// Of (K_I, K_II) of each tip with factors, in their order.
    pub(super) errors: Vec<f64>,
    /// Of each cell, what it adds to the error of the nearest tip, and the number of that tip.
    pub(super) cells: Vec<(usize, f64)>,
}

/// What cells add to the error of a factor.
#[derive(Clone, Copy, Debug, Default)]
struct ErrorSum {
    /// With their signs.
    signed: f64,
    /// Without signs.
    magnitude: f64,
    /// Of faces that touch.
    contact: f64,
}

impl ErrorSum {
    fn add(&mut self, part: f64, contact: f64) {
        self.signed += part;
        self.magnitude += part.abs();
        self.contact += contact;
    }

    fn error(self) -> f64 {
        self.signed.abs() + MARGIN * self.magnitude + self.contact
    }
}

impl Goal {
    /// The estimated errors of the factors of tips, from those of the solution and of the dual
    /// fields in cells; none without tips.
    pub(super) fn new(tips: &[Vec2], cells: &[Rect], estimated: &Estimated) -> Self {
        if tips.is_empty() {
            return Self::default();
        }
        let mut sums = vec![[ErrorSum::default(); FACTORS]; tips.len()];
        let mut of_cells = Vec::with_capacity(cells.len());
        let parts = estimated.products.iter().zip(&estimated.contact);
        for (cell, (products, contact)) in cells.iter().zip(parts) {
            let of_mode = |mode: usize| {
                let k = mode + 1;
                (products[(0, k)], (contact * products[(k, k)]).sqrt())
            };
            let parts: [_; FACTORS] = std::array::from_fn(of_mode);
            let distances = tips.iter().map(|tip| (*tip - cell.center()).length());
            let distances: Vec<f64> = distances.collect();
            let nearest = nearest(&distances);
            for (sums, distance) in sums.iter_mut().zip(&distances) {
                let share = (distances[nearest] / distance).powf(FALL).min(1.0);
                let all = sums.iter_mut().zip(parts);
                all.for_each(|(sum, (part, contact))| sum.add(share * part, share * contact));
            }
            let [first, second] = parts.map(|(part, contact)| part.abs() + contact);
            of_cells.push((nearest, first.hypot(second)));
        }
        let errors = sums.into_iter().map(|[one, two]| one.error().hypot(two.error())).collect();
        Self { errors, cells: of_cells }
    }
}

fn nearest(distances: &[f64]) -> usize {
    (0..distances.len()).min_by(|&a, &b| distances[a].total_cmp(&distances[b])).unwrap_or(0)
}
