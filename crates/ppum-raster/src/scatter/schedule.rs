//! The work that the renderer does for a view, without doing it: for tests and measurements.

use ppum::field::Field;
use ppum::quantity::Quantity;

use super::plan::COLUMNS;
use super::tile::{Tile, TileScratch};
use super::view_data::PreparedView;
use crate::summation::Summation;
use crate::view::View;

/// The work that [`render_with`](super::render_with) does for a view in f64.
pub struct Schedule<'f> {
    scene: PreparedView<'f, f64>,
}

/// The patches of a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TileLoad {
    /// Patches that meet the tile; 0 if the view is summed per patch.
    pub patches: usize,
    /// The first patches of these, which are summed together at every column.
    pub first_batch: usize,
    /// Row spans that they collapse to, of all columns together.
    pub row_spans: usize,
}

impl<'f> Schedule<'f> {
    /// Plans the summation of a quantity.
    #[must_use]
    pub fn new(
        field: &'f Field<'f>,
        view: &View,
        quantity: &'f Quantity,
        summation: Summation,
    ) -> Self {
        Self { scene: PreparedView::new(field, view, quantity, summation) }
    }

    /// True if the view is summed per patch, false if in row spans.
    #[must_use]
    pub fn is_per_patch(&self) -> bool {
        self.scene.plan.is_per_patch
    }

    /// Patches that are listed in advance: those in the view, or none if it is summed per patch,
    /// since each tile then finds its own.
    #[must_use]
    pub fn listed_patches(&self) -> usize {
        self.scene.plan.patches.len()
    }

    /// The patches of a tile, collapsed with derivatives.
    ///
    /// # Panics
    /// If the view has no such tile: tiles are 64 pixels wide and 32 high.
    #[must_use]
    pub fn tile(&self, [column, row]: [usize; 2]) -> TileLoad {
        let tiles = self.scene.plan.tiles(&(row..row + 1));
        let tile = Tile::<f64, 1>::new(&self.scene, column, row);
        let mut scratch = TileScratch::default();
        scratch.shift.resize(self.scene.plan.coefficients.len(), 0.0);
        scratch.places.resize(self.scene.functions.table().groups(), 0);
        let patches = tiles.patches_at(column, row);
        tile.take_patches(patches, &mut scratch);
        let mut load =
            TileLoad { patches: patches.len(), first_batch: patches.len(), row_spans: 0 };
        for column in 0..COLUMNS {
            let count = tile.gather(column, 0, &mut scratch, 0.0f64);
            load.first_batch = load.first_batch.min(count);
            load.row_spans += scratch.spans.all.len();
        }
        load
    }
}
