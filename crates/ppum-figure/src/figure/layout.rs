//! Several panels on one page.
//!
//! ```text
//!   title
//!   (a) caption      (b) caption
//!   ┌───────┐        ┌───────┐
//!   │       │ ▐      │       │ ▐        a bar each, or one for all
//!   └───────┘        └───────┘
//!   (c) caption      (d) caption
//!   …                …
//! ```
//!
//! Panels fill the grid row by row. Several may share a bar beside one of them. Plots of a column
//! begin at one line, and so do those of a row.

use ppum::vec2::{Vec2, vec2};

use super::color_bar::ColorBar;
use super::color_key::ColorKey;
use super::ink::{Ink, LINE, TITLE_TEXT, bounds};
use super::metrics::{MARGIN, RIGHT, RIGHT_BAR, TITLE_GAP};
use super::panel_layout::{self, Extents, PanelLayout};
use super::style::{BarPlace, FigureStyle, LABEL_TEXT};
use super::{FigureError, Panel};
use crate::canvas::{Canvas, CanvasItem};
use crate::text;

/// The arrangement of panels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PanelGrid {
    /// Number of columns.
    pub columns: u32,
    /// Number of rows.
    pub rows: u32,
    /// True if one colour bar explains all panels, which then have one range.
    pub shared_bar: bool,
    /// Columns and rows in which a panel has a bar of its own, if there are others: these get
    /// more room.
    pub barred: Option<[u32; 2]>,
}

impl PanelGrid {
    /// One panel.
    pub const ONE: Self = Self::new([1, 1]);

    /// Columns and rows of panels with a bar each.
    #[must_use]
    pub const fn new([columns, rows]: [u32; 2]) -> Self {
        Self { columns, rows, shared_bar: false, barred: None }
    }

    /// Number of panels that fit.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.columns as usize * self.rows as usize
    }
}

// Room kept around an image, in pixels of a figure of 1024 × 768.
/// Left of it, for y and its labels.
const LEFT: f64 = 96.0;
/// Additional space below it with a bar there.
const BELOW_BAR: f64 = 88.0;
/// Above it and below it, the first line of a title included.
const ABOVE: f64 = 52.0;
const BELOW: f64 = 68.0;
/// Between a title and what stands below it.
const TITLE_OVER: f64 = 12.0;
/// Least side of an image.
const LEAST: u32 = 48;
/// Lines of a title, and of a caption, at most.
const TITLE_LINES: usize = 4;
const CAPTION_LINES: usize = 2;

/// The largest image that a figure of one panel has room for, whatever its range.
///
/// # Errors
/// If that is less than 48 pixels wide or high.
pub fn plot_area(title: &str, style: &FigureStyle) -> Result<[u32; 2], FigureError> {
    panel_area(title, &[""], PanelGrid::ONE, style)
}

/// The largest image that each panel of a figure has room for, by the figure's title and the
/// panels' captions.
///
/// # Errors
/// If that is less than 48 pixels wide or high.
pub fn panel_area(
    title: &str,
    captions: &[&str],
    grid: PanelGrid,
    style: &FigureStyle,
) -> Result<[u32; 2], FigureError> {
    let [across, down] = [grid.columns.max(1), grid.rows.max(1)];
    let taken = kept(title, captions, grid, style).map(|room| room.ceil() as u32);
    let least = [(taken[0], across), (taken[1], down)]
        .map(|(taken, count)| taken.saturating_add(count.saturating_mul(LEAST)));
    if style.size[0] < least[0] || style.size[1] < least[1] {
        let (size, dpi) = (style.size, style.dpi);
        let least = [0, 1].map(|side| least[side].max(size[side]));
        return Err(FigureError::TooSmall { size, least, dpi });
    }
    Ok([(style.size[0] - taken[0]) / across, (style.size[1] - taken[1]) / down])
}

/// A style whose height is that of panels across and down with images of a shape, width over
/// height, as wide as the page has room for, with all around them. Its bars are at the first of
/// some places that leaves the images 60 % of the width, else at the last. `room` is the largest
/// image of a panel of a style, as [`plot_area`] and [`panel_area`].
///
/// # Errors
/// Those of `room`.
pub fn hugging<E>(
    style: &FigureStyle,
    aspect: f64,
    [across, down]: [u32; 2],
    places: &[BarPlace],
    room: impl Fn(&FigureStyle) -> Result<[u32; 2], E>,
) -> Result<FigureStyle, E> {
    let width = style.size[0];
    let tallest = width.saturating_mul(TALLEST).saturating_mul(down);
    let tall = |bar| FigureStyle { bar, size: [width, tallest], ..style.clone() };
    let is_wide = |place: &&BarPlace| {
        let columns = room(&tall(**place)).map_or(0, |[columns, _]| columns);
        f64::from(columns) * f64::from(across) >= LEAST_PART * f64::from(width)
    };
    let place = places.iter().find(is_wide).or(places.last()).copied();
    let mut found = tall(place.unwrap_or(style.bar));
    let [columns, rows] = room(&found)?;
    let height = (f64::from(columns) / aspect.max(NARROWEST)).round().max(f64::from(LEAST)) as u32;
    found.size[1] = tallest - rows.saturating_sub(height) * down;
    Ok(found)
}

/// Height of a row of the page in widths while it is looked for: more than it will have.
const TALLEST: u32 = 8;
/// Width over height of images that are not drawn any higher.
const NARROWEST: f64 = 0.25;
/// Least part of a page's width that an image takes.
const LEAST_PART: f64 = 0.6;

/// Pixels across and down that no image has.
fn kept(title: &str, captions: &[&str], grid: PanelGrid, style: &FigureStyle) -> [f64; 2] {
    let scale = style.scale();
    let [across, down] = [grid.columns.max(1), grid.rows.max(1)].map(f64::from);
    let (bars_across, bars_down) = match grid.barred {
        _ if grid.shared_bar => (1.0, 1.0),
        Some([columns, rows]) => (f64::from(columns).min(across), f64::from(rows).min(down)),
        None => (across, down),
    };
    let is = |place: BarPlace| f64::from(u8::from(style.bar == place));
    let wide =
        LEFT * across + RIGHT * across + (RIGHT_BAR - RIGHT) * bars_across * is(BarPlace::Right);
    // without a title, too, the room for its first line: ticks reach into it
    let more_lines = title_lines(title, style).len().saturating_sub(1) as f64;
    let captioned = captions.iter().map(|text| caption_lines(text, grid, style).len()).max();
    let caption = match captioned.unwrap_or(0) {
        0 => 0.0,
        lines => (lines as f64 * LINE * LABEL_TEXT) + TITLE_GAP,
    };
    let high = ABOVE
        + more_lines * LINE * TITLE_TEXT
        + BELOW * down
        + caption * down
        + BELOW_BAR * bars_down * is(BarPlace::Bottom);
    [wide, high].map(|room| room * scale)
}

fn title_lines(title: &str, style: &FigureStyle) -> Vec<String> {
    let scale = style.scale();
    let room = f64::from(style.size[0]) - 2.0 * MARGIN * scale;
    panel_layout::lines(title, TITLE_TEXT * scale, room, TITLE_LINES)
}

/// A caption as long as its cell right of where plots begin.
fn caption_lines(caption: &str, grid: PanelGrid, style: &FigureStyle) -> Vec<String> {
    let scale = style.scale();
    let cell = f64::from(style.size[0]) / f64::from(grid.columns.max(1));
    let room = cell - (LEFT + MARGIN) * scale;
    panel_layout::lines(caption, LABEL_TEXT * scale, room, CAPTION_LINES)
}

/// A figure of panels, in rows, whose titles are their captions, with a title of its own. Images
/// have at most the size that [`panel_area`] gives. A bar that several share has the words of the
/// first.
///
/// # Errors
/// A page without room, an image that is too large, more panels than cells, no panels; one bar for
/// images of several ranges or colour maps.
pub fn panels(
    title: &str,
    panels: &[Panel<'_>],
    grid: PanelGrid,
    style: &FigureStyle,
) -> Result<Canvas, FigureError> {
    if panels.is_empty() || panels.len() > grid.cells() {
        return Err(FigureError::Panels { panels: panels.len(), cells: grid.cells() });
    }
    let captions: Vec<&str> = panels.iter().map(|panel| panel.labels.title.as_str()).collect();
    let room = panel_area(title, &captions, grid, style)?;
    if let Some(panel) = panels.iter().find(|p| (0..2).any(|k| p.picture.image.size[k] > room[k])) {
        return Err(FigureError::TooLarge { plot: panel.picture.image.size, room });
    }
    let layouts = panels.iter().zip(own_keys(panels)?).map(|(panel, key)| {
        let caption = caption_lines(&panel.labels.title, grid, style);
        PanelLayout::new(panel, caption, style, room, key.filter(|_| !grid.shared_bar))
    });
    let lines = title_lines(title, style);
    let [across, down] = [(room[0], grid.columns), (room[1], grid.rows)]
        .map(|(side, count)| f64::from(side) * f64::from(count));
    Ok(FigurePage::new(layouts.collect(), panels, lines, (grid, [across, down]), style)?.draw())
}

/// Panels on a page.
struct FigurePage<'a> {
    style: &'a FigureStyle,
    layouts: Vec<PanelLayout<'a>>,
    columns: Vec<Track>,
    rows: Vec<Track>,
    /// The bar for all.
    bar: Option<ColorBar>,
    /// The title, line by line.
    lines: Vec<String>,
}

/// A column's or a row's room before its plots, theirs, and after them.
type Track = [f64; 3];

/// The length of all tracks.
fn length(tracks: &[Track]) -> f64 {
    tracks.iter().flatten().sum()
}

/// From the first plot to the end of the last one.
fn plots(tracks: &[Track]) -> [f64; 2] {
    let [before, after] =
        [tracks.first().map_or(0.0, |t| t[0]), tracks.last().map_or(0.0, |t| t[2])];
    [before, length(tracks) - after]
}

impl<'a> FigurePage<'a> {
    /// A page whose panels have room for images of so many pixels together.
    fn new(
        layouts: Vec<PanelLayout<'a>>,
        panels: &[Panel<'_>],
        lines: Vec<String>,
        (grid, room): (PanelGrid, [f64; 2]),
        style: &'a FigureStyle,
    ) -> Result<Self, FigureError> {
        let [columns, rows] = tracks(&layouts, grid, style);
        let sides = [&columns, &rows].map(|tracks| plots(tracks)[1] - plots(tracks)[0]);
        let bar = match grid.shared_bar {
            true => panel_layout::bar(shared_key(panels.iter())?, style.bar, style, sides, room),
            false => None,
        };
        Ok(Self { style, layouts, columns, rows, bar, lines })
    }

    /// The page with everything in its middle.
    fn draw(&self) -> Canvas {
        let size = Vec2::from(self.style.size.map(f64::from));
        // measured at a place far from the borders
        let far = vec2(f64::from(1 << 24), f64::from(1 << 24));
        let [lo, hi] = bounds(&self.around(far));
        let start = (size - (hi - lo)) * 0.5 + (far - lo);
        let start = vec2(start.x.round(), start.y.round());
        let mut page = Canvas::new(self.style.size, self.style.paper());
        let origins = self.origins(start);
        page.items.extend(self.layouts.iter().zip(origins).map(|(layout, at)| layout.plot(at)));
        page.items.extend(self.around(start));
        page
    }

    /// The upper left corner of each plot if the grid begins at a place.
    fn origins(&self, start: Vec2) -> Vec<[u32; 2]> {
        let before = |tracks: &[Track], k: usize| length(&tracks[..k]) + tracks[k][0];
        let at = |k: usize| {
            let (column, row) = (k % self.columns.len(), k / self.columns.len());
            let corner = start + vec2(before(&self.columns, column), before(&self.rows, row));
            [corner.x as u32, corner.y as u32]
        };
        (0..self.layouts.len()).map(at).collect()
    }

    /// Everything but the plots.
    fn around(&self, start: Vec2) -> Vec<CanvasItem> {
        let mut ink = Ink::new(self.style);
        let origins = self.origins(start);
        for (layout, at) in self.layouts.iter().zip(&origins) {
            ink.items.extend(layout.around(*at));
        }
        let ([left, right], [top, bottom]) = (plots(&self.columns), plots(&self.rows));
        if let Some(bar) = &self.bar {
            let end = start + vec2(length(&self.columns), length(&self.rows));
            // an upright bar is beside all panels
            let max = vec2(if bar.is_upright { end.x } else { start.x + right }, start.y + bottom);
            let room = [right - left, bottom - top];
            panel_layout::draw_bar(bar, &mut ink, [start + vec2(left, top), max], end, room);
        }
        self.title(&mut ink, start.x + left);
        ink.items
    }

    /// The title above everything, from the left of the first plot if it ends where the rest does,
    /// else in the middle.
    fn title(&self, ink: &mut Ink, left: f64) {
        let widths = self.lines.iter().map(|line| text::width(line, TITLE_TEXT * ink.scale));
        let longest = widths.fold(0.0, f64::max);
        let [lo, hi] = bounds(&ink.items);
        let fits = left + longest <= hi.x;
        let left = if fits { left } else { (0.5 * (lo.x + hi.x - longest)).round() };
        ink.lines(&self.lines, TITLE_TEXT, vec2(left, lo.y - TITLE_OVER * ink.scale));
    }
}

/// The rooms of columns and of rows, whole pixels.
fn tracks(layouts: &[PanelLayout<'_>], grid: PanelGrid, style: &FigureStyle) -> [Vec<Track>; 2] {
    let mut columns = vec![[0.0; 3]; grid.columns as usize];
    let mut rows = vec![[0.0; 3]; grid.rows as usize];
    for (k, layout) in layouts.iter().enumerate() {
        let (Extents { before, after }, plot) = (layout.extents(), layout.sides());
        let (column, row) = (k % columns.len(), k / columns.len());
        for (track, parts) in [
            (&mut columns[column], [before.x, plot.x, after.x]),
            (&mut rows[row], [before.y, plot.y, after.y]),
        ] {
            for (room, part) in track.iter_mut().zip(parts) {
                *room = f64::max(*room, part.ceil());
            }
        }
    }
    let gap = (MARGIN * style.scale()).ceil();
    for tracks in [&mut columns, &mut rows] {
        tracks.iter_mut().skip(1).for_each(|track| track[0] += gap);
    }
    [columns, rows]
}

/// Returns the content of one shared bar.
fn shared_key<'a>(panels: impl Iterator<Item = &'a Panel<'a>>) -> Result<ColorKey, FigureError> {
    let mut keys = panels.map(|panel| ColorKey::new(panel.picture, &panel.labels));
    let first = keys.next().ok_or(FigureError::Ranges)?;
    keys.try_fold(first, |key, other| key.shared(&other)).ok_or(FigureError::Ranges)
}

/// Returns the content of the bar of each panel; none of those that another one's bar explains.
fn own_keys(panels: &[Panel<'_>]) -> Result<Vec<Option<ColorKey>>, FigureError> {
    let has_own = |k: usize| panels.get(k).is_some_and(|panel| panel.bar_of.is_none());
    let owner = |k: usize| panels[k].bar_of.filter(|&other| has_own(other)).unwrap_or(k);
    let key = |k: usize| {
        let explained = (0..panels.len()).filter(|&other| owner(other) == k);
        (owner(k) == k).then(|| shared_key(explained.map(|other| &panels[other]))).transpose()
    };
    (0..panels.len()).map(key).collect()
}
