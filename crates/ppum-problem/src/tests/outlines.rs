//! Outlines of bodies, paths of pieces, and conditions on pieces.

use ppum::crack::{CrackEnd, Side};
use ppum::domain::Hole;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_testkit::random::Random;

use super::*;
use crate::{BoundaryPiece, BoundaryRange};

/// A bracket with a fillet, and a slot of two pieces with one name.
const BRACKET: &str = r#"
crack = [{ points = [[0, 2.5], [0.5, 2.5]] }]
[domain.outline]
path = [
  { points = [[0, 0], [2, 0], [4, 0], [4, 1], [2, 1]], name = "foot" },
  { arc = { center = [2, 2], radius = 1, from = 270, to = 180 } },
  { points = [[1, 2], [1, 4], [0, 4]], name = "head" },
  { points = [[0, 4], [0, 0]] },
]
[[hole]]
path = [
  { arc = { center = [2.5, 0.5], radius = 0.2, from = -90, to = 90 }, name = "slot" },
  { points = [[2.5, 0.7], [2, 0.7]] },
  { arc = { center = [2, 0.5], radius = 0.2, from = 90, to = 270 }, name = "slot" },
  { points = [[2, 0.3], [2.5, 0.3]] },
]
[material]
young = 1.0
poisson = 0.3
state = "plane-stress"
[[boundary]]
on = { piece = "head" }
displacement = [0, 0]
[[boundary]]
on = { piece = "slot" }
pressure = "x"
[discretization]
cells = [9, 9]
"#;

#[test]
fn everything_about_outlines() {
    let problem = good(BRACKET);
    let [slot, outside] = &problem.domain().holes[..] else { panic!("a hole and the outside") };
    assert_eq!(problem.domain().outline(), Some(1));
    assert!(outside.is_outside() && !slot.is_outside());
    // cells of the half, beyond the body: it has 8 of the 9
    assert_eq!(problem.domain().bounds, Rect::new(vec2(-0.25, -0.25), vec2(4.25, 4.25)));
    let body = |p| problem.domain().contains(p);
    assert!([[0.5, 3.9], [3.9, 0.5], [1.2, 1.3]].map(Vec2::from).into_iter().all(body));
    assert!(![[2.0, 2.0], [2.5, 0.5], [-0.1, 1.0]].map(Vec2::from).into_iter().any(body));
    assert_eq!(problem.cracks()[0].ends, [CrackEnd::Mouth, CrackEnd::Tip]);
    let [slot, foot, head] = problem.pieces() else { panic!("three names") };
    assert_eq!([slot, foot, head].map(|piece| piece.name.as_str()), ["slot", "foot", "head"]);
    // one corner of the foot is on a straight line
    assert_eq!(foot.runs, [BoundaryRange { hole: 1, from: 0, to: 3 }]);
    assert_eq!((slot.runs.len(), slot.runs[0].from), (2, 0));
    assert_eq!(problem.boundary[0].on, BoundaryPart::Piece(2));
    let on = problem.stations(0.05);
    let at_head = |p: Vec2| (p.y == 4.0 && p.x <= 1.0) || (p.x == 1.0 && p.y >= 2.0);
    assert!(on.iter().filter(|s| s.held[0]).all(|s| at_head(s.at)));
    let far = on.iter().filter(|s| !s.held[0]).map(|s| (s.at - vec2(2.25, 0.5)).length());
    assert!(far.fold(f64::INFINITY, f64::min) > 0.25);
}

#[test]
fn mistakes_of_outlines() {
    let wrong = |from: &str, to: &str, message: &str| {
        assert!(BRACKET.contains(from), "{from}");
        let error = parse(&BRACKET.replacen(from, to, 1)).expect_err("a mistake").to_string();
        assert!(error.contains(message), "{error}");
    };
    wrong(
        "{ points = [[0, 4], [0, 0]] }",
        "{ points = [[0, 4], [0, 1]] }",
        "is open: it begins at",
    );
    wrong("{ points = [[1, 2], [1, 4]", "{ points = [[1, 2.1], [1, 4]", "has a gap");
    wrong("[1, 2], [1, 4], [0, 4]", "[1, 2], [3, 0.5], [0, 4]", "crosses or touches itself");
    wrong("piece = \"head\"", "piece = \"heat\"", "known pieces are `slot`, `foot`, `head`");
    wrong("on = { piece = \"slot\" }", "on = { hole = 2 }", "there is no hole 2");
    wrong("[[0, 2.5], [0.5, 2.5]]", "[[2, 3], [3, 3]]", "the crack lies outside of the outline");
    wrong("center = [2.5, 0.5]", "center = [2.5, 0.5], centre = 1", "unknown key");
    let twice = "on = \"outline\"\ntraction = [0, 1]\n[[boundary]]\non = { piece = \"head\" }";
    wrong("on = { piece = \"head\" }", twice, "on the piece `head` is given twice");
    wrong("on = { piece = \"slot\" }", "on = { hole = 1 }", "the only [[hole]] has the number 0");
    wrong("on = { piece = \"slot\" }", "on = \"left\"", "sides of an outline are pieces");
    wrong("[[0, 2.5], [0.5, 2.5]]", "[[0, 2.5], [0, 3]]", "the crack runs along the straight side");
    wrong("name = \"head\"", "name = \"\"", "is empty");
    let flat = "[domain.outline]\npoints = [[0, 0], [1, 0]]\n[material]";
    let (_, rest) = BRACKET.split_once("[material]").expect("it");
    let error = parse(&format!("{flat}{rest}").replace("{ piece = \"head\" }", "\"outline\""));
    let error = error.expect_err("a mistake").to_string();
    assert!(error.contains("the outline encloses nothing"), "{error}");
    let box_around = |min: &str| format!("min = {min}\nmax = [4, 4]\npath = [");
    let with_box = |min| BRACKET.replacen("path = [", &box_around(min), 1);
    for (min, message) in
        [("[0, 0]", "runs along an edge of the box"), ("[2.5, 2.5]", "lies outside of the box")]
    {
        let text = with_box(min).replace("[domain.outline]\nmin", "[domain]\nmin");
        let text = text.replacen("path = [", "[domain.outline]\npath = [", 1);
        let error = parse(&text).expect_err("a mistake").to_string();
        assert!(error.contains(message), "{error}");
    }
}

/// Corners on straight lines, also nearly, are no corners, and names keep their places.
#[test]
fn straight_sides_have_no_corners() {
    let mut random = Random(11);
    for _ in 0..20 {
        let (angle, count) = (random.between(0.0, 7.0), 2 + random.below(50));
        let (sin, cos) = angle.sin_cos();
        let turned = |x: f64, y: f64| vec2(cos * x - sin * y, sin * x + cos * y);
        let corners = [turned(-1.0, -2.0), turned(1.0, -2.0), turned(1.0, 2.0), turned(-1.0, 2.0)];
        let piece = |k: usize| {
            let (a, b) = (corners[k], corners[(k + 1) % 4]);
            let at = |j: usize| a + (b - a) * (j as f64 / count as f64);
            let points: Vec<_> = (0..=count).map(|j| <[f64; 2]>::from(at(j))).collect();
            format!("{{ points = {points:?}, name = \"side {k}\" }}")
        };
        let path = [0, 1, 2, 3].map(piece).join(", ");
        let text = format!(
            "[domain.outline]\npath = [{path}]\n[material]\nyoung = 1\npoisson = 0.3\nstate = \
             \"plane-strain\"\n[[boundary]]\non = {{ piece = \"side 2\" }}\npressure = 1\n\
             [discretization]\nlevel = 2\n"
        );
        let problem = good(&text);
        let Hole::Polygon { points, .. } = &problem.domain().holes[0] else { panic!("a polygon") };
        assert_eq!(points.len(), 4, "{points:?}");
        let piece = |k: usize| BoundaryPiece {
            name: format!("side {k}"),
            runs: vec![BoundaryRange { hole: 0, from: k, to: k + 1 }],
        };
        assert_eq!(problem.pieces(), [0, 1, 2, 3].map(piece));
    }
}

/// Curves are arcs: an arc is one edge, the same by `bulges`; an ellipse and a path have equal
/// tangents at their joints; `segments` is remarked.
#[test]
fn curves_are_arcs() {
    let text = r#"
crack = [
  { arc = { center = [0, -1], radius = 0.5, from = 30, to = 120 }, segments = 9 },
  { points = [[1.0, 1.5], [0.5, 1.5], [0.0, 1.5]], bulges = [-0.4142135623730951, 0.0] },
  { spline = [[-1.8, 0.2], [-1.5, 0.5], [-1.6, 0.9], [-1.2, 1.2]] },
]
hole = [
  { ellipse = { center = [0, 0.2], axes = [0.5, 0.25], angle = 20 } },
  { points = [[-1.2, -1.0], [-0.8, -1.0]], bulges = [1.0, 1.0] },
]
domain = { min = [-2, -2], max = [2, 2] }
[material]
young = 1.0
poisson = 0.3
state = "plane-stress"
[[boundary]]
on = { hole = 1 }
pressure = 1
[discretization]
level = 3
"#;
    let problem = good(text);
    let [arc, bulged, spline] = problem.cracks() else { panic!("three cracks") };
    let (quarter, sixty) = ((std::f64::consts::PI / 8.0).tan(), 3f64.sqrt() / 4.0);
    assert_eq!((arc.points.len(), arc.bulges.len()), (2, 1));
    assert!((arc.bulges[0] - quarter).abs() < 1e-15, "{arc:?}");
    assert!((arc.points[0] - vec2(sixty, -0.75)).length() < 1e-15, "{arc:?}");
    assert_eq!(bulged.bulges, [-0.414_213_562_373_095_1, 0.0]);
    let [ellipse, lens] = &problem.domain().holes[..] else { panic!("two holes") };
    assert!((lens.rim_distance(vec2(-1.0, -0.8))).abs() < 1e-15);
    assert!(!lens.contains(vec2(-1.0, -0.79)) && lens.contains(vec2(-1.0, -0.81)));
    let rim: Vec<_> = ellipse.edges().collect();
    let joints = rim.iter().zip(rim.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]);
    let course: Vec<_> = spline.edges().collect();
    let kinks = course.windows(2).map(|pair| [pair[0], pair[1]]).chain(joints);
    for [before, after] in kinks {
        assert_eq!(before.to, after.from);
        let turn = before.end_tangents()[1] - after.end_tangents()[0];
        assert!(turn.length() < 1e-9, "{before:?} {after:?}");
    }
    let [sin, cos] = [20f64.to_radians().sin(), 20f64.to_radians().cos()];
    for p in rim.iter().map(|edge| edge.at(0.4) - vec2(0.0, 0.2)) {
        let (x, y) = ((cos * p.x + sin * p.y) / 0.5, (cos * p.y - sin * p.x) / 0.25);
        assert!((x.hypot(y) - 1.0).abs() < 5e-9, "{p:?}");
    }
    assert_eq!(problem.arcs(), rim.len() + course.len() + 4);
    let [note] = &problem.notes[..] else { panic!("{:?}", problem.notes) };
    assert!(note.to_string().contains("`segments` in [[crack]] has no effect"), "{note}");
    // pressure on half circles pushes the lens's material away
    let on_lens = problem.stations(0.05);
    assert_eq!(on_lens.len(), 25);
    for station in on_lens {
        let from_center = station.at - vec2(-1.0, -1.0);
        assert!((from_center.length() - 0.2).abs() < 1e-14);
        assert!((station.outward + from_center.unit()).length() < 1e-13);
    }
}

/// A part of a piece with an arc is measured along it.
#[test]
fn parts_of_arcs() {
    let text = BRACKET
        .replacen("from = 270, to = 180 }", "from = 270, to = 180 }, name = \"fillet\"", 1)
        .replacen("piece = \"slot\" }", "piece = \"fillet\", from = 0.4, to = 1.3 }", 1);
    let problem = good(&text);
    let edges: Vec<_> = problem.edges_of(problem.boundary[1].on).collect();
    let length: f64 = edges.iter().map(|edge| edge.length()).sum();
    assert!((length - 0.9).abs() < 1e-14 && edges.len() == 1, "{edges:?}");
    let at = |angle: f64| vec2(2.0 + angle.cos(), 2.0 + angle.sin());
    let from = at(1.5 * std::f64::consts::PI - 0.4);
    assert!((edges[0].from - from).length() < 1e-14, "{edges:?}");
    assert!((edges[0].center() - vec2(2.0, 2.0)).length() < 1e-13);
    let head = problem.edges_of(problem.boundary[0].on).map(|edge| edge.from);
    assert_eq!(head.collect::<Vec<_>>(), [vec2(1.0, 2.0), vec2(1.0, 4.0)]);
}

/// The places of conditions are known while material and cells are missing, those that name no part
/// of the body are left out.
#[test]
fn conditions_have_places_in_texts_that_are_no_problems() {
    let text = "[domain]\nmin = [0, 0]\nmax = [2, 1]\n[[crack]]\npoints = [[0.5, 0.5], [1, 0.5]]\n\n\
                [[boundary]]\non = { edge = \"top\", from = 0.5 }\n[[boundary]]\non = { hole = 3 }\n\
                [[boundary]]\ntraction = [1, 0]\non = { crack = 0, face = \"below\" }\n";
    let found = Problem::body_of(text, Path::new("")).expect("a body");
    assert_eq!(found.load_key, "traction");
    let [top, face] = &found.conditions[..] else { panic!("{:?}", found.conditions) };
    assert_eq!((&*top.on, top.at), ("{ edge = \"top\", from = 0.5 }", [7, 1]));
    assert_eq!(top.part, BoundaryPart::Edge { edge: DomainEdge::Top, from: 0.5, to: 2.0 });
    assert_eq!((&*face.on, face.at), ("{ crack = 0, face = \"below\" }", [11, 1]));
    assert_eq!(face.part, BoundaryPart::Crack { crack: 0, face: Some(Side::Below) });
    let heat = Problem::body_of(&format!("equation.kind = \"poisson\"\n{text}"), Path::new(""));
    assert_eq!(heat.expect("a body").load_key, "flux");
}
