//! The problem files of `examples/`.

use ppum_problem::Problem;
use std::fs;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")
}

/// Each can be read, has its picture, and is described with the commands that make it.
#[test]
fn every_example_is_in_order() {
    let page = fs::read_to_string(folder().join("README.md")).expect("the page of the examples");
    let entries = fs::read_dir(folder()).expect("the examples").map(|e| e.expect("a file").path());
    let files: Vec<_> = entries.filter(|p| p.extension().is_some_and(|e| e == "toml")).collect();
    assert!(files.len() >= 12, "{files:?}");
    for file in files {
        let problem = Problem::read(&file).unwrap_or_else(|e| panic!("{e}"));
        let name = file.file_stem().and_then(|n| n.to_str()).expect("a plain name");
        assert!(!problem.title.is_empty() && problem.title != name, "{name} has no title");
        assert!(file.with_extension("png").exists(), "{name} has no picture");
        for needed in [
            format!("({name}.png)"),
            format!("ppum solve examples/{name}.toml -o out/{name}.h5\n"),
            format!("ppum render out/{name}.h5 -o examples/{name}.png "),
        ] {
            assert!(page.contains(&needed), "examples/README.md lacks {needed}");
        }
    }
}
