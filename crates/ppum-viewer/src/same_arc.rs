//! Shared values as keys: what is computed of one is computed again for another one.

use std::ops::Deref;
use std::sync::Arc;

/// A shared value that is compared by its place in memory, which it holds.
#[derive(Debug)]
pub struct SameArc<T>(Arc<T>);

impl<T> From<Arc<T>> for SameArc<T> {
    fn from(value: Arc<T>) -> Self {
        Self(value)
    }
}

impl<T> From<&Arc<T>> for SameArc<T> {
    fn from(value: &Arc<T>) -> Self {
        Self(Arc::clone(value))
    }
}

impl<T> Deref for SameArc<T> {
    type Target = Arc<T>;

    fn deref(&self) -> &Arc<T> {
        &self.0
    }
}

impl<T> Clone for SameArc<T> {
    fn clone(&self) -> Self {
        Self::from(&self.0)
    }
}

impl<T> PartialEq for SameArc<T> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
