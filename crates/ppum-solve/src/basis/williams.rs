//! Williams' series at tips and corners: displacement fields that satisfy equilibrium and leave the
//! faces of a crack that is straight or an arc, or the sides of a wedge, free.
//!
//! ```text
//! c, s = r^λ cos λθ, r^λ sin λθ      C, S = r^λ cos (λ−2)θ, r^λ sin (λ−2)θ
//! I     2μ u_x = (κ − b) c − λ C      2μ u_y = (κ + b) s + λ S
//! II    2μ u_x = −(κ + b) s + λ S     2μ u_y = (κ − b) c + λ C
//! ```
//!
//! in the frame of the tip or of the wedge's bisector, from Kolosov's potentials φ = z^λ, ψ = b z^λ
//! and φ = i z^λ, ψ = −i b z^λ. At a tip λ = n + ½ with b = 1 − λ and 1 + λ (Williams 1957), of a
//! wedge they are [`WedgeTerm`]s (Williams 1952). One unknown each: they *tie* the components of
//! the functions c, s, C and S. For Poisson's equation, s alone leaves the faces of a crack free.
//!
//! On an arc of the curvature q, z̄ = z/(1 + iqz), so that the faces are free with
//!
//! ```text
//! φ = A z^λ    ψ = z^λ (Ā (1 + iqz)^−λ − λA (1 + iqz)^−1)    Poisson: Im (z/(1 + iqz/2))^λ
//! ```
//!
//! exactly (docs/decisions/0048-arcs.md). The powers of q z add functions c and s of later terms to
//! a term; what is left out beyond the last one is of the order of the first term that is missing.

use super::transform::FunctionCombinations;
use crate::corner::WedgeTerm;
use crate::space::{ANGULAR, Origin, SeriesFunctions, TrialSpace};
use faer::Mat;
use ppum::anisotropy::TipLaw;
use ppum::complex::Complex;
use ppum::crack::TipId;
use ppum::dataset::{BoxPartition, Elasticity, Equation, Step, monomials};
use ppum::polynomial::exponents;
use ppum::vec2::{Vec2, vec2};
use ppum_linear::times;
use ppum_problem::Symmetry;
use std::ops::Range;

/// A polynomial in ξ and η with values in the complex plane, in the order of the dataset.
type ComplexPolynomial = Vec<[f64; 2]>;

/// The combinations that the functions of a patch's series are taken in.
pub(super) fn parts(space: &TrialSpace<'_>, patch: usize) -> Vec<FunctionCombinations> {
    let is_scalar = space.equation().components() == 1;
    let part = |(functions, series): (Range<usize>, &SeriesFunctions)| {
        let n = functions.len();
        let rows = match series.origin {
            Origin::Tip(tip, _) if is_scalar => {
                let bend = PatchTipFrame::new(space.step(), patch, tip).scaled_curvature();
                potentials(series.terms(), 0.5 * bend)
            }
            _ => Mat::identity(n, n),
        };
        (functions, rows)
    };
    space.evaluated_series(patch).map(part).collect()
}

/// The terms Im (z/(1 + iqz))^λ of N in their functions: s, and of later terms c and s.
fn potentials(terms: usize, q: f64) -> Mat<f64> {
    let mut rows = Mat::zeros(terms, ANGULAR * terms);
    for n in 0..terms {
        let factors = binomial_series(-exponent(n), q);
        for ([re, im], later) in factors.zip(n..terms) {
            rows[(n, ANGULAR * later)] = im;
            rows[(n, ANGULAR * later + 1)] = re;
        }
    }
    rows
}

/// λ of a term of a tip.
fn exponent(term: usize) -> f64 {
    term as f64 + 0.5
}

/// The coefficients of the powers of z in (1 + iqz)^p.
fn binomial_series(p: f64, q: f64) -> impl Iterator<Item = [f64; 2]> {
    let next = move |(m, [re, im]): &(u32, [f64; 2])| {
        let factor = q * (p - f64::from(*m)) / f64::from(*m + 1);
        Some((*m + 1, [-factor * im, factor * re]))
    };
    std::iter::successors(Some((0, [1.0, 0.0])), next).map(|(_, coefficient)| coefficient)
}

/// Coefficients of the functions of a patch as they are stored from those of the functions that the
/// solver evaluates.
pub(super) fn stored(space: &TrialSpace<'_>, patch: usize, mut evaluated: &[f64]) -> Vec<f64> {
    let mut out = Vec::with_capacity(space.sizes[patch]);
    for series in space.series(patch) {
        let Origin::Tip(tip, _) = series.origin else { continue };
        let (before, after) = evaluated.split_at(series.functions.start - out.len());
        let (own, after) = after.split_at(series.evaluated());
        out.extend(before);
        out.extend(times(angular(space, patch, tip, series).as_ref(), own));
        evaluated = after;
    }
    out.extend(evaluated);
    out
}

/// The fields of the series of a patch as combinations of the functions that the solver evaluates,
/// one for each component; none without series, or with one component.
pub(super) fn fields(space: &TrialSpace<'_>, patch: usize) -> Option<Vec<[Vec<f64>; 2]>> {
    let Equation::Elasticity(body) = space.equation() else { return None };
    if space.series(patch).is_empty() {
        return None;
    }
    let n = space.evaluated(patch);
    let of_series = |(functions, series): (Range<usize>, &SeriesFunctions)| {
        let fields = match series.origin {
            Origin::Tip(tip, symmetry) => {
                of_tip(space.step(), patch, (tip, symmetry), series, body)
            }
            Origin::Corner { at, bisector, term } => vec![of_corner(at, bisector, &term, body)],
        };
        let place = move |field: TermFactors| field.map(|part| placed(&part, functions.start, n));
        fields.into_iter().map(place)
    };
    Some(space.evaluated_series(patch).flat_map(of_series).collect())
}

/// Factors of the functions c, s, C and S of each term of a series in the two components of a
/// field.
type TermFactors = [Vec<f64>; 2];

/// The fields of a tip, of each term for opening and for sliding, or of one symmetry alone.
fn of_tip(
    step: &Step,
    patch: usize,
    (tip, only): (TipId, Option<Symmetry>),
    series: &SeriesFunctions,
    body: &Elasticity,
) -> Vec<TermFactors> {
    let frame = PatchTipFrame::new(step, patch, tip);
    if let Some(law) = &body.anisotropy {
        return anisotropic(&law.at_tip(frame.at, frame.axis), only, series.terms(), frame.axis);
    }
    let (kappa, bend) = (body.at(frame.at).kolosov(), frame.scaled_curvature());
    let modes = |n: usize| {
        let lambda = exponent(n);
        let both = [(Symmetry::Symmetric, 1.0 - lambda), (Symmetry::Antisymmetric, 1.0 + lambda)];
        let wanted = both.into_iter().filter(move |(own, _)| only.is_none_or(|only| *own == only));
        let term = move |(symmetry, factor)| WedgeTerm { exponent: lambda, symmetry, factor };
        wanted.map(move |of| world(bent(kappa, &term(of), [n, series.terms()], bend), frame.axis))
    };
    (0..series.terms()).flat_map(modes).collect()
}

/// The fields of a tip of an anisotropic body, in the functions Re w₁, Im w₁, Re D and Im D of each
/// term: those of the first with z_kⁿ in the potentials, z₁ⁿ w₁ and their divided difference.
fn anisotropic(law: &TipLaw, only: Option<Symmetry>, terms: usize, axis: Vec2) -> Vec<TermFactors> {
    let [opening, sliding] = law.modes();
    let both = [(Symmetry::Symmetric, opening), (Symmetry::Antisymmetric, sliding)];
    let wanted = both.into_iter().filter(|(own, _)| only.is_none_or(|only| *own == only));
    let wanted: Vec<_> = wanted.map(|(_, mode)| mode).collect();
    let scale = 2.0 / law.compliance()[0];
    let field = |n: usize, mode: &[[Complex<f64>; 2]; 2]| {
        let factors = |[a, b]: [Complex<f64>; 2]| [a.0, -a.1, b.0, -b.1].map(|part| scale * part);
        world(mode.map(|own| placed(&factors(own), ANGULAR * n, ANGULAR * terms)), axis)
    };
    (0..terms).flat_map(|n| wanted.iter().map(move |mode| field(n, mode))).collect()
}

/// The field of a corner.
fn of_corner(at: Vec2, bisector: f64, term: &WedgeTerm, body: &Elasticity) -> TermFactors {
    let mode = mode(body.at(at).kolosov(), term).map(Vec::from);
    world(mode, vec2(bisector.cos(), bisector.sin()))
}

/// A term of N at a tip on an arc of the curvature q, in the frame of the tip: to z̄^(λ+m), m > 0,
/// comes λĀ (iq)^m − A (−λ over m) (−iq)^m, with A = 1 for opening and A = i for sliding.
fn bent(kappa: f64, term: &WedgeTerm, [n, terms]: [usize; 2], q: f64) -> TermFactors {
    let mut factors = mode(kappa, term).map(|own| placed(&own, ANGULAR * n, ANGULAR * terms));
    let lambda = term.exponent;
    let both = binomial_series(-1.0, -q).zip(binomial_series(-lambda, -q));
    for ((first, second), later) in both.zip(n..terms).skip(1) {
        let [re, im] = match term.symmetry {
            Symmetry::Symmetric => [0, 1].map(|k| lambda * first[k] - second[k]),
            Symmetry::Antisymmetric => {
                let [re, im] = [0, 1].map(|k| lambda * first[k] + second[k]);
                [im, -re]
            }
        };
        let at = ANGULAR * later;
        let [x, y] = &mut factors;
        (x[at], x[at + 1]) = (re, im);
        (y[at], y[at + 1]) = (im, -re);
    }
    factors
}

/// A term in the frame of the tip or corner.
fn mode(kappa: f64, term: &WedgeTerm) -> [[f64; ANGULAR]; 2] {
    let WedgeTerm { exponent: l, factor: b, symmetry } = *term;
    match symmetry {
        Symmetry::Symmetric => [[kappa - b, 0.0, -l, 0.0], [0.0, kappa + b, 0.0, l]],
        Symmetry::Antisymmetric => [[0.0, -(kappa + b), 0.0, l], [kappa - b, 0.0, l, 0.0]],
    }
}

/// A mode in the world's frame.
fn world([along, across]: TermFactors, axis: Vec2) -> TermFactors {
    let sum = |a: f64, b: f64| along.iter().zip(&across).map(|(x, y)| a * x + b * y).collect();
    [sum(axis.x, -axis.y), sum(axis.y, axis.x)]
}

/// A combination of functions from one on among all n.
fn placed(part: &[f64], first: usize, n: usize) -> Vec<f64> {
    let mut all = vec![0.0; n];
    all[first..first + part.len()].copy_from_slice(part);
    all
}

/// c, s, C and S of all terms as combinations of the tip's functions F₁…F₄ times monomials, in
/// units of the farthest distance in the patch: \[4N, 4 monomials(N − 1)\].
///
/// √r e^{iθ/2} = F₁ + iF₂ and √r e^{−3iθ/2} = (F₁ − 2F₃) + i(F₂ − 2F₄).
fn angular(space: &TrialSpace<'_>, patch: usize, tip: TipId, series: &SeriesFunctions) -> Mat<f64> {
    let step = space.step();
    let frame = PatchTipFrame::new(step, patch, tip);
    if let Some(roots) = frame.roots(space.equation()) {
        return divided(step, patch, &frame, roots, series);
    }
    let size = monomials(series.degree);
    let mut rows = Mat::zeros(ANGULAR * series.terms(), ANGULAR * size);
    for (n, power) in powers(step, patch, tip, series).iter().enumerate() {
        for (k, [a, b]) in power.iter().enumerate() {
            let of_term = [
                [*a, -b, 0.0, 0.0],
                [*b, *a, 0.0, 0.0],
                [*a, -b, -2.0 * a, 2.0 * b],
                [*b, *a, -2.0 * b, -2.0 * a],
            ];
            put(&mut rows, &of_term, [n, k]);
        }
    }
    rows
}

/// Puts the factors of the functions of term n at monomial k.
fn put(rows: &mut Mat<f64>, of_term: &[[f64; ANGULAR]; ANGULAR], [n, k]: [usize; 2]) {
    let size = rows.ncols() / ANGULAR;
    for (j, factors) in of_term.iter().enumerate() {
        for (f, factor) in factors.iter().enumerate() {
            rows[(ANGULAR * n + j, f * size + k)] = *factor;
        }
    }
}

/// z₁ⁿ w₁ and the divided difference of z_kⁿ w_k as combinations of the tip's functions w₁ and D
/// times monomials: D_n = A_n D + B_n w₁ with A_n = z₂ⁿ and B_{n+1} = z₂ B_n + y z₁ⁿ.
fn divided(
    step: &Step,
    patch: usize,
    frame: &PatchTipFrame,
    [s1, s2]: [Complex<f64>; 2],
    series: &SeriesFunctions,
) -> Mat<f64> {
    let size = monomials(series.degree);
    let mut rows = Mat::zeros(ANGULAR * series.terms(), ANGULAR * size);
    let linear = frame.linear(step, patch);
    let of_root = |s: Complex<f64>| linear.map(|[x, y]| [x + s.0 * y, s.1 * y]);
    let (z1, z2, y) = (of_root(s1), of_root(s2), linear.map(|[_, y]| [y, 0.0]));
    let times = |of: &ComplexPolynomial, by: &[[f64; 2]; 3]| product(of, by, series.degree);
    let mut one = vec![[0.0; 2]; size];
    let mut joint = one.clone();
    one[0] = [1.0, 0.0];
    let mut powers = [one.clone(), one];
    for n in 0..series.terms() {
        let [first, second] = &powers;
        for k in 0..size {
            let (w, d, [re, im]) = (first[k], second[k], joint[k]);
            let of_term = [
                [w[0], -w[1], 0.0, 0.0],
                [w[1], w[0], 0.0, 0.0],
                [re, -im, d[0], -d[1]],
                [im, re, d[1], d[0]],
            ];
            put(&mut rows, &of_term, [n, k]);
        }
        let added = times(first, &y);
        joint = times(&joint, &z2);
        joint.iter_mut().zip(added).for_each(|(sum, part)| {
            (sum[0], sum[1]) = (sum[0] + part[0], sum[1] + part[1]);
        });
        powers = [times(first, &z1), times(second, &z2)];
    }
    rows
}

/// The frame that a patch sees a tip in.
#[derive(Clone, Copy)]
pub(super) struct PatchTipFrame {
    pub(super) at: Vec2,
    /// Direction of growth.
    pub(super) axis: Vec2,
    /// One over the farthest distance in the patch, the unit of lengths.
    pub(super) unit: f64,
    /// The curvature of the crack at the tip, positive to the left.
    curvature: f64,
}

impl PatchTipFrame {
    pub(super) fn new(step: &Step, patch: usize, tip: TipId) -> Self {
        let crack = &step.cracks[tip.crack as usize];
        let at = crack.end_point(tip.end);
        let BoxPartition { origin, scale, .. } = step.partition.boxes();
        let unit = 1.0 / ((origin[patch] - at).length() + scale[patch].length());
        let curvature = crack.edge_to(tip.end).curvature();
        Self { at, axis: crack.growth_direction(tip.end), unit, curvature }
    }

    /// The roots s₁ and s₂ of an anisotropic body in this frame.
    pub(super) fn roots(&self, equation: &Equation) -> Option<[Complex<f64>; 2]> {
        Some(equation.anisotropy()?.at_tip(self.at, self.axis).roots)
    }

    /// x and y in this frame and its unit as c₀ + c₁ ξ + c₂ η.
    fn linear(&self, step: &Step, patch: usize) -> [[f64; 2]; 3] {
        let BoxPartition { origin, scale, .. } = step.partition.boxes();
        let (from_tip, scale) = (origin[patch] - self.at, scale[patch]);
        let turned = |v: Vec2| [self.axis.dot(v) * self.unit, self.axis.cross(v) * self.unit];
        [from_tip, Vec2 { x: scale.x, y: 0.0 }, Vec2 { x: 0.0, y: scale.y }].map(turned)
    }

    /// The curvature of the crack in the unit of lengths.
    fn scaled_curvature(&self) -> f64 {
        self.curvature / self.unit
    }
}

/// zⁿ for n up to N − 1, z being in the tip's frame and over the farthest distance in the patch.
fn powers(
    step: &Step,
    patch: usize,
    tip: TipId,
    series: &SeriesFunctions,
) -> Vec<ComplexPolynomial> {
    let linear = PatchTipFrame::new(step, patch, tip).linear(step, patch);
    let mut one = vec![[0.0; 2]; monomials(series.degree)];
    one[0] = [1.0, 0.0];
    let next = |last: &ComplexPolynomial| Some(product(last, &linear, series.degree));
    std::iter::successors(Some(one), next).take(series.terms()).collect()
}

/// A polynomial times the linear one c₀ + c₁ ξ + c₂ η, up to a degree.
fn product(
    polynomial: &ComplexPolynomial,
    linear: &[[f64; 2]; 3],
    degree: usize,
) -> ComplexPolynomial {
    let mut product = vec![[0.0; 2]; polynomial.len()];
    for ((a, b), [re, im]) in exponents(degree).zip(polynomial) {
        for ((da, db), c) in [(0, 0), (1, 0), (0, 1)].into_iter().zip(linear) {
            let (total, b) = ((a + da + b + db) as usize, (b + db) as usize);
            if total <= degree {
                let entry = &mut product[total * (total + 1) / 2 + b];
                entry[0] += re * c[0] - im * c[1];
                entry[1] += re * c[1] + im * c[0];
            }
        }
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    type Pair = [f64; 2];

    fn times([a, b]: Pair, [c, d]: Pair) -> Pair {
        [a * c - b * d, a * d + b * c]
    }

    fn conjugate([a, b]: Pair) -> Pair {
        [a, -b]
    }

    fn power([a, b]: Pair, exponent: f64) -> Pair {
        let (size, angle) = (a.hypot(b).powf(exponent), exponent * b.atan2(a));
        [size * angle.cos(), size * angle.sin()]
    }

    fn sum<const N: usize>(parts: [(f64, Pair); N]) -> Pair {
        [0, 1].map(|k| parts.iter().map(|(factor, part)| factor * part[k]).sum())
    }

    const TERMS: usize = 60;

    /// A combination of c, s, C and S of all terms at a point.
    fn value(factors: &[f64], z: Pair) -> f64 {
        let (r, theta) = (z[0].hypot(z[1]), z[1].atan2(z[0]));
        let of_term = |(n, own): (usize, &[f64])| {
            let (l, size) = (exponent(n), r.powf(exponent(n)));
            let [(s, c), (s2, c2)] = [l, l - 2.0].map(|order| (order * theta).sin_cos());
            size * (own[0] * c + own[1] * s + own[2] * c2 + own[3] * s2)
        };
        factors.chunks(ANGULAR).enumerate().map(of_term).sum()
    }

    const POINTS: [Pair; 4] = [[0.3, 0.2], [-0.35, 0.1], [0.1, -0.4], [-0.2, -0.3]];

    /// Compares a term with its potentials: 2μu = κφ − zφ̄′ − ψ̄.
    #[test]
    fn fields_on_arcs() {
        let kappa = 1.7;
        for q in [0.0, 0.8, -1.1] {
            for (symmetry, a, sign) in [
                (Symmetry::Symmetric, [1.0, 0.0], -1.0),
                (Symmetry::Antisymmetric, [0.0, 1.0], 1.0),
            ] {
                for n in [0, 1, 3] {
                    let l = exponent(n);
                    let term = WedgeTerm { exponent: l, symmetry, factor: 1.0 + sign * l };
                    let field = bent(kappa, &term, [n, TERMS], q);
                    for z in POINTS {
                        let w = [1.0 - q * z[1], q * z[0]];
                        let phi = times(a, power(z, l));
                        let slope = times(a, power(z, l - 1.0));
                        let bracket = sum([
                            (1.0, times(conjugate(a), power(w, -l))),
                            (-l, times(a, power(w, -1.0))),
                        ]);
                        let expected = sum([
                            (kappa, phi),
                            (-l, times(z, conjugate(slope))),
                            (-1.0, conjugate(times(power(z, l), bracket))),
                        ]);
                        for (own, expected) in field.iter().zip(expected) {
                            let found = value(own, z);
                            assert!(
                                (found - expected).abs() < 1e-13,
                                "{q} {n}: {found} {expected}"
                            );
                        }
                    }
                }
            }
        }
    }

    /// Im (z/(1 + iqz))^λ.
    #[test]
    fn potentials_on_arcs() {
        for q in [0.0, 0.7, -0.9] {
            let rows = potentials(TERMS, q);
            for (n, z) in [0, 1, 4].into_iter().flat_map(|n| POINTS.map(|z| (n, z))) {
                let w = times(z, power([1.0 - q * z[1], q * z[0]], -1.0));
                let row: Vec<f64> = rows.row(n).iter().copied().collect();
                let (found, expected) = (value(&row, z), power(w, exponent(n))[1]);
                assert!((found - expected).abs() < 1e-13, "{q} {n}: {found} {expected}");
            }
        }
    }
}
