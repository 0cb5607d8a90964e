//! Rasters, their values and statistics.

use ppum::domain::{Domain, Hole};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_raster::raster::{Raster, zeros};
use ppum_raster::view::View;

/// More than three of the blocks that zeros are written in.
const MANY: usize = 3500;

#[test]
fn zeros_are_as_many_as_wanted() {
    for count in 0..MANY {
        assert_eq!(zeros::<f32>(count), vec![0.0; count]);
    }
}

#[test]
fn undefined_is_not_outside() {
    let hole = Hole::Circle { center: vec2(0.5, 0.5), radius: 0.3 };
    let bounds = Rect::around(Vec2::ZERO, vec2(1.0, 1.0));
    let domain = Domain { bounds, holes: vec![hole] };
    let view = View::new(vec2(0.1, 0.2), 3.0, [60, 40]).unwrap();
    let raster = Raster::from_fn(view.pixels, |i, _| if i < 30 { f64::NAN } else { 1.0 });
    let found = raster.undefined(&domain, &view);
    let expected: Vec<u32> = (0..2400)
        .filter(|k| {
            let p = view.center + view.offset(k % 60, k / 60);
            let in_plate = p.x.abs() < 1.0 && p.y.abs() < 1.0;
            k % 60 < 30 && in_plate && (p - vec2(0.5, 0.5)).length() > 0.3
        })
        .collect();
    assert!(found == expected && !found.is_empty());
}

#[test]
fn one_value_is_that_of_all_pixels_that_have_one() {
    let of = |values: &[f64]| Raster::new([values.len() as u32, 1], values.to_vec()).one_value();
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    assert_eq!(of(&[nan, 3.0, 3.0 + 1e-12, nan]), Some(3.0 + 0.5e-12));
    assert_eq!(of(&[0.0, -0.0]), Some(0.0));
    assert_eq!(of(&[f64::MAX, f64::MAX]), Some(f64::MAX));
    for values in [&[3.0, 3.0 + 1e-11][..], &[1.0, -1.0], &[2.0, inf], &[-inf], &[nan], &[]] {
        assert_eq!(of(values), None, "{values:?}");
    }
}

#[test]
fn statistics_count_what_is_not_finite_apart() {
    let values = vec![1.0, f64::NAN, 3.0, f64::INFINITY, f64::NEG_INFINITY, 2.0];
    let found = Raster::new([3, 2], values).statistics();
    assert_eq!((found.finite, found.undefined, found.infinite), (3, 1, 2));
    assert_eq!((found.min, found.max, found.mean), (1.0, 3.0, 2.0));
}

#[test]
fn statistics_of_nothing() {
    let found = Raster::new([2, 1], vec![f32::NAN; 2]).statistics();
    assert_eq!((found.finite, found.undefined), (0, 2));
    assert!(found.min > found.max && found.mean.is_nan());
}

#[test]
fn one_value_but_for_rounding() {
    let of = |values: Vec<f64>| Raster::new([values.len() as u32, 1], values).one_value();
    assert_eq!(of(vec![3.0, 3.0, f64::NAN]), Some(3.0));
    assert_eq!(of(vec![0.0, -0.0]), Some(0.0));
    assert_eq!(of(vec![-1e-20; 2]), Some(-1e-20));
    assert!(of(vec![1.0, 1.0 + 1e-13]).is_some() && of(vec![1.0, 1.0 + 1e-11]).is_none());
    for other in [vec![f64::NAN], vec![], vec![1.0, f64::INFINITY], vec![-1e-20, 1e-20]] {
        assert_eq!(of(other.clone()), None, "{other:?}");
    }
    let narrow = |apart: f32| Raster::new([2, 1], vec![1.0, 1.0 + apart]).one_value();
    assert!(narrow(4e-7).is_some() && narrow(1e-5).is_none());
}

#[test]
fn whole_numbers_are_told_from_others() {
    let of =
        |values: &[f64]| Raster::new([values.len() as u32, 1], values.to_vec()).whole_numbers(3);
    assert_eq!(of(&[3.0, -1.0, 3.0, f64::NAN, 0.0, -0.0]), Some(vec![-1.0, 0.0, 3.0]));
    for other in
        [&[0.0, 1.0, 2.0, 3.0][..], &[0.5], &[f64::NAN], &[], &[1.0, f64::INFINITY], &[1e9]]
    {
        assert_eq!(of(other), None, "{other:?}");
    }
}

#[test]
fn rows_run_from_left_to_right() {
    let raster = Raster::from_fn([3, 2], |i, j| f64::from(10 * j + i));
    assert_eq!(raster.values, [0.0, 1.0, 2.0, 10.0, 11.0, 12.0]);
    assert_eq!(raster.value(2, 1), 12.0);
    assert_eq!(raster.row(1), [10.0, 11.0, 12.0]);
}
