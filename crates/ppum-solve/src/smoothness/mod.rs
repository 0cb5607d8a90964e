//! Places at which the functions of a step and the coefficients of its equation are not smooth,
//! for quadrature.
//!
//! Formulas show where they have kinks; the singular points of a function are the origin of its
//! frame, if it uses polar coordinates, and those it declares. How fast it grows there is measured.
//! The Westergaard functions of a tip are known: half powers of r times smooth functions of θ.
//!
//! Body forces and data on the boundary have places of their own, `Smoothness::with_data`; they
//! matter in the integrals of these data alone.

mod growth;
mod interfaces;
mod pieces;
mod probe;
#[cfg(test)]
mod tests;
mod traits;

use crate::quadrature::{KinkLine, Singularity, SmoothnessGeometry};
use interfaces::proportional;
pub(crate) use interfaces::{BESIDE, Interface, InterfacePoint};
pub use interfaces::{Interfaces, UnresolvedCause, UnresolvedInterface};
use ppum::crack::Crack;
use ppum::dataset::{BoxPartition, Equation, FieldData, Step};
use ppum::domain::Hole;
use ppum::expression::Expression;
use ppum::formula::Table;
use ppum::function::{Function, FunctionError};
use ppum::vec2::{Rect, Vec2};
pub(crate) use probe::Probe;
use probe::ProbeList;
use std::collections::BTreeMap;
use std::sync::Arc;
use traits::{TraitContext, Traits, traits_of_coefficient, traits_of_data};
pub(crate) use traits::{box_of, levels_of_data};

/// Part of the domain's size that two lines may be apart by rounding.
const ROUNDING: f64 = 1e-14;

/// The places at which a step is not smooth; owns what a [`SmoothnessGeometry`] borrows.
#[derive(Clone, Debug, Default)]
pub(crate) struct Smoothness {
    singular: Vec<Singularity>,
    /// Those at each point, by the bits of its coordinates.
    at_point: BTreeMap<[u64; 2], Vec<u32>>,
    patch_singular: Vec<Vec<u32>>,
    kinks: Vec<KinkLine>,
    patch_kinks: Vec<Vec<u32>>,
    common_kinks: Vec<u32>,
    probes: ProbeList,
    patch_probes: Vec<Vec<u32>>,
    common_probes: Vec<u32>,
    /// Largest degree of a product of a block's polynomial with its function, where that is a
    /// piecewise polynomial, and with the coefficients, as far as they are.
    degree: usize,
}

/// Places of the traits of one function in the lists of all.
#[derive(Default)]
struct Indices {
    singular: Vec<u32>,
    kinks: Vec<u32>,
    probes: Vec<u32>,
}

impl Smoothness {
    /// The places at which a step is not smooth.
    ///
    /// # Errors
    /// A function that does not compile.
    pub(crate) fn new(
        step: &Step,
        data: &FieldData,
        equation: &Equation,
        tables: &[Arc<Table>],
    ) -> Result<Self, FunctionError> {
        let surroundings = TraitContext::new(step, tables);
        let mut all = Self::default();
        let mut of_functions = Vec::with_capacity(step.functions.len());
        let mut degrees = Vec::with_capacity(step.functions.len());
        for (index, function) in step.functions.iter().enumerate() {
            let traits = surroundings.traits(function).map_err(|e| FunctionError { index, ..e })?;
            degrees.push(traits.degree);
            of_functions.push(all.add(traits, &surroundings.domain));
        }
        let blocks = data.block_function.iter().zip(&data.block_degree);
        let degree = blocks.map(|(&function, &d)| usize::from(d) + degrees[function as usize]);
        all.degree = degree.max().unwrap_or(0);
        all.add_coefficients(equation, &surroundings.domain);
        for patch in 0..step.partition.len() {
            let functions = data.blocks(patch).map(|b| data.block_function[b] as usize);
            let of_patch: Vec<_> = functions.map(|function| &of_functions[function]).collect();
            let union = |list: fn(&Indices) -> &Vec<u32>| {
                let mut found: Vec<_> = of_patch.iter().flat_map(|i| list(i)).copied().collect();
                found.sort_unstable();
                found.dedup();
                found
            };
            all.patch_singular.push(union(|indices| &indices.singular));
            all.patch_kinks.push(union(|indices| &indices.kinks));
            all.patch_probes.push(union(|indices| &indices.probes));
        }
        Ok(all)
    }

    /// Returns the smoothness for integrals with data, each with the mean of its absolute value,
    /// and the lines where the data are not smooth; `None` if the data are polynomials.
    pub(crate) fn with_data(
        &self,
        domain: &Rect,
        data: &[(&Expression, f64)],
    ) -> Option<(Self, Vec<KinkLine>)> {
        let all: Vec<Traits> =
            data.iter().filter_map(|(data, mean)| traits_of_data(data, *mean)).collect();
        if all.is_empty() {
            return None;
        }
        let (mut extended, mut places) = (self.clone(), Vec::new());
        for traits in all {
            places.extend(traits.kinks.iter().cloned());
            let Indices { kinks, probes, .. } = extended.add(traits, domain);
            extended.common_kinks.extend(kinks);
            extended.common_probes.extend(probes);
        }
        Some((extended, places))
    }

    /// The places at which the space over a partition is not smooth.
    pub(crate) fn geometry<'a>(
        &'a self,
        partition: &'a BoxPartition,
        cracks: &'a [Crack],
        holes: &'a [Hole],
    ) -> SmoothnessGeometry<'a> {
        SmoothnessGeometry {
            holes,
            singular: &self.singular,
            patch_singular: &self.patch_singular,
            kinks: &self.kinks,
            patch_kinks: &self.patch_kinks,
            common_kinks: &self.common_kinks,
            probes: &self.probes,
            patch_probes: &self.patch_probes,
            common_probes: &self.common_probes,
            ..SmoothnessGeometry::new(partition, cracks)
        }
    }

    /// Operations of all formulas that are looked at.
    pub(crate) fn probe_operations(&self) -> usize {
        self.probes.0.iter().map(Probe::operations).sum()
    }

    /// Degree that quadrature has to be for.
    pub(crate) fn degree(&self) -> usize {
        self.degree
    }

    /// The index of a kink, of an equal one if there is one: a curve that several functions have in
    /// common is cut along once.
    fn add_kink(&mut self, new: KinkLine, domain: &Rect) -> u32 {
        let known = self.kinks.iter().position(|known| same(known, &new, domain));
        known.unwrap_or_else(|| {
            self.kinks.push(new);
            self.kinks.len() - 1
        }) as u32
    }

    fn add(&mut self, traits: Traits, domain: &Rect) -> Indices {
        let singular = traits.singular.into_iter().map(|new| {
            let place = [new.point.x, new.point.y].map(f64::to_bits);
            let here = self.at_point.entry(place).or_default();
            let known = here.iter().copied().find(|&k| self.singular[k as usize] == new);
            known.unwrap_or_else(|| {
                self.singular.push(new);
                here.push(self.singular.len() as u32 - 1);
                self.singular.len() as u32 - 1
            })
        });
        let singular = singular.collect();
        let mut kinks: Vec<u32> =
            traits.kinks.into_iter().map(|kink| self.add_kink(kink, domain)).collect();
        kinks.sort_unstable();
        kinks.dedup();
        let first = self.probes.0.len() as u32;
        self.probes.0.extend(traits.probe);
        let probes = (first..self.probes.0.len() as u32).collect();
        Indices { singular, kinks, probes }
    }

    fn add_coefficients(&mut self, equation: &Equation, domain: &Rect) {
        for (_, coefficient) in equation.constants() {
            let traits = traits_of_coefficient(coefficient);
            self.degree += traits.degree.div_ceil(2);
            let Indices { kinks, probes, .. } = self.add(traits, domain);
            self.common_kinks.extend(kinks);
            self.common_probes.extend(probes);
        }
    }
}

/// True if two kinks are the same line, segment or curve.
fn same(known: &KinkLine, new: &KinkLine, domain: &Rect) -> bool {
    match (known, new) {
        (KinkLine::Line([a, b]), KinkLine::Line(line)) => {
            let reach = ROUNDING * domain.size().length();
            let c = domain.center();
            let foot = *a + (*b - *a) * ((c - *a).dot(*b - *a) / (*b - *a).dot(*b - *a));
            let way = (*b - *a).unit() * domain.size().length();
            let [p, q] = line;
            let off = |x: Vec2| (x - *p).cross((*q - *p).unit()).abs();
            off(foot) <= reach && off(foot + way) <= reach
        }
        (KinkLine::Segment(a), KinkLine::Segment(b)) => a == b,
        (KinkLine::Curve(f), KinkLine::Curve(g)) => proportional(f.as_ref(), g.as_ref(), domain),
        _ => false,
    }
}

/// A point around which a function has infinite energy.
pub(crate) fn divergence(
    function: &Function,
    step: &Step,
    tables: &[Arc<Table>],
) -> Result<Option<Vec2>, FunctionError> {
    TraitContext::new(step, tables).traits(function).map(|traits| traits.divergent)
}
