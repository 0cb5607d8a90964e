//! Cracks that cross, branch, end on each other, come back to themselves.

use std::f64::consts::PI;

use ppum::progress::unwatched;
use ppum::vec2::Vec2;
use ppum_fracture::solve::{Plan, spectrum};
use ppum_problem::{
    BaseCells, Condition, Discretization, DomainEdge, PolynomialOrder, ProblemData,
};

use crate::studies::exact_fields::MATERIAL;
use crate::studies::support::{checked, record, solved, strain_energy};
use crate::support::{self, pulled, square, stressed};
use ppum_testkit::random::Random;

type Line = Vec<[f64; 2]>;

/// A name, cracks, and K_I and K_II of their tips.
type Case = (&'static str, Vec<Line>, Vec<[f64; 2]>);

/// A square plate with these cracks under tension in y, and in x too if it is pulled all round.
fn plate(half: f64, lines: &[Line], all_round: bool, level: u32, order: usize) -> ProblemData {
    let mut set = Discretization::new(BaseCells::Level(level));
    set.order = PolynomialOrder::Uniform(order);
    let problem = pulled(ProblemData::elasticity(square(half), MATERIAL, set));
    let sides: &[_] = if all_round { &[DomainEdge::Left, DomainEdge::Right] } else { &[] };
    let problem = stressed(problem, [1.0, 0.0, 0.0], sides);
    lines.iter().fold(problem, |problem, line| problem.with_crack(line))
}

/// K_I and K_II of all tips.
fn factors(problem: &ProblemData) -> Vec<[f64; 2]> {
    support::factors(&solved(problem))
}

fn polar(radius: f64, angle: f64) -> [f64; 2] {
    [radius * angle.cos(), radius * angle.sin()]
}

fn star(centre: [f64; 2], arms: usize, turn: f64) -> Vec<Line> {
    let end = |k: usize| polar(1.0, turn + 2.0 * PI * k as f64 / arms as f64);
    let arm = |k: usize| vec![centre, [centre[0] + end(k)[0], centre[1] + end(k)[1]]];
    (0..arms).map(arm).collect()
}

fn close(found: &[[f64; 2]], expected: &[[f64; 2]], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    let scale = expected.iter().flatten().fold(0.0f64, |m, k| m.max(k.abs()));
    for (found, expected) in found.iter().zip(expected) {
        let error = (found[0] - expected[0]).abs().max((found[1] - expected[1]).abs());
        assert!(error <= tolerance * scale, "{found:?} instead of {expected:?}");
    }
}

/// Asserts F = K/√(πa) of a star in the plane under all-round tension (dislocation integral
/// equations; shared reference table). A plate of 40 half-lengths adds (a/W)², 0.05 %.
fn assert_star_in_plane(arms: usize, exact: f64, level: u32, order: usize) {
    let found = factors(&plate(40.0, &star([0.0; 2], arms, 0.2), true, level, order));
    println!("{found:?}");
    close(&found, &vec![[exact * PI.sqrt(), 0.0]; arms], 1e-3);
}

#[test]
fn a_star_in_a_large_plate() {
    assert_star_in_plane(6, 0.742_545, 3, 2);
}

#[test]
#[ignore = "slow: level 4 at order 3"]
fn a_star_of_three_arms() {
    assert_star_in_plane(3, 0.941_499, 4, 3);
}

/// A symmetric branch of 45° with legs of equal length: F_I 1.0435 at the leg's tip, F_I 0.4948 and
/// F_II ± 0.5059 at those of the arms, known to 1e-4, with K/√(πc) and c half the extent of
/// the whole.
#[test]
fn a_branch_in_a_large_plate() {
    let arm = |angle: f64| vec![[0.0, 0.0], polar(1.0, angle)];
    let lines = [vec![[-1.0, 0.0], [0.0, 0.0]], arm(0.25 * PI), arm(-0.25 * PI)];
    let found = factors(&plate(64.0, &lines, false, 4, 3));
    let unit = (PI * 0.5 * (1.0 + 0.5f64.sqrt())).sqrt();
    let expected = [[1.0435, 0.0], [0.4948, 0.5059], [0.4948, -0.5059]];
    close(&found, &expected.map(|f| f.map(|f| f * unit)), 1e-3);
}

/// One crack with a kink, and two cracks that meet end to end: K/√π is 1.2148, −0.0226 at the
/// straight one's tip, and 1.1520, 0.3178 at the other's, known to 1e-4; the plate of 80 adds
/// 0.05 %.
#[test]
fn a_kink_of_one_crack_and_of_two() {
    let tip = [1.0 + (PI / 12.0).cos(), (PI / 12.0).sin()];
    let one = [vec![[-1.0, 0.0], [1.0, 0.0], tip]];
    let two = [vec![[-1.0, 0.0], [1.0, 0.0]], vec![tip, [1.0, 0.0]]];
    let expected = [[1.2148, -0.0226], [1.1520, 0.3178]].map(|k| k.map(|k| k * PI.sqrt()));
    for lines in [&one[..], &two[..]] {
        let found = factors(&plate(80.0, lines, false, 3, 2));
        println!("{found:?} {expected:?}");
        close(&found, &expected, 1.2e-3);
    }
}

/// K of cracks in the square [−1, 1]² under all-round tension, by finite elements of order 10 on a
/// mesh that follows the cracks (tests/random/README.md), whose own estimates of its errors are
/// below 4e-6.
fn assert_factors(cases: &[Case], level: u32, order: usize) {
    for (name, lines, expected) in cases {
        println!("{name}");
        close(&factors(&plate(1.0, lines, true, level, order)), expected, 5e-4);
    }
}

#[test]
fn crossings_and_branches() {
    let cases: [Case; 2] = [
        (
            "an oblique crossing",
            vec![vec![[-0.4, -0.25], [0.45, 0.3]], vec![[-0.3, 0.35], [0.35, -0.2]]],
            vec![
                [1.511942, -0.056017],
                [1.534445, 0.027151],
                [1.036881, 0.052471],
                [0.907771, 0.005897],
            ],
        ),
        (
            "an edge crack with two branches",
            vec![
                vec![[-1.0, 0.1], [-0.2, 0.05]],
                vec![[-0.2, 0.05], [0.3, 0.35]],
                vec![[-0.2, 0.05], [0.25, -0.3]],
            ],
            vec![[11.332062, -0.048619], [10.394344, -0.060178]],
        ),
    ];
    assert_factors(&cases, 2, 3);
}

#[test]
#[ignore = "slow: six cracks with sharp kinks and unequal arms"]
fn cracks_that_meet_in_all_ways() {
    let cases: [Case; 6] = [
        (
            "an end on another crack",
            vec![vec![[-0.5, 0.1], [0.4, 0.2]], vec![[-0.05, 0.15], [0.1, -0.5]]],
            vec![[1.400575, 0.372857], [1.307638, -0.354321], [1.297920, -0.051093]],
        ),
        (
            "three arms of different lengths",
            vec![
                vec![[0.05, -0.02], [0.5, 0.1]],
                vec![[0.05, -0.02], [-0.3, 0.35]],
                vec![[0.05, -0.02], [-0.1, -0.45]],
            ],
            vec![[1.393728, 0.036234], [1.410866, -0.012951], [1.361630, -0.030880]],
        ),
        (
            "a U",
            vec![vec![[-0.4, 0.25], [0.3, 0.2], [0.3, -0.15], [-0.35, -0.2]]],
            vec![[1.062044, 0.383985], [0.803824, -0.398793]],
        ),
        (
            "a Z",
            vec![vec![[-0.5, 0.2], [0.4, 0.2], [-0.4, -0.2], [0.5, -0.25]]],
            vec![[1.580963, 0.431324], [1.599275, 0.423771]],
        ),
        (
            "a hook whose extension meets its other end's",
            vec![vec![[-0.5, -0.2], [0.4, -0.2], [0.4, 0.3], [-0.1, 0.3], [-0.35, 0.25]]],
            vec![[1.530528, -0.418140], [0.465181, 0.436238]],
        ),
        (
            "a V of 7°",
            vec![vec![[-0.5, 0.0], [0.3, 0.02], [-0.45, 0.09]]],
            vec![[1.259167, -0.113412], [0.494907, 0.273089]],
        ),
    ];
    assert_factors(&cases, 3, 3);
}

const HOOK: [[f64; 2]; 5] = [[-0.58, 0.1], [0.5, 0.1], [0.5, 0.3], [-0.2, 0.3], [-0.2, 0.15]];

/// The hook with a vertex at a random place of each of its straight parts.
fn divided_hook(random: &mut Random) -> Line {
    let mut points = vec![HOOK[0]];
    for pair in HOOK.windows(2) {
        let [[x, y], [u, v]] = [pair[0], pair[1]];
        let t = random.between(0.05, 0.95);
        points.extend([[x + t * (u - x), y + t * (v - y)], [u, v]]);
    }
    println!("{points:?}");
    points
}

/// Vertices on the straight parts of a hook do not change the number of cells by much; that factors
/// stay is in [`factors_of_a_hook`].
#[test]
fn vertices_of_a_hook() {
    let mut random = Random(31);
    let cells = n_cells(&plate(1.0, &[HOOK.to_vec()], true, 3, 2));
    for _ in 0..4 {
        let found = n_cells(&plate(1.0, &[divided_hook(&mut random)], true, 3, 2));
        assert!(found < 2 * cells, "{found} {cells}");
    }
}

/// Factors of hooks with vertices. Those of a hook with one near a tip come to what hp finite
/// elements of order 10 have (`tests/random`), from level to level.
#[test]
#[ignore = "slow: small cells around four kinks at order 3"]
fn factors_of_a_hook() {
    let plain = factors(&plate(1.0, &[HOOK.to_vec()], true, 3, 2));
    let divided = divided_hook(&mut Random(31));
    close(&factors(&plate(1.0, &[divided], true, 3, 2)), &plain, 2e-3);
    let near = [[-0.58, 0.1], [-0.5, 0.1], [0.5, 0.1], [0.5, 0.3], [-0.2, 0.3], [-0.2, 0.15]];
    for (level, tolerance) in [(3, 1e-3), (4, 1e-4)] {
        let found = factors(&plate(1.0, &[near.to_vec()], true, level, 3));
        close(&found, &[[1.967369, -0.026765], [0.000814, -0.002264]], tolerance);
    }
}

fn n_cells(problem: &ProblemData) -> usize {
    let ready = checked(problem);
    let plan = Plan::new(&ready, None, unwatched()).expect("a plan");
    plan.dataset().steps[0].partition.len()
}

/// A network of five cracks, most of which cross: the same reference, to the largest K.
#[test]
fn a_network() {
    let lines = [
        vec![[-0.6, -0.3], [0.5, -0.1]],
        vec![[-0.3, -0.6], [-0.1, 0.5]],
        vec![[0.1, -0.5], [0.35, 0.6]],
        vec![[-0.5, 0.35], [0.6, 0.25]],
        vec![[-0.7, 0.0], [0.7, 0.1]],
    ];
    let expected = [
        [1.412411, -0.409094],
        [0.031072, 0.117573],
        [1.634493, 0.327464],
        [-0.055755, -0.121790],
        [0.142484, -0.211042],
        [1.702641, 0.429986],
        [0.718852, 0.400424],
        [0.706562, -0.472942],
        [1.748045, 0.116573],
        [2.115313, -0.005033],
    ];
    close(&factors(&plate(1.0, &lines, true, 3, 3)), &expected, 5e-4);
}

/// The points of a crossing: where two cracks begin, and end, and where they cross.
fn crossing() -> [Vec2; 5] {
    let [a, c, o] = [[-0.4, -0.25], [-0.3, 0.35], [0.025, 0.025]].map(Vec2::from);
    // so that the middle lies on both
    [a, o + (o - a) * 0.9, c, o + (o - c) * 0.8, o]
}

fn factors_of_lines(lines: &[&[Vec2]]) -> Vec<[f64; 2]> {
    let line = |points: &&[Vec2]| points.iter().map(|&p| p.into()).collect::<Line>();
    let lines: Vec<Line> = lines.iter().map(line).collect();
    factors(&plate(1.0, &lines, true, 2, 3))
}

/// The crossing of two cracks is that of four that end there: the functions span the same, so K is
/// equal up to what the covers differ in around kinks.
#[test]
fn a_crossing_given_in_two_ways() {
    let [a, b, c, d, o] = crossing();
    let two = factors_of_lines(&[&[a, b], &[c, d]]);
    close(&factors_of_lines(&[&[o, a], &[o, b], &[o, c], &[o, d]]), &two, 1e-4);
}

/// The same of two bent cracks that touch.
#[test]
#[ignore = "slow: small cells around two kinks that touch"]
fn a_crossing_of_bent_cracks() {
    let [a, b, c, d, o] = crossing();
    let two = factors_of_lines(&[&[a, b], &[c, d]]);
    let bent = factors_of_lines(&[&[a, o, c], &[b, o, d]]);
    close(&[bent[0], bent[2], bent[1], bent[3]], &two, 1e-4);
}

/// A star of three arms whose middle lies from 1e-1 to 1e-12 of a cell beside a corner of cells, of
/// patches, or a line of cells.
fn beside(place: usize, exponent: i32) -> Vec<Line> {
    let cell = 16.0 / 64.0;
    let places = [[0.0, 0.0], [0.0, 0.4], [0.15, 0.15], [0.15, -0.15]];
    let off = 10f64.powi(-exponent);
    let centre = [places[place][0] + off, places[place][1] + 0.7 * off].map(|x| x * cell);
    star(centre, 3, 0.1 * place as f64)
}

/// The condition of a plate with a star that is held at its left edge.
fn condition(lines: &[Line], order: usize) -> f64 {
    let hold = vec![Condition::Dirichlet(0.0.into()), Condition::Dirichlet(0.0.into())];
    let held = plate(4.0, lines, false, 3, order).with_boundary(DomainEdge::Left, hold);
    spectrum(&checked(&held), unwatched()).expect("a spectrum").condition()
}

/// Asserts that conditions are those of one magnitude.
fn assert_alike(conditions: &[f64]) {
    println!("{conditions:?}");
    let least = conditions.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(conditions.iter().all(|condition| *condition < 10.0 * least), "{conditions:?}");
}

/// Asserts the factors of a star of three arms of length 1 in a plate of half-width 8: finite
/// elements of order 10 have 1.68484 and twice 1.68508 for one that is not turned.
fn assert_star(lines: &[Line]) {
    let found = factors(&plate(8.0, lines, true, 4, 2));
    println!("{found:?}");
    close(&found, &[[1.685, 0.0]; 3], 2e-3);
}

/// Factors stay, and so does the condition.
#[test]
fn a_junction_anywhere() {
    let stars = [(1, 1), (2, 12), (3, 12)].map(|(place, off)| beside(place, off));
    assert_alike(&stars.each_ref().map(|lines| condition(lines, 1)));
    assert_star(&stars[1]);
}

#[test]
#[ignore = "slow: spectra and solutions of plates at order 2"]
fn a_junction_at_all_places() {
    let stars: Vec<_> =
        (0..4).flat_map(|place| [4, 12].map(|exponent| beside(place, exponent))).collect();
    assert_alike(&stars.iter().map(|lines| condition(lines, 2)).collect::<Vec<_>>());
    stars.iter().step_by(2).for_each(|lines| assert_star(lines));
}

/// Asserts the estimated errors of a star anywhere in its cells, on level 3 at order 2, against a
/// reference of order 4: of the energy norm within a factor of 2.5, and of the largest error of K
/// never less than half.
fn assert_estimates(arms: usize, random: &mut Random) {
    let centre = [random.between(-0.13, 0.13), random.between(-0.13, 0.13)];
    let turn = random.between(0.0, 2.0 * PI);
    let arm = |line: Line| vec![line[0], [0, 1].map(|i| 0.6 * line[1][i] + 0.4 * line[0][i])];
    let lines: Vec<Line> = star(centre, arms, turn).into_iter().map(arm).collect();
    let [coarse, fine] = [2, 4].map(|order| solved(&plate(1.0, &lines, true, 3, order)));
    let [e, exact] = [&coarse, &fine].map(strain_energy);
    let error = ((exact - e) / exact).sqrt();
    let estimated = record(&coarse.steps[0], "estimated error");
    let [tips, better] = [&coarse, &fine].map(|d| &d.steps[0].intensities);
    let apart = tips.iter().zip(better).map(|(a, b)| (a.k1 - b.k1).hypot(a.k2 - b.k2));
    let of_factors = tips.iter().filter_map(|tip| tip.error).fold(0.0, f64::max);
    let error_of_factors = apart.fold(0.0, f64::max);
    println!(
        "{arms} arms: {error:.2e}, estimated {estimated:.2e}; of K {error_of_factors:.2e}, {of_factors:.2e}"
    );
    assert!((0.7..2.5).contains(&(estimated / error)), "{arms} arms: {error} {estimated}");
    assert!(of_factors > 0.5 * error_of_factors && of_factors < 0.05, "{arms} arms: {of_factors}");
}

#[test]
fn estimates_beside_a_junction() {
    assert_estimates(3, &mut Random(16));
}

#[test]
#[ignore = "slow: order 4 as reference"]
fn estimates_beside_junctions() {
    let mut random = Random(16);
    [2, 5].into_iter().for_each(|arms| assert_estimates(arms, &mut random));
}
