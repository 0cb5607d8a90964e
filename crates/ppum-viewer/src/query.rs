//! Questions that are answered in the background, and of whose answers only the last one is wanted.

use std::sync::Arc;

use ppum::progress::Watcher;

use crate::job::BackgroundJob;

/// One question at a time and its last answer, with what was asked.
#[derive(Debug)]
pub struct BackgroundQuery<K, V> {
    running: Option<(K, BackgroundJob<QueryAnswer<V>>)>,
    newest: Option<(K, Arc<Result<V, String>>)>,
}

/// A value, or the reason why there is none; nothing of work that was stopped.
type QueryAnswer<V> = Option<Result<V, String>>;

impl<K, V> Default for BackgroundQuery<K, V> {
    fn default() -> Self {
        Self { running: None, newest: None }
    }
}

impl<K: Clone + PartialEq, V: Send + 'static> BackgroundQuery<K, V> {
    /// Asks for something unless that is known or on its way. A question that is asked while other
    /// work runs has to be asked again; if it is `urgent` that work is stopped. So no two threads
    /// ever work for one question, however long the first takes to stop.
    pub fn ask(
        &mut self,
        key: &K,
        urgent: bool,
        wake: &egui::Context,
        work: impl FnOnce(&dyn Watcher) -> QueryAnswer<V> + Send + 'static,
    ) {
        self.poll();
        if let Some((running, job)) = &self.running {
            if running != key && urgent {
                job.cancel();
            }
            return;
        }
        if self.newest.as_ref().is_none_or(|(known, _)| known != key) {
            let job = BackgroundJob::start(wake, move |stop| work(stop));
            self.running = Some((key.clone(), job));
        }
    }

    fn poll(&mut self) {
        let Some(outcome) = self.running.as_ref().and_then(|(_, job)| job.poll()) else { return };
        let Some((key, _)) = self.running.take() else { return };
        if let Some(answer) = outcome.unwrap_or_else(|panic| Some(Err(panic))) {
            self.newest = Some((key, Arc::new(answer)));
        }
    }

    /// The last answer, to whatever was asked.
    pub fn newest(&mut self) -> Option<&(K, Arc<Result<V, String>>)> {
        self.poll();
        self.newest.as_ref()
    }

    /// The last answer that was taken.
    pub fn known(&self) -> Option<&Result<V, String>> {
        self.newest.as_ref().map(|(_, answer)| &**answer)
    }

    /// Forgets what is known and stops what runs.
    pub fn forget(&mut self) {
        *self = Self::default();
    }
}

impl<K, V> BackgroundQuery<K, V> {
    /// True while work runs, also for a question that nobody asks any more.
    #[must_use]
    pub fn is_working(&self) -> bool {
        self.running.as_ref().is_some_and(|(_, job)| !job.is_done())
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use ppum::progress::{Phase, Progress};

    use super::*;

    fn answer<V: Send + 'static>(question: &mut BackgroundQuery<u32, V>) -> Arc<Result<V, String>> {
        while question.newest().is_none() || question.is_working() {
            std::thread::sleep(Duration::from_millis(1));
        }
        question.newest().expect("it is answered").1.clone()
    }

    #[test]
    fn the_last_question_is_answered_and_an_urgent_one_stops_what_runs() {
        let (wake, mut question) = (egui::Context::default(), BackgroundQuery::default());
        let endless = |watcher: &dyn Watcher| {
            while watcher.report(Progress::start(Phase::Evaluation, 1)).is_ok() {
                std::thread::yield_now();
            }
            None
        };
        question.ask(&1, false, &wake, endless);
        question.ask(&2, false, &wake, |_| Some(Ok(2)));
        assert!(question.is_working() && question.newest().is_none());
        while question.is_working() {
            question.ask(&3, true, &wake, |_| Some(Ok(3)));
        }
        question.ask(&3, true, &wake, |_| Some(Ok(3)));
        assert_eq!(*answer(&mut question), Ok(3));
        // what is known is not asked again
        question.ask(&3, true, &wake, |_| Some(Ok(4)));
        assert_eq!(*answer(&mut question), Ok(3));
    }

    #[test]
    fn a_question_that_nobody_asks_any_more_comes_to_rest() {
        let (wake, mut question) =
            (egui::Context::default(), BackgroundQuery::<u32, ()>::default());
        question.ask(&1, false, &wake, |_| Some(Ok(())));
        for _ in 0..2000 {
            if !question.is_working() {
                return;
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        panic!("it works without end");
    }

    #[test]
    fn a_panic_is_an_answer_and_not_asked_for_again() {
        let (wake, mut question) =
            (egui::Context::default(), BackgroundQuery::<u32, ()>::default());
        question.ask(&1, false, &wake, |_| panic!("seven"));
        assert!(answer(&mut question).as_ref().as_ref().is_err_and(|e| e.contains("seven")));
        question.ask(&1, false, &wake, |_| Some(Ok(())));
        assert!(answer(&mut question).is_err());
    }
}
