//! Displacements and images of single points.

use ppum::crack::{Crack, Side};
use ppum::edge::Edge;
use ppum::field::{Field, LocalField};
use ppum::jet::Jet;
use ppum::vec2::{Vec2, vec2};

use super::DeformedView;

/// A place in the deformed plane with the deformation gradient there.
#[derive(Clone, Copy, Debug)]
pub(super) struct DeformedPoint {
    /// Offset from the view's centre.
    pub(super) at: Vec2,
    /// The columns of F: images of the unit vectors.
    pub(super) gradient: [Vec2; 2],
}

impl DeformedPoint {
    /// det F
    pub(super) fn determinant(&self) -> f64 {
        self.gradient[0].cross(self.gradient[1])
    }

    /// F d
    pub(super) fn carried(&self, d: Vec2) -> Vec2 {
        self.gradient[0] * d.x + self.gradient[1] * d.y
    }

    /// F⁻¹ d; not finite where F is singular.
    pub(super) fn pulled_back(&self, d: Vec2) -> Vec2 {
        let [a, b] = self.gradient;
        vec2(d.cross(b), a.cross(d)) / self.determinant()
    }
}

/// A point of the body that moves to a given place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Preimage {
    /// By the coordinates of its part of the body; offset from the anchor in the end.
    pub(super) offset: Vec2,
    pub(super) image: DeformedPoint,
}

/// A part of the body by its own coordinates, and the places that its points move to.
pub(super) trait DeformationChart {
    /// The image of a point, with its derivatives by the coordinates.
    fn image(&mut self, view: &DeformedView<'_>, p: Vec2) -> Option<DeformedPoint>;

    /// The image of a point without its gradient; nothing where the field is not finite.
    fn place(&mut self, view: &DeformedView<'_>, p: Vec2) -> Option<Vec2>;

    /// True if the body goes on from a point to another that lies just behind a side of its leaf.
    fn goes_on(&mut self, from: Vec2, to: Vec2) -> bool;

    /// A point by its offset from the anchor; nothing if it belongs to another part of the body.
    fn material(&mut self, found: Preimage) -> Option<Preimage>;
}

/// A displacement seen from an anchor, on the rims of the domain and just beyond them too.
pub(super) struct DeformationMap<'f> {
    local: LocalField<'f>,
    patches: Vec<u32>,
    jets: Vec<Jet<f64>>,
}

impl<'f> DeformationMap<'f> {
    pub(super) fn new(field: &'f Field<'f>, anchor: Vec2) -> Self {
        let local = field.at(anchor);
        let jets = vec![Jet::constant(0.0); local.field.components()];
        Self { local, patches: Vec::new(), jets }
    }

    /// u at the anchor plus an offset; nothing where no patch lies.
    pub(super) fn displacement(&mut self, offset: Vec2, side: Side) -> Option<[f64; 2]> {
        self.evaluate::<0>(offset, side).then(|| [self.jets[0].v, self.jets[1].v])
    }

    /// The image of a point without its gradient; nothing where the field is not finite.
    pub(super) fn place(
        &mut self,
        view: &DeformedView<'_>,
        offset: Vec2,
        side: Side,
    ) -> Option<Vec2> {
        let place = moved(view, offset, self.displacement(offset, side)?);
        place.is_finite().then_some(place)
    }

    /// The field as it is evaluated.
    pub(super) fn local(&self) -> &LocalField<'f> {
        &self.local
    }

    /// True if the body has a point.
    pub(super) fn contains(&self, offset: Vec2) -> bool {
        self.local.contains(offset)
    }

    /// As [`LocalField::evaluate`], also where rounding has put a point of a rim outside the
    /// domain.
    fn evaluate<const D: usize>(&mut self, offset: Vec2, side: Side) -> bool {
        let Self { local, patches, jets } = self;
        patches.clear();
        local.field.tree.query_point(local.anchor + offset, patches);
        local.over_patches::<f64, D>([offset.x, offset.y], side, patches, jets);
        !patches.is_empty()
    }
}

impl DeformationChart for DeformationMap<'_> {
    fn image(&mut self, view: &DeformedView<'_>, p: Vec2) -> Option<DeformedPoint> {
        if !self.evaluate::<1>(p, Side::Above) {
            return None;
        }
        let jets = [self.jets[0], self.jets[1]];
        let at = moved(view, p, jets.map(|jet| jet.v));
        Some(DeformedPoint { at, gradient: gradient(view, jets) })
    }

    fn place(&mut self, view: &DeformedView<'_>, p: Vec2) -> Option<Vec2> {
        Self::place(self, view, p, Side::Above)
    }

    fn goes_on(&mut self, _: Vec2, to: Vec2) -> bool {
        self.contains(to)
    }

    fn material(&mut self, found: Preimage) -> Option<Preimage> {
        Some(found)
    }
}

/// The columns of F = I + s ∇u.
pub(super) fn gradient(view: &DeformedView<'_>, [u, v]: [Jet<f64>; 2]) -> [Vec2; 2] {
    let s = view.factor();
    [vec2(1.0 + s * u.x, s * v.x), vec2(s * u.y, 1.0 + s * v.y)]
}

/// shift + O + s (u − u(A))
pub(super) fn moved(view: &DeformedView<'_>, offset: Vec2, [x, y]: [f64; 2]) -> Vec2 {
    let [x0, y0] = view.reference;
    view.shift + offset + vec2(x - x0, y - y0) * view.factor()
}

/// Parts of an arc between whose ends cracks are straight.
const PARTS: u32 = 16;

/// The vertices of a crack, and some points between them on arcs.
pub(super) fn followed(crack: &Crack) -> impl Iterator<Item = Vec2> + '_ {
    let behind = |edge: Edge| {
        let parts = if edge.is_arc() { PARTS } else { 1 };
        (1..=parts).map(move |k| edge.at(f64::from(k) / f64::from(parts)))
    };
    std::iter::once(crack.points[0]).chain(crack.edges().flat_map(behind))
}
