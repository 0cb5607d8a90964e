//! Places of the values of an array: in its header, in one piece, or in chunks.

use super::batch::{ChunkBatch, Hyperslab};
use super::chunks::{ChunkGrid, Index};
use super::error::{ReadResult, fail};
use super::filters::{Pipeline, filters};
use super::header::{EXTERNAL_FILES, FILL_VALUE, FILTERS, Header, LAYOUT, OLD_FILL_VALUE};
use super::source::Cursor;
use super::types::{Dataspace, product};

/// Classes of layouts.
const COMPACT: u8 = 0;
const CONTIGUOUS: u8 = 1;
const CHUNKED: u8 = 2;
const VIRTUAL: u8 = 3;

/// Fills a buffer, which is zero, with the bytes of all elements of an array, row-major.
pub(super) fn elements(
    header: &Header,
    space: &Dataspace,
    size: usize,
    array: &mut [u8],
) -> ReadResult<()> {
    let mut layout = header.get(LAYOUT)?;
    let version = layout.u8()?;
    if !(3..=5).contains(&version) {
        return fail(format!("its layout has version {version}, which is not read"));
    }
    match layout.u8()? {
        COMPACT => compact(layout, array),
        CONTIGUOUS => contiguous(header, layout, size, array),
        CHUNKED => chunked(header, layout, version, space, size, array),
        VIRTUAL => {
            fail("its values stand in other datasets (a virtual dataset), which is not read")
        }
        class => fail(format!("its layout is of class {class}, which is not known")),
    }
}

fn compact(mut layout: Cursor, array: &mut [u8]) -> ReadResult<()> {
    let stored = layout.u16()?;
    match layout.take(stored.into())?.get(..array.len()) {
        Some(values) => array.copy_from_slice(values),
        None => return fail(FEWER),
    }
    Ok(())
}

const FEWER: &str = "holds fewer values than its shape says";

fn contiguous(
    header: &Header,
    mut layout: Cursor,
    size: usize,
    array: &mut [u8],
) -> ReadResult<()> {
    let (address, stored) = (layout.offset()?, layout.length()?);
    if header.has(EXTERNAL_FILES) {
        return fail("its values stand in another file, which is not read");
    }
    let bytes = array.len() as u64;
    // every value that is not stored is the same: an array of them must not be longer than the file
    if bytes > header.source.length() {
        return fail("it is longer than the file");
    }
    match address {
        None => {
            repeat(array, &fill(header, size)?);
            Ok(())
        }
        Some(address) if bytes <= stored => header.source.fill(address, array),
        Some(_) => fail(FEWER),
    }
}

/// Fills a buffer, which is zero, with elements that are all the same.
fn repeat(array: &mut [u8], element: &[u8]) {
    if element.iter().any(|&byte| byte != 0) {
        array.chunks_exact_mut(element.len()).for_each(|place| place.copy_from_slice(element));
    }
}

/// The bytes of an element that is not stored.
fn fill(header: &Header, size: usize) -> ReadResult<Vec<u8>> {
    let value = match (header.find(FILL_VALUE)?, header.find(OLD_FILL_VALUE)?) {
        (Some(message), _) => new_fill(message)?,
        (None, Some(mut message)) => sized(&mut message)?,
        (None, None) => &[],
    };
    Ok(if value.len() == size { value.to_vec() } else { vec![0; size] })
}

fn new_fill(mut message: Cursor<'_>) -> ReadResult<&[u8]> {
    let version = message.u8()?;
    let is_defined = match version {
        1 | 2 => message.skip(2)?.u8()? != 0,
        3 => message.u8()? & 0x20 != 0,
        _ => return fail(format!("its fill value has version {version}, which is not known")),
    };
    if is_defined { sized(&mut message) } else { Ok(&[]) }
}

fn sized<'f>(message: &mut Cursor<'f>) -> ReadResult<&'f [u8]> {
    let size = message.size(4)?;
    message.take(size)
}

/// Flags of chunks: those on the border that are not full are stored without filters.
const PLAIN_BORDER: u8 = 1;

fn chunked(
    header: &Header,
    mut layout: Cursor,
    version: u8,
    space: &Dataspace,
    size: usize,
    array: &mut [u8],
) -> ReadResult<()> {
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
    let grid = ChunkGrid { space, chunk, bytes, is_filtered: !pipeline.is_empty() };
    let pipeline = Pipeline { filters: pipeline, size, bytes };
    repeat(array, &fill(header, size)?);
    let mut batch = ChunkBatch::new(header.source, &pipeline, array);
    index.visit(header.source, &grid, &mut |start, stored| {
        let Some(slab) = Hyperslab::new(&grid, start) else { return Ok(()) };
        let is_plain = flags & PLAIN_BORDER != 0 && slab.extent != grid.chunk;
        batch.add(slab, stored, is_plain)
    })?;
    batch.finish()
}

/// Flags, shape with the bytes of an element, index.
type Chunks = (u8, Vec<u64>, Index);

fn old_chunks(layout: &mut Cursor) -> ReadResult<Chunks> {
    let rank = layout.u8()?;
    let address = layout.offset()?;
    let chunk = (0..rank).map(|_| layout.number(4)).collect::<ReadResult<_>>()?;
    Ok((0, chunk, Index::OldTree(address)))
}

fn new_chunks(layout: &mut Cursor, space: &Dataspace) -> ReadResult<Chunks> {
    let (flags, rank, width) = (layout.u8()?, layout.u8()?, layout.u8()?);
    let chunk = (0..rank).map(|_| layout.number(width.into())).collect::<ReadResult<_>>()?;
    Ok((flags, chunk, Index::parse(layout, flags, space)?))
}
