//! Built-in maps, and files of each form, of each error, and hostile ones.

use super::*;

fn map(text: &str) -> Colormap {
    Colormap::from_text("file", text).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn fail(text: &str) -> String {
    Colormap::from_text("file", text).unwrap_err().to_string()
}

fn colors<const N: usize>(map: &Colormap, at: [f64; N]) -> [[u8; 3]; N] {
    at.map(|t| map.color(t)).map(|[r, g, b, _]| [r, g, b])
}

const RED: [u8; 3] = [255, 0, 0];
const GREEN: [u8; 3] = [0, 255, 0];
const BLUE: [u8; 3] = [0, 0, 255];

/// Red, green and blue at even positions, in all forms without positions.
#[test]
fn three_colours_in_a_row() {
    for text in [
        "1 0 0\n0 1 0\n0 0 1\n",
        "255,0,0\r\n0,255,0\r\n0,0,255",
        "# a comment\n255;0;0 # red\n\n0;255;0\n0;0;255\n",
        "\u{feff}r,g,b\n255,0,0\n0,255,0\n0,0,255",
    ] {
        let map = map(text);
        assert_eq!(colors(&map, [0.0, 0.5, 1.0]), [RED, GREEN, BLUE], "{text}");
        assert_eq!(colors(&map, [0.25]), [[128, 128, 0]], "{text}");
        assert_eq!(colors(&map.reversed(), [0.0, 0.5, 1.0]), [BLUE, GREEN, RED], "{text}");
    }
}

/// Three colours at 0, ¼ and 1 are read.
#[test]
fn uneven_positions() {
    for text in [
        "-1 1 0 0\n-0.5 0 1 0\n1 0 0 1\n",
        "scalar,RGB_r,RGB_g,RGB_b\n0,1,0,0\n0.25,0,1,0\n1,0,0,1",
        r#"[{"Name": "x", "ColorSpace": "RGB", "NanColor": [1,1,0],
             "RGBPoints": [-1,1,0,0, -0.5,0,1,0, 1,0,0,1]}]"#,
    ] {
        let map = map(text);
        assert_eq!(colors(&map, [0.0, 0.25, 1.0]), [RED, GREEN, BLUE], "{text}");
        assert_eq!(colors(&map, [0.125, 0.625]), [[128, 128, 0], [0, 128, 128]], "{text}");
        assert_eq!(colors(&map.clone().reversed(), [0.0, 0.75, 1.0]), [BLUE, GREEN, RED]);
        let palette: Vec<Rgba> = map.palette(9);
        assert_eq!(palette[2], map.color(0.25), "{text}");
    }
}

/// The map jumps at two equal positions.
#[test]
fn steps() {
    let map = map("0 1 0 0\n0.5 1 0 0\n0.5 0 1 0\n1 0 1 0\n1 0 0 1");
    assert_eq!(colors(&map, [0.0, 0.499_999, 0.5, 0.75, 1.0]), [RED, RED, GREEN, GREEN, BLUE]);
}

/// Two ends in ParaView's Diverging space are Moreland's map, the built-in coolwarm, which is
/// computed by other code and rounded to bytes.
#[test]
fn diverging_is_morelands_map() {
    let text = r#"[{"Name": "Cool to Warm", "ColorSpace": "Diverging", "RGBPoints":
        [0, 0.23137254902, 0.298039215686, 0.752941176471, 1, 0.705882352941, 0.0156862745098, 0.149019607843]}]"#;
    let (found, known) = (map(text), Colormap::named("coolwarm").unwrap());
    assert!(found.diverging);
    for k in 0..256 {
        let t = f64::from(k) / 255.0;
        let (a, b) = (found.color(t), known.color(t));
        assert!(a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 1), "{t}: {a:?} {b:?}");
    }
}

#[test]
fn colours_beyond_the_range() {
    let preset = |more: &str| {
        map(&format!(
            r#"{{"RGBPoints": [0,0,0,0, 1,1,1,1], "BelowRangeColor": [1,0,0],
            "AboveRangeColor": [0,0,1], {more}}}"#
        ))
    };
    let used = preset(r#""UseBelowRangeColor": 1, "UseAboveRangeColor": true"#);
    assert_eq!([used.below, used.above], [[255, 0, 0, 255], [0, 0, 255, 255]]);
    let unused = preset(r#""UseBelowRangeColor": 0, "UseAboveRangeColor": false"#);
    assert_eq!([unused.below, unused.above], [super::BLACK, super::WHITE]);
}

#[test]
fn mistakes_have_a_place_and_a_remedy() {
    for (text, hint) in [
        ("0 0 0\n1 2\n", "line 2: `1 2` is not a colour; write red"),
        ("0 0 x\n", "line 1: `0 0 x` is not"),
        ("0 0 0\n0 0 300", "line 2"),
        ("0 0 0\n-1 0 3", "line 2"),
        ("0 0 0\nNaN 0 0", "line 2"),
        ("0 0 0\n1e999 0 0", "line 2"),
        ("NaN 0 0 0\n1 0 0 0", "line 1"),
        ("0 0 0 0\n1 1 1 1\n0.5 0 0 0", "line 3: position 0.5 follows 1.0"),
        ("1 0 0 0\n1 1 1 1", "must span"),
        ("-1e308 0 0 0\n1e308 1 1 1", "must span"),
        ("#ff0000\n#00ff00", "line 1: `#ff0000` is not a colour; write red"),
        ("r,g,b\n1,2", "line 2"),
        ("1 2 3 4 5", "line 1"),
        ("1 1 1", "fewer than two"),
        ("", "fewer than two"),
        ("[]", "no preset of ParaView"),
        ("<ColorMap name=\"x\"/>", "XML is not supported"),
        ("[[0,0,0],[1,1", "line 1, column 13: this is not JSON"),
        ("[[0,0,0],[1,1,NaN]]", "line 1, column"),
        ("[[0,0,0],[1,1,1e999]]", "number out of range"),
        ("[[0,0,0],[1,1,1]]", "no preset of ParaView"),
        ("{\"colors\": [\"#000\", \"#fff\"]}", "write other maps as red, green and blue"),
        ("[{\"RGBPoints\": [0,0,0,0]},{}]", "there are 2 maps"),
        ("[{\"RGBPoints\": [0,0,0,0,1]}]", "[0].RGBPoints[4]: ends within"),
        ("[{\"RGBPoints\": [0,0,0,0,1,2,0,0]}]", "[0].RGBPoints[4]: red, green"),
        ("[{\"RGBPoints\": \"x\"}]", "is no list of numbers"),
        ("[{\"IndexedColors\": [1,0,0]}]", "categories"),
        (
            "{\"RGBPoints\": [0,0,0,0,1,1,1,1], \"ColorSpace\": \"Step\"}",
            "\"Step\" is not supported",
        ),
        (
            "{\"RGBPoints\": [0,0,0,0,1,1,1,1], \"UseBelowRangeColor\": 1}",
            "BelowRangeColor: is to be",
        ),
    ] {
        let error = fail(text);
        assert!(
            error.starts_with("colour map `file`, ") && error.contains(hint),
            "{text}: {error}"
        );
    }
}

/// Large files, deep ones and all beginnings of good ones: an error or a map, and no panic.
#[test]
fn hostile_files() {
    assert!(fail(&"0 0 0\n".repeat(100_000)).contains("line 65537: more than 65536 colours"));
    let many = format!("[{{\"RGBPoints\": [{}1,0,0,0]}}]", "0,0,0,0,".repeat(70_000));
    assert!(fail(&many).contains("more than 65536"));
    assert!(fail(&"0 0 0\n".repeat(10_000_000)).contains("16 MiB"));
    assert!(fail(&"[".repeat(1_000_000)).contains("recursion limit"));
    let good = r##"[{"RGBPoints": [0, 0, 0, 0, 1, 1, 1, 1], "ColorSpace": "Lab"}]"##;
    for end in 0..good.len() {
        assert!(matches!(
            Colormap::from_text("file", &good[..end]),
            Err(ColormapError::File { .. })
        ));
    }
    for word in ["#", "##", "#é12345", "\"", ";;;", "rgb(", "rgb()", "\0", "#12345é"] {
        fail(&format!("{word}\n{word}\n"));
        fail(&serde_json::to_string(&[word, word]).unwrap());
    }
}

/// CIE lightness L* of an sRGB colour.
fn lightness(color: Rgba) -> f64 {
    let linear = |c: u8| {
        let c = f64::from(c) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    };
    let y = 0.2126 * linear(color[0]) + 0.7152 * linear(color[1]) + 0.0722 * linear(color[2]);
    if y > 0.008856 { 116.0 * y.cbrt() - 16.0 } else { 903.3 * y }
}

#[test]
fn ends_are_the_published_colours() {
    let ends = |name| {
        let map = Colormap::named(name).unwrap();
        assert_eq!(map.entries.len(), 256);
        [map.color(0.0), map.color(1.0)].map(|c| [c[0], c[1], c[2]])
    };
    assert_eq!(ends("viridis"), [[68, 1, 84], [253, 231, 37]]);
    assert_eq!(ends("plasma"), [[13, 8, 135], [240, 249, 33]]);
    assert_eq!(ends("inferno"), [[0, 0, 4], [252, 255, 164]]);
    assert_eq!(ends("magma"), [[0, 0, 4], [252, 253, 191]]);
    assert_eq!(ends("cividis"), [[0, 34, 78], [254, 232, 56]]);
    assert_eq!(ends("turbo"), [[48, 18, 59], [122, 4, 3]]);
    assert_eq!(ends("coolwarm"), [[59, 76, 192], [180, 4, 38]]);
    assert_eq!(ends("coolwarm_r"), [[180, 4, 38], [59, 76, 192]]);
    assert_eq!(ends("batlow"), [[1, 25, 89], [250, 204, 250]]);
    assert_eq!(ends("vik"), [[0, 18, 97], [89, 0, 8]]);
    assert_eq!(ends("roma"), [[126, 23, 0], [3, 49, 152]]);
}

#[test]
fn perceptual_maps_grow_lighter_everywhere() {
    for name in ["viridis", "plasma", "inferno", "magma", "cividis", "batlow"] {
        let map = Colormap::named(name).unwrap();
        let levels: Vec<f64> = map.palette(256).into_iter().map(lightness).collect();
        // Bytes are rounded: neighbours may tie or fall by a rounding step, ten apart may not.
        assert!(levels.windows(2).all(|w| w[1] > w[0] - 0.35), "{name}");
        assert!(levels.windows(11).all(|w| w[10] > w[0] + 1.0), "{name}");
    }
    let turbo = Colormap::named("turbo").unwrap().palette(256);
    assert!(lightness(turbo[255]) < lightness(turbo[128]), "the control must fail");
}

#[test]
fn coolwarm_is_lightest_in_the_middle() {
    let map = Colormap::named("coolwarm").unwrap();
    let levels: Vec<f64> = map.palette(255).into_iter().map(lightness).collect();
    let peak = (0..255).max_by(|&a, &b| levels[a].total_cmp(&levels[b])).unwrap();
    assert!((125..=129).contains(&peak), "{peak}");
    // Moreland's map takes M = 88 there: L* = 88, no colour.
    assert!((levels[127] - 88.0).abs() < 0.5 && map.diverging);
}

/// Lightness of the middle of a diverging map above both ends, and of a cyclic one below them.
#[test]
fn kinds_of_maps() {
    for name in NAMES {
        let map = Colormap::named(name).unwrap();
        let [first, middle, last] = [0.0, 0.5, 1.0].map(|t| lightness(map.color(t)));
        assert_eq!(map.diverging, middle > first.max(last) + 20.0 && name != "turbo", "{name}");
        let same = map.color(0.0).iter().zip(map.color(1.0)).all(|(a, b)| a.abs_diff(b) <= 1);
        assert_eq!((map.cyclic, map.cyclic), (same, middle < first.min(last) - 20.0), "{name}");
    }
    // nowhere does a cyclic map jump, its ends included
    let palette = Colormap::named("twilight").unwrap().palette(361);
    for (k, color) in palette.iter().enumerate() {
        let next = palette[(k + 1) % 361];
        assert!(color.iter().zip(next).all(|(a, b)| a.abs_diff(b) < 10), "{k}");
    }
}

#[test]
fn bands_have_one_colour_each() {
    let map = Colormap::named("viridis").unwrap();
    let banded = map.clone().banded(5);
    for k in 0..5u8 {
        let color = map.color(f64::from(k) / 4.0);
        for within in [0.0, 1e-9, 0.5, 0.999_999] {
            assert_eq!(banded.color((f64::from(k) + within) / 5.0), color, "{k} {within}");
        }
    }
    assert_eq!(banded.color(1.0), map.color(1.0));
    assert_eq!((banded.below, banded.above), (map.color(0.0), map.color(1.0)));
    assert!(banded.has_jumps() && !map.has_jumps());
    assert_eq!((banded.bands(), map.bands()), (Some(5), None));
    let one = map.clone().banded(1);
    assert_eq!([0.0, 0.3, 1.0].map(|t| one.color(t)), [map.color(0.5); 3]);
    let cyclic = Colormap::named("twilight").unwrap();
    let four = cyclic.clone().banded(4);
    let quarters = [0.0, 0.25, 0.5, 0.75];
    assert_eq!(quarters.map(|t| four.color(t + 0.1)), quarters.map(|t| cyclic.color(t)));
    assert_eq!(map.clone().reversed().banded(3).color(0.1), map.banded(3).reversed().color(0.1));
}

/// Unevenly spaced values have evenly spaced colours, each in the middle between
/// its neighbours.
#[test]
fn classes_have_one_colour_each() {
    let map = Colormap::named("viridis").unwrap();
    let values = [-1.0, 2.0, 3.0, 30.0];
    let classed = map.clone().classed(&values);
    let position = |value: f64| (value + 1.5) / 32.0;
    for (k, value) in values.into_iter().enumerate() {
        let color = map.color(k as f64 / 3.0);
        assert_eq!(classed.class_color(k), color);
        for near in [-0.49, 0.0, 0.49] {
            assert_eq!(classed.color(position(value + near)), color, "{value} {near}");
        }
    }
    assert_eq!((classed.classes(), classed.bands()), (&values[..], None));
    assert_eq!(classed.color(position(16.4)), map.color(2.0 / 3.0));
    assert_eq!(classed.color(position(16.6)), map.color(1.0));
    assert!(classed.has_jumps() && map.classes().is_empty());
    assert_eq!(map.clone().classed(&[]), map);
    let one = map.clone().classed(&[7.0]);
    assert_eq!([0.0, 0.5, 1.0].map(|t| one.color(t)), [map.color(0.5); 3]);
}

#[test]
fn below_and_above_have_the_colours_of_the_ends() {
    for name in NAMES {
        let map = Colormap::named(name).unwrap();
        assert_eq!((map.below, map.above), (map.color(0.0), map.color(1.0)), "{name}");
    }
}

#[test]
fn contrasting_colours_do_not_occur_in_the_map() {
    for name in NAMES {
        let map = Colormap::named(name).unwrap().contrasting();
        for special in [map.below, map.above] {
            let far = |c: Rgba| (0..3).map(|k| c[k].abs_diff(special[k])).max() > Some(30);
            assert!(map.palette(256).into_iter().all(far), "{name} {special:?}");
        }
        assert_ne!(map.below, map.above);
        assert_eq!(map.clone().reversed().below, map.above);
        assert_eq!(map.clone().reversed().reversed(), map);
    }
}

#[test]
fn colours_between_entries_are_interpolated() {
    let map = Colormap::from_text("two", "0, 0, 0 # black\n\n1.0 0.5 0.2\n").unwrap();
    assert_eq!(map.color(0.5), [128, 64, 26, 255]);
    assert_eq!(map.color(-3.0), [0, 0, 0, 255]);
    assert_eq!(map.color(7.0), [255, 128, 51, 255]);
}

#[test]
fn mistakes_are_named() {
    let error = Colormap::named("Virdis").unwrap_err().to_string();
    assert!(error.contains("did you mean `viridis`?"), "{error}");
    let error = Colormap::named("rainbow").unwrap_err().to_string();
    assert!(!error.contains("did you mean") && error.contains("turbo"), "{error}");
}
