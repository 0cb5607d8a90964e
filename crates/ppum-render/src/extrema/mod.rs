//! Minimum and maximum of a quantity over a part of a body, not just over pixels, with their
//! places.
//!
//! The largest value of a raster says how near a pixel's centre happens to be to a peak. So an
//! image shows no extrema of its own: they belong to the [region](BodyRegion) of the body that it
//! shows. A search begins at the places of a grid that depends on the region alone, and in cells
//! that are smaller than its squares: Newton's method on the exact [gradient](QuantityGradient)
//! where the quantity is smooth, with a Hessian by differences of it, and a search in turning
//! directions where it is not. The largest values on boundaries are found there: on the border of
//! the region and of the domain, on the rims of holes, on both faces of cracks, on both sides of
//! interfaces, each sampled once a square of the grid and refined. Peaks and valleys narrower than
//! that are not seen but next to singular points: around these it is looked at on rings, and on
//! faces of cracks that end there, down to a thousandth of a square, as long as there are not
//! dozens of such points. A valley that is narrower than the 7° between two places of a ring may be
//! missed, or not followed to its end.
//!
//! Only places are refined that may still hold the extremum by what their neighbours say, and
//! boundaries have so many samples together that their evaluation is affordable: many boundaries
//! are sampled less densely, and of 32,768 and more some are passed over. For a formula whose
//! derivatives are too large, the points of the grid decide, [`ExtremumSite::Pixel`].
//!
//! A quantity that has one value all over the body, except for rounding, has it everywhere,
//! [`ExtremumSite::Everywhere`].
//!
//! A quantity may be infinite at the points where functions of the field are singular, which are
//! known: tips, singular corners, points of forces, what functions declare. Whether it is, and
//! with which sign, is seen in how it grows towards the point; then the extremum is infinite, and
//! its place is the point. Values next to such a point, within a thousandth of a square, are left
//! out: there the last digits of the field decide. Besides, an extremum is infinite if the value at
//! a place of the grid is, or if the search ends at a pole, as of 1/x. Elsewhere it is a
//! number that the quantity has at the place.

mod bent;
mod cells;
mod climb;
mod curves;
mod even;
mod poles;
mod region;
mod rings;
mod singular;
mod site;

use std::fmt;

use ppum::field::{Field, LocalField};
use ppum::function::Slot;
use ppum::progress::Watcher;
use ppum::quantity::{Quantity, QuantityGradient};
use ppum::vec2::{Rect, Vec2};
use ppum_raster::RasterError;
use ppum_raster::parts::Parts;
use ppum_raster::raster::{Raster, RasterValue};
use ppum_raster::scatter::render;
use ppum_raster::view::View;
use rayon::prelude::*;

use climb::Climber;
use curves::{BoundaryCurve, Promise};
pub use region::BodyRegion;
pub use singular::{SingularKind, SingularPoint};
pub use site::ExtremumSite;

/// Pixels and samples of boundaries from which the search begins, at most, and how many of them
/// before the rest is looked at again: the most promising ones first.
const STARTS: usize = 32;
const ROUND: usize = 8;

/// Samples of boundaries in any field, and more as long as the functions of a patch take no more
/// than some operations, together, but not more than the most.
const FEWEST: usize = 1 << 13;
const SAMPLES: usize = 1 << 15;
const OPERATIONS: usize = 1 << 28;

/// Pixels of the image from which a search begins, in any field and at most, between which the same
/// operations decide.
const FEWEST_PIXELS: usize = 1 << 10;
const PIXELS: usize = 1 << 18;

/// Segments of cracks that take as long as a sample: on each face all of them are seen again.
const SEGMENTS: usize = 64;

/// Boundaries that are looked at, at most, where those of cracks with many segments count more.
const CURVES: usize = 1 << 15;

/// Part of a value by which it may differ on a face and right beside it.
const SAME: f64 = 1e-6;

/// Part of a value on a boundary by which one inside has to exceed it.
const EQUAL: f64 = 1e-12;

/// Distance from a singular point below which finite values are left out, squares of the grid.
const HIDDEN: f64 = 1e-3;

/// An extreme value of a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremum {
    /// The value, to about 10⁻⁶ of its size; ±∞ at a singular point.
    pub value: f64,
    /// Its place, as an offset from [`Extrema::center`].
    pub offset: Vec2,
    /// The feature that the place lies on.
    pub on: ExtremumSite,
}

/// Minimum and maximum of a quantity over a part of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Extrema {
    /// The point of the undeformed body from which places are counted, whichever image shows
    /// them.
    pub center: Vec2,
    /// The smallest value.
    pub min: Extremum,
    /// The largest value.
    pub max: Extremum,
    /// The points at which the quantity is infinite because a function of the field is singular.
    pub singular: Vec<SingularPoint>,
}

impl fmt::Display for Extrema {
    /// `min 0.1 at -0.2,0.3 inside max inf at 0.5,0.0 singular`, with the shortest numbers that
    /// mean the doubles and places as offsets from the centre.
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
    pub fn of_pixels<T: RasterValue>(raster: &Raster<T>, view: &View) -> Option<Self> {
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
            Extremum { value, offset, on: ExtremumSite::Pixel }
        };
        let (center, singular) = (view.center, Vec::new());
        Some(Self { center, min: place(least), max: place(most), singular })
    }

    /// True if the quantity is infinite somewhere, at a singular point or at a pixel.
    #[must_use]
    pub fn is_infinite(&self) -> bool {
        self.min.value.is_infinite() || self.max.value.is_infinite()
    }

    /// Returns the extrema with places relative to another point.
    #[must_use]
    pub fn seen_from(self, center: Vec2) -> Self {
        let away = self.center - center;
        let moved = |e: Extremum| Extremum { offset: e.offset + away, ..e };
        let point = |p: SingularPoint| SingularPoint { offset: p.offset + away, ..p };
        let (min, max) = (moved(self.min), moved(self.max));
        Self { center, min, max, singular: self.singular.into_iter().map(point).collect() }
    }

    /// The smaller minimum and the larger maximum of two, by the centre of the first; of equal ones
    /// that of the first.
    #[must_use]
    pub fn united(self, other: &Self) -> Self {
        let other = other.clone().seen_from(self.center);
        let min = if other.min.value < self.min.value { other.min } else { self.min };
        let max = if other.max.value > self.max.value { other.max } else { self.max };
        // what is constant in each of two parts need not be so in both
        let place = |extremum: Extremum| match extremum.on {
            ExtremumSite::Everywhere if min.value != max.value => {
                Extremum { on: ExtremumSite::Inside, ..extremum }
            }
            _ => extremum,
        };
        let mut singular = self.singular;
        let new = other.singular.into_iter().filter(|point| !singular.contains(point));
        singular.extend(new.collect::<Vec<_>>());
        Self { center: self.center, min: place(min), max: place(max), singular }
    }

    /// The value of a quantity that has one all over the body, except for rounding.
    #[must_use]
    pub fn constant(&self) -> Option<f64> {
        let ([min, max], on) = ([self.min, self.max], ExtremumSite::Everywhere);
        (min.on == on && max.on == on && min.value == max.value).then_some(max.value)
    }

    /// True if between the centres of pixels nothing was looked at.
    #[must_use]
    pub fn is_of_pixels(&self) -> bool {
        self.max.on == ExtremumSite::Pixel
    }
}

/// Minimum and maximum of a quantity over a region of a body; `None` if the quantity is nowhere
/// defined there. They depend on the region alone, not on an image of it ([module](self)).
///
/// # Errors
/// The quantity has no meaning for the field; the watcher stops the call.
pub fn extrema(
    field: &Field<'_>,
    region: &BodyRegion,
    quantity: &Quantity,
    watcher: &dyn Watcher,
) -> Result<Option<Extrema>, RasterError> {
    quantity.check(field)?;
    let Some(grid) = region.grid(pixels(field)) else { return Ok(None) };
    let raster = render::<f64>(field, &grid, quantity, watcher)?;
    if let Some(constant) = constant(field, region, quantity, &raster) {
        return Ok(Some(constant));
    }
    // of a formula whose derivatives are too large
    let Ok(slope) = QuantityGradient::new(quantity, field) else {
        return Ok(Extrema::of_pixels(&raster, &grid));
    };
    Parts::start(watcher, 1)?;
    let singular = singular::singular_points(field, region, quantity);
    let hidden: Vec<_> = singular.iter().map(|point| point.offset).collect();
    let mut curves = boundaries(field, region, grid.pixel_size());
    let mut samples = samples(field, &curves, grid.pixel_size());
    curves.extend(rings::faces(&curves, &hidden, grid.pixel_size()));
    samples.resize(curves.len(), curves::LEAST);
    let parts = Parts::start(watcher, curves.len() + 4 * STARTS.div_ceil(ROUND) + 2)?;
    let (region, pixel) = (*region, grid.pixel_size());
    let search = ExtremumSearch { field, region, pixel, slope: &slope, hidden, curves, parts };
    let sampled = search.sampled(&samples)?;
    let best = |sign: f64| match infinite(&singular, sign) {
        None => search.extremum(&sampled, (&raster, &grid), sign),
        found => Ok(found),
    };
    let [Some(min), Some(max)] = [best(-1.0)?, best(1.0)?] else {
        return Ok(Extrema::of_pixels(&raster, &grid));
    };
    let grows = |point: &SingularPoint| point.max_infinite || point.min_infinite;
    let singular = singular.into_iter().filter(grows).collect();
    Ok(Some(Extrema { center: region.anchor, min, max, singular }))
}

/// The extrema of a quantity that has one value all over the body, except for rounding: what is
/// constant or zero within the digits that the file bears.
fn constant(
    field: &Field<'_>,
    region: &BodyRegion,
    quantity: &Quantity,
    raster: &Raster,
) -> Option<Extrema> {
    let [value, reach] = even::value(field, quantity)?;
    // a formula may differ somewhere
    let is_same = |v: f64| v.is_nan() || (v - value).abs() <= reach;
    if !raster.values.iter().all(|&v| is_same(v)) {
        return None;
    }
    let offset = Vec2::ZERO.max(region.rect.min).min(region.rect.max);
    let one = Extremum { value, offset, on: ExtremumSite::Everywhere };
    Some(Extrema { center: region.anchor, min: one, max: one, singular: Vec::new() })
}

/// The boundaries on which an extremum may lie; of too many every second, third … one.
fn boundaries(field: &Field<'_>, region: &BodyRegion, pixel: f64) -> Vec<BoundaryCurve> {
    let BodyRegion { anchor, rect } = region;
    let mut curves = curves::boundary_curves(field, *anchor, rect);
    let bent = bent::bent_interfaces(field, *anchor, rect, pixel);
    curves.extend(bent.into_iter().map(|bent| BoundaryCurve::bent(bent, ExtremumSite::Interface)));
    let segments: usize = field.step.cracks.iter().map(|crack| crack.points.len()).sum();
    let is_face = |curve: &&BoundaryCurve| matches!(curve.on, ExtremumSite::Face(..));
    let costs = curves.len() + curves.iter().filter(is_face).count() * (segments / SEGMENTS);
    curves.into_iter().step_by(costs.div_ceil(CURVES).max(1)).collect()
}

/// The number of samples of each curve.
fn samples(field: &Field<'_>, curves: &[BoundaryCurve], pixel: f64) -> Vec<usize> {
    let counts = curves.iter().map(|curve| curve.samples(pixel));
    let all: usize = counts.clone().sum();
    let affordable = (OPERATIONS / operations(field)).clamp(FEWEST, SAMPLES);
    let part = (affordable as f64 / all as f64).min(1.0);
    counts.map(|n| ((n as f64 * part) as usize).max(curves::LEAST)).collect()
}

/// The number of pixels from which a search begins: it depends on the field alone.
fn pixels(field: &Field<'_>) -> usize {
    (OPERATIONS / operations(field)).clamp(FEWEST_PIXELS, PIXELS)
}

/// Operations of the functions of a patch, on the average, and of the material, whose formulas have
/// no more of them than characters.
fn operations(field: &Field<'_>) -> usize {
    let functions = &field.functions;
    let cost = |&function: &u32| match functions.of(function) {
        Slot::One => 0,
        Slot::Jet { group, .. } => {
            let group = group as usize;
            functions.cost(group, &field.step.cracks) / functions.group_len(group)
        }
    };
    let all: usize = field.data.block_function.iter().map(cost).sum();
    let material: usize = field.equation.constants().map(|(_, e)| e.formula().text().len()).sum();
    1 + all / field.step.partition.len() + material
}

/// The data of a search.
struct ExtremumSearch<'a, 'f> {
    field: &'a Field<'f>,
    region: BodyRegion,
    /// The side of the squares of the grid.
    pixel: f64,
    slope: &'a QuantityGradient,
    /// Singular points.
    hidden: Vec<Vec2>,
    curves: Vec<BoundaryCurve>,
    parts: Parts<'a>,
}

impl ExtremumSearch<'_, '_> {
    /// The extremum beside singular points, largest for the sign 1 and smallest for −1; infinite if
    /// a value of the grid is, or at a pole.
    fn extremum(
        &self,
        sampled: &[Vec<f64>],
        (raster, grid): (&Raster, &View),
        sign: f64,
    ) -> Result<Option<Extremum>, RasterError> {
        let (value, away) = (sign * f64::INFINITY, grid.center - self.region.anchor);
        let columns = grid.pixels[0] as usize;
        let place = |k: usize| grid.offset((k % columns) as u32, (k / columns) as u32) + away;
        let infinite = (0..raster.values.len())
            .filter(|&k| raster.values[k] == value)
            .map(place)
            .find(|&at| !self.is_hidden(at));
        if let Some(offset) = infinite {
            return Ok(Some(Extremum { value, offset, on: ExtremumSite::Inside }));
        }
        let starts = climb::starts(raster, sign, STARTS).into_iter();
        let starts = starts.map(|(promise, [i, j])| (promise, grid.offset(i, j) + away)).collect();
        let best = self.finite(sampled, starts, sign)?;
        Ok(best.map(|best| if self.is_pole(&best) { Extremum { value, ..best } } else { best }))
    }

    /// The quantity along each curve.
    fn sampled(&self, samples: &[usize]) -> Result<Vec<Vec<f64>>, RasterError> {
        let anchor = self.region.anchor;
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

    /// The extremum that is found from the samples of curves, from some places, from small cells
    /// and beside singular points.
    fn finite(
        &self,
        sampled: &[Vec<f64>],
        starts: Vec<Promise<Vec2>>,
        sign: f64,
    ) -> Result<Option<Extremum>, RasterError> {
        let tops = curves::tops(sampled, sign, STARTS);
        let on_curve = |&[curve, sample]: &[usize; 2]| {
            Some(self.refined(&self.curves[curve], &sampled[curve], sample, sign))
        };
        let best = self.rounds(None, &tops, sign, on_curve)?;
        let inside = |&at: &Vec2| self.climbed(at, self.pixel, sign);
        let best = self.rounds(best, &starts, sign, inside)?;
        let beside = |&(at, scale): &(Vec2, f64)| self.climbed(at, scale, sign);
        let best = self.rounds(best, &self.in_small_cells(sign), sign, beside)?;
        self.rounds(best, &self.beside_singular(sign), sign, beside)
    }

    /// Looks at places, the most promising first, while they promise more than what is found.
    fn rounds<P: Sync>(
        &self,
        mut best: Option<Extremum>,
        places: &[Promise<P>],
        sign: f64,
        look: impl Fn(&P) -> Option<Extremum> + Sync,
    ) -> Result<Option<Extremum>, RasterError> {
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
        let mut local = curve.local(self.field, self.region.anchor);
        let mut value = |t: f64| self.on_curve(&mut local, curve, t);
        let (value, t) = curves::golden(&mut value, sign, values, sample);
        Extremum { value, offset: curve.at(t, 0.0), on: curve.on }
    }

    /// The quantity at a part of the way along a curve; NaN where it is infinite, and next to such
    /// a point, and where the curve has left the region, as rims may.
    fn on_curve(&self, local: &mut LocalField<'_>, curve: &BoundaryCurve, t: f64) -> f64 {
        let [on, beside] = [0.0, self.pixel].map(|pixel| curve.at(t, pixel));
        if self.is_hidden(beside) || !self.is_seen(on) {
            return f64::NAN;
        }
        let mut value = |at: Vec2| climb::finite(self.slope.quantity().at(local, at, curve.side()));
        let limit = value(beside);
        if curve.segment().is_none() {
            return limit;
        }
        // At a vertex functions that see different segments take different sides, and a patch may
        // end on a crack that has no part in one of its sides: then the face has the limit alone.
        let on_face = value(on);
        let is_limit = (on_face - limit).abs() <= SAME * on_face.abs().max(limit.abs());
        if is_limit { on_face } else { limit }
    }

    /// The extremum uphill (downhill for the sign −1) from a point, by steps of a scale.
    fn climbed(&self, start: Vec2, scale: f64, sign: f64) -> Option<Extremum> {
        let (rect, local) = (self.region.rect, self.field.at(self.region.anchor));
        let is_hidden = |at| self.is_hidden(at);
        let mut climber = Climber { slope: self.slope, local, rect, sign, is_hidden };
        let (value, offset) = climber.climb(start, scale)?;
        let Rect { min, max } = rect;
        let is_end = |v: f64, [a, b]: [f64; 2]| v == a || v == b;
        let on_border = is_end(offset.x, [min.x, max.x]) || is_end(offset.y, [min.y, max.y]);
        Some(Extremum {
            value,
            offset,
            on: if on_border { ExtremumSite::Border } else { ExtremumSite::Inside },
        })
    }

    /// True within the region, except for rounding.
    fn is_seen(&self, at: Vec2) -> bool {
        let nearest = at.max(self.region.rect.min).min(self.region.rect.max);
        (at - nearest).length() <= 1e-6 * self.pixel
    }

    /// True next to a singular point.
    fn is_hidden(&self, at: Vec2) -> bool {
        let reach = HIDDEN * self.pixel;
        self.hidden.iter().any(|&point| (at - point).length() < reach)
    }
}

/// The largest (smallest for the sign −1) of some values, the first of equal ones; one inside has
/// to exceed others by more than rounding, so that what lies on a boundary is not found beside it.
fn largest(all: impl Iterator<Item = Extremum>, sign: f64) -> Option<Extremum> {
    let exceeds = |a: &Extremum, b: &Extremum| {
        let least = if a.on == ExtremumSite::Inside { EQUAL * b.value.abs() } else { 0.0 };
        sign * a.value > sign * b.value && (a.value - b.value).abs() > least
    };
    let known = all.filter(|found| !found.value.is_nan());
    known.reduce(|best, found| if exceeds(&found, &best) { found } else { best })
}

/// The first singular point where the quantity grows (falls for the sign −1) without bound.
fn infinite(singular: &[SingularPoint], sign: f64) -> Option<Extremum> {
    let grows =
        |point: &&SingularPoint| if sign > 0.0 { point.max_infinite } else { point.min_infinite };
    singular.iter().find(grows).map(|point| Extremum {
        value: sign * f64::INFINITY,
        offset: point.offset,
        on: ExtremumSite::Singular(point.kind),
    })
}

#[cfg(test)]
mod tests;
