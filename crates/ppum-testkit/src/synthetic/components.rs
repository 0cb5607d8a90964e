//! The parts that cracks leave of a box: connected components, and the functions that are 1 on one
//! of them.
//!
//! In the box cracks may cross, branch, kink and end on each other, but no tip lies in it. Then the
//! lines of the segments cut it into convex cells whose sides lie on a crack wholly or not at all,
//! and cells are joined across the others.

use std::collections::BTreeMap;

use ppum::crack::{Crack, SegmentId};
use ppum::function::{Cut, CutBranch};
use ppum::segment::signed_area;
use ppum::vec2::{Rect, Vec2};

/// Areas and steps that nobody sees, in parts of the box.
const ROUNDING: f64 = 1e-9;
/// Sides of cells shorter than this, in parts of the box, are what rounding has left at a junction:
/// a step across them may lead anywhere.
const SHORTEST: f64 = 1e-6;

/// The connected components of a box.
#[derive(Clone, Debug)]
pub struct SyntheticComponents {
    root: SyntheticNode,
    lines: Vec<CrackSegment>,
    /// The convex cells.
    cells: Vec<Vec<Vec2>>,
    /// The component of each cell.
    of_cell: Vec<usize>,
    count: usize,
}

/// A tree of cuts by lines.
#[derive(Clone, Debug)]
enum SyntheticNode {
    Cell(usize),
    Cut { line: usize, sides: [Box<SyntheticNode>; 2] },
}

#[derive(Clone, Copy, Debug)]
struct CrackSegment {
    id: SegmentId,
    ends: [Vec2; 2],
}

impl SyntheticComponents {
    /// The components of a box that some cracks, by their indices, leave.
    #[must_use]
    pub fn new(cracks: &[Crack], which: &[u32], bounds: &Rect) -> Self {
        let lines = which.iter().flat_map(|&crack| lines(crack, &cracks[crack as usize])).collect();
        let mut all = Self {
            root: SyntheticNode::Cell(0),
            lines,
            cells: Vec::new(),
            of_cell: Vec::new(),
            count: 0,
        };
        all.root = all.cut(bounds.corners().to_vec(), 0);
        all.join(bounds);
        all
    }

    /// Number of components.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// The component of a point of the box.
    #[must_use]
    pub fn containing(&self, p: Vec2) -> usize {
        self.of_cell[self.cell(p)]
    }

    /// The tree of the function that is 1 on a component.
    #[must_use]
    pub fn indicator(&self, component: usize) -> Vec<Cut> {
        let mut cuts = Vec::new();
        self.write(&self.root, component, &mut cuts);
        cuts
    }

    /// A point in a component: the middle of its largest cell.
    ///
    /// # Panics
    /// If there is no such component.
    #[must_use]
    pub fn middle(&self, component: usize) -> Vec2 {
        let cells = (0..self.cells.len()).filter(|&cell| self.of_cell[cell] == component);
        let largest = |&a: &usize, &b: &usize| {
            signed_area(&self.cells[a]).total_cmp(&signed_area(&self.cells[b]))
        };
        centroid(&self.cells[cells.max_by(largest).expect("a component has a cell")])
    }

    /// Cuts a cell by the lines from a number on that part it.
    fn cut(&mut self, cell: Vec<Vec2>, first: usize) -> SyntheticNode {
        let least = ROUNDING * signed_area(&cell);
        for line in first..self.lines.len() {
            let parts = [1.0, -1.0].map(|side| clipped(&cell, &self.lines[line], side));
            if parts.iter().all(|part| signed_area(part) > least) {
                let sides = parts.map(|part| Box::new(self.cut(part, line + 1)));
                return SyntheticNode::Cut { line, sides };
            }
        }
        self.cells.push(cell);
        SyntheticNode::Cell(self.cells.len() - 1)
    }

    /// Joins cells across the sides that no crack lies on, and numbers what has come together.
    fn join(&mut self, bounds: &Rect) {
        let mut first: Vec<usize> = (0..self.cells.len()).collect();
        let step = ROUNDING * bounds.size().length();
        for cell in 0..self.cells.len() {
            for (middle, outward) in self.sides(cell, SHORTEST * bounds.size().length()) {
                let beyond = middle + outward * step;
                if bounds.contains(beyond)
                    && !self.lines.iter().any(|line| line.holds(middle, step))
                {
                    let (a, b) = (first[cell], first[self.cell(beyond)]);
                    first.iter_mut().filter(|k| **k == b).for_each(|k| *k = a);
                }
            }
        }
        let mut numbers = BTreeMap::new();
        for k in first {
            let new = numbers.len();
            self.of_cell.push(*numbers.entry(k).or_insert(new));
        }
        self.count = numbers.len();
    }

    /// Middles and outward normals of the parts that all lines divide the sides of a cell into.
    fn sides(&self, cell: usize, shortest: f64) -> Vec<(Vec2, Vec2)> {
        let corners = &self.cells[cell];
        let next = corners.iter().cycle().skip(1);
        let mut sides = Vec::new();
        for (&a, &b) in corners.iter().zip(next).filter(|(a, b)| a != b) {
            let mut at: Vec<f64> =
                self.lines.iter().filter_map(|line| line.crosses(a, b)).collect();
            at.extend([0.0, 1.0]);
            at.sort_by(f64::total_cmp);
            let apart = at.windows(2).filter(|t| (t[1] - t[0]) * (b - a).length() > shortest);
            let outward = (b - a).unit().left() * -1.0;
            sides.extend(apart.map(|t| (a + (b - a) * (0.5 * (t[0] + t[1])), outward)));
        }
        sides
    }

    fn cell(&self, p: Vec2) -> usize {
        let mut node = &self.root;
        loop {
            match node {
                SyntheticNode::Cell(cell) => return *cell,
                SyntheticNode::Cut { line, sides } => {
                    node = &sides[usize::from(self.lines[*line].distance(p) < 0.0)];
                }
            }
        }
    }

    /// Appends the cuts of a node, unless all of it is in the component or all outside.
    fn write(&self, node: &SyntheticNode, component: usize, cuts: &mut Vec<Cut>) -> CutBranch {
        let SyntheticNode::Cut { line, sides } = node else { return self.part(node, component) };
        let here = cuts.len();
        let segment = self.lines[*line].id;
        cuts.push(Cut { segment, left: CutBranch::Outside, right: CutBranch::Outside });
        let [left, right] = [0, 1].map(|side| self.write(&sides[side], component, cuts));
        if left == right && !matches!(left, CutBranch::Cut(_)) {
            cuts.truncate(here);
            return left;
        }
        cuts[here] = Cut { segment, left, right };
        CutBranch::Cut(here as u32)
    }

    fn part(&self, node: &SyntheticNode, component: usize) -> CutBranch {
        match node {
            SyntheticNode::Cell(cell) if self.of_cell[*cell] == component => CutBranch::Inside,
            _ => CutBranch::Outside,
        }
    }
}

fn lines(crack: u32, of: &Crack) -> impl Iterator<Item = CrackSegment> {
    let line = move |(segment, ends): (u32, &[Vec2])| CrackSegment {
        id: SegmentId { crack, segment },
        ends: [ends[0], ends[1]],
    };
    (0..).zip(of.points.windows(2)).map(line)
}

impl CrackSegment {
    /// Distance of a point from the line, positive on its left.
    fn distance(&self, p: Vec2) -> f64 {
        let [a, b] = self.ends;
        (b - a).unit().cross(p - a)
    }

    /// Where the way from a to b crosses the line, from 0 to 1.
    fn crosses(&self, a: Vec2, b: Vec2) -> Option<f64> {
        let [a, b] = [a, b].map(|p| self.distance(p));
        // where t rounds to 0 or 1 there is a crossing all the same
        (a > 0.0 && b < 0.0 || a < 0.0 && b > 0.0).then(|| a / (a - b))
    }

    /// True if a point lies on the segment itself.
    fn holds(&self, p: Vec2, near: f64) -> bool {
        let [a, b] = self.ends;
        let along = (b - a).unit().dot(p - a);
        self.distance(p).abs() < near && along > 0.0 && along < (b - a).length()
    }
}

/// The part of a convex polygon on one side of a line.
fn clipped(polygon: &[Vec2], line: &CrackSegment, side: f64) -> Vec<Vec2> {
    let next = polygon.iter().cycle().skip(1);
    let mut part = Vec::new();
    for (&a, &b) in polygon.iter().zip(next) {
        if side * line.distance(a) >= 0.0 {
            part.push(a);
        }
        part.extend(line.crosses(a, b).map(|t| a + (b - a) * t));
    }
    part
}

fn centroid(polygon: &[Vec2]) -> Vec2 {
    let sum = polygon.iter().fold(Vec2::ZERO, |sum, &p| sum + p);
    sum / polygon.len() as f64
}

#[cfg(test)]
mod tests {
    use super::super::recipe::crack;
    use super::*;
    use crate::random::Random;
    use ppum::crack::CrackEnd;
    use ppum::vec2::vec2;

    const BOX: Rect = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));

    /// Straight arms from a point out of the box, in directions that rise.
    fn star(center: Vec2, angles: &[f64]) -> Vec<Crack> {
        let arm = |angle: &f64| {
            let end = center + vec2(angle.cos(), angle.sin()) * 4.0;
            crack(&[center.into(), end.into()], [CrackEnd::Junction, CrackEnd::Mouth])
        };
        angles.iter().map(arm).collect()
    }

    fn all(cracks: &[Crack]) -> SyntheticComponents {
        SyntheticComponents::new(cracks, &(0..cracks.len() as u32).collect::<Vec<_>>(), &BOX)
    }

    /// The components of a star are its sectors, also where one is wider than a half turn.
    #[test]
    fn sectors_of_stars() {
        let mut random = Random(1);
        for round in 0..60 {
            let center = vec2(random.between(-0.4, 0.4), random.between(-0.4, 0.4));
            let mut angles = vec![random.between(-3.0, -2.6)];
            for _ in 0..1 + round % 5 {
                angles.push(angles[angles.len() - 1] + random.between(0.3, 1.1));
            }
            let components = all(&star(center, &angles));
            assert_eq!(components.count(), angles.len(), "{angles:?}");
            let mut seen = BTreeMap::new();
            for _ in 0..200 {
                let p = random.point(&BOX);
                let d = p - center;
                let angle = d.y.atan2(d.x);
                let sector = angles.iter().filter(|&&a| a < angle).count() % angles.len();
                assert_eq!(
                    *seen.entry(sector).or_insert(components.containing(p)),
                    components.containing(p)
                );
            }
            let distinct: std::collections::BTreeSet<_> = seen.values().collect();
            assert_eq!(distinct.len(), seen.len(), "{angles:?}");
        }
    }

    /// A crossing has four, a T three, a comb of two teeth four; a crack that kinks and one apart
    /// from it, three.
    #[test]
    fn components_are_counted() {
        let through = |points: &[[f64; 2]]| crack(points, [CrackEnd::Mouth; 2]);
        let level = through(&[[-3.0, -0.1], [3.0, 0.2]]);
        let tooth = |x: f64| through(&[[x, x * 0.05 + 0.05], [x + 0.2, 3.0]]);
        let kinked = through(&[[-3.0, -0.4], [0.1, -0.2], [0.3, -3.0]]);
        let cases = [
            (vec![level.clone()], 2),
            (vec![level.clone(), through(&[[-0.5, -3.0], [0.7, 3.0]])], 4),
            (vec![level.clone(), tooth(0.1)], 3),
            (vec![level.clone(), tooth(0.1), tooth(-0.5)], 4),
            (vec![level, kinked], 3),
        ];
        for (cracks, count) in cases {
            assert_eq!(all(&cracks).count(), count, "{cracks:?}");
        }
    }
}
