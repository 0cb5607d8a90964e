//! A type's name says which one it is: few types of the workspace share a name.

use crate::sources::code;
use std::collections::BTreeMap;
use std::path::Path;

/// Most types of one name; of the same concept in another crate, say.
const MOST: usize = 3;

/// Names that more types have, and why.
const SHARED: &[(&str, &str)] = &[
    ("Args", "the arguments of a command, one each"),
    ("Report", "the printed result of a command, one each"),
    ("Row", "a row of a report, one each"),
];

/// The name of the type or trait that a line declares. Types inside traits are no declarations of
/// their own, so that aliases count at the margin alone.
fn declared(line: &str) -> Option<&str> {
    let is_inner = line.starts_with(' ');
    let mut words = line.split_whitespace().skip_while(|word| word.starts_with("pub"));
    let keyword = words.next()?;
    let is_type = ["struct", "enum", "union", "trait"].contains(&keyword);
    let name = words.next().filter(|_| is_type || (keyword == "type" && !is_inner))?;
    let end = name.find(|c: char| !c.is_alphanumeric()).unwrap_or(name.len());
    name.starts_with(char::is_uppercase).then_some(&name[..end])
}

/// The modules that declare each name, unit tests left out.
fn modules_by_name() -> BTreeMap<String, Vec<String>> {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut all = BTreeMap::<String, Vec<String>>::new();
    for folder in std::fs::read_dir(crates).expect("a folder of crates") {
        let folder = folder.expect("an entry").path();
        let package = folder.file_name().expect("a name").to_string_lossy().into_owned();
        for (module, code) in code(&folder.join("src")) {
            let module = format!("{package}: {}", module.join("::"));
            for name in code.lines().filter_map(declared) {
                all.entry(name.to_owned()).or_default().push(module.clone());
            }
        }
    }
    all
}

#[test]
fn few_types_share_a_name() {
    let all = modules_by_name();
    assert!(all.len() > 500, "only {} names", all.len());
    let is_listed = |name: &str| SHARED.iter().any(|&(listed, _)| listed == name);
    let vague: Vec<_> =
        all.iter().filter(|(name, at)| at.len() > MOST && !is_listed(name)).collect();
    assert!(vague.is_empty(), "these names say too little: {vague:#?}");
    for (name, _) in SHARED {
        assert!(all[*name].len() > MOST, "{name} is shared by few, strike it");
    }
}

#[test]
fn declarations_are_found_in_all_forms() {
    let lines = [
        ("pub(crate) struct Seat<'a> {", Some("Seat")),
        ("    enum Inner {", Some("Inner")),
        ("pub trait Draws: Copy {", Some("Draws")),
        ("type Pairs = Vec<(u32, u32)>;", Some("Pairs")),
        ("    type Output = f64;", None),
        ("let kind: Kind = Kind::One;", None),
    ];
    for (line, name) in lines {
        assert_eq!(declared(line), name, "{line}");
    }
}
