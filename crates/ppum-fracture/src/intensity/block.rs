//! The integrands of the interaction integral at the points of a rule, on lanes.

use super::auxiliary::{Auxiliary, stress, work};
use super::integral::Interaction;
use super::sums::{
    Gradients, Integrals, MODES, RINGS, cut_off, flat_cut_off, in_frame, square, turned,
};
use ppum::crack::{LocalTip, Side, TipPoint};
use ppum::field::LocalField;
use ppum::jet::Jet;
use ppum::real::{LaneJob, LaneNumber, Real};
use ppum::vec2::Vec2;
use ppum_solve::assembly::FACTORS;
use ppum_solve::law::{Coefficients, Stress};
use ppum_solve::quadrature::CellRule;

/// Sums at a point: of each disc those of its modes, J and the energy.
const SUMS: usize = RINGS * MODES + 2;

/// The terms that vary from point to point.
#[derive(Clone, Copy, Debug)]
struct PointTerms {
    /// The coefficients of the law.
    moduli: Coefficients,
    /// The body force in the tip's frame.
    force: [f64; 2],
}

impl<'a> Interaction<'a> {
    /// The part of a rule's points inside the largest disc. `seen` is the field as it was last
    /// looked at: most rules around a tip have the tip as their anchor.
    pub(super) fn rule(&self, rule: &CellRule, seen: &mut Option<LocalField<'a>>) -> Integrals {
        let near = rule.anchor - self.center;
        let all = rule.offsets.iter().zip(&rule.weights);
        let inside = all.filter(|(o, _)| (near + **o).length() < self.largest());
        let (offsets, weights): (Vec<Vec2>, Vec<f64>) = inside.unzip();
        let mut jets = vec![Jet::constant(0.0); 2 * offsets.len()];
        let known = seen.take().filter(|local| local.anchor == rule.anchor);
        let local = seen.insert(known.unwrap_or_else(|| self.field.at(rule.anchor)));
        local.evaluate_over::<1>(&offsets, Side::Above, &rule.patches, &mut jets);
        PointBlock::new(self, rule.anchor, &offsets).integrals(&weights, &jets)
    }

    /// Returns the terms of a point, where the field has a gradient that is given in the tip's
    /// frame.
    fn local(&self, world: Vec2) -> PointTerms {
        let force = self.loads.body_force(world).unwrap_or_default();
        PointTerms { moduli: self.moduli(world), force: turned(self.axis, force).into() }
    }
}

/// Points that see a tip from one anchor.
pub(super) struct PointBlock<'b> {
    tip: &'b Interaction<'b>,
    pub(super) local_tip: LocalTip<'b>,
    pub(super) anchor: Vec2,
    pub(super) offsets: &'b [Vec2],
    /// None where all points are alike, and no force acts.
    locals: Option<Vec<PointTerms>>,
}

impl<'b> PointBlock<'b> {
    pub(super) fn new(tip: &'b Interaction<'b>, anchor: Vec2, offsets: &'b [Vec2]) -> Self {
        let local = |&offset: &Vec2| tip.local(anchor + offset);
        let locals = tip.has_sources().then(|| offsets.iter().map(local).collect());
        Self { tip, local_tip: tip.path.at(anchor), anchor, offsets, locals }
    }

    /// The integrals of a field with these jets, the two components of a point beside each other.
    pub(super) fn integrals(&self, weights: &[f64], jets: &[Jet<f64>]) -> Integrals {
        let at = |(&offset, u): (&Vec2, _)| {
            let (tip, place) = (self.tip, (self.anchor + offset, None));
            [tip.gradient(u, tip.axis), tip.elastic(u, place, tip.axis)]
        };
        let gradients: Vec<_> = self.offsets.iter().zip(jets.chunks_exact(2)).map(at).collect();
        let derivatives = self.is_curved().then(|| {
            let points = self.offsets.iter().zip(jets.chunks_exact(2));
            let at = |(&offset, u)| {
                self.tip.turned_field(u, self.anchor + offset, self.tip.axis).derivative
            };
            points.map(at).collect()
        });
        let energies = self.locals.as_ref().map(|locals| {
            let points = self.offsets.iter().zip(locals).zip(jets.chunks_exact(2));
            let source = |((&offset, local), u): ((&Vec2, &PointTerms), _)| {
                self.tip.energy_source(self.anchor + offset, local.force, u)
            };
            points.map(source).collect()
        });
        let sums =
            f64::dispatch(BlockSums { block: self, weights, gradients, derivatives, energies });
        let mut integrals =
            Integrals { j: -sums[SUMS - 2], energy: sums[SUMS - 1], ..Integrals::default() };
        for (modes, sums) in integrals.modes.iter_mut().zip(sums.chunks_exact(MODES)) {
            modes.copy_from_slice(sums);
        }
        match self.tip.ring {
            Some(_) => integrals.plus(self.tip.around_axis(self, weights, jets)),
            None => integrals,
        }
    }

    fn is_curved(&self) -> bool {
        self.tip.body.curvature != 0.0
    }

    /// G of both modes, times the weights.
    pub(super) fn kernels(&self, weights: &[f64]) -> Vec<[Stress; FACTORS]> {
        let mut kernels = f64::dispatch(Kernels { block: self, weights });
        self.tip.add_hoop_kernels(self, weights, &mut kernels);
        kernels
    }

    /// The points from one on, as many as there are lanes; the last stands in for those that
    /// are missing.
    #[inline(always)]
    fn points<R: Real<Scalar = f64>>(&self, first: usize, zero: R) -> TipPoint<R> {
        let at = |k: usize| self.offsets[(first + k).min(self.offsets.len() - 1)];
        let offset = [zero.with_lanes(|k| at(k).x), zero.with_lanes(|k| at(k).y)];
        self.local_tip.point(offset, Side::Above)
    }

    /// The auxiliary fields at these points.
    #[inline(always)]
    fn auxiliary<R: Real<Scalar = f64>, const D: usize, const CURVED: bool>(
        &self,
        point: &TipPoint<R>,
    ) -> [Auxiliary<R>; MODES] {
        if CURVED {
            self.tip.body.arc_fields::<R, D>(point)
        } else {
            self.tip.body.fields::<R, D>(point)
        }
    }

    /// The coefficients of the law and the force at these points.
    #[inline(always)]
    fn locals<R: Real<Scalar = f64>>(&self, first: usize, zero: R) -> (Coefficients<R>, [R; 2]) {
        let Some(locals) = &self.locals else {
            return (broadcast(self.tip.body.moduli, zero), [zero; 2]);
        };
        let at = |k: usize| &locals[(first + k).min(locals.len() - 1)];
        let part = |m: usize| zero.with_lanes(|k| at(k).moduli[m]);
        (
            [part(0), part(1), part(2), part(3), part(4), part(5)],
            [zero.with_lanes(|k| at(k).force[0]), zero.with_lanes(|k| at(k).force[1])],
        )
    }
}

/// The coefficients in all lanes; no closure, which would leave the vectors' instructions.
#[inline(always)]
fn broadcast<R: Real>([a, b, c, d, e, f]: Coefficients, like: R) -> Coefficients<R> {
    let all = |constant: f64| like.broadcast(constant);
    [all(a), all(b), all(c), all(d), all(e), all(f)]
}

/// A point and the field there, in the tip's frame.
struct FieldSample<R> {
    point: TipPoint<R>,
    u: Gradients<R>,
    /// 𝓛u: u_,1 at a straight crack.
    derivative: [R; 2],
    /// The part of ∇u that has stress.
    elastic: Gradients<R>,
    moduli: Coefficients<R>,
    force: [R; 2],
}

/// P_j x_j, which times q′/r is P_j q_,j, and P_j,j of all modes; and σ.
struct Integrands<R> {
    flows: [R; MODES],
    sources: [R; MODES],
    stress: Gradients<R>,
}

impl<R: Real> FieldSample<R> {
    /// The integrands in a body that has the constants `moduli` at the tip; `CURVED` where that is
    /// on an arc.
    #[inline(always)]
    fn integrands<const D: usize, const CURVED: bool>(
        &self,
        moduli: Coefficients,
        auxiliary: &[Auxiliary<R>; MODES],
    ) -> Integrands<R> {
        let moduli = broadcast(moduli, self.point.x);
        let (own, at_tip) = (stress(self.moduli, &self.elastic), stress(moduli, &self.u));
        let through = self.through(&own, &at_tip, moduli);
        let [mut flows, mut sources] = [[self.point.x.broadcast(0.0); MODES]; 2];
        for (mode, auxiliary) in auxiliary.iter().enumerate() {
            let ([a, b], [c, d]) = (auxiliary.gradient, through);
            flows[mode] = c[0] * a[0] + c[1] * a[1] + (d[0] * b[0] + d[1] * b[1]);
            if CURVED {
                let (along, [x, y]) = (auxiliary.derivative, [self.point.x, self.point.y]);
                let flow = |i: usize| own[i][0] * x + own[i][1] * y;
                flows[mode] =
                    flows[mode] + (flow(0) * (along[0] - a[0]) + flow(1) * (along[1] - b[0]));
            }
            if D >= 2 {
                sources[mode] = self.divergence(&own, &at_tip, auxiliary);
            }
        }
        Integrands { flows, sources, stress: own }
    }

    /// Returns P_j x_j in terms of ∇uᵃ: with σᵃ_ij 𝓛u_i x_j = C:(𝓛u x) on ∇uᵃ, and P_j = σ_ij
    /// uᵃ_i,1 + σᵃ_ij 𝓛u_i − σᵃ_ik ε_ik w_j, where σᵃ_ik ε_ik is the stress that the tip's material
    /// would have, on εᵃ, and w_j x_j = x.
    #[inline(always)]
    fn through(
        &self,
        own: &Gradients<R>,
        at_tip: &Gradients<R>,
        moduli: Coefficients<R>,
    ) -> Gradients<R> {
        let (x, y, [u, v]) = (self.point.x, self.point.y, self.derivative);
        let dual = stress(moduli, &[[x * u, y * u], [x * v, y * v]]);
        let ([a, b], [c, d], [s, t]) = (own, dual, at_tip);
        [
            [a[0] * x + a[1] * y + c[0] - x * s[0], c[1] - x * s[1]],
            [b[0] * x + b[1] * y + d[0] - x * t[0], d[1] - x * t[1]],
        ]
    }

    /// P_j,j = σ_ij (S_tip − S)_ijkl 𝓛σᵃ_kl − b_i 𝓛uᵃ_i with the compliance S, written without it:
    /// what σ exceeds the stress of the tip's material by, on 𝓛εᵃ.
    #[inline(always)]
    fn divergence(&self, own: &Gradients<R>, at_tip: &Gradients<R>, auxiliary: &Auxiliary<R>) -> R {
        let ([a, b], [s, t]) = (own, at_tip);
        let excess = [[a[0] - s[0], a[1] - s[1]], [b[0] - t[0], b[1] - t[1]]];
        let [a, b] = auxiliary.derivative;
        work(&excess, &auxiliary.along) - (self.force[0] * a + self.force[1] * b)
    }
}

/// E_j x_j with E_j = W w_j − σ_ij 𝓛u_i and W = ½ σ_ij (u_i,j − ε⁰_ij): the flow of energy whose
/// integral round a tip is J.
#[inline(always)]
fn energy_flow<R: Real>(stress: &Gradients<R>, sample: &FieldSample<R>) -> R {
    let FieldSample { point, derivative: [u, v], elastic, .. } = sample;
    let flow = |j: usize| stress[0][j] * *u + stress[1][j] * *v;
    (work(stress, elastic) * point.x.broadcast(0.5) - flow(0)) * point.x - flow(1) * point.y
}

/// The sums of all integrands over the points of a block, in their order.
struct BlockSums<'b> {
    block: &'b PointBlock<'b>,
    weights: &'b [f64],
    /// ∇u and its part that has stress.
    gradients: Vec<[Gradients; 2]>,
    /// 𝓛u at a tip on an arc.
    derivatives: Option<Vec<[f64; 2]>>,
    /// E_j,j, if it is not zero.
    energies: Option<Vec<f64>>,
}

impl LaneJob<f64> for BlockSums<'_> {
    type Output = [f64; SUMS];

    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(self, zero: R) -> [f64; SUMS] {
        match (self.block.locals.is_some(), self.block.is_curved()) {
            (false, false) => self.over::<R, 1, false>(zero),
            (true, false) => self.over::<R, 2, false>(zero),
            // derivatives of the fields on arcs cost little beside the rest
            (_, true) => self.over::<R, 2, true>(zero),
        }
    }
}

impl BlockSums<'_> {
    #[inline(always)]
    fn over<R: Real<Scalar = f64>, const D: usize, const CURVED: bool>(
        &self,
        zero: R,
    ) -> [f64; SUMS] {
        let mut sums = [0.0; SUMS];
        for first in (0..self.weights.len()).step_by(R::LANES) {
            let densities = self.densities::<R, D, CURVED>(first, zero);
            for (sum, density) in sums.iter_mut().zip(densities) {
                let lanes = density.lanes();
                for (weight, density) in self.weights[first..].iter().zip(&lanes[..R::LANES]) {
                    *sum += weight * density;
                }
            }
        }
        sums
    }

    /// The integrands at the points from one on.
    #[inline(always)]
    fn densities<R: Real<Scalar = f64>, const D: usize, const CURVED: bool>(
        &self,
        first: usize,
        zero: R,
    ) -> [R; SUMS] {
        let PointBlock { tip, .. } = self.block;
        let at = |k: usize| (first + k).min(self.weights.len() - 1);
        let (moduli, force) = self.block.locals(first, zero);
        let part = |part: usize, i: usize, j: usize| {
            zero.with_lanes(|k| self.gradients[at(k)][part][i][j])
        };
        let [u, elastic] = [0, 1].map(|p| [0, 1].map(|i| [0, 1].map(|j| part(p, i, j))));
        let derivative = match &self.derivatives {
            Some(all) if CURVED => [0, 1].map(|i| zero.with_lanes(|k| all[at(k)][i])),
            _ => [u[0][0], u[1][0]],
        };
        let point = self.block.points(first, zero);
        let sample = FieldSample { point, u, derivative, elastic, moduli, force };
        let auxiliary = self.block.auxiliary::<R, D, CURVED>(&sample.point);
        let of = sample.integrands::<D, CURVED>(tip.body.moduli, &auxiliary);
        let source = match &self.energies {
            Some(energies) => zero.with_lanes(|k| energies[at(k)]),
            None => zero,
        };
        let square = square(&sample.point);
        let mut densities = [zero; SUMS];
        let mut last = (zero, zero);
        for (modes, radius) in densities.chunks_exact_mut(MODES).zip(tip.radii) {
            last = cut_off(square, radius);
            for (density, (flow, source)) in modes.iter_mut().zip(of.flows.iter().zip(of.sources)) {
                *density = last.1 * *flow + last.0 * source;
            }
        }
        let energy = energy_flow(&of.stress, &sample);
        densities[SUMS - 2] = last.1 * energy + last.0 * source;
        densities[SUMS - 1] = work(&of.stress, &sample.elastic);
        densities
    }
}

/// The integrands over the largest disc in terms of ∇u, times E′/2 and the weights.
struct Kernels<'b> {
    block: &'b PointBlock<'b>,
    weights: &'b [f64],
}

impl LaneJob<f64> for Kernels<'_> {
    type Output = Vec<[Stress; FACTORS]>;

    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(self, zero: R) -> Self::Output {
        match (self.block.locals.is_some(), self.block.is_curved()) {
            (false, false) => self.over::<R, 1, false>(zero),
            (true, false) => self.over::<R, 2, false>(zero),
            (_, true) => self.over::<R, 2, true>(zero),
        }
    }
}

impl Kernels<'_> {
    #[inline(always)]
    fn over<R: Real<Scalar = f64>, const D: usize, const CURVED: bool>(
        &self,
        zero: R,
    ) -> Vec<[Stress; FACTORS]> {
        let mut all = vec![[Stress::default(); FACTORS]; self.weights.len()];
        for (first, kernels) in (0..).step_by(R::LANES).zip(all.chunks_mut(R::LANES)) {
            for (component, [x, y]) in
                self.densities::<R, D, CURVED>(first, zero).into_iter().enumerate()
            {
                for (mode, (x, y)) in x.into_iter().zip(y).enumerate() {
                    let (x, y) = (x.lanes(), y.lanes());
                    for (k, kernel) in kernels.iter_mut().enumerate() {
                        let weight = self.weights[first + k];
                        kernel[mode].0[component] = [weight * x[k], weight * y[k], 0.0];
                    }
                }
            }
        }
        all
    }

    /// Returns the integrands of both modes for a gradient of one, for each component and axis.
    #[inline(always)]
    fn densities<R: Real<Scalar = f64>, const D: usize, const CURVED: bool>(
        &self,
        first: usize,
        zero: R,
    ) -> [[[R; FACTORS]; 2]; 2] {
        let PointBlock { tip, .. } = self.block;
        let (moduli, force) = self.block.locals(first, zero);
        let point = self.block.points(first, zero);
        let auxiliary = self.block.auxiliary::<R, D, CURVED>(&point);
        let (q, slope) = flat_cut_off(square(&point), tip.radii[RINGS - 1]);
        let halves = tip.kernel_factors().map(|factor| zero.broadcast(factor));
        let bend = zero.broadcast(tip.body.curvature);
        let at_tip = broadcast(tip.body.moduli, zero);
        let mut densities = [[[zero; FACTORS]; 2]; 2];
        for (component, of_component) in densities.iter_mut().enumerate() {
            for (axis, of_modes) in of_component.iter_mut().enumerate() {
                let [[a, b], [c, d]] = unit(component, axis, tip.axis);
                let u = [
                    [zero.broadcast(a), zero.broadcast(b)],
                    [zero.broadcast(c), zero.broadcast(d)],
                ];
                let derivative = if CURVED { moved(&point, &u, bend) } else { [u[0][0], u[1][0]] };
                let of = FieldSample { point, u, derivative, elastic: u, moduli, force }
                    .integrands::<D, CURVED>(tip.body.moduli, &auxiliary);
                for (mode, density) in of_modes.iter_mut().enumerate() {
                    let mut source = of.sources[mode];
                    if CURVED {
                        let of_mode = stress(at_tip, &auxiliary[mode].gradient);
                        source = source + bend * turning(&of_mode, &u);
                    }
                    *density = halves[mode] * (slope * of.flows[mode] + q * source);
                }
            }
        }
        densities
    }
}

/// (w·∇) u: 𝓛u without the part that has no derivative of u.
#[inline(always)]
fn moved<R: Real>(point: &TipPoint<R>, u: &Gradients<R>, curvature: R) -> [R; 2] {
    let (along, across) = (curvature.broadcast(1.0) - curvature * point.y, curvature * point.x);
    // no closure, which would leave the vectors' instructions
    [u[0][0] * along + u[0][1] * across, u[1][0] * along + u[1][1] * across]
}

/// σ : ∇(e₃ × u), which times q c stands for what [`moved`] leaves out: −σ_ij c (e₃ × u)_i q_,j
/// integrated by parts, since σ is in equilibrium and leaves the faces free.
#[inline(always)]
fn turning<R: Real>(stress: &Gradients<R>, u: &Gradients<R>) -> R {
    let part = |j: usize| stress[1][j] * u[0][j] - stress[0][j] * u[1][j];
    part(0) + part(1)
}

/// The gradient of a component along an axis, in the tip's frame.
pub(super) fn unit(component: usize, axis: usize, frame: Vec2) -> Gradients {
    let mut u = [Jet::constant(0.0); 2];
    (u[component].x, u[component].y) = if axis == 0 { (1.0, 0.0) } else { (0.0, 1.0) };
    in_frame(&u, frame)
}
