//! Everything at once.

use super::*;
use std::sync::Arc;

/// A geometry's parts, all of them active everywhere.
fn scene(random: &mut Random, trial: usize) -> (GeometryCase, Vec<KinkLine>) {
    let cover = match trial % 2 {
        0 => graded(random, WeightFunction::ALL[trial % 3].clone()),
        _ => uniform(trial as u32 % 3),
    };
    let (start, tip) = (point(random, 0.9), point(random, 0.9));
    let corner = if trial.is_multiple_of(3) { vec2(-1.0, 1.0) } else { point(random, 0.9) };
    let mut case = GeometryCase::new(cover, vec![crack(&[start, tip])], vec![tip, corner]);
    case.singular[1].growth = SingularGrowth::Powers { least: random.between(0.1, 1.9) };
    let (c, r) = (point(random, 0.5), random.between(0.05, 0.6));
    let through = if trial % 4 == 1 { tip } else { point(random, 1.0) };
    let kinks = vec![
        KinkLine::Line([point(random, 1.0), through]),
        KinkLine::Segment([point(random, 1.0), point(random, 1.0)]),
        KinkLine::Curve(Arc::new(move |p: Vec2| (p - c).dot(p - c) - r * r)),
    ];
    (case, kinks)
}

/// The side of every line and curve that a point is on.
fn side(kinks: &[KinkLine], p: Vec2) -> f64 {
    let of = |kink: &KinkLine| match kink {
        KinkLine::Line([a, b]) => (*b - *a).cross(p - *a),
        KinkLine::Segment(_) => 1.0,
        KinkLine::Curve(level) => level(p),
    };
    kinks.iter().map(|k| of(k).signum()).product()
}

#[test]
fn all_kinds_of_geometry_keep_the_area_and_tell_sides() {
    let mut random = Random(2024);
    let orders = Orders::for_degree(2);
    for trial in 0..12 {
        let (case, kinks) = scene(&mut random, trial);
        let e = point(&mut random, 1.0).unit();
        let probes = vec![move |a: Vec2, x: Vec2| {
            let f = (30.0 * (a + x).dot(e)).tanh();
            let slope = 30.0 * (1.0 - f * f);
            [f, slope * e.x, slope * e.y]
        }];
        let geometry = SmoothnessGeometry {
            kinks: &kinks,
            common_kinks: &[0, 1, 2],
            probes: &probes,
            common_probes: &[0],
            ..case.geometry()
        };
        let rules = rules(geometry, orders);
        let what = format!("trial {trial}");
        assert_near(integrate(&rules, |_, _| 1.0), 4.0, 1e-8, &what);
        assert_near(integrate(&rules, |a, x| (a + x).x.powi(3) * (a + x).y), 0.0, 1e-8, &what);
        let balance = |rules: &[CellRule]| integrate(rules, |a, x| side(&kinks, a + x));
        let finer = Orders { reserve: 0, ..Orders::uniform(12) };
        assert_near(balance(&rules), balance(&super::rules(geometry, finer)), 1e-7, &what);
        assert!(rules.iter().flat_map(|r| &r.weights).all(|&w| w > 0.0));
        assert_eq!(rules, super::rules(geometry, orders));
    }
}

#[test]
fn discs_honour_kinks_and_probes() {
    // ∫ (1 − r²/R²)¹² / r over the half of a disc on one side of a line through its centre, and
    // over the part inside a smaller circle about it
    let (tip, radius, small) = (vec2(0.1, -0.05), 0.7, 0.31);
    let case = GeometryCase::new(uniform(3), vec![crack(&[vec2(-1.0, -0.05), tip])], vec![tip]);
    let (normal, way) = (vec2(0.6, 0.8), vec2(-0.8, 0.6));
    let kinks = [
        KinkLine::Line([tip, tip + way]),
        KinkLine::Curve(Arc::new(move |p: Vec2| (p - tip).length() - small)),
    ];
    let geometry = SmoothnessGeometry { kinks: &kinks, common_kinks: &[0, 1], ..case.geometry() };
    let quadrature = Quadrature::new(geometry, Orders::for_degree(1));
    let disc = |c: &Rect| {
        quadrature
            .disc(covered(c, &covering_patches(&case.partition, c)), Disc::even(tip, radius, 14))
    };
    let rules: Vec<CellRule> = case.partition.cell.iter().flat_map(disc).collect();
    let density = |x: Vec2| {
        let r = x.length();
        (1.0 - (r / radius).powi(2)).max(0.0).powi(12) / r
    };
    let beta: f64 = (1..=12).map(|k| 2.0 * f64::from(k) / (2.0 * f64::from(k) + 1.0)).product();
    let exact = std::f64::consts::PI * radius * beta;
    let above = integrate(&rules, |_, x| if normal.dot(x) > 0.0 { density(x) } else { 0.0 });
    assert_near(above, exact, 1e-9, "one side of the line");

    // 2π ∫ of the polynomial (1 − r²/R²)¹² over r
    let radial: f64 = gauss(20).on(0.0, small).map(|(r, w)| w * r * density(vec2(r, 0.0))).sum();
    let inside = integrate(&rules, |_, x| if x.length() < small { density(x) } else { 0.0 });
    assert_near(inside, 2.0 * std::f64::consts::PI * radial, 1e-8, "inside the circle");
}
