//! The patches in a region of the plane, as the card holds them: seen from an anchor, in bins.
//!
//! Centres go to the card as `high + low`, two numbers of single precision each, relative to the
//! anchor, and so do the columns and rows of a view. The difference of a pixel and a centre, formed half
//! by half, then has all the digits of single precision, however small the patch is beside the region.
//! Views that are too deep for a region, or leave it, get a new one: the anchor moves into the view, in
//! double precision, and only the patches around it remain.

use ppum::field::Field;
use ppum::vec2::{Rect, Vec2};
use ppum_render::view::View;

use crate::bins::{Bins, Covered};
use crate::layout::halves;

/// How much wider than the view a new region is.
const AROUND: f64 = 16.0;

/// A view is too deep if its region is more than this wider.
const DEEPEST: f64 = 1024.0;

/// Part of a region's size by which positions in it may be wrong: single precision.
const MARGIN: f64 = 1e-6;

/// Patches in a region, ready for upload.
#[derive(Clone, Debug)]
pub(crate) struct Region {
    /// Where views may be, in the world.
    bounds: Rect,
    /// What positions are relative to.
    pub(crate) anchor: Vec2,
    /// The patches' indices in the dataset, ascending.
    pub(crate) patches: Vec<u32>,
    /// Where they are found.
    pub(crate) bins: Bins,
}

impl Region {
    /// The region for a view: all of the domain, or the surroundings of the view.
    pub(crate) fn new(field: &Field<'_>, view: &View) -> Self {
        let domain = field.domain.bounds;
        let around = Rect::around(view.center, view.half() * AROUND);
        let deep = view.width * DEEPEST < domain.size().x.max(domain.size().y);
        let bounds = if deep { around } else { domain };
        let anchor = if deep { view.center } else { domain.center() };
        let mut patches = Vec::new();
        field.tree.query_box(&bounds, &mut patches);
        let partition = &field.step.partition;
        let seen = |&index: &u32| {
            let support = partition.support(index as usize);
            let cell = partition.cell[index as usize].size();
            Covered { support: Rect::new(support.min - anchor, support.max - anchor), cell }
        };
        let seen: Vec<_> = patches.iter().map(seen).collect();
        let relative = Rect::new(bounds.min - anchor, bounds.max - anchor);
        let size = relative.size();
        let bins = Bins::new(relative, &seen, MARGIN * size.x.max(size.y));
        Self { bounds, anchor, patches, bins }
    }

    /// True if the region can show a view of the field.
    pub(crate) fn shows(&self, field: &Field<'_>, view: &View) -> bool {
        let (bounds, domain) = (self.bounds, field.domain.bounds);
        let size = bounds.size();
        // Outside the domain there is nothing to show.
        let seen = view.rect().intersection(&domain);
        let inside = bounds.contains(seen.min) && bounds.contains(seen.max);
        let nothing = !view.rect().overlaps(&domain);
        nothing || (inside && view.width * DEEPEST >= size.x.max(size.y))
    }

    /// The patch of the dataset with this index, as the region counts.
    pub(crate) fn local(&self, patch: u32) -> Option<u32> {
        self.patches.binary_search(&patch).ok().map(|index| index as u32)
    }

    /// Nodes, list and records of the patches, in pairs of words. `bodies` holds the address and number of terms of
    /// each patch of the dataset.
    pub(crate) fn pairs(&self, field: &Field<'_>, bodies: &[[u32; 2]]) -> Places {
        let mut pairs = self.bins.nodes.clone();
        let list = pairs.len() as u32;
        let entries = self.bins.list.chunks(2);
        pairs.extend(entries.map(|two| [two[0], two.get(1).copied().unwrap_or_default()]));
        let patches = pairs.len() as u32;
        let own_frames = has_own_frames(field);
        pairs.reserve(self.patches.len() * record_pairs(own_frames));
        for &index in &self.patches {
            self.push_patch(field, index as usize, own_frames, bodies[index as usize], &mut pairs);
        }
        Places { pairs, list, patches }
    }

    /// The record of a patch: its support; its body; the frame of its polynomials, if that is another one.
    fn push_patch(
        &self,
        field: &Field<'_>,
        index: usize,
        own_frame: bool,
        body: [u32; 2],
        pairs: &mut Vec<[u32; 2]>,
    ) {
        let partition = &field.step.partition;
        self.push_frame(partition.center[index], partition.half[index], pairs);
        pairs.push(body);
        if own_frame {
            self.push_frame(partition.origin[index], partition.scale[index], pairs);
        }
    }

    /// Origin, high and low, and reciprocal scale.
    fn push_frame(&self, origin: Vec2, scale: Vec2, pairs: &mut Vec<[u32; 2]>) {
        let d = origin - self.anchor;
        let ([xh, xl], [yh, yl]) = (halves(d.x), halves(d.y));
        let inverse = [(1.0 / scale.x) as f32, (1.0 / scale.y) as f32];
        pairs.extend([[xh, yh], [xl, yl], inverse].map(|pair| pair.map(f32::to_bits)));
    }
}

/// A region in pairs of words, and where its parts begin.
#[derive(Clone, Debug)]
pub(crate) struct Places {
    pub(crate) pairs: Vec<[u32; 2]>,
    /// The list of the bins: two entries a pair.
    pub(crate) list: u32,
    /// The records of the patches.
    pub(crate) patches: u32,
}

/// True if polynomials of some patch have other coordinates than its weight.
pub(crate) fn has_own_frames(field: &Field<'_>) -> bool {
    let partition = &field.step.partition;
    partition.origin != partition.center || partition.scale != partition.half
}

/// Pairs of a patch's record.
pub(crate) fn record_pairs(own_frames: bool) -> usize {
    if own_frames { 7 } else { 4 }
}
