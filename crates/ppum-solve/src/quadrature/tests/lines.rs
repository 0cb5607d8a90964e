//! Straight kinks.

use super::*;

/// The part of a convex polygon on the left of a line (Sutherland and Hodgman's step).
fn left_of([a, b]: [Vec2; 2], polygon: &[Vec2]) -> Vec<Vec2> {
    let side = |p: Vec2| (b - a).cross(p - a);
    let mut part = Vec::new();
    for (k, &p) in polygon.iter().enumerate() {
        let q = polygon[(k + 1) % polygon.len()];
        if side(p) >= 0.0 {
            part.push(p);
        }
        if side(p) * side(q) < 0.0 {
            part.push(p + (q - p) * (side(p) / (side(p) - side(q))));
        }
    }
    part
}

/// ∫ (c + g·x)² over a convex polygon, by the midpoint rule on the edges of its triangles.
fn square_integral(polygon: &[Vec2], c: f64, g: Vec2) -> f64 {
    let value = |p: Vec2| (c + g.dot(p)).powi(2);
    let triangle = |k: usize| {
        let (o, p, q) = (polygon[0], polygon[k - 1], polygon[k]);
        let area = 0.5 * (p - o).cross(q - o);
        area * (value((o + p) * 0.5) + value((p + q) * 0.5) + value((q + o) * 0.5)) / 3.0
    };
    (2..polygon.len()).map(triangle).sum()
}

/// ∫ d |d| over the domain, d the distance on the left of a line.
fn signed_square(line: [Vec2; 2]) -> f64 {
    let normal = (line[1] - line[0]).unit().left();
    let one_side = |line: [Vec2; 2]| {
        square_integral(&left_of(line, &DOMAIN.corners()), -normal.dot(line[0]), normal)
    };
    one_side(line) - one_side([line[1], line[0]])
}

#[test]
fn lines_cut_exactly_on_graded_covers() {
    let mut random = Random(31);
    for trial in 0..30 {
        let weight = WeightFunction::ALL[trial % 3].clone();
        let case = GeometryCase::new(graded(&mut random, weight), Vec::new(), Vec::new());
        let line = match trial % 3 {
            0 => [point(&mut random, 1.0), point(&mut random, 1.0)],
            1 => [vec2(-1.0, 0.325), vec2(1.0, 0.325)],
            _ => [vec2(-1.0, -1.0), vec2(1.0, 1.0)],
        };
        let normal = (line[1] - line[0]).unit().left();
        let integral = |rules: &[CellRule]| {
            integrate(rules, |a, x| {
                let d = normal.dot(a + x - line[0]);
                d * d.abs()
            })
        };
        let exact = signed_square(line);
        let ends = [normal.left() * 9.0, normal.left() * -9.0].map(|far| line[0] + far);
        for kink in [KinkLine::Line(line), KinkLine::Segment(ends)] {
            let kinks = [kink];
            let geometry =
                SmoothnessGeometry { kinks: &kinks, common_kinks: &[0], ..case.geometry() };
            let rules = rules(geometry, Orders::for_degree(1));
            assert_near(integral(&rules), exact, 1e-13, &format!("trial {trial}, {kinks:?}"));
            assert_near(integrate(&rules, |_, _| 1.0), 4.0, 1e-13, "area");
        }
        if trial % 3 == 0 {
            let error = integral(&case.rules(Orders::for_degree(1))) - exact;
            assert!(error.abs() > 1e-9, "the kink matters: {error:e}");
        }
    }
}

#[test]
fn segments_cut_only_where_they_are() {
    let case = GeometryCase::new(uniform(2), Vec::new(), Vec::new());
    let kinks = [KinkLine::Segment([vec2(-0.8, -0.8), vec2(-0.6, -0.7)])];
    let geometry = SmoothnessGeometry { kinks: &kinks, common_kinks: &[0], ..case.geometry() };
    let orders = Orders::for_degree(1);
    let with = Quadrature::new(geometry, orders);
    let without = case.quadrature(orders);
    for cell in &case.partition.cell {
        let covering_patches = covering_patches(&case.partition, cell);
        let same = with.cell(covered(cell, &covering_patches))
            == without.cell(covered(cell, &covering_patches));
        assert_eq!(same, cell.max.x > -0.5 || cell.max.y > -0.5);
    }
}

#[test]
fn kinks_of_a_patch_cut_where_it_is_active() {
    let case = GeometryCase::new(uniform(2), Vec::new(), Vec::new());
    let kinks = [KinkLine::Line([vec2(-2.0, 0.1), vec2(2.0, 0.2)])];
    let mut patch_kinks = vec![Vec::new(); case.partition.len()];
    let patch = case.partition.cell.iter().position(|c| c.contains(vec2(0.2, 0.2))).expect("cell");
    patch_kinks[patch] = vec![0];
    let geometry =
        SmoothnessGeometry { kinks: &kinks, patch_kinks: &patch_kinks, ..case.geometry() };
    let below = |r: &CellRule, x: Vec2| {
        let p = r.anchor + x;
        p.y < 0.15 + 0.025 * p.x
    };
    let orders = Orders::for_degree(1);
    let mut cut = 0.0;
    for rule in rules(geometry, orders) {
        let active = rule.patches.contains(&(patch as u32));
        if active {
            let of = |r: &CellRule| -> f64 {
                let points = r.offsets.iter().zip(&r.weights);
                points.filter(|(x, _)| below(r, **x)).map(|(_, w)| w).sum()
            };
            cut += of(&rule);
        } else {
            assert!(case.rules(orders).iter().any(|r| r.anchor == rule.anchor));
        }
    }
    let support = case.partition.support(patch);
    let line = [vec2(2.0, 0.2), vec2(-2.0, 0.1)];
    let exact = square_integral(&left_of(line, &support.corners()), 1.0, Vec2::ZERO);
    assert_near(cut, exact, 1e-14, "area of the patch below its kink");
    let plain: Vec<CellRule> = case.rules(orders);
    let inactive = |rules: Vec<CellRule>| -> Vec<CellRule> {
        rules.into_iter().filter(|r| !r.patches.contains(&(patch as u32))).collect()
    };
    assert_eq!(inactive(rules(geometry, orders)), inactive(plain));
}

#[test]
fn nothing_active_changes_nothing() {
    let mut random = Random(77);
    let tip = vec2(0.21, 0.13);
    let case = GeometryCase::new(
        graded(&mut random, WeightFunction::Quadratic),
        vec![crack(&[vec2(-1.0, 0.1), tip])],
        vec![tip],
    );
    let kinks = [
        KinkLine::Line([vec2(0.0, 0.0), vec2(1.0, 1.0)]),
        KinkLine::Segment([vec2(0.0, 0.0), vec2(1.0, 1.0)]),
        KinkLine::Curve(std::sync::Arc::new(|p: Vec2| p.dot(p) - 0.5)),
        KinkLine::Line([vec2(0.0, 1.5), vec2(1.0, 1.5)]),
        KinkLine::Segment([vec2(1.1, 0.0), vec2(2.0, 1.0)]),
        KinkLine::Curve(std::sync::Arc::new(|p: Vec2| p.dot(p) - 9.0)),
    ];
    let probes = vec![|_: Vec2, _: Vec2| -> [f64; 3] { unreachable!("no patch has the probe") }];
    let none = vec![Vec::new(); case.partition.len()];
    let geometry = SmoothnessGeometry {
        kinks: &kinks,
        patch_kinks: &none,
        common_kinks: &[3, 4, 5],
        probes: &probes,
        patch_probes: &none,
        ..case.geometry()
    };
    for orders in [Orders::for_degree(1), Orders::for_degree(3)] {
        assert_eq!(rules(geometry, orders), case.rules(orders));
    }
}
