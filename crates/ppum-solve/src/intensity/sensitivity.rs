//! What stress intensity factors are of the field: linear functionals.
//!
//! ```text
//! K_m = ∫ G_m : ∇u dA + …      G_m : ∇u = E′/2 (P_j q_,j + (σ − σ_tip) : εᵃ_,1 q)
//! ```
//!
//! with the integrand of the interaction integral over the largest disc, which is linear in ∇u. The body force and the loads on
//! faces add numbers that no error of the field changes. What faces behind kinks add is left out: it is small beside the rest.

use super::auxiliary::Auxiliary;
use super::integral::{Interaction, MODES, Place, cut_off, in_frame, square};
use super::{Loads, Outcome, RADII};
use crate::geometry::Placed;
use crate::quadrature::Rule;
use crate::space::Space;
use ppum::crack::{Side, tips};
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::vec2::Vec2;

/// The modes I and II.
pub(crate) const FACTORS: usize = 2;

/// G of a mode at a point, times the weight of the point: of each component the vector that its gradient is multiplied with.
pub(crate) type Kernel = [Vec2; 2];

/// The factors of one tip as functionals.
pub(crate) struct Sensitivity<'a>(Interaction<'a>);

/// The functionals of all tips that have factors, in their order.
pub(crate) fn sensitivities<'a>(
    dataset: &Dataset,
    field: &'a Field<'a>,
    space: &'a Space<'a>,
) -> Vec<Sensitivity<'a>> {
    let of_tip = |outcome: Outcome| {
        let radii = RADII.map(|part| part * outcome.clearance.radius);
        Interaction::new(field, space, outcome.tip, radii, Loads::default())
    };
    let outcomes = tips(&field.step.cracks).map(|tip| Outcome::new(dataset, space, tip));
    outcomes.filter(Outcome::has_room).filter_map(of_tip).map(Sensitivity).collect()
}

impl Sensitivity<'_> {
    /// The tip's place.
    pub(crate) fn tip(&self) -> Vec2 {
        self.0.center
    }

    /// The cells that meet the disc.
    pub(crate) fn cells(&self, cells: &Placed<usize>) -> Vec<usize> {
        self.0.cells(cells).collect()
    }

    /// G of both modes at the points of a rule; zero outside the disc.
    pub(crate) fn kernels(&self, rule: &Rule) -> Vec<[Kernel; FACTORS]> {
        let points = rule.offsets.iter().zip(&rule.weights);
        points.map(|(&offset, weight)| self.at(rule.anchor, offset, *weight)).collect()
    }

    fn at(&self, anchor: Vec2, offset: Vec2, weight: f64) -> [Kernel; FACTORS] {
        let tip = self.0.course.at(anchor);
        let point = tip.point([offset.x, offset.y], Side::Above);
        if square(&point) >= self.0.largest() * self.0.largest() {
            return [[Vec2::ZERO; 2]; FACTORS];
        }
        let auxiliary = self.0.auxiliary(&point);
        let mut kernels = [[Vec2::ZERO; 2]; FACTORS];
        for i in 0..2 {
            for along_x in [true, false] {
                let mut u = [Jet::constant(0.0); 2];
                (u[i].x, u[i].y) = if along_x { (1.0, 0.0) } else { (0.0, 1.0) };
                let u = in_frame(&u, tip.axis);
                let place = Place { point, world: anchor + offset, u, force: Vec2::ZERO };
                for (kernel, value) in kernels.iter_mut().zip(self.0.densities(&place, &auxiliary)) {
                    let entry = if along_x { &mut kernel[i].x } else { &mut kernel[i].y };
                    *entry = weight * value;
                }
            }
        }
        kernels
    }
}

impl Interaction<'_> {
    /// E′/2 times the integrands of both modes over the largest disc.
    fn densities(&self, place: &Place, auxiliary: &[Auxiliary; MODES]) -> [f64; FACTORS] {
        let integrands = self.integrands_with(place, auxiliary);
        let (q, slope) = cut_off(square(&place.point), self.largest());
        let half = 0.5 * self.modulus();
        [0, 1].map(|mode| half * (slope * integrands.flows[mode] + q * integrands.sources[mode]))
    }
}
