//! Rigid-body modes: the kernel of the operator, which restraints or a constraint of the null
//! space must remove.

use ppum::vec2::Vec2;

/// Most rigid-body modes a field can have.
pub(crate) const MODES: usize = 3;

/// One number per rigid-body mode.
pub(crate) type PerMode = [f64; MODES];

/// Two translations and the rotation about a centre, in units of a size; for one component the
/// constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RigidModes {
    /// Centre of the rotation.
    pub(crate) center: Vec2,
    /// Distance from the centre at which the rotation moves points by 1.
    pub(crate) size: f64,
    components: usize,
}

impl RigidModes {
    pub(crate) fn new(center: Vec2, size: f64, components: usize) -> Self {
        Self { center, size, components }
    }

    /// Number of modes.
    pub(crate) fn count(&self) -> usize {
        if self.components == 1 { 1 } else { MODES }
    }

    /// The modes at x; those beyond [`RigidModes::count`] are zero.
    pub(crate) fn at(&self, x: Vec2) -> [[f64; 2]; MODES] {
        let d = (x - self.center) / self.size;
        match self.components {
            1 => [[1.0, 0.0], [0.0; 2], [0.0; 2]],
            _ => [[1.0, 0.0], [0.0, 1.0], [-d.y, d.x]],
        }
    }

    /// A combination of the modes at x.
    pub(crate) fn combined(&self, mode: &PerMode, x: Vec2) -> [f64; 2] {
        let basic = self.at(x);
        [0, 1].map(|i| (0..MODES).map(|k| mode[k] * basic[k][i]).sum())
    }
}
