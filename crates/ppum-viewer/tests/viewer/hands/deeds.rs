//! What hands do.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, MouseWheelUnit, PointerButton, Pos2, TouchPhase, Vec2, vec2};
use egui_kittest::kittest::NodeT as _;
use ppum_viewer::actions::{Action, ActionEntry, all};
use ppum_viewer::window::WindowStart;

use super::Hands;

type Deed = fn(&mut Hands);

/// All of it, with names; what stands here twice is done twice as often.
pub(super) const ALL: &[(&str, Deed)] = &[
    ("click", Hands::click),
    ("click", Hands::click),
    ("click a name", Hands::click_name),
    ("click a name", Hands::click_name),
    ("click a name", Hands::click_name),
    ("click a name", Hands::click_name),
    ("fill a field", Hands::fill),
    ("fill a field", Hands::fill),
    ("drag", Hands::drag),
    ("drag", Hands::drag),
    ("shortcut", Hands::shortcut),
    ("shortcut", Hands::shortcut),
    ("key", Hands::key),
    ("find an action", Hands::find),
    ("find an action", Hands::find),
    ("wheel", Hands::wheel),
    ("wheel", Hands::wheel),
    ("write", Hands::write),
    ("resize", Hands::resize),
    ("swap", Hands::swap),
    ("drop", Hands::drop),
    ("hover", Hands::hover),
    ("wait", Hands::wait),
    ("wait", Hands::wait),
    ("escape", Hands::escape),
    ("escape", Hands::escape),
    ("leave", Hands::leave),
];

/// What is written into fields.
const WORDS: [&str; 34] = [
    "ux",
    "sqrt(ux^2 + uy^2)",
    "1/0",
    "von-mises",
    "(",
    "patch:level",
    "-1e300",
    "0.5,",
    "syy*x",
    "∞",
    "1e-12",
    "auto",
    "0",
    "nan",
    "1e-320",
    "level",
    "0.1, 0.2",
    "0, 0, 1e9, -1e9",
    "0.25 + 1e-13",
    "phi:3",
    "r^2*sin(theta)",
    "(1 - t)^3",
    "漢字 🔥 \u{202e}right to left",
    "e\u{301}\u{301}\u{301}\u{200b}\u{feff}",
    "a\nb\tc\r\nd",
    "\u{0}\u{7}",
    "level = 2\n",
    "crack",
    "tip",
    "1,2,3,4,5,6,7,8,9,10,11,12",
    "9999999999999999999",
    "-",
    " ",
    "γ²",
];

/// Names that are left alone: the dialog of the system.
const LEFT: [&str; 1] = ["Browse…"];

impl Hands {
    fn button(&mut self, at: Pos2, button: PointerButton, modifiers: Modifiers) {
        let event = |pressed| Event::PointerButton { pos: at, button, pressed, modifiers };
        self.send([Event::PointerMoved(at), event(true), event(false)]);
    }

    fn click(&mut self) {
        let (count, at) = (1 + usize::from(self.random.below(6) == 0), self.at);
        let all = [PointerButton::Primary, PointerButton::Secondary, PointerButton::Middle];
        let button = if self.random.below(8) == 0 { self.random.pick(&all) } else { all[0] };
        (0..count).for_each(|_| self.button(at, button, Modifiers::NONE));
    }

    /// The middle of something that has one of these roles, any if there are none of these.
    fn named(&mut self, roles: &[Role]) -> Option<(String, Pos2)> {
        let size = self.lab.window.ctx.content_rect();
        let root = self.lab.window.root();
        let all = root.children_recursive().filter_map(|node| {
            let (role, name) = (node.accesskit_node().role(), node.accesskit_node().label());
            let is_meant = roles.is_empty() || roles.contains(&role);
            let at = node.accesskit_node().bounding_box().map(|_| node.rect().center())?;
            let name = name.unwrap_or_default();
            let is_left = LEFT.contains(&name.as_str());
            (is_meant && size.contains(at) && !is_left).then_some((name, at))
        });
        let all: Vec<_> = all.collect();
        (!all.is_empty()).then(|| all[self.random.below(all.len())].clone())
    }

    fn click_name(&mut self) {
        let some = [
            Role::Button,
            Role::CheckBox,
            Role::RadioButton,
            Role::ComboBox,
            Role::Link,
            Role::MenuItem,
        ];
        let roles = if self.random.below(4) == 0 { &[][..] } else { &some };
        if let Some((name, at)) = self.named(roles) {
            self.doing = format!("click {name:?}");
            self.button(at, PointerButton::Primary, Modifiers::NONE);
        }
    }

    /// Writes into a field, over what was there or behind it, and finishes it in some way.
    fn fill(&mut self) {
        let roles = [Role::TextInput, Role::MultilineTextInput, Role::SpinButton];
        let Some((name, at)) = self.named(&roles) else { return };
        self.doing = format!("fill {name:?}");
        self.button(at, PointerButton::Primary, Modifiers::NONE);
        if self.random.below(3) > 0 {
            self.press(Modifiers::COMMAND, Key::A);
        }
        self.write();
        let end = self.random.pick(&[Key::Enter, Key::Tab, Key::Escape, Key::ArrowDown]);
        if self.random.below(3) > 0 {
            self.press(Modifiers::NONE, end);
        }
    }

    fn write(&mut self) {
        let word = self.random.pick(&WORDS);
        let event = match self.random.below(8) {
            0 => Event::Paste(word.repeat(200)),
            1 => Event::Paste(word.to_owned()),
            2 => Event::Cut,
            3 => Event::Copy,
            _ => Event::Text(word.to_owned()),
        };
        self.send([event]);
    }

    fn drag(&mut self) {
        let (from, all) = (self.at, [Modifiers::SHIFT, Modifiers::COMMAND, Modifiers::ALT]);
        let held = if self.random.below(3) == 0 { self.random.pick(&all) } else { Modifiers::NONE };
        let event = |pos, pressed| Event::PointerButton {
            pos,
            pressed,
            button: PointerButton::Primary,
            modifiers: held,
        };
        self.send([Event::ModifiersChanged(held), Event::PointerMoved(from), event(from, true)]);
        for _ in 0..self.random.below(5) {
            let to = self.somewhere();
            self.send([Event::PointerMoved(to)]);
        }
        // beyond the window, too
        let beyond = self.random.pick(&[1.0, 1.0, 2.0, -1.0]);
        let to = (self.somewhere().to_vec2() * beyond).to_pos2();
        self.send([event(to, false), Event::ModifiersChanged(Modifiers::NONE)]);
    }

    fn press(&mut self, modifiers: Modifiers, key: Key) {
        let event =
            |pressed| Event::Key { key, pressed, modifiers, repeat: false, physical_key: None };
        let free = Event::ModifiersChanged(Modifiers::NONE);
        self.send([Event::ModifiersChanged(modifiers), event(true), event(false), free]);
    }

    fn shortcut(&mut self) {
        let keys: Vec<_> = all().filter_map(ActionEntry::shortcut).collect();
        let shortcut = self.random.pick(&keys);
        self.doing = format!("press {shortcut:?}");
        self.press(shortcut.modifiers, shortcut.logical_key);
    }

    fn key(&mut self) {
        let plain = [
            Key::Enter,
            Key::Tab,
            Key::ArrowDown,
            Key::ArrowUp,
            Key::ArrowLeft,
            Key::Delete,
            Key::Backspace,
            Key::Home,
            Key::End,
            Key::PageDown,
            Key::Space,
            Key::F5,
        ];
        let all = [Modifiers::NONE, Modifiers::NONE, Modifiers::SHIFT, Modifiers::COMMAND];
        let (key, modifiers) = (self.random.pick(&plain), self.random.pick(&all));
        self.doing = format!("press {modifiers:?} {key:?}");
        self.press(modifiers, key);
    }

    /// Finds an action in the palette by its name.
    fn find(&mut self) {
        let entry = self.random.pick(&all().collect::<Vec<_>>());
        if entry.action == Action::Quit {
            return;
        }
        self.doing = format!("find {:?}", entry.name);
        self.escape();
        self.press(Modifiers::COMMAND, Key::K);
        self.send([Event::Text(entry.name.to_owned())]);
        self.press(Modifiers::NONE, Key::Enter);
    }

    fn wheel(&mut self) {
        self.send([Event::PointerMoved(self.at)]);
        let most = self.random.pick(&[3.0, 20.0, 20.0, 1e4]);
        let turns = |random: &mut ppum_testkit::random::Random| random.between(-most, most) as f32;
        let [x, y] = [turns(&mut self.random), turns(&mut self.random)];
        let delta: Vec2 = if self.random.below(4) == 0 { vec2(x, y) } else { vec2(0.0, y) };
        let all = [
            MouseWheelUnit::Line,
            MouseWheelUnit::Line,
            MouseWheelUnit::Point,
            MouseWheelUnit::Page,
        ];
        let (unit, phase) = (self.random.pick(&all), TouchPhase::Move);
        let all = [Modifiers::NONE, Modifiers::NONE, Modifiers::COMMAND, Modifiers::SHIFT];
        let (modifiers, source) = (self.random.pick(&all), egui::MouseWheelSource::Wheel);
        let wheel = Event::MouseWheel { unit, delta, modifiers, phase, source };
        let pinch = Event::Zoom(self.random.pick(&[0.5, 1.1, 2.0, 1e-6, 1e6]));
        let event = if self.random.below(4) == 0 { pinch } else { wheel };
        self.send([event]);
        // wheels turn on for a while
        (0..4).for_each(|_| self.show());
    }

    fn resize(&mut self) {
        let all = [
            [1.0, 1.0],
            [1.0, 500.0],
            [900.0, 2.0],
            [3840.0, 2160.0],
            [700.0, 500.0],
            [1280.0, 800.0],
        ];
        let [width, height] = match self.random.below(3) {
            0 => self.random.pick(&all),
            _ => [self.random.between(320.0, 1400.0), self.random.between(240.0, 900.0)],
        };
        self.lab.window.set_size(vec2(width as f32, height as f32));
        let all = [0.5, 0.75, 1.0, 1.0, 1.25, 1.5, 2.0, 3.0];
        // a large window has few points per pixel: not to wait for its pictures
        let scale = if width > 2000.0 { 1.0 } else { self.random.pick(&all) };
        self.lab.window.set_pixels_per_point(scale);
        self.doing = format!("resize to {width:.0}×{height:.0} at {scale}");
    }

    /// Opens another file; or writes over one that is open, or takes it away.
    fn swap(&mut self) {
        let path = self.files[self.random.below(self.files.len())].clone();
        let pane = self.random.below(2);
        let ctx = self.lab.window.ctx.clone();
        let is_dataset = path.extension().is_some_and(|end| end == "h5");
        match self.random.below(6) {
            0 if is_dataset => drop(std::fs::copy(&self.files[1], &path)),
            1 if is_dataset && path != self.files[1] => drop(std::fs::remove_file(&path)),
            _ => {
                self.doing = format!("open {} on {pane}", path.display());
                self.lab.state().open_file(&ctx, &path, pane);
            }
        }
    }

    /// Files that are dragged over the window, and dropped.
    fn drop(&mut self) {
        let count = 1 + self.random.below(3);
        let paths: Vec<PathBuf> =
            (0..count).map(|_| self.files[self.random.below(self.files.len())].clone()).collect();
        let hovered = egui::HoveredFile { path: Some(paths[0].clone()), ..Default::default() };
        self.lab.window.input_mut().hovered_files = vec![hovered];
        self.show();
        self.lab.window.input_mut().hovered_files.clear();
        let handle = |path: PathBuf| Arc::new(Dropped(path)) as egui::DroppedFileHandle;
        self.doing = format!("drop {paths:?}");
        self.lab.window.input_mut().dropped_files = paths.into_iter().map(handle).collect();
        self.show();
        self.lab.window.input_mut().dropped_files.clear();
    }

    fn hover(&mut self) {
        for _ in 0..1 + self.random.below(8) {
            let at = self.somewhere();
            self.send([Event::PointerMoved(at)]);
        }
        let gone = [Event::PointerGone, Event::WindowFocused(false), Event::WindowFocused(true)];
        if self.random.below(4) == 0 {
            self.send(gone);
        }
    }

    /// Waits until there is a picture, but not for ever: a solution may take minutes.
    fn wait(&mut self) {
        for _ in 0..80 {
            if !self.lab.viewer().is_working() {
                return;
            }
            std::thread::sleep(Duration::from_millis(5));
            self.show();
        }
    }

    fn escape(&mut self) {
        for _ in 0..3 {
            self.press(Modifiers::NONE, Key::Escape);
        }
    }

    /// Closes the window now and then, and opens it again on what it remembers.
    fn leave(&mut self) {
        if self.random.below(4) > 0 {
            return;
        }
        self.lab.begin_again(WindowStart::default());
        self.eyes.forget();
    }
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("it is read by its path".into())
    }
}
