//! The look of figures, and their words.

use crate::overlay::line_scale;
use ppum_render::image::{Image, Rgba};

/// The look of a figure: everything but what it shows.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureStyle {
    /// Columns and rows of the page.
    pub size: [u32; 2],
    /// Pixels per inch: the size on paper.
    pub dpi: f64,
    /// Size of the labels of axes \[points, 1/72 inch\]; titles, tick labels and lines follow it.
    pub font_size: f64,
    /// The colours around the image.
    pub theme: Theme,
    /// True if the page has no colour of its own.
    pub transparent: bool,
    /// The place of the colour bar.
    pub bar: BarPlace,
    /// Marks of the axis x.
    pub x_ticks: TickChoice,
    /// Marks of the axis y.
    pub y_ticks: TickChoice,
    /// Marks of the colour bar.
    pub bar_ticks: TickChoice,
}

/// The colours of page, lines and letters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theme {
    /// Dark on white.
    #[default]
    Light,
    /// Light on almost black.
    Dark,
}

/// The place of the colour bar.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BarPlace {
    /// Right of the image, upright.
    #[default]
    Right,
    /// Below the image, lying.
    Bottom,
    /// There is none.
    None,
}

/// Labelled marks of an axis or of the colour bar.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum TickChoice {
    /// As many as fit, at round numbers.
    #[default]
    Auto,
    /// About that many, at round numbers.
    Count(usize),
    /// At these values; those outside are left out.
    At(Vec<f64>),
}

/// The words of a figure; empty ones are left out. `_{…}` sets a subscript: `σ_{yy}`. Characters
/// are those of Latin, Greek and mathematics; others appear as
/// boxes ([`missing`](crate::text::missing)).
#[derive(Clone, Debug, PartialEq)]
pub struct Labels {
    /// Lines above the image; of a panel its caption.
    pub title: String,
    /// The quantity that the colours show, e.g. `von Mises stress`.
    pub quantity: String,
    /// Unit of the values.
    pub unit: String,
    /// Name of the axis x.
    pub x: String,
    /// Name of the axis y.
    pub y: String,
    /// Unit of lengths.
    pub length_unit: String,
}

impl Default for Labels {
    /// x and y, and no other words.
    fn default() -> Self {
        let [title, quantity, unit, length_unit] = [const { String::new() }; 4];
        Self { title, quantity, unit, x: "x".to_owned(), y: "y".to_owned(), length_unit }
    }
}

/// Size of an axis' label in pixels of a figure of 1024 × 768, in which all lengths are given.
pub(super) const LABEL_TEXT: f64 = 14.0;
/// Pixels per inch of screens, where nothing else is known: that of CSS.
const SCREEN_DPI: f64 = 96.0;
/// Size of labels in print \[points\]: that of captions in journals.
const PRINT_SIZE: f64 = 9.0;
/// Images at least this much longer than high have their bar below.
const LONG: f64 = 2.2;

impl FigureStyle {
    /// A figure for screens, of so many columns and rows; letters and lines grow with it.
    #[must_use]
    pub fn pixels(size: [u32; 2]) -> Self {
        let font_size = LABEL_TEXT * line_scale(size) * 72.0 / SCREEN_DPI;
        Self { font_size, ..Self::new(size, SCREEN_DPI) }
    }

    /// A figure for paper: width and height in inches, pixels per inch. Labels have 9 points.
    #[must_use]
    pub fn inches(size: [f64; 2], dpi: f64) -> Self {
        Self::new(size.map(|length| (length * dpi).round() as u32), dpi)
    }

    /// Returns the sizes in pixels, with so many of them per inch.
    #[must_use]
    pub fn at(self, dpi: f64) -> Self {
        Self { font_size: self.font_size * self.dpi / dpi, dpi, ..self }
    }

    fn new(size: [u32; 2], dpi: f64) -> Self {
        Self {
            size,
            dpi,
            font_size: PRINT_SIZE,
            theme: Theme::Light,
            transparent: false,
            bar: BarPlace::Right,
            x_ticks: TickChoice::Auto,
            y_ticks: TickChoice::Auto,
            bar_ticks: TickChoice::Auto,
        }
    }

    /// Scale of all lines and letters, those over the image too: 1 where an axis' label is 14
    /// pixels high. A length on paper, the same at any number of pixels per inch.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.font_size * self.dpi / 72.0 / LABEL_TEXT
    }

    /// The page's colour.
    pub(super) fn paper(&self) -> Rgba {
        let [paper, ..] = self.theme.colors();
        if self.transparent { [0; 4] } else { paper }
    }

    /// The colour of lines and letters.
    pub(super) fn ink(&self) -> Rgba {
        self.theme.colors()[1]
    }

    /// A ground with diagonal lines: what shows outside the body.
    pub(super) fn hatched(&self, size: [u32; 2]) -> Image {
        let [_, _, line] = self.theme.colors();
        let width = (self.scale().round() as u32).max(1);
        let mut image = Image::filled(size, self.paper());
        for (k, pixel) in (0u32..).zip(image.rgba.as_chunks_mut().0) {
            let (column, row) = (k % size[0], k / size[0]);
            if (column + row) % (HATCH_STEP * width) < width {
                *pixel = line;
            }
        }
        image
    }
}

impl Theme {
    /// The colours of paper, ink and hatching.
    fn colors(self) -> [Rgba; 3] {
        match self {
            Self::Light => [[255, 255, 255, 255], [38, 38, 42, 255], [214, 214, 218, 255]],
            Self::Dark => [[22, 22, 26, 255], [226, 226, 230, 255], [62, 62, 70, 255]],
        }
    }
}

/// Distance of the hatching's lines in units of their width.
pub(super) const HATCH_STEP: u32 = 8;

impl BarPlace {
    /// The places of a bar that may stand anywhere, the usual one first.
    pub const ANYWHERE: [Self; 2] = [Self::Right, Self::Bottom];

    /// The place for images of a shape, width over height: below those that are long.
    #[must_use]
    pub fn fitting(aspect: f64) -> Self {
        if aspect > LONG { Self::Bottom } else { Self::Right }
    }
}
