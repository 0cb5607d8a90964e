//! The rooms of the crate.

use std::path::Path;

use ppum_testkit::rooms::{Floors, check, check_page};

const FLOORS: Floors<'_> = &[
    &[("errors", &[]), ("facts", &[]), ("owned", &[])],
    &[("pool", &["errors"]), ("values", &["owned"])],
    &[("watch", &["errors", "pool"])],
    &[("dataset", &["errors", "facts", "watch"])],
    &[
        ("field", &["dataset", "errors", "facts", "owned", "values", "watch"]),
        ("problem", &["dataset", "errors", "watch"]),
    ],
    &[("picture", &["errors", "field", "watch"])],
    &[
        ("compare", &["errors", "field", "picture", "watch"]),
        ("material", &["errors", "field", "picture", "watch"]),
        ("moving", &["dataset", "errors", "field", "picture", "watch"]),
        ("plot", &["dataset", "errors", "field", "picture", "watch"]),
    ],
];

#[test]
fn arrows_lead_down() {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    check(&sources, FLOORS);
    check_page(&sources, env!("CARGO_PKG_NAME"), FLOORS);
}
