//! Time steps with covers and cracks of their own, drawn by turns, several in flight.

use ppum::crack::CrackEnd;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum_gpu::{Method, Program, QueuedOutput, Values};
use ppum_testkit::synthetic::{Recipe, crack, kinked};

use crate::{bits, check, good, quantity, renderer_or_skip, view, window};

/// The method for each step.
const WAYS: [Method; 3] = [Method::Gather, Method::Splat, Method::Gather];

/// Three steps: without a crack, with one, with another and its tips, on other covers.
fn series() -> Dataset {
    let straight = crack(&[[0.7512, -0.1523], [1.2231, -0.0317]], [CrackEnd::Tip; 2]);
    let coarse = Recipe { level: 1, ..Recipe::default() };
    let recipes = [
        Recipe { cracks: Vec::new(), ..coarse.clone() },
        Recipe { cracks: vec![kinked()], tip_level: 3, ..coarse.clone() },
        Recipe { cracks: vec![kinked(), straight], random_rounds: 1, zone: 0.15, ..coarse.clone() },
    ];
    let steps = recipes.iter().map(Recipe::step).collect();
    let mut dataset = coarse.dataset();
    dataset.steps = steps;
    dataset
}

/// Pictures are read after the next ones are begun, in another order.
#[test]
fn steps_are_drawn_by_turns() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    let dataset = series();
    let fields: Vec<_> = (0..3).map(|step| good(Field::new(&dataset, step))).collect();
    let mut programs: Vec<Program<'_, Values>> = Vec::new();
    for (field, method) in fields.iter().zip(WAYS) {
        let scene = good(renderer.upload(field));
        let stress = Values(quantity("von-mises", field));
        programs.push(good(renderer.compile(&scene, stress, method)));
    }
    let turns = [0, 1, 2, 1, 0, 2, 2, 0];
    let mut begun: Vec<(usize, QueuedOutput<Values>)> = Vec::new();
    for step in turns {
        let drawn = renderer.draw(&mut programs[step], &view(&window()));
        begun.push((step, good(drawn)));
    }
    let mut first: [Option<Vec<u32>>; 3] = Default::default();
    for (step, drawn) in begun.iter().rev() {
        let raster = good(drawn.read());
        match &first[*step] {
            Some(known) => assert!(*known == bits(&raster), "step {step} is another each time"),
            None => {
                check(&format!("step {step}"), &fields[*step], "von-mises", WAYS[*step], &raster);
                first[*step] = Some(bits(&raster));
            }
        }
    }
    assert!(first[0] != first[1] && first[1] != first[2]);
}
