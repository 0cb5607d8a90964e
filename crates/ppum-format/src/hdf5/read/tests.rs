//! Structures made to hurt, which no writer makes. Each is refused at once, for the reason given.

#[path = "../../../tests/fixture/series.rs"]
mod steps;

use std::cell::Cell;
use std::time::Duration;

use ppum_testkit::processor::thread_time;

use super::super::budget::ReadBudget;
use super::chunks::ChunkLocation;
use super::error::ReadResult;
use super::filters::{Pipeline, filters};
use super::header::Header;
use super::packing::unpacked;
use super::pages::{PAGE, PageCache, PageChain};
use super::source::Hdf5Source;
use super::trees::{CHUNKS, entries};
use super::types::{DatatypeClass, Padding, Type};
use super::{Outline, Ranges, TextCollections, arrays, from_bytes};
use crate::content::{ArrayValues, step_path};
use crate::forge::{seal, sealed_parts};
use crate::schema::RESULTS;

const FIXED: &[u8] = include_bytes!("../../../tests/data/h5py/v110-fixed.h5");
const GROWING: &[u8] = include_bytes!("../../../tests/data/h5py/v200-first.h5");

/// Runs work on a single thread, and checks that it takes no more than some seconds of
/// processor time.
fn run_within_limit<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    pool.install(|| {
        let start = thread_time();
        let result = work();
        let time = thread_time().saturating_sub(start);
        assert!(time < Duration::from_secs(5), "{time:?}");
        result
    })
}

/// Reads from a file of these bytes.
fn with_source<T>(bytes: &[u8], budget: &ReadBudget, read: impl FnOnce(Hdf5Source) -> T) -> T {
    let chain = PageChain::default();
    let parts = PageCache::new(&bytes, 0, bytes.len() as u64, &chain);
    read(Hdf5Source::new(&parts, [8, 8], budget))
}

/// The reason why a structure in a file of these bytes is refused.
fn refusal(bytes: &[u8], read: impl Fn(Hdf5Source) -> ReadResult<()> + Sync) -> String {
    run_within_limit(|| {
        let budget = ReadBudget::for_file(bytes.len() as u64);
        with_source(bytes, &budget, |source| {
            let Err(message) = read(source) else { panic!("it is not refused") };
            message.into()
        })
    })
}

/// A header of version 1 with one message: there is more of it, at its own start.
#[test]
fn a_header_that_continues_in_itself() {
    let mut header = vec![1, 0, 1, 0, 1, 0, 0, 0, 24, 0, 0, 0, 0, 0, 0, 0];
    header.extend([0x10, 0, 16, 0, 0, 0, 0, 0, 16, 0, 0, 0, 0, 0, 0, 0, 24, 0, 0, 0, 0, 0, 0, 0]);
    let message = refusal(&header, |source| Header::read(source, 0).map(drop));
    assert!(message.contains("circle"), "{message}");
}

/// A node of an index whose only child is itself.
#[test]
fn a_tree_that_is_its_own_branch() {
    let mut node = b"TREE\x01\x05\x01\0".to_vec();
    node.resize(200, 0);
    let message = refusal(&node, |source| entries(source, 0, CHUNKS, 24).map(drop));
    assert!(message.contains("levels"), "{message}");
}

/// A node with as many children as it can have, all of them the same leaf, on many levels.
#[test]
fn a_tree_whose_branches_are_all_the_same() {
    let mut file = Vec::new();
    for level in (0..9_u8).rev() {
        let count = 40_u16;
        file.extend(b"TREE\x01");
        file.push(level);
        file.extend(count.to_le_bytes());
        file.extend([0xff; 16]);
        let child = (1360 * u64::from(9 - level)).to_le_bytes();
        (0..count).for_each(|_| file.extend([[0; 24].as_slice(), &child].concat()));
        file.resize(1360 * usize::from(9 - level), 0);
    }
    file.resize(1 << 16, 0);
    let message = refusal(&file, |source| entries(source, 0, CHUNKS, 24).map(drop));
    assert!(message.contains("larger than the file"), "{message}");
}

/// A file with one part changed by somebody who means it.
fn forged(file: &[u8], signature: &[u8], at: usize, new: &[u8]) -> Vec<u8> {
    let mut bytes = file.to_vec();
    let parts = sealed_parts(file);
    let part = parts.iter().find(|part| file[part.start..].starts_with(signature));
    let part = part.expect("the file has such a part").clone();
    bytes[part.start + at..][..new.len()].copy_from_slice(new);
    seal(&mut bytes, &part);
    bytes
}

#[test]
fn arrays_of_chunks_without_end() {
    let entries = 1_u64 << 60;
    let cases = [
        // number of entries; bits of a place in a page
        (forged(FIXED, b"FAHD", 8, &entries.to_le_bytes()), "beyond the end"),
        (forged(FIXED, b"FAHD", 7, &[64]), "impossible sizes"),
        // bits of a number; entries of the index block, of a data block
        (forged(GROWING, b"EAHD", 7, &[255]), "impossible sizes"),
        (forged(GROWING, b"EAHD", 8, &[255]), "checksum"),
        (forged(GROWING, b"EAHD", 9, &[3]), "impossible sizes"),
    ];
    for (bytes, reason) in cases {
        let error = run_within_limit(|| from_bytes(&bytes)).expect_err(reason).to_string();
        assert!(error.contains(reason), "{error}, not {reason}");
    }
}

/// The last entries of an array of 2^60, without reading what is before.
#[test]
fn an_entry_far_out() {
    let bytes = forged(FIXED, b"FAHD", 8, &(1_u64 << 60).to_le_bytes());
    let parts = sealed_parts(&bytes);
    let header = parts.iter().find(|part| bytes[part.start..].starts_with(b"FAHD")).expect("there");
    let at = header.start as u64;
    let message = refusal(&bytes, |source| {
        arrays::FixedArray::open(source, at)?.entry((1 << 60) - 1).map(drop)
    });
    assert!(message.contains("beyond the end"), "{message}");
}

/// Filters of a chunk, in the second version of their message.
fn pipeline(ids: &[u8], bytes: u64) -> ReadResult<Pipeline> {
    let budget = ReadBudget::for_file(0);
    let mut message = vec![2, ids.len() as u8];
    ids.iter().for_each(|id| message.extend([*id, 0, 0, 0, 0, 0]));
    with_source(&message, &budget, |source| {
        let message = source.at(0, source.length())?;
        Ok(Pipeline { filters: filters(message)?, size: 8, bytes })
    })
}

/// Chunks that expand to more than the file is worth are refused before anything is expanded.
#[test]
fn bombs() {
    let stored = ChunkLocation { address: 0, bytes: 100, mask: 0 };
    for (ids, bytes) in [(&[2, 1][..], 1_u64 << 33), (&[2, 1], 1 << 50), (&[3, 1], 1 << 28)] {
        let paid = |source: Hdf5Source| pipeline(ids, bytes)?.charge(stored, 5, source.budget);
        let message = refusal(&[0; 1000], paid);
        assert!(message.contains("too large"), "{ids:?} {bytes}: {message}");
    }
    // two of 3 GiB are together too much, though each is not; neither can be decompressed
    let paid = |source: Hdf5Source| {
        let pipeline = pipeline(&[2, 1], 3 << 30)?;
        assert!(pipeline.undo(&[0; 100], 0, 5).is_err_and(|e| e.contains("decompressed")));
        assert!(pipeline.charge(stored, 5, source.budget).is_ok());
        pipeline.charge(stored, 5, source.budget)
    };
    assert!(refusal(&[0; 1000], paid).contains("too large"));
}

/// LZF: references to nothing, and a short text that unpacks to more than its chunk.
#[test]
fn packed_texts() {
    assert!(unpacked(&[0x20, 0x00], 100).is_err());
    let mut bomb = vec![0, b'x'];
    bomb.extend([0xe0, 0xff, 0x00].repeat(1000));
    assert!(unpacked(&bomb, 1000).is_err());
    assert_eq!(unpacked(&bomb, 300_000).ok(), Some(vec![b'x'; 1 + 264 * 1000]));
    // "abc", and then its first two letters
    assert_eq!(unpacked(b"\x02abc\x00\x61\x20\x02", 100).ok().as_deref(), Some(&b"abcabca"[..]));
}

/// Texts of fixed length in the three ways of HDF5.
#[test]
fn paddings() {
    let budget = ReadBudget::for_file(0);
    for (padding, raw, expected) in [
        (Padding::Nuls, &b"ab \0\0"[..], Some("ab ")),
        (Padding::Nuls, b"a\0b\0\0", None),
        (Padding::Terminated, b"ab\0xy", Some("ab")),
        (Padding::Spaces, b" ab  ", Some(" ab")),
        (Padding::Nuls, b"\xffb\0\0\0", None),
        (Padding::Nuls, b"\0\0\0\0\0", Some("")),
    ] {
        let text = Type { kind: DatatypeClass::Text(padding), size: 5, is_big: false };
        let values = with_source(&[], &budget, |source| {
            text.values(1, &mut TextCollections::new(source), |bytes| {
                bytes.copy_from_slice(raw);
                Ok(())
            })
        });
        let expected = expected.map(|text| ArrayValues::Text(vec![text.to_owned()]));
        assert_eq!(values.ok(), expected, "{padding:?} {raw:?}");
    }
}

/// Numbers are whole, in either order of bytes: others are types outside the format, and told
/// by name.
#[test]
fn types_of_numbers() {
    let budget = ReadBudget::for_file(0);
    let name = |message: &[u8]| {
        with_source(message, &budget, |source| {
            Some(Type::parse(source.at(0, source.length()).ok()?).ok()?.kind)
        })
    };
    let integer = |flags: u8, size: u8, bits: u8| [0x10, flags, 0, 0, size, 0, 0, 0, 0, 0, bits, 0];
    assert_eq!(name(&integer(0, 8, 64)), Some(DatatypeClass::U64));
    assert_eq!(name(&integer(8, 8, 64)), Some(DatatypeClass::I64));
    assert_eq!(name(&integer(1, 8, 64)), Some(DatatypeClass::U64));
    assert_eq!(name(&integer(8, 4, 32)), Some(DatatypeClass::Other("i32".into())));
    assert_eq!(name(&integer(0, 4, 31)), Some(DatatypeClass::Other("u31".into())));
    assert_eq!(name(&integer(0, 0, 0)), None);
    let float = |order: u8, bias: u8| {
        [0x11, 0x20 | order, 0x3f, 0, 8, 0, 0, 0, 0, 0, 64, 0, 52, 11, 0, 52, bias, 3, 0, 0]
    };
    assert_eq!(name(&float(0, 0xff)), Some(DatatypeClass::F64));
    assert_eq!(name(&float(1, 0xff)), Some(DatatypeClass::F64));
    assert_eq!(name(&float(0, 0xfe)), Some(DatatypeClass::Other("f64".into())));
}

/// A file that counts what is read of it.
struct CountingFile {
    bytes: Vec<u8>,
    read: Cell<u64>,
}

impl Ranges for CountingFile {
    fn read(&self, at: u64, buffer: &mut [u8]) -> std::io::Result<()> {
        self.read.set(self.read.get() + buffer.len() as u64);
        Ranges::read(&self.bytes.as_slice(), at, buffer)
    }
}

/// Bytes of each step in a file of so many, and those that are read for its outline, for three of
/// its steps and for their results.
struct Costs {
    length: u64,
    outline: u64,
    steps: [u64; 3],
    results: [u64; 3],
}

fn costs(steps: usize) -> Costs {
    let mut dataset = steps::beginning();
    dataset.steps = vec![steps::step(4); steps];
    let bytes = crate::to_bytes(&dataset).expect("valid");
    let length = bytes.len() as u64;
    let file = CountingFile { bytes, read: Cell::new(0) };
    let outline = Outline::read(&file, length).expect("a series");
    assert_eq!(outline.steps().len(), steps);
    let of_outline = file.read.take();
    let read = |number, members, least| {
        let content = outline.step(&file, &step_path(number), members).expect("a step");
        assert!(content.len() > least);
        file.read.take()
    };
    let numbers = [0, steps / 2, steps - 1];
    Costs {
        length: length / steps as u64,
        outline: of_outline,
        steps: numbers.map(|number| read(number, None, 30)),
        results: numbers.map(|number| read(number, Some(RESULTS), 10)),
    }
}

/// One step of hundreds costs as much as one of two, and some pages more than it has bytes.
#[test]
fn a_step_costs_as_much_as_it_is_long() {
    let (few, many) = (costs(2), costs(500));
    for (few, one) in few.steps.iter().zip(many.steps) {
        assert!(
            one <= few + 2 * PAGE && one <= many.length + 3 * PAGE,
            "{one} {few} {}",
            many.length
        );
    }
    assert!(many.results.iter().all(|one| *one <= 4 * PAGE), "{:?}", many.results);
    // links stand in blocks of 64, each read with its page or two
    let most = few.outline + (500 / 64 + 2) * 2 * PAGE;
    assert!(many.outline <= most, "{} {}", few.outline, many.outline);
}

/// Reading in parts gives the same as reading as a whole, whatever wrote the file.
#[test]
fn parts_are_the_whole() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/h5py");
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let bytes = std::fs::read(entry.expect("an entry").path()).expect("a file");
        let whole = from_bytes(&bytes).expect("a dataset");
        let outline = Outline::read(&bytes.as_slice(), bytes.len() as u64).expect("a dataset");
        let mut parts = outline.content.clone();
        for path in outline.steps() {
            let step = outline.step(&bytes.as_slice(), path, None).expect("a step");
            step.iter().for_each(|(name, array)| drop(parts.insert(name.clone(), array.clone())));
        }
        assert_eq!(*parts, *whole);
    }
}
