//! Cells that look alike.
//!
//! In a cell that nothing cuts and on which all functions are polynomials, integrals of functions
//! with each other depend on where the patches around it lie as seen from its centre, and on their
//! orders. On a uniform cover all cells are of one kind, except those at the boundary and near
//! cracks. Integrals of a kind are computed once, on a cell at the origin. Patches of a kind's
//! cells have one size and one order, so that there are few kinds, whatever the cover.
//!
//! A kind is known by its measures, rounded to a part of its size, so that rounding of
//! coordinates does not tell cells apart. The cell at the origin has the rounded ones: it is the
//! same in every space that has the kind, whatever else is in that, so that integrals of a kind
//! have the same bits in all steps of a series.

use crate::quadrature::CellRule;
use ppum::vec2::Vec2;

/// The cells of a space that are alike.
#[derive(Debug, Default)]
pub(crate) struct CongruentCells {
    pub(crate) kinds: Vec<ReferenceCell>,
    /// The kind and the patches of each cell that is of a kind.
    pub(super) cells: Vec<Option<CongruentCell>>,
    /// The kind of each patch all cells of which are of kinds.
    pub(super) patches: Vec<Option<u32>>,
    pub(crate) patch_kinds: Vec<PatchKind>,
}

/// A cell whose rules all cells that are congruent to it share.
#[derive(Debug)]
pub(crate) struct ReferenceCell {
    pub(super) measures: Vec<i64>,
    /// The rules of the cell at the origin; patches are numbered by their local indices.
    pub(crate) rules: Vec<CellRule>,
}

/// A cell of a kind.
#[derive(Clone, Debug)]
pub(crate) struct CongruentCell {
    pub(crate) kind: u32,
    /// The patches that cover the cell, in the order of the kind, which gives each its *local
    /// index*.
    pub(crate) patches: Vec<u32>,
}

/// A kind of patches: all its cells, with the local index of the patch in each, in an order that
/// depends on nothing else.
pub(crate) type PatchKind = Vec<(u32, u32)>;

impl CongruentCells {
    /// Returns the kind of a cell, if it has one.
    pub(crate) fn cell(&self, cell: usize) -> Option<&CongruentCell> {
        self.cells.get(cell)?.as_ref()
    }

    /// The kind of a patch all of whose cells are of kinds.
    pub(crate) fn patch(&self, patch: usize) -> Option<usize> {
        self.patches.get(patch)?.map(|kind| kind as usize)
    }

    /// The rules on a cell with this centre, if it is of a kind.
    pub(super) fn rules(&self, cell: usize, anchor: Vec2) -> Option<Vec<CellRule>> {
        let CongruentCell { kind, patches } = self.cell(cell)?;
        let moved = |rule: &CellRule| {
            let mut seated: Vec<_> =
                rule.patches.iter().map(|&seat| patches[seat as usize]).collect();
            seated.sort_unstable();
            CellRule { anchor, patches: seated, ..rule.clone() }
        };
        Some(self.kinds[*kind as usize].rules.iter().map(moved).collect())
    }
}
