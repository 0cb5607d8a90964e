//! The window, driven by its labels, keys and the mouse.

mod controls;
mod kit;
mod moving;
mod plotting;
mod reading;
