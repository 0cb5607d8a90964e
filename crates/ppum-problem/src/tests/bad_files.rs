//! The bad problem files of `tests/bad_files`: every message in full, with its place.

use super::*;

/// A good file and the mistakes made in it: `NAME.toml` and `NAME.txt`.
macro_rules! files {
    ($($name:literal),*) => {
        [$((
            $name,
            include_str!(concat!("../../tests/bad_files/", $name, ".toml")),
            include_str!(concat!("../../tests/bad_files/", $name, ".txt")),
        )),*]
    };
}
const FILES: [(&str, &str, &str); 10] = files![
    "centre_crack",
    "curves",
    "formulas",
    "growth",
    "half",
    "holes",
    "membrane",
    "plate",
    "refine",
    "table"
];

/// One case: a part of the good file, what replaces it, and what is then found wrong.
struct BadFileCase {
    title: String,
    old: Vec<String>,
    new: Vec<String>,
    expected: Vec<String>,
}

impl BadFileCase {
    /// Lines with `-` are replaced by those with `+`, the others are mistakes.
    fn read(text: &str) -> Self {
        let mut lines = text.lines();
        let title = lines.next().expect("a title").to_owned();
        let lines: Vec<_> = lines.filter(|line| !line.is_empty()).collect();
        let of = |sign: char| -> Vec<_> {
            lines.iter().filter_map(|line| line.strip_prefix(sign)).map(str::to_owned).collect()
        };
        let is_mistake = |line: &&&str| !line.starts_with(['-', '+']);
        let expected = lines.iter().filter(is_mistake).map(|&line| line.to_owned()).collect();
        Self { title, old: of('-'), new: of('+'), expected }
    }

    /// The case with the mistakes that are found instead of those expected, if they differ.
    fn wrong_answer(&self, name: &str, good: &str) -> Option<String> {
        let text = edited(good, &self.old.join("\n"), &self.new.join("\n"));
        let error = parse(&text).err();
        let mistakes = error.iter().flat_map(ProblemError::mistakes);
        let found: Vec<_> =
            mistakes.map(|m| m.to_string().replace("dir/plate.toml:", "")).collect();
        (found != self.expected)
            .then(|| format!("{name} == {}\n{}\n", self.title, found.join("\n")))
    }
}

#[test]
fn the_files_themselves_are_in_order() {
    for (name, text, _) in FILES {
        assert_eq!(good(text).check(), Ok(()), "{name}");
    }
}

#[test]
fn every_mistake_is_told_in_full() {
    let mut wrong = Vec::new();
    for (name, good, cases) in FILES {
        let cases: Vec<_> = cases.split("\n== ").skip(1).map(BadFileCase::read).collect();
        assert!(cases.len() >= 8, "{name}: {} cases", cases.len());
        wrong.extend(cases.iter().filter_map(|case| case.wrong_answer(name, good)));
    }
    assert!(wrong.is_empty(), "found instead:\n{}", wrong.join("\n"));
}
