//! The figures of the paper.

use crate::{Lab, Png};

/// Figures are made from problem files that are the examples.
#[test]
fn figures_by_their_numbers() {
    let lab = Lab::new();
    let told = lab.run("gallery -o paper --figure 2 --figure 4");
    assert!(told.contains("[1 of 2] Figure 2") && told.contains("[2 of 2] Figure 4"), "{told}");
    for name in ["figure-2", "figure-4"] {
        let path = lab.path(&format!("paper/{name}.png"));
        assert!(Png::read(&path).size[0] >= 800);
    }
    assert!(!lab.path("paper/figure-1-cells.png").exists());
    let examples = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
    for name in ["paper-enrichment.toml", "paper-tip-functions.toml"] {
        let written = std::fs::read_to_string(lab.path(&format!("paper/{name}"))).unwrap();
        assert_eq!(written, std::fs::read_to_string(format!("{examples}/{name}")).unwrap());
    }
    assert!(lab.fail("gallery -o paper --figure 9").contains("there are the figures 1, 2"));
    std::fs::write(lab.path("paper/paper-enrichment.toml"), "mine").unwrap();
    assert!(lab.fail("gallery -o paper --figure 2").contains("was edited"));
}
