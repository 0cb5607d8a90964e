//! Fields on meshes, and on covers without cells.

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use ppum::cover::Cover;
use ppum::crack::Side;
use ppum::dataset::{Dataset, Equation, FieldData, Step};
use ppum::field::Field;
use ppum::function::FunctionKind;
use ppum::mesh::Shape;
use ppum::polynomial::PolynomialSpace::Total;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;
use ppum_scene::owner::Owner;
use ppum_testkit::meshes::{BivariatePolynomial, MeshBuilder, field, random_polynomial};
use ppum_testkit::random::Random;
use ppum_viewer::Viewer;
use ppum_viewer::measure::tool::Tool;

use crate::kit::{at, hover, settle, window};

type Window = Harness<'static, Viewer>;

const SIZE: [f32; 2] = [1000.0, 700.0];

fn mesh() -> Dataset {
    let mut random = Random(3);
    let plane =
        [BivariatePolynomial::linear(0.0, 1.0, 0.1), BivariatePolynomial::linear(0.0, -0.1, 1.0)];
    let mut elements = MeshBuilder::grid([5, 4], 1, &plane);
    let n = elements.mesh.len() as u32;
    elements.mesh.element = (0..n).map(|k| 100 + k).collect();
    let mut part = |k: u32| {
        let degree = (k % 4) as u8;
        (Total, degree, random_polynomial(&mut random, Total, degree.into()))
    };
    let parts: Vec<_> = (0..n).map(&mut part).collect();
    elements.dataset(vec![field("v", &parts)])
}

/// Boxes with no cells.
fn boxes() -> Dataset {
    let unit = Rect::new(Vec2::ZERO, vec2(1.0, 1.0));
    let cover = Cover::grid(unit, [4, 4]).expect("a grid");
    let mut boxes = cover.partition(1.5, WeightFunction::Quadratic).expect("a cover");
    (boxes.cell, boxes.level) = (Vec::new(), Vec::new());
    let mut field = FieldData::new("v", &["v"]);
    (0..boxes.len()).for_each(|_| field.push_patch(&[(0, 1)]));
    field.coefficients[0].iter_mut().enumerate().for_each(|(k, c)| *c = k as f64);
    let step = Step::new(boxes).with_function("one", FunctionKind::One).with_field(field);
    Dataset::new(unit, Equation::None).with_step(step)
}

/// What is read at a point of the plate.
fn owner(window: &mut Window, point: Vec2) -> Option<Owner> {
    hover(window, point);
    window.state().viewports[0].tools.hover.as_ref().expect("over the plate").owner
}

fn click(window: &mut Window, point: Vec2) {
    let place = at(window, point);
    window.hover_at(place);
    window.step();
    window.drag_at(place);
    window.step();
    window.drop_at(place);
    settle(window);
}

#[test]
fn a_probe_of_an_element_shows_its_data() {
    let dataset = mesh();
    let mut window = window(dataset.clone(), SIZE);
    window.state_mut().viewports[0].tools.tool = Some(Tool::Probe);
    let field = Field::new(&dataset, 0).expect("a field");
    let mesh = dataset.steps[0].partition.mesh().expect("a mesh");
    let mut random = Random(9);
    for _ in 0..6 {
        let point = vec2(random.between(0.2, 0.9), random.between(0.1, 0.8));
        let Some(Owner::Element(element)) = owner(&mut window, point) else { panic!("{point:?}") };
        let spot = window.state().viewports[0].tools.hover.as_ref().expect("read").spot.point();
        let expected = field.at(spot).owner(Vec2::ZERO, Side::Above).expect("inside");
        assert_eq!(element.patch as usize, expected);
        assert_eq!(element.number, mesh.element[expected]);
        assert_eq!(u32::from(element.order), expected as u32 % 4);
        let shape = if element.shape == Shape::Square { "square" } else { "triangle" };
        click(&mut window, point);
        assert!(!window.state().session.pane().probes.is_empty(), "a probe is pinned");
        hover(&mut window, point);
        let text = format!("element {}, {shape}, order {}", element.number, element.order);
        assert!(window.query_all_by_label_contains(&text).next().is_some(), "{text}");
    }
}

#[test]
fn elements_and_boxes_are_picked_as_parts() {
    for (dataset, point) in [(mesh(), vec2(0.61, 0.33)), (boxes(), vec2(0.36, 0.6))] {
        let mut window = window(dataset, SIZE);
        let expected = owner(&mut window, point).expect("inside").patch();
        window.state_mut().viewports[0].controls.is_picking = true;
        click(&mut window, point);
        let part = window.state().session.pane().scene.subject.part.clone();
        assert_eq!(part, Some(format!("patch:{expected}")));
    }
}

#[test]
fn covers_without_cells_are_read() {
    let mut window = window(boxes(), SIZE);
    let Some(Owner::Box { patch }) = owner(&mut window, vec2(0.13, 0.12)) else {
        panic!("outside")
    };
    assert_eq!(patch, 0, "the one with the largest φ");
    assert!(window.query_all_by_label_contains("patch 0").next().is_some());
}
