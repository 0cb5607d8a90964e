//! The changes from one image to the next.

/// The reason why there is no such animation.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AnimationError {
    /// No images.
    #[error("a moving picture needs one image at least")]
    Empty,
    /// More images than were announced, or fewer.
    #[error("{found} images of a moving picture of {announced}")]
    Count {
        /// The number that was announced.
        announced: u32,
        /// The number so far.
        found: u32,
    },
    /// Images of several sizes.
    #[error("image {index} of a moving picture has {}x{} pixels, the first one {}x{}",
        size[0], size[1], first[0], first[1])]
    Sizes {
        /// The image, counted from 0.
        index: usize,
        /// Its size.
        size: [u32; 2],
        /// That of the first one.
        first: [u32; 2],
    },
    /// A side that GIF has no numbers for.
    #[error("a GIF has at most 65535x65535 pixels, not {}x{}", size[0], size[1])]
    TooLarge {
        /// The size.
        size: [u32; 2],
    },
    /// PNG's own reasons: an impossible key of a text, an image without pixels.
    #[error("cannot encode the moving picture")]
    Png(#[from] ::png::EncodingError),
    /// GIF's own reasons.
    #[error("cannot encode the moving picture")]
    Gif(#[from] ::gif::EncodingError),
}

/// Columns and rows of a box of pixels: from, up to but not including.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PixelBox {
    pub(super) from: [usize; 2],
    pub(super) to: [usize; 2],
}

impl PixelBox {
    /// The least box around the pixels that differ; the first pixel if none does.
    pub(super) fn between<T: PartialEq>(old: &[T], new: &[T], columns: usize) -> Self {
        let (mut from, mut to) = ([usize::MAX; 2], [0; 2]);
        let lines = old.chunks_exact(columns).zip(new.chunks_exact(columns)).enumerate();
        for (row, (old, new)) in lines.filter(|(_, (old, new))| old != new) {
            let differ = || old.iter().zip(new).map(|(a, b)| a != b);
            let first = differ().position(|d| d).unwrap_or(0);
            let last = columns - differ().rev().position(|d| d).unwrap_or(0);
            from = [from[0].min(first), from[1].min(row)];
            to = [to[0].max(last), row + 1];
        }
        if to == [0; 2] { Self { from: [0; 2], to: [1; 2] } } else { Self { from, to } }
    }

    pub(super) fn size(self) -> [usize; 2] {
        [self.to[0] - self.from[0], self.to[1] - self.from[1]]
    }

    /// The places of its pixels in the image, row by row.
    pub(super) fn places(self, columns: usize) -> impl Iterator<Item = usize> {
        let Self { from, to } = self;
        (from[1]..to[1]).flat_map(move |row| (from[0]..to[0]).map(move |at| row * columns + at))
    }
}

pub(super) fn check_size(
    index: u32,
    size: [u32; 2],
    first: [u32; 2],
) -> Result<(), AnimationError> {
    if size == first {
        return Ok(());
    }
    Err(AnimationError::Sizes { index: index as usize, size, first })
}
