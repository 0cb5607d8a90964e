use serde_json::Value;

use crate::figures::read;
use crate::{CRACKED, LINEAR, Lab, Png, keys};

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// u = x + 2y over [0, 2] × [0, 1]: bilinear and bicubic interpolation reproduce it; nearest errs
/// by up to half the spacing in each direction, (1 + 1)/2 of 1/32 and 2/32 with 65 × 17 points.
#[test]
fn errors_of_a_plane_are_those_of_theory() {
    let lab = Lab::solved(LINEAR);
    let arguments = "compare plate.h5 -q u --grid 65x17 --method all --error 0.1";
    let report = lab.json(arguments);
    let rows = report["resampled"].as_array().unwrap();
    let methods: Vec<_> = rows.iter().map(|row| row["method"].as_str().unwrap()).collect();
    assert_eq!(methods, ["nearest", "bilinear", "bicubic", "cells"]);
    assert_eq!(rows[0]["grid"], serde_json::json!([65, 17]));
    assert_eq!(rows[0]["bytes"], 8 * 65 * 17);
    assert!(rows[3]["grid"].is_null() && rows[3]["needed"].is_null());
    for row in rows {
        let absolute = numbers(&row["absolute"]);
        let most = match row["method"].as_str().unwrap() {
            "nearest" => 0.5 / 32.0 + 0.5 * 2.0 / 16.0,
            // 2 × 2 cells of 1 × 1/2
            "cells" => 0.5 + 0.25 * 2.0,
            _ => 1e-9,
        };
        let least = if most > 1e-3 { 0.9 * most } else { 0.0 };
        assert!((least..=most).contains(&absolute[2]), "{row}");
        assert!(absolute[0] <= absolute[1] && absolute[1] <= absolute[2], "{row}");
        assert_eq!((&row["lost"], &row["invented"]), (&0.into(), &0.into()));
    }
    assert_eq!(rows[1]["needed"]["grids"][2]["kind"], "measured");
    assert_eq!(
        keys(&report),
        ["center", "direct", "file", "pixels", "quantity", "resampled", "width"]
    );
    let text = lab.run(arguments);
    assert!(text.contains("bicubic, 65×17") && text.contains("a relative error of 0.1"), "{text}");
}

/// One bar for the field and what was resampled, one for each difference.
#[test]
fn pictures_are_figures_of_panels() {
    let lab = Lab::solved(CRACKED);
    let told = lab.run("compare plate.h5 -o a.png --grid 16 --size 1200x400");
    assert!(told.starts_with("wrote a.png: 1200x400 pixels, direct: colours from"), "{told}");
    let png = Png::read(&lab.path("a.png"));
    assert_eq!(png.size, [1200, 400]);
    assert_eq!(png.text("ppum:resampled"), "bilinear, 16×16");
    assert_eq!(png.text("ppum:quantity"), "von-mises");
    let images = |arguments: &str| {
        lab.run(&format!("compare plate.h5 -o a.svg --grid 16 {arguments}"));
        let svg = read(&lab, "a.svg");
        for caption in [">(a) ", ">(b) ", ">(c) "] {
            assert_eq!(svg.matches(caption).count(), 1, "{arguments}: {caption}");
        }
        svg.matches("<image ").count()
    };
    // pictures on their grounds, and bars
    assert_eq!(images("--labels bar=q"), 2 * 3 + 2);
    assert_eq!(images("--method nearest,cells,nearest -q uy --tip 0"), 2 * 5 + 3);
    assert_eq!(images("--view -1,-0.1,1,0.1 --method nearest,bilinear --theme dark"), 2 * 5 + 3);
    lab.run("compare plate.h5 -o a.pdf --inches 9x3.2 --font-size 8");
    assert!(read(&lab, "a.pdf").contains("/MediaBox [0 0 648 230"));
    // JSON is alone on standard output
    assert_eq!(lab.json("compare plate.h5 -o a.svg --grid 16")["quantity"], "von-mises");
    assert_eq!(lab.files(), ["a.pdf", "a.png", "a.svg", "plate.h5", "plate.toml"]);
}

/// Numbers are the same on any number of threads.
#[test]
fn no_grid_is_enough_at_a_tip() {
    let lab = Lab::solved(CRACKED);
    let [a, b] = ["1", "2"].map(|threads| {
        let mut report = lab.json(&format!(
            "compare plate.h5 --grid 16 --error 1e-3 --tip 1 --over view --threads {threads}"
        ));
        let row = &mut report["resampled"][0];
        assert_eq!(row["needed"]["grids"][2]["reason"], "singular");
        assert_eq!(row["needed"]["grids"][2]["kind"], "none");
        (row["relative"].take(), row["needed"].take())
    });
    assert_eq!(a, b);
    let report = lab.json("compare plate.h5 -q uy --grid 16 --error 1e-3");
    assert_eq!(report["resampled"][0]["needed"]["grids"][2]["reason"], "jump");
}

#[test]
fn mistakes_are_told() {
    let lab = Lab::solved(LINEAR);
    for (arguments, part) in [
        ("compare plate.h5 --grid 1", "at least 2x2"),
        ("compare plate.h5 --grid 5x1", "at least 2x2"),
        ("compare plate.h5 --grid 65536x65536", "at most"),
        ("compare plate.h5 --grid x", "NXxNY"),
        ("compare plate.h5 --grid -3", "NXxNY"),
        ("compare plate.h5 --method cubic", "bicubic"),
        ("compare plate.h5 --error 0", "above zero"),
        ("compare plate.h5 --error x", "above zero"),
        ("compare plate.h5 -q strss", "no quantity"),
        ("compare plate.h5 --size 100x100", "no room"),
        ("compare plate.h5 --view 5,5,6,6", "nothing of the domain"),
        ("compare plate.h5 -o plate.h5", "would replace"),
        ("compare plate.h5 -o a.jpg", "PNG"),
        ("compare plate.h5 --size 9000x9000", "at most 67108864"),
        ("compare plate.h5 -o - --json", "standard output"),
        ("compare plate.h5 --tip 0", "no crack tips"),
        ("compare none.h5", "none.h5"),
    ] {
        let complaint = lab.fail(arguments);
        assert!(complaint.contains(part), "{arguments}: {complaint}");
        assert_eq!(lab.files(), ["plate.h5", "plate.toml"]);
    }
}
