//! Times frames of gathering: processor and wall milliseconds of pictures of von Mises' stress, with what it
//! takes to upload and to compile.
//!
//! ```text
//! cargo run --release -p ppum-bench --example frames -- 2 6 7 10 3:10 4:14
//! ```
//!
//! A cover is a level of halving, with another one at the tips after a colon. Covers take turns, and every frame has
//! a view of its own, as in `ppum bench renderer`.

use std::time::{Duration, Instant};

use cpu_time::ProcessTime;
use ppum::crack::CrackEnd;
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum::vec2::{Rect, vec2};
use ppum_gpu::{Choice, Colors, Method, Program, Renderer, Shading};
use ppum_render::picture::Style;
use ppum_render::range::Range;
use ppum_render::raster::Raster;
use ppum_render::view::View;
use ppum_testkit::synthetic::{Recipe, crack};

type Failure = Box<dyn std::error::Error>;

/// Frames of each cover that are counted.
const FRAMES: u32 = 15;

/// The plate, not centred at the crack.
const DOMAIN: Rect = Rect { min: vec2(-0.6535, -0.4823), max: vec2(-0.6535 + 4.0 / 3.0, 0.5177) };

/// Around both tips these patches cover a quarter of the plate.
const ZONE: f64 = 0.23;

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let covers = if arguments.is_empty() {
        ["2", "6", "7", "3:10", "4:14"].map(String::from).to_vec()
    } else {
        arguments
    };
    let recipes = covers.iter().map(|cover| recipe(cover)).collect::<Result<Vec<_>, _>>()?;
    let datasets: Vec<_> = recipes.iter().map(Recipe::dataset).collect();
    let fields = datasets.iter().map(|dataset| Field::new(dataset, 0));
    let fields = fields.collect::<Result<Vec<_>, _>>()?;
    let mut renderer = Renderer::open(Choice::Any)?;
    let mut subjects = Vec::new();
    for (cover, field) in covers.iter().zip(&fields) {
        subjects.push(Subject::new(&mut renderer, cover, field)?);
    }
    for frame in 0..=FRAMES {
        for subject in &mut subjects {
            subject.draw(&mut renderer, frame)?;
        }
    }
    subjects.iter_mut().for_each(Subject::print);
    Ok(())
}

/// The cover of an argument.
fn recipe(cover: &str) -> Result<Recipe, Failure> {
    let (level, tip_level) = cover.split_once(':').unwrap_or((cover, "0"));
    let cracks = vec![crack(&[[-0.2, 0.0], [0.2, 0.0]], [CrackEnd::Tip; 2])];
    let (level, tip_level) = (level.parse()?, tip_level.parse()?);
    Ok(Recipe {
        domain: DOMAIN,
        cells: [1, 1],
        level,
        tip_level,
        zone: ZONE,
        cracks,
        ..Recipe::default()
    })
}

/// A cover on the card, with the times of its frames, processor and wall.
struct Subject<'f> {
    cover: String,
    field: &'f Field<'f>,
    program: Program<'f, Colors>,
    upload: Duration,
    compile: Duration,
    frames: [Vec<Duration>; 2],
}

impl<'f> Subject<'f> {
    fn new(renderer: &mut Renderer, cover: &str, field: &'f Field<'f>) -> Result<Self, Failure> {
        let start = Instant::now();
        let scene = renderer.upload(field)?;
        renderer.wait()?;
        let upload = start.elapsed();
        let start = Instant::now();
        let colors = Colors { quantity: Quantity::VonMises, shading: shading()? };
        let program = renderer.compile(&scene, colors, Method::Gather)?;
        let compile = start.elapsed();
        Ok(Self {
            cover: cover.to_owned(),
            field,
            program,
            upload,
            compile,
            frames: Default::default(),
        })
    }

    /// Draws a frame; the first one does not count.
    fn draw(&mut self, renderer: &mut Renderer, frame: u32) -> Result<(), Failure> {
        let view = view(frame)?;
        let (processor, wall) = (ProcessTime::now(), Instant::now());
        let drawn = renderer.draw(&mut self.program, &view)?;
        renderer.wait()?;
        let times = [processor.elapsed(), wall.elapsed()];
        drop(drawn);
        if frame > 0 {
            self.frames.iter_mut().zip(times).for_each(|(all, time)| all.push(time));
        } else {
            eprintln!("{}: first frame {:.0} ms", self.cover, ms(times[1]));
        }
        Ok(())
    }

    fn print(&mut self) {
        let [processor, wall] = &mut self.frames;
        let [(p, q), (v, w)] = [processor, wall].map(|times| least_and_median(times));
        println!(
            "{:>6} {:>8} patches: processor {p:6.1} {q:6.1}   wall {v:6.1} {w:6.1}   upload {:4.0}   compile {:4.0} ms",
            self.cover,
            self.field.step.partition.len(),
            ms(self.upload),
            ms(self.compile),
        );
    }
}

fn least_and_median(times: &mut [Duration]) -> (f64, f64) {
    times.sort();
    (ms(times[0]), ms(times[times.len() / 2]))
}

fn ms(time: Duration) -> f64 {
    1e3 * time.as_secs_f64()
}

/// All of the plate but for a part of a cell.
fn view(frame: u32) -> Result<View, Failure> {
    let part = |ratio: f64| 0.004 * ((f64::from(frame) * ratio).fract() - 0.5);
    let center = DOMAIN.center() + vec2(part(0.618_033_988_75), part(0.754_877_666_25));
    Ok(View::new(center, 0.9973 * DOMAIN.size().x, [1024, 768])?)
}

fn shading() -> Result<Shading, Failure> {
    let Style { colormap, scale, undefined, .. } = Style::default();
    let nothing = Raster::<f32>::new([0, 0], Vec::new());
    let normalization =
        Range::Fixed(0.0, 4.0).normalization(scale, colormap.diverging, &nothing)?;
    Ok(Shading { normalization, colormap, undefined })
}
