//! Texts that try to break evaluators of formulas: kept ones, and mutants of them.
//!
//! [`seeds`] reads `tests/corpus/hostile`, [`mutant`] makes new texts, and `survive` sends one
//! through parser, derivatives and all back ends. Whatever the text, the outcome is an error with a
//! place in it or numbers, which may be NaN.

mod mutate;
#[cfg(feature = "wgsl")]
mod survive;

use super::cases::{FormulaCase, cases, folder, unescaped};
use super::record::{CorpusRecord, records};

pub use mutate::{Seed, mutant};
#[cfg(feature = "wgsl")]
pub use survive::{Arena, ParseOutcome, survive};

/// Stack of the thread that `survive` is run on, in bytes: what wasm32 gives to a program, the
/// least of all platforms. The parser needs most, at its deepest nesting with all precedences in
/// each level.
pub const STACK: usize = 1 << 20;

/// The hostile texts: recipes, one-liners, and what the fuzzer found.
///
/// # Panics
/// When a file is missing or broken.
#[must_use]
pub fn seeds() -> Vec<Seed> {
    let folder = folder().join("hostile");
    let lines = std::fs::read_to_string(folder.join("texts.txt")).expect("the file is kept");
    let lines = (1..).zip(lines.lines());
    let mut seeds: Vec<Seed> = records(&folder.join("recipes.txt")).iter().map(expanded).collect();
    seeds.extend(
        lines.map(|(k, line)| Seed { name: format!("texts.txt:{k}"), text: unescaped(line) }),
    );
    seeds.extend(stored_seeds(&folder));
    seeds
}

/// The formulas of the conformance corpus, each once: valid texts to start from.
///
/// # Panics
/// As [`cases`].
#[must_use]
pub fn valid_seeds() -> Vec<Seed> {
    let seed = |case: FormulaCase| Seed { name: case.place, text: case.formula };
    let mut seeds: Vec<Seed> = cases().into_iter().map(seed).collect();
    seeds.dedup_by(|a, b| a.text == b.text);
    seeds
}

/// A recipe's text: its parts, each repeated, `{n}` and `{m}` being the number of the repetition
/// counted from 0 and from 1.
fn expanded(record: &CorpusRecord) -> Seed {
    let part = |count: &str, quoted: &str| -> String {
        let count: usize = count.parse().unwrap_or_else(|_| record.fail("expected a count"));
        let part = quoted.strip_prefix('"').and_then(|text| text.strip_suffix('"'));
        let part = unescaped(part.unwrap_or_else(|| record.fail("expected a text in quotes")));
        if !part.contains('{') {
            return part.repeat(count);
        }
        let numbered =
            |n: usize| part.replace("{n}", &n.to_string()).replace("{m}", &(n + 1).to_string());
        (0..count).map(numbered).collect()
    };
    let parts = record.lines().filter(|(key, _)| *key != "recipe");
    let name = record.text("recipe").to_owned();
    Seed { name, text: parts.map(|(count, text)| part(count, text)).collect() }
}

/// Files `found-*.txt`, each one text, as the fuzzer writes them.
fn stored_seeds(folder: &std::path::Path) -> Vec<Seed> {
    let entries = std::fs::read_dir(folder).expect("the folder is kept");
    let paths = entries.map(|entry| entry.expect("readable").path());
    let is_found = |path: &std::path::PathBuf| {
        path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("found-"))
    };
    let mut paths: Vec<_> = paths.filter(is_found).collect();
    paths.sort();
    let seed = |path: std::path::PathBuf| Seed {
        name: path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned()),
        text: std::fs::read_to_string(path).expect("text"),
    };
    paths.into_iter().map(seed).collect()
}
