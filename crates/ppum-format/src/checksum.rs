//! SHA-256 over the content, see "Checksum" in FORMAT.md.

use std::fmt::Write as _;

use sha2::{Digest, Sha256};

use crate::content::{Array, Content, Form, Values};
use crate::error::ReadError;

/// Name of the root attribute that holds the checksum as 64 hexadecimal digits.
const NAME: &str = "@sha256";

/// True if the content has a checksum.
#[cfg(feature = "damage")]
pub(crate) fn is_sealed(content: &Content) -> bool {
    content.contains_key(NAME)
}

/// Takes the checksum out of the content, if it has one.
pub(crate) fn remove(content: &mut Content) -> Option<Array> {
    content.remove(NAME)
}

/// Adds the checksum to the content, or makes it right.
pub(crate) fn seal(content: &mut Content) {
    remove(content);
    let sum = digest(content).expect("what is written has types of the format only");
    content.insert(NAME.into(), Array::scalar(sum));
}

/// Takes the checksum out of the content and compares. A content without one is fine.
pub(crate) fn verify(content: &mut Content) -> Result<(), ReadError> {
    content.holds("", &NAME[1..], Form::Attribute)?;
    let Some(stored) = remove(content) else { return Ok(()) };
    let (Values::Text(stored), []) = (stored.values, stored.shape.as_slice()) else {
        return Err(ReadError::object(NAME, "expected a string of 64 hexadecimal digits"));
    };
    let stored = stored.concat();
    let computed = digest(content)?;
    if stored == computed { Ok(()) } else { Err(ReadError::Checksum { stored, computed }) }
}

fn digest(content: &Content) -> Result<String, ReadError> {
    let mut hash = Sha256::new();
    for (name, array) in content.iter() {
        let shape: Vec<String> = array.shape.iter().map(u64::to_string).collect();
        let header = format!("{name} {} {}\n", array.values.type_name(), shape.join("x"));
        hash.update(header.as_bytes());
        update(&mut hash, &array.values).map_err(|mistake| ReadError::object(name, mistake))?;
    }
    Ok(hash.finalize().iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    }))
}

fn update(hash: &mut Sha256, values: &Values) -> Result<(), String> {
    match values {
        Values::F64(v) => v.iter().for_each(|x| hash.update(x.to_le_bytes())),
        Values::U8(v) => hash.update(v),
        Values::U32(v) => v.iter().for_each(|x| hash.update(x.to_le_bytes())),
        Values::U64(v) => v.iter().for_each(|x| hash.update(x.to_le_bytes())),
        Values::I64(v) => v.iter().for_each(|x| hash.update(x.to_le_bytes())),
        Values::Text(v) => v.iter().for_each(|x| {
            hash.update(x.as_bytes());
            hash.update([0]);
        }),
        Values::Other(name) => {
            return Err(format!(
                "type {name} is outside the format, so the checksum cannot be verified; keep own \
                 additions in the group `user`, or delete the root attribute `sha256`"
            ));
        }
    }
    Ok(())
}
