//! Values at many points, on all threads.

use numpy::{PyArray1, PyArray2, PyArrayMethods as _};
use ppum::crack::Side;
use ppum::progress::{Cancelled, Phase, Progress, Watcher};
use ppum::sample::{SampledQuantity, SidedPoint, evaluate_each};
use ppum::vec2::{Vec2, vec2};
use pyo3::prelude::*;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::owned::AnchoredField;

/// Points that a thread takes at a time: enough that those of a patch come together, few enough
/// that all threads have work.
const PIECE: usize = 1 << 15;

/// Numbers in rows of so many.
pub(crate) fn rows<T: numpy::Element>(
    py: Python<'_>,
    numbers: Vec<T>,
    width: u32,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let shape = [numbers.len() / width as usize, width as usize];
    PyArray1::from_vec(py, numbers).reshape(shape)
}

/// Points, as two arrays of one length.
#[derive(Clone, Copy)]
pub(crate) struct PointArrays<'a> {
    pub(crate) x: &'a [f64],
    pub(crate) y: &'a [f64],
    /// Where they are offsets from, if they are.
    pub(crate) anchor: Option<Vec2>,
    pub(crate) side: Side,
}

impl PointArrays<'_> {
    fn places(&self, seen: &AnchoredField<'_>, from: usize, count: usize) -> Vec<SidedPoint> {
        let points = self.x[from..].iter().zip(&self.y[from..]).take(count);
        let place = |(&x, &y): (&f64, &f64)| self.place(seen, vec2(x, y));
        points.map(place).collect()
    }

    fn place(&self, seen: &AnchoredField<'_>, point: Vec2) -> SidedPoint {
        match self.anchor {
            Some(anchor) => seen.seats.offset(anchor, point, self.side),
            None => seen.seats.at(point, self.side),
        }
    }

    /// Returns the requested values at few points, at once.
    pub(crate) fn few(&self, seen: &AnchoredField<'_>, wanted: SampledQuantity<'_>) -> Vec<f64> {
        evaluate_each(&seen.field, wanted, &self.places(seen, 0, self.x.len()))
    }

    /// Writes the requested values at all points, in rows one after the other.
    pub(crate) fn fill(
        &self,
        seen: &AnchoredField<'_>,
        wanted: SampledQuantity<'_>,
        rows: &mut [f64],
        watcher: &dyn Watcher,
    ) -> Result<(), Cancelled> {
        let (width, total) = (wanted.width(), self.x.len());
        let done = AtomicUsize::new(0);
        let piece = |(k, rows): (usize, &mut [f64])| {
            let count = rows.len() / width;
            let so_far = done.fetch_add(count, Ordering::Relaxed);
            watcher.report(Progress::new(Phase::Evaluation, so_far, total))?;
            let places = self.places(seen, k * PIECE, count);
            rows.copy_from_slice(&evaluate_each(&seen.field, wanted, &places));
            Ok(())
        };
        rows.par_chunks_mut((PIECE * width).max(1)).enumerate().try_for_each(piece)
    }
}
