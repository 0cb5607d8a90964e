//! Texts of files as they may be shown: nothing that a terminal obeys, nothing that is not seen.

use std::borrow::Cow;
use std::fmt::Write as _;

/// True for what is shown as it is. False for control characters, C0, C1 and DEL; for those that
/// change the direction of the text around them; for those that break lines or are not seen, but
/// for the two joiners (U+200C, U+200D), which languages need.
#[must_use]
pub fn is_printable(c: char) -> bool {
    let is_format = matches!(
        c,
        '\u{ad}'
            | '\u{61c}'
            | '\u{180e}'
            | '\u{200b}'
            | '\u{200e}'..='\u{200f}'
            | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{feff}'
            | '\u{fff9}'..='\u{fffb}'
            | '\u{e0000}'..='\u{e007f}'
    );
    !c.is_control() && !is_format
}

/// The text with what is not printable, except for ends of lines and tabs, as JSON escapes it:
/// `\u001b`. Outside of strings JSON has no such characters, so JSON stays the same to who reads
/// it.
///
/// ```
/// use ppum_formula::printable::printable;
///
/// assert_eq!(printable("σ in\tMPa\n"), "σ in\tMPa\n");
/// assert_eq!(printable("\u{1b}[31mred\u{9b}"), r"\u001b[31mred\u009b");
/// ```
#[must_use]
pub fn printable(text: &str) -> Cow<'_, str> {
    let is_kept = |c: char| matches!(c, '\n' | '\t') || is_printable(c);
    if text.chars().all(is_kept) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if is_kept(c) {
            shown.push(c);
        } else {
            for unit in c.encode_utf16(&mut [0; 2]) {
                write!(shown, "\\u{unit:04x}").expect("a text takes what it is given");
            }
        }
    }
    Cow::Owned(shown)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_of_many_languages_stay() {
        for text in
            ["", "plate, 3 µm × 10⁻³", "نمی\u{200c}خواهم", "漢字", "🏳\u{fe0f}\u{200d}🌈", "a\n\tb"]
        {
            assert!(matches!(printable(text), Cow::Borrowed(same) if same == text), "{text}");
        }
    }

    /// All of Unicode's categories Cc, Cf, Zl and Zp up to U+FFFF that common terminals act on.
    #[test]
    fn what_terminals_obey_is_escaped() {
        let controls = (0..0x20).chain(0x7f..0xa0).filter(|c| !matches!(c, 0x9 | 0xa));
        let formats = [0xad, 0x61c, 0x200b, 0x200e, 0x200f, 0x2028, 0x2029, 0xfeff];
        let directions = (0x202a..=0x202e).chain(0x2066..=0x2069);
        for code in controls.chain(formats).chain(directions) {
            let c = char::from_u32(code).expect("a character");
            assert_eq!(printable(&format!("a{c}b")), format!("a\\u{code:04x}b"));
        }
        assert_eq!(printable("\u{e0041}"), "\\udb40\\udc41");
    }
}
