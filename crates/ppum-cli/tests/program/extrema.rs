//! Extrema: those of the body, whichever image shows it.

use std::fmt::Write as _;

use ppum_testkit::random::Random;

use crate::{CRACKED, LINEAR, Lab, Png};

/// Sizes of images, of few and of many pixels, wide and high.
const SIZES: [&str; 10] = [
    "16x16", "40x30", "64x64", "33x97", "150x50", "100x80", "256x192", "301x200", "480x360",
    "640x480",
];

impl Lab {
    /// The output of a command, whatever it warns of.
    fn told(&self, arguments: &str) -> String {
        let output = self.command(arguments).output().unwrap();
        let complaint = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{arguments}: {complaint}");
        String::from_utf8(output.stdout).unwrap()
    }

    /// Smallest and largest value of a quantity, as an image tells them.
    fn shown(&self, quantity: &str, options: &str) -> [String; 2] {
        let shape = format!("render plate.h5 -o a.png -q {quantity} --backend cpu {options}");
        self.told(&shape);
        let png = Png::read(&self.path("a.png"));
        let words: Vec<&str> = png.text("ppum:extrema").split_whitespace().collect();
        let after = |name: &str| words[words.iter().position(|word| *word == name).unwrap() + 1];
        ["min", "max"].map(|name| after(name).to_owned())
    }

    /// The same as `ppum info` tells it, with the places and what they lie on.
    fn known(&self, quantity: &str) -> [(String, [f64; 2], String); 2] {
        let arguments = format!("info plate.h5 --extrema {quantity} --json");
        let json: serde_json::Value = serde_json::from_str(&self.told(&arguments)).unwrap();
        ["min", "max"].map(|name| {
            let found = &json[name];
            let value = match found["value"].as_f64() {
                Some(value) => format!("{value:?}"),
                None => found["value"].as_str().unwrap().to_owned(),
            };
            let at = [0, 1].map(|k| found["at"][k].as_f64().unwrap());
            (value, at, found["on"].as_str().unwrap().to_owned())
        })
    }

    /// Extrema are the same in images of all sizes, deformed or not; infinite ones lie at singular
    /// points; finite ones are not exceeded on a grid of points, and are attained next to the
    /// place that is told.
    fn check_extrema(&self, quantity: &str, sizes: &[&str], more: &[&str]) {
        let known = self.known(quantity);
        let values = known.clone().map(|(value, ..)| value);
        for options in more {
            for size in sizes {
                let shown = self.shown(quantity, &format!("--size {size} {options}"));
                assert_eq!(shown, values, "{quantity} {size} {options}");
            }
        }
        let grid = self.sampled(&format!("--grid 173x191 -q {quantity}"));
        let size = grid.iter().copied().filter(|v| v.is_finite()).fold(0.0, |a, v| v.abs().max(a));
        for ((value, at, on), sign) in known.iter().zip([-1.0, 1.0]) {
            let Ok(value) = value.parse::<f64>() else { panic!("{value}") };
            assert_eq!(value.is_infinite(), on == "singular", "{quantity}: {value} {on}");
            let beyond = grid.iter().map(|v| sign * (v - value));
            let most = beyond.filter(|v| v.is_finite()).fold(f64::NEG_INFINITY, f64::max);
            // where gradients jump from cell to cell a search ends beside the best one
            assert!(value.is_infinite() || most <= 1e-5 * size, "{quantity}: {value} {most:e}");
            if value.is_finite() && on != "everywhere" {
                let near = self.near(quantity, *at);
                let off = near.iter().map(|v| (v - value).abs()).fold(f64::INFINITY, f64::min);
                assert!(off <= 1e-5 * size, "{quantity}: {value} at {at:?}, {near:?}");
            }
        }
    }

    /// Values of a quantity in a table of `ppum sample`.
    fn sampled(&self, options: &str) -> Vec<f64> {
        self.told(&format!("sample plate.h5 {options} -o a.csv"));
        let table = std::fs::read_to_string(self.path("a.csv")).unwrap();
        let last = |line: &str| line.rsplit(',').next().and_then(|v| v.parse().ok());
        table.lines().skip(1).filter_map(last).collect()
    }

    /// Values at a place and on a small circle around it, on both sides of a crack.
    fn near(&self, quantity: &str, [x, y]: [f64; 2]) -> Vec<f64> {
        let mut points = String::new();
        for k in 0..=12 {
            let (sin, cos) = (f64::from(k) * std::f64::consts::FRAC_PI_6).sin_cos();
            let r = if k == 12 { 0.0 } else { 1e-9 };
            writeln!(points, "{:?},{:?}", x + r * cos, y + r * sin).unwrap();
        }
        self.write("points.csv", &points);
        self.sampled(&format!("--points points.csv -q {quantity}"))
    }
}

/// A plate that a crack of many kinks cuts into two parts, which have moved far apart.
fn split() -> String {
    let mut random = Random(1);
    let points: Vec<_> = (0..=30)
        .map(|k| {
            let x = -1.0 + f64::from(k) / 15.0;
            let bend = if k % 30 == 0 { 0.0 } else { random.between(0.0, 0.15) };
            format!("[{x:?}, {:?}]", bend + 0.1 * (x + 1.0))
        })
        .collect();
    let crack = "points = [[-0.5, 0.0], [0.5, 0.0]]";
    let apart = CRACKED.replace(crack, &format!("points = [{}]", points.join(", ")));
    let apart = apart.replace("traction = [0.0, -1.0]", "displacement = [0.0, 0.0]");
    apart.replace("traction = [0.0, 1.0]", "displacement = [\"30 + 0.1*x\", 100.0]")
}

#[test]
fn images_of_all_sizes_tell_the_extrema_of_the_body() {
    let sizes = &SIZES[..5];
    let both = ["", "--deformed auto"];
    let lab = Lab::solved(CRACKED);
    for quantity in ["von-mises", "sxx", "uy", "s2"] {
        lab.check_extrema(quantity, sizes, &both);
    }
    let lab = Lab::solved(LINEAR);
    lab.check_extrema("u", sizes, &[""]);
    lab.check_extrema("sin(20*u)*x", sizes, &[""]);
}

/// A kink of a crack whose faces have moved far apart is no singular point.
#[test]
fn plain_kinks_are_finite() {
    let lab = Lab::new();
    lab.write("plate.toml", &split());
    lab.told("solve plate.toml");
    for quantity in ["von-mises", "sxx", "s1", "ux"] {
        lab.check_extrema(quantity, &SIZES[1..3], &["", "--deformed 0.001"]);
    }
}

/// A field on a mesh has one range of colours, deformed or not.
#[test]
fn meshes_have_one_range() {
    let lab = Lab::new();
    ppum_format::write(&crate::meshes::cracked_plate(), &lab.path("plate.h5")).unwrap();
    for quantity in ["von-mises", "uy"] {
        lab.check_extrema(quantity, &SIZES[1..4], &["", "--deformed 0.3"]);
        let range = |options: &str| {
            lab.shown(quantity, options);
            Png::read(&lab.path("a.png")).text("ppum:range").to_owned()
        };
        assert_eq!(range("--size 90x70"), range("--size 120x130 --deformed 0.3"), "{quantity}");
    }
}

/// A body that only moves has no stress, and a constant potential no gradient: one flat colour,
/// which the bar calls 0. What is stored are rounding errors.
#[test]
fn rounding_is_no_field() {
    let moved = |displacement: &str| {
        let free = CRACKED.replace("[[crack]]\npoints = [[-0.5, 0.0], [0.5, 0.0]]\n", "");
        let free = free.replace("young = 1.0", "young = 210e9");
        let free =
            free.replace("traction = [0.0, -1.0]", &format!("displacement = {displacement}"));
        free.replace("[[boundary]]\non = \"top\"\ntraction = [0.0, 1.0]\n", "")
    };
    let turned = moved("[\"1 - 0.1*y\", \"0.1*x - 2\"]");
    let potential = LINEAR.replace("x + 2*y", "20");
    let cases: [(&str, &[&str], &str); 3] = [
        (&moved("[1.0, -2.0]"), &["von-mises", "sxx", "s1", "exy", "gradient"], "--deformed 0.1"),
        (&turned, &["von-mises", "sxx", "exy"], ""),
        (&potential, &["gradient", "du_dx"], ""),
    ];
    for (problem, quantities, options) in cases {
        let lab = Lab::new();
        lab.write("plate.toml", problem);
        lab.told("solve plate.toml");
        for quantity in quantities {
            let told =
                lab.told(&format!("render plate.h5 -o a.png -q {quantity} --size 60x60 {options}"));
            assert!(told.contains("one value, 0"), "{told}");
            let png = Png::read(&lab.path("a.png"));
            let mut colors: Vec<_> = png.rgba.chunks(4).filter(|p| p[3] == 255).collect();
            colors.dedup();
            assert!(colors.windows(2).all(|pair| pair[0] == pair[1]), "{quantity} {options}");
        }
    }
    // 1e-7 of the size of u/L is a field
    let lab = Lab::new();
    lab.write("plate.toml", &moved("[\"1 + 1e-7*x\", 0]"));
    lab.told("solve plate.toml");
    let told = lab.told("render plate.h5 -o a.png -q sxx --size 60x60");
    assert!(told.contains("colours from"), "{told}");
}

/// A displacement that symmetry holds at zero is least there: level 0 has one line along the edge,
/// not pieces between rounding errors.
#[test]
fn the_least_level_has_a_whole_line() {
    let lab = Lab::new();
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/quarter-plate.toml");
    lab.told(&format!("solve {example} -o plate.h5"));
    let lines = |options: &str| -> u32 {
        let told = lab.told(&format!("export plate.h5 -o plate.vtp {options}"));
        let words: Vec<&str> = told.split_whitespace().collect();
        words[words.len() - 2].parse().unwrap()
    };
    let others = lines("");
    for level in ["0,", "1,"] {
        assert_eq!(lines(&format!("-q uy --isolines {level}")) - others, 1, "{level}");
    }
}

/// What is in this repository: cracks, a curved one, growth, contact, outlines with and without
/// singular corners, an interface, potentials, halves.
#[test]
#[ignore = "slow: solves ten examples, and draws each of them some twenty times"]
fn examples_tell_one_range_in_every_image() {
    let examples: [(&str, &[&str], &[&str]); 10] = [
        ("centre-crack", &["von-mises", "uy"], &["", "--deformed auto"]),
        ("two-holes-growth", &["von-mises", "sxx"], &["", "--deformed auto"]),
        ("compact-tension", &["von-mises", "s2"], &["", "--deformed auto"]),
        ("pressed-crack", &["von-mises", "uy"], &["", "--deformed auto"]),
        ("quarter-plate", &["syy"], &["", "--mirror=auto", "--mirror=auto --deformed auto"]),
        ("square-hole", &["von-mises"], &["", "--deformed auto"]),
        ("gear-tooth", &["von-mises", "s1"], &["", "--deformed auto"]),
        ("plate-with-hole", &["syy"], &["", "--deformed auto"]),
        ("arc-crack", &["von-mises", "sxy"], &["", "--deformed auto"]),
        ("poisson-slit", &["u", "gradient"], &[""]),
    ];
    for (name, quantities, options) in examples {
        let lab = Lab::new();
        let path = format!("{}/../../examples/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        lab.told(&format!("solve {path} -o plate.h5"));
        for quantity in quantities {
            lab.check_extrema(quantity, &SIZES, options);
        }
    }
}
