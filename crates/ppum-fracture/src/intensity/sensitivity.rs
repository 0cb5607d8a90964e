//! Stress intensity factors as linear functionals of the field.
//!
//! ```text
//! K_m = ∫ G_m : ∇u dA + …      G_m : ∇u = E′/2 (P_j q_,j + (σ − σ_tip) : εᵃ_,1 q)
//! ```
//!
//! with the integrand of the interaction integral over the largest disc, which is linear in ∇u. Its
//! cut-off q is flatter at the tip than that of the factors: their dual solutions go there like (1
//! − q) r^(−1/2), which the space does not have, and 1 − q ~ r⁴ leaves less of it than r². The body
//! force and the loads on faces add numbers that no error of the field changes. The contribution of
//! faces behind kinks is left out: it is small beside the rest. On an arc the part of 𝓛u without a
//! derivative is integrated by parts.

use super::block::PointBlock;
use super::integral::Interaction;
use ppum::vec2::Vec2;
use ppum_problem::geometry::BoxList;
use ppum_solve::assembly::{FACTORS, LinearFunctional};
use ppum_solve::law::Stress;
use ppum_solve::quadrature::{CellRule, Disc};

/// Gauss points in each direction of large pieces, for a cut-off of degree 16; and the size of
/// pieces from which on they are large, in radii of the smallest disc.
const ORDER: usize = 20;
const ALL_POINTS: f64 = 0.5;

/// The factors of one tip as functionals.
pub(crate) struct Sensitivity<'a>(pub(super) Interaction<'a>);

/// A tip, and the radius of the disc that its factors are integrated over.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TipDisc {
    pub(crate) tip: Vec2,
    pub(crate) radius: f64,
    /// E′/2 times the number of halves that the disc stands for, of both modes.
    pub(crate) scale: [f64; FACTORS],
}

impl Sensitivity<'_> {
    /// Where the functional is integrated.
    pub(crate) fn disc(&self) -> TipDisc {
        let scale = self.0.halves().map(|halves| 0.5 * self.0.modulus() * halves);
        TipDisc { tip: self.0.center, radius: self.0.largest(), scale }
    }
}

impl LinearFunctional for Sensitivity<'_> {
    fn cells(&self, cells: &BoxList<usize>) -> Vec<usize> {
        self.0.cells(cells).collect()
    }

    fn rules(&self, cell: usize) -> Vec<CellRule> {
        let Interaction { space, center, radii, .. } = &self.0;
        let disc = Disc {
            center: *center,
            radius: self.0.largest(),
            scale: ALL_POINTS * radii[0],
            order: ORDER,
            least: space.degree() + ORDER / 2,
        };
        space.quadrature(0).disc(space.cell(cell), disc)
    }

    fn kernels(&self, rule: &CellRule) -> Vec<[Stress; FACTORS]> {
        PointBlock::new(&self.0, rule.anchor, &rule.offsets).kernels(&rule.weights)
    }
}
