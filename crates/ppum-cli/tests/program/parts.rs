//! Parts of a field.

use serde_json::Value;

use crate::{CRACKED, LINEAR, Lab, Png};

fn value(row: &Value, name: &str) -> f64 {
    row["values"][name].as_f64().unwrap()
}

/// On the crack, which has no tip function in the middle, the smooth part has no jump; the jump
/// part is all of it, and changes its sign. The parts add up.
#[test]
fn smooth_and_jump_on_the_crack() {
    let lab = Lab::solved(CRACKED);
    let probe = |part: &[&str]| {
        let report = lab.json_with("probe plate.h5 --at 0.015625,0 -q uy,duy_dy", part);
        let points = report["points"].as_array().unwrap().clone();
        assert_eq!(points.len(), 2);
        points
    };
    let whole = probe(&[]);
    let parts = ["smooth", "jump", "tip"].map(|part| probe(&["--part", part]));
    for (side, whole) in whole.iter().enumerate() {
        for name in ["uy", "duy_dy"] {
            let sum: f64 = parts.iter().map(|part| value(&part[side], name)).sum();
            assert!((sum - value(whole, name)).abs() < 1e-10, "{name}: {sum}");
        }
    }
    let [smooth, jump, _] = &parts;
    assert_eq!(value(&smooth[0], "uy"), value(&smooth[1], "uy"));
    let [above, below] = [0, 1].map(|side| value(&jump[side], "uy"));
    // but for patches of which the crack cuts slivers off: of their jumps one side is zero
    assert!(above > 0.1 && (above + below).abs() < 1e-11, "{above} {below}");
}

/// `sample` sees the part as well: φ_0 v_0 of the linear field is zero away from patch 0.
#[test]
fn one_patch() {
    let lab = Lab::solved(LINEAR);
    let table = lab.run("sample plate.h5 --line 0,0.125,2,0.125 --count 5 -q u --part patch:0");
    let values: Vec<f64> =
        table.lines().skip(1).map(|row| row.rsplit(',').next().unwrap().parse().unwrap()).collect();
    assert_eq!(values.len(), 5);
    // u = x + 2y, φ_0 = 1 at x = 0 and 0.5, 1/2 between the two cells
    for (found, exact) in values.iter().zip([0.25, 0.75, 0.625, 0.0, 0.0]) {
        assert!((found - exact).abs() < 1e-12, "{values:?}");
    }
}

#[test]
fn pictures_tell_the_part() {
    let lab = Lab::solved(CRACKED);
    let draw = |more: &str| {
        lab.run(&format!("render plate.h5 -o a.png -q uy --size 60x60 --range=-4,4 {more}"));
        Png::read(&lab.path("a.png"))
    };
    let jump = draw("--part jump");
    assert_eq!(jump.text("ppum:part"), "jump");
    assert_ne!(jump.rgba, draw("").rgba);
    // far from the crack no block is left: u = 0 is the middle of the range
    let (corner, zero) = (jump.pixel(1, 1), draw("--part patch:0").pixel(58, 1));
    assert_eq!(corner, zero);
    assert_eq!(draw("--part tip").text("ppum:part"), "tip");
}

#[test]
fn mistakes() {
    let lab = Lab::solved(LINEAR);
    for (part, hint) in [
        (
            "jump",
            "--part: field `potential` has no block of the part `jump`; the kinds that it has are smooth",
        ),
        ("patch:99999", "--part: there is no patch 99999; the field has"),
        ("crack", "there is no part `crack`; there are smooth, jump"),
    ] {
        for command in ["probe plate.h5 --at 0,0.1", "render plate.h5 -o a.png"] {
            let complaint = lab.fail_with(command, &["--part", part]);
            assert!(complaint.contains(hint), "{part}: {complaint}");
        }
    }
}
