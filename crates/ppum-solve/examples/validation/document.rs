//! The document: what is measured, against what, and the numbers.

use crate::studies::exact_fields::{
    OBLIQUE, SLIT_SQUARES, STUDY, Strip, TIP_ENERGIES, slit, smooth, tip_energy,
};
use crate::studies::plates::{
    Plate, centre_cracks, collinear_cracks, edge_cracks, end_shear, kinked_in_plane, slanted_cracks,
};
use crate::studies::release::kinked_crack;
use crate::studies::support::unknowns;
use crate::table::{error, head, rated, row};
use ppum_solve::problem::Cells;

/// Computes and prints everything.
pub(crate) fn print() {
    println!("{HEAD}");
    smooth_field();
    enriched_everywhere();
    zones();
    energies();
    study();
    plates();
    release();
    poisson();
}

const HEAD: &str = "\
# Validation

What the solver gives, next to what is known. This page is computed, not written:

```text
cargo run --release -p ppum-solve --example validation > docs/validation.md
```

Errors are relative. Where nothing else is said: E = 1, ν = 0.3, plane strain, α = 1.3, linear weights; h is halved
from each level to the next, and rates log₂(e(2h)/e(h)) stand in parentheses. The set-ups are in
`crates/ppum-solve/tests/studies`; the tests in `crates/ppum-solve/tests/solver` hold the solver to most of these
numbers.";

fn smooth_field() {
    println!("\n## A smooth field");
    println!(
        "\nThe manufactured displacement (sin(2x + 0.3) cos(1.5y) + 0.2xy, cos(1.7x) sin(2y − 0.4)) on [−1, 1]², with its\n\
         body force, given on all edges. Expected rates: p in the energy norm, p + 1 in L²."
    );
    head(&["p", "norm", "level 1", "level 2", "level 3", "level 4", "level 5"]);
    for order in 1..=3 {
        let errors: Vec<_> = (1..=5).map(|level| smooth(level, order)).collect();
        let energy: Vec<_> = errors.iter().map(|e| e.energy).collect();
        let l2: Vec<_> = errors.iter().map(|e| e.l2).collect();
        for (name, errors) in [("energy", energy), ("L²", l2)] {
            row(&[vec![order.to_string(), name.into()], rated(&errors)].concat());
        }
    }
}

fn enriched_everywhere() {
    println!("\n## The field of a tip, every patch enriched");
    println!(
        "\nK_I = 1, K_II = 0.5 at (0.03, 0.041), crack from the left edge at an angle of 0.2; the field is in the trial\n\
         space, so what remains is quadrature and the linear solver. Error in the energy norm."
    );
    head(&["p", "level 1", "level 2", "level 3"]);
    for order in 1..=3 {
        let e = |level| OBLIQUE.pure(Cells::Level(level), order, 10.0).energy;
        row(&[order.to_string(), error(e(1)), error(e(2)), error(e(3))]);
    }
}

fn zones() {
    println!("\n## The field of a tip, enriched in a zone of fixed radius");
    println!(
        "\nExpected: O(h^p) in the energy norm. On the strip [−2, 2] × [−¼, ¼] (tip at (0, 0.041), angle 0.1, R = {}, 8 × 1,\n\
         16 × 2 and 32 × 4 cells) the patches that meet the disc are those of |x| < 1 on all three covers.",
        Strip::RADIUS
    );
    head(&["p", "8 × 1", "16 × 2", "32 × 4"]);
    for order in 1..=3 {
        let e = [0, 1, 2].map(|level| Strip::errors(level, order).energy);
        row(&[vec![order.to_string()], rated(&e)].concat());
    }
    println!(
        "\nOn the square with the tip of the last section the enriched region, whole patches that meet the disc, shrinks by\n\
         about a cell with each level. The error is O(h^p R^(½−p)) in its radius, so rates come to p from below."
    );
    head(&["p", "R", "level 3", "level 4", "level 5"]);
    for order in 1..=3 {
        for radius in [0.4, 0.7] {
            let e = [3, 4, 5].map(|n| OBLIQUE.pure(Cells::Level(n), order, radius).energy);
            row(&[vec![order.to_string(), radius.to_string()], rated(&e)].concat());
        }
    }
}

fn energies() {
    println!("\n## The strain energy of the field of a tip");
    println!(
        "\n½ ∫ σ:ε on [−1, 1]², tip at the centre, K = 1, level 3, p = 2, against a one-dimensional integral."
    );
    head(&["mode", "expected", "found", "error"]);
    let found = [tip_energy(1.0, 0.0), tip_energy(0.0, 1.0)];
    for ((mode, found), expected) in ["I", "II"].into_iter().zip(found).zip(TIP_ENERGIES) {
        let off = error(found / expected - 1.0);
        row(&[mode.into(), format!("{expected:.12}"), format!("{found:.12}"), off]);
    }
}

fn study() {
    println!("\n## The numerical study");
    println!(
        "\nThe crack of above under a field with r^(3/2) terms: K_I = 1, K_II = 0.5, T = 0.3. The study, an independent program\n\
         in Python, gives errors in the energy norm but not the amplitudes of the last terms; a = 0.4 and b = 0.3 is the\n\
         pair of round numbers that reproduces all 27 entries. Each cell: study, ours, ratio."
    );
    head(&["p", "enrichment", "degree at the tip", "level 2", "level 3", "level 4"]);
    for study in STUDY {
        let start =
            [study.order.to_string(), study.enrichment.name().into(), study.tip_degree.to_string()];
        let cell = |(level, expected): (u32, f64)| {
            let found = study.error(level);
            format!("{expected:.2e}, {found:.2e}, {:.3}", found / expected)
        };
        let cells: Vec<_> = (2..).zip(study.expected).map(cell).collect();
        row(&[start.to_vec(), cells].concat());
    }
}

fn plates() {
    println!("\n## Stress intensity factors of plates");
    println!(
        "\nOrder 2 and defaults. References: least squares with complex potentials, agreeing with handbooks; F = K/(σ√(πa)).\n\
         Three covers: 8, 16 and 32 cells across the width, further refined at tips by the program itself.\n\
         In all tables a positive error is a factor that is too large."
    );
    table("Centre crack, ends pulled", &centre_cracks());
    table("Slanted crack, a/W = 0.5, H/W = 2, ends pulled", &slanted_cracks());
    table("Single edge crack, ends pulled and free to rotate", &edge_cracks());
    table("Edge crack under end shear, W = 7, L = 16 (7, 14 and 28 cells across)", &[end_shear()]);
    table(
        "Two collinear cracks in the infinite plane, a/b = 0.8, by exact tractions on [−3, 3] × [−1.5, 1.5]",
        &[collinear_cracks()],
    );
    table(
        "Kinked crack (2, then 1 at 15°) in the infinite plane, here of width 128; order 3; references good to 1e-4; F = K/(σ√π)",
        &[kinked_in_plane()],
    );
}

fn table(title: &str, plates: &[Plate]) {
    println!("\n### {title}");
    head(&["plate", "factor", "reference", "coarse", "middle", "fine", "errors", "unknowns"]);
    for plate in plates {
        let solved = [0, 1, 2].map(|level| plate.solve(level));
        let unknowns = solved.each_ref().map(|s| unknowns(&s.dataset).to_string()).join(", ");
        for (k, known) in plate.known.iter().enumerate() {
            let values = solved.each_ref().map(|s| s.values[k]);
            let errors = values.map(|v| error(v / known.value - 1.0)).join(", ");
            let start = [plate.name.clone(), known.name.into(), known.value.to_string()];
            let values = values.map(|v| format!("{v:.6}"));
            row(&[start.to_vec(), values.to_vec(), vec![errors, unknowns.clone()]].concat());
        }
    }
}

fn release() {
    println!("\n## The energy released by a kinked crack");
    println!(
        "\nA crack from the left edge through (−0.6, 0), (−0.3, 0.15) to (0.1, 0.05) in a square plate with pulled ends, p = 2.\n\
         Irwin: −dΠ/da = (K_I² + K_II²)/E′, the left side by a central difference over a growth of 0.01."
    );
    head(&["cells", "K_I", "K_II", "(K_I² + K_II²)/E′", "−dΠ/da", "ratio − 1"]);
    for n in [12, 24, 48] {
        let found = kinked_crack(n);
        let [k1, k2] = found.intensities.map(|k| format!("{k:.5}"));
        let sides = [found.by_intensities(), found.by_energy].map(|g| format!("{g:.5}"));
        let ratio = error(found.by_energy / found.by_intensities() - 1.0);
        row(&[vec![format!("{n} × {n}"), k1, k2], sides.to_vec(), vec![ratio]].concat());
    }
}

fn poisson() {
    println!("\n## Poisson's equation on a slit square");
    println!("\nu = √r sin(θ/2) on [−1, 1]², given on all edges; zone of radius 0.4, p = 2.");
    head(&["norm", "expected", "level 2", "level 3", "level 4", "errors"]);
    let found = [2, 3, 4].map(|level| slit(level, 2));
    for (k, name) in ["‖∇u‖²", "‖u‖²"].into_iter().enumerate() {
        let values = found.map(|f| f[k]);
        let errors = values.map(|v| error(v / SLIT_SQUARES[k] - 1.0)).join(", ");
        let start = vec![name.into(), format!("{:.12}", SLIT_SQUARES[k])];
        let values = values.map(|v| format!("{v:.9}"));
        row(&[start, values.to_vec(), vec![errors]].concat());
    }
}
