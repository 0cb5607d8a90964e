//! Stresses at the rims of holes in the cells that the program chooses, at the default order.

use crate::studies::support::{checked, solved};
use crate::support::{self, square};
use ppum::crack::Side;
use ppum::dataset::{Dataset, Material, StressState, WarningKind};
use ppum::domain::{Domain, Hole};
use ppum::field::Field;
use ppum::quantity::{Axis, Quantity};
use ppum::vec2::{Vec2, vec2};
use ppum_problem::{
    BaseCells, Condition, Discretization, DomainEdge, Expression, LocalRefinement, PolynomialOrder,
    ProblemData, RefinementRegion,
};
use ppum_testkit::exact::{ElasticField as _, RoundHole};
use ppum_testkit::random::Random;
use std::f64::consts::TAU;

const MATERIAL: Material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };

/// Part of the largest stress that stresses at rims may be off by.
const AIM: f64 = 0.01;

fn tractions(field: &RoundHole, edge: DomainEdge) -> Vec<Condition> {
    let n = edge.normal();
    let [xx, yy, xy] = field.stress_formulas();
    let outward = n.x + n.y;
    let component = |text: String| {
        let (lets, last) = text.rsplit_once(';').expect("bindings");
        let text = format!("{lets}; ({outward:?})*({last})");
        Condition::Neumann(Expression::parse(&text).expect("a formula"))
    };
    let both = if n.x == 0.0 { [xy, yy] } else { [xx, xy] };
    both.map(component).into()
}

/// A square with a hole under the tractions of Kirsch's plate, pulled along y by 1.
fn kirsch(half: f64, center: Vec2, radius: f64, set: Discretization) -> ProblemData {
    let field = RoundHole::new(MATERIAL, center, radius).with_remote([0.0, 1.0, 0.0]);
    let holes = vec![Hole::Circle { center, radius }];
    let plate = ProblemData::elasticity(Domain { bounds: square(half), holes }, MATERIAL, set);
    DomainEdge::ALL
        .into_iter()
        .fold(plate, |p, edge| p.with_boundary(edge, tractions(&field, edge)))
}

fn stress(field: &Field<'_>, p: Vec2) -> [f64; 3] {
    [(Axis::X, Axis::X), (Axis::Y, Axis::Y), (Axis::X, Axis::Y)]
        .map(|(a, b)| Quantity::Stress(a, b).at(&mut field.at(p), Vec2::ZERO, Side::Above))
}

/// Largest error of the hoop stress 1 + 2 cos 2θ at 720 places of the rim, relative to the largest
/// stress, 3; and the largest stress found.
fn on_the_rim(dataset: &Dataset, center: Vec2, radius: f64) -> (f64, f64) {
    let field = Field::new(dataset, 0).expect("a field");
    let at = |k: u32| {
        let angle = TAU * (f64::from(k) + 0.3) / 720.0;
        let out = vec2(angle.cos(), angle.sin());
        let [x, y, xy] = stress(&field, center + out * (radius * (1.0 + 1e-9)));
        let hoop = x * out.y * out.y + y * out.x * out.x - 2.0 * xy * out.x * out.y;
        ((hoop - 1.0 - 2.0 * (2.0 * angle).cos()).abs() / 3.0, hoop)
    };
    (0..720).map(at).fold((0.0, 0.0), |m, v| (v.0.max(m.0), v.1.max(m.1)))
}

fn coarse(dataset: &Dataset) -> Option<&ppum::dataset::Warning> {
    dataset.steps[0].warnings.iter().find(|warning| warning.kind == WarningKind::CoarseHole)
}

/// Two holes of random radii, between 1/120 of the plate and a third of it, and one much smaller
/// than the base cells, at random places: the stress is right everywhere on the rim, and with it
/// the concentration of 3 (Kirsch 1898).
#[test]
fn stress_concentration_of_random_holes() {
    let mut random = Random(21);
    for (level, radius) in [(2, None), (4, None), (2, Some(0.03))] {
        let radius = radius.unwrap_or_else(|| 0.7 * 0.025f64.powf(random.between(0.0, 1.0)));
        let reach = (1.0 - 1.4 * radius).max(0.0);
        let center = vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0)) * reach * 0.9;
        let problem = kirsch(1.0, center, radius, Discretization::new(BaseCells::Level(level)));
        let dataset = solved(&problem);
        let (error, largest) = on_the_rim(&dataset, center, radius);
        let cells = dataset.steps[0].partition.len();
        println!("level {level}, radius {radius:.4}: {error:.4}, {largest:.4}, {cells} cells");
        assert!(error < AIM && (largest / 3.0 - 1.0).abs() < AIM, "{error} {largest}");
        assert!(coarse(&dataset).is_none() && cells < 3000, "{cells} cells");
    }
}

/// The same at other orders, whose cells are larger the higher they are.
#[test]
fn higher_orders_take_larger_cells() {
    let cells = [2, 4].map(|order| {
        let set = Discretization {
            order: PolynomialOrder::Uniform(order),
            ..Discretization::new(BaseCells::Level(2))
        };
        let (center, radius) = (vec2(0.13, -0.07), 0.15);
        let dataset = solved(&kirsch(1.0, center, radius, set));
        let (error, _) = on_the_rim(&dataset, center, radius);
        println!("order {order}: {error:.4}, {} cells", dataset.steps[0].partition.len());
        assert!(error < AIM && coarse(&dataset).is_none(), "order {order}: {error}");
        dataset.steps[0].partition.len()
    });
    assert!(cells[0] > cells[1], "{cells:?}");
}

/// Cells divided by hand: the error at the rim falls like h², and the estimate of the warning is
/// above it, not by far.
#[test]
fn errors_at_the_rim_are_estimated() {
    let (center, radius) = (vec2(0.03, 0.041), 0.25);
    let of = |size: f64| {
        let mut set = Discretization::new(BaseCells::Grid([5, 5]));
        set.refine = false;
        let mut problem = kirsch(1.0, center, radius, set);
        problem.refinements = vec![LocalRefinement::new(RefinementRegion::Hole(0), size)];
        let dataset = solved(&problem);
        let warning = coarse(&dataset).map(|warning| (warning.value, warning.message.clone()));
        (on_the_rim(&dataset, center, radius).0, warning)
    };
    let [base, coarse, fine, finest] = [0.4, 0.1, 0.05, 0.0125].map(of);
    println!("{base:?} {coarse:?} {fine:?} {finest:?}");
    let (estimate, message) = base.1.expect("a warning");
    assert!(
        estimate == 1.0
            && base.0 > 0.1
            && message.starts_with("the cells at the rim of hole 0, counted from 0, are")
    );
    for (error, warning) in [&coarse, &fine] {
        let (estimate, _) = warning.as_ref().expect("a warning");
        assert!(error < estimate && *error > 0.1 * estimate, "{error} {estimate}");
    }
    // beside the rim cells are as large as the balance lets them be
    assert!(fine.0 < 0.4 * coarse.0 && finest.0 < 0.2 * fine.0 && finest.1.is_none());
}

/// Holes by their centres and radii; values by their places.
type Numbers<'a> = &'a [([f64; 2], f64)];

/// A number of holes pulled along y at both ends of the plate [-1, 1]².
fn pulled(holes: Numbers<'_>, level: u32) -> ProblemData {
    let hole = |(center, radius): &([f64; 2], f64)| Hole::Circle {
        center: Vec2::from(*center),
        radius: *radius,
    };
    let domain = Domain { bounds: square(1.0), holes: holes.iter().map(hole).collect() };
    let set = Discretization::new(BaseCells::Level(level));
    support::pulled(ProblemData::elasticity(domain, MATERIAL, set))
}

/// Asserts values of σ_yy by finite elements of order 10 (NGSolve 6.2.2608, geometric meshes),
/// right to 1e-4.
fn assert_stresses(holes: Numbers<'_>, values: Numbers<'_>) {
    let dataset = solved(&pulled(holes, 3));
    assert_eq!(dataset.steps[0].warnings, [], "{holes:?}");
    let field = Field::new(&dataset, 0).expect("a field");
    for (at, exact) in values {
        let [_, found, _] = stress(&field, Vec2::from(*at));
        println!("{at:?}: {found:.4} instead of {exact:.4}");
        assert!((found / exact - 1.0).abs() < AIM, "{at:?}: {found} instead of {exact}");
    }
}

/// Between a hole and the border.
#[test]
fn a_neck() {
    let edge = [([0.65, 0.1], 0.3)];
    assert_stresses(&edge, &[([0.95001, 0.1], 10.76312), ([0.34999, 0.1], 4.44156)]);
}

/// Between two holes of equal and unequal size.
#[test]
#[ignore = "slow: small cells at four rims"]
fn necks_between_holes() {
    assert_stresses(
        &[([-0.35, 0.03], 0.3), ([0.35, 0.03], 0.3)],
        &[([-0.04999, 0.03], 7.29434), ([0.0, 0.03], 6.29434), ([0.65001, 0.03], 4.89304)],
    );
    assert_stresses(
        &[([-0.2, -0.1], 0.3), ([0.25, 0.22], 0.1)],
        &[
            ([0.10001, -0.1], 4.05984),
            ([-0.50001, -0.1], 4.14467),
            ([0.35001, 0.22], 4.84010),
            ([0.14999, 0.22], 5.59142),
        ],
    );
}

/// Of many holes all have coarser cells, of a bounded number, and the worst is named.
#[test]
fn many_holes_are_told() {
    let at = |k: u32| -0.96 + 0.08 * f64::from(k);
    let mut holes: Vec<_> = (0..625).map(|k| ([at(k % 25), at(k / 25)], 0.02)).collect();
    holes[331].1 = 0.008;
    let plan =
        ppum_solve::space::discretise(&checked(&pulled(&holes, 3)), ppum::progress::unwatched());
    let cells = plan.expect("a cover").partition.len();
    assert!(cells < 32_000, "{cells}");
    let few: Vec<_> = holes.iter().skip(300).step_by(31).take(3).copied().collect();
    let mut problem = pulled(&few, 4);
    problem.discretization.refine = false;
    let dataset = solved(&problem);
    let warning = coarse(&dataset).expect("a warning");
    println!("{warning:?}");
    assert!(
        warning.message.contains("rim of hole 1, counted from 0, and of 2 other holes"),
        "{}",
        warning.message
    );
    let at = warning.at.expect("a place");
    assert!((at - Vec2::from(few[1].0)).length() < 0.1 && warning.limit == 0.02);
}
