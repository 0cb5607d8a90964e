//! A step → the bytes that are appended to a file, and those that publish it.
//!
//! Nothing of the file moves or changes but its superblock. Behind the end come the objects of the
//! step, then a new header of the group `steps`, with one link more, and a new header of the root,
//! which leads to that one. The superblock then names the new root and the new end. Everything that
//! the old state described is still there, unchanged.
//!
//! So that the length of a file stays linear in its steps the header of `steps` itself holds few
//! links: as soon as there are [`LINKS`] of them they move to a block of their own, which continues
//! in the block before.

use super::budget::memory_of;
use super::messages::{
    Addition, CONTINUATION, HeaderMessage, LINK, LINK_INFO, NO_HEAP, block, header,
};
use super::objects::group;
use super::read::Ranges;
use super::write::{END, ROOT, SUPERBLOCK, superblock};
use crate::content::ObjectTree;
use crate::error::WriteError;
use crate::lookup3::lookup3;

/// The group that grows.
const STEPS: &str = "steps";

/// Links in the header of `steps`: some 1.4 kB, little beside the headers of a step, which take 8
/// kB.
const LINKS: usize = 64;

/// Times the length of what is appended that its arrays may take in memory, compressed: a reader
/// takes four times the length of a file, whatever the number of its steps.
const EXPANSION: u64 = 3;

/// The part of a file that appending changes.
#[derive(Clone, Debug)]
pub(crate) struct AppendState {
    /// Where the file ends.
    end: u64,
    /// Messages of the root but the link to `steps`.
    root: Vec<HeaderMessage>,
    /// Messages of `steps` but the links in its own header.
    steps: Vec<HeaderMessage>,
    links: Vec<HeaderMessage>,
}

/// The bytes of a step that are appended to a file.
pub(crate) struct AppendedStep {
    /// The end of the file, behind which the bytes belong.
    pub(crate) end: u64,
    pub(crate) bytes: Vec<u8>,
    /// The bytes at the start of the file that publish them.
    pub(crate) start: Vec<u8>,
}

impl AppendState {
    /// Reads the state of a file that this program began; none of what another program may have
    /// made of it.
    pub(crate) fn read(file: &dyn Ranges) -> Option<Self> {
        let mut start = [0; SUPERBLOCK];
        fill(file, 0, &mut start)?;
        let (end, root) = (word(&start, END), word(&start, ROOT));
        if start != superblock(end, root) {
            return None;
        }
        let mut root = gathered(file, messages(file, root)?)?;
        let at = root.iter().position(|m| m.link_to(STEPS).is_some())?;
        let address = root.remove(at).link_to(STEPS)?;
        let all = messages(file, address)?;
        // a group whose links are in a heap would not show one in its header
        let is_plain =
            |message: &HeaderMessage| message.kind != LINK_INFO || message.body == NO_HEAP;
        let (links, steps): (Vec<_>, Vec<_>) = all.into_iter().partition(|m| m.kind == LINK);
        steps.iter().all(is_plain).then_some(Self { end, root, steps, links })
    }

    /// Writes the objects that make a step part of the file, and the state of the file that has it.
    pub(crate) fn step(
        &self,
        content: &ObjectTree,
        path: &str,
    ) -> Result<(AppendedStep, Self), WriteError> {
        let (addition, address) = self.objects(content, path)?;
        let name = path.rsplit('/').next().unwrap_or(path);
        self.clone().grown(addition, HeaderMessage::link(name, address))
    }

    /// The objects of the step, compressed as long as they can be read again.
    fn objects(&self, content: &ObjectTree, path: &str) -> Result<(Addition, u64), WriteError> {
        let stored = |compressed| {
            let mut addition = Addition::new(self.end);
            let address = group(&mut addition, content, path, compressed)?;
            Ok((addition, address))
        };
        let (addition, address) = stored(true)?;
        let memory: u64 = content.values().map(memory_of).sum();
        let length = addition.end() - self.end;
        if memory <= EXPANSION * length { Ok((addition, address)) } else { stored(false) }
    }

    fn grown(
        mut self,
        mut addition: Addition,
        link: HeaderMessage,
    ) -> Result<(AppendedStep, Self), WriteError> {
        if self.links.len() >= LINKS {
            self.move_links(&mut addition)?;
        }
        self.links.push(link);
        let steps = addition.put(&header(&[self.steps.as_slice(), &self.links].concat())?);
        let link = HeaderMessage::link(STEPS, steps);
        let root = addition.put(&header(&[self.root.as_slice(), &[link]].concat())?);
        let end = std::mem::replace(&mut self.end, addition.end());
        let start = superblock(self.end, root).to_vec();
        Ok((AppendedStep { end, bytes: addition.into_bytes(), start }, self))
    }

    /// Moves the links of `steps` to a block, which continues where the header has continued until
    /// now.
    fn move_links(&mut self, addition: &mut Addition) -> Result<(), WriteError> {
        let mut moved = std::mem::take(&mut self.links);
        moved.extend(self.steps.extract_if(.., |message| message.kind == CONTINUATION));
        let bytes = block(&moved)?;
        let address = addition.put(&bytes);
        self.steps.push(HeaderMessage::continuation(address, bytes.len() as u64));
        Ok(())
    }
}

/// A number of eight bytes.
fn word(bytes: &[u8], at: usize) -> u64 {
    bytes[at..].first_chunk().map_or(0, |bytes| u64::from_le_bytes(*bytes))
}

/// The messages of a header as this program writes it, without those of the blocks that it
/// continues in.
fn messages(file: &dyn Ranges, address: u64) -> Option<Vec<HeaderMessage>> {
    let mut start = [0; HEADER_START];
    fill(file, address, &mut start)?;
    let width = 1 << (start[5] & 3);
    // nothing but the width of the length
    if start[..5] != *b"OHDR\x02" || start[5] > 3 || width > 4 {
        return None;
    }
    let length = start[6..6 + width].iter().rev().fold(0, |n, byte| n << 8 | usize::from(*byte));
    if length > LONGEST_HEADER {
        return None;
    }
    let mut bytes = vec![0; 6 + width + length + 4];
    fill(file, address, &mut bytes)?;
    parsed(&unsealed(&bytes)?[6 + width..])
}

/// The messages of a header with those of the blocks that it continues in: who adds something of
/// his own to the root may have moved some there.
fn gathered(file: &dyn Ranges, mut messages: Vec<HeaderMessage>) -> Option<Vec<HeaderMessage>> {
    // more blocks would be a header that goes round in a circle
    for _ in 0..MOST_BLOCKS {
        let Some(at) = messages.iter().position(|m| m.kind == CONTINUATION) else {
            messages.retain(|message| message.kind != NOTHING);
            return Some(messages);
        };
        let place = messages.remove(at).body;
        let (address, length) = place.split_at_checked(8).filter(|(_, rest)| rest.len() == 8)?;
        let length = usize::try_from(word(length, 0)).ok().filter(|n| *n <= LONGEST_HEADER)?;
        let mut bytes = vec![0; length];
        fill(file, word(address, 0), &mut bytes)?;
        messages.extend(parsed(unsealed(&bytes)?.strip_prefix(b"OCHK")?)?);
    }
    None
}

/// Most blocks that a root continues in: one for each time that something was added to it by
/// somebody else.
const MOST_BLOCKS: usize = 100;

/// A part without its checksum, if that is right.
fn unsealed(bytes: &[u8]) -> Option<&[u8]> {
    let (body, sum) = bytes.split_last_chunk()?;
    (lookup3(body) == u32::from_le_bytes(*sum)).then_some(body)
}

/// Kind of a message that takes room where one was.
const NOTHING: u8 = 0;

/// Bytes of a header up to its longest length.
const HEADER_START: usize = 10;

/// Longest header that is read: title and name of the program are the longest messages of those
/// at hand.
const LONGEST_HEADER: usize = 1 << 20;

fn parsed(mut bytes: &[u8]) -> Option<Vec<HeaderMessage>> {
    let mut messages = Vec::new();
    // what is shorter than a prefix is a gap
    while let Some((&[kind, low, high, flags], rest)) = bytes.split_first_chunk() {
        let (body, rest) = rest.split_at_checked(usize::from(u16::from_le_bytes([low, high])))?;
        messages.push(HeaderMessage { kind, flags, body: body.to_vec() });
        bytes = rest;
    }
    Some(messages)
}

fn fill(file: &dyn Ranges, at: u64, buffer: &mut [u8]) -> Option<()> {
    file.read(at, buffer).ok()
}
