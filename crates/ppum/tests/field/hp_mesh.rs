//! Meshes with hanging nodes, neighbours of other shapes and degrees, and shared edges that
//! rounding parts.

use ppum::crack::Side;
use ppum::polynomial::PolynomialSpace::{self, Total};
use ppum::vec2::Vec2;
use ppum_testkit::extended::DoubleDouble;
use ppum_testkit::meshes::{
    AffineElement, BivariatePolynomial, MeshBuilder, field, random_polynomial,
};
use ppum_testkit::random::Random;

use crate::mesh::{compiled, jet};

/// A map of the plane, turned by any angle, and its degree: 1, or 3 if it is bent.
fn plane(random: &mut Random, is_bent: bool) -> (u8, [BivariatePolynomial; 2]) {
    let angle = random.between(-3.0, 3.0);
    let (x, y) = (random.between(-2.0, 2.0), random.between(-2.0, 2.0));
    let turned = [
        BivariatePolynomial::linear(x, angle.cos(), -angle.sin()),
        BivariatePolynomial::linear(y, angle.sin(), angle.cos()),
    ];
    if !is_bent {
        return (1, turned);
    }
    let factor = BivariatePolynomial::linear(0.04, 0.0, 0.0);
    (3, turned.map(|p| p.plus(&random_polynomial(random, Total, 3).times(&factor))))
}

/// Random polynomials of random degrees.
fn polynomials(
    random: &mut Random,
    parts: &[AffineElement],
) -> Vec<(PolynomialSpace, u8, BivariatePolynomial)> {
    let one = |part: &AffineElement| {
        let degree = random.below(9) as u8;
        (part.space(), degree, random_polynomial(random, part.space(), degree.into()))
    };
    parts.iter().map(one).collect()
}

/// A coordinate anywhere, or on a line of the quadtree, the border included.
fn coordinate(random: &mut Random) -> f64 {
    if random.unit() < 0.5 { random.unit() } else { random.below(33) as f64 / 32.0 }
}

/// How far a point of the unit square lies inside a part.
fn margin(part: &AffineElement, st: [DoubleDouble; 2]) -> f64 {
    part.shape.margin([0.0; 2], part.xi(st).map(DoubleDouble::to_f64))
}

/// Every point of the plate belongs to the leaf that it comes from, and has the value of the leaf's
/// polynomial: the leaf is found in the unit square, and ξ without inverting a map.
#[test]
fn every_point_has_an_owner_and_its_value() {
    let mut random = Random(21);
    for case in 0..10 {
        let (degree, plane) = plane(&mut random, case % 2 == 1);
        let (elements, parts) = MeshBuilder::quadtree(&mut random, 5, degree, &plane);
        let polynomials = polynomials(&mut random, &parts);
        let dataset = elements.dataset(vec![field("v", &polynomials)]);
        let field = compiled(&dataset);
        let mut shared = 0;
        for k in 0..3000 {
            let st = [coordinate(&mut random), coordinate(&mut random)].map(DoubleDouble::from);
            let p: Vec2 = plane.each_ref().map(|p| p.at(st).to_f64()).into();
            let anchor = if k % 2 == 0 { Vec2::ZERO } else { p };
            let owner = field.at(anchor).owner(p - anchor, Side::Above);
            let owner = owner.unwrap_or_else(|| panic!("case {case}: {st:?} is lost"));
            let own = margin(&parts[owner], st);
            assert!(own > -1e-11, "case {case}: {st:?} lies outside of {owner} by {own:.1e}");
            shared += usize::from(own < 1e-11);
            let xi = parts[owner].xi(st);
            let (expected, size) = {
                let p = &polynomials[owner].2;
                (p.at(xi).to_f64(), p.magnitude(xi.map(DoubleDouble::to_f64)))
            };
            let found = jet(&field, anchor, p - anchor, Side::Above).expect("inside").v;
            let error = (found - expected).abs() / size.max(1e-3);
            assert!(error < 2e-12, "case {case}: {st:?} in {owner}: {error:.1e}");
        }
        assert!(parts.len() > 60 && shared > 300, "{} {shared}", parts.len());
    }
}
