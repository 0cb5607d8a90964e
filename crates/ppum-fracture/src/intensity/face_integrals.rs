//! The integrals over the faces of the crack with the field there: of the interaction integral the
//! part behind kinks and that of faces that touch; of J the whole, with the tractions of loads.

use super::auxiliary::{stress, work};
use super::integral::{Interaction, TurnedField};
use super::path::{CrackPiece, PathSegment};
use super::sums::{Gradients, Integrals, cut_off, square, turned};
use ppum::crack::{SegmentId, Side};
use ppum::jet::Jet;
use ppum::vec2::Vec2;
use ppum_solve::quadrature::{CrackFace, EdgeRule, Quadrature};

impl Interaction<'_> {
    /// The integrals over both faces of a piece.
    pub(super) fn on_crack(&self, quadrature: &Quadrature<'_>, bend: &CrackPiece) -> Integrals {
        let segment = SegmentId { crack: self.path.tip().crack, segment: bend.part.segment };
        let mut sums = Integrals::default();
        for side in [Side::Above, Side::Below] {
            let face = CrackFace { segment, side };
            let ends = [bend.edge.from, bend.edge.to];
            for rule in quadrature.part_of_face(self.space.cell(bend.cell), ends, face) {
                sums = sums.plus(self.along(bend, face, &rule));
                sums.doubt.add(&rule.doubt);
            }
        }
        sums
    }

    /// The points of a rule on one face in a cell.
    fn along(
        &self,
        bend: &CrackPiece,
        CrackFace { segment, side }: CrackFace,
        rule: &EdgeRule,
    ) -> Integrals {
        let between = self.between(rule, bend.cell);
        let mut jets = vec![Jet::constant(0.0); 2 * rule.offsets.len()];
        let local = self.field.on(segment, rule.anchor);
        local.evaluate_over::<1>(&rule.offsets, side, &rule.patches, &mut jets);
        self.on_face(&bend.part, rule, &jets, &between)
    }

    /// The points of a rule on one face, with the field there, and the tractions between faces that
    /// touch; none if there are not any.
    pub(super) fn on_face(
        &self,
        part: &PathSegment,
        rule: &EdgeRule,
        jets: &[Jet<f64>],
        between: &[Vec2],
    ) -> Integrals {
        let Some(CrackFace { segment, side }) = rule.face else { return Integrals::default() };
        let tip = self.path.on(part, rule.anchor);
        let mut sums = Integrals::default();
        let points = rule.offsets.iter().zip(&rule.weights).zip(&rule.normals);
        let between = between.iter().copied().chain(std::iter::repeat(Vec2::ZERO));
        for ((((offset, &weight), normal), u), t) in points.zip(jets.chunks_exact(2)).zip(between) {
            let point = tip.point([offset.x, offset.y], side);
            let world = rule.anchor + *offset;
            let elastic = self.elastic(u, (world, Some((segment, side))), tip.axis);
            let normal = turned(tip.axis, (*normal).into());
            let (of, way) = (self.turned_field(u, world, tip.axis), self.way(world));
            let (hoop, hoop_energy) =
                self.hoop_on_face(u, (world, Some((segment, side))), (&point, normal));
            let mut parts = self.body.fields_at::<1>(&point).map(|auxiliary| {
                let [a, b] = auxiliary.derivative;
                -self.crossing(&of, &auxiliary.gradient, way, normal) - (t.x * a + t.y * b)
            });
            parts.iter_mut().zip(hoop).for_each(|(part, hoop)| *part -= hoop);
            let part = |radius: f64| parts.map(|m| cut_off(square(&point), radius).0 * m);
            let modes = self.radii.map(part);
            let q = cut_off(square(&point), self.largest()).0;
            let traction = self.traction(side, world, tip.axis) + t;
            let energy = 0.5 * work(&stress(self.moduli(world), &elastic), &elastic) + hoop_energy;
            // E_j n_j = W w·n − t_i 𝓛u_i
            let j = q * (energy * way.dot(normal) - traction.dot(of.derivative.into()));
            sums = sums.plus(Integrals { modes, j, ..Integrals::default() }.times(weight));
        }
        sums
    }

    /// σᵃ_ij ((e₃ × w)_j ∂u_i/∂s − c n_j (e₃ × u)_i), with s along the face so that the normal
    /// points to its left, and the curvature c: what P_j n_j is except for the traction's part.
    fn crossing(&self, of: &TurnedField, aux: &Gradients, way: Vec2, normal: Vec2) -> f64 {
        let (stress, along) = (stress(self.body.moduli, aux), -normal.left());
        let traction = stress.map(|row| Vec2::from(row).dot(normal));
        let turned = Vec2::from(traction).dot(of.displacement.left()) * self.body.curvature;
        let across = |i: usize| Vec2::from(stress[i]).dot(way.left());
        let stretched =
            (0..2).map(|i| across(i) * Vec2::from(of.gradient[i]).dot(along)).sum::<f64>();
        stretched - turned
    }

    /// The traction of a load on a face in the tip's frame.
    fn traction(&self, side: Side, world: Vec2, axis: Vec2) -> Vec2 {
        let crack = self.path.tip().crack;
        turned(axis, self.loads.traction(crack, side, world).unwrap_or_default())
    }
}
