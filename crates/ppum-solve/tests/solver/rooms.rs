//! The rooms of the crate and the arrows between them, against its sources.
//!
//! A room is a module of `lib.rs`. It imports from rooms on floors below its own only, so no two rooms
//! need each other. Unit tests may look into any room.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Floors from the ground up: each room with the rooms that it imports from.
const FLOORS: &[&[(&str, &[&str])]] = &[
    &[("geometry", &[]), ("law", &[]), ("linear", &[]), ("quadrature", &[]), ("report", &[])],
    &[
        ("equilibrium", &["linear", "quadrature"]),
        ("problem", &["geometry"]),
        ("smoothness", &["geometry", "law", "quadrature"]),
        ("watched", &["geometry"]),
    ],
    &[("corner", &["geometry", "problem", "quadrature", "smoothness"])],
    &[("refine", &["corner", "geometry", "problem", "smoothness", "watched"])],
    &[("space", &["geometry", "problem", "quadrature", "refine", "smoothness", "watched"])],
    &[
        ("basis", &["linear", "quadrature", "space", "watched"]),
        ("intensity", &["geometry", "law", "problem", "quadrature", "space", "watched"]),
        ("norms", &["law", "space"]),
    ],
    &[
        (
            "assembly",
            &[
                "basis",
                "equilibrium",
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
                "report",
                "smoothness",
                "space",
                "watched",
            ],
        ),
    ],
    &[(
        "solve",
        &[
            "assembly",
            "basis",
            "diagnostics",
            "equilibrium",
            "geometry",
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
];

type Arrows = BTreeMap<String, BTreeSet<String>>;

fn sources() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// The rooms with the code of their files: `room.rs`, or what is in the folder `room`.
fn rooms() -> BTreeMap<String, String> {
    let mut rooms = BTreeMap::new();
    for entry in std::fs::read_dir(sources()).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        if name != "lib" {
            rooms.insert(name, code_below(&path));
        }
    }
    rooms
}

/// The code of a file or folder, without comments and unit tests.
fn code_below(path: &Path) -> String {
    if path.file_stem().is_some_and(|stem| stem == "tests") {
        return String::new();
    }
    if path.is_dir() {
        let entries = std::fs::read_dir(path).expect("a folder");
        return entries.map(|entry| code_below(&entry.expect("an entry").path())).collect();
    }
    let text = std::fs::read_to_string(path).expect("a source file");
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    code.lines().map(|line| line.split("//").next().unwrap_or_default().to_owned() + "\n").collect()
}

/// The modules that a code names right after `crate::`, also in braces.
fn imports(code: &str) -> BTreeSet<String> {
    code.split("crate::").skip(1).flat_map(first_names).collect()
}

/// `a` of `a::b`; `a` and `c` of `{a::{b}, c::d}`.
fn first_names(path: &str) -> Vec<String> {
    let Some(group) = path.strip_prefix('{') else { return vec![identifier(path)] };
    let (mut depth, mut names, mut rest) = (0, vec![identifier(group)], group);
    while let Some(at) = rest.find(['{', '}', ',']) {
        let (mark, tail) = (rest.as_bytes()[at], &rest[at + 1..]);
        match mark {
            b'{' => depth += 1,
            b'}' if depth == 0 => break,
            b'}' => depth -= 1,
            _ if depth == 0 => names.push(identifier(tail)),
            _ => {}
        }
        rest = tail;
    }
    names.retain(|name| !name.is_empty());
    names
}

fn identifier(text: &str) -> String {
    let is_part = |c: &char| c.is_alphanumeric() || *c == '_';
    text.trim_start().chars().take_while(is_part).collect()
}

/// The rooms that each room imports from, itself apart.
fn found() -> Arrows {
    let of = |(name, code): (String, String)| {
        let mut to = imports(&code);
        to.remove(&name);
        (name, to)
    };
    rooms().into_iter().map(of).collect()
}

fn drawn() -> Arrows {
    let names = |all: &[&str]| all.iter().map(|&name| name.to_owned()).collect();
    FLOORS.iter().copied().flatten().map(|(name, to)| ((*name).to_owned(), names(to))).collect()
}

/// Floor of each room, counted from 0.
fn floors() -> BTreeMap<&'static str, usize> {
    let rooms = |(floor, rooms): (usize, &'static &[(&str, &[&str])])| {
        rooms.iter().map(move |(name, _)| (*name, floor))
    };
    FLOORS.iter().enumerate().flat_map(rooms).collect()
}

#[test]
fn arrows_are_as_drawn() {
    let (found, drawn) = (found(), drawn());
    for (name, to) in &found {
        let expected = drawn.get(name).unwrap_or_else(|| panic!("the room {name} has no floor"));
        assert_eq!(to, expected, "the imports of {name}");
    }
    let gone: Vec<_> = drawn.keys().filter(|name| !found.contains_key(*name)).collect();
    assert!(gone.is_empty(), "no rooms: {gone:?}");
}

#[test]
fn arrows_lead_down() {
    let floors = floors();
    for (name, to) in drawn() {
        for to in to {
            let floor = |room: &str| floors.get(room).unwrap_or_else(|| panic!("no room {room}"));
            assert!(floor(&to) < floor(&name), "{name} imports from {to}, which is not below it");
        }
    }
}

#[test]
fn imports_are_found_in_all_forms() {
    let code =
        "use crate::a::b;\nuse crate::{c::{d, e}, f, g::h as i};\nlet x = crate::j(1); self::k";
    let names = ["a", "c", "f", "g", "j"].map(str::to_owned);
    assert_eq!(imports(code), BTreeSet::from(names));
}
