//! Quantities of the faces of cracks: tractions, jumps, and whether the faces are closed.
//!
//! With the unit tangent t of the crack and its normal m to the left, from the face below to the
//! one above, and \[u\] = u above − u below,
//!
//! ```text
//! σ_n = m·σ m     τ = t·σ m     opening = [u]·m     sliding = [u]·t
//! ```
//!
//! The normal is the same on both faces: σ_n and τ are continuous where faces press on each other.

use crate::crack::{Crack, CrackEnd, End, Side};
use crate::field::{Field, LocalField};
use crate::jet::Jet;
use crate::vec2::{Vec2, vec2};

/// The length h of the law of contact in parts of the patch's: any h serves in an exact field,
/// where the opening or the pressure vanishes; a small one keeps faces under a load open near tips.
const TOUCHING: f64 = 0.1;

/// Distance from a face of the points that stand for it where the material changes across the
/// crack, in parts of the patch's size.
const NEAR: f64 = 1e-9;

/// Relative difference of stresses of one gradient, of which one material has none.
const SAME: f64 = 1e-6;

/// A quantity of the faces of the cracks of an elastic body, with the quantities `Q` of stress.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceQuantity<Q> {
    kind: FaceKind,
    /// σ_xx, σ_yy and σ_xy of the body's law.
    stress: [Q; 3],
}

/// The value of a quantity of stress of jets at a point.
pub(super) type StressValue<Q> = fn(&Q, &LocalField<'_>, Vec2, &[Jet<f64>]) -> f64;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum FaceKind {
    NormalTraction,
    ShearTraction,
    Opening,
    Sliding,
    Closed,
}

/// Names and symbols.
const FACES: [(&str, &str, FaceKind); 5] = [
    ("normal-traction", "σ_{n}", FaceKind::NormalTraction),
    ("shear-traction", "τ", FaceKind::ShearTraction),
    ("opening", "opening", FaceKind::Opening),
    ("sliding", "sliding", FaceKind::Sliding),
    ("closed", "closed", FaceKind::Closed),
];

/// Names of the quantities that the faces of a field's cracks have; none without cracks, and of
/// fields that are no displacements.
pub fn face_names(field: &Field<'_>) -> impl Iterator<Item = &'static str> {
    let has_faces = field.is_displacement() && !field.step.cracks.is_empty();
    FACES.iter().map(|(name, ..)| *name).filter(move |_| has_faces)
}

impl<Q> FaceQuantity<Q> {
    /// The quantity of a name, with those of stress by theirs.
    pub(super) fn parse(
        text: &str,
        field: &Field<'_>,
        stress: impl Fn(&str) -> Option<Q>,
    ) -> Option<Self> {
        let name = text.replace('_', "-");
        face_names(field).find(|known| *known == name)?;
        let kind = FACES.iter().find(|(known, ..)| *known == name)?.2;
        Some(Self { kind, stress: [stress("sxx")?, stress("syy")?, stress("sxy")?] })
    }

    fn row(&self) -> &'static (&'static str, &'static str, FaceKind) {
        FACES.iter().find(|(.., kind)| *kind == self.kind).expect("a row for each kind")
    }

    pub(super) fn name(&self) -> &'static str {
        self.row().0
    }

    pub(super) fn symbol(&self) -> &'static str {
        self.row().1
    }

    /// True of a displacement, which has the unit of the field.
    #[must_use]
    pub fn is_jump(&self) -> bool {
        matches!(self.kind, FaceKind::Opening | FaceKind::Sliding)
    }

    /// True if each of the two faces has a value of its own.
    #[must_use]
    pub fn is_sided(&self) -> bool {
        matches!(self.kind, FaceKind::NormalTraction | FaceKind::ShearTraction)
    }

    /// The value at a point of a face with the jets on it; NaN away from cracks, at tips and
    /// junctions, and of jumps where only one face is in the body. Where the material changes
    /// across the crack both the law and the derivatives are those next to the face.
    pub(super) fn of_jets(
        &self,
        local: &mut LocalField<'_>,
        (offset, side): (Vec2, Side),
        jets: &[Jet<f64>],
        stress: StressValue<Q>,
    ) -> f64 {
        let Some(on) = local.segment else { return f64::NAN };
        let cracks = &local.field.step.cracks;
        if is_junction(cracks, local.anchor + offset) {
            return f64::NAN;
        }
        let edge = cracks[on.crack as usize].edge(on.segment as usize);
        let tangent = edge.tangent_towards(local.anchor + offset);
        let normal = tangent.left();
        let near = self.near_faces(local, (offset, normal), jets, stress);
        let traction = |local: &mut LocalField<'_>, side: Side, jets: &[Jet<f64>]| {
            let place = near.map_or(offset, |near| near[usize::from(side == Side::Below)]);
            let own = near.map(|_| on_face::<1>(local, place, side));
            let jets = own.as_deref().unwrap_or(jets);
            let [xx, yy, xy] = self.stress.each_ref().map(|q| stress(q, local, place, jets));
            let [x, y] = [xx * normal.x + xy * normal.y, xy * normal.x + yy * normal.y];
            if x.is_finite() && y.is_finite() { vec2(x, y) } else { vec2(f64::NAN, f64::NAN) }
        };
        match self.kind {
            FaceKind::NormalTraction => traction(local, side, jets).dot(normal),
            FaceKind::ShearTraction => traction(local, side, jets).dot(tangent),
            FaceKind::Opening => jump(local, offset).dot(normal),
            FaceKind::Sliding => jump(local, offset).dot(tangent),
            FaceKind::Closed => {
                let on = [Side::Above, Side::Below].map(|side| {
                    let jets = on_face::<1>(local, offset, side);
                    traction(local, side, &jets).dot(normal)
                });
                let opening = jump(local, offset).dot(normal);
                closed(local, offset, 0.5 * (on[0] + on[1]), opening)
            }
        }
    }
}

impl<Q> FaceQuantity<Q> {
    /// Points next to the faces above and below, where the law, its axes or its given strains
    /// change across the crack: where one gradient has other stresses above than below.
    fn near_faces(
        &self,
        local: &LocalField<'_>,
        (offset, normal): (Vec2, Vec2),
        jets: &[Jet<f64>],
        stress: StressValue<Q>,
    ) -> Option<[Vec2; 2]> {
        if local.field.equation.is_uniform() {
            return None;
        }
        let patch = local.owner(offset, Side::Above)?;
        let step = normal * (NEAR * local.field.step.partition.half(patch).max_norm());
        let places = [offset + step, offset - step];
        let [above, below] =
            places.map(|place| self.stress.each_ref().map(|q| stress(q, local, place, jets)));
        let size = above.iter().chain(&below).fold(0.0, |size: f64, s| size.max(s.abs()));
        let differs = |(a, b): (&f64, &f64)| (a - b).abs() > SAME * size;
        above.iter().zip(&below).any(differs).then_some(places)
    }
}

/// True at the end of a crack on another one, where faces of both meet.
fn is_junction(cracks: &[Crack], point: Vec2) -> bool {
    let ends = cracks.iter().flat_map(|crack| {
        let points = [End::Start, End::Last].map(|end| crack.end_point(end));
        points.into_iter().zip(crack.ends)
    });
    let mut junctions = ends.filter(|(_, kind)| *kind == CrackEnd::Junction);
    junctions.any(|(end, _)| {
        let size = end.max_norm().max(point.max_norm());
        (end - point).max_norm() <= 8.0 * f64::EPSILON * size
    })
}

/// 1 where the faces overlap, or touch under pressure: σ_n + E \[u\]·m / h < 0 with the mean σ_n
/// of both faces and a small h, as the law of contact has it; else 0.
fn closed(local: &LocalField<'_>, offset: Vec2, stress: f64, opening: f64) -> f64 {
    let (field, point) = (local.field, local.anchor + offset);
    let patch = local.owner(offset, Side::Above);
    let size = patch.map(|patch| field.step.partition.half(patch).max_norm());
    let young = field.equation.elastic().map(|body| body.young.value(point));
    let (Some(size), Some(young)) = (size, young) else { return f64::NAN };
    let excess = stress + young / (TOUCHING * size) * opening;
    if excess.is_nan() { f64::NAN } else { f64::from(excess < 0.0) }
}

/// The field on a face; NaN outside the body.
fn on_face<const D: usize>(local: &mut LocalField<'_>, offset: Vec2, side: Side) -> Vec<Jet<f64>> {
    let mut u = vec![Jet::constant(f64::NAN); local.field.components()];
    local.evaluate::<D>(offset, side, &mut u);
    u
}

/// u above − u below
fn jump(local: &mut LocalField<'_>, offset: Vec2) -> Vec2 {
    let mut on = |side| {
        let u = on_face::<0>(local, offset, side);
        vec2(u[0].v, u[1].v)
    };
    on(Side::Above) - on(Side::Below)
}
