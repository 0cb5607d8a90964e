//! The nodes of triangles of higher order: those on torn edges twice, those on others once.

use ppum::vec2::Vec2;

use super::super::lagrange::Lagrange;
use super::forest::Forest;
use super::{Torn, TornPoint};

impl Torn<'_> {
    /// The nodes of a triangle beside its corners.
    pub(in super::super) fn inner_nodes(
        &self,
        triangle: u32,
        cell: &Lagrange,
    ) -> impl Iterator<Item = TornPoint> {
        cell.nodes[3..].iter().map(move |node| self.node(triangle, *node, cell.order))
    }

    fn node(&self, triangle: u32, node: [u8; 3], order: u8) -> TornPoint {
        let part = |i: u8| f64::from(i) / f64::from(order);
        if let Some(point) = self.element_point(triangle, node.map(part)) {
            return point;
        }
        let [a, b, c] = self.corners(triangle);
        let Some(opposite) = node.iter().position(|i| *i == 0) else {
            let point = a + ((b - a) * part(node[1]) + (c - a) * part(node[2]));
            return TornPoint::new(point, self.place(point));
        };
        let edge = (opposite + 1) % 3;
        let ends = [edge, (edge + 1) % 3].map(|k| ([a, b, c][k], part(node[k])));
        self.on_edge(between(ends), triangle, edge)
    }

    /// Adds the nodes of all triangles; for each triangle the numbers of its points.
    pub(in super::super) fn add_nodes(&mut self, cell: &Lagrange) -> Vec<u32> {
        let mut numbers = Vec::with_capacity(self.triangles.len() * cell.nodes.len());
        for triangle in 0..self.triangles.len() as u32 {
            let own: Vec<TornPoint> = self.inner_nodes(triangle, cell).collect();
            numbers.extend(self.triangles[triangle as usize].corners);
            for (k, point) in own.into_iter().enumerate() {
                let shared = self.shared_node(triangle, k, cell);
                let number = shared.map_or(self.points.len() as u32, |at| numbers[at]);
                numbers.push(number);
                self.points.extend(shared.is_none().then_some(point));
            }
        }
        numbers
    }

    /// For each point the first one at its place that neither a crack nor an interface parts from
    /// it, and that agrees with it; `cells` are the points of all triangles.
    pub(in super::super) fn together(
        &self,
        cells: &[u32],
        cell: &Lagrange,
        agree: &dyn Fn(usize, usize) -> bool,
    ) -> Vec<usize> {
        let on_edge = |t: u32, edge: usize| {
            let (own, inner) = (&cells[t as usize * cell.nodes.len()..], cell.order as usize - 1);
            let between = own[3 + edge * inner..][..inner].iter();
            let all = [&own[edge]].into_iter().chain(between).chain([&own[(edge + 1) % 3]]);
            all.map(|&point| point as usize).collect::<Vec<_>>()
        };
        let mut all = Forest::new(self.points.len());
        for (t, triangle) in (0..).zip(&self.triangles) {
            for edge in 0..3 {
                let other = triangle.neighbours[edge];
                if other < t && !triangle.kinds[edge].is_physical() {
                    let across = on_edge(other, self.edge_to(other, t));
                    let pairs = on_edge(t, edge).into_iter().zip(across.into_iter().rev());
                    pairs.filter(|(a, b)| agree(*a, *b)).for_each(|(a, b)| all.join(a, b));
                }
            }
        }
        (0..self.points.len()).map(|point| all.root(point)).collect()
    }

    /// Where the node of an edge is among those of a neighbour before, whose edge runs the other
    /// way.
    fn shared_node(&self, triangle: u32, inner: usize, cell: &Lagrange) -> Option<usize> {
        let on_edge = usize::from(cell.order) - 1;
        let (edge, along) = (inner / on_edge, inner % on_edge);
        let own = &self.triangles[triangle as usize];
        let other = *own.neighbours.get(edge)?;
        (other < triangle && !own.kinds[edge].is_torn()).then(|| {
            let across = self.edge_to(other, triangle);
            other as usize * cell.nodes.len() + 3 + (across + 1) * on_edge - 1 - along
        })
    }
}

/// A point of an edge by its weighted ends, the same whichever of them is the first.
fn between([a, b]: [(Vec2, f64); 2]) -> Vec2 {
    let first = (a.0.x, a.0.y) < (b.0.x, b.0.y);
    let [(from, _), (to, part)] = if first { [a, b] } else { [b, a] };
    from + (to - from) * part
}
