//! The objects of a file.

use pdf_writer::{Pdf, Ref};

use crate::canvas::zlib::zlib;

/// A file that is being written.
pub(super) struct File {
    pub(super) pdf: Pdf,
    last: i32,
}

impl File {
    pub(super) fn new() -> Self {
        Self { pdf: Pdf::new(), last: 0 }
    }

    /// The number of the next object.
    pub(super) fn place(&mut self) -> Ref {
        self.last += 1;
        Ref::new(self.last)
    }

    /// An object that is bytes, compressed.
    pub(super) fn stream(&mut self, place: Ref, bytes: &[u8]) {
        let bytes = zlib(bytes);
        self.pdf.stream(place, &bytes).filter(pdf_writer::Filter::FlateDecode);
    }
}
