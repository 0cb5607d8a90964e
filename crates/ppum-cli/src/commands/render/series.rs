//! Several steps: numbered pictures or a moving one, with one range, one size, one factor
//! of deformation.

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use anyhow::{Context as _, ensure};
use ppum::text::{apart, trimmed};
use ppum_render::png::Text;

use super::{Args, Common};
use crate::arguments::positive;
use crate::dataset::{field, named, series};
use crate::given::Given;
use crate::number::count;
use crate::page;
use crate::progress;
use crate::standard::is_standard;
use crate::target;
use ppum_scene::deformed::{Factor, words};
use ppum_scene::engine::Engine;
use ppum_scene::moving::{AnimationFormat, Film, Frames, Work};
use ppum_scene::notice::Notice;
use ppum_scene::shot::{FieldSource, Shot};

/// The options of series.
#[derive(Debug, clap::Args)]
pub(super) struct SeriesArgs {
    /// Steps to draw, with one range for all: all, A..B with both ends, A..B:STRIDE, or a list of
    /// these; as numbered pictures, or as GIF or APNG
    #[arg(long, value_name = "all|A..B|A,B,…", conflicts_with = "step")]
    steps: Option<Steps>,
    /// Steps that a moving picture shows in a second, up to 50 [default: 5]
    #[arg(long, value_name = "N", requires = "steps", value_parser = rate)]
    fps: Option<f64>,
}

impl SeriesArgs {
    pub(super) fn is_given(&self) -> bool {
        self.steps.is_some()
    }

    /// Time for which each picture is shown \[milliseconds\].
    fn time(&self) -> u16 {
        (1000.0 / self.rate()).round() as u16
    }

    /// Pictures a second.
    fn rate(&self) -> f64 {
        self.fps.unwrap_or(DEFAULT_RATE)
    }
}

/// Pictures a second.
const DEFAULT_RATE: f64 = 5.0;
/// Programs show nothing faster than that as it should be.
const LARGEST_RATE: f64 = 50.0;
/// A picture is shown for a minute at most.
const LEAST_RATE: f64 = 1.0 / 60.0;

fn rate(text: &str) -> Result<f64, String> {
    let found = positive(text).ok().filter(|rate| (LEAST_RATE..=LARGEST_RATE).contains(rate));
    found.ok_or_else(|| format!("write a number of pictures a second, up to {LARGEST_RATE}"))
}

/// Steps as they are asked for.
#[derive(Clone, Debug, PartialEq)]
struct Steps(Vec<StepRange>);

/// `all`, `A`, `A..B`, `A..`, `..B`, `A..B:STRIDE`.
#[derive(Clone, Debug, PartialEq)]
struct StepRange {
    from: usize,
    /// The last one if there is none.
    to: Option<usize>,
    stride: usize,
}

impl FromStr for Steps {
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

impl Steps {
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

/// Refuses a moving picture where there is but one.
pub(super) fn refuse_moving(path: &Path) -> anyhow::Result<()> {
    ensure!(
        form(path).is_none() || is_standard(path),
        "{}: moving pictures show several steps; add --steps all, or end the name in .png",
        path.display()
    );
    Ok(())
}

/// The form of an animation that a name ends in; none for pictures.
fn form(path: &Path) -> Option<AnimationFormat> {
    let ends_in = |wanted: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(wanted));
    match () {
        () if ends_in("gif") => Some(AnimationFormat::Gif),
        () if ends_in("apng") => Some(AnimationFormat::Apng),
        () => None,
    }
}

/// The file of a step's picture: `name-007.png`, with as many digits as the last step of the
/// dataset has, three at least.
fn numbered(path: &Path, step: usize, all: usize) -> PathBuf {
    let width = all.saturating_sub(1).to_string().len().max(3);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-{step:0width$}.{extension}"))
}

impl Args {
    /// Draws the steps that are asked for, and returns what is told of them.
    pub(super) fn all_steps(&self, engine: &Engine<'_>) -> anyhow::Result<String> {
        let path = &self.output;
        ensure!(!is_standard(path), "-o -: pictures of steps go to files; give a name with -o");
        ensure!(
            !self.has_panels(),
            "several panels and --steps do not go together yet; draw those of each step with --step"
        );
        let all = series(&self.subject.file)?;
        let steps =
            self.series.steps.as_ref().map_or(Ok(Vec::new()), |steps| steps.of(all.len()))?;
        self.check_files(&steps, all.len())?;
        let bars = progress::NestedBars::new(steps.len());
        let quantity = self.subject.texts()?.map(|mut texts| texts.swap_remove(0));
        let mut reel = Reel { args: self, all, steps, quantity, factor: None, bars };
        reel.factor = self.deformed.factor.map(|factor| reel.factor(factor)).transpose()?;
        let Common { placing, design } = self.common(&reel)?;
        let film = Film::new(&reel, &placing, self.figure.then_some(&design), engine)?;
        self.write(&reel, &film, engine)
    }

    /// Refuses files that could not be written.
    fn check_files(&self, steps: &[usize], all: usize) -> anyhow::Result<()> {
        let path = &self.output;
        if form(path).is_some() {
            return target::check(path, target::FileKind::Animation, self.inputs());
        }
        let check = |&step| {
            target::check(&numbered(path, step, all), target::FileKind::Picture, self.inputs())
        };
        steps.iter().try_for_each(check)
    }

    /// Writes the files, and returns what is told of them.
    fn write(
        &self,
        reel: &Reel<'_>,
        film: &Film<'_, Reel<'_>>,
        engine: &Engine<'_>,
    ) -> anyhow::Result<String> {
        let path = &self.output;
        let Some(form) = form(path) else {
            let (files, size) = self.pictures(reel, film, engine)?;
            return Ok(format!("{files}{}", reel.summary(film, size)));
        };
        let texts = |first: &Shot| self.texts_of_all(reel, film, first);
        let time = self.series.time();
        let mut size = [0; 2];
        target::stream(path, |out| {
            size = film.write(form, time, &texts, out)?;
            Ok(())
        })?;
        let rate = trimmed(self.series.rate());
        Ok(format!("{}: {rate} a second, {}", path.display(), reel.summary(film, size)))
    }

    /// Writes a picture of each step, and returns their names and their size.
    fn pictures(
        &self,
        reel: &Reel<'_>,
        film: &Film<'_, Reel<'_>>,
        engine: &Engine<'_>,
    ) -> anyhow::Result<(String, [u32; 2])> {
        let path = |part: usize| numbered(&self.output, reel.steps[part], reel.all.len());
        let form = ppum_figure::form::PageFormat::of(&self.output);
        let mut size = [0; 2];
        for part in 0..reel.steps.len() {
            let (page, shot) = film.page(part)?;
            Notice::of_glyphs(&page, form).into_iter().for_each(|notice| engine.tell(notice));
            size = page.size;
            page::write(&path(part), &page, self.look.given_dpi(), &self.texts(&shot))?;
        }
        let names = match reel.steps.len() {
            1 => format!("{}: ", path(0).display()),
            n => format!("{} to {}: ", path(0).display(), path(n - 1).display()),
        };
        Ok((names, size))
    }

    /// What the texts of the first picture say of all.
    fn texts_of_all(&self, reel: &Reel<'_>, film: &Film<'_, Reel<'_>>, first: &Shot) -> Vec<Text> {
        let is_own = |key: &str| match key {
            "ppum:step" | "ppum:load" => true,
            "ppum:view" => film.views.iter().any(|view| *view != film.views[0]),
            _ => false,
        };
        let mut texts = self.texts(first);
        texts.retain(|(key, _)| !is_own(key));
        let list: Vec<String> = reel.steps.iter().map(usize::to_string).collect();
        texts.push(("ppum:step".to_owned(), list.join(",")));
        texts
    }
}

/// The steps that are drawn, each read when it is needed: none but one is in memory.
struct Reel<'a> {
    args: &'a Args,
    all: ppum_format::Series,
    steps: Vec<usize>,
    quantity: Option<Given>,
    /// The factor of deformed plates, once it is known.
    factor: Option<f64>,
    bars: progress::NestedBars,
}

impl Frames for Reel<'_> {
    type Error = anyhow::Error;

    fn count(&self) -> usize {
        self.steps.len()
    }

    fn with(&self, part: usize, work: &mut Work<'_, anyhow::Error>) -> anyhow::Result<()> {
        self.bars.begin(part);
        let (args, step) = (self.args, self.steps[part]);
        let at = || format!("step {step}");
        let mut dataset = named(&args.subject.file, self.all.at(step))?;
        args.subject.replacements.apply(&mut dataset, Some(step)).with_context(at)?;
        let field = field(&dataset, Some(step)).with_context(at)?;
        let mut request = args.request(Some(step));
        request.scene.quantity = args.quantity(&field, self.quantity.as_ref())?;
        request.scene.deformed = self.factor.map(Factor::Given).or(request.scene.deformed);
        work(FieldSource::of(&dataset, &field), &request)
    }
}

impl Reel<'_> {
    /// The summary of all steps that is printed.
    fn summary(&self, film: &Film<'_, Reel<'_>>, [columns, rows]: [u32; 2]) -> String {
        let moved = self.factor.map_or_else(String::new, |factor| format!(", {}", words(factor)));
        let (name, by) = (&film.name, &film.by);
        let steps = count(self.steps.len(), "step", "steps");
        let [from, to] = apart(film.coloring.span.min, film.coloring.span.max);
        format!(
            "{name}{moved}, {steps}, {columns}x{rows} pixels, colours from {from} to {to}, {by}"
        )
    }
}
