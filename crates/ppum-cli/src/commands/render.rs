//! `ppum render`: a picture of a quantity.

mod panels;
mod series;

use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, ensure};
use ppum::field::Field;
use ppum_figure::canvas::Canvas;
use ppum_figure::figure::{BarPlace, Design};
use ppum_render::png::Text;
use ppum_render::samples::Samples;

use crate::arguments::layout;
use crate::backend::Computing;
use crate::dataset::check_shown;
use crate::deformed::{Deformed, Placing};
use crate::given::Given;
use crate::look::{DEFAULT_SIZE, LookArgs};
use crate::number::count;
use crate::output::Output;
use crate::overlays::Overlays;
use crate::page;
use crate::progress::Bar;
use crate::subject::{ColorArgs, QuantityArgs};
use crate::target;
use crate::window::{ImageExtent, WindowArgs};
use ppum_scene::deformed::{Factor, words};
use ppum_scene::engine::Engine;
use ppum_scene::layers::scale;
use ppum_scene::moving::{FrameView as _, Frames, Work};
use ppum_scene::range::Telling;
use ppum_scene::request::Request;
use ppum_scene::scene::{self, Scene};
use ppum_scene::shot::{FieldSource, Shot, page_seen};
use series::SeriesArgs;

/// Draw a quantity, exactly at every pixel
///
/// Each pixel's value is the field at the pixel's centre. Without --figure the picture is bare: one
/// pixel of the file is one pixel of the field, transparent outside the domain.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    #[command(flatten)]
    subject: QuantityArgs,
    /// Picture to write, - for standard output (PNG); with --steps moving pictures too
    #[arg(short, long, value_name = "OUT.png|svg|pdf|gif|apng")]
    output: PathBuf,
    #[command(flatten)]
    series: SeriesArgs,
    #[command(flatten)]
    look: LookArgs,
    /// Add axes, a colour bar, a title and the cracks
    #[arg(long)]
    figure: bool,
    /// Leave out the colours and their bar: the overlays alone
    #[arg(long)]
    blank: bool,
    /// Panels of a figure with several quantities or parts: columns and rows [default: as large
    /// as fits]
    #[arg(long, value_name = "CxR", value_parser = layout)]
    layout: Option<[u32; 2]>,
    /// Give all panels one range and one colour bar
    #[arg(long)]
    shared_range: bool,
    #[command(flatten)]
    window: WindowArgs,
    #[command(flatten)]
    colours: ColorArgs,
    #[command(flatten)]
    overlays: Overlays,
    #[command(flatten)]
    deformed: Deformed,
    /// Show the mean of N x N values in each pixel, against jagged edges, in place of that at
    /// its centre
    #[arg(long, value_name = "N", default_value = "1")]
    samples: Samples,
    #[command(flatten)]
    computing: Computing,
}

const EXAMPLES: &str = "\
Examples:
  ppum render plate.h5 -o plate.png --figure
  ppum render plate.h5 -o uy.png -q uy --colormap coolwarm --size 1920x1080
  ppum render plate.h5 -o file.png --colormap thermal.json
  ppum render plate.h5 -o mean.png -q '(sxx + syy)/2' --figure
  ppum render plate.h5 -o what-if.png --function 'westergaard 1=r' --weight bump
  ppum render plate.h5 -o jump.png -q uy --part jump
  ppum render plate.h5 -o tip.png --tip 1 --zoom 1e6 --scale log --figure
  ppum render plate.h5 -o part.png --view -0.2,-0.1,0.2,0.1 --overlay cells,cracks
  ppum render plate.h5 -o lines.svg --figure --isolines auto --level-labels
  ppum render plate.h5 -o cross.png --figure --crosses -q hydrostatic --colormap vik
  ppum render plate.h5 -o moved.png --deformed auto --outline --figure
  ppum render plate.h5 -o paper.pdf --figure --inches 3.4x2.6 --font-size 8
  ppum render plate.h5 -o four.svg -q von-mises,ux,uy,syy --layout 2x2
  ppum render plate.h5 -o parts.png -q uy --part all,smooth,jump,tip --shared-range
  ppum render plate.h5 -o method.png -q level,order,functions,overlap
  ppum render plate.h5 -o smooth.png --samples 4
  ppum render growth.h5 -o growth.gif --steps all --figure
  ppum render growth.h5 -o step.png --steps 0..20:5 --figure
  ppum render plate.h5 -o gpu.png --backend gpu
  ppum render plate.h5 -o deep.png --center 0.5,0 --width 1e-12 --range 0,1e7";

/// What was made.
enum Made {
    Page(Sheet),
    /// Files of steps, and what is told of them.
    Files(String),
}

/// A page with what is told of it.
struct Sheet {
    page: Canvas,
    texts: Vec<Text>,
    told: String,
}

/// What pictures have in common, one or those of a series.
struct Common<'a> {
    placing: Placing<'a>,
    design: Design,
}

/// One field, which is open: the frame of a still picture.
struct Still<'a> {
    source: FieldSource<'a>,
    request: Request,
}

impl Frames for Still<'_> {
    type Error = anyhow::Error;

    fn count(&self) -> usize {
        1
    }

    fn with(&self, _: usize, work: &mut Work<'_, anyhow::Error>) -> anyhow::Result<()> {
        work(self.source, &self.request)
    }
}

impl Still<'_> {
    /// Gives the deformed plate the number of its factor.
    fn settle(&mut self) -> anyhow::Result<()> {
        if let Some(factor) = self.request.scene.deformed {
            self.request.scene.deformed = Some(Factor::Given(self.factor(factor)?));
        }
        Ok(())
    }
}

impl Args {
    pub(crate) fn run(&self, out: &mut Output) -> anyhow::Result<()> {
        let bar = Bar::new();
        let engine = self.computing.engine(&bar)?;
        let made = self.computing.with_threads(|| self.made(&engine));
        page::warn(engine.into_notices());
        drop(bar);
        match made?? {
            Made::Files(told) => Ok(writeln!(out, "wrote {told}")?),
            Made::Page(Sheet { page, texts, told }) => {
                page::save(&self.output, &page, self.look.given_dpi(), &texts, &told, out)
            }
        }
    }

    fn made(&self, engine: &Engine<'_>) -> anyhow::Result<Made> {
        self.look.check(self.is_figure())?;
        ensure!(
            !(self.deformed.factor.is_some() && self.subject.has_parts()),
            "several parts and --deformed do not go together; draw them one by one"
        );
        ensure!(
            self.has_panels() || !self.shared_range,
            "--shared-range is for panels; give several quantities or parts"
        );
        if self.series.is_given() {
            return self.all_steps(engine).map(Made::Files);
        }
        series::refuse_moving(&self.output)?;
        target::check(&self.output, target::FileKind::Picture, self.inputs())?;
        let datasets = self.subject.open_parts()?;
        let fields = datasets.iter().map(|dataset| self.subject.field(dataset));
        let fields = fields.collect::<anyhow::Result<Vec<_>>>()?;
        let sources = datasets.iter().zip(&fields).map(|(d, f)| FieldSource::of(d, f));
        match sources.collect::<Vec<_>>()[..] {
            [source] if !self.has_panels() => self.one(source, engine),
            ref sources => self.panels(sources, engine),
        }
        .map(Made::Page)
    }

    /// True for a figure of several panels, or of one that is called so.
    fn has_panels(&self) -> bool {
        self.layout.is_some() || self.subject.count() > 1
    }

    fn is_figure(&self) -> bool {
        self.figure || self.has_panels()
    }

    /// What is asked of the picture of a step, but for the quantity and the factor of the
    /// deformed plate.
    fn request(&self, step: Option<usize>) -> Request {
        let part = self.subject.replacements.part();
        let subject = scene::Subject { step, part, ..scene::Subject::default() };
        Request {
            samples: self.samples,
            blank: self.blank,
            labels: self.look.texts(),
            ..Request::from(Scene {
                subject,
                colors: self.colours.chosen(),
                overlays: self.overlays.chosen(),
                deformed: self.deformed.factor,
                outline: self.deformed.outline,
                ..Scene::default()
            })
        }
    }

    /// The text of a quantity that the field has.
    fn quantity(&self, field: &Field<'_>, given: Option<&Given>) -> anyhow::Result<Option<String>> {
        // for what is wrong with it, in the words of the command line
        given.iter().try_for_each(|given| check_shown(field, given))?;
        Ok(given.map(|given| given.text.clone()))
    }

    /// The look of a figure, of a size unless another is given, with so many panels across
    /// and down.
    fn design(&self, field: &Field<'_>, size: [u32; 2], panels: [u32; 2]) -> Design {
        let design = self.look.design(self.window.aspect(field), size, panels);
        if self.blank { Design { bar: BarPlace::None, ..design } } else { design }
    }

    /// Draws one quantity.
    fn one(&self, source: FieldSource<'_>, engine: &Engine<'_>) -> anyhow::Result<Sheet> {
        let mut still = Still { source, request: self.request(self.subject.step) };
        let text = self.subject.texts()?.map(|mut texts| texts.swap_remove(0));
        still.request.scene.quantity = self.quantity(source.field, text.as_ref())?;
        self.one_of(&mut still, engine)
    }

    fn one_of(&self, still: &mut Still<'_>, engine: &Engine<'_>) -> anyhow::Result<Sheet> {
        still.settle()?;
        let Common { placing, design } = self.common(still)?;
        let (source, request, design) =
            (still.source, &still.request, self.figure.then_some(&design));
        let seen = placing.seen(source, request, engine)?;
        let (page, shot) = page_seen(source, request, &seen, design, engine)?;
        let ([columns, rows], by) = (page.size, &shot.by);
        let colors = Telling::new(source.dataset, source.field).colors(&shot.picture);
        let (name, moved) = (&shot.name, deformation_note(&shot));
        let told = format!("{name}{moved}, {columns}x{rows} pixels, {colors}, {by}");
        Ok(Sheet { texts: self.texts(&shot), page, told })
    }

    /// What pictures of all frames have in common.
    fn common<F: Frames<Error = anyhow::Error>>(&self, frames: &F) -> anyhow::Result<Common<'_>> {
        let mut design = None;
        frames.each(&mut |source, _| {
            design.get_or_insert_with(|| self.design(source.field, DEFAULT_SIZE, [1, 1]));
            Ok(())
        })?;
        let design = design.context("--steps: there is no step")?;
        let room = if self.figure { frames.room(&design)? } else { design.size };
        Ok(Common { placing: self.placing(frames, self.frame(room, &design))?, design })
    }

    /// Where all frames are seen, whose factor is a number if they are deformed.
    fn placing<F: Frames<Error = anyhow::Error>>(
        &self,
        frames: &F,
        frame: ImageExtent,
    ) -> anyhow::Result<Placing<'_>> {
        let mut found = None;
        frames.with(0, &mut |_, request| {
            found = request.scene.deformed;
            Ok(())
        })?;
        let deformed = match found {
            Some(Factor::Given(factor)) => frames.bounds()?.map(|bounds| (factor, bounds)),
            _ => None,
        };
        Ok(Placing { window: &self.window, frame, deformed })
    }

    /// The texts of a picture's file: what it shows, and what was done to the dataset and
    /// the plate.
    fn texts(&self, shot: &Shot) -> Vec<Text> {
        let mut texts = shot.texts(&self.subject.file_name());
        texts.extend(self.subject.replacements.notes().chain(shot.notes()));
        texts
    }

    /// The files that are read.
    fn inputs(&self) -> impl Iterator<Item = &Path> {
        self.subject.inputs().chain(self.colours.input())
    }

    /// The room of a picture of so many pixels.
    fn frame(&self, pixels: [u32; 2], design: &Design) -> ImageExtent {
        // A figure centres what it is given; a bare picture has the size that was asked for.
        let may_shrink = self.is_figure() || self.look.given_size().is_none();
        let scale = scale(self.is_figure().then_some(design), pixels);
        ImageExtent { pixels, may_shrink, margin: self.overlays.chosen().margin(pixels, scale) }
    }
}

/// Of the deformed plate the factor, and at how many pixels it lies over itself.
fn deformation_note(shot: &Shot) -> String {
    match (shot.factor.map(words), shot.overlaps) {
        (None, _) => String::new(),
        (Some(factor), 0) => format!(", {factor}"),
        (Some(factor), n) => {
            let pixels = count(n, "pixel", "pixels");
            format!(", {factor}, over itself at {pixels} (hatched)")
        }
    }
}
