//! Images of one field as a request asks for them, and what images of several have in common.

use ppum_figure::canvas::Canvas;
use ppum_figure::figure::FigureStyle;

use crate::camera::{CameraChoice, extent};
use crate::deformed::Magnification;
use crate::engine::Engine;
use crate::moving::{FrameSource, Work};
use crate::page_style::DEFAULT_SIZE;
use crate::request::Request;
use crate::shot::{FieldSource, ImageError, RenderedImage, page_seen};

/// One field, which is open: the frame of a still image.
pub struct ImageJob<'a> {
    /// The field.
    pub source: FieldSource<'a>,
    /// The request, in which the factor of a deformed body is a number.
    pub request: Request,
}

impl FrameSource for ImageJob<'_> {
    type Error = ImageError;

    fn count(&self) -> usize {
        1
    }

    fn with(&self, _: usize, work: &mut Work<'_, ImageError>) -> Result<(), ImageError> {
        work(self.source, &self.request)
    }
}

impl<'a> ImageJob<'a> {
    /// The frame of a request, deformed by a number if it is.
    ///
    /// # Errors
    /// Fields that are no displacements.
    pub fn new(source: FieldSource<'a>, mut request: Request) -> Result<Self, ImageError> {
        request.scene = source.settled(request.scene)?;
        if let Some(factor) = request.scene.deformed {
            request.scene.deformed = Some(Magnification::Given(factor.number(&[source.field])?));
        }
        Ok(Self { source, request })
    }

    /// The page of the image.
    ///
    /// # Errors
    /// As [`page_seen`]; a place that there is not.
    pub fn page(&self, engine: &Engine<'_>) -> Result<(Canvas, RenderedImage), ImageError> {
        let Self { source, request } = self;
        let common = ImageSettings::new(self, request)?;
        let seen = common.placing.body(*source, &request.scene, engine)?;
        page_seen(*source, request, &seen, common.design.as_ref(), engine)
    }
}

/// The settings common to the images of a request, one or those of a series.
pub struct ImageSettings<'a> {
    /// Where they are seen.
    pub placing: CameraChoice<'a>,
    /// The look of figures; none of bare images.
    pub design: Option<FigureStyle>,
}

impl<'a> ImageSettings<'a> {
    /// Returns the settings common to the frames of a request, of which there is one at least.
    ///
    /// # Errors
    /// Those of the frames; a size without room.
    pub fn new<F: FrameSource>(frames: &F, request: &'a Request) -> Result<Self, F::Error> {
        let (mut design, mut aspect) = (FigureStyle::pixels(DEFAULT_SIZE), None);
        frames.with(0, &mut |source, request| {
            design = request.design(source.bounds(&request.scene), DEFAULT_SIZE, [1, 1]);
            aspect = request.place.aspect(source.bounds(&request.scene));
            Ok(())
        })?;
        if request.figure {
            design = request.look.fitted(design, aspect, [1, 1], |design| frames.room(design))?;
        }
        let room = if request.figure { frames.room(&design)? } else { design.size };
        let design = request.figure.then_some(design);
        let extent = extent(request, design.as_ref(), room);
        Ok(Self { placing: CameraChoice::new(&request.place, extent, frames)?, design })
    }
}
