//! One value where several triangles meet, the mean of theirs.
//!
//! Where a quantity jumps for the approximation alone, programs that follow surfaces find each cell
//! by itself: its edges look like edges of the body. With means a mesh is in one piece, and differs
//! from the field by half of the jumps.

use super::refine::Refined;

impl Refined<'_, '_> {
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
