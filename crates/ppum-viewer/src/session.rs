//! All that a person chooses: what is looked at, where, and how. Plain data that is compared,
//! undone, kept and written.

use std::path::{Path, PathBuf};

use ppum::vec2::{Vec2, vec2};
use ppum_render::view::{View, ViewError};
use ppum_scene::colors::ColorOptions;
use ppum_scene::compare::Compare;
use ppum_scene::overlays::Overlay;
use ppum_scene::profile::{COUNT, ProfileCurve};
use ppum_scene::scene::SceneRequest;
use serde::{Deserialize, Serialize};

use ppum_scene::location::Location;

/// The state of the window.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Session {
    /// One view, or two side by side.
    pub panes: Vec<Pane>,
    /// The pane that keys and panels act on.
    pub active: usize,
    /// True if both panes show the same place.
    pub linked: bool,
    /// The difference of the two.
    pub minus: DifferenceChoice,
    /// True if the panels on the right are open.
    pub panels: bool,
    /// The page of the drawer below, if it is open.
    pub drawer: Option<DrawerPage>,
    /// Colours of the window.
    pub theme: WindowTheme,
    /// The problem whose text is open.
    pub draft: Option<ProblemDraft>,
}

/// The difference of two views, which the second one shows: its values minus those of the first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct DifferenceChoice {
    /// True if it is shown.
    pub is_shown: bool,
    /// The colours of the second view when it shows the other of the two, its own values or
    /// the difference.
    pub colors: ColorOptions,
}

/// The text of a problem while it is written.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct ProblemDraft {
    /// Its file, if it came from one or was saved.
    pub path: Option<PathBuf>,
    /// The folder of the files that it names, if that is not its own.
    pub folder: Option<PathBuf>,
    /// The text.
    pub text: String,
    /// The text as its file has it, or as an example or a dataset gave it.
    pub original: Option<String>,
}

impl ProblemDraft {
    /// The text of an example or a dataset, which nobody has changed yet.
    pub(crate) fn unchanged(text: String) -> Self {
        Self { original: Some(text.clone()), text, ..Self::default() }
    }

    /// True if no file, example or dataset has the text as it is.
    #[must_use]
    pub fn is_changed(&self) -> bool {
        self.original.as_ref() != Some(&self.text)
    }

    /// The name of its file, or its title.
    #[must_use]
    pub fn name(&self) -> String {
        let file = self.path.as_deref().and_then(Path::file_name);
        let title = || title(&self.text).unwrap_or("a text without a title").to_owned();
        file.map_or_else(title, |name| name.to_string_lossy().into_owned())
    }

    /// The file that it may be saved as: its own; of a drawing, one of its title beside it.
    pub(crate) fn proposed_name(&self) -> Option<PathBuf> {
        let beside = || {
            let folder = self.folder.as_ref().filter(|_| self.original.is_none())?;
            let name = Path::new(title(&self.text)?).file_name()?;
            Some(folder.join(name).with_added_extension("toml"))
        };
        self.path.clone().or_else(beside)
    }

    /// True if both are states of one problem: of one file, or, without a file, of one text that
    /// was changed.
    #[must_use]
    pub fn is_same_problem(&self, other: &Self) -> bool {
        if let (Some(path), Some(other)) = (&self.path, &other.path) {
            return path == other;
        }
        let states = |draft: &Self| [Some(draft.text.clone()), draft.original.clone()];
        let theirs = states(other);
        states(self).iter().any(|text| text.is_some() && theirs.contains(text))
    }
}

/// The title that the text of a problem gives, whatever errors are in it.
#[must_use]
pub fn title(text: &str) -> Option<&str> {
    let value = |line| str::trim_start(line).strip_prefix("title")?.trim_start().strip_prefix('=');
    let quoted = text.lines().find_map(value)?.trim_start().strip_prefix('"')?;
    quoted.split('"').next().filter(|title| !title.is_empty())
}

/// One view.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Pane {
    /// The dataset's file.
    pub file: Option<PathBuf>,
    /// The shown scene.
    pub scene: SceneRequest,
    /// The visible region; the whole body if there is none.
    pub place: Option<VisibleRegion>,
    /// The resampling beside it, if that is shown.
    pub compare: Option<Compare>,
    /// How that is looked at.
    pub against: SplitChoice,
    /// Points whose values are kept in sight.
    pub probes: Vec<Location>,
    /// The curve that values are plotted along.
    pub curve: Option<ProfileCurve>,
    /// How they are plotted.
    pub plot: PlotChoice,
    /// True if the extrema of the view are marked.
    pub extrema: bool,
    /// True if an automatic range is that of the step that is shown, of a series too, and not that
    /// of all its steps.
    pub one_step_range: bool,
}

impl Default for Pane {
    /// The whole of a dataset that is still to be chosen, with its cracks and rims, which dark
    /// maps hide.
    fn default() -> Self {
        let mut scene = SceneRequest::default();
        scene.overlays.shown.push(Overlay::Cracks);
        Self {
            file: None,
            scene,
            place: None,
            compare: None,
            against: SplitChoice::default(),
            probes: Vec::new(),
            curve: None,
            plot: PlotChoice::default(),
            extrema: false,
            one_step_range: false,
        }
    }
}

/// How the direct image is seen beside what resampling gives of it: that on the right of a divider.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SplitChoice {
    /// Place of the divider, in parts of the image's width.
    pub divider: f64,
    /// True if the difference is shown, not the resampled image.
    pub difference: bool,
}

impl Default for SplitChoice {
    fn default() -> Self {
        Self { divider: 0.5, difference: false }
    }
}

/// The plot along a curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PlotChoice {
    /// Quantities or formulas in a list; those that suit if nothing is said.
    pub quantities: Option<String>,
    /// True for a logarithmic axis: the horizontal one, the vertical one.
    pub log: [bool; 2],
    /// Number of points.
    pub count: usize,
}

impl Default for PlotChoice {
    fn default() -> Self {
        Self { quantities: None, log: [false; 2], count: COUNT }
    }
}

/// A part of the plane, whatever the number of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct VisibleRegion {
    /// The middle.
    pub center: [f64; 2],
    /// The width of the image.
    pub width: f64,
}

/// Pages of the drawer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum DrawerPage {
    /// Values along a curve.
    Plot,
    /// A table of the crack tips.
    Tips,
    /// Values over the steps.
    Series,
    /// The solver's report.
    Solver,
    /// The problem's text.
    Problem,
}

impl DrawerPage {
    /// All of them, in their order.
    pub const ALL: [Self; 5] = [Self::Plot, Self::Tips, Self::Series, Self::Solver, Self::Problem];
}

/// Colours of the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum WindowTheme {
    /// As the system has it.
    #[default]
    System,
    /// Dark on white.
    Light,
    /// Light on black.
    Dark,
}

impl Default for Session {
    fn default() -> Self {
        Self {
            panes: vec![Pane::default()],
            active: 0,
            linked: true,
            minus: DifferenceChoice::default(),
            panels: true,
            drawer: None,
            theme: WindowTheme::default(),
            draft: None,
        }
    }
}

impl Session {
    /// The pane that keys and panels act on.
    #[must_use]
    pub fn pane(&self) -> &Pane {
        &self.panes[self.active]
    }

    /// Returns the pane, to be changed.
    pub fn pane_mut(&mut self) -> &mut Pane {
        &mut self.panes[self.active]
    }

    /// Shows the difference of two views, or the second one's own values; with colours of its own
    /// each, and both views at the same place.
    pub fn subtract(&mut self, is_shown: bool) {
        let [left, right] = &mut self.panes[..] else { return };
        if self.minus.is_shown != is_shown {
            self.minus.is_shown = is_shown;
            std::mem::swap(&mut right.scene.colors, &mut self.minus.colors);
        }
        if is_shown {
            self.linked = true;
            left.place = right.place;
        }
    }

    /// Takes what has a history of its own, or is no setting, from another state: places, files and
    /// the problem's text.
    pub fn take_places(&mut self, from: &Self) {
        self.draft.clone_from(&from.draft);
        for (pane, from) in self.panes.iter_mut().zip(&from.panes) {
            pane.place = from.place;
            pane.file.clone_from(&from.file);
        }
    }

    /// Without places, files and the problem's text.
    pub(crate) fn settings(&self) -> Self {
        let draft = None;
        let mut settings = Self { draft, ..self.clone() };
        for pane in &mut settings.panes {
            (pane.place, pane.file) = (None, None);
        }
        settings
    }

    /// A session of the same looks in which nothing is open.
    pub(crate) fn look(&self) -> Self {
        Self { panels: self.panels, linked: self.linked, theme: self.theme, ..Self::default() }
    }

    /// Mends what a file may say and the window cannot show: no pane, more than two, one active
    /// that is not there.
    pub fn repair(&mut self) {
        self.panes.truncate(2);
        if self.panes.is_empty() {
            self.panes.push(Pane::default());
        }
        self.active = self.active.min(self.panes.len() - 1);
        self.minus.is_shown &= self.panes.len() == 2;
    }
}

impl VisibleRegion {
    /// The place of a view.
    pub(crate) fn of(view: &View) -> Self {
        Self { center: view.center.into(), width: view.width }
    }

    /// The view of it on so many pixels.
    ///
    /// # Errors
    /// As [`View::new`].
    pub fn view(&self, pixels: [u32; 2]) -> Result<View, ViewError> {
        View::new(self.center(), self.width, pixels)
    }

    /// The middle.
    pub(crate) fn center(&self) -> Vec2 {
        vec2(self.center[0], self.center[1])
    }
}
