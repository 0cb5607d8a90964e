//! Hands that do anything: clicks, drags, keys, words, wheels, other sizes, other files,
//! all seeded.
//!
//! `PPUM_HANDS` says how many things they do, `PPUM_HANDS_MINUTES` for how long at most,
//! `PPUM_HANDS_SEED` whose hands they are. Memory is compared in runs of some thousand deeds.

mod deeds;
mod eyes;
mod files;
mod heavy;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use egui::{Event, Key, Modifiers, PointerButton, Pos2, pos2, vec2};
use egui_kittest::kittest::Queryable as _;
use ppum_testkit::random::Random;
use ppum_viewer::actions::Action;

use crate::kit::plate;
use crate::lab::Lab;
use eyes::Eyes;

pub(crate) struct Hands {
    lab: Lab,
    random: Random,
    files: Vec<PathBuf>,
    at: Pos2,
    eyes: Eyes,
    /// What is being done, and how often each thing was done.
    doing: String,
    done: BTreeMap<String, usize>,
}

impl Hands {
    fn new(seed: u64) -> Self {
        // names that hands write without a folder
        let here = Path::new(env!("CARGO_TARGET_TMPDIR")).join("hands");
        std::fs::create_dir_all(&here)
            .and_then(|()| std::env::set_current_dir(&here))
            .expect("a folder");
        let mut lab = Lab::new();
        let files = files::written(&lab, seed);
        let first = files[0].clone();
        lab.open(&first);
        let (eyes, doing, done) = (Eyes::new(), "opening".into(), BTreeMap::new());
        Self { lab, random: Random(seed), files, at: pos2(300.0, 300.0), eyes, doing, done }
    }

    /// Somewhere in the window, more often in the panels than they are large.
    fn somewhere(&mut self) -> Pos2 {
        let size = self.lab.window.ctx.content_rect().size();
        let [x, y] = [self.random.unit(), self.random.unit()];
        let left = if self.random.below(2) == 0 { 0.7 } else { 0.0 };
        let x = left + (1.0 - left) * x;
        pos2(size.x * x as f32, size.y * y as f32)
    }

    /// Does something, and looks at the window after each part of it.
    fn act(&mut self) {
        self.at = self.somewhere();
        let deed = self.random.pick(deeds::ALL);
        deed.0.clone_into(&mut self.doing);
        *self.done.entry(deed.0.to_owned()).or_default() += 1;
        deed.1(self);
        self.show();
    }

    /// Sends events one after the other, as a system does.
    fn send(&mut self, events: impl IntoIterator<Item = Event>) {
        for event in events {
            self.lab.window.event(event);
            self.show();
        }
    }

    /// Shows the window once.
    fn show(&mut self) {
        let watch = eyes::Watch::start();
        self.lab.window.step();
        self.eyes.look(&self.lab, &self.doing, watch);
    }

    /// The window has all that it needs to go on: whatever is open is left by Escape, and a plate
    /// can be seen.
    fn ends_well(&mut self) {
        let ctx = self.lab.window.ctx.clone();
        self.lab.state().act(&ctx, Action::CancelSolving);
        if self.lab.viewer().viewports.len() == 2 {
            self.lab.state().act(&ctx, Action::Split);
        }
        let first = self.files[0].clone();
        std::fs::remove_file(&first).ok();
        ppum_format::write(&plate(), &first).expect("it can be written");
        self.lab.window.set_pixels_per_point(1.0);
        self.lab.window.set_size(vec2(1000.0, 700.0));
        self.send([Event::PointerGone, Event::WindowFocused(true)]);
        for _ in 0..8 {
            self.lab.window.key_press(Key::Escape);
            self.show();
        }
        self.lab.open(&first);
        assert!(self.lab.dataset(0).is_some(), "{}", self.lab.notes());
        // what was there may have been a solution that no file has
        self.lab.window.key_press(Key::Escape);
        self.show();
        assert!(!ctx.egui_wants_keyboard_input(), "something keeps the keys");
        let panels = self.lab.viewer().session.panels;
        self.lab.window.key_press(Key::Tab);
        self.show();
        assert_eq!(self.lab.viewer().session.panels, !panels, "keys do nothing any more");
    }
}

/// A number that the environment gives.
fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok().and_then(|text| text.parse().ok())
}

/// Memory at the end of a long time, in parts of what it was after the first quarter of it.
const FLAT: f64 = 1.25;

#[test]
fn whatever_hands_do_the_window_stays() {
    let minutes = number("PPUM_HANDS_MINUTES");
    let count = number("PPUM_HANDS").unwrap_or(if minutes.is_some() { u64::MAX } else { 100 });
    let most = minutes.map(|minutes| Duration::from_secs(60 * minutes));
    let seeds = number("PPUM_HANDS_SEED").map_or(vec![1, 2], |seed| vec![seed]);
    for seed in seeds {
        let mut hands = Hands::new(seed);
        let start = Instant::now();
        for k in 1..=count {
            if most.is_some_and(|most| start.elapsed() > most) {
                break;
            }
            hands.act();
            if k % 100 == 0 {
                hands.eyes.note_memory();
                println!("{k}: {}", hands.eyes.told());
            }
        }
        hands.doing = "ending".into();
        hands.ends_well();
        println!("seed {seed}, {:.0} s: {}", start.elapsed().as_secs_f64(), hands.eyes.told());
        println!("{:?}", hands.done);
        hands.eyes.check_memory(FLAT);
        hands.eyes.check_panics();
    }
}

/// In each of two views somebody writes an end of the colours: fields of their own, as everything
/// is in two views.
#[test]
fn ends_are_written_in_two_views_at_once() {
    let mut hands = Hands::new(1);
    let ctx = hands.lab.window.ctx.clone();
    hands.lab.window.set_size(vec2(1400.0, 800.0));
    hands.lab.state().act(&ctx, Action::Split);
    hands.lab.settle();
    for number in 0..2 {
        let ends = hands.lab.window.get_all_by_label("Upper end of the colours");
        let at = ends.map(|end| end.rect().center()).nth(number).expect("an end in each view");
        let event = |pressed| Event::PointerButton {
            pos: at,
            pressed,
            button: PointerButton::Primary,
            modifiers: Modifiers::NONE,
        };
        hands.send([Event::PointerMoved(at), event(true), event(false)]);
    }
    (0..3).for_each(|_| hands.show());
}
