use serde_json::json;

use crate::{CRACKED, LINEAR, Lab, keys, sound};

/// Numbers for specialists, which `info` has.
const JARGON: [&str; 7] = [
    "crossed twice",
    "dependent",
    "nitsche",
    "free motions",
    "residual",
    "cut-off",
    "quadrature points",
];

#[test]
fn tells_what_a_user_wants_to_know() {
    let lab = Lab::new();
    lab.write("plate.toml", CRACKED);
    let told = lab.run("solve plate.toml");
    let lines: Vec<_> = told.lines().collect();
    assert_eq!((lines[0], lines[lines.len() - 1]), ("Small plate", "wrote plate.h5"));
    for word in [" patches, ", " unknowns, solved in ", "K_II", "(-0.5, 0)"] {
        assert!(told.contains(word), "{word}: {told}");
    }
    assert!(lines.len() <= 7, "{told}");
    assert_eq!(lab.files(), ["plate.h5", "plate.toml"]);
    let info = lab.run("info plate.h5");
    for word in JARGON {
        assert!(!told.contains(word) && info.contains(word), "{word}: {told}");
    }
    lab.run("solve plate.toml -o other.h5");
    assert_eq!(lab.files(), ["other.h5", "plate.h5", "plate.toml"]);
}

#[test]
fn json_has_the_documented_shape() {
    let lab = Lab::new();
    let held = "on = \"bottom\"\ndisplacement = [0.0, 0.0]";
    lab.write("plate.toml", &CRACKED.replace("on = \"bottom\"\ntraction = [0.0, -1.0]", held));
    let told = lab.json("solve plate.toml");
    let expected = "adaptation energy estimated_error file growth history patches phases reactions seconds solver tips title unknowns warnings";
    assert_eq!(keys(&told).join(" "), expected);
    assert_eq!((&told["file"], &told["title"]), (&json!("plate.h5"), &json!("Small plate")));
    let step = &lab.json("info plate.h5")["steps"][0];
    for key in ["energy", "patches", "reactions", "unknowns", "warnings"] {
        assert_eq!(told[key], step[key], "{key}");
    }
    assert_eq!(told["tips"], step["intensities"]);
    let seconds = told["phases"].as_array().unwrap().iter().map(|p| p["seconds"].as_f64().unwrap());
    assert!((seconds.sum::<f64>() - told["seconds"].as_f64().unwrap()).abs() < 1e-12);
    let history = told["history"].as_array().unwrap();
    assert!(
        history.iter().all(|r| r["unit"] != "s") && history.iter().any(|r| r["name"] == "residual")
    );
    assert!(lab.fail("solve plate.toml --json --check").contains("cannot be used with"));
    lab.write("plane.toml", LINEAR);
    assert_eq!(lab.json("solve plane.toml")["tips"], json!([]));
}

/// All steps are told, kept and compared; of the one that is told as a whole the numbers are those
/// of the last.
#[test]
fn adaptation_is_told() {
    let lab = Lab::new();
    let adaptive = |keys: &str| format!("{CRACKED}[adaptivity]\n{keys}\n");
    lab.write("plate.toml", &adaptive("steps = 2\nkeep = \"all\""));
    assert!(lab.run("solve plate.toml --check").contains("the first step: "));
    let told = lab.json("solve plate.toml");
    assert_eq!(told["adaptation"]["stop"], "steps");
    let steps = told["adaptation"]["steps"].as_array().unwrap();
    assert_eq!(steps.len(), 3);
    for key in ["energy", "estimated_error", "patches", "unknowns"] {
        assert_eq!(told[key], steps[2][key], "{key}");
    }
    assert_eq!(told["tips"], lab.json("info plate.h5")["steps"][0]["intensities"]);
    let error = |k: usize| steps[k]["estimated_error"].as_f64().unwrap();
    assert!(error(2) < error(1) && error(1) < error(0), "{steps:?}");
    assert!(lab.run("plot plate.h5 --convergence -o plate.svg").contains("K_I of tip 1"));
    lab.run("render plate.h5 -q indicator --step 1 --size 64x64 -o cells.png");
    lab.write("plate.toml", &adaptive("steps = 1\ntolerance = 0.001"));
    let (text, warnings) = lab.warned("solve plate.toml");
    assert!(text.contains("adaptation ended: steps"), "{text}");
    assert!(warnings.contains("not 1e-3 as wanted"), "{warnings}");
    assert_eq!(lab.json("info plate.h5")["steps"].as_array().unwrap().len(), 1);
}

#[test]
fn check_writes_nothing_and_reports_every_mistake() {
    let lab = Lab::new();
    lab.write("plate.toml", CRACKED);
    assert!(lab.run("solve plate.toml --check").contains("plate.toml"));
    lab.write("wrong.toml", &CRACKED.replace("young", "yong").replace("order = 1", "order = 99"));
    let complaint = lab.fail("solve wrong.toml --check");
    assert!(complaint.lines().count() >= 2, "{complaint}");
    assert!(complaint.lines().all(|line| line.starts_with("error: wrong.toml:")), "{complaint}");
    assert!(complaint.contains("yong") && complaint.contains("99"), "{complaint}");
    assert_eq!(lab.files(), ["plate.toml", "wrong.toml"]);
}

/// `--check` refuses all that `solve` would refuse, with the same words, before anything is solved.
#[test]
fn check_finds_what_solve_would_refuse() {
    let lab = Lab::new();
    let half = |from: f64, to: f64| {
        format!("[[hole]]\npoints = [[-2, {from}], [2, {from}], [2, {to}], [-2, {to}]]\n")
    };
    let swallowed = half(-2.0, 0.1) + &half(-0.1, 2.0);
    let unbalanced = CRACKED.replace("traction = [0.0, 1.0]", "traction = [0.5, 2.0]");
    let cases = [
        ("unbalanced", unbalanced, "balance"),
        (
            "large",
            CRACKED.replace("order = 1", "order = 8") + "[solver]\nkind = \"direct\"\n",
            "MiB",
        ),
        ("text", CRACKED.replace("Small plate", "Small \u{FFFD} plate"), "U+FFFD"),
        (
            "load",
            CRACKED.replace("traction = [0.0, 1.0]", "traction = [\"sqrt(x)\", 1.0]"),
            "finite",
        ),
        (
            "held",
            CRACKED.replace("traction = [0.0, 1.0]", "displacement = [\"log(x)\", 1]"),
            "finite",
        ),
        ("own", format!("{CRACKED}\n[[enrichment]]\nfunction = \"sqrt(x)\"\n"), "finite"),
        ("swallowed", format!("{CRACKED}\n{swallowed}"), "swallow"),
    ];
    for (name, text, word) in cases {
        assert_ne!(text, CRACKED, "{name}");
        lab.write(&format!("{name}.toml"), &text);
        let line = format!("solve {name}.toml --memory 0.1");
        let checked = lab.fail(&format!("{line} --check"));
        assert!(checked.contains(word), "{name}: {checked}");
        assert_eq!(lab.fail(&line), checked, "{name}");
    }
    assert!(!lab.files().iter().any(|file| file.ends_with(".h5")));
}

/// The rest of a plate may be too little for a piece; and the smallest of datasets can be
/// read again.
#[test]
fn next_to_nothing_is_told_or_solved() {
    let lab = Lab::new();
    let hole =
        |radius: f64| format!("{}\n[[hole]]\ncenter = [0, 0]\nradius = {radius}\n", crate::sound());
    lab.write("nothing.toml", &hole(0.5_f64.sqrt() * 2.0 - 1e-8));
    for line in ["solve nothing.toml --check", "solve nothing.toml"] {
        assert!(lab.fail(line).contains("the holes swallow the whole domain"));
    }
    let smallest = LINEAR.replace("level = 1", "level = 0");
    lab.write("smallest.toml", &smallest);
    lab.run("solve smallest.toml");
    lab.run("info smallest.h5");
}

#[test]
fn check_tells_what_the_solution_takes() {
    let lab = Lab::new();
    lab.write("plate.toml", CRACKED);
    let told = lab.run("solve plate.toml --check");
    let solved = lab.run("solve plate.toml");
    let before = |text: &str, word: &str| {
        let (before, _) = text.split_once(word).expect(word);
        before.rsplit([' ', '\n']).next().map(str::to_owned)
    };
    assert_eq!(before(&told, " patches"), before(&solved, " patches"), "{told}{solved}");
    for word in ["unknowns", "non-zeros", "in the factor", "MiB"] {
        assert!(told.contains(word), "{word}: {told}");
    }
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let lab = Lab::new();
    lab.write("plate.toml", CRACKED);
    let bits = |threads: usize| {
        lab.run(&format!("solve plate.toml -o {threads}.h5 --threads {threads}"));
        let dataset = ppum_format::read(&lab.path(&format!("{threads}.h5"))).unwrap();
        let step = &dataset.steps[0];
        let coefficients = step.fields[0].coefficients.iter().flatten().map(|c| c.to_bits());
        let factors = step.intensities.iter().flat_map(|t| [t.k1.to_bits(), t.k2.to_bits()]);
        coefficients.chain(factors).collect::<Vec<_>>()
    };
    let one = bits(1);
    assert!(one.len() > 500);
    let three = bits(3);
    let different = one.iter().zip(&three).filter(|(a, b)| a != b).count();
    assert_eq!((different, three.len()), (0, one.len()));
}

#[test]
fn outputs_that_cannot_be_written_are_refused_at_once() {
    let lab = Lab::new();
    lab.write("plate.toml", CRACKED);
    lab.write("plate.h5.toml", CRACKED);
    std::fs::create_dir(lab.path("folder")).unwrap();
    assert!(lab.fail("solve plate.toml -o nowhere/x.h5").contains("no folder nowhere"));
    assert!(lab.fail("solve plate.toml -o folder").contains("is a folder"));
    assert!(lab.fail("solve plate.toml -o plate.toml").contains("would replace plate.toml"));
    assert!(lab.fail("solve plate.toml --threads 0").contains("--threads"));
    assert_eq!(std::fs::read_to_string(lab.path("plate.toml")).unwrap(), CRACKED);
}

#[test]
fn problems_of_every_kind() {
    for problem in [&sound(), LINEAR] {
        assert!(!Lab::solved(problem).run("info plate.h5").contains("K_II"));
    }
}
