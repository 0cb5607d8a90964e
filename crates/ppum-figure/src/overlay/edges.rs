//! The edges of elements as lines.
//!
//! An edge is halved until its chords lie on it to a twentieth of a pixel, except for parts out
//! of sight.

use ppum::mesh::Mesh;
use ppum::vec2::{Rect, Vec2};
use ppum_render::view::View;

use crate::canvas::CanvasPath;

/// Distance of a chord from its arc, in pixels.
const SMOOTH: f64 = 0.05;

/// Parts of a curved edge, at least, and most halvings of it.
const PARTS: u32 = 2;
const HALVINGS: u32 = 48;

/// Half a view, and some more for lines at its border.
pub(super) fn reach(view: &View) -> Vec2 {
    view.half() * 1.25
}

pub(super) fn is_near(view: &View, rect: Rect) -> bool {
    let offsets = Rect::new(rect.min - view.center, rect.max - view.center);
    meet(&offsets, &Rect::around(Vec2::ZERO, reach(view)))
}

/// True if two closed boxes meet.
fn meet(a: &Rect, b: &Rect) -> bool {
    a.min.x <= b.max.x && a.max.x >= b.min.x && a.min.y <= b.max.y && a.max.y >= b.min.y
}

/// The outlines of some patches, as far as they are in sight.
pub(super) fn edges(view: &View, mesh: &Mesh, patches: impl Iterator<Item = usize>) -> CanvasPath {
    let mut path = CanvasPath::default();
    for patch in patches.filter(|&patch| is_near(view, mesh.bounds(patch))) {
        // sides of a cut have the same outline
        if patch > 0
            && mesh.map_range(patch) == mesh.map_range(patch - 1)
            && !mesh.clips(patch).is_empty()
        {
            continue;
        }
        let corners = mesh.shape[patch].corners();
        for (k, &a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % corners.len()];
            let edge = PatchEdge { view, mesh, patch, from: a, to: b };
            let ends = [(0.0, edge.at(0.0)), (1.0, edge.at(1.0))];
            edge.add(ends, 0, &mut path);
        }
    }
    path
}

/// An edge of a patch.
struct PatchEdge<'a> {
    view: &'a View,
    mesh: &'a Mesh,
    patch: usize,
    from: [f64; 2],
    to: [f64; 2],
}

impl PatchEdge<'_> {
    /// The pixel at a part of the way.
    fn at(&self, t: f64) -> Vec2 {
        let xi = [0, 1].map(|k| self.from[k] + t * (self.to[k] - self.from[k]));
        self.view.pixel_of_offset(self.mesh.image(self.patch, xi).0 - self.view.center)
    }

    fn add(&self, [a, b]: [(f64, Vec2); 2], depth: u32, path: &mut CanvasPath) {
        let t = 0.5 * (a.0 + b.0);
        let middle = (t, self.at(t));
        let sag = (middle.1 - (a.1 + b.1) * 0.5).length();
        let least = if self.mesh.map_degree[self.patch] == 1 { 0 } else { PARTS };
        if depth >= least && !self.is_seen(a.1, b.1, sag) {
            return;
        }
        if depth >= least && (sag <= SMOOTH || depth >= HALVINGS) {
            self.push(a.1, b.1, path);
            return;
        }
        self.add([a, middle], depth + 1, path);
        self.add([middle, b], depth + 1, path);
    }

    /// Adds a chord, to the end of the last one if it begins there.
    fn push(&self, a: Vec2, b: Vec2, path: &mut CanvasPath) {
        match path.pieces.last_mut() {
            Some(piece) if piece.last() == Some(&a) => piece.push(b),
            _ => path.pieces.push(vec![a, b]),
        }
    }

    /// True if the arc over a chord may come near the image.
    fn is_seen(&self, a: Vec2, b: Vec2, sag: f64) -> bool {
        let around = Vec2 { x: 2.0 * sag, y: 2.0 * sag };
        let [columns, rows] = self.view.pixels.map(f64::from);
        let margin = Vec2 { x: 0.1 * columns, y: 0.1 * rows };
        let picture = Rect::new(-margin, Vec2 { x: columns, y: rows } + margin);
        let arc = Rect::new(a.min(b) - around, a.max(b) + around);
        meet(&arc, &picture)
    }
}
