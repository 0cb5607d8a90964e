//! Williams' series at tips and corners: displacement fields that satisfy equilibrium and leave the faces of a straight crack,
//! or the sides of a wedge, free.
//!
//! ```text
//! c, s = r^λ cos λθ, r^λ sin λθ      C, S = r^λ cos (λ−2)θ, r^λ sin (λ−2)θ
//! I     2μ u_x = (κ − b) c − λ C      2μ u_y = (κ + b) s + λ S
//! II    2μ u_x = −(κ + b) s + λ S     2μ u_y = (κ − b) c + λ C
//! ```
//!
//! in the frame of the tip or of the wedge's bisector, from Kolosov's potentials φ = z^λ, ψ = b z^λ and φ = i z^λ, ψ = −i b z^λ. At a
//! tip λ = n + ½ with b = 1 − λ and 1 + λ (Williams 1957), of a wedge they are [`Term`]s (Williams 1952). One unknown each: they *tie*
//! the components of the functions c, s, C and S. Of Poisson's equation s alone leaves the faces of a crack free.

use super::confined::Part;
use crate::corner::{Symmetry, Term};
use crate::space::{Origin, Series, Space};
use faer::Mat;
use ppum::crack::TipId;
use ppum::dataset::{Elasticity, Equation, Step, monomials};
use ppum::polynomial::exponents;
use ppum::vec2::{Vec2, vec2};

/// A polynomial in ξ and η with values in the complex plane, in the order of the dataset.
type Polynomial = Vec<[f64; 2]>;

/// Numbers of the functions c, s, C and S of a term.
const ANGULAR: usize = 4;

/// The combinations that the functions of a patch's tips are taken in.
pub(super) fn parts(space: &Space<'_>, patch: usize) -> Vec<Part> {
    let is_scalar = space.equation().components() == 1;
    let part = |series: &Series| {
        let rows = match series.origin {
            Origin::Corner { .. } => Mat::identity(series.functions.len(), series.functions.len()),
            Origin::Tip(tip) if is_scalar => {
                every_second_of_four(&angular(space.step(), patch, tip, series))
            }
            Origin::Tip(tip) => angular(space.step(), patch, tip, series),
        };
        (series.functions.clone(), rows)
    };
    space.series(patch).iter().map(part).collect()
}

/// The rows of s.
fn every_second_of_four(all: &Mat<f64>) -> Mat<f64> {
    Mat::from_fn(all.nrows() / ANGULAR, all.ncols(), |n, k| all[(ANGULAR * n + 1, k)])
}

/// The fields of the series of a patch as combinations of its functions, one for each component; none without series, or
/// with one component.
pub(super) fn fields(space: &Space<'_>, patch: usize) -> Option<Vec<[Vec<f64>; 2]>> {
    let Equation::Elasticity(body) = space.equation() else { return None };
    let all = space.series(patch);
    if all.is_empty() {
        return None;
    }
    let n = space.sizes[patch];
    let of_series = |series: &Series| {
        let fields = match series.origin {
            Origin::Tip(tip) => of_tip(space.step(), patch, tip, series, body),
            Origin::Corner { at, bisector, term } => vec![of_corner(at, bisector, &term, body)],
        };
        let first = series.functions.start;
        fields.into_iter().map(move |field| field.map(|part| shifted(&part, first, n)))
    };
    Some(all.iter().flat_map(of_series).collect())
}

/// The fields of a tip, for opening and for sliding.
fn of_tip(
    step: &Step,
    patch: usize,
    tip: TipId,
    series: &Series,
    body: &Elasticity,
) -> Vec<[Vec<f64>; 2]> {
    let rows = angular(step, patch, tip, series);
    let crack = &step.cracks[tip.crack as usize];
    let axis = crack.growth_direction(tip.end);
    let kappa = body.at(crack.end_point(tip.end)).kolosov();
    let modes = |n: usize| {
        let lambda = n as f64 + 0.5;
        let term = |symmetry, factor| mode(kappa, &Term { exponent: lambda, symmetry, factor });
        let (opening, sliding) = (Symmetry::Symmetric, Symmetry::Antisymmetric);
        [term(opening, 1.0 - lambda), term(sliding, 1.0 + lambda)]
            .map(|mode| world(&mode, &rows, n, axis))
    };
    (0..series.terms()).flat_map(modes).collect()
}

/// The field of a corner.
fn of_corner(at: Vec2, bisector: f64, term: &Term, body: &Elasticity) -> [Vec<f64>; 2] {
    let axis = vec2(bisector.cos(), bisector.sin());
    world(&mode(body.at(at).kolosov(), term), &Mat::identity(ANGULAR, ANGULAR), 0, axis)
}

/// Factors of c, s, C and S in the two components of a field.
fn mode(kappa: f64, term: &Term) -> [[f64; ANGULAR]; 2] {
    let Term { exponent: l, factor: b, symmetry } = *term;
    match symmetry {
        Symmetry::Symmetric => [[kappa - b, 0.0, -l, 0.0], [0.0, kappa + b, 0.0, l]],
        Symmetry::Antisymmetric => [[0.0, -(kappa + b), 0.0, l], [kappa - b, 0.0, l, 0.0]],
    }
}

/// A mode in the world's frame, as combinations of a tip's functions.
fn world(mode: &[[f64; ANGULAR]; 2], rows: &Mat<f64>, n: usize, axis: Vec2) -> [Vec<f64>; 2] {
    let along = |i: usize, k: usize| -> f64 {
        (0..ANGULAR).map(|j| mode[i][j] * rows[(ANGULAR * n + j, k)]).sum()
    };
    let all = 0..rows.ncols();
    let x = all.clone().map(|k| axis.x * along(0, k) - axis.y * along(1, k)).collect();
    let y = all.map(|k| axis.y * along(0, k) + axis.x * along(1, k)).collect();
    [x, y]
}

/// Combinations of some functions of a patch among those of all n.
fn shifted(part: &[f64], first: usize, n: usize) -> Vec<f64> {
    let mut all = vec![0.0; n];
    all[first..first + part.len()].copy_from_slice(part);
    all
}

/// c, s, C and S of all terms as combinations of the tip's functions F₁…F₄ times monomials, in units of the farthest distance
/// in the patch: \[4N, 4 monomials(N − 1)\].
///
/// √r e^{iθ/2} = F₁ + iF₂ and √r e^{−3iθ/2} = (F₁ − 2F₃) + i(F₂ − 2F₄).
fn angular(step: &Step, patch: usize, tip: TipId, series: &Series) -> Mat<f64> {
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

/// zⁿ for n up to N − 1, z being in the tip's frame and over the farthest distance in the patch.
fn powers(step: &Step, patch: usize, tip: TipId, series: &Series) -> Vec<Polynomial> {
    let crack = &step.cracks[tip.crack as usize];
    let (origin, scale) = (step.partition.origin[patch], step.partition.scale[patch]);
    let (from_tip, axis) = (origin - crack.end_point(tip.end), crack.growth_direction(tip.end));
    let unit = 1.0 / (from_tip.length() + scale.length());
    let turned = |v: Vec2| [axis.dot(v) * unit, axis.cross(v) * unit];
    let linear = [from_tip, Vec2 { x: scale.x, y: 0.0 }, Vec2 { x: 0.0, y: scale.y }].map(turned);
    let mut one = vec![[0.0; 2]; monomials(series.degree)];
    one[0] = [1.0, 0.0];
    let next = |last: &Polynomial| Some(times(last, &linear, series.degree));
    std::iter::successors(Some(one), next).take(series.terms()).collect()
}

/// A polynomial times the linear one c₀ + c₁ ξ + c₂ η, up to a degree.
fn times(polynomial: &Polynomial, linear: &[[f64; 2]; 3], degree: usize) -> Polynomial {
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
