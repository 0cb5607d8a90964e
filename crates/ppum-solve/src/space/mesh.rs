//! The cells of a problem with what adaptation has made of them.

use super::error::SpaceError;
use crate::refine::{RefineError, cover};
use crate::watched::WorkPhase;
use ppum::box_tree::BoxTree;
use ppum::cover::{Cover, CoverError};
use ppum::dataset::BoxPartition;
use ppum::vec2::Rect;
use ppum_problem::Problem;

/// The change that a cell undergoes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellChange {
    /// It stays as it is.
    Keep,
    /// Its four quarters take its place.
    Divide,
    /// The order of its polynomials grows by one.
    Raise,
}

/// A cover, and of each of its cells by how much the order is raised above the one that the
/// problem gives.
#[derive(Clone, Debug)]
pub struct CoverMesh {
    pub(super) cover: Cover,
    pub(super) raised: Vec<u8>,
}

impl CoverMesh {
    /// The cover of a problem, of at most so many cells.
    ///
    /// # Errors
    /// A cover that cannot be built or refined; cancelled.
    pub fn new(problem: &Problem, most: usize, stage: &WorkPhase<'_>) -> Result<Self, SpaceError> {
        let cover = cover(problem, most, stage)?;
        let raised = vec![0; cover.n_cells()];
        Ok(Self { cover, raised })
    }

    /// Number of cells, those in holes among them.
    pub fn n_cells(&self) -> usize {
        self.raised.len()
    }

    /// The mesh of cells twice as wide, each with the least raised order of those in its place;
    /// none if this one is a single cell.
    pub(crate) fn coarser(&self) -> Option<Self> {
        let cover = self.cover.coarser()?;
        let cells: Vec<Rect> = cover.cells().into_iter().map(|(cell, _)| cell).collect();
        let (tree, mut raised) = (BoxTree::new(&cells), vec![u8::MAX; cells.len()]);
        let mut holders = Vec::new();
        for ((cell, _), own) in self.cover.cells().iter().zip(&self.raised) {
            holders.clear();
            tree.query_point(cell.center(), &mut holders);
            for &holder in &holders {
                raised[holder as usize] = raised[holder as usize].min(*own);
            }
        }
        raised.iter_mut().filter(|raised| **raised == u8::MAX).for_each(|raised| *raised = 0);
        Some(Self { cover, raised })
    }

    /// The mesh after changes to the cells of a partition, which is this mesh's except for cells in
    /// holes. Cells beside those that are divided may have to be divided, too. None if nothing can
    /// be changed.
    ///
    /// # Errors
    /// Too many cells.
    pub fn changed(
        &self,
        partition: &BoxPartition,
        changes: &[CellChange],
    ) -> Result<Option<Self>, SpaceError> {
        let cells = self.cover.cells();
        let mut change = vec![CellChange::Keep; cells.len()];
        let mut own = partition.cell.iter().zip(changes).peekable();
        for ((cell, _), change) in cells.iter().zip(&mut change) {
            if let Some((_, wanted)) = own.next_if(|(solid, _)| *solid == cell) {
                *change = *wanted;
            }
        }
        if change.iter().all(|change| *change == CellChange::Keep) {
            return Ok(None);
        }
        let mut cover = self.cover.clone();
        let mut divide = change.iter().map(|change| *change == CellChange::Divide);
        match cover.refine(|_, _| divide.next() == Some(true)) {
            // as small as numbers allow: not an error of the problem
            Err(CoverError::TooSmall { .. }) => return Ok(None),
            other => other.map_err(RefineError::from)?,
        };
        let raise =
            |(raised, change): (&u8, &CellChange)| raised + u8::from(*change == CellChange::Raise);
        let raised: Vec<u8> = self.raised.iter().zip(&change).map(raise).collect();
        let raised = inherited(&cells, &raised, &cover.cells());
        Ok(Some(Self { cover, raised }))
    }
}

/// Returns the values that new cells inherit from the old cells that they lie in. Both lists are in
/// the order of one tree.
fn inherited(old: &[(Rect, u8)], of_old: &[u8], new: &[(Rect, u8)]) -> Vec<u8> {
    let mut at = 0;
    let of = |(cell, _): &(Rect, u8)| {
        while !old[at].0.contains(cell.center()) {
            at += 1;
        }
        of_old[at]
    };
    new.iter().map(of).collect()
}
