//! The basis of one patch.

use super::confined::matrix;
use super::gram::Gram;
use super::held::{HeldFields, held_fields};
use super::tie::{self, tie};
use super::transform::{CUT_OFF, FunctionCombinations, Transform};
use super::williams::{fields, parts};
use crate::space::{KnownFunction, TrialSpace};
use faer::{Mat, MatRef};
use ppum_linear::{EigenError, SymmetricEigen, inverse_root_diagonal, times};
use std::borrow::Cow;

/// Functions N = T ψ of a patch, and what its unknowns are of them.
#[derive(Clone, Debug)]
pub(super) struct LocalBasis {
    /// T, shape [kept, functions].
    pub(super) matrix: Mat<f64>,
    /// The unknowns in terms of the functions of all components, where these share any: [unknowns,
    /// components · kept].
    pub(super) tie: Option<Mat<f64>>,
    /// The matrix that takes the functions of a field to the unknowns, where that is not the tie
    /// itself: its product with the transposed tie is the unit matrix.
    pub(super) inverse: Option<Mat<f64>>,
    tied: Option<TiedUnknowns>,
    /// Number of unknowns that were cut off for each component, or for all where they are tied.
    dropped: usize,
    /// The least eigenvalue that was kept, see [`Transform::least`].
    pub(super) least: f64,
}

/// The unknowns of a patch where components share any: first those of functions that each component
/// has for itself, component by component, then those of vector fields.
#[derive(Clone, Debug)]
struct TiedUnknowns {
    /// Number of functions that each component has for itself: the first ones. They are polynomials
    /// and jumps.
    scalar: usize,
    /// Number of plain functions that they are made of: the first ones.
    plain: usize,
    /// Each component of the fields in the plain functions, C_i T: [fields, functions].
    fields: [Mat<f64>; 2],
}

impl TiedUnknowns {
    /// The unknowns of a tie whose first rows are those of `scalar` functions of each component.
    fn new(tie: &Mat<f64>, matrix: &Mat<f64>, scalar: usize, plain: usize) -> Self {
        let kept = matrix.nrows();
        let rows =
            |i: usize| tie.submatrix(2 * scalar, i * kept, tie.nrows() - 2 * scalar, kept) * matrix;
        Self { scalar, plain, fields: [rows(0), rows(1)] }
    }
}

/// The unknowns of a patch as fields made of its plain functions.
#[derive(Clone, Copy)]
pub(crate) struct PatchFields<'a> {
    /// Functions that each component has for itself, of the first plain ones: [functions, plain].
    pub(crate) scalar: MatRef<'a, f64>,
    /// After those of all components, fields with two: each component [fields, plain].
    pub(crate) vector: Option<[MatRef<'a, f64>; 2]>,
}

impl PatchFields<'_> {
    /// Number of unknowns of a field of so many components.
    pub(crate) fn len(&self, components: usize) -> usize {
        components * self.scalar.nrows() + self.vectors()
    }

    /// Number of fields that have both components.
    pub(crate) fn vectors(&self) -> usize {
        self.vector.map_or(0, |[x, _]| x.nrows())
    }

    /// Number of plain functions.
    pub(crate) fn plain(&self) -> usize {
        self.vector.map_or(self.scalar.ncols(), |[x, _]| x.ncols())
    }
}

impl LocalBasis {
    /// The basis of a patch, of whose functions only some combinations may stay.
    ///
    /// # Errors
    /// Functions that are not finite.
    pub(super) fn new(
        space: &TrialSpace<'_>,
        patch: usize,
        gram: &Gram,
        confined: &[FunctionCombinations],
    ) -> Result<Self, EigenError> {
        if !space.held_lines(patch).is_empty() {
            let series = fields(space, patch).unwrap_or_default();
            let measures = (&gram.weighted, gram.plain.as_slice());
            return Ok(Self::of_fields(&held_fields(space, patch, measures, series)?, gram));
        }
        let series = parts(space, patch);
        let known = known(space, patch);
        let n_series: usize = series.iter().map(|(_, rows)| rows.nrows()).sum();
        let all: Vec<FunctionCombinations> =
            confined.iter().cloned().chain(known).chain(series).collect();
        let rows = (!all.is_empty()).then(|| matrix(space.evaluated(patch), &all));
        let first = rows.as_ref().map_or(space.evaluated(patch), Mat::nrows) - n_series;
        let transform = transform(gram, rows.as_ref(), [space.n_polynomials(patch), first])?;
        let lost: usize = confined.iter().map(|(range, rows)| range.len() - rows.nrows()).sum();
        let (dropped, least) = (transform.dropped + lost, transform.least);
        let (Some(fields), Some(rows)) = (fields(space, patch), &rows) else {
            let matrix = transform.matrix;
            return Ok(Self { matrix, tie: None, inverse: None, tied: None, dropped, least });
        };
        let tie = tie(gram.weighted.as_ref(), &transform, &fields)?;
        let wanted = fields.len() + 2 * (first + lost);
        let dropped = wanted - tie.nrows();
        let is_seen = |j: &usize| (0..first).any(|k| rows[(k, *j)] != 0.0);
        let plain = (0..rows.ncols()).rfind(is_seen).map_or(0, |last| last + 1);
        let tied = TiedUnknowns::new(&tie, &transform.matrix, transform.first, plain);
        let matrix = transform.matrix;
        Ok(Self { matrix, tie: Some(tie), inverse: None, tied: Some(tied), dropped, least })
    }

    /// The basis of fields. The functions are the plain ones, scaled.
    fn of_fields(HeldFields { parts, transform }: &HeldFields, gram: &Gram) -> Self {
        let scale = inverse_root_diagonal(gram.weighted.as_ref(), 0.0);
        let (n, m) = (scale.len(), transform.matrix.nrows());
        let fields = parts.each_ref().map(|part| &transform.matrix * part);
        let weighted = fields.each_ref().map(|part| part * &gram.weighted);
        let of_scaled = |k: usize, j: usize| match scale[j % n] {
            0.0 => 0.0,
            scale => fields[j / n][(k, j % n)] / scale,
        };
        Self {
            matrix: Mat::from_fn(n, n, |k, j| if k == j { scale[k] } else { 0.0 }),
            tie: Some(Mat::from_fn(m, 2 * n, of_scaled)),
            inverse: Some(Mat::from_fn(m, 2 * n, |k, j| {
                weighted[j / n][(k, j % n)] * scale[j % n]
            })),
            tied: Some(TiedUnknowns { scalar: 0, plain: 0, fields }),
            dropped: transform.dropped,
            least: transform.least,
        }
    }

    /// Returns the unknowns, or all functions in each component where `tied` is false.
    pub(super) fn fields(&self, tied: bool) -> PatchFields<'_> {
        match self.tied.as_ref().filter(|_| tied) {
            None => PatchFields { scalar: self.matrix.as_ref(), vector: None },
            Some(TiedUnknowns { scalar, plain, fields }) => PatchFields {
                scalar: self.matrix.submatrix(0, 0, *scalar, *plain),
                vector: Some(fields.each_ref().map(|part| part.as_ref())),
            },
        }
    }

    /// Number of functions.
    pub(super) fn len(&self) -> usize {
        self.matrix.nrows()
    }

    /// Number of unknowns.
    pub(super) fn unknowns(&self, components: usize) -> usize {
        self.tie.as_ref().map_or(components * self.len(), Mat::nrows)
    }

    /// Number of unknowns cut off.
    pub(super) fn cut_off(&self, components: usize) -> usize {
        if self.tie.is_some() { self.dropped } else { components * self.dropped }
    }

    /// Makes the functions orthonormal in their Gram matrix `gram`, and keeps their span.
    ///
    /// # Errors
    /// Functions that are not finite.
    pub(super) fn rescale(&mut self, gram: MatRef<'_, f64>) -> Result<(), EigenError> {
        let eigen = SymmetricEigen::new(gram)?;
        let root = &eigen.vectors * eigen.inverse_root(0.0);
        if let Some(tie) = &mut self.tie {
            *tie = tie::renewed(tie, gram, root.as_ref())?;
            self.inverse = None;
        }
        self.matrix = root * &self.matrix;
        self.tied = self.tie.as_ref().map(|tie| TiedUnknowns::new(tie, &self.matrix, 0, 0));
        Ok(())
    }

    /// The coefficients of the functions ψ in each component from the unknowns.
    pub(super) fn plain(&self, unknowns: &[f64], components: usize) -> Vec<Vec<f64>> {
        let free = match &self.tie {
            Some(tie) => Cow::Owned(times(tie.as_ref(), unknowns)),
            None => Cow::Borrowed(unknowns),
        };
        (0..components)
            .map(|i| times(self.matrix.as_ref(), &free[i * self.len()..(i + 1) * self.len()]))
            .collect()
    }
}

/// Functions whose coefficients are known: no combination of them has an unknown.
fn known(space: &TrialSpace<'_>, patch: usize) -> Vec<FunctionCombinations> {
    let part = |known: &KnownFunction| (known.evaluated..known.evaluated + 1, Mat::zeros(0, 1));
    space.known(patch).iter().map(part).collect()
}

/// The transformation of a patch, of whose functions only some combinations may stay.
fn transform(
    gram: &Gram,
    kept: Option<&Mat<f64>>,
    stages: [usize; 2],
) -> Result<Transform, EigenError> {
    let Gram { weighted, plain, .. } = gram;
    let Some(rows) = kept else {
        return Transform::new(weighted.as_ref(), plain, stages, CUT_OFF);
    };
    let square = |k: usize| plain.iter().enumerate().map(|(j, n2)| rows[(k, j)].powi(2) * n2).sum();
    let plain: Vec<f64> = (0..rows.nrows()).map(square).collect();
    let weighted = rows * weighted * rows.transpose();
    let transform = Transform::new(weighted.as_ref(), &plain, stages, CUT_OFF)?;
    Ok(Transform { matrix: transform.matrix * rows, ..transform })
}
