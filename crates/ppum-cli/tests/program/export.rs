//! `ppum export`: what is in a page, and what is refused. `tests/page` opens pages in a browser.

use ppum_figure::canvas::base64::base64;
use serde_json::Value;

use crate::{CRACKED, Lab};

/// The text of an element with an identifier.
fn element<'p>(page: &'p str, identifier: &str) -> &'p str {
    let start = format!("id=\"{identifier}\">");
    let (_, rest) = page.split_once(&start).expect("an element");
    rest.split('<').next().expect("its text")
}

/// What a page shows first, of an export with options.
fn start(lab: &Lab, options: &str) -> Value {
    lab.run(&format!("export plate.h5 -o plate.html {options}"));
    let page = std::fs::read_to_string(lab.path("plate.html")).unwrap();
    let dataset = std::fs::read(lab.path("plate.h5")).unwrap();
    assert!(element(&page, "dataset") == base64(&dataset), "the bytes of the file");
    assert!(!page.contains("://"), "a page names no other");
    serde_json::from_str(element(&page, "start")).expect("JSON")
}

#[test]
fn options_say_what_is_shown_first() {
    let lab = Lab::solved(CRACKED);
    let plain = start(&lab, "");
    assert_eq!((&plain["view"], &plain["file"]), (&Value::Null, &"plate.h5".into()));
    assert_eq!(plain["scene"]["overlays"]["shown"], serde_json::json!(["cracks"]));
    assert_eq!(start(&lab, "-q von-mises"), plain, "that is the default");
    let options = "-q uy+0*ux --colormap vik_r --range 0,2 --scale symlog --isolines 7 \
                   --overlay cells --center 0.25,0.5 --width 1e-9";
    let given = start(&lab, options);
    let scene = &given["scene"];
    assert_eq!(scene["quantity"], "uy+0*ux");
    assert_eq!(scene["colors"]["colormap"], "vik_r");
    assert_eq!(
        (&scene["colors"]["range"], &scene["colors"]["scale"]),
        (&"0,2".into(), &"symlog".into())
    );
    assert_eq!(scene["overlays"]["isolines"], "7");
    assert_eq!(scene["overlays"]["shown"], serde_json::json!(["cells", "cracks"]));
    assert_eq!(given["view"]["center"], serde_json::json!([0.25, 0.5]));
    assert_eq!(given["view"]["width"], 1e-9);
}

#[test]
fn pages_go_to_other_programs_too() {
    let lab = Lab::solved(CRACKED);
    lab.run("export plate.h5 -o plate.html");
    let output = lab.command("export plate.h5 -o -").output().unwrap();
    assert!(output.status.success());
    assert_eq!(output.stdout, std::fs::read(lab.path("plate.html")).unwrap());
}

#[test]
fn what_pages_do_not_have_is_refused() {
    let lab = Lab::solved(CRACKED);
    lab.write("map.json", "[]");
    for (arguments, reason) in [
        ("plate.h5 -o page.png", "end the name in .html"),
        ("plate.h5 -o plate.h5", "would replace plate.h5"),
        ("plate.toml -o page.html", "not a readable HDF5 file"),
        ("plate.h5 -o page.html -q nothing", "no quantity `nothing`"),
        ("plate.h5 -o page.html --step 1", "no step 1"),
        ("plate.h5 -o page.html --colormap map.json", "maps of the program alone"),
        ("plate.h5 -o page.html --overlay supports", "no supports and loads"),
        ("plate.h5 -o page.html --tip 9", "no tip 9: the dataset has 2 tips"),
        ("plate.h5 -o page.html --center 90,90 --width 1", "shows nothing of the domain"),
    ] {
        let complaint = lab.fail(&format!("export {arguments}"));
        assert!(complaint.contains(reason), "{arguments}: {complaint}");
    }
    assert!(!lab.files().iter().any(|name| name.ends_with(".html")));
}

/// A mesh that does not keep its tolerance is written; a warning has what is allowed and what was
/// found, and the exit status says so to programs.
#[test]
fn tolerances_that_are_not_kept_have_their_own_status() {
    let lab = Lab::solved(CRACKED);
    for file in ["plate.vtu", "plate.vtkhdf", "plate.pvd"] {
        lab.run(&format!("export plate.h5 -o {file} --tolerance 0.1"));
        std::fs::remove_file(lab.path(file)).unwrap();
        let mut missed = lab.command(&format!(
            "export plate.h5 -o {file} -q ux,stress --tolerance 1e-7 --max-cells 4000"
        ));
        let output = missed.output().unwrap();
        assert_eq!(output.status.code(), Some(3), "{file}");
        let told = String::from_utf8(output.stderr).unwrap();
        let words =
            "warning: the limit of 4000 triangles is reached, and the tolerance is not kept: ux";
        assert!(told.starts_with(words), "{told}");
        assert!(
            told.contains("; stress differs by up to ") && told.contains(" is allowed"),
            "{told}"
        );
        assert!(
            told.ends_with("; raise --max-cells or --tolerance\n") && told.lines().count() == 1
        );
        assert!(
            lab.path(file).exists()
                && String::from_utf8(output.stdout).unwrap().contains("% within")
        );
    }
}

/// Edges follow a straight interface, whatever crosses it. Along a curved one, which they do not
/// follow, division ends long before the limit of triangles, and the warning has a place.
#[test]
fn jumps_of_materials_do_not_eat_all_triangles() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/bimaterial-plate.toml");
    let lab = Lab::solved(&std::fs::read_to_string(folder).unwrap());
    lab.run("export plate.h5 -o plate.vtu -q stress --tolerance 0.02 --max-cells 100000");
    let lab = Lab::solved(
        r#"
domain = { min = [-1, -1], max = [1, 1] }
material = { young = "if(x*x + y*y > 0.3, 10, 1)", poisson = 0.3, state = "plane-strain" }
boundary = [{ on = "top", traction = [0, 1] }, { on = "bottom", displacement = [0, 0] }]
discretization = { cells = [8, 8], order = 2 }
"#,
    );
    let output =
        lab.command("export plate.h5 -o plate.vtu -q stress --tolerance 0.1").output().unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(3), "{told}");
    assert!(told.starts_with("warning: the tolerance is not kept: stress"), "{told}");
    let place = told.split_once("values jump within triangles, as at (").expect("a place").1;
    let (place, _) = place.split_once(')').unwrap();
    let (x, y) = place.split_once(", ").unwrap();
    let [x, y] = [x, y].map(|number| number.parse::<f64>().unwrap());
    assert!((x * x + y * y - 0.3).abs() < 0.01, "{told}");
}

#[test]
fn averages_take_fewer_points() {
    let lab = Lab::solved(CRACKED);
    let told = lab.run("export plate.h5 -o plate.vtu --tolerance 0.05");
    let averaged = lab.run("export plate.h5 -o plate.vtu --tolerance 0.05 --average");
    let points = |text: &str| -> usize {
        let line = text.lines().find(|line| line.ends_with(" points")).unwrap();
        line.rsplit(' ').nth(1).unwrap().parse().unwrap()
    };
    assert!(2 * points(&averaged) < points(&told), "{told}{averaged}");
    let complaint = lab.fail("export plate.h5 -o page.html --average");
    assert!(complaint.contains("--average is for meshes"), "{complaint}");
}

/// Bodies of revolution are swept around their axis; plane ones and other files are refused.
#[test]
fn bodies_of_revolution_are_swept() {
    let lab = Lab::solved(super::mirror::CYLINDER);
    let told = lab.run("export plate.h5 -o body.vtu --tolerance 0.1 --revolve 12");
    let flat = lab.run("export plate.h5 -o flat.vtu --tolerance 0.1");
    assert_eq!(told.lines().last(), flat.lines().last());
    let cells = |file: &str| -> usize {
        let text = std::fs::read_to_string(lab.path(file)).unwrap();
        let count = text.split_once("NumberOfCells=\"").expect("cells").1;
        count.split_once('"').unwrap().0.parse().unwrap()
    };
    assert_eq!(cells("body.vtu"), 12 * cells("flat.vtu"));
    for (options, reason) in [
        ("-o body.vtu --revolve 12 --order 2", "swept cells are linear"),
        ("-o body.vtkhdf --revolve 12", "end -o in .vtu"),
        ("-o body.html --revolve 12", "--revolve is for meshes"),
        ("-o body.vtu --revolve 2", "2 is not in 3.."),
        ("-o body.vtu --tolerance 0.01 --revolve 65535", "cells, more than 20000000; take fewer"),
    ] {
        let complaint = lab.fail(&format!("export plate.h5 {options}"));
        assert!(complaint.contains(reason), "{complaint}");
    }
    let complaint = Lab::solved(CRACKED).fail("export plate.h5 -o body.vtu --revolve 12");
    assert!(complaint.contains("the body is plane"), "{complaint}");
}
