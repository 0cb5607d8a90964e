//! Exact values along lines, cracks and circles, and near tips: as tables and as plots.

mod faces;
mod plot;

use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

use ppum::crack::{Crack, CrackEnd, TipId, tips};
use ppum::field::Field;
use ppum::progress::{Cancelled, Phase, Progress, Watcher};
use ppum::quantity::Quantity;
use ppum::sample::{self, Curve, Passage, SidedPoint};
use ppum::vec2::Vec2;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::report::table::{Column, NumberTable};
use plot::BESIDE;
pub use plot::{NamedQuantities, Variable, axis, columns, curve, unit, value_label};

/// A curve that values are looked at along.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ProfileCurve {
    /// The line between two points.
    Line {
        /// Where its points are counted from: zero, or a point near by so that none of their digits
        /// is lost.
        #[serde(default)]
        anchor: [f64; 2],
        /// Its start.
        from: [f64; 2],
        /// Its end.
        to: [f64; 2],
    },
    /// A circle, against the angle from the x axis in degrees.
    Circle {
        /// Its centre.
        center: [f64; 2],
        /// Its radius.
        radius: f64,
    },
    /// A crack, seen from both sides.
    Crack {
        /// Its number, from 0.
        index: usize,
    },
    /// A circle around a tip, against the angle θ from the crack's extension in degrees.
    Around {
        /// Number of the tip, from 0.
        tip: usize,
        /// Its radius; a hundredth of the crack's length if nothing is said.
        radius: Option<f64>,
    },
    /// A ray from a tip, against the distance r.
    Ray {
        /// Number of the tip, from 0.
        tip: usize,
        /// Its direction from the crack's extension in degrees; ±180 are the faces.
        angle: f64,
        /// Its length; a tenth of the crack's if nothing is said.
        far: Option<f64>,
    },
}

/// Values along a curve.
#[derive(Clone, Debug)]
pub struct Profile {
    /// A row for each place.
    pub table: NumberTable,
    /// The places; along a crack those above it.
    pub places: Vec<SidedPoint>,
    /// Quantities that have no value at some places of the body, with the number of these and of
    /// all.
    pub undefined: Vec<(String, [usize; 2])>,
}

/// A curve that a field has no values along.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// No such crack.
    #[error("the dataset has {}", counted(*.count, "crack", "cracks"))]
    Crack {
        /// The crack that was asked for.
        index: usize,
        /// Number of cracks.
        count: usize,
    },
    /// No such tip.
    #[error("the dataset has {}", counted(*.count, "crack tip", "crack tips"))]
    Tip {
        /// The tip that was asked for.
        number: usize,
        /// Number of tips.
        count: usize,
    },
    /// A line without length.
    #[error("its two points are equal")]
    Point,
    /// A circle or a ray without a radius that is positive and finite.
    #[error("its radius is not positive")]
    Radius,
    /// A curve of one point.
    #[error("a line has two points or more")]
    FewPoints,
    /// Too many points.
    #[error("at most {MOST} points at a time")]
    ManyPoints,
    /// The watcher stopped the call.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

fn counted(count: usize, one: &str, more: &str) -> String {
    match count {
        0 => format!("no {more}"),
        1 => format!("1 {one}, numbered from 0"),
        _ => format!("{count} {more}, numbered from 0"),
    }
}

/// Points along a curve if nothing is said.
pub const COUNT: usize = 201;

/// Most points at a time: their table takes some gigabytes.
pub const MOST: usize = 20_000_000;

/// Values of a curve's variable that are the same except for rounding, in parts of its range.
const SAME: f64 = 1e-12;

/// The smallest distance of a ray from its tip, in parts of the largest.
const NEAREST: f64 = 1e-6;

/// Radius of a circle around a tip, and length of a ray, in parts of the crack's length.
const RADIUS: f64 = 0.01;
const FAR: f64 = 0.1;

impl ProfileCurve {
    /// The variable.
    #[must_use]
    pub fn variable(&self) -> Variable {
        match self {
            Self::Line { .. } | Self::Crack { .. } => Variable::Length,
            Self::Circle { .. } | Self::Around { .. } => Variable::Angle,
            Self::Ray { .. } => Variable::Distance,
        }
    }

    /// True if the curve is a crack, seen from both sides.
    #[must_use]
    pub fn is_crack(&self) -> bool {
        matches!(self, Self::Crack { .. })
    }

    /// One row for each place: the variable, position, side, quantities; of a crack those of both
    /// sides, jumps and opening.
    ///
    /// # Errors
    /// See [`ProfileError`].
    pub fn table(
        &self,
        field: &Field<'_>,
        quantities: &NamedQuantities,
        count: usize,
        watcher: &dyn Watcher,
    ) -> Result<Profile, ProfileError> {
        check(count)?;
        if let Self::Crack { index } = self {
            return faces::table(field, quantities, *index, &sample::evenly(count), watcher);
        }
        let places = self.places(field, &sample::evenly(count))?;
        self.listed(field, quantities, places, watcher)
    }

    /// The table of a curve that is drawn: points of lines and cracks crowd at tips, and a line or
    /// a circle has both sides of the cracks that it passes through, first that from which it
    /// comes; at its ends that alone which it runs on. A crack has points just before and behind
    /// its vertices, where opening and sliding jump with its normal.
    ///
    /// # Errors
    /// See [`ProfileError`].
    pub fn drawn(
        &self,
        field: &Field<'_>,
        quantities: &NamedQuantities,
        count: usize,
        watcher: &dyn Watcher,
    ) -> Result<Profile, ProfileError> {
        check(count)?;
        let is_circle = matches!(self, Self::Circle { .. });
        let parts = sample::crowded(count, &self.parts_at_tips(field, count));
        if let Self::Crack { index } = self {
            let vertices = field.step.cracks.get(*index).map(parts_beside_vertices);
            let mut parts = [parts, vertices.unwrap_or_default()].concat();
            parts.sort_by(f64::total_cmp);
            return faces::table(field, quantities, *index, &parts, watcher);
        }
        let mut places = self.places(field, &parts)?;
        let Some(passages) = self.passages(field) else {
            return self.listed(field, quantities, places, watcher);
        };
        let [Some((start, _)), Some((end, _))] =
            [places.first(), places.last()].map(|p| p.copied())
        else {
            return self.listed(field, quantities, places, watcher);
        };
        let is_same = |a: f64, b: f64| (a - b).abs() <= SAME * (end - start);
        for passage in passages {
            let at = if is_circle { passage.at.to_degrees() } else { passage.at };
            let [before, after] = passage.places;
            let is_seam = is_circle && is_same(at.abs(), end);
            let sides = match () {
                () if is_seam => vec![(start, after), (end, before)],
                () if is_same(at, start) => vec![(start, after)],
                () if is_same(at, end) => vec![(end, before)],
                () => vec![(at, before), (at, after)],
            };
            let is_replaced = |v: f64| sides.iter().any(|(at, _)| is_same(v, *at));
            places.retain(|(v, place)| place.on.is_none() || !is_replaced(*v));
            for (at, place) in sides {
                let next = places.partition_point(|(v, _)| *v <= at);
                places.insert(next, (at, place));
            }
        }
        self.listed(field, quantities, places, watcher)
    }

    /// The parts of a crack's or a line's length at which there are tips; a line has those that are
    /// nearer than its points are to each other.
    fn parts_at_tips(&self, field: &Field<'_>, count: usize) -> Vec<f64> {
        let cracks = &field.step.cracks;
        let mut parts: Vec<f64> = match *self {
            Self::Crack { index } => {
                let ends = cracks.get(index).map(|crack| [0.0, 1.0].into_iter().zip(crack.ends));
                let is_tip = |(_, end): &(f64, CrackEnd)| *end == CrackEnd::Tip;
                ends.into_iter().flatten().filter(is_tip).map(|(part, _)| part).collect()
            }
            Self::Line { anchor, from, to } => {
                let [anchor, from, to] = [anchor, from, to].map(Vec2::from);
                let (way, near) = (to - from, (to - from).length() / count as f64);
                let part = |tip: TipId| {
                    let way_to = cracks[tip.crack as usize].end_point(tip.end) - anchor - from;
                    let part = (way_to.dot(way) / way.dot(way)).clamp(0.0, 1.0);
                    ((way_to - way * part).length() < near).then_some(part)
                };
                tips(cracks).filter_map(part).collect()
            }
            _ => Vec::new(),
        };
        parts.sort_by(f64::total_cmp);
        parts
    }

    /// Where a line or a circle passes through cracks; nothing of other curves.
    fn passages(&self, field: &Field<'_>) -> Option<Vec<Passage>> {
        let (anchor, curve) = match *self {
            Self::Line { anchor, from, to } => (anchor, Curve::Line([from.into(), to.into()])),
            Self::Circle { center, radius } => (center, Curve::Circle(Vec2::ZERO, radius)),
            _ => return None,
        };
        Some(sample::passages_from(&field.step.cracks, anchor.into(), curve))
    }

    fn listed(
        &self,
        field: &Field<'_>,
        quantities: &NamedQuantities,
        places: Vec<(f64, SidedPoint)>,
        watcher: &dyn Watcher,
    ) -> Result<Profile, ProfileError> {
        let (variables, mut places): (Vec<_>, Vec<_>) = places.into_iter().unzip();
        if matches!(self, Self::Line { .. } | Self::Circle { .. }) {
            sample::settle(field.domain, &mut places);
        }
        let variable = self.variable();
        let first = Column::new(variable.name(), variable.unit());
        let mut profile = listed(field, quantities, places, watcher)?;
        profile.table = profile.table.with_first(first, variables);
        Ok(profile)
    }

    /// The places of a line, a circle or a tip with the variable.
    fn places(
        &self,
        field: &Field<'_>,
        parts: &[f64],
    ) -> Result<Vec<(f64, SidedPoint)>, ProfileError> {
        let (cracks, count) = (&field.step.cracks, parts.len());
        let positive = |radius: f64| match radius > 0.0 && radius.is_finite() {
            true => Ok(radius),
            false => Err(ProfileError::Radius),
        };
        let places = match *self {
            Self::Line { anchor, from, to } => line(field, [anchor, from, to], parts)?,
            Self::Circle { center, radius } => {
                in_degrees(sample::circle(cracks, center.into(), positive(radius)?, count))
            }
            Self::Around { tip: number, radius } => {
                let (tip, length) = numbered(field, number)?;
                let radius = positive(radius.unwrap_or(RADIUS * length))?;
                in_degrees(sample::around(cracks, tip, radius, count).unwrap_or_default())
            }
            Self::Ray { tip: number, angle, far } => {
                let (tip, length) = numbered(field, number)?;
                let far = positive(far.unwrap_or(FAR * length))?;
                let ends = [NEAREST * far, far];
                sample::ray(cracks, tip, radians(angle), ends, count).unwrap_or_default()
            }
            Self::Crack { .. } => Vec::new(),
        };
        Ok(places)
    }
}

/// The parts of a crack's length at its inner vertices, each a little less and a little more.
fn parts_beside_vertices(crack: &Crack) -> Vec<f64> {
    let (mut at, total) = (0.0, crack.length());
    let inner = crack.edges().take(crack.points.len().saturating_sub(2));
    inner
        .flat_map(|edge| {
            at += edge.length() / total;
            [at - BESIDE, at + BESIDE]
        })
        .collect()
}

fn check(count: usize) -> Result<(), ProfileError> {
    match count {
        0 | 1 => Err(ProfileError::FewPoints),
        2..=MOST => Ok(()),
        _ => Err(ProfileError::ManyPoints),
    }
}

/// The tip of a number with its crack's length.
fn numbered(field: &Field<'_>, number: usize) -> Result<(TipId, f64), ProfileError> {
    let cracks = &field.step.cracks;
    let missing = || ProfileError::Tip { number, count: tips(cracks).count() };
    let tip = tips(cracks).nth(number).ok_or_else(missing)?;
    Ok((tip, cracks[tip.crack as usize].length()))
}

/// An angle in degrees, at ±180 exactly that of the faces.
fn radians(angle: f64) -> f64 {
    if angle.abs() == 180.0 { angle.signum() * PI } else { angle.to_radians() }
}

fn in_degrees(places: Vec<(f64, SidedPoint)>) -> Vec<(f64, SidedPoint)> {
    places.into_iter().map(|(t, place)| (t.to_degrees(), place)).collect()
}

/// The places of a line with their distances from its start.
fn line(
    field: &Field<'_>,
    ends: [[f64; 2]; 3],
    parts: &[f64],
) -> Result<Vec<(f64, SidedPoint)>, ProfileError> {
    let ([anchor, a, b], cracks) = (ends.map(Vec2::from), &field.step.cracks);
    if a == b {
        return Err(ProfileError::Point);
    }
    if anchor == Vec2::ZERO {
        let places = sample::line(cracks, [a, b], parts).into_iter();
        return Ok(places.map(|place| ((place.point - a).length(), place)).collect());
    }
    let places = sample::line_from(cracks, anchor, [a, b], parts).into_iter();
    Ok(places.map(|place| ((place.offset - a).length(), place)).collect())
}

/// The quantities at all places, one row for each, on all cores.
fn evaluate(
    field: &Field<'_>,
    quantities: &[Quantity],
    places: &[SidedPoint],
    watcher: &dyn Watcher,
) -> Result<Vec<f64>, Cancelled> {
    let (done, total) = (AtomicUsize::new(0), places.len());
    let values = |batch: &&[SidedPoint]| {
        let done = done.fetch_add(batch.len(), Ordering::Relaxed);
        watcher.report(Progress::new(Phase::Evaluation, done, total))?;
        Ok(sample::evaluate_batch(field, quantities, batch))
    };
    let batches: Vec<_> = sample::batches(places).collect();
    let rows = batches.par_iter().map(values).collect::<Result<Vec<_>, Cancelled>>()?;
    Ok(rows.concat())
}

/// One row for each place: position, side, quantities.
///
/// # Errors
/// Cancelled.
pub fn listed(
    field: &Field<'_>,
    quantities: &NamedQuantities,
    places: Vec<SidedPoint>,
    watcher: &dyn Watcher,
) -> Result<Profile, Cancelled> {
    let wanted: Vec<_> = quantities.iter().map(|(_, quantity)| quantity.clone()).collect();
    let values = evaluate(field, &wanted, &places, watcher)?;
    let undefined = undefined(field, quantities, &places, &values);
    let of = |(name, quantity): &(String, Quantity)| Column::new(name, quantity.unit(field));
    let head = ["x", "y", "side"].map(|name| Column::new(name, ""));
    let columns = head.into_iter().chain(quantities.iter().map(of)).collect();
    let mut rows = Vec::with_capacity(places.len() * (3 + quantities.len()));
    for (place, values) in places.iter().zip(values.chunks(quantities.len())) {
        rows.extend([place.point.x, place.point.y, place.mark()]);
        rows.extend(values);
    }
    Ok(Profile { table: NumberTable::new(columns, rows), places, undefined })
}

/// The quantities that have no value at places of the body.
fn undefined(
    field: &Field<'_>,
    quantities: &NamedQuantities,
    places: &[SidedPoint],
    values: &[f64],
) -> Vec<(String, [usize; 2])> {
    let width = quantities.len();
    let is_inside = |k: usize| match field.step.partition.mesh() {
        Some(_) => places[k].seen(field).contains(places[k].offset),
        None => field.domain.at(places[k].anchor).contains(places[k].offset),
    };
    let missing = |(column, (name, _)): (usize, &(String, Quantity))| {
        let is_undefined = |k: &usize| values[k * width + column].is_nan() && is_inside(*k);
        let count = (0..places.len()).filter(is_undefined).count();
        let inside = || (0..places.len()).filter(|&k| is_inside(k)).count();
        (count > 0).then(|| (name.clone(), [count, inside()]))
    };
    quantities.iter().enumerate().filter_map(missing).collect()
}
