//! The third strain in the integrals around the tip of a body of revolution.
//!
//! With x the distance from the axis, R that of the tip, r = x its name here, and auxiliary fields
//! of plane strain in the half-plane, which have a stress σᵃ_θ = ν (σᵃ_11 + σᵃ_22) but no strain
//! around the axis,
//!
//! ```text
//! P_j = σ_ij 𝓛uᵃ_i + σᵃ_ij 𝓛u_i − ω w_j      ω = σᵃ_ik ε_ik + σᵃ_θ ε_θ
//! (r P_j),j = r (σ − C_tip ε)_ij 𝓛εᵃ_ij − r b·𝓛uᵃ
//!             + σ_θ 𝓛uᵃ_r + σᵃ_ir 𝓛u_i − σᵃ_θ ((w·∇) u_r − w_r ε_θ) − w_r ω
//! K = E′/(2R) ∫ r P_j q_,j + (r P_j),j q dA      T = E′ (M + ν ε_θ) + σ_22
//! (r E_j),j = r (½ ε:C,_w:ε + b·𝓛u) + w_r W + σ_θ ((w·∇) u_r − 𝓛u_r − w_r ε_θ)
//! ```
//!
//! with ε_θ and C of three strains in the first line and at the tip in the last one but one. In the
//! plane 𝓛u is u_,1 and w is e₁; on an arc they are those of `intensity`, and nothing changes, for
//! the strain ε_θ is a scalar there. The weights of quadrature are those of rings, 2πr: sums are
//! over 2πR in the end. A strain that is given at the tip is subtracted from ε there, in 𝓛u and in
//! ε_θ, but not in (w·∇) u_r − w_r ε_θ = r (w·∇) ε_θ.
//!
//! Here are the differences from what the plane law has, point by point.

use super::auxiliary::{Auxiliary, TipMaterialBody, stress, work};
use super::block::{PointBlock, unit};
use super::integral::Interaction;
use super::sums::{
    Gradients, Integrals, MODES, RINGS, TipRing, cut_off, flat_cut_off, square, turned,
};
use ppum::crack::{Side, TipPoint};
use ppum::jet::Jet;
use ppum::vec2::Vec2;
use ppum_solve::assembly::FACTORS;
use ppum_solve::law::{Coefficients, FaceLocation, Strain, Stress};
use ppum_solve::quadrature::circumference;

/// The hoop at a point, and what its terms take of the field there, in the tip's frame.
struct HoopSample {
    /// ε_θ without what is given at the tip.
    strain: f64,
    /// The part of ε_θ that has stress.
    elastic: f64,
    /// σ_θ
    stress: f64,
    /// r (w·∇) ε_θ
    change: f64,
    /// ∇u and 𝓛u
    gradient: Gradients,
    derivative: [f64; 2],
}

/// A point of the half-plane as seen from the tip.
struct RingPoint<'t> {
    body: &'t TipMaterialBody,
    point: TipPoint<f64>,
    /// Distance from the axis, its direction, and that of w along it.
    radius: f64,
    outward: Vec2,
    way: f64,
    /// λ and μ there.
    moduli: Coefficients,
}

impl RingPoint<'_> {
    /// P_j x_j and P_j,j of the hoop for an auxiliary field.
    fn terms(&self, of: &HoopSample, auxiliary: &Auxiliary) -> [f64; 2] {
        let ([own, ..], [at_tip, ..]) = (self.moduli, self.body.moduli);
        let (aux, [a, b]) = (stress(self.body.moduli, &auxiliary.gradient), auxiliary.derivative);
        let trace = |g: &Gradients| g[0][0] + g[1][1];
        let around = at_tip * trace(&auxiliary.gradient);
        let flow = own * of.elastic * (a * self.point.x + b * self.point.y)
            - self.point.x * of.strain * around;
        let excess = (own * of.elastic - at_tip * of.strain) * trace(&auxiliary.along);
        let along_radius = aux.map(|row| Vec2::from(row).dot(self.outward));
        let omega = work(&aux, &of.gradient) + around * of.strain;
        let others = of.stress * self.outward.dot([a, b].into())
            + Vec2::from(along_radius).dot(of.derivative.into())
            - around * of.change
            - self.way * omega;
        [flow, excess + others / self.radius]
    }
}

impl Interaction<'_> {
    /// The ring of the tip, in a body of revolution.
    pub(super) fn tip_ring(&self, displacement: [f64; 2]) -> Option<TipRing> {
        let law = self.law.at(self.center);
        let given = -law.elastic(&Strain::default()).hoop();
        let strain = displacement[0] / self.center.x;
        let circumference = circumference(self.center);
        let ring = TipRing { circumference, given, elastic: strain - given };
        self.law.has_hoop_strain().then_some(ring)
    }

    /// The length of the circle that a point stands for; 1 in the plane.
    pub(super) fn circle(&self, offset: Vec2) -> f64 {
        self.ring.map_or(1.0, |_| circumference(self.center + offset))
    }

    fn ring_point(&self, world: Vec2, point: TipPoint<f64>) -> RingPoint<'_> {
        let outward = turned(self.axis, [1.0, 0.0]);
        let (moduli, way) = (self.moduli(world), self.way(world).dot(outward));
        RingPoint { body: &self.body, point, radius: world.x, outward, way, moduli }
    }

    /// The hoop of the field with these jets.
    fn hoop_sample(
        &self,
        ring: &TipRing,
        u: &[Jet<f64>],
        (world, face): (Vec2, FaceLocation),
    ) -> HoopSample {
        let law = self.law.on(world, face);
        let (strain, of) = (law.strain(u), self.turned_field(u, world, self.axis));
        let (hoop, way) = (strain.hoop(), self.way(world));
        let way = self.axis * way.x + self.axis.left() * way.y;
        HoopSample {
            strain: hoop - ring.given,
            elastic: law.elastic(&strain).hoop(),
            stress: law.stress(&strain).hoop(),
            change: u[0].x * way.x + u[0].y * way.y - way.x * hoop,
            gradient: of.gradient,
            derivative: of.derivative,
        }
    }

    /// W of the hoop, and of all strains, where the elastic part of ∇u is given.
    fn hoop_energy(&self, of: &HoopSample, world: Vec2, elastic: &Gradients) -> [f64; 2] {
        let moduli = self.moduli(world);
        let trace = elastic[0][0] + elastic[1][1];
        let hoop = 0.5 * of.elastic * (moduli[0] * trace + of.stress);
        [hoop, hoop + 0.5 * work(&stress(moduli, elastic), elastic)]
    }

    /// The terms of the hoop at the points of a block.
    pub(super) fn around_axis(
        &self,
        block: &PointBlock<'_>,
        weights: &[f64],
        jets: &[Jet<f64>],
    ) -> Integrals {
        let Some(ring) = &self.ring else { return Integrals::default() };
        let points = block.points_of_tip().zip(weights).zip(jets.chunks_exact(2));
        let at = |(((world, point), weight), u): ((_, &f64), &[Jet<f64>])| {
            self.hoop_terms(ring, (world, point), u).times(*weight)
        };
        points.map(at).fold(Integrals::default(), Integrals::plus)
    }

    fn hoop_terms(
        &self,
        ring: &TipRing,
        (world, point): (Vec2, TipPoint<f64>),
        u: &[Jet<f64>],
    ) -> Integrals {
        let (of, at) = (self.hoop_sample(ring, u, (world, None)), self.ring_point(world, point));
        let terms = self.body.fields_at::<2>(&point).map(|own| at.terms(&of, &own));
        let cut_offs = self.radii.map(|radius| cut_off(square(&point), radius));
        let modes =
            cut_offs.map(|(q, slope)| terms.map(|[flow, source]| slope * flow + q * source));
        let elastic = self.elastic(u, (world, None), self.axis);
        let [hoop, all] = self.hoop_energy(&of, world, &elastic);
        let (q, slope) = cut_offs[RINGS - 1];
        let [x, y] = of.derivative;
        let flow = hoop * point.x - at.moduli[0] * of.elastic * (x * point.x + y * point.y);
        let turned = at.outward.dot(of.derivative.into());
        let source = at.way * all + of.stress * (of.change - turned);
        let j = -(slope * flow + q * source / at.radius);
        Integrals { modes, j, energy: 2.0 * hoop, ..Integrals::default() }
    }

    /// −ω w_j n_j of the hoop at a point of a face, of all modes, and W of the hoop.
    pub(super) fn hoop_on_face(
        &self,
        u: &[Jet<f64>],
        (world, face): (Vec2, FaceLocation),
        (point, normal): (&TipPoint<f64>, Vec2),
    ) -> ([f64; MODES], f64) {
        let Some(ring) = &self.ring else { return ([0.0; MODES], 0.0) };
        let of = self.hoop_sample(ring, u, (world, face));
        let elastic = self.elastic(u, (world, face), self.axis);
        let across = self.way(world).dot(normal);
        let part = |own: Auxiliary| {
            let around = self.body.moduli[0] * (own.gradient[0][0] + own.gradient[1][1]);
            -around * of.strain * across
        };
        let [energy, _] = self.hoop_energy(&of, world, &elastic);
        (self.body.fields_at::<1>(point).map(part), energy)
    }

    /// Adds the terms of the hoop to the kernels of a block.
    pub(super) fn add_hoop_kernels(
        &self,
        block: &PointBlock<'_>,
        weights: &[f64],
        kernels: &mut [[Stress; FACTORS]],
    ) {
        if self.ring.is_none() {
            return;
        }
        let factors = self.kernel_factors();
        for (((world, point), weight), kernels) in block.points_of_tip().zip(weights).zip(kernels) {
            let at = self.ring_point(world, point);
            let fields = self.body.fields_at::<2>(&point);
            let (q, slope) = flat_cut_off(square(&point), self.largest());
            for (component, operator) in [(0, 0), (0, 1), (1, 0), (1, 1), (0, 2)] {
                let of = self.unit_sample(&at, world, (component, operator));
                for ((kernel, own), factor) in kernels.iter_mut().zip(&fields).zip(factors) {
                    let [flow, source] = at.terms(&of, own);
                    kernel.0[component][operator] += factor * weight * (slope * flow + q * source);
                }
            }
        }
    }

    /// The hoop of a field of which one number alone, D_k u_i, is 1.
    fn unit_sample(
        &self,
        at: &RingPoint<'_>,
        world: Vec2,
        (component, operator): (usize, usize),
    ) -> HoopSample {
        let [lambda, mu, ..] = at.moduli;
        let way = self.way(world);
        if operator == 2 {
            let (strain, stress) = (1.0, lambda + 2.0 * mu);
            let (gradient, derivative) = ([[0.0; 2]; 2], [0.0; 2]);
            return HoopSample {
                strain,
                elastic: strain,
                stress,
                change: -at.way,
                gradient,
                derivative,
            };
        }
        let gradient = unit(component, operator, self.axis);
        let derivative = gradient.map(|row| Vec2::from(row).dot(way));
        let change = at.outward.dot(derivative.into());
        let stress = lambda * (gradient[0][0] + gradient[1][1]);
        HoopSample { strain: 0.0, elastic: 0.0, stress, change, gradient, derivative }
    }
}

impl PointBlock<'_> {
    /// The points with their places in the tip's frame.
    fn points_of_tip(&self) -> impl Iterator<Item = (Vec2, TipPoint<f64>)> {
        self.offsets.iter().map(|&offset| {
            let point = self.local_tip.point([offset.x, offset.y], Side::Above);
            (self.anchor + offset, point)
        })
    }
}
