//! Datasets that have much of something: no picture of the window takes long.

use std::sync::Arc;
use std::time::Duration;

use egui::{Event, Key, Modifiers, pos2, vec2};
use ppum::dataset::Dataset;
use ppum_scene::magnification::Magnification;
use ppum_scene::overlays::{IsolineLevels, Overlay};
use ppum_testkit::costly;
use ppum_testkit::synthetic::Recipe;
use ppum_viewer::actions::Action;
use ppum_viewer::session::DrawerPage;

use super::eyes::{Eyes, Watch};
use crate::lab::Lab;

/// A window that is looked at.
struct Looked {
    lab: Lab,
    eyes: Eyes,
    doing: String,
}

impl Looked {
    fn new(dataset: Dataset) -> Self {
        let mut lab = Lab::new();
        lab.window.set_size(vec2(1280.0, 800.0));
        lab.state().open(None, Arc::new(dataset));
        Self { lab, eyes: Eyes::new(), doing: "opening".into() }
    }

    fn show(&mut self) {
        let watch = Watch::start();
        self.lab.window.step();
        self.eyes.look(&self.lab, &self.doing, watch);
    }

    fn settle(&mut self) {
        loop {
            self.show();
            let viewer = self.lab.viewer();
            let is_reading = viewer.viewports.iter().any(|viewport| viewport.tools.is_working());
            if !viewer.is_working() && !is_reading {
                return;
            }
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    fn act(&mut self, action: Action) {
        self.doing = format!("{action:?}");
        let ctx = self.lab.window.ctx.clone();
        self.lab.state().act(&ctx, action);
        self.settle();
    }

    fn send(&mut self, doing: &str, events: impl IntoIterator<Item = Event>) {
        doing.clone_into(&mut self.doing);
        for event in events {
            self.lab.window.event(event);
            self.show();
        }
        self.settle();
    }
}

/// All that the window has, once.
fn tour(looked: &mut Looked) {
    looked.settle();
    looked.send("hover", (0..12).map(|k| Event::PointerMoved(pos2(60.0 + 70.0 * k as f32, 420.0))));
    for page in DrawerPage::ALL {
        looked.act(Action::Drawer(page));
    }
    looked.send(
        "hover a page",
        (0..4).map(|k| Event::PointerMoved(pos2(100.0 + 200.0 * k as f32, 700.0))),
    );
    looked.act(Action::Drawer(DrawerPage::Problem));
    looked.act(Action::Quantity);
    looked.send("search", [Event::Text("s".into()), Event::Text("x".into())]);
    let key = |key, pressed| Event::Key {
        key,
        pressed,
        modifiers: Modifiers::NONE,
        repeat: false,
        physical_key: None,
    };
    looked.send("escape", [key(Key::Escape, true), key(Key::Escape, false)]);
    looked.act(Action::NextTip);
    looked.act(Action::CircleForK);
    looked.act(Action::Fit);
    looked.act(Action::Probe);
    looked.act(Action::Extrema);
    looked.act(Action::Compare);
    for overlay in Overlay::ALL {
        looked.doing = format!("{overlay:?}");
        looked.lab.state().session.panes[0].scene.overlays.shown = vec![overlay];
        looked.settle();
    }
    looked.doing = "isolines, arrows, crosses".into();
    let overlays = &mut looked.lab.state().session.panes[0].scene.overlays;
    overlays.isolines = Some(IsolineLevels::Auto);
    (overlays.arrows, overlays.crosses) = (Some(8.0), Some(8.0));
    looked.settle();
    looked.send("hover", (0..4).map(|k| Event::PointerMoved(pos2(60.0 + 200.0 * k as f32, 300.0))));
    looked.act(Action::Deform);
    looked.doing = "factor".into();
    looked.lab.state().session.panes[0].scene.deformed = Some(Magnification::Given(0.1));
    looked.settle();
    looked.send(
        "hover the deformed plate",
        (0..4).map(|k| Event::PointerMoved(pos2(60.0 + 200.0 * k as f32, 300.0))),
    );
    looked.act(Action::Split);
    looked.act(Action::Save(ppum_viewer::export::ExportChoice::Figure));
}

/// Processor time of the window's own thread for one picture of it, at most, whatever is in a file.
const FLUENT: Duration = Duration::from_millis(200);

fn is_fluent(name: &str, dataset: Dataset) {
    let mut looked = Looked::new(dataset);
    tour(&mut looked);
    println!("{name}: {}", looked.eyes.told());
    assert!(looked.eyes.longest() < FLUENT, "{name}: {}", looked.eyes.told());
}

#[test]
fn datasets_with_much_of_something_leave_the_window_fluent() {
    for name in ["attributes", "patches"] {
        is_fluent(name, costly::named(name));
    }
}

/// All of them, or the one that `PPUM_HEAVY` names.
#[test]
#[ignore = "slow: minutes, run by hand"]
fn by_hand_all_costly_datasets_leave_the_window_fluent() {
    let only = std::env::var("PPUM_HEAVY").ok();
    for (name, dataset) in costly::all() {
        if only.as_ref().is_none_or(|only| name == only) {
            is_fluent(name, dataset);
        }
    }
}

#[test]
#[ignore = "slow: minutes, run by hand"]
fn by_hand_a_million_patches_leave_the_window_fluent() {
    let recipe = Recipe { cells: [4, 4], level: 8, ..Recipe::default() };
    let dataset = recipe.dataset();
    assert!(dataset.steps[0].partition.len() > 1_000_000);
    is_fluent("a million patches", dataset);
}
