//! Williams' series at a tip: displacement fields that satisfy equilibrium and leave the faces of a straight crack free.
//!
//! ```text
//! λ = n + ½      c, s = r^λ cos λθ, r^λ sin λθ      C, S = r^λ cos (λ−2)θ, r^λ sin (λ−2)θ
//! I     2μ u_x = (κ − 1 + λ) c − λ C      2μ u_y = (κ + 1 − λ) s + λ S
//! II    2μ u_x = −(κ + 1 + λ) s + λ S     2μ u_y = (κ − 1 − λ) c + λ C
//! ```
//!
//! in the tip's frame (Williams 1957; from Kolosov's potentials φ = A z^λ, ψ = (Ā − λA) z^λ with A = 1 and A = i). One
//! unknown each: they *tie* the components of the functions c, s, C and S. Of Poisson's equation s alone leaves the faces free.

use super::confined::Part;
use crate::space::{Series, Space};
use faer::Mat;
use ppum::dataset::{Equation, Material, Step, monomials};
use ppum::polynomial::exponents;
use ppum::vec2::Vec2;

/// A polynomial in ξ and η with values in the complex plane, in the order of the dataset.
type Polynomial = Vec<[f64; 2]>;

/// Numbers of the functions c, s, C and S of a term.
const ANGULAR: usize = 4;

/// The combinations that the functions of a patch's tips are taken in.
pub(super) fn parts(space: &Space<'_>, patch: usize) -> Vec<Part> {
    let is_scalar = space.equation().components() == 1;
    let part = |series: &Series| {
        let all = angular(space.step(), patch, series);
        let rows = if is_scalar { every_second_of_four(&all) } else { all };
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
        let rows = angular(space.step(), patch, series);
        let tip = &space.step().cracks[series.tip.crack as usize];
        let axis = tip.growth_direction(series.tip.end);
        let material = body.at(tip.end_point(series.tip.end));
        let first = series.functions.start;
        let term = |n: usize| modes(&material, n).map(|mode| world(&mode, &rows, n, axis));
        let terms: Vec<_> = (0..series.terms()).flat_map(term).collect();
        terms.into_iter().map(move |field| field.map(|part| shifted(&part, first, n)))
    };
    Some(all.iter().flat_map(of_series).collect())
}

/// Factors of c, s, C and S in the two components of both modes of a term.
fn modes(material: &Material, n: usize) -> [[[f64; ANGULAR]; 2]; 2] {
    let (kappa, lambda) = (material.kolosov(), n as f64 + 0.5);
    let opening =
        [[kappa - 1.0 + lambda, 0.0, -lambda, 0.0], [0.0, kappa + 1.0 - lambda, 0.0, lambda]];
    let sliding =
        [[0.0, -(kappa + 1.0 + lambda), 0.0, lambda], [kappa - 1.0 - lambda, 0.0, lambda, 0.0]];
    [opening, sliding]
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
fn angular(step: &Step, patch: usize, series: &Series) -> Mat<f64> {
    let size = monomials(series.degree);
    let mut rows = Mat::zeros(ANGULAR * series.terms(), ANGULAR * size);
    for (n, power) in powers(step, patch, series).iter().enumerate() {
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
fn powers(step: &Step, patch: usize, series: &Series) -> Vec<Polynomial> {
    let crack = &step.cracks[series.tip.crack as usize];
    let (origin, scale) = (step.partition.origin[patch], step.partition.scale[patch]);
    let (from_tip, axis) =
        (origin - crack.end_point(series.tip.end), crack.growth_direction(series.tip.end));
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
