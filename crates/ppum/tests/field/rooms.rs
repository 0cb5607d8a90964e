//! The rooms of this crate.

use std::path::Path;

use ppum_testkit::rooms::{Floors, check, check_page};

const FLOORS: Floors<'_> = &[
    &[("jet", &[]), ("library", &[]), ("morton", &[]), ("progress", &[]), ("vec2", &[])],
    &[
        ("box_tree", &["morton", "vec2"]),
        ("compensated", &["vec2"]),
        ("expression", &["vec2"]),
        ("segment", &["vec2"]),
        ("weight", &["jet", "library"]),
    ],
    &[("crack", &["compensated", "vec2"]), ("domain", &["compensated", "segment", "vec2"])],
    &[
        ("equation", &["domain", "expression", "vec2"]),
        ("function", &["crack", "jet", "library", "segment", "vec2"]),
        ("growth", &["crack", "vec2"]),
        ("sides", &["box_tree", "crack", "vec2"]),
        ("text", &["crack", "vec2"]),
    ],
    &[("dataset", &["crack", "domain", "equation", "function", "growth", "vec2", "weight"])],
    &[
        ("cover", &["dataset", "morton", "vec2", "weight"]),
        ("decompose", &["dataset", "function", "text"]),
        ("polynomial", &["dataset", "jet"]),
    ],
    &[
        (
            "field",
            &["box_tree", "crack", "dataset", "domain", "function", "jet", "polynomial", "vec2"],
        ),
        ("replace", &["dataset", "decompose", "function", "library", "text", "weight"]),
    ],
    &[(
        "quantity",
        &["crack", "dataset", "equation", "expression", "field", "jet", "library", "text", "vec2"],
    )],
    &[
        (
            "check",
            &["crack", "dataset", "domain", "function", "growth", "quantity", "vec2", "weight"],
        ),
        (
            "prelude",
            &[
                "cover", "crack", "dataset", "equation", "field", "function", "quantity", "vec2",
                "weight",
            ],
        ),
        (
            "sample",
            &[
                "box_tree",
                "compensated",
                "crack",
                "domain",
                "field",
                "jet",
                "progress",
                "quantity",
                "sides",
                "vec2",
            ],
        ),
    ],
];

#[test]
fn arrows_lead_down() {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    check(&sources, FLOORS);
    check_page(&sources, env!("CARGO_PKG_NAME"), FLOORS);
}
