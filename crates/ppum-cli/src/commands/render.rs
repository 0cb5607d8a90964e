//! `ppum render`: a picture of a quantity.

mod look;
mod panels;
mod series;

use std::path::{Path, PathBuf};

use anyhow::ensure;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum_figure::canvas::{Canvas, Item};
use ppum_figure::figure::{Design, Labels, Panel, bare, figure, plot_area};
use ppum_render::deform::DeformedView;
use ppum_render::picture::{Picture, Style};
use ppum_render::png::Text;
use ppum_render::range::Span;
use ppum_render::samples::Samples;
use ppum_render::view::View;

use crate::arguments::size;
use crate::backend::Engine;
use crate::deformed::{Deformed, draw, words};
use crate::drawing::{Drawn, Job, Values};
use crate::number::count;
use crate::output::{Output, tell};
use crate::overlays::{Ground, Overlays};
use crate::page;
use crate::range::{self, Telling};
use crate::subject::{Asked, Colors, Subject};
use crate::target;
use crate::undefined;
use crate::window::{Frame, Window};
use look::Look;
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
    /// Panels of a figure with several quantities: columns and rows
    #[arg(long, value_name = "CxR", value_parser = size)]
    layout: Option<[u32; 2]>,
    /// Give all panels one range and one colour bar
    #[arg(long, requires = "layout")]
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

/// What is seen.
enum Scene<'a> {
    /// The plate as it was before it was loaded.
    Still(View),
    /// The plate moved by its displacements.
    Moved(DeformedView<'a>),
}

/// The way values become colours.
struct Coloring {
    style: Style,
    span: Span,
    /// Of a series: true if values of some step lie below the range, and above it, so that all bars are alike.
    ends: Option<[bool; 2]>,
}

/// A page with what is told of it.
struct Sheet {
    page: Canvas,
    picture: Picture,
    texts: Vec<Text>,
    /// Behind the quantity's name, in messages: the view of the deformed plate in words.
    told: String,
}

impl Args {
    pub(crate) fn run(&self, out: &mut Output) -> anyhow::Result<()> {
        self.engine.check()?;
        self.look.check(self.layout.is_some())?;
        ensure!(
            self.layout.is_none() || !self.deformed.is_given(),
            "--layout and --deformed do not go together yet; draw the panels one by one"
        );
        ensure!(
            self.samples == Samples::CENTER || !self.deformed.is_given(),
            "--samples: the deformed plate is drawn at the pixels' centres; leave --samples or --deformed out"
        );
        if self.series.is_given() {
            return self.all_steps(out);
        }
        series::refuse_moving(&self.output)?;
        target::check(&self.output, target::Kind::Picture, self.inputs())?;
        let dataset = self.subject.open()?;
        let field = self.subject.field(&dataset)?;
        let last = dataset.steps.len().saturating_sub(1);
        let plate = self.plate(&dataset, &field, self.subject.step.unwrap_or(last));
        match self.layout {
            None => self.one(&plate, out),
            Some(layout) => self.panels(&plate, layout, out),
        }
    }

    fn plate<'a>(&self, dataset: &'a Dataset, field: &'a Field<'a>, step: usize) -> Plate<'a> {
        let title = series::title(dataset, step);
        let shown = self.subject.replacements.title(&title);
        Plate { dataset, field, shown, step: (dataset.steps.len() > 1).then_some(step) }
    }

    /// Draws one quantity.
    fn one(&self, plate: &Plate<'_>, out: &mut Output) -> anyhow::Result<()> {
        let (shots, design) = self.shots(std::slice::from_ref(plate))?;
        let shot = &shots[0];
        let drawn = self.values(shot)?;
        drawn.warn(&shot.asked.name);
        let style = self.colours.style(&shot.asked.quantity)?;
        let span = self.span(shot, &drawn, &style)?;
        let coloring = Coloring { style, span, ends: None };
        let Sheet { page, picture, texts, told } = self.sheet(shot, &drawn, &coloring, &design)?;
        let [columns, rows] = page.size;
        let (name, telling) = (&shot.asked.name, Telling::new(plate.dataset, plate.field));
        let (colors, by) = (telling.colors(&picture), drawn.by);
        let told = format!("{name}{told}, {columns}x{rows} pixels, {colors}, {by}");
        page::save(&self.output, &page, self.look.given_dpi(), &texts, &told, out)
    }

    /// What pictures of plates show, which have one size and one look.
    fn shots<'a>(&self, plates: &'a [Plate<'a>]) -> anyhow::Result<(Vec<Shot<'a>>, Design)> {
        let fields: Vec<&Field<'_>> = plates.iter().map(|plate| plate.field).collect();
        let deforming = self.deformed.of(&fields)?;
        let moved = deforming.as_ref().map(|d| format!(" ({})", d.words())).unwrap_or_default();
        let design = self.look.design(self.window.aspect(fields[0]));
        let words = |plate: &Plate<'_>| {
            let asked = self.subject.quantity(plate.field)?;
            let title = format!("{}{moved}", plate.shown).trim_start().to_owned();
            let labels = self.look.worded(asked.labels(title, plate.field));
            anyhow::Ok((asked, plate.filled(labels)))
        };
        let words = plates.iter().map(words).collect::<anyhow::Result<Vec<_>>>()?;
        let titles = words.iter().map(|(_, labels)| labels.title.as_str());
        let frame = self.frame(self.room(titles, &design)?);
        let shot = |(plate, (asked, labels)): (&'a Plate<'a>, (Asked, Labels))| {
            let scene = match &deforming {
                None => Scene::Still(self.window.seen(plate.field, frame)?),
                Some(deforming) => {
                    Scene::Moved(deforming.view(plate.field, &self.window, frame)?)
                }
            };
            Ok(Shot { plate, asked, labels, scene })
        };
        let shots = plates.iter().zip(words).map(shot).collect::<anyhow::Result<_>>()?;
        Ok((shots, design))
    }

    /// The room that all titles leave.
    fn room<'t>(
        &self,
        titles: impl Iterator<Item = &'t str>,
        design: &Design,
    ) -> anyhow::Result<[u32; 2]> {
        let mut room = self.look.size();
        for title in titles.filter(|_| self.look.figure) {
            let [columns, rows] = plot_area(title, design)?;
            room = [room[0].min(columns), room[1].min(rows)];
        }
        Ok(room)
    }

    /// The values that a picture shows.
    fn values(&self, shot: &Shot<'_>) -> anyhow::Result<Drawn> {
        match &shot.scene {
            Scene::Still(_) => self.engine.average(shot.job(), self.samples),
            Scene::Moved(seen) => Ok(draw(seen, &shot.asked.quantity, &self.engine)?.0),
        }
    }

    /// The range of these values.
    fn span(&self, shot: &Shot<'_>, drawn: &Drawn, style: &Style) -> anyhow::Result<Span> {
        match &shot.scene {
            Scene::Still(_) => {
                let job = shot.job();
                Ok(self.engine.with_threads(|| range::found(drawn, job, style))??)
            }
            Scene::Moved(_) => Ok(range::of_pixels(drawn, style)),
        }
    }

    /// The values in colours, with all that belongs to them.
    fn sheet(
        &self,
        shot: &Shot<'_>,
        drawn: &Drawn,
        coloring: &Coloring,
        design: &Design,
    ) -> anyhow::Result<Sheet> {
        let Shot { plate, asked, labels, scene } = shot;
        let mut picture = coloring.picture(drawn)?;
        let (layers, told) = match scene {
            Scene::Still(_) => (self.over(plate, asked, drawn, &picture)?, String::new()),
            Scene::Moved(seen) => {
                let (figure, outline) = (self.look.figure, self.deformed.outline);
                let layers = self.overlays.deformed_items(seen, figure, outline)?;
                (layers, told_of(seen, drawn.overlap.len()))
            }
        };
        self.blank(&mut picture);
        let cracks = match scene {
            Scene::Still(_) => plate.field.step.cracks.clone(),
            Scene::Moved(seen) => seen.moved_cracks(),
        };
        let labels = labels.clone();
        let panel = Panel { picture: &picture, layers, labels, cracks: &cracks };
        let page = self.page(panel, design)?;
        let mut texts =
            picture.description(&plate.dataset.title, &self.subject.file_name(), &asked.name);
        texts.push(("ppum:backend".to_owned(), drawn.by.clone()));
        texts.extend(asked.note().into_iter().chain(self.subject.replacements.notes()));
        texts.extend(scene.note());
        texts.extend(plate.notes());
        Ok(Sheet { page, picture, texts, told })
    }

    /// What is drawn over the undeformed plate. Isolines are found from values at the pixels' centres.
    fn over(
        &self,
        plate: &Plate<'_>,
        asked: &Asked,
        drawn: &Drawn,
        picture: &Picture,
    ) -> anyhow::Result<Vec<Item>> {
        if self.samples == Samples::CENTER || !self.overlays.have_isolines() {
            return self.layers(plate, asked, &drawn.values, picture);
        }
        let job = Job { field: plate.field, view: &drawn.view, quantity: &asked.quantity };
        self.layers(plate, asked, &self.engine.draw(job)?.values, picture)
    }

    /// What is drawn over a picture.
    fn layers(
        &self,
        plate: &Plate<'_>,
        asked: &Asked,
        values: &Values,
        picture: &Picture,
    ) -> anyhow::Result<Vec<Item>> {
        let (Plate { dataset, field, .. }, quantity) = (plate, &asked.quantity);
        let is_figure = self.look.figure || self.layout.is_some();
        let ground = Ground { dataset, field, quantity, picture, values, is_figure };
        self.engine.with_threads(|| self.overlays.items(ground))?
    }

    /// Leaves out the colours if that is asked for: the plate is white.
    fn blank(&self, picture: &mut Picture) {
        if self.look.blank {
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
    fn frame(&self, pixels: [u32; 2]) -> Frame {
        // A figure centres what it is given; a bare picture has the size that was asked for.
        let is_figure = self.look.figure || self.layout.is_some();
        let may_shrink = is_figure || self.look.given_size().is_none();
        Frame { pixels, may_shrink, margin: self.overlays.margin() }
    }

    /// The picture with its overlays, as a figure if that is asked for.
    fn page(&self, panel: Panel<'_>, design: &Design) -> anyhow::Result<Canvas> {
        if self.look.figure {
            Ok(figure(panel, design)?)
        } else {
            Ok(bare(panel.picture, panel.layers))
        }
    }
}

impl Shot<'_> {
    /// What is drawn of an undeformed plate.
    fn job(&self) -> Job<'_> {
        let view = match &self.scene {
            Scene::Still(view) => view,
            Scene::Moved(seen) => &seen.view,
        };
        Job { field: self.plate.field, view, quantity: &self.asked.quantity }
    }
}

impl Coloring {
    fn picture(&self, drawn: &Drawn) -> anyhow::Result<Picture> {
        let mut picture = drawn.picture(&self.style, self.span.clone())?;
        if let Some(ends) = self.ends {
            [picture.has_below, picture.has_above] = ends;
            picture.one_value = None;
        }
        Ok(picture)
    }
}

impl Scene<'_> {
    /// How it is deformed, as a note in the picture.
    fn note(&self) -> Option<Text> {
        let Self::Moved(seen) = self else { return None };
        Some(("ppum:deformed".to_owned(), format!("{:?}", seen.factor())))
    }
}

/// The factor, and at how many pixels the plate lies over itself.
fn told_of(seen: &DeformedView<'_>, overlaps: usize) -> String {
    match overlaps {
        0 => format!(", {}", words(seen.factor())),
        n => format!(
            ", {}, over itself at {} (hatched)",
            words(seen.factor()),
            count(n, "pixel", "pixels")
        ),
    }
}

impl Drawn {
    /// Tells that a quantity has no value at some pixels.
    fn warn(&self, name: &str) {
        if !self.without.is_empty() {
            tell(&format!("warning: {}", undefined::message(name, self.undefined(), "pixels")));
        }
    }
}
