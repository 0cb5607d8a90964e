//! Springs on the unknowns of single patches, which hold rigid motions of pieces.

use faer::Mat;
use ppum_linear::BlockMatrix;

/// A functional of the unknowns of one patch.
pub(super) struct PatchFunctional {
    pub(super) patch: usize,
    pub(super) functional: Vec<f64>,
}

/// A spring on unknowns of single patches.
pub struct Spring(Vec<(usize, Mat<f64>)>);

/// The moments of the free modes of one piece.
pub(super) struct PieceMoments<'m> {
    pub(super) moments: &'m [Vec<f64>],
    pub(super) matrix: &'m BlockMatrix,
}

impl PieceMoments<'_> {
    /// The patch on which the modes are largest and least alike.
    pub(super) fn firmest(&self) -> usize {
        let volume = |patch: usize| {
            let range = self.matrix.unknowns(patch);
            let rows: Vec<_> = self.moments.iter().map(|row| &row[range.clone()]).collect();
            Mat::from_fn(rows.len(), rows.len(), |k, l| dot(rows[k], rows[l])).determinant()
        };
        let all = (0..self.matrix.n_blocks()).map(|patch| (patch, volume(patch)));
        all.fold((0, 0.0), |best, new| if new.1 > best.1 { new } else { best }).0
    }

    /// A combination of the moments on a patch.
    pub(super) fn holder(&self, patch: usize, factors: &[f64]) -> PatchFunctional {
        let entry = |unknown: usize| {
            self.moments.iter().zip(factors).map(|(row, factor)| factor * row[unknown]).sum()
        };
        PatchFunctional { patch, functional: self.matrix.unknowns(patch).map(entry).collect() }
    }
}

impl Spring {
    /// Returns for each patch γ Σ_k r_k r_kᵀ, with a part of its largest stiffness over |r|² for γ.
    pub(super) fn new(holders: &[PatchFunctional], part: f64, matrix: &BlockMatrix) -> Self {
        let of_patch = |rows: &[PatchFunctional]| {
            let patch = rows[0].patch;
            let rows: Vec<_> = rows.iter().map(|holder| &holder.functional).collect();
            let length = rows.iter().copied().flatten().fold(0.0f64, |m, v| m.max(v * v));
            let stiffness = matrix.block(patch, patch).expect("a patch is coupled to itself");
            let n = stiffness.nrows();
            let gamma = part * (0..n).map(|k| stiffness[(k, k)]).fold(0.0, f64::max) / length;
            let entry = |a, b| gamma * rows.iter().map(|r| r[a] * r[b]).sum::<f64>();
            (patch, Mat::from_fn(n, n, entry))
        };
        Self(holders.chunk_by(|a, b| a.patch == b.patch).map(of_patch).collect())
    }

    /// True if nothing is held.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds the spring to a matrix.
    pub fn add_to(&self, matrix: &mut BlockMatrix) {
        self.0.iter().for_each(|(patch, block)| matrix.add_block(*patch, *patch, block.as_ref()));
    }
}

/// The scalar product, as far as both reach.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
