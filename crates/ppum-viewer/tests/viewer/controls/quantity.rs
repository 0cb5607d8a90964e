//! Choosing and writing quantities.

use egui::{Event, Key, Modifiers, PointerButton, Pos2};
use egui_kittest::kittest::Queryable;
use ppum::crack::Side;
use ppum::quantity::Quantity;

use super::{Window, click, frame, plate_window, scene, write};
use crate::kit::settle;

/// The value in the middle of the picture, and that of a quantity at the same place.
fn values(window: &Window, text: &str) -> [f64; 2] {
    let frame = frame(window);
    let view = frame.request.view;
    let [i, j] = [view.pixels[0] / 3, view.pixels[1] / 3];
    let ppum_scene::values::RasterValues::Double(raster) = &frame.drawn.values else {
        panic!("pictures are of double precision")
    };
    let field = frame.field.field();
    let quantity = Quantity::parse(text, field).expect("it is a quantity");
    let mut local = field.at(view.center);
    [raster.value(i, j), quantity.at(&mut local, view.offset(i, j), Side::Above)]
}

fn is_near([a, b]: [f64; 2]) -> bool {
    // the same kernel on vectors: rounding
    (a - b).abs() <= 1e-12 * b.abs().max(1e-6)
}

#[test]
fn q_opens_the_list_and_keys_choose_from_it() {
    let mut window = plate_window();
    window.key_press(Key::Q);
    settle(&mut window);
    assert!(window.get_by_label("Search quantities").is_focused());
    window.get_by_label("Search quantities").type_text("shear stress");
    settle(&mut window);
    window.key_press(Key::Enter);
    settle(&mut window);
    assert_eq!(scene(&window).quantity.as_deref(), Some("sxy"));
    let found = values(&window, "sxy");
    assert!(is_near(found), "{found:?}");
    assert!(window.query_by_label("Search quantities").is_none());
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(&mut window);
    assert_eq!(scene(&window).quantity, None);
}

/// A list that the mouse has opened takes what is written, however fast the click was.
#[test]
fn a_click_opens_the_list_ready_to_be_written_in() {
    for frames in [0, 1, 4] {
        let mut window = plate_window();
        let place = window.get_by_label("Choose a quantity").rect().center();
        window.hover_at(place);
        window.step();
        for pressed in [true, false] {
            window.event(button(place, pressed));
            window.run_steps(frames);
        }
        window.run_steps(3);
        for letter in ["s", "x", "y"] {
            window.event(Event::Text(letter.into()));
            window.step();
        }
        let field = window.get_by_label("Search quantities");
        assert!(field.is_focused(), "{frames}");
        assert_eq!(field.value().as_deref(), Some("sxy"), "{frames}");
    }
}

fn button(pos: Pos2, pressed: bool) -> Event {
    let modifiers = Modifiers::NONE;
    Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers }
}

#[test]
fn a_click_chooses_and_values_of_cells_are_there() {
    let mut window = plate_window();
    click(&mut window, "Choose a quantity");
    write(&mut window, "Search quantities", "level");
    click(&mut window, "level");
    assert_eq!(scene(&window).quantity.as_deref(), Some("level"));
    assert!(frame(&window).shown.quantity().is_none());
}

#[test]
fn a_formula_is_drawn_while_it_is_written_and_a_mistake_keeps_the_picture() {
    let mut window = plate_window();
    write(&mut window, "Quantity or formula", "sxx - 2*syy");
    assert_eq!(scene(&window).quantity.as_deref(), Some("sxx - 2*syy"));
    let found = values(&window, "sxx - 2*syy");
    assert!(is_near(found), "{found:?}");
    window.get_by_label("Quantity or formula").type_text(" + thet");
    settle(&mut window);
    let mistake = "unknown name `thet`";
    assert!(window.query_by_label_contains(mistake).is_some());
    assert_eq!(scene(&window).quantity.as_deref(), Some("sxx - 2*syy"));
    let found = values(&window, "sxx - 2*syy");
    assert!(is_near(found), "{found:?}");
    for _ in 0..4 {
        window.key_press(Key::Backspace);
    }
    window.get_by_label("Quantity or formula").type_text("ux");
    settle(&mut window);
    assert!(window.query_by_label_contains(mistake).is_none());
    assert_eq!(scene(&window).quantity.as_deref(), Some("sxx - 2*syy + ux"));
}

#[test]
fn tab_completes_a_name() {
    let mut window = plate_window();
    write(&mut window, "Quantity or formula", "2*hydr");
    window.step();
    window.key_press(Key::Tab);
    settle(&mut window);
    assert_eq!(scene(&window).quantity.as_deref(), Some("2*hydrostatic"));
    assert!(window.state().session.panels);
}

#[test]
fn writing_is_one_step_of_undo() {
    let mut window = plate_window();
    write(&mut window, "Quantity or formula", "ux");
    window.get_by_label("Quantity or formula").type_text(" + uy");
    settle(&mut window);
    window.key_press(Key::Escape);
    settle(&mut window);
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(&mut window);
    assert_eq!(scene(&window).quantity, None);
    let shown = window.get_by_label("Quantity or formula").value();
    assert_eq!(shown.as_deref(), Some("von-mises"));
    assert!(is_near(values(&window, "von-mises")));
}

#[test]
fn the_formula_behind_a_name_can_be_changed() {
    let mut window = plate_window();
    write(&mut window, "Quantity or formula", "curl");
    click(&mut window, "Show its formula");
    assert_eq!(scene(&window).quantity.as_deref(), Some("duy_dx - dux_dy"));
    let found = values(&window, "curl");
    assert!(is_near(found), "{found:?}");
}

/// A slow frame hands over all keys at once: the list opens, has the text, and Enter chooses.
#[test]
fn keys_of_one_frame_keep_their_order() {
    let mut window = plate_window();
    let key = |key: Key| {
        let (physical_key, repeat, modifiers) = (None, false, Modifiers::NONE);
        let press = |pressed| Event::Key { key, physical_key, pressed, repeat, modifiers };
        [press(true), press(false)]
    };
    let letter = |of: Key, text: &str| {
        let [press, release] = key(of);
        [press, Event::Text(text.into()), release]
    };
    let typed = [(Key::Q, "q"), (Key::S, "s"), (Key::Y, "y"), (Key::Y, "y")];
    let all = typed.into_iter().flat_map(|(of, text)| letter(of, text));
    let events: Vec<_> = all.chain(key(Key::Enter)).chain(letter(Key::L, "l")).collect();
    window.input_mut().events.extend(events);
    window.step();
    for _ in 0..12 {
        window.step();
    }
    let scene = &window.state().session.panes[0].scene;
    assert_eq!(scene.quantity.as_deref(), Some("syy"));
    assert_eq!(scene.colors.scale, ppum_render::scale::Scale::Log, "the key behind Enter");
    assert!(window.query_by_label("Search quantities").is_none());
}
