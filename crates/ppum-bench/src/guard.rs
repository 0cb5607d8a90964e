//! Guards of the wide vectors: what they gain over the narrowest ones, kernel by kernel, as ratios
//! within one run.
//!
//! A function in a kernel that is not inlined is compiled for the instruction set that every
//! processor of the architecture has. No value changes, but what runs there takes some 27 times as
//! long. The narrowest vectors need none of the wider instructions and stay as fast as they are, so
//! the ratio of both falls from above 1 to far below it. It is the least processor time of some
//! repetitions that counts, of both in turns: a busy machine lengthens both. The calls that kernels
//! make are also counted in the object code, where nothing depends on the machine.

use std::hint::black_box;

use anyhow::ensure;
use cpu_time::ThreadTime;
use ppum::crack::Side;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::formula::{Block, BlockScratch, Formula, FormulaJets, Scope};
use ppum::function::WESTERGAARD;
use ppum::jet::Jet;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::real::{LaneJob, LaneNumber, Real, instructions, narrowed};
use ppum_render::picture::ColoredRaster;
use ppum_render::raster::{Raster, RasterValue};
use ppum_render::scatter::render;
use ppum_render::view::View;
use serde::Serialize;

use crate::calls::{Calls, table};
use crate::frames::{moved, style};
use crate::synthetic::{CrackRecipe, DOMAIN};
use crate::table::ReportTable;

/// Repetitions, of which the fastest counts: enough that each has its quiet moment.
const REPETITIONS: usize = 15;

/// Pixels of the frames: a few milliseconds of work.
const PIXELS: [u32; 2] = [384, 288];

/// Least ratio of kernels that are arithmetic. Sound ones have 1.7 to 3, and far below 1 when they
/// leave their instruction set. The two least times of a run would have to differ by a third by
/// noise alone.
const FLOOR: f64 = 1.2;

/// Least ratio of work that is only in part done on vectors: functions of the mathematical library,
/// look-ups, lists of patches.
const FLOOR_OF_PARTS: f64 = 0.8;

/// The report of `ppum-bench guard`.
#[derive(Debug, Serialize)]
pub struct GuardReport {
    /// Instruction sets.
    wide: &'static str,
    narrow: &'static str,
    rows: Vec<GuardRow>,
    calls: Vec<Calls>,
    holds: bool,
}

#[derive(Debug, Serialize)]
struct GuardRow {
    kernels: String,
    wide_ms: f64,
    narrow_ms: f64,
    ratio: f64,
    floor: f64,
    /// True of the job that leaves its instruction set on purpose: it must fall below the floor.
    is_control: bool,
    holds: bool,
}

impl GuardReport {
    /// Measures; `quick` repeats less.
    ///
    /// # Errors
    /// If threads or datasets cannot be made.
    pub fn new(quick: bool) -> anyhow::Result<Self> {
        let (wide, narrow) = (instructions(), narrowed(instructions));
        let mut rows = Vec::new();
        // on a processor without wider vectors there is nothing to guard
        if wide != narrow {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
            let repetitions = if quick { 2 } else { REPETITIONS };
            rows = pool.install(|| Bench { repetitions, rows: Vec::new() }.all())?;
        }
        let calls = Calls::of_this_program()?;
        let holds = rows.iter().all(|row| row.holds) && mistakes(&calls).is_empty();
        Ok(Self { wide, narrow, rows, calls, holds })
    }
}

impl crate::Report for GuardReport {
    fn words(&self) -> String {
        let Self { wide, narrow, .. } = self;
        if wide == narrow {
            return format!("{wide} is all there is: nothing to guard\n");
        }
        format!(
            "processor time with {wide} and with {narrow}, one thread, least of some repetitions\n"
        )
    }

    fn tables(&self) -> Vec<ReportTable> {
        let head = ["kernels", self.wide, self.narrow, "ratio", "floor", ""];
        let line = |row: &GuardRow| {
            let verdict = match (row.holds, row.is_control) {
                (true, true) => "caught",
                (false, true) => "missed!",
                (true, false) => "",
                (false, false) => "too slow!",
            };
            let [wide, narrow] = [row.wide_ms, row.narrow_ms].map(|ms| format!("{ms:.3} ms"));
            let [ratio, floor] = [row.ratio, row.floor].map(|ratio| format!("{ratio:.2}"));
            vec![row.kernels.clone(), wide, narrow, ratio, floor, verdict.to_owned()]
        };
        let gains = ReportTable {
            title: "What wide vectors gain".to_owned(),
            words: 1,
            head: head.map(str::to_owned).into(),
            rows: self.rows.iter().map(line).collect(),
            note: "A kernel that leaves its instruction set falls below its floor. The control is a job that does so on purpose."
                .to_owned(),
        };
        vec![gains, table(&self.calls)]
    }

    /// An error if a kernel has lost its vectors, or if that would not be noticed.
    fn verdict(&self) -> anyhow::Result<()> {
        let bad: Vec<&str> =
            self.rows.iter().filter(|row| !row.holds).map(|row| row.kernels.as_str()).collect();
        ensure!(
            bad.is_empty(),
            "{}: not as fast as vectors of {} are; is a function in these kernels not inlined?",
            bad.join(", "),
            self.wide
        );
        let mistakes = mistakes(&self.calls);
        ensure!(mistakes.is_empty(), "{}", mistakes.join("; "));
        Ok(())
    }
}

/// Lists the faults in the calls of kernels.
fn mistakes(calls: &[Calls]) -> Vec<String> {
    calls.iter().flat_map(|calls| calls.mistakes(CONTROL)).collect()
}

struct Bench {
    repetitions: usize,
    rows: Vec<GuardRow>,
}

impl Bench {
    fn all(mut self) -> anyhow::Result<Vec<GuardRow>> {
        let coarse = CrackRecipe::new(2, 2);
        let covers = [
            ("large cells", coarse),
            ("small cells", CrackRecipe::new(7, 7)),
            ("graded cells", CrackRecipe::new(3, 9)),
            ("all enriched", CrackRecipe { enriched: 1.0, ..coarse }),
            ("weight by its formula", CrackRecipe { weight: Some("1 - t"), ..coarse }),
        ];
        for (name, recipe) in covers {
            self.frames((name, FLOOR), &recipe.dataset()?, "von-mises")?;
        }
        let dataset = coarse.dataset()?;
        let grains = CrackRecipe::new(8, 8).dataset()?;
        self.frames(("cells of a pixel", FLOOR_OF_PARTS), &grains, "von-mises")?;
        let formula = "sqrt(sxx^2 - sxx*syy + syy^2 + 3*sxy^2)";
        self.frames(("quantity by its formula", FLOOR_OF_PARTS), &dataset, formula)?;
        self.formulas::<f64>("f64")?;
        self.formulas::<f32>("f32")?;
        self.colors::<f64>("colours, f64", &dataset)?;
        self.colors::<f32>("colours, f32", &dataset)?;
        self.points(&dataset)?;
        self.jobs();
        Ok(self.rows)
    }

    fn frames(
        &mut self,
        (name, floor): (&str, f64),
        dataset: &Dataset,
        quantity: &str,
    ) -> anyhow::Result<()> {
        let field = Field::new(dataset, 0)?;
        let quantity = Quantity::parse(quantity, &field)?;
        let view = whole()?;
        let frame64 = || drop(black_box(render::<f64>(&field, &view, &quantity, unwatched())));
        self.add(format!("frames, {name}, f64"), floor, frame64);
        let frame32 = || drop(black_box(render::<f32>(&field, &view, &quantity, unwatched())));
        self.add(format!("frames, {name}, f32"), floor, frame32);
        Ok(())
    }

    /// The interpreter of formulas on blocks: arithmetic, and functions of the
    /// mathematical library.
    fn formulas<T: LaneNumber>(&mut self, numbers: &str) -> anyhow::Result<()> {
        let arithmetic = WESTERGAARD[2];
        let elementary = "exp(-x)*sin(3*y) + log(1 + x^2)";
        for (name, text, floor) in
            [("arithmetic", arithmetic, FLOOR), ("functions", elementary, FLOOR_OF_PARTS)]
        {
            let formula = Formula::parse(text, &Scope::polar())?;
            let (jets, mut scratch) =
                (FormulaJets::new(&[&formula], 1)?, BlockScratch::<T>::default());
            let mut block = jets.block(&mut scratch);
            for input in 0..6 {
                let value = |k: usize| 0.1 + (input + k) as f64 / Block::<T>::POINTS as f64;
                let numbers = block.input(input).iter_mut().zip(0..);
                numbers.for_each(|(number, k)| *number = T::from_f64(value(k)));
            }
            self.add(format!("formulas, {name}, {numbers}"), floor, || {
                (0..200).for_each(|_| black_box(&mut block).run());
            });
        }
        Ok(())
    }

    fn colors<T: RasterValue>(&mut self, name: &str, dataset: &Dataset) -> anyhow::Result<()> {
        let (field, view, style) = (Field::new(dataset, 0)?, whole()?, style(1.0));
        let raster: Raster<T> = render(&field, &view, &Quantity::VonMises, unwatched())?;
        let paint = || drop(black_box(ColoredRaster::bare(&raster, &view, &style)));
        self.add(name.to_owned(), FLOOR_OF_PARTS, paint);
        Ok(())
    }

    /// Values and gradients at points on a line.
    fn points(&mut self, dataset: &Dataset) -> anyhow::Result<()> {
        let (field, view) = (Field::new(dataset, 0)?, whole()?);
        let mut local = field.at(view.center);
        let row = PIXELS[1] / 3;
        let points: Vec<_> = (0..PIXELS[0]).map(|column| view.offset(column, row)).collect();
        let mut out = vec![Jet::constant(0.0); points.len() * field.components()];
        self.add("values at points, f64".to_owned(), FLOOR_OF_PARTS, || {
            (0..8).for_each(|_| local.evaluate_into::<1>(&points, Side::Above, &mut out));
            black_box(&out);
        });
        Ok(())
    }

    /// A job as it should be, and the control, which gains less than half of that: with AVX-512
    /// even numbers one by one are faster than scalars.
    fn jobs(&mut self) {
        let mut numbers: Vec<f64> = (0..4096).map(|k| f64::from(k) / 4096.0).collect();
        self.add("a job that is inlined".to_owned(), FLOOR_OF_PARTS, || {
            f64::dispatch(InlineBenchmark(&mut numbers))
        });
        let gained = self.rows.last().map_or(0.0, |row| row.ratio);
        self.add("control: a job that is not".to_owned(), FLOOR_OF_PARTS.max(0.5 * gained), || {
            f64::dispatch(CallBenchmark(&mut numbers));
        });
        if let Some(row) = self.rows.last_mut() {
            row.is_control = true;
            row.holds = row.ratio < row.floor;
        }
    }

    fn add(&mut self, kernels: String, floor: f64, mut work: impl FnMut()) {
        let mut least = [f64::INFINITY; 2];
        // the first of each finds nothing prepared
        for _ in 0..=self.repetitions {
            for (least, is_narrow) in least.iter_mut().zip([false, true]) {
                let start = ThreadTime::now();
                if is_narrow {
                    narrowed(&mut work)
                } else {
                    work()
                }
                *least = least.min(1e3 * start.elapsed().as_secs_f64());
            }
        }
        let [wide_ms, narrow_ms] = least;
        let ratio = narrow_ms / wide_ms;
        let holds = ratio >= floor;
        self.rows.push(GuardRow {
            kernels,
            wide_ms,
            narrow_ms,
            ratio,
            floor,
            is_control: false,
            holds,
        });
    }
}

fn whole() -> anyhow::Result<View> {
    moved(View::fit(DOMAIN, PIXELS)?, 0)
}

/// Some arithmetic, over and over, that stays between 0 and 1.
#[inline(always)]
fn arithmetic<R: Real>(mut x: R) -> R {
    let mut k = 0;
    while k < 64 {
        x = (x * x.broadcast(3.9)) * (x.broadcast(1.0) - x);
        k += 1;
    }
    x
}

/// The symbol of [`called`].
const CONTROL: &str = "guard6called";

/// A call that must not be in a kernel.
#[inline(never)]
fn called<R: Real>(x: R) -> R {
    arithmetic(x)
}

struct InlineBenchmark<'n>(&'n mut [f64]);

impl LaneJob<f64> for InlineBenchmark<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(self, zero: R) {
        for vector in self.0.chunks_exact_mut(R::LANES) {
            arithmetic(zero.load(vector)).store(vector);
        }
    }
}

struct CallBenchmark<'n>(&'n mut [f64]);

impl LaneJob<f64> for CallBenchmark<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real<Scalar = f64>>(self, zero: R) {
        for vector in self.0.chunks_exact_mut(R::LANES) {
            called(zero.load(vector)).store(vector);
        }
    }
}
