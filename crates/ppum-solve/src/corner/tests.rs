use super::*;
use ppum::dataset::{Material, StressState};
use ppum::domain::Domain;
use ppum::vec2::vec2;
use ppum_problem::{
    BaseCells, BoundaryCondition, BoundaryRange, Condition, Discretization, DomainEdge, Expression,
    ProblemData,
};
use ppum_testkit::random::Random;
use std::f64::consts::PI;

const BOUNDS: Rect = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
const FREE: [bool; 2] = [false; 2];
const HELD: [bool; 2] = [true; 2];
const AXES: [[Vec2; 2]; 2] = [[vec2(1.0, 0.0), vec2(0.0, 1.0)]; 2];

fn wedge(from: f64, opening: f64, held: [[bool; 2]; 2], kappa: f64) -> f64 {
    smallest(
        &Sector { from, opening, held, axes: AXES, load: [[0.0; 2]; 2], value: [[0.0; 2]; 2] },
        Constants::Elastic(kappa),
    )
}

/// A wedge that can slide along a ray, whichever way that is, is a half of a free one.
#[test]
fn wedges_on_smooth_walls_are_halves() {
    let mut random = Random(5);
    for _ in 0..20 {
        let (from, opening) = (random.between(-3.0, 3.0), random.between(1.7, 3.1));
        let (wall, kappa) = (vec2(from.cos(), from.sin()).left(), random.between(1.2, 2.6));
        let held = [[true, false], FREE];
        let axes = [[wall, wall.left()], AXES[1]];
        let sector =
            Sector { from, opening, held, axes, load: [[0.0; 2]; 2], value: [[0.0; 2]; 2] };
        let half = smallest(&sector, Constants::Elastic(kappa));
        let whole = wedge(from, 2.0 * opening, [FREE; 2], kappa);
        assert!((half - whole).abs() < 2e-4, "{from}, {opening}: {half}, {whole}");
    }
}

/// The smallest root in (lo, 1) of a real function that changes its sign there.
fn root(lo: f64, f: impl Fn(f64) -> f64) -> f64 {
    let steps = 4000;
    let at = |k: usize| lo + (0.999 - lo) * k as f64 / steps as f64;
    (0..steps)
        .map(|k| 0.5 * (at(k) + at(k + 1)))
        .zip(0..)
        .find(|&(_, k)| f(at(k)) * f(at(k + 1)) < 0.0)
        .map_or(1.0, |(x, _)| x)
}

/// sin²(λω) = λ² sin²ω (Williams 1952), whichever way the wedge points.
#[test]
fn free_wedges_have_the_exponents_of_their_equation() {
    for k in 1..=40 {
        let opening = PI + PI * f64::from(k) / 40.0;
        let exact = root(0.4, |l| (l * opening).sin() + l * opening.sin());
        for from in [0.0, 1.0, -2.5] {
            let found = wedge(from, opening, [FREE; 2], 1.8);
            assert!((found - exact).abs() < 6e-4, "{opening}: {found} instead of {exact}");
        }
    }
    assert!((wedge(0.0, 1.5 * PI, [FREE; 2], 2.0) - 0.54448).abs() < 1e-4);
    assert_eq!(wedge(0.3, 0.9 * PI, [FREE; 2], 2.0), 1.0);
}

/// 4κ sin²(λω) = (κ + 1)² − 4λ² sin²ω for a wedge held on one side, κ² sin²(λω) = λ² sin²ω held
/// on both.
#[test]
fn held_wedges_have_the_exponents_of_their_equations() {
    for kappa in [1.2f64, 1.8, 2.6] {
        for k in 1..=12 {
            let opening = PI * f64::from(k) / 7.0;
            let mixed = |l: f64| {
                (kappa + 1.0).powi(2)
                    - 4.0 * (l * opening.sin()).powi(2)
                    - 4.0 * kappa * (l * opening).sin().powi(2)
            };
            let exact = root(0.15, mixed);
            let found = wedge(0.7, opening, [HELD, FREE], kappa);
            if opening < 0.8 * PI && exact < 0.98 {
                assert!((found - exact).abs() < 6e-4, "{opening}, {kappa}: {found}, {exact}");
            }
            let held = |l: f64| kappa * (l * opening).sin() + l * opening.sin();
            let other = |l: f64| kappa * (l * opening).sin() - l * opening.sin();
            let exact = root(0.3, held).min(root(0.3, other));
            let found = wedge(-0.4, opening, [HELD; 2], kappa);
            if exact < 0.98 {
                assert!((found - exact).abs() < 6e-4, "{opening}, {kappa}: {found}, {exact}");
            }
        }
        // the end of a held piece of a straight boundary: 1/2 ± i ln κ/(2π)
        assert!((wedge(0.0, PI, [FREE, HELD], kappa) - 0.5).abs() < 2e-4);
    }
    assert!((wedge(0.0, 0.5 * PI, [HELD, FREE], 1.8) - 0.711).abs() < 5e-4);
}

/// A roller is the middle of a plate: half the wedge of a crack, or of a corner.
#[test]
fn rollers_halve_wedges() {
    // along x: u_y held is symmetric, u_x held antisymmetric
    for held in [[false, true], [true, false]] {
        assert!((wedge(0.0, PI, [held, FREE], 1.8) - 0.5).abs() < 2e-4);
    }
    assert_eq!(wedge(0.0, 0.5 * PI, [[false, true], FREE], 1.8), 1.0);
    assert_eq!(wedge(0.0, 0.5 * PI, [[false, true], [true, false]], 1.8), 1.0);
}

fn plate() -> ProblemData {
    plate_with(Vec::new())
}

fn plate_with(holes: Vec<Hole>) -> ProblemData {
    let material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
    let domain = Domain { bounds: BOUNDS, holes };
    ProblemData::elasticity(domain, material, Discretization::new(BaseCells::Level(3)))
}

fn checked(problem: &ProblemData) -> Problem {
    Problem::new(problem.clone()).expect("a problem in order")
}

fn clamp() -> Vec<Condition> {
    vec![Condition::Dirichlet(0.0.into()), Condition::Dirichlet(0.0.into())]
}

fn found(problem: &ProblemData) -> Vec<(Vec2, f64, SingularCause)> {
    corners(&checked(problem))
        .iter()
        .map(|c| (c.at, (c.exponent * 1e3).round() / 1e3, c.nature))
        .collect()
}

#[test]
fn a_plain_plate_has_none() {
    let roller = |k: usize| {
        let mut components = vec![Condition::Free; 2];
        components[k] = Condition::Dirichlet(0.0.into());
        components
    };
    let straight = plate().with_crack(&[[1.0, 0.2], [0.1, 0.3]]);
    assert_eq!(found(&straight), []);
    let rollers = straight
        .with_boundary(DomainEdge::Bottom, roller(1))
        .with_boundary(DomainEdge::Left, roller(0));
    assert_eq!(found(&rollers), []);
}

#[test]
fn clamped_corners_ends_of_supports_and_mouths_at_supports_are_found() {
    let clamped = plate().with_boundary(DomainEdge::Bottom, clamp());
    let at = |x: f64, y: f64| (vec2(x, y), 0.711, SingularCause::Support);
    assert_eq!(found(&clamped), [at(-1.0, -1.0), at(1.0, -1.0)]);
    let mouth = clamped.with_crack(&[[0.25, -1.0], [0.25, 0.0]]);
    assert_eq!(found(&mouth), [at(-1.0, -1.0), at(1.0, -1.0), at(0.25, -1.0)]);
    let mut piece = plate();
    let on = BoundaryPart::Edge { edge: DomainEdge::Top, from: -1.0, to: 0.5 };
    piece.boundary.push(BoundaryCondition::new(on, clamp()));
    assert_eq!(found(&piece), [at(-1.0, 1.0), (vec2(0.5, 1.0), 0.5, SingularCause::Support)]);
}

#[test]
fn corners_of_holes_and_kinks_are_found_where_they_are_in_the_plate() {
    let square = |x: f64, y: f64, h: f64| {
        let points = [[-h, -h], [h, -h], [h, h], [-h, h]];
        Hole::polygon(points.map(|[a, b]| vec2(x + a, y + b)).to_vec())
    };
    let holes = vec![square(1.0, 0.5, 0.25), square(0.0, 0.5, 0.125)];
    let crack = [[-0.75, -0.5], [-0.25, -0.5], [-0.25, -0.25]];
    let problem = plate_with(holes).with_crack(&crack);
    let corner = |x: f64, y: f64| (vec2(x, y), 0.544, SingularCause::Corner);
    let inner = [[-0.125, 0.375], [0.125, 0.375], [0.125, 0.625], [-0.125, 0.625]];
    let mut expected = vec![corner(0.75, 0.25), corner(0.75, 0.75)];
    expected.extend(inner.map(|[x, y]| corner(x, y)));
    expected.push((vec2(-0.25, -0.5), 0.544, SingularCause::Kink(0)));
    let mut all = found(&problem);
    let key = |c: &(Vec2, f64, SingularCause)| (c.0.x * 8.0 + c.0.y * 100.0) as i64;
    all.sort_by_key(key);
    expected.sort_by_key(key);
    assert_eq!(all, expected);
    let kink = corners(&checked(&problem))
        .into_iter()
        .find(|c| c.nature == SingularCause::Kink(0))
        .expect("it");
    assert!((kink.room - 0.25).abs() < 1e-12);
}

/// In the room of a kink's functions the side of its crack is that of the two segments there, also
/// where the crack comes back, as coils, hooks and a Z do, and where its extensions pass.
#[test]
fn sides_in_the_rooms_of_kinks() {
    let mut random = Random(23);
    let coil = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5], [-0.5, -0.2], [0.2, -0.2]];
    let zigzag = [[-0.6, -0.3], [0.5, -0.3], [-0.5, 0.3], [0.6, 0.3]];
    let (mut kinks, mut rooms) = (0, 0.0);
    for points in [&coil[..], &coil[..5], &coil[..4], &coil[1..], &zigzag] {
        for _ in 0..5 {
            let mut moved = |x: f64| x + random.between(-0.05, 0.05);
            let points: Vec<[f64; 2]> = points.iter().map(|p| p.map(&mut moved)).collect();
            let problem = plate().with_crack(&points);
            let crack = &problem.cracks()[0];
            for SingularCorner { at, wedge, .. } in corners(&checked(&problem)) {
                let Some(Wedge { room, side: Some(_), .. }) = wedge else { continue };
                let k = crack.points.iter().position(|p| *p == at).expect("a vertex");
                let own = Crack { points: crack.points[k - 1..=k + 1].to_vec(), ..crack.clone() };
                for _ in 0..100 {
                    let p = at + random.direction() * (room * random.unit());
                    let side = |c: &Crack| LocalCrack::new(c, p).side([0.0; 2], Side::Above);
                    assert_eq!(side(crack), side(&own), "{points:?} {p:?}");
                }
                (kinks, rooms) = (kinks + 1, rooms + room);
            }
        }
    }
    assert!(kinks > 60 && rooms > 0.1 * f64::from(kinks), "{kinks} {rooms}");
}

/// A half circle out of a held edge leaves two right angles, held on one side; rims that cross make
/// corners below π, which are singular only where something is held.
#[test]
fn crossing_rims_make_corners() {
    let circle = |x: f64, y: f64| Hole::Circle { center: vec2(x, y), radius: 0.25 };
    let holes = vec![circle(0.0, -1.0), circle(-0.15, 0.5), circle(0.15, 0.5)];
    let problem = plate_with(holes).with_boundary(DomainEdge::Bottom, clamp());
    let at = |x: f64| (vec2(x, -1.0), 0.711, SingularCause::Support);
    let mut all = found(&problem);
    all.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
    assert_eq!(all, [at(-1.0), at(-0.25), at(0.25), at(1.0)]);
}

/// A uniform stress loads a plate with a crack and a notch without any corner; a shear that one of
/// its sides lacks makes one at both ends of the side and at a mouth in it, whatever is pulled.
#[test]
fn loads_that_no_stress_has_make_corners() {
    let traction = |t: [f64; 2]| t.map(|t| Condition::Neumann(t.into())).to_vec();
    let sheared = |top: f64| {
        plate()
            .with_crack(&[[0.25, 1.0], [0.3, 0.5]])
            .with_boundary(DomainEdge::Left, traction([-2.0, -0.5]))
            .with_boundary(DomainEdge::Right, traction([2.0, 0.5]))
            .with_boundary(DomainEdge::Bottom, traction([-0.5, -1.0]))
            .with_boundary(DomainEdge::Top, traction([top, 1.0]))
    };
    let at = |x: f64, y: f64| (vec2(x, y), 1.0, SingularCause::Load);
    // the free faces of the crack: 0.5 of shear and 1 of tension are missing there
    assert_eq!(found(&sheared(0.5)), [at(0.25, 1.0)]);
    assert_eq!(found(&sheared(0.0)), [at(1.0, 1.0), at(-1.0, 1.0), at(0.25, 1.0)]);
    let mut piece = plate();
    let on = BoundaryPart::Edge { edge: DomainEdge::Top, from: -0.25, to: 0.25 };
    piece.boundary.push(BoundaryCondition::pressure(on, 1.0.into()));
    assert_eq!(found(&piece), [at(-0.25, 1.0), at(0.25, 1.0)]);
    // a formula that is zero elsewhere, or only bent there, or varies fast
    let whole = |text: &str| {
        let load = Expression::parse(text).expect("a formula");
        let on = BoundaryPart::edge(DomainEdge::Top, &BOUNDS);
        let mut problem = plate();
        problem.boundary.push(BoundaryCondition::pressure(on, load));
        found(&problem).into_iter().map(|(p, ..)| (p.x * 1e6).round() / 1e6).collect::<Vec<_>>()
    };
    let near = |jumps: &[f64], text: &str| {
        let mut found = whole(text);
        found.sort_by(f64::total_cmp);
        assert_eq!(found, jumps, "{text}");
    };
    near(&[-0.25, 0.25], "if(abs(x) < 0.25, 1, 0)");
    near(&[-0.5], "if(x < -0.5, 1 - x, x)*(1 - x^2)");
    near(&[], "abs(x - 0.3)*(1 - x^2)");
    near(&[], "sin(40*x)*(1 - x^2)");
    // the same load goes on beside it
    let next = BoundaryPart::Edge { edge: DomainEdge::Top, from: 0.25, to: 1.0 };
    piece.boundary.push(BoundaryCondition::new(next, traction([0.0, -1.0])));
    assert_eq!(found(&piece), [at(-0.25, 1.0)]);
}

/// Values that jump on an edge, at the end of a piece and at a corner, and those that do not.
#[test]
fn jumps_of_given_values_are_found() {
    let given =
        |text: &str| vec![Condition::Dirichlet(Expression::parse(text).expect("a formula"))];
    let potential = |bottom: &str, left: &str| {
        let problem = ProblemData::poisson(BOUNDS, 1.0, Discretization::new(BaseCells::Level(3)));
        let problem = problem.with_boundary(DomainEdge::Bottom, given(bottom));
        found(&problem.with_boundary(DomainEdge::Left, given(left)))
    };
    let places = |all: &[(Vec2, f64, SingularCause)]| -> Vec<Vec2> {
        all.iter().filter(|corner| corner.2 == SingularCause::Jump).map(|corner| corner.0).collect()
    };
    assert_eq!(places(&potential("x + 1", "0")), []);
    assert_eq!(places(&potential("exp(3*x)*cos(y)", "exp(-3)*cos(y)")), []);
    // a layer beside the corner
    assert_eq!(places(&potential("1 - exp(-(x + 1)/1e-3)", "0")), []);
    assert_eq!(places(&potential("1", "0")), [vec2(-1.0, -1.0)]);
    assert_eq!(places(&potential("if(x > 0.25, 1, 0)", "0")), [vec2(0.25, -1.0)]);
}

#[test]
fn potentials_have_the_exponents_of_laplace() {
    let mut problem = ProblemData::poisson(BOUNDS, 1.0, Discretization::new(BaseCells::Level(3)));
    let on = BoundaryPart::Edge { edge: DomainEdge::Top, from: -0.5, to: 0.5 };
    problem.boundary.push(BoundaryCondition::new(on, vec![Condition::Dirichlet(0.0.into())]));
    let problem = problem.with_crack(&[[-0.5, 0.0], [0.0, 0.0], [0.0, 0.5]]);
    let places =
        [([-0.5, 1.0], 0.5, SingularCause::Support), ([0.5, 1.0], 0.5, SingularCause::Support)];
    let mut expected: Vec<_> = places.map(|(p, l, n)| (Vec2::from(p), l, n)).to_vec();
    expected.push((vec2(0.0, 0.0), 0.667, SingularCause::Kink(0)));
    assert_eq!(found(&problem), expected);
}

/// A closed chain of edges, each in some arcs, as a hole.
fn hole_of(edges: &[Edge], parts: usize) -> Hole {
    let at = |k: usize| k as f64 / parts as f64;
    let of = |edge: &Edge| (0..parts).map(|k| edge.part([at(k), at(k + 1)])).collect::<Vec<_>>();
    let all: Vec<Edge> = edges.iter().flat_map(of).collect();
    Hole::enclosed(&all)
}

/// A slot with round ends has no corners; a lens has two, with the openings of its tangents and the
/// same room, however its arcs are divided and wherever it lies.
#[test]
fn curves_have_corners_where_their_tangents_turn() {
    let mut random = Random(24);
    for round in 0..20 {
        let (center, way) = (random.point(&BOUNDS) * 0.3, random.direction());
        let at = |x: f64, y: f64| center + way * x + way.left() * y;
        let segment = |a, b| Edge { from: a, to: b, bulge: 0.0 };
        let round_end = |a, b| Edge { from: a, to: b, bulge: 1.0 };
        let slot = [
            segment(at(-0.2, -0.1), at(0.2, -0.1)),
            round_end(at(0.2, -0.1), at(0.2, 0.1)),
            segment(at(0.2, 0.1), at(-0.2, 0.1)),
            round_end(at(-0.2, 0.1), at(-0.2, -0.1)),
        ];
        let is_arc = |hole: &Hole| hole.edges().map(|edge| edge.is_arc()).collect::<Vec<_>>();
        assert_eq!(is_arc(&hole_of(&slot, 1)), [false, true, false, true]);
        assert_eq!(found(&plate_with(vec![hole_of(&slot, 1)])), [], "{round}");
        let half = random.between(0.3, 1.2);
        let lens = [at(-0.2, 0.0), at(0.2, 0.0)];
        let bulge = (0.5 * half).tan();
        let lens = [
            Edge { from: lens[0], to: lens[1], bulge },
            Edge { from: lens[1], to: lens[0], bulge },
        ];
        let exponent = wedge(0.0, 2.0 * PI - 2.0 * half, [FREE; 2], 1.8);
        let mut rooms = Vec::new();
        for parts in [1, 2, 7, 40] {
            let problem = checked(&plate_with(vec![hole_of(&lens, parts)]));
            let corners = corners(&problem);
            assert_eq!(corners.len(), 2, "{round} {parts}");
            for (corner, edge) in corners.iter().zip(&lens) {
                assert!((corner.at - edge.from).length() < 1e-12);
                assert!((corner.exponent - exponent).abs() < 2e-4 && corner.wedge.is_some());
                let wedge = corner.wedge.as_ref().expect("free sides");
                let out = (edge.from - edge.to).unit();
                assert!((vec2(wedge.bisector.cos(), wedge.bisector.sin()) - out).length() < 1e-9);
                rooms.push(corner.room);
            }
        }
        let [least, most] = [f64::min, f64::max].map(|f| rooms.iter().copied().reduce(f).unwrap());
        assert!(least > 0.1 && most - least < 1e-9, "{rooms:?}");
    }
}

/// Smooth chains of arcs are cracks without kinks; a corner between arcs is a kink of the opening
/// of its tangents. A load that ends within a smooth rim is found.
#[test]
fn kinks_of_arcs_and_ends_of_loads() {
    let arc = Edge { from: vec2(-0.6, -0.2), to: vec2(0.1, -0.3), bulge: 0.3 };
    let on = Edge::leaving(arc.to, arc.end_tangents()[1], -1.0, 0.4);
    let smooth = Crack::along(&[arc.part([0.0, 0.4]), arc.part([0.4, 1.0]), on]);
    assert_eq!(found(&plate().with_crack_along(smooth)), []);
    let turned = arc.end_tangents()[1].left();
    let kinked = Crack::along(&[
        arc.part([0.0, 0.4]),
        arc.part([0.4, 1.0]),
        Edge::leaving(arc.to, turned, 1.0, 0.4),
    ]);
    let kink = (arc.to, 0.544, SingularCause::Kink(0));
    assert_eq!(found(&plate().with_crack_along(kinked)), [kink]);
    let circle = [0.0, PI].map(|from| Edge::around(Vec2::ZERO, 0.3, [from, from + PI]));
    let hole = hole_of(&circle, 4);
    let mut problem = plate_with(vec![hole.clone()]);
    assert_eq!(found(&problem), []);
    let on = BoundaryPart::Sides(BoundaryRange { hole: 0, from: 1, to: 3 });
    problem.boundary.push(BoundaryCondition::pressure(on, 1.0.into()));
    let sides: Vec<Edge> = hole.edges().collect();
    let at = |p: Vec2| (p, 1.0, SingularCause::Load);
    assert_eq!(found(&problem), [at(sides[1].from), at(sides[3].from)]);
}
