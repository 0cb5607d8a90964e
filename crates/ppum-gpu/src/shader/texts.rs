//! The texts of shaders, small files by concept, each a twin of a module of `ppum`. A shader is
//! made of them by putting them and generated declarations one behind the other.

/// Values with derivatives.
pub(crate) const JET: &str = include_str!("wgsl/jet.wgsl");
/// Polynomials of patches.
pub(crate) const POLYNOMIAL: &str = include_str!("wgsl/polynomial.wgsl");
/// Weight functions.
pub(crate) const WEIGHT: &str = include_str!("wgsl/weight.wgsl");
/// Sides of cracks.
pub(crate) const CRACK: &str = include_str!("wgsl/crack.wgsl");
/// Indicators of components.
pub(crate) const INDICATOR: &str = include_str!("wgsl/indicator.wgsl");
/// Points in the frames of functions.
pub(crate) const TIP: &str = include_str!("wgsl/tip.wgsl");
/// The Westergaard functions.
pub(crate) const WESTERGAARD: &str = include_str!("wgsl/westergaard.wgsl");
/// Holes.
pub(crate) const DOMAIN: &str = include_str!("wgsl/domain.wgsl");
/// Reading of what changes with the view.
pub(crate) const GEOMETRY: &str = include_str!("wgsl/geometry.wgsl");

/// All functions of a point, by name. Beside them they need `ppum::formula::wgsl_prelude`, the
/// [constants](crate::frame::geometry::constants) of the view's data, `load_view`, `load_lanes`,
/// `LANE_PAIRS`, `Lanes`, `ORDER`, `weight` and `view.cracks`.
pub(crate) const POINT_FUNCTIONS: [(&str, &str); 9] = [
    ("jet", JET),
    ("polynomial", POLYNOMIAL),
    ("weight", WEIGHT),
    ("crack", CRACK),
    ("indicator", INDICATOR),
    ("tip", TIP),
    ("westergaard", WESTERGAARD),
    ("domain", DOMAIN),
    ("geometry", GEOMETRY),
];

/// Reading data.
pub(crate) const LOAD: &str = include_str!("wgsl/load.wgsl");
/// Pixels and where they are.
pub(crate) const PIXEL: &str = include_str!("wgsl/pixel.wgsl");
/// Finding the patches of a pixel on a uniform cover.
pub(crate) const LATTICE: &str = include_str!("wgsl/lattice.wgsl");
/// Finding the patches of a pixel on any cover.
pub(crate) const BINS: &str = include_str!("wgsl/bins.wgsl");
/// Patches and what they hold.
pub(crate) const PATCH: &str = include_str!("wgsl/patch.wgsl");
/// Smooth terms of any degree.
pub(crate) const SMOOTH: &str = include_str!("wgsl/smooth.wgsl");
/// One pass.
pub(crate) const GATHER: &str = include_str!("wgsl/gather.wgsl");
/// Three passes.
pub(crate) const SPLAT: &str = include_str!("wgsl/splat.wgsl");
/// The value of a pixel.
pub(crate) const FINISH: &str = include_str!("wgsl/finish.wgsl");
/// The transfer function.
pub(crate) const COLOR: &str = include_str!("wgsl/color.wgsl");
