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

/// A table whose name is wrong is read as the one that is meant: nothing else seems to be missing.
#[test]
fn wrong_names_of_tables_are_the_only_mistakes() {
    let table = "[[table]]\nname = \"k\"\nx = [0, 1]\nvalues = [1, 2]\n";
    let text = format!(
        "{table}[domain]\nmin = [0, 0]\nmax = [1, 2]\n[material]\nyoung = \"table(k, x)\"\n\
         poisson = 0.3\nstate = \"plane-strain\"\n[[crack]]\npoints = [[0.2, 1.5], [0.4, 1.5]]\n\
         [discretization]\nlevel = 3\n[[hole]]\ncenter = [0.5, 0.5]\nradius = 0.1\n\
         [[boundary]]\non = {{ crack = 0 }}\npressure = 1\n[[boundary]]\non = {{ hole = 0 }}\n\
         pressure = 1\n[[boundary]]\non = \"bottom\"\nsymmetry = true\n"
    );
    good(&text);
    let wrong = [
        ("[[table", "[[tabel"),
        ("[domain", "[domian"),
        ("[material", "[materiel"),
        ("[[crack", "[[crak"),
        ("[discretization", "[discretisation"),
        ("[[hole", "[[hol"),
        ("[[boundary", "[[boundry"),
    ];
    for (right, wrong) in wrong {
        let found = mistakes(&text.replacen(right, wrong, 1));
        assert!(found.len() == 1 && found[0].contains("did you mean"), "{found:?}");
    }
    let edge = "[[crack]]\npoints = [[0, 0], [0.5, 0]]\n[[boundry]]\non = \"bottom\"\nsymmetry = true\n\
                [[boundary]]\non = \"top\"\ntraction = [0, 1]\n";
    let plain = edited(&text, "\"table(k, x)\"", "1");
    let plain = plain.split("[[crack]]").next().expect("a beginning").to_owned() + edge;
    let found = mistakes(&(plain + "[discretization]\nlevel = 3\n"));
    assert!(found.len() == 1 && found[0].contains("did you mean `boundary`?"), "{found:?}");
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
