//! Second-order jets: a value with its gradient and Hessian, and their algebra.
//!
//! Operations take the order `D` of derivatives that are kept: 0 value, 1 gradient, 2 Hessian.
//! Derivatives above `D` are left at zero and cost nothing.

use ppum_formula::real::{Lanes, Real};

/// Value, gradient and Hessian of a function at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<R> {
    /// f
    pub v: R,
    /// ∂f/∂x
    pub x: R,
    /// ∂f/∂y
    pub y: R,
    /// ∂²f/∂x²
    pub xx: R,
    /// ∂²f/∂x∂y
    pub xy: R,
    /// ∂²f/∂y²
    pub yy: R,
}

impl Jet<f64> {
    /// The jet outside the domain.
    pub(crate) const NAN: Self =
        Self { v: f64::NAN, x: f64::NAN, y: f64::NAN, xx: f64::NAN, xy: f64::NAN, yy: f64::NAN };
}

impl<R: Real<Scalar = f64>> Jet<R> {
    /// Writes lanes, with `D` derivatives and zeros for others, to a place for each.
    #[inline(always)]
    pub(crate) fn store<const D: usize>(
        &self,
        places: impl Iterator<Item = (usize, usize)>,
        out: &mut [Jet<f64>],
    ) {
        let mut lanes = [Lanes::default(); 6];
        self.v.store(&mut lanes[0]);
        if D >= 1 {
            self.x.store(&mut lanes[1]);
            self.y.store(&mut lanes[2]);
        }
        if D >= 2 {
            self.xx.store(&mut lanes[3]);
            self.xy.store(&mut lanes[4]);
            self.yy.store(&mut lanes[5]);
        }
        let [v, x, y, xx, xy, yy] = lanes;
        for (k, place) in places {
            out[place] = Jet { v: v[k], x: x[k], y: y[k], xx: xx[k], xy: xy[k], yy: yy[k] };
        }
    }
}

impl<R: Real> Jet<R> {
    /// The constant function `v`.
    #[inline(always)]
    #[must_use]
    pub fn constant(v: R) -> Self {
        let zero = v.broadcast(0.0);
        Self { v, x: zero, y: zero, xx: zero, xy: zero, yy: zero }
    }

    /// Product by Leibniz' rule.
    #[inline(always)]
    #[must_use]
    pub fn times<const D: usize>(self, b: Self) -> Self {
        let mut out = Self::constant(self.v * b.v);
        if D >= 1 {
            out.x = self.x.mul_add(b.v, self.v * b.x);
            out.y = self.y.mul_add(b.v, self.v * b.y);
        }
        if D >= 2 {
            let cross = self.x.mul_add(b.y, self.y * b.x);
            out.xx = self.xx.mul_add(b.v, self.v.mul_add(b.xx, (self.x + self.x) * b.x));
            out.xy = self.xy.mul_add(b.v, self.v.mul_add(b.xy, cross));
            out.yy = self.yy.mul_add(b.v, self.v.mul_add(b.yy, (self.y + self.y) * b.y));
        }
        out
    }

    /// Quotient `self / b` by the quotient rule.
    #[inline(always)]
    #[must_use]
    pub fn over<const D: usize>(self, b: Self) -> Self {
        let inverse = b.v.broadcast(1.0) / b.v;
        let mut out = Self::constant(self.v * inverse);
        if D >= 1 {
            out.x = (self.x - out.v * b.x) * inverse;
            out.y = (self.y - out.v * b.y) * inverse;
        }
        if D >= 2 {
            let cross = out.x.mul_add(b.y, out.y * b.x);
            out.xx = (self.xx - (out.x + out.x) * b.x - out.v * b.xx) * inverse;
            out.xy = (self.xy - cross - out.v * b.xy) * inverse;
            out.yy = (self.yy - (out.y + out.y) * b.y - out.v * b.yy) * inverse;
        }
        out
    }

    /// Sum.
    #[inline(always)]
    #[must_use]
    pub fn plus<const D: usize>(self, b: Self) -> Self {
        self.zip::<D>(b, |p, q| p + q)
    }

    /// Difference.
    #[inline(always)]
    #[must_use]
    pub fn minus<const D: usize>(self, b: Self) -> Self {
        self.zip::<D>(b, |p, q| p - q)
    }

    /// Product with a constant.
    #[inline(always)]
    #[must_use]
    pub fn scaled<const D: usize>(self, s: R) -> Self {
        self.zip::<D>(self, |p, _| p * s)
    }

    /// The jet on the lanes where the mask holds, zero on the others, whatever is there.
    #[inline(always)]
    #[must_use]
    pub fn only<const D: usize>(self, mask: R::Mask) -> Self {
        let zero = self.v.broadcast(0.0);
        self.zip::<D>(self, |p, _| R::select(mask, p, zero))
    }

    #[inline(always)]
    fn zip<const D: usize>(self, b: Self, f: impl Fn(R, R) -> R) -> Self {
        let mut out = Self::constant(f(self.v, b.v));
        if D >= 1 {
            out.x = f(self.x, b.x);
            out.y = f(self.y, b.y);
        }
        if D >= 2 {
            out.xx = f(self.xx, b.xx);
            out.xy = f(self.xy, b.xy);
            out.yy = f(self.yy, b.yy);
        }
        out
    }

    /// Derivatives with respect to the world of a jet taken in a frame whose x axis is the unit
    /// vector (c, s) and whose y axis is (−s, c).
    #[inline(always)]
    #[must_use]
    pub fn turned<const D: usize>(self, c: R, s: R) -> Self {
        let mut out = Self::constant(self.v);
        if D >= 1 {
            out.x = c * self.x - s * self.y;
            out.y = s.mul_add(self.x, c * self.y);
        }
        if D >= 2 {
            let (cc, ss, cs) = (c * c, s * s, c * s);
            let twice = (cs + cs) * self.xy;
            out.xx = cc.mul_add(self.xx, ss * self.yy) - twice;
            out.yy = ss.mul_add(self.xx, cc * self.yy) + twice;
            out.xy = cs * (self.xx - self.yy) + (cc - ss) * self.xy;
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x² y and 1 + x y² with their derivatives, at a point.
    fn pair(x: f64, y: f64) -> (Jet<f64>, Jet<f64>) {
        let f = Jet { v: x * x * y, x: 2.0 * x * y, y: x * x, xx: 2.0 * y, xy: 2.0 * x, yy: 0.0 };
        let g =
            Jet { v: 1.0 + x * y * y, x: y * y, y: 2.0 * x * y, xx: 0.0, xy: 2.0 * y, yy: 2.0 * x };
        (f, g)
    }

    fn close(a: Jet<f64>, b: Jet<f64>) {
        let (a, b) = ([a.v, a.x, a.y, a.xx, a.xy, a.yy], [b.v, b.x, b.y, b.xx, b.xy, b.yy]);
        for (p, q) in a.into_iter().zip(b) {
            assert!((p - q).abs() < 1e-13 * (1.0 + q.abs()), "{a:?} {b:?}");
        }
    }

    #[test]
    fn product_against_the_expanded_polynomial() {
        let (x, y) = (0.7, -1.3);
        let (f, g) = pair(x, y);
        // f g = x² y + x³ y³
        let expected = Jet {
            v: x * x * y + x.powi(3) * y.powi(3),
            x: 2.0 * x * y + 3.0 * x * x * y.powi(3),
            y: x * x + 3.0 * x.powi(3) * y * y,
            xx: 2.0 * y + 6.0 * x * y.powi(3),
            xy: 2.0 * x + 9.0 * x * x * y * y,
            yy: 6.0 * x.powi(3) * y,
        };
        close(f.times::<2>(g), expected);
    }

    #[test]
    fn quotient_undoes_the_product() {
        let (f, g) = pair(0.7, -1.3);
        close(f.times::<2>(g).over::<2>(g), f);
    }

    /// The linear-quadratic function a² + 3ab in a turned frame, expanded by hand for 90°.
    #[test]
    fn turning_by_a_right_angle() {
        // frame x axis = world y, frame y axis = −world x: a = Y, b = −X
        let (wx, wy) = (0.3, 0.8);
        let (a, b) = (wy, -wx);
        let frame = Jet {
            v: a * a + 3.0 * a * b,
            x: 2.0 * a + 3.0 * b,
            y: 3.0 * a,
            xx: 2.0,
            xy: 3.0,
            yy: 0.0,
        };
        let world = Jet {
            v: wy * wy - 3.0 * wx * wy,
            x: -3.0 * wy,
            y: 2.0 * wy - 3.0 * wx,
            xx: 0.0,
            xy: -3.0,
            yy: 2.0,
        };
        close(frame.turned::<2>(0.0, 1.0), world);
    }
}
