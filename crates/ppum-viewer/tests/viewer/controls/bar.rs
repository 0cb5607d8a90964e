//! The colour bar as the control of the range.

use egui::{Event, Key, Modifiers, MouseWheelUnit, PointerButton, Pos2, vec2};
use egui_kittest::kittest::Queryable;
use ppum_render::range::RangeChoice;

use super::{Window, bounds, plate_window, scene, write};
use crate::kit::{plate, settle, window};

fn drag(window: &mut Window, from: Pos2, to: Pos2) {
    window.hover_at(from);
    window.step();
    window.drag_at(from);
    window.step();
    for part in [0.2, 0.5, 0.8, 1.0] {
        window.hover_at(from + (to - from) * part);
        window.step();
    }
    window.drop_at(to);
    settle(window);
}

fn double_click(window: &mut Window, at: Pos2) {
    let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
    window.hover_at(at);
    for pressed in [true, false, true, false] {
        window.event(Event::PointerButton { pos: at, button, pressed, modifiers });
    }
    settle(window);
}

#[test]
fn the_upper_end_is_dragged_to_half_and_taken_back() {
    let mut window = plate_window();
    let [min, max] = bounds(&window);
    let body = window.get_by_label("Range of the colours").rect();
    let top = body.center_top() + vec2(0.0, 2.0);
    drag(&mut window, top, top + vec2(0.0, 0.5 * body.height()));
    let [low, high] = bounds(&window);
    assert_eq!(low, min);
    // half a point of the bar
    assert!((high - 0.5 * (min + max)).abs() < 2e-3 * (max - min), "{high}");
    assert_eq!(scene(&window).colors.range, RangeChoice::Fixed(low, high));
    // the values are what they were, so their extrema are still known
    assert!(window.query_by_label("Largest value").is_some());
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(&mut window);
    assert_eq!(scene(&window).colors.range, RangeChoice::Auto);
    assert_eq!(bounds(&window), [min, max]);
}

#[test]
fn the_middle_shifts_and_a_double_click_finds() {
    let mut window = plate_window();
    let [min, max] = bounds(&window);
    let body = window.get_by_label("Range of the colours").rect();
    let place = window.state().session.pane().place;
    drag(&mut window, body.center(), body.center() - vec2(0.0, 0.25 * body.height()));
    let [low, high] = bounds(&window);
    let shift = -0.25 * (max - min);
    assert!((low - min - shift).abs() < 2e-3 * (max - min), "{low}");
    assert!((high - max - shift).abs() < 2e-3 * (max - min), "{high}");
    // the plate below has not moved
    assert_eq!(window.state().session.pane().place, place);
    double_click(&mut window, body.center());
    assert_eq!(scene(&window).colors.range, RangeChoice::Auto);
}

#[test]
fn a_click_on_an_end_edits_its_number() {
    let mut window = plate_window();
    let [min, _] = bounds(&window);
    let body = window.get_by_label("Range of the colours").rect();
    let top = body.center_top() + vec2(0.0, 2.0);
    press(&mut window, top);
    write(&mut window, "Upper end of the colours as a number", "-9");
    window.key_press(Key::Enter);
    settle(&mut window);
    assert!(window.query_by_label_contains("is empty; give the smaller number first").is_some());
    write(&mut window, "Upper end of the colours as a number", "1.25e0");
    window.key_press(Key::Enter);
    settle(&mut window);
    assert_eq!(scene(&window).colors.range, RangeChoice::Fixed(min, 1.25));
    assert!(window.query_by_label("Upper end of the colours as a number").is_none());
    // a click elsewhere takes what is written, unless it is no end
    for (text, max) in [("1.5", 1.5), ("-9", 1.5), ("much", 1.5), ("2", 2.0)] {
        press(&mut window, top);
        write(&mut window, "Upper end of the colours as a number", text);
        let elsewhere = window.get_by_label("Plate").rect().left_center() + vec2(80.0, 0.0);
        press(&mut window, elsewhere);
        settle(&mut window);
        assert_eq!(scene(&window).colors.range, RangeChoice::Fixed(min, max), "{text}");
        assert!(window.query_by_label("Upper end of the colours as a number").is_none());
    }
}

fn press(window: &mut Window, at: egui::Pos2) {
    window.hover_at(at);
    window.step();
    window.drag_at(at);
    window.step();
    window.drop_at(at);
    window.run_steps(3);
}

#[test]
fn the_wheel_spreads_the_range_and_leaves_the_plate_alone() {
    let mut window = plate_window();
    let [min, max] = bounds(&window);
    let body = window.get_by_label("Range of the colours").rect();
    let place = window.state().session.pane().place;
    window.hover_at(body.center());
    window.step();
    window.event(Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        delta: vec2(0.0, -60.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    });
    settle(&mut window);
    window.run_steps(60);
    settle(&mut window);
    let [low, high] = bounds(&window);
    assert!(low < min && high > max, "{low} {high}");
    assert!((0.5 * (low + high) - 0.5 * (min + max)).abs() < 2e-3 * (max - min));
    assert_eq!(window.state().session.pane().place, place);
}

#[test]
fn extrema_are_marked_and_classes_are_blocks_that_nothing_drags() {
    let mut window = plate_window();
    assert!(window.query_by_label("Largest value").is_some());
    write(&mut window, "Quantity or formula", "overlap");
    window.key_press(Key::Escape);
    settle(&mut window);
    assert!(window.query_by_label("Largest value").is_none());
    let body = window.get_by_label("Range of the colours").rect();
    drag(&mut window, body.center(), body.center() + vec2(0.0, 40.0));
    assert_eq!(scene(&window).colors.range, RangeChoice::Auto);
}

#[test]
fn a_small_window_keeps_the_bar_on_the_plate() {
    let window = window(plate(), [700.0, 500.0]);
    let [plate, bar] =
        ["Plate", "Range of the colours"].map(|name| window.get_by_label(name).rect());
    assert!(plate.contains_rect(bar));
}
