//! Symmetry and antisymmetry to straight sides of outlines, whichever way these run.

use crate::studies::support::{parsed, record, solved};
use ppum::vec2::{Vec2, vec2};
use ppum_solve::problem::{Edge, Problem, Symmetry};
use ppum_testkit::random::Random;
use std::f64::consts::PI;

const YOUNG: f64 = 1.0;
const POISSON: f64 = 0.3;

/// A body in plane strain turned by an angle in degrees.
struct Turned {
    degrees: f64,
    order: usize,
    cells: usize,
}

impl Turned {
    fn point(&self, radius: f64, degrees: f64) -> String {
        let angle = (self.degrees + degrees).to_radians();
        format!("[{}, {}]", radius * angle.cos(), radius * angle.sin())
    }

    /// An arc about the origin as a piece of a path.
    fn arc(&self, radius: f64, [from, to]: [f64; 2]) -> String {
        let [from, to] = [from, to].map(|degrees| degrees + self.degrees);
        format!("arc = {{ center = [0, 0], radius = {radius}, from = {from}, to = {to} }}")
    }

    fn problem(&self, pieces: &[String], conditions: &str) -> Problem {
        let pieces: Vec<_> = pieces.iter().map(|piece| format!("{{ {piece} }}")).collect();
        parsed(&format!(
            "[domain]\noutline = {{ path = [{}] }}\n[material]\nyoung = {YOUNG}\npoisson = {POISSON}\n\
             state = \"plane-strain\"\n[discretization]\ncells = [{n}, {n}]\norder = {}\n{conditions}",
            pieces.join(", "),
            self.order,
            n = self.cells
        ))
    }

    /// A quarter of a ring with the radii 1 and 2 whose straight sides have a symmetry.
    fn quarter(&self, symmetry: &str, pressure: &str) -> Problem {
        let side = |[from, to]: [f64; 2], degrees: f64, name: &str| {
            let ends = [from, to].map(|radius| self.point(radius, degrees)).join(", ");
            format!("points = [{ends}], name = \"{name}\"")
        };
        let pieces = [
            side([1.0, 2.0], 0.0, "base"),
            self.arc(2.0, [0.0, 90.0]),
            side([2.0, 1.0], 90.0, "axis"),
            self.arc(1.0, [90.0, 0.0]) + ", name = \"bore\"",
        ];
        let sides = ["base", "axis"].map(|name| {
            format!("[[boundary]]\non = {{ piece = \"{name}\" }}\n{symmetry} = true\n")
        });
        let bore = format!("[[boundary]]\non = {{ piece = \"bore\" }}\npressure = {pressure}\n");
        self.problem(&pieces, &(sides.concat() + &bore))
    }

    /// The rectangle of the sides 1 and 2 with conditions on the sides "bottom", "right", …
    fn rectangle(&self, conditions: &str) -> Problem {
        let corner = |k: usize| {
            let p = [vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(1.0, 2.0), vec2(0.0, 2.0)][k % 4];
            self.point(p.length(), p.y.atan2(p.x).to_degrees())
        };
        let names = ["bottom", "right", "top", "left"].iter().enumerate();
        let side = |(k, name): (usize, &&str)| {
            format!("points = [{}, {}], name = \"{name}\"", corner(k), corner(k + 1))
        };
        self.problem(&names.map(side).collect::<Vec<_>>(), conditions)
    }
}

/// Angles, those of the axes among them.
fn angles(seed: u64, count: usize) -> Vec<f64> {
    let mut random = Random(seed);
    let any = (0..count).map(|_| random.between(0.0, 360.0));
    [0.0, 90.0].into_iter().chain(any).collect()
}

fn energy(problem: &Problem) -> f64 {
    record(&solved(problem).steps[0], "energy")
}

/// u of Lamé's ring with the pressure 1 at r = 1, there.
fn expansion() -> f64 {
    (1.0 + POISSON) / YOUNG * (1.0 - 2.0 * POISSON + 4.0) / 3.0
}

/// The energy of a quarter of Lamé's ring is ¼ π p u, up to the polygons of its rims, which change
/// it by 2e-6; found are 6e-3, 9e-6 and 2e-6 at orders 1, 2 and 4.
#[test]
fn quarters_of_rings() {
    let exact = 0.25 * PI * expansion();
    for degrees in angles(3, 2) {
        let error = |order: usize| {
            let ring = Turned { degrees, order, cells: 9 };
            (energy(&ring.quarter("symmetry", "1")) / exact - 1.0).abs()
        };
        let [first, second, fourth] = [1, 2, 4].map(error);
        println!("{degrees}: {first:.1e}, {second:.1e}, {fourth:.1e}");
        assert!(first < 2e-2 && second < 1e-4 && fourth < 5e-6, "{degrees}");
    }
}

/// The pressure sin 2θ on the bore has the antisymmetry of both sides: the energy of the quarter is
/// a quarter of that of the whole ring, which nothing holds.
#[test]
fn antisymmetric_quarters_of_rings() {
    for degrees in angles(4, 2) {
        let ring = Turned { degrees, order: 4, cells: 13 };
        let pressure = format!("\"sin(2*(atan2(y, x) - {}))\"", degrees.to_radians());
        let quarter = energy(&ring.quarter("antisymmetry", &pressure));
        let rim = |radius| [[0.0, 180.0], [180.0, 360.0]].map(|half| ring.arc(radius, half));
        let hole = format!(
            "[[hole]]\npath = [{{ {} }}]\n[[boundary]]\non = {{ hole = 0 }}\npressure = {pressure}\n",
            rim(1.0).join(" }, { ")
        );
        let whole = Turned { cells: 25, ..ring }.problem(&rim(2.0), &hole);
        let relative = quarter / (0.25 * energy(&whole)) - 1.0;
        assert!(relative.abs() < 1e-5, "{degrees}: {relative:e}");
    }
}

/// A uniform tension and a uniform shear are polynomials: their energies are exact, and so are the
/// forces at the sides.
#[test]
fn uniform_stresses() {
    let modulus = YOUNG / (1.0 - POISSON * POISSON);
    let shear = 0.5 * YOUNG / (1.0 + POISSON);
    for degrees in angles(5, 6) {
        let rectangle = Turned { degrees, order: 2, cells: 7 };
        let along = |p: Vec2| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            vec2(cos * p.x - sin * p.y, sin * p.x + cos * p.y)
        };
        let on = |name: &str, what: String| {
            format!("[[boundary]]\non = {{ piece = \"{name}\" }}\n{what}\n")
        };
        let load =
            |name: &str, t: Vec2| on(name, format!("traction = [{}, {}]", along(t).x, along(t).y));
        let sides = |key: &str| {
            on("bottom", format!("{key} = true")) + &on("left", format!("{key} = true"))
        };
        let pulled = sides("symmetry") + &load("top", vec2(0.0, 1.0));
        let sheared =
            sides("antisymmetry") + &load("top", vec2(1.0, 0.0)) + &load("right", vec2(0.0, 1.0));
        // reactions at the bottom and on the left
        let pulled_forces = [vec2(0.0, -1.0), Vec2::ZERO];
        let sheared_forces = [vec2(-1.0, 0.0), vec2(0.0, -2.0)];
        for (conditions, exact, forces) in
            [(pulled, 1.0 / modulus, pulled_forces), (sheared, 1.0 / shear, sheared_forces)]
        {
            let step = solved(&rectangle.rectangle(&conditions)).steps.remove(0);
            let energy = record(&step, "energy");
            assert!((energy / exact - 1.0).abs() < 1e-9, "{degrees}: {energy}, not {exact}");
            for (reaction, force) in step.reactions.iter().zip(forces.map(along)) {
                let found = vec2(reaction.force[0], reaction.force[1]);
                assert!((found - force).length() < 1e-9, "{degrees}: {reaction:?}, not {force:?}");
            }
        }
    }
}

/// A quarter of a plate with a hole as a box and as an outline.
#[test]
fn outlines_and_boxes_agree() {
    let order = 4;
    let of_box = parsed(&format!(
        "[domain]\nmin = [0, 0]\nmax = [1, 1]\n[material]\nyoung = {YOUNG}\npoisson = {POISSON}\n\
         state = \"plane-strain\"\n[discretization]\ncells = [12, 12]\norder = {order}\n\
         [[hole]]\ncenter = [0, 0]\nradius = 0.4\n\
         [[boundary]]\non = \"left\"\nsymmetry = true\n[[boundary]]\non = \"bottom\"\nsymmetry = true\n\
         [[boundary]]\non = \"top\"\ntraction = [0, 1]\n"
    ));
    let of_box = energy(&of_box);
    for degrees in angles(6, 2) {
        let plate = Turned { degrees, order, cells: 13 };
        let [a, b, c, d, e] =
            [(0.4, 0.0), (1.0, 0.0), (2f64.sqrt(), 45.0), (1.0, 90.0), (0.4, 90.0)]
                .map(|(radius, degrees)| plate.point(radius, degrees));
        let pieces = [
            format!("points = [{a}, {b}], name = \"symmetric\""),
            format!("points = [{b}, {c}]"),
            format!("points = [{c}, {d}], name = \"top\""),
            format!("points = [{d}, {e}], name = \"left\""),
            plate.arc(0.4, [90.0, 0.0]),
        ];
        let (sin, cos) = degrees.to_radians().sin_cos();
        let conditions = format!(
            "[[boundary]]\non = {{ piece = \"symmetric\" }}\nsymmetry = true\n\
             [[boundary]]\non = {{ piece = \"left\" }}\nsymmetry = true\n\
             [[boundary]]\non = {{ piece = \"top\" }}\ntraction = [{}, {cos}]\n",
            -sin
        );
        let relative = energy(&plate.problem(&pieces, &conditions)) / of_box - 1.0;
        assert!(relative.abs() < 2e-5, "{degrees}: {relative:e}");
    }
}

/// The sides of the quarter are edges of the box around it.
#[test]
fn sides_are_mirrors() {
    let mut ring = Turned { degrees: 0.0, order: 2, cells: 9 };
    for (key, kind) in
        [("symmetry", Symmetry::Symmetric), ("antisymmetry", Symmetry::Antisymmetric)]
    {
        let mirrors = ring.quarter(key, "1").mirrors();
        assert_eq!(mirrors, [(Edge::Left, kind), (Edge::Bottom, kind)]);
    }
    ring.degrees = 180.0;
    let edges: Vec<Edge> = ring.quarter("symmetry", "1").mirrors().iter().map(|m| m.0).collect();
    assert_eq!(edges, [Edge::Right, Edge::Top]);
    ring.degrees = 20.0;
    assert!(ring.quarter("symmetry", "1").mirrors().is_empty());
}
