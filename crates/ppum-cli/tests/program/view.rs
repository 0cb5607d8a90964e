//! `ppum view`: what is refused before a window opens, and pictures of the window without a
//! display.

use crate::Lab;

#[cfg(not(feature = "window"))]
#[test]
fn a_program_without_the_window_says_how_to_get_it() {
    let complaint = Lab::new().fail("view plate.h5");
    assert!(complaint.contains("--features window"), "{complaint}");
}

#[test]
fn sizes_that_no_window_has_are_refused() {
    for size in ["0x0", "800", "800x", "1e3x800", "100x100", "99999x800"] {
        let complaint = Lab::new().fail(&format!("view --size {size}"));
        assert!(complaint.contains("like 1280x800"), "{size}: {complaint}");
    }
}

#[cfg(feature = "window")]
mod with_it {
    use std::process::Command;

    use ppum_testkit::skipped::skipped;

    use crate::{Lab, Png, sound};

    const NO_DRIVER: &str = "there is no graphics driver";

    /// The program in a folder, with settings of its own and without a display.
    fn command(lab: &Lab, arguments: &str) -> Command {
        let mut command = lab.command(arguments);
        command.env("PPUM_CONFIG", lab.path("config"));
        for display in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
            command.env_remove(display);
        }
        command
    }

    fn complaint(lab: &Lab, arguments: &str) -> String {
        let output = command(lab, arguments).output().unwrap();
        let complaint = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments}: {complaint}");
        complaint
    }

    #[test]
    fn without_a_display_it_says_what_to_do() {
        let complaint = complaint(&Lab::new(), "view");
        assert!(complaint.starts_with("error: there is no display"), "{complaint}");
        assert!(complaint.contains("--screenshot") && complaint.contains("apt install"));
    }

    #[test]
    fn what_cannot_be_shown_is_an_error_and_no_picture() {
        let lab = Lab::new();
        lab.write("bad.h5", "no dataset");
        lab.write("bad.ppum-session", "{}");
        for (arguments, reason) in [
            ("view none.h5 --screenshot a.png", "cannot read none.h5"),
            ("view bad.h5 --screenshot a.png", "bad.h5 cannot be read"),
            ("view --session bad.ppum-session --screenshot a.png", "no session of ppum"),
            ("view bad.h5 --screenshot a.pdf", "is a PNG file"),
            ("view bad.h5 --screenshot bad.h5", "is a PNG file"),
            ("view bad.h5 --screenshot none/a.png", "none/a.png"),
        ] {
            let complaint = complaint(&lab, arguments);
            if complaint.contains(NO_DRIVER) {
                return skipped(&complaint);
            }
            assert!(complaint.contains(reason), "{arguments}: {complaint}");
        }
        assert_eq!(lab.files(), ["bad.h5", "bad.ppum-session"]);
    }

    /// The middle of the window has the colour that `render` gives it; nothing is remembered for a
    /// picture.
    #[test]
    fn the_picture_of_a_session_is_that_of_render() {
        let lab = Lab::solved(&sound());
        let scene = r#"{"quantity": "syy", "colors": {"range": "0,2", "colormap": "viridis"}}"#;
        let pane = format!(r#"{{"file": "plate.h5", "scene": {scene}}}"#);
        let session = format!(r#"{{"ppum-session": 1, "panels": false, "panes": [{pane}]}}"#);
        lab.write("view.ppum-session", &session);
        let line = "view --session view.ppum-session --size 640x480 --screenshot a.png";
        let output = command(&lab, line).output().unwrap();
        let complaint = String::from_utf8(output.stderr).unwrap();
        if complaint.contains(NO_DRIVER) {
            return skipped(&complaint);
        }
        assert!(output.status.success() && complaint.is_empty(), "{complaint}");
        let window = Png::read(&lab.path("a.png"));
        assert_eq!(window.size, [640, 480]);
        lab.run("render plate.h5 -o b.png -q syy --range 0,2 --colormap viridis --size 40x30");
        let plate = Png::read(&lab.path("b.png")).pixel(20, 15);
        let middle = window.pixel(320, 260);
        // drivers round a colour to its neighbour
        let is_near = plate.iter().zip(middle).all(|(a, b)| a.abs_diff(b) <= 1);
        assert!(is_near, "{plate:?} {middle:?}");
        assert!(!lab.path("config").exists());
    }
}
