//! The rooms of this crate.

use std::path::Path;

use ppum_testkit::rooms::{Floors, check};

const FLOORS: Floors<'_> = &[
    &[("choice", &[]), ("layout", &[])],
    &[("error", &["choice"])],
    &[("device", &["choice", "error"])],
    &[("scene", &["device", "error", "layout"])],
    &[("frame", &["layout", "scene"])],
    &[("shader", &["error", "frame", "layout", "scene"])],
    &[("program", &["device", "error", "frame", "scene", "shader"])],
    &[(
        "renderer",
        &["choice", "device", "error", "frame", "layout", "program", "scene", "shader"],
    )],
];

#[test]
fn arrows_lead_down() {
    check(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), FLOORS);
}
