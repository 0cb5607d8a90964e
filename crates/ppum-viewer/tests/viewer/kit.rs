//! A window without a display.

use std::path::Path;
use std::sync::{Arc, LazyLock};
use std::time::{Duration, Instant};

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use ppum::dataset::Dataset;
use ppum::progress::unwatched;
use ppum::vec2::Vec2;
use ppum_fracture::solve::solve;
use ppum_problem::Problem;
use ppum_viewer::Viewer;
use ppum_viewer::session::Session;

/// A window of some size that shows a dataset, its picture complete.
pub(crate) fn window(dataset: Dataset, size: [f32; 2]) -> Harness<'static, Viewer> {
    let dataset = Arc::new(dataset);
    let mut harness =
        Harness::builder().with_size(size).with_max_steps(1000).with_step_dt(0.05).build_eframe(
            |cc| {
                let mut viewer = Viewer::new(&cc.egui_ctx, Session::default());
                viewer.open(None, dataset);
                viewer
            },
        );
    settle(&mut harness);
    harness
}

/// The longest wait for a state. Only a test that hangs waits so long.
pub(crate) const TIME_LIMIT: Duration = Duration::from_secs(300);

/// Waits until a condition holds.
pub(crate) fn wait_until(what: &str, mut is_so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < TIME_LIMIT, "waited {TIME_LIMIT:?} until {what}");
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// Shows the window until a condition holds.
pub(crate) fn show_until(
    window: &mut Harness<'static, Viewer>,
    what: &str,
    mut is_so: impl FnMut(&Harness<'static, Viewer>) -> bool,
) {
    wait_until(what, || {
        window.step();
        is_so(window)
    });
}

/// Shows the window until nothing is drawn or read.
pub(crate) fn settle(window: &mut Harness<'static, Viewer>) {
    loop {
        show_until(window, "the window comes to rest", is_at_rest);
        window.step();
        // an answer may lead to the next question
        if is_at_rest(window) {
            return;
        }
    }
}

fn is_at_rest(window: &Harness<'static, Viewer>) -> bool {
    let is_working = |viewport: &ppum_viewer::viewport::ViewState| {
        viewport.is_drawing() || viewport.tools.is_working()
    };
    !window.state().viewports.iter().any(is_working)
}

/// A plate with a crack, solved coarsely.
pub(crate) fn plate() -> Dataset {
    static PLATE: LazyLock<Dataset> = LazyLock::new(|| {
        let text = include_str!("../../../../examples/centre-crack.toml");
        let text = text.replace("level = 6", "level = 3");
        let problem = Problem::parse(&text, "plate", Path::new(".")).expect("it is a problem");
        solve(&problem, unwatched()).expect("it can be solved")
    });
    PLATE.clone()
}

/// The position of a point of the plate in the window.
pub(crate) fn at(harness: &Harness<'static, Viewer>, point: Vec2) -> egui::Pos2 {
    let rect = harness.get_by_label("Plate").rect();
    let view = harness.state().viewports[0].camera.view.expect("a plate is shown");
    let pixel = view.pixel(point) * (f64::from(rect.width()) / f64::from(view.pixels[0]));
    rect.min + egui::vec2(pixel.x as f32, pixel.y as f32)
}

/// Moves the pointer to a point of the plate.
pub(crate) fn hover(harness: &mut Harness<'static, Viewer>, point: Vec2) {
    let place = at(harness, point);
    harness.hover_at(place);
    settle(harness);
}
