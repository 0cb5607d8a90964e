//! Moving through the plane.

use egui::Key;

use crate::kit::{plate, settle, window};

#[test]
fn plus_enlarges_and_f_shows_the_whole_plate() {
    let mut window = window(plate(), [900.0, 600.0]);
    let view = |window: &egui_kittest::Harness<'_, ppum_viewer::Viewer>| {
        window.state().stages[0].view.expect("a plate is shown")
    };
    let whole = view(&window);
    window.key_press(Key::Plus);
    settle(&mut window);
    assert!((view(&window).width * 1.5 / whole.width - 1.0).abs() < 1e-12);
    window.key_press(Key::F);
    settle(&mut window);
    std::thread::sleep(std::time::Duration::from_millis(2100));
    settle(&mut window);
    assert_eq!(view(&window), whole);
}
