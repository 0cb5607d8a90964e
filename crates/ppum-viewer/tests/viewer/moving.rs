//! Moving through the plane.

use egui::{Event, Key, Modifiers, MouseWheelUnit, Pos2, TouchPhase, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use ppum::vec2::Vec2;
use ppum_render::view::View;
use ppum_testkit::random::Random;
use ppum_viewer::Viewer;

use crate::kit::{plate, settle, window};

type Window = Harness<'static, Viewer>;

fn view(window: &Window) -> View {
    window.state().viewports[0].camera.view.expect("a plate is shown")
}

fn viewport(window: &Window) -> egui::Rect {
    window.get_by_label("Plate").rect()
}

/// The point of the plane below a position of the window.
fn point(window: &Window, at: Pos2) -> Vec2 {
    let (view, rect) = (view(window), viewport(window));
    let pixel = at - rect.min;
    view.center + view.offset_at(ppum::vec2::vec2(pixel.x.into(), pixel.y.into()))
}

fn wheel(window: &mut Window, at: Pos2, lines: f32) {
    window.hover_at(at);
    window.step();
    let (unit, modifiers, phase) = (MouseWheelUnit::Line, Modifiers::NONE, TouchPhase::Move);
    let source = egui::MouseWheelSource::Wheel;
    window.event(Event::MouseWheel { unit, delta: vec2(0.0, lines), modifiers, phase, source });
    settle(window);
}

/// Waits, by the window's clock, until flights have landed and changes count as done.
fn rest(window: &mut Window) {
    window.run_steps(60);
    settle(window);
}

#[test]
fn keys_enlarge_move_and_show_the_whole_plate() {
    let mut window = window(plate(), [900.0, 600.0]);
    let whole = view(&window);
    window.key_press(Key::Plus);
    rest(&mut window);
    assert!((view(&window).width * 1.5 / whole.width - 1.0).abs() < 1e-12);
    window.key_press(Key::ArrowRight);
    rest(&mut window);
    let moved = view(&window);
    assert!((moved.center.x - whole.center.x - 0.125 * moved.width).abs() < 1e-12);
    window.key_press(Key::F);
    rest(&mut window);
    assert_eq!(view(&window), whole);
    window.key_press(Key::Backspace);
    rest(&mut window);
    assert_eq!(view(&window), moved);
    window.key_press_modifiers(Modifiers::SHIFT, Key::Backspace);
    rest(&mut window);
    assert_eq!(view(&window), whole);
}

#[test]
fn the_wheel_keeps_the_point_below_the_cursor() {
    let mut window = window(plate(), [900.0, 600.0]);
    let mut random = Random(3);
    for _ in 0..6 {
        // the colour bar on the right has the wheel for itself
        let rect = viewport(&window).shrink(60.0);
        let rect = rect.with_max_x(rect.max.x - 80.0);
        let at = rect.lerp_inside(vec2(random.unit() as f32, random.unit() as f32));
        window.hover_at(at);
        window.step();
        let before = (point(&window, at), view(&window).width);
        let lines = random.between(-1.0, 6.0) as f32;
        wheel(&mut window, at, lines);
        let after = view(&window).width;
        let miss = (point(&window, at) - before.0).length();
        assert!(
            miss < 0.51 * view(&window).pixel_size() || after == before.1,
            "{miss:e} {after:e}"
        );
        assert!((after < before.1) == (lines > 0.0), "{lines} lines: {} to {after}", before.1);
    }
}

#[test]
fn dragging_takes_the_plate_along_and_a_double_click_shows_it_whole() {
    let mut window = window(plate(), [900.0, 600.0]);
    let whole = view(&window);
    let from = viewport(&window).center();
    let grabbed = point(&window, from);
    window.drag_at(from);
    window.step();
    window.hover_at(from + vec2(40.0, 25.0));
    window.step();
    window.drop_at(from + vec2(40.0, 25.0));
    rest(&mut window);
    let miss = (point(&window, from + vec2(40.0, 25.0)) - grabbed).length();
    assert!(miss < 1e-6 * whole.width, "{miss:e}");
    for _ in 0..2 {
        window.drag_at(from);
        window.drop_at(from);
    }
    rest(&mut window);
    assert_eq!(view(&window), whole);
}

#[test]
fn a_key_flies_to_a_tip_and_the_wheel_down_to_where_doubles_end() {
    let mut window = window(plate(), [900.0, 600.0]);
    window.key_press(Key::Num2);
    rest(&mut window);
    assert!((view(&window).center - ppum::vec2::vec2(0.5, 0.0)).length() < 1e-15);
    assert!(view(&window).width < 0.2);
    let center = viewport(&window).center();
    for _ in 0..200 {
        window.key_press(Key::Plus);
        window.step();
    }
    rest(&mut window);
    assert!((view(&window).width / 2e-12 - 1.0).abs() < 1e-6, "{:e}", view(&window).width);
    let frame = window.state().viewports[0].frames.newest().expect("it is drawn").clone();
    assert!(frame.colored.has_values && frame.request.view == view(&window));
    assert!((point(&window, center) - ppum::vec2::vec2(0.5, 0.0)).length() < 1e-14);
    window.get_by_label_contains("Map of the plate").click();
    rest(&mut window);
    assert!((view(&window).center - ppum::vec2::vec2(0.5, 0.0)).length() > 0.1);
}

#[test]
fn two_views_move_together_while_they_are_linked() {
    let mut window = window(plate(), [1200.0, 600.0]);
    window.key_press(Key::V);
    settle(&mut window);
    assert_eq!(window.state().viewports.len(), 2);
    window.key_press(Key::Num1);
    rest(&mut window);
    let places = |window: &Window| {
        window.state().session.panes.iter().map(|pane| pane.place).collect::<Vec<_>>()
    };
    assert!(places(&window)[0].is_some() && places(&window)[0] == places(&window)[1]);
    assert_eq!(window.query_all_by_label_contains("· linked").count(), 2);
    window.get_by_label("Linked views").click();
    rest(&mut window);
    assert_eq!(window.query_all_by_label_contains("· linked").count(), 0);
    window.key_press(Key::F);
    rest(&mut window);
    assert!(places(&window)[0].is_none() != places(&window)[1].is_none());
    let active = places(&window)[window.state().session.active];
    window.get_by_label("Linked views").click();
    rest(&mut window);
    assert_eq!(places(&window), [active; 2]);
}

#[test]
fn settings_are_undone_and_redone_but_places_stay() {
    let mut window = window(plate(), [900.0, 600.0]);
    let scale = |window: &Window| window.state().session.pane().scene.colors.scale.to_string();
    window.key_press(Key::L);
    rest(&mut window);
    window.key_press(Key::Plus);
    rest(&mut window);
    let near = view(&window);
    assert_eq!(scale(&window), "log");
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    rest(&mut window);
    assert_eq!((scale(&window), view(&window)), ("linear".to_owned(), near));
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    rest(&mut window);
    assert_eq!(scale(&window), "log");
}
