//! The links between the pages of the project lead somewhere.

use std::fs;
use std::path::{Path, PathBuf};

/// All pages below a folder; what is built or hidden is left out.
fn pages(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder of the project") {
        let path = entry.expect("an entry of a folder").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if name == "target" || name == "out" || name.starts_with('.') {
            continue;
        }
        if path.is_dir() {
            pages(&path, found);
        } else if name.ends_with(".md") {
            found.push(path);
        }
    }
}

/// The targets of `[text](target)`, without those in the web and within the page.
fn links(page: &str) -> impl Iterator<Item = &str> {
    let targets = page.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
    let files = targets.filter_map(|(target, _)| target.split('#').next());
    files.filter(|target| !target.is_empty() && !target.starts_with("http"))
}

#[test]
fn links_lead_to_files() {
    let mut all = Vec::new();
    pages(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."), &mut all);
    let mut count = 0;
    for path in &all {
        let text = fs::read_to_string(path).expect("a page is text");
        let folder = path.parent().expect("a page lies in a folder");
        for target in links(&text) {
            assert!(folder.join(target).exists(), "{}: {target}", path.display());
            count += 1;
        }
    }
    assert!(count > 30, "{count} links in {} pages", all.len());
}
