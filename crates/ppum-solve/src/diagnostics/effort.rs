//! The effort of finding the stress intensity factors of a dataset's step again, known before
//! anything of it is done.
//!
//! Factors are integrals over all cells in a disc, and a file of some kilobytes can ask for a
//! hundred thousand tips in a hundred thousand cells. What is looked at, and how often, is added up
//! here from sizes alone, and compared with bounds that are above what solved problems take: a
//! plate of a million patches with a few cracks and holes, or of a hundred thousand patches with a
//! thousand cracks, stays below them.

use crate::geometry::TipClearance;
use crate::problem::Problem;
use ppum::box_tree::BoxTree;
use ppum::crack::{Crack, TipId, tips};
use ppum::dataset::{Dataset, FieldData, Step, monomials};
use ppum::domain::Hole;
use ppum::expression::Expression;
use ppum::function::{FunctionError, FunctionKind, FunctionTable, Slot};
use ppum::vec2::{Rect, Vec2, vec2};
use std::collections::BTreeSet;

/// Most pairs of cells and patches that meet, and of patches and the kinks and singular points of
/// their functions: lists of them are kept, 256 MiB.
const MOST_PAIRS: u64 = 1 << 26;

/// Most comparisons: of tips with cells, cracks and rims, of cells with the segments near them, of
/// kinks with each other. Some ten seconds.
const MOST_LOOKS: u64 = 1 << 34;

/// Most operations of evaluations: ten minutes, of which a vector does several at once.
const MOST_OPERATIONS: u64 = 1 << 40;

/// Places at which a field is looked at in a cell for warnings.
const PLACES: u64 = 32;

/// Looks at each rim from a cell.
const RIM_LOOKS: u64 = 32;

/// Looks at each segment from a segment behind a kink: both faces, in the cells that it may meet.
const FACE_LOOKS: u64 = 8;

/// Places along a crack.
const CRACK_PLACES: u64 = 192;

/// Quadrature points in a cell of a disc: twelve in each direction of nine pieces.
const POINTS: u64 = 9 * 144;

/// Points at which two curves are compared.
const COMPARED: u64 = 1152;

/// Comparisons at a corner of the border for each condition on it.
const CORNER_LOOKS: u64 = 1 << 12;

/// Finding a patch at a point, and its weight.
const PATCH: u64 = 16;

/// Finding the factors takes too much.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EffortError {
    /// There is too much of something.
    #[error(
        "{tips} tips in {cells} cells take {count:.1e} {what}, but at most {most:.1e} are done"
    )]
    TooMuch {
        /// Tips of the step.
        tips: usize,
        /// Cells of the step.
        cells: usize,
        /// The amount.
        count: f64,
        /// Of what.
        what: &'static str,
        /// The most that is done.
        most: f64,
    },
    /// A function that does not compile.
    #[error(transparent)]
    Function(#[from] FunctionError),
}

/// Looks whether the factors of a step's tips can be found within bounds of time and memory, and
/// the warnings about a `problem` that it solves.
///
/// # Errors
/// The first thing of which there is too much.
///
/// # Panics
/// If there is no such step, or it has no field.
pub fn check_effort(
    dataset: &Dataset,
    step: usize,
    problem: Option<&Problem>,
) -> Result<(), EffortError> {
    let step = &dataset.steps[step];
    let table = FunctionTable::new(&step.functions, step.cracks.len(), &dataset.tables)?;
    let count = Count { dataset, step, data: &step.fields[0], table };
    let error = |what, count: u64, most: u64| EffortError::TooMuch {
        tips: tips(&step.cracks).count(),
        cells: step.partition.len(),
        count: count as f64,
        what,
        most: most as f64,
    };
    let within =
        |what, count, most| if count <= most { Ok(()) } else { Err(error(what, count, most)) };
    let of_corners = problem.map_or(0, |problem| {
        let conditions = problem.boundary.len() as u64;
        // each has two ends
        conditions.saturating_mul(2 * conditions + count.rims()).saturating_mul(CORNER_LOOKS)
    });
    within("comparisons", count.looks().saturating_add(of_corners), MOST_LOOKS)?;
    within("pairs of patches and kinks", count.kinks_of_patches(), MOST_PAIRS)?;
    let neighbours = count.neighbours();
    within(
        "pairs of cells and patches",
        neighbours.iter().map(|n| n.len() as u64).sum(),
        MOST_PAIRS,
    )?;
    within("operations", count.operations(&neighbours), MOST_OPERATIONS)
}

struct Count<'d> {
    dataset: &'d Dataset,
    step: &'d Step,
    data: &'d FieldData,
    table: FunctionTable,
}

impl Count<'_> {
    /// Circles and corners of holes.
    fn rims(&self) -> u64 {
        let corners = |hole: &Hole| match hole {
            Hole::Circle { .. } => 1,
            Hole::Polygon { points } => points.len() as u64,
        };
        self.dataset.domain.holes.iter().map(corners).sum()
    }

    /// Comparisons of everything with everything.
    fn looks(&self) -> u64 {
        let (n_tips, cells) =
            (tips(&self.step.cracks).count() as u64, self.step.partition.len() as u64);
        let segments = self.step.cracks.iter().map(|crack| crack.points.len() as u64).sum::<u64>();
        let kinks: u64 = self.declared().iter().sum();
        let curves = self.curves();
        let of_tips = n_tips.saturating_mul(cells + segments + self.rims());
        let of_cells = RIM_LOOKS.saturating_mul(cells).saturating_mul(self.rims());
        let of_kinks = kinks.saturating_mul(kinks).saturating_add(curves * curves * COMPARED);
        // rules along the faces behind kinks look at all segments
        let behind =
            |tip: TipId| self.step.cracks[tip.crack as usize].points.len().saturating_sub(2) as u64;
        let own: u64 = tips(&self.step.cracks).map(behind).sum();
        let of_faces = FACE_LOOKS.saturating_mul(own).saturating_mul(segments);
        of_tips.saturating_add(of_cells).saturating_add(of_kinks).saturating_add(of_faces)
    }

    /// Curves on which the coefficients of the equation may have kinks.
    fn curves(&self) -> u64 {
        self.coefficients().map(|e| e.formula().kinks().len() as u64).sum()
    }

    fn coefficients(&self) -> impl Iterator<Item = &Expression> {
        let all = self.dataset.equation.constants().map(|(_, expression)| expression);
        all.filter(|expression| expression.constant().is_none())
    }

    /// Of each function the number of kinks and singular points that it declares.
    fn declared(&self) -> Vec<u64> {
        let of = |kind: &FunctionKind| match kind {
            FunctionKind::Formula { declared, .. } => {
                declared.kinks.len() + declared.singular.len()
            }
            _ => 0,
        };
        self.step.functions.iter().map(|function| of(&function.kind) as u64).collect()
    }

    fn kinks_of_patches(&self) -> u64 {
        let declared = self.declared();
        self.data.block_function.iter().map(|&function| declared[function as usize]).sum()
    }

    /// The patches that meet each cell, as many as may be and no more.
    fn neighbours(&self) -> Vec<Vec<u32>> {
        let partition = self.step.partition.boxes();
        let supports: Vec<_> = (0..partition.len()).map(|i| partition.support(i)).collect();
        let (tree, mut pairs) = (BoxTree::new(&supports), 0);
        let mut all = Vec::with_capacity(partition.len());
        for cell in &partition.cell {
            let mut found = Vec::new();
            tree.query_box(cell, &mut found);
            pairs += found.len() as u64;
            all.push(found);
            if pairs > MOST_PAIRS {
                break;
            }
        }
        all
    }

    /// Operations of all evaluations of the field.
    fn operations(&self, neighbours: &[Vec<u32>]) -> u64 {
        let tree = BoxTree::new(&self.step.partition.boxes().cell);
        let declared = self.declared();
        let curves = self.curves();
        let work: Vec<_> = neighbours.iter().map(|patches| self.work(patches, &declared)).collect();
        let once = work.iter().fold(0u64, |sum, (work, _)| sum.saturating_add(*work));
        let (everywhere, mean) = (PLACES.saturating_mul(once), once / work.len().max(1) as u64);
        let along = CRACK_PLACES * mean * self.step.cracks.len() as u64;
        let mut sum = everywhere.saturating_add(along);
        for tip in tips(&self.step.cracks) {
            let mut cells = Vec::new();
            tree.query_box(&self.disc(tip), &mut cells);
            for (work, kinks) in cells.into_iter().map(|c| work[c as usize]) {
                let pieces = POINTS * (1 + kinks + curves);
                sum = sum.saturating_add(pieces.saturating_mul(work));
            }
            if sum > MOST_OPERATIONS {
                break;
            }
        }
        sum
    }

    /// The square around the largest disc that a tip may have.
    fn disc(&self, tip: TipId) -> Rect {
        let crack: &Crack = &self.step.cracks[tip.crack as usize];
        let radius = TipClearance::among_cracks(&self.step.cracks, &self.dataset.domain, tip)
            .radius
            .max(0.0);
        Rect::around(crack.end_point(tip.end), vec2(radius, radius).max(Vec2::ZERO))
    }

    /// Operations of an evaluation in a cell with these patches around it, and the number of kinks
    /// and singular points that their functions declare.
    fn work(&self, patches: &[u32], declared: &[u64]) -> (u64, u64) {
        let (mut groups, mut work) = (BTreeSet::new(), PATCH * patches.len() as u64);
        let mut functions = BTreeSet::new();
        for block in patches.iter().flat_map(|&patch| self.data.blocks(patch as usize)) {
            work += (monomials(self.data.block_degree[block].into()) * self.data.components.len())
                as u64;
            let function = self.data.block_function[block];
            functions.insert(function);
            if let Slot::Jet { group, .. } = self.table.of(function) {
                groups.insert(group);
            }
        }
        let groups = groups.into_iter().map(|g| self.table.cost(g as usize, &self.step.cracks));
        let coefficients = self.coefficients().map(|e| 3 * e.formula().text().len());
        work += groups.chain(coefficients).sum::<usize>() as u64;
        (work, functions.into_iter().map(|function| declared[function as usize]).sum())
    }
}
