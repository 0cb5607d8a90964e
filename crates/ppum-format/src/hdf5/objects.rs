//! Groups, attributes and arrays as HDF5 stores them: headers of version 2, links and attributes in
//! them.

use std::collections::BTreeMap;

use super::layout::{contiguous, large};
use super::messages::{Addition, HeaderMessage, LINK_INFO, NO_HEAP, header};
use super::values::{bytes, datatype, long_text};
use crate::content::{Array, ObjectKind, ObjectTree, join, key};
use crate::error::WriteError;

/// Kinds of messages.
const DATASPACE: u8 = 0x01;
const DATATYPE: u8 = 0x03;
const FILL_VALUE: u8 = 0x05;
const GROUP_INFO: u8 = 0x0a;
const ATTRIBUTE: u8 = 0x0c;
const ATTRIBUTE_INFO: u8 = 0x15;

/// Puts a group with all that is in it behind the end. The address of its header.
pub(super) fn group(
    addition: &mut Addition,
    content: &ObjectTree,
    path: &str,
    compressed: bool,
) -> Result<u64, WriteError> {
    let mut layouts = BTreeMap::new();
    let inside = join(path, "");
    for (name, array) in content.beginning(&inside) {
        let is_attribute = name.contains('@');
        if !is_attribute && let Some(layout) = large(addition, name, array, compressed)? {
            layouts.insert(name.as_str(), layout);
        }
    }
    headers(addition, content, path, &layouts)
}

/// Where large arrays are: their layout and filters.
type Layouts<'c> = BTreeMap<&'c str, Vec<HeaderMessage>>;

fn headers(
    addition: &mut Addition,
    content: &ObjectTree,
    path: &str,
    layouts: &Layouts,
) -> Result<u64, WriteError> {
    // without the message about attributes programs of HDF5 such as h5repack count none
    let mut messages = vec![
        HeaderMessage::new(LINK_INFO, NO_HEAP.to_vec()),
        HeaderMessage::new(GROUP_INFO, vec![0; 2]),
        HeaderMessage::new(ATTRIBUTE_INFO, NO_HEAP.to_vec()),
    ];
    for name in content.attributes(path) {
        let full = key(path, name, ObjectKind::Attribute);
        let attribute = attribute(addition, &full, name, &content[&full])?;
        messages.push(HeaderMessage::new(ATTRIBUTE, attribute));
    }
    let mut members: Vec<&str> = content.members(path).collect();
    members.sort_unstable();
    for name in members {
        let full = join(path, name);
        let address = match content.get(&full) {
            Some(array) => dataset(addition, &full, array, layouts)?,
            None => headers(addition, content, &full, layouts)?,
        };
        messages.push(HeaderMessage::link(name, address));
    }
    Ok(addition.put(&header(&messages)?))
}

fn attribute(
    addition: &mut Addition,
    full: &str,
    name: &str,
    array: &Array,
) -> Result<Vec<u8>, WriteError> {
    let (datatype, values) = match long_text(addition, array) {
        Some((datatype, value)) => (datatype, value.into()),
        None => (datatype(full, array)?, bytes(array)),
    };
    let space = dataspace(&array.shape);
    let sizes = [name.len() as u16 + 1, datatype.len() as u16, space.len() as u16];
    // version, flags; the name is ASCII
    let mut body = vec![3, 0];
    body.extend(sizes.iter().flat_map(|size| size.to_le_bytes()));
    body.push(0);
    body.extend(name.as_bytes());
    body.push(0);
    Ok([&body, &datatype, &space, &*values].concat())
}

fn dataset(
    addition: &mut Addition,
    name: &str,
    array: &Array,
    layouts: &Layouts,
) -> Result<u64, WriteError> {
    let layout = match layouts.get(name) {
        Some(layout) => layout.clone(),
        None => vec![contiguous(addition, &bytes(array))],
    };
    let mut messages = vec![
        HeaderMessage::new(DATASPACE, dataspace(&array.shape)),
        HeaderMessage::new(DATATYPE, datatype(name, array)?),
        // version; values that nobody writes, of which there are none, are not defined
        HeaderMessage::new(FILL_VALUE, vec![3, 0x0a]),
    ];
    messages.extend(layout);
    Ok(addition.put(&header(&messages)?))
}

fn dataspace(shape: &[u64]) -> Vec<u8> {
    // version, rank, flags, scalar or not
    let mut body = vec![2, shape.len() as u8, 0, u8::from(!shape.is_empty())];
    body.extend(shape.iter().flat_map(|n| n.to_le_bytes()));
    body
}
