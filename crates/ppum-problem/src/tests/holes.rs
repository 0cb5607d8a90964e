//! Holes, and conditions on all parts of the border.

use ppum::crack::{CrackEnd, Side};
use ppum::domain::Hole;
use ppum::vec2::vec2;

use super::*;

/// A plate with two holes and a crack from the first. Line numbers: 1 domain, 4 material, 8 and 11
/// hole, 13 crack, 15, 18, 21, 24 and 27 boundary, 30 discretization.
const HOLES: &str = include_str!("../../tests/bad_files/holes.toml");

#[test]
fn everything_about_holes() {
    let problem = good(HOLES);
    let [round, triangle] = &problem.domain().holes[..] else { panic!("two holes") };
    assert_eq!(*round, Hole::Circle { center: vec2(0.0, 0.25), radius: 0.5 });
    assert!(matches!(triangle, Hole::Polygon { points, .. } if points.len() == 3));
    assert_eq!(problem.cracks()[0].ends, [CrackEnd::Mouth, CrackEnd::Tip]);
    let [left, top, first, second, face] = &problem.boundary[..] else { panic!("five conditions") };
    assert_eq!(left.components, [Condition::Dirichlet(0.0.into()), Condition::Free]);
    assert_eq!(top.on, BoundaryPart::Edge { edge: DomainEdge::Top, from: 0.5, to: 2.0 });
    assert_eq!(top.values(vec2(1.0, 1.0), vec2(0.0, 1.0)), [0.0, -2.0]);
    assert_eq!(first.on, BoundaryPart::Hole(0));
    assert_eq!(first.values(vec2(0.5, 0.25), vec2(-1.0, 0.0)), [2.0, 0.0]);
    assert_eq!((second.on, second.held()), (BoundaryPart::Hole(1), [true, false]));
    assert_eq!(face.on, BoundaryPart::Crack { crack: 0, face: Some(Side::Above) });
}
