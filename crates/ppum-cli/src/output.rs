//! Standard output and error: nothing that a terminal would obey.
//!
//! Titles, names and units come from files, and may hold whatever their writers like.

use std::borrow::Cow;
use std::io::{self, IsTerminal as _, Stderr, StdoutLock, Write};

use ppum::printable::printable;

/// A standard stream. Texts for people and JSON are written to it as to any writer, and escaped.
pub(crate) struct StandardStream<W: Write = StdoutLock<'static>> {
    out: W,
    is_terminal: bool,
}

impl StandardStream {
    /// Standard output, for results.
    pub(crate) fn stdout() -> Self {
        let out = io::stdout().lock();
        Self { is_terminal: out.is_terminal(), out }
    }
}

impl StandardStream<Stderr> {
    /// Standard error, for all that is no result.
    pub(crate) fn stderr() -> Self {
        let out = io::stderr();
        Self { is_terminal: out.is_terminal(), out }
    }
}

impl<W: Write> StandardStream<W> {
    /// For data that programs read: byte for byte, but on a terminal.
    pub(crate) fn exact(&mut self) -> &mut dyn Write {
        if self.is_terminal { self } else { &mut self.out }
    }
}

impl<W: Write> Write for StandardStream<W> {
    /// Each call brings whole characters, as `write!` and JSON do.
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let text = String::from_utf8_lossy(bytes);
        self.out.write_all(printable(&text).as_bytes())?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// Writes a line to standard error. If that is closed nobody can be told.
pub(crate) fn tell(line: &str) {
    let _ = StandardStream::stderr().write_all(format!("{line}\n").as_bytes());
}

/// Shows clap's help, version or error, in its colours unless it quotes what must not be shown.
pub(crate) fn show(message: &clap::Error) {
    let text = message.render().to_string();
    match printable(&text) {
        // the reader may be gone
        Cow::Borrowed(_) => drop(message.print()),
        Cow::Owned(text) => tell(text.trim_end()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOSTILE: &str = "a\u{1b}]0;b\u{7}\u{9b}1m\u{202e}\u{7f}\r\n\tσ";
    const SHOWN: &str = "a\\u001b]0;b\\u0007\\u009b1m\\u202e\\u007f\\u000d\n\tσ";

    fn written(is_terminal: bool, write: impl FnOnce(&mut StandardStream<Vec<u8>>)) -> String {
        let mut output = StandardStream { out: Vec::new(), is_terminal };
        write(&mut output);
        String::from_utf8(output.out).expect("text")
    }

    #[test]
    fn texts_are_escaped_wherever_they_go() {
        for is_terminal in [false, true] {
            let text = written(is_terminal, |out| write!(out, "{HOSTILE}").expect("memory"));
            assert_eq!(text, SHOWN);
        }
    }

    #[test]
    fn data_are_escaped_on_terminals_only() {
        let data = |out: &mut StandardStream<Vec<u8>>| {
            out.exact().write_all(HOSTILE.as_bytes()).expect("memory");
        };
        assert_eq!(written(false, data), HOSTILE);
        assert_eq!(written(true, data), SHOWN);
    }

    /// Whoever reads JSON reads what was meant.
    #[test]
    fn json_keeps_its_meaning() {
        let hostile = format!("{HOSTILE}\\\u{9b}\"\\\\\u{e0041}");
        let text = written(false, |out| crate::number::json(out, &hostile).expect("memory"));
        assert!(text.trim_end().chars().all(ppum::printable::is_printable), "{text}");
        assert_eq!(serde_json::from_str::<String>(&text).expect("JSON"), hostile);
    }
}
