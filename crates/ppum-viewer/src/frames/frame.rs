//! Pictures with what they were made of.

use std::sync::Arc;

use ppum_render::view::View;
use ppum_scene::drawing::{Drawn, Shown};
use ppum_scene::minus::{self, Side};
use ppum_scene::mirror::MirrorLines;

use super::fault::Failure;
use super::laid::Laid;
use super::minus::Subtracted;
use super::paint::Painted;
use super::resampled::Other;
use super::wanted::Wanted;
use crate::field::OwnedField;

/// A picture with all that it was made of.
#[derive(Clone, Debug)]
pub struct Frame {
    /// What was wanted.
    pub wanted: Wanted,
    /// The field, with what is replaced in it.
    pub field: Arc<OwnedField>,
    /// What is shown.
    pub shown: Arc<Shown>,
    /// What was subtracted from it.
    pub subtracted: Option<Subtracted>,
    /// Its values; of a rough picture those of its own view.
    pub drawn: Arc<Drawn>,
    /// Their colours, and the view that they are of.
    pub picture: Arc<Painted>,
    /// What lies over them; of an older view until it is drawn anew.
    pub layers: Arc<Laid>,
    /// The view in whose pixels the layers are.
    pub layers_view: View,
    /// How many times its displacement the plate is drawn with, if it is deformed.
    pub factor: Option<f64>,
    /// The lines at which it is mirrored.
    pub lines: MirrorLines,
    /// What resampling gives, if that was asked for; of an older view until it is there.
    pub other: Option<Arc<Other>>,
    /// True if nothing better will come.
    pub is_final: bool,
    /// The reason why the processor draws in place of the graphics card that was to.
    pub note: Option<String>,
    /// What its values took \[s\].
    pub seconds: f64,
}

/// A picture, or why there is none.
pub(super) type Outcome = Result<Arc<Frame>, Failure>;

impl Frame {
    /// The two sides of a difference, if it is one.
    #[must_use]
    pub fn minus(&self) -> Option<minus::Minus<'_>> {
        let left = self.subtracted.as_ref()?;
        let right = Side { field: self.field.field(), shown: &self.shown };
        Some(minus::Minus { right, left: Side { field: left.field.field(), shown: &left.shown } })
    }

    /// What was subtracted: a field, and what is shown of it.
    #[must_use]
    pub fn left(&self) -> Option<(Arc<OwnedField>, Arc<Shown>)> {
        let left = self.subtracted.as_ref()?;
        Some((Arc::clone(&left.field), Arc::clone(&left.shown)))
    }

    /// The symbol of what its colours mean, or the words for it, and the unit.
    #[must_use]
    pub fn words(&self) -> [String; 2] {
        let minus = self.minus();
        minus.map_or_else(|| self.shown.words(self.field.field()), |minus| minus.words())
    }

    /// The map of its colours where none is chosen.
    #[must_use]
    pub fn default_map(&self) -> &'static str {
        match self.subtracted {
            Some(_) => minus::MAP,
            None => ppum_scene::colors::Colors::default_map(self.shown.quantity()),
        }
    }
}
