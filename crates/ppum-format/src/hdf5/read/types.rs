//! Types and shapes of arrays and attributes, and their values.

use bytemuck::Pod;

use super::super::budget::memory;
use super::error::{ReadResult, fail};
use super::source::Cursor;
use super::texts::{TextCollections, end_without, text};
use crate::content::{Array, ArrayValues, ElementType as _};

/// An element type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Type {
    pub(super) kind: DatatypeClass,
    /// Bytes of an element.
    pub(super) size: usize,
    /// True for numbers whose first byte is the most significant one.
    pub(super) is_big: bool,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum DatatypeClass {
    F64,
    U8,
    U32,
    U64,
    I64,
    /// Text of fixed length.
    Text(Padding),
    /// Text of variable length, which stands elsewhere.
    LongText,
    /// A type outside the format.
    Other(String),
}

/// The padding of a text of fixed length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Padding {
    /// A NUL, and then anything.
    Terminated,
    Nuls,
    Spaces,
}

/// Classes of types that the format has, and the names of all.
const FIXED_POINT: usize = 0;
const FLOATING_POINT: usize = 1;
const STRING: usize = 3;
const VARIABLE_LENGTH: usize = 9;
const CLASSES: [&str; 12] = [
    "integer",
    "floating point",
    "time",
    "string",
    "bit field",
    "opaque",
    "compound",
    "reference",
    "enumeration",
    "variable length",
    "array",
    "complex",
];

impl Type {
    pub(super) fn parse(mut message: Cursor) -> ReadResult<Self> {
        let head = message.u8()?;
        let (class, flags) = (usize::from(head & 15), message.number(3)?);
        let size = message.u32()?;
        let Some(name) = CLASSES.get(class).filter(|_| size > 0) else {
            return fail("its type is none of HDF5");
        };
        let is_big = matches!(class, FIXED_POINT | FLOATING_POINT) && flags & BIG_ENDIAN != 0;
        let kind = match class {
            FIXED_POINT => integer(flags, size, &mut message)?,
            FLOATING_POINT => float(flags, size, &mut message)?,
            STRING => DatatypeClass::Text(padding(flags)?),
            VARIABLE_LENGTH if flags & 15 == 1 => DatatypeClass::LongText,
            _ => DatatypeClass::Other((*name).to_owned()),
        };
        let size = usize::try_from(size).or(fail("its elements are too large"))?;
        Ok(Self { kind, size, is_big })
    }

    pub(super) fn is_text(&self) -> bool {
        matches!(self.kind, DatatypeClass::Text(_) | DatatypeClass::LongText)
    }

    /// An array of this type, whose bytes are put where they are wanted by `fill`. It is paid for
    /// before anything is allocated.
    pub(super) fn array(
        &self,
        space: Option<Dataspace>,
        texts: &mut TextCollections,
        fill: impl FnOnce(&Dataspace, &mut [u8]) -> ReadResult<()>,
    ) -> ReadResult<Array> {
        let Some(space) = space else {
            return Ok(Array { shape: vec![], values: ArrayValues::Other("null".into()) });
        };
        if let DatatypeClass::Other(name) = &self.kind {
            return Ok(Array { shape: space.shape, values: ArrayValues::Other(name.clone()) });
        }
        let (count, size) = (space.count(), self.size as u64);
        let cost = count.and_then(|n| memory(n, size, self.is_text()));
        if !cost.is_some_and(|cost| texts.source.budget.memory.charge(cost)) {
            return fail(format!("its shape {:?} is too large for the file's length", space.shape));
        }
        // the bytes of all values fit into memory's numbers, too
        let fits = |n: &u64| n.checked_mul(size).is_some_and(|n| usize::try_from(n).is_ok());
        let Some(count) = count.filter(fits) else { return fail("its shape is too large") };
        let values = self.values(count as usize, texts, |bytes| fill(&space, bytes))?;
        Ok(Array { shape: space.shape, values })
    }

    /// So many values, whose bytes are put where they are wanted by `fill`.
    pub(super) fn values(
        &self,
        count: usize,
        texts: &mut TextCollections,
        fill: impl FnOnce(&mut [u8]) -> ReadResult<()>,
    ) -> ReadResult<ArrayValues> {
        Ok(match &self.kind {
            DatatypeClass::F64 => f64::wrap(self.numbers(count, fill)?),
            DatatypeClass::U8 => u8::wrap(self.numbers(count, fill)?),
            DatatypeClass::U32 => u32::wrap(self.numbers(count, fill)?),
            DatatypeClass::U64 => u64::wrap(self.numbers(count, fill)?),
            DatatypeClass::I64 => i64::wrap(self.numbers(count, fill)?),
            DatatypeClass::Text(_) | DatatypeClass::LongText => {
                let mut raw = vec![0; count * self.size];
                fill(&mut raw)?;
                let texts = raw.chunks_exact(self.size).map(|raw| self.text(raw, texts));
                String::wrap(texts.collect::<ReadResult<_>>()?)
            }
            DatatypeClass::Other(name) => ArrayValues::Other(name.clone()),
        })
    }

    fn text(&self, raw: &[u8], texts: &mut TextCollections) -> ReadResult<String> {
        match self.kind {
            DatatypeClass::Text(padding) => text(padding.cut(raw)),
            _ => texts.read(raw),
        }
    }

    /// The numbers themselves are what is filled: large arrays are not copied.
    fn numbers<T: Pod>(
        &self,
        count: usize,
        fill: impl FnOnce(&mut [u8]) -> ReadResult<()>,
    ) -> ReadResult<Vec<T>> {
        let mut numbers = bytemuck::zeroed_vec(count);
        let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut numbers);
        fill(bytes)?;
        if self.is_big != cfg!(target_endian = "big") {
            bytes.chunks_exact_mut(self.size).for_each(<[u8]>::reverse);
        }
        Ok(numbers)
    }
}

fn integer(flags: u64, size: u32, message: &mut Cursor) -> ReadResult<DatatypeClass> {
    let (offset, bits) = (message.u16()?, message.u16()?);
    let is_whole = offset == 0 && u64::from(bits) == 8 * u64::from(size);
    let is_signed = flags & 8 != 0;
    Ok(match (is_signed, size) {
        (false, 1) if is_whole => DatatypeClass::U8,
        (false, 4) if is_whole => DatatypeClass::U32,
        (false, 8) if is_whole => DatatypeClass::U64,
        (true, 8) if is_whole => DatatypeClass::I64,
        _ => DatatypeClass::Other(format!("{}{bits}", if is_signed { 'i' } else { 'u' })),
    })
}

/// Flag of numbers: the first byte is the most significant one.
const BIG_ENDIAN: u64 = 1;

/// Order of bits of an IEEE double in little-endian bytes, and then: offset, bits; place and size
/// of exponent and mantissa, the exponent's bias.
const DOUBLE: (u64, [u8; 12]) = (0x3f20, [0, 0, 64, 0, 52, 11, 0, 52, 0xff, 3, 0, 0]);

fn float(flags: u64, size: u32, message: &mut Cursor) -> ReadResult<DatatypeClass> {
    let is_ieee = flags & !BIG_ENDIAN == DOUBLE.0 && size == 8;
    let is_double = is_ieee && message.take(12)? == DOUBLE.1;
    Ok(if is_double {
        DatatypeClass::F64
    } else {
        DatatypeClass::Other(format!("f{}", 8 * u64::from(size)))
    })
}

fn padding(flags: u64) -> ReadResult<Padding> {
    Ok(match flags & 15 {
        0 => Padding::Terminated,
        1 => Padding::Nuls,
        2 => Padding::Spaces,
        _ => return fail("its texts are padded in an unknown way"),
    })
}

impl Padding {
    /// The characters of a text.
    fn cut(self, raw: &[u8]) -> &[u8] {
        let end = match self {
            Self::Terminated => raw.iter().position(|&byte| byte == 0).unwrap_or(raw.len()),
            Self::Nuls => end_without(raw, 0),
            Self::Spaces => end_without(raw, b' '),
        };
        &raw[..end]
    }
}

/// The shape of an array.
#[derive(Clone, Debug)]
pub(super) struct Dataspace {
    pub(super) shape: Vec<u64>,
    /// The length that it can grow to; [`u64::MAX`] without bound.
    pub(super) most: Vec<u64>,
}

impl Dataspace {
    /// None if there is not even a shape.
    pub(super) fn parse(mut message: Cursor) -> ReadResult<Option<Self>> {
        let (version, rank, flags) = (message.u8()?, message.u8()?, message.u8()?);
        match version {
            1 => drop(message.skip(5)?),
            2 if message.u8()? == 2 => return Ok(None),
            2 => {}
            _ => return fail(format!("its shape has version {version}, which is not known")),
        }
        let shape: Vec<u64> = (0..rank).map(|_| message.length()).collect::<ReadResult<_>>()?;
        let nothing = u64::MAX >> (64 - 8 * message.source.length_size());
        let unlimited = |most| if most == nothing { u64::MAX } else { most };
        let most = match flags & 1 {
            0 => shape.clone(),
            _ => (0..rank).map(|_| message.length().map(unlimited)).collect::<ReadResult<_>>()?,
        };
        Ok(Some(Self { shape, most }))
    }

    /// The number of elements, unless that is beyond all numbers.
    pub(super) fn count(&self) -> Option<u64> {
        product(&self.shape)
    }
}

pub(super) fn product(shape: &[u64]) -> Option<u64> {
    // a zero makes it zero, however large the others are
    if shape.contains(&0) {
        return Some(0);
    }
    shape.iter().try_fold(1_u64, |product, &n| product.checked_mul(n))
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
