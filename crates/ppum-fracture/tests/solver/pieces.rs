//! Plates and pieces of plates that nothing holds, and loads that do not balance.

use crate::studies::exact_fields::{MATERIAL, SQUARE, discretization};
use crate::studies::support::{checked, errors, record, solved};
use crate::support::{stressed, traction};
use ppum::crack::Side;
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::progress::unwatched;
use ppum::vec2::{Vec2, vec2};
use ppum_fracture::solve::{SolveError, solve};
use ppum_problem::{BaseCells, Condition, DomainEdge, ProblemData};

/// Strains of a tension of 1 in x: E = 1, ν = 0.3, plane strain.
const STRAINS: [f64; 2] = [0.91, -0.39];

fn plate(level: u32, order: usize) -> ProblemData {
    ProblemData::elasticity(SQUARE, MATERIAL, discretization(BaseCells::Level(level), order))
}

/// Pulled in x at both ends.
fn pulled(problem: ProblemData) -> ProblemData {
    stressed(problem, [1.0, 0.0, 0.0], &[DomainEdge::Left, DomainEdge::Right])
}

/// Tension about a centre that does not move.
fn stretched(p: Vec2, center: Vec2) -> ([f64; 2], [Vec2; 2]) {
    let [x, y] = STRAINS;
    let d = p - center;
    ([x * d.x, y * d.y], [vec2(x, 0.0), vec2(0.0, y)])
}

fn refused(problem: &ProblemData) -> ppum_fracture::solve::UnbalancedError {
    problem.check().expect("a problem in order");
    match solve(&checked(problem), unwatched()) {
        Err(SolveError::Unbalanced(error)) => error,
        other => panic!("solved, or failed for another reason: {:?}", other.err()),
    }
}

/// A plate under loads in equilibrium keeps its mean place and does not turn on average.
#[test]
fn a_plate_under_loads_alone_stays_where_it_is() {
    let solution = solved(&pulled(plate(2, 1)));
    let e = errors(&solution, &|p| stretched(p, Vec2::ZERO));
    assert!(e.energy < 1e-12 && e.l2 < 1e-12, "{e:?}");
    assert_eq!(record(&solution.steps[0], "free motions"), 3.0);
}

/// So a crack in the middle gives a field that is symmetric like its loads.
#[test]
fn symmetric_loads_give_symmetric_displacements() {
    let problem = plate(4, 2)
        .with_crack(&[[-0.4, -0.2], [0.4, 0.2]])
        .with_boundary(DomainEdge::Bottom, traction([0.0, -1.0]))
        .with_boundary(DomainEdge::Top, traction([0.0, 1.0]));
    let solution = solved(&problem);
    let field = Field::new(&solution, 0).expect("a field");
    let at = |p: Vec2, side| {
        let mut u = [Jet::constant(0.0); 2];
        assert!(field.at(p).evaluate::<0>(Vec2::ZERO, side, &mut u));
        vec2(u[0].v, u[1].v)
    };
    for p in [vec2(1.0, 1.0), vec2(-0.3, 0.7), vec2(0.1, 0.01), vec2(0.52, 0.23)] {
        let sum = at(p, Side::Above) + at(-p, Side::Below);
        assert!(sum.length() < 1e-9, "{sum:?} at {p:?}");
    }
}

/// A crack from border to border, across patches: each piece stretches about its own centre.
#[test]
fn pieces_are_held_by_their_own_loads() {
    for crack in [0.137, 0.0, 0.25 + 1e-7] {
        let solution = solved(&pulled(plate(2, 2).with_crack(&[[-1.0, crack], [1.0, crack]])));
        let center = |p: Vec2| vec2(0.0, 0.5 * (crack + if p.y > crack { 1.0 } else { -1.0 }));
        let e = errors(&solution, &|p| stretched(p, center(p)));
        println!("crack at {crack}: {e:?}");
        assert!(e.energy < 1e-9 && e.l2 < 1e-9, "crack at {crack}: {e:?}");
        assert_eq!(record(&solution.steps[0], "pieces"), 2.0);
        assert_eq!(record(&solution.steps[0], "free motions"), 6.0);
    }
}

/// One piece on rollers, the other one free: only the free one is centred.
#[test]
fn one_piece_held() {
    let zero = || Condition::Dirichlet(0.0.into());
    let free = || Condition::Free;
    let problem = pulled(plate(2, 2).with_crack(&[[-1.0, 0.137], [1.0, 0.137]]))
        .with_boundary(DomainEdge::Bottom, vec![free(), zero()]);
    let solution = solved(&problem);
    // on its roller the lower piece can still slide: its mean place in x is kept
    let center = |p: Vec2| if p.y > 0.137 { vec2(0.0, 0.5685) } else { vec2(0.0, -1.0) };
    let e = errors(&solution, &|p| stretched(p, center(p)));
    assert!(e.energy < 1e-9 && e.l2 < 1e-9, "{e:?}");
    assert_eq!(record(&solution.steps[0], "free motions"), 4.0);
}

/// The piece that moves is named, with the force and the moment that move it.
#[test]
fn unbalanced_piece_is_named() {
    let problem = plate(2, 1)
        .with_crack(&[[-1.0, 0.0], [0.2, 0.3], [1.0, 0.0]])
        .with_boundary(DomainEdge::Bottom, vec![Condition::Dirichlet(0.0.into()); 2])
        .with_boundary(DomainEdge::Top, traction([0.5, 1.0]));
    let error = refused(&problem);
    let piece = error.piece.expect("a piece of several");
    assert!(piece.y > 0.0 && SQUARE.contains(piece), "{piece:?}");
    assert!((error.force - vec2(1.0, 2.0)).length() < 1e-12, "{error:?}");
    // traction (1/2, 1) on y = 1 about the centroid (x̄, ȳ): −F_x (1 − ȳ) − F_y x̄
    let [x, y] = [error.about.x, error.about.y];
    let moment = -(1.0 - y) - 2.0 * x;
    assert!((error.moment.expect("elasticity") - moment).abs() < 1e-12, "{error:?}");
    assert!((error.magnitude - 3.0).abs() < 1e-12);
    let text = error.to_string();
    for part in ["the piece around (", "falls into pieces", "a force of (1, 2)", "hold a component"]
    {
        assert!(text.contains(part), "{text}");
    }
}

/// A pure moment, and forces that a roller takes up.
#[test]
fn only_free_motions_count() {
    let shear = plate(2, 1)
        .with_boundary(DomainEdge::Bottom, traction([-1.0, 0.0]))
        .with_boundary(DomainEdge::Top, traction([1.0, 0.0]));
    let error = refused(&shear);
    assert!(error.piece.is_none() && error.force.length() < 1e-12, "{error:?}");
    assert!((error.moment.expect("elasticity") + 4.0).abs() < 1e-12, "{error:?}");
    let roller = plate(2, 1)
        .with_boundary(DomainEdge::Bottom, vec![Condition::Free, Condition::Dirichlet(0.0.into())])
        .with_boundary(DomainEdge::Top, traction([0.25, -1.0]));
    let error = refused(&roller);
    assert!((error.force - vec2(0.5, 0.0)).length() < 1e-9, "{error:?}");
    assert!(error.moment.expect("elasticity").abs() < 1e-9, "{error:?}");
}

/// Poisson: a source that nothing takes up, and one that flows out.
#[test]
fn flows_balance_too() {
    let mut problem = ProblemData::poisson(SQUARE, 2.0, discretization(BaseCells::Level(2), 2));
    problem.source = vec![1.0.into()];
    let error = refused(&problem);
    assert!((error.force.x - 4.0).abs() < 1e-12 && error.moment.is_none(), "{error:?}");
    assert!(error.to_string().contains("a flow of 4 remains"), "{error}");
    let out = || vec![Condition::Neumann((-1.0).into())];
    let solution = solved(
        &problem.with_boundary(DomainEdge::Left, out()).with_boundary(DomainEdge::Right, out()),
    );
    // −2 u″ = 1, 2 u′(±1) = ∓1: u = −x²/4 and a constant, with mean 0 that is 1/12
    let field = Field::new(&solution, 0).expect("a field");
    let mut u = [Jet::constant(0.0)];
    for x in [-1.0, 0.1, 0.6] {
        assert!(field.at(vec2(x, 0.3)).evaluate::<0>(Vec2::ZERO, Side::Above, &mut u));
        assert!((u[0].v - (1.0 / 12.0 - x * x / 4.0)).abs() < 1e-12, "{} at {x}", u[0].v);
    }
}
