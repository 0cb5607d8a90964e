//! Loads that jump, are bent, have layers and spikes: resultants against closed forms, warnings
//! about the rest.
//!
//! The reactions of the restraints balance the loads as they were integrated, to rounding
//! (see [`reactions`](super::reactions)): they tell of quadrature alone, however coarse the cells.

use crate::SQUARE_BODY;
use crate::studies::support::{parsed, solved};
use ppum::crack::Side;
use ppum::dataset::{Dataset, Warning, WarningKind};
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::vec2::{Vec2, vec2};
use ppum_testkit::random::Random;
use std::f64::consts::PI;

/// Adaptive rules aim at 1e-10 of the load.
const ACCURACY: f64 = 1e-9;

/// Rounding of systems whose condition is 1e5.
const EQUAL: f64 = 1e-9;

/// A plate [−1, 1]² held at the bottom, 2^level cells along each side, none of which is divided.
fn plate(rest: &str, level: u32, order: u32) -> Dataset {
    solution(rest, &format!("level = {level}\norder = {order}\nrefine = false"))
}

fn solution(rest: &str, discretization: &str) -> Dataset {
    let text = format!(
        "{SQUARE_BODY}[[boundary]]\non = \"bottom\"\ndisplacement = [0, 0]\n{rest}\n\
         [discretization]\n{discretization}\n"
    );
    solved(&parsed(&text))
}

fn on(part: &str, load: &str) -> String {
    format!("[[boundary]]\non = {part}\ntraction = [0, \"{load}\"]\n")
}

fn top(load: &str) -> String {
    on("\"top\"", load)
}

fn inside(load: &str) -> String {
    format!("[body_force]\nvalue = [0, \"{load}\"]\n")
}

/// The force along y and the moment about the centre that the loads exert.
fn resultant(dataset: &Dataset) -> [f64; 2] {
    let reactions = &dataset.steps[0].reactions;
    [
        -reactions.iter().map(|r| r.force[1]).sum::<f64>(),
        -reactions.iter().map(|r| r.moment).sum::<f64>(),
    ]
}

fn warnings(dataset: &Dataset) -> &[Warning] {
    &dataset.steps[0].warnings
}

fn points(dataset: &Dataset) -> f64 {
    let history = &dataset.steps[0].history;
    history.iter().find(|r| r.name == "quadrature points").map_or(f64::NAN, |r| r.value)
}

/// Holds force and moment of a load, with the size of the load.
fn assert_resultant(rest: &str, [force, moment]: [f64; 2], size: f64) {
    for (level, order) in [(1, 3), (2, 0), (3, 1)] {
        let dataset = plate(rest, level, order);
        let [f, m] = resultant(&dataset);
        // constants do not turn, so that nothing says that moments balance
        let moment_error = if order == 0 { 0.0 } else { (m - moment).abs() };
        let error = (f - force).abs().max(moment_error);
        println!("{error:e} {}", points(&dataset));
        assert!(error <= ACCURACY * size, "{rest} at level {level}, order {order}: {f} {m}");
        // of stresses, which are not looked at: cells at rims and, as none is divided, at the
        // corners that are held are coarse
        let of_stresses = [WarningKind::CoarseHole, WarningKind::SingularPoint];
        let others = warnings(&dataset).iter().filter(|w| !of_stresses.contains(&w.kind));
        assert_eq!(others.count(), 0, "{rest}: {:?}", warnings(&dataset));
    }
}

/// Boxes, ramps, spikes and layers of 1e-5 along the top; the moment of a load t(x) is ∫ x t.
#[test]
fn tractions_on_an_edge() {
    let mut random = Random(1);
    let (c, w) = (random.between(-0.5, 0.5), random.between(0.01, 0.4));
    assert_resultant(&top(&format!("if(abs(x - {c}) < {w}, 1, 0)")), [2.0 * w, 2.0 * w * c], w);
    // 0 up to c, w beyond c + w, moments of the triangle and of the rest
    let (end, rest) = (c + w, 1.0 - c - w);
    let (slope, flat) = (0.5 * w * w, w * rest);
    let moment = slope * (c + 2.0 / 3.0 * w) + flat * 0.5 * (1.0 + end);
    assert_resultant(&top(&format!("max(0, min({w}, x - {c}))")), [slope + flat, moment], w);
    let narrow = 1e-5;
    let spike = narrow * PI.sqrt();
    let text = format!("exp(-((x - {c})/{narrow})^2)");
    assert_resultant(&top(&text), [spike, spike * c], spike);
    // tanh is odd about c, and 1 to rounding where that does not cancel
    let text = format!("tanh((x - {c})/{narrow})/2 + 1/2");
    let moment = 0.5 * (1.0 - c * c) - narrow * narrow * PI * PI / 24.0;
    assert_resultant(&top(&text), [1.0 - c, moment], 1.0);
}

/// A hat as a table: a cubic spline through 0, 1, 0 with its ends constant beyond, and its
/// mirror image.
#[test]
fn tabulated_tractions() {
    let table = "[[table]]\nname = \"hat\"\nx = [0.0, 0.1, 0.2]\nvalues = [0.0, 1.0, 0.0]\n";
    let of = |load: &str| resultant(&plate(&(top(load) + table), 3, 2));
    let [force, moment] = of("table(hat, x)");
    assert!((moment - 0.1 * force).abs() < ACCURACY, "symmetric about 0.1: {force} {moment}");
    let [shifted, _] = of("table(hat, x + 0.4321)");
    assert!((shifted - force).abs() < ACCURACY, "{shifted} {force}");
    let [wide, _] = of("table(hat, (x + 0.4321)/2)");
    assert!((wide - 2.0 * force).abs() < ACCURACY, "{wide} {force}");
}

/// Half planes, discs and spikes as body forces.
#[test]
fn body_forces() {
    let mut random = Random(2);
    let (x, y, r) =
        (random.between(-0.4, 0.4), random.between(-0.4, 0.4), random.between(0.1, 0.5));
    let disc = PI * r * r;
    let text = inside(&format!("if(hypot(x - {x}, y - {y}) < {r}, 1, 0)"));
    assert_resultant(&text, [disc, disc * x], disc);
    // the line through (x, 0) with slope s: its part of each row y is 1 − x − s y long
    let s = random.between(-0.5, 0.5);
    let text = inside(&format!("if(x - {s}*y > {x}, 1, 0)"));
    let moment = 1.0 - x * x - s * s / 3.0;
    assert_resultant(&text, [2.0 * (1.0 - x), moment], 1.0);
    let narrow = 10.0_f64.powf(random.between(-4.0, -2.0));
    let spike = PI * narrow * narrow;
    let text = inside(&format!("exp(-((x - {x})^2 + (y - {y})^2)/{narrow}^2)"));
    assert_resultant(&text, [spike, spike * x], spike);
}

/// The upper part of a rim, and a part of one face of a crack in a refined cover.
#[test]
fn rims_and_faces() {
    let hole = "[[hole]]\ncenter = [0.1, 0.05]\nradius = 0.4\n";
    let upper = on("{ hole = 0 }", "if(y > 0.25, 1, 0)");
    let force = 2.0 * 0.4 * 0.5_f64.acos();
    assert_resultant(&(upper + hole), [force, 0.1 * force], force);
    let crack = "[[crack]]\npoints = [[-0.5, 0.1], [0.6, 0.1]]\n";
    let part = on("{ crack = 0, face = \"above\" }", "if(abs(x - 0.07) < 0.123, 1, 0)");
    let dataset = solution(&(part + crack), "level = 2");
    let [force, moment] = resultant(&dataset);
    assert!((force - 0.246).abs() < ACCURACY && (moment - 0.246 * 0.07).abs() < ACCURACY);
}

/// A pressure that jumps on both faces of a crack is one on each: that they balance each other
/// tells nothing of their rules.
#[test]
fn pressures_of_both_faces() {
    let mut random = Random(7);
    for kink in [0.0, 0.3] {
        let at = random.between(0.1, 0.3);
        let crack = format!("[[crack]]\npoints = [[-0.4, -0.05], [0.1, {kink}], [0.3, -0.35]]\n");
        let pressed = |faces: &[&str]| {
            let on = |face: &&str| {
                format!(
                    "[[boundary]]\non = {{ crack = 0 {face} }}\npressure = \"if(x > {at}, 1, 0)\"\n"
                )
            };
            plate(&(crack.clone() + &faces.iter().map(on).collect::<String>()), 3, 2)
        };
        let together = pressed(&[""]);
        let apart = pressed(&[", face = \"above\"", ", face = \"below\""]);
        let tips = |dataset: &Dataset| dataset.steps[0].intensities.clone();
        for (a, b) in tips(&together).iter().zip(&tips(&apart)) {
            assert!((a.k1 - b.k1).abs() < EQUAL && (a.k2 - b.k2).abs() < EQUAL, "{a:?} {b:?}");
        }
    }
}

/// −u″ = f with f = 1 up to a, u(0) = 0, u′(1) = 0: u(1) = ∫ x f = a²/2. The Green's function of
/// the end is x, which the space holds, so that Galerkin's value there is exact if the load is.
#[test]
fn the_end_of_a_bar() {
    for a in [0.1234, 0.5, 0.777] {
        let text = format!(
            "[equation]\nkind = \"poisson\"\n[domain]\nmin = [0.0, 0.0]\nmax = [1.0, 0.25]\n[source]\n\
             value = \"if(x < {a}, 1, 0)\"\n[[boundary]]\non = \"left\"\nvalue = 0\n[discretization]\n\
             cells = [4, 1]\norder = 2\n"
        );
        let problem = parsed(&text);
        let dataset = solved(&problem);
        let field = Field::new(&dataset, 0).expect("a field");
        let mut out = [Jet::constant(0.0)];
        assert!(field.at(vec2(1.0, 0.125)).evaluate::<0>(Vec2::ZERO, Side::Above, &mut out));
        let end = out[0].v;
        assert!((end - 0.5 * a * a).abs() < ACCURACY, "{end} {a}");
    }
}

/// Given values that jump: only their integrals count for the flow between two sides.
#[test]
fn given_values_that_jump() {
    let text = "[equation]\nkind = \"poisson\"\n[domain]\nmin = [-1, -1]\nmax = [1, 1]\n[source]\nvalue = 0\n\
                [[boundary]]\non = \"left\"\nvalue = \"if(y < 0.123, 1, 0)\"\n[[boundary]]\non = \"right\"\n\
                value = \"if(y < 0.123, 0, 1)\"\n[discretization]\nlevel = 2\n";
    let flow = |text: &str| {
        let problem = parsed(text);
        solved(&problem).steps[0].reactions.iter().map(|r| r.force[0]).collect::<Vec<_>>()
    };
    // Green's second identity with x: twice the flow through the plate, of width 2, is the
    // difference of the integrals of what is given on the right and on the left.
    let flows = flow(text);
    let expected = 1.123 - 0.877;
    assert!((flows[0] + flows[1]).abs() < ACCURACY, "{flows:?}");
    assert!((flows[0] - expected / 2.0).abs() < ACCURACY, "{flows:?}");
}

/// Loads that the rules of the system resolve keep them.
#[test]
fn smooth_loads_cost_nothing() {
    let plain = points(&plate(&top("1"), 3, 2));
    for load in ["x", "1 - x^2/4", "x*y^2", "sin(x)", "cos(2*x)*sin(y)"] {
        assert_eq!(points(&plate(&top(load), 3, 2)), plain, "{load}");
    }
    let plain = points(&plate(&inside("1"), 3, 2));
    for load in ["x", "1 - x^2/4", "sin(x)*cos(y)"] {
        assert_eq!(points(&plate(&inside(load), 3, 2)), plain, "{load}");
    }
}

/// Loads that are singular but integrable are right, or said to be wrong by about as much as
/// they are.
#[test]
fn singular_loads() {
    let root = 2.0 * (0.7_f64.sqrt() + 1.3_f64.sqrt());
    let log = 0.7 * 0.7_f64.ln() + 1.3 * 1.3_f64.ln() - 2.0;
    for (load, force) in [("1/sqrt(abs(x - 0.3))", root), ("log(abs(x - 0.3))", log)] {
        let dataset = plate(&top(load), 2, 2);
        let [found, _] = resultant(&dataset);
        let error = (found / force - 1.0).abs();
        println!("{load} {error:e} {:?}", warnings(&dataset));
        assert!(error < 1e-6, "{load}: {found} instead of {force}");
    }
}

/// A load that cannot be integrated is reported with its place and the part of it that is in doubt.
#[test]
fn loads_that_cannot_be_integrated() {
    for (load, at) in [("1/abs(x - 0.1)", Some(0.1)), ("1/x", Some(0.0)), ("1 + sin(1e9*x)", None)]
    {
        let dataset = plate(&top(load), 2, 2);
        let about_loads =
            warnings(&dataset).iter().filter(|warning| warning.kind == WarningKind::Load);
        let about_loads: Vec<_> = about_loads.collect();
        let [warning] = about_loads[..] else { panic!("{load}: {:?}", warnings(&dataset)) };
        println!("{}", warning.message);
        assert!(warning.value > 1e-3 && warning.message.contains("the top edge"), "{warning:?}");
        let place = warning.at.expect("a place");
        assert!(place.y == 1.0 && at.is_none_or(|x| (place.x - x).abs() < 1e-6), "{place:?}");
    }
}

/// The same circle in three formulas: it is cut once, with the points that one of them takes.
#[test]
fn one_circle_in_several_formulas() {
    let plate = |poisson: &str| {
        let text = format!(
            "[domain]\nmin = [-1, -1]\nmax = [1, 1]\n[material]\n\
             young = \"if((x - 0.1)^2 + (y + 0.05)^2 < 0.16, 1, 10)\"\npoisson = {poisson}\n\
             state = \"plane-strain\"\n[[boundary]]\non = \"bottom\"\ndisplacement = [0, 0]\n\
             [[boundary]]\non = \"top\"\ntraction = [0, 1]\n[[enrichment]]\nfunction = \"abs(r - 0.4)\"\n\
             at = [0.1, -0.05]\nwhere = \"abs(hypot(x - 0.1, y + 0.05) - 0.4) < 0.1\"\n\
             [discretization]\nlevel = 3\norder = 1\n"
        );
        points(&solved(&parsed(&text)))
    };
    let once = plate("0.3");
    for poisson in [
        "\"if((x - 0.1)^2 + (y + 0.05)^2 < 0.16, 0.2, 0.35)\"",
        "\"if(hypot(x - 0.1, y + 0.05) < 0.4, 0.2, 0.35)\"",
    ] {
        let found = plate(poisson);
        assert!((found / once - 1.0).abs() < 0.01, "{found} {once}");
    }
}
