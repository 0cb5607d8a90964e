//! Hands that do anything: clicks, drags, keys, words, wheels, other sizes, other files, all seeded.

use std::path::PathBuf;

use egui::{Event, Key, Modifiers, MouseWheelUnit, Pos2, TouchPhase, pos2, vec2};
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::Recipe;
use ppum_viewer::actions::ALL;

use crate::kit::plate;
use crate::lab::Lab;

/// What is written into fields.
const WORDS: [&str; 12] = [
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
];

struct Hands {
    lab: Lab,
    random: Random,
    files: Vec<PathBuf>,
    at: Pos2,
}

impl Hands {
    fn new(seed: u64) -> Self {
        let mut lab = Lab::new();
        let mut files = vec![lab.write("plate.h5", &plate())];
        for number in 0..3 {
            let dataset = Recipe::random(seed * 7 + number).dataset();
            files.push(lab.write(&format!("made-{number}.h5"), &dataset));
        }
        for (name, text) in
            [("broken.h5", "no dataset"), ("wrong.toml", "[domain\n"), ("gone.h5", "")]
        {
            files.push(lab.path(name));
            if !text.is_empty() {
                std::fs::write(lab.path(name), text).expect("it can be written");
            }
        }
        let first = files[0].clone();
        lab.open(&first);
        Self { lab, random: Random(seed), files, at: pos2(300.0, 300.0) }
    }

    /// Somewhere in the window, more often in the panels than they are large.
    fn somewhere(&mut self) -> Pos2 {
        let size = self.lab.window.ctx.content_rect().size();
        let [x, y] =
            [self.random.unit(), self.random.unit()].map(|v| 0.5 + 0.5 * v.clamp(-1.0, 1.0));
        let left = if self.random.below(2) == 0 { 0.7 } else { 0.0 };
        let x = left + (1.0 - left) * x;
        pos2(size.x * x as f32, size.y * y as f32)
    }

    fn act(&mut self) {
        self.at = self.somewhere();
        match self.random.below(12) {
            0..=3 => self.click(),
            4 => self.drag(),
            5 | 6 => self.key(),
            7 => self.wheel(),
            8 => self.write(),
            9 => self.resize(),
            10 => self.swap(),
            _ => self.lab.window.hover_at(self.at),
        }
        self.lab.window.step();
    }

    fn click(&mut self) {
        let count = if self.random.below(8) == 0 { 2 } else { 1 };
        for _ in 0..count {
            self.lab.window.drag_at(self.at);
            self.lab.window.drop_at(self.at);
        }
    }

    fn drag(&mut self) {
        self.lab.window.drag_at(self.at);
        for _ in 0..self.random.below(5) {
            let to = self.somewhere();
            self.lab.window.hover_at(to);
            self.lab.window.step();
        }
        let to = self.somewhere();
        self.lab.window.drop_at(to);
    }

    fn key(&mut self) {
        let keys: Vec<_> = ALL.iter().filter_map(|entry| entry.key).collect();
        let shortcut = self.random.pick(&keys);
        match self.random.below(4) {
            0 => {
                let plain = [Key::Escape, Key::Enter, Key::Tab, Key::ArrowDown, Key::Delete];
                let key = self.random.pick(&plain);
                self.lab.window.key_press(key);
            }
            _ => self.lab.window.key_press_modifiers(shortcut.modifiers, shortcut.logical_key),
        }
    }

    fn wheel(&mut self) {
        self.lab.window.hover_at(self.at);
        let lines = self.random.between(-20.0, 20.0) as f32;
        let (unit, phase) = (MouseWheelUnit::Line, TouchPhase::Move);
        let (modifiers, source) = (Modifiers::NONE, egui::MouseWheelSource::Wheel);
        let delta = vec2(0.0, lines);
        self.lab.window.event(Event::MouseWheel { unit, delta, modifiers, phase, source });
    }

    fn write(&mut self) {
        let word = self.random.pick(&WORDS);
        self.lab.window.event(Event::Text(word.to_owned()));
    }

    fn resize(&mut self) {
        let [width, height] =
            [self.random.between(320.0, 1400.0), self.random.between(240.0, 900.0)];
        self.lab.window.set_size(vec2(width as f32, height as f32));
        if self.random.below(4) == 0 {
            let scale = self.random.pick(&[0.75, 1.0, 1.5, 2.0]);
            self.lab.window.set_pixels_per_point(scale);
        }
    }

    /// Opens another file; or writes over one that is open, or takes it away.
    fn swap(&mut self) {
        let path = self.files[self.random.below(self.files.len())].clone();
        let pane = self.random.below(2);
        let ctx = self.lab.window.ctx.clone();
        match self.random.below(6) {
            0 => drop(std::fs::copy(&self.files[0], &path)),
            1 if path != self.files[0] => drop(std::fs::remove_file(&path)),
            _ => {
                let pane = pane.min(self.lab.viewer().session.panes.len() - 1);
                self.lab.state().open_file(&ctx, &path, pane);
            }
        }
    }
}

/// What hands of one seed do, more if `PPUM_HANDS` says so.
fn count() -> usize {
    std::env::var("PPUM_HANDS").ok().and_then(|text| text.parse().ok()).unwrap_or(150)
}

#[test]
fn whatever_hands_do_the_window_stays() {
    for seed in [1, 2] {
        let mut hands = Hands::new(seed);
        (0..count()).for_each(|_| hands.act());
        // and it still shows a plate
        let first = hands.files[0].clone();
        std::fs::remove_file(&first).ok();
        ppum_format::write(&plate(), &first).expect("it can be written");
        hands.lab.window.set_size(vec2(1000.0, 700.0));
        hands.lab.open(&first);
        assert!(hands.lab.dataset(0).is_some(), "seed {seed}: {}", hands.lab.notes());
    }
}
