//! Curves joined at their ends.

use std::collections::HashMap;

use ppum::edge::Edge;
use ppum::vec2::Vec2;

use crate::error::{ImportError, shown};
use crate::sketch::NamedCurve;

/// Points that are one if they are within a tolerance of the first of them.
pub(crate) struct Joints {
    tolerance: f64,
    cells: HashMap<[i64; 2], Vec<usize>>,
    points: Vec<Vec2>,
}

impl Joints {
    pub(crate) fn new(tolerance: f64) -> Self {
        Self { tolerance, cells: HashMap::new(), points: Vec::new() }
    }

    /// The number of the joint at a point.
    pub(crate) fn number(&mut self, p: Vec2) -> usize {
        let cell = [p.x, p.y].map(|x| (x / self.tolerance).floor() as i64);
        let steps = [0_i64, -1, 1];
        let near = steps
            .iter()
            .flat_map(|i| steps.map(|j| [cell[0].saturating_add(*i), cell[1].saturating_add(j)]));
        let known = near.filter_map(|cell| self.cells.get(&cell)).flatten();
        let is_same = |k: &&usize| (self.points[**k] - p).length() <= self.tolerance;
        if let Some(number) = known.copied().find(|k| is_same(&k)) {
            return number;
        }
        self.points.push(p);
        self.cells.entry(cell).or_default().push(self.points.len() - 1);
        self.points.len() - 1
    }
}

/// Curves one after the other; the last one ends where the first begins, if it is closed.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveChain {
    /// The curves, each from where the one before ends.
    pub curves: Vec<NamedCurve>,
    /// True for a closed one.
    pub is_closed: bool,
}

/// Curves with the numbers of the joints at their ends.
pub(crate) struct Network {
    curves: Vec<Option<NamedCurve>>,
    ends: Vec<[usize; 2]>,
    /// The curves at each joint, with the end that is there.
    meeting: Vec<Vec<(usize, usize)>>,
}

impl Network {
    pub(crate) fn new(curves: Vec<NamedCurve>, joints: &mut Joints) -> Self {
        let number = |named: &NamedCurve| named.curve.ends().map(|p| joints.number(p));
        let ends: Vec<_> = curves.iter().map(number).collect();
        let mut meeting = vec![Vec::new(); joints.points.len()];
        for (k, numbers) in ends.iter().enumerate() {
            (0..2).for_each(|end| meeting[numbers[end]].push((k, end)));
        }
        Self { curves: curves.into_iter().map(Some).collect(), ends, meeting }
    }

    fn left(&self, joint: usize) -> impl Iterator<Item = (usize, usize)> {
        self.meeting[joint].iter().copied().filter(|(k, _)| self.curves[*k].is_some())
    }

    /// Takes out the curves that no closed one can have: those with an end where nothing else is.
    pub(crate) fn without_open(&mut self) -> Vec<NamedCurve> {
        let mut loose: Vec<_> =
            (0..self.meeting.len()).filter(|j| self.meeting[*j].len() == 1).collect();
        let mut open = Vec::new();
        while let Some(joint) = loose.pop() {
            let mut left = self.left(joint);
            let (Some((k, end)), None) = (left.next(), left.next()) else { continue };
            drop(left);
            open.extend(self.curves[k].take());
            loose.push(self.ends[k][1 - end]);
        }
        open
    }

    /// Refuses curves of which more than two meet.
    pub(crate) fn check_branches(&self) -> Result<(), ImportError> {
        for joint in 0..self.meeting.len() {
            let left: Vec<_> = self.left(joint).collect();
            if left.len() > 2 {
                let named =
                    left.iter().filter_map(|(k, end)| Some((self.curves[*k].as_ref()?, end)));
                let at = named
                    .clone()
                    .next()
                    .map_or(Vec2::ZERO, |(first, end)| first.curve.ends()[*end]);
                let sources: Vec<_> =
                    named.take(3).map(|(named, _)| named.source.to_string()).collect();
                return Err(ImportError(format!(
                    "{} curves meet at {}, among them {}; the border of a body does not branch: give cracks the \
                     layer, group or label `crack`",
                    left.len(),
                    shown(at),
                    sources.join(" and ")
                )));
            }
        }
        Ok(())
    }

    /// All curves as chains that end where not just two of them meet.
    pub(crate) fn chains(mut self) -> Vec<CurveChain> {
        let degrees: Vec<_> =
            (0..self.meeting.len()).map(|joint| self.left(joint).count()).collect();
        let all: Vec<_> = (0..self.curves.len()).flat_map(|k| [(k, 0), (k, 1)]).collect();
        let (from_ends, rest): (Vec<_>, Vec<_>) =
            all.into_iter().partition(|(k, end)| degrees[self.ends[*k][*end]] != 2);
        let starts = from_ends.into_iter().chain(rest);
        starts.filter_map(|start| self.chain(start, &degrees)).collect()
    }

    /// The chain from an end of a curve on, if the curve is in none yet.
    fn chain(&mut self, (mut k, mut end): (usize, usize), degrees: &[usize]) -> Option<CurveChain> {
        let first = self.ends[k][end];
        let mut curves = Vec::new();
        loop {
            let named = self.curves[k].take()?;
            let curve = if end == 0 { named.curve } else { named.curve.reversed() };
            curves.push(NamedCurve { curve, ..named });
            let joint = self.ends[k][1 - end];
            if joint == first || degrees[joint] != 2 {
                let is_closed = joint == first;
                return Some(CurveChain { curves, is_closed }.joined());
            }
            let Some(next) = self.left(joint).next() else {
                return Some(CurveChain { curves, is_closed: false }.joined());
            };
            (k, end) = next;
        }
    }
}

impl CurveChain {
    /// Returns the chain with curves whose ends are equal where they join: those of polylines move,
    /// of two others the second one.
    fn joined(mut self) -> Self {
        use crate::curve::PlaneCurve::Polyline;
        let n = self.curves.len();
        let is_polyline = |named: &NamedCurve| matches!(named.curve, Polyline(_));
        let joint = |k: usize| {
            let (before, after) = (&self.curves[k], &self.curves[(k + 1) % n]);
            let use_after = is_polyline(before) && !is_polyline(after);
            if use_after { after.curve.ends()[0] } else { before.curve.ends()[1] }
        };
        let mut joints: Vec<Vec2> = (0..n).map(joint).collect();
        let mut begin = joints[n - 1];
        if !self.is_closed || n == 1 {
            let [first, last] =
                [self.curves[0].curve.ends()[0], self.curves[n - 1].curve.ends()[1]];
            let is_polygon = self.is_closed && is_polyline(&self.curves[0]);
            (begin, joints[n - 1]) = (first, if is_polygon { first } else { last });
        }
        for (named, joint) in self.curves.iter_mut().zip(joints) {
            let curve = std::mem::replace(&mut named.curve, Polyline(Vec::new()));
            named.curve = curve.moved([begin, joint]);
            begin = joint;
        }
        self
    }

    /// The chain from its end to its begin.
    #[must_use]
    pub fn reversed(self) -> Self {
        let back = |named: NamedCurve| NamedCurve { curve: named.curve.reversed(), ..named };
        let curves = self.curves.into_iter().rev().map(back).collect();
        Self { curves, is_closed: self.is_closed }
    }

    /// The chain with its begin and its end moved.
    pub(crate) fn with_ends(mut self, to: [Vec2; 2]) -> Self {
        let last = self.curves.len() - 1;
        for (k, end) in [(0, 0), (last, 1)] {
            let mut ends = self.curves[k].curve.ends();
            ends[end] = to[end];
            self.curves[k].curve = self.curves[k].curve.clone().moved(ends);
        }
        self
    }

    /// The edges of all curves.
    #[must_use]
    pub fn edges(&self) -> Vec<Edge> {
        self.curves.iter().flat_map(|named| named.curve.edges()).collect()
    }
}
