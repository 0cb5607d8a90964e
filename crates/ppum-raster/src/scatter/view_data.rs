//! The data that all tiles of a view share.

use ppum::field::Field;
use ppum::function::LocalFunctions;
use ppum::quantity::Quantity;
use ppum::real::{LaneNumber, Real};
use ppum::weight::WeightFunction;

use super::collapse::ROWS;
use super::plan::{COLUMNS, ViewPlan};
use super::weights::PixelWeights;
use crate::summation::{Savings, Summation};
use crate::view::View;

/// Pixels of a patch, on average, below which the patches of an image are summed one by one.
const MOST_PIXELS: usize = 4;

/// A view of a field, ready to be drawn.
pub(super) struct PreparedView<'f, T> {
    pub(super) view: View,
    pub(super) quantity: &'f Quantity,
    pub(super) weight: &'f WeightFunction,
    /// Its factors, if it is a formula.
    pub(super) weights: PixelWeights<T>,
    pub(super) functions: LocalFunctions<'f>,
    pub(super) plan: ViewPlan<'f>,
    /// Offsets of the columns from the view's centre, up to full tiles.
    pub(super) xs: Vec<T>,
    /// Offsets of the rows.
    pub(super) ys: Vec<T>,
    pub(super) savings: Savings,
    pub(super) field: &'f Field<'f>,
}

impl<'f, T: LaneNumber> PreparedView<'f, T> {
    pub(super) fn new(
        field: &'f Field<'f>,
        view: &View,
        quantity: &'f Quantity,
        summation: Summation,
    ) -> Self {
        let functions = field.functions.at(&field.step.cracks, view.center);
        let mut groups = 0..functions.table().groups();
        let (most_pixels, savings) = match summation {
            Summation::Automatic if groups.all(|group| functions.is_native(group)) => {
                (MOST_PIXELS, Savings::ALL)
            }
            // formulas are run for many pixels of spans at a time, and would be dear one by one
            Summation::Automatic => (0, Savings::ALL),
            Summation::RowSpans(savings) => (0, savings),
            Summation::PerPatch => (usize::MAX, Savings::ALL),
        };
        let mut plan = ViewPlan::new(field, view, quantity, ROWS, most_pixels);
        let weight = &field.step.partition.boxes().weight;
        let columns = view.pixels[0].next_multiple_of(COLUMNS as u32);
        let rows = view.pixels[1].next_multiple_of(ROWS as u32);
        Self {
            view: *view,
            quantity,
            weight,
            weights: PixelWeights::new(weight, view, &mut plan.patches),
            functions,
            plan,
            xs: (0..columns).map(|i| T::from_f64(view.column_offset(i))).collect(),
            ys: (0..rows).map(|j| T::from_f64(view.row_offset(j))).collect(),
            savings,
            field,
        }
    }
}

impl<T: LaneNumber> PreparedView<'_, T> {
    /// Exact values minus `shift` at the pixels of a vector, component by component.
    pub(super) fn load_exact<R: Real<Scalar = T>>(
        &self,
        [column, row]: [usize; 2],
        shift: &[f64],
        out: &mut [R],
        zero: R,
    ) {
        let point = |lane| self.view.center + self.view.offset((column + lane) as u32, row as u32);
        for (component, (out, shift)) in out.iter_mut().zip(shift).enumerate() {
            *out = zero.with_lanes(|lane| self.field.exact(component, point(lane)) - shift);
        }
    }
}
