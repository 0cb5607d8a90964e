//! Commands on files of several steps: which step they tell of, and what they read of the others.

use std::fs;

use ppum::crack::{CrackEnd, End, TipId};
use ppum::dataset::{Dataset, Growth, GrowthStop, TipIncrement, TipIntensity, TipStatus};
use ppum_testkit::synthetic::growing;
use serde_json::json;

use crate::{CRACKED, Lab};

/// A crack that grows, with K_I = 1 + k/4 and K_II = −k/8 in step k.
fn grown(steps: usize) -> Dataset {
    let mut dataset = growing(steps);
    for (k, step) in dataset.steps.iter_mut().enumerate() {
        let tip = TipId { crack: 0, end: End::Last };
        step.intensities = vec![TipIntensity::new(tip, 1.0 + 0.25 * k as f64, -0.125 * k as f64)];
    }
    dataset
}

/// A folder with a series `growth.h5`.
fn with(dataset: &Dataset) -> Lab {
    let lab = Lab::new();
    ppum_format::write(dataset, &lab.path("growth.h5")).unwrap();
    lab
}

#[test]
fn info_tells_of_one_step() {
    let lab = with(&grown(5));
    for (arguments, step, load) in [("", 4, 1.0), ("--step 0", 0, 0.0), ("--step 2", 2, 0.5)] {
        let info = lab.json(&format!("info growth.h5 {arguments}"));
        let told = &info["steps"][0];
        assert_eq!(
            (&info["count"], &told["step"], &told["load"]),
            (&json!(5), &json!(step), &json!(load))
        );
        assert_eq!(info["steps"].as_array().unwrap().len(), 1);
        assert_eq!(told["intensities"][0]["k1"], json!(1.0 + 0.25 * f64::from(step)));
        assert_eq!(info.get("series"), None);
    }
    let text = lab.run("info growth.h5 --step 3");
    assert!(text.contains("steps        5, numbered from 0"), "{text}");
    assert!(text.contains("step         3, load 0.75"), "{text}");
    let complaint = lab.fail("info growth.h5 --step 5");
    assert!(
        complaint.contains("there is no step 5") || complaint.contains("5 steps"),
        "{complaint}"
    );
}

#[test]
fn info_lists_the_steps() {
    let dataset = grown(5);
    let lab = with(&dataset);
    let rows = &lab.json("info growth.h5 --steps")["series"];
    for (k, step) in dataset.steps.iter().enumerate() {
        let row = &rows[k];
        assert_eq!((&row["step"], &row["load"]), (&json!(k), &json!(step.load)));
        let length = row["crack_length"].as_f64().unwrap();
        assert!((length - step.cracks[0].length()).abs() < 1e-15, "{length}");
        let [k1, k2] = [1.0 + 0.25 * k as f64, -0.125 * k as f64];
        assert_eq!(
            row["tips"],
            json!([{ "crack": 0, "end": "end", "k1": k1, "k2": k2, "k2_over_k1": k2 / k1 }])
        );
        assert!(row["growth"].is_null());
    }
    let text = lab.run("info growth.h5 --steps");
    let lines: Vec<Vec<&str>> =
        text.lines().map(|line| line.split_whitespace().collect()).collect();
    let head = lines
        .iter()
        .position(|line| line == &["step", "load", "unknowns", "length", "K_I", "K_II"]);
    let head = head.unwrap_or_else(|| panic!("{text}"));
    assert_eq!(lines.len(), head + 6, "{text}");
    assert_eq!(
        (lines[head + 3][..3].to_vec(), lines[head + 3][4]),
        (vec!["2", "0.5", "–"], "1.50000")
    );
    let alone = Lab::solved(CRACKED).fail("info plate.h5 --steps");
    assert!(alone.contains("there is one alone"), "{alone}");
}

/// Damage to the field of a step is seen by who reads it, and by nobody else.
#[test]
fn a_step_is_read_alone() {
    let dataset = grown(6);
    let lab = with(&dataset);
    let path = lab.path("growth.h5");
    let mut bytes = fs::read(&path).unwrap();
    let value = dataset.steps[2].fields[0].coefficients[0][1].to_le_bytes();
    let at = bytes.windows(8).position(|w| w == value).expect("it is stored plain");
    bytes[at] ^= 1;
    fs::write(&path, bytes).unwrap();
    let commands = [
        "probe growth.h5 --at 0.9,0.3 --step",
        "sample growth.h5 --line 0.3,-0.2,1.3,-0.2 --count 5 --step",
        "info growth.h5 --step",
        "plot growth.h5 --line 0.3,-0.2,1.3,-0.2 -o a.svg --step",
        "render growth.h5 -o a.png --size 8x8 --step",
        "compare growth.h5 --grid 8 --step",
    ];
    for command in commands {
        lab.run(&format!("{command} 1"));
        let complaint = lab.fail(&format!("{command} 2"));
        assert!(complaint.contains("steps/0002@sha256"), "{command}: {complaint}");
    }
    lab.run("render growth.h5 -o a.gif --size 8x8 --steps 3..");
    assert!(
        lab.fail("render growth.h5 -o a.gif --size 8x8 --steps all").contains("steps/0002@sha256")
    );
    // neither field nor checksum
    assert_eq!(lab.json("sif growth.h5")["tips"].as_array().unwrap().len(), 6);
    assert_eq!(lab.json("info growth.h5 --steps")["series"].as_array().unwrap().len(), 6);
    lab.run("plot growth.h5 --series -o a.svg");
    assert!(lab.fail("sif growth.h5 --recompute").contains("steps/0002@sha256"));
}

#[test]
fn sif_tells_of_all_steps() {
    let dataset = grown(4);
    let lab = with(&dataset);
    let tips = &lab.json("sif growth.h5")["tips"];
    for (k, step) in dataset.steps.iter().enumerate() {
        let at = step.cracks[0].points[2];
        let tip = &tips[k];
        assert_eq!((&tip["step"], &tip["tip"]), (&json!(k), &json!([at.x, at.y])));
        assert_eq!(tip["k1"], json!(1.0 + 0.25 * k as f64));
    }
}

/// The points of the curves are where their numbers have them: in the order of steps, loads
/// and lengths.
#[test]
fn plots_over_steps() {
    let lab = with(&grown(5));
    let told = lab.run("plot growth.h5 --series -o a.svg");
    assert!(told.contains("K_I, K_II"), "{told}");
    let svg = fs::read_to_string(lab.path("a.svg")).unwrap();
    assert!(svg.contains(">step<") && svg.contains("stress intensity factor"), "{svg}");
    for (options, label, value) in [
        ("--over length -q k1", "crack length", "stress intensity factor"),
        ("--over load -q length", "load", "crack length"),
        ("-q load", "step", "load"),
    ] {
        lab.run(&format!("plot growth.h5 --series -o b.svg {options}"));
        let svg = fs::read_to_string(lab.path("b.svg")).unwrap();
        assert!(
            svg.contains(&format!(">{label}<")) && svg.contains(&format!(">{value}<")),
            "{options}"
        );
    }
    for (options, reason) in [
        ("-q ux", "draws k1, k2, load, length and extension, not `ux`"),
        ("--step 1", "--step"),
        ("--history --over load", "--"),
    ] {
        let complaint = lab.fail(&format!("plot growth.h5 --series -o c.svg {options}"));
        assert!(complaint.contains(reason), "{options}: {complaint}");
    }
    let alone = Lab::solved(CRACKED).fail("plot plate.h5 --series -o a.svg");
    assert!(alone.contains("there is one alone"), "{alone}");
    let mut bare = grown(3);
    bare.steps.iter_mut().for_each(|step| step.intensities.clear());
    let complaint = with(&bare).fail("plot growth.h5 --series -o a.svg");
    assert!(complaint.contains("no stress intensity factors"), "{complaint}");
}

/// A series of two tips with growth: the last end of crack 0 goes 0.5 each step and meets hole 3
/// after step 2; a second tip waits. 100 cycles a step.
fn with_growth() -> Dataset {
    let mut dataset = grown(4);
    for (k, step) in dataset.steps.iter_mut().enumerate() {
        let [last, start] = [End::Last, End::Start].map(|end| TipId { crack: 0, end });
        step.cracks[0].ends = [CrackEnd::Tip; 2];
        let mut way = TipIncrement::staying(
            last,
            if k == 2 { TipStatus::MeetsHole(3) } else { TipStatus::Grows },
        );
        (way.length, way.extension, way.direction) = (0.5, 0.5 * k as f64, 0.25);
        way.path = vec![ppum::vec2::vec2(0.5, 0.5)];
        let mut growth = Growth::default();
        growth.cycles = Some(100.0 * k as f64);
        growth.tips = vec![TipIncrement::staying(start, TipStatus::Waits)];
        if k < 3 {
            growth.tips.push(way);
        } else {
            growth.stop = Some(GrowthStop::AllHeld);
        }
        step.growth = Some(growth);
    }
    dataset
}

/// Each tip has a line with its fate, and the last line says what has ended the series.
#[test]
fn info_tells_how_cracks_grow() {
    let lab = with(&with_growth());
    let text = lab.run("info growth.h5 --steps");
    let lines: Vec<Vec<&str>> =
        text.lines().map(|line| line.split_whitespace().collect()).collect();
    let head = lines.iter().position(|line| line.first() == Some(&"step"));
    let head = head.unwrap_or_else(|| panic!("{text}"));
    let heads = "step load cycles unknowns length tip K_I K_II K_II/K_I grown by next";
    assert_eq!(lines[head].join(" "), heads);
    assert_eq!(lines[head + 5][..3], ["2", "0.666667", "200.000"], "{text}");
    assert_eq!(
        lines[head + 6].join(" "),
        "0 end 1.50000 -0.250000 -0.1667 1.00000 0.500000 at 14.32°, meets hole 3"
    );
    assert_eq!(lines[head + 7].last(), Some(&"waits"));
    assert_eq!(lines.last().unwrap().join(" "), "ended with step 3: no tip goes on");
    let rows = &lab.json("info growth.h5 --steps")["series"];
    let growth = &rows[2]["growth"];
    assert_eq!((&growth["cycles"], &growth["stop"]), (&json!(200.0), &json!(null)));
    let tip = &growth["tips"][1];
    assert_eq!((&tip["fate"], &tip["extension"]), (&json!("meets hole 3"), &json!(1.0)));
    assert_eq!(rows[3]["growth"]["stop"], "no tip goes on");
    assert_eq!(lab.json("info growth.h5 --step 2")["steps"][0]["growth"], *growth);
    let text = lab.run("info growth.h5 --step 2");
    assert!(text.contains("growth       after 200 cycles\n"), "{text}");
    assert!(
        text.contains(" crack 0 end: 0.500000 at 14.32°, meets hole 3; grown by 1.00000"),
        "{text}"
    );
    assert!(lab.run("info growth.h5").contains("ends here: no tip goes on"));
    // a run that was interrupted
    let mut part = with_growth();
    part.steps.truncate(2);
    assert!(with(&part).run("info growth.h5 --steps").contains("not ended by itself"));
}

/// Numbers of the polyline with most points, and of its places on the axes: curves of four points.
#[test]
fn plots_over_extensions_and_cycles() {
    let lab = with(&with_growth());
    for (options, label, value) in [
        ("--over extension -q k1", "crack extension", "stress intensity factor"),
        ("--over extension -q load", "crack extension", "load"),
        ("--over cycles -q length", "load cycles", "crack length"),
        ("--over cycles -q extension", "load cycles", "crack extension"),
    ] {
        lab.run(&format!("plot growth.h5 --series -o a.svg {options}"));
        let svg = fs::read_to_string(lab.path("a.svg")).unwrap();
        let is_named = |word: &str| svg.contains(&format!(">{word}<"));
        // cycles up to 300 and extensions up to 1.5 are labelled in hundreds or halves
        assert!(is_named(label) && is_named(value), "{options}: {svg}");
    }
    for (dataset, options, reason) in [
        (grown(3), "--over extension", "[growth]"),
        (grown(3), "-q extension", "[growth]"),
        (grown(3), "--over cycles", "paris"),
    ] {
        let complaint = with(&dataset).fail(&format!("plot growth.h5 --series -o c.svg {options}"));
        assert!(complaint.contains(reason) && complaint.contains("growth"), "{complaint}");
    }
}
