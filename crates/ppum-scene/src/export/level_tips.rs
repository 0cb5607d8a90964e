//! Tips that level fields define in the elements of a mesh.

use ppum::function::{Frame, FunctionKind};

use super::elements::{ElementPlace, evaluate_elements};
use super::refine::RefinedMesh;
use super::torn::{TornPoint, ValueSide};

impl RefinedMesh<'_, '_> {
    /// Adds tips to the singular points: they are corners of the pieces of elements.
    pub(super) fn add_level_tips(&mut self, radius: Option<f64>) {
        let levels = |kind: &FunctionKind| {
            matches!(kind, FunctionKind::Formula { frame: Frame::Levels(_), .. })
        };
        if !self.field.step.functions.iter().any(|f| levels(&f.kind)) {
            return;
        }
        let place = |point: &TornPoint| match point.seen {
            ValueSide::Element(place) => Some(ElementPlace { inner: place.at, ..place }),
            ValueSide::Plane { .. } => None,
        };
        let places: Vec<_> = self.mesh.points.iter().filter_map(place).collect();
        let rows = evaluate_elements(self.field, &self.columns.quantities, &places);
        for (point, row) in self.mesh.points.iter().zip(rows.chunks(self.columns.len())) {
            self.singular.add(self.field, point.position, row, radius);
        }
    }
}
