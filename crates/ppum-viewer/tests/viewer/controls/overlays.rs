//! Overlays, isolines, arrows and crosses.

use egui::Key;
use egui_kittest::kittest::{NodeT, Queryable};
use ppum_figure::canvas::CanvasItem;
use ppum_scene::overlays::{IsolineLevels, Overlay, SPACING};

use super::{Window, click, frame, plate_window, scene, write};
use crate::kit::settle;

/// A plate without the cracks that are shown by default.
fn bare_window() -> Window {
    let mut window = plate_window();
    click(&mut window, "cracks");
    window
}

#[test]
fn every_overlay_is_a_switch() {
    let mut window = bare_window();
    for (label, overlay) in [
        ("patches", Overlay::Patches),
        ("cells", Overlay::Cells),
        ("centres", Overlay::Centers),
        ("rings", Overlay::Rings),
        ("cracks", Overlay::Cracks),
        ("supports", Overlay::Supports),
        ("loads", Overlay::Loads),
    ] {
        let before = frame(&window).layers.items.len();
        click(&mut window, label);
        assert_eq!(scene(&window).overlays.shown, [overlay], "{label}");
        assert!(frame(&window).layers.items.len() > before, "{label}");
        click(&mut window, label);
        assert!(
            scene(&window).overlays.shown.is_empty() && before == frame(&window).layers.items.len()
        );
    }
    // the cover of this plate was made without points
    assert!(window.get_by_label("points").accesskit_node().is_disabled());
}

#[test]
fn isolines_have_levels_that_are_written() {
    let mut window = plate_window();
    click(&mut window, "isolines");
    assert_eq!(scene(&window).overlays.isolines, Some(IsolineLevels::Auto));
    let lines = |window: &super::Window| {
        let frame = frame(window);
        frame.layers.items.iter().filter(|item| matches!(item, CanvasItem::Line { .. })).count()
    };
    assert!(lines(&window) > 0);
    write(&mut window, "Levels of isolines", "0.5, 1,");
    assert_eq!(scene(&window).overlays.isolines, Some(IsolineLevels::At(vec![0.5, 1.0])));
    write(&mut window, "Levels of isolines", "0.5, x");
    assert!(window.query_by_label_contains("write finite values with commas between").is_some());
    assert_eq!(scene(&window).overlays.isolines, Some(IsolineLevels::At(vec![0.5, 1.0])));
    write(&mut window, "Levels of isolines", "1e9,");
    assert!(window.query_by_label_contains("no isoline lies in the picture").is_some());
    write(&mut window, "Levels of isolines", "auto");
    let without = frame(&window).layers.items.len();
    click(&mut window, "labels");
    assert!(scene(&window).overlays.level_labels && frame(&window).layers.items.len() > without);
}

#[test]
fn o_hides_all_and_brings_them_back() {
    let mut window = bare_window();
    window.key_press(Key::O);
    settle(&mut window);
    assert_eq!(scene(&window).overlays.shown, [Overlay::Cracks]);
    click(&mut window, "arrows of the displacement");
    click(&mut window, "crosses of principal stresses");
    assert_eq!(scene(&window).overlays.crosses, Some(SPACING));
    let all = scene(&window).overlays;
    window.key_press(Key::O);
    settle(&mut window);
    assert!(frame(&window).layers.items.is_empty());
    window.key_press(Key::O);
    settle(&mut window);
    assert_eq!(scene(&window).overlays, all);
}

#[test]
fn the_deformed_plate_leaves_out_what_it_does_not_have() {
    let mut window = bare_window();
    click(&mut window, "patches");
    window.key_press(Key::D);
    settle(&mut window);
    assert!(window.state().viewports[0].frames.failure().is_none());
    assert!(frame(&window).factor.is_some());
    assert!(window.get_by_label("rings").accesskit_node().is_disabled());
    assert!(!window.get_by_label("cells").accesskit_node().is_disabled());
    // what is on can be switched off
    click(&mut window, "patches");
    assert!(scene(&window).overlays.shown.is_empty());
}
