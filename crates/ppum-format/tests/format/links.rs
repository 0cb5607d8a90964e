//! Files with links and types that are no part of the format; `data/links.py` has made them.

use std::path::Path;

fn message(name: &str) -> Option<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/links");
    ppum_format::read(&folder.join(name)).err().map(|error| error.to_string())
}

/// What stands behind a link must not be missing from a dataset that seems whole.
#[test]
fn links_are_refused() {
    for (name, parts) in [
        ("soft.h5", ["steps/0000/warnings: ", "copy"]),
        ("dangling.h5", ["steps/0001: ", "copy"]),
        ("external.h5", ["steps/0001: ", "copy"]),
        ("external-earliest.h5", ["steps/0001: ", "copy"]),
        ("named_type.h5", ["problem: ", "copy"]),
        ("dense.h5", ["steps/0000/", "copy"]),
        // groups of the first versions of HDF5
        ("soft-earliest.h5", ["steps/0000/warnings: ", "copy"]),
        ("named_type-earliest.h5", ["problem: ", "copy"]),
    ] {
        let message = message(name).unwrap_or_else(|| panic!("{name} is read"));
        assert!(parts.iter().all(|part| message.contains(part)), "{name}: {message}");
    }
}

/// Attributes of other types are covered by a checksum too.
#[test]
fn attributes_of_other_types_are_seen() {
    for (name, parts) in [
        ("text_with_nul.h5", ["domain@note", "NUL"]),
        ("enumeration.h5", ["equation@isotropic", "outside the format"]),
        ("reference.h5", ["equation@of", "outside the format"]),
    ] {
        let message = message(name).unwrap_or_else(|| panic!("{name} is read"));
        assert!(parts.iter().all(|part| message.contains(part)), "{name}: {message}");
    }
}

/// What lies in `user` is never looked at, and numbers may be in any order of bytes.
#[test]
fn these_files_are_fine() {
    for name in ["user.h5", "big_endian.h5"] {
        assert_eq!(message(name), None, "{name}");
    }
    let read = |name: &str| {
        let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name);
        format!("{:?}", ppum_format::read(&data).unwrap())
    };
    assert!(read("links/big_endian.h5") == read("version-1.0.h5"));
}
