//! Where the frames of an image or an animation are seen, deformed or not.

use ppum::vec2::Rect;
use ppum_figure::figure::FigureStyle;
use ppum_render::deform::{Deformation, DeformedView};

use crate::body::BodyView;
use crate::deformed::Magnification;
use crate::engine::Engine;
use crate::layers::scale;
use crate::moving::{FrameSource, FrameView};
use crate::place::{ImageExtent, PlaceError, ViewRegion};
use crate::request::Request;
use crate::scene::SceneRequest;
use crate::shot::{FieldSource, ImageError};

/// Where bodies are seen, one or those of a series.
pub struct CameraChoice<'a> {
    place: &'a ViewRegion,
    extent: ImageExtent,
    /// The factor of deformed bodies, and what of the plane is seen of them without a window.
    deformed: Option<(f64, Rect)>,
}

/// The extent of an image of so many pixels: a figure of a design, or bare without one. A figure
/// centres what it is given; a bare image has the size that was asked for, if one was.
#[must_use]
pub fn extent(request: &Request, design: Option<&FigureStyle>, pixels: [u32; 2]) -> ImageExtent {
    let may_shrink = design.is_some() || request.look.given_size().is_none();
    let margin = request.scene.overlays.margin(pixels, scale(design, pixels));
    ImageExtent { pixels, may_shrink, margin }
}

impl<'a> CameraChoice<'a> {
    /// Where all frames are seen, whose factor is a number if they are deformed.
    ///
    /// # Errors
    /// Those of the frames.
    pub fn new<F: FrameSource>(
        place: &'a ViewRegion,
        extent: ImageExtent,
        frames: &F,
    ) -> Result<Self, F::Error> {
        let mut factor = None;
        frames.with(0, &mut |_, request| {
            factor = request.scene.deformed;
            Ok(())
        })?;
        let deformed = match factor {
            Some(Magnification::Given(factor)) => frames.bounds()?.map(|bounds| (factor, bounds)),
            _ => None,
        };
        Ok(Self { place, extent, deformed })
    }

    /// Returns the visible part of a field.
    ///
    /// # Errors
    /// A place that the field does not have; a watcher that stops it.
    pub fn body<'f>(
        &self,
        source: FieldSource<'f>,
        scene: &SceneRequest,
        engine: &Engine<'_>,
    ) -> Result<BodyView<'f>, ImageError> {
        let Some((factor, bounds)) = self.deformed else {
            let (lines, field) = (source.lines(scene)?, source.field);
            let whole = lines.whole(field.domain.bounds);
            let view = self.place.seen(whole, field, self.extent)?;
            return Ok(BodyView::new(field, view, lines));
        };
        source.moved(scene, &self.moved(source, factor, bounds)?, engine)
    }

    /// The view of a deformed body. Windows are places of the deformed plane; that around a tip
    /// follows it.
    fn moved<'f>(
        &self,
        FieldSource { field, .. }: FieldSource<'f>,
        factor: f64,
        bounds: Rect,
    ) -> Result<DeformedView<'f>, ImageError> {
        let deformation = Deformation::new(field, factor)?;
        let view = self.place.over(bounds, field, self.extent)?;
        if let Some(tip) = self.place.tip(field)? {
            return Ok(deformation.around(tip, view.width, view.pixels)?);
        }
        if !view.rect().overlaps(&bounds) {
            return Err(PlaceError::OutsideDeformed(bounds).into());
        }
        Ok(deformation.seen(&view))
    }
}

impl<E: From<ImageError>> FrameView<E> for CameraChoice<'_> {
    fn seen<'f>(
        &self,
        source: FieldSource<'f>,
        request: &Request,
        engine: &Engine<'_>,
    ) -> Result<BodyView<'f>, E> {
        Ok(self.body(source, &request.scene, engine)?)
    }
}
