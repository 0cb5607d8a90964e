//! The patch that a point belongs to, of those that cover it.

use ppum::crack::Side;
use ppum::field::{Field, LocalField};
use ppum::mesh::{Mesh, Shape};
use ppum::vec2::Vec2;

/// The patch that a point belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Owner {
    /// The patch whose cell holds the point.
    Cell {
        /// Its index.
        patch: u32,
        /// Level of the cell.
        level: u8,
    },
    /// For a cover without cells, the patch with the largest φ.
    Box {
        /// Its index.
        patch: u32,
    },
    /// The element of a mesh that holds the point, or its part.
    Element(MeshElement),
}

/// An element, or a part of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshElement {
    /// Index of the patch.
    pub patch: u32,
    /// Number of the element in its own mesh.
    pub number: u32,
    /// Its shape.
    pub shape: Shape,
    /// Degree of its map.
    pub map_degree: u8,
    /// The largest degree of its polynomials.
    pub order: u8,
    /// True of a part of an element that a level field cuts.
    pub is_cut: bool,
}

impl Owner {
    /// The owner of a point `anchor + offset`; none outside.
    #[must_use]
    pub fn at(field: &Field<'_>, anchor: Vec2, offset: Vec2) -> Option<Self> {
        let mut local = field.at(anchor);
        let mut patches = Vec::new();
        if local.contains(offset) {
            field.tree.query_point(anchor + offset, &mut patches);
        }
        Self::of(field, &mut local, offset, &patches)
    }

    /// The owner of a point of the body, of the patches that cover it; none if no patch does.
    pub(crate) fn of(
        field: &Field<'_>,
        local: &mut LocalField<'_>,
        offset: Vec2,
        patches: &[u32],
    ) -> Option<Self> {
        let (partition, point) = (&field.step.partition, local.anchor + offset);
        match partition.mesh() {
            Some(mesh) => {
                let patch = local.owner(offset, Side::Above)?;
                Some(Self::Element(MeshElement::new(field, mesh, patch)))
            }
            None if partition.boxes().has_cells() => in_cell(field, point, patches),
            None => {
                let patch = local.owner(offset, Side::Above)?;
                Some(Self::Box { patch: patch as u32 })
            }
        }
    }

    /// Index of the patch.
    #[must_use]
    pub fn patch(self) -> u32 {
        match self {
            Self::Cell { patch, .. } | Self::Box { patch } => patch,
            Self::Element(element) => element.patch,
        }
    }
}

impl MeshElement {
    fn new(field: &Field<'_>, mesh: &Mesh, patch: usize) -> Self {
        let degrees = field.data.blocks(patch).map(|block| field.data.block_degree[block]);
        Self {
            patch: patch as u32,
            number: mesh.element[patch],
            shape: mesh.shape[patch],
            map_degree: mesh.map_degree[patch],
            order: degrees.max().unwrap_or(0),
            is_cut: !mesh.clips(patch).is_empty(),
        }
    }
}

/// The patch whose cell a point lies in: borders belong to the cell on their right and above.
fn in_cell(field: &Field<'_>, point: Vec2, patches: &[u32]) -> Option<Owner> {
    let partition = field.step.partition.boxes();
    let cell = |patch: &u32| partition.cell[*patch as usize];
    let own = patches.iter().filter(|patch| cell(patch).contains(point));
    let last = own.max_by(|a, b| {
        let [a, b] = [cell(a).min, cell(b).min];
        a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
    });
    // in a sliver beside a hole whose own cell is gone, the patch that lies nearest
    let nearest = || {
        let distance = |patch: &&u32| cell(patch).distance(point);
        patches.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    let patch = *last.or_else(nearest)?;
    Some(Owner::Cell { patch, level: partition.level[patch as usize] })
}
