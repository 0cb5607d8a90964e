//! The command that a window shows draws the picture that it shows.

use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::vec2::vec2;
use ppum_figure::figure::{BarPlace, FigureStyle};
use ppum_render::colormap::Rgb;
use ppum_render::range::RangeChoice;
use ppum_render::scale::Scale;
use ppum_render::view::View;
use ppum_scene::colors::ColorOptions;
use ppum_scene::command;
use ppum_scene::compose::page_of_view;
use ppum_scene::engine::Engine;
use ppum_scene::magnification::Magnification;
use ppum_scene::overlays::{IsolineLevels, Overlay, Overlays};
use ppum_scene::page_style::PageStyle;
use ppum_scene::region::ViewRegion;
use ppum_scene::request::Request;
use ppum_scene::scene::{SceneRequest, Subject};
use ppum_scene::subject::ImageSubject;
use ppum_testkit::random::Random;

use super::{CRACKED, Lab, Png};

fn maybe<T>(random: &mut Random, make: impl FnOnce(&mut Random) -> T) -> Option<T> {
    (random.below(3) == 0).then(|| make(random))
}

fn colors(random: &mut Random) -> ColorOptions {
    let ranges = [
        RangeChoice::Auto,
        RangeChoice::Full,
        RangeChoice::Fixed(0.125, 3.0),
        RangeChoice::Percentiles(2.0, 97.5),
    ];
    ColorOptions {
        colormap: maybe(random, |r| r.pick(&["vik_r", "coolwarm", "viridis"]).to_owned()),
        range: random.pick(&ranges),
        scale: random.pick(&[Scale::Linear, Scale::Log, Scale::SymLog]),
        contrast: random.below(2) == 0,
        bands: maybe(random, |r| r.below(20) as u16 + 1),
        symmetric: random.below(2) == 0,
        nan_color: maybe(random, |r| Rgb([r.below(256) as u8, 0, 255])),
    }
}

fn overlays(random: &mut Random, is_deformed: bool) -> Overlays {
    let fits = |o: &Overlay| !is_deformed || o.is_deformable();
    let all: Vec<Overlay> = Overlay::ALL.into_iter().filter(fits).collect();
    let levels = [
        IsolineLevels::Auto,
        IsolineLevels::Count(5),
        IsolineLevels::At(vec![0.75]),
        IsolineLevels::At(vec![0.5, 1.5]),
    ];
    Overlays {
        shown: (0..random.below(4)).map(|_| random.pick(&all)).collect(),
        no_cracks: random.below(2) == 0,
        isolines: maybe(random, |r| levels[r.below(levels.len())].clone()),
        level_labels: random.below(2) == 0,
        arrows: maybe(random, |r| r.between(20.0, 50.0)),
        crosses: maybe(random, |r| r.between(20.0, 50.0)),
    }
}

fn scene(random: &mut Random) -> SceneRequest {
    let subject = Subject {
        step: maybe(random, |_| 0),
        part: maybe(random, |r| r.pick(&["smooth", "jump", "tip", "patch:7"]).to_owned()),
        functions: maybe(random, |_| ("westergaard 1".to_owned(), "r*(1 + y)".to_owned()))
            .into_iter()
            .collect(),
        weight: maybe(random, |r| r.pick(&["bump", "(1 - t)^2"]).to_owned()),
        // a plate that names no quantity: the error is the same
        quantities: (random.below(20) == 0)
            .then(|| ("stretch".to_owned(), "ux".to_owned()))
            .into_iter()
            .collect(),
    };
    let deformed = maybe(random, |r| r.pick(&[Magnification::Auto, Magnification::Given(0.013)]));
    let quantities = ["von-mises", "-uy", "(sxx + syy)/2", "s1", "sqrt(ux^2 + uy^2)"];
    SceneRequest {
        subject,
        quantity: maybe(random, |r| r.pick(&quantities).to_owned()),
        colors: colors(random),
        overlays: overlays(random, deformed.is_some()),
        deformed,
        outline: random.below(2) == 0,
        // of a deformed plate the error is the same
        mirror: (random.below(4) == 0).then(|| "left,top:antisymmetric".parse().unwrap()),
    }
}

/// The view: of any depth around a point of the plate that is seen also where it is deformed.
fn view(random: &mut Random) -> View {
    let width = 10f64.powf(random.between(-6.0, 0.5));
    let center = vec2(random.between(-0.8, 0.8), random.between(-0.8, 0.8));
    View::new(center, width, [64, 48]).unwrap()
}

#[test]
fn the_command_of_a_picture_draws_it_again() {
    let lab = Lab::solved(CRACKED);
    let dataset = Arc::new(ppum_format::read(&lab.path("plate.h5")).unwrap());
    let mut random = Random(15);
    let mut drawn = [0; 2];
    for number in 0..24 {
        let (scene, view) = (scene(&mut random), view(&mut random));
        let design = match number % 8 {
            0 => Some(FigureStyle::pixels([400, 300])),
            4 => Some(FigureStyle {
                bar: BarPlace::Bottom,
                ..FigureStyle::inches([3.0, 4.0], 100.0)
            }),
            _ => None,
        };
        let own = page(&dataset, &scene, &view, design.as_ref());
        let seen = own.as_ref().map_or(view, |(_, seen)| *seen);
        let mut request = Request::from(scene.clone());
        (request.place, request.figure) = (ViewRegion::of(&seen), design.is_some());
        let bare = || PageStyle { size: Some(seen.pixels), ..PageStyle::default() };
        request.look = design.as_ref().map_or_else(bare, PageStyle::of);
        let words = command::render(&request, "plate.h5", "again.png");
        let _ = std::fs::remove_file(lab.path("again.png"));
        let mut again = lab.command("");
        let again = again.args(&words[1..]).arg("--backend=cpu").output().unwrap();
        match (own, again.status.success()) {
            (Ok((rgba, _)), true) => {
                assert!(
                    Png::read(&lab.path("again.png")).rgba == rgba,
                    "{}",
                    command::line(&words)
                );
                drawn[usize::from(design.is_some())] += 1;
            }
            (Err(_), false) => {}
            (own, _) => panic!(
                "{}\n{:?}\n{}",
                command::line(&words),
                own.map(|(_, view)| view),
                String::from_utf8_lossy(&again.stderr)
            ),
        }
    }
    assert!(drawn[0] > 7 && drawn[1] > 1, "{drawn:?} pictures and figures only");
}

/// What the window saves is what the command beside it draws, and both say the same of it.
#[cfg(feature = "window")]
#[test]
fn the_window_saves_what_its_command_draws() {
    use std::sync::atomic::AtomicUsize;

    use ppum_scene::request::FigureTexts;
    use ppum_viewer::export::{ExportChoice, ImageExport, Motion, PageSize};
    use ppum_viewer::field::OwnedField;

    let lab = Lab::solved(CRACKED);
    let dataset = Arc::new(ppum_format::read(&lab.path("plate.h5")).unwrap());
    let isolines = Some(IsolineLevels::At(vec![1e9]));
    let scene = SceneRequest {
        quantity: Some("sqrt(x)".into()),
        overlays: Overlays { isolines, ..Overlays::default() },
        ..SceneRequest::default()
    };
    for (choice, page) in [
        (ExportChoice::Figure, PageSize::pixels([500, 400])),
        (ExportChoice::Figure, PageSize { dpi: 150.0, ..PageSize::COLUMN }),
        (ExportChoice::Image, PageSize::pixels([80, 60])),
    ] {
        let order = ImageExport {
            field: Arc::new(OwnedField::new(Arc::clone(&dataset), 0).unwrap()),
            file: Some("plate.h5".into()),
            left: None,
            scene: scene.clone(),
            view: View::new(vec2(0.0, 0.0), 3.0, [80, 60]).unwrap(),
            page,
            choice,
            motion: Motion::default(),
            texts: FigureTexts { title: Some("One's own".into()), ..FigureTexts::default() },
        };
        let own =
            order.bytes("own.png".as_ref(), ppum::progress::unwatched(), &AtomicUsize::new(0));
        let (bytes, notices) = own.unwrap();
        std::fs::write(lab.path("own.png"), bytes).unwrap();
        let line = order.command("again.png".as_ref()).unwrap();
        let line = line.replacen("ppum", env!("CARGO_BIN_EXE_ppum"), 1) + " --backend=cpu";
        let mut shell = std::process::Command::new("sh");
        let again = shell.args(["-c", &line]).current_dir(lab.path("")).output().unwrap();
        let [own, drawn] = ["own.png", "again.png"].map(|name| Png::read(&lab.path(name)));
        assert!(own.rgba == drawn.rgba, "{line}");
        let lines: Vec<_> = notices.iter().map(|notice| notice.line() + "\n").collect();
        assert_eq!(String::from_utf8(again.stderr).unwrap(), lines.concat());
        assert_eq!(lines.len(), 2, "{lines:?}");
    }
}

/// The pixels of a scene's picture, and its view; of a figure those of its page.
fn page(
    dataset: &Dataset,
    scene: &SceneRequest,
    view: &View,
    design: Option<&FigureStyle>,
) -> Result<(Vec<u8>, View), String> {
    let mut dataset = dataset.clone();
    scene.subject.apply(&mut dataset).map_err(|e| e.to_string())?;
    let field = Field::new(&dataset, scene.subject.step_of(&dataset)).map_err(|e| e.to_string())?;
    let subject = ImageSubject::new(&dataset, &field, scene.quantity.as_deref());
    let (subject, request) = (subject.map_err(|e| e.to_string())?, scene.clone().into());
    let made = page_of_view(&subject, &request, view, design, &Engine::default());
    made.map(|(page, shot)| (page.image().rgba, shot.picture.view)).map_err(|e| e.to_string())
}
