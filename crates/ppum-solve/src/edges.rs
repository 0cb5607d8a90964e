//! Joints of edges of rims and cracks without a corner.

use ppum::crack::Crack;
use ppum::edge::Edge;
use ppum::vec2::Vec2;

/// Angle between tangents at a joint with an arc up to which it is no corner. Points of files are
/// meant to 10⁻⁹ of a body, so the tangents of arcs of a thousandth of it to 10⁻⁶. A corner of the
/// turn τ has r^λ with λ = 1 − 2τ/π, which nothing tells from a smooth field then.
const SMOOTH: f64 = 1e-6;

/// True if an edge goes on in another one without a corner: if one of them is an arc, and their
/// tangents agree. Segments that go straight on have a vertex between them.
pub(crate) fn is_smooth(before: &Edge, after: &Edge) -> bool {
    let [end, start] = [before.end_tangents()[1], after.end_tangents()[0]];
    (before.is_arc() || after.is_arc()) && (end - start).length() <= SMOOTH
}

/// The inner vertices of a crack at which it has a corner.
pub(crate) fn kinks(crack: &Crack) -> impl Iterator<Item = Vec2> + '_ {
    let is_kink = |k: &usize| !is_smooth(&crack.edge(*k - 1), &crack.edge(*k));
    (1..crack.points.len() - 1).filter(is_kink).map(|k| crack.points[k])
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::crack::CrackEnd;
    use ppum::domain::Hole;
    use ppum::vec2::{Rect, vec2};
    use ppum_testkit::random::Random;
    use std::f64::consts::TAU;

    const BOX: Rect = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));

    fn arc(random: &mut Random) -> Edge {
        let bulge = (0.25 * random.between(-6.0, 6.0)).tan();
        Edge { from: random.point(&BOX), to: random.point(&BOX), bulge }
    }

    /// Parts of an arc, and an arc with its tangent, join smoothly; with other tangents, and
    /// segments among themselves, they have corners. Reversed cracks have the same ones.
    #[test]
    fn joints_with_equal_tangents_are_no_kinks() {
        let mut random = Random(13);
        for _ in 0..200 {
            let arc = arc(&mut random);
            let parts = [0.0, 0.2, 0.7, 1.0];
            let on = arc.to + arc.end_tangents()[1] * 0.3;
            let off = on + arc.end_tangents()[1].left() * random.between(1e-5, 0.1);
            let mut points: Vec<Vec2> = parts.iter().map(|part| arc.at(*part)).collect();
            points.extend([on, off]);
            let mut bulges: Vec<f64> =
                parts.windows(2).map(|p| arc.part([p[0], p[1]]).bulge).collect();
            bulges.extend([0.0; 2]);
            let crack = Crack { points, bulges, ends: [CrackEnd::Tip; 2] };
            assert_eq!(kinks(&crack).collect::<Vec<_>>(), [on], "{crack:?}");
            assert_eq!(kinks(&crack.reversed()).collect::<Vec<_>>(), [on]);
        }
        let straight =
            Crack::polyline([0.0, 1.0, 2.0].map(|x| vec2(x, 0.0)).to_vec(), [CrackEnd::Tip; 2]);
        assert_eq!(kinks(&straight).count(), 1);
    }

    #[test]
    fn circles_are_two_arcs() {
        let edges = Hole::Circle { center: vec2(0.3, 0.1), radius: 0.4 }.rim_edges();
        let length: f64 = edges.iter().map(Edge::length).sum();
        assert!((length - 0.4 * TAU).abs() < 1e-14);
        assert!(is_smooth(&edges[0], &edges[1]) && is_smooth(&edges[1], &edges[0]));
        assert_eq!([edges[0].to, edges[1].to], [edges[1].from, edges[0].from]);
    }
}
