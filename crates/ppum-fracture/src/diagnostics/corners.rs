//! Warnings about singular points of the boundary that the cells do not resolve.

use super::{above, percent, short, smaller_cells};
use ppum::border::touch;
use ppum::crack::{Crack, End};
use ppum::dataset::{Warning, WarningKind};
use ppum::field::Field;
use ppum::text::LocationText;
use ppum::vec2::{Rect, Vec2};
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

/// Angle from the radius, in degrees, above which a crack that meets the axis of a body of
/// revolution makes a cone whose point matters.
const FLAT: f64 = 1.0;

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
    let cones = cones(problem);
    let of_cone = |&(at, angle): &(Vec2, f64)| of_cone(at, angle, problem, places);
    corners(problem).iter().filter_map(of_corner).chain(cones.iter().filter_map(of_cone)).collect()
}

/// The places at which cracks meet the axis of a body of revolution, and their angles from the
/// radius in degrees.
fn cones(problem: &Problem) -> Vec<(Vec2, f64)> {
    let touch = touch(&problem.domain().bounds);
    let ends = |crack: &Crack| {
        [End::Start, End::Last].map(|end| (crack.end_point(end), crack.growth_direction(end)))
    };
    let cracks = problem.cracks().iter().filter(|_| problem.equation.is_axisymmetric());
    let on_axis = cracks.flat_map(ends).filter(|(at, _)| at.x.abs() <= touch);
    on_axis.map(|(at, d)| (at, d.y.abs().atan2(d.x.abs()).to_degrees())).collect()
}

/// The warning about the point of a cone: functions of its spherical wedge are not known here.
fn of_cone(at: Vec2, angle: f64, problem: &Problem, places: &LocationText) -> Option<Warning> {
    let message = format!(
        "{}: a crack meets the axis at {}° from the radius; at the point of such a cone stresses are infinite, and no \
         function is taken for them; {}",
        places.show(at),
        short((10.0 * angle).round() / 10.0),
        smaller_cells(Some(problem), "`center` and `radius`")
    );
    above(WarningKind::SingularPoint, Some(at), [angle, FLAT], message)
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
