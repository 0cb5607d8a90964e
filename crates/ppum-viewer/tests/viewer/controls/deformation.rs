//! The deformed plate.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use ppum_scene::magnification::Magnification;

use super::{click, frame, open, plate_window, scene};
use crate::kit::{plate, settle, show_until, window};

#[test]
fn a_factor_is_chosen() {
    let mut window = plate_window();
    open(&mut window, "Deformation");
    click(&mut window, "automatic");
    let automatic = frame(&window).factor.expect("the plate is deformed");
    click(&mut window, "factor");
    assert_eq!(scene(&window).deformed, Some(Magnification::Given(automatic)));
    window.get_by_label("Factor of the deformation").set_value_accesskit(-3.0 * automatic);
    settle(&mut window);
    let factor = frame(&window).factor.expect("the plate is deformed");
    assert!((factor / (-3.0 * automatic) - 1.0).abs() < 1e-6, "{factor}");
    let without = frame(&window).layers.items.len();
    click(&mut window, "outline");
    assert!(frame(&window).layers.items.len() > without);
    click(&mut window, "off");
    assert_eq!(frame(&window).factor, None);
}

/// A factor in motion is no change of settings: nothing is undone of it, and the session keeps
/// its factor.
#[test]
fn the_deformation_plays_without_changing_the_session() {
    let mut window = window(plate(), [700.0, 500.0]);
    window.key_press_modifiers(Modifiers::SHIFT, Key::D);
    window.step();
    assert_eq!(scene(&window).deformed, Some(Magnification::Auto));
    let mut factors = Vec::new();
    show_until(&mut window, "the factor moves", |window| {
        factors.extend(frame(window).factor);
        factors.dedup();
        factors.len() > 10
    });
    assert_eq!(scene(&window).deformed, Some(Magnification::Auto));
    window.key_press_modifiers(Modifiers::SHIFT, Key::D);
    settle(&mut window);
    let whole = frame(&window).factor.expect("the plate is deformed");
    assert!(factors.iter().all(|factor| *factor >= 0.0 && *factor <= whole));
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(&mut window);
    assert_eq!(scene(&window).deformed, None);
}
