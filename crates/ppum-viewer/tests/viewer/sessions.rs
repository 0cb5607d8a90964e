//! Sessions as files: all that was chosen comes back.

use std::fs;
use std::path::Path;

use egui::{Key, Modifiers};
use ppum_render::range::RangeChoice;
use ppum_render::scale::Scale;
use ppum_scene::location::Location;
use ppum_scene::magnification::Magnification;
use ppum_scene::overlays::{IsolineLevels, Overlay};
use ppum_testkit::random::Random;
use ppum_testkit::skipped::skipped;
use ppum_viewer::files::session_file::{parse, text};
use ppum_viewer::offscreen::{ScreenshotError, screenshot};
use ppum_viewer::session::{
    DifferenceChoice, DrawerPage, Pane, ProblemDraft, Session, VisibleRegion, WindowTheme,
};
use ppum_viewer::window::WindowStart;

use crate::kit::plate;
use crate::lab::Lab;

/// Any finite number, the smallest and the largest too.
fn number(random: &mut Random) -> f64 {
    loop {
        let value = f64::from_bits(random.bits());
        if value.is_finite() {
            return value;
        }
    }
}

fn some<T>(random: &mut Random, value: impl FnOnce(&mut Random) -> T) -> Option<T> {
    (random.below(2) == 1).then(|| value(random))
}

fn words(random: &mut Random) -> String {
    let letters = ['a', 'σ', '"', '\\', '\n', ' ', '\u{7f}', '}', 'é', '\u{1f600}'];
    (0..random.below(12)).map(|_| random.pick(&letters)).collect()
}

fn range(random: &mut Random) -> RangeChoice {
    match random.below(4) {
        0 => RangeChoice::Auto,
        1 => RangeChoice::Full,
        2 => RangeChoice::Percentiles(random.between(0.0, 49.0), random.between(51.0, 100.0)),
        _ => {
            let from = random.between(-1e9, 1e9);
            RangeChoice::Fixed(from, from + random.between(1e-3, 1e12))
        }
    }
}

fn pane(random: &mut Random) -> Pane {
    let mut pane = Pane::default();
    let scene = &mut pane.scene;
    scene.subject.step = some(random, |r| r.below(1000));
    scene.subject.part = some(random, words);
    scene.subject.functions =
        (0..random.below(3)).map(|_| (words(random), words(random))).collect();
    scene.subject.weight = some(random, words);
    scene.quantity = some(random, words);
    scene.colors.colormap = some(random, words);
    scene.colors.range = range(random);
    scene.colors.scale = random.pick(&[Scale::Linear, Scale::Log, Scale::SymLog]);
    scene.colors.contrast = random.below(2) == 1;
    scene.colors.bands = some(random, |r| r.below(65_536) as u16);
    scene.overlays.shown = Overlay::ALL.into_iter().filter(|_| random.below(2) == 1).collect();
    scene.overlays.no_cracks = random.below(2) == 1;
    scene.overlays.isolines = some(random, |r| match r.below(3) {
        0 => IsolineLevels::Auto,
        1 => IsolineLevels::Count(1 + r.below(50)),
        _ => IsolineLevels::At((0..3).map(|k| f64::from(k) + r.unit()).collect()),
    });
    scene.overlays.level_labels = random.below(2) == 1;
    scene.overlays.arrows = some(random, number);
    scene.deformed = some(random, |r| {
        if r.below(2) == 1 {
            Magnification::Auto
        } else {
            Magnification::Given(r.between(0.0, 1e6))
        }
    });
    scene.outline = random.below(2) == 1;
    pane.place =
        some(random, |r| VisibleRegion { center: [number(r), number(r)], width: number(r) });
    pane.extrema = random.below(2) == 1;
    let spot = |r: &mut Random| Location {
        anchor: [number(r), number(r)],
        offset: [number(r), number(r)],
        on: some(r, |r| [r.below(9) as u32, r.below(9) as u32]),
    };
    pane.probes = (0..random.below(3)).map(|_| spot(random)).collect();
    pane.file = some(random, |r| format!("/data/{}.h5", r.below(9)).into());
    pane
}

fn session(random: &mut Random) -> Session {
    let panes: Vec<Pane> = (0..=random.below(2)).map(|_| pane(random)).collect();
    let two = panes.len() == 2;
    let draft = |r: &mut Random| ProblemDraft {
        path: some(r, |r| format!("/data/deep/{}.toml", r.below(9)).into()),
        folder: some(r, |_| "/elsewhere".into()),
        text: words(r),
        original: some(r, words),
    };
    Session {
        active: random.below(panes.len()),
        panes,
        linked: random.below(2) == 1,
        minus: DifferenceChoice {
            is_shown: two && random.below(2) == 1,
            colors: pane(random).scene.colors,
        },
        panels: random.below(2) == 1,
        drawer: some(random, |r| {
            r.pick(&[DrawerPage::Plot, DrawerPage::Series, DrawerPage::Problem])
        }),
        theme: random.pick(&[WindowTheme::System, WindowTheme::Light, WindowTheme::Dark]),
        draft: some(random, draft),
    }
}

/// Every bit of every number, every letter; wherever the folder lies.
#[test]
fn any_session_comes_back_from_its_text() {
    let mut random = Random(15);
    for count in 0..400 {
        let session = session(&mut random);
        for folder in ["/data", "/data/deep", "/elsewhere", "/"] {
            let text = text(&session, Path::new(folder)).expect("it has a text");
            let back = parse(&text, Path::new(folder)).expect("it is a session");
            assert_eq!(back, session, "{count} {folder}\n{text}");
        }
    }
}

/// What no file can say is left, and all else is kept.
#[test]
fn a_number_that_is_none_costs_no_session() {
    let mut session = Session::default();
    session.panes[0].place = Some(VisibleRegion { center: [0.0, f64::NAN], width: 1.0 });
    session.panes[0].scene.quantity = Some("syy".into());
    session.panes[0].scene.colors.range = RangeChoice::Fixed(2.0, 1.0);
    session.panes[0].probes = vec![Location { anchor: [f64::NAN; 2], ..Location::default() }];
    let text = text(&session, Path::new("/")).expect("it has a text");
    let back = parse(&text, Path::new("/")).expect("it is a session");
    assert_eq!(back.panes[0].probes, []);
    assert_eq!((back.panes[0].place, back.panes[0].scene.colors.range), (None, RangeChoice::Auto));
    assert_eq!(back.panes[0].scene.quantity.as_deref(), Some("syy"));
}

#[test]
fn other_texts_are_refused_with_a_reason() {
    for (wrong, reason) in [
        ("", "no session"),
        ("{}", "ppum-session"),
        ("[1]", "no session"),
        ("{\"ppum-session\": 99, \"panes\": []}", "newer"),
        ("{\"ppum-session\": 1, \"panes\": 7}", "no session"),
        ("{\"ppum-session\": \"1\"}", "no session"),
    ] {
        let error = parse(wrong, Path::new("/")).expect_err(wrong).to_string();
        assert!(error.contains(reason), "{wrong}: {error}");
    }
    // what a file may say and a window cannot show is mended
    let none = parse("{\"ppum-session\": 1, \"panes\": [], \"active\": 7}", Path::new("/"));
    let none = none.expect("a session");
    assert_eq!((none.panes.len(), none.active), (1, 0));
}

/// Saved by a key, moved with its dataset to another folder, opened there.
#[test]
fn a_saved_session_opens_where_it_lies_with_its_files() {
    let mut lab = Lab::new();
    fs::create_dir(lab.path("here")).expect("a folder");
    let path = lab.write("here/plate.h5", &plate());
    lab.open(&path);
    let place = Some(VisibleRegion { center: [0.5, 1e-13], width: 1.234_567_890_123_456_7e-12 });
    lab.state().session.panes[0].place = place;
    lab.state().session.panes[0].scene.quantity = Some("sxx".into());
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::S);
    lab.window.step();
    lab.window.step();
    // the name that is proposed stands beside the dataset
    lab.window.key_press(Key::Enter);
    lab.window.step();
    lab.settle();
    let saved = lab.path("here/plate.ppum-session");
    assert_eq!(lab.viewer().files.session, Some(saved.clone()), "{}", lab.notes());
    assert!(!fs::read_to_string(&saved).expect("there").contains("here"), "names are relative");
    let before = lab.state().session.clone();

    fs::rename(lab.path("here"), lab.path("there")).expect("moved");
    let there = lab.path("there");
    lab.reopen(WindowStart {
        files: vec![there.join("plate.ppum-session")],
        ..WindowStart::default()
    });
    let mut expected = before;
    expected.panes[0].file = Some(there.join("plate.h5"));
    assert_eq!(lab.viewer().session, expected, "{}", lab.notes());
    assert_eq!(*lab.dataset(0).expect("it is open"), plate());

    // without its dataset: told, and everything else is there
    fs::remove_file(there.join("plate.h5")).expect("removed");
    lab.reopen(WindowStart {
        files: vec![there.join("plate.ppum-session")],
        ..WindowStart::default()
    });
    assert!(lab.notes().contains("plate.h5 of the session cannot be read"), "{}", lab.notes());
    assert!(lab.dataset(0).is_none());
    assert_eq!(lab.state().session, expected);
    // and once it is there again it is shown
    lab.write("there/plate.h5", &plate());
    lab.until("it is read", |viewer| viewer.viewports[0].opened.is_some());
    assert_eq!(lab.state().session, expected);
    assert_eq!(lab.notes(), "");
}

#[test]
fn the_window_reopens_as_it_was() {
    let mut lab = Lab::new();
    let path = lab.write("plate.h5", &plate());
    lab.open(&path);
    lab.state().session.panes[0].scene.quantity = Some("sxy".into());
    lab.state().session.theme = WindowTheme::Dark;
    lab.state().session.draft =
        Some(ProblemDraft { text: "title = \"σ\"".into(), ..ProblemDraft::default() });
    lab.settle();
    let before = lab.state().session.clone();
    lab.reopen(WindowStart::default());
    assert_eq!(lab.state().session, before);
    assert!(lab.dataset(0).is_some());
    // with a file of its own it has the looks alone
    let other = lab.write("other.h5", &plate());
    lab.reopen(WindowStart { files: vec![other.clone()], ..WindowStart::default() });
    assert_eq!(lab.state().session.theme, WindowTheme::Dark);
    assert_eq!(lab.state().session.panes[0].file, Some(other));
    assert_eq!(lab.state().session.panes[0].scene.quantity, None);
}

/// A session in a file, which has two values of a pane.
fn written(lab: &Lab, name: &str, file: &str, rest: &str) -> std::path::PathBuf {
    let path = lab.path(name);
    let text =
        format!(r#"{{"ppum-session": 1, "panels": false, "panes": [{{"file": "{file}"{rest}}}]}}"#);
    fs::write(&path, text).expect("written");
    path
}

/// Files of another kind than is meant: a session within itself would be read for ever.
#[test]
fn a_session_names_datasets_alone() {
    let mut lab = Lab::new();
    lab.write("plate.h5", &plate());
    fs::write(lab.path("plate.toml"), "title = \"none\"\n").expect("written");
    written(&lab, "other.ppum-session", "plate.h5", "");
    for (file, is) in [
        ("itself.ppum-session", "a session"),
        ("other.ppum-session", "a session"),
        ("plate.toml", "the text of a problem"),
    ] {
        let path = written(&lab, "itself.ppum-session", file, "");
        lab.reopen(WindowStart { files: vec![path.clone()], ..WindowStart::default() });
        let told = format!("it is {is}, where a dataset should be");
        assert!(lab.notes().contains(&told), "{file}: {}", lab.notes());
        assert!(lab.notes().contains(&lab.path(file).display().to_string()), "{}", lab.notes());
        assert!(lab.dataset(0).is_none() && lab.viewer().session.draft.is_none());
        refused(WindowStart { files: vec![path], ..WindowStart::default() }, &told);
    }
    let draft = Some(ProblemDraft { path: Some("plate.h5".into()), ..ProblemDraft::default() });
    let session = Session { draft, ..Session::default() };
    let path = lab.path("draft.ppum-session");
    fs::write(&path, text(&session, lab.folder.path()).expect("a text")).expect("written");
    lab.reopen(WindowStart { files: vec![path], ..WindowStart::default() });
    assert!(lab.notes().contains("it is a dataset, where a problem"), "{}", lab.notes());
    assert!(lab.dataset(0).is_none());
}

/// There is no picture of a window that does not show what was chosen.
fn refused(start: WindowStart, reason: &str) {
    match screenshot(start) {
        Err(ScreenshotError::NoDriver(words)) => skipped(&words),
        Err(error) => assert!(error.to_string().contains(reason), "{error}"),
        Ok(_) => panic!("a picture where there should be: {reason}"),
    }
}

/// Whatever place a session names, a plate is seen, and F shows all of it.
#[test]
fn places_that_nothing_can_show_are_the_whole_plate() {
    let mut lab = Lab::new();
    lab.write("plate.h5", &plate());
    for place in [
        r#""center": [0, 0], "width": 0"#,
        r#""center": [0, 0], "width": -1"#,
        r#""center": [0, 0], "width": 1e-300"#,
        r#""center": [0, 0], "width": 1e308"#,
        r#""center": [1e308, -1e308], "width": 1"#,
        r#""center": [1e9, 0], "width": 1"#,
    ] {
        let rest = format!(r#", "place": {{{place}}}"#);
        let path = written(&lab, "a.ppum-session", "plate.h5", &rest);
        lab.reopen(WindowStart { files: vec![path], ..WindowStart::default() });
        assert_eq!(lab.viewer().session.panes[0].place, None, "{place}");
        assert!(lab.notes().contains("the whole plate is"), "{place}: {}", lab.notes());
        let is_final = |lab: &Lab| lab.viewer().viewports[0].frames.newest().map(|f| f.is_final);
        assert_eq!(is_final(&lab), Some(true), "{place}");
    }
    lab.window.set_size(egui::vec2(600.0, 400.0));
    for (center, width) in [
        ([0.0; 2], 0.0),
        ([0.0; 2], f64::NAN),
        ([0.0; 2], 1e-300),
        ([0.0; 2], 1e308),
        ([f64::INFINITY, 0.0], 1.0),
        ([1e300; 2], 1e-3),
    ] {
        lab.state().session.panes[0].place = Some(VisibleRegion { center, width });
        lab.settle();
        lab.window.key_press(Key::F);
        lab.window.step();
        lab.until("all of it is shown", |viewer| viewer.session.panes[0].place.is_none());
        lab.settle();
        let viewport = &lab.viewer().viewports[0];
        assert!(viewport.camera.view.is_some_and(|view| view.width > 1.0 && view.width < 10.0));
    }
}

/// Colours, quantities, functions and parts that are not there: the window shows the plate without
/// and tells it, a picture of it is refused.
#[test]
fn what_a_session_asks_in_vain_is_told() {
    let mut lab = Lab::new();
    lab.write("plate.h5", &plate());
    for (scene, reason) in [
        (r#""quantity": "nonsense""#, "nonsense cannot be shown"),
        (r#""colors": {"colormap": "nonsense"}"#, "the colours cannot be those chosen"),
        (r#""subject": {"part": "nonsense"}"#, "what was replaced cannot be"),
        (r#""subject": {"weight": "nonsense("}"#, "what was replaced cannot be"),
    ] {
        let rest = format!(r#", "scene": {{{scene}}}"#);
        let path = written(&lab, "a.ppum-session", "plate.h5", &rest);
        lab.reopen(WindowStart { files: vec![path.clone()], ..WindowStart::default() });
        assert!(lab.notes().contains(reason), "{scene}: {}", lab.notes());
        let viewport = &lab.viewer().viewports[0];
        assert!(
            viewport.frames.newest().is_some() && viewport.frames.failure().is_none(),
            "{scene}"
        );
        refused(WindowStart { files: vec![path], ..WindowStart::default() }, reason);
    }
}
