//! The difference of two views, held against the fields of both, evaluated here by themselves.

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicUsize;
use std::sync::{Arc, LazyLock};

use egui::{Key, Modifiers, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use ppum::crack::{SegmentId, Side};
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::vec2::{Vec2, vec2 as v};
use ppum_fracture::solve::solve;
use ppum_problem::Problem;
use ppum_render::range::RangeChoice;
use ppum_render::resample::norms::DifferenceNorms;
use ppum_render::scatter::render;
use ppum_scene::colors::ColorOptions;
use ppum_scene::location::Location;
use ppum_scene::magnification::Magnification;
use ppum_scene::request::FigureTexts;
use ppum_scene::values::RasterValues;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::growing;
use ppum_viewer::Viewer;
use ppum_viewer::export::PageSize;
use ppum_viewer::frames::{Backend, FaultOrigin, RenderedFrame};
use ppum_viewer::measure::probe::ProbeReading;
use ppum_viewer::session::{Session, VisibleRegion};

use crate::kit::{plate, settle, show_until};

type Window = Harness<'static, Viewer>;

/// A plate with a crack, refined so many times.
fn refined(level: usize) -> Dataset {
    static LEVELS: LazyLock<Vec<Dataset>> = LazyLock::new(|| {
        (3..=6)
            .map(|level| {
                let text = include_str!("../../../../examples/centre-crack.toml");
                let text = text.replace("level = 6", &format!("level = {level}"));
                let problem =
                    Problem::parse(&text, "plate", Path::new(".")).expect("it is a problem");
                solve(&problem, unwatched()).expect("it can be solved")
            })
            .collect()
    });
    LEVELS[level - 3].clone()
}

/// A window with two views whose difference is shown on the right.
fn pair(left: Dataset, right: Dataset, size: [f32; 2], backend: Backend) -> Window {
    let [left, right] = [left, right].map(Arc::new);
    let builder = Harness::builder().with_size(size).with_max_steps(1000).with_step_dt(0.05);
    let mut window = builder.build_eframe(|cc| {
        let mut viewer = Viewer::with_backend(&cc.egui_ctx, Session::default(), backend);
        viewer.open(None, left);
        viewer
    });
    settle(&mut window);
    window.key_press_modifiers(Modifiers::SHIFT, Key::V);
    window.step();
    assert_eq!(window.state().session.active, 1);
    window.state_mut().open(None, right);
    settle(&mut window);
    window
}

const SIZE: [f32; 2] = [1200.0, 700.0];

fn frame(window: &Window) -> Arc<RenderedFrame> {
    Arc::clone(window.state().viewports[1].frames.newest().expect("a picture on the right"))
}

fn values(window: &Window) -> Vec<f64> {
    match &frame(window).drawn.values {
        RasterValues::Double(raster) => raster.values.clone(),
        RasterValues::Single(_) => panic!("a difference is drawn in double precision"),
    }
}

fn norms(window: &Window) -> DifferenceNorms {
    frame(window).norms.expect("it is drawn")
}

/// A value of a quantity at a point of a dataset.
fn value(dataset: &Dataset, step: usize, text: &str, spot: &Location) -> f64 {
    let field = Field::new(dataset, step).expect("a field");
    let quantity = Quantity::parse(text, &field).expect("a quantity");
    quantity.at(&mut field.at(spot.anchor()), spot.offset(), Side::Above)
}

/// Moves the pointer to a place of the right view.
fn hover(window: &mut Window, offset: Vec2) -> ProbeReading {
    let viewport = &window.state().viewports[1];
    let view = viewport.camera.view.expect("it is shown");
    let rect = window.query_all_by_label("Plate").last().expect("two plates").rect();
    let pixel =
        view.pixel_of_offset(offset) * (f64::from(rect.width()) / f64::from(view.pixels[0]));
    window.hover_at(rect.min + vec2(pixel.x as f32, pixel.y as f32));
    settle(window);
    window.state().viewports[1].tools.hover.clone().expect("the pointer is over the plate")
}

fn has_label(window: &Window, part: &str) -> bool {
    window.query_all_by_label_contains(part).next().is_some()
}

#[test]
fn a_key_shows_the_difference_and_takes_it_back() {
    let mut window = crate::kit::window(plate(), SIZE);
    window.state_mut().session.panes[0].scene.colors.colormap = Some("magma".into());
    window.key_press_modifiers(Modifiers::SHIFT, Key::V);
    window.run_steps(2);
    settle(&mut window);
    // of one and the same there is none, and that is said
    let session = &window.state().session;
    assert!(session.panes.len() == 2 && session.minus.is_shown && session.linked);
    assert!(values(&window).iter().all(|value| *value == 0.0 || value.is_nan()));
    assert!(has_label(&window, "right − left") && has_label(&window, "no difference in this view"));
    assert_eq!(frame(&window).words()[0], "von Mises stress (right − left)");
    // its colours are its own
    assert_eq!(frame(&window).default_map(), "coolwarm");
    assert_eq!(window.state().session.panes[1].scene.colors, ColorOptions::default());
    window.state_mut().session.panes[1].scene.colors.colormap = Some("vik".into());
    window.state_mut().session.active = 0;
    settle(&mut window);
    window.key_press_modifiers(Modifiers::SHIFT, Key::V);
    window.run_steps(2);
    settle(&mut window);
    assert!(frame(&window).left.is_none());
    let map = |window: &Window| window.state().session.panes[1].scene.colors.colormap.clone();
    assert_eq!(map(&window).as_deref(), Some("magma"));
    window.key_press_modifiers(Modifiers::SHIFT, Key::V);
    window.run_steps(2);
    settle(&mut window);
    assert_eq!(map(&window).as_deref(), Some("vik"));
    assert_eq!(window.state().session.active, 1, "the panels are those of the difference");
    // one view has no difference, and its colours are those of its values
    window.key_press(Key::V);
    settle(&mut window);
    let session = &window.state().session;
    assert!(session.panes.len() == 1 && !session.minus.is_shown);
    // how many steps there are depends on how long pictures took: what rests is a step
    let is_back = |window: &Window| {
        let session = &window.state().session;
        !session.minus.is_shown && session.panes.len() == 2
    };
    for _ in 0..8 {
        if !is_back(&window) {
            window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
            window.step();
            settle(&mut window);
        }
    }
    assert!(is_back(&window));
}

#[test]
fn the_switch_of_the_panel_is_the_key() {
    let mut window = crate::kit::window(plate(), [1100.0, 1400.0]);
    window.get_by_label("Compare").click();
    window.run_steps(30);
    window.get_by_label("right − left").click();
    window.run_steps(2);
    settle(&mut window);
    assert!(window.state().session.minus.is_shown);
    let frame = frame(&window);
    assert!(frame.is_final && frame.left.is_some());
}

/// Two quantities: at every pixel the values of one minus those of the other, whatever is moved,
/// sized and chosen.
#[test]
fn any_two_views_are_subtracted_pixel_by_pixel() {
    let mut random = Random(25);
    let mut window = pair(refined(3), refined(4), [900.0, 500.0], Backend::Cpu);
    let mut seen = 0;
    for _ in 0..8 {
        let all = ["von-mises", "ux", "uy", "sxx - syy", "energy"];
        let texts = [0, 1].map(|_| random.pick(&all));
        for (pane, text) in window.state_mut().session.panes.iter_mut().zip(texts) {
            pane.scene.quantity = Some(text.into());
        }
        let width = 10f64.powf(random.between(-7.0, 0.3));
        let center = [random.between(-0.9, 0.9), random.between(-0.9, 0.9)];
        let place = Some(VisibleRegion { center, width });
        window.state_mut().session.panes.iter_mut().for_each(|pane| pane.place = place);
        let size = [random.between(500.0, 700.0), random.between(300.0, 500.0)];
        window.set_size(vec2(size[0] as f32, size[1] as f32));
        settle(&mut window);
        let frame = frame(&window);
        assert!(
            frame.is_final && frame.drawn.view == window.state().viewports[1].camera.view.unwrap()
        );
        let [left, right] = [refined(3), refined(4)].map(Arc::new);
        let rasters = [(&left, texts[0]), (&right, texts[1])].map(|(dataset, text)| {
            let field = Field::new(dataset, 0).expect("a field");
            let quantity = Quantity::parse(text, &field).expect("a quantity");
            render::<f64>(&field, &frame.drawn.view, &quantity, unwatched()).expect("it is drawn")
        });
        for ((found, left), right) in
            values(&window).iter().zip(&rasters[0].values).zip(&rasters[1].values)
        {
            let want = right - left;
            assert!(*found == want || found.is_nan() && want.is_nan(), "{found} {want}");
            seen += usize::from(*found != 0.0 && !found.is_nan());
        }
    }
    assert!(seen > 100_000, "{seen}");
}

/// What is read is right − left at the point itself, each side by its own field, at any depth.
#[test]
fn readings_are_differences_of_two_evaluations() {
    let datasets = [refined(3), refined(4)];
    let mut window = pair(refined(3), refined(4), SIZE, Backend::Cpu);
    let tip = datasets[0].steps[0].cracks[0].points[1];
    let mut random = Random(8);
    for (center, width) in [(v(0.2, 0.1), 1.5), (tip, 1e-3), (tip, 1e-6), (tip, 2e-12)] {
        let place = Some(VisibleRegion { center: center.into(), width });
        window.state_mut().session.panes.iter_mut().for_each(|pane| pane.place = place);
        settle(&mut window);
        for _ in 0..4 {
            let [x, y] = [0, 1].map(|_| random.between(0.05, 0.25) * random.pick(&[-1.0, 1.0]));
            // away from the bar
            let offset = v(-x.abs(), y) * width;
            let read = hover(&mut window, offset);
            let [left, right] = [0, 1].map(|k| value(&datasets[k], 0, "von-mises", &read.spot));
            let [sided] = read.sides[..] else { panic!("one value: {read:?}") };
            let size = left.abs().max(right.abs());
            assert!((sided.value - (right - left)).abs() <= 1e-12 * size, "{width} {sided:?}");
            let terms = sided.terms.expect("a difference has two sides");
            for (found, want) in terms.into_iter().zip([right, left]) {
                assert!((found - want).abs() <= 1e-12 * size, "{found} {want}");
            }
        }
    }
    assert!(has_label(&window, "Δ von-mises = ") && has_label(&window, "right "));
}

#[test]
fn on_a_crack_both_sides_are_subtracted() {
    let datasets = [refined(3), refined(4)];
    let mut window = pair(refined(3), refined(4), SIZE, Backend::Cpu);
    window.state_mut().session.panes.iter_mut().for_each(|p| p.scene.quantity = Some("uy".into()));
    settle(&mut window);
    let points = &datasets[0].steps[0].cracks[0].points;
    let center = frame(&window).drawn.view.center;
    let read = hover(&mut window, points[0] + (points[1] - points[0]) * 0.4 - center);
    let sides = [0, 1].map(|k| {
        let field = Field::new(&datasets[k], 0).expect("a field");
        let uy = Quantity::parse("uy", &field).expect("a quantity");
        let mut local = field.on(SegmentId { crack: 0, segment: 0 }, read.spot.anchor());
        [Side::Above, Side::Below].map(|side| uy.at(&mut local, read.spot.offset(), side))
    });
    let found: Vec<f64> = read.sides.iter().map(|sided| sided.value).collect();
    assert_eq!(found, [sides[1][0] - sides[0][0], sides[1][1] - sides[0][1]]);
    // pinned, it is in the table with its two terms
    window.key_press(Key::P);
    settle(&mut window);
    let probes = window.state().viewports[1].tools.probes.clone();
    let names = ["Δ uy".to_owned(), String::new()];
    let csv = ppum_viewer::panels::probes::table(&probes, &names).csv();
    let mut rows = csv.lines();
    assert!(rows.next().is_some_and(|row| row.ends_with("right,left")), "{csv}");
    let last = rows.last().expect("a row below the crack");
    let terms: Vec<f64> = last.rsplit(',').take(2).map(|n| n.parse().unwrap()).collect();
    assert_eq!(terms, [sides[0][1], sides[1][1]]);
}

/// Two steps of a crack that grows: where it has not yet been, it has one value for both faces.
#[test]
fn steps_with_different_cracks_are_subtracted() {
    let dataset = growing(3);
    let mut window = pair(dataset.clone(), dataset.clone(), SIZE, Backend::Cpu);
    let uy = Some("uy".to_owned());
    for (k, pane) in window.state_mut().session.panes.iter_mut().enumerate() {
        (pane.scene.subject.step, pane.scene.quantity) = (Some(2 * k), uy.clone());
    }
    settle(&mut window);
    let [short, long] = [0, 2].map(|step: usize| dataset.steps[step].cracks.clone());
    let crack = (0..long.len()).find(|&k| short.get(k) != Some(&long[k])).expect("one that grows");
    let points = &long[crack].points;
    let is_new = |p: Vec2| {
        short.iter().flat_map(|c| c.points.windows(2)).all(|s| {
            let way = (s[1] - s[0]).unit();
            (p - s[0] - way * (p - s[0]).dot(way)).length() > 1e-6
                || (p - s[0]).dot(way) > (s[1] - s[0]).length()
                || (p - s[0]).dot(way) < 0.0
        })
    };
    let (segment, point) = (points.windows(2).enumerate())
        .map(|(k, ends)| (k as u32, ends[0] + (ends[1] - ends[0]) * 0.5))
        .find(|(_, middle)| is_new(*middle))
        .expect("a part that is new");
    let center = frame(&window).drawn.view.center;
    let read = hover(&mut window, point - center);
    assert_eq!(read.sides.len(), 2, "{read:?}");
    let old = value(&dataset, 0, "uy", &read.spot);
    let field = Field::new(&dataset, 2).expect("a field");
    let quantity = Quantity::parse("uy", &field).expect("a quantity");
    let mut local = field.on(SegmentId { crack: crack as u32, segment }, read.spot.anchor());
    for (sided, side) in read.sides.iter().zip([Side::Above, Side::Below]) {
        let new = quantity.at(&mut local, read.spot.offset(), side);
        assert!((sided.value - (new - old)).abs() <= 1e-12 * (new.abs() + old.abs()), "{sided:?}");
    }
    // exchanged, the signs are, whichever of the two has the crack
    for (k, pane) in window.state_mut().session.panes.iter_mut().enumerate() {
        pane.scene.subject.step = Some(2 - 2 * k);
    }
    settle(&mut window);
    let back = hover(&mut window, point - center);
    assert_eq!(back.sides.len(), 2);
    for (there, back) in read.sides.iter().zip(&back.sides) {
        assert!((there.value + back.value).abs() <= 1e-9 * there.value.abs(), "{there:?} {back:?}");
    }
}

/// What is refined further differs less from what it was.
#[test]
fn refinement_makes_differences_small() {
    let apart: Vec<f64> = [(3, 4), (4, 5), (5, 6)]
        .into_iter()
        .map(|(coarse, fine)| {
            let mut window = pair(refined(coarse), refined(fine), [700.0, 400.0], Backend::Cpu);
            let panes = &mut window.state_mut().session.panes;
            panes.iter_mut().for_each(|pane| pane.scene.quantity = Some("uy".into()));
            settle(&mut window);
            norms(&window).relative()[1]
        })
        .collect();
    assert!(apart[0] > 1.2 * apart[1] && apart[1] > 1.2 * apart[2], "{apart:?}");
}

/// The largest difference is told with its place, and it is that of the pixels.
#[test]
fn the_extrema_are_those_of_the_pixels() {
    let mut window = pair(refined(3), refined(4), SIZE, Backend::Cpu);
    window.state_mut().session.panes.iter_mut().for_each(|p| p.scene.quantity = Some("uy".into()));
    settle(&mut window);
    let frame = frame(&window);
    let found = frame.colored.span.values.as_ref().expect("they are looked for");
    let known = values(&window).into_iter().filter(|value| !value.is_nan());
    let [least, most] = known
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], value| [a.min(value), b.max(value)]);
    assert_eq!([found.min.value, found.max.value], [least, most]);
    assert_eq!(norms(&window).absolute[2], most.max(-least));
    let norm = &frame.colored.normalization;
    assert!(norm.min() == -norm.max());
    assert!(has_label(&window, "L∞"));
}

/// Whatever draws single views, differences are drawn in double precision, to the same bit.
#[test]
fn every_backend_draws_the_same_difference() {
    let drawn = [Backend::Cpu, Backend::Gpu].map(|backend| {
        let window = pair(refined(3), refined(4), [700.0, 400.0], backend);
        values(&window)
    });
    let is_same = |(a, b): (&f64, &f64)| a == b || a.is_nan() && b.is_nan();
    assert!(drawn[0].len() == drawn[1].len() && drawn[0].iter().zip(&drawn[1]).all(is_same));
}

#[test]
fn who_moves_sees_differences_and_rests_with_exact_ones() {
    let mut window = pair(refined(3), refined(4), [900.0, 500.0], Backend::Cpu);
    let pixel = frame(&window).drawn.view.pixel_size();
    for _ in 0..12 {
        let view = window.state().viewports[1].camera.view.expect("it is shown");
        let center = view.center + v(5.0, -2.0) * pixel;
        let place = Some(VisibleRegion { center: center.into(), width: view.width });
        window.state_mut().session.panes.iter_mut().for_each(|pane| pane.place = place);
        show_until(&mut window, "the new place is drawn", |window| {
            let newest = frame(window);
            assert!(newest.left.is_some());
            Some(newest.request.view) == window.state().viewports[1].camera.view
        });
    }
    settle(&mut window);
    let last = frame(&window);
    assert!(last.is_final && last.drawn.by == "cpu f64");
    assert!(last.drawn.view == window.state().viewports[1].camera.view.unwrap());
}

#[test]
fn what_cannot_be_subtracted_is_told_on_the_plate() {
    let mut window = pair(refined(3), refined(4), SIZE, Backend::Cpu);
    let before = frame(&window);
    // the deformed plate
    window.state_mut().session.panes[1].scene.deformed = Some(Magnification::Auto);
    settle(&mut window);
    let fault =
        |window: &Window| window.state().viewports[1].frames.failure().map(|failure| failure.fault);
    assert_eq!(fault(&window), Some(FaultOrigin::Minus));
    assert!(has_label(&window, "of the deformed plate there is no difference"));
    assert!(Arc::ptr_eq(&before, &frame(&window)), "the last picture stays");
    window.state_mut().session.panes[1].scene.deformed = None;
    // a mistake on the left
    window.state_mut().session.panes[0].scene.quantity = Some("uy +".into());
    settle(&mut window);
    assert_eq!(fault(&window), Some(FaultOrigin::Minus));
    assert!(has_label(&window, "on the left: "));
    // units
    window.state_mut().session.panes[0].scene.quantity = Some("energy".into());
    settle(&mut window);
    assert_eq!(fault(&window), None);
    // the panel of a comparison with grids
    window.key_press(Key::C);
    settle(&mut window);
    assert!(frame(&window).other.is_none() && fault(&window).is_none());
    // nothing open
    window.state_mut().viewports[0].opened = None;
    settle(&mut window);
    assert!(has_label(&window, "nothing is open on the left"));
}

/// The pixels of a PNG as it holds them, without its texts.
fn pixels(png: &[u8]) -> &[u8] {
    let at = |name: &[u8]| png.windows(4).position(|w| w == name).expect("a chunk");
    &png[at(b"IDAT")..at(b"IEND")]
}

/// A picture of the difference can be saved, a command of it is refused with a reason.
#[test]
fn pictures_of_differences_are_saved() {
    let mut window = pair(refined(3), refined(4), [700.0, 400.0], Backend::Cpu);
    let frame = frame(&window);
    let mut scene = window.state().session.panes[1].scene.clone();
    // they lie over the picture in the window, and in it in the file
    scene.overlays = ppum_scene::overlays::Overlays::default();
    let order = ppum_viewer::export::ImageExport {
        field: Arc::clone(&frame.field),
        file: Some(PathBuf::from("plate.h5")),
        left: frame.left.clone(),
        scene,
        view: frame.drawn.view,
        page: PageSize::pixels(frame.drawn.view.pixels),
        choice: ppum_viewer::export::ExportChoice::Image,
        motion: ppum_viewer::export::Motion::default(),
        texts: FigureTexts { title: Some("Coarse against fine".into()), ..FigureTexts::default() },
    };
    let (bytes, _) = order
        .bytes(Path::new("apart.png"), unwatched(), &AtomicUsize::new(0))
        .expect("it is drawn");
    let seen = ppum_render::png::encode(&frame.colored.image, &[]).expect("it is encoded");
    assert!(pixels(&bytes) == pixels(&seen), "what is seen is what is saved");
    let figure = ppum_viewer::export::ImageExport {
        choice: ppum_viewer::export::ExportChoice::Figure,
        page: PageSize::pixels([500, 400]),
        ..order
    };
    let (bytes, _) = figure
        .bytes(Path::new("apart.svg"), unwatched(), &AtomicUsize::new(0))
        .expect("it is drawn");
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.contains("right − left"), "{}", &text[..text.len().min(3000)]);
    assert!(text.contains("Coarse against fine"), "a title of one's own");
    assert!(figure.command(Path::new("apart.png")).is_err_and(|why| why.contains("no command")));
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::C);
    settle(&mut window);
    assert!(has_label(&window, "no command draws the difference"));
}

/// The range of the whole plate is that of the difference.
#[test]
fn the_range_of_the_whole_plate_is_of_the_difference() {
    let mut window = pair(refined(3), refined(4), [1200.0, 1400.0], Backend::Cpu);
    window.get_by_label("whole plate").click();
    show_until(&mut window, "the range is found", |window| {
        window.state().session.panes[1].scene.colors.range != RangeChoice::Auto
    });
    settle(&mut window);
    let RangeChoice::Fixed(min, max) = window.state().session.panes[1].scene.colors.range else {
        panic!("it is found")
    };
    assert_eq!(min, -max);
    // far below the stresses themselves
    assert!(max < 0.5 * norms(&window).field[2] && max > 0.0, "{max}");
}
