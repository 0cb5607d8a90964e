//! The links between the pages of the project lead somewhere, and what is read has short lines.

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
