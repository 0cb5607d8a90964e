//! A window beside work that keeps all processors: it is shown all the same.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};

use egui::{Event, Modifiers, MouseWheelUnit, TouchPhase, pos2, vec2};
use ppum_viewer::actions::{Action, all};

use crate::kit::{TIME_LIMIT, plate, settle, wait_until, window};

/// Keeps all threads of the pool, as long pictures do, until it is dropped.
struct Busy(Arc<Gate>);

#[derive(Default)]
struct Gate {
    is_open: Mutex<bool>,
    changed: Condvar,
    held: AtomicUsize,
    /// True if the pool was needed before it was given back.
    was_needed: AtomicBool,
}

impl Busy {
    fn new() -> Self {
        let gate = Arc::new(Gate::default());
        let theirs = Arc::clone(&gate);
        rayon::spawn_broadcast(move |_| theirs.hold());
        wait_until("all threads of the pool are held", || {
            gate.held.load(Ordering::SeqCst) == rayon::current_num_threads()
        });
        Self(gate)
    }

    fn was_needed(&self) -> bool {
        self.0.was_needed.load(Ordering::SeqCst)
    }
}

impl Gate {
    fn hold(&self) {
        self.held.fetch_add(1, Ordering::SeqCst);
        let is_open = self.is_open.lock().unwrap_or_else(PoisonError::into_inner);
        let outcome = self.changed.wait_timeout_while(is_open, TIME_LIMIT, |is_open| !*is_open);
        let waited = outcome.unwrap_or_else(PoisonError::into_inner).1;
        self.was_needed.fetch_or(waited.timed_out(), Ordering::SeqCst);
    }
}

impl Drop for Busy {
    fn drop(&mut self) {
        *self.0.is_open.lock().unwrap_or_else(PoisonError::into_inner) = true;
        self.0.changed.notify_all();
    }
}

/// Files and other windows are not of this test.
fn is_of_the_plate(action: Action) -> bool {
    !matches!(
        action,
        Action::Open
            | Action::OpenBeside
            | Action::Close
            | Action::Save(_)
            | Action::SaveDataset
            | Action::SaveSession
            | Action::SaveSessionAs
            | Action::Solve
            | Action::SaveProblem
            | Action::SaveProblemAs
            | Action::CloseProblem
            | Action::Quit
    )
}

#[test]
fn the_window_never_waits_for_work_of_others() {
    let mut window = window(plate(), [700.0, 450.0]);
    for entry in all().filter(|entry| is_of_the_plate(entry.action)) {
        settle(&mut window);
        let ctx = window.ctx.clone();
        window.state_mut().act(&ctx, entry.action);
        window.step();
        // pictures that are ready but not yet shown are shown while the pool is busy
        for viewport in &mut window.state_mut().viewports {
            wait_until("its next picture is ready", || {
                viewport.frames.poll() || !viewport.frames.is_working()
            });
        }
        let busy = Busy::new();
        for _ in 0..4 {
            let wheel = Event::MouseWheel {
                unit: MouseWheelUnit::Line,
                delta: vec2(0.0, 0.3),
                phase: TouchPhase::Move,
                modifiers: Modifiers::NONE,
                source: egui::MouseWheelSource::Wheel,
            };
            [Event::PointerMoved(pos2(250.0, 220.0)), wheel]
                .into_iter()
                .for_each(|event| window.event(event));
            window.step();
        }
        assert!(!busy.was_needed(), "{:?} waits for others' work", entry.action);
        if entry.action == Action::Swing {
            // what moves for ever does not come to rest
            window.state_mut().act(&ctx, entry.action);
        }
    }
}
