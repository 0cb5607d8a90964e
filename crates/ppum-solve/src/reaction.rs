//! What supports exert on the plate: their resultant force and moment.
//!
//! ```text
//! R_k = ∫ m_k,i t_i     t_i = (σ(u) n)_i − β (u_i − g_i)     over the components i that are held
//! ```
//!
//! m_k are the rigid motions. With Nitsche's own β the system, tested with a rigid motion, says just
//! that the reactions balance the loads: what differs is rounding, however coarse the cells.

use crate::block_matrix::BlockMatrix;
use crate::cell::{CellFunctions, CellSystem};
use crate::problem::{BorderPart, Edge, Problem};
use crate::rigid::{MOTIONS, PerMotion, RigidMotions};
use ppum::dataset::Reaction;
use ppum::domain::Domain;
use ppum::vec2::Vec2;

/// The motions that reactions do work on: the moment is about the centre of the box.
pub(crate) fn motions(problem: &Problem) -> RigidMotions {
    RigidMotions::new(problem.domain.bounds.center(), 1.0, problem.components())
}

/// Integrals over the border of a cell where one condition gives values, for every rigid motion m.
#[derive(Clone, Debug)]
pub(crate) struct Support {
    /// Number of the condition.
    pub(crate) condition: usize,
    /// ∫ m_i (σ(N) n)_i, one number a cell's unknown.
    traction: [Vec<f64>; MOTIONS],
    /// ∫ m_i N_i
    value: [Vec<f64>; MOTIONS],
    /// ∫ m_i g_i
    given: PerMotion,
}

impl Support {
    pub(crate) fn new(condition: usize, unknowns: usize) -> Self {
        let zero = || std::array::from_fn(|_| vec![0.0; unknowns]);
        Self { condition, traction: zero(), value: zero(), given: [0.0; MOTIONS] }
    }

    /// Adds the values that motion `k` takes at points, times the roots of their weights: rows of
    /// tractions and values are functions at these points, times the roots.
    pub(crate) fn add(
        &mut self,
        k: usize,
        motion: &[f64],
        (tractions, traction_rows): Rows<'_>,
        (values, value_rows): Rows<'_>,
    ) {
        for (q, m) in motion.iter().enumerate() {
            for (a, &row) in traction_rows.iter().enumerate() {
                self.traction[k][row] += m * tractions[(a, q)];
            }
            for (a, &row) in value_rows.iter().enumerate() {
                self.value[k][row] += m * values[(a, q)];
            }
        }
    }

    /// Adds the data that are given at points where motion `k` has these values, all times the roots.
    pub(crate) fn give(&mut self, k: usize, motion: &[f64], given: &[f64]) {
        self.given[k] += motion.iter().zip(given).map(|(m, g)| m * g).sum::<f64>();
    }

    /// The reaction as a function of the cell's unknowns, now that β is known.
    pub(crate) fn finish(self, beta: f64) -> CellReaction {
        let (mut work, value) = (self.traction, self.value);
        for (work, value) in work.iter_mut().zip(&value) {
            work.iter_mut().zip(value).for_each(|(work, value)| *work -= beta * value);
        }
        CellReaction { condition: self.condition, work, given: self.given.map(|g| beta * g) }
    }
}

/// Functions at points, and the cell's unknown of each row.
type Rows<'a> = (faer::MatRef<'a, f64>, &'a [usize]);

/// R_k = work_k · u + given_k, u the cell's unknowns.
#[derive(Clone, Debug)]
pub(crate) struct CellReaction {
    condition: usize,
    work: [Vec<f64>; MOTIONS],
    given: PerMotion,
}

/// The reactions of all cells, in the order of the cells.
#[derive(Default)]
pub(crate) struct Reactions(Vec<(CellFunctions, Vec<CellReaction>)>);

impl Reactions {
    /// Adds those of the next cell.
    pub(crate) fn push(&mut self, part: CellSystem) {
        if !part.reactions.is_empty() {
            self.0.push((part.functions, part.reactions));
        }
    }

    /// The reactions of a solution in the order of the matrix, one a condition that gives values.
    pub(crate) fn of(
        &self,
        problem: &Problem,
        matrix: &BlockMatrix,
        solution: &[f64],
    ) -> Vec<Reaction> {
        let components = problem.components();
        let mut sums = vec![[0.0; MOTIONS]; problem.boundary.len()];
        for (functions, parts) in &self.0 {
            let unknowns = functions.take_from(matrix, components, solution);
            for part in parts {
                for (k, sum) in sums[part.condition].iter_mut().enumerate() {
                    let terms = part.work[k].iter().zip(&unknowns).map(|(w, u)| w * u);
                    *sum += terms.sum::<f64>() + part.given[k];
                }
            }
        }
        let holding = problem.boundary.iter().zip(sums).filter(|(c, _)| c.held().contains(&true));
        let reaction =
            |(condition, sum): (&crate::problem::BoundaryCondition, PerMotion)| Reaction {
                on: words(condition.on, problem),
                held: condition.held()[..components].to_vec(),
                force: sum[..components].to_vec(),
                moment: sum[2],
            };
        holding.map(reaction).collect()
    }
}

/// The middle of a support by the words of its reaction: of an edge or a piece of it, of a circle, of the box
/// around a polygon. None for words of other programs.
#[must_use]
pub fn center(on: &str, domain: &Domain) -> Option<Vec2> {
    let bounds = &domain.bounds;
    let on_edge = |name: &str, range: Option<[f64; 2]>| {
        let edge = Edge::from_name(name)?;
        let [from, to] = range.unwrap_or(edge.range(bounds));
        Some(edge.point(bounds, 0.5 * from + 0.5 * to))
    };
    match on.split(' ').collect::<Vec<_>>()[..] {
        [edge] => on_edge(edge, None),
        [edge, "from", from, "to", to] => {
            on_edge(edge, Some([from.parse().ok()?, to.parse().ok()?]))
        }
        ["hole", hole] => Some(domain.holes.get(hole.parse::<usize>().ok()?)?.bounds().center()),
        _ => None,
    }
}

/// A part of the border as problem files name it.
fn words(on: BorderPart, problem: &Problem) -> String {
    match on {
        BorderPart::Edge { edge, .. } if on == BorderPart::edge(edge, &problem.domain.bounds) => {
            edge.name().into()
        }
        BorderPart::Edge { edge, from, to } => format!("{} from {from} to {to}", edge.name()),
        BorderPart::Hole(hole) => format!("hole {hole}"),
        BorderPart::Crack { .. } => on.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::domain::Hole;
    use ppum::vec2::{Rect, vec2};

    /// The words that reactions are stored with lead back to the place.
    #[test]
    fn centres_follow_from_the_words() {
        let circle = Hole::Circle { center: vec2(0.5, 0.25), radius: 0.1 };
        let corners = [vec2(2.0, 0.0), vec2(3.0, 0.0), vec2(3.0, 1.0)];
        let polygon = Hole::Polygon { points: corners.to_vec() };
        let bounds = Rect::new(vec2(0.0, -1.0), vec2(4.0, 2.0));
        let domain = Domain { bounds, holes: vec![circle, polygon] };
        let material = ppum::dataset::Material {
            young: 1.0,
            poisson: 0.3,
            state: ppum::dataset::StressState::PlaneStrain,
        };
        let cells = crate::problem::Discretization::new(crate::problem::Cells::Level(1));
        let problem = Problem::elasticity(domain.clone(), material, cells);
        let piece = BorderPart::Edge { edge: Edge::Left, from: -0.1 - 0.2, to: 1e-7 };
        for (part, center) in [
            (BorderPart::edge(Edge::Top, &bounds), vec2(2.0, 2.0)),
            (BorderPart::edge(Edge::Left, &bounds), vec2(0.0, 0.5)),
            (piece, vec2(0.0, 0.5 * (-0.1 - 0.2) + 0.5e-7)),
            (BorderPart::Hole(0), vec2(0.5, 0.25)),
            (BorderPart::Hole(1), vec2(2.5, 0.5)),
        ] {
            assert_eq!(super::center(&words(part, &problem), &domain), Some(center), "{part}");
        }
        for other in ["", "hole 2", "hole x", "rim", "top from 0 to", "top  from 0 to 1"] {
            assert_eq!(super::center(other, &domain), None, "{other}");
        }
    }
}
