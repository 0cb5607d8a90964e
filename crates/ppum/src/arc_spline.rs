//! Curves as chains of arcs.
//!
//! A pair of arcs between two points of a curve, with its tangents there, is off by about κ′ h³/324
//! with the change κ′ of the curvature along the length h. So steps are chosen as those of methods
//! for differential equations are: by the third root of the tolerance over what is found.

use crate::edge::Edge;
use crate::vec2::Vec2;

/// Places between two joints at which the distance from the curve is looked at.
const LOOKS: u32 = 7;

/// Steps are shorter than the rule says, so that few have to be tried again.
const CAUTION: f64 = 0.9;

/// Least step, in parts of the range: a curve that needs shorter ones has a cusp.
const LEAST: f64 = 1e-9;

/// A curve that cannot be divided into arcs: it has a cusp or a corner, or takes too many.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TooSharp {
    /// The parameter that was reached.
    pub parameter: f64,
}

/// The arcs of a curve, with common tangents where they meet, that are nowhere farther from it than
/// the tolerance. `curve` gives the point and the unit tangent at a parameter; a range that runs
/// backwards is allowed if the tangents do, too.
///
/// # Errors
/// The curve takes more than `most` arcs, or steps that rounding does not see.
pub fn arc_spline(
    curve: impl Fn(f64) -> [Vec2; 2],
    [from, to]: [f64; 2],
    tolerance: f64,
    most: usize,
) -> Result<Vec<Edge>, TooSharp> {
    let (mut edges, mut at, mut step) = (Vec::new(), 0.0, 1.0 / 16.0);
    let parameter = |part: f64| if part == 1.0 { to } else { from + (to - from) * part };
    while at < 1.0 {
        let next = if at + 1.01 * step >= 1.0 { 1.0 } else { at + step };
        let pair = Edge::pair_between(curve(parameter(at)), curve(parameter(next)));
        let off = distance(&pair, |part| curve(parameter(at + (next - at) * part))[0]);
        // an arc hardly larger than the tolerance that turns is a cusp
        let is_cusp = |edge: &Edge| edge.bulge.abs() > 0.05 && edge.length() < 64.0 * tolerance;
        if off <= tolerance && pair.iter().any(is_cusp) {
            return Err(TooSharp { parameter: parameter(at) });
        } else if off <= tolerance {
            edges.extend(pair);
            at = next;
        } else if step < LEAST {
            return Err(TooSharp { parameter: parameter(at) });
        }
        if edges.len() > most {
            return Err(TooSharp { parameter: parameter(at) });
        }
        // of no number the smallest step
        let growth = CAUTION * (tolerance / off).cbrt();
        step *= growth.clamp(0.2, 2.0).max(if off.is_nan() { 0.2 } else { 0.0 });
    }
    Ok(edges)
}

/// The largest distance of places of a curve from a pair of arcs; NaN if they are not finite.
fn distance(pair: &[Edge; 2], curve: impl Fn(f64) -> Vec2) -> f64 {
    let places = (1..=LOOKS).map(|k| curve(f64::from(k) / f64::from(LOOKS + 1)));
    let off = places.map(|p| pair[0].distance(p).min(pair[1].distance(p)));
    let is_finite = pair.iter().all(|edge| edge.bulge.is_finite() && edge.to.is_finite());
    off.fold(if is_finite { 0.0 } else { f64::NAN }, |all: f64, off| {
        if off.is_nan() || all.is_nan() { f64::NAN } else { all.max(off) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::Spline;
    use crate::vec2::vec2;
    use ppum_testkit::random::Random;
    use std::f64::consts::{PI, TAU};

    fn ellipse(axes: Vec2) -> impl Fn(f64) -> [Vec2; 2] {
        move |t: f64| {
            let (sin, cos) = t.sin_cos();
            [vec2(axes.x * cos, axes.y * sin), vec2(-axes.x * sin, axes.y * cos).unit()]
        }
    }

    /// Arcs join in points and tangents, and lie within the tolerance of a curve at places that
    /// were not looked at; their number grows like its third root.
    #[test]
    fn ellipses_within_a_tolerance() {
        let mut random = Random(81);
        for _ in 0..20 {
            let axes = vec2(random.between(0.1, 1.0), random.between(0.1, 1.0));
            let curve = ellipse(axes);
            let counts = [1e-6, 1e-9].map(|tolerance| {
                let arcs = arc_spline(&curve, [0.0, TAU], tolerance, 100_000).unwrap();
                for pair in arcs.windows(2) {
                    assert_eq!(pair[0].to, pair[1].from);
                    let [end, start] = [pair[0].end_tangents()[1], pair[1].end_tangents()[0]];
                    assert!((end - start).length() < 1e-9, "{end:?} {start:?}");
                }
                let on_arcs = arcs.iter().flat_map(|arc| [0.2, 0.5, 0.8].map(|part| arc.at(part)));
                for p in on_arcs {
                    // of first order in the distance
                    let slope = vec2(p.x / (axes.x * axes.x), p.y / (axes.y * axes.y)).length();
                    let (x, y) = (p.x / axes.x, p.y / axes.y);
                    assert!((x * x + y * y - 1.0).abs() / (2.0 * slope) < 1.2 * tolerance);
                }
                let sweep: f64 = arcs.iter().map(Edge::sweep).sum();
                assert!((sweep - TAU).abs() < 1e-9);
                arcs.len() as f64
            });
            assert!((5.0..15.0).contains(&(counts[1] / counts[0])), "{counts:?}");
        }
    }

    /// A circle is two arcs a step, whatever the tolerance, and the same backwards.
    #[test]
    fn circles_are_circles() {
        let arcs = arc_spline(ellipse(vec2(0.7, 0.7)), [0.0, 1.5 * PI], 1e-13, 100).unwrap();
        assert!(arcs.len() < 30, "{}", arcs.len());
        for arc in &arcs {
            assert!((arc.curvature() * 0.7 - 1.0).abs() < 1e-12);
        }
        let back = |t: f64| {
            let [p, tangent] = ellipse(vec2(0.7, 0.7))(t);
            [p, -tangent]
        };
        let back = arc_spline(back, [1.5 * PI, 0.0], 1e-13, 100).unwrap();
        let length = |arcs: &[Edge]| arcs.iter().map(Edge::length).sum::<f64>();
        assert!((length(&arcs) - length(&back)).abs() < 1e-12);
        assert!(back.iter().all(|arc| arc.bulge < 0.0));
    }

    #[test]
    fn splines_and_inflections() {
        let points = [[0.0, 0.0], [1.0, 0.6], [2.0, -0.3], [3.0, 0.4], [4.0, 0.2]].map(Vec2::from);
        let spline = Spline::open(&points);
        let curve = |t: f64| {
            let [p, slope, _] = spline.at(t);
            [p, slope.unit()]
        };
        let arcs = arc_spline(curve, [0.0, spline.spans() as f64], 1e-9, 10_000).unwrap();
        assert!(arcs.len() < 3000, "{}", arcs.len());
        for point in points {
            let off = arcs.iter().map(|arc| arc.distance(point)).fold(f64::INFINITY, f64::min);
            assert!(off < 1e-9, "{off}");
        }
        let straight =
            arc_spline(|t| [vec2(t, 0.5 * t), vec2(2.0, 1.0).unit()], [0.0, 1.0], 1e-12, 99);
        let straight = straight.unwrap();
        assert!(straight.iter().all(|edge| edge.bulge.abs() < 1e-15) && straight.len() < 20);
    }

    #[test]
    fn cusps_are_refused() {
        let flat = ellipse(vec2(1.0, 1e-8));
        let TooSharp { parameter } = arc_spline(flat, [-1.0, 1.0], 1e-9, 20_000).unwrap_err();
        assert!(parameter.abs() < 1e-3, "{parameter}");
        let corner = |t: f64| [vec2(t, t.abs()), vec2(1.0, t.signum()).unit()];
        assert!(arc_spline(corner, [-1.0, 1.1], 1e-9, 20_000).is_err());
    }
}
