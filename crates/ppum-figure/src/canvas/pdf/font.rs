//! The font in PDF files.
//!
//! Characters have codes in the order in which they come. A code leads to its glyph and, for who
//! searches or copies, to its character; so even a character whose glyph is lacking can be copied.

use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Finish as _, Name, Rect, Ref, Str};

use super::File;
use crate::canvas::zlib::zlib;
use crate::text::{self, FONT_FILE};

/// The font's name in resources.
pub(super) const NAME: Name<'static> = Name(b"F");
/// Six letters and a plus say that it is a part of a font.
const BASE: Name<'static> = Name(b"PPUMAA+DejaVuSans");
const SYSTEM: SystemInfo<'static> =
    SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };
/// Glyph space: a thousandth of an em.
const EM: f64 = 1000.0;

/// The characters that a page shows.
#[derive(Default)]
pub(super) struct Font {
    characters: Vec<char>,
}

impl Font {
    /// The bytes that show a text, two for a character.
    pub(super) fn encoded(&mut self, text: &str) -> Vec<u8> {
        text.chars().flat_map(|c| self.code(c).to_be_bytes()).collect()
    }

    /// A character's code, from 1; 0, an empty box, where there are more than codes.
    fn code(&mut self, c: char) -> u16 {
        let index = self.characters.iter().position(|known| *known == c).unwrap_or_else(|| {
            self.characters.push(c);
            self.characters.len() - 1
        });
        u16::try_from(index + 1).unwrap_or(0)
    }

    /// Adds the font's objects if there are letters.
    pub(super) fn write(self, file: &mut File) -> Option<Ref> {
        if self.characters.is_empty() {
            return None;
        }
        let [font, letters, about, program, glyphs, meaning] = [(); 6].map(|()| file.place());
        let mut record = file.pdf.type0_font(font);
        record.base_font(BASE).encoding_predefined(Name(b"Identity-H"));
        record.descendant_font(letters).to_unicode(meaning);
        record.finish();
        self.letters(file, [letters, about, glyphs]);
        describe(file, about, program);
        let bytes = zlib(FONT_FILE);
        let mut stream = file.pdf.stream(program, &bytes);
        stream
            .filter(pdf_writer::Filter::FlateDecode)
            .pair(Name(b"Length1"), FONT_FILE.len() as i32);
        stream.finish();
        let codes = [0].into_iter().chain(self.characters.iter().map(|c| text::glyph(*c)));
        let codes: Vec<u8> = codes.flat_map(u16::to_be_bytes).collect();
        file.stream(glyphs, &codes);
        self.meaning(file, meaning);
        Some(font)
    }

    fn letters(&self, file: &mut File, [letters, about, glyphs]: [Ref; 3]) {
        let mut record = file.pdf.cid_font(letters);
        record.subtype(CidFontType::Type2).base_font(BASE).system_info(SYSTEM);
        record.font_descriptor(about).cid_to_gid_map_stream(glyphs);
        let widths = self.characters.iter().map(|c| (EM * text::advance(*c)) as f32);
        record.widths().consecutive(1, widths);
    }

    fn meaning(&self, file: &mut File, place: Ref) {
        let mut map = UnicodeCmap::<u16>::new(Name(b"Custom"), SYSTEM);
        for (code, c) in (1..=u16::MAX).zip(&self.characters) {
            map.pair(code, *c);
        }
        let bytes = map.finish().to_vec();
        file.stream(place, &bytes);
    }
}

/// Measures of DejaVu Sans, in thousandths of an em; the box is the font's own.
fn describe(file: &mut File, about: Ref, program: Ref) {
    let mut record = file.pdf.font_descriptor(about);
    record.name(BASE).flags(FontFlags::SYMBOLIC).italic_angle(0.0);
    record.bbox(Rect::new(-1021.0, -463.0, 1793.0, 1232.0));
    record.ascent(928.0).descent(-236.0).cap_height(729.0).stem_v(80.0).font_file2(program);
}
