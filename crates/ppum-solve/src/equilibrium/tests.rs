//! Pieces that curved faces hold.

use super::{Balance, BodyEquilibrium, BodyPieces, EquilibriumError};
use ppum::crack::Crack;
use ppum::dataset::{Material, StressState};
use ppum::domain::Domain;
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::{BaseCells, Discretization, Problem, ProblemData};
use ppum_testkit::random::Random;
use std::f64::consts::{PI, TAU};

/// A plate with a piece inside of two half turns of an ellipse, in so many edges each, whose faces
/// touch.
fn inclusion(axes: Vec2, edges: usize, friction: f64) -> Problem {
    let material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
    let bounds = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
    let domain = Domain { bounds, holes: Vec::new() };
    let set = Discretization::new(BaseCells::Level(3));
    let mut problem = ProblemData::elasticity(domain, material, set);
    let at = |k: usize| {
        let (sin, cos) = (0.3 + PI * k as f64 / edges as f64).sin_cos();
        let tangent = vec2(-axes.x * sin, axes.y * cos).unit();
        [vec2(0.1, 0.2) + vec2(axes.x * cos, axes.y * sin), tangent]
    };
    for half in 0..2 {
        let pair = |k: usize| Edge::pair_between(at(k), at(k + 1));
        let all: Vec<Edge> = (half * edges..(half + 1) * edges).flat_map(pair).collect();
        problem = problem.with_crack_along(Crack::along(&all)).with_contact(half as u32, friction);
    }
    Problem::new(problem).expect("a problem in order")
}

/// The equilibrium of the body with a load at a point of the inclusion; the rest of it is held.
fn loaded(problem: &Problem, at: Vec2, load: Vec2) -> Result<BodyEquilibrium, EquilibriumError> {
    let pieces = BodyPieces::new(problem.domain(), problem.cracks());
    assert_eq!(pieces.all().len(), 2);
    let mut balances = Balance::of(&pieces, &problem.equation);
    let axes = [vec2(1.0, 0.0), vec2(0.0, 1.0)];
    for x in [-0.9, 0.9] {
        let corner = vec2(x, -0.9);
        balances[pieces.of(corner)].add_held(corner, axes.into_iter(), 1.0);
    }
    balances[pieces.of(at)].add_load(at, &<[f64; 2]>::from(load), 1.0);
    BodyEquilibrium::new(pieces, balances, problem)
}

/// Without friction the faces of a disc hold it against all forces through its centre, and it turns
/// about that; with friction, and for an ellipse, they hold it against all loads. However many arcs
/// there are.
#[test]
fn faces_hold_inclusions() {
    let (mut random, center) = (Random(3), vec2(0.1, 0.2));
    for edges in [2, 3, 20] {
        for (axes, friction) in [(0.4, 0.0), (0.4, 0.2), (0.25, 0.0)] {
            let problem = inclusion(vec2(0.4, axes), edges, friction);
            let turns = axes == 0.4 && friction == 0.0;
            let load: Vec2 = random.direction();
            let plate = loaded(&problem, center, load).expect("a force through the centre");
            assert_eq!(plate.motions.len(), usize::from(turns), "{edges} {axes} {friction}");
            for motion in &plate.motions {
                let piece = plate.pieces.of(center);
                assert_eq!(motion.lead, piece);
                let moved = |p: Vec2| Vec2::from(plate.moved(motion, piece, p));
                let size = moved(center + vec2(0.4, 0.0)).length();
                assert!(size > 0.0 && moved(center).length() < 1e-9 * size);
            }
            let beside = loaded(&problem, center + load.left() * 0.1, load);
            assert_eq!(beside.is_err(), turns, "{edges} {axes} {friction}");
        }
    }
    let length: f64 = inclusion(vec2(0.4, 0.4), 2, 0.0).cracks().iter().map(Crack::length).sum();
    assert!((length - 0.4 * TAU).abs() < 1e-12, "the arcs are those of a circle");
}
