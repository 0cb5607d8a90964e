//! Options of several steps: which they are, and whether they move.

use std::ops::RangeInclusive;
use std::path::Path;
use std::str::FromStr;

use anyhow::ensure;
use ppum_scene::animation::AnimationFormat;
use ppum_scene::arguments::positive;

use crate::number::count;
use crate::standard::is_standard;
use crate::target::FileFormat;

/// The options of series.
#[derive(Debug, clap::Args)]
pub(super) struct SeriesArgs {
    /// Steps to draw, with one range for all: all, A..B with both ends, A..B:STRIDE, or a list of
    /// these; as numbered images, or as GIF or APNG
    #[arg(long, value_name = "all|A..B|A,B,…", conflicts_with = "step")]
    steps: Option<StepSelection>,
    /// Steps that an animation shows in a second, up to 50 [default: 5]
    #[arg(long, value_name = "N", requires = "steps", value_parser = rate)]
    fps: Option<f64>,
}

impl SeriesArgs {
    pub(super) fn is_given(&self) -> bool {
        self.steps.is_some()
    }

    /// The numbers of the steps that are asked for, of so many.
    pub(super) fn of(&self, all: usize) -> anyhow::Result<Vec<usize>> {
        let steps = self.steps.as_ref().map_or(Ok(Vec::new()), |steps| steps.of(all))?;
        ensure!(!steps.is_empty(), "--steps: there is no step");
        Ok(steps)
    }

    /// Time for which each image is shown \[milliseconds\].
    pub(super) fn time(&self) -> u16 {
        (1000.0 / self.rate()).round() as u16
    }

    /// Images a second.
    pub(super) fn rate(&self) -> f64 {
        self.fps.unwrap_or(DEFAULT_RATE)
    }
}

/// Images a second.
const DEFAULT_RATE: f64 = 5.0;
/// Programs show nothing faster than that as it should be.
const LARGEST_RATE: f64 = 50.0;
/// An image is shown for a minute at most.
const LEAST_RATE: f64 = 1.0 / 60.0;

fn rate(text: &str) -> Result<f64, String> {
    let found = positive(text).ok().filter(|rate| (LEAST_RATE..=LARGEST_RATE).contains(rate));
    found.ok_or_else(|| format!("write a number of pictures a second, up to {LARGEST_RATE}"))
}

/// Steps as they are asked for.
#[derive(Clone, Debug, PartialEq)]
struct StepSelection(Vec<StepRange>);

/// `all`, `A`, `A..B`, `A..`, `..B`, `A..B:STRIDE`.
#[derive(Clone, Debug, PartialEq)]
struct StepRange {
    from: usize,
    /// The last one if there is none.
    to: Option<usize>,
    stride: usize,
}

impl FromStr for StepSelection {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        text.split(',').map(str::parse).collect::<Result<_, _>>().map(Self)
    }
}

impl FromStr for StepRange {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        const HELP: &str =
            "write all, steps as 0,5,10, or from the first to the last as 0..20 or 0..20:5";
        let number = |text: &str| text.trim().parse::<usize>().map_err(|_| HELP.to_owned());
        let (range, stride) = match text.split_once(':') {
            Some((range, stride)) => (range.trim(), number(stride)?),
            None => (text.trim(), 1),
        };
        let (from, to) = match (range, range.split_once("..")) {
            ("all", _) => (0, None),
            (_, Some((from, to))) => {
                let [from, to] = [from, to].map(str::trim);
                let from = if from.is_empty() { 0 } else { number(from)? };
                (from, if to.is_empty() { None } else { Some(number(to)?) })
            }
            (one, None) => (number(one)?, Some(number(one)?)),
        };
        match to {
            _ if stride == 0 => Err("the stride is 0; write 1 or more".into()),
            Some(to) if to < from => Err(format!("{from}..{to} holds no step; write {to}..{from}")),
            _ => Ok(Self { from, to, stride }),
        }
    }
}

impl StepSelection {
    /// Their numbers in a dataset of so many steps, rising, each once.
    fn of(&self, all: usize) -> anyhow::Result<Vec<usize>> {
        let last = all.saturating_sub(1);
        let mut found = Vec::new();
        for StepRange { from, to, stride } in &self.0 {
            let wanted: RangeInclusive<usize> = *from..=to.unwrap_or(last.max(*from));
            ensure!(
                *wanted.end() < all,
                "--steps: there is no step {}; the dataset has {}, numbered from 0",
                wanted.end(),
                count(all, "step", "steps")
            );
            found.extend(wanted.step_by(*stride));
        }
        found.sort_unstable();
        found.dedup();
        Ok(found)
    }
}

/// Refuses an animation where there is but one.
pub(super) fn refuse_moving(path: &Path) -> anyhow::Result<()> {
    ensure!(
        form(path).is_none() || is_standard(path),
        "{}: moving pictures show several steps; add --steps all, or end the name in .png",
        path.display()
    );
    Ok(())
}

/// The form of an animation that a name ends in; none for images.
pub(super) fn form(path: &Path) -> Option<AnimationFormat> {
    match FileFormat::of(path)? {
        FileFormat::Gif => Some(AnimationFormat::Gif),
        FileFormat::Apng => Some(AnimationFormat::Apng),
        _ => None,
    }
}
