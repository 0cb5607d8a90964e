//! `ppum render`: a picture of a quantity.

mod panels;

use std::path::{Path, PathBuf};

use anyhow::ensure;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::text::{apart, trimmed};
use ppum_figure::canvas::{Canvas, Item};
use ppum_figure::figure::{BarPlace, Design, Panel, bare, figure, plot_area};
use ppum_render::picture::Picture;
use ppum_render::png::Text;

use crate::arguments::size;
use crate::backend::Engine;
use crate::deformed::{Deformed, draw, words};
use crate::drawing::{Drawn, Job, Seen, Shown, Values};
use crate::look::{DEFAULT_SIZE, Look};
use crate::number::count;
use crate::output::{Output, tell};
use crate::overlays::{Ground, Overlays};
use crate::page;
use crate::subject::{Asked, Colors, Subject};
use crate::target;
use crate::undefined;
use crate::window::{Frame, Window};

/// Draw a quantity, exactly at every pixel
///
/// Each pixel's value is the field at the pixel's centre. Without --figure the picture is bare: one
/// pixel of the file is one pixel of the field, transparent outside the domain.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    #[command(flatten)]
    subject: Subject,
    /// Picture to write, - for standard output (PNG)
    #[arg(short, long, value_name = "OUT.png|svg|pdf")]
    output: PathBuf,
    #[command(flatten)]
    look: Look,
    /// Add axes, a colour bar, a title and the cracks
    #[arg(long)]
    figure: bool,
    /// Leave out the colours and their bar: the overlays alone
    #[arg(long)]
    blank: bool,
    /// Panels of a figure with several quantities or parts: columns and rows [default: as large as fits]
    #[arg(long, value_name = "CxR", value_parser = size)]
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
  ppum render plate.h5 -o gpu.png --backend gpu
  ppum render plate.h5 -o deep.png --center 0.5,0 --width 1e-12 --range 0,1e7";

/// What is drawn of.
struct Plate<'a> {
    dataset: &'a Dataset,
    field: &'a Field<'a>,
    /// The title of figures, which tells of what was replaced.
    shown: String,
}

impl Args {
    pub(crate) fn run(&self, out: &mut Output) -> anyhow::Result<()> {
        target::check(&self.output, target::Kind::Picture, self.inputs())?;
        self.engine.check()?;
        self.look.check(self.is_figure())?;
        ensure!(
            !(self.subject.has_parts() && self.deformed.is_given()),
            "several parts and --deformed do not go together; draw them one by one"
        );
        ensure!(
            self.has_panels() || !self.shared_range,
            "--shared-range is for panels; give several quantities or parts"
        );
        let datasets = self.subject.open_parts()?;
        let fields = datasets.iter().map(|dataset| self.subject.field(dataset));
        let fields = fields.collect::<anyhow::Result<Vec<_>>>()?;
        let plates: Vec<_> = datasets.iter().zip(&fields).map(|(d, f)| self.plate(d, f)).collect();
        match &plates[..] {
            [plate] if !self.has_panels() => self.one(plate, out),
            plates => self.panels(plates, out),
        }
    }

    /// True for a figure of several panels, or of one that is called so.
    fn has_panels(&self) -> bool {
        self.layout.is_some() || self.subject.count() > 1
    }

    fn is_figure(&self) -> bool {
        self.figure || self.has_panels()
    }

    /// The look of a figure.
    fn design(&self, field: &Field<'_>) -> Design {
        let design = self.look.design(self.window.aspect(field), DEFAULT_SIZE, [1, 1]);
        if self.blank { Design { bar: BarPlace::None, ..design } } else { design }
    }

    fn plate<'a>(&self, dataset: &'a Dataset, field: &'a Field<'a>) -> Plate<'a> {
        let shown = self.subject.replacements.title(&dataset.title);
        Plate { dataset, field, shown }
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

    /// Draws one quantity.
    fn one(&self, plate: &Plate<'_>, out: &mut Output) -> anyhow::Result<()> {
        let field = plate.field;
        let asked = self.asked(field)?.swap_remove(0);
        let mut labels = asked.labels(plate.shown.clone(), field);
        let design = self.design(field);
        let room = |title: &str| {
            if self.figure { plot_area(title, &design) } else { Ok(design.size) }
        };
        let frame = self.frame(room(&self.look.worded(labels.clone()).title)?);
        let seen = self.deformed.seen(field, &self.window, frame, &self.engine)?;
        labels.title = titled(labels.title, &seen);
        let labels = self.look.worded(labels);
        let drawn = self.drawn(field, &seen, &asked)?;
        let mut picture = drawn.picture(&self.colours.style_of(&[(&asked, &drawn)])?)?;
        let layers = self.layers(plate, &seen, &asked, &drawn.values, &picture)?;
        self.blank(&mut picture);
        let cracks = seen.cracks(field);
        let panel = Panel { picture: &picture, layers, labels, cracks: &cracks, bar_of: None };
        let page = self.page(panel, &design)?;
        let mut texts =
            picture.description(&plate.dataset.title, &self.subject.file_name(), &asked.name);
        texts.push(("ppum:backend".to_owned(), drawn.by.clone()));
        texts.extend(asked.note().into_iter().chain(self.notes(&seen)));
        let ([columns, rows], told) = (page.size, told(&seen, drawn.overlap.len()));
        let (name, colors, by) = (&asked.name, colours(&picture), drawn.by);
        let told = format!("{name}{told}, {columns}x{rows} pixels, {colors}, {by}");
        page::save(&self.output, &page, self.look.given_dpi(), &texts, &told, out)
    }

    /// The values of what is shown where they are seen.
    fn drawn(&self, field: &Field<'_>, seen: &Seen<'_>, asked: &Asked) -> anyhow::Result<Drawn> {
        let drawn = match (seen, &asked.shown) {
            (Seen::Plate(view), Shown::Quantity(quantity)) => {
                self.engine.draw(Job { field, view, quantity })?
            }
            (Seen::Plate(view), Shown::Cells(_, values)) => Drawn::of_cells(values, field, view),
            (Seen::Moved(points), shown) => draw(points, shown, &self.engine)?,
        };
        if !drawn.without.is_empty() {
            let (name, counts) = (&asked.name, drawn.undefined());
            let message = match &asked.shown {
                Shown::Quantity(_) => undefined::message(name, counts, "pixels"),
                Shown::Cells(..) => undefined::of_cells(name, counts),
            };
            tell(&format!("warning: {message}"));
        }
        Ok(drawn)
    }

    /// What is drawn over a picture.
    fn layers(
        &self,
        plate: &Plate<'_>,
        seen: &Seen<'_>,
        asked: &Asked,
        values: &Values,
        picture: &Picture,
    ) -> anyhow::Result<Vec<Item>> {
        let (Plate { dataset, field, .. }, quantity) = (plate, asked.shown.quantity());
        let is_figure = self.is_figure();
        let ground = Ground { dataset, field, quantity, picture, values, is_figure };
        let outline = self.deformed.outline;
        self.engine.with_threads(|| match seen {
            Seen::Plate(_) => self.overlays.items(ground),
            Seen::Moved(points) => self.overlays.deformed_items(ground, points, outline),
        })?
    }

    /// What was done to the dataset and the plate, as texts of the picture.
    fn notes(&self, seen: &Seen<'_>) -> impl Iterator<Item = Text> {
        let factor = seen.moved().map(|points| format!("{:?}", points.view.factor()));
        let deformed = factor.map(|factor| ("ppum:deformed".to_owned(), factor));
        self.subject.replacements.notes().chain(deformed)
    }

    /// Leaves out the colours if that is asked for: the plate is white.
    fn blank(&self, picture: &mut Picture) {
        if self.blank {
            let pixels = picture.image.rgba.as_chunks_mut::<4>().0;
            pixels.iter_mut().filter(|pixel| pixel[3] > 0).for_each(|pixel| *pixel = [255; 4]);
        }
    }

    /// The files that are read.
    fn inputs(&self) -> impl Iterator<Item = &Path> {
        self.subject.inputs().chain(self.colours.input())
    }

    /// The room of a picture of so many pixels.
    fn frame(&self, pixels: [u32; 2]) -> Frame {
        // A figure centres what it is given; a bare picture has the size that was asked for.
        let may_shrink = self.is_figure() || self.look.given_size().is_none();
        Frame { pixels, may_shrink, margin: self.overlays.margin() }
    }

    /// The picture with its overlays, as a figure if that is asked for.
    fn page(&self, panel: Panel<'_>, design: &Design) -> anyhow::Result<Canvas> {
        if self.figure { Ok(figure(panel, design)?) } else { Ok(bare(panel.picture, panel.layers)) }
    }
}

/// The title of a figure, of the deformed plate with the factor.
fn titled(title: String, seen: &Seen<'_>) -> String {
    match seen.moved() {
        Some(points) => format!("{title} ({})", words(&points.view)).trim_start().to_owned(),
        None => title,
    }
}

/// Of the deformed plate the factor, and at how many pixels it lies over itself.
fn told(seen: &Seen<'_>, overlaps: usize) -> String {
    match (seen.moved(), overlaps) {
        (None, _) => String::new(),
        (Some(points), 0) => format!(", {}", words(&points.view)),
        (Some(points), n) => {
            let pixels = count(n, "pixel", "pixels");
            format!(", {}, over itself at {pixels} (hatched)", words(&points.view))
        }
    }
}

/// The meaning of the colours.
fn colours(picture: &Picture) -> String {
    let (norm, classes) = (&picture.normalization, picture.colormap.classes());
    match picture.one_value {
        _ if !picture.has_values => "no finite values".into(),
        Some(value) => format!("one value, {}", trimmed(value)),
        None if !classes.is_empty() => {
            let values: Vec<String> = classes.iter().map(|value| trimmed(*value)).collect();
            format!("a colour each for {}", values.join(", "))
        }
        None => {
            let [from, to] = apart(norm.min(), norm.max());
            format!("colours from {from} to {to}")
        }
    }
}
