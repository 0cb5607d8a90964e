//! Extrema against closed forms and brute force.

use super::*;
use ppum::crack::{End, SegmentId, Side, TipId};
use ppum::domain::Hole;
use ppum::equation::{Elasticity, Equation, Material, StressState};
use ppum::progress::unwatched;
use ppum::vec2::vec2;
use ppum::weight::WeightFunction;
use ppum_testkit::exact::{ElasticField, RoundHole};
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::{Coefficients, Recipe, opening, polynomial};

const MATERIAL: Material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };

fn extrema_of(field: &Field<'_>, view: &View, text: &str) -> Extrema {
    let quantity = Quantity::parse(text, field).expect("a quantity");
    let region = BodyRegion::seen(field, view).expect("a part of the body");
    let found = extrema(field, &region, &quantity, unwatched()).expect("a search");
    found.expect("values")
}

/// The distance of the places from which a search in what a view shows begins.
fn pixel_of(field: &Field<'_>, view: &View) -> f64 {
    BodyRegion::seen(field, view)
        .and_then(|region| region.grid(pixels(field)))
        .expect("a grid")
        .pixel_size()
}

#[test]
fn a_peak_inside_and_a_corner() {
    // 2 − (x − 0.1)² − 3 (y + 0.2)² − (x − 0.1)(y + 0.2)
    let (a, b) = (0.1, -0.2);
    let dataset = polynomial(&[
        2.0 - a * a - 3.0 * b * b - a * b,
        2.0 * a + b,
        6.0 * b + a,
        -1.0,
        -1.0,
        -3.0,
    ]);
    let field = Field::new(&dataset, 0).expect("a field");
    let bounds = dataset.domain.bounds;
    let view = View::fit(bounds, [37, 31]).expect("a view");
    let all = extrema_of(&field, &view, "ux");
    assert!((all.max.value - 2.0).abs() < 1e-13, "{all:?}");
    assert!((all.max.offset - vec2(a, b)).length() < 1e-6 && all.max.on == ExtremumSite::Inside);
    // concave: least at a corner
    let half = bounds.size() * 0.5;
    let at = |x: f64, y: f64| {
        let d = vec2(x * half.x, y * half.y) - vec2(a, b);
        2.0 - d.x * d.x - 3.0 * d.y * d.y - d.x * d.y
    };
    let corners = [at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)];
    let least = corners.into_iter().fold(f64::INFINITY, f64::min);
    assert!(
        (all.min.value - least).abs() < 1e-12 && all.min.on == ExtremumSite::Border,
        "{all:?} {least}"
    );
    assert!(all.singular.is_empty());
    // outside there is nothing
    let outside = View::new(vec2(9.0, 9.0), 1.0, [8, 8]).expect("a view");
    assert_eq!(BodyRegion::seen(&field, &outside), None);
}

/// Smooth random fields, and stresses that jump on borders of patches: nothing on a dense grid is
/// beyond, and nothing near them either.
#[test]
fn random_fields_against_brute_force() {
    let mut random = Random(5);
    for seed in 0..6 {
        let is_smooth = seed % 2 == 0;
        let weight = if is_smooth { WeightFunction::Cubic } else { WeightFunction::Linear };
        let recipe = Recipe {
            cracks: vec![],
            weight,
            level: 1,
            tip_level: 1,
            seed,
            coefficients: Coefficients::Random,
            degrees: vec![2],
            ..Recipe::default()
        };
        let dataset = recipe.dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        let view = View::hug(dataset.domain.bounds, [140, 110]).expect("a view");
        for text in ["ux", "syy"] {
            let all = extrema_of(&field, &view, text);
            let quantity = Quantity::parse(text, &field).expect("a quantity");
            let mut local = field.at(view.center);
            let mut value = |p| quantity.at(&mut local, p, Side::Above);
            let fine = View::hug(dataset.domain.bounds, [450, 350]).expect("a view");
            let every = (0..fine.pixels[1]).flat_map(|j| (0..fine.pixels[0]).map(move |i| (i, j)));
            let (mut lo, mut hi) = (f64::INFINITY, f64::NEG_INFINITY);
            for v in every.map(|(i, j)| value(fine.offset(i, j))) {
                (lo, hi) = (lo.min(v), hi.max(v));
            }
            // attained, and not exceeded
            assert!(all.max.value >= hi && all.min.value <= lo, "{seed} {text} {all:?} {lo} {hi}");
            let (near, slack) = (vec2(1.0, 1.0) * view.pixel_size(), 1e-6 * (hi - lo));
            for (k, part) in (0..4000).map(|k| (k, [1.0, 0.1, 1e-2, 1e-3][k % 4])) {
                let (sign, at) = if k % 8 < 4 { (1.0, all.max) } else { (-1.0, all.min) };
                let p = at.offset + random.point(&Rect::around(Vec2::ZERO, near * part));
                let beyond = sign * (value(p) - at.value);
                assert!(beyond.is_nan() || beyond <= slack, "{seed} {text} {all:?} {beyond:e}");
            }
            for extremum in [all.min, all.max].into_iter().filter(|e| e.on == ExtremumSite::Inside)
            {
                assert_eq!(value(extremum.offset), extremum.value);
            }
        }
    }
}

/// Fields that jump from sector to sector where cracks meet: nothing on a dense grid is beyond, nor
/// near them, nor beside junctions.
#[test]
fn where_cracks_meet() {
    let mut random = Random(8);
    for seed in 0..4 {
        let (coefficients, degrees) = (Coefficients::Random, vec![2]);
        let recipe = Recipe {
            level: 1,
            tip_level: 2,
            weight: WeightFunction::Cubic,
            coefficients,
            degrees,
            seed,
            ..Recipe::meeting()
        };
        let dataset = recipe.dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        let view = View::hug(dataset.domain.bounds, [200, 150]).expect("a view");
        for text in ["ux", "uy"] {
            let all = extrema_of(&field, &view, text);
            let quantity = Quantity::parse(text, &field).expect("a quantity");
            let mut local = field.at(view.center);
            let mut value = |p| quantity.at(&mut local, p, Side::Above);
            let fine = View::hug(dataset.domain.bounds, [450, 350]).expect("a view");
            let every = (0..fine.pixels[1]).flat_map(|j| (0..fine.pixels[0]).map(move |i| (i, j)));
            let mut places: Vec<Vec2> = every.map(|(i, j)| fine.offset(i, j)).collect();
            for at in recipe.junctions.iter().map(|place| place.center - view.center) {
                places
                    .extend((0..500).map(|_| at + random.direction() * random.between(0.0, 0.01)));
            }
            for at in [all.min.offset, all.max.offset] {
                let near = Rect::around(at, vec2(1.0, 1.0) * view.pixel_size());
                places.extend((0..500).map(|_| random.point(&near)));
            }
            let (mut lo, mut hi) = (f64::INFINITY, f64::NEG_INFINITY);
            for v in places.into_iter().map(&mut value) {
                (lo, hi) = (lo.min(v), hi.max(v));
            }
            let slack = 1e-6 * (hi - lo);
            assert!(all.max.value >= hi - slack, "{seed} {text} {:?} {hi}", all.max);
            assert!(all.min.value <= lo + slack, "{seed} {text} {:?} {lo}", all.min);
        }
    }
}

/// √r − 3 (r − 0.04)² along the upper face, and its negative on the lower one; looked at from
/// both sides.
#[test]
fn on_the_faces_of_a_crack() {
    let (tip, d) = (vec2(0.1, 0.2), vec2(0.8, 0.6));
    let dataset = opening(tip, d);
    let field = Field::new(&dataset, 0).expect("a field");
    let view = View::new(tip - d * 0.2, 0.31, [45, 41]).expect("a view");
    let at = tip - d * 0.04;
    let opened = format!("(ux*{} + uy*{})", d.left().x, d.left().y);
    let hill = format!("3*((x - {})^2 + (y - {})^2)", at.x, at.y);
    let along = |r: f64| r.sqrt() - 3.0 * (r - 0.04).powi(2);
    let expected = (0..1_000_000).map(|k| along(1e-6 * f64::from(k))).fold(0.0, f64::max);
    let high = extrema_of(&field, &view, &format!("{opened} - {hill}")).max;
    let low = extrema_of(&field, &view, &format!("{opened} + {hill}")).min;
    let segment = SegmentId { crack: 0, segment: 0 };
    assert!((high.value / expected - 1.0).abs() < 1e-9, "{high:?} {expected}");
    assert!((low.value / -expected - 1.0).abs() < 1e-9, "{low:?} {expected}");
    assert_eq!(
        (high.on, low.on),
        (ExtremumSite::Face(segment, Side::Above), ExtremumSite::Face(segment, Side::Below))
    );
    assert!(d.cross(high.offset + (view.center - tip)).abs() < 1e-15);
}

/// Kirsch's plate: 3 σ on the rim at the hole's side, −σ at its top; the hole in the middle, over
/// the border, and tiny in the view.
#[test]
fn on_the_rim_of_a_hole() {
    let (center, radius) = (vec2(0.8, 0.2), 0.07);
    let plate = RoundHole::new(MATERIAL, center, radius).with_remote([0.0, 1.0, 0.0]);
    // the text's own names must not be those of quantities
    let [sxx, syy, _] = plate.stress_formulas().map(|text| text.replace("s2", "p2"));
    let mut dataset = polynomial(&[]);
    dataset.domain.holes = vec![Hole::Circle { center, radius }];
    let field = Field::new(&dataset, 0).expect("a field");
    let shift = vec2(0.01, 0.003);
    let views = [
        View::fit(dataset.domain.bounds, [64, 51]).expect("a view"),
        View::new(center + vec2(radius, 0.0) + shift, 0.05, [33, 31]).expect("a view"),
        View::new(center + vec2(radius, 0.0) + shift * 1e-7, 5e-9, [33, 31]).expect("a view"),
    ];
    for view in &views {
        let all = extrema_of(&field, view, &syy);
        assert!((all.max.value - 3.0).abs() < 1e-6, "{all:?}");
        assert_eq!(all.max.on, ExtremumSite::Rim(0));
        let place = view.center + all.max.offset - center;
        assert!(
            place.y.abs() < 1e-3 * radius && (place.x.abs() - radius).abs() < 1e-7 * radius,
            "{place:?}"
        );
    }
    let all = extrema_of(&field, &views[0], &sxx);
    assert!((all.min.value + 1.0).abs() < 1e-6 && all.min.on == ExtremumSite::Rim(0), "{all:?}");
}

/// For a rim that leaves the view, only the visible part counts: on it σ_yy = (1 + 2 cos 2θ) cos²
/// θ.
#[test]
fn rims_end_with_the_view() {
    let (center, radius) = (vec2(0.8, 0.2), 0.07);
    let plate = RoundHole::new(MATERIAL, center, radius).with_remote([0.0, 1.0, 0.0]);
    let [_, syy, _] = plate.stress_formulas().map(|text| text.replace("s2", "p2"));
    let mut dataset = polynomial(&[]);
    dataset.domain.holes = vec![Hole::Circle { center, radius }];
    let field = Field::new(&dataset, 0).expect("a field");
    // from 0.3 to 2.1 radii right of the centre and above it
    let view = View::new(center + vec2(1.2, 1.2) * radius, 1.8 * radius, [33, 33]).expect("a view");
    let all = extrema_of(&field, &view, &syy);
    let exact = (1.0 + 2.0 * (1.0 - 2.0 * 0.09)) * (1.0 - 0.09);
    assert!((all.max.value - exact).abs() < 1e-5, "{all:?}, {exact}");
    for extremum in [all.min, all.max] {
        let far = extremum.offset.x.abs().max(extremum.offset.y.abs());
        assert!(far <= 0.9 * radius * (1.0 + 1e-6), "{extremum:?}");
    }
}

#[test]
fn infinite_at_a_tip() {
    let tip = vec2(0.3, -0.7);
    let dataset = opening(tip, vec2(0.8, 0.6));
    let field = Field::new(&dataset, 0).expect("a field");
    let kind = SingularKind::Tip(TipId { crack: 0, end: End::Last });
    for width in [1.0, 1e-9] {
        let view = View::new(tip + vec2(0.1, 0.05) * width, width, [33, 31]).expect("a view");
        let mises = extrema_of(&field, &view, "von-mises");
        assert_eq!((mises.max.value, mises.max.on), (f64::INFINITY, ExtremumSite::Singular(kind)));
        assert!((mises.max.offset + view.center - tip).length() < 1e-16);
        assert!(mises.min.value > 0.0 && mises.min.on == ExtremumSite::Border, "{mises:?}");
        let shear = extrema_of(&field, &view, "sxy");
        assert_eq!((shear.min.value, shear.max.value), (f64::NEG_INFINITY, f64::INFINITY));
        // rounding next to the tip is no minimum
        let stress = extrema_of(&field, &view, "syy");
        for extremum in [stress.min, stress.max].into_iter().filter(|e| e.value.is_finite()) {
            let away = (extremum.offset + (view.center - tip)).length();
            assert!(away > 0.999e-3 * pixel_of(&field, &view), "{stress:?}");
        }
        let value = extrema_of(&field, &view, "uy");
        assert!(value.singular.is_empty() && value.max.value.is_finite());
        let beside =
            View::new(tip + vec2(3.0, 3.0) * width * 0.2, width, [33, 31]).expect("a view");
        let beside = extrema_of(&field, &beside, "von-mises");
        assert!(beside.max.value.is_finite() && beside.singular.is_empty());
        let angle = extrema_of(&field, &view, "direction");
        let quarter = std::f64::consts::FRAC_PI_2;
        assert!(angle.max.value <= quarter && angle.min.value >= -quarter, "{angle:?}");
    }
}

/// A crack of many segments, more than have a look for some pixels each in a small picture.
#[test]
fn infinity_is_in_the_field_not_in_the_pixels() {
    let (tip, d, kinks) = (vec2(0.3, -0.7), vec2(0.8, 0.6), 200);
    let mut dataset = opening(tip, d);
    let points = &mut dataset.steps[0].cracks[0].points;
    *points =
        (0..=kinks).map(|k| tip - d * (0.7 * f64::from(kinks - k) / f64::from(kinks))).collect();
    let field = Field::new(&dataset, 0).expect("a field");
    for pixels in [[33, 31], [330, 310]] {
        let view = View::new(tip + vec2(0.1, 0.05), 1.0, pixels).expect("a view");
        let mises = extrema_of(&field, &view, "von-mises");
        assert_eq!(mises.max.value, f64::INFINITY, "{pixels:?}: {:?}", mises.max);
    }
}

/// (± sin(θ/2)/√r − 1/√r₀)² + (1 + cos θ)/r₀ is 0 on one face at the distance r₀ from the tip
/// alone, within its pixel.
#[test]
fn valleys_on_the_faces_of_a_tip() {
    let mut random = Random(11);
    for _ in 0..30 {
        let (sin, cos) = (7.0 * random.unit()).sin_cos();
        let (tip, d) = (vec2(random.unit(), random.unit()), vec2(cos, sin));
        let dataset = opening(tip, d);
        let field = Field::new(&dataset, 0).expect("a field");
        let pixels = [[40, 30], [90, 80], [200, 150]][random.below(3)];
        let view = View::new(tip + vec2(0.2, 0.1), 1.5, pixels).expect("a view");
        let r = 0.003 * 300f64.powf(random.unit()) * pixel_of(&field, &view);
        let (side, sign) = [(Side::Above, 1.0), (Side::Below, -1.0)][random.below(2)];
        let opened = format!("(ux*({:?}) + uy*({:?}))", d.left().x, d.left().y);
        let (x, y) = (format!("(x - {:?})", tip.x), format!("(y - {:?})", tip.y));
        let away = format!("sqrt({x}^2 + {y}^2)");
        let ahead = format!("({x}*({:?}) + {y}*({:?}))/{away}", d.x, d.y);
        let c = sign / r.sqrt();
        let text = format!("({opened}/{away} - ({c:?}))^2 + (1 + {ahead})*{:?}", 1.0 / r);
        let least = extrema_of(&field, &view, &text).min;
        let off = (least.offset + (view.center - tip) + d * r).length();
        let told = format!("{least:?} {side:?}, {} pixels", r / pixel_of(&field, &view));
        assert!(least.value.abs() < 1e-8 / r && off < 1e-3 * r, "{told}: {off}");
    }
}

/// The distance of the stresses from those of one place, squared: 0 there, within a fraction of a
/// pixel beside the tip, where it grows without bound.
#[test]
fn valleys_beside_a_tip() {
    let mut random = Random(9);
    for _ in 0..60 {
        let (sin, cos) = (7.0 * random.unit()).sin_cos();
        let (tip, d) = (vec2(random.unit(), random.unit()), vec2(cos, sin));
        let dataset = opening(tip, d);
        let field = Field::new(&dataset, 0).expect("a field");
        let shift = vec2(random.unit() - 0.5, random.unit() - 0.5) * 0.6;
        let view = View::new(tip + shift, 1.5, [50, 40]).expect("a view");
        let (r, angle) = (0.003 * 300f64.powf(random.unit()), 6.0 * random.unit() - 3.0);
        let (sin, cos) = angle.sin_cos();
        let pixel = pixel_of(&field, &view);
        let there = (d * cos + d.left() * sin) * (r * pixel);
        let mut local = field.at(tip);
        let near = ["sxx", "syy", "sxy"].map(|name| {
            let stress = Quantity::parse(name, &field).expect("a stress");
            format!("({name} - ({:?}))^2", stress.at(&mut local, there, Side::Above))
        });
        let least = extrema_of(&field, &view, &near.join(" + ")).min;
        let away = (least.offset + (view.center - tip) - there).length();
        let scale = 1.0 / (r * pixel);
        assert!(least.value < 1e-8 * scale, "{least:?}, {r} pixels, {angle}");
        assert!(away < 1e-3 / scale, "{least:?}, {r} pixels, {angle}: {away}");
    }
}

/// σ_xx = E of u_x = x jumps at a line, E = 2 + x − y on one side of it: the largest value lies on
/// that side, at the border.
#[test]
fn at_an_interface_and_at_corners() {
    let mut dataset = polynomial(&[0.0, 1.0]);
    let young = "if(x > 0.7123, 1, 2 + x - (y - 0.1)^2)";
    let (young, poisson) = (young.parse().expect("a formula"), 0.0.into());
    dataset.equation = Equation::Elasticity(Elasticity {
        young,
        poisson,
        state: StressState::PlaneStrain,
        eigenstrain: None,
        anisotropy: None,
    });
    dataset.domain.holes =
        vec![Hole::polygon([[1.0, 0.3], [1.2, 0.3], [1.1, 0.5]].map(Vec2::from).to_vec())];
    let field = Field::new(&dataset, 0).expect("a field");
    let view = View::fit(dataset.domain.bounds, [64, 51]).expect("a view");
    let all = extrema_of(&field, &view, "sxx");
    assert!(
        (all.max.value - 2.7123).abs() < 1e-6 && all.max.on == ExtremumSite::Interface,
        "{all:?}"
    );
    assert!((all.max.offset + view.center - vec2(0.7123, 0.1)).length() < 1e-4);
    assert!((all.min.value - 1.0).abs() < 1e-12);
    assert!(all.singular.is_empty(), "no function is singular at a corner of the hole");
}

/// σ_xx = E of u_x = x of a round inclusion, E = 2 + x y inside it and 1 outside: at the point of
/// the rim where x y is largest.
#[test]
fn at_a_round_interface() {
    let mut dataset = polynomial(&[0.0, 1.0]);
    let center = dataset.domain.bounds.center();
    let (x, y) = (format!("(x - {})", center.x), format!("(y - {})", center.y));
    let young = format!("if(hypot({x}, {y}) > 0.21, 1, 2 + {x}*{y})");
    let (young, poisson) = (young.parse().expect("a formula"), 0.0.into());
    dataset.equation = Equation::Elasticity(Elasticity {
        young,
        poisson,
        state: StressState::PlaneStrain,
        eigenstrain: None,
        anisotropy: None,
    });
    let field = Field::new(&dataset, 0).expect("a field");
    let view = View::fit(dataset.domain.bounds, [91, 72]).expect("a view");
    let all = extrema_of(&field, &view, "sxx");
    let expected = 2.0 + 0.5 * 0.21 * 0.21;
    assert!(
        (all.max.value - expected).abs() < 1e-8 && all.max.on == ExtremumSite::Interface,
        "{all:?}"
    );
    let far = all.max.offset.length() - 0.21;
    assert!(far.abs() < 1e-9 && (all.max.offset.x - all.max.offset.y).abs() < 1e-3, "{all:?}");
}

/// Curves are sampled in random order of magnitude: the extremes of sums of waves, against many
/// more samples.
#[test]
fn extremes_along_curves() {
    let mut random = Random(11);
    for _ in 0..200 {
        let waves: Vec<[f64; 3]> = (0..4)
            .map(|_| [random.unit(), random.between(1.0, 25.0), random.between(0.0, 6.0)])
            .collect();
        let mut f = |t: f64| waves.iter().map(|[a, k, s]| a * (k * t + s).sin()).sum::<f64>();
        let values: Vec<f64> = (0..64).map(|k| f(curves::part(k, 64))).collect();
        let sampled = [values];
        let [min, max] = [-1.0, 1.0].map(|sign: f64| {
            let tops = curves::tops(&sampled, sign, 16).into_iter();
            let found = tops.map(|(_, [_, k])| curves::golden(&mut f, sign, &sampled[0], k).0);
            sign * found.map(|value| sign * value).fold(f64::NEG_INFINITY, f64::max)
        });
        let all: Vec<f64> = (0..=20000).map(|k| f(f64::from(k) / 20000.0)).collect();
        let (lo, hi) =
            all.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &v| (a.min(v), b.max(v)));
        assert!(
            min <= lo + 1e-12 && lo - min < 2e-6 && max >= hi - 1e-12 && max - hi < 2e-6,
            "{min} {lo} {max} {hi}"
        );
    }
}

/// Values that grow without bound between pixels, at one of them or everywhere are infinite.
#[test]
fn poles_are_infinite() {
    let dataset = Recipe { cracks: vec![], ..Recipe::default() }.dataset();
    let field = Field::new(&dataset, 0).expect("a field");
    let region = BodyRegion::whole(&field);
    let grid = region.grid(pixels(&field)).expect("a grid");
    let (x, column) = (grid.center.x + 0.3 * grid.pixel_size(), grid.center + grid.offset(7, 11));
    let inf = f64::INFINITY;
    for (text, expected) in [
        (format!("1/(x - ({x:?}))"), [-inf, inf]),
        (format!("1/(x - ({x:?}))^2"), [f64::NAN, inf]),
        ("1/0".to_owned(), [inf, inf]),
        (
            format!("if(hypot(x - ({:?}), y - ({:?})) < 1e-9, 1/0, 1)", column.x, column.y),
            [1.0, inf],
        ),
    ] {
        let quantity = Quantity::parse(&text, &field).expect("a quantity");
        let found = extrema(&field, &region, &quantity, unwatched()).expect("a search");
        let found = found.expect("values");
        for (value, expected) in [found.min.value, found.max.value].into_iter().zip(expected) {
            assert!(expected.is_nan() || value == expected, "{text}: {found:?}");
        }
        assert!(found.is_infinite());
    }
    // a peak a thousandth of a pixel wide beside a pixel is finite
    let narrow = column + vec2(0.3, -0.2) * grid.pixel_size();
    let width = 1e-3 * grid.pixel_size();
    let text = format!("1/(1 + (hypot(x - ({:?}), y - ({:?}))/({width:?}))^2)", narrow.x, narrow.y);
    let quantity = Quantity::parse(&text, &field).expect("a quantity");
    let raster = render::<f64>(&field, &grid, &quantity, unwatched()).expect("a raster");
    assert!(raster.statistics().max < 1e-2, "far above all places of the grid");
    let found = extrema(&field, &region, &quantity, unwatched()).expect("a search");
    let max = found.expect("values").max.value;
    assert!((max - 1.0).abs() < 1e-6, "{max}");
}
