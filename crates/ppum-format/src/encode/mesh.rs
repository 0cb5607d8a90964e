//! Meshes.

use ppum::mesh::{Clip, Mesh, Shape};
use ppum::polynomial::PolynomialSpace;

use super::GroupWriter;
use crate::content::{Array, ArrayValues};
use crate::error::WriteError;
use crate::names::{MESH, SHAPES, SPACES, code};

pub(super) fn mesh(group: &mut GroupWriter, mesh: &Mesh) -> Result<(), WriteError> {
    let shape: Option<Vec<u8>> = mesh.shape.iter().map(|s: &Shape| code(SHAPES, *s)).collect();
    group.attribute("kind", Array::scalar(MESH.to_owned()));
    group.vector("shape", shape.ok_or_else(|| group.unknown("shape"))?);
    group.array("origin", Array::rows(mesh.origin.iter().map(|&p| <[f64; 2]>::from(p))));
    group.vector("map_degree", mesh.map_degree.iter().copied());
    spaces(group, "map_space", &mesh.map_space)?;
    group.vector("map_offset", mesh.map_offset.iter().copied());
    let shape = vec![2, mesh.map[0].len() as u64];
    group.array("map", Array { shape, values: ArrayValues::F64(mesh.map.concat()) });
    group.vector("element", mesh.element.iter().copied());
    if !mesh.clips.is_empty() {
        group.vector("clip_offsets", mesh.clip_offsets.iter().copied());
        group.vector("clip_field", mesh.clips.iter().map(|clip: &Clip| clip.field));
        group.vector("clip_side", mesh.clips.iter().map(|clip| u8::from(clip.is_above)));
    }
    Ok(())
}

/// The monomials of maps or of blocks.
pub(super) fn spaces(
    group: &mut GroupWriter,
    name: &str,
    spaces: &[PolynomialSpace],
) -> Result<(), WriteError> {
    let codes: Option<Vec<u8>> = spaces.iter().map(|space| code(SPACES, *space)).collect();
    group.vector(name, codes.ok_or_else(|| group.unknown(name))?);
    Ok(())
}
