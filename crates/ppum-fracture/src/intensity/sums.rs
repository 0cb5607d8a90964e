//! Integrals around a tip: sums over discs, their cut-offs, and the frame of the tip.

use ppum::crack::TipPoint;
use ppum::jet::Jet;
use ppum::real::Real;
use ppum::vec2::{Vec2, vec2};
use ppum_solve::quadrature::QuadratureErrorEstimate;

/// Exponent of the cut-off q = (1 − r²/R²)^m, which [`cut_off`] multiplies out. It is smooth enough
/// for plain Gauss rules across r = R: with m = 4 their error is seen at 1e-7, with more at 1e-10.
const CUT_OFF_POWER: u8 = 6;

/// Discs for each tip.
pub(super) const RINGS: usize = 3;

/// Auxiliary fields: one for each of K_I, K_II and T.
pub(super) const MODES: usize = 3;

/// Integrals of all modes over each disc.
pub(super) type Modes = [[f64; MODES]; RINGS];

/// Integrals around a tip.
#[derive(Clone, Copy, Default)]
pub(super) struct Integrals {
    pub(super) modes: Modes,
    /// The J-integral over the largest disc.
    pub(super) j: f64,
    /// Twice the strain energy in the largest disc.
    pub(super) energy: f64,
    /// Errors that the rules leave.
    pub(super) doubt: QuadratureErrorEstimate,
}

/// The ring that the tip is in a body of revolution.
#[derive(Clone, Copy, Debug)]
pub(super) struct TipRing {
    /// 2πR
    pub(super) circumference: f64,
    /// The hoop strain that is given at the tip.
    pub(super) given: f64,
    /// The part of the tip's hoop strain that has stress.
    pub(super) elastic: f64,
}

/// The gradient of each component, in the tip's frame.
pub(super) type Gradients<R = f64> = [[R; 2]; 2];

impl Integrals {
    pub(super) fn plus(self, other: Self) -> Self {
        let mode = |k: usize| std::array::from_fn(|i| self.modes[k][i] + other.modes[k][i]);
        let mut doubt = self.doubt;
        doubt.add(&other.doubt);
        let (j, energy) = (self.j + other.j, self.energy + other.energy);
        Self { modes: std::array::from_fn(mode), j, energy, doubt }
    }

    pub(super) fn times(self, weight: f64) -> Self {
        let modes = self.modes.map(|modes| modes.map(|m| weight * m));
        Self { modes, j: weight * self.j, energy: weight * self.energy, doubt: self.doubt }
    }

    /// The sizes of the integrals.
    pub(super) fn sizes(&self) -> Self {
        let modes = self.modes.map(|modes| modes.map(f64::abs));
        Self {
            modes,
            j: self.j.abs(),
            energy: self.energy.abs(),
            doubt: QuadratureErrorEstimate::default(),
        }
    }

    /// The largest ratio to sizes of the same kind.
    pub(super) fn part_of(&self, sizes: &Self) -> f64 {
        let all = |of: &Self| {
            of.modes.as_flattened().iter().copied().chain([of.j, of.energy]).collect::<Vec<_>>()
        };
        let ratios = all(self).into_iter().zip(all(sizes)).filter(|(_, size)| *size > 0.0);
        ratios.map(|(part, size)| part.abs() / size).fold(0.0, f64::max)
    }
}

/// r² of a point in the tip's frame.
#[inline(always)]
pub(super) fn square<R: Real>(point: &TipPoint<R>) -> R {
    point.x * point.x + point.y * point.y
}

/// q and q′(r)/r for r² = `square`; zero outside the disc.
#[inline(always)]
pub(super) fn cut_off<R: Real>(square: R, radius: f64) -> (R, R) {
    let inverse = (radius * radius).recip();
    let base =
        (square.broadcast(1.0) - square * square.broadcast(inverse)).max(square.broadcast(0.0));
    let fourth = base * base * (base * base);
    let power = fourth * base;
    (base * power, square.broadcast(-2.0 * f64::from(CUT_OFF_POWER) * inverse) * power)
}

/// q and q′(r)/r of the functionals that have dual solutions, q = (1 − r⁴/R⁴)⁴: it is flatter at
/// the tip than [`cut_off`], see [`Sensitivity`](super::Sensitivity).
#[inline(always)]
pub(super) fn flat_cut_off<R: Real>(square: R, radius: f64) -> (R, R) {
    let inverse = (radius * radius).recip();
    let part = square * square.broadcast(inverse);
    let base = (square.broadcast(1.0) - part * part).max(square.broadcast(0.0));
    let third = base * base * base;
    (base * third, square.broadcast(-16.0 * inverse) * part * third)
}

/// A vector in a frame with the given x axis.
pub(super) fn turned(axis: Vec2, vector: [f64; 2]) -> Vec2 {
    let vector = Vec2::from(vector);
    vec2(axis.dot(vector), axis.cross(vector))
}

/// The displacement gradient in a frame with the given x axis.
pub(super) fn in_frame(u: &[Jet<f64>], axis: Vec2) -> Gradients {
    tensor_in_frame(&[0, 1].map(|i| vec2(u[i].x, u[i].y)), axis)
}

/// A gradient or strain in a frame with the given x axis.
pub(super) fn tensor_in_frame(g: &[Vec2; 2], axis: Vec2) -> Gradients {
    let (gx, gy) = (turned(axis, g[0].into()), turned(axis, g[1].into()));
    [(gx * axis.x + gy * axis.y).into(), (gy * axis.x - gx * axis.y).into()]
}
