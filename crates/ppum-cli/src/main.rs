//! The program `ppum`: that of `ppum_cli`, with graphics cards and the window if it was built with
//! them.

#[cfg(feature = "gpu")]
mod devices;
#[cfg(feature = "window")]
mod window;

use std::process::ExitCode;

use ppum_cli::graphics::Graphics;

/// A window is open for days, and gives memory back.
#[cfg(feature = "window")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    let graphics = Graphics {
        #[cfg(feature = "gpu")]
        cards: Some(devices::CARDS),
        #[cfg(feature = "window")]
        window: Some(window::WINDOW),
        ..Graphics::default()
    };
    ppum_cli::run(std::env::args_os(), graphics).into()
}
