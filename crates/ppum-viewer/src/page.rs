//! Pages for browsers: what a view shows, with its dataset and what evaluates it, in one file.

use std::path::Path;
use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum_page::{LARGEST, PageStart, PageView, html};
use ppum_render::view::View;
use ppum_scene::overlays::Overlay;
use ppum_scene::scene::{SceneRequest, Subject};

use crate::frames::RenderedFrame;
use crate::save_target::replace;

/// A page that is to be written: the same as `ppum export` writes.
#[derive(Debug)]
pub struct PageOrder {
    dataset: Arc<Dataset>,
    start: PageStart,
}

const NO_IMAGE: &str = "there is no image yet";
const NO_DIFFERENCE: &str = "a page is of one view: switch the difference off (Shift+V)";
const NO_SUBJECT: &str =
    "a page shows the whole field with the functions of its file: choose these";

impl PageOrder {
    /// The page of an image of a dataset's file, of the whole body if it has no view.
    ///
    /// # Errors
    /// The features, in words, that pages do not have.
    pub(crate) fn new(
        frame: Option<&Arc<RenderedFrame>>,
        mut scene: SceneRequest,
        view: Option<View>,
        file: Option<&Path>,
    ) -> Result<Self, String> {
        let frame = frame.ok_or(NO_IMAGE)?;
        if frame.left.is_some() {
            return Err(NO_DIFFERENCE.into());
        }
        if (Subject { step: scene.subject.step, ..Subject::default() }) != scene.subject {
            return Err(NO_SUBJECT.into());
        }
        scene.overlays.no_cracks = !scene.overlays.shown.contains(&Overlay::Cracks);
        let name = file.and_then(Path::file_name);
        let name = name.map_or("dataset.h5".into(), |name| name.display().to_string());
        let field = (&**frame.field.dataset(), frame.field.field());
        let start = PageStart::new(scene, field, view.map(PageView::from), name);
        let start = start.map_err(|error| error.to_string())?;
        Ok(Self { dataset: Arc::clone(&frame.request.dataset), start })
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
        replace(path, page.as_bytes()).map_err(|error| error.to_string())
    }
}
