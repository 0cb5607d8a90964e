//! Deformed plates of fields on meshes: every element moves as its own polynomials say.
#![allow(clippy::unwrap_used, reason = "a test may fail anywhere")]

use std::f64::consts::PI;

use ppum::crack::Side;
use ppum::dataset::{Dataset, Equation, FieldData, Material, Partition, Step, StressState};
use ppum::domain::Hole;
use ppum::field::Field;
use ppum::function::{Frame, FunctionKind};
use ppum::jet::Jet;
use ppum::mesh::{Clip, Shape};
use ppum::polynomial::PolynomialSpace;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;
use ppum_raster::reference::reference;
use ppum_render::deform::{Deformation, DeformedPoints, TOLERANCE, automatic_factor};
use ppum_render::view::View;
use ppum_testkit::meshes::{BivariatePolynomial, MeshBuilder, field};
use ppum_testkit::random::Random;

const MATERIAL: Material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };

/// A displacement of the plane by polynomials of x and y.
type Displacement = [BivariatePolynomial; 2];

/// The dataset of a mesh on which each patch has polynomials of x and y as its displacement.
fn displaced(elements: &MeshBuilder, by: impl Fn(usize) -> Displacement) -> Dataset {
    let rows = [0, 1].map(|component| {
        let part = |patch: usize| {
            let [x, y] = &elements.maps[patch];
            let mut u = by(patch)[component].of(x, y);
            u.0.retain(|_, c| *c != 0.0);
            let is_square = elements.mesh.shape[patch] == Shape::Square;
            let degree = |(a, b): &(i32, i32)| if is_square { *a.max(b) } else { a + b };
            let space = match is_square {
                true => PolynomialSpace::Tensor,
                false => PolynomialSpace::Total,
            };
            (space, u.0.keys().map(degree).max().unwrap_or(0) as u8, u)
        };
        (0..elements.mesh.len()).map(part).collect::<Vec<_>>()
    });
    let degree = |patch: usize| rows[0][patch].1.max(rows[1][patch].1);
    let rows = rows.each_ref().map(|row| {
        let parts = row.iter().enumerate();
        let parts = parts.map(|(patch, (space, _, u))| (*space, degree(patch), u.clone()));
        field("displacement", &parts.collect::<Vec<_>>())
    });
    let [mut data, second] = rows;
    data.components = vec!["ux".into(), "uy".into()];
    data.coefficients.extend(second.coefficients);
    let mut dataset = elements.dataset(vec![data]);
    dataset.equation = Equation::elasticity(MATERIAL);
    dataset
}

/// Adds a level field, a polynomial of x and y; returns its index.
fn add_level(dataset: &mut Dataset, elements: &MeshBuilder, level: &BivariatePolynomial) -> u32 {
    let part = |patch: usize| {
        let [x, y] = &elements.maps[patch];
        let mut level = level.of(x, y);
        level.0.retain(|_, c| *c != 0.0);
        let degree = level.0.keys().map(|(a, b)| a + b).max().unwrap_or(0) as u8;
        (PolynomialSpace::Total, degree, level)
    };
    let parts: Vec<_> = (0..elements.mesh.len()).map(part).collect();
    let fields = &mut dataset.steps[0].fields;
    fields.push(field(&format!("level {}", fields.len()), &parts));
    fields.len() as u32 - 1
}

/// Each element twice, on both sides of a level field, the other side with another displacement.
fn cut(elements: &MeshBuilder, level: &BivariatePolynomial, by: [Displacement; 2]) -> Dataset {
    let mut twice = MeshBuilder::default();
    for (patch, map) in elements.maps.iter().enumerate() {
        let mesh = &elements.mesh;
        for _ in 0..2 {
            let (space, degree) = (mesh.map_space[patch], mesh.map_degree[patch]);
            twice.push(mesh.shape[patch], space, degree, map.clone());
        }
    }
    let mut dataset = displaced(&twice, |patch| by[patch % 2].clone());
    let index = add_level(&mut dataset, &twice, level);
    let Partition::Mesh(mesh) = &mut dataset.steps[0].partition else { panic!("a mesh") };
    let count = mesh.len();
    mesh.clips = (0..count).map(|k| Clip { field: index, is_above: k % 2 == 0 }).collect();
    mesh.clip_offsets = (0..=count as u64).collect();
    dataset
}

/// a + b x + c y + d x² + …, in the order of total degree.
fn polynomial(coefficients: &[f64]) -> BivariatePolynomial {
    let degree = (0..9).find(|d| (d + 1) * (d + 2) / 2 >= coefficients.len()).unwrap_or(8);
    let mut all = coefficients.to_vec();
    all.resize((degree + 1) * (degree + 2) / 2, 0.0);
    BivariatePolynomial::new(PolynomialSpace::Total, degree, &all)
}

fn value(p: &BivariatePolynomial, at: Vec2) -> f64 {
    p.0.iter().map(|((a, b), c)| c * at.x.powi(*a) * at.y.powi(*b)).sum()
}

fn moved(u: &Displacement, factor: f64, at: Vec2) -> Vec2 {
    at + vec2(value(&u[0], at), value(&u[1], at)) * factor
}

const IDENTITY: [[f64; 3]; 2] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

fn identity() -> Displacement {
    IDENTITY.map(|c| polynomial(&c))
}

/// Strains of up to a third on the unit square.
fn random_displacement(random: &mut Random, degree: usize) -> Displacement {
    [(), ()].map(|()| {
        let count = (degree + 1) * (degree + 2) / 2;
        let size = 0.3 / degree as f64;
        polynomial(&(0..count).map(|_| random.between(-size, size)).collect::<Vec<_>>())
    })
}

fn pixels(view: &View) -> impl Iterator<Item = (u32, u32)> + use<> {
    let [columns, rows] = view.pixels;
    (0..rows).flat_map(move |j| (0..columns).map(move |i| (i, j)))
}

/// The points of a view; all of them move to their pixels by the field of the element that owns
/// them.
fn deformed<'f>(field: &'f Field<'f>, factor: f64, view: &View) -> DeformedPoints<'f> {
    let seen = Deformation::new(field, factor).unwrap().seen(view);
    let points = seen.points(unwatched()).unwrap();
    let mut local = field.at(points.view.anchor);
    let mut jets = [Jet::constant(0.0); 2];
    for (i, j) in pixels(view) {
        for point in points.at(i, j) {
            assert!(local.evaluate::<0>(point.offset, Side::Above, &mut jets), "{i} {j}");
            let x = points.view.anchor + point.offset;
            let image = x + vec2(jets[0].v, jets[1].v) * factor;
            let miss = (image - view.center - view.offset(i, j)).length() / view.pixel_size();
            // a pixel beside a piece's side is found up to a thousandth beyond it
            assert!(miss < TOLERANCE + 1e-3, "{i} {j}: {miss}");
        }
    }
    points
}

/// A view of what polygons hold, and a little more.
fn view_of(corners: impl Iterator<Item = Vec2>, pixels: [u32; 2]) -> View {
    let all = corners.map(|p| Rect::new(p, p)).reduce(|a, b| a.union(&b)).unwrap();
    let room = all.size() * 0.05;
    View::fit(Rect::new(all.min - room, all.max + room), pixels).unwrap()
}

/// The border of the unit square, point by point: chords lie on smooth images to 10⁻⁵.
fn border() -> impl Iterator<Item = Vec2> {
    let corners = [vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(1.0, 1.0), vec2(0.0, 1.0)];
    (0..4 * 250usize).map(move |k| {
        let (side, t) = (k / 250, (k % 250) as f64 / 250.0);
        corners[side] * (1.0 - t) + corners[(side + 1) % 4] * t
    })
}

/// Straight and curved elements with hanging nodes under a polynomial map of the plane, with
/// polynomial displacements: the plate fills the moved border, without a gap between elements, and
/// each pixel's point is the only one that moves there by the polynomial itself.
#[test]
fn plates_fill_their_moved_borders() {
    let mut random = Random(39);
    for case in 0..12 {
        let (degree, curved) = (1 + case % 3, case % 2 == 1);
        let mut plane = identity();
        if curved {
            for p in &mut plane {
                let bend: Vec<f64> = (0..6).map(|_| random.between(-0.1, 0.1)).collect();
                *p = p.plus(&polynomial(&bend));
            }
        }
        let map_degree = if curved { 2 } else { 1 };
        let (elements, _) = MeshBuilder::quadtree(&mut random, 4, map_degree, &plane);
        let u = random_displacement(&mut random, degree);
        let dataset = displaced(&elements, |_| u.clone());
        let field = Field::new(&dataset, 0).unwrap();
        let factor = random.pick(&[1.0, -0.6, 0.8]);
        let rim: Vec<Vec2> = border()
            .map(|p| moved(&u, factor, vec2(value(&plane[0], p), value(&plane[1], p))))
            .collect();
        let view = view_of(rim.iter().copied(), [90, 80]);
        let points = deformed(&field, factor, &view);
        let polygon = Hole::polygon(rim);
        let mut inside = 0;
        for (i, j) in pixels(&view) {
            let place = view.center + view.offset(i, j);
            if polygon.rim_distance(place) < 0.02 * view.pixel_size() {
                continue;
            }
            let found = points.at(i, j);
            let expected = usize::from(polygon.contains(place));
            assert_eq!(found.len(), expected, "{case}: {i} {j} {place:?}");
            if let [point] = found {
                let x = points.view.anchor + point.offset;
                let miss = (moved(&u, factor, x) - place).length();
                assert!(miss < 1.2 * TOLERANCE * view.pixel_size(), "{case} {miss}");
                inside += 1;
            }
        }
        assert!(inside > 1500, "{case}: {inside}");
        same_as_of_boxes(&dataset, &u, factor, &view, curved);
    }
}

/// Of straight meshes of the unit square: the picture of a displacement and of a strain is that of
/// one box with the same polynomials as formulas.
fn same_as_of_boxes(dataset: &Dataset, u: &Displacement, factor: f64, view: &View, curved: bool) {
    if curved {
        return;
    }
    let boxes = by_formulas(u.each_ref().map(text));
    let fields = [Field::new(dataset, 0).unwrap(), Field::new(&boxes, 0).unwrap()];
    for name in ["ux", "exy"] {
        let [a, b] = fields.each_ref().map(|field| {
            let quantity = Quantity::parse(name, field).unwrap();
            let points = Deformation::new(field, factor).unwrap().seen(view).points(unwatched());
            points.unwrap().raster(&quantity, unwatched()).unwrap().values
        });
        let (mut same, mut apart) = (0, 0);
        for (a, b) in a.values.iter().zip(&b.values) {
            if a.is_nan() || b.is_nan() {
                apart += usize::from(a.is_nan() != b.is_nan());
                continue;
            }
            // both within a hundredth of a pixel of the place
            assert!((a - b).abs() < 0.02 * view.pixel_size(), "{name}: {a} {b}");
            same += 1;
        }
        // at most those within rounding of the border
        assert!(same > 1500 && apart <= 2, "{same} {apart}");
    }
}

fn text(p: &BivariatePolynomial) -> String {
    let terms = p.0.iter().map(|((a, b), c)| format!("({c:?})*x^{a}*y^{b}"));
    terms.collect::<Vec<_>>().join(" + ")
}

/// One patch over the unit square on which both components are formulas.
fn by_formulas(texts: [String; 2]) -> Dataset {
    let bounds = Rect::new(Vec2::ZERO, vec2(1.0, 1.0));
    let cover = ppum::cover::Cover::uniform(bounds, 0).unwrap();
    let partition = cover.partition(1.5, WeightFunction::Linear).unwrap();
    let mut field = FieldData::new("displacement", &["ux", "uy"]);
    field.push_patch(&[(0, 0), (1, 0)]);
    field.coefficients[0][0] = 1.0;
    field.coefficients[1][1] = 1.0;
    let mut step = Step::new(partition);
    for (name, text) in ["a", "b"].into_iter().zip(&texts) {
        step = step.with_function(name, FunctionKind::formula(text, Frame::World));
    }
    Dataset::new(bounds, Equation::elasticity(MATERIAL)).with_step(step.with_field(field))
}

/// The corners of an element of the plane, counter-clockwise.
fn corners(elements: &MeshBuilder, patch: usize) -> Vec<Vec2> {
    let corners = elements.mesh.shape[patch].corners();
    corners.iter().map(|&xi| elements.mesh.image(patch, xi).0).collect()
}

/// Discontinuous elements, each moved and stretched as it likes: a pixel has as many points as
/// moved polygons hold it. Edges that have come apart are borders.
#[test]
fn elements_come_apart_and_overlap() {
    let mut random = Random(7);
    let (mut gaps, mut overlaps) = (0, 0);
    for case in 0..6 {
        let elements = MeshBuilder::grid([4, 3], 1, &identity());
        let all: Vec<Displacement> = (0..elements.mesh.len())
            .map(|_| {
                [(), ()].map(|()| {
                    let shift = random.between(-0.06, 0.06);
                    let slope = [(), ()].map(|()| random.between(-0.1, 0.1));
                    polynomial(&[shift, slope[0], slope[1]])
                })
            })
            .collect();
        let dataset = displaced(&elements, |patch| all[patch].clone());
        let field = Field::new(&dataset, 0).unwrap();
        let of_patch = |patch: usize| {
            let corners = corners(&elements, patch);
            corners.into_iter().map(|p| moved(&all[patch], 1.0, p)).collect::<Vec<_>>()
        };
        let polygons: Vec<Vec<Vec2>> = (0..all.len()).map(of_patch).collect();
        let view = view_of(polygons.iter().flatten().copied(), [100, 90]);
        let points = deformed(&field, 1.0, &view);
        let holes: Vec<Hole> = polygons.iter().map(|p| Hole::polygon(p.clone())).collect();
        for (i, j) in pixels(&view) {
            let place = view.center + view.offset(i, j);
            let near = |hole: &Hole| hole.rim_distance(place) < 0.02 * view.pixel_size();
            if holes.iter().any(near) {
                continue;
            }
            let expected = holes.iter().filter(|hole| hole.contains(place)).count();
            assert_eq!(points.at(i, j).len(), expected, "{case}: {i} {j}");
            gaps += usize::from(expected == 0);
            overlaps += usize::from(expected > 1);
        }
        // every edge has come apart nearly everywhere
        let length = |path: &[Vec2]| path.windows(2).map(|p| (p[1] - p[0]).length()).sum::<f64>();
        let outline: f64 = points.view.outline([None; 2]).iter().map(|path| length(path)).sum();
        let edges: f64 = points.view.element_edges().iter().map(|path| length(path)).sum();
        let closed = |p: &Vec<Vec2>| length(p) + (p[0] - p[p.len() - 1]).length();
        let exact: f64 = polygons.iter().map(closed).sum();
        assert!((edges / exact - 1.0).abs() < 1e-3, "{edges} {exact}");
        assert!(outline > 0.7 * exact && outline <= 1.001 * exact, "{outline} {exact}");
    }
    assert!(gaps > 1000 && overlaps > 1000, "{gaps} {overlaps}");
}

/// Where the plate has gone is known wherever the view is.
#[test]
fn bounds_follow_the_plate() {
    let (elements, _) = MeshBuilder::quadtree(&mut Random(3), 5, 1, &identity());
    let dataset = displaced(&elements, |_| [5.0, 1.0].map(|c| polynomial(&[c, 0.0, 0.0])));
    let field = Field::new(&dataset, 0).unwrap();
    let bounds = Rect::new(Vec2::ZERO, vec2(1.0, 1.0));
    let view = View::fit(bounds, [300, 300]).unwrap();
    for factor in [0.0, 1.0, -7.0] {
        let seen = Deformation::new(&field, factor).unwrap().seen(&view);
        let found = seen.element_bounds().expect("a mesh");
        let shift = vec2(5.0, 1.0) * factor;
        let apart =
            (found.min - bounds.min - shift).length() + (found.max - bounds.max - shift).length();
        assert!(apart < 1e-12, "{found:?}");
    }
}

/// Continuous displacements: the outline is the border, whatever hangs.
#[test]
fn the_outline_is_the_border_alone() {
    let mut random = Random(3);
    let (elements, _) = MeshBuilder::quadtree(&mut random, 5, 1, &identity());
    let dataset = displaced(&elements, |_| [0.0, 0.5].map(|c| polynomial(&[0.1, c, 0.0])));
    let field = Field::new(&dataset, 0).unwrap();
    let view = View::fit(Rect::new(vec2(-0.1, -0.1), vec2(1.4, 1.4)), [300, 300]).unwrap();
    // u = (0.1, 0.1 + x/2): a parallelogram
    let seen = Deformation::new(&field, 0.5).unwrap().seen(&view);
    let length = |path: &Vec<Vec2>| path.windows(2).map(|p| (p[1] - p[0]).length()).sum::<f64>();
    let outline = seen.outline([None; 2]);
    let total: f64 = outline.iter().map(length).sum();
    // no edge begins at the border
    let shortest = outline.iter().map(length).fold(f64::INFINITY, f64::min);
    assert!(shortest > 0.03, "{shortest}");
    let exact = 2.0 + 2.0 * vec2(1.0, 0.25).length();
    assert!((total - exact).abs() < 1e-6, "{total} {exact}");
}

/// Where the level is positive the plate moves by one displacement, elsewhere by the other: pixel
/// by pixel, on straight and curved lines, of clipped patches and of functions of the level's sign.
#[test]
fn cut_elements_open_like_cracks() {
    let by = [vec2(0.03, 0.05), vec2(-0.04, -0.03)];
    let constant = |u: Vec2| [polynomial(&[u.x]), polynomial(&[u.y])];
    let straight = polynomial(&[-0.45, 0.3, 0.7]);
    // (x − 0.4)² + (y − 0.55)² − 0.3²
    let circle = polynomial(&[0.16 + 0.3025 - 0.09, -0.8, -1.1, 1.0, 0.0, 1.0]);
    for (case, level) in [&straight, &circle].into_iter().enumerate() {
        for is_clipped in [true, false] {
            let elements = MeshBuilder::grid([5, 4], 1, &identity());
            let dataset = match is_clipped {
                true => cut(&elements, level, by.map(constant)),
                false => jumping(&elements, level, by),
            };
            let field = Field::new(&dataset, 0).unwrap();
            let square = Rect::new(Vec2::ZERO, vec2(1.0, 1.0));
            let view = View::fit(Rect::new(vec2(-0.1, -0.1), vec2(1.1, 1.1)), [150, 150]).unwrap();
            let points = deformed(&field, 1.0, &view);
            let (mut empty, mut double) = (0, 0);
            for (i, j) in pixels(&view) {
                let place = view.center + view.offset(i, j);
                let sides = [0, 1].map(|k| {
                    let x = place - by[k];
                    let level = value(level, x) * [1.0, -1.0][k];
                    // slopes of the levels near their zeros are 0.6 to 0.8
                    let inner = (x - square.min).min(square.max - x);
                    level.min(inner.x).min(inner.y)
                });
                if sides.iter().any(|side| side.abs() < 0.05 * view.pixel_size()) {
                    continue;
                }
                let expected = sides.iter().filter(|side| **side > 0.0).count();
                let found = points.at(i, j).len();
                assert_eq!(found, expected, "{case} {is_clipped}: {i} {j} {sides:?}");
                empty += usize::from(expected == 0 && square.contains(place));
                double += usize::from(expected == 2);
            }
            assert!(empty > 100 && (case == 0 || double > 50), "{empty} {double}");
            faces_lie_on_the_level(&points, level, by);
        }
    }
}

/// One patch an element, with functions of the level's sign.
fn jumping(elements: &MeshBuilder, level: &BivariatePolynomial, by: [Vec2; 2]) -> Dataset {
    let mut dataset = displaced(elements, |_| identity());
    let index = add_level(&mut dataset, elements, level);
    let mut data = FieldData::new("displacement", &["ux", "uy"]);
    for patch in 0..elements.mesh.len() {
        data.push_patch(&[(0, 0), (1, 0)]);
        let [mean, half] = [(by[0] + by[1]) * 0.5, (by[0] - by[1]) * 0.5];
        for (row, [a, b]) in [[mean.x, half.x], [mean.y, half.y]].into_iter().enumerate() {
            data.coefficients[row][2 * patch] = a;
            data.coefficients[row][2 * patch + 1] = b;
        }
    }
    let step = &mut dataset.steps[0];
    step.fields[0] = data;
    let kind = FunctionKind::Level { field: index };
    *step = step.clone().with_function("sign", kind);
    dataset
}

/// Both faces are drawn, to a tenth of a pixel, without gaps.
fn faces_lie_on_the_level(points: &DeformedPoints<'_>, level: &BivariatePolynomial, by: [Vec2; 2]) {
    let view = &points.view.view;
    let mut lengths = [0.0; 2];
    for path in points.view.cut_faces() {
        let ends = [path[0], path[1]].map(|p| view.center + p);
        let off = |k: usize| ends.map(|p| (value(level, p - by[k]) / 0.6).abs());
        let is_on = |k: &usize| off(*k).iter().all(|d| *d < 0.1 * view.pixel_size());
        let side = [0, 1].into_iter().find(is_on).expect("on one of the faces");
        lengths[side] += (ends[1] - ends[0]).length();
    }
    // the line across the unit square, and the circle
    let exact =
        if level.0.contains_key(&(2, 0)) { 0.6 * PI } else { vec2(1.0, 3.0 / 7.0).length() };
    // where a piece is thinner than its curve's chord is off, its side counts for the other face
    assert!(lengths.iter().all(|length| (length / exact - 1.0).abs() < 0.02), "{lengths:?}");
}

/// Functions of two level fields about a tip: u_y = c √r sin(θ/2) opens a parabola, empty inside,
/// with one point everywhere else, also at 10⁻⁶ of the plate.
#[test]
fn an_enriched_tip_opens_a_parabola() {
    let (tip, c) = (vec2(0.53, 0.47), 0.1);
    let elements = MeshBuilder::grid([5, 4], 1, &identity());
    let mut dataset = displaced(&elements, |_| identity());
    let along = add_level(&mut dataset, &elements, &polynomial(&[-tip.x, 1.0, 0.0]));
    let beside = add_level(&mut dataset, &elements, &polynomial(&[-tip.y, 0.0, 1.0]));
    let mut data = FieldData::new("displacement", &["ux", "uy"]);
    for patch in 0..elements.mesh.len() {
        data.push_patch(&[(1, 0)]);
        data.coefficients[1][patch] = c;
    }
    let step = &mut dataset.steps[0];
    step.fields[0] = data;
    let kind = FunctionKind::formula("sqrt(r)*sin(theta/2)", Frame::Levels([along, beside]));
    *step = step.clone().with_function("tip", kind);
    let field = Field::new(&dataset, 0).unwrap();
    for width in [0.8, 1e-3, 1e-6] {
        let seen = Deformation::new(&field, 1.0).unwrap().around(tip, width, [90, 80]).unwrap();
        let points = seen.points(unwatched()).unwrap();
        let mut empty = 0;
        for (i, j) in pixels(&seen.view) {
            let place = seen.view.offset(i, j);
            // the face is x = −(y/c)², steep at the tip: its distance is no more than that in x
            let end = -(place.y / c).powi(2);
            let steep = 1.0 + (2.0 * place.y / (c * c)).abs();
            if (place.x - end).abs() < 0.05 * steep * seen.view.pixel_size() {
                continue;
            }
            let expected = usize::from(place.x > end);
            assert_eq!(points.at(i, j).len(), expected, "{width}: {i} {j} {place:?} {end}");
            empty += 1 - expected;
        }
        assert!(empty > 300, "{width}: {empty}");
    }
}

/// At 10⁻⁹ and 10⁻¹² about a node every pixel has its one point, in each of the elements around.
#[test]
fn nodes_are_whole_at_any_zoom() {
    let mut random = Random(12);
    let elements = MeshBuilder::grid([3, 3], 1, &identity());
    let u = random_displacement(&mut random, 2);
    let dataset = displaced(&elements, |_| u.clone());
    let field = Field::new(&dataset, 0).unwrap();
    let deformation = Deformation::new(&field, 1.0).unwrap();
    let node = vec2(1.0 / 3.0, 2.0 / 3.0);
    for width in [1e-3, 1e-9, 1e-12] {
        let view = deformation.around(node, width, [40, 40]).unwrap();
        let points = view.points(unwatched()).unwrap();
        let mut owners = std::collections::BTreeSet::new();
        let local = field.at(view.anchor);
        for (i, j) in pixels(&view.view) {
            let [point] = points.at(i, j) else { panic!("{width}: {i} {j} {:?}", points.at(i, j)) };
            owners.extend(local.owner(point.offset, Side::Above));
        }
        assert!(owners.len() > 3, "{width}: {owners:?}");
    }
}

/// Of elements that overlap the first owns a point: what another one would move is not there.
#[test]
fn points_belong_to_the_first_element() {
    let mut elements = MeshBuilder::default();
    for shift in [0.0, 0.5] {
        let map = [polynomial(&[shift, 0.5, 0.0]), polynomial(&[0.0, 0.0, 0.5])];
        elements.push(Shape::Square, PolynomialSpace::Total, 1, map);
    }
    let by = [0.0, 0.3].map(|y| [polynomial(&[0.0]), polynomial(&[y])]);
    let dataset = displaced(&elements, |patch| by[patch].clone());
    let field = Field::new(&dataset, 0).unwrap();
    let view = View::fit(Rect::new(vec2(-0.6, -0.6), vec2(1.1, 0.9)), [80, 80]).unwrap();
    let points = deformed(&field, 1.0, &view);
    let squares = [
        Rect::new(vec2(-0.5, -0.5), vec2(0.5, 0.5)),
        // the half that the first element does not own, moved up
        Rect::new(vec2(0.5, -0.2), vec2(1.0, 0.8)),
    ];
    for (i, j) in pixels(&view) {
        let place = view.center + view.offset(i, j);
        let expected = squares.iter().filter(|square| square.contains(place)).count();
        assert_eq!(points.at(i, j).len(), expected, "{place:?}");
    }
}

/// Without displacement the picture is the undeformed one.
#[test]
fn factor_zero_changes_nothing() {
    let mut random = Random(21);
    let plane = [polynomial(&[0.0, 1.0, 0.1, 0.2]), polynomial(&[0.0, 0.0, 1.0, 0.0, 0.2])];
    let (elements, _) = MeshBuilder::quadtree(&mut random, 3, 2, &plane);
    let u = random_displacement(&mut random, 2);
    let dataset = displaced(&elements, |_| u.clone());
    let field = Field::new(&dataset, 0).unwrap();
    let view = View::fit(dataset.domain.bounds, [70, 60]).unwrap();
    let points = deformed(&field, 0.0, &view);
    for name in ["uy", "von-mises"] {
        let quantity = Quantity::parse(name, &field).unwrap();
        let same = reference(&field, &view, &quantity, unwatched()).unwrap();
        let found = points.raster(&quantity, unwatched()).unwrap();
        for (a, b) in same.values.iter().zip(&found.values.values) {
            // from another anchor; stresses jump where rounding decides the element
            let is_same = (a - b).abs() <= 1e-10 * (1.0 + a.abs());
            assert!(is_same || a.is_nan() && b.is_nan(), "{name} {a} {b}");
        }
    }
    // elements as values, and the factor of a displacement that is known
    let numbers: Vec<f64> = (0..elements.mesh.len()).map(|k| k as f64).collect();
    let cells = points.cells(&numbers).values;
    let expected = ppum_render::cells::raster(&field, &numbers, &view);
    let pairs = || cells.values.iter().zip(&expected.values);
    assert!(pairs().filter(|(a, b)| a.to_bits() != b.to_bits()).count() <= 2);
    assert!(pairs().filter(|(a, _)| a.is_finite()).count() > 2000);
    let factor = automatic_factor(&[&field], &field.domain.bounds).unwrap();
    assert!(factor > 0.01 && factor < 100.0, "{factor}");
}
