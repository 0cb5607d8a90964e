//! Modules import in one direction: none needs itself by way of others, files inside
//! modules included.

use crate::sources::{Imports, circles, imports};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The circles that are left, of each crate as it may be, by their first modules and sizes. What
/// ends one of them strikes its line; new ones are refused.
const LEFT: &[(&str, &str, usize)] = &[];

fn circles_by_crate() -> BTreeMap<String, BTreeSet<BTreeSet<String>>> {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folders = std::fs::read_dir(crates).expect("a folder of crates");
    let of = |folder: &Path| circles(&imports(&folder.join("src")));
    folders
        .map(|folder| folder.expect("an entry").path())
        .map(|folder| {
            (folder.file_name().expect("a name").to_string_lossy().into_owned(), of(&folder))
        })
        .collect()
}

#[test]
fn modules_import_in_one_direction() {
    let found = circles_by_crate();
    let lines =
        found.iter().flat_map(|(name, circles)| circles.iter().map(move |circle| (name, circle)));
    let found: BTreeSet<_> = lines
        .map(|(name, circle)| {
            (name.as_str(), circle.first().expect("a module").as_str(), circle.len())
        })
        .collect();
    let left: BTreeSet<_> = LEFT.iter().copied().collect();
    let new: Vec<_> = found.difference(&left).collect();
    assert!(new.is_empty(), "modules that need each other: {new:#?}");
    let gone: Vec<_> = left.difference(&found).collect();
    assert!(gone.is_empty(), "these circles are gone, strike them: {gone:#?}");
}

#[test]
fn a_circle_is_found() {
    let module = |names: &str| names.split("::").map(str::to_owned).collect::<Vec<_>>();
    let arrows = [("a", "b"), ("b", "b::c"), ("b::c", "a"), ("d", "a")];
    let mut imports = Imports::new();
    for (from, to) in arrows {
        imports.entry(module(from)).or_default().insert(module(to));
    }
    let circle = ["a", "b", "b::c"].map(str::to_owned).into();
    assert_eq!(circles(&imports), BTreeSet::from([circle]));
}
