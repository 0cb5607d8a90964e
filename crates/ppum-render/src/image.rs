//! Images of colours.

/// Red, green, blue (sRGB) and opacity, each 0 to 255; opacity is not multiplied in.
pub type Rgba = [u8; 4];

/// An image of [`Rgba`] pixels, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Columns and rows.
    pub size: [u32; 2],
    /// The pixels, four bytes each.
    pub rgba: Vec<u8>,
}

impl Image {
    /// An image of one colour.
    #[must_use]
    pub fn filled(size: [u32; 2], color: Rgba) -> Self {
        Self { size, rgba: color.repeat(size[0] as usize * size[1] as usize) }
    }

    /// The colour of a pixel.
    #[must_use]
    pub fn pixel(&self, column: u32, row: u32) -> Rgba {
        let at = 4 * (row as usize * self.size[0] as usize + column as usize);
        [self.rgba[at], self.rgba[at + 1], self.rgba[at + 2], self.rgba[at + 3]]
    }
}
