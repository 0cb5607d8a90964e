//! The loss of the device is survived: what it held is made anew, and the picture is the same.

use ppum::field::Field;
use ppum_gpu::{GpuError, Method, Values};
use ppum_testkit::synthetic::Recipe;

use crate::{METHODS, bits, draw, good, quantity, renderer_or_skip, view, window};

/// Between frames, twice; where nobody draws in between; and between upload and compilation.
#[test]
fn the_next_picture_is_the_same() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    let dataset = Recipe { level: 1, ..Recipe::default() }.dataset();
    let field = good(Field::new(&dataset, 0));
    let stress = Values(quantity("von-mises", &field));
    for method in METHODS {
        let scene = good(renderer.upload(&field));
        let mut program = good(renderer.compile(&scene, stress.clone(), method));
        let before = bits(&draw(&mut renderer, &mut program, &window()));
        for losses in [1, 1, 2] {
            (0..losses).for_each(|_| renderer.gpu().lose());
            let after = bits(&draw(&mut renderer, &mut program, &window()));
            assert!(before == after, "{method:?}");
        }
        renderer.gpu().lose();
        let scene = good(renderer.upload(&field));
        renderer.gpu().lose();
        let mut program = good(renderer.compile(&scene, stress.clone(), method));
        let after = bits(&draw(&mut renderer, &mut program, &window()));
        assert!(before == after, "{method:?}");
    }
}

/// A picture that was on the lost device is lost with it, and says so.
#[test]
fn a_picture_is_lost_with_its_device() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    let dataset = Recipe { level: 0, tip_level: 0, ..Recipe::default() }.dataset();
    let field = good(Field::new(&dataset, 0));
    let scene = good(renderer.upload(&field));
    let overlap = Values(quantity("overlap", &field));
    let mut program = good(renderer.compile(&scene, overlap, Method::Gather));
    let view = view(&window());
    let drawn = good(renderer.draw(&mut program, &view));
    renderer.gpu().lose();
    assert_eq!(drawn.read(), Err(GpuError::Lost));
    let drawn = good(renderer.draw(&mut program, &view));
    assert!(good(drawn.read()).statistics().finite > 0);
}

/// A program moves with its scene to the renderer that draws it, and back.
#[test]
fn another_renderer_draws_the_same() {
    let (Some(mut first), Some(mut second)) = (renderer_or_skip(), renderer_or_skip()) else {
        return;
    };
    let dataset = Recipe { level: 1, ..Recipe::default() }.dataset();
    let field = good(Field::new(&dataset, 0));
    let scene = good(first.upload(&field));
    let stress = Values(quantity("von-mises", &field));
    let mut program = good(first.compile(&scene, stress, Method::Gather));
    let here = bits(&draw(&mut first, &mut program, &window()));
    assert!(here == bits(&draw(&mut second, &mut program, &window())));
    assert!(here == bits(&draw(&mut first, &mut program, &window())));
}
