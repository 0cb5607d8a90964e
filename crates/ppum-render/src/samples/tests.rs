//! Means against closed forms, the exact share of pixels, and the reference evaluation.

use std::f64::consts::PI;

use super::*;
use ppum::dataset::Dataset;
use ppum::domain::Hole;
use ppum::progress::unwatched;
use ppum::vec2::{Vec2, vec2};
use ppum_raster::reference::reference;
use ppum_raster::scatter::render;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::{Recipe, polynomial};

const COUNTS: [u8; 6] = [1, 2, 3, 5, 8, 16];

fn samples(n: u8) -> Samples {
    Samples::new(n).expect("a number of samples")
}

fn means_of<T: RasterValue>(dataset: &Dataset, view: &View, quantity: &str, n: u8) -> Means<T> {
    let field = Field::new(dataset, 0).expect("a field");
    let quantity = Quantity::parse(quantity, &field).expect("a quantity");
    means(&field, view, &quantity, samples(n), unwatched()).expect("a picture")
}

/// Inside the plate.
fn inner(pixels: [u32; 2]) -> View {
    View::new(vec2(0.83, 0.21), 0.7, pixels).expect("a view")
}

#[test]
fn numbers_of_samples() {
    assert_eq!("4".parse(), Ok(samples(4)));
    assert_eq!((samples(16).count(), Samples::CENTER.count()), (256, 1));
    for wrong in ["0", "17", "x", "", "-1", "2.5"] {
        assert_eq!(wrong.parse::<Samples>(), Err(SamplesError), "{wrong}");
    }
    assert_eq!(samples(4).meaning(), "mean of 4x4 values in the pixel");
}

#[test]
fn the_mean_of_a_linear_field_is_the_value_at_the_centre() {
    let dataset = polynomial(&[0.3, -1.7, 0.9]);
    let view = inner([31, 23]);
    for n in COUNTS {
        let found = means_of::<f64>(&dataset, &view, "ux", n);
        assert!(found.undefined().is_empty() && found.opacity().iter().all(|&o| o == 255));
        for (i, j) in [(0, 0), (30, 0), (17, 22), (4, 9)] {
            let p = view.center - dataset.domain.bounds.center() + view.offset(i, j);
            let exact = 0.3 - 1.7 * p.x + 0.9 * p.y;
            // sums of 256 values of size 2
            assert!((found.raster.value(i, j) - exact).abs() < 2e-14, "{n}");
        }
    }
}

/// The mean of x² over N equal parts of a pixel of the side h by the midpoint rule is x_c² + h²
/// (1 − 1/N²)/12.
#[test]
fn the_mean_of_a_square_is_that_of_the_midpoint_rule() {
    let dataset = polynomial(&[0.0, 0.0, 0.0, 1.0, 0.0, -2.0]);
    let view = inner([7, 5]);
    let h = view.pixel_size();
    for n in COUNTS {
        let found = means_of::<f64>(&dataset, &view, "ux", n);
        let narrow = means_of::<f32>(&dataset, &view, "ux", n);
        for (i, j) in [(0, 0), (6, 4), (3, 2)] {
            let p = view.center - dataset.domain.bounds.center() + view.offset(i, j);
            let spread = h * h * (1.0 - 1.0 / f64::from(n).powi(2)) / 12.0;
            let exact = p.x * p.x + spread - 2.0 * (p.y * p.y + spread);
            assert!((found.raster.value(i, j) - exact).abs() < 2e-14, "{n}");
            assert!((f64::from(narrow.raster.value(i, j)) - exact).abs() < 4e-6, "{n}");
        }
    }
}

/// Bits and not values: NaN is itself.
fn bits(raster: &Raster<f64>) -> Vec<u64> {
    raster.values.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn one_sample_is_the_centre() {
    for seed in 0..4 {
        let dataset = Recipe::random(seed).dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        let view = View::new(vec2(0.8, 0.2), 1.7, [83, 67]).expect("a view");
        let found = means_of::<f64>(&dataset, &view, "syy", 1);
        let quantity = Quantity::parse("syy", &field).expect("a quantity");
        let centers = render::<f64>(&field, &view, &quantity, unwatched()).expect("a picture");
        assert_eq!(bits(&found.raster), bits(&centers));
        assert_eq!(found.undefined(), centers.undefined(field.domain, &view));
        let narrow = render::<f32>(&field, &view, &quantity, unwatched()).expect("a picture");
        let same = means_of::<f32>(&dataset, &view, "syy", 1).raster.values.into_iter();
        assert!(same.zip(narrow.values).all(|(a, b)| a.to_bits() == b.to_bits()));
        let solid = found.opacity().iter().filter(|&&opacity| opacity == 255).count();
        assert!(solid > 1000 && found.opacity().iter().all(|&opacity| opacity % 255 == 0));
    }
}

/// Strips of any height give the same bits, and so does the whole finer picture at once.
#[test]
fn strips_change_nothing() {
    let dataset = Recipe::random(7).dataset();
    let field = Field::new(&dataset, 0).expect("a field");
    let view = View::new(vec2(0.8, 0.2), 1.5, [61, 45]).expect("a view");
    for (name, n) in [("von-mises", 3), ("von-mises", 4), ("direction", 2)] {
        let quantity = Quantity::parse(name, &field).expect("a quantity");
        let finer = view.finer(n.into()).expect("a view");
        let whole = render::<f64>(&field, &finer, &quantity, unwatched()).expect("a picture");
        for rows in [1, 16, 40, 96, 1000] {
            let mut all = Vec::new();
            let mut count = 0;
            let mut take = |values: Vec<f64>| {
                all.extend(values);
                count += 1;
            };
            render_batches(&field, &finer, &quantity, rows, unwatched(), &mut take).expect("drawn");
            let height = rows.next_multiple_of(32);
            assert_eq!(count, finer.pixels[1].div_ceil(height));
            assert_eq!(bits(&Raster::new(finer.pixels, all)), bits(&whole), "{rows}");
        }
        let undefined = whole.undefined(field.domain, &finer);
        let image = SampleImage { raster: &whole, undefined: &undefined };
        let at_once = Means::of(&view, &quantity, samples(n), image);
        let found = means_of::<f64>(&dataset, &view, name, n);
        assert_eq!(bits(&found.raster), bits(&at_once.raster));
        assert_eq!(found.inside, at_once.inside);
    }
    let wide = View::new(vec2(0.8, 0.2), 1.5, [4096, 4096]).expect("a view");
    let strip = rows(&wide.finer(16).expect("a view"), samples(16));
    assert_eq!(strip, 64, "32 MiB");
    assert_eq!(rows(&view.finer(3).expect("a view"), samples(3)) % 96, 0);
}

/// The length of [a, b] within the circle's chord at a height.
fn chord([a, b]: [f64; 2], center: Vec2, radius: f64, y: f64) -> f64 {
    let half = (radius * radius - (y - center.y).powi(2)).max(0.0).sqrt();
    (b.min(center.x + half) - a.max(center.x - half)).max(0.0)
}

/// At the rim of a hole a pixel is as opaque as its area in the plate: of a curve through a pixel
/// each row or column of samples is right to half a sample, and the rows to as much again.
#[test]
fn opacity_is_the_share_of_the_area() {
    let mut dataset = polynomial(&[1.0]);
    let (center, radius) = (vec2(0.81, 0.23), 0.19);
    dataset.domain.holes = vec![Hole::Circle { center, radius }];
    let view = View::new(vec2(0.85, 0.2), 0.5, [40, 40]).expect("a view");
    let h = view.pixel_size();
    for n in [4, 16] {
        let found = means_of::<f64>(&dataset, &view, "ux", n);
        let mut cut = 0;
        for (k, &opacity) in (0u32..).zip(&found.opacity()) {
            let p = view.center + view.offset(k % 40, k / 40);
            // the midpoint rule in 4000 rows: right to a ten-thousandth
            let row = |r: u32| p.y + h * ((f64::from(r) + 0.5) / 4000.0 - 0.5);
            let sides = [p.x - 0.5 * h, p.x + 0.5 * h];
            let hole: f64 = (0..4000).map(|r| chord(sides, center, radius, row(r)) / h).sum();
            let share = 1.0 - hole / 4000.0;
            let apart = (f64::from(opacity) / 255.0 - share).abs();
            assert!(apart < 1.0 / f64::from(n) && (share != 1.0 || opacity == 255), "{apart} {n}");
            cut += u32::from(opacity > 0 && opacity < 255);
            // wherever there is plate there is its value
            let value = found.raster.value(k % 40, k / 40);
            assert!(if opacity > 0 { (value - 1.0).abs() < 1e-14 } else { value.is_nan() });
        }
        assert!(cut > 80, "{cut}");
        assert!(found.undefined().is_empty());
    }
}

/// In a view 10⁻¹² wide at a tip means are those of the reference's values at the samples.
#[test]
fn means_at_a_tip() {
    let dataset = Recipe::default().dataset();
    let field = Field::new(&dataset, 0).expect("a field");
    let quantity = Quantity::parse("syy", &field).expect("a quantity");
    let tip = dataset.steps[0].cracks[0].points[0];
    for (width, pixels) in [(1e-12, [9, 7]), (1e-3, [9, 7])] {
        let view = View::new(tip, width, pixels).expect("a view");
        let finer = view.finer(4).expect("a view");
        let values = reference(&field, &finer, &quantity, unwatched()).expect("a picture");
        let found = means_of::<f64>(&dataset, &view, "syy", 4);
        let size = values.statistics().max;
        for (i, j) in [(0, 0), (4, 3), (8, 6), (2, 5)] {
            let all = (0..16).map(|k| values.value(4 * i + k % 4, 4 * j + k / 4));
            let mean = all.sum::<f64>() / 16.0;
            assert!((found.raster.value(i, j) - mean).abs() < 1e-12 * size, "{width:e}");
        }
        // three by three samples meet the tip, where the stress is infinite
        let through = means_of::<f64>(&dataset, &view, "syy", 3).raster.statistics();
        assert_eq!((through.infinite, through.undefined), (0, 0));
        assert_eq!(means_of::<f64>(&dataset, &view, "syy", 1).raster.statistics().infinite, 1);
    }
}

#[test]
fn what_has_no_value_does_not_count() {
    let middle = Recipe::default().domain.center();
    let dataset = polynomial(&[middle.x - 0.8, 1.0]);
    let view = View::new(vec2(0.8, 0.2), 0.4, [5, 5]).expect("a view");
    let (h, n) = (view.pixel_size(), 8);
    // √(x − 0.8): in the middle column the right half has values
    let found = means_of::<f64>(&dataset, &view, "sqrt(ux)", n);
    let right = (0..4).map(|k| ((f64::from(k) + 0.5) * h / 8.0).sqrt()).sum::<f64>() / 4.0;
    assert!((found.raster.value(2, 3) - right).abs() < 1e-14);
    assert!(found.raster.value(1, 3).is_nan() && found.opacity().iter().all(|&o| o == 255));
    assert_eq!(found.undefined(), [0, 1, 5, 6, 10, 11, 15, 16, 20, 21]);
    // all infinite: 1/0 of both signs, and of one
    let one = means_of::<f64>(&dataset, &view, "-1/(ux - ux)^2", n);
    assert!(one.raster.values.iter().all(|v| *v == f64::NEG_INFINITY));
    let both = means_of::<f64>(&dataset, &view, "1/(0*ux)", n);
    assert!(both.raster.value(2, 2).is_nan() && both.raster.value(3, 2) == f64::INFINITY);
}

#[test]
fn means_do_not_depend_on_threads() {
    let dataset = Recipe::random(3).dataset();
    let mut random = Random(11);
    let view = View::new(random.point(&dataset.domain.bounds), 0.9, [50, 50]).expect("a view");
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| means_of::<f64>(&dataset, &view, "tresca", 4))
    };
    let (one, three) = (on(1), on(3));
    assert_eq!((bits(&one.raster), one.inside), (bits(&three.raster), three.inside));
}

/// An angle θ of a direction is the same as θ + π, so directions about any angle, also about the y
/// axis where θ jumps, have a mean no farther from it than they are.
#[test]
fn directions_have_a_mean_direction() {
    let mut random = Random(83);
    for _ in 0..50 {
        let (center, spread) = (random.between(-4.0, 4.0), random.between(0.0, 0.7));
        let view = inner([3, 2]);
        let wrapped = |angle: f64| angle - PI * ((angle / PI) - 0.5).ceil();
        let mut angle = || wrapped(center + random.between(-spread, spread));
        let angles: Vec<f64> = (0..96).map(|_| angle()).collect();
        let finer = Raster::from_fn([12, 8], |i, j| angles[(12 * j + i) as usize]);
        let image = SampleImage { raster: &finer, undefined: &[] };
        let found = Means::of(&view, &Quantity::PrincipalDirection, samples(4), image);
        for mean in &found.raster.values {
            assert!(mean.abs() <= PI / 2.0);
            assert!(wrapped(mean - center).abs() <= spread + 1e-12, "{mean} about {center}");
        }
        // turned together directions keep their mean
        let turned = Raster::from_fn([12, 8], |i, j| wrapped(finer.value(i, j) + 1.0));
        let image = SampleImage { raster: &turned, undefined: &[] };
        let turned = Means::of(&view, &Quantity::PrincipalDirection, samples(4), image);
        for (mean, turned) in found.raster.values.iter().zip(&turned.raster.values) {
            assert!(wrapped(turned - mean - 1.0).abs() < 1e-12);
        }
    }
}
