//! Warnings about solutions, and their kinds.

use std::fmt;

use crate::vec2::Vec2;

/// A finding about a solution that does not make it wrong to have, but wrong to trust unread.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Warning {
    /// The kind.
    pub kind: WarningKind,
    /// The place, if it is about one.
    pub at: Option<Vec2>,
    /// The number that gave rise to it.
    pub value: f64,
    /// The bound that the number passes.
    pub limit: f64,
    /// The problem and its remedy, on one line, with the place.
    pub message: String,
}

impl Warning {
    /// A warning with the number that gave rise to it and the bound that this passes.
    #[must_use]
    pub fn new(
        kind: WarningKind,
        at: Option<Vec2>,
        [value, limit]: [f64; 2],
        message: String,
    ) -> Self {
        Self { kind, at, value, limit, message }
    }
}

macro_rules! warning_kinds {
    ($($(#[$doc:meta])* $kind:ident $code:literal,)*) => {
        /// The kind of a warning; its text is the code that files and JSON have for it.
        #[derive(Clone, Debug, PartialEq, Eq)]
        #[non_exhaustive]
        pub enum WarningKind {
            $($(#[$doc])* $kind,)*
            /// A warning about a temperature that is solved for, in a dataset of the body that it
            /// strains.
            OfTemperature(Box<Self>),
            /// A code that another version of the program has written.
            Other(String),
        }

        impl WarningKind {
            /// All kinds that have a code of their own.
            pub const CODES: &[(Self, &'static str)] = &[$((Self::$kind, $code)),*];
        }
    };
}

warning_kinds! {
    /// The faces of a crack overlap.
    FacesOverlap "faces-overlap",
    /// K_I of a tip is negative.
    NegativeK1 "negative-k1",
    /// A tip has no factors, because it has too little room.
    NoRoom "no-room",
    /// A tip has little room, so its factors are less accurate.
    LittleRoom "little-room",
    /// A tip is close to an interface of two materials, measured by its cells.
    NearInterface "near-interface",
    /// The factors at the radii of a tip differ.
    Spread "spread",
    /// A tip is close to the boundary, measured by the length of its crack.
    TipNearBorder "tip-near-border",
    /// A crack is as long as a few cells only.
    Coarse "coarse",
    /// Loads do not balance to the last digits.
    Imbalance "imbalance",
    /// The linear system has a large residual.
    Residual "residual",
    /// The direct solver took the place of the multilevel one.
    Solver "solver",
    /// Many functions were cut off as dependent.
    CutOff "cut-off",
    /// A crack cuts a cell at a held edge into a sliver.
    Nitsche "nitsche",
    /// Interfaces of materials are not resolved somewhere.
    Interface "interface",
    /// Coefficients cancel, and few digits of the stresses remain.
    Digits "digits",
    /// The order is too low for a body that is nearly incompressible.
    Locking "locking",
    /// The pressure of a body that is nearly incompressible oscillates.
    Pressure "pressure",
    /// Patches remain that the rim of a hole crosses twice.
    CrossedTwice "crossed-twice",
    /// The cells at a singular point of the boundary are too large for its field.
    SingularPoint "singular-point",
    /// An adaptation has ended before the estimated error was as small as wanted.
    Tolerance "tolerance",
    /// The cells at the rim of a hole are too large for the stress there.
    CoarseHole "coarse-hole",
    /// A load or what is given on the boundary varies too fast to be integrated.
    Load "load",
    /// A function or a coefficient varies too fast to be integrated.
    Quadrature "quadrature",
    /// Growth ends early, or its increments do not resolve the path.
    Growth "growth",
    /// Factors are not found again, because nobody knows the loads.
    LoadsUnknown "loads-unknown",
}

/// The code of a warning about a temperature begins with this.
const OF_TEMPERATURE: &str = "temperature-";

impl Default for WarningKind {
    fn default() -> Self {
        Self::Other(String::new())
    }
}

impl fmt::Display for WarningKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OfTemperature(kind) => write!(f, "{OF_TEMPERATURE}{kind}"),
            Self::Other(code) => f.write_str(code),
            known => {
                let code = Self::CODES.iter().find(|(kind, _)| kind == known);
                f.write_str(code.map_or("", |(_, code)| code))
            }
        }
    }
}

impl From<&str> for WarningKind {
    fn from(code: &str) -> Self {
        let known = |code: &str| {
            let known = Self::CODES.iter().find(|(_, known)| *known == code);
            known.map(|(kind, _)| kind.clone())
        };
        let of_temperature = || known(code.strip_prefix(OF_TEMPERATURE)?);
        known(code)
            .or_else(|| of_temperature().map(|kind| Self::OfTemperature(Box::new(kind))))
            .unwrap_or_else(|| Self::Other(code.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each code is that of one kind, and what another program writes stays as it is.
    #[test]
    fn kinds_come_back_from_their_codes() {
        for (kind, code) in WarningKind::CODES {
            assert_eq!((kind.to_string().as_str(), &WarningKind::from(*code)), (*code, kind));
            let of_temperature = WarningKind::OfTemperature(Box::new(kind.clone()));
            assert_eq!(of_temperature.to_string(), format!("temperature-{code}"));
            assert_eq!(WarningKind::from(&*of_temperature.to_string()), of_temperature);
        }
        for code in
            ["", "faces", "temperature-", "temperature-faces", "temperature-temperature-load"]
        {
            assert_eq!(WarningKind::from(code), WarningKind::Other(code.to_owned()));
            assert_eq!(WarningKind::from(code).to_string(), code);
        }
        assert_eq!(WarningKind::from("no-room"), WarningKind::NoRoom);
    }
}
