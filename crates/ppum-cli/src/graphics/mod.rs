//! Graphics cards and the window, all that the program knows of them; it may be built without.

mod adapter;

use std::path::PathBuf;
use std::sync::OnceLock;

use ppum_render::image::Image;
use ppum_scene::backend::Backend;
use ppum_scene::engine::DrawOnCard;

pub use adapter::Adapter;

/// The drawing devices of a program, and its window.
#[derive(Clone, Copy, Debug, Default)]
pub struct Graphics {
    /// Graphics cards; without them the processor draws.
    pub cards: Option<Cards>,
    /// The window.
    pub window: Option<Window>,
}

/// Drawing on graphics cards.
#[derive(Clone, Copy, Debug)]
pub struct Cards {
    /// Draws the values of a view.
    pub draw: DrawOnCard,
    /// The graphics adapters of this machine; opens what each backend would open.
    pub adapters: fn() -> Vec<Adapter>,
}

/// The window of `ppum view`.
#[derive(Clone, Copy, Debug)]
pub struct Window {
    /// Opens it, and returns when it is closed.
    pub open: fn(WindowRequest) -> anyhow::Result<()>,
    /// Draws it once it is complete; no display is needed.
    pub screenshot: fn(WindowRequest) -> anyhow::Result<Image>,
}

/// The window that is asked for.
#[derive(Debug)]
pub struct WindowRequest {
    /// Datasets, problem files or a session.
    pub files: Vec<PathBuf>,
    /// Width and height in points; those of the last time if there are none.
    pub size: Option<[u32; 2]>,
    /// The device that computes.
    pub backend: Backend,
    /// Asks for the bytes of memory that are free, if the system tells.
    pub free_memory: fn() -> Option<u64>,
}

static GRAPHICS: OnceLock<Graphics> = OnceLock::new();

/// Keeps what the program was built with; once a process.
pub(crate) fn have(graphics: Graphics) {
    // a second call in one process finds the same
    let _ = GRAPHICS.set(graphics);
}

/// Returns what the program was built with.
pub(crate) fn graphics() -> Graphics {
    GRAPHICS.get().copied().unwrap_or_default()
}

/// The answer of `ppum info --gpu` where there is no adapter.
pub(crate) fn missing() -> &'static str {
    if graphics().cards.is_some() { NO_DRIVER } else { NOT_BUILT }
}

const NO_DRIVER: &str = "\
no graphics adapter: this machine has no Vulkan, Metal or Direct3D 12 driver that this program can use.
Pictures are drawn on the CPU, which is exact and quick. For drawing on a graphics card install its driver;
for trying out --backend gpu without a card a software driver does:
  Debian, Ubuntu   apt-get install libvulkan1 mesa-vulkan-drivers
  Fedora           dnf install vulkan-loader mesa-vulkan-drivers
  Arch             pacman -S vulkan-icd-loader vulkan-swrast";

const NOT_BUILT: &str = "\
no graphics adapter: this program was built without graphics cards; build it with
`cargo install --locked --path crates/ppum-cli --features window` (or `--features gpu`, without the window).
Images are drawn on the CPU instead, the same to rounding.";
