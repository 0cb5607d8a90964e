//! Work that takes its time: on a thread of its own, so that the window never waits for it.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, TryRecvError};

use ppum::progress::{Progress, Verdict, Watcher};

/// Work on a thread of its own. Dropping it cancels the job, which stops as soon as it can.
#[derive(Debug)]
pub struct BackgroundJob<T> {
    receiver: Receiver<Result<T, String>>,
    stop: CancelToken,
    is_done: Arc<AtomicBool>,
}

/// A token that is set when its job is cancelled.
#[derive(Clone, Debug, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// True if nobody wants the work any more.
    pub(crate) fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Work without a report of its own ends where it is no longer wanted.
impl Watcher for CancelToken {
    fn on_progress(&self, _: Progress) -> Verdict {
        Verdict::go_on_unless(self.is_set())
    }
}

impl<T: Send + 'static> BackgroundJob<T> {
    /// Starts work, and wakes the window when it is done. A panic of the work becomes an error
    /// in words.
    pub fn start(
        ctx: &egui::Context,
        work: impl FnOnce(&CancelToken) -> T + Send + 'static,
    ) -> Self {
        let (sender, receiver) = mpsc::channel();
        let stop = CancelToken::default();
        let is_done = Arc::new(AtomicBool::new(false));
        let (theirs, ctx, done) = (stop.clone(), ctx.clone(), Arc::clone(&is_done));
        std::thread::spawn(move || {
            let outcome = catch_unwind(AssertUnwindSafe(|| work(&theirs)));
            // nobody listens if the job was dropped
            let _ = sender.send(outcome.map_err(|panic| words(&*panic)));
            done.store(true, Ordering::Release);
            ctx.request_repaint();
        });
        Self { receiver, stop, is_done }
    }

    /// The result, once, when it is there; an error if the work has panicked.
    pub fn poll(&self) -> Option<Result<T, String>> {
        match self.receiver.try_recv() {
            Ok(outcome) => Some(outcome),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err(ENDED.into())),
        }
    }

    /// Waits for the result.
    ///
    /// # Errors
    /// A panic of the work.
    pub fn wait(&self) -> Result<T, String> {
        self.receiver.recv().unwrap_or_else(|_| Err(ENDED.into()))
    }

    /// Asks the work to stop; its result still comes.
    pub fn cancel(&self) {
        self.stop.0.store(true, Ordering::Relaxed);
    }

    /// True once it was asked to stop.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.stop.is_set()
    }
}

impl<T> BackgroundJob<T> {
    /// True once the result is there, taken or not.
    pub(crate) fn is_done(&self) -> bool {
        self.is_done.load(Ordering::Acquire)
    }
}

impl<T> Drop for BackgroundJob<T> {
    fn drop(&mut self) {
        self.stop.0.store(true, Ordering::Relaxed);
    }
}

const ENDED: &str = "the work has ended early";

/// Returns the message of a panic.
fn words(panic: &(dyn Any + Send)) -> String {
    let said = panic.downcast_ref::<&str>().copied();
    let said = said.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    format!("internal error, please report it: {}", said.unwrap_or("no words"))
}

#[cfg(test)]
mod tests {
    use std::thread;
    use std::time::Duration;

    use super::*;

    fn wait<T: Send + 'static>(job: &BackgroundJob<T>) -> Result<T, String> {
        loop {
            if let Some(outcome) = job.poll() {
                return outcome;
            }
            thread::sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn a_panic_becomes_an_error() {
        let job: BackgroundJob<()> =
            BackgroundJob::start(&egui::Context::default(), |_| panic!("seven"));
        let error = wait(&job).expect_err("it has panicked");
        assert!(error.contains("seven") && error.contains("report"), "{error}");
    }

    #[test]
    fn who_is_told_to_stop_hears_of_it() {
        let job = BackgroundJob::start(&egui::Context::default(), |stop| {
            while !stop.is_set() {
                thread::yield_now();
            }
            7
        });
        assert!(job.poll().is_none() && !job.is_cancelled());
        job.cancel();
        assert_eq!(wait(&job), Ok(7));
    }
}
