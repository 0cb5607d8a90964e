//! Reactions of restraints, against statics.

use crate::studies::exact_fields::{MATERIAL, SQUARE, discretization};
use crate::studies::plates::end_shear;
use crate::studies::support::solved;
use ppum::dataset::Reaction;
use ppum::domain::{Domain, Hole};
use ppum::vec2::{Rect, vec2};
use ppum_problem::{
    BaseCells, BoundaryCondition, BoundaryPart, Condition, DomainEdge, Expression, ProblemData,
};

fn free() -> Condition {
    Condition::Neumann(0.0.into())
}

fn given(text: &str) -> Condition {
    Condition::Dirichlet(Expression::parse(text).expect("a formula"))
}

fn assert_close(found: &[f64], expected: &[f64], scale: f64) {
    println!("{found:?} {expected:?}");
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= 1e-9 * scale, "{found:?}, expected {expected:?}");
    }
}

/// Force and moment of the restraints together.
fn total(reactions: &[Reaction]) -> Vec<f64> {
    let part =
        |k: usize| reactions.iter().map(move |r| r.force.get(k).copied().unwrap_or(r.moment)).sum();
    (0..3).map(part).collect()
}

/// A square of width 2 on two rollers. Pulled by 1 along the top, the lower one bears −2; pulled
/// along the right half of the top, both together bear −1 and the moment −1/2 about the centre.
#[test]
fn rollers_bear_what_pulls() {
    let pull = || Condition::Neumann(1.0.into());
    let plate = ProblemData::elasticity(SQUARE, MATERIAL, discretization(BaseCells::Level(2), 1))
        .with_boundary(DomainEdge::Left, vec![given("0"), free()])
        .with_boundary(DomainEdge::Bottom, vec![free(), given("0")]);
    let uniform = plate.clone().with_boundary(DomainEdge::Top, vec![free(), pull()]);
    let reactions = &solved(&uniform).steps[0].reactions;
    let [left, bottom] = &reactions[..] else { panic!("{reactions:?}") };
    assert_eq!((&*left.on, &*bottom.on), ("left", "bottom"));
    assert_eq!((&*left.held, &*bottom.held), (&[true, false][..], &[false, true][..]));
    assert_close(&left.force, &[0.0, 0.0], 1.0);
    assert_close(&bottom.force, &[0.0, -2.0], 1.0);
    assert_close(&[left.moment, bottom.moment], &[0.0, 0.0], 1.0);

    let mut right = plate;
    let on = BoundaryPart::Edge { edge: DomainEdge::Top, from: 0.0, to: 1.0 };
    right.boundary.push(BoundaryCondition::new(on, vec![free(), pull()]));
    assert_close(&total(&solved(&right).steps[0].reactions), &[0.0, -1.0, -0.5], 1.0);
}

/// A bar stretched between its ends by u = x: exact tractions σ = E′ on the ends, given values that
/// are not zero, a piece of an edge.
#[test]
fn given_values_stretch() {
    let mut bar = ProblemData::elasticity(SQUARE, MATERIAL, discretization(BaseCells::Level(1), 1))
        .with_boundary(DomainEdge::Left, vec![given("x"), free()])
        .with_boundary(DomainEdge::Right, vec![given("x"), free()]);
    let on = BoundaryPart::Edge { edge: DomainEdge::Bottom, from: -0.5, to: 0.5 };
    let nu = 0.3;
    // the free strain across, so that the piece bears nothing
    let across = format!("{}*y", -nu / (1.0 - nu));
    bar.boundary.push(BoundaryCondition::new(on, vec![Condition::Free, given(&across)]));
    let reactions = &solved(&bar).steps[0].reactions;
    let force = 2.0 / (1.0 - nu * nu);
    assert_close(&reactions[0].force, &[-force, 0.0], force);
    assert_close(&reactions[1].force, &[force, 0.0], force);
    assert_eq!(reactions[2].on, "bottom from -0.5 to 0.5");
    assert_close(&reactions[2].force, &[0.0, 0.0], force);
    let moments: Vec<_> = reactions.iter().map(|r| r.moment).collect();
    assert_close(&moments, &[0.0; 3], force);
}

/// A cracked plate under end shear: 7 × 16, t_x = 1 at the top. The clamp bears −7 and, about the
/// centre, the moment of the loads, −(16/2)·7 about the z axis, with the opposite sign.
#[test]
fn the_clamp_bears_the_shear() {
    let solution = solved(&end_shear().problem);
    let [clamp] = &solution.steps[0].reactions[..] else { panic!("one support") };
    assert_close(&[clamp.force[0], clamp.force[1], clamp.moment], &[-7.0, 0.0, 56.0], 7.0);
}

/// A source of 2 on a square of side 2 with a round hole, heated through the left edge, cooled
/// at the right and at the rim.
#[test]
fn flows_balance_the_source() {
    let hole = Hole::Circle { center: vec2(0.1, 0.07), radius: 0.4 };
    let domain = Domain { bounds: Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0)), holes: vec![hole] };
    let mut problem = ProblemData::poisson(domain, 1.5, discretization(BaseCells::Level(3), 2))
        .with_boundary(DomainEdge::Left, vec![Condition::Neumann(0.7.into())])
        .with_boundary(DomainEdge::Right, vec![given("1 + y")]);
    problem.boundary.push(BoundaryCondition::new(BoundaryPart::Hole(0), vec![given("3")]));
    problem.source = vec![2.0.into()];
    let reactions = &solved(&problem).steps[0].reactions;
    assert_eq!(reactions.iter().map(|r| &*r.on).collect::<Vec<_>>(), ["right", "hole 0"]);
    let flow: f64 = reactions.iter().map(|r| r.force[0]).sum();
    let fed = 2.0 * (4.0 - 0.16 * std::f64::consts::PI) + 2.0 * 0.7;
    assert_close(&[flow], &[-fed], fed);
    assert!(reactions.iter().all(|r| r.moment == 0.0));
}
