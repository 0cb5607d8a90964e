use serde_json::{Value, json};

use crate::{CRACKED, LINEAR, Lab, keys, sound, with_formulas};

#[test]
fn tells_what_is_inside() {
    let text = Lab::solved(CRACKED).run("info plate.h5");
    for word in ["Small plate", "elasticity", "plane-strain", "level 3", "order 1", "von-mises"] {
        assert!(text.contains(word), "{word}: {text}");
    }
}

#[test]
fn json_has_the_documented_shape() {
    let lab = Lab::solved(CRACKED);
    let info = lab.json("info plate.h5");
    assert_eq!(
        keys(&info),
        [
            "count",
            "domain",
            "equation",
            "file",
            "program",
            "quantities",
            "steps",
            "tables",
            "title"
        ]
    );
    assert_eq!(info["domain"], json!({ "min": [-1.0, -1.0], "max": [1.0, 1.0], "holes": [] }));
    let elasticity =
        json!({ "kind": "elasticity", "young": 1.0, "poisson": 0.3, "state": "plane-strain" });
    assert_eq!(info["equation"], elasticity);
    let step = &info["steps"][0];
    let expected = "attributes cell_values cells cracks energy face_quantities fields functions growth history intensities levels load \
                    orders patches points quantities reactions solver step tips unknowns warnings weight weight_breakpoints \
                    weight_formula";
    assert_eq!(keys(step).join(" "), expected);
    let crack = json!([{ "points": [[-0.5, 0.0], [0.5, 0.0]], "ends": ["tip", "tip"] }]);
    assert_eq!(step["cracks"], crack);
    assert_eq!(step["tips"][1], json!({ "crack": 0, "end": "end", "at": [0.5, 0.0] }));
    let cells = step["levels"].as_array().unwrap().iter().map(|l| l["cells"].as_u64().unwrap());
    assert_eq!(cells.sum::<u64>(), step["patches"].as_u64().unwrap());
    assert_eq!(
        step["functions"].as_array().unwrap().len(),
        12,
        "1, side, 2 × 4 at the tips, 2 slivers"
    );
    assert_eq!(keys(&step["functions"][0]), ["blocks", "kind", "name"]);
    assert_eq!(keys(&step["functions"][1]), ["blocks", "crack", "kind", "name"]);
    assert_eq!((&step["weight"], &step["weight_formula"]), (&json!("linear"), &json!("1 - t")));
    assert_eq!(step["weight_breakpoints"], json!([0.0]));
    assert_eq!(step["functions"][0]["blocks"], step["patches"]);
    assert_eq!(step["fields"][0]["components"], json!(["ux", "uy"]));
    let quantities = step["quantities"].as_array().unwrap();
    assert!(quantities.contains(&json!("tresca")) && !quantities.contains(&json!("error")));
    let history = step["history"].as_array().unwrap();
    let unknowns = history.iter().find(|r| r["name"] == "unknowns").unwrap();
    assert_eq!(unknowns["value"].as_f64(), step["unknowns"].as_f64());
    let solver = &step["intensities"];
    assert_eq!(solver, &lab.json("sif plate.h5")["tips"], "stored and computed are the same");
}

/// The solver's numbers are those of the history, in JSON and in words.
#[test]
fn the_solver_is_told() {
    let lab = Lab::new();
    let large = CRACKED.replace("level = 3", "level = 4").replace("order = 1", "order = 2");
    assert_ne!(large, CRACKED);
    lab.write("plate.toml", &format!("{large}\n[solver]\nkind = \"multilevel\"\n"));
    lab.run("solve plate.toml");
    let step = &lab.json("info plate.h5")["steps"][0];
    let (solver, history) = (&step["solver"], step["history"].as_array().unwrap());
    let record = |name: &str, unit: &str| {
        let found = history.iter().find(|r| r["name"] == name && r["unit"] == unit);
        found.map(|r| r["value"].clone()).unwrap_or_default()
    };
    assert_eq!(solver["kind"], "multilevel");
    for (key, name, unit) in [
        ("iterations", "iterations", ""),
        ("condition", "preconditioned condition", ""),
        ("residual", "residual", ""),
        ("bytes", "solver memory", "B"),
    ] {
        assert!(solver[key].is_number() && solver[key] == record(name, unit), "{key}: {solver}");
    }
    let steps = solver["iterations"].as_f64().unwrap();
    assert_eq!(solver["reduction"], record(&format!("iteration {steps}"), ""));
    let phases = solver["phases"].as_array().unwrap();
    assert_eq!(phases.len(), 6);
    assert_eq!(phases[0]["unknowns"], record("unknowns", ""));
    assert_eq!((&phases[3]["name"], &phases[3]["bytes"]), (&json!("solution"), &solver["bytes"]));
    let levels = solver["levels"].as_array().unwrap();
    assert!(levels.len() > 1 && levels[0]["unknowns"].as_f64() > levels[1]["unknowns"].as_f64());
    let text = lab.run("info plate.h5");
    for part in [
        format!("solver       multilevel, {} levels, {steps} steps to ", levels.len()),
        "\nphase         seconds          MB    unknowns\ncover ".into(),
        "\nlevel     patches    unknowns      values          MB\n0 ".into(),
    ] {
        assert!(text.contains(&part), "{part}: {text}");
    }
    assert!(!text.contains("iteration 1") && !text.contains("level 0"), "{text}");
    // of a file that does not tell there is nothing to say
    let mut dataset = ppum_format::read(&lab.path("plate.h5")).unwrap();
    dataset.steps[0].history.clear();
    ppum_format::write(&dataset, &lab.path("bare.h5")).unwrap();
    assert!(lab.json("info bare.h5")["steps"][0]["solver"].is_null());
    assert!(!lab.run("info bare.h5").contains("solver"));
}

/// What the solver tells of patches has a picture.
#[test]
fn values_of_patches_are_drawn() {
    let lab = Lab::solved(CRACKED);
    let names = &lab.json("info plate.h5")["steps"][0]["cell_values"];
    for name in ["cut-off", "least-eigenvalue", "quadrature-points", "assembly-seconds"] {
        assert!(names.as_array().unwrap().contains(&json!(name)), "{names}");
        lab.run(&format!("render plate.h5 -o a.png -q {name} --figure --size 500x400"));
    }
}

#[test]
fn formulas_are_told() {
    let lab = Lab::solved(&with_formulas());
    let info = lab.json("info plate.h5");
    assert_eq!(info["equation"]["young"], "table(modulus, x)");
    let stretch =
        json!([{ "name": "stretch", "formula": "hypot(ux, uy)*2  # twice", "unit": "mm" }]);
    assert_eq!(info["quantities"], stretch);
    let table = json!({ "name": "modulus", "x": [-2.0, 2.0], "y": [], "values": [1.0, 3.0] });
    assert_eq!(info["tables"], json!([table]));
    let step = &info["steps"][0];
    assert_eq!((&step["weight"], &step["weight_breakpoints"]), (&json!("formula"), &json!([0.0])));
    assert_eq!(step["weight_formula"], "(1 - t)^2*(1 + 2*t)");
    assert!(step["quantities"].as_array().unwrap().contains(&json!("stretch")));
    let functions = step["functions"].as_array().unwrap();
    let corner = functions.iter().find(|f| f["name"] == "corner 2 at [0.5, 0.75]").unwrap();
    let expected = "blocks declared formula frame kind name parameters role";
    assert_eq!(keys(corner).join(" "), expected);
    assert_eq!(corner["formula"], "r^lambda*sin(lambda*theta)");
    assert_eq!(corner["frame"], json!({ "kind": "fixed", "origin": [0.5, 0.75], "angle": 0.0 }));
    assert_eq!(corner["parameters"], json!([{ "name": "lambda", "value": 0.6 }]));
    assert_eq!(corner["declared"], json!({ "kinks": [], "singular": [[0.0, 0.0]] }));
    let tip = functions.iter().find(|f| f["name"] == "westergaard 1 of crack 0 end").unwrap();
    assert_eq!(tip["frame"], json!({ "kind": "tip", "crack": 0, "end": "end" }));
    assert_eq!([&tip["role"], &corner["role"]], ["tip", "user"]);
    let text = lab.run("info plate.h5");
    for part in [
        "E table(modulus, x)",
        "modulus(x): 2 knots from -2 to 2",
        "stretch [mm] = hypot(ux, uy)*2\n",
        "(1 - t)^2*(1 + 2*t), breakpoints 0",
        "2–9    westergaard 1–4 at 2 tips in ",
        "10–11  corner 1–2 at [0.5, 0.75] in ",
        "r^lambda*cos(lambda*theta), lambda = 0.6",
        "12     kink along [-1, -0.5] to [1, -0.5] in ",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

/// ½ ∫ σ:ε and ½ ∫ κ |∇u|² of known solutions.
#[test]
fn the_energy_is_told() {
    let energy = |problem: &str| {
        let lab = Lab::solved(problem);
        assert!(lab.run("info plate.h5").contains("energy "));
        lab.json("info plate.h5")["steps"][0]["energy"].as_f64().unwrap()
    };
    // σ_yy = 1 in plane strain over an area of 4: ε_yy = (1 − ν²)/E
    assert!((energy(&sound()) - 0.5 * 0.91 * 4.0).abs() < 1e-9);
    // ∇u = (1, 2) over an area of 2
    assert!((energy(LINEAR) - 5.0).abs() < 1e-9);
}

/// Moments about the middle of each support, whatever holds it: they differ by the moment of
/// the force.
#[test]
fn moments_are_told_about_the_supports_too() {
    let held = "on = { edge = \"bottom\", from = -0.5, to = 1.0 }\ndisplacement = [0.0, 0.0]";
    let lab = Lab::solved(&CRACKED.replace("on = \"bottom\"\ntraction = [0.0, -1.0]", held));
    let reaction = &lab.json("info plate.h5")["steps"][0]["reactions"][0];
    assert_eq!(
        keys(reaction),
        ["about", "center", "force", "held", "moment", "moment_about_center", "on"]
    );
    assert_eq!(
        (&reaction["about"], &reaction["center"]),
        (&json!([0.0, 0.0]), &json!([0.25, -1.0]))
    );
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let own = number(&reaction["moment_about_center"]);
    // the load is 2, upwards at x = 0: in equilibrium the support exerts −2, and turns against 2 ·
    // 0.25
    assert!((number(&reaction["force"][1]) + 2.0).abs() < 1e-9, "{reaction}");
    assert!((own - 0.5).abs() < 1e-9 && number(&reaction["moment"]).abs() < 1e-9, "{reaction}");
    let text = lab.run("info plate.h5");
    let line = "force (0, -2.00000), moment 0 about (0, 0), 0.500000 about its middle (0.25, -1)";
    assert!(text.contains(line), "{text}");
    let plane = Lab::solved(LINEAR).json("info plate.h5");
    assert_eq!(plane["steps"][0]["reactions"][0]["center"], json!(null));
}

#[test]
fn a_known_solution_adds_the_error() {
    let info = Lab::solved(LINEAR).json("info plate.h5");
    assert_eq!(info["equation"], json!({ "kind": "poisson", "conductivity": 1.0 }));
    let step = &info["steps"][0];
    assert_eq!(step["fields"][0]["exact"], json!(["x + 2*y"]));
    assert!(step["quantities"].as_array().unwrap().contains(&json!("error")));
    assert!(!step["quantities"].as_array().unwrap().contains(&json!("sxx")));
}

/// Of a linear potential the extrema are at corners; of stresses at a tip.
#[test]
fn extrema_have_places() {
    let lab = Lab::solved(LINEAR);
    let told = lab.run("info plate.h5 --extrema u");
    assert_eq!(told, "min  0  at (0, 0), on the border\nmax  4  at (2, 1), on the border\n");
    let json: Value = serde_json::from_str(&lab.run("info plate.h5 --extrema u --json")).unwrap();
    assert_eq!((&json["quantity"], &json["max"]["on"]), (&json!("u"), &json!("border")));
    assert!((json["max"]["value"].as_f64().unwrap() - 4.0).abs() < 1e-9);
    let cracked = Lab::solved(CRACKED);
    let told = cracked.run("info plate.h5 --extrema syy");
    assert!(told.contains("max  ∞  at (") && told.contains("infinite at (0.5, 0) (tip)"), "{told}");
    assert!(lab.fail("info plate.h5 --extrema nonsense").contains("nonsense"));
}
