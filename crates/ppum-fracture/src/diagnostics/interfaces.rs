//! Warnings about interfaces of materials that the local spaces do not resolve.

use super::{above, short};
use ppum::crack::Side;
use ppum::dataset::{Warning, WarningKind};
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::text::LocationText;
use ppum::vec2::{Vec2, vec2};
use ppum_solve::law::Law;
use ppum_solve::smoothness::{Interfaces, UnresolvedCause, UnresolvedInterface};
use ppum_solve::space::TrialSpace;

/// Points in each direction of a cell at which its energy is looked at.
const LOOKS: usize = 4;

/// Error of a cell's energy, relative to it, where the contrast is one: an order of magnitude,
/// not calibrated.
const SHARE: f64 = 0.1;

/// Estimated relative error of the energy from which on it is told.
const LARGE: f64 = 1e-3;

/// The warnings about interfaces: for each cause one, at the worst place, its value the estimated
/// relative error of the energy.
pub(super) fn of_interfaces(
    field: &Field<'_>,
    law: &Law<'_>,
    space: &TrialSpace<'_>,
    places: &LocationText,
) -> Vec<Warning> {
    let interfaces = Interfaces::new(law.constants(), field.domain, &field.step.cracks);
    if interfaces.all.is_empty() {
        return Vec::new();
    }
    let partition = field.step.partition.boxes();
    let energies: Vec<f64> = (0..partition.len()).map(|cell| energy(field, law, cell)).collect();
    let total: f64 = energies.iter().sum();
    // user-defined functions are taken for what is needed there
    let of_patch = |patch: usize| {
        let part = partition.support(patch).intersection(&field.domain.bounds);
        let found = interfaces.unresolved(&part)?;
        let share = SHARE * found.contrast.powi(2) * energies[patch] / total;
        (!space.has_user_functions(patch)).then_some((found, share))
    };
    let all: Vec<_> = (0..partition.len()).filter_map(of_patch).collect();
    let causes = [
        UnresolvedCause::Many,
        UnresolvedCause::Turn,
        UnresolvedCause::Corner,
        UnresolvedCause::Border,
        UnresolvedCause::Crack,
    ];
    causes.into_iter().filter_map(|cause| of_cause(cause, &all, places)).collect()
}

fn of_cause(
    cause: UnresolvedCause,
    all: &[(UnresolvedInterface, f64)],
    places: &LocationText,
) -> Option<Warning> {
    let such = || all.iter().filter(|(found, _)| found.cause == cause);
    let worst = such().max_by(|a, b| a.1.total_cmp(&b.1))?.0;
    let value: f64 = such().map(|(_, share)| share).sum();
    let message = format!(
        "{} at {}: the energy is off by about {} of itself, stresses near there by more; use smaller cells \
         there, or an [[enrichment]] with the exponent of the singular field",
        cause.name(),
        places.show(worst.at),
        short(value)
    );
    above(WarningKind::Interface, Some(worst.at), [value, LARGE], message)
}

/// About the energy of a cell, what of it lies in the body.
fn energy(field: &Field<'_>, law: &Law<'_>, cell: usize) -> f64 {
    let rect = field.step.partition.boxes().cell[cell];
    let (min, step) = (rect.min, rect.size() * (1.0 / LOOKS as f64));
    let at = |k: usize| {
        min + vec2(step.x * ((k % LOOKS) as f64 + 0.5), step.y * ((k / LOOKS) as f64 + 0.5))
    };
    let density = |p: Vec2| {
        let mut u = [Jet::constant(0.0); 2];
        let inside = field.at(p).evaluate::<1>(Vec2::ZERO, Side::Above, &mut u);
        let law_at = law.at(p);
        let strain = law_at.elastic(&law_at.strain(&u));
        let sum = law_at.linear_stress(&strain).work(&strain);
        if inside && sum.is_finite() { 0.5 * sum } else { 0.0 }
    };
    (0..LOOKS * LOOKS).map(|k| density(at(k))).sum::<f64>() * step.x * step.y
}
