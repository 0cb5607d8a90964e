//! Tractions between faces that touch, of a field that is known.
//!
//! They are the mean stress of both faces where these are closed, which is where σ_m + β \[u\]·m is
//! negative, as in the system (`assembly/contact.rs`); and nothing elsewhere. Any β serves, since
//! one of the two vanishes: the modulus over the size of the cells.

use crate::law::{Law, LawAt};
use crate::quadrature::EdgeRule;
use ppum::crack::{SegmentId, Side};
use ppum::field::{Field, LocalField};
use ppum::jet::Jet;
use ppum::vec2::{Vec2, vec2};
use ppum_problem::Problem;

/// The law between the faces of a crack.
#[derive(Clone, Copy, Debug)]
pub struct FaceLaw {
    /// Coulomb's coefficient of friction.
    pub(crate) friction: f64,
}

/// The traction on a face at a point, and the gap.
#[derive(Clone, Copy, Debug)]
pub struct FaceTraction {
    /// The traction on the face.
    pub traction: Vec2,
    /// The opening of faces that are closed, the overlap of others: zero of an exact field.
    pub(crate) gap: f64,
}

impl FaceTraction {
    /// No traction and no gap: nothing lies behind the point.
    const OPEN: Self = Self { traction: Vec2::ZERO, gap: 0.0 };
}

impl FaceLaw {
    /// That of a crack of a problem, if its faces may touch.
    pub(super) fn of(problem: &Problem, crack: u32) -> Option<Self> {
        problem.body.contact(crack).map(|friction| Self { friction })
    }

    /// The tractions at the points of a rule on a face in a cell of a size, and what the opening
    /// should not be.
    pub fn tractions(
        self,
        field: &Field<'_>,
        law: &Law<'_>,
        rule: &EdgeRule,
        size: f64,
    ) -> Vec<FaceTraction> {
        let Some(face) = rule.face else { return vec![FaceTraction::OPEN; rule.offsets.len()] };
        let local = field.on(face.segment, rule.anchor);
        let [above, below] = [Side::Above, Side::Below].map(|side| {
            let mut jets = vec![Jet::constant(0.0); 2 * rule.offsets.len()];
            local.evaluate_over::<1>(&rule.offsets, side, &rule.patches, &mut jets);
            jets
        });
        let points = rule.offsets.iter().zip(&rule.normals);
        let sides = above.chunks_exact(2).zip(below.chunks_exact(2));
        let at = |((&offset, &normal), (above, below)): ((&Vec2, &Vec2), _)| {
            let law = law.at(rule.anchor + offset);
            self.state(&law, [above, below], face.side, (normal, size))
        };
        points.zip(sides).map(at).collect()
    }

    /// The normal stress between the faces at a point of an edge; zero where they are open.
    pub fn pressed(
        self,
        field: &Field<'_>,
        law: &Law<'_>,
        (segment, at): (SegmentId, Vec2),
        size: f64,
    ) -> f64 {
        let mut local: LocalField<'_> = field.on(segment, at);
        let edge = field.step.cracks[segment.crack as usize].edge(segment.segment as usize);
        let normal = edge.tangent_towards(at).left();
        let mut on = |side: Side| {
            let mut u = [Jet::constant(0.0); 2];
            local.evaluate::<1>(Vec2::ZERO, side, &mut u).then_some(u)
        };
        let (Some(above), Some(below)) = (on(Side::Above), on(Side::Below)) else { return 0.0 };
        let side = Side::Below;
        self.state(&law.at(at), [&above, &below], side, (normal, size)).traction.dot(normal)
    }

    /// The state of one face with its normal out of the body there, of the fields on both.
    fn state(
        self,
        law: &LawAt,
        [above, below]: [&[Jet<f64>]; 2],
        side: Side,
        (normal, size): (Vec2, f64),
    ) -> FaceTraction {
        let flux = |u: &[Jet<f64>]| law.stress(&law.strain(u));
        let traction = flux(above).plus(&flux(below)).traction(normal) * 0.5;
        let jump = vec2(above[0].v - below[0].v, above[1].v - below[1].v);
        let opening = if side == Side::Below { jump.dot(normal) } else { -jump.dot(normal) };
        let stress = traction.dot(normal);
        // false where there are no values
        let is_closed = stress + law.modulus(0) / size * opening < 0.0;
        let traction = match () {
            () if !is_closed => Vec2::ZERO,
            () if self.friction > 0.0 => traction,
            () => normal * stress,
        };
        FaceTraction { traction, gap: if is_closed { opening } else { opening.min(0.0) } }
    }
}
