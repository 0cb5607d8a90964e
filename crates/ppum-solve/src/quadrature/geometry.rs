//! The geometry that decides where integrands are smooth.

use super::gauss::MAX_POINTS;
use ppum::crack::{Crack, SegmentId, Side};
use ppum::dataset::BoxPartition;
use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum::vec2::{Vec2, vec2};
use std::fmt;
use std::sync::Arc;

/// Smallest exponent the rule of [`SingularGrowth::Powers`] is graded for; points come no nearer to
/// the singular point than 1e-120 of a piece, so that squares of distances are still numbers.
const LEAST_EXPONENT: f64 = 0.04;

/// More points along a ray for the exponent λ: this over √λ.
const EXTRA_POINTS: f64 = 8.0;

/// A face of a crack: one side of one of its edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CrackFace {
    /// The edge.
    pub segment: SegmentId,
    /// The side that the material lies on.
    pub side: Side,
}

impl From<(SegmentId, Side)> for CrackFace {
    fn from((segment, side): (SegmentId, Side)) -> Self {
        Self { segment, side }
    }
}

impl CrackFace {
    /// The faces of a crack on one side, one per edge.
    pub(crate) fn of(crack: &Crack, index: usize, side: Side) -> impl Iterator<Item = Self> {
        let segment = move |segment| SegmentId { crack: index as u32, segment };
        (1..crack.points.len() as u32).map(move |k| Self { segment: segment(k - 1), side })
    }

    /// The edge.
    pub(super) fn edge(&self, cracks: &[Crack]) -> Edge {
        cracks[self.segment.crack as usize].edge(self.segment.segment as usize)
    }

    /// +1 if the material is on the right of the edge, −1 if it is on its left.
    pub(super) fn outside(&self) -> f64 {
        if self.side == Side::Above { -1.0 } else { 1.0 }
    }
}

/// The geometry that decides where integrands are smooth. Lists of a patch are indices into the
/// slices before them, in any order; an empty `patch_…` slice means that no patch has any.
#[derive(Clone, Copy)]
pub(crate) struct SmoothnessGeometry<'a> {
    /// The partition of unity.
    pub partition: &'a BoxPartition,
    /// The cracks: across their segments functions may jump.
    pub cracks: &'a [Crack],
    /// Parts of the cells that are not integrated over.
    pub holes: &'a [Hole],
    /// Points at which functions are singular: tips, corners.
    pub singular: &'a [Singularity],
    /// For each patch, the points at which one of its functions is singular, be the point inside
    /// the patch or not.
    pub patch_singular: &'a [Vec<u32>],
    /// Lines across which a function or one of its derivatives jumps.
    pub kinks: &'a [KinkLine],
    /// For each patch, the kinks of its functions.
    pub patch_kinks: &'a [Vec<u32>],
    /// The kinks that all integrands have: interfaces of materials.
    pub common_kinks: &'a [u32],
    /// Functions that may vary too fast for one Gauss rule a piece.
    pub probes: &'a dyn Probes,
    /// The probes among the functions of each patch.
    pub patch_probes: &'a [Vec<u32>],
    /// Those in all integrands: coefficients of the equation.
    pub common_probes: &'a [u32],
}

impl<'a> SmoothnessGeometry<'a> {
    /// A geometry in which functions jump across cracks and are smooth everywhere else.
    #[must_use]
    pub(crate) fn new(partition: &'a BoxPartition, cracks: &'a [Crack]) -> Self {
        Self {
            partition,
            cracks,
            holes: &[],
            singular: &[],
            patch_singular: &[],
            kinks: &[],
            patch_kinks: &[],
            common_kinks: &[],
            probes: &(),
            patch_probes: &[],
            common_probes: &[],
        }
    }

    /// The points at which a function of one of these patches is singular.
    pub(super) fn singular_points(&self, patches: &[u32]) -> Vec<Singularity> {
        let indices = union(self.patch_singular, &[], patches);
        indices.into_iter().map(|i| self.singular[i as usize]).collect()
    }

    /// The kinks of a function of one of these patches, and the common ones.
    pub(super) fn active_kinks(&self, patches: &[u32]) -> Vec<&'a KinkLine> {
        let indices = union(self.patch_kinks, self.common_kinks, patches);
        indices.into_iter().map(|i| &self.kinks[i as usize]).collect()
    }

    /// The probes of these patches, and the common ones.
    pub(super) fn active_probes(&self, patches: &[u32]) -> Vec<u32> {
        union(self.patch_probes, self.common_probes, patches)
    }

    /// True if a function of these patches has a kink.
    pub(super) fn has_kinks(&self, patches: &[u32]) -> bool {
        patches.iter().any(|&p| self.patch_kinks.get(p as usize).is_some_and(|k| !k.is_empty()))
    }
}

impl SmoothnessGeometry<'_> {
    /// True if no function of these patches is singular, has a kink or is probed.
    pub(super) fn is_smooth(&self, patches: &[u32]) -> bool {
        let lists = [self.patch_singular, self.patch_kinks, self.patch_probes];
        let has = |list: &&[Vec<u32>], p: u32| list.get(p as usize).is_some_and(|l| !l.is_empty());
        !patches.iter().any(|&p| lists.iter().any(|list| has(list, p)))
    }
}

/// The distinct entries of `common` and of the lists of some patches, ascending.
fn union(lists: &[Vec<u32>], common: &[u32], patches: &[u32]) -> Vec<u32> {
    let of_patches = patches.iter().filter_map(|&p| lists.get(p as usize)).flatten();
    let mut indices: Vec<u32> = of_patches.chain(common).copied().collect();
    indices.sort_unstable();
    indices.dedup();
    indices
}

/// A point at which functions are singular.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Singularity {
    /// The point.
    pub point: Vec2,
    /// The growth of functions there.
    pub growth: SingularGrowth,
    /// The coordinates whose roots functions are made of; none of smooth functions of the angle.
    pub branches: Option<[BranchCoordinate; 2]>,
}

/// The complex coordinate z = re·x + i im·x of a tip in an anisotropic body. It vanishes beside the
/// tip where one of x and y is complex, the nearer the more it stretches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BranchCoordinate {
    re: Vec2,
    im: Vec2,
}

impl BranchCoordinate {
    /// x + (a + ib) y in a frame with this x axis.
    #[must_use]
    pub(crate) fn new(axis: Vec2, [a, b]: [f64; 2]) -> Self {
        Self { re: axis + axis.left() * a, im: axis.left() * b }
    }

    /// z of an offset from the point.
    pub(super) fn at(&self, offset: Vec2) -> Vec2 {
        vec2(self.re.dot(offset), self.im.dot(offset))
    }

    /// u = re + i im, im > 0, for which z of foot + d sinh u vanishes: asinh of −z(foot)/z(d).
    pub(super) fn zero(&self, foot: Vec2, d: Vec2) -> [f64; 2] {
        let (foot, d) = (self.at(foot), self.at(d));
        // of the right half plane, where nothing cancels: asinh is odd
        let ratio = vec2(-foot.dot(d), foot.cross(d)) / d.dot(d);
        let (a, b) = (ratio.x.abs(), if ratio.x < 0.0 { -ratio.y } else { ratio.y });
        let (re, im) = (a * a - b * b + 1.0, 2.0 * a * b);
        let size = re.hypot(im);
        let (x, y) = ((0.5 * (size + re)).max(0.0).sqrt(), (0.5 * (size - re)).max(0.0).sqrt());
        let (x, y) = (a + x, b + y.copysign(im));
        [x.hypot(y).ln().copysign(ratio.x), y.atan2(x).abs()]
    }
}

/// Growth of functions with the distance r of a singular point, times smooth functions of the angle
/// and of the position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SingularGrowth {
    /// r^{k/2}, k ≥ 1, as at the tip of a crack.
    HalfPowers,
    /// r^λ and r^λ log r with any exponents λ, of which `least` > 0 is the smallest.
    ///
    /// Integrals of products of two functions or gradients are right to 1e-10 for λ ≥ 1/4, to 1e-8
    /// for λ ≥ 0.1, and lose digits below 0.04.
    Powers {
        /// The smallest exponent.
        least: f64,
    },
}

/// Nodes along a ray from a singular point: r = t^power, with `extra` more Gauss points in t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RayGrading {
    pub(super) power: f64,
    pub(super) extra: usize,
}

impl Singularity {
    /// The tip of a crack.
    #[must_use]
    pub(crate) const fn tip(point: Vec2) -> Self {
        Self { point, growth: SingularGrowth::HalfPowers, branches: None }
    }
}

impl SingularGrowth {
    /// The growth of products of functions of two kinds.
    pub(super) fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::HalfPowers, Self::HalfPowers) => Self::HalfPowers,
            _ => Self::Powers { least: self.least().min(other.least()) },
        }
    }

    fn least(self) -> f64 {
        match self {
            Self::HalfPowers => 0.5,
            Self::Powers { least } => least,
        }
    }

    /// The grading of a rule for areas with `n` points where functions are smooth.
    ///
    /// With r = t² half powers become polynomials. For r^{2λ−1}, N Gauss points err like
    /// N^{−4λm} with r = t^m, and need N² ≫ m to resolve the polynomials t^m; m = √(N/λ) balances
    /// the two.
    pub(super) fn over_areas(self, n: usize) -> RayGrading {
        match self {
            Self::HalfPowers => RayGrading { power: 2.0, extra: 0 },
            Self::Powers { least } => powers(least, n),
        }
    }

    /// The grading of a rule along a line through the point. Gradients are integrated there if they
    /// can be, r^{2λ−2} for λ > 1/2, and r^{λ−1} in any case.
    pub(super) fn along_lines(self, n: usize) -> RayGrading {
        match self {
            Self::HalfPowers => RayGrading { power: 2.0, extra: 0 },
            Self::Powers { least } if least > 0.5 => powers((least - 0.5).min(0.5 * least), n),
            Self::Powers { least } => powers(0.5 * least, n),
        }
    }
}

/// The grading for r^{2λ−1} and smaller exponents than that.
fn powers(lambda: f64, n: usize) -> RayGrading {
    let lambda = lambda.max(LEAST_EXPONENT);
    let extra = (EXTRA_POINTS / lambda.sqrt()).ceil() as usize;
    let all = (n + extra).min(MAX_POINTS);
    RayGrading { power: (all as f64 / lambda).sqrt().max(1.0), extra: all.saturating_sub(n) }
}

/// A level function: negative on one side of its zero set, positive on the other.
///
/// It should be smooth except for single points and for kinks that are declared before it, and its
/// size tell of the distance to the zero set, as a polynomial or a distance does. Cuts are made
/// where samples show that it changes its sign; values that are no numbers count as positive.
pub(crate) type LevelFunction = dyn Fn(Vec2) -> f64 + Send + Sync;

/// A line or curve across which a function or one of its derivatives jumps.
#[derive(Clone)]
pub(crate) enum KinkLine {
    /// The straight line through two points.
    Line([Vec2; 2]),
    /// A segment.
    Segment([Vec2; 2]),
    /// The zero set of a smooth function.
    Curve(Arc<LevelFunction>),
}

impl fmt::Debug for KinkLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(ends) => f.debug_tuple("Line").field(ends).finish(),
            Self::Segment(ends) => f.debug_tuple("Segment").field(ends).finish(),
            Self::Curve(_) => f.write_str("Curve"),
        }
    }
}

/// Functions that the quadrature may look at to see whether its pieces resolve them.
pub(crate) trait Probes: Sync {
    /// Appends \[f, ∂f/∂x, ∂f/∂y\] of one function at each of the points `anchor + offset`. Points
    /// on a `face` of a crack have its side, wherever rounding has put them.
    fn evaluate(
        &self,
        function: u32,
        points: (Vec2, &[Vec2]),
        face: Option<CrackFace>,
        out: &mut Vec<[f64; 3]>,
    );

    /// Returns the mean of |f| of a load over its support: only integrals of f count then, and
    /// errors that are small against the load as a whole are accepted. `None` for functions of a
    /// space and coefficients.
    fn load(&self, function: u32) -> Option<f64> {
        let _ = function;
        None
    }
}

/// No functions.
impl Probes for () {
    fn evaluate(
        &self,
        _: u32,
        (_, offsets): (Vec2, &[Vec2]),
        _: Option<CrackFace>,
        out: &mut Vec<[f64; 3]>,
    ) {
        out.extend(offsets.iter().map(|_| [0.0; 3]));
    }
}

/// Functions by their place in a list.
impl<F: Fn(Vec2, Vec2) -> [f64; 3] + Sync> Probes for Vec<F> {
    fn evaluate(
        &self,
        function: u32,
        (anchor, offsets): (Vec2, &[Vec2]),
        _: Option<CrackFace>,
        out: &mut Vec<[f64; 3]>,
    ) {
        let f = &self[function as usize];
        out.extend(offsets.iter().map(|&x| f(anchor, x)));
    }
}
