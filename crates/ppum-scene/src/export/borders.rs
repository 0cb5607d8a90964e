//! The segments that no triangle of an exported mesh crosses: outline, rims, cracks, and lines on
//! which a derivative of the field jumps.
//!
//! Arcs become [polylines](super::arcs). Where a weight is continuous and its derivative is not, as
//! for the linear one, stresses jump at the places of a patch where |ξ| or |η| is one of the
//! breakpoints or 1. These lines, and straight interfaces of the material, are segments too; for
//! triangles of higher order those on which stresses have a kink, as for the quadratic weight,
//! since polynomials do not follow it.

use ppum::crack::{Crack, SegmentId};
use ppum::dataset::BoxPartition;
use ppum::domain::{Domain, Hole};
use ppum::edge::Edge;
use ppum::field::Field;
use ppum::line::Line;
use ppum::segment;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;

use super::arcs::{chords, meetings_on_arc};

/// Lines nearer to each other than this part of the domain are one: their difference is rounding.
pub(super) const SAME: f64 = 1e-9;

/// Distance on both sides of a breakpoint at which slopes of a weight are compared, and the part of
/// the largest slope that is a jump.
const BESIDE: f64 = 1e-9;
const JUMP: f64 = 1e-6;

/// A segment, and what is on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct ExportSegment {
    pub(super) ends: [Vec2; 2],
    pub(super) kind: BorderKind,
}

/// The kind of an edge.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct BorderKind {
    /// The segment of a crack.
    pub(super) crack: Option<SegmentId>,
    /// True if derivatives of the field may jump.
    pub(super) kink: bool,
    /// True for lines in patches and of the material.
    pub(super) is_line: bool,
    /// True for lines on which the material changes.
    pub(super) is_interface: bool,
}

/// The lines in patches and of the material that are wanted.
#[derive(Clone, Copy, Debug)]
pub(super) struct LineRequest {
    /// True if quantities jump with derivatives of the field.
    pub(super) jumps: bool,
    /// Degree of the polynomials in triangles.
    pub(super) order: u8,
}

impl LineRequest {
    /// None.
    pub(super) const NONE: Self = Self { jumps: false, order: 1 };
}

impl BorderKind {
    /// True if values of the two sides are kept apart.
    pub(super) fn is_torn(self) -> bool {
        self.crack.is_some() || self.kink
    }

    /// True if the jump belongs to the body, not to the approximation, and no mean makes sense.
    pub(super) fn is_physical(self) -> bool {
        self.crack.is_some() || self.is_interface
    }

    pub(super) fn and(self, other: Self) -> Self {
        Self {
            crack: self.crack.or(other.crack),
            kink: self.kink || other.kink,
            is_line: self.is_line || other.is_line,
            is_interface: self.is_interface || other.is_interface,
        }
    }
}

/// All segments.
pub(super) fn borders(
    field: &Field<'_>,
    domain: &Domain,
    lines: LineRequest,
) -> Vec<ExportSegment> {
    let plain = |ends| ExportSegment { ends, kind: BorderKind::default() };
    let rims = domain.holes.iter().flat_map(Hole::sides);
    let mut all: Vec<_> = domain.bounds.sides().into_iter().chain(rims).map(plain).collect();
    let inner = if lines.jumps || lines.order > 1 {
        inner_lines(field, &domain.bounds, lines)
    } else {
        Vec::new()
    };
    let straight = all.iter().chain(&inner).map(|line| Edge::segment(line.ends));
    let (cracks, reach) = (&field.step.cracks, SAME * longest(&domain.bounds));
    let others: Vec<Edge> = straight.chain(cracks.iter().flat_map(Crack::edges)).collect();
    for (crack, of_crack) in (0..).zip(cracks) {
        for (segment, edge) in (0..).zip(of_crack.edges()) {
            let crack = Some(SegmentId { crack, segment });
            let kind = BorderKind { crack, ..BorderKind::default() };
            let on_arc =
                if edge.is_arc() { meetings_on_arc(&edge, &others, reach) } else { vec![] };
            let points = [vec![edge.from], chords(&edge, &on_arc)].concat();
            let part = |ends: &[Vec2]| ExportSegment { ends: [ends[0], ends[1]], kind };
            all.extend(points.windows(2).map(part));
        }
    }
    all.extend(inner);
    divided(&all, reach)
}

/// Lines in patches and of the material.
fn inner_lines(field: &Field<'_>, bounds: &Rect, lines: LineRequest) -> Vec<ExportSegment> {
    let weight = &field.step.partition.boxes().weight;
    let mut places = jumps(weight, 1);
    let kink = lines.jumps && !places.is_empty();
    if lines.order > 1 {
        places.extend(jumps(weight, 2));
    }
    let line = |kink, is_interface| {
        let kind = BorderKind { crack: None, kink, is_line: true, is_interface };
        move |ends| ExportSegment { ends, kind }
    };
    let in_patches = patch_lines(field, bounds, &places).into_iter().map(line(kink, false));
    in_patches.chain(interfaces(field).into_iter().map(line(lines.jumps, true))).collect()
}

pub(super) fn longest(bounds: &Rect) -> f64 {
    let size = bounds.size();
    size.x.max(size.y)
}

/// Divides segments where they meet, except for lines along axes among themselves: both get one
/// point, and nothing passes between.
fn divided(all: &[ExportSegment], reach: f64) -> Vec<ExportSegment> {
    let mut known = crossings(all);
    let mut inner: Vec<Vec<Vec2>> = vec![Vec::new(); all.len()];
    let is_along_axis = |&ExportSegment { ends: [a, b], kind }: &ExportSegment| {
        kind.is_line && (a.x == b.x || a.y == b.y)
    };
    for i in (0..all.len()).filter(|&i| !is_along_axis(&all[i])) {
        for j in (0..all.len()).filter(|&j| j > i || is_along_axis(&all[j])) {
            for p in meetings(all[i].ends, all[j].ends, reach) {
                let near = known.iter().find(|q| (**q - p).length() <= reach).copied();
                let point = near.unwrap_or(p);
                known.extend(near.is_none().then_some(point));
                inner[i].push(point);
                inner[j].push(point);
            }
        }
    }
    all.iter().zip(inner).flat_map(|(border, points)| parts(*border, points, reach)).collect()
}

/// The parts of a segment between points on it.
fn parts(
    ExportSegment { ends: [a, b], kind }: ExportSegment,
    mut inner: Vec<Vec2>,
    reach: f64,
) -> Vec<ExportSegment> {
    inner.retain(|p| (*p - a).length() > reach && (*p - b).length() > reach);
    inner.sort_by(|p, q| (*p - a).length().total_cmp(&(*q - a).length()));
    inner.dedup();
    let chain: Vec<Vec2> = [a].into_iter().chain(inner).chain([b]).collect();
    chain.windows(2).map(|pair| ExportSegment { ends: [pair[0], pair[1]], kind }).collect()
}

/// Where two segments meet: ends of one on the other, else their crossing, with the coordinate of
/// one that is along an axis.
fn meetings([a, b]: [Vec2; 2], [c, d]: [Vec2; 2], reach: f64) -> Vec<Vec2> {
    let on = |segment: [Vec2; 2], p: &Vec2| segment::distance(segment, *p) <= reach;
    let ends: Vec<Vec2> = [a, b].into_iter().filter(|p| on([c, d], p)).collect();
    let ends: Vec<Vec2> =
        ends.into_iter().chain([c, d].into_iter().filter(|p| on([a, b], p))).collect();
    let (along, across) = (b - a, d - c);
    let turn = along.cross(across);
    let [s, t] = [(c - a).cross(across) / turn, (c - a).cross(along) / turn];
    if !ends.is_empty() || !(0.0..=1.0).contains(&s) || !(0.0..=1.0).contains(&t) {
        return ends;
    }
    let mut p = a + along * s;
    for [from, to] in [[a, b], [c, d]] {
        p.x = if from.x == to.x { from.x } else { p.x };
        p.y = if from.y == to.y { from.y } else { p.y };
    }
    vec![p]
}

/// The points in which upright and level segments cross, with the coordinates of both: computed as
/// crossings of oblique lines they would be beside them by their rounding, and triangles between
/// as thin.
pub(super) fn crossings(borders: &[ExportSegment]) -> Vec<Vec2> {
    let of = |is: fn(&[Vec2; 2]) -> bool| borders.iter().map(|b| b.ends).filter(is);
    let level: Vec<_> = of(|[a, b]| a.y == b.y).collect();
    let mut found = Vec::new();
    for [a, b] in of(|[a, b]| a.x == b.x) {
        let (low, high) = (a.min(b), a.max(b));
        let crosses = |[c, d]: &&[Vec2; 2]| {
            let within = c.min(*d).x <= a.x && a.x <= c.max(*d).x;
            within && low.y <= c.y && c.y <= high.y
        };
        found.extend(level.iter().filter(crosses).map(|[c, _]| vec2(a.x, c.y)));
    }
    found
}

/// Coordinates along an axis that are apart from each other by more than rounding; others are moved
/// to them.
struct Snap(Vec<f64>);

impl Snap {
    /// Known coordinates stay, those of the box, of corners of holes and of points of cracks; of
    /// others that are nearly equal the first stays.
    fn new(mut known: Vec<f64>, mut others: Vec<f64>, reach: f64) -> Self {
        known.sort_by(f64::total_cmp);
        known.dedup();
        let near = Self(known.clone());
        others.retain(|&value| (near.nearest(value) - value).abs() > reach);
        others.sort_by(f64::total_cmp);
        others.dedup_by(|value, kept| *value - *kept <= reach);
        known.extend(others);
        known.sort_by(f64::total_cmp);
        Self(known)
    }

    fn nearest(&self, value: f64) -> f64 {
        let at = self.0.partition_point(|&known| known < value);
        let beside = [at.checked_sub(1), Some(at)].into_iter().flatten();
        let beside = beside.filter_map(|k| self.0.get(k).copied());
        let away = |known: &f64| (known - value).abs();
        beside.min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(value)
    }
}

/// Points of the box, of holes and cracks.
fn known_points(field: &Field<'_>) -> Vec<Vec2> {
    let Rect { min, max } = field.domain.bounds;
    let cracks = field.step.cracks.iter().flat_map(|crack| crack.points.iter().copied());
    let corners = field.domain.holes.iter().flat_map(Hole::sides).map(|[a, _]| a);
    [min, max].into_iter().chain(cracks).chain(corners).collect()
}

/// A part of a line x = `at` (or y = `at`).
#[derive(Clone, Copy)]
struct AxisStretch {
    at: f64,
    from: f64,
    to: f64,
}

/// Lines at these places of patches, each once.
fn patch_lines(field: &Field<'_>, bounds: &Rect, places: &[f64]) -> Vec<[Vec2; 2]> {
    let (partition, reach) = (field.step.partition.boxes(), SAME * longest(bounds));
    let known = known_points(field);
    let lines = [0, 1].map(|axis| stretches(partition, places, bounds, axis));
    let snaps = [0, 1].map(|axis| {
        let at = lines[axis].iter().map(|line| line.at);
        let ends = lines[1 - axis].iter().flat_map(|line| [line.from, line.to]);
        Snap::new(known.iter().map(|p| along(*p, axis)).collect(), at.chain(ends).collect(), reach)
    });
    let [upright, level] = [0, 1].map(|axis| {
        let snapped = lines[axis].iter().map(|line| AxisStretch {
            at: snaps[axis].nearest(line.at),
            from: snaps[1 - axis].nearest(line.from),
            to: snaps[1 - axis].nearest(line.to),
        });
        joined(snapped.collect())
    });
    let upright = upright.into_iter().map(|s| [vec2(s.at, s.from), vec2(s.at, s.to)]);
    let level = level.into_iter().map(|s| [vec2(s.from, s.at), vec2(s.to, s.at)]);
    upright.chain(level).collect()
}

fn along(p: Vec2, axis: usize) -> f64 {
    if axis == 0 { p.x } else { p.y }
}

/// The lines across an axis of all patches, within the box.
fn stretches(
    partition: &BoxPartition,
    places: &[f64],
    bounds: &Rect,
    axis: usize,
) -> Vec<AxisStretch> {
    let of = along;
    let clip = |value: f64, axis| value.clamp(of(bounds.min, axis), of(bounds.max, axis));
    let mut all = Vec::new();
    for (&center, &half) in partition.center.iter().zip(&partition.half) {
        let [low, high] =
            [-1.0, 1.0].map(|end| clip(of(center, 1 - axis) + end * of(half, 1 - axis), 1 - axis));
        for &t in places {
            let at = of(center, axis) + t * of(half, axis);
            if at == clip(at, axis) && low < high {
                all.push(AxisStretch { at, from: low, to: high });
            }
        }
    }
    all
}

/// Stretches of one line that overlap or touch become one.
fn joined(mut all: Vec<AxisStretch>) -> Vec<AxisStretch> {
    all.retain(|stretch| stretch.from < stretch.to);
    all.sort_by(|a, b| a.at.total_cmp(&b.at).then(a.from.total_cmp(&b.from)));
    let mut found: Vec<AxisStretch> = Vec::new();
    for stretch in all {
        match found.last_mut() {
            Some(last) if last.at == stretch.at && stretch.from <= last.to => {
                last.to = last.to.max(stretch.to);
            }
            _ => found.push(stretch),
        }
    }
    found
}

/// The places ξ in \[−1, 1\] at which a derivative of a weight jumps, the first or the second.
fn jumps(weight: &WeightFunction, derivative: usize) -> Vec<f64> {
    let slope = |t: f64| weight.spline(t)[derivative];
    let places: Vec<f64> = weight.breakpoints().iter().copied().chain([0.0, 1.0]).collect();
    let sides = |t: f64| [slope(t - BESIDE), if t < 1.0 { slope(t + BESIDE) } else { 0.0 }];
    let largest = places.iter().flat_map(|&t| sides(t)).fold(0.0, |a: f64, b| a.max(b.abs()));
    let jumps = |t: &f64| {
        let [a, b] = sides(*t);
        (a - b).abs() > JUMP * largest
    };
    let mut found: Vec<f64> = places.into_iter().filter(jumps).flat_map(|t| [-t, t]).collect();
    found.sort_by(f64::total_cmp);
    found.dedup();
    found
}

/// Straight interfaces of the material, within the box.
fn interfaces(field: &Field<'_>) -> Vec<[Vec2; 2]> {
    let formulas = field.equation.constants().filter(|(_, e)| e.constant().is_none());
    let lines = formulas.flat_map(|(_, e)| e.formula().kinks()).filter_map(|kink| kink.line());
    let (center, half) = (field.domain.bounds.center(), field.domain.bounds.size() * 0.5);
    let (around, everywhere) = (Rect::around(Vec2::ZERO, half), [f64::NEG_INFINITY, f64::INFINITY]);
    let ends =
        lines.filter_map(|form| Line::of_equation(form, center).clipped(&around, everywhere));
    ends.filter(|[a, b]| a != b).map(|ends| ends.map(|p| center + p)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_jump_where_weights_have_kinks() {
        assert_eq!(jumps(&WeightFunction::Linear, 1), [-1.0, -0.0, 1.0]);
        assert!(jumps(&WeightFunction::Quadratic, 1).is_empty());
        assert!(jumps(&WeightFunction::Cubic, 1).is_empty());
        assert_eq!(jumps(&WeightFunction::Quadratic, 2), [-1.0, -1.0 / 3.0, 1.0 / 3.0, 1.0]);
        assert!(jumps(&WeightFunction::Cubic, 2).is_empty());
        let scope = ppum::formula::Scope::new(&["t"]).unwrap();
        let bent = WeightFunction::formula("max(1 - 2*t, (1 - t)/4)", &scope).unwrap();
        let found = jumps(&bent, 1);
        assert_eq!(found.len(), 5, "{found:?}");
        assert!((found[3] - 3.0 / 7.0).abs() < 1e-12, "{found:?}");
    }
}
