//! Mistakes in problem files, kind by kind.

use super::*;

#[test]
fn what_is_missing_altogether() {
    let expected = [
        "nothing acts on the plate; add [[boundary]]",
        "the table [discretization] is missing; add it with e.g. `level = 5`",
        "the table [domain] is missing; add it with e.g. `min = [-1, -1]`, `max = [1, 1]`",
        "the table [material] is missing; add it with its keys `young`, `poisson`, `state`",
    ];
    assert_eq!(mistakes(""), expected.map(|message| format!("dir/plate.toml:1:1: {message}")));
}

#[test]
fn all_mistakes_at_once_in_the_order_of_the_file() {
    let text = edited(PLATE, "young = 2.5", "yong = 2.5");
    let text = edited(&text, "0.3", "0.7");
    let text = edited(&text, "[[-0.5, 0.0], [0.5, 0.0]]", "[[-0.5, 0.0], [5, 0.0]]");
    let text = edited(&text, "\"top\"", "\"bottom\"");
    let text = edited(&text, "level = 4", "level = 40\noverlap = \"1.3\"");
    let places: Vec<_> = mistakes(&text)
        .iter()
        .map(|found| found.split(": ").next().unwrap_or_default().to_owned())
        .collect();
    let expected = ["6:1", "7:11", "10:24", "15:6", "18:9", "19:11"];
    assert_eq!(places, expected.map(|place| format!("dir/plate.toml:{place}")));
}

#[test]
fn no_toml() {
    for (text, places) in [
        ("[domain\nmin = [1, 2]\n", vec!["1:8"]),
        ("x = 1.2.3\ny = abc\nz = 3 4\n", vec!["1:8", "2:5", "3:5"]),
        ("a = 1\na = 2\n", vec!["2:1"]),
    ] {
        let expected = |place| format!("dir/plate.toml:{place}: the file is no valid TOML here: ");
        let found = mistakes(text);
        assert_eq!(found.len(), places.len(), "{found:?}");
        for (found, place) in found.iter().zip(places) {
            assert!(found.starts_with(&expected(place)), "{found}");
        }
    }
}
