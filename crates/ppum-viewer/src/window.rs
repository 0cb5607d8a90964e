//! The window of a desktop.

use std::path::PathBuf;
use std::sync::Arc;

use ppum::dataset::Dataset;

use crate::app::Viewer;
use crate::frames::Backend;
use crate::session::Session;

/// How the window begins.
#[derive(Debug, Default)]
pub struct Start {
    /// What is chosen.
    pub session: Session,
    /// Datasets that are open, with their files.
    pub datasets: Vec<(Option<PathBuf>, Arc<Dataset>)>,
    /// Width and height \[points\].
    pub size: Option<[f32; 2]>,
    /// What computes the values.
    pub backend: Backend,
}

/// A window that cannot be opened.
#[derive(Debug, thiserror::Error)]
#[error("the window cannot be opened: {0}")]
pub struct WindowError(String);

/// Opens the window and returns when it is closed.
///
/// # Errors
/// No display, no graphics device and no driver that computes in software.
pub fn run(start: Start) -> Result<(), WindowError> {
    let size = start.size.unwrap_or([1280.0, 800.0]);
    let viewport = egui::ViewportBuilder::default()
        .with_title("ppum")
        .with_app_id("ppum")
        .with_inner_size(size)
        .with_min_inner_size([480.0, 320.0]);
    let options = eframe::NativeOptions { viewport, ..Default::default() };
    let create = move |cc: &eframe::CreationContext<'_>| {
        let mut viewer = Viewer::with_backend(&cc.egui_ctx, start.session, start.backend);
        for (path, dataset) in start.datasets {
            viewer.open(path, dataset);
        }
        Ok(Box::new(viewer) as Box<dyn eframe::App>)
    };
    eframe::run_native("ppum", options, Box::new(create)).map_err(|e| WindowError(e.to_string()))
}
