//! The window, driven by its labels, keys and the mouse.

mod kit;
mod moving;
