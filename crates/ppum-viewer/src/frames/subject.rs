//! What is looked at: a field, what is shown of it, how much it is deformed.

use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum::progress::Watcher;
use ppum_render::deform::{DeformError, Deformation};
use ppum_render::view::View;
use ppum_scene::deformed::Factor;
use ppum_scene::drawing::{Seen, Shown};
use ppum_scene::scene::{self, default_quantity, shown};
use self_cell::self_cell;

use super::memo::{Memo, Same};
use super::stop::Stop;
use super::{Fault, Wanted};
use crate::field::OwnedField;

/// What is looked at, wherever that is.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Subject {
    pub(super) field: Same<OwnedField>,
    pub(super) shown: Same<Shown>,
    /// How many times its displacement the plate is drawn with.
    pub(super) factor: Option<f64>,
}

/// A view of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) subject: Subject,
    pub(super) view: View,
}

/// Finds subjects.
#[derive(Default)]
pub(super) struct Subjects {
    pub(super) fields: Memo<(Same<Dataset>, scene::Subject), Arc<OwnedField>>,
    pub(super) shown: Memo<(Same<OwnedField>, Option<String>), Arc<Shown>>,
    factors: Memo<(Same<OwnedField>, Option<Factor>), Option<f64>>,
}

impl Subjects {
    /// The subject of what is wanted.
    pub(super) fn find(&mut self, wanted: &Wanted) -> Result<Subject, Stop> {
        let scene = &wanted.scene;
        let key = (Same::of(&wanted.dataset), scene.subject.clone());
        let field = self.fields.get_or(key, || field(&wanted.dataset, &scene.subject))?;
        let key = (Same::of(&field), scene.quantity.clone());
        let quantity = || {
            let text = scene.quantity.as_deref().unwrap_or(default_quantity(field.field()));
            shown(text, field.field()).map(Arc::new).map_err(Stop::at(Fault::Quantity))
        };
        let shown = self.shown.get_or(key, quantity)?;
        let number = || scene.deformed.map(|factor| factor.number(&[field.field()])).transpose();
        let key = (Same::of(&field), scene.deformed);
        let factor = self
            .factors
            .get_or(key, || number().map_err(Stop::at::<DeformError>(Fault::Deformed)))?;
        Ok(Subject { field: Same(field), shown: Same(shown), factor })
    }
}

/// The field of a dataset with what is replaced in it.
fn field(dataset: &Arc<Dataset>, subject: &scene::Subject) -> Result<Arc<OwnedField>, Stop> {
    let dataset = match subject.is_whole() {
        true => Arc::clone(dataset),
        false => {
            let mut changed = Dataset::clone(dataset);
            subject.apply(&mut changed).map_err(Stop::at(Fault::Subject))?;
            Arc::new(changed)
        }
    };
    let step = subject.step_of(&dataset);
    OwnedField::new(dataset, step).map(Arc::new).map_err(Stop::at(Fault::Subject))
}

self_cell!(
    struct Both {
        owner: Arc<OwnedField>,
        #[covariant]
        dependent: Seen,
    }
);

/// What is seen of a field, with the field.
pub(super) struct OwnedSeen(Both);

impl OwnedSeen {
    /// What is seen of a subject in a view.
    pub(super) fn new(place: &Place, watcher: &dyn Watcher) -> Result<Self, DeformError> {
        let Place { subject, view } = place;
        Both::try_new(Arc::clone(&subject.field.0), |field| match subject.factor {
            None => Ok(Seen::Plate(*view)),
            Some(factor) => {
                let deformation = Deformation::new(field.field(), factor)?;
                deformation.seen(view).points(watcher).map(Seen::Moved)
            }
        })
        .map(Self)
    }

    /// What is seen.
    pub(super) fn seen(&self) -> &Seen<'_> {
        self.0.borrow_dependent()
    }
}
