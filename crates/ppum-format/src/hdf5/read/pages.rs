//! The bytes of a file: all of them in memory, or read in parts when they are asked for.

use std::borrow::Cow;
use std::cell::{Cell, OnceCell, RefCell};
use std::collections::BTreeMap;
use std::io;

use super::super::budget::ReadBudget;
use super::error::{ReadResult, fail};

/// A file that can be read in parts.
pub(crate) trait Ranges {
    /// Fills `buffer` with the bytes from `at` on.
    fn read(&self, at: u64, buffer: &mut [u8]) -> io::Result<()>;
}

impl Ranges for ppum_file::RangedFile {
    fn read(&self, at: u64, buffer: &mut [u8]) -> io::Result<()> {
        self.read(at, buffer)
    }
}

impl Ranges for &[u8] {
    fn read(&self, at: u64, buffer: &mut [u8]) -> io::Result<()> {
        let rest = usize::try_from(at).ok().and_then(|at| self.get(at..)).unwrap_or_default();
        let Some(part) = rest.get(..buffer.len()) else {
            return Err(io::ErrorKind::UnexpectedEof.into());
        };
        buffer.copy_from_slice(part);
        Ok(())
    }
}

/// Parts are read by pages of so many bytes: the headers of a group and of its small arrays in a
/// few of them.
pub(super) const PAGE: u64 = 1 << 12;

/// Parts of a file that have been read, each in its link of a chain: what has been read once does
/// not move.
#[derive(Default)]
pub(super) struct PageChain(OnceCell<Box<Link>>);

struct Link {
    bytes: Vec<u8>,
    next: OnceCell<Box<Link>>,
}

impl Drop for PageChain {
    /// Link by link: a long chain that drops itself would take as much stack as it has links.
    fn drop(&mut self) {
        let mut next = self.0.take();
        while let Some(mut link) = next {
            next = link.next.take();
        }
    }
}

/// A file from the signature on, and the parts of it that have been read.
pub(super) struct PageCache<'f> {
    file: &'f dyn Ranges,
    /// Bytes of the user's before the signature, and of the file after them.
    start: u64,
    pub(super) length: u64,
    /// The end of the chain, and the parts in it by their addresses.
    end: Cell<&'f OnceCell<Box<Link>>>,
    known: RefCell<BTreeMap<u64, &'f [u8]>>,
}

impl<'f> PageCache<'f> {
    pub(super) fn new(file: &'f dyn Ranges, start: u64, length: u64, chain: &'f PageChain) -> Self {
        Self { file, start, length, end: Cell::new(&chain.0), known: RefCell::default() }
    }

    /// Bytes of the file's structures, which stay. They are within the file.
    pub(super) fn get(
        &self,
        address: u64,
        length: u64,
        budget: &ReadBudget,
    ) -> ReadResult<&'f [u8]> {
        let page = address - address % PAGE;
        let (from, to) = match address + length <= page + PAGE {
            true => (page, self.length.min(page + PAGE)),
            false => (address, address + length),
        };
        let known = self.known.borrow().get(&from).copied();
        let part = match known.filter(|part| part.len() as u64 >= to - from) {
            Some(part) => part,
            None => self.load(from, to - from, budget)?,
        };
        let at = (address - from) as usize;
        Ok(&part[at..at + length as usize])
    }

    /// Bytes of values, which need not stay. They are within the file.
    pub(super) fn values(
        &self,
        address: u64,
        length: u64,
        budget: &ReadBudget,
    ) -> ReadResult<Cow<'f, [u8]>> {
        if length <= PAGE {
            return self.get(address, length, budget).map(Cow::Borrowed);
        }
        self.read(address, length).map(Cow::Owned)
    }

    /// Fills a buffer with the bytes of values. They are within the file.
    pub(super) fn fill(
        &self,
        address: u64,
        buffer: &mut [u8],
        budget: &ReadBudget,
    ) -> ReadResult<()> {
        let length = buffer.len() as u64;
        if length > PAGE {
            return self.read_into(address, buffer);
        }
        buffer.copy_from_slice(self.get(address, length, budget)?);
        Ok(())
    }

    fn load(&self, from: u64, length: u64, budget: &ReadBudget) -> ReadResult<&'f [u8]> {
        if !budget.loaded.charge(length) {
            return fail("it takes more memory than the file is worth");
        }
        let bytes = self.read(from, length)?;
        let link = self.end.get().get_or_init(|| Box::new(Link { bytes, next: OnceCell::new() }));
        self.end.set(&link.next);
        self.known.borrow_mut().insert(from, &link.bytes);
        Ok(&link.bytes)
    }

    fn read(&self, from: u64, length: u64) -> ReadResult<Vec<u8>> {
        let Ok(size) = usize::try_from(length) else { return fail("it is too large") };
        let mut bytes = vec![0; size];
        self.read_into(from, &mut bytes)?;
        Ok(bytes)
    }

    fn read_into(&self, from: u64, buffer: &mut [u8]) -> ReadResult<()> {
        match self.file.read(self.start + from, buffer) {
            Ok(()) => Ok(()),
            Err(error) => fail(format!("it cannot be read: {error}")),
        }
    }
}
