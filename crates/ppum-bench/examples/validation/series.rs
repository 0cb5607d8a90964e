//! Series of cracks that grow, kept in files: what is there of them is not computed again.

use anyhow::Context as _;
use ppum::dataset::{Dataset, Step};
use ppum::progress::unwatched;
use ppum_format::{Series, SeriesWriter};
use ppum_fracture::growth::{ResumePoint, grow, is_same_series};
use ppum_problem::Problem;
use std::path::{Path, PathBuf};

/// The text of a problem of the folder `examples`, with parts replaced.
pub(crate) fn example(name: &str, changes: &[(&str, &str)]) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../examples/{name}.toml"));
    let text = std::fs::read_to_string(path).expect("an example");
    changes.iter().fold(text, |text, (from, to)| {
        assert!(text.contains(from), "{name} has no {from}");
        text.replace(from, to)
    })
}

/// The path of a series.
pub(crate) fn place(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../target/growth/{name}.h5"))
}

/// The steps of a problem that grows, without their fields, and the last one with it.
pub(crate) fn course(name: &str, text: &str) -> anyhow::Result<(Vec<Step>, Dataset)> {
    let problem = Problem::parse(text, name, Path::new(".")).map_err(|e| anyhow::anyhow!("{e}"))?;
    let path = place(name);
    std::fs::create_dir_all(path.parent().context("a folder")?)?;
    if !is_whole(&path, &problem)? {
        solve(&path, &problem)?;
    }
    let series = Series::open(&path)?;
    let steps = (0..series.len()).map(|k| series.results(k)).collect::<Result<_, _>>()?;
    let last = series.len() - 1;
    Ok((steps, series.dataset(last)?))
}

fn is_whole(path: &Path, problem: &Problem) -> anyhow::Result<bool> {
    let Some(series) = of_problem(path, problem) else { return Ok(false) };
    let last = series.results(series.len() - 1)?;
    let has_ended = last.growth.is_some_and(|growth| growth.stop.is_some());
    Ok(has_ended || problem.growth.as_ref().is_some_and(|rule| series.len() > rule.steps))
}

fn of_problem(path: &Path, problem: &Problem) -> Option<Series> {
    let series = Series::open(path).ok()?;
    let there = Problem::of_dataset(series.head()).ok().flatten()?;
    is_same_series(&there, problem).then_some(series)
}

/// Solves what is not there yet.
fn solve(path: &Path, problem: &Problem) -> anyhow::Result<()> {
    let there = of_problem(path, problem);
    let mut writer = there.as_ref().map(|_| SeriesWriter::resume(path)).transpose()?;
    let last = there
        .map(|series| (0..series.len()).map(|k| series.results(k)).collect::<Result<Vec<_>, _>>());
    let steps = last.transpose()?;
    let last = steps.as_ref().and_then(|steps| steps.split_last());
    let last = last.map(|(step, earlier)| ResumePoint { number: earlier.len(), step, earlier });
    let keep = |dataset: Dataset| -> anyhow::Result<()> {
        match &mut writer {
            None => writer = Some(SeriesWriter::begin(path, &dataset)?),
            Some(writer) => writer.append(&dataset.steps[0])?,
        }
        Ok(())
    };
    grow(problem, last, None, unwatched(), keep).map_err(|e| anyhow::anyhow!(e.to_string()))
}
