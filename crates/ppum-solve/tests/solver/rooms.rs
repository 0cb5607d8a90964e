//! The rooms of this crate.

use std::path::Path;

use ppum_testkit::rooms::{Floors, check, check_page};

const FLOORS: Floors<'_> = &[
    &[("geometry", &[]), ("law", &[]), ("linear", &[]), ("quadrature", &[]), ("report", &[])],
    &[
        ("equilibrium", &["linear", "quadrature"]),
        ("problem", &["geometry"]),
        ("smoothness", &["geometry", "law", "quadrature"]),
        ("watched", &["geometry"]),
    ],
    &[("corner", &["geometry", "problem", "quadrature", "smoothness"])],
    &[("refine", &["corner", "geometry", "problem", "smoothness", "watched"])],
    &[(
        "space",
        &["corner", "geometry", "problem", "quadrature", "refine", "smoothness", "watched"],
    )],
    &[
        ("basis", &["corner", "linear", "quadrature", "space", "watched"]),
        ("intensity", &["geometry", "law", "problem", "quadrature", "space", "watched"]),
        ("norms", &["law", "space"]),
    ],
    &[
        (
            "assembly",
            &[
                "basis",
                "equilibrium",
                "geometry",
                "intensity",
                "law",
                "linear",
                "problem",
                "quadrature",
                "report",
                "smoothness",
                "space",
                "watched",
            ],
        ),
        (
            "diagnostics",
            &[
                "corner",
                "geometry",
                "intensity",
                "law",
                "norms",
                "problem",
                "refine",
                "report",
                "smoothness",
                "space",
                "watched",
            ],
        ),
    ],
    &[
        (
            "adapt",
            &[
                "assembly",
                "basis",
                "corner",
                "geometry",
                "law",
                "problem",
                "quadrature",
                "space",
                "watched",
            ],
        ),
        (
            "hierarchy",
            &[
                "assembly",
                "basis",
                "equilibrium",
                "law",
                "linear",
                "problem",
                "quadrature",
                "space",
                "watched",
            ],
        ),
    ],
    &[(
        "solve",
        &[
            "adapt",
            "assembly",
            "basis",
            "diagnostics",
            "equilibrium",
            "geometry",
            "hierarchy",
            "intensity",
            "law",
            "linear",
            "norms",
            "problem",
            "refine",
            "report",
            "space",
            "watched",
        ],
    )],
    &[("growth", &["problem", "solve"])],
];

#[test]
fn arrows_lead_down() {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    check(&sources, FLOORS);
    check_page(&sources, env!("CARGO_PKG_NAME"), FLOORS);
}
