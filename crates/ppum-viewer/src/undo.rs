//! Steps back and forward through states.

/// States that were, and those that were undone.
#[derive(Clone, Debug)]
pub struct Undo<T> {
    past: Vec<T>,
    now: T,
    future: Vec<T>,
}

/// States that are kept.
const MOST: usize = 500;

impl<T: Clone + PartialEq> Undo<T> {
    /// Begins with a state.
    pub fn new(now: T) -> Self {
        Self { past: Vec::new(), now, future: Vec::new() }
    }

    /// Notes a state if it is another one; what was undone is forgotten then.
    pub fn note(&mut self, state: &T) {
        if *state == self.now {
            return;
        }
        let before = std::mem::replace(&mut self.now, state.clone());
        self.past.push(before);
        self.future.clear();
        if self.past.len() > MOST {
            self.past.remove(0);
        }
    }

    /// The state that a step back, or forward, leads to.
    pub fn next(&self, back: bool) -> Option<&T> {
        if back { self.past.last() } else { self.future.last() }
    }

    /// The state before, or that which was undone last, if there is one.
    pub fn go(&mut self, back: bool) -> Option<&T> {
        let (from, to) = match back {
            true => (&mut self.past, &mut self.future),
            false => (&mut self.future, &mut self.past),
        };
        to.push(std::mem::replace(&mut self.now, from.pop()?));
        Some(&self.now)
    }
}

/// Seconds without a change after which a state counts as one.
const PAUSE: f64 = 0.4;

/// Tells when something that changes has come to rest, so that a drag or a word is one step and
/// not many.
#[derive(Clone, Debug)]
pub struct RestDetector<T> {
    last: T,
    since: f64,
}

impl<T: Clone + PartialEq> RestDetector<T> {
    /// Begins with a state.
    pub fn new(last: T) -> Self {
        Self { last, since: f64::NEG_INFINITY }
    }

    /// Looks at a state at a time \[s\]: nothing if it is at rest, else the seconds until it
    /// will be.
    pub fn until(&mut self, state: &T, now: f64) -> Option<f64> {
        if self.last != *state {
            self.last = state.clone();
            self.since = now;
        }
        let left = PAUSE - (now - self.since);
        (left > 0.0).then_some(left)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn back_and_forward_are_each_others_opposite() {
        let mut undo = Undo::new(0);
        for state in [1, 1, 2, 3] {
            undo.note(&state);
        }
        assert_eq!(undo.go(true).copied(), Some(2));
        assert_eq!(undo.go(true).copied(), Some(1));
        assert_eq!(undo.go(false).copied(), Some(2));
        undo.note(&7);
        assert_eq!(undo.go(false), None);
        assert_eq!([undo.go(true).copied(), undo.go(true).copied()], [Some(2), Some(1)]);
        assert_eq!([undo.go(true).copied(), undo.go(true).copied()], [Some(0), None]);
        assert_eq!([true, false].map(|back| undo.next(back).is_some()), [false, true]);
    }

    #[test]
    fn what_changes_is_not_at_rest() {
        let mut rest = RestDetector::new(0);
        assert_eq!(rest.until(&0, 5.0), None);
        assert_eq!(rest.until(&1, 6.0), Some(PAUSE));
        assert!(rest.until(&1, 6.0 + 0.5 * PAUSE).is_some_and(|left| left < PAUSE));
        assert_eq!(rest.until(&1, 6.0 + 2.0 * PAUSE), None);
    }

    #[test]
    fn a_long_history_is_bounded() {
        let mut undo = Undo::new(0);
        (1..2000).for_each(|state| undo.note(&state));
        assert_eq!(std::iter::from_fn(|| undo.go(true).copied()).count(), MOST);
    }
}
