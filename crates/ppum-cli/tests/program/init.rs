//! `ppum init`: a problem file to begin with, which solves as it is and is not lost.

use crate::Lab;

#[test]
fn the_file_solves_and_is_not_replaced() {
    let lab = Lab::new();
    let told = lab.run("init plate.toml");
    assert_eq!(told, "wrote plate.toml; edit it, then: ppum solve plate.toml\n");
    let text = std::fs::read_to_string(lab.path("plate.toml")).unwrap();
    assert!(text.contains("ppum solve plate.toml") && !text.contains("FILE"), "{text}");
    let complaint = lab.fail("init plate.toml");
    assert!(complaint.contains("is there already") && complaint.contains("--force"), "{complaint}");
    lab.run("init plate.toml --force");
    lab.run("solve plate.toml");
    // the slanted crack of the README, 1 % shorter: K of a crack at 45° in an infinite plate is
    // σ √(πa)/2 in both modes, and the finite plate has 6 to 23 % more
    for tip in lab.json("sif plate.h5")["tips"].as_array().unwrap() {
        let infinite = 0.5 * (std::f64::consts::PI * 0.35 * 2_f64.sqrt()).sqrt();
        for name in ["k1", "k2"] {
            let ratio = tip[name].as_f64().unwrap() / infinite;
            assert!((1.06..1.24).contains(&ratio), "{name}: {ratio}");
        }
    }
    assert!(lab.run("init -").starts_with("# A slanted crack"));
}
