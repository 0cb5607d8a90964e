//! Warnings about singular points of the boundary that the cells do not resolve.

use super::{above, percent, short, smaller_cells};
use ppum::dataset::{Warning, WarningKind};
use ppum::field::Field;
use ppum::text::LocationText;
use ppum::vec2::Rect;
use ppum_problem::Problem;
use ppum_solve::corner::{SingularCause, SingularCorner, corners};
use ppum_solve::norms::energy_of;
use ppum_solve::space::TrialSpace;

/// Part of the energy that may be missed at a singular point; factors nearby are off by several
/// times that.
const LARGE_MISS: f64 = 5e-4;

/// Part of their own energy that cells at a singular point miss, over (1 − λ)²: 0.5 to 2 in bodies
/// with clamped corners, restraints that end, corners of holes and kinks (order 2, held against
/// energies of another method).
const MISSED: f64 = 0.9;

/// The warnings about the singular points of a problem; `energy` is that of the field.
pub(super) fn of_corners(
    problem: &Problem,
    field: &Field<'_>,
    space: &TrialSpace<'_>,
    energy: f64,
    places: &LocationText,
) -> Vec<Warning> {
    let of_corner = |corner: &SingularCorner| {
        if corner.nature == SingularCause::Jump {
            return Some(infinite(corner, places));
        }
        if has_functions(corner, problem, space) {
            return None;
        }
        let cells = &space.partition().cell;
        let touching: Vec<_> =
            (0..cells.len()).filter(|&c| cells[c].distance(corner.at) == 0.0).collect();
        let size =
            touching.iter().map(|&c| cells[c].size()).fold(0.0f64, |m, s| m.max(s.x.max(s.y)));
        let share = energy_of(field, space, &touching) / energy;
        let missed = MISSED * corner.weakness().powi(2) * share;
        let message = unresolved(corner, [size, missed], problem, places);
        above(WarningKind::SingularPoint, Some(corner.at), [missed, LARGE_MISS], message)
    };
    corners(problem).iter().filter_map(of_corner).collect()
}

/// True if all patches that hold a corner have the functions of its wedge.
fn has_functions(corner: &SingularCorner, problem: &Problem, space: &TrialSpace<'_>) -> bool {
    let supports = (0..space.partition().len()).map(|patch| space.partition().support(patch));
    let mut holding = supports.filter(|support| support.contains(corner.at));
    let part = |support: Rect| support.intersection(&problem.domain().bounds);
    corner.wedge.is_some() && holding.all(|support| corner.has_room_for(&part(support)))
}

/// The warning about values that jump.
fn infinite(corner: &SingularCorner, places: &LocationText) -> Warning {
    let message = format!(
        "{}: the values given on the border jump there; such a field has infinite energy, and energies, reactions \
         and stresses nearby depend on the cells; make the values continuous",
        places.show(corner.at)
    );
    Warning::new(WarningKind::SingularPoint, Some(corner.at), [1.0, LARGE_MISS], message)
}

/// The message about cells of a size that miss a part of the energy.
fn unresolved(
    corner: &SingularCorner,
    [size, missed]: [f64; 2],
    problem: &Problem,
    places: &LocationText,
) -> String {
    let growth = match corner.nature {
        SingularCause::Load => "r ln r".into(),
        _ => format!("r^{}", short((1e3 * corner.exponent).round() / 1e3)),
    };
    format!(
        "{}: stresses are infinite at {} (displacements grow like {growth}), and cells {} wide miss about {} % of the \
         energy there; {}",
        places.show(corner.at),
        corner.nature.name(),
        short(size),
        percent(missed),
        smaller_cells(Some(problem), "`center` and `radius`")
    )
}
