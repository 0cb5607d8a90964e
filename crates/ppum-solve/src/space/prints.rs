//! What a space has in common with an earlier one, cell by cell: what integrals there are the same
//! to the last bit.
//!
//! A *print* of a cell is a digest of all that its quadrature and the plain functions on it depend
//! on: the patches that cover it, their functions, and of cracks what lies near. Where a crack
//! grows far away the print stays what it was, so that of a series most of what a step has
//! integrated serves the next. Digests have 128 bits: that two of a million cells have one by
//! chance is as likely as 1 in 10²⁶.

use super::Space;
use crate::geometry::{distance, meets};
use ppum::crack::Crack;
use ppum::function::{Cut, Frame, Function, FunctionKind, WESTERGAARD};
use ppum::segment;
use ppum::vec2::{Rect, Vec2, vec2};
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::collections::hash_map::{DefaultHasher, HashMap};
use std::hash::Hasher;

/// A digest.
type Print = [u64; 2];

/// The prints of the cells of a space.
#[derive(Debug)]
pub(crate) struct Prints {
    cells: Vec<(Rect, Print)>,
    /// Of each patch, the cells that its support meets.
    covered: Vec<Vec<u32>>,
}

/// Of each patch of a space the patch of an earlier space that it is, if their functions are the
/// same on the same cells. The order of these patches, and of their cells, is the same in
/// both spaces.
#[derive(Clone, Debug)]
pub(crate) struct Unchanged(Vec<Option<u32>>);

/// The word by which a formula asks for the side of a crack.
const SIDE: &str = "side";

/// Segments farther away than another one by this factor are not the nearest to any point of a
/// cell, and no tie.
const NEAR: f64 = 1.01;

/// Part of a cell's size by which its box is larger where ends of cracks are looked for.
const SLACK: f64 = 1e-6;

impl Prints {
    /// The prints of a space.
    #[must_use]
    pub(crate) fn new(space: &Space<'_>) -> Self {
        let printer = Printer::new(space);
        let cells = &space.partition().cell;
        let print = |cell: usize| (cells[cell], printer.cell(cell));
        let mut covered = vec![Vec::new(); cells.len()];
        for (cell, coverers) in (0..).zip(&space.coverers) {
            coverers.iter().for_each(|&patch| covered[patch as usize].push(cell));
        }
        Self { cells: (0..cells.len()).into_par_iter().map(print).collect(), covered }
    }

    /// What is as it was in an earlier space.
    #[must_use]
    pub(crate) fn unchanged(&self, earlier: &Self) -> Unchanged {
        let bits = |cell: &Rect| [cell.min.x, cell.min.y, cell.max.x, cell.max.y].map(f64::to_bits);
        let known = (0..).zip(&earlier.cells).map(|(k, (cell, _))| (bits(cell), k));
        let known: HashMap<_, u32> = known.collect();
        let same = |(cell, print): &(Rect, Print)| {
            let k = *known.get(&bits(cell))?;
            (earlier.cells[k as usize].1 == *print).then_some(k)
        };
        let same: Vec<_> = self.cells.iter().map(same).collect();
        let patch = |(own, cells): (&Option<u32>, &Vec<u32>)| {
            let were = &earlier.covered[(*own)? as usize];
            let are = cells.iter().map(|&cell| same[cell as usize]);
            (were.len() == cells.len() && are.eq(were.iter().copied().map(Some))).then_some((*own)?)
        };
        Unchanged::in_order(same.iter().zip(&self.covered).map(patch).collect())
    }
}

impl Unchanged {
    /// Nothing is as it was where the order is another one: sums would have other bits.
    fn in_order(patches: Vec<Option<u32>>) -> Self {
        let is_in_order = patches.iter().flatten().is_sorted_by(|a, b| a < b);
        Self(if is_in_order { patches } else { vec![None; patches.len()] })
    }

    /// The earlier patch that a patch is.
    #[must_use]
    pub(crate) fn patch(&self, patch: usize) -> Option<usize> {
        self.0[patch].map(|earlier| earlier as usize)
    }

    /// True if all of some patches are as they were.
    #[must_use]
    pub(crate) fn all(&self, patches: &[u32]) -> bool {
        patches.iter().all(|&patch| self.0[patch as usize].is_some())
    }

    /// The same without the patches, given with what they were, of which something is not true, and
    /// without those that share a cell with one that is not as it was.
    #[must_use]
    pub(crate) fn filter(
        mut self,
        coverers: &[Vec<u32>],
        holds: impl Fn(usize, usize) -> bool,
    ) -> Self {
        for (patch, earlier) in self.0.iter_mut().enumerate() {
            *earlier = earlier.filter(|&earlier| holds(patch, earlier as usize));
        }
        let mixed: Vec<_> = coverers.iter().filter(|patches| !self.all(patches)).collect();
        mixed.into_iter().flatten().for_each(|&patch| self.0[patch as usize] = None);
        self
    }
}

/// Two hashes of one sequence of words.
#[derive(Clone)]
struct Digest([DefaultHasher; 2]);

impl Digest {
    fn new() -> Self {
        let mut both = [DefaultHasher::new(), DefaultHasher::new()];
        both[1].write_u64(1);
        Self(both)
    }

    fn word(&mut self, word: u64) {
        self.0.iter_mut().for_each(|hasher| hasher.write_u64(word));
    }

    fn print(&mut self, print: Print) {
        print.into_iter().for_each(|word| self.word(word));
    }

    fn points(&mut self, points: impl IntoIterator<Item = Vec2>) {
        for p in points {
            self.word(p.x.to_bits());
            self.word(p.y.to_bits());
        }
    }

    fn text(&mut self, text: &str) {
        self.0.iter_mut().for_each(|hasher| hasher.write(text.as_bytes()));
        self.word(text.len() as u64);
    }

    fn finish(&self) -> Print {
        [self.0[0].finish(), self.0[1].finish()]
    }
}

/// Makes the prints of a space's cells.
struct Printer<'a> {
    space: &'a Space<'a>,
    /// What all cells have in common.
    common: Digest,
    /// Of each function, what it is; none of the sides of cracks, which are looked at cell by cell.
    functions: Vec<Option<Print>>,
    /// Longer than any way in the domain.
    reach: f64,
}

impl<'a> Printer<'a> {
    fn new(space: &'a Space<'a>) -> Self {
        let (mut common, partition) = (Digest::new(), space.partition());
        common.text(&format!("{:?} {:?}", space.orders, partition.weight));
        let domain = partition.cell.iter().copied().reduce(|a, b| a.union(&b));
        let reach = domain.map_or(0.0, |domain| 4.0 * domain.size().length());
        let functions = space.step().functions.iter();
        let functions = functions.map(|function| of_function(function, space)).collect();
        Self { space, common, functions, reach }
    }

    fn cell(&self, cell: usize) -> Print {
        let Self { space, .. } = *self;
        let (mut digest, mut sides) = (self.common.clone(), BTreeSet::new());
        let (rect, coverers) = (&space.partition().cell[cell], &space.coverers[cell]);
        digest.points([rect.min, rect.max]);
        for &patch in coverers {
            digest.word(u64::from(patch as usize == cell));
            self.patch(patch as usize, &mut digest, &mut sides);
        }
        for crack in sides {
            self.side(crack, rect, &mut digest);
        }
        self.cuts(rect, &mut digest);
        digest.finish()
    }

    fn patch(&self, patch: usize, digest: &mut Digest, sides: &mut BTreeSet<u32>) {
        let (partition, data) = (self.space.partition(), self.space.data());
        digest.points([partition.center[patch], partition.half[patch]]);
        digest.points([partition.origin[patch], partition.scale[patch]]);
        digest.word(data.blocks(patch).len() as u64);
        for block in data.blocks(patch) {
            let function = data.block_function[block] as usize;
            digest.word(u64::from(data.block_degree[block]));
            digest.word(self.space.shifts[block].to_bits());
            match (&self.functions[function], &self.space.step().functions[function].kind) {
                (Some(print), _) => digest.print(*print),
                (None, FunctionKind::Side { crack }) => {
                    digest.word(u64::from(*crack));
                    sides.insert(*crack);
                }
                (None, _) => {}
            }
        }
    }

    /// What decides the side of a crack in a cell: of its segments, the first and the last of which
    /// go on for ever, those that may be nearest to a point there.
    fn side(&self, crack: u32, rect: &Rect, digest: &mut Digest) {
        let points = &self.space.step().cracks[crack as usize].points;
        let segments = || points.windows(2).map(|s| [s[0], s[1]]);
        let ways = segments().map(|s| segment::distance(s, rect.center()));
        let farthest = ways.fold(f64::INFINITY, f64::min) + 0.5 * rect.size().length();
        let near = NEAR * farthest;
        let grown = Rect::new(rect.min - vec2(near, near), rect.max + vec2(near, near));
        let is_near = |segment| overlaps(segment, &grown) && distance(segment, rect) <= near;
        let last = points.len() - 2;
        for (k, segment @ [a, b]) in segments().enumerate() {
            let ahead = (b - a).unit() * self.reach;
            let goes_on = [k == 0 && is_near([a, a - ahead]), k == last && is_near([b, b + ahead])];
            if is_near(segment) || goes_on.contains(&true) {
                digest.points(segment);
                goes_on.into_iter().for_each(|goes_on| digest.word(goes_on.into()));
            }
        }
    }

    /// The segments of cracks that cut a cell, and which of their ends are ends of the crack in
    /// the cell.
    fn cuts(&self, rect: &Rect, digest: &mut Digest) {
        let slack = rect.size() * SLACK;
        let near = Rect::new(rect.min - slack, rect.max + slack);
        for Crack { points, .. } in &self.space.step().cracks {
            let last = points.len() - 2;
            for (k, s) in points.windows(2).enumerate() {
                let segment = [s[0], s[1]];
                if overlaps(segment, &near) && meets(segment, &near) {
                    let ends = [k == 0 && near.contains(s[0]), k == last && near.contains(s[1])];
                    digest.points(segment);
                    ends.into_iter().for_each(|end| digest.word(end.into()));
                }
            }
        }
    }
}

/// True if the box of a segment meets a box.
fn overlaps([a, b]: [Vec2; 2], rect: &Rect) -> bool {
    let (min, max) = (a.min(b), a.max(b));
    min.x <= rect.max.x && max.x >= rect.min.x && min.y <= rect.max.y && max.y >= rect.min.y
}

/// What a function is, with all that it looks at; none of the side of a crack.
fn of_function(function: &Function, space: &Space<'_>) -> Option<Print> {
    let (mut digest, cracks) = (Digest::new(), &space.step().cracks);
    match &function.kind {
        FunctionKind::One => {}
        FunctionKind::Side { .. } => return None,
        FunctionKind::Component { cuts } => {
            cuts.iter().for_each(|cut| of_cut(cut, cracks, &mut digest))
        }
        FunctionKind::Formula { text, frame, .. } => {
            digest.text(&format!("{:?}", function.kind));
            if !WESTERGAARD.contains(&text.as_str()) {
                // how fast a formula grows at a point is measured in units of the smallest patch
                let halves = space.partition().half.iter().map(|half| half.x.min(half.y));
                digest.word(halves.fold(f64::INFINITY, f64::min).to_bits());
            }
            let sees = |crack: usize| match frame {
                Frame::Tip(tip) if tip.crack as usize == crack => true,
                _ => text.contains(SIDE),
            };
            let seen = cracks.iter().enumerate().filter(|(k, _)| sees(*k));
            seen.for_each(|(_, crack)| digest.points(crack.points.iter().copied()));
        }
        other => {
            digest.text(&format!("{other:?}"));
            cracks.iter().for_each(|crack| digest.points(crack.points.iter().copied()));
        }
    }
    Some(digest.finish())
}

/// A cut by the line of a segment, wherever that stands in its crack.
fn of_cut(cut: &Cut, cracks: &[Crack], digest: &mut Digest) {
    let points = &cracks[cut.segment.crack as usize].points;
    let k = cut.segment.segment as usize;
    digest.points([points[k], points[k + 1]]);
    digest.text(&format!("{:?} {:?}", cut.left, cut.right));
}
