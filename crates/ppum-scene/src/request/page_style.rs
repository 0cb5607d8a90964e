//! Size and look of images and figures, as data.

use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

use ppum_figure::figure::{BarPlace, FigureStyle, Theme, TickChoice, hugging};
use serde::{Deserialize, Deserializer, Serialize, de};

#[cfg(feature = "clap")]
use crate::request::arguments::{positive, size};
use crate::request::list::numbers;
use crate::request::overlays::listed;

/// Size and look of an image; what only figures have is refused of others by
/// [`PageStyle::of_figures`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[serde(default, deny_unknown_fields)]
pub struct PageStyle {
    /// Width and height of the page in pixels [default: 1024x768, in a bare image of the whole
    /// domain at most; 660x600 for each of several panels]
    #[cfg_attr(
        feature = "clap",
        arg(long, value_name = "WxH", value_parser = size),
        arg(conflicts_with_all = ["inches", "cm"])
    )]
    pub size: Option<[u32; 2]>,
    /// Width and height on paper in inches; with a width alone the height follows from the image
    #[cfg_attr(feature = "clap", arg(long, value_name = "W[xH]", conflicts_with = "cm"))]
    pub inches: Option<PaperSize>,
    /// Width and height on paper in centimetres, as with --inches
    #[cfg_attr(feature = "clap", arg(long, value_name = "W[xH]"))]
    pub cm: Option<PaperSize>,
    /// Pixels per inch [default: 300 for a size on paper, else 96]
    #[cfg_attr(feature = "clap", arg(long, value_name = "N", value_parser = dpi))]
    #[serde(deserialize_with = "checked_dpi")]
    pub dpi: Option<f64>,
    /// Font size of a figure in points [default: 9 for a size on paper, else in proportion to the
    /// size in pixels]
    #[cfg_attr(feature = "clap", arg(long, value_name = "PT", value_parser = positive))]
    pub font_size: Option<f64>,
    /// Colours of a figure around its image [default: light]
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub theme: Option<ThemeName>,
    /// Give a figure a transparent background
    #[cfg_attr(feature = "clap", arg(long))]
    pub transparent: bool,
    /// Position of a figure's colour bar, or none [default: auto, below long bodies, else right]
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub bar: Option<BarName>,
    /// Ticks of the axes x and y and of the colour bar: auto, about how many, or at which values
    #[cfg_attr(
        feature = "clap",
        arg(long, value_name = "[x=|y=]auto|N|A,B,…", allow_hyphen_values = true)
    )]
    pub ticks: Vec<AxisTicks>,
}

/// The colours around the image of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum ThemeName {
    /// Dark on white
    Light,
    /// Light on black
    Dark,
}

/// The place of a figure's colour bar.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "the names say all, and clap would show more")]
pub enum BarName {
    /// Below long bodies, else right
    Auto,
    Right,
    Bottom,
    None,
}

/// Marks of an axis or of the colour bar, written `x=5`, `y=auto` or `bar=0,1`; those of the bar
/// may be written without its name.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisTicks {
    axis: LabelledAxis,
    choice: TickChoice,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum LabelledAxis {
    X,
    Y,
    Bar,
}

/// Size of images if nothing is said.
pub const DEFAULT_SIZE: [u32; 2] = [1024, 768];
/// Size of a panel if no size is given, also of long bodies.
const PANEL: [u32; 2] = [660, 600];
const LONG_PANEL: [u32; 2] = [900, 330];
/// Panels side by side that pages grow with.
const MOST_PANELS: u32 = 12;
/// Length over height of what counts as long.
pub const LONG: f64 = 2.2;
/// Width over height of what has any shape.
pub(crate) const SHAPE: f64 = 4.0 / 3.0;
/// Centimetres in an inch.
const INCH: f64 = 2.54;
const PRINT_DPI: f64 = 300.0;
const SCREEN_DPI: f64 = 96.0;

/// Least and largest number of pixels per inch: files of PNG hold no more of them, and sizes in
/// pixels are whole numbers.
const RESOLUTIONS: RangeInclusive<f64> = 1.0..=1e5;

#[cfg(feature = "clap")]
fn dpi(text: &str) -> Result<f64, String> {
    let found = positive(text).ok().filter(|dpi| RESOLUTIONS.contains(dpi));
    found.ok_or_else(|| "write a number of pixels from 1 to 100000".into())
}

fn checked_dpi<'d, D: Deserializer<'d>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    let dpi = Option::<f64>::deserialize(deserializer)?;
    let is_known = dpi.is_none_or(|dpi| RESOLUTIONS.contains(&dpi));
    is_known
        .then_some(dpi)
        .ok_or_else(|| de::Error::custom("dpi: give 1 to 100000 pixels per inch"))
}

impl PageStyle {
    /// The names of options that are for figures alone, and true for those that are given.
    #[must_use]
    pub fn of_figures(&self) -> [(&'static str, bool); 5] {
        [
            ("font-size", self.font_size.is_some()),
            ("theme", self.theme.is_some()),
            ("transparent", self.transparent),
            ("bar", self.bar.is_some()),
            ("ticks", !self.ticks.is_empty()),
        ]
    }

    /// The size that was asked for \[pixels\].
    #[must_use]
    pub fn given_size(&self) -> Option<[u32; 2]> {
        let on_paper = || {
            let PaperSize { width, height } = self.paper()?;
            Some(FigureStyle::inches([width, height?], self.dpi()).size)
        };
        self.size.or_else(on_paper)
    }

    /// The size on paper \[inches\].
    fn paper(&self) -> Option<PaperSize> {
        self.inches.or_else(|| self.cm.map(|size| size.over(INCH)))
    }

    /// Size of a page of so many panels across and down if no size is given, of things of a shape.
    #[must_use]
    pub fn page(aspect: Option<f64>, [across, down]: [u32; 2]) -> [u32; 2] {
        let panel = if aspect.is_some_and(|aspect| aspect > LONG) { LONG_PANEL } else { PANEL };
        // a page of more panels than anyone can see stays small enough to be refused for want of
        // room
        [across.min(MOST_PANELS) * panel[0], down.min(MOST_PANELS) * panel[1]]
    }

    /// Pixels per inch.
    fn dpi(&self) -> f64 {
        self.dpi.unwrap_or(if self.paper().is_some() { PRINT_DPI } else { SCREEN_DPI })
    }

    /// Pixels per inch if someone cares.
    #[must_use]
    pub fn given_dpi(&self) -> Option<f64> {
        (self.dpi.is_some() || self.paper().is_some()).then(|| self.dpi())
    }

    /// The look of a figure of something of a shape, width over height, none if it has any shape;
    /// of `size` pixels unless another size is given, with letters as for one of so many parts of
    /// it across and down.
    #[must_use]
    pub fn design(&self, aspect: Option<f64>, size: [u32; 2], parts: [u32; 2]) -> FigureStyle {
        let mut design = match (self.paper(), self.size.unwrap_or(size)) {
            (Some(PaperSize { width, height }), _) => {
                let panel = width / f64::from(parts[0]) / aspect.unwrap_or(SHAPE);
                FigureStyle::inches(
                    [width, height.unwrap_or(panel * f64::from(parts[1]))],
                    self.dpi(),
                )
            }
            (None, size) => {
                let part = [size[0] / parts[0], size[1] / parts[1]];
                FigureStyle { size, ..FigureStyle::pixels(part).at(self.dpi()) }
            }
        };
        design.font_size = self.font_size.unwrap_or(design.font_size);
        design.transparent = self.transparent;
        if self.theme == Some(ThemeName::Dark) {
            design.theme = Theme::Dark;
        }
        design.bar = match self.bar.unwrap_or(BarName::Auto) {
            BarName::Auto => aspect.map_or(BarPlace::Right, BarPlace::fitting),
            BarName::Right => BarPlace::Right,
            BarName::Bottom => BarPlace::Bottom,
            BarName::None => BarPlace::None,
        };
        for AxisTicks { axis, choice } in &self.ticks {
            let ticks = match axis {
                LabelledAxis::X => &mut design.x_ticks,
                LabelledAxis::Y => &mut design.y_ticks,
                LabelledAxis::Bar => &mut design.bar_ticks,
            };
            ticks.clone_from(choice);
        }
        design
    }

    /// True if the height of the page is that of what is drawn.
    pub(crate) fn has_free_height(&self) -> bool {
        self.paper().is_some_and(|paper| paper.height.is_none())
    }

    /// The design with the height of so many images of a shape across and down, if the page is to
    /// have that.
    ///
    /// # Errors
    /// Those of `room`, see [`hugging`].
    pub fn fitted<E>(
        &self,
        design: FigureStyle,
        aspect: Option<f64>,
        parts: [u32; 2],
        room: impl Fn(&FigureStyle) -> Result<[u32; 2], E>,
    ) -> Result<FigureStyle, E> {
        if !self.has_free_height() {
            return Ok(design);
        }
        let is_free = matches!(self.bar, None | Some(BarName::Auto));
        let places = if is_free && design.bar != BarPlace::None {
            &BarPlace::ANYWHERE[..]
        } else {
            &[design.bar]
        };
        hugging(&design, aspect.unwrap_or(SHAPE), parts, places, room)
    }

    /// The look of a design that was made of a size and a place of the bar alone.
    #[must_use]
    pub fn of(design: &FigureStyle) -> Self {
        let on_paper = design.font_size != FigureStyle::pixels(design.size).font_size;
        Self {
            size: Some(design.size),
            dpi: on_paper.then_some(design.dpi),
            font_size: on_paper.then_some(design.font_size),
            bar: (design.bar == BarPlace::Bottom).then_some(BarName::Bottom),
            ..Self::default()
        }
    }
}

impl FromStr for AxisTicks {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (axis, choice) = match text.split_once('=') {
            None => (LabelledAxis::Bar, text),
            Some(("x", choice)) => (LabelledAxis::X, choice),
            Some(("y", choice)) => (LabelledAxis::Y, choice),
            Some(("bar", choice)) => (LabelledAxis::Bar, choice),
            Some((other, _)) => {
                return Err(format!("there is no axis `{other}`; write x, y or bar"));
            }
        };
        Ok(Self { axis, choice: choice_of(choice.trim())? })
    }
}

fn choice_of(choice: &str) -> Result<TickChoice, String> {
    if choice == "auto" {
        return Ok(TickChoice::Auto);
    }
    if let Ok(count) = choice.parse::<usize>() {
        return match count {
            1..=100 => Ok(TickChoice::Count(count)),
            _ => Err("write 1 to 100 marks, or their values with a comma".into()),
        };
    }
    let values = numbers(choice);
    let values = values.ok_or("write auto, a number of marks, or values with commas between")?;
    Ok(TickChoice::At(values))
}

impl fmt::Display for AxisTicks {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self.axis {
            LabelledAxis::X => "x=",
            LabelledAxis::Y => "y=",
            LabelledAxis::Bar => "bar=",
        })?;
        match &self.choice {
            TickChoice::Auto => f.write_str("auto"),
            TickChoice::Count(count) => write!(f, "{count}"),
            TickChoice::At(values) => f.write_str(&listed(values)),
        }
    }
}

crate::request::written::as_text!(AxisTicks);

/// A width on paper, and a height; without one it is that of what is drawn. Written `3.4x2.6`
/// or `3.4`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperSize {
    /// The width, positive.
    pub width: f64,
    /// The height, positive.
    pub height: Option<f64>,
}

/// Longest side of a page, in its unit: more than any paper has.
const LONGEST: f64 = 1000.0;

impl PaperSize {
    /// Returns the length in a unit that is so many times as long.
    #[must_use]
    pub fn over(self, factor: f64) -> Self {
        Self { width: self.width / factor, height: self.height.map(|height| height / factor) }
    }
}

impl FromStr for PaperSize {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let length =
            |text: &str| text.trim().parse().ok().filter(|l: &f64| *l > 0.0 && *l <= LONGEST);
        let (width, height) = text.split_once('x').map_or((text, None), |(w, h)| (w, Some(h)));
        let size = match height {
            None => length(width).map(|width| Self { width, height: None }),
            Some(height) => length(width)
                .zip(length(height))
                .map(|(width, height)| Self { width, height: Some(height) }),
        };
        size.ok_or_else(|| {
            format!(
                "write a width above zero, up to {LONGEST}, or WIDTHxHEIGHT, e.g. 3.4 or 3.4x2.6"
            )
        })
    }
}

impl fmt::Display for PaperSize {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.width)?;
        self.height.map_or(Ok(()), |height| write!(f, "x{height:?}"))
    }
}

crate::request::written::as_text!(PaperSize);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_of_axes_and_bar() {
        let ticks = |axis, choice| Ok(AxisTicks { axis, choice });
        for (text, wanted) in [
            ("auto", ticks(LabelledAxis::Bar, TickChoice::Auto)),
            ("x=5", ticks(LabelledAxis::X, TickChoice::Count(5))),
            ("y=-1,0.5", ticks(LabelledAxis::Y, TickChoice::At(vec![-1.0, 0.5]))),
            ("3,", ticks(LabelledAxis::Bar, TickChoice::At(vec![3.0]))),
            ("x=", ticks(LabelledAxis::X, TickChoice::At(vec![]))),
        ] {
            assert_eq!(text.parse(), wanted);
            let written = wanted.as_ref().map(ToString::to_string).unwrap_or_default();
            assert_eq!(written.parse(), wanted, "{written}");
        }
        for wrong in ["z=3", "0", "101", "1,a", "inf,0", "some"] {
            assert!(wrong.parse::<AxisTicks>().is_err(), "{wrong}");
        }
    }

    /// Sizes of a page are what they are said to be: products of lengths and resolutions are no
    /// larger than whole numbers of 32 bits.
    #[test]
    fn resolutions_and_lengths_have_ends() {
        let read = |text: &str| serde_json::from_str::<PageStyle>(text);
        let page =
            read(r#"{ "inches": "1000x1000", "dpi": 1e5 }"#).ok().and_then(|l| l.given_size());
        assert_eq!(page, Some([100_000_000; 2]));
        for (wrong, reason) in [
            (r#"{ "dpi": 1e9 }"#, "dpi: give 1 to 100000"),
            (r#"{ "dpi": 0 }"#, "dpi: give 1 to 100000"),
            (r#"{ "cm": "1001" }"#, "up to 1000"),
        ] {
            let error = read(wrong).unwrap_err().to_string();
            assert!(error.contains(reason), "{error}");
        }
    }

    #[test]
    fn sizes_are_read_as_they_are_written() {
        for (text, width, height) in [("3.4", 3.4, None), ("3.4x2.6", 3.4, Some(2.6))] {
            let size = PaperSize { width, height };
            assert_eq!((text.parse(), size.to_string()), (Ok(size), text.to_owned()));
        }
        assert_eq!("5.08x2.54".parse::<PaperSize>().map(|size| size.over(2.54)), "2x1".parse());
        for wrong in ["", "0", "3x0", "-1x2", "3x", "x3", "inf", "3,4"] {
            assert!(wrong.parse::<PaperSize>().is_err(), "{wrong}");
        }
    }
}
