//! Rules for cracks whose faces may touch.

use super::super::boundary::BorderPart;
use super::super::key::{Key, MistakeAt, no_such};
use super::super::model::Problem;
use super::super::solver::SolverKind;
use super::super::words::Words as _;

/// All rules broken by faces that may touch.
pub(super) fn check_contact(problem: &Problem) -> Vec<MistakeAt> {
    let contact = |crack: u32| Key::new("crack").index(crack as usize).name("contact");
    let Some(&first) = problem.contacts.keys().next() else { return Vec::new() };
    let of_crack = |&crack: &u32| Some(contact(crack).mistake(bad_crack(problem, crack as usize)?));
    let mut found: Vec<MistakeAt> = problem.contacts.keys().filter_map(of_crack).collect();
    for (index, condition) in problem.boundary.iter().enumerate() {
        let BorderPart::Crack { crack, .. } = condition.on else { continue };
        if problem.contacts.contains_key(&(crack as u32)) {
            let message = "the faces of this crack may touch, and press on each other with what is not known \
                           before; leave this [[boundary]] out, or leave `contact` out";
            let key = Key::new("boundary").index(index).name("on");
            found.push(key.mistake(message).with_other(contact(crack as u32)));
        }
    }
    if !problem.forces.is_empty() {
        let message = "no force at a point can act beside faces that touch; spread it as a traction, or leave \
                       `contact` out";
        let key = Key::new("force").index(0).name("at");
        found.push(key.mistake(message).with_other(contact(first)));
    }
    if problem.solver.kind == SolverKind::Multilevel {
        let message = "faces that touch need the direct solver, since coarser levels do not see them; leave `kind` \
                       out";
        found.push(Key::of("solver.kind").mistake(message).with_other(contact(first)));
    }
    found
}

/// Why the faces of a crack cannot touch.
fn bad_crack(problem: &Problem, crack: usize) -> Option<String> {
    let enrichment = problem.discretization.enrichment;
    match () {
        () if crack >= problem.cracks.len() => Some(no_such("crack", crack, problem.cracks.len())),
        () if problem.equation.elastic().is_none() => {
            Some("only faces of elastic bodies touch; leave `contact` out".to_owned())
        }
        () if problem.edge_of(crack).is_some() => Some(
            "one face alone of a crack on an edge is in the plate; leave `contact` out, or model the whole plate"
                .to_owned(),
        ),
        () if !enrichment.has_jumps() => Some(format!(
            "with `enrichment = \"{}\"` faces do not part, so that they cannot touch; take another enrichment",
            enrichment.word()
        )),
        () => None,
    }
}
