//! The window: explore datasets interactively, exactly at every pixel, down to the tip.
//!
//! The user's choices are a [`Session`](session::Session), plain data. Each frame of the window the
//! session says what is wanted of each [`Pane`](session::Pane), [`PaneFrames`](frames::PaneFrames)
//! computes it in the background by `ppum-scene`, and the [`viewport`] shows the newest image there
//! is. Panels change the session and nothing else; what a key, a menu or the palette does is one
//! [`Action`](actions::Action). Nothing here draws a field: the window is a loop around what
//! `ppum render` does.

pub mod actions;
pub mod app;
pub mod camera;
pub mod controls;
pub mod export;
pub mod field;
pub mod files;
pub mod fonts;
pub mod frames;
pub mod job;
pub mod measure;
pub mod memo;
pub mod offscreen;
mod page;
pub mod panel_context;
pub mod panels;
pub mod player;
pub mod query;
pub mod same_arc;
pub mod save_target;
pub mod session;
pub mod shapes;
pub mod solving;
pub mod surface;
pub mod undo;
pub mod viewport;
pub mod widgets;
pub mod window;

pub use app::Viewer;

#[cfg(test)]
ppum_testkit::errors_cross_threads!(window::WindowError);
