//! Values that depend on their places alone, not on what else is asked for.
//!
//! Lanes share the patches of all their points, and where one patch alone covers a point its weight
//! cancels: whether it is left out, or multiplied and divided, may change the last digit. So points
//! that one patch covers are evaluated by it, and the others apart from them, where a patch that
//! does not cover a point adds zero.

use super::place::SidedPoint;
use crate::crack::{SegmentId, Side};
use crate::field::{Field, LocalField};
use crate::jet::Jet;
use crate::quantity::{Quantity, QuantityGradient, Source};
use crate::vec2::Vec2;

/// The values that are evaluated at each place.
#[derive(Clone, Copy, Debug)]
pub enum SampledQuantity<'q> {
    /// The values of quantities: one number for each.
    Values(&'q [Quantity]),
    /// Values and gradients: q, ∂q/∂x, ∂q/∂y for each.
    Slopes(&'q [QuantityGradient]),
}

impl SampledQuantity<'_> {
    /// Numbers at a place.
    #[must_use]
    pub fn width(&self) -> usize {
        match self {
            Self::Values(quantities) => quantities.len(),
            Self::Slopes(slopes) => 3 * slopes.len(),
        }
    }

    fn jets(
        &self,
        local: &LocalField<'_>,
        at: (&[Vec2], &SidedPoint),
        patches: &[u32],
        out: &mut [Jet<f64>],
    ) {
        let (offsets, side) = (at.0, at.1.side);
        match self {
            Self::Slopes(_) => local.evaluate_over::<2>(offsets, side, patches, out),
            Self::Values(quantities)
                if quantities.iter().any(|quantity| quantity.source() == Source::Gradient) =>
            {
                local.evaluate_over::<1>(offsets, side, patches, out);
            }
            Self::Values(_) => local.evaluate_over::<0>(offsets, side, patches, out),
        }
    }

    /// The numbers at a point where the field is known.
    fn row(
        &self,
        local: &mut LocalField<'_>,
        (offset, side): (Vec2, Side),
        jets: &[Jet<f64>],
        row: &mut [f64],
    ) {
        match self {
            Self::Values(quantities) => {
                for (value, quantity) in row.iter_mut().zip(*quantities) {
                    *value = quantity.of_jets(local, (offset, side), jets);
                }
            }
            Self::Slopes(slopes) => {
                for (numbers, slope) in row.as_chunks_mut::<3>().0.iter_mut().zip(*slopes) {
                    let found = slope.slope_from_jets(local, offset, jets);
                    *numbers = [found.value, found.gradient.x, found.gradient.y];
                }
            }
        }
    }
}

/// Places that are put in order at a time; their numbers fit 16 bits of a key.
const CHUNK: usize = 1 << 16;

/// Points that several patches cover, evaluated together: the lanes of the widest processors.
const LANES: usize = 8;

/// Evaluates the requested values at each place, in rows: shape (places,
/// [width](SampledQuantity::width)), flattened; NaN outside the domain and where a quantity has no
/// value.
///
/// Equal places have equal rows, to the last bit, whatever the other places are and their order.
/// Places may stand in any order; those that are near each other are evaluated together.
#[must_use]
pub fn evaluate_each(
    field: &Field<'_>,
    wanted: SampledQuantity<'_>,
    places: &[SidedPoint],
) -> Vec<f64> {
    let width = wanted.width();
    let mut rows = vec![f64::NAN; places.len() * width];
    if width > 0 {
        let mut buffers = EvaluationBuffers::default();
        for (places, rows) in places.chunks(CHUNK).zip(rows.chunks_mut(CHUNK * width)) {
            PointChunk::new(field, places).evaluate(wanted, &mut buffers, rows);
        }
    }
    rows
}

/// Places with the patches that cover them.
struct PointChunk<'a, 'd> {
    field: &'a Field<'d>,
    places: &'a [SidedPoint],
    /// All patches, those of each place from its start to that of the next.
    patches: Vec<u32>,
    starts: Vec<u32>,
    /// Numbers of the places in the lowest bits, in the order of evaluation.
    order: Vec<u64>,
}

/// EvaluationBuffers for places that are evaluated together.
#[derive(Default)]
struct EvaluationBuffers {
    offsets: Vec<Vec2>,
    jets: Vec<Jet<f64>>,
    patches: Vec<u32>,
}

/// How a place is covered.
#[derive(Clone, Copy, PartialEq, Eq)]
enum PlaceCover {
    Nowhere,
    Alone(u32),
    Shared,
}

impl<'a, 'd> PointChunk<'a, 'd> {
    fn new(field: &'a Field<'d>, places: &'a [SidedPoint]) -> Self {
        let (mut patches, mut starts) = (Vec::with_capacity(2 * places.len()), vec![0]);
        let mut order = Vec::with_capacity(places.len());
        for (number, place) in (0..).zip(places) {
            let start = patches.len();
            field.tree.query_point(place.point, &mut patches);
            starts.push(patches.len() as u32);
            order.push((key(field, place, &patches[start..]) << 16) | number);
        }
        order.sort_unstable();
        Self { field, places, patches, starts, order }
    }

    fn place(&self, key: u64) -> &'a SidedPoint {
        &self.places[number(key)]
    }

    fn patches(&self, key: u64) -> &[u32] {
        let number = number(key);
        &self.patches[self.starts[number] as usize..self.starts[number + 1] as usize]
    }

    fn cover(&self, key: u64) -> PlaceCover {
        match self.patches(key) {
            [] => PlaceCover::Nowhere,
            [patch] => PlaceCover::Alone(*patch),
            _ => PlaceCover::Shared,
        }
    }

    fn evaluate(
        &self,
        wanted: SampledQuantity<'_>,
        buffers: &mut EvaluationBuffers,
        rows: &mut [f64],
    ) {
        for run in self.order.chunk_by(|&a, &b| origin(self.place(a)) == origin(self.place(b))) {
            let mut local = self.place(run[0]).seen(self.field);
            for part in run.chunk_by(|&a, &b| self.cover(a) == self.cover(b)) {
                let most = match self.cover(part[0]) {
                    PlaceCover::Nowhere => continue,
                    PlaceCover::Alone(_) => part.len(),
                    PlaceCover::Shared => LANES,
                };
                for keys in part.chunks(most) {
                    self.together(&mut local, keys, wanted, buffers, rows);
                }
            }
        }
    }

    /// The patches that cover one of the places, ascending.
    fn collect_patches(&self, keys: &[u64], all: &mut Vec<u32>) {
        all.clear();
        match self.cover(keys[0]) {
            PlaceCover::Alone(patch) => all.push(patch),
            _ => keys.iter().for_each(|&key| all.extend_from_slice(self.patches(key))),
        }
        all.sort_unstable();
        all.dedup();
    }

    /// Evaluates places of one anchor and face over the patches that cover them.
    fn together(
        &self,
        local: &mut LocalField<'_>,
        keys: &[u64],
        wanted: SampledQuantity<'_>,
        buffers: &mut EvaluationBuffers,
        rows: &mut [f64],
    ) {
        let (width, components) = (wanted.width(), self.field.components());
        let EvaluationBuffers { offsets, jets, patches } = buffers;
        self.collect_patches(keys, patches);
        offsets.clear();
        offsets.extend(keys.iter().map(|&key| self.place(key).offset));
        jets.resize(keys.len() * components, Jet::constant(0.0));
        wanted.jets(local, (offsets, self.place(keys[0])), patches, jets);
        for ((&key, &offset), jets) in keys.iter().zip(&*offsets).zip(jets.chunks(components)) {
            if local.has_values(offset, jets) {
                let row = &mut rows[number(key) * width..][..width];
                wanted.row(local, (offset, self.place(key).side), jets, row);
            }
        }
    }
}

/// The place that a key belongs to.
fn number(key: u64) -> usize {
    (key & (CHUNK as u64 - 1)) as usize
}

/// The anchor and the face of a place: those that have them in common share one [`LocalField`].
fn origin(place: &SidedPoint) -> ([u64; 2], Option<SegmentId>, bool) {
    let Vec2 { x, y } = place.anchor;
    ([x.to_bits(), y.to_bits()], place.on, place.side == Side::Above)
}

/// 48 bits that bring together places of one anchor and face, among them those of one patch, and of
/// these neighbours. That different ones have the same key takes a little time, and changes no
/// value.
fn key(field: &Field<'_>, place: &SidedPoint, patches: &[u32]) -> u64 {
    let ([x, y], on, above) = origin(place);
    let on = on.map_or(0, |on| ((u64::from(on.crack) << 32) | u64::from(on.segment)) + 1);
    let side = (on << 1) ^ u64::from(above);
    let origin = mixed(mixed(mixed(x) ^ y) ^ side) >> 32;
    let Some(&patch) = patches.first() else { return origin << 16 };
    let from_center = place.point - field.step.partition.center(patch as usize);
    let quarter = u64::from(from_center.x > 0.0) | (u64::from(from_center.y > 0.0) << 1);
    let is_shared = u64::from(patches.len() > 1);
    (origin << 16) | (is_shared << 15) | ((u64::from(patch) & 0x1fff) << 2) | quarter
}

/// Bits that all depend on all (a step of Steele's SplitMix, 2014).
fn mixed(bits: u64) -> u64 {
    let bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}
