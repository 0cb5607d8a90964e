//! Figures as they are seen, and the rules that all of them keep.

use ppum::vec2::{Rect, Vec2, vec2};
use ppum_render::colormap::Colormap;
use ppum_render::extrema::{Extrema, Extremum, ExtremumSite};
use ppum_render::image::{Image, Rgba};
use ppum_render::picture::{ColoredRaster, Style};
use ppum_render::range::{Basis, ColorRange, RangeChoice};
use ppum_render::raster::Raster;
use ppum_render::scale::Scale;
use ppum_render::view::View;
use ppum_testkit::random::Random;

use super::color_bar::{ARROW, BAR};
use super::color_key::ColorKey;
use super::metrics::BAR_GAP;
use super::style::HATCH_STEP;
use super::*;
use crate::canvas::{CanvasItem, TextItem};
use crate::overlay::{LegendEntry, Symbol};

const SIZE: [u32; 2] = [640, 480];
const PAGE: Rgba = [255, 255, 255, 255];
const INK: Rgba = [38, 38, 42, 255];
const HATCH: Rgba = [214, 214, 218, 255];
const LONG: &str = "A plate with a title that is much longer than the figure is wide, as they are";

fn labels() -> Labels {
    let word = |text: &str| text.to_owned();
    Labels {
        title: word(LONG),
        quantity: word("a quantity whose name is longer than the figure is high, von Mises say"),
        unit: word("MPa"),
        length_unit: word("mm"),
        ..Labels::default()
    }
}

/// x on a plate, or what classes there are, NaN in its upper left quarter.
fn plate(half: Vec2, room: [u32; 2], style: &Style) -> ColoredRaster {
    let view = View::hug(Rect::around(Vec2::ZERO, half), room).unwrap();
    let classes = style.colormap.classes();
    let raster = Raster::from_fn(view.pixels, |i, j| match view.offset(i, j) {
        p if p.x < 0.0 && p.y > 0.0 => f64::NAN,
        _ if !classes.is_empty() => classes[(i + j) as usize % classes.len()],
        p => p.x,
    });
    ColoredRaster::bare(&raster, &view, style).unwrap()
}

fn picture(half: f64, range: RangeChoice) -> ColoredRaster {
    let style = Style { range, ..Style::default() };
    plate(vec2(half, half), plot_area(LONG, &FigureStyle::pixels(SIZE)).unwrap(), &style)
}

fn panel(picture: &ColoredRaster, labels: Labels) -> Panel<'_> {
    Panel { picture, layers: vec![], legend: vec![], labels, cracks: &[], bar_of: None }
}

fn drawn(picture: &ColoredRaster) -> Image {
    figure(panel(picture, labels()), &FigureStyle::pixels(SIZE)).unwrap().image()
}

/// The corner of the plot, found as the first place with the picture's last row of colours.
fn plot_corner(page: &Image, picture: &ColoredRaster) -> [u32; 2] {
    let [columns, rows] = picture.image.size;
    let last_row = |x: u32, y: u32| {
        (0..columns).all(|i| page.pixel(x + i, y) == picture.image.pixel(i, rows - 1))
    };
    let mut places = (rows..SIZE[1]).flat_map(|y| (0..SIZE[0] - columns).map(move |x| [x, y]));
    let found = places.rfind(|&[x, y]| last_row(x, y)).expect("the plot is on the page");
    [found[0], found[1] + 1 - rows]
}

#[test]
fn the_picture_is_shown_pixel_for_pixel() {
    let picture = picture(1.0, RangeChoice::Auto);
    let page = drawn(&picture);
    let [x, y] = plot_corner(&page, &picture);
    let [columns, rows] = picture.image.size;
    assert_eq!(page.size, SIZE);
    for (i, j) in (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j))) {
        let (shown, color) = (page.pixel(x + i, y + j), picture.image.pixel(i, j));
        let expected = match (color[3], (i + j) % HATCH_STEP) {
            (0, 0) => HATCH,
            (0, _) => PAGE,
            _ => color,
        };
        assert_eq!(shown, expected, "{i}, {j}");
    }
    for (i, j) in [(x - 1, y - 1), (x + columns, y + rows), (x - 1, y + 7)] {
        assert_eq!(page.pixel(i, j), INK, "the frame");
    }
}

#[test]
fn ticks_are_at_their_values() {
    let picture = picture(1.0, RangeChoice::Auto);
    let page = drawn(&picture);
    let [x, y] = plot_corner(&page, &picture);
    let [columns, rows] = picture.image.size;
    let below = y + rows + 3;
    let marked: Vec<u32> =
        (0..=columns + 1).filter(|&i| page.pixel(x + i - 1, below) == INK).collect();
    let expected = [0, columns / 4, columns / 2, 3 * columns / 4, columns];
    assert_eq!(marked.len(), 5);
    for (found, place) in marked.into_iter().zip(expected) {
        assert!(found.abs_diff(place) <= 1, "{found} {place}");
    }
}

/// Below and above: in the colours of the ends, or in contrasting ones.
#[test]
fn the_bar_runs_from_low_to_high_and_ends_in_arrows() {
    let plain = picture(1.0, RangeChoice::Fixed(-0.5, 0.5));
    let mut contrasting = plain.clone();
    contrasting.colormap = contrasting.colormap.contrasting();
    for picture in [plain, contrasting] {
        let page = drawn(&picture);
        let [x, y] = plot_corner(&page, &picture);
        let [columns, rows] = picture.image.size;
        let column = x + columns + (BAR_GAP + BAR / 2.0) as u32;
        let map = &picture.colormap;
        assert_eq!(page.pixel(column, y + ARROW as u32 - 3), map.above);
        assert_eq!(page.pixel(column, y + rows - ARROW as u32 + 3), map.below);
        let near = |a: Rgba, b: Rgba| (0..3).all(|k| a[k].abs_diff(b[k]) < 6);
        assert!(near(page.pixel(column, y + ARROW as u32 + 1), map.color(1.0)));
        assert!(near(page.pixel(column, y + rows - ARROW as u32 - 2), map.color(0.0)));
        assert!(near(page.pixel(column, y + rows / 2), map.color(0.5)));
    }
}

#[test]
fn figures_without_room_are_refused() {
    let picture = picture(1.0, RangeChoice::Auto);
    let refused = |size| figure(panel(&picture, labels()), &FigureStyle::pixels(size)).unwrap_err();
    assert!(matches!(refused([200, 480]), FigureError::TooSmall { .. }));
    assert!(matches!(refused([500, 400]), FigureError::TooLarge { .. }));
    let FigureError::TooSmall { least, .. } = refused([10, 10]) else { unreachable!() };
    let room = plot_area(LONG, &FigureStyle::pixels(least)).unwrap();
    assert_eq!(room.iter().min(), Some(&48));
    let design = FigureStyle::pixels(SIZE);
    let grid = PanelGrid::new([2, 1]);
    let error = panels("", &vec![panel(&picture, labels()); 3], grid, &design).unwrap_err();
    assert_eq!(error, FigureError::Panels { panels: 3, cells: 2 });
    assert!(matches!(panels("", &[], grid, &design), Err(FigureError::Panels { .. })));
}

#[test]
fn one_bar_explains_one_range() {
    let design = FigureStyle::pixels([1200, 900]);
    let grid = PanelGrid { shared_bar: true, ..PanelGrid::new([2, 1]) };
    let room = panel_area("", &[""], grid, &design).unwrap();
    let of = |range: RangeChoice| plate(vec2(1.0, 1.0), room, &Style { range, ..Style::default() });
    let [a, b, c] = [
        RangeChoice::Fixed(-2.0, 0.5),
        RangeChoice::Fixed(-2.0, 0.5),
        RangeChoice::Fixed(0.0, 2.0),
    ]
    .map(of);
    let both = |a, b| {
        panels("", &[panel(a, Labels::default()), panel(b, Labels::default())], grid, &design)
    };
    assert!(both(&a, &b).is_ok());
    assert_eq!(both(&a, &c).unwrap_err(), FigureError::Ranges);
}

/// Sizes on paper: nine points are nine points, whatever the number of pixels.
#[test]
fn lengths_follow_the_size_on_paper() {
    for dpi in [72.0, 150.0, 600.0] {
        let design = FigureStyle::inches([6.5, 4.5], dpi);
        assert_eq!(design.size, [6.5 * dpi, 4.5 * dpi].map(|n| n.round() as u32));
        let picture = plate(vec2(1.0, 1.0), plot_area("", &design).unwrap(), &Style::default());
        let page = figure(panel(&picture, Labels::default()), &design).unwrap();
        let size = |name: &str| texts(&page).iter().find(|t| t.text == name).unwrap().size;
        assert!((size("x") / dpi * 72.0 - 9.0).abs() < 1e-9);
    }
}

/// Where bands end at short numbers these are the marks, else round ones are.
#[test]
fn bands_are_marked_at_their_borders() {
    let marks = |max: f64, bands: u16| {
        let colormap = Colormap::named("batlow").unwrap().banded(bands);
        let style = Style { colormap, range: RangeChoice::Fixed(-0.5, max), ..Style::default() };
        let none = TickChoice::At(vec![]);
        let design = FigureStyle {
            x_ticks: none.clone(),
            y_ticks: none,
            ..FigureStyle::pixels([1024, 768])
        };
        let picture = plate(vec2(1.0, 1.0), plot_area("", &design).unwrap(), &style);
        let page = figure(panel(&picture, Labels::default()), &design).unwrap();
        let mut words: Vec<String> = texts(&page).iter().map(|line| line.text.clone()).collect();
        words.retain(|word| word.len() > 1);
        words
    };
    assert_eq!(marks(1.0, 6), ["−0.5", "−0.25", "0.25", "0.5", "0.75"]);
    assert_eq!(marks(0.1, 3), ["−0.5", "−0.3", "−0.1", "0.1"]);
    // a seventh is no short number, and forty are too many
    assert!(marks(0.5, 7).contains(&"−0.4".to_owned()));
    assert!(marks(1.5, 40).contains(&"0.2".to_owned()));
}

/// Values with a colour each have bands of one length, each with its label in the middle.
#[test]
fn classes_are_marked_in_their_middle() {
    let classes = [0.0, 1.0, 5.0, 30.0];
    for bar in [BarPlace::Right, BarPlace::Bottom] {
        let none = TickChoice::At(vec![]);
        let design =
            FigureStyle { x_ticks: none.clone(), y_ticks: none, bar, ..FigureStyle::pixels(SIZE) };
        let room = plot_area("", &design).unwrap();
        let view = View::hug(Rect::around(Vec2::ZERO, vec2(1.0, 1.0)), room).unwrap();
        let raster = Raster::from_fn(view.pixels, |i, j| classes[((i + j) % 4) as usize]);
        let style = Style::default().classed(&raster.whole_numbers(4).unwrap());
        let picture = ColoredRaster::bare(&raster, &view, &style).unwrap();
        let page = figure(panel(&picture, Labels::default()), &design).unwrap();
        let key = ColorKey::new(&picture, &Labels::default());
        let image = page.items.iter().find_map(|item| match item {
            CanvasItem::Picture { image, corner } => Some((image.clone(), corner.map(f64::from))),
            _ => None,
        });
        let (image, corner) = image.expect("the bar's colours");
        let side = usize::from(bar == BarPlace::Right);
        let length = f64::from(image.size[side]);
        for (k, value) in classes.into_iter().enumerate() {
            let label = ppum::text::trimmed(value);
            let line = *texts(&page).iter().find(|line| line.text == label).expect("a label");
            let [lo, hi] = CanvasItem::Text(line.clone()).bounds();
            let middle = (lo + hi) * 0.5 - Vec2::from(corner);
            let along = if side == 0 { middle.x / length } else { 1.0 - middle.y / length };
            assert!((along - (k as f64 + 0.5) / 4.0).abs() < 0.02, "{bar:?} {value}: {along}");
            assert_eq!(key.color(along), picture.colormap.class_color(k));
            let colors = image.rgba.as_chunks::<4>().0;
            let share = colors.iter().filter(|c| **c == key.color(along)).count() * 4;
            assert!(share.abs_diff(colors.len()) <= 40 * BAR as usize / 2, "a quarter each");
        }
    }
}

/// A bar for several panels: it knows of the values of all.
#[test]
fn panels_share_a_bar() {
    let design = FigureStyle::pixels([1500, 900]);
    let grid = PanelGrid::new([3, 1]);
    let room = panel_area("", &[""], grid, &design).unwrap();
    let of = |range: RangeChoice| plate(vec2(1.0, 1.0), room, &Style { range, ..Style::default() });
    let [a, b] = [RangeChoice::Fixed(-2.0, 0.5), RangeChoice::Fixed(0.0, 2.0)].map(of);
    let draw = |bars: [Option<usize>; 3], pictures: [&ColoredRaster; 3]| {
        let panel = |(bar_of, picture)| Panel { bar_of, ..panel(picture, Labels::default()) };
        let all: Vec<Panel<'_>> = bars.into_iter().zip(pictures).map(panel).collect();
        let page = panels("", &all, grid, &design)?;
        Ok(page.items.iter().filter(|item| matches!(item, CanvasItem::Picture { .. })).count())
    };
    assert_eq!(draw([None; 3], [&a, &a, &b]), Ok(3));
    assert_eq!(draw([Some(1), None, None], [&a, &a, &b]), Ok(2));
    assert_eq!(draw([None, None, Some(0)], [&a, &b, &a]), Ok(2));
    assert_eq!(draw([Some(2), Some(2), None], [&a, &a, &a]), Ok(1));
    assert_eq!(draw([Some(2), Some(2), None], [&a, &a, &b]), Err(FigureError::Ranges));
    // nobody is left without
    assert_eq!(draw([Some(7), Some(0), Some(2)], [&a, &a, &b]), Ok(3));
}

/// A picture of nothing says so, and its bar has no marks.
#[test]
fn a_picture_without_values_says_so() {
    let none = TickChoice::At(vec![]);
    let design = FigureStyle { x_ticks: none.clone(), y_ticks: none, ..FigureStyle::pixels(SIZE) };
    let view = View::hug(Rect::around(Vec2::ZERO, vec2(1.0, 1.0)), [200, 200]).unwrap();
    let words = |value: f64, quantity: &str| {
        let raster = Raster::from_fn(view.pixels, |_, _| value);
        let picture = ColoredRaster::bare(&raster, &view, &Style::default()).unwrap();
        let [x, y] = [String::new(), String::new()];
        let labels = Labels { quantity: quantity.to_owned(), x, y, ..Labels::default() };
        let page = figure(panel(&picture, labels), &design).unwrap();
        texts(&page).iter().map(|line| line.text.clone()).collect::<Vec<_>>()
    };
    assert_eq!(words(f64::NAN, "q"), ["q, no values"]);
    assert_eq!(words(f64::NAN, ""), ["no values"]);
    assert_eq!(words(3.5, "q"), ["3.5", "q, one value"]);
    assert_eq!(words(f64::INFINITY, "q"), ["to ∞", "q, no finite values"]);
    assert_eq!(words(f64::NEG_INFINITY, ""), ["to −∞", "no finite values"]);
}

/// Where all values are infinite the bar has the colour that the plate has, at the end that says
/// so, and no other.
#[test]
fn a_bar_of_infinite_values_has_no_colours_but_its_ends() {
    let view = View::hug(Rect::around(Vec2::ZERO, vec2(1.0, 1.0)), [200, 200]).unwrap();
    for sign in [1.0, -1.0] {
        let raster = Raster::from_fn(view.pixels, |_, _| sign * f64::INFINITY);
        let picture = ColoredRaster::bare(&raster, &view, &Style::default()).unwrap();
        let key = ColorKey::new(&picture, &Labels::default());
        assert!((0..=10).all(|k| key.color(f64::from(k) / 10.0) == [0; 4]), "nothing between");
        let page = figure(panel(&picture, Labels::default()), &FigureStyle::pixels(SIZE)).unwrap();
        let fills = page.items.iter().filter_map(|item| match item {
            CanvasItem::Fill { color, outline } => Some((*color, outline.pieces[0].len())),
            _ => None,
        });
        let seen = picture.image.pixel(100, 100);
        let triangles: Vec<_> = fills.filter(|(_, corners)| *corners == 3).collect();
        assert_eq!(triangles, [(seen, 3)], "{sign}");
    }
}

/// A transparent page shows what is behind it, in holes too; a dark one is dark to its corners.
#[test]
fn pages_have_the_colours_of_their_theme() {
    let picture = picture(1.0, RangeChoice::Auto);
    let corner = |design: FigureStyle| {
        let image = figure(panel(&picture, labels()), &design).unwrap().image();
        (image.pixel(0, 0), image)
    };
    let (seen, image) = corner(FigureStyle { transparent: true, ..FigureStyle::pixels(SIZE) });
    assert_eq!(seen, [0; 4]);
    let clear = image.rgba.as_chunks::<4>().0.iter().filter(|p| p[3] == 0).count();
    let undefined = picture.image.rgba.as_chunks::<4>().0.iter().filter(|p| p[3] == 0).count();
    let outside = image.rgba.len() / 4 - picture.image.rgba.len() / 4;
    assert!(clear > outside * 9 / 10 && clear > undefined * 3 / 4, "{clear}");
    let (seen, image) = corner(FigureStyle { theme: Theme::Dark, ..FigureStyle::pixels(SIZE) });
    assert!(seen[..3].iter().all(|c| *c < 40) && seen[3] == 255);
    assert!(!image.rgba.as_chunks::<4>().0.contains(&PAGE), "no white is left");
}

/// More or fewer pixels per inch change nothing but the size on paper.
#[test]
fn pixels_do_not_depend_on_the_size_on_paper() {
    let picture = picture(1.0, RangeChoice::Auto);
    let drawn = |design: &FigureStyle| figure(panel(&picture, labels()), design).unwrap().image();
    let plain = FigureStyle::pixels(SIZE);
    assert_eq!(drawn(&plain), drawn(&plain.clone().at(300.0)));
}

fn texts(page: &Canvas) -> Vec<&TextItem> {
    let mut lines = Vec::new();
    for item in &page.items {
        if let CanvasItem::Text(line) = item {
            lines.push(line);
        }
    }
    lines
}

/// True if two boxes share more than a pixel's rounding.
fn overlap([a, b]: [Vec2; 2], [c, d]: [Vec2; 2]) -> bool {
    let depth = b.min(d) - a.max(c);
    depth.x > 1.0 && depth.y > 1.0
}

/// Nothing leaves the page, no line of text touches another one, a plot, or a bar.
fn check(page: &Canvas, what: &str) {
    let size = Vec2::from(page.size.map(f64::from));
    for item in &page.items {
        let [lo, hi] = item.bounds();
        let inside = lo.x >= 0.0 && lo.y >= 0.0 && hi.x <= size.x && hi.y <= size.y;
        assert!(inside || lo.x > hi.x, "{what}: {lo:?} {hi:?} leaves {size:?}");
    }
    let is_text = |item: &&CanvasItem| matches!(item, CanvasItem::Text(_));
    let is_area =
        |item: &&CanvasItem| matches!(item, CanvasItem::Inset { .. } | CanvasItem::Picture { .. });
    let lines: Vec<&CanvasItem> = page.items.iter().filter(is_text).collect();
    let areas: Vec<&CanvasItem> = page.items.iter().filter(is_area).collect();
    for (k, line) in lines.iter().enumerate() {
        for other in lines[k + 1..].iter().chain(&areas) {
            assert!(
                !overlap(line.bounds(), other.bounds()),
                "{what}: {line:?} on {other:?} at {:?}",
                other.bounds()
            );
        }
    }
    let ground =
        |item: &&&CanvasItem| matches!(item, CanvasItem::Fill { color: [255, 255, 255, 225], .. });
    let all: Vec<&CanvasItem> = page.items.iter().collect();
    for legend in all.iter().filter(ground) {
        let is_free = |area: &&CanvasItem| !overlap(legend.bounds(), area.bounds());
        assert!(areas.iter().all(is_free), "{what}: a legend hides something");
    }
    for (k, area) in areas.iter().enumerate() {
        assert!(
            areas[k + 1..].iter().all(|other| !overlap(area.bounds(), other.bounds())),
            "{what}"
        );
    }
}

/// A text of some words.
fn words(random: &mut Random, most: usize) -> String {
    let all = ["σ_{xy}", "plate", "a", "of", "Kerbspannungskonzentration", "板", "3·10⁻⁴", "(MPa)"];
    (0..random.below(most + 1)).map(|_| random.pick(&all)).collect::<Vec<_>>().join(" ")
}

fn random_design(random: &mut Random) -> FigureStyle {
    let size = [random.between(320.0, 1500.0) as u32, random.between(320.0, 1500.0) as u32];
    let mut design = FigureStyle::pixels(size);
    design.font_size *= random.between(0.7, 1.1);
    design.bar = random.pick(&[BarPlace::Right, BarPlace::Bottom, BarPlace::None]);
    design.theme = random.pick(&[Theme::Light, Theme::Dark]);
    design.transparent = random.below(2) == 0;
    let ticks = [TickChoice::Auto, TickChoice::Count(3), TickChoice::At(vec![0.0, 1e9])];
    design.bar_ticks = ticks[random.below(3)].clone();
    design
}

fn random_style(random: &mut Random, half: Vec2) -> Style {
    let (fixed, percentiles) =
        (RangeChoice::Fixed(-0.3 * half.x, 0.4 * half.x), RangeChoice::Percentiles(7.0, 90.0));
    let range = random.pick(&[RangeChoice::Auto, fixed, percentiles]);
    let scale = random.pick(&[Scale::Linear, Scale::SymLog]);
    let map = Colormap::named(random.pick(&["viridis", "vik", "twilight"])).unwrap();
    let colormap = if random.below(3) == 0 { map.banded(5) } else { map };
    let style = Style { range, scale, colormap, ..Style::default() };
    let classes: Vec<f64> = (0..random.below(12)).map(|k| (k * k) as f64).collect();
    if random.below(3) == 0 { style.classed(&classes) } else { style }
}

fn random_labels(random: &mut Random) -> Labels {
    Labels {
        title: words(random, 30),
        quantity: words(random, 12),
        unit: random.pick(&["", "MPa"]).to_owned(),
        x: random.pick(&["", "x", "a long name of the axis x"]).to_owned(),
        y: random.pick(&["", "y", "a very long name of the axis y"]).to_owned(),
        length_unit: random.pick(&["", "mm"]).to_owned(),
    }
}

/// Plates from a thousandth to a million across, from 1:60 to 60:1.
fn random_half(random: &mut Random) -> Vec2 {
    let (size, shape) = (random.between(-3.0, 6.0), random.between(-0.9, 0.9));
    vec2(10f64.powf(size + shape), 10f64.powf(size - shape))
}

/// A legend for which there is no room in the picture, or none.
fn random_legend(random: &mut Random) -> Vec<LegendEntry> {
    let entry =
        |k: usize| LegendEntry::new(Symbol::Square([k as u8; 4]), format!("longest arrow {k}"));
    (0..random.below(4)).map(entry).collect()
}

fn untitled() -> Labels {
    Labels { title: String::new(), ..labels() }
}

/// A picture of a robust range with values beyond its ends.
fn peaked(half: f64, design: &FigureStyle, beyond: [f64; 2], scale: Scale) -> ColoredRaster {
    let room = plot_area("", design).unwrap();
    let view = View::hug(Rect::around(Vec2::ZERO, vec2(half, half)), room).unwrap();
    let raster = Raster::from_fn(view.pixels, |i, _| 1.0 + f64::from(i));
    let at = |value: f64| Extremum { value, offset: Vec2::ZERO, on: ExtremumSite::Inside };
    let values =
        Extrema { center: Vec2::ZERO, min: at(beyond[0]), max: at(beyond[1]), singular: vec![] };
    let max = f64::from(view.pixels[0]);
    let span = ColorRange { min: 1.0, max, basis: Basis::Robust, values: Some(values) };
    ColoredRaster::spanning(&raster, &view, &Style { scale, ..Style::default() }, span).unwrap()
}

/// The ends of a bar say how far values go, wherever it stands, and nothing touches these words.
#[test]
fn bars_say_what_lies_beyond() {
    let inf = f64::INFINITY;
    for (beyond, words) in [
        ([-inf, inf], ["to −∞", "to ∞"]),
        ([-12.34, 1234.5], ["to −12.3", "to 1230"]),
        ([-2.5, 3.5e9], ["to −2.5", "to 4×10⁹"]),
        ([-1.23456e-7, 1e300], ["to 0", "to 10³⁰⁰"]),
    ] {
        for bar in [BarPlace::Right, BarPlace::Bottom] {
            for size in [[500, 420], [1024, 768], [420, 900]] {
                let design = FigureStyle { bar, ..FigureStyle::pixels(size) };
                let picture = peaked(1.0, &design, beyond, Scale::Linear);
                assert!(picture.has_below && picture.has_above);
                let page = figure(panel(&picture, untitled()), &design).unwrap();
                check(&page, &format!("{beyond:?} {bar:?} {size:?}"));
                for word in words {
                    let has = texts(&page).iter().any(|line| line.text.starts_with(word));
                    assert!(has, "{word}: {:?}", texts(&page));
                }
            }
        }
    }
    let design = FigureStyle::pixels(SIZE);
    let says = |picture: &ColoredRaster| {
        let page = figure(panel(picture, untitled()), &design).unwrap();
        texts(&page).iter().any(|line| line.text.starts_with("to "))
    };
    assert!(says(&peaked(1.0, &design, [0.5, inf], Scale::Log)));
    assert!(!says(&peaked(1.0, &design, [1.0, 2.0], Scale::Linear)));
    let mut given = peaked(1.0, &design, [-inf, inf], Scale::Linear);
    given.span.basis = Basis::Given;
    assert!(!says(&given), "who gives a range knows it");
}

#[test]
fn figures_keep_to_their_page() {
    let mut random = Random(41);
    let (mut count, mut legends) = (0, [0, 0]);
    for case in 0..120 {
        let (design, labels, half) =
            (random_design(&mut random), random_labels(&mut random), random_half(&mut random));
        let Ok(room) = plot_area(&labels.title, &design) else { continue };
        let picture = plate(half, room, &random_style(&mut random, half));
        let legend = random_legend(&mut random);
        let panel = Panel { legend: legend.clone(), ..panel(&picture, labels.clone()) };
        let is_lacking = lacks_legend(&panel, room, &design);
        let page = figure(panel, &design).unwrap();
        check(&page, &format!("case {case}, {half:?}, {design:?}, {labels:?}"));
        let is_there =
            |entry: &LegendEntry| texts(&page).iter().any(|line| line.text == entry.label);
        assert!(legend.iter().all(|entry| is_there(entry) != is_lacking), "case {case}");
        legends[usize::from(is_lacking)] += legend.len();
        let shown: String = texts(&page).iter().map(|line| line.text.as_str()).collect();
        let first: String =
            labels.title.split_whitespace().next().unwrap_or("").chars().take(3).collect();
        assert!(shown.contains(&first), "case {case}: the title is there");
        count += 1;
    }
    assert!(count > 80, "{count}");
    assert!(legends[0] > legends[1] && legends[1] > 0, "{legends:?}");
}

#[test]
fn panels_keep_to_their_page() {
    let mut random = Random(43);
    let mut count = 0;
    for case in 0..24 {
        let [columns, rows] = [1 + random.below(3) as u32, 1 + random.below(3) as u32];
        let grid =
            PanelGrid { shared_bar: random.below(2) == 0, ..PanelGrid::new([columns, rows]) };
        let mut design = random_design(&mut random);
        design.size = design.size.map(|n| n + 900);
        let (half, title) = (random_half(&mut random), words(&mut random, 20));
        let all: Vec<Labels> =
            (0..1 + random.below(grid.cells())).map(|_| random_labels(&mut random)).collect();
        let captions: Vec<&str> = all.iter().map(|labels| labels.title.as_str()).collect();
        let Ok(room) = panel_area(&title, &captions, grid, &design) else { continue };
        let picture = plate(half, room, &random_style(&mut random, half));
        let mut panel = |labels| Panel {
            bar_of: Some(random.below(20)),
            legend: random_legend(&mut random),
            ..panel(&picture, labels)
        };
        let all: Vec<Panel<'_>> = all.into_iter().map(&mut panel).collect();
        let page = panels(&title, &all, grid, &design).unwrap();
        check(&page, &format!("case {case}, {grid:?}, {half:?}, {design:?}"));
        count += 1;
    }
    assert!(count > 12, "{count}");
}

/// A page whose height is free leaves its pictures, of any shape and number, no more than they
/// need.
#[test]
fn heights_are_those_of_what_is_drawn() {
    let mut random = Random(7);
    for _ in 0..200 {
        let aspect = 10f64.powf(random.between(-0.5, 2.0));
        let parts = [1 + random.below(3) as u32, 1 + random.below(4) as u32];
        let captions = vec!["(a) a caption"; (parts[0] * parts[1]) as usize];
        let room =
            |design: &FigureStyle| panel_area("A title", &captions, PanelGrid::new(parts), design);
        let design = FigureStyle::inches([random.between(7.0, 12.0), 1.0], 150.0);
        let found = hugging(&design, aspect, parts, &BarPlace::ANYWHERE, room).unwrap();
        let [columns, rows] = room(&found).unwrap().map(f64::from);
        let wanted = (columns / aspect).max(48.0);
        assert!((rows - wanted).abs() <= 1.0, "{rows} for {wanted}, {parts:?}");
        assert_eq!(found.size[0], design.size[0]);
    }
}
