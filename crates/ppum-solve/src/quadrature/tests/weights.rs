//! Overlaps of weights that are not linear.

use super::*;
use ppum::library::WEIGHTS;

/// exp(1 − 1/(1 − ξ²)), a function with all derivatives.
fn bump(xi: f64) -> [f64; 2] {
    let q = 1.0 - xi * xi;
    let w = (1.0 - 1.0 / q).exp();
    [w, -2.0 * xi / (q * q) * w]
}

fn spline(weight: WeightFunction) -> impl Fn(f64) -> [f64; 2] {
    move |xi| {
        let [w, slope, _] = weight.spline(xi);
        [w, slope]
    }
}

/// ∫ φ′² of two bumps with centres 0 and c, half-sizes h and k, on \[lo, hi\], by many trapezia:
/// all derivatives vanish at both ends of the overlap.
fn trapezia(h: f64, c: f64, k: f64) -> f64 {
    let (lo, hi) = (c - k, h);
    let n = 100_000;
    let at = |j: usize| {
        let x = lo + (hi - lo) * (j as f64 / n as f64);
        slope(x, h, c, k).powi(2)
    };
    (1..n).map(at).sum::<f64>() * (hi - lo) / n as f64
}

/// φ′ of the first of two bumps.
fn slope(x: f64, h: f64, c: f64, k: f64) -> f64 {
    let ([a, da], [b, db]) = (bump(x / h), bump((x - c) / k));
    (da / h * b - a * db / k) / (a + b).powi(2)
}

#[test]
fn overlaps_of_bumps_are_right_to_a_given_accuracy() {
    for accuracy in [1e-4, 1e-6, 1e-9] {
        let (orders, error) = Orders::for_weight(2, 1.3, &[], &bump, accuracy);
        assert!(error <= accuracy);
        assert_eq!(Orders { overlap: 6, parts: 1, ..orders }, Orders::for_degree(2));
        for (c, k) in [(2.0, 1.3), (1.5, 0.65)] {
            let (lo, hi) = (c - k, 1.3);
            let ends = split::divided(vec![lo, hi], orders.parts);
            let value: f64 = ends
                .windows(2)
                .flat_map(|e| gauss(orders.overlap).on(e[0], e[1]))
                .map(|(x, w)| w * slope(x, 1.3, c, k).powi(2))
                .sum();
            let exact = trapezia(1.3, c, k);
            assert_near(value, exact, 2.0 * accuracy * exact, &format!("c = {c}"));
        }
    }
    let (_, error) = Orders::for_weight(2, 1.3, &[], &bump, 0.0);
    assert!(error > 0.0 && error < 1e-9, "the best rule's error is told: {error:e}");
}

#[test]
fn linear_weights_need_no_more_than_the_default() {
    let weight = WeightFunction::Linear;
    for p in 1..=8 {
        let (orders, error) =
            Orders::for_weight(p, 1.3, weight.breakpoints(), &spline(weight.clone()), 2e-5);
        let default = Orders::for_degree(p);
        assert!(error <= 2e-5 && orders.overlap <= default.overlap, "order {p}: {orders:?}");
        assert_eq!(Orders { overlap: default.overlap, ..orders }, default);
    }
}

/// ∫ |∇φ_i|² of the first patch of each rule, by differences of the product rule.
fn energy(case: &GeometryCase, orders: Orders) -> f64 {
    let step = 1e-6;
    let of_rule = |r: &CellRule| {
        let square = |a: Vec2, x: Vec2| {
            let at = |d: Vec2| partition_function(&case.partition, &r.patches, a + x + d);
            let gx = at(vec2(step, 0.0)) - at(vec2(-step, 0.0));
            let gy = at(vec2(0.0, step)) - at(vec2(0.0, -step));
            (gx * gx + gy * gy) / (4.0 * step * step)
        };
        integrate(std::slice::from_ref(r), square)
    };
    case.rules(orders).iter().map(of_rule).sum()
}

#[test]
fn the_orders_hold_in_the_plane() {
    let case =
        GeometryCase::new(graded(&mut Random(4), WeightFunction::Cubic), Vec::new(), Vec::new());
    let fine = energy(&case, Orders { parts: 4, ..Orders::uniform(16) });
    let weight = WeightFunction::Cubic;
    for (accuracy, tolerance) in [(1e-3, 1e-3), (1e-6, 1e-6)] {
        let (orders, _) =
            Orders::for_weight(2, 1.3, weight.breakpoints(), &spline(weight.clone()), accuracy);
        assert_near(energy(&case, orders), fine, tolerance * fine, &format!("{accuracy:e}"));
    }
    let area = integrate(&case.rules(Orders { parts: 3, ..Orders::for_degree(1) }), |_, _| 1.0);
    assert_near(area, 4.0, 1e-13, "area");
}

#[test]
fn only_overlaps_are_divided_and_only_where_functions_vary() {
    let case = GeometryCase::new(uniform(3), Vec::new(), Vec::new());
    let inner = case.partition.cell.iter().position(|c| c.min == vec2(-0.25, -0.25)).expect("cell");
    let cell = case.partition.cell[inner];
    let orders = Orders { parts: 3, ..Orders::for_degree(2) };
    let rules =
        case.quadrature(orders).cell(covered(&cell, &covering_patches(&case.partition, &cell)));
    let mut counts: Vec<_> = rules.iter().map(|r| (r.patches.len(), r.offsets.len())).collect();
    counts.sort_unstable();
    assert_eq!(counts[0], (1, 9));
    assert_eq!(counts[1..5], [(2, 3 * 36); 4]);
    assert_eq!(counts[5..], [(4, 9 * 36); 4]);
}

#[test]
fn discs_have_the_points_that_the_weight_needs() {
    let case = GeometryCase::new(uniform(2), Vec::new(), Vec::new());
    let points = |orders: Orders| {
        let quadrature = case.quadrature(orders);
        let (center, radius) = (vec2(0.1, 0.2), 0.5);
        let rules = |c: &Rect| {
            quadrature.disc(
                covered(c, &covering_patches(&case.partition, c)),
                Disc::even(center, radius, 8),
            )
        };
        let rules: Vec<CellRule> = case.partition.cell.iter().flat_map(rules).collect();
        let (overlaps, rest): (Vec<_>, Vec<_>) =
            rules.into_iter().partition(|r| r.patches.len() > 1);
        (n_points(&overlaps), n_points(&rest))
    };
    let default = Orders::for_degree(1);
    let (few, alone) = points(default);
    assert_eq!(points(Orders { overlap: 8, ..default }), (few, alone));
    let (more, same) = points(Orders { overlap: 16, ..default });
    assert!(more > few && same == alone);
}

/// The rule of the solver on a graded cover, and the default, which is right for linear
/// weights only.
#[test]
fn all_weights_of_the_library_are_integrated() {
    let accuracy = 1e-5;
    for entry in &WEIGHTS {
        let weight = WeightFunction::from_library(entry.name).expect("of the library");
        let case =
            GeometryCase::new(graded(&mut Random(4), weight.clone()), Vec::new(), Vec::new());
        let fine = energy(&case, Orders { parts: 3, ..Orders::uniform(12) });
        let error = |orders: Orders| (energy(&case, orders) / fine - 1.0).abs();
        let (orders, _) =
            Orders::for_weight(2, 1.3, weight.breakpoints(), &spline(weight.clone()), accuracy);
        let (own, default) = (error(orders), error(Orders::for_degree(2)));
        println!("{}: {own:.1e}, by default {default:.1e}", entry.name);
        assert!(own < accuracy, "{}: {own}", entry.name);
        assert!(
            default > 100.0 * own || weight == WeightFunction::Linear,
            "{}: {default}",
            entry.name
        );
    }
}
