//! All summations give the same values, and the automatic choice between them is the intended one.

use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::function::{Frame, FunctionKind};
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum_raster::raster::RasterValue;
use ppum_raster::reference::reference;
use ppum_raster::scatter::{BAND, Schedule, render_batches, render_rows, render_with};
use ppum_raster::summation::{Savings, Summation};
use ppum_raster::view::View;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::{Coefficients, Recipe};

/// Values by row spans with some savings only.
fn by_row_spans<T: RasterValue>(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    savings: Savings,
) -> Vec<f64> {
    let summation = Summation::RowSpans(savings);
    assert!(!Schedule::new(field, view, quantity, summation).is_per_patch());
    values::<T>(field, view, quantity, summation)
}

/// Values by summation per patch, whatever the number of patches.
fn by_patches<T: RasterValue>(field: &Field<'_>, view: &View, quantity: &Quantity) -> Vec<f64> {
    let schedule = Schedule::new(field, view, quantity, Summation::PerPatch);
    assert!(schedule.is_per_patch() && schedule.listed_patches() == 0);
    values::<T>(field, view, quantity, Summation::PerPatch)
}

fn values<T: RasterValue>(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    summation: Summation,
) -> Vec<f64> {
    let raster = render_with::<T>(field, view, quantity, summation, unwatched());
    raster.expect("not stopped").values.into_iter().map(Into::into).collect()
}

/// The share of the pixels that differ by more than `most`, relative to what is around them.
fn differing(found: &[f64], expected: &[f64], most: f64) -> f64 {
    let finite = expected.iter().filter(|value| value.is_finite());
    let mean = finite.clone().map(|value| value.abs()).sum::<f64>() / finite.count().max(1) as f64;
    let differs = |(a, b): (&f64, &f64)| {
        let is_same = a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
        let is_near = (a - b).abs() <= most * (b.abs() + mean);
        !is_same && !is_near
    };
    let count = found.iter().zip(expected).filter(|pair| differs(*pair)).count();
    count as f64 / found.len() as f64
}

/// A random recipe: seeds in turn for covers of all kinds and for uniform ones, which have the most
/// to save.
fn recipe(seed: u64, random: &mut Random) -> Recipe {
    let recipe = Recipe { coefficients: Coefficients::Taylor, ..Recipe::random(seed) };
    if seed.is_multiple_of(2) {
        return recipe;
    }
    let level = 1 + random.below(4) as u8;
    let degrees = vec![random.below(9) as u8];
    Recipe { points: 0, random_rounds: 0, level, tip_level: level, degrees, ..recipe }
}

fn view(dataset: &Dataset, random: &mut Random) -> View {
    let bounds = &dataset.domain.bounds;
    let zoom = 10f64.powf(random.between(-0.2, 2.0));
    let pixels = [20 + random.below(150) as u32, 10 + random.below(60) as u32];
    View::new(random.point(bounds), bounds.size().x / zoom, pixels).expect("a view")
}

#[test]
fn savings_change_rounding_alone() {
    let mut random = Random(23);
    for seed in 0..16 {
        let dataset = recipe(seed, &mut random).dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        for quantity in [Quantity::VonMises, Quantity::Component(1), Quantity::WeightSum] {
            let view = view(&dataset, &mut random);
            let all = by_row_spans::<f64>(&field, &view, &quantity, Savings::ALL);
            let narrow = by_row_spans::<f32>(&field, &view, &quantity, Savings::ALL);
            let none = Savings::NONE;
            let plain = by_row_spans::<f64>(&field, &view, &quantity, none);
            let text = format!("{seed} {quantity:?} {view:?}");
            for table_numbers in [1, 2000] {
                let some = Savings { table_numbers, ..none };
                let batches = by_row_spans::<f64>(&field, &view, &quantity, some);
                assert_eq!(differing(&batches, &plain, 1e-11), 0.0, "batches {text}");
            }
            assert_eq!(differing(&all, &plain, 1e-11), 0.0, "{text}");
            let share = differing(&narrow, &plain, 2e-5);
            assert!(share < 0.01, "{share} in f32, {text}");
        }
    }
}

/// Of large cells as well as of small ones, with all kinds of blocks, frames and functions.
#[test]
fn summations_agree() {
    let mut random = Random(29);
    for seed in 0..24 {
        let dataset = recipe(seed, &mut random).dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        let patch = random.below(field.step.partition.len()) as u32;
        let quantities = [
            Quantity::VonMises,
            Quantity::Component(1),
            Quantity::WeightSum,
            Quantity::Overlap,
            Quantity::PartitionFunction(patch),
        ];
        for quantity in quantities {
            let view = view(&dataset, &mut random);
            let plain = by_row_spans::<f64>(&field, &view, &quantity, Savings::NONE);
            let text = format!("{seed} {quantity:?} {view:?}");
            assert_eq!(
                differing(&by_patches::<f64>(&field, &view, &quantity), &plain, 1e-11),
                0.0,
                "{text}"
            );
            let share = differing(&by_patches::<f32>(&field, &view, &quantity), &plain, 2e-5);
            assert!(share < 0.01, "{share} in f32, {text}");
        }
    }
}

/// The reference's values where a picture has fewer pixels than patches, or a few for each: on
/// views that cut the cells anyhow, about tips, and with a tip at the centre of a pixel. In f32
/// within the digits that row spans have, too.
#[test]
fn cells_of_a_pixel_and_less() {
    let mut random = Random(31);
    let fine = Recipe { level: 5, tip_level: 7, ..Recipe::default() };
    for recipe in [fine.clone(), Recipe { own_frames: true, degrees: vec![1, 3], ..fine }] {
        let dataset = recipe.dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        let bounds = &dataset.domain.bounds;
        let tip = dataset.steps[0].cracks[0].points[0];
        for (center, width, pixels) in [
            (bounds.center(), 1.5, [61, 47]),
            (random.point(bounds), 0.7, [90, 33]),
            (tip, 0.1, [65, 31]),
            (tip, 0.01, [17, 7]),
        ] {
            let view = View::new(center, width, pixels).expect("a view");
            for quantity in [Quantity::VonMises, Quantity::Component(0)] {
                let right = reference(&field, &view, &quantity, unwatched());
                let right = right.expect("not stopped").values;
                let text = format!("{quantity:?} {view:?}");
                assert_eq!(
                    differing(&by_patches::<f64>(&field, &view, &quantity), &right, 1e-11),
                    0.0,
                    "{text}"
                );
                let share = differing(&by_patches::<f32>(&field, &view, &quantity), &right, 2e-5);
                assert!(share < 0.01, "{share} in f32, {text}");
            }
        }
    }
}

/// Views of many patches are summed per patch. Whichever the summation, the strips of a raster are
/// the raster, and so are its rows.
#[test]
fn many_patches_are_summed_one_by_one() {
    let dataset = Recipe { level: 5, tip_level: 5, ..Recipe::default() }.dataset();
    let field = Field::new(&dataset, 0).expect("a field");
    for (size, is_per_patch) in [([48, 36], true), ([480, 360], false)] {
        let view = View::fit(dataset.domain.bounds, size).expect("a view");
        let (quantity, automatic) = (Quantity::VonMises, Summation::Automatic);
        let schedule = Schedule::new(&field, &view, &quantity, automatic);
        assert_eq!(schedule.is_per_patch(), is_per_patch);
        let whole = values::<f64>(&field, &view, &quantity, automatic);
        let mut strips = Vec::new();
        let mut take = |some: Vec<f64>| strips.extend(some);
        render_batches(&field, &view, &quantity, 20, unwatched(), &mut take).expect("not stopped");
        let (border, end) = (BAND * (view.pixels[1] / BAND), view.pixels[1]);
        let rows = |rows| {
            render_rows::<f64>(&field, &view, &quantity, rows, unwatched()).expect("not stopped")
        };
        let parts = [rows(0..border), rows(border..end)].concat();
        let is_same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits();
        for found in [strips, parts] {
            assert!(whole.len() == found.len() && whole.iter().zip(&found).all(is_same));
        }
    }
}

/// Functions that are formulas are evaluated at many pixels at a time, as small as cells may be.
#[test]
fn formulas_are_summed_in_row_spans() {
    let extra = vec![FunctionKind::formula("x*y^2", Frame::World)];
    let dataset = Recipe { level: 5, tip_level: 5, extra, ..Recipe::default() }.dataset();
    let field = Field::new(&dataset, 0).expect("a field");
    let view = View::fit(dataset.domain.bounds, [48, 36]).expect("a view");
    let schedule = Schedule::new(&field, &view, &Quantity::VonMises, Summation::Automatic);
    assert!(!schedule.is_per_patch());
}

/// Row spans of a tile of a cover at all of its columns, of patches that are kept apart and of
/// those that are merged.
fn tile_counts(recipe: &Recipe) -> [usize; 2] {
    let dataset = recipe.dataset();
    let field = Field::new(&dataset, 0).expect("a field");
    let view = View::new(dataset.domain.bounds.center(), 1.2, [64, 48]).expect("a view");
    [Savings::NONE, Savings::ALL].map(|savings| {
        let summation = Summation::RowSpans(savings);
        let schedule = Schedule::new(&field, &view, &Quantity::VonMises, summation);
        let load = schedule.tile([0, 1]);
        assert_eq!(load.first_batch, load.patches);
        load.row_spans
    })
}

/// A uniform cover of equal patches has one span for each row of cells, also where polynomials have
/// frames of their own that are those of the patches beside them; degrees tell patches apart.
#[test]
fn rows_of_a_cover_are_spans() {
    let plain = Recipe { cracks: Vec::new(), level: 2, tip_level: 2, ..Recipe::default() };
    let [patches, spans] = tile_counts(&plain);
    assert!(5 * patches > 6 * spans && spans % 64 == 0, "{patches} patches, {spans} spans");
    let [_, of_frames] = tile_counts(&Recipe { own_frames: true, ..plain.clone() });
    assert_eq!(of_frames, spans, "the same frames in each row");
    let [patches, of_degrees] = tile_counts(&Recipe { degrees: vec![1, 2, 2], ..plain });
    assert!(of_degrees > spans, "{patches} patches, {of_degrees} spans");
}
