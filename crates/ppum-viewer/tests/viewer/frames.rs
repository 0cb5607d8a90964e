//! Pictures on their way to the screen.

use std::sync::Arc;
use std::time::Duration;

use egui::{Event, PointerButton, pos2, vec2};
use egui_kittest::Harness;
use ppum_scene::overlays::Overlays;
use ppum_viewer::Viewer;
use ppum_viewer::session::Session;
use ppum_viewer::viewport::pixels::use_device;

use crate::kit::{plate, settle, show_until, wait_until, window};

#[test]
fn at_rest_nothing_is_shown_anew() {
    let mut window = window(plate(), [700.0, 500.0]);
    let frame = window.state().viewports[0].frames.newest().cloned().expect("a picture");
    // a thread may wake the window late, once: the count begins again
    let mut idle_frames = 0;
    show_until(&mut window, "the window no longer asks to be shown", |window| {
        let viewports = window.output().viewport_output.values();
        let delay = viewports.map(|viewport| viewport.repaint_delay).min();
        let is_idle = delay == Some(Duration::MAX) && !window.state().viewports[0].is_drawing();
        idle_frames = if is_idle { idle_frames + 1 } else { 0 };
        idle_frames == 60
    });
    let later = window.state().viewports[0].frames.newest().expect("a picture");
    assert!(Arc::ptr_eq(&frame, later) && frame.is_final);
}

#[test]
fn a_drag_moves_the_picture_and_ends_with_the_whole_one() {
    let mut window = window(plate(), [700.0, 500.0]);
    let view =
        |window: &Harness<'_, Viewer>| window.state().viewports[0].camera.view.expect("a plate");
    let (before, mut mouse) = (view(&window), pos2(200.0, 250.0));
    window.event(Event::PointerMoved(mouse));
    window.step();
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: egui::Modifiers::NONE,
    };
    window.event(button(mouse, true));
    window.step();
    // on a busy machine the whole picture may replace a strip before it is seen: the drag goes on,
    // to and fro
    let (mut was_rough, mut moves, start) = (false, 0, mouse);
    wait_until("strips are drawn while one drags", || {
        let is_back = moves / 10 % 2 == 1;
        mouse += vec2(6.0, -2.0) * if is_back { -1.0 } else { 1.0 };
        moves += 1;
        window.event(Event::PointerMoved(mouse));
        show_until(&mut window, "the new place is drawn", |window| {
            let newest = window.state().viewports[0].frames.newest().expect("a picture");
            was_rough |= newest.drawn.by.ends_with("moved");
            newest.request.view == view(window)
        });
        was_rough && moves >= 10
    });
    window.event(button(mouse, false));
    settle(&mut window);
    let after = view(&window);
    let moved = (before.center - after.center) / before.pixel_size();
    let [x, y] = [mouse.x - start.x, start.y - mouse.y].map(f64::from);
    assert!((moved.x - x).abs() < 1e-6 && (moved.y - y).abs() < 1e-6, "{moved:?}");
    let last = window.state().viewports[0].frames.newest().expect("a picture");
    assert!(last.is_final && last.drawn.view == after && last.drawn.by == "cpu f64");
}

/// The shader that fetches pixels draws what egui draws.
#[test]
fn both_shaders_draw_the_same_pixels() {
    let draw = |ours: bool| {
        let dataset = Arc::new(plate());
        let builder = Harness::builder().with_size([500.0, 400.0]).with_max_steps(1000).wgpu();
        let mut harness = builder.build_eframe(|cc| {
            let state = cc.wgpu_render_state.as_ref().expect("wgpu draws");
            if ours {
                use_device(&cc.egui_ctx, state.target_format);
            }
            let mut session = Session { panels: false, ..Session::default() };
            // lines are drawn by egui, whatever fetches the pixels
            session.panes[0].scene.overlays = Overlays::default();
            let mut viewer = Viewer::new(&cc.egui_ctx, session);
            viewer.open(None, dataset);
            viewer
        });
        settle(&mut harness);
        harness.render().expect("a driver draws")
    };
    let [ours, theirs] = [true, false].map(draw);
    assert_eq!(ours.dimensions(), theirs.dimensions());
    let far = ours
        .pixels()
        .zip(theirs.pixels())
        .filter(|(a, b)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 1));
    assert_eq!(far.count(), 0);
    let colors: std::collections::BTreeSet<_> = ours.pixels().map(|pixel| pixel.0).collect();
    assert!(colors.len() > 50, "a picture is there");
}
