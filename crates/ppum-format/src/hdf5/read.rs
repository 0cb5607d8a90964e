//! HDF5 → content.

mod arrays;
mod attributes;
mod batch;
mod chunks;
mod error;
mod filters;
mod header;
mod heap;
mod inflate;
mod links;
mod packing;
mod pages;
mod shuffle;
mod source;
mod storage;
mod superblock;
#[cfg(test)]
mod tests;
mod texts;
mod trees;
mod types;

use std::collections::BTreeMap;

use super::budget::ReadBudget;
use crate::content::{Array, ObjectTree, join, step_of};
use crate::error::{ReadError, shortened};
use crate::limits::MAX_LENGTH;
use error::{Hdf5Error, ReadResult};
use header::{DATASPACE, DATATYPE, GROUP_INFO, Header, LAYOUT, LINK, LINK_INFO, SYMBOL_TABLE};
use links::{LinkTarget, links};
use pages::PageChain;
pub(crate) use pages::Ranges;
use source::Hdf5Source;
use storage::elements;
use superblock::Superblock;
use texts::TextCollections;
use types::{Dataspace, Type};

/// Root group that is neither read nor part of the checksum: for additions by anybody.
const USER: &str = "user";

/// Groups are at most this deep; a deeper walk means links that go round in a circle.
const DEPTH: usize = 8;

/// All arrays and attributes of a file, whatever they mean.
pub(crate) fn from_bytes(bytes: &[u8]) -> Result<ObjectTree, ReadError> {
    from_file(&bytes, bytes.len() as u64)
}

/// Reads a file of so many bytes, and no more than that.
pub(crate) fn from_file(file: &dyn Ranges, length: u64) -> Result<ObjectTree, ReadError> {
    let start = Superblock::read(file, length).map_err(unreadable)?;
    let (content, _) = parts(start, file, length, |walk| walk.root(start.root))?;
    Ok(content)
}

fn unreadable(message: Hdf5Error) -> ReadError {
    ReadError::Hdf5 { message: shortened(message.into()) }
}

/// Whatever a file holds beside its steps, and where these are.
#[derive(Debug)]
pub(crate) struct Outline {
    start: Superblock,
    length: u64,
    pub(crate) content: ObjectTree,
    /// The numbered members of `steps`, each with the address of its header.
    steps: BTreeMap<String, u64>,
}

impl Outline {
    /// Reads a file of so many bytes.
    pub(crate) fn read(file: &dyn Ranges, length: u64) -> Result<Self, ReadError> {
        let start = Superblock::read(file, length).map_err(unreadable)?;
        let (content, steps) = parts(start, file, length, |walk| {
            walk.choice = ReadChoice::NoSteps;
            walk.root(start.root)
        })?;
        Ok(Self { start, length, content, steps })
    }

    /// The names of the numbered members of `steps`.
    pub(crate) fn steps(&self) -> impl ExactSizeIterator<Item = &str> {
        self.steps.keys().map(String::as_str)
    }

    pub(crate) fn has_step(&self, path: &str) -> bool {
        self.steps.contains_key(path)
    }

    /// The content of a step: all, or its attributes and these members alone.
    pub(crate) fn step(
        &self,
        file: &dyn Ranges,
        path: &str,
        only: Option<&'static [&'static str]>,
    ) -> Result<ObjectTree, ReadError> {
        let &address = self.steps.get(path).ok_or_else(|| error(path, "is missing"))?;
        let (content, _) = parts(self.start, file, self.length, |walk| {
            walk.choice = only.map_or(ReadChoice::All, ReadChoice::Only);
            walk.object(&LinkTarget::Object(address), path.to_owned(), DEPTH - 1)
        })?;
        Ok(content)
    }
}

/// Returns the findings of a walk over the parts of a file.
fn parts(
    start: Superblock,
    file: &dyn Ranges,
    length: u64,
    visit: impl FnOnce(&mut FileWalk<'_>) -> Result<(), ReadError>,
) -> Result<(ObjectTree, BTreeMap<String, u64>), ReadError> {
    let budget = ReadBudget::for_file(length.min(MAX_LENGTH));
    let chain = PageChain::default();
    let parts = start.parts(file, length, &chain);
    let mut walk = FileWalk::new(start.source(&parts, &budget));
    visit(&mut walk)?;
    Ok((walk.content, walk.steps))
}

/// A walk over a file that is not trusted: each object and array is paid for out of what a file of
/// this length can hold, before anything is allocated.
struct FileWalk<'f> {
    content: ObjectTree,
    source: Hdf5Source<'f>,
    texts: TextCollections<'f>,
    choice: ReadChoice,
    /// Steps that were left out.
    steps: BTreeMap<String, u64>,
}

/// The members of a file that are read.
#[derive(Clone, Copy)]
enum ReadChoice {
    All,
    /// All but what the numbered members of `steps` hold.
    NoSteps,
    /// Only these members of a step.
    Only(&'static [&'static str]),
}

/// The types of objects that HDF5 knows.
enum ObjectType {
    Group,
    Array,
    NamedType,
}

impl<'f> FileWalk<'f> {
    fn new(source: Hdf5Source<'f>) -> Self {
        let (content, texts) = (ObjectTree::new(), TextCollections::new(source));
        Self { content, source, texts, choice: ReadChoice::All, steps: BTreeMap::new() }
    }

    fn root(&mut self, address: u64) -> Result<(), ReadError> {
        let header = self.header(address, "")?;
        self.group(&header, "", DEPTH)
    }

    fn header(&self, address: u64, path: &str) -> Result<Header<'f>, ReadError> {
        self.visit(path)?;
        Header::read(self.source, address).map_err(|e| error(path, e))
    }

    fn visit(&self, path: &str) -> Result<(), ReadError> {
        if self.source.budget.objects.charge(1) {
            return Ok(());
        }
        Err(error(path, "more objects than the file can hold"))
    }

    fn group(&mut self, header: &Header<'f>, path: &str, depth: usize) -> Result<(), ReadError> {
        if depth == 0 {
            return Err(error(path, "groups are nested too deeply"));
        }
        self.attributes(header, path)?;
        for (name, target) in links(header).map_err(|e| error(path, e))? {
            let inner = join(path, &name);
            if name.is_empty() || name.contains(['/', '@', '\0']) || name.starts_with('.') {
                return Err(error(&inner, "is no name of an object"));
            }
            if inner != USER && self.is_chosen(&inner) {
                self.object(&target, inner, depth)?;
            }
        }
        Ok(())
    }

    fn is_chosen(&self, path: &str) -> bool {
        let ReadChoice::Only(members) = self.choice else { return true };
        let mut names = path.split('/');
        names.nth(2).is_none_or(|member| members.contains(&member))
    }

    fn object(&mut self, target: &LinkTarget, path: String, depth: usize) -> Result<(), ReadError> {
        let LinkTarget::Object(address) = *target else { return Err(elsewhere(&path)) };
        if matches!(self.choice, ReadChoice::NoSteps) && step_of(&path).is_some() {
            self.visit(&path)?;
            return match self.steps.insert(path.clone(), address) {
                None => Ok(()),
                Some(_) => Err(error(&path, "occurs twice")),
            };
        }
        let header = self.header(address, &path)?;
        match object_type(&header) {
            ObjectType::Group => {
                self.content.insert_group(&path);
                self.group(&header, &path, depth - 1)
            }
            ObjectType::Array => {
                let array = self.array(&header).map_err(|e| error(&path, e))?;
                self.insert(path, array)
            }
            ObjectType::NamedType => Err(elsewhere(&path)),
        }
    }

    fn insert(&mut self, name: String, array: Array) -> Result<(), ReadError> {
        match self.content.insert(name.clone(), array) {
            None => Ok(()),
            Some(_) => Err(error(&name, "occurs twice")),
        }
    }

    fn attributes(&mut self, header: &Header<'f>, path: &str) -> Result<(), ReadError> {
        for attribute in attributes::attributes(header).map_err(|e| error(path, e))? {
            let name = join(path, &format!("@{}", attribute.name));
            let array = attribute.read(&mut self.texts).map_err(|e| error(&name, e))?;
            self.insert(name, array)?;
        }
        Ok(())
    }

    fn array(&mut self, header: &Header<'f>) -> ReadResult<Array> {
        let kind = Type::parse(header.get(DATATYPE)?)?;
        let space = Dataspace::parse(header.get(DATASPACE)?)?;
        let size = kind.size;
        kind.array(space, &mut self.texts, |space, bytes| elements(header, space, size, bytes))
    }
}

fn object_type(header: &Header) -> ObjectType {
    let is_group = [SYMBOL_TABLE, LINK_INFO, LINK, GROUP_INFO].iter().any(|kind| header.has(*kind));
    match is_group {
        true => ObjectType::Group,
        false if header.has(LAYOUT) => ObjectType::Array,
        false => ObjectType::NamedType,
    }
}

/// An error at an object; the root is `/`.
fn error(path: &str, message: impl Into<Hdf5Error>) -> ReadError {
    ReadError::object(if path.is_empty() { "/" } else { path }, message.into())
}

fn elsewhere(path: &str) -> ReadError {
    let message = "leads to no group or dataset of this file: soft and external links and named types \
                   are not read; copy into the file what it leads to, or leave it out";
    error(path, message)
}
