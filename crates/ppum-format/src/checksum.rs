//! SHA-256 over the content, see "Checksum" in FORMAT.md.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use rayon::prelude::*;
use sha2::{Digest, Sha256};

use crate::content::{Array, ArrayValues, ObjectKind, ObjectTree, key, step_of};
use crate::error::{ReadError, shortened};

/// Name of the attribute that holds the checksum as 64 hexadecimal digits: of the root over all, of
/// a step over what is in it.
const NAME: &str = "sha256";

/// The root's over what is in no step.
const REST: &str = "sha256_rest";

/// The parts of a content that have a checksum of their own.
#[derive(Clone, Debug)]
enum ChecksumScope {
    All,
    Rest,
    Step(String),
}

impl ChecksumScope {
    /// The group and the name of the attribute.
    fn place(&self) -> (&str, &'static str) {
        match self {
            Self::All => ("", NAME),
            Self::Rest => ("", REST),
            Self::Step(path) => (path, NAME),
        }
    }

    /// The attribute's name in the content.
    fn key(&self) -> String {
        let (group, name) = self.place();
        key(group, name, ObjectKind::Attribute)
    }

    /// The items that count, by the names under which they do, in their order. Its own checksum
    /// does not count, nor does that over all, which counts the others.
    fn items<'c>(&'c self, content: &'c ObjectTree) -> BTreeMap<&'c str, (&'c String, &'c Array)> {
        let begin = if let Self::Step(path) = self { path.as_str() } else { "" };
        let left_out = [self.key(), Self::All.key()];
        let counted = content.beginning(begin).filter(|(name, _)| !left_out.contains(name));
        counted.filter_map(|item| Some((self.name(item.0)?, item))).collect()
    }

    /// The name under which an item counts, if it does.
    fn name<'n>(&self, full: &'n str) -> Option<&'n str> {
        match self {
            Self::All => Some(full),
            Self::Rest => step_of(full).is_none().then_some(full),
            Self::Step(path) => {
                let inside = full.strip_prefix(path.as_str())?;
                inside.strip_prefix('/').or(Some(inside).filter(|name| name.starts_with('@')))
            }
        }
    }
}

/// All scopes of a content but that over all.
fn parts(content: &ObjectTree) -> Vec<ChecksumScope> {
    let steps: BTreeSet<&str> = content.groups().filter_map(step_of).collect();
    let steps = steps.into_iter().map(|path| ChecksumScope::Step(path.to_owned()));
    [ChecksumScope::Rest].into_iter().chain(steps).collect()
}

/// Takes all checksums out of the content.
pub(crate) fn remove(content: &mut ObjectTree) {
    for scope in [ChecksumScope::All].into_iter().chain(parts(content)) {
        content.remove(&scope.key());
    }
}

/// Adds the checksum over all to the content, or makes it right.
pub(crate) fn seal(content: &mut ObjectTree) {
    remove(content);
    add(content, &ChecksumScope::All);
}

/// Adds a checksum for each step and one for the rest, or makes them right.
pub(crate) fn seal_parts(content: &mut ObjectTree) {
    remove(content);
    parts(content).iter().for_each(|scope| add(content, scope));
}

/// Adds the checksum of a step.
pub(crate) fn seal_step(content: &mut ObjectTree, path: &str) {
    add(content, &ChecksumScope::Step(path.to_owned()));
}

fn add(content: &mut ObjectTree, scope: &ChecksumScope) {
    let sum = digest(content, scope).expect("what is written has types of the format only");
    content.insert(scope.key(), Array::scalar(sum));
}

/// True if the content has the checksum over all.
pub(crate) fn is_whole(content: &ObjectTree) -> bool {
    content.contains_key(&ChecksumScope::All.key())
}

/// Compares the checksums of the content. A part without one is fine.
pub(crate) fn verify(content: &ObjectTree) -> Result<(), ReadError> {
    let scopes: Vec<_> = [ChecksumScope::All].into_iter().chain(parts(content)).collect();
    let compared: Vec<_> = scopes.par_iter().map(|scope| check(content, scope)).collect();
    compared.into_iter().collect()
}

/// Verifies the content outside of steps.
pub(crate) fn verify_rest(content: &ObjectTree) -> Result<(), ReadError> {
    check(content, &ChecksumScope::Rest)
}

/// Verifies a step.
pub(crate) fn verify_step(content: &ObjectTree, path: &str) -> Result<(), ReadError> {
    check(content, &ChecksumScope::Step(path.to_owned()))
}

fn check(content: &ObjectTree, scope: &ChecksumScope) -> Result<(), ReadError> {
    let (group, name) = scope.place();
    content.holds(group, name, ObjectKind::Attribute)?;
    let Some(stored) = content.get(&scope.key()) else { return Ok(()) };
    let (ArrayValues::Text(stored), [] | [1]) = (&stored.values, stored.shape.as_slice()) else {
        let message = "expected a string of 64 hexadecimal digits";
        return Err(ReadError::object(&scope.key(), message));
    };
    let (stored, computed) = (stored.concat(), digest(content, scope)?);
    if stored == computed {
        return Ok(());
    }
    Err(ReadError::Checksum { attribute: scope.key(), stored: shortened(stored), computed })
}

fn digest(content: &ObjectTree, scope: &ChecksumScope) -> Result<String, ReadError> {
    let mut hash = Sha256::new();
    for (name, (full, array)) in scope.items(content) {
        let shape: Vec<String> = array.shape.iter().map(u64::to_string).collect();
        let header = format!("{name} {} {}\n", array.values.type_name(), shape.join("x"));
        hash.update(header.as_bytes());
        update(&mut hash, &array.values).map_err(|message| ReadError::object(full, message))?;
    }
    Ok(hash.finalize().iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    }))
}

fn update(hash: &mut Sha256, values: &ArrayValues) -> Result<(), String> {
    match values {
        ArrayValues::Text(v) => v.iter().for_each(|x| {
            hash.update(x.as_bytes());
            hash.update([0]);
        }),
        ArrayValues::Other(name) => {
            return Err(format!(
                "type {name} is outside the format, so the checksum cannot be verified; keep own \
                 additions in the group `user`, or delete the attribute with the checksum"
            ));
        }
        numbers => hash.update(numbers.little_endian().unwrap_or_default()),
    }
    Ok(())
}
