//! A window with a folder of its own for files and for what it remembers.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui_kittest::Harness;
use ppum::dataset::Dataset;
use ppum_viewer::Viewer;
use ppum_viewer::window::WindowStart;
use tempfile::TempDir;

use crate::kit::show_until;

/// A window with a folder.
pub(crate) struct Lab {
    pub(crate) folder: TempDir,
    pub(crate) window: Harness<'static, Viewer>,
}

impl Lab {
    /// A window in which nothing is open.
    pub(crate) fn new() -> Self {
        Self::with(|_| WindowStart::default())
    }

    /// A window that begins with what `start` makes of the folder.
    pub(crate) fn with(start: impl FnOnce(&Path) -> WindowStart) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let start = start(folder.path());
        let window = Self::window(folder.path(), start);
        let mut lab = Self { folder, window };
        lab.settle();
        lab
    }

    fn window(folder: &Path, start: WindowStart) -> Harness<'static, Viewer> {
        let start = WindowStart { folder: Some(folder.join("config")), ..start };
        // names of files and what is written may have letters that no font has
        let builder = Harness::builder().with_size([1000.0, 700.0]).with_max_steps(1000);
        let builder = builder.allow_missing_glyphs();
        builder.build_eframe(|cc| start.viewer(&cc.egui_ctx))
    }

    /// Closes the window and opens it again, as on the next day.
    pub(crate) fn reopen(&mut self, start: WindowStart) {
        self.begin_again(start);
        self.settle();
    }

    /// The same, without waiting for what it shows.
    pub(crate) fn begin_again(&mut self, start: WindowStart) {
        self.state().leave();
        self.window = Self::window(self.folder.path(), start);
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Writes a dataset to a file.
    pub(crate) fn write(&self, name: &str, dataset: &Dataset) -> PathBuf {
        let path = self.path(name);
        ppum_format::write(dataset, &path).expect("it can be written");
        path
    }

    pub(crate) fn viewer(&self) -> &Viewer {
        self.window.state()
    }

    /// Returns the pane, to be changed.
    pub(crate) fn state(&mut self) -> &mut Viewer {
        self.window.state_mut()
    }

    /// Opens a file as the menus do, and waits for it.
    pub(crate) fn open(&mut self, path: &Path) {
        let ctx = self.window.ctx.clone();
        self.state().open_file(&ctx, path, 0);
        self.settle();
    }

    /// Shows pictures until nothing is read, written, solved or drawn.
    pub(crate) fn settle(&mut self) {
        self.until("the window comes to rest", |viewer| !viewer.is_working());
        self.window.step();
    }

    /// Shows pictures until something is so.
    pub(crate) fn until(&mut self, what: &str, mut is_so: impl FnMut(&Viewer) -> bool) {
        show_until(&mut self.window, what, |window| is_so(window.state()));
    }

    /// The dataset of a pane.
    pub(crate) fn dataset(&self, pane: usize) -> Option<Arc<Dataset>> {
        let opened = self.window.state().viewports[pane].opened.as_ref();
        opened.map(|opened| Arc::clone(&opened.dataset))
    }

    /// What is told of files, all of it.
    pub(crate) fn notes(&self) -> String {
        let notes = self.window.state().files.notes.iter();
        notes.map(|note| note.text.clone()).collect::<Vec<_>>().join("\n")
    }
}

/// Keeps a picture of the window where `PPUM_SHOTS` says, for eyes.
pub(crate) fn shot(lab: &mut Lab, name: &str) {
    if let Some(folder) = std::env::var_os("PPUM_SHOTS") {
        let image = lab.window.render().expect("it can be drawn");
        image.save(Path::new(&folder).join(format!("{name}.png"))).expect("it can be written");
    }
}
