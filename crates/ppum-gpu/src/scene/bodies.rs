//! Contents of the patches, in texels of four words: terms of function × polynomial.
//!
//! ```text
//! patch   [other terms, degree of the smooth one + 256 × texels before the others], the smooth term, the others
//! smooth  for each group of components: a polynomial without constant, high and low of the constants
//! other   [group + 2^GROUP_BITS × its texels, degrees], the polynomials of its functions, in their order
//! ```
//!
//! Degrees are 8 bits for each function of a group, [`ABSENT`] if it has no polynomial here. A polynomial
//! holds its coefficients in Horner's order, for b = d … 0, for a = d − b … 0 that of ξ^a η^b, of all
//! components side by side: `lanes` words, as many times as there are groups of components. What is in
//! brackets takes as much room. Patches and other terms begin with a texel.
//!
//! The constant of the smooth term stands apart, in two halves: neighbours' constants are subtracted from
//! each other before anything else, so that a plate that has moved far loses no digit of its strains.

use std::collections::{BTreeMap, BTreeSet};

use ppum::dataset::{FieldData, monomials};
use ppum::field::Field;
use ppum::vec2::Rect;

use super::groups::{Groups, SMOOTH_GROUP};
use crate::layout::halves;

/// The group of a term is below it, its texels above.
pub(crate) const GROUP_BITS: u32 = 20;

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
    /// Texels of four words.
    pub(crate) words: Vec<u32>,
    /// The address of each patch: its first texel.
    pub(crate) patches: Vec<u32>,
    /// The properties they have in common.
    pub(crate) shape: Shape,
    /// Boxes around the patches with other terms than the smooth one: one for each group and kind.
    pub(crate) enriched: Vec<(Rect, Others)>,
}

/// Facts that shaders need not find out at each pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Shape {
    /// The degree of all smooth terms, if every patch has one and all are alike.
    pub(crate) degree: Option<u8>,
    /// The terms beside the smooth one.
    pub(crate) others: Others,
}

/// Kinds of terms beside the smooth one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Others {
    /// Four functions times constants.
    pub(crate) constants: bool,
    /// Functions times polynomials.
    pub(crate) polynomials: bool,
}

impl Others {
    /// Both kinds.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            constants: self.constants | other.constants,
            polynomials: self.polynomials | other.polynomials,
        }
    }
}

impl Bodies {
    /// The bodies of a field's patches.
    pub(crate) fn new(field: &Field<'_>, groups: &Groups) -> Self {
        let components = Components::new(field.components());
        let mut writer = Writer { data: field.data, groups, components, words: Vec::new() };
        let count = field.step.partition.len();
        let (mut patches, mut summary) = (Vec::with_capacity(count), Summary::default());
        for patch in 0..count {
            let terms = writer.terms(patch);
            summary.add(&terms, field, patch);
            patches.push(writer.patch(&terms));
        }
        let shape = summary.shape();
        let enriched = summary.enriched.into_iter().map(|((_, others), bounds)| (bounds, others));
        Self { words: writer.words, patches, shape, enriched: enriched.collect() }
    }
}

/// Collects what patches have in common.
#[derive(Debug, Default)]
struct Summary {
    degrees: BTreeSet<Option<u8>>,
    /// By group and kind.
    enriched: BTreeMap<(u32, Others), Rect>,
}

impl Summary {
    fn add(&mut self, terms: &Terms, field: &Field<'_>, patch: usize) {
        let data = field.data;
        self.degrees.insert(terms.smooth.map(|block| data.block_degree[block]));
        let support = field.step.partition.support(patch);
        for term in &terms.others {
            let is_constant =
                |block: Option<usize>| block.is_some_and(|b| data.block_degree[b] == 0);
            let constants = term.blocks.into_iter().all(is_constant);
            let key = (term.group, Others { constants, polynomials: !constants });
            let bounds = self.enriched.entry(key).or_insert(support);
            *bounds = bounds.union(&support);
        }
    }

    fn shape(&self) -> Shape {
        let single = self.degrees.len() == 1;
        let degree = self.degrees.first().copied().flatten().filter(|_| single);
        let kinds = self.enriched.keys().map(|&(_, others)| others);
        Shape { degree, others: kinds.fold(Others::default(), Others::and) }
    }
}

/// The terms of a patch.
struct Terms {
    /// The block of the smooth term.
    smooth: Option<usize>,
    others: Vec<Term>,
}

/// The blocks of a patch that share a group, by entry.
struct Term {
    group: u32,
    blocks: [Option<usize>; 4],
}

impl Term {
    fn blocks(&self) -> impl Iterator<Item = usize> + '_ {
        self.blocks.iter().copied().flatten()
    }
}

struct Writer<'f> {
    data: &'f FieldData,
    groups: &'f Groups,
    components: Components,
    words: Vec<u32>,
}

impl Writer<'_> {
    /// The terms of a patch. A function that comes twice makes two terms.
    fn terms(&self, patch: usize) -> Terms {
        let (mut smooth, mut others) = (None, Vec::<Term>::new());
        for block in self.data.blocks(patch) {
            let [group, entry] = self.groups.slot(self.data.block_function[block]);
            let entry = entry as usize;
            if group == SMOOTH_GROUP && self.groups.has_smooth() && smooth.is_none() {
                smooth = Some(block);
                continue;
            }
            let has_room = |term: &&mut Term| term.group == group && term.blocks[entry].is_none();
            match others.iter_mut().find(has_room) {
                Some(term) => term.blocks[entry] = Some(block),
                None => {
                    let mut blocks = [None; 4];
                    blocks[entry] = Some(block);
                    others.push(Term { group, blocks });
                }
            }
        }
        Terms { smooth, others }
    }

    /// Writes a patch; gives its address.
    fn patch(&mut self, terms: &Terms) -> u32 {
        let start = self.begin();
        let degree = terms.smooth.map_or(ABSENT, |block| self.data.block_degree[block].into());
        self.pair(terms.others.len() as u32, 0);
        if let Some(block) = terms.smooth {
            for group in 0..self.components.groups {
                self.smooth(block, group);
            }
        }
        let before = self.begin() - start;
        self.words[4 * start as usize + 1] = degree | before << 8;
        for term in &terms.others {
            self.term(term);
        }
        start
    }

    /// Goes to the next texel, whose number this is.
    fn begin(&mut self) -> u32 {
        self.words.resize(self.words.len().next_multiple_of(4), 0);
        (self.words.len() / 4) as u32
    }

    /// Two words in the room of all lanes.
    fn pair(&mut self, first: u32, second: u32) {
        let start = self.words.len();
        self.words.extend([first, second]);
        self.words.resize(start + self.components.lanes, 0);
    }

    /// The smooth term's coefficients of a group of components, high and low of the constants.
    fn smooth(&mut self, block: usize, group: usize) {
        let degree = usize::from(self.data.block_degree[block]);
        for index in horner(degree).take_while(|&index| index > 0) {
            self.coefficients(block, index, group);
        }
        for half in 0..2 {
            self.lanes(group, |coefficients| halves(coefficients[0])[half], block);
        }
    }

    fn term(&mut self, term: &Term) {
        let start = self.begin();
        let degree =
            |block: Option<usize>| block.map_or(ABSENT, |b| self.data.block_degree[b].into());
        let degrees = (0..4).map(|entry| degree(term.blocks[entry]) << (8 * entry)).sum();
        self.pair(term.group, degrees);
        for block in term.blocks() {
            for group in 0..self.components.groups {
                for index in horner(self.data.block_degree[block].into()) {
                    self.coefficients(block, index, group);
                }
            }
        }
        let texels = self.begin() - start;
        self.words[4 * start as usize] |= texels << GROUP_BITS;
    }

    /// A coefficient of all components of a group.
    fn coefficients(&mut self, block: usize, index: usize, group: usize) {
        self.lanes(group, |coefficients| coefficients[index] as f32, block);
    }

    /// One number of each component of a group, 0 for those there are not.
    fn lanes(&mut self, group: usize, of: impl Fn(&[f64]) -> f32, block: usize) {
        let Components { count, lanes, .. } = self.components;
        for component in group * lanes..(group + 1) * lanes {
            let value = if component < count {
                of(self.data.block_coefficients(block, component))
            } else {
                0.0
            };
            self.words.push(value.to_bits());
        }
    }
}

/// The coefficients of a polynomial in Horner's order, as the dataset counts them.
pub(crate) fn horner(degree: usize) -> impl Iterator<Item = usize> {
    let row = move |b: usize| (0..=degree - b).rev().map(move |a| monomials(a + b) - 1 - a);
    (0..=degree).rev().flat_map(row)
}
