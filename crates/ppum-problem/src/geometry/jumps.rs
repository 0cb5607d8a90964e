//! The functions that let a field jump across the cracks in a patch.
//!
//! The side of a crack serves where it says what the crack does to the patch: the crack passes
//! through once, meets no other one there, and its straight extensions, across which the side jumps
//! too, stay away. Wherever cracks meet, come back or end on holes the patch has the indicators of
//! its [`Components`]; where such a crack is a chain of arcs with common tangents its side has to
//! do.
//!
//! A crack that leaves the middle of the patch whole cuts a sliver off it, where the weight is
//! small and the polynomials vary little. Its side is not small outside of the sliver: the solution
//! there would be a small difference of large parts. So it gives the patch the indicator of
//! the sliver.

use ppum::crack::{Crack, SegmentId, TipId};
use ppum::domain::{Domain, Hole};
use ppum::edge::Edge;
use ppum::function::FunctionKind;
use ppum::vec2::Rect;

use super::box_list::{BoxList, wider};
use super::clearance::{extension, extensions, led_away};
use super::clip::{clipped, edge_inside, inside, is_on_rim, meets, solid_length};
use super::components::{Components, middle};

/// Part of a patch's size below which a cut does not count.
const LEAST_CUT: f64 = 1e-9;

/// Sine of angles, and difference of curvatures in sizes of a patch, that are rounding.
const SMOOTH: f64 = 1e-6;

/// Most segments of cracks that may cut a patch where cracks meet: time grows with the square.
const MOST: usize = 512;

/// The relation of cracks to patches.
pub struct Jumps<'p> {
    cracks: &'p [Crack],
    segments: BoxList<(SegmentId, Edge)>,
    holes: BoxList<&'p Hole>,
    /// The straight extensions of each crack; none of one that they or the crack itself meet.
    extensions: Vec<Option<[Edge; 2]>>,
    /// Length of extensions.
    reach: f64,
    /// Distance from which on cracks keep apart.
    touch: f64,
}

impl<'p> Jumps<'p> {
    /// The cracks of a domain; things not farther apart than `touch` meet.
    pub fn new(cracks: &'p [Crack], domain: &'p Domain, touch: f64) -> Self {
        let cutting = (0..).zip(cracks).filter(|(_, crack)| !is_on_rim(crack, &domain.holes));
        let all = cutting.flat_map(|(crack, c)| segments(crack, c));
        let place = |(id, edge): (SegmentId, Edge)| (edge.bounds(), (id, edge));
        let reach = domain.bounds.size().length();
        Self {
            cracks,
            segments: BoxList::new(all.map(place)),
            holes: BoxList::new(
                domain.holes.iter().flat_map(|hole| hole.boxes().map(move |b| (b, hole))),
            ),
            extensions: cracks.iter().map(|crack| extensions(crack, reach, touch)).collect(),
            reach,
            touch,
        }
    }

    /// The functions of a patch with this open box; none if more segments meet each other there
    /// than can be looked at.
    pub fn of(&self, open: &Rect) -> Vec<FunctionKind> {
        let cut = self.cut(open);
        let mut holes: Vec<_> = self.holes.near(open).copied().collect();
        // an outline has a box for each of its sides
        holes.dedup_by(|a, b| std::ptr::eq(*a, *b));
        if holes.is_empty() && self.are_apart(&cut, open) {
            return self.passing(&cut, open).flat_map(|run| self.across(run, open)).collect();
        }
        if cut.len() > MOST || !self.is_cut(&cut, open, &holes) {
            return Vec::new();
        }
        if is_smooth(&cut, open) {
            return self.passing(&cut, open).map(side_of).collect();
        }
        self.indicators(&cut, open, &holes)
    }

    /// The cracks that pass through a patch with this open box; none where cracks meet, come back
    /// or end on holes, whose sides jump in the material, too.
    pub fn through(&self, open: &Rect) -> Vec<u32> {
        let cut = self.cut(open);
        if self.holes.near(open).next().is_some() || !self.are_apart(&cut, open) {
            return Vec::new();
        }
        self.passing(&cut, open).map(|run| run[0].0.crack).collect()
    }

    /// The function that jumps on a crack which passes through a box: its side, or the indicator of
    /// the sliver that it cuts off.
    fn across(&self, run: &[(SegmentId, Edge)], open: &Rect) -> Vec<FunctionKind> {
        let middle = middle(open);
        let is_through = run.iter().any(|(_, s)| meets(*s, &middle));
        if run.len() > MOST || is_through || is_smooth(run, open) {
            return vec![side_of(run)];
        }
        self.indicators(run, open, &[])
    }

    /// The indicators of the components that some segments and holes leave of a box.
    fn indicators(
        &self,
        cut: &[(SegmentId, Edge)],
        open: &Rect,
        holes: &[&Hole],
    ) -> Vec<FunctionKind> {
        let all = Components::new(open, cut.iter().copied(), holes, 2.0 * self.touch);
        all.indicators().into_iter().map(|cuts| FunctionKind::Component { cuts }).collect()
    }

    /// True if more segments meet each other in a patch than can be looked at.
    pub fn are_too_many(&self, open: &Rect) -> bool {
        let cut = self.cut(open);
        cut.len() > MOST && (self.holes.near(open).next().is_some() || !self.are_apart(&cut, open))
    }

    /// A crack that meets another one, or whose extensions meet it or each other.
    pub(crate) fn first_meeting(&self) -> Option<u32> {
        let back = self.extensions.iter().position(Option::is_none).map(|crack| crack as u32);
        back.or_else(|| {
            let all = (0..).zip(self.cracks).flat_map(|(k, crack)| segments(k, crack));
            let meets = |(id, edge): &(SegmentId, Edge)| {
                let near = self.segments.near(&wider(&edge.bounds(), self.touch));
                let others = near.filter(|(other, _)| other.crack != id.crack);
                others.into_iter().any(|(_, other)| edge.gap(other) <= self.touch)
            };
            all.into_iter().find(meets).map(|(id, _)| id.crack)
        })
    }

    /// True if the angle θ at a tip may jump in a box beside the tip's crack: it does so on the
    /// crack, or where another part of a crack that comes back, or its other end's extension, is as
    /// near as the part that leads away from the tip.
    pub fn mislead(&self, tip: TipId, within: &Rect) -> bool {
        if self.extensions[tip.crack as usize].is_some() {
            return false;
        }
        let crack = &self.cracks[tip.crack as usize];
        let [own, rest] = led_away(crack, tip.end);
        let beyond = extension(crack, tip.end.opposite(), self.reach);
        let mut others = rest.into_iter().chain([beyond]);
        let distance = |p| own.iter().map(|edge| edge.distance(p)).fold(f64::INFINITY, f64::min);
        let farthest = within.corners().map(distance).into_iter().fold(0.0, f64::max);
        others.any(|edge| super::clip::distance(edge, within) <= farthest)
    }

    /// True if a box that does not hold a tip meets the straight extension of the crack's other
    /// end, on which the angle at the tip jumps and nothing else does.
    pub fn is_beyond(&self, tip: TipId, within: &Rect) -> bool {
        let crack = &self.cracks[tip.crack as usize];
        let beyond = extension(crack, tip.end.opposite(), self.reach);
        !inside(within, crack.end_point(tip.end)) && edge_inside(beyond, within) > 0.0
    }

    /// The segments that meet a box.
    fn cut(&self, open: &Rect) -> Vec<(SegmentId, Edge)> {
        self.segments.near(open).filter(|(_, s)| meets(*s, open)).copied().collect()
    }

    /// True if some length of cracks lies in the material of a box.
    fn is_cut(&self, cut: &[(SegmentId, Edge)], open: &Rect, holes: &[&Hole]) -> bool {
        let size = open.size();
        let length = |edge: Edge| solid_length(edge, open, holes.iter().copied());
        let all: f64 = cut.iter().map(|(_, edge)| length(*edge)).sum();
        all > LEAST_CUT * size.x.min(size.y)
    }

    /// The segments of each crack that cuts a box through.
    fn passing<'c>(
        &self,
        cut: &'c [(SegmentId, Edge)],
        open: &Rect,
    ) -> impl Iterator<Item = &'c [(SegmentId, Edge)]> {
        let passes = |run: &&[(SegmentId, Edge)]| {
            self.is_cut(run, open, &[]) && !self.has_tip(run[0].0.crack, open)
        };
        cut.chunk_by(|a, b| a.0.crack == b.0.crack).filter(passes)
    }

    /// True if a tip of a crack lies in a box.
    fn has_tip(&self, crack: u32, open: &Rect) -> bool {
        let crack = &self.cracks[crack as usize];
        crack.tips().any(|end| inside(open, crack.end_point(end)))
    }

    /// True if the cracks in a box pass through it once each, and keep away from each other and
    /// from the extensions.
    fn are_apart(&self, cut: &[(SegmentId, Edge)], open: &Rect) -> bool {
        let runs: Vec<_> = cut.chunk_by(|a, b| a.0.crack == b.0.crack).collect();
        let once = |run: &&[(SegmentId, Edge)]| {
            let crack = run[0].0.crack;
            let is_clear = |rays: [Edge; 2]| {
                self.has_tip(crack, open) || rays.iter().all(|ray| edge_inside(*ray, open) == 0.0)
            };
            let goes_on = |pair: &[(SegmentId, Edge)]| {
                pair[1].0.segment == pair[0].0.segment + 1 && inside(open, pair[0].1.to)
            };
            let stays =
                |(_, edge): &(SegmentId, Edge)| !edge.is_arc() || clipped(*edge, open).len() < 2;
            run.windows(2).all(goes_on)
                && run.iter().all(stays)
                && self.extensions[crack as usize].is_some_and(is_clear)
        };
        runs.iter().all(once) && (runs.len() < 2 || self.keep_apart(&runs, open))
    }

    /// True if no two of the runs meet in a box.
    fn keep_apart(&self, runs: &[&[(SegmentId, Edge)]], open: &Rect) -> bool {
        let within = wider(open, self.touch);
        let parts = |run: &[(SegmentId, Edge)]| {
            let part = |(_, edge): &(SegmentId, Edge)| {
                let edge = *edge;
                clipped(edge, &within).into_iter().map(move |range| edge.part(range))
            };
            run.iter().flat_map(part).collect()
        };
        let parts: Vec<Vec<Edge>> = runs.iter().map(|run| parts(run)).collect();
        let near = |s: &Edge, t: &Edge| s.gap(t) <= self.touch;
        parts.iter().enumerate().all(|(k, run)| {
            let others = parts[..k].iter().flatten();
            others.into_iter().all(|t| !run.iter().any(|s| near(s, t)))
        })
    }
}

fn side_of(run: &[(SegmentId, Edge)]) -> FunctionKind {
    FunctionKind::Side { crack: run[0].0.crack }
}

/// True if edges of different curvatures have a common tangent where they meet in a box. No signs
/// of two circles that touch tell the points before their common one from those behind it: there
/// the sides of whole cracks have to serve instead of components.
fn is_smooth(cut: &[(SegmentId, Edge)], open: &Rect) -> bool {
    let size = open.size().length();
    let is_joint = |pair: &[(SegmentId, Edge)]| {
        let [(first, a), (second, b)] = [pair[0], pair[1]];
        let follows = first.crack == second.crack && first.segment + 1 == second.segment;
        let differ = (a.curvature() - b.curvature()).abs() * size > SMOOTH;
        let turn = a.end_tangents()[1].cross(b.end_tangents()[0]).abs();
        follows && differ && turn <= SMOOTH && inside(open, a.to)
    };
    let curved = |pair: &&[(SegmentId, Edge)]| pair.iter().any(|(_, edge)| edge.is_arc());
    cut.windows(2).filter(curved).any(is_joint)
}

fn segments(index: u32, crack: &Crack) -> impl Iterator<Item = (SegmentId, Edge)> + '_ {
    (0..).zip(crack.edges()).map(move |(segment, edge)| (SegmentId { crack: index, segment }, edge))
}
