//! The patches in a region of the plane, as the card holds them: seen from an anchor, in bins.
//!
//! Positions go to the card as `high + low`, two numbers of single precision each, relative to the
//! anchor: `high` is a multiple of the region's quantum, so that differences of highs are exact.
//! The difference of a pixel and a centre, formed half by half, then has all the digits of single
//! precision, however small the patch is beside the region. Views that are too deep for a region,
//! or leave it, get a new one: the anchor moves into the view, in double precision, and only the
//! patches around it remain.
//!
//! ```text
//! of a lattice    for each bin the addresses of the patches at its four corners, by x + 2 y
//! else            pages, see pages.rs; four nodes of bins per texel, see bins.rs
//! ```

use ppum::field::Field;
use ppum::vec2::{Rect, Vec2};
use ppum_render::view::View;

use super::bins::{BinPatch, Bins};
use super::lattice::CoverLattice;
use super::pages::{HalfExtents, Pages};
use crate::layout::halves_by;

/// Width of a new region in widths of the view.
const AROUND: f64 = 16.0;

/// A view is too deep if its region is more than this wider.
const DEEPEST: f64 = 1024.0;

/// Part of a region's size by which positions in it may be wrong: single precision.
const MARGIN: f64 = 1e-6;

/// Patches in a region, ready for upload.
#[derive(Clone, Debug)]
pub(crate) struct UploadRegion {
    /// The part of the world that views may show.
    bounds: Rect,
    /// The point that positions are relative to.
    pub(crate) anchor: Vec2,
    /// The patches' indices in the dataset, ascending; none are listed of a lattice.
    pub(crate) patches: Vec<u32>,
    /// The bins that they are found by.
    pub(crate) bins: Bins,
}

impl UploadRegion {
    /// The region for a view: all of the domain, or the surroundings of the view.
    pub(crate) fn new(field: &Field<'_>, view: &View, lattice: Option<&CoverLattice>) -> Self {
        let domain = field.domain.bounds;
        let around = Rect::around(view.center, view.half() * AROUND);
        let deep = longer(view) * DEEPEST < domain.size().x.max(domain.size().y);
        let bounds = if deep { around } else { domain };
        let anchor = if deep { view.center } else { domain.center() };
        let relative = Rect::new(bounds.min - anchor, bounds.max - anchor);
        if let Some(lattice) = lattice {
            let bins = lattice.bins(relative, anchor);
            return Self { bounds, anchor, patches: Vec::new(), bins };
        }
        let mut patches = Vec::new();
        field.tree.query_box(&bounds, &mut patches);
        let partition = field.step.partition.boxes();
        let seen = |&index: &u32| {
            let support = partition.support(index as usize);
            let cell = partition.spacing(index as usize);
            BinPatch { support: Rect::new(support.min - anchor, support.max - anchor), cell }
        };
        let seen: Vec<_> = patches.iter().map(seen).collect();
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
        nothing || (inside && longer(view) * DEEPEST >= size.x.max(size.y))
    }

    /// The number that positions high are multiples of: 2⁻²² of the region's size, rounded to a
    /// power of two.
    pub(crate) fn quantum(&self) -> f64 {
        let size = self.bounds.size();
        let exponent = size.x.max(size.y).log2().ceil() as i32;
        2f64.powi(exponent - 22)
    }

    /// A position relative to the anchor, high and low.
    pub(crate) fn halves(&self, d: Vec2) -> [[f32; 2]; 2] {
        let ([xh, xl], [yh, yl]) = (halves_by(self.quantum(), d.x), halves_by(self.quantum(), d.y));
        [[xh, yh], [xl, yl]]
    }

    /// All that shaders read of a region. `bodies` holds the address of each patch of the dataset.
    pub(crate) fn words(
        &self,
        field: &Field<'_>,
        (lattice, levels): (Option<&CoverLattice>, Option<&HalfExtents>),
        bodies: &[u32],
    ) -> RegionWords {
        if let Some(lattice) = lattice {
            return RegionWords { words: lattice.nodes(&self.bins, self.anchor, bodies), nodes: 0 };
        }
        let (partition, anchor) = (field.step.partition.boxes(), self.anchor);
        let pages = Pages { partition, anchor, levels, own_frames: has_own_frames(field), bodies };
        let mut words = pages.words(&self.bins, &self.patches);
        let nodes = words.len() as u32 / 4;
        words.extend(&self.bins.nodes);
        RegionWords { words, nodes }
    }
}

/// The longer side of a view.
fn longer(view: &View) -> f64 {
    view.width.max(view.height())
}

/// A region in texels of four words.
#[derive(Clone, Debug)]
pub(crate) struct RegionWords {
    pub(crate) words: Vec<u32>,
    /// The first texel of the nodes.
    pub(crate) nodes: u32,
}

/// True if polynomials of some patch have other coordinates than its weight.
pub(crate) fn has_own_frames(field: &Field<'_>) -> bool {
    let partition = field.step.partition.boxes();
    partition.origin != partition.center || partition.scale != partition.half
}
