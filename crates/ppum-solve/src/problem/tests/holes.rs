//! Holes, and conditions on all parts of the border.

use super::*;
use ppum::crack::{CrackEnd, Side};
use ppum::domain::Hole;

/// A plate with two holes and a crack from the first. Line numbers: 1 domain, 4 material, 8 and 11
/// hole, 13 crack, 15, 18, 21, 24 and 27 boundary, 30 discretization.
const HOLES: &str = r#"[domain]
min = [-2, -1]
max = [2, 1]
[material]
young = 1.0
poisson = 0.3
state = "plane-stress"
[[hole]]
center = [0.0, 0.25]
radius = 0.5
[[hole]]
points = [[-1.5, -0.5], [-1, -0.75], [-1.25, 0.0]]
[[crack]]
points = [[0.5, 0.25], [1.0, 0.25]]
[[boundary]]
on = "left"
symmetry = true
[[boundary]]
on = { edge = "top", from = 0.5 }
pressure = "1 + x"
[[boundary]]
on = { hole = 0 }
pressure = 2
[[boundary]]
on = { hole = 1 }
displacement = [0.0, "free"]
[[boundary]]
on = { crack = 0, face = "above" }
traction = [0.0, "-x"]
[discretization]
level = 4
"#;

#[test]
fn everything_about_holes() {
    let problem = good(HOLES);
    let [round, triangle] = &problem.domain.holes[..] else { panic!("two holes") };
    assert_eq!(*round, Hole::Circle { center: vec2(0.0, 0.25), radius: 0.5 });
    assert!(matches!(triangle, Hole::Polygon { points } if points.len() == 3));
    assert_eq!(problem.cracks[0].ends, [CrackEnd::Mouth, CrackEnd::Tip]);
    let [left, top, first, second, face] = &problem.boundary[..] else { panic!("five conditions") };
    assert_eq!(left.components, [Condition::Dirichlet(0.0.into()), Condition::Free]);
    assert_eq!(top.on, BorderPart::Edge { edge: Edge::Top, from: 0.5, to: 2.0 });
    assert_eq!(top.values(vec2(1.0, 1.0), vec2(0.0, 1.0)), [0.0, -2.0]);
    assert_eq!(first.on, BorderPart::Hole(0));
    assert_eq!(first.values(vec2(0.5, 0.25), vec2(-1.0, 0.0)), [2.0, 0.0]);
    assert_eq!((second.on, second.held()), (BorderPart::Hole(1), [true, false]));
    assert_eq!(face.on, BorderPart::Crack { crack: 0, face: Some(Side::Above) });
}

#[test]
fn bad_holes() {
    check_all(
        HOLES,
        &[
            ("radius = 0.5", "radius = 0", 10, 10, "`radius` is 0, but must be positive"),
            ("radius = 0.5", "radius = -1", 10, 10, "must be positive and finite"),
            ("radius = 0.5", "radius = 1e-12", 10, 10, "too small to be seen"),
            ("radius = 0.5", "radius = 9", 10, 10, "swallows the whole domain"),
            ("radius = 0.5\n", "radius = 0.5\nshape = 1\n", 11, 1, "unknown key `shape`"),
            ("radius = 0.5\n", "radius = 0.5\npoints = []\n", 11, 10, "leave one out"),
            ("center = [0.0, 0.25]\n", "", 8, 1, "`center` is missing in [[hole]]"),
            ("[[-1.5, -0.5], ", "[", 12, 10, "at least three points"),
            ("[-1.25, 0.0]]", "[-1.25, 0.0], [-1.25, -0.9]]", 12, 10, "crosses or touches itself"),
            ("[-1.25, 0.0]]", "[-1, -0.75]]", 12, 10, "are equal; remove one"),
            (
                "[[-1.5, -0.5], [-1, -0.75], [-1.25, 0.0]]",
                "[[3, 0], [4, 0], [3, 1]]",
                12,
                10,
                "misses the domain",
            ),
            (
                "[[-1.5, -0.5], [-1, -0.75], [-1.25, 0.0]]",
                "[[-9, -9], [9, -9], [9, 9], [-9, 9]]",
                12,
                10,
                "swallows the whole domain",
            ),
            ("[1.0, 0.25]]", "[0.25, 0.25]]", 14, 10, "lies in hole 0"),
        ],
    );
}

#[test]
fn bad_parts_of_the_border() {
    check_all(
        HOLES,
        &[
            ("{ hole = 1 }", "{ hole = 2 }", 25, 6, "numbered from 0 to 1"),
            ("{ hole = 1 }", "{ hole = 1, crack = 0 }", 25, 6, "names several parts"),
            ("{ hole = 1 }", "{ hole = 1, from = 0 }", 25, 18, "unknown key `from`"),
            ("{ hole = 1 }", "{ hole = 0 }", 25, 6, "the x component on the rim of hole 0"),
            ("\"above\"", "\"left\"", 28, 26, "only \"above\", \"below\""),
            ("{ crack = 0, face = \"above\" }", "{ crack = 3 }", 28, 6, "there is no crack 3"),
            ("traction = [0.0, \"-x\"]", "displacement = [0, 0]", 28, 6, "cannot be held"),
            ("pressure = 2", "pressure = 2\ntraction = [0, 0]", 23, 12, "says all components"),
            ("symmetry = true", "symmetry = false", 17, 12, "which says nothing"),
            ("\"left\"\nsymmetry", "{ hole = 0 }\nsymmetry", 17, 12, "is for edges"),
            ("pressure = 2", "pressure = [1, 2]", 23, 12, "number"),
        ],
    );
}
