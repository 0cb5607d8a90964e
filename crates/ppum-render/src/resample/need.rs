//! The grid that resampling would need for a given error, measured.
//!
//! [`converge`] doubles a grid and measures each time how far its image is from the field, at
//! pixels of the view (at most [`PIXELS`] in each direction, evenly spread). Only the grid's points
//! that count at these pixels are evaluated, so a fine grid costs no more than a coarse one.
//!
//! An error measured at pixels falls for ever, since no pixel's centre lies at a tip or on a crack.
//! The largest error between them does not where the quantity is infinite or jumps:
//! [`GridNeed::Never`] says so for L∞.

use std::collections::BTreeSet;

use ppum::crack::{SegmentId, Side, tips};
use ppum::edge::Edge;
use ppum::field::Field;
use ppum::function::{Frame, FunctionKind};
use ppum::line::Line;
use ppum::progress::Watcher;
use ppum::quantity::{Quantity, Source};
use ppum::vec2::{Rect, Vec2};
use ppum_raster::RasterError;
use ppum_raster::parts::Parts;
use ppum_raster::view::View;
use rayon::prelude::*;

use super::norms::{DifferenceNorms, of_values};
use super::stencil::Stencil;
use super::{Interpolation, SampleGrid, at_offsets};
use crate::anchored_edge::AnchoredEdge;

/// Most columns and rows of pixels that errors are measured at.
pub const PIXELS: u32 = 128;
/// Most points along the longer side of a grid that is measured.
pub const LARGEST: u32 = 8192;
/// Points along the longer side of the first grid.
const FIRST: u32 = 8;

/// The field, view, quantity and grids whose errors are measured.
#[derive(Clone, Copy, Debug)]
pub struct ResamplingSetup<'a> {
    /// The field.
    pub field: &'a Field<'a>,
    /// The part of the plane over which errors are measured.
    pub view: &'a View,
    /// The quantity.
    pub quantity: &'a Quantity,
    /// The rectangle of the grids, and the ratio of their columns and rows.
    pub grid: SampleGrid,
    /// The interpolation between the points.
    pub interpolation: Interpolation,
}

/// Errors of grids, each with twice the points of the one before in each direction.
#[derive(Clone, Debug, PartialEq)]
pub struct GridConvergence {
    /// Sizes of the grids and the errors found.
    pub steps: Vec<([u32; 2], DifferenceNorms)>,
    /// Why L∞ does not fall, if that is known.
    pub obstacle: Option<ConvergenceObstacle>,
}

/// The reason why an error does not fall below a bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConvergenceObstacle {
    /// The quantity is infinite at a point of the view: near it the error is larger than any bound.
    Singular,
    /// The quantity jumps across a crack in the view: there the error is half the jump or more.
    Jump,
    /// From one grid to the next the measured error no longer fell.
    Stalled,
}

/// The grid for an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GridNeed {
    /// The first of the measured grids with no larger error; one of half its points has a
    /// larger one.
    Grid([u32; 2]),
    /// The size to which the last two measured errors lead, if they go on falling by the
    /// same power.
    Extrapolated([f64; 2]),
    /// No grid.
    Never(ConvergenceObstacle),
}

/// Errors of finer and finer grids, up to the first with relative errors of at most `target` in all
/// norms, or to [`LARGEST`]. The watcher hears of every grid.
///
/// # Errors
/// As for [`render`](ppum_raster::scatter::render).
pub fn converge(
    subject: &ResamplingSetup<'_>,
    target: f64,
    watcher: &dyn Watcher,
) -> Result<GridConvergence, RasterError> {
    subject.quantity.check(subject.field)?;
    let pixels = pixels(subject.view);
    let ResamplingSetup { field, view, quantity, .. } = *subject;
    let direct = at_offsets(field, quantity, view.center, &pixels);
    let sizes = sizes(subject.grid.size);
    let (parts, mut steps) = (Parts::start(watcher, sizes.len())?, Vec::new());
    for size in sizes {
        let Ok(grid) = subject.grid.with_size(size) else { break };
        let norms = of_values(&direct, &interpolated(subject, &grid, &pixels));
        steps.push((size, norms));
        parts.finish_one()?;
        if norms.relative().iter().all(|&error| error <= target) {
            break;
        }
    }
    let size = steps.last().map_or(0.0, |(_, norms): &(_, DifferenceNorms)| norms.field[2]);
    Ok(GridConvergence { steps, obstacle: obstacle(subject, size) })
}

impl GridConvergence {
    /// The grid for a relative error of at most `target` in L1 (`norm` 0), L2 (1) or L∞ (2).
    ///
    /// # Panics
    /// If there is no such norm.
    #[must_use]
    pub fn needed(&self, norm: usize, target: f64) -> GridNeed {
        if let (2, Some(obstacle)) = (norm, self.obstacle) {
            return GridNeed::Never(obstacle);
        }
        let error = |step: &([u32; 2], DifferenceNorms)| step.1.relative()[norm];
        if let Some(reached) = self.steps.iter().find(|step| error(step) <= target) {
            return GridNeed::Grid(reached.0);
        }
        let [.., before, last] = &self.steps[..] else {
            return GridNeed::Never(ConvergenceObstacle::Stalled);
        };
        let order = (error(before) / error(last)).log2();
        if order.is_nan() || order < LEAST_ORDER {
            return GridNeed::Never(ConvergenceObstacle::Stalled);
        }
        let finer = (error(last) / target).powf(order.recip());
        GridNeed::Extrapolated(last.0.map(|n| f64::from(n) * finer))
    }
}

/// An error that falls by a smaller power of the spacing does not fall: it takes 10¹⁰ times the
/// points for a tenth.
const LEAST_ORDER: f64 = 0.1;

/// The sizes that are measured, of the shape of `size`.
fn sizes(size: [u32; 2]) -> Vec<[u32; 2]> {
    let longer = f64::from(size[0].max(size[1]));
    let scaled =
        |n: u32| size.map(|k| ((f64::from(k) / longer * f64::from(n)).round() as u32).max(2));
    std::iter::successors(Some(FIRST), |n| (2 * n <= LARGEST).then_some(2 * n))
        .map(scaled)
        .collect()
}

/// Offsets of the pixels at which errors are measured.
fn pixels(view: &View) -> Vec<Vec2> {
    let spread = |n: u32| {
        let count = n.min(PIXELS);
        (0..count)
            .map(move |k| ((2 * u64::from(k) + 1) * u64::from(n) / (2 * u64::from(count))) as u32)
    };
    let [columns, rows] = view.pixels;
    spread(rows).flat_map(|j| spread(columns).map(move |i| view.offset(i, j))).collect()
}

/// Returns the values of a grid at points `view.center + offset`: samples are taken only where they
/// count.
fn interpolated(subject: &ResamplingSetup<'_>, grid: &SampleGrid, offsets: &[Vec2]) -> Vec<f64> {
    let shift = subject.view.center - grid.anchor;
    let stencils: Vec<_> =
        offsets.iter().map(|&o| grid.stencils(subject.interpolation, shift + o)).collect();
    let places: Vec<_> =
        stencils.iter().flatten().flat_map(points).collect::<BTreeSet<_>>().into_iter().collect();
    let values = places.par_chunks(BLOCK).flat_map_iter(|block| {
        let offsets: Vec<_> = block.iter().map(|&(row, column)| grid.offset(column, row)).collect();
        at_offsets(subject.field, subject.quantity, grid.anchor, &offsets)
    });
    let values: Vec<f64> = values.collect();
    let value =
        |row, column| places.binary_search(&(row, column)).map_or(f64::NAN, |at| values[at]);
    let sum = |[x, y]: &[Stencil; 2]| y.sum(|row| x.sum(|column| value(row, column)));
    stencils.iter().map(|pair| pair.as_ref().map_or(f64::NAN, sum)).collect()
}

/// Points that are evaluated together.
const BLOCK: usize = 1024;

/// Rows and columns of the grid's points that count.
fn points([x, y]: &[Stencil; 2]) -> Vec<(u32, u32)> {
    y.points().flat_map(|(row, _)| x.points().map(move |(column, _)| (row, column))).collect()
}

/// Returns the obstacle that keeps the largest error of values up to `size` from falling, if the
/// view shows it.
fn obstacle(subject: &ResamplingSetup<'_>, size: f64) -> Option<ConvergenceObstacle> {
    let ResamplingSetup { field, view, quantity, .. } = *subject;
    let cracks = &field.step.cracks;
    let origins = field.step.functions.iter().filter_map(|function| match function.kind {
        FunctionKind::Formula { frame: Frame::Fixed { origin, .. }, .. } => Some(origin),
        _ => None,
    });
    let tips = tips(cracks).map(|tip| cracks[tip.crack as usize].end_point(tip.end));
    let shown = Rect::new(-view.half(), view.half());
    let mut points = tips.chain(origins).filter(|&p| shown.contains(p - view.center));
    let infinite = |p: Vec2| quantity.at(&mut field.at(p), Vec2::ZERO, Side::Above).is_infinite();
    if points.any(infinite) {
        return Some(ConvergenceObstacle::Singular);
    }
    jumps(subject, SAME * size).then_some(ConvergenceObstacle::Jump)
}

/// Points of a segment at which its two sides are compared.
const STATIONS: u32 = 16;
/// Part of the largest value that two sides may differ by and still be the same.
const SAME: f64 = 1e-9;

/// True if the quantity differs by more than `least` between the sides of a crack in the view.
fn jumps(subject: &ResamplingSetup<'_>, least: f64) -> bool {
    let ResamplingSetup { field, view, quantity, .. } = *subject;
    if quantity.source() == Source::Partition {
        return false;
    }
    let shown = Rect::new(-view.half(), view.half());
    (0..).zip(&field.step.cracks).any(|(crack, c)| {
        (0..).zip(c.edges()).any(|(segment, edge)| {
            let seen = seen_parts(edge, view.center, &shown);
            seen.into_iter().flat_map(stations).any(|t| {
                let mut local = field.on(SegmentId { crack, segment }, edge.at(t));
                let [a, b] =
                    [Side::Above, Side::Below].map(|s| quantity.at(&mut local, Vec2::ZERO, s));
                (a - b).abs() > least
            })
        })
    })
}

/// Parts of the length of a range at which two sides are compared.
fn stations([from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
    (0..STATIONS).map(move |k| from + (to - from) * (f64::from(k) + 0.5) / f64::from(STATIONS))
}

/// The parts of the length of an edge in a box of offsets from an anchor.
fn seen_parts(edge: Edge, anchor: Vec2, shown: &Rect) -> Vec<[f64; 2]> {
    if edge.is_arc() {
        let local = AnchoredEdge::new(edge, anchor);
        let ([low, high], seen) = (local.range, local.within(shown));
        return seen.iter().map(|part| part.map(|s| (s - low) / (high - low))).collect();
    }
    let line = Line::through([edge.from - anchor, edge.to - anchor]);
    line.within(shown, [0.0, 1.0]).into_iter().collect()
}
