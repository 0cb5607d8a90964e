//! The native kernel of the Westergaard functions, standing in for their formulas.

use crate::crack::TipPoint;
use crate::jet::Jet;
use ppum_formula::real::Real;

/// The four functions of [`WESTERGAARD`](super::WESTERGAARD) with derivatives in the tip's frame.
///
/// Half-angle algebra on z^½ = √r e^{iθ/2}: two square roots and two divisions, no trigonometry.
/// Nothing cancels near θ = ±π, see [`TipPoint::half_root`]. At r = 0 the values are zero and the
/// derivatives NaN: they do not exist.
#[inline(always)]
pub fn westergaard<R: Real, const D: usize>(p: &TipPoint<R>) -> [Jet<R>; 4] {
    let r = p.x.mul_add(p.x, p.y * p.y).sqrt();
    let inverse = p.x.broadcast(1.0) / r;
    let apart = r.gt(p.x.broadcast(0.0));
    let [cosine, sine] = p.half_root(r);
    let (c, s) = root_jets::<R, D>(cosine, sine, p.x, p.y, inverse);
    let (ct, st) = (p.x * inverse, p.y * inverse);
    let angle = sine_jet::<R, D>(ct, st, inverse, apart);
    [c, s, s.times::<D>(angle), c.times::<D>(angle)]
}

/// Jets of C = Re z^½ and S = Im z^½ from (z^½)′ = ½ z^{−½} and (z^½)″ = −¼ z^{−3/2}.
#[inline(always)]
fn root_jets<R: Real, const D: usize>(c: R, s: R, x: R, y: R, inverse: R) -> (Jet<R>, Jet<R>) {
    let (mut jc, mut js) = (Jet::constant(c), Jet::constant(s));
    if D >= 1 {
        let half = inverse * x.broadcast(0.5);
        (jc.x, jc.y) = (c * half, s * half);
        (js.x, js.y) = (-(s * half), c * half);
    }
    if D >= 2 {
        let (ct, st) = (x * inverse, y * inverse);
        let quarter = inverse * inverse * x.broadcast(0.25);
        let real = (s * st - c * ct) * quarter;
        let imaginary = (s * ct + c * st) * quarter;
        (jc.xx, jc.xy, jc.yy) = (real, -imaginary, -real);
        (js.xx, js.xy, js.yy) = (imaginary, real, -imaginary);
    }
    (jc, js)
}

/// Jet of sin θ = y / r.
#[inline(always)]
fn sine_jet<R: Real, const D: usize>(ct: R, st: R, inverse: R, apart: R::Mask) -> Jet<R> {
    let mut jet = Jet::constant(R::select(apart, st, st.broadcast(0.0)));
    if D >= 1 {
        jet.x = -(st * ct) * inverse;
        jet.y = ct * ct * inverse;
    }
    if D >= 2 {
        let square = inverse * inverse;
        let (cc, ss) = (ct * ct, st * st);
        jet.xx = st * (cc + cc - ss) * square;
        jet.xy = ct * (ss + ss - cc) * square;
        jet.yy = -(st * cc * st.broadcast(3.0)) * square;
    }
    jet
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: f64, y: f64) -> TipPoint<f64> {
        TipPoint { x, y, sign: if y >= 0.0 { 1.0 } else { -1.0 }, branch: 1.0 }
    }

    /// The defining formulas in polar form, with library trigonometry.
    fn reference(x: f64, y: f64) -> [f64; 4] {
        let (r, t) = (x.hypot(y), y.atan2(x));
        let (c, s) = (r.sqrt() * (t / 2.0).cos(), r.sqrt() * (t / 2.0).sin());
        [c, s, s * t.sin(), c * t.sin()]
    }

    #[test]
    fn values_and_derivatives() {
        for (x, y) in [(0.3, 0.4), (-0.3, 0.4), (-0.7, -0.2), (2.0, -1.0), (-0.1, 1e-3)] {
            let jets = westergaard::<f64, 2>(&point(x, y));
            let h = 1e-5 * f64::hypot(x, y);
            let at = |dx: f64, dy: f64| westergaard::<f64, 2>(&point(x + dx, y + dy));
            for (k, (jet, expected)) in jets.iter().zip(reference(x, y)).enumerate() {
                assert!((jet.v - expected).abs() < 1e-15);
                let (e, w, n, s) = (at(h, 0.0)[k], at(-h, 0.0)[k], at(0.0, h)[k], at(0.0, -h)[k]);
                for (derivative, difference) in [
                    (jet.x, e.v - w.v),
                    (jet.y, n.v - s.v),
                    (jet.xx, e.x - w.x),
                    (jet.xy, e.y - w.y),
                    (jet.yy, n.y - s.y),
                ] {
                    let difference = difference / (2.0 * h);
                    let scale = 1.0 + derivative.abs() + (x * x + y * y).powf(-0.75);
                    if y.abs() > 2.0 * h {
                        assert!((derivative - difference).abs() < 1e-7 * scale, "{k} at {x} {y}");
                    }
                }
            }
        }
    }

    /// On the faces, a hair off them and at the tip.
    #[test]
    fn no_cancellation_near_the_faces() {
        let [c, s, ..] = westergaard::<f64, 1>(&point(-1.0, 1e-18));
        assert_eq!((c.v, s.v), (0.5e-18, 1.0));
        let below = TipPoint { x: -1.0, y: 0.0, sign: -1.0, branch: 1.0 };
        assert_eq!(westergaard::<f64, 0>(&below)[1].v, -1.0);
        let tip = westergaard::<f64, 1>(&point(0.0, 0.0));
        assert!(tip.iter().all(|jet| jet.v == 0.0 && !jet.x.is_finite()));
    }
}
