//! What patches hold, in pairs of words: terms of function × polynomial.
//!
//! ```text
//! patch   terms, the smooth one first
//! term    [group (+ SMOOTH), degrees]      degrees: 8 bits for each function of the group, ABSENT if it has no
//!                                          polynomial here
//!         polynomials of its functions, in their order
//!         high and low of the constants    of a smooth term only
//! ```
//!
//! A polynomial holds its coefficients in Horner's order, for b = d … 0, for a = d − b … 0 that of ξ^a η^b,
//! of all components side by side: `LANES` words, as many times as there are groups of components. The constant of a smooth term stands apart, in two
//! halves, and is 0 in the polynomial: neighbours' constants are subtracted from each other before
//! anything else, so that a plate that has moved far loses no digit of its strains.

use ppum::dataset::{FieldData, monomials};
use ppum::field::Field;

use crate::groups::{Class, Groups};
use crate::layout::halves;

/// Marks the smooth term of a patch.
pub(crate) const SMOOTH: u32 = 1 << 31;

/// In place of a degree: the function has no polynomial.
pub(crate) const ABSENT: u32 = 0xff;

/// Components side by side: `lanes` of them, 2 or 4, in `groups` groups.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Components {
    /// Components of the field.
    pub(crate) count: usize,
    /// Components that are computed together.
    pub(crate) lanes: usize,
    /// Groups of them.
    pub(crate) groups: usize,
}

impl Components {
    pub(crate) fn new(count: usize) -> Self {
        let lanes = if count <= 2 { 2 } else { 4 };
        Self { count, lanes, groups: count.div_ceil(lanes).max(1) }
    }
}

/// The bodies of all patches.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bodies {
    /// Pairs of words.
    pub(crate) pairs: Vec<[u32; 2]>,
    /// Address and number of terms of each patch.
    pub(crate) patches: Vec<[u32; 2]>,
}

impl Bodies {
    /// The bodies of a field's patches.
    pub(crate) fn new(field: &Field<'_>, groups: &Groups) -> Self {
        let components = Components::new(field.components());
        let mut writer = Writer { data: field.data, groups, components, pairs: Vec::new() };
        let patches = (0..field.step.partition.len()).map(|patch| writer.patch(patch)).collect();
        Self { pairs: writer.pairs, patches }
    }
}

struct Writer<'f> {
    data: &'f FieldData,
    groups: &'f Groups,
    components: Components,
    pairs: Vec<[u32; 2]>,
}

/// The blocks of a patch that share a group, by entry.
struct Term {
    group: u32,
    smooth: bool,
    blocks: [Option<usize>; 4],
}

impl Writer<'_> {
    fn patch(&mut self, patch: usize) -> [u32; 2] {
        let start = self.pairs.len() as u32;
        let terms = self.terms(patch);
        for term in &terms {
            self.term(term);
        }
        [start, terms.len() as u32]
    }

    /// The terms of a patch, the smooth one first. A function that comes twice makes two terms.
    fn terms(&self, patch: usize) -> Vec<Term> {
        let mut terms: Vec<Term> = Vec::new();
        for block in self.data.blocks(patch) {
            let [group, entry] = self.groups.slot(self.data.block_function[block]);
            let entry = entry as usize;
            let has_room = |term: &&mut Term| term.group == group && term.blocks[entry].is_none();
            match terms.iter_mut().find(has_room) {
                Some(term) => term.blocks[entry] = Some(block),
                None => {
                    let mut blocks = [None; 4];
                    blocks[entry] = Some(block);
                    terms.push(Term { group, smooth: false, blocks });
                }
            }
        }
        if let Some(at) = terms
            .iter()
            .position(|term| self.groups.classes()[term.group as usize] == Class::Smooth)
        {
            terms[at].smooth = true;
            terms.swap(0, at);
        }
        terms
    }

    fn term(&mut self, term: &Term) {
        let degree = |block: &Option<usize>| {
            block.map_or(ABSENT, |block| u32::from(self.data.block_degree[block]))
        };
        let degrees = (0..4).map(|entry| degree(&term.blocks[entry]) << (8 * entry)).sum();
        self.pairs.push([term.group | if term.smooth { SMOOTH } else { 0 }, degrees]);
        for block in term.blocks.iter().flatten() {
            for group in 0..self.components.groups {
                self.polynomial(*block, group, term.smooth);
            }
            if term.smooth {
                self.constants(*block);
            }
        }
    }

    /// The coefficients of a group of components.
    fn polynomial(&mut self, block: usize, group: usize, smooth: bool) {
        let degree = usize::from(self.data.block_degree[block]);
        for index in horner(degree) {
            let constant = smooth && index == 0;
            self.lanes(group, |component| {
                if constant {
                    0.0
                } else {
                    self.data.block_coefficients(block, component)[index] as f32
                }
            });
        }
    }

    /// High and low of the constants, group by group of components.
    fn constants(&mut self, block: usize) {
        for group in 0..self.components.groups {
            for half in 0..2 {
                self.lanes(group, |component| {
                    halves(self.data.block_coefficients(block, component)[0])[half]
                });
            }
        }
    }

    /// One number of each component of a group, 0 for those there are not.
    fn lanes(&mut self, group: usize, of: impl Fn(usize) -> f32) {
        let Components { count, lanes, .. } = self.components;
        let word = |component: usize| if component < count { of(component).to_bits() } else { 0 };
        let first = group * lanes;
        let pairs = (first..first + lanes).step_by(2).map(|c| [word(c), word(c + 1)]);
        let pairs: Vec<_> = pairs.collect();
        self.pairs.extend(pairs);
    }
}

/// The coefficients of a polynomial in Horner's order, as the dataset counts them.
pub(crate) fn horner(degree: usize) -> impl Iterator<Item = usize> {
    let row = move |b: usize| (0..=degree - b).rev().map(move |a| monomials(a + b) - 1 - a);
    (0..=degree).rev().flat_map(row)
}
