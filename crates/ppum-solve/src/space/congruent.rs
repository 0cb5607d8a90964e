//! Finds the cells of a space that are alike.

use super::congruence::{CongruentCell, CongruentCells, PatchKind, ReferenceCell};
use super::trial::TrialSpace;
use ppum::dataset::{BoxPartition, FieldData, Step};
use ppum::function::{Function, FunctionKind};
use ppum::vec2::{Rect, Vec2, vec2};
use rayon::prelude::*;
use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::OnceLock;

/// Parts of a cell's size that its measures are rounded to: fine enough that boundaries of patches
/// that coincide still do for quadrature, coarse enough for the rounding of coordinates.
const PARTS: f64 = (1_u64 << 42) as f64;

/// Measures that are not a small multiple of the cell's size are not rounded, but left to the
/// cells themselves.
const LARGEST: f64 = 1e3;

/// Cells that are measured at once.
const AT_ONCE: usize = 4096;

/// Bits of the cell's size that are rounded away.
const SIZE_BITS: u64 = 12;

impl CongruentCells {
    pub(super) fn new(space: &TrialSpace<'_>) -> Self {
        let mut alike = Self::of_cells(space);
        alike.kinds.par_iter_mut().for_each(|kind| kind.find_rules(space));
        alike.find_patches(space);
        alike
    }

    /// The kinds in the order of their measures.
    fn of_cells(space: &TrialSpace<'_>) -> Self {
        let quadrature = space.quadrature(0);
        let mut known: HashMap<Vec<i64>, u32> = HashMap::new();
        let measured = |cell: usize| {
            quadrature.is_whole(space.cell(cell)).then(|| measures(space, cell)).flatten()
        };
        let mut numbered = |(measures, patches): (Vec<i64>, Vec<u32>)| {
            let new = known.len() as u32;
            CongruentCell { kind: *known.entry(measures).or_insert(new), patches }
        };
        let (n, mut cells) = (space.partition().len(), Vec::new());
        for first in (0..n).step_by(AT_ONCE) {
            let some: Vec<_> =
                (first..n.min(first + AT_ONCE)).into_par_iter().map(measured).collect();
            cells.extend(some.into_iter().map(|cell| cell.map(&mut numbered)));
        }
        let mut all: Vec<(Vec<i64>, u32)> = known.into_iter().collect();
        all.sort_unstable();
        let mut place = vec![0; all.len()];
        (0..).zip(&all).for_each(|(new, (_, old))| place[*old as usize] = new);
        cells.iter_mut().flatten().for_each(|member| member.kind = place[member.kind as usize]);
        let kind = |(measures, _)| ReferenceCell { measures, rules: Vec::new() };
        Self { kinds: all.into_iter().map(kind).collect(), cells, ..Self::default() }
    }

    fn find_patches(&mut self, space: &TrialSpace<'_>) {
        let n = space.partition().len();
        let (mut seats, mut is_whole) = (vec![PatchKind::new(); n], vec![true; n]);
        for (member, covering_patches) in self.cells.iter().zip(&space.covering_patches) {
            match member {
                None => covering_patches.iter().for_each(|&patch| is_whole[patch as usize] = false),
                Some(CongruentCell { kind, patches }) => (0..)
                    .zip(patches)
                    .for_each(|(seat, &patch)| seats[patch as usize].push((*kind, seat))),
            }
        }
        let mut known: HashMap<PatchKind, u32> = HashMap::new();
        let kind = |(mut seats, is_whole): (PatchKind, bool)| {
            seats.sort_unstable();
            let new = known.len() as u32;
            is_whole.then(|| *known.entry(seats).or_insert(new))
        };
        self.patches = seats.into_iter().zip(is_whole).map(kind).collect();
        let mut all: Vec<_> = known.into_iter().collect();
        all.sort_unstable_by_key(|(_, kind)| *kind);
        self.patch_kinds = all.into_iter().map(|(seats, _)| seats).collect();
    }
}

impl ReferenceCell {
    fn find_rules(&mut self, like: &TrialSpace<'_>) {
        let space = self.space(like);
        let quadrature = space.quadrature(0);
        self.rules = quadrature.cell(space.cell(0));
    }

    /// The space of the cell at the origin and its patches, with the quadrature of another one: its
    /// first cell is the one, and its patches, which all cover it, stand in the order of their
    /// local indices.
    pub(crate) fn space<'d>(&self, like: &TrialSpace<'d>) -> TrialSpace<'d> {
        let (size, seats) = self.measures.split_at(2);
        let size = vec2(f64::from_bits(size[0] as u64), f64::from_bits(size[1] as u64));
        let cell = Rect::around(Vec2::ZERO, size * 0.5);
        let seats: Vec<_> = seats.chunks_exact(CellPatch::NUMBERS).map(CellPatch::of).collect();
        let n = seats.len();
        let all = |of: fn(&CellPatch) -> [i64; 2]| -> Vec<Vec2> {
            let length = |parts: [i64; 2]| parts.map(|parts| parts as f64 / PARTS);
            let seen = |[x, y]: [f64; 2]| vec2(x * size.x, y * size.y);
            seats.iter().map(|seat| seen(length(of(seat)))).collect()
        };
        let partition = BoxPartition {
            weight: like.partition().weight.clone(),
            center: all(|seat| seat.center),
            half: all(|seat| seat.half),
            origin: all(|seat| seat.origin),
            scale: all(|seat| seat.scale),
            cell: vec![cell; n],
            level: vec![0; n],
            point: vec![None; n],
            points: Vec::new(),
        };
        let components: Vec<&str> = like.data().components.iter().map(String::as_str).collect();
        let mut data = FieldData::new(&like.data().name, &components);
        seats.iter().for_each(|seat| data.push_patch(&[(0, seat.degree)]));
        let mut step = Step::new(partition).with_field(data);
        step.functions = vec![Function { name: "one".into(), kind: FunctionKind::One }];
        let (equation, every) = (like.equation(), vec![(0..n as u32).collect()]);
        let mut space = TrialSpace::of_cells(Cow::Owned(step), (equation, &[]), every, like.orders)
            .expect("the constant one compiles");
        space.caches.alike = OnceLock::from(CongruentCells::default());
        space
    }
}

impl<'d> TrialSpace<'d> {
    /// The cells that are alike.
    pub(crate) fn alike(&self) -> &CongruentCells {
        self.caches.alike.get_or_init(|| CongruentCells::new(self))
    }
}

/// A patch as a cell sees it, in parts of the cell's size.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct CellPatch {
    center: [i64; 2],
    half: [i64; 2],
    origin: [i64; 2],
    scale: [i64; 2],
    degree: u8,
}

impl CellPatch {
    const NUMBERS: usize = 9;

    fn numbers(&self) -> [i64; Self::NUMBERS] {
        let Self { center: [a, b], half: [c, d], origin: [e, f], scale: [g, h], degree } = *self;
        [a, b, c, d, e, f, g, h, degree.into()]
    }

    fn of(numbers: &[i64]) -> Self {
        let pair = |k: usize| [numbers[k], numbers[k + 1]];
        let [center, half, origin, scale] = [0, 2, 4, 6].map(pair);
        Self { center, half, origin, scale, degree: numbers[8] as u8 }
    }
}

/// The measures of a cell, and its patches in the order of their local indices; none where not all
/// functions are polynomials of one order on patches of one size.
fn measures(space: &TrialSpace<'_>, cell: usize) -> Option<(Vec<i64>, Vec<u32>)> {
    let (rect, data) = (&space.partition().cell[cell], space.data());
    let seat = |&patch: &u32| {
        let blocks = data.blocks(patch as usize);
        let first = blocks.start;
        let kind = &space.step().functions[data.block_function[first] as usize].kind;
        let is_plain = blocks.len() == 1 && *kind == FunctionKind::One;
        let seat = seat(space.partition(), patch as usize, rect, data.block_degree[first])?;
        is_plain.then_some((seat, patch))
    };
    let mut seats: Vec<(CellPatch, u32)> =
        space.covering_patches[cell].iter().map(seat).collect::<Option<_>>()?;
    let alike = |(a, b): (&CellPatch, &CellPatch)| {
        (a.half, a.scale, a.degree) == (b.half, b.scale, b.degree)
    };
    if !seats.windows(2).all(|pair| alike((&pair[0].0, &pair[1].0))) {
        return None;
    }
    seats.sort_unstable();
    let size = rect.size();
    let sizes = [size.x, size.y].map(|size| rounded(size).to_bits() as i64);
    let numbers = seats.iter().flat_map(|(seat, _)| seat.numbers());
    let measures = sizes.into_iter().chain(numbers).collect();
    Some((measures, seats.into_iter().map(|(_, patch)| patch).collect()))
}

/// A patch as a cell sees it.
fn seat(partition: &BoxPartition, patch: usize, cell: &Rect, degree: u8) -> Option<CellPatch> {
    let (middle, size) = (cell.center(), cell.size());
    let parts = |v: Vec2| {
        let [x, y] = [v.x / size.x, v.y / size.y];
        let is_small = x.abs() < LARGEST && y.abs() < LARGEST;
        is_small.then(|| [x, y].map(|parts| (parts * PARTS).round() as i64))
    };
    Some(CellPatch {
        center: parts(partition.center[patch] - middle)?,
        half: parts(partition.half[patch])?,
        origin: parts(partition.origin[patch] - middle)?,
        scale: parts(partition.scale[patch])?,
        degree,
    })
}

/// A length without its last bits.
fn rounded(length: f64) -> f64 {
    let half = 1_u64 << (SIZE_BITS - 1);
    f64::from_bits((length.to_bits() + half) & !((1 << SIZE_BITS) - 1))
}
