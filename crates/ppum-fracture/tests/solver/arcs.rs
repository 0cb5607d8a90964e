//! Cracks along arcs in exact plane fields (Muskhelishvili 1953): K, T and J, their rates and their
//! estimated errors.

use crate::studies::exact_fields::{MATERIAL, SQUARE, discretization, held};
use crate::studies::support::solved;
use ppum::crack::{Crack, End};
use ppum::dataset::{Dataset, TipIntensity};
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::{BaseCells, BoundaryPart, Discretization, DomainEdge, ProblemData};
use ppum_testkit::exact::{ArcCrack, CrackInPlane, ExactField as _};

/// Stresses far away, in the frame of the arc's middle.
const REMOTE: [f64; 3] = [0.7, 1.0, 0.6];

/// An arc of a sweep in degrees and of the length 0.9, with its middle near the origin.
fn arc(sweep: f64) -> ArcCrack {
    let half = 0.5 * sweep.to_radians();
    let radius = 0.45 / half;
    let direction = vec2(0.28, 0.96);
    let center = vec2(0.02, -0.03) - direction * (radius * 0.5 * (1.0 + half.cos()));
    ArcCrack::new(MATERIAL, center, radius, direction, half).with_remote(REMOTE)
}

/// The body with some edges as its crack, and the exact field on its boundary.
fn problem(field: &ArcCrack, edges: &[Edge], set: Discretization) -> ProblemData {
    let plate = ProblemData::elasticity(SQUARE, MATERIAL, set);
    held(plate.with_crack_along(Crack::along(edges)), field.formulas())
}

fn refined(level: u32, order: usize) -> Discretization {
    let mut set = discretization(BaseCells::Level(level), order);
    set.refine = true;
    set
}

fn solution(field: &ArcCrack, set: Discretization) -> Dataset {
    solved(&problem(field, &[field.edge()], set))
}

/// Errors of K, T and J at one tip, relative to |K|, |K| over the root of a length 0.1, and J of K.
fn errors_at(found: &TipIntensity, [k1, k2]: [f64; 2], t: f64) -> [f64; 3] {
    let size = k1.hypot(k2);
    let of_k = (found.k1 - k1).hypot(found.k2 - k2) / size;
    let of_t = (found.t_stress.expect("T") - t).abs() * 0.1f64.sqrt() / size;
    let released = size * size / MATERIAL.effective_young();
    [of_k, of_t, (found.j.expect("J") / released - 1.0).abs()]
}

/// The largest errors of the tips.
fn errors(dataset: &Dataset, field: &ArcCrack) -> [f64; 3] {
    let tips = &dataset.steps[0].intensities;
    assert_eq!(tips.len(), 2, "{:?}", dataset.steps[0].warnings);
    let all = tips.iter().map(|found| {
        errors_at(found, field.intensities(found.tip.end), field.t_stress(found.tip.end))
    });
    all.fold([0.0; 3], |most, own| [0, 1, 2].map(|k| f64::max(most[k], own[k])))
}

const SWEEPS: [f64; 5] = [15.0, 45.0, 90.0, 130.0, 170.0];

/// Under uniform stress far away, by the exact field on the boundary.
#[test]
fn arcs_in_an_exact_field() {
    for sweep in SWEEPS {
        let [k, t, j] = errors(&solution(&arc(sweep), refined(4, 3)), &arc(sweep));
        println!("{sweep} degrees: K {k:.1e}, T {t:.1e}, J {j:.1e}");
        assert!(k < 5e-6 && t < 5e-5 && j < 2e-5, "{sweep}: {k} {t} {j}");
    }
}

#[test]
#[ignore = "slow: order 6"]
fn arcs_of_order_six() {
    for sweep in SWEEPS {
        let [k, t, j] = errors(&solution(&arc(sweep), refined(4, 6)), &arc(sweep));
        println!("{sweep} degrees, order 6: K {k:.1e}, T {t:.1e}, J {j:.1e}");
        assert!(k < 1e-9 && t < 1e-8 && j < 5e-9, "{sweep}: {k} {t} {j}");
    }
}

/// A pressure on both faces.
#[test]
fn pressed_arcs() {
    for sweep in [40.0, 140.0] {
        let field = arc(sweep).with_pressure(0.8);
        let order = if sweep < 100.0 { 3 } else { 4 };
        let body = problem(&field, &[field.edge()], refined(4, order))
            .with_pressure(BoundaryPart::Crack { crack: 0, face: None }, 0.8);
        let [k, t, j] = errors(&solved(&body), &field);
        println!("{sweep} degrees under pressure, order {order}: K {k:.1e}, T {t:.1e}, J {j:.1e}");
        assert!(k < 1e-6 && t < 2e-6 && j < 2e-6, "{sweep}: {k} {t} {j}");
    }
}

/// The straight crack of the same length in the same place, under the same stresses.
fn straight(set: Discretization) -> [f64; 3] {
    let direction = -vec2(0.28, 0.96).left();
    let [xx, yy, xy] = REMOTE;
    let field = CrackInPlane::biaxial(MATERIAL, vec2(0.02, -0.03), direction, 0.45, 1.0)
        .with_remote([yy, xx, -xy]);
    let ends = [-0.45, 0.45].map(|s| (vec2(0.02, -0.03) + direction * s).into());
    let plate = ProblemData::elasticity(SQUARE, MATERIAL, set).with_crack(&ends);
    let dataset = solved(&held(plate, field.formulas()));
    let t = yy - xx;
    let all = dataset.steps[0].intensities.iter().map(|f| errors_at(f, field.intensities(), t));
    all.fold([0.0; 3], |most, own| [0, 1, 2].map(|k| f64::max(most[k], own[k])))
}

/// Asserts that errors of K and T on arcs fall with cells as fast as those of a straight crack.
fn assert_rates(orders: &[usize]) {
    for &order in orders {
        let set = |level| {
            let mut set = discretization(BaseCells::Level(level), order);
            set.enrichment_radius = Some(0.2);
            set
        };
        // the mean of two halvings: places in cells differ, and cancel errors by chance
        let rates = |what: &str, errors: &dyn Fn(u32) -> [f64; 3]| {
            let [coarse, fine] = [3, 5].map(errors);
            // rules leave K of arcs 3e-10
            let rates = [0, 1].map(|k| 0.5 * (coarse[k] / fine[k].max(1e-9)).log2());
            println!("order {order}, {what}: {coarse:?} {fine:?}, rates {rates:?}");
            rates
        };
        let straight = rates("straight", &|level| straight(set(level)));
        for sweep in [30.0, 90.0] {
            let own = rates(&format!("{sweep} degrees"), &|level| {
                errors(&solution(&arc(sweep), set(level)), &arc(sweep))
            });
            assert!(own[0] > 0.75 * straight[0], "{order} {sweep}: {own:?} {straight:?}");
            assert!(own[1] > 0.75 * straight[1], "{order} {sweep}: {own:?} {straight:?}");
        }
    }
}

#[test]
fn rates_are_those_of_straight_cracks() {
    assert_rates(&[2, 3]);
}

#[test]
#[ignore = "slow: order 6"]
fn rates_of_high_orders_are_those_of_straight_cracks() {
    assert_rates(&[4, 5, 6]);
}

/// Estimates are 1 to 30 times the error.
#[test]
fn errors_are_estimated() {
    for (sweep, order) in [(30.0, 2), (90.0, 3), (170.0, 2)] {
        let field = arc(sweep);
        for found in &solution(&field, refined(3, order)).steps[0].intensities {
            let [k1, k2] = field.intensities(found.tip.end);
            let off = (found.k1 - k1).hypot(found.k2 - k2);
            let told = found.error.expect("an estimate");
            println!("{sweep} degrees, order {order}: {off:.1e}, told {told:.1e}");
            assert!(off < told && told < 30.0 * off, "{sweep}: {off} {told}");
        }
    }
}

/// All numbers of both tips, the first end first.
fn numbers(dataset: &Dataset) -> Vec<[f64; 4]> {
    let mut tips = dataset.steps[0].intensities.clone();
    tips.sort_by_key(|found| found.tip.end);
    let of = |found: &TipIntensity| {
        [found.k1, found.k2, found.t_stress.unwrap_or(0.0), found.j.unwrap_or(0.0)]
    };
    tips.iter().map(of).collect()
}

/// Asserts that numbers differ by no more than a bound.
fn assert_same((what, bound): (&str, f64), found: &[[f64; 4]], expected: &[[f64; 4]]) {
    for (a, b) in found.iter().zip(expected) {
        let size = b[0].hypot(b[1]);
        let off = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size;
        println!("{what}: {off:.1e}");
        assert!(off < bound, "{what}: {a:?} {b:?}");
    }
}

/// The same arc in the opposite direction, in ten parts, turned by a right angle, and ten times as
/// large. Cells are cut along other axes in a turned plate, so rules for the integrals of K differ.
#[test]
fn one_arc_in_many_ways() {
    let field = arc(100.0);
    let (edge, set) = (field.edge(), || discretization(BaseCells::Level(3), 2));
    let plain = numbers(&solved(&problem(&field, &[edge], set())));
    let mut reversed = numbers(&solved(&problem(&field, &[edge.reversed()], set())));
    reversed.reverse();
    assert_same(("reversed", 1e-13), &reversed, &plain);
    let tenth = |k: u32| edge.part([f64::from(k) / 10.0, f64::from(k + 1) / 10.0]);
    let mut parts: Vec<Edge> = (0..10).map(tenth).collect();
    for k in 1..10 {
        parts[k].from = parts[k - 1].to;
    }
    let in_parts = numbers(&solved(&problem(&field, &parts, set())));
    assert_same(("in ten parts", 1e-9), &in_parts, &plain);
    let turned = |p: Vec2| p.left();
    let moved = |place: &dyn Fn(Vec2) -> Vec2, size: f64| {
        let Edge { from, to, bulge } = edge;
        let bounds = Rect::around(Vec2::ZERO, vec2(size, size));
        let crack = Crack::along(&[Edge { from: place(from), to: place(to), bulge }]);
        ProblemData::elasticity(bounds, MATERIAL, set()).with_crack_along(crack)
    };
    let pulled = |body: ProblemData, [x, y]: [f64; 2]| {
        numbers(&solved(&crate::support::stressed(body, [x, y, 0.0], &DomainEdge::ALL)))
    };
    let plain = pulled(moved(&|p| p, 1.0), [0.4, 1.0]);
    assert_same(("turned", 2e-9), &pulled(moved(&turned, 1.0), [1.0, 0.4]), &plain);
    let mut large = pulled(moved(&|p| p * 10.0, 10.0), [0.4, 1.0]);
    for [k1, k2, _, j] in &mut large {
        (*k1, *k2, *j) = (*k1 / 10f64.sqrt(), *k2 / 10f64.sqrt(), *j / 10.0);
    }
    assert_same(("ten times as large", 1e-10), &large, &plain);
}

/// Chords of the arc become it: the error of T falls like the root of their length, that of K like
/// the length.
#[test]
#[ignore = "slow: up to 64 segments"]
fn arcs_are_the_limit_of_their_chords() {
    let field = arc(60.0);
    let of = |count: u32| {
        let at = |k: u32| field.edge().at(f64::from(k) / f64::from(count));
        let edges: Vec<Edge> = (0..count).map(|k| Edge::segment([at(k), at(k + 1)])).collect();
        errors(&solved(&problem(&field, &edges, refined(3, 3))), &field)
    };
    let all = [4, 16, 64].map(of);
    println!("{all:?}");
    assert!(all.windows(2).all(|pair| pair[1][0] < 0.27 * pair[0][0]), "{all:?}");
    assert!(all.windows(2).all(|pair| pair[1][1] < 0.7 * pair[0][1]), "{all:?}");
}

/// Discs of any size that is allowed give the same, and the largest one ends before the centre.
#[test]
fn discs_on_arcs() {
    use ppum::crack::TipId;
    use ppum::progress::unwatched;
    use ppum_fracture::intensity::{TipObstacle, clearance, on_circle};
    let field = arc(150.0);
    let dataset = solution(&field, refined(4, 3));
    let tip = TipId { crack: 0, end: End::Last };
    let clear = clearance(&dataset, 0, tip).expect("a tip");
    assert_eq!(clear.end, TipObstacle::Center);
    for part in [0.2, 0.5, 0.8, 1.0] {
        let radius = part * clear.radius;
        let found = on_circle(&dataset, 0, tip, radius, None, unwatched()).expect("room");
        let [k, t, j] = errors_at(&found, field.intensities(End::Last), field.t_stress(End::Last));
        println!("radius {radius:.2}: K {k:.1e}, T {t:.1e}, J {j:.1e}");
        assert!(k < 1e-5 && t < 5e-6 && j < 1e-6, "{radius}: {k} {t} {j}");
    }
}
