//! The fields of forces at points, which are in the space with coefficients that are known.
//!
//! With z = r e^{iθ} from the point, Kolosov's constant κ and F = F_x + i F_y, in the body
//! (Kelvin)
//!
//! ```text
//! 2μ (u_x + i u_y) = (−2κ F ln r + F̄ e^{2iθ}) / (2π (1 + κ))
//! ```
//!
//! and at a straight boundary (Flamant), θ from the normal into the body
//!
//! ```text
//! 2μ (u_x + i u_y) = (−(κ + 1) F ln r − (κ − 1) i F θ + F̄ e^{2iθ}) / 2π
//! ```
//!
//! With the functions of patches, u = u_s + w: u_s = Σ φ_i S of the patches near the point has no
//! unknowns, and w is a field like any other under the loads F·v(x₀) − a(u_s, v). The energy of u_s
//! is infinite and needed nowhere.

use super::known::{KnownField, on_side};
use ppum::dataset::Material;
use ppum::function::{Frame, Function, FunctionKind, NonsmoothPoints, Role};
use ppum::vec2::{Vec2, vec2};
use ppum_problem::{Force, ForcePlace, Problem};
use std::f64::consts::PI;

/// The functions of the angle and the distance, the last at boundaries only.
const TEXTS: [&str; 4] = ["log(r)", "(x^2 - y^2)/r^2", "2*x*y/r^2", "theta"];

/// Distances to the next boundary or crack that a patch with the force may reach: what the boundary
/// answers is beyond its polynomials where it is farther.
const REACH: f64 = 3.0;

/// The fields of the forces of a problem in order; of those whose place is no good there is none.
pub(super) fn fields(problem: &Problem) -> Vec<KnownField> {
    let material = problem.equation.elastic().and_then(|elastic| elastic.uniform());
    let field = |(number, force): (usize, &Force)| {
        let place = problem.place_of(force).ok()?;
        Some(known_field((number, force), place, problem, material.as_ref()?))
    };
    problem.forces.iter().enumerate().filter_map(field).collect()
}

/// The field S of a force.
fn known_field(
    (number, force): (usize, &Force),
    place: ForcePlace,
    problem: &Problem,
    material: &Material,
) -> KnownField {
    let (axis, coefficients) = match place {
        ForcePlace::Inside => (vec2(1.0, 0.0), kelvin(force.value, material)),
        ForcePlace::Border { inward, .. } => (inward, flamant(force.value, inward, material)),
    };
    let side = place.face().map(|(segment, side)| (segment.crack, side));
    let function = |(k, text): (usize, &&str)| Function {
        name: format!("force at [{}, {}], {number}.{k}", force.at.x, force.at.y),
        kind: FunctionKind::Formula {
            text: on_side(text, side),
            frame: Frame::Fixed { origin: force.at, angle: axis.y.atan2(axis.x) },
            parameters: Vec::new(),
            declared: NonsmoothPoints { singular: vec![Vec2::ZERO], ..NonsmoothPoints::default() },
            role: Role::Force,
        },
    };
    let functions = TEXTS.iter().take(coefficients.len()).enumerate().map(function).collect();
    let room = problem.room_of(force, place);
    let reach = room.min(REACH * problem.next_to(force));
    KnownField {
        at: force.at,
        load: force.value,
        face: place.face(),
        room,
        reach,
        functions,
        coefficients,
    }
}

/// The coefficients of the functions in Kelvin's field, for each component.
fn kelvin(Vec2 { x, y }: Vec2, material: &Material) -> Vec<[f64; 2]> {
    let kappa = material.kolosov();
    let unit = 1.0 / (4.0 * PI * material.mu() * (1.0 + kappa));
    let all = [[-2.0 * kappa * x, -2.0 * kappa * y], [x, -y], [y, x]];
    all.map(|pair| pair.map(|c| unit * c)).to_vec()
}

/// Flamant's solution, with the normal into the body, from which the angle is measured.
fn flamant(force: Vec2, inward: Vec2, material: &Material) -> Vec<[f64; 2]> {
    let kappa = material.kolosov();
    let unit = 1.0 / (4.0 * PI * material.mu());
    let (x, y) = (force.dot(inward), force.dot(inward.left()));
    let all = [
        [-(kappa + 1.0) * x, -(kappa + 1.0) * y],
        [x, -y],
        [y, x],
        [(kappa - 1.0) * y, -(kappa - 1.0) * x],
    ];
    let in_world = |[along, across]: [f64; 2]| inward * along + inward.left() * across;
    all.map(|pair| in_world(pair) * unit).map(|c| [c.x, c.y]).to_vec()
}
