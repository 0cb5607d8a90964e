//! An element of a mesh by its own coordinate, with its displacement.
//!
//! Leaves of elements are parts of the reference shape: curved edges are straight there, and
//! Newton's method stays on the polynomials of one patch, whoever owns the point.

use ppum::crack::Side;
use ppum::field::LocalField;
use ppum::jet::Jet;
use ppum::mesh::ElementField;
use ppum::vec2::{Vec2, vec2};

use super::DeformedView;
use super::map::{DeformationChart, DeformationMap, DeformedPoint, Preimage, gradient, moved};
use crate::pieces::{ConvexPiece, ElementCuts, INSET};

/// A patch of a mesh as a part of the body.
pub(super) struct ElementChart<'m, 'f> {
    local: &'m LocalField<'f>,
    element: ElementField<'m, 'f>,
    cuts: ElementCuts,
}

impl<'m, 'f> ElementChart<'m, 'f> {
    /// A patch of a mesh; none of boxes.
    pub(super) fn new(map: &'m DeformationMap<'f>, patch: u32) -> Option<Self> {
        let local = map.local();
        let mesh = local.field.step.partition.mesh()?;
        let element = local.element(patch as usize)?;
        let cuts = ElementCuts::new(local.field, mesh, &element, local.anchor);
        Some(Self { local, element, cuts })
    }

    /// The corners of the reference shape.
    pub(super) fn corners(&self) -> Vec<Vec2> {
        self.element.corners()
    }

    /// The offset of a point from the anchor.
    pub(super) fn offset(&self, p: Vec2) -> Vec2 {
        self.element.point(p).offset
    }

    pub(super) fn is_cut(&self) -> bool {
        !self.cuts.is_empty()
    }

    /// True if the clips of the patch hold.
    pub(super) fn is_kept(&self, p: Vec2) -> bool {
        self.cuts.keep(&self.element, p)
    }

    /// The pieces of a part of the reference shape.
    pub(super) fn pieces(&self, corners: &[Vec2]) -> Vec<ConvexPiece> {
        match self.is_cut() {
            true => self.cuts.pieces(&self.element, corners),
            false => vec![ConvexPiece::uncut(corners, INSET)],
        }
    }

    /// True if a curved line may cut a part of the reference shape.
    pub(super) fn may_bend(&self, corners: &[Vec2]) -> bool {
        self.cuts.may_bend(&self.element, corners)
    }
}

impl DeformationChart for ElementChart<'_, '_> {
    fn image(&mut self, view: &DeformedView<'_>, p: Vec2) -> Option<DeformedPoint> {
        let (point, mut jets) = (self.element.point(p), [Jet::constant(0.0); 2]);
        self.element.evaluate::<1>((p, point.offset), Side::Above, &mut jets);
        let at = moved(view, point.offset, jets.map(|jet| jet.v));
        let world = DeformedPoint { at, gradient: gradient(view, jets) };
        let gradient = point.columns.map(|column| world.carried(column));
        at.is_finite().then_some(DeformedPoint { at, gradient })
    }

    fn place(&mut self, view: &DeformedView<'_>, p: Vec2) -> Option<Vec2> {
        let (offset, mut jets) = (self.offset(p), [Jet::constant(0.0); 2]);
        self.element.evaluate::<0>((p, offset), Side::Above, &mut jets);
        let place = moved(view, offset, jets.map(|jet| jet.v));
        place.is_finite().then_some(place)
    }

    fn goes_on(&mut self, from: Vec2, to: Vec2) -> bool {
        self.element.margin(to) >= 0.0 && self.cuts.are_together(&self.element, from, to)
    }

    fn material(&mut self, found: Preimage) -> Option<Preimage> {
        let point = self.element.point(found.offset);
        let is_owner = self.local.owner(point.offset, Side::Above) == Some(self.element.patch());
        let [a, b] = point.columns;
        let shape = DeformedPoint { at: Vec2::ZERO, gradient: [a, b] };
        let units = [vec2(1.0, 0.0), vec2(0.0, 1.0)];
        let gradient = units.map(|unit| found.image.carried(shape.pulled_back(unit)));
        let image = DeformedPoint { gradient, ..found.image };
        is_owner.then_some(Preimage { offset: point.offset, image })
    }
}
