//! Loads on faces of cracks and rims, against what superposition says of them.
//!
//! A plate under the tractions σ n of a uniform stress σ on its edges and one under −σ n on its
//! faces and rims differ by the uniform field alone. It is in the space from order 1 on, so the two
//! discrete problems differ by nothing else either: what remains is quadrature and rounding,
//! whatever the cells.

use crate::studies::support::{parsed, solved, strain_energy};
use crate::support::factors;
use ppum::crack::{End, SegmentId, Side};
use ppum::dataset::{Dataset, Material, StressState};
use ppum::domain::{Domain, Hole};
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::quantity::Quantity;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::{
    BaseCells, BoundaryCondition, BoundaryPart, Condition, Discretization, DomainEdge, Expression,
    PolynomialOrder, ProblemData,
};
use ppum_testkit::random::Random;

const MATERIAL: Material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
const CONDUCTIVITY: f64 = 2.0;

/// Rounding, as far as the condition of the systems amplifies it.
const EQUAL: f64 = 1e-9;

/// Stresses at a point, in the corner of a cell or near a tip, err more than energies and factors.
const AT_A_POINT: f64 = 100.0;

/// A uniform stress, or of a potential the flux in its first row.
#[derive(Clone, Copy, Debug)]
struct Flux {
    rows: [Vec2; 2],
    components: usize,
}

const ALL_ROUND: Flux = Flux { rows: [vec2(1.0, 0.0), vec2(0.0, 1.0)], components: 2 };

impl Flux {
    fn stress(random: &mut Random) -> Self {
        let [xx, yy, xy] = [0; 3].map(|_| random.between(-1.0, 1.0));
        Self { rows: [vec2(xx, xy), vec2(xy, yy)], components: 2 }
    }

    fn of_potential(random: &mut Random) -> Self {
        Self { rows: [random.direction(), Vec2::ZERO], components: 1 }
    }

    /// σ n.
    fn through(&self, normal: Vec2) -> Vec<Condition> {
        let row = |row: &Vec2| Condition::Neumann(row.dot(normal).into());
        self.rows[..self.components].iter().map(row).collect()
    }

    /// −σ n on the rim of a round hole.
    fn off_rim(&self, center: Vec2, radius: f64) -> Vec<Condition> {
        let row = |row: &Vec2| {
            let scaled = *row / radius;
            let text = format!(
                "({:?})*(x - ({:?})) + ({:?})*(y - ({:?}))",
                scaled.x, center.x, scaled.y, center.y
            );
            Condition::Neumann(Expression::parse(&text).expect("a formula"))
        };
        self.rows[..self.components].iter().map(row).collect()
    }

    /// Quantities of the uniform field and their values.
    fn uniform(&self) -> Vec<(&'static str, f64)> {
        let [a, b] = self.rows;
        match self.components {
            1 => vec![("du_dx", a.x / CONDUCTIVITY), ("du_dy", a.y / CONDUCTIVITY)],
            _ => vec![("sxx", a.x), ("syy", b.y), ("sxy", a.y)],
        }
    }

    /// Twice the energy of the uniform field in a unit of area.
    fn work(&self) -> f64 {
        let [a, b] = self.rows;
        if self.components == 1 {
            return a.dot(a) / CONDUCTIVITY;
        }
        let (trace, square) = (a.x + b.y, a.dot(a) + b.dot(b));
        (square - MATERIAL.poisson * trace * trace) / (2.0 * MATERIAL.mu())
    }
}

/// A plate with cracks, round holes, and a uniform flux, whose cells are divided on request.
#[derive(Clone, Debug)]
struct Case {
    bounds: Rect,
    cracks: Vec<Vec<Vec2>>,
    holes: Vec<(Vec2, f64)>,
    level: u32,
    order: usize,
    refine: bool,
    flux: Flux,
}

impl Case {
    fn new(cracks: Vec<Vec<Vec2>>, level: u32, order: usize, flux: Flux) -> Self {
        let bounds = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
        Self { bounds, cracks, holes: Vec::new(), level, order, refine: false, flux }
    }

    /// The same elsewhere. Edges move by the very numbers that points move by.
    fn moved(mut self, way: Vec2) -> Self {
        self.bounds = Rect::new(self.bounds.min + way, self.bounds.max + way);
        self.cracks.iter_mut().flatten().for_each(|p| *p = *p + way);
        self.holes.iter_mut().for_each(|(center, _)| *center = *center + way);
        self
    }

    /// The same with all cracks in the other direction.
    fn reversed(mut self) -> Self {
        self.cracks.iter_mut().for_each(|points| points.reverse());
        self
    }

    fn problem(&self) -> ProblemData {
        let hole = |&(center, radius): &(Vec2, f64)| Hole::Circle { center, radius };
        let domain = Domain { bounds: self.bounds, holes: self.holes.iter().map(hole).collect() };
        let cells = BaseCells::Level(self.level);
        let mut set = Discretization::new(cells);
        (set.order, set.refine) = (PolynomialOrder::Uniform(self.order), self.refine);
        let problem = match self.flux.components {
            1 => ProblemData::poisson(domain, CONDUCTIVITY, set),
            _ => ProblemData::elasticity(domain, MATERIAL, set),
        };
        let points = |crack: &Vec<Vec2>| crack.iter().map(|&p| p.into()).collect::<Vec<_>>();
        self.cracks.iter().fold(problem, |problem, crack| problem.with_crack(&points(crack)))
    }

    fn on_edges(&self) -> Dataset {
        let with = |problem: ProblemData, edge: DomainEdge| {
            problem.with_boundary(edge, self.flux.through(edge.normal()))
        };
        solved(&DomainEdge::ALL.into_iter().fold(self.problem(), with))
    }

    /// Kinked cracks get a pressure of 1, which is that of all-round tension.
    fn on_faces(&self) -> Dataset {
        let mut problem = self.problem();
        for (crack, points) in self.cracks.iter().enumerate() {
            for (side, out) in [(Side::Above, -1.0), (Side::Below, 1.0)] {
                let on = BoundaryPart::Crack { crack, face: Some(side) };
                let normal = (points[1] - points[0]).unit().left() * out;
                problem.boundary.push(match points.len() {
                    2 => BoundaryCondition::new(on, self.flux.through(-normal)),
                    _ => BoundaryCondition::pressure(on, 1.0.into()),
                });
            }
        }
        for (hole, &(center, radius)) in self.holes.iter().enumerate() {
            let load = self.flux.off_rim(center, radius);
            problem.boundary.push(BoundaryCondition::new(BoundaryPart::Hole(hole), load));
        }
        solved(&problem)
    }

    /// The rules in the cells are made to leave 1e-8 of the energy at order 1
    /// (`Orders::for_degree`), of coarse cells with tips a few times as much; each order more
    /// leaves a twentieth, halved cells less. Rules along faces leave nothing that is seen.
    fn tolerance(&self) -> f64 {
        let cells = if self.level < 4 { 3e-7 } else { 1e-9 };
        (cells * 20f64.powi(1 - self.order as i32)).max(EQUAL)
    }

    /// Holds factors, energies and fields to what superposition says.
    fn check(&self) {
        let (edges, faces) = (self.on_edges(), self.on_faces());
        let tolerance = self.tolerance();
        assert_factors_agree(&factors(&edges), &factors(&faces), tolerance);
        // ½ a(u₀, u₀) + a(u_f, u₀), the second the work of the loads on the rims
        let size = self.bounds.size();
        let holes: f64 = self.holes.iter().map(|(_, r)| std::f64::consts::PI * r * r).sum();
        let (large, small) = (strain_energy(&edges), strain_energy(&faces));
        let expected = 0.5 * self.flux.work() * (size.x * size.y + holes);
        assert!((large - small - expected).abs() < tolerance * large, "{large} {small} {self:?}");
        let [edges, faces] = [&edges, &faces].map(|d| Field::new(d, 0).expect("a field"));
        let mut random = Random(1);
        let inside = |p: &Vec2| self.holes.iter().all(|(c, r)| (*p - *c).length() > *r);
        let points = (0..40).map(|_| random.point(&self.bounds)).filter(inside);
        for p in points.collect::<Vec<_>>() {
            for (name, expected) in self.flux.uniform() {
                let [a, b] = [&edges, &faces].map(|field| value(field, name, p));
                let apart = (a - b - expected).abs();
                let most = AT_A_POINT * tolerance * (1.0 + a.abs());
                assert!(apart < most, "{name} at {p:?}: {apart:e} {self:?}");
            }
        }
    }
}

fn value(field: &Field<'_>, name: &str, p: Vec2) -> f64 {
    let quantity = Quantity::parse(name, field).expect("a quantity");
    quantity.at(&mut field.at(p), Vec2::ZERO, Side::Above)
}

#[track_caller]
fn assert_factors_agree(a: &[[f64; 2]], b: &[[f64; 2]], tolerance: f64) {
    assert_eq!(a.len(), b.len());
    let scale = a.iter().flatten().fold(0.0f64, |m, k| m.max(k.abs()));
    for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
        assert!((a - b).abs() <= tolerance * scale, "{a} and {b}");
    }
}

/// A straight crack through the middle of the plate, in general position.
fn straight(random: &mut Random) -> Vec<Vec2> {
    let (center, arm) = (random.direction() * 0.15, random.direction());
    vec![center - arm * random.between(0.3, 0.6), center + arm * random.between(0.3, 0.6)]
}

fn kinked(random: &mut Random) -> Vec<Vec2> {
    let (kink, arm, turn) =
        (random.direction() * 0.1, random.direction(), random.between(-1.0, 1.0));
    let other = arm * turn.cos() + arm.left() * turn.sin();
    vec![kink - arm * random.between(0.3, 0.6), kink, kink + other * random.between(0.3, 0.6)]
}

/// An oblique crack under all-round tension in cells that are divided.
fn oblique(level: u32, order: usize) -> Case {
    let crack = vec![vec2(-0.4, -0.15), vec2(0.45, 0.2)];
    Case { refine: true, ..Case::new(vec![crack], level, order, ALL_ROUND) }
}

/// In coarse cells, and against what is known of it in finer ones.
#[test]
fn pressure_is_tension() {
    oblique(2, 1).check();
    // hp finite elements of an independent solver, good to the digits given; cells of this size
    // come as near as 1e-4
    let dataset = oblique(4, 2).on_faces();
    for ([k1, _], expected) in factors(&dataset).into_iter().zip([1.53939, 1.55280]) {
        assert!((k1 / expected - 1.0).abs() < 2e-4, "{k1} instead of {expected}");
    }
}

/// The finer the cells, the farther the crack's start is for the points.
#[test]
#[ignore = "slow: level 4"]
fn pressure_is_tension_in_fine_cells() {
    oblique(4, 1).check();
}

#[test]
fn any_stress_on_straight_cracks() {
    let mut random = Random(1);
    for far in [0.0, 1e4] {
        let flux = Flux::stress(&mut random);
        let way = random.direction() * far;
        Case::new(vec![straight(&mut random)], 3, 2, flux).moved(way).check();
    }
}

#[test]
fn all_orders() {
    let mut random = Random(2);
    for order in [1, 3, 5] {
        let flux = Flux::stress(&mut random);
        Case::new(vec![straight(&mut random)], 2, order, flux).check();
    }
}

#[test]
#[ignore = "slow: the rules of order 8"]
fn the_highest_order() {
    let mut random = Random(2);
    let flux = Flux::of_potential(&mut random);
    Case { refine: true, ..Case::new(vec![straight(&mut random)], 1, 8, flux) }.check();
}

#[test]
fn kinked_cracks() {
    let mut random = Random(3);
    for round in 0..2 {
        let case = Case::new(vec![kinked(&mut random)], 3, 1 + round % 2, ALL_ROUND);
        case.moved(random.direction() * [0.0, 1e3][round % 2]).check();
    }
}

/// A crack from an edge, and one out of a hole, whose rim is loaded too.
#[test]
fn cracks_from_edges_and_holes() {
    let mut random = Random(4);
    let flux = Flux::stress(&mut random);
    let mouth = vec2(-1.0, random.between(-0.3, 0.3));
    let arm = vec2(1.0, random.between(-0.5, 0.5)) * 0.8;
    Case::new(vec![vec![mouth, mouth + arm]], 3, 2, flux).check();

    let center = random.direction() * 0.1 + vec2(-0.4, 0.0);
    let arm = vec2(1.0, random.between(-0.6, 0.6)).unit();
    let crack = vec![center + arm * 0.2, center + arm * 0.8];
    let holes = vec![(center, 0.25)];
    Case { holes, ..Case::new(vec![crack], 3, 2, flux) }.check();
}

#[test]
fn fluxes_of_a_potential() {
    let mut random = Random(5);
    for round in 0..3 {
        let flux = Flux::of_potential(&mut random);
        let case = Case::new(vec![straight(&mut random)], 3, 1 + round % 3, flux);
        case.moved(random.direction() * [0.0, 1e3][round % 2]).check();
    }
}

/// A load on one face alone, in a plate that its edge holds: what the edge bears is what acts on
/// the face, and the direction in which the crack is given tells nothing.
#[test]
fn one_face_alone() {
    let mut random = Random(6);
    for round in 0..2 {
        let points = straight(&mut random);
        let traction = random.direction();
        let case = Case::new(vec![points.clone()], 3, round, ALL_ROUND);
        let loaded = |case: &Case, side: Side| {
            let fixed = || Condition::Dirichlet(0.0.into());
            let mut problem =
                case.problem().with_boundary(DomainEdge::Left, vec![fixed(), fixed()]);
            let on = BoundaryPart::Crack { crack: 0, face: Some(side) };
            let load = [traction.x, traction.y].map(|t| Condition::Neumann(t.into()));
            problem.boundary.push(BoundaryCondition::new(on, load.into()));
            solved(&problem)
        };
        let (above, below) =
            (loaded(&case, Side::Above), loaded(&case.clone().reversed(), Side::Below));
        let length = (points[1] - points[0]).length();
        let borne = &above.steps[0].reactions[0].force;
        for (force, t) in borne.iter().zip([traction.x, traction.y]) {
            assert!((force + t * length).abs() < 1e-10 * length, "{force} under {}", t * length);
        }
        let mut swapped = factors(&below);
        swapped.reverse();
        assert_factors_agree(&factors(&above), &swapped, EQUAL);
        let [a, b] = [&above, &below].map(strain_energy);
        assert!((a / b - 1.0).abs() < EQUAL, "{a} {b}");
        let ends = above.steps[0].intensities.iter().map(|tip| tip.tip.end);
        assert!(ends.eq([End::Start, End::Last]) || factors(&above).is_empty());
    }
}

/// On faces that run along borders of patches, where the slopes of weights jump, values and
/// stresses are the limits from their own side, whichever way the crack runs.
#[test]
fn faces_along_borders_of_patches_have_their_own_limits() {
    let mut random = Random(21);
    for k in 0..12 {
        let overlap = random.between(1.2, 1.6);
        let row = 2.0 + (4.0 * random.unit()).floor();
        // the upper or the lower border of a row of patches
        let level =
            -1.0 + 0.25 * (row + 0.5) + 0.125 * overlap * if k % 2 == 0 { 1.0 } else { -1.0 };
        let mut ends = [[-0.53, level], [0.47, level]];
        if k % 4 < 2 {
            ends.iter_mut().for_each(|end| end.reverse());
        }
        if k % 3 == 0 {
            ends.reverse();
        }
        let problem = parsed(&format!(
            r#"
            domain = {{ min = [-1, -1], max = [1, 1] }}
            material = {{ young = 1.0, poisson = 0.3, state = "plane-strain" }}
            crack = [{{ points = {ends:?} }}]
            boundary = [
                {{ on = "top", traction = [0.3, "1 + x*x"] }}, {{ on = "bottom", displacement = [0, 0] }},
                {{ on = {{ crack = 0, face = "above" }}, traction = ["x", "y + 1"] }},
            ]
            discretization = {{ cells = [8, 8], order = 2, overlap = {overlap}, refine = false }}
            "#
        ));
        let dataset = solved(&problem);
        let field = Field::new(&dataset, 0).expect("a field");
        let [a, b] = ends.map(Vec2::from);
        let left = (b - a).unit().left();
        for part in [0.3, 0.5, random.between(0.1, 0.9)] {
            let at = a + (b - a) * part;
            let mut on = field.on(SegmentId { crack: 0, segment: 0 }, at);
            for (side, way) in [(Side::Above, 1e-9), (Side::Below, -1e-9)] {
                let (mut face, mut beside) = ([Jet::constant(0.0); 2], [Jet::constant(0.0); 2]);
                assert!(on.evaluate::<1>(Vec2::ZERO, side, &mut face));
                assert!(field.at(at).evaluate::<1>(left * way, side, &mut beside));
                let mut many = [Jet::constant(0.0); 8];
                on.evaluate_into::<1>(&[Vec2::ZERO; 4], side, &mut many);
                for (i, limit) in beside.iter().enumerate() {
                    for found in [face[i], many[6 + i]] {
                        let apart = [found.v - limit.v, found.x - limit.x, found.y - limit.y];
                        let worst = apart.into_iter().fold(0.0, |m: f64, d| m.max(d.abs()));
                        assert!(worst < 1e-6, "{ends:?} {overlap} {side:?} {at:?}: {worst:e}");
                    }
                }
            }
        }
    }
}
