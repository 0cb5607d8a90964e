//! The rules for arcs of cracks and rims, and how readers of earlier versions meet them.

use ppum::crack::Crack;

use super::edit::{edit, put, remove, set};
use super::{complaint, encoded};
use crate::content::{Array, ArrayValues, ObjectTree};
use crate::everything;

/// A dataset whose cracks, outline and one hole have arcs.
const CURVED: u64 = 3;

const BULGES: &str = "steps/0000/cracks/bulges";
const ENDS: &str = "steps/0000/cracks/ends";

type BrokenRule = (&'static str, fn(&mut ObjectTree), &'static [&'static str]);

const RULES: &[BrokenRule] = &[
    ("cracks with arcs have bulges", |c| remove(c, BULGES), &[BULGES, "is missing"]),
    (
        "bulges of cracks are those of all points",
        |c| put(c, BULGES, Array::vector([0.1; 3])),
        &["steps/0000/cracks/offsets", "3 entries of `bulges`"],
    ),
    (
        "words of a crack say that it has arcs",
        |c| set(c, ENDS, 0, "tip".to_owned()),
        &[ENDS, "crack 0 has arcs", "`curved-`"],
    ),
    (
        "a crack whose words say so has arcs",
        |c| edit(c, BULGES, |v: &mut Vec<f64>| v[..4].fill(0.0)),
        &[ENDS, "crack 0 has no arcs"],
    ),
    (
        "no edge is behind the last point",
        |c| set(c, BULGES, 3, 0.1),
        &[BULGES, "crack 0", "behind its last point"],
    ),
    (
        "bulges are numbers",
        |c| set(c, BULGES, 1, f64::NAN),
        &["bulges[1]", "NaN", "divide the arc"],
    ),
    ("arcs have a chord", |c| set(c, BULGES, 1, -65.0), &["bulges[1]", "at most 64"]),
    (
        "an arc does not run back on the one before it",
        |c| {
            edit(c, "steps/0000/cracks/points", |v: &mut Vec<f64>| v.copy_within(0..2, 4));
            edit(c, BULGES, |v: &mut Vec<f64>| v[..2].copy_from_slice(&[0.3, -0.3]));
        },
        &["steps/0000/cracks/points[1]", "runs back"],
    ),
    (
        "rims with arcs have bulges",
        |c| remove(c, "domain/holes/bulges"),
        &["domain/holes/bulges", "is missing"],
    ),
    (
        "the kind of a hole says that it has arcs",
        |c| set(c, "domain/holes/kind", 3, "outside".to_owned()),
        &["domain/holes/kind", "hole 3 has arcs"],
    ),
    (
        "a hole whose kind says so has arcs",
        |c| set(c, "domain/holes/kind", 1, "curved-polygon".to_owned()),
        &["domain/holes/kind", "hole 1 has no arcs"],
    ),
    (
        "circles have no bulges",
        |c| set(c, "domain/holes/bulges", 0, 0.5),
        &["domain/holes/kind", "hole 0 has arcs"],
    ),
    (
        "bulges of rims have a bound",
        |c| edit(c, "domain/holes/bulges", |v: &mut Vec<f64>| *v.last_mut().expect("one") = 1e9),
        &["domain/holes/bulges[10]", "at most 64"],
    ),
];

#[test]
fn each_rule_for_arcs_is_asked() {
    let good = encoded(CURVED, 1);
    assert_eq!(complaint(good.clone()), None);
    for (rule, damage, parts) in RULES {
        let mut damaged = good.clone();
        damage(&mut damaged);
        let Some(message) = complaint(damaged) else { panic!("{rule}: the file is read") };
        assert!(parts.iter().all(|part| message.contains(part)), "{rule}: {message}");
    }
}

/// Without arcs there is nothing that 1.7 did not have, bulges of zero or none.
#[test]
fn files_without_arcs_are_as_before() {
    let mut data = everything::dataset(CURVED);
    let cracks = |data: &mut ppum::dataset::Dataset, change: fn(&mut Crack)| {
        data.steps.iter_mut().flat_map(|step| &mut step.cracks).for_each(change);
    };
    let curved = |data| {
        let content = crate::encode::content(&data).expect("valid");
        let words = content.values().filter_map(|array| match &array.values {
            ArrayValues::Text(texts) => Some(texts.clone()),
            _ => None,
        });
        let count = words.flatten().filter(|word| word.starts_with("curved-")).count();
        (count, content)
    };
    let steps = data.steps.len();
    let (count, content) = curved(data.clone());
    assert_eq!(count, 6 * steps + 2);
    assert!(content.keys().any(|key| key.ends_with("bulges")));
    data.domain.holes.truncate(3);
    cracks(&mut data, |crack| crack.bulges.clear());
    let (count, without) = curved(data.clone());
    assert_eq!(count, 0);
    assert!(!without.keys().any(|key| key.ends_with("bulges")));
    cracks(&mut data, |crack| crack.bulges = vec![0.0; crack.points.len() - 1]);
    // numbers that are NaN are not equal to themselves
    let text = |content: ObjectTree| format!("{content:?}");
    assert!(text(curved(data).1) == text(without), "of bulges that are zero");
    // a crack with arcs beside others: these keep their words
    let mut one = everything::dataset(CURVED);
    one.steps.truncate(1);
    one.domain.holes.truncate(3);
    one.steps[0].cracks[1..].iter_mut().for_each(|crack| crack.bulges.clear());
    let (count, content) = curved(one.clone());
    assert_eq!(count, 2);
    let read = crate::decode::dataset(&content).expect("a dataset");
    assert_eq!(read.steps[0].cracks, one.steps[0].cracks);
}
