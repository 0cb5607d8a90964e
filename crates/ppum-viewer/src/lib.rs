//! The window: explore datasets interactively, exactly at every pixel, down to the tip.
//!
//! What a person chooses is a [`Session`](session::Session), plain data. Each frame of the window the session says what is
//! wanted of each [`Pane`](session::Pane), [`Frames`](frames::Frames) computes it in the background by `ppum-scene`, and the
//! [`stage`] shows the newest picture there is. Panels change the session and nothing else; what a key, a menu or the
//! palette does is one [`Action`](actions::Action). Nothing here draws a field: the window is a loop around what
//! `ppum render` does.

pub mod actions;
pub mod app;
pub mod controls;
pub mod desk;
pub mod export;
pub mod field;
pub mod files;
pub mod fonts;
pub mod frames;
pub mod job;
pub mod offscreen;
pub mod panels;
pub mod plate;
pub mod player;
pub mod reading;
pub mod replacing;
pub mod session;
pub mod shapes;
pub mod solving;
pub mod spot;
pub mod stage;
pub mod surface;
pub mod undo;
pub mod widgets;
pub mod window;

pub use app::Viewer;

#[cfg(test)]
mod tests {
    use std::path::Path;

    use ppum_testkit::rooms::{Floors, check, check_page};

    const FLOORS: Floors<'_> = &[
        &[
            ("field", &[]),
            ("fonts", &[]),
            ("job", &[]),
            ("replacing", &[]),
            ("shapes", &[]),
            ("spot", &[]),
            ("undo", &[]),
        ],
        &[
            ("export", &["field"]),
            ("frames", &["field"]),
            ("session", &["spot"]),
            ("widgets", &["shapes"]),
        ],
        &[
            ("files", &["job", "replacing", "session"]),
            ("plate", &["session"]),
            ("reading", &["field", "frames", "job", "replacing", "session", "spot"]),
            ("solving", &["job", "session"]),
        ],
        &[
            ("actions", &["export", "reading", "session"]),
            ("controls", &["field", "frames", "plate", "session", "shapes", "widgets"]),
        ],
        &[(
            "stage",
            &[
                "controls", "field", "frames", "plate", "reading", "session", "shapes", "spot",
                "undo", "widgets",
            ],
        )],
        &[("player", &["session", "stage"])],
        &[("desk", &["actions", "files", "player", "session", "solving", "stage"])],
        &[(
            "panels",
            &[
                "actions",
                "controls",
                "desk",
                "export",
                "field",
                "files",
                "frames",
                "job",
                "player",
                "reading",
                "replacing",
                "session",
                "shapes",
                "solving",
                "stage",
                "widgets",
            ],
        )],
        &[(
            "app",
            &[
                "actions", "controls", "desk", "export", "files", "fonts", "frames", "panels",
                "plate", "player", "session", "solving", "stage", "undo", "widgets",
            ],
        )],
        &[("surface", &["stage"]), ("window", &["app", "files", "frames", "session", "stage"])],
        &[("offscreen", &["app", "surface", "window"])],
    ];

    #[test]
    fn arrows_lead_down() {
        let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        check(&sources, FLOORS);
        check_page(&sources, env!("CARGO_PKG_NAME"), FLOORS);
    }

    #[test]
    fn errors_cross_threads() {
        fn check<E: std::error::Error + Send + Sync + 'static>() {}
        check::<super::window::WindowError>();
    }
}
