//! Ranges against closed forms, sorted values and the extrema of fields.

use ppum::crack::{End, TipId};
use ppum::dataset::Dataset;
use ppum::domain::Hole;
use ppum::equation::{Material, StressState};
use ppum::field::Field;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::vec2::{Vec2, vec2};
use ppum_raster::scatter::render;
use ppum_raster::view::View;
use ppum_testkit::exact::{ElasticField, RoundHole};
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::{Recipe, opening, polynomial};

use super::*;
use crate::extrema::{BodyRegion, Extremum, ExtremumSite, SingularKind, extrema};

const MATERIAL: Material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };

fn bounds(scale: Scale, raster: &Raster<f64>) -> (f64, f64) {
    let norm = RangeChoice::Auto.span(scale, false, raster, None).normalization(scale).unwrap();
    (norm.min(), norm.max())
}

fn list(values: &[f64]) -> Raster {
    Raster::new([values.len() as u32, 1], values.to_vec())
}

/// r^(−1/2) around a tip in the middle of a picture, the tip between pixel centres.
fn tip(n: u32) -> Raster {
    let at = |i: u32| f64::from(i) + 0.6 - f64::from(n) / 2.0;
    Raster::from_fn([n, n], |i, j| (at(i).hypot(at(j)) / f64::from(n)).powf(-0.5))
}

#[test]
fn a_smooth_field_uses_its_whole_range() {
    let ramp = Raster::from_fn([200, 100], |i, j| f64::from(i) - 0.5 * f64::from(j));
    assert_eq!(bounds(Scale::Linear, &ramp), (-49.5, 199.0));
    let square = Raster::from_fn([200, 100], |i, _| f64::from(i).powi(2) - 50.0);
    assert_eq!(bounds(Scale::Linear, &square), (-50.0, 199.0 * 199.0 - 50.0));
}

/// The disc with 0.5 % of the area has radius √(0.005/π) = 0.0399 of the width: its edge's value,
/// 5.007, bounds the range whatever the number of pixels.
#[test]
fn a_tip_does_not_set_the_range() {
    for n in [128, 512] {
        let (min, max) = bounds(Scale::Linear, &tip(n));
        assert!((max - 5.007).abs() < 0.1, "{n}: {max}");
        // The corner is the smallest value, √√2 = 1.19, not within a fifth of zero … 5.
        assert!((min - 1.19).abs() < 0.01, "{n}: {min}");
    }
}

#[test]
fn one_infinite_or_huge_pixel_changes_nothing() {
    let mut raster = tip(128);
    let before = bounds(Scale::Linear, &raster);
    raster.values[64 * 128 + 64] = f64::INFINITY;
    raster.values[64 * 128 + 63] = 1e300;
    raster.values[0] = f64::NAN;
    let (min, max) = bounds(Scale::Linear, &raster);
    assert!((min - before.0).abs() < 0.02 && (max - before.1).abs() < 0.02);
}

#[test]
fn magnitudes_that_come_near_zero_begin_there() {
    assert_eq!(bounds(Scale::Linear, &list(&[0.1, 0.4, 0.7, 1.0])), (0.0, 1.0));
    assert_eq!(bounds(Scale::Linear, &list(&[0.5, 0.7, 1.0])), (0.5, 1.0));
    assert_eq!(bounds(Scale::Linear, &list(&[-0.1, 0.7, 1.0])), (-0.1, 1.0));
}

#[test]
fn degenerate_rasters_still_have_a_range() {
    let inf = f64::INFINITY;
    assert_eq!(bounds(Scale::Linear, &list(&[f64::NAN; 3])), (0.0, 1.0));
    assert_eq!(bounds(Scale::Linear, &list(&[inf, -inf])), (0.0, 1.0));
    assert_eq!(bounds(Scale::Log, &list(&[-1.0, 0.0, f64::NAN])), (0.1, 1.0));
    assert_eq!(bounds(Scale::Linear, &list(&[4.0, 4.0, f64::NAN])), (2.0, 6.0));
    assert_eq!(bounds(Scale::Linear, &list(&[-4.0, -4.0])), (-6.0, -2.0));
    assert_eq!(bounds(Scale::SymLog, &list(&[0.0, 0.0])), (-0.5, 0.5));
    let (min, max) = bounds(Scale::Log, &list(&[4.0, 4.0]));
    assert_eq!((min, max), (2.0, 6.0));
    let (min, max) = bounds(Scale::Linear, &list(&[-f64::MAX, f64::MAX]));
    assert!(min < -1e307 && max > 1e307);
    assert!(bounds(Scale::Linear, &Raster::new([0, 0], vec![])) == (0.0, 1.0));
}

/// The rounding that a linear system leaves of a constant is no picture of its own.
#[test]
fn rounding_of_a_constant_is_not_spread_over_the_colours() {
    let noisy: Vec<f64> = (0..1000).map(|k| 4.0 + 1e-13 * f64::from(k % 7)).collect();
    for scale in [Scale::Linear, Scale::Log, Scale::SymLog] {
        let (min, max) = bounds(scale, &list(&noisy));
        assert!((min - 2.0).abs() < 1e-11 && (max - 6.0).abs() < 1e-11, "{min} {max}");
    }
    // a peak is not lost
    let mut peak = vec![4.0; 1000];
    peak[7] = 5.0;
    assert_eq!(list(&peak).one_value(), None);
}

#[test]
fn log_ranges_leave_out_what_is_not_positive() {
    let decades: Vec<f64> = (0..1000).map(|k| 10f64.powf(f64::from(k) / 250.0 - 2.0)).collect();
    let mut values = vec![-5.0, 0.0, 1e-300];
    values.extend(&decades);
    let (min, max) = bounds(Scale::Log, &list(&values));
    assert!((min / 0.01 - 1.0).abs() < 0.1, "{min}");
    assert!((max / decades[999] - 1.0).abs() < 1e-12, "{max}");
}

#[test]
fn diverging_ranges_are_symmetric_around_zero() {
    let signed = list(&[-1.0, 0.0, 3.0]);
    let norm = RangeChoice::Auto
        .span(Scale::Linear, true, &signed, None)
        .normalization(Scale::Linear)
        .unwrap();
    assert_eq!((norm.min(), norm.max()), (-3.0, 3.0));
    let positive = list(&[2.0, 3.0]);
    let norm = RangeChoice::Auto
        .span(Scale::Linear, true, &positive, None)
        .normalization(Scale::Linear)
        .unwrap();
    assert_eq!((norm.min(), norm.max()), (2.0, 3.0));
}

#[test]
fn fixed_ranges_are_checked() {
    assert_eq!("auto".parse(), Ok(RangeChoice::Auto));
    assert_eq!("-1, 2e3".parse(), Ok(RangeChoice::Fixed(-1.0, 2000.0)));
    assert_eq!("1,1".parse::<RangeChoice>(), Err(RangeError::Empty(1.0, 1.0)));
    assert_eq!("2,1".parse::<RangeChoice>(), Err(RangeError::Empty(2.0, 1.0)));
    for text in ["1,inf", "nan,1", "0,1e400", "-inf,inf"] {
        assert!(matches!(text.parse::<RangeChoice>(), Err(RangeError::Endless(..))), "{text}");
    }
    for text in ["0,1e-310", "-1.7e308,1.7e308"] {
        assert!(matches!(text.parse::<RangeChoice>(), Err(RangeError::Extreme(..))), "{text}");
    }
    for text in ["1..2", "2", "1,2%", "full,", "%", "nan%,5%x"] {
        assert!(matches!(text.parse::<RangeChoice>(), Err(RangeError::Syntax(_))), "{text}");
    }
    assert_eq!("full".parse(), Ok(RangeChoice::Full));
    assert_eq!("1%, 99.5%".parse(), Ok(RangeChoice::Percentiles(1.0, 99.5)));
    assert_eq!("2%".parse(), Ok(RangeChoice::Percentiles(2.0, 98.0)));
    for text in ["50%", "70%", "3%,3%", "9%,3%", "-1%,5%", "5%,101%", "nan%,5%"] {
        assert!(matches!(text.parse::<RangeChoice>(), Err(RangeError::Percentiles(..))), "{text}");
    }
    for range in [RangeChoice::Full, RangeChoice::Auto, RangeChoice::Percentiles(0.5, 97.0)] {
        assert_eq!(range.to_string().parse(), Ok(range));
    }
    let log = RangeChoice::Fixed(0.0, 1.0)
        .span(Scale::Log, false, &list(&[1.0]), None)
        .normalization(Scale::Log);
    assert_eq!(log, Err(RangeError::LogOfNonPositive(0.0)));
    assert_eq!(
        RangeChoice::Fixed(-0.5, 1e-9).to_string().parse(),
        Ok(RangeChoice::Fixed(-0.5, 1e-9))
    );
}

/// The range of a field's picture of so many pixels, found with its extrema.
fn spanned(
    dataset: &Dataset,
    view: &View,
    text: &str,
    range: RangeChoice,
    scale: Scale,
) -> ColorRange {
    let field = Field::new(dataset, 0).unwrap();
    let quantity = Quantity::parse(text, &field).unwrap();
    let raster = render::<f64>(&field, view, &quantity, unwatched()).unwrap();
    let region = BodyRegion::seen(&field, view).unwrap();
    let values = extrema(&field, &region, &quantity, unwatched()).unwrap();
    range.span(scale, false, &raster, values)
}

fn automatic(dataset: &Dataset, view: &View, text: &str) -> ColorRange {
    spanned(dataset, view, text, RangeChoice::Auto, Scale::Linear)
}

/// u = c − |x − p|² + k: c + k at p, between the pixels of any picture.
fn hill(random: &mut Random) -> (Dataset, Vec2, f64) {
    let bounds = Recipe::default().domain;
    let (p, c) = (random.point(&bounds), random.between(-3.0, 3.0));
    let q = p - bounds.center();
    (polynomial(&[c - q.dot(q), 2.0 * q.x, 2.0 * q.y, -1.0, 0.0, -1.0]), p, c)
}

#[test]
fn peaks_between_pixels_are_in_the_range_whatever_the_size() {
    let mut random = Random(7);
    for _ in 0..20 {
        let (dataset, p, top) = hill(&mut random);
        let bounds = dataset.domain.bounds;
        let corners = [
            bounds.min,
            bounds.max,
            vec2(bounds.min.x, bounds.max.y),
            vec2(bounds.max.x, bounds.min.y),
        ];
        let low = corners
            .map(|corner| top - (corner - p).dot(corner - p))
            .into_iter()
            .fold(top, f64::min);
        for pixels in [[16, 16], [23, 9], [200, 150]] {
            let view = View::fit(bounds, pixels).unwrap();
            let span = spanned(&dataset, &view, "ux", RangeChoice::Full, Scale::Linear);
            assert_eq!(span.basis, Basis::All);
            let size = top - low;
            assert!(
                (span.max - top).abs() < 1e-6 * size && (span.min - low).abs() < 1e-6 * size,
                "{span:?}"
            );
            let found = automatic(&dataset, &view, "ux");
            assert_eq!((found.basis, found.max), (Basis::All, span.max));
            assert!(
                found.min == span.min || found.min == 0.0 && span.min < 0.2 * span.max,
                "{found:?}"
            );
            assert_eq!(found.beyond(), [None; 2]);
        }
    }
}

/// Kirsch's plate in small pictures: 3 σ on the rim, which no pixel sees.
#[test]
fn the_rim_of_a_hole_is_in_the_range() {
    let (center, radius) = (vec2(0.8, 0.2), 0.07);
    let plate = RoundHole::new(MATERIAL, center, radius).with_remote([0.0, 1.0, 0.0]);
    let syy = plate.stress_formulas()[1].replace("s2", "p2");
    let mut dataset = polynomial(&[]);
    dataset.domain.holes = vec![Hole::Circle { center, radius }];
    for pixels in [[16, 16], [31, 20], [300, 240]] {
        let view = View::fit(dataset.domain.bounds, pixels).unwrap();
        let span = automatic(&dataset, &view, &syy);
        assert!((span.max - 3.0).abs() < 1e-6 && span.basis == Basis::All, "{span:?}");
        assert_eq!(span.values.as_ref().unwrap().max.on, ExtremumSite::Rim(0));
    }
}

#[test]
fn at_a_tip_it_is_robust_and_beside_it_true() {
    let (tip, d) = (vec2(0.1, 0.2), vec2(0.8, 0.6));
    let dataset = opening(tip, d);
    let kind = SingularKind::Tip(TipId { crack: 0, end: End::Last });
    for width in [1.0, 1e-9] {
        let at =
            |pixels: u32| View::new(tip + vec2(0.013, 0.007) * width, width, [pixels; 2]).unwrap();
        let [coarse, fine] = [64, 256].map(|pixels| automatic(&dataset, &at(pixels), "von-mises"));
        assert_eq!((coarse.basis, fine.basis), (Basis::Robust, Basis::Robust));
        assert!((coarse.max / fine.max - 1.0).abs() < 0.1, "{coarse:?} {fine:?}");
        assert_eq!(fine.beyond(), [None, Some(f64::INFINITY)]);
        let top = fine.values.unwrap().max;
        assert!(
            top.on == ExtremumSite::Singular(kind)
                && (top.offset + (at(256).center - tip)).length() < 1e-16
        );
        // displacements are finite there, and all of them are shown: on the faces, and at
        // the border
        let moved = automatic(&dataset, &at(64), "magnitude");
        assert_eq!((moved.basis, moved.beyond()), (Basis::All, [None; 2]));
        let full = spanned(&dataset, &at(64), "von-mises", RangeChoice::Full, Scale::Linear);
        assert!(full.basis == Basis::Pixels && full.max > 2.0 * coarse.max, "{full:?}");
        // beside the tip: σ at the point of the view that is nearest to it, of any number of pixels
        let beside = |pixels: u32| View::new(tip + d * width, 0.8 * width, [pixels; 2]).unwrap();
        let [coarse, fine] =
            [16, 128].map(|pixels| automatic(&dataset, &beside(pixels), "von-mises"));
        assert_eq!(coarse.basis, Basis::All);
        assert!((coarse.max / fine.max - 1.0).abs() < 1e-6, "{coarse:?} {fine:?}");
        assert!((coarse.min / fine.min - 1.0).abs() < 1e-6, "{coarse:?} {fine:?}");
    }
}

#[test]
fn logarithmic_scales_take_what_is_positive() {
    let dataset = polynomial(&[0.0, 1.0]);
    let view = View::fit(dataset.domain.bounds, [20, 16]).unwrap();
    let log = |text: &str, range: RangeChoice| spanned(&dataset, &view, text, range, Scale::Log);
    let bounds = dataset.domain.bounds;
    let positive = log("exp(x)", RangeChoice::Auto);
    let exact = [bounds.min.x.exp(), bounds.max.x.exp()];
    assert!((positive.min / exact[0] - 1.0).abs() < 1e-12 && positive.basis == Basis::All);
    assert!((positive.max / exact[1] - 1.0).abs() < 1e-12);
    // beyond zero it begins where the pixels do
    let middle = bounds.center().x;
    let signed = format!("x - {middle}");
    for (range, basis) in [(RangeChoice::Auto, Basis::Robust), (RangeChoice::Full, Basis::Pixels)] {
        let span = log(&signed, range);
        assert!(span.min > 0.0 && span.basis == basis, "{span:?}");
        assert!((span.max - (bounds.max.x - middle)).abs() < 1e-12);
        assert!(span.beyond()[0].is_some_and(|low| low < 0.0) && span.beyond()[1].is_none());
    }
    let none = log("-1 - x^2", RangeChoice::Auto);
    assert_eq!((none.min, none.max), (0.1, 1.0));
}

/// 1/(x − c) changes its sign between two pixels.
#[test]
fn poles_are_not_in_the_range() {
    let dataset = polynomial(&[]);
    let view = View::fit(dataset.domain.bounds, [64, 51]).unwrap();
    let pole = dataset.domain.bounds.center().x + 0.3 * view.pixel_size();
    let span = automatic(&dataset, &view, &format!("1/(x - {pole})"));
    assert_eq!(span.basis, Basis::Robust);
    assert!(span.max < 6.0 / view.pixel_size() && span.min > -6.0 / view.pixel_size(), "{span:?}");
    assert!(span.beyond().iter().all(Option::is_some));
}

#[test]
fn percentiles_are_those_of_sorted_values() {
    let mut random = Random(3);
    for n in [1, 2, 3, 50, 1001] {
        let mut values: Vec<f64> = (0..n).map(|_| random.between(-5.0, 9.0)).collect();
        let mut raster = values.clone();
        raster.extend([f64::NAN, f64::INFINITY, f64::NEG_INFINITY]);
        values.sort_by(f64::total_cmp);
        for [p, q] in [[0.0, 100.0], [2.0, 98.0], [12.5, 50.0], [99.0, 100.0]] {
            let at = |percent: f64| {
                let place = percent / 100.0 * (n - 1) as f64;
                let (k, part) = (place.floor() as usize, place.fract());
                values[k] + part * (values[(k + 1).min(n - 1)] - values[k])
            };
            let span =
                RangeChoice::Percentiles(p, q).span(Scale::Linear, false, &list(&raster), None);
            assert_eq!(span.basis, Basis::Percentiles(p, q));
            if n > 1 {
                assert!(
                    (span.min - at(p)).abs() < 1e-12 && (span.max - at(q)).abs() < 1e-12,
                    "{n} {p} {q}"
                );
            }
            let symmetric =
                RangeChoice::Percentiles(p, q).span(Scale::Linear, true, &list(&raster), None);
            let is_signed = span.min < 0.0 && span.max > 0.0;
            assert_eq!(symmetric.min == -symmetric.max, is_signed);
        }
    }
}

/// Any range of a picture without values, or of one alone, can be drawn.
#[test]
fn ranges_of_next_to_nothing() {
    let inf = f64::INFINITY;
    let rasters =
        [vec![], vec![f64::NAN; 4], vec![inf, -inf], vec![3.0], vec![-2.0; 5], vec![0.0, 1e-320]];
    for (range, scale) in
        [RangeChoice::Auto, RangeChoice::Full, RangeChoice::Percentiles(2.0, 98.0)]
            .into_iter()
            .flat_map(|range| {
                [Scale::Linear, Scale::Log, Scale::SymLog].map(|scale| (range, scale))
            })
    {
        for values in &rasters {
            let norm = range.span(scale, true, &list(values), None).normalization(scale);
            assert!(norm.is_ok(), "{range} {scale} {values:?} {norm:?}");
        }
    }
}

#[test]
fn shared_ranges_hold_all() {
    let view = View::new(Vec2::ZERO, 1.0, [3, 1]).unwrap();
    let span = |values: [f64; 3], range: RangeChoice| {
        let raster = list(&values);
        range.span(Scale::Linear, true, &raster, Extrema::of_pixels(&raster, &view))
    };
    let (a, b) =
        (span([2.0, 3.0, 4.0], RangeChoice::Full), span([-9.0, -6.0, -5.0], RangeChoice::Full));
    let both = ColorRange::shared(&[a.clone(), b.clone()], true).unwrap();
    assert_eq!((both.min, both.max, both.basis), (-9.0, 9.0, Basis::Pixels));
    let values = both.values.unwrap();
    assert_eq!((values.min.value, values.max.value), (-9.0, 4.0));
    let both = ColorRange::shared(&[a.clone(), b], false).unwrap();
    assert_eq!((both.min, both.max), (-9.0, 4.0));
    let given = span([0.0; 3], RangeChoice::Fixed(-1.0, 4.0));
    assert_eq!(ColorRange::shared(&[given.clone(), given.clone()], true), Some(given));
    assert_eq!(ColorRange::shared(&[], true), None);
    assert_eq!(ColorRange::shared(std::slice::from_ref(&a), true), Some(a));
}

/// A zero is a peak of the logarithm: what is near it does not take all colours; a smooth field has
/// them all.
#[test]
fn zeros_are_peaks_on_logarithmic_scales() {
    let extrema = |min: f64, max: f64| {
        let extremum = |value| Extremum { value, offset: Vec2::ZERO, on: ExtremumSite::Inside };
        Extrema { center: Vec2::ZERO, min: extremum(min), max: extremum(max), singular: Vec::new() }
    };
    let at = |i: u32| f64::from(i) - 99.7;
    let error = Raster::from_fn([200, 200], |i, j| at(i).hypot(at(j)) * 1e-5 + 1e-12);
    let span = RangeChoice::Auto.span(Scale::Log, false, &error, Some(extrema(1e-12, 1.5e-3)));
    assert!(span.min > 1e-5 && span.max == 1.5e-3 && span.basis == Basis::Robust, "{span:?}");
    let smooth = Raster::from_fn([200, 200], |i, j| (0.02 * f64::from(i + j)).exp());
    let (min, max) = (0.99, (0.02f64 * 398.0).exp() * 1.01);
    let span = RangeChoice::Auto.span(Scale::Log, false, &smooth, Some(extrema(min, max)));
    assert_eq!((span.min, span.max, span.basis), (min, max, Basis::All));
}
