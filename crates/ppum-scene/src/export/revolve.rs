//! The mesh of a body of revolution in space: its triangles swept around the axis.
//!
//! Between two segments a triangle sweeps a wedge, beside the axis a pyramid or a tetrahedron,
//! since points on the axis stay where they are. The axis is y, and the half-plane that was solved
//! is z = 0, x ≥ 0.

use std::f64::consts::TAU;

use ppum::vec2::Vec2;

use super::ExportMesh;
use super::grid::Grid;

/// The kinds of cells of VTK.
const TETRAHEDRON: u8 = 10;
const WEDGE: u8 = 13;
const PYRAMID: u8 = 14;

/// Distance from the axis, in parts of the largest one, that counts as zero.
const ON_AXIS: f64 = 1e-12;

/// The points of a half-plane on all segments.
struct Sweep {
    segments: usize,
    /// The number of each point among those that are not on the axis; `None` on it.
    ranks: Vec<Option<u32>>,
    /// The number of points that are not on the axis.
    moving: u32,
}

impl Grid {
    /// The swept mesh of triangles of order 1.
    pub(super) fn revolved(mesh: &ExportMesh, segments: usize) -> Self {
        let sweep = Sweep::new(&mesh.points, segments);
        let points = sweep.rows(3, |p| vec![mesh.points[p].x, mesh.points[p].y, 0.0]);
        let arrays = (0..mesh.arrays.len()).map(|k| sweep.array(mesh, k)).collect();
        let mut grid = Self::without_cells(points, arrays);
        for triangle in mesh.triangles() {
            for segment in 0..segments {
                let (kind, nodes) = sweep.cell([triangle[0], triangle[1], triangle[2]], segment);
                grid.add(kind, &nodes);
            }
        }
        grid
    }
}

impl Sweep {
    fn new(points: &[Vec2], segments: usize) -> Self {
        let near = ON_AXIS * points.iter().fold(0.0, |far: f64, p| far.max(p.x));
        let mut moving = 0;
        let rank = |p: &Vec2| {
            let is_moving = p.x > near;
            moving += u32::from(is_moving);
            is_moving.then(|| moving - 1)
        };
        let ranks = points.iter().map(rank).collect();
        Self { segments, ranks, moving }
    }

    /// The number of a point on a segment: those of the half-plane come first.
    fn point(&self, point: u32, segment: usize) -> u32 {
        match (segment % self.segments, self.ranks[point as usize]) {
            (0, _) | (_, None) => point,
            (k, Some(rank)) => self.ranks.len() as u32 + (k as u32 - 1) * self.moving + rank,
        }
    }

    /// The rows of all points, turned with them.
    fn rows(&self, width: usize, row: impl Fn(usize) -> Vec<f64>) -> Vec<f64> {
        let count = self.ranks.len() + (self.segments - 1) * self.moving as usize;
        let mut all = Vec::with_capacity(width * count);
        for segment in 0..self.segments {
            let (sin, cos) = (TAU * segment as f64 / self.segments as f64).sin_cos();
            let is_own = |p: &usize| segment == 0 || self.ranks[*p].is_some();
            for p in (0..self.ranks.len()).filter(is_own) {
                all.extend(turned(row(p), [cos, sin]));
            }
        }
        all
    }

    fn array(&self, mesh: &ExportMesh, number: usize) -> Vec<f64> {
        let width = mesh.arrays[number].array.components.len();
        let values = mesh.values_of(number);
        self.rows(width, |p| values[width * p..width * (p + 1)].to_vec())
    }

    /// The cell of a triangle from a segment to the next.
    fn cell(&self, mut triangle: [u32; 3], segment: usize) -> (u8, Vec<u32>) {
        let is_fixed = |p: u32| self.ranks[p as usize].is_none();
        let fixed = triangle.iter().filter(|p| is_fixed(**p)).count();
        // the point that is alone on the axis, or beside it, comes first
        while (1..3).contains(&fixed) && is_fixed(triangle[0]) != (fixed == 1) {
            triangle.rotate_left(1);
        }
        let [now, next] = [segment, segment + 1].map(|k| triangle.map(|p| self.point(p, k)));
        match fixed {
            0 => (WEDGE, [next, now].concat()),
            1 => (PYRAMID, vec![now[1], now[2], next[2], next[1], now[0]]),
            _ => (TETRAHEDRON, vec![now[2], now[1], now[0], next[0]]),
        }
    }
}

/// A scalar, vector or symmetric tensor (in the order of VTK) turned about y, from x towards −z.
fn turned(row: Vec<f64>, [c, s]: [f64; 2]) -> Vec<f64> {
    match row[..] {
        [x, y, z] => vec![c * x + s * z, y, c * z - s * x],
        [xx, yy, zz, xy, ..] => {
            let around = [c * c * xx + s * s * zz, yy, s * s * xx + c * c * zz];
            [around, [c * xy, -s * xy, c * s * (zz - xx)]].concat()
        }
        _ => row,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::vec2;

    /// A cylinder of radius 2 and height 1: of triangles with no, one and two points on the axis.
    #[test]
    fn cells_fill_the_body() {
        let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [0.0, 1.0]];
        let points = points.map(|[x, y]| vec2(x, y));
        let triangles = [[0, 1, 4], [4, 5, 0], [1, 2, 3], [1, 3, 4]];
        for segments in [3, 8, 17] {
            let sweep = Sweep::new(&points, segments);
            let rows = sweep.rows(3, |p| vec![points[p].x, points[p].y, 0.0]);
            assert_eq!(rows.len(), 3 * (2 + 4 * segments));
            let at = |p: u32| [0, 1, 2].map(|d| rows[3 * p as usize + d]);
            let mut volume = 0.0;
            for triangle in triangles {
                for segment in 0..segments {
                    let (kind, nodes) = sweep.cell(triangle, segment);
                    let size = |corners: [usize; 4]| sixfold(corners.map(|k| at(nodes[k]))) / 6.0;
                    // parts that have positive volumes in VTK
                    let parts = match kind {
                        WEDGE => vec![size([0, 1, 2, 3]), size([1, 4, 2, 3]), size([2, 4, 5, 3])],
                        PYRAMID => vec![size([0, 1, 2, 4]), size([0, 2, 3, 4])],
                        _ => vec![size([0, 1, 2, 3])],
                    };
                    assert!(parts.iter().all(|part| *part > 0.0), "{kind} {nodes:?} {parts:?}");
                    volume += parts.iter().sum::<f64>();
                }
            }
            let exact = 2.0 * segments as f64 * (TAU / segments as f64).sin();
            assert!((volume - exact).abs() < 1e-12, "{segments}: {volume} {exact}");
        }
    }

    /// Six times the volume of a tetrahedron, positive if its first side turns right-handed to the
    /// last corner.
    fn sixfold([a, b, c, d]: [[f64; 3]; 4]) -> f64 {
        let [u, v, w] = [b, c, d].map(|p| [0, 1, 2].map(|k| p[k] - a[k]));
        u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
            + u[2] * (v[0] * w[1] - v[1] * w[0])
    }

    /// Radial and hoop directions turn with the point.
    #[test]
    fn tensors_turn() {
        let quarter = turned(vec![3.0, 5.0, 7.0, 2.0, 0.0, 0.0], [0.0, 1.0]);
        assert_eq!(quarter, [7.0, 5.0, 3.0, 0.0, -2.0, 0.0]);
        assert_eq!(turned(vec![3.0, 5.0, 0.0], [0.0, 1.0]), [0.0, 5.0, -3.0]);
        assert_eq!(turned(vec![3.0], [0.0, 1.0]), [3.0]);
        let [c, s] = [0.6, 0.8];
        let half = turned(vec![3.0, 5.0, 7.0, 2.0, 0.0, 0.0], [c, s]);
        // the radial direction is (c, 0, −s)
        let radial = c * c * half[0] + s * s * half[2] - 2.0 * c * s * half[5];
        assert!((radial - 3.0).abs() < 1e-14 && (c * half[3] - s * half[4] - 2.0).abs() < 1e-14);
    }
}
