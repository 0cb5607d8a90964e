//! Parts of a field: only the smooth, the jump or the tip blocks, or those of one patch.
//!
//! A field is a sum of blocks, so it is also the sum of its parts by kind, and of its parts
//! by patch:
//!
//! ```text
//! v = v_smooth + v_jump + v_tip + v_other = Σ_i φ_i v_i
//! ```
//!
//! A part is a field like any other, of the same partition of unity, with fewer blocks: whatever
//! evaluates, draws or stores fields takes it as it is.

use std::fmt;
use std::str::FromStr;

use crate::dataset::FieldData;
use crate::function::{Frame, Function, FunctionKind};
use crate::text::hint;

/// A part of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldPart {
    /// Blocks of the function 1.
    Smooth,
    /// Blocks of the sides of cracks, and of components.
    Jump,
    /// Blocks of formulas in the frames of crack tips.
    Tip,
    /// Blocks of all other formulas: those in world coordinates and in fixed frames.
    Other,
    /// φ_i v_i of this patch, whatever its functions.
    Patch(u32),
}

/// The kinds of blocks; every block is of exactly one.
pub const KINDS: [FieldPart; 4] =
    [FieldPart::Smooth, FieldPart::Jump, FieldPart::Tip, FieldPart::Other];

/// A part that a field does not have.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PartError {
    /// No such patch.
    #[error("there is no patch {patch}; the field has {count} (numbered from 0)")]
    NoPatch {
        /// The patch asked for.
        patch: u32,
        /// Number of patches.
        count: usize,
    },
    /// No block belongs to the part: it is zero everywhere.
    #[error("field `{field}` has no block of the part `{part}`; the kinds that it has are {known}")]
    Empty {
        /// Name of the field.
        field: String,
        /// The part asked for.
        part: FieldPart,
        /// The kinds of blocks that there are.
        known: String,
    },
}

/// A text that names no [`FieldPart`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "there is no part `{0}`{hint}; there are smooth, jump, tip, other, and patch:N with the number of a patch",
    hint = hint(.0, KINDS.map(FieldPart::name))
)]
pub struct UnknownPart(String);

impl FieldPart {
    /// The word for it; that for a patch is followed by the patch's number.
    fn name(self) -> &'static str {
        match self {
            Self::Smooth => "smooth",
            Self::Jump => "jump",
            Self::Tip => "tip",
            Self::Other => "other",
            Self::Patch(_) => "patch",
        }
    }

    /// The kind of the blocks of a function.
    #[must_use]
    pub fn of(function: &FunctionKind) -> Self {
        match function {
            FunctionKind::One => Self::Smooth,
            FunctionKind::Side { .. }
            | FunctionKind::Component { .. }
            | FunctionKind::Level { .. } => Self::Jump,
            FunctionKind::Formula { frame: Frame::Tip(_) | Frame::Levels(_), .. } => Self::Tip,
            FunctionKind::Formula { .. } => Self::Other,
        }
    }
}

impl FieldData {
    /// A part of the field; `functions` is the table of its step. The partition of unity is that of
    /// the whole, so the parts of all kinds add up to it, and so do those of all patches. Blocks
    /// that do not belong to the part are gone, not zero: 0 · f has no value where f has none, but
    /// the smooth part has a gradient at a tip. The exact solution, which is one of the whole, is
    /// gone too. Coefficients stay where they are.
    ///
    /// # Errors
    /// No such patch; no block of that part.
    pub fn part(&self, part: FieldPart, functions: &[Function]) -> Result<Self, PartError> {
        let count = self.patch_blocks.len().saturating_sub(1);
        if let FieldPart::Patch(patch) = part
            && patch as usize >= count
        {
            return Err(PartError::NoPatch { patch, count });
        }
        let kind =
            |block: usize| FieldPart::of(&functions[self.block_function[block] as usize].kind);
        let found = self.with_blocks(|patch, block| match part {
            FieldPart::Patch(only) => patch == only as usize,
            _ => kind(block) == part,
        });
        if found.block_function.is_empty() {
            let has = |known: &FieldPart| (0..self.block_function.len()).any(|b| kind(b) == *known);
            let known: Vec<_> = KINDS.iter().filter(|k| has(k)).map(FieldPart::to_string).collect();
            let (field, known) = (self.name.clone(), known.join(", "));
            return Err(PartError::Empty { field, part, known });
        }
        Ok(found)
    }

    /// The field of the blocks that are `wanted`, by patch and block.
    fn with_blocks(&self, wanted: impl Fn(usize, usize) -> bool) -> Self {
        let mut part = Self {
            patch_blocks: vec![0],
            block_function: Vec::new(),
            block_degree: Vec::new(),
            block_offset: Vec::new(),
            exact: Vec::new(),
            ..self.clone()
        };
        for patch in 0..self.patch_blocks.len().saturating_sub(1) {
            for block in self.blocks(patch).filter(|&block| wanted(patch, block)) {
                part.block_function.push(self.block_function[block]);
                part.block_degree.push(self.block_degree[block]);
                part.block_offset.push(self.block_offset[block]);
            }
            part.patch_blocks.push(part.block_function.len() as u32);
        }
        part
    }
}

impl fmt::Display for FieldPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Patch(patch) => write!(f, "patch:{patch}"),
            kind => f.write_str(kind.name()),
        }
    }
}

impl FromStr for FieldPart {
    type Err = UnknownPart;

    fn from_str(text: &str) -> Result<Self, UnknownPart> {
        let kind = KINDS.into_iter().find(|kind| kind.to_string() == text);
        let patch = || text.strip_prefix("patch:")?.parse().ok().map(Self::Patch);
        kind.or_else(patch).ok_or_else(|| UnknownPart(text.to_owned()))
    }
}
