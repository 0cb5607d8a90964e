//! The mapping between pixels and the plane, and views that are refused.

use ppum::vec2::{Rect, Vec2, vec2};
use ppum_raster::view::{View, ViewError};

fn square() -> Rect {
    Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0))
}

#[test]
fn fit_shows_the_whole_box_with_square_pixels() {
    let wide = View::fit(square(), [1024, 768]).unwrap();
    assert_eq!(wide.height(), 2.0);
    assert!((wide.width - 2.0 * 1024.0 / 768.0).abs() < 1e-15);
    let tall = View::fit(square(), [100, 400]).unwrap();
    assert_eq!((tall.width, tall.height()), (2.0, 8.0));
}

#[test]
fn hug_takes_the_shape_of_the_box() {
    let plate = Rect::new(vec2(0.0, 0.0), vec2(2.0, 1.0));
    let view = View::hug(plate, [1000, 800]).unwrap();
    assert_eq!((view.pixels, view.width, view.height()), ([1000, 500], 2.0, 1.0));
    let odd = View::hug(Rect::new(vec2(0.0, 0.0), vec2(1.0, 3.0)), [1000, 100]).unwrap();
    assert_eq!(odd.pixels, [33, 100]);
    assert!(odd.width >= 1.0 - 1e-12 && odd.height() >= 3.0 - 1e-12);
}

#[test]
fn window_takes_corners_in_any_order() {
    let pixels = [64, 32];
    let view = View::window(3.0, 2.0, 1.0, 1.0, pixels).unwrap();
    assert_eq!(view, View { center: vec2(2.0, 1.5), width: 2.0, pixels });
}

#[test]
fn top_row_is_up_and_centres_are_symmetric() {
    let view = View::fit(square(), [4, 4]).unwrap();
    assert_eq!(view.offset(0, 0), vec2(-0.75, 0.75));
    assert_eq!(view.offset(3, 3), vec2(0.75, -0.75));
    assert_eq!(view.pixel(vec2(-1.0, 1.0)), Vec2::ZERO);
    for i in 0..4 {
        assert_eq!(view.column_offset(i), -view.column_offset(3 - i));
        assert_eq!(view.pixel_of_offset(view.offset(i, 1)), vec2(f64::from(i) + 0.5, 1.5));
    }
}

/// Around 0.3 neighbouring f64 are 5.6e-17 apart, 1/18 of the pixels of this view; through
/// offsets a point a known number of such steps away still lands where it must.
#[test]
fn mapping_holds_at_a_width_of_1e_12() {
    let center = vec2(0.3, -0.7);
    let view = View::new(center, 1e-12, [1000, 500]).unwrap();
    let ulp = 2f64.powi(-54);
    let right = view.pixel(vec2(center.x + 1000.0 * ulp, center.y));
    assert!((right.x - (500.0 + 1000.0 * ulp / 1e-15)).abs() < 1e-9, "{right:?}");
    assert_eq!(right.y, 250.0);
    for (column, row) in [(0, 0), (999, 0), (500, 250), (17, 499)] {
        let there = view.pixel_of_offset(view.offset(column, row));
        let expected = vec2(f64::from(column) + 0.5, f64::from(row) + 0.5);
        assert!((there - expected).length() < 1e-9);
        assert!((view.offset_at(expected) - view.offset(column, row)).length() < 1e-27);
    }
}

#[test]
fn finer_pixels_divide_pixels() {
    for (width, pixels, n) in [(1e-12, [1000, 500], 4), (3.0, [17, 5], 3), (1e-9, [8, 8], 16)] {
        let view = View::new(vec2(0.3, -0.7), width, pixels).unwrap();
        let finer = view.finer(n).unwrap();
        assert_eq!((finer.center, finer.width), (view.center, view.width));
        let side = view.pixel_size();
        for (i, j, a, b) in [(0, 0, 0, 0), (7, 4, 1, n - 1), (3, 2, n - 1, 0)] {
            let part = |k: u32| (f64::from(k) + 0.5) / f64::from(n) - 0.5;
            let expected = view.offset(i, j) + vec2(part(a), -part(b)) * side;
            let apart = finer.offset(n * i + a, n * j + b) - expected;
            assert!(apart.length() < 1e-12 * side, "{width:e} {n}: {apart:?}");
        }
    }
    let view = View::new(Vec2::ZERO, 1.0, [1 << 14, 1 << 14]).unwrap();
    assert_eq!(view.finer(1), Ok(view));
    assert_eq!(view.finer(16).unwrap().pixels, [1 << 18, 1 << 18]);
    assert!(matches!(view.finer(1 << 18), Err(ViewError::Pixels(u32::MAX, _))));
    assert!(matches!(view.finer(0), Err(ViewError::Pixels(0, 0))));
    let deep = View::new(Vec2::ZERO, 5.1 * f64::MIN_POSITIVE, [5, 5]).unwrap();
    assert!(matches!(deep.finer(2), Err(ViewError::TooDeep { .. })));
}

#[test]
fn impossible_views_are_refused() {
    let at = |center, width, pixels| View::new(center, width, pixels).unwrap_err();
    assert_eq!(at(Vec2::ZERO, 1.0, [0, 5]), ViewError::Pixels(0, 5));
    assert_eq!(at(Vec2::ZERO, 1.0, [1 << 20, 1 << 20]), ViewError::Pixels(1 << 20, 1 << 20));
    assert_eq!(at(Vec2::ZERO, -1.0, [5, 5]), ViewError::Width(-1.0));
    assert!(matches!(at(Vec2::ZERO, f64::NAN, [5, 5]), ViewError::Width(_)));
    assert!(matches!(at(vec2(f64::NAN, 0.0), 1.0, [5, 5]), ViewError::Center(_)));
    assert!(matches!(at(vec2(1.0, 0.0), 1e-17, [5, 5]), ViewError::TooDeep { .. }));
    for width in [1e-320, f64::MIN_POSITIVE, f64::from_bits(1)] {
        assert!(matches!(at(Vec2::ZERO, width, [5, 5]), ViewError::TooDeep { .. }), "{width:e}");
    }
    View::new(Vec2::ZERO, 5.1 * f64::MIN_POSITIVE, [5, 5]).unwrap();
    let flat = View::window(0.0, 1.0, 2.0, 1.0, [5, 5]).unwrap_err();
    assert!(matches!(flat, ViewError::EmptyWindow(_)), "{flat}");
}

#[test]
fn large_numbers_are_told_with_exponents() {
    let far = View::new(vec2(1e300, -2.5), 1.0, [5, 5]).unwrap_err().to_string();
    assert_eq!(far, "a view 1e0 wide at (1e300, -2.5) is finer than double precision; widen it");
    let empty = View::window(-1e300, 0.0, 3.0, 0.0, [5, 5]).unwrap_err().to_string();
    assert!(empty.starts_with("the window from (-1e300, 0) to (3, 0) has"), "{empty}");
}
