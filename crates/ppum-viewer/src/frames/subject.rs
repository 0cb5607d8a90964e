//! The subject of a view: a field, what is shown of it, how much it is deformed.

use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum::progress::Watcher;
use ppum_render::deform::Deformation;
use ppum_render::view::View;
use ppum_scene::body::BodyView;
use ppum_scene::difference::DifferenceSide;
use ppum_scene::magnification::Magnification;
use ppum_scene::mirror::{Mirror, MirrorError};
use ppum_scene::mirror_lines::MirrorLines;
use ppum_scene::quantity::{DisplayedQuantity, default_quantity};
use ppum_scene::scene;
use ppum_scene::subject::ImageSubject;
use self_cell::self_cell;

use super::{FaultOrigin, FrameRequest, ImageFailure, SubtractedImage};
use crate::field::OwnedField;
use crate::memo::Memo;
use crate::same_arc::SameArc;

/// The field and the quantity that are shown, whatever the view.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameSubject {
    /// The field, with what is replaced in it.
    pub field: SameArc<OwnedField>,
    /// The displayed quantity.
    pub shown: SameArc<DisplayedQuantity>,
    /// How many times its displacement the body is drawn with, if it is deformed.
    pub factor: Option<f64>,
    /// The lines at which the body is mirrored.
    pub lines: MirrorLines,
    /// The subtrahend.
    pub left: Option<Subtrahend>,
}

/// The displayed quantity of another field.
#[derive(Clone, Debug, PartialEq)]
pub struct Subtrahend {
    /// The field.
    pub field: SameArc<OwnedField>,
    /// The displayed quantity.
    pub shown: SameArc<DisplayedQuantity>,
}

impl Subtrahend {
    /// The side of the difference.
    #[must_use]
    pub fn side(&self) -> DifferenceSide<'_> {
        DifferenceSide { field: self.field.field(), shown: &self.shown }
    }
}

impl FrameSubject {
    /// True for the whole of a half.
    pub(super) fn is_mirrored(&self) -> bool {
        self.lines != MirrorLines::default()
    }

    /// The subject of its images.
    pub(super) fn image(&self) -> ImageSubject<'_> {
        let (dataset, field) = (self.field.dataset(), self.field.field());
        let left = self.left.as_ref().map(Subtrahend::side);
        ImageSubject { dataset, field, shown: Arc::clone(&self.shown), name: String::new(), left }
    }

    /// Where an error lies that keeps its values from being drawn.
    pub(super) fn fault(&self) -> FaultOrigin {
        match self {
            Self { left: Some(_), .. } => FaultOrigin::Minus,
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
        self.shown.get_or((field.into(), quantity.cloned()), || {
            let field = field.field();
            let text = quantity.map_or(default_quantity(field), String::as_str);
            let shown = DisplayedQuantity::parse(text, field);
            shown.map(Arc::new).map_err(ImageFailure::at(FaultOrigin::Quantity))
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
    /// The subject of what is requested.
    pub(super) fn find(&mut self, request: &FrameRequest) -> Result<FrameSubject, ImageFailure> {
        let scene = &request.scene;
        let key = (request.dataset.clone(), scene.subject.clone());
        let field = self.own.fields.get_or(key, || field(&request.dataset, &scene.subject))?;
        let shown = self.own.shown(&field, scene.quantity.as_ref())?.into();
        if request.minus.is_some() && scene.deformed.is_some() {
            return Err(ImageFailure::new(FaultOrigin::Minus, DEFORMED));
        }
        let number = || scene.deformed.map(|factor| factor.number(&[field.field()])).transpose();
        let factor = self.factors.get_or(((&field).into(), scene.deformed), || {
            number().map_err(ImageFailure::at(FaultOrigin::Deformed))
        })?;
        if request.minus.is_some() && scene.mirror.is_some() {
            let difference = MirrorError::Difference.to_string();
            return Err(ImageFailure::new(FaultOrigin::Mirror, difference));
        }
        let lines = self.lines.get_or(((&field).into(), scene.mirror.clone()), || {
            let lines = MirrorLines::of(scene.mirror.as_ref(), field.dataset());
            lines.map_err(ImageFailure::at(FaultOrigin::Mirror))
        })?;
        if request.minus.is_none() {
            // what was subtracted before may have been closed
            self.minus = SubjectFields::default();
        }
        let left = request.minus.as_ref().map(|minus| self.other(minus)).transpose();
        let on_left = |failure: ImageFailure| {
            ImageFailure::new(FaultOrigin::Minus, format!("on the left: {}", failure.message))
        };
        Ok(FrameSubject { field: field.into(), shown, factor, lines, left: left.map_err(on_left)? })
    }

    /// Returns the subtrahend; a field that is looked at anyway is not made twice.
    fn other(&mut self, image: &SubtractedImage) -> Result<Subtrahend, ImageFailure> {
        let key = (image.dataset.clone(), image.subject.clone());
        let field = match self.own.fields.get(&key) {
            Some(field) => field,
            None => self.minus.fields.get_or(key, || field(&image.dataset, &image.subject))?,
        };
        let shown = self.minus.shown(&field, image.quantity.as_ref())?;
        Ok(Subtrahend { field: field.into(), shown: shown.into() })
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
    /// The part of a body that is seen, with its field.
    pub(super) struct OwnedBody {
        owner: Arc<OwnedField>,
        #[covariant]
        dependent: BodyView,
    }
);

/// Computes the part of a subject that is seen in a view.
pub(super) fn visible_body(
    SubjectView { subject, view }: &SubjectView,
    watcher: &dyn Watcher,
) -> Result<Arc<OwnedBody>, ImageFailure> {
    let body = OwnedBody::try_new(Arc::clone(&subject.field), |field| match subject.factor {
        None => Ok(BodyView::new(field.field(), *view, subject.lines)),
        Some(factor) => {
            let seen = Deformation::new(field.field(), factor)?.seen(view);
            BodyView::deformed(&seen, subject.lines, watcher)
        }
    });
    body.map(Arc::new).map_err(ImageFailure::at(FaultOrigin::Deformed))
}
