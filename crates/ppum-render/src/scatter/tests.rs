//! What saves work changes rounding alone.

use ppum::dataset::Dataset;
use ppum::function::{Frame, FunctionKind};
use ppum::progress::unwatched;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::{Coefficients, Recipe};

use super::tile::Tile;
use super::*;

/// A picture of strips with some savings only.
fn drawn<T: Sample>(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    savings: Savings,
) -> Vec<f64> {
    values(&Scene::<T> { savings, ..Scene::with(field, view, quantity, 0) })
}

/// A picture of grains, whatever the number of patches.
fn grains<T: Sample>(field: &Field<'_>, view: &View, quantity: &Quantity) -> Vec<f64> {
    let scene = Scene::<T>::with(field, view, quantity, usize::MAX);
    assert!(scene.plan.has_grains && scene.plan.patches.is_empty());
    values(&scene)
}

fn values<T: Sample>(scene: &Scene<'_, T>) -> Vec<f64> {
    let (view, quantity) = (&scene.view, scene.quantity);
    let mut all = Vec::new();
    let mut take = |values: Vec<T>| all = values.into_iter().map(Into::into).collect();
    let bands = view.pixels[1] as usize;
    match quantity.source() {
        Source::Gradient => scene.draw::<1>(bands, unwatched(), &mut take),
        _ => scene.draw::<0>(bands, unwatched(), &mut take),
    }
    .expect("not stopped");
    all
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

/// A random recipe: seeds in turn for covers of all kinds and for uniform ones, which have the most to save.
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
fn pictures_without_savings() {
    let mut random = Random(23);
    for seed in 0..16 {
        let dataset = recipe(seed, &mut random).dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        for quantity in [Quantity::VonMises, Quantity::Component(1), Quantity::WeightSum] {
            let view = view(&dataset, &mut random);
            let all = drawn::<f64>(&field, &view, &quantity, Savings::ALL);
            let narrow = drawn::<f32>(&field, &view, &quantity, Savings::ALL);
            let none = Savings { strips: false, alone: false, numbers: usize::MAX };
            let plain = drawn::<f64>(&field, &view, &quantity, none);
            let text = format!("{seed} {quantity:?} {view:?}");
            for numbers in [1, 2000] {
                let batches = drawn::<f64>(&field, &view, &quantity, Savings { numbers, ..none });
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
fn pictures_of_grains_are_those_of_strips() {
    let mut random = Random(29);
    let none = Savings { strips: false, alone: false, numbers: usize::MAX };
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
            let plain = drawn::<f64>(&field, &view, &quantity, none);
            let text = format!("{seed} {quantity:?} {view:?}");
            assert_eq!(
                differing(&grains::<f64>(&field, &view, &quantity), &plain, 1e-11),
                0.0,
                "{text}"
            );
            let share = differing(&grains::<f32>(&field, &view, &quantity), &plain, 2e-5);
            assert!(share < 0.01, "{share} in f32, {text}");
        }
    }
}

/// The reference's values where a picture has fewer pixels than patches, or a few for each: on views that cut the cells
/// anyhow, about tips, and with a tip at the centre of a pixel. In f32 within the digits that strips have, too.
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
                let right = crate::reference::reference(&field, &view, &quantity, unwatched());
                let right = right.expect("not stopped").values;
                let text = format!("{quantity:?} {view:?}");
                assert_eq!(
                    differing(&grains::<f64>(&field, &view, &quantity), &right, 1e-11),
                    0.0,
                    "{text}"
                );
                let share = differing(&grains::<f32>(&field, &view, &quantity), &right, 2e-5);
                assert!(share < 0.01, "{share} in f32, {text}");
            }
        }
    }
}

/// Grains are for pictures of many patches; whichever way it is drawn, strips of a picture are the picture.
#[test]
fn many_patches_are_grains() {
    let dataset = Recipe { level: 5, tip_level: 5, ..Recipe::default() }.dataset();
    let field = Field::new(&dataset, 0).expect("a field");
    for (size, has_grains) in [([48, 36], true), ([480, 360], false)] {
        let view = View::fit(dataset.domain.bounds, size).expect("a view");
        let scene = Scene::<f64>::new(&field, &view, &Quantity::VonMises);
        assert_eq!(scene.plan.has_grains, has_grains);
        let (whole, mut strips) = (values(&scene), Vec::new());
        let mut take = |some: Vec<f64>| strips.extend(some);
        render_strips(&field, &view, &Quantity::VonMises, 20, unwatched(), &mut take)
            .expect("not stopped");
        let is_same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits();
        assert!(whole.len() == strips.len() && whole.iter().zip(&strips).all(is_same));
    }
}

/// Functions that are formulas are run for many pixels at a time, as small as cells may be.
#[test]
fn formulas_are_strips() {
    let extra = vec![FunctionKind::formula("x*y^2", Frame::World)];
    let dataset = Recipe { level: 5, tip_level: 5, extra, ..Recipe::default() }.dataset();
    let field = Field::new(&dataset, 0).expect("a field");
    let view = View::fit(dataset.domain.bounds, [48, 36]).expect("a view");
    assert!(!Scene::<f64>::new(&field, &view, &Quantity::VonMises).plan.has_grains);
}

/// Patches and strips of the first tile of a cover.
fn counted(recipe: &Recipe) -> [usize; 2] {
    let dataset = recipe.dataset();
    let field = Field::new(&dataset, 0).expect("a field");
    let view = View::new(dataset.domain.bounds.center(), 1.2, [64, 48]).expect("a view");
    let scene = Scene::<f64>::new(&field, &view, &Quantity::VonMises);
    let tiles = scene.plan.tiles(&(1..2));
    let tile = Tile::<f64, 1>::new(&scene, 0, 1);
    let mut scratch = Scratch::default();
    scratch.shift.resize(2, 0.0);
    scratch.places.resize(scene.functions.table().groups(), 0);
    let list = tiles.of(0, 1);
    assert_eq!(tile.gather(list, &mut scratch, 0.0f64), list.len());
    [list.len(), scratch.strips.all.len()]
}

/// A uniform cover of patches that are all the same has a strip for each column of cells, also where polynomials have frames of
/// their own that are those of the patches above and below; degrees tell patches apart.
#[test]
fn columns_of_a_cover_are_strips() {
    let plain = Recipe { cracks: Vec::new(), level: 2, tip_level: 2, ..Recipe::default() };
    let [patches, strips] = counted(&plain);
    assert!(patches >= 48 && strips <= 17, "{patches} patches, {strips} strips");
    let [_, of_frames] = counted(&Recipe { own_frames: true, ..plain.clone() });
    assert_eq!(of_frames, strips, "the same frames in each column");
    let [patches, of_degrees] = counted(&Recipe { degrees: vec![1, 2, 2], ..plain });
    assert!(of_degrees > strips, "{patches} patches, {of_degrees} strips");
}
