//! An unstructured grid of VTK.

/// Points, cells and values of a file.
#[derive(Default)]
pub(super) struct Grid {
    /// Three coordinates of each point.
    pub(super) points: Vec<f64>,
    /// The values of each array.
    pub(super) arrays: Vec<Vec<f64>>,
    /// The points of all cells.
    pub(super) nodes: Vec<u32>,
    /// Where the points of each cell end.
    pub(super) ends: Vec<u32>,
    /// The kinds of the cells.
    pub(super) types: Vec<u8>,
}

impl Grid {
    /// Points with their values.
    pub(super) fn without_cells(points: Vec<f64>, arrays: Vec<Vec<f64>>) -> Self {
        Self { points, arrays, ..Self::default() }
    }

    /// Adds a cell of a kind.
    pub(super) fn add(&mut self, kind: u8, nodes: &[u32]) {
        self.nodes.extend(nodes);
        self.ends.push(self.nodes.len() as u32);
        self.types.push(kind);
    }
}
