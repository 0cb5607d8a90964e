//! The rules of FORMAT.md, each broken by a file whose checksum is right.

mod arcs;
mod broken;
mod edit;

use std::collections::BTreeMap;

use super::*;
use crate::content::{ArrayValues, key};
use crate::{checksum, encode, everything, hdf5};
use broken::RULES;
use edit::{edit, put, remove, set, text, texts};

/// A dataset of elasticity with all that the format has, and one of Poisson's equation with what
/// 1.0 had.
const FULL: u64 = 1;
const PLAIN: u64 = 2;
/// A dataset of Poisson's equation with all that the format has.
const FULL_POISSON: u64 = 5;

fn content(seed: u64) -> ObjectTree {
    static CONTENTS: LazyLock<BTreeMap<u64, ObjectTree>> =
        LazyLock::new(|| [FULL, PLAIN, FULL_POISSON].map(|seed| (seed, encoded(seed, 3))).into());
    CONTENTS[&seed].clone()
}

/// The content of a dataset up to some number of steps.
fn encoded(seed: u64, steps: usize) -> ObjectTree {
    let mut data = everything::dataset(seed);
    data.problem = Some("title = \"all\"\n".into());
    data.steps.truncate(steps);
    encode::content(&data).expect("valid")
}

/// The complaint of the reader about a content, in a file with the right checksum.
fn complaint(mut content: ObjectTree) -> Option<String> {
    let mut counted = content.clone();
    remove(&mut counted, "user");
    checksum::seal(&mut counted);
    put(&mut content, "@sha256", counted["@sha256"].clone());
    let bytes = hdf5::to_bytes(&content).expect("an HDF5 file");
    match crate::from_bytes(bytes) {
        Err(ReadError::Checksum { .. }) => panic!("the checksum was made right"),
        other => other.err().map(|error| error.to_string()),
    }
}

#[test]
fn each_rule_is_asked() {
    for seed in [FULL, PLAIN, FULL_POISSON] {
        assert_eq!(complaint(content(seed)), None, "nothing is wrong with seed {seed}");
    }
    for (rule, seed, damage, parts) in RULES {
        let mut damaged = content(*seed);
        damage(&mut damaged);
        let Some(message) = complaint(damaged) else { panic!("{rule}: the file is read") };
        assert!(parts.iter().all(|part| message.contains(part)), "{rule}: {message}");
    }
}

/// The error of each rule is about an object that there is, or that is missing: its path is one
/// of HDF5.
#[test]
fn errors_name_objects_of_the_file() {
    for (rule, seed, damage, _) in RULES {
        let (good, mut damaged) = (content(*seed), content(*seed));
        damage(&mut damaged);
        for error in crate::bytes::diagnose(&damaged) {
            let Some(place) = error.place() else { continue };
            let path = &place[..place.find(['[', ' ']).unwrap_or(place.len())];
            let is_there = |c: &ObjectTree| c.contains_key(path) || c.has_group(path);
            assert!(is_there(&good) || is_there(&damaged), "{rule}: {place}");
        }
    }
}

type Damage = fn(&mut ObjectTree);

/// Damages of objects that do not depend on each other, and the objects.
const INDEPENDENT: &[(&str, Damage)] = &[
    ("@title", |c| put(c, "@title", Array::scalar(1.0))),
    ("domain/holes/radius[0]", |c| set(c, "domain/holes/radius", 0, -0.1)),
    ("equation@state", |c| put(c, "equation@state", text("plane"))),
    ("steps/0000@load", |c| put(c, "steps/0000@load", Array::scalar(1_i64))),
    ("steps/0000/partition/level", |c| {
        put(c, "steps/0000/partition/level", Array::vector([0_u32]))
    }),
    ("steps/0000/partition/half", |c| {
        edit(c, "steps/0000/partition/half", |v: &mut Vec<f64>| v.truncate(2));
        c.get_mut("steps/0000/partition/half").expect("half").shape = vec![1, 2];
    }),
    ("steps/0000/partition@weight", |c| put(c, "steps/0000/partition@weight", text("bspline"))),
    ("steps/0000/cracks/ends", |c| set(c, "steps/0000/cracks/ends", 0, "end".to_owned())),
    ("steps/0000/functions/kind", |c| {
        set(c, "steps/0000/functions/kind", 0, "heaviside".to_owned())
    }),
    ("steps/0000/fields/0000/block_degree", |c| remove(c, "steps/0000/fields/0000/block_degree")),
    ("steps/0000/fields/0001@unit", |c| remove(c, "steps/0000/fields/0001@unit")),
    ("steps/0000/history/value", |c| put(c, "steps/0000/history/value", Array::vector([1.0]))),
    ("steps/0000/warnings/limit", |c| remove(c, "steps/0000/warnings/limit")),
    ("steps/0000/reactions/held", |c| set(c, "steps/0000/reactions/held", 0, 0.5)),
    ("steps/0000/growth/due", |c| remove(c, "steps/0000/growth/due")),
];

/// One reading finds all errors, whichever there are, and no others.
#[test]
fn all_errors_are_found_at_once() {
    let mut random = ppum_testkit::random::Random(35);
    for _ in 0..60 {
        let chosen: Vec<_> = INDEPENDENT.iter().filter(|_| random.unit() < 0.4).collect();
        let mut damaged = content(FULL);
        chosen.iter().for_each(|(_, damage)| damage(&mut damaged));
        let errors = crate::bytes::diagnose(&damaged);
        let mut found: Vec<_> = errors.iter().filter_map(ReadError::place).collect();
        let mut expected: Vec<_> = chosen.iter().map(|(place, _)| *place).collect();
        found.sort_unstable();
        expected.sort_unstable();
        assert_eq!(found, expected, "{errors:#?}");
    }
}

/// No number but the values of attributes and of the history, the places of warnings, and what is
/// not known of tips may be NaN.
#[test]
fn numbers_are_finite() {
    let free = ["attributes/values", "history/value", "warnings/at"];
    for seed in [FULL, PLAIN] {
        let good = encoded(seed, 1);
        let holds_numbers =
            |array: &Array| matches!(&array.values, ArrayValues::F64(v) if !v.is_empty());
        for (name, _) in good.iter().filter(|(_, array)| holds_numbers(array)) {
            for value in [f64::NAN, f64::INFINITY] {
                let mut damaged = good.clone();
                edit(&mut damaged, name, |v: &mut Vec<f64>| *v.last_mut().expect("one") = value);
                let may_be = free.iter().any(|free| name.ends_with(free));
                let is_place = name.ends_with("warnings/at");
                let of_tip = [
                    "intensities/t_stress",
                    "intensities/j",
                    "intensities/error",
                    "growth/strength",
                ];
                let is_unknown = value.is_nan() && of_tip.iter().any(|of| name.ends_with(of));
                let passes = may_be && !is_place || is_unknown;
                assert_eq!(complaint(damaged).is_none(), passes, "{name} {value}");
            }
        }
    }
}

/// An object that is there as something else is not taken for one that is missing.
#[test]
fn objects_are_of_their_form() {
    let good = encoded(FULL, 1);
    let split = |name: &str| -> (String, String) {
        let (group, name) = name.rsplit_once(['/', '@']).unwrap_or(("", name));
        (group.to_owned(), name.to_owned())
    };
    for (name, array) in good.iter() {
        let (group, own) = split(name);
        let form = if name.contains('@') { ObjectKind::Attribute } else { ObjectKind::Dataset };
        for other in [ObjectKind::Attribute, ObjectKind::Dataset, ObjectKind::Group] {
            if other == form {
                continue;
            }
            let mut damaged = good.clone();
            damaged.remove(name);
            let path = key(&group, &own, other);
            match other {
                ObjectKind::Group => damaged.insert_group(&path),
                // attributes of any type cannot be written
                ObjectKind::Attribute => put(&mut damaged, &path, Array::scalar(1.0)),
                ObjectKind::Dataset => put(&mut damaged, &path, array.clone()),
            }
            assert_ne!(complaint(damaged), None, "{name} as {other:?}");
        }
    }
    for group in good.groups() {
        let (parent, own) = split(group);
        for form in [ObjectKind::Attribute, ObjectKind::Dataset] {
            // the number of groups in a list is that of its members; attributes are none
            if own.starts_with('0') && form == ObjectKind::Attribute {
                continue;
            }
            let mut damaged = good.clone();
            remove(&mut damaged, group);
            put(&mut damaged, &key(&parent, &own, form), Array::scalar(1.0));
            let message = complaint(damaged).unwrap_or_else(|| panic!("{group} as {form:?}"));
            assert!(message.contains("but must be a group"), "{message}");
        }
    }
}

/// Groups are there as a whole: with nothing in them they are no shorter way to say that there
/// is nothing.
#[test]
fn empty_groups_are_errors() {
    let good = encoded(FULL, 1);
    for group in good.groups() {
        let mut damaged = good.clone();
        remove(&mut damaged, group);
        damaged.insert_group(group);
        // a list may be empty, if nothing uses it
        let complaint = complaint(damaged);
        assert!(complaint.is_some(), "{group}");
    }
    let mut without = content(PLAIN);
    without.insert_group("tables");
    assert_eq!(complaint(without), None);
}

/// Additions of anybody, and objects of later versions on which no value depends.
#[test]
fn what_is_not_described_is_ignored() {
    let mut more = content(FULL);
    for group in ["", "domain", "steps", "steps/0000", "steps/0000/fields", "steps/0000/partition"]
    {
        put(&mut more, &key(group, "colour", ObjectKind::Attribute), text("red"));
        put(&mut more, &key(group, "notes", ObjectKind::Dataset), Array::vector([1_u8]));
        more.insert_group(&key(group, "more", ObjectKind::Group));
    }
    more.insert_group("user/steps/0009");
    put(&mut more, "user/title", Array::scalar(2.0));
    assert_eq!(complaint(more), None);
}

#[test]
fn a_checksum_is_a_text() {
    for array in [texts(&["ab", "cd"]), Array::scalar(1.0)] {
        let mut damaged = content(PLAIN);
        put(&mut damaged, "@sha256", array);
        let bytes = hdf5::to_bytes(&damaged).expect("an HDF5 file");
        let message = crate::from_bytes(bytes).expect_err("refused").to_string();
        assert!(message.starts_with("@sha256: expected a string"), "{message}");
    }
    let mut damaged = content(PLAIN);
    put(&mut damaged, "sha256", text("ab"));
    let bytes = hdf5::to_bytes(&damaged).expect("an HDF5 file");
    let message = crate::from_bytes(bytes).expect_err("refused").to_string();
    assert!(message.starts_with("sha256: is a dataset, but must be an attribute"), "{message}");
}
