//! Nanoseconds per point of the reference evaluator: one point at a time and on lanes, with the
//! value, the gradient and the Hessian, from 16 to a million patches; point location is included,
//! and measured alone.
//!
//! Before that, the four Westergaard functions with gradients as formulas on lanes and by
//! their kernel.
//!
//! Points follow each other along a line of pixels ("line") or are anywhere ("anywhere").
//! `cargo bench -p ppum-bench --bench evaluate`

use ppum::crack::{CrackEnd, Side, TipPoint};
use ppum::dataset::Dataset;
use ppum::field::{Field, LocalField};
use ppum::formula::{Block, BlockScratch, Formula, FormulaJets, Scope};
use ppum::function::{WESTERGAARD, westergaard};
use ppum::jet::Jet;
use ppum::real::{LaneJob, LaneNumber, Real};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::{Recipe, crack};
use std::hint::black_box;
use std::time::Instant;

/// Points a measurement: some milliseconds.
const POINTS: usize = 20_000;

/// Measurements, of which the fastest counts.
const REPETITIONS: usize = 5;

fn main() {
    let [double, single] = [formulas::<f64>(), formulas::<f32>()];
    println!("ns per point, Westergaard functions with gradients    f64     f32");
    println!(
        "as formulas on lanes                               {:>6.2}  {:>6.2}",
        double[0], single[0]
    );
    println!(
        "by their kernel                                    {:>6.2}  {:>6.2}",
        double[1], single[1]
    );
    println!();
    println!("ns per point, fastest of {REPETITIONS}; order 2, two components, two tips");
    println!("{:>8} {:>9} {:>8} {:>24} {:>24}", "", "", "", "one at a time", "lanes");
    println!(
        "{:>8} {:>9} {:>8} {:>8}{:>8}{:>8} {:>8}{:>8}{:>8}",
        "patches",
        "points",
        "locate",
        "value",
        "gradient",
        "Hessian",
        "value",
        "gradient",
        "Hessian"
    );
    for level in [2, 4, 6, 8, 10] {
        let dataset = plate(level);
        let field = Field::new(&dataset, 0).expect("a field");
        report(&field, "line", &line());
        report(&field, "anywhere", &anywhere());
    }
}

/// The unit square with a crack in the middle, 4^level patches, a quarter of them enriched.
fn plate(level: u8) -> Dataset {
    let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
    let cracks = vec![crack(&[[-0.5, 0.013], [0.5, 0.013]], [CrackEnd::Tip; 2])];
    Recipe { domain, cells: [1, 1], level, tip_level: 0, cracks, zone: 0.4, ..Recipe::default() }
        .dataset()
}

fn line() -> Vec<Vec2> {
    let steps = 2000;
    let at = |k: usize| vec2(-0.998 + 1.996 * (k % steps) as f64 / steps as f64, 0.0);
    let row = |k: usize| vec2(0.0, -0.93 + 1.87 * (k / steps) as f64 / (POINTS / steps) as f64);
    (0..POINTS).map(|k| at(k) + row(k)).collect()
}

fn anywhere() -> Vec<Vec2> {
    let mut random = Random(1);
    let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
    (0..POINTS).map(|_| random.point(&domain)).collect()
}

fn report(field: &Field<'_>, name: &str, points: &[Vec2]) {
    let local = &mut field.at(Vec2::ZERO);
    let mut out = vec![Jet::constant(0.0); points.len() * field.components()];
    let mut found = Vec::new();
    let locate = nanoseconds(|| {
        for &p in points {
            found.clear();
            field.tree.query_point(p, &mut found);
            black_box(&found);
        }
    });
    let single = [
        nanoseconds(|| one_by_one::<0>(local, points, &mut out)),
        nanoseconds(|| one_by_one::<1>(local, points, &mut out)),
        nanoseconds(|| one_by_one::<2>(local, points, &mut out)),
    ];
    let lanes = [
        nanoseconds(|| local.evaluate_into::<0>(points, Side::Above, &mut out)),
        nanoseconds(|| local.evaluate_into::<1>(points, Side::Above, &mut out)),
        nanoseconds(|| local.evaluate_into::<2>(points, Side::Above, &mut out)),
    ];
    black_box(&out);
    let patches = field.step.partition.len();
    let [a, b, c] = single;
    let [d, e, f] = lanes;
    println!(
        "{patches:>8} {name:>9} {locate:>8.0} {a:>8.0}{b:>8.0}{c:>8.0} {d:>8.0}{e:>8.0}{f:>8.0}"
    );
}

fn one_by_one<const D: usize>(local: &mut LocalField<'_>, points: &[Vec2], out: &mut [Jet<f64>]) {
    let components = local.field.components();
    for (&p, out) in points.iter().zip(out.chunks_mut(components)) {
        local.evaluate::<D>(p, Side::Above, out);
    }
}

fn nanoseconds(mut work: impl FnMut()) -> f64 {
    let once = |_| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    let best = (0..REPETITIONS).map(once).fold(f64::INFINITY, f64::min);
    best * 1e9 / POINTS as f64
}

/// Nanoseconds per point of the Westergaard functions with gradients: as formulas, by their kernel.
fn formulas<T: LaneNumber>() -> [f64; 2] {
    let scope = Scope::polar();
    let parse = |text| Formula::parse(text, &scope).expect("a formula");
    let formulas = WESTERGAARD.map(parse);
    let jets = FormulaJets::new(&formulas.each_ref(), 1).expect("small");
    let mut scratch = BlockScratch::<T>::default();
    let mut block = jets.block(&mut scratch);
    let n = Block::<T>::POINTS;
    for k in 0..n {
        let angle = 3.0 * (2 * k) as f64 / n as f64 - 3.0;
        let (x, y) = (angle.cos(), angle.sin());
        let inputs = [x, y, 1.0, angle, (angle / 2.0).cos(), (angle / 2.0).sin()];
        for (index, value) in inputs.into_iter().enumerate() {
            block.input(index)[k] = T::from_f64(value);
        }
    }
    let [xs, ys] = [0, 1].map(|input| block.input(input).to_vec());
    let as_formulas = nanoseconds(|| {
        for _ in 0..POINTS / n {
            black_box(&mut block).run();
        }
    });
    let mut out = vec![T::default(); 12 * n];
    let by_kernel = nanoseconds(|| {
        for _ in 0..POINTS / n {
            T::dispatch(Kernel { xs: black_box(&xs), ys: &ys, out: &mut out });
        }
    });
    [as_formulas, by_kernel]
}

/// The kernel of the Westergaard functions at some points.
struct Kernel<'a, T> {
    xs: &'a [T],
    ys: &'a [T],
    out: &'a mut [T],
}

impl<T: LaneNumber> LaneJob<T> for Kernel<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real<Scalar = T>>(self, zero: R) {
        let (n, mut k) = (self.xs.len(), 0);
        while k < n {
            let (x, y) = (zero.load(&self.xs[k..]), zero.load(&self.ys[k..]));
            let one = zero.broadcast(1.0);
            let jets = westergaard::<R, 1>(&TipPoint {
                x,
                y,
                sign: R::sign(y.ge(zero), one),
                branch: one,
            });
            let mut row = 0;
            while row < 12 {
                let jet = &jets[row / 3];
                [jet.v, jet.x, jet.y][row % 3].store(&mut self.out[row * n + k..]);
                row += 1;
            }
            k += R::LANES;
        }
    }
}
