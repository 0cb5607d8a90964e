//! Problems that begin with a drawing, or with nothing.

use std::fs;
use std::path::Path;

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use ppum_viewer::actions::Action;
use ppum_viewer::session::ProblemDraft;
use ppum_viewer::solving::SolutionOutcome;

use crate::lab::{Lab, shot};

const DRAWING: &str = include_str!("../../../../examples/dog-bone.dxf");

/// What is missing in the problem of a drawing.
const LOADED: &str = r#"
[material]
young = 1.0
poisson = 0.3
state = "plane-stress"
[[boundary]]
on = { piece = "left" }
displacement = [0, 0]
[[boundary]]
on = { piece = "right" }
traction = [1, 0]
"#;

fn act(lab: &mut Lab, action: Action) {
    let ctx = lab.window.ctx.clone();
    lab.state().act(&ctx, action);
    lab.window.run_steps(3);
    lab.settle();
}

fn draft(lab: &mut Lab) -> &mut ProblemDraft {
    lab.state().session.draft.as_mut().expect("a text is open")
}

/// Opens a drawing, and imports it.
fn import(lab: &mut Lab, path: &Path) {
    lab.open(path);
    lab.window.run_steps(2);
    shot(lab, "drawing-dialog");
    lab.window.get_by_label("Import").click();
    lab.window.run_steps(3);
    lab.settle();
}

/// Moves the pointer to a point of the body in the preview.
fn point_at(lab: &mut Lab, label: &str, [x, y]: [f64; 2]) {
    let rect = lab.window.get_by_label(label).rect();
    let at = rect.min + egui::vec2(x as f32 * rect.width(), y as f32 * rect.height());
    lab.window.hover_at(at);
    lab.window.run_steps(2);
}

const TEMPLATE: &str = "The problem as it is written: cracks 1, holes 0";

/// A drawing becomes a text without a file, with a preview of its body. It is solved with material
/// and loads, and saved beside the drawing, which stays as it is.
#[test]
fn a_drawing_becomes_a_problem() {
    let mut lab = Lab::new();
    let path = lab.path("dog-bone.dxf");
    fs::write(&path, DRAWING).expect("written");
    import(&mut lab, &path);
    shot(&mut lab, "drawing-imported");
    let text = draft(&mut lab).clone();
    assert!(text.text.starts_with("# Imported from dog-bone.dxf."), "{}", text.text);
    assert!(text.path.is_none() && text.is_changed());
    lab.window.get_by_label("The problem as it is written: cracks 1, holes 0");
    draft(&mut lab).text = text.text.replace("level = 5", "level = 4") + LOADED;
    lab.settle();
    act(&mut lab, Action::Solve);
    let outcome = lab.viewer().solving.outcome.clone();
    assert!(matches!(outcome, Some(SolutionOutcome::Solved(..))), "{outcome:?}");
    shot(&mut lab, "drawing-solved");
    act(&mut lab, Action::SaveProblem);
    lab.window.run_steps(2);
    lab.window.key_press(Key::Enter);
    lab.window.step();
    lab.settle();
    let written = fs::read_to_string(lab.path("dog-bone.toml")).expect("it is written");
    assert_eq!(written, draft(&mut lab).text);
    assert_eq!(fs::read_to_string(&path).expect("there"), DRAWING);
}

/// The text of a drawing outlasts the window, and makes place for another one.
#[test]
fn no_drawing_is_lost() {
    let mut lab = Lab::new();
    let path = lab.path("dog-bone.dxf");
    fs::write(&path, DRAWING).expect("written");
    import(&mut lab, &path);
    let text = draft(&mut lab).text.clone();
    act(&mut lab, Action::NewProblem);
    assert!(lab.viewer().files.texts().iter().any(|aside| aside.text == text));
}

/// The layers that are taken and the tolerance decide what the drawing gives; closing the dialog
/// begins nothing.
#[test]
fn layers_and_tolerance_are_chosen() {
    let mut lab = Lab::new();
    let path = lab.path("dog-bone.dxf");
    fs::write(&path, DRAWING).expect("written");
    lab.open(&path);
    lab.window.run_steps(2);
    lab.window.get_by_label("An outline, 0 holes, 1 crack");
    lab.window.get_by_label("crack").click();
    lab.window.run_steps(2);
    lab.settle();
    lab.window.get_by_label("An outline, 0 holes, 0 cracks");
    lab.window.get_by_label("left").click();
    lab.window.run_steps(2);
    lab.settle();
    assert!(lab.window.query_all_by_label_contains("no curve closes").next().is_some());
    lab.window.get_by_label("left").click();
    lab.window.get_by_label("Import").click();
    lab.window.run_steps(2);
    // nothing is imported of what is not known yet, and without the crack if it is known already
    if let Some(draft) = &lab.viewer().session.draft {
        let text = &draft.text;
        assert!(text.contains("[domain.outline]") && !text.contains("[[crack]]"), "{text}");
        return;
    }
    lab.settle();
    lab.window.key_press(Key::Escape);
    lab.window.run_steps(2);
    assert!(lab.viewer().importing.is_none() && lab.viewer().session.draft.is_none());
}

/// A click on a part of the boundary goes to its condition, or writes one where it is free.
#[test]
fn a_click_on_the_boundary_goes_to_its_condition() {
    let mut lab = Lab::new();
    act(&mut lab, Action::NewProblem);
    let before = draft(&mut lab).text.clone();
    let place = |lab: &Lab| {
        let id = egui::Id::unique("text of the problem");
        let state = egui::text_edit::TextEditState::load(&lab.window.ctx, id).expect("an editor");
        let end = state.cursor.char_range().expect("a cursor").primary.index.0;
        let text = &lab.viewer().session.draft.as_ref().expect("a text").text;
        text.chars().take(end).filter(|c| *c == '\n').count()
    };
    point_at(&mut lab, TEMPLATE, [0.5, 0.16]);
    shot(&mut lab, "drawing-boundary");
    let top = before.lines().position(|line| line == "on = \"top\"").expect("it is there");
    click(&mut lab);
    assert_eq!(draft(&mut lab).text, before);
    assert_eq!(place(&lab) + 1, top, "the line before `on`");
    // half of the height is the width of this body
    let rect = lab.window.get_by_label(TEMPLATE).rect();
    let half = f64::from(0.25 * 0.68 * rect.height() / rect.width());
    point_at(&mut lab, TEMPLATE, [0.5 - half, 0.5]);
    click(&mut lab);
    let after = draft(&mut lab).text.clone();
    assert!(after.ends_with("\n[[boundary]]\non = \"left\"\ntraction = [0, 0]\n"), "{after}");
    assert_eq!(lab.viewer().solving.checked().expect("checked").marks, []);
}

fn click(lab: &mut Lab) {
    let at = lab.window.ctx.input(|input| input.pointer.latest_pos()).expect("a pointer");
    for pressed in [true, false] {
        let (button, modifiers) = (egui::PointerButton::Primary, Modifiers::NONE);
        lab.window.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
        lab.window.step();
    }
    lab.window.run_steps(3);
    lab.settle();
}

#[test]
fn a_drawing_that_cannot_be_read_is_told() {
    let mut lab = Lab::new();
    let path = lab.path("empty.svg");
    fs::write(&path, "<svg xmlns=\"http://www.w3.org/2000/svg\"/>").expect("written");
    lab.open(&path);
    assert!(lab.notes().contains("empty.svg cannot be read: "), "{}", lab.notes());
    assert!(lab.viewer().session.draft.is_none());
}

/// A new problem is one click away, can be solved as it is, and is no work that is lost.
#[test]
fn a_new_problem_begins_with_a_text_that_can_be_solved() {
    let mut lab = Lab::new();
    shot(&mut lab, "drawing-start");
    lab.window.get_by_label("Import a drawing…");
    lab.window.get_by_label("New problem").click();
    lab.window.run_steps(3);
    lab.settle();
    shot(&mut lab, "drawing-new");
    assert_eq!(draft(&mut lab).text, ppum_problem::TEMPLATE);
    assert!(!draft(&mut lab).is_changed());
    lab.window.get_by_label("The problem as it is written: cracks 1, holes 0");
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
    lab.window.step();
    lab.settle();
    assert_eq!(lab.dataset(0).expect("it is solved").title, "Slanted crack");
}
