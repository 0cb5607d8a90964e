//! The deformed plate.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use ppum_scene::magnification::Magnification;

use super::{click, frame, open, plate_window, scene, write};
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

/// What is below does not move when the plate is deformed or a range found, nor for an error in
/// a formula: what the pointer is over stays there.
#[test]
fn panels_stand_still() {
    let mut window = plate_window();
    open(&mut window, "Deformation");
    let place = |window: &super::Window, label: &str| window.get_by_label(label).rect();
    let before = place(&window, "Functions");
    click(&mut window, "automatic");
    window.run_steps(30);
    assert_eq!(place(&window, "Functions"), before);
    click(&mut window, "off");
    let rows = ["contrast beyond the range", "linear"].map(|label| (label, place(&window, label)));
    for text in ["ux +", "sxx"] {
        write(&mut window, "Quantity or formula", text);
        window.key_press(Key::Escape);
        settle(&mut window);
        for (label, before) in rows {
            assert_eq!(place(&window, label), before, "{label} after {text}");
        }
    }
    click(&mut window, "whole plate");
    show_until(&mut window, "the range is found", |window| {
        matches!(scene(window).colors.range, ppum_render::range::RangeChoice::Fixed(..))
    });
    settle(&mut window);
    let (label, before) = rows[0];
    assert_eq!(place(&window, label), before);
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
