//! What a newcomer sees and finds without having read anything.

use std::fs;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, MouseWheelUnit, TouchPhase, vec2};
use egui_kittest::kittest::Queryable as _;
use ppum::vec2::{Vec2, vec2 as v};
use ppum_render::view::View;
use ppum_scene::overlays::Overlay;
use ppum_viewer::session::{DrawerPage, VisibleRegion};

use crate::kit::{at, plate};
use crate::lab::{Lab, shot};

/// A window that shows a plate from a file.
fn lab() -> Lab {
    let mut lab = Lab::new();
    let path = lab.write("plate.h5", &plate());
    lab.open(&path);
    lab
}

fn find(lab: &mut Lab, text: &str) {
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::K);
    lab.window.run_steps(3);
    let field = lab.window.query_all_by_role(Role::TextInput).find(|node| node.is_focused());
    field.expect("the finder").type_text(text);
    lab.window.run_steps(3);
}

#[test]
fn pages_images_and_two_views_have_words_on_the_screen() {
    let mut lab = lab();
    shot(&mut lab, "finding");
    for (label, page) in [
        ("Tips and K", DrawerPage::Tips),
        ("Plot", DrawerPage::Plot),
        ("Solver", DrawerPage::Solver),
    ] {
        lab.window.get_by_label(label).click();
        lab.settle();
        assert_eq!(lab.viewer().session.drawer, Some(page));
    }
    lab.window.get_by_label("Solver").click();
    lab.settle();
    assert_eq!(lab.viewer().session.drawer, None);
    lab.window.get_by_label("Save image").click();
    lab.window.run_steps(3);
    lab.window.get_by_label("Figure for print…").click();
    lab.window.run_steps(3);
    assert!(lab.window.query_by_label("Save file").is_some());
    lab.window.key_press(Key::Escape);
    lab.window.run_steps(3);
    lab.window.get_by_label("Two views").click();
    lab.settle();
    assert_eq!(lab.viewer().session.panes.len(), 2);
}

#[test]
fn a_new_view_shows_the_cracks() {
    let mut lab = lab();
    assert_eq!(lab.viewer().session.pane().scene.overlays.shown, [Overlay::Cracks]);
    lab.window.key_press(Key::O);
    lab.settle();
    assert!(lab.viewer().session.pane().scene.overlays.shown.is_empty());
}

/// Quantities of errors are found by that word, and others are not.
#[test]
fn the_error_is_found_by_its_name() {
    let mut lab = lab();
    lab.window.key_press(Key::Q);
    lab.window.run_steps(3);
    lab.window.get_by_label("Search quantities").type_text("error");
    lab.window.run_steps(3);
    lab.window.get_by_label("indicator");
    assert!(lab.window.query_by_label("energy").is_none());
}

#[test]
fn the_finder_knows_what_people_say_and_offers_what_can_be_done() {
    let mut lab = lab();
    find(&mut lab, "SIF");
    lab.window.get_by_label_contains("Table of the tips").click();
    lab.settle();
    assert_eq!(lab.viewer().session.drawer, Some(DrawerPage::Tips));
    find(&mut lab, "tip");
    assert!(lab.window.query_all_by_label_contains("Fly to tip 1").next().is_some());
    // the plate has two tips, and one step
    assert!(lab.window.query_all_by_label_contains("Fly to tip 2").next().is_none());
    lab.window.key_press(Key::Escape);
    lab.window.run_steps(3);
    find(&mut lab, "steps");
    assert!(lab.window.query_all_by_label_contains("Save an animation").next().is_none());
    assert!(lab.window.query_by_label("Nothing of this name can be done now.").is_some());
}

/// What opens next has the keyboard, and the finder is gone.
#[test]
fn the_finder_makes_place_for_what_opens() {
    let mut lab = lab();
    find(&mut lab, "open");
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::O);
    lab.window.run_steps(3);
    // the button of this name alone
    assert_eq!(lab.window.query_all_by_label("Find an action").count(), 1);
    let field = lab.window.query_all_by_role(Role::TextInput).find(|node| node.is_focused());
    field.expect("the name of the file").type_text("pla");
    lab.window.run_steps(3);
    let named = |node: egui_kittest::Node<'_>| node.value().is_some_and(|v| v.ends_with("/pla"));
    assert!(lab.window.query_all_by_role(Role::TextInput).any(named));
}

/// The map says how many times larger the view is than the whole plate.
#[test]
fn the_map_says_what_the_wheel_does() {
    let mut lab = lab();
    let whole = lab.viewer().viewports[0].camera.view.expect("a view");
    for (times, is_shown) in [(2.0, false), (30.0, true)] {
        let width = whole.width / times;
        let place = VisibleRegion { center: [0.0, 0.0], width };
        lab.state().session.panes[0].place = Some(place);
        lab.settle();
        let name = format!("Map of the plate, ×{times}");
        assert_eq!(lab.window.query_by_label(&name).is_some(), is_shown, "{times}");
    }
}

/// One who enlarges a point of a crack stays on the crack, and at a tip stays at the tip.
#[test]
fn the_wheel_keeps_to_the_crack_or_tip_that_is_marked() {
    let view = enlarged(v(0.1, 0.0));
    assert!(view.width < 1e-6, "{}", view.width);
    assert!(view.center.y.abs() < view.height(), "the crack is in sight: {}", view.center.y);
    let (view, tip) = (enlarged(v(0.5, 0.0)), v(0.5, 0.0));
    let off = (view.center - tip).length();
    assert!(view.width < 1e-6 && off < view.width, "the tip is in sight: {off}");
}

/// The view after many turns of the wheel 2.5 points beside a place.
fn enlarged(place: Vec2) -> View {
    let mut lab = lab();
    let beside = at(&lab.window, place) + vec2(0.0, 2.5);
    lab.window.hover_at(beside);
    lab.settle();
    for _ in 0..40 {
        lab.window.hover_at(beside);
        lab.window.step();
        let (unit, modifiers, phase) = (MouseWheelUnit::Line, Modifiers::NONE, TouchPhase::Move);
        let (delta, source) = (vec2(0.0, 5.0), egui::MouseWheelSource::Wheel);
        lab.window.event(Event::MouseWheel { unit, delta, modifiers, phase, source });
        lab.settle();
    }
    lab.viewer().viewports[0].camera.view.expect("a view")
}

/// What is written is seen before it is solved; a solution of another text is told.
#[test]
fn a_problem_is_seen_while_it_is_written() {
    let mut lab = Lab::new();
    let text = include_str!("../../../../examples/centre-crack.toml")
        .replace("level = 6\norder = 2", "level = 2\norder = 1");
    let path = lab.path("plate.toml");
    fs::write(&path, &text).expect("written");
    lab.open(&path);
    let label = |cracks| format!("The problem as it is written: cracks {cracks}, holes 0");
    assert!(lab.window.query_by_label(&label(1)).is_some());
    shot(&mut lab, "finding-preview");
    let more = format!("{text}\n[[crack]]\npoints = [[-0.2, 0.4], [0.2, 0.4]]\n");
    lab.state().session.draft.as_mut().expect("a problem").text.clone_from(&more);
    lab.settle();
    assert!(lab.window.query_by_label(&label(2)).is_some());
    // the last one stays while a line is half written
    lab.state().session.draft.as_mut().expect("a problem").text = format!("{more}\n[[crack]]\npoi");
    lab.settle();
    assert!(lab.window.query_by_label(&label(2)).is_some());
    lab.state().session.draft.as_mut().expect("a problem").text = text.clone();
    lab.settle();
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
    lab.window.step();
    lab.settle();
    let another = "What is shown was solved from another text.";
    assert!(lab.window.query_by_label(another).is_none());
    lab.state().session.draft.as_mut().expect("a problem").text = more;
    lab.settle();
    assert!(lab.window.query_by_label(another).is_some());
}

#[test]
fn replaced_functions_are_told_beside_the_title() {
    let mut lab = lab();
    assert!(lab.window.query_by_label("⚠ 1 replaced").is_none());
    lab.state().session.pane_mut().scene.subject.weight = Some("cubic".into());
    lab.settle();
    assert!(lab.window.query_by_label("⚠ 1 replaced").is_some());
}
