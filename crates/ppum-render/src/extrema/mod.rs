//! Minimum and maximum of a quantity over a view, not just over its pixels, with their places.
//!
//! The largest value of a raster says how near a pixel's centre happens to be to a peak. Here the best pixels are where a search
//! begins: Newton's method on the exact [gradient](QuantityGradient) where the quantity is smooth, with a Hessian by differences of
//! it, and a search in turning directions where it is not. What is largest on a boundary is found there: on the border of the
//! view and of the domain, on the rims of holes, on both faces of cracks, on both sides of interfaces, each sampled once a pixel at least
//! and refined. Peaks and valleys narrower than a pixel are not seen.
//!
//! At a crack tip and at other singular points quantities may be infinite. Whether they are is seen in how they grow towards
//! the point; then the extremum is, and its place is the point. Finite values next to such a point, within a thousandth of a pixel,
//! are left out: there the last digits of the field decide.

mod bent;
mod climb;
mod curves;
mod singular;

use ppum::crack::{SegmentId, Side};
use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::{Quantity, QuantityGradient};
use ppum::vec2::{Rect, Vec2};
use rayon::prelude::*;

use crate::error::RenderError;
use crate::parts::Parts;
use crate::raster::{Raster, Sample};
use crate::view::View;
use climb::Climber;
use curves::Curve;
pub use singular::{Singular, SingularKind};

/// Pixels from which the search begins, at most: the most promising ones.
const STARTS: usize = 32;

/// Distance from a singular point below which finite values are left out, pixels.
const HIDDEN: f64 = 1e-3;

/// An extreme value of a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremum {
    /// The value, to about 10⁻⁶ of its size; ±∞ at a singular point.
    pub value: f64,
    /// Its place, as an offset from the view's centre.
    pub offset: Vec2,
    /// What the place lies on.
    pub on: On,
}

/// What the place of an extremum lies on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum On {
    /// Nothing.
    Inside,
    /// The border of the view or of the domain.
    Border,
    /// A face of a crack: the value is that of this side.
    Face(SegmentId, Side),
    /// The rim of the hole of this index.
    Rim(usize),
    /// An interface of the material.
    Interface,
    /// A singular point.
    Singular(SingularKind),
}

/// Minimum and maximum of a quantity over a view.
#[derive(Clone, Debug, PartialEq)]
pub struct Extrema {
    /// The smallest value.
    pub min: Extremum,
    /// The largest value.
    pub max: Extremum,
    /// The singular points in the view, re-entrant corners of holes also where the represented field is finite.
    pub singular: Vec<Singular>,
}

/// Minimum and maximum of a quantity over the part of the domain that a view shows; `None` if that is nothing, or the quantity is nowhere
/// defined.
///
/// `raster` holds the quantity at the view's pixel centres, by any renderer, in f64 or f32. The result depends on the raster only in
/// where searches begin.
///
/// # Errors
/// The quantity has no meaning for the field; the watcher stops the call.
///
/// # Panics
/// If the raster has not the view's pixels.
pub fn extrema<T: Sample>(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    raster: &Raster<T>,
    watcher: &dyn Watcher,
) -> Result<Option<Extrema>, RenderError> {
    assert_eq!(raster.size, view.pixels, "a raster of the view");
    let slope = QuantityGradient::new(quantity, field)?;
    let Some(rect) = seen(field, view) else { return Ok(None) };
    let singular = singular::points(field, view.center, &rect, quantity);
    let grows = |point: &&Singular| point.max_infinite || point.min_infinite;
    let hidden = singular.iter().filter(grows).map(|point| point.offset).collect();
    let search = Search { field, view, slope: &slope, rect, hidden };
    let mut curves = curves::all(field, view.center, &rect);
    let mut local = field.at(view.center);
    let mut value = |at| quantity.at(&mut local, at, Side::Above);
    curves.extend(bent::all(field, view.center, &rect, view.pixel_size(), &mut value));
    let starts = [-1.0, 1.0].map(|sign| climb::starts(raster, sign, STARTS));
    let parts = Parts::start(watcher, curves.len() + starts.iter().map(Vec::len).sum::<usize>())?;
    let on_curves: Result<Vec<_>, RenderError> = curves
        .par_iter()
        .map(|curve| {
            parts.finish_one()?;
            Ok(search.on_curve(curve))
        })
        .collect();
    let on_curves = on_curves?;
    let mut best = [None; 2];
    for (k, sign) in [-1.0, 1.0].into_iter().enumerate() {
        let inner: Result<Vec<_>, RenderError> = starts[k]
            .par_iter()
            .map(|&[i, j]| {
                parts.finish_one()?;
                Ok(search.climbed(view.offset(i, j), sign))
            })
            .collect();
        let all = on_curves.iter().map(|found| found[k]).chain(inner?).flatten();
        best[k] = largest(all.chain(infinite(&singular, sign)), sign);
    }
    let [Some(min), Some(max)] = best else { return Ok(None) };
    Ok(Some(Extrema { min, max, singular }))
}

/// What a search needs.
struct Search<'a, 'f> {
    field: &'a Field<'f>,
    view: &'a View,
    slope: &'a QuantityGradient,
    rect: Rect,
    /// Singular points where the quantity is infinite.
    hidden: Vec<Vec2>,
}

impl Search<'_, '_> {
    /// The smallest and the largest value on a curve.
    fn on_curve(&self, curve: &Curve) -> [Option<Extremum>; 2] {
        let (pixel, quantity) = (self.view.pixel_size(), self.slope.quantity());
        let mut local = curve.local(self.field, self.view.center);
        let mut value = |t: f64| {
            let at = curve.at(t, pixel);
            if self.is_hidden(at) {
                return f64::NAN;
            }
            climb::finite(quantity.at(&mut local, at, curve.side()))
        };
        let found = curves::extremes(&mut value, curve.samples(pixel));
        let place = |(value, t)| Extremum { value, offset: curve.at(t, 0.0), on: curve.on };
        found.map(|found| found.map(place))
    }

    /// The extremum uphill (downhill for the sign −1) from a point.
    fn climbed(&self, start: Vec2, sign: f64) -> Option<Extremum> {
        let local = self.field.at(self.view.center);
        let is_hidden = |at| self.is_hidden(at);
        let mut climber = Climber { slope: self.slope, local, rect: self.rect, sign, is_hidden };
        let (value, offset) = climber.climb(start, self.view.pixel_size())?;
        Some(Extremum { value, offset, on: On::Inside })
    }

    /// True next to a singular point.
    fn is_hidden(&self, at: Vec2) -> bool {
        let reach = HIDDEN * self.view.pixel_size();
        self.hidden.iter().any(|&point| (at - point).length() < reach)
    }
}

/// The part of the domain's box that a view shows, by offsets from its centre.
fn seen(field: &Field<'_>, view: &View) -> Option<Rect> {
    let (half, bounds) = (view.half(), field.domain.bounds);
    let bounds = Rect::new(bounds.min - view.center, bounds.max - view.center);
    let rect = Rect::new(-half, half).intersection(&bounds);
    (rect.min.x <= rect.max.x && rect.min.y <= rect.max.y).then_some(rect)
}

/// The largest (smallest for the sign −1) of some values; the first of equal ones.
fn largest(all: impl Iterator<Item = Extremum>, sign: f64) -> Option<Extremum> {
    all.filter(|found| !found.value.is_nan()).fold(None, |best: Option<Extremum>, found| match best
    {
        Some(best) if sign * best.value >= sign * found.value => Some(best),
        _ => Some(found),
    })
}

fn infinite(singular: &[Singular], sign: f64) -> impl Iterator<Item = Extremum> {
    let grows =
        move |point: &&Singular| if sign > 0.0 { point.max_infinite } else { point.min_infinite };
    singular.iter().filter(grows).map(move |point| Extremum {
        value: sign * f64::INFINITY,
        offset: point.offset,
        on: On::Singular(point.kind),
    })
}

#[cfg(test)]
mod tests;
