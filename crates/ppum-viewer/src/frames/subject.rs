//! The subject of a view: a field, what is shown of it, how much it is deformed.

use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum::progress::Watcher;
use ppum_render::deform::{DeformError, Deformation};
use ppum_render::view::View;
use ppum_scene::body::BodyView;
use ppum_scene::deformed::Magnification;
use ppum_scene::difference::DifferenceSide;
use ppum_scene::drawing::{DisplayedQuantity, single_precision_error};
use ppum_scene::mirror::{Mirror, MirrorError, MirrorLines};
use ppum_scene::scene::{self, default_quantity, shown};
use ppum_scene::shot::{FieldSource, ImageInput};
use self_cell::self_cell;

use super::memo::{Memo, SameArc};
use super::{FaultOrigin, FrameRequest, ImageFailure, SubtractedImage};
use crate::field::OwnedField;

/// The field and the quantity that are shown, whatever the view.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FrameSubject {
    pub(super) field: SameArc<OwnedField>,
    pub(super) shown: SameArc<DisplayedQuantity>,
    /// How many times its displacement the body is drawn with.
    pub(super) factor: Option<f64>,
    /// The lines at which the body is mirrored.
    pub(super) lines: MirrorLines,
    /// The subtrahend.
    pub(super) minus: Option<SubtrahendSubject>,
}

/// The displayed quantity of another field.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SubtrahendSubject {
    pub(super) field: SameArc<OwnedField>,
    pub(super) shown: SameArc<DisplayedQuantity>,
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
        let left =
            left.map(|left| DifferenceSide { field: left.field.0.field(), shown: &left.shown.0 });
        FieldSource { dataset: self.field.0.dataset(), field: self.field.0.field(), left }
    }

    /// The data that images of it are made of.
    pub(super) fn input<'a>(&'a self, seen: &'a BodyView<'a>) -> ImageInput<'a> {
        ImageInput { source: self.source(), shown: &self.shown.0, name: "", seen }
    }

    /// Where an error lies that keeps its values from being drawn.
    pub(super) fn fault(&self) -> FaultOrigin {
        match self {
            Self { minus: Some(_), .. } => FaultOrigin::Minus,
            Self { factor: Some(_), .. } => FaultOrigin::Deformed,
            _ if self.is_mirrored() => FaultOrigin::Mirror,
            _ => FaultOrigin::Quantity,
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
pub(super) struct SubjectFields {
    pub(super) fields: Memo<(SameArc<Dataset>, scene::Subject), Arc<OwnedField>>,
    shown: Memo<(SameArc<OwnedField>, Option<String>), Arc<DisplayedQuantity>>,
}

impl SubjectFields {
    /// Parses the quantity of a field.
    fn shown(
        &mut self,
        field: &Arc<OwnedField>,
        quantity: Option<&String>,
    ) -> Result<Arc<DisplayedQuantity>, ImageFailure> {
        self.shown.get_or((SameArc::of(field), quantity.cloned()), || {
            let field = field.field();
            let text = quantity.map_or(default_quantity(field), String::as_str);
            shown(text, field).map(Arc::new).map_err(ImageFailure::at(FaultOrigin::Quantity))
        })
    }
}

/// Finds subjects.
#[derive(Default)]
pub(super) struct Subjects {
    pub(super) own: SubjectFields,
    minus: SubjectFields,
    factors: Memo<(SameArc<OwnedField>, Option<Magnification>), Option<f64>>,
    lines: Memo<(SameArc<OwnedField>, Option<Mirror>), MirrorLines>,
}

/// Why there is no difference on the deformed body.
const DEFORMED: &str = "of the deformed plate there is no difference; press d";

impl Subjects {
    /// The subject of what is wanted.
    pub(super) fn find(&mut self, wanted: &FrameRequest) -> Result<FrameSubject, ImageFailure> {
        let scene = &wanted.scene;
        let key = (SameArc::of(&wanted.dataset), scene.subject.clone());
        let field = self.own.fields.get_or(key, || field(&wanted.dataset, &scene.subject))?;
        let shown = self.own.shown(&field, scene.quantity.as_ref())?;
        if wanted.minus.is_some() && scene.deformed.is_some() {
            return Err(ImageFailure::new(FaultOrigin::Minus, DEFORMED));
        }
        let number = || scene.deformed.map(|factor| factor.number(&[field.field()])).transpose();
        let key = (SameArc::of(&field), scene.deformed);
        let factor = self
            .factors
            .get_or(key, || number().map_err(ImageFailure::at(FaultOrigin::Deformed)))?;
        let lines = self.lines(&field, wanted)?;
        if wanted.minus.is_none() {
            // what was subtracted before may have been closed
            self.minus = SubjectFields::default();
        }
        let other = wanted.minus.as_ref().map(|minus| self.other(minus)).transpose();
        let of_left =
            |ImageFailure { message, .. }: ImageFailure| format!("on the left: {message}");
        let minus =
            other.map_err(|failure| ImageFailure::new(FaultOrigin::Minus, of_left(failure)))?;
        Ok(FrameSubject { field: SameArc(field), shown: SameArc(shown), factor, lines, minus })
    }

    /// The lines at which a field is mirrored.
    fn lines(
        &mut self,
        field: &Arc<OwnedField>,
        wanted: &FrameRequest,
    ) -> Result<MirrorLines, ImageFailure> {
        let scene = &wanted.scene;
        let failed = |error: MirrorError| ImageFailure::new(FaultOrigin::Mirror, error.to_string());
        match &scene.mirror {
            None => return Ok(MirrorLines::default()),
            Some(_) if wanted.minus.is_some() => return Err(failed(MirrorError::Difference)),
            Some(_) => {}
        }
        let lines = || FieldSource::of(field.dataset(), field.field()).lines(scene);
        let key = (SameArc::of(field), scene.mirror.clone());
        self.lines.get_or(key, || lines().map_err(failed))
    }

    /// Returns the subtrahend; a field that is looked at anyway is not made twice.
    fn other(&mut self, wanted: &SubtractedImage) -> Result<SubtrahendSubject, ImageFailure> {
        let key = (SameArc::of(&wanted.dataset), wanted.subject.clone());
        let field = match self.own.fields.get(&key) {
            Some(field) => field,
            None => self.minus.fields.get_or(key, || field(&wanted.dataset, &wanted.subject))?,
        };
        let shown = self.minus.shown(&field, wanted.quantity.as_ref())?;
        Ok(SubtrahendSubject { field: SameArc(field), shown: SameArc(shown) })
    }
}

/// The field of a dataset with what is replaced in it.
fn field(
    dataset: &Arc<Dataset>,
    subject: &scene::Subject,
) -> Result<Arc<OwnedField>, ImageFailure> {
    let dataset = match subject.is_whole() {
        true => Arc::clone(dataset),
        false => {
            let mut changed = Dataset::clone(dataset);
            subject.apply(&mut changed).map_err(ImageFailure::at(FaultOrigin::Subject))?;
            Arc::new(changed)
        }
    };
    let step = subject.step_of(&dataset);
    OwnedField::new(dataset, step).map(Arc::new).map_err(ImageFailure::at(FaultOrigin::Subject))
}

self_cell!(
    struct SubjectField {
        owner: Arc<OwnedField>,
        #[covariant]
        dependent: BodyView,
    }
);

/// The visible part of a field, with the field.
pub(super) struct OwnedSubjectView(SubjectField);

impl OwnedSubjectView {
    /// Computes the visible part of a subject in a view.
    pub(super) fn new(target: &SubjectView, watcher: &dyn Watcher) -> Result<Self, DeformError> {
        let SubjectView { subject, view } = target;
        SubjectField::try_new(Arc::clone(&subject.field.0), |field| match subject.factor {
            None => Ok(BodyView::new(field.field(), *view, subject.lines)),
            Some(factor) => {
                let seen = Deformation::new(field.field(), factor)?.seen(view);
                BodyView::deformed(&seen, subject.lines, watcher)
            }
        })
        .map(Self)
    }

    /// Returns the visible part.
    pub(super) fn seen(&self) -> &BodyView<'_> {
        self.0.borrow_dependent()
    }
}
