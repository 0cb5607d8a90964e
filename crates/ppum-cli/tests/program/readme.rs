//! The first problem of README.md, as a reader would follow it.

use super::Lab;

const PAGE: &str = include_str!("../../../../README.md");

/// The text of the only block of a language.
fn block(language: &str) -> &'static str {
    let start = format!("```{language}\n");
    let mut parts = PAGE.split(&start).skip(1);
    let text = parts.next().unwrap().split("```").next().unwrap();
    assert!(parts.next().is_none(), "more than one block of {language}");
    text
}

#[test]
fn the_first_problem() {
    let lab = Lab::new();
    lab.write("plate.toml", block("toml"));
    let lines = block("sh").lines().map(|line| line.split('#').next().unwrap());
    for command in lines.map(|line| line.strip_prefix("ppum ").unwrap()) {
        lab.run(command);
    }
    for name in ["plate.h5", "plate.png", "uy.png"] {
        assert!(lab.path(name).is_file(), "{name}");
    }
    // Slanted centre crack, a/W = 0.5, H/W = 2, 45°: K over σ√(πa), found independently by
    // least squares in complex potentials.
    let unit = (0.5 * std::f64::consts::PI).sqrt();
    for tip in lab.json("sif plate.h5")["tips"].as_array().unwrap() {
        for (name, symbol, factor) in [("k1", "K_I", 0.611836), ("k2", "K_II", 0.545855)] {
            let k = tip[name].as_f64().unwrap();
            assert!((k / (factor * unit) - 1.0).abs() < 1e-3, "{symbol} {k}");
            let told = format!("{symbol} = {k:.4}");
            assert!(PAGE.contains(&told), "the page does not say {told}");
        }
    }
}
