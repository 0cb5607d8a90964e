//! Warnings about the faces of cracks: whether they open.

use super::short;
use ppum::crack::{Crack, SegmentId, Side, TipId};
use ppum::dataset::{Warning, WarningKind};
use ppum::edge::Edge;
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
    places: &LocationText,
) -> Vec<Warning> {
    if field.equation.elastic().is_none() || field.components() != 2 {
        return Vec::new();
    }
    let of_crack = |(index, crack): (u32, &Crack)| {
        let symmetry = |end| symmetry_of_field(problem?, TipId { crack: index, end });
        let symmetry = crack.tips().find_map(symmetry);
        CrackFaces { field, symmetry, crack, index }.overlap(remedy(problem, index), places)
    };
    (0..).zip(&field.step.cracks).filter_map(of_crack).collect()
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

/// The faces of a crack in a field.
struct CrackFaces<'a> {
    field: &'a Field<'a>,
    /// Its symmetry to a crack of which one face is in the body.
    symmetry: Option<Symmetry>,
    crack: &'a Crack,
    index: u32,
}

impl CrackFaces<'_> {
    fn overlap(&self, remedy: &str, places: &LocationText) -> Option<Warning> {
        let samples = self.samples();
        // an opening is small against other jumps, or against what the strain makes of the length
        let jump = samples.iter().fold(0.0f64, |m, p| m.max(p.jump));
        let strain = samples.iter().map(|p| p.strain).sum::<f64>() / samples.len() as f64;
        let limit = -NOISE * jump.max(strain * self.crack.length());
        let closed = samples.iter().filter(|p| p.opening < limit).count();
        let worst = samples.iter().min_by(|a, b| a.opening.total_cmp(&b.opening))?;
        let message = format!(
            "crack {}: its faces overlap on {:.0} % of its length, most at {} by {}: the solution \
             has no meaning near it; {remedy}",
            self.index,
            (100.0 * closed as f64 / samples.len() as f64).max(1.0),
            places.show(worst.at),
            short(-worst.opening)
        );
        let numbers = [worst.opening, limit];
        (worst.opening < limit)
            .then(|| Warning::new(WarningKind::FacesOverlap, Some(worst.at), numbers, message))
    }

    /// Samples along the crack, equally apart and none at a vertex.
    fn samples(&self) -> Vec<FaceSample> {
        let length = self.crack.length();
        let of_edge = |(segment, edge): (u32, Edge)| {
            let count = (SAMPLES as f64 * edge.length() / length).ceil();
            let on = SegmentId { crack: self.index, segment };
            let part = move |k: usize| (k as f64 + 0.5) / count;
            let sample = move |part| self.sample(on, edge.at(part), edge.tangent(part).left());
            (0..count as usize).filter_map(move |k| sample(part(k)))
        };
        (0..).zip(self.crack.edges()).flat_map(of_edge).collect()
    }

    fn sample(&self, on: SegmentId, at: Vec2, normal: Vec2) -> Option<FaceSample> {
        let mut local = self.field.on(on, at);
        let mut face = |side: Side| {
            let mut u = [Jet::constant(0.0); 2];
            local.evaluate::<1>(Vec2::ZERO, side, &mut u).then_some(u)
        };
        let above = face(Side::Above)?;
        // of a crack on an edge the other face is the image of this one
        let below = if self.symmetry.is_some() { above } else { face(Side::Below)? };
        let value = |u: [Jet<f64>; 2]| vec2(u[0].v, u[1].v);
        let opening = normal * value(above).dot(normal);
        let jump = match self.symmetry {
            None => value(above) - value(below),
            Some(Symmetry::Symmetric) => opening * 2.0,
            Some(Symmetry::Antisymmetric) => (value(above) - opening) * 2.0,
        };
        let strain = |u: [Jet<f64>; 2]| u[0].x.hypot(u[1].y).hypot(0.5 * (u[0].y + u[1].x));
        let strain = strain(above).min(strain(below));
        Some(FaceSample { at, opening: jump.dot(normal), jump: jump.length(), strain })
    }
}
