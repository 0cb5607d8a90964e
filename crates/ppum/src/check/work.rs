//! Bounds of the work of an evaluation at a point.
//!
//! A small file can say that a hundred thousand patches lie over each other. Every command
//! evaluates at points, so what a point takes is bounded here, once, and all others rely on it.

use super::errors::{Checked, fail};
use super::line::IntervalSums;
use super::ranks::{Ranks, in_order};
use crate::dataset::{BoxPartition, Dataset, FieldData, Step};
use crate::function::{FunctionTable, Slot};
use crate::mesh::{Clip, Mesh};
use crate::vec2::{Rect, Vec2, vec2};
use crate::weight::WeightFunction;

/// Most that an evaluation at a point may take: coefficients of the blocks of all patches that
/// cover it, operations of weights and functions, segments of cracks.
///
/// A patch of order 2 with jump and tip functions takes 50, one of order 8 some 500, and graded
/// covers have up to thirty patches over a point. A crack of 100,000 vertices may cut through.
const MOST_WORK: u64 = 1 << 18;

/// Cost of a patch beside its blocks: finding it, its weight.
const PATCH: usize = 16;

/// Checks every field of every step.
pub(super) fn check(dataset: &Dataset) -> Checked {
    for (k, step) in dataset.steps.iter().enumerate() {
        let table = FunctionTable::new(&step.functions, step.cracks.len(), &dataset.tables);
        let Ok(table) = table else { continue };
        for (f, field) in step.fields.iter().enumerate() {
            let mut parts = WorkGrid::new(step.partition.len(), &dataset.domain.bounds);
            each_work(step, field, &table, |part, work| parts.add(&part, work));
            if parts.most() <= MOST_WORK as i64 {
                continue;
            }
            let mut works = Vec::new();
            each_work(step, field, &table, |part, work| works.push((part, work)));
            let Some(at) = too_much(&works) else { continue };
            let place = format!("steps[{k}].fields[{f}]");
            let mistake = format!(
                "an evaluation at a point near ({}, {}) takes more than {MOST_WORK} coefficients of the patches that \
                 cover it, operations of their functions, and segments of cracks; let fewer patches overlap there, or \
                 give them fewer functions",
                at.x, at.y
            );
            return fail(&place, mistake);
        }
    }
    Ok(())
}

/// Visits the cost of each patch where it is, and of each group of functions where a patch has it.
fn each_work(
    step: &Step,
    field: &FieldData,
    table: &FunctionTable,
    mut visit: impl FnMut(Rect, u64),
) {
    let mut groups: Vec<Option<Rect>> = vec![None; table.groups()];
    let own = PATCH + weight(step.partition.boxes());
    for patch in 0..step.partition.len() {
        let support = step.partition.support(patch);
        let mut work = own + step.partition.mesh().map_or(0, |mesh| search(mesh, step, patch));
        for block in field.blocks(patch) {
            work += field.block_size(block) * field.components.len();
            if let Slot::Jet { group, .. } = table.of(field.block_function[block]) {
                let part = &mut groups[group as usize];
                *part = Some(part.map_or(support, |part| part.union(&support)));
            }
        }
        visit(support, work as u64);
    }
    for (group, part) in groups.into_iter().enumerate() {
        if let Some(part) = part {
            visit(part, table.cost(group, &step.cracks) as u64);
        }
    }
}

/// What it takes to see whether an element holds a point: inverting its map, and its clips.
fn search(mesh: &Mesh, step: &Step, patch: usize) -> usize {
    let level = |clip: &Clip| {
        let field = &step.fields[clip.field as usize];
        field.blocks(patch).map(|block| field.block_size(block)).sum::<usize>()
    };
    let levels: usize = mesh.clips(patch).iter().map(level).sum();
    mesh.search_work(patch) + levels
}

/// Operations of a weight, in both directions.
fn weight(partition: &BoxPartition) -> usize {
    match &partition.weight {
        WeightFunction::Formula(formula) => 2 * formula.jets().n_operations(),
        _ => 0,
    }
}

/// Most parts of the plane in each direction.
const PARTS: usize = 1 << 10;

/// Equal parts of the plane, about as many as there are patches, with the works of the boxes that
/// reach into each: at no point of a part there is more. Most covers are known to be fine by this.
struct WorkGrid {
    /// The changes of the sums from each part to the next in both directions, with a row and a
    /// column more at the end.
    changes: Vec<i64>,
    stride: usize,
    from: Vec2,
    scale: Vec2,
}

impl WorkGrid {
    fn new(patches: usize, bounds: &Rect) -> Self {
        let parts = patches.isqrt().clamp(1, PARTS);
        let (size, count, stride) = (bounds.size(), parts as f64, parts + 1);
        let scale = vec2(count / size.x, count / size.y);
        Self { changes: vec![0; stride * stride], stride, from: bounds.min, scale }
    }

    /// The column and the row of a point, the nearest of one beyond them.
    fn at(&self, p: Vec2) -> [usize; 2] {
        let last = self.stride - 2;
        let d = p - self.from;
        [d.x * self.scale.x, d.y * self.scale.y].map(|place| (place as usize).min(last))
    }

    fn add(&mut self, b: &Rect, work: u64) {
        let ([left, below], [right, above]) = (self.at(b.min), self.at(b.max));
        let work = work as i64;
        for (row, work) in [(below, work), (above + 1, -work)] {
            self.changes[row * self.stride + left] += work;
            self.changes[row * self.stride + right + 1] -= work;
        }
    }

    fn most(&self) -> i64 {
        let (mut before, mut most) = (vec![0; self.stride], 0);
        for row in self.changes.chunks_exact(self.stride) {
            let mut change = 0;
            for (sum, next) in before.iter_mut().zip(row) {
                change += next;
                *sum += change;
                most = most.max(*sum);
            }
        }
        most
    }
}

/// A point at which the works of the boxes over it are too much together; half-open boxes do not
/// touch. A line sweeps over the plane from left to right. O(n log n).
fn too_much(boxes: &[(Rect, u64)]) -> Option<Vec2> {
    let x = Ranks::new(boxes.iter().flat_map(|(b, _)| [b.min.x, b.max.x]), 0.0);
    let y = Ranks::new(boxes.iter().flat_map(|(b, _)| [b.min.y, b.max.y]), 0.0);
    let column = |at: f64| x.up_to(at) - 1;
    let row = |at: f64| y.up_to(at) as usize - 1;
    // what ends at a place goes before what begins there
    let keys = boxes.iter().flat_map(|(b, _)| [2 * column(b.min.x) + 1, 2 * column(b.max.x)]);
    let mut line = IntervalSums::new(y.len());
    for event in in_order(keys, 2 * x.len()) {
        let (b, work) = &boxes[event as usize / 2];
        let (at, work) =
            if event % 2 == 0 { (b.min.x, *work as i64) } else { (b.max.x, -(*work as i64)) };
        line.add(row(b.min.y), row(b.max.y), work);
        if line.most() > MOST_WORK as i64 {
            return Some(vec2(at, y.at(line.place() as u32)));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::tests::{dataset, place_after};
    use crate::crack::SegmentId;
    use crate::dataset::{Ring, TipIntensity};
    use crate::function::{Cut, FunctionKind, Part};
    use ppum_testkit::random::Random;

    /// The largest sum over the corners of boxes, among which its place must be.
    fn largest(boxes: &[(Rect, u64)]) -> u64 {
        let sum = |x: f64, y: f64| -> u64 {
            let holds = |b: &Rect| b.min.x <= x && x < b.max.x && b.min.y <= y && y < b.max.y;
            boxes.iter().filter(|(b, _)| holds(b)).map(|(_, work)| work).sum()
        };
        let corners = boxes.iter().flat_map(|(a, _)| boxes.iter().map(|(b, _)| (a.min.x, b.min.y)));
        corners.map(|(x, y)| sum(x, y)).max().unwrap_or(0)
    }

    #[test]
    fn the_largest_sum_is_found() {
        let mut random = Random(7);
        let mut found = 0;
        for n in [1, 2, 3, 10, 40] {
            for _ in 0..40 {
                let boxes: Vec<_> = (0..n)
                    .map(|k| {
                        // on a lattice, so that borders coincide
                        let (p, size) = (
                            vec2(random.unit(), random.unit()) * 8.0,
                            vec2(random.unit(), random.unit()) * 4.0,
                        );
                        let (p, size) =
                            (vec2(p.x.floor(), p.y.floor()), vec2(size.x.ceil(), size.y.ceil()));
                        (Rect::new(p, p + size), MOST_WORK / 3 + k)
                    })
                    .collect();
                let most = largest(&boxes);
                let told = too_much(&boxes);
                let mut parts =
                    WorkGrid::new(n as usize, &Rect::new(vec2(1.0, 0.0), vec2(8.0, 9.0)));
                boxes.iter().for_each(|(b, work)| parts.add(b, *work));
                assert!(parts.most() >= most as i64, "{boxes:?}");
                assert_eq!(told.is_some(), most > MOST_WORK, "{boxes:?}");
                if let Some(at) = told {
                    let over = boxes.iter().filter(|(b, _)| {
                        b.min.x <= at.x && at.x < b.max.x && b.min.y <= at.y && at.y < b.max.y
                    });
                    assert!(over.map(|(_, work)| work).sum::<u64>() > MOST_WORK, "{boxes:?}");
                    found += 1;
                }
            }
        }
        assert!((20..180).contains(&found), "{found}");
    }

    /// What lies in one part is added up, and nothing else.
    #[test]
    fn sums_of_parts() {
        let mut parts = WorkGrid::new(16, &Rect::new(vec2(0.0, 0.0), vec2(4.0, 4.0)));
        let mut add = |x0, y0, x1, y1, work| {
            parts.add(&Rect::new(vec2(x0, y0), vec2(x1, y1)), work);
            parts.most()
        };
        assert_eq!(add(0.5, 0.5, 1.5, 1.5, 10), 10);
        assert_eq!(add(2.1, 2.1, 9.0, 9.0, 7), 10);
        assert_eq!(add(3.5, 3.5, 3.6, 3.6, 4), 11);
        assert_eq!(add(-9.0, -9.0, 0.1, 0.1, 5), 15);
        assert_eq!(add(f64::NEG_INFINITY, 1.2, f64::INFINITY, 1.3, 20), 30);
    }

    /// Blocks share no coefficients, and what could be multiplied by something else has a limit.
    #[test]
    fn sizes_that_multiply_have_limits() {
        let twice = |d: &mut Dataset| {
            let field = &mut d.steps[0].fields[0];
            field.block_offset.fill(0);
            field.coefficients.iter_mut().for_each(|component| component.truncate(3));
        };
        assert_eq!(place_after(twice), "steps[0].fields[0].block_offset[1]");
        let components = |d: &mut Dataset| {
            let field = &mut d.steps[0].fields[0];
            field.name = "values".into();
            field.components = (0..65).map(|k| format!("v{k}")).collect();
            field.coefficients = vec![field.coefficients[0].clone(); 65];
        };
        assert_eq!(place_after(components), "steps[0].fields[0].components");
        let rings = |d: &mut Dataset| {
            let ring = Ring { r1: 0.0, r2: 1.0, k1: 1.0, k2: 0.0 };
            let TipIntensity { rings, .. } = &mut d.steps[0].intensities[0];
            *rings = vec![ring; 65];
        };
        assert_eq!(place_after(rings), "steps[0].intensities[0].rings");
    }

    /// Cuts of components count one by one, whatever patch has them.
    #[test]
    fn cuts_are_counted() {
        let with = |n: usize| {
            let mut data = dataset();
            let segment = SegmentId { crack: 0, segment: 0 };
            let cut =
                |k: usize| Cut { segment, left: Part::Outside, right: Part::Cut(k as u32 + 1) };
            let mut cuts: Vec<_> = (0..n).map(cut).collect();
            cuts[n - 1].right = Part::Inside;
            data.steps[0].functions[1].kind = FunctionKind::Component { cuts };
            check(&data)
        };
        assert_eq!(with(1 << 17), Ok(()));
        assert_eq!(with(1 << 18).expect_err("too many").place, "steps[0].fields[0]");
    }

    /// Patches over a point: as many as a graded cover has, and far more.
    #[test]
    fn patches_that_overlap_are_counted() {
        let piled = |n: usize| {
            let mut data = dataset();
            let step = &mut data.steps[0];
            let (partition, field) =
                (step.partition.boxes_mut().expect("boxes"), &mut step.fields[0]);
            partition.center = vec![partition.center[0]; n];
            partition.half = vec![partition.half[0]; n];
            partition.origin = vec![partition.origin[0]; n];
            partition.scale = vec![partition.scale[0]; n];
            partition.cell = vec![partition.cell[0]; n];
            partition.level = vec![0; n];
            partition.point = vec![None; n];
            step.attributes.clear();
            let last = field.patch_blocks[1];
            field.patch_blocks.resize(n + 1, last);
            check(&data)
        };
        assert_eq!(piled(1000), Ok(()));
        let error = piled(1 << 15).expect_err("too many");
        assert_eq!(error.place, "steps[0].fields[0]");
        assert!(error.mistake.contains("let fewer patches overlap there"), "{error}");
    }
}
