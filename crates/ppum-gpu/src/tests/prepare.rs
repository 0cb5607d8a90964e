//! Programs that no picture waits for.

use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_render::view::View;
use ppum_testkit::synthetic::Recipe;

use super::gpu_or_skip;
use crate::{AdapterChoice, Method, Renderer, Values};

/// What is prepared draws all of the plate, and parts with tips, sides and neither, and nothing is
/// compiled for them.
#[test]
fn a_prepared_program_has_all_its_pipelines() {
    let Some(gpu) = gpu_or_skip() else { return };
    let mut renderer = Renderer::new(gpu, AdapterChoice::Any);
    let dataset = Recipe::default().dataset();
    let field = Field::new(&dataset, 0).expect("a field");
    let scene = renderer.upload(&field).expect("a scene");
    let compile = |renderer: &mut Renderer| {
        renderer.compile(&scene, Values(Quantity::VonMises), Method::Gather).expect("a program")
    };
    let (mut prepared, mut other) = (compile(&mut renderer), compile(&mut renderer));
    let center = field.domain.bounds.center();
    let views = [1.4, 0.6, 0.2].map(|width| View::new(center, width, [64, 48]).expect("a view"));
    renderer.prepare(&mut prepared, &views[0]).expect("it draws");
    let made = prepared.n_compiled();
    for view in &views {
        let [a, b] = [&mut prepared, &mut other].map(|program| {
            let drawn =
                renderer.draw(program, view).and_then(|drawn| drawn.read()).expect("a raster");
            drawn.values.into_iter().map(f32::to_bits).collect::<Vec<_>>()
        });
        assert!(a == b, "the same picture");
    }
    assert!(
        other.n_compiled() > 1 && prepared.n_compiled() == made,
        "{made}, {}",
        prepared.n_compiled()
    );
}
