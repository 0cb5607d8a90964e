use std::sync::{Arc, mpsc};
use std::time::{Duration, Instant};

use ppum::dataset::Dataset;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::vec2::vec2;
use ppum_render::colormap::Colormap;
use ppum_render::raster::Raster;
use ppum_render::resample::Interpolation;
use ppum_render::resample::norms::norms;
use ppum_render::scatter::render;
use ppum_render::view::View;
use ppum_scene::body::BodyView;
use ppum_scene::coloring::value_span;
use ppum_scene::compare::Compare;
use ppum_scene::engine::Engine;
use ppum_scene::magnification::Magnification;
use ppum_scene::mirror_lines::MirrorLines;
use ppum_scene::overlays::{IsolineLevels, Overlay};
use ppum_scene::scene::SceneRequest;
use ppum_scene::subject::ImageSubject;
use ppum_scene::values::{PixelValues, RasterValues};
use ppum_testkit::synthetic::Recipe;

use super::maker::{FrameMaker, FrameStop, NextStep, Patience};
use super::request::{AskStatus, LatestRequest, RequestStatus};
use super::worker;
use super::{Backend, FrameRequest, PaneFrames, RenderedFrame, SubtractedImage};

const PIXELS: [u32; 2] = [243, 181];

fn dataset() -> Arc<Dataset> {
    Arc::new(Recipe::default().dataset())
}

fn wanted(dataset: &Arc<Dataset>) -> FrameRequest {
    let view = View::new(dataset.domain.bounds.center(), 1.4, PIXELS).unwrap();
    FrameRequest::new(Arc::clone(dataset), SceneRequest::default(), view)
}

/// Returns the request, so many pixels further right and down.
fn beside(wanted: &FrameRequest, columns: f64, rows: f64) -> FrameRequest {
    let by = vec2(columns, -rows) * wanted.view.pixel_size();
    FrameRequest { view: View { center: wanted.view.center + by, ..wanted.view }, ..wanted.clone() }
}

fn maker() -> FrameMaker {
    FrameMaker::new(Backend::Cpu)
}

/// All frames up to the final one; time passes from step to step.
fn finished(maker: &mut FrameMaker, wanted: &FrameRequest) -> Vec<Arc<RenderedFrame>> {
    let (wish, mut now) =
        (LatestRequest { request: wanted.clone(), rests_at: None }, Instant::now());
    let mut frames = Vec::new();
    loop {
        let step = maker.step(&wish, now, &|| RequestStatus::Current).unwrap();
        frames.extend(step.frame);
        match step.next {
            NextStep::More => {}
            NextStep::After(time) => now += time,
            NextStep::Rest => return frames,
        }
    }
}

/// The first frame for one who moves on.
fn moving(maker: &mut FrameMaker, wanted: &FrameRequest) -> Arc<RenderedFrame> {
    let now = Instant::now();
    let wish =
        LatestRequest { request: wanted.clone(), rests_at: Some(now + Duration::from_secs(60)) };
    maker
        .step(&wish, now, &|| RequestStatus::Current)
        .unwrap()
        .frame
        .expect("a frame comes at once")
}

fn values(drawn: &PixelValues) -> Raster {
    match &drawn.values {
        RasterValues::Double(raster) => raster.clone(),
        RasterValues::Single(raster) => {
            Raster::new(raster.size, raster.values.iter().map(|&v| f64::from(v)).collect())
        }
    }
}

/// The largest difference, in parts of the range of the picture or of a value beyond it; the same
/// pixels have a value.
fn difference(a: &Raster, b: &Raster, range: f64) -> f64 {
    assert_eq!(a.size, b.size);
    let parts = a.values.iter().zip(&b.values).map(|(a, b)| {
        assert_eq!(a.is_nan(), b.is_nan());
        if a.is_nan() || a == b { 0.0 } else { (a - b).abs() / range.max(b.abs()) }
    });
    parts.fold(0.0, f64::max)
}

#[test]
fn the_final_picture_is_that_of_ppum_render() {
    let (dataset, mut maker) = (dataset(), maker());
    let wanted = wanted(&dataset);
    // by a way that has rough pictures and strips in it
    moving(&mut maker, &wanted);
    finished(&mut maker, &wanted);
    let wanted = beside(&wanted, 17.0, -9.0);
    moving(&mut maker, &wanted);
    let frames = finished(&mut maker, &wanted);
    let last = frames.last().unwrap();
    assert!(last.is_final && last.request == wanted);
    let (field, view) = (last.field.field(), &wanted.view);
    let raster = render::<f64>(field, view, &Quantity::VonMises, unwatched()).unwrap();
    let drawn = PixelValues::new(raster, field, view, "cpu f64");
    let style =
        wanted.scene.colors.style(Some(&Quantity::VonMises), Colormap::named("viridis").unwrap());
    let seen = BodyView::new(field, *view, MirrorLines::default());
    let span = value_span(field, &seen, &Quantity::VonMises, &drawn, &style, unwatched()).unwrap();
    let picture = drawn.picture(&style, span).unwrap();
    assert!(last.colored.picture == picture);
    assert_eq!(last.colored.texture().size, PIXELS.map(|n| n as usize));
    assert_eq!(values(&last.drawn).values.len(), values(&drawn).values.len());
}

/// Plain, deformed and mirrored bodies, and both: each final picture is that of the command.
#[test]
fn bodies_of_all_kinds_are_those_of_ppum_render() {
    let (dataset, mut maker) = (dataset(), maker());
    for (deformed, mirror) in [(true, false), (false, true), (true, true)] {
        let mut wanted = wanted(&dataset);
        wanted.scene.deformed = deformed.then_some(Magnification::Given(0.05));
        wanted.scene.mirror = mirror.then(|| "left,bottom:antisymmetric".parse().unwrap());
        wanted.scene.overlays.shown = vec![Overlay::Cracks, Overlay::Cells];
        wanted.view.center = dataset.domain.bounds.min;
        let frames = finished(&mut maker, &wanted);
        let last = frames.last().unwrap();
        let subject = ImageSubject::new(last.field.dataset(), last.field.field(), None).unwrap();
        let (request, engine) = (wanted.scene.clone().into(), Engine::default());
        let made = subject.image_in(&request, &wanted.view, None, &engine).unwrap();
        assert!(last.colored.picture == made.picture, "{deformed} {mirror}");
        assert_eq!(last.layers.items.len(), made.layers.items.len());
        assert!(last.colored.has_values && last.is_final);
    }
}

#[test]
fn only_what_has_changed_is_made_anew() {
    let (dataset, mut maker) = (dataset(), maker());
    let mut wanted = wanted(&dataset);
    finished(&mut maker, &wanted);
    let made = |maker: &FrameMaker| {
        let FrameMaker { subjects, values, ranges, painted, layers, .. } = maker;
        [subjects.own.fields.made, values.whole.made, ranges.made, painted.made, layers.made]
    };
    let first = made(&maker);
    assert_eq!([first[0], first[1], first[2], first[4]], [1; 4]);
    finished(&mut maker, &wanted);
    assert_eq!(made(&maker), first, "nothing has changed");

    wanted.scene.colors.colormap = Some("magma".to_owned());
    finished(&mut maker, &wanted);
    let recolored = made(&maker);
    assert_eq!(recolored, [1, 1, 1, first[3] + 1, 1], "colours alone");

    wanted.scene.overlays.shown.push(Overlay::Cells);
    let frames = finished(&mut maker, &wanted);
    assert_eq!(made(&maker), [1, 1, 1, recolored[3], 2], "overlays alone");
    assert!(!frames.last().unwrap().layers.items.is_empty());

    wanted.scene.quantity = Some("uy".to_owned());
    finished(&mut maker, &wanted);
    assert_eq!(made(&maker)[..2], [1, 2], "of another quantity the field is the same");

    // isolines have levels of the range
    wanted.scene.overlays.isolines = Some(IsolineLevels::Auto);
    finished(&mut maker, &wanted);
    let before = made(&maker);
    wanted.scene.colors.range = "-1,2".parse().unwrap();
    finished(&mut maker, &wanted);
    assert_eq!(made(&maker)[4], before[4] + 1);
    assert_eq!(made(&maker)[1], before[1]);
}

#[test]
fn who_moves_sees_strips_of_what_was_uncovered() {
    let (dataset, mut maker) = (dataset(), maker());
    let mut wanted = wanted(&dataset);
    let whole = finished(&mut maker, &wanted);
    let range = &whole.last().unwrap().colored.normalization;
    let range = range.max() - range.min();
    maker.values.pixels = 0;
    let [nx, ny] = PIXELS.map(|n| n as usize);
    for (columns, rows) in [(5i32, 0i32), (0, -7), (-3, 4), (11, 13)] {
        wanted = beside(&wanted, f64::from(columns), f64::from(rows));
        let before = maker.values.pixels;
        let frame = moving(&mut maker, &wanted);
        let (columns, rows) = (columns.unsigned_abs() as usize, rows.unsigned_abs() as usize);
        // less where the picture of before the last one shares more with it
        let drawn = maker.values.pixels - before;
        assert!(drawn > 0 && drawn <= rows * nx + columns * (ny - rows));
        assert!(frame.drawn.by.ends_with("moved") && !frame.is_final);
        let apart = frame.drawn.view.center - wanted.view.center;
        assert!(apart.length() < 1e-9 * wanted.view.pixel_size());
        let exact =
            render::<f64>(frame.field.field(), &wanted.view, &Quantity::VonMises, unwatched());
        let found = difference(&values(&frame.drawn), &exact.unwrap(), range);
        assert!(found < 1e-5, "strips differ by {found:e} of the range");
    }
    // a place that shares little with it is drawn anew
    wanted = beside(&wanted, 200.0, 0.0);
    assert!(!moving(&mut maker, &wanted).drawn.by.ends_with("moved"));
}

/// Strips of a difference are of double precision: what cancels is not seen in single precision.
#[test]
fn who_moves_sees_strips_of_differences() {
    let (dataset, mut maker) = (dataset(), maker());
    let other = Arc::new(Recipe { seed: 7, level: 3, ..Recipe::default() }.dataset());
    let subtracted = |quantity: Option<&str>| SubtractedImage {
        dataset: Arc::clone(&other).into(),
        subject: ppum_scene::scene::Subject::default(),
        quantity: quantity.map(str::to_owned),
    };
    let mut wanted = FrameRequest { minus: Some(subtracted(None)), ..wanted(&dataset) };
    let exact = |frame: &RenderedFrame, view: &View| {
        let minus = frame.minus().expect("it is a difference");
        minus.draw(view, unwatched()).unwrap()
    };
    let whole = finished(&mut maker, &wanted);
    let last = whole.last().unwrap();
    let apart = exact(last, &wanted.view);
    let is_same = |(a, b): (&f64, &f64)| a == b || a.is_nan() && b.is_nan();
    assert!(values(&last.drawn).values.iter().zip(&values(&apart).values).all(is_same));
    assert_eq!(last.norms, apart.norms);
    assert!(last.is_final && apart.norms.unwrap().absolute[2] > 0.0);

    wanted = beside(&wanted, 5.0, -3.0);
    let moved = moving(&mut maker, &wanted);
    assert_eq!(moved.drawn.by, "cpu f64, moved");
    let apart = exact(&moved, &moved.drawn.view);
    let size = apart.norms.unwrap().absolute[2];
    assert!(difference(&values(&moved.drawn), &values(&apart), size) < 1e-7);
    // far away it is coarse, or whole where that is soon done, and of both
    wanted = beside(&wanted, 200.0, 0.0);
    let far = moving(&mut maker, &wanted);
    let apart = exact(&far, &far.drawn.view);
    assert_eq!(difference(&values(&far.drawn), &values(&apart), 1.0), 0.0);

    // what is subtracted is found anew, what is looked at is not
    let fields = maker.subjects.own.fields.made;
    wanted.minus = Some(subtracted(Some("uy")));
    let last = finished(&mut maker, &wanted).pop().unwrap();
    assert!(last.minus().is_some() && maker.subjects.own.fields.made == fields);
    wanted.minus = None;
    assert!(finished(&mut maker, &wanted).pop().unwrap().left.is_none());
    // nothing holds what was subtracted any more
    drop((whole, moved, far, last));
    assert_eq!(Arc::strong_count(&other), 1);
}

/// Deep at a tip single precision is as good as elsewhere, since offsets are formed in double
/// precision; pixels that doubles cannot put side by side are drawn whole.
#[test]
fn deep_at_a_tip_single_precision_is_enough() {
    let (dataset, mut maker) = (dataset(), maker());
    let mut wanted = wanted(&dataset);
    for (depth, may_be_moved) in [(1e-6, true), (1e-9, true), (1e-12, false)] {
        let tip = dataset.steps[0].cracks[0].points[0];
        wanted.view = View::new(tip, depth * 1.4, PIXELS).unwrap();
        finished(&mut maker, &wanted);
        wanted = beside(&wanted, 8.0, 3.0);
        let frame = moving(&mut maker, &wanted);
        assert_eq!(frame.drawn.by.ends_with("moved"), may_be_moved, "{depth:e}");
        let exact =
            render::<f64>(frame.field.field(), &frame.drawn.view, &Quantity::VonMises, unwatched());
        let (found, exact) = (values(&frame.drawn), exact.unwrap());
        let mut errors: Vec<f64> = (found.values.iter().zip(&exact.values))
            .filter(|(a, b)| a.is_finite() && b.is_finite())
            .map(|(a, b)| (a - b).abs() / b.abs())
            .collect();
        errors.sort_by(f64::total_cmp);
        // 16-bit places of a strip's pixels at 1e-9 move it by a hundredth of one at most
        let most = errors[errors.len() * 99 / 100];
        assert!(most < if depth < 1e-8 { 1e-3 } else { 2e-5 }, "{depth:e}: {most:e}");
    }
}

#[test]
fn ranges_stay_while_one_moves_and_glide_to_the_true_one() {
    let (dataset, mut maker) = (dataset(), maker());
    let mut wanted = wanted(&dataset);
    wanted.scene.quantity = Some("uy".to_owned());
    let first = finished(&mut maker, &wanted);
    let ends = |frame: &RenderedFrame| {
        [frame.colored.normalization.min(), frame.colored.normalization.max()]
    };
    let before = ends(first.last().unwrap());
    wanted.view = View::new(vec2(0.5, 0.4), 0.3, PIXELS).unwrap();
    assert_eq!(ends(&moving(&mut maker, &wanted)), before, "it stays while one moves");
    let frames = finished(&mut maker, &wanted);
    let maxima: Vec<f64> = frames.iter().map(|frame| ends(frame)[1]).collect();
    let fresh = finished(&mut self::maker(), &wanted);
    let goal = ends(fresh.last().unwrap());
    assert_eq!(ends(frames.last().unwrap()), goal, "it ends at the true range");
    assert!(maxima.len() > 8 && maxima.is_sorted_by(|a, b| a >= b), "it glides: {maxima:?}");
    assert!(maxima[0] > maxima[maxima.len() / 2] && before[1] > goal[1]);
}

#[test]
fn what_is_nearly_there_is_finished_and_the_rest_is_stopped() {
    let (dataset, mut maker) = (dataset(), maker());
    let wish = LatestRequest { request: wanted(&dataset), rests_at: None };
    // a machine that is busy may take long even for a rough picture
    maker.patience = Patience(Duration::MAX);
    let gone = maker.step(&wish, Instant::now(), &|| RequestStatus::Closed);
    assert!(matches!(gone, Err(FrameStop::Cancelled)), "nobody waits for a rough picture either");
    let rough = maker
        .step(&wish, Instant::now(), &|| RequestStatus::Replaced)
        .unwrap()
        .frame
        .expect("a rough picture");
    assert!(rough.drawn.view.pixels[0] < PIXELS[0]);
    let stopped = maker.step(&wish, Instant::now(), &|| RequestStatus::Replaced);
    assert!(matches!(stopped, Err(FrameStop::Cancelled)));
    assert_eq!(maker.values.whole.made, 0);
    assert!(finished(&mut maker, &wish.request).last().unwrap().is_final);
}

#[test]
fn mistakes_are_told_where_they_are() {
    use super::FaultOrigin;
    let (dataset, mut maker) = (dataset(), maker());
    let fault = |maker: &mut FrameMaker, change: &dyn Fn(&mut FrameRequest)| {
        let mut wanted = wanted(&dataset);
        change(&mut wanted);
        let (wish, mut now) = (LatestRequest { request: wanted, rests_at: None }, Instant::now());
        loop {
            now += Duration::from_millis(16);
            match maker.step(&wish, now, &|| RequestStatus::Current) {
                Ok(step) if step.next == NextStep::Rest => return None,
                Ok(_) => {}
                Err(FrameStop::Failed(failure)) => return Some(failure.fault),
                Err(FrameStop::Cancelled) => panic!("nobody stopped it"),
            }
        }
    };
    assert_eq!(
        fault(&mut maker, &|w| w.scene.quantity = Some("uy +".into())),
        Some(FaultOrigin::Quantity)
    );
    assert_eq!(
        fault(&mut maker, &|w| w.scene.subject.part = Some("soul".into())),
        Some(FaultOrigin::Subject)
    );
    assert_eq!(fault(&mut maker, &|w| w.scene.subject.step = Some(9)), Some(FaultOrigin::Subject));
    assert_eq!(
        fault(&mut maker, &|w| w.scene.colors.colormap = Some("mud".into())),
        Some(FaultOrigin::Colors)
    );
    assert_eq!(
        fault(&mut maker, &|w| w.scene.colors.range =
            ppum_render::range::RangeChoice::Fixed(3.0, 2.0)),
        Some(FaultOrigin::Colors)
    );
    let crossed = |w: &mut FrameRequest| {
        w.scene.deformed = Some(ppum_scene::magnification::Magnification::Auto);
        w.scene.overlays.shown.push(Overlay::Points);
    };
    assert_eq!(fault(&mut maker, &crossed), Some(FaultOrigin::Overlays));
    assert_eq!(fault(&mut maker, &|_| ()), None, "and then all is well again");
}

#[test]
fn a_comparison_has_the_numbers_of_resampling() {
    let (dataset, mut maker) = (dataset(), maker());
    let mut wanted = wanted(&dataset);
    let compare = Compare { method: Interpolation::Bicubic, grid: 37 };
    wanted.compare = Some(compare);
    let frames = finished(&mut maker, &wanted);
    let last = frames.last().unwrap();
    let other = last.other.as_ref().expect("it was asked for");
    let field = last.field.field();
    let direct = render::<f64>(field, &wanted.view, &Quantity::VonMises, unwatched()).unwrap();
    let grid = compare.grid_over(field).unwrap();
    let samples = grid.sample(field, &Quantity::VonMises, unwatched()).unwrap();
    let raster = samples.raster(Interpolation::Bicubic, &wanted.view);
    assert_eq!(other.norms, norms(&direct, &raster));
    assert_eq!(other.bytes, 37 * 37 * 8);
    assert_eq!(other.picture.normalization, last.colored.normalization);
    let signs = other.difference.normalization;
    assert!(signs.min() == -signs.max());
    // samples serve other views and methods, but no other grid
    wanted.compare = Some(Compare { method: Interpolation::Nearest, ..compare });
    finished(&mut maker, &beside(&wanted, 30.0, 0.0));
    assert_eq!(maker.resampling.samples.made, 1);
    wanted.compare = Some(Compare { grid: 38, ..compare });
    finished(&mut maker, &wanted);
    assert_eq!(maker.resampling.samples.made, 2);
}

#[test]
fn a_thread_makes_the_picture_of_its_maker() {
    let dataset = dataset();
    let wanted = wanted(&dataset);
    let made = finished(&mut FrameMaker::new(Backend::Cpu), &wanted);
    let (wake, woken) = mpsc::channel();
    let wake = move || {
        // nobody listens once the picture is there
        let _ = wake.send(());
    };
    let mut frames = PaneFrames::with_backend(Backend::Cpu, wake);
    frames.want(wanted);
    while frames.is_working() {
        let is_woken = woken.recv_timeout(Duration::from_secs(300));
        is_woken.expect("the thread wakes the window until it is done");
        frames.poll();
    }
    let threaded = frames.newest().expect("a picture");
    let last = made.last().expect("a picture");
    assert!(threaded.is_final && last.is_final);
    assert!(threaded.colored.image == last.colored.image);
}

#[test]
fn a_graphics_device_draws_what_the_processor_draws() {
    let (dataset, mut maker) = (dataset(), FrameMaker::new(Backend::Gpu));
    // while the device is prepared nobody waits for it
    let mut wanted = wanted(&dataset);
    let first = finished(&mut maker, &wanted);
    assert!(first.iter().all(|frame| frame.drawn.by.starts_with("cpu ")));
    wanted = beside(&wanted, 3.5, 0.0);
    let frames = finished(&mut maker, &wanted);
    let last = frames.last().unwrap();
    if last.drawn.by == "cpu f64" {
        assert!(
            last.note.as_ref().is_some_and(|note| note.starts_with("drawn by the processor: "))
        );
        ppum_testkit::skipped::skipped("no graphics device");
        return;
    }
    assert!(last.drawn.by.starts_with("gpu f32, ") && last.note.is_none());
    let on_cpu = finished(&mut self::maker(), &wanted);
    let (found, exact) = (values(&last.drawn), values(&on_cpu.last().unwrap().drawn));
    let range = &on_cpu.last().unwrap().colored.normalization;
    let close = found.values.iter().zip(&exact.values).filter(|(a, b)| {
        let size = (range.max() - range.min()).max(b.abs());
        a.is_nan() == b.is_nan() && (a.is_nan() || a == b || (*a - *b).abs() < 1e-4 * size)
    });
    // beside the crack a rounded place may be on the other side
    assert!(close.count() > found.values.len() * 998 / 1000);

    // what no card can is drawn by the processor, as nothing worth a word
    wanted.scene.quantity = Some("patch:level".to_owned());
    let cells = finished(&mut maker, &wanted);
    assert!(cells.last().unwrap().drawn.by == "cpu f64" && cells.last().unwrap().note.is_none());
}

#[test]
fn a_panic_is_told_and_does_no_harm() {
    let (dataset, mut maker) = (dataset(), maker());
    let wish = LatestRequest { request: wanted(&dataset), rests_at: None };
    let run = |maker: &mut FrameMaker, claim: AskStatus<'_>| loop {
        match worker::step(maker, Backend::Cpu, &wish, claim) {
            (Some(Err(failure)), next) => return (Some(failure.fault), next),
            (_, NextStep::Rest) => return (None, NextStep::Rest),
            _ => {}
        }
    };
    let broken = || panic!("a mistake of the program, made by a test");
    assert_eq!(run(&mut maker, &broken), (Some(super::FaultOrigin::Program), NextStep::Rest));
    assert_eq!(run(&mut maker, &|| RequestStatus::Current), (None, NextStep::Rest));
    assert_eq!(maker.values.whole.made, 1);
}
