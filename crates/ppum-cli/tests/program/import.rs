//! `ppum import`: from a drawing to a problem file.

use crate::Lab;

const DRAWING: &str = "<svg xmlns='http://www.w3.org/2000/svg' width='40mm' viewBox='0 0 40 20'>\n\
    <path id='clamp' d='M 0 0 V 20'/>\n<path id='rest' d='M 0 20 H 40 V 0 H 0'/>\n\
    <circle cx='30' cy='10' r='4'/>\n<path id='crack' d='M 10 0 V 6'/>\n<text>a part</text>\n</svg>\n";

#[test]
fn a_drawing_becomes_a_problem_file() {
    let lab = Lab::new();
    lab.write("part.svg", DRAWING);
    let output = lab.command("import part.svg").output().unwrap();
    let [told, left] =
        [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert_eq!(told, "wrote part.toml: an outline, 1 hole, 1 crack; fill in material and loads\n");
    assert_eq!(left, "part.svg: line 6: not read: <text>\n");
    let text = std::fs::read_to_string(lab.path("part.toml")).unwrap();
    assert!(text.contains("points = [[0, 20], [0, 0]], name = \"clamp\""), "{text}");
    assert!(text.contains("points = [[10, 20], [10, 14]]"), "{text}");
    // to standard output the same, byte for byte
    let output = lab.command("import part.svg -o -").output().unwrap();
    assert_eq!(String::from_utf8(output.stdout).unwrap(), text);
}

/// With a material and loads an imported part is solved: the clamp takes what the rest is
/// loaded by.
#[test]
fn an_imported_part_is_solved() {
    let lab = Lab::new();
    lab.write("part.svg", &DRAWING.replace("<text>a part</text>", ""));
    lab.run("import part.svg");
    let drawn = std::fs::read_to_string(lab.path("part.toml")).unwrap();
    let rest = "[material]\nyoung = 1.0\npoisson = 0.3\nstate = \"plane-stress\"\n[[boundary]]\n\
                on = { piece = \"clamp\" }\ndisplacement = [0, 0]\n[[boundary]]\non = { hole = 0 }\n\
                traction = [0, -1]\n[discretization]\nlevel = 3\n";
    let kept = drawn.lines().take_while(|line| !line.starts_with("[discretization]"));
    let kept: Vec<_> = kept.collect();
    lab.write("loaded.toml", &format!("{}\n{rest}", kept.join("\n")));
    let told = lab.run("solve loaded.toml -o loaded.h5");
    assert!(told.contains("K_I") && told.contains("(10, 14)"), "{told}");
    let facts = lab.run("info loaded.h5 --json");
    let facts: serde_json::Value = serde_json::from_str(&facts).unwrap();
    let force = &facts["steps"][0]["reactions"][0]["force"];
    // the weight of the rim: 2π r
    let exact = std::f64::consts::TAU * 4.0;
    let found = force[1].as_f64().unwrap();
    assert!((found / exact - 1.0).abs() < 1e-6, "{force}");
}

/// What people may have edited is kept, unless they say otherwise.
#[test]
fn problem_files_are_kept() {
    let lab = Lab::new();
    lab.write("part.svg", &DRAWING.replace("<text>a part</text>", ""));
    lab.write("part.toml", "mine");
    let complaint = lab.fail("import part.svg");
    assert!(
        complaint.contains("part.toml: is there already") && complaint.contains("--force"),
        "{complaint}"
    );
    assert_eq!(std::fs::read_to_string(lab.path("part.toml")).unwrap(), "mine");
    lab.run("import part.svg --force");
    assert!(std::fs::read_to_string(lab.path("part.toml")).unwrap().contains("[domain.outline]"));
}

#[test]
fn mistakes_are_explained() {
    let lab = Lab::new();
    lab.write("part.svg", DRAWING);
    lab.write("part.stl", "solid");
    for (arguments, message) in [
        ("import part.stl", "end the name in .dxf, .svg, .msh or .geo"),
        ("import part.svg -o part.h5", "problem files are TOML files"),
        ("import part.svg --layer foot", "it has clamp, crack, rest"),
        ("import part.svg --tolerance 1", "--tolerance"),
        ("import part.svg --layer clamp,crack", "no curve closes"),
        ("import none.svg", "cannot read none.svg"),
    ] {
        let complaint = lab.fail(arguments);
        assert!(complaint.contains(message), "{arguments}: {complaint}");
    }
}
