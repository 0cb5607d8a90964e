//! All that is asked of an image: what it shows, where, and how that is drawn. An option of
//! `ppum render` is a field of [`Request`] or of what it holds, once for the command line, for
//! JSON and for [`command`].

#[cfg(feature = "clap")]
pub mod arguments;
pub mod backend;
pub mod colors;
pub mod command;
#[cfg(feature = "clap")]
pub mod help;
pub mod list;
pub mod magnification;
pub mod mirror;
pub mod overlays;
pub mod page_style;
pub mod region;
pub mod scene;
pub(crate) mod written;

use ppum::dataset::Dataset;
use ppum::vec2::Rect;
use ppum_figure::figure::{BarPlace, FigureStyle, Labels};
use ppum_render::samples::Samples;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

#[cfg(feature = "clap")]
use crate::request::arguments::layout;
use crate::request::backend::{Backend, Precision};
use crate::request::mirror::{Mirror, MirrorError};
use crate::request::page_style::PageStyle;
use crate::request::region::ViewRegion;
use crate::request::scene::SceneRequest;

/// The content of an image, its view, and its style.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[serde(default)]
pub struct Request {
    /// Add axes, a colour bar, a title and the cracks
    #[cfg_attr(feature = "clap", arg(long))]
    pub figure: bool,
    /// Draw the overlays alone, without colours and colour bar
    #[cfg_attr(feature = "clap", arg(long))]
    pub blank: bool,
    /// Size and look of the page.
    #[cfg_attr(feature = "clap", command(flatten))]
    pub look: PageStyle,
    /// The texts of a figure that take the place of those of the program.
    #[cfg_attr(feature = "clap", arg(skip))]
    pub labels: FigureTexts,
    /// Several quantities or parts in one figure.
    #[cfg_attr(feature = "clap", command(flatten))]
    pub panels: Panels,
    /// The part of the plane that is seen.
    #[cfg_attr(feature = "clap", command(flatten))]
    pub place: ViewRegion,
    /// The shown scene.
    #[cfg_attr(feature = "clap", command(flatten))]
    #[serde(flatten)]
    pub scene: SceneRequest,
    /// Supersampling: average N x N values in each pixel, for smooth edges
    #[cfg_attr(feature = "clap", arg(long, value_name = "N", default_value = "1"))]
    #[serde(serialize_with = "side", deserialize_with = "samples")]
    pub samples: Samples,
    /// Device that computes the values
    #[cfg_attr(feature = "clap", arg(long, value_enum, default_value = "auto"))]
    pub backend: Backend,
    /// Precision of the values [default: f64 on the CPU, f32 on the GPU]
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub precision: Option<Precision>,
}

/// Several quantities, or parts of a field, each in a panel of one figure.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[serde(default, deny_unknown_fields)]
pub struct Panels {
    /// The quantities, which take the place of that of the scene.
    #[cfg_attr(feature = "clap", arg(skip))]
    pub quantities: Vec<String>,
    /// The parts, of which `all` is the whole field; they take the place of that of the scene.
    #[cfg_attr(feature = "clap", arg(skip))]
    pub parts: Vec<String>,
    /// Columns and rows of the panels of several quantities or parts [default: as large as fits]
    #[cfg_attr(feature = "clap", arg(long, value_name = "CxR", value_parser = layout))]
    pub layout: Option<[u32; 2]>,
    /// Give all panels one range and one colour bar
    #[cfg_attr(feature = "clap", arg(long))]
    pub shared_range: bool,
}

/// The reason why there are no such panels.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PanelsError {
    /// Several parts of a deformed body.
    #[error("several parts and the deformed plate do not go together; draw them one by one")]
    Deformed,
    /// A layout of no panels.
    #[error("layout: give at least 1x1 panels")]
    Empty,
    /// A layout of too few panels.
    #[error("layout: {0}x{1} has fewer panels than there are pictures, {2}", layout[0], layout[1], count)]
    Few {
        /// Columns and rows.
        layout: [u32; 2],
        /// The number of images.
        count: usize,
    },
    /// One range for one image.
    #[error("a shared range is for panels; give several quantities or parts")]
    Shared,
    /// Panels of several steps.
    #[error("several panels and several steps do not go together; draw the panels of one step")]
    Steps,
}

impl Panels {
    /// Refuses what panels do not have of a scene, and what only they have of a single image.
    ///
    /// # Errors
    /// Several parts of a deformed body; one range for one image.
    pub fn check(&self, scene: &SceneRequest) -> Result<(), PanelsError> {
        match () {
            () if scene.deformed.is_some() && self.parts.len() > 1 => Err(PanelsError::Deformed),
            () if self.shared_range && !self.are_given() => Err(PanelsError::Shared),
            () => Ok(()),
        }
    }

    /// Refuses panels of several steps.
    ///
    /// # Errors
    /// There are panels.
    pub fn check_steps(&self) -> Result<(), PanelsError> {
        if self.are_given() { Err(PanelsError::Steps) } else { Ok(()) }
    }

    /// True for a figure of several panels, or of one that is called so.
    #[must_use]
    pub fn are_given(&self) -> bool {
        self.layout.is_some() || self.quantities.len() > 1 || self.parts.len() > 1
    }
}

impl Default for Request {
    fn default() -> Self {
        SceneRequest::default().into()
    }
}

impl From<SceneRequest> for Request {
    fn from(scene: SceneRequest) -> Self {
        Self {
            figure: false,
            blank: false,
            look: PageStyle::default(),
            labels: FigureTexts::default(),
            panels: Panels::default(),
            place: ViewRegion::default(),
            scene,
            samples: Samples::CENTER,
            backend: Backend::default(),
            precision: None,
        }
    }
}

impl Request {
    /// True for a figure, of one panel or of several.
    #[must_use]
    pub fn is_figure(&self) -> bool {
        self.figure || self.panels.are_given()
    }

    /// Returns the scene of its image of a dataset, with the edges named at which the body is
    /// mirrored: figures show the whole of a body of revolution unless the request says otherwise.
    ///
    /// # Errors
    /// As [`Mirror::edges`].
    pub fn scene_of(&self, dataset: &Dataset) -> Result<SceneRequest, MirrorError> {
        let mut scene = self.scene.clone();
        if self.is_figure() && scene.mirror.is_none() {
            scene.mirror = Mirror::of_figures(dataset);
        }
        scene.with_edges(dataset)
    }

    /// Returns the request for a step.
    #[must_use]
    pub fn at_step(&self, step: usize) -> Self {
        let mut request = self.clone();
        request.scene.subject.step = Some(step);
        request
    }

    /// The look of a figure of a box, that of all that is shown, of a size unless another is given,
    /// with so many panels across and down.
    #[must_use]
    pub fn design(&self, whole: Rect, size: [u32; 2], panels: [u32; 2]) -> FigureStyle {
        let design = self.look.design(self.place.aspect(whole), size, panels);
        if self.blank { FigureStyle { bar: BarPlace::None, ..design } } else { design }
    }
}

/// Texts of a figure; what is empty is left out.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FigureTexts {
    /// The title.
    pub title: Option<String>,
    /// Below the x axis.
    pub x: Option<String>,
    /// Beside the y axis.
    pub y: Option<String>,
    /// At the colour bar.
    pub bar: Option<String>,
}

impl FigureTexts {
    /// These texts, and others where they have none.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self {
            title: self.title.or(other.title),
            x: self.x.or(other.x),
            y: self.y.or(other.y),
            bar: self.bar.or(other.bar),
        }
    }

    /// The labels with those texts that are given.
    #[must_use]
    pub fn applied(&self, labels: Labels) -> Labels {
        let or = |text: &Option<String>, label: String| text.clone().unwrap_or(label);
        Labels {
            title: or(&self.title, labels.title),
            x: or(&self.x, labels.x),
            y: or(&self.y, labels.y),
            quantity: or(&self.bar, labels.quantity),
            ..labels
        }
    }
}

fn side<S: Serializer>(samples: &Samples, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_u32(samples.side())
}

fn samples<'d, D: Deserializer<'d>>(deserializer: D) -> Result<Samples, D::Error> {
    let most = Samples::MOST;
    let found = u8::deserialize(deserializer).ok().and_then(Samples::new);
    found.ok_or_else(|| de::Error::custom(format!("samples: write a number from 1 to {most}")))
}
