//! Frames of functions, cracks and holes, seen from the view's centre.
//!
//! All differences are formed in double precision without cancellation and rounded at last; so a
//! view 10⁻¹² of the domain wide has no noise in single precision either. The shaders read it
//! in `shader/wgsl/{geometry,crack,indicator,domain}.wgsl`.

use ppum::crack::{Crack, EdgeGroup, End, LocalCrack, LocalTip, LocalVertex, SegmentId, TipId};
use ppum::dataset::Step;
use ppum::domain::{Domain, Hole, LocalRim, LocalSide, PolygonSide};
use ppum::function::{Cut, CutBranch, FunctionKind};
use ppum::vec2::{Vec2, vec2};

use crate::error::GpuError;
use crate::scene::groups::GroupFrame;

/// Pairs of the frame of a group.
const FRAME: usize = 4;
/// Pairs of an edge: tangent; distance and curvature; ends, of an arc 1 if it is more than half a
/// turn.
const SEGMENT: usize = 3;
/// Pairs of a vertex of a crack with arcs: its place, the tangents before and behind it.
const VERTEX: usize = 3;
/// Pairs of a group of edges of a crack with arcs: its centre; its radius and the edge behind it.
const GROUP: usize = 2;
/// Pairs of a cut of an indicator: first pair of its segment; what follows on the left, on
/// the right.
const CUT: usize = 2;
/// Pairs of a circle: 0, excess / 2r; d / r; 1 / 2r.
const CIRCLE: usize = 3;
/// Pairs of a polygon's side: its ends, unit direction, distance and half of the curvature; of an
/// arc gradient and value of its circle.
const SIDE: usize = 6;

/// Most pairs of a view: whole numbers are exact in single precision up to here, and shaders see no
/// more at once than 128 MiB.
const MOST_PAIRS: usize = 1 << 24;

/// Stands for an infinite coordinate: shaders may assume that there is none.
const FAR: f64 = 3e38;

/// The pairs of a view, rounded to single precision. Whole numbers stand in it as floats. (As bit
/// patterns they would be subnormal numbers, which devices may take for zero.)
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PairGeometry {
    /// Frames of the groups, `FRAME` pairs each; first segment and number of segments of every
    /// crack; the segments; the cuts of indicators; the holes.
    pub(crate) pairs: Vec<[f32; 2]>,
    /// First pair of the cracks.
    pub(crate) cracks: u32,
    /// First pair of the holes.
    pub(crate) holes: u32,
    /// Number of holes.
    pub(crate) n_holes: u32,
}

impl PairGeometry {
    /// Cracks of a step, holes of a domain and the frames of groups of functions seen from
    /// `center`. Linear in their number and that of the cuts of indicators.
    pub(crate) fn new(step: &Step, domain: &Domain, frames: &[GroupFrame], center: Vec2) -> Self {
        let cracks = FRAME * frames.len();
        let mut directory = Directory::new(step, cracks, center);
        let mut pairs: Vec<Vec2> = frames.iter().flat_map(|frame| directory.frame(frame)).collect();
        pairs.extend(&directory.entries);
        pairs.extend(directory.cracks.iter().flat_map(segments));
        pairs.append(&mut directory.cuts);
        let holes = pairs.len();
        pairs.extend(domain.holes.iter().flat_map(|hole| rim(hole, center)));
        Self {
            pairs: pairs.into_iter().map(rounded).collect(),
            cracks: cracks as u32,
            holes: holes as u32,
            n_holes: domain.holes.len() as u32,
        }
    }
}

/// Refuses a view of more pairs than shaders can number.
pub(crate) fn check_size(pairs: usize) -> Result<(), GpuError> {
    let bytes = |pairs: usize| 8 * pairs as u64;
    if pairs <= MOST_PAIRS {
        return Ok(());
    }
    let what = "cracks, holes and functions of components".to_owned();
    Err(GpuError::TooLarge { what, needed: bytes(pairs), most: bytes(MOST_PAIRS) })
}

/// The declarations of the lengths for shaders, and of the number of what is in a component.
pub(crate) fn constants() -> String {
    let lengths = [
        ("GEOMETRY_PAIRS", FRAME),
        ("SEGMENT_PAIRS", SEGMENT),
        ("VERTEX_PAIRS", VERTEX),
        ("EDGE_GROUP_PAIRS", GROUP),
        ("CUT_PAIRS", CUT),
        ("HOLE_CIRCLE_PAIRS", CIRCLE),
        ("HOLE_SIDE_PAIRS", SIDE),
    ];
    let lengths = lengths.iter().map(|(name, length)| format!("const {name} = {length}u;\n"));
    let inside = format!("const INDICATOR_INSIDE = {}.0;\n", CutBranch::Inside.number());
    lengths.chain([inside, format!("const CRACK_FAR = {FAR:e};\n")]).collect()
}

/// The cracks, and where their segments are; the cuts that frames refer to.
struct Directory<'a> {
    center: Vec2,
    step: &'a Step,
    cracks: Vec<LocalCrack<'a>>,
    /// First edge and number of edges, negative if some are arcs.
    entries: Vec<Vec2>,
    /// Pair at which the cuts begin.
    first_cut: usize,
    cuts: Vec<Vec2>,
}

impl<'a> Directory<'a> {
    /// For a directory that begins at pair `at`, with the segments and then the cuts behind it.
    fn new(step: &'a Step, at: usize, center: Vec2) -> Self {
        let cracks: Vec<_> =
            step.cracks.iter().map(|crack| LocalCrack::new(crack, center)).collect();
        let mut next = at + cracks.len();
        let entry = |(crack, local): (&Crack, &LocalCrack<'_>)| {
            let (first, count, is_curved) = (next, crack.points.len() - 1, crack.is_curved());
            let vertices = if is_curved { VERTEX * crack.points.len() } else { 0 };
            next += SEGMENT * count + vertices + GROUP * local.groups().len();
            vec2(first as f64, if is_curved { -1.0 } else { 1.0 } * count as f64)
        };
        let entries = step.cracks.iter().zip(&cracks).map(entry).collect();
        Self { center, step, cracks, entries, first_cut: next, cuts: Vec::new() }
    }

    fn frame(&mut self, frame: &GroupFrame) -> [Vec2; FRAME] {
        let zero = Vec2::ZERO;
        match *frame {
            GroupFrame::One => [zero; FRAME],
            GroupFrame::Side(crack) => [self.entries[crack as usize], zero, zero, zero],
            GroupFrame::Indicator(function) => [self.indicator(function), zero, zero, zero],
            GroupFrame::World => [self.center, vec2(1.0, 0.0), zero, zero],
            GroupFrame::Fixed { origin, angle } => {
                [self.center - origin, vec2(angle.cos(), angle.sin()), zero, zero]
            }
            GroupFrame::Tip(TipId { crack, end }) => {
                let crack = crack as usize;
                let tip = LocalTip::new(&self.step.cracks[crack], end, self.center);
                // of a crack with arcs the lines beyond its ends have the numbers 0 and 1
                let is_curved = self.step.cracks[crack].is_curved();
                let number = if is_curved { usize::from(end == End::Last) } else { tip.segment };
                let at_end = vec2(crack as f64, number as f64);
                [tip.from_tip, tip.axis, vec2(tip.distance(), tip.orientation), at_end]
            }
        }
    }

    /// First cut and number of cuts of the indicator that a function is.
    fn indicator(&mut self, function: u32) -> Vec2 {
        let FunctionKind::Component { cuts } = &self.step.functions[function as usize].kind else {
            return Vec2::ZERO;
        };
        let first = self.first_cut + self.cuts.len();
        for &Cut { segment: SegmentId { crack, segment }, left, right } in cuts {
            let line = self.entries[crack as usize].x + (SEGMENT * segment as usize) as f64;
            self.cuts.push(vec2(line, 0.0));
            self.cuts.push(vec2(left.number() as f64, right.number() as f64));
        }
        vec2(first as f64, cuts.len() as f64)
    }
}

/// The edges of a crack, and of one with arcs the vertices and groups of edges.
fn segments(crack: &LocalCrack<'_>) -> Vec<Vec2> {
    let vertices = crack.vertices();
    let edge = |s: &ppum::crack::LocalSegment| {
        let ends = vec2(s.lo.max(-FAR), s.hi.min(FAR));
        let major = vec2(if s.is_major { 1.0 } else { 0.0 }, 0.0);
        let last = if vertices.is_empty() { ends } else { major };
        [s.tangent, vec2(s.distance, s.curvature), last]
    };
    let vertex = |v: &LocalVertex| [v.at, v.tangents[0], v.tangents[1]];
    let group = |g: &EdgeGroup| [g.center, vec2(g.radius.min(FAR), g.edges.end as f64)];
    let edges = crack.segments();
    let both = edges.iter().flat_map(edge).chain(vertices.iter().flat_map(vertex));
    both.chain(crack.groups().iter().flat_map(group)).collect()
}

/// A circle divided by 2r and the lines of a polygon by their lengths: numbers of the size
/// of distances.
fn rim(hole: &Hole, center: Vec2) -> Vec<Vec2> {
    match (hole, hole.at(center).rim()) {
        (Hole::Circle { radius, .. }, LocalRim::Circle { d, excess }) => {
            let half = 0.5 / radius;
            vec![vec2(0.0, excess * half), *d * (2.0 * half), vec2(half, 0.0)]
        }
        (_, LocalRim::Polygon(sides, cut)) => {
            let outside = if *cut == PolygonSide::Outside { 1.0 } else { 0.0 };
            let head = vec2(sides.len() as f64, outside);
            std::iter::once(head).chain(sides.iter().flat_map(side)).collect()
        }
        _ => unreachable!("a circle is seen as a circle"),
    }
}

fn side(side: &LocalSide) -> [Vec2; SIDE] {
    let inverse = 1.0 / side.direction.length();
    let (bulge, gradient, value) = match side.arc {
        Some(arc) => (arc.edge.bulge, arc.gradient, arc.value),
        None => (0.0, Vec2::ZERO, 0.0),
    };
    let scale = inverse / (1.0 + bulge * bulge);
    let distance = vec2(side.cross * inverse, 2.0 * bulge * scale);
    [side.a, side.b, side.direction * inverse, distance, gradient * scale, vec2(value * scale, 0.0)]
}

fn rounded(pair: Vec2) -> [f32; 2] {
    [pair.x as f32, pair.y as f32]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_have_a_limit() {
        assert_eq!(check_size(1 << 24), Ok(()));
        let error = check_size((1 << 24) + 1).expect_err("too many").to_string();
        assert!(error.contains("functions of components need 134217736 bytes"), "{error}");
    }
}
