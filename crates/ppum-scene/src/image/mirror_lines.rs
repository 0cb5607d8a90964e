//! The lines at which a body is mirrored, and its reflections.

use std::convert::Infallible;

use ppum::crack::Crack;
use ppum::dataset::Dataset;
use ppum::quantity::{Reflection, ValueChange};
use ppum::vec2::Rect;

use crate::request::mirror::{Mirror, MirrorEdge, MirrorError};

/// The lines at which a body is mirrored.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MirrorLines {
    /// x = a and y = b, each with whether the field is antisymmetric to it.
    lines: [Option<(f64, bool)>; 2],
}

impl MirrorLines {
    /// Returns the lines of a dataset that a request asks for; none if it asks for no whole.
    ///
    /// # Errors
    /// A dataset that does not know its lines.
    pub fn of(mirror: Option<&Mirror>, dataset: &Dataset) -> Result<Self, MirrorError> {
        let Some(mirror) = mirror else { return Ok(Self::default()) };
        Ok(Self::new(&mirror.edges(dataset)?, &dataset.domain.body_bounds()))
    }

    /// The lines through edges of a box.
    #[must_use]
    pub fn new(edges: &[MirrorEdge], bounds: &Rect) -> Self {
        let mut lines = [None; 2];
        for MirrorEdge { edge, is_odd } in edges {
            lines[edge.axis()] = Some((edge.line(bounds), *is_odd));
        }
        Self { lines }
    }

    /// The lines x = a and y = b.
    #[must_use]
    pub fn at(&self) -> [Option<f64>; 2] {
        self.lines.map(|line| line.map(|(at, _)| at))
    }

    /// The reflections of the body: one for a half, three for a quarter.
    pub fn reflections(&self) -> impl Iterator<Item = Reflection> {
        let [x, y] = self.lines;
        let of = |x: Option<(f64, bool)>, y: Option<(f64, bool)>| Reflection {
            lines: [x, y].map(|line| line.map(|(at, _)| at)),
            is_odd: [x, y].into_iter().flatten().filter(|(_, is_odd)| *is_odd).count() == 1,
        };
        let [only_x, only_y] = [x.map(|_| of(x, None)), y.map(|_| of(None, y))];
        let both = x.and(y).map(|_| of(x, y));
        [only_x, only_y, both].into_iter().flatten()
    }

    /// The box of the whole.
    #[must_use]
    pub fn whole(&self, bounds: Rect) -> Rect {
        let Ok(all) = self.whole_of(|_| Ok::<_, Infallible>(bounds));
        all
    }

    /// The box of the deformed whole; `bounds` gives that of the body by the sign of its factor.
    ///
    /// # Errors
    /// Those of `bounds`.
    pub fn whole_of<E>(&self, bounds: impl Fn(f64) -> Result<Rect, E>) -> Result<Rect, E> {
        self.reflections().try_fold(bounds(1.0)?, |all, reflection| {
            let Rect { min, max } = bounds(reflection.sign())?;
            let [a, b] = [min, max].map(|p| reflection.point(p));
            Ok(all.union(&Rect::new(a.min(b), a.max(b))))
        })
    }

    /// The cracks of the whole, each once: those on a line are their own reflections.
    #[must_use]
    pub fn cracks(&self, cracks: &[Crack]) -> Vec<Crack> {
        let mut all = cracks.to_vec();
        for reflection in self.reflections() {
            for crack in cracks.iter().map(|crack| reflection.crack(crack)) {
                if !all.contains(&crack) {
                    all.push(crack);
                }
            }
        }
        all
    }
}

/// −1 where values of an image fall as those of the body rise, else 1.
#[must_use]
pub fn slope_sign(change: ValueChange) -> f64 {
    match change {
        ValueChange::Negated | ValueChange::Turned { is_reversed: true, .. } => -1.0,
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::vec2;

    /// A quarter is mirrored thrice; the field is antisymmetric where one of its symmetries is.
    #[test]
    fn a_quarter_makes_a_whole() {
        let bounds = Rect::new(vec2(0.5, -1.0), vec2(2.0, 3.0));
        let lines = |text: &str| match text.parse() {
            Ok(Mirror::Edges(edges)) => MirrorLines::new(&edges, &bounds),
            _ => panic!("edges"),
        };
        let quarter = lines("left,bottom:antisymmetric");
        let odd: Vec<bool> = quarter.reflections().map(|reflection| reflection.is_odd).collect();
        assert_eq!(odd, [false, true, true]);
        let twice = lines("left:antisymmetric,bottom:antisymmetric");
        assert_eq!(twice.reflections().map(|r| r.is_odd).collect::<Vec<_>>(), [true, true, false]);
        assert_eq!(quarter.whole(bounds), Rect::new(vec2(-1.0, -5.0), vec2(2.0, 3.0)));
        assert_eq!(lines("top").whole(bounds), Rect::new(vec2(0.5, -1.0), vec2(2.0, 7.0)));
        assert_eq!(MirrorLines::default().whole(bounds), bounds);
    }
}
