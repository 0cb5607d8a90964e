//! Rounding of coordinates decides nothing: K of cracks whose vertices are moved by next
//! to nothing.

use crate::studies::exact_fields::{MATERIAL, SQUARE, discretization};
use crate::studies::support::{checked, solved};
use crate::support::pulled;
use ppum::dataset::Step;
use ppum::progress::unwatched;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_fracture::growth::series;
use ppum_problem::{BaseCells, GrowthLaw, GrowthRule, ProblemData};
use ppum_testkit::random::Random;

type Lines = Vec<Vec<Vec2>>;

/// In coarse cells, which cracks refine or not.
fn plate(lines: &Lines, shift: Vec2, refine: bool) -> ProblemData {
    let domain = Rect::new(SQUARE.min + shift, SQUARE.max + shift);
    let mut set = discretization(BaseCells::Level(3), 1);
    set.refine = refine;
    let plate = pulled(ProblemData::elasticity(domain, MATERIAL, set));
    lines.iter().fold(plate, |plate, line| {
        let points: Vec<[f64; 2]> = line.iter().map(|p| (*p + shift).into()).collect();
        plate.with_crack(&points)
    })
}

fn factors(step: &Step) -> Vec<f64> {
    step.intensities.iter().flat_map(|tip| [tip.k1, tip.k2]).collect()
}

fn solved_factors(lines: &Lines, shift: Vec2, refine: bool) -> Vec<f64> {
    factors(&solved(&plate(lines, shift, refine)).steps[0])
}

/// Largest difference; infinite where factors are missing or are no numbers.
fn difference(one: &[f64], other: &[f64]) -> f64 {
    let parts = one.iter().zip(other).map(|(a, b)| (a - b).abs());
    let largest = parts.fold(0.0, |m: f64, d| if d <= m { m } else { d });
    if one.len() == other.len() && largest.is_finite() { largest } else { f64::INFINITY }
}

const AS_IT_IS: Vec2 = Vec2::ZERO;

/// Beside lines of the cover, beside tips, anywhere: none changes K.
#[test]
fn vertices_that_a_straight_crack_does_not_need() {
    let mut random = Random(41);
    for way in [vec2(1.0, 0.0), random.direction()] {
        let at = |s: f64| vec2(0.03, 0.01) + way * s;
        let whole = solved_factors(&vec![vec![at(-0.4), at(0.37)]], AS_IT_IS, false);
        for _ in 0..2 {
            let beside =
                random.pick(&[-0.28, -0.03, 0.22]) + 10f64.powf(-random.between(8.0, 16.0));
            let mut places = vec![-0.4, 0.37, beside, random.between(-0.39, 0.36), 0.3699];
            places.sort_by(f64::total_cmp);
            let found =
                solved_factors(&vec![places.iter().map(|s| at(*s)).collect()], AS_IT_IS, false);
            assert!(difference(&whole, &found) < 1e-9, "{places:?}: {whole:?} {found:?}");
        }
    }
}

/// Cracks in all manners of joints, their vertices on lines of the cover: K changes by no more than
/// its derivative says, also where the whole plate is moved far away.
#[test]
fn vertices_that_are_moved_by_rounding() {
    moved_by_rounding(false);
}

#[test]
#[ignore = "slow: 12 plates with cells refined at tips"]
fn vertices_that_are_moved_by_rounding_in_refined_cells() {
    moved_by_rounding(true);
}

fn moved_by_rounding(refine: bool) {
    let mut random = Random(42);
    let p = |x: f64, y: f64| vec2(x, y);
    let all = [
        vec![vec![p(-0.5, 0.0), p(0.5, 0.0)]],
        vec![vec![p(-0.5, -0.25), p(0.0, 0.0), p(0.25, 0.25)]],
        vec![vec![p(-0.5, 0.0), p(0.25, 0.0), p(0.25, 0.5)]],
        vec![vec![p(-0.6, 0.0), p(0.0, 0.0)], vec![p(0.0, 0.0), p(0.6, 0.0)]],
        vec![
            vec![p(-0.6, 0.0), p(-0.03, 0.0), p(0.0, 0.0)],
            vec![p(0.0, 0.0), p(0.03, 0.0), p(0.6, 0.0)],
        ],
        vec![vec![p(-0.6, 0.1), p(0.0, 0.1), p(0.6, 0.1)], vec![p(0.0, 0.1), p(0.1, 0.6)]],
        vec![vec![p(-0.6, 0.0), p(0.6, 0.0)], vec![p(0.0, 0.5), p(0.0, -0.5)]],
    ];
    // each of them, those with sharp kinks and branches in refined cells
    let some: &[usize] = if refine { &[1, 2, 5, 6] } else { &[0, 3, 4, 5] };
    for lines in some.iter().map(|&k| &all[k]) {
        let exact = solved_factors(lines, AS_IT_IS, refine);
        let size = 10f64.powf(-random.between(9.0, 13.0));
        let mut known: Vec<(Vec2, Vec2)> = Vec::new();
        let mut moved = |p: Vec2| match known.iter().find(|(from, _)| *from == p) {
            Some((_, to)) => *to,
            None => {
                known.push((p, p + random.direction() * size));
                known[known.len() - 1].1
            }
        };
        let beside: Lines =
            lines.iter().map(|line| line.iter().map(|p| moved(*p)).collect()).collect();
        let found = solved_factors(&beside, AS_IT_IS, refine);
        let change = difference(&exact, &found);
        assert!(change < 5e-9 + 100.0 * size, "{beside:?}: {change:e}");
        let far = solved_factors(lines, vec2(1024.0, -5000.0), refine);
        assert!(difference(&exact, &far) < 1e-8, "{lines:?}: {exact:?} {far:?}");
    }
}

/// Two cracks on a line that grow together are one.
#[test]
#[ignore = "slow: four steps with cells refined at tips"]
fn cracks_that_have_grown_together() {
    let p = |x: f64| vec2(x, 0.01);
    let two = vec![vec![p(-0.5), p(-0.05)], vec![p(0.05), p(0.5)]];
    let mut rule = GrowthRule::new(3);
    rule.increment = Some(0.06);
    let problem = plate(&two, AS_IT_IS, true).with_growth(rule);
    let steps = series(&checked(&problem), None, unwatched()).expect("a series").steps;
    let last = &steps[steps.len() - 1];
    assert_eq!((steps.len(), last.intensities.len()), (4, 2));
    let [left, right] = [0, 1].map(|k| last.cracks[k].points.clone());
    let whole = solved_factors(&vec![vec![left[0], right[right.len() - 1]]], AS_IT_IS, true);
    let found = factors(last);
    assert!((found[0] / whole[0] - 1.0).abs() < 0.02, "{found:?} {whole:?}");
}

/// A crack in the middle of a plate grows on as long as it is asked to, with factors at each step.
#[test]
#[ignore = "slow: five steps"]
fn cycles_of_a_straight_crack() {
    let mut rule = GrowthRule::new(4);
    (rule.increment, rule.law) = (Some(0.05), Some(GrowthLaw::paris(1e-3, 3.0)));
    let lines = vec![vec![vec2(-0.3, 0.0), vec2(0.3, 0.0)]];
    let steps =
        series(&checked(&plate(&lines, AS_IT_IS, false).with_growth(rule)), None, unwatched());
    let steps = steps.expect("a series").steps;
    let is_known = |step: &Step| factors(step).iter().all(|k| k.is_finite());
    assert!(steps.len() == 5 && steps.iter().all(is_known));
}
