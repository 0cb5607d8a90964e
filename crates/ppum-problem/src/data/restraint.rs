//! Restraints: parts of the boundary where values are given, in the words that reactions are
//! stored with.

use ppum::domain::Domain;
use ppum::edge::Edge;
use ppum::vec2::Vec2;

use super::{BoundaryPart, BoundaryPiece, DomainEdge, OUTLINE};

/// The middle of a restraint by the words of its reaction: of an edge or a part of it, of a circle,
/// of the box around a polygon, the centroid of the sides of a piece. None for words of other
/// programs.
#[must_use]
pub fn restraint_center(on: &str, domain: &Domain, pieces: &[BoundaryPiece]) -> Option<Vec2> {
    let bounds = &domain.bounds;
    if let Some(name) = on.strip_prefix("piece ") {
        let piece = pieces.iter().find(|piece| piece.name == name)?;
        return Some(centroid(
            piece.runs.iter().flat_map(|run| run.edges(&domain.holes[run.hole])),
        ));
    }
    let on_edge = |name: &str, range: Option<[f64; 2]>| {
        let edge = DomainEdge::from_name(name)?;
        let [from, to] = range.unwrap_or(edge.range(bounds));
        Some(edge.point(bounds, 0.5 * from + 0.5 * to))
    };
    match on.split(' ').collect::<Vec<_>>()[..] {
        [OUTLINE] => Some(domain.holes[domain.outline()?].rim_bounds().center()),
        [edge] => on_edge(edge, None),
        [edge, "from", from, "to", to] => {
            on_edge(edge, Some([from.parse().ok()?, to.parse().ok()?]))
        }
        ["hole", hole] => {
            Some(domain.holes.get(hole.parse::<usize>().ok()?)?.rim_bounds().center())
        }
        _ => None,
    }
}

/// The centroid of edges.
fn centroid(sides: impl Iterator<Item = Edge>) -> Vec2 {
    let (mut length, mut moment) = (0.0, Vec2::ZERO);
    for side in sides {
        length += side.length();
        moment = moment + side.centroid() * side.length();
    }
    moment / length
}

/// A part of the boundary as problem files name it.
pub fn restraint_words(on: BoundaryPart, domain: &Domain, pieces: &[BoundaryPiece]) -> String {
    match on {
        BoundaryPart::Edge { edge, .. } if on == BoundaryPart::edge(edge, &domain.bounds) => {
            edge.name().into()
        }
        BoundaryPart::Edge { edge, from, to } => format!("{} from {from} to {to}", edge.name()),
        BoundaryPart::Hole(hole) if domain.outline() == Some(hole) => OUTLINE.into(),
        BoundaryPart::Hole(hole) => format!("hole {hole}"),
        BoundaryPart::Piece(piece) => format!("piece {}", pieces[piece].name),
        BoundaryPart::Sides(_) => on.to_string(),
        BoundaryPart::Crack { .. } => on.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BoundaryRange;
    use ppum::domain::Hole;
    use ppum::vec2::{Rect, vec2};

    /// The words that reactions are stored with lead back to the place.
    #[test]
    fn centres_follow_from_the_words() {
        let circle = Hole::Circle { center: vec2(0.5, 0.25), radius: 0.1 };
        let corners = [vec2(2.0, 0.0), vec2(3.0, 0.0), vec2(3.0, 1.0)];
        let polygon = Hole::polygon(corners.to_vec());
        let bounds = Rect::new(vec2(0.0, -1.0), vec2(4.0, 2.0));
        let outside = [[-1.0, -1.0], [5.0, -1.0], [2.0, 3.0]].map(Vec2::from).to_vec();
        let domain = Domain { bounds, holes: vec![circle, polygon, Hole::outside(outside)] };
        let piece = BoundaryPart::Edge { edge: DomainEdge::Left, from: -0.1 - 0.2, to: 1e-7 };
        for (part, center) in [
            (BoundaryPart::edge(DomainEdge::Top, &bounds), vec2(2.0, 2.0)),
            (BoundaryPart::edge(DomainEdge::Left, &bounds), vec2(0.0, 0.5)),
            (piece, vec2(0.0, 0.5 * (-0.1 - 0.2) + 0.5e-7)),
            (BoundaryPart::Hole(0), vec2(0.5, 0.25)),
            (BoundaryPart::Hole(1), vec2(2.5, 0.5)),
            (BoundaryPart::Hole(2), vec2(2.0, 1.0)),
        ] {
            assert_eq!(
                restraint_center(&restraint_words(part, &domain, &[]), &domain, &[]),
                Some(center),
                "{part}"
            );
        }
        let run = |from, to| BoundaryRange { hole: 1, from, to };
        let pieces = [("a", vec![run(0, 1)]), ("b from 0 to 1", vec![run(1, 2), run(2, 3)])];
        let pieces = pieces.map(|(name, runs)| BoundaryPiece { name: name.into(), runs });
        // of the second, sides as long as 1 and √2
        let middle = vec2(3.0, 0.5) + vec2(-0.5, 0.0) * (2f64.sqrt() / (1.0 + 2f64.sqrt()));
        for (k, center) in [vec2(2.5, 0.0), middle].into_iter().enumerate() {
            let words = restraint_words(BoundaryPart::Piece(k), &domain, &pieces);
            let found = restraint_center(&words, &domain, &pieces).expect("a centre");
            assert!((found - center).length() < 1e-15, "{words}: {found:?}");
        }
        for other in ["", "hole 3", "hole x", "rim", "top from 0 to", "top  from 0 to 1"] {
            assert_eq!(restraint_center(other, &domain, &[]), None, "{other}");
        }
    }
}
