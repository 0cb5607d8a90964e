//! The links between the pages of the project lead somewhere, what they say of commands, versions
//! and files is so, and what is read has short lines.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// All files below a folder with one of these extensions; what is built or hidden is left out.
fn files(folder: &Path, extensions: &[&str], found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder of the project") {
        let path = entry.expect("an entry of a folder").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if name == "target" || name == "out" || name.starts_with('.') {
            continue;
        }
        if path.is_dir() {
            files(&path, extensions, found);
        } else if path.extension().is_some_and(|end| extensions.iter().any(|&e| end == e)) {
            found.push(path);
        }
    }
}

/// The files of the project with one of these extensions, with their texts.
fn texts(extensions: &[&str]) -> Vec<(PathBuf, String)> {
    let mut all = Vec::new();
    files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."), extensions, &mut all);
    let text = |path: PathBuf| {
        let text = fs::read_to_string(&path).expect("a file of text");
        (path, text)
    };
    all.into_iter().map(text).collect()
}

/// The targets of `[text](target)`, without those in the web and within the page.
fn links(page: &str) -> impl Iterator<Item = &str> {
    let targets = page.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
    let files = targets.filter_map(|(target, _)| target.split('#').next());
    files.filter(|target| !target.is_empty() && !target.starts_with("http"))
}

#[test]
fn links_lead_to_files() {
    let all = texts(&["md"]);
    let mut count = 0;
    for (path, text) in &all {
        let folder = path.parent().expect("a page lies in a folder");
        for target in links(text) {
            assert!(folder.join(target).exists(), "{}: {target}", path.display());
            count += 1;
        }
    }
    assert!(count > 30, "{count} links in {} pages", all.len());
}

/// The text of a file of the project.
fn text(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Both commands of the set-up stand in the README as commands, and the checks of a change run the
/// tests by the second one as it stands there.
#[test]
fn set_up_commands_are_run_as_they_stand() {
    let (readme, checks) = (text("README.md"), text(".ci/run"));
    for command in ["cargo run --release -- demo", "cargo test --release"] {
        assert!(readme.contains(&format!("\n    {command}\n")), "README.md lacks {command}");
    }
    assert!(checks.contains("\ncargo test --release 2>&1 | tee"), ".ci/run lacks the second one");
    assert!(readme.contains("(.ci/run)"), "README.md names the checks");
}

/// A row of a table is cited by its label, so in tables of plates each row has its own.
#[test]
fn plates_of_the_validation_have_labels_of_their_own() {
    let page = text("docs/validation.md");
    let mut lines = page.lines();
    let mut plates = 0;
    while let Some(head) = lines.find(|line| line.starts_with("| plate |")) {
        let columns = if head.starts_with("| plate | factor |") { 2 } else { 1 };
        let rows = lines.by_ref().take_while(|line| line.starts_with('|'));
        let labels: Vec<Vec<_>> =
            rows.map(|row| row.split('|').skip(1).take(columns).collect()).collect();
        let unique: BTreeSet<_> = labels.iter().collect();
        assert_eq!(unique.len(), labels.len(), "{head}: {labels:?}");
        plates += labels.len();
    }
    assert!(plates > 20, "{plates} plates");
}

/// The table of errors of the examples is of one level below that of their files, as it says.
#[test]
fn levels_of_examples_are_those_of_their_files() {
    let page = text("examples/README.md");
    let mut lines = page.lines().skip_while(|line| !line.starts_with("| file | level |"));
    let rows: Vec<_> = lines.by_ref().skip(2).take_while(|line| line.starts_with('|')).collect();
    assert!(rows.len() > 3, "{rows:?}");
    for row in rows {
        let cells: Vec<_> = row.split('|').map(str::trim).collect();
        let file = text(&format!("examples/{}.toml", cells[1]));
        let level = file.lines().find_map(|line| line.strip_prefix("level = "));
        let coarser = level.and_then(|level| level.parse::<u32>().ok()).map(|level| level - 1);
        assert_eq!(coarser.map(|level| level.to_string()).as_deref(), Some(cells[2]), "{row}");
    }
}

/// Pages by hand, in the guides of writers, name no version that FORMAT.md does not have.
#[test]
fn versions_of_written_files_are_those_of_the_format() {
    let format = text("FORMAT.md");
    let current = format.split("version 1.").nth(1).expect("the version of the format");
    let digits = |text: &str| -> u32 {
        text.chars().take_while(char::is_ascii_digit).collect::<String>().parse().expect("a number")
    };
    let (current, guide) = (digits(current), text("docs/writing.md"));
    let keys = ["\"format_version\"", "format_version="];
    let places = keys.iter().flat_map(|key| guide.split(key).skip(1));
    let minors: Vec<_> = places.filter_map(|place| place.split("1, ").nth(1)).map(digits).collect();
    assert!(minors.len() >= 2 && minors.iter().all(|minor| *minor <= current), "{minors:?}");
}

/// Pages need a browser of 2024 or later (docs/page.md).
#[test]
fn no_page_promises_any_browser() {
    for (path, text) in texts(&["md", "py"]) {
        assert!(!text.contains("any browser"), "{}", path.display());
    }
}

/// The numbers of the lines outside of code and tables that `is_prose` takes and that are longer.
fn longer(text: &str, columns: usize, is_prose: fn(&str) -> Option<&str>) -> Vec<usize> {
    let mut is_code = false;
    let mut found = Vec::new();
    for (k, line) in text.lines().enumerate() {
        let Some(prose) = is_prose(line) else {
            is_code = false;
            continue;
        };
        is_code ^= prose.trim_start().starts_with("```");
        let is_free = is_code || prose.starts_with("    ") || prose.trim_start().starts_with('|');
        if !is_free && line.chars().count() > columns {
            found.push(k + 1);
        }
    }
    found
}

/// What a line says that is a comment and nothing else.
fn comment(line: &str) -> Option<&str> {
    line.trim_start().strip_prefix("//").map(|rest| rest.trim_start_matches(['/', '!']))
}

#[test]
fn lines_are_short() {
    let mut long = Vec::new();
    for (path, text) in texts(&["rs", "wgsl", "md"]) {
        let is_page = path.extension().is_some_and(|end| end == "md");
        let lines = if is_page {
            longer(&text, 120, |line| Some(line))
        } else {
            longer(&text, 100, comment)
        };
        long.extend(lines.into_iter().map(|line| format!("{}:{line}", path.display())));
    }
    assert!(long.is_empty(), "more than 100 columns of a comment or 120 of a page: {long:#?}");
}
