//! Contents of the patches, in texels of four words: terms of function × polynomial.
//!
//! ```text
//! patch   [other terms, degree of the smooth one + 256 × texels before the others], the smooth term, the others
//! smooth  for each group of components: a polynomial without constant, high and low of the constants
//! other   [group + 2^GROUP_BITS × its texels, degrees], the polynomials of its functions, in their order
//! ```
//!
//! Degrees are 8 bits for each function of a group, [`ABSENT`] if it has no polynomial here. A
//! polynomial holds its coefficients in Horner's order, for b = d … 0, for a = d − b … 0 that of
//! ξ^a η^b, of all components side by side: `lanes` words, as many times as there are groups of
//! components. The part in brackets takes the same space. Patches and other terms begin with a
//! texel.
//!
//! The constant of the smooth term stands apart, in two halves: neighbours' constants are
//! subtracted from each other before anything else, so that a body that has moved far loses no
//! digit of its strains.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use ppum::dataset::{FieldData, monomials};
use ppum::field::Field;
use ppum::vec2::Rect;
use rayon::prelude::*;

use super::groups::{FunctionGroups, SMOOTH_GROUP};
use crate::layout::halves;

/// The group of a term is below it, its texels above.
pub(crate) const GROUP_BITS: u32 = 20;

/// In place of a degree: the function has no polynomial.
pub(crate) const ABSENT: u32 = 0xff;

/// Components side by side: `lanes` of them, 2 or 4, in `groups` groups.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ComponentLanes {
    /// Components of the field.
    pub(crate) count: usize,
    /// Components that are computed together.
    pub(crate) lanes: usize,
    /// Groups of them.
    pub(crate) groups: usize,
}

impl ComponentLanes {
    pub(crate) fn new(count: usize) -> Self {
        let lanes = if count <= 2 { 2 } else { 4 };
        Self { count, lanes, groups: count.div_ceil(lanes).max(1) }
    }
}

/// The bodies of all patches.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bodies {
    /// Texels of four words, part after part.
    pub(crate) parts: Vec<Vec<u32>>,
    /// The address of each patch: its first texel.
    pub(crate) patches: Vec<u32>,
    /// The properties they have in common.
    pub(crate) shape: BodyFacts,
    /// Boxes around the patches with other terms than the smooth one: one for each group and kind.
    pub(crate) enriched: Vec<(Rect, Others)>,
}

/// Facts that shaders need not find out at each pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct BodyFacts {
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
    /// The group that all are of, if they are of one, of constants, and no patch has two.
    pub(crate) group: Option<u32>,
}

impl Others {
    /// Terms of a group.
    fn of_group(group: u32, constants: bool) -> Self {
        Self { constants, polynomials: !constants, group: constants.then_some(group) }
    }

    /// Both kinds.
    pub(crate) fn and(self, other: Self) -> Self {
        let group = match (self == Self::default(), other == Self::default()) {
            (true, _) => other.group,
            (_, true) => self.group,
            _ => self.group.filter(|_| self.group == other.group),
        };
        Self {
            constants: self.constants | other.constants,
            polynomials: self.polynomials | other.polynomials,
            group,
        }
    }
}

/// Patches that are written at a time.
const AT_A_TIME: usize = 8192;

impl Bodies {
    /// The bodies of a field's patches.
    pub(crate) fn new(field: &Field<'_>, groups: &FunctionGroups) -> Self {
        let count = field.step.partition.len();
        let parts = (0..count.div_ceil(AT_A_TIME)).into_par_iter().map(|part| {
            let first = part * AT_A_TIME;
            BodyBatch::new(field, groups, first..count.min(first + AT_A_TIME))
        });
        Self::joined(parts.collect())
    }

    /// The bodies of all parts, one behind the other.
    fn joined(parts: Vec<BodyBatch>) -> Self {
        let (mut bodies, mut summary, mut texels) = (Self::default(), PatchSummary::default(), 0);
        for BodyBatch { words, patches, summary: of_part } in parts {
            bodies.patches.extend(patches.iter().map(|address| texels + address));
            texels += words.len() as u32 / 4;
            bodies.parts.push(words);
            summary.join(of_part);
        }
        let shape = summary.shape();
        let enriched = summary.enriched.into_iter().map(|((_, others), bounds)| (bounds, others));
        Self { shape, enriched: enriched.collect(), ..bodies }
    }
}

/// The bodies of some patches, in whole texels; addresses count from the first.
struct BodyBatch {
    words: Vec<u32>,
    patches: Vec<u32>,
    summary: PatchSummary,
}

impl BodyBatch {
    fn new(field: &Field<'_>, groups: &FunctionGroups, patches: Range<usize>) -> Self {
        let components = ComponentLanes::new(field.components());
        let mut writer = BodyWriter { data: field.data, groups, components, words: Vec::new() };
        let (mut addresses, mut summary) =
            (Vec::with_capacity(patches.len()), PatchSummary::default());
        for patch in patches {
            let terms = writer.terms(patch);
            summary.add(&terms, field, patch);
            addresses.push(writer.patch(&terms));
        }
        writer.begin();
        Self { words: writer.words, patches: addresses, summary }
    }
}

/// Collects what patches have in common.
#[derive(Debug, Default)]
struct PatchSummary {
    degrees: BTreeSet<Option<u8>>,
    /// By group and kind.
    enriched: BTreeMap<(u32, Others), Rect>,
}

impl PatchSummary {
    fn add(&mut self, terms: &PatchTerms, field: &Field<'_>, patch: usize) {
        let data = field.data;
        self.degrees.insert(terms.smooth.map(|block| data.block_degree[block]));
        for term in &terms.others {
            let is_constant =
                |block: Option<usize>| block.is_some_and(|b| data.block_degree[b] == 0);
            let all = Others::of_group(term.group, term.blocks.into_iter().all(is_constant));
            let is_alone = terms.others.iter().filter(|t| t.group == term.group).count() == 1;
            let others = Others { group: all.group.filter(|_| is_alone), ..all };
            self.put((term.group, others), field.step.partition.support(patch));
        }
    }

    fn put(&mut self, key: (u32, Others), covered: Rect) {
        let bounds = self.enriched.entry(key).or_insert(covered);
        *bounds = bounds.union(&covered);
    }

    fn join(&mut self, other: Self) {
        self.degrees.extend(other.degrees);
        other.enriched.into_iter().for_each(|(key, bounds)| self.put(key, bounds));
    }

    fn shape(&self) -> BodyFacts {
        let single = self.degrees.len() == 1;
        let degree = self.degrees.first().copied().flatten().filter(|_| single);
        let kinds = self.enriched.keys().map(|&(_, others)| others);
        BodyFacts { degree, others: kinds.fold(Others::default(), Others::and) }
    }
}

/// The terms of a patch.
struct PatchTerms {
    /// The block of the smooth term.
    smooth: Option<usize>,
    others: Vec<GroupTerm>,
}

/// The blocks of a patch that share a group, by entry.
struct GroupTerm {
    group: u32,
    blocks: [Option<usize>; 4],
}

impl GroupTerm {
    fn blocks(&self) -> impl Iterator<Item = usize> + '_ {
        self.blocks.iter().copied().flatten()
    }
}

struct BodyWriter<'f> {
    data: &'f FieldData,
    groups: &'f FunctionGroups,
    components: ComponentLanes,
    words: Vec<u32>,
}

impl<'f> BodyWriter<'f> {
    /// The terms of a patch. A function that comes twice makes two terms.
    fn terms(&self, patch: usize) -> PatchTerms {
        let (mut smooth, mut others) = (None, Vec::<GroupTerm>::new());
        for block in self.data.blocks(patch) {
            let [group, entry] = self.groups.slot(self.data.block_function[block]);
            let entry = entry as usize;
            if group == SMOOTH_GROUP && self.groups.has_smooth() && smooth.is_none() {
                smooth = Some(block);
                continue;
            }
            let has_room =
                |term: &&mut GroupTerm| term.group == group && term.blocks[entry].is_none();
            match others.iter_mut().find(has_room) {
                Some(term) => term.blocks[entry] = Some(block),
                None => {
                    let mut blocks = [None; 4];
                    blocks[entry] = Some(block);
                    others.push(GroupTerm { group, blocks });
                }
            }
        }
        PatchTerms { smooth, others }
    }

    /// Writes a patch; gives its address.
    fn patch(&mut self, terms: &PatchTerms) -> u32 {
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
        let lanes = self.lanes(block, group);
        for index in horner(degree).take_while(|&index| index > 0) {
            self.push(lanes, |coefficients| coefficients[index] as f32);
        }
        for half in 0..2 {
            self.push(lanes, |coefficients| halves(coefficients[0])[half]);
        }
    }

    fn term(&mut self, term: &GroupTerm) {
        let start = self.begin();
        let degree =
            |block: Option<usize>| block.map_or(ABSENT, |b| self.data.block_degree[b].into());
        let degrees = (0..4).map(|entry| degree(term.blocks[entry]) << (8 * entry)).sum();
        self.pair(term.group, degrees);
        for block in term.blocks() {
            for group in 0..self.components.groups {
                let lanes = self.lanes(block, group);
                for index in horner(self.data.block_degree[block].into()) {
                    self.push(lanes, |coefficients| coefficients[index] as f32);
                }
            }
        }
        let texels = self.begin() - start;
        self.words[4 * start as usize] |= texels << GROUP_BITS;
    }

    /// The coefficients of a block, for each component of a group; none of those there are not.
    fn lanes(&self, block: usize, group: usize) -> [&'f [f64]; 4] {
        let ComponentLanes { count, lanes, .. } = self.components;
        let data: &'f FieldData = self.data;
        [0, 1, 2, 3].map(|lane| match group * lanes + lane {
            component if lane < lanes && component < count => {
                data.block_coefficients(block, component)
            }
            _ => &[],
        })
    }

    /// One number of each component, 0 for those there are not.
    fn push(&mut self, lanes: [&[f64]; 4], of: impl Fn(&[f64]) -> f32) {
        let number = |lane: &&[f64]| if lane.is_empty() { 0 } else { of(lane).to_bits() };
        self.words.extend(lanes[..self.components.lanes].iter().map(number));
    }
}

/// The coefficients of a polynomial in Horner's order, as the dataset counts them.
pub(crate) fn horner(degree: usize) -> impl Iterator<Item = usize> {
    let row = move |b: usize| (0..=degree - b).rev().map(move |a| monomials(a + b) - 1 - a);
    (0..=degree).rev().flat_map(row)
}
