//! Draws a sheet of odd figures, to be looked at:
//!
//!     cargo run -p ppum-bench --example odd_figures -- FOLDER

use std::error::Error;
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use ppum::crack::{Crack, CrackEnd};
use ppum::domain::{Domain, Hole};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_figure::canvas::Canvas;
use ppum_figure::figure::{
    BarPlace, FigureStyle, Labels, Panel, PanelGrid, Theme, TickChoice, figure, panel_area, panels,
    plot_area,
};
use ppum_figure::overlay;
use ppum_render::colormap::Colormap;
use ppum_render::picture::{ColoredRaster, Style};
use ppum_render::png;
use ppum_render::range::RangeChoice;
use ppum_render::raster::Raster;
use ppum_render::scale::Scale;
use ppum_render::view::View;

type Done<T = ()> = Result<T, Box<dyn Error>>;

/// A plate, what is seen on it, and how.
struct Case {
    name: &'static str,
    half: Vec2,
    value: fn(Vec2) -> f64,
    title: &'static str,
    design: FigureStyle,
    style: Style,
}

/// r^(−1/2) cos(θ/2) around a tip at the origin, which has both signs.
fn tip(p: Vec2) -> f64 {
    let angle = p.y.atan2(p.x);
    p.length().powf(-0.5) * (1.5 * angle).cos()
}

fn wave(p: Vec2) -> f64 {
    (9.0 * p.x).sin() * (7.0 * p.y).cos()
}

impl Case {
    fn new(name: &'static str, half: Vec2, value: fn(Vec2) -> f64) -> Self {
        let mut design = FigureStyle::pixels([1024, 768]);
        design.bar = BarPlace::fitting(half.x / half.y);
        Self { name, half, value, title: "A plate", design, style: Style::default() }
    }

    fn map(mut self, name: &str) -> Done<Self> {
        self.style.colormap = Colormap::named(name)?;
        Ok(self)
    }

    fn titled(self, title: &'static str) -> Self {
        Self { title, ..self }
    }

    fn designed(mut self, change: impl FnOnce(&mut FigureStyle)) -> Self {
        change(&mut self.design);
        self
    }

    fn labels(&self) -> Labels {
        let word = str::to_owned;
        Labels {
            title: word(self.title),
            quantity: word("σ_{yy}"),
            unit: word("MPa"),
            length_unit: word("mm"),
            ..Labels::default()
        }
    }

    /// The plate has a hole in its upper right; above the line y = −x/2 − half the width nothing
    /// is defined.
    fn picture(&self, room: [u32; 2]) -> Done<ColoredRaster> {
        let domain = self.domain();
        let view = View::hug(domain.bounds, room)?;
        let raster = Raster::from_fn(view.pixels, |i, j| {
            let p = view.offset(i, j);
            if domain.contains(view.center + p) { (self.value)(p) } else { f64::NAN }
        });
        let mut picture = ColoredRaster::bare(&raster, &view, &self.style)?;
        picture.mark_undefined(&raster.undefined(&domain, &view), None);
        Ok(picture)
    }

    fn domain(&self) -> Domain {
        let radius = 0.25 * self.half.x.min(self.half.y);
        let hole = Hole::Circle { center: self.half * 0.5, radius };
        Domain { bounds: Rect::around(Vec2::ZERO, self.half), holes: vec![hole] }
    }

    fn cracks(&self) -> [Crack; 1] {
        let points = vec![vec2(-self.half.x, 0.0), Vec2::ZERO];
        [Crack::polyline(points, [CrackEnd::Mouth, CrackEnd::Tip])]
    }

    fn panel<'a>(&self, picture: &'a ColoredRaster, cracks: &'a [Crack]) -> Panel<'a> {
        let mut layers =
            overlay::rims(&picture.view, self.design.scale(), &self.domain().holes, [None; 2]);
        layers.extend(overlay::cracks(&picture.view, self.design.scale(), cracks));
        Panel { picture, layers, legend: vec![], labels: self.labels(), cracks, bar_of: None }
    }

    fn draw(&self) -> Done<Canvas> {
        let picture = self.picture(plot_area(self.title, &self.design)?)?;
        Ok(figure(self.panel(&picture, &self.cracks()), &self.design)?)
    }
}

fn cases() -> Done<Vec<Case>> {
    let square = vec2(1.0, 1.0);
    let long = "A plate under tension with an edge crack and a hole, whose title is much longer than the figure is \
                wide, as titles of plates that were made by programs often are, σ_{xy} and all";
    let range = |mut case: Case, range: RangeChoice| {
        case.style.range = range;
        case
    };
    let mut log = Case::new("log", square, |p| p.length().powf(-1.5));
    log.style.scale = Scale::Log;
    let mut contrast = range(Case::new("contrast", square, tip), RangeChoice::Fixed(-1.0, 1.0));
    contrast.style.colormap = Colormap::named("vik")?.contrasting();
    let mut bands =
        range(Case::new("bands", square, wave), RangeChoice::Fixed(-1.0, 1.0)).map("roma")?;
    bands.style.colormap = bands.style.colormap.banded(8);
    let undefined = |p: Vec2| if p.y + 0.5 * p.x > 0.3 { f64::NAN } else { p.x };
    let mut paper = Case::new("paper", square, wave).map("batlow")?;
    paper.design = FigureStyle::inches([6.5, 4.5], 300.0);
    let mut column = Case::new("column", square, tip).map("coolwarm")?;
    column.design = FigureStyle::inches([3.4, 2.8], 300.0);
    column.design.font_size = 8.0;
    let mut huge = Case::new("huge", vec2(1.2, 1.0), tip);
    huge.design = FigureStyle::pixels([8000, 6000]);
    let mut small = Case::new("small", square, tip);
    small.design = FigureStyle::pixels([300, 200]);
    let angle: fn(Vec2) -> f64 = |p| 0.5 * p.y.atan2(p.x);
    let angle = range(Case::new("angle", square, angle), RangeChoice::Fixed(-FRAC_PI_2, FRAC_PI_2));
    let list = TickChoice::At(vec![-2.0, 0.0, 0.5, 3.0]);
    Ok(vec![
        Case::new("long", vec2(25.0, 0.5), |p| (0.5 * p.x).sin() + p.y).titled(long),
        Case::new("long-right", vec2(25.0, 0.5), |p| (0.5 * p.x).sin() + p.y)
            .designed(|design| design.bar = BarPlace::Right),
        Case::new("high", vec2(0.02, 1.0), |p| p.y).titled(long),
        Case::new("high-bottom", vec2(0.02, 1.0), |p| 1e-7 * p.y)
            .designed(|design| design.bar = BarPlace::Bottom),
        Case::new("nothing", square, |_| f64::NAN),
        Case::new("undefined", square, undefined).map("cividis")?,
        Case::new("one-value", square, |_| 3.7e-5),
        Case::new("negative", square, |p| -1e9 - 1e8 * p.x),
        Case::new("title", square, tip)
            .titled("板の応力 – Напряжение – تنش – σ_{yy} in der Platte"),
        Case::new("long-title", square, tip).titled(long),
        range(Case::new("dark", square, tip), RangeChoice::Fixed(-1.0, 2.0))
            .designed(|design| design.theme = Theme::Dark),
        Case::new("transparent", square, tip).designed(|design| design.transparent = true),
        Case::new("no-bar", square, tip).designed(|design| design.bar = BarPlace::None),
        range(Case::new("ticks", square, tip), RangeChoice::Fixed(-2.0, 3.0)).designed(|design| {
            design.bar_ticks = list;
            design.x_ticks = TickChoice::Count(2);
            design.y_ticks = TickChoice::At(vec![]);
        }),
        Case::new("no-title", square, tip).titled(""),
        log,
        contrast,
        bands,
        paper,
        column,
        huge,
        small,
        angle.map("twilight")?,
    ])
}

/// Four quantities, with a bar each or one for all.
fn four(shared_bar: bool, size: [u32; 2], bar: BarPlace) -> Done<Canvas> {
    let grid = PanelGrid { shared_bar, ..PanelGrid::new([2, 2]) };
    let values: [fn(Vec2) -> f64; 4] =
        [tip, wave, |p| p.x, |p| if p.x > 0.9 { f64::NAN } else { p.y }];
    let captions = [
        "(a) von Mises stress",
        "(b) u_{x}, a caption that is so long that it takes more than the one line that captions have",
        "(c) u_{y}",
        "",
    ];
    let design = FigureStyle { bar, ..FigureStyle::pixels(size) };
    let room = panel_area("Four panels", &captions, grid, &design)?;
    let range = if shared_bar { RangeChoice::Fixed(-1.0, 1.0) } else { RangeChoice::Auto };
    let cases = values.into_iter().zip(captions).map(|(value, caption)| {
        let mut case = Case::new("panel", vec2(1.3, 1.0), value).titled(caption);
        case.style.range = range;
        case
    });
    let cases: Vec<Case> = cases.collect();
    let pictures = cases.iter().map(|case| case.picture(room)).collect::<Done<Vec<_>>>()?;
    let cracks = cases[0].cracks();
    let all: Vec<Panel<'_>> =
        cases.iter().zip(&pictures).map(|(case, picture)| case.panel(picture, &cracks)).collect();
    Ok(panels("Four panels", &all, grid, &design)?)
}

fn write(folder: &Path, name: &str, page: &Canvas, dpi: f64) -> Done {
    let texts = [("Title".to_owned(), name.to_owned())];
    std::fs::write(
        folder.join(format!("{name}.png")),
        png::encode_at(&page.image(), Some(dpi), &texts)?,
    )?;
    std::fs::write(folder.join(format!("{name}.svg")), page.svg(dpi, &texts))?;
    std::fs::write(folder.join(format!("{name}.pdf")), page.pdf(dpi, &texts))?;
    Ok(())
}

fn main() -> Done {
    let folder = std::env::args().nth(1).ok_or("give a folder")?;
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder)?;
    for case in cases()? {
        let start = std::time::Instant::now();
        write(folder, case.name, &case.draw()?, case.design.dpi)?;
        println!("{} {:.1} s", case.name, start.elapsed().as_secs_f64());
    }
    write(folder, "four", &four(false, [1200, 900], BarPlace::Right)?, 96.0)?;
    write(folder, "four-bottom", &four(false, [1200, 1100], BarPlace::Bottom)?, 96.0)?;
    write(folder, "four-shared", &four(true, [1200, 900], BarPlace::Right)?, 96.0)?;
    write(folder, "four-shared-bottom", &four(true, [1200, 900], BarPlace::Bottom)?, 96.0)?;
    let one = Case::new("one", vec2(1.0, 1.0), |_| 2.0);
    let picture = one.picture([1, 1])?;
    write(folder, "one-pixel", &figure(one.panel(&picture, &[]), &one.design)?, 96.0)
}
