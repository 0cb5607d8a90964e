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

    /// Rules that resolve G in a cell: those of the system leave 1e-5 of a factor, which estimates
    /// of errors do not see.
    fn rules(&self, cell: usize) -> Vec<CellRule>;

    /// G of both modes at the points of a rule, times their weights.
    fn kernels(&self, rule: &CellRule) -> Vec<[Stress; FACTORS]>;
}

/// The factors of all tips as functionals: K(N) of both modes is integrated with the system, summed
/// over the tips or for each tip.
pub struct DualLoads<'a> {
    tips: Vec<&'a dyn LinearFunctional>,
    /// For each cell, the tips whose discs it meets.
    near: Vec<Vec<u32>>,
    /// True if each tip has functionals of its own.
    are_separate: bool,
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
        Self { tips, near, are_separate: false }
    }

    /// The functionals of each tip, those of the first tip first, in place of their sums.
    #[must_use]
    pub fn separate(self) -> Self {
        Self { are_separate: true, ..self }
    }

    /// Number of functionals.
    pub(super) fn len(&self) -> usize {
        FACTORS * if self.are_separate { self.tips.len() } else { self.tips.len().min(1) }
    }

    /// True if no tip has a part of its factors in a cell.
    pub(super) fn is_far(&self, cell: usize) -> bool {
        self.near[cell].is_empty()
    }

    /// Adds the points of a rule of a cell to the parts of both modes, unless tips have rules of
    /// their own; shapes are those of the rule's patches, `numbers` their places in a part.
    pub(super) fn add(
        &self,
        (cell, rule): (usize, &CellRule),
        shapes: &Shapes,
        numbers: &[usize],
        parts: &mut [Vec<f64>],
    ) {
        for &tip in self.near[cell].iter().filter(|_| !self.are_separate) {
            self.add_tip((tip, rule), shapes, numbers, parts);
        }
    }

    /// The rules of the functionals of each tip in a cell, with the number of the tip.
    pub(super) fn own_rules(&self, cell: usize) -> Vec<(u32, CellRule)> {
        let near = self.near[cell].iter().filter(|_| self.are_separate);
        let of_tip =
            |&tip: &u32| self.tips[tip as usize].rules(cell).into_iter().map(move |r| (tip, r));
        near.flat_map(of_tip).collect()
    }

    /// Adds the points of a rule to the parts of both modes of a tip.
    pub(super) fn add_tip(
        &self,
        (tip, rule): (u32, &CellRule),
        shapes: &Shapes,
        numbers: &[usize],
        parts: &mut [Vec<f64>],
    ) {
        let first = if self.are_separate { FACTORS * tip as usize } else { 0 };
        let Some([one, two, ..]) = parts.get_mut(first..) else { return };
        shapes.add_stresses(&self.tips[tip as usize].kernels(rule), numbers, [one, two]);
    }
}
