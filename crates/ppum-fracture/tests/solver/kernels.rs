//! Problems solved with formulas where there are kernels for them: the same answers.

use ppum::crack::Side;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::progress::unwatched;
use ppum::vec2::{Vec2, vec2};
use ppum_fracture::solve::solve;

use crate::studies::support::{checked, parsed, strain_energy};

const PLATE: &str = r#"
[domain]
min = [-1.0, -1.0]
max = [1.0, 1.0]
[material]
young = 1.0
poisson = 0.3
state = "plane-strain"
[[crack]]
points = [[-0.513, 0.017], [0.487, 0.017]]
[[boundary]]
on = "bottom"
traction = [0.0, -1.0]
[[boundary]]
on = "top"
traction = [0.0, 1.0]
"#;

const WILLIAMS: &str = r#"
[discretization]
level = 3
refine = false
enrichment_radius = 0.2
"#;

/// The first term of the series alone, its components free.
const ZONE: &str = r#"
[discretization]
level = 3
refine = false
enrichment = "zone"
enrichment_radius = 0.2
"#;

/// The same functions as own enrichments, in words no kernel is known for: quadrature looks at them
/// as at any formula and chooses its points by itself.
const OWN: &str = r#"
[discretization]
level = 3
refine = false
enrichment = "jumps"
[[enrichment]]
at = "tips"
radius = 0.2
functions = [
    "cos(theta/2)*sqrt(r)",
    "sin(0.5*theta)*sqrt(r)",
    "sqrt(r)*sin(theta/2)*sin(theta)",
    "sqrt(r)*cos(theta/2)*sin(theta)",
]
"#;

fn solved(discretization: &str) -> Dataset {
    let text = PLATE.to_owned() + discretization;
    let problem = parsed(&text);
    solve(&checked(&problem), unwatched()).expect("a solution")
}

/// Relative differences of K and of the energy, and the largest of strains, which are of size 1.
fn differences(a: &Dataset, b: &Dataset) -> [f64; 3] {
    let pairs = a.steps[0].intensities.iter().zip(&b.steps[0].intensities);
    assert_eq!(pairs.len(), 2);
    let of_k = pairs.map(|(a, b)| (a.k1 - b.k1).hypot(a.k2 - b.k2) / a.k1.hypot(a.k2));
    let [e, f] = [a, b].map(strain_energy);
    [of_k.fold(0.0, f64::max), (e - f).abs() / e, strains(a, b)]
}

/// Strains, since displacements under tractions are free up to a rigid motion.
fn strains(a: &Dataset, b: &Dataset) -> f64 {
    let fields = [a, b].map(|d| Field::new(d, 0).expect("a field"));
    let [mut a, mut b] = [fields[0].at(Vec2::ZERO), fields[1].at(Vec2::ZERO)];
    let mut worst = 0.0f64;
    for k in 0..40 * 40 {
        let offset = vec2(f64::from(k % 40) / 20.0 - 0.97, f64::from(k / 40) / 20.0 - 0.97);
        let [mut u, mut v] = [[Jet::constant(0.0); 2]; 2];
        assert!(a.evaluate::<1>(offset, Side::Above, &mut u));
        assert!(b.evaluate::<1>(offset, Side::Above, &mut v));
        let strain = |u: &[Jet<f64>; 2]| [u[0].x, u[1].y, u[0].y + u[1].x];
        let pairs = strain(&u).into_iter().zip(strain(&v));
        worst = pairs.map(|(a, b)| (a - b).abs()).fold(worst, f64::max);
    }
    worst
}

/// Of the higher terms of the series some combination is always close to what the cut-off leaves
/// out, and rounding decides over it: strains beside the tip, which are of size 10, know.
#[test]
fn formulas_solve_like_kernels() {
    let formulas = |of: &str| solved(&format!("{of}[solver]\nkernels = false\n"));
    for (discretization, most) in [(ZONE, 1e-9), (WILLIAMS, 1e-7)] {
        let found = differences(&solved(discretization), &formulas(discretization));
        println!("K, energy, strains differ by {found:?}");
        assert!(found[..2].iter().all(|&d| d > 0.0 && d <= 1e-9), "{found:?}");
        assert!(found[2] > 0.0 && found[2] <= most, "{found:?}");
    }
}

/// With quadrature points of their own strains move by the error of the quadrature.
#[test]
fn own_enrichments_solve_like_built_in_ones() {
    let [built_in, own] = [ZONE, OWN].map(solved);
    let found = differences(&built_in, &own);
    println!("K, energy, strains differ by {found:?}");
    assert!(found.iter().zip([1e-9, 1e-9, 1e-8]).all(|(&d, bound)| d <= bound), "{found:?}");
}
