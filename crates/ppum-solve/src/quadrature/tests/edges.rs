//! Rules along segments.

use super::*;
use ppum::crack::{SegmentId, Side};
use ppum::edge::Edge;

fn edges(case: &GeometryCase, orders: Orders, ends: [Vec2; 2], normal: Vec2) -> Vec<EdgeRule> {
    edges_of(case.geometry(), orders, ends, normal)
}

fn edge(
    quadrature: &Quadrature<'_>,
    cell: CoveredCell<'_>,
    ends: [Vec2; 2],
    normal: Vec2,
) -> Vec<EdgeRule> {
    let edge = Edge::segment(ends);
    quadrature.edge(cell, edge, edge.chord().left().dot(normal).signum())
}

fn edges_of(
    geometry: SmoothnessGeometry<'_>,
    orders: Orders,
    ends: [Vec2; 2],
    normal: Vec2,
) -> Vec<EdgeRule> {
    let quadrature = Quadrature::new(geometry, orders);
    let cell = |c: &Rect| {
        edge(&quadrature, covered(c, &covering_patches(geometry.partition, c)), ends, normal)
    };
    geometry.partition.cell.iter().flat_map(cell).collect()
}

fn integrate_edges(rules: &[EdgeRule], f: impl Fn(Vec2, Vec2) -> f64) -> f64 {
    let of_rule = |r: &EdgeRule| -> f64 {
        r.offsets.iter().zip(&r.weights).map(|(&x, w)| w * f(r.anchor, x)).sum()
    };
    rules.iter().map(of_rule).sum()
}

#[test]
fn edges_have_exact_moments() {
    let mut random = Random(17);
    for weight in WeightFunction::ALL {
        let cracks = vec![crack(&[vec2(-1.0, 0.1), vec2(0.3, 0.4)])];
        let case = GeometryCase::new(graded(&mut random, weight), cracks, Vec::new());
        let (lo, hi) = (-0.37, 0.82);
        for (ends, normal) in [
            ([vec2(1.0, lo), vec2(1.0, hi)], vec2(1.0, 0.0)),
            ([vec2(-1.0, hi), vec2(-1.0, lo)], vec2(-1.0, 0.0)),
            ([vec2(lo, -1.0), vec2(hi, -1.0)], vec2(0.0, -1.0)),
            ([vec2(lo, 1.0), vec2(hi, 1.0)], vec2(0.0, 1.0)),
        ] {
            let rules = edges(&case, Orders::for_degree(2), ends, normal);
            for k in 0..4 {
                let sum = integrate_edges(&rules, |a, x| {
                    let p = a + x;
                    (p.x + p.y - p.dot(normal) * (normal.x + normal.y)).powi(k)
                });
                let exact = (hi.powi(k + 1) - lo.powi(k + 1)) / f64::from(k + 1);
                assert_near(sum, exact, 1e-13, &format!("{normal:?}, moment {k}"));
            }
            assert!(rules.iter().all(|r| r.normals.iter().all(|n| *n == normal)));
            assert!(rules.iter().all(|r| {
                r.offsets.iter().all(|&x| ((r.anchor + x).dot(normal) - 1.0).abs() < 1e-15)
            }));
        }
    }
}

#[test]
fn edges_split_at_mouths_and_kinks() {
    let mouth = 0.137;
    let cracks = vec![crack(&[vec2(-1.0, mouth), vec2(0.3, 0.4)])];
    let case =
        GeometryCase::new(graded(&mut Random(2), WeightFunction::Linear), cracks, Vec::new());
    let ends = [vec2(-1.0, -1.0), vec2(-1.0, 1.0)];
    let rules = edges(&case, Orders::for_degree(2), ends, vec2(-1.0, 0.0));
    let above = integrate_edges(&rules, |a, x| f64::from(u8::from(a.y + x.y > mouth)));
    assert_near(above, 1.0 - mouth, 1e-14, "length above the mouth");
    let smooth = |n: usize| -> f64 {
        edges(&case, Orders::uniform(n), ends, vec2(-1.0, 0.0))
            .iter()
            .map(|r| {
                integrate_edges(std::slice::from_ref(r), |a, x| {
                    partition_function(&case.partition, &r.patches, a + x).powi(2)
                })
            })
            .sum()
    };
    assert_near(smooth(14), smooth(28), 1e-12, "∫ φ²");
}

#[test]
fn edges_are_graded_toward_tips() {
    for gap in [0.3, 1e-2, 1e-5, 1e-10] {
        let tip = vec2(0.23, 1.0 - gap);
        let case = GeometryCase::new(uniform(1), Vec::new(), vec![tip]);
        let ends = [vec2(-1.0, 1.0), vec2(1.0, 1.0)];
        let rules = edges(&case, Orders::uniform(10), ends, vec2(0.0, 1.0));
        let sum = integrate_edges(&rules, |a, x| 1.0 / (x + (a - tip)).length());
        let gap = 1.0 - tip.y;
        let exact = (0.77 / gap).asinh() + (1.23 / gap).asinh();
        assert_near(sum, exact, 1e-12 * exact, &format!("gap {gap:e}"));
    }
}

#[test]
fn faces_of_a_crack_are_graded_toward_its_tip() {
    let (start, tip) = (vec2(-0.9, -0.31), vec2(0.23, 0.36));
    let length = (tip - start).length();
    let normal = -((tip - start).unit()).left();
    let case = GeometryCase::new(uniform(3), vec![crack(&[start, tip])], vec![tip]);
    for normal in [normal, -normal] {
        let rules = edges(&case, Orders::uniform(10), [start, tip], normal);
        let sum = integrate_edges(&rules, |a, x| 1.0 / (x + (a - tip)).length().sqrt());
        assert_near(sum, 2.0 * length.sqrt(), 1e-12, "∫ r^(−1/2)");
    }
}

#[test]
fn a_segment_along_cell_borders_is_counted_once() {
    let case = GeometryCase::new(uniform(2), Vec::new(), Vec::new());
    for normal in [vec2(0.0, 1.0), vec2(0.0, -1.0)] {
        let ends = [vec2(-0.7, 0.5), vec2(0.4, 0.5)];
        let rules = edges(&case, Orders::uniform(3), ends, normal);
        assert_near(integrate_edges(&rules, |_, _| 1.0), 1.1, 1e-14, "length");
        assert!(rules.iter().all(|r| (r.anchor.y < 0.5) == (normal.y > 0.0)));
    }
}

const TOP: [Vec2; 2] = [vec2(-1.0, 1.0), vec2(1.0, 1.0)];
const UP: Vec2 = vec2(0.0, 1.0);

#[test]
fn kinks_and_curves_cut_edges() {
    let case =
        GeometryCase::new(graded(&mut Random(2), WeightFunction::Linear), Vec::new(), Vec::new());
    let (c, r) = (vec2(0.1, 0.8), 0.52);
    let kinks = [
        KinkLine::Line([vec2(-0.321, 0.0), vec2(-0.421, 1.0)]),
        KinkLine::Segment([vec2(0.777, 0.9), vec2(0.777, 1.1)]),
        KinkLine::Segment([vec2(-0.9, -0.3), vec2(-0.9, 0.3)]),
        KinkLine::Curve(std::sync::Arc::new(move |p: Vec2| (p - c).length() - r)),
    ];
    let geometry =
        SmoothnessGeometry { kinks: &kinks, common_kinks: &[0, 1, 2, 3], ..case.geometry() };
    let rules = edges_of(geometry, Orders::for_degree(1), TOP, UP);
    let half = (r * r - 0.04_f64).sqrt();
    for at in [-0.421, 0.777, 0.1 - half, 0.1 + half] {
        let value = integrate_edges(&rules, |a, x| (a.x + x.x - at).abs());
        assert_near(value, 1.0 + at * at, 1e-14, &format!("kink at {at}"));
        let left = integrate_edges(&rules, |a, x| f64::from(u8::from(a.x + x.x < at)));
        assert_near(left, 1.0 + at, 1e-14, &format!("length left of {at}"));
    }
    let count = |rules: &[EdgeRule]| rules.iter().map(|r| r.offsets.len()).sum::<usize>();
    let plain = edges(&case, Orders::for_degree(1), TOP, UP);
    let more = (count(&rules) - count(&plain)) as f64 / 5.0;
    assert!(more <= 4.0, "four more pieces, not {more}");
}

/// Of several functions at one point, whose exponents are those that samples tell.
#[test]
fn edges_through_singular_points_of_any_exponent() {
    let (start, tip) = (vec2(-0.875, -0.5), vec2(0.25, 0.5));
    let length = (tip - start).length();
    let normal = (tip - start).unit().left();
    for (lambda, tolerance) in
        [(0.1, 1e-8), (0.25, 1e-10), (0.5444837, 1e-10), (2.0 / 3.0, 1e-10), (1.7, 1e-10)]
    {
        let mut case =
            GeometryCase::new(uniform(2), Vec::new(), vec![tip, tip + vec2(1e-12, 0.0), tip]);
        for (singular, above) in case.singular.iter_mut().zip([0.0, 1e-10, 2e-10]) {
            singular.growth = SingularGrowth::Powers { least: lambda + above };
        }
        for p in [1, 3] {
            let rules = edges(&case, Orders::for_degree(p), [start, tip], normal);
            let powers = [lambda - 1.0, 2.0 * lambda - 1.0, lambda, 2.0 * lambda - 2.0];
            // gradients squared can be integrated along a line for λ > 1/2 only; to 1e-8 near 1/2,
            // where 10⁻¹⁶ of the length still holds 3 % of the integral, from 0.6 on
            for q in powers.into_iter().take(if lambda > 0.6 { 4 } else { 3 }) {
                let value = integrate_edges(&rules, |a, x| (x + (a - tip)).length().powf(q));
                let exact = length.powf(q + 1.0) / (q + 1.0);
                let what = format!("λ = {lambda}, r^{q}, p = {p}");
                assert_near(value, exact, tolerance * exact, &what);
            }
        }
    }
}

#[test]
fn edges_resolve_layers() {
    for eps in [1e-1, 1e-3, 1e-6] {
        let probes = vec![move |a: Vec2, x: Vec2| {
            let f = (-(a.x + x.x + 1.0) / eps).exp();
            [f, -f / eps, 0.0]
        }];
        let case = GeometryCase::new(uniform(2), Vec::new(), Vec::new());
        let geometry =
            SmoothnessGeometry { probes: &probes, common_probes: &[0], ..case.geometry() };
        let rules = edges_of(geometry, Orders::for_degree(1), TOP, UP);
        let value = integrate_edges(&rules, |a, x| (-2.0 * (a.x + x.x + 1.0) / eps).exp());
        let exact = -0.5 * eps * (-4.0 / eps).exp_m1();
        assert_near(value, exact, 1e-10 * exact, &format!("ε = {eps:e}"));
        let points: usize = rules.iter().map(|r| r.offsets.len()).sum();
        assert!((points as f64) < 8.0 * (40.0 + 1.5 * (1.0 / eps).log2()), "{points} points");
        assert_eq!(rules, edges_of(geometry, Orders::for_degree(1), TOP, UP));
    }
}

#[test]
fn overlaps_along_edges_are_divided() {
    let case = GeometryCase::new(uniform(3), Vec::new(), Vec::new());
    let count = |parts: usize| {
        let orders = Orders { parts, ..Orders::for_degree(1) };
        let rules = edges(&case, orders, TOP, UP);
        assert_near(integrate_edges(&rules, |_, _| 1.0), 2.0, 1e-14, "length");
        let overlapping = |r: &&EdgeRule| {
            let x = |&i: &u32| case.partition.center[i as usize].x;
            r.patches.iter().any(|i| x(i) != x(&r.patches[0]))
        };
        let points = |r: &EdgeRule| r.offsets.len();
        let overlaps: usize = rules.iter().filter(overlapping).map(points).sum();
        (overlaps, rules.iter().map(points).sum::<usize>())
    };
    let ((one, all), (three, more)) = (count(1), count(3));
    assert_eq!((three, more), (3 * one, all + 2 * one));
}

/// ∫ over both faces of segments in general position, along lines of cells and tilted against them
/// by 1e-16 … 1e-8: none of it is lost, none counts twice.
#[test]
fn faces_keep_their_resultants() {
    let mut random = Random(11);
    for round in 0..60 {
        let from = vec2(random.between(-0.9, -0.1), 0.5 * f64::from(round % 2));
        let tilt = random.between(-1.0, 1.0) * 10f64.powi(-8 - round % 9);
        let mut ends = [from, from + vec2(1.0, tilt) * random.between(0.3, 0.9)];
        if round % 3 == 0 {
            ends = [point(&mut random, 0.9), point(&mut random, 0.9)];
        }
        if round % 5 == 0 {
            ends = ends.map(|p| vec2(p.y, p.x));
        }
        let partition =
            if round % 2 == 0 { uniform(3) } else { graded(&mut random, WeightFunction::Linear) };
        let case = GeometryCase::new(partition, vec![crack(&ends)], vec![ends[0]]);
        let (geometry, quadrature) = (case.geometry(), case.quadrature(Orders::for_degree(2)));
        for side in [Side::Above, Side::Below] {
            let face = CrackFace { segment: SegmentId { crack: 0, segment: 0 }, side };
            let of = |c: &Rect| {
                quadrature.face(covered(c, &covering_patches(geometry.partition, c)), face)
            };
            let rules: Vec<_> = geometry.partition.cell.iter().flat_map(of).collect();
            let (mut sum, mut moment) = (0.0, Vec2::ZERO);
            for rule in &rules {
                assert_eq!(rule.face, Some(face));
                for (o, w) in rule.offsets.iter().zip(&rule.weights) {
                    sum += w;
                    moment = moment + (rule.anchor + *o) * *w;
                }
            }
            let length = (ends[1] - ends[0]).length();
            // each cell may drop 1e-12 of its size
            assert_near(sum, length, 1e-11, &format!("round {round}, length of {ends:?}"));
            let middle = (ends[0] + ends[1]) * 0.5;
            assert!((moment - middle * length).length() < 1e-11, "round {round}: {ends:?}");
        }
    }
}

/// Segments that end beside lines of the cover by rounding or more: the own patch of a cell is
/// among those of each rule in it.
#[test]
fn shortest_parts_have_the_patches_of_their_cells() {
    let mut random = Random(31);
    for _ in 0..300 {
        let case =
            GeometryCase::new(graded(&mut random, WeightFunction::Linear), Vec::new(), Vec::new());
        let BoxPartition { cell: cells, .. } = &case.partition;
        let mut beside = || {
            let off = random.between(-1.0, 1.0) * 10f64.powf(-random.between(8.0, 15.0));
            let cell = cells[random.below(cells.len())];
            let inside = random.point(&cell);
            vec2(cell.min.x + off, if random.below(2) == 0 { inside.y } else { 0.137 })
        };
        let ends = [beside(), beside()];
        let quadrature = case.quadrature(Orders::for_degree(1));
        let normal = (ends[1] - ends[0]).unit().left();
        for (k, cell) in (0..).zip(cells) {
            let covering_patches = covering_patches(&case.partition, cell);
            for rule in edge(&quadrature, covered(cell, &covering_patches), ends, normal) {
                assert!(rule.patches.contains(&k), "{ends:?} in {cell:?}: {:?}", rule.patches);
            }
        }
    }
}
