//! FORMAT.md against the program.

use std::collections::BTreeSet;

use ppum::library::{EIGENSTRAIN, ELASTICITY, POISSON};

const PAGE: &str = include_str!("../../../../FORMAT.md");

/// Definitions of quantities as the page lists them, a name and a formula in a line.
#[test]
fn quantities_are_those_of_the_library() {
    let lines = PAGE.lines().filter_map(|line| line.strip_prefix("    ")?.split_once("  "));
    let on_page: BTreeSet<(&str, &str)> = lines
        .map(|(name, text)| (name, text.trim().split("   ").next().expect("a part")))
        .collect();
    for (name, text) in ELASTICITY.into_iter().chain(POISSON).chain(EIGENSTRAIN) {
        assert!(on_page.contains(&(name, text)), "{name}: {text}");
    }
}

#[test]
fn the_version_is_that_of_the_page() {
    let (major, minor) = ppum_format::FORMAT_VERSION;
    assert!(PAGE.starts_with(&format!("# The ppum dataset format, version {major}.{minor}\n")));
    assert!(PAGE.contains(&format!("minor version of this format: {major}, {minor}\n")));
}
