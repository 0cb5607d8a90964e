//! Tractions on the faces of a crack along a line where the material changes.

use ppum::crack::{CrackEnd, Side};
use ppum::dataset::{Eigenstrain, StressState};
use ppum::equation::{Elasticity, Equation};
use ppum::expression::Expression;
use ppum::field::Field;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::sample::{SamplePoints, evaluate};
use ppum::vec2::{Vec2, vec2};
use ppum_testkit::synthetic::{Recipe, crack};

/// Positive above the crack.
const ABOVE: &str = "0.5*(y - 0.1) - 0.3*(x - 0.6) > 0";

fn by_side([above, below]: [f64; 2]) -> Expression {
    Expression::parse(&format!("if({ABOVE}, {above}, {below})")).expect("a formula")
}

/// σ_n and τ are those of the stresses next to each face, whatever changes across the crack.
#[test]
fn faces_have_their_own_materials() {
    let strains = [[0.3, -0.1], [0.0, 0.2], [0.1, 0.1], [0.0, 0.0]].map(by_side);
    let given = Some(Box::new(Eigenstrain { strains, expansion: None }));
    for (young, poisson, eigenstrain) in [
        ([2.0, 2.0], [0.3, 0.3], None),
        ([10.0, 1.0], [0.3, 0.3], None),
        ([2.0, 2.0], [0.1, 0.45], None),
        ([2.0, 2.0], [0.3, 0.3], given),
    ] {
        let line = crack(&[[0.6, 0.1], [1.1, 0.4]], [CrackEnd::Tip; 2]);
        let mut dataset = Recipe { cracks: vec![line], ..Recipe::default() }.dataset();
        let (young, poisson) = (by_side(young), by_side(poisson));
        let (state, anisotropy) = (StressState::PlaneStrain, None);
        dataset.equation =
            Equation::Elasticity(Elasticity { young, poisson, state, eigenstrain, anisotropy });
        let field = Field::new(&dataset, 0).expect("a field");
        let quantity = |name: &str| Quantity::parse(name, &field).expect("a quantity");
        let tractions = ["normal-traction", "shear-traction"].map(quantity);
        let stresses = ["sxx", "syy", "sxy"].map(quantity);
        let points = SamplePoints::along(&field.step.cracks, 0, &[0.2, 0.5, 0.7]).expect("points");
        let places = points.places();
        let found = evaluate(&field, &tractions, &places, unwatched()).expect("values");
        let tangent = vec2(0.5, 0.3).unit();
        let normal = tangent.left();
        for (place, found) in places.iter().zip(found.chunks(2)) {
            let way = if place.side == Side::Above { normal } else { -normal };
            let mut local = field.at(place.anchor + place.offset);
            let [xx, yy, xy] =
                stresses.each_ref().map(|q| q.at(&mut local, way * 1e-8, place.side));
            let traction = vec2(xx * normal.x + xy * normal.y, xy * normal.x + yy * normal.y);
            let expected = [traction.dot(normal), traction.dot(tangent)];
            let size = [xx, yy, xy].map(f64::abs).into_iter().fold(0.0, f64::max);
            let apart = Vec2::from([found[0] - expected[0], found[1] - expected[1]]).length();
            assert!(apart < 1e-5 * size, "{found:?} {expected:?}");
        }
    }
}
