use ppum::cover::Cover;
use ppum::crack::{Crack, CrackEnd, End, TipId};
use ppum::dataset::{Dataset, Equation, FieldData, Step};
use ppum::domain::{Domain, Hole};
use ppum::progress::unwatched;
use ppum::weight::WeightFunction;
use ppum_raster::reference::reference;
use ppum_testkit::random::Random;

use super::need::{ConvergenceObstacle, GridConvergence, GridNeed, ResamplingSetup, converge};
use super::norms::{DifferenceNorms, difference, norms};
use super::*;
use ppum::function::Frame;

/// A potential that is one formula on one patch over \[−1, 2\] × \[0, 2\].
fn plate(text: &str, frame: Frame) -> Dataset {
    let bounds = Rect::new(vec2(-1.0, 0.0), vec2(2.0, 2.0));
    let partition = Cover::uniform(bounds, 0)
        .and_then(|cover| cover.partition(1.5, WeightFunction::Linear))
        .unwrap();
    let mut potential = FieldData::new("potential", &["u"]);
    for _ in 0..partition.len() {
        potential.push_patch(&[(0, 0)]);
    }
    potential.coefficients[0].fill(1.0);
    let crack =
        Crack::polyline(vec![vec2(-1.0, 0.7), vec2(0.31, 0.7)], [CrackEnd::Mouth, CrackEnd::Tip]);
    let step = Step::new(partition)
        .with_crack(crack)
        .with_function("f", FunctionKind::formula(text, frame));
    Dataset::new(bounds, Equation::poisson(1.0)).with_step(step.with_field(potential))
}

fn smooth(text: &str) -> Dataset {
    plate(text, Frame::World)
}

/// √r cos(θ/2) or the like around the tip at (0.31, 0.7).
fn at_tip(text: &str) -> Dataset {
    plate(text, Frame::Tip(TipId { crack: 0, end: End::Last }))
}

fn whole(dataset: &Dataset, pixels: [u32; 2]) -> View {
    View::fit(dataset.domain.bounds, pixels).unwrap()
}

fn raster(dataset: &Dataset, view: &View, size: [u32; 2], by: Interpolation) -> [Raster; 2] {
    let field = Field::new(dataset, 0).unwrap();
    let quantity = Quantity::parse("u", &field).unwrap();
    let grid = SampleGrid::over_domain(&field, size).unwrap();
    let samples = grid.sample(&field, &quantity, unwatched()).unwrap();
    [reference(&field, view, &quantity, unwatched()).unwrap(), samples.raster(by, view)]
}

fn errors(dataset: &Dataset, view: &View, n: u32, by: Interpolation) -> DifferenceNorms {
    let [direct, other] = raster(dataset, view, [n + n / 2, n], by);
    norms(&direct, &other)
}

#[test]
fn polynomials_that_are_reproduced() {
    use Interpolation::{Bicubic, Bilinear, Nearest};
    let cases = [
        (Nearest, "2.5", [2, 2]),
        (Bilinear, "1 + 2*x - y + 3*x*y", [2, 2]),
        (Bilinear, "1 + 2*x - y + 3*x*y", [7, 5]),
        (Bicubic, "1 + 2*x - y + 3*x*y", [2, 2]),
        (Bicubic, "x^2 + 2*x*y - 3*y^2 + x - 1", [3, 3]),
        (Bicubic, "x^2*y^2 + 2*x*y - 3*y^2 + x - 1", [3, 4]),
        (Bicubic, "x^2*y^2 + 2*x*y^2 - 3*y^2 + x - 1", [11, 6]),
    ];
    for (by, text, size) in cases {
        let dataset = smooth(text);
        for view in [whole(&dataset, [30, 20]), View::new(vec2(0.3, 1.1), 1e-9, [9, 9]).unwrap()] {
            let [direct, other] = raster(&dataset, &view, size, by);
            let found = norms(&direct, &other);
            // 16 products of size 20
            assert!(found.absolute[2] < 1e-13, "{by} {text}: {found:?}");
            assert_eq!((found.compared, found.lost), (direct.values.len(), 0));
        }
    }
    // and one degree more is not
    for (by, text) in [(Nearest, "x"), (Bilinear, "x^2"), (Bicubic, "x^3")] {
        let dataset = smooth(text);
        assert!(errors(&dataset, &whole(&dataset, [30, 20]), 6, by).absolute[2] > 1e-4, "{by}");
    }
}

/// With the order k of the interpolation errors fall as h^k in all norms: nearest 1, bilinear 2,
/// bicubic 3. Between grids of n and 2n points h is smaller by (2n − 1)/(n − 1).
#[test]
fn errors_of_smooth_fields_fall_as_theory_says() {
    let dataset = smooth("sin(2*x + 0.3)*exp(y/2) + cos(3*y)");
    let view = whole(&dataset, [301, 201]);
    for by in Interpolation::ALL {
        let [coarse, fine] = [40, 80].map(|n| errors(&dataset, &view, n, by));
        let refined = f64::from(79).log2() - f64::from(39).log2();
        for k in 0..3 {
            let order = (coarse.absolute[k] / fine.absolute[k]).log2() / refined;
            let wanted = f64::from(by.order());
            // Cubic convolution does better where u''' is small: within 15 % of the order.
            assert!((order / wanted - 1.0).abs() < 0.15, "{by} L{k}: {order}");
        }
    }
}

/// At a tip √r is the best that can be had: the largest error falls as h^½ whatever the
/// interpolation. The grids are placed alike about the tip, in a view that shrinks with them.
#[test]
fn errors_at_a_tip_fall_as_the_root_of_the_spacing() {
    let dataset = at_tip("sqrt(r)*cos(theta/2)");
    let field = Field::new(&dataset, 0).unwrap();
    let quantity = Quantity::parse("u", &field).unwrap();
    let tip = vec2(0.31, 0.7);
    for by in Interpolation::ALL {
        let error = |width: f64| {
            let view = View::new(tip, width, [120, 120]).unwrap();
            let bounds = Rect::new(vec2(-width, -1.1 * width), vec2(1.2 * width, width));
            let grid = SampleGrid::new(tip, bounds, [12, 12]).unwrap();
            let samples = grid.sample(&field, &quantity, unwatched()).unwrap();
            let direct = reference(&field, &view, &quantity, unwatched()).unwrap();
            norms(&direct, &samples.raster(by, &view)).absolute
        };
        let [coarse, fine] = [error(1e-3), error(1e-9)];
        for k in 0..3 {
            let order = (coarse[k] / fine[k]).log10() / 6.0;
            assert!((order - 0.5).abs() < 1e-6, "{by} L{k}: {order}");
        }
    }
}

/// Every interpolation against its definition: nearest by distances, bilinear as two lines, bicubic
/// as four Hermite splines with the slopes of neighbouring points, as Catmull and Rom 1974
/// give them.
#[test]
fn interpolations_against_their_definitions() {
    let mut random = Random(5);
    let (size, bounds) = ([6u32, 5u32], Rect::new(vec2(-0.4, 0.1), vec2(0.85, 0.9)));
    let grid = SampleGrid::new(vec2(2.0, -1.0), bounds, size).unwrap();
    let values: Vec<f64> = (0..30).map(|_| random.between(-1.0, 1.0)).collect();
    let u = |i: i64, j: i64| -> f64 {
        // three points beyond the border make a parabola
        let row = |j: i64| -> Vec<f64> {
            let mut line: Vec<f64> = (0..6).map(|i| values[(j * 6 + i) as usize]).collect();
            line.insert(0, 3.0 * line[0] - 3.0 * line[1] + line[2]);
            line.push(3.0 * line[6] - 3.0 * line[5] + line[4]);
            line
        };
        let at = |j: i64| row(j)[(i + 1) as usize];
        match j {
            -1 => 3.0 * at(0) - 3.0 * at(1) + at(2),
            5 => 3.0 * at(4) - 3.0 * at(3) + at(2),
            j => at(j),
        }
    };
    let hermite = |p: [f64; 4], s: f64| {
        let slopes = [0.5 * (p[2] - p[0]), 0.5 * (p[3] - p[1])];
        (2.0 * s.powi(3) - 3.0 * s * s + 1.0) * p[1]
            + (s.powi(3) - 2.0 * s * s + s) * slopes[0]
            + (3.0 * s * s - 2.0 * s.powi(3)) * p[2]
            + (s.powi(3) - s * s) * slopes[1]
    };
    let samples = GridSamples { grid, values: values.clone() };
    for _ in 0..500 {
        let p = random.point(&bounds);
        let t = [(p.x + 0.4) / 0.25, (p.y - 0.1) / 0.2];
        let (i, j) = (t[0].floor() as i64, t[1].floor() as i64);
        let (s, q) = (t[0] - i as f64, t[1] - j as f64);
        let near = u(t[0].round() as i64, t[1].round() as i64);
        let line = |j| u(i, j) * (1.0 - s) + u(i + 1, j) * s;
        let spline = |j| hermite([u(i - 1, j), u(i, j), u(i + 1, j), u(i + 2, j)], s);
        let cubic = hermite([spline(j - 1), spline(j), spline(j + 1), spline(j + 2)], q);
        let expected = [near, line(j) * (1.0 - q) + line(j + 1) * q, cubic];
        for (by, wanted) in Interpolation::ALL.into_iter().zip(expected) {
            let found = samples.at(by, p);
            assert!((found - wanted).abs() < 1e-12, "{by} at {p:?}: {found} for {wanted}");
        }
    }
    // the points themselves, the border included
    for (by, [i, j]) in Interpolation::ALL.into_iter().zip([[0, 0], [5, 4], [3, 0]]) {
        let found = samples.at(by, grid.offset(i, j));
        assert!((found - values[(j * 6 + i) as usize]).abs() < 1e-12);
        assert!(samples.at(by, bounds.max + vec2(1e-9, 0.0)).is_nan());
    }
}

#[test]
fn points_in_holes_have_no_value_and_take_their_neighbours_with_them() {
    let mut dataset = smooth("x + y");
    let hole = Hole::Circle { center: vec2(0.5, 1.0), radius: 0.3 };
    dataset.domain = Domain { bounds: dataset.domain.bounds, holes: vec![hole] };
    let view = whole(&dataset, [60, 40]);
    for by in Interpolation::ALL {
        let [direct, other] = raster(&dataset, &view, [31, 21], by);
        let found = norms(&direct, &other);
        let apart = difference(&direct, &other);
        assert_eq!(apart.statistics().finite, found.compared);
        let hidden = direct.statistics().undefined;
        let shown = other.statistics().undefined;
        assert_eq!(hidden + found.lost, shown + found.invented, "{by}");
        // around the rim a cell of the grid is 2 by 2 pixels
        assert!((20..200).contains(&(found.lost + found.invented)), "{by} {found:?}");
        assert!(by == Interpolation::Nearest || found.lost > 40, "{by} {found:?}");
    }
    // a hole between the points is not seen
    let [direct, other] = raster(&dataset, &view, [2, 2], Interpolation::Bilinear);
    assert_eq!(norms(&direct, &other).invented, direct.statistics().undefined);
}

#[test]
fn one_value_a_cell() {
    let bounds = Rect::new(vec2(0.0, 0.0), vec2(4.0, 2.0));
    let mut dataset = smooth("x + 10*y");
    let partition = Cover::grid(bounds, [4, 2])
        .and_then(|cover| cover.partition(1.5, WeightFunction::Linear))
        .unwrap();
    dataset.domain = bounds.into();
    let mut potential = FieldData::new("potential", &["u"]);
    (0..partition.len()).for_each(|_| potential.push_patch(&[(0, 0)]));
    potential.coefficients[0].fill(1.0);
    (dataset.steps[0].partition, dataset.steps[0].fields) = (partition.into(), vec![potential]);
    let field = Field::new(&dataset, 0).unwrap();
    let view = View::window(-1.0, -1.0, 5.0, 3.0, [12, 8]).unwrap();
    let quantity = Quantity::parse("u", &field).unwrap();
    let picture = cells(&field, &view, &quantity, unwatched()).unwrap();
    for (i, j) in (0..12).flat_map(|i| (0..8).map(move |j| (i, j))) {
        let p = view.center + view.offset(i, j);
        let expected = p.x.floor() + 0.5 + 10.0 * (p.y.floor() + 0.5);
        let found = picture.value(i, j);
        let near = (found - expected).abs() < 1e-12;
        assert!(if bounds.contains(p) { near } else { found.is_nan() }, "{p:?} {found}");
    }
    // centres of pixels on the upper right border belong to the plate
    let corner = View::new(vec2(4.0, 2.0), 1.0, [1, 1]).unwrap();
    let last = cells(&field, &corner, &quantity, unwatched()).unwrap();
    assert!((last.value(0, 0) - 18.5).abs() < 1e-12);
}

#[test]
fn norms_of_lists() {
    let (inf, nan) = (f64::INFINITY, f64::NAN);
    let list = |values: &[f64]| Raster::new([values.len() as u32, 1], values.to_vec());
    let found = norms(&list(&[1.0, -2.0, nan, 4.0, nan]), &list(&[4.0, -6.0, 1.0, nan, nan]));
    assert_eq!(found.absolute, [3.5, (25.0f64 / 2.0).sqrt(), 4.0]);
    assert_eq!(found.field, [1.5, (5.0f64 / 2.0).sqrt(), 2.0]);
    assert_eq!((found.compared, found.infinite, found.lost, found.invented), (2, 0, 1, 1));
    assert_eq!(found.relative()[2], 2.0);
    let found = norms(&list(&[1.0, inf, inf, 2.0]), &list(&[1.0, inf, 3.0, -inf]));
    assert_eq!((found.compared, found.infinite), (1, 2));
    assert_eq!(found.absolute, [0.0, 0.0, inf]);
    let nothing = norms(&list(&[0.0]), &list(&[0.0]));
    assert_eq!(nothing.relative(), [0.0; 3]);
    assert_eq!(norms(&list(&[0.0]), &list(&[1.0])).relative(), [inf; 3]);
}

#[test]
fn memory_is_counted() {
    let dataset = smooth("x");
    let field = Field::new(&dataset, 0).unwrap();
    let patches = field.step.partition.len() as u64;
    // four points a patch; one block and coefficient each; the list of blocks; a crack of two
    // vertices; "x"
    let expected = patches * (64 + 13 + 8) + 4 * (patches + 1) + 32 + 1;
    assert_eq!(representation_bytes(&field), expected);
    let grid = SampleGrid::over_domain(&field, [640, 480]).unwrap();
    let samples = grid.sample(&field, &Quantity::Component(0), unwatched()).unwrap();
    assert_eq!(grid.bytes(), std::mem::size_of_val(&samples.values[..]) as u64);
}

#[test]
fn grids_that_cannot_be() {
    let bounds = Rect::new(vec2(0.0, 0.0), vec2(1.0, 2.0));
    for size in [[1, 5], [5, 1], [0, 0], [1 << 15, 1 << 15]] {
        let refused = SampleGrid::new(Vec2::ZERO, bounds, size);
        assert_eq!(refused, Err(GridError::Points(size[0], size[1])));
    }
    let flat = SampleGrid::new(Vec2::ZERO, Rect::new(bounds.max, bounds.min), [2, 2]);
    assert!(matches!(flat, Err(GridError::Empty(_))));
    assert!("cubic".parse::<Interpolation>().unwrap_err().to_string().contains("bicubic"));
}

fn convergence(dataset: &Dataset, view: &View, name: &str, target: f64) -> GridConvergence {
    let field = Field::new(dataset, 0).unwrap();
    let quantity = Quantity::parse(name, &field).unwrap();
    let grid = SampleGrid::over_domain(&field, [3, 2]).unwrap();
    let interpolation = Interpolation::Bilinear;
    let subject = ResamplingSetup { field: &field, view, quantity: &quantity, grid, interpolation };
    converge(&subject, target, unwatched()).unwrap()
}

/// Bilinear interpolation of (x² + y²)/2 errs by s(1 − s) h²/2 + t(1 − t) k²/2, at most (h² +
/// k²)/8: the grid for an error follows.
#[test]
fn the_grid_for_an_error() {
    let dataset = smooth("(x^2 + y^2)/2");
    let view = whole(&dataset, [300, 200]);
    for target in [1e-2, 1e-4, 1e-6] {
        let found = convergence(&dataset, &view, "u", target);
        let GridNeed::Grid(size) = found.needed(2, target) else { panic!("{found:?}") };
        assert_eq!(found.obstacle, None);
        // largest value 4; doubling overshoots by less than 2 in each direction
        let error = |[nx, ny]: [u32; 2]| {
            let (h, k) = (3.0 / f64::from(nx - 1), 2.0 / f64::from(ny - 1));
            (h * h + k * k) / 8.0 / 4.0
        };
        let half = size.map(|n| n / 2);
        assert!(error(size) < 1.05 * target && error(half) > 0.95 * target, "{size:?} {found:?}");
        assert!((2 * size[0]).abs_diff(3 * size[1]) <= 2, "{size:?}");
    }
    // beyond the largest grid the power law goes on
    let found = convergence(&dataset, &view, "u", 1e-11);
    let GridNeed::Extrapolated([nx, ny]) = found.needed(2, 1e-11) else { panic!("{found:?}") };
    let (h, k) = (3.0 / nx, 2.0 / ny);
    let ratio = (h * h + k * k) / 32.0 / 1e-11;
    assert!((0.8..1.25).contains(&ratio), "{ratio}");
}

#[test]
fn what_no_grid_reaches_is_said() {
    let tip = at_tip("sqrt(r)*cos(theta/2)");
    let jump = at_tip("sqrt(r)*sin(theta/2)");
    let view = whole(&tip, [60, 40]);
    let never = |dataset: &Dataset, view: &View, name: &str| {
        convergence(dataset, view, name, 1e-3).needed(2, 1e-3)
    };
    assert_eq!(never(&tip, &view, "du_dx"), GridNeed::Never(ConvergenceObstacle::Singular));
    assert_eq!(never(&jump, &view, "u"), GridNeed::Never(ConvergenceObstacle::Jump));
    // continuous, and away from the tip
    let ahead = View::new(vec2(1.0, 0.7), 0.4, [40, 40]).unwrap();
    for (dataset, view, name) in [(&tip, &view, "u"), (&jump, &ahead, "u"), (&tip, &ahead, "du_dx")]
    {
        assert!(!matches!(never(dataset, view, name), GridNeed::Never(_)), "{name}");
    }
}
