//! Actions of the user, by a key, a menu or the palette: one list for all three, and for the help
//! sheet.

use egui::{Event, Key, KeyboardShortcut, Modifiers, RawInput};

use self::Action::*;
use self::Need::*;
use crate::export::ExportChoice;
use crate::measure::tool::Tool;
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
    /// Choose a drawing and make a problem of it.
    Import,
    /// Begin the text of a problem.
    NewProblem,
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
    /// Two views at the same place, or each at its own.
    Link,
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

/// The need of an action, without which it does nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// Nothing.
    Nothing,
    /// A dataset in the active view.
    Dataset,
    /// A crack tip of the step.
    Tips,
    /// More steps than one.
    Series,
    /// Displacements.
    Displacements,
    /// Two views that may show different places.
    FreeViews,
    /// The text of a problem.
    Text,
    /// A solution that is being computed.
    Solution,
}

/// An action with its key, its name, and other words that people look for it by.
#[derive(Clone, Copy, Debug)]
pub struct ActionEntry {
    /// The action.
    pub action: Action,
    /// Its key as [`shortcut`](Self::shortcut) reads it; empty if it has none.
    key: &'static str,
    /// Its name in menus and the palette.
    pub name: &'static str,
    /// Its need.
    pub need: Need,
    /// Other words for it.
    pub synonyms: &'static str,
}

const fn row(
    action: Action,
    key: &'static str,
    name: &'static str,
    need: Need,
    synonyms: &'static str,
) -> ActionEntry {
    ActionEntry { action, key, name, need, synonyms }
}

impl ActionEntry {
    /// Its key, if it has one: a name of egui's after `Ctrl+` and `Shift+`.
    #[must_use]
    pub fn shortcut(&self) -> Option<KeyboardShortcut> {
        let (rest, control) =
            self.key.strip_prefix("Ctrl+").map_or((self.key, false), |k| (k, true));
        let (rest, shift) = rest.strip_prefix("Shift+").map_or((rest, false), |k| (k, true));
        let mut modifiers = if control { Modifiers::COMMAND } else { Modifiers::NONE };
        modifiers.shift = shift;
        Some(KeyboardShortcut::new(modifiers, Key::from_name(rest)?))
    }
}

/// All actions below their headings, in the order of the help sheet. The keys for the interface's
/// size are egui's own.
#[rustfmt::skip]
pub const GROUPS: &[(&str, &[ActionEntry])] = &[
    ("Moving", &[
        row(Fit, "F", "Show the whole plate", Dataset, "home reset fit zoom all"),
        row(NextTip, "N", "Fly to the next tip", Tips, "go to zoom crack"),
        row(Tip(0), "1", "Fly to tip 0", Tips, "go to zoom crack"),
        row(Tip(1), "2", "Fly to tip 1", Tips, "go to zoom crack"),
        row(Tip(2), "3", "Fly to tip 2", Tips, "go to zoom crack"),
        row(Tip(3), "4", "Fly to tip 3", Tips, "go to zoom crack"),
        row(Tip(4), "5", "Fly to tip 4", Tips, "go to zoom crack"),
        row(Tip(5), "6", "Fly to tip 5", Tips, "go to zoom crack"),
        row(Tip(6), "7", "Fly to tip 6", Tips, "go to zoom crack"),
        row(Tip(7), "8", "Fly to tip 7", Tips, "go to zoom crack"),
        row(Tip(8), "9", "Fly to tip 8", Tips, "go to zoom crack"),
        row(ZoomIn, "Plus", "Zoom in", Dataset, "enlarge magnify larger"),
        row(ZoomOut, "Minus", "Zoom out", Dataset, "reduce smaller"),
        row(Pan(-1, 0), "Left", "Move left", Dataset, ""),
        row(Pan(1, 0), "Right", "Move right", Dataset, ""),
        row(Pan(0, 1), "Up", "Move up", Dataset, ""),
        row(Pan(0, -1), "Down", "Move down", Dataset, ""),
        row(Back, "Backspace", "Back to the view before", Dataset, ""),
        row(Forward, "Shift+Backspace", "Forward to the view after", Dataset, ""),
    ]),
    ("Colours", &[
        row(Quantity, "Q", "Choose a quantity", Dataset,
            "variable stress strain displacement von mises formula error field component"),
        row(NextScale, "L", "Linear, logarithmic, symlog", Dataset, "log scale"),
        row(AutomaticRange, "R", "Automatic range", Dataset, "limits minimum maximum clim"),
        row(NextMap, "M", "Next colour map", Dataset, "colormap cmap palette colour bar"),
        row(ReverseMap, "Shift+M", "Reverse the colour map", Dataset,
            "colormap cmap palette colour bar"),
        row(FreezeRange, "Shift+R", "Freeze the range", Dataset, "limits minimum maximum clim"),
    ]),
    ("Over the image", &[
        row(Overlays, "O", "All overlays", Dataset,
            "mesh cells patches cracks outline elements grid"),
        row(Isolines, "I", "Isolines", Dataset, "contour level lines"),
        row(Deform, "D", "Deformed plate", Displacements, "deformation warp displacement opening"),
        row(Swing, "Shift+D", "Play the deformation", Displacements, "animate warp movie"),
        row(Mirror, "", "Whole of a half or quarter model", Dataset, "mirror symmetry reflect"),
        row(Compare, "C", "Direct against resampled", Dataset, "interpolation error sampling"),
    ]),
    ("Reading", &[
        row(Probe, "P", "Pin a probe at the pointer", Dataset, "value pick point query marker"),
        row(CircleForK, "K", "Circle around the nearest tip, for K", Tips,
            "sif stress intensity factor k1 k2 j integral energy release"),
        row(Draw(Tool::Probe), "", "Pin probes by clicks, or stop that", Dataset,
            "value pick point query marker"),
        row(Draw(Tool::Line), "", "Draw a line (or drag with Shift)", Dataset,
            "profile path section cut"),
        row(Draw(Tool::Circle), "", "Draw a circle (or drag with Ctrl)", Dataset,
            "profile path section cut"),
        row(Draw(Tool::Ray), "", "Draw a ray from a tip", Tips, "profile path section cut"),
        row(Draw(Tool::Crack), "", "Choose a crack by a click", Dataset,
            "profile path section cut"),
        row(Extrema, "", "Mark the extrema of the view", Dataset, "minimum maximum peak"),
        row(Drawer(DrawerPage::Plot), "X", "Plot along a curve, or opening of a crack", Dataset,
            "profile line graph chart sliding jump path csv"),
        row(Drawer(DrawerPage::Tips), "T", "Table of the tips", Dataset,
            "sif stress intensity factors k1 k2 t g energy release error"),
        row(Drawer(DrawerPage::Series), "", "Values over the steps", Series,
            "history steps growth k over time"),
        row(Drawer(DrawerPage::Solver), "", "The solver's report", Dataset,
            "error estimate warnings convergence unknowns condition contact closed faces"),
        row(Drawer(DrawerPage::Problem), "", "The problem's text", Nothing,
            "toml input edit loads material mesh cover contact friction boundary conditions"),
        row(Save(ExportChoice::Image), "S", "Save an image", Dataset,
            "export image png screenshot"),
        row(Save(ExportChoice::Figure), "Shift+S", "Save a figure", Dataset,
            "export pdf svg png paper print image"),
        row(Save(ExportChoice::Steps), "", "Save an animation of the steps", Series,
            "export gif movie film video apng"),
        row(Save(ExportChoice::Deformation), "", "Save an animation of the deformation",
            Displacements, "export gif movie film video apng"),
        row(CopyCommand, "Ctrl+Shift+C", "Copy the command that draws this", Dataset,
            "export script shell"),
        row(Step(-1), "OpenBracket", "Step before", Series, "time animation movie film"),
        row(Step(1), "CloseBracket", "Step after", Series, "time animation movie film"),
        row(Play, "Space", "Play the steps, or stop", Series, "time animation movie film"),
    ]),
    ("Files and problems", &[
        row(Open, "Ctrl+O", "Open a file", Nothing, "load import file"),
        row(OpenBeside, "Ctrl+Shift+O", "Open a file beside", Dataset, "load import file"),
        row(NewProblem, "", "New problem", Nothing, "create begin template toml"),
        row(Import, "", "Import a drawing", Nothing, "dxf svg gmsh msh geo cad outline mesh"),
        row(Close, "Ctrl+W", "Close the dataset", Dataset, ""),
        row(SaveSession, "Ctrl+S", "Save the session", Nothing, ""),
        row(SaveSessionAs, "Ctrl+Shift+S", "Save the session as another file", Nothing, ""),
        row(SaveDataset, "", "Save the dataset", Dataset, "export h5 hdf5 result"),
        row(ExportPage, "", "Export a page for browsers", Dataset, "save html web internet share"),
        row(Solve, "Ctrl+Enter", "Solve the problem", Text, "run compute calculate"),
        row(CancelSolving, "", "Cancel the solution", Solution, "stop abort"),
        row(SaveProblem, "", "Save the problem's text", Text, ""),
        row(SaveProblemAs, "", "Save the problem's text as another file", Text, ""),
        row(CloseProblem, "", "Close the problem's text", Text, ""),
    ]),
    ("Window", &[
        row(Split, "V", "Two views side by side", Dataset, "compare side window"),
        row(Link, "", "Link the two views, or unlink them", FreeViews,
            "synchronize together camera same place compare"),
        row(Minus, "Shift+V", "Difference of the two views", Dataset, "compare subtract error"),
        row(Undo, "Ctrl+Z", "Undo", Nothing, ""),
        row(Redo, "Ctrl+Shift+Z", "Redo", Nothing, ""),
        row(Panels, "Tab", "Show or hide the panels", Nothing, "sidebar controls full screen"),
        row(Theme, "", "Light or dark", Nothing, "theme dark mode appearance colours"),
        row(Interface(1), "Ctrl+Plus", "Enlarge the interface", Nothing, SCALE),
        row(Interface(-1), "Ctrl+Minus", "Reduce the interface", Nothing, SCALE),
        row(Interface(0), "Ctrl+0", "Interface in its usual size", Nothing, SCALE),
        row(Help, "H", "Keys", Nothing, "shortcuts keyboard manual font"),
        row(Palette, "Ctrl+K", "Find an action", Nothing, "search command"),
        row(Quit, "Ctrl+Q", "Quit", Nothing, "exit leave close window"),
    ]),
];

const SCALE: &str = "zoom scale font size letters larger smaller interface";

/// All actions, in the order of the help sheet.
pub fn all() -> impl Iterator<Item = &'static ActionEntry> + Clone {
    GROUPS.iter().flat_map(|(_, entries)| *entries)
}

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
pub(crate) fn spelled(ctx: &egui::Context, key: &KeyboardShortcut) -> String {
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

/// Keeps keys that come within one frame in their order: what is typed behind the key of a list or
/// a dialog waits until that has the keyboard, and Enter until the text before it is written.
#[derive(Default)]
pub(crate) struct KeyOrder {
    held: Vec<Event>,
    /// Frames to wait at most until something has the keyboard.
    frames: u8,
    /// True in the frame after Enter, when what was written in may be closed.
    is_pausing: bool,
}

impl egui::Plugin for KeyOrder {
    fn debug_name(&self) -> &'static str {
        "Key order"
    }

    fn input_hook(&mut self, ctx: &egui::Context, input: &mut RawInput) {
        let is_typed = |event: &mut Event| matches!(event, Event::Key { .. } | Event::Text(_));
        let mut typed = std::mem::take(&mut self.held);
        typed.extend(input.events.extract_if(.., is_typed));
        let is_writing = ctx.memory(|memory| memory.focused().is_some());
        let count = match is_writing {
            _ if std::mem::take(&mut self.is_pausing) => 0,
            true => first_entry(&typed),
            false if self.frames > 0 => 0,
            false => first_opening(&typed),
        };
        self.frames = self.frames.saturating_sub(1);
        self.held = typed.split_off(count);
        if !self.held.is_empty() {
            self.is_pausing = is_writing && typed.iter().any(|event| ending(event).is_some());
            if !is_writing && count > 0 {
                // the letter of the key itself is not for the text
                let is_letter = matches!(self.held[0], Event::Text(_));
                self.held.drain(..usize::from(is_letter));
                self.frames = PATIENCE;
            }
            ctx.request_repaint();
        }
        input.events.append(&mut typed);
    }
}

/// Frames after which a list or a dialog has the keyboard, or will not have it.
const PATIENCE: u8 = 4;

/// The number of events until Enter or another key that ends what is written; that key alone if it
/// comes first.
fn first_entry(typed: &[Event]) -> usize {
    match typed.iter().position(|event| ending(event).is_some()) {
        Some(0) => typed.iter().take_while(|event| ending(event) == ending(&typed[0])).count(),
        Some(number) => number,
        None => typed.len(),
    }
}

/// The key of an event if it ends what is written.
fn ending(event: &Event) -> Option<Key> {
    match event {
        Event::Key { key, .. } if ENDS.contains(key) => Some(*key),
        _ => None,
    }
}

const ENDS: [Key; 5] = [Key::Enter, Key::Escape, Key::Tab, Key::ArrowDown, Key::ArrowUp];

/// The number of events up to the first key of an action that opens a list or a dialog.
fn first_opening(typed: &[Event]) -> usize {
    let opens = |event: &Event| match event {
        Event::Key { key, pressed: true, modifiers, .. } => all().any(|entry| {
            let is_this = |shortcut: KeyboardShortcut| {
                shortcut.logical_key == *key && modifiers.matches_logically(shortcut.modifiers)
            };
            entry.action.opens_text() && entry.shortcut().is_some_and(is_this)
        }),
        _ => false,
    };
    typed.iter().position(opens).map_or(typed.len(), |number| number + 1)
}

impl Action {
    /// True if it opens something that is written in.
    fn opens_text(self) -> bool {
        matches!(self, Quantity | Palette | Open | OpenBeside | SaveSession | SaveSessionAs)
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
    let mut keys: Vec<_> =
        all().filter_map(|entry| Some((entry.shortcut()?, entry.action))).collect();
    // the more keys of a shortcut, the sooner it is asked, so that Ctrl+Z does not
    // take Ctrl+Shift+Z
    keys.sort_by_key(|(key, _)| -i32::from(key.modifiers.shift) - i32::from(key.modifiers.command));
    ctx.input_mut(|input| {
        let is_pressed = |(key, action): &(KeyboardShortcut, Action)| {
            // a text takes back its own changes
            let is_of_texts = matches!(action, Undo | Redo);
            let is_free = !is_writing || (key.modifiers.command && !is_of_texts);
            *action != Panels && is_free && input.consume_shortcut(key)
        };
        keys.into_iter().filter(is_pressed).map(|(_, action)| action).collect()
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn no_key_has_two_meanings_and_no_two_actions_one_name() {
        let keys: Vec<String> =
            all().filter_map(ActionEntry::shortcut).map(|key| format!("{key:?}")).collect();
        assert_eq!(keys.iter().collect::<BTreeSet<_>>().len(), keys.len());
        let names: BTreeSet<_> = all().map(|entry| entry.name).collect();
        assert_eq!(names.len(), all().count());
    }

    /// A key that is misspelt would do nothing.
    #[test]
    fn every_key_and_gesture_is_understood() {
        assert!(all().all(|entry| entry.key.is_empty() == entry.shortcut().is_none()));
        let has_heading = |group: &&str| GROUPS.iter().any(|(heading, _)| heading == group);
        assert!(GESTURES.iter().all(|(.., group)| has_heading(group)));
    }
}
