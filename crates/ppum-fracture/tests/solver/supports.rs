//! Points that are held: rigid motions alone depend on them.

use crate::studies::support::{checked, parsed, quantity, solved};
use ppum::dataset::Dataset;
use ppum::progress::unwatched;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_fracture::solve::solve;
use ppum_testkit::random::Random;

/// A pulled body [−1, 1]² with the crack from (−0.4, −0.1) to (0.3, 0.2), and what else there is.
fn body(rest: &str) -> String {
    format!(
        "[domain]\nmin = [-1, -1]\nmax = [1, 1]\n[material]\nyoung = 2.0\npoisson = 0.3\nstate = \"plane-strain\"\n\
         [[boundary]]\non = \"bottom\"\ntraction = [0, \"-1 - x\"]\n[[boundary]]\non = \"top\"\n\
         traction = [0, \"1 + x\"]\n[discretization]\ncells = [6, 6]\norder = 2\n{rest}"
    )
}

const CRACK: &str = "[[crack]]\npoints = [[-0.4, -0.1], [0.3, 0.2]]\n";

/// A crack through the body: the halves are pieces of their own.
const CUT: &str = "[[crack]]\npoints = [[-1, -0.15], [1, 0.12]]\n";

fn support(at: Vec2, displacement: &str) -> String {
    format!("[[support]]\nat = [{}, {}]\ndisplacement = {displacement}\n", at.x, at.y)
}

fn displacement(dataset: &Dataset, at: Vec2) -> Vec2 {
    vec2(quantity(dataset, "ux", at), quantity(dataset, "uy", at))
}

/// Checks that two solutions have the same stresses, of size one, at random points.
fn check_stresses(random: &mut Random, a: &Dataset, b: &Dataset, what: &str) {
    let inside = Rect::new(vec2(-0.95, -0.95), vec2(0.95, 0.95));
    for _ in 0..50 {
        let x = random.point(&inside);
        for name in ["sxx", "syy", "sxy"] {
            let [a, b] = [a, b].map(|dataset| quantity(dataset, name, x));
            // rounding of rigid motions of size one, differentiated on cells of size 1/3
            assert!((a - b).abs() <= 1e-11 * (1.0 + a.abs()), "{what} {name} at {x:?}: {a} {b}");
        }
    }
}

#[test]
fn supports_choose_the_rigid_motion_alone() {
    let mut random = Random(42);
    let inside = Rect::new(vec2(-0.9, 0.4), vec2(0.9, 0.9));
    for solver in ["direct", "multilevel"] {
        let with = |rest: &str| {
            solved(&parsed(&body(&format!(
                "{CRACK}[solver]\nkind = \"{solver}\"\ntolerance = 1e-13\n{rest}"
            ))))
        };
        let plain = with("");
        let [a, b] = [random.point(&inside), vec2(random.between(-0.9, 0.9), -1.0)];
        let given = vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        let whole = support(a, &format!("[{}, {}]", given.x, given.y));
        for (what, second) in [("one point", ""), ("two", "[0.25, \"free\"]")] {
            let second = if second.is_empty() { String::new() } else { support(b, second) };
            let held = with(&(whole.clone() + &second));
            let found = displacement(&held, a);
            assert!((found - given).length() < 1e-11, "{solver}, {what}: {found:?} {given:?}");
            let off = displacement(&held, b).x - 0.25;
            assert!(second.is_empty() || off.abs() < 1e-11, "{solver}: {off}");
            check_stresses(&mut random, &plain, &held, what);
            let [k, l] = [&plain, &held].map(|dataset| dataset.steps[0].intensities[0].k1);
            assert!((k - l).abs() < 1e-11 * k.abs(), "{k} {l}");
        }
    }
}

/// Fewer supports than motions: the rest stays zero on average.
#[test]
fn what_supports_leave_has_no_mean() {
    let [plain, held] = ["", "[[support]]\nat = [0, 0.5]\ndisplacement = [\"free\", 0.5]\n"]
        .map(|rest| solved(&parsed(&body(rest))));
    let motion = |x: Vec2| displacement(&held, x) - displacement(&plain, x);
    let [a, b] = [motion(vec2(-0.5, -0.5)), motion(vec2(0.5, 0.7))];
    assert!((a - b).length() < 1e-12 && a.x.abs() < 1e-12, "a motion along y: {a:?} {b:?}");
    assert!((displacement(&held, vec2(0.0, 0.5)).y - 0.5).abs() < 1e-12);
}

/// Each piece has supports of its own, beside restraints that leave motions.
#[test]
fn pieces_and_rollers() {
    let load = "[body_force]\nvalue = [0, \"y\"]\n[[boundary]]\non = \"left\"\ndisplacement = [0, \"free\"]\n";
    let mut random = Random(7);
    let no_pull = |rest: &str| body(rest).replace("\"-1 - x\"", "0").replace("\"1 + x\"", "0");
    for crack in [CRACK, ""] {
        let [plain, held] = ["", "[[support]]\nat = [1, -1]\ndisplacement = [\"free\", 0]\n"]
            .map(|rest| solved(&parsed(&no_pull(&format!("{crack}{load}{rest}")))));
        check_stresses(&mut random, &plain, &held, "a roller");
        assert!(displacement(&held, vec2(1.0, -1.0)).y.abs() < 1e-12);
    }
    let pull = "[[boundary]]\non = { crack = 0 }\ntraction = [0, 0]\n";
    let ends = support(vec2(0.5, 1.0), "[0, 0]") + &support(vec2(-0.5, -1.0), "[0.5, 0]");
    let bare = no_pull(&format!("{CUT}{pull}[temperature]\nvalue = \"x*y\"\n"));
    let bare = bare.replace("poisson", "expansion = 1\npoisson");
    let [plain, held] = ["", ends.as_str()].map(|rest| solved(&parsed(&format!("{bare}{rest}"))));
    check_stresses(&mut random, &plain, &held, "pieces");
    assert!(displacement(&held, vec2(0.5, 1.0)).length() < 1e-12);
    assert!((displacement(&held, vec2(-0.5, -1.0)) - vec2(0.5, 0.0)).length() < 1e-12);
}

#[test]
fn supports_that_would_take_forces_are_refused() {
    let hold = "[[boundary]]\non = \"left\"\ndisplacement = [0, 0]\n".to_owned();
    let all = "[0, 0]";
    for (rest, expected) in [
        (
            hold + &support(vec2(0.5, 0.5), all),
            "the support at [0.5, 0.5] would take a force: what is given on the border, or a face that touches, keeps \
             the body from moving in x there; make this component \"free\", or leave the [[support]] out",
        ),
        (
            support(vec2(0.5, 0.5), all) + &support(vec2(0.5, -0.5), all),
            "the support at [0.5, -0.5] would take a force: the supports before it leave no rigid motion in y there; \
             make this component \"free\": three components in all hold a body",
        ),
    ] {
        let error = solve(&checked(&parsed(&body(&rest))), unwatched()).expect_err("a force");
        assert_eq!(error.to_string(), expected);
    }
    let unbalanced = "[body_force]\nvalue = [0, -1]\n".to_owned() + &support(Vec2::ZERO, all);
    let error =
        solve(&checked(&parsed(&body(&unbalanced))), unwatched()).expect_err("a force").to_string();
    assert!(error.contains("a force of (0, -4)"), "{error}");
    assert!(error.contains("a [[support]] takes no force"), "{error}");
    assert!(error.contains("by [[boundary]], or balance the loads"), "{error}");
}
