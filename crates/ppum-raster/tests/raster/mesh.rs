//! Fields on meshes, pixel by pixel.

use ppum::crack::Side;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::mesh::{Clip, Shape};
use ppum::polynomial::PolynomialSpace::{Tensor, Total};
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::vec2::{Vec2, vec2};
use ppum_raster::reference::reference;
use ppum_raster::scatter::{BAND, render, render_batches, render_rows};
use ppum_raster::view::View;
use ppum_testkit::extended::DoubleDouble;
use ppum_testkit::meshes::{
    AffineElement, BivariatePolynomial, MeshBuilder, field, random_polynomial,
};
use ppum_testkit::random::Random;

/// A curved mesh, all elements cut in two by a curve, with a polynomial on each part, and a
/// function of the level field.
fn dataset() -> Dataset {
    let mut random = Random(4);
    let bend = |random: &mut Random, linear: BivariatePolynomial| {
        let small = random_polynomial(random, Total, 3);
        linear.plus(&small.times(&BivariatePolynomial::linear(0.05, 0.0, 0.0)))
    };
    let x = bend(&mut random, BivariatePolynomial::linear(0.0, 1.0, 0.0));
    let y = bend(&mut random, BivariatePolynomial::linear(0.0, 0.0, 1.0));
    let half = MeshBuilder::grid([6, 5], 3, &[x, y]);
    let mut elements = MeshBuilder::default();
    let level = BivariatePolynomial(
        [((0, 1), 1.0), ((1, 0), -0.5), ((2, 0), 0.25), ((0, 0), -0.31)].into(),
    );
    let (mut parts, mut levels) = (Vec::new(), Vec::new());
    let mesh = &half.mesh;
    for k in 0..mesh.len() {
        let [x, y] = &half.maps[k];
        for is_above in [true, false] {
            elements.push(mesh.shape[k], mesh.map_space[k], 3, half.maps[k].clone());
            elements.mesh.clips.push(Clip { field: 1, is_above });
            let space = if mesh.shape[k] == Shape::Square { Tensor } else { Total };
            parts.push((space, 4, random_polynomial(&mut random, space, 4)));
            levels.push((mesh.map_space[k], 6, level.of(x, y)));
        }
    }
    elements.mesh.clip_offsets = (0..=elements.mesh.len() as u64).collect();
    elements.dataset(vec![field("v", &parts), field("phi", &levels)])
}

fn views(dataset: &Dataset) -> Vec<View> {
    let bounds = dataset.domain.bounds;
    let [a, b] = [bounds.min - vec2(0.1, 0.2), bounds.max + vec2(0.1, 0.1)];
    vec![
        View::window(a.x, a.y, b.x, b.y, [83, 67]).expect("a view"),
        View::new(vec2(0.4, 0.45), 0.2, [40, 33]).expect("a view"),
        View::new(vec2(0.4, 0.45), 1e-9, [20, 33]).expect("a view"),
    ]
}

/// The renderer and the evaluation of single points agree, to the pixel on what is outside and what
/// lies on which side.
#[test]
fn pictures_are_those_of_points() {
    let dataset = dataset();
    dataset.check().expect("a mesh");
    let compiled = Field::new(&dataset, 0).expect("a field");
    for view in views(&dataset) {
        for name in ["v", "dv_dx", "gradient", "overlap", "phi:7"] {
            let quantity = Quantity::parse(name, &compiled).expect("a quantity");
            let found = render::<f64>(&compiled, &view, &quantity, unwatched()).expect("drawn");
            let exact = reference(&compiled, &view, &quantity, unwatched()).expect("drawn");
            let most =
                exact.values.iter().filter(|v| v.is_finite()).fold(0.0f64, |m, v| m.max(v.abs()));
            for (a, b) in found.values.iter().zip(&exact.values) {
                let is_same = (a - b).abs() <= 1e-12 * most || a.is_nan() && b.is_nan();
                assert!(is_same, "{name}: {a} {b}");
            }
            let single = render::<f32>(&compiled, &view, &quantity, unwatched()).expect("drawn");
            let pairs = single.values.iter().zip(&found.values);
            assert!(
                pairs.into_iter().all(|(a, b)| a.to_bits() == (*b as f32).to_bits() || b.is_nan())
            );
        }
    }
}

/// Neither threads nor strips change a bit.
#[test]
fn threads_and_strips_change_nothing() {
    let dataset = dataset();
    let compiled = Field::new(&dataset, 0).expect("a field");
    let quantity = Quantity::parse("dv_dy", &compiled).expect("a quantity");
    let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    for view in views(&dataset) {
        let drawn = |threads| {
            let pool =
                rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            pool.install(|| render::<f64>(&compiled, &view, &quantity, unwatched()).expect("drawn"))
        };
        let one = bits(&drawn(1).values);
        assert_eq!(one, bits(&drawn(8).values));
        let mut strips = Vec::new();
        let take = &mut |part: Vec<f64>| strips.extend(part);
        render_batches(&compiled, &view, &quantity, 5, unwatched(), take).expect("drawn");
        assert_eq!(one, bits(&strips));
        let all = view.pixels[1];
        let border = BAND * (all / (2 * BAND));
        let parts = [0..border, border..all].map(|rows| {
            render_rows::<f64>(&compiled, &view, &quantity, rows, unwatched()).expect("drawn")
        });
        assert_eq!(one, bits(&parts.concat()));
    }
}

/// The picture of elements is full: inside the image of the square no pixel is left out, beyond it
/// none is drawn.
#[test]
fn no_pixel_is_lost() {
    let mut elements = MeshBuilder::grid(
        [7, 6],
        1,
        &[BivariatePolynomial::linear(0.0, 1.0, 0.25), BivariatePolynomial::linear(0.0, -0.5, 1.0)],
    );
    elements.mesh.element.reverse();
    let parts = vec![(Total, 0, BivariatePolynomial::linear(1.0, 0.0, 0.0)); elements.mesh.len()];
    let dataset = elements.dataset(vec![field("v", &parts)]);
    let compiled = Field::new(&dataset, 0).expect("a field");
    let view = View::new(vec2(0.6, 0.25), 1.9, [301, 283]).expect("a view");
    let quantity = Quantity::Component(0);
    let found = render::<f64>(&compiled, &view, &quantity, unwatched()).expect("drawn");
    let local = compiled.at(Vec2::ZERO);
    let mut inside = 0;
    for (i, j) in (0..301).flat_map(|i| (0..283).map(move |j| (i, j))) {
        let p = view.center + view.offset(i, j);
        // (1, 0.25; −0.5, 1)⁻¹
        let (s, t) = ((p.x - 0.25 * p.y) / 1.125, (0.5 * p.x + p.y) / 1.125);
        let margin = s.min(1.0 - s).min(t).min(1.0 - t);
        if margin.abs() > 1e-9 {
            assert_eq!(found.value(i, j).is_nan(), margin < 0.0, "{p:?}");
            assert_eq!(local.owner(p, Side::Above).is_some(), margin > 0.0);
            inside += usize::from(margin > 0.0);
        }
    }
    assert!(inside > 20_000, "{inside}");
}

/// Hanging nodes, neighbours of other shapes and degrees, edges that rounding parts: each pixel has
/// the value of the leaf that its centre comes from, found in the unit square by the inverse of an
/// affine map of the plane.
#[test]
fn no_pixel_of_a_quadtree_is_lost() {
    let mut random = Random(6);
    for _ in 0..4 {
        let angle = random.between(-3.0, 3.0);
        let (c, s) = (angle.cos(), angle.sin());
        let plane =
            [BivariatePolynomial::linear(0.1, c, -s), BivariatePolynomial::linear(-0.7, s, c)];
        let (elements, leaves) = MeshBuilder::quadtree(&mut random, 5, 1, &plane);
        let parts: Vec<_> = leaves
            .iter()
            .map(|leaf| {
                let degree = random.below(9) as u8;
                let p = random_polynomial(&mut random, leaf.space(), degree.into());
                (leaf.space(), degree, p)
            })
            .collect();
        let dataset = elements.dataset(vec![field("v", &parts)]);
        let compiled = Field::new(&dataset, 0).expect("a field");
        let middle = vec2(0.1 + 0.5 * (c - s), 0.5 * (c + s) - 0.7);
        let view = View::new(middle, 1.5, [120, 120]).expect("a view");
        let found =
            render::<f64>(&compiled, &view, &Quantity::Component(0), unwatched()).expect("drawn");
        let det = DoubleDouble::product(c, c) + DoubleDouble::product(s, s);
        let mut inside = 0;
        for (i, j) in (0..120).flat_map(|i| (0..120).map(move |j| (i, j))) {
            let offset = view.offset(i, j);
            let [x, y] = [
                DoubleDouble::sum(view.center.x, offset.x) - 0.1,
                DoubleDouble::sum(view.center.y, offset.y) + 0.7,
            ];
            let st = [(x * c + y * s) / det, (y * c - x * s) / det];
            let (xi, near) = (|k: usize| leaves[k].xi(st), st.map(DoubleDouble::to_f64));
            let margin = |k: usize| {
                let AffineElement { shape, origin, scale } = leaves[k];
                shape.margin(
                    [0.0; 2],
                    [(near[0] - origin.x) / scale.x, (near[1] - origin.y) / scale.y],
                )
            };
            let value = found.value(i, j);
            match (0..leaves.len()).max_by(|&a, &b| margin(a).total_cmp(&margin(b))) {
                Some(leaf) if margin(leaf) > 1e-9 => {
                    let (p, size) = (parts[leaf].2.at(xi(leaf)).to_f64(), xi(leaf));
                    let size = parts[leaf].2.magnitude(size.map(DoubleDouble::to_f64)).max(1e-3);
                    assert!((value - p).abs() <= 2e-12 * size, "{value} {p} at {i}, {j}");
                    inside += 1;
                }
                Some(leaf) if margin(leaf) < -1e-9 => assert!(value.is_nan(), "{i}, {j}"),
                _ => {}
            }
        }
        assert!(inside > 5000, "{inside}");
    }
}
