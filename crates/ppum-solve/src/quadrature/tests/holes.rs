//! Holes: areas, moments and rims against closed forms.

use super::*;
use ppum::crack::{SegmentId, Side};
use ppum::domain::Hole;
use std::f64::consts::PI;

fn circle(x: f64, y: f64, radius: f64) -> Hole {
    Hole::Circle { center: vec2(x, y), radius }
}

fn polygon(points: &[[f64; 2]]) -> Hole {
    Hole::polygon(points.iter().copied().map(Vec2::from).collect())
}

/// The rules of all cells, and those of the rims.
fn with_holes(case: &GeometryCase, holes: &[Hole]) -> (Vec<CellRule>, Vec<EdgeRule>) {
    let geometry = SmoothnessGeometry { holes, ..case.geometry() };
    let quadrature = Quadrature::new(geometry, Orders::for_degree(2));
    let cells =
        || geometry.partition.cell.iter().map(|c| (c, covering_patches(geometry.partition, c)));
    let areas = cells().flat_map(|(c, patches)| quadrature.cell(covered(c, &patches))).collect();
    let rim = |(c, patches): (&Rect, Vec<u32>)| {
        (0..holes.len())
            .flat_map(|hole| quadrature.rim(covered(c, &patches), hole, |_| true))
            .collect::<Vec<_>>()
    };
    (areas, cells().flat_map(rim).collect())
}

fn area(rules: &[CellRule]) -> f64 {
    integrate(rules, |_, _| 1.0)
}

fn length(rules: &[EdgeRule]) -> f64 {
    rules.iter().flat_map(|r| &r.weights).sum()
}

/// Area and second moment of the box −1 … 1 without a round hole, and the length of its rim.
#[test]
fn round_holes_inside() {
    let mut random = Random(5);
    for k in 0..12 {
        let case = GeometryCase::new(graded(&mut random, WeightFunction::Linear), vec![], vec![]);
        let (x, y) = (random.between(-0.3, 0.3), random.between(-0.3, 0.3));
        let r = [0.04, 0.11, 0.3, 0.65][k % 4];
        let (cells, rim) = with_holes(&case, &[circle(x, y, r)]);
        assert_near(area(&cells), 4.0 - PI * r * r, 1e-11, "area");
        let moment = integrate(&cells, |a, o| (a + o).dot(a + o));
        let exact = 8.0 / 3.0 - PI * r * r * (0.5 * r * r + x * x + y * y);
        assert_near(moment, exact, 1e-11, "second moment");
        assert_near(length(&rim), 2.0 * PI * r, 1e-12, "rim");
    }
}

/// Green: the area between rims and boundary from their rules, ∫ x n_x ds.
#[test]
fn rims_close_the_area() {
    let mut random = Random(6);
    let case = GeometryCase::new(graded(&mut random, WeightFunction::Quadratic), vec![], vec![]);
    let star = polygon(&[[-0.8, -0.7], [-0.3, -0.55], [0.1, -0.8], [-0.2, -0.4], [-0.35, 0.1]]);
    for holes in
        [vec![circle(0.41, 0.33, 0.35)], vec![star.clone()], vec![circle(0.5, 0.5, 0.2), star]]
    {
        let (cells, rim) = with_holes(&case, &holes);
        let around: f64 = rim
            .iter()
            .flat_map(|r| (0..r.offsets.len()).map(move |q| (r, q)))
            .map(|(r, q)| r.weights[q] * (r.anchor + r.offsets[q]).x * r.normals[q].x)
            .sum();
        assert_near(area(&cells), 4.0 + around, 1e-11, "area");
    }
}

/// Polygons in both orientations: an area by the shoelace formula.
#[test]
fn polygons_inside() {
    let case = GeometryCase::new(uniform(3), vec![], vec![]);
    let mut points = [[-0.8, -0.7], [0.3, -0.55], [0.71, 0.8], [0.2, 0.4], [-0.35, 0.6]];
    let shoelace: f64 = (0..5)
        .map(|k| {
            let ([x, y], [u, v]) = (points[k], points[(k + 1) % 5]);
            0.5 * (x * v - u * y)
        })
        .sum();
    for _ in 0..2 {
        let (cells, rim) = with_holes(&case, &[polygon(&points)]);
        assert_near(area(&cells), 4.0 - shoelace, 1e-12, "area");
        let inwards = rim.iter().all(|r| {
            let p = r.anchor + r.offsets[0] + r.normals[0] * 1e-6;
            polygon(&points).contains(p)
        });
        assert!(inwards);
        points.reverse();
    }
}

/// Two circles of radius r at the distance d < 2r, over a corner and over each other.
#[test]
fn holes_over_the_border_and_each_other() {
    let case = GeometryCase::new(uniform(2), vec![], vec![]);
    let (cells, rim) = with_holes(&case, &[circle(-1.0, -1.0, 0.7)]);
    assert_near(area(&cells), 4.0 - PI * 0.49 / 4.0, 1e-11, "quarter");
    assert_near(length(&rim), PI * 0.35, 1e-12, "quarter of a rim");
    let (r, d) = (0.4, 0.3);
    let (cells, rim) = with_holes(&case, &[circle(-0.13, 0.1, r), circle(-0.13 + d, 0.1, r)]);
    let half_angle = (0.5 * d / r).acos();
    let lens = 2.0 * r * r * half_angle - d * (r * r - 0.25 * d * d).sqrt();
    assert_near(area(&cells), 4.0 - 2.0 * PI * r * r + lens, 1e-11, "two circles");
    assert_near(length(&rim), 4.0 * r * (PI - half_angle), 1e-11, "their rims");
    let notch = polygon(&[[0.2, -1.0], [0.6, -1.0], [0.6, -0.3], [0.2, -0.3]]);
    let (cells, rim) = with_holes(&case, &[notch]);
    assert_near(area(&cells), 4.0 - 0.28, 1e-13, "notch");
    assert_near(length(&rim), 1.8, 1e-13, "its sides without the mouth");
}

/// Rims beside lines of cells by 1e-2 … 1e-6: what the cells beyond keep or lose is a sliver.
#[test]
fn rims_beside_lines_of_cells() {
    let case = GeometryCase::new(uniform(2), vec![], vec![]);
    for shift in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 0.0] {
        for r in [0.5 * (1.0 + shift), 0.5 * (1.0 - shift)] {
            let (cells, rim) = with_holes(&case, &[circle(0.0, 0.0, r)]);
            assert_near(area(&cells), 4.0 - PI * r * r, 1e-11, &format!("area for {r}"));
            assert_near(length(&rim), 2.0 * PI * r, 1e-11, &format!("rim for {r}"));
        }
    }
}

/// A crack from a rim to a tip: √r around the tip where the crack is not void, and both faces.
#[test]
fn cracks_from_holes() {
    let (mouth, tip) = (vec2(0.1, 0.05), vec2(0.77, 0.05));
    let cracks = vec![crack(&[mouth, tip])];
    let case = GeometryCase::new(uniform(2), cracks, vec![tip]);
    let holes = [circle(-0.1, 0.05, 0.4)];
    let geometry = SmoothnessGeometry { holes: &holes, ..case.geometry() };
    let quadrature = Quadrature::new(geometry, Orders::for_degree(2));
    for side in [Side::Above, Side::Below] {
        let segment = SegmentId { crack: 0, segment: 0 };
        let face = CrackFace { segment, side };
        let faces: Vec<_> = geometry
            .partition
            .cell
            .iter()
            .flat_map(|c| {
                quadrature.face(covered(c, &covering_patches(geometry.partition, c)), face)
            })
            .collect();
        assert_near(length(&faces), 0.77 - 0.3, 1e-13, "the face outside of the hole");
        let sum: f64 = faces
            .iter()
            .flat_map(|r| (0..r.offsets.len()).map(move |q| (r, q)))
            .map(|(r, q)| r.weights[q] / (r.anchor + r.offsets[q] - tip).length().sqrt())
            .sum();
        assert_near(sum, 2.0 * 0.47f64.sqrt(), 1e-12, "1/√r along it");
        let out = if side == Side::Above { -1.0 } else { 1.0 };
        assert!(faces.iter().all(|r| r.face == Some(face) && r.normals[0] == vec2(0.0, out)));
    }
}

/// Patches that meet a cell in a hole alone leave no rule without points.
#[test]
fn no_rule_is_empty() {
    for hole in
        [circle(-1.0, -1.0, 0.9), polygon(&[[-2.0, -2.0], [0.4, -2.0], [0.4, 0.4], [-2.0, 0.4]])]
    {
        let case = GeometryCase::new(uniform(2), vec![], vec![vec2(0.4, 0.4)]);
        let (cells, rim) = with_holes(&case, &[hole]);
        assert!(cells.iter().all(|rule| !rule.offsets.is_empty()));
        assert!(rim.iter().all(|rule| !rule.offsets.is_empty()));
    }
}
