//! Whether to divide a cell or to raise its order.

use super::decay::{rate, squares};
use crate::corner::corners;
use crate::space::{CellChange, TrialSpace};
use ppum::crack::{TipId, tips};
use ppum::dataset::{FieldData, MAX_DEGREE};
use ppum::field::Field;
use ppum::function::FunctionKind;
use ppum::vec2::Vec2;
use ppum_problem::geometry::{BoxList, around};
use ppum_problem::{AdaptKind, Problem};

/// The rate σ of the decay of Legendre coefficients from which on a field counts as smooth: each is
/// less than exp(−1) of the one before.
const SMOOTH: f64 = 1.0;

/// Says what to do about cells.
pub struct Adviser<'a> {
    kind: AdaptKind,
    field: &'a Field<'a>,
    space: &'a TrialSpace<'a>,
    /// Where the field is singular.
    singular: BoxList<Vec2>,
}

/// Tips, and what else is singular: functions times a few polynomials do not make the rest smooth.
pub(super) fn singular_points(problem: &Problem) -> BoxList<Vec2> {
    let place = |tip: TipId| problem.cracks()[tip.crack as usize].end_point(tip.end);
    // where tips have their series, the rest of the field is smooth
    let bare_tips = tips(problem.cracks()).filter(|_| !problem.has_tip_series()).map(place);
    let others = corners(problem).into_iter().map(|corner| corner.at);
    BoxList::new(bare_tips.chain(others).map(|point| (around(&[point]), point)))
}

impl<'a> Adviser<'a> {
    /// Finds the points near which the field is singular.
    pub fn new(
        kind: AdaptKind,
        problem: &'a Problem,
        field: &'a Field<'a>,
        space: &'a TrialSpace<'a>,
    ) -> Self {
        Self { kind, field, space, singular: singular_points(problem) }
    }

    /// Returns the change that a cell needs, if it is possible.
    pub fn advice(&self, cell: usize) -> CellChange {
        let can_rise = self.space.order(cell) < MAX_DEGREE;
        match self.kind {
            AdaptKind::H => CellChange::Divide,
            AdaptKind::P if can_rise => CellChange::Raise,
            AdaptKind::P => CellChange::Keep,
            AdaptKind::Hp if can_rise && self.is_smooth(cell) => CellChange::Raise,
            AdaptKind::Hp => CellChange::Divide,
        }
    }

    /// True if no singular point lies in a patch, and its coefficients decay fast. Two orders are
    /// too few to estimate the decay: then true, and a third one will decide.
    fn is_smooth(&self, patch: usize) -> bool {
        let support = self.space.partition().support(patch);
        if self.singular.near(&support).next().is_some() {
            return false;
        }
        rate(&self.squares(patch)).is_none_or(|rate| rate >= SMOOTH)
    }

    /// The squares of the Legendre coefficients of a patch by their degree: of its polynomials and
    /// of what jumps across cracks, not of other functions.
    fn squares(&self, patch: usize) -> Vec<f64> {
        let data = self.field.data;
        let partition = self.space.partition();
        // the patch is [-1, 1]² in the coordinates of its polynomials
        let part = 0.5 * partition.cell[patch].size().x / partition.scale[patch].x;
        let mut sums = vec![0.0; self.space.order(patch) + 1];
        for block in data.blocks(patch).filter(|&block| self.is_polynomial(data, block)) {
            let degree = usize::from(data.block_degree[block]);
            for component in 0..data.coefficients.len() {
                let own = squares(data.block_coefficients(block, component), degree, part);
                sums.iter_mut().zip(own).for_each(|(sum, square)| *sum += square);
            }
        }
        sums
    }

    /// True if the function of a block is a constant on each side of cracks.
    fn is_polynomial(&self, data: &FieldData, block: usize) -> bool {
        let function = data.block_function[block] as usize;
        !matches!(self.field.step.functions[function].kind, FunctionKind::Formula { .. })
    }
}
