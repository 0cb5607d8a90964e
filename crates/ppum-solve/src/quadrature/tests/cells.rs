//! Areas, moments, sides and smoothness on cells.

use super::*;

/// ∫ x^i y^j over \[−1, 1\]².
fn square_moment(i: i32, j: i32) -> f64 {
    let one = |k: i32| if k % 2 == 0 { 2.0 / f64::from(k + 1) } else { 0.0 };
    one(i) * one(j)
}

#[test]
fn moments_are_exact_on_graded_covers_with_cracks() {
    let mut random = Random(7);
    for trial in 0..30 {
        let weight = WeightFunction::ALL[trial % 3].clone();
        let cover = graded(&mut random, weight);
        let points: Vec<Vec2> = (0..2 + trial % 3).map(|_| point(&mut random, 0.9)).collect();
        let cracks =
            vec![crack(&points), crack(&[point(&mut random, 0.9), point(&mut random, 0.9)])];
        let tips = cracks.iter().flat_map(|c| [c.points[0], c.points[c.points.len() - 1]]);
        let singular = if trial % 2 == 0 { tips.collect() } else { Vec::new() };
        let rules = GeometryCase::new(cover, cracks, singular).rules(Orders::for_degree(2));
        for (i, j) in [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (2, 2), (4, 0), (0, 3)] {
            let sum = integrate(&rules, |a, x| (a.x + x.x).powi(i) * (a.y + x.y).powi(j));
            assert_near(sum, square_moment(i, j), 1e-13, &format!("trial {trial}, x^{i} y^{j}"));
        }
    }
}

#[test]
fn patches_are_those_whose_supports_hold_the_points() {
    let mut random = Random(3);
    for weight in WeightFunction::ALL {
        let case = GeometryCase::new(graded(&mut random, weight), Vec::new(), Vec::new());
        for rule in case.rules(Orders::uniform(3)) {
            for &offset in &rule.offsets {
                let p = rule.anchor + offset;
                let holds = |&i: &u32| {
                    let s = case.partition.support(i as usize);
                    s.min.x < p.x && p.x < s.max.x && s.min.y < p.y && p.y < s.max.y
                };
                let expected: Vec<u32> = (0..case.partition.len() as u32).filter(holds).collect();
                assert_eq!(rule.patches, expected);
            }
        }
    }
}

#[test]
fn partition_functions_are_smooth_on_pieces() {
    for weight in WeightFunction::ALL {
        let case =
            GeometryCase::new(graded(&mut Random(11), weight.clone()), Vec::new(), Vec::new());
        let energy = |n: usize| -> f64 {
            let of_rule = |r: &CellRule| {
                let square =
                    |a: Vec2, x| partition_function(&case.partition, &r.patches, a + x).powi(2);
                integrate(std::slice::from_ref(r), square)
            };
            case.rules(Orders::uniform(n)).iter().map(of_rule).sum()
        };
        let fine = energy(30);
        assert_near(energy(16), fine, 1e-12 * fine, weight.name());
        assert!((energy(2) - fine).abs() > 1e-6, "two points cannot be exact");
    }
}

#[test]
fn uniform_covers_have_nine_rectangles_in_a_cell_and_no_kinks() {
    let case = GeometryCase::new(uniform(3), Vec::new(), Vec::new());
    let inner = case.partition.cell.iter().position(|c| c.min == vec2(-0.25, -0.25)).expect("cell");
    let cell = case.partition.cell[inner];
    let rules = case
        .quadrature(Orders::for_degree(2))
        .cell(covered(&cell, &covering_patches(&case.partition, &cell)));
    assert_eq!(rules.len(), 9);
    let mut counts: Vec<_> = rules.iter().map(|r| (r.patches.len(), r.offsets.len())).collect();
    counts.sort_unstable();
    assert_eq!(counts[0], (1, 9));
    assert_eq!(counts[1..5], [(2, 36); 4]);
    assert_eq!(counts[5..], [(4, 36); 4]);
}

#[test]
fn cracks_beside_edges_and_through_corners_separate_exactly() {
    let cell = Rect::new(vec2(0.1, 0.2), vec2(0.4, 0.5));
    let heights = [0.2, 0.5, 0.1 + 0.2, 0.2 + 3e-7, 0.5 - 3e-7, 0.2 + 3e-13, 0.2 + 1e-16, 0.37];
    for y in heights {
        for (x0, x1) in [(-5.0, 5.0), (0.1, 0.4), (-1.0, 0.25), (0.4, 0.6)] {
            let case = alone(cell, vec![crack(&[vec2(x0, y), vec2(x1, y)])], Vec::new());
            let below = integrate(&case.rules(Orders::uniform(3)), |a, p| {
                f64::from(u8::from(a.y + p.y < y))
            });
            assert_near(below, 0.3 * (y.clamp(0.2, 0.5) - 0.2), 1e-16, &format!("crack at {y}"));
        }
    }
    let diagonal = alone(cell, vec![crack(&[cell.min, cell.max])], Vec::new());
    let above = integrate(&diagonal.rules(Orders::uniform(3)), |a, p| {
        f64::from(u8::from((cell.max - cell.min).cross(a + p - cell.min) > 0.0))
    });
    assert_near(above, 0.045, 1e-16, "diagonal crack");
}

#[test]
fn difficult_positions_of_tips_keep_the_area() {
    let cell = Rect::new(vec2(0.1, 0.2), vec2(0.4, 0.5));
    for gap in [0.0, 1e-16, 1e-14, 1e-12, 1e-9, 1e-6, 1e-3, 0.1] {
        for sign in [-1.0, 1.0] {
            for base in [vec2(0.1, 0.2), vec2(0.25, 0.2), vec2(0.4, 0.5), vec2(0.4, 0.3)] {
                for shift in [vec2(gap, 0.0), vec2(0.0, gap), vec2(gap, -gap)] {
                    let tip = base + shift * sign;
                    for direction in [vec2(1.0, 0.0), vec2(0.0, 1.0), vec2(-1.0, 1.0)] {
                        let c = crack(&[tip - direction, tip]);
                        let case = alone(cell, vec![c], vec![tip]);
                        let area = integrate(&case.rules(Orders::uniform(8)), |_, _| 1.0);
                        assert_near(area, 0.09, 1e-14, &format!("tip {tip:?}"));
                    }
                }
            }
        }
    }
}

#[test]
fn cracks_on_or_beside_the_lines_of_the_cover_keep_the_area() {
    let mut random = Random(13);
    let lines = [-1.0, -0.5, 0.0, 0.325, 0.25, 0.125, -0.175, 0.1, 1.0];
    let gaps = [0.0, 1e-17, -1e-16, 1e-15, -1e-13, 1e-12, -1e-9, 1e-6, -1e-4, 0.03];
    let mut coordinate = || {
        let pick = |u: f64, n: usize| (u * n as f64) as usize;
        lines[pick(random.between(0.0, 1.0), lines.len())]
            + gaps[pick(random.between(0.0, 1.0), gaps.len())]
    };
    for trial in 0..200 {
        let points: Vec<Vec2> = (0..3).map(|_| vec2(coordinate(), coordinate())).collect();
        if points.windows(2).any(|s| (s[1] - s[0]).length() < 1e-3) {
            continue;
        }
        let tips = vec![points[0], points[2]];
        let case = GeometryCase::new(uniform(3), vec![crack(&points)], tips);
        let area = integrate(&case.rules(Orders::for_degree(1)), |_, _| 1.0);
        assert_near(area, 4.0, 4e-13, &format!("trial {trial}, crack {points:?}"));
    }
}

/// Cracks given by many points that lie on one line up to rounding, up to noise, or not: the points
/// of the rules are a few times those of the straight crack for each segment in a cell, with areas
/// and powers of r right.
#[test]
fn noise_of_vertices_is_cheap() {
    let mut random = Random(12);
    let (from, to) = (vec2(-0.573, -0.177), vec2(0.573, 0.177));
    let across = (to - from).unit().left();
    let orders = Orders::uniform(6);
    let mut case = |n: usize, noise: f64| {
        let mut beside = |k: usize| {
            let is_end = k == 0 || k == n;
            if is_end { 0.0 } else { noise * random.between(-1.0, 1.0) }
        };
        let points: Vec<Vec2> = (0..=n)
            .map(|k| from + (to - from) * (k as f64 / n as f64) + across * beside(k))
            .collect();
        let rules =
            GeometryCase::new(uniform(3), vec![crack(&points)], vec![from, to]).rules(orders);
        let area = integrate(&rules, |_, _| 1.0);
        assert_near(area, 4.0, 1e-12, &format!("{n} {noise}"));
        let near_tip = integrate(&rules, |a, x| 1.0 / ((a - to) + x).length());
        (n_points(&rules) as f64, near_tip)
    };
    let (straight, exact) = case(1, 0.0);
    for n in [2, 16, 64, 256] {
        for noise in [0.0, 1e-17, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4] {
            let (points, near_tip) = case(n, noise);
            let most = straight * (2.0 + n as f64 / 40.0);
            assert!(points < most, "{n} {noise:e}: {points} of {straight}");
            assert_near(near_tip, exact, 1e-7 * exact, &format!("{n} {noise}"));
        }
    }
}
