//! Problems that begin with a drawing, or with nothing.

use std::fs;

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

/// A drawing becomes a text without a file, with a preview of its body. It is solved with material
/// and loads, and saved beside the drawing, which stays as it is.
#[test]
fn a_drawing_becomes_a_problem() {
    let mut lab = Lab::new();
    let path = lab.path("dog-bone.dxf");
    fs::write(&path, DRAWING).expect("written");
    lab.open(&path);
    lab.settle();
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
    lab.open(&path);
    let text = draft(&mut lab).text.clone();
    act(&mut lab, Action::NewProblem);
    assert!(lab.viewer().files.texts().iter().any(|aside| aside.text == text));
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
