//! The texts of shaders, small files by concept, each a twin of a module of `ppum`. A shader is made of them
//! by putting them and generated declarations one behind the other.

/// Values with derivatives.
pub(crate) const JET: &str = include_str!("shaders/jet.wgsl");
/// Polynomials of patches.
pub(crate) const POLYNOMIAL: &str = include_str!("shaders/polynomial.wgsl");
/// Weight functions.
pub(crate) const WEIGHT: &str = include_str!("shaders/weight.wgsl");
/// Sides of cracks.
pub(crate) const CRACK: &str = include_str!("shaders/crack.wgsl");
/// Points in the frames of functions.
pub(crate) const TIP: &str = include_str!("shaders/tip.wgsl");
/// The Westergaard functions.
pub(crate) const WESTERGAARD: &str = include_str!("shaders/westergaard.wgsl");
/// Holes.
pub(crate) const DOMAIN: &str = include_str!("shaders/domain.wgsl");
/// Reading of what changes with the view.
pub(crate) const GEOMETRY: &str = include_str!("shaders/geometry.wgsl");

/// All functions of a point, by name. Beside them they need `ppum::formula::wgsl_prelude`, the
/// [constants](crate::geometry::constants) of the view's data, `load_view`, `load_lanes`, `LANE_PAIRS`,
/// `Lanes`, `ORDER`, `weight` and `view.cracks`.
pub(crate) const POINT_FUNCTIONS: [(&str, &str); 8] = [
    ("jet", JET),
    ("polynomial", POLYNOMIAL),
    ("weight", WEIGHT),
    ("crack", CRACK),
    ("tip", TIP),
    ("westergaard", WESTERGAARD),
    ("domain", DOMAIN),
    ("geometry", GEOMETRY),
];
