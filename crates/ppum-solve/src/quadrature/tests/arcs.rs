//! Cells cut by arcs, and rules on them, against Green's theorem and closed forms.

use super::*;
use ppum::crack::{End, LocalTip, SegmentId, Side};
use ppum::domain::Hole;
use ppum::edge::Edge;
use std::f64::consts::{PI, TAU};

/// Area and first moments of the inside of a closed chain of edges, by Green's theorem along its
/// exact arcs.
fn moments(edges: &[Edge]) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for edge in edges {
        let parts = (edge.sweep().abs() / 0.2).ceil().max(1.0) as usize;
        for k in 0..parts {
            let range = [k, k + 1].map(|k| k as f64 / parts as f64);
            for (part, w) in gauss(20).on(range[0], range[1]) {
                let (p, t) = (edge.at(part), edge.tangent(part) * (w * edge.length()));
                sums[0] += 0.5 * p.cross(t);
                sums[1] += 0.5 * p.x * p.x * t.y;
                sums[2] += -0.5 * p.y * p.y * t.x;
            }
        }
    }
    sums
}

fn divided(edges: &[Edge], parts: usize) -> Vec<Edge> {
    let part = |k: usize| [k, k + 1].map(|k| k as f64 / parts as f64);
    edges.iter().flat_map(|edge| (0..parts).map(move |k| edge.part(part(k)))).collect()
}

/// The rules of all cells and of the rims.
fn with_hole(
    partition: &BoxPartition,
    holes: &[Hole],
    orders: Orders,
) -> (Vec<CellRule>, Vec<EdgeRule>) {
    let geometry = SmoothnessGeometry { holes, ..SmoothnessGeometry::new(partition, &[]) };
    let quadrature = Quadrature::new(geometry, orders);
    let (mut cells, mut rims) = (Vec::new(), Vec::new());
    for cell in &partition.cell {
        let patches = covering_patches(partition, cell);
        cells.extend(quadrature.cell(covered(cell, &patches)));
        for hole in 0..holes.len() {
            rims.extend(quadrature.rim(covered(cell, &patches), hole, |_| true));
        }
    }
    (cells, rims)
}

fn lengths(rules: &[EdgeRule]) -> f64 {
    rules.iter().flat_map(|rule| &rule.weights).sum()
}

fn edge_points(rules: &[EdgeRule]) -> usize {
    rules.iter().map(|rule| rule.offsets.len()).sum()
}

fn stadium(c: Vec2, a: f64, r: f64) -> Vec<Edge> {
    let p = [vec2(-a, -r), vec2(a, -r), vec2(a, r), vec2(-a, r)].map(|p| c + p);
    let bulges = [0.0, 1.0, 0.0, 1.0];
    (0..4).map(|k| Edge { from: p[k], to: p[(k + 1) % 4], bulge: bulges[k] }).collect()
}

/// An ellipse as pairs of arcs.
fn ellipse(c: Vec2, axes: Vec2, pairs: usize) -> Vec<Edge> {
    let at = |k: usize| {
        let t = TAU * k as f64 / pairs as f64;
        let (sin, cos) = t.sin_cos();
        [c + vec2(axes.x * cos, axes.y * sin), vec2(-axes.x * sin, axes.y * cos).unit()]
    };
    (0..pairs).flat_map(|k| Edge::pair_between(at(k), at((k + 1) % pairs))).collect()
}

/// A random arc with both ends in the box.
fn arc(random: &mut Random) -> Edge {
    loop {
        let sweep: f64 = match random.between(0.0, 3.0) {
            kind if kind < 1.0 => 10f64.powf(random.between(-12.0, -1.0)),
            _ => random.between(-5.2, 5.2),
        };
        let edge =
            Edge { from: point(random, 0.9), to: point(random, 0.9), bulge: (sweep / 4.0).tan() };
        let bounds = edge.bounds();
        if bounds.max_norm() < 0.98 && edge.chord().length() > 0.02 {
            return edge;
        }
    }
}

/// Holes between an arc and its chord, of all sweeps: area and moments of what is left, and the
/// rim.
#[test]
fn segments_of_discs() {
    let mut random = Random(71);
    for trial in 0..40 {
        let weight = WeightFunction::ALL[trial % 3].clone();
        let partition = graded(&mut random, weight);
        let edge = arc(&mut random);
        if edge.sweep().abs() < 1e-3 {
            continue;
        }
        let edges = [edge, Edge::segment([edge.to, edge.from])];
        let (cells, rim) = with_hole(&partition, &[Hole::enclosed(&edges)], Orders::for_degree(4));
        let exact = moments(&edges);
        let sign = exact[0].signum();
        let found = [
            4.0 - integrate(&cells, |_, _| 1.0),
            -integrate(&cells, |a, x| a.x + x.x),
            -integrate(&cells, |a, x| a.y + x.y),
        ];
        for k in 0..3 {
            assert_near(
                found[k],
                sign * exact[k],
                1e-13,
                &format!("{trial}: moment {k} of {edge:?}"),
            );
        }
        let length = edge.length() + edge.chord().length();
        assert_near(lengths(&rim), length, 1e-12, &format!("{trial}: rim of {edge:?}"));
        let around: f64 =
            rim.iter().flat_map(EdgeRule::points).map(|(p, n, w)| p.x * n.x * w).sum();
        assert_near(-around, exact[0].abs(), 1e-12, "area by the rim");
    }
}

/// The same hole as a round one, as four arcs, and as forty.
#[test]
fn circles_of_arcs() {
    let mut random = Random(72);
    for trial in 0..8 {
        let partition = graded(&mut random, WeightFunction::Linear);
        let (c, r) = (point(&mut random, 0.3), random.between(0.1, 0.6));
        let quarters: Vec<Edge> = (0..4)
            .map(|k| Edge::around(c, r, [k, k + 1].map(|k| 0.3 + 0.25 * TAU * f64::from(k))))
            .collect();
        let holes = [
            Hole::Circle { center: c, radius: r },
            Hole::enclosed(&quarters),
            Hole::enclosed(&divided(&quarters, 10)),
        ];
        let mut counts = Vec::new();
        for hole in &holes {
            let (cells, rim) =
                with_hole(&partition, std::slice::from_ref(hole), Orders::for_degree(4));
            let area = integrate(&cells, |_, _| 1.0);
            assert_near(area, 4.0 - PI * r * r, 1e-11, &format!("{trial}: area, r = {r}"));
            let moment = integrate(&cells, |a, x| (a + x).x);
            assert_near(moment, -PI * r * r * c.x, 1e-11, &format!("{trial}: moment, r = {r}"));
            assert_near(lengths(&rim), TAU * r, 1e-12, &format!("{trial}: rim"));
            counts.push((n_points(&cells), edge_points(&rim)));
        }
        assert!(counts[1].0.max(counts[2].0) <= counts[0].0 * 11 / 10, "{counts:?}");
    }
}

/// Slots and ellipses, inside of one cell and across many.
#[test]
fn stadiums_and_ellipses() {
    let mut random = Random(73);
    for trial in 0..8 {
        let partition =
            if trial < 2 { uniform(trial) } else { graded(&mut random, WeightFunction::Linear) };
        let c = point(&mut random, 0.2);
        let slot = stadium(c, random.between(0.05, 0.4), random.between(0.05, 0.3));
        let oval = ellipse(c, vec2(random.between(0.2, 0.6), random.between(0.2, 0.6)), 600);
        let mut counts = Vec::new();
        for (edges, tolerance) in [(&slot, 1e-10), (&divided(&slot, 10), 1e-10), (&oval, 1e-8)] {
            let (cells, rim) =
                with_hole(&partition, &[Hole::enclosed(edges)], Orders::for_degree(4));
            let exact = moments(edges);
            let moment = |f: &dyn Fn(Vec2) -> f64| integrate(&cells, |a, x| f(a + x));
            assert_near(moment(&|_| 1.0), 4.0 - exact[0], tolerance, &format!("{trial}: area"));
            assert_near(moment(&|p| p.x), -exact[1], tolerance, &format!("{trial}: x"));
            assert_near(moment(&|p| p.y), -exact[2], tolerance, &format!("{trial}: y"));
            let length: f64 = edges.iter().map(Edge::length).sum();
            assert_near(lengths(&rim), length, 1e-11, &format!("{trial}: rim"));
            counts.push((n_points(&cells), edge_points(&rim)));
        }
        let round = Hole::Circle { center: c, radius: 0.35 };
        let (cells, rim) = with_hole(&partition, &[round], Orders::for_degree(4));
        counts.push((n_points(&cells), edge_points(&rim)));
        // [slot, its tenths, ellipse, circle]
        let most = counts[3].0.max(4000) * 3 / 2;
        assert!(counts[2].0 <= most, "points of an ellipse beside a circle: {counts:?}");
    }
}

/// √r sin(θ/2) and its square's slope, with θ that jumps on the crack: the integral and those of
/// 1/r and of x times it, by anchors.
fn singular_integrals(rules: &[CellRule], crack: &Crack, end: End) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for rule in rules {
        let tip = LocalTip::new(crack, end, rule.anchor);
        for (x, w) in rule.offsets.iter().zip(&rule.weights) {
            let point = tip.point([x.x, x.y], Side::Above);
            let r = point.radius();
            let [c, s] = point.half_root(r);
            sums[0] += w * s;
            sums[1] += w * s * (x.x + rule.anchor.x) / r;
            sums[2] += w * c * s / (r * r) * (1.0 + x.y + rule.anchor.y);
        }
    }
    sums
}

/// Cracks of arcs from outside to a tip inside: functions that are singular there and jump on the
/// crack, whose θ follows the arc, beside many more points.
#[test]
fn singular_functions_that_jump_on_arcs() {
    let mut random = Random(81);
    for trial in 0..12 {
        let sweep = [1e-9, 0.4, -1.2, 2.0, -2.6, 2.8][trial % 6];
        let from = vec2(-1.2, random.between(-0.3, 0.3));
        let edge = Edge { from, to: point(&mut random, 0.4), bulge: (0.25_f64 * sweep).tan() };
        let edges = if trial % 4 == 3 { divided(&[edge], 10) } else { vec![edge] };
        let crack = Crack::along(&edges);
        let partition = graded(&mut random, WeightFunction::Linear);
        let case = GeometryCase::new(partition, vec![crack.clone()], vec![edge.to]);
        let of = |orders| {
            let rules = case.rules(orders);
            assert_near(integrate(&rules, |_, _| 1.0), 4.0, 1e-11, "area");
            singular_integrals(&rules, &crack, End::Last)
        };
        let exact = of(Orders::uniform(24));
        for (p, tolerance) in [(2, 1e-6), (4, 1e-8), (6, 1e-10)] {
            let found = of(Orders::for_degree(p));
            let off = (0..3).map(|k| (found[k] - exact[k]).abs()).fold(0.0, f64::max);
            assert!(off < tolerance, "{trial}: order {p} is off by {off:e}");
        }
    }
}

/// Faces of arcs: lengths, moments, and r^(−1/2) toward the tip along the arc.
#[test]
fn faces_of_arcs() {
    let mut random = Random(82);
    for trial in 0..20 {
        let edge = arc(&mut random);
        let edges = divided(&[edge], 1 + 2 * (trial % 2));
        let cracks = vec![Crack::along(&edges)];
        let partition = graded(&mut random, WeightFunction::ALL[trial % 3].clone());
        let case = GeometryCase::new(partition, cracks, vec![edge.from, edge.to]);
        let quadrature = case.quadrature(Orders::for_degree(4));
        for side in [Side::Above, Side::Below] {
            let mut rules = Vec::new();
            for segment in 0..edges.len() as u32 {
                let face = CrackFace { segment: SegmentId { crack: 0, segment }, side };
                for cell in &case.partition.cell {
                    let patches = covering_patches(&case.partition, cell);
                    rules.extend(quadrature.face(covered(cell, &patches), face));
                }
            }
            assert_near(lengths(&rules), edge.length(), 1e-12, &format!("{trial}: {edge:?}"));
            // the arc length from the tip, by the chord
            let kappa = edge.curvature();
            let (mut root, mut flux) = (0.0, Vec2::ZERO);
            for rule in &rules {
                for ((x, w), n) in rule.offsets.iter().zip(&rule.weights).zip(&rule.normals) {
                    let chord = (*x + (rule.anchor - edge.to)).length();
                    let half = (0.5 * kappa * chord).clamp(-1.0, 1.0).asin();
                    let near = if kappa == 0.0 { chord } else { 2.0 * half / kappa };
                    if edge.sweep().abs() < 3.0 {
                        root += w / near.sqrt();
                    }
                    flux = flux + *n * *w;
                }
            }
            if edge.sweep().abs() < 3.0 {
                let exact = 2.0 * edge.length().sqrt();
                assert_near(root, exact, 1e-10 * exact, &format!("{trial}: root {edge:?}"));
            }
            let sign = if side == Side::Above { -1.0 } else { 1.0 };
            let off = (flux - edge.chord().left() * sign).length();
            assert!(off < 1e-12, "{trial}: normals {off:e} {edge:?}");
        }
    }
}

/// Ellipses of all shapes in few large cells, whose chains are finer and coarser than runs may be.
#[test]
fn ellipses_in_large_cells() {
    let mut random = Random(74);
    for trial in 0..8 {
        let axes = vec2(random.between(0.1, 0.6), random.between(0.1, 0.6));
        let edges = ellipse(point(&mut random, 0.2), axes, 300);
        for level in [0, 1, 2] {
            let partition = uniform(level);
            let (cells, _) =
                with_hole(&partition, &[Hole::enclosed(&edges)], Orders::for_degree(4));
            let area = integrate(&cells, |_, _| 1.0);
            let what = format!("{trial}: axes {axes:?}, level {level}");
            assert_near(area, 4.0 - moments(&edges)[0], 5e-9, &what);
        }
    }
}

/// Circles of arcs that touch lines of cells, pass through their corners, or nearly so.
#[test]
fn arcs_that_touch_lines_of_cells() {
    let partition = uniform(2);
    for shift in [0.0, 1e-13, -1e-13, 1e-9, -1e-9, 1e-5] {
        for (r, turn) in [(0.5, 0.0), (0.5, 0.4), (0.5 * 2.0_f64.sqrt(), 0.1), (0.25, 0.7)] {
            let c = vec2(shift, -0.5 * shift);
            let angles = |k: u32| [k, k + 1].map(|k| turn + 0.25 * TAU * f64::from(k));
            let quarters: Vec<Edge> = (0..4).map(|k| Edge::around(c, r, angles(k))).collect();
            let (cells, rim) =
                with_hole(&partition, &[Hole::enclosed(&quarters)], Orders::for_degree(4));
            let what = format!("r = {r}, shift {shift:e}, turn {turn}");
            let area = integrate(&cells, |_, _| 1.0);
            assert_near(area, 4.0 - PI * r * r, 1e-10, &format!("area, {what}"));
            assert_near(lengths(&rim), TAU * r, 1e-11, &format!("rim, {what}"));
        }
    }
}

/// Two holes of arcs over each other: a lens is counted once.
#[test]
fn arcs_that_cross() {
    let partition = uniform(2);
    let (r, d) = (0.4_f64, 0.3);
    let circle = |x: f64| {
        let angles = |k: u32| [k, k + 1].map(|k| 0.2 + TAU / 3.0 * f64::from(k));
        let thirds: Vec<Edge> = (0..3).map(|k| Edge::around(vec2(x, 0.1), r, angles(k))).collect();
        Hole::enclosed(&thirds)
    };
    let (cells, rim) =
        with_hole(&partition, &[circle(-0.13), circle(-0.13 + d)], Orders::for_degree(4));
    let half_angle = (0.5 * d / r).acos();
    let lens = 2.0 * r * r * half_angle - d * (r * r - 0.25 * d * d).sqrt();
    let area = integrate(&cells, |_, _| 1.0);
    assert_near(area, 4.0 - 2.0 * PI * r * r + lens, 1e-12, "area");
    assert_near(lengths(&rim), 4.0 * r * (PI - half_angle), 1e-12, "rims");
}

/// Boxes in discs around tips of arcs, wherever the arc passes, also next to a corner: their areas
/// are right, and take few points.
#[test]
fn discs_around_tips_of_arcs() {
    let mut random = Random(83);
    for trial in 0..600 {
        let bulge = random.between(-0.8, 0.8);
        let edge = Edge { from: vec2(-0.4, 0.1), to: vec2(0.5, 0.2), bulge };
        let (width, height) = (10f64.powf(random.between(-2.5, -1.5)), random.between(0.1, 3.0));
        let (near, size) = (edge.at(random.between(0.6, 0.95)), vec2(width, width * height));
        let min = near - vec2(size.x * random.between(0.0, 1.0), size.y * random.between(0.0, 1.0));
        let corner = min + vec2(size.x, 0.0);
        let beside = 10f64.powf(random.between(-9.0, -3.0));
        let shift = edge.closest_point(corner) - corner + edge.tangent(0.8).left() * beside;
        let min = if trial % 3 == 0 { min + shift } else { min };
        let cell = Rect::new(min, min + size);
        let case = alone(cell, vec![Crack::along(&[edge])], vec![edge.from, edge.to]);
        let quadrature = case.quadrature(Orders::for_degree(2));
        let disc = Disc { center: edge.to, radius: 1.0, scale: 0.05, order: 12, least: 6 };
        let rules = quadrature.disc(covered(&cell, &[0]), disc);
        let off = integrate(&rules, |_, _| 1.0) / (size.x * size.y) - 1.0;
        assert!(off.abs() < 1e-11, "{trial}: off by {off:e}, {cell:?} {edge:?}");
        assert!(rules.iter().all(|rule| rule.doubt.functions == 0.0), "{trial}: {cell:?} {edge:?}");
        assert!(n_points(&rules) < 5000, "{trial}: {} points", n_points(&rules));
    }
}
