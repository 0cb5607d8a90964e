//! `ppum render`: a picture of a quantity.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use ppum::crack::Crack;
use ppum::dataset::Dataset;
use ppum::text::{apart, trimmed};
use ppum_figure::canvas::{Canvas, Item};
use ppum_figure::figure::{Labels, bare, figure, plot_area};
use ppum_render::deform::DeformedView;
use ppum_render::picture::Picture;
use ppum_render::png;

use crate::arguments::size;
use crate::backend::{Drawn, Engine, Job};
use crate::deformed::{Deformed, Moved, draw};
use crate::drawing::{Colours, Subject, labels};
use crate::output::{Output, tell};
use crate::overlays::Overlays;
use crate::standard::is_standard;
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
    /// Picture to write, - for standard output
    #[arg(short, long, value_name = "OUT.png")]
    output: PathBuf,
    /// Size of the picture in pixels [default: 1024x768; a bare picture of the whole domain takes its
    /// shape]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<[u32; 2]>,
    #[command(flatten)]
    window: Window,
    #[command(flatten)]
    colours: Colours,
    #[command(flatten)]
    overlays: Overlays,
    #[command(flatten)]
    deformed: Deformed,
    /// Add axes, a colour bar, a title and the cracks
    #[arg(long)]
    figure: bool,
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
  ppum render plate.h5 -o part.png --view -0.2,-0.1,0.2,0.1 --overlay cracks,patches
  ppum render plate.h5 -o moved.png --deformed auto --outline --figure
  ppum render plate.h5 -o gpu.png --backend gpu
  ppum render plate.h5 -o deep.png --center 0.5,0 --width 1e-12 --range 0,1e7";

const DEFAULT_SIZE: [u32; 2] = [1024, 768];

impl Args {
    pub(crate) fn run(&self, out: &mut Output) -> anyhow::Result<()> {
        target::check(&self.output, target::Kind::Picture, self.inputs())?;
        self.engine.check()?;
        let dataset = self.subject.open()?;
        let field = self.subject.field(&dataset)?;
        let (quantity, name) = self.subject.quantity(&field)?;
        let style = self.colours.style()?;
        let seen = self.deformed.view(&field, &self.window, self.frame()?)?;
        let view = match &seen {
            Some(seen) => seen.view,
            None => self.window.seen(&field, self.frame()?)?,
        };
        let job = Job { field: &field, view: &view, quantity: &quantity, style: &style };
        let Plate { drawn, layers, cracks, moved } = match &seen {
            Some(seen) => self.deformed(seen, job)?,
            None => self.undeformed(job, &dataset)?,
        };
        let Drawn { picture, by, undefined, is_finite } = drawn;
        let title = self.subject.replacements.title(&dataset.title);
        let title = moved.as_ref().map_or(title.clone(), |moved| moved.title(&title));
        let labels = labels(title, &field, &quantity);
        let image = self.page(&picture, layers, &cracks, &labels)?.image();
        let mut texts = picture.description(&dataset.title, &self.subject.file_name(), &name);
        texts.push(("ppum:backend".to_owned(), by.clone()));
        texts.extend(self.subject.notes(&quantity).chain(moved.as_ref().map(Moved::note)));
        let bytes = png::encode(&image, &texts).context("cannot encode the picture")?;
        let [columns, rows] = image.size;
        let how = moved.map_or(String::new(), |moved| format!(", {}", moved.told()));
        if undefined[0] > 0 {
            tell(&format!("warning: {}", undefined::message(&name, undefined, "pixels")));
        }
        let colours = colours(&picture, is_finite);
        self.write(&bytes, &format!("{name}{how}, {columns}x{rows} pixels, {colours}, {by}"), out)
    }

    /// Writes the file, and tells of it.
    fn write(&self, bytes: &[u8], told: &str, out: &mut Output) -> anyhow::Result<()> {
        if is_standard(&self.output) {
            out.exact().write_all(bytes)?;
            tell(&format!("wrote standard output: {told}"));
        } else {
            target::save(&self.output, |out| out.write_all(bytes))?;
            writeln!(out, "wrote {}: {told}", self.output.display())?;
        }
        Ok(())
    }

    fn undeformed(&self, job: Job<'_>, dataset: &Dataset) -> anyhow::Result<Plate> {
        let layers = self.overlays.items(job.view, dataset, job.field, self.figure);
        let cracks = job.field.step.cracks.clone();
        Ok(Plate { drawn: self.engine.draw(job)?, layers, cracks, moved: None })
    }

    fn deformed(&self, seen: &DeformedView<'_>, job: Job<'_>) -> anyhow::Result<Plate> {
        let layers = self.overlays.deformed_items(seen, self.figure, self.deformed.outline)?;
        let (drawn, moved) = draw(seen, job, &self.engine)?;
        Ok(Plate { drawn, layers, cracks: seen.moved_cracks(), moved: Some(moved) })
    }

    /// The files that are read.
    fn inputs(&self) -> impl Iterator<Item = &Path> {
        self.subject.inputs().chain([self.colours.input()])
    }

    fn frame(&self) -> anyhow::Result<Frame> {
        let size = self.size.unwrap_or(DEFAULT_SIZE);
        Ok(Frame {
            pixels: if self.figure { plot_area(size)? } else { size },
            // A figure centres what it is given; a bare picture has the size that was asked for.
            may_shrink: self.figure || self.size.is_none(),
            margin: self.overlays.margin(),
        })
    }

    /// The picture with its overlays, as a figure if that is asked for.
    fn page(
        &self,
        picture: &Picture,
        layers: Vec<Item>,
        cracks: &[Crack],
        labels: &Labels,
    ) -> anyhow::Result<Canvas> {
        if !self.figure {
            return Ok(bare(picture, layers));
        }
        let size = self.size.unwrap_or(DEFAULT_SIZE);
        Ok(figure(picture, layers, labels, cracks, size)?)
    }
}

/// The plate as it was drawn.
struct Plate {
    drawn: Drawn,
    layers: Vec<Item>,
    /// Where they are seen.
    cracks: Vec<Crack>,
    /// How it was deformed.
    moved: Option<Moved>,
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
