//! Rates of convergence, and comparisons with other programs and with the energy that is released.

use crate::page::{Page, error, rated};
use crate::studies::exact_fields::{OBLIQUE, STUDY, Strip, smooth};
use crate::studies::plates::oblique_crack;
use crate::studies::release::kinked_crack;
use ppum_problem::BaseCells;

pub(crate) fn write(page: &mut Page) {
    smooth_field(page);
    enriched_everywhere(page);
    zones(page);
    study(page);
    beside_tips(page);
    release(page);
}

fn smooth_field(page: &mut Page) {
    page.add("## A smooth field");
    page.add(
        "The manufactured displacement (sin(2x + 0.3) cos(1.5y) + 0.2xy, cos(1.7x) sin(2y − 0.4)) on [−1, 1]², with its\n\
         body force, given on all edges. Expected rates: p in the energy norm, p + 1 in L²."
    );
    page.head(&["p", "norm", "level 1", "level 2", "level 3", "level 4", "level 5"]);
    for order in 1..=3 {
        let errors: Vec<_> = (1..=5).map(|level| smooth(level, order)).collect();
        let energy: Vec<_> = errors.iter().map(|e| e.energy).collect();
        let l2: Vec<_> = errors.iter().map(|e| e.l2).collect();
        for (name, errors) in [("energy", energy), ("L²", l2)] {
            page.row(&[vec![order.to_string(), name.into()], rated(&errors)].concat());
        }
    }
}

fn enriched_everywhere(page: &mut Page) {
    page.add("## The field of a tip, every patch enriched");
    page.add(
        "K_I = 1, K_II = 0.5 at (0.03, 0.041), crack from the left edge at an angle of 0.2; the field is in the trial\n\
         space, so what remains is quadrature and the linear solver. Error in the energy norm."
    );
    page.head(&["p", "level 1", "level 2", "level 3"]);
    for order in 1..=3 {
        let e = |level| OBLIQUE.pure(BaseCells::Level(level), order, 10.0).energy;
        page.row(&[order.to_string(), error(e(1)), error(e(2)), error(e(3))]);
    }
}

fn zones(page: &mut Page) {
    page.add("## The field of a tip, enriched in a zone of fixed radius");
    page.add(&format!(
        "Expected: O(h^p) in the energy norm. On the strip [−2, 2] × [−¼, ¼] (tip at (0, 0.041), angle 0.1, R = {}, 8 × 1,\n\
         16 × 2 and 32 × 4 cells) the patches that meet the disc are those of |x| < 1 on all three covers.",
        Strip::RADIUS
    ));
    page.head(&["p", "8 × 1", "16 × 2", "32 × 4"]);
    for order in 1..=3 {
        let e = [0, 1, 2].map(|level| Strip::errors(level, order).energy);
        page.row(&[vec![order.to_string()], rated(&e)].concat());
    }
    page.add(
        "On the square with the tip of the last section the enriched region, whole patches that meet the disc, shrinks by\n\
         about a cell with each level. The error is O(h^p R^(½−p)) in its radius, so rates come to p from below."
    );
    page.head(&["p", "R", "level 3", "level 4", "level 5"]);
    for order in 1..=3 {
        for radius in [0.4, 0.7] {
            let e = [3, 4, 5].map(|n| OBLIQUE.pure(BaseCells::Level(n), order, radius).energy);
            page.row(&[vec![order.to_string(), radius.to_string()], rated(&e)].concat());
        }
    }
}

fn study(page: &mut Page) {
    page.add("## The numerical study");
    page.add(
        "The crack from above under a field with r^(3/2) terms: K_I = 1, K_II = 0.5, T = 0.3. The study, an independent program\n\
         in Python, gives errors in the energy norm but not the amplitudes of the last terms; a = 0.4 and b = 0.3 is the\n\
         pair of round numbers that reproduces all 27 entries. Each cell: study, ours, ratio."
    );
    page.head(&["p", "enrichment", "degree at the tip", "level 2", "level 3", "level 4"]);
    for study in STUDY {
        let start =
            [study.order.to_string(), study.enrichment.name().into(), study.tip_degree.to_string()];
        let cell = |(level, expected): (u32, f64)| {
            let found = study.error(level);
            format!("{expected:.2e}, {found:.2e}, {:.3}", found / expected)
        };
        let cells: Vec<_> = (2..).zip(study.expected).map(cell).collect();
        page.row(&[start.to_vec(), cells].concat());
    }
}

fn beside_tips(page: &mut Page) {
    page.add("## Rates beside a tip");
    page.add(
        "A crack from (−0.4, −0.3) to (0.4, 0.3) in [−1, 1]², ends pulled, all else by default; error in the energy norm from the\n\
         strain energy, which is 2.428931916 (finite elements of order 12, good to 2e-9). On the cover of level 3 most cells,\n\
         those around the crack, are as small as on that of level 4: the second rate is the one to look at; it comes near p."
    );
    page.head(&["p", "level 3", "level 4", "level 5", "unknowns"]);
    for order in 1..=4 {
        let found = [3, 4, 5].map(|level| oblique_crack(level, order));
        let unknowns = found.map(|(_, n)| n.to_string()).join(", ");
        page.row(&[vec![order.to_string()], rated(&found.map(|f| f.0)), vec![unknowns]].concat());
    }
}

fn release(page: &mut Page) {
    page.add("## The energy released by a kinked crack");
    page.add(
        "A crack from the left edge through (−0.6, 0), (−0.3, 0.15) to (0.1, 0.05) in a square plate with pulled ends, p = 2.\n\
         Irwin: −dΠ/da = (K_I² + K_II²)/E′, the left side by a central difference over a growth of 0.01."
    );
    page.head(&["cells", "K_I", "K_II", "(K_I² + K_II²)/E′", "−dΠ/da", "ratio − 1"]);
    for n in [12, 24, 48] {
        let found = kinked_crack(n);
        let [k1, k2] = found.intensities.map(|k| format!("{k:.5}"));
        let sides = [found.by_intensities(), found.by_energy].map(|g| format!("{g:.5}"));
        let ratio = error(found.by_energy / found.by_intensities() - 1.0);
        page.row(&[vec![format!("{n} × {n}"), k1, k2], sides.to_vec(), vec![ratio]].concat());
    }
}
