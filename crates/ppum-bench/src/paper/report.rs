//! The measured results.

use serde::Serialize;

use super::files::OpeningTime;
use super::scenes::SceneGroup;
use super::turns::FrameTiming;
use crate::machine::Machine;

/// The report of `ppum-bench paper`.
#[derive(Debug, Serialize)]
pub struct PaperReport {
    pub(super) machine: Machine,
    pub(super) pixels: [u32; 2],
    pub(super) frames: u32,
    pub(super) rows: Vec<SceneRow>,
    pub(super) files: Vec<OpeningTime>,
    /// True if all frames are right, and all controls caught.
    pub(super) holds: bool,
}

/// A scene.
#[derive(Debug, Serialize)]
pub(super) struct SceneRow {
    pub(super) group: SceneGroup,
    pub(super) scene: String,
    pub(super) cover: &'static str,
    pub(super) patches: usize,
    pub(super) order: u8,
    pub(super) enriched: f64,
    pub(super) zoom: f64,
    pub(super) quantity: &'static str,
    /// The paper's time, milliseconds on a GeForce GTX 470.
    pub(super) paper_ms: Option<f64>,
    pub(super) methods: Vec<FrameTiming>,
}

/// Columns and rows of the images.
pub(super) fn pixels_of(quick: bool) -> [u32; 2] {
    if quick { [256, 192] } else { [1024, 768] }
}
