//! Parts of the field.

use egui_kittest::kittest::{NodeT, Queryable};
use ppum::vec2::vec2;
use ppum_scene::values::RasterValues;

use super::{Window, click, frame, open, plate_window, scene, write};
use crate::kit::settle;

fn values(window: &Window) -> Vec<f64> {
    match &frame(window).drawn.values {
        RasterValues::Double(raster) => raster.values.clone(),
        RasterValues::Single(raster) => raster.values.iter().map(|v| f64::from(*v)).collect(),
    }
}

/// Displacements of the parts add up to those of the whole.
#[test]
fn parts_add_up() {
    let mut window = plate_window();
    write(&mut window, "Quantity or formula", "uy");
    open(&mut window, "Parts");
    let whole = values(&window);
    let mut sum = vec![0.0; whole.len()];
    for part in ["smooth", "jump", "tip"] {
        click(&mut window, part);
        assert_eq!(scene(&window).subject.part.as_deref(), Some(part));
        sum.iter_mut().zip(values(&window)).for_each(|(sum, value)| *sum += value);
    }
    let size = whole.iter().filter(|v| v.is_finite()).fold(0.0f64, |size, v| size.max(v.abs()));
    // a sum of three: rounding of the parts, which may be larger than the whole near a tip
    let differ = whole.iter().zip(&sum).filter(|(a, b)| (*a - *b).abs() > 1e-10 * size).count();
    assert_eq!(differ, 0);
    assert!(window.get_by_label("other").accesskit_node().is_disabled());
    click(&mut window, "all");
    assert_eq!(scene(&window).subject.part, None);
}

#[test]
fn a_patch_is_picked_on_the_plate() {
    let mut window = plate_window();
    open(&mut window, "Parts");
    click(&mut window, "Pick a patch on the plate");
    let view = window.state().viewports[0].camera.view.expect("a plate is shown");
    let plate = window.get_by_label("Plate").rect();
    let pixel = vec2(f64::from(view.pixels[0]) * 0.3, f64::from(view.pixels[1]) * 0.4);
    let place = view.center + view.offset_at(pixel);
    let at = plate.min + egui::vec2(pixel.x as f32, pixel.y as f32);
    window.hover_at(at);
    window.step();
    window.drag_at(at);
    window.step();
    window.drop_at(at);
    settle(&mut window);
    let part = scene(&window).subject.part.expect("a patch was chosen");
    // such a click pins no probe
    window.run_steps(10);
    assert!(window.state().session.pane().probes.is_empty());
    let number: usize = part.strip_prefix("patch:").expect("a patch").parse().expect("a number");
    let dataset = std::sync::Arc::clone(frame(&window).field.dataset());
    assert!(dataset.steps[0].partition.boxes().cell[number].contains(place));
    // φ_i v_i of one patch is zero elsewhere
    assert!(values(&window).iter().filter(|v| **v != 0.0 && !v.is_nan()).count() < 200_000);
}
