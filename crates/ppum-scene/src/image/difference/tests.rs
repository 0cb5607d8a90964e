use ppum::crack::Side as Face;
use ppum::dataset::Dataset;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::vec2::{Vec2, vec2};
use ppum_render::colormap::Colormap;
use ppum_render::picture::ColoredRaster;
use ppum_render::range::RangeChoice;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::Recipe;

use super::*;
use crate::image::values::RasterValues;
use crate::request::scene::Subject;

const PIXELS: [u32; 2] = [61, 47];
const QUANTITIES: [&str; 8] =
    ["von-mises", "ux", "uy", "syy", "energy", "sxx - syy", "exy", "hypot(ux, uy)"];

/// A view of any depth whose middle lies on a plate.
fn view(random: &mut Random, dataset: &Dataset) -> View {
    let bounds = dataset.domain.bounds;
    let center = bounds.min + random.point(&ppum::vec2::Rect::new(Vec2::ZERO, bounds.size()));
    View::new(center, 10f64.powf(random.between(-9.0, 0.5)), PIXELS).unwrap()
}

fn values(apart: &PixelValues) -> &[f64] {
    match &apart.values {
        RasterValues::Double(raster) => &raster.values,
        RasterValues::Single(_) => panic!("differences are of double precision"),
    }
}

/// Two plates of one place, and what is shown of each, by seed.
struct BodyPair {
    datasets: [Dataset; 2],
    texts: [&'static str; 2],
    view: View,
}

impl BodyPair {
    fn random(seed: u64) -> Self {
        let mut random = Random(seed);
        let datasets = [seed, seed + 1000].map(|seed| Recipe::random(seed).dataset());
        let texts = [0, 1].map(|_| random.pick(&QUANTITIES));
        let view = view(&mut random, &datasets[0]);
        Self { datasets, texts, view }
    }

    fn with<T>(&self, then: impl FnOnce(DifferenceSide<'_>, DifferenceSide<'_>) -> T) -> T {
        let [right, left] = &self.datasets;
        let [right, left] = [right, left].map(|dataset| Field::new(dataset, 0).unwrap());
        let [own, other] = [(self.texts[0], &right), (self.texts[1], &left)]
            .map(|(text, field)| DisplayedQuantity::parse(text, field).unwrap());
        then(
            DifferenceSide { field: &right, shown: &own },
            DifferenceSide { field: &left, shown: &other },
        )
    }
}

fn draw(right: DifferenceSide<'_>, left: DifferenceSide<'_>, view: &View) -> PixelValues {
    FieldDifference { right, left }.draw(view, unwatched()).unwrap()
}

#[test]
fn a_picture_minus_itself_is_zero_at_every_pixel() {
    for seed in 0..40 {
        let pair = BodyPair::random(seed);
        pair.with(|side, _| {
            let apart = draw(side, side, &pair.view);
            let own = side.raster(&pair.view, unwatched()).unwrap();
            for (apart, own) in values(&apart).iter().zip(&own.values) {
                assert!(if own.is_finite() { *apart == 0.0 } else { apart.is_nan() }, "{seed}");
            }
            assert_eq!(apart.norms.unwrap().absolute, [0.0; 3]);
            // hatched is what has no value, and nothing else
            assert_eq!(apart.without, {
                let raster = difference(&own, &own);
                raster.undefined(side.field.domain, &pair.view)
            });
        });
    }
}

#[test]
fn exchanged_sides_change_the_sign_and_nothing_else() {
    for seed in 0..30 {
        let pair = BodyPair::random(seed);
        pair.with(|right, left| {
            let [there, back] = [draw(right, left, &pair.view), draw(left, right, &pair.view)];
            for (a, b) in values(&there).iter().zip(values(&back)) {
                assert!(a == &-b || a.is_nan() && b.is_nan(), "{seed}: {a} {b}");
            }
            assert_eq!(there.norms.unwrap().absolute, back.norms.unwrap().absolute);
            assert_eq!(there.without, back.without);
        });
    }
}

/// Each pixel is right − left as the field's evaluator has them; beside a crack or the rim of a
/// support a rounded coordinate may be on the other side.
#[test]
fn each_pixel_is_the_difference_of_two_evaluations() {
    let (mut asked, mut far, mut some) = (0, 0, 0);
    for seed in 0..60 {
        let pair = BodyPair::random(seed);
        let mut random = Random(77 + seed);
        pair.with(|right, left| {
            let apart = draw(right, left, &pair.view);
            let size = apart.norms.unwrap().field[1];
            for _ in 0..60 {
                let [i, j] = PIXELS.map(|n| random.below(n as usize) as u32);
                let at = |side: DifferenceSide<'_>| {
                    let quantity = side.shown.quantity().unwrap();
                    let mut local = side.field.at(pair.view.center);
                    quantity.at(&mut local, pair.view.offset(i, j), Face::Above)
                };
                let [own, other] = [at(right), at(left)];
                let (found, want) = (values(&apart)[(j * PIXELS[0] + i) as usize], own - other);
                let is_near = (found - want).abs() <= 1e-9 * (own.abs() + other.abs() + size);
                asked += 1;
                far += usize::from(!(is_near || found.is_nan() && want.is_nan()));
                some += usize::from(found.abs() > 1e-6 * (own.abs() + other.abs()));
            }
        });
    }
    assert!(far * 200 <= asked, "{far} of {asked} are far");
    assert!(some * 3 > asked, "{some} of {asked} are not zero");
}

/// Within one field, the difference of two quantities is the formula `q - (q')`.
#[test]
fn of_one_field_a_difference_is_a_formula() {
    for seed in 0..30 {
        let pair = BodyPair::random(seed);
        let field = Field::new(&pair.datasets[0], 0).unwrap();
        let names = ["ux", "uy", "syy", "exy", "sxx - syy", "hypot(ux, uy)"];
        let mut random = Random(300 + seed);
        let texts = [0, 1].map(|_| random.pick(&names));
        let [own, other] = texts.map(|text| DisplayedQuantity::parse(text, &field).unwrap());
        let (right, left) = (
            DifferenceSide { field: &field, shown: &own },
            DifferenceSide { field: &field, shown: &other },
        );
        let apart = draw(right, left, &pair.view);
        let text = format!("({}) - ({})", texts[0], texts[1]);
        let formula = Quantity::parse(&text, &field).unwrap();
        let formula = render::<f64>(&field, &pair.view, &formula, unwatched()).unwrap();
        let sides = [right, left].map(|side| side.raster(&pair.view, unwatched()).unwrap());
        for (k, (a, b)) in values(&apart).iter().zip(&formula.values).enumerate() {
            let size: f64 = sides.iter().map(|raster| raster.values[k].abs()).sum();
            // both may be infinite, of opposite signs or not
            let is_near = (a - b).abs() <= 1e-10 * size || a == b;
            assert!(is_near || a.is_nan() == b.is_nan() && a.is_nan(), "{text}: {a} {b} {size}");
        }
    }
}

/// Where one plate is not there is no difference, and nothing is hatched.
#[test]
fn the_difference_is_where_both_plates_are() {
    let recipe = Recipe::random(3);
    let moved = Recipe {
        domain: ppum::vec2::Rect::new(
            recipe.domain.min + vec2(0.4, 0.3),
            recipe.domain.max + vec2(0.4, 0.3),
        ),
        ..Recipe::random(3)
    };
    let [a, b] = [recipe.dataset(), moved.dataset()];
    let [a, b] = [&a, &b].map(|dataset| Field::new(dataset, 0).unwrap());
    let view = View::fit(a.domain.bounds, PIXELS).unwrap();
    let shown = DisplayedQuantity::parse("uy", &a).unwrap();
    let (right, left) =
        (DifferenceSide { field: &a, shown: &shown }, DifferenceSide { field: &b, shown: &shown });
    let apart = draw(right, left, &view);
    let mut counts = [0; 2];
    for (k, value) in values(&apart).iter().enumerate() {
        let k = k as u32;
        let at = view.center + view.offset(k % PIXELS[0], k / PIXELS[0]);
        let is_inside = a.domain.bounds.contains(at) && b.domain.bounds.contains(at);
        assert_eq!(!value.is_nan(), is_inside, "{at:?}");
        counts[usize::from(is_inside)] += 1;
    }
    assert!(counts[0] > 500 && counts[1] > 500 && apart.without.is_empty());
    assert_eq!(apart.norms.unwrap().compared, counts[1]);
    let warnings = FieldDifference { right, left }.warnings();
    assert!(warnings.len() == 1 && warnings[0].contains("where both are"), "{warnings:?}");
}

#[test]
fn what_is_subtracted_is_named_and_what_does_not_fit_is_told() {
    let pair = BodyPair { texts: ["ux", "ux"], ..BodyPair::random(1) };
    pair.with(|right, left| {
        let minus = FieldDifference { right, left };
        assert_eq!(minus.words()[0], "u_{x} (right − left)");
        assert!(minus.warnings().is_empty());
    });
    let pair = BodyPair { texts: ["ux", "uy"], ..BodyPair::random(1) };
    pair.with(|right, left| {
        let minus = FieldDifference { right, left };
        assert_eq!(minus.words()[0], "u_{x} (right) − u_{y} (left)");
    });
    let mut pair = BodyPair { texts: ["ux", "ux"], ..BodyPair::random(1) };
    for (dataset, unit) in pair.datasets.iter_mut().zip(["mm", "m"]) {
        dataset.steps[0].fields[0].unit = unit.to_owned();
    }
    pair.with(|right, left| {
        let minus = FieldDifference { right, left };
        let warnings = minus.warnings();
        assert_eq!(minus.words()[1], "", "numbers of different units have none");
        assert!(warnings.len() == 1 && warnings[0].starts_with("units differ"), "{warnings:?}");
    });
    let mut pair = BodyPair { texts: ["ux", "ux"], ..BodyPair::random(1) };
    let domain = pair.datasets[1].domain.bounds;
    let far = ppum::vec2::Rect::new(domain.min + vec2(9.0, 0.0), domain.max + vec2(9.0, 0.0));
    pair.datasets[1] = Recipe { domain: far, ..Recipe::random(1) }.dataset();
    pair.with(|right, left| {
        let minus = FieldDifference { right, left };
        assert!(minus.warnings()[0].contains("no point in common"), "{:?}", minus.warnings());
        assert_eq!(draw(right, left, &pair.view).norms.unwrap().compared, 0);
    });
}

/// Zero has the middle colour, whatever the signs of the differences; a range and a map that are
/// chosen stay.
#[test]
fn colours_are_even_around_zero_unless_chosen() {
    for seed in 0..20 {
        let pair = BodyPair::random(seed);
        pair.with(|right, left| {
            let minus = FieldDifference { right, left };
            let drawn = draw(right, left, &pair.view);
            for range in [RangeChoice::Auto, RangeChoice::Full, RangeChoice::Percentiles(2.0, 98.0)]
            {
                let colors = ColorOptions { range, ..ColorOptions::default() };
                let style = minus.style(&colors).unwrap();
                let picture: ColoredRaster = drawn.picture(&style, span(&drawn, &style)).unwrap();
                let norm = &picture.normalization;
                assert!(norm.min() == -norm.max() && norm.max() > 0.0, "{seed} {norm:?}");
            }
            let range = RangeChoice::Fixed(-1.0, 3.0);
            let colors =
                ColorOptions { range, colormap: Some("magma".into()), ..ColorOptions::default() };
            let style = minus.style(&colors).unwrap();
            let picture = drawn.picture(&style, span(&drawn, &style)).unwrap();
            let norm = &picture.normalization;
            assert_eq!([norm.min(), norm.max()], [-1.0, 3.0]);
            assert_eq!(picture.colormap, Colormap::named("magma").unwrap());
        });
    }
}

/// A function that is replaced by its own text changes nothing.
#[test]
fn a_function_in_its_own_place_is_no_difference() {
    for seed in 0..10 {
        let mut pair = BodyPair::random(seed);
        pair.texts[1] = pair.texts[0];
        pair.datasets[1] = pair.datasets[0].clone();
        let functions = &pair.datasets[0].steps[0].functions;
        let own = functions.iter().find_map(|function| match &function.kind {
            ppum::function::FunctionKind::Formula { text, parameters, .. }
                if parameters.is_empty() =>
            {
                Some((function.stem().to_owned(), text.clone()))
            }
            _ => None,
        });
        let (name, text) = own.expect("a function of a tip");
        let mut subject = Subject::default();
        subject.replace(&name, Some(format!("({text})")));
        subject.apply(&mut pair.datasets[1]).unwrap();
        pair.with(|right, left| {
            let norms = draw(right, left, &pair.view).norms.unwrap();
            assert!(norms.absolute[1] <= 1e-12 * norms.field[1], "{seed} {name}: {norms:?}");
            assert!(norms.compared > 0);
        });
    }
}
