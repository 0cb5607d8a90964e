//! Contents that are damaged in one place each.

mod mesh;
mod page;
mod rules;

use std::sync::LazyLock;

use super::*;
use crate::content::{Array, ObjectKind};
use crate::{checksum, encode, everything};
use ppum::crack::{End, TipId};
use ppum::dataset::TipIntensity;
use ppum::function::{Frame, Role, WESTERGAARD};
use ppum::vec2::vec2;

fn content() -> ObjectTree {
    static CONTENT: LazyLock<ObjectTree> =
        LazyLock::new(|| encode::content(&everything::dataset(1)).unwrap());
    CONTENT.clone()
}

/// The object that decoding complains about, the only one.
fn complaint(content: ObjectTree) -> Option<String> {
    let errors = diagnose(&content).1;
    assert!(errors.len() <= 1, "one follows from the other: {errors:?}");
    errors.into_iter().next().map(|error| match error {
        ReadError::Object { object, .. } => object,
        other => panic!("unexpected error: {other}"),
    })
}

/// An object that goes missing is an error, but for those that are optional.
#[test]
fn a_missing_item_is_named() {
    let optional = ["problem", "@format", "@format_version"];
    let of_tips = ["intensities/t_stress", "intensities/j", "intensities/error"];
    let results = [&["exact", "growth@cycles", "functions/role"], &of_tips[..]].concat();
    for key in content().keys() {
        let mut damaged = content();
        damaged.remove(key);
        match complaint(damaged) {
            // without knots in y the values are those of a table of one argument
            Some(object) => assert_eq!(object, key.replace("0002/y", "0002/values")),
            None => {
                let may_miss = results.iter().any(|name| key.ends_with(name));
                assert!(may_miss || optional.contains(&key.as_str()), "{key}");
            }
        }
    }
}

/// Cells and their levels may be missing together: that changes nothing else.
#[test]
fn covers_may_have_no_cells() {
    let mut data = everything::dataset(1);
    for step in &mut data.steps {
        let boxes = step.partition.boxes_mut().expect("boxes");
        (boxes.cell, boxes.level) = (Vec::new(), Vec::new());
    }
    let without = encode::content(&data).expect("valid");
    let mut removed = content();
    removed.retain(|key, _| !(key.ends_with("partition/cell") || key.ends_with("partition/level")));
    assert_eq!(without.keys().collect::<Vec<_>>(), removed.keys().collect::<Vec<_>>());
    let file = crate::bytes::to_bytes(&data).expect("valid");
    let read = crate::bytes::from_bytes(file.clone()).expect("a dataset");
    assert!(read.steps.iter().all(|step| !step.partition.boxes().has_cells()));
    // the history holds NaN, which equals nothing
    assert_eq!(crate::bytes::to_bytes(&read).expect("valid"), file);
}

/// The missing item is the only error, also among those about the meaning of the rest.
#[test]
fn nothing_follows_from_a_missing_item() {
    let complete = content();
    for key in complete.keys().filter(|key| !key.starts_with("@format")).step_by(5) {
        let mut damaged = complete.clone();
        damaged.remove(key);
        let errors = crate::bytes::diagnose(&damaged);
        assert!(errors.len() <= 1, "{key}: {errors:?}");
    }
}

#[test]
fn a_wrong_type_or_rank_is_named() {
    for key in content().keys().filter(|key| !key.starts_with("@format")) {
        let mut damaged = content();
        damaged.get_mut(key).unwrap().values = ArrayValues::Other("complex".into());
        assert_eq!(complaint(damaged).as_ref(), Some(key));
        let mut damaged = content();
        let shape = &mut damaged.get_mut(key).unwrap().shape;
        shape.extend([1].repeat(if shape.is_empty() { 2 } else { 1 }));
        assert_eq!(complaint(damaged).as_ref(), Some(key));
    }
}

/// As h5py writes a list of one text or number.
#[test]
fn scalars_may_be_arrays_of_one_element() {
    let widen = |content: &mut ObjectTree| {
        let scalars = content.values_mut().filter(|array| array.shape.is_empty());
        scalars.map(|array| array.shape.push(1)).count()
    };
    let mut single = content();
    checksum::remove(&mut single);
    assert!(widen(&mut single) > 30);
    checksum::seal(&mut single);
    assert!(widen(&mut single) > 0, "the checksum too");
    checksum::verify(&single).unwrap();
    // numbers that are NaN are not equal to themselves
    let text = |content: &ObjectTree| format!("{:?}", dataset(content).unwrap());
    assert!(text(&single) == text(&content()));
}

#[test]
fn unknown_words_are_named() {
    for (key, word) in [
        ("domain@kind", "disc"),
        ("equation@kind", "heat"),
        ("equation@state", "plane"),
        ("steps/0000/partition@kind", "lattice"),
        ("steps/0000/partition@weight", "sextic"),
    ] {
        let mut damaged = content();
        damaged.insert(key.into(), Array::scalar(word.to_owned()));
        let error = dataset(&damaged).unwrap_err().to_string();
        let (group, name) = key.split_once('@').unwrap();
        assert!(error.contains(group) && error.contains(name) && error.contains(word), "{error}");
    }
    let step =
        ["cracks/ends", "functions/kind", "functions/frame", "functions/role", "intensities/end"];
    let keys = step.map(|key| format!("steps/0000/{key}")).into_iter();
    for key in keys.chain(["domain/holes/kind".into()]) {
        let mut damaged = content();
        let ArrayValues::Text(words) = &mut damaged.get_mut(&key).unwrap().values else {
            panic!("{key} holds words")
        };
        words.fill("sideways".into());
        // functions of other kinds have no frame
        assert_eq!(complaint(damaged), Some(key));
    }
}

#[test]
fn lists_that_do_not_divide_are_named() {
    let offsets = ["cracks/offsets", "intensities/ring_offsets"];
    let of_functions = ["parameter", "cut"].map(|list| format!("functions/{list}_offsets"));
    let step = offsets.map(str::to_owned).into_iter().chain(of_functions);
    let keys = step.map(|key| format!("steps/0000/{key}"));
    for key in keys.chain(["domain/holes/offsets".into()]) {
        for change in [
            |v: &mut Vec<u64>| v[0] = 1,
            |v: &mut Vec<u64>| *v.last_mut().unwrap() += 1,
            |v: &mut Vec<u64>| {
                let n = v.len();
                v[n - 2] = u64::MAX;
            },
        ] {
            let mut damaged = content();
            let ArrayValues::U64(offsets) = &mut damaged.get_mut(&key).unwrap().values else {
                panic!("{key} holds offsets")
            };
            change(offsets);
            assert_eq!(complaint(damaged), Some(key.clone()));
        }
    }
}

/// The complaint of decoding, or of the check of the dataset, after one change.
fn complaint_after(change: impl FnOnce(&mut ObjectTree)) -> String {
    let mut damaged = content();
    change(&mut damaged);
    let Err(error) = crate::bytes::checked(&damaged) else { panic!("the change must be found") };
    error.to_string()
}

fn put(content: &mut ObjectTree, key: &str, array: Array) {
    content.insert(key.to_owned(), array);
}

/// Puts a text in the place of the last one of an array that is not empty.
fn put_last(content: &mut ObjectTree, key: &str, text: &str) {
    let ArrayValues::Text(texts) = &mut content.get_mut(key).expect(key).values else {
        panic!("{key} holds texts")
    };
    let last = texts.iter_mut().rfind(|text| !text.is_empty());
    *last.expect("a text") = text.to_owned();
}

fn text(text: &str) -> Array {
    Array::scalar(text.to_owned())
}

#[test]
fn tables_are_checked() {
    let with = |key: &str, array: Array| complaint_after(|c| put(c, key, array));
    let cases = [
        ("tables/0000/x", Array::vector([0.0, 1.0, f64::NAN, 3.0, 4.0]), "knot 2 in x"),
        ("tables/0002/y", Array::vector([0.0, 0.0, 1.0]), "knot 1 in y"),
        ("tables/0000/values", Array::vector([0.0, 1.0, f64::INFINITY, 3.0, 4.0]), "value 2"),
        ("tables/0000/values", Array::vector([1e308, -1e308, 1e308, 0.0, 0.0]), "too steep"),
        ("tables/0000/values", Array::vector([0.0; 4]), "expected [5]"),
        ("tables/0002/values", Array::vector([0.0; 12]), "expected [3, 4]"),
        ("tables/0001/y", Array::vector([0.0; 0]), "expected [0, 2]"),
    ];
    for (key, array, expected) in cases {
        let message = with(key, array);
        let object = key.replace("0001/y", "0001/values");
        assert!(message.starts_with(&object) && message.contains(expected), "{message}");
    }
    let none = complaint_after(|c| {
        put(c, "tables/0002/y", Array::vector([0.0; 0]));
        put(c, "tables/0002/values", Array { shape: vec![0, 4], values: ArrayValues::F64(vec![]) });
    });
    assert!(none.starts_with("tables/0002/y: ") && none.contains("0 knots in y"), "{none}");
    for name in ["x", "theta", "t", "sin", "1a", "", "surface"] {
        let message = with("tables/0000@name", text(name));
        assert!(
            message.contains("tables: ") && message.contains(&format!("`{name}`")),
            "{message}"
        );
    }
}

/// A few kilobytes can hold tables of gigabytes, all zeros.
#[test]
fn tables_have_a_limit() {
    let huge = |n: usize| {
        complaint_after(|c| {
            put(c, "tables/0003@name", text("huge"));
            put(c, "tables/0003/x", Array::vector((0..n).map(|k| k as f64)));
            put(c, "tables/0003/values", Array::vector(vec![0.0; n]));
            put(c, "equation@young", Array::scalar(f64::NAN));
        })
    };
    assert!(huge(1 << 20).starts_with("tables/0003/values: the tables have more than"));
    assert!(huge(1 << 19).contains("equation@young"), "the next message");
    let mut data = everything::dataset(1);
    let knots: Vec<f64> = (0..1 << 20).map(f64::from).collect();
    let table = ppum::formula::Table::curve("huge", knots.clone(), knots).expect("a table");
    data.tables.push(table.into());
    let error = encode::content(&data).expect_err("it could not be read").to_string();
    assert!(error.starts_with("tables: have 1048595 values"), "{error}");
}

#[test]
fn formulas_are_read_with_the_tables() {
    let functions = "steps/0000/functions/formula";
    type Change = fn(&mut ObjectTree);
    let cases: [(&str, Change); 8] = [
        ("equation@young: ", |c| put(c, "equation@young", text("1 + curv*x"))),
        ("equation@poisson: ", |c| put(c, "equation@poisson", text("table(line, x)"))),
        ("equation@young: ", |c| put(c, "equation@young", text("r"))),
        ("steps/0000/partition@weight_formula: ", |c| {
            put(c, "steps/0000/partition@weight_formula", text("(1 - t)*table(a, t)"));
        }),
        ("steps/0000/functions/formula[", |c| {
            put_last(c, "steps/0000/functions/formula", "x + sid")
        }),
        ("steps/0000/fields/0000/exact[", |c| put_last(c, "steps/0000/fields/0000/exact", "x; y")),
        ("quantities `", |c| put_last(c, "quantities/formula", "sxx + table(b, x)")),
        ("quantities `", |c| put_last(c, "quantities/name", "von-mises")),
    ];
    for (place, change) in cases {
        let message = complaint_after(change);
        assert!(message.contains(place), "{place}: {message}");
        let is_text = !message.contains("von-mises");
        assert_eq!(message.contains("line 1, column"), is_text, "{message}");
    }
    assert!(complaint_after(|c| put_last(c, functions, "")).contains("]: line 1, column 1"));
}

#[test]
fn constants_and_breakpoints_have_ranges() {
    let constant = |array| complaint_after(|c| put(c, "equation@young", array));
    assert!(constant(Array::scalar(f64::NAN)).contains("equation@young: is NaN"));
    assert!(constant(text("y/0")).contains("equation@young: is"));
    assert!(constant(Array::vector([1.0, 2.0])).starts_with("equation@young: has shape [2]"));
    for t in [-1.0, 1.0, f64::NAN] {
        let message = complaint_after(|c| {
            put(c, "steps/0000/partition/weight_breakpoints", Array::vector([t]));
        });
        assert!(message.starts_with("steps/0000/partition/weight_breakpoints: "), "{message}");
    }
    let weight = |formula: &str| {
        complaint_after(|c| put(c, "steps/0000/partition@weight_formula", text(formula)))
    };
    assert!(weight("1 + t").contains("a weight must vanish"));
    assert!(weight("(1 - t)*(t - 0.5)").contains("a weight must be positive"));
    let kinks = complaint_after(|c| {
        let key = "steps/0000/functions/kinks";
        let ArrayValues::F64(v) = &mut c.get_mut(key).expect(key).values else { panic!("numbers") };
        v[1] = f64::INFINITY;
    });
    assert!(kinks.contains("functions/kinks[0]: "), "{kinks}");
}

#[test]
fn plain_datasets_have_no_objects_of_version_1_1() {
    let plain = encode::content(&everything::dataset(0)).expect("valid");
    let new = ["tables", "quantities", "weight_formula", "kink", "singular"];
    let found = plain.keys().find(|key| new.iter().any(|new| key.contains(new)));
    assert_eq!(found, None);
    assert!(matches!(plain["equation@young"].values, ArrayValues::F64(_)));
    let full = content();
    for new in new {
        assert!(full.keys().any(|key| key.contains(new)), "{new}");
    }
}

/// Files without components have none of the items that are new in 1.3.
#[test]
fn cuts_are_written_where_there_are_components() {
    let holds_cuts = |seed: u64| {
        let content = encode::content(&everything::dataset(seed)).expect("valid");
        content.keys().any(|key| key.contains("cut"))
    };
    let with: Vec<u64> = (0..8).filter(|&seed| holds_cuts(seed)).collect();
    assert_eq!(with, [1, 5]);
}

/// Numbers that are no cuts, by their row; counts that do not fit.
#[test]
fn cuts_that_are_none_are_named() {
    let row = |at: usize, value: i64| {
        complaint_after(|c| {
            let ArrayValues::I64(cuts) =
                &mut c.get_mut("steps/0000/functions/cuts").expect("cuts").values
            else {
                panic!("cuts are whole numbers")
            };
            cuts[4 * 3 + at] = value;
        })
    };
    for (at, value) in [(0, -1), (1, -1), (2, -3), (3, i64::MIN), (0, 1 << 32), (2, 1 << 32)] {
        let complaint = row(at, value);
        assert!(complaint.contains("functions/cuts: row 3 is no cut"), "{complaint}");
    }
    for (at, value) in [(0, 1 << 20), (1, 1 << 20), (2, 1 << 20)] {
        let complaint = row(at, value);
        assert!(complaint.contains(&format!("steps/0000/functions/cuts[3][{at}]")), "{complaint}");
    }
}

/// A file of version 1.0 is written again as it was, but for the version and the roles of formulas.
#[test]
fn plain_files_differ_from_version_1_0_in_version_and_roles_alone() {
    let bytes = include_bytes!("../../tests/data/version-1.0.h5").to_vec();
    let mut old = crate::hdf5::from_bytes(&bytes).expect("an HDF5 file");
    checksum::verify(&old).expect("undamaged");
    checksum::remove(&mut old);
    let mut new = encode::content(&dataset(&old).expect("a dataset")).expect("valid");
    assert_eq!(old.remove("@format_version"), Some(Array::vector([1u32, 0])));
    assert_eq!(new.remove("@format_version"), Some(Array::vector([1u32, 9])));
    let roles = new.remove("steps/0000/functions/role").map(|roles| roles.values);
    let Some(ArrayValues::Text(roles)) = roles else { panic!("{roles:?}") };
    assert_eq!(roles, ["", "", "tip", "user"]);
    assert_eq!(old, new);
}

/// Solvers before 1.7 told by the names of functions what they stand for; no other name does.
#[test]
fn names_give_the_roles_in_older_files() {
    let fixed = Frame::Fixed { origin: vec2(0.5, -1.25), angle: 0.3 };
    let tip = Frame::Tip(TipId { crack: 0, end: End::Start });
    let lambda = Some(0.544_83);
    let rows = [
        ("westergaard 2 of crack 0 start", WESTERGAARD[1], tip, None, Role::Tip),
        ("any", WESTERGAARD[0], tip, None, Role::Tip),
        ("westergaard 1 of crack 0 start", "sqrt(r)", tip, None, Role::User),
        ("force at [0.5, -1.25], 3.0", "log(r)", fixed, None, Role::Force),
        ("force at [0.5, -1.25], 3.0", "log(r)", Frame::World, None, Role::User),
        ("force at bolt at [0.5, -1.25]", "log(r)", fixed, None, Role::User),
        ("r^0.545 at [0.5, -1.25]", "r^lambda*cos(lambda*theta)", fixed, lambda, Role::Corner),
        ("r^0.545 at [0.5, -1.25]", "r^0.545", fixed, None, Role::User),
        ("r^0.6 at [0.5, -1.25]", "r^lambda*cos(lambda*theta)", fixed, lambda, Role::User),
        ("kink at 0.1 - x = 0, side of crack 2", "abs(x)", Frame::World, None, Role::Interface),
        ("kink at bolt", "abs(x)", Frame::World, None, Role::User),
        ("x*y", "x*y", Frame::World, None, Role::User),
    ];
    for (name, text, frame, lambda, role) in rows {
        let parameters: Vec<_> =
            lambda.map(|value| ("lambda".to_owned(), value)).into_iter().collect();
        assert_eq!(crate::schema::role_by_name(name, text, frame, &parameters), role, "{name}");
    }
    let mut older = content();
    older.retain(|key, _| !key.ends_with("functions/role"));
    let roles = |content: &ObjectTree| -> Vec<_> {
        let steps = dataset(content).expect("a dataset").steps;
        steps[0].functions.iter().filter_map(|function| function.kind.role()).collect()
    };
    assert!(roles(&content()).contains(&Role::Force) && roles(&older).contains(&Role::Tip));
    assert!(roles(&older).iter().all(|role| [Role::Tip, Role::User].contains(role)));
}

/// Unknown terms of a tip are NaN beside known ones, and absent where none is known.
#[test]
fn terms_of_tips_that_are_not_known() {
    let known = |content: ObjectTree| {
        let step = &dataset(&content).expect("a dataset").steps[0];
        let terms = |tip: &TipIntensity| [tip.t_stress, tip.j, tip.error];
        step.intensities.iter().map(terms).collect::<Vec<_>>()
    };
    let all = known(content());
    assert!(all.len() > 1 && all.iter().all(|[t, ..]| t.is_some()));
    assert!((1..3).all(|k| all[0][k].is_some() && all[1][k].is_none()));
    let names = ["t_stress", "j", "error"].map(|name| format!("steps/0000/intensities/{name}"));
    let mut older = content();
    names.iter().for_each(|name| assert!(older.remove(name).is_some()));
    assert!(known(older.clone()).iter().all(|terms| terms.iter().all(Option::is_none)));
    let again = encode::content(&dataset(&older).expect("a dataset")).expect("valid");
    assert!(names.iter().all(|name| !again.contains_key(name)));
}

#[test]
fn a_newer_minor_version_explains_what_is_unknown() {
    let with = |minor: u32, word: &str| {
        let mut later = content();
        put(&mut later, "@format_version", Array::vector([1, minor]));
        put(&mut later, "steps/0000/partition@weight", text(word));
        let bytes = crate::hdf5::to_bytes(&later).expect("an HDF5 file");
        crate::from_bytes(bytes).map(drop).map_err(|error| error.to_string())
    };
    assert_eq!(with(10, "formula"), Ok(()));
    let newer = with(10, "spherical").expect_err("unknown");
    assert!(
        newer.contains("unknown word `spherical`") && newer.contains("version 1.10"),
        "{newer}"
    );
    assert!(!with(1, "spherical").expect_err("unknown").contains("newer"));
}

#[test]
fn versions() {
    let with = |version: [u32; 2]| {
        let mut content = content();
        content.insert("@format_version".into(), Array::vector(version));
        check_version(&content)
    };
    assert!(with([1, 0]).is_ok() && with([1, 10]).is_ok());
    assert!(matches!(with([2, 1]), Err(ReadError::TooNew { major: 2, minor: 1 })));
    assert!(matches!(with([0, 1]), Err(ReadError::Object { .. })));
    assert!(matches!(check_version(&ObjectTree::new()), Err(ReadError::NotADataset)));
}

#[test]
fn unknown_groups_are_ignored() {
    let mut later = content();
    later.insert("steps/0000/later@kind".into(), Array::scalar(1.0));
    later.insert("steps/0000/fields/notes/text".into(), Array::vector([1u8]));
    let text = |content| format!("{:?}", dataset(&content).unwrap());
    assert!(text(later) == text(content()));
}

#[test]
fn the_checksum_is_optional_but_must_be_right() {
    assert!(checksum::verify(&content()).is_ok());
    let mut with_checksum = content();
    checksum::seal(&mut with_checksum);
    assert!(checksum::verify(&with_checksum).is_ok());
    with_checksum.insert("@title".into(), Array::scalar("another".to_owned()));
    assert!(matches!(checksum::verify(&with_checksum), Err(ReadError::Checksum { .. })));
}

#[test]
fn a_domain_with_holes_is_of_another_kind() {
    assert_eq!(content()["domain@kind"], Array::scalar("box-with-holes".to_owned()));
    let plain = encode::content(&everything::dataset(2)).unwrap();
    assert_eq!(plain["domain@kind"], Array::scalar("box".to_owned()));
    assert!(!plain.keys().any(|key| key.starts_with("domain/")), "objects of 1.2 where not needed");
}

#[test]
fn holes_that_make_no_sense_are_named() {
    let circles_all = |c: &mut ObjectTree| {
        c.remove("domain/holes/bulges");
        put(c, "domain/holes/kind", Array::vector(["circle"; 5].map(str::to_owned)));
    };
    let complaint = complaint_after(circles_all);
    assert!(
        complaint.contains("domain/holes/offsets") && complaint.contains("not 4"),
        "{complaint}"
    );
    let flat = |c: &mut ObjectTree| put(c, "domain/holes/radius", Array::vector([0.0; 5]));
    assert!(complaint_after(flat).contains("domain/holes/radius[0]"));
}
