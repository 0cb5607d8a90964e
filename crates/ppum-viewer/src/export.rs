//! What is taken out of the window: pictures, figures, moving pictures, and the command that
//! draws them.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use ppum::progress::Watcher;
use ppum_figure::figure::Design;
use ppum_figure::form::PageFormat;
use ppum_render::view::View;
use ppum_scene::command;
use ppum_scene::drawing::Shown;
use ppum_scene::engine::Engine;
use ppum_scene::minus::Side;
use ppum_scene::moving::{AnimationFormat as Animation, Film, Frames as _, InMemory, Moving};
use ppum_scene::notice::Notice;
use ppum_scene::place::Place;
use ppum_scene::request::Request;
use ppum_scene::scene::Scene;
use ppum_scene::shot::{FieldSource, page, reshaped, view_in};

use crate::field::OwnedField;

/// An image, a figure or an animation to export.
#[derive(Clone, Debug, PartialEq)]
pub enum ExportKind {
    /// The picture alone, as it is seen.
    Picture,
    /// With axes, colour bar and title.
    Figure,
    /// Several, one after the other, so many a second.
    Moving(Moving, f64),
}

/// The kinds of files that can be chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExportChoice {
    /// The picture alone.
    Picture,
    /// With axes, colour bar and title.
    Figure,
    /// The steps of a series.
    Steps,
    /// The deformed plate, its factor growing and falling.
    Deformation,
}

impl ExportChoice {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Picture, Self::Figure, Self::Steps, Self::Deformation];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Picture => "Picture",
            Self::Figure => "Figure",
            Self::Steps => "Animation of the steps",
            Self::Deformation => "Animation of the deformation",
        }
    }

    /// What the names of its files may end in, the usual one first.
    #[must_use]
    pub fn ends(self) -> &'static [&'static str] {
        match self {
            Self::Picture | Self::Figure => &["png", "svg", "pdf"],
            Self::Steps | Self::Deformation => &["gif", "apng", "png"],
        }
    }
}

/// A picture that is to be written.
#[derive(Clone, Debug)]
pub struct Order {
    /// The field that is looked at, with what is replaced in it.
    pub field: Arc<OwnedField>,
    /// The file of its dataset.
    pub file: Option<PathBuf>,
    /// What is subtracted: a field, and what is shown of it.
    pub left: Option<(Arc<OwnedField>, Arc<Shown>)>,
    /// What is shown, and how.
    pub scene: Scene,
    /// Where.
    pub view: View,
    /// Columns and rows of the page.
    pub size: [u32; 2],
    /// What is written.
    pub kind: ExportKind,
}

/// Why there is no animation of a difference.
const NOT_MOVING: &str =
    "an animation is of one view; save pictures of the difference, or switch it off (Shift+V)";
/// Why there is no command of a difference.
pub const NO_COMMAND: &str = "no command draws the difference of two views; a session does: ppum view --session … --screenshot …";

impl Order {
    fn design(&self) -> Option<Design> {
        (self.kind != ExportKind::Picture).then(|| Design::pixels(self.size))
    }

    /// The file's bytes, in the form that its name ends in, and what is to be said of them.
    ///
    /// # Errors
    /// What keeps the picture from being drawn, or from being encoded, in words.
    pub fn bytes(
        &self,
        path: &Path,
        watcher: &dyn Watcher,
    ) -> Result<(Vec<u8>, Vec<Notice>), String> {
        let engine = Engine::processor(watcher);
        let bytes = match &self.kind {
            ExportKind::Moving(..) if self.left.is_some() => Err(NOT_MOVING.into()),
            ExportKind::Moving(moving, rate) => self.moving(moving, *rate, path, &engine),
            _ => self.still(path, &engine),
        };
        Ok((bytes?, engine.into_notices()))
    }

    fn source(&self) -> FieldSource<'_> {
        let left = self.left.as_ref();
        let left = left.map(|(field, shown)| Side { field: field.field(), shown });
        FieldSource { dataset: self.field.dataset(), field: self.field.field(), left }
    }

    fn still(&self, path: &Path, engine: &Engine<'_>) -> Result<Vec<u8>, String> {
        let (source, request) = (self.source(), Request::from(self.scene.clone()));
        let view = reshaped(&self.view, self.size).map_err(|e| e.to_string())?;
        let made = page(source, &request, &view, self.design().as_ref(), engine);
        let (page, shot) = made.map_err(|e| e.to_string())?;
        let command = match self.left {
            None => self.command(path)?,
            Some(_) => NO_COMMAND.into(),
        };
        let mut texts = shot.texts(&name(self.file.as_deref()));
        texts.push(("ppum:command".to_owned(), command));
        texts.extend(shot.notes());
        let form = PageFormat::of(path);
        Notice::of_glyphs(&page, form).into_iter().for_each(|notice| engine.tell(notice));
        form.bytes(&page, None, &texts).map_err(|e| e.to_string())
    }

    fn moving(
        &self,
        moving: &Moving,
        rate: f64,
        path: &Path,
        engine: &Engine<'_>,
    ) -> Result<Vec<u8>, String> {
        let (source, request) = (self.source(), Request::from(self.scene.clone()));
        let frames = InMemory::new(source.dataset, &request, moving).map_err(|e| e.to_string())?;
        let design = self.design();
        let room = |design| frames.room(design).map_err(|e| e.to_string());
        let room = design.as_ref().map_or(Ok(self.size), room)?;
        let view = reshaped(&self.view, self.size).and_then(|view| reshaped(&view, room));
        let view = view.map_err(|e| e.to_string())?;
        let film = Film::new(&frames, &view, design.as_ref(), engine).map_err(|e| e.to_string())?;
        let milliseconds = (1000.0 / rate).round().clamp(10.0, 60_000.0) as u16;
        let is_gif = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("gif"));
        let (form, mut bytes) = (if is_gif { Animation::Gif } else { Animation::Apng }, Vec::new());
        film.write(form, milliseconds, &|_| Vec::new(), &mut bytes).map_err(|e| e.to_string())?;
        Ok(bytes)
    }

    /// The command that draws the same.
    ///
    /// # Errors
    /// A size without room for a figure, a difference, which no command draws; in words.
    pub fn command(&self, output: &Path) -> Result<String, String> {
        if self.left.is_some() {
            return Err(NO_COMMAND.into());
        }
        let mut request = Request::from(self.scene.clone());
        let mut view = reshaped(&self.view, self.size).map_err(|e| e.to_string())?;
        if let Some(design) = self.design() {
            let room = view_in(self.source(), &request, &view, &design);
            view = room.map_err(|e| e.to_string())?;
            request.figure = true;
        }
        (request.place, request.look.size) = (Place::of(&view), Some(self.size));
        let file = name(self.file.as_deref());
        let output = output.to_string_lossy();
        let mut words = command::render(&request, &file, &output);
        if let ExportKind::Moving(Moving::Steps(_), rate) = self.kind {
            words.retain(|word| !word.starts_with("--step="));
            words.extend(["--steps=all".to_owned(), format!("--fps={rate:?}")]);
        }
        Ok(command::line(&words))
    }
}

/// The name of a file, as a command would say it.
fn name(path: Option<&Path>) -> String {
    path.map_or_else(|| "FILE.h5".into(), |path| path.to_string_lossy().into_owned())
}
