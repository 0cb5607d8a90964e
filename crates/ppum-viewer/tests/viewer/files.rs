//! Files that are opened, broken, replaced, gone, remembered.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use ppum_viewer::files::window_state::WindowState;
use ppum_viewer::files::{SavedFile, examples};
use ppum_viewer::session::{Session, VisibleRegion};

use crate::kit::{plate, show_until};
use crate::lab::{Lab, shot};

fn named(title: &str) -> ppum::dataset::Dataset {
    let mut dataset = plate();
    dataset.title = title.into();
    dataset
}

/// Each example has a drawing, a title and a line, and a click solves it.
#[test]
fn the_start_page_shows_the_examples() {
    let mut lab = Lab::new();
    lab.window.set_size(egui::vec2(800.0, 600.0));
    lab.settle();
    show_until(&mut lab.window, "the examples are drawn", |window| {
        (0..examples::ALL.len()).all(|number| window.state().files.previews.of(number).is_some())
    });
    shot(&mut lab, "files-start");
    let tile = |title: &str| lab.window.get_by_role_and_label(Role::Button, title).rect();
    let tiles: Vec<_> = examples::ALL[..4].iter().map(|example| tile(example.title())).collect();
    for (k, tile) in tiles.iter().enumerate() {
        assert!(tile.left() >= 0.0 && tile.right() <= 800.0, "{tile:?}");
        assert!(tiles[..k].iter().all(|other| !other.intersects(*tile)), "{tiles:?}");
    }
}

#[test]
fn a_name_that_is_written_is_opened_and_remembered() {
    let mut lab = Lab::new();
    let path = lab.write("plate.h5", &named("First"));
    lab.window.get_by_label("Open a file…");
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::O);
    lab.window.step();
    lab.window.step();
    let field = "Name of the file, with its folder";
    lab.window.get_by_label(field);
    // instead of what the field begins with
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    lab.window.step();
    lab.window.event(egui::Event::Text(path.display().to_string()));
    lab.window.step();
    lab.window.key_press(Key::Enter);
    lab.window.step();
    lab.settle();
    assert_eq!(lab.dataset(0).expect("it is open").title, "First");
    assert!(lab.window.query_by_label(field).is_none(), "{}", lab.notes());
    let kept = WindowState::read(&lab.path("config"));
    assert_eq!(kept.recent, [path]);
    lab.window.get_by_label("Plate");
}

/// Tab completes a name, and what is written next goes to its end.
#[test]
fn a_name_is_completed_and_written_on() {
    let mut lab = Lab::new();
    lab.write("plate.h5", &named("First"));
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::O);
    lab.window.run_steps(2);
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    lab.window.step();
    let begun = lab.path("pla").display().to_string();
    lab.window.event(egui::Event::Text(begun));
    show_until(&mut lab.window, "the folder is listed", |window| {
        window.query_by_label("plate.h5").is_some()
    });
    lab.window.key_press(Key::Tab);
    lab.window.run_steps(2);
    lab.window.event(egui::Event::Text("X".into()));
    lab.window.run_steps(2);
    let shown = lab.window.get_by_label("Name of the file, with its folder").value();
    assert_eq!(shown, Some(lab.path("plate.h5X").display().to_string()));
}

#[test]
fn what_is_not_there_is_told_at_the_name() {
    let mut lab = Lab::new();
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::O);
    lab.window.step();
    lab.window.step();
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    lab.window.step();
    lab.window.event(egui::Event::Text("/nowhere/at/all.h5".into()));
    lab.window.step();
    lab.window.key_press(Key::Enter);
    lab.window.step();
    lab.window.step();
    shot(&mut lab, "solving-dialog");
    lab.window.get_by_label("there is no such file");
    lab.window.key_press(Key::Escape);
    lab.window.step();
    lab.window.step();
    assert!(lab.window.query_by_label("there is no such file").is_none());
}

#[test]
fn a_bad_file_is_told_and_harms_nothing() {
    let mut lab = Lab::new();
    let good = lab.write("good.h5", &named("Good"));
    lab.open(&good);
    let before = lab.dataset(0).expect("it is open");
    let whole = fs::read(&good).expect("it was written");
    let recent = lab.state().files.kept.recent.clone();
    for (name, bytes) in [
        ("half.h5", &whole[..whole.len() / 2]),
        ("empty.h5", &[]),
        ("words.h5", b"no dataset".as_slice()),
        ("bytes", &[0xff, 0xfe, 0x00]),
        ("foreign.ppum-session", b"{\"panes\": 3}"),
    ] {
        let path = lab.path(name);
        fs::write(&path, bytes).expect("written");
        lab.open(&path);
        let note = lab.notes();
        assert!(note.contains(&format!("{name} cannot be read: ")), "{name}: {note}");
        assert!(Arc::ptr_eq(&before, &lab.dataset(0).expect("it stays")), "{name}");
        assert_eq!(lab.state().files.kept.recent, recent, "{name}");
        lab.window.get_by_label("Close the note").click();
        lab.window.step();
        lab.window.step();
        assert_eq!(lab.notes(), "");
    }
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("it is read by its path".into())
    }
}

#[test]
fn two_files_that_are_dropped_stand_side_by_side() {
    let mut lab = Lab::new();
    let paths = ["a", "b"].map(|name| lab.write(&format!("{name}.h5"), &named(name)));
    let handle = |path: &PathBuf| Arc::new(Dropped(path.clone())) as egui::DroppedFileHandle;
    lab.window.input_mut().dropped_files = paths.iter().map(handle).collect();
    lab.window.step();
    lab.settle();
    let titles = [0, 1].map(|pane| lab.dataset(pane).expect("it is open").title.clone());
    assert_eq!(titles, ["a", "b"]);
    let files: Vec<_> = lab.state().session.panes.iter().map(|pane| pane.file.clone()).collect();
    assert_eq!(files, paths.map(Some));
}

/// Replaced, broken, gone and back again: the view stays, and so does the last dataset that could
/// be read.
#[test]
fn an_open_file_is_watched() {
    let mut lab = Lab::new();
    let path = lab.write("plate.h5", &named("First"));
    lab.open(&path);
    let place = Some(VisibleRegion { center: [0.5, 0.0], width: 1e-3 });
    lab.state().session.panes[0].place = place;
    lab.state().session.panes[0].scene.quantity = Some("syy".into());
    lab.write("plate.h5", &named("Second"));
    lab.until("the new file is read", |viewer| title(viewer) == "Second");
    assert_eq!(lab.state().session.panes[0].place, place);
    assert_eq!(lab.state().session.panes[0].scene.quantity.as_deref(), Some("syy"));
    assert_eq!(lab.notes(), "");

    fs::write(&path, "broken").expect("written");
    lab.until("a broken file is told", |viewer| !viewer.files.notes.is_empty());
    assert!(lab.notes().contains("plate.h5 has changed and cannot be read: "), "{}", lab.notes());
    assert!(lab.notes().contains("Save the dataset"), "{}", lab.notes());
    assert_eq!(title(lab.window.state()), "Second");

    fs::remove_file(&path).expect("removed");
    lab.until("that it is gone is told", |viewer| {
        viewer.files.notes.iter().any(|note| note.text.contains("no longer there"))
    });
    assert_eq!(title(lab.window.state()), "Second");

    lab.write("plate.h5", &named("Third"));
    lab.until("it is back", |viewer| title(viewer) == "Third");
    assert_eq!((lab.notes().as_str(), lab.state().session.panes[0].place), ("", place));
}

fn title(viewer: &ppum_viewer::Viewer) -> String {
    viewer.viewports[0]
        .opened
        .as_ref()
        .map(|opened| opened.dataset.title.clone())
        .unwrap_or_default()
}

/// A series that has lost steps: the step that was looked at is gone, and the last one is shown.
#[test]
fn a_shorter_series_is_shown_to_its_end() {
    let mut lab = Lab::new();
    let path = lab.write("series.h5", &ppum_testkit::synthetic::growing(4));
    lab.open(&path);
    lab.state().session.panes[0].scene.subject.step = Some(3);
    lab.settle();
    lab.write("series.h5", &ppum_testkit::synthetic::growing(2));
    let steps = |viewer: &ppum_viewer::Viewer| {
        viewer.viewports[0].opened.as_ref().map(|opened| opened.dataset.steps.len())
    };
    lab.until("it is read", |viewer| steps(viewer) == Some(2));
    lab.settle();
    assert_eq!(lab.state().session.panes[0].scene.subject.step, None);
    assert!(lab.notes().contains("there is no step 3"), "{}", lab.notes());
    assert_eq!(lab.window.state().viewports[0].frames.failure(), None);
}

#[test]
fn a_dataset_is_saved_and_read_back() {
    let mut lab = Lab::new();
    let dataset = Arc::new(named("Solved"));
    lab.state().open(None, Arc::clone(&dataset));
    let path = lab.path("saved.h5");
    lab.state().files.save(path.clone(), SavedFile::Dataset(dataset), &Session::default());
    lab.settle();
    assert_eq!(lab.state().session.panes[0].file, Some(path.clone()));
    assert_eq!(ppum_format::read(&path).expect("a dataset"), *lab.dataset(0).expect("open"));
    // into a folder that is not there
    let nowhere = lab.path("nowhere/saved.h5");
    let dataset = lab.dataset(0).expect("open");
    lab.state().files.save(nowhere, SavedFile::Dataset(dataset), &Session::default());
    lab.settle();
    assert!(lab.notes().contains("cannot be written"), "{}", lab.notes());
    assert_eq!(lab.state().session.panes[0].file, Some(path));
}

/// The last session's size and recent files, and the same again from damaged ones.
#[test]
fn damaged_settings_harm_nothing() {
    let mut lab = Lab::new();
    let path = lab.write("plate.h5", &named("First"));
    lab.open(&path);
    lab.state().leave();
    let config = lab.path("config");
    for text in ["", "{", "null", "[]", "{\"recent\": 3}", "{\"size\": [1e300, -1.0]}", "\u{0}"] {
        fs::write(config.join("window.json"), text).expect("written");
        fs::write(config.join("last.ppum-session"), text).expect("written");
        let kept = WindowState::read(&config);
        assert_eq!(kept, WindowState::default(), "{text}");
        let start = ppum_viewer::window::WindowStart::default();
        let start = ppum_viewer::window::WindowStart { folder: Some(config.clone()), ..start };
        let viewer = start.viewer(&egui::Context::default());
        assert_eq!(viewer.session, ppum_viewer::session::Session::default(), "{text}");
        assert!(
            viewer.files.notes.iter().all(|note| note.text.contains("cannot be read")),
            "{text}"
        );
    }
    // a newer program may read them, and the session of today takes their name
    let aside = fs::read(config.join("unreadable-2.ppum-session")).expect("it is kept");
    assert_eq!(aside, b"{");
}

/// A plate of another size with another equation, solved coarsely.
fn other() -> ppum::dataset::Dataset {
    let text = include_str!("../../../../examples/poisson-slit.toml");
    let text =
        text.replace("level = 4", "level = 2").replace("max = [1.0, 1.0]", "max = [1.0, 2.0]");
    let problem = ppum_problem::Problem::parse(&text, "slit", Path::new("."));
    let problem = problem.expect("it is a problem");
    let solved = ppum_fracture::solve::solve(&problem, ppum::progress::unwatched());
    solved.expect("it can be solved")
}

/// A picture of one dataset never stands for another one: neither while that is drawn, nor where it
/// cannot be.
#[test]
fn a_file_that_has_become_another_plate_is_shown_as_that() {
    for quantity in ["syy + sxx*2", "uy"] {
        let mut lab = Lab::new();
        let path = lab.write("plate.h5", &named("First"));
        lab.open(&path);
        let pane = &mut lab.state().session.panes[0];
        pane.scene.quantity = Some(quantity.into());
        pane.scene.deformed = Some(ppum_scene::magnification::Magnification::Auto);
        pane.place = Some(VisibleRegion { center: [0.5, 0.0], width: 1e-3 });
        lab.settle();
        let slit = other();
        let name = slit.title.clone();
        lab.write("plate.h5", &slit);
        lab.until("it is read and drawn", |viewer| {
            let viewport = &viewer.viewports[0];
            let newest = viewport.frames.newest();
            let is_new = title(viewer) == name;
            if let Some(frame) = newest.filter(|_| is_new) {
                assert_eq!(frame.request.dataset.title, name, "{quantity}");
            }
            is_new && newest.is_some() && !viewer.is_working()
        });
        lab.settle();
        let viewer = lab.viewer();
        assert_eq!(viewer.viewports[0].frames.failure(), None);
        let pane = &viewer.session.panes[0];
        let scene = &pane.scene;
        assert_eq!(
            (&scene.quantity, scene.deformed, pane.place),
            (&None, None, None),
            "{quantity}"
        );
        let told = format!("plate.h5: {quantity} cannot be shown: ");
        assert!(lab.notes().contains(&told), "{}", lab.notes());
        assert!(lab.notes().contains("cannot be deformed"), "{}", lab.notes());
        let other = format!("another body is in this file now, “{name}”");
        assert!(lab.notes().contains(&other), "{}", lab.notes());
    }
}

/// The same plate, whose file no longer names what is looked at: that is told, and can be had back.
#[test]
fn a_quantity_that_a_file_no_longer_has_is_left() {
    let mut lab = Lab::new();
    let mut first = named("First");
    let (name, text, unit) = ("mine".into(), "sxx - syy".into(), String::new());
    first.quantities.push(ppum::dataset::NamedQuantity { name, text, unit });
    let path = lab.write("plate.h5", &first);
    lab.open(&path);
    lab.state().session.panes[0].scene.quantity = Some("mine".into());
    lab.state().session.panes[0].scene.colors.colormap = Some("cividis".into());
    lab.settle();
    assert_eq!(lab.viewer().viewports[0].frames.failure(), None);
    let place = Some(VisibleRegion { center: [0.5, 0.0], width: 1e-3 });
    lab.state().session.panes[0].place = place;
    lab.write("plate.h5", &named("Second"));
    lab.until("the new file is read", |viewer| title(viewer) == "Second");
    lab.settle();
    let (viewport, pane) = (&lab.viewer().viewports[0], &lab.viewer().session.panes[0]);
    let frame = viewport.frames.newest().expect("a picture");
    assert_eq!((frame.request.dataset.title.as_str(), viewport.frames.failure()), ("Second", None));
    assert_eq!((&pane.scene.quantity, pane.place), (&None, place));
    assert_eq!(pane.scene.colors.colormap.as_deref(), Some("cividis"));
    assert!(lab.notes().contains("mine cannot be shown: "), "{}", lab.notes());
    // a mistake in what is written now leaves the picture of the same dataset
    lab.state().session.panes[0].scene.quantity = Some("nonsense".into());
    lab.settle();
    let viewport = &lab.viewer().viewports[0];
    assert!(viewport.frames.failure().is_some() && viewport.frames.newest().is_some());
}

/// A folder that cannot be written is told once, not never and not always.
#[test]
fn what_cannot_be_remembered_is_told_once() {
    let mut lab = Lab::with(|folder| {
        fs::write(folder.join("config"), "no folder").expect("written");
        ppum_viewer::window::WindowStart::default()
    });
    let path = lab.write("plate.h5", &named("First"));
    lab.open(&path);
    lab.until("it is told", |viewer| !viewer.files.notes.is_empty());
    assert!(lab.notes().contains("cannot be kept in "), "{}", lab.notes());
    lab.window.get_by_label("Close the note").click();
    lab.window.run_steps(2);
    lab.state().files.remember(&path);
    lab.settle();
    assert_eq!(lab.notes(), "");
}
