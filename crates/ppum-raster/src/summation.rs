//! The order in which the renderer sums over patches.

/// The order in which the renderer sums the patches of a view. All agree to rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Summation {
    /// Per patch where patches have fewer than 4 pixels on average and neither weight nor
    /// functions are evaluated as formulas, else in row spans.
    #[default]
    Automatic,
    /// Patches are collapsed to polynomials in y at columns of vectors of pixels, which are
    /// evaluated row by row.
    RowSpans(Savings),
    /// Each patch adds to the pixels that it covers. Weights by formula are summed in row spans
    /// all the same.
    PerPatch,
}

/// Shortcuts of the summation in row spans, which change results by rounding alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Savings {
    /// Patches with the same weight, coordinate and functions in y share a row span.
    pub merge_patches: bool,
    /// Where one row span covers all points its weight in y, which cancels, is not evaluated.
    pub cancel_weights: bool,
    /// Numbers in the tables of row spans that are kept at a time, more if one span has them.
    pub table_numbers: usize,
}

impl Savings {
    /// All shortcuts, and tables of 8 MiB in f64.
    pub const ALL: Self =
        Self { merge_patches: true, cancel_weights: true, table_numbers: 1 << 20 };
    /// No shortcuts, and tables of all row spans at once.
    pub const NONE: Self =
        Self { merge_patches: false, cancel_weights: false, table_numbers: usize::MAX };
}
