//! The window of a desktop.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Duration;

use eframe::egui_wgpu::wgpu;
use ppum::dataset::Dataset;

use crate::app::{Viewer, closing};
use crate::files::{WindowFiles, window_state};
use crate::frames::Backend;
use crate::session::Session;
use crate::viewport::pixels;

/// How the window begins.
#[derive(Debug, Default)]
pub struct WindowStart {
    /// The session; without it and without files, what was chosen when the last window was closed.
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
    /// The backend that computes the values.
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
    /// The device that draws it has failed.
    #[error(
        "the graphics device has failed ({0}), and the window with it. What was chosen is kept: `ppum view` opens as it was; \
         if it fails again, draw into files with `ppum view --screenshot OUT.png` or `ppum render`"
    )]
    Lost(String),
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

impl WindowStart {
    /// The window before it is shown for the first time.
    #[must_use]
    pub fn viewer(self, ctx: &egui::Context) -> Viewer {
        let is_given =
            self.session.is_some() || !self.files.is_empty() || !self.datasets.is_empty();
        let last = self.folder.as_deref().map(window_state::last_session);
        let mut viewer = Viewer::with_backend(ctx, Session::default(), self.backend);
        viewer.files = WindowFiles::new(ctx, self.folder.clone());
        viewer.solving.memory = self.memory.unwrap_or(|| None);
        let last = match last {
            Some(Ok(last)) => last,
            Some(Err(error)) => {
                let folder = self.folder.unwrap_or_default();
                viewer.files.tell(&folder, error, true);
                None
            }
            None => None,
        };
        // the changed text of the last time is shown again, or put aside
        let text = last.as_ref().and_then(|last| last.draft.clone());
        match text {
            Some(text) if is_given => viewer.files.put_aside(text),
            Some(text) => viewer.files.release(&text),
            None => {}
        }
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
pub fn run(start: WindowStart) -> Result<(), WindowError> {
    let kept = start.folder.as_deref().map(window_state::WindowState::read).unwrap_or_default();
    let size = start.size.or(kept.size).unwrap_or(SIZE);
    let viewport = egui::ViewportBuilder::default()
        .with_title("ppum")
        .with_app_id("ppum")
        .with_inner_size(size)
        .with_min_inner_size([480.0, 320.0])
        .with_drag_and_drop(true);
    let options = eframe::NativeOptions { viewport, ..Default::default() };
    let failure = DeviceFailure::default();
    let heard = failure.clone();
    let create = move |cc: &eframe::CreationContext<'_>| {
        if let Some(state) = &cc.wgpu_render_state {
            pixels::use_device(&cc.egui_ctx, state.target_format);
            heard.listen(&cc.egui_ctx, &state.device);
        }
        Ok(Box::new(start.viewer(&cc.egui_ctx)) as Box<dyn eframe::App>)
    };
    let shown = || eframe::run_native("ppum", options, Box::new(create));
    // egui panics on a device that has failed
    let closed = catch_unwind(AssertUnwindSafe(shown));
    match (failure.reason(), closed) {
        (Some(reason), _) => Err(WindowError::Lost(reason)),
        (None, Ok(closed)) => Ok(closed?),
        (None, Err(_)) if !failure.has_memory() => Err(WindowError::Lost(SILENT.into())),
        (None, Err(panic)) => resume_unwind(panic),
    }
}

/// The reason for a device that gives none.
const SILENT: &str = "it has no memory any more";

/// A device that answers no sooner has failed.
const PATIENCE: Duration = Duration::from_secs(2);

/// Why the device draws no more.
#[derive(Clone, Default)]
struct DeviceFailure {
    reason: Arc<Mutex<Option<String>>>,
    device: Arc<OnceLock<wgpu::Device>>,
}

impl DeviceFailure {
    /// Closes the window when its device fails, which would end the program otherwise.
    fn listen(&self, ctx: &egui::Context, device: &wgpu::Device) {
        self.device.get_or_init(|| device.clone());
        let (told, wake) = (self.clone(), ctx.clone());
        device.set_device_lost_callback(move |reason, words| {
            // so it ends when the window is closed
            if reason != wgpu::DeviceLostReason::Destroyed {
                told.tell(&wake, &words);
            }
        });
        let (told, wake) = (self.clone(), ctx.clone());
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            told.tell(&wake, &error.to_string());
        }));
    }

    /// The first reason is the one: others follow from it.
    fn tell(&self, ctx: &egui::Context, words: &str) {
        let mut reason = self.reason.lock().unwrap_or_else(PoisonError::into_inner);
        let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
        reason.get_or_insert(words);
        closing::let_go(ctx);
    }

    /// True if the device still gives memory: one that was lost may tell nothing at all.
    fn has_memory(&self) -> bool {
        let Some(device) = self.device.get() else { return true };
        let some = wgpu::BufferDescriptor {
            label: None,
            size: 4,
            usage: wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: true,
        };
        let gives = || device.create_buffer(&some).slice(..).get_mapped_range().is_ok();
        catch_unwind(AssertUnwindSafe(gives)).unwrap_or(false)
    }

    /// The reason, if there is one: the device is asked, which may not have told it yet.
    fn reason(&self) -> Option<String> {
        let wait = wgpu::PollType::Wait { submission_index: None, timeout: Some(PATIENCE) };
        let failed = self.device.get().and_then(|device| device.poll(wait).err());
        let failed = failed.map(|error| error.to_string());
        self.reason.lock().unwrap_or_else(PoisonError::into_inner).clone().or(failed)
    }
}
