//! The window of a desktop.

use std::path::PathBuf;
use std::sync::Arc;

use ppum::dataset::Dataset;

use crate::app::Viewer;
use crate::files::{Files, kept};
use crate::frames::Backend;
use crate::session::Session;
use crate::stage::pixels;

/// How the window begins.
#[derive(Debug, Default)]
pub struct Start {
    /// What is chosen; without it and without files, what was chosen when the last window was closed.
    pub session: Option<Session>,
    /// Files to open: one, or two side by side.
    pub files: Vec<PathBuf>,
    /// Datasets that are open, with their files.
    pub datasets: Vec<(Option<PathBuf>, Arc<Dataset>)>,
    /// Width and height \[points\].
    pub size: Option<[f32; 2]>,
    /// The folder where the window remembers things; none to remember nothing.
    pub folder: Option<PathBuf>,
    /// Memory that is free \[bytes\], for solutions.
    pub memory: Option<fn() -> Option<u64>>,
    /// What computes the values.
    pub backend: Backend,
}

/// The size of a window that nobody has chosen \[points\].
pub const SIZE: [f32; 2] = [1280.0, 800.0];

/// A window that cannot be opened.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WindowError {
    /// Nothing to show it on.
    #[error(
        "there is no display to open a window on ({0}). Over ssh, connect with `ssh -X`; on a machine without one, \
         `ppum view --screenshot OUT.png` and `ppum render` draw into files. With a display, libraries may be missing; on \
         Debian and Ubuntu: apt install libxkbcommon-x11-0 libx11-xcb1 libxcursor1 libxi6 libwayland-client0"
    )]
    NoDisplay(String),
    /// Nothing to draw it with.
    #[error("{NO_DRIVER} ({0})")]
    NoDriver(String),
    /// Anything else.
    #[error("the window cannot be opened: {0}")]
    Other(String),
}

pub(crate) const NO_DRIVER: &str = "there is no graphics driver to draw a window with, and none that computes in software; \
     on Debian and Ubuntu: apt install libvulkan1 mesa-vulkan-drivers";

impl From<eframe::Error> for WindowError {
    fn from(error: eframe::Error) -> Self {
        let words = error.to_string();
        match error {
            eframe::Error::Wgpu(_) => Self::NoDriver(words),
            // before the reason stands the place in winit's sources
            eframe::Error::WinitEventLoop(_) => {
                let reason = words.rsplit(": ").next().unwrap_or_default();
                Self::NoDisplay(reason.trim_end_matches('.').to_owned())
            }
            eframe::Error::AppCreation(_) | eframe::Error::Winit(_) => Self::Other(words),
        }
    }
}

impl Start {
    /// The window before it is shown for the first time.
    #[must_use]
    pub fn viewer(self, ctx: &egui::Context) -> Viewer {
        let is_given =
            self.session.is_some() || !self.files.is_empty() || !self.datasets.is_empty();
        let last = self.folder.as_deref().map(kept::last_session);
        let mut viewer = Viewer::with_backend(ctx, Session::default(), self.backend);
        viewer.files = Files::new(ctx, self.folder.clone());
        viewer.solving.memory = self.memory.unwrap_or(|| None);
        let last = match last {
            Some(Ok(last)) => last,
            Some(Err(error)) => {
                let folder = self.folder.unwrap_or_default();
                let text = format!("what was open the last time is lost: {error}");
                viewer.files.tell(&folder, text, true);
                None
            }
            None => None,
        };
        let session = match (self.session, last) {
            (Some(session), _) => Some(session),
            (None, Some(last)) if is_given => Some(last.look()),
            (None, last) => last,
        };
        if let Some(session) = session {
            viewer.take_session(ctx, session);
        }
        for (path, dataset) in self.datasets {
            viewer.open(path, dataset);
        }
        for (pane, path) in self.files.iter().take(2).enumerate() {
            viewer.open_file(ctx, path, pane);
        }
        viewer
    }
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// No display, no graphics device and no driver that computes in software.
pub fn run(start: Start) -> Result<(), WindowError> {
    let kept = start.folder.as_deref().map(kept::Kept::read).unwrap_or_default();
    let size = start.size.or(kept.size).unwrap_or(SIZE);
    let viewport = egui::ViewportBuilder::default()
        .with_title("ppum")
        .with_app_id("ppum")
        .with_inner_size(size)
        .with_min_inner_size([480.0, 320.0])
        .with_drag_and_drop(true);
    let options = eframe::NativeOptions { viewport, ..Default::default() };
    let create = move |cc: &eframe::CreationContext<'_>| {
        if let Some(state) = &cc.wgpu_render_state {
            pixels::use_device(&cc.egui_ctx, state.target_format);
        }
        Ok(Box::new(start.viewer(&cc.egui_ctx)) as Box<dyn eframe::App>)
    };
    Ok(eframe::run_native("ppum", options, Box::new(create))?)
}
