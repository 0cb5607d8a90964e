//! The problem: its text with the errors in it, and its solution.

use std::ops::Range;
use std::sync::Arc;

use egui::text::{CCursor, CCursorRange};
use egui::{
    CompletionPopup, CompletionQuery, FontId, Key, ProgressBar, RectAlign, ScrollArea, Suggestion,
    TextEdit, TextStyle, Ui, vec2,
};
use ppum::text::trimmed;
use ppum_problem::keys::completions;

use super::preview;
use crate::actions::Action;
use crate::panel_context::PanelContext;
use crate::session::ProblemDraft;
use crate::solving::marks::HighlightStyle;
use crate::solving::{
    Mark, PHASES, RunningSolution, SolutionOutcome, SolverState, editor_id, phase_number,
};
use crate::viewport::ViewState;
use crate::widgets::{button, elided};

/// Longest text that is written in a window: every image lays all of it out.
pub const MAX_LENGTH: usize = 200_000;

/// Shows it.
pub fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let Some(mut draft) = context.session.draft.take() else {
        let has_dataset = context.active().1.opened.is_some();
        let empty =
            if has_dataset { "This dataset holds no problem." } else { "No problem is open." };
        ui.label(empty);
        ui.horizontal(|ui| {
            for (name, action) in [
                ("Open a problem file…", Action::Open),
                ("New problem", Action::NewProblem),
                ("Import a drawing…", Action::Import),
            ] {
                if ui.button(name).clicked() {
                    context.actions.push(action);
                }
            }
        });
        return texts_aside(ui, context);
    };
    context.solving.check(&draft);
    let room = ui.available_size();
    let is_wide = room.x > 640.0;
    let beside = if is_wide { (0.36 * room.x).clamp(230.0, 460.0) } else { room.x };
    let width = if is_wide { room.x - beside - 12.0 } else { room.x };
    let height = if is_wide { room.y } else { (0.5 * room.y).max(60.0) };
    let both = |ui: &mut Ui| {
        ui.allocate_ui(vec2(width, height), |ui| editor(ui, &mut draft, context.solving));
        ui.vertical(|ui| {
            ui.set_width(beside);
            ScrollArea::vertical()
                .id_salt("told")
                .show(ui, |ui| solution_panel(ui, &mut draft, context));
        });
    };
    if is_wide {
        ui.horizontal_top(both);
    } else {
        ui.vertical(both);
    }
    context.session.draft = Some(draft);
}

/// The text with the numbers of its lines.
fn editor(ui: &mut Ui, draft: &mut ProblemDraft, solving: &mut SolverState) {
    if draft.text.len() > MAX_LENGTH {
        ui.label("This text is too long to be written here. Its file is watched: save it elsewhere, and it is read again.");
        return;
    }
    let font = TextStyle::Monospace.resolve(ui.style());
    let look = HighlightStyle::new(ui.visuals(), font.clone());
    let checked = solving.checked().cloned();
    // marks of another text would stand in wrong places, unless their lines are still the same
    let marks: Vec<Mark> = match &checked {
        Some(checked) => still_there(&checked.text, &draft.text, &checked.marks),
        None => Vec::new(),
    };
    let mut layouter = |ui: &Ui, text: &dyn egui::TextBuffer, _: f32| {
        ui.fonts_mut(|fonts| fonts.layout_job(look.layout(text.as_str(), &marks)))
    };
    let digits = draft.text.lines().count().max(9).to_string().len() as f32;
    let gutter = (digits + 2.0) * 0.62 * font.size;
    let area = ScrollArea::both().id_salt("text").auto_shrink([false; 2]);
    area.show(ui, |ui| {
        let margin = egui::Margin { left: gutter as i8, right: 8, top: 4, bottom: 4 };
        let edit = TextEdit::multiline(&mut draft.text).code_editor();
        let edit = edit.layouter(&mut layouter).margin(margin).desired_width(f32::INFINITY);
        let rows = (ui.available_height() / (1.2 * font.size)).max(2.0) as usize;
        let popup = CompletionPopup::new(editor_id())
            .word_boundary(|c| !(c.is_ascii_alphanumeric() || "_[\"-".contains(c)))
            .align(RectAlign::BOTTOM_START)
            .accept_keys([Key::Tab]);
        let mut shown = popup.show(ui, edit.desired_rows(rows), suggestions).text_edit;
        shown.response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::Role::MultilineTextInput, true, "Text of the problem")
        });
        numbers(ui, &shown, &font, gutter);
        if let Some(place) = solving.jump.take() {
            go(ui, &mut shown, &draft.text, place);
        }
    });
}

/// Keys, tables and words that begin like what is written, where they may stand.
fn suggestions(query: &CompletionQuery<'_>) -> Vec<Suggestion> {
    let end = query.word_range.end.0;
    let end = query.text.char_indices().nth(end).map_or(query.text.len(), |(byte, _)| byte);
    if query.word.is_empty() {
        return Vec::new();
    }
    let all = completions(query.text, end).into_iter();
    let fits = |name: &String| name.starts_with(query.word) && name != query.word;
    all.filter(fits).map(Suggestion::new).collect()
}

/// The numbers of the rows that are seen.
fn numbers(ui: &Ui, shown: &egui::text_edit::TextEditOutput, font: &FontId, gutter: f32) {
    let clip = ui.clip_rect();
    for (number, row) in shown.galley.rows.iter().enumerate() {
        let top = shown.galley_pos.y + row.pos.y;
        if top > clip.bottom() || top + row.height() < clip.top() {
            continue;
        }
        let at = egui::pos2(shown.galley_pos.x - 0.25 * gutter, top);
        let text = (number + 1).to_string();
        let color = ui.visuals().weak_text_color();
        ui.painter().text(at, egui::Align2::RIGHT_TOP, text, font.clone(), color);
    }
}

/// Puts the cursor to a place of the text.
fn go(
    ui: &Ui,
    shown: &mut egui::text_edit::TextEditOutput,
    text: &str,
    [line, column]: [usize; 2],
) {
    let before: usize = text.split_inclusive('\n').take(line - 1).map(|l| l.chars().count()).sum();
    let range = CCursorRange::one(CCursor::new(before + column - 1));
    shown.state.cursor.set_char_range(Some(range));
    shown.state.clone().store(ui.ctx(), shown.response.id);
    shown.response.request_focus();
    let top = shown.galley_pos
        + shown.galley.rows.get(line - 1).map_or(vec2(0.0, 0.0), |row| row.pos.to_vec2());
    ui.scroll_to_rect(egui::Rect::from_min_size(top, vec2(10.0, 40.0)), Some(egui::Align::Center));
}

/// The marks of lines that are the same in both texts.
fn still_there(before: &str, now: &str, marks: &[Mark]) -> Vec<Mark> {
    if before == now {
        return marks.to_vec();
    }
    let line = |text: &str, number: usize| text.lines().nth(number - 1).map(str::to_owned);
    let is_same = |mark: &&Mark| mark.at.is_some_and(|[n, _]| line(before, n) == line(now, n));
    marks.iter().filter(is_same).cloned().collect()
}

/// Buttons for the text, and the state of its solution.
fn solution_panel(ui: &mut Ui, draft: &mut ProblemDraft, context: &mut PanelContext<'_>) {
    buttons(ui, draft, context);
    texts_aside(ui, context);
    if let Some(running) = context.solving.running() {
        progress(ui, running);
    }
    let checked = context.solving.checked().cloned();
    if let Some(checked) = &checked {
        mistakes(ui, &checked.marks, context.solving);
    }
    failure(ui, draft, context);
    solutions(ui, context);
    let opened = context.active().1.opened.as_ref();
    let solved = opened.and_then(|opened| opened.dataset.problem.as_ref());
    if solved.is_some_and(|text| *text != draft.text) {
        ui.horizontal_wrapped(|ui| {
            ui.label("What is shown was solved from another text.");
            if ui.button("Show that text").clicked() {
                context.actions.push(Action::ShowText);
            }
        });
    }
    if let Some(checked) = checked {
        let clicked = preview::show(ui, &checked);
        if let Some(part) = clicked.filter(|_| checked.text == draft.text) {
            context.solving.jump = part.condition.or_else(|| {
                let (text, place) = checked.border.with_condition(&draft.text, part);
                draft.text = text;
                Some(place)
            });
        }
    }
}

/// Changed texts that have made place for others.
fn texts_aside(ui: &mut Ui, context: &mut PanelContext<'_>) {
    for (number, text) in context.files.texts().iter().enumerate() {
        ui.horizontal(|ui| {
            let name = format!("Back to {} *", elided(&text.name(), LONGEST_NAME));
            let hint =
                "A changed text that made place for another one; it is kept when the window closes";
            if ui.button(name).on_hover_text(hint).clicked() {
                context.actions.push(Action::TakeText(number));
            }
            if button(ui, "✗", "Discard these changes").clicked() {
                context.actions.push(Action::DiscardText(number));
            }
        });
    }
}

/// Letters of a name that fit beside a button.
const LONGEST_NAME: usize = 28;

/// Why the last solution has left nothing.
fn failure(ui: &mut Ui, draft: &ProblemDraft, context: &PanelContext<'_>) {
    let solving = &*context.solving;
    let Some(outcome) = &solving.outcome else { return };
    let is_changed = solving.solved_text != draft.text;
    if is_changed && matches!(outcome, SolutionOutcome::Failed(_)) {
        return;
    }
    let mut shown =
        context.viewports.iter().filter_map(|viewport| viewport.opened.as_ref()?.solution.as_ref());
    let has_marks = solving.checked().is_some_and(|checked| !checked.marks.is_empty());
    if has_marks || shown.any(|solution| solution.outcome == *outcome) {
        // it is said at the errors of the text, or of what is shown
        return;
    }
    match outcome {
        SolutionOutcome::Cancelled(_) => {
            ui.label("Cancelled. What was there before is still shown.");
        }
        SolutionOutcome::Failed(error) => {
            ui.colored_label(ui.visuals().error_fg_color, error);
        }
        SolutionOutcome::Solved(..) => {}
    }
}

/// Shows the solution, if it was solved here or no file has it: each solution has its own button,
/// which goes once it is saved.
fn solutions(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let are_two = context.viewports.len() > 1;
    for (pane, viewport) in context.viewports.iter().enumerate() {
        let Some(opened) = &viewport.opened else { continue };
        let is_same = |other: &ViewState| {
            other.opened.as_ref().is_some_and(|o| Arc::ptr_eq(&o.dataset, &opened.dataset))
        };
        let outcome = opened.solution.as_ref().map(|solution| &solution.outcome);
        if context.viewports[..pane].iter().any(is_same) {
            continue;
        }
        if opened.path.is_some() && (outcome.is_none() || pane != context.session.active) {
            continue;
        }
        let place = match pane {
            _ if !are_two => String::new(),
            0 => format!("On the left, {}: ", opened.name()),
            _ => format!("On the right, {}: ", opened.name()),
        };
        ui.horizontal_wrapped(|ui| {
            ui.label(sentence(&place, outcome, opened.path.is_none()));
            if opened.path.is_none() && ui.button("Save the dataset…").clicked() {
                context.actions.push(Action::SaveDatasetOf(pane));
            }
        });
        match outcome {
            Some(SolutionOutcome::Solved(_, warnings)) => {
                for warning in warnings {
                    ui.colored_label(ui.visuals().warn_fg_color, format!("⚠ {warning}"));
                }
            }
            Some(SolutionOutcome::Failed(error)) => {
                ui.colored_label(ui.visuals().error_fg_color, error);
            }
            Some(SolutionOutcome::Cancelled(_)) | None => {}
        }
    }
}

/// How a solution has ended, and whether it is saved.
fn sentence(place: &str, outcome: Option<&SolutionOutcome>, is_unsaved: bool) -> String {
    let ended = match outcome {
        Some(SolutionOutcome::Solved(seconds, _)) => {
            format!("solved in {} s", trimmed((10.0 * seconds).round() / 10.0))
        }
        Some(SolutionOutcome::Cancelled(steps)) => {
            format!("cancelled; the {steps} steps before are shown")
        }
        Some(SolutionOutcome::Failed(_)) => "the steps before an error are shown".into(),
        None => String::new(),
    };
    let saved = if is_unsaved { "not saved" } else { "" };
    let parts: Vec<_> = [ended.as_str(), saved].into_iter().filter(|p| !p.is_empty()).collect();
    let text = parts.join(", ");
    match place {
        "" => format!("{}{}.", text[..1].to_uppercase(), &text[1..]),
        _ => format!("{place}{text}."),
    }
}

fn buttons(ui: &mut Ui, draft: &ProblemDraft, context: &mut PanelContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        let is_running = context.solving.running().is_some();
        let checked = context.solving.checked();
        let is_wrong = checked.is_some_and(|c| c.text == draft.text && !c.marks.is_empty());
        let solve = ui.add_enabled(!is_running && !is_wrong, egui::Button::new("Solve"));
        let why = if is_wrong { "The text has errors, see below" } else { "Already solving" };
        if solve.on_hover_text("Ctrl+Enter").on_disabled_hover_text(why).clicked() {
            context.actions.push(Action::Solve);
        }
        let is_changed = draft.is_changed();
        let can_save = draft.path.is_some() && is_changed;
        if ui
            .add_enabled(can_save, egui::Button::new("Save"))
            .on_hover_text("The text into its file")
            .clicked()
        {
            context.actions.push(Action::SaveProblem);
        }
        if ui.button("Save as…").clicked() {
            context.actions.push(Action::SaveProblemAs);
        }
        let name = draft.path.as_deref().map_or("no file yet".to_owned(), crate::files::name);
        ui.weak(if is_changed { format!("{name} *") } else { name });
        if button(ui, "✗", "Close the problem").clicked() {
            context.actions.push(Action::CloseProblem);
        }
        // the last one, so that a second click on it meets nothing
        if is_running && ui.button("Cancel").clicked() {
            context.solving.cancel();
        }
    });
}

/// How far the solution has come.
fn progress(ui: &mut Ui, running: &RunningSolution) {
    let told = running.progress_report();
    if let Some(estimate) = &told.estimate {
        ui.weak(estimate);
    }
    let phase = told.progress.map(|progress| progress.phase);
    let at = phase.map_or(0, phase_number);
    let name = phase.map_or("beginning", ppum::progress::Phase::name);
    let name = if running.is_cancelled() { "stopping" } else { name };
    let step = told.steps.zip(told.progress);
    let step = step.map_or(String::new(), |(n, at)| format!("step {} of {n}, ", at.step));
    let phase = format!("{} of {}: {name}", at + 1, PHASES.len());
    let text = format!("{step}{phase}, {:.0} s", running.seconds());
    let bar = ui.add(ProgressBar::new(told.part).desired_height(8.0));
    ui.label(&text);
    bar.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ProgressIndicator, true, &text));
    ui.ctx().request_repaint_after(std::time::Duration::from_millis(500));
}

/// Errors that are listed: nobody reads more of them at a time.
const SHOWN: Range<usize> = 0..50;

fn mistakes(ui: &mut Ui, marks: &[Mark], solving: &mut SolverState) {
    for mark in &marks[SHOWN.start..SHOWN.end.min(marks.len())] {
        let text = match mark.at {
            Some([line, column]) => format!("{line}:{column}  {}", mark.message),
            None => mark.message.clone(),
        };
        let text = egui::RichText::new(text).color(ui.visuals().error_fg_color);
        let label = ui.add(egui::Button::new(text).wrap().frame(false));
        if label.on_hover_text("Go there").clicked() {
            solving.jump = mark.at;
        }
    }
    if marks.len() > SHOWN.end {
        ui.weak(format!("and {} more", marks.len() - SHOWN.end));
    }
}
