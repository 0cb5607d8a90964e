use std::process::Output;

use serde_json::json;

use crate::{CRACKED, LINEAR, Lab, keys, sound};

#[test]
fn json_has_the_documented_shape() {
    let report = Lab::solved(CRACKED).json("sif plate.h5");
    assert_eq!(keys(&report), ["file", "tips", "warnings"]);
    assert_eq!(report["warnings"], json!([]));
    assert_eq!(report["file"], "plate.h5");
    let tips = report["tips"].as_array().unwrap();
    assert_eq!(tips.len(), 2);
    for (tip, [x, angle]) in tips.iter().zip([[-0.5, std::f64::consts::PI], [0.5, 0.0]]) {
        let factors = ["angle", "crack", "error", "g", "growth_angle", "j", "k1", "k2", "rings"];
        assert_eq!(keys(tip), [&factors[..], &["spread", "step", "t_stress", "tip"]].concat());
        assert_eq!(tip["tip"], json!([x, 0.0]));
        assert_eq!(tip["angle"].as_f64(), Some(angle));
        assert_eq!((tip["step"].as_u64(), tip["crack"].as_u64()), (Some(0), Some(0)));
        let rings = tip["rings"].as_array().unwrap();
        assert_eq!(rings.len(), 3);
        assert!(rings.iter().all(|ring| keys(ring) == ["k1", "k2", "r1", "r2"]));
        // 1.333712 √(π a) for this plate; order 1 on 8 × 8 cells is a few per cent off
        let k1 = tip["k1"].as_f64().unwrap();
        let exact = 1.333_712 * (0.5 * std::f64::consts::PI).sqrt();
        assert!((k1 / exact - 1.0).abs() < 0.05, "{k1} {exact}");
        let [error, found] = [(k1 - exact).abs(), tip["error"].as_f64().unwrap()];
        assert!((0.3 * error..10.0 * error).contains(&found), "{error} {found}");
        assert!(tip["k2"].as_f64().unwrap().abs() < 1e-6 * k1, "symmetry");
        assert!(tip["growth_angle"].as_f64().unwrap().abs() < 1e-6, "straight on");
        // E′ = 1 / 0.91; J is another integral over the same field, and T about minus the load
        let [g, j, t] = ["g", "j", "t_stress"].map(|key| tip[key].as_f64().unwrap());
        assert!((g / (0.91 * k1 * k1) - 1.0).abs() < 1e-9 && (j / g - 1.0).abs() < 0.02, "{g} {j}");
        assert!((-2.0..-0.5).contains(&t), "{t}");
        let spread = tip["spread"].as_f64().unwrap();
        let at = |ring: usize| rings[ring]["k1"].as_f64().unwrap();
        assert!(spread >= (at(0) - at(2)).abs() / k1 * 0.999 && spread < 0.05, "{spread}");
    }
}

/// With a body force the integral over the discs has a term that the field alone does not tell.
#[test]
fn a_body_force_is_taken_from_the_problem() {
    let force = "[[boundary]]\non = \"right\"\ntraction = [-10.0, 0.0]\n[body_force]\nvalue = [\"10/2\", 0.0]\n";
    let loaded = CRACKED.replace("[discretization]", &format!("{force}[discretization]"));
    let lab = Lab::solved(&loaded);
    let computed = &lab.json("sif plate.h5 --recompute")["tips"];
    let stored = &lab.json("info plate.h5")["steps"][0]["intensities"];
    assert_eq!(computed, stored);
    assert_eq!(&lab.json("sif plate.h5")["tips"], stored);
    // the problem's text without the force: what ignoring the force would give
    let mut dataset = ppum_format::read(&lab.path("plate.h5")).unwrap();
    dataset.problem = None;
    ppum_format::write(&dataset, &lab.path("forgotten.h5")).unwrap();
    // the integral then depends on the disc, which is remarked on
    let Output { status, stdout, stderr } =
        lab.command("sif forgotten.h5 --recompute --json").output().unwrap();
    assert!(
        status.success() && String::from_utf8(stderr).unwrap().contains("no estimate of the error")
    );
    let forgotten = serde_json::from_slice::<serde_json::Value>(&stdout).unwrap();
    let warnings = forgotten["warnings"].as_array().unwrap();
    assert!(warnings.iter().all(|w| w["kind"] == "spread") && !warnings.is_empty());
    assert_eq!(keys(&warnings[0]), ["at", "kind", "limit", "message", "step", "value"]);
    let forgotten = &forgotten["tips"];
    let k1 = |tips: &serde_json::Value| tips[0]["k1"].as_f64().unwrap();
    let difference = k1(forgotten) - k1(computed);
    assert!(difference.abs() > 0.01 * k1(computed).abs(), "{difference} of {}", k1(computed));
    // a text that cannot be read any more: what the solver stored
    dataset.problem = Some("written by a later version".into());
    ppum_format::write(&dataset, &lab.path("later.h5")).unwrap();
    assert_eq!(&lab.json("sif later.h5")["tips"], stored, "they are what was stored");
    let later = lab.warned("sif later.h5 --recompute --json").0;
    let later = serde_json::from_str::<serde_json::Value>(&later).unwrap();
    assert_eq!((&later["tips"], &later["warnings"][0]["kind"]), (stored, &json!("loads-unknown")));
    dataset.steps[0].intensities.clear();
    ppum_format::write(&dataset, &lab.path("unknown.h5")).unwrap();
    assert!(lab.fail("sif unknown.h5 --recompute").contains("solve the problem again"));
    assert!(lab.fail("sif unknown.h5").contains("--recompute"));
}

#[test]
fn nothing_to_tell_is_said() {
    let lab = Lab::solved(&sound());
    assert_eq!(lab.json("sif plate.h5")["tips"], json!([]));
    assert!(lab.run("sif plate.h5").contains("no crack tips"));
    assert!(Lab::solved(LINEAR).fail("sif plate.h5").contains("only displacements of elasticity"));
}

#[test]
fn text_has_a_line_for_each_tip() {
    let text = Lab::solved(CRACKED).run("sif plate.h5");
    // the head, two tips, what the columns are
    assert_eq!(text.lines().count(), 4, "{text}");
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    assert!(text.contains("error: of K, estimated"), "{text}");
    assert!(text.contains("(-0.5, 0)") && text.contains("(0.5, 0)"), "{text}");
}

/// Nothing is computed from a dataset unless that is asked for: what it holds is shown, be
/// it wrong.
#[test]
fn stored_factors_are_shown() {
    let lab = Lab::solved(CRACKED);
    let before = lab.json("sif plate.h5");
    assert_eq!(before, lab.json("sif plate.h5 --recompute"));
    let mut dataset = ppum_format::read(&lab.path("plate.h5")).unwrap();
    dataset.steps[0].intensities[1].k1 = 7.0;
    ppum_format::write(&dataset, &lab.path("plate.h5")).unwrap();
    assert_eq!(lab.json("sif plate.h5")["tips"][1]["k1"], json!(7.0));
    assert_eq!(lab.json("sif plate.h5 --recompute"), before);
}

/// A file of an earlier version, or of another program, need not know more than K.
#[test]
fn what_a_file_does_not_hold_is_a_dash() {
    let lab = Lab::solved(CRACKED);
    let mut dataset = ppum_format::read(&lab.path("plate.h5")).unwrap();
    dataset.steps[0].intensities[1].t_stress = None;
    dataset.steps[0].intensities.iter_mut().for_each(|tip| tip.j = None);
    dataset.steps[0].intensities[0].k1 = -1.0;
    ppum_format::write(&dataset, &lab.path("plate.h5")).unwrap();
    let tips = &lab.json("sif plate.h5")["tips"];
    let known =
        |tip: usize| ["t_stress", "j", "g", "growth_angle"].map(|key| tips[tip][key].is_number());
    // faces that overlap have no angle
    assert_eq!([known(0), known(1)], [[true, false, true, false], [false, false, true, true]]);
    let text = lab.run("sif plate.h5");
    let dashes = |line: &str| line.matches('–').count();
    assert_eq!(text.lines().map(dashes).collect::<Vec<_>>(), [0, 2, 2, 0], "{text}");
}

/// A tip that cells do not resolve: a line without numbers, and what to do about it.
#[test]
fn a_tip_without_room_is_shown_without_factors() {
    let near = CRACKED.replace("[0.5, 0.0]]", "[0.95, 0.0]]");
    let lab = Lab::new();
    lab.write("plate.toml", &near.replace("[discretization]", "[discretization]\nrefine = false"));
    let (text, remarks) = lab.warned("solve plate.toml");
    assert!(text.contains("wrote") && remarks.contains("warning: tip (0.95, 0): no stress"));
    assert!(lab.warned("sif plate.h5").0.contains("–"));
    let (text, remarks) = lab.warned("sif plate.h5 --json");
    assert!(remarks.contains("warning: tip (0.95, 0): no stress"));
    let report = serde_json::from_str::<serde_json::Value>(&text).unwrap();
    let [left, right] = report["tips"].as_array().unwrap().as_slice() else { panic!("two tips") };
    assert!(left["k1"].is_number() && right["k1"].is_null() && right["rings"] == json!([]));
    let warnings = report["warnings"].as_array().unwrap();
    let no_room = warnings.iter().find(|w| w["kind"] == "no-room").unwrap();
    assert_eq!(no_room["at"], right["tip"]);
    let info = lab.run("info plate.h5");
    assert!(info.contains("warnings") && info.contains(no_room["message"].as_str().unwrap()));
    assert_eq!(lab.json("info plate.h5")["steps"][0]["warnings"], report["warnings"]);
}
