//! Datasets to the last bit.

use ppum_format::{read, to_bytes};
use ppum_solve::report::strip_timings;

use crate::Lab;

/// A plate whose cells come from points, with a straight crack and a kinked one from an edge;
/// material, loads and an enrichment are formulas.
const PLATE: &str = r#"
title = "Everything at once"
[domain]
min = [-1.0, -1.0]
max = [1.0, 1.0]
[material]
young = "1 + 0.2*x*y"
poisson = 0.3
state = "plane-strain"
[body_force]
value = ["0.01*x", "0.02*sin(3*y)"]
[[crack]]
points = [[-0.6, -0.45], [0.3, -0.3]]
[[crack]]
points = [[1.0, 0.4], [0.4, 0.3], [-0.2, 0.45]]
[[enrichment]]
function = "sqrt(r)*sin(theta/2)*r"
at = "tips"
radius = 0.1
degree = 0
[[boundary]]
on = "bottom"
displacement = [0.0, 0.0]
[[boundary]]
on = "top"
traction = ["0.1*x", "1 + 0.3*x^2"]
[discretization]
points = "points.csv"
order = 1
refine = false
"#;

/// The bytes of the dataset without the seconds in its history.
fn solved_with(threads: usize) -> Vec<u8> {
    let lab = Lab::new();
    let points: Vec<_> = (0..40)
        .map(|k| {
            let (s, t) = (f64::from(k) * 0.618_033_988_75, f64::from(k) * 0.754_877_666_2);
            format!("{},{}", 1.9 * s.fract() - 0.95, 1.9 * t.fract() - 0.95)
        })
        .collect();
    lab.write("points.csv", &points.join("\n"));
    lab.write("plate.toml", PLATE);
    // of coarse cells
    lab.warned(&format!("solve plate.toml --threads {threads}"));
    let mut dataset = read(&lab.path("plate.h5")).unwrap();
    let step = &mut dataset.steps[0];
    let all = step.history.len();
    strip_timings(step);
    assert!(step.history.len() < all && !step.intensities.is_empty());
    to_bytes(&dataset).unwrap()
}

#[test]
fn two_runs_with_one_and_two_threads_write_the_same_bytes() {
    assert!(solved_with(1) == solved_with(2));
}
