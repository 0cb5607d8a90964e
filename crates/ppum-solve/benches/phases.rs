//! Seconds and unknowns per second of each phase of the solver: the centre crack at levels 4 to 6
//! (and further, by argument), order 2. `cargo bench -p ppum-solve -- 7` adds level 7.

use ppum::dataset::{Material, StressState};
use ppum::vec2::{Rect, vec2};
use ppum_solve::problem::{Cells, Condition, Discretization, Edge, Expression, Problem};
use ppum_solve::solve::solve;

fn main() {
    let last = std::env::args().filter_map(|a| a.parse().ok()).next().unwrap_or(6);
    for level in 4..=last {
        report(level);
    }
}

fn report(level: u32) {
    let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
    let material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
    let pull = |t: f64| {
        vec![Condition::Neumann(Expression::number(0.0)), Condition::Neumann(Expression::number(t))]
    };
    let problem = Problem::elasticity(domain, material, Discretization::new(Cells::Level(level)))
        .with_crack(&[[-0.5, 0.0], [0.5, 0.0]])
        .with_boundary(Edge::Bottom, pull(-1.0))
        .with_boundary(Edge::Top, pull(1.0));
    let dataset = solve(&problem, &mut |_| {}).expect("the centre crack is in order");
    let history = &dataset.steps[0].history;
    let unknowns = history.iter().find(|r| r.name == "unknowns").map_or(0.0, |r| r.value);
    println!("level {level}: {unknowns} unknowns");
    for record in history.iter().filter(|r| r.unit == "s") {
        println!(
            "  {:<10} {:8.3} s {:10.0} unknowns/s",
            record.name,
            record.value,
            unknowns / record.value
        );
    }
}
