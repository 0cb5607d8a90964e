//! Messages between a page and its evaluator.

use ppum_render::view::{self, ViewError};
use ppum_scene::scene::SceneRequest;
use serde::{Deserialize, Serialize};

/// A part of the plane on a grid of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PageView {
    /// The middle, in world coordinates.
    pub center: [f64; 2],
    /// Width \[length\].
    pub width: f64,
    /// Columns and rows.
    pub pixels: [u32; 2],
}

impl PageView {
    /// The view of the renderer.
    ///
    /// # Errors
    /// As [`view::View::new`].
    pub fn checked(&self) -> Result<view::View, ViewError> {
        view::View::new(self.center.into(), self.width, self.pixels)
    }
}

impl From<view::View> for PageView {
    fn from(view::View { center, width, pixels }: view::View) -> Self {
        Self { center: center.into(), width, pixels }
    }
}

/// An image: what it shows, and where.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PageFrame {
    /// The shown scene.
    pub scene: SceneRequest,
    /// Where it is seen.
    pub view: PageView,
    /// The name of the dataset's file, for the command that draws the image.
    #[serde(default)]
    pub file: String,
    /// True while the view moves: the range of the image before is kept, if that showed the same.
    #[serde(default)]
    pub keeps_range: bool,
}

/// Some rows of an image.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImageRows {
    /// The image.
    pub frame: PageFrame,
    /// The first row, a multiple of 32, and the row behind the last.
    pub rows: [u32; 2],
}

/// A question for the values at a point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointQuestion {
    /// The image that the point is in.
    pub frame: PageFrame,
    /// Its continuous pixel coordinates; the centre of pixel (i, j) is (i + 1/2, j + 1/2).
    pub pixel: [f64; 2],
    /// Distance in pixels within which a tip or a crack takes the point's place.
    pub reach: f64,
}

/// The content of a dataset, as a page offers it, with the parts that depend on the step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Description {
    /// The title; may be empty.
    pub title: String,
    /// Lower left and upper right corner of the domain.
    pub bounds: [[f64; 2]; 2],
    /// The load of each step.
    pub loads: Vec<f64>,
    /// The number of patches of the step.
    pub patches: usize,
    /// Quantities of points.
    pub quantities: Vec<PageChoice>,
    /// Values of cells.
    pub cells: Vec<PageChoice>,
    /// The name of the quantity that is shown where none is asked for.
    pub quantity: String,
    /// Names of colour maps.
    pub colormaps: Vec<String>,
    /// Crack tips of the step, in their order.
    pub tips: Vec<[f64; 2]>,
}

/// Something that can be shown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PageChoice {
    /// The text that asks for it.
    pub text: String,
    /// Its words, with subscripts as `_{…}`.
    pub label: String,
}

/// The colour bar of an image, and what is to be said beside it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PageLegend {
    /// Quantity, reference of the labels and unit: `σ_{yy} [×10³ MPa]`.
    pub label: String,
    /// The values at the ends of the bar.
    pub range: [f64; 2],
    /// Colours at even positions from the lower to the upper end, `#rrggbb`.
    pub colors: Vec<String>,
    /// Marks from the lower to the upper end.
    pub ticks: Vec<PageTick>,
    /// The colour of values below the range, and above it, if there are some.
    pub beyond: [Option<String>; 2],
    /// The smallest value if it lies below the range, and the largest one if it lies above.
    pub extremes: [Option<String>; 2],
    /// The range and the extrema, in a sentence.
    pub sentence: String,
    /// The command line that draws the image.
    pub command: String,
    /// Notices about the image.
    pub notices: Vec<String>,
}

/// A mark of a colour bar.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PageTick {
    /// Its place, from 0 to 1.
    pub at: f64,
    /// The label.
    pub label: String,
}

/// The values at a point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointReading {
    /// The point is `anchor + offset`.
    pub anchor: [f64; 2],
    /// The way from the anchor.
    pub offset: [f64; 2],
    /// Where it is in the image, in continuous pixel coordinates.
    pub pixel: [f64; 2],
    /// The point, with the digits that tell neighbouring pixels apart.
    pub place: String,
    /// True inside the domain.
    pub is_inside: bool,
    /// The number of the tip that it is, if it is one.
    pub tip: Option<usize>,
    /// One value, or those above and below a crack.
    pub sides: Vec<SideReading>,
    /// The jump across the crack, if the point lies on one.
    pub jump: Option<String>,
    /// All that is known, with all digits, to be copied.
    pub text: String,
}

/// A value and its gradient, on one side of a crack.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SideReading {
    /// `above` or `below` on a crack.
    pub name: Option<String>,
    /// The value for people: `2.718282`, `∞`, `not defined`.
    pub value: String,
    /// The value with all digits, as `ppum probe` prints it.
    pub exact: String,
    /// Size and direction of the gradient: `3.2 at 45°`; none where there is no gradient.
    pub gradient: Option<String>,
}
