//! The whole of half and quarter models: `--mirror`.

use ppum::crack::Side;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum::vec2::Vec2;
use ppum_render::isoline::Isoline;
use ppum_render::samples::Samples;
use ppum_render::view::View;
use ppum_scene::body::BodyView;
use ppum_scene::camera::{ImageSettings, LayoutInput};
use ppum_scene::compose::page;
use ppum_scene::engine::Engine;
use ppum_scene::magnification::Magnification;
use ppum_scene::overlays::{IsolineLevels, Overlay, Overlays};
use ppum_scene::region::ViewRegion;
use ppum_scene::request::Request;
use ppum_scene::scene::SceneRequest;
use ppum_scene::subject::ImageSubject;
use ppum_scene::values::{PixelValues, RasterValues};
use ppum_testkit::random::Random;

use crate::backend::has_adapter;
use crate::{Lab, Png, sound};

/// A plate with a crack from x = −0.5 to 0.5 and loads that are balanced, or a part of it: the one
/// with y > 0, or with x > 0 too.
fn plate([x, y]: [f64; 2], crack: f64, loads: &str, symmetries: &str, cells: [u32; 2]) -> String {
    format!(
        r#"
title = "Plate"
[domain]
min = [{x:?}, {y:?}]
max = [1.0, 1.5]
[material]
young = 2.0
poisson = 0.3
state = "plane-strain"
[[crack]]
points = [[{crack:?}, 0.0], [0.5, 0.0]]
{loads}
{symmetries}
[discretization]
cells = {cells:?}
order = 5
[[quantity]]
name = "mine"
formula = "ux*x^2 - y*sxy + exy"
"#
    )
}

fn boundary(edges: &[(&str, &str)]) -> String {
    let one = |(on, what): &(&str, &str)| format!("[[boundary]]\non = \"{on}\"\n{what}\n");
    edges.iter().map(one).collect()
}

/// The whole plate, a part of it, and the edges at which the part is mirrored.
struct Case {
    whole: String,
    part: String,
    edges: &'static str,
}

/// Plates that are pulled and opened, and plates that are sheared.
fn cases() -> Vec<Case> {
    let faces = "[[boundary]]\non = { crack = 0 }\npressure = 0.4\n";
    let pulled = [("top", "traction = [0.0, 1.0]"), ("right", "traction = [0.3, 0.0]")];
    let others = [("bottom", "traction = [0.0, -1.0]"), ("left", "traction = [-0.3, 0.0]")];
    let sheared = [
        ("top", "traction = [0.5, 0.0]"),
        ("right", "traction = [0.0, 0.5]"),
        ("left", "traction = [0.0, -0.5]"),
    ];
    let below = [("bottom", "traction = [-0.5, 0.0]")];
    let whole = |loads: String| plate([-1.0, -1.5], -0.5, &loads, "", [8, 12]);
    let (pull, shear) = (boundary(&pulled) + faces, boundary(&sheared));
    let (symmetric, odd) = ("symmetry = true", "antisymmetry = true");
    let half = |loads: &str, kind: &str| {
        plate([-1.0, 0.0], -0.5, loads, &boundary(&[("bottom", kind)]), [8, 6])
    };
    let left = boundary(&others[1..]);
    let both = boundary(&[("bottom", symmetric), ("left", symmetric)]);
    vec![
        Case {
            whole: whole(pull.clone() + &boundary(&others)),
            part: half(&(pull.clone() + &left), symmetric),
            edges: "bottom",
        },
        Case {
            whole: whole(shear.clone() + &boundary(&below)),
            part: half(&shear, odd),
            edges: "bottom:antisymmetric",
        },
        Case {
            whole: whole(pull.clone() + &boundary(&others)),
            part: plate([0.0, 0.0], 0.0, &pull, &both, [4, 6]),
            edges: "left,bottom",
        },
    ]
}

fn solved(problem: &str) -> Dataset {
    let lab = Lab::solved(problem);
    ppum_format::read(&lab.path("plate.h5")).unwrap()
}

fn request(quantity: &str, mirror: Option<&str>, place: &ViewRegion, size: [u32; 2]) -> Request {
    let scene = SceneRequest {
        quantity: Some(quantity.to_owned()),
        mirror: mirror.map(|text| text.parse().unwrap()),
        ..SceneRequest::default()
    };
    let mut request = Request { place: place.clone(), ..scene.into() };
    request.look.size = Some(size);
    request
}

/// The values of an image.
fn drawn(dataset: &Dataset, request: Request, samples: Samples) -> PixelValues {
    let field = Field::new(dataset, 0).unwrap();
    let engine = Engine::default();
    let subject = subject(dataset, &field, &request);
    let body = body(&subject, &request, &engine);
    subject.values(&body, samples, &engine).unwrap()
}

fn subject<'a>(dataset: &'a Dataset, field: &'a Field<'a>, request: &Request) -> ImageSubject<'a> {
    ImageSubject::new(dataset, field, request.scene.quantity.as_deref()).unwrap()
}

fn body<'a>(subject: &ImageSubject<'a>, request: &Request, engine: &Engine<'_>) -> BodyView<'a> {
    let request = subject.resolved(request).unwrap();
    let input = LayoutInput::of(subject, &request).unwrap();
    let settings = ImageSettings::new(&request, &input).unwrap();
    settings.camera.body(subject, &request.scene, engine).unwrap()
}

fn values(drawn: &PixelValues) -> &[f64] {
    let RasterValues::Double(raster) = &drawn.values else { panic!("double precision") };
    &raster.values
}

fn centers(
    dataset: &Dataset,
    quantity: &str,
    mirror: Option<&str>,
    place: &ViewRegion,
) -> Vec<f64> {
    let drawn = drawn(dataset, request(quantity, mirror, place, SIZE), Samples::CENTER);
    values(&drawn).to_vec()
}

/// The isolines of an image, and its view.
fn isolines(
    subject: &ImageSubject<'_>,
    request: &Request,
    levels: Vec<f64>,
) -> (View, Vec<Isoline>) {
    let engine = Engine::default();
    let body = body(subject, request, &engine);
    let lines = subject.isolines(&body, &IsolineLevels::At(levels), &engine).unwrap();
    (*body.view(), lines)
}

const SIZE: [u32; 2] = [101, 147];

/// How many times as large the errors of a quarter may be: its crack is half as long, and so its
/// zone of tip functions half as wide by default (decision 36).
const QUARTER: f64 = 10.0;

/// The mirrored part is the whole plate that was solved, at every pixel, at random places, for
/// quantities of all kinds. What differs are the errors of both solutions at order 5: of 99 % of
/// the pixels displacements by up to 6e-7 of their size and stresses by 2e-5, at the worst ones by
/// 3e-6 and 1e-4. The bounds are some five times as large.
#[test]
fn mirrored_parts_are_the_whole() {
    let mut random = Random(71);
    let names = [
        "ux",
        "uy",
        "sxx",
        "syy",
        "sxy",
        "von-mises",
        "s1",
        "s2",
        "tresca",
        "curl",
        "duy_dx",
        "energy",
        "mine",
        "ux*x + sxy*y - x^2*syy",
        "max(s1, 0)*(y + 2*x)",
        "direction",
    ];
    for Case { whole, part, edges } in cases() {
        let [whole, part] = [whole, part].map(|problem| solved(&problem));
        for name in names {
            let (x, y) = (random.between(-0.6, 0.6), random.between(-1.0, 1.0));
            let near =
                ViewRegion { center: Some([x, y]), width: Some(0.9), ..ViewRegion::default() };
            for place in [ViewRegion::default(), near] {
                let own = centers(&part, name, Some("auto"), &place);
                let named = centers(&part, name, Some(edges), &place);
                assert!(own.iter().zip(&named).all(|(a, b)| a.to_bits() == b.to_bits()));
                let all = centers(&whole, name, None, &place);
                let size = all.iter().copied().filter(|v| v.is_finite()).map(f64::abs);
                let size = size.fold(0.0, f64::max);
                let (mut apart, mut all_apart) = (0.0f64, Vec::new());
                for (own, all) in own.iter().zip(&all) {
                    assert_eq!(own.is_nan(), all.is_nan(), "{name}");
                    let difference = (own - all).abs();
                    let period = if name == "direction" { std::f64::consts::PI } else { 0.0 };
                    let difference = difference.min((period - difference).abs());
                    apart = apart.max(difference).max(0.0);
                    all_apart.extend((!difference.is_nan()).then_some(difference));
                }
                all_apart.sort_by(f64::total_cmp);
                let most = all_apart[all_apart.len() * 99 / 100];
                println!("{edges} {name}: {:.1e}, of 99 % {:.1e}", apart / size, most / size);
                let [bound, bound_of_most] = match name {
                    "ux" | "uy" => [2e-5, 4e-6],
                    // which has no limit where all stresses of antisymmetric fields are zero
                    "direction" => [f64::INFINITY, 1e-4],
                    _ => [1e-3, 1e-4],
                };
                let size = if edges == "left,bottom" { QUARTER * size } else { size };
                assert!(apart < bound * size, "{edges} {name}: {apart} of {size}");
                assert!(most < bound_of_most * size, "{edges} {name}: {most} of {size}");
            }
        }
    }
}

/// A picture that is symmetric about the line has the same bits on both sides, but for the sign of
/// odd quantities: the image is the body seen in the reflected view, and nothing is interpolated.
/// At random columns, with odd and even numbers of rows, and a millionfold around the tip.
#[test]
fn both_halves_have_the_same_bits() {
    let mut random = Random(72);
    let of_symmetric = [
        ("ux", 1.0),
        ("uy", -1.0),
        ("sxy", -1.0),
        ("syy", 1.0),
        ("von-mises", 1.0),
        ("s1", 1.0),
        ("curl", -1.0),
        ("dux_dy", -1.0),
        ("uy*y + ux*x", 1.0),
        ("sxy*x^2", -1.0),
        ("level", 1.0),
    ];
    let of_antisymmetric = [
        ("ux", -1.0),
        ("uy", 1.0),
        ("sxy", 1.0),
        ("syy", -1.0),
        ("von-mises", 1.0),
        ("curl", 1.0),
        ("dux_dy", 1.0),
        ("uy*y + ux*x", -1.0),
        ("hydrostatic", -1.0),
    ];
    let both = [(0, &of_symmetric[..]), (1, &of_antisymmetric[..])];
    for (case, names) in both {
        let part = solved(&cases()[case].part);
        for &(name, sign) in names {
            let center = Some([random.between(-0.9, 0.9), 0.0]);
            let wide = ViewRegion { center, width: Some(1.3), ..ViewRegion::default() };
            let tip = ViewRegion { tip: Some(1), zoom: Some(1e6), ..ViewRegion::default() };
            for place in [wide, tip] {
                for rows in [40u32, 41] {
                    let request = request(name, Some("auto"), &place, [60, rows]);
                    let drawn = drawn(&part, request, Samples::CENTER);
                    let row = |j: u32| &values(&drawn)[j as usize * 60..][..60];
                    assert!(row(0).iter().any(|value| value.is_finite()));
                    for j in 0..rows / 2 {
                        for (above, below) in row(j).iter().zip(row(rows - 1 - j)) {
                            let below = sign * below;
                            let is_same = above.to_bits() == below.to_bits();
                            assert!(
                                is_same || *above == 0.0 && below == 0.0 || above.is_nan(),
                                "{name} {place:?}, row {j} of {rows}: {above:e} and {below:e}"
                            );
                        }
                    }
                }
            }
        }
    }
}

/// The mean of samples is that of the values at their places, also in pixels across the line.
#[test]
fn samples_are_of_both_halves() {
    let part = solved(&cases()[0].part);
    let place = ViewRegion { view: Some([-1.2, -0.9, 1.2, 0.8]), ..ViewRegion::default() };
    let (side, [columns, rows]) = (3u32, [37u32, 29]);
    for name in ["sxy", "uy*x + y", "sqrt(x^2 + y^2 - 0.5)*y"] {
        let of = |size, samples| drawn(&part, request(name, Some("auto"), &place, size), samples);
        let finer = of([side * columns, side * rows], Samples::CENTER);
        let means = of([columns, rows], Samples::new(side as u8).unwrap());
        assert_eq!(finer.view.width, means.view.width);
        let (_, opacity) = means.opacity.as_ref().unwrap();
        for (k, mean) in (0u32..).zip(values(&means)) {
            let (i, j) = (side * (k % columns), side * (k / columns));
            let places = (0..side).flat_map(|a| (0..side).map(move |b| (i + a, j + b)));
            let places: Vec<u32> = places.map(|(i, j)| j * side * columns + i).collect();
            // samples without a value are of the body too
            let is_body =
                |k: &&u32| !values(&finer)[**k as usize].is_nan() || finer.without.contains(k);
            let count = places.iter().filter(is_body).count();
            let share = 255.0 * count as f64 / f64::from(side * side);
            assert_eq!(opacity[k as usize], share.round() as u8, "{name}");
            let finer = places.iter().map(|&k| values(&finer)[k as usize]);
            let inside: Vec<f64> = finer.filter(|value| value.is_finite()).collect();
            let expected = inside.iter().sum::<f64>() / inside.len() as f64;
            let rounding = 1e-14 * inside.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            assert!(expected.is_nan() && mean.is_nan() || (mean - expected).abs() <= rounding);
        }
    }
}

/// An odd quantity is zero on its line of symmetry, and there its isoline runs, as in the whole
/// plate that was solved, up to the crack's tips and not along its faces; even quantities have
/// none, though they may be zero there. Larger values lie on its left.
#[test]
fn odd_quantities_are_zero_on_their_line() {
    let all = cases();
    let cases: [(&Case, &[&str], &[&str]); 3] = [
        (&all[0], &["sxy", "uy", "curl", "sxy*x^2 - uy"], &["uy*y", "syy"]),
        (&all[1], &["ux", "syy", "hydrostatic"], &["ux*y", "sxy", "s1", "direction"]),
        (&all[2], &["sxy", "uy"], &["uy*y"]),
    ];
    for (Case { whole, part, edges }, odd, even) in cases {
        let [whole, part] = [whole, part].map(|problem| solved(problem));
        let fields = [&whole, &part].map(|dataset| Field::new(dataset, 0).unwrap());
        let draw = |dataset: usize, name: &str| {
            let mirror = Some(*edges).filter(|_| dataset == 1);
            let request = request(name, mirror, &ViewRegion::default(), [120, 180]);
            let subject = subject([&whole, &part][dataset], &fields[dataset], &request);
            isolines(&subject, &request, vec![0.0])
        };
        for name in odd {
            let [(view, whole_lines), (_, lines)] = [0, 1].map(|dataset| draw(dataset, name));
            let segments = |lines: &[Isoline]| -> Vec<[Vec2; 2]> {
                let paths = lines.iter().map(Isoline::polyline);
                let pairs = |path: Vec<Vec2>| -> Vec<[Vec2; 2]> {
                    path.windows(2).map(|pair| [pair[0], pair[1]]).collect()
                };
                paths.flat_map(pairs).collect()
            };
            let of_line = segments(&lines).into_iter();
            let on_line: Vec<_> = of_line
                .filter(|[a, b]| {
                    // other lines begin at tips and on the other line of symmetry
                    a.y == 0.0 && b.y == 0.0 && (b.x - a.x).abs() > 1e-6
                })
                .collect();
            let length: f64 = on_line.iter().map(|[a, b]| (b.x - a.x).abs()).sum();
            assert!((length - 1.0).abs() < 1e-9, "{edges} {name}: {length}");
            let is_ahead = |p: &Vec2| p.x.abs() > 0.5 - 1e-9;
            assert!(on_line.iter().flatten().all(is_ahead), "{edges} {name}: {on_line:?}");
            let quantity = Quantity::parse(name, &fields[0]).unwrap();
            let (mut local, mut checked) = (fields[0].at(view.center), 0);
            for [a, b] in on_line {
                // the whole that was solved has its line here
                let found = segments(&whole_lines).into_iter();
                let middle = (a + b) * 0.5;
                let far = found.map(|ends| ppum::segment::distance(ends, middle));
                let far = far.fold(f64::INFINITY, f64::min);
                // up to the errors of its solution, of 1e-5, over the slope of stresses
                assert!(far < 0.5 * view.pixel_size(), "{edges} {name}: {far}");
                let beside = (b - a).unit().left() * (2.0 * view.pixel_size());
                let sides = [beside, -beside];
                let [left, right] = sides.map(|d| quantity.at(&mut local, middle + d, Side::Above));
                // elsewhere errors of the solutions may have either sign
                if left.abs() > 1e-3 {
                    assert!(left > 0.0 && right < 0.0, "{edges} {name}: {left} and {right}");
                    checked += 1;
                }
            }
            assert!(checked > 0, "{edges} {name}");
        }
        for name in even {
            let (_, lines) = draw(1, name);
            let points = lines.iter().flat_map(|line| line.points.windows(2));
            let on_line = points.filter(|pair| pair.iter().all(|p| p.y == 0.0));
            let length: f64 = on_line.map(|pair| (pair[1].x - pair[0].x).abs()).sum();
            assert!(length < 0.1, "{edges} {name}: {length}");
        }
    }
}

/// The deformed whole is the deformed plate that was solved as a whole: its values at every pixel,
/// and the box in which it lies. An antisymmetric field deforms the image by the negative factor.
#[test]
fn the_deformed_whole_is_that_of_the_whole_plate() {
    for Case { whole, part, edges } in cases() {
        let [whole, part] = [whole, part].map(|problem| solved(&problem));
        for name in ["ux", "uy", "sxy", "von-mises", "mine"] {
            let of = |dataset: &Dataset, mirror: Option<&str>, place: &ViewRegion| {
                let mut request = request(name, mirror, place, SIZE);
                request.scene.deformed = Some(Magnification::Given(0.2));
                drawn(dataset, request, Samples::CENTER)
            };
            let place = ViewRegion { view: Some([-1.5, -2.2, 1.5, 2.1]), ..ViewRegion::default() };
            let [own, all] = [of(&part, Some(edges), &place), of(&whole, None, &place)];
            let (own_values, all_values) = (values(&own), values(&all));
            let size = all_values.iter().filter(|v| v.is_finite()).map(|v| v.abs());
            let size = size.fold(0.0, f64::max);
            let alone = own_values.iter().zip(all_values);
            let alone = alone.filter(|(own, all)| own.is_nan() != all.is_nan()).count();
            let mut apart: Vec<f64> =
                own_values.iter().zip(all_values).map(|(own, all)| (own - all).abs()).collect();
            apart.retain(|apart| apart.is_finite());
            apart.sort_by(f64::total_cmp);
            assert!(apart.len() * 5 > own_values.len(), "{edges} {name}: {}", apart.len());
            let most = apart[apart.len() * 99 / 100] / size;
            let factor = if edges == "left,bottom" { QUARTER } else { 1.0 };
            println!("{edges} {name}: of 99 % {most:.1e}, {alone} pixels of one alone");
            assert!(most < 1e-4 * factor, "{edges} {name}: {most}");
            // on the border rounding and the errors of displacements decide
            assert!(alone <= 3, "{edges} {name}: {alone}");
            let [own, all] = [of(&part, Some(edges), &ViewRegion::default()).view, {
                of(&whole, None, &ViewRegion::default()).view
            }];
            assert!((own.center - all.center).length() < 0.01 && own.width / all.width < 1.01);
            assert!(all.width / own.width < 1.01);
        }
    }
}

/// A crack that an inverted displacement closes: as many pixels are hatched as of the whole plate,
/// and none where the halves of an intact line meet, which pixels' centres lie on.
#[test]
fn closed_faces_lie_over_each_other() {
    let Case { whole, part, edges } = &cases()[0];
    let count = |dataset: &Dataset, mirror: Option<&str>, factor: f64| {
        let place = ViewRegion { view: Some([-1.5, -1.8, 1.5, 1.8]), ..ViewRegion::default() };
        let mut request = request("uy", mirror, &place, [151, 181]);
        request.scene.deformed = Some(Magnification::Given(factor));
        drawn(dataset, request, Samples::CENTER).overlap.len()
    };
    let [whole, part] = [whole, part].map(|problem| solved(problem));
    for factor in [-0.1, -0.3] {
        let [own, all] =
            [count(&part, Some(edges), factor), count(&whole, None, factor)].map(|n| n as f64);
        assert!(all > 100.0 && (own - all).abs() < 0.03 * all, "{factor}: {own} and {all}");
    }
    for factor in [0.0, 0.1] {
        assert_eq!(count(&part, Some(edges), factor), 0, "{factor}");
    }
}

/// The range of automatic colours is that of the whole plate, found with the extrema of the view.
#[test]
fn ranges_are_those_of_the_whole() {
    for Case { whole, part, edges } in cases() {
        let (whole, part) = (Lab::solved(&whole), Lab::solved(&part));
        for name in ["ux", "uy", "sxy", "s2", "mine"] {
            let command = |mirror: &str| {
                format!("render plate.h5 -o a.png -q {name} --size 90x120 --range full {mirror}")
            };
            whole.run(&command(""));
            part.run(&command(&format!("--mirror={edges}")));
            let range = |lab: &Lab| -> Vec<f64> {
                let png = Png::read(&lab.path("a.png"));
                png.text("ppum:range").split(',').map(|end| end.trim().parse().unwrap()).collect()
            };
            let (own, all) = (range(&part), range(&whole));
            let size = all[1] - all[0];
            // the errors of both solutions
            for (own, all) in own.iter().zip(&all) {
                assert!((own - all).abs() < 1e-3 * size, "{edges} {name}: {own} and {all}");
            }
        }
    }
}

/// Isolines of an even quantity are those of the upper half and their reflections, to the last bit,
/// and arrows and supports, cracks and cells are drawn on both sides.
#[test]
fn overlays_are_mirrored() {
    let part = solved(&cases()[0].part);
    let field = Field::new(&part, 0).unwrap();
    let request = request("syy", Some("bottom"), &ViewRegion::default(), [120, 180]);
    let engine = Engine::default();
    let lines_of = subject(&part, &field, &request);
    let (View { center, .. }, lines) = isolines(&lines_of, &request, vec![0.7, 1.3]);
    assert_eq!(center.y, 0.0);
    let (above, below): (Vec<_>, Vec<_>) =
        lines.iter().partition(|line| line.points.iter().all(|p| p.y >= 0.0));
    assert!(above.len() > 2 && above.len() == below.len());
    for (above, below) in above.iter().zip(&below) {
        let reflected = below.points.iter().rev().map(|p| [p.x, -p.y]);
        assert!(above.points.iter().map(|p| [p.x, p.y]).eq(reflected));
        assert_eq!(above.level, below.level);
    }
    let image = |shown: Vec<Overlay>| {
        let overlays = Overlays { shown, ..Overlays::default() };
        let mirror = Some("bottom".parse().unwrap());
        let mut request =
            Request::from(SceneRequest { overlays, mirror, ..SceneRequest::default() });
        request.look.size = Some([200, 300]);
        page(&subject(&part, &field, &request), &request, &engine).unwrap().0.image()
    };
    for overlay in Overlay::ALL {
        // supports and loads need room around the plate, which pictures without them lack
        let below = if overlay == Overlay::Loads { Overlay::Supports } else { Overlay::Loads };
        let is_outside = matches!(overlay, Overlay::Supports | Overlay::Loads);
        let beside = if is_outside { vec![below] } else { Vec::new() };
        let plain = image(beside.clone());
        let image = image([vec![overlay], beside].concat());
        let [columns, rows] = image.size;
        let is_drawn = |i: u32, j: u32| match (image.pixel(i, j), plain.pixel(i, j)) {
            ([.., 0], [.., 0]) => false,
            (over, under) => over != under,
        };
        // legends stand on the right
        let pixels = || (0..rows).flat_map(|j| (0..columns / 3).map(move |i| (i, j)));
        let count = pixels().filter(|&(i, j)| is_drawn(i, j)).count();
        let is_alone = |&(i, j): &(u32, u32)| is_drawn(i, j) != is_drawn(i, rows - 1 - j);
        let alone = pixels().filter(is_alone).count();
        println!("{overlay:?}: {count} pixels, {alone} on one side alone");
        // the plate has no supports but those on its line, and no points
        let is_empty = matches!(overlay, Overlay::Supports | Overlay::Points);
        assert_eq!(count == 0, is_empty, "{overlay:?}");
        // soft borders of lines differ by rounding
        assert!(alone * 50 <= count, "{overlay:?}: {alone} of {count}");
    }
}

/// The program draws the whole, says so in the file, and a card draws what the processor does.
#[test]
fn the_program_draws_the_whole() {
    let lab = Lab::solved(&cases()[0].part);
    lab.run("render plate.h5 -o half.png --size 64x48 --range 0,3");
    lab.run("render plate.h5 -o a.png --mirror --size 64x96 --range 0,3");
    let (half, whole) = (Png::read(&lab.path("half.png")), Png::read(&lab.path("a.png")));
    assert_eq!(whole.text("ppum:mirror"), "bottom");
    for j in 0..48 {
        for i in 0..64 {
            assert_eq!(whole.pixel(i, j), half.pixel(i, j));
            assert_eq!(whole.pixel(i, 95 - j), half.pixel(i, j));
        }
    }
    // panels, with a shared range; a figure with everything; a film of one step
    lab.run("render plate.h5 -o a.svg --mirror -q ux,uy --shared-range");
    lab.run(
        "render plate.h5 -o a.png --mirror --figure --isolines auto --level-labels --arrows --crosses --overlay \
         cells,supports,loads,rings",
    );
    lab.run("render plate.h5 -o a.gif --mirror --steps all --size 40x60");
    if !has_adapter(&lab) {
        return;
    }
    for options in ["-q sxy --range=-1,1", "-q ux*x+y*sxy --range=-1,1", "-q uy --range=-1,1"] {
        let draw = |backend: &str| {
            lab.run(&format!(
                "render plate.h5 -o a.png --mirror {options} --backend {backend} --center 0.0123,0.0077 --width 1.6 \
                 --size 120x90"
            ));
            Png::read(&lab.path("a.png"))
        };
        let (cpu, gpu) = (draw("cpu"), draw("gpu"));
        assert!(gpu.text("ppum:backend").starts_with("gpu f32"));
        let far = cpu.rgba.iter().zip(&gpu.rgba).filter(|(a, b)| a.abs_diff(**b) > 1).count();
        // pixels at the ends of the range and on the crack
        assert!(far * 250 <= cpu.rgba.len(), "{options}: {far}");
    }
}

/// Straight sides of an outline are lines of symmetry: of a quarter of a ring all four have the
/// same pixels.
#[test]
fn quarters_of_rings_are_mirrored() {
    let lab = Lab::solved(
        r#"
[domain]
outline = { path = [
  { points = [[1, 0], [2, 0]], name = "side" },
  { arc = { center = [0, 0], radius = 2, from = 0, to = 90 } },
  { points = [[0, 2], [0, 1]], name = "side of the other" },
  { arc = { center = [0, 0], radius = 1, from = 90, to = 0 }, name = "bore" },
] }
[material]
young = 1.0
poisson = 0.3
state = "plane-strain"
[[boundary]]
on = { piece = "side" }
symmetry = true
[[boundary]]
on = { piece = "side of the other" }
symmetry = true
[[boundary]]
on = { piece = "bore" }
pressure = "1 + 0.3*cos(2*atan2(y, x))"
[discretization]
cells = [9, 9]
order = 3
"#,
    );
    lab.run(
        "render plate.h5 -o a.png -q energy --mirror --backend cpu --center 0,0 --width 4.4 --size 88x88",
    );
    let png = Png::read(&lab.path("a.png"));
    assert_eq!(png.text("ppum:mirror"), "left,bottom");
    let drawn = (0..88).flat_map(|i| (0..88).map(move |j| (i, j)));
    let in_body = |&(i, j): &(u32, u32)| {
        let [x, y] = [i, j].map(|k| 0.05 * (f64::from(k) - 43.5));
        (1.05..1.95).contains(&x.hypot(y))
    };
    for (i, j) in drawn.filter(in_body) {
        let pixel = png.pixel(i, j);
        assert!(pixel[3] == 255, "{i}, {j}");
        assert_eq!([png.pixel(87 - i, j), png.pixel(i, 87 - j)], [pixel; 2], "{i}, {j}");
    }
    // the whole has no border along its lines of symmetry
    lab.run(
        "render plate.h5 -o b.png -q energy --mirror --backend cpu --center 0,0 --width 4.4 --size 88x88 --overlay cracks",
    );
    let bordered = Png::read(&lab.path("b.png"));
    for (k, middle) in (6..21).flat_map(|k| [43, 44].map(|middle| (k, middle))) {
        for (i, j) in [(k, middle), (middle, k)] {
            assert_eq!(bordered.pixel(i, j), png.pixel(i, j), "{i}, {j}");
        }
    }
}

/// Where the dataset does not know its lines they are named, as of a plate that is no half.
#[test]
fn lines_are_named_where_nobody_knows_them() {
    let lab = Lab::solved(&sound());
    let complaint = lab.fail("render plate.h5 -o a.png --mirror");
    assert!(complaint.contains("`bottom`"), "{complaint}");
    lab.run("render plate.h5 -o a.png --mirror=right,top:antisymmetric -q uy --size 40x40");
    for (wrong, remedy) in
        [("--mirror=left,right", "not both"), ("--mirror=middle", "left, right, bottom or top")]
    {
        let complaint = lab.fail(&format!("render plate.h5 -o a.png {wrong}"));
        assert!(complaint.contains(remedy), "{complaint}");
    }
    lab.fail("export plate.h5 -o a.html --mirror");
}

/// The half-plane of a cylinder with a crack that is a cone.
pub(crate) const CYLINDER: &str = r#"
[domain]
min = [0, -1]
max = [1, 1]
[material]
young = 1.0
poisson = 0.3
state = "axisymmetric"
[[crack]]
points = [[0.2, 0], [0.5, 0.1]]
[[boundary]]
on = "top"
traction = [0, 1]
[[boundary]]
on = "bottom"
traction = [0, -1]
[discretization]
level = 3
order = 2
"#;

/// Figures of a body of revolution show the whole, in panels and films too; images without axes
/// and those that say so do not. The radial displacement and shear change their sign at the axis.
#[test]
fn figures_show_bodies_of_revolution() {
    let lab = Lab::solved(CYLINDER);
    let mirror = |name: &str| {
        let texts = Png::read(&lab.path(name)).texts;
        texts.into_iter().find(|(key, _)| key == "ppum:mirror").map(|(_, edges)| edges)
    };
    for (options, edges) in [
        ("--figure", Some("left")),
        ("-q ux,shoop", Some("left")),
        ("--figure --mirror=none", None),
        ("--figure --mirror=top", Some("top")),
        ("", None),
        ("--mirror", Some("left")),
    ] {
        lab.run(&format!("render plate.h5 -o a.png --size 600x300 {options}"));
        assert_eq!(mirror("a.png").as_deref(), edges, "{options}");
    }
    lab.run("render plate.h5 -o a.gif --figure --steps all --size 400x300");
    let dataset = ppum_format::read(&lab.path("plate.h5")).unwrap();
    for (name, sign) in
        [("ux", -1.0), ("uy", 1.0), ("sxy", -1.0), ("syy", 1.0), ("shoop", 1.0), ("ehoop", 1.0)]
    {
        let place = ViewRegion::default();
        let drawn = drawn(&dataset, request(name, Some("auto"), &place, [64, 64]), Samples::CENTER);
        for row in values(&drawn).chunks(64) {
            let pairs = row.iter().zip(row.iter().rev());
            let differs = |(a, b): (&f64, &f64)| a.is_finite() && *a != sign * b;
            assert_eq!(pairs.filter(|pair| differs(*pair)).count(), 0, "{name}");
        }
        assert!(values(&drawn).iter().filter(|value| value.is_finite()).count() > 1000, "{name}");
    }
}

/// Stresses of a body of revolution depend on u_x itself: in images they are what formulas of them
/// are, which are evaluated in another way.
#[test]
fn hoop_stresses_see_displacements() {
    let lab = Lab::solved(CYLINDER);
    let dataset = ppum_format::read(&lab.path("plate.h5")).unwrap();
    let image = |quantity: &str| {
        let place = ViewRegion::default();
        let drawn = drawn(&dataset, request(quantity, None, &place, [64, 64]), Samples::CENTER);
        values(&drawn).to_vec()
    };
    for name in ["shoop", "sxx", "syy", "von-mises", "energy"] {
        let (direct, formula) = (image(name), image(&format!("1*({})", name.replace('-', "_"))));
        let differs =
            |(a, b): (&f64, &f64)| a.is_finite() && (a - b).abs() > 1e-9 * (1.0 + b.abs());
        assert_eq!(direct.iter().zip(&formula).filter(|pair| differs(*pair)).count(), 0, "{name}");
        assert!(direct.iter().filter(|value| value.is_finite()).count() > 1000, "{name}");
    }
}
