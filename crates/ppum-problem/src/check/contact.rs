//! Rules for cracks whose faces may touch.

use crate::data::{BoundaryPart, ProblemData};
use crate::file::{Key, KeyError, no_such};

/// All rules broken by cracks whose faces may touch.
pub(super) fn check_contact(problem: &ProblemData) -> Vec<KeyError> {
    let contact = |crack: usize| Key::new("crack").index(crack).name("contact");
    let of_crack = |(crack, _)| Some(contact(crack).error(bad_crack(problem, crack)?));
    let mut found: Vec<KeyError> = problem.body.contacts().filter_map(of_crack).collect();
    for (crack, friction) in problem.body.contacts() {
        let key = Key::new("crack").index(crack).name("friction");
        found.extend(key.out_of_range(friction));
    }
    for (index, condition) in problem.boundary.iter().enumerate() {
        let BoundaryPart::Crack { crack, .. } = condition.on else { continue };
        if problem.body.contact(crack as u32).is_some() {
            let message = "the faces of this crack may touch, and press on each other with what is not known \
                           before; leave this [[boundary]] out, or leave `contact` out";
            let key = Key::new("boundary").index(index).name("on");
            found.push(key.error(message).with_other(contact(crack)));
        }
    }
    found
}

/// Why the faces of a crack cannot touch.
fn bad_crack(problem: &ProblemData, crack: usize) -> Option<String> {
    if crack >= problem.cracks().len() {
        return Some(no_such("crack", crack, problem.cracks().len()));
    }
    let message = "one face alone of a crack on the border is in the plate; leave `contact` out, or model the whole \
                   plate";
    problem.body.line_of(crack).map(|_| message.to_owned())
}
