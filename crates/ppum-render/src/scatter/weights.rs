//! Weights by formula at the columns and rows of a view, found once: a weight is a product of a factor in x and
//! one in y, and most patches share theirs with others above or beside them.

use std::collections::HashMap;
use std::ops::Range;

use ppum::real::{Real, Scalar};
use ppum::weight::WeightFunction;

use super::collapse::Factor;
use super::plan::{Affine, Patch, Plan};

/// Most numbers that some bands may need, and that are kept from those before: 32 MiB each of f64. Covers made of halved
/// squares need some thousands.
const MOST: usize = 1 << 21;

/// Factors with their slopes, by pixels of one direction. What does not change from band to band is kept.
#[derive(Debug, Default)]
pub(super) struct Weights<T> {
    values: Vec<T>,
    slopes: Vec<T>,
    known: [HashMap<Key, Kept>; 2],
    /// How often bands have begun, and the numbers that those at hand have needed.
    turn: u64,
    needed: usize,
}

/// What a factor depends on, and the pixels where it is needed.
type Key = (u64, u64, u32, u32);

/// The place of a factor's pixel 0, which may lie before all places, and the last bands that needed it.
#[derive(Debug)]
struct Kept {
    place: u32,
    turn: u64,
}

impl<T: Scalar> Weights<T> {
    /// Begins some bands.
    pub(super) fn begin(&mut self) {
        self.turn += 1;
        self.needed = 0;
        if self.values.len() > MOST {
            self.values.clear();
            self.slopes.clear();
            self.known.iter_mut().for_each(HashMap::clear);
        }
    }

    /// Keeps the factors of a patch if they are formulas; its support learns where they are.
    pub(super) fn keep(&mut self, plan: &Plan<'_>, patch: &mut Patch) {
        let weight = &plan.field.step.partition.weight;
        if !matches!(weight, WeightFunction::Formula(_)) {
            return;
        }
        let pixels = [&patch.columns, &patch.rows].map(whole_vectors::<T>);
        for (axis, pixels) in pixels.into_iter().enumerate() {
            patch.support[axis].table = self.place(plan, axis, &patch.support[axis], pixels);
        }
    }

    /// The place of a factor; none if the bands need too many. That depends on these bands alone, not on what is
    /// kept from others, since a factor that is not kept differs in its last bits.
    fn place(
        &mut self,
        plan: &Plan<'_>,
        axis: usize,
        support: &Affine,
        pixels: Range<u32>,
    ) -> Option<u32> {
        let bits = [support.scale, support.shift].map(f64::to_bits);
        let key = (bits[0], bits[1], pixels.start, pixels.end);
        let (turn, count) = (self.turn, pixels.len());
        let known = self.known[axis].get(&key).map(|kept| (kept.place, kept.turn));
        if known.is_none_or(|(_, last)| last != turn) {
            self.needed += count;
        }
        if self.needed > MOST {
            return None;
        }
        let place = match known {
            Some((place, _)) => place,
            None => self.add(plan, axis, support, pixels),
        };
        self.known[axis].insert(key, Kept { place, turn });
        Some(place)
    }

    /// Adds the factor of a support; returns its place.
    fn add(&mut self, plan: &Plan<'_>, axis: usize, support: &Affine, pixels: Range<u32>) -> u32 {
        let (start, first, view) = (self.values.len(), pixels.start, &plan.view);
        let offset = |k| if axis == 0 { view.column_offset(k) } else { view.row_offset(k) };
        let xis: Vec<_> = pixels.map(|k| offset(k) * support.scale + support.shift).collect();
        for [value, slope] in plan.field.step.partition.weight.at_many(&xis) {
            self.values.push(T::from_f64(value));
            self.slopes.push(T::from_f64(slope * support.scale));
        }
        (start as u32).wrapping_sub(first)
    }

    /// The factor of a support at a vector of pixels, if it is kept.
    #[inline(always)]
    pub(super) fn factor<R: Real<Scalar = T>>(
        &self,
        support: Affine,
        pixel: usize,
        like: R,
    ) -> Option<Factor<R>> {
        let place = support.table?.wrapping_add(pixel as u32) as usize;
        let [value, slope] = [&self.values, &self.slopes].map(|all| like.load(&all[place..]));
        Some(Factor { value, slope })
    }
}

/// Pixels up to whole vectors.
fn whole_vectors<T: Scalar>(pixels: &Range<u32>) -> Range<u32> {
    let vector = T::VECTOR as u32;
    pixels.start / vector * vector..pixels.end.next_multiple_of(vector)
}
