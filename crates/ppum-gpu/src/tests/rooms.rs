//! The rooms of this crate.

use std::path::Path;

use ppum_testkit::rooms::{Floors, check, check_page};

const FLOORS: Floors<'_> = &[
    &[("choice", &[]), ("layout", &[])],
    &[("error", &["choice"])],
    &[("device", &["choice", "error"])],
    &[("scene", &["device", "error", "layout"])],
    &[("frame", &["error", "layout", "scene"])],
    &[("shader", &["error", "frame", "layout", "scene"])],
    &[("program", &["device", "error", "frame", "scene", "shader"])],
    &[(
        "renderer",
        &["choice", "device", "error", "frame", "layout", "program", "scene", "shader"],
    )],
];

#[test]
fn arrows_lead_down() {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    check(&sources, FLOORS);
    check_page(&sources, env!("CARGO_PKG_NAME"), FLOORS);
}
