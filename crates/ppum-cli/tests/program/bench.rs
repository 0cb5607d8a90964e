use serde_json::{Value, json};

use crate::{Lab, keys};

#[test]
fn phases_are_measured() {
    let report = Lab::new().json("bench solver --level 4 --threads 2");
    assert_eq!(report["threads"], 2);
    assert!(report["renderer"].is_null());
    let run = &report["solver"][0];
    assert_eq!(run["level"], 4);
    assert!(run["unknowns"].as_u64().unwrap() > 2 * 6 * 256);
    let phases = run["phases"].as_array().unwrap();
    let names: Vec<_> = phases.iter().map(|phase| phase["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["cover", "basis", "assembly", "solution", "intensity", "estimate"]);
    let sum: f64 = phases.iter().map(|phase| phase["seconds"].as_f64().unwrap()).sum();
    assert!(sum > 0.0 && (sum - run["seconds"].as_f64().unwrap()).abs() < 1e-12);
}

/// Two levels have a table and a picture, three a line through their times.
#[test]
fn times_grow_with_the_unknowns() {
    let lab = Lab::new();
    let report = lab.json("bench solver --level 6 --solver multilevel --threads 2 -o times.svg");
    let runs = report["solver"].as_array().unwrap();
    assert_eq!(runs.len(), 3);
    for run in runs {
        assert_eq!(run["kind"], "multilevel");
        assert!(run["bytes"].as_f64() > Some(0.0) && run["iterations"].as_f64() < Some(30.0));
    }
    for phases in ["all", "solution"] {
        let fit = &report["fit"][phases];
        let expected = ["exponent", "largest_deviation", "seconds", "seconds_per_unknown"];
        assert_eq!(keys(fit), expected);
    }
    let svg = std::fs::read_to_string(lab.path("times.svg")).unwrap();
    assert!(svg.contains("all phases, slope ") && svg.contains(">unknowns<"), "{svg}");
    let text = lab.run("bench solver --level 5 --solver direct");
    assert!(text.contains("bytes/unknown\n    4 ") && text.contains(" direct "), "{text}");
    assert!(!text.contains("exponent"), "two points are no fit: {text}");
    assert!(lab.fail("bench solver --level 4 -o a.png").contains("two levels"));
}

#[test]
fn tables_for_people() {
    let lab = Lab::new();
    let text = lab.run("bench --quick --frames 1");
    for part in ["level 4: ", "  assembly ", "  in all ", " unknowns/s"] {
        assert!(text.contains(part), "{text}");
    }
    for part in ["256x192 pixels", "\nuniform ", "\ngraded ", "cpu f32", "splat/gather", "2011"] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(lab.fail("bench --level 11").contains("11 is not in 4..=10"));
    assert!(lab.fail("bench gpu").contains("renderer"));
}

/// The shape of the report, and that times are times.
fn check(report: &Value, methods: &[&str]) {
    assert_eq!(keys(report), ["renderer", "solver", "threads"]);
    assert_eq!(report["solver"], json!([]));
    let renderer = &report["renderer"];
    let expected = ["adapter", "frames", "gather_growth", "missing", "pixels", "rows"];
    assert_eq!(keys(renderer), expected);
    assert_eq!((&renderer["frames"], &renderer["pixels"]), (&json!(2), &json!([256, 192])));
    let rows = renderer["rows"].as_array().unwrap();
    let uniform = rows.iter().filter(|row| row["cover"] == "uniform");
    let patches: Vec<_> = uniform.map(|row| row["patches"].as_u64().unwrap()).collect();
    assert_eq!(patches, [16, 64, 256]);
    assert_eq!(rows.last().unwrap()["cover"], "graded");
    for row in rows {
        let timed = row["methods"].as_array().unwrap();
        let names: Vec<_> = timed.iter().map(|t| t["method"].as_str().unwrap()).collect();
        assert_eq!(names, methods);
        for times in timed.iter().flat_map(|t| [&t["wall_ms"], &t["core_ms"]]) {
            if !times.is_null() {
                let [least, median] = ["least", "median"].map(|key| times[key].as_f64().unwrap());
                assert!(0.0 <= least && least <= median, "{times}");
            }
        }
        assert_eq!(row["splat_over_gather"].is_null(), !methods.contains(&"splat"));
        assert!(row["paper_ms"].is_null(), "these are other pictures");
    }
}

#[test]
fn renderers_are_measured() {
    let lab = Lab::new();
    let adapters = lab.json("info --gpu")["adapters"].clone();
    let report = lab.json("bench renderer --quick --frames 2");
    let all: &[&str] =
        match adapters.as_array().unwrap().iter().find(|row| row["taken_by"] != json!([])) {
            None => &["cpu f64", "cpu f32"],
            Some(row) if row["splat"] == false => &["gather", "cpu f64", "cpu f32"],
            Some(_) => &["splat", "gather", "cpu f64", "cpu f32"],
        };
    check(&report, all);
    assert_eq!(report["renderer"]["adapter"].is_null(), adapters == json!([]));
}

#[cfg(target_os = "linux")]
#[test]
fn without_an_adapter_the_cpu_is_measured() {
    let lab = Lab::new();
    let (code, text, complaint) = lab.without_driver("bench renderer --quick --frames 2 --json");
    assert_eq!((code, complaint.as_str()), (Some(0), ""));
    let report: Value = serde_json::from_str(&text).unwrap();
    check(&report, &["cpu f64", "cpu f32"]);
    assert!(report["renderer"]["missing"].as_str().unwrap().contains("no graphics adapter"));
}

#[cfg(not(feature = "window"))]
#[test]
fn without_the_window_there_is_nothing_to_measure() {
    assert!(Lab::new().fail("bench window").contains("--features window"));
}

#[cfg(feature = "window")]
#[test]
fn the_window_is_measured() {
    let lab = Lab::new();
    let (code, text, complaint) = lab.without_driver("bench window --quick");
    assert!(code != Some(0) && text.is_empty() && complaint.contains("mesa-vulkan-drivers"));
    let report = lab.json("bench window --quick --frames 3");
    let window = &report["window"];
    assert_eq!(window["frames"], 3);
    for row in window["rows"].as_array().expect("rows") {
        let ms = |key: &str| row[key]["median"].as_f64().expect("a time");
        let parts = ["layout_ms", "picture_ms", "upload_ms", "paint_ms"].map(ms);
        assert!(parts.iter().all(|part| *part >= 0.0) && ms("picture_ms") > 0.0);
        assert!(row["frame_ms"]["most"].as_f64() >= row["frame_ms"]["least"].as_f64());
        assert_eq!(row["idle_repaints"], false, "at rest the window is not shown anew");
    }
}
