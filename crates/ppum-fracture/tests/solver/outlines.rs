//! Bodies of any outline.

use crate::studies::support::{parsed, quantity, solved};
use ppum::dataset::{Dataset, Material, StressState};
use ppum::domain::{Domain, Hole};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::{
    BaseCells, BoundaryCondition, BoundaryPart, Discretization, Enrichment, PolynomialOrder,
    ProblemData,
};
use ppum_testkit::random::Random;
use std::f64::consts::TAU;
use std::path::Path;

const MATERIAL: Material = Material { young: 2.0, poisson: 0.3, state: StressState::PlaneStress };

fn turned(p: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * p[0] - sin * p[1], sin * p[0] + cos * p[1]]
}

/// A body under a pressure all around has the stress −p, whatever its shape: polynomials of first
/// degree, integrated over cells that the outline cuts anyhow.
#[test]
fn pressed_bodies_have_no_shear() {
    let mut random = Random(21);
    for round in 0..8 {
        let count = 3 + random.below(7);
        let corner = |k: usize| {
            let angle = TAU * (k as f64 + random.between(0.0, 0.8)) / count as f64;
            let far = random.between(0.4, 1.0);
            vec2(angle.cos(), angle.sin()) * far
        };
        let points: Vec<Vec2> = (0..count).map(corner).collect();
        let bounds = Rect::new(vec2(-1.1, -1.2), vec2(1.3, 1.1));
        let domain = Domain { bounds, holes: vec![Hole::outside(points.clone())] };
        let cells = BaseCells::Grid([4 + random.below(5) as u32, 5]);
        // the basis keeps functions down to 3e-7 of the others, which multiplies rounding in
        // slivers; functions of corners are integrated by rules that are not exact
        let (enrichment, tolerance) = match round % 2 {
            0 => (Enrichment::None, 1e-7),
            _ => (Enrichment::Williams, 1e-6),
        };
        let set = Discretization {
            order: PolynomialOrder::Uniform(2),
            enrichment,
            ..Discretization::new(cells)
        };
        let mut problem = ProblemData::elasticity(domain, MATERIAL, set);
        let pressure = BoundaryCondition::pressure(BoundaryPart::Hole(0), 3.0.into());
        problem.boundary.push(pressure);
        let dataset = solved(&problem);
        let mut inside = 0;
        while inside < 50 {
            let p = vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
            if !dataset.domain.contains(p) {
                continue;
            }
            inside += 1;
            for (name, exact) in [("sxx", -3.0), ("syy", -3.0), ("sxy", 0.0)] {
                let value = quantity(&dataset, name, p);
                assert!((value - exact).abs() < tolerance, "{round} {p:?} {name} {value}");
            }
        }
    }
}

/// A plate with a crack as a box, as an outline, turned, and with sides of many short segments.
fn plate(angle: f64, is_box: bool) -> ProblemData {
    let corners = [[-1.0, -2.0], [1.0, -2.0], [1.0, 2.0], [-1.0, 2.0]];
    let piece = |k: usize| {
        let [a, b] = [corners[k], corners[(k + 1) % 4]].map(|p| turned(p, angle));
        format!("{{ points = [{a:?}, {b:?}], name = \"side {k}\" }}")
    };
    let (sin, cos) = angle.sin_cos();
    let load = |sign: f64| {
        let size = format!("(1 + {cos:?}*x + {sin:?}*y)");
        format!("[\"{:?}*{size}\", \"{:?}*{size}\"]", -sin * sign, cos * sign)
    };
    let crack = [[-0.4, 0.1], [0.5, 0.1]].map(|p| turned(p, angle));
    let (domain, ends, cells) = if is_box {
        let domain = "min = [-1, -2]\nmax = [1, 2]".to_owned();
        (domain, ["\"bottom\"", "\"top\""], "[12, 24]")
    } else {
        let path = [0, 1, 2, 3].map(piece).join(", ");
        let ends = ["{ piece = \"side 0\" }", "{ piece = \"side 2\" }"];
        (format!("outline = {{ path = [{path}] }}"), ends, "[20, 26]")
    };
    parsed(&format!(
        "[domain]\n{domain}\n[[crack]]\npoints = {crack:?}\n[material]\nyoung = 1\npoisson = 0.3\n\
         state = \"plane-stress\"\n[[boundary]]\non = {}\ntraction = {}\n[[boundary]]\non = {}\n\
         traction = {}\n[discretization]\ncells = {cells}\norder = 5\n",
        ends[0],
        load(-1.0),
        ends[1],
        load(1.0),
    ))
}

fn factors(dataset: &Dataset) -> Vec<f64> {
    let tips = dataset.steps[0].intensities.iter();
    tips.flat_map(|tip| [tip.k1, tip.k2, tip.t_stress.expect("T of a uniform body")]).collect()
}

/// Box and outlines at any angle have the same factors, in parts of the largest one.
#[test]
fn factors_do_not_depend_on_the_outline() {
    let boxed = factors(&solved(&plate(0.0, true)));
    for angle in [0.0, 0.4, 2.0] {
        let found = factors(&solved(&plate(angle, false)));
        assert_eq!((boxed.len(), found.len()), (6, 6));
        let apart = boxed.iter().zip(&found).map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f64::max) < 1e-7, "{angle}: {boxed:?} {found:?}");
    }
}

/// Held and loaded pieces of arcs: reactions balance the loads, whatever the cells.
#[test]
fn reactions_of_pieces_balance_loads() {
    let text = r#"
[domain.outline]
path = [
  { points = [[0, 0], [3, 0.2]] },
  { arc = { center = [3, 0.7], radius = 0.5, from = -90, to = 90 }, name = "nose" },
  { points = [[3, 1.2], [0.2, 1.5]] },
  { spline = [[0.2, 1.5], [0.4, 0.8], [0, 0]], name = "root" },
]
[[hole]]
path = [
  { arc = { center = [3, 0.7], radius = 0.25, from = 0, to = 180 }, name = "pin" },
  { arc = { center = [3, 0.7], radius = 0.25, from = 180, to = 360 } },
]
[material]
young = 1
poisson = 0.3
state = "plane-stress"
[[boundary]]
on = { piece = "root" }
displacement = [0, 0]
[[boundary]]
on = { piece = "pin" }
traction = ["x - 3", "0.7 - y"]
[[boundary]]
on = { piece = "nose" }
pressure = 0.1
[discretization]
level = 3
"#;
    let dataset = solved(&parsed(text));
    let [root] = &dataset.steps[0].reactions[..] else { panic!("one support") };
    assert_eq!(root.on, "piece root");
    // ∫ (0.7 − y) over the upper half circle of radius r is −2 r²; the pressure on the nose is
    // that on its chord, of length 1
    let exact = [0.1, 2.0 * 0.25 * 0.25];
    for (found, exact) in root.force.iter().zip(exact) {
        assert!((found - exact).abs() < 3e-5, "{:?}", root.force);
    }
}

/// One half of a body that its box cuts is the whole's half.
#[test]
fn boxes_cut_outlines() {
    let text = |min: &str, support: &str| {
        format!(
            "[domain]\n{min}\n[domain.outline]\npath = [{{ points = [[-2, 0], [2, 0]], name = \"base\" }}, \
             {{ points = [[2, 0], [1, 1.5], [-1, 1.5], [-2, 0]], name = \"rest\" }}]\n\
             [material]\nyoung = 1\npoisson = 0.3\nstate = \"plane-strain\"\n[[boundary]]\n\
             on = {{ piece = \"base\" }}\ntraction = [0, -1]\n[[boundary]]\non = {{ piece = \"rest\" }}\n\
             displacement = [0, 0]\n{support}[discretization]\nlevel = 4\norder = 4\n"
        )
    };
    let whole = solved(&parsed(&text("", "")));
    let support = "[[boundary]]\non = \"left\"\nsymmetry = true\n";
    let half = solved(&parsed(&text("min = [0, -0.1]\nmax = [2.2, 1.7]", support)));
    for at in [[0.2, 0.3], [1.2, 0.5], [0.7, 1.3]].map(Vec2::from) {
        for name in ["sxx", "syy", "sxy"] {
            let [a, b] = [&whole, &half].map(|dataset| quantity(dataset, name, at));
            assert!((a - b).abs() < 2e-4, "{name} {at:?}: {a} {b}");
        }
    }
}

/// Sides of holes on lines of cells, but for rounding, are loaded: else the pressure in a hole
/// would not be in equilibrium.
#[test]
fn sides_on_lines_of_cells_count_once() {
    let mut random = Random(22);
    for _ in 0..30 {
        let (min, size) = (random.between(-1.0, 1.0), random.between(0.1, 3.0));
        let count = 4 + random.below(6);
        // the outline has n − 1 of n cells
        let line = |k: usize| min + size * ((k as f64 - 0.5) / (count - 1) as f64);
        let (a, b) = (line(2), line(count - 1));
        let max = min + size;
        let text = format!(
            "[domain.outline]\npoints = [[{min:?}, {min:?}], [{max:?}, {min:?}], [{max:?}, {max:?}], \
             [{min:?}, {max:?}]]\n[[hole]]\npoints = [[{a:?}, {a:?}], [{b:?}, {a:?}], [{b:?}, {b:?}], \
             [{a:?}, {b:?}]]\n[material]\nyoung = 1\npoisson = 0.3\nstate = \"plane-stress\"\n\
             [[boundary]]\non = {{ hole = 0 }}\npressure = 1\n[discretization]\n\
             cells = [{count}, {count}]\norder = 1\nrefine = false\n"
        );
        // refused if a side is missing
        solved(&parsed(&text));
    }
}

/// A crack that ends on a round outline has a mouth there, as one that ends beyond it.
#[test]
fn cracks_end_on_curves() {
    let factor = |end: [f64; 2]| {
        let text = format!(
            "[[crack]]\npoints = [[0.1, 0.05], {end:?}]\n[domain.outline]\n\
             ellipse = {{ center = [0, 0], axes = [1, 1] }}\n[material]\nyoung = 1\npoisson = 0.3\n\
             state = \"plane-stress\"\n[[boundary]]\non = \"outline\"\npressure = -1\n\
             [discretization]\nlevel = 3\norder = 4\n"
        );
        let dataset = solved(&parsed(&text));
        assert_eq!(dataset.steps[0].intensities.len(), 1, "one tip: {end:?}");
        factors(&dataset)[0]
    };
    for angle in [0.0f64, 0.013, 0.5, 1.0] {
        let (tip, on) = (vec2(0.1, 0.05), vec2(angle.cos(), angle.sin()));
        let [on, beyond] = [1.0, 1.06].map(|far| factor((tip + (on - tip) * far).into()));
        println!("{angle}: {:.1e}", on / beyond - 1.0);
        assert!((on / beyond - 1.0).abs() < 1e-6, "{angle}: {on} {beyond}");
    }
}

/// Smooth data on an outline that follows a curve, exact on the circle, warn of nothing.
#[test]
fn smooth_data_on_curves_do_not_jump() {
    for (what, values) in [
        ("displacement", "[\"0.01*x*y\", \"0.01*(x + y^2)\"]"),
        ("traction", "[\"x\", \"-y\"]"),
        ("pressure", "\"1 + x*y\""),
    ] {
        let text = format!(
            "[domain.outline]\nellipse = {{ center = [0, 0], axes = [1, 1] }}\n[material]\nyoung = 1\n\
             poisson = 0.3\nstate = \"plane-stress\"\n[[boundary]]\non = \"outline\"\n{what} = {values}\n\
             [discretization]\nlevel = 4\norder = 3\n"
        );
        let dataset = solved(&parsed(&text));
        let told: Vec<_> = dataset.steps[0].warnings.iter().map(|w| &w.message).collect();
        assert!(!told.iter().any(|message| message.contains("jump")), "{what}: {told:?}");
    }
}

/// The compact tension specimen of `examples/` with W = B = P = 1 beside the polynomial of ASTM
/// E399, which is good to 0.5 %.
#[test]
fn the_compact_specimen_agrees_with_its_standard() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/compact-tension.toml");
    let text = std::fs::read_to_string(file).expect("the example");
    for a in [0.3, 0.4, 0.5, 0.6, 0.7_f64] {
        let k1 = factors(&solved(&parsed(&text.replace("[0.5, 0]", &format!("[{a}, 0]")))))[0];
        let row = [-5.6, 14.72, -13.32, 4.64, 0.886];
        let polynomial = row.into_iter().reduce(|sum, c| sum * a + c).expect("numbers");
        let standard = (2.0 + a) / (1.0 - a).powf(1.5) * polynomial;
        assert!((k1 / standard - 1.0).abs() < 5e-3, "a/W = {a}: {k1} and {standard}");
    }
}
