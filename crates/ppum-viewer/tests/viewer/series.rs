//! Series: the steps one after the other, their plots, and what the solver has told of them.

use std::path::Path;
use std::sync::Arc;

use egui::Key;
use egui_kittest::kittest::Queryable as _;
use ppum::crack::{End, TipId};
use ppum::dataset::{Dataset, GrowthStop, Record, TipIncrement, TipIntensity, TipStatus, Warning};
use ppum::progress::unwatched;
use ppum::vec2::vec2;
use ppum_fracture::solve::solve;
use ppum_problem::Problem;
use ppum_testkit::synthetic::growing;
use ppum_viewer::export::{ExportChoice, Motion};
use ppum_viewer::panels::drawer::series::{plots, words};
use ppum_viewer::panels::drawer::{series_table, solver};
use ppum_viewer::session::DrawerPage;
use ppum_viewer::viewport::marks::growth_ends;

use crate::kit::plate;
use crate::lab::{Lab, shot};

fn series(count: usize) -> Lab {
    let mut lab = Lab::new();
    lab.state().open(None, Arc::new(growing(count)));
    lab.settle();
    lab
}

fn step(lab: &mut Lab) -> Option<usize> {
    lab.state().session.panes[0].scene.subject.step
}

#[test]
fn keys_and_buttons_go_through_the_steps() {
    let mut lab = series(4);
    lab.window.get_by_label("step 3 of 3, load 1");
    for (key, expected) in [
        (Key::CloseBracket, 3),
        (Key::OpenBracket, 2),
        (Key::OpenBracket, 1),
        (Key::OpenBracket, 0),
        (Key::OpenBracket, 0),
        (Key::CloseBracket, 1),
    ] {
        lab.window.key_press(key);
        lab.window.step();
        assert_eq!(step(&mut lab), Some(expected));
    }
    lab.window.get_by_label("Step after").click();
    lab.settle();
    assert_eq!(step(&mut lab), Some(2));
    // what is drawn is that step
    let frame = lab.window.state().viewports[0].frames.newest().cloned().expect("a picture");
    assert_eq!(frame.request.scene.subject.step, Some(2));
    assert_eq!(frame.field.field().step.load, lab.dataset(0).expect("open").steps[2].load);
    // and it is a setting that can be undone
    lab.window.get_by_label("Undo").click();
    lab.window.step();
    assert_eq!(step(&mut lab), Some(1));
}

#[test]
fn a_single_step_has_no_player() {
    let mut lab = Lab::new();
    lab.state().open(None, Arc::new(plate()));
    lab.settle();
    assert!(lab.window.query_by_label("Play the steps").is_none());
    lab.window.key_press(Key::Space);
    lab.window.key_press(Key::OpenBracket);
    lab.window.step();
    assert!(!lab.state().player.is_playing);
}

#[test]
fn it_plays_to_the_end_and_again_from_the_start() {
    let mut lab = series(3);
    lab.state().player.speed = 30.0;
    lab.state().player.is_looping = false;
    lab.window.key_press(Key::Space);
    lab.window.step();
    assert!(lab.state().player.is_playing);
    assert_eq!(step(&mut lab), Some(0), "from the end it begins anew");
    lab.until("it stops at the end", |viewer| !viewer.player.is_playing);
    assert_eq!(step(&mut lab), Some(2));
    // every step was one of the player, so one undo leads before all of them
    lab.settle();
    lab.window.get_by_label("Undo").click();
    lab.window.step();
    assert_eq!(step(&mut lab), None);
    lab.window.get_by_label("Loop").click();
    lab.window.step();
    lab.window.get_by_label("Play the steps").click();
    lab.window.step();
    for expected in [1, 2, 0, 1] {
        lab.until("it goes round", |viewer| {
            viewer.session.panes[0].scene.subject.step == Some(expected)
        });
    }
    lab.window.get_by_label("Stop").click();
    lab.window.step();
    assert!(!lab.state().player.is_playing);
}

/// K of tip 0 in steps 0 and 2, as if the solver had not found that of step 1.
fn with_factors() -> Dataset {
    let mut dataset = growing(3);
    for (k, step) in dataset.steps.iter_mut().enumerate().filter(|(k, _)| *k != 1) {
        let tip = TipId { crack: 0, end: End::Last };
        let (k1, k2) = (1.0 + k as f64, -0.25 * k as f64);
        step.intensities.push(TipIntensity::new(tip, k1, k2));
    }
    dataset
}

#[test]
fn curves_have_the_values_of_the_steps() {
    let dataset = with_factors();
    let plots = plots(&dataset);
    let curve = |name: &str| {
        let (_, plot) = plots.iter().find(|(known, _)| *known == name).expect("it is plotted");
        assert_eq!(plot.curves.len(), 1, "{name}");
        plot.curves[0].points.clone()
    };
    let factors = curve("K_I against the steps");
    assert_eq!((factors[0], factors[2]), ([0.0, 1.0], [2.0, 3.0]));
    assert!(factors[1][1].is_nan(), "the curve breaks where there is no value");
    assert_eq!(curve("K_II against the steps")[2], [2.0, -0.5]);
    // the length of a chain of segments, by hand
    let lengths = curve("Crack length against the steps");
    for (k, step) in dataset.steps.iter().enumerate() {
        let points = &step.cracks[0].points;
        let length: f64 = points.windows(2).map(|p| (p[1].x - p[0].x).hypot(p[1].y - p[0].y)).sum();
        assert!((lengths[k][1] - length).abs() < 1e-12);
    }
    assert_eq!(curve("Load against the steps"), [[0.0, 0.0], [1.0, 0.5], [2.0, 1.0]]);
}

#[test]
fn a_click_on_a_plot_goes_to_the_step() {
    let mut lab = Lab::new();
    lab.state().open(None, Arc::new(with_factors()));
    lab.state().session.drawer = Some(DrawerPage::Series);
    lab.settle();
    shot(&mut lab, "solving-series");
    let plot = lab.window.get_by_label("K_I against the steps").rect();
    for (part, expected) in [(0.3, 0), (0.6, 1), (0.95, 2)] {
        let at = egui::pos2(plot.left() + part * plot.width(), plot.center().y);
        lab.window.hover_at(at);
        lab.window.drag_at(at);
        lab.window.drop_at(at);
        lab.window.step();
        lab.settle();
        assert_eq!(step(&mut lab), Some(expected), "at {part} of the plot's width");
    }
}

/// The table has each tip of each step, with what it does next, and says why growth ends; a click
/// on a step goes there.
#[test]
fn a_table_of_the_steps_says_why_growth_ends() {
    let mut dataset = with_factors();
    for (k, step) in dataset.steps.iter_mut().enumerate() {
        let tip = TipId { crack: 0, end: End::Last };
        let fate = if k == 2 { TipStatus::MeetsHole(1) } else { TipStatus::Grows };
        let (length, extension) = (0.25, 0.5 * k as f64);
        let tip = TipIncrement { tip, fate, length, extension, ..TipIncrement::default() };
        let growth = step.growth.get_or_insert_default();
        growth.tips.push(tip);
        growth.stop = (k == 2).then_some(GrowthStop::NoTips);
    }
    let mut lab = Lab::new();
    lab.state().open(None, Arc::new(dataset.clone()));
    lab.state().session.drawer = Some(DrawerPage::Series);
    lab.settle();
    lab.window.get_by_label("Table").click();
    lab.settle();
    shot(&mut lab, "solving-series-table");
    lab.window.get_by_label("Growth ends with step 2: no tip is left.");
    lab.window.get_by_label("0.250000 at 0.00°, meets hole 1");
    lab.window.get_by_label("Go to step 1").click();
    lab.settle();
    assert_eq!(step(&mut lab), Some(1));
    let table = series_table::table(&dataset);
    let column = |name: &str| table.column(name).expect("it is there");
    assert_eq!(column("step"), [0.0, 1.0, 2.0]);
    assert_eq!(column("extension"), [0.0, 0.5, 1.0]);
    assert_eq!(column("crack_length")[1], dataset.steps[1].cracks[0].length());
    let k1 = column("k1");
    assert_eq!((k1[0], k1[1].is_nan(), k1[2]), (1.0, true, 3.0));
}

/// Where growth ends the reason stands at the end of the crack: at a tip that has met something in
/// an earlier step, and at one that is held in the last.
#[test]
fn ends_of_growth_are_labelled_on_the_plate() {
    let mut dataset = growing(3);
    let rows = [(1, End::Last, TipStatus::MeetsHole(4)), (1, End::Start, TipStatus::Grows)];
    for (k, end, fate) in rows.into_iter().chain([(2, End::Start, TipStatus::Held)]) {
        let tip = TipIncrement::staying(TipId { crack: 0, end }, fate);
        dataset.steps[k].growth.get_or_insert_default().tips.push(tip);
    }
    assert!(growth_ends(&dataset).is_empty(), "growth goes on");
    dataset.steps[2].growth.get_or_insert_default().stop = Some(GrowthStop::AllHeld);
    let crack = &dataset.steps[2].cracks[0];
    let expected = [(End::Last, "meets hole 4"), (End::Start, "held")];
    let expected = expected.map(|(end, words)| (crack.end_point(end), words.to_owned()));
    assert_eq!(growth_ends(&dataset), expected);
}

/// While one looks through the steps, all of them have one range: the smallest and the largest end
/// of their own ranges, which a step has again once it is asked for.
#[test]
fn the_steps_have_one_range() {
    let mut lab = series(4);
    lab.state().session.panes[0].scene.quantity = Some("uy".into());
    let ranges = |lab: &mut Lab, is_one: bool| {
        lab.state().session.panes[0].one_step_range = is_one;
        [0, 1, 2, 3].map(|step| {
            lab.state().session.panes[0].scene.subject.step = Some(step);
            lab.settle();
            lab.settle();
            lab.viewer().viewports[0].frames.newest().expect("an image").ends()
        })
    };
    let (all, own) = (ranges(&mut lab, false), ranges(&mut lab, true));
    assert!(all.iter().all(|range| *range == all[0]), "{all:?}");
    assert!(own.iter().skip(1).all(|range| *range != own[0]), "{own:?}");
    // coarser images find the shared range: their extrema are those of the same body
    let ends = [own.map(|range| range[0]), own.map(|range| range[1])];
    let shared = [ends[0].into_iter().fold(0.0, f64::min), ends[1].into_iter().fold(0.0, f64::max)];
    let size = shared[1] - shared[0];
    assert!((0..2).all(|k| (all[0][k] - shared[k]).abs() < 0.02 * size), "{all:?} {own:?}");
    // an image that is saved has the range that is seen, and so has its command
    lab.state().session.panes[0].one_step_range = false;
    lab.settle();
    let viewer = lab.viewer();
    let kind = (ExportChoice::Image, Motion::default());
    let order = viewer.viewports[0].export(&viewer.session.panes[0], kind, None);
    let command = order.expect("an image").command(Path::new("a.png")).expect("a command");
    assert!(command.contains("--range="), "{command}");
}

/// Values are read at a step; a constant load is no plot.
#[test]
fn values_of_a_step_are_read() {
    let mut dataset = with_factors();
    let all = plots(&dataset);
    assert_eq!(words(&all[0].1, 2), "step 2: K_I 3");
    assert_eq!(words(&all[0].1, 1), "step 1: no value");
    dataset.steps.iter_mut().for_each(|step| step.load = 2.0);
    let names: Vec<_> = plots(&dataset).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names.len() + 1, all.len(), "{names:?}");
    assert!(!names.contains(&"Load against the steps"));
}

/// No button of the player moves when the numbers of the step get longer or it plays.
#[test]
fn the_player_stands_still() {
    let mut lab = series(12);
    let names = ["Loop", "Step before", "Step after"];
    let places = |lab: &Lab, first: &str| {
        let names = [first].into_iter().chain(names);
        names.map(|name| lab.window.get_by_label(name).rect()).collect::<Vec<_>>()
    };
    lab.state().session.panes[0].scene.subject.step = Some(9);
    lab.settle();
    let before = places(&lab, "Play the steps");
    assert!(before.windows(2).all(|pair| pair[0].right() <= pair[1].left()), "{before:?}");
    lab.window.get_by_label("Step after").click();
    lab.settle();
    assert_eq!(places(&lab, "Play the steps"), before);
    lab.window.get_by_label("Play the steps").click();
    lab.window.run_steps(2);
    assert_eq!(places(&lab, "Stop"), before);
}

/// The solver's page: its numbers, a warning that leads to its place, values of patches as colours.
#[test]
fn what_the_solver_tells_is_shown() {
    let mut lab = Lab::new();
    let mut dataset = plate();
    let at = Some(vec2(0.5, 0.0));
    let message = "the faces overlap".to_owned();
    let kind = "faces-overlap".into();
    dataset.steps[0].warnings = vec![Warning { kind, at, value: 1.0, limit: 0.5, message }];
    dataset.steps[0].history.push(Record { name: "mood".into(), value: 7.25, unit: String::new() });
    lab.state().open(None, Arc::new(dataset));
    lab.state().session.drawer = Some(DrawerPage::Solver);
    lab.settle();
    shot(&mut lab, "solving-solver");
    lab.window.get_by_label("7.25");
    lab.window.get_by_label("Seconds of the phases");
    lab.window.get_by_label("level").click();
    lab.window.step();
    lab.settle();
    assert_eq!(lab.state().session.panes[0].scene.quantity.as_deref(), Some("level"));
    let frame = lab.window.state().viewports[0].frames.newest().cloned().expect("a picture");
    assert!(frame.shown.quantity().is_none(), "values of cells are shown");
    lab.window.get_by_label("⚠ the faces overlap").click();
    lab.window.step();
    let is_there = |viewer: &ppum_viewer::Viewer| {
        viewer.session.panes[0].place.is_some_and(|place| place.center == [0.5, 0.0])
    };
    lab.until("it flies there", is_there);
}

/// The page of an adaptation plots the estimated error of each step against its unknowns.
#[test]
fn the_history_of_an_adaptation_is_plotted() {
    let text = include_str!("../../../../examples/paper-adaptive-1.toml");
    let text = text.replace("[adaptivity]", "[adaptivity]\nkeep = \"all\"\nsteps = 2");
    let problem = Problem::parse(&text, "adaptive", Path::new(".")).expect("a problem");
    let dataset = solve(&problem, unwatched()).expect("solved");
    assert_eq!(dataset.steps.len(), 3);
    let all = solver::plots(&dataset, &dataset.steps[2]);
    let (name, plot) = &all[0];
    let points = &plot.curves[0].points;
    for (step, point) in dataset.steps.iter().zip(points) {
        assert_eq!(*point, [step.unknowns() as f64, step.record("estimated error").expect("told")]);
    }
    assert!(points.windows(2).all(|p| p[0][0] < p[1][0] && p[0][1] > p[1][1]), "{points:?}");
    let mut lab = Lab::new();
    lab.state().open(None, Arc::new(dataset));
    lab.state().session.drawer = Some(DrawerPage::Solver);
    lab.settle();
    lab.window.get_by_label(name);
    shot(&mut lab, "solving-adaptation");
    // growing cracks have none
    let dataset = growing(3);
    assert!(solver::plots(&dataset, &dataset.steps[0]).iter().all(|(other, _)| other != name));
}

/// In the smallest window that is promised every button of the player lies inside.
#[test]
fn the_player_has_room_in_a_small_window() {
    let mut lab = series(12);
    lab.window.set_size(egui::vec2(700.0, 500.0));
    lab.state().session.drawer = Some(DrawerPage::Series);
    lab.settle();
    lab.settle();
    shot(&mut lab, "solving-small");
    for name in ["Step before", "Step after", "Play the steps", "Loop", "Keys", "Undo"] {
        let rect = lab.window.get_by_label(name).rect();
        assert!(rect.left() >= 0.0 && rect.right() <= 700.0, "{name}: {rect:?}");
    }
}
