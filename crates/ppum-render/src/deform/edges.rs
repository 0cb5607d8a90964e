//! Edges and cuts of a mesh's elements in the deformed plane.

use ppum::crack::Side;
use ppum::progress::unwatched;
use ppum::segment::sides;
use ppum::vec2::{Rect, Vec2};
use rayon::prelude::*;

use super::DeformedView;
use super::chart::ElementChart;
use super::cutter::leaves_of_cuts;
use super::leaf::DeformedLeaf;
use super::map::{DeformationChart, DeformationMap};
use super::path::Paths;
use crate::pieces::{ConvexPiece, INSET};

/// Way beyond an edge at which the neighbour is looked for, in parts of the element: more than
/// what elements are thought to be larger by rounding.
const BEYOND: f64 = 1e-8;
/// Part of an edge that belongs to its ends, beyond which other elements may lie, or nothing.
const AT_ENDS: f64 = 1e-6;
/// Places on an edge, in parts of it, that tell where its element is.
const LOOKS: [f64; 3] = [0.0, 1.0 / 3.0, 2.0 / 3.0];
/// Elements that are this far apart have come apart \[pixels\].
const APART: f64 = 0.5;

impl DeformedView<'_> {
    /// The images of the edges of a mesh's elements, each of them once for every element that it
    /// belongs to; none of boxes.
    #[must_use]
    pub fn element_edges(&self) -> Paths {
        self.edges(|edge, t| edge.place(t))
    }

    /// The images of the edges of elements where the body ends or has come apart.
    pub(super) fn element_borders(&self) -> Paths {
        self.edges(|edge, t| {
            let place = edge.place(t)?;
            edge.is_border(t).then_some(place)
        })
    }

    /// A box around the images of some points of every element of a mesh, wherever the view is;
    /// none of boxes. It nearly holds the body.
    #[must_use]
    pub fn element_bounds(&self) -> Option<Rect> {
        let count = self.field().step.partition.mesh()?.len() as u32;
        let map = DeformationMap::new(self.field(), self.anchor);
        let of_patch = |patch: u32| {
            let mut chart = ElementChart::new(&map, patch)?;
            let corners = chart.corners();
            let points = sides(&corners).flat_map(|[a, b]| LOOKS.map(|t| a + (b - a) * t));
            let places = points.filter_map(|p| chart.place(self, p)).map(|p| self.view.center + p);
            places.map(|p| Rect::new(p, p)).reduce(|a, b| a.union(&b))
        };
        (0..count).filter_map(of_patch).reduce(|a, b| a.union(&b))
    }

    /// The faces of the cuts of a mesh's elements; none of boxes.
    #[must_use]
    pub fn cut_faces(&self) -> Paths {
        let Some(mesh) = self.field().step.partition.mesh() else { return Paths::new() };
        let leaves = leaves_of_cuts(self, mesh, unwatched()).unwrap_or_default();
        leaves.into_iter().flat_map(|leaf| leaf.faces).map(Vec::from).collect()
    }

    /// The images of edges as a place of each part of the way along them tells.
    fn edges(
        &self,
        place: impl Fn(&mut ElementEdge<'_, '_, '_>, f64) -> Option<Vec2> + Sync,
    ) -> Paths {
        let field = self.field();
        let count = field.step.partition.mesh().map_or(0, |mesh| mesh.len() as u32);
        let maps = || [(); 2].map(|()| DeformationMap::new(field, self.anchor));
        let of_patch = |maps: &mut [DeformationMap<'_>; 2], patch: u32| {
            let [own, other] = maps;
            let Some(mut chart) = ElementChart::new(own, patch) else { return Paths::new() };
            let corners = chart.corners();
            let leaf =
                DeformedLeaf::new(self, &mut chart, &ConvexPiece::uncut(&corners[..], INSET));
            if leaf.is_some_and(|leaf| !leaf.may_be_seen(self)) {
                return Paths::new();
            }
            let mut edge = ElementEdge { view: self, chart, other, ends: [Vec2::ZERO; 2] };
            let of_edge = |k: usize| {
                edge.ends = [corners[k], corners[(k + 1) % corners.len()]];
                let half = |a: f64, b: f64| 0.5 * (a + b);
                self.trace([0.0, 1.0], 1, half, &mut |t| place(&mut edge, t))
            };
            (0..corners.len()).flat_map(of_edge).collect()
        };
        (0..count).into_par_iter().map_init(maps, of_patch).flatten_iter().collect()
    }
}

/// An edge of an element.
struct ElementEdge<'a, 'm, 'f> {
    view: &'a DeformedView<'a>,
    chart: ElementChart<'m, 'f>,
    /// The body, for what lies beyond the edge.
    other: &'a mut DeformationMap<'f>,
    /// Counter-clockwise about the element.
    ends: [Vec2; 2],
}

impl ElementEdge<'_, '_, '_> {
    /// The point at a part of the way.
    fn at(&self, t: f64) -> Vec2 {
        let [a, b] = self.ends;
        a + (b - a) * t
    }

    /// Its image; nothing where a clip leaves nothing of the element.
    fn place(&mut self, t: f64) -> Option<Vec2> {
        let p = self.at(t);
        if self.chart.is_kept(p) { self.chart.place(self.view, p) } else { None }
    }

    /// True if there is nothing beyond the edge, or something that has moved elsewhere.
    fn is_border(&mut self, t: f64) -> bool {
        let [a, b] = self.ends;
        let beyond = self.at(0.5 + (t - 0.5) * (1.0 - AT_ENDS)) - (b - a).left() * BEYOND;
        let offset = self.chart.offset(beyond);
        let own = self.chart.place(self.view, beyond);
        let other = self.other.place(self.view, offset, Side::Above);
        let apart = own.zip(other).map(|(own, other)| (own - other).length());
        apart.is_none_or(|apart| apart > APART * self.view.view.pixel_size())
    }
}
