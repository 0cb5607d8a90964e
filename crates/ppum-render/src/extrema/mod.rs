//! Minimum and maximum of a quantity over a view, not just over its pixels, with their places.
//!
//! The largest value of a raster says how near a pixel's centre happens to be to a peak. Here the
//! best pixels are where a search begins: Newton's method on the exact [gradient](QuantityGradient)
//! where the quantity is smooth, with a Hessian by differences of it, and a search in turning
//! directions where it is not. What is largest on a boundary is found there: on the border of the
//! view and of the domain, on the rims of holes, on both faces of cracks, on both sides of
//! interfaces, each sampled once a pixel and refined. Peaks and valleys narrower than a pixel are
//! not seen but next to points where the quantity is infinite: around these it is looked at on
//! rings, and on faces of cracks that end there, down to a thousandth of a pixel, as long as there
//! are not dozens of such points. A valley that is narrower than the 7° between two places of a
//! ring may be missed, or not followed to its end.
//!
//! Only places are refined that may still hold the extremum by what their neighbours say, and
//! boundaries have a sample for eight pixels of a large picture at most, together: the search takes
//! a part of what drawing takes. Many boundaries are sampled less densely, and where there are too
//! many for that, or too many points that may be singular, whatever the number of pixels, the
//! pixels decide, [`On::Pixel`].
//!
//! A quantity that has one value all over the plate, but for rounding, has it
//! everywhere, [`On::Everywhere`].
//!
//! At a crack tip and at other singular points quantities may be infinite. Whether they are is seen
//! in how they grow towards the point; then the extremum is, and its place is the point. Finite
//! values next to such a point, within a thousandth of a pixel, are left out: there the last digits
//! of the field decide. An extremum is infinite too if a pixel is, and if the search runs away from
//! all pixels, beyond [`RUNAWAY`] times their size, to a pole: 1/x does between two of them. A peak
//! that is narrow but finite keeps its value.

mod bent;
mod climb;
mod curves;
mod even;
mod on;
mod rings;
mod singular;

use std::fmt;

use ppum::crack::Side;
use ppum::field::{Field, LocalField};
use ppum::function::Slot;
use ppum::progress::Watcher;
use ppum::quantity::{Quantity, QuantityGradient};
use ppum::vec2::{Rect, Vec2};
use ppum_raster::RenderError;
use ppum_raster::parts::Parts;
use ppum_raster::raster::{Raster, Sample, Statistics};
use ppum_raster::view::View;
use rayon::prelude::*;

use climb::Climber;
use curves::{BoundaryCurve, Promise};
pub use on::On;
pub use singular::{Singular, SingularKind};

/// Pixels and samples of boundaries from which the search begins, at most, and how many of them
/// before the rest is looked at again: the most promising ones first.
const STARTS: usize = 32;
const ROUND: usize = 8;

/// Samples of boundaries and looks at points that may be singular, at most: one for so many pixels,
/// or what is [`affordable`]. That alone decides whether there are too many of them, so that it
/// does not depend on the pixels whether a kink is infinite.
const PIXELS: usize = 8;
const SAMPLES: usize = 1 << 15;
/// As many are looked at in any field, and more as long as their functions take no more than some
/// operations, together.
const FEWEST: usize = 1 << 13;
const OPERATIONS: usize = 1 << 28;

/// Segments of cracks that take as long as a sample: on each face all of them are seen anew.
const SEGMENTS: usize = 64;

/// Part of its parts by which a pixel of a quantity may differ that is constant.
const PART: f64 = 1e-3;

/// Distance of the places that tell a pole from a narrow peak, pixels.
const BESIDE: f64 = 1e-5;

/// Distance from the pixels' values, in parts of their size, from which an extremum may be a pole.
/// On a rim that is no wider than a pixel stresses are some three times those around; 1/x grows by
/// a million on the way from a pixel to its zero.
pub const RUNAWAY: f64 = 10.0;

/// Distance from a singular point below which finite values are left out, pixels.
const HIDDEN: f64 = 1e-3;

/// An extreme value of a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremum {
    /// The value, to about 10⁻⁶ of its size; ±∞ at a singular point.
    pub value: f64,
    /// Its place, as an offset from [`Extrema::center`].
    pub offset: Vec2,
    /// What the place lies on.
    pub on: On,
}

/// Minimum and maximum of a quantity over a view.
#[derive(Clone, Debug, PartialEq)]
pub struct Extrema {
    /// The centre of the view that they were found in, from which places are counted: a picture of
    /// another view may show them.
    pub center: Vec2,
    /// The smallest value.
    pub min: Extremum,
    /// The largest value.
    pub max: Extremum,
    /// The singular points in the view, re-entrant corners of holes also where the represented
    /// field is finite.
    pub singular: Vec<Singular>,
}

impl fmt::Display for Extrema {
    /// `min 0.1 at -0.2,0.3 inside max inf at 0.5,0.0 singular`, with the shortest numbers that
    /// mean the doubles and places as offsets from the view's centre.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let one = |Extremum { value, offset, on }: Extremum| {
            format!("{value:?} at {:?},{:?} {}", offset.x, offset.y, on.name())
        };
        write!(f, "min {} max {}", one(self.min), one(self.max))
    }
}

impl Extrema {
    /// The smallest and the largest value at the pixels of a view, infinite ones too; `None` if
    /// there are none.
    #[must_use]
    pub fn of_pixels<T: Sample>(raster: &Raster<T>, view: &View) -> Option<Self> {
        let values = || raster.values.iter().map(|&value| value.into()).enumerate();
        let known = || values().filter(|(_, value): &(usize, f64)| !value.is_nan());
        let (least, most) = (
            known().min_by(|a, b| a.1.total_cmp(&b.1))?,
            // the first of equal ones, as of the smallest
            known().max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)))?,
        );
        let columns = raster.size[0] as usize;
        let place = |(k, value): (usize, f64)| {
            let offset = view.offset((k % columns) as u32, (k / columns) as u32);
            Extremum { value, offset, on: On::Pixel }
        };
        let (center, singular) = (view.center, Vec::new());
        Some(Self { center, min: place(least), max: place(most), singular })
    }

    /// True if the quantity is infinite somewhere, at a singular point or at a pixel.
    #[must_use]
    pub fn is_infinite(&self) -> bool {
        self.min.value.is_infinite() || self.max.value.is_infinite()
    }

    /// Those of a quantity that has one value all over the plate, but for rounding: what is
    /// constant or zero within the digits that the file bears. `None` of others, and where a view
    /// shows nothing of the plate.
    #[must_use]
    pub fn of_constant<T: Sample>(
        field: &Field<'_>,
        view: &View,
        quantity: &Quantity,
        raster: &Raster<T>,
    ) -> Option<Self> {
        let rect = visible_bounds(field, view)?;
        let [value, parts] = even::value(field, quantity)?;
        // a formula may differ somewhere; single precision does so everywhere
        let is_same = |v: f64| v.is_nan() || (v - value).abs() <= PART * parts;
        if !raster.values.iter().all(|&v| is_same(v.into())) {
            return None;
        }
        let offset = Vec2::ZERO.max(rect.min).min(rect.max);
        let one = Extremum { value, offset, on: On::Everywhere };
        Some(Self { center: view.center, min: one, max: one, singular: Vec::new() })
    }

    /// The value of a quantity that has one all over the plate, but for rounding.
    #[must_use]
    pub fn constant(&self) -> Option<f64> {
        let ([min, max], on) = ([self.min, self.max], On::Everywhere);
        (min.on == on && max.on == on && min.value == max.value).then_some(max.value)
    }

    /// True if the pixels alone were looked at.
    #[must_use]
    pub fn is_of_pixels(&self) -> bool {
        self.max.on == On::Pixel
    }
}

/// Minimum and maximum of a quantity over the part of the domain that a view shows; `None` if that
/// is nothing, or the quantity is nowhere defined. Where a search would take too long, and of
/// formulas whose derivatives are too large, they are those of the pixels ([module](self)).
///
/// `raster` holds the quantity at the view's pixel centres, by any renderer, in f64 or f32. The
/// result depends on the raster only in where searches begin.
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
    quantity.check(field)?;
    if let Some(constant) = Extrema::of_constant(field, view, quantity, raster) {
        return Ok(Some(constant));
    }
    // of a formula whose derivatives are too large
    let Ok(slope) = QuantityGradient::new(quantity, field) else {
        return Ok(Extrema::of_pixels(raster, view));
    };
    let Some(rect) = visible_bounds(field, view) else { return Ok(None) };
    let points = singular::candidates(field, view.center, &rect);
    let mut curves = curves::boundary_curves(field, view.center, &rect);
    let bent = bent::bent_interfaces(field, view.center, &rect, view.pixel_size());
    curves.extend(bent.into_iter().map(|bent| BoundaryCurve::bent(bent, On::Interface)));
    let Some(mut samples) = samples(field, view, &curves, points.len()) else {
        return Ok(Extrema::of_pixels(raster, view));
    };
    Parts::start(watcher, 1)?;
    let singular = singular::grown(field, view.center, &rect, quantity, points);
    let grows = |point: &&Singular| point.max_infinite || point.min_infinite;
    let hidden: Vec<_> = singular.iter().filter(grows).map(|point| point.offset).collect();
    curves.extend(rings::faces(&curves, &hidden, view.pixel_size()));
    samples.resize(curves.len(), curves::LEAST);
    let parts = Parts::start(watcher, curves.len() + 4 * STARTS.div_ceil(ROUND) + 2)?;
    let search = Search { field, view, slope: &slope, rect, hidden, curves, parts };
    let sampled = search.sampled(&samples)?;
    let best = |sign: f64| match infinite(&singular, sign) {
        None => search.finite(&sampled, raster, sign),
        found => Ok(found),
    };
    let [Some(min), Some(max)] = [best(-1.0)?, best(1.0)?] else {
        return Ok(Extrema::of_pixels(raster, view));
    };
    let [min, max] =
        [(min, -1.0), (max, 1.0)].map(|(best, sign)| search.at_most(best, sign, raster));
    Ok(Some(Extrema { center: view.center, min, max, singular }))
}

/// The number of samples of each curve; `None` if all of them, and the looks at points that may be
/// singular, are too many.
fn samples(
    field: &Field<'_>,
    view: &View,
    curves: &[BoundaryCurve],
    points: usize,
) -> Option<Vec<usize>> {
    let pixels = view.pixels[0] as usize * view.pixels[1] as usize;
    let segments: usize = field.step.cracks.iter().map(|crack| crack.points.len()).sum();
    let is_face = |curve: &&BoundaryCurve| matches!(curve.on, On::Face(..));
    let apart = curves.iter().filter(is_face).count() * (segments / SEGMENTS);
    let least = affordable(field).checked_sub(points * singular::LOOK + apart)?;
    let room = (pixels / PIXELS).max(least);
    let wanted = curves.iter().map(|curve| curve.samples(view.pixel_size()));
    let all: usize = wanted.clone().sum();
    let part = (room as f64 / all as f64).min(1.0);
    let thinned = wanted.map(|n| ((n as f64 * part) as usize).max(curves::LEAST));
    (curves.len() * curves::LEAST <= least).then(|| thinned.collect())
}

/// Samples that a small picture may have, by the operations of the functions of a patch.
fn affordable(field: &Field<'_>) -> usize {
    let functions = &field.functions;
    let cost = |&function: &u32| match functions.of(function) {
        Slot::One => 0,
        Slot::Jet { group, .. } => {
            let group = group as usize;
            functions.cost(group, &field.step.cracks) / functions.group_len(group)
        }
    };
    let all: usize = field.data.block_function.iter().map(cost).sum();
    let of_a_patch = 1 + all / field.step.partition.len();
    (OPERATIONS / of_a_patch).clamp(FEWEST, SAMPLES)
}

/// What a search needs.
struct Search<'a, 'f> {
    field: &'a Field<'f>,
    view: &'a View,
    slope: &'a QuantityGradient,
    rect: Rect,
    /// Singular points where the quantity is infinite.
    hidden: Vec<Vec2>,
    curves: Vec<BoundaryCurve>,
    parts: Parts<'a>,
}

impl Search<'_, '_> {
    /// The extremum, infinite if a pixel is or if it has run away from all of them to a pole.
    fn at_most<T: Sample>(&self, best: Extremum, sign: f64, raster: &Raster<T>) -> Extremum {
        let value = sign * f64::INFINITY;
        let infinite = raster.values.iter().position(|&v| v.into() == value);
        if let Some(pixel) = infinite.filter(|_| best.value.is_finite()) {
            let columns = raster.size[0] as usize;
            let offset = self.view.offset((pixel % columns) as u32, (pixel / columns) as u32);
            return Extremum { value, offset, on: On::Inside };
        }
        let Statistics { finite, min, max, .. } = raster.statistics();
        let (size, extreme) = (min.abs().max(max.abs()), if sign > 0.0 { max } else { min });
        let is_far = finite > 0 && sign * (best.value - extreme) > RUNAWAY * size;
        if is_far && self.is_pole(best) { Extremum { value, ..best } } else { best }
    }

    /// True if hardly any value around a place is half as large: not even the half of a peak that a
    /// border or a crack leaves, and of a line of poles two points.
    fn is_pole(&self, best: Extremum) -> bool {
        let mut local = self.field.at(self.view.center);
        let mut is_high = |k: u32| {
            let (sin, cos) = (f64::from(k) * std::f64::consts::FRAC_PI_4).sin_cos();
            let around = best.offset + Vec2 { x: cos, y: sin } * (BESIDE * self.view.pixel_size());
            self.slope.quantity().at(&mut local, around, Side::Above) / best.value > 0.5
        };
        (0..8).filter(|&k| is_high(k)).count() < 3
    }

    /// The quantity along each curve.
    fn sampled(&self, samples: &[usize]) -> Result<Vec<Vec<f64>>, RenderError> {
        let anchor = self.view.center;
        let along = |local: &mut LocalField<'_>, (curve, &samples): (&BoundaryCurve, &usize)| {
            self.parts.finish_one()?;
            let at = |k: usize| curves::part(k, samples);
            let all = |local: &mut LocalField<'_>| {
                (0..samples).map(|k| self.on_curve(local, curve, at(k))).collect()
            };
            Ok(match curve.segment() {
                Some(segment) => all(&mut self.field.on(segment, anchor)),
                None => all(local),
            })
        };
        let curves = self.curves.par_iter().zip(samples);
        curves.map_init(|| self.field.at(anchor), along).collect()
    }

    /// The finite extremum, largest for the sign 1 and smallest for −1.
    fn finite<T: Sample>(
        &self,
        sampled: &[Vec<f64>],
        raster: &Raster<T>,
        sign: f64,
    ) -> Result<Option<Extremum>, RenderError> {
        let tops = curves::tops(sampled, sign, STARTS);
        let on_curve = |&[curve, sample]: &[usize; 2]| {
            Some(self.refined(&self.curves[curve], &sampled[curve], sample, sign))
        };
        let best = self.rounds(None, &tops, sign, on_curve)?;
        let starts = climb::starts(raster, sign, STARTS);
        let pixel = self.view.pixel_size();
        let inside = |&[i, j]: &[u32; 2]| self.climbed(self.view.offset(i, j), pixel, sign);
        let best = self.rounds(best, &starts, sign, inside)?;
        let beside = |&(at, scale): &(Vec2, f64)| self.climbed(at, scale, sign);
        self.rounds(best, &self.beside_singular(sign), sign, beside)
    }

    /// Looks at places, the most promising first, while they promise more than what is found.
    fn rounds<P: Sync>(
        &self,
        mut best: Option<Extremum>,
        places: &[Promise<P>],
        sign: f64,
        look: impl Fn(&P) -> Option<Extremum> + Sync,
    ) -> Result<Option<Extremum>, RenderError> {
        for round in places.chunks(ROUND) {
            self.parts.finish_one()?;
            let known = best.map_or(f64::NEG_INFINITY, |best| sign * best.value);
            let hopeful = round.par_iter().filter(|(promise, _)| *promise > known);
            let found: Vec<_> = hopeful.filter_map(|(_, place)| look(place)).collect();
            best = largest(best.into_iter().chain(found), sign);
        }
        Ok(best)
    }

    /// The extremum on a curve around a sample.
    fn refined(&self, curve: &BoundaryCurve, values: &[f64], sample: usize, sign: f64) -> Extremum {
        let mut local = curve.local(self.field, self.view.center);
        let mut value = |t: f64| self.on_curve(&mut local, curve, t);
        let (value, t) = curves::golden(&mut value, sign, values, sample);
        Extremum { value, offset: curve.at(t, 0.0), on: curve.on }
    }

    /// The quantity at a part of the way along a curve; NaN where it is infinite, and next to such
    /// a point, and where the curve has left the view, as rims may.
    fn on_curve(&self, local: &mut LocalField<'_>, curve: &BoundaryCurve, t: f64) -> f64 {
        let at = curve.at(t, self.view.pixel_size());
        if self.is_hidden(at) || !self.is_seen(curve.at(t, 0.0)) {
            return f64::NAN;
        }
        climb::finite(self.slope.quantity().at(local, at, curve.side()))
    }

    /// The extremum uphill (downhill for the sign −1) from a point, by steps of a scale.
    fn climbed(&self, start: Vec2, scale: f64, sign: f64) -> Option<Extremum> {
        let local = self.field.at(self.view.center);
        let is_hidden = |at| self.is_hidden(at);
        let mut climber = Climber { slope: self.slope, local, rect: self.rect, sign, is_hidden };
        let (value, offset) = climber.climb(start, scale)?;
        let Rect { min, max } = self.rect;
        let is_end = |v: f64, [a, b]: [f64; 2]| v == a || v == b;
        let on_border = is_end(offset.x, [min.x, max.x]) || is_end(offset.y, [min.y, max.y]);
        Some(Extremum { value, offset, on: if on_border { On::Border } else { On::Inside } })
    }

    /// True within the view, but for rounding.
    fn is_seen(&self, at: Vec2) -> bool {
        let rounding = 1e-6 * self.view.pixel_size();
        let nearest = at.max(self.rect.min).min(self.rect.max);
        (at - nearest).length() <= rounding
    }

    /// True next to a singular point.
    fn is_hidden(&self, at: Vec2) -> bool {
        let reach = HIDDEN * self.view.pixel_size();
        self.hidden.iter().any(|&point| (at - point).length() < reach)
    }
}

/// The part of the domain's box that a view shows, by offsets from its centre.
fn visible_bounds(field: &Field<'_>, view: &View) -> Option<Rect> {
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

/// The first singular point where the quantity grows (falls for the sign −1) without bound.
fn infinite(singular: &[Singular], sign: f64) -> Option<Extremum> {
    let grows =
        |point: &&Singular| if sign > 0.0 { point.max_infinite } else { point.min_infinite };
    singular.iter().find(grows).map(|point| Extremum {
        value: sign * f64::INFINITY,
        offset: point.offset,
        on: On::Singular(point.kind),
    })
}

#[cfg(test)]
mod tests;
