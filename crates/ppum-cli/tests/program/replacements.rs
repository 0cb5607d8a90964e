//! Functions and weights replaced while looking.

use ppum_render::colormap::Colormap;

use crate::{CRACKED, LINEAR, Lab, Png};

/// u = x + 2y is a polynomial on every patch: with 2 + x in place of 1 it is (2 + x)(x + 2y).
#[test]
fn the_function_one() {
    let lab = Lab::solved(LINEAR);
    for which in ["0", "one"] {
        let function = format!("--function={which} = 2 + x");
        let report = lab.json_with("probe plate.h5 --at 0.5,0.125 -q u,du_dx", &[&function]);
        let values = &report["points"][0]["values"];
        let [u, slope] = ["u", "du_dx"].map(|name| values[name].as_f64().unwrap());
        assert!((u - 2.5 * 0.75).abs() < 1e-12, "{u}");
        assert!((slope - (0.75 + 2.5)).abs() < 1e-11, "{slope}");
    }
}

/// Pictures without any function 1 show the same values.
#[test]
fn pixels_without_the_function_one() {
    let lab = Lab::solved(LINEAR);
    for precision in ["f64", "f32"] {
        let options = format!("--size 64x32 --range 0,16 --precision {precision}");
        let render = format!("render plate.h5 -o a.png -q u {options}");
        lab.run_with(&render, &["--function", "one=2 + x"]);
        let (png, map) = (Png::read(&lab.path("a.png")), Colormap::named("viridis").unwrap());
        for (column, row) in [(0, 0), (63, 0), (0, 31), (63, 31), (20, 7)] {
            let (x, y) = ((f64::from(column) + 0.5) / 32.0, (31.5 - f64::from(row)) / 32.0);
            let exact = map.color((2.0 + x) * (x + 2.0 * y) / 16.0);
            let found = png.pixel(column, row);
            let near = found.iter().zip(exact).all(|(a, b)| a.abs_diff(b) <= 1);
            assert!(near, "{column} {row}: {found:?} {exact:?}");
        }
    }
}

/// A quantity of the dataset's has another formula, and so has what is made of it.
#[test]
fn a_named_quantity() {
    let lab = Lab::solved(&crate::with_formulas());
    let value = |quantity: &str, more: &[&str]| {
        let words = format!("probe plate.h5 --at 0.25,0.5 -q {quantity}");
        lab.json_with(&words, more)["points"][0]["values"][quantity].as_f64().unwrap()
    };
    let define = ["--define", "stretch=uy + 3*x"];
    assert_eq!(value("stretch", &define), value("uy", &[]) + 0.75);
    assert_eq!(value("2*stretch", &define), 2.0 * value("stretch", &define));
    for (definition, complaint) in [
        ("strech=ux", "the dataset names no quantity `strech` (did you mean `stretch`?)"),
        ("stretch=ux + ", "--define stretch: line 1, column"),
        ("stretch=2*stretch", "unknown name `stretch`"),
    ] {
        let said =
            lab.fail(&format!("probe plate.h5 --at 0,0 --define={}", definition.replace(' ', "")));
        assert!(said.contains(complaint), "{said}");
    }
}

/// Linear functions are the same with every weight, the partition of unity is another.
#[test]
fn the_weight() {
    let lab = Lab::solved(LINEAR);
    let all = "probe plate.h5 --at 0.875,0.375 -q u,phi:0,phi:1,phi:2,phi:3";
    let phi = |more: &[&str]| {
        let report = lab.json_with(all, more);
        let values = report["points"][0]["values"].clone();
        assert!((values["u"].as_f64().unwrap() - 1.625).abs() < 1e-12, "{values}");
        let phi: Vec<_> = (0..4).map(|i| values[&format!("phi:{i}")].as_f64().unwrap()).collect();
        assert!((phi.iter().sum::<f64>() - 1.0).abs() < 1e-15, "{phi:?}");
        phi
    };
    let (linear, same, bump) = (phi(&[]), phi(&["--weight=1 - t"]), phi(&["--weight", "bump"]));
    assert!(linear.iter().zip(same).all(|(a, b)| (a - b).abs() < 1e-15));
    // two patches overlap in x, of centres 0.5 and 1.5 and half-width 0.625: |ξ| = 0.6 and 1
    assert!(bump.iter().zip(&linear).any(|(a, b)| (a - b).abs() > 1e-3), "{bump:?} {linear:?}");
}

/// A function in other words draws the same picture; another one does not.
#[test]
fn pictures() {
    let lab = Lab::solved(CRACKED);
    let draw = |more: &[&str]| {
        lab.run_with("render plate.h5 -o a.png --size 60x60 -q uy --range=-4,4", more);
        Png::read(&lab.path("a.png"))
    };
    let words = "westergaard 2 = (sin(theta/2)*sqrt(r))";
    let [original, same] = [draw(&[]), draw(&["--function", words])];
    let far =
        |a: &Png, b: &Png| a.rgba.iter().zip(&b.rgba).filter(|(a, b)| a.abs_diff(**b) > 1).count();
    assert_eq!(far(&original, &same), 0);
    assert_eq!(same.text("ppum:replaced"), "westergaard 2 = (sin(theta/2)*sqrt(r))");
    assert!(original.texts.iter().all(|(key, _)| key != "ppum:replaced"));
    let one_tip = draw(&["--function", "westergaard 2 of crack 0 end=0"]);
    let both = draw(&["--function", "westergaard 2=0", "--weight", "cubic"]);
    assert!(far(&original, &one_tip) > 100 && far(&one_tip, &both) > 100);
    assert!(both.texts.contains(&("ppum:replaced".into(), "weight = cubic".into())));
}

#[test]
fn mistakes() {
    let lab = Lab::solved(CRACKED);
    lab.write("f.txt", "r^2 +");
    for (option, text, hint) in [
        (
            "--function",
            "nine=r",
            "there is no function `nine`; there are `one`, `one side`, `side`, `westergaard 1`",
        ),
        ("--function", "99=r", "there is no function `99`"),
        (
            "--function",
            "westergaard 1=r*thet",
            "--function westergaard 1: line 1, column 3: unknown",
        ),
        ("--function", "westergaard 1=@f.txt", "--function westergaard 1: f.txt: line 1"),
        ("--function", "r", "write a name, ="),
        ("--weight", "t", "--weight: a weight must be positive"),
        ("--weight", "1 - x", "--weight: line 1, column 5: unknown name `x`"),
    ] {
        for command in ["probe plate.h5 --at 0,0.1", "render plate.h5 -o a.png"] {
            let complaint = lab.fail_with(command, &[option, text]);
            assert!(complaint.contains(hint), "{text}: {complaint}");
        }
    }
}
