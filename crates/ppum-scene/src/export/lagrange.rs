//! Polynomials of degree n on a triangle, given by their values at equidistant nodes.
//!
//! A node is three numbers i + j + k = n, its barycentric coordinates times n. Its polynomial is
//! P_i(n b₀) P_j(n b₁) P_k(n b₂) with P_m(z) = Π_{l<m} (z − l)/(m − l): one there, zero at the
//! other nodes (Silvester, 1969). Nodes are in the order of VTK.

/// Barycentric coordinates.
pub(super) type BarycentricPoint = [f64; 3];

/// Barycentric coordinates at which a linear triangle is looked at: the middle, near the middles of
/// the edges, where quadratic functions differ most, and between.
const LINEAR_TESTS: [BarycentricPoint; 7] = [
    [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
    [0.48, 0.48, 0.04],
    [0.04, 0.48, 0.48],
    [0.48, 0.04, 0.48],
    [0.7, 0.15, 0.15],
    [0.15, 0.7, 0.15],
    [0.15, 0.15, 0.7],
];

/// Part of the way to the centroid of the tests near edges: on edges other triangles begin.
const INWARDS: f64 = 0.12;

/// A triangle of some order.
#[derive(Clone, Debug)]
pub(super) struct Lagrange {
    /// The degree n.
    pub(super) order: u8,
    /// Barycentric coordinates times n: corners, then edges from corner to corner, then the inside.
    pub(super) nodes: Vec<[u8; 3]>,
    /// Where interpolation is compared with the field.
    pub(super) tests: Vec<BarycentricPoint>,
    /// The weights of the nodes at each test.
    pub(super) at_tests: Vec<Vec<f64>>,
}

impl Lagrange {
    pub(super) fn new(order: u8) -> Self {
        let mut made = Self { order, nodes: nodes(order), tests: tests(order), at_tests: vec![] };
        made.at_tests = made.tests.iter().map(|&at| made.weights(at)).collect();
        made
    }

    /// The value of each node's polynomial at a place.
    pub(super) fn weights(&self, at: BarycentricPoint) -> Vec<f64> {
        let scaled = at.map(|b| f64::from(self.order) * b);
        let factor = |m: u8, z: f64| -> f64 {
            (0..m).map(|l| (z - f64::from(l)) / f64::from(m - l)).product()
        };
        let weight = |node: &[u8; 3]| (0..3).map(|k| factor(node[k], scaled[k])).product();
        self.nodes.iter().map(weight).collect()
    }
}

/// The number of nodes of a triangle.
pub(super) fn node_count(order: u8) -> usize {
    let n = usize::from(order);
    (n + 1) * (n + 2) / 2
}

/// Nodes inside form a triangle of order n − 3.
fn nodes(order: u8) -> Vec<[u8; 3]> {
    if order == 0 {
        return vec![[0; 3]];
    }
    let between = |k: usize, j: u8| {
        let mut node = [0; 3];
        (node[k], node[(k + 1) % 3]) = (order - j, j);
        node
    };
    let corners = (0..3).map(|k| between(k, 0));
    let edges = (0..3).flat_map(|k| (1..order).map(move |j| between(k, j)));
    let inside = if order < 3 { Vec::new() } else { nodes(order - 3) };
    corners.chain(edges).chain(inside.into_iter().map(|node| node.map(|i| i + 1))).collect()
}

/// The points at which triangles are tested; for higher orders near the middles between nodes on
/// edges, where polynomials of the next degree differ most, and in the middles of the triangles
/// between nodes.
fn tests(order: u8) -> Vec<BarycentricPoint> {
    if order == 1 {
        return LINEAR_TESTS.to_vec();
    }
    let n = f64::from(order);
    let inwards = |b: f64| b.mul_add(1.0 - INWARDS, INWARDS / 3.0);
    let near_edge = |k: usize, j: u8| {
        let mut at = [0.0; 3];
        at[(k + 1) % 3] = (f64::from(j) + 0.5) / n;
        at[k] = 1.0 - at[(k + 1) % 3];
        at.map(inwards)
    };
    let edges = (0..3).flat_map(|k| (0..order).map(move |j| near_edge(k, j)));
    let middle = |node: [u8; 3], third: f64| node.map(|i| (f64::from(i) + third / 3.0) / n);
    let upright = nodes(order - 1).into_iter().map(|node| middle(node, 1.0));
    let turned = nodes(order - 2).into_iter().map(|node| middle(node, 2.0));
    edges.chain(upright).chain(turned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    /// b₀^p b₁^q for all p + q ≤ n is a polynomial of degree n: interpolation has its values.
    #[test]
    fn polynomials_are_their_own_interpolation() {
        let mut random = Random(5);
        for order in 1..=4 {
            let cell = Lagrange::new(order);
            assert_eq!(cell.nodes.len(), node_count(order));
            for (p, q) in (0..=order).flat_map(|p| (0..=order - p).map(move |q| (p, q))) {
                let value = |b: BarycentricPoint| b[0].powi(p.into()) * b[1].powi(q.into());
                let at_node = |node: &[u8; 3]| value(node.map(|i| f64::from(i) / f64::from(order)));
                let (s, t) = (random.between(0.0, 0.5), random.between(0.0, 0.5));
                let at = [s, t, 1.0 - s - t];
                let weights = cell.weights(at);
                let sum: f64 = weights.iter().zip(&cell.nodes).map(|(w, n)| w * at_node(n)).sum();
                // sums of up to 15 products of numbers below 2
                assert!((sum - value(at)).abs() < 1e-14, "{order} {p} {q}: {sum}");
            }
        }
    }

    /// Tests lie inside and away from nodes, where interpolation has no error.
    #[test]
    fn tests_are_no_nodes() {
        for order in 1..=4 {
            let cell = Lagrange::new(order);
            for (at, weights) in cell.tests.iter().zip(&cell.at_tests) {
                assert!(
                    at.iter().all(|b| *b > 0.0) && (at.iter().sum::<f64>() - 1.0).abs() < 1e-15
                );
                assert!(weights.iter().all(|w| *w < 0.99), "{order} {at:?}: {weights:?}");
            }
        }
    }
}
