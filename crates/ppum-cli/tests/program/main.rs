//! The program as its users meet it: from a problem file to results and pictures.
#![allow(clippy::unwrap_used, reason = "a test may fail anywhere")]

mod backend;
mod commands;
mod compare;
#[cfg(target_os = "linux")]
mod cost;
mod damage;
mod demo;
mod determinism;
mod errors;
mod export;
mod extrema;
mod figures;
mod files;
mod formula;
mod gallery;
mod growing;
mod import;
mod info;
mod init;
mod meshes;
mod messages;
mod method;
mod mirror;
mod parts;
mod plots;
mod printable;
mod probe;
mod ranges;
mod readme;
mod render;
mod replacements;
mod sample;
mod series;
mod shell;
mod sif;
mod solve;
mod steps;
mod streams;
mod view;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::{Arc, Mutex, OnceLock};

use serde_json::Value;

/// A folder of its own to run the program in.
struct Lab {
    folder: tempfile::TempDir,
}

impl Lab {
    fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    /// A folder with `plate.toml` and its dataset `plate.h5`. Each problem is solved once.
    fn solved(problem: &str) -> Self {
        static DATASETS: Mutex<BTreeMap<String, Arc<OnceLock<Vec<u8>>>>> =
            Mutex::new(BTreeMap::new());
        let lab = Self::new();
        lab.write("plate.toml", problem);
        let dataset = DATASETS.lock().unwrap().entry(problem.to_owned()).or_default().clone();
        let bytes = dataset.get_or_init(|| {
            lab.run("solve plate.toml");
            std::fs::read(lab.path("plate.h5")).unwrap()
        });
        std::fs::write(lab.path("plate.h5"), bytes).unwrap();
        lab
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
    }

    /// The program with arguments apart by blanks.
    fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ppum"));
        command.args(arguments.split_whitespace()).current_dir(self.folder.path());
        // without these the drivers of Mesa complain on standard error
        command.env("XDG_RUNTIME_DIR", self.folder.path());
        command.env("MESA_VK_IGNORE_CONFORMANCE_WARNING", "1");
        command
    }

    /// The output of a successful command; nothing may appear on standard error.
    fn run(&self, arguments: &str) -> String {
        self.run_with(arguments, &[])
    }

    /// The same with more arguments, which may have blanks.
    fn run_with(&self, arguments: &str, more: &[&str]) -> String {
        let output = self.command(arguments).args(more).output().unwrap();
        let Output { status, stdout, stderr } = output;
        let complaint = String::from_utf8(stderr).unwrap();
        assert!(status.success() && complaint.is_empty(), "ppum {arguments} {more:?}: {complaint}");
        String::from_utf8(stdout).unwrap()
    }

    /// The output of a successful command, and the warnings on standard error.
    fn warned(&self, arguments: &str) -> (String, String) {
        let Output { status, stdout, stderr } = self.command(arguments).output().unwrap();
        let [text, warnings] = [stdout, stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        assert!(status.success() && warnings.starts_with("warning: "), "{arguments}: {warnings}");
        (text, warnings)
    }

    fn json(&self, arguments: &str) -> Value {
        self.json_with(arguments, &[])
    }

    fn json_with(&self, arguments: &str, more: &[&str]) -> Value {
        serde_json::from_str(&self.run_with(&format!("{arguments} --json"), more)).unwrap()
    }

    /// The complaint of a command that must fail, print no result and not panic.
    fn fail(&self, arguments: &str) -> String {
        self.fail_with(arguments, &[])
    }

    fn fail_with(&self, arguments: &str, more: &[&str]) -> String {
        let output = self.command(arguments).args(more).output().unwrap();
        let Output { status, stdout, stderr } = output;
        let complaint = String::from_utf8(stderr).unwrap();
        // 1: could not do it, 2: not understood; a panic is 101
        assert!(matches!(status.code(), Some(1 | 2)), "ppum {arguments}: {status} {complaint}");
        assert!(stdout.is_empty(), "ppum {arguments}: {stdout:?}");
        assert!(complaint.starts_with("error: "), "ppum {arguments}: {complaint}");
        complaint
    }

    /// The names of all files.
    fn files(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder.path()).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
}

/// The keys of an object, sorted.
fn keys(value: &Value) -> Vec<&str> {
    let mut keys: Vec<_> = value.as_object().unwrap().keys().map(String::as_str).collect();
    keys.sort_unstable();
    keys
}

/// A picture's size, pixels as RGBA, and texts.
struct Png {
    size: [u32; 2],
    rgba: Vec<u8>,
    texts: Vec<(String, String)>,
}

impl Png {
    fn read(path: &Path) -> Self {
        let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
        let mut reader = png::Decoder::new(file).read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        let frame = reader.next_frame(&mut data).unwrap();
        reader.finish().unwrap();
        let info = reader.info();
        let latin =
            info.uncompressed_latin1_text.iter().map(|t| (t.keyword.clone(), t.text.clone()));
        let utf8 = info.utf8_text.iter().map(|t| (t.keyword.clone(), t.get_text().unwrap()));
        let rgba = match frame.color_type {
            png::ColorType::Rgba => data,
            png::ColorType::Rgb => data.chunks(3).flat_map(|p| [p[0], p[1], p[2], 255]).collect(),
            other => panic!("colour type {other:?}"),
        };
        let texts = latin.chain(utf8).collect();
        Self { size: [info.width, info.height], rgba, texts }
    }

    fn pixel(&self, column: u32, row: u32) -> [u8; 4] {
        let at = 4 * (row * self.size[0] + column) as usize;
        self.rgba[at..at + 4].try_into().unwrap()
    }

    fn text(&self, key: &str) -> &str {
        &self.texts.iter().find(|(k, _)| k == key).unwrap_or_else(|| panic!("no {key}")).1
    }
}

/// A cracked plate under tension, small enough to be solved in no time.
const CRACKED: &str = r#"
title = "Small plate"
[domain]
min = [-1.0, -1.0]
max = [1.0, 1.0]
[material]
young = 1.0
poisson = 0.3
state = "plane-strain"
[[crack]]
points = [[-0.5, 0.0], [0.5, 0.0]]
[[boundary]]
on = "bottom"
traction = [0.0, -1.0]
[[boundary]]
on = "top"
traction = [0.0, 1.0]
[discretization]
level = 3
order = 1
"#;

/// A plate without a crack under tension: σ_yy = 1, all other stresses zero, everywhere.
fn sound() -> String {
    let crack = "[[crack]]\npoints = [[-0.5, 0.0], [0.5, 0.0]]\n";
    let sound = CRACKED.replace(crack, "").replace("level = 3", "level = 1");
    assert!(!sound.contains("crack"));
    sound
}

/// The cracked plate with a weight, functions, quantities and a table of its own.
fn with_formulas() -> String {
    let text = CRACKED.replace("order = 1", "order = 1\nweight = \"(1 - t)^2*(1 + 2*t)\"");
    text.replace("young = 1.0", "young = \"table(modulus, x)\"")
        + r#"
[[table]]
name = "modulus"
x = [-2.0, 2.0]
values = [1.0, 3.0]
[[enrichment]]
name = "corner"
functions = ["r^lambda*cos(lambda*theta)", "r^lambda*sin(lambda*theta)"]
parameters = { lambda = 0.6 }
at = [0.5, 0.75]
singular = [[0.0, 0.0]]
[[enrichment]]
function = "kink"
along = [[-1.0, -0.5], [1.0, -0.5]]
[[quantity]]
name = "stretch"
formula = "hypot(ux, uy)*2  # twice"
unit = "mm"
"#
}

/// A Poisson problem whose solution is u = x + 2y.
const LINEAR: &str = r#"
title = "Plane"
[domain]
min = [0.0, 0.0]
max = [2.0, 1.0]
[equation]
kind = "poisson"
[exact]
value = "x + 2*y"
[[boundary]]
on = "left"
value = "exact"
[[boundary]]
on = "right"
value = "exact"
[[boundary]]
on = "bottom"
value = "exact"
[[boundary]]
on = "top"
value = "exact"
[discretization]
level = 1
order = 1
"#;
