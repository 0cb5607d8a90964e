//! Kinds of graphics adapters, and which of them are good enough.

use std::fmt;

/// The kind of a graphics adapter, better ones first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum AdapterKind {
    /// A graphics card with its own memory.
    Discrete,
    /// A graphics unit that shares the processor's memory.
    Integrated,
    /// Part of a graphics card, lent to a virtual machine.
    Virtual,
    /// Not known; so are all adapters of browsers.
    Other,
    /// A program that runs on the processor.
    Software,
}

impl AdapterKind {
    /// The kind in one word.
    #[must_use]
    pub fn name(self) -> &'static str {
        ["discrete", "integrated", "virtual", "other", "software"][self as usize]
    }
}

impl fmt::Display for AdapterKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The adapters that are good enough. If there are several, the best [kind](AdapterKind) is taken,
/// and the first of one kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AdapterChoice {
    /// Graphics hardware that is known to be such: discrete, integrated or virtual.
    Real,
    /// Any adapter, a software one too.
    Any,
}

impl AdapterChoice {
    /// True if an adapter of this kind will do.
    pub(crate) fn accepts(self, kind: AdapterKind) -> bool {
        self == Self::Any || kind <= AdapterKind::Virtual
    }

    /// The text behind "adapter" in a message.
    pub(crate) fn suffix(self) -> &'static str {
        match self {
            Self::Real => " of a graphics card",
            Self::Any => "",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn software_is_no_real_adapter() {
        use AdapterKind::{Discrete, Integrated, Other, Software, Virtual};
        let real: Vec<_> = [Other, Software, Virtual, Integrated, Discrete]
            .into_iter()
            .filter(|&kind| AdapterChoice::Real.accepts(kind))
            .collect();
        assert_eq!(real, [Virtual, Integrated, Discrete]);
        assert!(AdapterChoice::Any.accepts(Software) && AdapterChoice::Any.accepts(Other));
        assert_eq!([Software, Virtual, Other, Discrete].into_iter().min(), Some(Discrete));
    }
}
