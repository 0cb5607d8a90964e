//! Pressure that oscillates from cell to cell, in a body that hardly changes its volume.
//!
//! Polynomials of order p that are free of locking have right displacements, energies and factors,
//! but λ div u multiplies what is left of div u by λ. A pressure that is right is smooth: over
//! three cells in each direction it is, as well as the displacements are, a polynomial of degree p
//! − 1. The part of the computed pressure that exceeds this degree follows from its expansion in
//! Chebyshev polynomials,
//!
//! ```text
//! p = Σ c_rs T_r T_s,   tail² = Σ_(r + s ≥ p) c_rs²,   error ≈ median of tail / root mean square of the stresses
//! ```
//!
//! Cell by cell the tail is 0.8 to 1.3 times the error away from singular points, where the
//! pressure is no polynomial; so the median by area is reported.

use super::{above, short};
use ppum::crack::Side;
use ppum::dataset::{Warning, WarningKind};
use ppum::field::{Field, LocalField};
use ppum::jet::Jet;
use ppum::vec2::{Vec2, vec2};
use ppum_problem::{STIFF, stiffness_ratio};
use ppum_solve::law::{Law, LawAt};
use rayon::prelude::*;
use std::array::from_fn;
use std::f64::consts::PI;

/// Error of the pressure, in parts of the stresses, from which on it is told.
const LARGE: f64 = 2e-3;

/// Points in each direction of three cells.
const N: usize = 9;

/// Cells that are looked at, evenly among all.
const CELLS: usize = 256;

/// Pressure around a cell: the cell's area, mean squares of the tail and of the stresses.
#[derive(Clone, Copy)]
struct Oscillation {
    area: f64,
    tail: f64,
    stress: f64,
}

/// The warning about pressure that oscillates.
pub(super) fn of_pressure(field: &Field<'_>, law: &Law<'_>) -> Option<Warning> {
    if stiffness_ratio(field.equation, field.domain) <= STIFF {
        return None;
    }
    let n_cells = field.step.partition.len();
    let cells: Vec<usize> = (0..n_cells).step_by(n_cells.div_ceil(CELLS).max(1)).collect();
    let of_cell = |&cell: &usize| oscillation(field, law, cell);
    let all: Vec<Oscillation> = cells.par_iter().filter_map(of_cell).collect();
    let part = (typical_tail(&all)? / mean_stress(&all)).sqrt();
    let message = format!(
        "the plate is nearly incompressible, and its pressure oscillates from cell to cell: stresses are off by about {} % \
         in most places, far more than displacements, energy and factors; use a higher `order`, or smaller cells",
        short((1e4 * part).round() / 1e2)
    );
    above(WarningKind::Pressure, None, [part, LARGE], message)
}

/// The median by area of the squares of tails.
fn typical_tail(all: &[Oscillation]) -> Option<f64> {
    let mut sorted = all.to_vec();
    sorted.sort_by(|a, b| a.tail.total_cmp(&b.tail));
    let mut rest = 0.5 * all.iter().map(|f| f.area).sum::<f64>();
    let is_middle = |f: &&Oscillation| {
        rest -= f.area;
        rest <= 0.0
    };
    sorted.iter().find(is_middle).map(|f| f.tail)
}

fn mean_stress(all: &[Oscillation]) -> f64 {
    let area: f64 = all.iter().map(|f| f.area).sum();
    all.iter().map(|f| f.area * f.stress).sum::<f64>() / area
}

/// The pressure in a cell and around it up to the distance of its size; `None` if that does not lie
/// in the body, or the volume may change there.
fn oscillation(field: &Field<'_>, law: &Law<'_>, cell: usize) -> Option<Oscillation> {
    let (rect, data) = (field.step.partition.boxes().cell[cell], &field.step.fields[0]);
    let order =
        data.blocks(cell).map(|block| data.block_degree[block]).max().map_or(0, usize::from);
    let (half, middle) = (rect.size() * 1.5, rect.center());
    let moduli = field.equation.moduli(middle, [0.0; 2]);
    if moduli.lambda <= STIFF * moduli.mu {
        return None;
    }
    let (mut local, mut values) = (field.at(middle), [[(0.0, 0.0); N]; N]);
    for (i, row) in values.iter_mut().enumerate() {
        for (j, value) in row.iter_mut().enumerate() {
            let offset = vec2(half.x * node(i), half.y * node(j));
            *value = stresses(&mut local, offset, &law.at(middle + offset))?;
        }
    }
    let stress = values.as_flattened().iter().map(|v| v.1).sum::<f64>() / (N * N) as f64;
    let tail = tail(&values.map(|row| row.map(|v| v.0)), order);
    Some(Oscillation { area: rect.size().x * rect.size().y, tail, stress })
}

/// λ tr(ε − ε⁰) and σ:σ in the plane at a point; `None` outside the body, and where they are
/// infinite.
fn stresses(local: &mut LocalField<'_>, offset: Vec2, law: &LawAt) -> Option<(f64, f64)> {
    let mut u = [Jet::constant(0.0); 2];
    let is_inside = local.evaluate::<1>(offset, Side::Above, &mut u);
    let strain = law.strain(&u);
    let pressure = law.lambda() * law.elastic(&strain).trace();
    let square: f64 = law.stress(&strain).0.as_flattened().iter().map(|s| s * s).sum();
    (is_inside && square.is_finite()).then_some((pressure, square))
}

/// Mean square of what values at the nodes have beyond polynomials of a total degree below `order`.
fn tail(values: &[[f64; N]; N], order: usize) -> f64 {
    // T_r at the nodes, of which sums of products are orthonormal
    let t: [[f64; N]; N] = from_fn(|r| {
        let scale = (if r == 0 { 1.0 } else { 2.0 } / N as f64).sqrt();
        from_fn(|i| scale * (r as f64 * angle(i)).cos())
    });
    let rows: [[f64; N]; N] =
        from_fn(|r| from_fn(|j| (0..N).map(|i| t[r][i] * values[i][j]).sum()));
    let coefficient = |r: usize, s: usize| -> f64 { (0..N).map(|j| t[s][j] * rows[r][j]).sum() };
    let beyond = (0..N).flat_map(|r| (order.saturating_sub(r)..N).map(move |s| (r, s)));
    beyond.map(|(r, s)| coefficient(r, s).powi(2)).sum::<f64>() / (N * N) as f64
}

fn angle(k: usize) -> f64 {
    PI * (k as f64 + 0.5) / N as f64
}

/// Zeros of T_N.
fn node(k: usize) -> f64 {
    angle(k).cos()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tail of a polynomial of degree three in x plus one of degree five in y, of which the
    /// part T_4 + T_5 is left.
    #[test]
    fn tails_are_what_polynomials_leave() {
        let t = |n: f64, k: usize| (n * angle(k)).cos();
        let values: [[f64; N]; N] =
            from_fn(|i| from_fn(|j| 2.0 + t(3.0, i) + t(1.0, i) * t(3.0, j) + 3.0 * t(5.0, j)));
        // mean squares of T_1 T_3 and of T_5 are a quarter and a half
        for (order, expected) in [(6, 0.0), (5, 4.5), (4, 4.75), (3, 5.25)] {
            let found = tail(&values, order);
            assert!((found - expected).abs() < 1e-13, "order {order}: {found}");
        }
    }
}
