//! Files with tens of thousands of entries: what is quadratic in them does not end.

use super::*;

const PLATE: &str = include_str!("../../tests/bad_files/plate.toml");

/// So many of each thing: all pairs of them are 10¹⁰.
const MANY: usize = 100_000;

/// The plate with something appended for each number.
fn plate_with(entry: impl Fn(usize) -> String) -> String {
    let head = PLATE.to_owned() + "\n";
    (0..MANY).fold(head, |text, k| text + &entry(k))
}

/// The messages about a file: lines shown, mistakes.
fn told(text: &str) -> (usize, usize) {
    let error = parse(text).expect_err("mistakes");
    (error.to_string().lines().count(), error.mistakes().len())
}

#[test]
fn many_cracks_that_keep_apart_are_compared_with_their_neighbours() {
    let lattice = |k: usize| {
        let (i, j) = ((k % 400) as f64, (k / 400) as f64);
        let (x, y) = (-0.9 + 0.002 * i, 0.1 + 0.002 * j);
        format!("[[crack]]\npoints = [[{x}, {y}], [{}, {}]]\n", x + 0.0015, y + 0.0015)
    };
    let problem = good(&plate_with(lattice));
    assert!(problem.cracks().len() >= MANY);
}

#[test]
fn of_cracks_that_all_touch_a_hundred_contacts_are_told() {
    let same = |_| "[[crack]]\npoints = [[-0.8, 0.5], [-0.6, 0.6]]\n".to_owned();
    assert_eq!(told(&plate_with(same)), (100, 100));
}

#[test]
fn each_condition_that_contradicts_another_is_told_once() {
    let same = |_| "[[boundary]]\non = \"left\"\ntraction = [1.0, 0.0]\n".to_owned();
    assert_eq!(told(&plate_with(same)), (101, MANY - 1));
    let pieces = |k: usize| {
        let [from, to] = [k, k + 1].map(|k| -1.0 + 2.0 * k as f64 / MANY as f64);
        let on = format!("{{ edge = \"left\", from = {from}, to = {to} }}");
        format!("[[boundary]]\non = {on}\ntraction = [1.0, 0.0]\n")
    };
    assert_eq!(good(&plate_with(pieces)).boundary.len(), MANY + 3);
}

#[test]
fn keys_without_a_meaning_are_placed() {
    let (shown, all) = told(&plate_with(|k| format!("[[hole]]\nwidth{k} = 1\n")));
    assert_eq!((shown, all > MANY), (101, true));
}

#[test]
fn what_no_dataset_can_hold_is_counted_before_it_is_read() {
    let quantity = |k: usize| format!("[[quantity]]\nname = \"q{k}\"\nformula = \"ux\"\n");
    let table = |k: usize| format!("[[table]]\nname = \"t{k}\"\nx = [0, 1]\nvalues = [0, 1]\n");
    for text in [plate_with(quantity), plate_with(table)] {
        let found = mistakes(&text);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].contains("at most 256"), "{found:?}");
    }
    let long = format!("[[quantity]]\nname = \"q\"\nformula = \"{}1\"\n", "1 + ".repeat(20_000));
    let found = mistakes(&format!("{PLATE}\n{long}"));
    assert!(found.len() == 1 && found[0].contains("65536 bytes"), "{found:?}");
}

#[test]
fn a_crack_of_many_segments_is_compared_with_its_neighbours() {
    let zigzag = |k: usize| format!("[{}, {}]", 0.3 + 1e-6 * k as f64, 0.3 + 1e-6 * (k % 2) as f64);
    let points: Vec<_> = (0..MANY).map(zigzag).collect();
    good(&format!("{PLATE}\n[[crack]]\npoints = [{}]\n", points.join(", ")));
}
