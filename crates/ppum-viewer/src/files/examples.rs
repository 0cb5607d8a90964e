//! The examples of the project, which the program carries along.

use std::io;
use std::path::{Path, PathBuf};

use ppum::progress::Watcher;
use ppum_problem::Problem;

use crate::query::BackgroundQuery;
use crate::save_target::replace;
use crate::solving::preview::Preview;

/// An example.
#[derive(Clone, Copy, Debug)]
pub struct Example {
    /// The name of its file.
    pub name: &'static str,
    /// Its subject, on one line.
    pub about: &'static str,
    /// The problem.
    pub text: &'static str,
    /// Another file that it reads, with its name.
    pub numbers: Option<(&'static str, &'static str)>,
}

macro_rules! example {
    ($name:literal, $about:literal) => {
        Example {
            name: $name,
            about: $about,
            text: include_str!(concat!("../../../../examples/", $name, ".toml")),
            numbers: None,
        }
    };
    ($name:literal, $about:literal, numbers) => {
        Example {
            numbers: Some((
                concat!($name, ".csv"),
                include_str!(concat!("../../../../examples/", $name, ".csv")),
            )),
            ..example!($name, $about)
        }
    };
}

/// All examples, those for a first look first.
pub const ALL: [Example; 42] = [
    example!("centre-crack", "Held at the bottom, pulled at the top"),
    example!("edge-crack", "A strip in tension, K_I known"),
    example!("slanted-crack", "Both modes at 45°, K known"),
    example!("kinked-crack", "A polyline with two kinks"),
    example!("many-cracks", "Ten cracks that shield each other"),
    example!("meeting-cracks", "Cracks that cross, branch and meet"),
    example!("edge-shear-growth", "A growing crack, step by step"),
    example!("two-holes-growth", "Cracks that bend towards holes"),
    example!("beam-three-holes", "Bent until the crack meets a hole"),
    example!("network-growth", "Ten cracks grow into a network"),
    example!("pressed-crack", "Faces that slide, and wings that open"),
    example!("cracked-hole", "Pressure in a hole and a crack"),
    example!("square-hole", "Singular corners of 270°"),
    example!("plate-with-hole", "Kirsch's stress concentration of 3"),
    example!("arc-crack", "A curved crack, K known"),
    example!("elliptic-hole", "Inglis' stress concentration of 5"),
    example!("bimaterial-plate", "A stiff and a soft half, exact"),
    example!("edge-shear", "K_I and K_II in shear, known"),
    example!("kinked-in-plane", "One kink in a very large plate"),
    example!("centre-crack-tension", "The reference case for K_I"),
    example!("quarter-plate", "A quarter of it, with symmetry"),
    example!("penny-crack", "A body of revolution, K known"),
    example!("orthotropic-plate", "Fibres at 60°, K known"),
    example!("fatigue", "Cycles with overloads, counted"),
    example!("thermal-hot-spot", "A temperature alone"),
    Example {
        numbers: Some((
            "insulated-crack-heat.toml",
            include_str!("../../../../examples/insulated-crack-heat.toml"),
        )),
        ..example!("insulated-crack", "Heat that flows around a crack")
    },
    example!("insulated-crack-heat", "The temperature around it"),
    example!("compact-tension", "A standard specimen, by its outline"),
    example!("dog-bone", "A tensile bar, from a drawing"),
    example!("gear-tooth", "A tooth, from a drawing"),
    example!("three-point-bending", "Forces at points on a beam"),
    example!("paper-centre-crack", "Figure 5 of the paper"),
    example!("paper-adaptive-1", "Figure 8: cells where the error is"),
    example!("paper-adaptive-2", "Figure 8 with quadratic functions"),
    example!("paper-enrichment", "Figure 2: which patch has what"),
    example!("paper-tip-functions", "Four functions around a tip"),
    example!("poisson-slit", "A potential with √r at its end"),
    example!("interface-corner", "Heat at a corner of two materials"),
    example!("boundary-layer", "An exponential as enrichment"),
    example!("smooth-field", "The error is known at every point"),
    example!("scattered-points", "Patches around given points", numbers),
    example!("tabulated-profile", "A function that a table defines", numbers),
];

impl Example {
    /// Its title.
    #[must_use]
    pub fn title(&self) -> &'static str {
        crate::session::title(self.text).unwrap_or(self.name)
    }

    /// Returns the geometry of its problem: body, holes, cracks, supports and loads. A file of
    /// numbers is put into `own`, the window's folder; none where it cannot be.
    pub(crate) fn preview(&self, own: Option<&Path>) -> Option<Preview> {
        let folder = match own {
            Some(own) => self.folder(own).ok()?.unwrap_or_default(),
            None => PathBuf::new(),
        };
        Problem::parse(self.text, self.name, &folder).ok().map(|problem| Preview::new(&problem))
    }

    /// The folder of the file of numbers that it reads, where that file is put now; none if it
    /// reads none.
    ///
    /// # Errors
    /// A folder that cannot be written.
    pub fn folder(&self, folder: &Path) -> io::Result<Option<PathBuf>> {
        let Some((name, text)) = self.numbers else { return Ok(None) };
        let folder = folder.join("examples");
        std::fs::create_dir_all(&folder)?;
        replace(&folder.join(name), text.as_bytes())?;
        Ok(Some(folder))
    }
}

/// The geometries of the problems of all examples, found in the background.
#[derive(Debug, Default)]
pub struct Previews(BackgroundQuery<(), Vec<Option<Preview>>>);

impl Previews {
    /// Begins to find them, if they are not known yet, with the window's folder.
    pub fn find(&mut self, ctx: &egui::Context, own: Option<&Path>) {
        let own = own.map(Path::to_owned);
        let all = move |_: &dyn Watcher| {
            Some(Ok(ALL.iter().map(|one| one.preview(own.as_deref())).collect::<Vec<_>>()))
        };
        self.0.ask(&(), false, ctx, all);
    }

    /// That of an example, by its number, once it is known.
    #[must_use]
    pub fn of(&self, number: usize) -> Option<&Preview> {
        let known = self.0.known()?.as_ref().ok()?;
        known.get(number)?.as_ref()
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// All files of `examples/` are here, and each can be read as a problem.
    #[test]
    fn the_examples_are_complete() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
        let files = std::fs::read_dir(&folder).expect("a folder");
        let files = files.map(|file| file.expect("a file").path());
        let problems = files.filter(|path| path.extension().is_some_and(|end| end == "toml"));
        let name = |path: PathBuf| path.file_stem().map(|n| n.to_string_lossy().into_owned());
        let there: BTreeSet<String> = problems.filter_map(name).collect();
        assert_eq!(there, ALL.iter().map(|example| example.name.to_owned()).collect());
        let own = tempfile::tempdir().expect("a folder");
        for example in ALL {
            assert!(example.about.chars().count() < 40 && !example.about.ends_with('.'));
            let folder = example.folder(own.path()).expect("written").unwrap_or_default();
            let read = Problem::parse(example.text, example.name, &folder);
            assert_eq!(read.expect("a problem").title, example.title());
            assert!(example.preview(Some(own.path())).is_some(), "{}", example.name);
        }
    }
}
