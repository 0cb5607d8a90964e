//! Files that grow step by step.

#[path = "../fixture/series.rs"]
mod steps;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::damage::damaged;
use ppum::dataset::Dataset;
use ppum_format::{Series, SeriesWriter, WriteError, from_bytes, read, to_bytes, write};
use ppum_testkit::random::Random;

use crate::files::everything::dataset;

/// A dataset of so many steps that differ, each with all kinds of results.
fn series(steps: usize) -> Dataset {
    repeated(dataset(0), steps)
}

/// A dataset of so many steps, which differ from its first one in two numbers.
fn repeated(mut all: Dataset, steps: usize) -> Dataset {
    let step = all.steps[0].clone();
    all.steps = (0..steps)
        .map(|k| {
            let mut step = step.clone();
            step.load = k as f64;
            step.fields[0].coefficients[0][0] = 0.1 * k as f64;
            step
        })
        .collect();
    all
}

/// The same with one of its steps alone.
fn one(dataset: &Dataset, number: usize) -> Dataset {
    let mut one = dataset.clone();
    one.steps = vec![dataset.steps[number].clone()];
    one
}

/// Debug output tells every double apart, and a NaN is equal to a NaN.
fn assert_same(a: &Dataset, b: &Dataset) {
    assert_eq!(format!("{a:?}"), format!("{b:?}"));
}

/// Begins a file and appends the other steps one by one.
fn grow(path: &Path, dataset: &Dataset) {
    let mut writer = SeriesWriter::begin(path, &one(dataset, 0)).expect("begun");
    for step in &dataset.steps[1..] {
        writer.append(step).expect("appended");
    }
}

/// What has grown step by step, with and without breaks, is what is written at once: steps with all
/// kinds of results, and more of them than two headers have room for.
#[test]
fn all_ways_lead_to_the_same_bytes() {
    [series(4), fixture(150)].iter().for_each(written_in_all_ways);
}

fn written_in_all_ways(all: &Dataset) {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    grow(&at("grown"), all);
    let mut writer = SeriesWriter::begin(&at("resumed"), &one(all, 0)).expect("a series");
    for (k, step) in all.steps.iter().enumerate().skip(1) {
        assert_eq!(writer.len(), k);
        writer.append(step).expect("a series");
        drop(writer);
        writer = SeriesWriter::resume(&at("resumed")).expect("a series");
    }
    drop(SeriesWriter::begin(&at("begun"), all).expect("a series"));
    write(all, &at("written")).expect("a series");
    let bytes = to_bytes(all).expect("it is written");
    for name in ["grown", "resumed", "begun", "written"] {
        assert!(fs::read(at(name)).expect("a series") == bytes, "{name}");
    }
    assert_same(&read(&at("grown")).expect("a series"), all);
    assert_same(&from_bytes(bytes).expect("it is read"), all);
}

#[test]
fn steps_are_read_one_by_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let all = series(12);
    write(&all, &path).unwrap();
    let series = Series::open(&path).unwrap();
    assert_eq!((series.len(), series.head().steps.len()), (12, 0));
    for number in [0, 11, 5] {
        assert_same(&series.dataset(number).unwrap(), &one(&all, number));
        let (results, step) = (series.results(number).unwrap(), &all.steps[number]);
        assert_eq!((results.load, &results.cracks), (step.load, &step.cracks));
        assert_eq!(format!("{:?}", results.intensities), format!("{:?}", step.intensities));
        assert_eq!(format!("{:?}", results.history), format!("{:?}", step.history));
        assert!(results.fields.is_empty() && results.partition.is_empty());
    }
    let error = series.dataset(12).unwrap_err().to_string();
    assert!(error.contains("there are 12 steps, the last is 11"), "{error}");
}

/// The series of the fixture with so many steps.
fn fixture(steps: usize) -> Dataset {
    let mut dataset = steps::beginning();
    dataset.steps.extend((1..steps).map(steps::step));
    dataset
}

/// What may be there when a program is killed in the middle of a step: any part of what it appends.
#[test]
fn unfinished_steps_are_not_seen() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let (old, new) = (to_bytes(&fixture(70)).unwrap(), to_bytes(&fixture(71)).unwrap());
    let rest = &new[old.len()..];
    for count in (0..rest.len()).step_by(97).chain([rest.len()]) {
        fs::write(&path, [&old, &rest[..count]].concat()).unwrap();
        assert_eq!(Series::open(&path).unwrap().len(), 70, "{count}");
    }
    assert_same(&read(&path).unwrap(), &fixture(70));
    // the disk may have kept anything at all of what was not seen to it
    fs::write(&path, [old.as_slice(), &[0xff; 100_000]].concat()).unwrap();
    let mut writer = SeriesWriter::resume(&path).unwrap();
    writer.append(&steps::step(70)).unwrap();
    assert!(fs::read(&path).unwrap() == new);
    // published, but cut afterwards
    fs::write(&path, &new[..new.len() - 1]).unwrap();
    assert!(Series::open(&path).unwrap_err().to_string().contains("truncated"));
}

/// Where a run of its own finds the file that it is to write, and what it is to do.
const FILE: &str = "PPUM_TEST_SERIES";

/// Not a test but the run that others kill: appends steps until it cannot. Without a file it has
/// nothing to do.
#[test]
fn a_run() {
    let Some(path) = std::env::var_os(FILE).map(PathBuf::from) else { return };
    let mut writer = match path.exists() {
        true => SeriesWriter::resume(&path).unwrap(),
        false => SeriesWriter::begin(&path, &steps::beginning()).unwrap(),
    };
    loop {
        let before = (writer.len(), fs::metadata(&path).unwrap().len());
        if let Err(error) = writer.append(&steps::step(before.0)) {
            assert_eq!(before, (writer.len(), fs::metadata(&path).unwrap().len()));
            eprintln!("{error}");
            return;
        }
    }
}

/// A run in a process of its own, through a shell with these commands before it.
fn run(path: &Path, before: &str) -> Command {
    let program = std::env::current_exe().expect("it runs");
    let mut command = Command::new("sh");
    let run = format!("{before}\nexec \"$0\" --exact series::a_run --nocapture");
    command.arg("-c").arg(run).arg(program).env(FILE, path);
    command
}

fn length(path: &Path) -> u64 {
    fs::metadata(path).map_or(0, |data| data.len())
}

/// A run is killed fifty times or more. The file always opens with at least the steps that were
/// there, and in the end it has the bytes of a run that was never interrupted.
#[cfg(unix)]
#[test]
fn killed_at_random_moments() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let (mut random, mut len) = (Random(7), 0);
    let mut lengths = Vec::new();
    while lengths.len() < 50 || len <= 50 {
        assert!(lengths.len() < 500, "the runs come to nothing: {lengths:?}");
        let quiet = || Stdio::null();
        let mut run = run(&path, "").stdout(quiet()).stderr(quiet()).spawn().unwrap();
        // some steps later, or in the middle of one
        let wanted = length(&path) + random.below(60_000) as u64;
        while length(&path) < wanted {
            assert!(run.try_wait().unwrap().is_none(), "the run ends at {} bytes", length(&path));
            std::thread::yield_now();
        }
        run.kill().unwrap();
        run.wait().unwrap();
        let found = if path.exists() { Series::open(&path).unwrap().len() } else { 0 };
        assert!(found >= len, "{found} steps, {len} before");
        len = found;
        lengths.push(len);
    }
    let mut writer = SeriesWriter::resume(&path).unwrap();
    assert_eq!(writer.len(), len);
    writer.append(&steps::step(len)).unwrap();
    drop(writer);
    assert!(fs::read(&path).unwrap() == to_bytes(&fixture(len + 1)).unwrap());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "nothing else is left");
}

/// The file ends where the last whole step does, and the reason is told.
#[cfg(unix)]
#[test]
fn a_full_disk() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    write(&fixture(2), &path).unwrap();
    // the signal would end the run, as it does one that is killed; the program ignores it
    let done = run(&path, "trap '' XFSZ; ulimit -f 200").output().unwrap();
    let told = String::from_utf8_lossy(&done.stderr).into_owned();
    assert!(done.status.success() && told.contains("cannot write"), "{told}");
    assert!(told.contains("File too large"), "{told}");
    let len = Series::open(&path).unwrap().len();
    assert!((3..70).contains(&len), "{len}");
    assert!(fs::read(&path).unwrap() == to_bytes(&fixture(len)).unwrap());
}

#[test]
fn one_run_at_a_time() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let all = fixture(3);
    let mut writer = SeriesWriter::begin(&path, &one(&all, 0)).unwrap();
    let bytes = fs::read(&path).unwrap();
    let others = [
        SeriesWriter::resume(&path).map(drop),
        SeriesWriter::begin(&path, &all).map(drop),
        write(&all, &path),
    ];
    for other in others {
        let error = other.unwrap_err().to_string();
        assert!(error.contains("is being written by another run"), "{error}");
    }
    assert!(fs::read(&path).unwrap() == bytes);
    let series = Series::open(&path).unwrap();
    writer.append(&all.steps[1]).unwrap();
    // who reads sees what was there
    assert_same(&series.dataset(0).unwrap(), &one(&all, 0));
    assert_eq!((series.len(), Series::open(&path).unwrap().len()), (1, 2));
}

/// Who reads while a run appends sees whole steps, the last one too.
#[test]
fn reading_while_a_run_appends() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let mut writer = SeriesWriter::begin(&path, &steps::beginning()).unwrap();
    std::thread::scope(|scope| {
        let writing = scope.spawn(|| (1..90).try_for_each(|k| writer.append(&steps::step(k))));
        let mut seen = Vec::new();
        while !writing.is_finished() {
            let series = Series::open(&path).unwrap();
            let last = series.len() - 1;
            let step = series.dataset(last).unwrap().steps.remove(0);
            assert_eq!(step.load, 1.0 + last as f64);
            assert!(read(&path).unwrap().steps.len() > last);
            seen.push(last);
        }
        writing.join().unwrap().unwrap();
        seen.dedup();
        assert!(seen.is_sorted() && seen.len() > 3, "{seen:?}");
    });
}

#[test]
fn what_cannot_be_continued() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let refused = |name: &str, reason: &str| {
        let error = SeriesWriter::resume(&at(name)).unwrap_err().to_string();
        assert!(error.contains(reason), "{name}: {error}");
        assert!(error.contains(name), "{name}: {error}");
    };
    refused("none.h5", "cannot write");
    write(&fixture(1), &at("whole.h5")).unwrap();
    refused("whole.h5", "one checksum over all of it; begin a new series");
    fs::write(at("text.h5"), "no dataset").unwrap();
    refused("text.h5", "signature");
    write(&fixture(2), &at("protected.h5")).unwrap();
    let mut permissions = fs::metadata(at("protected.h5")).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(at("protected.h5"), permissions).unwrap();
    refused("protected.h5", "write-protected");
}

/// A step that breaks a rule is named by the number it would have, and nothing is written.
#[test]
fn steps_are_checked_before_they_are_appended() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let mut writer = SeriesWriter::begin(&path, &fixture(2)).unwrap();
    let bytes = fs::read(&path).unwrap();
    let mut broken = steps::step(2);
    broken.fields[0].coefficients[0][3] = f64::NAN;
    let error = writer.append(&broken).unwrap_err();
    assert!(matches!(error, WriteError::Invalid(_)));
    assert!(error.to_string().contains("steps[2].fields[0].coefficients[0][3]"), "{error}");
    assert!(fs::read(&path).unwrap() == bytes);
    writer.append(&steps::step(2)).unwrap();
    assert!(fs::read(&path).unwrap() == to_bytes(&fixture(3)).unwrap());
}

/// Damage to a step is seen where this step is read, and by whoever reads them all.
#[test]
fn damage_to_one_step() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let data = fixture(3);
    let mut bytes = to_bytes(&data).unwrap();
    let value = data.steps[1].fields[0].coefficients[0][5].to_le_bytes();
    let at = bytes.windows(8).position(|w| w == value).expect("it is stored plain");
    bytes[at] ^= 1;
    fs::write(&path, &bytes).unwrap();
    let series = Series::open(&path).unwrap();
    assert_same(&series.dataset(0).unwrap(), &one(&data, 0));
    assert_same(&series.dataset(2).unwrap(), &one(&data, 2));
    for error in [series.dataset(1).unwrap_err(), from_bytes(bytes).unwrap_err()] {
        assert!(error.to_string().contains("delete the attribute `steps/0001@sha256`"), "{error}");
    }
}

/// Each step takes the same room, whatever is there already: a header of `steps` of 64 links at
/// most.
#[test]
fn files_are_linear_in_their_steps() {
    let length = |steps| to_bytes(&repeated(steps::beginning(), steps)).unwrap().len() as f64;
    let [a, b, c] = [100, 300, 700].map(length);
    let (first, second) = ((b - a) / 200.0, (c - b) / 400.0);
    // titles are as long, loads and coefficients are compressed a little differently
    assert!((first / second - 1.0).abs() < 0.01, "{first} and {second} bytes a step");
}

/// A series of three steps as the program of this version wrote it.
const VERSION_1_4: &[u8] = include_bytes!("../data/version-1.4.h5");

#[test]
fn files_of_version_1_4_are_read() {
    let data = from_bytes(VERSION_1_4.to_vec()).unwrap();
    assert_eq!((data.steps.len(), data.title.as_str()), (3, "A crack that grows"));
    for (number, step) in data.steps.iter().enumerate() {
        assert_eq!((step.load, step.partition.len()), (1.0 + number as f64, 16));
        assert_eq!(step.cracks[0].points.len(), number + 2);
        assert_eq!(step.intensities.len(), 1);
    }
}

/// Whatever happens to a file, a step that can be read is the one that was there, unless its
/// checksum is gone or was made right; and reading it alone is no other thing than reading it
/// with all.
#[test]
fn damaged_series_are_errors_or_what_they_hold() {
    damage_series(240, 11);
}

#[test]
#[ignore = "slow: hundreds of damaged series"]
fn many_damaged_series_are_errors_or_what_they_hold() {
    damage_series(360, 12);
}

fn damage_series(count: usize, seed: u64) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.h5");
    let data = from_bytes(VERSION_1_4.to_vec()).expect("it is read");
    let steps_of = |data: &Dataset| -> Vec<String> {
        data.steps.iter().map(|step| format!("{step:?}")).collect()
    };
    let original = steps_of(&data);
    let mut random = Random(seed);
    let (mut refused, mut whole) = (0, 0);
    for round in 0..count {
        let damaged = damaged(VERSION_1_4, &mut |below| random.below(below));
        fs::write(&path, &damaged.bytes).expect("a series");
        let all = from_bytes(damaged.bytes).ok().map(|all| steps_of(&all));
        let Ok(series) = Series::open(&path) else {
            assert!(all.is_none(), "{}", damaged.what);
            refused += 1;
            continue;
        };
        for number in 0..series.len().min(4) {
            let step = series.dataset(number).map(|mut found| found.steps.remove(0));
            let step = step.ok().map(|step| format!("{step:?}"));
            if let (Some(all), Some(step)) = (&all, &step) {
                assert_eq!(*step, all[number], "{}", damaged.what);
            }
            if let (false, Some(step)) = (damaged.is_sealed, &step) {
                assert_eq!(*step, original[number], "{}", damaged.what);
            }
            assert!(all.is_none() || step.is_some(), "{}", damaged.what);
        }
        whole += usize::from(all.is_some());
        // to see a step to the disk takes its time
        if let (0, Ok(mut writer)) = (round % 10, SeriesWriter::resume(&path)) {
            let len = writer.len();
            if writer.append(&steps::step(len)).is_ok() {
                drop(writer);
                assert!(
                    Series::open(&path).expect("a series").dataset(len).is_ok(),
                    "{}",
                    damaged.what
                );
            }
        }
    }
    assert!(10 * refused > count && 56 * whole > count, "{refused} refused, {whole} read");
}
