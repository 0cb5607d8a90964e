//! Frames by formula beside frames by kernels, one thread, processor milliseconds.
//!
//!     cargo run --release -p ppum-bench --example formulas
//!
//! Each line is a pair of datasets or quantities that are the same except for the kernel, which the
//! second finds no place for. Frames of all take turns, each with a view of its own; least and
//! median are told, and the ratio of the two within the run.

use cpu_time::ThreadTime;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::formula::Scope;
use ppum::function::FunctionKind;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::vec2::vec2;
use ppum::weight::WeightFunction;
use ppum_render::raster::RasterValue;
use ppum_render::scatter::render;
use ppum_render::view::View;
use ppum_testkit::synthetic::Recipe;

const FRAMES: u32 = 12;

type Failure = Box<dyn std::error::Error + Send + Sync>;

/// Least and median processor milliseconds of frames.
type Times = [f64; 2];

fn main() -> Result<(), Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    pool.install(|| {
        for level in [1, 5] {
            compare::<f64>(level, "f64")?;
            compare::<f32>(level, "f32")?;
        }
        Ok(())
    })
}

fn compare<T: RasterValue>(level: u8, kind: &str) -> Result<(), Failure> {
    let scope = Scope::new(&["t"])?;
    let cubic = "if(t < 1/2, 1 - 6*t^2 + 6*t^3, 2*(1 - t)^3)";
    let weight = |weight| Recipe { weight, ..recipe(level) }.dataset();
    let pairs = [
        (
            "von Mises",
            [recipe(level).dataset(), recipe(level).dataset()],
            ["von-mises", "von_mises"],
        ),
        ("s1", [recipe(level).dataset(), recipe(level).dataset()], ["s1", "1*s1"]),
        (
            "cubic weight",
            [weight(WeightFunction::Cubic), weight(WeightFunction::formula(cubic, &scope)?)],
            ["von-mises"; 2],
        ),
        (
            "bump as weight",
            [
                weight(WeightFunction::Cubic),
                weight(WeightFunction::from_library("bump").ok_or("")?),
            ],
            ["von-mises"; 2],
        ),
        ("tip functions", [recipe(level).dataset(), by_formula(level)], ["von-mises"; 2]),
    ];
    for (what, [kernel, formula], [by_kernel, by_formula]) in pairs {
        let (kernel, formula) = (Field::new(&kernel, 0)?, Field::new(&formula, 0)?);
        let quantities =
            [Quantity::parse(by_kernel, &kernel)?, Quantity::parse(by_formula, &formula)?];
        let [a, b] = frames::<T>([&kernel, &formula], &quantities)?;
        let patches = kernel.step.partition.len();
        println!(
            "{kind} {patches:5} patches  {what:15} {:7.2} {:7.2}   {:7.2} {:7.2}   {:5.2}",
            a[0],
            a[1],
            b[0],
            b[1],
            b[0] / a[0]
        );
    }
    Ok(())
}

/// A quarter of the plate has the tips' functions.
fn recipe(level: u8) -> Recipe {
    Recipe { cells: [2, 2], level, tip_level: level, zone: 0.25, ..Recipe::default() }
}

/// The tips' functions as texts that are no kernel's.
fn by_formula(level: u8) -> Dataset {
    let mut dataset = recipe(level).dataset();
    for function in &mut dataset.steps[0].functions {
        if let FunctionKind::Formula { text, .. } = &mut function.kind {
            *text = format!("1*({text})");
        }
    }
    dataset
}

fn frames<T: RasterValue>(
    fields: [&Field<'_>; 2],
    quantities: &[Quantity; 2],
) -> Result<[Times; 2], Failure> {
    let mut times = [Vec::new(), Vec::new()];
    let center = fields[0].domain.bounds.center();
    for frame in 0..FRAMES {
        let shift = vec2(0.0123, -0.0171) * (f64::from(frame) * 0.37 + 1.0);
        let view =
            View::new(center + shift, 4.0 / 3.0, [1024, 768]).map_err(|e| format!("{e:?}"))?;
        for ((field, quantity), times) in fields.iter().zip(quantities).zip(&mut times) {
            let start = ThreadTime::now();
            render::<T>(field, &view, quantity, unwatched())?;
            times.push(start.elapsed().as_secs_f64() * 1e3);
        }
    }
    Ok(times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        [times[0], times[times.len() / 2]]
    }))
}
