//! Rules along segments.

use super::*;

fn edges(case: &Case, orders: Orders, ends: [Vec2; 2], normal: Vec2) -> Vec<EdgeRule> {
    let quadrature = case.quadrature(orders);
    let cell = |c: &Rect| quadrature.edge(c, &coverers(&case.partition, c), ends, normal);
    case.partition.cell.iter().flat_map(cell).collect()
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
        let case = Case::new(graded(&mut random, weight), cracks, Vec::new());
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
            assert!(rules.iter().all(|r| r.normal == normal));
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
    let case = Case::new(graded(&mut Random(2), WeightFunction::Linear), cracks, Vec::new());
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
        let case = Case::new(uniform(1), Vec::new(), vec![tip]);
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
    let case = Case::new(uniform(3), vec![crack(&[start, tip])], vec![tip]);
    for normal in [normal, -normal] {
        let rules = edges(&case, Orders::uniform(10), [start, tip], normal);
        let sum = integrate_edges(&rules, |a, x| 1.0 / (x + (a - tip)).length().sqrt());
        assert_near(sum, 2.0 * length.sqrt(), 1e-12, "∫ r^(−1/2)");
    }
}

#[test]
fn a_segment_along_cell_borders_is_counted_once() {
    let case = Case::new(uniform(2), Vec::new(), Vec::new());
    for normal in [vec2(0.0, 1.0), vec2(0.0, -1.0)] {
        let ends = [vec2(-0.7, 0.5), vec2(0.4, 0.5)];
        let rules = edges(&case, Orders::uniform(3), ends, normal);
        assert_near(integrate_edges(&rules, |_, _| 1.0), 1.1, 1e-14, "length");
        assert!(rules.iter().all(|r| (r.anchor.y < 0.5) == (normal.y > 0.0)));
    }
}
