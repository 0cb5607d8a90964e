//! The program `ppum`: that of `ppum_cli`, with graphics cards and the window if it was built with
//! them.

#[cfg(feature = "gpu")]
mod devices;
#[cfg(feature = "window")]
mod window;

use std::process::ExitCode;

use ppum_cli::graphics::{Cards, Graphics, Window};

/// A window is open for days, and gives memory back.
#[cfg(feature = "window")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

#[cfg(feature = "gpu")]
const CARDS: Option<Cards> = Some(devices::CARDS);
#[cfg(not(feature = "gpu"))]
const CARDS: Option<Cards> = None;

#[cfg(feature = "window")]
const WINDOW: Option<Window> = Some(window::WINDOW);
#[cfg(not(feature = "window"))]
const WINDOW: Option<Window> = None;

fn main() -> ExitCode {
    ppum_cli::run(std::env::args_os(), Graphics { cards: CARDS, window: WINDOW }).into()
}
