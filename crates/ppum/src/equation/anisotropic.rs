//! The moduli of anisotropic bodies.

use super::{Eigenstrain, Elasticity, Moduli, StressState};
use crate::anisotropy::{Anisotropy, MODULI};
use crate::expression::Expression;
use crate::vec2::{Vec2, vec2};
use ppum_formula::real::{Lanes, Real};

impl Anisotropy {
    /// The body of this law. Its `young` and `poisson` are those of the isotropic body that is as
    /// stiff in the mean of both axes.
    #[must_use]
    pub fn body(self, state: StressState, eigenstrain: Option<Box<Eigenstrain>>) -> Elasticity {
        let [c11, c12, _, c22, ..] = self.plane.each_ref().map(|e| e.value(Vec2::ZERO));
        let (mean, ratio) = (0.5 * (c11 + c22), 2.0 * c12 / (c11 + c22));
        let (young, poisson) = match state {
            StressState::PlaneStress => (mean * (1.0 - ratio * ratio), ratio),
            StressState::PlaneStrain | StressState::Axisymmetric => {
                let nu = ratio / (1.0 + ratio);
                (mean * (1.0 + nu) * (1.0 - 2.0 * nu) / (1.0 - nu), nu)
            }
        };
        let (young, poisson) = (Expression::number(young), Expression::number(poisson));
        Elasticity { young, poisson, state, eigenstrain, anisotropy: Some(Box::new(self)) }
    }

    /// The moduli at points `anchor + offset`, with the strains that are given there.
    #[inline(always)]
    pub(super) fn moduli<R: Real>(
        &self,
        anchor: Vec2,
        offset: [R; 2],
        eigenstrain: Option<&Eigenstrain>,
    ) -> Moduli<R> {
        let [x, y] = offset;
        let all = self.moduli_of_lanes(anchor, [x.lanes(), y.lanes()], R::LANES, eigenstrain);
        let [c12, c16, c26, c66, first, second, young, xx, yy, xy, zz] = all;
        Moduli {
            lambda: x.with_lanes(|k| c12[k]),
            mu: x.with_lanes(|k| c66[k]),
            anisotropy: [
                x.with_lanes(|k| first[k]),
                x.with_lanes(|k| second[k]),
                x.with_lanes(|k| c16[k]),
                x.with_lanes(|k| c26[k]),
            ],
            young: x.with_lanes(|k| young[k]),
            eigenstrain: [
                x.with_lanes(|k| xx[k]),
                x.with_lanes(|k| yy[k]),
                x.with_lanes(|k| xy[k]),
                x.with_lanes(|k| zz[k]),
            ],
            ..Moduli::all(x.broadcast(0.0))
        }
    }

    fn moduli_of_lanes(
        &self,
        anchor: Vec2,
        [xs, ys]: [Lanes; 2],
        lanes: usize,
        eigenstrain: Option<&Eigenstrain>,
    ) -> [Lanes; MODULI] {
        let mut all = [Lanes::default(); MODULI];
        for lane in 0..lanes {
            let p = anchor + vec2(xs[lane], ys[lane]);
            let given = eigenstrain.map(|given| given.strains.each_ref().map(|e| e.value(p)));
            let at = self.moduli_at(p, given.unwrap_or_default());
            all.iter_mut().zip(at).for_each(|(of_lanes, value)| of_lanes[lane] = value);
        }
        all
    }
}
