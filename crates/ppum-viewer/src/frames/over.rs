//! What lies over a picture.

use std::sync::Arc;

use ppum::progress::Watcher;
use ppum_scene::drawing::{Drawn, Seen};
use ppum_scene::layers::Ground;
use ppum_scene::overlays::Overlays;

use super::laid::Laid;
use super::memo::{Memo, Same};
use super::paint::Painted;
use super::stop::Stop;
use super::subject::Place;
use super::{Fault, Wanted};

/// What layers are made from: of the picture below no more than they see of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Below {
    place: Place,
    overlays: Overlays,
    outline: bool,
    /// Isolines have levels of the picture's range, and labels that stand out from its colours.
    picture: Option<Same<Painted>>,
}

impl Below {
    pub(super) fn new(wanted: &Wanted, place: &Place, picture: &Arc<Painted>) -> Self {
        let scene = &wanted.scene;
        let picture = scene.overlays.isolines.is_some().then(|| Same::of(picture));
        let (place, overlays) = (place.clone(), scene.overlays.clone());
        Self { place, overlays, outline: scene.outline, picture }
    }
}

/// Draws layers, and keeps the last ones.
#[derive(Default)]
pub(super) struct Over {
    pub(super) layers: Memo<Below, Arc<Laid>>,
}

impl Over {
    /// The layers of what is wanted.
    pub(super) fn draw(
        &mut self,
        wanted: &Wanted,
        place: &Place,
        (drawn, picture, seen): (&Drawn, &Arc<Painted>, &Seen<'_>),
        watcher: &dyn Watcher,
    ) -> Result<Arc<Laid>, Stop> {
        let ground = Ground {
            dataset: &wanted.dataset,
            field: place.subject.field.0.field(),
            // isolines are found of one field
            quantity: place.subject.shown.0.quantity().filter(|_| place.subject.minus.is_none()),
            picture,
            values: &drawn.values,
            design: None,
            has_bar: true,
        };
        let scene = &wanted.scene;
        self.layers.get_or(Below::new(wanted, place, picture), || {
            let layers = scene.overlays.layers(ground, seen, scene.outline, watcher);
            let size = picture.view.pixels;
            let laid = layers.map(|layers| Arc::new(Laid::new(layers, size)));
            laid.map_err(Stop::at(Fault::Overlays))
        })
    }
}
