//! Places of the values of an array: in its header, in one piece, or in chunks.

use std::borrow::Cow;

use super::chunks::{Grid, Index, Stored};
use super::filters::{Pipeline, filters};
use super::header::{EXTERNAL_FILES, FILL_VALUE, FILTERS, Header, LAYOUT, OLD_FILL_VALUE};
use super::source::{Cursor, Parsed, fail};
use super::types::{Space, product};

/// Classes of layouts.
const COMPACT: u8 = 0;
const CONTIGUOUS: u8 = 1;
const CHUNKED: u8 = 2;
const VIRTUAL: u8 = 3;

/// The bytes of all elements of an array, row-major. The caller has paid for them.
pub(super) fn elements<'f>(
    header: &Header<'f>,
    space: &Space,
    size: usize,
) -> Parsed<Cow<'f, [u8]>> {
    let bytes = space.count().and_then(|count| count.checked_mul(size as u64));
    let Some(bytes) = bytes.and_then(|bytes| usize::try_from(bytes).ok()) else {
        return fail("its shape is too large");
    };
    let mut layout = header.get(LAYOUT)?;
    let version = layout.u8()?;
    if !(3..=5).contains(&version) {
        return fail(format!("its layout has version {version}, which is not read"));
    }
    match layout.u8()? {
        COMPACT => {
            let stored = layout.u16()?;
            complete(layout.take(stored.into())?, bytes)
        }
        CONTIGUOUS => contiguous(header, layout, bytes, size),
        CHUNKED => chunked(header, layout, version, space, size).map(Cow::Owned),
        VIRTUAL => {
            fail("its values stand in other datasets (a virtual dataset), which is not read")
        }
        class => fail(format!("its layout is of class {class}, which is not known")),
    }
}

fn complete(stored: &[u8], bytes: usize) -> Parsed<Cow<'_, [u8]>> {
    match stored.get(..bytes) {
        Some(values) => Ok(values.into()),
        None => fail(FEWER),
    }
}

const FEWER: &str = "holds fewer values than its shape says";

fn contiguous<'f>(
    header: &Header<'f>,
    mut layout: Cursor<'f>,
    bytes: usize,
    size: usize,
) -> Parsed<Cow<'f, [u8]>> {
    let (address, stored) = (layout.offset()?, layout.length()?);
    if header.has(EXTERNAL_FILES) {
        return fail("its values stand in another file, which is not read");
    }
    // every value that is not stored is the same: an array of them must not be longer than the file
    if bytes as u64 > header.source.length() {
        return fail("it is longer than the file");
    }
    match address {
        None => Ok(filled(bytes, &fill(header, size)?).into()),
        Some(address) if bytes as u64 <= stored => header.source.values(address, bytes as u64),
        Some(_) => fail(FEWER),
    }
}

fn filled(bytes: usize, fill: &[u8]) -> Vec<u8> {
    if fill.iter().all(|&byte| byte == 0) {
        vec![0; bytes]
    } else {
        fill.repeat(bytes / fill.len())
    }
}

/// The bytes of an element that is not stored.
fn fill(header: &Header, size: usize) -> Parsed<Vec<u8>> {
    let value = match (header.find(FILL_VALUE)?, header.find(OLD_FILL_VALUE)?) {
        (Some(message), _) => new_fill(message)?,
        (None, Some(mut message)) => sized(&mut message)?,
        (None, None) => &[],
    };
    Ok(if value.len() == size { value.to_vec() } else { vec![0; size] })
}

fn new_fill(mut message: Cursor<'_>) -> Parsed<&[u8]> {
    let version = message.u8()?;
    let is_defined = match version {
        1 | 2 => message.skip(2)?.u8()? != 0,
        3 => message.u8()? & 0x20 != 0,
        _ => return fail(format!("its fill value has version {version}, which is not known")),
    };
    if is_defined { sized(&mut message) } else { Ok(&[]) }
}

fn sized<'f>(message: &mut Cursor<'f>) -> Parsed<&'f [u8]> {
    let size = message.size(4)?;
    message.take(size)
}

/// Flags of chunks: those on the border that are not full are stored without filters.
const PLAIN_BORDER: u8 = 1;

fn chunked(
    header: &Header,
    mut layout: Cursor,
    version: u8,
    space: &Space,
    size: usize,
) -> Parsed<Vec<u8>> {
    let pipeline = header.find(FILTERS)?.map_or(Ok(vec![]), filters)?;
    let (flags, chunk, index) =
        if version == 3 { old_chunks(&mut layout)? } else { new_chunks(&mut layout, space)? };
    let Some((&[last], chunk)) = chunk.split_last_chunk().map(|(chunk, last)| (last, chunk)) else {
        return fail("its chunks have no shape");
    };
    if chunk.len() != space.shape.len() || chunk.contains(&0) || last != size as u64 {
        return fail("the shape of its chunks does not fit its own");
    }
    let Some(bytes) = product(chunk).and_then(|n| n.checked_mul(size as u64)) else {
        return fail("its chunks are too large");
    };
    let grid = Grid { space, chunk, bytes, is_filtered: !pipeline.is_empty() };
    let pipeline = Pipeline { filters: pipeline, size, bytes, account: header.source.account };
    let count = space.count().unwrap_or(0) as usize;
    let mut array = filled(count * size, &fill(header, size)?);
    index.visit(header.source, &grid, &mut |start, stored| {
        let Some(part) = Part::new(&grid, start) else { return Ok(()) };
        let is_plain = flags & PLAIN_BORDER != 0 && part.extent != grid.chunk;
        let values = values(header, &pipeline, stored, part.keep(), is_plain)?;
        part.copy(&values, &mut array, size);
        Ok(())
    })?;
    Ok(array)
}

/// The first elements of a chunk, as many as are asked for.
fn values<'f>(
    header: &Header<'f>,
    pipeline: &Pipeline,
    stored: Stored,
    keep: u64,
    is_plain: bool,
) -> Parsed<Cow<'f, [u8]>> {
    let bytes = keep * pipeline.size as u64;
    if is_plain || !pipeline.applies(stored.mask) {
        return header.source.values(stored.address, bytes);
    }
    let values = match header.source.values(stored.address, stored.bytes)? {
        Cow::Borrowed(raw) => pipeline.undo(raw, stored.mask, keep)?,
        Cow::Owned(raw) => pipeline.undo(&raw, stored.mask, keep)?.into_owned().into(),
    };
    if (values.len() as u64) < bytes {
        return fail("a chunk holds fewer values than its shape says");
    }
    Ok(values)
}

/// Flags, shape with the bytes of an element, index.
type Chunks = (u8, Vec<u64>, Index);

fn old_chunks(layout: &mut Cursor) -> Parsed<Chunks> {
    let rank = layout.u8()?;
    let address = layout.offset()?;
    let chunk = (0..rank).map(|_| layout.number(4)).collect::<Parsed<_>>()?;
    Ok((0, chunk, Index::OldTree(address)))
}

fn new_chunks(layout: &mut Cursor, space: &Space) -> Parsed<Chunks> {
    let (flags, rank, width) = (layout.u8()?, layout.u8()?, layout.u8()?);
    let chunk = (0..rank).map(|_| layout.number(width.into())).collect::<Parsed<_>>()?;
    Ok((flags, chunk, Index::parse(layout, flags, space)?))
}

/// The part of an array that is in a chunk.
struct Part<'a> {
    grid: &'a Grid<'a>,
    start: &'a [u64],
    extent: Vec<u64>,
}

impl<'a> Part<'a> {
    /// None for a chunk outside the array.
    fn new(grid: &'a Grid<'a>, start: &'a [u64]) -> Option<Self> {
        let shape = grid.space.shape.iter().zip(grid.chunk).zip(start);
        let extent: Vec<u64> =
            shape.map(|((n, chunk), start)| n.saturating_sub(*start).min(*chunk)).collect();
        (!extent.contains(&0)).then_some(Self { grid, start, extent })
    }

    /// Elements of the chunk up to the last one in the array.
    fn keep(&self) -> u64 {
        let shape = self.grid.chunk.iter().zip(&self.extent);
        shape.fold(0, |last, (chunk, extent)| last * chunk + extent - 1) + 1
    }

    /// Copies the rows of the part to where they belong.
    fn copy(&self, chunk: &[u8], array: &mut [u8], size: usize) {
        let (outer, row) = match self.extent.split_last() {
            Some((row, outer)) => (outer, *row as usize * size),
            None => (&[][..], size),
        };
        let mut at = vec![0; outer.len()];
        loop {
            let from = place(&at, &[], self.grid.chunk) * size;
            let to = place(&at, self.start, &self.grid.space.shape) * size;
            array[to..to + row].copy_from_slice(&chunk[from..from + row]);
            if !step(&mut at, outer) {
                break;
            }
        }
    }
}

/// The place of an element in a row-major array; coordinates that are left out are zero.
fn place(at: &[u64], start: &[u64], shape: &[u64]) -> usize {
    let coordinate = |k: usize, of: &[u64]| of.get(k).copied().unwrap_or(0);
    let sum = |sum: u64, (k, n): (usize, &u64)| sum * n + coordinate(k, at) + coordinate(k, start);
    shape.iter().enumerate().fold(0, sum) as usize
}

/// The next place in an array of this shape, in row-major order; false after the last one.
pub(super) fn step(at: &mut [u64], shape: &[u64]) -> bool {
    for (place, n) in at.iter_mut().zip(shape).rev() {
        *place += 1;
        if *place < *n {
            return true;
        }
        *place = 0;
    }
    false
}
