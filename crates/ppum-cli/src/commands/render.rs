//! `ppum render`: a picture of a quantity.

mod file;
mod look;
mod panels;
mod subject;
mod window;

use std::path::{Path, PathBuf};

use anyhow::ensure;
use clap::ValueEnum;
use ppum::field::Field;
use ppum::text::{apart, trimmed};
use ppum_figure::canvas::Item;
use ppum_figure::figure::{Panel, bare, figure, plot_area};
use ppum_figure::overlay;
use ppum_render::picture::Picture;
use ppum_render::view::View;

use crate::arguments::size;
use crate::backend::{Drawn, Engine, Job};
use crate::dataset::{field, open};
use crate::given;
use crate::output::{Output, tell};
use crate::replacements::Replacements;
use crate::standard::{self, is_standard};
use crate::target;
use crate::undefined;
use look::Look;
use subject::{Colors, Subject};
use window::{Frame, Window};

/// Draw a quantity, exactly at every pixel
///
/// Each pixel's value is the field at the pixel's centre. Without --figure the picture is bare: one
/// pixel of the file is one pixel of the field, transparent outside the domain.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Dataset, - for standard input
    #[arg(value_name = "FILE.h5")]
    file: PathBuf,
    /// Picture to write, - for standard output (PNG)
    #[arg(short, long, value_name = "OUT.png|svg|pdf")]
    output: PathBuf,
    /// Quantity, see `ppum info`, or a formula of quantities, or @FILE with one; with --layout several,
    /// apart by commas [default: von-mises; for Poisson problems u]
    #[arg(short, long, value_name = "Q", allow_hyphen_values = true)]
    quantity: Option<String>,
    #[command(flatten)]
    replacements: Replacements,
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
    colors: Colors,
    /// What is drawn over the colours; a figure always shows the cracks
    #[arg(long, value_enum, value_delimiter = ',')]
    overlay: Vec<Overlay>,
    #[command(flatten)]
    engine: Engine,
    /// Step of the series, from 0 [default: the last]
    #[arg(long, value_name = "K")]
    step: Option<usize>,
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
  ppum render plate.h5 -o part.png --view -0.2,-0.1,0.2,0.1 --overlay cracks,patches
  ppum render plate.h5 -o paper.pdf --figure --inches 3.4x2.6 --font-size 8
  ppum render plate.h5 -o four.svg -q von-mises,ux,uy,syy --layout 2x2
  ppum render plate.h5 -o gpu.png --backend gpu
  ppum render plate.h5 -o deep.png --center 0.5,0 --width 1e-12 --range 0,1e7";

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Overlay {
    /// Cracks and their tips
    Cracks,
    /// Borders of the cover's cells
    Patches,
}

/// What is drawn of.
struct Plate<'a> {
    field: &'a Field<'a>,
    /// The dataset's title.
    title: &'a str,
    /// The title of figures, which tells of what was replaced.
    shown: String,
}

impl Args {
    pub(crate) fn run(&self, out: &mut Output) -> anyhow::Result<()> {
        target::check(&self.output, target::Kind::Picture, self.inputs())?;
        self.engine.check()?;
        self.look.check(self.layout.is_some())?;
        let mut dataset = open(&self.file)?;
        self.replacements.apply(&mut dataset, self.step)?;
        let field = field(&dataset, self.step)?;
        let shown = self.replacements.title(&dataset.title);
        let plate = Plate { field: &field, title: &dataset.title, shown };
        match self.layout {
            None => self.one(&plate, out),
            Some(layout) => self.panels(&plate, layout, out),
        }
    }

    /// Draws one quantity.
    fn one(&self, plate: &Plate<'_>, out: &mut Output) -> anyhow::Result<()> {
        let field = plate.field;
        let given = self.quantity.as_deref().unwrap_or(subject::default(field));
        let subject = Subject::new(field, given)?;
        let labels = self.look.worded(subject.labels(plate.shown.clone(), field));
        let design = self.look.design(self.window.aspect(field));
        let room =
            if self.look.figure { plot_area(&labels.title, &design)? } else { self.look.size() };
        let view = self.view(field, room)?;
        let style = self.colors.style(&subject.quantity)?;
        let job = Job { field, view: &view, quantity: &subject.quantity, style: &style };
        let drawn = self.engine.draw(job)?;
        drawn.warn(&subject.name);
        let Drawn { picture, by, is_finite, .. } = drawn;
        let layers = self.layers(&view, field);
        let page = if self.look.figure {
            let panel = Panel { picture: &picture, layers, labels, cracks: &field.step.cracks };
            figure(panel, &design)?
        } else {
            bare(&picture, layers)
        };
        let mut texts = picture.description(plate.title, &self.file_name(), &subject.name);
        texts.push(("ppum:backend".to_owned(), by.clone()));
        texts.extend(subject.note().into_iter().chain(self.replacements.notes()));
        let [columns, rows] = page.size;
        let (name, colors) = (&subject.name, colours(&picture, is_finite));
        let told = format!("{name}, {columns}x{rows} pixels, {colors}, {by}");
        file::save(&self.output, &page, self.look.given_dpi(), &texts, &told, out)
    }

    /// The files that are read.
    fn inputs(&self) -> impl Iterator<Item = &Path> {
        let colormap = self.colors.colormap.as_deref().map(Path::new);
        let formula = self.quantity.as_deref().and_then(given::file);
        let files = [self.file.as_path()].into_iter().chain(colormap);
        files.chain(formula).chain(self.replacements.files())
    }

    /// The name of the dataset in the picture.
    fn file_name(&self) -> String {
        match self.file.file_name() {
            Some(name) if !is_standard(&self.file) => name.to_string_lossy().into_owned(),
            _ => standard::name(&self.file),
        }
    }

    /// The view on so many pixels, or less if the domain has another shape.
    fn view(&self, field: &Field<'_>, pixels: [u32; 2]) -> anyhow::Result<View> {
        // A figure centres what it is given; a bare picture has the size that was asked for.
        let is_figure = self.look.figure || self.layout.is_some();
        let may_shrink = is_figure || self.look.given_size().is_none();
        let view = self.window.view(field, Frame { pixels, may_shrink })?;
        ensure!(
            view.rect().overlaps(&field.domain.bounds),
            "the view shows nothing of the domain; `ppum info` says where that is"
        );
        Ok(view)
    }

    /// What is drawn over the colours.
    fn layers(&self, view: &View, field: &Field<'_>) -> Vec<Item> {
        let mut layers = Vec::new();
        if self.overlay.contains(&Overlay::Patches) {
            layers.extend(overlay::cells(view, &field.step.partition));
        }
        if self.look.figure || self.layout.is_some() || self.overlay.contains(&Overlay::Cracks) {
            layers.extend(overlay::rims(view, &field.domain.holes));
            layers.extend(overlay::cracks(view, &field.step.cracks));
        }
        layers
    }
}

/// The meaning of the colours.
fn colours(picture: &Picture, is_finite: bool) -> String {
    let norm = &picture.normalization;
    match picture.one_value {
        _ if !is_finite => "no finite values".into(),
        Some(value) => format!("one value, {}", trimmed(value)),
        None => {
            let [from, to] = apart(norm.min(), norm.max());
            format!("colours from {from} to {to}")
        }
    }
}

impl Drawn {
    /// Tells that a quantity has no value at some pixels.
    fn warn(&self, name: &str) {
        if self.undefined[0] > 0 {
            tell(&format!("warning: {}", undefined::message(name, self.undefined, "pixels")));
        }
    }
}
