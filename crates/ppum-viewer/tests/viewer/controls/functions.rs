//! Functions and the weight, replaced.

use egui_kittest::kittest::Queryable;
use ppum::crack::Side;
use ppum::dataset::{Dataset, NamedQuantity};
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum::replace::Replacements;

use super::{click, frame, open, plate_window, scene, write};
use crate::kit::plate;
use crate::kit::settle;

/// The quantity of the picture beside a tip, and that of the plate with something replaced.
fn both(window: &super::Window, replacements: &Replacements) -> [f64; 2] {
    let frame = frame(window);
    let view = frame.request.view;
    let tip = view.pixel_of_offset(ppum::vec2::vec2(0.5, 0.0) - view.center);
    // close to the border of two cells, where patches overlap and the weight matters
    let [i, j] = [tip.x as u32 + 8, tip.y as u32 - 30];
    let ppum_scene::values::RasterValues::Double(raster) = &frame.drawn.values else {
        panic!("pictures are of double precision")
    };
    let mut dataset: Dataset = plate();
    replacements.apply(&mut dataset, 0).expect("they fit");
    let field = Field::new(&dataset, 0).expect("a field");
    let value = Quantity::VonMises.at(&mut field.at(view.center), view.offset(i, j), Side::Above);
    [raster.value(i, j), value]
}

fn is_near([a, b]: [f64; 2]) -> bool {
    (a - b).abs() <= 1e-12 * b.abs()
}

#[test]
fn a_function_is_replaced_while_it_is_written_and_given_back() {
    let mut window = plate_window();
    open(&mut window, "Functions");
    let own = window.get_by_label("Formula of westergaard 1").value();
    assert_eq!(own.as_deref(), Some("sqrt(r)*cos(theta/2)"));
    let text = "r*cos(theta/2)";
    write(&mut window, "Formula of westergaard 1", text);
    let functions = vec![("westergaard 1".to_owned(), text.to_owned())];
    assert_eq!(scene(&window).subject.functions, functions);
    let replaced = both(&window, &Replacements { functions, ..Replacements::default() });
    assert!(is_near(replaced), "{replaced:?}");
    window.get_by_label("Formula of westergaard 1").type_text(" + phi");
    crate::kit::settle(&mut window);
    assert!(window.query_by_label_contains("unknown name `phi`").is_some());
    assert_eq!(scene(&window).subject.replaced("westergaard 1"), Some(text));
    click(&mut window, "Back to the file's westergaard 1");
    assert!(scene(&window).subject.functions.is_empty());
    let own = both(&window, &Replacements::default());
    assert!(is_near(own) && own[0] != replaced[0], "{own:?}");
}

#[test]
fn the_weight_is_one_of_the_library_or_a_formula() {
    let mut window = plate_window();
    open(&mut window, "Functions");
    click(&mut window, "Weights of the library");
    click(&mut window, "bump");
    assert_eq!(scene(&window).subject.weight.as_deref(), Some("bump"));
    let with = |text: &str| Replacements { weight: Some(text.into()), ..Replacements::default() };
    let bump = both(&window, &with("bump"));
    assert!(is_near(bump), "{bump:?}");
    write(&mut window, "Formula of the weight", "(1 - t)^3");
    let own = both(&window, &with("(1 - t)^3"));
    assert!(is_near(own) && own[0] != bump[0], "{own:?}");
    // without any text it is the file's, and the field waits for another one
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.step();
    window.key_press(egui::Key::Backspace);
    settle(&mut window);
    assert!(scene(&window).subject.is_whole());
    window.run_steps(2);
    window.get_by_label("Formula of the weight").type_text("(1 - t)^5");
    settle(&mut window);
    assert_eq!(scene(&window).subject.weight.as_deref(), Some("(1 - t)^5"));
    click(&mut window, "Back to the file's, all of them");
    assert!(scene(&window).subject.is_whole());
}

/// Quantities that use one that is replaced are others, too.
#[test]
fn a_quantity_of_the_file_is_replaced() {
    let mut dataset = plate();
    let named = |name: &str, text: &str| NamedQuantity {
        name: name.into(),
        text: text.into(),
        unit: String::new(),
    };
    dataset.quantities = vec![named("spread", "sxx - syy"), named("twice", "2*spread")];
    let mut window = crate::kit::window(dataset, [1100.0, 1400.0]);
    write(&mut window, "Quantity or formula", "twice");
    open(&mut window, "Functions");
    write(&mut window, "Formula of spread", "twice + 1");
    assert!(window.query_by_label_contains("unknown name `twice`").is_some());
    write(&mut window, "Formula of spread", "exx + 1");
    assert_eq!(scene(&window).subject.defined("spread"), Some("exx + 1"));
    let frame_of = frame(&window);
    let view = frame_of.request.view;
    let ppum_scene::values::RasterValues::Double(raster) = &frame_of.drawn.values else {
        panic!("pictures are of double precision")
    };
    let [i, j] = view.pixels.map(|n| n / 3);
    let dataset = plate();
    let field = Field::new(&dataset, 0).expect("a field");
    let exx = Quantity::parse("exx", &field).expect("a quantity");
    let exx = exx.at(&mut field.at(view.center), view.offset(i, j), Side::Above);
    assert!(is_near([raster.value(i, j), 2.0 * (exx + 1.0)]));
    click(&mut window, "Back to the file's spread");
    assert!(scene(&window).subject.is_whole());
}
