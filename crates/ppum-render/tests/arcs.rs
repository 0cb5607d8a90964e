//! What follows a crack of arcs: isolines, extrema, faces of the deformed body.

use ppum::crack::{Crack, CrackEnd, SegmentId, Side};
use ppum::dataset::Dataset;
use ppum::edge::Edge;
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::vec2::{Vec2, vec2};
use ppum_render::anchored_edge::AnchoredEdge;
use ppum_render::deform::Deformation;
use ppum_render::extrema::{BodyRegion, Extrema, ExtremumSite, extrema};
use ppum_render::isoline::{Isoline, isolines};
use ppum_render::scatter::render;
use ppum_render::view::View;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::opening;

const TIP: Vec2 = vec2(0.3, -0.2);

/// d⊥ √r sin(θ/2) about the tip of a crack of two arcs and a segment from the border, each of them
/// divided into so many parts. θ is that of the curved faces.
fn dataset(parts: u32) -> Dataset {
    let d = vec2(0.8, 0.6);
    let mut dataset = opening(TIP, d);
    let (mouth, joint, end) = (vec2(-1.0, 0.3), vec2(-0.45, 0.25), vec2(-0.35, -0.1));
    let edges = [
        Edge { from: mouth, to: joint, bulge: 0.35 },
        Edge::segment([joint, end]),
        Edge { from: end, to: Vec2::ZERO, bulge: 0.0 },
    ]
    .map(|e| Edge { from: TIP + e.from, to: TIP + e.to, ..e });
    let last = Edge::tangent_to(TIP, -d, edges[2].from).reversed();
    let part = |e: Edge, k: u32| e.part([k, k + 1].map(|k| f64::from(k) / f64::from(parts)));
    let edges: Vec<Edge> = [edges[0], edges[1], last]
        .into_iter()
        .flat_map(|e| (0..parts).map(move |k| part(e, k)))
        .collect();
    dataset.steps[0].cracks = vec![Crack {
        points: edges.iter().map(|e| e.from).chain([TIP]).collect(),
        bulges: edges.iter().map(|e| e.bulge).collect(),
        ends: [CrackEnd::Mouth, CrackEnd::Tip],
    }];
    dataset
}

fn seen(center: Vec2, width: f64, pixels: [u32; 2]) -> View {
    View::new(center, width, pixels).expect("a view")
}

/// Views of the whole, and of arcs, a joint and the tip down to 10⁻¹² of the body.
fn views(crack: &Crack) -> Vec<View> {
    let mut all = vec![seen(TIP + vec2(-0.3, 0.0), 1.2, [90, 70])];
    let last = crack.points.len() - 2;
    for at in [crack.edge(0).at(0.6), crack.points[1], crack.edge(last).at(0.4), TIP] {
        for width in [0.1, 1e-5, 1e-12] {
            all.push(seen(at, width, [61, 47]));
        }
    }
    all
}

fn lines(field: &Field<'_>, view: &View, text: &str) -> Vec<Isoline> {
    let quantity = Quantity::parse(text, field).expect("a quantity");
    let raster = render::<f64>(field, view, &quantity, unwatched()).expect("a raster");
    let mut values: Vec<f64> = raster.values.iter().copied().filter(|v| v.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    let mut levels: Vec<f64> = (1..8).map(|k| values[k * values.len() / 8]).collect();
    levels.dedup();
    isolines(field, view, &quantity, &levels, &raster, unwatched()).expect("lines")
}

/// Lines do not cross arcs, and end on them or at the image's border, at any zoom.
#[test]
fn isolines_end_on_arcs() {
    let dataset = dataset(1);
    let field = Field::new(&dataset, 0).expect("a field");
    let (crack, mut on_faces) = (&dataset.steps[0].cracks[0], 0);
    for view in views(crack) {
        let pixel = view.pixel_size();
        let edges: Vec<_> = crack.edges().map(|e| AnchoredEdge::new(e, view.center)).collect();
        let away = |p: Vec2| {
            let of = |e: &AnchoredEdge| (e.frame.at(e.closest(p)) - p).length();
            edges.iter().map(of).fold(f64::INFINITY, f64::min) / pixel
        };
        let to_border = |p: Vec2| {
            let (half, center) = (view.half(), view.center - TIP);
            let image = (half.x - p.x.abs()).abs().min((half.y - p.y.abs()).abs());
            let body = center + p;
            let body = (1.0 - body.x.abs()).abs().min((1.0 - body.y.abs()).abs());
            image.min(body) / pixel
        };
        for line in lines(&field, &view, "uy").iter().chain(&lines(&field, &view, "ux")) {
            for pair in line.points.windows(2) {
                let crosses = edges.iter().any(|edge| {
                    let [a, b] = [pair[0], pair[1]].map(|p| edge.side(p));
                    let at = edge.frame.place(pair[0] + (pair[1] - pair[0]) * (a / (a - b)));
                    let is_apart = a.abs().min(b.abs()) > 0.02 * pixel;
                    a * b < 0.0 && is_apart && !edge.common([at, at.next_up()]).is_empty()
                });
                assert!(!crosses, "{view:?} {pair:?}");
            }
            if line.closed {
                continue;
            }
            for end in [line.points[0], line.points[line.points.len() - 1]] {
                let (face, border) = (away(end), to_border(end));
                assert!(face.min(border) < 0.03, "{view:?} {end:?} {face} {border}");
                on_faces += usize::from(face < 0.03);
            }
        }
    }
    assert!(on_faces > 20, "{on_faces}");
}

fn extrema_of(field: &Field<'_>, view: &View, quantity: &Quantity) -> Extrema {
    let region = BodyRegion::seen(field, view).expect("a part of the body");
    extrema(field, &region, quantity, unwatched()).expect("a search").expect("values")
}

/// The largest value on the faces in a view, by many points.
fn largest_on_faces(field: &Field<'_>, view: &View, quantity: &Quantity) -> f64 {
    let (crack, mut most) = (&field.step.cracks[0], f64::NEG_INFINITY);
    for (segment, edge) in (0..).zip(crack.edges()) {
        for p in (0..2000).map(|k| edge.at((f64::from(k) + 0.5) / 2000.0)) {
            if view.rect().contains(p) {
                let mut local = field.on(SegmentId { crack: 0, segment }, p);
                let of = |side| quantity.at(&mut local, Vec2::ZERO, side);
                most = [Side::Above, Side::Below].map(of).into_iter().fold(most, f64::max);
            }
        }
    }
    most
}

/// Largest values are those on curved faces, however the arcs are divided.
#[test]
fn extrema_are_found_on_curved_faces() {
    let (whole, parts) = (dataset(1), dataset(7));
    let [whole, parts] = [&whole, &parts].map(|d| Field::new(d, 0).expect("a field"));
    let crack = &whole.step.cracks[0];
    for (at, width) in [(crack.edge(0).at(0.6), 0.4), (crack.edge(2).at(0.4), 0.1)] {
        let view = seen(at, width, [40, 30]);
        for text in ["ux", "uy", "-ux", "-uy"] {
            let quantity = Quantity::parse(text, &whole).expect("a quantity");
            let found = extrema_of(&whole, &view, &quantity);
            let known = largest_on_faces(&whole, &view, &quantity);
            let range = found.max.value - found.min.value;
            assert!(found.max.value >= known - 1e-9 * range, "{text} {found:?} {known}");
            if let ExtremumSite::Face(id, _) = found.max.on {
                let p = found.center + found.max.offset;
                assert!(crack.edge(id.segment as usize).distance(p) < 1e-12, "{found:?}");
                assert!(found.max.value <= known + 1e-4 * range, "{text} {found:?} {known}");
            }
            let divided = extrema_of(&parts, &view, &quantity);
            assert!((divided.max.value - found.max.value).abs() < 1e-9 * range, "{text}");
        }
    }
}

/// Faces are where their points move to, to a tenth of a pixel.
#[test]
fn faces_of_arcs_are_where_they_move_to() {
    let dataset = dataset(1);
    let field = Field::new(&dataset, 0).expect("a field");
    let (crack, factor) = (&dataset.steps[0].cracks[0], 0.2);
    let moved = |segment: usize, p: Vec2, side: Side| {
        let mut local = field.on(SegmentId { crack: 0, segment: segment as u32 }, p);
        let mut u = [Jet::constant(0.0); 2];
        assert!(local.evaluate::<0>(Vec2::ZERO, side, &mut u));
        p + vec2(u[0].v, u[1].v) * factor
    };
    let view = seen(TIP + vec2(-0.4, 0.1), 1.4, [200, 160]);
    let deformed = Deformation::new(&field, factor).expect("a factor").seen(&view);
    let mut random = Random(4);
    for (paths, side) in deformed.faces()[0].iter().zip([Side::Above, Side::Below]) {
        let lines: Vec<[Vec2; 2]> =
            paths.iter().flat_map(|path| path.windows(2).map(|ends| [ends[0], ends[1]])).collect();
        for _ in 0..300 {
            let segment = random.below(3);
            let place = moved(segment, crack.edge(segment).at(random.between(0.0, 1.0)), side);
            if !view.rect().contains(place) {
                continue;
            }
            let distances = lines.iter().map(|l| ppum::segment::distance(*l, place - view.center));
            let away = distances.fold(f64::INFINITY, f64::min) / view.pixel_size();
            assert!(away < 0.15, "{segment} {side:?} {place:?} {away}");
        }
    }
}

/// The deformed body fills its image but for the opened crack, whose area is that between the
/// moved faces.
#[test]
fn the_deformed_body_is_open_between_its_faces() {
    let dataset = dataset(1);
    let field = Field::new(&dataset, 0).expect("a field");
    let view = seen(TIP + vec2(-0.4, 0.1), 0.8, [80, 60]);
    let deformed = Deformation::new(&field, 0.2).expect("a factor").seen(&view);
    let points = deformed.points(unwatched()).expect("points");
    let quantity = Quantity::parse("ux", &field).expect("a quantity");
    let raster = points.raster(&quantity, unwatched()).expect("a raster").values;
    let open = raster.values.iter().filter(|v| v.is_nan()).count();
    assert!(open > 40 && open < raster.values.len() / 2, "{open}");
    // nothing is lost away from the faces
    let lines: Vec<[Vec2; 2]> = deformed.faces()[0]
        .iter()
        .flatten()
        .flat_map(|path| path.windows(2).map(|ends| [ends[0], ends[1]]))
        .collect();
    for (i, j) in (0..80).flat_map(|i| (0..60).map(move |j| (i, j))) {
        let p = view.offset(i, j);
        let upward = [p, p + vec2(0.0, 4.0)];
        let crossings = lines.iter().filter(|l| ppum::segment::gap(**l, upward) == 0.0).count();
        let distances = lines.iter().map(|l| ppum::segment::distance(*l, p));
        let away = distances.fold(f64::INFINITY, f64::min) / view.pixel_size();
        // between the faces a ray upwards crosses one of them only
        if away > 1.0 && crossings % 2 == 0 {
            assert!(!raster.value(i, j).is_nan(), "{i} {j}");
        }
    }
}
