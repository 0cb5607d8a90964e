//! Ways to find values between the points of a grid.

use std::fmt;
use std::str::FromStr;

use ppum::text::hint;

/// The way values between the points of a grid are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// The value of the nearest point: first order.
    Nearest,
    /// Linear in x and in y between four points: second order, exact for 1, x, y, xy.
    Bilinear,
    /// Cubic convolution of sixteen points with Keys' parameter −1/2, which is Catmull–Rom's
    /// spline: third order, exact for quadratic polynomials, at the grid's border too (Keys 1981).
    Bicubic,
}

/// A word that names no interpolation.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("'{0}' is no interpolation{hint}; write nearest, bilinear or bicubic",
    hint = hint(.0, ["nearest", "bilinear", "bicubic"]))]
pub struct UnknownInterpolation(String);

impl Interpolation {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Nearest, Self::Bilinear, Self::Bicubic];

    /// Its word.
    #[must_use]
    pub fn name(self) -> &'static str {
        ["nearest", "bilinear", "bicubic"][self as usize]
    }

    /// The power of the spacing that the error of a smooth field falls with.
    #[must_use]
    pub fn order(self) -> u32 {
        1 + self as u32
    }
}

impl fmt::Display for Interpolation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Interpolation {
    type Err = UnknownInterpolation;

    fn from_str(text: &str) -> Result<Self, UnknownInterpolation> {
        let known = Self::ALL.into_iter().find(|known| known.name() == text);
        known.ok_or_else(|| UnknownInterpolation(text.to_owned()))
    }
}
