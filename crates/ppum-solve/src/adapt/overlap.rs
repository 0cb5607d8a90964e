//! The disagreement of the local fields where patches overlap.
//!
//! ```text
//! η_j² = ∫_{C_j} Σ_i s_i φ_i |ε(u_i) − ε(u)|²_C        u = Σ_i φ_i u_i        s_i = min(1, 2/p_i)²
//! ```
//!
//! Neighbours approximate one smooth field with polynomials of their own; what each of them misses is other than
//! what the next one misses. Where a patch is alone the integrand vanishes: its error is seen at the rim of its flat top.

use crate::law::{Law, LawAt};
use crate::quadrature::Rule;
use crate::space::Space;
use crate::watched::{Halt, Stage, in_batches};
use ppum::crack::Side;
use ppum::field::{Field, Part};
use ppum::jet::Jet;
use ppum::vec2::{Vec2, vec2};

/// The squares η_j² of all cells. Advances the stage by their number.
///
/// # Errors
/// Cancelled.
pub(super) fn disagreement(
    field: &Field<'_>,
    space: &Space<'_>,
    stage: &Stage<'_>,
) -> Result<Vec<f64>, Halt> {
    let (law, quadrature) = (Law::new(field.equation), space.quadrature(0));
    let n = space.partition().len();
    let mut squares = Vec::with_capacity(n);
    let work = |parts: &mut Vec<Part>, cell: usize| {
        let rules = space.rules(&quadrature, cell);
        let shared = rules.iter().filter(|rule| rule.patches.len() > 1);
        Ok(shared.map(|rule| of_rule(field, space, &law, rule, parts)).sum())
    };
    in_batches(stage, n, Vec::new, work, |_, square: f64| squares.push(square))?;
    Ok(squares)
}

/// Part of the disagreement that is the error: of smooth fields of the orders 1 to 8 the disagreement was 1.1, 1.4, 2.0,
/// 2.9, 3.0, 4.2, 5.5 and 6.2 times the error, as polynomials of higher order differ more outside their flat tops than they
/// err inside.
fn share_of_error(order: usize) -> f64 {
    (2.0 / order.max(1) as f64).min(1.0)
}

fn of_rule(
    field: &Field<'_>,
    space: &Space<'_>,
    law: &Law<'_>,
    rule: &Rule,
    parts: &mut Vec<Part>,
) -> f64 {
    let local = field.at(rule.anchor);
    let shares: Vec<f64> =
        rule.patches.iter().map(|&i| share_of_error(space.order(i as usize)).powi(2)).collect();
    let points = rule.offsets.iter().zip(&rule.weights);
    let at_point = |(&offset, &weight): (&Vec2, &f64)| {
        local.parts::<1>(offset, Side::Above, &rule.patches, parts);
        weight * density(&law.at(rule.anchor + offset), parts, &shares)
    };
    points.map(at_point).sum()
}

/// Σ_i s_i φ_i |ε(u_i) − ε(u)|²_C at a point.
fn density(law: &LawAt, parts: &[Part], shares: &[f64]) -> f64 {
    let zero = [Jet::constant(0.0); 2];
    let sum = parts.iter().fold(zero, |sum, part| {
        [0, 1].map(|k| sum[k].plus::<1>(part.share.times::<1>(part.local[k])))
    });
    let of_part = |(part, share): (&Part, &f64)| {
        let difference = [0, 1].map(|k| gradient(part.local[k]) - gradient(sum[k]));
        share * part.share.v * energy_density(law, &difference)
    };
    parts.iter().zip(shares).map(of_part).sum()
}

fn gradient(jet: Jet<f64>) -> Vec2 {
    vec2(jet.x, jet.y)
}

/// σ(g):g of a gradient.
fn energy_density(law: &LawAt, g: &[Vec2; 2]) -> f64 {
    let flux = law.flux(g);
    (0..law.components()).map(|i| flux[i][0] * g[i].x + flux[i][1] * g[i].y).sum()
}
