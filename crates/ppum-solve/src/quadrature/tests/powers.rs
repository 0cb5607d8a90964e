//! Singular points of any exponent.

use super::singular::{Complex, half_plane, power_integral, tip_positions};
use super::*;

/// Largest error of ∫ Re z^q and ∫ Im z^q over random cells with a cut along a crack, relative to
/// ∫ |z|^q.
fn error(lambda: f64, powers: [f64; 4], orders: Orders) -> f64 {
    let mut worst: f64 = 0.0;
    // along the axes the closed form keeps its digits, be the tip on the boundary of the cell
    let axes = [vec2(1.0, 0.0), vec2(0.0, 1.0), vec2(-1.0, 0.0), vec2(0.0, -1.0)];
    for ((cell, tip, _), axis) in tip_positions(&mut Random(5)).into_iter().zip(axes.iter().cycle())
    {
        let axis = *axis;
        let to_frame = |p: Vec2| vec2(p.dot(axis), axis.cross(p));
        let mut case = alone(cell, vec![crack(&[tip - axis * 9.0, tip])], vec![tip]);
        case.singular[0].growth = SingularGrowth::Powers { least: lambda };
        let rules = case.rules(orders);
        let corners: Vec<Vec2> = cell.corners().iter().map(|&p| to_frame(p - tip)).collect();
        for q in powers {
            let exact =
                [1.0, -1.0].map(|sign| power_integral(&half_plane(&corners, sign), q, sign > 0.0));
            let Complex(re, im) = exact[0] + exact[1];
            let integral = |f: &dyn Fn(f64) -> f64| {
                integrate(&rules, |a, x| {
                    let p = to_frame(if a == tip { x } else { a + x - tip });
                    p.length().powf(q) * f(q * p.y.atan2(p.x))
                })
            };
            let size = integral(&|_| 1.0);
            let (re, im) = (integral(&f64::cos) - re, integral(&f64::sin) - im);
            worst = worst.max(re.abs().max(im.abs()) / size);
        }
    }
    worst
}

#[test]
fn products_of_gradients_match_closed_forms() {
    for (lambda, tolerance) in [
        (0.05, 1e-8),
        (0.1, 1e-8),
        (0.25, 1e-10),
        (0.2713, 1e-10),
        (0.4, 1e-10),
        (0.5444837, 1e-10),
        (2.0 / 3.0, 1e-10),
        (0.9, 1e-10),
        (1.3, 1e-10),
        (1.7, 1e-10),
        (3.2, 1e-10),
    ] {
        let powers = [2.0 * lambda - 2.0, lambda - 1.0, 2.0 * lambda - 1.0, 2.0 * lambda];
        let error = error(lambda, powers, Orders::for_degree(1));
        assert!(error < tolerance, "λ = {lambda}: {error:e}");
    }
}

#[test]
fn half_powers_are_not_enough_for_weak_exponents() {
    let tip = vec2(0.2, 0.3);
    let (lambda, exact) = (0.1, std::f64::consts::PI * 0.5_f64.powf(0.2) / 0.1);
    let value = |growth: SingularGrowth| {
        let mut case = GeometryCase::new(uniform(2), Vec::new(), vec![tip]);
        case.singular[0].growth = growth;
        disc(&case, tip, 0.5, |r| r.powf(2.0 * lambda - 2.0)) / exact
    };
    let beta: f64 = (1..=12).map(|k| f64::from(k) / (lambda + f64::from(k))).product();
    assert!((value(SingularGrowth::HalfPowers) - beta).abs() > 1e-3);
    assert_near(value(SingularGrowth::Powers { least: lambda }), beta, 1e-8, "r^(2λ−2)");
}

/// ∫ (1 − r²/R²)¹² f(r) over a disc in the domain, with the rules of the cells.
fn disc(case: &GeometryCase, center: Vec2, radius: f64, f: impl Fn(f64) -> f64) -> f64 {
    integrate(&case.rules(Orders::uniform(20)), |a, x| {
        let r = (x + (a - center)).length();
        (1.0 - (r / radius).powi(2)).max(0.0).powi(12) * f(r)
    })
}

/// Digamma of x > 0 less digamma of x + 13.
fn digamma_step(x: f64) -> f64 {
    -(0..13).map(|k| 1.0 / (x + f64::from(k))).sum::<f64>()
}

#[test]
fn logarithms_match_closed_forms() {
    // ∫ r^(2λ−2) log r (1 − r²/R²)^m dA is a derivative of π R^(2λ) B(λ, m + 1) by 2λ
    let (tip, radius) = (vec2(0.21, 0.33), 0.6_f64);
    for (lambda, tolerance) in
        [(0.1, 2e-8), (0.25, 1e-9), (0.5, 1e-9), (2.0 / 3.0, 1e-9), (1.7, 1e-9)]
    {
        let mut case = GeometryCase::new(uniform(2), Vec::new(), vec![tip]);
        case.singular[0].growth = SingularGrowth::Powers { least: lambda };
        let beta: f64 = (1..=12).map(|k| f64::from(k) / (lambda + f64::from(k))).product();
        let whole = std::f64::consts::PI * radius.powf(2.0 * lambda) * beta / lambda;
        let once = radius.ln() + 0.5 * digamma_step(lambda);
        let trigamma: f64 = (0..13).map(|k| (lambda + f64::from(k)).powi(-2)).sum();
        let twice = once * once + 0.25 * trigamma;
        for (power, factor) in [(1, once), (2, twice)] {
            let exact = whole * factor;
            let value =
                disc(&case, tip, radius, |r| r.powf(2.0 * lambda - 2.0) * r.ln().powi(power));
            assert_near(
                value,
                exact,
                tolerance * exact.abs(),
                &format!("λ = {lambda}, log^{power}"),
            );
        }
    }
}

#[test]
fn points_in_one_place_take_the_weaker_exponent() {
    let tip = vec2(0.2, 0.3);
    let cell = Rect::new(vec2(0.1, 0.2), vec2(0.4, 0.5));
    let rules = |growths: &[SingularGrowth]| {
        let singular: Vec<_> =
            growths.iter().map(|&growth| Singularity { growth, ..Singularity::tip(tip) }).collect();
        let lists = vec![(0..singular.len() as u32).collect::<Vec<_>>()];
        let case = alone(cell, Vec::new(), Vec::new());
        let geometry =
            SmoothnessGeometry { singular: &singular, patch_singular: &lists, ..case.geometry() };
        super::rules(geometry, Orders::for_degree(2))
    };
    let (weak, strong) =
        (SingularGrowth::Powers { least: 0.3 }, SingularGrowth::Powers { least: 0.8 });
    assert_eq!(rules(&[weak, strong]), rules(&[weak]));
    assert_eq!(rules(&[SingularGrowth::HalfPowers, weak]), rules(&[weak]));
    assert_eq!(
        rules(&[strong, SingularGrowth::HalfPowers]),
        rules(&[SingularGrowth::Powers { least: 0.5 }])
    );
    assert_eq!(rules(&[SingularGrowth::HalfPowers; 2]), rules(&[SingularGrowth::HalfPowers]));
}

#[test]
fn only_triangles_at_the_point_cost_more() {
    let cell = Rect::new(vec2(0.1, 0.2), vec2(0.4, 0.5));
    let points = |tip: Vec2, growth: SingularGrowth| {
        let mut case = alone(cell, Vec::new(), vec![tip]);
        case.singular[0].growth = growth;
        n_points(&case.rules(Orders::for_degree(2)))
    };
    let inside = vec2(0.2, 0.31);
    let tip = points(inside, SingularGrowth::HalfPowers);
    for lambda in [0.1, 0.25, 0.7, 1.7] {
        let corner = points(inside, SingularGrowth::Powers { least: lambda });
        assert!(corner <= 5 * tip, "λ = {lambda}: {corner} points instead of {tip}");
        let beside = vec2(0.05, 0.31);
        let (corner, tip) = (
            points(beside, SingularGrowth::Powers { least: lambda }),
            points(beside, SingularGrowth::HalfPowers),
        );
        assert_eq!(corner, tip);
    }
}

#[test]
fn absurd_exponents_give_finite_rules() {
    let tip = vec2(0.2, 0.3);
    for least in [1e-300, 0.0, -1.0, f64::NAN, f64::INFINITY, 1e9] {
        let mut case = alone(UNIT, Vec::new(), vec![tip]);
        case.singular[0].growth = SingularGrowth::Powers { least };
        for orders in [Orders::for_degree(1), Orders::uniform(crate::quadrature::gauss::MAX_POINTS)]
        {
            let area = integrate(&case.rules(orders), |_, _| 1.0);
            assert_near(area, 1.0, 1e-7, &format!("exponent {least}"));
        }
    }
}
