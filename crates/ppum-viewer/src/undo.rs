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

    /// The state that was noted last.
    pub fn now(&self) -> &T {
        &self.now
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

    /// The state before, if there is one.
    pub fn back(&mut self) -> Option<&T> {
        let before = self.past.pop()?;
        self.future.push(std::mem::replace(&mut self.now, before));
        Some(&self.now)
    }

    /// The state that was undone last, if there is one.
    pub fn forward(&mut self) -> Option<&T> {
        let after = self.future.pop()?;
        self.past.push(std::mem::replace(&mut self.now, after));
        Some(&self.now)
    }

    /// True if there is a state before, and one after.
    pub fn has(&self) -> [bool; 2] {
        [!self.past.is_empty(), !self.future.is_empty()]
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
        assert_eq!(undo.back().copied(), Some(2));
        assert_eq!(undo.back().copied(), Some(1));
        assert_eq!(undo.forward().copied(), Some(2));
        undo.note(&7);
        assert_eq!(undo.forward(), None);
        assert_eq!([undo.back().copied(), undo.back().copied()], [Some(2), Some(1)]);
        assert_eq!([undo.back().copied(), undo.back().copied()], [Some(0), None]);
        assert_eq!(undo.has(), [false, true]);
    }

    #[test]
    fn a_long_history_is_bounded() {
        let mut undo = Undo::new(0);
        (1..2000).for_each(|state| undo.note(&state));
        assert_eq!(std::iter::from_fn(|| undo.back().copied()).count(), MOST);
    }
}
