//! Milliseconds a frame on one thread: 1024 × 768, order 2, two components, linear weights, four
//! Westergaard functions on a quarter of the patches, von Mises stress. Processor time of a pool of
//! one thread, minimum over repetitions. Three arguments choose one row:
//! `cargo bench --bench frame -- 5 5 f64`.

#[path = "../tests/support/synthetic.rs"]
mod synthetic;

use std::hint::black_box;

use cpu_time::ThreadTime;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum::real::Scalar;
use ppum::vec2::{Vec2, vec2};
use ppum_render::picture::{Picture, Style};
use ppum_render::range::Range;
use ppum_render::raster::Sample;
use ppum_render::reference::reference;
use ppum_render::scatter::render;
use ppum_render::view::View;
use synthetic::{Recipe, dataset, domain};

/// A view that shows the domain but for a part of a cell, commensurate with none.
fn view() -> View {
    View::new(domain().center() + vec2(0.00123, -0.00171), 1.3297, [1024, 768]).expect("a view")
}

/// Least milliseconds of a frame.
fn time(mut frame: impl FnMut(), repetitions: usize) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..repetitions {
        let start = ThreadTime::now();
        frame();
        least = least.min(start.elapsed().as_secs_f64());
    }
    least * 1e3
}

fn frame<T: Scalar + Sample>(field: &Field) -> f64 {
    let draw = || {
        black_box(render::<T>(field, &view(), &Quantity::VonMises).expect("a stress"));
    };
    time(draw, 100)
}

/// Least milliseconds of mapping a frame to colours, which comes on top.
fn colors<T: Scalar + Sample>(field: &Field) -> f64 {
    let raster = render::<T>(field, &view(), &Quantity::VonMises).expect("a stress");
    let style = Style { range: Range::Fixed(0.0, 5.0), ..Style::default() };
    let paint = || {
        black_box(Picture::bare(&raster, &view(), &style).expect("a range"));
    };
    time(paint, 50)
}

fn row(name: &str, dataset: &Dataset) -> [f64; 2] {
    let field = Field::new(dataset, 0).expect("a field");
    let patches = field.step.partition.len();
    let enriched = (0..patches).filter(|&i| field.data.blocks(i).len() > 1).count();
    let times = [frame::<f64>(&field), frame::<f32>(&field)];
    println!("{name:10} {patches:6} {enriched:6} {:8.2} {:8.2}", times[0], times[1]);
    times
}

/// One row only, many times: for profilers.
fn single(arguments: &[String]) {
    let number = |k: usize| arguments[k].parse().expect("a number");
    let dataset = dataset(&recipe(number(0), number(1)));
    let field = Field::new(&dataset, 0).expect("a field");
    let least = if arguments[2] == "f32" { frame::<f32>(&field) } else { frame::<f64>(&field) };
    println!("{arguments:?} {least:.2} ms");
}

fn main() {
    let arguments: Vec<_> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    if arguments.len() == 3 {
        return pool.install(|| single(&arguments));
    }
    pool.install(|| {
        println!("cover     patches   tips   f64 ms   f32 ms");
        let mut uniform = Vec::new();
        for level in 0..6 {
            uniform.push(row("uniform", &dataset(&recipe(level, level))));
        }
        for (level, tip_level) in [(1, 8), (2, 12), (3, 12), (4, 12)] {
            row("graded", &dataset(&recipe(level, tip_level)));
        }
        for level in [0, 3, 5] {
            let recipe = Recipe { formulas: true, ..recipe(level, level) };
            let [wide, narrow] = row("formulas", &dataset(&recipe));
            let [native_wide, native_narrow] = uniform[usize::from(level)];
            println!("  over kernels: {:.2} {:.2}", wide / native_wide, narrow / native_narrow);
        }
        let ratio = |k: usize| {
            let times = uniform.iter().map(|row| row[k]);
            times.clone().fold(0.0, f64::max) / times.fold(f64::INFINITY, f64::min)
        };
        println!("largest / smallest, uniform: {:.2} {:.2}", ratio(0), ratio(1));
        let dataset = dataset(&recipe(3, 3));
        let field = Field::new(&dataset, 0).expect("a field");
        println!("colours: {:.2} {:.2}", colors::<f64>(&field), colors::<f32>(&field));
        let draw = || {
            black_box(reference(&field, &view(), &Quantity::VonMises).expect("a stress"));
        };
        println!("scalar reference, 1024 patches: {:.0} ms", time(draw, 1));
    });
}

/// 16 · 4^level cells, a quarter of them enriched; if more are at the tips, a quarter of the area.
fn recipe(level: u8, tip_level: u8) -> Recipe {
    let (jumps, crack) = (false, STRAIGHT.as_slice());
    let recipe = Recipe { cells: [4, 4], level, tip_level, jumps, crack, ..Recipe::default() };
    if level < tip_level {
        return Recipe { zone: 0.2303, ..recipe };
    }
    let centers = dataset(&recipe).steps.swap_remove(0).partition.center;
    let mut distances: Vec<_> = centers.into_iter().map(distance_to_tips).collect();
    distances.sort_by(f64::total_cmp);
    Recipe { zone: distances[distances.len() / 4], ..recipe }
}

fn distance_to_tips(p: Vec2) -> f64 {
    let [a, b] = STRAIGHT.map(|tip| (p - tip).length());
    a.min(b)
}

const STRAIGHT: [Vec2; 2] = [vec2(0.5713, 0.1531), vec2(1.1831, 0.2473)];
