//! Round trips, damaged files, and files that must not be lost.

#[path = "../fixture/everything.rs"]
pub(crate) mod everything;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::ops::Range;
use std::sync::LazyLock;
use std::time::Duration;

use crate::damage::{damaged, object_headers, seal, sealed_parts};
use ppum::cover::Cover;
use ppum::crack::Side;
use ppum::dataset::{Attribute, Dataset, Equation, Growth};
use ppum::field::Field;
use ppum::function::{Frame, Function, FunctionKind};
use ppum::jet::Jet;
use ppum::quantity::Quantity;
use ppum::vec2::{Vec2, vec2};
use ppum::weight::WeightFunction;
use ppum_format::{ReadError, WriteError, from_bytes, read, to_bytes, write};
use ppum_testkit::processor::thread_time;
use ppum_testkit::random::Random;

use everything::dataset;

/// Debug output tells every double apart, and a NaN is equal to a NaN.
fn same(a: &Dataset, b: &Dataset) -> bool {
    Original::new(a).is(b)
}

/// A dataset that many others are compared with, as its debug output.
struct Original(String);

impl Original {
    fn new(dataset: &Dataset) -> Self {
        Self(format!("{dataset:?}"))
    }

    /// True if a dataset is the same.
    fn is(&self, dataset: &Dataset) -> bool {
        format!("{dataset:?}") == self.0
    }
}

#[test]
fn round_trip_is_exact_to_the_last_bit() {
    for seed in 0..30 {
        let original = dataset(seed);
        let bytes = to_bytes(&original).unwrap();
        let back = from_bytes(bytes.clone()).unwrap();
        assert!(same(&original, &back), "seed {seed}");
        assert!(to_bytes(&back).unwrap() == bytes, "seed {seed}");
    }
}

/// The temperature of a body is stored with its coefficient of expansion, and is not there without.
#[test]
fn temperatures_are_stored() {
    let cases = ppum_testkit::fields::equations();
    let heated = cases.iter().filter(|case| case.dataset.equation.expansion().is_some());
    let mut count = 0;
    for case in heated {
        let back = from_bytes(to_bytes(&case.dataset).unwrap()).unwrap();
        assert!(same(&case.dataset, &back));
        let mut other = back.clone();
        other.steps[0].fields[0].components[2] = "heat".into();
        let error = to_bytes(&other).expect_err("another name").to_string();
        assert!(error.contains("ux, uy, temperature"), "{error}");
        let mut other = back;
        let field = &mut other.steps[0].fields[0];
        field.components.pop();
        field.coefficients.pop();
        assert!(to_bytes(&other).is_err());
        count += 1;
    }
    assert_eq!(count, 3);
}

/// A file of the first version, as the program of that time wrote it: every patch has the functions
/// one, side of a crack, √r sin(θ/2) of its tip and a wave, with the factors 2, 3, 5, 7.
#[test]
fn files_of_version_1_0_are_read() {
    let old = from_bytes(include_bytes!("../data/version-1.0.h5").to_vec()).unwrap();
    assert_eq!(old.equation, Equation::poisson(2.5));
    assert!(old.tables.is_empty() && old.quantities.is_empty());
    let field = Field::new(&old, 0).unwrap();
    let mut u = [Jet::constant(0.0)];
    for p in [vec2(0.3, 0.4), vec2(-0.5, -0.2), vec2(-0.7, 0.9), vec2(0.9, -0.8)] {
        assert!(field.at(p).evaluate::<0>(Vec2::ZERO, Side::Above, &mut u));
        let opening = p.length().sqrt() * (p.y.atan2(p.x) / 2.0).sin();
        let wave = (3.0 * (p.x - 0.5)).sin() / (2.0 + p.y - 0.25);
        let expected = 2.0 + 3.0 * p.y.signum() + 5.0 * opening + 7.0 * wave;
        assert!((u[0].v - expected).abs() < 1e-14, "{} {expected}", u[0].v);
        assert_eq!(field.exact(0, p), p.x * p.y);
    }
    let again = from_bytes(to_bytes(&old).unwrap()).unwrap();
    assert!(same(&again, &old));
}

/// A file of version 1.1 as the program of that time solved it: u = x + 2y with the conductivity
/// 2 + x from a table, a weight, a function and quantities by formulas. The solver is right
/// to 1e-11.
#[test]
fn files_of_version_1_1_are_read() {
    let old = from_bytes(include_bytes!("../data/version-1.1.h5").to_vec()).unwrap();
    let names: Vec<_> = old.quantities.iter().map(|q| q.name.as_str()).collect();
    assert_eq!((old.tables.len(), names), (1, vec!["flux-x", "twice"]));
    let step = &old.steps[0];
    assert_eq!(step.partition.boxes().weight.name(), "formula");
    let FunctionKind::Formula { text, parameters, declared, .. } = &step.functions[1].kind else {
        panic!("a formula")
    };
    assert_eq!(
        (text.as_str(), parameters.as_slice()),
        ("sin(a*x)*table(k, y)", &[("a".into(), 2.0)][..])
    );
    assert_eq!(declared.singular, [Vec2::ZERO]);
    let field = Field::new(&old, 0).unwrap();
    for p in [vec2(0.3, 0.4), vec2(1.5, 0.9), vec2(0.5, 0.25), vec2(2.0, 0.0)] {
        let at = |q: &str| {
            Quantity::parse(q, &field).unwrap().at(&mut field.at(p), Vec2::ZERO, Side::Above)
        };
        let flux = -(2.0 + p.x);
        for (name, exact) in [("u", p.x + 2.0 * p.y), ("flux-x", flux), ("twice", 2.0 * flux + 3.0)]
        {
            assert!((at(name) - exact).abs() < 1e-9, "{name} at {p:?}: {}", at(name));
        }
    }
    let again = from_bytes(to_bytes(&old).unwrap()).unwrap();
    assert!(same(&again, &old));
}

/// A file of version 1.3 as the program of that time wrote it: a crack along y = 0 and one from
/// there up along x = 0; every patch has the functions one, two components and the side of the
/// first crack, with the factors 2, 3, 5, 7.
#[test]
fn files_of_version_1_3_are_read() {
    let old = from_bytes(include_bytes!("../data/version-1.3.h5").to_vec()).unwrap();
    let field = Field::new(&old, 0).unwrap();
    let mut u = [Jet::constant(0.0)];
    let mut at = |x: f64, y: f64, side| {
        assert!(field.at(vec2(x, y)).evaluate::<0>(Vec2::ZERO, side, &mut u));
        u[0].v
    };
    let [above, below] = [Side::Above, Side::Below];
    for (x, y, side, expected) in [
        (-0.5, 0.3, above, 2.0 + 3.0 + 7.0),
        (0.5, 0.3, above, 2.0 + 5.0 + 7.0),
        (0.5, -0.3, above, 2.0 - 7.0),
        (-1e-300, 1e-300, above, 2.0 + 3.0 + 7.0),
        // on the first crack, on the second, where they meet
        (-0.5, 0.0, above, 2.0 + 3.0 + 7.0),
        (-0.5, 0.0, below, 2.0 - 7.0),
        (0.0, 0.7, above, 2.0 + 3.0 + 7.0),
        (0.0, 0.7, below, 2.0 + 5.0 + 7.0),
        (0.0, 0.0, above, 2.0 + 3.0 + 7.0),
        (0.0, 0.0, below, 2.0 - 7.0),
    ] {
        assert!((at(x, y, side) - expected).abs() < 1e-14, "{x} {y} {side:?}");
    }
    let again = from_bytes(to_bytes(&old).unwrap()).unwrap();
    assert!(same(&again, &old));
}

/// The same dataset as the file of version 1.0, written by h5py: other layouts, texts of
/// variable length.
#[test]
fn files_of_h5py_are_read() {
    let own = from_bytes(include_bytes!("../data/version-1.0.h5").to_vec()).unwrap();
    let files: [&[u8]; 2] =
        [include_bytes!("../data/h5py-earliest.h5"), include_bytes!("../data/h5py-v110.h5")];
    for bytes in files {
        assert!(same(&from_bytes(bytes.to_vec()).unwrap(), &own));
    }
}

/// The same dataset as the file of version 1.1, in all the ways in which HDF5 stores arrays, links
/// and attributes (`tests/python/h5py_files.py`); the checksum covers what some files hold besides.
#[test]
fn files_of_all_layouts_are_read() {
    let own = from_bytes(include_bytes!("../data/version-1.1.h5").to_vec()).unwrap();
    let files = files_of_h5py();
    assert!(files.len() >= 12, "{} files", files.len());
    for (name, bytes) in files {
        let read = from_bytes(bytes).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(same(&read, &own), "{name}");
    }
}

/// Names and contents.
fn files_of_h5py() -> Vec<(String, Vec<u8>)> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/h5py");
    let entries = fs::read_dir(folder).expect("the folder is there");
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("a file").path()).collect();
    paths.sort();
    let content = |path: &std::path::PathBuf| fs::read(path).expect("a file");
    paths.iter().map(|path| (path.display().to_string(), content(path))).collect()
}

/// Arrays that compress far better than fields do are stored plain: a reader bounds what a file
/// expands to.
#[test]
fn what_is_written_can_be_read() {
    let mut data = dataset(4);
    data.steps.truncate(1);
    let patches = data.steps[0].partition.len();
    let values = |k: usize| Attribute { name: format!("a{k}"), values: vec![0.0; patches] };
    let count = (80 << 20) / (8 * patches);
    data.steps[0].attributes = (0..count).map(values).collect();
    let bytes = to_bytes(&data).unwrap();
    assert!(bytes.len() > 64 << 20, "{} bytes", bytes.len());
    assert!(from_bytes(bytes).unwrap().steps[0].attributes.len() == count);
}

/// Each function of its own, in time in proportion to their number.
#[test]
fn many_functions_are_read() {
    let mut data = dataset(2);
    data.steps.truncate(1);
    let text = |k: usize| format!("sin({k}*x)");
    let function = |k: usize| Function {
        name: format!("wave {k}"),
        kind: FunctionKind::formula(&text(k), Frame::World),
    };
    data.steps[0].functions.extend((0..10_000).map(function));
    let back = from_bytes(to_bytes(&data).unwrap()).unwrap();
    assert!(same(&back, &data));
    let long = format!("x{}", "+ sin(x)".repeat(8_000));
    let kind = FunctionKind::formula(&long, Frame::World);
    let many = vec![Function { name: "long".into(), kind }; 100];
    data.steps[0].functions.extend(many);
    let error = to_bytes(&data).unwrap_err().to_string();
    assert!(error.contains("functions[") && error.contains("at most 4194304 may be"), "{error}");
}

#[test]
fn lists_may_be_empty() {
    let mut data = dataset(1);
    let step = &mut data.steps[0];
    step.cracks.clear();
    step.functions.clear();
    step.fields.clear();
    step.attributes.clear();
    step.intensities.clear();
    step.history.clear();
    step.warnings.clear();
    step.reactions.clear();
    step.growth = Some(Growth::default());
    step.partition.boxes_mut().expect("boxes").points.clear();
    step.partition.boxes_mut().expect("boxes").point.fill(None);
    data.title.clear();
    data.problem = Some(String::new());
    assert!(same(&from_bytes(to_bytes(&data).unwrap()).unwrap(), &data));
}

/// Texts that no message of a header can hold, of the root and of steps.
#[test]
fn texts_of_any_length_are_stored() {
    for length in [59_999, 60_000, 60_001, 65_536, 300_001] {
        let mut data = dataset(1);
        data.title = "ü".repeat(length / 2) + &"x".repeat(length % 2);
        for step in &mut data.steps {
            step.fields[0].unit = data.title.clone();
        }
        let back = from_bytes(to_bytes(&data).unwrap()).unwrap();
        assert!(same(&back, &data), "{length}");
    }
}

#[test]
fn what_has_no_meaning_is_not_written() {
    let mut data = dataset(2);
    data.steps[0].fields[0].coefficients[0][3] = f64::NAN;
    assert!(matches!(to_bytes(&data), Err(WriteError::Invalid(_))));
    let mut data = dataset(2);
    data.title = "a\0b".into();
    assert!(
        matches!(to_bytes(&data), Err(WriteError::Object { object, .. }) if object == "@title")
    );
}

/// Geometry and indices of a large cover compress; what is read is the same.
#[test]
fn large_arrays_are_compressed() {
    let mut data = dataset(4);
    data.steps.truncate(1);
    let step = &mut data.steps[0];
    step.attributes.clear();
    step.fields.clear();
    let cover = Cover::grid(data.domain.bounds, [160, 125]).unwrap();
    step.partition = cover.partition(1.3, WeightFunction::Linear).unwrap().into();
    let many = step.partition.len();
    assert_eq!(many, 20_000);
    let bytes = to_bytes(&data).unwrap();
    assert!(bytes.len() < many * 40, "{} bytes for {many} patches", bytes.len());
    assert!(same(&from_bytes(bytes).unwrap(), &data));
}

/// Truncation at every length class: an error each time.
#[test]
fn truncated_files_are_errors() {
    let bytes = to_bytes(&dataset(3)).unwrap();
    let mut random = Random(1);
    for k in 0..300 {
        let length = if k < 100 { k } else { random.below(bytes.len()) };
        assert!(from_bytes(bytes[..length].to_vec()).is_err(), "cut to {length}");
    }
}

/// Changed bytes: an error, or the very same dataset where the bytes mean nothing.
#[test]
fn damaged_files_are_errors() {
    damage_files(200, 2);
}

fn damage_files(count: usize, seed: u64) {
    let data = dataset(5);
    let (original, bytes) = (Original::new(&data), to_bytes(&data).expect("it is written"));
    let mut random = Random(seed);
    let mut found = 0;
    for k in 0..count {
        let mut damaged = bytes.clone();
        for _ in 0..=k % 4 {
            let at = random.below(damaged.len());
            damaged[at] ^= 1 << random.below(8);
        }
        match from_bytes(damaged) {
            Err(_) => found += 1,
            Ok(read) => assert!(original.is(&read), "damage {k}"),
        }
    }
    assert!(found > count / 2, "only {found} of {count} were found");
}

/// Metadata is where damage could make the library allocate: bytes replaced by extreme values.
#[test]
fn damaged_metadata_is_an_error() {
    damage_metadata(400, 3);
}

fn damage_metadata(count: usize, seed: u64) {
    let mut data = dataset(5);
    data.steps.truncate(1);
    data.problem = None;
    let (original, bytes) = (Original::new(&data), to_bytes(&data).expect("it is written"));
    let mut random = Random(seed);
    let headers: Vec<usize> = bytes
        .windows(4)
        .enumerate()
        .filter(|(_, w)| [b"OHDR", b"OCHK", b"FRHP", b"BTHD", b"GCOL"].iter().any(|m| m == w))
        .map(|(at, _)| at)
        .collect();
    assert!(headers.len() > 30, "{} headers", headers.len());
    for _ in 0..count {
        let mut damaged = bytes.clone();
        let header = headers[random.below(headers.len())];
        let at = (header + random.below(200)).min(bytes.len() - 8);
        let width = [1, 2, 4, 8][random.below(4)];
        let fill = [0x00, 0x01, 0x7f, 0x80, 0xff][random.below(5)];
        damaged[at..at + width].fill(fill);
        if let Ok(read) = from_bytes(damaged) {
            assert!(original.is(&read));
        }
    }
}

/// The same without the library's own header checksums, which would find most of the damage: they
/// are recomputed, as by somebody who means it.
#[test]
fn forged_metadata_is_an_error() {
    forge_metadata(400, 4);
}

fn forge_metadata(count: usize, seed: u64) {
    let mut data = dataset(5);
    data.steps.truncate(1);
    let (original, bytes) = (Original::new(&data), to_bytes(&data).expect("it is written"));
    let headers = object_headers(&bytes);
    assert!(headers.len() > 30, "{} headers", headers.len());
    let mut random = Random(seed);
    for _ in 0..count {
        let mut forged = bytes.clone();
        let header = &headers[random.below(headers.len())];
        let at = header.start + 6 + random.below(header.len() - 10);
        let width = [1, 2, 4, 8][random.below(4)].min(header.end - 4 - at);
        let fill = [0x00, 0x01, 0x7f, 0x80, 0xff][random.below(5)];
        forged[at..at + width].fill(fill);
        seal(&mut forged, header);
        if let Ok(read) = from_bytes(forged) {
            assert!(original.is(&read));
        }
    }
}

/// The same for all that other programs write: heaps, trees and arrays that lead anywhere. Refused
/// or without effect, and at once.
#[test]
fn forged_files_of_other_programs_are_errors() {
    forge_files_of_other_programs(60, 8);
}

/// Forges each of the files so many times.
fn forge_files_of_other_programs(count: usize, seed: u64) {
    let own = from_bytes(include_bytes!("../data/version-1.1.h5").to_vec()).expect("it is read");
    let own = Original::new(&own);
    let mut random = Random(seed);
    let mut kinds = BTreeSet::new();
    for (name, bytes) in files_of_h5py() {
        let mut parts: BTreeMap<&[u8], Vec<Range<usize>>> = BTreeMap::new();
        for part in sealed_parts(&bytes) {
            parts.entry(&bytes[part.start..part.start + 4]).or_default().push(part);
        }
        kinds.extend(parts.keys().map(|kind| kind.to_vec()));
        // version 1 of trees and headers has no checksums
        let parts: Vec<_> = parts.into_values().collect();
        for round in 0..count {
            let mut forged = bytes.clone();
            let part = match round.checked_rem(parts.len()) {
                None => 0..bytes.len(),
                Some(kind) => parts[kind][random.below(parts[kind].len())].clone(),
            };
            let at = part.start + 6 + random.below(part.len() - 10);
            let width = [1, 2, 4, 8][random.below(4)].min(part.end - 4 - at);
            let fill = [0x00, 0x01, 0x10, 0x7f, 0x80, 0xff][random.below(6)];
            forged[at..at + width].fill(fill);
            if !parts.is_empty() {
                seal(&mut forged, &part);
            }
            if let Ok(read) = run_within_limit(&format!("{name} at {at}"), || from_bytes(forged)) {
                // bytes of the values of arrays are looked at by the checksum of the content, which
                // such a change can hide
                assert!(own.is(&read) || !parts.is_empty(), "{name} at {at}");
            }
        }
    }
    assert!(kinds.len() >= 12, "{} kinds of parts", kinds.len());
}

/// Runs work on a single thread, and checks that it takes no more than some seconds of
/// processor time.
fn run_within_limit<T: Send>(what: &str, work: impl FnOnce() -> T + Send) -> T {
    static POOL: LazyLock<rayon::ThreadPool> =
        LazyLock::new(|| rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool"));
    POOL.install(|| {
        let start = thread_time();
        let result = work();
        let time = thread_time().saturating_sub(start);
        assert!(time < Duration::from_secs(10), "{what}: {time:?}");
        result
    })
}

/// Files of other programs, damaged in all ways that the fuzzer knows.
#[test]
fn damaged_files_of_other_programs_are_errors() {
    damage_files_of_other_programs(30, 9);
}

/// Damages each of the files so many times.
fn damage_files_of_other_programs(count: usize, seed: u64) {
    let own = from_bytes(include_bytes!("../data/version-1.1.h5").to_vec()).expect("it is read");
    let own = Original::new(&own);
    let mut random = Random(seed);
    let mut refused = 0;
    for (name, bytes) in files_of_h5py() {
        for _ in 0..count {
            let damaged = damaged(&bytes, &mut |below| random.below(below));
            let what = format!("{name}, {}", damaged.what);
            match run_within_limit(&what, || from_bytes(damaged.bytes)) {
                Err(_) => refused += 1,
                Ok(read) => {
                    assert!(damaged.is_sealed || own.is(&read), "{what}")
                }
            }
        }
    }
    assert!(refused > 4 * count, "{refused} were refused");
}

/// Without the checksum of the content the checks of the data stand alone: an error or a dataset
/// that can be evaluated, and never a panic.
#[test]
fn damage_that_no_checksum_finds() {
    damage_without_checksum(240, 6);
}

fn damage_without_checksum(count: usize, seed: u64) {
    let mut data = dataset(3);
    data.steps.truncate(1);
    let mut bytes = to_bytes(&data).expect("it is written");
    let has_sum = |header: &Range<usize>| bytes[header.clone()].windows(6).any(|w| w == b"sha256");
    let header = object_headers(&bytes).into_iter().find(has_sum).expect("a checksum");
    let at = header.start + position(&bytes[header.clone()], b"sha256");
    bytes[at + 5] = b'7';
    seal(&mut bytes, &header);
    assert!(from_bytes(bytes.clone()).is_ok(), "a file without checksum is fine");

    let headers = object_headers(&bytes);
    let mut random = Random(seed);
    let mut readable = 0;
    for k in 0..count {
        let mut damaged = bytes.clone();
        if k % 2 == 0 {
            let header = &headers[random.below(headers.len())];
            let at = header.start + 6 + random.below(header.len() - 10);
            damaged[at] = [0, 1, 2, 0x7f, 0xff][random.below(5)];
            seal(&mut damaged, header);
        } else {
            let at = random.below(damaged.len());
            damaged[at] ^= 1 << random.below(8);
        }
        if let Ok(read) = from_bytes(damaged) {
            readable += 1;
            let center = read.domain.bounds.center();
            if let Ok(field) = Field::new(&read, 0) {
                let mut out = vec![Jet::constant(0.0); field.components()];
                field.at(center).evaluate::<2>(Vec2::ZERO, Side::Above, &mut out);
            }
        }
    }
    assert!(30 * readable > count, "only {readable} of {count} were readable: nothing was tested");
}

/// All of these kinds of damage, many more times.
#[test]
#[ignore = "slow: thousands of damaged files"]
fn many_damaged_files_are_errors() {
    damage_files(300, 22);
    damage_metadata(600, 23);
    forge_metadata(600, 24);
    forge_files_of_other_programs(40, 28);
    damage_files_of_other_programs(40, 29);
    damage_without_checksum(360, 26);
}

fn position(bytes: &[u8], pattern: &[u8]) -> usize {
    bytes.windows(pattern.len()).position(|w| w == pattern).expect("the pattern is there")
}

/// Files that the example `fuzz_files` of `ppum-bench` has found give an error or a dataset.
#[test]
fn files_that_were_found_are_survived() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/hostile");
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries {
        let _ = read(&entry.unwrap().path());
    }
}

#[test]
fn other_files_are_refused_politely() {
    assert!(matches!(from_bytes(vec![]), Err(ReadError::Hdf5 { .. })));
    assert!(matches!(from_bytes(b"title = 1".to_vec()), Err(ReadError::Hdf5 { .. })));
    let missing = read(std::path::Path::new("/nowhere/at/all.h5")).unwrap_err();
    assert!(missing.to_string().contains("/nowhere/at/all.h5"), "{missing}");
}

mod on_disk {
    use super::*;

    #[test]
    fn written_files_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.h5");
        write(&dataset(6), &path).unwrap();
        write(&dataset(7), &path).unwrap();
        assert!(same(&read(&path).unwrap(), &dataset(7)));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "nothing else is left");
    }

    /// Replacing files is the matter of `ppum-file`.
    #[test]
    fn what_is_no_file_is_neither_read_nor_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.h5");
        fs::write(&path, b"precious").unwrap();
        let mut bad = dataset(8);
        bad.steps.clear();
        assert!(matches!(write(&bad, &path), Err(WriteError::Invalid(_))));
        assert_eq!(fs::read(&path).unwrap(), b"precious");
        assert!(matches!(write(&dataset(8), folder.path()), Err(WriteError::Io { .. })));
        assert!(matches!(read(folder.path()), Err(ReadError::Io { .. })));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "nothing else is left");
    }

    /// A file with a hole, which takes no room and would take all memory.
    #[cfg(unix)]
    #[test]
    fn longer_files_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.h5");
        fs::write(&path, b"\x89HDF\r\n\x1a\n").unwrap();
        fs::File::options().write(true).open(&path).unwrap().set_len(1 << 40).unwrap();
        let error = read(&path).unwrap_err().to_string();
        assert!(error.ends_with("it has more than 4 GiB, the most that are read"), "{error}");
    }
}

/// Errors go from thread to thread and into any box of errors.
#[test]
fn errors_are_values_of_their_own() {
    fn is_free<E: std::error::Error + Send + Sync + 'static>() -> bool {
        size_of::<E>() > 0
    }
    assert!(is_free::<ReadError>() && is_free::<WriteError>());
}
