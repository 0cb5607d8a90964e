//! How many files of the solver know a feature, as ARCHITECTURE.md says it.

use crate::sources::code;
use std::path::Path;

/// The crates that solve problems.
const CRATES: [&str; 3] = ["ppum-problem", "ppum-solve", "ppum-fracture"];

/// A row of the table: a feature, the number of files that know it, and the words by which they do.
struct FeatureCount {
    feature: String,
    files: usize,
    words: Vec<String>,
}

fn rows(text: &str) -> Vec<FeatureCount> {
    let table = text.split("\n| feature | files |").nth(1).unwrap_or_default();
    let lines = table.lines().skip(2).take_while(|line| line.starts_with('|'));
    let row = |line: &str| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        FeatureCount {
            feature: cells[1].to_owned(),
            files: cells[2].parse().expect("a number of files"),
            words: cells[4].split('`').skip(1).step_by(2).map(str::to_owned).collect(),
        }
    };
    lines.map(row).collect()
}

/// The files of the solver with a word in their code, by their modules.
fn knowing(words: &[String]) -> Vec<String> {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folders = CRATES.map(|name| (name, crates.join(name).join("src")));
    let files = folders.into_iter().filter(|(_, folder)| folder.is_dir()).flat_map(|(name, f)| {
        code(&f)
            .into_iter()
            .map(move |(module, text)| (format!("{name} {}", module.join("::")), text))
    });
    let knows = |text: &str| words.iter().any(|word| text.contains(word.as_str()));
    files.filter(|(_, text)| knows(text)).map(|(module, _)| module).collect()
}

/// A feature that spreads over more files is to be given a room of its own first; one that is known
/// by fewer is to be told so.
#[test]
fn few_files_know_a_feature() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../ARCHITECTURE.md");
    let rows = rows(&std::fs::read_to_string(path).expect("the architecture"));
    assert_eq!(rows.len(), 4, "features of the table");
    for FeatureCount { feature, files, words } in rows {
        let found = knowing(&words);
        assert!(
            !words.is_empty() && found.len() == files,
            "{feature}, {}: {found:#?}",
            found.len()
        );
    }
}
