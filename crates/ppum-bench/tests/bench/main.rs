//! The program `ppum-bench` as its users meet it, and what its numbers rest on.
#![allow(clippy::unwrap_used, reason = "a test may fail anywhere")]

mod synthetic;

use std::path::Path;
use std::process::{Command, Output};

use ppum_bench::page::replaced;
use ppum_bench::solver::Fit;
use ppum_bench::synthetic::CrackRecipe;
use ppum_bench::table::ReportTable;
use serde_json::{Value, json};

/// Variables that hide all Vulkan drivers: of new loaders and of old ones.
const HIDDEN: [(&str, &str); 2] = [("VK_DRIVER_FILES", "none"), ("VK_ICD_FILENAMES", "none")];

fn command(folder: &Path, arguments: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ppum-bench"));
    command.args(arguments.split_whitespace()).current_dir(folder);
    command
}

fn run(folder: &Path, arguments: &str) -> String {
    let Output { status, stdout, stderr } = command(folder, arguments).output().unwrap();
    assert!(status.success(), "{arguments}: {}", String::from_utf8_lossy(&stderr));
    String::from_utf8(stdout).unwrap()
}

fn report(folder: &Path, arguments: &str) -> Value {
    serde_json::from_str(&run(folder, &format!("{arguments} --json"))).unwrap()
}

/// The complaint of a command that fails.
fn fail(folder: &Path, arguments: &str) -> String {
    let Output { status, stderr, .. } = command(folder, arguments).output().unwrap();
    assert!(matches!(status.code(), Some(1 | 2)), "{arguments}");
    String::from_utf8(stderr).unwrap()
}

/// Two levels have a table and a chart, but no line through their times.
#[test]
fn the_solver_is_measured() {
    let folder = tempfile::tempdir().unwrap();
    let words = "solver --level 5 --solver multilevel --threads 2 -o times.svg";
    let report = report(folder.path(), words);
    assert_eq!((&report["threads"], &report["fit"]), (&json!(2), &json!(null)));
    let runs = report["runs"].as_array().unwrap();
    assert_eq!(runs.len(), 2);
    for (run, level) in runs.iter().zip([4, 5]) {
        assert_eq!((&run["level"], &run["kind"]), (&json!(level), &json!("multilevel")));
        assert!(run["unknowns"].as_u64() > Some(2 * 6 * 4u64.pow(level)));
        assert!(run["bytes"].as_f64() > Some(0.0) && run["iterations"].as_f64() < Some(30.0));
        let phases = run["phases"].as_array().unwrap();
        let names: Vec<_> = phases.iter().map(|phase| phase[0].as_str().unwrap()).collect();
        assert_eq!(names, ["cover", "basis", "assembly", "solution", "intensity", "estimate"]);
        let sum: f64 = phases.iter().map(|phase| phase[1].as_f64().unwrap()).sum();
        assert!(sum > 0.0 && (sum - run["seconds"].as_f64().unwrap()).abs() < 1e-12);
    }
    // the same crack, however many cells
    let [coarse, fine] = [0, 1].map(|k| runs[k]["k1"].as_f64().unwrap());
    assert!(coarse > 1.0 && (coarse / fine - 1.0).abs() < 0.01, "{coarse} {fine}");
    let svg = std::fs::read_to_string(folder.path().join("times.svg")).unwrap();
    assert!(svg.contains("all phases, slope ") && svg.contains(">unknowns<"), "{svg}");
    assert!(fail(folder.path(), "solver --level 4 -o a.png").contains("two levels"));
    let problem = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/edge-crack.toml");
    let text = run(folder.path(), &format!("solver {problem} --first 3 --quick --order 1"));
    for part in ["Phases of the solver", "assembly", "unknowns/s", "\ndirect      3"] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

/// Times on a line, and off it by known parts.
#[test]
fn lines_are_fitted() {
    let line = |n: f64| 0.25 + 2e-5 * n;
    let exact: Vec<[f64; 2]> = [1e4, 4e4, 16e4, 64e4].map(|n| [n, line(n)]).into();
    let fit = Fit::new(&exact).expect("a line");
    assert!((fit.seconds - 0.25).abs() < 1e-12 && (fit.seconds_per_unknown - 2e-5).abs() < 1e-17);
    assert!(fit.largest_deviation < 1e-12);
    // a time that grows with the power 3/2 is no line: the exponent tells
    let power: Vec<[f64; 2]> = [1e4, 4e4, 16e4].map(|n: f64| [n, 1e-6 * n.powf(1.5)]).into();
    let fit = Fit::new(&power).expect("a line");
    assert!((fit.exponent - 1.5).abs() < 1e-12 && fit.largest_deviation > 0.1);
    assert_eq!(Fit::new(&exact[..2]), None);
}

/// All scenes are there, each by all that draws it; frames are right, and a wrong derivative is
/// noticed in all of them.
#[test]
fn the_paper_is_measured() {
    let folder = tempfile::tempdir().unwrap();
    let page = "# Page\n<!-- begin ppum-bench paper -->\n<!-- end ppum-bench paper -->\nrest\n";
    std::fs::write(folder.path().join("page.md"), page).unwrap();
    let words = "paper --quick --frames 1 --threads 2 --page page.md -o chart.svg";
    let paper = report(folder.path(), words);
    assert_eq!((&paper["holds"], &paper["machine"]["threads"]), (&json!(true), &json!(2)));
    let rows = paper["rows"].as_array().unwrap();
    let count = |group: &str| rows.iter().filter(|row| row["group"] == group).count();
    let groups = ["patches", "orders", "enriched", "zooms", "formulas", "colors"];
    assert_eq!(groups.map(count), [4, 12, 3, 5, 8, 1]);
    rows.iter().for_each(check_scene);
    for file in paper["files"].as_array().unwrap() {
        let [open, first] = ["open_ms", "first_ms"].map(|key| file[key].as_f64().unwrap());
        assert!(0.0 < open && open < first && file["bytes"].as_u64() > Some(1000), "{file}");
    }
    let kept = std::fs::read_to_string(folder.path().join("page.md")).unwrap();
    assert!(kept.starts_with("# Page\n") && kept.ends_with("-->\nrest\n"), "{kept}");
    for part in ["| order 8 | graded |", "| zoom 1e12 |", "| exp, log, sin, atan |", "0 missed"] {
        assert!(kept.contains(part), "{part}: {kept}");
    }
    let chart = std::fs::read_to_string(folder.path().join("chart.svg")).unwrap();
    assert!(chart.contains(">patches<") && chart.contains("CPU f32, 1 thread"), "{chart}");
}

/// The ways of a scene, their times, and what they were compared with.
fn check_scene(row: &Value) {
    check_methods(&row["methods"], 2);
    assert!(row["paper_ms"].is_null(), "these are other images");
    for timed in row["methods"].as_array().unwrap() {
        let agreement = &timed["agreement"];
        assert_eq!(agreement.is_null(), row["group"] == "colors");
        if !agreement.is_null() {
            assert_eq!(agreement["holds"], true, "{row}");
            let control = &agreement["control"];
            assert_eq!(control.is_null(), row["group"] != "patches");
            assert!(control.is_null() || control["caught"] == true, "{row}");
        }
    }
}

/// The CPU draws in both precisions, on one thread and on all.
fn check_methods(methods: &Value, least: usize) {
    let methods = methods.as_array().unwrap();
    assert!(methods.len() >= least);
    for way in ["cpu f64", "cpu f32"] {
        let timed = methods.iter().find(|timed| timed["method"] == way).expect("a way of the CPU");
        assert!(timed["gain"].as_f64() > Some(0.0), "{timed}");
        for threads in ["one", "all"] {
            let [least, median] = ["least", "median"].map(|key| &timed[threads]["core_ms"][key]);
            assert!(0.0 < least.as_f64().unwrap() && least.as_f64() <= median.as_f64());
        }
    }
}

/// Without a graphics driver the CPU is measured alone, and the report says why; a group of scenes
/// may be chosen.
#[cfg(target_os = "linux")]
#[test]
fn without_a_driver_the_cpu_is_measured() {
    let folder = tempfile::tempdir().unwrap();
    let words = "paper --scenes patches --quick --frames 1 --threads 2 --json";
    let output = command(folder.path(), words).envs(HIDDEN).output().unwrap();
    let paper: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(paper["machine"]["missing"].as_str().unwrap().contains("no graphics adapter"));
    let rows = paper["rows"].as_array().unwrap();
    assert_eq!((rows.len(), &paper["files"]), (4, &json!([])));
    for row in rows {
        check_scene(row);
        assert_eq!(row["methods"].as_array().unwrap().len(), 2);
    }
    let window = command(folder.path(), "window --quick").envs(HIDDEN).output().unwrap();
    assert!(!window.status.success() && window.stdout.is_empty());
}

#[test]
fn a_dataset_is_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let dataset = CrackRecipe::new(3, 5).dataset().unwrap();
    ppum_format::write(&dataset, &folder.path().join("plate.h5")).unwrap();
    let frames = report(folder.path(), "frames plate.h5 --quick --frames 2 --threads 2");
    assert_eq!(frames["patches"], dataset.steps[0].partition.len());
    check_methods(&frames["methods"], 2);
    let text = run(folder.path(), "frames plate.h5 --quick --frames 1");
    assert!(text.contains("256x192 pixels") && text.contains("\ncpu f32 "), "{text}");
    assert!(fail(folder.path(), "frames none.h5").contains("none.h5"));
}

/// The families are there; whether they gain enough is no matter of a test, on a busy machine and
/// of programs like this one.
#[test]
fn vectors_are_measured() {
    let output = command(Path::new("."), "guard --quick --json").output().unwrap();
    let guard: Value = serde_json::from_slice(&output.stdout).unwrap();
    let rows = guard["rows"].as_array().unwrap();
    if guard["wide"] == guard["narrow"] {
        return assert!(rows.is_empty() && output.status.success());
    }
    assert_eq!(rows.iter().filter(|row| row["is_control"] == true).count(), 1);
    for kernels in ["large cells, f64", "small cells, f32", "colours, f32", "values at points"] {
        let is_there = |row: &Value| row["kernels"].as_str().unwrap().contains(kernels);
        assert!(rows.iter().any(is_there), "{kernels}: {guard}");
    }
    for row in rows {
        let of = |key: &str| row[key].as_f64().unwrap();
        assert!((of("ratio") * of("wide_ms") / of("narrow_ms") - 1.0).abs() < 1e-12, "{row}");
        let is_above = of("ratio") >= of("floor");
        assert_eq!(row["holds"] == true, is_above != (row["is_control"] == true), "{row}");
    }
    assert_eq!(guard["holds"] == true, output.status.success());
}

#[test]
fn the_window_is_measured() {
    let window = report(Path::new("."), "window --quick --frames 3");
    assert_eq!(window["frames"], 3);
    for row in window["rows"].as_array().expect("rows") {
        let ms = |key: &str| row[key]["median"].as_f64().expect("a time");
        let parts = ["layout_ms", "image_ms", "upload_ms", "paint_ms"].map(ms);
        assert!(parts.iter().all(|part| *part >= 0.0) && ms("image_ms") > 0.0);
        assert!(row["frame_ms"]["most"].as_f64() >= row["frame_ms"]["least"].as_f64());
        assert_eq!(row["idle_repaints"], false, "at rest the window is not shown anew");
    }
}

#[test]
fn pages_need_their_marks() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("page.md"), "# Page\n").unwrap();
    let complaint = fail(folder.path(), "paper --page page.md");
    assert!(complaint.contains("<!-- begin ppum-bench paper -->"), "{complaint}");
    assert!(fail(folder.path(), "guard --page none.md").contains("none.md"));
    let page = "<!-- begin a -->\nold\n<!-- end a -->\nrest\n<!-- begin b --><!-- end b -->\n";
    let new = replaced(page, "a", "new\n").unwrap();
    let expected =
        "<!-- begin a -->\n\nnew\n\n<!-- end a -->\nrest\n<!-- begin b --><!-- end b -->\n";
    assert_eq!(new, expected);
    assert_eq!(replaced(&new, "a", "new").unwrap(), new);
}

#[test]
fn columns_stand_below_each_other() {
    let words = |row: [&str; 3]| row.map(str::to_owned).to_vec();
    let table = ReportTable {
        title: "Title".into(),
        words: 1,
        head: words(["cover", "patches", "none"]),
        rows: vec![words(["a", "16", ""]), words(["graded", "4", ""])],
        note: "A note.".into(),
    };
    let text = "\nTitle\ncover   patches\na            16\ngraded        4\nA note.\n";
    assert_eq!(table.text(), text);
    let page =
        "### Title\n\n| cover | patches |\n| --- | ---: |\n| a | 16 |\n| graded | 4 |\n\nA note.\n";
    assert_eq!(table.markdown(), page);
}
