//! What lies over a picture.

use std::sync::Arc;

use ppum::progress::Watcher;
use ppum_scene::body::BodyView;
use ppum_scene::drawing::Drawn;
use ppum_scene::layers::Ground;
use ppum_scene::overlays::Overlays;

use super::laid::Laid;
use super::memo::{Memo, Same};
use super::paint::Painted;
use super::subject::SubjectView;
use super::{Failure, Fault, Wanted};

/// What layers are made from: of the picture below no more than they see of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Below {
    target: SubjectView,
    overlays: Overlays,
    outline: bool,
    /// Isolines have levels of the picture's range, and labels that stand out from its colours.
    picture: Option<Same<Painted>>,
}

impl Below {
    pub(super) fn new(wanted: &Wanted, target: &SubjectView, picture: &Arc<Painted>) -> Self {
        let scene = &wanted.scene;
        let picture = scene.overlays.isolines.is_some().then(|| Same::of(picture));
        let (target, overlays) = (target.clone(), scene.overlays.clone());
        Self { target, overlays, outline: scene.outline, picture }
    }
}

/// Draws layers, and keeps the last ones.
#[derive(Default)]
pub(super) struct LayerCache {
    pub(super) layers: Memo<Below, Arc<Laid>>,
}

impl LayerCache {
    /// The layers of what is wanted.
    pub(super) fn draw(
        &mut self,
        wanted: &Wanted,
        target: &SubjectView,
        (drawn, picture, seen): (&Drawn, &Arc<Painted>, &BodyView<'_>),
        watcher: &dyn Watcher,
    ) -> Result<Arc<Laid>, Failure> {
        let input = target.subject.input(seen);
        let scene = &wanted.scene;
        self.layers.get_or(Below::new(wanted, target, picture), || {
            let ground = Ground { has_bar: true, ..input.ground(picture, &drawn.values) };
            let layers = input.layers(scene, ground, watcher);
            let size = picture.view.pixels;
            let laid = layers.map(|layers| Arc::new(Laid::new(layers, size)));
            laid.map_err(Failure::at(Fault::Overlays))
        })
    }
}
