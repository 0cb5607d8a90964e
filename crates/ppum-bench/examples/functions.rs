//! Elementary functions and tables on vectors beside the library's, one thread, nanoseconds
//! a point.
//!
//!     cargo run --release -p ppum-bench --example functions
//!
//! A block is run again and again; the least of many rounds is told, all ways taking turns.

use std::hint::black_box;
use std::sync::Arc;

use cpu_time::ThreadTime;
use ppum_formula::real::LaneNumber;
use ppum_formula::{Block, BlockScratch, Formula, FormulaJets, Scope, Table};

/// The library's function for a formula.
type Library = fn(f64, f64) -> f64;

/// Formulas, arguments from where to where, and what the library has for them.
const FUNCTIONS: [(&str, [f64; 2], Library); 20] = [
    ("x*y + x", [-1.0, 1.0], |x, y| x * y + x),
    ("sqrt(x)", [0.0, 9.0], |x, _| x.sqrt()),
    ("cbrt(x)", [-9.0, 9.0], |x, _| x.cbrt()),
    ("exp(x)", [-20.0, 20.0], |x, _| x.exp()),
    ("log(x)", [0.01, 90.0], |x, _| x.ln()),
    ("log10(x)", [0.01, 90.0], |x, _| x.log10()),
    ("sin(x)", [-9.0, 9.0], |x, _| x.sin()),
    ("cos(x)", [-9.0, 9.0], |x, _| x.cos()),
    ("tan(x)", [-9.0, 9.0], |x, _| x.tan()),
    ("asin(x)", [-1.0, 1.0], |x, _| x.asin()),
    ("acos(x)", [-1.0, 1.0], |x, _| x.acos()),
    ("atan(x)", [-9.0, 9.0], |x, _| x.atan()),
    ("sinh(x)", [-9.0, 9.0], |x, _| x.sinh()),
    ("cosh(x)", [-9.0, 9.0], |x, _| x.cosh()),
    ("tanh(x)", [-9.0, 9.0], |x, _| x.tanh()),
    ("x^y", [0.1, 9.0], f64::powf),
    ("atan2(x, y)", [-9.0, 9.0], f64::atan2),
    ("hypot(x, y)", [-9.0, 9.0], f64::hypot),
    ("table(curve, x)", [-1.0, 21.0], |x, _| x),
    ("table(surface, x, y)", [-1.0, 21.0], |x, _| x),
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("{:22} {:>7} {:>7} {:>7} {:>7}", "ns a point", "library", "one", "f64", "f32");
    for (text, [from, to], library) in FUNCTIONS {
        let formula = Formula::parse(text, &scope()?)?;
        let jets = FormulaJets::new(&[&formula], 0)?;
        let points: Vec<[f64; 2]> = (0..128)
            .map(|k| [part(k, 0.618), part(k, 0.755)].map(|t| from + t * (to - from)))
            .collect();
        let (mut double, mut single) =
            (BlockScratch::<f64>::default(), BlockScratch::<f32>::default());
        let (mut double, mut single) = (jets.block(&mut double), jets.block(&mut single));
        fill(&mut double, &points);
        fill(&mut single, &points);
        let (mut scratch, mut out) = (Vec::new(), [0.0]);
        let mut least = [f64::INFINITY; 4];
        for _ in 0..60 {
            let times = [
                time(|| {
                    points.iter().for_each(|&[x, y]| {
                        black_box(library(black_box(x), black_box(y)));
                    })
                }) / points.len() as f64,
                time(|| {
                    points.iter().for_each(|point| {
                        jets.evaluate(point, &mut scratch, &mut out);
                        black_box(out);
                    })
                }) / points.len() as f64,
                time(|| double.run()) / Block::<f64>::POINTS as f64,
                time(|| single.run()) / Block::<f32>::POINTS as f64,
            ];
            least.iter_mut().zip(times).for_each(|(least, time)| *least = least.min(time));
        }
        let [library, one, double, single] = least;
        println!("{text:22} {library:7.2} {one:7.2} {double:7.2} {single:7.2}");
    }
    Ok(())
}

/// A number in [0, 1), no two alike.
fn part(k: usize, step: f64) -> f64 {
    (k as f64 * step).fract()
}

fn fill<T: LaneNumber>(block: &mut Block<'_, T>, points: &[[f64; 2]]) {
    for input in 0..2 {
        let values = points.iter().map(|point| T::from_f64(point[input]));
        block.input(input).iter_mut().zip(values).for_each(|(to, value)| *to = value);
    }
}

/// Nanoseconds of a call.
fn time(mut work: impl FnMut()) -> f64 {
    const CALLS: u32 = 200;
    let start = ThreadTime::now();
    (0..CALLS).for_each(|_| work());
    start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS)
}

fn scope() -> Result<Scope, Box<dyn std::error::Error>> {
    let knots: Vec<f64> = (0..21).map(f64::from).collect();
    let bump = |x: f64| (0.3 * x).sin();
    let values: Vec<f64> = knots.iter().map(|&x| bump(x)).collect();
    let product = knots.iter().flat_map(|&y| knots.iter().map(move |&x| bump(x) * bump(y)));
    let curve = Table::curve("curve", knots.clone(), values)?;
    let surface = Table::surface("surface", knots.clone(), knots.clone(), product.collect())?;
    Ok(Scope::cartesian().with_table(Arc::new(curve))?.with_table(Arc::new(surface))?)
}
