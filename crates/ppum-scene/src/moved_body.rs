//! The deformed body and its images beyond lines of symmetry.
//!
//! A point X of the body moves to X + s u(X). That of an image, SX, moves by ± s S u(X), with − in
//! an antisymmetric field, to S (X ± s u(X)). So the image of the deformed body is the reflection
//! of the body deformed by ± s, seen in the reflected view.

use ppum::crack::Crack;
use ppum::progress::Watcher;
use ppum::quantity::Reflection;
use ppum::vec2::{Rect, Vec2};
use ppum_render::deform::{DeformError, Deformation, DeformedPoints, DeformedView, TOLERANCE};

use crate::mirror::{MirrorImage, MirrorLines};

/// Distance from a line, in pixels, on which a point lies on it: ten times that of the error of
/// points.
const ON_LINE: f64 = 10.0 * TOLERANCE;

/// What a view shows of the deformed body and of its images.
pub struct MovedBody<'f> {
    /// The body itself.
    pub own: DeformedPoints<'f>,
    /// The lines at which it is mirrored.
    pub lines: MirrorLines,
    /// Its images.
    pub images: Vec<MovedImage<'f>>,
}

/// An image of the deformed body.
pub struct MovedImage<'f> {
    /// Its reflection and its view.
    pub image: MirrorImage,
    /// What that view shows of the body.
    pub points: DeformedPoints<'f>,
}

impl<'f> From<DeformedPoints<'f>> for MovedBody<'f> {
    fn from(own: DeformedPoints<'f>) -> Self {
        Self { own, lines: MirrorLines::default(), images: Vec::new() }
    }
}

impl<'f> MovedBody<'f> {
    /// What a view shows of a body and of its images at lines of symmetry.
    ///
    /// # Errors
    /// A body that folds too often; a watcher that stops it.
    pub fn new(
        view: &DeformedView<'f>,
        lines: MirrorLines,
        watcher: &dyn Watcher,
    ) -> Result<Self, DeformError> {
        let image = |reflection: Reflection| {
            let image = MirrorImage { reflection, view: view.view.reflected(reflection.lines) };
            let factor = view.factor() * reflection.sign();
            let seen = Deformation::new(view.field(), factor)?.seen(&image.view);
            Ok(MovedImage { image, points: seen.points(watcher)? })
        };
        let own = view.points(watcher)?;
        let images = lines.reflections().map(image).collect::<Result<_, DeformError>>()?;
        Ok(Self { own, lines, images })
    }

    /// The body and its images, with their reflections.
    pub fn parts(&self) -> impl Iterator<Item = (Reflection, &DeformedPoints<'f>)> {
        let images = self.images.iter().map(|one| (one.image.reflection, &one.points));
        [(Reflection::NONE, &self.own)].into_iter().chain(images)
    }

    /// The cracks of all parts where they have moved to.
    #[must_use]
    pub fn cracks(&self) -> Vec<Crack> {
        let of_part = |(reflection, points): (Reflection, &DeformedPoints<'_>)| {
            let mut cracks = points.view.moved_cracks();
            let all = cracks.iter_mut().flat_map(|crack| &mut crack.points);
            all.for_each(|p| *p = reflection.point(*p));
            cracks
        };
        self.parts().flat_map(of_part).collect()
    }

    /// True if a pixel shows a point of the body on a line of symmetry, where it meets its image.
    #[must_use]
    pub fn is_on_line(&self, column: u32, row: u32) -> bool {
        let view = &self.own.view;
        let Some(point) = self.own.at(column, row).first() else { return false };
        let at = view.anchor + point.offset;
        let near = |line: Option<f64>, at: f64| {
            line.is_some_and(|line| (line - at).abs() <= ON_LINE * view.view.pixel_size())
        };
        let [x, y] = self.lines.at();
        near(x, at.x) || near(y, at.y)
    }
}

/// The box of the deformed whole; `bounds` gives that of the body by the sign of its factor.
///
/// # Errors
/// Those of `bounds`.
pub fn whole_box<E>(
    lines: &MirrorLines,
    bounds: impl Fn(f64) -> Result<Rect, E>,
) -> Result<Rect, E> {
    lines.reflections().try_fold(bounds(1.0)?, |all, reflection| {
        let Rect { min, max } = bounds(reflection.sign())?;
        let [a, b]: [Vec2; 2] = [min, max].map(|p| reflection.point(p));
        Ok(all.union(&Rect::new(a.min(b), a.max(b))))
    })
}
