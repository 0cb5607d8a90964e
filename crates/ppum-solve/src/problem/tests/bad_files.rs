//! The bad problem files of `tests/bad_files`: every message in full, with its place.

use super::*;

const PLATE: &str = include_str!("../../../tests/bad_files/plate.toml");
const CASES: &str = include_str!("../../../tests/bad_files/cases.txt");

/// One case: a part of the good file, what replaces it, and what is then found wrong.
struct Case {
    title: String,
    old: Vec<String>,
    new: Vec<String>,
    expected: Vec<String>,
}

/// Cases begin with `==`; in each, lines with `-` are replaced by those with `+`, the others are mistakes.
fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for text in CASES.split("== ").skip(1) {
        let mut lines = text.lines().map(str::to_owned);
        let title = lines.next().expect("a title");
        let of = |sign: char, line: &String| line.strip_prefix(sign).map(str::to_owned);
        let (old, rest): (Vec<_>, Vec<_>) = lines.partition(|line| line.starts_with('-'));
        let (new, expected): (Vec<_>, Vec<_>) = rest.into_iter().partition(|l| l.starts_with('+'));
        let old = old.iter().filter_map(|line| of('-', line)).collect();
        let new = new.iter().filter_map(|line| of('+', line)).collect();
        let expected = expected.into_iter().filter(|line| !line.is_empty()).collect();
        cases.push(Case { title, old, new, expected });
    }
    cases
}

#[test]
fn the_plate_is_in_order() {
    assert_eq!(good(PLATE).check(), Ok(()));
}

#[test]
fn every_mistake_is_told_in_full() {
    let cases = cases();
    assert!(cases.len() >= 60, "{} cases", cases.len());
    let wrong_answer = |case: &Case| {
        let text = edited(PLATE, &case.old.join("\n"), &case.new.join("\n"));
        let error = parse(&text).err();
        let found = error.iter().flat_map(ProblemError::mistakes);
        let found: Vec<_> = found.map(|f| f.to_string().replace("dir/plate.toml:", "")).collect();
        (found != case.expected).then(|| format!("== {}\n{}\n", case.title, found.join("\n")))
    };
    let wrong: Vec<_> = cases.iter().filter_map(wrong_answer).collect();
    assert!(wrong.is_empty(), "found instead:\n{}", wrong.join("\n"));
}
