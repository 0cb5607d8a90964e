//! What is looked at: a field, what is shown of it, how much it is deformed.

use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum::progress::Watcher;
use ppum_render::deform::{DeformError, Deformation};
use ppum_render::view::View;
use ppum_scene::body::BodyView;
use ppum_scene::deformed::Factor;
use ppum_scene::drawing::{Shown, single_precision_error};
use ppum_scene::minus::Side;
use ppum_scene::mirror::{Mirror, MirrorError, MirrorLines};
use ppum_scene::scene::{self, default_quantity, shown};
use ppum_scene::shot::{FieldSource, Input};
use self_cell::self_cell;

use super::memo::{Memo, Same};
use super::{Failure, Fault, Minus, Wanted};
use crate::field::OwnedField;

/// The field and the quantity that are shown, whatever the view.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FrameSubject {
    pub(super) field: Same<OwnedField>,
    pub(super) shown: Same<Shown>,
    /// How many times its displacement the plate is drawn with.
    pub(super) factor: Option<f64>,
    /// The lines at which the plate is mirrored.
    pub(super) lines: MirrorLines,
    /// What is subtracted.
    pub(super) minus: Option<Left>,
}

/// What is shown of another field.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Left {
    pub(super) field: Same<OwnedField>,
    pub(super) shown: Same<Shown>,
}

impl FrameSubject {
    /// True if single precision shows the field.
    pub(super) fn bears_single(&self) -> bool {
        single_precision_error(self.field.0.field().step).is_none()
    }

    /// True for the whole of a half.
    pub(super) fn is_mirrored(&self) -> bool {
        self.lines != MirrorLines::default()
    }

    /// The field, and what is subtracted from what is shown of it.
    pub(super) fn source(&self) -> FieldSource<'_> {
        let left = self.minus.as_ref();
        let left = left.map(|left| Side { field: left.field.0.field(), shown: &left.shown.0 });
        FieldSource { dataset: self.field.0.dataset(), field: self.field.0.field(), left }
    }

    /// What pictures of it are made of.
    pub(super) fn input<'a>(&'a self, seen: &'a BodyView<'a>) -> Input<'a> {
        Input { source: self.source(), shown: &self.shown.0, name: "", seen }
    }

    /// Where a mistake lies that keeps its values from being drawn.
    pub(super) fn fault(&self) -> Fault {
        match self {
            Self { minus: Some(_), .. } => Fault::Minus,
            Self { factor: Some(_), .. } => Fault::Deformed,
            _ if self.is_mirrored() => Fault::Mirror,
            _ => Fault::Quantity,
        }
    }
}

/// A subject in one view.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SubjectView {
    pub(super) subject: FrameSubject,
    pub(super) view: View,
}

/// Fields that are looked at, and what is shown of them.
#[derive(Default)]
pub(super) struct Fields {
    pub(super) fields: Memo<(Same<Dataset>, scene::Subject), Arc<OwnedField>>,
    shown: Memo<(Same<OwnedField>, Option<String>), Arc<Shown>>,
}

impl Fields {
    /// What a quantity shows of a field.
    fn shown(
        &mut self,
        field: &Arc<OwnedField>,
        quantity: Option<&String>,
    ) -> Result<Arc<Shown>, Failure> {
        self.shown.get_or((Same::of(field), quantity.cloned()), || {
            let field = field.field();
            let text = quantity.map_or(default_quantity(field), String::as_str);
            shown(text, field).map(Arc::new).map_err(Failure::at(Fault::Quantity))
        })
    }
}

/// Finds subjects.
#[derive(Default)]
pub(super) struct Subjects {
    pub(super) own: Fields,
    minus: Fields,
    factors: Memo<(Same<OwnedField>, Option<Factor>), Option<f64>>,
    lines: Memo<(Same<OwnedField>, Option<Mirror>), MirrorLines>,
}

/// Why there is no difference on the deformed plate.
const DEFORMED: &str = "of the deformed plate there is no difference; press d";

impl Subjects {
    /// The subject of what is wanted.
    pub(super) fn find(&mut self, wanted: &Wanted) -> Result<FrameSubject, Failure> {
        let scene = &wanted.scene;
        let key = (Same::of(&wanted.dataset), scene.subject.clone());
        let field = self.own.fields.get_or(key, || field(&wanted.dataset, &scene.subject))?;
        let shown = self.own.shown(&field, scene.quantity.as_ref())?;
        if wanted.minus.is_some() && scene.deformed.is_some() {
            return Err(Failure::new(Fault::Minus, DEFORMED));
        }
        let number = || scene.deformed.map(|factor| factor.number(&[field.field()])).transpose();
        let key = (Same::of(&field), scene.deformed);
        let factor = self.factors.get_or(key, || number().map_err(Failure::at(Fault::Deformed)))?;
        let lines = self.lines(&field, wanted)?;
        if wanted.minus.is_none() {
            // what was subtracted before may have been closed
            self.minus = Fields::default();
        }
        let other = wanted.minus.as_ref().map(|minus| self.other(minus)).transpose();
        let of_left = |Failure { message, .. }: Failure| format!("on the left: {message}");
        let minus = other.map_err(|failure| Failure::new(Fault::Minus, of_left(failure)))?;
        Ok(FrameSubject { field: Same(field), shown: Same(shown), factor, lines, minus })
    }

    /// The lines at which a field is mirrored.
    fn lines(&mut self, field: &Arc<OwnedField>, wanted: &Wanted) -> Result<MirrorLines, Failure> {
        let scene = &wanted.scene;
        let failed = |error: MirrorError| Failure::new(Fault::Mirror, error.to_string());
        match &scene.mirror {
            None => return Ok(MirrorLines::default()),
            Some(_) if wanted.minus.is_some() => return Err(failed(MirrorError::Difference)),
            Some(_) => {}
        }
        let lines = || FieldSource::of(field.dataset(), field.field()).lines(scene);
        let key = (Same::of(field), scene.mirror.clone());
        self.lines.get_or(key, || lines().map_err(failed))
    }

    /// What is subtracted; a field that is looked at anyway is not made twice.
    fn other(&mut self, wanted: &Minus) -> Result<Left, Failure> {
        let key = (Same::of(&wanted.dataset), wanted.subject.clone());
        let field = match self.own.fields.get(&key) {
            Some(field) => field,
            None => self.minus.fields.get_or(key, || field(&wanted.dataset, &wanted.subject))?,
        };
        let shown = self.minus.shown(&field, wanted.quantity.as_ref())?;
        Ok(Left { field: Same(field), shown: Same(shown) })
    }
}

/// The field of a dataset with what is replaced in it.
fn field(dataset: &Arc<Dataset>, subject: &scene::Subject) -> Result<Arc<OwnedField>, Failure> {
    let dataset = match subject.is_whole() {
        true => Arc::clone(dataset),
        false => {
            let mut changed = Dataset::clone(dataset);
            subject.apply(&mut changed).map_err(Failure::at(Fault::Subject))?;
            Arc::new(changed)
        }
    };
    let step = subject.step_of(&dataset);
    OwnedField::new(dataset, step).map(Arc::new).map_err(Failure::at(Fault::Subject))
}

self_cell!(
    struct Both {
        owner: Arc<OwnedField>,
        #[covariant]
        dependent: BodyView,
    }
);

/// What is seen of a field, with the field.
pub(super) struct OwnedSeen(Both);

impl OwnedSeen {
    /// What is seen of a subject in a view.
    pub(super) fn new(target: &SubjectView, watcher: &dyn Watcher) -> Result<Self, DeformError> {
        let SubjectView { subject, view } = target;
        Both::try_new(Arc::clone(&subject.field.0), |field| match subject.factor {
            None => Ok(BodyView::new(field.field(), *view, subject.lines)),
            Some(factor) => {
                let seen = Deformation::new(field.field(), factor)?.seen(view);
                BodyView::deformed(&seen, subject.lines, watcher)
            }
        })
        .map(Self)
    }

    /// What is seen.
    pub(super) fn seen(&self) -> &BodyView<'_> {
        self.0.borrow_dependent()
    }
}
