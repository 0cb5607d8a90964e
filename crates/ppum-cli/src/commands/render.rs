//! `ppum render`: a picture of a quantity.

mod panels;
mod series;

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail, ensure};
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum_figure::canvas::Canvas;
use ppum_figure::figure::{BarPlace, Design, Labels, Panel, bare, figure, lacks_legend, plot_area};
use ppum_render::deform::DeformedView;
use ppum_render::picture::{Picture, Style};
use ppum_render::png::Text;
use ppum_render::range::Span;
use ppum_render::samples::Samples;
use ppum_render::view::View;

use crate::arguments::layout;
use crate::backend::Engine;
use crate::deformed::{Deformed, Deforming, draw, points};
use crate::look::{DEFAULT_SIZE, Look};
use crate::number::count;
use crate::output::{Output, tell};
use crate::overlays::{Overlays, tell_legend};
use crate::page;
use crate::progress::Bar;
use crate::subject::{Asked, Colors, Subject};
use crate::target;
use crate::undefined;
use crate::window::{Frame, Window};
use ppum_scene::deformed::words;
use ppum_scene::drawing::{Drawn, Job, Seen, Shown};
use ppum_scene::layers::{Ground, Layers, scale};
use ppum_scene::range::{self, Telling};
use ppum_scene::shared::Coloring;
use ppum_scene::shot::of_step;
use series::Series;

/// Draw a quantity, exactly at every pixel
///
/// Each pixel's value is the field at the pixel's centre. Without --figure the picture is bare: one
/// pixel of the file is one pixel of the field, transparent outside the domain.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    #[command(flatten)]
    subject: Subject,
    /// Picture to write, - for standard output (PNG); with --steps moving pictures too
    #[arg(short, long, value_name = "OUT.png|svg|pdf|gif|apng")]
    output: PathBuf,
    #[command(flatten)]
    series: Series,
    #[command(flatten)]
    look: Look,
    /// Add axes, a colour bar, a title and the cracks
    #[arg(long)]
    figure: bool,
    /// Leave out the colours and their bar: the overlays alone
    #[arg(long)]
    blank: bool,
    /// Panels of a figure with several quantities or parts: columns and rows [default: as large as fits]
    #[arg(long, value_name = "CxR", value_parser = layout)]
    layout: Option<[u32; 2]>,
    /// Give all panels one range and one colour bar
    #[arg(long)]
    shared_range: bool,
    #[command(flatten)]
    window: Window,
    #[command(flatten)]
    colours: Colors,
    #[command(flatten)]
    overlays: Overlays,
    #[command(flatten)]
    deformed: Deformed,
    /// Show the mean of N x N values in each pixel, against jagged edges, in place of that at its centre
    #[arg(long, value_name = "N", default_value = "1")]
    samples: Samples,
    #[command(flatten)]
    engine: Engine,
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

/// What is drawn of.
struct Plate<'a> {
    dataset: &'a Dataset,
    field: &'a Field<'a>,
    /// The title of figures, which tells of what was replaced, and the step of a series.
    shown: String,
    /// The number of the step, if there are several.
    step: Option<usize>,
}

/// A quantity of a plate in a view: what a picture shows.
struct Shot<'a> {
    plate: &'a Plate<'a>,
    asked: Asked,
    labels: Labels,
    scene: Scene<'a>,
}

/// What is to be seen.
enum Scene<'a> {
    /// The plate as it was before it was loaded.
    Still(View),
    /// The plate moved by its displacements.
    Moved(DeformedView<'a>),
}

/// What pictures of several plates have in common.
struct Common {
    deforming: Option<Deforming>,
    design: Design,
    frame: Frame,
}

/// Calls what it is given with one plate after the other.
type Each<'a> = dyn Fn(&mut Visit<'_>) -> anyhow::Result<()> + 'a;
type Visit<'a> = dyn FnMut(&Plate<'_>) -> anyhow::Result<()> + 'a;

/// A page with what is told of it.
struct Sheet {
    page: Canvas,
    picture: Picture,
    texts: Vec<Text>,
}

impl Args {
    pub(crate) fn run(&self, out: &mut Output) -> anyhow::Result<()> {
        self.engine.check()?;
        self.look.check(self.is_figure())?;
        self.check_deformed()?;
        ensure!(
            self.has_panels() || !self.shared_range,
            "--shared-range is for panels; give several quantities or parts"
        );
        if self.series.is_given() {
            return self.all_steps(out);
        }
        series::refuse_moving(&self.output)?;
        target::check(&self.output, target::Kind::Picture, self.inputs())?;
        let datasets = self.subject.open_parts()?;
        let fields = datasets.iter().map(|dataset| self.subject.field(dataset));
        let fields = fields.collect::<anyhow::Result<Vec<_>>>()?;
        let last = datasets[0].steps.len().saturating_sub(1);
        let step = self.subject.step.unwrap_or(last);
        let plates = datasets.iter().zip(&fields).map(|(d, f)| self.plate(d, f, step));
        match &plates.collect::<Vec<_>>()[..] {
            [plate] if !self.has_panels() => self.one(plate, out),
            plates => self.panels(plates, out),
        }
    }

    /// True for a figure of several panels, or of one that is called so.
    fn has_panels(&self) -> bool {
        self.layout.is_some() || self.subject.count() > 1
    }

    /// Refuses what does not go together with a deformed plate.
    fn check_deformed(&self) -> anyhow::Result<()> {
        if !self.deformed.is_given() {
            return Ok(());
        }
        ensure!(
            !self.subject.has_parts(),
            "several parts and --deformed do not go together; draw them one by one"
        );
        ensure!(
            self.samples == Samples::CENTER,
            "--samples: the deformed plate is drawn at the centres of pixels; leave --samples or --deformed out"
        );
        self.overlays.check_deformed()
    }

    fn is_figure(&self) -> bool {
        self.figure || self.has_panels()
    }

    /// The look of a figure, of a size unless another is given, with so many panels across and down.
    fn design(&self, field: &Field<'_>, size: [u32; 2], panels: [u32; 2]) -> Design {
        let design = self.look.design(self.window.aspect(field), size, panels);
        if self.blank { Design { bar: BarPlace::None, ..design } } else { design }
    }

    /// What is shown of a plate. Isolines of values of cells alone are refused.
    fn asked(&self, field: &Field<'_>) -> anyhow::Result<Vec<Asked>> {
        let asked = self.subject.asked(field)?;
        let is_of_cells = |asked: &Asked| asked.shown.quantity().is_none();
        ensure!(
            !(self.overlays.have_isolines() && asked.iter().all(is_of_cells)),
            "--isolines: `{}` is constant in each cell; --overlay cells draws the borders",
            asked[0].name
        );
        Ok(asked)
    }

    fn plate<'a>(&self, dataset: &'a Dataset, field: &'a Field<'a>, step: usize) -> Plate<'a> {
        let title = of_step(dataset, step);
        let shown = self.subject.replacements.title(&title);
        Plate { dataset, field, shown, step: (dataset.steps.len() > 1).then_some(step) }
    }

    /// Draws one quantity.
    fn one(&self, plate: &Plate<'_>, out: &mut Output) -> anyhow::Result<()> {
        let common = self.common(&|visit| visit(plate))?;
        let shot = &self.shot(plate, &common)?;
        let (field, asked) = (plate.field, &shot.asked);
        let seen = self.seen(shot)?;
        let drawn = self.drawn(field, &seen, asked)?;
        warn(asked, drawn.undefined());
        warn_of_infinite(asked, &drawn);
        let style = self.colours.style_of(&[(asked, &drawn)])?;
        let span = self.span(field, &seen, asked, &drawn, &style)?;
        let coloring = Coloring { style, span, ends: None };
        let Sheet { page, picture, texts } =
            self.sheet(shot, (&seen, &drawn), &coloring, &common.design)?;
        let ([columns, rows], told) = (page.size, told(&seen, drawn.overlap.len()));
        let (name, telling) = (&asked.name, Telling::new(plate.dataset, field));
        let (colors, by) = (telling.colors(&picture), drawn.by);
        let told = format!("{name}{told}, {columns}x{rows} pixels, {colors}, {by}");
        page::save(&self.output, &page, self.look.given_dpi(), &texts, &told, out)
    }

    /// What pictures of all plates have in common that `each` calls its argument with.
    fn common(&self, each: &Each<'_>) -> anyhow::Result<Common> {
        let fields = |visit: &mut dyn FnMut(&Field<'_>) -> anyhow::Result<()>| {
            each(&mut |plate| visit(plate.field))
        };
        let deforming = self.deformed.of(&fields)?;
        let factor = deforming.as_ref().map(Deforming::words);
        let (mut design, mut titles) = (None, Vec::new());
        each(&mut |plate| {
            design.get_or_insert_with(|| self.design(plate.field, DEFAULT_SIZE, [1, 1]));
            titles.push(self.labelled(plate, factor.as_deref())?.1.title);
            Ok(())
        })?;
        let design = design.context("--steps: there is no step")?;
        let frame = self.frame(self.room(titles.iter().map(String::as_str), &design)?, &design);
        Ok(Common { deforming, design, frame })
    }

    /// What is shown of a plate, and the words of its figure.
    fn labelled(&self, plate: &Plate<'_>, factor: Option<&str>) -> anyhow::Result<(Asked, Labels)> {
        let asked = self.asked(plate.field)?.swap_remove(0);
        let title = titled(plate.shown.clone(), factor);
        let labels = self.look.worded(asked.labels(title, plate.field));
        Ok((asked, plate.filled(labels)))
    }

    /// What the picture of a plate shows.
    fn shot<'a>(&self, plate: &'a Plate<'a>, common: &Common) -> anyhow::Result<Shot<'a>> {
        let (field, frame, deforming) = (plate.field, common.frame, &common.deforming);
        let factor = deforming.as_ref().map(Deforming::words);
        let (asked, labels) = self.labelled(plate, factor.as_deref())?;
        let scene = match deforming {
            None => Scene::Still(self.window.seen(field, frame)?),
            Some(deforming) => Scene::Moved(deforming.view(field, &self.window, frame)?),
        };
        Ok(Shot { plate, asked, labels, scene })
    }

    /// The room that all titles leave.
    fn room<'t>(
        &self,
        titles: impl Iterator<Item = &'t str>,
        design: &Design,
    ) -> anyhow::Result<[u32; 2]> {
        let mut room = design.size;
        for title in titles.filter(|_| self.figure) {
            let [columns, rows] = plot_area(title, design)?;
            room = [room[0].min(columns), room[1].min(rows)];
        }
        Ok(room)
    }

    /// What is seen.
    fn seen<'a>(&self, shot: &Shot<'a>) -> anyhow::Result<Seen<'a>> {
        match &shot.scene {
            Scene::Still(view) => Ok(Seen::Plate(*view)),
            Scene::Moved(view) => points(view, &self.engine),
        }
    }

    /// The values of a quantity where they are seen.
    fn drawn(&self, field: &Field<'_>, seen: &Seen<'_>, asked: &Asked) -> anyhow::Result<Drawn> {
        let samples = self.samples;
        match (seen, &asked.shown) {
            (Seen::Plate(view), Shown::Quantity(quantity)) => {
                self.engine.average(Job { field, view, quantity }, samples)
            }
            (_, Shown::Cells(..)) if samples != Samples::CENTER => bail!(
                "--samples: values of cells are drawn at the centres of pixels; leave --samples out"
            ),
            (Seen::Plate(view), Shown::Cells(_, values)) => {
                Ok(Drawn::of_cells(values, field, view))
            }
            (Seen::Moved(points), shown) => draw(points, shown, &self.engine),
        }
    }

    /// The range of a quantity's colours.
    fn span(
        &self,
        field: &Field<'_>,
        seen: &Seen<'_>,
        asked: &Asked,
        drawn: &Drawn,
        style: &Style,
    ) -> anyhow::Result<Span> {
        let Some(quantity) = asked.shown.quantity() else { return Ok(drawn.span(style, None)) };
        let found = || range::found(field, seen, quantity, drawn, style, &Bar::new());
        Ok(self.engine.with_threads(found)??)
    }

    /// The values in colours, with all that belongs to them.
    fn sheet(
        &self,
        shot: &Shot<'_>,
        (seen, drawn): (&Seen<'_>, &Drawn),
        coloring: &Coloring,
        design: &Design,
    ) -> anyhow::Result<Sheet> {
        let Shot { plate, asked, labels, .. } = shot;
        let mut picture = coloring.picture(drawn)?;
        let Layers { items: layers, legend, .. } =
            self.layers(plate, seen, asked, drawn, &picture, design)?;
        self.blank(&mut picture);
        let (labels, cracks) = (labels.clone(), seen.cracks(plate.field));
        let page = self.page(
            Panel { picture: &picture, layers, legend, labels, cracks: &cracks, bar_of: None },
            design,
        )?;
        let mut texts =
            picture.description(&plate.dataset.title, &self.subject.file_name(), &asked.name);
        texts.push(("ppum:backend".to_owned(), drawn.by.clone()));
        texts.extend(asked.note().into_iter().chain(self.notes(plate, seen)));
        Ok(Sheet { page, picture, texts })
    }

    /// What is drawn over a picture.
    fn layers(
        &self,
        plate: &Plate<'_>,
        seen: &Seen<'_>,
        asked: &Asked,
        drawn: &Drawn,
        picture: &Picture,
        design: &Design,
    ) -> anyhow::Result<Layers> {
        let (Plate { dataset, field, .. }, quantity) = (plate, asked.shown.quantity());
        let is_figure = self.is_figure();
        let has_bar = is_figure && design.bar != BarPlace::None;
        let design = is_figure.then_some(design);
        let centers;
        let needs_centers = drawn.opacity.is_some() && self.overlays.have_isolines();
        let values = match quantity.filter(|_| needs_centers) {
            Some(quantity) => {
                // isolines are looked for between the pixels' centres
                centers = self.engine.draw(Job { field, view: &drawn.view, quantity })?;
                &centers.values
            }
            None => &drawn.values,
        };
        let ground = Ground { dataset, field, quantity, picture, values, design, has_bar };
        let outline = self.deformed.outline;
        self.engine.with_threads(|| self.overlays.layers(ground, seen, outline))?
    }

    /// What was done to the dataset and the plate, as texts of the picture.
    fn notes(&self, plate: &Plate<'_>, seen: &Seen<'_>) -> impl Iterator<Item = Text> {
        let factor = seen.moved().map(|points| format!("{:?}", points.view.factor()));
        let deformed = factor.map(|factor| ("ppum:deformed".to_owned(), factor));
        self.subject.replacements.notes().chain(deformed).chain(plate.notes())
    }

    /// Leaves out the colours if that is asked for: the plate is white.
    fn blank(&self, picture: &mut Picture) {
        if self.blank {
            let pixels = picture.image.rgba.as_chunks_mut::<4>().0;
            let seen = pixels.iter_mut().filter(|pixel| pixel[3] > 0);
            seen.for_each(|pixel| pixel[..3].fill(255));
        }
    }

    /// The files that are read.
    fn inputs(&self) -> impl Iterator<Item = &Path> {
        self.subject.inputs().chain(self.colours.input())
    }

    /// The room of a picture of so many pixels.
    fn frame(&self, pixels: [u32; 2], design: &Design) -> Frame {
        // A figure centres what it is given; a bare picture has the size that was asked for.
        let may_shrink = self.is_figure() || self.look.given_size().is_none();
        let scale = scale(self.is_figure().then_some(design), pixels);
        Frame { pixels, may_shrink, margin: self.overlays.margin(pixels, scale) }
    }

    /// The picture with its overlays, as a figure if that is asked for.
    fn page(&self, panel: Panel<'_>, design: &Design) -> anyhow::Result<Canvas> {
        if !self.figure {
            tell_legend(&panel.legend);
            return Ok(bare(panel.picture, panel.layers));
        }
        if lacks_legend(&panel, plot_area(&panel.labels.title, design)?, design) {
            tell_legend(&panel.legend);
        }
        Ok(figure(panel, design)?)
    }
}

impl Scene<'_> {
    fn view(&self) -> &View {
        match self {
            Self::Still(view) => view,
            Self::Moved(seen) => &seen.view,
        }
    }
}

/// Tells that a quantity is infinite wherever it has a value.
fn warn_of_infinite(asked: &Asked, drawn: &Drawn) {
    let statistics = drawn.values.statistics();
    if statistics.finite == 0 && statistics.infinite > 0 {
        tell(&format!("warning: `{}` has no finite value in the picture", asked.name));
    }
}

/// Tells that a quantity has no value at some pixels of the plate, of so many.
fn warn(asked: &Asked, undefined: [usize; 2]) {
    if undefined[1] == 0 {
        tell("warning: no pixel has its centre on the plate");
    } else if undefined[0] > 0 {
        let message = match &asked.shown {
            Shown::Quantity(_) => undefined::message(&asked.name, undefined, "pixels"),
            Shown::Cells(..) => undefined::of_cells(&asked.name, undefined),
        };
        tell(&format!("warning: {message}"));
    }
}

/// The title of a figure, of the deformed plate with the factor in words.
fn titled(title: String, factor: Option<&str>) -> String {
    match factor {
        Some(factor) => format!("{title} ({factor})").trim_start().to_owned(),
        None => title,
    }
}

/// Of the deformed plate the factor, and at how many pixels it lies over itself.
fn told(seen: &Seen<'_>, overlaps: usize) -> String {
    let factor = seen.moved().map(|points| words(points.view.factor()));
    match (factor, overlaps) {
        (None, _) => String::new(),
        (Some(factor), 0) => format!(", {factor}"),
        (Some(factor), n) => {
            let pixels = count(n, "pixel", "pixels");
            format!(", {factor}, over itself at {pixels} (hatched)")
        }
    }
}
