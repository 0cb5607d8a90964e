//! Rules along edges, segments and arcs: parts of the boundary, rims of holes, faces of cracks.

use super::adapt::IntegrandDemand;
use super::adapt::refined;
use super::cell::{CoveredCell, Quadrature, SAME_POINT, distinct, straight_cut};
use super::edge_line::EdgeLine;
use super::geometry::{CrackFace, KinkLine, Singularity};
use super::graded_interval::{GradedInterval, LONGEST, LineParameter};
use super::orders::ActiveFunctions;
use super::rule::EdgeRule;
use super::singular::{panels, resolved};
use super::split::{TOLERANCE, breaks, divided, kinks, varies};
use ppum::edge::{Edge, EdgeFrame};
use ppum::vec2::{Rect, Vec2};
use ppum_problem::geometry::{wider, without};
use std::cell::Cell;

/// Distances from an edge below this part of its length count as zero.
const ON_LINE: f64 = 1e-14;

/// Distance behind a boundary, in units of a cell, at which it is asked whether there is a hole.
const INWARD: f64 = 1e-9;

impl Quadrature<'_> {
    /// False if behind a point of a boundary, where the normal comes from, there is a hole.
    pub(super) fn is_solid(&self, cell: &Rect, p: Vec2, normal: Vec2) -> bool {
        let behind = p - normal * (INWARD * cell.size().length());
        !self.geometry.holes.iter().any(|hole| hole.contains(behind))
    }

    /// [`edge`](Self::edge) along a face of a crack of the geometry.
    ///
    /// # Panics
    /// If there is no such edge.
    #[must_use]
    pub(crate) fn face(&self, cell: CoveredCell<'_>, face: CrackFace) -> Vec<EdgeRule> {
        let edge = face.edge(self.geometry.cracks);
        self.along(cell, (&edge, edge), face.outside(), Some(face))
    }

    /// Returns the rule along the part of a face between two points of its edge.
    #[must_use]
    pub fn part_of_face(
        &self,
        cell: CoveredCell<'_>,
        part: [Vec2; 2],
        face: CrackFace,
    ) -> Vec<EdgeRule> {
        let edge = face.edge(self.geometry.cracks);
        let part = if edge.is_arc() {
            // in the edge's own direction
            let [a, b] = part.map(|p| edge.closest_part(p));
            edge.part([a.min(b), a.max(b)])
        } else {
            Edge::segment(part)
        };
        self.along(cell, (&edge, part), face.outside(), Some(face))
    }

    /// Rules on the part of an edge that belongs to a cell; empty if none does.
    ///
    /// `outside` is +1 if the material is on the right of the edge, −1 if it is on its left;
    /// normals point out of it. Parts without material behind them count for nothing, and neither
    /// do faces of cracks on it. An edge along a cell's boundary belongs to the cell that normals
    /// point out of.
    #[must_use]
    pub(crate) fn edge(&self, cell: CoveredCell<'_>, edge: Edge, outside: f64) -> Vec<EdgeRule> {
        self.along(cell, (&edge, edge), outside, None)
    }

    /// Rules on the part of a hole's rim that belongs to a cell, on the sides that are wanted;
    /// empty if there is none. Normals point into the hole.
    #[must_use]
    pub(crate) fn rim(
        &self,
        cell: CoveredCell<'_>,
        hole: usize,
        is_wanted: impl Fn(usize) -> bool,
    ) -> Vec<EdgeRule> {
        // a side on a line of cells may be beside it by rounding
        let near = wider(cell.rect, TOLERANCE * cell.rect.size().length());
        let hole = &self.holes[hole];
        let sides = hole.edges.near(&near).filter(|(k, _)| is_wanted(*k));
        sides.flat_map(|(_, side)| self.edge(cell, *side, hole.outside)).collect()
    }

    fn along(
        &self,
        cell: CoveredCell<'_>,
        (edge, part): (&Edge, Edge),
        outside: f64,
        face: Option<CrackFace>,
    ) -> Vec<EdgeRule> {
        let line = EdgeLine::new(cell.rect.center(), edge, part, outside);
        let tolerance = TOLERANCE * cell.rect.size().length();
        let mut inside = line.in_cell(cell.rect);
        inside.retain(|[lo, hi]| hi - lo > tolerance);
        let (left, rules, quadrature) = (Cell::new(self.divisions), Vec::new(), self);
        let mut run = LineIntegration { quadrature, line, face, tolerance, cell, rules, left };
        let faces: Vec<_> = match face {
            None => self.faces.iter().filter_map(|face| run.line.range_of(*face)).collect(),
            Some(_) => Vec::new(),
        };
        for range in inside {
            without(range, &faces).into_iter().for_each(|[lo, hi]| run.add(lo, hi));
        }
        let mut rules = run.rules;
        for EdgeRule { anchor, offsets, weights, .. } in &mut rules {
            self.revolve(*anchor, offsets, weights);
        }
        rules
    }

    /// The number of Gauss points on a part of an edge that is so far from singular points, in
    /// parts of its length.
    fn order_along(&self, patches: &[u32], distance: f64) -> usize {
        self.orders.choose(&ActiveFunctions {
            patches: patches.len(),
            distance,
            kinks: self.geometry.has_kinks(patches),
            probes: !self.geometry.active_probes(patches).is_empty(),
        })
    }
}

/// True if two closed boxes have a point in common.
pub(crate) fn closed_meet(a: &Rect, b: &Rect) -> bool {
    let common = a.intersection(b);
    common.min.x <= common.max.x && common.min.y <= common.max.y
}

/// Gauss points with which functions that are smooth over so many lengths of an interval are exact
/// to 1e-16: n points err like ρ^(−2n), ρ the size of Bernstein's ellipse up to there. Each of
/// the short arcs of a curve needs a few.
fn enough(lengths: f64) -> usize {
    let x = 1.0 + 2.0 * lengths;
    let rho = x + (x * x - 1.0).sqrt();
    (-0.5 * f64::EPSILON.ln() / rho.ln()).ceil() as usize
}

struct LineIntegration<'a> {
    quadrature: &'a Quadrature<'a>,
    line: EdgeLine,
    /// The face that the line lies on, if it is on one.
    face: Option<CrackFace>,
    tolerance: f64,
    cell: CoveredCell<'a>,
    rules: Vec<EdgeRule>,
    /// Divisions that are left.
    left: Cell<usize>,
}

impl LineIntegration<'_> {
    /// Splits at the boundaries of supports.
    fn add(&mut self, lo: f64, hi: f64) {
        let partition = self.quadrature.geometry.partition;
        let ranges = |&i: &u32| {
            let inside = self.line.in_support(&partition.support(i as usize), [lo, hi]);
            inside.into_iter().map(move |range| (i, range))
        };
        let covered: Vec<(u32, [f64; 2])> = self.cell.patches.iter().flat_map(ranges).collect();
        let boundaries = covered.iter().flat_map(|(_, range)| *range).collect();
        for part in breaks(lo, hi, boundaries, self.tolerance).windows(2) {
            let mid = 0.5 * (part[0] + part[1]);
            let holds = |&(_, [a, b]): &(u32, [f64; 2])| a < mid && mid < b;
            let mut patches: Vec<u32> = covered.iter().filter(|c| holds(c)).map(|c| c.0).collect();
            patches.sort_unstable();
            self.add_constant_set(part[0], part[1], &patches);
        }
    }

    /// Splits at kinks of the partition functions, of functions and materials, and at cracks.
    fn add_constant_set(&mut self, lo: f64, hi: f64, patches: &[u32]) {
        let geometry = &self.quadrature.geometry;
        let (mut points, mut varying) = (Vec::new(), false);
        for axis in 0..2 {
            let kinks = kinks(geometry.partition, patches, axis);
            points.extend(kinks.into_iter().flat_map(|at| self.line.parameters(axis, at)));
            varying |= self.line.varies(axis) && varies(geometry.partition, patches, axis);
        }
        points.extend(self.crossings([lo, hi], &geometry.active_kinks(patches)));
        let singular = geometry.singular_points(patches);
        let singular = distinct(singular, SAME_POINT * self.cell.rect.size().length());
        let mut breaks = breaks(lo, hi, points, self.tolerance);
        if varying {
            breaks = divided(breaks, self.quadrature.orders.parts);
        }
        for part in breaks.windows(2) {
            let middle = self.line.frame.at(0.5 * (part[0] + part[1]));
            let (at, normal) = (self.line.anchor + middle, self.line.normal(middle));
            if self.quadrature.is_solid(self.cell.rect, at, normal) {
                self.add_smooth_parts(part, patches, &singular);
            }
        }
    }

    /// Where the line crosses cracks and rims that meet the cell, and kinks.
    fn crossings(&self, range: [f64; 2], kinks: &[&KinkLine]) -> Vec<f64> {
        let (line, cell) = (&self.line, self.cell.rect);
        let straight = kinks.iter().filter_map(|kink| straight_cut(kink, cell));
        let own = [line.edge.from, line.edge.to];
        let others = self.quadrature.cuts_near(cell).filter(|cut| cut.ends != own);
        let cuts = others.chain(straight).flat_map(|cut| line.meets_cut(range, cut));
        let levels = kinks.iter().filter_map(|kink| match kink {
            KinkLine::Curve(level) => Some(line.meets_level(range, level.as_ref())),
            _ => None,
        });
        let runs = self.quadrature.runs_near(cell);
        let arcs = runs.flat_map(|run| run.near(cell).flat_map(|(_, arc)| line.meets_arc(arc)));
        cuts.chain(levels.flatten()).chain(arcs).collect()
    }

    /// Divides arcs into parts that do not turn much.
    fn add_smooth_parts(&mut self, ends: &[f64], patches: &[u32], singular: &[Singularity]) {
        let turn = self.line.frame.curvature * (ends[1] - ends[0]);
        let parts = (turn.abs() / LONGEST).ceil().max(1.0) as usize;
        for part in divided(ends.to_vec(), parts).windows(2) {
            self.add_smooth(part[0], part[1], patches, singular);
        }
    }

    fn add_smooth(&mut self, lo: f64, hi: f64, patches: &[u32], singular: &[Singularity]) {
        let distance = |at: &Singularity| {
            let (s, d) = self.line.seen_from(at.point);
            (s - s.clamp(lo, hi)).hypot(d)
        };
        let near: Vec<Singularity> =
            singular.iter().copied().filter(|at| distance(at) < hi - lo).collect();
        let nearest = singular.iter().map(distance).fold(f64::INFINITY, f64::min);
        let order = self.quadrature.order_along(patches, nearest / (hi - lo));
        let smooth = nearest.min(self.cell.rect.size().length());
        let order = if self.line.is_arc() { order.min(enough(smooth / (hi - lo))) } else { order };
        match near[..] {
            [] => {
                let (path, frame) = (LineParameter::Straight, self.line.frame);
                let whole = GradedInterval { path, frame, interval: (lo, hi) };
                self.push(self.line.anchor, patches, order, vec![whole]);
            }
            [at] => self.push(at.point, patches, order, self.graded(lo, hi, &at, order)),
            _ => {
                let mid = 0.5 * (lo + hi);
                self.add_smooth(lo, mid, patches, &near);
                self.add_smooth(mid, hi, patches, &near);
            }
        }
    }

    /// Graded toward a singular point, and relative to it: x = d sinh u at distance d, a power on
    /// the line itself.
    fn graded(&self, lo: f64, hi: f64, at: &Singularity, order: usize) -> Vec<GradedInterval> {
        let (s, d) = self.line.seen_from(at.point);
        // an end at the point itself is there exactly: what rounding would leave between
        // them counts
        let from_point = |x: f64| if (x - s).abs() > ON_LINE * (hi - lo) { x - s } else { 0.0 };
        let (lo, hi) = (from_point(lo), from_point(hi));
        let frame = EdgeFrame { tangent: self.line.frame.tangent_at(s), ..self.line.frame };
        if d > ON_LINE * (hi - lo) {
            let foot = self.line.foot_from(at.point, frame.tangent.left());
            let (path, frame) = (LineParameter::Beside(d), EdgeFrame { foot, ..frame });
            let beside = |interval| GradedInterval { path, frame, interval };
            let branches = at.branches.iter().flatten();
            let zeros: Vec<_> = branches.map(|z| z.zero(frame.foot, frame.tangent * d)).collect();
            let all = panels(lo, hi, d).flat_map(|panel| resolved(panel, &zeros));
            return all.map(beside).collect();
        }
        let grading = at.growth.along_lines(order);
        let frame = EdgeFrame { foot: Vec2::ZERO, ..frame };
        let root = |r: f64| r.powf(1.0 / grading.power);
        [(lo.max(0.0), hi, 1.0), ((-hi).max(0.0), -lo, -1.0)]
            .into_iter()
            .filter(|(from, to, _)| to > from)
            .map(|(from, to, sign)| GradedInterval {
                path: LineParameter::Through { sign, grading },
                frame,
                interval: (root(from), root(to)),
            })
            .collect()
    }

    /// Adds parts of the line, divided until they resolve what they have to.
    fn push(
        &mut self,
        anchor: Vec2,
        patches: &[u32],
        order: usize,
        intervals: Vec<GradedInterval>,
    ) {
        let same = |r: &EdgeRule| r.anchor == anchor && r.patches == patches;
        let at = self.rules.iter().position(same).unwrap_or_else(|| {
            self.rules.push(EdgeRule { face: self.face, ..EdgeRule::empty(anchor, patches) });
            self.rules.len() - 1
        });
        let Quadrature { geometry, orders, .. } = self.quadrature;
        let (active, rule) = (geometry.active_probes(patches), &mut self.rules[at]);
        let demand = geometry.demand(&active, order, *orders, (self.cell.rect, &self.left));
        let demand = IntegrandDemand { anchor, face: self.face, ..demand };
        let shift = anchor - self.line.anchor;
        let doubt =
            refined(intervals, &demand, &mut |x, w| rule.push(x, w, self.line.normal(shift + x)));
        rule.doubt.add(&doubt);
    }
}
