//! Stress intensity factors where there is little room, and under loads near the tip.

use crate::studies::exact_fields::{MATERIAL, SQUARE, discretization, held};
use crate::studies::support::{checked, solved};
use ppum::dataset::{Dataset, TipIntensity};
use ppum::field::Field;
use ppum::progress::unwatched;
use ppum::vec2::{Rect, vec2};
use ppum_fracture::intensity::{LoadCase, TipObstacle, TipResult, intensities};
use ppum_problem::{BaseCells, BoundaryPart, Condition, DomainEdge, Expression, ProblemData};
use ppum_solve::space::TrialSpace;
use ppum_testkit::exact::{CollinearCracks, CrackInPlane, ExactField as _, Williams};

fn outcomes(dataset: &Dataset, loads: LoadCase<'_>) -> Vec<TipResult> {
    let step = &dataset.steps[0];
    let space = TrialSpace::new(step, &dataset.domain, &dataset.equation, &dataset.tables)
        .expect("functions");
    intensities(dataset, &Field::new(dataset, 0).expect("a field"), &space, &loads, unwatched())
        .expect("nobody stops it")
}

/// The right half of two collinear cracks in the infinite plane, cut out by its exact tractions:
/// the line of symmetry, on which u_x and the shear vanish, is the left border at the distance
/// `gap` from the inner tip.
fn half_of_two_cracks(gap: f64, order: usize, refine: bool) -> (ProblemData, [f64; 2]) {
    let field = CollinearCracks::new(gap, gap + 1.0, 1.0);
    let domain = Rect::new(vec2(0.0, -1.5), vec2(2.5, 1.5));
    let [xx, yy, xy] = field.stress_formulas().map(|text| Expression::parse(&text).expect("text"));
    let negative = |e: &Expression| {
        let (bindings, value) = e.text().rsplit_once("; ").expect("bindings");
        Expression::parse(&format!("{bindings}; -({value})")).expect("a formula")
    };
    let load = |x: &Expression, y: &Expression| {
        vec![Condition::Neumann(x.clone()), Condition::Neumann(y.clone())]
    };
    let mut set = discretization(BaseCells::Grid([10, 12]), order);
    set.refine = refine;
    let problem = ProblemData::elasticity(domain, MATERIAL, set)
        .with_crack(&[[gap, 0.0], [gap + 1.0, 0.0]])
        .with_boundary(DomainEdge::Left, vec![Condition::Dirichlet(0.0.into()), Condition::Free])
        .with_boundary(DomainEdge::Right, load(&xx, &xy))
        .with_boundary(DomainEdge::Bottom, load(&negative(&xy), &negative(&yy)))
        .with_boundary(DomainEdge::Top, load(&xy, &yy));
    (problem, field.intensities())
}

/// Bounds are those of the study in `intensity`: 0.2 % from two cells on at order 2.
#[test]
fn tips_near_the_border() {
    let (problem, [_, exact]) = half_of_two_cracks(0.02, 2, true);
    let dataset = solved(&problem);
    let [inner, _] = outcomes(&dataset, LoadCase::default()).try_into().expect("two tips");
    let factors = inner.factors.expect("room enough in refined cells");
    let error = factors.k1 / exact - 1.0;
    println!("{error:.1e}, clearance {:?}, cell {}", inner.clearance, inner.cell);
    assert!(error.abs() < 3e-3 && factors.k2.abs() < 3e-3 * exact, "{factors:?} {exact}");
    assert_eq!(inner.clearance.end, TipObstacle::Border);
    assert_eq!(dataset.steps[0].intensities.len(), 2);
}

#[test]
fn too_little_room_is_no_value() {
    let (problem, [outer, _]) = half_of_two_cracks(0.02, 2, false);
    let dataset = solved(&problem);
    let [inner, far] = outcomes(&dataset, LoadCase::default()).try_into().expect("two tips");
    assert_eq!(inner.factors, None);
    assert!((inner.clearance.radius - 0.02).abs() < 1e-15 && (inner.cell - 0.25).abs() < 1e-15);
    assert!(inner.needed() > inner.clearance.radius && inner.needed() <= inner.cell);
    // the solution is there, and the other tip has its value
    let factors = far.factors.expect("room enough");
    assert!((factors.k1 / outer - 1.0).abs() < 2e-2, "{factors:?} {outer}");
    let [stored] = dataset.steps[0].intensities.as_slice() else { panic!("one value") };
    assert!(stored.error.is_some_and(|error| error < 0.1), "{stored:?}");
    assert_eq!(TipIntensity { error: None, ..stored.clone() }, factors);
}

/// σ_xx = −f x balances the body force (f, 0) and loads neither the crack on y = 0 nor its tip:
/// with E′ = E/(1 − ν²), ν′ = ν/(1 − ν) its displacement is f/(2E′) (−x² − ν′ y², 2ν′ x y).
#[test]
fn a_constant_body_force() {
    const FORCE: f64 = 3.0;
    let (modulus, poisson) = (1.0 / 0.91, 0.3 / 0.7);
    let tip = Williams::new(MATERIAL, vec2(0.1, 0.0), vec2(1.0, 0.0)).with_intensities(1.0, 0.5);
    let [ux, uy] = tip.formulas();
    let c = 0.5 * FORCE / modulus;
    let exact = [
        format!("({ux}) - {c}*(x^2 + {poisson}*y^2)"),
        format!("({uy}) + {}*x*y", 2.0 * poisson * c),
    ];
    let set = discretization(BaseCells::Level(3), 2);
    let plate =
        ProblemData::elasticity(SQUARE, MATERIAL, set).with_crack(&[[-1.0, 0.0], [0.1, 0.0]]);
    let mut problem = held(plate, exact);
    problem.source = vec![FORCE.into(), 0.0.into()];
    let (dataset, checked) = (solved(&problem), checked(&problem));
    let k = |loads| {
        let [outcome] = outcomes(&dataset, loads).try_into().expect("a tip");
        let factors: ppum::dataset::TipIntensity = outcome.factors.expect("room");
        [factors.k1, factors.k2]
    };
    let [k1, k2] = k(LoadCase { problem: Some(&checked), factor: 1.0 });
    let [without, _] = k(LoadCase::default());
    println!("K {k1} {k2}, without the term {without}");
    assert!((k1 - 1.0).abs() < 2e-4 && (k2 - 0.5).abs() < 2e-4, "{k1} {k2}");
    assert!((without - 1.0).abs() > 0.05, "{without}");
    assert_eq!(dataset.steps[0].intensities[0].k1, k1);
}

/// Pressure σ on the faces is all-round tension σ far away less a uniform stress σ, which has no K
/// (Westergaard's field, references in the project's list): K_I = σ √(πa).
#[test]
fn pressure_on_the_faces() {
    let (a, angle) = (0.4, 0.3f64);
    let along = vec2(angle.cos(), angle.sin());
    let field = CrackInPlane::biaxial(MATERIAL, vec2(0.03, 0.02), along, a, 1.0);
    // uniform stress 1: ε = (1 + ν)(1 − 2ν)/E in every direction
    let strain = 1.3 * 0.4;
    let [ux, uy] = field.formulas();
    let less = |text: String, x: &str| {
        let (bindings, value) = text.rsplit_once("; ").expect("bindings");
        format!("{bindings}; ({value}) - {strain}*{x}")
    };
    let exact = [less(ux, "x"), less(uy, "y")];
    let ends = [vec2(0.03, 0.02) - along * a, vec2(0.03, 0.02) + along * a];
    let plate = ProblemData::elasticity(SQUARE, MATERIAL, discretization(BaseCells::Level(4), 2))
        .with_crack(&ends.map(Into::into))
        .with_pressure(BoundaryPart::Crack { crack: 0, face: None }, 1.0);
    let dataset = solved(&held(plate, exact));
    let [k1, _] = field.intensities();
    for tip in &dataset.steps[0].intensities {
        println!("{:.1e} {:.1e}", tip.k1 / k1 - 1.0, tip.k2 / k1);
        assert!((tip.k1 / k1 - 1.0).abs() < 1e-3 && tip.k2.abs() < 1e-3 * k1, "{tip:?} {k1}");
    }
    // without the term of the faces
    let [start, _] = outcomes(&dataset, LoadCase::default()).try_into().expect("two tips");
    let without = start.factors.expect("room").k1;
    assert!((without / k1 - 1.0).abs() > 0.05, "{without} {k1}");
}
