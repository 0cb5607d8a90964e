//! Why a stage ends without a result: because of a mistake, or because nobody wants it any more.

use std::error::Error;

use ppum_render::RenderError;
use ppum_render::deform::DeformError;
use ppum_render::range::RangeError;
use ppum_render::resample::GridError;
use ppum_scene::colors::MapError;
use ppum_scene::layers::LayersError;
use ppum_scene::scene::{ShownError, SubjectError};
use ppum_scene::shot::ShotError;

use super::{Failure, Fault};

/// The end of a stage without a result.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum StageEnd {
    /// Something else is wanted.
    Cancelled,
    /// There can be none.
    Failed(Failure),
}

/// Whether what is being made is still wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Claim {
    Wanted,
    /// Something else is wanted by now.
    Replaced,
    /// Nobody wants anything any more.
    Gone,
}

/// Asks for it, from any thread.
pub(super) type Ask<'a> = &'a (dyn Fn() -> Claim + Sync);

impl StageEnd {
    /// A mistake, in words.
    pub(super) fn failed(fault: Fault, message: impl Into<String>) -> Self {
        Self::Failed(Failure { fault, message: message.into() })
    }

    /// The same mistake, told elsewhere behind some words.
    pub(super) fn of(self, fault: Fault, words: &str) -> Self {
        match self {
            Self::Cancelled => self,
            Self::Failed(Failure { message, .. }) => {
                Self::failed(fault, format!("{words}{message}"))
            }
        }
    }

    /// What an error means that arose in some place.
    pub(super) fn at<E: MayCancel>(fault: Fault) -> impl Fn(E) -> Self {
        move |error| match error.is_cancelled() {
            true => Self::Cancelled,
            false => Self::failed(fault, error.to_string()),
        }
    }
}

/// Errors that may say nothing but that a watcher stopped the work.
pub(super) trait MayCancel: Error {
    /// True if it says so.
    fn is_cancelled(&self) -> bool {
        false
    }
}

impl MayCancel for MapError {}
impl MayCancel for GridError {}
impl MayCancel for RangeError {}
impl MayCancel for ShownError {}
impl MayCancel for SubjectError {}
impl MayCancel for ppum::field::FieldError {}

impl MayCancel for RenderError {
    fn is_cancelled(&self) -> bool {
        matches!(self, Self::Cancelled(_))
    }
}

impl MayCancel for ShotError {
    fn is_cancelled(&self) -> bool {
        matches!(self, Self::Render(error) if error.is_cancelled())
    }
}

impl MayCancel for DeformError {
    fn is_cancelled(&self) -> bool {
        matches!(self, Self::Cancelled(_))
    }
}

impl MayCancel for LayersError {
    fn is_cancelled(&self) -> bool {
        match self {
            Self::Render(error) => error.is_cancelled(),
            Self::Deform(error) => error.is_cancelled(),
            _ => false,
        }
    }
}
