//! Cracks that meet, along no axis, in the default domain.

use ppum::crack::{Crack, CrackEnd};
use ppum::vec2::{Vec2, vec2};

use super::recipe::{Junction, Recipe, crack};
use CrackEnd::{Junction as Joined, Mouth, Tip};

/// Zone of the tips: no arm is shorter than twice that, so tips keep to their own crack, and no
/// patch of level 2 that holds a tip has its centre farther from it.
const ZONE: f64 = 0.1;

impl Recipe {
    /// Cracks that cross, branch and end on each other, with patches of several sizes around where
    /// they do.
    #[must_use]
    pub fn meeting() -> Self {
        let (cracks, junctions) = cracks();
        Self { cracks, junctions, zone: ZONE, ..Self::default() }
    }
}

/// The cracks, and where they meet: in a star of five arms, at the kink of a crack and on a
/// straight part of it, and where two cross.
fn cracks() -> (Vec<Crack>, Vec<Junction>) {
    let (star, kink) = ([0.5617, 0.3923], [0.6943, -0.1237]);
    let arms = [[0.3511, 0.5143], [0.6291, 0.6437], [0.8163, 0.4291], [0.6127, 0.1731]];
    let mut cracks: Vec<_> = arms.iter().map(|&end| crack(&[star, end], [Joined, Tip])).collect();
    cracks.push(crack(&[star, [0.4523, 0.3317], [0.3367, 0.2219]], [Joined, Tip]));
    let mouth = [0.2, -0.0213];
    cracks.push(crack(&[mouth, kink, [1.1379, -0.0491]], [Mouth, Tip]));
    cracks.push(crack(&[[0.8257, -0.2771], kink], [Tip, Joined]));
    let foot = Vec2::from(mouth) + (Vec2::from(kink) - mouth.into()) * 0.47;
    cracks.push(crack(&[foot.into(), [0.4777, -0.2813]], [Joined, Tip]));
    let (a, b) = ([[1.0237, 0.1931], [1.4411, 0.4517]], [[1.3671, 0.1423], [1.1549, 0.5981]]);
    cracks.extend([a, b].map(|ends| crack(&ends, [Tip; 2])));
    let places = [(star.into(), 0.13), (kink.into(), 0.1), (foot, 0.1), (crossing(a, b), 0.12)];
    (cracks, places.map(|(center, radius)| Junction { center, radius }).into())
}

/// The point that two segments have in common.
fn crossing(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> Vec2 {
    let ([a, a_end], [b, b_end]) = (a.map(|[x, y]| vec2(x, y)), b.map(|[x, y]| vec2(x, y)));
    let along = b_end - b;
    a + (a_end - a) * ((b - a).cross(along) / (a_end - a).cross(along))
}
