//! Boundaries on which an extremum may lie, and extreme values along them.

use ppum::crack::{SegmentId, Side};
use ppum::edge::EdgeFrame;
use ppum::field::{Field, LocalField};
use ppum::line::Line;
use ppum::vec2::{Rect, Vec2};

use super::bent::Bent;
use super::site::ExtremumSite;
use crate::anchored_edge::AnchoredEdge;
use crate::pieces::material_kinks;

/// Fewest and most samples that a curve should have.
const SAMPLES: [usize; 2] = [32, 1 << 14];

/// Fewest samples that a curve has.
pub(super) const LEAST: usize = 4;

/// Distance from a rim or an interface at which values are taken, pixels: to be on one side of it.
pub(super) const BESIDE: f64 = 1e-9;

/// Steps of the golden section: the value is then exact to rounding where it is smooth.
const SECTIONS: usize = 48;

/// A place that may hold an extremum, with the height that it may have.
pub(super) type Promise<P> = (f64, P);

/// A boundary, or a part of it.
pub(super) struct BoundaryCurve {
    shape: CurveShape,
    /// Unit vector to the side from which it is seen, of straight ones; zero if it is exact.
    toward: Vec2,
    pub(super) on: ExtremumSite,
}

enum CurveShape {
    Straight([Vec2; 2]),
    /// The part between two places of an arc, seen from its left for +1, from its right for −1.
    Arc(AnchoredEdge, [f64; 2], f64),
    Bent(Bent),
}

impl BoundaryCurve {
    fn straight(ends: [Vec2; 2], toward: Vec2, on: ExtremumSite) -> Self {
        Self { shape: CurveShape::Straight(ends), toward, on }
    }

    pub(super) fn bent(bent: Bent, on: ExtremumSite) -> Self {
        Self { shape: CurveShape::Bent(bent), toward: Vec2::ZERO, on }
    }

    /// The point at a part of the way, beside the curve by [`BESIDE`] pixels where it has to be.
    pub(super) fn at(&self, t: f64, pixel: f64) -> Vec2 {
        match &self.shape {
            CurveShape::Straight([a, b]) => *a + (*b - *a) * t + self.toward * (BESIDE * pixel),
            CurveShape::Arc(edge, [low, high], side) => {
                let s = low + (high - low) * t;
                edge.frame.at(s) + edge.frame.tangent_at(s).left() * (side * BESIDE * pixel)
            }
            CurveShape::Bent(bent) => bent.at(t, BESIDE * pixel),
        }
    }

    /// The field as it is evaluated along the curve.
    pub(super) fn local<'a>(&self, field: &'a Field<'_>, anchor: Vec2) -> LocalField<'a> {
        self.segment().map_or_else(|| field.at(anchor), |segment| field.on(segment, anchor))
    }

    /// The segment of a crack that it is a face of.
    pub(super) fn segment(&self) -> Option<SegmentId> {
        if let ExtremumSite::Face(segment, _) = self.on { Some(segment) } else { None }
    }

    pub(super) fn side(&self) -> Side {
        if let ExtremumSite::Face(_, side) = self.on { side } else { Side::Above }
    }

    /// Number of samples that it should have: one a pixel.
    pub(super) fn samples(&self, pixel: f64) -> usize {
        let length = match &self.shape {
            CurveShape::Straight([a, b]) => (*b - *a).length(),
            CurveShape::Arc(_, [low, high], _) => (high - low).abs(),
            CurveShape::Bent(bent) => bent.length(),
        };
        ((length / pixel).ceil() as usize).clamp(SAMPLES[0], SAMPLES[1])
    }
}

/// All boundaries in a rectangle of offsets from an anchor.
pub(super) fn boundary_curves(field: &Field<'_>, anchor: Vec2, rect: &Rect) -> Vec<BoundaryCurve> {
    let mut curves = borders(rect);
    for (index, crack) in (0..).zip(&field.step.cracks) {
        for (segment, edge) in (0..).zip(crack.edges()) {
            let id = SegmentId { crack: index, segment };
            for (side, sign) in [(Side::Above, 1.0), (Side::Below, -1.0)] {
                let local = AnchoredEdge::new(edge, anchor);
                curves.extend(beside(local, sign, ExtremumSite::Face(id, side), rect));
            }
        }
    }
    for (index, hole) in field.domain.holes.iter().enumerate() {
        let on = if hole.is_outside() { ExtremumSite::Border } else { ExtremumSite::Rim(index) };
        let body = -hole.orientation();
        let rim = AnchoredEdge::rim(hole, anchor);
        curves.extend(rim.flat_map(|(_, edge)| beside(edge, body, on, rect)));
    }
    add_interfaces(field, anchor, rect, &mut curves);
    curves
}

/// The parts of an edge in a rectangle, seen from its left for the side +1.
fn beside(local: AnchoredEdge, side: f64, on: ExtremumSite, rect: &Rect) -> Vec<BoundaryCurve> {
    if local.frame.curvature != 0.0 {
        let curve = |part| {
            let shape = CurveShape::Arc(local, part, side);
            BoundaryCurve { shape, toward: Vec2::ZERO, on }
        };
        return local.within(rect).into_iter().map(curve).collect();
    }
    let EdgeFrame { foot, tangent, .. } = local.frame;
    let (line, toward) = (Line { from: foot, along: tangent }, tangent.left() * side);
    let ends = line.clipped(rect, local.range);
    ends.map(|ends| BoundaryCurve::straight(ends, toward, on)).into_iter().collect()
}

fn borders(rect: &Rect) -> Vec<BoundaryCurve> {
    let side = |ends| BoundaryCurve::straight(ends, Vec2::ZERO, ExtremumSite::Border);
    rect.sides().map(side).into()
}

/// Both sides of the straight lines on which the material's formulas are not smooth.
fn add_interfaces(field: &Field<'_>, anchor: Vec2, rect: &Rect, curves: &mut Vec<BoundaryCurve>) {
    for form in material_kinks(field).filter_map(|kink| kink.line()) {
        let line = Line::of_equation(form, anchor);
        let (normal, everywhere) = (line.along.left(), [f64::NEG_INFINITY, f64::INFINITY]);
        let ends = line.clipped(rect, everywhere);
        let both = |ends| {
            [normal, -normal]
                .map(|toward| BoundaryCurve::straight(ends, toward, ExtremumSite::Interface))
        };
        curves.extend(ends.into_iter().flat_map(both));
    }
}

impl BoundaryCurve {
    /// Parts of a face that begins or ends at a point, between distances from it that are
    /// multiplied by a factor each time.
    pub(super) fn parts_from(&self, point: Vec2, [first, factor, last]: [f64; 3]) -> Vec<Self> {
        // the end next to the point, and the part between two lengths from it
        let (near, length, part): (_, _, Box<dyn Fn([f64; 2]) -> CurveShape>) =
            match (&self.shape, self.on) {
                (&CurveShape::Straight([a, b]), ExtremumSite::Face(..)) => {
                    let is_first = (a - point).length() < (b - point).length();
                    let (near, far) = if is_first { (a, b) } else { (b, a) };
                    let (length, along) = ((far - near).length(), (far - near).unit());
                    let ends = move |range: [f64; 2]| range.map(|r| near + along * r);
                    (near, length, Box::new(move |range| CurveShape::Straight(ends(range))))
                }
                (&CurveShape::Arc(edge, [low, high], side), ExtremumSite::Face(..)) => {
                    let [a, b] = [low, high].map(|s| (edge.frame.at(s) - point).length());
                    let (near, sign) = if a < b { (low, 1.0) } else { (high, -1.0) };
                    let places = move |range: [f64; 2]| range.map(|r| near + sign * r);
                    let part = move |range| CurveShape::Arc(edge, places(range), side);
                    (edge.frame.at(near), high - low, Box::new(part))
                }
                _ => return Vec::new(),
            };
        if (near - point).length() > 0.1 * first || length == 0.0 {
            return Vec::new();
        }
        let last = last.min(length);
        let starts = std::iter::successors(Some(first), |r| Some(r * factor));
        let part = |r: f64| {
            let shape = part([r, (r * factor).min(last)]);
            Self { shape, toward: self.toward, on: self.on }
        };
        starts.take_while(|r| *r < last).map(part).collect()
    }
}

/// The part of the way at which a sample lies.
pub(super) fn part(sample: usize, samples: usize) -> f64 {
    (sample as f64 / (samples - 1) as f64).min(1.0)
}

/// The samples of curves that are not below their neighbours (not above for the sign −1), by curve
/// and number, and the height that there may be around them if it rises as it does from the lower
/// neighbour; the most promising first, at most so many. Values that are not defined are
/// passed over.
pub(super) fn tops(sampled: &[Vec<f64>], sign: f64, most: usize) -> Vec<Promise<[usize; 2]>> {
    let heights = || sampled.iter().flatten().map(|value| sign * value);
    let highest = heights().fold(f64::NEG_INFINITY, f64::max);
    let (mut found, mut is_first) = (Vec::new(), true);
    for (curve, values) in sampled.iter().enumerate() {
        let height = |k: usize| sign * values[k];
        for k in 0..values.len() {
            let (here, around) = (height(k), around(k, values.len()).map(height));
            if here.is_nan() || around.iter().any(|there| *there > here) {
                continue;
            }
            let mut promise = 2.0 * here - around.into_iter().fold(here, f64::min);
            if here == highest && is_first {
                // what is told is no less than any sample
                (promise, is_first) = (f64::INFINITY, false);
            }
            if promise > highest || here == highest {
                found.push((promise, [curve, k]));
            }
        }
    }
    best_first(found, most)
}

/// The largest promises, the best first and the first of equal ones before the others.
pub(super) fn best_first<P>(mut found: Vec<Promise<P>>, most: usize) -> Vec<Promise<P>> {
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    found.truncate(most);
    found
}

/// The neighbours of a sample, itself at an end.
fn around(sample: usize, samples: usize) -> [usize; 2] {
    [sample.saturating_sub(1), (sample + 1).min(samples - 1)]
}

/// The largest f (smallest for the sign −1) on \[0, 1\] between the neighbours of a sample, by the
/// golden section, and its place.
pub(super) fn golden(
    f: &mut dyn FnMut(f64) -> f64,
    sign: f64,
    values: &[f64],
    sample: usize,
) -> (f64, f64) {
    const RATIO: f64 = 0.618_033_988_749_895;
    let mut best = (sign * values[sample], part(sample, values.len()));
    let mut height = |t: f64| {
        let height = sign * f(t);
        if height > best.0 {
            best = (height, t);
        }
        if height.is_nan() { f64::NEG_INFINITY } else { height }
    };
    let [mut lo, mut hi] = around(sample, values.len()).map(|k| part(k, values.len()));
    let (mut a, mut b) = (hi - RATIO * (hi - lo), lo + RATIO * (hi - lo));
    let (mut at_a, mut at_b) = (height(a), height(b));
    for _ in 0..SECTIONS {
        if at_a > at_b {
            (hi, b, at_b) = (b, a, at_a);
            a = hi - RATIO * (hi - lo);
            at_a = height(a);
        } else {
            (lo, a, at_a) = (a, b, at_b);
            b = lo + RATIO * (hi - lo);
            at_b = height(b);
        }
    }
    (sign * best.0, best.1)
}
