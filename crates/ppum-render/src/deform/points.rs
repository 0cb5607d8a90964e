//! The points of the body at the pixels of a view, and what is to be seen there.

use ppum::box_tree::BoxTree;
use ppum::crack::Side;
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use ppum::vec2::{Rect, Vec2};
use ppum_raster::parts::Parts;
use ppum_raster::raster::Raster;
use rayon::prelude::*;

use super::chart::ElementChart;
use super::cutter::leaves;
use super::inverse::LeafInverse;
use super::leaf::DeformedLeaf;
use super::map::{DeformationChart, DeformationMap, Preimage};
use super::{DeformError, DeformedView};

/// Rows of pixels that are worked on at once: what is found there is kept until it is sorted.
const ROWS: u32 = 256;
/// Leaves that a thread takes at once.
const BLOCK: usize = 32;
/// Two points are one if their images are nearer than this part of a pixel by the gradient at one
/// of them.
const SAME: f64 = 0.05;
/// Rounding of places, in parts of the body.
const ROUNDING: f64 = 1e-14;

/// A point of the body that is seen at a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaterialPoint {
    /// Its offset from the view's anchor, off any crack by 10⁻⁶ of a few pixels at least.
    pub offset: Vec2,
    /// True if the body lies there with its back up: det F < 0.
    pub folded: bool,
}

/// The points of the body that lie at the centres of a view's pixels.
#[derive(Clone, Debug)]
pub struct DeformedPoints<'f> {
    /// The view.
    pub view: DeformedView<'f>,
    /// For each pixel, row by row from the top, where its points begin; one entry more than there
    /// are pixels.
    pub(super) starts: Vec<u32>,
    pub(super) points: Vec<MaterialPoint>,
}

/// An image of a quantity on the deformed body.
#[derive(Clone, Debug)]
pub struct DeformedRaster {
    /// The values, each that of the first of the pixel's points; NaN where the body is not.
    pub values: Raster,
    /// True where several points of the body lie: faces that have closed, folds.
    pub overlap: Vec<bool>,
}

impl<'f> DeformedView<'f> {
    /// The points of the body at the centres of all pixels, on the threads of the pool that calls.
    /// Where there are several, the first is one with its face up if there is one, and among these
    /// the one that lies highest, so that what covers what does not change from pixel to pixel.
    ///
    /// # Errors
    /// [`DeformError::TooFolded`] if millions of pieces of the body lie in the image,
    /// [`DeformError::TooFine`], [`DeformError::Cancelled`].
    pub fn points(&self, watcher: &dyn Watcher) -> Result<DeformedPoints<'f>, DeformError> {
        if !self.is_known() {
            return Err(DeformError::TooFine(self.view.width));
        }
        let leaves = if self.factor() == 0.0 { Vec::new() } else { leaves(self, watcher)? };
        let [columns, rows] = self.view.pixels;
        let bands = rows.div_ceil(ROWS);
        let parts = Parts::start(watcher, bands as usize * leaves.len().div_ceil(BLOCK))?;
        let mut all = DeformedPoints { view: *self, starts: vec![0], points: Vec::new() };
        all.starts.reserve(columns as usize * rows as usize);
        for band in 0..bands {
            let band = [band * ROWS, ((band + 1) * ROWS).min(rows)];
            let found = if self.factor() == 0.0 {
                self.unmoved(band)
            } else {
                self.band(&leaves, band, &parts)?
            };
            all.append(found, band)?;
        }
        Ok(all)
    }

    /// Finds the points in some rows, by pixel.
    fn band(
        &self,
        leaves: &[DeformedLeaf],
        band: [u32; 2],
        parts: &Parts<'_>,
    ) -> Result<Vec<(u32, Preimage)>, DeformError> {
        let blocks = leaves.par_chunks(BLOCK).map_init(
            || DeformationMap::new(self.field(), self.anchor),
            |map, block| {
                let mut found = Vec::new();
                for leaf in block {
                    let inverse = LeafInverse { view: self, leaf };
                    if let Some(mut chart) = ElementChart::new(map, leaf.patch) {
                        inverse.pixels(&mut chart, band, &mut found);
                        continue;
                    }
                    inverse.pixels(map, band, &mut found);
                }
                parts.finish_one().map(|()| found)
            },
        );
        let blocks: Vec<Vec<_>> = blocks.collect::<Result<_, _>>()?;
        let mut found: Vec<_> = blocks.into_iter().flatten().collect();
        found.par_sort_by(|a, b| a.0.cmp(&b.0).then(first(&a.1, &b.1)));
        Ok(found)
    }

    /// Without displacements every pixel is its own point.
    fn unmoved(&self, [from, to]: [u32; 2]) -> Vec<(u32, Preimage)> {
        let map = DeformationMap::new(self.field(), self.anchor);
        let columns = self.view.pixels[0];
        let unit = [Vec2 { x: 1.0, y: 0.0 }, Vec2 { x: 0.0, y: 1.0 }];
        let point = |(i, j): (u32, u32)| {
            let at = self.view.offset(i, j);
            let found = Preimage {
                offset: at - self.shift,
                image: super::map::DeformedPoint { at, gradient: unit },
            };
            map.contains(found.offset).then_some((j * columns + i, found))
        };
        let row = |j| (0..columns).filter_map(|i| point((i, j))).collect::<Vec<_>>();
        (from..to).into_par_iter().flat_map_iter(row).collect()
    }
}

/// The order of the points at a pixel.
fn first(a: &Preimage, b: &Preimage) -> std::cmp::Ordering {
    let is_folded = |found: &Preimage| found.image.determinant() < 0.0;
    // the highest; of equally high ones the rightmost
    let height = |found: &Preimage| found.offset.y + 0.29 * found.offset.x;
    is_folded(a).cmp(&is_folded(b)).then(height(b).total_cmp(&height(a)))
}

impl LeafInverse<'_, '_> {
    /// Appends the points of the leaf at the pixels of some rows.
    fn pixels<C: DeformationChart>(
        &self,
        map: &mut C,
        [from, to]: [u32; 2],
        found: &mut Vec<(u32, Preimage)>,
    ) {
        let (view, Rect { min, max }) = (&self.view.view, self.reach());
        let (low, high) = (view.pixel_of_offset(min), view.pixel_of_offset(max));
        let [columns, rows] =
            [clipped(low.x, high.x, [0, view.pixels[0]]), clipped(high.y, low.y, [from, to])];
        for row in rows {
            for column in columns.clone() {
                let place = view.offset(column, row);
                if self.may_hold(place)
                    && let Some(point) = self.find(map, place).and_then(|found| map.material(found))
                {
                    found.push((row * view.pixels[0] + column, point));
                }
            }
        }
    }
}

/// The pixels with centres between two continuous positions.
fn clipped(from: f64, to: f64, [first, end]: [u32; 2]) -> std::ops::Range<u32> {
    let bound = |position: f64| (position.clamp(f64::from(first), f64::from(end))) as u32;
    bound((from - 0.5).ceil())..bound((to - 0.5).floor() + 1.0)
}

impl<'f> DeformedPoints<'f> {
    /// Appends what was found in some rows, each point once.
    fn append(
        &mut self,
        found: Vec<(u32, Preimage)>,
        [from, to]: [u32; 2],
    ) -> Result<(), DeformError> {
        let (columns, pixel) = (self.view.view.pixels[0], self.view.view.pixel_size());
        let mut rest = found.into_iter().peekable();
        let mut here: Vec<Preimage> = Vec::new();
        for index in from * columns..to * columns {
            here.clear();
            while let Some((_, point)) = rest.next_if(|(at, _)| *at == index) {
                let is_same = |known: &Preimage| {
                    known.image.carried(point.offset - known.offset).length() < SAME * pixel
                };
                if !here.iter().any(is_same) {
                    here.push(point);
                }
            }
            let point = |found: &Preimage| MaterialPoint {
                offset: found.offset,
                folded: found.image.determinant() < 0.0,
            };
            self.points.extend(here.iter().map(point));
            let end = u32::try_from(self.points.len());
            self.starts.push(end.map_err(|_| DeformError::TooFolded(self.view.factor()))?);
        }
        Ok(())
    }

    /// The points at a pixel: none where the body is not.
    ///
    /// # Panics
    /// If there is no such pixel.
    #[must_use]
    pub fn at(&self, column: u32, row: u32) -> &[MaterialPoint] {
        let [columns, _] = self.view.view.pixels;
        assert!(column < columns, "a pixel of the picture");
        let index = row as usize * columns as usize + column as usize;
        &self.points[self.starts[index] as usize..self.starts[index + 1] as usize]
    }

    /// The values of a quantity at the points that are seen.
    ///
    /// # Errors
    /// A quantity without meaning for the field; [`DeformError::Cancelled`].
    pub fn raster(
        &self,
        quantity: &Quantity,
        watcher: &dyn Watcher,
    ) -> Result<DeformedRaster, DeformError> {
        let field = self.view.field();
        quantity.check(field)?;
        let [columns, rows] = self.view.view.pixels;
        let parts = Parts::start(watcher, rows as usize)?;
        let mut values = vec![f64::NAN; columns as usize * rows as usize];
        values.par_chunks_mut(columns as usize).enumerate().try_for_each(|(row, line)| {
            let seen: Vec<(u32, Vec2)> = (0..columns)
                .filter_map(|column| Some((column, self.at(column, row as u32).first()?.offset)))
                .collect();
            let offsets: Vec<Vec2> = seen.iter().map(|(_, offset)| *offset).collect();
            let mut local = field.at(self.view.anchor);
            let found = Quantity::at_many(
                std::slice::from_ref(quantity),
                &mut local,
                &offsets,
                Side::Above,
            );
            for ((column, _), value) in seen.into_iter().zip(found) {
                line[column as usize] = value;
            }
            parts.finish_one()
        })?;
        Ok(self.with_overlap(values))
    }

    /// The image of one value per patch: each pixel has that of the cell in which its point lies,
    /// NaN where there is no cell. Borders belong to the right and upper cell. Without cells the
    /// patch with the largest φ takes the place of the cell.
    ///
    /// # Panics
    /// If there is not one value per patch.
    #[must_use]
    pub fn cells(&self, values: &[f64]) -> DeformedRaster {
        if !self.view.field().step.partition.boxes().has_cells() {
            return self.owners(values);
        }
        let (cells, anchor) = (&self.view.field().step.partition.boxes().cell, self.view.anchor);
        assert_eq!(values.len(), cells.len(), "one value per patch");
        let (tree, bounds) = (BoxTree::new(cells), self.view.field().domain.bounds);
        let end = bounds.max - anchor;
        let holds = |cell: &Rect, offset: Vec2| {
            let (min, max) = (cell.min - anchor, cell.max - anchor);
            let is_before = offset.x < max.x || max.x >= end.x;
            let is_below = offset.y < max.y || max.y >= end.y;
            min.x <= offset.x && min.y <= offset.y && is_before && is_below
        };
        // candidates by rounded places, decided by offsets
        let reach = bounds.size() * ROUNDING;
        let value = |near: &mut Vec<u32>, offset: Vec2| {
            near.clear();
            tree.query_box(&Rect::around(anchor + offset, reach), near);
            let found = near.iter().find(|&&cell| holds(&cells[cell as usize], offset));
            found.map_or(f64::NAN, |&cell| values[cell as usize])
        };
        let of_pixel = |near: &mut Vec<u32>, pair: &[u32]| {
            let seen = self.points[pair[0] as usize..pair[1] as usize].first();
            seen.map_or(f64::NAN, |point| value(near, point.offset))
        };
        self.with_overlap(self.starts.par_windows(2).map_init(Vec::new, of_pixel).collect())
    }

    /// The image of one value per element, or per patch without a cell.
    fn owners(&self, values: &[f64]) -> DeformedRaster {
        let field = self.view.field();
        assert_eq!(values.len(), field.step.partition.len(), "one value per patch");
        let local = field.at(self.view.anchor);
        let of_pixel = |pair: &[u32]| {
            let seen = self.points[pair[0] as usize..pair[1] as usize].first();
            let owner = seen.and_then(|point| local.owner(point.offset, Side::Above));
            owner.map_or(f64::NAN, |patch| values[patch])
        };
        self.with_overlap(self.starts.par_windows(2).map(of_pixel).collect())
    }

    /// The image of one value per pixel.
    fn with_overlap(&self, values: Vec<f64>) -> DeformedRaster {
        let overlap = self.starts.windows(2).map(|pair| pair[1] - pair[0] > 1).collect();
        DeformedRaster { values: Raster::new(self.view.view.pixels, values), overlap }
    }
}
