//! The modules of this crate and their imports.

use std::path::Path;

use ppum_testkit::rooms::{Floors, check, check_page};

const FLOORS: Floors<'_> = &[
    &[("parts", &[]), ("summation", &[]), ("view", &[])],
    &[("error", &["view"]), ("pixels", &["view"])],
    &[("raster", &["error", "summation", "view"])],
    &[
        ("reference", &["error", "parts", "raster", "view"]),
        ("scatter", &["error", "parts", "pixels", "raster", "summation", "view"]),
    ],
];

#[test]
fn arrows_lead_down() {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    check(&sources, FLOORS);
    check_page(&sources, env!("CARGO_PKG_NAME"), FLOORS);
}
