//! The window, driven by its labels, keys and the mouse.

/// As in the program.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

mod busy;
mod controls;
mod drawings;
mod files;
mod finding;
mod frames;
mod hands;
mod kit;
mod lab;
mod losses;
mod manners;
mod meshes;
mod minus;
mod moving;
mod plotting;
mod reading;
mod saving;
mod series;
mod sessions;
mod solving;
