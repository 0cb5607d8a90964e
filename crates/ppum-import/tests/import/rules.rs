//! What is an outline, and what is refused with its place.

use ppum::vec2::vec2;
use ppum_import::{BodyDrawing, DrawingFormat, ImportError, ImportOptions, PlaneCurve, read};

fn svg(elements: &str) -> Result<BodyDrawing, ImportError> {
    let text =
        format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 10 10'>\n{elements}\n</svg>");
    read(text.as_bytes(), DrawingFormat::Svg, &ImportOptions::default())
}

fn geo(text: &str) -> Result<BodyDrawing, ImportError> {
    read(text.as_bytes(), DrawingFormat::Geo, &ImportOptions::default())
}

fn dxf(entities: &str) -> Result<BodyDrawing, ImportError> {
    let lines: Vec<_> = entities.split_whitespace().collect();
    let text = format!("0\nSECTION\n2\nENTITIES\n{}\n0\nENDSEC\n0\nEOF\n", lines.join("\n"));
    read(text.as_bytes(), DrawingFormat::Dxf, &ImportOptions::default())
}

const SQUARE: &str = "<rect width='10' height='10'/>\n";

#[test]
fn errors_name_places_and_remedies() {
    let cases = [
        ("", "no curves"),
        (
            "<path d='M 0 0 H 10 V 10 H 0 V 1'/>",
            "no curve closes: the outline is open from [0.000000, 10.000000] (line 2) to [0.000000, 9.000000] (line 2), a gap of 1",
        ),
        (
            "<rect width='4' height='4'/>\n<rect x='5' width='4' height='3'/>",
            "(line 3) lie beside each other: there is more than one body",
        ),
        (
            "<rect width='4' height='4'/>\n<rect x='3' y='1' width='4' height='1'/>",
            "curves cross or touch at [4.000000, ",
        ),
        (
            "<path d='M 0 0 L 4 4 V 0 L 0 4 Z'/>",
            "curves cross or touch at [2.000000, 8.000000] (line 2 and line 2)",
        ),
        (
            "<path d='M 0 0 H 4'/><path d='M 4 0 V 4'/><path d='M 4 4 H 0 V 0'/><path d='M 4 0 H 8 V 4 H 4'/>",
            "curves meet at",
        ),
        (
            "<rect width='9' height='9'/><rect x='1' y='1' width='6' height='6'/>\n<circle cx='3' cy='3' r='1'/>",
            "(line 3) lies in the hole of line 2",
        ),
        (
            "<rect width='9' height='9'/>\n<path d='M 5 5 H 12'/>",
            "the open curve of line 3, a crack, leaves the body at [12.0",
        ),
        (
            "<rect width='9' height='9'/>\n<circle id='crack' cx='3' cy='3' r='1'/>",
            "(line 3) closes",
        ),
        ("<path d='M 0 0 K 1 1'/>", "line 2: the path is wrong after `K`"),
        ("<path d='M 0 0 L 1 nan'/>", "line 2: the path is wrong after `L`"),
        ("<path d='M 0 0 L 1e300 1e300'/>", "line 2: has numbers that are not finite"),
        ("<g transform='rotate(x)'/>", "line 2: `transform`"),
        ("<rect width='10em' height='4'/>", "line 2: `width` is no length"),
        ("<svg viewBox='0 0 1'/>", "line 2: `viewBox` is not four numbers"),
        ("<g id='a'><use href='#a'/></g>", "line 2: <use> draws itself"),
        ("<g>", "is no XML"),
    ];
    for (elements, message) in cases {
        let error = svg(elements).expect_err(elements).to_string();
        assert!(error.contains(message), "{elements}: {error}");
    }
}

#[test]
fn errors_of_the_other_formats() {
    let cases = [
        ("x", DrawingFormat::Dxf, "line 1: `x` is no group code"),
        ("0\nSECTION\n", DrawingFormat::Dxf, "without EOF"),
        ("0\nSECTION\n2\n", DrawingFormat::Dxf, "amid a pair"),
        ("AutoCAD Binary DXF\r\n", DrawingFormat::Dxf, "binary DXF"),
        (
            "0\nSECTION\n2\nENTITIES\n0\nLINE\n5\nA1\n10\nzwei\n",
            DrawingFormat::Dxf,
            "line 10, handle A1: `zwei` is no number",
        ),
        ("$MeshFormat\n4.1 1 8\n", DrawingFormat::Msh, "line 2: is a binary mesh"),
        ("$MeshFormat\n4 0 8\n", DrawingFormat::Msh, "line 2: is a mesh of format 4"),
        (
            "$MeshFormat\n2.2 0 8\n$Nodes\n3\n1 0 0 0\n",
            DrawingFormat::Msh,
            "line 6: the file ends too early",
        ),
        (
            "$MeshFormat\n2.2 0 8\n$Nodes\n1\n1 0 NaN 0\n",
            DrawingFormat::Msh,
            "line 5: the node has numbers that are not finite",
        ),
        (
            "$MeshFormat\n2.2 0 8\n$Elements\n1\n1 2 0 4 5 6\n",
            DrawingFormat::Msh,
            "line 5: the element has too few nodes, or unknown ones",
        ),
        (
            "Point(1) = {0, 0, 0};\nLine(1) = {1, 2};",
            DrawingFormat::Geo,
            "line 2: Point(2) is not defined",
        ),
        ("Point(1) = {a, 0, 0};", DrawingFormat::Geo, "line 1: `a` is no number"),
        ("\nPoint(1) = {0, 0", DrawingFormat::Geo, "line 2: the statement has no semicolon"),
        ("For i In {1:3}\n", DrawingFormat::Geo, "For has no EndFor"),
        ("Line(1) = {1:1e9};", DrawingFormat::Geo, "at most 100000"),
    ];
    for (text, format, message) in cases {
        let error =
            read(text.as_bytes(), format, &ImportOptions::default()).expect_err(text).to_string();
        assert!(error.contains(message), "{text}: {error}");
    }
}

/// What is left is named by its line, the first one and the number of others.
#[test]
fn unread_things_are_named() {
    let drawing = svg(&(SQUARE.to_owned() + "<text>a</text>\n<text>b</text>\n<use/>")).unwrap();
    assert_eq!(
        drawing.notices,
        [
            "line 3: not read: <text>, and 1 more",
            "line 5: not read: <use> of ``, which is not there"
        ]
    );
    let square = "8 a 90 4 70 1 10 0 20 0 10 1 20 0 10 1 20 1 10 0 20 1";
    let drawing = dxf(&format!(
        "0 LWPOLYLINE {square} 0 HATCH 5 1F 0 TEXT 0 HATCH 0 LINE 8 a 10 3 20 3 11 3 21 3"
    ))
    .unwrap();
    let [hatch, text, short] = &drawing.notices[..] else { panic!("{:?}", drawing.notices) };
    assert!(
        hatch.ends_with("handle 1F: not read: HATCH, and 1 more")
            && text.ends_with("not read: TEXT"),
        "{hatch} {text}"
    );
    assert!(short.ends_with("not read: curve shorter than the tolerance"));
    let text = "Point(1) = {0, 0, 0};\nFor i In {1:3}\n Point(i+1) = {i, 0, 0};\nEndFor\nPoint(2) = {1, 0}; Point(3) = {1, 1};\n\
                Line(1) = {1, 2}; Line(2) = {2, 3};\nLine(3) = {3, 1};\nRotate {{0, 0, 1}, {0, 0, 0}, Pi/2} { Curve{1}; }\n";
    let drawing = geo(text).unwrap();
    assert!(
        drawing.notices.iter().any(|n| n.starts_with("line 2: not read: For")),
        "{:?}",
        drawing.notices
    );
    assert!(
        drawing.notices.iter().any(|n| n.starts_with("line 8: not read: Rotate")),
        "{:?}",
        drawing.notices
    );
}

/// A block inserted twice, mirrored and scaled, is two holes on the layer of the insertions.
#[test]
fn blocks_are_inserted() {
    let text = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nbolt\n10\n1\n20\n1\n0\nCIRCLE\n8\n0\n10\n2\n20\n1\n40\n0.5\n0\nENDBLK\n\
                0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\nplate\n70\n1\n10\n0\n20\n0\n10\n20\n20\n0\n10\n20\n20\n10\n10\n0\n20\n10\n\
                0\nINSERT\n8\nbolts\n2\nbolt\n10\n4\n20\n5\n41\n-2\n42\n2\n70\n2\n44\n10\n0\nEOF\n";
    let drawing = read(text.as_bytes(), DrawingFormat::Dxf, &ImportOptions::default()).unwrap();
    assert_eq!(drawing.about.as_deref(), Some("Lengths are in millimetres."));
    let centers: Vec<_> = drawing
        .holes
        .iter()
        .map(|hole| match &hole.curves[0].curve {
            PlaneCurve::Arc(arc) => (arc.center, arc.radii[1].length()),
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(centers, [(vec2(2.0, 5.0), 1.0), (vec2(12.0, 5.0), 1.0)]);
    assert!(drawing.holes.iter().all(|hole| hole.curves[0].name.as_deref() == Some("bolts")));
    let text = drawing.problem_file("plate", "plate.dxf");
    assert!(
        text.contains("name = \"plate-4\"") && text.contains("center = [12, 5]\nradius = 1\n"),
        "{text}"
    );
}

/// Elements that are not displayed, not visible or not there are no holes, and each is named.
#[test]
fn hidden_elements_are_left_out() {
    let circle = |attributes: &str| format!("<circle cx='5' cy='5' r='1' {attributes}/>");
    let group = |attributes: &str, inner: &str| format!("<g {attributes}>{}</g>", circle(inner));
    let hidden = [
        circle("visibility='hidden'"),
        circle("visibility='collapse'"),
        circle("style='fill:red; visibility : hidden'"),
        circle("style='visibility:hidden !important'"),
        circle("style='visibility:hidden' visibility='visible'"),
        circle("display='none'"),
        circle("style='display:none'"),
        group("visibility='hidden'", ""),
        group("visibility='hidden'", "visibility='inherit'"),
        group("display='none'", "visibility='visible' display='inline'"),
        "<use href='#nothing'/>".to_owned(),
    ];
    for element in hidden {
        let drawing = svg(&(SQUARE.to_owned() + &element)).unwrap();
        assert_eq!((drawing.holes.len(), drawing.notices.len()), (0, 1), "{element}");
        assert!(drawing.notices[0].starts_with("line 3: not read: <"), "{:?}", drawing.notices);
    }
    let shown = [
        circle("visibility='visible'"),
        circle("style='visibility:visible' visibility='hidden'"),
        group("visibility='hidden'", "visibility='visible'"),
        group("style='x-display:none'", ""),
    ];
    for element in shown {
        let drawing = svg(&(SQUARE.to_owned() + &element)).unwrap();
        assert_eq!((drawing.holes.len(), drawing.notices.len()), (1, 0), "{element}");
    }
    let sheet = "<style>.a { display: none }</style>";
    let notices = svg(&(SQUARE.to_owned() + sheet)).unwrap().notices;
    assert!(notices[0].contains("<style>, which may hide elements"), "{notices:?}");
}

/// What stands once and is used, is a part of the page or stands in a view of its own draws the
/// same as what is written out.
#[test]
fn uses_views_and_percentages_draw_what_they_stand_for() {
    let hole = "<path d='M 4 4 h 2 v 1 a 1 0.5 0 0 1 -2 0 z'/>";
    let cases = [
        (
            format!("<defs><g id='h'>{hole}</g></defs><use href='#h' x='1' y='2'/>"),
            format!("<g transform='translate(1 2)'>{hole}</g>"),
        ),
        (
            "<circle id='c' cx='3' cy='3' r='1'/><use xlink:href='#c' xmlns:xlink='http://www.w3.org/1999/xlink' transform='scale(0.5)' x='10'/>".to_owned(),
            "<circle cx='3' cy='3' r='1'/><circle cx='6.5' cy='1.5' r='0.5'/>".to_owned(),
        ),
        (
            format!("<symbol id='s' viewBox='4 4 2 4'>{hole}</symbol><use href='#s' x='5' y='1' width='3' height='2'/>"),
            format!("<g transform='translate(6 1) scale(0.5) translate(-4 -4)'>{hole}</g>"),
        ),
        (
            "<g id='g'><use href='#r'/></g><defs><rect id='r' x='2' y='2' width='1' height='1'/></defs><use href='#g' x='3'/>".to_owned(),
            "<rect x='2' y='2' width='1' height='1'/><rect x='5' y='2' width='1' height='1'/>".to_owned(),
        ),
        (
            "<rect x='10%' y='20%' width='30%' height='40%'/><circle cx='80%' cy='50%' r='10%'/>".to_owned(),
            "<rect x='1' y='2' width='3' height='4'/><circle cx='8' cy='5' r='1'/>".to_owned(),
        ),
        (
            format!("<svg x='1' y='1' width='50%' height='8' viewBox='0 0 10 10' preserveAspectRatio='xMinYMax'>{hole}<rect width='20%' height='20%'/></svg>"),
            format!("<g transform='translate(1 4) scale(0.5)'>{hole}<rect width='2' height='2'/></g>"),
        ),
        (
            format!("<svg width='5' height='8' viewBox='0 0 10 10' preserveAspectRatio='none'>{hole}</svg>"),
            format!("<g transform='scale(0.5 0.8)'>{hole}</g>"),
        ),
        (
            format!("<svg x='2' width='4' height='8' viewBox='3 3 4 4' preserveAspectRatio='xMidYMid slice'>{hole}</svg>"),
            format!("<g transform='translate(0 0) scale(2) translate(-3 -3)'>{hole}</g>"),
        ),
    ];
    let rectangle = "<rect x='-20' y='-20' width='60' height='60'/>";
    for (short, long) in cases {
        let [short_body, long_body] =
            [&short, &long].map(|elements| svg(&(rectangle.to_owned() + elements)).unwrap());
        assert_eq!(short_body.notices, long_body.notices, "{short}");
        let points = |body: &BodyDrawing| -> Vec<_> {
            let edges = body.holes.iter().flat_map(|hole| hole.edges());
            edges.map(|edge| edge.from).collect()
        };
        let [a, b] = [points(&short_body), points(&long_body)];
        assert_eq!(a.len(), b.len(), "{short}");
        let distance = a.iter().zip(&b).map(|(p, q)| (*p - *q).length()).fold(0.0, f64::max);
        assert!(distance < 1e-13, "{short}: {distance}");
    }
}

/// A use is named by its own label, and by what it draws if it has none.
#[test]
fn names_of_uses() {
    let text = "<defs><circle id='hole' cx='2' cy='2' r='1'/></defs><use href='#hole'/><use id='bolt' href='#hole' x='4'/>";
    let names: Vec<_> = svg(&(SQUARE.to_owned() + text))
        .unwrap()
        .holes
        .iter()
        .map(|hole| hole.curves[0].name.clone().unwrap())
        .collect();
    assert_eq!(names, ["hole", "bolt"]);
}

/// Nodes with parameters are nodes; a mesh without faces is a border only if its lines close.
#[test]
fn meshes_with_parameters_or_lines_alone() {
    let nodes = ["0 0", "1 0", "1 1", "0 1"];
    let mesh = |kind: &str, parameters: &str, elements: &[&str]| {
        let nodes = nodes.iter().enumerate();
        let nodes: String =
            nodes.map(|(k, at)| format!("{} {at} 0 {parameters}\n", k + 1)).collect();
        let text = format!(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n${kind}\n4\n{nodes}$End{kind}\n$Elements\n{}\n{}\n$EndElements\n",
            elements.len(),
            elements.join("\n")
        );
        read(text.as_bytes(), DrawingFormat::Msh, &ImportOptions::default())
    };
    let quadrilateral = ["1 3 2 0 1 1 2 3 4"];
    let plain = mesh("Nodes", "", &quadrilateral).unwrap();
    assert_eq!(mesh("ParametricNodes", "2 7 0.5 0.5", &quadrilateral).unwrap(), plain);
    let lines = ["1 1 2 1 1 1 2", "2 1 2 2 2 2 3", "3 1 2 3 3 3 4", "4 1 2 4 4 4 1"];
    assert_eq!(mesh("Nodes", "", &lines).unwrap().outline.edges().len(), 4);
    let error = mesh("Nodes", "", &lines[..3]).unwrap_err().to_string();
    assert!(
        error.contains("no triangles or quadrilaterals") && error.contains("SaveAll"),
        "{error}"
    );
}

/// Gmsh's next free numbers are read; a variable that cannot be read is named where it is set.
#[test]
fn variables_of_geometries() {
    let text = "p = newp; Point(p) = {0, 0}; q = newp;\nPoint(q) = {2, 0}; Point(newp) = {2, 1}; Point(q + 2) = {0, 1};\n\
                l = newl; Line(l) = {p, q}; Line(newc) = {q, 3}; Line(newreg) = {3, 4, 1}; s = news; Curve Loop(newll) = {1:3};";
    let drawing = geo(text).unwrap();
    assert_eq!((drawing.outline.edges().len(), drawing.notices.len()), (4, 0));
    let error = geo("a = 1;\nb = Point{1};\nPoint(a + b) = {0, 0};").unwrap_err().to_string();
    assert!(error.contains("line 3: the value of `b` in line 2 is not read"), "{error}");
}

/// Circles in groups that are squeezed are ellipses; round corners are arcs.
#[test]
fn shapes_of_svg() {
    let drawing = svg("<rect width='10' height='6' rx='1'/><g transform='rotate(30 5 3) scale(1 0.5)'><circle cx='5' cy='6' r='1'/></g>").unwrap();
    let text = drawing.problem_file("a", "a.svg");
    assert!(text.contains("ellipse = { center = [5, 7], axes = [1, 0.5], angle = -30 }"), "{text}");
    assert_eq!(text.matches("arc = {").count(), 4, "{text}");
    // all but the corners are smooth: one side
    assert_eq!(text.matches("name = \"side-1\"").count(), 8, "{text}");
}

/// Names that all curves share are no use: sides between corners get their own.
#[test]
fn sides_are_named() {
    let text = svg(SQUARE).unwrap().problem_file("a", "a.svg");
    for side in 1..=4 {
        assert!(
            text.contains(&format!("# on = {{ piece = \"side-{side}\" }}    # from")),
            "{text}"
        );
    }
}

#[test]
fn layers_are_chosen() {
    let text = "<svg viewBox='0 0 9 9'><rect id='part' width='9' height='9'/><path id='frame' d='M -5 -5 H 20 V 20 H -5 Z'/></svg>";
    let take = |layers: &[&str]| {
        let layers = layers.iter().map(ToString::to_string).collect();
        read(
            text.as_bytes(),
            DrawingFormat::Svg,
            &ImportOptions { layers, ..ImportOptions::default() },
        )
    };
    assert_eq!((take(&[]).unwrap().holes.len(), take(&["part"]).unwrap().holes.len()), (1, 0));
    let error = take(&["parts"]).unwrap_err().to_string();
    assert!(error.contains("it has frame, part"), "{error}");
}

/// Gaps up to the tolerance are closed, exactly; larger ones are told.
#[test]
fn gaps_are_closed() {
    let take = |gap: f64| {
        let text = format!(
            "Point(1) = {{0, 0}}; Point(2) = {{1, 0}}; Point(3) = {{1, 1}}; Point(4) = {{0, {gap:?}}};\nLine(1) = {{1, 2, 3}}; Line(2) = {{3, 4}};"
        );
        read(
            text.as_bytes(),
            DrawingFormat::Geo,
            &ImportOptions { tolerance: 1e-4, layers: Vec::new() },
        )
    };
    let edges = take(5e-5).unwrap().outline.edges();
    assert_eq!(edges[0].from, edges[edges.len() - 1].to);
    assert!(take(2e-4).unwrap_err().to_string().contains("a gap of 0.0002"));
}

/// Lines that are drawn twice count once.
#[test]
fn copies_are_left_out() {
    let side = |a: [i32; 2], b: [i32; 2]| {
        format!("0 LINE 8 0 10 {} 20 {} 11 {} 21 {} ", a[0], a[1], b[0], b[1])
    };
    let sides = side([0, 0], [1, 0]) + &side([1, 0], [0, 1]) + &side([0, 1], [0, 0]);
    let drawing = dxf(&(sides + &side([1, 0], [0, 0]))).unwrap();
    assert_eq!(drawing.outline.edges().len(), 3);
    assert!(drawing.notices[0].contains("copy of another curve"), "{:?}", drawing.notices);
}

/// Ends of cracks that miss a slanted side by the digits of the file lie on it.
#[test]
fn mouths_are_on_the_border() {
    let text = "Point(1) = {0, 0}; Point(2) = {3, 0}; Point(3) = {3, 1}; Line(1) = {1, 2, 3, 1};\n\
                Point(5) = {1.5, MOUTH}; Point(6) = {1.6, 0.2}; Line(2) = {5, 6};";
    for (mouth, is_on) in [("0.4999996", true), ("0.5000004", true), ("0.4999", false)] {
        let crack = &geo(&text.replace("MOUTH", mouth)).unwrap().cracks[0];
        let edge = crack.edges()[0];
        let end = edge.from;
        assert_eq!((3.0 * end.y - end.x).abs() < 1e-15, is_on, "{end:?}");
        assert_eq!(edge.to, vec2(1.6, 0.2));
    }
}
