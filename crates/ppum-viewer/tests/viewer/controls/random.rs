//! Any changes whatever: there is a picture or a reason why there is none, and all can be
//! taken back.

use egui::{Key, Modifiers};
use ppum_render::range::RangeChoice;
use ppum_render::scale::Scale;
use ppum_scene::magnification::Magnification;
use ppum_scene::overlays::{IsolineLevels, Overlay};
use ppum_scene::scene::SceneRequest;
use ppum_testkit::random::Random;

use super::scene;
use crate::kit::{plate, settle, window};

/// One change of something.
fn change(scene: &mut SceneRequest, random: &mut Random) {
    match random.below(12) {
        0 => {
            let all =
                ["ux", "sxx - syy", "level", "overlap", "phi:3", "1/x", "sqrt(-1)", "wrong(", "7"];
            scene.quantity = Some(random.pick(&all).to_owned());
        }
        1 => scene.colors.scale = random.pick(&[Scale::Linear, Scale::Log, Scale::SymLog]),
        2 => {
            let fixed = RangeChoice::Fixed(random.between(-1.0, 1.0), random.between(1.5, 9.0));
            let all =
                [RangeChoice::Auto, RangeChoice::Full, fixed, RangeChoice::Percentiles(3.0, 90.0)];
            scene.colors.range = random.pick(&all);
        }
        3 => {
            let map = random.pick(&["vik", "twilight_r", "turbo", "no map"]);
            scene.colors.colormap = Some(map.to_owned());
        }
        4 => scene.colors.bands = random.pick(&[None, Some(1), Some(7), Some(1000)]),
        5 => scene.colors.symmetric = !scene.colors.symmetric,
        6 => scene.colors.contrast = !scene.colors.contrast,
        7 => {
            let overlay = random.pick(&Overlay::ALL);
            scene.overlays.shown.push(overlay);
        }
        8 => {
            let levels = random.pick(&["auto", "7", "0.3,1e300"]).parse::<IsolineLevels>().ok();
            scene.overlays.isolines = levels.filter(|_| random.below(3) > 0);
            scene.overlays.arrows = random.pick(&[None, Some(30.0)]);
            scene.overlays.crosses = random.pick(&[None, Some(60.0)]);
        }
        9 => {
            let all = [
                None,
                Some(Magnification::Auto),
                Some(Magnification::Given(0.0)),
                Some(Magnification::Given(1e9)),
            ];
            scene.deformed = random.pick(&all);
        }
        10 => {
            let part = random.pick(&[None, Some("smooth"), Some("other"), Some("patch:3")]);
            scene.subject.part = part.map(str::to_owned);
        }
        _ => {
            let text = random.pick(&[None, Some("r^2"), Some("1/0"), Some("r +")]);
            scene.subject.replace("westergaard 2", text.map(str::to_owned));
            let weight = random.pick(&[None, Some("bump"), Some("t - t"), Some("w")]);
            scene.subject.weight = weight.map(str::to_owned);
        }
    }
}

#[test]
fn any_changes_give_a_picture_or_a_reason_and_can_be_taken_back() {
    let mut random = Random(2026);
    let mut window = window(plate(), [700.0, 500.0]);
    let first = scene(&window);
    let mut steps = 0;
    let mut found = [0, 0];
    for _ in 0..60 {
        let before = scene(&window);
        change(&mut window.state_mut().session.pane_mut().scene, &mut random);
        steps += usize::from(scene(&window) != before);
        settle(&mut window);
        let frames = &window.state().viewports[0].frames;
        let is_new = frames.newest().is_some_and(|f| f.request.scene == scene(&window).drawn());
        let reason = frames.failure().map(|failure| failure.message.clone());
        assert!(is_new != reason.is_some(), "{:?} {reason:?}", scene(&window));
        assert!(reason.as_ref().is_none_or(|reason| !reason.is_empty()));
        found[usize::from(is_new)] += 1;
    }
    assert!(found.iter().all(|count| *count > 5), "{found:?}");
    for _ in 0..steps {
        window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        window.step();
    }
    assert_eq!(scene(&window), first);
    settle(&mut window);
    assert!(window.state().viewports[0].frames.failure().is_none());
}
