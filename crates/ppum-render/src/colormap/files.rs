//! Tests: files of each form, of each error, and hostile ones.

use super::{Colormap, ColormapError};
use crate::image::Rgba;

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
