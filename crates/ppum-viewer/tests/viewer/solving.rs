//! Problems: mistakes at their places, solved in the background, stopped, refused, saved only when
//! it is asked for.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ppum::crack::End;
use ppum::progress::unwatched;
use ppum_fracture::solve::solve;
use ppum_problem::Problem;
use ppum_viewer::Viewer;
use ppum_viewer::actions::{Action, all};
use ppum_viewer::session::VisibleRegion;
use ppum_viewer::solving::SolutionOutcome;
use ppum_viewer::window::WindowStart;

use crate::kit::{plate, show_until};
use crate::lab::{Lab, shot};

const TEXT: &str = include_str!("../../../../examples/centre-crack.toml");

/// The centre crack with cells of some level, at order 1.
fn text(level: u32) -> String {
    TEXT.replace("level = 6\norder = 2", &format!("level = {level}\norder = 1"))
}

/// A window with a problem file that is open.
fn lab(text: &str) -> Lab {
    let mut lab = Lab::new();
    let path = lab.path("plate.toml");
    fs::write(&path, text).expect("written");
    lab.open(&path);
    lab
}

fn draft(lab: &mut Lab) -> &mut String {
    &mut lab.state().session.draft.as_mut().expect("a problem is open").text
}

#[test]
fn mistakes_stand_at_their_places_while_one_writes() {
    let mut lab = lab(&text(3));
    lab.window.get_by_label("Text of the problem");
    let checked = lab.state().solving.checked().expect("it was looked at").clone();
    assert_eq!(checked.marks, []);
    *draft(&mut lab) = text(3).replace("young = 1.0", "yong = 1.0");
    lab.settle();
    let checked = lab.state().solving.checked().expect("it was looked at").clone();
    let line = TEXT.lines().position(|line| line.starts_with("young")).expect("it is there") + 1;
    let places: Vec<_> = checked.marks.iter().filter_map(|mark| mark.at).collect();
    assert!(places.contains(&[line, 1]), "{:?}", checked.marks);
    let mark = checked.marks.iter().find(|mark| mark.at == Some([line, 1])).expect("it is there");
    assert!(mark.message.contains("young"), "the remedy: {}", mark.message);
    shot(&mut lab, "solving-mistake");
    // it stands below, and a click goes there
    let label = format!("{line}:1  {}", mark.message);
    lab.window.get_by_label(&label).click();
    lab.window.run_steps(4);
    // what is written now stands at the cursor: the letter that is missing
    lab.window.key_press(Key::ArrowRight);
    lab.window.key_press(Key::ArrowRight);
    lab.window.step();
    lab.window.event(egui::Event::Text("u".into()));
    lab.window.step();
    lab.settle();
    assert_eq!(*draft(&mut lab), text(3));
    assert_eq!(lab.state().solving.checked().expect("looked at").marks, []);
    // the file is as it was
    assert_eq!(fs::read_to_string(lab.path("plate.toml")).expect("there"), text(3));
}

/// The result is that of the solver, bit by bit, and the view stays.
#[test]
fn a_problem_is_solved_where_one_looks() {
    let mut lab = lab(&text(2));
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
    lab.window.step();
    lab.settle();
    let solved = |text: &str, lab: &Lab| {
        let problem = Problem::parse(text, "problem", lab.folder.path()).expect("a problem");
        solve(&problem, unwatched()).expect("it can be solved")
    };
    let coefficients =
        |dataset: &ppum::dataset::Dataset| dataset.steps[0].fields[0].coefficients.clone();
    let first = lab.dataset(0).expect("it is solved");
    assert_eq!(coefficients(&first), coefficients(&solved(&text(2), &lab)));
    assert!(matches!(lab.state().solving.outcome, Some(SolutionOutcome::Solved(..))));
    // change a number, solve again
    let place = Some(VisibleRegion { center: [0.5, 0.0], width: 1e-6 });
    lab.state().session.panes[0].place = place;
    let changed = text(2).replace("traction = [0.0, 1.0]", "traction = [0.0, 3.0]");
    draft(&mut lab).clone_from(&changed);
    lab.window.get_by_label("Solve").click();
    lab.window.step();
    lab.settle();
    let second = lab.dataset(0).expect("it is solved");
    assert_eq!(coefficients(&second), coefficients(&solved(&changed, &lab)));
    assert_eq!(lab.state().session.panes[0].place, place);
    // three times the load: three times the field, to rounding of the solution
    let [a, b] = [&first, &second].map(|d| d.steps[0].intensities[0].k1);
    assert!((b / a - 3.0).abs() < 1e-9, "{a} {b}");
    // another plate is seen as a whole
    *draft(&mut lab) = text(2).replace("max = [1.0, 1.0]", "max = [1.0, 1.5]");
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
    lab.window.step();
    lab.settle();
    let viewer = lab.viewer();
    assert_eq!(viewer.session.panes[0].place, None, "{:?}", viewer.solving.outcome);
}

#[test]
fn a_solution_is_stopped_and_what_was_there_stays() {
    let mut lab = lab(&text(2));
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
    lab.window.step();
    lab.settle();
    let before = lab.dataset(0).expect("it is solved");
    // minutes of work
    *draft(&mut lab) = text(8).replace("order = 2", "order = 4");
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
    lab.until("its cost is told", |viewer| {
        viewer.solving.running().is_some_and(|running| running.progress_report().estimate.is_some())
    });
    shot(&mut lab, "solving-running");
    lab.window.get_by_label("Cancel").click();
    lab.window.step();
    lab.settle();
    // tests of ppum-fracture count how little of the work is still done
    assert_eq!(lab.state().solving.outcome, Some(SolutionOutcome::Cancelled(0)));
    lab.window.get_by_label("Cancelled. What was there before is still shown.");
    assert!(Arc::ptr_eq(&before, &lab.dataset(0).expect("it stays")));
}

/// A plate whose crack grows.
fn growing(increment: f64, steps: u32) -> String {
    let growth = format!("\n[growth]\nincrement = {increment}\nsteps = {steps}\n");
    text(2) + &growth
}

/// A series is shown with its first step, and all others are there.
#[test]
fn a_series_is_solved() {
    let mut lab = lab(&growing(0.05, 2));
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
    lab.window.step();
    lab.settle();
    let dataset = lab.dataset(0).expect("it is solved");
    let tips: Vec<f64> =
        dataset.steps.iter().map(|step| step.cracks[0].end_point(End::Last).x).collect();
    assert_eq!(tips.len(), 3);
    assert!(tips.windows(2).all(|t| (t[1] - t[0] - 0.05).abs() < 1e-3), "{tips:?}");
    assert!(matches!(lab.state().solving.outcome, Some(SolutionOutcome::Solved(..))));
}

/// What is complete of a series stays when it is stopped.
#[test]
fn a_series_is_stopped() {
    // minutes of work
    let mut lab = lab(&growing(1e-5, 8000));
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
    let mut part = 0.0;
    lab.until("its third step is solved", |viewer| {
        let Some(running) = viewer.solving.running() else { return false };
        let told = running.progress_report();
        // that of the whole: it never goes back, and a step is an 8001st of it
        assert!(told.part >= part, "{} after {part}", told.part);
        part = told.part;
        told.progress.is_some_and(|progress| progress.step >= 3)
    });
    assert!((3.0 / 8001.0..0.01).contains(&part), "{part}");
    assert!(lab.window.query_all_by_label_contains(" of 8000, ").next().is_some());
    lab.window.get_by_label("Cancel").click();
    lab.window.step();
    lab.settle();
    let steps = lab.dataset(0).expect("some of it is solved").steps.len();
    assert_eq!(lab.state().solving.outcome, Some(SolutionOutcome::Cancelled(steps)));
    assert!(steps >= 3, "{steps}");
    lab.window.get_by_label(&format!("Cancelled; the {steps} steps before are shown, not saved."));
}

#[test]
fn what_cannot_be_solved_is_refused_with_the_reason() {
    let mut lab = lab(&text(9));
    lab.state().solving.memory = || Some(1 << 20);
    let solve = |lab: &mut Lab| {
        lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
        lab.window.step();
        lab.settle();
        match &lab.state().solving.outcome {
            Some(SolutionOutcome::Failed(error)) => error.clone(),
            other => panic!("{other:?}"),
        }
    };
    let error = solve(&mut lab);
    assert!(error.contains("does not hold") && error.contains("use fewer cells"), "{error}");
    lab.window.get_by_label(&error);
    *draft(&mut lab) = "title = \"none\"\n[domain]\n".into();
    lab.settle();
    assert!(lab.window.query_by_label(&error).is_none(), "it was about another text");
    assert!(lab.window.get_by_label("Solve").accesskit_node().is_disabled());
    let error = solve(&mut lab);
    assert!(error.starts_with("not solved: "), "{error}");
    // the errors are listed, and said once
    assert!(lab.window.query_by_label(&error).is_none());
    assert!(lab.dataset(0).is_none());
}

/// The text goes into its file when that is asked for, and not before; one that changes on disk is
/// taken, unless both have.
#[test]
fn the_file_is_written_when_it_is_saved() {
    let mut lab = lab(&text(3));
    let path = lab.path("plate.toml");
    *draft(&mut lab) = text(2);
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
    lab.window.step();
    lab.settle();
    assert_eq!(fs::read_to_string(&path).expect("there"), text(3));
    lab.window.get_by_label("Save").click();
    lab.window.step();
    lab.settle();
    assert_eq!(fs::read_to_string(&path).expect("there"), text(2), "{}", lab.notes());
    // somebody else writes it
    fs::write(&path, text(4)).expect("written");
    let level = |viewer: &ppum_viewer::Viewer, text: &str| {
        viewer.session.draft.as_ref().is_some_and(|draft| draft.text == text)
    };
    lab.until("it is read again", |viewer| level(viewer, &text(4)));
    // and now both
    *draft(&mut lab) = text(5);
    fs::write(&path, text(6)).expect("written");
    lab.until("it is told", |viewer| {
        viewer.files.notes.iter().any(|n| n.text.contains("so has the text here"))
    });
    assert_eq!(*draft(&mut lab), text(5));
}

/// A dataset brings its problem, with the points that came from a file which is not there.
#[test]
fn the_problem_of_a_dataset_is_solved_again() {
    let mut lab = Lab::new();
    let points = "-0.5,-0.4\n0.6,-0.5\n0.1,0.2\n-0.6,0.7\n0.5,0.6\n";
    fs::write(lab.path("points.csv"), points).expect("written");
    let text = text(2).replace("level = 2", "points = \"points.csv\"");
    let problem = Problem::parse(&text, "problem", lab.folder.path()).expect("a problem");
    let dataset = solve(&problem, unwatched()).expect("it can be solved");
    fs::remove_file(lab.path("points.csv")).expect("removed");
    let expected = dataset.steps[0].fields[0].coefficients.clone();
    lab.state().open(None, Arc::new(dataset));
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
    lab.window.step();
    lab.settle();
    assert!(
        matches!(lab.state().solving.outcome, Some(SolutionOutcome::Solved(..))),
        "{:?}",
        lab.state().solving.outcome
    );
    assert_eq!(lab.dataset(0).expect("solved").steps[0].fields[0].coefficients, expected);
}

/// A text that was changed and makes place for another one can be had back.
#[test]
fn no_text_is_lost() {
    let mut lab = lab(&text(3));
    let mine = text(3).replace("young = 1.0", "young = 7.0");
    draft(&mut lab).clone_from(&mine);
    let other = lab.path("other.toml");
    fs::write(&other, text(2)).expect("written");
    lab.open(&other);
    assert_eq!(*draft(&mut lab), text(2));
    lab.window.get_by_label("Back to plate.toml *").click();
    lab.window.run_steps(2);
    assert_eq!(*draft(&mut lab), mine);
    // nor by the end of the day
    lab.reopen(WindowStart::default());
    assert_eq!(*draft(&mut lab), mine);
}

#[test]
fn an_example_is_a_click_away() {
    let mut lab = Lab::new();
    shot(&mut lab, "solving-start");
    lab.window.get_by_label("Smooth manufactured field").click_accesskit();
    lab.window.step();
    lab.settle();
    assert_eq!(lab.dataset(0).expect("it is solved").title, "Smooth manufactured field");
    shot(&mut lab, "solving-example");
    lab.window.get_by_label("Plate");
    lab.window.get_by_label("Text of the problem");
}

/// In the smallest window that is promised everything that is needed is inside.
#[test]
fn a_problem_has_room_in_a_small_window() {
    let mut lab = lab(&text(2).replace("young", "yong"));
    lab.state().session.theme = ppum_viewer::session::WindowTheme::Light;
    lab.window.ctx.set_theme(egui::Theme::Light);
    lab.window.set_size(egui::vec2(700.0, 500.0));
    lab.settle();
    lab.settle();
    shot(&mut lab, "solving-small-problem");
    for name in ["Solve", "Save", "Save as…", "Text of the problem", "Problem", "File"] {
        let rect = lab.window.get_by_label(name).rect();
        assert!(
            rect.left() >= 0.0 && rect.right() <= 700.0 && rect.top() < 490.0,
            "{name}: {rect:?}"
        );
    }
}

/// Loads whose solution no number holds: the words are those of `ppum solve`, and what was solved
/// before can be saved.
#[test]
fn a_solution_that_is_not_finite_is_none() {
    let mut lab = lab(&text(2));
    let solve = |lab: &mut Lab| {
        lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
        lab.window.step();
        lab.settle();
    };
    solve(&mut lab);
    let before = lab.dataset(0).expect("it is solved");
    *draft(&mut lab) = text(2).replace("traction = [0.0, 1.0]", "traction = [0.0, 1e308]");
    solve(&mut lab);
    match &lab.viewer().solving.outcome {
        Some(SolutionOutcome::Failed(error)) => {
            assert!(error.contains("too large for a number"), "{error}")
        }
        other => panic!("{other:?}"),
    }
    assert!(Arc::ptr_eq(&before, &lab.dataset(0).expect("it stays")));
    lab.window.get_by_label_contains(", not saved.");
    lab.window.get_by_label("Save the dataset…").click();
    lab.window.run_steps(3);
    // under the name of its problem
    lab.window.key_press(Key::Enter);
    lab.window.step();
    lab.settle();
    let saved = ppum_format::read(&lab.path("plate.h5")).expect("a dataset");
    assert_eq!(saved, *before, "{}", lab.notes());
    assert!(lab.window.query_by_label_contains("not saved.").is_none());
    assert!(lab.window.query_by_label("Save the dataset…").is_none());
}

const UNSAVED: &str = "The solution “Centre crack in a square plate” is not saved.";

/// Asks the window to close, as its cross does; true if it does.
fn closes(lab: &mut Lab) -> bool {
    let viewports = &mut lab.window.input_mut().viewports;
    let viewport = viewports.entry(egui::ViewportId::ROOT).or_default();
    viewport.events.push(egui::ViewportEvent::Close);
    lab.window.step();
    !commands(&lab.window).contains(&egui::ViewportCommand::CancelClose)
}

fn commands(window: &Harness<'static, Viewer>) -> Vec<egui::ViewportCommand> {
    window.output().viewport_output[&egui::ViewportId::ROOT].commands.clone()
}

fn click(lab: &mut Lab, label: &str) {
    lab.window.run_steps(2);
    lab.window.get_by_label(label).click();
    lab.window.run_steps(1);
}

#[test]
fn no_solution_is_lost_without_a_word() {
    let mut lab = lab(&text(2));
    assert!(closes(&mut lab), "nothing is lost");
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
    lab.window.step();
    lab.settle();
    let solved = lab.dataset(0).expect("it is solved");
    // the cross
    assert!(!closes(&mut lab));
    lab.window.run_steps(2);
    shot(&mut lab, "solving-unsaved");
    lab.window.get_by_label(UNSAVED);
    click(&mut lab, "Back");
    lab.window.run_steps(2);
    assert!(lab.window.query_by_label(UNSAVED).is_none());
    // the dataset alone, not closed and then saved
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::W);
    lab.window.run_steps(2);
    lab.window.get_by_label(UNSAVED);
    lab.window.key_press(Key::Escape);
    lab.window.run_steps(2);
    assert!(lab.window.query_by_label(UNSAVED).is_none());
    assert!(Arc::ptr_eq(&solved, &lab.dataset(0).expect("it stays")));
    // given up in the middle of saving
    assert!(!closes(&mut lab));
    click(&mut lab, "Save…");
    lab.window.run_steps(2);
    lab.window.key_press(Key::Escape);
    lab.window.run_steps(3);
    assert!(lab.window.query_by_label(UNSAVED).is_none() && lab.dataset(0).is_some());
    // saved, then closed
    assert!(!closes(&mut lab));
    click(&mut lab, "Save…");
    lab.window.run_steps(3);
    lab.window.key_press(Key::Enter);
    show_until(&mut lab.window, "the window closes", |window| {
        commands(window).contains(&egui::ViewportCommand::Close)
    });
    assert!(closes(&mut lab), "{}", lab.notes());
    assert_eq!(ppum_format::read(&lab.path("plate.h5")).expect("a dataset"), *solved);
}

/// Whatever is done by a key, a menu or the palette: a solution that no file has, and one that is
/// computed, go by no action alone.
#[test]
fn no_action_loses_a_solution_unasked() {
    let mut lab = lab(&text(2));
    let (ctx, other) = (lab.window.ctx.clone(), lab.write("other.h5", &plate()));
    lab.open(&other);
    lab.window.key_press(Key::V);
    lab.settle();
    lab.state().session.active = 1;
    lab.state().act(&ctx, Action::Solve);
    lab.settle();
    let solved = lab.dataset(1).expect("it is solved on the right");
    *draft(&mut lab) = growing(1e-5, 8000);
    lab.state().act(&ctx, Action::Solve);
    lab.window.run_steps(2);
    let all = all().map(|entry| entry.action).chain([Action::Example(0)]);
    let all = all.filter(|action| *action != Action::CancelSolving);
    // there and back: some show what others hide
    for action in all.clone().chain(all.clone()) {
        lab.state().session.active = 1;
        lab.state().act(&ctx, action);
        lab.window.run_steps(1);
        let running = lab.viewer().solving.running();
        assert!(running.is_some_and(|running| !running.is_cancelled()), "{action:?}: stopped");
        let is_there = |pane: usize| lab.dataset(pane).is_some_and(|d| Arc::ptr_eq(&d, &solved));
        assert!((0..lab.viewer().viewports.len()).any(is_there), "{action:?}: lost");
        for _ in 0..4 {
            lab.window.key_press(Key::Escape);
            lab.window.step();
        }
    }
    lab.state().act(&ctx, Action::CancelSolving);
    lab.settle();
}

/// What shows nothing is not saved, and that is told.
#[test]
fn saving_nothing_is_an_error() {
    let mut lab = Lab::new();
    let ctx = lab.window.ctx.clone();
    lab.state().act(&ctx, Action::SaveDataset);
    lab.window.run_steps(1);
    assert!(lab.notes().contains("Nothing is saved"), "{}", lab.notes());
}

#[test]
fn a_solver_is_not_stopped_by_closing_without_a_word() {
    let mut lab = lab(&text(8).replace("order = 1", "order = 4"));
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
    lab.until("it is solved", |viewer| viewer.solving.running().is_some());
    assert!(!closes(&mut lab));
    click(&mut lab, "Back");
    lab.window.run_steps(2);
    assert!(lab.window.query_by_label_contains("being solved.").is_none());
    assert!(lab.viewer().solving.running().is_some_and(|running| !running.is_cancelled()));
    assert!(!closes(&mut lab));
    lab.window.run_steps(2);
    assert!(lab.window.query_by_label("Save…").is_none(), "there is nothing to save yet");
    lab.window.get_by_label("Stop and close").click();
    lab.window.run_steps(1);
    assert!(commands(&lab.window).contains(&egui::ViewportCommand::Close));
    assert!(closes(&mut lab));
}

#[test]
fn who_wants_to_lose_a_solution_may() {
    let mut lab = lab(&text(2));
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
    lab.window.step();
    lab.settle();
    // the second view has it too
    lab.window.key_press(Key::V);
    lab.window.step();
    lab.settle();
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::W);
    lab.window.run_steps(2);
    assert!(lab.window.query_by_label(UNSAVED).is_none());
    assert_eq!(lab.viewer().viewports.len(), 1);
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::W);
    click(&mut lab, "Close without saving");
    assert!(lab.dataset(0).is_none());
    assert!(closes(&mut lab));
    // an example is solved again whenever one wants it
    lab.window.run_steps(2);
    lab.state().session.drawer = None;
    lab.window.run_steps(2);
    lab.window.get_by_label("Smooth manufactured field").click_accesskit();
    lab.window.step();
    lab.settle();
    assert!(lab.dataset(0).is_some() && closes(&mut lab));
}

/// Asks for a file and waits until it is shown or something is asked.
fn ask_for(lab: &mut Lab, path: &Path, pane: usize) {
    let ctx = lab.window.ctx.clone();
    lab.state().open_file(&ctx, path, pane);
    lab.settle();
    lab.window.run_steps(3);
}

#[test]
fn what_is_opened_takes_the_place_of_a_solution_only_if_that_is_meant() {
    let mut lab = lab(&text(2));
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
    lab.window.step();
    lab.settle();
    let solved = lab.dataset(0).expect("it is solved");
    let (other, session) = (lab.write("other.h5", &plate()), lab.path("one.ppum-session"));
    fs::write(&session, r#"{"ppum-session": 1, "panes": []}"#).expect("a session");
    let is_there = |lab: &Lab| lab.dataset(0).is_some_and(|there| Arc::ptr_eq(&there, &solved));
    for path in [&other, &session] {
        ask_for(&mut lab, path, 0);
        lab.window.get_by_label(UNSAVED);
        assert!(is_there(&lab));
        click(&mut lab, "Back");
        lab.settle();
        assert!(is_there(&lab) && lab.window.query_by_label(UNSAVED).is_none());
    }
    // meant for a view that has been closed while it was read
    lab.window.key_press(Key::V);
    lab.window.step();
    lab.settle();
    let ctx = lab.window.ctx.clone();
    lab.state().open_file(&ctx, &other, 1);
    lab.state().close(1);
    lab.settle();
    lab.window.run_steps(3);
    lab.window.get_by_label(UNSAVED);
    click(&mut lab, "Back");
    assert!(is_there(&lab));
    // beside it and a problem's text are no harm
    let problem = lab.path("again.toml");
    fs::write(&problem, text(2)).expect("a problem");
    for (path, pane) in [(&other, 1), (&problem, 0)] {
        ask_for(&mut lab, path, pane);
        assert!(is_there(&lab) && lab.window.query_by_label(UNSAVED).is_none());
    }
    assert!(lab.dataset(1).is_some());
    // saved first
    ask_for(&mut lab, &other, 0);
    click(&mut lab, "Save…");
    lab.window.run_steps(3);
    lab.window.key_press(Key::Enter);
    lab.until("it is saved and the other one open", |viewer| {
        let opened = viewer.viewports[0].opened.as_ref();
        opened.is_some_and(|opened| opened.path.as_ref() == Some(&other))
    });
    // under the name of its own problem
    assert_eq!(ppum_format::read(&lab.path("plate.h5")).expect("a dataset"), *solved);
    // or not
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
    lab.window.step();
    lab.settle();
    ask_for(&mut lab, &other, 0);
    click(&mut lab, "Open without saving");
    lab.settle();
    assert!(lab.viewer().viewports[0].opened.as_ref().is_some_and(|o| o.path.is_some()));
}

#[test]
fn who_writes_the_problem_saves_the_problem() {
    let mut lab = lab(&text(3));
    lab.window.get_by_label("Text of the problem").click();
    lab.window.run_steps(3);
    lab.window.event(egui::Event::Text("# a word\n".into()));
    lab.window.run_steps(2);
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::S);
    lab.window.run_steps(2);
    lab.settle();
    let written = fs::read_to_string(lab.path("plate.toml")).expect("there");
    assert!(written.contains("# a word"), "{}", lab.notes());
    assert!(lab.window.query_by_label_contains("ppum-session").is_none());
}
