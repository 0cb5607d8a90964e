//! The last result of a computation, with its input.

/// The last of its kind; it is made again when what it is made from is another one.
#[derive(Debug)]
pub struct Memo<K, V> {
    kept: Option<(K, V)>,
    /// How often one was made.
    pub(crate) made: usize,
}

impl<K, V> Default for Memo<K, V> {
    fn default() -> Self {
        Self { kept: None, made: 0 }
    }
}

impl<K: PartialEq, V> Memo<K, V> {
    /// The last one, whatever it was made from.
    pub(crate) fn last(&self) -> Option<&(K, V)> {
        self.kept.as_ref()
    }

    /// The one that is made from this: the last one, or a new one.
    pub(crate) fn get_or_make(&mut self, key: K, make: impl FnOnce() -> V) -> &mut V {
        if self.kept.as_ref().is_none_or(|(made_from, _)| *made_from != key) {
            self.kept = None;
            self.made += 1;
        }
        &mut self.kept.get_or_insert_with(|| (key, make())).1
    }
}

impl<K: PartialEq, V: Clone> Memo<K, V> {
    /// The one that is made from this, if it is the last one.
    pub(crate) fn get(&self, key: &K) -> Option<V> {
        self.kept.as_ref().filter(|(made_from, _)| made_from == key).map(|(_, value)| value.clone())
    }

    /// The one that is made from this: the last one, or a new one. An old one goes first, so that
    /// there are never two.
    pub(crate) fn get_or<E>(
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
    pub(crate) fn set(&mut self, key: K, value: V) {
        self.kept = Some((key, value));
        self.made += 1;
    }
}
