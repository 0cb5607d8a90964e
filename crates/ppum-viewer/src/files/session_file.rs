//! Sessions as files: all that was chosen, and the names of the files that it was chosen for.

use std::path::{Path, PathBuf};

use ppum_scene::colors::ColorOptions;
use ppum_scene::scene::SceneRequest;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::session::{Pane, Session, VisibleRegion};

/// The end of the names of such files.
pub const EXTENSION: &str = "ppum-session";
/// The version of their content.
const VERSION: u32 = 1;

#[derive(Serialize, Deserialize)]
struct StoredSession {
    #[serde(rename = "ppum-session")]
    version: u32,
    #[serde(flatten)]
    session: Session,
}

/// A text that is no session.
#[derive(Debug, thiserror::Error)]
pub enum SessionError {
    /// No JSON, or not that of a session.
    #[error("it is no session of ppum: {0}")]
    Foreign(#[from] serde_json::Error),
    /// One of a program to come.
    #[error(
        "it was written by a newer ppum (version {0} of sessions, this program knows {VERSION})"
    )]
    Newer(u32),
}

/// The text of a session that is kept in a folder; files in that folder and below are named
/// from there.
///
/// # Errors
/// A file whose name is no Unicode.
pub fn text(session: &Session, folder: &Path) -> Result<String, SessionError> {
    let mut session = session.clone();
    session.panes.iter_mut().for_each(make_readable);
    each_path(&mut session, |path| match path.strip_prefix(folder) {
        Ok(inside) => inside.to_owned(),
        Err(_) => path.to_owned(),
    });
    let mut text = serde_json::to_string_pretty(&StoredSession { version: VERSION, session })?;
    text.push('\n');
    Ok(text)
}

/// The session of a text that was kept in a folder, mended to what a window can show.
///
/// # Errors
/// Another text; a session of a newer program.
pub fn parse(text: &str, folder: &Path) -> Result<Session, SessionError> {
    let value: serde_json::Value = serde_json::from_str(text)?;
    let version = value.get("ppum-session").and_then(serde_json::Value::as_u64);
    if let Some(version) = version.filter(|version| *version > u64::from(VERSION)) {
        return Err(SessionError::Newer(u32::try_from(version).unwrap_or(u32::MAX)));
    }
    let StoredSession { mut session, .. } = serde_json::from_value(value)?;
    each_path(&mut session, |path| folder.join(path));
    session.repair();
    Ok(session)
}

/// Leaves what could not be read again, such as a range that somebody is about to write: the rest
/// is not lost with it.
fn make_readable(pane: &mut Pane) {
    let is_finite =
        |place: &VisibleRegion| place.center.iter().chain([&place.width]).all(|v| v.is_finite());
    pane.place = pane.place.filter(is_finite);
    if !is_readable(&pane.scene) {
        pane.scene.colors = ColorOptions::default();
    }
    if !is_readable(&pane.scene) {
        pane.scene = SceneRequest::default();
    }
    if !is_readable(pane) {
        let Pane { file, scene, place, .. } = std::mem::take(pane);
        *pane = Pane { file, scene, place, ..Pane::default() };
    }
}

fn is_readable<T: Serialize + DeserializeOwned + PartialEq>(value: &T) -> bool {
    let read = serde_json::to_value(value).and_then(serde_json::from_value::<T>);
    read.is_ok_and(|read| read == *value)
}

/// Changes the names of all files of a session.
fn each_path(session: &mut Session, change: impl Fn(&Path) -> PathBuf) {
    let panes = session.panes.iter_mut().filter_map(|pane| pane.file.as_mut());
    let draft = session.draft.as_mut();
    let drafts = draft.into_iter().flat_map(|draft| [&mut draft.path, &mut draft.folder]);
    for path in panes.chain(drafts.flatten()) {
        *path = change(path);
    }
}
