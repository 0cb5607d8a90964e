//! Where images are seen, one or those of a series, and on what pages.

use ppum::vec2::Rect;
use ppum_figure::figure::{FigureStyle, plot_area};
use ppum_render::animation::AnimationError;
use ppum_render::deform::Deformation;
use ppum_render::view::View;

use super::body::BodyView;
use super::engine::Engine;
use super::error::ImageError;
use super::layers::scale;
use super::subject::{ImageSubject, scene_bounds};
use crate::request::Request;
use crate::request::page_style::DEFAULT_SIZE;
use crate::request::region::{ImageExtent, PlaceError, ViewRegion};
use crate::request::scene::SceneRequest;

/// Where the bodies of one image or of a series are seen.
#[derive(Clone, Debug)]
pub enum Camera {
    /// All in one view, of the deformed plane if they are deformed.
    View(View),
    /// Each where its request asks for it.
    Region {
        /// The region.
        region: ViewRegion,
        /// The pixels of the images.
        extent: ImageExtent,
        /// The part of the plane that is seen of deformed bodies without a window.
        bounds: Option<Rect>,
    },
}

/// The extent of an image of so many pixels: a figure of a design, or bare without one. A figure
/// centres what it is given; a bare image has the size that was asked for, if one was.
#[must_use]
pub fn extent(request: &Request, design: Option<&FigureStyle>, pixels: [u32; 2]) -> ImageExtent {
    let may_shrink = design.is_some() || request.look.given_size().is_none();
    let margin = request.scene.overlays.margin(pixels, scale(design, pixels));
    ImageExtent { pixels, may_shrink, margin }
}

impl Camera {
    /// Returns the visible part of a body, whose factor is a number if it is deformed.
    ///
    /// # Errors
    /// A place that the field does not have; a watcher that stops it.
    pub fn body<'f>(
        &self,
        subject: &ImageSubject<'f>,
        scene: &SceneRequest,
        engine: &Engine<'_>,
    ) -> Result<BodyView<'f>, ImageError> {
        let (region, extent, bounds) = match self {
            Self::View(view) => return subject.body(scene, view, engine),
            Self::Region { region, extent, bounds } => (region, *extent, *bounds),
        };
        let field = subject.field;
        let (Some(factor), Some(bounds)) = (scene.deformed, bounds) else {
            let lines = subject.lines(scene)?;
            let view = region.seen(lines.whole(field.domain.bounds), field, extent)?;
            return Ok(BodyView::new(field, view, lines));
        };
        let deformation = Deformation::new(field, factor.number(&[field])?)?;
        let view = region.over(bounds, field, extent)?;
        let seen = match region.tip(field)? {
            // windows are places of the deformed plane; that around a tip follows it
            Some(tip) => deformation.around(tip, view.width, view.pixels)?,
            None if !view.rect().overlaps(&bounds) => {
                return Err(PlaceError::OutsideDeformed(bounds).into());
            }
            None => deformation.seen(&view),
        };
        subject.deformed_body(scene, &seen, engine)
    }
}

/// Input of the layout of a page, of one image or of all of a series.
#[derive(Clone, Debug, Default)]
pub struct LayoutInput {
    /// The titles.
    titles: Vec<String>,
    /// The box of the undeformed whole of the first body.
    whole: Option<Rect>,
    /// The box that shows all bodies deformed, if they are.
    bounds: Option<Rect>,
}

impl LayoutInput {
    /// That of one image.
    ///
    /// # Errors
    /// As [`Self::add`].
    pub fn of(subject: &ImageSubject<'_>, request: &Request) -> Result<Self, ImageError> {
        let mut input = Self::default();
        input.add(subject, request)?;
        Ok(input)
    }

    /// Adds an image.
    ///
    /// # Errors
    /// A field that is no displacement, a factor that is too large, lines that nobody knows.
    pub fn add(&mut self, subject: &ImageSubject<'_>, request: &Request) -> Result<(), ImageError> {
        let ImageSubject { dataset, field, .. } = *subject;
        self.titles.push(subject.title(request)?);
        if self.whole.is_none() {
            self.whole = Some(whole(subject, &request.scene));
        }
        if request.scene.deformed.is_some() {
            let bounds = scene_bounds(dataset, field, &request.scene)?;
            self.bounds = Some(self.bounds.map_or(bounds, |all| all.union(&bounds)));
        }
        Ok(())
    }

    /// Columns and rows that a design has room for under all titles.
    ///
    /// # Errors
    /// A design without room.
    pub fn room(&self, design: &FigureStyle) -> Result<[u32; 2], ImageError> {
        self.titles.iter().try_fold(design.size, |[columns, rows], title| {
            let area = plot_area(title, design)?;
            Ok([columns.min(area[0]), rows.min(area[1])])
        })
    }
}

/// The box of what a scene shows of a field, the whole of a body that is mirrored.
pub(super) fn whole(subject: &ImageSubject<'_>, scene: &SceneRequest) -> Rect {
    subject.lines(scene).unwrap_or_default().whole(subject.field.domain.bounds)
}

/// The settings common to the images of a request, one or those of a series.
#[derive(Clone, Debug)]
pub struct ImageSettings {
    /// Where they are seen.
    pub camera: Camera,
    /// The look of figures; none of bare images.
    pub design: Option<FigureStyle>,
}

impl ImageSettings {
    /// Returns the settings of a request whose factor is a number.
    ///
    /// # Errors
    /// No image; a size without room.
    pub fn new(request: &Request, input: &LayoutInput) -> Result<Self, ImageError> {
        let whole = input.whole.ok_or(AnimationError::Empty)?;
        let mut design = request.design(whole, DEFAULT_SIZE, [1, 1]);
        let mut room = design.size;
        if request.figure {
            let aspect = request.place.aspect(whole);
            design = request.look.fitted(design, aspect, [1, 1], |design| input.room(design))?;
            room = input.room(&design)?;
        }
        let design = request.figure.then_some(design);
        let extent = extent(request, design.as_ref(), room);
        let camera = Camera::Region { region: request.place.clone(), extent, bounds: input.bounds };
        Ok(Self { camera, design })
    }
}
