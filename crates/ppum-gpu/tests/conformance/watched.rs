//! Drawing is followed, and can be stopped.

use std::sync::Mutex;

use ppum::field::Field;
use ppum::progress::{Cancelled, Phase, Progress, Verdict};
use ppum_gpu::{Method, RenderError};
use ppum_testkit::synthetic::Recipe;

use crate::{good, quantity, renderer_or_skip, view, window};

#[test]
fn a_watcher_hears_of_all_stages_and_can_stop_at_each() {
    let Some(mut renderer) = renderer_or_skip() else { return };
    let dataset = Recipe { level: 0, tip_level: 0, ..Recipe::default() }.dataset();
    let field = good(Field::new(&dataset, 0));
    let (overlap, view) = (quantity("overlap", &field), view(&window()));
    let heard = Mutex::new(Vec::new());
    let listen = |progress: Progress| {
        assert_eq!((progress.phase, progress.total), (Phase::Evaluation, 4));
        heard.lock().expect("one thread").push(progress.done);
        Verdict::GoOn
    };
    good(renderer.render(&field, &view, &overlap, Method::Gather, &listen));
    assert_eq!(heard.into_inner().expect("one thread"), [0, 1, 2, 3, 4]);
    for at in 0..=4 {
        let stop = |progress: Progress| Verdict::go_on_unless(progress.done == at);
        let stopped = renderer.render(&field, &view, &overlap, Method::Gather, &stop);
        assert_eq!(stopped, Err(RenderError::Cancelled(Cancelled)), "at {at}");
    }
}
