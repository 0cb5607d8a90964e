//! Work that no file has: whatever is done beside it, it is still there, or a question names it.

use std::fs;
use std::sync::Arc;

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use ppum::dataset::Dataset;
use ppum_viewer::Viewer;
use ppum_viewer::actions::Action;
use ppum_viewer::session::ProblemDraft;
use ppum_viewer::window::WindowStart;

use crate::kit::plate;
use crate::lab::Lab;

const TEXT: &str = include_str!("../../../../examples/centre-crack.toml");
const MINE: &str = "young = 7.0";

/// A small problem with a title.
fn text(title: &str) -> String {
    let text = TEXT.replace("Centre crack in a square plate", title);
    text.replace("level = 6\norder = 2", "level = 2\norder = 1")
}

/// Minutes of work.
fn long(title: &str) -> String {
    text(title) + "\n[growth]\nincrement = 1e-5\nsteps = 8000\n"
}

fn write(lab: &Lab, name: &str, text: &str) -> std::path::PathBuf {
    let path = lab.path(name);
    fs::write(&path, text).expect("written");
    path
}

fn draft(lab: &mut Lab) -> &mut ProblemDraft {
    lab.state().session.draft.as_mut().expect("a text is open")
}

fn act(lab: &mut Lab, action: Action) {
    let ctx = lab.window.ctx.clone();
    lab.state().act(&ctx, action);
    lab.window.run_steps(3);
}

/// Waits for everything but the solver.
fn rest(lab: &mut Lab) {
    lab.until("files are read", |viewer| !viewer.files.is_working());
    lab.window.run_steps(3);
}

/// Opens a file in the active view, and waits until it is shown or something is asked.
fn open(lab: &mut Lab, path: &std::path::Path) {
    let (ctx, active) = (lab.window.ctx.clone(), lab.viewer().session.active);
    lab.state().open_file(&ctx, path, active);
    rest(lab);
}

fn solve(lab: &mut Lab) -> Arc<Dataset> {
    act(lab, Action::Solve);
    lab.settle();
    let active = lab.viewer().session.active;
    lab.dataset(active).expect("it is solved")
}

fn click(lab: &mut Lab, label: &str) {
    lab.window.run_steps(2);
    // it may lie below the fold
    lab.window.get_by_label(label).click_accesskit();
    lab.window.run_steps(3);
}

fn has(lab: &Lab, part: &str) -> bool {
    lab.window.query_all_by_label_contains(part).next().is_some()
}

/// True if a text is written now, or was put aside.
fn has_text(viewer: &Viewer, text: &str) -> bool {
    let draft = viewer.session.draft.iter().chain(viewer.files.texts());
    draft.into_iter().any(|draft| draft.text == text)
}

/// Asks the window to close, as its cross does; true if it does.
fn closes(lab: &mut Lab) -> bool {
    let viewports = &mut lab.window.input_mut().viewports;
    let viewport = viewports.entry(egui::ViewportId::ROOT).or_default();
    viewport.events.push(egui::ViewportEvent::Close);
    lab.window.step();
    let output = &lab.window.output().viewport_output[&egui::ViewportId::ROOT];
    let is_kept = output.commands.contains(&egui::ViewportCommand::CancelClose);
    lab.window.run_steps(2);
    !is_kept
}

/// What there is that could be lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    TwoViews,
    Changed,
    Unsaved,
    Running,
}

/// What is done beside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Deed {
    OpenDataset,
    OpenProblem,
    OpenSession,
    Solve,
    CloseView,
    CloseProblem,
    Quit,
    Example,
    Undo,
    Redo,
}

/// Work that was done, and must be found again.
struct Work {
    solution: Option<Arc<Dataset>>,
    text: Option<String>,
    is_running: bool,
}

/// A window in two states at once.
fn lab(states: [State; 2]) -> (Lab, Work) {
    let mut lab = Lab::new();
    lab.window.set_size(egui::vec2(700.0, 500.0));
    let (mut solution, mut changed) = (None, None);
    if states.contains(&State::TwoViews) {
        let other = lab.write("shown.h5", &plate());
        lab.open(&other);
        act(&mut lab, Action::Split);
        lab.state().session.active = 1;
        lab.settle();
    }
    if states.contains(&State::Unsaved) {
        let path = write(&lab, "unsaved.toml", &text("Unsaved"));
        open(&mut lab, &path);
        solution = Some(solve(&mut lab));
    }
    if states.contains(&State::Running) {
        let path = write(&lab, "long.toml", &long("Long"));
        open(&mut lab, &path);
        act(&mut lab, Action::Solve);
        if lab.viewer().is_asking() {
            click(&mut lab, "Solve without saving");
        }
        lab.until("it is being solved", |viewer| viewer.solving.running().is_some());
    }
    if states.contains(&State::Changed) {
        let path = write(&lab, "changed.toml", &text("Changed"));
        open(&mut lab, &path);
        let mine = text("Changed").replace("young = 1.0", MINE);
        draft(&mut lab).text.clone_from(&mine);
        changed = Some(mine);
        lab.window.run_steps(2);
    }
    let is_running = states.contains(&State::Running);
    (lab, Work { solution, text: changed, is_running })
}

/// The number of an example that takes no time.
fn quick_example() -> usize {
    let mut all = ppum_viewer::files::examples::ALL.iter();
    all.position(|example| example.name == "smooth-field").expect("it is there")
}

fn perform(lab: &mut Lab, deed: Deed) {
    match deed {
        Deed::OpenDataset => {
            let path = lab.write("other.h5", &plate());
            open(lab, &path);
        }
        Deed::OpenProblem => {
            let path = write(lab, "other.toml", &text("Other"));
            open(lab, &path);
        }
        Deed::OpenSession => {
            let path = write(lab, "one.ppum-session", r#"{"ppum-session": 1, "panes": []}"#);
            open(lab, &path);
        }
        Deed::Solve => {
            // of another problem than any that was solved
            if lab.viewer().session.draft.as_ref().is_none_or(|draft| !draft.is_changed()) {
                let path = write(lab, "new.toml", &text("New"));
                open(lab, &path);
            }
            act(lab, Action::Solve);
        }
        Deed::CloseView => act(lab, Action::Close),
        Deed::CloseProblem => act(lab, Action::CloseProblem),
        Deed::Quit => drop(closes(lab)),
        Deed::Example => act(lab, Action::Example(quick_example())),
        Deed::Undo => act(lab, Action::Undo),
        Deed::Redo => act(lab, Action::Redo),
    }
}

/// Everything is there, or a question names it; and after the answer Back everything is there.
fn check(lab: &mut Lab, work: &Work, doing: &str) {
    let is_asked = lab.viewer().is_asking();
    let is_shown = |solution: &Arc<Dataset>| {
        let mut all = lab.viewer().viewports.iter().filter_map(|viewport| viewport.opened.as_ref());
        all.any(|opened| Arc::ptr_eq(&opened.dataset, solution))
    };
    if let Some(solution) = &work.solution {
        assert!(is_shown(solution), "{doing}: the solution is lost");
    }
    if let Some(text) = &work.text {
        assert!(has_text(lab.viewer(), text), "{doing}: the text is lost");
    }
    let running = lab.viewer().solving.running();
    let goes_on = running.is_some_and(|running| !running.is_cancelled());
    assert!(!work.is_running || goes_on, "{doing}: the solver is stopped");
    if is_asked {
        let is_named = has(lab, " is not saved.") || has(lab, " is being solved.");
        assert!(is_named, "{doing}: the question names nothing");
        click(lab, "Back");
        assert!(!lab.viewer().is_asking(), "{doing}");
        check(lab, work, &format!("{doing}, back"));
    }
}

/// Pairs of states, and all that is done in them: nothing goes unasked, and texts outlast the
/// window.
#[test]
#[ignore = "slow: sixty deeds in six windows, with solvers beside them"]
fn no_work_is_lost_whatever_is_done() {
    use State::{Changed, Running, TwoViews, Unsaved};
    let pairs = [
        [TwoViews, Changed],
        [TwoViews, Unsaved],
        [TwoViews, Running],
        [Changed, Unsaved],
        [Changed, Running],
        [Unsaved, Running],
    ];
    let deeds = [
        Deed::OpenDataset,
        Deed::OpenProblem,
        Deed::OpenSession,
        Deed::Solve,
        Deed::CloseView,
        Deed::CloseProblem,
        Deed::Example,
        Deed::Undo,
        Deed::Redo,
        Deed::Quit,
    ];
    for states in pairs {
        let (mut lab, work) = lab(states);
        for deed in deeds {
            // each is tried where the work is: none but a question may keep it from going
            let doing = format!("{states:?}, {deed:?}");
            perform(&mut lab, deed);
            check(&mut lab, &work, &doing);
            if lab.viewer().solving.running().is_some() && !work.is_running {
                act(&mut lab, Action::CancelSolving);
                lab.settle();
                check(&mut lab, &work, &format!("{doing}, cancelled"));
            }
        }
        act(&mut lab, Action::CancelSolving);
        lab.settle();
        lab.reopen(WindowStart::default());
        if let Some(text) = &work.text {
            assert!(has_text(lab.viewer(), text), "{states:?}: the text is lost at the end");
        }
    }
}

/// Solving again replaces the solution of the same problem, and asks before it replaces another.
#[test]
fn solving_another_problem_asks_for_the_solution() {
    let mut lab = Lab::new();
    let [first, second] = ["First", "Second"]
        .map(|title| write(&lab, &format!("{}.toml", title.to_lowercase()), &text(title)));
    open(&mut lab, &first);
    let solved = solve(&mut lab);
    // the same problem, changed: that is what one wants
    draft(&mut lab).text = text("First").replace("young = 1.0", MINE);
    let again = solve(&mut lab);
    assert!(!Arc::ptr_eq(&solved, &again) && !lab.viewer().is_asking());
    open(&mut lab, &second);
    act(&mut lab, Action::Solve);
    assert!(has(&lab, "The solution “First” is not saved."));
    click(&mut lab, "Back");
    assert!(Arc::ptr_eq(&again, &lab.dataset(0).expect("it stays")));
    assert!(lab.viewer().solving.running().is_none());
    // saved under the name of its own problem, whatever text is open; then the other is solved
    act(&mut lab, Action::Solve);
    click(&mut lab, "Save…");
    lab.window.key_press(Key::Enter);
    lab.until("the other one is solved", |viewer| {
        let opened = viewer.viewports[0].opened.as_ref();
        opened.is_some_and(|opened| opened.dataset.title == "Second")
    });
    let saved = ppum_format::read(&lab.path("first.h5")).expect("it is saved");
    assert_eq!(saved, *again);
    assert!(!lab.path("second.h5").exists());
}

/// A solution that a newer one of the same problem has replaced is brought back by undo, and the
/// newer one is then asked for.
#[test]
fn undo_brings_a_replaced_solution_back() {
    let mut lab = Lab::new();
    let path = write(&lab, "first.toml", &text("First"));
    open(&mut lab, &path);
    let before = solve(&mut lab);
    draft(&mut lab).text = text("First").replace("young = 1.0", MINE);
    let after = solve(&mut lab);
    let is_shown = |lab: &Lab, one: &Arc<Dataset>| Arc::ptr_eq(one, &lab.dataset(0).expect("it"));
    assert!(is_shown(&lab, &after));
    // what was changed since goes first
    let theme = lab.viewer().session.theme;
    act(&mut lab, Action::Theme);
    act(&mut lab, Action::Undo);
    assert!(is_shown(&lab, &after) && lab.viewer().session.theme == theme);
    act(&mut lab, Action::Undo);
    assert!(is_shown(&lab, &before));
    assert!(!closes(&mut lab));
    assert!(has(&lab, "The solution “First” is not saved."));
    assert!(has(&lab, "The solution “First”, undone, is not saved."));
    click(&mut lab, "Back");
    act(&mut lab, Action::Redo);
    assert!(is_shown(&lab, &after));
    act(&mut lab, Action::Undo);
    // both are saved, one after the other, and the window closes then
    assert!(!closes(&mut lab));
    click(&mut lab, "Save…");
    lab.window.key_press(Key::Enter);
    rest(&mut lab);
    click(&mut lab, "Save…");
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    lab.window.step();
    lab.window.event(egui::Event::Text(lab.path("newer.h5").display().to_string()));
    lab.window.step();
    lab.window.key_press(Key::Enter);
    rest(&mut lab);
    for (name, solution) in [("first.h5", &before), ("newer.h5", &after)] {
        assert_eq!(ppum_format::read(&lab.path(name)).expect("it is saved"), **solution);
    }
    assert!(closes(&mut lab));
}

/// The page has the text of what the active view shows, with its file, unless the text was changed
/// or is to be solved.
#[test]
fn the_text_is_that_of_the_active_view() {
    let mut lab = Lab::new();
    let left = write(&lab, "left.toml", &text("Left"));
    open(&mut lab, &left);
    let _ = solve(&mut lab);
    act(&mut lab, Action::Split);
    lab.state().session.active = 1;
    let other = lab.write("other.h5", &plate());
    open(&mut lab, &other);
    lab.window.run_steps(3);
    let shown = |lab: &mut Lab| {
        lab.window.run_steps(3);
        rest(lab);
        draft(lab).clone()
    };
    let is_of_plate = |draft: &ProblemDraft| Some(&draft.text) == plate().problem.as_ref();
    assert!(is_of_plate(&shown(&mut lab)));
    lab.state().session.active = 0;
    let text_of_left = shown(&mut lab);
    assert_eq!((&text_of_left.path, &text_of_left.text), (&Some(left), &text("Left")));
    lab.state().session.active = 1;
    assert!(is_of_plate(&shown(&mut lab)));
    // one that is opened is solved next, whichever view is looked at
    let next = write(&lab, "next.toml", &text("Next"));
    open(&mut lab, &next);
    lab.state().session.active = 0;
    assert_eq!(shown(&mut lab).path.as_ref(), Some(&next));
    // and a changed one stays
    let mine = text("Next").replace("young = 1.0", MINE);
    draft(&mut lab).text.clone_from(&mine);
    open(&mut lab, &other);
    click(&mut lab, "Open without saving");
    rest(&mut lab);
    assert_eq!(shown(&mut lab).text, mine);
}

/// A text that gets a file is the same problem still, and gives its solution the name.
#[test]
fn a_problem_that_gets_a_file_is_the_same_problem() {
    let mut lab = Lab::new();
    let path = write(&lab, "first.toml", &text("First"));
    open(&mut lab, &path);
    draft(&mut lab).path = None;
    let solved = solve(&mut lab);
    act(&mut lab, Action::SaveProblemAs);
    lab.window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    lab.window.step();
    lab.window.event(egui::Event::Text(lab.path("named.toml").display().to_string()));
    lab.window.step();
    lab.window.key_press(Key::Enter);
    lab.window.run_steps(2);
    rest(&mut lab);
    let named = lab.path("named.toml");
    assert_eq!(draft(&mut lab).path.as_ref(), Some(&named));
    let opened = lab.viewer().viewports[0].opened.as_ref().expect("it is shown");
    let proposed = opened.proposed_name(std::path::Path::new("/"));
    assert_eq!(proposed, Some(lab.path("named.h5")));
    draft(&mut lab).text = text("First").replace("young = 1.0", MINE);
    assert!(!Arc::ptr_eq(&solved, &solve(&mut lab)));
}

/// Steps before a stop are less than the whole solution that they would replace.
#[test]
fn a_stopped_series_takes_no_whole_solution_away() {
    let mut lab = Lab::new();
    let path = write(&lab, "first.toml", &text("First"));
    open(&mut lab, &path);
    let solved = solve(&mut lab);
    draft(&mut lab).text = long("First");
    act(&mut lab, Action::Solve);
    lab.until("a step is solved", |viewer| {
        let progress = viewer.solving.running().and_then(|r| r.progress_report().progress);
        progress.is_some_and(|progress| progress.step >= 2)
    });
    act(&mut lab, Action::CancelSolving);
    lab.settle();
    assert!(Arc::ptr_eq(&solved, &lab.dataset(0).expect("it stays")));
    assert!(lab.dataset(1).expect("the steps are beside it").steps.len() >= 2);
}

/// Texts that were changed and made place for others are kept over the end of the day, all of them,
/// until someone says that they are not wanted.
#[test]
fn changed_texts_outlast_the_window() {
    let mut lab = Lab::new();
    let titles = ["One", "Two", "Three"];
    let mine = titles.map(|title| text(title).replace("young = 1.0", MINE));
    for (title, mine) in titles.iter().zip(&mine) {
        let path = write(&lab, &format!("{title}.toml"), &text(title));
        open(&mut lab, &path);
        draft(&mut lab).text.clone_from(mine);
        lab.window.run_steps(2);
    }
    act(&mut lab, Action::CloseProblem);
    assert!(closes(&mut lab), "nothing is lost, nothing is asked");
    lab.reopen(WindowStart::default());
    // with another file, too
    let other = lab.write("other.h5", &plate());
    lab.reopen(WindowStart { files: vec![other], ..WindowStart::default() });
    for mine in &mine {
        assert!(has_text(lab.viewer(), mine));
    }
    act(&mut lab, Action::Drawer(ppum_viewer::session::DrawerPage::Problem));
    click(&mut lab, "Back to One.toml *");
    rest(&mut lab);
    assert_eq!(draft(&mut lab).text, mine[0]);
    assert!(draft(&mut lab).is_changed());
    assert_eq!(lab.notes(), "");
    click(&mut lab, "Back to Three.toml *");
    assert_eq!(draft(&mut lab).text, mine[2]);
    assert!(has_text(lab.viewer(), &mine[0]));
    let discard = |lab: &mut Lab| {
        lab.window.run_steps(2);
        let all: Vec<_> = lab.window.query_all_by_label("Discard these changes").collect();
        all[0].click_accesskit();
        lab.window.run_steps(3);
        assert!(has(lab, "The changes in Two.toml are not saved."));
    };
    discard(&mut lab);
    click(&mut lab, "Back");
    assert!(has_text(lab.viewer(), &mine[1]));
    discard(&mut lab);
    click(&mut lab, "Discard the changes");
    assert!(!has_text(lab.viewer(), &mine[1]) && has_text(lab.viewer(), &mine[0]));
    lab.reopen(WindowStart::default());
    assert!(!has_text(lab.viewer(), &mine[1]) && has_text(lab.viewer(), &mine[0]));
    assert_eq!(draft(&mut lab).text, mine[2]);
    // once it is in its file it is changed no more
    act(&mut lab, Action::SaveProblem);
    rest(&mut lab);
    assert!(!draft(&mut lab).is_changed());
    assert_eq!(fs::read_to_string(lab.path("Three.toml")).expect("there"), mine[2]);
}

/// Where nothing can be kept, closing the window asks for changed texts.
#[test]
fn changed_texts_that_cannot_be_kept_are_asked_for() {
    let mut lab = Lab::new();
    lab.state().files.leave_no_trace();
    let path = write(&lab, "plate.toml", &text("Plate"));
    open(&mut lab, &path);
    assert!(closes(&mut lab), "nothing is changed");
    draft(&mut lab).text = text("Plate").replace("young = 1.0", MINE);
    assert!(!closes(&mut lab));
    assert!(has(&lab, "The changes in plate.toml are not saved."));
    click(&mut lab, "Save…");
    rest(&mut lab);
    assert!(fs::read_to_string(&path).expect("there").contains(MINE));
}

/// Ctrl+Z in a text takes back its own changes, not those of a text before.
#[test]
fn a_text_does_not_take_back_what_another_one_was() {
    let mut lab = Lab::new();
    let [first, second] =
        ["first", "second"].map(|name| write(&lab, &format!("{name}.toml"), &text(name)));
    open(&mut lab, &first);
    lab.window.get_by_label("Text of the problem").click();
    lab.window.run_steps(3);
    lab.window.event(egui::Event::Text("# mine\n".into()));
    lab.window.run_steps(60);
    open(&mut lab, &second);
    lab.window.get_by_label("Text of the problem").click();
    lab.window.run_steps(3);
    for _ in 0..3 {
        lab.window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        lab.window.run_steps(3);
    }
    assert_eq!(draft(&mut lab).text, text("second"));
}

/// Two views with a solution each: every button saves the one that it stands at, under the name of
/// its own problem, whatever view is active and whatever text is open.
#[test]
fn each_solution_is_saved_as_itself() {
    let mut lab = Lab::new();
    let [left, right, third] =
        ["left", "right", "third"].map(|name| write(&lab, &format!("{name}.toml"), &text(name)));
    open(&mut lab, &left);
    solve(&mut lab);
    act(&mut lab, Action::Split);
    lab.state().session.active = 1;
    open(&mut lab, &right);
    solve(&mut lab);
    // what is asked names both, and their views
    assert!(!closes(&mut lab));
    assert!(has(&lab, "The solution “left” on the left is not saved."));
    assert!(has(&lab, "The solution “right” on the right is not saved."));
    click(&mut lab, "Back");
    open(&mut lab, &third);
    lab.state().session.active = 0;
    lab.window.run_steps(2);
    for (number, name) in [(1, "right"), (0, "left")] {
        lab.window.run_steps(2);
        let lines: Vec<_> = lab.window.query_all_by_label("Save the dataset…").collect();
        assert_eq!(lines.len(), number + 1, "one goes when its solution is saved");
        lines[number].click_accesskit();
        lab.window.run_steps(3);
        // what is done meanwhile changes nothing
        lab.state().session.active = number;
        lab.window.key_press(Key::Enter);
        lab.window.run_steps(2);
        rest(&mut lab);
        let saved = ppum_format::read(&lab.path(&format!("{name}.h5"))).expect("it is saved");
        assert_eq!(saved.title, name, "{}", lab.notes());
    }
    assert!(lab.window.query_by_label("Save the dataset…").is_none());
    assert!(!lab.path("third.h5").exists() && closes(&mut lab));
}

/// The page shows the text of the plate that is seen, unless another one is written.
#[test]
fn the_text_follows_what_is_shown() {
    let mut lab = Lab::new();
    let [mut first, mut second] = [plate(), plate()];
    (first.problem, second.problem) = (Some(text("first")), Some(text("second")));
    let [first, second] = [("a.h5", first), ("b.h5", second)].map(|(n, d)| lab.write(n, &d));
    open(&mut lab, &first);
    act(&mut lab, Action::Drawer(ppum_viewer::session::DrawerPage::Problem));
    assert_eq!(draft(&mut lab).text, text("first"));
    open(&mut lab, &second);
    assert_eq!(draft(&mut lab).text, text("second"));
    let mine = text("second").replace("young = 1.0", MINE);
    draft(&mut lab).text.clone_from(&mine);
    open(&mut lab, &first);
    assert_eq!(draft(&mut lab).text, mine, "what is changed stays");
    click(&mut lab, "Show that text");
    assert_eq!(draft(&mut lab).text, text("first"));
    assert!(has_text(lab.viewer(), &mine));
}
