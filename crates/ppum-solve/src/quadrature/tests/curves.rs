//! Curved kinks.

use super::adapt::{IntegrandDemand, refined};
use super::chart::CellChart;
use super::curve::{ChartWindow, cut_all};
use super::local_curve::LocalCurve;
use super::piece::SmoothPiece;
use super::*;
use std::f64::consts::PI;
use std::slice::from_ref;
use std::sync::Arc;

fn curve(level: impl Fn(Vec2) -> f64 + Send + Sync + 'static) -> KinkLine {
    KinkLine::Curve(Arc::new(level))
}

/// A circle, by the square of the distance and by the distance, which has a point at the centre.
fn circles(c: Vec2, r: f64) -> [KinkLine; 2] {
    [curve(move |p| (p - c).dot(p - c) - r * r), curve(move |p| r - (p - c).length())]
}

/// ∫ f over the part where `inside` holds, with the kinks active everywhere.
fn integral(
    case: &GeometryCase,
    kinks: &[KinkLine],
    orders: Orders,
    inside: impl Fn(Vec2) -> bool,
    f: impl Fn(Vec2) -> f64,
) -> f64 {
    let common: Vec<u32> = (0..kinks.len() as u32).collect();
    let geometry = SmoothnessGeometry { kinks, common_kinks: &common, ..case.geometry() };
    let rules = rules(geometry, orders);
    let area = case.partition.cell.iter().map(|c| c.size().x * c.size().y).sum::<f64>();
    assert_near(integrate(&rules, |_, _| 1.0), area, 2e-9 * area, "area");
    integrate(&rules, |a, x| if inside(a + x) { f(a + x) } else { 0.0 })
}

#[test]
fn discs_in_one_cell() {
    for (c, r, part) in [
        (vec2(0.41, 0.52), 0.3, 1.0),
        (vec2(0.5, 0.5), 0.3, 1.0),
        (vec2(0.0, 0.5), 0.3, 0.5),
        (vec2(0.5, 1.0), 0.4, 0.5),
        (vec2(0.0, 1.0), 0.7, 0.25),
        (vec2(0.3, 0.4), 0.3, 1.0),
        (vec2(0.313, 0.777), 0.02, 1.0),
    ] {
        for kink in circles(c, r) {
            let case = alone(UNIT, Vec::new(), Vec::new());
            for (p, tolerance) in [(1, 1e-6), (2, 1e-7), (3, 1e-8)] {
                let orders = Orders::for_degree(p);
                let kinks = from_ref(&kink);
                let inside = |x: Vec2| (x - c).length() < r;
                let area = integral(&case, kinks, orders, inside, |_| 1.0);
                let exact = part * PI * r * r;
                assert_near(area, exact, tolerance * exact, &format!("disc at {c:?}, p = {p}"));
                let geometry = SmoothnessGeometry { kinks, common_kinks: &[0], ..case.geometry() };
                let pieces = n_points(&rules(geometry, orders)) / orders.overlap.pow(2);
                assert!(pieces <= 110, "{pieces} pieces");
            }
        }
    }
}

#[test]
fn moments_of_discs_on_graded_covers() {
    let mut random = Random(41);
    for trial in 0..12 {
        let weight = WeightFunction::ALL[trial % 3].clone();
        let case = GeometryCase::new(graded(&mut random, weight), Vec::new(), Vec::new());
        let (c, r) = (point(&mut random, 0.5), random.between(0.1, 0.45));
        let inside = |x: Vec2| (x - c).length() < r;
        for kink in circles(c, r) {
            let orders = Orders::for_degree(2);
            let moment =
                |f: &dyn Fn(Vec2) -> f64| integral(&case, from_ref(&kink), orders, inside, f);
            let square = PI * r * r;
            assert_near(moment(&|_| 1.0), square, 1e-9, "1");
            assert_near(moment(&|x| x.x), square * c.x, 1e-9, "x");
            let exact = square * (c.x * c.x + r * r / 4.0);
            assert_near(moment(&|x| x.x * x.x), exact, 1e-9, "x²");
            let exact = square * (c.x * c.x + r * r / 4.0) * c.y;
            assert_near(moment(&|x| x.x * x.x * x.y), exact, 1e-9, "x² y");
        }
    }
}

#[test]
fn shapes_with_closed_forms() {
    let case = alone(UNIT, Vec::new(), Vec::new());
    let orders = Orders::for_degree(2);
    let area = |kinks: &[KinkLine], inside: &dyn Fn(Vec2) -> bool| {
        integral(&case, kinks, orders, inside, |_| 1.0)
    };
    let ellipse = |p: Vec2| {
        let (u, v) = (0.8 * (p.x - 0.5) + 0.6 * (p.y - 0.5), 0.8 * (p.y - 0.5) - 0.6 * (p.x - 0.5));
        (u / 0.45).powi(2) + (v / 0.05).powi(2) - 1.0
    };
    let value = area(&[curve(ellipse)], &|p| ellipse(p) < 0.0);
    assert_near(value, PI * 0.45 * 0.05, 1e-9, "ellipse");

    let wave = |p: Vec2| p.y - 0.5 - 0.2 * (9.0 * p.x).sin();
    let exact = 0.5 + 0.2 * (1.0 - 9.0_f64.cos()) / 9.0;
    assert_near(area(&[curve(wave)], &|p| wave(p) < 0.0), exact, 1e-9, "below a wave");

    let hyperbola = |p: Vec2| (p.x - 0.3) * (p.y - 0.3) - 1e-6;
    // right of x = 0.3: 0.7 · 0.7 less ∫ 1e-6 / u from 1e-6/0.7 to 0.7, less the strip before
    let branch = |a: f64| a * a - 1e-6 * (1.0 + (a * a / 1e-6).ln());
    let exact = branch(0.7) + branch(0.3);
    let value = area(&[curve(hyperbola)], &|p| hyperbola(p) > 0.0);
    assert_near(value, exact, 1e-8, "hyperbola");

    let corner = |p: Vec2| (p.x - 0.31).max(p.y - 0.57);
    assert_near(area(&[curve(corner)], &|p| corner(p) < 0.0), 0.31 * 0.57, 1e-7, "corner");
}

#[test]
fn thin_bands_whose_middle_is_declared_before() {
    let case = alone(UNIT, Vec::new(), Vec::new());
    let area = |kinks: &[KinkLine], inside: &dyn Fn(Vec2) -> bool| {
        integral(&case, kinks, Orders::for_degree(2), inside, |_| 1.0)
    };
    let line = |p: Vec2| p.y - 0.2 * p.x - 0.437;
    let band = move |p: Vec2| line(p).abs() - 1e-3;
    assert_near(area(&[curve(line), curve(band)], &|p| band(p) < 0.0), 2e-3, 1e-10, "band");
    let middle = KinkLine::Line([vec2(0.0, 0.437), vec2(1.0, 0.637)]);
    assert_near(area(&[middle, curve(band)], &|p| band(p) < 0.0), 2e-3, 1e-10, "straight band");

    let circle = |p: Vec2| (p - vec2(0.45, 0.55)).length() - 0.35;
    let ring = move |p: Vec2| circle(p).abs() - 1e-3;
    let value = area(&[curve(circle), curve(ring)], &|p| ring(p) < 0.0);
    assert_near(value, PI * 1.4e-3, 1e-9, "ring");
}

#[test]
fn curves_that_cross() {
    let case = alone(UNIT, Vec::new(), Vec::new());
    let (a, b, r) = (vec2(0.35, 0.5), vec2(0.65, 0.5), 0.3);
    let kinks = [circles(a, r)[0].clone(), circles(b, r)[1].clone()];
    let inside = |p: Vec2| (p - a).length() < r && (p - b).length() < r;
    let lens = integral(&case, &kinks, Orders::for_degree(2), inside, |_| 1.0);
    let d: f64 = 0.3;
    let exact = 2.0 * r * r * (d / (2.0 * r)).acos() - 0.5 * d * (4.0 * r * r - d * d).sqrt();
    assert_near(lens, exact, 1e-9, "lens");

    let cross = [curve(|p| (p.x - 0.3) * (p.y - 0.7 - 0.2 * (p.x - 0.3)))];
    let inside = |p: Vec2| p.x > 0.3 && p.y > 0.7 + 0.2 * (p.x - 0.3);
    let area = integral(&case, &cross, Orders::for_degree(2), inside, |_| 1.0);
    assert_near(area, 0.7 * (0.3 - 0.1 * 0.7), 1e-8, "two lines in one level function");
}

#[test]
fn straight_curves_are_lines() {
    let mut random = Random(5);
    for _ in 0..10 {
        let case =
            GeometryCase::new(graded(&mut random, WeightFunction::Linear), Vec::new(), Vec::new());
        let (a, b) = (point(&mut random, 1.0), point(&mut random, 1.0));
        let side = move |p: Vec2| (b - a).cross(p - a);
        let area = |kinks: &[KinkLine]| {
            integral(&case, kinks, Orders::for_degree(1), |p| side(p) > 0.0, |p| p.x + 2.0 * p.y)
        };
        assert_near(area(&[curve(side)]), area(&[KinkLine::Line([a, b])]), 1e-12, "line");
    }
}

/// The error of the area of a disc's quarter in a square, n points on a given number of bisections
/// of each strip along the curve.
fn error(n: usize, bisections: u32) -> f64 {
    let (c, r) = (vec2(-0.3, -0.4), 1.1);
    let [KinkLine::Curve(level), _] = circles(c, r) else { unreachable!() };
    let square = CellChart::Quadrilateral(UNIT.corners());
    let (mut windows, _) =
        cut_all(vec![ChartWindow::whole(square)], &[LocalCurve::Level(level.as_ref(), Vec2::ZERO)]);
    for _ in 0..bisections {
        windows = windows.iter().flat_map(|w| w.halves(1)).flat_map(|w| w.halves(0)).collect();
    }
    let mut sum = 0.0;
    for window in windows {
        window.chart.nodes(&window.range, gauss, n, &mut |x, w| {
            sum += if (x - c).length() < r { w } else { 0.0 };
        });
    }
    // ∫ of the circle's height over its way through the square, from x = 0 to where y = 0
    let end = (r * r - c.y * c.y).sqrt();
    let part = |u: f64| 0.5 * (u * (r * r - u * u).sqrt() + r * r * (u / r).asin());
    let exact = part(end) - part(-c.x) + c.y * (end + c.x);
    (sum / exact - 1.0).abs()
}

#[test]
fn errors_fall_with_points_and_with_pieces() {
    assert!(error(2, 0) > 1e-6, "two points are not enough: {:e}", error(2, 0));
    for n in 2..6 {
        let (coarse, fine) = (error(n, 0), error(n + 1, 0));
        assert!(fine < 0.25 * coarse, "n = {n}: {coarse:e}, then {fine:e}");
    }
    for n in [2, 3] {
        let rate = (error(n, 4) / error(n, 5)).log2();
        assert!(rate > 2.0 * n as f64 - 0.5, "n = {n}: order {rate} instead of {}", 2 * n);
    }
}

#[test]
fn hostile_level_functions_end_and_keep_the_area() {
    let case = alone(UNIT, Vec::new(), Vec::new());
    let levels: [fn(Vec2) -> f64; 8] = [
        |_| f64::NAN,
        |_| 0.0,
        |p| (p.x - p.y).powi(2),
        |p| (p.x - 0.5).max(0.0),
        |p| 1.0 / (p.x - 0.4),
        |p| (p.x - 0.4) * 1e300,
        |p| (p.x - 0.4) * 1e-300,
        |p| if p.x > 0.3 { f64::INFINITY } else { f64::NEG_INFINITY },
    ];
    for level in levels {
        let kinks = [curve(level)];
        let geometry = SmoothnessGeometry { kinks: &kinks, common_kinks: &[0], ..case.geometry() };
        let rules = rules(geometry, Orders::for_degree(2));
        assert_near(integrate(&rules, |_, _| 1.0), 1.0, 1e-12, "area");
        assert!(n_points(&rules) < 40 * 36);
    }
}

#[test]
fn a_curve_on_borders_cuts_nothing() {
    let case = GeometryCase::new(uniform(2), Vec::new(), Vec::new());
    let rounding = curve(|p| (p.x + p.y) - p.x - 0.5);
    let kinks = [rounding, curve(|p| 3.0 * (p.x + 0.5))];
    let geometry = SmoothnessGeometry { kinks: &kinks, common_kinks: &[0, 1], ..case.geometry() };
    let orders = Orders::uniform(4);
    assert_eq!(n_points(&rules(geometry, orders)), n_points(&case.rules(orders)));
}

#[test]
fn curves_around_and_through_singular_points() {
    // λ, Γ(λ + 1/2) and Γ(λ + 1): ∫ cos^(2λ) over half a turn is √π times their quotient
    for (lambda, above, below) in [
        (0.5, 1.0, 0.5 * PI.sqrt()),
        (0.25, 1.225_416_702_465_177_6, 0.906_402_477_055_477),
        (0.1, 1.489_192_248_812_817, 0.951_350_769_866_873_2),
    ] {
        let beta = PI.sqrt() * above / below;
        let growth = if lambda == 0.5 {
            SingularGrowth::HalfPowers
        } else {
            SingularGrowth::Powers { least: lambda }
        };
        let tip = vec2(0.07, -0.03);
        let mut case = GeometryCase::new(uniform(2), Vec::new(), vec![tip]);
        case.singular[0].growth = growth;
        // relative to the tip, because a side has to be told closer to it than coordinates can
        let relative = |kink: KinkLine, inside: &dyn Fn(Vec2) -> bool| {
            let kinks = [kink];
            let geometry =
                SmoothnessGeometry { kinks: &kinks, common_kinks: &[0], ..case.geometry() };
            integrate(&rules(geometry, Orders::for_degree(2)), |a, x| {
                let p = x + (a - tip);
                if inside(p) { p.length().powf(2.0 * lambda - 2.0) } else { 0.0 }
            })
        };
        let r = 0.31;
        for kink in circles(tip, r) {
            let value = relative(kink, &|p| p.length() < r);
            let exact = PI * r.powf(2.0 * lambda) / lambda;
            assert_near(value, exact, 1e-9 * exact, &format!("around, λ = {lambda}"));
        }
        let way = vec2(0.6, 0.8) * r;
        for kink in circles(tip + way, r) {
            let value = relative(kink, &|p| p.dot(p) < 2.0 * p.dot(way));
            let exact = (2.0 * r).powf(2.0 * lambda) / (2.0 * lambda) * beta;
            let tolerance = if lambda < 0.25 { 1e-8 } else { 1e-9 };
            assert_near(value, exact, tolerance * exact, &format!("through, λ = {lambda}"));
        }
    }
}

#[test]
fn strips_are_divided_where_a_curve_bends() {
    let bend = |p: Vec2| p.y - 0.5 - 0.3 * ((p.x - 0.5) * 60.0).tanh();
    let level = curve(bend);
    let KinkLine::Curve(level) = &level else { unreachable!() };
    let square = CellChart::Quadrilateral(UNIT.corners());
    let (windows, cut) =
        cut_all(vec![ChartWindow::whole(square)], &[LocalCurve::Level(level.as_ref(), Vec2::ZERO)]);
    assert!(cut);
    let left = std::cell::Cell::new(100);
    let demand = IntegrandDemand {
        probes: &(),
        active: &[],
        anchor: Vec2::ZERO,
        face: None,
        curved: true,
        size: 1.0,
        points: 5,
        order: 6,
        left: &left,
    };
    let mut below = 0.0;
    let parts = windows.into_iter().map(SmoothPiece::Window).collect();
    refined(parts, &demand, &mut |x, w| below += if bend(x) < 0.0 { w } else { 0.0 });
    assert_near(below, 0.5, 1e-9, "area below");
}

/// One circle as two formulas whose zeros differ by rounding cuts no slivers: it takes the same
/// pieces as once, wherever it lies.
#[test]
fn curves_that_coincide_are_one() {
    let mut random = Random(11);
    for _ in 0..50 {
        let mut between = |lo: f64, hi: f64| random.between(lo, hi);
        let (center, radius) = (vec2(between(-1.0, 1.0), between(-1.0, 1.0)), between(0.3, 1.5));
        let squares =
            move |p: Vec2| (p.x - center.x).powi(2) + (p.y - center.y).powi(2) - radius * radius;
        let (sin, cos) = between(0.0, 6.0).sin_cos();
        let turned = move |p: Vec2| {
            let d = p - center;
            (cos * d.x + sin * d.y).hypot(cos * d.y - sin * d.x) - radius
        };
        let (squares, turned): (&LevelFunction, &LevelFunction) = (&squares, &turned);
        let whole = || vec![ChartWindow::whole(CellChart::Quadrilateral(UNIT.corners()))];
        let seen = |level| LocalCurve::Level(level, Vec2::ZERO);
        let (once, _) = cut_all(whole(), &[seen(squares)]);
        let (twice, _) = cut_all(whole(), &[squares, turned].map(seen));
        assert_eq!(once.len(), twice.len(), "{center:?} {radius}");
    }
}
