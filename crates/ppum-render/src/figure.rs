//! Figures: a picture with axes, a colour bar, a title and the cracks.
//!
//! The picture's pixels are shown as they are, one to one; frame and ticks lie outside them. Pixels
//! without a value are hatched where the picture is transparent. At deep zoom axes count from the
//! tip nearest to the view's centre ("x − 0.5 \[×10⁻¹²\]"), without one from a rounded centre.
//!
//! ```text
//!      title
//!      ┌──────────────┐  ▲  above the range
//!    y ┤              │  █─
//!      ┤   picture    │  █─  quantity [unit]
//!      └──┬────┬────┬─┘  ▼  below the range
//!              x
//! ```

use ppum::crack::{Crack, tips};
use ppum::vec2::{Vec2, vec2};

use crate::image::{Image, Mask, Rgba};
use crate::overlay::{self, line_scale};
use crate::picture::Picture;
use crate::text::{self, CAP_HEIGHT};
use crate::ticks::{self, Step, Ticks, power_of_ten};

/// The words of a figure; empty ones are left out. `_{…}` sets a subscript: `σ_{yy}`. Characters are
/// those of Latin, Greek and mathematics; others appear as boxes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Labels {
    /// Line above the picture.
    pub title: String,
    /// What the colours mean, e.g. `von Mises stress`.
    pub quantity: String,
    /// Unit of the values.
    pub unit: String,
    /// Unit of lengths.
    pub length_unit: String,
}

/// Why there is no such figure.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FigureError {
    /// No room for the picture between the labels.
    #[error("a figure of {}x{} pixels leaves no room; give at least {}x{}",
        size[0], size[1], least[0], least[1])]
    TooSmall {
        /// The size asked for.
        size: [u32; 2],
        /// The smallest size.
        least: [u32; 2],
    },
    /// The picture is larger than the room between the labels.
    #[error("a picture of {}x{} pixels does not fit a figure with room for {}x{}; \
        draw it with the size that plot_area gives", plot[0], plot[1], room[0], room[1])]
    TooLarge {
        /// The picture's size.
        plot: [u32; 2],
        /// The room.
        room: [u32; 2],
    },
}

const PAGE: Rgba = [255, 255, 255, 255];
const INK: Rgba = [38, 38, 42, 255];
const HATCH: Rgba = [214, 214, 218, 255];

// Lengths in pixels of a figure of 1024 × 768; others are scaled.
const TICK_TEXT: f64 = 13.0;
const LABEL_TEXT: f64 = 14.0;
const TITLE_TEXT: f64 = 17.0;
const TICK: f64 = 5.0;
const MINOR_TICK: f64 = 3.0;
/// Between a tick and its label.
const GAP: f64 = 5.0;
/// Between tick labels and the label of the axis.
const LABEL_GAP: f64 = 10.0;
const TITLE_GAP: f64 = 14.0;
const BAR_GAP: f64 = 24.0;
const BAR: f64 = 18.0;
/// Height of the triangles for values below and above.
const ARROW: f64 = 14.0;
const HATCH_STEP: u32 = 8;
/// Least distances of labelled ticks, across and along the direction of reading.
const TICK_DISTANCE: [f64; 2] = [72.0, 44.0];
/// Room kept around the picture: left (labels of y) and right (the bar), above and below.
const ROOM_X: f64 = 96.0 + 150.0;
const ROOM_Y: f64 = 52.0 + 68.0;
/// Least side of a picture.
const LEAST: u32 = 48;

/// The largest picture that a figure of `size` has room for.
///
/// # Errors
/// If that is less than 48 pixels wide or high.
pub fn plot_area(size: [u32; 2]) -> Result<[u32; 2], FigureError> {
    let scale = line_scale(size);
    let rooms = [ROOM_X, ROOM_Y].map(|room| (room * scale).ceil() as u32);
    let least = rooms.map(|room| room + LEAST);
    if size[0] < least[0] || size[1] < least[1] {
        return Err(FigureError::TooSmall { size, least });
    }
    Ok([size[0] - rooms[0], size[1] - rooms[1]])
}

/// Draws a figure of `size` pixels around a picture of at most [`plot_area`], in the middle.
///
/// # Errors
/// A size without room for the picture.
pub fn figure(
    picture: &Picture,
    labels: &Labels,
    cracks: &[Crack],
    size: [u32; 2],
) -> Result<Image, FigureError> {
    let (plot, room) = (picture.image.size, plot_area(size)?);
    if plot[0] > room[0] || plot[1] > room[1] {
        return Err(FigureError::TooLarge { plot, room });
    }
    let sheet = Sheet::new(picture, labels, cracks, size);
    let mut page = Image::filled(size, PAGE);
    page.paste(&hatched(plot), sheet.plot_min.map(|c| c as u32));
    let mut shown = picture.image.clone();
    overlay::cracks(&mut shown, &picture.view, cracks);
    page.paste(&shown, sheet.plot_min.map(|c| c as u32));
    sheet.paint_bar(&mut page);
    let mut ink = Mask::new(size);
    sheet.draw_frame(&mut ink);
    sheet.draw_x_axis(&mut ink);
    sheet.draw_y_axis(&mut ink);
    sheet.draw_bar(&mut ink);
    sheet.draw_title(&mut ink, &labels.title);
    page.paint(&ink, INK);
    Ok(page)
}

/// An axis or the bar: its ticks, what is written along it, and how wide its tick labels are.
struct Axis {
    ticks: Ticks,
    label: String,
    /// Bytes of the label that are the name; the rest is a number and units, which stay whole.
    name: usize,
    widest: f64,
}

impl Axis {
    fn new(ticks: Ticks, name: &str, unit: &str, scale: f64) -> Self {
        let widths = ticks.major.iter().map(|t| text::width(&t.label, TICK_TEXT * scale));
        let widest = widths.fold(0.0, f64::max);
        Self { label: axis_label(name, &ticks, unit), name: name.len(), widest, ticks }
    }

    /// The label, with its name shortened if there is less room \[pixels\].
    fn fitted(&self, size: f64, room: f64) -> String {
        let (name, rest) = self.label.split_at(self.name);
        let name = text::fitted(name, size, (room - text::width(rest, size)).max(0.0));
        text::fitted(&format!("{name}{rest}"), size, room)
    }
}

/// Everything's place on the page; pixels of the plot are whole pixels of the page.
struct Sheet<'a> {
    picture: &'a Picture,
    size: [u32; 2],
    scale: f64,
    /// Width of frame and tick lines, whole pixels.
    stroke: f64,
    plot_min: [f64; 2],
    plot_max: [f64; 2],
    x: Axis,
    y: Axis,
    bar: Axis,
}

impl<'a> Sheet<'a> {
    fn new(picture: &'a Picture, labels: &Labels, cracks: &[Crack], size: [u32; 2]) -> Self {
        let scale = line_scale(size);
        let [columns, rows] = picture.image.size.map(f64::from);
        let [x, y] = axes(picture, labels, cracks, scale);
        let most = (rows / (TICK_DISTANCE[1] * scale)) as usize;
        let bar = bar(picture, labels, most.max(2), scale);

        // The group of picture, labels and bar is centred on the page as one.
        let title_height =
            |label: &str| if label.is_empty() { 0.0 } else { LABEL_GAP + LABEL_TEXT };
        let left = scale * (TICK + GAP + title_height(&y.label)) + y.widest;
        let right = scale * (BAR_GAP + BAR + TICK + GAP + title_height(&bar.label)) + bar.widest;
        let top = if labels.title.is_empty() { 0.0 } else { TITLE_GAP + TITLE_TEXT * CAP_HEIGHT };
        let bottom = TICK + GAP + TICK_TEXT * CAP_HEIGHT + title_height(&x.label);
        let start = |total: u32, before: f64, length: f64, after: f64| {
            (0.5 * (f64::from(total) - before - length - after) + before).round()
        };
        let plot_min = [
            start(size[0], left, columns, right),
            start(size[1], top * scale, rows, bottom * scale),
        ];
        let plot_max = [plot_min[0] + columns, plot_min[1] + rows];
        Self { picture, size, scale, stroke: scale.round().max(1.0), plot_min, plot_max, x, y, bar }
    }

    /// A frame around the plot, just outside its pixels.
    fn draw_frame(&self, ink: &mut Mask) {
        outline(ink, self.plot_min.into(), self.plot_max.into(), self.stroke);
    }

    fn draw_x_axis(&self, ink: &mut Mask) {
        let Self { scale, stroke, .. } = *self;
        let top = self.plot_max[1] + stroke;
        let base = top + (TICK + GAP + TICK_TEXT * CAP_HEIGHT) * scale;
        let middle = 0.5 * (self.plot_min[0] + self.plot_max[0]);
        for tick in &self.x.ticks.major {
            let at = self.plot_min[0] + self.picture.view.pixel_of_offset(vec2(tick.at, 0.0)).x;
            let left = snapped(at, stroke, middle);
            ink.rect(vec2(left, top), vec2(left + stroke, top + (TICK * scale).round()));
            self.centred(ink, &tick.label, TICK_TEXT * scale, vec2(at, base));
        }
        let room = self.plot_max[0] - self.plot_min[0];
        let label = self.x.fitted(LABEL_TEXT * scale, room);
        let at = vec2(middle, base + (LABEL_GAP + LABEL_TEXT * CAP_HEIGHT) * scale);
        self.centred(ink, &label, LABEL_TEXT * scale, at);
    }

    fn draw_y_axis(&self, ink: &mut Mask) {
        let Self { scale, stroke, .. } = *self;
        let right = self.plot_min[0] - stroke;
        let end = right - (TICK + GAP) * scale;
        let middle = 0.5 * (self.plot_min[1] + self.plot_max[1]);
        for tick in &self.y.ticks.major {
            let at = self.plot_min[1] + self.picture.view.pixel_of_offset(vec2(0.0, tick.at)).y;
            let top = snapped(at, stroke, middle);
            ink.rect(vec2(right - (TICK * scale).round(), top), vec2(right, top + stroke));
            let length = text::width(&tick.label, TICK_TEXT * scale);
            self.at_height(ink, &tick.label, vec2(end - length, at));
        }
        let base = end - self.y.widest - LABEL_GAP * scale;
        self.upwards(ink, &self.y, base);
    }

    /// Left edge, and lower and upper end of the bar's evenly coloured part.
    fn bar_place(&self) -> (f64, [f64; 2]) {
        let arrow = |shown: bool| if shown { (ARROW * self.scale).round() } else { 0.0 };
        let left = (self.plot_max[0] + BAR_GAP * self.scale).round();
        let low = self.plot_max[1] - arrow(self.picture.has_below);
        let high = self.plot_min[1] + arrow(self.picture.has_above);
        (left, [low, high])
    }

    fn bar_width(&self) -> f64 {
        (BAR * self.scale).round()
    }

    /// The colours of the bar and its arrows.
    fn paint_bar(&self, page: &mut Image) {
        let (left, [low, high]) = self.bar_place();
        let map = &self.picture.colormap;
        let rows = (low - high) as u32;
        let size = [self.bar_width() as u32, rows];
        let mut colors = Image::filled(size, PAGE);
        let rows_of_pixels = colors.rgba.chunks_exact_mut(4 * size[0] as usize);
        for (row, pixels) in (0..rows).zip(rows_of_pixels) {
            let t = 1.0 - (f64::from(row) + 0.5) / f64::from(rows);
            pixels.as_chunks_mut().0.fill(map.color(t));
        }
        page.paste(&colors, [left as u32, high as u32]);
        for (corners, color) in self.arrows() {
            let mut mask = Mask::new(self.size);
            mask.triangle(corners);
            page.paint(&mask, color);
        }
    }

    /// The triangles at the bar's ends: base, tip, base, and colour.
    fn arrows(&self) -> Vec<([Vec2; 3], Rgba)> {
        let (left, [low, high]) = self.bar_place();
        let width = self.bar_width();
        let triangle = |base: f64, tip: f64| {
            [vec2(left, base), vec2(left + 0.5 * width, tip), vec2(left + width, base)]
        };
        let picture = self.picture;
        let mut arrows = Vec::new();
        if picture.has_below {
            arrows.push((triangle(low, self.plot_max[1]), picture.colormap.below));
        }
        if picture.has_above {
            arrows.push((triangle(high, self.plot_min[1]), picture.colormap.above));
        }
        arrows
    }

    fn draw_bar(&self, ink: &mut Mask) {
        let Self { scale, stroke, .. } = *self;
        let (left, [low, high]) = self.bar_place();
        let right = left + self.bar_width();
        outline(ink, vec2(left, high), vec2(right, low), stroke);
        for ([a, tip, b], _) in self.arrows() {
            ink.line(a, tip, stroke);
            ink.line(tip, b, stroke);
        }
        let middle = 0.5 * (low + high);
        let mut mark = |position: f64, length: f64| {
            let at = low + position * (high - low);
            let top = snapped(at, stroke, middle);
            let from = right + stroke;
            ink.rect(vec2(from, top), vec2(from + (length * scale).round(), top + stroke));
            at
        };
        for &position in &self.bar.ticks.minor {
            mark(position, MINOR_TICK);
        }
        let heights: Vec<f64> = self.bar.ticks.major.iter().map(|t| mark(t.at, TICK)).collect();
        let start = right + stroke + (TICK + GAP) * scale;
        for (tick, height) in self.bar.ticks.major.iter().zip(heights) {
            self.at_height(ink, &tick.label, vec2(start, height));
        }
        self.upwards(ink, &self.bar, self.bar_label_base());
    }

    /// Base line of the bar's label.
    fn bar_label_base(&self) -> f64 {
        let ticks_end = self.bar_place().0 + self.bar_width() + self.stroke + self.bar.widest;
        ticks_end + (TICK + GAP + LABEL_GAP + LABEL_TEXT * CAP_HEIGHT) * self.scale
    }

    /// The title, cut where the bar's label could reach up to it.
    fn draw_title(&self, ink: &mut Mask, title: &str) {
        let size = TITLE_TEXT * self.scale;
        let start = vec2(self.plot_min[0], self.plot_min[1] - TITLE_GAP * self.scale);
        let end = self.bar_label_base() - (LABEL_TEXT + GAP) * self.scale;
        text::draw(ink, &text::fitted(title, size, end - start.x), size, start);
    }

    /// Text centred on a point of its base line.
    fn centred(&self, ink: &mut Mask, line: &str, size: f64, at: Vec2) {
        let start = vec2(at.x - 0.5 * text::width(line, size), at.y.round());
        text::draw(ink, line, size, start);
    }

    /// A tick's label whose digits are centred on a height, starting at `at.x`.
    fn at_height(&self, ink: &mut Mask, line: &str, at: Vec2) {
        let size = TICK_TEXT * self.scale;
        text::draw(ink, line, size, vec2(at.x, (at.y + 0.5 * CAP_HEIGHT * size).round()));
    }

    /// An axis' label that reads upwards beside the plot.
    fn upwards(&self, ink: &mut Mask, axis: &Axis, base: f64) {
        let size = LABEL_TEXT * self.scale;
        let label = axis.fitted(size, f64::from(self.size[1]) - 2.0 * GAP);
        let half = 0.5 * text::width(&label, size);
        // A label longer than the picture stays on the page.
        let (least, most) = (half + GAP, f64::from(self.size[1]) - half - GAP);
        let middle = (0.5 * (self.plot_min[1] + self.plot_max[1])).min(most).max(least);
        text::draw_upwards(ink, &label, size, vec2(base, middle));
    }
}

/// The colour bar; where one value alone is seen it says so.
fn bar(picture: &Picture, labels: &Labels, most: usize, scale: f64) -> Axis {
    let (norm, Labels { quantity, unit, .. }) = (&picture.normalization, labels);
    match picture.one_value {
        Some(value) => {
            let name = format!("{quantity}, one value").trim_start_matches(", ").to_owned();
            Axis::new(ticks::of_one_value(norm, value), &name, unit, scale)
        }
        None => Axis::new(ticks::bar(norm, most), quantity, unit, scale),
    }
}

/// The axes x and y, with the same step where that leaves y two ticks at least.
fn axes(picture: &Picture, labels: &Labels, cracks: &[Crack], scale: f64) -> [Axis; 2] {
    let view = &picture.view;
    let half = view.half();
    let step = |distance: f64| Step::at_least(distance * scale * view.pixel_size());
    let [across, along] = TICK_DISTANCE.map(step);
    let (x_step, y_step) = (across, if half.y > across.size() { across } else { along });
    let tip = nearest_tip(picture, cracks);
    let x = ticks::axis(view.center.x, half.x, x_step, tip.map(|t| t.x));
    let y = ticks::axis(view.center.y, half.y, y_step, tip.map(|t| t.y));
    [Axis::new(x, "x", &labels.length_unit, scale), Axis::new(y, "y", &labels.length_unit, scale)]
}

/// The tip in the view that is nearest to its centre.
fn nearest_tip(picture: &Picture, cracks: &[Crack]) -> Option<Vec2> {
    let view = &picture.view;
    let offset = |p: Vec2| p - view.center;
    let is_seen =
        |p: &Vec2| offset(*p).x.abs() <= view.half().x && offset(*p).y.abs() <= view.half().y;
    tips(cracks)
        .map(|tip| cracks[tip.crack as usize].end_point(tip.end))
        .filter(is_seen)
        .min_by(|&a, &b| offset(a).length().total_cmp(&offset(b).length()))
}

/// "name − reference [×10ᵏ unit]", each part where it is needed.
fn axis_label(name: &str, ticks: &Ticks, unit: &str) -> String {
    let mut label = name.to_owned();
    if ticks.reference != 0.0 {
        let sign = if ticks.reference > 0.0 { '−' } else { '+' };
        label = format!("{name} {sign} {}", ticks.reference.abs());
    }
    let power = match ticks.exponent {
        0 => String::new(),
        k => format!("×{}", power_of_ten(k)),
    };
    let measure = [power.as_str(), unit].into_iter().filter(|part| !part.is_empty());
    let measure = measure.collect::<Vec<_>>().join(" ");
    if measure.is_empty() { label } else { format!("{label} [{measure}]").trim_start().to_owned() }
}

/// A box's outline of some width, outside of it.
fn outline(ink: &mut Mask, min: Vec2, max: Vec2, stroke: f64) {
    let out = vec2(stroke, stroke);
    let (min_out, max_out) = (min - out, max + out);
    ink.rect(min_out, vec2(max_out.x, min.y));
    ink.rect(vec2(min_out.x, max.y), max_out);
    ink.rect(min_out, vec2(min.x, max_out.y));
    ink.rect(vec2(max.x, min_out.y), max_out);
}

/// The start of a line of whole pixels around `at`; halves are rounded away from the middle, so that
/// ticks at both ends of an axis continue the frame's lines.
fn snapped(at: f64, stroke: f64, middle: f64) -> f64 {
    let start = at - 0.5 * stroke;
    if at < middle { (start - 0.5).ceil() } else { (start + 0.5).floor() }
}

/// A page with diagonal lines: what shows where the picture has no values.
fn hatched(size: [u32; 2]) -> Image {
    let mut image = Image::filled(size, PAGE);
    let pixels = image.rgba.as_chunks_mut().0;
    for (row, line) in (0u32..).zip(pixels.chunks_mut(size[0] as usize)) {
        for (column, pixel) in (0u32..).zip(line) {
            if (column + row) % HATCH_STEP == 0 {
                *pixel = HATCH;
            }
        }
    }
    image
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Style;
    use crate::range::Range;
    use crate::raster::Raster;
    use crate::view::View;
    use ppum::crack::CrackEnd;
    use ppum::vec2::Rect;

    const SIZE: [u32; 2] = [640, 480];

    fn labels() -> Labels {
        let word = |text: &str| text.to_owned();
        Labels {
            title: word(
                "A plate with a title that is much longer than the figure is wide, as they are",
            ),
            quantity: word(
                "a quantity whose name is longer than the figure is high, von Mises say",
            ),
            unit: word("MPa"),
            length_unit: word("mm"),
        }
    }

    /// x on a square, NaN in its upper left quarter.
    fn picture(half: f64, range: Range) -> Picture {
        let square = Rect::around(Vec2::ZERO, vec2(half, half));
        let view = View::hug(square, plot_area(SIZE).unwrap()).unwrap();
        let raster = Raster::from_fn(view.pixels, |i, j| match view.offset(i, j) {
            p if p.x < 0.0 && p.y > 0.0 => f64::NAN,
            p => p.x,
        });
        Picture::bare(&raster, &view, &Style { range, ..Style::default() }).unwrap()
    }

    /// Where the plot begins, found as the first place with the picture's last row of colours.
    fn plot_corner(page: &Image, picture: &Picture) -> [u32; 2] {
        let [columns, rows] = picture.image.size;
        let last_row = |x: u32, y: u32| {
            (0..columns).all(|i| page.pixel(x + i, y) == picture.image.pixel(i, rows - 1))
        };
        let mut places = (rows..SIZE[1]).flat_map(|y| (0..SIZE[0] - columns).map(move |x| [x, y]));
        let found = places.rfind(|&[x, y]| last_row(x, y)).expect("the plot is on the page");
        [found[0], found[1] + 1 - rows]
    }

    #[test]
    fn the_picture_is_shown_pixel_for_pixel() {
        let picture = picture(1.0, Range::Auto);
        let page = figure(&picture, &labels(), &[], SIZE).unwrap();
        let [x, y] = plot_corner(&page, &picture);
        let [columns, rows] = picture.image.size;
        assert_eq!(page.size, SIZE);
        for (i, j) in (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j))) {
            let (shown, color) = (page.pixel(x + i, y + j), picture.image.pixel(i, j));
            let expected = match (color[3], (i + j) % HATCH_STEP) {
                (0, 0) => HATCH,
                (0, _) => PAGE,
                _ => color,
            };
            assert_eq!(shown, expected, "{i}, {j}");
        }
        for (i, j) in [(x - 1, y - 1), (x + columns, y + rows), (x - 1, y + 7)] {
            assert_eq!(page.pixel(i, j), INK, "the frame");
        }
    }

    #[test]
    fn ticks_are_at_their_values() {
        let picture = picture(1.0, Range::Auto);
        let page = figure(&picture, &labels(), &[], SIZE).unwrap();
        let [x, y] = plot_corner(&page, &picture);
        let [columns, rows] = picture.image.size;
        let below = y + rows + 3;
        let marked: Vec<u32> =
            (0..=columns + 1).filter(|&i| page.pixel(x + i - 1, below) == INK).collect();
        let expected = [0, columns / 4, columns / 2, 3 * columns / 4, columns];
        assert_eq!(marked.len(), 5);
        for (found, place) in marked.into_iter().zip(expected) {
            assert!(found.abs_diff(place) <= 1, "{found} {place}");
        }
    }

    #[test]
    fn the_bar_runs_from_low_to_high_and_ends_in_arrows() {
        let picture = picture(1.0, Range::Fixed(-0.5, 0.5));
        let page = figure(&picture, &labels(), &[], SIZE).unwrap();
        let [x, y] = plot_corner(&page, &picture);
        let [columns, rows] = picture.image.size;
        let column = x + columns + (BAR_GAP + BAR / 2.0) as u32;
        let map = &picture.colormap;
        assert_eq!(page.pixel(column, y + ARROW as u32 - 3), map.above);
        assert_eq!(page.pixel(column, y + rows - ARROW as u32 + 3), map.below);
        let near = |a: Rgba, b: Rgba| (0..3).all(|k| a[k].abs_diff(b[k]) < 6);
        assert!(near(page.pixel(column, y + ARROW as u32 + 1), map.color(1.0)));
        assert!(near(page.pixel(column, y + rows - ARROW as u32 - 2), map.color(0.0)));
        assert!(near(page.pixel(column, y + rows / 2), map.color(0.5)));
    }

    #[test]
    fn long_words_stay_on_the_page() {
        for half in [1.0, 1e-5, 3e7] {
            let page = figure(&picture(half, Range::Auto), &labels(), &[], SIZE).unwrap();
            let [right, bottom] = SIZE.map(|n| n - 1);
            for (i, j) in (0..SIZE[0]).flat_map(|i| (0..SIZE[1]).map(move |j| (i, j))) {
                let is_margin = i < 2 || j < 2 || i + 1 >= right || j + 1 >= bottom;
                assert!(!is_margin || page.pixel(i, j) == PAGE, "{i}, {j}");
            }
        }
    }

    #[test]
    fn deep_axes_count_from_the_nearest_tip_in_view() {
        let tip = vec2(0.3, -0.7);
        let crack = |tip: Vec2| Crack {
            points: vec![tip + vec2(-0.1, 0.0), tip],
            ends: [CrackEnd::Mouth, CrackEnd::Tip],
        };
        let cracks = [crack(tip + vec2(3e-10, 0.0)), crack(tip), crack(tip + vec2(1e-8, 0.0))];
        let view = View::new(tip, 1e-9, [300, 300]).unwrap();
        let raster = Raster::from_fn(view.pixels, |i, _| f64::from(i));
        let picture = Picture::bare(&raster, &view, &Style::default()).unwrap();
        let [x, y] = axes(&picture, &labels(), &cracks, 1.0);
        assert_eq!(
            (x.label.as_str(), y.label.as_str()),
            ("x − 0.3 [×10⁻¹⁰ mm]", "y + 0.7 [×10⁻¹⁰ mm]")
        );
        assert!(x.ticks.major.iter().any(|t| t.at == 0.0 && t.label == "0"));
    }

    #[test]
    fn labels_have_only_the_parts_they_need() {
        let ticks = |reference, exponent| Ticks { reference, exponent, ..Ticks::default() };
        assert_eq!(axis_label("x", &ticks(0.0, 0), ""), "x");
        assert_eq!(axis_label("x", &ticks(0.0, 0), "mm"), "x [mm]");
        assert_eq!(axis_label("u", &ticks(0.0, -4), ""), "u [×10⁻⁴]");
        assert_eq!(axis_label("", &ticks(0.0, 3), "MPa"), "[×10³ MPa]");
        assert_eq!(axis_label("x", &ticks(0.25, 0), ""), "x − 0.25");
    }

    /// A name that is too long gives way to the power of ten and the unit.
    #[test]
    fn shortened_labels_keep_their_units() {
        let axis =
            Axis::new(Ticks { exponent: -4, ..Ticks::default() }, &"x + ".repeat(99), "mm", 1.0);
        let label = axis.fitted(12.0, 200.0);
        assert!(label.starts_with("x + x") && label.ends_with("… [×10⁻⁴ mm]"), "{label}");
        assert!(text::width(&label, 12.0) <= 200.0, "{label}");
        assert!(text::width(&axis.fitted(12.0, 20.0), 12.0) <= 20.0);
        assert_eq!(axis.fitted(12.0, 1e6), axis.label);
    }

    #[test]
    fn figures_without_room_are_refused() {
        let picture = picture(1.0, Range::Auto);
        let refused = |size| figure(&picture, &labels(), &[], size).unwrap_err();
        assert!(matches!(refused([200, 480]), FigureError::TooSmall { .. }));
        assert!(matches!(refused([500, 400]), FigureError::TooLarge { .. }));
        let FigureError::TooSmall { least, .. } = refused([10, 10]) else { unreachable!() };
        assert_eq!(plot_area(least), Ok([LEAST, LEAST]));
    }
}
