//! Curves over the plate: drawn, plotted, integrated.

use egui::{Event, Key, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use ppum::field::Field;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::vec2::vec2 as v;
use ppum_scene::profile::ProfileCurve;
use ppum_viewer::Viewer;
use ppum_viewer::measure::plot_request::CurveValues;
use ppum_viewer::measure::tool::Tool;
use ppum_viewer::session::{DrawerPage, VisibleRegion};

use crate::kit::{at, plate, settle, show_until, window};

type Window = Harness<'static, Viewer>;

const SIZE: [f32; 2] = [1000.0, 700.0];

fn curve(window: &Window) -> Option<ProfileCurve> {
    window.state().session.panes[0].curve
}

fn draw(window: &mut Window, tool: Option<Tool>, from: Pos2, to: Pos2) {
    window.state_mut().viewports[0].tools.tool = tool;
    window.hover_at(from);
    window.step();
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    window.event(button(from, true));
    window.step();
    for k in 1..=4 {
        window.hover_at(from + (to - from) * (k as f32 / 4.0));
        window.step();
    }
    window.event(button(to, false));
    window.step();
    settle(window);
}

fn plotted(window: &mut Window) -> std::sync::Arc<Result<CurveValues, String>> {
    settle(window);
    settle(window);
    let (_, found) = window.state_mut().viewports[0].tools.plot.newest().expect("a plot").clone();
    found
}

#[test]
fn a_line_is_drawn_and_its_ends_can_be_moved() {
    let mut window = window(plate(), SIZE);
    let view = window.state().viewports[0].camera.view.expect("a view");
    let [a, b] = [v(-0.8, 0.3), v(0.7, -0.2)].map(|p| at(&window, p));
    draw(&mut window, Some(Tool::Line), a, b);
    let Some(ProfileCurve::Line { anchor, from, to }) = curve(&window) else { panic!("no line") };
    assert_eq!(anchor, [0.0; 2]);
    let near = |p: [f64; 2], x: f64, y: f64| (p[0] - x).hypot(p[1] - y) < 2.0 * view.pixel_size();
    assert!(near(from, -0.8, 0.3) && near(to, 0.7, -0.2), "{from:?} {to:?}");
    assert_eq!(window.state().session.panes[0].place, None, "the plate was not dragged along");
    // the plot has opened, and the plate is smaller
    let view = window.state().viewports[0].camera.view.expect("a view");
    let near = |p: [f64; 2], x: f64, y: f64| (p[0] - x).hypot(p[1] - y) < 2.0 * view.pixel_size();
    let [b, c] = [v(0.7, -0.2), v(0.2, 0.9)].map(|p| at(&window, p));
    draw(&mut window, None, b, c);
    let Some(ProfileCurve::Line { from: same, to, .. }) = curve(&window) else { panic!("no line") };
    assert!(same == from && near(to, 0.2, 0.9), "{to:?}");
    // the numbers are short
    assert!(to.iter().all(|v| format!("{v}").len() < 9), "{to:?}");
}

/// The table of a drawn line is what `ppum sample` writes for it, and the plot has both sides of
/// the crack.
#[test]
fn a_line_has_the_values_that_the_program_samples() {
    let dataset = plate();
    let mut window = window(dataset.clone(), SIZE);
    let along = ProfileCurve::Line { anchor: [0.0; 2], from: [0.1, -0.5], to: [0.1, 0.5] };
    let state = window.state_mut();
    state.session.panes[0].curve = Some(along);
    state.session.panes[0].plot.quantities = Some("uy, max(sxx, syy)".into());
    state.session.drawer = Some(DrawerPage::Plot);
    let found = plotted(&mut window);
    let values = found.as_ref().as_ref().expect("values");
    let field = Field::new(&dataset, 0).expect("a field");
    let uy = Quantity::parse("uy", &field).expect("a quantity");
    let parts = ppum::sample::evenly(201);
    let places = ppum::sample::line(&field.step.cracks, [v(0.1, -0.5), v(0.1, 0.5)], &parts);
    let expected = ppum::sample::evaluate(&field, &[uy], &places, unwatched()).expect("values");
    assert_eq!(values.table.column("uy"), Some(expected));
    let csv = values.table.csv();
    assert!(csv.starts_with("s,x,y,side,uy"), "{}", csv.lines().next().unwrap_or_default());
    assert_eq!(csv.lines().count(), 1 + places.len());
    // the curve of the plot breaks at the crack, and jumps there
    let plot = values.plot([false; 2]);
    let gaps = plot.curves[0].points.iter().filter(|p| p[1].is_nan()).count();
    assert_eq!(gaps, 1);
    let rect = window.get_by_label("Plotted curves").rect();
    window.hover_at(rect.center());
    settle(&mut window);
    let marked = window.state().viewports[0].tools.marked.expect("a point of the plate");
    assert!((marked.point().x - 0.1).abs() < 1e-12 && marked.point().y.abs() < 0.1, "{marked:?}");
}

#[test]
fn a_mistake_in_a_quantity_is_told_beside_the_plot() {
    let mut window = window(plate(), SIZE);
    let state = window.state_mut();
    state.session.panes[0].curve = Some(ProfileCurve::Crack { index: 0 });
    state.session.panes[0].plot.quantities = Some("uy + ".into());
    state.session.drawer = Some(DrawerPage::Plot);
    assert!(plotted(&mut window).is_err());
    window.state_mut().session.panes[0].plot.quantities = None;
    let found = plotted(&mut window);
    let names: Vec<_> = found.as_ref().as_ref().expect("values").plot([false; 2]).curves;
    let names: Vec<_> = names.into_iter().map(|curve| curve.label).collect();
    assert_eq!(names, ["opening", "sliding"]);
    window.state_mut().session.panes[0].curve = Some(ProfileCurve::Crack { index: 7 });
    assert!(plotted(&mut window).is_err());
}

/// On a ray ahead of a tip the stress falls as r^(−1/2), and the plot says so.
#[test]
fn a_ray_has_the_exponent_of_the_singularity() {
    let mut window = window(plate(), SIZE);
    let state = window.state_mut();
    state.session.panes[0].curve = Some(ProfileCurve::Ray { tip: 1, angle: 0.0, far: Some(1e-6) });
    state.session.panes[0].plot.quantities = Some("syy".into());
    state.session.panes[0].plot.log = [true; 2];
    state.session.drawer = Some(DrawerPage::Plot);
    let found = plotted(&mut window);
    let plot = found.as_ref().as_ref().expect("values").plot([true; 2]);
    assert_eq!(plot.curves[0].label, "syy, slope −0.500");
}

/// Circles around a tip have the factors that the solver stores: on its own radius the same number,
/// on others as near as its three radii are to each other, a hundred times their spread
/// allowed for.
#[test]
fn circles_around_a_tip_have_its_factors() {
    let dataset = plate();
    let stored = dataset.steps[0].intensities[1].clone();
    let own = stored.rings.last().expect("a ring").r2;
    let mut window = window(dataset, SIZE);
    for (part, tolerance) in [(1.0, 1e-10), (0.4, 1e-2), (0.15, 2e-2)] {
        let radius = Some(part * own);
        window.state_mut().session.panes[0].curve = Some(ProfileCurve::Around { tip: 1, radius });
        settle(&mut window);
        settle(&mut window);
        let found = window.state_mut().viewports[0].tools.integral.newest_factors();
        let factors = found.expect("it is done").expect("it is possible");
        assert!((factors.k1 / stored.k1 - 1.0).abs() < tolerance, "{part}: {}", factors.k1);
        let miss = (factors.k2 - stored.k2).abs();
        assert!(miss < tolerance * stored.k1, "{part}: {}", factors.k2);
        assert!(window.query_all_by_label_contains("K_I = ").next().is_some());
    }
}

#[test]
fn a_circle_without_factors_says_why() {
    let mut window = window(plate(), SIZE);
    let cases = [
        (ProfileCurve::Circle { center: [0.0, 0.7], radius: 0.1 }, "holds no tip"),
        (
            ProfileCurve::Circle { center: [0.45, 0.05], radius: 0.2 },
            "drag the circle's centre to tip 1",
        ),
        (ProfileCurve::Circle { center: [0.0, 0.0], radius: 0.9 }, "holds 2 tips"),
        (ProfileCurve::Around { tip: 1, radius: Some(5.0) }, "the circle meets"),
        (ProfileCurve::Around { tip: 9, radius: Some(0.1) }, "no tip 9"),
    ];
    for (along, reason) in cases {
        window.state_mut().session.panes[0].curve = Some(along);
        settle(&mut window);
        settle(&mut window);
        let found = window.state_mut().viewports[0].tools.integral.newest_factors();
        let told = found.expect("it is done").expect_err("there are no factors");
        assert!(told.contains(reason), "{told}");
    }
}

/// The key takes a circle away, also one whose radius was changed.
#[test]
fn k_takes_a_circle_away_whatever_its_radius() {
    let mut window = window(plate(), SIZE);
    let left = at(&window, v(-0.4, 0.2));
    window.hover_at(left);
    settle(&mut window);
    let own = Some(ProfileCurve::Around { tip: 0, radius: Some(0.0625) });
    window.state_mut().session.panes[0].curve = own;
    window.key_press(Key::K);
    settle(&mut window);
    assert_eq!(curve(&window), None);
    // one around another tip is moved
    window.state_mut().session.panes[0].curve =
        Some(ProfileCurve::Around { tip: 1, radius: Some(0.0625) });
    window.key_press(Key::K);
    settle(&mut window);
    assert!(matches!(curve(&window), Some(ProfileCurve::Around { tip: 0, .. })));
}

#[test]
fn k_draws_the_circle_that_the_solver_takes() {
    let dataset = plate();
    let own = dataset.steps[0].intensities[0].rings.last().expect("a ring").r2;
    let mut window = window(dataset, SIZE);
    let left = at(&window, v(-0.4, 0.2));
    window.hover_at(left);
    settle(&mut window);
    window.key_press(Key::K);
    settle(&mut window);
    let Some(ProfileCurve::Around { tip: 0, radius: Some(radius) }) = curve(&window) else {
        panic!("{:?}", curve(&window))
    };
    assert!((radius / own - 1.0).abs() < 1e-12 || radius < own, "{radius} {own}");
    assert_eq!(window.state().session.drawer, Some(DrawerPage::Plot));
    // the same key takes it away
    window.hover_at(left);
    settle(&mut window);
    window.key_press(Key::K);
    settle(&mut window);
    assert_eq!(curve(&window), None);
}

#[test]
fn a_circle_drawn_from_a_tip_is_around_it() {
    let mut window = window(plate(), SIZE);
    let tip = at(&window, v(0.5, 0.0));
    draw(&mut window, Some(Tool::Circle), tip + vec2(3.0, 2.0), tip + vec2(50.0, 0.0));
    let view = window.state().viewports[0].camera.view.expect("a view");
    match curve(&window) {
        Some(ProfileCurve::Around { tip: 1, radius: Some(radius) }) => {
            assert!((radius - 50.0 * view.pixel_size()).abs() < 2.0 * view.pixel_size());
        }
        other => panic!("{other:?}"),
    }
    let free = at(&window, v(0.0, 0.6));
    draw(&mut window, Some(Tool::Circle), free, free + vec2(0.0, 30.0));
    assert!(matches!(curve(&window), Some(ProfileCurve::Circle { .. })), "{:?}", curve(&window));
}

/// Deep inside a line is counted from a tip, and keeps its digits there.
#[test]
fn a_line_of_a_deep_view_keeps_its_digits() {
    let dataset = plate();
    let tip = dataset.steps[0].cracks[0].points[1];
    let mut window = window(dataset.clone(), SIZE);
    let state = window.state_mut();
    state.session.panes[0].place = Some(VisibleRegion { center: tip.into(), width: 1e-11 });
    state.session.panes[0].scene.quantity = Some("uy".into());
    settle(&mut window);
    let middle = window.get_by_label("Plate").rect().center();
    draw(
        &mut window,
        Some(Tool::Line),
        middle + vec2(-150.0, 100.0),
        middle + vec2(-150.0, -100.0),
    );
    let Some(ProfileCurve::Line { anchor, from, to }) = curve(&window) else { panic!("no line") };
    assert_eq!(anchor, [tip.x, tip.y]);
    assert!(from[1] < 0.0 && to[1] > 0.0 && from[1] > -1e-11);
    window.state_mut().session.drawer = Some(DrawerPage::Plot);
    let found = plotted(&mut window);
    let values = found.as_ref().as_ref().expect("values");
    let field = Field::new(&dataset, 0).expect("a field");
    let uy = Quantity::parse("uy", &field).expect("a quantity");
    let column = values.table.column("uy").expect("a column");
    let last = uy.at(&mut field.at(tip), to.into(), ppum::crack::Side::Above);
    assert_eq!(column.last(), Some(&last));
    // both sides of the crack, 10⁻¹² of the plate from its tip
    let gaps = values.plot([false; 2]).curves[0].points.iter().filter(|p| p[1].is_nan()).count();
    assert_eq!(gaps, 1);
}

#[test]
fn the_table_of_tips_flies_to_its_rows() {
    let dataset = plate();
    let [k1, _] = [dataset.steps[0].intensities[0].k1, 0.0];
    let mut window = window(dataset, SIZE);
    window.key_press(Key::T);
    settle(&mut window);
    let shown = ppum::text::short(k1);
    assert!(window.query_all_by_label_contains(&shown).next().is_some(), "{shown}");
    window.get_by_label("Fly to tip 1").click();
    let is_at_tip = |window: &Window| {
        let place = window.state().session.panes[0].place;
        place.is_some_and(|p| (p.center[0] - 0.5).abs() < 1e-12 && p.center[1].abs() < 1e-12)
    };
    show_until(&mut window, "the view flies to the tip", is_at_tip);
    settle(&mut window);
    assert!(is_at_tip(&window));
}

#[test]
fn files_are_written_but_never_over_the_dataset() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(plate(), SIZE);
    let own = folder.path().join("plate.csv");
    std::fs::write(&own, "the dataset").expect("written");
    let state = window.state_mut();
    state.viewports[0].opened.as_mut().expect("open").path = Some(own.clone());
    state.session.panes[0].curve = Some(ProfileCurve::Crack { index: 0 });
    state.session.drawer = Some(DrawerPage::Plot);
    let found = plotted(&mut window);
    let values = found.as_ref().as_ref().expect("values");
    // a name without a folder goes beside the dataset, and so does the one that is proposed
    let whole = folder.path().join("plate").display().to_string();
    for (name, is_written) in [(&*whole, false), ("plate", false), ("table", true), ("", true)] {
        let targets = &mut window.state_mut().viewports[0].tools.targets;
        targets.entry("plot").or_default().name = name.to_owned();
        settle(&mut window);
        window.get_by_label("Save CSV").click();
        settle(&mut window);
        let told = window.state().viewports[0].tools.targets["plot"].result.clone().expect("told");
        assert_eq!(told.is_ok(), is_written, "{told:?}");
    }
    assert_eq!(std::fs::read_to_string(&own).expect("there"), "the dataset");
    let written = std::fs::read_to_string(folder.path().join("table.csv")).expect("there");
    assert_eq!(written, values.table.csv());
    let proposed = std::fs::read_to_string(folder.path().join("plate-plot.csv"));
    assert_eq!(proposed.expect("there"), written);
    window.state_mut().viewports[0].tools.targets.entry("plot").or_default().name =
        folder.path().join("table").display().to_string();
    let mine = folder.path().join("table.svg");
    std::fs::write(&mine, "mine").expect("written");
    window.get_by_label("Save SVG").click();
    settle(&mut window);
    window.get_by_label_contains("save again to replace it");
    assert_eq!(std::fs::read_to_string(&mine).expect("there"), "mine");
    for end in ["SVG", "PDF", "PNG"] {
        window.get_by_label(&format!("Save {end}")).click();
        settle(&mut window);
        let path = folder.path().join(format!("table.{}", end.to_lowercase()));
        assert!(std::fs::metadata(path).expect("there").len() > 1000);
    }
}
