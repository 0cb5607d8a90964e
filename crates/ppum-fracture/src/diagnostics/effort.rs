//! The effort of finding the stress intensity factors of a dataset's step again, known before
//! anything of it is done.
//!
//! Factors are integrals over all cells in a disc, and a file of some kilobytes can ask for a
//! hundred thousand tips in a hundred thousand cells. What is looked at, and how often, is added up
//! here from sizes alone, in operations, and compared with one bound that is above what solved
//! problems take: a plate of a million patches with a few cracks and holes, or of a hundred
//! thousand patches with a thousand cracks, stays below it.

use super::faces::SAMPLES;
use crate::intensity::with_cells;
use ppum::box_tree::BoxTree;
use ppum::crack::{Crack, TipId, tips};
use ppum::dataset::{Dataset, FieldData, Step, monomials};
use ppum::domain::Hole;
use ppum::expression::Expression;
use ppum::function::{FunctionError, FunctionKind, FunctionTable, Slot};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::Problem;
use ppum_problem::geometry::TipClearance;
use ppum_solve::smoothness::COMPARED;
use std::collections::BTreeSet;

/// Most operations: ten minutes, of which a vector does several at once.
const MOST: f64 = (1_u64 << 40) as f64;

/// Operations that a comparison counts as, of which no vector does several: comparisons alone take
/// ten seconds at most.
const COMPARISON: f64 = (1 << 6) as f64;

/// Operations that a pair in a list counts as: lists alone take 256 MiB at most.
const PAIR: f64 = (1 << 14) as f64;

/// Places at which a field is looked at in a cell for warnings, and looks at each rim from there.
const PLACES: f64 = 32.0;

/// Looks at each segment from a segment behind a kink: both faces, in the cells that it may meet.
const FACE_LOOKS: f64 = 8.0;

/// Quadrature points in a cell of a disc: twelve in each direction of nine pieces.
const POINTS: f64 = 9.0 * 144.0;

/// Comparisons at a corner of the border for each condition on it.
const CORNER_LOOKS: f64 = (1 << 12) as f64;

/// Finding a patch at a point, and its weight.
const PATCH: usize = 16;

/// Finding the factors takes too much.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EffortError {
    /// There are too many operations.
    #[error(
        "{tips} tips in {cells} cells take {operations:.1e} operations, but at most {most:.1e} are done"
    )]
    TooMuch {
        /// Tips of the step.
        tips: usize,
        /// Cells of the step.
        cells: usize,
        /// The operations, or those of a part that is too much by itself.
        operations: f64,
        /// The most that are done.
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
/// Too many operations; a function that does not compile.
///
/// # Panics
/// If there is no such step, or it has no field.
pub fn check_effort(
    dataset: &Dataset,
    step: usize,
    problem: Option<&Problem>,
) -> Result<(), EffortError> {
    let (cells, number) = with_cells(dataset, step);
    let (dataset, step) = (&*cells, &cells.steps[number]);
    let table = FunctionTable::new(&step.functions, step.cracks.len(), &dataset.tables)?;
    let count = Count { dataset, step, data: &step.fields[0], table };
    let operations = count.operations(problem);
    if operations <= MOST {
        return Ok(());
    }
    let (tips, cells) = (tips(&step.cracks).count(), step.partition.len());
    Err(EffortError::TooMuch { tips, cells, operations, most: MOST })
}

struct Count<'d> {
    dataset: &'d Dataset,
    step: &'d Step,
    data: &'d FieldData,
    table: FunctionTable,
}

impl Count<'_> {
    /// All operations, or as many as are known to be too many.
    fn operations(&self, problem: Option<&Problem>) -> f64 {
        let sum = COMPARISON * self.comparisons(problem) + PAIR * self.kinks_of_patches();
        if sum > MOST {
            return sum;
        }
        let neighbours = self.neighbours();
        let sum = sum + PAIR * neighbours.iter().map(Vec::len).sum::<usize>() as f64;
        if sum > MOST { sum } else { sum + self.evaluations(&neighbours) }
    }

    /// Circles and corners of holes.
    fn rims(&self) -> f64 {
        let corners = |hole: &Hole| match hole {
            Hole::Circle { .. } => 1,
            Hole::Polygon { points, .. } => points.len(),
        };
        self.dataset.domain.holes.iter().map(corners).sum::<usize>() as f64
    }

    fn segments(&self) -> f64 {
        self.step.cracks.iter().map(|crack| crack.points.len()).sum::<usize>() as f64
    }

    /// Comparisons of everything with everything.
    fn comparisons(&self, problem: Option<&Problem>) -> f64 {
        let (n_tips, cells) =
            (tips(&self.step.cracks).count() as f64, self.step.partition.len() as f64);
        let (segments, rims, curves) = (self.segments(), self.rims(), self.curves());
        let kinks: f64 = self.declared().iter().sum();
        // rules along the faces behind kinks look at all segments
        let behind =
            |tip: TipId| self.step.cracks[tip.crack as usize].points.len().saturating_sub(2);
        let behind = tips(&self.step.cracks).map(behind).sum::<usize>() as f64;
        // each condition has two ends
        let conditions = problem.map_or(0.0, |problem| problem.boundary.len() as f64);
        n_tips * (cells + segments + rims)
            + PLACES * cells * rims
            + kinks * kinks
            + curves * curves * (2 * COMPARED * COMPARED) as f64
            + FACE_LOOKS * behind * segments
            + CORNER_LOOKS * conditions * (2.0 * conditions + rims)
    }

    /// Curves on which the coefficients of the equation may have kinks.
    fn curves(&self) -> f64 {
        self.coefficients().map(|e| e.formula().kinks().len()).sum::<usize>() as f64
    }

    fn coefficients(&self) -> impl Iterator<Item = &Expression> {
        let all = self.dataset.equation.constants().map(|(_, expression)| expression);
        all.filter(|expression| expression.constant().is_none())
    }

    /// Of each function the number of kinks and singular points that it declares.
    fn declared(&self) -> Vec<f64> {
        let of = |kind: &FunctionKind| match kind {
            FunctionKind::Formula { declared, .. } => {
                declared.kinks.len() + declared.singular.len()
            }
            _ => 0,
        };
        self.step.functions.iter().map(|function| of(&function.kind) as f64).collect()
    }

    fn kinks_of_patches(&self) -> f64 {
        let declared = self.declared();
        self.data.block_function.iter().map(|&function| declared[function as usize]).sum()
    }

    /// The patches that meet each cell, as many as may be and no more.
    fn neighbours(&self) -> Vec<Vec<u32>> {
        if self.step.partition.mesh().is_some() {
            return (0..self.step.partition.len() as u32).map(|patch| vec![patch]).collect();
        }
        let partition = self.step.partition.boxes();
        let supports: Vec<_> = (0..partition.len()).map(|i| partition.support(i)).collect();
        let (tree, mut pairs) = (BoxTree::new(&supports), 0);
        let mut all = Vec::with_capacity(partition.len());
        for cell in &partition.cell {
            let mut found = Vec::new();
            tree.query_box(cell, &mut found);
            pairs += found.len();
            all.push(found);
            if PAIR * pairs as f64 > MOST {
                break;
            }
        }
        all
    }

    /// Operations of all evaluations of the field: at places in cells and along cracks, and at the
    /// points in discs.
    fn evaluations(&self, neighbours: &[Vec<u32>]) -> f64 {
        let declared = self.declared();
        let work: Vec<_> = neighbours.iter().map(|patches| self.work(patches, &declared)).collect();
        let once: f64 = work.iter().map(|(work, _)| work).sum();
        let mut sum = PLACES * once + self.crack_places() * once / work.len().max(1) as f64;
        let cells = BoxTree::new(&self.step.partition.cells());
        for tip in tips(&self.step.cracks) {
            let work = self.cells_of(tip, &cells).into_iter().map(|cell| work[cell as usize]);
            sum += work.map(|(work, kinks)| self.points(kinks) * work).sum::<f64>();
            if sum > MOST {
                break;
            }
        }
        sum
    }

    /// Places along cracks, on both faces.
    fn crack_places(&self) -> f64 {
        2.0 * (SAMPLES * self.step.cracks.len()) as f64 + 2.0 * self.segments()
    }

    /// Points in a cell of a disc with so many kinks.
    fn points(&self, kinks: f64) -> f64 {
        POINTS * (1.0 + kinks + self.curves())
    }

    fn cells_of(&self, tip: TipId, cells: &BoxTree) -> Vec<u32> {
        let mut found = Vec::new();
        cells.query_box(&self.disc(tip), &mut found);
        found
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
    fn work(&self, patches: &[u32], declared: &[f64]) -> (f64, f64) {
        let (mut groups, mut work) = (BTreeSet::new(), PATCH * patches.len());
        let mut functions = BTreeSet::new();
        for block in patches.iter().flat_map(|&patch| self.data.blocks(patch as usize)) {
            work += monomials(self.data.block_degree[block].into()) * self.data.components.len();
            let function = self.data.block_function[block];
            functions.insert(function);
            if let Slot::Jet { group, .. } = self.table.of(function) {
                groups.insert(group);
            }
        }
        let groups = groups.into_iter().map(|g| self.table.cost(g as usize, &self.step.cracks));
        let coefficients = self.coefficients().map(|e| 3 * e.formula().text().len());
        work += groups.chain(coefficients).sum::<usize>();
        (work as f64, functions.into_iter().map(|function| declared[function as usize]).sum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostics::faces::places;
    use crate::intensity::{TipLoads, TipOutcome, intensities};
    use crate::solve::Plan;
    use ppum::field::Field;
    use ppum::progress::unwatched;
    use ppum_problem::Problem;
    use ppum_solve::space::Space;
    use ppum_testkit::random::Random;
    use std::path::Path;
    use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

    /// A plate with up to three random cracks, one above the other, and a cell size of its own.
    fn plate(random: &mut Random) -> Problem {
        let mut text = format!(
            "[domain]\nmin = [-1, -1]\nmax = [1, 1]\n[material]\nyoung = 1\npoisson = 0.3\nstate = \"plane-strain\"\n\
             [[boundary]]\non = \"top\"\ntraction = [0, 1]\n[discretization]\nlevel = {}\n",
            3 + random.below(3)
        );
        for k in 0..1 + random.below(3) {
            let from = random.between(-0.9, -0.1);
            let mut point = |part: usize| {
                let x = from + 0.3 * part as f64;
                [x, -0.6 + 0.6 * k as f64 + random.between(-0.15, 0.15)]
            };
            let points: Vec<_> = (0..4).map(&mut point).collect();
            text += &format!("[[crack]]\npoints = {points:?}\n");
        }
        Problem::parse(&text, "plate", Path::new(".")).expect("a problem")
    }

    /// A body force of nothing that counts where it is asked for.
    struct Counted(AtomicUsize);

    impl TipLoads for Counted {
        fn body_force(&self, _: Vec2) -> Option<[f64; 2]> {
            self.0.fetch_add(1, Relaxed);
            Some([0.0; 2])
        }
    }

    /// The points in the discs of all tips, counted by a body force, and the bound of their number.
    fn points(count: &Count<'_>) -> [f64; 2] {
        let Count { dataset, step, .. } = *count;
        let space = Space::new(step, &dataset.domain, &dataset.equation, &[]).expect("a space");
        let field = Field::new(dataset, 0).expect("a field");
        let loads = Counted(AtomicUsize::new(0));
        let tips = intensities(dataset, &field, &space, &loads, unwatched()).expect("factors");
        let cells = BoxTree::new(&step.partition.boxes().cell);
        let with_factors = tips.iter().filter(|outcome| outcome.factors.is_some());
        let of_tip = |outcome: &TipOutcome| count.cells_of(outcome.tip, &cells).len() as f64;
        let bound = with_factors.map(of_tip).sum::<f64>() * count.points(0.0);
        [loads.0.into_inner() as f64, bound]
    }

    /// No more is looked at than is bounded, and not far less.
    #[test]
    fn points_and_places_are_bounded() {
        let mut random = Random(12);
        for _ in 0..4 {
            let problem = plate(&mut random);
            let plan = Plan::new(&problem, None, unwatched()).expect("a plan");
            let (dataset, step) = (plan.dataset(), &plan.dataset().steps[0]);
            let table = FunctionTable::new(&step.functions, step.cracks.len(), &[]);
            let table = table.expect("functions that compile");
            let count = Count { dataset, step, data: &step.fields[0], table };
            let [counted, bound] = points(&count);
            assert!(counted <= bound && bound < 50.0 * counted, "{counted} points of {bound}");
            let cracks = step.cracks.iter().enumerate();
            let along =
                2.0 * cracks.map(|(k, crack)| places(crack, k).count()).sum::<usize>() as f64;
            let bound = count.crack_places();
            assert!(along <= bound && bound < 1.1 * along, "{along} places of {bound}");
        }
    }
}
