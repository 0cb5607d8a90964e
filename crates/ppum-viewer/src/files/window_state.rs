//! The state that the window keeps between runs.

use std::env;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::session_file;
use crate::save_target::replace;
use crate::session::Session;

/// The window's state between two sessions.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct WindowState {
    /// Width and height of the window \[points\].
    pub size: Option<[f32; 2]>,
    /// Files that were opened, the newest first.
    pub recent: Vec<PathBuf>,
}

/// Recent files that are kept.
const MOST: usize = 12;
/// More than any of these files has.
const MAX_LENGTH: u64 = 64 << 20;
const KEPT: &str = "window.json";
const LAST: &str = "last.ppum-session";

impl WindowState {
    /// Reads the state in a folder; nothing if there is no such file, or one that means nothing.
    #[must_use]
    pub fn read(folder: &Path) -> Self {
        let text = ppum_file::text(&folder.join(KEPT), MAX_LENGTH).unwrap_or_default();
        let mut kept: Self = serde_json::from_str(&text).unwrap_or_default();
        kept.recent.truncate(MOST);
        kept.size = kept.size.filter(|size| size.iter().all(|n| (100.0..20_000.0).contains(n)));
        kept
    }

    /// Keeps it in a folder, which is made if there is none.
    ///
    /// # Errors
    /// Those of the system.
    pub fn write(&self, folder: &Path) -> std::io::Result<()> {
        std::fs::create_dir_all(folder)?;
        let text = serde_json::to_string_pretty(self).map_err(std::io::Error::other)?;
        replace(&folder.join(KEPT), text.as_bytes())
    }

    /// Puts a file in front of the recent ones.
    pub fn note(&mut self, path: &Path) {
        self.recent.retain(|known| known != path);
        self.recent.insert(0, path.to_owned());
        self.recent.truncate(MOST);
    }
}

/// The session of the last time; an error in words if a file is there that is none.
///
/// # Errors
/// A file that is no session, with its new location.
pub fn last_session(folder: &Path) -> Result<Option<Session>, String> {
    let parse = |text: &str| session_file::parse(text, folder).map_err(|error| error.to_string());
    read_kept(folder, LAST, parse)
        .map_err(|error| format!("what was open the last time cannot be read: {error}"))
}

/// Reads a file of the folder, if it is there. One that means nothing may be of a newer program,
/// and hold a text that no other has: it is set aside, since the next file takes its name.
pub(super) fn read_kept<T>(
    folder: &Path,
    name: &str,
    parse: impl FnOnce(&str) -> Result<T, String>,
) -> Result<Option<T>, String> {
    let Ok(text) = ppum_file::text(&folder.join(name), MAX_LENGTH) else { return Ok(None) };
    parse(&text).map(Some).map_err(|error| format!("{error}{}", set_aside(folder, name)))
}

/// Gives a file that cannot be read a name of its own; where it is now.
fn set_aside(folder: &Path, name: &str) -> String {
    let end = Path::new(name).extension().unwrap_or_default().to_string_lossy();
    let names = (1..).map(|k| format!("unreadable-{k}.{end}"));
    let free = names.map(|name| folder.join(name)).find(|path| !path.exists());
    let moved = free.filter(|path| std::fs::rename(folder.join(name), path).is_ok());
    moved.map_or_else(String::new, |path| format!("; it is kept as {}", path.display()))
}

/// Keeps a session for the next time.
///
/// # Errors
/// Those of the system.
pub fn keep_session(session: &Session, folder: &Path) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let text = session_file::text(session, folder).map_err(std::io::Error::other)?;
    replace(&folder.join(LAST), text.as_bytes())
}

/// The folder of these files: `PPUM_CONFIG`, or where the system has the settings of programs.
#[must_use]
pub fn folder() -> Option<PathBuf> {
    let at = |name: &str| env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    if let Some(folder) = at("PPUM_CONFIG") {
        return Some(folder);
    }
    let base = if cfg!(windows) {
        at("APPDATA")
    } else if cfg!(target_os = "macos") {
        at("HOME").map(|home| home.join("Library/Application Support"))
    } else {
        at("XDG_CONFIG_HOME").or_else(|| at("HOME").map(|home| home.join(".config")))
    };
    base.map(|base| base.join("ppum"))
}
