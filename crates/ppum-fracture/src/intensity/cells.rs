//! Cells to integrate over, for covers that come from none.

use ppum::box_tree::BoxTree;
use ppum::cover::{Cover, CoverError};
use ppum::dataset::{BoxPartition, Dataset, Partition};
use ppum::field::FieldError;
use ppum::vec2::{Rect, Vec2};
use std::borrow::Cow;

/// Size of the cells in supports of the patches there.
const PART: f64 = 0.75;

/// Most divisions of a cell, and cells for each patch.
const DEEPEST: u8 = 16;
const MOST: usize = 16;

/// Most pairs of a cell and a patch over it, which are kept in lists of 256 MiB. A million patches
/// of a cover have nine million.
const MOST_PAIRS: usize = 1 << 26;

/// A dataset with the step, and its number there, with cells to integrate over if its patches are
/// boxes that have none. They are not those of the patches: nothing else may look at them.
///
/// # Errors
/// Too many patches over cells.
pub(crate) fn with_cells(
    dataset: &Dataset,
    step: usize,
) -> Result<(Cow<'_, Dataset>, usize), FieldError> {
    let boxes = dataset.steps.get(step).map(|step| &step.partition);
    let Some(Partition::Boxes(boxes)) = boxes.filter(|boxes| !boxes.is_empty()) else {
        return Ok((Cow::Borrowed(dataset), step));
    };
    if boxes.has_cells() {
        check_pairs(boxes)?;
        return Ok((Cow::Borrowed(dataset), step));
    }
    let cell = cells(boxes, dataset.domain.bounds).unwrap_or(vec![dataset.domain.bounds]);
    let mut copy = dataset.clone();
    copy.steps = vec![dataset.steps[step].clone()];
    let boxes = BoxPartition { cell, ..boxes.clone() };
    check_pairs(&boxes)?;
    copy.steps[0].partition = boxes.into();
    Ok((Cow::Owned(copy), 0))
}

fn check_pairs(boxes: &BoxPartition) -> Result<(), FieldError> {
    let supports: Vec<Rect> = (0..boxes.len()).map(|patch| boxes.support(patch)).collect();
    let (tree, mut pairs, mut near) = (BoxTree::new(&supports), 0, Vec::new());
    for cell in &boxes.cell {
        near.clear();
        tree.query_box(cell, &mut near);
        pairs += near.len();
        if pairs > MOST_PAIRS {
            return Err(FieldError::TooManyOverlaps { most: MOST_PAIRS });
        }
    }
    Ok(())
}

/// Cells that tile the domain and are a little smaller than the patches that they meet.
fn cells(boxes: &BoxPartition, domain: Rect) -> Result<Vec<Rect>, CoverError> {
    let supports: Vec<Rect> = (0..boxes.len()).map(|patch| boxes.support(patch)).collect();
    let (tree, size) = (BoxTree::new(&supports), domain.size());
    let shorter = size.x.min(size.y);
    let roots = [size.x, size.y].map(|side| (side / shorter).round().clamp(1.0, 1024.0) as u32);
    let mut cover = Cover::grid(domain, roots)?;
    let mut near = Vec::new();
    for _ in 0..DEEPEST {
        let divided = cover.refine(|cell, _| {
            near.clear();
            tree.query_box(&cell, &mut near);
            near.iter().any(|&patch| {
                let Vec2 { x, y } = supports[patch as usize].size() * PART;
                cell.size().x > x || cell.size().y > y
            })
        })?;
        if divided == 0 || cover.n_cells() > MOST * boxes.len() {
            break;
        }
    }
    Ok(cover.cells().into_iter().map(|(cell, _)| cell).collect())
}
