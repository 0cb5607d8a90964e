//! The indexes of chunks.

use super::arrays::{ExtensibleArray, FixedArray};
use super::error::{ReadResult, fail};
use super::source::{Cursor, Hdf5Source};
use super::trees::{self, CHUNKS};
use super::types::{Dataspace, step};

/// The division of an array.
pub(super) struct ChunkGrid<'a> {
    pub(super) space: &'a Dataspace,
    /// Elements of a chunk in each direction.
    pub(super) chunk: &'a [u64],
    /// Bytes of a chunk.
    pub(super) bytes: u64,
    pub(super) is_filtered: bool,
}

/// The place of a chunk.
#[derive(Clone, Copy, Debug)]
pub(super) struct ChunkLocation {
    pub(super) address: u64,
    pub(super) bytes: u64,
    /// The filters that were left out, one bit each.
    pub(super) mask: u32,
}

/// An index, by its address: none as long as nothing is stored.
#[derive(Clone, Copy, Debug)]
pub(super) enum Index {
    OldTree(Option<u64>),
    Single {
        address: Option<u64>,
        filtered: Option<(u64, u32)>,
    },
    Implicit(Option<u64>),
    Fixed(Option<u64>),
    /// With the direction that can grow.
    ExtensibleArray(Option<u64>, usize),
    Tree(Option<u64>),
}

/// Flag of a chunked layout: the only chunk is filtered.
const SINGLE_FILTERED: u8 = 2;

/// Kinds of the trees of chunks: without and with filters.
const TREES: [u8; 2] = [10, 11];

type Visit<'a> = &'a mut dyn FnMut(&[u64], ChunkLocation) -> ReadResult<()>;

impl Index {
    /// The index at the end of a layout.
    pub(super) fn parse(layout: &mut Cursor, flags: u8, space: &Dataspace) -> ReadResult<Self> {
        Ok(match layout.u8()? {
            1 => {
                let filtered = match flags & SINGLE_FILTERED {
                    0 => None,
                    _ => Some((layout.length()?, layout.u32()?)),
                };
                Self::Single { address: layout.offset()?, filtered }
            }
            2 => Self::Implicit(layout.offset()?),
            // what else a layout says of an index stands in the index too
            3 => Self::Fixed(layout.skip(1)?.offset()?),
            4 => {
                let Some(growing) = space.most.iter().position(|&n| n == u64::MAX) else {
                    return fail("no direction grows, as the index of its chunks has it");
                };
                Self::ExtensibleArray(layout.skip(5)?.offset()?, growing)
            }
            5 => Self::Tree(layout.skip(6)?.offset()?),
            kind => return fail(format!("its chunks have an index of kind {kind}, not known")),
        })
    }

    /// Calls `visit` with the first element and the place of each chunk that is stored.
    pub(super) fn visit(
        self,
        source: Hdf5Source,
        grid: &ChunkGrid,
        visit: Visit,
    ) -> ReadResult<()> {
        match self {
            Self::OldTree(Some(address)) => old_tree(source, address, grid, visit),
            Self::Tree(Some(address)) => tree(source, address, grid, visit),
            Self::Single { address: Some(address), filtered } => {
                let (bytes, mask) = filtered.unwrap_or((grid.bytes, 0));
                let start = vec![0; grid.chunk.len()];
                visit(&start, ChunkLocation { address, bytes, mask })
            }
            Self::Implicit(Some(address)) => each(grid, visit, 0, |number| {
                let place = number.checked_mul(grid.bytes).and_then(|n| n.checked_add(address));
                let Some(address) = place else { return fail("its chunks are too large") };
                Ok(Some(ChunkLocation { address, bytes: grid.bytes, mask: 0 }))
            }),
            Self::Fixed(Some(address)) => {
                let mut array = FixedArray::open(source, address)?;
                each(grid, visit, 0, |number| entry(array.entry(number)?, grid))
            }
            Self::ExtensibleArray(Some(address), growing) => {
                let mut array = ExtensibleArray::open(source, address)?;
                each(grid, visit, growing, |number| entry(array.entry(number)?, grid))
            }
            _ => Ok(()),
        }
    }
}

/// The chunk of an entry of an array; none if it is not stored.
fn entry(entry: Option<Cursor>, grid: &ChunkGrid) -> ReadResult<Option<ChunkLocation>> {
    let Some(mut entry) = entry else { return Ok(None) };
    let Some(address) = entry.offset()? else { return Ok(None) };
    stored(address, &mut entry, grid, 0).map(Some)
}

/// The place of a chunk, given at the front of an entry that has `after` bytes of something else at
/// its end.
fn stored(
    address: u64,
    entry: &mut Cursor,
    grid: &ChunkGrid,
    after: usize,
) -> ReadResult<ChunkLocation> {
    if !grid.is_filtered {
        return Ok(ChunkLocation { address, bytes: grid.bytes, mask: 0 });
    }
    let Some(width) = entry.rest().len().checked_sub(4 + after) else {
        return fail("the entries of the index of its chunks are too short");
    };
    Ok(ChunkLocation { address, bytes: entry.number(width)?, mask: entry.u32()? })
}

fn old_tree(source: Hdf5Source, address: u64, grid: &ChunkGrid, visit: Visit) -> ReadResult<()> {
    let rank = grid.chunk.len();
    for (key, address) in trees::entries(source, address, CHUNKS, 8 * (rank + 2))? {
        let mut key = source.cursor(key);
        let (bytes, mask) = (key.number(4)?, key.u32()?);
        let start: Vec<u64> = (0..rank).map(|_| key.number(8)).collect::<ReadResult<_>>()?;
        if start.iter().zip(grid.chunk).any(|(start, chunk)| start % chunk != 0) {
            return fail("a chunk is at an impossible place");
        }
        visit(&start, ChunkLocation { address, bytes, mask })?;
    }
    Ok(())
}

fn tree(source: Hdf5Source, address: u64, grid: &ChunkGrid, visit: Visit) -> ReadResult<()> {
    let rank = grid.chunk.len();
    for record in trees::records(source, address, &TREES)? {
        let mut record = source.cursor(record);
        let Some(address) = record.offset()? else { continue };
        let place = stored(address, &mut record, grid, 8 * rank)?;
        let start = grid.chunk.iter().map(|&chunk| Ok(record.number(8)?.checked_mul(chunk)));
        match start.collect::<ReadResult<Option<Vec<u64>>>>()? {
            Some(start) => visit(&start, place)?,
            None => return fail("a chunk is at an impossible place"),
        }
    }
    Ok(())
}

/// Visits the chunks of an index that counts them through. The direction that grows counts last,
/// the others as far as the array can grow.
fn each(
    grid: &ChunkGrid,
    visit: Visit,
    growing: usize,
    mut find: impl FnMut(u64) -> ReadResult<Option<ChunkLocation>>,
) -> ReadResult<()> {
    let chunks = |shape: &[u64]| -> Vec<u64> {
        shape.iter().zip(grid.chunk).map(|(n, chunk)| n.div_ceil(*chunk)).collect()
    };
    let (count, most) = (chunks(&grid.space.shape), chunks(&grid.space.most));
    if count.contains(&0) {
        return Ok(());
    }
    let mut at = vec![0; count.len()];
    loop {
        let Some(number) = number(&at, &most, growing) else {
            return fail("its chunks are too many");
        };
        if let Some(stored) = find(number)? {
            let start: Vec<u64> = at.iter().zip(grid.chunk).map(|(at, chunk)| at * chunk).collect();
            visit(&start, stored)?;
        }
        if !step(&mut at, &count) {
            return Ok(());
        }
    }
}

/// The number of a chunk.
fn number(at: &[u64], most: &[u64], growing: usize) -> Option<u64> {
    let mut pairs: Vec<(&u64, &u64)> = at.iter().zip(most).collect();
    // the direction that grows changes slowest
    if let Some(front) = pairs.get_mut(..=growing) {
        front.rotate_right(1);
    }
    pairs.iter().try_fold(0_u64, |number, (at, n)| number.checked_mul(**n)?.checked_add(**at))
}
