//! Fields on meshes against polynomials, closed forms and 31 digits.

use ppum::crack::{Crack, CrackEnd, End, Side, TipId};
use ppum::dataset::{Dataset, FieldData};
use ppum::field::Field;
use ppum::function::{Frame, FunctionKind, WESTERGAARD};
use ppum::jet::Jet;
use ppum::mesh::{Clip, Shape};
use ppum::polynomial::PolynomialSpace::{self, Tensor, Total};
use ppum::vec2::{Vec2, vec2};
use ppum_testkit::extended::DoubleDouble;
use ppum_testkit::meshes::{
    BivariatePolynomial, MeshBuilder, field, random_map, random_place, random_polynomial,
};
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::Recipe;

pub(crate) fn compiled(dataset: &Dataset) -> Field<'_> {
    dataset.check().expect("a mesh");
    Field::new(dataset, 0).expect("a field")
}

/// The field at `anchor + offset`, seen from the anchor.
pub(crate) fn jet(field: &Field<'_>, anchor: Vec2, offset: Vec2, side: Side) -> Option<Jet<f64>> {
    let mut jets = [Jet::constant(0.0)];
    field.at(anchor).evaluate::<2>(offset, side, &mut jets).then_some(jets[0])
}

/// The identity of the plane.
fn plane() -> [BivariatePolynomial; 2] {
    [BivariatePolynomial::linear(0.0, 1.0, 0.0), BivariatePolynomial::linear(0.0, 0.0, 1.0)]
}

/// Value and gradient of a polynomial of ξ on a mapped element, with 31 digits.
fn truth(p: &BivariatePolynomial, map: &[BivariatePolynomial; 2], xi: [f64; 2]) -> [f64; 3] {
    let xi = xi.map(DoubleDouble::from);
    let slopes =
        |p: &BivariatePolynomial| [p.derivative([1, 0]).at(xi), p.derivative([0, 1]).at(xi)];
    let ([a, b], [c, d], [p1, p2]) = (slopes(&map[0]), slopes(&map[1]), slopes(p));
    let det = a * d - b * c;
    let gradient = [(d * p1 - c * p2) / det, (a * p2 - b * p1) / det];
    [p.at(xi), gradient[0], gradient[1]].map(DoubleDouble::to_f64)
}

/// Largest errors of value and gradient on random elements, relative to the largest value
/// and slope.
fn errors(
    random: &mut Random,
    (shape, space, map_degree): (Shape, PolynomialSpace, usize),
    (aspect, ratio): (f64, f64),
    degree: usize,
) -> [f64; 2] {
    let map = random_map(random, (shape, space, map_degree), aspect, ratio);
    let mut elements = MeshBuilder::default();
    elements.push(shape, space, map_degree as u8, map.clone());
    let p = random_polynomial(random, space, degree);
    let dataset = elements.dataset(vec![field("v", &[(space, degree as u8, p.clone())])]);
    let field = compiled(&dataset);
    let (mut errors, mut most) = ([0.0f64; 2], [0.0f64; 2]);
    for _ in 0..200 {
        let xi = random_place(random, shape);
        let [anchor, offset] = elements.point(0, xi);
        // seen from itself, and from the other end of the element
        let far = elements.mesh.origin[0];
        for (anchor, offset) in [(anchor, offset), (far, anchor - far)] {
            let found = jet(&field, anchor, offset, Side::Above);
            let found = found.unwrap_or_else(|| {
                panic!(
                    "{xi:?} of {shape:?} {space:?} {map_degree} {map:?} from {anchor:?} {offset:?}"
                )
            });
            let [v, x, y] = truth(&p, &map, xi);
            errors[0] = errors[0].max((found.v - v).abs());
            errors[1] = errors[1].max((found.x - x).hypot(found.y - y));
            most = [most[0].max(v.abs()), most[1].max(x.hypot(y))];
        }
    }
    [0, 1].map(|k| errors[k] / most[k].max(1e-9))
}

/// Every point of an element is found, and values have their digits: affine, bilinear, curved,
/// thin, nearly folded.
#[test]
fn elements_of_all_kinds() {
    let mut random = Random(11);
    for degree in 0..=8 {
        for (shape, space) in
            [(Shape::Triangle, Total), (Shape::Square, Tensor), (Shape::Square, Total)]
        {
            let map = |degree| (shape, space, degree);
            for (case, kind, bend, most) in [
                ("affine", map(1), (0.8, if space == Tensor { 0.5 } else { 1.0 }), 1e-14),
                ("sliver", map(1), (1e-3, 1.0 - 1e-9), 1e-12),
                ("curved", map(4), (0.8, 0.3), 1e-13),
                ("folding", map(4), (0.8, 0.02), 1e-11),
                ("order 8", map(8), (0.8, 0.3), 1e-12),
            ] {
                let [value, slope] = errors(&mut random, kind, bend, degree);
                println!("{case} {shape:?} {space:?} {degree}: {value:.1e} {slope:.1e}");
                assert!(value < most, "{case} {shape:?} {space:?} {degree}: {value:.1e}");
                assert!(slope < 30.0 * most, "{case} {shape:?} {space:?} {degree}: {slope:.1e}");
            }
        }
    }
}

/// A quartic map of the plane, and a quadratic u of the world: of degree 8 on each element. Values,
/// gradients and second derivatives are those of u; all points are owned, those on edges and at
/// corners too.
#[test]
fn a_curved_mesh_reproduces_polynomials() {
    let mut random = Random(3);
    let bend = |random: &mut Random, linear: BivariatePolynomial| {
        let small =
            random_polynomial(random, Total, 4).times(&BivariatePolynomial::linear(0.03, 0.0, 0.0));
        linear.plus(&small)
    };
    let [x, y] = plane().map(|p| bend(&mut random, p));
    let elements = MeshBuilder::grid([5, 4], 4, &[x, y]);
    let u = random_polynomial(&mut random, Total, 2);
    let parts: Vec<_> = (0..elements.mesh.len())
        .map(|k| {
            let [x, y] = &elements.maps[k];
            (elements.mesh.map_space[k], 8, u.of(x, y))
        })
        .collect();
    let dataset = elements.dataset(vec![field("v", &parts)]);
    let field = compiled(&dataset);
    let orders = [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]];
    let partials = orders.map(|order| u.derivative(order));
    for patch in 0..elements.mesh.len() {
        let shape = elements.mesh.shape[patch];
        let inside = (0..20).map(|_| random_place(&mut random, shape)).collect::<Vec<_>>();
        for xi in shape.samples(5).chain(inside) {
            let [anchor, offset] = elements.point(patch, xi);
            let j = jet(&field, anchor, offset, Side::Above).expect("owned");
            let p = [DoubleDouble::sum(anchor.x, offset.x), DoubleDouble::sum(anchor.y, offset.y)];
            let found = [j.v, j.x, j.y, j.xx, j.xy, j.yy];
            for (k, (found, partial)) in found.into_iter().zip(&partials).enumerate() {
                let most = [1e-14, 1e-12, 1e-12, 3e-10, 3e-10, 3e-10][k];
                let error = (found - partial.at(p).to_f64()).abs();
                assert!(error < most, "patch {patch} at {xi:?}, {k}: {error:.1e}");
            }
        }
    }
}

/// Points on shared edges and corners, exactly: the first element in order owns them, whatever it
/// is worth there.
#[test]
fn the_first_element_owns_what_is_shared() {
    let elements = MeshBuilder::grid([4, 4], 1, &plane());
    let n = elements.mesh.len();
    let parts: Vec<_> =
        (0..n).map(|k| (Total, 0, BivariatePolynomial::linear(k as f64, 0.0, 0.0))).collect();
    let dataset = elements.dataset(vec![field("v", &parts)]);
    let field = compiled(&dataset);
    for patch in 0..n {
        let shape = elements.mesh.shape[patch];
        let places: Vec<_> =
            shape.samples(6).filter(|&xi| shape.margin(xi, [0.0; 2]) > 0.01).collect();
        for xi in places {
            let [anchor, offset] = elements.point(patch, xi);
            assert_eq!(jet(&field, anchor, offset, Side::Above).map(|j| j.v), Some(patch as f64));
        }
    }
    // 4 × 4 cells of the size 1/4: the corner (1/4, 1/4) belongs to element 0, a square
    for (x, y, owner) in
        [(0.25, 0.25, 0.0), (0.25, 0.125, 0.0), (0.0, 0.0, 0.0), (0.125, 0.25, 0.0)]
    {
        for anchor in [vec2(x, y), vec2(0.9, 0.1), Vec2::ZERO] {
            let found = jet(&field, anchor, vec2(x, y) - anchor, Side::Above).map(|j| j.v);
            assert_eq!(found, Some(owner), "({x}, {y}) from {anchor:?}");
        }
    }
    // points rounded onto edges have an owner, those beyond the border none
    let mut random = Random(8);
    for _ in 0..20_000 {
        let (a, b) = (random.unit(), random.unit());
        let (k, l) = (random.below(5) as f64 / 4.0, random.below(4) as f64 / 4.0);
        for p in [vec2(k, b), vec2(a, k), vec2(l + 0.25 * a, 0.25 - 0.25 * a)] {
            assert!(jet(&field, Vec2::ZERO, p, Side::Above).is_some(), "{p:?}");
        }
        assert!(jet(&field, Vec2::ZERO, vec2(a, -1e-10), Side::Above).is_none());
        assert!(jet(&field, Vec2::ZERO, vec2(1.0 + 1e-10, b), Side::Above).is_none());
    }
}

/// A square cut twice: the line y = 0, and on its upper side the line x = 0. Three sectors with
/// values 1, 2, 3.
fn junction() -> Dataset {
    let mut elements = MeshBuilder::default();
    for _ in 0..3 {
        elements.push(Shape::Square, Total, 1, plane());
    }
    let clip = |field, is_above| Clip { field, is_above };
    elements.mesh.clip_offsets = vec![0, 1, 3, 5];
    elements.mesh.clips =
        vec![clip(1, false), clip(1, true), clip(2, false), clip(1, true), clip(2, true)];
    let constant = |v: f64| (Total, 0, BivariatePolynomial::linear(v, 0.0, 0.0));
    let [x, y] = plane();
    let level = |p: BivariatePolynomial| vec![(Total, 1, p); 3];
    let values = [1.0, 2.0, 3.0].map(constant);
    elements.dataset(vec![field("v", &values), field("phi", &level(y)), field("psi", &level(x))])
}

#[test]
fn clips_meet_at_a_junction() {
    let dataset = junction();
    let field = compiled(&dataset);
    for (x, y, above, below) in [
        (0.5, 0.5, 3.0, 3.0),
        (-0.5, 0.5, 2.0, 2.0),
        (0.5, -0.5, 1.0, 1.0),
        (0.5, 0.0, 3.0, 1.0),
        (-0.5, 0.0, 2.0, 1.0),
        (0.0, 0.5, 3.0, 2.0),
        (0.0, 0.0, 3.0, 1.0),
        (0.5, 1e-300, 3.0, 3.0),
        (0.5, -1e-300, 1.0, 1.0),
    ] {
        for anchor in [vec2(x, y), vec2(0.7, -0.6)] {
            let offset = vec2(x, y) - anchor;
            if anchor + offset != vec2(x, y) || (offset.y != 0.0 && y.abs() < 1e-99 && y != 0.0) {
                continue;
            }
            let found = [Side::Above, Side::Below]
                .map(|side| jet(&field, anchor, offset, side).map(|j| j.v));
            assert_eq!(found, [Some(above), Some(below)], "({x}, {y})");
        }
    }
}

/// The sign of a level field as a function: on a block beside the smooth one.
#[test]
fn signs_of_level_fields() {
    let mut elements = MeshBuilder::default();
    elements.push(Shape::Square, Total, 1, plane());
    let mut v = field("v", &[(Total, 0, BivariatePolynomial::linear(5.0, 0.0, 0.0))]);
    v.block_function.push(1);
    v.block_degree.push(0);
    v.block_offset.push(1);
    v.coefficients[0].push(2.0);
    v.patch_blocks[1] = 2;
    let mut dataset = elements.dataset(vec![v, field("phi", &[(Total, 1, plane()[1].clone())])]);
    let step = dataset.steps.remove(0);
    dataset.steps.push(step.with_function("sign", FunctionKind::Level { field: 1 }));
    let field = compiled(&dataset);
    let at = |y, side| jet(&field, Vec2::ZERO, vec2(0.25, y), side).map(|j| j.v);
    assert_eq!([at(0.5, Side::Below), at(-0.5, Side::Above)], [Some(7.0), Some(3.0)]);
    assert_eq!([at(0.0, Side::Above), at(0.0, Side::Below)], [Some(7.0), Some(3.0)]);
}

/// A field of the four tip functions in a frame, with blocks of degree 2.
fn tip_field(
    random: &mut Random,
    elements: &MeshBuilder,
    level: [BivariatePolynomial; 2],
    frame: Frame,
) -> Dataset {
    let mut v = FieldData::new("v", &["v"]);
    v.push_patch(&[(1, 2), (2, 2), (3, 2), (4, 2)]);
    v.coefficients[0].iter_mut().for_each(|c| *c = random.between(-1.0, 1.0));
    let [psi, phi] = level.map(|p| (Total, 4, p));
    let mut dataset = elements.dataset(vec![v, field("psi", &[psi]), field("phi", &[phi])]);
    let mut step = dataset.steps.remove(0);
    let direction = vec2(1.0, 0.0);
    step = step.with_crack(Crack::polyline(
        vec![vec2(0.25, 0.125) - direction, vec2(0.25, 0.125)],
        [CrackEnd::Mouth, CrackEnd::Tip],
    ));
    for text in WESTERGAARD {
        step = step.with_function(text, FunctionKind::formula(text, frame));
    }
    dataset.steps.push(step);
    dataset
}

/// Straight level fields are the frame of a tip: values, gradients and second derivatives, on both
/// faces, from 1 to 1e-13.
#[test]
fn straight_levels_are_the_frame_of_a_tip() {
    let mut elements = MeshBuilder::default();
    let map =
        [BivariatePolynomial::linear(0.25, 1.0, 0.5), BivariatePolynomial::linear(0.125, 0.0, 1.0)];
    elements.push(Shape::Square, Total, 1, map);
    let level =
        [BivariatePolynomial::linear(0.0, 1.0, 0.5), BivariatePolynomial::linear(0.0, 0.0, 1.0)];
    let frames = [Frame::Tip(TipId { crack: 0, end: End::Last }), Frame::Levels([1, 2])];
    let datasets = frames.map(|frame| tip_field(&mut Random(4), &elements, level.clone(), frame));
    let fields = datasets.each_ref().map(compiled);
    let (mut random, tip) = (Random(6), vec2(0.25, 0.125));
    for k in 0..1000 {
        let r = 10f64.powf(-13.0 + 13.0 * f64::from(k) / 1000.0);
        let offset = random.direction() * r;
        let [a, b] = fields.each_ref().map(|f| jet(f, tip, offset, Side::Above));
        let (Some(a), Some(b)) = (a, b) else { continue };
        let pairs = [
            (a.v, b.v, 1.0),
            (a.x, b.x, r),
            (a.y, b.y, r),
            (a.xx, b.xx, r * r),
            (a.yy, b.yy, r * r),
        ];
        for (a, b, scale) in pairs {
            let error = (a - b).abs() * scale / r.sqrt();
            assert!(error < 2e-14, "r = {r:.1e}: {a} {b}");
        }
    }
    // behind the tip, on the line of the crack
    let behind = vec2(-0.5, 0.0);
    let [above, below] = [Side::Above, Side::Below]
        .map(|side| fields.each_ref().map(|f| jet(f, tip, behind, side).expect("inside").v));
    assert!((above[0] - above[1]).abs() < 1e-14 && (below[0] - below[1]).abs() < 1e-14);
    assert!((above[0] - below[0]).abs() > 0.01);
}

/// Tip functions of curved level fields on a curved element, around the tip from 1e-3 to 1e-15:
/// against the same with 31 digits' ξ, found by fixed-point iteration of small numbers.
#[test]
fn curved_levels_have_their_digits_near_the_tip() {
    let curve = |linear: BivariatePolynomial, xx: f64, xy: f64, yy: f64| {
        linear.plus(&BivariatePolynomial([((2, 0), xx), ((1, 1), xy), ((0, 2), yy)].into()))
    };
    let [x, y] = plane();
    let map = [curve(x.clone(), 0.125, -0.0625, 0.25), curve(y.clone(), 0.0625, 0.125, -0.125)];
    // the tip at ξ = (1/4, 1/8): polynomials seen from there
    let (s, t) = (
        BivariatePolynomial::linear(-0.25, 1.0, 0.0),
        BivariatePolynomial::linear(-0.125, 0.0, 1.0),
    );
    let seen = |p: &BivariatePolynomial| p.of(&s, &t);
    let mut elements = MeshBuilder::default();
    elements.push(Shape::Square, Total, 2, map.each_ref().map(seen));
    let (psi, phi) = (curve(x, 0.0, 0.25, 0.5), curve(y, -0.25, 0.0, 0.125));
    let mut random = Random(9);
    let level = [seen(&psi), seen(&phi)];
    let dataset = tip_field(&mut random, &elements, level, Frame::Levels([1, 2]));
    let field = compiled(&dataset);
    let one = FunctionKind::formula(WESTERGAARD[1], Frame::Levels([1, 2]));
    let mut simple = dataset.clone();
    simple.steps[0].functions[1].kind = one;
    let coefficients = &mut simple.steps[0].fields[0].coefficients[0];
    coefficients.fill(0.0);
    coefficients[0] = 1.0;
    let simple_field = compiled(&simple);
    assert_eq!(field.components(), 1);
    for k in 0..600 {
        let r = 10f64.powf(-15.0 + 12.0 * f64::from(k) / 600.0);
        let offset = random.direction() * r;
        let mut xi = [offset.x, offset.y];
        for _ in 0..200 {
            let at = |p: &BivariatePolynomial| p.at(xi.map(DoubleDouble::from)).to_f64();
            let rest = [offset.x - at(&map[0]), offset.y - at(&map[1])];
            xi = [xi[0] + rest[0], xi[1] + rest[1]];
        }
        let [a, b] = [&psi, &phi].map(|p| p.at(xi.map(DoubleDouble::from)).to_f64());
        let exact = (0.5 * b.atan2(a)).sin() * a.hypot(b).sqrt();
        let found = jet(&simple_field, Vec2::ZERO, offset, Side::Above).expect("inside");
        let error = (found.v - exact).abs() / r.sqrt();
        assert!(error < 1e-14, "r = {r:.1e}: {error:.1e}");
    }
}

/// Views down to 1e-15 of a curved element keep differences of the field, the place of an edge and
/// that of a cut: all are exact polynomials of small δ.
#[test]
fn deep_zoom_on_an_edge_and_a_cut() {
    let mut random = Random(21);
    let map = random_map(&mut random, (Shape::Square, Total, 4), 0.9, 0.4);
    let mut elements = MeshBuilder::default();
    for _ in 0..2 {
        elements.push(Shape::Square, Total, 4, map.clone());
    }
    let clip = |is_above| Clip { field: 1, is_above };
    (elements.mesh.clip_offsets, elements.mesh.clips) =
        (vec![0, 1, 2], vec![clip(true), clip(false)]);
    // cut by η = 1/4 + (ξ − 1/2)²; the corner of the cut at the edge ξ = 1 lies at η = 1/2
    let cut =
        BivariatePolynomial([((0, 1), 1.0), ((0, 0), -0.5), ((1, 0), 1.0), ((2, 0), -1.0)].into());
    let constant = |v: f64| (Total, 0, BivariatePolynomial::linear(v, 0.0, 0.0));
    let fields = vec![
        field("v", &[constant(1.0), constant(-1.0)]),
        field("phi", &[(Total, 2, cut.clone()), (Total, 2, cut.clone())]),
    ];
    let dataset = elements.dataset(fields);
    let compiled = compiled(&dataset);
    for at in [[1.0, 0.5], [0.5, 0.25], [1.0, 0.125]] {
        let [anchor, rest] = elements.point(0, at);
        let xi = at.map(DoubleDouble::from);
        let d = |p: &BivariatePolynomial, order| p.derivative(order).at(xi).to_f64();
        for width in [1e-6, 1e-9, 1e-12, 1e-15] {
            for _ in 0..200 {
                let delta = [random.between(-width, width), random.between(-width, width)];
                // M(at + δ) − M(at), to the third order
                let step = [0, 1].map(|k| {
                    let p = &map[k];
                    let [a, b] = delta;
                    let first = d(p, [1, 0]) * a + d(p, [0, 1]) * b;
                    let second = d(p, [2, 0]) * a * a / 2.0
                        + d(p, [1, 1]) * a * b
                        + d(p, [0, 2]) * b * b / 2.0;
                    let third = d(p, [3, 0]) * a * a * a / 6.0
                        + d(p, [0, 3]) * b * b * b / 6.0
                        + d(p, [2, 1]) * a * a * b / 2.0
                        + d(p, [1, 2]) * a * b * b / 2.0;
                    first + (second + third)
                });
                let offset = rest + vec2(step[0], step[1]);
                let value = jet(&compiled, anchor, offset, Side::Above).map(|j| j.v);
                let seen =
                    [xi[0] + DoubleDouble::from(delta[0]), xi[1] + DoubleDouble::from(delta[1])];
                let (level, edge) =
                    (cut.at(seen).to_f64(), (DoubleDouble::from(1.0) - seen[0]).to_f64());
                // what rounding of the offset decides is not asked
                let noise = 1e-15 * width.max(1e-17 / width) + 1e-29;
                if level.abs() > noise && edge < -1e-11 {
                    assert_eq!(value, None, "{at:?} {width}");
                } else if level.abs() > noise {
                    assert_eq!(value, Some(level.signum()), "{at:?} {width} {level:e} {edge:e}");
                }
            }
        }
    }
}

/// Where one box alone covers a point φ = 1: the field is that of squares in place of the boxes, in
/// values, gradients and second derivatives.
#[test]
fn boxes_are_squares_where_they_do_not_overlap() {
    let recipe =
        Recipe { cracks: Vec::new(), degrees: vec![3, 2], components: 2, ..Recipe::default() };
    let boxes = recipe.dataset();
    let step = &boxes.steps[0];
    let (partition, data) = (step.partition.boxes(), &step.fields[0]);
    let mut elements = MeshBuilder::default();
    let mut field = FieldData::new("displacement", &["ux", "uy"]);
    for (patch, cell) in partition.cell.iter().enumerate() {
        let (c, h) = (cell.center(), cell.size() * 0.5);
        let map = [
            BivariatePolynomial::linear(c.x, h.x, 0.0),
            BivariatePolynomial::linear(c.y, 0.0, h.y),
        ];
        elements.push(Shape::Square, Total, 1, map);
        let blocks = data.blocks(patch);
        let kinds: Vec<_> =
            blocks.clone().map(|b| (data.block_function[b], data.block_degree[b])).collect();
        field.push_patch(&kinds);
        // ξ of the box is s = h/scale times that of the cell, moved by the distance of
        // their centres
        let (s, d) = (partition.scale[patch], c - partition.origin[patch]);
        let [x, y] = [
            BivariatePolynomial::linear(d.x / s.x, h.x / s.x, 0.0),
            BivariatePolynomial::linear(d.y / s.y, 0.0, h.y / s.y),
        ];
        for (c, out) in field.coefficients_mut(patch).enumerate() {
            let moved = blocks.clone().flat_map(|b| {
                let degree = data.block_degree[b].into();
                let p = BivariatePolynomial::new(Total, degree, data.block_coefficients(b, c));
                p.of(&x, &y).coefficients(Total, degree)
            });
            out.copy_from_slice(&moved.collect::<Vec<_>>());
        }
    }
    let mut mesh = boxes.clone();
    mesh.steps[0].partition = elements.mesh.clone().into();
    mesh.steps[0].fields = vec![field];
    mesh.steps[0].attributes.clear();
    let [a, b] = [&boxes, &mesh].map(|dataset| compiled(dataset));
    let (mut random, mut count) = (Random(5), 0);
    for _ in 0..4000 {
        let p = random.point(&boxes.domain.bounds);
        let mut patches = Vec::new();
        a.tree.query_point(p, &mut patches);
        if patches.len() != 1 {
            continue;
        }
        count += 1;
        let jets = [&a, &b].map(|field| {
            let mut jets = [Jet::constant(0.0); 2];
            assert!(field.at(p).evaluate::<2>(Vec2::ZERO, Side::Above, &mut jets));
            jets
        });
        for (a, b) in jets[0].iter().zip(&jets[1]) {
            for (a, b, most) in
                [(a.v, b.v, 1e-13), (a.x, b.x, 1e-11), (a.y, b.y, 1e-11), (a.xy, b.xy, 1e-9)]
            {
                assert!((a - b).abs() < most, "{p:?}: {a} {b}");
            }
        }
    }
    assert!(count > 400, "{count}");
}

/// Many points at once, on lanes and each from the place of its neighbour, are what they are alone:
/// on a curved mesh cut by a level line, in views as wide as the mesh and 1e-9 of it, with the sign
/// of the level field.
#[test]
fn many_points_are_those_of_single_ones() {
    let mut random = Random(14);
    let bend = |random: &mut Random, linear: BivariatePolynomial| {
        let small =
            random_polynomial(random, Total, 3).times(&BivariatePolynomial::linear(0.05, 0.0, 0.0));
        linear.plus(&small)
    };
    let [x, y] = plane().map(|p| bend(&mut random, p));
    let half = MeshBuilder::grid([6, 5], 3, &[x, y]);
    let cut = BivariatePolynomial(
        [((0, 1), 1.0), ((1, 0), -0.5), ((2, 0), 0.25), ((0, 0), -0.31)].into(),
    );
    let (mut elements, mut parts, mut levels) = (MeshBuilder::default(), Vec::new(), Vec::new());
    for (k, map) in half.maps.iter().enumerate() {
        let space = half.mesh.map_space[k];
        for is_above in [true, false] {
            elements.push(half.mesh.shape[k], space, 3, map.clone());
            elements.mesh.clips.push(Clip { field: 1, is_above });
            parts.push((space, 4, random_polynomial(&mut random, space, 4)));
            levels.push((space, 6, cut.of(&map[0], &map[1])));
        }
    }
    elements.mesh.clip_offsets = (0..=elements.mesh.len() as u64).collect();
    let mut dataset = elements.dataset(vec![field("v", &parts), field("phi", &levels)]);
    let step = dataset.steps.remove(0).with_function("sign", FunctionKind::Level { field: 1 });
    dataset.steps.push(step);
    dataset.steps[0].fields[0].block_function.iter_mut().step_by(3).for_each(|f| *f = 1);
    let field = compiled(&dataset);
    let (mut inside, mut outside) = (0, 0);
    for (anchor, width) in [(vec2(0.5, 0.5), 1.4), (vec2(0.4, 0.45), 0.2), (vec2(0.4, 0.45), 1e-9)]
    {
        let mut local = field.at(anchor);
        let place = |k: i32| vec2(f64::from(k % 40) / 40.0 - 0.5, f64::from(k / 40) / 40.0 - 0.5);
        let offsets: Vec<Vec2> = (0..1600).map(|k| place(k) * width).collect();
        let mut many = vec![Jet::constant(0.0); offsets.len()];
        local.evaluate_into::<2>(&offsets, Side::Above, &mut many);
        for (&offset, found) in offsets.iter().zip(&many) {
            let mut alone = [Jet::constant(0.0)];
            if !local.evaluate::<2>(offset, Side::Above, &mut alone) {
                assert!(found.v.is_nan() && found.yy.is_nan(), "{offset:?}");
                outside += 1;
                continue;
            }
            inside += 1;
            let [one] = alone;
            let pairs = [(found.v, one.v, 1e-12), (found.x, one.x, 1e-10), (found.y, one.y, 1e-10)];
            let second = [(found.xx, one.xx), (found.xy, one.xy), (found.yy, one.yy)];
            let second = second.map(|(a, b)| (a, b, 1e-7));
            for (a, b, most) in pairs.into_iter().chain(second) {
                assert!((a - b).abs() < most, "{offset:?}: {a} {b}");
            }
        }
    }
    assert!(inside > 3000 && outside > 200, "{inside} {outside}");
}

/// One element by its own coordinate, seen from inside and from afar: the map, the field with its
/// gradient and the level field are their polynomials, beyond the edges and the clip too.
#[test]
fn one_element_by_its_coordinate() {
    let mut random = Random(40);
    for case in 0..40 {
        let (shape, space) =
            if case % 2 == 0 { (Shape::Triangle, Total) } else { (Shape::Square, Tensor) };
        let map = random_map(&mut random, (shape, space, 2), 1.0, 0.3);
        let mut elements = MeshBuilder::default();
        elements.push(shape, space, 2, map.clone());
        elements.mesh.clips = vec![Clip { field: 1, is_above: true }];
        elements.mesh.clip_offsets = vec![0, 1];
        let [p, level] = [3, 2].map(|degree| random_polynomial(&mut random, space, degree));
        let fields = [("v", 3, &p), ("level", 2, &level)];
        let fields = fields.map(|(name, degree, p)| field(name, &[(space, degree, p.clone())]));
        let dataset = elements.dataset(fields.to_vec());
        let field = compiled(&dataset);
        let [inside, _] = elements.point(0, random_place(&mut random, shape));
        for anchor in [inside, inside + vec2(30.0, -20.0)] {
            let local = field.at(anchor);
            assert!(local.element(1).is_none());
            let element = local.element(0).expect("a patch");
            let reference = Vec2::from(shape.corners()[0]) - element.corners()[0];
            for _ in 0..20 {
                let xi = random_place(&mut random, shape).map(|x| 1.05 * x);
                let delta = Vec2::from(xi) - reference;
                let point = element.point(delta);
                let exact = map.each_ref().map(|p| p.at(xi.map(DoubleDouble::from)).to_f64());
                // the anchor is up to 40 away
                assert!((anchor + point.offset - Vec2::from(exact)).length() < 1e-13);
                let column = |order| {
                    let slope = |p: &BivariatePolynomial| {
                        p.derivative(order).at(xi.map(DoubleDouble::from))
                    };
                    Vec2::from(map.each_ref().map(|p| slope(p).to_f64()))
                };
                let columns = [column([1, 0]), column([0, 1])];
                let apart = [0, 1].map(|k| (columns[k] - point.columns[k]).length());
                assert!(apart.iter().all(|d| *d < 1e-13), "{apart:?}");
                let mut jets = [Jet::constant(0.0)];
                element.evaluate::<1>((delta, point.offset), Side::Above, &mut jets);
                let [v, x, y] = truth(&p, &map, xi);
                // sums of 16 terms; gradients of maps whose determinants fall to a fourth
                assert!((jets[0].v - v).abs() < 1e-13, "{} {v}", jets[0].v);
                let gradient = vec2(jets[0].x, jets[0].y) - vec2(x, y);
                assert!(gradient.length() < 1e-11 * (1.0 + x.abs() + y.abs()), "{gradient:?}");
                let value = level.at(xi.map(DoubleDouble::from)).to_f64();
                assert!((element.level(1, delta) - value).abs() < 1e-13);
                let margin = shape.margin(xi, [0.0; 2]);
                assert!((element.margin(delta) - margin).abs() < 1e-14);
            }
        }
    }
    let boxes = Recipe::default().dataset();
    let field = Field::new(&boxes, 0).expect("a field");
    assert!(field.at(Vec2::ZERO).element(0).is_none());
}
