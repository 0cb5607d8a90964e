//! Quantities that have one value all over the body, except for rounding.
//!
//! σ_xx of a bar in tension is zero, and what a file holds of it is what its digits leave: drawn
//! over the whole colour map it looks like a field. A quantity q of the values u and gradients ∇u
//! has parts (∂q/∂u) |u| and (∂q/∂∇u) |∇u|, with the mean sizes of u and ∇u in the body; they
//! cancel down to [`BORNE`] times the relative rounding error that the solver tells of its
//! stresses. Smaller differences do not count.
//!
//! The gradient of a body that only moves is rounding itself: of terms of the size |u|/L, with the
//! size L of the body. With these in place of |∇u| the parts cancel to [`BORNE`] times the rounding
//! of their evaluation.

use std::ops::Range;

use ppum::crack::Side;
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::quantity::{Quantity, Sample, Source};
use ppum::vec2::{Vec2, vec2};

/// Cells that are looked at, at most, and places in each, from its centre in parts of its size.
const CELLS: usize = 64;
const PLACES: [Vec2; 3] = [vec2(0.05, -0.02), vec2(-0.37, 0.29), vec2(0.31, 0.41)];

/// Error of the solution of the linear system, in units of the rounding of its evaluation: a
/// condition of fine covers of high order. Measured on a body in tension: 4·10³ at level 4 and
/// order 2, 10⁵ at level 6 and order 3.
const BORNE: f64 = 1e6;

/// Rounding of evaluation where the file does not tell it: eight roundings of a term.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Step of differences, in parts of what they are differences by: small beside it, and large
/// beside rounding.
const STEP: f64 = 1e-6;

/// Part of its parts by which a quantity may differ somewhere that has one value elsewhere.
const PART: f64 = 1e-3;

/// The one value of a quantity, zero if it is that except for rounding, and by how much it may
/// differ from it somewhere; none of a quantity that varies, or does not depend on the field, and
/// of those of the partition or of errors, which are looked at for their last digits.
pub(super) fn value(field: &Field<'_>, quantity: &Quantity) -> Option<[f64; 2]> {
    if !matches!(quantity.source(), Source::Values | Source::Gradient) {
        return None;
    }
    let found = samples(field);
    let (sizes, moved) = (sizes(field, &found), motions(field, &found));
    let known = field.step.history.iter().find(|record| record.name == "rounding");
    let rounding = known.map_or(ROUNDING, |record| record.value.max(ROUNDING));
    let (mut low, mut high, mut parts) = (f64::INFINITY, f64::NEG_INFINITY, [0.0_f64; 2]);
    for (at, u) in &found {
        let value = of_jets(field, quantity, *at, u);
        (low, high) = (low.min(value), high.max(value));
        let here = [&sizes, &moved].map(|sizes| size_of_parts(field, quantity, *at, u, sizes));
        parts = [parts[0].max(here[0]), parts[1].max(here[1])];
        // infinite and NaN differ too
        let is_even = high - low <= BORNE * (rounding * parts[0]).max(ROUNDING * parts[1]);
        if !is_even {
            return None;
        }
    }
    let (value, motion) = (0.5 * (low + high), BORNE * ROUNDING * parts[1]);
    let is_zero = value.abs() <= motion.max(BORNE * rounding * parts[0]);
    let value = if is_zero { 0.0 } else { value };
    (value.is_finite() && parts[0].max(parts[1]) > 0.0)
        .then(|| [value, motion.max(PART * parts[0])])
}

/// The field at places all over the body.
fn samples(field: &Field<'_>) -> Vec<(Vec2, Vec<Jet<f64>>)> {
    let cells = field.step.partition.cells();
    let mut found = Vec::new();
    for cell in cells.iter().step_by(cells.len().div_ceil(CELLS).max(1)) {
        let (mut local, size) = (field.at(cell.center()), cell.size());
        for place in PLACES {
            let (offset, mut u) = (vec2(place.x * size.x, place.y * size.y), Vec::new());
            u.resize(field.components(), Jet::constant(0.0));
            if local.evaluate::<1>(offset, Side::Above, &mut u) {
                found.push((cell.center() + offset, u));
            }
        }
    }
    found
}

/// The mean sizes of u and ∇u, of all components together.
fn sizes(field: &Field<'_>, samples: &[(Vec2, Vec<Jet<f64>>)]) -> Vec<[f64; 2]> {
    let all = 0..field.components();
    let sizes = [mean(samples, &all, |u| u.v * u.v), mean(samples, &all, gradient)];
    all.map(|_| sizes).collect()
}

/// The mean size of u, and that over the size of the body: of both components of a displacement
/// together, and of each other component.
fn motions(field: &Field<'_>, samples: &[(Vec2, Vec<Jet<f64>>)]) -> Vec<[f64; 2]> {
    let (bounds, vector) =
        (field.domain.bounds.size(), if field.is_displacement() { 2 } else { 0 });
    let of_component = |c: usize| {
        let together = if c < vector { 0..vector } else { c..c + 1 };
        let value = mean(samples, &together, |u| u.v * u.v);
        [value, value / bounds.x.max(bounds.y)]
    };
    (0..field.components()).map(of_component).collect()
}

fn gradient(u: &Jet<f64>) -> f64 {
    u.x * u.x + u.y * u.y
}

/// The mean root of the sum of some squares over components.
fn mean(
    samples: &[(Vec2, Vec<Jet<f64>>)],
    components: &Range<usize>,
    square: fn(&Jet<f64>) -> f64,
) -> f64 {
    let size = |(_, u): &(Vec2, Vec<Jet<f64>>)| {
        u[components.clone()].iter().map(square).sum::<f64>().sqrt()
    };
    samples.iter().map(size).sum::<f64>() / samples.len() as f64
}

/// Σ |∂q/∂u_c| |u| + Σ |∂q/∂(∇u_c)| |∇u|, with some sizes of u and ∇u, by differences.
fn size_of_parts(
    field: &Field<'_>,
    quantity: &Quantity,
    at: Vec2,
    u: &[Jet<f64>],
    sizes: &[[f64; 2]],
) -> f64 {
    let (value, mut moved) = (of_jets(field, quantity, at, u), u.to_vec());
    let mut all = 0.0;
    for (c, &[values, gradients]) in sizes.iter().enumerate() {
        for (k, size) in [values, gradients, gradients].into_iter().enumerate() {
            let by = STEP * size;
            let Jet { v, x, y, .. } = &mut moved[c];
            *[v, x, y][k] += by;
            all += (of_jets(field, quantity, at, &moved) - value).abs() / STEP;
            moved[c] = u[c];
        }
    }
    all
}

fn of_jets(field: &Field<'_>, quantity: &Quantity, at: Vec2, jets: &[Jet<f64>]) -> f64 {
    let offset = [0.0; 2];
    let moduli = field.equation.moduli(at, offset);
    quantity.of_field(&Sample { anchor: at, offset, moduli, jets, exact: &[] })
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;
    use ppum_testkit::synthetic::{Coefficients, Recipe};

    /// Random homogeneous strains with noise of a part of 1e-13 in their coefficients: what is
    /// constant or zero is, and what varies by 1e-6 of its parts does.
    #[test]
    fn noise_is_no_field() {
        let mut random = Random(4);
        for seed in 0..20 {
            let (sxx, vary) = (random.between(1e-6, 1.0), seed % 2 == 1);
            // E = 1, ν = 0.3, plane strain: u such that σ_yy and σ_xy are zero
            let along = |a: f64, b: f64, c: f64| vec![0.0, a, b, c, 0.0, 0.0];
            let mut noise = || sxx * random.between(-1e-13, 1e-13);
            let bend = if vary { 1e-6 * sxx } else { 0.0 };
            let ux = along(sxx * 0.91 + noise(), noise(), noise() + bend);
            let uy = along(noise(), -sxx * 0.39 + noise(), noise());
            let coefficients = Coefficients::Polynomial(vec![ux, uy]);
            let recipe = Recipe {
                cracks: vec![],
                degrees: vec![2],
                coefficients,
                seed,
                ..Recipe::default()
            };
            let dataset = recipe.dataset();
            let field = Field::new(&dataset, 0).unwrap();
            let of = |text: &str| {
                let found = value(&field, &Quantity::parse(text, &field).unwrap());
                found.map(|[value, _]| value)
            };
            assert_eq!(of("exy"), Some(0.0), "{seed}");
            assert_eq!(of("dux_dx").is_some(), !vary, "{seed}");
            assert_eq!(of("ux"), None, "{seed}");
            if let Some(found) = of("dux_dx - duy_dy") {
                assert!((found / (1.3 * sxx) - 1.0).abs() < 1e-12);
            }
        }
    }
}
