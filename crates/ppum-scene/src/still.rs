//! Images of one field as a request asks for them, and what images of several have in common.

use ppum_figure::canvas::Canvas;
use ppum_figure::figure::Design;

use crate::deformed::Factor;
use crate::engine::Engine;
use crate::look::DEFAULT_SIZE;
use crate::moving::{Frames, Work};
use crate::placing::{Placing, extent};
use crate::request::Request;
use crate::shot::{FieldSource, Shot, ShotError, page_seen};

/// One field, which is open: the frame of a still image.
pub struct Still<'a> {
    /// The field.
    pub source: FieldSource<'a>,
    /// What is asked for; the factor of the deformed plate is a number.
    pub request: Request,
}

impl Frames for Still<'_> {
    type Error = ShotError;

    fn count(&self) -> usize {
        1
    }

    fn with(&self, _: usize, work: &mut Work<'_, ShotError>) -> Result<(), ShotError> {
        work(self.source, &self.request)
    }
}

impl<'a> Still<'a> {
    /// The frame of a request, deformed by a number if it is.
    ///
    /// # Errors
    /// Fields that are no displacements.
    pub fn new(source: FieldSource<'a>, mut request: Request) -> Result<Self, ShotError> {
        request.scene = source.settled(request.scene)?;
        if let Some(factor) = request.scene.deformed {
            request.scene.deformed = Some(Factor::Given(factor.number(&[source.field])?));
        }
        Ok(Self { source, request })
    }

    /// The page of the image.
    ///
    /// # Errors
    /// As [`page_seen`]; a place that there is not.
    pub fn page(&self, engine: &Engine<'_>) -> Result<(Canvas, Shot), ShotError> {
        let Self { source, request } = self;
        let common = Common::new(self, request)?;
        let seen = common.placing.body(*source, &request.scene, engine)?;
        page_seen(*source, request, &seen, common.design.as_ref(), engine)
    }
}

/// What images have in common, one or those of a series.
pub struct Common<'a> {
    /// Where they are seen.
    pub placing: Placing<'a>,
    /// The look of figures; none of bare images.
    pub design: Option<Design>,
}

impl<'a> Common<'a> {
    /// What the frames of a request have in common, of which there is one at least.
    ///
    /// # Errors
    /// Those of the frames; a size without room.
    pub fn new<F: Frames>(frames: &F, request: &'a Request) -> Result<Self, F::Error> {
        let (mut design, mut aspect) = (Design::pixels(DEFAULT_SIZE), None);
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
        Ok(Self { placing: Placing::new(&request.place, extent, frames)?, design })
    }
}
