//! Estimated errors of stress intensity factors.
//!
//! A factor is a linear functional of the field, K(u) = a(u, z) with a dual solution z of its own,
//! so that its error is a(u − u_h, z − z_h) (Becker & Rannacher 2001). The disagreements of local
//! fields stand for both errors,
//!
//! ```text
//! |K − K_h| ≈ 2 |Σ_j w_j e_j| + Σ_j |w_j e_j| + 3 D
//! e_j = ∫_{C_j} Σ_i s_i φ_i (σ(u_i) − σ(u_h)) : (ε(z_i) − ε(z_h))
//! ```
//!
//! with the largest difference D of the factors over three discs. The first sum is a half of the
//! error to all of it, mostly with its sign; the second one is there because the first may cancel
//! by chance. Products of norms, Σ_j η_j(u) η_j(z), were up to a hundred times the error
//! (docs/decisions/0018).
//!
//! At the tip z is singular, and no order resolves it: e_j is large there, as it does not know that
//! the error of u is orthogonal to the space. The difference of the factors over two discs does: it
//! is a(u − u_h, z_1 − z_2) with two dual solutions that differ in the discs alone. So it stands
//! for the error there, and the weights w_j grow from 0 at half the radius of the largest disc to 1
//! at one and a half of it.
//!
//! The functionals of all tips are added up, so that two dual solutions serve any number of tips.
//! The contribution of a cell may be due to any of them, the more the nearer: the strain of a dual
//! solution falls like r^(−3/2) from its tip, so a tip at the distance r counts (r_nearest /
//! r)^(3/2) of it. A cell far from all tips, as at a corner that pollutes all factors, counts fully
//! for each.
//!
//! For faces that touch the weak form misses ρ = σ_m − min(P, 0), with the error −∫ ρ P(z − z_h)/β
//! (`assembly/contact.rs`). The dual solution belongs to the faces that touch in u_h; where contact
//! ends in a cell the others are unknown, and so is z: there ∫ |ρ| |P(z_h)|/β is added. A tip whose
//! faces touch has K_I = 0, so that K_I is an error.

use crate::intensity::{TipDisc, TipResult};
use faer::Mat;
use ppum::vec2::Rect;
use ppum_solve::assembly::CellErrors;
use ppum_solve::assembly::FACTORS;

/// Exponent by which the strain of a dual solution falls from its tip, and that of its stress on
/// faces that touch beside another tip, which concentrates it.
const FALL: f64 = 1.5;
const FALL_AT_TIPS: f64 = 0.5;

/// Factor of the sum with signs; the other one has none.
const WITH_SIGNS: f64 = 2.0;

/// Factor of the largest difference of the discs: of errors that the discs alone see, as by a
/// material that varies at the tip, it is 0.5 to 7 times the error (docs/decisions/0018).
const OF_DISCS: f64 = 3.0;

/// Distance from a tip, in radii of its disc, up to which the discs know better than cells.
const KNOWN: f64 = 0.5;

/// The estimated errors of factors.
#[derive(Clone, Debug, Default)]
pub(super) struct FactorErrors {
    /// The errors of (K_I, K_II) of each tip with factors, in their order.
    pub(super) errors: Vec<f64>,
    /// The contribution of each cell to the error of the nearest tip, and the number of that tip.
    pub(super) cells: Vec<(usize, f64)>,
}

/// The contributions of cells to the error of a factor.
#[derive(Clone, Copy, Debug, Default)]
struct ErrorSum {
    /// With their signs.
    signed: f64,
    /// Without signs.
    magnitude: f64,
    /// The error of faces that touch.
    contact: f64,
}

impl ErrorSum {
    fn add(&mut self, part: f64, contact: f64) {
        self.signed += part;
        self.magnitude += part.abs();
        self.contact += contact;
    }

    fn error(self) -> f64 {
        WITH_SIGNS * self.signed.abs() + self.magnitude + self.contact
    }
}

impl FactorErrors {
    /// Computes the contributions of cells to the errors of the factors of tips, from the products
    /// of the disagreements of the solution and the dual solutions, where faces touch, and their
    /// own results; none without tips.
    pub(super) fn new(
        tips: &[TipDisc],
        cells: &[Rect],
        products: &[Mat<f64>],
        touching: &[CellErrors],
        results: &[TipResult],
    ) -> Self {
        if tips.is_empty() {
            return Self::default();
        }
        let mut contact = vec![[0.0; FACTORS]; cells.len()];
        for CellErrors { cell, errors } in touching {
            contact[*cell].copy_from_slice(errors);
        }
        let mut sums = vec![[ErrorSum::default(); FACTORS]; tips.len()];
        let mut of_cells = Vec::with_capacity(cells.len());
        for ((cell, products), contact) in cells.iter().zip(products).zip(contact) {
            let parts: [f64; FACTORS] = std::array::from_fn(|mode| products[(0, mode + 1)]);
            let distance = |disc: &TipDisc| (disc.tip - cell.center()).length();
            let distances: Vec<f64> = tips.iter().map(distance).collect();
            let by_distance = |a: &usize, b: &usize| distances[*a].total_cmp(&distances[*b]);
            let nearest = (0..tips.len()).min_by(by_distance).unwrap_or(0);
            for ((sums, disc), distance) in sums.iter_mut().zip(tips).zip(&distances) {
                let nearer = (distances[nearest] / distance).min(1.0);
                let known = (distance / disc.radius - KNOWN).clamp(0.0, 1.0);
                let (share, of_faces) = (known * nearer.powf(FALL), nearer.powf(FALL_AT_TIPS));
                for ((sum, part), contact) in sums.iter_mut().zip(parts).zip(contact) {
                    sum.add(share * part, of_faces * contact);
                }
            }
            let [one, two] = [0, 1].map(|mode| parts[mode].abs() + contact[mode]);
            of_cells.push((nearest, one.hypot(two)));
        }
        // the factors themselves tell of their errors, too
        let own = results.iter().filter_map(|tip| Some((tip, tip.factors.as_ref()?)));
        let errors = sums.into_iter().zip(own).map(|([one, two], (tip, factors))| {
            let of_tip = if tip.touches { tip.opening.abs() } else { 0.0 };
            let of_discs = OF_DISCS * factors.largest_difference().max(0.0);
            one.error().hypot(two.error()) + (of_discs + of_tip)
        });
        Self { errors: errors.collect(), cells: of_cells }
    }
}
