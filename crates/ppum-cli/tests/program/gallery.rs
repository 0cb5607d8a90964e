//! The figures of the paper, by the commands of docs/gallery.md.

use crate::readme::{blocks, follow};
use crate::{Lab, Png};

const PAGE: &str = include_str!("../../../../docs/gallery.md");

/// Two of them, as a reader would make them from the examples.
#[test]
fn figures_by_their_commands() {
    let lab = Lab::new();
    for folder in ["examples", "out", "docs/images/gallery"] {
        std::fs::create_dir_all(lab.path(folder)).unwrap();
    }
    let examples = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
    let figures: [&str; 8] = blocks(PAGE, "sh");
    for (number, problem) in [(2, "paper-enrichment"), (4, "paper-tip-functions")] {
        let name = format!("examples/{problem}.toml");
        std::fs::copy(format!("{examples}/{problem}.toml"), lab.path(&name)).unwrap();
        follow(&lab, figures[number - 1]);
        let path = lab.path(&format!("docs/images/gallery/figure-{number}.png"));
        assert!(Png::read(&path).size[0] >= 800);
    }
}

/// Each picture of the page has the command that makes it.
#[test]
fn every_figure_has_its_command() {
    let pictures = PAGE.split("](images/gallery/").skip(1).map(|rest| rest.split(')').next());
    let pictures: Vec<_> = pictures.map(Option::unwrap).collect();
    assert!(pictures.len() > 20);
    for name in pictures {
        let output = format!(" -o docs/images/gallery/{name} ");
        assert!(PAGE.contains(&output), "{output}");
    }
}
