//! The field jumps on its cracks and nowhere else.

use crate::support::{
    ORDERS, compiled, distance_to_cracks, entries, evaluate, inside, meets_crack, patch_size,
};
use ppum::crack::{Crack, CrackEnd, Side};
use ppum::field::Field;
use ppum::segment::polyline_distance;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::{Coefficients, Recipe, crack};

/// Length of a step over a line.
const STEP: f64 = 1e-12;

/// Steps over all lines on which something could go wrong: the lines of all segments, extended; the
/// lines that halve the angle at a kink, both ways; borders and centre lines of patches;
/// and anything.
fn steps(field: &Field<'_>, random: &mut Random) -> Vec<(Vec2, Vec2)> {
    let mut steps = Vec::new();
    let mut over = |p: Vec2, tangent: Vec2| {
        let half = tangent.left() * (0.5 * STEP);
        steps.push((p - half, p + half));
    };
    for crack in &field.step.cracks {
        for s in crack.points.windows(2) {
            let tangent = (s[1] - s[0]).unit();
            for _ in 0..300 {
                over(s[0] + tangent * random.between(-1.0, 1.0), tangent);
            }
        }
        for s in crack.points.windows(3) {
            let bisector = ((s[0] - s[1]).unit() + (s[2] - s[1]).unit()).unit();
            for _ in 0..400 {
                let aside = bisector.left() * 10f64.powf(random.between(-16.0, -2.0));
                over(s[1] + bisector * random.between(-0.5, 0.5) + aside, bisector);
            }
        }
        for tip in crack.tips().map(|end| crack.end_point(end)) {
            for _ in 0..300 {
                let r = 10f64.powf(random.between(-3.0, -0.5));
                over(tip + random.direction() * r, random.direction());
            }
        }
    }
    for i in 0..field.step.partition.len() {
        let support = field.step.partition.boxes().support(i);
        for x in [support.min.x, support.center().x, support.max.x] {
            over(vec2(x, random.point(&support).y), vec2(0.0, 1.0));
        }
        for y in [support.min.y, support.center().y, support.max.y] {
            over(vec2(random.point(&support).x, y), vec2(1.0, 0.0));
        }
    }
    steps.retain(|(p, q)| field.domain.contains(*p) && field.domain.contains(*q));
    steps
}

/// Random coefficients, so that only structure keeps the field continuous. Gradients are continuous
/// as well with quadratic and cubic weights, Hessians with cubic ones.
#[test]
fn continuous_off_the_cracks() {
    for seed in 0..12 {
        let weight = WeightFunction::ALL[seed as usize % 3].clone();
        let smoothness = [1, 3, 6][seed as usize % 3];
        let recipe = if seed < 9 { Recipe::random(seed) } else { meeting(seed) };
        let dataset = Recipe { weight, overlap: 1.4, ..recipe }.dataset();
        let field = compiled(&dataset);
        let (mut local, mut random) = (field.at(Vec2::ZERO), Random(seed));
        let mut off = 0;
        for (p, q) in steps(&field, &mut random) {
            if meets_crack(field.step, p, q, 1e-3) {
                continue;
            }
            off += 1;
            let size = patch_size(field.step, p);
            let a = inside::<2>(&mut local, p, Side::Above);
            let b = inside::<2>(&mut local, q, Side::Above);
            for (a, b) in a.iter().zip(&b) {
                for (k, (a, b)) in
                    entries(a).into_iter().zip(entries(b)).enumerate().take(smoothness)
                {
                    let tolerance = 1e-5 * size.powi(-ORDERS[k]);
                    assert!(
                        (a - b).abs() < tolerance,
                        "entry {k} jumps from {a} to {b} at {p:?}, seed {seed}"
                    );
                }
            }
        }
        assert!(off > 2000, "{off} steps");
    }
}

/// Cracks that meet; patches have nothing to do with each other.
fn meeting(seed: u64) -> Recipe {
    Recipe { coefficients: Coefficients::Random, seed, ..Recipe::meeting() }
}

/// Steps over cracks of every kind see a jump.
#[test]
fn jumps_on_the_cracks() {
    for seed in 0..8 {
        let recipe = if seed < 6 { Recipe::random(seed) } else { meeting(seed) };
        let dataset = recipe.dataset();
        let field = compiled(&dataset);
        let (mut local, mut random) = (field.at(Vec2::ZERO), Random(seed));
        let (mut over, mut seen) = (0, 0);
        for crack in &field.step.cracks {
            for s in crack.points.windows(2) {
                for _ in 0..100 {
                    let normal = (s[1] - s[0]).unit().left() * 1e-9;
                    let p = s[0] + (s[1] - s[0]) * random.between(0.02, 0.98);
                    let Some(above) = evaluate::<0>(&mut local, p + normal, Side::Below) else {
                        continue;
                    };
                    let below = inside::<0>(&mut local, p - normal, Side::Above);
                    over += 1;
                    seen += usize::from(
                        above.iter().zip(&below).any(|(a, b)| (a.v - b.v).abs() > 0.01),
                    );
                }
            }
        }
        assert!(over > 500 && seen as f64 > 0.97 * f64::from(over), "{seen} of {over}");
    }
}

/// Cracks whose points are exact in f64: level, upright, diagonal, kinked, from the edge.
fn exact_cracks() -> Vec<Crack> {
    vec![
        crack(&[[-0.75, -0.5], [-0.25, -0.5]], [CrackEnd::Tip; 2]),
        crack(&[[0.5, -0.75], [0.5, -0.25]], [CrackEnd::Tip; 2]),
        crack(&[[-0.5, 0.75], [-0.25, 0.5], [0.25, 0.5], [0.5, 0.75]], [CrackEnd::Tip; 2]),
        crack(&[[1.0, 0.125], [0.75, 0.125], [0.5, 0.25]], [CrackEnd::Mouth, CrackEnd::Tip]),
    ]
}

/// On the crack the caller's side decides: the value and gradient are the limits from that side.
#[test]
fn the_chosen_side_is_the_limit_from_there() {
    let recipe = Recipe {
        domain: Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0)),
        cells: [1, 1],
        level: 3,
        cracks: exact_cracks(),
        coefficients: Coefficients::Random,
        weight: WeightFunction::Cubic,
        ..Recipe::default()
    };
    let dataset = recipe.dataset();
    let field = compiled(&dataset);
    let mut random = Random(1);
    for s in field.step.cracks.iter().flat_map(|crack| crack.points.windows(2)) {
        let normal = (s[1] - s[0]).unit().left() * 1e-10;
        for k in 1..32 {
            // a multiple of 2⁻¹⁰ of the segment, exactly on it
            let share = (f64::from(k) / 32.0 * 1024.0).round() / 1024.0;
            let p = s[0] + (s[1] - s[0]) * share;
            let anchor = if k % 2 == 0 {
                p
            } else {
                random.point(&Rect::new(s[0].min(s[1]), s[0].max(s[1])))
            };
            let anchor = if exact(anchor, p) { anchor } else { s[0] };
            let mut local = field.at(anchor);
            let mut at = |offset: Vec2, side| inside::<1>(&mut local, offset, side);
            let (above, below) = (at(p - anchor, Side::Above), at(p - anchor, Side::Below));
            let (over, under) =
                (at(p - anchor + normal, Side::Above), at(p - anchor - normal, Side::Above));
            for (face, limit) in [(&above, &over), (&below, &under)] {
                for (a, b) in face.iter().zip(limit) {
                    assert!((a.v - b.v).abs() < 1e-6, "{p:?}: {} against the limit {}", a.v, b.v);
                    assert!(
                        (a.x - b.x).abs() + (a.y - b.y).abs() < 1e-4 * (1.0 + a.x.abs()),
                        "{p:?}"
                    );
                }
            }
            assert!(above.iter().zip(&below).any(|(a, b)| (a.v - b.v).abs() > 1e-3), "{p:?}");
        }
    }
}

/// True if p lies on the same level, upright or exact diagonal as the anchor, so that p − anchor
/// is exact.
fn exact(anchor: Vec2, p: Vec2) -> bool {
    let d = p - anchor;
    anchor + d == p && (d.x == 0.0 || d.y == 0.0)
}

/// Off the crack the side is ignored.
#[test]
fn the_side_matters_on_the_crack_only() {
    let dataset = Recipe::random(1).dataset();
    let field = compiled(&dataset);
    let (mut local, mut random) = (field.at(Vec2::ZERO), Random(1));
    for _ in 0..500 {
        let p = random.point(&dataset.domain.bounds);
        assert!(distance_to_cracks(field.step, p) > 1e-9);
        let a = evaluate::<2>(&mut local, p, Side::Above);
        assert_eq!(a, evaluate::<2>(&mut local, p, Side::Below));
    }
}

/// Walks round every tip: one jump a round, where the walk crosses the crack.
#[test]
fn one_jump_on_the_way_round_a_tip() {
    let recipe =
        Recipe { coefficients: Coefficients::Taylor, extra: Vec::new(), ..Recipe::random(4) };
    let dataset = recipe.dataset();
    let field = compiled(&dataset);
    for tip in recipe.tips() {
        let crack = &recipe.cracks[tip.crack as usize];
        let center = crack.end_point(tip.end);
        let mut local = field.at(center);
        for radius in [1e-12, 1e-8, 1e-4, 1e-2] {
            let n = 4000;
            let offset = |k: i32| {
                let (s, c) = (f64::from(k) / f64::from(n) * std::f64::consts::TAU).sin_cos();
                vec2(c, s) * radius
            };
            let mut u = |k: i32| inside::<0>(&mut local, offset(k), Side::Above)[0].v;
            let jumps: Vec<_> =
                (0..n).filter(|&k| (u(k + 1) - u(k)).abs() > 0.03 * radius.sqrt()).collect();
            assert_eq!(jumps.len(), 1, "radius {radius} of {tip:?}");
            let back = -crack.growth_direction(tip.end) * radius;
            assert!(
                (offset(jumps[0]) - back).length() < 2e-3 * radius,
                "radius {radius} of {tip:?}"
            );
            assert!(
                polyline_distance(&crack.points, center + offset(jumps[0])) < 2e-3 * radius + 1e-16
            );
        }
    }
}
