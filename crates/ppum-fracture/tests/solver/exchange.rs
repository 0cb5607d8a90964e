//! Exchange with surroundings, κ ∂u/∂n = h (g − u): exact fields, what leaves through the border,
//! and the limits of coefficients.

use crate::studies::support::{Both, checked, errors, parsed, quantity, record, solved};
use ppum::dataset::Dataset;
use ppum::progress::unwatched;
use ppum::vec2::{Vec2, vec2};
use ppum_fracture::solve::solve;
use ppum_problem::{BaseCells, Problem, ProblemData};
use ppum_testkit::random::Random;
use std::f64::consts::PI;
use std::path::Path;

const KAPPA: f64 = 1.7;

/// Edges of the box [0, 2] × [0, 1] with their normals.
const EDGES: [(&str, Vec2); 4] = [
    ("left", vec2(-1.0, 0.0)),
    ("right", vec2(1.0, 0.0)),
    ("bottom", vec2(0.0, -1.0)),
    ("top", vec2(0.0, 1.0)),
];

fn plate(rest: &str, order: usize) -> String {
    format!(
        "[domain]\nmin = [0, 0]\nmax = [2, 1]\n[equation]\nkind = \"poisson\"\n\
         [material]\nconductivity = {KAPPA}\n[discretization]\ncells = [6, 3]\norder = {order}\n{rest}"
    )
}

fn exchange(on: &str, h: &str, g: &str) -> String {
    format!("[[boundary]]\non = {on}\nvalue = \"{g}\"\nexchange = \"{h}\"\n")
}

/// A potential by formulas of its value and its derivatives, as a problem whose edges exchange with
/// what makes it the solution.
fn surrounded(u: &str, [ux, uy]: [&str; 2], h: &str, rest: &str, order: usize) -> ProblemData {
    let on_edge = |(edge, n): (&str, Vec2)| {
        let g = format!("{u} + {KAPPA}*({ux}*({}) + {uy}*({}))/({h})", n.x, n.y);
        exchange(&format!("\"{edge}\""), h, &g)
    };
    parsed(&plate(&(EDGES.map(on_edge).concat() + rest), order))
}

/// A round hole whose rim exchanges, too.
fn hole(u: &str, [ux, uy]: [&str; 2], h: &str) -> String {
    let g = format!("{u} - {KAPPA}*({ux}*(x - 0.8) + {uy}*(y - 0.45))/0.2/({h})");
    "[[hole]]\ncenter = [0.8, 0.45]\nradius = 0.2\n".to_owned() + &exchange("{ hole = 0 }", h, &g)
}

/// A crack both of whose faces exchange, too.
fn crack(u: &str, [ux, uy]: [&str; 2], h: &str) -> String {
    let on_face = |(face, sign): (&str, f64)| {
        // out of the material above points (0.3, -1.1) of this length
        let n = vec2(0.3, -1.1) * (sign / 1.3_f64.sqrt());
        let g = format!("{u} + {KAPPA}*({ux}*({}) + {uy}*({}))/({h})", n.x, n.y);
        exchange(&format!("{{ crack = 0, face = \"{face}\" }}"), h, &g)
    };
    let faces = [("above", 1.0), ("below", -1.0)].map(on_face).concat();
    format!("[[crack]]\npoints = [[0.4, 0.3], [1.5, 0.6]]\n{faces}")
}

/// Fields that are polynomials are found, whatever the coefficient is; at rims and tips as far as
/// loads there are integrated.
#[test]
fn polynomials_are_exact() {
    let mut random = Random(42);
    for _ in 0..3 {
        let [a, b, c] = [0; 3].map(|_| random.between(-1.0, 1.0));
        let u = format!("({a} + {b}*x*y + {c}*(x^3 - 3*x*y^2) + x^2)");
        let derivatives =
            [format!("({b}*y + 3*{c}*(x^2 - y^2) + 2*x)"), format!("({b}*x - 6*{c}*x*y)")];
        let h = format!("({} + {}*x*y)", random.between(0.1, 5.0), random.between(0.1, 50.0));
        let source = format!("[source]\nvalue = {}\n", -2.0 * KAPPA);
        let derivatives = [&*derivatives[0], &derivatives[1]];
        let exact = |p: Vec2| {
            let Vec2 { x, y } = p;
            let value = a + b * x * y + c * (x * x * x - 3.0 * x * y * y) + x * x;
            let gradient =
                vec2(b * y + 3.0 * c * (x * x - y * y) + 2.0 * x, b * x - 6.0 * c * x * y);
            ([value, 0.0], [gradient, Vec2::ZERO])
        };
        let holes = [
            (String::new(), 0.0, 1e-10),
            (crack(&u, derivatives, &h), 0.0, 2e-6),
            (hole(&u, derivatives, &h), 0.04 * PI, 2e-6),
        ];
        for (hole, missing, bound) in holes {
            let solution = solved(&surrounded(&u, derivatives, &h, &(hole + &source), 3));
            let found = errors(&solution, &exact);
            println!("{found:?}");
            assert!(found.energy < bound && found.l2 < bound);
            balance(&solution, -2.0 * KAPPA * (2.0 - missing));
        }
    }
}

/// What comes in through the border is what the source takes.
fn balance(solution: &Dataset, source: f64) {
    let reactions = solution.steps[0].reactions.iter().map(|reaction| reaction.force[0]);
    let sum: f64 = reactions.sum();
    assert!((sum + source).abs() < 1e-9 * source.abs(), "{sum} {source}");
}

fn wave(p: Vec2) -> Both {
    let (s, c) = (3.0 * p.x).sin_cos();
    let (sh, ch) = ((3.0 * p.y).sinh(), (3.0 * p.y).cosh());
    ([s * ch, 0.0], [vec2(3.0 * c * ch, 3.0 * s * sh), Vec2::ZERO])
}

/// The error falls at the rate of the order, and is estimated.
#[test]
fn errors_fall_and_are_estimated() {
    let derivatives = ["(3*cos(3*x)*cosh(3*y))", "(3*sin(3*x)*sinh(3*y))"];
    for order in [1, 2, 3] {
        let at = |cells: [u32; 2]| {
            let (u, h) = ("(sin(3*x)*cosh(3*y))", "(2 + sin(4*x + y))");
            let mut problem = surrounded(u, derivatives, h, "", order);
            problem.discretization.cells = BaseCells::Grid(cells);
            let solution = solved(&problem);
            let error = errors(&solution, &wave).energy;
            let estimate = record(&solution.steps[0], "estimated error");
            println!("{order} {cells:?}: {error:.2e}, estimated {estimate:.2e}");
            assert!((1.0 / 3.0..30.0).contains(&(estimate / error)));
            error
        };
        let rate = (at([8, 4]) / at([16, 8])).log2();
        assert!((rate - order as f64).abs() < 0.5, "{rate}");
    }
}

/// A large coefficient holds the value, up to κ/h; a small one lets little pass.
#[test]
fn limits_of_coefficients() {
    let heated = |left: &str, order| {
        let flux = "[[boundary]]\non = \"right\"\nflux = 1.0\n";
        let source = "[source]\nvalue = \"sin(5*x*y)\"\n";
        solved(&parsed(&plate(&format!("{flux}{source}{left}"), order)))
    };
    let left = |h: f64| format!("[[boundary]]\non = \"left\"\nvalue = 1\nexchange = {h}\n");
    let held = heated("[[boundary]]\non = \"left\"\nvalue = 1\n", 4);
    let at = [vec2(0.3, 0.4), vec2(1.7, 0.9)];
    let far = |h: f64| {
        let yielding = heated(&left(h), 4);
        at.map(|p| (quantity(&yielding, "u", p) - quantity(&held, "u", p)) * h)
    };
    let ([first, second], large) = (far(1e2), far(1e3));
    println!("{first} {second} {large:?}");
    // through the left edge goes all that comes in, 1 and the source, and u jumps by flux / h
    assert!((first / large[0] - 1.0).abs() < 2e-2 && (second / large[1] - 1.0).abs() < 2e-2);
    assert!((1.0..1.6).contains(&first));
}

/// One condition whose coefficient jumps is two with a coefficient each; scale and units do no
/// harm.
#[test]
fn coefficients_that_jump() {
    let rest = "[[boundary]]\non = \"right\"\nvalue = \"y^2\"\n[source]\nvalue = \"x\"\n";
    let one = exchange("\"top\"", "if(x < 0.777, 1, 25)", "if(x < 0.777, x, 3)");
    let two = exchange("{ edge = \"top\", to = 0.777 }", "1", "x")
        + &exchange("{ edge = \"top\", from = 0.777 }", "25", "3");
    let [one, two] = [one, two].map(|top| solved(&parsed(&plate(&(top + rest), 3))));
    let mut random = Random(7);
    for _ in 0..20 {
        let p = vec2(random.between(0.0, 2.0), random.between(0.0, 1.0));
        let [u, v] = [&one, &two].map(|solution| quantity(solution, "u", p));
        assert!((u - v).abs() < 1e-9, "{p:?}: {u} {v}");
    }
}

/// What cannot be is said with its place.
#[test]
fn mistakes() {
    let wrong = |boundary: &str, message: &str| {
        let text = plate(&format!("[[boundary]]\non = \"top\"\n{boundary}\n"), 2);
        let error = Problem::parse(&text, "plate.toml", Path::new("")).expect_err("a mistake");
        assert!(error.to_string().contains(message), "{error}");
    };
    wrong("value = 1\nexchange = 0", "must be positive");
    wrong("value = 1\nexchange = -2", "must be positive");
    wrong("flux = 1\nexchange = 2", "needs the `value` of the surroundings");
    let text = plate("[[boundary]]\non = \"top\"\nvalue = 1\nexchange = \"x - 1\"\n", 2);
    let error = solve(&checked(&parsed(&text)), unwatched()).expect_err("a coefficient below zero");
    assert!(error.to_string().contains("exchange"), "{error}");
}
