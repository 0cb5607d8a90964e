//! What a solution tells of its patches and phases.

use crate::studies::support::{parsed, record, solved};
use ppum::dataset::{Dataset, Step};
use ppum::progress::Phase;
use ppum_solve::report::{ASSEMBLY_SECONDS, SolverReport};

fn plate(more: &str) -> Dataset {
    let text = format!(
        r#"
        domain = {{ min = [-1, -1], max = [1, 1] }}
        material = {{ young = 1, poisson = 0.3, state = "plane-strain" }}
        boundary = [
            {{ on = "bottom", displacement = [0, 0] }},
            {{ on = "top", traction = [0, 1] }},
        ]
        {more}
        "#
    );
    solved(&parsed(&text))
}

fn values<'s>(step: &'s Step, name: &str) -> &'s [f64] {
    let found = step.attributes.iter().find(|attribute| attribute.name == name);
    &found.unwrap_or_else(|| panic!("no {name}")).values
}

/// Inner cells of a uniform cover have the same nine parts, and so the same points; what the
/// patches have adds up to the record, and tips need more.
#[test]
fn quadrature_points_are_told() {
    let dataset = plate("discretization = { level = 3, order = 2, refine = false }");
    let step = &dataset.steps[0];
    let points = values(step, "quadrature-points");
    assert_eq!(points.iter().sum::<f64>(), record(step, "quadrature points"));
    let inside: Vec<f64> = (0..64)
        .filter(|&i| {
            let cell = step.partition.boxes().cell[i];
            cell.min.x > -1.0 && cell.min.y > -1.0 && cell.max.x < 1.0 && cell.max.y < 1.0
        })
        .map(|i| points[i])
        .collect();
    assert_eq!(inside.len(), 36);
    let first = inside[0];
    assert!(inside.iter().all(|n| *n == first), "{inside:?}");
    // nine parts with three to eight points in each direction
    assert!((9.0 * 9.0..=9.0 * 64.0).contains(&first), "{first}");
    let cracked = plate(
        "crack = [{ points = [[-0.4, 0.01], [0.4, 0.01]] }]\n\
         discretization = { level = 3, order = 2, refine = false }",
    );
    let step = &cracked.steps[0];
    let points = values(step, "quadrature-points");
    for (i, cell) in step.partition.boxes().cell.iter().enumerate() {
        let has_tip = [-0.4, 0.4].iter().any(|x| cell.contains(ppum::vec2::vec2(*x, 0.01)));
        assert!(!has_tip || points[i] > 4.0 * first, "{} of {first}", points[i]);
    }
}

/// Orthogonal functions have the eigenvalue one; a function that nearly is a polynomial has a
/// small one.
#[test]
fn eigenvalues_tell_of_dependence() {
    let own = |formula: &str| {
        plate(&format!(
            "enrichment = [{{ name = \"own\", function = \"{formula}\" }}]\n\
             discretization = {{ level = 2, order = 1, refine = false }}"
        ))
    };
    let least = |dataset: &Dataset| {
        let values = values(&dataset.steps[0], "least-eigenvalue");
        assert!(values.iter().all(|v| *v > 1e-13 && *v <= 1.0), "{values:?}");
        values.iter().fold(1.0f64, |least, v| least.min(*v))
    };
    let plain = least(&plate("discretization = { level = 2, order = 1, refine = false }"));
    let [wavy, nearly] = ["sin(9*x)", "x + 1e-4*x^2*y"].map(|formula| least(&own(formula)));
    println!("{plain:.1e} {wavy:.1e} {nearly:.1e}");
    assert!(plain > 1e-2 && wavy > 1e-4 && nearly < 1e-6);
}

/// Each phase tells what it keeps; what the cut-off leaves out is missing from the system.
#[test]
fn phases_tell_unknowns_and_bytes() {
    let dataset = plate(
        "crack = [{ points = [[-1, 0.01], [0.4, 0.01]] }]\ndiscretization = { level = 3, order = 2 }",
    );
    let step = &dataset.steps[0];
    let report = SolverReport::of(&step.history);
    let of = |all: &[(Phase, f64)], phase| all.iter().find(|(p, _)| *p == phase).map(|(_, v)| *v);
    let all = report.unknowns.expect("a number") as f64;
    let cut_off: f64 = values(step, "cut-off").iter().sum();
    assert_eq!(of(&report.worked, Phase::Cover), Some(all));
    assert_eq!(of(&report.worked, Phase::Assembly), Some(all - cut_off));
    assert_eq!(of(&report.bytes, Phase::Solution), report.solver_bytes.map(|n| n as f64));
    // the matrix alone: more than the diagonal blocks of half of the unknowns
    assert!(of(&report.bytes, Phase::Assembly).expect("bytes") > 8.0 * 6.0 * all);
    assert_eq!(of(&report.bytes, Phase::Intensity), None);
}

/// The seconds of all cells are those of the phase on all cores, or less.
#[test]
fn cells_tell_seconds() {
    let dataset = plate("discretization = { level = 4, order = 2, refine = false }");
    let step = &dataset.steps[0];
    let seconds = values(step, ASSEMBLY_SECONDS);
    assert!(seconds.len() == 256 && seconds.iter().all(|s| *s >= 0.0 && s.is_finite()));
    let threads = rayon::current_num_threads() as f64;
    let report = SolverReport::of(&step.history);
    let phase = report.seconds.iter().find(|(phase, _)| *phase == Phase::Assembly);
    let phase = phase.expect("seconds").1;
    assert!(seconds.iter().sum::<f64>() <= threads * phase);
}
