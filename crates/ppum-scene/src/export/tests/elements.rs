//! Meshes of fields on curved elements: a polynomial of the plane, whose elements have it with all
//! digits, so that each triangle can be compared with it.

use std::collections::BTreeMap;

use ppum::field::Field;
use ppum::progress::unwatched;
use ppum::vec2::{Vec2, vec2};
use ppum_testkit::meshes::{BivariatePolynomial, MeshBuilder, field};
use ppum_testkit::random::Random;

use super::super::*;
use super::weights_of;

/// The value of the field.
fn exact(p: Vec2) -> f64 {
    0.3 + p.x - 0.5 * p.y + 0.7 * p.x * p.y - 0.4 * p.x * p.x
}

/// The same of two polynomials.
fn composed(x: &BivariatePolynomial, y: &BivariatePolynomial) -> BivariatePolynomial {
    let scaled =
        |p: &BivariatePolynomial, by: f64| p.times(&BivariatePolynomial::linear(by, 0.0, 0.0));
    let linear =
        scaled(x, 1.0).plus(&scaled(y, -0.5)).plus(&BivariatePolynomial::linear(0.3, 0.0, 0.0));
    linear.plus(&scaled(&x.times(y), 0.7)).plus(&scaled(&x.times(x), -0.4))
}

/// The image of the unit square in the plane, and of one of its points.
fn bent() -> [BivariatePolynomial; 2] {
    let (s, t) =
        (BivariatePolynomial::linear(0.0, 1.0, 0.0), BivariatePolynomial::linear(0.0, 0.0, 1.0));
    let part =
        |p: BivariatePolynomial, by: f64| p.times(&BivariatePolynomial::linear(by, 0.0, 0.0));
    [s.plus(&part(t.times(&t), 0.4)), t.plus(&part(s.times(&t), -0.3))]
}

fn image(s: f64, t: f64) -> Vec2 {
    vec2(s + 0.4 * t * t, t - 0.3 * s * t)
}

fn resolved(elements: &MeshBuilder, accuracy: &Accuracy) -> ExportMesh {
    let part = |k: usize| {
        let [x, y] = &elements.maps[k];
        (elements.mesh.map_space[k], 4, composed(x, y))
    };
    let parts: Vec<_> = (0..elements.mesh.len()).map(part).collect();
    let dataset = elements.dataset(vec![field("v", &parts)]);
    let field = Field::new(&dataset, 0).unwrap();
    let arrays = PointArray::defaults(&field).unwrap();
    assert_eq!(arrays.len(), 2);
    let mesh = resolve(&field, &arrays, accuracy, unwatched()).unwrap();
    assert!(mesh.is_complete && mesh.complaint().is_none(), "{:?}", mesh.complaint());
    mesh
}

/// Interpolation at random points of random triangles.
fn check_values(mesh: &ExportMesh, seed: u64) {
    let (mut random, cell) = (Random(seed), Lagrange::new(mesh.accuracy.order));
    let width = mesh.values.len() / mesh.points.len();
    let triangles: Vec<&[u32]> = mesh.triangles().collect();
    for _ in 0..1000 {
        let triangle = triangles[random.below(triangles.len())];
        let weights = cell.weights(weights_of(&mut random));
        let nodes = || weights.iter().zip(triangle);
        let place = nodes().fold(Vec2::ZERO, |sum, (w, p)| sum + mesh.points[*p as usize] * *w);
        let value: f64 = nodes().map(|(w, p)| w * mesh.values[*p as usize * width]).sum();
        let off = (value - exact(place)).abs();
        assert!(off <= mesh.arrays[0].allowed, "{off} at {place:?}");
    }
}

/// The length of all edges that one triangle has, by the coordinates of their ends or, of points
/// that are shared, by their numbers.
fn open_length(mesh: &ExportMesh, by_number: bool) -> f64 {
    let mut edges: BTreeMap<[[u64; 2]; 2], (usize, f64)> = BTreeMap::new();
    for t in mesh.triangles() {
        for k in 0..3 {
            let ends = [t[k], t[(k + 1) % 3]];
            let [a, b] = ends.map(|p| mesh.points[p as usize]);
            let key = |p: u32| {
                let at = mesh.points[p as usize];
                if by_number { [p.into(), 0] } else { [at.x.to_bits(), at.y.to_bits()] }
            };
            let mut ends = ends.map(key);
            ends.sort_unstable();
            let edge = edges.entry(ends).or_insert((0, (b - a).length()));
            edge.0 += 1;
        }
    }
    assert!(edges.values().all(|(count, _)| *count <= 2));
    edges.values().filter(|(count, _)| *count == 1).map(|(_, length)| length).sum()
}

fn perimeter() -> f64 {
    let at = |k: usize| (k % 1000) as f64 / 1000.0;
    let points: Vec<Vec2> = (0..=4000)
        .map(|k| match k / 1000 {
            0 => image(at(k), 0.0),
            1 => image(1.0, at(k)),
            2 => image(1.0 - at(k), 1.0),
            3 => image(0.0, 1.0 - at(k)),
            _ => image(0.0, 0.0),
        })
        .collect();
    points.windows(2).map(|p| (p[1] - p[0]).length()).sum()
}

/// No vertex lies inside of an edge of another element: edges of one triangle make the outline.
#[test]
fn curved_elements_are_resolved() {
    for (order, tolerance) in [(1, 1e-2), (1, 1e-3), (2, 1e-4), (3, 1e-5)] {
        let elements = MeshBuilder::grid([4, 3], 2, &bent());
        let accuracy = Accuracy { tolerance, order, ..Accuracy::default() };
        let mesh = resolved(&elements, &accuracy);
        check_values(&mesh, 7);
        let off = (open_length(&mesh, false) - perimeter()).abs();
        assert!(off < 3.0 * tolerance || order > 1 && off < 0.1, "{order} {tolerance}: {off}");
        assert!(open_length(&mesh, true) > 2.0 * perimeter(), "each element by itself");
        let averaged = resolved(&elements, &Accuracy { average: true, ..accuracy });
        check_values(&averaged, 8);
        let [shared, all] = [true, false].map(|by_number| open_length(&averaged, by_number));
        assert!((shared - all).abs() < 1e-12, "one piece: {shared} {all}");
    }
}

#[test]
fn hanging_nodes_are_resolved() {
    for seed in 0..4 {
        let (elements, _) = MeshBuilder::quadtree(&mut Random(seed), 4, 2, &bent());
        check_values(&resolved(&elements, &Accuracy::default()), seed);
    }
}
