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

/// What the disagreements of two fields are together in a cell.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Shared {
    /// ∫_{C_j} Σ_i s_i φ_i (σ(u_i) − σ(u)) : (ε(v_i) − ε(v))
    pub(crate) mixed: f64,
    /// The square of the second field's own.
    pub(crate) second: f64,
}

/// The same of two fields in all cells. Advances the stage by their number.
///
/// # Errors
/// Cancelled.
pub(crate) fn shared_disagreement(
    fields: [&Field<'_>; 2],
    space: &Space<'_>,
    stage: &Stage<'_>,
) -> Result<Vec<Shared>, Halt> {
    let (law, quadrature) = (Law::new(fields[0].equation), space.quadrature(0));
    let n = space.partition().len();
    let mut all = Vec::with_capacity(n);
    let work = |parts: &mut [Vec<Part>; 2], cell: usize| {
        let mut sum = Shared::default();
        let rules = space.rules(&quadrature, cell);
        for rule in rules.iter().filter(|rule| rule.patches.len() > 1) {
            add_shared(fields, space, &law, rule, parts, &mut sum);
        }
        Ok(sum)
    };
    in_batches(stage, n, Default::default, work, |_, of_cell| all.push(of_cell))?;
    Ok(all)
}

fn of_rule(
    field: &Field<'_>,
    space: &Space<'_>,
    law: &Law<'_>,
    rule: &Rule,
    parts: &mut Vec<Part>,
) -> f64 {
    let (local, shares) = (field.at(rule.anchor), shares(space, rule));
    let at_point = |(&offset, &weight): (&Vec2, &f64)| {
        local.parts::<1>(offset, Side::Above, &rule.patches, parts);
        let law = law.at(rule.anchor + offset);
        let of_part = |(d, share): ([Vec2; 2], f64)| share * product(&law, &d, &d);
        weight * differences(parts).zip(weighted(parts, &shares)).map(of_part).sum::<f64>()
    };
    rule.offsets.iter().zip(&rule.weights).map(at_point).sum()
}

fn add_shared(
    fields: [&Field<'_>; 2],
    space: &Space<'_>,
    law: &Law<'_>,
    rule: &Rule,
    parts: &mut [Vec<Part>; 2],
    sum: &mut Shared,
) {
    let (locals, shares) = (fields.map(|field| field.at(rule.anchor)), shares(space, rule));
    for (&offset, &weight) in rule.offsets.iter().zip(&rule.weights) {
        for (local, parts) in locals.iter().zip(parts.iter_mut()) {
            local.parts::<1>(offset, Side::Above, &rule.patches, parts);
        }
        let law = law.at(rule.anchor + offset);
        let [first, second] = parts.each_ref().map(|parts| differences(parts));
        for ((d, e), share) in first.zip(second).zip(weighted(&parts[0], &shares)) {
            sum.mixed += weight * share * product(&law, &d, &e);
            sum.second += weight * share * product(&law, &e, &e);
        }
    }
}

/// s_i of the patches of a rule.
fn shares(space: &Space<'_>, rule: &Rule) -> Vec<f64> {
    rule.patches.iter().map(|&i| share_of_error(space.order(i as usize)).powi(2)).collect()
}

/// s_i φ_i at a point.
fn weighted<'p>(parts: &'p [Part], shares: &'p [f64]) -> impl Iterator<Item = f64> + 'p {
    parts.iter().zip(shares).map(|(part, share)| share * part.share.v)
}

/// ∇u_i − ∇u at a point, patch by patch.
fn differences(parts: &[Part]) -> impl Iterator<Item = [Vec2; 2]> + '_ {
    let zero = [Jet::constant(0.0); 2];
    let sum = parts.iter().fold(zero, |sum, part| {
        [0, 1].map(|k| sum[k].plus::<1>(part.share.times::<1>(part.local[k])))
    });
    parts.iter().map(move |part| [0, 1].map(|k| gradient(part.local[k]) - gradient(sum[k])))
}

fn gradient(jet: Jet<f64>) -> Vec2 {
    vec2(jet.x, jet.y)
}

/// σ(g):h of two gradients.
fn product(law: &LawAt, g: &[Vec2; 2], h: &[Vec2; 2]) -> f64 {
    let flux = law.flux(g);
    (0..law.components()).map(|i| flux[i][0] * h[i].x + flux[i][1] * h[i].y).sum()
}
