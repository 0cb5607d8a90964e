//! Maps, scales and ranges.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use ppum_render::colormap::Colormap;
use ppum_render::range::RangeChoice;
use ppum_render::scale::Scale;

use super::{bounds, click, frame, plate_window, scene, write};
use crate::kit::{settle, show_until};

#[test]
fn a_map_is_found_reversed_and_put_in_steps() {
    let mut window = plate_window();
    click(&mut window, "Choose a colour map");
    write(&mut window, "Search colour maps", "zero vik");
    window.key_press(Key::Enter);
    settle(&mut window);
    assert_eq!(scene(&window).colors.colormap.as_deref(), Some("vik"));
    click(&mut window, "reversed");
    assert_eq!(scene(&window).colors.colormap.as_deref(), Some("vik_r"));
    click(&mut window, "in steps");
    let expected = Colormap::named("vik_r").unwrap().banded(8);
    assert_eq!(frame(&window).colored.colormap, expected);
    click(&mut window, "contrast beyond the range");
    let expected = Colormap::named("vik_r").unwrap().contrasting().banded(8);
    assert_eq!(frame(&window).colored.colormap, expected);
}

#[test]
fn shift_m_reverses_and_m_keeps_that() {
    let mut window = plate_window();
    window.key_press_modifiers(Modifiers::SHIFT, Key::M);
    settle(&mut window);
    assert_eq!(scene(&window).colors.colormap.as_deref(), Some("viridis_r"));
    window.key_press(Key::M);
    settle(&mut window);
    assert_eq!(scene(&window).colors.colormap.as_deref(), Some("plasma_r"));
}

#[test]
fn scales_are_chosen_and_one_that_cannot_be_is_told() {
    let mut window = plate_window();
    click(&mut window, "symlog");
    assert_eq!(frame(&window).colored.normalization.scale(), Scale::SymLog);
    click(&mut window, "linear");
    write(&mut window, "Quantity or formula", "ux");
    click(&mut window, "fixed");
    assert!(bounds(&window)[0] < 0.0);
    click(&mut window, "log");
    // the last good picture stays, the reason stands at its place
    assert_eq!(frame(&window).colored.normalization.scale(), Scale::Linear);
    assert!(window.query_by_label_contains("a logarithmic scale cannot begin at").is_some());
    click(&mut window, "auto");
    let failure = window.state().viewports[0].frames.failure();
    assert_eq!(frame(&window).colored.normalization.scale(), Scale::Log, "{failure:?}");
    assert!(window.query_by_label_contains("a logarithmic scale cannot").is_none());
}

#[test]
fn an_end_that_is_written_fixes_the_range_and_an_impossible_one_is_refused() {
    let mut window = plate_window();
    let [min, _] = bounds(&window);
    click(&mut window, "Upper end");
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.get_by_label("Upper end").type_text("2.5");
    window.key_press(Key::Enter);
    settle(&mut window);
    assert_eq!(scene(&window).colors.range, RangeChoice::Fixed(min, 2.5));
    assert_eq!(bounds(&window), [min, 2.5]);
    click(&mut window, "Lower end");
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.get_by_label("Lower end").type_text("7");
    window.key_press(Key::Enter);
    settle(&mut window);
    assert!(window.query_by_label_contains("the range from 7 to 2.5 is empty").is_some());
    assert_eq!(scene(&window).colors.range, RangeChoice::Fixed(min, 2.5));
}

#[test]
fn percentiles_and_full_ranges_are_those_of_the_view() {
    let mut window = plate_window();
    click(&mut window, "percentiles");
    assert_eq!(scene(&window).colors.range, RangeChoice::Percentiles(2.0, 98.0));
    let [min, max] = bounds(&window);
    let ppum_scene::values::RasterValues::Double(raster) = frame(&window).drawn.values.clone()
    else {
        panic!("pictures are of double precision")
    };
    let mut values: Vec<f64> = raster.values.into_iter().filter(|v| v.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    let below = |bound: f64| values.partition_point(|v| *v < bound) as f64 / values.len() as f64;
    // a pixel more or less
    assert!((below(min) - 0.02).abs() < 1e-4 && (below(max) - 0.98).abs() < 1e-4);
    click(&mut window, "full");
    assert!(bounds(&window)[1] >= values[values.len() - 1]);
}

#[test]
fn a_symmetric_range_has_zero_in_its_middle() {
    let mut window = plate_window();
    write(&mut window, "Quantity or formula", "sxx");
    let [min, max] = bounds(&window);
    assert!(min < 0.0 && max > 0.0 && min != -max);
    click(&mut window, "symmetric about zero");
    let size = max.max(-min);
    assert_eq!(bounds(&window), [-size, size]);
    click(&mut window, "fixed");
    click(&mut window, "Upper end");
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.get_by_label("Upper end").type_text("0.5");
    window.key_press(Key::Enter);
    settle(&mut window);
    assert_eq!(bounds(&window), [-0.5, 0.5]);
}

/// The range of the plate is found from far away, wherever one is.
#[test]
fn the_range_of_the_plate_holds_deep_inside() {
    let mut window = plate_window();
    write(&mut window, "Quantity or formula", "uy");
    window.key_press(Key::Escape);
    settle(&mut window);
    let whole = bounds(&window);
    for _ in 0..12 {
        window.key_press(Key::Plus);
        settle(&mut window);
    }
    let deep = bounds(&window);
    assert!(deep[1] - deep[0] < 0.9 * (whole[1] - whole[0]), "{deep:?} {whole:?}");
    click(&mut window, "whole plate");
    show_until(&mut window, "the range of the plate is found", |window| {
        matches!(scene(window).colors.range, RangeChoice::Fixed(..))
    });
    settle(&mut window);
    let RangeChoice::Fixed(min, max) = scene(&window).colors.range else { panic!("it is fixed") };
    // the extrema of a smooth quantity, found from other pixels: to 1e-6 of their size
    let size = whole[1].abs().max(whole[0].abs());
    assert!((min - whole[0]).abs() < 1e-5 * size && (max - whole[1]).abs() < 1e-5 * size);
    assert_eq!(bounds(&window), [min, max]);
}

#[test]
fn a_frozen_range_stays_where_it_is() {
    let mut window = plate_window();
    let before = bounds(&window);
    window.key_press_modifiers(Modifiers::SHIFT, Key::R);
    settle(&mut window);
    for _ in 0..6 {
        window.key_press(Key::Plus);
        settle(&mut window);
    }
    assert_eq!(bounds(&window), before);
    window.key_press(Key::R);
    settle(&mut window);
    assert_eq!(scene(&window).colors.range, RangeChoice::Auto);
    assert_ne!(bounds(&window), before);
}
