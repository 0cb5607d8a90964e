//! Messages tell of the user's plate: its words, its digits, nothing that is not there.

use crate::{CRACKED, LINEAR, Lab, sound};

/// Holes cut a plate as cracks do.
#[test]
fn a_plate_without_cracks_hears_of_none() {
    let cut = r#"
[[hole]]
points = [[-0.1, -1.2], [0.1, -1.2], [0.1, 1.2], [-0.1, 1.2]]
[[boundary]]
on = "left"
traction = [-1.0, 0.0]
[discretization]"#;
    let lab = Lab::new();
    for (change, hint) in [
        (cut, "falls into pieces"),
        ("[[boundary]]\non = \"left\"\ntraction = [1.0, 0.0]\n[discretization]", "do not balance"),
        ("[body_force]\nvalue = [0.0, \"exp(1000*(x + 2))\"]\n[discretization]", "around ("),
        (
            "[[boundary]]\non = \"left\"\ndisplacement = [\"exp(1000*(y + 2))\", 0.0]\n[discretization]",
            "around (",
        ),
    ] {
        lab.write(
            "plate.toml",
            &sound().replace("level = 1", "level = 3").replace("[discretization]", change),
        );
        let complaint = lab.fail("solve plate.toml");
        assert!(complaint.contains(hint), "{complaint}");
        for word in ["the cracks", "patch", "unknown", "0.000000", "e0"] {
            assert!(!complaint.contains(word), "{word}: {complaint}");
        }
    }
}

/// 0.1 + 0.2 is 0.3, and a crack on an axis lies on it but for rounding.
#[test]
fn places_have_the_digits_that_they_need() {
    let lab = Lab::new();
    let crack = "[[-0.4999999, -5e-17], [0.30000000000000004, 0.0]]";
    lab.write("plate.toml", &CRACKED.replace("[[-0.5, 0.0], [0.5, 0.0]]", crack));
    let told = [lab.run("solve plate.toml"), lab.run("info plate.h5"), lab.run("sif plate.h5")];
    for text in told {
        assert!(text.contains("(0.3, 0)") && text.contains("(-0.5, 0)"), "{text}");
        let places = text.lines().filter(|line| line.contains('('));
        assert!(places.into_iter().all(|l| !l.contains("e-17") && !l.contains("000004")), "{text}");
    }
    // symmetric: K_II is rounding
    let row = Lab::solved(CRACKED).run("sif plate.h5");
    assert_eq!(row.lines().nth(1).unwrap().split_whitespace().nth(5), Some("0"), "{row}");
}

#[test]
fn one_value_is_told() {
    let lab = Lab::solved(&sound());
    for (quantity, value) in [("syy", "1"), ("2+0*ux", "2"), ("1e-30+0*ux", "1e-30")] {
        for more in ["", "--figure", "--precision f32", "--scale log"] {
            let options = format!("-q {quantity} --size 400x300 --backend cpu {more}");
            let told = lab.run(&format!("render plate.h5 -o a.png {options}"));
            assert!(told.contains(&format!("one value, {value}, ")), "{quantity} {more}: {told}");
        }
    }
    let told = lab.run("render plate.h5 -o a.png -q 1+1e-9*uy");
    let range = told.split("colours from ").nth(1).unwrap().split([',', ';', '(']).next().unwrap();
    let (from, to) = range.split_once(" to ").unwrap();
    assert_ne!(from, to);
}

#[test]
fn what_is_not_defined_is_told() {
    let lab = Lab::solved(&sound());
    let (told, warning) = lab.warned("render plate.h5 -o a.png -q 0/0 --size 20x20");
    assert!(told.contains("no finite values"), "{told}");
    let (told, infinite) = lab.warned("render plate.h5 -o a.png -q (2+uy)/0 --size 20x20");
    assert!(told.contains("no finite values"), "{told}");
    assert!(infinite.contains("has no finite value in the picture"), "{infinite}");
    assert!(warning.contains("`0/0` has no value at all 400 pixels of the plate"), "{warning}");
    let (_, warning) = lab.warned("render plate.h5 -o a.png -q sqrt(x) --size 20x20");
    assert!(warning.contains("at 200 of 400 pixels"), "{warning}");
    // what lies outside of the plate has no value either, and nobody wonders
    lab.run("render plate.h5 -o a.png -q syy --view -2,-2,2,2");
    let told = lab.run("probe plate.h5 --at 0,0 -q 0/0,ux");
    assert!(told.contains("nan (not defined here)"), "{told}");
    let (table, warning) = lab.warned("sample plate.h5 --line -2,0,1,0 --count 7 -q sqrt(x),ux");
    assert_eq!(table.lines().count(), 8);
    assert!(warning.contains("`sqrt(x)` has no value at 2 of 5 points"), "{warning}");
}

/// Wherever a word is unknown the one that was meant is named.
#[test]
fn what_was_meant_is_named() {
    let lab = Lab::solved(CRACKED);
    for (command, meant) in [
        ("probe plate.h5 --at 0,0 -q vonmises", "von-mises"),
        ("render plate.h5 -o a.png -q mises", "von-mises"),
        ("sample plate.h5 --crack 0 -q tresco", "tresca"),
        ("render plate.h5 -o a.png --colormap virids", "viridis"),
        ("render plate.h5 -o a.png --scale lgo", "log"),
        ("render plate.h5 -o a.png --part tips", "tip"),
        ("probe plate.h5 --at 0,0 --function westergard=1", "westergaard 1"),
        ("probe plate.h5 --at 0,0 --weight bmup", "bump"),
        ("formula x --of plnae", "plane"),
        ("formula westergard", "westergaard"),
        ("formula sqr(x)", "sqrt"),
        ("rendr plate.h5", "render"),
    ] {
        let complaint = lab.fail(command);
        let names = [format!("`{meant}`"), format!("'{meant}'")];
        assert!(names.iter().any(|name| complaint.contains(name)), "{command}: {complaint}");
    }
    lab.write(
        "wrong.toml",
        &CRACKED.replace("young", "yuong").replace("plane-strain", "plane-stran"),
    );
    let complaint = lab.fail("solve wrong.toml");
    assert!(complaint.contains("`young`") && complaint.contains("\"plane-strain\""), "{complaint}");
}

/// Nothing is offered that would be refused.
#[test]
fn the_error_is_offered_with_an_exact_solution_only() {
    let known = |problem: &str| Lab::solved(problem).fail("probe plate.h5 --at 0,0 -q nothing");
    assert!(known(LINEAR).contains(" error,"));
    assert!(!known(CRACKED).contains(" error,"));
}
