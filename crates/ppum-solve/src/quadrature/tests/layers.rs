//! Functions that have to be resolved.

use super::*;
use std::f64::consts::PI;
use std::sync::Arc;

type LayerSample = [f64; 3];

/// exp(−e·x / ε) with its gradient.
fn layer(e: Vec2, eps: f64) -> impl Fn(Vec2, Vec2) -> LayerSample + Sync {
    move |a, x| {
        let f = (-(a + x).dot(e) / eps).exp();
        [f, -f * e.x / eps, -f * e.y / eps]
    }
}

fn resolved(case: &GeometryCase, probes: &dyn Probes, orders: Orders) -> Vec<CellRule> {
    rules(SmoothnessGeometry { probes, common_probes: &[0], ..case.geometry() }, orders)
}

/// ∫ exp(−s x) over the unit interval.
fn decay(s: f64) -> f64 {
    if s == 0.0 { 1.0 } else { -(-s).exp_m1() / s }
}

#[test]
fn layers_along_any_line_take_few_pieces() {
    for p in [1, 2, 3] {
        let orders = Orders::for_degree(p);
        for eps in [0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
            for angle in [0.0_f64, 0.3, 0.9, 1.2, PI / 2.0 - 1e-9] {
                let e = vec2(angle.cos(), angle.sin());
                let case = alone(UNIT, Vec::new(), Vec::new());
                let rules = resolved(&case, &vec![layer(e, eps)], orders);
                let exact = decay(2.0 * e.x / eps) * decay(2.0 * e.y / eps);
                let square = integrate(&rules, |a, x| (-2.0 * (a + x).dot(e) / eps).exp());
                assert_near(square, exact, 1e-10 * exact, &format!("ε = {eps:e}, angle {angle}"));
                let pieces = n_points(&rules) / orders.singular.pow(2);
                let most = 10.0 + 1.5 * (1.0 / eps).log2();
                assert!(pieces as f64 <= most, "p = {p}, ε = {eps:e}, {angle}: {pieces} pieces");
            }
        }
    }
}

#[test]
fn products_of_layers_and_polynomials() {
    // ∫ exp(−2x/ε) (x/ε)^k = ε k! / 2^(k+1), and y^k integrated beside it
    for (p, eps) in [(1, 1e-2), (2, 1e-3), (3, 1e-5)] {
        let case = alone(UNIT, Vec::new(), Vec::new());
        let rules = resolved(&case, &vec![layer(vec2(1.0, 0.0), eps)], Orders::for_degree(p));
        for k in 0..=2 * p as i32 {
            let value = integrate(&rules, |a, x| {
                let p = a + x;
                (-2.0 * p.x / eps).exp() * (p.x / eps).powi(k) * p.y.powi(k)
            });
            let factorial: f64 = (1..=k).map(f64::from).product();
            let exact = eps * factorial / 2.0_f64.powi(k + 1) / f64::from(k + 1);
            assert_near(value, exact, 1e-9 * exact, &format!("p = {p}, ε = {eps:e}, k = {k}"));
        }
    }
}

#[test]
fn without_probes_layers_are_missed() {
    let case = alone(UNIT, Vec::new(), Vec::new());
    let square = integrate(&case.rules(Orders::for_degree(2)), |a, x| (-2e3 * (a + x).x).exp());
    assert!(square < 1e-12, "the exact value is 5e-4");
}

#[test]
fn two_layers_in_a_corner() {
    let case = alone(UNIT, Vec::new(), Vec::new());
    let (ex, ey, eps) = (vec2(1.0, 0.0), vec2(0.0, 1.0), 1e-3);
    let probes = vec![layer(ex, eps), layer(ey, eps)];
    let orders = Orders::for_degree(1);
    let geometry =
        SmoothnessGeometry { probes: &probes, common_probes: &[0, 1], ..case.geometry() };
    let rules = rules(geometry, orders);
    assert!(n_points(&rules) / orders.singular.pow(2) <= 144, "a grid of layers");
    for e in [ex, ey] {
        let value = integrate(&rules, |a, x| (-2.0 * (a + x).dot(e) / eps).exp());
        let exact = decay(2.0 * e.x / eps) * decay(2.0 * e.y / eps);
        assert_near(value, exact, 1e-9 * exact, &format!("layer along {e:?}"));
    }
    let product = vec![|a: Vec2, x: Vec2| {
        let p = a + x;
        let f = (-(p.x + p.y) / 1e-3).exp();
        [f, -1e3 * f, -1e3 * f]
    }];
    let value = integrate(&resolved(&case, &product, orders), |a, x| {
        (-2e3 * ((a + x).x + (a + x).y)).exp()
    });
    assert_near(value, 0.25e-6, 1e-15, "product of two layers");
}

#[test]
fn layers_on_both_sides_of_a_circle() {
    let (c, r) = (vec2(0.1, -0.05), 0.4);
    let kinks = [KinkLine::Curve(Arc::new(move |p: Vec2| (p - c).length() - r))];
    for eps in [1e-2, 1e-3, 1e-4] {
        let case = GeometryCase::new(uniform(1), Vec::new(), Vec::new());
        let probes = vec![move |a: Vec2, x: Vec2| {
            let way = a + x - c;
            let d = way.length() - r;
            let f = (-d.abs() / eps).exp();
            let g = way.unit() * (-d.signum() * f / eps);
            [f, g.x, g.y]
        }];
        let geometry = SmoothnessGeometry {
            kinks: &kinks,
            common_kinks: &[0],
            probes: &probes,
            common_probes: &[0],
            ..case.geometry()
        };
        let orders = Orders::for_degree(2);
        let rules = rules(geometry, orders);
        let value = integrate(&rules, |a, x| (-2.0 * ((a + x - c).length() - r).abs() / eps).exp());
        let exact = 2.0 * PI * r * eps;
        assert_near(value, exact, 1e-8 * exact, &format!("ε = {eps:e}"));
        let pieces = n_points(&rules) / orders.singular.pow(2);
        assert!(pieces < 1200, "{pieces} pieces along ten rectangles and more");
    }
}

#[test]
fn waves_and_undeclared_kinks() {
    let orders = Orders::for_degree(2);
    let case = alone(UNIT, Vec::new(), Vec::new());
    let (k, l) = (61.0, 23.0);
    let wave = vec![move |a: Vec2, x: Vec2| {
        let (s, c) = (k * (a + x).x + l * (a + x).y).sin_cos();
        [s, k * c, l * c]
    }];
    let value = integrate(&resolved(&case, &wave, orders), |a, x| {
        (k * (a + x).x + l * (a + x).y).sin().powi(2)
    });
    let cosines = (2.0 * (k + l)).cos() - (2.0 * k).cos() - (2.0 * l).cos() + 1.0;
    let exact = 0.5 + cosines / (8.0 * k * l);
    assert_near(value, exact, 1e-9, "wave");

    let (normal, at) = (vec2(0.6, 0.8), 0.5137);
    let kink = vec![move |a: Vec2, x: Vec2| {
        let d = normal.dot(a + x) - at;
        [d.abs(), normal.x * d.signum(), normal.y * d.signum()]
    }];
    let rules = resolved(&case, &kink, orders);
    let value = integrate(&rules, |a, x| (normal.dot(a + x) - at).abs());
    let line = KinkLine::Line([normal * at, normal * at + normal.left()]);
    let kinks = [line];
    let cut = SmoothnessGeometry { kinks: &kinks, common_kinks: &[0], ..case.geometry() };
    let exact = integrate(&super::rules(cut, orders), |a, x| (normal.dot(a + x) - at).abs());
    assert_near(value, exact, 1e-9, "kink nobody declared");
    assert!(n_points(&rules) / orders.singular.pow(2) < 80);
}

#[test]
fn smooth_probes_cost_no_pieces() {
    let case = GeometryCase::new(uniform(2), Vec::new(), Vec::new());
    let probes = vec![|a: Vec2, x: Vec2| {
        let p = a + x;
        [p.x * p.y + p.x * p.x, p.y + 2.0 * p.x, p.x]
    }];
    let orders = Orders::for_degree(1);
    let with = resolved(&case, &probes, orders);
    assert_eq!(n_points(&with), n_points(&case.rules(Orders::uniform(orders.singular))));
}

#[test]
fn probes_count_where_their_patch_is_active() {
    let case = GeometryCase::new(uniform(2), Vec::new(), Vec::new());
    let probes = vec![layer(vec2(1.0, 0.0), 1e-3)];
    let patch = 5;
    let mut lists = vec![Vec::new(); case.partition.len()];
    lists[patch] = vec![0];
    let orders = Orders::for_degree(1);
    let geometry = SmoothnessGeometry { probes: &probes, patch_probes: &lists, ..case.geometry() };
    let active = |r: &CellRule| r.patches.contains(&(patch as u32));
    let (with, without) = (rules(geometry, orders), case.rules(orders));
    let (a, b): (Vec<_>, Vec<_>) = with.into_iter().partition(active);
    let (c, d): (Vec<_>, Vec<_>) = without.into_iter().partition(active);
    assert_eq!(b, d);
    assert!(n_points(&a) > n_points(&c));
}

#[test]
fn hostile_probes_end_within_the_budget() {
    let case = alone(UNIT, Vec::new(), Vec::new());
    let orders = Orders::for_degree(2);
    let noise = |p: Vec2| ((p.x * 12.9898 + p.y * 78.233).sin() * 43758.5453).fract();
    let hostile: Vec<Box<dyn Fn(Vec2, Vec2) -> LayerSample + Sync>> = vec![
        Box::new(|_, _| [f64::NAN; 3]),
        Box::new(|_, _| [f64::INFINITY; 3]),
        Box::new(move |a, x| [noise(a + x); 3]),
        Box::new(layer(vec2(1.0, 0.0), 1e-300)),
        Box::new(layer(vec2(0.6, 0.8), 1e-30)),
        Box::new(layer(vec2(-1.0, 0.3), 1e-4)),
        Box::new(|_, _| [1e-200; 3]),
        Box::new(|_, _| [1e200; 3]),
        Box::new(|a, x| [1.0 / (a + x).x, 0.0, 0.0]),
    ];
    for k in 0..hostile.len() as u32 {
        let geometry =
            SmoothnessGeometry { probes: &hostile, common_probes: &[k], ..case.geometry() };
        let rules = rules(geometry, orders);
        assert_near(integrate(&rules, |_, _| 1.0), 1.0, 1e-12, "area");
        assert!(n_points(&rules) <= 500 * 64, "probe {k}: {}", n_points(&rules));
        assert_eq!(rules, super::rules(geometry, orders));
    }
}

#[test]
fn noise_is_left_whole() {
    // all that is left here of 1 − tanh is a few units of the last place, or none
    let cell = Rect::new(vec2(0.5, 0.0), vec2(0.7, 0.2));
    let probes = vec![|a: Vec2, x: Vec2| {
        let f = (35.0 * ((a + x).x + 1e-3 * (a + x).y)).tanh();
        [1.0 - f, -35.0 * (1.0 - f * f), 0.0]
    }];
    let case = alone(cell, Vec::new(), Vec::new());
    let orders = Orders::for_degree(2);
    let rules = resolved(&case, &probes, orders);
    assert_eq!(n_points(&rules), orders.singular.pow(2));
    let probes = vec![|a: Vec2, x: Vec2| {
        let f = (35.0 * (a + x).x).tanh();
        [f, 35.0 * (1.0 - f * f), 0.0]
    }];
    assert_eq!(n_points(&resolved(&case, &probes, orders)), orders.singular.pow(2));
}

#[test]
fn layers_at_a_corner_with_a_power() {
    // r^λ exp(−r/ε) on a quarter disc's worth of the plane: ∫ r^(2λ−1) e^(−2r/ε) dr =
    // (ε/2)^(2λ) Γ(2λ)
    let (lambda, eps) = (0.5_f64, 1e-3);
    let f = move |a: Vec2, x: Vec2| {
        let p = a + x;
        let r = p.length();
        let (f, slope) = ((-r / eps).exp() * r.powf(lambda), lambda / r - 1.0 / eps);
        [f, f * slope * p.x / r, f * slope * p.y / r]
    };
    let mut case = alone(UNIT, Vec::new(), vec![Vec2::ZERO]);
    case.singular[0].growth = SingularGrowth::Powers { least: lambda };
    let rules = resolved(&case, &vec![f], Orders::for_degree(2));
    let value = integrate(&rules, |a, x| {
        let r = (a + x).length();
        (-2.0 * r / eps).exp() * r.powf(2.0 * lambda - 2.0)
    });
    let exact = PI / 2.0 * (eps / 2.0).powf(2.0 * lambda);
    assert_near(value, exact, 1e-9 * exact, "layer and power");
}
