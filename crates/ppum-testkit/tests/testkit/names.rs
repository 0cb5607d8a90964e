//! A type's name says which one it is: few types of the workspace share a name.

use crate::sources::code;
use std::collections::BTreeMap;
use std::path::Path;

/// Most types of one name; of the same concept in another crate, say.
const MOST: usize = 2;

/// Most types in all whose name another type has too.
const MOST_SHARED: usize = 40;

/// First words of names that say what was done with a thing, or how it seems, but not what it is.
const VAGUE: &[&str] = &[
    "Against",
    "Alike",
    "Apart",
    "Around",
    "Asked",
    "Checked",
    "Claim",
    "Declared",
    "Desk",
    "Doubt",
    "Drawn",
    "Fate",
    "Film",
    "Found",
    "Given",
    "Ground",
    "Keep",
    "Kept",
    "Laid",
    "Last",
    "Left",
    "Lonely",
    "Look",
    "Made",
    "Measured",
    "Minus",
    "Moved",
    "Named",
    "Nature",
    "Opened",
    "Painted",
    "Parting",
    "Placed",
    "Placing",
    "Reel",
    "Seats",
    "Seen",
    "Shot",
    "Shown",
    "Sight",
    "Spot",
    "Standing",
    "Stations",
    "Still",
    "Stored",
    "Swing",
    "Taken",
    "Telling",
    "Told",
    "Undecided",
    "Wanted",
    "Wish",
    "Written",
];

/// Names of one word that end as participles do: nouns, or stages of a solution.
const NOUNS: &[(&str, &str)] = &[
    ("Assembled", "a stage of a solution"),
    ("Cancelled", "the error of work that was stopped"),
    ("Diagnosed", "a stage of a solution"),
    ("Need", "a noun"),
    ("Padding", "a noun"),
    ("Ring", "a noun"),
    ("Seed", "a noun"),
    ("Solved", "a stage of a solution"),
    ("Spring", "a noun"),
    ("Warning", "a noun"),
];

/// Openings of sentences without a subject of their own.
const OPENINGS: &[&str] = &["What ", "Of ", "Who ", "The same "];

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
    let vague: Vec<_> = all.iter().filter(|(_, at)| at.len() > MOST).collect();
    assert!(vague.is_empty(), "these names say too little: {vague:#?}");
    let shared: Vec<_> = all.iter().filter(|(_, at)| at.len() > 1).collect();
    let count: usize = shared.iter().map(|(_, at)| at.len()).sum();
    assert!(count <= MOST_SHARED, "{count} types share their names: {shared:#?}");
}

/// The first word of a name in camel case.
fn first_word(name: &str) -> &str {
    let end = name.char_indices().skip(1).find(|(_, c)| c.is_uppercase());
    &name[..end.map_or(name.len(), |(at, _)| at)]
}

#[test]
fn types_are_nouns() {
    let all = modules_by_name();
    let is_noun = |name: &str| NOUNS.iter().any(|&(noun, _)| noun == name);
    let is_participle = |name: &str| {
        first_word(name) == name && ["ed", "ing"].iter().any(|end| name.ends_with(end))
    };
    let vague: Vec<_> = all
        .iter()
        .filter(|(name, _)| VAGUE.contains(&name.as_str()) || is_participle(name))
        .filter(|(name, _)| !is_noun(name))
        .collect();
    assert!(vague.is_empty(), "say which thing it is: {vague:#?}");
    for (noun, _) in NOUNS {
        assert!(all.contains_key(*noun), "no type is called {noun} any more, strike it");
    }
}

/// The texts of the comments below a folder of sources, tests left out, with their files.
fn comments(folder: &Path, found: &mut Vec<(String, String)>) {
    for entry in std::fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        if path.is_dir() && !path.ends_with("tests") {
            comments(&path, found);
        } else if path.extension().is_some_and(|end| end == "rs") {
            let text = std::fs::read_to_string(&path).expect("a source file");
            let lines = text.lines().map(str::trim_start);
            let docs = lines.filter_map(|line| line.strip_prefix("//")?.strip_prefix(['/', '!']));
            let file = path.display().to_string();
            found.extend(docs.map(|text| (file.clone(), text.trim_start().to_owned())));
        }
    }
}

#[test]
fn sentences_of_docs_have_a_subject() {
    let (crates, mut all) = (Path::new(env!("CARGO_MANIFEST_DIR")).join(".."), Vec::new());
    for folder in std::fs::read_dir(crates).expect("a folder of crates") {
        comments(&folder.expect("an entry").path().join("src"), &mut all);
    }
    assert!(all.len() > 5000, "only {} lines of documentation", all.len());
    let is_bare = |text: &str| {
        OPENINGS.iter().any(|&opening| {
            let inside = [". ", ": "].iter().any(|end| text.contains(&format!("{end}{opening}")));
            text.starts_with(opening) || inside
        })
    };
    let bare: Vec<_> = all.iter().filter(|(_, text)| is_bare(text)).collect();
    assert!(bare.is_empty(), "open with the subject or the verb: {bare:#?}");
}

#[test]
fn first_words_end_before_the_next_capital() {
    for (name, word) in [("Shown", "Shown"), ("ShownError", "Shown"), ("Vec2", "Vec2")] {
        assert_eq!(first_word(name), word);
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
