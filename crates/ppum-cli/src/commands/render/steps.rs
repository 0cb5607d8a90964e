//! Several steps: numbered images or a moving one, with one range, one size, one factor of
//! deformation.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, ensure};
use ppum::text::{apart, trimmed};
use ppum_render::png::TextChunk;
use ppum_scene::animation::{FrameSource, SeriesAnimation, Work};
use ppum_scene::camera::ImageSettings;
use ppum_scene::compose::RenderedImage;
use ppum_scene::engine::Engine;
use ppum_scene::magnification::{Magnification, words};
use ppum_scene::request::Request;

use super::RenderArgs;
use super::series::form;
use crate::dataset::{field, named, series};
use crate::formula_text::FormulaText;
use crate::number::count;
use crate::standard::is_standard;
use crate::subject::{StepArgs, image_subject};
use crate::{page, progress, target};

/// The file of a step's image: `name-007.png`, with as many digits as the last step of the
/// dataset has, three at least.
fn numbered(path: &Path, step: usize, all: usize) -> PathBuf {
    let width = all.saturating_sub(1).to_string().len().max(3);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-{step:0width$}.{extension}"))
}

impl RenderArgs {
    /// Draws the steps that are asked for, and returns what is told of them.
    pub(super) fn all_steps(
        &self,
        request: Request,
        mut texts: Vec<FormulaText>,
        engine: &Engine<'_>,
    ) -> anyhow::Result<String> {
        let path = &self.output;
        ensure!(!is_standard(path), "-o -: pictures of steps go to files; give a name with -o");
        request.panels.check_steps()?;
        let all = series(&self.subject.step.file)?;
        let steps = self.series.of(all.len())?;
        self.check_files(&steps, all.len())?;
        let bars = progress::NestedBars::new(steps.len());
        let text = texts.pop();
        let mut frames = StepSource { args: self, all, steps, text, request, bars };
        frames.request = frames.resolved(&frames.request)?;
        let ImageSettings { camera, design } = frames.settings(&frames.request)?;
        let animation = SeriesAnimation::new(&frames, &camera, design.as_ref(), engine)?;
        self.write(&frames, &animation, engine)
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
        frames: &StepSource<'_>,
        animation: &SeriesAnimation<'_, StepSource<'_>>,
        engine: &Engine<'_>,
    ) -> anyhow::Result<String> {
        let path = &self.output;
        let Some(form) = form(path) else {
            let (files, size) = self.pictures(frames, animation, engine)?;
            return Ok(format!("{files}{}", frames.summary(animation, size)));
        };
        let texts = |first: &RenderedImage| self.texts_of_all(frames, animation, first);
        let time = self.series.time();
        let mut size = [0; 2];
        target::stream(path, |out| {
            size = animation.write(form, time, &texts, out)?;
            Ok(())
        })?;
        let rate = trimmed(self.series.rate());
        Ok(format!("{}: {rate} a second, {}", path.display(), frames.summary(animation, size)))
    }

    /// Writes an image of each step, and returns their names and their size.
    fn pictures(
        &self,
        frames: &StepSource<'_>,
        animation: &SeriesAnimation<'_, StepSource<'_>>,
        engine: &Engine<'_>,
    ) -> anyhow::Result<(String, [u32; 2])> {
        let path = |part: usize| numbered(&self.output, frames.steps[part], frames.all.len());
        let form = ppum_figure::form::PageFormat::of(&self.output);
        let mut size = [0; 2];
        for part in 0..frames.steps.len() {
            let (page, image) = animation.page(part)?;
            engine.tell_glyphs(&page, form);
            size = page.size;
            page::write(&path(part), &page, self.request.look.given_dpi(), &self.texts(&image))?;
        }
        let names = match frames.steps.len() {
            1 => format!("{}: ", path(0).display()),
            n => format!("{} to {}: ", path(0).display(), path(n - 1).display()),
        };
        Ok((names, size))
    }

    /// Returns the texts that hold for all images.
    fn texts_of_all(
        &self,
        frames: &StepSource<'_>,
        animation: &SeriesAnimation<'_, StepSource<'_>>,
        first: &RenderedImage,
    ) -> Vec<TextChunk> {
        let is_own = |key: &str| match key {
            "ppum:step" | "ppum:load" => true,
            "ppum:view" => animation.views.iter().any(|view| *view != animation.views[0]),
            _ => false,
        };
        let mut texts = self.texts(first);
        texts.retain(|(key, _)| !is_own(key));
        let list: Vec<String> = frames.steps.iter().map(usize::to_string).collect();
        texts.push(("ppum:step".to_owned(), list.join(",")));
        texts
    }
}

/// The steps that are drawn, each read when it is needed: none but one is in memory.
struct StepSource<'a> {
    args: &'a RenderArgs,
    all: ppum_format::Series,
    steps: Vec<usize>,
    text: Option<FormulaText>,
    /// The request for each; the factor of deformed plates is a number once it is known.
    request: Request,
    bars: progress::NestedBars,
}

impl FrameSource for StepSource<'_> {
    type Error = anyhow::Error;

    fn count(&self) -> usize {
        self.steps.len()
    }

    fn with(&self, part: usize, work: &mut Work<'_, anyhow::Error>) -> anyhow::Result<()> {
        self.bars.begin(part);
        let (args, step) = (self.args, self.steps[part]);
        let at = || format!("step {step}");
        let StepArgs { file, replacements, .. } = &args.subject.step;
        let mut dataset = named(file, self.all.at(step))?;
        replacements.apply(&mut dataset, Some(step)).with_context(at)?;
        let field = field(&dataset, Some(step)).with_context(at)?;
        let subject = image_subject(&dataset, &field, self.text.as_ref())?;
        work(&subject, &self.request.at_step(step))
    }
}

impl StepSource<'_> {
    /// The summary of all steps that is printed.
    fn summary(
        &self,
        animation: &SeriesAnimation<'_, StepSource<'_>>,
        [columns, rows]: [u32; 2],
    ) -> String {
        let moved = match self.request.scene.deformed {
            Some(Magnification::Given(factor)) => format!(", {}", words(factor)),
            _ => String::new(),
        };
        let (name, by) = (&animation.name, &animation.by);
        let steps = count(self.steps.len(), "step", "steps");
        let [from, to] = apart(animation.coloring.span.min, animation.coloring.span.max);
        format!(
            "{name}{moved}, {steps}, {columns}x{rows} pixels, colours from {from} to {to}, {by}"
        )
    }
}
