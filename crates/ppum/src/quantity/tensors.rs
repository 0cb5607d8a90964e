//! Strain and stress of a displacement gradient: the native kernels of the quantities
//! of elasticity.

use crate::equation::Moduli;
use crate::jet::Jet;
use ppum_formula::elementary::Atan;
use ppum_formula::real::Real;

/// Strain tensor and rotation.
pub(super) struct Strain<R> {
    pub(super) xx: R,
    pub(super) yy: R,
    pub(super) xy: R,
    pub(super) curl: R,
}

/// Stress tensor.
pub(super) struct Stress<R> {
    pub(super) xx: R,
    pub(super) yy: R,
    pub(super) xy: R,
    pub(super) zz: R,
}

impl<R: Real> Strain<R> {
    #[inline(always)]
    pub(super) fn new(u: &[Jet<R>]) -> Self {
        let half = u[0].v.broadcast(0.5);
        let curl = u[1].x - u[0].y;
        Self { xx: u[0].x, yy: u[1].y, xy: (u[0].y + u[1].x) * half, curl }
    }

    /// The strain without what is given of it in the plane; zeros change no bit.
    #[inline(always)]
    pub(super) fn elastic(&self, moduli: &Moduli<R>) -> Self {
        let [xx, yy, xy] = moduli.plane_eigenstrain();
        Self { xx: self.xx - xx, yy: self.yy - yy, xy: self.xy - xy, curl: self.curl }
    }

    /// The stress of an elastic strain, σ_zz = ν(σ_xx + σ_yy) − E ε⁰_zz in plane strain.
    #[inline(always)]
    pub(super) fn stress(&self, moduli: &Moduli<R>) -> Stress<R> {
        let double_mu = moduli.mu + moduli.mu;
        let pressure = moduli.lambda * (self.xx + self.yy);
        let (xx, yy) = (double_mu.mul_add(self.xx, pressure), double_mu.mul_add(self.yy, pressure));
        let zz = moduli.out_of_plane * (xx + yy) - moduli.young * moduli.eigenstrain[3];
        Stress { xx, yy, xy: double_mu * self.xy, zz }
    }

    /// ½ σ:(ε − ε⁰) of an elastic strain. With ε_zz = 0 or σ_zz = 0 the third direction has ½ E
    /// (ε⁰_zz)² beside.
    #[inline(always)]
    pub(super) fn energy(&self, s: &Stress<R>, moduli: &Moduli<R>) -> R {
        let (half, through) = (self.xx.broadcast(0.5), moduli.eigenstrain[3]);
        let plane = half * s.xx.mul_add(self.xx, s.yy * self.yy) + s.xy * self.xy;
        plane + half * moduli.young * (through * through)
    }
}

impl<R: Real> Stress<R> {
    #[inline(always)]
    pub(super) fn center(&self) -> R {
        (self.xx + self.yy) * self.xx.broadcast(0.5)
    }

    /// Radius of Mohr's circle.
    #[inline(always)]
    pub(super) fn radius(&self) -> R {
        let half = (self.xx - self.yy) * self.xx.broadcast(0.5);
        half.mul_add(half, self.xy * self.xy).sqrt()
    }

    #[inline(always)]
    pub(super) fn von_mises(&self) -> R {
        let (a, b, c) = (self.xx - self.yy, self.yy - self.zz, self.zz - self.xx);
        let normal = a.mul_add(a, b.mul_add(b, c * c)) * a.broadcast(0.5);
        (self.xy * self.xy).mul_add(a.broadcast(3.0), normal).sqrt()
    }

    #[inline(always)]
    pub(super) fn tresca(&self) -> R {
        let (high, low) = (self.center() + self.radius(), self.center() - self.radius());
        high.max(self.zz) - low.min(self.zz)
    }

    /// ½ atan2(2σ_xy, σ_xx − σ_yy) in the half-angle form atan(σ_xy / (radius + half difference)),
    /// π/2 on its pole.
    #[inline(always)]
    pub(super) fn direction(&self) -> R {
        let half = (self.xx - self.yy) * self.xx.broadcast(0.5);
        let radius = self.radius();
        let zero = half.broadcast(0.0);
        // tan = xy/(r + h) = (r − h)/xy: the form that does not cancel
        let ahead = half.ge(zero);
        let (up, down) =
            (R::select(ahead, self.xy, radius - half), R::select(ahead, radius + half, self.xy));
        // a radius that is not a number stays one: there is no direction where there is no gradient
        let tangent = R::select(radius.gt(zero), up / down, radius);
        let is_pole = zero.broadcast(f64::NEG_INFINITY).ge(tangent);
        R::via_f64([R::select(is_pole, -tangent, tangent)], Atan)
    }
}
