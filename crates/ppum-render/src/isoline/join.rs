//! Segments joined to lines.

use std::collections::BTreeMap;

use ppum::vec2::Vec2;

use super::Isoline;
use super::march::LineSegment;

/// Ends on sides that two squares do not have in common, as where one of them is cut finer, are
/// joined up to this distance, pixels.
const NEAR: f64 = 0.02;

/// A side by the bits of its ends.
type EdgeKey = [u64; 4];

/// The lines of segments, level by level, each from its first segment on.
pub(super) fn lines(segments: Vec<LineSegment>, levels: &[f64], pixel: f64) -> Vec<Isoline> {
    let mut of_level: Vec<Vec<LineSegment>> = levels.iter().map(|_| Vec::new()).collect();
    for segment in segments {
        of_level[segment.level].push(segment);
    }
    let all = of_level.iter().zip(levels);
    all.flat_map(|(segments, &level)| of_one_level(segments, level, NEAR * pixel)).collect()
}

fn of_one_level(segments: &[LineSegment], level: f64, near: f64) -> Vec<Isoline> {
    let next = links(segments, near);
    let mut has_previous = vec![false; segments.len()];
    next.iter().flatten().for_each(|&k| has_previous[k] = true);
    let mut used = vec![false; segments.len()];
    // open lines from their beginnings, then loops
    let open = (0..segments.len()).filter(|&k| !has_previous[k]);
    let starts: Vec<usize> = open.chain(0..segments.len()).collect();
    let mut lines = Vec::new();
    for start in starts {
        if used[start] {
            continue;
        }
        let (mut points, mut at) = (vec![segments[start].points[0]], Some(start));
        while let Some(k) = at.filter(|&k| !used[k]) {
            used[k] = true;
            points.extend(&segments[k].points[1..]);
            at = next[k];
        }
        let closed = at == Some(start);
        if closed {
            points.pop();
        }
        lines.push(Isoline { level, points, closed });
    }
    lines
}

/// For each segment the one that goes on at its end.
fn links(segments: &[LineSegment], near: f64) -> Vec<Option<usize>> {
    let mut next = vec![None; segments.len()];
    let mut begins: BTreeMap<EdgeKey, Vec<usize>> = BTreeMap::new();
    for (k, segment) in segments.iter().enumerate().filter(|(_, s)| !s.ends[0].is_final) {
        begins.entry(key(segment.ends[0].side)).or_default().push(k);
    }
    let mut loose = Vec::new();
    for (k, segment) in segments.iter().enumerate().filter(|(_, s)| !s.ends[1].is_final) {
        match begins.get_mut(&key(segment.ends[1].side)).and_then(Vec::pop) {
            Some(begin) => next[k] = Some(begin),
            None => loose.push(k),
        }
    }
    let begins: Vec<usize> = begins.into_values().flatten().collect();
    for [end, begin] in nearest(segments, &loose, &begins, near) {
        next[end] = Some(begin);
    }
    next
}

/// Pairs of ends and beginnings within a distance, nearest first, each used once.
fn nearest(
    segments: &[LineSegment],
    ends: &[usize],
    begins: &[usize],
    near: f64,
) -> Vec<[usize; 2]> {
    let begin_at = |k: usize| segments[k].points[0];
    let mut sorted = begins.to_vec();
    sorted.sort_by(|&a, &b| begin_at(a).x.total_cmp(&begin_at(b).x).then(a.cmp(&b)));
    let mut pairs: Vec<(f64, [usize; 2])> = Vec::new();
    for &end in ends {
        let p = last(&segments[end].points);
        let first = sorted.partition_point(|&k| begin_at(k).x < p.x - near);
        let close = sorted[first..].iter().take_while(|&&k| begin_at(k).x <= p.x + near);
        let apart = close.map(|&k| ((begin_at(k) - p).length(), [end, k]));
        pairs.extend(apart.filter(|(distance, [end, k])| *distance <= near && end != k));
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut used = [vec![false; segments.len()], vec![false; segments.len()]];
    let mut take = |(_, [end, begin]): &(f64, [usize; 2])| {
        let is_free = !used[0][*end] && !used[1][*begin];
        if is_free {
            (used[0][*end], used[1][*begin]) = (true, true);
        }
        is_free
    };
    pairs.retain(|pair| take(pair));
    pairs.into_iter().map(|(_, pair)| pair).collect()
}

fn last(points: &[Vec2]) -> Vec2 {
    points[points.len() - 1]
}

fn key([a, b]: [Vec2; 2]) -> EdgeKey {
    // +0 and −0 are one place
    [a.x, a.y, b.x, b.y].map(|v| (v + 0.0).to_bits())
}
