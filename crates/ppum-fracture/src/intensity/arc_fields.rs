//! The auxiliary fields of a tip on an arc, which leave both faces of the arc free.
//!
//! ```text
//! φ = A z^λ    ψ = z^λ (±Ā v^λ − λA v)     v = 1/(1 + iqz)
//! φ = A ln z   ψ = −Ā ln(zv) − A v         2μu = kφ − zφ̄′ − ψ̄
//! ```
//!
//! with the curvature q, Kolosov's k, and + where λ is not whole: on the arc z̄ = zv. The factors
//! are those of λ = ½, A = (K_I − iK_II)/√(2π), and a force 1 along the axis has the logarithms
//! with A = −1/(4π) (docs/decisions/0048-arcs.md).
//!
//! Integrals on arcs take the change of a field that is turned with the arc about its centre,
//!
//! ```text
//! 𝓛u = (w·∇) u − q e₃ × u     w = e₁ + q e₃ × x
//! ```
//!
//! in place of u,₁. It has the potentials (1 + iqz) φ′ − iqφ and φ′ + (1 + iqz) ψ′ + iqψ, and
//! leaves the faces free again: those of λA z^(λ−1) + iq (λ − 1) A z^λ, and of A/z − iqA ln z.

use super::auxiliary::{Auxiliary, TipMaterialBody};
use super::sums::{Gradients, MODES};
use ppum::complex::Complex;
use ppum::crack::TipPoint;
use ppum::real::Real;
use std::f64::consts::TAU;

/// φ, φ′, zφ″, ψ and ψ′ of a field.
#[derive(Clone, Copy)]
struct Potentials<R> {
    phi: Complex<R>,
    slope: Complex<R>,
    bend: Complex<R>,
    psi: Complex<R>,
    psi_slope: Complex<R>,
}

impl<R: Real> Potentials<R> {
    #[inline(always)]
    fn plus(&self, other: &Self) -> Self {
        Self {
            phi: self.phi.plus(other.phi),
            slope: self.slope.plus(other.slope),
            bend: self.bend.plus(other.bend),
            psi: self.psi.plus(other.psi),
            psi_slope: self.psi_slope.plus(other.psi_slope),
        }
    }
}

/// A point of the frame of a tip on an arc.
#[derive(Clone, Copy)]
struct ArcPoint<R> {
    z: Complex<R>,
    /// 1/z
    inverse: Complex<R>,
    /// 1 + iqz, and one over it.
    w: Complex<R>,
    v: Complex<R>,
}

impl<R: Real> ArcPoint<R> {
    #[inline(always)]
    fn new(point: &TipPoint<R>, curvature: f64) -> Self {
        let (z, q) = (Complex(point.x, point.y), point.x.broadcast(curvature));
        let w = Complex(point.x.broadcast(1.0) - q * point.y, q * point.x);
        Self { z, inverse: z.inverse(), w, v: w.inverse() }
    }

    /// The potentials with φ = A z^λ, from z^λ and ±v^λ.
    #[inline(always)]
    fn power(&self, lambda: f64, [of_z, of_v]: [Complex<R>; 2], a: Complex<R>) -> Potentials<R> {
        let (own, av) = (a.conjugate().times(of_v), a.times(self.v));
        let part = of_z.times(self.inverse).scaled(lambda);
        let slope = a.times(part);
        Potentials {
            phi: a.times(of_z),
            slope,
            bend: slope.scaled(lambda - 1.0),
            psi: of_z.times(own.minus(av.scaled(lambda))),
            psi_slope: part.times(self.v).times(own.plus(a.scaled(1.0 - lambda)).minus(av)),
        }
    }

    /// The potentials with φ = A ln z, from ln z and ln v.
    #[inline(always)]
    fn logarithm(&self, [of_z, of_v]: [Complex<R>; 2], a: Complex<R>) -> Potentials<R> {
        let (conjugate, slope, av) = (a.conjugate(), a.times(self.inverse), a.times(self.v));
        Potentials {
            phi: a.times(of_z),
            slope,
            bend: slope.scaled(-1.0),
            psi: conjugate.times(of_z.plus(of_v)).plus(av).scaled(-1.0),
            psi_slope: self.v.times(self.inverse).times(a.minus(conjugate).minus(av)),
        }
    }

    /// u, with the scale 1/2μ.
    #[inline(always)]
    fn displacement(&self, kolosov: f64, scale: f64, of: &Potentials<R>) -> [R; 2] {
        let other = self.z.conjugate().times(of.slope).plus(of.psi).conjugate();
        let Complex(x, y) = of.phi.scaled(kolosov).minus(other).scaled(scale);
        [x, y]
    }

    /// ∇u, with the scale 1/2μ.
    #[inline(always)]
    fn gradient(&self, kolosov: f64, scale: f64, of: &Potentials<R>) -> Gradients<R> {
        let own = of.slope.scaled(kolosov).minus(of.slope.conjugate());
        let ratio = self.z.conjugate().times(self.inverse);
        let other = ratio.times(of.bend).plus(of.psi_slope).conjugate();
        let (along, across) = (own.minus(other), own.plus(other).turned());
        let (along, across) = (along.scaled(scale), across.scaled(scale));
        [[along.0, across.0], [along.1, across.1]]
    }
}

impl TipMaterialBody {
    /// The fields at a tip on an arc, as [`TipMaterialBody::fields`] has them of a straight crack.
    #[inline(always)]
    pub(super) fn arc_fields<R: Real, const D: usize>(
        &self,
        point: &TipPoint<R>,
    ) -> [Auxiliary<R>; MODES] {
        let at = ArcPoint::new(point, self.curvature);
        let [c, s] = point.half_root(point.radius());
        let (root, zero) = (Complex(c, s), point.x.broadcast(0.0));
        let half = [root, at.v.root()];
        let before = [root.times(at.inverse), half[1].times(at.w)];
        let one = Complex(point.x.broadcast(TAU.sqrt().recip()), zero);
        // of |q| z: a constant does not count with the loads of a field in equilibrium, and T shall
        // not depend on the unit of length
        let of_z = at.z.scaled(self.curvature.abs());
        let of_z = of_z.logarithm(root.angle() * zero.broadcast(2.0));
        let logarithms = [of_z, at.v.logarithm(at.v.angle())];
        let force = Complex(point.x.broadcast(-0.5 / TAU), zero);
        let turning = at.logarithm(logarithms, force.turned().scaled(-self.curvature));
        let turned = at.power(-1.0, [at.inverse, at.w.scaled(-1.0)], force).plus(&turning);
        let own = at.logarithm(logarithms, force);
        [
            self.factor::<R, D>(&at, [half, before], one),
            self.factor::<R, D>(&at, [half, before], one.turned().scaled(-1.0)),
            self.auxiliary::<R, D>(&at, &own, &turned),
        ]
    }

    /// The field with φ = A z^½, from the powers ½ and −½ of z and v.
    #[inline(always)]
    fn factor<R: Real, const D: usize>(
        &self,
        at: &ArcPoint<R>,
        [half, before]: [[Complex<R>; 2]; 2],
        a: Complex<R>,
    ) -> Auxiliary<R> {
        let turning = at.power(0.5, half, a.turned().scaled(-0.5 * self.curvature));
        let turned = at.power(-0.5, before, a.scaled(0.5)).plus(&turning);
        self.auxiliary::<R, D>(at, &at.power(0.5, half, a), &turned)
    }

    /// A field by its potentials, and by those of its change.
    #[inline(always)]
    fn auxiliary<R: Real, const D: usize>(
        &self,
        at: &ArcPoint<R>,
        own: &Potentials<R>,
        turned: &Potentials<R>,
    ) -> Auxiliary<R> {
        let scale = 0.5 / self.moduli[1];
        let mut along = [[at.z.0.broadcast(0.0); 2]; 2];
        if D >= 2 {
            along = at.gradient(self.kolosov, scale, turned);
        }
        Auxiliary {
            derivative: at.displacement(self.kolosov, scale, turned),
            gradient: at.gradient(self.kolosov, scale, own),
            along,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::intensity::auxiliary::stress;
    use ppum::crack::{Crack, CrackEnd, End, LocalTip, Side};
    use ppum::dataset::{Material, StressState};
    use ppum::vec2::{Vec2, vec2};

    fn body(curvature: f64) -> TipMaterialBody {
        let material = Material { young: 2.0, poisson: 0.27, state: StressState::PlaneStrain };
        TipMaterialBody::new(&material, curvature)
    }

    fn at(body: &TipMaterialBody, x: f64, y: f64) -> [Auxiliary; MODES] {
        let sign = if y >= 0.0 { 1.0 } else { -1.0 };
        body.arc_fields::<f64, 2>(&TipPoint { x, y, sign, branch: 1.0 })
    }

    fn largest(of: &Gradients) -> f64 {
        of.as_flattened().iter().fold(0.0, |most, entry| entry.abs().max(most))
    }

    /// The fields of an arc that is nearly straight are those of a straight crack, whose other
    /// formulas are in `auxiliary`.
    #[test]
    fn nearly_straight_arcs() {
        let (bent, straight) = (body(1e-11), body(0.0));
        for (x, y) in [(0.3, 0.4), (-0.7, 0.2), (-0.5, -0.6), (0.2, -0.9)] {
            let sign = if y >= 0.0 { 1.0 } else { -1.0 };
            let fields = straight.fields::<f64, 2>(&TipPoint { x, y, sign, branch: 1.0 });
            for (a, b) in at(&bent, x, y).iter().zip(&fields) {
                for (a, b) in [(&a.gradient, &b.gradient), (&a.along, &b.along)] {
                    let difference = crate::intensity::auxiliary::difference(a, b);
                    assert!(largest(&difference) < 1e-9, "{a:?} {b:?}");
                }
                let difference = Vec2::from(a.derivative) - Vec2::from(b.derivative);
                assert!(difference.length() < 1e-9);
            }
        }
    }

    /// 𝓛u by its definition has the gradient of the derivative: w·∇u − q e₃ × u, whose gradient by
    /// differences of ∇u alone is w·∇∇u + q (∇u e₃× − e₃ × ∇u); and σ is in equilibrium.
    #[test]
    fn fields_turn_with_the_arc() {
        for q in [0.6, -0.9] {
            let (body, h) = (body(q), 1e-5);
            for (x, y) in [(0.3, 0.4), (-0.7, 0.2), (-0.5, -0.6), (0.2, -0.7)] {
                let [own, e, w, n, s] = [[0.0, 0.0], [h, 0.0], [-h, 0.0], [0.0, h], [0.0, -h]]
                    .map(|[dx, dy]| at(&body, x + dx, y + dy));
                for m in 0..MODES {
                    let g = own[m].gradient;
                    let slope = |of: &dyn Fn(&Auxiliary) -> f64| {
                        let part = |a: &[Auxiliary; MODES], b: &[Auxiliary; MODES]| {
                            (of(&a[m]) - of(&b[m])) / (2.0 * h)
                        };
                        vec2(part(&e, &w), part(&n, &s))
                    };
                    let way = vec2(1.0 - q * y, q * x);
                    for i in 0..2 {
                        // of the row that e₃ × gives: −u_y, u_x
                        let turned = [-g[1][0], -g[1][1], g[0][0], g[0][1]];
                        for j in 0..2 {
                            let moved = slope(&|of| of.gradient[i][j]).dot(way);
                            let column = if j == 0 { g[i][1] } else { -g[i][0] };
                            let expected = moved + q * (column - turned[2 * i + j]);
                            let found = own[m].along[i][j];
                            assert!((found - expected).abs() < 1e-7, "{m}: {found} {expected}");
                            let slope = slope(&|of| of.derivative[i]);
                            let difference = if j == 0 { slope.x } else { slope.y };
                            assert!((found - difference).abs() < 1e-7, "{found} {difference}");
                        }
                        let row = |of: &Auxiliary| stress(body.moduli, &of.gradient)[i];
                        let divergence = slope(&|of| row(of)[0]).x + slope(&|of| row(of)[1]).y;
                        assert!(divergence.abs() < 1e-6, "{divergence}");
                    }
                }
            }
        }
    }

    /// Both faces of the arc are free, of the fields and of their changes.
    #[test]
    fn faces_of_arcs_are_free() {
        for bulge in [0.2, -0.5, 0.9] {
            let points = vec![vec2(-0.4, 0.3), vec2(0.5, 0.1)];
            let crack = Crack { points, bulges: vec![bulge], ends: [CrackEnd::Tip; 2] };
            for end in [End::Start, End::Last] {
                let edge = crack.edge_to(end);
                let body = body(edge.curvature());
                let tip = LocalTip::on(&crack, 0, end, edge.to);
                for (part, side) in
                    [0.6, 0.8, 0.95, 0.999].map(|p| [(p, Side::Above), (p, Side::Below)]).concat()
                {
                    // relative to the tip, near which places in the world have few digits
                    let behind = edge.reversed().way(1.0 - part);
                    let point = tip.point([behind.x, behind.y], side);
                    let fields = body.arc_fields::<f64, 2>(&point);
                    let normal = edge.tangent(part).left();
                    let n = vec2(tip.axis.dot(normal), tip.axis.cross(normal));
                    for gradient in fields.iter().flat_map(|f| [&f.gradient, &f.along]) {
                        let sigma = stress(body.moduli, gradient);
                        let traction = sigma.map(|row| Vec2::from(row).dot(n));
                        // stresses may cancel where the body turns
                        let size = largest(gradient);
                        assert!(traction.iter().all(|t| t.abs() < 1e-14 * size), "{traction:?}");
                    }
                }
            }
        }
    }
}
