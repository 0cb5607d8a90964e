//! Several steps: numbered pictures or a moving one, with one range, one size, one factor of deformation.

use std::io::Write as _;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use anyhow::{Context as _, ensure};
use ppum::text::{apart, trimmed};
use ppum_figure::figure::Labels;
use ppum_render::animation::{Apng, Colors, Gif};
use ppum_render::image::Image;
use ppum_render::png::Text;
use ppum_render::view::View;

use super::{Args, Common, Plate, Sheet, Visit, warn};
use crate::arguments::positive;
use crate::dataset::{field, named, series};
use crate::number::count;
use crate::output::Output;
use crate::page;
use crate::progress;
use crate::standard::is_standard;
use crate::subject::Asked;
use crate::target;
use ppum_scene::drawing::{Drawn, classes, united};
use ppum_scene::shared::{Coloring, Found};

/// The options of series.
#[derive(Debug, clap::Args)]
pub(super) struct Series {
    /// Steps to draw, with one range for all: all, A..B with both ends, A..B:STRIDE, or a list of these; as
    /// numbered pictures, or as GIF or APNG
    #[arg(long, value_name = "all|A..B|A,B,…", conflicts_with = "step")]
    steps: Option<Steps>,
    /// Steps that a moving picture shows in a second, up to 50 [default: 5]
    #[arg(long, value_name = "N", requires = "steps", value_parser = rate)]
    fps: Option<f64>,
}

impl Series {
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
struct Steps(Vec<Part>);

/// `all`, `A`, `A..B`, `A..`, `..B`, `A..B:STRIDE`.
#[derive(Clone, Debug, PartialEq)]
struct Part {
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

impl FromStr for Part {
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
        for Part { from, to, stride } in &self.0 {
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
        Form::of(path) == Form::Pictures || is_standard(path),
        "{}: moving pictures show several steps; add --steps all, or end the name in .png",
        path.display()
    );
    Ok(())
}

impl Plate<'_> {
    /// Words with `{step}` and `{load}` filled in.
    pub(super) fn filled(&self, labels: Labels) -> Labels {
        let Some(step) = self.step else { return labels };
        let (step, load) = (step.to_string(), trimmed(self.field.step.load));
        let fill = |text: &str| text.replace("{step}", &step).replace("{load}", &load);
        let (title, quantity) = (fill(&labels.title), fill(&labels.quantity));
        Labels { title, quantity, ..labels }
    }

    /// The step, as notes in the picture.
    pub(super) fn notes(&self) -> Vec<Text> {
        let Some(step) = self.step else { return Vec::new() };
        let load = format!("{:?}", self.field.step.load);
        vec![("ppum:step".to_owned(), step.to_string()), ("ppum:load".to_owned(), load)]
    }
}

/// What becomes of the steps.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    Pictures,
    Gif,
    Apng,
}

impl Form {
    /// The form that a name ends in.
    fn of(path: &Path) -> Self {
        let ends_in =
            |wanted: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(wanted));
        match () {
            () if ends_in("gif") => Self::Gif,
            () if ends_in("apng") => Self::Apng,
            () => Self::Pictures,
        }
    }
}

/// The file of a step's picture: `name-007.png`, with as many digits as the last step of the dataset has, three at least.
fn numbered(path: &Path, step: usize, all: usize) -> PathBuf {
    let width = all.saturating_sub(1).to_string().len().max(3);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-{step:0width$}.{extension}"))
}

impl Args {
    /// Draws the steps that are asked for.
    pub(super) fn all_steps(&self, out: &mut Output) -> anyhow::Result<()> {
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
        let reel = Reel { args: self, all, steps };
        Film::new(self, &reel)?.write(out)
    }

    /// Refuses files that could not be written.
    fn check_files(&self, steps: &[usize], all: usize) -> anyhow::Result<()> {
        let path = &self.output;
        if Form::of(path) != Form::Pictures {
            return target::check(path, target::Kind::Animation, self.inputs());
        }
        let check =
            |&step| target::check(&numbered(path, step, all), target::Kind::Picture, self.inputs());
        steps.iter().try_for_each(check)
    }
}

/// The steps that are drawn, each read when it is needed: none but one is in memory.
struct Reel<'a> {
    args: &'a Args,
    all: ppum_format::Series,
    steps: Vec<usize>,
}

impl Reel<'_> {
    /// What is made of the plate of a part.
    fn with<T>(
        &self,
        part: usize,
        make: impl FnOnce(&Plate<'_>) -> anyhow::Result<T>,
    ) -> anyhow::Result<T> {
        let (args, step) = (self.args, self.steps[part]);
        let at = || format!("step {step}");
        let mut dataset = named(&args.subject.file, self.all.at(step))?;
        args.subject.replacements.apply(&mut dataset, Some(step)).with_context(at)?;
        let field = field(&dataset, Some(step)).with_context(at)?;
        let plate = args.plate(&dataset, &field, step);
        make(&plate)
    }

    fn each(&self, visit: &mut Visit<'_>) -> anyhow::Result<()> {
        (0..self.steps.len()).try_for_each(|part| self.with(part, &mut *visit))
    }
}

/// Memory for the values of steps from the first pass, which finds the range, to the second \[bytes\]: 160 pictures of 1024 ×
/// 768 pixels. Those of more are computed again.
const VALUES: usize = 1 << 30;
/// The same for pictures, whose colours a GIF counts before it is begun.
const IMAGES: usize = 1 << 29;

/// Things that may be kept as long as there is memory for them.
struct Kept<T> {
    room: usize,
    all: Vec<Option<T>>,
}

impl<T> Kept<T> {
    fn new(room: usize) -> Self {
        Self { room, all: Vec::new() }
    }

    fn push(&mut self, thing: T, bytes: usize) {
        let fits = bytes <= self.room;
        self.room -= if fits { bytes } else { 0 };
        self.all.push(fits.then_some(thing));
    }
}

/// Memory of what is kept of a step.
fn bytes(drawn: &Drawn) -> usize {
    drawn.values.bytes() + drawn.opacity.as_ref().map_or(0, |(_, all)| all.len())
}

/// The pictures of a series, once their values and their range are known.
struct Film<'a> {
    args: &'a Args,
    reel: &'a Reel<'a>,
    common: Common,
    coloring: Coloring,
    drawn: Kept<Drawn>,
    views: Vec<View>,
    /// What the first one shows, and what drew it.
    asked: Asked,
    by: String,
    bars: progress::Series,
}

/// What the first pass finds of a step.
struct First {
    asked: Asked,
    view: View,
    drawn: Drawn,
}

impl<'a> Film<'a> {
    /// The first pass.
    fn new(args: &'a Args, reel: &'a Reel<'a>) -> anyhow::Result<Self> {
        let common = args.common(&|visit| reel.each(visit))?;
        let bars = progress::Series::new(reel.steps.len());
        let (mut found, mut drawn, mut views) = (Found::default(), Kept::new(VALUES), Vec::new());
        let (mut first, mut style_of, mut classes_of) = (None, None, Vec::new());
        for part in 0..reel.steps.len() {
            bars.begin(part);
            let seen = reel.with(part, |plate| {
                let shot = args.shot(plate, &common)?;
                let style = match &style_of {
                    Some(style) => style,
                    None => style_of.insert(args.colours.style(shot.asked.shown.quantity())?),
                };
                let seen = args.seen(&shot)?;
                let drawn = args.drawn(plate.field, &seen, &shot.asked)?;
                let span = args.span(plate.field, &seen, &shot.asked, &drawn, style)?;
                found.add(span, &drawn, style.scale);
                classes_of.push(classes([(&shot.asked.shown, &drawn.values)]));
                let view = *shot.scene.view();
                Ok(First { asked: shot.asked, view, drawn })
            })?;
            views.push(seen.view);
            first.get_or_insert((seen.asked, seen.drawn.by.clone()));
            let bytes = bytes(&seen.drawn);
            drawn.push(seen.drawn, bytes);
        }
        let ((asked, by), style) = first.zip(style_of).context("--steps: there is no step")?;
        warn(&asked, found.undefined);
        let classes = classes_of.into_iter().collect::<Option<Vec<_>>>().and_then(united);
        let coloring = found.coloring(args.colours.classed(style.clone(), classes), style);
        Ok(Self { args, reel, common, coloring, drawn, views, asked, by, bars })
    }

    /// The picture of a step.
    fn sheet(&self, part: usize) -> anyhow::Result<Sheet> {
        self.bars.begin(part);
        self.reel.with(part, |plate| {
            let (args, shot) = (self.args, self.args.shot(plate, &self.common)?);
            let seen = args.seen(&shot)?;
            let again;
            let drawn = match &self.drawn.all[part] {
                Some(known) => known,
                None => {
                    again = args.drawn(plate.field, &seen, &shot.asked)?;
                    &again
                }
            };
            let _bar = progress::Bar::new();
            args.sheet(&shot, (&seen, drawn), &self.coloring, &self.common.design)
        })
    }

    /// The second pass.
    fn write(&self, out: &mut Output) -> anyhow::Result<()> {
        let (path, steps) = (&self.args.output, self.reel.steps.as_slice());
        let first = self.sheet(0)?;
        page::warn_of_missing(&first.page, ppum_figure::form::Form::of(path));
        let told = self.told(first.page.size);
        let files = match Form::of(path) {
            Form::Pictures => self.pictures(first, steps)?,
            form => {
                match form {
                    Form::Gif => self.gif(first.page.image())?,
                    _ => self.apng(&first, steps)?,
                }
                format!("{}: {} a second, ", path.display(), trimmed(self.args.series.rate()))
            }
        };
        writeln!(out, "wrote {files}{told}")?;
        Ok(())
    }

    fn told(&self, [columns, rows]: [u32; 2]) -> String {
        let factor = self.common.deforming.as_ref().map(|deforming| deforming.words());
        let moved = factor.map_or_else(String::new, |words| format!(", {words}"));
        let (name, by) = (&self.asked.name, &self.by);
        let steps = count(self.reel.steps.len(), "step", "steps");
        let [from, to] = apart(self.coloring.span.min, self.coloring.span.max);
        format!(
            "{name}{moved}, {steps}, {columns}x{rows} pixels, colours from {from} to {to}, {by}"
        )
    }

    fn pictures(&self, first: Sheet, steps: &[usize]) -> anyhow::Result<String> {
        let args = self.args;
        let all = self.reel.all.len();
        let path = |part: usize| numbered(&args.output, steps[part], all);
        let mut first = Some(first);
        for part in 0..steps.len() {
            let sheet = first.take().map_or_else(|| self.sheet(part), Ok)?;
            page::write(&path(part), &sheet.page, args.look.given_dpi(), &sheet.texts)?;
        }
        Ok(match steps.len() {
            1 => format!("{}: ", path(0).display()),
            n => format!("{} to {}: ", path(0).display(), path(n - 1).display()),
        })
    }

    fn apng(&self, first: &Sheet, steps: &[usize]) -> anyhow::Result<()> {
        let count = u32::try_from(steps.len())?;
        let (size, texts) = (first.page.size, self.texts(first, steps));
        target::stream(&self.args.output, |out| {
            let mut file = Apng::new(out, size, count, self.args.series.time(), &texts)?;
            file.add(&first.page.image())?;
            for part in 1..steps.len() {
                file.add(&self.sheet(part)?.page.image())?;
            }
            Ok(file.finish()?)
        })
    }

    /// Counts the colours of all pictures, then writes them.
    fn gif(&self, first: Image) -> anyhow::Result<()> {
        let size = first.size;
        let (mut colors, mut images) = (Colors::new(), Kept::new(IMAGES));
        let mut first = Some(first);
        for part in 0..self.reel.steps.len() {
            let image = match first.take() {
                Some(first) => first,
                None => self.sheet(part)?.page.image(),
            };
            colors.add(&image);
            let bytes = image.rgba.len();
            images.push(image, bytes);
        }
        target::stream(&self.args.output, |out| {
            let mut file = Gif::new(out, size, &colors, self.args.series.time())?;
            for (part, image) in images.all.into_iter().enumerate() {
                let image = image.map_or_else(|| Ok(self.sheet(part)?.page.image()), anyhow::Ok)?;
                file.add(&image)?;
            }
            Ok(file.finish()?)
        })
    }

    /// What the texts of the first picture say of all.
    fn texts(&self, first: &Sheet, steps: &[usize]) -> Vec<Text> {
        let is_own = |key: &str| match key {
            "ppum:step" | "ppum:load" => true,
            "ppum:view" => self.views.iter().any(|view| *view != self.views[0]),
            _ => false,
        };
        let mut texts = first.texts.clone();
        texts.retain(|(key, _)| !is_own(key));
        let list: Vec<String> = steps.iter().map(usize::to_string).collect();
        texts.push(("ppum:step".to_owned(), list.join(",")));
        texts
    }
}
