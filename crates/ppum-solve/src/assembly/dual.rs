//! Loads whose solutions are dual to stress intensity factors: K(v) = a(v, z) for all v.

use crate::basis::Shapes;
use crate::law::Stress;
use crate::quadrature::CellRule;
use crate::space::TrialSpace;
use ppum_problem::geometry::BoxList;

/// The modes I and II.
pub const FACTORS: usize = 2;

/// The stress intensity factors of one tip as linear functionals K_m(v) = ∫ G_m : ∇v dA: the work
/// of stresses G_m on strains.
pub trait LinearFunctional: Sync {
    /// The cells in which G is not zero.
    fn cells(&self, cells: &BoxList<usize>) -> Vec<usize>;

    /// G of both modes at the points of a rule, times their weights.
    fn kernels(&self, rule: &CellRule) -> Vec<[Stress; FACTORS]>;
}

/// The factors of all tips as functionals: K(N) of both modes is integrated with the system, summed
/// over the tips.
pub struct DualLoads<'a> {
    tips: Vec<&'a dyn LinearFunctional>,
    /// For each cell, the tips whose discs it meets.
    near: Vec<Vec<u32>>,
}

impl<'a> DualLoads<'a> {
    /// Finds the cells that each functional is integrated over.
    pub fn new(tips: Vec<&'a dyn LinearFunctional>, space: &TrialSpace<'_>) -> Self {
        let cells = &space.partition().cell;
        let mut near = vec![Vec::new(); cells.len()];
        let placed = BoxList::new(cells.iter().copied().zip(0..));
        for (k, tip) in (0..).zip(&tips) {
            tip.cells(&placed).into_iter().for_each(|cell| near[cell].push(k));
        }
        Self { tips, near }
    }

    /// Number of functionals.
    pub(super) fn len(&self) -> usize {
        if self.tips.is_empty() { 0 } else { FACTORS }
    }

    /// True if no tip has a part of its factors in a cell.
    pub(super) fn is_far(&self, cell: usize) -> bool {
        self.near[cell].is_empty()
    }

    /// Adds the points of a rule of a cell to the parts of both modes; shapes are those of the
    /// rule's patches, `numbers` their places in a part.
    pub(super) fn add(
        &self,
        (cell, rule): (usize, &CellRule),
        shapes: &Shapes,
        numbers: &[usize],
        parts: &mut [Vec<f64>],
    ) {
        for &tip in &self.near[cell] {
            let [one, two] = parts else { return };
            shapes.add_stresses(&self.tips[tip as usize].kernels(rule), numbers, [one, two]);
        }
    }
}
