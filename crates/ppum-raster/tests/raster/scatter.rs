//! The fast renderer against the scalar reference.

use std::sync::Mutex;

use cpu_time::ThreadTime;
use ppum::dataset::Dataset;
use ppum::decompose::{FieldPart, KINDS};
use ppum::domain::Hole;
use ppum::field::Field;
use ppum::progress::{Cancelled, Phase, Progress, Verdict, unwatched};
use ppum::quantity::{Axis, Quantity, QuantityError, Source};
use ppum::real::{LaneNumber, narrowed};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;
use ppum_raster::RasterError;
use ppum_raster::raster::{Raster, RasterValue};
use ppum_raster::reference::reference;
use ppum_raster::scatter::render;
use ppum_raster::view::View;
use ppum_testkit::synthetic::{Recipe, kinked};

/// A dataset with an exact solution, of which the error is no more than some number.
fn dataset(recipe: &Recipe) -> Dataset {
    let mut dataset = recipe.dataset();
    let exact = |c| format!("sin({c} + x - 0.4*y)");
    dataset.steps[0].fields[0].exact = (0..recipe.components).map(exact).collect();
    dataset
}

fn domain() -> Rect {
    Recipe::default().domain
}

/// A view of the whole domain whose pixels are commensurate with no cell.
fn whole(pixels: [u32; 2]) -> View {
    let center = domain().center() + vec2(0.0123, -0.0171);
    View::new(center, 1.2637, pixels).expect("a view")
}

fn view(center: Vec2, zoom: f64) -> View {
    View::new(center, 4.0 / 3.0 / zoom, [149, 117]).expect("a view")
}

/// The local scale of a quantity: the largest value around each pixel; for quantities of the
/// gradient also that of the gradient (Young's modulus is one), since a component may pass zero,
/// and at least a tenth of its mean, since a patch of degree 0 has none.
struct Scale {
    values: Raster<f64>,
    gradient: Option<Raster<f64>>,
    floor: f64,
}

impl Scale {
    fn at(&self, column: u32, row: u32) -> f64 {
        let gradient = self.gradient.as_ref().map_or(0.0, |g| around(g, column, row));
        around(&self.values, column, row).max(gradient).max(self.floor)
    }
}

/// The largest magnitude of the 3 × 3 pixels around one.
fn around(raster: &Raster<f64>, column: u32, row: u32) -> f64 {
    let mut scale = 0.0f64;
    for j in row.saturating_sub(1)..(row + 2).min(raster.size[1]) {
        for i in column.saturating_sub(1)..(column + 2).min(raster.size[0]) {
            let value = raster.value(i, j).abs();
            scale = if value.is_finite() { scale.max(value) } else { scale };
        }
    }
    scale
}

/// Differences from the reference in units of the local scale, ascending, 0 if there are none.
fn differences<T: RasterValue>(found: &Raster<T>, scale: &Scale) -> Vec<f64> {
    let mut all = vec![0.0];
    for row in 0..found.size[1] {
        for column in 0..found.size[0] {
            let (value, expected) =
                (found.value(column, row).into(), scale.values.value(column, row));
            if expected.is_finite() {
                let difference = (value - expected).abs();
                all.push(if difference > 0.0 {
                    difference / scale.at(column, row)
                } else {
                    difference
                });
            } else {
                assert_eq!(value.is_nan(), expected.is_nan(), "at {column} {row}");
                assert_eq!(value.is_infinite(), expected.is_infinite(), "at {column} {row}");
            }
        }
    }
    assert!(all.iter().all(|d| !d.is_nan()), "a value is missing");
    all.sort_by(f64::total_cmp);
    all
}

fn quantile(sorted: &[f64], share: f64) -> f64 {
    sorted[((sorted.len() - 1) as f64 * share) as usize]
}

/// Largest difference in f64, 99th percentile and largest in f32.
fn compare(field: &Field, view: &View, quantity: &Quantity) -> [f64; 3] {
    let slow = |quantity| reference(field, view, quantity, unwatched()).expect("a quantity");
    let by_gradient = quantity.source() == Source::Gradient;
    let gradient = by_gradient.then(|| slow(&Quantity::GradientNorm));
    let mean = gradient.as_ref().map_or(0.0, |g| g.statistics().mean);
    let scale = Scale { values: slow(quantity), gradient, floor: 0.1 * mean };
    let wide = of_all_processors::<f64>(field, view, quantity, &scale);
    let narrow = of_all_processors::<f32>(field, view, quantity, &scale);
    let found = [quantile(&wide, 1.0), quantile(&narrow, 0.99), quantile(&narrow, 1.0)];
    println!("{quantity:?} width {:e}: {found:?}", view.width);
    found
}

/// The differences with the vectors of this processor, and with those of any other: the
/// larger ones.
fn of_all_processors<T: RasterValue>(
    field: &Field,
    view: &View,
    quantity: &Quantity,
    scale: &Scale,
) -> Vec<f64> {
    let draw = || render::<T>(field, view, quantity, unwatched()).expect("a quantity");
    // what holds for a thread holds for all of this pool
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let [own, other] = [draw(), alone.install(|| narrowed(draw))].map(|r| differences(&r, scale));
    own.iter().zip(other).map(|(a, b)| a.max(b)).collect()
}

fn agree(dataset: &Dataset, view: &View, quantities: &[Quantity]) {
    let field = Field::new(dataset, 0).expect("a field");
    for quantity in quantities {
        let [wide, narrow, _] = compare(&field, view, quantity);
        assert!(wide < 1e-12, "{quantity:?}: {wide:e} in f64");
        assert!(narrow < 2e-5, "{quantity:?}: {narrow:e} in f32");
    }
}

const SOME: [Quantity; 3] =
    [Quantity::VonMises, Quantity::Component(1), Quantity::Derivative(0, Axis::Y)];

/// Where cracks meet, as a whole and near each junction.
#[test]
fn cracks_that_meet() {
    let recipe = Recipe::meeting();
    let dataset = recipe.dataset();
    agree(&dataset, &whole([131, 97]), &SOME);
    for (place, zoom) in recipe.junctions.iter().zip([1e3, 1e6, 1e9, 1e12]) {
        agree(&dataset, &view(place.center, zoom), &SOME);
    }
}

#[test]
fn every_quantity() {
    let dataset = dataset(&Recipe::default());
    let field = Field::new(&dataset, 0).unwrap();
    let names = ppum::quantity::names(field.equation, &field.data.components);
    let mut quantities: Vec<_> = names.into_iter().map(|(_, quantity)| quantity).collect();
    quantities.push(Quantity::PartitionFunction(77));
    for quantity in quantities {
        let [wide, narrow, _] = compare(&field, &whole([131, 97]), &quantity);
        // the direction turns fast where the principal stresses meet
        let slack = if quantity == Quantity::PrincipalDirection { 1e3 } else { 1.0 };
        assert!(wide < 1e-12 * slack, "{quantity:?}: {wide:e} in f64");
        assert!(narrow < 2e-5 * slack, "{quantity:?}: {narrow:e} in f32");
    }
}

#[test]
fn every_weight_function() {
    for weight in WeightFunction::ALL {
        let dataset = dataset(&Recipe { weight, ..Recipe::default() });
        agree(&dataset, &whole([131, 97]), &SOME);
    }
}

#[test]
fn mixed_degrees_and_frames_of_their_own() {
    let recipe = Recipe {
        degrees: vec![2, 0, 8, 1, 5, 3, 7, 4, 6],
        tip_degree: 1,
        own_frames: true,
        ..Recipe::default()
    };
    agree(&dataset(&recipe), &whole([131, 97]), &SOME);
}

#[test]
fn functions_that_are_formulas() {
    // parentheses hide which functions they are
    let tip_functions = Recipe::default().tip_functions.map(|text| format!("({text})"));
    let recipe = Recipe { tip_functions, ..Recipe::default() };
    agree(&dataset(&recipe), &whole([67, 49]), &SOME);
}

#[test]
fn one_and_three_components() {
    for components in [1, 3] {
        let dataset = dataset(&Recipe { components, ..Recipe::default() });
        let quantities = [Quantity::Magnitude, Quantity::GradientNorm, Quantity::EnergyDensity];
        agree(&dataset, &whole([131, 97]), &quantities);
    }
}

#[test]
fn uniform_covers_from_coarse_to_finer_than_pixels() {
    for level in 0..6 {
        let dataset = dataset(&Recipe { level, tip_level: level, ..Recipe::default() });
        agree(&dataset, &whole([131, 97]), &[Quantity::VonMises]);
    }
}

#[test]
fn views_partly_and_wholly_outside() {
    let dataset = dataset(&Recipe::default());
    let corner = domain().max + vec2(0.013, 0.017);
    for pixels in [[131, 97], [1, 1], [7, 200], [300, 3]] {
        agree(&dataset, &View::new(corner, 0.71, pixels).unwrap(), &SOME);
    }
    let field = Field::new(&dataset, 0).unwrap();
    let away = View::new(vec2(9.0, 0.0), 1.0, [33, 17]).unwrap();
    let raster = render::<f32>(&field, &away, &Quantity::VonMises, unwatched()).unwrap();
    assert!(raster.values.iter().all(|v| v.is_nan()));
}

/// Holes inside, over the border and over each other, from afar and at a rim with a zoom of 1e12.
#[test]
fn holes_are_nan_where_the_reference_has_them() {
    let mut dataset = dataset(&Recipe::default());
    let (min, size) = (domain().min, domain().size());
    let at = |x: f64, y: f64| min + vec2(x * size.x, y * size.y);
    let round = Hole::Circle { center: at(0.3, 0.4), radius: 0.125 };
    let notch = Hole::Circle { center: at(1.0, 0.6), radius: 0.2 };
    let points = vec![at(0.2, 0.5), at(0.6, 0.45), at(0.4, 0.6), at(0.5, 0.9)];
    dataset.domain.holes = vec![round, notch, Hole::polygon(points)];
    agree(&dataset, &whole([131, 97]), &SOME);
    let field = Field::new(&dataset, 0).unwrap();
    let rim = at(0.3, 0.4) - vec2(0.075, 0.1);
    for (center, zoom) in [(rim, 1.0), (rim, 1e12), (at(0.2, 0.5), 1e12), (at(0.55, 0.45), 30.0)] {
        let view = view(center, zoom);
        let ours = render::<f64>(&field, &view, &Quantity::VonMises, unwatched()).unwrap();
        let theirs = reference(&field, &view, &Quantity::VonMises, unwatched()).unwrap();
        let holes = |raster: &Raster<f64>| -> Vec<bool> {
            raster.values.iter().map(|v| v.is_nan()).collect()
        };
        let found = holes(&ours);
        assert_eq!(found, holes(&theirs), "{center:?} {zoom}");
        assert!(found.contains(&true) && found.contains(&false), "{center:?} {zoom}");
    }
}

/// Zooms by factors up to 1e12 to a tip, to a kink and to the middle of an oblique crack.
#[test]
fn deep_views() {
    let dataset = dataset(&Recipe { tip_level: 9, ..Recipe::default() });
    let field = Field::new(&dataset, 0).unwrap();
    let points = kinked().points;
    let middle = points[0] + (points[1] - points[0]) * 0.63;
    for (place, at) in [("tip", points[2]), ("kink", points[1]), ("middle", middle)] {
        for zoom in [1.0, 1e3, 1e6, 1e9, 1e12] {
            println!("{place}");
            for quantity in SOME {
                let [wide, narrow, _] = compare(&field, &view(at, zoom), &quantity);
                assert!(wide < 1e-11, "{place} {zoom:e} {quantity:?}: {wide:e} in f64");
                assert!(narrow < 1e-5, "{place} {zoom:e} {quantity:?}: {narrow:e} in f32");
            }
        }
    }
}

/// Stresses are infinite at a tip itself, and nowhere else around it.
#[test]
fn infinite_at_a_tip() {
    let dataset = dataset(&Recipe::default());
    let field = Field::new(&dataset, 0).unwrap();
    let view = View::new(kinked().points[2], 1e-3, [41, 21]).unwrap();
    fn check<T: LaneNumber + RasterValue>(field: &Field, view: &View) {
        let raster = render::<T>(field, view, &Quantity::VonMises, unwatched()).unwrap();
        assert_eq!(raster.value(20, 10).into(), f64::INFINITY);
        assert_eq!(raster.statistics().infinite, 1);
        let finite = render::<T>(field, view, &Quantity::Magnitude, unwatched()).unwrap();
        assert!(finite.values.iter().all(|&v| v.into().is_finite()));
    }
    check::<f64>(&field, &view);
    check::<f32>(&field, &view);
}

/// A view in `T`, in f64, and by the reference, as bits.
fn bits(field: &Field, view: &View) -> [Vec<u64>; 3] {
    let quantity = &Quantity::VonMises;
    let wide = render::<f64>(field, view, quantity, unwatched()).expect("a picture");
    let narrow = render::<f32>(field, view, quantity, unwatched()).expect("a picture");
    let slow = reference(field, view, quantity, unwatched()).expect("a picture");
    let of = |raster: Raster<f64>| raster.values.into_iter().map(f64::to_bits).collect();
    let narrow = narrow.values.into_iter().map(|value| value.to_bits().into()).collect();
    [of(wide), narrow, of(slow)]
}

/// Work runs on the pool that calls, and its size changes nothing.
#[test]
fn threads_do_not_change_a_bit() {
    let dataset = dataset(&Recipe::default());
    let field = Field::new(&dataset, 0).unwrap();
    let view = whole([311, 203]);
    let draw = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| bits(&field, &view))
    };
    let one = draw(1);
    assert!(one == draw(3) && one == draw(5));
}

/// The watcher hears from the threads of the pool that calls, and from no other.
#[test]
fn work_stays_on_the_pool_that_calls() {
    let dataset = dataset(&Recipe::default());
    let field = Field::new(&dataset, 0).unwrap();
    let name = |_| "mine".to_owned();
    let builder = rayon::ThreadPoolBuilder::new().num_threads(3).thread_name(name);
    let here = |_: Progress| {
        assert_eq!(std::thread::current().name(), Some("mine"));
        Verdict::GoOn
    };
    builder.build().unwrap().install(|| {
        render::<f64>(&field, &whole([131, 97]), &Quantity::VonMises, &here).unwrap();
        reference(&field, &whole([31, 17]), &Quantity::VonMises, &here).unwrap();
    });
}

/// Every band of 32 rows is told of once, and the call stops when the watcher says so.
#[test]
fn a_watcher_hears_of_all_and_can_stop() {
    let dataset = dataset(&Recipe::default());
    let field = Field::new(&dataset, 0).unwrap();
    let (view, quantity) = (whole([131, 97]), Quantity::VonMises);
    let heard = Mutex::new(Vec::new());
    let listen = |progress: Progress| {
        assert_eq!((progress.phase, progress.total), (Phase::Evaluation, 4));
        heard.lock().unwrap().push(progress.done);
        Verdict::GoOn
    };
    render::<f32>(&field, &view, &quantity, &listen).unwrap();
    let mut heard = heard.into_inner().unwrap();
    heard.sort_unstable();
    assert_eq!(heard, [0, 1, 2, 3, 4]);
    let stopped = Err(RasterError::Cancelled(Cancelled));
    for after in [0, 2] {
        let stop = |progress: Progress| Verdict::go_on_unless(progress.done >= after);
        assert_eq!(render::<f64>(&field, &view, &quantity, &stop), stopped);
        assert_eq!(reference(&field, &view, &quantity, &stop), stopped);
    }
}

/// A point in pictures of other sizes around it: alone, in a row, in a column, in a corner of a
/// tile, amid many tiles. The reference gives one value to the last bit; the renderer sums in an
/// order that depends on the tile.
#[test]
fn a_value_depends_on_its_picture_in_the_last_digits_only() {
    // a power of two, so that all pictures have the same pixels
    const PIXEL: f64 = 1.0 / 128.0;
    let dataset = dataset(&Recipe::default());
    let field = Field::new(&dataset, 0).unwrap();
    let (mut worst, mut scale) = ([0.0f64; 3], 0.0f64);
    for k in 0..40 {
        let at = domain().min + vec2(0.017 + 0.031 * f64::from(k), 0.013 + 0.0237 * f64::from(k));
        let alone = View::new(at, PIXEL, [1, 1]).unwrap();
        let expected = values_at_center(&field, &alone);
        scale = scale.max(expected[2]);
        for [columns, rows] in [[31, 1], [1, 31], [15, 15], [17, 31], [201, 151]] {
            let view = View::new(at, PIXEL * f64::from(columns), [columns, rows]).unwrap();
            assert_eq!(view.pixel_size(), alone.pixel_size());
            let found = values_at_center(&field, &view);
            for (worst, (found, expected)) in worst.iter_mut().zip(found.iter().zip(&expected)) {
                *worst = worst.max((found - expected).abs());
            }
        }
    }
    let [wide, narrow, slow] = worst.map(|difference| difference / scale);
    println!(
        "a point in other pictures: {wide:e} in f64, {narrow:e} in f32, {slow:e} point by point"
    );
    assert_eq!(slow, 0.0);
    assert!(wide < 1e-12 && narrow < 2e-5, "{wide:e} {narrow:e}");
}

/// The value of the pixel in the middle: in f64, in f32, by the reference.
fn values_at_center(field: &Field, view: &View) -> [f64; 3] {
    let (quantity, [i, j]) = (&Quantity::VonMises, view.pixels.map(|n| n / 2));
    let wide = render::<f64>(field, view, quantity, unwatched()).expect("a picture");
    let narrow = render::<f32>(field, view, quantity, unwatched()).expect("a picture");
    let slow = reference(field, view, quantity, unwatched()).expect("a picture");
    [wide.value(i, j), narrow.value(i, j).into(), slow.value(i, j)]
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let mut dataset = dataset(&Recipe::default());
    dataset.steps[0].fields[0].exact.clear();
    let field = Field::new(&dataset, 0).unwrap();
    let error =
        |quantity| render::<f64>(&field, &whole([3, 2]), quantity, unwatched()).unwrap_err();
    assert!(matches!(error(&Quantity::Error), RasterError::Quantity(QuantityError::NoExact(_))));
    let beyond = field.step.partition.len() as u32;
    assert!(matches!(
        error(&Quantity::PartitionFunction(beyond)),
        RasterError::Quantity(QuantityError::Patch { .. })
    ));
}

/// Guards the kernels: a function in them that is not inlined leaves the code for wide vectors,
/// which changes no value but costs a factor of ten and more.
#[test]
fn lanes_are_much_faster_than_scalars() {
    let dataset = dataset(&Recipe { level: 1, tip_level: 1, ..Recipe::default() });
    let field = Field::new(&dataset, 0).unwrap();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let least = |frame: &(dyn Fn() + Sync)| {
        let time = |_| {
            let start = ThreadTime::now();
            frame();
            start.elapsed().as_secs_f64()
        };
        pool.install(|| (0..5).map(time).fold(f64::INFINITY, f64::min))
    };
    let view = whole([256, 192]);
    for quantity in [Quantity::VonMises, Quantity::GradientNorm, Quantity::Magnitude] {
        let slow = least(&|| drop(reference(&field, &view, &quantity, unwatched())));
        let wide = slow / least(&|| drop(render::<f64>(&field, &view, &quantity, unwatched())));
        let narrow = slow / least(&|| drop(render::<f32>(&field, &view, &quantity, unwatched())));
        println!("{quantity:?}: {wide:.1} times faster in f64, {narrow:.1} in f32");
        assert!(wide > 2.5 && narrow > 2.5, "{quantity:?}: {wide} {narrow}");
    }
}

/// More functions in a tile than are kept at a time, and patches in strips of tiles: the picture is
/// that of all points.
#[test]
fn tiles_of_many_functions() {
    let data = ppum_testkit::costly::named("functions");
    let field = Field::new(&data, 0).expect("a field");
    let view = View::new(vec2(0.5, 0.5), 1.03, [70, 52]).expect("a view");
    let quantity = Quantity::parse("uy", &field).expect("a component");
    let picture = render::<f64>(&field, &view, &quantity, unwatched()).expect("a picture");
    let expected = reference(&field, &view, &quantity, unwatched()).expect("a picture");
    let pairs = || picture.values.iter().zip(&expected.values).filter(|(_, e)| !e.is_nan());
    assert!(pairs().count() > 3000);
    for (found, expected) in pairs() {
        // values are 0 and 1, so both sums are right to some ten roundings
        assert!((found - expected).abs() < 1e-14, "{found} {expected}");
    }
    let sides = pairs().filter(|(_, expected)| **expected < 0.5).count();
    assert!((100..3400).contains(&sides), "{sides}");
}

/// Pictures of all kinds of parts add up to that of the whole, of what is linear in the field.
#[test]
fn parts_add_up_in_pictures() {
    for seed in 0..6 {
        let whole = Recipe::random(seed).dataset();
        let field = Field::new(&whole, 0).expect("a field");
        let (data, functions) = (field.data, &field.step.functions);
        let is_there = |part: &FieldPart| data.part(*part, functions).is_ok();
        let parts: Vec<FieldPart> = KINDS.into_iter().filter(is_there).collect();
        assert!(parts.len() > 2, "{parts:?}");
        let changed = |part: FieldPart| {
            let mut dataset = whole.clone();
            dataset.steps[0].fields[0] = data.part(part, functions).expect("it is there");
            dataset
        };
        let datasets: Vec<Dataset> = parts.iter().map(|part| changed(*part)).collect();
        let view = whole_of(&whole);
        for quantity in [Quantity::Component(0), Quantity::Stress(Axis::Y, Axis::Y)] {
            let draw = |dataset: &Dataset| {
                let field = Field::new(dataset, 0).expect("a field");
                render::<f64>(&field, &view, &quantity, unwatched()).expect("drawn")
            };
            let (all, parts): (_, Vec<Raster>) =
                (draw(&whole), datasets.iter().map(draw).collect());
            let mut compared = 0;
            for (k, &value) in all.values.iter().enumerate() {
                let terms: Vec<f64> = parts.iter().map(|part| part.values[k]).collect();
                let sum: f64 = terms.iter().sum();
                let size: f64 = terms.iter().map(|term| term.abs()).sum();
                if !value.is_finite() {
                    assert!(!sum.is_finite(), "{seed} {k}: {value} {sum}");
                    continue;
                }
                // terms have the rounding of the sums that they are made of, which may be larger
                // than they are
                let near = around(&all, k as u32 % 60, k as u32 / 60).max(size);
                assert!((sum - value).abs() <= 1e-11 * near.max(1.0), "{seed} {k}: {value} {sum}");
                compared += 1;
            }
            assert!(compared > 1000, "{compared}");
        }
    }
}

/// A view of a dataset's whole domain.
fn whole_of(dataset: &Dataset) -> View {
    View::fit(dataset.domain.bounds, [60, 50]).expect("a view")
}
