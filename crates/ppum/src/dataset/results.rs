//! Results of the solver for a step: attributes, history, reactions, intensities.

use crate::anisotropy::weakest_direction;
use crate::crack::TipId;
use crate::equation::{Elasticity, Equation, Material};
use crate::vec2::Vec2;

/// Named values, one per patch: order, enrichment, functions cut off, …
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attribute {
    /// Name, e.g. `unknowns`.
    pub name: String,
    /// One value per patch.
    pub values: Vec<f64>,
}

/// One number of the solver's report.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// Name, e.g. `residual` or `assembly`.
    pub name: String,
    /// Value.
    pub value: f64,
    /// Unit, e.g. `s`; empty for plain numbers.
    pub unit: String,
}

/// The resultant of what a support exerts on the body: R_i = ∫ t_i, M = ∫ (x − c) × t over the part
/// of the boundary where values are given. For elasticity t are the tractions of the components
/// that are held, c the centre of the domain's box; for a potential t is the flow κ ∂u/∂n into the
/// body.
///
/// The solver's t is the conservative one, (σ n)_i − β (u_i − g_i) with Nitsche's β (Hughes et al.
/// 2000): the reactions and the loads on a body add up to zero, to rounding. On an edge with a
/// crack it is σ n, and they add up to zero up to the error of the solution.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reaction {
    /// The place in words, e.g. `bottom`, `top from -0.1 to 0.1`, `hole 0`.
    pub on: String,
    /// For each component of the first field, whether the support holds it.
    pub held: Vec<bool>,
    /// Force per thickness \[stress·length\], one per component, zero where not held; of a
    /// potential the flow into the body.
    pub force: Vec<f64>,
    /// Moment per thickness about the centre of the domain's box, counter-clockwise
    /// \[stress·length²\]; zero for a potential.
    pub moment: f64,
}

/// The leading terms of the field at one tip: stress intensity factors, from interaction integrals
/// over several discs, and what stands beside them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TipIntensity {
    /// The tip.
    pub tip: TipId,
    /// Value of the preferred ring, K_I \[stress·length^½\].
    pub k1: f64,
    /// Value of the preferred ring, K_II.
    pub k2: f64,
    /// T: of the stress along the crack at the tip the part that is finite there, σ_11 = K terms +
    /// T \[stress\]. None where it is not known, or has no value.
    pub t_stress: Option<f64>,
    /// The J-integral, found without the factors: the energy released per length of growth and
    /// thickness, which is [G](Self::energy_release) \[stress·length\]. None where it is not known.
    pub j: Option<f64>,
    /// Estimated error of (K_I, K_II), the length of the difference \[stress·length^½\]. None where
    /// it is not known.
    pub error: Option<f64>,
    /// All rings. That they agree is a check of the integrals, no estimate of the error of K.
    pub rings: Vec<Ring>,
}

/// Part of |K| that K_I may be negative by where it should be zero.
const NOISE: f64 = 1e-3;

impl TipIntensity {
    /// The factors of a tip of which nothing else is known.
    #[must_use]
    pub fn new(tip: TipId, k1: f64, k2: f64) -> Self {
        Self { tip, k1, k2, t_stress: None, j: None, error: None, rings: Vec::new() }
    }

    /// G = (K_I² + K_II²) / E′, the energy released per length of growth and thickness, in the
    /// material at the tip.
    #[must_use]
    pub fn energy_release(&self, material: &Material) -> f64 {
        (self.k1 * self.k1 + self.k2 * self.k2) / material.effective_young()
    }

    /// G in a body, at the tip's place and with its direction of growth.
    #[must_use]
    pub fn energy_release_in(&self, body: &Elasticity, [tip, axis]: [Vec2; 2]) -> f64 {
        match &body.anisotropy {
            Some(law) => law.at_tip(tip, axis).energy_release([self.k1, self.k2]),
            None => self.energy_release(&body.at(tip)),
        }
    }

    /// The [angle of growth](Self::growth_angle) in a body, at the tip's place and with its
    /// direction of growth.
    #[must_use]
    pub fn growth_angle_in(&self, equation: &Equation, [tip, axis]: [Vec2; 2]) -> Option<f64> {
        let Some(law) = equation.anisotropy().map(|law| law.at_tip(tip, axis)) else {
            return self.growth_angle();
        };
        let k = [self.k1, self.k2];
        let hoop = |theta| law.hoop_stress(k, theta);
        law.opens(k, self.tolerance()).then(|| weakest_direction(hoop, |_| 1.0))
    }

    /// The angle from the crack's direction in which the hoop stress beside the tip is largest, and
    /// in which a crack in a brittle material grows (Erdogan & Sih 1963), in [−70.53°, 70.53°] as
    /// radians: 2 arctan(−2 K_II / (K_I + √(K_I² + 8 K_II²))).
    ///
    /// None where K_I is negative by more than its error, so that the faces overlap, or where there
    /// are no factors.
    #[must_use]
    pub fn growth_angle(&self) -> Option<f64> {
        let (k1, k2) = (self.k1, self.k2);
        let opens = k1 >= -self.tolerance() && k1.hypot(k2) > 0.0;
        let k1 = k1.max(0.0);
        let root = k1.hypot(8f64.sqrt() * k2);
        opens.then(|| 2.0 * (-2.0 * k2).atan2(k1 + root))
    }

    /// How negative the factor of an opening may be where it should be zero.
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        (NOISE * self.k1.hypot(self.k2)).max(self.error.unwrap_or(0.0))
    }

    /// The largest difference of two rings, |ΔK| / |K| with K = (K_I, K_II) and the preferred
    /// ring's in the denominator; NaN where that is zero, or without rings.
    ///
    /// A check that the integrals agree, and no estimate of the error of K: all radii see the same
    /// field, and most of its error enters them alike. Errors a hundred times as large are common.
    #[must_use]
    pub fn spread(&self) -> f64 {
        self.largest_difference() / self.k1.hypot(self.k2)
    }

    /// Returns the largest difference itself, not relative to K.
    #[must_use]
    pub fn largest_difference(&self) -> f64 {
        let difference = |a: &Ring, b: &Ring| (a.k1 - b.k1).hypot(a.k2 - b.k2);
        let pairs =
            self.rings.iter().flat_map(|a| self.rings.iter().map(move |b| difference(a, b)));
        pairs.fold(f64::NAN, f64::max)
    }
}

/// One evaluation of the interaction integral: the cut-off is one inside `r1` and zero outside
/// `r2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// Inner radius (0 when the cut-off falls from the tip on).
    pub r1: f64,
    /// Outer radius.
    pub r2: f64,
    /// K_I.
    pub k1: f64,
    /// K_II.
    pub k2: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crack::End;
    use crate::equation::StressState;

    fn factors(k1: f64, k2: f64) -> TipIntensity {
        TipIntensity::new(TipId { crack: 0, end: End::Last }, k1, k2)
    }

    /// The angles of Erdogan and Sih's criterion (1963), to 1e-7 degrees.
    #[test]
    fn angles_of_growth() {
        let angle = |k1, k2| factors(k1, k2).growth_angle().map(f64::to_degrees);
        for (k1, k2, degrees) in [
            (1.0, 0.0, 0.0),
            (1.0, 0.1, -11.2028777),
            (2.0, 1.0, -40.2078187),
            (3.0, 3.0, -53.1301024),
            (0.0, 1.0, -70.5287794),
        ] {
            for scale in [1e-200, 1.0, 1e150] {
                let found = angle(scale * k1, scale * k2).expect("an open crack");
                assert!((found - degrees).abs() < 1e-7, "{k1} {k2}: {found}");
                assert!(
                    (angle(scale * k1, -scale * k2).expect("its mirror image") + found).abs()
                        < 1e-12
                );
            }
        }
        // a K_I that is rounding of nothing is none; faces that overlap, and no field, have
        // no angle
        assert!((angle(-1e-9, 1.0).expect("shear") + 70.5287794).abs() < 1e-7);
        for (k1, k2) in [(-1.0, 0.0), (-0.1, 1.0), (0.0, 0.0), (f64::NAN, f64::NAN)] {
            assert_eq!(angle(k1, k2), None, "{k1} {k2}");
        }
    }

    /// The hoop stress √(2πr) σ_θθ = cos(θ/2) (K_I cos²(θ/2) − 3/2 K_II sin θ) is largest there.
    #[test]
    fn the_hoop_stress_is_largest_there() {
        for k in 0..40 {
            let phase = std::f64::consts::PI * (f64::from(k) / 39.0 - 0.5);
            let (k1, k2) = (phase.cos(), phase.sin());
            let hoop =
                |t: f64| (0.5 * t).cos() * (k1 * (0.5 * t).cos().powi(2) - 1.5 * k2 * t.sin());
            let found = hoop(factors(k1, k2).growth_angle().expect("an open crack"));
            let most = (-1000..=1000).map(|i| hoop(3.1e-3 * f64::from(i))).fold(0.0, f64::max);
            assert!(found >= most - 1e-12 && most > found - 1e-5, "{phase}: {found} {most}");
        }
    }

    #[test]
    fn energy_released() {
        let material = Material { young: 2.0, poisson: 0.25, state: StressState::PlaneStrain };
        assert!((factors(3.0, 4.0).energy_release(&material) - 25.0 * 0.9375 / 2.0).abs() < 1e-14);
    }

    #[test]
    fn the_spread_is_that_of_both_factors() {
        let ring = |k1, k2| Ring { r1: 0.0, r2: 1.0, k1, k2 };
        let rings = vec![ring(3.0, 4.03), ring(3.04, 4.0), ring(3.0, 4.0)];
        let intensity = TipIntensity { rings, ..factors(3.0, 4.0) };
        assert!((intensity.spread() - 0.01).abs() < 1e-15);
        assert!(factors(3.0, 4.0).spread().is_nan());
    }
}
