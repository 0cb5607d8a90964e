//! Bodies that hardly change their volume, and the order of polynomials that they need.

use ppum::dataset::Equation;
use ppum::domain::Domain;
use ppum::vec2::vec2;

/// λ/μ from which on a body counts as nearly incompressible: ν = 0.476 in plane strain. In plane
/// stress λ/μ stays below 2.
pub const STIFF: f64 = 20.0;

/// Order of polynomials without locking.
pub const FREE_OF_LOCKING: usize = 4;

/// Places along each axis at which the material is looked at.
const LOOKS: u32 = 64;

/// The largest λ/μ of the body; zero for a potential.
#[must_use]
pub fn stiffness_ratio(equation: &Equation, domain: &Domain) -> f64 {
    if equation.elastic().is_none() {
        return 0.0;
    }
    let (corner, size) = (domain.bounds.min, domain.bounds.size());
    let along = |k: u32| f64::from(k) / f64::from(LOOKS);
    let points = (0..=LOOKS)
        .flat_map(|j| (0..=LOOKS).map(move |i| (i, j)))
        .map(|(i, j)| corner + vec2(along(i) * size.x, along(j) * size.y));
    let ratio = |p| {
        let moduli = equation.moduli(p, [0.0, 0.0]);
        moduli.lambda / moduli.mu
    };
    let all = points.filter(|&p| domain.contains(p)).map(ratio);
    all.fold(0.0, f64::max)
}

/// The order of local polynomials where none is given: two, and four where the body is nearly
/// incompressible.
#[must_use]
pub(crate) fn default_order(equation: &Equation, domain: &Domain) -> usize {
    if stiffness_ratio(equation, domain) > STIFF { FREE_OF_LOCKING } else { 2 }
}
