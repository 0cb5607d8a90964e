//! Pictures of the window, to be looked at: `PPUM_SHOTS=FOLDER cargo test -p ppum-viewer -- --ignored shots`.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

use super::{click, open, plate_window, scene, write};
use crate::kit::{plate, settle, shot, window};

#[test]
#[ignore = "writes files"]
fn shots() {
    let mut window = window(plate(), [1280.0, 800.0]);
    shot(&mut window, "plate");
    window.key_press(Key::Q);
    settle(&mut window);
    window.run_steps(4);
    shot(&mut window, "quantities");
    window.key_press(Key::Escape);
    window.run_steps(4);
    write(&mut window, "Quantity or formula", "sxx - 2*syy + thet");
    window.run_steps(4);
    shot(&mut window, "mistake");
    write(&mut window, "Quantity or formula", "hyd");
    window.run_steps(4);
    shot(&mut window, "completion");
    write(&mut window, "Quantity or formula", "von-mises");
    window.key_press(Key::Escape);
    settle(&mut window);
    click(&mut window, "Choose a colour map");
    window.run_steps(4);
    shot(&mut window, "maps");
    window.key_press(Key::Escape);
    settle(&mut window);
    let at = window.get_by_label("Plate").rect().center() + egui::vec2(-60.0, 30.0);
    window.hover_at(at);
    window.run_steps(4);
    for label in ["isolines", "labels", "centres", "cracks", "arrows of the displacement"] {
        click(&mut window, label);
    }
    shot(&mut window, "overlays");
    window.key_press(Key::O);
    window.key_press(Key::C);
    settle(&mut window);
    shot(&mut window, "compare");
    let _ = scene(&window);
}

#[test]
#[ignore = "writes files"]
fn shots_of_all_panels() {
    let mut window = plate_window();
    for panel in ["Parts", "Deformation", "Compare", "Functions"] {
        open(&mut window, panel);
    }
    window.key_press(Key::C);
    settle(&mut window);
    click(&mut window, "difference");
    shot(&mut window, "panels");
    window.state_mut().session.theme = ppum_viewer::session::Theme::Light;
    window.ctx.set_theme(egui::Theme::Light);
    window.key_press_modifiers(Modifiers::SHIFT, Key::R);
    settle(&mut window);
    shot(&mut window, "light");
}

#[test]
#[ignore = "writes files"]
fn shots_of_a_small_window() {
    let mut window = window(plate(), [700.0, 500.0]);
    shot(&mut window, "small");
    write(&mut window, "Quantity or formula", "overlap");
    window.key_press(Key::Escape);
    settle(&mut window);
    shot(&mut window, "small-classes");
}
