//! The problems and commands of README.md and docs/tour.md, as a reader would follow them.

use super::Lab;

const PAGE: &str = include_str!("../../../../README.md");
const TOUR: &str = include_str!("../../../../docs/tour.md");

/// The texts of a page's blocks of a language.
pub(super) fn blocks<const N: usize>(page: &'static str, language: &str) -> [&'static str; N] {
    let start = format!("```{language}\n");
    let texts: Vec<_> =
        page.split(&start).skip(1).map(|part| part.split("```").next().unwrap()).collect();
    texts.try_into().unwrap_or_else(|all: Vec<_>| panic!("{} blocks of {language}", all.len()))
}

/// Runs the commands of a block; quotes are around last arguments.
pub(super) fn follow(lab: &Lab, block: &str) {
    let lines = block.lines().map(|line| line.split('#').next().unwrap());
    for command in lines.map(|line| line.strip_prefix("ppum ").unwrap().trim()) {
        match command.split_once('"') {
            Some((start, quoted)) => {
                let (quoted, rest) = quoted.split_once('"').unwrap();
                let rest = rest.split_whitespace();
                lab.run_with(start, &[quoted].into_iter().chain(rest).collect::<Vec<_>>());
            }
            None => {
                lab.run(command);
            }
        }
    }
}

#[test]
fn the_first_problem() {
    let lab = Lab::new();
    let ([problem], [commands]) = (blocks(PAGE, "toml"), blocks(PAGE, "sh"));
    let [more, _] = blocks(TOUR, "sh");
    lab.write("plate.toml", problem);
    follow(&lab, commands);
    follow(&lab, more);
    for name in ["plate.h5", "plate.png", "uy.png", "plate.pdf"] {
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

#[test]
fn functions_are_formulas() {
    let lab = Lab::new();
    let ([problem], [_, commands]) = (blocks(TOUR, "toml"), blocks(TOUR, "sh"));
    lab.write("materials.toml", problem);
    follow(&lab, commands);
    assert!(lab.path("utilization.png").is_file());
    let values = lab.json("probe materials.h5 --at 0.5,0.5 -q utilization,von-mises");
    let value = |name: &str| values["points"][0]["values"][name].as_f64().unwrap();
    assert!((2.4 * value("utilization") / value("von-mises") - 1.0).abs() < 1e-14);
}
