//! Direct against resampled.

use egui::{Key, vec2};
use egui_kittest::kittest::Queryable;
use ppum_render::resample::norms::norms;
use ppum_render::resample::{Interpolation, SampleGrid};
use ppum_scene::compare::Compare;
use ppum_scene::values::RasterValues;

use super::{click, frame, plate_window};
use crate::kit::settle;

#[test]
fn c_compares_and_the_panel_says_how_far_it_is() {
    let mut window = plate_window();
    window.key_press(Key::C);
    settle(&mut window);
    // until its panel has unfolded
    window.run_steps(30);
    settle(&mut window);
    let pane = window.state().session.pane().clone();
    assert_eq!(pane.compare, Some(Compare::default()));
    click(&mut window, "bicubic");
    window.get_by_label("Points of the grid").set_value_accesskit(5.0);
    settle(&mut window);
    let compare = Compare { method: Interpolation::Bicubic, grid: 32 };
    let frame = frame(&window);
    let other = frame.other.as_ref().expect("it is compared");
    assert_eq!(other.compare, compare);
    // the norms of samples that are taken anew
    let field = frame.field.field();
    let grid = SampleGrid::over_domain(field, [32, 32]).expect("a grid");
    let quantity = frame.shown.quantity().expect("a quantity");
    let samples = grid.sample(field, quantity, ppum::progress::unwatched()).expect("samples");
    let RasterValues::Double(direct) = &frame.drawn.values else { panic!("of double precision") };
    let found = norms(direct, &samples.raster(Interpolation::Bicubic, &frame.drawn.view));
    assert_eq!(found, other.norms);
    let text = format!("{} %", ppum::text::trimmed_to(100.0 * found.relative()[1], 3));
    assert!(window.query_all_by_label(&text).count() > 0, "{text}");
    assert_eq!(other.bytes, 8 * 32 * 32);
}

#[test]
fn the_divider_is_dragged_and_the_plate_stays() {
    let mut window = plate_window();
    window.key_press(Key::C);
    settle(&mut window);
    // until its panel has unfolded
    window.run_steps(30);
    settle(&mut window);
    let [plate, divider] = ["Plate", "Divider"].map(|name| window.get_by_label(name).rect());
    let from = divider.center() + vec2(0.0, 0.3 * plate.height());
    window.hover_at(from);
    window.step();
    window.drag_at(from);
    window.step();
    window.hover_at(from - vec2(0.25 * plate.width(), 0.0));
    window.step();
    window.drop_at(from - vec2(0.25 * plate.width(), 0.0));
    settle(&mut window);
    let pane = window.state().session.pane().clone();
    assert!((pane.against.divider - 0.25).abs() < 1e-3, "{:?}", pane.against);
    assert_eq!(pane.place, None);
    click(&mut window, "difference");
    assert!(window.state().session.pane().against.difference);
    window.key_press(Key::C);
    settle(&mut window);
    // until its panel has unfolded
    window.run_steps(30);
    settle(&mut window);
    assert!(window.query_by_label("Divider").is_none());
}
