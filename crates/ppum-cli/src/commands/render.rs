//! `ppum render`: an image of a quantity.

mod series;
mod steps;

use std::io::Write as _;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use ppum_figure::canvas::Canvas;
use ppum_figure::figure::Labels;
use ppum_render::png::TextChunk;
use ppum_scene::compose::{RenderedImage, page};
use ppum_scene::engine::Engine;
use ppum_scene::magnification::words;
use ppum_scene::panels::{PanelImages, draw};
use ppum_scene::range::RangeLocations;
use ppum_scene::request::{Panels, Request};
use ppum_scene::scene::SceneRequest;
use ppum_scene::subject::ImageSubject;

use crate::formula_text::FormulaText;
use crate::labels::LabelArgs;
use crate::number::count;
use crate::output::StandardStream;
use crate::progress::ProgressLine;
use crate::subject::{QuantityArgs, StepArgs, image_subject};
use crate::{graphics, page as file, target, threads};
use series::SeriesArgs;

/// Draw a quantity, exactly at every pixel
///
/// Each pixel's value is the field at the pixel's centre. Without --figure the image is bare: one
/// pixel of the file is one pixel of the field, transparent outside the domain.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct RenderArgs {
    #[command(flatten)]
    subject: QuantityArgs,
    /// Image to write, - for standard output (PNG); with --steps animations too
    #[arg(short, long, value_name = "OUT.png|svg|pdf|gif|apng")]
    output: PathBuf,
    #[command(flatten)]
    series: SeriesArgs,
    #[command(flatten)]
    labels: LabelArgs,
    #[command(flatten)]
    request: Request,
    /// Number of threads of the CPU [default: all cores]; the image does not depend on it
    #[arg(long, value_name = "N", value_parser = threads::number)]
    threads: Option<NonZeroUsize>,
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
  ppum render half.h5 -o whole.png --mirror --figure
  ppum render plate.h5 -o paper.pdf --figure --inches 3.4
  ppum render plate.h5 -o four.svg -q von-mises,ux,uy,syy --layout 2x2
  ppum render plate.h5 -o parts.png -q uy --part all,smooth,jump,tip --shared-range
  ppum render plate.h5 -o method.png -q level,order,functions,overlap
  ppum render plate.h5 -o smooth.png --samples 4
  ppum render growth.h5 -o growth.gif --steps all --figure
  ppum render growth.h5 -o step.png --steps 0..20:5 --figure
  ppum render plate.h5 -o gpu.png --backend gpu
  ppum render plate.h5 -o deep.png --center 0.5,0 --width 1e-12 --range 0,1e7";

/// The result of rendering.
enum RenderOutput {
    Page(RenderedPage),
    /// Files of steps, and what is told of them.
    Files(String),
}

/// A page with what is told of it.
struct RenderedPage {
    page: Canvas,
    texts: Vec<TextChunk>,
    told: String,
}

impl RenderArgs {
    pub(crate) fn run(&self, out: &mut StandardStream) -> anyhow::Result<()> {
        let bar = ProgressLine::new();
        let Request { backend, precision, .. } = self.request;
        let engine = Engine::new(
            backend,
            precision,
            graphics::graphics().cards.map(|cards| cards.draw),
            &bar,
        )?;
        let made = threads::with(self.threads, || self.made(&engine));
        file::warn(engine.into_notices());
        drop(bar);
        match made?? {
            RenderOutput::Files(told) => Ok(writeln!(out, "wrote {told}")?),
            RenderOutput::Page(RenderedPage { page, texts, told }) => {
                file::save(&self.output, &page, self.request.look.given_dpi(), &texts, &told, out)
            }
        }
    }

    fn made(&self, engine: &Engine<'_>) -> anyhow::Result<RenderOutput> {
        let texts = self.subject.texts()?;
        let request = self.request(&texts);
        self.labels.check(&request)?;
        request.panels.check(&request.scene)?;
        if self.series.is_given() {
            return self.all_steps(request, texts, engine).map(RenderOutput::Files);
        }
        series::refuse_moving(&self.output)?;
        target::check(&self.output, target::FileKind::Picture, self.inputs())?;
        let datasets = self.subject.open_parts()?;
        let fields = datasets.iter().map(|dataset| self.subject.step.field(dataset));
        let fields = fields.collect::<anyhow::Result<Vec<_>>>()?;
        let all: Vec<_> = match &texts[..] {
            [] => vec![None],
            texts => texts.iter().map(Some).collect(),
        };
        let bodies = || datasets.iter().zip(&fields);
        let of = |text| bodies().map(move |(dataset, field)| image_subject(dataset, field, text));
        let subjects = all.into_iter().flat_map(of).collect::<anyhow::Result<Vec<_>>>()?;
        match request.panels.are_given() {
            false => self.one(&subjects[0], &request, engine),
            true => self.panels(&subjects, &request, engine),
        }
        .map(RenderOutput::Page)
    }

    /// Builds the request for an image of some quantities.
    fn request(&self, texts: &[FormulaText]) -> Request {
        let mut quantities: Vec<String> = texts.iter().map(|given| given.text.clone()).collect();
        let quantity = (quantities.len() == 1).then(|| quantities.swap_remove(0));
        let StepArgs { replacements, step, .. } = &self.subject.step;
        let (request, parts) = (self.request.clone(), replacements.parts());
        Request {
            labels: self.labels.texts(),
            panels: Panels { quantities, parts, ..request.panels },
            scene: SceneRequest { subject: replacements.subject(*step), quantity, ..request.scene },
            ..request
        }
    }

    /// Draws one quantity.
    fn one(
        &self,
        subject: &ImageSubject<'_>,
        request: &Request,
        engine: &Engine<'_>,
    ) -> anyhow::Result<RenderedPage> {
        let (page, image) = page(subject, request, engine)?;
        let ([columns, rows], by) = (page.size, &image.by);
        let colors = RangeLocations::new(subject.dataset, subject.field).colors(&image.picture);
        let (name, moved) = (&image.name, deformation_note(&image));
        let told = format!("{name}{moved}, {columns}x{rows} pixels, {colors}, {by}");
        Ok(RenderedPage { texts: self.texts(&image), page, told })
    }

    /// Draws each quantity of each plate in a panel.
    fn panels(
        &self,
        subjects: &[ImageSubject<'_>],
        request: &Request,
        engine: &Engine<'_>,
    ) -> anyhow::Result<RenderedPage> {
        let drawn = draw(subjects, request, engine)?;
        let (replacements, image) = (&self.subject.step.replacements, &drawn.images[0]);
        let mut texts = drawn.texts(&self.subject.file_name());
        texts.extend(replacements.notes().chain(image.notes()));
        let names = [drawn.names.clone()].into_iter().chain(replacements.captions());
        let names = names.collect::<Vec<_>>().join(", ");
        let ([columns, rows], by) = (drawn.page.size, &image.by);
        let moved = deformation_note(image);
        let ImageSubject { dataset, field, .. } = subjects[0];
        let colors = self.colors(&RangeLocations::new(dataset, field), &drawn);
        let told = format!("{names}{moved}, {columns}x{rows} pixels, {by}{colors}");
        Ok(RenderedPage { page: drawn.page, texts, told })
    }

    /// Writes the meaning of the colours of each panel, in lines of their own; those of one range
    /// once.
    fn colors(&self, telling: &RangeLocations<'_>, drawn: &PanelImages) -> String {
        let has_parts = !self.subject.step.replacements.captions().is_empty();
        let line = |(image, labels): (&RenderedImage, &Labels)| {
            let letter = labels.title.split(' ').next().filter(|_| has_parts).unwrap_or_default();
            let name = format!("{letter} {}", image.name);
            format!("\n  {}: {}", name.trim_start(), telling.colors(&image.picture))
        };
        if drawn.is_shared {
            return format!("\n  {}", telling.colors(&drawn.images[0].picture));
        }
        drawn.images.iter().zip(&drawn.labels).map(line).collect()
    }

    /// The texts of an image's file: what it shows, and what was done to the dataset and the plate.
    fn texts(&self, shot: &RenderedImage) -> Vec<TextChunk> {
        let mut texts = shot.texts(&self.subject.file_name());
        texts.extend(self.subject.step.replacements.notes().chain(shot.notes()));
        texts
    }

    /// The files that are read.
    fn inputs(&self) -> impl Iterator<Item = &Path> {
        let map = self.request.scene.colors.colormap.as_deref().map(Path::new);
        self.subject.inputs().chain(map)
    }
}

/// For a deformed body, writes the factor, and at how many pixels it overlaps itself.
fn deformation_note(shot: &RenderedImage) -> String {
    match (shot.factor.map(words), shot.overlaps) {
        (None, _) => String::new(),
        (Some(factor), 0) => format!(", {factor}"),
        (Some(factor), n) => {
            let pixels = count(n, "pixel", "pixels");
            format!(", {factor}, over itself at {pixels} (hatched)")
        }
    }
}

#[cfg(test)]
mod tests {
    use std::ffi::OsString;

    use ppum_render::range::RangeChoice;
    use ppum_render::samples::Samples;
    use ppum_render::scale::Scale;
    use ppum_scene::backend::{Backend, Precision};
    use ppum_scene::colors::ColorOptions;
    use ppum_scene::command;
    use ppum_scene::magnification::Magnification;
    use ppum_scene::overlays::{IsolineLevels, Overlay, Overlays};
    use ppum_scene::page_style::{BarName, PageStyle, PaperSize, ThemeName};
    use ppum_scene::region::ViewRegion;
    use ppum_scene::request::FigureTexts;
    use ppum_scene::scene::Subject;
    use ppum_testkit::random::Random;

    use super::*;
    use crate::cli::{Cli, Command};

    fn maybe<T>(random: &mut Random, make: impl FnOnce(&mut Random) -> T) -> Option<T> {
        (random.below(2) == 0).then(|| make(random))
    }

    fn is(random: &mut Random) -> bool {
        random.below(2) == 0
    }

    fn text(random: &mut Random, texts: &[&str]) -> String {
        random.pick(texts).to_owned()
    }

    fn pairs(random: &mut Random, name: &str) -> Vec<(String, String)> {
        let formulas = ["r*(1 + y)", "-x == 2", "max(x, 'y')"];
        let pair = |k| (format!("{name} {k}"), text(random, &formulas));
        (0..2).map(pair).filter(|(_, formula)| formula != formulas[0]).collect()
    }

    fn place(random: &mut Random) -> ViewRegion {
        let [a, b, c, d] = [(); 4].map(|()| random.between(-2.0, 2.0));
        let width = 10f64.powf(random.between(-12.0, 1.0));
        match random.below(4) {
            0 => ViewRegion::default(),
            1 => ViewRegion { view: Some([a, b, c, d]), ..ViewRegion::default() },
            2 => ViewRegion { center: Some([a, b]), width: Some(width), ..ViewRegion::default() },
            _ => {
                let zoom = maybe(random, |_| 1.0 / width);
                ViewRegion { tip: Some(random.below(9)), zoom, ..ViewRegion::default() }
            }
        }
    }

    fn look(random: &mut Random) -> PageStyle {
        let size = maybe(random, |r| [r.below(4000) as u32 + 1, 7]);
        let inches = maybe(random, |r| PaperSize {
            width: r.between(0.1, 9.0),
            height: (r.below(2) == 0).then_some(2.0),
        });
        let ticks = ["x=5", "y=auto", "bar=-1.0,0.25", "bar=3.0,"];
        let ticks = ticks.iter().filter(|_| is(random)).map(|text| text.parse().unwrap()).collect();
        let is_free = inches.is_none();
        let cm = maybe(random, |_| PaperSize { width: 8.6, height: None }).filter(|_| is_free);
        PageStyle {
            size: size.filter(|_| is_free && cm.is_none()),
            cm,
            inches,
            dpi: maybe(random, |r| r.between(50.0, 600.0)),
            font_size: maybe(random, |r| r.between(5.0, 20.0)),
            theme: maybe(random, |r| r.pick(&[ThemeName::Light, ThemeName::Dark])),
            transparent: is(random),
            bar: maybe(random, |r| r.pick(&[BarName::Auto, BarName::Bottom, BarName::None])),
            ticks,
        }
    }

    fn colors(random: &mut Random) -> ColorOptions {
        let ranges = [
            RangeChoice::Full,
            RangeChoice::Fixed(-0.125, 3.0),
            RangeChoice::Percentiles(2.0, 97.5),
        ];
        ColorOptions {
            colormap: maybe(random, |r| text(r, &["vik_r", "a file.json"])),
            range: maybe(random, |r| r.pick(&ranges)).unwrap_or_default(),
            scale: random.pick(&[Scale::Linear, Scale::Log, Scale::SymLog]),
            contrast: is(random),
            bands: maybe(random, |r| r.below(1000) as u16 + 1),
            symmetric: is(random),
            nan_color: maybe(random, |_| "#12aB3f".parse().unwrap()),
        }
    }

    fn overlays(random: &mut Random) -> Overlays {
        let levels = [IsolineLevels::Auto, IsolineLevels::Count(5), IsolineLevels::At(vec![-0.75])];
        let isolines = maybe(random, |r| levels[r.below(3)].clone());
        Overlays {
            shown: (0..random.below(4)).map(|_| random.pick(&Overlay::ALL)).collect(),
            no_cracks: is(random),
            level_labels: isolines.is_some() && is(random),
            isolines,
            arrows: maybe(random, |r| r.between(20.0, 50.0)),
            crosses: maybe(random, |_| 36.0),
        }
    }

    fn scene(random: &mut Random) -> SceneRequest {
        let factors = [Magnification::Auto, Magnification::Given(-0.013)];
        let deformed = maybe(random, |r| r.pick(&factors));
        let subject = Subject {
            step: maybe(random, |r| r.below(99)),
            part: maybe(random, |r| text(r, &["smooth", "patch:7"])),
            functions: pairs(random, "westergaard"),
            weight: maybe(random, |r| text(r, &["bump", "-t + 1"])),
            quantities: pairs(random, "stretch"),
        };
        SceneRequest {
            subject,
            quantity: maybe(random, |r| text(r, &["-uy", "max(ux, hypot(uy, 1))", "patch:level"])),
            colors: colors(random),
            overlays: overlays(random),
            outline: deformed.is_some() && is(random),
            deformed,
            mirror: maybe(random, |r| {
                text(r, &["auto", "left,top:antisymmetric"]).parse().unwrap()
            }),
        }
    }

    fn panels(random: &mut Random, scene: &mut SceneRequest) -> Panels {
        let list = |texts: &[&str]| texts.iter().map(|&text| text.to_owned()).collect::<Vec<_>>();
        let quantities = maybe(random, |_| list(&["ux", "max(ux, uy)", "-s1"])).unwrap_or_default();
        let parts = maybe(random, |_| list(&["all", "jump", "patch:3"])).unwrap_or_default();
        scene.quantity = scene.quantity.take().filter(|_| quantities.is_empty());
        scene.subject.part = scene.subject.part.take().filter(|_| parts.is_empty());
        let layout = maybe(random, |r| [r.below(5) as u32, 2]);
        Panels { quantities, parts, layout, shared_range: is(random) }
    }

    fn request(random: &mut Random) -> Request {
        let mut scene = scene(random);
        let label =
            |random: &mut Random| maybe(random, |r| text(r, &["", "a, b = 'c'", "σ [GPa]"]));
        Request {
            figure: is(random),
            blank: is(random),
            look: look(random),
            labels: FigureTexts {
                title: label(random),
                x: label(random),
                y: label(random),
                bar: label(random),
            },
            panels: panels(random, &mut scene),
            place: place(random),
            scene,
            samples: Samples::new(random.below(16) as u8 + 1).unwrap(),
            backend: random.pick(&Backend::ALL),
            precision: maybe(random, |r| r.pick(&[Precision::F32, Precision::F64])),
        }
    }

    /// A request as the words of a command line ask for it.
    fn asked(words: &[String]) -> Request {
        let words = words.iter().map(OsString::from);
        let cli = Cli::understood(words).unwrap_or_else(|error| panic!("{error}"));
        let Command::Render(args) = cli.command else { panic!("another command") };
        args.request(&args.subject.texts().expect("no files"))
    }

    /// Every option of an image is in the words of its command, and means there what it meant.
    #[test]
    fn requests_come_back_from_their_commands() {
        let mut random = Random(37);
        let mut said = std::collections::BTreeSet::new();
        for _ in 0..300 {
            let request = request(&mut random);
            let words = command::render(&request, "-plate.h5", "out.png");
            assert_eq!(asked(&words), request, "{}", command::line(&words));
            let names = words.iter().filter_map(|word| word.strip_prefix("--"));
            said.extend(names.map(|word| word.split('=').next().unwrap().to_owned()));
        }
        let known = Cli::whole();
        let known = known.find_subcommand("render").unwrap().get_arguments();
        let not_of_images = ["output", "steps", "fps", "threads", "help"];
        let known: Vec<_> = known.filter_map(clap::Arg::get_long).collect();
        let known = known.iter().filter(|name| !not_of_images.contains(name));
        assert_eq!(said, known.map(|&name| name.to_owned()).collect());
    }
}
