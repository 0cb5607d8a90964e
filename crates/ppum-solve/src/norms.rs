//! Norms of a field and of its error, integrated with the solver's own cells.

use crate::law::{Law, LawAt};
use crate::space::TrialSpace;
use ppum::crack::Side;
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::vec2::Vec2;
use rayon::prelude::*;

/// More Gauss points than the system was assembled with.
const EXTRA: usize = 2;

/// Squares of norms over the domain.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DomainNorms {
    /// ∫ σ(u):∇u, twice the strain energy; for Poisson ∫ κ |∇u|².
    pub energy: f64,
    /// ∫ |u|²
    pub l2: f64,
}

impl DomainNorms {
    /// Norm of `self` relative to that of `reference`: (energy norm, L² norm).
    #[must_use]
    pub fn relative_to(&self, reference: &Self) -> (f64, f64) {
        ((self.energy / reference.energy).sqrt(), (self.l2 / reference.l2).sqrt())
    }
}

/// A field given by a function: value and gradient of each component at `anchor + offset`.
pub type ReferenceField<'a> = &'a (dyn Fn(Vec2, Vec2) -> [Jet<f64>; 2] + Sync);

/// The norms of a field, of an exact field and of their difference, in this order.
///
/// # Panics
/// If the field is not of the step of `space`.
#[must_use]
pub fn norms(
    field: &Field<'_>,
    space: &TrialSpace<'_>,
    exact: ReferenceField<'_>,
) -> [DomainNorms; 3] {
    let parts = over_cells(
        field,
        space,
        &all_cells(space),
        EXTRA,
        |sums: &mut [DomainNorms; 3], at, u, weight| {
            let e = exact(at.anchor, at.offset);
            let difference = [u[0].minus::<1>(e[0]), u[1].minus::<1>(e[1])];
            for (sum, v) in sums.iter_mut().zip([*u, e, difference]) {
                sum.add(&at.law, &v, weight);
            }
        },
    );
    parts.into_iter().fold([DomainNorms::default(); 3], |a, b| {
        std::array::from_fn(|k| DomainNorms {
            energy: a[k].energy + b[k].energy,
            l2: a[k].l2 + b[k].l2,
        })
    })
}

/// Energy of a field, ½ ∫ σ:ε; for Poisson ½ ∫ κ |∇u|². With the points that systems are
/// assembled with.
///
/// # Panics
/// If the field is not of the step of `space`.
#[must_use]
pub fn energy(field: &Field<'_>, space: &TrialSpace<'_>) -> f64 {
    energy_of(field, space, &all_cells(space))
}

/// The part of the [`energy`] in some cells, by their indices.
pub fn energy_of(field: &Field<'_>, space: &TrialSpace<'_>, cells: &[usize]) -> f64 {
    let add = |sum: &mut DomainNorms, at: &QuadraturePoint, u: &[Jet<f64>; 2], weight| {
        sum.add(&at.law, u, weight)
    };
    let parts = over_cells(field, space, cells, 0, add);
    parts.iter().map(|part| 0.5 * part.energy).sum()
}

/// Σ ∫ λ (div u − d)² over the cells, d the mean of div u in the cell, weighted with λ, over ∫ σ:ε:
/// the part of the energy that the fluctuation of the volume within cells stores.
///
/// # Panics
/// If the field is not of the step of `space`.
#[must_use]
pub fn fluctuation(field: &Field<'_>, space: &TrialSpace<'_>) -> f64 {
    let add = |sum: &mut VolumeSums, at: &QuadraturePoint, u: &[Jet<f64>; 2], weight| {
        sum.norms.add(&at.law, u, weight);
        let (lambda, d) = (weight * at.law.lambda(), at.law.strain(u).trace());
        sum.lambda += lambda;
        sum.mean += lambda * d;
        sum.square += lambda * d * d;
    };
    let parts = over_cells(field, space, &all_cells(space), 0, add);
    let of_cell = |v: &VolumeSums| match v.lambda {
        0.0 => 0.0,
        lambda => (v.square - v.mean * v.mean / lambda).max(0.0),
    };
    parts.iter().map(of_cell).sum::<f64>() / parts.iter().map(|v| v.norms.energy).sum::<f64>()
}

/// Sums over a cell of λ, λ div u and λ (div u)².
#[derive(Default)]
struct VolumeSums {
    norms: DomainNorms,
    lambda: f64,
    mean: f64,
    square: f64,
}

fn all_cells(space: &TrialSpace<'_>) -> Vec<usize> {
    (0..space.partition().len()).collect()
}

/// A point of a rule, with the material law there.
struct QuadraturePoint {
    anchor: Vec2,
    offset: Vec2,
    law: LawAt,
}

/// Sums over the points of each of some cells, cell by cell.
fn over_cells<S: Default + Send>(
    field: &Field<'_>,
    space: &TrialSpace<'_>,
    cells: &[usize],
    extra: usize,
    add: impl Fn(&mut S, &QuadraturePoint, &[Jet<f64>; 2], f64) + Sync,
) -> Vec<S> {
    let (law, quadrature) = (Law::new(field.equation), space.quadrature(extra));
    let rules = |c: usize| match extra {
        0 => space.rules(&quadrature, c),
        _ => quadrature.cell(space.cell(c)).into(),
    };
    let cell = |&c: &usize| {
        let mut sum = S::default();
        for rule in rules(c).iter() {
            let local = field.at(rule.anchor);
            for (&offset, &weight) in rule.offsets.iter().zip(&rule.weights) {
                let mut u = [Jet::constant(0.0); 2];
                let place = [offset.x, offset.y];
                local.over_patches::<f64, 1>(place, Side::Above, &rule.patches, &mut u);
                let law = law.at(rule.anchor + offset);
                add(&mut sum, &QuadraturePoint { anchor: rule.anchor, offset, law }, &u, weight);
            }
        }
        sum
    };
    cells.par_iter().map(cell).collect()
}

impl DomainNorms {
    fn add(&mut self, law: &LawAt, u: &[Jet<f64>; 2], weight: f64) {
        let strain = law.strain(u);
        let stress = law.linear_stress(&strain);
        for (i, u) in u.iter().enumerate().take(law.components()) {
            self.energy += weight * stress.row_work(&strain, i);
            self.l2 += weight * u.v * u.v;
        }
    }
}
