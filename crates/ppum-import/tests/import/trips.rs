//! Random bodies are written, read and compared.

use ppum::edge::Edge;
use ppum::vec2::{Vec2, vec2};
use ppum_import::{BodyDrawing, DrawingFormat, ImportOptions, PlaneCurve, read};
use ppum_testkit::random::Random;

use crate::parts::Body;

fn imported(text: &str, format: DrawingFormat) -> BodyDrawing {
    read(text.as_bytes(), format, &ImportOptions::default())
        .unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn distance(p: Vec2, edges: &[Edge]) -> f64 {
    edges.iter().map(|edge| edge.distance(p)).fold(f64::MAX, f64::min)
}

/// Points of the body lie on the drawing.
fn check(body: &Body, drawing: &BodyDrawing) {
    let outline = drawing.outline.edges();
    let far = body.outline().into_iter().map(|p| distance(p, &outline)).fold(0.0, f64::max);
    assert!(far < 2e-9 * drawing.size, "{far} of {}", drawing.size);
    let mut names: Vec<_> = body.sides.iter().map(|side| side.name.clone()).collect();
    let mut found: Vec<_> = drawing.outline.curves.iter().filter_map(|c| c.name.clone()).collect();
    [&mut names, &mut found].into_iter().for_each(|all| {
        all.sort();
        all.dedup();
    });
    assert_eq!(names, found);
    assert_eq!(
        (drawing.holes.len(), drawing.cracks.len()),
        (body.circles.len(), body.cracks.len())
    );
    for (center, radius) in &body.circles {
        let is_on = |p: Vec2| ((p - *center).length() - radius).abs() < 1e-9 * drawing.size;
        let is_this = |edges: &[Edge]| edges.iter().all(|edge| is_on(edge.at(0.3)));
        assert!(drawing.holes.iter().any(|hole| is_this(&hole.edges())));
    }
    for crack in &body.cracks {
        let is_this =
            |edges: &[Edge]| crack.iter().all(|p| distance(*p, edges) < 1e-9 * drawing.size);
        assert!(drawing.cracks.iter().any(|found| is_this(&found.edges())));
    }
    check_text(body, drawing);
}

/// The problem file is TOML; its outline closes to rounding, piece by piece.
fn check_text(body: &Body, drawing: &BodyDrawing) {
    let text = drawing.problem_file("a \"part\"\n", "part.dxf");
    let table: toml::Table = text.parse().unwrap_or_else(|e| panic!("{e}\n{text}"));
    assert_eq!(table["title"].as_str(), Some("a \"part\"\n"));
    let path = table["domain"]["outline"]["path"].as_array().unwrap();
    let ends: Vec<_> = path.iter().map(ends).collect();
    for (k, [_, end]) in ends.iter().enumerate() {
        let [begin, _] = ends[(k + 1) % ends.len()];
        let gap = (*end - begin).length() / drawing.size.max(end.length());
        // centre and radius are rounded to 1e-14 and angles to 1e-15 at most, radii are 3 sizes
        assert!(gap < 1e-13, "{k} {gap} {text}");
    }
    assert!(
        path.iter().all(|piece| piece["name"].as_str().is_some_and(|n| n.starts_with("side ")))
    );
    let holes = table.get("hole").and_then(|holes| holes.as_array()).map_or(0, Vec::len);
    assert_eq!(holes, body.circles.len());
    if let Some(holes) = table.get("hole").and_then(|holes| holes.as_array()) {
        // also circles of four arcs
        assert!(holes.iter().all(|hole| hole.get("radius").is_some()), "{text}");
    }
}

fn number(value: &toml::Value) -> f64 {
    value.as_float().or(value.as_integer().map(|i| i as f64)).unwrap()
}

fn point(value: &toml::Value) -> Vec2 {
    vec2(number(&value[0]), number(&value[1]))
}

fn ends(piece: &toml::Value) -> [Vec2; 2] {
    let Some(arc) = piece.get("arc") else {
        let points = piece["points"].as_array().unwrap();
        return [point(&points[0]), point(&points[points.len() - 1])];
    };
    ["from", "to"].map(|key| {
        let (sin, cos) = number(&arc[key]).to_radians().sin_cos();
        point(&arc["center"]) + vec2(cos, sin) * number(&arc["radius"])
    })
}

#[test]
fn bodies_of_dxf() {
    let mut random = Random(1);
    for _ in 0..60 {
        let body = Body::random(&mut random);
        check(&body, &imported(&body.dxf(&mut random), DrawingFormat::Dxf));
    }
}

#[test]
fn bodies_of_svg() {
    let mut random = Random(2);
    for _ in 0..60 {
        let body = Body::random(&mut random);
        check(&body, &imported(&body.svg(&mut random), DrawingFormat::Svg));
    }
}

#[test]
fn bodies_of_geo() {
    let mut random = Random(3);
    for _ in 0..60 {
        let body = Body::random(&mut random);
        check(&body, &imported(&body.geo(), DrawingFormat::Geo));
    }
}

/// A grid of squares or of triangles with holes, in both formats: the border is the grid's, and a
/// slit with doubled nodes is a crack.
#[test]
fn meshes() {
    let mut random = Random(4);
    for trial in 0..40 {
        let (nx, ny) = (4 + random.below(5), 4 + random.below(5));
        let grid = Grid { n: [nx, ny], h: random.between(0.1, 2.0), is_split: trial % 2 == 0 };
        let text = if trial % 4 < 2 { grid.msh2() } else { grid.msh4() };
        let drawing = imported(&text, DrawingFormat::Msh);
        assert_eq!((drawing.holes.len(), drawing.cracks.len()), (1, 1), "{text}");
        let area =
            |edges: &[Edge]| edges.iter().map(|edge| edge.from.cross(edge.to)).sum::<f64>() * 0.5;
        let (outline, square) = (area(&drawing.outline.edges()), grid.h * grid.h);
        assert!((outline / (square * (nx * ny) as f64) - 1.0).abs() < 1e-12);
        assert!((area(&drawing.holes[0].edges()) / square - 1.0).abs() < 1e-12);
        let crack = drawing.cracks[0].edges();
        let (from, to) = (crack[0].from, crack[crack.len() - 1].to);
        assert!(((to - from).length() / (2.0 * grid.h) - 1.0).abs() < 1e-12);
        let table: toml::Table = drawing.problem_file("grid", "grid.msh").parse().unwrap();
        let path = table["domain"]["outline"]["path"].as_array().unwrap();
        // collinear points are gone: left and right with names, the others have none
        let named = path.iter().filter(|piece| piece.get("name").is_some());
        let names: Vec<_> = named.map(|piece| piece["name"].as_str().unwrap()).collect();
        assert_eq!((path.len(), names.len()), (4, 2), "{table:?}");
        assert!(path.iter().all(|piece| piece["points"].as_array().unwrap().len() == 2));
    }
}

/// A plate of n squares of side h, without the one at (1, 1); below the edges from (1, 3) to
/// (3, 3) the nodes are doubled at the middle one and, as the crack begins at the left edge of a
/// column inside, single at its ends.
struct Grid {
    n: [usize; 2],
    h: f64,
    is_split: bool,
}

impl Grid {
    fn node(&self, i: usize, j: usize) -> usize {
        1 + i + j * (self.n[0] + 1)
    }

    fn nodes(&self) -> Vec<(usize, Vec2)> {
        let [nx, ny] = self.n;
        let all = (0..=ny).flat_map(|j| (0..=nx).map(move |i| (i, j)));
        let node = |(i, j)| (self.node(i, j), vec2(i as f64, j as f64) * self.h);
        all.map(node).chain([(900, vec2(2.0, 3.0) * self.h)]).collect()
    }

    /// The corners of all elements; below the slit its middle node is the doubled one.
    fn elements(&self) -> Vec<Vec<usize>> {
        let [nx, ny] = self.n;
        let mut all = Vec::new();
        for (i, j) in (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j))).filter(|k| *k != (1, 1)) {
            let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            let node = |(a, b)| if (a, b) == (2, 3) && j == 2 { 900 } else { self.node(a, b) };
            let square = corners.map(node);
            if self.is_split {
                all.push(vec![square[0], square[1], square[2]]);
                all.push(vec![square[0], square[2], square[3]]);
            } else {
                all.push(square.to_vec());
            }
        }
        all
    }

    /// Lines of the left and the right edge.
    fn lines(&self, right: bool) -> Vec<[usize; 2]> {
        let i = if right { self.n[0] } else { 0 };
        (0..self.n[1]).map(|j| [self.node(i, j), self.node(i, j + 1)]).collect()
    }

    fn kind(&self) -> usize {
        if self.is_split { 2 } else { 3 }
    }

    fn msh2(&self) -> String {
        let nodes: Vec<_> =
            self.nodes().iter().map(|(tag, p)| format!("{tag} {:?} {:?} 0\n", p.x, p.y)).collect();
        let line = |group: usize, [a, b]: [usize; 2]| format!("1 1 2 {group} 7 {a} {b}\n");
        let sides = [false, true].map(|right| {
            self.lines(right)
                .into_iter()
                .map(|l| line(5 + usize::from(right), l))
                .collect::<Vec<_>>()
        });
        let faces = self
            .elements()
            .into_iter()
            .map(|nodes| format!("1 {} 2 9 1 {}\n", self.kind(), words(&nodes)));
        let elements: Vec<_> = sides.concat().into_iter().chain(faces).collect();
        format!(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 5 \"wall\"\n1 6 \"pulled end\"\n2 9 \"body\"\n\
             $EndPhysicalNames\n$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
            nodes.len(),
            nodes.concat(),
            elements.len(),
            elements.concat()
        )
    }

    fn msh4(&self) -> String {
        let nodes = self.nodes();
        let tags: String = nodes.iter().map(|(tag, _)| format!("{tag}\n")).collect();
        let places: String =
            nodes.iter().map(|(_, p)| format!("{:?} {:?} 0\n", p.x, p.y)).collect();
        let lines = |right| {
            self.lines(right).iter().map(|[a, b]| format!("1 {a} {b}\n")).collect::<Vec<_>>()
        };
        let [left, right] = [lines(false), lines(true)];
        let faces: Vec<_> =
            self.elements().iter().map(|nodes| format!("1 {}\n", words(nodes))).collect();
        format!(
            "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 6 \"pulled end\"\n$EndPhysicalNames\n$Entities\n1 2 1 0\n\
             1 0 0 0 0\n3 0 0 0 0 1 0 1 5 0\n4 1 0 0 1 1 0 1 6 0\n1 0 0 0 1 1 0 0 0\n$EndEntities\n\
             $Nodes\n1 {n} 1 900\n2 1 0 {n}\n{tags}{places}$EndNodes\n$Elements\n3 9 1 9\n1 3 1 {}\n{}1 4 1 {}\n{}2 1 {} {}\n{}$EndElements\n",
            left.len(),
            left.concat(),
            right.len(),
            right.concat(),
            self.kind(),
            faces.len(),
            faces.concat(),
            n = nodes.len()
        )
    }
}

fn words(nodes: &[usize]) -> String {
    nodes.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
}

/// Bézier curves and B-splines become arcs within the tolerance that is told.
#[test]
fn curves_are_met_within_the_tolerance() {
    let mut random = Random(5);
    for _ in 0..40 {
        let mut number = || random.between(0.2, 1.0);
        let control = [
            vec2(0.0, 0.0),
            vec2(number(), -number()),
            vec2(3.0 - number(), -number()),
            vec2(3.0, 0.0),
        ];
        let [_, p, q, _] = control;
        let d = format!("M 0 0 C {:?} {:?} {:?} {:?} 3 0 V -2 H 0 Z", p.x, -p.y, q.x, -q.y);
        let svg = format!("<svg><path d=\"{d}\"/></svg>");
        let dxf = format!(
            "0\nSECTION\n2\nENTITIES\n0\nSPLINE\n8\na\n70\n8\n71\n3\n72\n8\n73\n4\n40\n0\n40\n0\n40\n0\n40\n0\n40\n1\n40\n1\n40\n1\n40\n1\n\
             10\n0\n20\n0\n10\n{:?}\n20\n{:?}\n10\n{:?}\n20\n{:?}\n10\n3\n20\n0\n0\nLWPOLYLINE\n8\na\n10\n3\n20\n0\n10\n3\n20\n2\n10\n0\n20\n2\n10\n0\n20\n0\n0\nEOF\n",
            p.x, p.y, q.x, q.y
        );
        for (text, format) in [(svg, DrawingFormat::Svg), (dxf, DrawingFormat::Dxf)] {
            let drawing = imported(&text, format);
            let curve =
                drawing.outline.curves.iter().find(|c| matches!(c.curve, PlaneCurve::Edges(_)));
            let edges = curve.unwrap().curve.edges();
            for k in 0..=100 {
                let (s, r) = (f64::from(k) / 100.0, 1.0 - f64::from(k) / 100.0);
                let at = control[0] * (r * r * r)
                    + p * (3.0 * r * r * s)
                    + q * (3.0 * r * s * s)
                    + control[3] * (s * s * s);
                assert!(distance(at, &edges) < 1.2e-8 * drawing.size, "{}", distance(at, &edges));
            }
            assert!(
                drawing.notices.iter().any(|n| n.contains("became arcs")),
                "{:?}",
                drawing.notices
            );
        }
    }
}

/// The examples that are drawn have the arcs of their drawings, as problem files write them; that
/// without other curves is the same as a whole.
#[test]
fn examples_have_the_bodies_of_their_drawings() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let text = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    for (drawing, format, problem) in [
        ("dog-bone.dxf", DrawingFormat::Dxf, text("dog-bone.toml")),
        ("gear-tooth.svg", DrawingFormat::Svg, text("gear-tooth.toml")),
    ] {
        let written = imported(&text(drawing), format).problem_file("part", drawing);
        let body = &written[written.find("[domain").unwrap()..written.find("# Material").unwrap()];
        let is_whole = body.contains("bulges") || problem.contains(body);
        let mut arcs = body.lines().filter(|line| line.contains("arc = "));
        assert!(body.contains("arc = ") && is_whole, "{drawing}: {body}");
        assert!(arcs.all(|line| problem.contains(line)), "{drawing}: {body}");
    }
}
