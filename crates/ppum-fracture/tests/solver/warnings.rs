//! Warnings: each is provoked, and good problems are silent.

use crate::SQUARE_BODY;
use crate::studies::support::{parsed, solved};
use ppum::dataset::{Dataset, Warning, WarningKind};
use ppum::progress::unwatched;
use ppum::vec2::{Vec2, vec2};
use ppum_fracture::diagnostics::recompute;
use ppum_testkit::random::Random;

/// A plate with a crack, 8 × 8 cells.
fn text(points: &str, loads: &str, discretization: &str) -> String {
    format!(
        "{SQUARE_BODY}[[crack]]\npoints = {points}\n{loads}\n[discretization]\n\
         cells = [8, 8]\n{discretization}\n"
    )
}

fn solve_text(text: &str) -> Dataset {
    solved(&parsed(text))
}

fn plate(points: &str, loads: &str, discretization: &str) -> Dataset {
    solve_text(&text(points, loads, discretization))
}

fn ends(bottom: &str, top: &str) -> String {
    let end =
        |on: &str, traction: &str| format!("[[boundary]]\non = \"{on}\"\ntraction = {traction}\n");
    end("bottom", bottom) + &end("top", top)
}

fn tension() -> String {
    ends("[0, -1]", "[0, 1]")
}

fn warnings(dataset: &Dataset) -> &[Warning] {
    let found = &dataset.steps[0].warnings;
    found.iter().for_each(|w| println!("{}: {} ({} {:?})", w.kind, w.message, w.value, w.at));
    found
}

/// The only warnings there are, which are of one kind.
fn only(dataset: &Dataset, kind: WarningKind) -> &[Warning] {
    let found = warnings(dataset);
    assert!(!found.is_empty() && found.iter().all(|w| w.kind == kind), "{found:?}");
    found
}

fn places(warnings: &[Warning]) -> Vec<Vec2> {
    warnings.iter().filter_map(|w| w.at).collect()
}

const STRAIGHT: &str = "[[-0.5, 0.0], [0.5, 0.0]]";

/// What moves as a rigid body has strains of rounding only: nothing is said of signs and
/// differences of its factors.
#[test]
fn rigid_motions() {
    let moved = |on: &str| format!("[[boundary]]\non = \"{on}\"\ndisplacement = [1, 2]\n");
    let held = moved("bottom") + &moved("top");
    for keys in ["", "accuracy = 1e-3"] {
        let text =
            text(STRAIGHT, &held, "").replace("cells = [8, 8]", &format!("level = 3\n{keys}"));
        let dataset = solve_text(&text);
        let all = only(&dataset, WarningKind::Digits);
        assert!(all.len() == 1 && all[0].message.contains("rigid"), "{all:?}");
    }
}

/// Strains that cancel in a material 1e9 times as stiff as the rest keep 1e-16 · 1e9 of the load,
/// times what the stiffness of a cell is above that of its softest mode: digits of the linear
/// system are lost, in proportion.
#[test]
fn lost_digits() {
    let residual = |ratio: &str| {
        let plate = text(STRAIGHT, &tension(), "");
        let stiff = format!("young = \"if(y > 0.6, {ratio}, 1)\"");
        let dataset = solve_text(&plate.replace("young = 1\n", &format!("{stiff}\n")));
        warnings(&dataset).iter().find(|w| w.kind == WarningKind::Residual).cloned()
    };
    assert_eq!(residual("1e2"), None);
    let found = residual("1e9").expect("a warning of the residual");
    assert!(
        found.value > 10.0 * found.limit && found.message.contains("nearly touch"),
        "{found:?}"
    );
}

#[test]
fn good_problems_are_silent() {
    for (points, loads) in [
        (STRAIGHT, tension()),
        // shear: K_I = 0 up to discretisation, faces that slide
        (STRAIGHT, ends("[-1, 0]", "[1, 0]") + &sides("[0, -1]", "[0, 1]")),
        // along the load: no jump at all
        ("[[0.01, -0.5], [0.01, 0.5]]", tension()),
        ("[[-0.5, -0.2], [0.1, 0.1], [0.3, 0.1]]", tension()),
        ("[[-1.0, 0.1], [0.2, 0.1]]", tension()),
    ] {
        let dataset = plate(points, &loads, "");
        assert_eq!(warnings(&dataset), [], "{points}");
    }
}

fn sides(left: &str, right: &str) -> String {
    let side =
        |on: &str, traction: &str| format!("[[boundary]]\non = \"{on}\"\ntraction = {traction}\n");
    side("left", left) + &side("right", right)
}

#[test]
fn pressed_faces_overlap() {
    let dataset = plate(STRAIGHT, &ends("[0, 1]", "[0, -1]"), "");
    let found = warnings(&dataset);
    let of = |kind: WarningKind| found.iter().filter(|w| w.kind == kind).collect::<Vec<_>>();
    let [left, right] = of(WarningKind::NegativeK1)[..] else { panic!("{found:?}") };
    assert!(left.value < -1.0 && right.value < -1.0);
    let [faces] = of(WarningKind::FacesOverlap)[..] else { panic!("{found:?}") };
    assert!(faces.message.contains("crack 0") && faces.message.contains("100 %"));
    // most in the middle
    assert!(faces.at.expect("a place").length() < 0.02, "{faces:?}");
    assert_eq!(found.len(), 3);
}

/// Under bending a crack through the neutral axis opens at one end and overlaps at the other.
#[test]
fn faces_overlap_where_bending_presses() {
    let dataset = plate(STRAIGHT, &ends("[0, \"-x\"]", "[0, \"x\"]"), "");
    let found = warnings(&dataset);
    let kinds: Vec<_> = found.iter().map(|w| w.kind.clone()).collect();
    assert_eq!(kinds, [WarningKind::NegativeK1, WarningKind::FacesOverlap]);
    assert_eq!(found[0].at, Some(Vec2::from([-0.5, 0.0])));
    assert!(found[1].at.expect("a place").x < -0.1, "{found:?}");
}

#[test]
fn little_room_and_none() {
    // cells of 0.25, nothing refined
    let near = |gap: f64| {
        let points = format!("[[{}, 0.0], [0.2, 0.0]]", -1.0 + gap);
        plate(&points, &tension(), "refine = false")
    };
    let dataset = near(0.2);
    let found = only(&dataset, WarningKind::LittleRoom);
    assert_eq!(places(found), [Vec2::from([-0.8, 0.0])]);
    assert!((found[0].value - 0.2).abs() < 1e-15 && found[0].limit == 0.5);
    let dataset = near(0.1);
    let found = only(&dataset, WarningKind::NoRoom);
    assert!((found[0].value - 0.1).abs() < 1e-15 && found[0].limit == 0.125);
    assert!(found[0].message.contains("the border") && found[0].message.contains("at most 0.2"));
    assert_eq!(dataset.steps[0].intensities.len(), 1);
    dataset.check().expect("a dataset in order");
}

#[test]
fn tips_near_the_border() {
    let dataset = plate("[[-0.97, 0.0], [0.5, 0.0]]", &tension(), "");
    let found = only(&dataset, WarningKind::TipNearBorder);
    assert_eq!(places(found), [Vec2::from([-0.97, 0.0])]);
    assert!(found[0].message.contains(" 2 % of the crack's length"), "{}", found[0].message);
    // however near: the part is told with its digits
    let dataset = plate("[[-0.99999, 0.0], [0.5, 0.0]]", &tension(), "refine = false");
    let found = warnings(&dataset).iter().find(|w| w.kind == WarningKind::TipNearBorder);
    let message = &found.expect("a tip near the border").message;
    assert!(
        message.contains("tip (-0.99999, 0)") && message.contains(" 0.00067 % of"),
        "{message}"
    );
}

#[test]
fn coarse_cracks() {
    let dataset = plate("[[-0.3, 0.03], [0.4, 0.03]]", &tension(), "refine = false");
    let found = warnings(&dataset);
    let coarse: Vec<_> = found.iter().filter(|w| w.kind == WarningKind::Coarse).collect();
    assert_eq!(coarse.len(), 2);
    assert!((coarse[0].value - 2.8).abs() < 1e-12 && coarse[0].limit == 4.0);
}

/// A pressure on the faces that the integrals are not told of gives other values at each radius.
#[test]
fn values_that_differ() {
    let text = text(STRAIGHT, &tension(), "");
    let dataset = solve_text(&(text + "[[boundary]]\non = { crack = 0 }\npressure = \"1 + x\"\n"));
    assert!(warnings(&dataset).is_empty());
    let (_, found) = recompute(&dataset, 0, None, unwatched()).expect("a field");
    let spread: Vec<_> = found.iter().filter(|w| w.kind == WarningKind::Spread).collect();
    assert!(!spread.is_empty() && spread.iter().all(|w| w.value > 0.01), "{found:?}");
    assert!(spread[0].message.contains("no estimate of the error"), "{}", spread[0].message);
}

#[test]
fn loads_that_nearly_balance() {
    let dataset = plate(STRAIGHT, &ends("[0, -1]", "[0, 1.0000005]"), "");
    let found = only(&dataset, WarningKind::Imbalance);
    // of 4 in all, 1e-6 on the vertical motion
    let record = |name: &str| dataset.steps[0].history.iter().find(|r| r.name == name);
    assert_eq!(record("imbalance").map(|r| r.value), Some(found[0].value));
    assert!(found[0].value > 1e-8 && found[0].value < 1e-6 && found[0].at.is_none());
}

/// Polynomials once more, as functions of one's own.
#[test]
fn functions_that_are_cut_off() {
    let own = "[[enrichment]]\nfunctions = [\"x\", \"y\"]\ndegree = 1";
    let dataset = plate(STRAIGHT, &tension(), own);
    let found = only(&dataset, WarningKind::CutOff);
    // 6 of 12 functions on most patches, fewer where there are others
    assert!(found[0].value > 0.25 && found[0].value < 0.5, "{found:?}");
}

/// A crack beside a held edge cuts its cells into slivers, the more so the closer it is.
#[test]
fn slivers_at_held_edges() {
    let held = "[[boundary]]\non = \"bottom\"\ndisplacement = [0, 0]\n[[boundary]]\non = \"top\"\n\
                traction = [0, 1]\n";
    let at = |gap: f64| {
        let y = gap - 1.0;
        plate(&format!("[[-0.5, {y}], [0.5, {y}]]"), held, "refine = false")
    };
    let of = |dataset: &Dataset| {
        warnings(dataset)
            .iter()
            .find(|w| w.kind == WarningKind::Nitsche)
            .map(|w| (w.value, w.limit))
    };
    let [near, nearer] = [1e-4, 1e-5].map(|part| of(&at(0.25 * part)).expect("a warning"));
    assert!(near.0 > 1e4 && near.1 == 1e4, "{near:?}");
    // β is inversely proportional to the width
    assert!((nearer.0 / near.0 - 10.0).abs() < 0.1, "{near:?} {nearer:?}");
    assert_eq!(of(&at(0.025)), None);
}

/// The sides of a notch like a V are both in three patches without its corner: in those on
/// [−0.0625, 0.3125] up to y = 0.136, which are two above that of the corner, in the one left of
/// these up to y = −0.277. A crack of that shape has functions for its two sides.
#[test]
fn patches_crossed_twice() {
    let loads = sides("[-1, 0]", "[1, 0]");
    let set = "refine = false\noverlap = 1.5";
    let sharp = "[[-0.13, 0.6], [0.03, -0.5], [0.19, 0.6]]";
    let crack = plate(sharp, &loads, set);
    assert!(warnings(&crack).iter().all(|w| w.kind != WarningKind::CrossedTwice));
    let notch = format!("[[hole]]\npoints = {sharp}\n{loads}");
    let notched = text(sharp, &notch, set);
    let (head, tail) = notched.split_once("[[crack]]\n").expect("a crack");
    let (_, tail) = tail.split_once('\n').expect("its points");
    let dataset = solve_text(&format!("{head}{tail}"));
    let found = warnings(&dataset);
    let crossed: Vec<_> = found.iter().filter(|w| w.kind == WarningKind::CrossedTwice).collect();
    let [crossed] = crossed[..] else { panic!("{found:?}") };
    assert_eq!((crossed.value, crossed.limit), (3.0, 0.0));
    assert!(crossed.message.contains("use smaller cells"), "{}", crossed.message);
}

/// Cracks that turn in an inclusion a fifth as stiff, at random: what their faces look at there
/// is resolved.
#[test]
fn cracks_in_inclusions_are_resolved() {
    for seed in 1..5 {
        let mut random = Random(seed);
        let r = random.between(0.25, 0.4);
        let mut at = vec2(0.55 - r, 0.0);
        let mut points = vec![[0.0, 0.0], at.into()];
        for length in [0.04, 0.04, 0.02] {
            let angle = random.between(-0.6, 0.6);
            at = at + vec2(angle.cos(), angle.sin()) * length;
            points.push(at.into());
        }
        let text = format!(
            "[domain]\nmin = [0.0, -1.0]\nmax = [1.0, 1.0]\n[material]\nyoung = \"if(hypot(x - 0.6, y) < {r}, 0.2, 1)\"\n\
             poisson = 0.3\nstate = \"plane-strain\"\n[[crack]]\npoints = {points:?}\n{}\n[discretization]\n\
             cells = [5, 10]\norder = 1\n",
            ends("[0, -1]", "[0, 1]")
        );
        let dataset = solve_text(&text);
        let found = warnings(&dataset).iter().find(|w| w.kind == WarningKind::Quadrature);
        assert!(found.is_none(), "seed {seed}: {found:?}");
    }
}
