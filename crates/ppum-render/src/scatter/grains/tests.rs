//! Cells of a fifth of a pixel to eight pixels: grains, strips and both in a tile, compared with the evaluation point by point.

use ppum::crack::CrackEnd;
use ppum::dataset::Dataset;
use ppum::domain::Hole;
use ppum::field::Field;
use ppum::formula::Scope;
use ppum::progress::unwatched;
use ppum::quantity::{Quantity, Source};
use ppum::real::{Scalar, narrowed};
use ppum::vec2::{Rect, vec2};
use ppum::weight::WeightFunction;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::{Coefficients, Recipe, crack};

use super::super::collapse::ROWS;
use super::super::lists::{LEAST_SAVING, Lists};
use super::super::strips::Savings;
use super::super::tile::{Band, Scratch};
use super::super::{Sample, Scene};
use crate::reference::reference;
use crate::view::View;

/// Grains wherever a patch is small enough, and only where they are worth it.
const EVERYWHERE: Savings = Savings { least_saving: 0, ..Savings::ALL };
const NOWHERE: Savings = Savings { least_saving: usize::MAX, ..Savings::ALL };

/// True for recipes whose patches have nothing to do with each other.
fn is_rough(seed: u64) -> bool {
    seed % 4 == 3
}

/// Uniform, graded and random covers in turn; all else by chance. Their fields are those of a solver, but for those that are rough.
fn recipe(seed: u64, random: &mut Random) -> Recipe {
    let level = 2 + random.below(3) as u8;
    let weights = WeightFunction::ALL.into_iter().chain([by_formula()]);
    let weight = weights.cycle().nth(random.below(4)).expect("one of four");
    let orders: Vec<u8> = (1..=8).collect();
    let order = 1 + random.below(8) as u8;
    let edge = crack(&[[0.2, 0.35], [0.61, 0.382]], [CrackEnd::Mouth, CrackEnd::Tip]);
    let base = Recipe { seed, ..Recipe::random(seed) };
    Recipe {
        points: 0,
        level,
        random_rounds: if seed % 3 == 2 { 3 } else { 0 },
        tip_level: if seed % 3 == 1 { level + 4 } else { level },
        degrees: if random.below(2) == 0 { vec![order] } else { orders },
        tip_degree: random.below(2) as u8,
        weight,
        jumps: !is_rough(seed) || random.below(2) == 0,
        zone: random.between(0.15, 0.3),
        extra: if is_rough(seed) { base.extra.clone() } else { Vec::new() },
        components: 1 + random.below(2),
        cracks: if random.below(4) == 0 { vec![edge] } else { base.cracks.clone() },
        coefficients: if is_rough(seed) { Coefficients::Random } else { Coefficients::Taylor },
        ..base
    }
}

fn by_formula() -> WeightFunction {
    let scope = Scope::new(&["t"]).expect("t is a name");
    WeightFunction::formula("(1 - t)*(1 + 0.5*t)", &scope).expect("a weight")
}

/// A view around some place in which cells have a fifth of a pixel to eight pixels.
fn view(dataset: &Dataset, random: &mut Random) -> View {
    let bounds = &dataset.domain.bounds;
    let area = bounds.size().x * bounds.size().y;
    let cell = (area / dataset.steps[0].partition.len() as f64).sqrt();
    let pixel = cell / 0.2 * 40f64.powf(-random.unit());
    let pixels = [10 + random.below(120) as u32, 5 + random.below(40) as u32];
    View::new(random.point(bounds), pixel * f64::from(pixels[0]), pixels).expect("a view")
}

fn drawn<T: Sample>(
    field: &Field<'_>,
    view: &View,
    quantity: &Quantity,
    savings: Savings,
) -> Vec<f64> {
    let scene = Scene::<T> { savings, ..Scene::new(field, view, quantity) };
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

fn by_points(field: &Field<'_>, view: &View, quantity: &Quantity) -> Vec<f64> {
    reference(field, view, quantity, unwatched()).expect("a quantity").values
}

fn largest(values: &[f64]) -> f64 {
    values.iter().filter(|v| v.is_finite()).fold(0.0, |most, v| most.max(v.abs()))
}

/// What a quantity may lose to a rounding of size one. A gradient is a difference of products of values with slopes of weights,
/// so it loses |u| / h. Where patches have nothing to do with each other, everything changes by its own size across a cell, and positions, which
/// are rounded by their distance from the anchor or the origin, are h / distance of a cell.
fn condition(field: &Field<'_>, view: &View, quantity: &Quantity, is_rough: bool) -> f64 {
    let by_gradient = quantity.source() == Source::Gradient;
    let components = 0..if by_gradient || is_rough { field.components() } else { 0 };
    let values =
        components.map(|c| largest(&by_points(field, view, &Quantity::Component(c as u8))));
    let most = values.fold(1.0, f64::max);
    let half = field.step.partition.half.iter().map(|half| half.x.min(half.y));
    let half = half.fold(f64::INFINITY, f64::min);
    let far = view.center.length() + view.half().length();
    most * if by_gradient { 1.0 / half } else { 1.0 } * if is_rough { far / half } else { 1.0 }
}

/// The share of the pixels that differ by more than `factor` roundings, by the condition or by their own size.
fn share(found: &[f64], expected: &[f64], condition: f64, [factor, epsilon]: [f64; 2]) -> f64 {
    let near = |k: usize| expected[k.saturating_sub(1)..(k + 2).min(expected.len())].iter();
    let differs = |k: &usize| {
        let (a, b) = (found[*k], expected[*k]);
        let is_same = a == b || a.is_nan() && b.is_nan();
        let size = near(*k).filter(|v| v.is_finite()).fold(0.0f64, |most, v| most.max(v.abs()));
        let is_near = (a - b).abs() <= factor * epsilon * (condition + size);
        !is_same && !is_near
    };
    (0..found.len()).filter(differs).count() as f64 / found.len() as f64
}

fn quantities(field: &Field<'_>, random: &mut Random) -> Vec<Quantity> {
    let patch = random.below(field.step.partition.len()) as u32;
    let formula = if field.components() == 2 { "ux^2 + 3*uy" } else { "2*u" };
    let parsed = Quantity::parse(formula, field).ok();
    let gradient =
        if field.components() == 2 { Quantity::VonMises } else { Quantity::GradientNorm };
    let mut all = vec![
        gradient,
        Quantity::Component(0),
        Quantity::WeightSum,
        Quantity::Overlap,
        Quantity::PartitionFunction(patch),
    ];
    all.extend(parsed);
    all
}

/// Roundings that add up: some hundred operations of a point, of which a share goes in the same direction.
const ROUNDINGS: f64 = 64.0;

#[test]
fn small_cells_are_what_points_are() {
    let mut random = Random(47);
    let mut drawn_by_formula = 0;
    for seed in 0..24 {
        let mut dataset = recipe(seed, &mut random).dataset();
        if seed % 5 == 0 {
            let center = random.point(&dataset.domain.bounds);
            dataset.domain.holes = vec![Hole::Circle { center, radius: 0.07 }];
        }
        let field = Field::new(&dataset, 0).expect("a field");
        for quantity in quantities(&field, &mut random) {
            drawn_by_formula += usize::from(matches!(quantity, Quantity::Formula(_)));
            let view = view(&dataset, &mut random);
            let expected = by_points(&field, &view, &quantity);
            let condition = |is_rough| condition(&field, &view, &quantity, is_rough);
            let [wide_condition, narrow_condition] = [condition(true), condition(is_rough(seed))];
            let text = format!("{seed} {quantity:?} {view:?}");
            for savings in [EVERYWHERE, Savings::ALL] {
                let wide = drawn::<f64>(&field, &view, &quantity, savings);
                let most = share(&wide, &expected, wide_condition, [ROUNDINGS, f64::EPSILON]);
                assert!(most < 1e-3, "{most} in f64, {text}");
                let narrow = drawn::<f32>(&field, &view, &quantity, savings);
                let factor = [ROUNDINGS, f32::EPSILON.into()];
                let most = share(&narrow, &expected, narrow_condition, factor);
                assert!(most < 1e-2, "{most} in f32, {text}");
            }
        }
    }
    assert!(drawn_by_formula > 10, "{drawn_by_formula}");
}

/// Ordinary scenes: f32 has five digits, or what is left of them where |u − shift| / h is larger than 40 times the gradient. A tile
/// is 33 pixels from its middle to its corners.
#[test]
fn five_digits_in_single_precision() {
    for level in [4, 5] {
        let dataset = Recipe { level, tip_level: level + 1, ..Recipe::default() }.dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        let view = View::new(vec2(0.8713, 0.2117), 1.2637, [101, 75]).expect("a view");
        let half = 0.65 * dataset.domain.bounds.size().x / f64::from(4 << level);
        let lost = 2.0 * f64::from(f32::EPSILON) * 33.0 * view.pixel_size() / half;
        let expected = by_points(&field, &view, &Quantity::VonMises);
        let found = drawn::<f32>(&field, &view, &Quantity::VonMises, EVERYWHERE);
        let share = share(&found, &expected, 0.0, [1.0, lost.max(1e-5)]);
        assert!(share < 1e-2, "{share} at level {level}, {lost}");
    }
}

/// The bounds are no excuse: the same field with supports that are larger by a hundredth is not taken for it.
#[test]
fn other_weights_are_noticed() {
    let plain =
        Recipe { level: 5, tip_level: 5, coefficients: Coefficients::Random, ..Recipe::default() };
    let [one, other] = [1.3, 1.313].map(|overlap| Recipe { overlap, ..plain.clone() }.dataset());
    let [one, other] = [&one, &other].map(|dataset| Field::new(dataset, 0).expect("a field"));
    let view = View::new(vec2(0.8713, 0.2117), 1.2637, [101, 75]).expect("a view");
    for quantity in [Quantity::VonMises, Quantity::Component(0)] {
        let expected = by_points(&other, &view, &quantity);
        let condition = condition(&other, &view, &quantity, true);
        let found = drawn::<f64>(&one, &view, &quantity, EVERYWHERE);
        let share = share(&found, &expected, condition, [ROUNDINGS, f64::EPSILON]);
        assert!(share > 0.3, "{share} {quantity:?}");
    }
}

/// Bits of all bands, drawn on lanes without fused operations or by scalars.
fn bits<T: Sample + Scalar>(field: &Field<'_>, view: &View, by_scalars: bool) -> Vec<u64> {
    let scene = Scene::<T> { savings: EVERYWHERE, ..Scene::new(field, view, &Quantity::VonMises) };
    let (mut lists, mut scratch) = (Lists::default(), Scratch::default());
    let [columns, rows] = view.pixels.map(|n| n as usize);
    let mut all = Vec::new();
    for band in 0..rows.div_ceil(ROWS) {
        lists.fill(&scene.plan, band..band + 1, 0);
        let mut out = vec![T::default(); columns * ROWS.min(rows - band * ROWS)];
        let (scene, lists, scratch) = (&scene, &lists, &mut scratch);
        let job = Band::<'_, '_, T, 1> { scene, lists, band, scratch, out: &mut out };
        if by_scalars {
            ppum::real::Job::run(job, T::default());
        } else {
            narrowed(|| T::dispatch(job));
        }
        all.extend(out.into_iter().map(|value| value.to_f64().to_bits()));
    }
    all
}

/// A pixel is added to in the order of the patches, however many lanes there are.
#[test]
fn lanes_do_not_change_a_bit_of_grains() {
    for (seed, level) in [(1, 4), (2, 5)] {
        let recipe = Recipe { level, tip_level: level + 2, ..Recipe::random(seed) };
        let dataset = Recipe { points: 0, random_rounds: 1, ..recipe }.dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        let view = View::new(vec2(0.8713, 0.2117), 1.6, [91, 45]).expect("a view");
        let wide = |by_scalars| bits::<f64>(&field, &view, by_scalars);
        let narrow = |by_scalars| bits::<f32>(&field, &view, by_scalars);
        assert!(wide(true) == wide(false), "f64 at level {level}");
        assert!(narrow(true) == narrow(false), "f32 at level {level}");
    }
}

#[test]
fn threads_do_not_change_a_bit_of_grains() {
    let formula = Recipe { weight: by_formula(), ..Recipe::default() };
    for recipe in [Recipe::default(), formula] {
        let dataset = Recipe { level: 5, tip_level: 7, ..recipe }.dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        let view = View::new(vec2(0.8713, 0.2117), 1.2637, [131, 197]).expect("a view");
        let draw = |threads| {
            let pool =
                rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            let draw = || drawn::<f32>(&field, &view, &Quantity::VonMises, Savings::ALL);
            pool.install(|| draw().into_iter().map(f64::to_bits).collect::<Vec<_>>())
        };
        let one = draw(1);
        assert!(one == draw(2) && one == draw(3));
    }
}

/// Grains and others in all bands of a view of the domain, so many pixels wide.
fn counted(recipe: &Recipe, width: u32, least_saving: usize) -> [usize; 2] {
    let dataset = recipe.dataset();
    let field = Field::new(&dataset, 0).expect("a field");
    let view = View::new(dataset.domain.bounds.center(), 4.0 / 3.0, [width, width * 3 / 4]);
    let view = view.expect("a view");
    let scene = Scene::<f64>::new(&field, &view, &Quantity::VonMises);
    let (mut lists, mut count) = (Lists::<f64>::default(), [0, 0]);
    for band in 0..(view.pixels[1] as usize).div_ceil(ROWS) {
        lists.fill(&scene.plan, band..band + 1, least_saving);
        for tile in 0..scene.plan.columns {
            let list = lists.of(tile, band);
            count[0] += list.grains.len();
            count[1] += list.others.len();
        }
    }
    count
}

/// Cells of 16 pixels have no grains, those of one are nothing else, and large cells beside small ones stay strips.
#[test]
fn grains_are_where_they_save() {
    let uniform =
        |level| Recipe { level, tip_level: level, cracks: Vec::new(), ..Recipe::default() };
    let [grains, others] = counted(&uniform(2), 256, LEAST_SAVING);
    assert!(grains == 0 && others > 192, "{grains} {others}");
    let [grains, others] = counted(&uniform(6), 256, LEAST_SAVING);
    assert!(grains > 40_000 && others == 0, "{grains} {others}");
    let [grains, _] = counted(&uniform(6), 256, usize::MAX);
    assert_eq!(grains, 0);
    let graded = Recipe { level: 2, tip_level: 7, zone: 0.0, ..Recipe::default() };
    let [grains, others] = counted(&graded, 256, 0);
    assert!(grains > 100 && others > 100, "{grains} {others}");
}

/// Many components go through in passes, and a patch may have several blocks of one function.
#[test]
fn passes_of_components_and_blocks_of_one_function() {
    let recipe = Recipe { level: 4, tip_level: 5, components: 5, ..Recipe::default() };
    let mut dataset = recipe.dataset();
    let data = &mut dataset.steps[0].fields[0];
    // the first block of every patch is the sum of two: itself less its constant, and that
    let mut split = data.clone();
    split.patch_blocks = vec![0];
    (split.block_function, split.block_degree, split.block_offset) = Default::default();
    split.coefficients.iter_mut().for_each(Vec::clear);
    for patch in 0..data.patch_blocks.len() - 1 {
        for block in data.blocks(patch) {
            let is_split = data.block_function[block] == 0;
            for part in 0..1 + usize::from(is_split) {
                split.block_function.push(data.block_function[block]);
                split.block_degree.push(data.block_degree[block]);
                split.block_offset.push(split.coefficients[0].len() as u64);
                for (component, all) in split.coefficients.iter_mut().enumerate() {
                    let own = data.block_coefficients(block, component);
                    let of = |k: usize| !is_split || (k == 0) == (part == 1);
                    all.extend(own.iter().enumerate().map(|(k, &c)| if of(k) { c } else { 0.0 }));
                }
            }
        }
        split.patch_blocks.push(split.block_function.len() as u32);
    }
    let whole = dataset.clone();
    dataset.steps[0].fields[0] = split;
    let fields = [&whole, &dataset].map(|dataset| Field::new(dataset, 0).expect("a field"));
    let view = View::new(vec2(0.8713, 0.2117), 1.4, [71, 45]).expect("a view");
    for quantity in (0..5).map(Quantity::Component).chain([Quantity::GradientNorm]) {
        let expected = by_points(&fields[0], &view, &quantity);
        let condition = condition(&fields[0], &view, &quantity, false);
        for field in &fields {
            let found = drawn::<f64>(field, &view, &quantity, EVERYWHERE);
            let share = share(&found, &expected, condition, [ROUNDINGS, f64::EPSILON]);
            assert_eq!(share, 0.0, "{quantity:?}");
        }
    }
}

/// With and without grains rounding alone differs, also where large and small patches share a tile.
#[test]
fn pictures_without_grains() {
    let mut random = Random(5);
    for seed in 0..12 {
        let dataset = recipe(seed, &mut random).dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        for quantity in quantities(&field, &mut random) {
            let view = view(&dataset, &mut random);
            let condition = condition(&field, &view, &quantity, true);
            let [with, without] = [EVERYWHERE, NOWHERE]
                .map(|savings| drawn::<f64>(&field, &view, &quantity, savings));
            let share = share(&with, &without, condition, [ROUNDINGS, f64::EPSILON]);
            assert!(share < 1e-3, "{share} {seed} {quantity:?} {view:?}");
        }
    }
}

/// Displacements that are large beside their differences lose digits by the condition, and no more.
#[test]
fn large_displacements_lose_what_they_must() {
    let mut dataset = Recipe { level: 5, tip_level: 5, ..Recipe::default() }.dataset();
    let data = &mut dataset.steps[0].fields[0];
    for patch in 0..data.patch_blocks.len() - 1 {
        let block =
            data.blocks(patch).find(|&b| data.block_function[b] == 0).expect("a polynomial");
        let offset = data.block_offset[block] as usize;
        data.coefficients.iter_mut().for_each(|all| all[offset] += 1000.0);
    }
    let field = Field::new(&dataset, 0).expect("a field");
    let bounds: &Rect = &dataset.domain.bounds;
    let view = View::new(bounds.center(), 1.2637, [101, 75]).expect("a view");
    let quantity = Quantity::VonMises;
    let (expected, most) =
        (by_points(&field, &view, &quantity), condition(&field, &view, &quantity, false));
    assert!(most > 5e4, "{most}");
    let found = drawn::<f64>(&field, &view, &quantity, EVERYWHERE);
    assert_eq!(share(&found, &expected, most, [ROUNDINGS, f64::EPSILON]), 0.0);
    // the constant is subtracted before numbers are rounded to f32: what is left is some 1 / h
    let narrow = drawn::<f32>(&field, &view, &quantity, EVERYWHERE);
    let share = share(&narrow, &expected, most / 1000.0, [ROUNDINGS, f32::EPSILON.into()]);
    assert!(share < 1e-2, "{share} in f32");
}
