//! Cells divided by hand: `[[refine]]`.

use crate::studies::support::{checked, parsed, solved};
use ppum::progress::unwatched;
use ppum::segment::polyline_distance;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::{LocalRefinement, Problem, ProblemData, RefinementRegion};
use ppum_solve::space::discretise;
use ppum_testkit::random::Random;
use std::path::Path;

const PLATE: &str = "[domain]\nmin = [-1.0, -1.0]\nmax = [1.0, 1.0]\n[material]\nyoung = 1.0\npoisson = 0.3\n\
                     state = \"plane-strain\"\n[[boundary]]\non = \"bottom\"\ntraction = [0, -1]\n[[boundary]]\n\
                     on = \"top\"\ntraction = [0, 1]\n[[hole]]\ncenter = [0.5, 0.45]\nradius = 0.2\n[[hole]]\n\
                     points = [[-0.7, 0.3], [-0.3, 0.4], [-0.5, 0.7]]\n[[crack]]\n\
                     points = [[-0.5, -0.4], [0.0, -0.3], [0.3, -0.5]]\n";

/// The plate with these cells, divided by hand alone.
fn plate(cells: &str, refine: &str) -> ProblemData {
    let text = format!("{PLATE}[discretization]\n{cells}\nrefine = false\n{refine}");
    parsed(&text)
}

fn cells_of(problem: &ProblemData) -> Vec<Rect> {
    discretise(&checked(problem), unwatched()).expect("a cover").partition.boxes().cell.clone()
}

fn longest(cell: &Rect) -> f64 {
    cell.size().x.max(cell.size().y)
}

/// Distance of a point to a place.
type Away = Box<dyn Fn(Vec2) -> f64>;

/// A random place with points of it, which lie dense, and the distance of a point to it.
fn place(kind: usize, random: &mut Random) -> (RefinementRegion, Vec<Vec2>, Away) {
    let mut point = || vec2(random.between(-0.9, 0.9), random.between(-0.9, 0.9));
    let grid = |rect: Rect| {
        let at = move |k: u32| {
            let size = rect.size() * (1.0 / 40.0);
            rect.min + vec2(size.x * f64::from(k % 41), size.y * f64::from(k / 41))
        };
        (0..41 * 41).map(at).collect::<Vec<_>>()
    };
    match kind {
        0 => {
            let (a, b) = (point(), point());
            let rect = Rect::new(a.min(b), a.max(b));
            (RefinementRegion::Box(rect), grid(rect), Box::new(move |p| rect.distance(p)))
        }
        1 => {
            let (center, radius) = (point(), 0.05 + 0.2 * point().x.abs());
            let all = grid(Rect::around(center, vec2(radius, radius)));
            let inside = all.into_iter().filter(|p| (*p - center).length() < radius).collect();
            let away = move |p: Vec2| ((p - center).length() - radius).max(0.0);
            (RefinementRegion::Disc { center, radius }, inside, Box::new(away))
        }
        2 => {
            let center = vec2(0.5, 0.45);
            let turn = |k: u32| std::f64::consts::TAU * f64::from(k) / 400.0;
            let on = (0..400).map(|k| center + vec2(turn(k).cos(), turn(k).sin()) * 0.2).collect();
            (RefinementRegion::Hole(0), on, Box::new(move |p| ((p - center).length() - 0.2).abs()))
        }
        _ => {
            let (place, points) = match kind {
                3 => (
                    RefinementRegion::Hole(1),
                    vec![[-0.7, 0.3], [-0.3, 0.4], [-0.5, 0.7], [-0.7, 0.3]],
                ),
                _ => (RefinementRegion::Crack(0), vec![[-0.5, -0.4], [0.0, -0.3], [0.3, -0.5]]),
            };
            let points: Vec<Vec2> = points.into_iter().map(Vec2::from).collect();
            let on = |k: u32| {
                let (s, t) = (k as usize / 100, f64::from(k % 100) / 100.0);
                points[s] + (points[s + 1] - points[s]) * t
            };
            let all = (0..100 * (points.len() as u32 - 1)).map(on).collect();
            (place, all, Box::new(move |p| polyline_distance(&points, p)))
        }
    }
}

/// Cells at random places are as small as was said, no smaller than half of that, and divided only
/// as near as the balance of neighbours takes them.
#[test]
fn cells_are_as_small_as_was_said() {
    let mut random = Random(11);
    for round in 0..15 {
        let (place, dense, away) = place(round % 5, &mut random);
        let size = 0.4 * 0.08f64.powf(random.between(0.0, 1.0));
        let distance = if round % 2 == 0 { 0.0 } else { random.between(0.0, 0.2) };
        let mut problem = plate("cells = [4, 5]", "");
        let base = 0.5;
        problem.refinements =
            vec![LocalRefinement { distance, ..LocalRefinement::new(place, size) }];
        assert_eq!(problem.check(), Ok(()));
        let cells = cells_of(&problem);
        let case = format!("{place:?}, {distance} away, {size}");
        for cell in &cells {
            let meets = dense
                .iter()
                .any(|p| (distance == 0.0 && cell.contains(*p)) || cell.distance(*p) < distance);
            let of_hole = matches!(place, RefinementRegion::Hole(_));
            assert!(of_hole || !meets || longest(cell) <= size, "{case}: {cell:?}");
            let corner = cell.corners().into_iter().chain([cell.center()]);
            let nearest = corner.map(&away).fold(f64::INFINITY, f64::min);
            // a cell is there since its parent of twice its size touches a cell half as large: 2 √2
            // (s + s/2 + …)
            let ring = 5.7 * longest(cell);
            if longest(cell) < base {
                assert!(longest(cell) > 0.499 * size, "{case}: {cell:?} is smaller than asked for");
                assert!(nearest <= distance + ring, "{case}: {cell:?} is far away");
            }
        }
    }
}

/// A cell that is as large as was said stays, whatever the rounding of both; lines of cells belong
/// to both sides.
#[test]
fn sizes_of_cells_themselves() {
    let square = Rect::around(Vec2::ZERO, vec2(1.0, 1.0));
    for (cells, size, expected) in [("[2, 2]", 1.0, 4), ("[20, 20]", 0.1, 400), ("[2, 2]", 0.5, 16)]
    {
        let mut problem = plate(&format!("cells = {cells}"), "").with_domain(square);
        problem.refinements = vec![LocalRefinement::new(RefinementRegion::Plate, size)];
        assert_eq!(cells_of(&problem).len(), expected, "{cells}, {size}");
    }
    let mut problem = plate("cells = [4, 4]", "").with_domain(square);
    let quarter = Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0));
    problem.refinements = vec![LocalRefinement::new(RefinementRegion::Box(quarter), 0.3)];
    assert_eq!(cells_of(&problem).len(), 12 + 16, "the box and no cell beside it");
}

/// Every kind of base cells, a formula, and what the program divides by itself on top.
#[test]
fn formulas_on_all_kinds_of_cells() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let refine = "[[refine]]\nsize = \"0.02 + 0.3*hypot(x - 0.81, y + 0.83)\"\n";
    let size = |p: Vec2| 0.02 + 0.3 * (p - vec2(0.81, -0.83)).length();
    for cells in ["level = 2", "cells = [3, 4]", "points = \"scattered-points.csv\""] {
        let [by_hand, both] = ["refine = false\n", ""].map(|keys| {
            let text = format!("{PLATE}[discretization]\n{cells}\n{keys}{refine}");
            let problem = Problem::parse(&text, "plate.toml", &folder);
            cells_of(&problem.unwrap_or_else(|error| panic!("{cells}: {error}")))
        });
        for cell in by_hand.iter().chain(&both) {
            assert!(longest(cell) <= size(cell.center()) * (1.0 + 1e-9), "{cells}: {cell:?}");
        }
        let tip = vec2(0.3, -0.5);
        let at_tip = |all: &[Rect]| all.iter().find(|c| c.contains(tip)).map(longest);
        assert!(at_tip(&both) <= at_tip(&by_hand) && both.len() > by_hand.len(), "{cells}");
    }
}

/// What cannot be divided is told, with the place.
#[test]
fn sizes_that_are_none_or_too_small() {
    let told = |refine: &str| {
        let problem = plate("cells = [2, 2]", refine);
        discretise(&checked(&problem), unwatched()).expect_err("an error").to_string()
    };
    // not positive on a disc that no place of the check meets
    let hidden =
        told("[[refine]]\nsize = 0.5\n[[refine]]\nsize = \"hypot(x - 0.5, y + 0.5) - 0.001\"\n");
    let expected = "the `size` of [[refine]] 1, counted from 0, is -0.001 at [0.5, -0.5], but must be positive and \
                    finite; change the formula, e.g. add a constant";
    assert_eq!(hidden, expected);
    let fine = told("[[refine]]\ncenter = [0.5, -0.5]\nradius = 1e-7\nsize = \"1e-6 + 0*x\"\n");
    assert!(
        fine.starts_with(
            "the `size` of [[refine]] 0, counted from 0, asks for cells smaller than 1.5"
        ),
        "{fine}"
    );
    assert!(
        fine.contains("around [0.49999") && fine.contains("larger size, or smaller base cells"),
        "{fine}"
    );
}

/// Cells divided by hand to those of the next level give its solution.
#[test]
fn a_level_by_hand() {
    let factors = |level: u32, refine: &str| {
        let text = format!(
            "{}[[crack]]\npoints = [[-0.5, 0.02], [0.4, 0.1]]\n[discretization]\nlevel = {level}\norder = 1\n{refine}",
            PLATE.split("[[hole]]").next().expect("a plate")
        );
        let problem = parsed(&text);
        let dataset = solved(&problem);
        dataset.steps[0].intensities.iter().map(|tip| tip.k1.hypot(tip.k2)).collect::<Vec<_>>()
    };
    let [coarse, by_hand, fine] =
        [(3, ""), (3, "[[refine]]\nsize = 0.125\n"), (4, "")].map(|(l, refine)| factors(l, refine));
    let apart = |a: &[f64]| a.iter().zip(&fine).map(|(a, b)| (a / b - 1.0).abs()).sum::<f64>();
    // rounding of systems with a condition of 1e4 or so
    assert!(apart(&by_hand) < 1e-10 && apart(&coarse) > 1e-5, "{by_hand:?} {fine:?} {coarse:?}");
}
