//! A view of a field as shaders read it.

use ppum::dataset::FieldData;
use ppum::field::Field;
use ppum::vec2::{Vec2, vec2};
use ppum_render::view::View;

use super::geometry::PairGeometry;
use crate::layout::{halves, record};
use crate::scene::UploadedRegion;
use crate::scene::bodies::ComponentLanes;
use crate::scene::lattice::NO_PATCH;

record! {
    /// The uniform `view` of the shaders.
    ViewRecord {
        /// The view's centre in the world.
        center: vec2f,
        /// Lower left corner of the bins relative to the region's anchor, high and low.
        grid_high: vec2f,
        grid_low: vec2f,
        /// Size of a bin, high and low, and one over it.
        pitch_high: vec2f,
        pitch_low: vec2f,
        per_pitch: vec2f,
        /// One over the half-extent of the patches of a lattice, or of the largest ones.
        per_half: vec2f,
        /// Centre of the first pixel relative to the region's anchor, and the steps to the next
        /// column and row, high and low.
        first_high: vec2f,
        first_low: vec2f,
        step_high: vec2f,
        step_low: vec2f,
        /// Columns and rows of the image.
        pixels: vec2u,
        /// Columns and rows of the grid of bins.
        grid_size: vec2u,
        /// First pixel inside the domain's box, and the one after the last.
        inside_first: vec2u,
        inside_end: vec2u,
        /// Side of a pixel.
        pixel_size: f32,
        /// Addresses in the view's data: reference, cracks, holes.
        reference: u32,
        cracks: u32,
        holes: u32,
        n_holes: u32,
        /// The first texel of the bins' nodes in the region.
        nodes: u32,
        /// The patch whose φ is drawn, by the address of its body.
        chosen: u32,
        /// Colours: the kind of scale, its range and numbers.
        scale: u32,
        range_min: f32,
        range_max: f32,
        threshold: f32,
        scale_start: f32,
        per_span: f32,
    }
}

/// A view of a field as shaders read it.
#[derive(Clone, Debug)]
pub(crate) struct ViewData {
    pub(crate) record: ViewRecord,
    /// Geometry, then the reference.
    pub(crate) pairs: Vec<[f32; 2]>,
}

impl ViewData {
    /// A view of a field, whose patches are those of a region; `half` is what
    /// [`ViewRecord::per_half`] is of.
    pub(crate) fn new(
        field: &Field<'_>,
        view: &View,
        geometry: PairGeometry,
        place: &UploadedRegion,
        half: Option<Vec2>,
    ) -> Self {
        let PairGeometry { mut pairs, cracks, holes, n_holes } = geometry;
        let reference = pairs.len() as u32;
        pairs.extend(reference_of(field, view.center));
        let [xs, ys] = view.inside(&field.domain.bounds);
        let UploadedRegion { region, nodes, .. } = place;
        let (bins, side) = (&region.bins, view.pixel_size());
        let [grid_high, grid_low] = region.halves(bins.origin);
        let [pitch_high, pitch_low] = region.halves(bins.pitch);
        let first = (view.center - region.anchor) + view.offset(0, 0);
        let [first_high, first_low] = region.halves(first);
        let [step_high, step_low] = region.halves(vec2(side, -side));
        let one_over = |v: Vec2| [(1.0 / v.x) as f32, (1.0 / v.y) as f32];
        let record = ViewRecord {
            center: [view.center.x as f32, view.center.y as f32],
            grid_high,
            grid_low,
            pitch_high,
            pitch_low,
            per_pitch: one_over(bins.pitch),
            per_half: half.map_or([0.0; 2], one_over),
            first_high,
            first_low,
            step_high,
            step_low,
            pixels: view.pixels,
            grid_size: bins.size,
            inside_first: [xs.start as u32, ys.start as u32],
            inside_end: [xs.end as u32, ys.end as u32],
            pixel_size: side as f32,
            reference,
            cracks,
            holes,
            n_holes,
            nodes: *nodes,
            chosen: NO_PATCH,
            ..ViewRecord::default()
        };
        Self { record, pairs }
    }
}

/// The constants that splatted patches subtract from theirs, high and low, lane by lane: those of a
/// patch near the view's centre.
fn reference_of(field: &Field<'_>, center: Vec2) -> Vec<[f32; 2]> {
    let components = ComponentLanes::new(field.components());
    let bounds = field.domain.bounds;
    let mut covering = Vec::new();
    field.tree.query_point(center.max(bounds.min).min(bounds.max), &mut covering);
    let block = covering.first().and_then(|&patch| smooth_block(field, patch as usize));
    let constant = |data: &FieldData, component: usize| match block {
        Some(block) if component < components.count => data.block_coefficients(block, component)[0],
        _ => 0.0,
    };
    let lanes = components.lanes * components.groups;
    let all: Vec<_> = (0..lanes).map(|c| halves(constant(field.data, c))).collect();
    let half = |k: usize| all.chunks(2).map(move |two| [two[0][k], two[1][k]]).collect::<Vec<_>>();
    [half(0), half(1)].concat()
}

/// The block of a patch with the function 1.
fn smooth_block(field: &Field<'_>, patch: usize) -> Option<usize> {
    let is_one = |block: &usize| {
        field.functions.of(field.data.block_function[*block]) == ppum::function::Slot::One
    };
    field.data.blocks(patch).find(is_one)
}
