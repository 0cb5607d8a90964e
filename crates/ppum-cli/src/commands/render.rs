//! `ppum render`: a picture of a quantity.

mod window;

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, ensure};
use clap::ValueEnum;
use ppum::field::Field;
use ppum::formula::one_line;
use ppum::quantity::Quantity;
use ppum::text::{apart, trimmed};
use ppum_render::colormap::{Colormap, LONGEST, NAMES};
use ppum_render::figure::{Labels, figure, plot_area};
use ppum_render::image::Image;
use ppum_render::overlay;
use ppum_render::picture::{Picture, Style};
use ppum_render::png;
use ppum_render::range::Range;
use ppum_render::scale::Scale;
use ppum_render::view::View;

use crate::arguments::size;
use crate::backend::Engine;
use crate::dataset::{field, open, quantity};
use crate::drawing::{Drawn, Job};
use crate::given;
use crate::output::{Output, tell};
use crate::replacements::Replacements;
use crate::standard::{self, is_standard};
use crate::target;
use crate::undefined;
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
    /// Picture to write, - for standard output
    #[arg(short, long, value_name = "OUT.png")]
    output: PathBuf,
    /// Quantity, see `ppum info`, or a formula of quantities, or @FILE with one [default: von-mises;
    /// for Poisson problems u]
    #[arg(short, long, value_name = "Q", allow_hyphen_values = true)]
    quantity: Option<String>,
    #[command(flatten)]
    replacements: Replacements,
    /// Size of the picture in pixels [default: 1024x768; a bare picture of the whole domain takes its
    /// shape]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<[u32; 2]>,
    #[command(flatten)]
    window: Window,
    #[arg(long, value_name = "NAME", default_value = "viridis", help = colormaps())]
    colormap: String,
    /// Values that the colours span; `auto` is robust against peaks at tips
    #[arg(long, value_name = "A,B|auto", default_value = "auto", allow_hyphen_values = true)]
    range: Range,
    /// How values spread over the colours: linear, log or symlog
    #[arg(long, default_value = "linear")]
    scale: Scale,
    /// What is drawn over the colours; a figure always shows the cracks
    #[arg(long, value_enum, value_delimiter = ',')]
    overlay: Vec<Overlay>,
    /// Add axes, a colour bar, a title and the cracks
    #[arg(long)]
    figure: bool,
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
  ppum render plate.h5 -o gpu.png --backend gpu
  ppum render plate.h5 -o deep.png --center 0.5,0 --width 1e-12 --range 0,1e7";

fn colormaps() -> String {
    format!(
        "Colour map: {}; reversed with _r; or a file, CSV or JSON, as ParaView, Plotly and others write it",
        NAMES.join(", ")
    )
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Overlay {
    /// Cracks and their tips
    Cracks,
    /// Borders of the cover's cells
    Patches,
}

const DEFAULT_SIZE: [u32; 2] = [1024, 768];

impl Args {
    pub(crate) fn run(&self, out: &mut Output) -> anyhow::Result<()> {
        target::check(&self.output, target::Kind::Picture, self.inputs())?;
        self.engine.check()?;
        let mut dataset = open(&self.file)?;
        self.replacements.apply(&mut dataset, self.step)?;
        let field = field(&dataset, self.step)?;
        let given = self.quantity.as_deref().unwrap_or(default_quantity(&field));
        let quantity = quantity(&field, given)?;
        let name = name(&quantity, given);
        let view = self.view(&field)?;
        let style = Style { scale: self.scale, range: self.range, ..style(&self.colormap)? };
        ensure!(
            view.rect().overlaps(&field.domain.bounds),
            "the view shows nothing of the domain; `ppum info` says where that is"
        );
        let job = Job { field: &field, view: &view, quantity: &quantity, style: &style };
        let Drawn { mut picture, by, undefined, is_finite } = self.engine.draw(job)?;
        let title = self.replacements.title(&dataset.title);
        let image = self.image(&mut picture, &field, &labels(title, &field, &quantity))?;
        let mut texts = picture.description(&dataset.title, &self.file_name(), &name);
        texts.push(("ppum:backend".to_owned(), by.clone()));
        texts.extend(notes(&quantity).into_iter().chain(self.replacements.notes()));
        let bytes = png::encode(&image, &texts).context("cannot encode the picture")?;
        let [columns, rows] = image.size;
        let target = self.output.display();
        let told = format!(
            "wrote {target}: {name}, {columns}x{rows} pixels, {}, {by}",
            colours(&picture, is_finite)
        );
        if undefined[0] > 0 {
            tell(&format!("warning: {}", undefined::message(&name, undefined, "pixels")));
        }
        if is_standard(&self.output) {
            out.exact().write_all(&bytes)?;
            tell(&told.replacen("wrote -", "wrote standard output", 1));
        } else {
            target::save(&self.output, |out| out.write_all(&bytes))?;
            writeln!(out, "{told}")?;
        }
        Ok(())
    }

    /// The files that are read.
    fn inputs(&self) -> impl Iterator<Item = &Path> {
        let files = [self.file.as_path(), Path::new(&self.colormap)];
        let formula = self.quantity.as_deref().and_then(given::file);
        files.into_iter().chain(formula).chain(self.replacements.files())
    }

    /// The name of the dataset in the picture.
    fn file_name(&self) -> String {
        match self.file.file_name() {
            Some(name) if !is_standard(&self.file) => name.to_string_lossy().into_owned(),
            _ => standard::name(&self.file),
        }
    }

    fn view(&self, field: &Field<'_>) -> anyhow::Result<View> {
        let size = self.size.unwrap_or(DEFAULT_SIZE);
        let frame = Frame {
            pixels: if self.figure { plot_area(size)? } else { size },
            // A figure centres what it is given; a bare picture has the size that was asked for.
            may_shrink: self.figure || self.size.is_none(),
        };
        self.window.view(field, frame)
    }

    /// The picture with its overlays, as a figure if that is asked for.
    fn image(
        &self,
        picture: &mut Picture,
        field: &Field<'_>,
        labels: &Labels,
    ) -> anyhow::Result<Image> {
        let view = picture.view;
        if self.overlay.contains(&Overlay::Patches) {
            overlay::patches(&mut picture.image, &view, &field.step.partition);
        }
        if self.figure || self.overlay.contains(&Overlay::Cracks) {
            overlay::rims(&mut picture.image, &view, &field.domain.holes);
        }
        if self.figure {
            let size = self.size.unwrap_or(DEFAULT_SIZE);
            return Ok(figure(picture, labels, &field.step.cracks, size)?);
        }
        if self.overlay.contains(&Overlay::Cracks) {
            overlay::cracks(&mut picture.image, &view, &field.step.cracks);
        }
        Ok(picture.image.clone())
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

fn default_quantity<'f>(field: &'f Field<'_>) -> &'f str {
    match field.equation.elastic() {
        Some(_) => "von-mises",
        None => &field.data.components[0],
    }
}

/// The map of a file, or the built-in one of that name. What is neither, but there, is read as a file too,
/// to say why it cannot be.
fn style(name: &str) -> anyhow::Result<Style> {
    let path = Path::new(name);
    match Style::named(name) {
        Ok(style) if !path.is_file() => return Ok(style),
        Err(error) if !path.exists() => return Err(error.into()),
        _ => {}
    }
    let text = ppum_file::text(path, LONGEST).with_context(|| format!("cannot read {name}"))?;
    Ok(Style { colormap: Colormap::from_text(name, &text)?, ..Style::default() })
}

/// The name of the quantity in messages and in the picture's description.
fn name(quantity: &Quantity, given: &str) -> String {
    match quantity {
        Quantity::Formula(formula) => formula.label(),
        _ => given.to_owned(),
    }
}

/// The formula of a quantity, as a note in the picture.
fn notes(quantity: &Quantity) -> Option<(String, String)> {
    let Quantity::Formula(formula) = quantity else { return None };
    Some(("ppum:formula".to_owned(), one_line(formula.formula().text())))
}

fn labels(title: String, field: &Field<'_>, quantity: &Quantity) -> Labels {
    Labels {
        title,
        quantity: quantity.symbol(&field.data.components),
        unit: quantity.unit(field).to_owned(),
        length_unit: String::new(),
    }
}
