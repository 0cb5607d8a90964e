//! Warnings about the faces of cracks: whether they open.

use super::{short, warning};
use ppum::crack::{Crack, SegmentId, Side, TipId};
use ppum::dataset::{Warning, WarningKind};
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::text::LocationText;
use ppum::vec2::{Vec2, vec2};
use ppum_problem::{Problem, Symmetry};
use ppum_solve::terms::{face_law, symmetry_of_field};

/// Places along a crack at which its opening is looked at.
const SAMPLES: usize = 96;

/// Part of a crack's scale by which faces may overlap where they should just touch.
const NOISE: f64 = 5e-3;

/// The warnings about the faces of all cracks of a displacement.
pub(super) fn of_faces(
    field: &Field<'_>,
    problem: Option<&Problem>,
    seats: &LocationText,
) -> Vec<Warning> {
    if field.equation.elastic().is_none() || field.components() != 2 {
        return Vec::new();
    }
    let of_crack = |(k, own): (usize, &Crack)| {
        let crack = k as u32;
        let symmetry = |end| symmetry_of_field(problem?, TipId { crack, end });
        let symmetry = own.tips().find_map(symmetry);
        overlap((field, symmetry), (k, own), (seats, remedy(problem, crack)))
    };
    field.step.cracks.iter().enumerate().filter_map(of_crack).collect()
}

/// Returns the remedy for faces of a crack that overlap.
pub(super) fn remedy(problem: Option<&Problem>, crack: u32) -> &'static str {
    match problem {
        Some(problem) if face_law(problem, crack).is_some() => "use smaller cells along the crack",
        _ => {
            "let its faces touch (`contact = true`), give them a pressure, or leave out a crack that is pressed together"
        }
    }
}

/// Opening and strain at a point of a crack.
struct FaceSample {
    at: Vec2,
    /// Normal component of the jump.
    opening: f64,
    /// Length of the jump.
    jump: f64,
    /// Magnitude of the strain beside the crack.
    strain: f64,
}

/// A field, and its symmetry to a crack of which one face is in the body.
type FieldAtFaces<'a> = (&'a Field<'a>, Option<Symmetry>);

fn overlap(
    field: FieldAtFaces<'_>,
    (index, crack): (usize, &Crack),
    (seats, remedy): (&LocationText, &str),
) -> Option<Warning> {
    let places: Vec<FaceSample> =
        places(crack, index).filter_map(|p| FaceSample::new(field, p)).collect();
    // an opening is small against other jumps, or against what the strain makes of the length
    let jump = places.iter().fold(0.0f64, |m, p| m.max(p.jump));
    let strain = places.iter().map(|p| p.strain).sum::<f64>() / places.len() as f64;
    let scale = jump.max(strain * crack.length());
    let limit = -NOISE * scale;
    let closed = places.iter().filter(|p| p.opening < limit).count();
    let worst = places.iter().min_by(|a, b| a.opening.total_cmp(&b.opening))?;
    (worst.opening < limit).then(|| {
        let message = format!(
            "crack {index}: its faces overlap on {:.0} % of its length, most at {} by {}: the solution \
             has no meaning near it; {remedy}",
            (100.0 * closed as f64 / places.len() as f64).max(1.0),
            seats.show(worst.at),
            short(-worst.opening)
        );
        warning(WarningKind::FacesOverlap, Some(worst.at), [worst.opening, limit], message)
    })
}

/// Points along a crack, equally apart and none at a vertex, with their segment and the
/// normal there.
pub(super) fn places(crack: &Crack, index: usize) -> impl Iterator<Item = (Vec2, SegmentId, Vec2)> {
    let length = crack.length();
    (0..).zip(crack.points.windows(2)).flat_map(move |(segment, s)| {
        let (a, way) = (s[0], s[1] - s[0]);
        let count = (SAMPLES as f64 * way.length() / length).ceil();
        let at = move |k: usize| a + way * ((k as f64 + 0.5) / count);
        let segment = SegmentId { crack: index as u32, segment };
        (0..count as usize).map(move |k| (at(k), segment, way.unit().left()))
    })
}

impl FaceSample {
    fn new(
        (field, symmetry): FieldAtFaces<'_>,
        (at, on, normal): (Vec2, SegmentId, Vec2),
    ) -> Option<Self> {
        let mut local = field.on(on, at);
        let mut face = |side: Side| {
            let mut u = [Jet::constant(0.0); 2];
            local.evaluate::<1>(Vec2::ZERO, side, &mut u).then_some(u)
        };
        let above = face(Side::Above)?;
        // of a crack on an edge the other face is the image of this one
        let below = if symmetry.is_some() { above } else { face(Side::Below)? };
        let opening = normal * vec2(above[0].v, above[1].v).dot(normal);
        let jump = match symmetry {
            None => vec2(above[0].v - below[0].v, above[1].v - below[1].v),
            Some(Symmetry::Symmetric) => opening * 2.0,
            Some(Symmetry::Antisymmetric) => (vec2(above[0].v, above[1].v) - opening) * 2.0,
        };
        let strain = |u: [Jet<f64>; 2]| u[0].x.hypot(u[1].y).hypot(0.5 * (u[0].y + u[1].x));
        Some(Self {
            at,
            opening: jump.dot(normal),
            jump: jump.length(),
            strain: strain(above).min(strain(below)),
        })
    }
}
