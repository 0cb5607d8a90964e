//! Rigid motions: the kernel of the operator, which supports or a gauge must remove.

use ppum::vec2::{Rect, Vec2};

/// Most rigid motions a field can have.
pub(crate) const MOTIONS: usize = 3;

/// One number a rigid motion.
pub(crate) type PerMotion = [f64; MOTIONS];

/// Two translations and the rotation about the domain's centre, in units of the domain's size; for
/// one component the constant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RigidMotions {
    center: Vec2,
    size: f64,
    components: usize,
}

impl RigidMotions {
    pub(crate) fn new(domain: &Rect, components: usize) -> Self {
        Self { center: domain.center(), size: domain.size().length(), components }
    }

    /// Components of the field.
    pub(crate) fn components(&self) -> usize {
        self.components
    }

    /// Number of motions.
    pub(crate) fn count(&self) -> usize {
        if self.components == 1 { 1 } else { MOTIONS }
    }

    /// The motions at x; those beyond [`RigidMotions::count`] are zero.
    pub(crate) fn at(&self, x: Vec2) -> [[f64; 2]; MOTIONS] {
        let d = (x - self.center) / self.size;
        match self.components {
            1 => [[1.0, 0.0], [0.0; 2], [0.0; 2]],
            _ => [[1.0, 0.0], [0.0, 1.0], [-d.y, d.x]],
        }
    }
}
