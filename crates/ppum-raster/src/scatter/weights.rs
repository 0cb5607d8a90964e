//! Weights by formula at the columns and rows of a view, found once: a weight is a product of a
//! factor in x and one in y, and most patches share theirs with others above or beside them.

use std::collections::HashMap;
use std::ops::Range;

use ppum::real::{LaneNumber, Real};
use ppum::weight::WeightFunction;

use super::collapse::WeightFactor;
use super::plan::{Affine, VisiblePatch};
use crate::view::View;

/// Most numbers that are kept: 128 MiB of f64. Covers made of halved squares need some thousands.
const MOST: usize = 1 << 24;

/// Factors with their slopes, by pixels of one direction.
#[derive(Debug, Default)]
pub(super) struct PixelWeights<T> {
    values: Vec<T>,
    slopes: Vec<T>,
}

/// The numbers that a factor depends on, and the pixels where it is needed.
type FactorKey = (u64, u64, u32, u32);

impl<T: LaneNumber> PixelWeights<T> {
    /// The factors of patches that are formulas; of other kinds there are none. Supports learn
    /// where theirs are.
    pub(super) fn new(weight: &WeightFunction, view: &View, patches: &mut [VisiblePatch]) -> Self {
        let mut weights = Self::default();
        if !matches!(weight, WeightFunction::Formula(_)) {
            return weights;
        }
        let mut known: [HashMap<FactorKey, Option<u32>>; 2] = Default::default();
        for patch in patches {
            let pixels = [&patch.columns, &patch.rows].map(whole_vectors::<T>);
            for (axis, pixels) in pixels.into_iter().enumerate() {
                let support = &mut patch.support[axis];
                let bits = [support.scale, support.shift].map(f64::to_bits);
                let key = (bits[0], bits[1], pixels.start, pixels.end);
                support.table = *known[axis].entry(key).or_insert_with(|| {
                    let offset =
                        |k| if axis == 0 { view.column_offset(k) } else { view.row_offset(k) };
                    weights.add(weight, support, pixels, offset)
                });
            }
        }
        weights
    }

    /// Adds the factor of a support; returns the place of its pixel 0, which may lie before
    /// all places.
    fn add(
        &mut self,
        weight: &WeightFunction,
        support: &Affine,
        pixels: Range<u32>,
        offset: impl Fn(u32) -> f64,
    ) -> Option<u32> {
        let (start, first) = (self.values.len(), pixels.start);
        if start + pixels.len() > MOST {
            return None;
        }
        let xis: Vec<_> = pixels.map(|k| offset(k) * support.scale + support.shift).collect();
        for [value, slope] in weight.at_many(&xis) {
            self.values.push(T::from_f64(value));
            self.slopes.push(T::from_f64(slope * support.scale));
        }
        Some((start as u32).wrapping_sub(first))
    }

    /// The factor of a support at a vector of pixels, if it is kept.
    #[inline(always)]
    pub(super) fn factor<R: Real<Scalar = T>>(
        &self,
        support: Affine,
        pixel: usize,
        like: R,
    ) -> Option<WeightFactor<R>> {
        let place = support.table?.wrapping_add(pixel as u32) as usize;
        let [value, slope] = [&self.values, &self.slopes].map(|all| like.load(&all[place..]));
        Some(WeightFactor { value, slope })
    }
}

/// Pixels up to whole vectors.
fn whole_vectors<T: LaneNumber>(pixels: &Range<u32>) -> Range<u32> {
    let vector = T::VECTOR as u32;
    pixels.start / vector * vector..pixels.end.next_multiple_of(vector)
}
