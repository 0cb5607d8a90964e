//! The last result of a computation, with its input.

use std::sync::Arc;

/// The last of its kind; it is made again when what it is made from is another one.
#[derive(Debug)]
pub(super) struct Memo<K, V> {
    kept: Option<(K, V)>,
    /// How often one was made.
    pub(super) made: usize,
}

impl<K, V> Default for Memo<K, V> {
    fn default() -> Self {
        Self { kept: None, made: 0 }
    }
}

impl<K: PartialEq, V: Clone> Memo<K, V> {
    /// The one that is made from this, if it is the last one.
    pub(super) fn get(&self, key: &K) -> Option<V> {
        self.kept.as_ref().filter(|(made_from, _)| made_from == key).map(|(_, value)| value.clone())
    }

    /// The last one, whatever it was made from.
    pub(super) fn last(&self) -> Option<&(K, V)> {
        self.kept.as_ref()
    }

    /// The one that is made from this: the last one, or a new one. An old one goes first, so that
    /// there are never two.
    pub(super) fn get_or<E>(
        &mut self,
        key: K,
        make: impl FnOnce() -> Result<V, E>,
    ) -> Result<V, E> {
        if let Some(value) = self.get(&key) {
            return Ok(value);
        }
        self.kept = None;
        let value = make()?;
        self.set(key, value.clone());
        Ok(value)
    }

    /// Keeps one that was made.
    pub(super) fn set(&mut self, key: K, value: V) {
        self.kept = Some((key, value));
        self.made += 1;
    }
}

/// The very same one: compared by its place in memory, which it holds.
#[derive(Debug)]
pub(super) struct SameArc<T>(pub(super) Arc<T>);

impl<T> SameArc<T> {
    pub(super) fn of(value: &Arc<T>) -> Self {
        Self(Arc::clone(value))
    }
}

impl<T> Clone for SameArc<T> {
    fn clone(&self) -> Self {
        Self::of(&self.0)
    }
}

impl<T> PartialEq for SameArc<T> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
