//! Work in the background of which only the last result is wanted.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use ppum::progress::{Progress, Verdict, Watcher};

/// One question at a time and its last answer.
#[derive(Debug)]
pub struct Job<K, T> {
    running: Option<Running<K, T>>,
    newest: Option<(K, Arc<T>)>,
}

#[derive(Debug)]
struct Running<K, T> {
    key: K,
    shared: Arc<Shared<T>>,
}

#[derive(Debug)]
struct Shared<T> {
    is_cancelled: AtomicBool,
    is_done: AtomicBool,
    answer: Mutex<Option<T>>,
}

impl<T: Send> Watcher for Shared<T> {
    fn hear(&self, _: Progress) -> Verdict {
        Verdict::go_on_unless(self.is_cancelled.load(Ordering::Relaxed))
    }
}

impl<K, T> Default for Job<K, T> {
    fn default() -> Self {
        Self { running: None, newest: None }
    }
}

impl<K, T> Drop for Running<K, T> {
    fn drop(&mut self) {
        self.shared.is_cancelled.store(true, Ordering::Relaxed);
    }
}

impl<K: Clone + PartialEq, T: Send + 'static> Job<K, T> {
    /// Asks for something unless that is known or on its way; what is asked for while other work runs has to be asked
    /// for again, or stops that work if it is `urgent`. Work that was stopped has no answer.
    pub fn ask(
        &mut self,
        key: &K,
        urgent: bool,
        wake: &egui::Context,
        work: impl FnOnce(&dyn Watcher) -> Option<T> + Send + 'static,
    ) {
        self.poll();
        let is_known = self.newest.as_ref().is_some_and(|(known, _)| known == key);
        let is_running = self.running.as_ref().is_some_and(|running| running.key == *key);
        if is_running || (is_known && self.running.is_none()) {
            return;
        }
        if self.running.is_some() && !urgent {
            return;
        }
        self.running = None;
        if is_known {
            return;
        }
        let shared = Arc::new(Shared {
            is_cancelled: AtomicBool::new(false),
            is_done: AtomicBool::new(false),
            answer: Mutex::new(None),
        });
        let (theirs, wake) = (Arc::clone(&shared), wake.clone());
        self.running = Some(Running { key: key.clone(), shared });
        spawn(move || {
            let answer = work(&*theirs);
            *theirs.answer.lock().unwrap_or_else(PoisonError::into_inner) = answer;
            theirs.is_done.store(true, Ordering::Release);
            wake.request_repaint();
        });
    }

    fn poll(&mut self) {
        let is_done = |running: &mut Running<K, T>| running.shared.is_done.load(Ordering::Acquire);
        if let Some(running) = self.running.take_if(is_done) {
            let mut answer = running.shared.answer.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(answer) = answer.take() {
                self.newest = Some((running.key.clone(), Arc::new(answer)));
            }
        }
    }

    /// The last answer, to whatever was asked.
    pub fn newest(&mut self) -> Option<&(K, Arc<T>)> {
        self.poll();
        self.newest.as_ref()
    }

    /// Forgets what is known and stops what runs.
    pub fn forget(&mut self) {
        *self = Self::default();
    }
}

impl<K, T> Job<K, T> {
    /// True while work runs.
    #[must_use]
    pub fn is_working(&self) -> bool {
        self.running.is_some()
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn spawn(work: impl FnOnce() + Send + 'static) {
    std::thread::spawn(work);
}

/// Browsers have no threads of this kind: the work is done at once.
#[cfg(target_arch = "wasm32")]
fn spawn(work: impl FnOnce() + Send + 'static) {
    work();
}
