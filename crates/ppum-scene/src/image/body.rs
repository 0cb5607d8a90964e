//! The body as a view shows it: itself and its images beyond lines of symmetry, deformed or not.
//!
//! A point X of the body moves to X + s u(X). That of an image, SX, moves by ± s S u(X), with − in
//! an antisymmetric field, to S (X ± s u(X)). So the image of the deformed body is the reflection
//! of the body deformed by ± s, seen in the reflected view.

use ppum::crack::Crack;
use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::Reflection;
use ppum_render::deform::{DeformError, Deformation, DeformedPoints, DeformedView, TOLERANCE};
use ppum_render::view::View;

use super::mirror_lines::MirrorLines;

/// Distance from a line, in pixels, on which a point lies on it: ten times that of the error of
/// points.
const ON_LINE: f64 = 10.0 * TOLERANCE;

/// The parts of the whole that a view shows.
pub struct BodyView<'f> {
    /// The body itself.
    pub own: BodyPart<'f>,
    /// The lines at which it is mirrored.
    pub lines: MirrorLines,
    /// Its images: of an undeformed body those that are seen.
    pub images: Vec<BodyPart<'f>>,
}

/// The body itself, or one of its images.
pub struct BodyPart<'f> {
    /// The reflection that makes it of the body.
    pub reflection: Reflection,
    /// The view of the body whose reflection shows the part.
    pub view: View,
    /// The points of the body at the pixels of that view, if the body is deformed.
    pub points: Option<DeformedPoints<'f>>,
}

impl BodyPart<'_> {
    /// True for coordinates that are reflected.
    #[must_use]
    pub fn flips(&self) -> [bool; 2] {
        self.reflection.lines.map(|line| line.is_some())
    }
}

impl<'f> BodyView<'f> {
    /// The parts of the undeformed whole.
    #[must_use]
    pub fn new(field: &Field<'_>, view: View, lines: MirrorLines) -> Self {
        let part = |reflection: Reflection| {
            let view = view.reflected(reflection.lines);
            BodyPart { reflection, view, points: None }
        };
        let bounds = field.domain.body_bounds();
        let images = lines.reflections().map(part);
        let images = images.filter(|image| image.view.rect().overlaps(&bounds)).collect();
        let own = BodyPart { reflection: Reflection::NONE, view, points: None };
        Self { own, lines, images }
    }

    /// The parts of the deformed whole.
    ///
    /// # Errors
    /// A body that folds too often; a watcher that stops it.
    pub fn deformed(
        seen: &DeformedView<'f>,
        lines: MirrorLines,
        watcher: &dyn Watcher,
    ) -> Result<Self, DeformError> {
        let part = |reflection: Reflection, seen: &DeformedView<'f>| {
            Ok(BodyPart { reflection, view: seen.view, points: Some(seen.points(watcher)?) })
        };
        let image = |reflection: Reflection| {
            let factor = seen.factor() * reflection.sign();
            let view = seen.view.reflected(reflection.lines);
            part(reflection, &Deformation::new(seen.field(), factor)?.seen(&view))
        };
        let own = part(Reflection::NONE, seen)?;
        let images = lines.reflections().map(image).collect::<Result<_, DeformError>>()?;
        Ok(Self { own, lines, images })
    }

    /// The view of the whole.
    #[must_use]
    pub fn view(&self) -> &View {
        &self.own.view
    }

    /// The body, then its images.
    pub fn parts(&self) -> impl Iterator<Item = &BodyPart<'f>> {
        [&self.own].into_iter().chain(&self.images)
    }

    /// How many times its displacement the body is drawn with, if it is deformed.
    #[must_use]
    pub fn factor(&self) -> Option<f64> {
        self.own.points.as_ref().map(|points| points.view.factor())
    }

    /// The cracks of the whole where they are seen.
    #[must_use]
    pub fn cracks(&self, field: &Field<'_>) -> Vec<Crack> {
        if self.own.points.is_none() {
            return self.lines.cracks(&field.step.cracks);
        }
        let moved = |part: &BodyPart<'_>| {
            let cracks = part.points.as_ref().map_or_else(Vec::new, |p| p.view.moved_cracks());
            let reflection = part.reflection;
            cracks.into_iter().map(move |crack| reflection.crack(&crack))
        };
        self.parts().flat_map(moved).collect()
    }

    /// True if a pixel shows a point of the deformed body on a line of symmetry, where it meets
    /// its image.
    pub(crate) fn is_on_line(&self, column: u32, row: u32) -> bool {
        let Some(points) = &self.own.points else { return false };
        let Some(point) = points.at(column, row).first() else { return false };
        let at = points.view.anchor + point.offset;
        let near = |line: Option<f64>, at: f64| {
            line.is_some_and(|line| (line - at).abs() <= ON_LINE * self.view().pixel_size())
        };
        let [x, y] = self.lines.at();
        near(x, at.x) || near(y, at.y)
    }
}
