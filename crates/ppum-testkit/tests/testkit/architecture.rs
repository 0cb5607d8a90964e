//! The arrows between the crates, as ARCHITECTURE.md draws them, against `cargo metadata`.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// Foreign crates that are known in one place of the product only, so that they can be
/// replaced there.
const DOORS: [(&str, &str); 22] = [
    ("ab_glyph", "ppum-figure"),
    ("clap", "ppum-cli"),
    ("eframe", "ppum-viewer"),
    ("egui", "ppum-viewer"),
    ("faer", "ppum-linear"),
    ("fearless_simd", "ppum-formula"),
    ("gif", "ppum-render"),
    ("miniz_oxide", "ppum-figure"),
    ("naga", "ppum-testkit"),
    ("numpy", "ppum-python"),
    ("pdf-writer", "ppum-figure"),
    ("png", "ppum-render"),
    ("pyo3", "ppum-python"),
    ("roxmltree", "ppum-import"),
    ("rfd", "ppum-viewer"),
    ("signal-hook", "ppum-cli"),
    ("spade", "ppum-solve"),
    ("strsim", "ppum-formula"),
    ("sysinfo", "ppum-cli"),
    ("toml", "ppum-problem"),
    ("wgpu", "ppum-gpu"),
    ("zlib-rs", "ppum-format"),
];

/// Foreign crates that one more of ours knows: it derives their traits, behind a feature, or
/// exchanges their matrices with the first.
const SHARED: [(&str, &str); 3] =
    [("clap", "ppum-scene"), ("faer", "ppum-solve"), ("faer", "ppum-fracture")];

/// Things that formulas and the field do without: threads, files of any kind, messages, graphics.
const NOT_IN_PPUM: [&str; 4] = ["rayon", "serde", "anyhow", "wgpu"];

type Arrows = BTreeMap<String, BTreeSet<String>>;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The output of a command of cargo in the root.
fn cargo(arguments: &[&str]) -> String {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo).args(arguments).current_dir(root()).output();
    let output = output.expect("cargo runs this test");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("cargo prints text")
}

fn packages() -> Vec<Value> {
    let metadata = cargo(&["metadata", "--no-deps", "--format-version", "1"]);
    let metadata: Value = serde_json::from_str(&metadata).expect("metadata is JSON");
    list(&metadata["packages"]).to_vec()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("an array of `cargo metadata`")
}

fn text(value: &Value) -> &str {
    value.as_str().expect("a text of `cargo metadata`")
}

/// Dependencies of each crate for which `kind` holds: `None` for normal ones, else `dev` or
/// `build`.
fn dependencies(kind: impl Fn(Option<&str>) -> bool) -> Arrows {
    let of = |package: &Value| {
        let chosen = list(&package["dependencies"]).iter().filter(|d| kind(d["kind"].as_str()));
        chosen.map(|d| text(&d["name"]).to_owned()).collect()
    };
    packages().iter().map(|p| (text(&p["name"]).to_owned(), of(p))).collect()
}

fn is_ours(name: &str) -> bool {
    name == "ppum" || name.starts_with("ppum-")
}

/// The table of ARCHITECTURE.md: rows of three cells, the first a crate, the last what it
/// depends on.
fn documented() -> Arrows {
    let page = std::fs::read_to_string(root().join("ARCHITECTURE.md")).expect("the page is there");
    let quoted = |cell: &str| cell.split('`').skip(1).step_by(2).map(str::to_owned).collect();
    let row = |line: &str| -> Option<(String, BTreeSet<String>)> {
        let cells: Vec<_> =
            line.strip_prefix('|')?.trim_end().strip_suffix('|')?.split('|').collect();
        let [first, _, to] = cells[..] else { return None };
        let first = first.trim().strip_prefix('`')?.strip_suffix('`')?;
        is_ours(first).then(|| (first.to_owned(), quoted(to)))
    };
    page.lines().filter_map(row).collect()
}

#[test]
fn arrows_are_as_drawn() {
    let mut found = dependencies(|kind| kind != Some("dev"));
    for to in found.values_mut() {
        to.retain(|name| is_ours(name));
    }
    assert_eq!(found, documented(), "crates that need others than ARCHITECTURE.md says");
}

/// Tests may ask for features of what their crate depends on anyway, and of the crate itself.
#[test]
fn tests_lean_on_the_testkit_alone() {
    let all = dependencies(|kind| kind != Some("dev"));
    for (name, to) in dependencies(|kind| kind == Some("dev")) {
        let is_known = |to: &str| to == name || to == "ppum-testkit" || all[&name].contains(to);
        let more: Vec<_> = to.iter().filter(|to| is_ours(to) && !is_known(to)).collect();
        assert!(more.is_empty(), "{name} depends on {more:?} in its tests");
    }
}

#[test]
fn foreign_crates_have_one_door() {
    let mut found = dependencies(|kind| kind != Some("dev"));
    found.remove("ppum-bench").expect("it measures what lies behind doors");
    for (foreign, door) in DOORS {
        let users: Vec<_> = found.iter().filter(|(_, to)| to.contains(foreign)).collect();
        let names = users.iter().map(|(name, _)| name.as_str());
        let names: Vec<_> = names.filter(|name| !SHARED.contains(&(foreign, name))).collect();
        assert_eq!(names, [door], "who depends on {foreign}");
    }
    for (name, ours) in
        NOT_IN_PPUM.iter().flat_map(|name| ["ppum", "ppum-formula"].map(|ours| (name, ours)))
    {
        assert!(!found[ours].contains(*name), "{ours} depends on {name}");
    }
}

/// Calls that read or write files.
const FILE_CALLS: [&str; 6] =
    ["fs::read(", "fs::read_to_string", "fs::write", "File::open", "File::create", "OpenOptions"];

/// Whatever reads or writes a file goes through `ppum-file`, which knows limits and loses nothing.
#[test]
fn files_have_one_door() {
    let exempt = ["ppum-bench", "ppum-file", "ppum-testkit"];
    for name in documented().into_keys().filter(|name| !exempt.contains(&name.as_str())) {
        let sources = sources(&root().join("crates").join(&name).join("src"));
        assert!(sources.len() > 5, "there are sources of {name}");
        for path in sources {
            let text = std::fs::read_to_string(&path).expect("a source file");
            let code = text.split("mod tests {").next().unwrap_or_default();
            let is_called = |call: &&&str| {
                let mut places = code.match_indices(**call).map(|(at, _)| &code[..at]);
                places.any(|before| !before.ends_with(char::is_alphanumeric))
            };
            let call = FILE_CALLS.iter().find(is_called);
            assert_eq!(call, None, "{}", path.display());
        }
    }
}

/// All files in a folder and those below, but for files of tests.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries =
        std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let is_test = |path: &PathBuf| path.file_stem().is_some_and(|stem| stem == "tests");
    let below = |path: PathBuf| if path.is_dir() { sources(&path) } else { vec![path] };
    entries.filter(|path| !is_test(path)).flat_map(below).collect()
}

/// So `cargo run` in the root needs no `--bin`: that which measures is in no default member.
#[test]
fn there_is_one_program_of_the_product() {
    let all = packages();
    let targets = all.iter().flat_map(|package| list(&package["targets"]));
    let programs = targets.filter(|t| list(&t["kind"]).iter().any(|kind| kind == "bin"));
    assert_eq!(programs.map(|t| text(&t["name"])).collect::<Vec<_>>(), ["ppum-bench", "ppum"]);
}

/// Most packages of the README's first command.
const MOST_PACKAGES: usize = 155;

/// Packages that the program alone does not need: graphics cards, windows, Python, test code.
const NOT_IN_THE_PROGRAM: [&str; 13] = [
    "eframe",
    "egui",
    "naga",
    "ppum-bench",
    "ppum-gpu",
    "ppum-python",
    "ppum-testkit",
    "ppum-viewer",
    "pyo3",
    "tempfile",
    "wgpu",
    "winit",
    "zbus",
];

/// Names and versions of the packages that `cargo run` in the root compiles.
fn built_packages() -> BTreeSet<String> {
    let tree = cargo(&["tree", "--edges", "no-dev", "--prefix", "none", "--format", "{p}"]);
    let name = |line: &str| line.split(' ').take(2).collect::<Vec<_>>().join(" ");
    tree.lines().filter(|line| !line.is_empty()).map(name).collect()
}

#[test]
fn the_first_command_builds_what_it_runs() {
    let packages = built_packages();
    let is_built = |name: &str| packages.iter().any(|p| p.split(' ').next() == Some(name));
    let extra: Vec<_> = NOT_IN_THE_PROGRAM.iter().filter(|name| is_built(name)).collect();
    assert!(extra.is_empty(), "the first command builds {extra:?}");
    assert!(is_built("ppum-cli") && is_built("faer"));
    assert!(packages.len() <= MOST_PACKAGES, "the first command builds {}", packages.len());
}
