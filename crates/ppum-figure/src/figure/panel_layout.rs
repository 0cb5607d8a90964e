//! A panel: a plot with its axes, its colour bar and its caption.

use ppum::vec2::{Vec2, vec2};

use super::Panel;
use super::axis::{FigureAxis, axes, label_places};
use super::color_bar::{ColorBar, LEAST_BAR};
use super::color_key::ColorKey;
use super::ink::{Ink, TICK_TEXT, bounds, snapped};
use super::legend::{Free, Legend};
use super::metrics::{
    BAR_GAP, BETWEEN, BETWEEN_ROWS, GAP, LABEL_GAP, MARGIN, RIGHT, RIGHT_BAR, TICK, TITLE_GAP, WORD,
};
use super::style::{BarPlace, FigureStyle, LABEL_TEXT};
use crate::canvas::{Align, CanvasItem};
use crate::text::{self, CAP_HEIGHT};

/// Between what stands below a plot and a bar below that.
const BAR_BELOW_GAP: f64 = 16.0;

/// Everything around a plot.
pub(super) struct PanelLayout<'a> {
    panel: &'a Panel<'a>,
    style: &'a FigureStyle,
    x: FigureAxis,
    y: FigureAxis,
    bar: Option<ColorBar>,
    /// The legend, if it stands outside of the plot.
    legend: Option<Legend<'a>>,
    /// The caption, line by line.
    caption: Vec<String>,
    /// The space for labels of axes and bars.
    room: [f64; 2],
}

/// The room that a panel takes left, above, right and below its plot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Extents {
    pub(super) before: Vec2,
    pub(super) after: Vec2,
}

impl<'a> PanelLayout<'a> {
    /// A panel whose plot may have as many pixels as `room`, with the bar of a key if it has one.
    pub(super) fn new(
        panel: &'a Panel<'a>,
        caption: Vec<String>,
        style: &'a FigureStyle,
        room: [u32; 2],
        key: Option<ColorKey>,
    ) -> Self {
        let picture = panel.picture;
        let [x, y] = axes(picture, &panel.labels, panel.cracks, style);
        let (sides, room) = (picture.image.size.map(f64::from), room.map(f64::from));
        let bar = key.and_then(|key| bar(key, style.bar, style, sides, room));
        let free = free(bar.as_ref(), sides, room, style);
        let legend = Legend::new(&panel.legend, free, style.scale());
        Self { panel, style, x, y, bar, legend, caption, room }
    }

    /// The plot on its hatched ground with the layers over it, its upper left pixel at a place.
    pub(super) fn plot(&self, origin: [u32; 2]) -> CanvasItem {
        let mut canvas = super::bare(self.panel.picture, self.panel.layers.clone());
        let (corner, ground) = ([0, 0], self.style.hatched(canvas.size));
        canvas.items.insert(0, CanvasItem::Picture { image: ground, corner });
        CanvasItem::Inset { corner: origin, canvas }
    }

    /// All that stands around the plot.
    pub(super) fn around(&self, origin: [u32; 2]) -> Vec<CanvasItem> {
        let mut ink = Ink::new(self.style);
        let min = vec2(f64::from(origin[0]), f64::from(origin[1]));
        let max = min + self.sides();
        ink.outline(min, max);
        self.draw_x_axis(&mut ink, min, max);
        self.draw_y_axis(&mut ink, min, max);
        let beside = self.legend.map_or(max, |legend| legend.draw_beside(&mut ink, [min, max]));
        if let Some(bar) = &self.bar {
            let end = bounds(&ink.items)[1];
            let max = if bar.is_upright { beside } else { max };
            draw_bar(bar, &mut ink, [min, max], end, [self.label_room(), self.room[1]]);
        }
        if let Some(legend) = &self.legend {
            let top = bounds(&ink.items)[0].y;
            legend.draw_above(&mut ink, min.x, top);
        }
        let [lo, hi] = bounds(&ink.items);
        let widths = self.caption.iter().map(|line| text::width(line, LABEL_TEXT * ink.scale));
        // above the plot; a long one ends where the rest does, or begins there
        let left = min.x.min((hi.x - widths.fold(0.0, f64::max)).max(lo.x));
        let top = lo.y.min(min.y);
        let gap = if self.caption.is_empty() { 0.0 } else { 0.6 * TITLE_GAP * ink.scale };
        ink.lines(&self.caption, LABEL_TEXT, vec2(left, (top - gap).round()));
        ink.items
    }

    /// The room around the plot, measured where it has enough.
    pub(super) fn extents(&self) -> Extents {
        const FAR: u32 = 1 << 24;
        let origin = vec2(f64::from(FAR), f64::from(FAR));
        let [lo, hi] = bounds(&self.around([FAR; 2]));
        Extents { before: origin - lo, after: hi - origin - self.sides() }
    }

    /// Columns and rows of the plot.
    pub(super) fn sides(&self) -> Vec2 {
        Vec2::from(self.panel.picture.image.size.map(f64::from))
    }

    /// The longest label across: it may reach as far beyond the image as the page is free right
    /// of it.
    fn label_room(&self) -> f64 {
        let beyond = if self.style.bar == BarPlace::Right { 0.0 } else { RIGHT - MARGIN };
        self.room[0] + 2.0 * beyond * self.style.scale()
    }

    fn draw_x_axis(&self, ink: &mut Ink, min: Vec2, max: Vec2) {
        let (scale, stroke) = (ink.scale, ink.stroke);
        let top = max.y + stroke;
        let base = top + (TICK + GAP + TICK_TEXT * CAP_HEIGHT) * scale;
        let middle = 0.5 * (min.x + max.x);
        let ticks = &self.x.ticks.major;
        let at = |offset: f64| min.x + self.panel.picture.view.pixel_of_offset(vec2(offset, 0.0)).x;
        let marks: Vec<f64> = ticks.iter().map(|tick| at(tick.at)).collect();
        let widths = ticks.iter().map(|tick| text::width(&tick.label, TICK_TEXT * scale));
        let places = label_places(&marks, &widths.collect::<Vec<_>>(), BETWEEN * scale);
        for ((tick, at), place) in ticks.iter().zip(marks).zip(places) {
            let left = snapped(at, stroke, middle);
            ink.rect(vec2(left, top), vec2(left + stroke, top + TICK * scale));
            ink.text(&tick.label, TICK_TEXT, vec2(place, base), Align::Middle);
        }
        let (label, size) = self.x.fitted(LABEL_TEXT, self.label_room() / scale);
        let at = vec2(middle, base + (LABEL_GAP + LABEL_TEXT * CAP_HEIGHT) * scale);
        ink.text(&label, size, at, Align::Middle);
    }

    fn draw_y_axis(&self, ink: &mut Ink, min: Vec2, max: Vec2) {
        let (scale, stroke) = (ink.scale, ink.stroke);
        let right = min.x - stroke;
        let end = right - (TICK + GAP) * scale;
        let middle = 0.5 * (min.y + max.y);
        let ticks = &self.y.ticks.major;
        let at = |offset: f64| min.y + self.panel.picture.view.pixel_of_offset(vec2(0.0, offset)).y;
        let marks: Vec<f64> = ticks.iter().map(|tick| at(tick.at)).collect();
        let heights = vec![CAP_HEIGHT * TICK_TEXT * scale; ticks.len()];
        let places = label_places(&marks, &heights, BETWEEN_ROWS * scale);
        for ((tick, at), place) in ticks.iter().zip(marks).zip(places) {
            let top = snapped(at, stroke, middle);
            ink.rect(vec2(right - TICK * scale, top), vec2(right, top + stroke));
            ink.at_height(&tick.label, vec2(end, place), Align::End);
        }
        let (label, size) = self.y.fitted(LABEL_TEXT, self.room[1] / scale);
        let base = end - self.y.widest - LABEL_GAP * scale;
        ink.upwards(&label, size, vec2(base, middle));
    }
}

/// The room for a legend around a plot with so many columns and rows, whose panel has room
/// for more.
fn free(bar: Option<&ColorBar>, sides: [f64; 2], room: [f64; 2], style: &FigureStyle) -> Free {
    let scale = style.scale();
    let upright = bar.filter(|bar| bar.is_upright);
    let right = if upright.is_some() { RIGHT_BAR } else { RIGHT };
    // a bar reaches above a plot that is lower, and so does the half of a label
    let over = upright.map_or(0.0, |bar| 0.5 * (bar.length - sides[1])) + 0.5 * TICK_TEXT * scale;
    // labels below a plot, this one or another one of the column, have its middle and may be as
    // long as the room
    let out = 0.5 * (room[0] - sides[0]);
    Free {
        beside: [room[0] - sides[0] - out, room[1]],
        above: [room[0] - out + (right - MARGIN) * scale, room[1] - sides[1] - over],
    }
}

/// True if the legend of a panel with room for an image of `room` pixels has no place outside of
/// the image, and is left out.
#[must_use]
pub fn lacks_legend(panel: &Panel<'_>, room: [u32; 2], style: &FigureStyle) -> bool {
    let key = Some(ColorKey::new(panel.picture, &panel.labels));
    !panel.legend.is_empty() && PanelLayout::new(panel, vec![], style, room, key).legend.is_none()
}

/// The bar beside or below a plot: as long as that, and never shorter than its labels need.
pub(super) fn bar(
    key: ColorKey,
    place: BarPlace,
    style: &FigureStyle,
    sides: [f64; 2],
    room: [f64; 2],
) -> Option<ColorBar> {
    let [upright, lying] = LEAST_BAR.map(|length| length * style.scale());
    let lying = lying + key.beyond.iter().flatten().count() as f64 * WORD * style.scale();
    match place {
        BarPlace::Right => {
            Some(ColorBar::upright(key, style, sides[1].max(upright.min(room[1])).round()))
        }
        BarPlace::Bottom => {
            Some(ColorBar::lying(key, style, sides[0].max(lying.min(room[0])).round()))
        }
        BarPlace::None => None,
    }
}

/// Draws a bar beside a box, or below it. The decorations around the box end at `end`: a lying bar
/// is below that, and an upright one beside it if it reaches beyond the box.
pub(super) fn draw_bar(
    bar: &ColorBar,
    ink: &mut Ink,
    [min, max]: [Vec2; 2],
    end: Vec2,
    room: [f64; 2],
) {
    let (middle, scale) = ((min + max) * 0.5, ink.scale);
    if bar.is_upright {
        let beside = if bar.length > max.y - min.y { end.x + GAP * scale } else { max.x };
        let left = (max.x + BAR_GAP * scale).max(beside).round();
        let start = vec2(left, (middle.y + 0.5 * bar.length).round());
        bar.draw(ink, start, room[1].max(bar.length));
    } else {
        let top = (end.y + BAR_BELOW_GAP * scale).round();
        let start = vec2((middle.x - 0.5 * bar.length).round(), top);
        bar.draw(ink, start, room[0].max(bar.length));
    }
}

/// The lines of a caption or title: wrapped, and after some lines shortened, lest it take the page,
/// to what follows and the end, where the step of a series is.
pub(super) fn lines(title: &str, size: f64, room: f64, most: usize) -> Vec<String> {
    let mut lines = text::wrapped(title, size, room);
    if lines.len() > most {
        let rest = lines.split_off(most - 1).join(" ");
        lines.push(text::squeezed(&rest, size, room));
    }
    lines
}
