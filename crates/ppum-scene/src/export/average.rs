//! One value where several triangles meet, the mean of theirs.
//!
//! Where a quantity jumps for the approximation alone, programs that follow surfaces find each cell
//! by itself: its edges look like edges of the body. With means a mesh is in one piece, and differs
//! from the field by half of the jumps.

use ppum::quantity::Quantity;

use super::elements::{ElementPlace, evaluate_elements};
use super::refine::RefinedMesh;
use super::torn::ValueSide;

impl RefinedMesh<'_, '_> {
    /// For each point the first one that shares its place and the value of the field. A field that
    /// jumps between elements by more than the tolerance stays apart: it may be cracked there.
    pub(super) fn together(&self, cells: &[u32]) -> Vec<usize> {
        let components = self.field.components();
        let rows = self.component_rows();
        let ranges: Vec<f64> = (0..components)
            .map(|c| {
                let column = rows.iter().skip(c).step_by(components).copied();
                let [low, high] = column
                    .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| {
                        [f64::min(low, v), f64::max(high, v)]
                    });
                high - low
            })
            .collect();
        let largest = ranges.into_iter().fold(0.0, f64::max);
        let agree = |a: usize, b: usize| {
            let row = |point: usize| rows.get(point * components..(point + 1) * components);
            let mut pairs = row(a).into_iter().flatten().zip(row(b).into_iter().flatten());
            pairs.all(|(a, b)| (a - b).abs() <= self.limits.tolerance * largest)
        };
        self.mesh.together(cells, &self.cell, &agree)
    }

    /// The field at all points of elements; nothing for a cover, whose field jumps at cracks alone.
    fn component_rows(&self) -> Vec<f64> {
        let all = (0..self.field.components() as u8).map(Quantity::Component).collect::<Vec<_>>();
        let places = self.mesh.points.iter().filter_map(|point| match point.seen {
            ValueSide::Element(place) => Some(place),
            ValueSide::Plane { .. } => None,
        });
        let places: Vec<ElementPlace> = places.collect();
        evaluate_elements(self.field, &all, &places)
    }

    /// Gives all points that lead to the same one the mean of their values.
    pub(super) fn average(&mut self, together: &[usize]) {
        let width = self.columns.len();
        let mut sums = vec![0.0; self.values.len()];
        let mut counts = vec![0.0; together.len()];
        for (row, &first) in self.values.chunks(width).zip(together) {
            counts[first] += 1.0;
            let sum = &mut sums[first * width..][..width];
            sum.iter_mut().zip(row).for_each(|(sum, value)| *sum += value);
        }
        for (row, &first) in self.values.chunks_mut(width).zip(together) {
            let sum = &sums[first * width..][..width];
            row.iter_mut().zip(sum).for_each(|(value, sum)| *value = sum / counts[first]);
        }
    }

    /// Leaves one of all points that lead to the same one.
    pub(super) fn share_points(&mut self, together: &[usize], cells: &mut [u32]) {
        let width = self.columns.len();
        let mut numbers = vec![0; together.len()];
        let kept: Vec<usize> =
            (0..together.len()).filter(|&point| together[point] == point).collect();
        (0..).zip(&kept).for_each(|(number, &point)| numbers[point] = number);
        cells.iter_mut().for_each(|point| *point = numbers[together[*point as usize]]);
        self.values =
            kept.iter().flat_map(|&p| &self.values[p * width..][..width]).copied().collect();
        self.mesh.points = kept.iter().map(|&point| self.mesh.points[point]).collect();
    }
}
