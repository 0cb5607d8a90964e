//! The examples of the project, which the program carries along.

use std::io;
use std::path::{Path, PathBuf};

/// An example.
#[derive(Clone, Copy, Debug)]
pub struct Example {
    /// The name of its file.
    pub name: &'static str,
    /// The problem.
    pub text: &'static str,
    /// A file of numbers that it reads, with its name.
    pub numbers: Option<(&'static str, &'static str)>,
}

macro_rules! example {
    ($name:literal) => {
        Example {
            name: $name,
            text: include_str!(concat!("../../../../examples/", $name, ".toml")),
            numbers: None,
        }
    };
    ($name:literal, numbers) => {
        Example {
            numbers: Some((
                concat!($name, ".csv"),
                include_str!(concat!("../../../../examples/", $name, ".csv")),
            )),
            ..example!($name)
        }
    };
}

/// All examples, those for a first look first.
pub const ALL: [Example; 30] = [
    example!("centre-crack"),
    example!("edge-crack"),
    example!("slanted-crack"),
    example!("kinked-crack"),
    example!("many-cracks"),
    example!("meeting-cracks"),
    example!("edge-shear-growth"),
    example!("two-holes-growth"),
    example!("beam-three-holes"),
    example!("network-growth"),
    example!("cracked-hole"),
    example!("square-hole"),
    example!("plate-with-hole"),
    example!("arc-crack"),
    example!("elliptic-hole"),
    example!("bimaterial-plate"),
    example!("edge-shear"),
    example!("kinked-in-plane"),
    example!("centre-crack-tension"),
    example!("paper-centre-crack"),
    example!("paper-adaptive-1"),
    example!("paper-adaptive-2"),
    example!("paper-enrichment"),
    example!("paper-tip-functions"),
    example!("poisson-slit"),
    example!("interface-corner"),
    example!("boundary-layer"),
    example!("smooth-field"),
    example!("scattered-points", numbers),
    example!("tabulated-profile", numbers),
];

impl Example {
    /// Its title.
    #[must_use]
    pub fn title(&self) -> &'static str {
        let line = self.text.lines().find_map(|line| line.strip_prefix("title = \""));
        line.map_or(self.name, |title| title.trim_end_matches('"'))
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
        super::kept::replace(&folder.join(name), text)?;
        Ok(Some(folder))
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
            let folder = example.folder(own.path()).expect("written").unwrap_or_default();
            let read = ppum_solve::problem::Problem::parse(example.text, example.name, &folder);
            assert_eq!(read.expect("a problem").title, example.title());
        }
    }
}
