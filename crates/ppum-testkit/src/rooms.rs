//! Rooms of a crate: its modules on floors, with arrows that lead down only, held against its sources.
//!
//! A room is a module of `lib.rs`, or of `main.rs`. It imports from rooms on floors below its own, so no two rooms need each
//! other. Unit tests may look into any room.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Floors from the ground up: each room with the rooms that it imports from.
pub type Floors<'a> = &'a [&'a [(&'a str, &'a [&'a str])]];

/// Modules that stand in no room: the crate's front page and its tests.
const NO_ROOMS: [&str; 4] = ["lib", "main", "tests", "testing"];

/// Checks that the sources of a crate, a folder, have these rooms and arrows and no others, and that arrows
/// lead down.
///
/// # Panics
/// If they do not, with the room.
pub fn check(sources: &Path, floors: Floors<'_>) {
    arrows_lead_down(floors);
    let drawn: BTreeMap<_, _> = floors.iter().copied().flatten().copied().collect();
    let rooms = rooms(sources);
    for (name, code) in &rooms {
        let to = drawn.get(name.as_str()).unwrap_or_else(|| panic!("{name} has no floor"));
        let expected: BTreeSet<String> = to.iter().map(|&to| to.to_owned()).collect();
        let mut found = imports(code);
        found.remove(name);
        assert_eq!(found, expected, "the imports of {name}");
    }
    let gone: Vec<_> = drawn.keys().filter(|&&name| !rooms.contains_key(name)).collect();
    assert!(gone.is_empty(), "no rooms: {gone:?}");
}

/// Checks that ARCHITECTURE.md, in a parent folder of the sources, has the row of a crate: its rooms from the
/// ground floor up.
///
/// # Panics
/// If it has not; the message holds the row.
pub fn check_page(sources: &Path, name: &str, floors: Floors<'_>) {
    let page = sources.ancestors().map(|folder| folder.join("ARCHITECTURE.md"));
    let page = page.map(std::fs::read_to_string).find_map(Result::ok).expect("the page is there");
    let row = row(name, floors);
    assert!(page.lines().any(|line| line == row), "the page lacks\n{row}");
}

/// `| name | ground floor · … · top floor |`.
fn row(name: &str, floors: Floors<'_>) -> String {
    let names = |floor: &&[(&str, &[&str])]| {
        floor.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(" ")
    };
    let floors: Vec<_> = floors.iter().map(names).collect();
    format!("| `{name}` | {} |", floors.join(" · "))
}

fn arrows_lead_down(floors: Floors<'_>) {
    let mut below = BTreeSet::new();
    for floor in floors {
        for (name, to) in *floor {
            let up: Vec<_> = to.iter().filter(|to| !below.contains(*to)).collect();
            assert!(up.is_empty(), "{name} imports from {up:?}, which are not below it");
        }
        below.extend(floor.iter().map(|(name, _)| *name));
    }
}

/// The rooms with the code of their files: `room.rs`, or what is in the folder `room`.
fn rooms(sources: &Path) -> BTreeMap<String, String> {
    let mut rooms = BTreeMap::new();
    for entry in std::fs::read_dir(sources).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        if !NO_ROOMS.contains(&name.as_str()) {
            *rooms.entry(name).or_insert_with(String::new) += &code_below(&path);
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
    if path.extension().is_none_or(|end| end != "rs") {
        return String::new();
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn imports_are_found_in_all_forms() {
        let code =
            "use crate::a::b;\nuse crate::{c::{d, e}, f, g::h as i};\nlet x = crate::j(1); self::k";
        assert_eq!(imports(code), BTreeSet::from(["a", "c", "f", "g", "j"].map(str::to_owned)));
    }

    #[test]
    #[should_panic(expected = "a imports from [\"b\"], which are not below it")]
    fn an_arrow_upwards_is_caught() {
        arrows_lead_down(&[&[("a", &["b"])], &[("b", &[])]]);
    }

    /// A crate of two modules, of which the second imports from the first.
    fn two_rooms(folder: &str) -> std::path::PathBuf {
        let sources = std::env::temp_dir().join(format!("ppum-{folder}-{}", std::process::id()));
        std::fs::create_dir_all(&sources).expect("a folder");
        for (name, code) in [("a.rs", "pub struct A;"), ("b.rs", "use crate::a::A; // crate::c")] {
            std::fs::write(sources.join(name), code).expect("a file");
        }
        sources
    }

    #[test]
    fn rows_go_up() {
        let floors: Floors<'_> = &[&[("a", &[]), ("b", &[])], &[("c", &["a"])]];
        assert_eq!(row("house", floors), "| `house` | a b · c |");
    }

    #[test]
    fn rooms_as_drawn_pass() {
        check(&two_rooms("rooms"), &[&[("a", &[])], &[("b", &["a"])]]);
    }

    #[test]
    #[should_panic(expected = "b has no floor")]
    fn a_room_without_a_floor_is_caught() {
        check(&two_rooms("floor"), &[&[("a", &[])]]);
    }

    #[test]
    #[should_panic(expected = "the imports of b")]
    fn an_arrow_that_is_not_drawn_is_caught() {
        check(&two_rooms("arrow"), &[&[("a", &[]), ("b", &[])]]);
    }
}
