//! All that is asked of an image, but for its place and its page: what it shows, and how that
//! is drawn.

use ppum_figure::figure::Labels;
use ppum_render::samples::Samples;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use crate::engine::{Backend, Precision};
use crate::scene::Scene;

/// What an image shows, and how it is drawn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Request {
    /// What it shows.
    #[serde(flatten)]
    pub scene: Scene,
    /// Each pixel shows the mean of so many samples across and down.
    #[serde(serialize_with = "side", deserialize_with = "samples")]
    pub samples: Samples,
    /// True if the plate is white: overlays alone.
    pub blank: bool,
    /// The texts of a figure that take the place of those of the program.
    pub labels: Texts,
    /// What computes the values.
    pub backend: Backend,
    /// The precision that they are computed in, by default that of the backend.
    pub precision: Option<Precision>,
}

impl Default for Request {
    fn default() -> Self {
        Scene::default().into()
    }
}

impl From<Scene> for Request {
    fn from(scene: Scene) -> Self {
        Self {
            scene,
            samples: Samples::CENTER,
            blank: false,
            labels: Texts::default(),
            backend: Backend::default(),
            precision: None,
        }
    }
}

/// Texts of a figure; what is empty is left out.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Texts {
    /// The title.
    pub title: Option<String>,
    /// Below the x axis.
    pub x: Option<String>,
    /// Beside the y axis.
    pub y: Option<String>,
    /// At the colour bar.
    pub bar: Option<String>,
}

impl Texts {
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
