use serde_json::{Value, json};

use crate::{Lab, keys};

#[test]
fn phases_are_measured() {
    let report = Lab::new().json("bench solver --level 4 --solver multilevel --threads 2");
    assert_eq!(report["threads"], 2);
    assert!(report["renderer"].is_null());
    let run = &report["solver"][0];
    assert_eq!(run["level"], 4);
    assert!(run["unknowns"].as_u64().unwrap() > 2 * 6 * 256);
    assert_eq!(run["kind"], "multilevel");
    assert!(run["bytes"].as_f64() > Some(0.0) && run["iterations"].as_f64() < Some(30.0));
    let phases = run["phases"].as_array().unwrap();
    let names: Vec<_> = phases.iter().map(|phase| phase["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["cover", "basis", "assembly", "solution", "intensity", "estimate"]);
    let sum: f64 = phases.iter().map(|phase| phase["seconds"].as_f64().unwrap()).sum();
    assert!(sum > 0.0 && (sum - run["seconds"].as_f64().unwrap()).abs() < 1e-12);
}

/// Two levels have a table and a picture.
#[test]
fn times_grow_with_the_unknowns() {
    let lab = Lab::new();
    let text = lab.run("bench solver --level 5 --solver direct -o times.svg");
    assert!(text.contains("bytes/unknown\n    4 ") && text.contains(" direct "), "{text}");
    assert!(!text.contains("exponent"), "two points are no fit: {text}");
    let svg = std::fs::read_to_string(lab.path("times.svg")).unwrap();
    assert!(svg.contains("all phases, slope ") && svg.contains(">unknowns<"), "{svg}");
    assert!(lab.fail("bench solver --level 4 -o a.png").contains("two levels"));
}

/// Three levels have a line through their times.
#[test]
#[ignore = "slow: three levels are solved"]
fn times_of_three_levels_are_fitted() {
    let report = Lab::new().json("bench solver --level 6 --solver multilevel --threads 2");
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

/// All scenes are there, each by all that draws it; frames are right, and a wrong derivative is noticed in all of them.
#[test]
fn the_paper_is_measured() {
    let lab = Lab::new();
    let page = "# Page\n<!-- begin ppum bench paper -->\n<!-- end ppum bench paper -->\nrest\n";
    lab.write("page.md", page);
    let words = "bench paper --quick --frames 1 --threads 2 --page page.md -o chart.svg";
    let report = lab.json(words);
    let paper = &report["paper"];
    assert_eq!(keys(paper), ["files", "frames", "holds", "machine", "pixels", "rows"]);
    assert_eq!((&paper["holds"], &paper["machine"]["threads"]), (&json!(true), &json!(2)));
    let rows = paper["rows"].as_array().unwrap();
    let count = |group: &str| rows.iter().filter(|row| row["group"] == group).count();
    let groups = ["patches", "orders", "enriched", "zooms", "formulas", "colors"];
    assert_eq!(groups.map(count), [4, 12, 3, 5, 8, 1]);
    for row in rows {
        check_scene(row);
    }
    for file in paper["files"].as_array().unwrap() {
        let [open, first] = ["open_ms", "first_ms"].map(|key| file[key].as_f64().unwrap());
        assert!(0.0 < open && open < first && file["bytes"].as_u64() > Some(1000), "{file}");
    }
    let kept = std::fs::read_to_string(lab.path("page.md")).unwrap();
    assert!(kept.starts_with("# Page\n") && kept.ends_with("-->\nrest\n"), "{kept}");
    for part in ["| order 8 | graded |", "| zoom 1e12 |", "| exp, log, sin, atan |", "0 missed"] {
        assert!(kept.contains(part), "{part}: {kept}");
    }
    let chart = std::fs::read_to_string(lab.path("chart.svg")).unwrap();
    assert!(chart.contains(">patches<") && chart.contains("CPU f32, 1 thread"), "{chart}");
}

/// The ways of a scene, their times, and what they were compared with.
fn check_scene(row: &Value) {
    let methods = row["methods"].as_array().unwrap();
    for way in ["cpu f64", "cpu f32"] {
        let timed = methods.iter().find(|timed| timed["method"] == way).expect("a way of the CPU");
        assert!(timed["gain"].as_f64() > Some(0.0), "{timed}");
        for threads in ["one", "all"] {
            let [least, median] = ["least", "median"].map(|key| &timed[threads]["core_ms"][key]);
            assert!(0.0 < least.as_f64().unwrap() && least.as_f64() <= median.as_f64());
        }
        assert_eq!(timed["agreement"].is_null(), row["group"] == "colors");
    }
    for agreement in methods.iter().map(|timed| &timed["agreement"]).filter(|a| !a.is_null()) {
        assert_eq!(agreement["holds"], true, "{row}");
        assert_eq!(agreement["control"].is_null(), row["group"] != "patches");
        assert!(agreement["control"].is_null() || agreement["control"]["caught"] == true, "{row}");
    }
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let lab = Lab::new();
    lab.write("page.md", "# Page\n");
    assert!(lab.fail("bench paper --page page.md").contains("<!-- begin ppum bench paper -->"));
    assert!(lab.fail("bench guard --page none.md").contains("none.md"));
    assert!(lab.fail("bench solver --page page.md").contains("--page"));
    assert!(lab.fail("bench solver plate.h5").contains("bench renderer"));
    assert!(lab.fail("bench renderer plate.h5").contains("plate.h5"));
}

/// The families are there; whether they gain enough is no matter of a test, on a busy machine and of programs like this one.
#[test]
fn vectors_are_measured() {
    let output = Lab::new().command("bench guard --quick --json").output().unwrap();
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let guard = &report["guard"];
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

/// One's own dataset.
#[test]
fn a_dataset_is_drawn() {
    let lab = Lab::solved(include_str!("../../../../examples/edge-crack.toml"));
    let report = lab.json("bench renderer plate.h5 --quick --frames 1");
    let rows = report["renderer"]["rows"].as_array().unwrap();
    let info = lab.json("info plate.h5");
    assert_eq!(rows.len(), 1);
    assert_eq!(
        (&rows[0]["cover"], &rows[0]["patches"]),
        (&json!("file"), &info["steps"][0]["patches"])
    );
    let text = lab.run("bench renderer plate.h5 --quick --frames 1");
    assert!(text.contains("of the dataset's last step"), "{text}");
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
