//! The parts of the boundary of a body in a text: found by the pointer, with their conditions.

use ppum::crack::Side;
use ppum::domain::{Domain, Hole};
use ppum::edge::Edge;
use ppum::vec2::Vec2;
use ppum_problem::{BodyText, BoundaryPart, BoundaryRange, DomainEdge};
use ppum_scene::location::number;

use super::preview::MOST;

/// A part of the boundary that conditions can be on.
#[derive(Clone, Debug, PartialEq)]
pub struct BorderPart {
    /// The part as a text names it: `"left"`, `{ hole = 0 }`.
    pub on: String,
    /// Line and column of its condition in the text, from 1; none of a part that is free.
    pub condition: Option<[usize; 2]>,
    /// Its edges, one after the other.
    pub edges: Vec<Edge>,
    /// The face of a crack.
    face: Option<Side>,
}

/// The parts of the boundary in a text: those with conditions, then all others, smaller ones first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Border {
    parts: Vec<BorderPart>,
    load_key: &'static str,
}

impl Border {
    /// That of a text.
    #[must_use]
    pub fn new(text: &BodyText) -> Self {
        let part = |on: String, condition, part| {
            let (edges, face) = edges(text, part);
            BorderPart { on, condition, edges, face }
        };
        let given = text.conditions.iter();
        let given = given.map(|one| part(one.on.clone(), Some(one.at), one.part));
        let free = free_parts(text).into_iter().map(|(on, place)| part(on, None, place));
        Self { parts: given.chain(free).collect(), load_key: text.load_key }
    }

    /// The part nearest to a point within a distance: of those that coincide one with a condition,
    /// else the smallest.
    #[must_use]
    pub fn part_at(&self, at: Vec2, reach: f64) -> Option<&BorderPart> {
        let mut nearest = (reach, None);
        for part in self.parts.iter().filter(|part| part.has_side_of(at)) {
            let distance = part.distance(at);
            if distance < nearest.0 - ROUNDING * reach {
                nearest = (distance, Some(part));
            }
        }
        nearest.1
    }

    /// A text with a condition of no effect on a part, to be edited, and the place of its load.
    #[must_use]
    pub fn with_condition(&self, text: &str, part: &BorderPart) -> (String, [usize; 2]) {
        let zero = if self.load_key == "flux" { "0" } else { "[0, 0]" };
        let key = format!("{} = ", self.load_key);
        let head = format!("{}\n\n[[boundary]]\non = {}\n", text.trim_end(), part.on);
        let at = [head.lines().count() + 1, key.len() + 1];
        (format!("{head}{key}{zero}\n"), at)
    }
}

/// Distances that differ by less are equal \[parts of the reach\].
const ROUNDING: f64 = 1e-6;

impl BorderPart {
    fn distance(&self, at: Vec2) -> f64 {
        self.edges.iter().map(|edge| edge.distance(at)).fold(f64::INFINITY, f64::min)
    }

    /// True unless this is the face of the other side of a crack.
    fn has_side_of(&self, at: Vec2) -> bool {
        let Some(face) = self.face else { return true };
        let all = self.edges.iter().map(|edge| (edge.distance(at), edge));
        let nearest = all.min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.is_none_or(|(_, edge)| (edge.side(at) >= 0.0) == (face == Side::Above))
    }

    /// Names the part, its ends, and what a click does.
    #[must_use]
    pub fn description(&self) -> String {
        let point = |p: Vec2| format!("({}, {})", number(p.x, 5), number(p.y, 5));
        let ends = self.edges.first().zip(self.edges.last());
        let ends = ends.map(|(first, last)| (first.from, last.to));
        let interval = match ends {
            Some((from, to)) if from != to => format!("from {} to {}", point(from), point(to)),
            _ => "closed".to_owned(),
        };
        let click = match self.condition {
            Some([line, _]) => format!("Click: go to its condition, line {line}"),
            None => "Free; click: write a [[boundary]] for it".to_owned(),
        };
        format!("on = {}\n{interval}\n{click}", self.on)
    }
}

/// The parts that a text can name, smaller ones first.
fn free_parts(text: &BodyText) -> Vec<(String, BoundaryPart)> {
    let domain = text.body.domain();
    let outline = domain.outline();
    // parts of pieces have conditions, and no names of their own
    let is_own = |k: &usize| !text.conditions.iter().any(|c| c.part == BoundaryPart::Piece(*k));
    let pieces = text.body.pieces().iter().enumerate().filter(|(k, _)| is_own(k));
    let pieces =
        pieces.map(|(k, p)| (format!("{{ piece = {:?} }}", p.name), BoundaryPart::Piece(k)));
    let edges = DomainEdge::ALL.into_iter().filter(|_| outline.is_none());
    let edges = edges.map(|e| (format!("{:?}", e.name()), BoundaryPart::edge(e, &domain.bounds)));
    let holes = (0..domain.holes.len().min(MOST)).map(|k| match outline == Some(k) {
        true => ("\"outline\"".to_owned(), BoundaryPart::Hole(k)),
        false => (format!("{{ hole = {k} }}"), BoundaryPart::Hole(k)),
    });
    let faces = (0..text.body.cracks().len().min(MOST)).flat_map(|crack| {
        [Side::Above, Side::Below].map(|side| {
            let on = format!("{{ crack = {crack}, face = \"{}\" }}", side.name());
            (on, BoundaryPart::Crack { crack, face: Some(side) })
        })
    });
    pieces.chain(edges).chain(holes).chain(faces).collect()
}

/// The edges of a part, and the face of a crack that it is; none of a part that is not there.
fn edges(text: &BodyText, part: BoundaryPart) -> (Vec<Edge>, Option<Side>) {
    let Domain { bounds, holes } = text.body.domain();
    let run = |run: &BoundaryRange| {
        let sides = holes.get(run.hole).map(Hole::rim_edges).unwrap_or_default().into_iter();
        sides.take(run.to).skip(run.from)
    };
    let edges = match part {
        BoundaryPart::Edge { edge, from, to } => {
            vec![Edge::segment([from, to].map(|s| edge.point(bounds, s)))]
        }
        BoundaryPart::Hole(hole) => holes.get(hole).map(Hole::rim_edges).unwrap_or_default(),
        BoundaryPart::Sides(sides) => run(&sides).collect(),
        BoundaryPart::Piece(piece) => {
            let piece = text.body.pieces().get(piece);
            piece.map(|piece| piece.runs.iter().flat_map(run).collect()).unwrap_or_default()
        }
        BoundaryPart::Crack { crack, face } => {
            let crack = text.body.cracks().get(crack);
            return (crack.map(|crack| crack.edges().collect()).unwrap_or_default(), face);
        }
    };
    (edges, None)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use ppum::vec2::vec2;
    use ppum_problem::Problem;

    use super::*;

    fn border(text: &str) -> Border {
        Border::new(&Problem::body_of(text, Path::new("")).expect("a body"))
    }

    const BOX: &str = "[domain]\nmin = [0, 0]\nmax = [4, 2]\n[[hole]]\ncenter = [3, 1]\n\
                       radius = 0.5\n[[crack]]\npoints = [[1, 1], [2, 1]]\n";

    fn on(border: &Border, x: f64, y: f64) -> Option<&str> {
        border.part_at(vec2(x, y), 0.1).map(|part| &*part.on)
    }

    #[test]
    fn each_part_is_found_at_its_place() {
        let border = border(BOX);
        for (x, y, want) in [
            (0.05, 1.0, "\"left\""),
            (3.95, 1.0, "\"right\""),
            (2.0, -0.05, "\"bottom\""),
            (2.0, 2.05, "\"top\""),
            (3.0, 1.45, "{ hole = 0 }"),
            (1.5, 1.05, "{ crack = 0, face = \"above\" }"),
            (1.5, 0.95, "{ crack = 0, face = \"below\" }"),
        ] {
            assert_eq!(on(&border, x, y), Some(want));
        }
        assert_eq!(on(&border, 1.5, 1.5), None);
    }

    /// A condition on a part of an edge, or on both faces, is found in place of what is around it;
    /// the rest of the edge is free.
    #[test]
    fn conditions_come_first() {
        let text = format!(
            "{BOX}[[boundary]]\non = {{ edge = \"top\", to = 1 }}\n[[boundary]]\non = {{ crack = 0 }}\n"
        );
        let border = border(&text);
        let line = |x, y| border.part_at(vec2(x, y), 0.1).and_then(|part| part.condition);
        assert_eq!(line(0.5, 2.0), Some([9, 1]));
        assert_eq!(line(2.0, 2.0), None);
        assert_eq!([line(1.5, 1.05), line(1.5, 0.95)], [Some([11, 1]); 2]);
        let part = border.part_at(vec2(0.5, 2.0), 0.1).expect("a part");
        assert!(part.description().contains("from (0, 2) to (1, 2)"), "{}", part.description());
    }

    /// Pieces with names, then the outline; the text that is written can be read again.
    #[test]
    fn a_free_part_gets_a_condition() {
        let text = "[domain.outline]\npath = [\n  { points = [[0, 0], [3, 0]], name = \"foot\" },\n  \
                    { points = [[3, 0], [3, 3], [0, 0]] },\n]\n";
        let free = border(text);
        assert_eq!(on(&free, 3.0, 1.0), Some("\"outline\""));
        assert_eq!(on(&free, 1.0, 0.0), Some("{ piece = \"foot\" }"));
        let foot = free.part_at(vec2(1.0, 0.0), 0.1).expect("a part");
        let (written, [line, column]) = free.with_condition(text, foot);
        let at = written.lines().nth(line - 1).expect("a line");
        assert_eq!((at, &at[column - 1..]), ("traction = [0, 0]", "[0, 0]"));
        let found = border(&written);
        let foot = found.part_at(vec2(1.0, 0.0), 0.1).expect("a part");
        assert_eq!(foot.condition, Some([line - 2, 1]));
    }
}
