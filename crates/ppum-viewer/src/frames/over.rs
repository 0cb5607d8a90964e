//! Layers over an image.

use std::sync::Arc;

use ppum::progress::Watcher;
use ppum_scene::body::BodyView;
use ppum_scene::drawing::PixelValues;
use ppum_scene::layers::LayerInput;
use ppum_scene::overlays::Overlays;

use super::memo::{Memo, SameArc};
use super::overlay_shapes::OverlayShapes;
use super::paint::ColoredImage;
use super::subject::SubjectView;
use super::{FaultOrigin, FrameRequest, ImageFailure};

/// The input of layers, with no more of the image below than they depend on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LayerBase {
    target: SubjectView,
    overlays: Overlays,
    outline: bool,
    /// Isolines have levels of the image's range, and labels that stand out from its colours.
    picture: Option<SameArc<ColoredImage>>,
}

impl LayerBase {
    pub(super) fn new(
        wanted: &FrameRequest,
        target: &SubjectView,
        picture: &Arc<ColoredImage>,
    ) -> Self {
        let scene = &wanted.scene;
        let picture = scene.overlays.isolines.is_some().then(|| SameArc::of(picture));
        let (target, overlays) = (target.clone(), scene.overlays.clone());
        Self { target, overlays, outline: scene.outline, picture }
    }
}

/// Draws layers, and keeps the last ones.
#[derive(Default)]
pub(super) struct LayerCache {
    pub(super) layers: Memo<LayerBase, Arc<OverlayShapes>>,
}

impl LayerCache {
    /// The layers of what is wanted.
    pub(super) fn draw(
        &mut self,
        wanted: &FrameRequest,
        target: &SubjectView,
        (drawn, picture, seen): (&PixelValues, &Arc<ColoredImage>, &BodyView<'_>),
        watcher: &dyn Watcher,
    ) -> Result<Arc<OverlayShapes>, ImageFailure> {
        let input = target.subject.input(seen);
        let scene = &wanted.scene;
        self.layers.get_or(LayerBase::new(wanted, target, picture), || {
            let ground = LayerInput { has_bar: true, ..input.ground(picture, &drawn.values) };
            let layers = input.layers(scene, ground, watcher);
            let size = picture.view.pixels;
            let laid = layers.map(|layers| Arc::new(OverlayShapes::new(layers, size)));
            laid.map_err(ImageFailure::at(FaultOrigin::Overlays))
        })
    }
}
