//! Actions of the user, by a key, a menu or the palette: one list for all three, and for the help
//! sheet.

use egui::{Event, Key, KeyboardShortcut, Modifiers, RawInput};

use crate::export::ExportChoice;
use crate::reading::tool::Tool;
use crate::session::DrawerPage;

/// Something a person can do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Show the whole body.
    Fit,
    /// Fly to a tip, by its number from 0.
    Tip(usize),
    /// Fly to the tip after the last one.
    NextTip,
    /// Enlarge around the middle.
    ZoomIn,
    /// The opposite.
    ZoomOut,
    /// Move the view by parts of its size: right and up.
    Pan(i8, i8),
    /// To the view before.
    Back,
    /// To the view that one came back from.
    Forward,
    /// Linear, logarithmic, symmetric-logarithmic.
    NextScale,
    /// The range that the program finds.
    AutomaticRange,
    /// The next colour map.
    NextMap,
    /// Choose a quantity.
    Quantity,
    /// The colour map from its other end.
    ReverseMap,
    /// The range stays as it is.
    FreezeRange,
    /// All overlays on and off.
    Overlays,
    /// Isolines on and off.
    Isolines,
    /// The deformed body on and off.
    Deform,
    /// The deformed body in motion.
    Swing,
    /// The whole of a half or quarter model, on and off.
    Mirror,
    /// Direct against resampled.
    Compare,
    /// Pin a probe at the pointer.
    Probe,
    /// A circle around the nearest tip, for K.
    CircleForK,
    /// Draw a curve by the mouse.
    Draw(Tool),
    /// Marks at the extrema of the view, on and off.
    Extrema,
    /// A page of the drawer, opened or closed.
    Drawer(DrawerPage),
    /// Save an image of what is seen.
    Save(ExportChoice),
    /// Copy the command that draws it.
    CopyCommand,
    /// Steps of a series on or back.
    Step(i8),
    /// Play the steps of a series, or stop.
    Play,
    /// Choose a file and open it.
    Open,
    /// Choose a file and open it in a second view on the right.
    OpenBeside,
    /// Close the dataset.
    Close,
    /// Write the dataset to a file that is chosen.
    SaveDataset,
    /// Write the dataset of a view, by its number.
    SaveDatasetOf(usize),
    /// Write a page of what is seen to a file that is chosen.
    ExportPage,
    /// Write the session to its file; to one that is chosen if it has none.
    SaveSession,
    /// Write the session to a file that is chosen.
    SaveSessionAs,
    /// Solve the problem of the text.
    Solve,
    /// Solve an example, by its number.
    Example(usize),
    /// Stop solving.
    CancelSolving,
    /// Write the problem's text to its file.
    SaveProblem,
    /// Write the problem's text to a file that is chosen.
    SaveProblemAs,
    /// Close the problem's text.
    CloseProblem,
    /// Take a changed text that was put aside, by its number.
    TakeText(usize),
    /// No longer keep one.
    DiscardText(usize),
    /// The text of the problem whose solution is shown.
    ShowText,
    /// One view, or two side by side.
    Split,
    /// The difference of two views on and off.
    Minus,
    /// Take back the last change of settings.
    Undo,
    /// Do it again.
    Redo,
    /// Panels shown or hidden.
    Panels,
    /// Light, dark.
    Theme,
    /// Letters and controls larger (1), smaller (-1), or as they were (0).
    Interface(i8),
    /// The list of keys.
    Help,
    /// Find an action by its name.
    Palette,
    /// Close the window.
    Quit,
}

/// An action with its name and key.
#[derive(Clone, Copy, Debug)]
pub struct ActionEntry {
    /// The action.
    pub action: Action,
    /// Its name in menus and the palette.
    pub name: &'static str,
    /// Its key, if it has one.
    pub key: Option<KeyboardShortcut>,
    /// The heading that it stands below on the help sheet.
    pub group: &'static str,
}

const fn entry(
    action: Action,
    name: &'static str,
    key: Option<KeyboardShortcut>,
    group: &'static str,
) -> ActionEntry {
    ActionEntry { action, name, key, group }
}

const fn key(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::NONE, key))
}

const fn shift(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::SHIFT, key))
}

const fn control(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::COMMAND, key))
}

const fn control_shift(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), key))
}

/// Other words that people look for an action by.
#[must_use]
pub fn synonyms(action: Action) -> &'static str {
    match action {
        Action::Fit => "home reset fit zoom all",
        Action::ZoomIn => "enlarge magnify larger",
        Action::ZoomOut => "reduce smaller",
        Action::Tip(_) | Action::NextTip => "go to zoom crack",
        Action::Quantity => {
            "variable stress strain displacement von mises formula error field component"
        }
        Action::NextScale => "log scale",
        Action::AutomaticRange | Action::FreezeRange => "limits minimum maximum clim",
        Action::NextMap | Action::ReverseMap => "colormap cmap palette colour bar",
        Action::Overlays => "mesh cells patches cracks outline elements grid",
        Action::Isolines => "contour level lines",
        Action::Deform => "deformation warp displacement opening",
        Action::Quit => "exit leave close window",
        Action::Interface(_) => "zoom scale font size letters larger smaller interface",
        Action::Swing => "animate warp movie",
        Action::Mirror => "mirror symmetry reflect",
        Action::Compare => "interpolation error sampling",
        Action::Probe | Action::Draw(Tool::Probe) => "value pick point query marker",
        Action::CircleForK => "sif stress intensity factor k1 k2 j integral energy release",
        Action::Draw(_) => "profile path section cut",
        Action::Extrema => "minimum maximum peak",
        Action::Drawer(DrawerPage::Plot) => "profile line graph chart sliding jump path csv",
        Action::Drawer(DrawerPage::Tips) => {
            "sif stress intensity factors k1 k2 t g energy release error"
        }
        Action::Drawer(DrawerPage::Series) => "history steps growth k over time",
        Action::Drawer(DrawerPage::Solver) => {
            "error estimate warnings convergence unknowns condition"
        }
        Action::Drawer(DrawerPage::Problem) => "toml input edit loads material mesh cover",
        Action::Save(ExportChoice::Picture) => "export image png screenshot",
        Action::Save(ExportChoice::Figure) => "export pdf svg png paper print image",
        Action::Save(_) => "export gif movie film video apng",
        Action::CopyCommand => "export script shell",
        Action::Step(_) | Action::Play => "time animation movie film",
        Action::Split => "compare side window",
        Action::Minus => "compare subtract error",
        Action::Panels => "sidebar controls full screen",
        Action::Theme => "theme dark mode appearance colours",
        Action::Help => "shortcuts keyboard manual font",
        Action::Palette => "search command",
        Action::SaveDataset => "export h5 hdf5 result",
        Action::ExportPage => "save html web internet share",
        Action::Open | Action::OpenBeside => "load import file",
        Action::Solve => "run compute calculate",
        Action::CancelSolving => "stop abort",
        _ => "",
    }
}

/// Headings of the help sheet, in their order.
pub const GROUPS: [&str; 6] =
    ["Moving", "Colours", "Over the picture", "Reading", "Files and problems", "Window"];

/// All actions, in the order of the help sheet. The keys for the interface's size are egui's own.
pub const ALL: &[ActionEntry] = &[
    entry(Action::Fit, "Show the whole plate", key(Key::F), "Moving"),
    entry(Action::NextTip, "Fly to the next tip", key(Key::N), "Moving"),
    entry(Action::Tip(0), "Fly to tip 0", key(Key::Num1), "Moving"),
    entry(Action::Tip(1), "Fly to tip 1", key(Key::Num2), "Moving"),
    entry(Action::Tip(2), "Fly to tip 2", key(Key::Num3), "Moving"),
    entry(Action::Tip(3), "Fly to tip 3", key(Key::Num4), "Moving"),
    entry(Action::Tip(4), "Fly to tip 4", key(Key::Num5), "Moving"),
    entry(Action::Tip(5), "Fly to tip 5", key(Key::Num6), "Moving"),
    entry(Action::Tip(6), "Fly to tip 6", key(Key::Num7), "Moving"),
    entry(Action::Tip(7), "Fly to tip 7", key(Key::Num8), "Moving"),
    entry(Action::Tip(8), "Fly to tip 8", key(Key::Num9), "Moving"),
    entry(Action::ZoomIn, "Zoom in", key(Key::Plus), "Moving"),
    entry(Action::ZoomOut, "Zoom out", key(Key::Minus), "Moving"),
    entry(Action::Pan(-1, 0), "Move left", key(Key::ArrowLeft), "Moving"),
    entry(Action::Pan(1, 0), "Move right", key(Key::ArrowRight), "Moving"),
    entry(Action::Pan(0, 1), "Move up", key(Key::ArrowUp), "Moving"),
    entry(Action::Pan(0, -1), "Move down", key(Key::ArrowDown), "Moving"),
    entry(Action::Back, "Back to the view before", key(Key::Backspace), "Moving"),
    entry(Action::Forward, "Forward to the view after", shift(Key::Backspace), "Moving"),
    entry(Action::Quantity, "Choose a quantity", key(Key::Q), "Colours"),
    entry(Action::NextScale, "Linear, logarithmic, symlog", key(Key::L), "Colours"),
    entry(Action::AutomaticRange, "Automatic range", key(Key::R), "Colours"),
    entry(Action::NextMap, "Next colour map", key(Key::M), "Colours"),
    entry(Action::ReverseMap, "Reverse the colour map", shift(Key::M), "Colours"),
    entry(Action::FreezeRange, "Freeze the range", shift(Key::R), "Colours"),
    entry(Action::Overlays, "All overlays", key(Key::O), "Over the picture"),
    entry(Action::Isolines, "Isolines", key(Key::I), "Over the picture"),
    entry(Action::Deform, "Deformed plate", key(Key::D), "Over the picture"),
    entry(Action::Swing, "Play the deformation", shift(Key::D), "Over the picture"),
    entry(Action::Mirror, "Whole of a half or quarter model", None, "Over the picture"),
    entry(Action::Compare, "Direct against resampled", key(Key::C), "Over the picture"),
    entry(Action::Probe, "Pin a probe at the pointer", key(Key::P), "Reading"),
    entry(Action::CircleForK, "Circle around the nearest tip, for K", key(Key::K), "Reading"),
    entry(Action::Draw(Tool::Probe), "Pin probes by clicks, or stop that", None, "Reading"),
    entry(Action::Draw(Tool::Line), "Draw a line (or drag with Shift)", None, "Reading"),
    entry(Action::Draw(Tool::Circle), "Draw a circle (or drag with Ctrl)", None, "Reading"),
    entry(Action::Draw(Tool::Ray), "Draw a ray from a tip", None, "Reading"),
    entry(Action::Draw(Tool::Crack), "Choose a crack by a click", None, "Reading"),
    entry(Action::Extrema, "Mark the extrema of the view", None, "Reading"),
    entry(
        Action::Drawer(DrawerPage::Plot),
        "Plot along a curve, or opening of a crack",
        key(Key::X),
        "Reading",
    ),
    entry(Action::Drawer(DrawerPage::Tips), "Table of the tips", key(Key::T), "Reading"),
    entry(Action::Drawer(DrawerPage::Series), "Values over the steps", None, "Reading"),
    entry(Action::Drawer(DrawerPage::Solver), "The solver's report", None, "Reading"),
    entry(Action::Drawer(DrawerPage::Problem), "The problem's text", None, "Reading"),
    entry(Action::Save(ExportChoice::Picture), "Save an image", key(Key::S), "Reading"),
    entry(Action::Save(ExportChoice::Figure), "Save a figure", shift(Key::S), "Reading"),
    entry(Action::Save(ExportChoice::Steps), "Save an animation of the steps", None, "Reading"),
    entry(
        Action::Save(ExportChoice::Deformation),
        "Save an animation of the deformation",
        None,
        "Reading",
    ),
    entry(
        Action::CopyCommand,
        "Copy the command that draws this",
        control_shift(Key::C),
        "Reading",
    ),
    entry(Action::Step(-1), "Step before", key(Key::OpenBracket), "Reading"),
    entry(Action::Step(1), "Step after", key(Key::CloseBracket), "Reading"),
    entry(Action::Play, "Play the steps, or stop", key(Key::Space), "Reading"),
    entry(Action::Open, "Open a file", control(Key::O), "Files and problems"),
    entry(Action::OpenBeside, "Open a file beside", control_shift(Key::O), "Files and problems"),
    entry(Action::Close, "Close the dataset", control(Key::W), "Files and problems"),
    entry(Action::SaveSession, "Save the session", control(Key::S), "Files and problems"),
    entry(
        Action::SaveSessionAs,
        "Save the session as another file",
        control_shift(Key::S),
        "Files and problems",
    ),
    entry(Action::SaveDataset, "Save the dataset", None, "Files and problems"),
    entry(Action::ExportPage, "Export a page for browsers", None, "Files and problems"),
    entry(Action::Solve, "Solve the problem", control(Key::Enter), "Files and problems"),
    entry(Action::CancelSolving, "Cancel the solution", None, "Files and problems"),
    entry(Action::SaveProblem, "Save the problem's text", None, "Files and problems"),
    entry(
        Action::SaveProblemAs,
        "Save the problem's text as another file",
        None,
        "Files and problems",
    ),
    entry(Action::CloseProblem, "Close the problem's text", None, "Files and problems"),
    entry(Action::Split, "Two views side by side", key(Key::V), "Window"),
    entry(Action::Minus, "Difference of the two views", shift(Key::V), "Window"),
    entry(Action::Undo, "Undo", control(Key::Z), "Window"),
    entry(Action::Redo, "Redo", control_shift(Key::Z), "Window"),
    entry(Action::Panels, "Show or hide the panels", key(Key::Tab), "Window"),
    entry(Action::Theme, "Light or dark", None, "Window"),
    entry(Action::Interface(1), "Enlarge the interface", control(Key::Plus), "Window"),
    entry(Action::Interface(-1), "Reduce the interface", control(Key::Minus), "Window"),
    entry(Action::Interface(0), "Interface in its usual size", control(Key::Num0), "Window"),
    entry(Action::Help, "Keys", key(Key::H), "Window"),
    entry(Action::Palette, "Find an action", control(Key::K), "Window"),
    entry(Action::Quit, "Quit", control(Key::Q), "Window"),
];

/// The gestures of the mouse, and keys that are no actions: what is done by hand, what comes of it,
/// and the heading that it stands below on the help sheet.
pub const GESTURES: &[(&str, &str, &str)] = &[
    ("Drag", "Move the plate", "Moving"),
    ("Wheel", "Zoom at the pointer", "Moving"),
    ("Double click", "Show the whole plate", "Moving"),
    ("Drag the bar", "Move the range, or an end of it", "Colours"),
    ("Wheel on it", "Widen or narrow the range", "Colours"),
    ("Click its end", "Write the end of the range", "Colours"),
    ("Double click it", "Automatic range", "Colours"),
    ("Click", "Select a probe; with Probe pin one", "Reading"),
    ("Shift+Drag", "Draw a line, and plot along it", "Reading"),
    ("Ctrl+Drag", "Draw a circle, at a tip around it", "Reading"),
    ("Shift", "Read exactly at the pointer", "Reading"),
    ("Ctrl+C", "Copy what is read, with all digits", "Reading"),
    ("Escape", "Close what is open, leave a tool", "Window"),
    ("Shift+Tab", "Move between buttons and fields", "Window"),
];

/// A shortcut as people write it: with the signs of keys that have one.
#[must_use]
pub fn spelled(ctx: &egui::Context, key: &KeyboardShortcut) -> String {
    const SIGNS: [(&str, &str); 4] =
        [("OpenBracket", "["), ("CloseBracket", "]"), ("Plus", "+"), ("Minus", "−")];
    let text = ctx.format_shortcut(key);
    let found = SIGNS.iter().find_map(|(name, sign)| Some((text.strip_suffix(name)?, sign)));
    found.map_or_else(|| text.clone(), |(modifiers, sign)| format!("{modifiers}{sign}"))
}

/// Takes Tab, which shows and hides the panels, before it moves the focus of the keyboard; whoever
/// writes, or walks through widgets, has it.
#[derive(Default)]
pub(crate) struct Tab {
    is_pressed: bool,
}

impl egui::Plugin for Tab {
    fn debug_name(&self) -> &'static str {
        "Tab"
    }

    fn input_hook(&mut self, ctx: &egui::Context, input: &mut RawInput) {
        if ctx.memory(|memory| memory.focused().is_some()) {
            return;
        }
        let is_tab = |event: &Event| matches!(event, Event::Key { key: Key::Tab, modifiers, .. } if !modifiers.any());
        let is_press = |event: &Event| matches!(event, Event::Key { pressed: true, .. });
        self.is_pressed |= input.events.iter().any(|event| is_tab(event) && is_press(event));
        input.events.retain(|event| !is_tab(event));
    }
}

/// The actions whose keys were pressed, unless someone writes or chooses from a list.
pub fn pressed(ctx: &egui::Context) -> Vec<Action> {
    let mut all = by_shortcuts(ctx);
    let tab = ctx.with_plugin(|tab: &mut Tab| std::mem::take(&mut tab.is_pressed));
    all.extend(tab.filter(|is_pressed| *is_pressed).map(|_| Action::Panels));
    all
}

fn by_shortcuts(ctx: &egui::Context) -> Vec<Action> {
    let is_writing = ctx.egui_wants_keyboard_input() || egui::Popup::is_any_open(ctx);
    let mut all: Vec<&ActionEntry> = ALL.iter().collect();
    // the more keys of a shortcut, the sooner it is asked, so that Ctrl+Z does not
    // take Ctrl+Shift+Z
    all.sort_by_key(|entry| {
        entry.key.map_or(0, |k| -i32::from(k.modifiers.shift) - i32::from(k.modifiers.command))
    });
    ctx.input_mut(|input| {
        let is_pressed = |entry: &&&ActionEntry| {
            let Some(key) = entry.key.filter(|_| entry.action != Action::Panels) else {
                return false;
            };
            // a text takes back its own changes
            let is_of_texts = matches!(entry.action, Action::Undo | Action::Redo);
            let is_free = !is_writing || (key.modifiers.command && !is_of_texts);
            is_free && input.consume_shortcut(&key)
        };
        all.iter().filter(is_pressed).map(|entry| entry.action).collect()
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn no_key_has_two_meanings_and_no_two_actions_one_name() {
        let keys: Vec<String> =
            ALL.iter().filter_map(|entry| entry.key).map(|key| format!("{key:?}")).collect();
        assert_eq!(keys.iter().collect::<BTreeSet<_>>().len(), keys.len());
        let names: BTreeSet<_> = ALL.iter().map(|entry| entry.name).collect();
        assert_eq!(names.len(), ALL.len());
    }

    #[test]
    fn every_action_stands_below_a_heading() {
        assert!(ALL.iter().all(|entry| GROUPS.contains(&entry.group)));
    }
}
