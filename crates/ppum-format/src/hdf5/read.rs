//! HDF5 → content.

mod arrays;
mod attributes;
mod chunks;
mod filters;
mod header;
mod heap;
mod links;
mod packing;
mod source;
mod storage;
mod superblock;
#[cfg(test)]
mod tests;
mod texts;
mod trees;
mod types;

use super::account::{Account, memory};
use crate::content::{Array, Content, Values, join};
use crate::error::ReadError;
use header::{DATASPACE, DATATYPE, GROUP_INFO, Header, LAYOUT, LINK, LINK_INFO, SYMBOL_TABLE};
use links::{Target, links};
use source::{Mistake, Parsed, Source, fail};
use storage::elements;
use texts::Texts;
use types::{Kind, Space, Type};

/// Root group that is neither read nor part of the checksum: for additions by anybody.
const USER: &str = "user";

/// Groups are at most this deep; a deeper walk means links that go round in a circle.
const DEPTH: usize = 8;

/// All arrays and attributes of a file, whatever they mean.
pub(crate) fn from_bytes(bytes: &[u8]) -> Result<Content, ReadError> {
    let account = Account::for_file(bytes.len() as u64);
    let (source, root) = superblock::open(bytes, &account)
        .map_err(|Mistake(message)| ReadError::Hdf5 { message: message.into() })?;
    let mut walk = Walk { content: Content::new(), source, texts: Texts::new(source) };
    let header = walk.header(root, "")?;
    walk.group(&header, "", DEPTH)?;
    Ok(walk.content)
}

/// A walk over a file that is not trusted: each object and array is paid for out of what a file of
/// this length can hold, before anything is allocated.
struct Walk<'f> {
    content: Content,
    source: Source<'f>,
    texts: Texts<'f>,
}

/// The kinds of objects of a file.
enum Form {
    Group,
    Array,
    NamedType,
}

impl<'f> Walk<'f> {
    fn header(&self, address: u64, path: &str) -> Result<Header<'f>, ReadError> {
        self.visit(path)?;
        Header::read(self.source, address).map_err(|e| error(path, e))
    }

    fn visit(&self, path: &str) -> Result<(), ReadError> {
        if self.source.account.pay_object() {
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
            if inner != USER {
                self.object(&target, inner, depth)?;
            }
        }
        Ok(())
    }

    fn object(&mut self, target: &Target, path: String, depth: usize) -> Result<(), ReadError> {
        let Target::Object(address) = *target else { return Err(elsewhere(&path)) };
        let header = self.header(address, &path)?;
        match form(&header) {
            Form::Group => {
                self.content.insert_group(&path);
                self.group(&header, &path, depth - 1)
            }
            Form::Array => {
                let array = self.array(&header).map_err(|e| error(&path, e))?;
                self.insert(path, array)
            }
            Form::NamedType => Err(elsewhere(&path)),
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

    fn array(&mut self, header: &Header<'f>) -> Parsed<Array> {
        let kind = Type::parse(header.get(DATATYPE)?)?;
        let Some(space) = Space::parse(header.get(DATASPACE)?)? else {
            return Ok(Array { shape: vec![], values: Values::Other("null".into()) });
        };
        if let Kind::Other(name) = kind.kind {
            return Ok(Array { shape: space.shape, values: Values::Other(name) });
        }
        let cost = space.count().and_then(|n| memory(n, kind.size as u64, kind.is_text()));
        if !self.source.account.pay_memory(cost) {
            return fail(format!("its shape {:?} is too large for the file's length", space.shape));
        }
        let raw = elements(header, &space, kind.size)?;
        Ok(Array { values: kind.values(&raw, &mut self.texts)?, shape: space.shape })
    }
}

fn form(header: &Header) -> Form {
    let is_group = [SYMBOL_TABLE, LINK_INFO, LINK, GROUP_INFO].iter().any(|kind| header.has(*kind));
    match is_group {
        true => Form::Group,
        false if header.has(LAYOUT) => Form::Array,
        false => Form::NamedType,
    }
}

/// An error at an object; the root is `/`.
fn error(path: &str, mistake: impl Into<Mistake>) -> ReadError {
    let Mistake(mistake) = mistake.into();
    ReadError::object(if path.is_empty() { "/" } else { path }, mistake)
}

fn elsewhere(path: &str) -> ReadError {
    let mistake = "leads to no group or dataset of this file: soft and external links and named types \
                   are not read; copy into the file what it leads to, or leave it out";
    error(path, mistake)
}
