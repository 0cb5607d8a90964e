//! The evaluator of pages against what the program draws and prints.
#![allow(clippy::unwrap_used, reason = "a test may fail anywhere")]

use ppum::crack::Side;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::vec2::{Vec2, vec2};
use ppum_scene::colors::ColorOptions;
use ppum_scene::compose::page_of_view;
use ppum_scene::engine::Engine;
use ppum_scene::magnification::Magnification;
use ppum_scene::overlays::{IsolineLevels, Overlay, Overlays};
use ppum_scene::scene::SceneRequest;
use ppum_scene::subject::ImageSubject;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::{Coefficients, Recipe};

use ppum_page::{Evaluator, ImageRows, PageFrame, PageView, PointQuestion};

fn dataset(seed: u64) -> Dataset {
    let recipe = Recipe { components: 2, ..Recipe::random(seed) };
    Recipe { coefficients: Coefficients::Taylor, ..recipe }.dataset()
}

fn scene(random: &mut Random) -> SceneRequest {
    let quantities = ["ux", "magnitude", "duy_dx + ux^2", "patch:level"];
    let shown = vec![Overlay::Cracks, random.pick(&[Overlay::Cells, Overlay::Patches])];
    let isolines = (random.below(2) == 0).then_some(IsolineLevels::Auto);
    SceneRequest {
        quantity: Some(random.pick(&quantities).to_owned()),
        colors: ColorOptions { colormap: Some("vik".to_owned()), ..ColorOptions::default() },
        overlays: Overlays { shown, isolines, ..Overlays::default() },
        ..SceneRequest::default()
    }
}

fn view(random: &mut Random, dataset: &Dataset) -> PageView {
    let (bounds, pixels) = (dataset.domain.bounds, [90, 70]);
    let part = vec2(random.between(0.2, 0.8), random.between(0.2, 0.8));
    let center = bounds.min + vec2(part.x * bounds.size().x, part.y * bounds.size().y);
    PageView { center: center.into(), width: random.between(0.05, 1.5) * bounds.size().x, pixels }
}

fn frame(random: &mut Random, dataset: &Dataset) -> PageFrame {
    let (scene, view) = (scene(random), view(random, dataset));
    PageFrame { scene, view, file: "plate.h5".to_owned(), keeps_range: false }
}

/// The values of an image, evaluated in two parts.
fn values(evaluator: &mut Evaluator<'_>, frame: &PageFrame) -> Vec<f64> {
    let parts = [[0, 64], [64, frame.view.pixels[1]]].map(|rows| {
        evaluator.rows(&ImageRows { frame: frame.clone(), rows }).expect("rows of the image")
    });
    parts.concat()
}

fn subject<'a>(dataset: &'a Dataset, field: &'a Field<'a>, frame: &PageFrame) -> ImageSubject<'a> {
    ImageSubject::new(dataset, field, frame.scene.quantity.as_deref()).unwrap()
}

/// Byte for byte, whatever is shown.
#[test]
fn images_are_those_of_the_program() {
    let mut random = Random(34);
    for seed in 0..8 {
        let dataset = dataset(seed);
        let field = Field::new(&dataset, 0).unwrap();
        let mut evaluator = Evaluator::new(&dataset);
        for _ in 0..3 {
            let frame = frame(&mut random, &dataset);
            let values = values(&mut evaluator, &frame);
            let painted = evaluator.paint(&frame, values).unwrap();
            let (subject, request) =
                (subject(&dataset, &field, &frame), frame.scene.clone().into());
            let engine = Engine::processor(unwatched());
            let view = frame.view.checked().unwrap();
            let (page, _) = page_of_view(&subject, &request, &view, None, &engine).unwrap();
            assert!(page.image() == painted.image, "{frame:?}");
            assert!(painted.legend.command.starts_with("ppum render plate.h5 -o image.png"));
            assert!(!painted.legend.colors.is_empty());
        }
    }
}

/// Deformed bodies, mirrored ones and both are drawn whatever rows are given, and a pixel of an
/// image shows what is read there.
#[test]
fn deformed_and_mirrored_bodies_are_those_of_the_program() {
    let mut random = Random(54);
    for seed in 0..4 {
        let dataset = dataset(seed);
        let (field, bounds) = (Field::new(&dataset, 0).unwrap(), dataset.domain.bounds);
        let mut evaluator = Evaluator::new(&dataset);
        for (deformed, mirror) in [(true, false), (false, true), (true, true)] {
            let mut frame = frame(&mut random, &dataset);
            frame.scene.overlays.shown = vec![Overlay::Cracks, Overlay::Cells];
            frame.scene.quantity = Some("ux".to_owned());
            frame.scene.deformed = deformed.then_some(Magnification::Given(0.04));
            frame.scene.mirror = mirror.then(|| "left,bottom:antisymmetric".parse().unwrap());
            frame.view.center = bounds.min.into();
            frame.view.width = 2.3 * bounds.size().x;
            let values = values(&mut evaluator, &frame);
            assert!(values.is_empty());
            let painted = evaluator.paint(&frame, values).unwrap();
            let (subject, request) =
                (subject(&dataset, &field, &frame), frame.scene.clone().into());
            let engine = Engine::processor(unwatched());
            let view = frame.view.checked().unwrap();
            let (page, shot) = page_of_view(&subject, &request, &view, None, &engine).unwrap();
            assert!(page.image() == painted.image, "{frame:?}");
            let [columns, rows] = view.pixels;
            let (mut asked, mut read) = (0, 0);
            for _ in 0..60 {
                let [i, j] = [random.below(columns as usize), random.below(rows as usize)];
                let pixel = [i as f64 + 0.5, j as f64 + 0.5];
                let question = PointQuestion { frame: frame.clone(), pixel, reach: 0.0 };
                let reading = evaluator.probe(&question).unwrap();
                let drawn = painted.values[j * columns as usize + i];
                if !reading.is_inside || reading.sides.len() != 1 || drawn.is_nan() {
                    continue;
                }
                let value: f64 = reading.sides[0].exact.parse().unwrap();
                let size = shot.picture.normalization.max().abs();
                asked += 1;
                // of parts that lie over each other either may be read
                read += usize::from((value - drawn).abs() <= 1e-3 * size.max(value.abs()));
            }
            let enough = asked > 5 && 10 * read >= 8 * asked;
            assert!(enough, "{deformed} {mirror}: {read} of {asked}");
        }
    }
}

/// Colours of the values before need no values of their own.
#[test]
fn values_are_given_back() {
    let dataset = dataset(3);
    let (mut random, mut evaluator) = (Random(5), Evaluator::new(&dataset));
    let mut frame = frame(&mut random, &dataset);
    frame.scene.quantity = Some("ux".to_owned());
    let values = values(&mut evaluator, &frame);
    let painted = evaluator.paint(&frame, values.clone()).unwrap();
    assert!(values.iter().zip(&painted.values).all(|(a, b)| a.to_bits() == b.to_bits()));
    frame.scene.colors.colormap = Some("magma".to_owned());
    let other = evaluator.paint(&frame, painted.values).unwrap();
    assert!(other.image != painted.image);
    assert!(evaluator.paint(&frame, vec![0.0; 3]).is_err(), "not one value for each pixel");
}

#[test]
fn a_range_is_kept_while_the_view_moves() {
    let dataset = dataset(1);
    let (mut random, mut evaluator) = (Random(6), Evaluator::new(&dataset));
    let mut frame = frame(&mut random, &dataset);
    frame.scene.quantity = Some("ux".to_owned());
    let mut range = |frame: &PageFrame| {
        let values = values(&mut evaluator, frame);
        evaluator.paint(frame, values).unwrap().legend.range
    };
    let first = range(&frame);
    frame.view.width *= 0.25;
    assert_ne!(range(&frame), first, "another view has another range");
    frame.view.width *= 4.0;
    assert_eq!(range(&frame), first);
    (frame.view.width, frame.keeps_range) = (0.25 * frame.view.width, true);
    assert_eq!(range(&frame), first);
    frame.scene.quantity = Some("uy".to_owned());
    assert_ne!(range(&frame), first, "another quantity has a range of its own");
}

/// The exact texts are the digits of the field's own values, inside and outside.
#[test]
fn values_at_points_are_those_of_the_field() {
    let mut random = Random(8);
    for seed in 0..8 {
        let dataset = dataset(seed);
        let field = Field::new(&dataset, 0).unwrap();
        let mut evaluator = Evaluator::new(&dataset);
        let mut frame = frame(&mut random, &dataset);
        frame.scene.quantity = Some("duy_dx + ux^2".to_owned());
        let quantity = Quantity::parse("duy_dx + ux^2", &field).unwrap();
        for _ in 0..20 {
            let pixel = [random.between(0.0, 90.0), random.between(0.0, 70.0)];
            let question = PointQuestion { frame: frame.clone(), pixel, reach: 0.0 };
            let reading = evaluator.probe(&question).unwrap();
            let mut local = field.at(reading.anchor.into());
            let offset = Vec2::from(reading.offset);
            let value = quantity.at(&mut local, offset, Side::Above);
            let [side] = &reading.sides[..] else { panic!("one side: {reading:?}") };
            let found: f64 = side.exact.parse().expect("a number");
            let is_same = (found - value).abs() <= 1e-12 * value.abs().max(1.0);
            assert!(is_same || found.is_nan() && value.is_nan(), "{found} {value}");
            assert_eq!(reading.is_inside, local.contains(offset));
        }
    }
}

/// Within reach of a crack both of its sides are read, and at a tip the tip.
#[test]
fn cracks_and_tips_take_the_place_of_points_beside_them() {
    let dataset = Recipe::default().dataset();
    let crack = dataset.steps[0].cracks[0].clone();
    let [a, b] = [crack.points[0], crack.points[1]];
    let mut evaluator = Evaluator::new(&dataset);
    let (middle, across) = ((a + b) * 0.5, vec2(a.y - b.y, b.x - a.x).unit());
    let view = PageView { center: middle.into(), width: (b - a).length(), pixels: [200, 150] };
    let scene = SceneRequest { quantity: Some("ux".to_owned()), ..SceneRequest::default() };
    let frame = PageFrame { scene, view, file: String::new(), keeps_range: false };
    let checked = view.checked().unwrap();
    let at = checked.pixel(middle + across * (3.0 * checked.pixel_size()));
    let question = |reach| PointQuestion { frame: frame.clone(), pixel: at.into(), reach };
    let near = evaluator.probe(&question(4.0)).unwrap();
    let names: Vec<_> = near.sides.iter().filter_map(|side| side.name.as_deref()).collect();
    assert_eq!(names, ["above", "below"]);
    let [above, below]: [f64; 2] = [0, 1].map(|k: usize| near.sides[k].exact.parse().unwrap());
    assert!(above != below && near.jump.is_some());
    assert_eq!(evaluator.probe(&question(2.0)).unwrap().sides.len(), 1);
    let tip = PageView { center: a.into(), ..view };
    let frame = PageFrame { view: tip, ..frame.clone() };
    let question = PointQuestion { frame, pixel: [101.0, 76.0], reach: 3.0 };
    let reading = evaluator.probe(&question).unwrap();
    assert_eq!((reading.tip, reading.anchor, reading.offset), (Some(0), a.into(), [0.0; 2]));
}

#[test]
fn what_is_not_there_is_an_error() {
    let dataset = dataset(2);
    let (mut random, mut evaluator) = (Random(1), Evaluator::new(&dataset));
    let good = frame(&mut random, &dataset);
    let ask = |evaluator: &mut Evaluator<'_>, change: &dyn Fn(&mut PageFrame), rows| {
        let mut frame = good.clone();
        change(&mut frame);
        evaluator.rows(&ImageRows { frame, rows }).map(|_| ()).map_err(|error| error.to_string())
    };
    assert_eq!(ask(&mut evaluator, &|_| {}, [0, 32]), Ok(()));
    for rows in [[1, 32], [0, 71], [64, 32]] {
        assert!(ask(&mut evaluator, &|_| {}, rows).is_err(), "{rows:?}");
    }
    let quantity: &dyn Fn(&mut PageFrame) = &|f| f.scene.quantity = Some("nothing".to_owned());
    let step: &dyn Fn(&mut PageFrame) = &|f| f.scene.subject.step = Some(7);
    let width: &dyn Fn(&mut PageFrame) = &|f| f.view.width = 0.0;
    for change in [quantity, step, width] {
        assert!(ask(&mut evaluator, change, [0, 32]).is_err());
    }
    assert!(evaluator.describe(7).is_err());
    let names = evaluator.describe(0).unwrap();
    assert!(names.quantities.iter().any(|choice| choice.text == "ux"));
}
