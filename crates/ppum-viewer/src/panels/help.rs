//! The list of keys.

use egui::{Grid, Key, KeyboardShortcut, Modifiers, ScrollArea, Ui, Window};

use crate::actions::{Action, ActionEntry, GESTURES, GROUPS, spelled};

/// Columns of the list, where the window has room for them.
const COLUMNS: usize = 3;
/// Width of a column \[points\].
const WIDTH: f32 = 380.0;
/// Margin around the columns \[points\].
const MARGIN: f32 = 60.0;

/// Discards other keys while the list is open; Escape and the list's own key close it.
pub fn take(ctx: &egui::Context, is_open: &mut bool, actions: &mut Vec<Action>) {
    if *is_open {
        actions.retain(|action| *action == Action::Help);
        let escape = ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
        *is_open = !escape;
    }
}

/// Shows the list if it is open, with as many columns as the window has room for.
pub fn show(ui: &Ui, is_open: &mut bool) {
    let room = ui.ctx().content_rect().size();
    let columns = (((room.x - MARGIN) / WIDTH) as usize).clamp(1, COLUMNS);
    let window = Window::new("Keys").open(is_open).collapsible(false).default_pos([20.0, 40.0]);
    let window = window.default_size([columns as f32 * WIDTH, room.y - 90.0]);
    window.show(ui.ctx(), |ui| {
        ScrollArea::vertical().max_height(room.y - 110.0).show(ui, |ui| {
            ui.horizontal_top(|ui| {
                for groups in columns_of(columns) {
                    ui.vertical(|ui| groups.into_iter().for_each(|group| list(ui, group)));
                    ui.add_space(12.0);
                }
            });
        });
    });
}

/// A heading and the actions below it.
type Group = (&'static str, &'static [ActionEntry]);

/// Distributes the headings over the columns, with about the same number of keys in each.
fn columns_of(columns: usize) -> Vec<Vec<Group>> {
    let keys = |(group, entries): Group| {
        let by_hand = GESTURES.iter().filter(|(.., of)| *of == group);
        by_key(entries).count() + by_hand.count() + 2
    };
    let all: usize = GROUPS.iter().map(|group| keys(*group)).sum();
    let mut found = vec![Vec::new(); columns];
    let mut before = 0;
    for group in GROUPS.iter().copied() {
        // the middle of a heading's keys determines its column
        let middle = before + keys(group) / 2;
        found[(middle * columns / all).min(columns - 1)].push(group);
        before += keys(group);
    }
    found
}

/// The actions that have keys; the nine tips share one line.
fn by_key(
    entries: &'static [ActionEntry],
) -> impl Iterator<Item = (&'static ActionEntry, KeyboardShortcut)> {
    let is_one = |entry: &&ActionEntry| !matches!(entry.action, Action::Tip(1..));
    entries.iter().filter(is_one).filter_map(|entry| Some((entry, entry.shortcut()?)))
}

fn list(ui: &mut Ui, (group, entries): Group) {
    ui.strong(group);
    Grid::new(group).num_columns(2).show(ui, |ui| {
        for (entry, key) in by_key(entries) {
            let is_first = entry.action == Action::Tip(0);
            let key = spelled(ui.ctx(), &key);
            ui.monospace(if is_first { "1 … 9".into() } else { key });
            ui.label(if is_first { "Fly to tip 0 … 8" } else { entry.name });
            ui.end_row();
        }
        for (hand, meaning, _) in GESTURES.iter().filter(|(.., of)| *of == group) {
            ui.label(*hand);
            ui.label(*meaning);
            ui.end_row();
        }
    });
    ui.add_space(8.0);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_heading_stands_in_one_column() {
        for columns in 1..=COLUMNS {
            let found = columns_of(columns);
            let headings = |all: &[Group]| all.iter().map(|(name, _)| *name).collect::<Vec<_>>();
            assert_eq!(headings(&found.concat()), headings(GROUPS));
            assert!(found.iter().all(|groups| !groups.is_empty()), "{columns}");
        }
    }
}
