//! Standard input and output, for which `-` stands in place of a file.

use std::io::{self, IsTerminal as _, Read as _};
use std::path::Path;
use std::sync::Mutex;

use anyhow::{Context as _, bail, ensure};

/// Longest dataset on standard input, in bytes.
pub(crate) const DATASET: u64 = 1 << 30;

/// The dataset in messages.
pub(crate) const THE_DATASET: &str = "the dataset";

/// Longest text on standard input, in bytes.
const TEXT: u64 = 1 << 26;

/// The name of what standard input is, and whether it was read: it ends but once.
static READ: Mutex<Option<(&str, bool)>> = Mutex::new(None);

/// True for `-`.
pub(crate) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// The name of an input in messages.
pub(crate) fn name(path: &Path) -> String {
    if is_standard(path) { "standard input".into() } else { path.display().to_string() }
}

/// Keeps standard input for the dataset, if it is that, while what is read before may ask for it.
pub(crate) fn keep_for_dataset(file: &Path) {
    if is_standard(file)
        && let Ok(mut read) = READ.lock()
    {
        read.get_or_insert((THE_DATASET, false));
    }
}

/// Standard input to its end.
pub(crate) fn bytes(what: &'static str, limit: u64) -> anyhow::Result<Vec<u8>> {
    let before = READ.lock().ok().and_then(|mut read| read.replace((what, true)));
    if let Some((other, _)) = before.filter(|before| *before != (what, false)) {
        bail!(
            "standard input (-) is {other} already and cannot be {what} too; give a file for one of them"
        );
    }
    let mut bytes = Vec::new();
    let read = io::stdin().lock().take(limit + 1).read_to_end(&mut bytes);
    read.with_context(|| format!("cannot read {what} from standard input"))?;
    let is_short = bytes.len() as u64 <= limit;
    ensure!(is_short, "standard input: {what} is longer than {} MiB; give a file", limit >> 20);
    Ok(bytes)
}

/// Reads text from standard input.
pub(crate) fn text(what: &'static str) -> anyhow::Result<String> {
    let text = String::from_utf8(bytes(what, TEXT)?);
    text.with_context(|| format!("standard input: {what} is no UTF-8 text"))
}

/// Refuses to write what is no text to a terminal.
pub(crate) fn check_output(what: &str) -> anyhow::Result<()> {
    ensure!(
        !io::stdout().is_terminal(),
        "{what} is no text for a terminal; give a file with -o, or lead standard output into a file or a program"
    );
    Ok(())
}
