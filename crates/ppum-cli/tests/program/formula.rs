#[cfg(feature = "gpu")]
use ppum_testkit::wgsl::Module;
use serde_json::{Value, json};

use crate::{CRACKED, LINEAR, Lab, keys, with_formulas};

/// The report of a formula that is the only one.
fn told(lab: &Lab, formula: &str, more: &str) -> Value {
    let report = lab.json_with(&format!("formula {more}"), &[formula]);
    assert_eq!(keys(&report), ["formulas"]);
    assert_eq!(report["formulas"].as_array().unwrap().len(), 1, "{report}");
    report["formulas"][0].clone()
}

fn values(row: &Value) -> Vec<f64> {
    let derivatives = row["derivatives"].as_array().unwrap();
    derivatives.iter().map(|d| d["value"].as_f64().unwrap_or_else(|| panic!("{d}"))).collect()
}

fn assert_near(found: &[f64], exact: &[f64]) {
    let near = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-14 * (1.0 + b.abs());
    assert_eq!(found.len(), exact.len());
    assert!(found.iter().zip(exact).all(near), "{found:?} {exact:?}");
}

#[test]
fn derivatives_are_right() {
    let lab = Lab::new();
    let row = told(&lab, "x^3*y + exp(2*y)", "--at x=-0.5,y=0.25");
    let by: Vec<_> = row["derivatives"].as_array().unwrap().iter().map(|d| &d["by"]).collect();
    let expected = json!([[], ["x"], ["y"], ["x", "x"], ["x", "y"], ["y", "y"]]);
    assert_eq!(json!(by), expected);
    let (x, y, e) = (-0.5f64, 0.25, 0.5f64.exp());
    let exact = [x * x * x * y + e, 3.0 * x * x * y, x * x * x + 2.0 * e, 6.0 * x * y];
    assert_near(&values(&row), &[&exact[..], &[3.0 * x * x, 4.0 * e]].concat());
    let row = told(&lab, "(1 - t)^2*(1 + 2*t)", "--at t=0.25");
    assert_near(&values(&row), &[0.84375, -1.125, -3.0]);
    let row = told(&lab, "a*x", "--at x=2,y=0 --parameter a=-3 --parameter b=1");
    assert_near(&values(&row)[..3], &[-6.0, -3.0, 0.0]);
    assert_eq!(
        row["parameters"],
        json!([{ "name": "a", "value": -3.0 }, { "name": "b", "value": 1.0 }])
    );
}

/// On the cut of θ the sign of y = 0 tells the side.
#[test]
fn polar_coordinates_follow() {
    let lab = Lab::new();
    for (y, sign) in [("0", 1.0), ("-0", -1.0)] {
        let row = told(&lab, "sqrt(r)*sin(theta/2) + theta", &format!("--at x=-0.25,y={y}"));
        let pi = std::f64::consts::PI;
        assert_near(&values(&row)[..1], &[sign * (0.5 + pi)]);
        assert_eq!((&row["at"]["r"], &row["at"]["theta"]), (&json!(0.25), &json!(sign * pi)));
    }
    let row = told(&lab, "1/r", "--at x=0,y=0");
    assert_eq!(row["derivatives"][0]["value"], "inf");
    assert_eq!(row["derivatives"][1]["value"], "-inf");
    assert_eq!(row["derivatives"][2]["value"], Value::Null, "0 · ∞");
}

/// The texts of the derivatives are formulas of the same values.
#[test]
fn derivatives_can_be_parsed() {
    let lab = Lab::new();
    let at = "--at x=-0.3,y=0.2";
    for text in ["sqrt(r)*sin(theta)*cos(theta/2)", "if(x < y, atan2(y, x), abs(x*y)^1.5)"] {
        let row = told(&lab, text, at);
        let derivatives = row["derivatives"].as_array().unwrap();
        for derivative in &derivatives[..3] {
            let again = told(&lab, derivative["text"].as_str().unwrap(), at);
            assert_eq!(derivative["value"], again["derivatives"][0]["value"], "{derivative}");
        }
    }
}

#[test]
fn json_has_the_documented_shape() {
    let lab = Lab::new();
    let row = told(&lab, "abs(x - 2*y)*sqrt(r)*cos(theta/2)", "");
    let expected = "derivatives jumps_with_theta kinks name of operations parameters singular_at_origin \
                    singularities text uses";
    assert_eq!(keys(&row).join(" "), expected);
    assert_eq!((&row["of"], &row["name"]), (&json!("plane"), &Value::Null));
    assert_eq!(row["uses"], json!(["x", "y", "r", "theta"]));
    assert_eq!(row["kinks"], json!([{ "zeros_of": "x - 2*y", "line": [1.0, -2.0, 0.0] }]));
    assert_eq!(row["singularities"], json!([{ "zeros_of": "r", "line": null }]));
    assert_eq!(
        (&row["singular_at_origin"], &row["jumps_with_theta"]),
        (&json!(true), &json!(true))
    );
    assert_eq!(keys(&row["derivatives"][0]), ["by", "text"]);
    let operations: Vec<u64> =
        row["operations"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).collect();
    assert!(
        operations.len() == 3 && operations.is_sorted() && operations[0] >= 8,
        "{operations:?}"
    );
    let row = told(&lab, "if(t < 1/4, 1, 2)", "--at t=0");
    assert_eq!(keys(&row).len(), 14, "{row}");
    assert_eq!(row["at"], json!({ "t": 0.0 }));
}

#[test]
fn weights_are_judged() {
    let lab = Lab::new();
    let row = told(&lab, "if(t < 1/4, 1, (4/3*(1 - t))^2)", "");
    assert_eq!((&row["of"], &row["breakpoints"]), (&json!("weight"), &json!([0.25])));
    assert_eq!(row.get("not_a_weight"), None);
    let row = told(&lab, "1 + t", "");
    assert!(row["not_a_weight"].as_str().unwrap().contains("2 at t = 1"), "{row}");
    let row = told(&lab, "1", "--of weight");
    assert!(row["not_a_weight"].as_str().unwrap().contains("1 at t = 1"), "{row}");
}

#[test]
fn names_of_the_library() {
    let lab = Lab::new();
    let rows =
        |name: &str| lab.json(&format!("formula {name}"))["formulas"].as_array().unwrap().clone();
    for (name, of, count) in [
        ("westergaard", "plane", 4),
        ("kink", "plane", 1),
        ("bump", "weight", 1),
        ("von-mises", "elasticity", 1),
        ("magnitude --of poisson", "poisson", 1),
    ] {
        let rows = rows(name);
        assert_eq!(rows.len(), count, "{name}");
        assert!(rows.iter().all(|row| row["of"] == of && row["name"].is_string()), "{name}");
    }
    assert_eq!(rows("westergaard")[2]["name"], "westergaard 3");
    // r^(5/2) cos(5θ/2) at θ = 0
    let row = &rows("williams --parameter n=5 --at x=4,y=0")[0];
    assert_near(&values(row)[..1], &[32.0]);
    let complaint = lab.fail("formula williams --parameter m=5");
    assert!(complaint.contains("no such parameter"), "{complaint}");
}

/// Everything listed is shown under its name.
#[test]
fn the_list_is_whole() {
    let lab = Lab::new();
    let text = lab.run("formula --list");
    let library = lab.json("formula --list")["library"].as_array().unwrap().clone();
    assert!(library.len() > 30, "{library:?}");
    for entry in &library {
        assert_eq!(keys(entry), ["about", "formulas", "name", "of", "parameters"]);
        let (name, of) = (entry["name"].as_str().unwrap(), entry["of"].as_str().unwrap());
        assert!(text.contains(name), "{name}");
        let shown = lab.json(&format!("formula {name} --of {of}"));
        let texts: Vec<_> =
            shown["formulas"].as_array().unwrap().iter().map(|row| &row["text"]).collect();
        assert_eq!(json!(texts), entry["formulas"], "{name}");
    }
    assert!(lab.fail("formula").contains("<FORMULA>"));
}

#[test]
fn what_a_formula_is_of() {
    let lab = Lab::new();
    for (formula, of) in [
        ("1 + x", "plane"),
        ("1 - t", "weight"),
        ("sxx - syy", "elasticity"),
        ("du_dx^2", "poisson"),
        ("1", "plane"),
    ] {
        assert_eq!(told(&lab, formula, "")["of"], of, "{formula}");
    }
}

/// The quantities of a dataset, its own included; von Mises' stress of a uniaxial one is its size.
#[test]
fn quantities_of_a_dataset() {
    let lab = Lab::solved(&with_formulas());
    let row = told(&lab, "stretch", "--of plate.h5 --at ux=3,uy=4");
    assert_eq!((&row["of"], &row["name"]), (&json!("plate.h5"), &json!("stretch")));
    assert_eq!(row["text"], "hypot(ux, uy)*2  # twice");
    assert_eq!((&row["uses"], values(&row)), (&json!(["ux", "uy"]), vec![10.0]));
    let strain = "mu=0.5,lambda=0,out_of_plane=0,dux_dx=-7,dux_dy=0,duy_dx=0,duy_dy=0";
    let row = told(
        &lab,
        "von_mises + table(modulus, stretch)",
        &format!("--of plate.h5 --at {strain},ux=1,uy=0"),
    );
    assert_near(&values(&row), &[7.0 + 3.0]);
    let complaint = lab.fail("formula stretch --of plate.h5 --at ux=1");
    assert!(complaint.contains("values of uy are missing"), "{complaint}");
    let complaint = lab.fail("formula overlap --of plate.h5");
    assert!(complaint.contains("has no formula"), "{complaint}");
    let lab = Lab::solved(LINEAR);
    assert!(lab.fail("formula sxx --of plate.h5").contains("unknown name `sxx`"));
}

#[test]
fn tables_and_files() {
    let lab = Lab::new();
    lab.write("k.csv", "# knots and values\n0,1\n2,5\n");
    lab.write("grid.csv", ",0,1\n0,0,2\n1,4,6\n");
    lab.write("f.txt", "# twice\nlet s = table(k, x);\n2*s + table(grid, x, y)\n");
    let row = told(&lab, "@f.txt", "--table k=k.csv --table grid=grid.csv --at x=0.5,y=0.25");
    assert_near(&values(&row)[..3], &[4.0 + 1.0 + 1.0, 4.0 + 2.0, 4.0]);
    lab.write("bad.csv", "0,1\n0,2\n");
    let complaint = lab.fail("formula table(k,x) --table k=bad.csv");
    assert!(complaint.contains("bad.csv:2:1: ") && complaint.contains("increase"), "{complaint}");
    lab.write("f.txt", "x +\n (y\n");
    assert!(
        lab.fail("formula @f.txt").starts_with("error: f.txt: line 3, column 1: the formula ends")
    );
    assert!(lab.fail("formula @g.txt").contains("cannot read g.txt"));
}

#[test]
fn mistakes() {
    let lab = Lab::new();
    let output = lab.command("formula sqrt(r)*cos(thet/2)").output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    let complaint = String::from_utf8(output.stderr).unwrap();
    assert_eq!(
        complaint,
        "error: line 1, column 13: unknown name `thet`; did you mean `theta`?\n\
         error:   sqrt(r)*cos(thet/2)\n\
         error:               ^^^^\n"
    );
    for (arguments, hint) in [
        ("formula x --at x=1", "values of y are missing"),
        ("formula x --at x=1,y=2,r=3", "no variable `r`"),
        ("formula x --at x=a", "`a` is not a number"),
        ("formula x --of line", "write plane, weight"),
        ("formula x --of nowhere.h5", "cannot read nowhere.h5"),
        ("formula x --table k=nowhere.csv", "nowhere.csv: cannot read"),
        ("formula x --parameter x=1", "`x` already has a meaning"),
        ("formula sxx --parameter a=1", "write `let"),
        ("formula x --list", "cannot be used with"),
    ] {
        let complaint = lab.fail(arguments);
        assert!(complaint.contains(hint), "{arguments}: {complaint}");
    }
}

/// Signs in front are no options.
#[test]
fn negative_formulas() {
    let lab = Lab::new();
    assert_eq!(told(&lab, "-x^2", "--at x=3,y=0")["derivatives"][0]["value"], -9.0);
    assert_eq!(told(&lab, "-hypot(x, y)", "--at x=3,y=-4")["derivatives"][0]["value"], -5.0);
    let lab = Lab::solved(CRACKED);
    let report = lab.json("probe plate.h5 --at 0.3,0.2 -q -ux,ux");
    let values = &report["points"][0]["values"];
    assert_eq!(values["-ux"].as_f64().unwrap(), -values["ux"].as_f64().unwrap());
}

#[test]
fn long_derivatives_are_shortened() {
    let text =
        Lab::new().run_with("formula", &["sin(x*y)^3*exp(x)/(1 + x^2 + y^4)^2*atan2(y, x)^2"]);
    assert!(text.contains("more lines") && text.contains("--json has them"), "{text}");
    assert!(text.lines().all(|line| line.chars().count() < 110), "{text}");
}

/// Texts that are too deep, too long, or too much to differentiate end in an error or a result.
#[test]
fn hostile_formulas() {
    let lab = Lab::new();
    let doubled: String = (0..60).map(|k| format!("let a{} = a{k} + a{k}*x;\n", k + 1)).collect();
    for (text, complaint) in [
        (format!("{}x{}", "(".repeat(10_000), ")".repeat(10_000)), Some("nested deeper")),
        ("x+".repeat(500_000), Some("longer than 65536 bytes")),
        ("let a = a; a".into(), Some("used in its own definition")),
        (format!("let a0 = y;\n{doubled}a60"), None),
        ("sin(x)^".repeat(150) + "2", None),
        ("0/0 + 1/0*x + log(-1)".into(), None),
    ] {
        lab.write("f.txt", &text);
        match complaint {
            Some(hint) => assert!(lab.fail("formula @f.txt").contains(hint), "{hint}"),
            None => assert!(lab.run("formula @f.txt --at x=1,y=1").contains("value"), "{text}"),
        }
    }
}

/// The printed module is valid WGSL, and its functions give what `--at` prints, in single
/// precision.
#[cfg(feature = "gpu")]
#[test]
fn wgsl_is_valid_and_the_same_function() {
    let lab = Lab::new();
    lab.write("k.csv", "0,1\n1,3\n2,2\n3,7\n");
    let [x, y] = [-0.5f32, 0.25];
    let (r, theta) = (x.hypot(y), y.atan2(x));
    let plane = [x, y, r, theta, (theta / 2.0).cos(), (theta / 2.0).sin()];
    for (formula, options, function, inputs) in [
        ("westergaard", "--at x=-0.5,y=0.25", "formula_westergaard_3", &plane[..]),
        (
            "boundary-layer",
            "--at x=-0.5,y=0.25 --parameter epsilon=0.5",
            "formula_boundary_layer",
            &plane,
        ),
        ("x*table(k, y)^2", "--at x=-0.5,y=0.25 --table k=k.csv", "formula", &plane),
        ("cubic", "--at t=0.75", "formula_cubic", &[0.75]),
    ] {
        let module = lab.run_with(&format!("formula --wgsl {options}"), &[formula]);
        let found = Module::new(&module).unwrap().call(function, inputs).unwrap();
        let report = lab.json_with(&format!("formula --wgsl {options}"), &[formula]);
        let rows = report["formulas"].as_array().unwrap();
        let row = rows.iter().find(|row| row["wgsl"].as_str().unwrap().contains(function)).unwrap();
        assert!(module.starts_with(report["wgsl_prelude"].as_str().unwrap()));
        assert!(module.contains(row["wgsl"].as_str().unwrap()));
        let exact = values(row);
        assert_eq!(found.len(), exact.len(), "{formula}");
        for (found, exact) in found.into_iter().zip(exact) {
            // some tens of operations, each with a relative error of 2^-24
            let error = (f64::from(found) - exact).abs();
            assert!(error <= 1e-5 * (1.0 + exact.abs()), "{formula}: {found} {exact}");
        }
    }
    let quantity = lab.run_with("formula --wgsl", &["sqrt(ux^2 + uy^2)"]);
    assert!(quantity.contains("-> array<f32, 1>"), "{quantity}");
    Module::new(&quantity).unwrap();
}

/// The example of docs/commands/formula.md, up to the numbers at a point, whose last digits are the
/// processor's: lines that the page leaves out it marks with `…`.
#[test]
fn the_example_of_the_page_is_what_the_program_says() {
    const FORMULA: &str = "abs(x - 2*y)*sqrt(r)";
    let page = include_str!("../../../../docs/commands/formula.md");
    let (_, example) =
        page.split_once(&format!("$ ppum formula '{FORMULA}' --at x=3,y=4\n")).expect("an example");
    let told = Lab::new().run_with("formula --at x=3,y=4", &[FORMULA]);
    let mut lines = told.lines();
    let shown: Vec<_> = example.lines().take_while(|line| !line.starts_with("at ")).collect();
    assert!(shown.len() > 10, "{shown:?}");
    for line in shown.into_iter().filter(|line| !line.ends_with('…')) {
        assert!(lines.any(|told| told == line), "{line}\n{told}");
    }
}
