//! Manners: keys that do what they say and nothing else, reasons where nothing is done, room that
//! stays as it is.

use std::path::Path;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, MouseWheelUnit, PointerButton, Pos2, TouchPhase, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use ppum::dataset::Dataset;
use ppum::progress::unwatched;
use ppum::vec2::vec2 as v;
use ppum_fracture::solve::solve;
use ppum_problem::Problem;
use ppum_scene::overlays::Overlay;
use ppum_scene::profile::ProfileCurve;
use ppum_viewer::Viewer;
use ppum_viewer::measure::words;
use ppum_viewer::session::{DrawerPage, VisibleRegion};

use crate::kit::{at, hover, plate, settle, show_until, window};
use crate::lab::{Lab, shot};

type Window = Harness<'static, Viewer>;

const SIZE: [f32; 2] = [1000.0, 700.0];

/// A potential without cracks.
fn potential() -> Dataset {
    let text = include_str!("../../../../examples/poisson-slit.toml");
    let crack = "[[crack]]\npoints = [[-1.0, 0.0], [0.0, 0.0]]\n";
    assert!(text.contains(crack));
    let text = text.replace(crack, "").replace("\"exact\"", "\"x*y\"");
    let problem = Problem::parse(&text, "potential", Path::new(".")).expect("it is a problem");
    solve(&problem, unwatched()).expect("it can be solved")
}

fn press(window: &mut Window, key: Key) {
    window.key_press(key);
    window.run_steps(3);
    settle(window);
}

fn has(window: &Window, part: &str) -> bool {
    window.query_all_by_label_contains(part).next().is_some()
}

#[test]
fn tab_hides_and_shows_the_panels_and_gives_no_widget_the_focus() {
    let mut lab = Lab::new();
    let path = lab.write("plate.h5", &plate());
    lab.open(&path);
    let scale = lab.viewer().session.pane().scene.colors.scale;
    lab.window.key_press(Key::L);
    lab.window.run_steps(60);
    assert_ne!(lab.viewer().session.pane().scene.colors.scale, scale);
    for is_shown in [false, true, false, true, false] {
        lab.window.key_press(Key::Tab);
        lab.window.run_steps(3);
        assert_eq!(lab.viewer().session.panels, is_shown);
        assert_eq!(lab.window.ctx.memory(|memory| memory.focused()), None);
    }
    lab.window.key_press(Key::Space);
    lab.window.run_steps(3);
    // Space has not pressed the button that takes back
    assert_ne!(lab.viewer().session.pane().scene.colors.scale, scale);
}

#[test]
fn tab_leaves_a_field_that_is_written_in_and_shift_begins_a_walk() {
    let mut window = window(plate(), SIZE);
    window.key_press_modifiers(Modifiers::SHIFT, Key::Tab);
    window.run_steps(2);
    let focused = window.ctx.memory(|memory| memory.focused());
    assert!(focused.is_some() && window.state().session.panels);
    window.key_press(Key::Tab);
    window.run_steps(2);
    assert!(window.state().session.panels);
    assert_ne!(window.ctx.memory(|memory| memory.focused()), focused);
}

#[test]
fn escape_closes_the_sheet_and_no_key_acts_behind_it() {
    let mut window = window(plate(), SIZE);
    let shows = |window: &Window| has(window, "Shift+Drag");
    press(&mut window, Key::H);
    assert!(shows(&window));
    for sign in ["[", "]", "+", "−", "Wheel", "Ctrl+C"] {
        assert!(window.query_all_by_label(sign).next().is_some(), "{sign}");
    }
    let before = window.state().session.clone();
    for key in [Key::L, Key::M, Key::C, Key::X, Key::Plus, Key::V, Key::Tab, Key::S] {
        press(&mut window, key);
    }
    window.key_press_modifiers(Modifiers::COMMAND, Key::K);
    window.run_steps(3);
    assert_eq!(window.state().session, before);
    assert!(!has(&window, "Find an action…") && window.query_by_label("Save file").is_none());
    press(&mut window, Key::Escape);
    assert!(!shows(&window));
    press(&mut window, Key::L);
    assert_ne!(window.state().session, before);
    press(&mut window, Key::H);
    assert!(shows(&window));
    press(&mut window, Key::H);
    assert!(!shows(&window));
}

#[test]
fn escape_closes_what_is_open() {
    let mut lab = Lab::new();
    let path = lab.write("plate.h5", &plate());
    lab.open(&path);
    lab.window.key_press(Key::H);
    lab.window.run_steps(3);
    shot(&mut lab, "manners-keys");
    lab.window.key_press(Key::Escape);
    lab.window.run_steps(3);
    let control = Modifiers::COMMAND;
    let all = [
        (Modifiers::NONE, Key::S, "Save file"),
        (Modifiers::SHIFT, Key::S, "Save file"),
        (control, Key::O, "Browse…"),
        (control, Key::K, "the palette"),
    ];
    for (modifiers, key, label) in all {
        lab.window.key_press_modifiers(modifiers, key);
        lab.window.run_steps(3);
        let is_open = |lab: &Lab| match key {
            Key::K => lab.window.query_all_by_role(Role::TextInput).any(|node| node.is_focused()),
            _ => lab.window.query_by_label(label).is_some(),
        };
        assert!(is_open(&lab), "{label}");
        lab.window.key_press(Key::Escape);
        lab.window.run_steps(3);
        assert!(!is_open(&lab), "{label}");
    }
}

#[test]
fn a_wheel_at_the_limits_moves_nothing() {
    let mut window = window(plate(), SIZE);
    let turn = |window: &mut Window, place: Pos2, lines: f32| {
        window.hover_at(place);
        window.step();
        let (unit, modifiers, phase) = (MouseWheelUnit::Line, Modifiers::NONE, TouchPhase::Move);
        let source = egui::MouseWheelSource::Wheel;
        let delta = vec2(0.0, lines);
        window.event(Event::MouseWheel { unit, delta, modifiers, phase, source });
        settle(window);
    };
    let rect = window.get_by_label("Plate").rect();
    let place = rect.center() + vec2(-120.0, 70.0);
    let place_of = |window: &Window| window.state().session.panes[0].place.expect("it has moved");
    for (start, lines) in [(1e-11, 4.0), (30.0, -4.0)] {
        let center = [0.25, 0.1];
        window.state_mut().session.panes[0].place = Some(VisibleRegion { center, width: start });
        settle(&mut window);
        let mut last = None;
        for _ in 0..20 {
            turn(&mut window, place, lines);
            let now = place_of(&window);
            if last.is_some_and(|last: VisibleRegion| last.width == now.width) {
                assert_eq!(last, Some(now));
            }
            last = Some(now);
        }
        let last = last.expect("turned");
        turn(&mut window, place, lines);
        assert_eq!(place_of(&window), last);
    }
}

#[test]
fn probes_are_pinned_on_the_plate_and_once_at_a_place() {
    let mut window = window(plate(), SIZE);
    let rect = window.get_by_label("Plate").rect();
    let count = |window: &Window| window.state().session.panes[0].probes.len();
    for place in [rect.left_center() + vec2(2.0, 0.0), rect.right_center() + vec2(60.0, 0.0)] {
        window.hover_at(place);
        settle(&mut window);
        press(&mut window, Key::P);
        assert_eq!(count(&window), 0, "{place:?}");
        assert!(has(&window, "No probe is pinned"));
    }
    hover(&mut window, v(0.31, 0.42));
    press(&mut window, Key::P);
    press(&mut window, Key::P);
    assert_eq!((count(&window), window.state().viewports[0].tools.selected), (1, Some(0)));
    hover(&mut window, v(-0.31, 0.42));
    press(&mut window, Key::P);
    assert_eq!(count(&window), 2);
    // the reason goes by itself
    window.run_steps(100);
    assert!(!has(&window, "No probe is pinned"));
}

#[test]
fn keys_that_have_nothing_to_do_say_why() {
    let mut window = window(potential(), SIZE);
    press(&mut window, Key::D);
    assert!(has(&window, "a potential has no displacements"));
    assert_eq!(window.state().session.panes[0].scene.deformed, None);
    press(&mut window, Key::K);
    assert!(has(&window, "this step has no crack tip"));
    assert_eq!(
        (window.state().session.drawer, window.state().session.panes[0].curve),
        (None, None)
    );
    let shown = |window: &Window| window.state().session.panes[0].scene.overlays.shown.clone();
    let is_on = !shown(&window).is_empty();
    if is_on {
        press(&mut window, Key::O);
        assert!(shown(&window).is_empty());
    }
    window.state_mut().viewports[0].controls.hidden = None;
    press(&mut window, Key::O);
    assert_eq!(shown(&window), [Overlay::Cells]);
}

#[test]
fn a_key_opens_the_panel_of_what_it_shows() {
    let mut window = window(plate(), [1000.0, 900.0]);
    assert!(window.query_by_label("against resampled").is_none());
    press(&mut window, Key::C);
    window.run_steps(20);
    assert!(window.query_by_label("against resampled").is_some());
}

#[test]
fn a_line_drawn_with_shift_is_plotted() {
    let mut window = window(plate(), SIZE);
    let (from, to) = (at(&window, v(-0.5, 0.5)), at(&window, v(0.5, 0.3)));
    let modifiers = Modifiers::SHIFT;
    window.event(Event::PointerMoved(from));
    window.step();
    let button = |pos, pressed| {
        let button = PointerButton::Primary;
        Event::PointerButton { pos, button, pressed, modifiers }
    };
    window.event(Event::ModifiersChanged(modifiers));
    window.event(button(from, true));
    window.step();
    for k in 1..=4 {
        window.event(Event::PointerMoved(from + (to - from) * (k as f32 / 4.0)));
        window.step();
        assert_eq!(window.state().session.drawer, None);
    }
    window.event(button(to, false));
    window.step();
    settle(&mut window);
    assert_eq!(window.state().session.drawer, Some(DrawerPage::Plot));
}

#[test]
fn radii_are_short_and_refused_with_a_reason() {
    let mut window = window(plate(), [1200.0, 700.0]);
    let curve = ProfileCurve::Circle { center: [0.1 + 0.2, 0.5], radius: 0.2700000000000001 };
    window.state_mut().session.panes[0].curve = Some(curve);
    window.state_mut().session.drawer = Some(DrawerPage::Plot);
    settle(&mut window);
    let write = |window: &mut Window, text: &str| {
        window.get_by_role_and_label(Role::TextInput, "Numbers of the curve").click();
        window.step();
        window.key_press_modifiers(Modifiers::COMMAND, Key::A);
        window.step();
        window.get_by_role_and_label(Role::TextInput, "Numbers of the curve").type_text(text);
        window.run_steps(2);
        window.key_press(Key::Enter);
        window.run_steps(2);
        settle(window);
    };
    let node = window.get_by_role_and_label(Role::TextInput, "Numbers of the curve");
    assert_eq!(node.value().as_deref(), Some("0.3, 0.5, 0.27"));
    for (text, reason) in [
        ("0.3, 0.5, 1e30", "leaves the plate"),
        ("0.3, 0.5, -1", "must be larger than 0"),
        ("0.3, 0.5, NaN", "centre, radius"),
        ("0.3, 0.5", "centre, radius"),
    ] {
        write(&mut window, text);
        assert!(has(&window, reason), "{text}");
        assert_eq!(window.state().session.panes[0].curve, Some(curve), "{text}");
    }
    write(&mut window, "0.3, 0.6, 0.25");
    // what was not written anew has kept its digits
    let changed = ProfileCurve::Circle { center: [0.1 + 0.2, 0.6], radius: 0.25 };
    assert_eq!(window.state().session.panes[0].curve, Some(changed));
    assert!(!has(&window, "centre, radius") && !has(&window, "leaves the plate"));
}

#[test]
fn enter_in_the_name_saves() {
    let mut lab = Lab::new();
    let path = lab.write("plate.h5", &plate());
    lab.open(&path);
    lab.window.key_press(Key::S);
    lab.window.run_steps(3);
    lab.window.get_by_role_and_label(Role::TextInput, "File").click();
    lab.window.step();
    lab.window.key_press(Key::Enter);
    show_until(&mut lab.window, "the picture is written", |window| {
        window.query_by_label_contains("Saved ").is_some()
    });
    assert!(path.with_extension("png").exists());
}

#[test]
fn the_room_of_what_is_told_of_the_colours_stays_as_it_is() {
    let mut window = window(plate(), SIZE);
    let below = |window: &Window| window.get_by_label("Overlays").rect().top();
    let first = below(&window);
    let places = [([0.0, 0.0], 4.0), ([0.5, 0.0], 0.1), ([0.5, 0.0], 1e-10), ([-0.7, 0.8], 1e-3)];
    for (center, width) in places {
        window.state_mut().session.panes[0].place = Some(VisibleRegion { center, width });
        settle(&mut window);
        settle(&mut window);
        assert!((below(&window) - first).abs() < 0.5, "{center:?}, {width}");
    }
}

#[test]
fn each_of_two_views_bears_its_name() {
    let mut lab = Lab::new();
    let path = lab.write("plate.h5", &plate());
    lab.open(&path);
    assert!(!has(&lab.window, "plate.h5 · "));
    lab.window.key_press(Key::V);
    lab.window.run_steps(3);
    lab.state().session.panes[1].scene.quantity = Some("syy".into());
    lab.settle();
    lab.window.step();
    shot(&mut lab, "manners-names");
    assert!(lab.window.query_by_label("plate.h5 · von-mises · linked").is_some());
    assert!(lab.window.query_by_label("plate.h5 · syy · linked").is_some());
}

#[test]
fn the_line_below_the_plate_shows_as_many_patches_as_there_is_room_for() {
    for (width, is_whole) in [(1900.0, true), (700.0, false)] {
        let mut window = window(plate(), [width, 700.0]);
        hover(&mut window, v(0.252, 0.501));
        let probed = window.state().viewports[0].tools.hover.clone().expect("read");
        assert!(probed.patches.len() > 1);
        let all = words::patches(&probed).expect("patches");
        assert_eq!(has(&window, &all), is_whole, "{width}");
        assert_eq!(!has(&window, "…"), is_whole, "{width}");
        // ever fewer words, and never without a sign that there were more
        let texts = words::shorter(&probed);
        assert_eq!((texts.len(), &texts[0]), (probed.patches.len() + 1, &all));
        assert!(texts[1..].windows(2).all(|two| two[1].len() < two[0].len() + 3));
        assert!(texts[2..].iter().all(|text| text.ends_with(", …")));
    }
}

/// Where loads are drawn, the view of the whole plate has room for their arrows.
#[test]
fn arrows_of_loads_have_room() {
    let mut window = window(plate(), SIZE);
    let least = |window: &Window| {
        let view = window.state().viewports[0].camera.view.expect("a plate is shown");
        let bounds = plate().domain.bounds;
        let [low, high] = [bounds.min, bounds.max].map(|corner| view.pixel(corner));
        low.x.min(high.y).min(f64::from(view.pixels[1]) - low.y)
    };
    // the longest arrow has 38 pixels here
    assert!(least(&window) < 38.0, "{}", least(&window));
    window.state_mut().session.panes[0].scene.overlays.shown.push(Overlay::Loads);
    settle(&mut window);
    assert!(least(&window) >= 38.0, "{}", least(&window));
}
