//! Measured images must be right: frames are compared with the evaluation point by point in f64.
//!
//! A band of rows through the crack is drawn, of pixels as large as those of the frames, so that
//! the same paths are taken. Differences are told in units of the local scale, the largest value of
//! the 3 × 3 pixels around one: in f64 the largest of them, in f32 that of 99 % of the pixels,
//! since at a crack or at a patch's border a rounded coordinate decides what is seen. Both are
//! bounded by what tests hold coarse covers to, and beyond [`ACROSS`] patches across in proportion
//! to these: in ∇(Wu) − u∇W, which is |∇u|, terms of size |u|/h cancel, and h is the size of
//! a patch.
//!
//! The negative control is the same frame held against a reference whose weight has a wrong
//! derivative. [`WRONG`] is the linear weight to 1e-5, but a ripple on it makes its slope wrong by
//! as much as the slope itself: displacements agree, stresses do not. A comparison that does not
//! notice would not notice a wrong derivative in a fast path either. In f32 that is asked up to
//! [`MOST_IN_F32`] patches: where there are more they differ from each other, and so the wrong
//! stress from the right one, by no more than the rounding of a gradient.

use ppum::field::Field;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum_render::raster::Raster;
use ppum_render::reference::reference;
use ppum_render::view::View;
use serde::Serialize;

use crate::cards::BenchDevice;
use crate::frames::{DrawingDevice, QuantityRenderer, WAYS};

/// A weight with a wrong derivative: value and slope of 1 − t, except for a ripple of size 1e-5.
pub(super) const WRONG: &str = "(1 - t)*(1 + 1e-5*sin(1e5*t))";

/// Largest difference in f64 on coarse covers: what tests hold images to.
const IN_F64: f64 = 1e-12;

/// Difference of 99 % of the pixels in f32, likewise.
const IN_F32: f64 = 2e-5;

/// Patches across the plate of a coarse cover.
const ACROSS: f64 = 12.0;

/// Most patches for which a wrong derivative is seen in f32.
const MOST_IN_F32: usize = 8192;

/// Rows of the band.
const ROWS: u32 = 128;

/// Differences in units of the local scale.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Difference {
    /// That of 99 % of the pixels.
    pub(super) p99: f64,
    pub(super) largest: f64,
}

/// A way of drawing, compared.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Agreement {
    #[serde(flatten)]
    pub(super) difference: Difference,
    pub(super) limit: f64,
    pub(super) holds: bool,
    /// From the reference with a wrong derivative, where there is one, which must not hold.
    pub(super) control: Option<Control>,
}

#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Control {
    #[serde(flatten)]
    pub(super) difference: Difference,
    pub(super) caught: bool,
}

impl Agreement {
    /// True if the frame is right, and the control is not.
    pub(super) fn is_good(&self) -> bool {
        self.holds && self.control.is_none_or(|control| control.caught)
    }
}

/// Compares all ways; `wrong` is the field with [`WRONG`] for its weight.
pub(super) fn agreements(
    subject: &QuantityRenderer<'_>,
    wrong: Option<&Field<'_>>,
    view: &View,
    mut cards: Option<&mut BenchDevice>,
) -> anyhow::Result<[Option<Agreement>; 4]> {
    let view = band(view)?;
    let truth = ReferenceValues::new(subject.field, &view, &subject.quantity)?;
    let wrong =
        wrong.map(|field| ReferenceValues::new(field, &view, &subject.quantity)).transpose()?;
    let patches = subject.field.step.partition.len();
    let mut all = [None; 4];
    for (slot, way) in all.iter_mut().zip(WAYS) {
        let found = subject.values(way, &view, cards.as_deref_mut())?;
        *slot = found.map(|values| agreement((way, patches), &values, &truth, wrong.as_ref()));
    }
    Ok(all)
}

/// Rows in the middle of a view.
fn band(view: &View) -> anyhow::Result<View> {
    let [columns, rows] = view.pixels;
    Ok(View::new(view.center, view.width, [columns, rows.min(ROWS)])?)
}

fn agreement(
    (way, patches): (DrawingDevice, usize),
    values: &[f64],
    truth: &ReferenceValues,
    wrong: Option<&ReferenceValues>,
) -> Agreement {
    let is_double = way == DrawingDevice::CpuF64;
    let on_coarse = if is_double { IN_F64 } else { IN_F32 };
    let limit = on_coarse * ((patches as f64).sqrt() / ACROSS).max(1.0);
    let is_within = |difference: Difference| {
        let Difference { p99, largest } = difference;
        (if is_double { largest } else { p99 }) <= limit
    };
    let difference = truth.difference(values);
    let wrong = wrong.filter(|_| is_double || patches <= MOST_IN_F32);
    let control = wrong.map(|wrong| {
        let difference = wrong.difference(values);
        Control { difference, caught: !is_within(difference) }
    });
    Agreement { difference, limit, holds: is_within(difference), control }
}

/// The values of the reference, and their scale.
struct ReferenceValues {
    values: Vec<f64>,
    scale: Vec<f64>,
}

impl ReferenceValues {
    fn new(field: &Field<'_>, view: &View, quantity: &Quantity) -> anyhow::Result<Self> {
        let raster = reference(field, view, quantity, unwatched())?;
        let scale = scales(&raster);
        Ok(Self { values: raster.values, scale })
    }

    fn difference(&self, found: &[f64]) -> Difference {
        let pairs = found.iter().zip(&self.values).zip(&self.scale);
        let mut all: Vec<f64> = pairs.filter_map(|((f, e), s)| one(*f, *e, *s)).collect();
        all.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let place = (all.len().saturating_sub(1) as f64 * share) as usize;
            all.get(place).copied().unwrap_or(f64::INFINITY)
        };
        Difference { p99: at(0.99), largest: at(1.0) }
    }
}

/// The difference of a pixel; none where there is no value, infinite where only one has a value.
fn one(found: f64, expected: f64, scale: f64) -> Option<f64> {
    if found.is_nan() && expected.is_nan() {
        return None;
    }
    let difference = if found == expected { 0.0 } else { (found - expected).abs() / scale };
    Some(if difference.is_nan() { f64::INFINITY } else { difference })
}

/// The largest magnitude of the 3 × 3 pixels around each.
fn scales(raster: &Raster) -> Vec<f64> {
    let [columns, rows] = raster.size;
    let around = |row: u32, column: u32| {
        let mut scale = 0.0f64;
        for j in row.saturating_sub(1)..(row + 2).min(rows) {
            for i in column.saturating_sub(1)..(column + 2).min(columns) {
                let value = raster.value(i, j).abs();
                scale = if value.is_finite() { scale.max(value) } else { scale };
            }
        }
        scale
    };
    (0..rows)
        .flat_map(|row| (0..columns).map(move |column| (row, column)))
        .map(|(row, column)| around(row, column))
        .collect()
}
