//! Cells that look alike.
//!
//! In a cell that nothing cuts and on which all functions are polynomials, integrals of functions
//! with each other depend on where the patches around it lie as seen from its centre, and on their
//! orders. On a uniform cover all cells are of one kind but those at the border and near cracks.
//! What is integrated of a kind is integrated once, on a cell at the origin. Patches of a kind's
//! cells have one size and one order, so that there are few kinds, whatever the cover.
//!
//! A kind is known by its measures, rounded to a part of its size, so that rounding of
//! coordinates does not tell cells apart. The cell at the origin has the rounded ones: it is the
//! same in every space that has the kind, whatever else is in that, so that integrals of a kind
//! have the same bits in all steps of a series.

use crate::quadrature::Rule;
use ppum::vec2::Vec2;

/// The cells of a space that are alike.
#[derive(Debug, Default)]
pub(crate) struct Alike {
    pub(super) kinds: Vec<ReferenceCell>,
    /// Of each cell that is of a kind, that kind and its patches.
    pub(super) cells: Vec<Option<Member>>,
    /// Of each patch all cells of which are of kinds, its own kind.
    pub(super) patches: Vec<Option<u32>>,
    pub(super) patch_kinds: Vec<PatchKind>,
}

/// A cell whose rules all cells that are congruent to it share.
#[derive(Debug)]
pub(crate) struct ReferenceCell {
    pub(super) measures: Vec<i64>,
    /// The rules of the cell at the origin; patches are seats.
    pub(super) rules: Vec<Rule>,
}

/// A cell of a kind.
#[derive(Clone, Debug)]
pub(crate) struct Member {
    pub(crate) kind: u32,
    /// The patches that cover the cell, in the order of the kind: each has a *seat*.
    pub(crate) patches: Vec<u32>,
}

/// A kind of patches: all its cells, with the seat that the patch has in each, in an order that
/// depends on nothing else.
pub(crate) type PatchKind = Vec<(u32, u32)>;

impl Alike {
    /// All kinds of cells.
    pub(crate) fn kinds(&self) -> &[ReferenceCell] {
        &self.kinds
    }

    /// What a cell is, if it is of a kind.
    pub(crate) fn cell(&self, cell: usize) -> Option<&Member> {
        self.cells.get(cell)?.as_ref()
    }

    /// All kinds of patches.
    pub(crate) fn patch_kinds(&self) -> &[PatchKind] {
        &self.patch_kinds
    }

    /// The kind of a patch all of whose cells are of kinds.
    pub(crate) fn patch(&self, patch: usize) -> Option<usize> {
        self.patches.get(patch)?.map(|kind| kind as usize)
    }

    /// The rules on a cell with this centre, if it is of a kind.
    pub(super) fn rules(&self, cell: usize, anchor: Vec2) -> Option<Vec<Rule>> {
        let Member { kind, patches } = self.cell(cell)?;
        let moved = |rule: &Rule| {
            let mut seated: Vec<_> =
                rule.patches.iter().map(|&seat| patches[seat as usize]).collect();
            seated.sort_unstable();
            Rule { anchor, patches: seated, ..rule.clone() }
        };
        Some(self.kinds[*kind as usize].rules.iter().map(moved).collect())
    }
}

impl ReferenceCell {
    /// The rules of the cell at the origin, whose patches are the seats.
    pub(crate) fn rules(&self) -> &[Rule] {
        &self.rules
    }
}
