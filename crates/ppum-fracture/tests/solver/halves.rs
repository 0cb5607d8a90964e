//! Cracks on edges: halves and quarters of symmetric plates against the whole ones.

use crate::studies::support::{checked, parsed, record, solved, unknowns};
use ppum::crack::{SegmentId, Side};
use ppum::dataset::{Dataset, Material, StressState, TipIntensity, WarningKind};
use ppum::field::Field;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::sample::{SampledQuantity, evaluate_each, points};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_fracture::diagnostics::recompute;
use ppum_fracture::growth::series;
use ppum_fracture::intensity::{CircleError, on_circle};
use ppum_problem::{
    BaseCells, BoundaryCondition, BoundaryPart, Condition, Discretization, DomainEdge,
    PolynomialOrder, Problem, ProblemData, SolverKind, Symmetry,
};
use ppum_testkit::random::Random;

/// A plate whose cracks are segments, with loads that are the same all along an edge or a crack.
#[derive(Clone)]
struct Plate {
    bounds: Rect,
    cracks: Vec<[Vec2; 2]>,
    loads: Vec<(DomainEdge, Vec2)>,
    symmetries: Vec<(DomainEdge, Symmetry)>,
    /// On all faces.
    pressure: f64,
    cells: [u32; 2],
    order: usize,
}

impl Plate {
    fn problem(&self) -> ProblemData {
        let material = Material { young: 2.0, poisson: 0.3, state: StressState::PlaneStrain };
        let mut set = Discretization::new(BaseCells::Grid(self.cells));
        set.order = PolynomialOrder::Uniform(self.order);
        let mut problem = ProblemData::elasticity(self.bounds, material, set);
        for crack in &self.cracks {
            problem = problem.with_crack(&crack.map(Into::into));
        }
        for (edge, load) in &self.loads {
            let load = [load.x, load.y].map(|t| Condition::Neumann(t.into()));
            problem = problem.with_boundary(*edge, load.to_vec());
        }
        for (edge, symmetry) in &self.symmetries {
            let is_across = [edge.normal().x != 0.0, edge.normal().y != 0.0];
            let condition = |across: bool| match across == (*symmetry == Symmetry::Symmetric) {
                true => Condition::Dirichlet(0.0.into()),
                false => Condition::Free,
            };
            problem = problem.with_boundary(*edge, is_across.map(condition).to_vec());
        }
        for crack in (0..self.cracks.len()).filter(|_| self.pressure != 0.0) {
            let on = BoundaryPart::Crack { crack, face: None };
            problem.boundary.push(BoundaryCondition::pressure(on, self.pressure.into()));
        }
        problem
    }

    fn solved(&self) -> Dataset {
        solved(&self.problem())
    }

    /// The plate turned by a right angle, and all lengths times a factor.
    fn turned(&self, factor: f64) -> Self {
        let point = |p: Vec2| p.left() * factor;
        let corners = [point(self.bounds.min), point(self.bounds.max)];
        let edge = |edge: DomainEdge| match edge {
            DomainEdge::Left => DomainEdge::Bottom,
            DomainEdge::Bottom => DomainEdge::Right,
            DomainEdge::Right => DomainEdge::Top,
            DomainEdge::Top => DomainEdge::Left,
        };
        Self {
            bounds: Rect::new(corners[0].min(corners[1]), corners[0].max(corners[1])),
            cracks: self.cracks.iter().map(|crack| crack.map(point)).collect(),
            loads: self.loads.iter().map(|(on, load)| (edge(*on), load.left())).collect(),
            symmetries: self.symmetries.iter().map(|(on, kind)| (edge(*on), *kind)).collect(),
            cells: [self.cells[1], self.cells[0]],
            ..self.clone()
        }
    }
}

/// The factors of the tip farthest to the right.
fn right_tip(dataset: &Dataset) -> &TipIntensity {
    let step = &dataset.steps[0];
    let x =
        |found: &&TipIntensity| step.cracks[found.tip.crack as usize].end_point(found.tip.end).x;
    let last = step.intensities.iter().max_by(|a, b| x(a).total_cmp(&x(b)));
    last.expect("a tip with factors")
}

/// What a part has besides what the whole has: differences of K, T and J, relative to K and J, and
/// of the energy of the whole, which is that of so many parts.
fn differences(part: &Dataset, whole: &Dataset, count: f64) -> [f64; 4] {
    let of_parts = record(&part.steps[0], "energy of the whole");
    let [own, all] = [part, whole].map(|dataset| record(&dataset.steps[0], "energy"));
    assert!((count * own / of_parts - 1.0).abs() < 1e-14);
    let (part, whole) = (right_tip(part), right_tip(whole));
    let size = whole.k1.hypot(whole.k2);
    let t = [part, whole].map(|found| found.t_stress.expect("T"));
    let j = [part, whole].map(|found| found.j.expect("J"));
    let k = (part.k1 - whole.k1).hypot(part.k2 - whole.k2) / size;
    [k, (t[0] - t[1]).abs() / size, (j[0] / j[1] - 1.0).abs(), (of_parts / all - 1.0).abs()]
}

/// A plate with a centre crack of half the length `a`, pulled and opened.
fn centre_crack(a: f64, order: usize) -> Plate {
    Plate {
        bounds: Rect::new(vec2(-1.0, -1.5), vec2(1.0, 1.5)),
        cracks: vec![[vec2(-a, 0.0), vec2(a, 0.0)]],
        loads: vec![
            (DomainEdge::Top, vec2(0.0, 1.0)),
            (DomainEdge::Bottom, vec2(0.0, -1.0)),
            (DomainEdge::Left, vec2(-0.3, 0.0)),
            (DomainEdge::Right, vec2(0.3, 0.0)),
        ],
        symmetries: Vec::new(),
        pressure: 0.4,
        cells: [8, 12],
        order,
    }
}

/// The part of a plate with y > 0, or with x > 0, too.
fn part_of(whole: &Plate, kind: Symmetry, is_quarter: bool) -> Plate {
    let mut part = whole.clone();
    part.bounds.min.y = 0.0;
    part.cells[1] /= 2;
    part.symmetries.push((DomainEdge::Bottom, kind));
    if is_quarter {
        part.bounds.min.x = 0.0;
        part.cells[0] /= 2;
        part.symmetries.push((DomainEdge::Left, Symmetry::Symmetric));
        part.cracks.retain(|crack| crack[1].x > 0.0);
        part.cracks.iter_mut().flatten().for_each(|p| p.x = p.x.max(0.0));
    }
    let is_held = |edge: &DomainEdge| part.symmetries.iter().any(|(on, _)| on == edge);
    part.loads.retain(|(edge, _)| !is_held(edge));
    part
}

/// Bounds of the differences of parts and wholes of order 5 on these cells, about three times the
/// largest that were seen: those of K, T, J and energy are errors of both.
const SAME: [f64; 4] = [3e-8, 1e-7, 6e-8, 2e-8];

/// Those of a quarter through the crack: a crack half as long has a zone of tip functions half as
/// wide by default.
const SAME_QUARTER: [f64; 4] = [2e-7, 5e-7, 4e-7, 4e-8];

/// Prints differences, each of which must be below its bound.
fn check(name: &str, found: [f64; 4], bounds: [f64; 4]) {
    println!(
        "{name}: K {:.1e}, T {:.1e}, J {:.1e}, energy {:.1e}",
        found[0], found[1], found[2], found[3]
    );
    assert!(found.iter().zip(bounds).all(|(found, bound)| *found < bound), "{name}: {found:?}");
}

/// The half has about half the unknowns of the whole, the quarter a quarter; there are fewer at
/// the edge, where nothing jumps and the series has one symmetry.
#[test]
fn parts_of_a_plate_with_a_centre_crack() {
    let whole = centre_crack(Random(42).between(0.35, 0.65), 5);
    let solved = whole.solved();
    for (is_quarter, count) in [(false, 2.0), (true, 4.0)] {
        let part = part_of(&whole, Symmetry::Symmetric, is_quarter).solved();
        let share = unknowns(&part) as f64 / unknowns(&solved) as f64;
        println!("{share:.3} of the unknowns");
        let bounds = if is_quarter { SAME_QUARTER } else { SAME };
        check("centre", differences(&part, &solved, count), bounds);
        assert!((0.8..1.1).contains(&(share * count)) && right_tip(&part).k2 == 0.0);
    }
}

#[test]
fn parts_of_plates_with_edge_cracks() {
    let mut random = Random(43);
    let single = Plate {
        bounds: Rect::new(vec2(0.0, -1.0), vec2(1.0, 1.0)),
        cracks: vec![[vec2(0.0, 0.0), vec2(random.between(0.3, 0.6), 0.0)]],
        loads: vec![(DomainEdge::Top, vec2(0.0, 1.0)), (DomainEdge::Bottom, vec2(0.0, -1.0))],
        cells: [6, 12],
        pressure: 0.0,
        ..centre_crack(0.5, 5)
    };
    let part = part_of(&single, Symmetry::Symmetric, false);
    check("single", differences(&part.solved(), &single.solved(), 2.0), SAME);
    let a = random.between(0.4, 0.6);
    let mut double = centre_crack(0.5, 5);
    double.cracks = [[-1.0, -a], [a, 1.0]].map(|x| x.map(|x| vec2(x, 0.0))).to_vec();
    let part = part_of(&double, Symmetry::Symmetric, true);
    check("double", differences(&part.solved(), &double.solved(), 4.0), SAME);
}

/// Cracks from a hole: of the edge that symmetry holds, a part lies in the hole.
#[test]
fn quarter_of_a_plate_with_a_cracked_hole() {
    let solved_in = |min: [f64; 2], cells: [u32; 2], cracks: &str, rest: &str| {
        let text = format!(
            r#"
            domain = {{ min = {min:?}, max = [1, 1.5] }}
            material = {{ young = 1.0, poisson = 0.3, state = "plane-strain" }}
            hole = [{{ center = [0, 0], radius = 0.25 }}]
            crack = [{{ points = [[0.25, 0], [0.5, 0]] }}{cracks}]
            boundary = [{{ on = "top", traction = [0, 1] }}, {rest}]
            discretization = {{ cells = {cells:?}, order = 4 }}
            "#
        );
        solved(&parsed(&text))
    };
    let other = ", { points = [[-0.5, 0], [-0.25, 0]] }";
    let whole = solved_in([-1.0, -1.5], [12, 18], other, "{ on = 'bottom', traction = [0, -1] }");
    let held = "{ on = 'bottom', symmetry = true }, { on = 'left', symmetry = true }";
    let part = solved_in([0.0, 0.0], [6, 9], "", held);
    // the error of order 4 beside the hole
    check("hole", differences(&part, &whole, 4.0), [1e-5, 1e-4, 2e-5, 1e-5]);
}

/// A centre crack in shear: the loads on the half balance, no K_I and no T.
#[test]
fn half_of_a_plate_in_shear() {
    let mut whole = centre_crack(Random(44).between(0.35, 0.65), 5);
    (whole.loads, whole.pressure) = (
        vec![
            (DomainEdge::Top, vec2(1.0, 0.0)),
            (DomainEdge::Bottom, vec2(-1.0, 0.0)),
            (DomainEdge::Left, vec2(0.0, -1.0)),
            (DomainEdge::Right, vec2(0.0, 1.0)),
        ],
        0.0,
    );
    let part = part_of(&whole, Symmetry::Antisymmetric, false).solved();
    let found = right_tip(&part);
    assert_eq!((found.k1, found.t_stress), (0.0, Some(0.0)));
    check("shear", differences(&part, &whole.solved(), 2.0), SAME);
}

/// On all four edges, in both directions, of any size, and with vertices that are moved by rounding
/// a half has the same factors; reversed it has the same bits.
/// Of a crack on an edge one face is in the body, wherever it is evaluated.
#[test]
fn outer_faces_have_no_values() {
    let dataset = part_of(&centre_crack(0.5, 2), Symmetry::Symmetric, false).solved();
    let field = Field::new(&dataset, 0).expect("a field");
    let cracks = &dataset.steps[0].cracks;
    let middle = (cracks[0].points[0] + cracks[0].points[1]) / 2.0;
    let mut on = field.on(SegmentId { crack: 0, segment: 0 }, middle);
    for quantity in ["uy", "syy", "von-mises"] {
        let quantity = Quantity::parse(quantity, &field).expect("a quantity");
        let alone = [Side::Above, Side::Below].map(|side| quantity.at(&mut on, Vec2::ZERO, side));
        let offsets = [Vec2::ZERO, vec2(0.1, 0.0), vec2(-0.1, 0.0)];
        let together = [Side::Above, Side::Below].map(|side| {
            Quantity::at_many(std::slice::from_ref(&quantity), &mut on, &offsets, side)[0]
        });
        let places = points(cracks, &[middle]);
        let rows = evaluate_each(
            &field,
            SampledQuantity::Values(std::slice::from_ref(&quantity)),
            &places,
        );
        for [inner, outer] in [alone, together, [rows[0], rows[1]]] {
            assert!(inner.is_finite() && outer.is_nan(), "{inner} {outer}");
        }
    }
}

#[test]
fn halves_in_all_positions() {
    let mut random = Random(45);
    let mut plate = part_of(&centre_crack(0.45, 3), Symmetry::Symmetric, false);
    let first = plate.solved();
    let [k, t] = [right_tip(&first).k1, right_tip(&first).t_stress.expect("T")];
    let mut reversed = plate.clone();
    reversed.cracks[0].reverse();
    assert_eq!(reversed.problem(), plate.problem());
    let mut scale = 1.0;
    for _ in 0..4 {
        let factor = random.between(0.1, 10.0);
        scale *= factor;
        plate = plate.turned(factor);
        let rounding = 1e-13 * plate.bounds.size().length();
        let mut moved = plate.clone();
        for p in moved.cracks.iter_mut().flatten() {
            *p =
                *p + vec2(random.between(-rounding, rounding), random.between(-rounding, rounding));
        }
        for plate in [&plate, &moved] {
            let found = plate.solved();
            for tip in &found.steps[0].intensities {
                let errors = [tip.k1 / scale.sqrt() / k - 1.0, (tip.t_stress.expect("T") - t) / k];
                println!("{scale:.3}: {errors:?}");
                assert!(errors.iter().all(|error| error.abs() < 1e-9), "{errors:?}");
            }
        }
    }
}

/// The estimated error of K beside the difference from a solution of a higher order.
#[test]
fn estimates_of_errors_of_halves() {
    let mut random = Random(46);
    for order in [1, 2, 3] {
        let a = random.between(0.35, 0.65);
        let [found, finer] = [order, order + 2]
            .map(|order| part_of(&centre_crack(a, order), Symmetry::Symmetric, true).solved());
        let error = (right_tip(&found).k1 - right_tip(&finer).k1).abs();
        let ratio = right_tip(&found).error.expect("an estimate") / error;
        println!("order {order}: {error:.1e}, estimated {ratio:.2} times that");
        assert!((1.0 / 3.0..30.0).contains(&ratio), "{ratio}");
    }
}

/// Factors are found again from a dataset with its problem, also on a circle; without the problem,
/// which says how the field goes on, there are none. The multilevel solver finds the same field.
#[test]
fn factors_of_a_half_are_found_again() {
    let mut problem = part_of(&centre_crack(0.45, 3), Symmetry::Symmetric, true).problem();
    problem.discretization.cells = BaseCells::Grid([16, 24]);
    let dataset = solved(&problem);
    let known = right_tip(&dataset);
    let ready = checked(&problem);
    let again = |problem: Option<&Problem>| {
        let (mut tips, _) = recompute(&dataset, 0, problem, unwatched()).expect("a step");
        tips.pop().and_then(|tip| tip.factors)
    };
    let expected = TipIntensity { error: None, ..known.clone() };
    assert_eq!(again(Some(&ready)), Some(expected.clone()));
    assert_eq!(again(None), None);
    let on_circle =
        |problem| on_circle(&dataset, 0, known.tip, known.rings[2].r2, problem, unwatched());
    let found = on_circle(Some(&ready)).expect("room");
    assert!((found.k1 / known.k1 - 1.0).abs() < 1e-12, "{found:?}");
    assert!(matches!(on_circle(None), Err(CircleError::Disturbed(_))));
    problem.solver.kind = SolverKind::Multilevel;
    let other = solved(&problem);
    assert_eq!(record(&other.steps[0], "linear solver"), 2.0);
    let error = right_tip(&other).k1 / known.k1 - 1.0;
    println!("{} iterations, {error:.1e}", record(&other.steps[0], "iterations"));
    assert!(error.abs() < 1e-8 && record(&other.steps[0], "iterations") < 60.0);
}

/// A crack that is pressed together is told of, as in the whole plate.
#[test]
fn faces_of_a_half_that_overlap() {
    let mut plate = part_of(&centre_crack(0.45, 2), Symmetry::Symmetric, false);
    plate.pressure = -3.0;
    let kinds: Vec<_> =
        plate.solved().steps[0].warnings.iter().map(|found| found.kind.clone()).collect();
    let count = |kind: WarningKind| kinds.iter().filter(|found| **found == kind).count();
    assert_eq!(
        [count(WarningKind::FacesOverlap), count(WarningKind::NegativeK1)],
        [1, 2],
        "{kinds:?}"
    );
    plate.pressure = 0.4;
    assert!(
        plate.solved().steps[0]
            .warnings
            .iter()
            .all(|found| found.kind != WarningKind::FacesOverlap)
    );
}

/// A crack that grows along its edge keeps to it, and K follows that of the whole plate.
#[test]
fn a_crack_grows_along_its_edge() {
    let grown = |bottom: &str, min: f64, cells: u32| {
        let text = format!(
            r#"
            domain = {{ min = [0, {min}], max = [1, 1] }}
            material = {{ young = 1.0, poisson = 0.3, state = "plane-strain" }}
            crack = [{{ points = [[0, 0], [0.3, 0]] }}]
            boundary = [{{ on = "top", traction = [0, 1] }}, {{ on = "bottom", {bottom} }}]
            discretization = {{ cells = [6, {cells}], order = 4 }}
            growth = {{ steps = 3, increment = 0.05 }}
            "#
        );
        series(&checked(&parsed(&text)), None, unwatched()).expect("a series")
    };
    let [part, whole] = [grown("symmetry = true", 0.0, 6), grown("traction = [0, -1]", -1.0, 12)];
    assert_eq!(part.steps.len(), 4);
    for (k, (part, whole)) in part.steps.iter().zip(&whole.steps).enumerate() {
        let points = &part.cracks[0].points;
        assert!(points.iter().all(|p| p.y == 0.0), "{points:?}");
        let error = part.intensities[0].k1 / whole.intensities[0].k1 - 1.0;
        println!("step {k}: {error:.1e} at {points:?}");
        assert!(error.abs() < 1e-5, "{error}");
    }
}
