//! Pictures, figures and animations that are saved.

use std::path::Path;

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

use crate::kit::{plate, show_until};
use crate::lab::{Lab, shot};

/// A window with a plate that was read from a file, and the window for saving it.
fn asked(kind: &str) -> Lab {
    let mut lab = Lab::new();
    let path = lab.write("plate.h5", &plate());
    lab.open(&path);
    // few pixels: animations have many pictures
    lab.window.set_size(egui::vec2(640.0, 420.0));
    lab.settle();
    lab.window.key_press(Key::S);
    lab.window.run_steps(3);
    if kind != "Image" {
        lab.window.get_by_value("Image").click();
        lab.window.run_steps(3);
        lab.window.get_by_label(kind).click();
        lab.window.run_steps(3);
    }
    lab
}

fn named(lab: &mut Lab, path: &Path) {
    lab.window.get_by_role_and_label(egui::accesskit::Role::TextInput, "File").click();
    lab.window.step();
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    lab.window.step();
    lab.window
        .get_by_role_and_label(egui::accesskit::Role::TextInput, "File")
        .type_text(&path.display().to_string());
    lab.window.run_steps(3);
}

#[test]
fn the_name_is_written_next() {
    let mut lab = asked("Image");
    let before = lab.viewer().session.clone();
    // each of these letters would do something
    lab.window.event(egui::Event::Text("ifn".into()));
    for key in [Key::I, Key::F, Key::N] {
        lab.window.key_press(key);
    }
    lab.window.run_steps(3);
    assert_eq!(lab.viewer().session, before);
    let field = lab.window.get_by_role_and_label(egui::accesskit::Role::TextInput, "File");
    assert!(field.value().is_some_and(|name| name.contains("ifn")));
}

/// Saves it, and waits for what is told.
fn saved(lab: &mut Lab) -> bool {
    lab.window.get_by_label("Save file").click();
    lab.window.run_steps(3);
    show_until(&mut lab.window, "the writing ends", |window| {
        window.query_by_label("Stop").is_none()
    });
    lab.window.query_by_label_contains("Saved ").is_some()
}

fn pixels(path: &Path) -> ([u32; 2], Vec<u8>) {
    let file = std::io::BufReader::new(std::fs::File::open(path).expect("there"));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG file");
    let mut bytes = vec![0; reader.output_buffer_size().expect("it has a size")];
    let info = reader.next_frame(&mut bytes).expect("it is whole");
    bytes.truncate(info.buffer_size());
    ([info.width, info.height], bytes)
}

#[test]
fn a_picture_has_the_pixels_that_are_seen() {
    let mut lab = asked("Image");
    let path = lab.path("seen.png");
    named(&mut lab, &path);
    shot(&mut lab, "saving-picture");
    assert!(saved(&mut lab), "{:?}", lab.notes());
    let seen = lab.viewer().viewports[0].frames.newest().expect("a picture").colored.clone();
    let (size, bytes) = pixels(&path);
    assert_eq!(size, seen.image.size);
    let depth = bytes.len() / seen.image.rgba.len().div_ceil(4);
    let opaque = seen.image.rgba.chunks(4).zip(bytes.chunks(depth)).filter(|(a, _)| a[3] == 255);
    let (same, all) =
        opaque.fold((0, 0), |(n, all), (a, b)| (n + u32::from(a[..3] == b[..3]), all + 1));
    // over the colours there are cracks and tips
    assert!(all > 10_000 && f64::from(same) > 0.97 * f64::from(all), "{same} of {all}");
}

/// A figure has lines of cracks where the window shows them, and its command draws the same.
#[test]
fn a_figure_has_cracks_where_they_are_seen() {
    let strokes = |is_shown: bool| {
        let mut lab = asked("Figure");
        if !is_shown {
            lab.state().session.panes[0].scene.overlays.shown.clear();
            lab.settle();
        }
        let path = lab.path("cracks.svg");
        named(&mut lab, &path);
        lab.window.run_steps(3);
        let says_so = |node: egui_kittest::Node<'_>| {
            node.value().is_some_and(|text| text.contains("--no-cracks"))
        };
        let command = lab.window.query_all_by_role(egui::accesskit::Role::MultilineTextInput);
        assert_eq!(command.into_iter().any(says_so), !is_shown);
        assert!(saved(&mut lab));
        std::fs::read_to_string(&path).expect("there").matches("<path").count()
    };
    let [with, without] = [true, false].map(strokes);
    assert!(with > without, "{with} and {without}");
}

#[test]
fn figures_and_animations_are_what_their_names_say() {
    for (kind, name, magic) in [
        ("Figure", "a.svg", &b"<?xml"[..]),
        ("Figure", "a.pdf", b"%PDF"),
        ("Figure", "a.png", b"\x89PNG"),
        ("Animation of the deformation", "a.gif", b"GIF89a"),
    ] {
        let mut lab = asked(kind);
        let path = lab.path(name);
        named(&mut lab, &path);
        assert!(saved(&mut lab), "{kind} {name}");
        let bytes = std::fs::read(&path).expect("there");
        let start = &bytes[..magic.len()];
        assert!(start == magic || (magic == b"<?xml" && start.starts_with(b"<svg")), "{name}");
        assert!(bytes.len() > 2000, "{name}");
    }
}

/// A figure is a column of a journal wide and as high as its plate needs, its plot takes most of
/// it, and its file names no folder.
#[test]
fn a_figure_has_a_size_on_paper() {
    let mut lab = asked("Figure");
    let path = lab.path("column.png");
    named(&mut lab, &path);
    shot(&mut lab, "saving-figure");
    assert!(saved(&mut lab), "{:?}", lab.notes());
    let ([columns, rows], bytes) = pixels(&path);
    assert_eq!(columns, (8.6_f64 / 2.54 * 300.0).round() as u32);
    let depth = bytes.len() / (columns * rows) as usize;
    let row: Vec<_> =
        bytes.chunks(columns as usize * depth).nth(rows as usize / 3).expect("a row").to_vec();
    let is_colored = |pixel: &[u8]| {
        pixel[..3].iter().max() > pixel[..3].iter().min().map(|v| v.saturating_add(20)).as_ref()
    };
    let colored = row.chunks(depth).filter(|pixel| is_colored(pixel)).count();
    // the plate is a square: what is above and below its plot takes the rest
    assert!(
        colored as f64 > 0.6 * f64::from(columns) && f64::from(rows) > 1.2 * colored as f64,
        "{colored}"
    );
    let folder = lab.path("").display().to_string();
    let has = |bytes: &[u8], text: &str| bytes.windows(text.len()).any(|w| w == text.as_bytes());
    let file = std::fs::read(&path).expect("there");
    assert!(has(&file, "plate.h5") && !has(&file, folder.trim_end_matches('/')));
    // another form from the list, another unit
    lab.window.get_by_value("PNG").click();
    lab.window.run_steps(3);
    lab.window.get_by_label("PDF").click();
    lab.window.run_steps(3);
    lab.window.get_by_value("cm").click();
    lab.window.run_steps(3);
    lab.window.get_by_label("in").click();
    lab.window.run_steps(3);
    assert!(saved(&mut lab));
    let file = std::fs::read(path.with_extension("pdf")).expect("there");
    assert!(
        file.starts_with(b"%PDF")
            && has(&file, "von-mises")
            && !has(&file, folder.trim_end_matches('/'))
    );
    lab.window.get_by_value("in");
}

#[test]
fn another_file_is_replaced_when_it_is_asked_for_twice_and_the_dataset_never() {
    let mut lab = asked("Image");
    let path = lab.path("mine.png");
    std::fs::write(&path, "a picture of mine").expect("written");
    named(&mut lab, &path);
    assert!(!saved(&mut lab));
    lab.window.get_by_label_contains("save again to replace it");
    assert_eq!(std::fs::read(&path).expect("there"), b"a picture of mine");
    assert!(saved(&mut lab));
    let first = std::fs::read(&path).expect("there");
    assert!(first.starts_with(b"\x89PNG"));
    // what was written here is written again without a question
    assert!(saved(&mut lab));
    // the dataset under the name of a picture
    let (dataset, other) = (lab.path("plate.h5"), lab.path("plate.png"));
    let before = std::fs::read(&dataset).expect("there");
    std::fs::hard_link(&dataset, &other).expect("another name");
    named(&mut lab, &other);
    lab.window.get_by_label_contains("is the dataset itself");
    lab.window.get_by_label("Save file").click();
    lab.window.run_steps(3);
    assert!(lab.window.query_by_label("Stop").is_none());
    assert_eq!(std::fs::read(&other).expect("there"), before);
}

/// A page is written beside the dataset and holds what is seen; where there is none, the reason is
/// said.
#[test]
fn a_page_is_exported() {
    let mut lab = Lab::new();
    let path = lab.write("plate.h5", &plate());
    lab.open(&path);
    let export = |lab: &mut Lab| {
        lab.window.get_by_label("Save image").click();
        lab.window.run_steps(3);
        lab.window.get_by_label("Export page…").click();
        lab.window.run_steps(5);
    };
    lab.state().session.panes[0].scene.quantity = Some("hypot(ux, uy)".into());
    lab.settle();
    export(&mut lab);
    lab.window.key_press(Key::Enter);
    show_until(&mut lab.window, "the page is written", |window| {
        window.query_by_label_contains("plate.html is written").is_some()
    });
    let page = std::fs::read_to_string(path.with_extension("html")).expect("there");
    assert!(page.contains("<html") && page.contains("hypot(ux, uy)") && page.contains("plate.h5"));
    let subject = &mut lab.state().session.panes[0].scene.subject;
    subject.part = Some("smooth".into());
    lab.settle();
    export(&mut lab);
    assert!(lab.window.query_by_label_contains("no page is exported").is_some());
}
