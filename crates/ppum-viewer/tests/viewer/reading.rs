//! Reading values at points: all that is shown is held against the field, evaluated here by itself.

use std::path::Path;

use egui::{Event, Key, Modifiers, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use ppum::crack::{SegmentId, Side};
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::progress::unwatched;
use ppum::quantity::{Quantity, QuantityGradient};
use ppum::vec2::{Vec2, vec2 as v};
use ppum_fracture::solve::solve;
use ppum_problem::Problem;
use ppum_scene::location::Location;
use ppum_scene::magnification::Magnification;
use ppum_scene::owner::Owner;
use ppum_viewer::Viewer;
use ppum_viewer::measure::probe::ProbeReading;
use ppum_viewer::session::VisibleRegion;

use crate::kit::{at, hover, plate, settle, window};

type Window = Harness<'static, Viewer>;

const SIZE: [f32; 2] = [1000.0, 700.0];

fn hovered(window: &Window) -> ProbeReading {
    window.state().viewports[0].tools.hover.clone().expect("the pointer is over the plate")
}

fn show(window: &mut Window, quantity: &str, place: Option<VisibleRegion>) {
    let pane = &mut window.state_mut().session.panes[0];
    pane.scene.quantity = Some(quantity.to_owned());
    pane.place = place;
    settle(window);
}

/// The texts of all labels that begin so.
fn has_label(window: &Window, part: &str) -> bool {
    window.query_all_by_label_contains(part).next().is_some()
}

#[test]
fn the_pointer_reads_what_the_field_has_there() {
    let dataset = plate();
    let mut window = window(dataset.clone(), SIZE);
    show(&mut window, "syy", None);
    let field = Field::new(&dataset, 0).expect("a field");
    let quantity = Quantity::parse("syy", &field).expect("a quantity");
    for point in [v(0.31, 0.42), v(-0.7, -0.9), v(0.02, 0.8)] {
        hover(&mut window, point);
        let read = hovered(&window);
        // the pointer stands on a position in f32 points, half a thousandth of the plate wide
        assert!((read.spot.point() - point).length() < 1e-3, "{:?}", read.spot);
        let (anchor, offset) = (read.spot.anchor(), read.spot.offset());
        let value = quantity.at(&mut field.at(anchor), offset, Side::Above);
        assert_eq!(read.sides.len(), 1);
        assert!((read.sides[0].value - value).abs() <= 1e-12 * value.abs());
        // the gradient against differences, whose own error is h² and rounding by h
        let h = 1e-5;
        let mut local = field.at(anchor);
        let mut difference = |d: Vec2| {
            let [a, b] =
                [offset + d * h, offset - d * h].map(|o| quantity.at(&mut local, o, Side::Above));
            (a - b) / (2.0 * h)
        };
        let expected = v(difference(v(1.0, 0.0)), difference(v(0.0, 1.0)));
        let miss = (read.sides[0].gradient - expected).length();
        assert!(miss < 1e-5 * (1.0 + expected.length()), "{miss} {expected:?}");
        assert!((read.patches.iter().map(|(_, phi)| phi).sum::<f64>() - 1.0).abs() < 1e-13);
        let Some(Owner::Cell { patch: cell, level }) = read.owner else { panic!("outside") };
        let partition = field.step.partition.boxes();
        assert!(partition.cell[cell as usize].contains(read.spot.point()));
        assert_eq!(level, partition.level[cell as usize]);
        assert!(has_label(&window, "syy = "));
    }
}

#[test]
fn on_a_crack_both_sides_are_read() {
    let dataset = plate();
    let mut window = window(dataset.clone(), SIZE);
    show(&mut window, "uy", None);
    let field = Field::new(&dataset, 0).expect("a field");
    let uy = Quantity::parse("uy", &field).expect("a quantity");
    let crack = &field.step.cracks[0];
    let point = crack.points[0] + (crack.points[1] - crack.points[0]) * 0.4;
    // two points beside it, the crack is meant
    let beside = at(&window, point) + vec2(0.0, 2.0);
    window.hover_at(beside);
    settle(&mut window);
    let read = hovered(&window);
    let mut local = field.on(SegmentId { crack: 0, segment: 0 }, read.spot.anchor());
    let [above, below] =
        [Side::Above, Side::Below].map(|side| uy.at(&mut local, read.spot.offset(), side));
    assert_eq!(read.sides.iter().map(|s| s.value).collect::<Vec<_>>(), [above, below]);
    assert_eq!(read.jump(), Some(above - below));
    assert!(above > below, "the crack is open");
    assert!(has_label(&window, "jump"));
    // the quantities of its faces
    let faces = |name: &str| {
        read.faces.iter().find(|(symbol, _)| symbol == name).expect("a face").1.clone()
    };
    let mut on = |name: &str| {
        let quantity = Quantity::parse(name, &field).expect("a quantity");
        [Side::Above, Side::Below].map(|side| quantity.at(&mut local, read.spot.offset(), side))
    };
    let m = (crack.points[1] - crack.points[0]).unit().left();
    let ([xx, yy, xy], [ux, uy]) = (["sxx", "syy", "sxy"].map(&mut on), ["ux", "uy"].map(&mut on));
    let opening = v(ux[0] - ux[1], uy[0] - uy[1]).dot(m);
    for (k, traction) in faces("σ_{n}").into_iter().enumerate() {
        let exact = v(xx[k] * m.x + xy[k] * m.y, xy[k] * m.x + yy[k] * m.y).dot(m);
        assert!((traction - exact).abs() < 1e-12, "{traction} {exact}");
    }
    assert!((faces("opening")[0] - opening).abs() < 1e-14 && faces("closed") == [0.0]);
    assert!(has_label(&window, "σn ") && has_label(&window, "open"));
    // far from it, and close to it with Shift, there is one value
    window.hover_at(beside + vec2(0.0, 30.0));
    settle(&mut window);
    assert_eq!(hovered(&window).sides.len(), 1);
}

#[test]
fn a_tip_has_an_infinite_stress_and_a_finite_displacement() {
    let dataset = plate();
    let tip = dataset.steps[0].cracks[0].points[1];
    let mut window = window(dataset, SIZE);
    show(&mut window, "syy", None);
    hover(&mut window, tip);
    assert_eq!(hovered(&window).tip, Some(1));
    assert_eq!(hovered(&window).sides[0].value, f64::INFINITY);
    assert!(has_label(&window, "syy = ∞ at tip 1"));
    show(&mut window, "uy", None);
    assert!(hovered(&window).sides[0].value.is_finite());
}

/// In a view 10⁻¹² of the plate wide, around an anchor that is a tip, the value is that of
/// `tip + offset`.
#[test]
fn deep_inside_no_digit_is_lost() {
    let dataset = plate();
    let tip = dataset.steps[0].cracks[0].points[1];
    let mut window = window(dataset.clone(), SIZE);
    show(&mut window, "syy", Some(VisibleRegion { center: tip.into(), width: 2e-12 }));
    let field = Field::new(&dataset, 0).expect("a field");
    let syy = Quantity::parse("syy", &field).expect("a quantity");
    let rect = window.get_by_label("Plate").rect();
    window.hover_at(rect.center() + vec2(200.0, -100.0));
    settle(&mut window);
    let read = hovered(&window);
    let offset = read.spot.from(tip);
    let pixel = 2e-12 / f64::from(rect.width());
    assert!((offset - v(200.0, 100.0) * pixel).length() < 1.5 * pixel, "{offset:?}");
    let expected = syy.at(&mut field.at(tip), offset, Side::Above);
    assert!((read.sides[0].value / expected - 1.0).abs() < 1e-12);
    assert!(expected > 1e4, "σ grows as 1/√r: {expected}");
    assert!(has_label(&window, "tip 1 + ("));
    // pinned, written as text and read back it is the same point
    window.key_press(Key::P);
    settle(&mut window);
    let spot = window.state().session.panes[0].probes[0];
    let texts = spot.texts();
    let again = Location::default().with_text(0, &texts[0]).and_then(|s| s.with_text(1, &texts[1]));
    assert_eq!(again.map(|s| s.from(tip)), Some(spot.from(tip)));
}

#[test]
fn clicks_pin_probes_while_the_tool_for_them_is_chosen() {
    let mut window = window(plate(), SIZE);
    show(&mut window, "uy", None);
    let place = at(&window, v(0.4, 0.5));
    let count = |window: &Window| window.state().session.panes[0].probes.len();
    click(&mut window, place);
    settle(&mut window);
    assert_eq!(count(&window), 0);
    window.get_by_label("Probe").click();
    settle(&mut window);
    for (k, place) in [place, at(&window, v(-0.4, 0.5))].into_iter().enumerate() {
        click(&mut window, place);
        settle(&mut window);
        assert_eq!((count(&window), window.state().viewports[0].tools.selected), (k + 1, Some(k)));
    }
    // a click on its mark selects it and pins no other, whatever the tool is
    for _ in 0..2 {
        click(&mut window, place + vec2(3.0, 0.0));
        settle(&mut window);
        assert_eq!((count(&window), window.state().viewports[0].tools.selected), (2, Some(0)));
        window.state_mut().viewports[0].tools.selected = None;
        window.key_press(Key::Escape);
        settle(&mut window);
    }
    // and after Escape nothing is pinned
    let free = at(&window, v(0.4, -0.5));
    click(&mut window, free);
    settle(&mut window);
    assert_eq!(count(&window), 2);
}

#[test]
fn probes_can_be_undone() {
    let mut window = window(plate(), SIZE);
    hover(&mut window, v(0.4, 0.5));
    window.key_press(Key::P);
    settle(&mut window);
    assert_eq!(window.state().session.panes[0].probes.len(), 1);
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(&mut window);
    assert_eq!(window.state().session.panes[0].probes.len(), 0);
}

/// Probes follow the quantity, and their place can be written.
#[test]
fn probes_follow_the_quantity() {
    let dataset = plate();
    // all probes are in sight
    let mut window = window(dataset.clone(), [SIZE[0], SIZE[1] + 120.0]);
    let field = Field::new(&dataset, 0).expect("a field");
    window.state_mut().session.panes[0].probes =
        vec![Location::new(v(0.25, 0.75), Vec2::ZERO), Location::new(v(0.0, 0.0), Vec2::ZERO)];
    for name in ["ux", "von-mises", "sqrt(ux^2 + uy^2)"] {
        show(&mut window, name, None);
        let probes = window.state().viewports[0].tools.probes.clone();
        let quantity = Quantity::parse(name, &field).expect("a quantity");
        let expected = quantity.at(&mut field.at(v(0.25, 0.75)), Vec2::ZERO, Side::Above);
        assert_eq!(probes[0].sides[0].value, expected, "{name}");
        assert_eq!(probes[1].sides.len(), 2, "the middle of the plate lies on the crack");
        let slope = QuantityGradient::new(&quantity, &field).expect("a gradient");
        let slope = slope.at(&mut field.at(v(0.25, 0.75)), Vec2::ZERO, Side::Above);
        assert_eq!(probes[0].sides[0].gradient, slope.gradient);
    }
    window.get_by_label("Probes").click();
    settle(&mut window);
    settle(&mut window);
    assert!(has_label(&window, "above"));
    window.get_by_label("Remove probe 2").click();
    settle(&mut window);
    assert_eq!(window.state().session.panes[0].probes.len(), 1);
    let field = window.get_by_label("x of probe 1");
    field.focus();
    field.type_text("1");
    window.key_press(Key::Enter);
    settle(&mut window);
    // typed behind what was there
    assert_eq!(window.state().session.panes[0].probes[0].anchor[0], 0.251);
}

#[test]
fn what_is_read_is_copied_with_all_digits() {
    let mut window = window(plate(), SIZE);
    show(&mut window, "uy", None);
    hover(&mut window, v(0.3, 0.3));
    let value = hovered(&window).sides[0].value;
    window.event(Event::Copy);
    window.step();
    let copied =
        window.output().platform_output.commands.iter().find_map(|command| match command {
            egui::OutputCommand::CopyText(text) => Some(text.clone()),
            _ => None,
        });
    let text = copied.expect("something is copied");
    assert!(text.contains(&format!("uy = {value:?}")), "{text}");
}

/// On the deformed plate the point that is read is the one whose value the picture shows there,
/// found by the renderer in quite another way; where the picture shows no plate, there is nothing
/// to read.
#[test]
fn the_deformed_plate_is_read_where_it_is_seen() {
    let mut window = window(plate(), SIZE);
    window.state_mut().session.panes[0].scene.deformed =
        Some(ppum_scene::magnification::Magnification::Auto);
    show(&mut window, "uy", None);
    let rect = window.get_by_label("Plate").rect();
    let (mut seen, mut missing) = (0, 0);
    for k in 0..150u32 {
        let frame = window.state().viewports[0].frames.newest().expect("a picture").clone();
        let [columns, rows] = frame.request.view.pixels;
        let pixel = |size: u32, n: u32| (f64::from(size) * number(n).abs()) as u32;
        // every third near the crack, whose faces have parted
        let near = rows / 2 - 12 + pixel(24, 2 * k + 1);
        let row = if k % 3 == 0 { near } else { pixel(rows, 2 * k + 1) };
        let column = pixel(columns, 2 * k);
        window.hover_at(rect.min + vec2(column as f32 + 0.5, row as f32 + 0.5));
        window.step();
        if window.state().viewports[0].hover.is_none() {
            continue; // the bar lies over the plate there
        }
        let ppum_scene::values::RasterValues::Double(raster) = &frame.drawn.values else {
            panic!("it is drawn in double precision")
        };
        let shown = raster.value(column, row);
        let read = window.state().viewports[0].tools.hover.clone();
        let read = read.filter(|read| !read.is_outside());
        match (shown.is_nan(), read) {
            (true, None) => missing += 1,
            (false, Some(read)) => {
                seen += 1;
                // beside a crack the pointer may be drawn to it, four pixels away
                let values = read.sides.iter().map(|sided| (sided.value - shown).abs());
                let least = values.fold(f64::INFINITY, f64::min);
                let reach = if read.crack.is_some() || read.tip.is_some() { 0.1 } else { 1e-5 };
                assert!(least < reach * (1.0 + shown.abs()), "{column} {row}: {shown} {read:?}");
            }
            (true, Some(read)) => {
                assert!(read.crack.is_some() || read.tip.is_some(), "{column} {row}: {read:?}");
            }
            (false, None) => panic!("{column} {row}: {shown}, and nothing is read"),
        }
    }
    assert!(seen > 60 && missing > 20, "{seen} {missing}");
}

/// Wherever the pointer goes, in holes, outside, at tips, on deformed plates: a reading or none,
/// never a panic.
#[test]
fn the_pointer_may_go_anywhere() {
    const ELASTIC: [&str; 7] = ["von-mises", "uy", "phi:3", "overlap", "1/x", "level", "sqrt(sxx)"];
    const POTENTIAL: [&str; 4] = ["u", "gradient", "phi:3", "level"];
    go_anywhere(plate(), &ELASTIC, v(0.5, 0.0));
    go_anywhere(
        solved(include_str!("../../../../examples/cracked-hole.toml")),
        &ELASTIC,
        v(0.4, 0.0),
    );
    go_anywhere(
        solved(include_str!("../../../../examples/kinked-crack.toml")),
        &ELASTIC,
        v(0.1, 0.1),
    );
    go_anywhere(
        solved(include_str!("../../../../examples/poisson-slit.toml")),
        &POTENTIAL,
        v(0.0, 0.0),
    );
}

/// An example, solved coarsely.
fn solved(text: &str) -> Dataset {
    let is_fine = |line: &str| line.starts_with("level = ") || line.starts_with("cells = ");
    let text: Vec<_> =
        text.lines().map(|line| if is_fine(line) { "level = 3" } else { line }).collect();
    let problem = Problem::parse(&text.join("\n"), "plate", Path::new(".")).expect("a problem");
    solve(&problem, unwatched()).expect("it can be solved")
}

/// A number from −1 to 1 for each k, without a pattern.
fn number(k: u32) -> f64 {
    (f64::from(k) * 12.9898).sin() * 43758.5453 % 1.0
}

fn go_anywhere(dataset: Dataset, quantities: &[&str], center: Vec2) {
    let whole = 4.0 * dataset.domain.bounds.size().x;
    let is_elastic = dataset.equation.elastic().is_some();
    let mut window = window(dataset, [700.0, 500.0]);
    let rect = window.get_by_label("Plate").rect();
    let (mut inside, mut outside) = (0, 0);
    for k in 0..60u32 {
        if k % 6 == 0 {
            let pane = &mut window.state_mut().session.panes[0];
            pane.scene.quantity = Some(quantities[(k / 6) as usize % quantities.len()].into());
            let is_deformed = is_elastic && k % 12 == 0;
            pane.scene.deformed =
                is_deformed.then_some(ppum_scene::magnification::Magnification::Auto);
            let deep = 10f64.powf(-12.0 * number(k + 1000).abs());
            let width = if k >= 24 { deep } else { whole };
            pane.place = Some(VisibleRegion { center: center.into(), width });
            settle(&mut window);
        }
        let within = |size: f32, n: u32| (0.5 + 0.55 * number(n) as f32) * size;
        let to = rect.min + vec2(within(rect.width(), 2 * k), within(rect.height(), 2 * k + 1));
        window.hover_at(to);
        window.step();
        let Some(read) = &window.state().viewports[0].tools.hover else { continue };
        if read.is_outside() {
            outside += 1;
            continue;
        }
        inside += 1;
        let sum: f64 = read.patches.iter().map(|(_, phi)| phi).sum();
        assert!((sum - 1.0).abs() < 1e-12, "{sum} {read:?}");
        assert!((1..=2).contains(&read.sides.len()));
    }
    assert!(inside > 5 && outside > 2, "{inside} {outside}");
}

fn click(window: &mut Window, place: Pos2) {
    window.hover_at(place);
    window.step();
    for pressed in [true, false] {
        window.event(button(place, pressed));
        window.step();
    }
}

fn button(pos: Pos2, pressed: bool) -> Event {
    let modifiers = Modifiers::NONE;
    Event::PointerButton { pos, button: egui::PointerButton::Primary, pressed, modifiers }
}

/// A crack from the left edge to a hole, with a plain vertex in between.
const ENDED: &str = r#"
title = "A crack that has met a hole"
[domain]
min = [-1, -1]
max = [1, 1]
[material]
young = 1.0
poisson = 0.3
state = "plane-strain"
[[hole]]
center = [0, 0]
radius = 0.3
[[crack]]
points = [[-1, 0], [-0.62, 0.01], [-0.3, 0]]
[[boundary]]
on = "bottom"
traction = [0, -1]
[[boundary]]
on = "top"
traction = [0, 1]
[discretization]
level = 3
order = 2
"#;

/// A stress is infinite at a tip, also between rims of many pieces, and finite where a crack has
/// vertices but no tip: the same in a window of any size, deformed or not.
#[test]
fn stresses_are_infinite_at_tips_and_nowhere_else() {
    let compact = include_str!("../../../../examples/compact-tension.toml");
    let compact = compact.replace("cells = [17, 17]\norder = 3", "cells = [9, 9]\norder = 2");
    for (text, tip) in [(compact.as_str(), Some(v(0.5, 0.0))), (ENDED, None)] {
        let problem = Problem::parse(text, "problem", Path::new(".")).expect("a problem");
        let dataset = solve(&problem, unwatched()).expect("it can be solved");
        let mut largest = Vec::new();
        for (size, deformed) in
            [([1000.0, 700.0], false), ([640.0, 400.0], false), ([640.0, 400.0], true)]
        {
            let mut window = window(dataset.clone(), size);
            let auto = deformed.then_some(Magnification::Auto);
            window.state_mut().session.panes[0].scene.deformed = auto;
            show(&mut window, "von-mises", None);
            let frame = window.state().viewports[0].frames.newest().expect("an image").clone();
            let found = frame.colored.span.values.clone().expect("the extrema");
            assert_eq!(found.max.value.is_infinite(), tip.is_some(), "{size:?}: {found}");
            if let Some(tip) = tip {
                assert_eq!(found.center + found.max.offset, tip);
            }
            largest.push((found.max, found.min));
        }
        assert!(largest.iter().all(|all| *all == largest[0]), "{largest:?}");
    }
}
