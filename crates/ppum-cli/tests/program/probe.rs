use serde_json::{Value, json};

use crate::{CRACKED, LINEAR, Lab, keys, sound, with_formulas};

fn value(point: &Value, name: &str) -> f64 {
    point["values"][name].as_f64().unwrap_or_else(|| panic!("{name} in {point}"))
}

#[test]
fn values_of_known_fields() {
    let lab = Lab::solved(&sound());
    let report = lab.json("probe plate.h5 --at -0.5,0.25 --at 1,1");
    assert_eq!(keys(&report), ["points"]);
    for (point, at) in report["points"].as_array().unwrap().iter().zip([[-0.5, 0.25], [1.0, 1.0]]) {
        assert_eq!(keys(point), ["at", "side", "values"]);
        assert_eq!((&point["at"], &point["side"]), (&json!(at), &Value::Null));
        assert_eq!(keys(&point["values"]), ["sxx", "sxy", "syy", "ux", "uy", "von-mises"]);
        // plane strain under σ_yy = 1: σ_zz = ν
        let mises = (1.0f64 - 0.3 + 0.09).sqrt();
        for (name, exact) in [("sxx", 0.0), ("syy", 1.0), ("sxy", 0.0), ("von-mises", mises)] {
            assert!((value(point, name) - exact).abs() < 1e-9, "{name} {point}");
        }
    }
    let lab = Lab::solved(LINEAR);
    let report = lab.json("probe plate.h5 --at 0.5,0.125 -q u,du_dy --quantity error");
    let point = &report["points"][0];
    assert!((value(point, "u") - 0.75).abs() < 1e-10 && (value(point, "du_dy") - 2.0).abs() < 1e-9);
    assert!(value(point, "error") < 1e-10);
    assert_eq!(keys(&lab.json("probe plate.h5 --at 0,0")["points"][0]["values"]), ["u"]);
}

#[test]
fn both_sides_of_a_crack() {
    let lab = Lab::solved(CRACKED);
    let report = lab.json("probe plate.h5 --at 0.1,0 --at -0.1,1e-9 --at 0.6,0 -q uy");
    let points = report["points"].as_array().unwrap();
    let sides: Vec<_> = points.iter().map(|p| p["side"].as_str()).collect();
    assert_eq!(sides, [Some("above"), Some("below"), None, None]);
    // Griffith's opening of an infinite plate, 4 σ (1 − ν²) √(a² − x²) / E, is exceeded in a
    // small one
    let opening = value(&points[0], "uy") - value(&points[1], "uy");
    assert!(opening > 4.0 * 0.91 * 0.24f64.sqrt() && opening < 4.0, "{opening}");
    let text = lab.run("probe plate.h5 --at 0.1,0 -q uy");
    assert!(text.contains("above the crack") && text.contains("below the crack"), "{text}");
    // without -q cracks have the quantities of their faces, and other points do not
    let report = lab.json("probe plate.h5 --at 0.1,0 --at 0.6,0");
    let faces = ["normal-traction", "shear-traction", "opening", "sliding", "closed"];
    let [above, .., away] = &report["points"].as_array().unwrap()[..] else { panic!("{report}") };
    assert!(faces.iter().all(|name| keys(&above["values"]).iter().any(|key| key == name)));
    assert_eq!(value(above, "normal-traction"), value(above, "syy"));
    assert!((value(above, "opening") - opening).abs() < 1e-14 && value(above, "closed") == 0.0);
    assert!(away["values"].get("opening").is_none());
    let error = lab.fail("render plate.h5 -o plate.png -q closed");
    assert!(error.contains("on the faces of cracks only: sample or plot it"), "{error}");
}

/// The digits of points on an oblique crack are off it by some 1e-17, on either side.
#[test]
fn both_sides_of_an_oblique_crack() {
    let oblique = "points = [[-0.3, -0.1], [0.45, 0.15]]";
    let lab = Lab::solved(&CRACKED.replace("points = [[-0.5, 0.0], [0.5, 0.0]]", oblique));
    for (x, y) in [(0.15, 0.05), (0.06, 0.02), (0.21, 0.07), (0.33, 0.11), (-0.27, -0.09)] {
        let on = lab.json(&format!("probe plate.h5 --at {x},{y} -q uy"));
        let off = [1e-9, -1e-9].map(|d| format!("--at {},{}", x - d / 3.0, y + d));
        let off = lab.json(&format!("probe plate.h5 {} {} -q uy", off[0], off[1]));
        assert_eq!(on["points"].as_array().unwrap().len(), 2, "{on}");
        for (k, side) in ["above", "below"].into_iter().enumerate() {
            assert_eq!(on["points"][k]["side"], side);
            assert_eq!(off["points"][k]["side"], Value::Null);
            let [there, near] = [&on, &off].map(|r| value(&r["points"][k], "uy"));
            assert!((there - near).abs() < 1e-6, "{x} {y} {side}: {there} {near}");
        }
        let [above, below] = [0, 1].map(|k| value(&on["points"][k], "uy"));
        assert!(above - below > 0.1, "{above} {below}");
    }
}

/// √r σ is constant near a tip, from any distance down to 1e-100.
#[test]
fn offsets_are_not_rounded() {
    let lab = Lab::solved(CRACKED);
    let at = |r: f64| {
        let report = lab.json(&format!("probe plate.h5 --at 0.5,0 --offset 0,{r:e} -q syy"));
        let point = &report["points"][0];
        assert_eq!(keys(point), ["at", "offset", "side", "values"]);
        assert!((point["offset"][1].as_f64().unwrap() / r - 1.0).abs() < 1e-15);
        value(point, "syy") * r.sqrt()
    };
    let near = at(1e-14);
    for r in [1e-18, 1e-30, 1e-100] {
        assert!((at(r) / near - 1.0).abs() < 1e-6, "{r}: {} {near}", at(r));
    }
    // behind the tip, between the faces and on them
    let report = lab.json("probe plate.h5 --at 0.5,0 --offset -1e-20,0 -q uy");
    assert_eq!(report["points"][1]["side"], "below");
    let report = lab.json("probe plate.h5 --at 0.5,0 --offset -1e-20,1e-25 -q uy");
    assert_eq!(report["points"][0]["side"], Value::Null);
}

/// Formulas under the names they were given, commas inside of them and files included.
#[test]
fn formulas() {
    let lab = Lab::solved(&with_formulas());
    lab.write("slip.txt", "sqrt(ux^2 + uy^2) # of both faces\n");
    let list = "max(sxx, syy), hypot(ux, uy),@slip.txt";
    let report =
        lab.json_with("probe plate.h5 --at 0.3,0.2 -q sxx,syy,magnitude,stretch", &["-q", list]);
    let point = &report["points"][0];
    let expected = "@slip.txt hypot(ux, uy) magnitude max(sxx, syy) stretch sxx syy";
    assert_eq!(keys(&point["values"]).join(" "), expected);
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-14 * b.abs();
    assert_eq!(value(point, "max(sxx, syy)"), value(point, "sxx").max(value(point, "syy")));
    let magnitude = value(point, "magnitude");
    for (name, factor) in [("hypot(ux, uy)", 1.0), ("@slip.txt", 1.0), ("stretch", 2.0)] {
        assert!(near(value(point, name), factor * magnitude), "{name} {point}");
    }
    // at a tip there are values, but no slopes
    let report = lab.json_with("probe plate.h5 --at 0.5,0", &["-q", "2*sxx,ux^2"]);
    let values = &report["points"][0]["values"];
    assert_eq!(values["2*sxx"], "inf");
    assert!(values["ux^2"].is_f64());
}

#[test]
fn infinite_and_undefined_values() {
    let lab = Lab::solved(CRACKED);
    let report = lab.json("probe plate.h5 --at 0.5,0 --at 2,0 -q uy,von-mises");
    let [tip, outside] = [0, 1].map(|k| &report["points"][k]);
    assert_eq!((&tip["side"], &tip["values"]["von-mises"]), (&Value::Null, &json!("inf")));
    assert!(tip["values"]["uy"].is_f64());
    assert_eq!(outside["values"], json!({ "uy": null, "von-mises": null }));
    let text = lab.run("probe plate.h5 --at 0.5,0 --at 2,0 -q uy,von-mises");
    assert!(text.contains("inf") && text.contains("(2.0, 0.0): outside the domain"), "{text}");
}

/// On an interface of the material the values are those of one side, and the words say so; with an
/// offset they are those of its side.
#[test]
fn interfaces_are_told() {
    let lab = Lab::solved(&CRACKED.replace("young = 1.0", "young = \"if(x < 0.25, 1, 2)\""));
    let told = |at: &str| lab.run(&format!("probe plate.h5 -q syy --at {at}"));
    assert!(told("0.25,0.3").contains("on a material interface"));
    assert!(!told("0.25,0.3 --offset 1e-12,0").contains("interface"));
    assert!(!told("0.2,0.3").contains("interface"));
}
