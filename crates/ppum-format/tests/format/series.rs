//! Files that grow step by step.

use std::fs;
use std::path::Path;

use ppum::dataset::Dataset;
use ppum_format::{Series, SeriesWriter, from_bytes, read, to_bytes, write};

use crate::files::everything::dataset;

/// A dataset of so many steps that differ.
fn series(steps: usize) -> Dataset {
    let mut all = dataset(0);
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

/// What has grown step by step, with and without breaks, is what is written at once.
#[test]
fn all_ways_lead_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let all = series(150);
    grow(&at("grown"), &all);
    let mut writer = SeriesWriter::begin(&at("resumed"), &one(&all, 0)).unwrap();
    for (k, step) in all.steps.iter().enumerate().skip(1) {
        assert_eq!(writer.len(), k);
        writer.append(step).unwrap();
        drop(writer);
        writer = SeriesWriter::resume(&at("resumed")).unwrap();
    }
    drop(SeriesWriter::begin(&at("begun"), &all).unwrap());
    write(&all, &at("written")).unwrap();
    let bytes = to_bytes(&all).unwrap();
    for name in ["grown", "resumed", "begun", "written"] {
        assert!(fs::read(at(name)).unwrap() == bytes, "{name}");
    }
    assert_same(&read(&at("grown")).unwrap(), &all);
    assert_same(&from_bytes(bytes).unwrap(), &all);
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
