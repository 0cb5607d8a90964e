//! The window of `ppum view`.

use ppum_cli::graphics::{Window, WindowRequest};
use ppum_viewer::files::window_state::folder;
use ppum_viewer::offscreen::screenshot;
use ppum_viewer::window::{self, WindowStart};

/// Opening it, and drawing it into an image.
pub(crate) const WINDOW: Window = Window {
    open: |request| Ok(window::run(start(request))?),
    screenshot: |request| Ok(screenshot(start(request))?),
};

fn start(request: WindowRequest) -> WindowStart {
    WindowStart {
        files: request.files,
        size: request.size.map(|size| size.map(|n| n as f32)),
        backend: request.backend,
        folder: folder(),
        memory: Some(request.free_memory),
        ..WindowStart::default()
    }
}
