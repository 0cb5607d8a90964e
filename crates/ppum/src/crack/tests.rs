//! Cracks with arcs, beside polylines of many points and the closed forms of circles.

use super::*;
use crate::edge::Edge;
use crate::vec2::{Vec2, vec2};
use ppum_testkit::random::Random;
use std::f64::consts::{PI, TAU};

fn point(random: &mut Random) -> Vec2 {
    vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0))
}

fn chain(edges: &[Edge]) -> Crack {
    let mut points = vec![edges[0].from];
    points.extend(edges.iter().map(|edge| edge.to));
    Crack {
        points,
        bulges: edges.iter().map(|edge| edge.bulge).collect(),
        ends: [CrackEnd::Tip; 2],
    }
}

/// Cracks of two to four edges, segments and arcs, with kinks and without, that turn by no more
/// than a half turn in all, so that they do not meet themselves or their extensions.
fn random_crack(random: &mut Random) -> Crack {
    let (mut at, mut direction) = (point(random), random.between(-PI, PI));
    let mut edges = Vec::new();
    for _ in 0..2 + random.below(3) {
        let sweep = random.pick(&[0.0, 1.0, 1.0]) * random.between(-0.7, 0.7);
        direction += random.pick(&[0.0, 1.0]) * random.between(-0.1, 0.1);
        let half = direction + 0.5 * sweep;
        let to = at + vec2(half.cos(), half.sin()) * random.between(0.2, 0.5);
        edges.push(Edge { from: at, to, bulge: (0.25 * sweep).tan() });
        (at, direction) = (to, direction + sweep);
    }
    chain(&edges)
}

/// A polyline within 10⁻⁹ of a crack, with its tangents at the ends.
fn polyline(crack: &Crack) -> Crack {
    let mut points = vec![crack.points[0]];
    let last = crack.points.len() - 2;
    for (k, edge) in crack.edges().enumerate() {
        let arc = edge.flattened(1e-9);
        if k == 0 {
            points.push(edge.from + edge.end_tangents()[0] * 1e-9);
        }
        points.extend(&arc[1..arc.len() - usize::from(k == last)]);
    }
    let end = crack.end_point(End::Last);
    points.extend([end - crack.growth_direction(End::Last) * 1e-9, end]);
    Crack::polyline(points, crack.ends)
}

fn distance(crack: &Crack, p: Vec2) -> f64 {
    crack.edges().map(|edge| edge.distance(p)).fold(f64::INFINITY, f64::min)
}

fn side(crack: &Crack, p: Vec2) -> f64 {
    LocalCrack::new(crack, p).side([0.0; 2], Side::Above)
}

#[test]
fn sides_are_those_of_polylines() {
    let mut random = Random(71);
    for _ in 0..30 {
        let crack = random_crack(&mut random);
        let fine = polyline(&crack);
        for _ in 0..40 {
            let p = point(&mut random) * 1.5;
            if distance(&crack, p) > 1e-6 {
                assert_eq!(side(&crack, p), side(&fine, p), "{crack:?} {p:?}");
            }
        }
    }
}

/// Points beside an arc by 10⁻¹³, in the middle, at a joint with a segment of the same tangent and
/// at a tip, seen from an anchor there.
#[test]
fn deep_places_have_no_noise() {
    let mut random = Random(72);
    for _ in 0..200 {
        let (sweep, from) = (random.between(-2.0, 2.0), point(&mut random));
        let arc = Edge { from, to: point(&mut random), bulge: (0.25 * sweep).tan() };
        let ahead = arc.to + arc.end_tangents()[1] * 0.3;
        let crack = chain(&[arc, Edge::segment([arc.to, ahead])]);
        for (anchor, tangent) in [
            (arc.at(0.4), arc.tangent(0.4)),
            (arc.to, arc.end_tangents()[1]),
            (arc.from, arc.end_tangents()[0]),
        ] {
            let local = LocalCrack::new(&crack, anchor);
            // where rounding has put the anchor
            let off = arc.side(anchor);
            for beside in [1e-10_f64, -1e-10, 1e-13, -1e-13] {
                let along = tangent * (beside.abs() * random.between(-1.0, 1.0));
                let p = along + tangent.left() * (beside - off);
                assert_eq!(local.side([p.x, p.y], Side::Above), beside.signum(), "{crack:?} {p:?}");
            }
        }
        for end in [End::Start, End::Last] {
            let tip = crack.end_point(end);
            let seen = LocalTip::new(&crack, end, tip);
            let angle = random.between(-3.1, 3.1);
            let axis = crack.growth_direction(end);
            let p = (axis * angle.cos() + axis.left() * angle.sin()) * 1e-12;
            let (r, theta) = seen.point([p.x, p.y], Side::Above).polar();
            assert!((r / 1e-12 - 1.0).abs() < 1e-14 && (theta - angle).abs() < 1e-14);
        }
    }
}

/// θ is continuous around a tip, also within the arc, but for one jump of 2π on the crack.
#[test]
fn the_angle_jumps_on_the_arc_only() {
    let mut random = Random(73);
    for _ in 0..40 {
        let sweep = random.between(-2.5, 2.5);
        let arc = Edge { from: vec2(-1.0, 0.2), to: Vec2::ZERO, bulge: (0.25 * sweep).tan() };
        let crack = chain(&[arc]);
        for end in [End::Start, End::Last] {
            let tip = LocalTip::new(&crack, end, crack.end_point(end));
            for radius in [1e-3, 0.3, 0.9] {
                let at = |k: i32| {
                    let angle = f64::from(k) / 2000.0 * TAU;
                    let p = [radius * angle.cos(), radius * angle.sin()];
                    (p, tip.point(p, Side::Above).polar().1)
                };
                let jumps: Vec<_> =
                    (0..2000).filter(|&k| (at(k + 1).1 - at(k).1).abs() > 1.0).map(at).collect();
                assert_eq!(jumps.len(), 1, "{sweep} {radius}");
                let p = crack.end_point(end) + Vec2::from(jumps[0].0);
                assert!(distance(&crack, p) < radius * 0.01, "{sweep} {radius} {p:?}");
                let size = at(0).1.abs().max(at(1000).1.abs());
                assert!(size < 1.5 * PI, "within a quarter of a turn of ±π: {size}");
            }
        }
    }
}

/// A crack reversed, rotated, moved and scaled, and its arcs in ten pieces, has the same sides and
/// the same frames at its tips.
#[test]
fn it_does_not_matter_how_an_arc_is_given() {
    let mut random = Random(74);
    for _ in 0..100 {
        let crack = random_crack(&mut random);
        let part =
            |edge: Edge| (0..10).map(move |k| edge.part([k, k + 1].map(|k| f64::from(k) / 10.0)));
        let divided = chain(&crack.edges().flat_map(part).collect::<Vec<_>>());
        let mut edges: Vec<_> = crack.edges().map(|edge| edge.reversed()).collect();
        edges.reverse();
        let reversed = chain(&edges);
        let (turn, shift) = (random.between(0.0, TAU), point(&mut random));
        let moved = |p: Vec2| (p * turn.cos() + p.left() * turn.sin()) * 3.0 + shift;
        let other =
            Crack { points: crack.points.iter().map(|&p| moved(p)).collect(), ..crack.clone() };
        for _ in 0..20 {
            let p = point(&mut random) * 1.5;
            if distance(&crack, p) < 1e-9 {
                continue;
            }
            let own = side(&crack, p);
            assert_eq!([side(&divided, p), -side(&reversed, p), side(&other, moved(p))], [own; 3]);
            let polar = |crack: &Crack, end, p| {
                LocalTip::new(crack, end, p).point([0.0; 2], Side::Above).polar()
            };
            let (r, theta) = polar(&crack, End::Last, p);
            for (crack, end, p, scale) in [
                (&divided, End::Last, p, 1.0),
                (&reversed, End::Start, p, 1.0),
                (&other, End::Last, moved(p), 3.0),
            ] {
                let (same_r, same) = polar(crack, end, p);
                assert!((same_r / scale - r).abs() < 1e-13 && (same - theta).abs() < 1e-12 / r);
            }
        }
    }
}

/// On an arc θ is that of the side: it differs by 2π, and both are limits from beside.
#[test]
fn points_on_an_arc_are_on_the_side_asked_for() {
    let mut random = Random(75);
    for _ in 0..100 {
        let sweep = random.between(-3.0, 3.0);
        let arc =
            Edge { from: point(&mut random), to: point(&mut random), bulge: (0.25 * sweep).tan() };
        let crack = chain(&[arc]);
        let (part, end) = (random.between(0.1, 0.9), random.pick(&[End::Start, End::Last]));
        let (anchor, out) = (arc.at(part), arc.tangent(part).left());
        let on = LocalTip::on(&crack, 0, end, anchor);
        let [above, below] =
            [Side::Above, Side::Below].map(|side| on.point([0.0; 2], side).polar().1);
        assert!(((above - below).abs() - TAU).abs() < 1e-12, "{above} {below}");
        for (angle, beside) in [(above, 1e-9), (below, -1e-9)] {
            let p = out * beside;
            let near = LocalTip::new(&crack, end, anchor).point([p.x, p.y], Side::Above).polar().1;
            assert!((near - angle).abs() < 1e-7, "{near} {angle}");
        }
        for (side, sign) in [(Side::Above, 1.0), (Side::Below, -1.0)] {
            assert_eq!(LocalCrack::on(&crack, 0, anchor).side([0.0; 2], side), sign);
        }
    }
}

/// Ahead of a tip θ is 0, also where the rounding of the crack's tangent decides the side.
#[test]
fn the_angle_ahead_of_a_tip_is_zero() {
    let mut random = Random(31);
    for _ in 0..200 {
        let crack = random_crack(&mut random);
        for end in [End::Start, End::Last] {
            let (tip, ahead) = (crack.end_point(end), crack.growth_direction(end));
            for _ in 0..20 {
                let at = tip + ahead * random.between(0.01, 1.0);
                let anywhere = point(&mut random);
                let anchor = random.pick(&[tip, at, anywhere]);
                let offset = at - anchor;
                let (_, theta) = LocalTip::new(&crack, end, anchor)
                    .point([offset.x, offset.y], Side::Above)
                    .polar();
                assert!(theta.abs() < 1e-12, "{crack:?} {end:?} {at:?}: {theta}");
            }
        }
    }
}
