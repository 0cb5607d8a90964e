//! Quantities at many points.

use super::kinds::Quantity;
use super::sample::{Sample, Source};
use crate::crack::Side;
use crate::field::LocalField;
use crate::jet::Jet;
use crate::mesh::grid::PointGrid;
use crate::vec2::Vec2;

impl Quantity {
    /// Several quantities at many points `anchor + offset`, a row for each point; NaN outside the
    /// domain.
    ///
    /// The field is evaluated once for all of them, on lanes, so points that follow each other
    /// should be near each other. The values are those of [`Quantity::at`] up to rounding.
    #[must_use]
    pub fn at_many(
        quantities: &[Self],
        local: &mut LocalField<'_>,
        offsets: &[Vec2],
        side: Side,
    ) -> Vec<f64> {
        let components = local.field.components();
        let mut jets = vec![Jet::constant(0.0); offsets.len() * components];
        if quantities.iter().any(|quantity| quantity.source() == Source::Gradient) {
            local.evaluate_into::<1>(offsets, side, &mut jets);
        } else {
            local.evaluate_into::<0>(offsets, side, &mut jets);
        }
        Self::rows(quantities, local, (offsets.iter().copied(), side), &jets)
    }

    /// Several quantities of jets at points, a row for each point.
    fn rows(
        quantities: &[Self],
        local: &mut LocalField<'_>,
        (offsets, side): (impl Iterator<Item = Vec2>, Side),
        jets: &[Jet<f64>],
    ) -> Vec<f64> {
        let mut rows = Vec::new();
        for (offset, jets) in offsets.zip(jets.chunks(local.field.components())) {
            let at = (offset, side);
            rows.extend(quantities.iter().map(|quantity| quantity.of_jets(local, at, jets)));
        }
        rows
    }

    /// Several quantities at points of one patch of a mesh, given by their δ, whoever owns them: a
    /// row for each point; see [`ElementField`](crate::mesh::ElementField). NaN of a cover.
    #[must_use]
    pub fn on_element(
        quantities: &[Self],
        local: &mut LocalField<'_>,
        patch: usize,
        points: &[Vec2],
    ) -> Vec<f64> {
        let components = local.field.components();
        let mut jets = vec![Jet::NAN; points.len() * components];
        let mut offsets = vec![Vec2::ZERO; points.len()];
        if let Some(element) = local.element(patch) {
            let has_gradient = quantities.iter().any(|q| q.source() == Source::Gradient);
            for ((&point, offset), jets) in
                points.iter().zip(&mut offsets).zip(jets.chunks_mut(components))
            {
                *offset = element.point(point).offset;
                match has_gradient {
                    true => element.evaluate::<1>((point, *offset), Side::Above, jets),
                    false => element.evaluate::<0>((point, *offset), Side::Above, jets),
                }
            }
        }
        Self::rows(quantities, local, (offsets.into_iter(), Side::Above), &jets)
    }

    /// A quantity of a field on a mesh at the points of a grid, row by row; NaN outside, and of a
    /// cover everywhere.
    #[must_use]
    pub fn on_grid(
        &self,
        local: &mut LocalField<'_>,
        grid: &PointGrid<'_>,
        side: Side,
    ) -> Vec<f64> {
        let components = local.field.components();
        let mut jets = vec![Jet::constant(f64::NAN); grid.x.len() * grid.y.len() * components];
        match self.source() {
            Source::Partition => {}
            Source::Gradient => local.evaluate_grid::<1>(grid, side, &mut jets),
            _ => local.evaluate_grid::<0>(grid, side, &mut jets),
        }
        Self::rows(std::slice::from_ref(self), local, (grid.offsets(), side), &jets)
    }

    /// The quantity where the field is known; NaN outside the domain.
    pub(crate) fn of_jets(
        &self,
        local: &mut LocalField<'_>,
        (offset, side): (Vec2, Side),
        jets: &[Jet<f64>],
    ) -> f64 {
        if self.source() == Source::Partition {
            return self.of_partition(local, offset).unwrap_or(f64::NAN);
        }
        if !local.has_values(offset, jets) {
            return f64::NAN;
        }
        if let Self::Face(face) = self {
            return face.of_jets(local, (offset, side), jets, Self::of_values);
        }
        self.of_values(local, offset, jets)
    }

    /// The quantity of a field that is known at a point of the domain.
    pub(super) fn of_values(&self, local: &LocalField<'_>, offset: Vec2, jets: &[Jet<f64>]) -> f64 {
        if let Self::Component(c) = self {
            return jets[*c as usize].v;
        }
        let (field, point) = (local.field, local.anchor + offset);
        let exact: Vec<_> = match self.source() {
            Source::Exact => (0..jets.len()).map(|c| field.exact(c, point)).collect(),
            _ => Vec::new(),
        };
        let offset = [offset.x, offset.y];
        let moduli = field.equation.moduli(local.anchor, offset);
        self.of_field(&Sample { anchor: local.anchor, offset, moduli, jets, exact: &exact })
    }
}
