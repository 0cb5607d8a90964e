//! Ranges of colours: what they are, and what is said of them.

use crate::{CRACKED, LINEAR, Lab, Png};

fn numbers(text: &str) -> Vec<f64> {
    text.split(',').map(|n| n.parse().unwrap()).collect()
}

impl Lab {
    /// What is told of a picture, and its texts.
    fn ranged(&self, options: &str) -> (String, Png) {
        let told = self.run(&format!("render plate.h5 -o a.png --backend cpu {options}"));
        (told, Png::read(&self.path("a.png")))
    }
}

/// u = x + 2y over [0, 2] × [0, 1]: 0 to 4, of any number of pixels, whose centres lie inside.
#[test]
fn ranges_do_not_depend_on_the_size() {
    let lab = Lab::solved(LINEAR);
    for size in ["16x8", "32x16", "301x200"] {
        for options in ["", "--range full", "--precision f32", "--figure --bar bottom"] {
            let size = if options.contains("figure") { "400x300" } else { size };
            let (told, png) = lab.ranged(&format!("-q u --size {size} {options}"));
            let range = numbers(png.text("ppum:range"));
            assert!(range[0].abs() < 1e-6 && (range[1] - 4.0).abs() < 1e-6, "{options} {range:?}");
            assert_eq!(png.text("ppum:range-basis"), "all");
            let values = "values from 0 at (0, 0) on the border to 4 at (2, 1) on the border";
            assert!(told.contains(values) && !told.contains("robust"), "{told}");
            let extrema = png.text("ppum:extrema");
            assert!(extrema.starts_with("min ") && extrema.ends_with(" border"), "{extrema}");
        }
    }
}

#[test]
fn percentiles_are_those_of_pixels() {
    let lab = Lab::solved(LINEAR);
    let (told, png) = lab.ranged("-q u --size 4x2 --range 25%");
    assert!(told.contains("(25 % to 75 % of the pixels)"), "{told}");
    let value = |k: u32| 0.25 + 0.5 * f64::from(k % 4) + 2.0 * (0.25 + 0.5 * f64::from(k / 4));
    let mut values: Vec<f64> = (0..8).map(value).collect();
    values.sort_by(f64::total_cmp);
    let at = |place: f64| {
        let k = place as usize;
        values[k] + place.fract() * (values[k + 1] - values[k])
    };
    let range = numbers(png.text("ppum:range"));
    let exact = [at(1.75), at(5.25)];
    assert!((0..2).all(|k| (range[k] - exact[k]).abs() < 1e-6), "{range:?} {exact:?}");
    assert_eq!(png.text("ppum:range-basis"), "percentiles 25,75");
    // of a range that is given nothing is looked for, or told
    let (told, png) = lab.ranged("-q u --range 0,1");
    assert!(told.contains("colours from 0 to 1, cpu"), "{told}");
    assert!(png.texts.iter().all(|(key, _)| key != "ppum:extrema"));
}

#[test]
fn tips_make_ranges_robust_and_are_told() {
    let lab = Lab::solved(CRACKED);
    let (told, png) = lab.ranged("--size 200x150");
    assert!(told.contains(" (robust); values from ") && told.contains(" to ∞ at tip "), "{told}");
    assert_eq!(png.text("ppum:range-basis"), "robust");
    let extrema = png.text("ppum:extrema");
    assert!(extrema.contains(" max inf at ") && extrema.ends_with(" singular"), "{extrema}");
    let (told, png) = lab.ranged("--size 200x150 --range full");
    assert!(told.contains("(finite pixels); values from "), "{told}");
    assert_eq!(png.text("ppum:range-basis"), "pixels");
    let (told, _) = lab.ranged("--size 200x150 --tip 0 --zoom 1e9 -q syy");
    assert!(told.contains("robust") && told.contains("∞ at tip 0 ("), "{told}");
    // displacements are finite
    let (told, _) = lab.ranged("--size 200x150 -q uy");
    assert!(!told.contains("robust") && !told.contains('∞'), "{told}");
    let (told, _) = lab.ranged("--size 200x150 -q syy --deformed auto");
    assert!(told.contains(" (robust); values from ") && told.contains("∞ at tip 0 ("), "{told}");
    // bars say it, upright and lying, of one panel and of several
    for look in [
        "--figure",
        "--figure --bar bottom --theme dark",
        "--layout 1x1",
        "--layout 1x1 --shared-range",
    ] {
        lab.run(&format!("render plate.h5 -o a.svg --size 500x420 --backend cpu {look}"));
        let svg = std::fs::read_to_string(lab.path("a.svg")).unwrap();
        assert!(svg.contains(">to ∞</text>"), "{look}");
    }
}

#[test]
fn panels_tell_their_ranges() {
    let lab = Lab::solved(CRACKED);
    let (told, png) = lab.ranged("--layout 2x1 -q ux,syy");
    assert!(told.contains("\n  ux: colours from ") && told.contains("\n  syy: colours "), "{told}");
    let is_range = |key: &str| key.starts_with("ppum:range") || key == "ppum:extrema";
    assert!(!png.texts.iter().any(|(key, _)| is_range(key)));
    let (told, png) = lab.ranged("--layout 2x1 -q ux,syy --shared-range --colormap vik");
    assert!(told.contains("\n  colours from ") && told.contains("∞ at tip "), "{told}");
    let range = numbers(png.text("ppum:range"));
    assert!(range[0] == -range[1] && range[1] > 0.0, "{range:?}");
    assert!(png.text("ppum:extrema").contains(" max inf at "));
    let told = lab.run("compare plate.h5 -o a.png --grid 16 --size 1200x400");
    assert!(
        told.contains(" pixels, direct: colours from ") && told.contains("∞ at tip "),
        "{told}"
    );
}
