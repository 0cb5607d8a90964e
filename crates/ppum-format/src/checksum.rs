//! SHA-256 over the content, see "Checksum" in FORMAT.md.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use rayon::prelude::*;
use sha2::{Digest, Sha256};

use crate::content::{Array, ArrayValues, Content, ObjectKind, key, step_of};
use crate::error::ReadError;

/// Name of the attribute that holds the checksum as 64 hexadecimal digits: of the root over all, of
/// a step over what is in it.
const NAME: &str = "sha256";

/// The root's over what is in no step.
const REST: &str = "sha256_rest";

/// The parts of a content that have a checksum of their own.
#[derive(Clone, Debug)]
enum Scope {
    All,
    Rest,
    Step(String),
}

impl Scope {
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
    fn items<'c>(&'c self, content: &'c Content) -> BTreeMap<&'c str, (&'c String, &'c Array)> {
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
fn parts(content: &Content) -> Vec<Scope> {
    let steps: BTreeSet<&str> = content.groups().filter_map(step_of).collect();
    let steps = steps.into_iter().map(|path| Scope::Step(path.to_owned()));
    [Scope::Rest].into_iter().chain(steps).collect()
}

/// Takes all checksums out of the content.
pub(crate) fn remove(content: &mut Content) {
    for scope in [Scope::All].into_iter().chain(parts(content)) {
        content.remove(&scope.key());
    }
}

/// Adds the checksum over all to the content, or makes it right.
pub(crate) fn seal(content: &mut Content) {
    remove(content);
    add(content, &Scope::All);
}

/// Adds a checksum for each step and one for the rest, or makes them right.
pub(crate) fn seal_parts(content: &mut Content) {
    remove(content);
    parts(content).iter().for_each(|scope| add(content, scope));
}

/// Adds the checksum of a step.
pub(crate) fn seal_step(content: &mut Content, path: &str) {
    add(content, &Scope::Step(path.to_owned()));
}

fn add(content: &mut Content, scope: &Scope) {
    let sum = digest(content, scope).expect("what is written has types of the format only");
    content.insert(scope.key(), Array::scalar(sum));
}

/// True if the content has the checksum over all.
pub(crate) fn is_whole(content: &Content) -> bool {
    content.contains_key(&Scope::All.key())
}

/// Compares the checksums of the content. A part without one is fine.
pub(crate) fn verify(content: &Content) -> Result<(), ReadError> {
    let scopes: Vec<_> = [Scope::All].into_iter().chain(parts(content)).collect();
    let compared: Vec<_> = scopes.par_iter().map(|scope| check(content, scope)).collect();
    compared.into_iter().collect()
}

/// The same for what is in no step.
pub(crate) fn verify_rest(content: &Content) -> Result<(), ReadError> {
    check(content, &Scope::Rest)
}

/// The same for a step.
pub(crate) fn verify_step(content: &Content, path: &str) -> Result<(), ReadError> {
    check(content, &Scope::Step(path.to_owned()))
}

fn check(content: &Content, scope: &Scope) -> Result<(), ReadError> {
    let (group, name) = scope.place();
    content.holds(group, name, ObjectKind::Attribute)?;
    let Some(stored) = content.get(&scope.key()) else { return Ok(()) };
    let (ArrayValues::Text(stored), [] | [1]) = (&stored.values, stored.shape.as_slice()) else {
        let mistake = "expected a string of 64 hexadecimal digits";
        return Err(ReadError::object(&scope.key(), mistake));
    };
    let (stored, computed) = (stored.concat(), digest(content, scope)?);
    if stored == computed {
        return Ok(());
    }
    Err(ReadError::Checksum { attribute: scope.key(), stored, computed })
}

fn digest(content: &Content, scope: &Scope) -> Result<String, ReadError> {
    let mut hash = Sha256::new();
    for (name, (full, array)) in scope.items(content) {
        let shape: Vec<String> = array.shape.iter().map(u64::to_string).collect();
        let header = format!("{name} {} {}\n", array.values.type_name(), shape.join("x"));
        hash.update(header.as_bytes());
        update(&mut hash, &array.values).map_err(|mistake| ReadError::object(full, mistake))?;
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
