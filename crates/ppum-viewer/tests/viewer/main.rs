//! The window, driven by its labels, keys and the mouse.

mod controls;
mod files;
mod frames;
mod hands;
mod kit;
mod lab;
mod manners;
mod minus;
mod moving;
mod plotting;
mod reading;
mod saving;
mod series;
mod sessions;
mod solving;
