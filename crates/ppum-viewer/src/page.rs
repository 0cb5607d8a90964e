//! Pages for browsers: what a view shows, with its dataset and what evaluates it, in one file.

use std::path::Path;
use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum_page::{LARGEST, PageStart, PageView, html};
use ppum_scene::overlays::Overlay;
use ppum_scene::scene::Subject;
use ppum_scene::shot::FieldSource;

use crate::files::window_state::replace;
use crate::session::Pane;
use crate::stage::ViewPane;

/// A page that is to be written: the same as `ppum export` writes.
pub(crate) struct PageOrder {
    dataset: Arc<Dataset>,
    start: PageStart,
}

const NO_PICTURE: &str = "there is no picture yet";
const NO_DIFFERENCE: &str = "a page is of one view: switch the difference off (Shift+V)";
const NO_SUBJECT: &str =
    "a page shows the whole field with the functions of its file: choose these";

impl PageOrder {
    /// The page of what a pane shows.
    ///
    /// # Errors
    /// The features, in words, that pages do not have.
    pub(crate) fn new(pane: &Pane, stage: &ViewPane) -> Result<Self, String> {
        let frame = stage.frame().ok_or(NO_PICTURE)?;
        if frame.left().is_some() {
            return Err(NO_DIFFERENCE.into());
        }
        let mut scene = pane.scene.clone();
        if (Subject { step: scene.subject.step, ..Subject::default() }) != scene.subject {
            return Err(NO_SUBJECT.into());
        }
        scene.overlays.no_cracks = !scene.overlays.shown.contains(&Overlay::Cracks);
        let view = stage.view.filter(|_| pane.place.is_some());
        let view = view.map(PageView::from);
        let path = stage.opened.as_ref().and_then(|opened| opened.path.as_deref());
        let file = path.map_or("dataset.h5".to_owned(), crate::files::name);
        let source = FieldSource::of(frame.field.dataset(), frame.field.field());
        let start = PageStart::new(scene, source, view, file);
        let start = start.map_err(|error| error.to_string())?;
        Ok(Self { dataset: Arc::clone(&frame.wanted.dataset), start })
    }

    /// Writes it.
    ///
    /// # Errors
    /// A dataset that is too large for a page, or a file that cannot be written, in words.
    pub(crate) fn write(&self, path: &Path) -> Result<(), String> {
        let bytes = ppum_format::to_bytes(&self.dataset).map_err(|error| error.to_string())?;
        if bytes.len() as u64 > LARGEST {
            return Err(format!("pages hold datasets of up to {} MiB", LARGEST >> 20));
        }
        let page = html(&bytes, self.start.title(&self.dataset), &self.start);
        let page = page.map_err(|error| error.to_string())?;
        replace(path, &page).map_err(|error| error.to_string())
    }
}
