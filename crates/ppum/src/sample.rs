//! Sampling: quantities at many places, along lines and cracks, on grids, at points.
//!
//! A [`SidedPoint`], here called a place, is a point with the side of a crack that is meant.
//! [`line()`], [`grid`], [`points`] and [`SamplePoints`] choose places, [`evaluate`] finds the
//! values there. A point on a crack has two sides and two places. Callers with threads take the
//! [`batches`] one by one, in any order: values do not depend on it. [`AnchorMap`] and
//! [`evaluate_each`] are for lists of points that come from anywhere: there a value depends on its
//! place alone.
//!
//! ```
//! # use ppum::dataset::Dataset;
//! use ppum::field::Field;
//! use ppum::progress::unwatched;
//! use ppum::quantity::Quantity;
//! use ppum::sample;
//! use ppum::vec2::vec2;
//!
//! # fn sampled(dataset: &Dataset) -> Result<(), Box<dyn std::error::Error>> {
//! let field = Field::new(dataset, 0)?;
//! let ends = [vec2(-1.0, 0.1), vec2(1.0, 0.1)];
//! let places = sample::line(&field.step.cracks, ends, &sample::evenly(201));
//! let quantities = [Quantity::parse("uy", &field)?, Quantity::parse("von-mises", &field)?];
//! let rows = sample::evaluate(&field, &quantities, &places, unwatched())?;
//! for (place, row) in places.iter().zip(rows.chunks(quantities.len())) {
//!     println!("{} {} {:?}", place.point.x, place.point.y, row);
//! }
//! # Ok(())
//! # }
//! ```

mod anchors;
mod crossings;
mod each;
mod place;

use std::f64::consts::PI;

use crate::crack::{Crack, End, SegmentId, Side, TipId};
use crate::field::Field;
use crate::progress::{Cancelled, Phase, Progress, Watcher};
use crate::quantity::Quantity;
use crate::sides::Segments;
use crate::vec2::{Rect, Vec2, vec2};
pub use anchors::AnchorMap;
pub use crossings::{Curve, Passage, passages_from};
pub use each::{SampledQuantity, evaluate_each};
pub use place::{SidedPoint, settle};

/// Points that share an anchor: near each other, and few enough to be work for one thread.
const BLOCK: usize = 256;

/// Most places of a batch.
const BATCH: usize = 4 * BLOCK;

/// Groups of consecutive places that can be evaluated at once, in their order. They are non-empty,
/// no longer than some thousand places, and together they are all of them.
pub fn batches(places: &[SidedPoint]) -> impl Iterator<Item = &[SidedPoint]> {
    let origin = |place: &SidedPoint| (place.anchor, place.on, place.side);
    places.chunk_by(move |a, b| origin(a) == origin(b)).flat_map(|run| run.chunks(BATCH))
}

/// The quantities at the places of one of the [`batches`], one row for each place; NaN outside the
/// domain and where a quantity has no value.
#[must_use]
pub fn evaluate_batch(
    field: &Field<'_>,
    quantities: &[Quantity],
    batch: &[SidedPoint],
) -> Vec<f64> {
    let Some(first) = batch.first() else { return Vec::new() };
    let offsets: Vec<Vec2> = batch.iter().map(|place| place.offset).collect();
    Quantity::at_many(quantities, &mut first.seen(field), &offsets, first.side)
}

/// The quantities at all places, one row for each: shape (places, quantities), flattened; NaN
/// outside the domain and where a quantity has no value. The values are those of [`Quantity::at`]
/// up to rounding.
///
/// # Errors
/// The watcher, told after each batch, stops the call.
pub fn evaluate(
    field: &Field<'_>,
    quantities: &[Quantity],
    places: &[SidedPoint],
    watcher: &dyn Watcher,
) -> Result<Vec<f64>, Cancelled> {
    let total = places.len();
    let mut rows = Vec::with_capacity(total * quantities.len());
    let mut done = 0;
    for batch in batches(places) {
        watcher.report(Progress::new(Phase::Evaluation, done, total))?;
        rows.extend(evaluate_batch(field, quantities, batch));
        done += batch.len();
    }
    Ok(rows)
}

/// Places at points, on both sides where one lies on a crack: above, then below.
#[must_use]
pub fn points(cracks: &[Crack], points: &[Vec2]) -> Vec<SidedPoint> {
    sided(&Segments::new(cracks), points).flatten().collect()
}

/// The parts of a curve at which `count` points lie at equal distances: from 0 to 1, both included;
/// the middle if there is one alone.
#[must_use]
pub fn evenly(count: usize) -> Vec<f64> {
    let part = |k: usize| if count == 1 { 0.5 } else { k as f64 / (count - 1) as f64 };
    (0..count).map(part).collect()
}

/// The parts of a curve at which `count` points lie that crowd at some parts of it, given in
/// ascending order: at a distance d from such a part they lie some √d apart, as the graph of a
/// square root needs them.
#[must_use]
pub fn crowded(count: usize, at: &[f64]) -> Vec<f64> {
    let part = |even: f64| {
        let next = at.partition_point(|&at| at <= even);
        let (before, after) = (next.checked_sub(1).map(|k| at[k]), at.get(next).copied());
        let (from, to) = (before.unwrap_or(0.0), after.unwrap_or(1.0));
        let t = if from < to { (even - from) / (to - from) } else { 0.0 };
        let one = |t: f64| 0.5 * t * t * (3.0 - t);
        from + (to - from)
            * match (before, after) {
                (None, None) => t,
                (Some(_), None) => one(t),
                (None, Some(_)) => 1.0 - one(1.0 - t),
                (Some(_), Some(_)) => t * t * (3.0 - 2.0 * t),
            }
    };
    evenly(count).into_iter().map(part).collect()
}

/// Places at parts of the line from a to b, see [`evenly`]; both are met exactly. On both sides
/// where one lies on a crack.
#[must_use]
pub fn line(cracks: &[Crack], ends: [Vec2; 2], parts: &[f64]) -> Vec<SidedPoint> {
    let all: Vec<Vec2> = parts.iter().map(|&part| between(ends, part)).collect();
    points(cracks, &all)
}

/// Returns the points from `anchor + a` to `anchor + b`: near the anchor no digit of the points is
/// lost.
#[must_use]
pub fn line_from(
    cracks: &[Crack],
    anchor: Vec2,
    ends: [Vec2; 2],
    parts: &[f64],
) -> Vec<SidedPoint> {
    let segments = Segments::new(cracks);
    let offsets = parts.iter().map(|&part| between(ends, part));
    offsets.flat_map(|offset| SidedPoint::sides(&segments, anchor, offset)).collect()
}

/// Places at the points of a grid of nx columns and ny rows that includes the boundaries of the
/// window, in rows of constant y, the lowest first. Points on cracks are taken on the upper side
/// alone.
#[must_use]
pub fn grid(cracks: &[Crack], window: Rect, [nx, ny]: [u32; 2]) -> Vec<SidedPoint> {
    let (Rect { min, max }, segments) = (window, Segments::new(cracks));
    let [columns, rows] = [nx, ny].map(|count| evenly(count as usize));
    let row = |part: f64| {
        let y = between([min, max], part).y;
        let x = |&part: &f64| between([min, max], part).x;
        let points: Vec<Vec2> = columns.iter().map(|part| vec2(x(part), y)).collect();
        sided(&segments, &points).map(|places| places[0]).collect::<Vec<_>>()
    };
    rows.into_iter().flat_map(row).collect()
}

/// Places on a circle at `count` equal steps of the angle from −π to π about the x axis, both
/// included. On both sides where one lies on a crack.
#[must_use]
pub fn circle(cracks: &[Crack], center: Vec2, radius: f64, count: usize) -> Vec<(f64, SidedPoint)> {
    let segments = Segments::new(cracks);
    let at = |angle: f64| {
        let places =
            SidedPoint::sides(&segments, center, direction(vec2(1.0, 0.0), angle) * radius);
        places.into_iter().map(move |place| (angle, place))
    };
    angles(count).flat_map(at).collect()
}

/// Places on a circle around a tip with their angles θ in the tip's frame, `count` equal steps from
/// −π to π, both included: there they lie on the faces of the crack if that is straight so far.
/// None if there is no such tip.
#[must_use]
pub fn around(
    cracks: &[Crack],
    tip: TipId,
    radius: f64,
    count: usize,
) -> Option<Vec<(f64, SidedPoint)>> {
    let frame = TipAxes::new(cracks, tip)?;
    Some(angles(count).map(|t| (t, frame.place(radius, t))).collect())
}

/// Places on the ray from a tip at an angle θ in the tip's frame, with their distances r from
/// `near` to `far`, `count` of them at equal steps of log r. None if there is no such tip.
#[must_use]
pub fn ray(
    cracks: &[Crack],
    tip: TipId,
    angle: f64,
    [near, far]: [f64; 2],
    count: usize,
) -> Option<Vec<(f64, SidedPoint)>> {
    let frame = TipAxes::new(cracks, tip)?;
    let part = |k: usize| k as f64 / count.saturating_sub(1).max(1) as f64;
    let distance = |k: usize| near * (far / near).powf(part(k));
    Some((0..count).map(distance).map(|r| (r, frame.place(r, angle))).collect())
}

/// Angles at `count` equal steps from −π to π, both included.
fn angles(count: usize) -> impl Iterator<Item = f64> {
    evenly(count).into_iter().map(|part| between([vec2(-PI, 0.0), vec2(PI, 0.0)], part).x)
}

/// The unit vector at an angle from another one, exactly opposite to it at ±π.
fn direction(axis: Vec2, angle: f64) -> Vec2 {
    if angle.abs() == PI {
        return -axis;
    }
    let (sin, cos) = angle.sin_cos();
    axis * cos + axis.left() * sin
}

/// The frame of a tip, for places near it.
struct TipAxes {
    tip: Vec2,
    /// Unit direction of growth.
    axis: Vec2,
    /// The edge that ends at the tip, and how far the crack is straight there.
    segment: SegmentId,
    length: f64,
    /// The side of the crack where θ is positive.
    positive: Side,
}

impl TipAxes {
    fn new(cracks: &[Crack], tip: TipId) -> Option<Self> {
        let crack = cracks.get(tip.crack as usize)?;
        let last = crack.points.len().checked_sub(2)?;
        let (segment, positive) = match tip.end {
            End::Start => (0, Side::Below),
            End::Last => (last, Side::Above),
        };
        let edge = crack.edge(segment);
        let length = if edge.is_arc() { 0.0 } else { edge.length() };
        let segment = SegmentId { crack: tip.crack, segment: segment as u32 };
        let (end, axis) = (crack.end_point(tip.end), crack.growth_direction(tip.end));
        Some(Self { tip: end, axis, segment, length, positive })
    }

    fn place(&self, radius: f64, angle: f64) -> SidedPoint {
        let offset = direction(self.axis, angle) * radius;
        let is_on = angle.abs() == PI && radius < self.length;
        let other = if self.positive == Side::Above { Side::Below } else { Side::Above };
        SidedPoint {
            point: self.tip + offset,
            anchor: self.tip,
            offset,
            on: is_on.then_some(self.segment),
            side: match is_on {
                true if angle < 0.0 => other,
                true => self.positive,
                false => Side::Above,
            },
        }
    }
}

/// One place for each point, two on a crack.
fn sided(segments: &Segments<'_>, points: &[Vec2]) -> impl Iterator<Item = Vec<SidedPoint>> {
    points
        .chunks(BLOCK)
        .flat_map(|block| block.iter().map(|&point| places(segments, block[0], point)))
}

/// The places of a point; seen from the anchor unless it lies on a crack.
fn places(segments: &Segments<'_>, anchor: Vec2, point: Vec2) -> Vec<SidedPoint> {
    let mut places = SidedPoint::sides(segments, point, Vec2::ZERO);
    if let [SidedPoint { on: None, anchor: own, offset, .. }] = &mut places[..] {
        (*own, *offset) = (anchor, point - anchor);
    }
    places
}

/// The point at a part of the way from a to b, both exactly at 0 and 1.
fn between([a, b]: [Vec2; 2], part: f64) -> Vec2 {
    if part == 1.0 { b } else { a + (b - a) * part }
}

/// Points along a crack, to be seen from both of its sides.
///
/// Each is seen from the nearer end of its segment, so that what is near a tip keeps its digits.
#[derive(Clone, Debug)]
pub struct SamplePoints(Vec<SamplePoint>);

/// A point of a crack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SamplePoint {
    /// Arc length from the crack's start.
    pub s: f64,
    /// Unit tangent of the crack.
    pub tangent: Vec2,
    anchor: Vec2,
    offset: Vec2,
    segment: SegmentId,
}

impl SamplePoints {
    /// The points at parts of the length of the crack of this index, see [`evenly`]. None if there
    /// is no such crack.
    #[must_use]
    pub fn along(cracks: &[Crack], index: u32, parts: &[f64]) -> Option<Self> {
        let crack = cracks.get(index as usize)?;
        let mut starts = vec![0.0];
        for edge in crack.edges() {
            starts.push(starts[starts.len() - 1] + edge.length());
        }
        let total = starts[starts.len() - 1];
        let at = |part: &f64| SamplePoint::new(crack, index, &starts, total * part);
        Some(Self(parts.iter().map(at).collect()))
    }

    /// The points, from the crack's start.
    #[must_use]
    pub fn all(&self) -> &[SamplePoint] {
        &self.0
    }

    /// The places above at all points, then those below.
    #[must_use]
    pub fn places(&self) -> Vec<SidedPoint> {
        let on = |side| self.0.iter().map(move |point| point.place(side));
        on(Side::Above).chain(on(Side::Below)).collect()
    }
}

impl SamplePoint {
    /// The point at arc length s; `starts` are those of the vertices.
    fn new(crack: &Crack, index: u32, starts: &[f64], s: f64) -> Self {
        let last = crack.points.len() - 2;
        let segment = starts.partition_point(|&start| start <= s).saturating_sub(1).min(last);
        let edge = crack.edge(segment);
        let (length, inner) = (edge.length(), s - starts[segment]);
        let beyond = starts[segment + 1] - s;
        let tangent = edge.tangent(inner / length);
        let (anchor, way) = if inner <= beyond { (edge.from, inner) } else { (edge.to, -beyond) };
        let offset = match (edge.is_arc(), inner <= beyond) {
            (false, _) => tangent * way,
            (true, true) => edge.way(inner / length),
            (true, false) => edge.reversed().way(beyond / length),
        };
        let segment = SegmentId { crack: index, segment: segment as u32 };
        Self { s, tangent, anchor, offset, segment }
    }

    /// The point.
    #[must_use]
    pub fn point(&self) -> Vec2 {
        self.anchor + self.offset
    }

    /// The point on a side.
    #[must_use]
    pub fn place(&self, side: Side) -> SidedPoint {
        let Self { anchor, offset, segment, .. } = *self;
        SidedPoint { point: self.point(), anchor, offset, on: Some(segment), side }
    }

    /// Opening and sliding: a jump \[u\] = u above − u below, normal to the crack and along it.
    #[must_use]
    pub fn opening(&self, jump: Vec2) -> [f64; 2] {
        [jump.dot(self.tangent.left()), jump.dot(self.tangent)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crack::CrackEnd;
    use crate::domain::{Domain, Hole};

    #[test]
    fn ends_are_exact() {
        let (a, b) = (vec2(0.1, 0.2), vec2(0.7, -0.3));
        for n in [2, 3, 7, 1000] {
            assert_eq!([evenly(n)[0], evenly(n)[n - 1]].map(|at| between([a, b], at)), [a, b]);
        }
        assert_eq!(evenly(1), [0.5]);
        let places = line(&[], [a, b], &evenly(7));
        assert_eq!((places[0].point, places[6].point), (a, b));
        let bounds = Rect::new(vec2(-1.1, 0.1), vec2(0.7, 1.3));
        let corners = grid(&[], bounds, [7, 9]);
        assert_eq!((corners[0].point, corners[62].point), (bounds.min, bounds.max));
    }

    /// Points of a rim by their rounded coordinates, and of the boundary, are of the body; those
    /// that lie inside by more than rounding are not, and those given by tiny offsets mean what
    /// they say.
    #[test]
    fn rims_and_borders_are_of_the_plate() {
        let bounds = Rect::new(vec2(-1.1, -1.3), vec2(1.7, 0.9));
        for k in 0..200 {
            let number = |n: u32| (f64::from(5 * k + n) * 12.9898).sin() * 43758.5453 % 1.0;
            let (center, radius) = (vec2(0.4 * number(0), 0.4 * number(1)), 0.3 + 0.2 * number(2));
            let on = |angle: f64, r: f64| center + vec2(angle.cos(), angle.sin()) * r;
            let points: Vec<Vec2> = (0..5).map(|n| on(1.1 * f64::from(n), radius)).collect();
            let round = Hole::Circle { center, radius };
            let cornered = Hole::polygon(points.clone());
            let is_in = |domain: &Domain, p: SidedPoint| domain.at(p.anchor).contains(p.offset);
            let settled = |domain: &Domain, mut places: Vec<SidedPoint>| {
                settle(domain, &mut places);
                places.into_iter().map(|p| is_in(domain, p)).collect::<Vec<_>>()
            };
            let circled = |r: f64| circle(&[], center, r, 97).into_iter().map(|(_, p)| p);
            let plate = Domain { bounds, holes: vec![round] };
            assert!(settled(&plate, circled(radius).collect()).iter().all(|&v| v));
            assert!(!settled(&plate, circled(radius * (1.0 - 1e-13)).collect()).contains(&true));
            let listed: Vec<_> = (0..97).map(|n| on(0.1 * f64::from(n), radius)).collect();
            assert!(settled(&plate, super::points(&[], &listed)).iter().all(|&v| v));
            let plate = Domain { bounds, holes: vec![cornered] };
            let along = |a: Vec2, b: Vec2| line(&[], [a, b], &evenly(53));
            for n in 0..5 {
                let [a, b] = [points[n], points[(n + 1) % 5]];
                assert!(settled(&plate, along(a, b)).iter().all(|&v| v), "{k} {n}");
                let [a, b] = [a, b].map(|p| center + (p - center) * (1.0 - 1e-12));
                assert!(!settled(&plate, along(a, b)).contains(&true), "{k} {n}");
            }
            let edge = 0.1 * number(3).abs();
            let plate = Domain::from(Rect::new(bounds.min, vec2(center.x + radius, 0.9)));
            assert!(settled(&plate, circled(radius).collect()).iter().all(|&v| v));
            let right = plate.bounds.max.x;
            let (a, b) = (vec2(right, -1.3), vec2(right, 0.9 - edge));
            assert!(settled(&plate, along(a, b)).iter().all(|&v| v));
            let beyond = along(a + vec2(1e-13, 0.0), b + vec2(1e-13, 0.0));
            assert!(!settled(&plate, beyond).contains(&true));
        }
        // a circle 1e-18 wide about a point of the rim is half of it in the hole
        let hole = Hole::Circle { center: vec2(0.5, 0.25), radius: 0.625 };
        let plate = Domain { bounds, holes: vec![hole] };
        let mut tiny: Vec<_> = circle(&[], vec2(0.875, 0.75), 1e-18, 101)
            .into_iter()
            .unzip::<_, _, Vec<_>, Vec<_>>()
            .1;
        settle(&plate, &mut tiny);
        let inside = tiny.iter().filter(|p| plate.at(p.anchor).contains(p.offset)).count();
        assert!((49..=52).contains(&inside), "{inside}");
    }

    /// Places on faces know their side: above the crack θ = π at its last tip, and −π at its first.
    #[test]
    fn circles_around_tips_end_on_the_faces() {
        let points = vec![vec2(-0.5, 0.1), vec2(0.3, 0.4)];
        let cracks = [Crack::polyline(points, [CrackEnd::Tip; 2])];
        for (end, above) in [(End::Last, PI), (End::Start, -PI)] {
            let tip = TipId { crack: 0, end };
            for radius in [0.2, 1e-9] {
                let places = around(&cracks, tip, radius, 9).expect("a tip");
                assert_eq!(places.len(), 9);
                for (angle, place) in places {
                    assert!((place.offset.length() / radius - 1.0).abs() < 1e-14);
                    assert_eq!(place.on.is_some(), angle.abs() == PI);
                    let expected = if angle == above { Side::Above } else { Side::Below };
                    assert!(place.on.is_none() || place.side == expected, "{end:?} {angle}");
                    // a little towards the middle angle the position says the same
                    let inner = Segments::new(&cracks);
                    assert_eq!(
                        inner.at(place.anchor, place.offset * 0.5).is_some(),
                        place.on.is_some()
                    );
                }
            }
            // beyond the crack's other end there are no faces
            let wide = around(&cracks, tip, 2.0, 5).expect("a tip");
            assert!(wide.iter().all(|(_, place)| place.on.is_none()));
        }
        assert!(around(&cracks, TipId { crack: 1, end: End::Last }, 0.1, 5).is_none());
    }

    #[test]
    fn rays_are_evenly_spaced_in_the_logarithm() {
        let points = vec![vec2(0.0, 0.0), vec2(0.0, 1.0)];
        let cracks = [Crack::polyline(points, [CrackEnd::Mouth, CrackEnd::Tip])];
        let tip = TipId { crack: 0, end: End::Last };
        let places = ray(&cracks, tip, 0.0, [1e-12, 1.0], 13).expect("a tip");
        for (k, (r, place)) in places.iter().enumerate() {
            assert!((r / 10f64.powi(k as i32 - 12) - 1.0).abs() < 1e-12);
            assert_eq!((place.anchor, place.offset), (vec2(0.0, 1.0), vec2(0.0, *r)));
        }
        let full = circle(&cracks, vec2(0.0, 0.5), 0.25, 5);
        let angles: Vec<_> = full.iter().map(|(angle, _)| angle / PI).collect();
        assert_eq!(angles, [-1.0, -0.5, -0.5, 0.0, 0.5, 0.5, 1.0]);
    }
}
