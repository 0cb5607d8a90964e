//! The rooms of this crate.

use std::path::Path;

use ppum_testkit::rooms::{Floors, check, check_page};

const FLOORS: Floors<'_> = &[
    &[("limits", &[]), ("printable", &[]), ("real", &[]), ("spelling", &[])],
    &[
        ("elementary", &["real"]),
        ("error", &["limits", "printable", "spelling"]),
        ("table", &["real"]),
    ],
    &[("operation", &["elementary", "real"])],
    &[("graph", &["operation", "table"]), ("library", &["operation"])],
    &[
        ("language", &["error", "graph", "library", "limits", "operation", "table"]),
        ("program", &["graph", "table"]),
        ("reciprocal", &["graph", "operation"]),
    ],
    &[
        ("derivative", &["graph", "language", "limits", "operation"]),
        ("lanes", &["elementary", "graph", "operation", "program", "real", "table"]),
        ("print", &["graph", "language", "library", "operation", "program"]),
        ("wgsl", &["graph", "language", "operation", "program", "table"]),
    ],
    &[("formula", &["derivative", "error", "graph", "language", "print", "program"])],
    &[
        (
            "jets",
            &[
                "derivative",
                "formula",
                "graph",
                "lanes",
                "language",
                "program",
                "reciprocal",
                "wgsl",
            ],
        ),
        ("kinks", &["formula", "graph", "operation", "print", "program"]),
        ("substitute", &["derivative", "formula", "graph", "limits", "program"]),
    ],
    &[("block", &["jets", "lanes", "real"])],
];

#[test]
fn arrows_lead_down() {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    check(&sources, FLOORS);
    check_page(&sources, env!("CARGO_PKG_NAME"), FLOORS);
}
