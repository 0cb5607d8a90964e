//! The axis of a body of revolution: the straight parts of its boundary with x = 0.
//!
//! The displacement u_x vanishes there, or the energy of its hoop strain u_x/x would be infinite,
//! and no shear acts: a condition of symmetry, which every field satisfies exactly as beside a
//! crack on the boundary. A temperature has no such energy and no such condition.

use ppum::border::{BorderLine, touch};

use super::{BoundaryCondition, BoundaryPart, BoundaryRange, DomainEdge, ProblemData, Symmetry};

impl ProblemData {
    /// The straight lines of the boundary that lie on the axis of a body of revolution.
    pub(crate) fn axis_lines(&self) -> Vec<BorderLine> {
        if !self.equation.is_axisymmetric() {
            return Vec::new();
        }
        self.lines_on(DomainEdge::Left).into_iter().filter(|line| self.is_on_axis(line)).collect()
    }

    fn is_on_axis(&self, line: &BorderLine) -> bool {
        let touch = touch(&self.domain().bounds);
        line.ends.iter().all(|p| p.x.abs() <= touch)
    }

    /// The conditions that hold on the axis of an elastic body.
    pub(crate) fn axis_conditions(&self) -> Vec<BoundaryCondition> {
        if self.equation.elastic().is_none() {
            return Vec::new();
        }
        let normal = DomainEdge::Left.normal();
        let of_part = |on| BoundaryCondition::symmetry_on(on, normal, Symmetry::Symmetric);
        self.axis_lines().iter().flat_map(|line| self.parts_of(line)).map(of_part).collect()
    }

    /// The parts of the boundary that make a line on the axis.
    fn parts_of(&self, line: &BorderLine) -> Vec<BoundaryPart> {
        let Some(hole) = line.hole else {
            return vec![BoundaryPart::edge(DomainEdge::Left, &self.domain().bounds)];
        };
        let touch = touch(&self.domain().bounds);
        let edges = self.domain().holes[hole].edges().enumerate();
        let own = edges.filter(|(_, edge)| {
            !edge.is_arc() && [edge.from, edge.to].iter().all(|p| line.holds(*p, touch))
        });
        own.map(|(k, _)| BoundaryPart::Sides(BoundaryRange { hole, from: k, to: k + 1 })).collect()
    }

    /// The data with the conditions on the axis among those of the boundary.
    pub(crate) fn with_axis(mut self) -> Self {
        for condition in self.axis_conditions() {
            if !self.boundary.contains(&condition) {
                self.boundary.push(condition);
            }
        }
        self
    }
}
