//! Williams' series at tips and corners: displacement fields that satisfy equilibrium and leave the
//! faces of a straight crack, or the sides of a wedge, free.
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

use super::transform::FunctionCombinations;
use crate::corner::WedgeTerm;
use crate::space::{ANGULAR, Origin, SeriesFunctions, TrialSpace};
use faer::Mat;
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
            // s alone
            Origin::Tip(..) if is_scalar => {
                Mat::from_fn(n / ANGULAR, n, |term, k| f64::from(k == ANGULAR * term + 1))
            }
            _ => Mat::identity(n, n),
        };
        (functions, rows)
    };
    space.evaluated_series(patch).map(part).collect()
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
        out.extend(times(angular(space.step(), patch, tip, series).as_ref(), own));
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
            Origin::Tip(tip, symmetry) => of_tip(space.step(), (tip, symmetry), series, body),
            Origin::Corner { at, bisector, term } => vec![of_corner(at, bisector, &term, body)],
        };
        let modes = fields.len() * ANGULAR / functions.len();
        let place = move |(k, field): (usize, TermFactors)| {
            field.map(|part| placed(&part, functions.start + ANGULAR * (k / modes), n))
        };
        fields.into_iter().enumerate().map(place)
    };
    Some(space.evaluated_series(patch).flat_map(of_series).collect())
}

/// Factors of c, s, C and S of a term in the two components of a field.
type TermFactors = [[f64; ANGULAR]; 2];

/// The fields of a tip, of each term for opening and for sliding, or of one symmetry alone.
fn of_tip(
    step: &Step,
    (tip, only): (TipId, Option<Symmetry>),
    series: &SeriesFunctions,
    body: &Elasticity,
) -> Vec<TermFactors> {
    let crack = &step.cracks[tip.crack as usize];
    let axis = crack.growth_direction(tip.end);
    let kappa = body.at(crack.end_point(tip.end)).kolosov();
    let modes = |n: usize| {
        let lambda = n as f64 + 0.5;
        let both = [(Symmetry::Symmetric, 1.0 - lambda), (Symmetry::Antisymmetric, 1.0 + lambda)];
        let wanted = both.into_iter().filter(move |(own, _)| only.is_none_or(|only| *own == only));
        let term = move |(symmetry, factor)| WedgeTerm { exponent: lambda, symmetry, factor };
        wanted.map(move |of| world(&mode(kappa, &term(of)), axis))
    };
    (0..series.terms()).flat_map(modes).collect()
}

/// The field of a corner.
fn of_corner(at: Vec2, bisector: f64, term: &WedgeTerm, body: &Elasticity) -> TermFactors {
    world(&mode(body.at(at).kolosov(), term), vec2(bisector.cos(), bisector.sin()))
}

/// A term in the frame of the tip or corner.
fn mode(kappa: f64, term: &WedgeTerm) -> TermFactors {
    let WedgeTerm { exponent: l, factor: b, symmetry } = *term;
    match symmetry {
        Symmetry::Symmetric => [[kappa - b, 0.0, -l, 0.0], [0.0, kappa + b, 0.0, l]],
        Symmetry::Antisymmetric => [[0.0, -(kappa + b), 0.0, l], [kappa - b, 0.0, l, 0.0]],
    }
}

/// A mode in the world's frame.
fn world([along, across]: &TermFactors, axis: Vec2) -> TermFactors {
    let sum = |a: f64, b: f64| std::array::from_fn(|j| a * along[j] + b * across[j]);
    [sum(axis.x, -axis.y), sum(axis.y, axis.x)]
}

/// A combination of four functions from one on among all n.
fn placed(part: &[f64], first: usize, n: usize) -> Vec<f64> {
    let mut all = vec![0.0; n];
    all[first..first + part.len()].copy_from_slice(part);
    all
}

/// c, s, C and S of all terms as combinations of the tip's functions F₁…F₄ times monomials, in
/// units of the farthest distance in the patch: \[4N, 4 monomials(N − 1)\].
///
/// √r e^{iθ/2} = F₁ + iF₂ and √r e^{−3iθ/2} = (F₁ − 2F₃) + i(F₂ − 2F₄).
fn angular(step: &Step, patch: usize, tip: TipId, series: &SeriesFunctions) -> Mat<f64> {
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
            for (j, factors) in of_term.iter().enumerate() {
                for (f, factor) in factors.iter().enumerate() {
                    rows[(ANGULAR * n + j, f * size + k)] = *factor;
                }
            }
        }
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
}

impl PatchTipFrame {
    pub(super) fn new(step: &Step, patch: usize, tip: TipId) -> Self {
        let crack = &step.cracks[tip.crack as usize];
        let at = crack.end_point(tip.end);
        let BoxPartition { origin, scale, .. } = step.partition.boxes();
        let unit = 1.0 / ((origin[patch] - at).length() + scale[patch].length());
        Self { at, axis: crack.growth_direction(tip.end), unit }
    }
}

/// zⁿ for n up to N − 1, z being in the tip's frame and over the farthest distance in the patch.
fn powers(
    step: &Step,
    patch: usize,
    tip: TipId,
    series: &SeriesFunctions,
) -> Vec<ComplexPolynomial> {
    let (origin, scale) =
        (step.partition.boxes().origin[patch], step.partition.boxes().scale[patch]);
    let PatchTipFrame { at, axis, unit } = PatchTipFrame::new(step, patch, tip);
    let from_tip = origin - at;
    let turned = |v: Vec2| [axis.dot(v) * unit, axis.cross(v) * unit];
    let linear = [from_tip, Vec2 { x: scale.x, y: 0.0 }, Vec2 { x: 0.0, y: scale.y }].map(turned);
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
