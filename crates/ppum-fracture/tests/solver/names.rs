//! Names of functions are for reports: what a function is does not depend on them.

use crate::SQUARE_BODY;
use crate::studies::support::{checked, parsed, record, solved};
use ppum::progress::unwatched;
use ppum_fracture::diagnostics::recompute;
use ppum_problem::ProblemData;
use ppum_solve::report::strip_timings;
use ppum_testkit::random::Random;

/// An oblique crack with a user-defined function near a tip, and what else there is.
fn plate(young: &str, enrichment: &str) -> ProblemData {
    parsed(&format!(
        "[domain]\nmin = [-1, -1]\nmax = [1, 1]\n[material]\nyoung = {young}\npoisson = 0.3\n\
         state = \"plane-strain\"\n[[crack]]\npoints = [[-0.35, -0.35], [0.35, 0.35]]\n\
         [[boundary]]\non = \"bottom\"\ntraction = [0, -1]\n[[boundary]]\non = \"top\"\n\
         traction = [0, 1]\n[discretization]\ncells = [4, 4]\norder = 2\n[[enrichment]]\n{enrichment}"
    ))
}

/// All that comes of a problem, but for times and the name of its function; and what is computed
/// again from the file.
fn results(mut problem: ProblemData, name: &str) -> [String; 2] {
    name.clone_into(&mut problem.enrichments[0].name);
    let mut dataset = solved(&problem);
    let again = recompute(&dataset, 0, Some(&checked(&problem)), unwatched()).expect("factors");
    let step = &mut dataset.steps[0];
    strip_timings(step);
    step.functions.iter_mut().for_each(|function| function.name.clear());
    [format!("{again:?}"), format!("{step:?}")]
}

/// Beginnings that built-in functions have, whole names of theirs, and letters at random.
fn names() -> Vec<String> {
    let beginnings = ["force at", "kink at", "r^", "westergaard", "side of crack", "component"];
    let places = ["", " bolt", " [0.4, 0.4], 0.0", " 0.1 - x = 0", "0.545 at [0.4, 0.4]"];
    let known = beginnings.iter().flat_map(|one| places.map(|place| format!("{one}{place}")));
    let whole = ["", "one", "sqrt(r)*cos(theta/2)", "log(1 + r/0.1)", "Lasche → größer 🦀"];
    let letters: Vec<char> = "abr^ []0.5,-=:()\"'\\ñß漢é\u{301}".chars().collect();
    let mut random = Random(71);
    let mut any = || (0..1 + random.below(12)).map(|_| random.pick(&letters)).collect::<String>();
    let any: Vec<String> = (0..15).map(|_| any()).collect();
    known.chain(whole.map(str::to_owned)).chain(any).collect()
}

/// A function beside a tip, whose place is no obstacle for K; and one in the patches that an
/// interface cuts, in which no more is asked for.
#[test]
fn names_change_no_bit() {
    let names = names();
    assert_eq!(names.len(), 50);
    let beside_tip =
        plate("1.0", "function = \"log(1 + r/0.1)\"\nat = [0.40, 0.40]\nradius = 0.02\n");
    let at_interface = plate(
        "\"if(hypot(x - 0.6, y + 0.5) < 0.3, 30, 1)\"",
        "function = \"r^1.3*cos(theta)\"\nat = [0.6, -0.2]\nradius = 0.02\n",
    );
    for (problem, step) in [(beside_tip, 1), (at_interface, 3)] {
        let expected = results(problem.clone(), "any");
        for name in names.iter().step_by(step) {
            let found = results(problem.clone(), name);
            assert!(found == expected, "{name:?}: {}, not {}", found[0], expected[0]);
        }
    }
}

/// What a source has that polynomials do not see is part of the estimate also around a force, whose
/// field does not see it: a force that is as good as none changes nothing.
#[test]
fn forces_see_no_source() {
    let estimate = |rest: &str| {
        let problem = parsed(&format!(
            "{SQUARE_BODY}[discretization]\ncells = [4, 4]\norder = 2\n\
             [body_force]\nvalue = [\"exp(-40*(x^2 + y^2))*sin(20*x)\", 0]\n\
             [[boundary]]\non = \"bottom\"\ndisplacement = [0, 0]\n{rest}"
        ));
        record(&solved(&problem).steps[0], "estimated error")
    };
    let [without, with] = ["", "[[force]]\nat = [0.1, 0.05]\nvalue = [1e-9, 0]\n"].map(estimate);
    // 2 %, by the points of the cells around the force; 46 % less where these do not count
    assert!((with / without - 1.0).abs() < 0.05, "{with:e}, {without:e}");
}
