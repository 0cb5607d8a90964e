//! Contents that are damaged in one place each.

use super::*;
use crate::{checksum, encode, synthetic};

fn content() -> Content {
    encode::content(&synthetic::dataset(1)).unwrap()
}

/// The object that decoding complains about.
fn complaint(content: Content) -> Option<String> {
    match dataset(content) {
        Ok(_) => None,
        Err(ReadError::Object { object, .. }) => Some(object),
        Err(other) => panic!("unexpected error: {other}"),
    }
}

/// A group that goes missing as a whole is a shorter list, an item alone is an error.
#[test]
fn a_missing_item_is_named() {
    let optional = ["problem", "@format", "@format_version"];
    for key in content().keys() {
        let mut damaged = content();
        damaged.remove(key);
        match complaint(damaged) {
            Some(object) => assert_eq!(&object, key),
            None => {
                assert!(optional.contains(&key.as_str()) || key.ends_with("exact"), "{key}")
            }
        }
    }
}

#[test]
fn a_wrong_type_or_rank_is_named() {
    for key in content().keys().filter(|key| !key.starts_with("@format")) {
        let mut damaged = content();
        damaged.get_mut(key).unwrap().values = Values::Other("complex".into());
        assert_eq!(complaint(damaged).as_ref(), Some(key));
        let mut damaged = content();
        damaged.get_mut(key).unwrap().shape.push(1);
        assert_eq!(complaint(damaged).as_ref(), Some(key));
    }
}

#[test]
fn unknown_words_are_named() {
    for (key, word) in [
        ("domain@kind", "disc"),
        ("equation@kind", "heat"),
        ("equation@state", "plane"),
        ("steps/0000/partition@kind", "mesh"),
        ("steps/0000/partition@weight", "sextic"),
    ] {
        let mut damaged = content();
        damaged.insert(key.into(), Array::scalar(word.to_owned()));
        let error = dataset(damaged).unwrap_err().to_string();
        let (group, name) = key.split_once('@').unwrap();
        assert!(error.contains(group) && error.contains(name) && error.contains(word), "{error}");
    }
    for key in ["cracks/ends", "functions/kind", "functions/frame", "intensities/end"] {
        let key = format!("steps/0000/{key}");
        let mut damaged = content();
        let Values::Text(words) = &mut damaged.get_mut(&key).unwrap().values else {
            panic!("{key} holds words")
        };
        words.fill("sideways".into());
        // functions of other kinds have no frame
        assert_eq!(complaint(damaged), Some(key));
    }
}

#[test]
fn lists_that_do_not_divide_are_named() {
    for key in ["cracks/offsets", "functions/parameter_offsets", "intensities/ring_offsets"] {
        let key = format!("steps/0000/{key}");
        for change in [
            |v: &mut Vec<u64>| v[0] = 1,
            |v: &mut Vec<u64>| *v.last_mut().unwrap() += 1,
            |v: &mut Vec<u64>| {
                let n = v.len();
                v[n - 2] = u64::MAX;
            },
        ] {
            let mut damaged = content();
            let Values::U64(offsets) = &mut damaged.get_mut(&key).unwrap().values else {
                panic!("{key} holds offsets")
            };
            change(offsets);
            assert_eq!(complaint(damaged), Some(key.clone()));
        }
    }
}

#[test]
fn versions() {
    let with = |version: [u32; 2]| {
        let mut content = content();
        content.insert("@format_version".into(), Array::vector(version));
        check_version(&content)
    };
    assert!(with([1, 0]).is_ok() && with([1, 9]).is_ok());
    assert!(matches!(with([2, 1]), Err(ReadError::TooNew { major: 2, minor: 1 })));
    assert!(matches!(with([0, 1]), Err(ReadError::Object { .. })));
    assert!(matches!(check_version(&Content::new()), Err(ReadError::NotADataset)));
}

#[test]
fn unknown_groups_are_ignored() {
    let mut later = content();
    later.insert("steps/0000/later@kind".into(), Array::scalar(1.0));
    later.insert("steps/0000/fields/notes/text".into(), Array::vector([1u8]));
    let text = |content| format!("{:?}", dataset(content).unwrap());
    assert!(text(later) == text(content()));
}

#[test]
fn the_checksum_is_optional_but_must_be_right() {
    let mut plain = content();
    assert!(checksum::verify(&mut plain).is_ok());
    let mut sealed = content();
    checksum::seal(&mut sealed);
    assert!(checksum::verify(&mut sealed.clone()).is_ok());
    sealed.insert("@title".into(), Array::scalar("another".to_owned()));
    assert!(matches!(checksum::verify(&mut sealed), Err(ReadError::Checksum { .. })));
}
