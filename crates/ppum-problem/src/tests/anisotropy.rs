//! Anisotropic bodies: constants that are read, and problems that are refused.

use super::*;

const PLY: &str = "young = [144.8, 11.7]\npoisson = [0.21]\nshear = 9.66\naxis = 30\n";

/// The inverse of the compliances of wood.
const WOOD: [[f64; 3]; 3] = [
    [11.911_957_64, 0.440_270_01, 0.317_144_11],
    [0.440_270_01, 0.967_032_55, 0.175_463_76],
    [0.317_144_11, 0.175_463_76, 0.536_643_66],
];

fn body(material: &str, more: &str) -> String {
    format!(
        "[domain]\nmin = [-1, -1]\nmax = [1, 1]\n[material]\n{material}\n[[crack]]\n\
         points = [[-0.5, 0], [0.5, 0]]\n[[boundary]]\non = \"top\"\ntraction = [0, 1]\n\
         [discretization]\nlevel = 3\n{more}"
    )
}

fn stress(more: &str) -> String {
    format!("{PLY}state = \"plane-stress\"\n{more}")
}

fn constants(material: &str) -> Vec<f64> {
    let problem = good(&body(material, ""));
    problem.equation.stiffness().map(|(_, e)| e.constant().expect("a number")).collect()
}

fn assert_close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() < 1e-8 * b.abs().max(1.0), "{found:?} {expected:?}");
    }
}

/// Engineering constants are the inverse of the matrix of compliances (by another program).
#[test]
fn stiffness_of_engineering_constants() {
    let nu = 0.21;
    let factor = 1.0 / (1.0 - nu * nu * 11.7 / 144.8);
    let plane = [144.8 * factor, nu * 11.7 * factor, 0.0, 11.7 * factor, 0.0, 9.66];
    let turn = 30.0_f64.to_radians();
    assert_close(&constants(&stress("")), &[&plane[..], &[turn]].concat());
    let wood = "young = [11.6, 0.9, 0.5]\npoisson = [0.37, 0.47, 0.31]\nshear = 0.75\nstate = \"plane-strain\"";
    let expected = [
        WOOD[0][0], WOOD[0][1], 0.0, WOOD[1][1], 0.0, 0.75, WOOD[0][2], WOOD[1][2], 0.0,
        WOOD[2][2], 0.0,
    ];
    assert_close(&constants(wood), &expected);
    let given = "stiffness = [[10, 3, 1], [3, 8, 0.5], [1, 0.5, 2]]\nout_of_plane = [4, 3, 0.2, 9]\n\
                 axis = -90\nstate = \"plane-strain\"";
    let quarter = -std::f64::consts::FRAC_PI_2;
    assert_close(&constants(given), &[10.0, 3.0, 1.0, 8.0, 0.5, 2.0, 4.0, 3.0, 0.2, 9.0, quarter]);
}

/// Fibres that turn, and moduli that vary, are formulas.
#[test]
fn curved_fibres_are_formulas() {
    let material = stress("").replace("axis = 30", "axis = \"90*x\"").replace("9.66", "\"9 + y\"");
    let problem = good(&body(&material, ""));
    let law = problem.equation.anisotropy().expect("a law");
    let p = vec2(1.0, 0.5);
    let straight = good(&body(&stress("").replace("30", "90").replace("9.66", "9.5"), ""));
    let expected = straight.equation.anisotropy().expect("a law").plane_at(p);
    assert_close(&law.plane_at(p), &expected);
    assert!(!problem.equation.has_uniform_material());
}

/// The expansion along axes strains the body along x and y.
#[test]
fn expansion_by_axes() {
    let material = stress("expansion = [1e-6, 3e-5]\n");
    let problem = good(&body(&material, "[temperature]\nvalue = \"100*x\"\n"));
    let strains: Vec<f64> =
        problem.equation.eigenstrains().map(|(_, e)| e.value(vec2(1.0, 0.3))).collect();
    let (s, c) = 30.0_f64.to_radians().sin_cos();
    let (a, b) = (1e-4, 3e-3);
    assert_close(
        &strains.iter().map(|e| 1e4 * e).collect::<Vec<_>>(),
        &[a * c * c + b * s * s, a * s * s + b * c * c, (a - b) * s * c, 0.0].map(|e| 1e4 * e),
    );
}

#[test]
fn what_is_refused_says_what_to_do() {
    let strain = "young = [144.8, 11.7]\npoisson = [0.21]\nshear = 9.66\nstate = \"plane-strain\"";
    for (text, expected) in [
        (body(strain, ""), "must be [E1, E2, E3] in plane strain"),
        (
            body(&stress("").replace("[0.21]", "0.21"), ""),
            "must be [nu12], as the body is anisotropic",
        ),
        (
            body(&stress("").replace("[144.8, 11.7]", "144.8"), ""),
            "must be [E1, E2] in plane stress",
        ),
        (body(&stress("").replace("shear = 9.66\n", ""), ""), "`shear` is missing"),
        (body(&stress("").replace("[0.21]", "[4.0]"), ""), "indefinite: its least eigenvalue"),
        (
            body(&stress("").replace("plane-stress", "axisymmetric"), ""),
            "is for isotropic bodies; give numbers for `young` and `poisson`",
        ),
        (
            body(&stress("stiffness = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]"), ""),
            "contradicts `stiffness`",
        ),
        (
            body("stiffness = [[1, 2, 0], [0, 1, 0], [0, 0, 1]]\nstate = \"plane-stress\"", ""),
            "is not symmetric",
        ),
        (
            body("stiffness = [[2, 1, 0], [1, 2, 0], [0, 0, 1]]\nstate = \"plane-strain\"", ""),
            "`out_of_plane` is missing",
        ),
        (
            body(&stress(""), "[[force]]\nat = [0.5, 0.5]\nvalue = [1, 0]\n"),
            "known in isotropic bodies alone",
        ),
        (
            body(&stress(""), "[growth]\nsteps = 2\ncriterion = \"energy\"\n"),
            "write `criterion = \"hoop\"`",
        ),
        (
            body(&stress(""), "").replace(
                "points = [[-0.5, 0], [0.5, 0]]",
                "arc = { center = [0, 0], radius = 0.5, from = 20, to = 110 }",
            ),
            "the fields of tips on arcs",
        ),
        (
            body(
                "young = 1\npoisson = 0.3\nstate = \"plane-stress\"\nexpansion = [1, 2]",
                "[temperature]\nvalue = 1\n",
            ),
            "the body is isotropic",
        ),
    ] {
        let found = mistakes(&text);
        assert!(
            found.iter().any(|message| message.contains(expected)),
            "{found:?}, not {expected}"
        );
    }
}
