//! The stored results of a solution: stress intensity factors, warnings, reactions.

use std::collections::BTreeMap;

use super::errors::{
    CheckResult, Errors, check_all, check_index, check_length, check_number, check_numbers,
    check_points, require,
};
use crate::crack::{Crack, CrackEnd, End, TipId};
use crate::dataset::{Equation, Reaction, Step, TipIntensity, Warning};

/// Most rings of a tip: each is compared with all others.
const MAX_RINGS: usize = 64;

/// Each tip has one entry at most, and ends of other kinds have none.
pub(super) fn check_intensities(step: &Step, errors: &mut Errors) {
    let tips = step.intensities.iter().enumerate().map(|(k, intensity)| (intensity.tip, k));
    let first: BTreeMap<_, _> = tips.rev().collect();
    errors.each("intensities", &step.intensities, |k, intensity| {
        check_intensity(intensity, &step.cracks)?;
        let other = first[&intensity.tip];
        require(other == k, "", || format!("is of the same tip as intensities[{other}]; keep one"))
    });
}

fn check_intensity(intensity: &TipIntensity, cracks: &[Crack]) -> CheckResult {
    let TipId { crack, end } = intensity.tip;
    check_index("crack", crack as usize, cracks.len(), "cracks")?;
    let kind = cracks[crack as usize].ends[usize::from(end == End::Last)];
    require(kind == CrackEnd::Tip, "end", || {
        format!("the {} of crack {crack} is no tip", end.name())
    })?;
    check_number("k1", intensity.k1)?;
    check_number("k2", intensity.k2)?;
    check_number("t_stress", intensity.t_stress.unwrap_or(0.0))?;
    check_number("j", intensity.j.unwrap_or(0.0))?;
    let error = intensity.error.unwrap_or(0.0);
    require(error >= 0.0 && error.is_finite(), "error", || {
        format!("the estimated error is {error}, but must be finite and not negative")
    })?;
    require(intensity.rings.len() <= MAX_RINGS, "rings", || {
        format!("there are {} rings, but at most {MAX_RINGS} may be", intensity.rings.len())
    })?;
    check_all(
        "rings",
        &intensity.rings,
        |r| [r.r1, r.r2, r.k1, r.k2].iter().all(|v| v.is_finite()) && 0.0 <= r.r1 && r.r1 < r.r2,
        |r| format!("r1 = {}, r2 = {}: expected finite values and 0 ≤ r1 < r2", r.r1, r.r2),
    )
}

pub(super) fn check_warning(warning: &Warning) -> CheckResult {
    require(!warning.kind.to_string().trim().is_empty(), "kind", || "is empty".into())?;
    check_points("at", warning.at.as_slice())?;
    check_number("value", warning.value)?;
    check_number("limit", warning.limit)
}

pub(super) fn check_reaction(
    reaction: &Reaction,
    components: usize,
    equation: &Equation,
) -> CheckResult {
    require(!reaction.on.trim().is_empty(), "on", || "is empty".into())?;
    let of = "one per component of the first field";
    check_length("held", reaction.held.len(), components, of)?;
    check_length("force", reaction.force.len(), components, of)?;
    check_numbers("force", &reaction.force)?;
    let mut free = reaction.held.iter().zip(&reaction.force).filter(|(held, _)| !**held);
    require(free.all(|(_, &force)| force == 0.0), "force", || {
        "must be 0 of components that are not held".into()
    })?;
    check_number("moment", reaction.moment)?;
    require(equation.components() > 1 || reaction.moment == 0.0, "moment", || {
        format!("is {}, but a potential has none: expected 0", reaction.moment)
    })
}
