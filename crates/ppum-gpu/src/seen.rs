//! What a view changes: numbers for the shaders, formed in double precision, once a frame.

use ppum::dataset::FieldData;
use ppum::field::Field;
use ppum::vec2::Vec2;
use ppum_render::view::View;

use crate::bodies::Components;
use crate::geometry::Geometry;
use crate::layout::{halves, record};
use crate::region::Region;

record! {
    /// The uniform `view` of the shaders.
    ViewRecord {
        /// The view's centre in the world.
        center: vec2f,
        /// Lower left corner of the bins relative to the region's anchor, high and low.
        grid_high: vec2f,
        grid_low: vec2f,
        /// One over the size of a bin.
        per_pitch: vec2f,
        /// Columns and rows of the picture.
        pixels: vec2u,
        /// Columns and rows of the grid of bins.
        grid_size: vec2u,
        /// First pixel inside the domain's box, and the one after the last.
        inside_first: vec2u,
        inside_end: vec2u,
        /// Side of a pixel.
        pixel_size: f32,
        /// Addresses in the view's data: columns, rows, reference, cracks, holes.
        columns: u32,
        rows: u32,
        reference: u32,
        cracks: u32,
        holes: u32,
        n_holes: u32,
        /// Addresses in the region: list of the bins, records of the patches.
        list: u32,
        patches: u32,
        /// The patch whose φ is wanted, by its number in the region.
        chosen: u32,
        /// The component that is wanted.
        component: u32,
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
pub(crate) struct Seen {
    pub(crate) record: ViewRecord,
    /// Geometry, columns, rows, reference.
    pub(crate) pairs: Vec<[f32; 2]>,
}

impl Seen {
    /// A view of a field, whose patches are those of a region.
    pub(crate) fn new(
        field: &Field<'_>,
        view: &View,
        geometry: Geometry,
        (region, places): (&Region, [u32; 2]),
    ) -> Self {
        let Geometry { mut pairs, cracks, holes, n_holes } = geometry;
        let from_anchor = view.center - region.anchor;
        let [columns, rows] = view.pixels;
        let mut table = |count: u32, at: &dyn Fn(u32) -> f64| {
            let start = pairs.len() as u32;
            pairs.extend((0..count).map(|k| halves(at(k))));
            start
        };
        let columns = table(columns, &|i| from_anchor.x + view.column_offset(i));
        let rows = table(rows, &|j| from_anchor.y + view.row_offset(j));
        let reference = pairs.len() as u32;
        pairs.extend(reference_of(field, view.center));
        let [xs, ys] = view.inside(&field.domain.bounds);
        let bins = &region.bins;
        let ([xh, xl], [yh, yl]) = (halves(bins.origin.x), halves(bins.origin.y));
        let record = ViewRecord {
            center: [view.center.x as f32, view.center.y as f32],
            grid_high: [xh, yh],
            grid_low: [xl, yl],
            per_pitch: [(1.0 / bins.pitch.x) as f32, (1.0 / bins.pitch.y) as f32],
            pixels: view.pixels,
            grid_size: bins.size,
            inside_first: [xs.start as u32, ys.start as u32],
            inside_end: [xs.end as u32, ys.end as u32],
            pixel_size: view.pixel_size() as f32,
            columns,
            rows,
            reference,
            cracks,
            holes,
            n_holes,
            list: places[0],
            patches: places[1],
            chosen: u32::MAX,
            ..ViewRecord::default()
        };
        Self { record, pairs }
    }
}

/// The constants that splatted patches subtract from theirs, high and low, lane by lane: those of a patch
/// near the view's centre.
fn reference_of(field: &Field<'_>, center: Vec2) -> Vec<[f32; 2]> {
    let components = Components::new(field.components());
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
