//! A field as triangles for programs that interpolate, such as ParaView, to a tolerance.
//!
//! [`resolve`] makes a mesh on which interpolation, linear or of a higher [order](Accuracy::order),
//! differs from the field by no more than a given part of the range of each [`PointArray`];
//! [`vtu::write`] and [`vtkhdf::file`] write it. No triangle crosses a crack, a rim or a line on
//! which stresses jump, and a vertex there has a point on each side (`torn`). The accuracy reached,
//! [`MeasuredAccuracy`], is measured at random points that had no part in refinement.
//!
//! Near a tip stresses grow without bound, and no mesh resolves them: there the tolerance holds
//! outside of a radius, R, in which it is loosened as R/r down to R/100.

mod arcs;
mod arrays;
mod average;
mod borders;
mod elements;
mod grid;
mod lagrange;
mod measure;
mod refine;
mod revolve;
mod singular;
mod torn;
pub mod vtkhdf;
pub mod vtp;
pub mod vtu;

use std::slice::Chunks;

use ppum::field::Field;
use ppum::function::{Frame, FunctionKind};
use ppum::progress::{Cancelled, Watcher};
use ppum::sample::SidedPoint;
use ppum::segment;
use ppum::text::short;
use ppum::vec2::Vec2;
use ppum_solve::triangulation::NotFinite;

use arcs::with_polygons;
use arrays::ArrayColumns;
pub use arrays::PointArray;
use borders::{ExportSegment, LineRequest, SAME, borders, crossings, longest};
use elements::{ElementPlace, evaluate_elements};
use lagrange::{Lagrange, node_count};
pub use measure::RANDOM_POINTS;
use refine::{Limits, RefinedMesh};
use singular::SingularPoints;
use torn::{Torn, TornPoint, ValueSide};

/// The required accuracy of a mesh, and its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Largest difference in parts of the range of an array, outside of singular points; positive.
    pub tolerance: f64,
    /// The radius about singular points within which infinite quantities are not resolved; by
    /// default a fiftieth of the crack's length or of the distance from other borders.
    pub radius: Option<f64>,
    /// Most triangles.
    pub cells: usize,
    /// The degree of the polynomials in triangles, 1 to [`HIGHEST_ORDER`].
    pub order: u8,
    /// True if triangles share their points where quantities jump, with the mean of their values,
    /// except for cracks and interfaces of the material.
    pub average: bool,
}

impl Default for Accuracy {
    fn default() -> Self {
        Self { tolerance: 1e-3, radius: None, cells: 1_000_000, order: 1, average: false }
    }
}

/// The highest order of triangles: polynomials between equidistant nodes oscillate with their
/// degree.
pub const HIGHEST_ORDER: u8 = 4;

/// Measurements that may each be followed by more refinement, where they find a difference that
/// refinement has not seen; so many in a row that find none end them.
const ROUNDS: u64 = 32;
const QUIET_ROUNDS: u64 = 3;

/// A mesh that resolves a field.
#[derive(Clone, Debug)]
pub struct ExportMesh {
    /// Points: of a vertex on a crack one for each side.
    pub points: Vec<Vec2>,
    /// Where the field's values at the points were taken.
    pub places: Vec<SidedPoint>,
    /// The points of the triangles, [`ExportMesh::triangles`] one after the other.
    pub cells: Vec<u32>,
    /// A row for each point, of the quantities of all arrays.
    pub values: Vec<f64>,
    /// The arrays, and how well they are resolved.
    pub arrays: Vec<MeasuredAccuracy>,
    /// Points at which quantities are infinite.
    pub singular: Vec<Vec2>,
    /// The tolerance of infinite quantities holds outside of these radii about them.
    pub radii: Vec<f64>,
    /// The required accuracy.
    pub accuracy: Accuracy,
    /// False if the limit of triangles ended the refinement.
    pub is_complete: bool,
    /// A place where values jump within triangles, which no edges follow: there smaller ones are no
    /// better.
    pub jump: Option<Vec2>,
}

/// The times that steps are shown at: their loads where these increase, else their numbers.
#[must_use]
pub fn times(loads: &[f64]) -> Vec<f64> {
    let increase = loads.windows(2).all(|pair| pair[0] < pair[1]);
    if increase { loads.to_vec() } else { (0..loads.len()).map(|step| step as f64).collect() }
}

impl ExportMesh {
    /// In words, with what is allowed and what was found, that the tolerance is not kept; `None` if
    /// it is.
    #[must_use]
    pub fn complaint(&self) -> Option<String> {
        let numbers = |m: &MeasuredAccuracy| {
            let [found, allowed] = [m.unaveraged, m.allowed].map(short);
            format!("{} differs by up to {found}, {allowed} is allowed", m.array.name)
        };
        let missed = self.arrays.iter().filter(|m| !m.is_kept());
        let missed: Vec<String> = missed.map(numbers).collect();
        let limit = match self.is_complete {
            true => String::new(),
            false => format!("the limit of {} triangles is reached, and ", self.accuracy.cells),
        };
        let jump = self.jump.map_or(String::new(), |p| {
            let [x, y] = [p.x, p.y].map(short);
            format!(
                "; values jump within triangles, as at ({x}, {y}), along lines that no edges follow"
            )
        });
        let text = format!("{limit}the tolerance is not kept: {}{jump}", missed.join("; "));
        (!missed.is_empty()).then_some(text)
    }

    /// Bytes of memory, nearly.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let points = self.points.len() * (size_of::<Vec2>() + size_of::<SidedPoint>());
        points + size_of_val(&*self.cells) + size_of_val(&*self.values)
    }

    /// The points of each triangle, in VTK's order: corners, counter-clockwise, and those of higher
    /// orders, first on the edges, then inside.
    pub fn triangles(&self) -> Chunks<'_, u32> {
        self.cells.chunks(node_count(self.accuracy.order))
    }

    /// The values of an array by its number: a row of its components for each point, zero where
    /// one has no quantity.
    #[must_use]
    pub fn values_of(&self, number: usize) -> Vec<f64> {
        let quantities = |a: &MeasuredAccuracy| a.array.quantities().count();
        let width: usize = self.arrays.iter().map(quantities).sum();
        let mut column = self.arrays[..number].iter().map(quantities).sum();
        let columns: Vec<Option<usize>> = (self.arrays[number].array.components.iter())
            .map(|(_, quantity)| {
                let own = quantity.as_ref().map(|_| column);
                column += usize::from(own.is_some());
                own
            })
            .collect();
        let rows = self.values.chunks(width.max(1));
        rows.flat_map(|row| columns.iter().map(|c| c.map_or(0.0, |c| row[c]))).collect()
    }
}

/// How well an array is resolved.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredAccuracy {
    /// The array.
    pub array: PointArray,
    /// The unit of its components, empty where there is none.
    pub unit: String,
    /// Largest minus smallest value, of components the widest; of infinite quantities outside of
    /// the radius.
    pub range: f64,
    /// The tolerance in units of the array.
    pub allowed: f64,
    /// Largest difference of interpolation and field at [`RANDOM_POINTS`] random points.
    pub largest: f64,
    /// Share of these points that are within the tolerance.
    pub share: f64,
    /// The largest difference before values were averaged.
    pub unaveraged: f64,
    /// True if the array is infinite at a singular point.
    pub is_singular: bool,
}

impl MeasuredAccuracy {
    /// True if no difference is larger than allowed; what averages add does not count.
    #[must_use]
    pub fn is_kept(&self) -> bool {
        self.unaveraged <= self.allowed
    }
}

/// A field that cannot be exported.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// A coordinate is not finite.
    #[error(transparent)]
    NotFinite(#[from] NotFinite),
    /// Stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// A radius about singular points that holds all of the domain.
    #[error(
        "the radius {radius} about singular points is not smaller than the domain, {longest}, and leaves nothing to resolve"
    )]
    Radius {
        /// The radius.
        radius: f64,
        /// The longer side of the domain.
        longest: f64,
    },
    /// An order that triangles cannot have.
    #[error("triangles have an order of 1 to {HIGHEST_ORDER}, not {0}")]
    Order(u8),
    /// The borders alone take more triangles.
    #[error("{needed} triangles are needed along borders alone, more than the {limit} allowed")]
    Cells {
        /// Triangles between the borders.
        needed: usize,
        /// The limit.
        limit: usize,
    },
}

/// Refines triangles of the domain until interpolation resolves all arrays.
///
/// # Errors
/// See [`ExportError`]; a limit that is met later is told by [`ExportMesh::is_complete`].
pub fn resolve(
    field: &Field<'_>,
    arrays: &[PointArray],
    accuracy: &Accuracy,
    watcher: &dyn Watcher,
) -> Result<ExportMesh, ExportError> {
    if !(1..=HIGHEST_ORDER).contains(&accuracy.order) {
        return Err(ExportError::Order(accuracy.order));
    }
    let longest = longest(&field.domain.bounds);
    if let Some(radius) = accuracy.radius.filter(|&radius| radius >= longest) {
        return Err(ExportError::Radius { radius, longest });
    }
    let columns = ArrayColumns::new(arrays);
    let mut refined = RefinedMesh {
        field,
        mesh: begin(field, LineRequest { jumps: columns.any_jumps(), order: accuracy.order })?,
        values: Vec::new(),
        singular: SingularPoints::new(field, &columns, accuracy.radius),
        ranges: vec![[f64::INFINITY, f64::NEG_INFINITY]; columns.len()],
        differences: Vec::new(),
        limits: Limits { tolerance: accuracy.tolerance, cells: accuracy.cells },
        columns: &columns,
        cell: Lagrange::new(accuracy.order),
    };
    let needed = refined.mesh.triangles.len();
    if needed > accuracy.cells {
        return Err(ExportError::Cells { needed, limit: accuracy.cells });
    }
    refined.add_level_tips(accuracy.radius);
    let is_complete = refined.run(watcher)?;
    Ok(refined.finished(arrays, accuracy, is_complete))
}

/// The triangles between all borders, or of all elements. Without lines in patches, cells have
/// points too: the field varies on their scale.
fn begin<'d>(field: &Field<'d>, lines: LineRequest) -> Result<Torn<'d>, NotFinite> {
    if let Some(mesh) = field.step.partition.mesh() {
        return Ok(Torn::of_elements(field, mesh));
    }
    let domain = with_polygons(field.domain);
    let all = borders(field, &domain, lines);
    let has_lines = all.iter().any(|border| border.kind.is_line);
    let points = if has_lines { crossings(&all) } else { points_of_cells(field, &all) };
    Torn::new(field, &domain, &all, &points)
}

/// Corners and middles of cells, or of supports where there are none, except for those on borders
/// and nearly there.
fn points_of_cells(field: &Field<'_>, borders: &[ExportSegment]) -> Vec<Vec2> {
    let near = SAME * longest(&field.domain.bounds);
    let is_apart = |p: &Vec2| {
        field.domain.contains(*p) && borders.iter().all(|b| segment::distance(b.ends, *p) > near)
    };
    let cells = field.step.partition.cells();
    let points = cells.iter().flat_map(|cell| [cell.min, cell.center(), cell.max]);
    points.filter(is_apart).collect()
}

impl RefinedMesh<'_, '_> {
    /// Refines, measures, and refines where the measurement has found more. False if the limit of
    /// triangles is met.
    fn run(&mut self, watcher: &dyn Watcher) -> Result<bool, Cancelled> {
        self.evaluate_new();
        let mut fresh = (0..self.mesh.triangles.len() as u32).collect();
        let mut quiet = 0;
        for round in 0..ROUNDS {
            if !self.refine(fresh, watcher)? {
                return Ok(false);
            }
            let failed = self.measure(round, None).failed;
            quiet = if failed.is_empty() { quiet + 1 } else { 0 };
            if quiet == QUIET_ROUNDS {
                break;
            }
            let Some(changed) = self.bisect(&failed) else { return Ok(false) };
            fresh = changed;
        }
        Ok(true)
    }

    /// The mesh, measured at points that have not been used before.
    fn finished(
        mut self,
        arrays: &[PointArray],
        accuracy: &Accuracy,
        is_complete: bool,
    ) -> ExportMesh {
        let mut cells = self.mesh.add_nodes(&self.cell);
        self.evaluate_new();
        self.fill(&cells);
        let allowed = self.allowed();
        let torn = self.measure(ROUNDS, Some(&cells));
        let together = accuracy.average.then(|| self.together(&cells));
        let found = match &together {
            Some(together) => {
                self.average(together);
                self.measure(ROUNDS, Some(&cells))
            }
            None => torn.clone(),
        };
        let measured = |(number, array): (usize, &PointArray)| {
            let of: Vec<usize> =
                (0..allowed.len()).filter(|&c| self.columns.array[c] == number).collect();
            let most =
                |value: &dyn Fn(usize) -> f64| of.iter().map(|&c| value(c)).fold(0.0, f64::max);
            MeasuredAccuracy {
                array: array.clone(),
                unit: array.quantities().next().map_or("", |q| q.unit(self.field)).to_owned(),
                range: most(&|c| (self.ranges[c][1] - self.ranges[c][0]).max(0.0)),
                allowed: most(&|c| allowed[c]),
                largest: most(&|c| found.largest[c]),
                share: 1.0 - most(&|c| 1.0 - found.share[c]),
                unaveraged: most(&|c| torn.largest[c]),
                is_singular: of.iter().any(|&c| self.singular.columns[c]),
            }
        };
        let measured = arrays.iter().enumerate().map(measured).collect();
        let jump =
            self.mesh.triangles.iter().position(|triangle| triangle.convergence.has_stalled());
        let jump = jump.map(|t| self.position(t as u32, [1.0 / 3.0; 3]));
        if let Some(together) = together {
            self.share_points(&together, &mut cells);
        }
        ExportMesh {
            arrays: measured,
            points: self.mesh.points.iter().map(|point| point.position).collect(),
            places: self.mesh.points.iter().map(TornPoint::place).collect(),
            cells,
            values: self.values,
            singular: self.singular.points,
            radii: self.singular.radii,
            accuracy: *accuracy,
            is_complete,
            jump,
        }
    }
}

#[cfg(test)]
mod tests;

impl RefinedMesh<'_, '_> {
    /// Adds tips to the singular points: they are corners of the pieces of elements.
    pub(super) fn add_level_tips(&mut self, radius: Option<f64>) {
        let levels = |kind: &FunctionKind| {
            matches!(kind, FunctionKind::Formula { frame: Frame::Levels(_), .. })
        };
        if !self.field.step.functions.iter().any(|f| levels(&f.kind)) {
            return;
        }
        let place = |point: &TornPoint| match point.seen {
            ValueSide::Element(place) => Some(ElementPlace { inner: place.at, ..place }),
            ValueSide::Plane { .. } => None,
        };
        let places: Vec<_> = self.mesh.points.iter().filter_map(place).collect();
        let rows = evaluate_elements(self.field, &self.columns.quantities, &places);
        for (point, row) in self.mesh.points.iter().zip(rows.chunks(self.columns.len())) {
            self.singular.add(self.field, point.position, row, radius);
        }
    }
}
